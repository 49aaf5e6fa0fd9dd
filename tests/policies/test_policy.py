"""Weights to references and back."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.errors import LevadeError
from levade.policies import Follower, GaussianKernels, Group, Policy, independent_joints, refine
from levade.policies.tables import policy_from_dict, policy_to_dict

# The paper's rearing on HyQ2Max: left leads right, front pair and hind pair, with one mirrored joint to make it hard.
PAIRS = (
    Group((0, 1, 2), (Follower((3, 4, 5), (-1, 1, 1)),)),
    Group((6, 7, 8), (Follower((9, 10, 11), (-1, 1, 1)),)),
)


def rearing(horizon=0.3, hold_steps=0, kernels=None) -> Policy:
    return Policy(kernels or GaussianKernels(), PAIRS, horizon=horizon, timestep=0.002, hold_steps=hold_steps)


def recovery(horizon=0.3) -> Policy:
    return Policy(GaussianKernels(), independent_joints(12), horizon=horizon, timestep=0.002)


def random_weights(policy: Policy, n: int = 5) -> np.ndarray:
    return np.random.default_rng(3).uniform(-1, 1, (n, policy.size))


def test_the_paper_s_sizes():
    assert rearing().size == 96
    assert recovery().size == 192
    assert rearing().horizon_steps == 150


def test_the_batch_is_the_reference_loop_of_eq_3_and_4():
    policy = rearing(hold_steps=7)
    weights = random_weights(policy, n=2)
    reference = policy.reference(weights)
    assert reference.position.shape == reference.velocity.shape == (2, 157, 12)
    assert reference.horizon_steps == 150
    for trial in range(2):
        w = weights[trial].reshape(6, 16)
        for k in range(157):
            t = min((k + 1) * 0.002, 0.3) / 0.3
            phi = [math.exp(-((t - i / 15) ** 2) / (2 * 0.01)) for i in range(16)]
            f = [sum(w[j, i] * phi[i] for i in range(16)) / sum(phi) for j in range(6)]
            wanted = [f[0], f[1], f[2], -f[0], f[1], f[2], f[3], f[4], f[5], -f[3], f[4], f[5]]
            np.testing.assert_allclose(reference.position[trial, k], wanted, atol=1e-12)


@pytest.mark.parametrize("policy", [rearing(hold_steps=20), recovery(), rearing(horizon=3.0)])
def test_velocity_is_the_finite_difference_of_position(policy):
    reference = policy.reference(random_weights(policy))
    rows = reference.horizon_steps
    position, velocity = reference.position[:, :rows], reference.velocity[:, :rows]
    numeric = (position[:, 2:] - position[:, :-2]) / (2 * policy.timestep)
    np.testing.assert_allclose(velocity[:, 1:-1], numeric, atol=2e-3 * np.abs(velocity).max())
    assert (reference.velocity[:, rows:] == 0).all()
    assert (reference.position[:, rows:] == reference.position[:, rows - 1 : rows]).all()


@pytest.mark.slow
@given(
    st.lists(st.floats(-3, 3), min_size=12, max_size=12),
    st.sampled_from([GaussianKernels(), GaussianKernels(1), GaussianKernels(16, 1e-9), GaussianKernels(20, 1e3)]),
)
def test_hold_keeps_the_posture_exactly(posture, kernels):
    policy = Policy(kernels, independent_joints(12), horizon=0.1, timestep=0.002, hold_steps=3)
    reference = policy.reference(policy.hold(posture)[None])
    assert (reference.position == np.array(posture)).all()
    assert (reference.velocity == 0).all()
    np.testing.assert_array_equal(policy.interpolate(posture, posture), policy.hold(posture))


def test_hold_takes_the_mean_where_the_legs_differ():
    policy = rearing()
    posture = np.zeros(12)
    posture[[0, 3]], posture[[1, 4]] = (0.3, -0.1), (0.5, 0.7)
    held = policy.reference(policy.hold(posture)[None]).position[0, 0]
    np.testing.assert_allclose(held[[0, 3]], [0.2, -0.2])
    np.testing.assert_allclose(held[[1, 4]], [0.6, 0.6])


@pytest.mark.parametrize("steps", [1, 10, 37, 150, 1150])
@pytest.mark.parametrize("groups", [PAIRS, independent_joints(12)])
def test_a_trial_has_the_same_bits_alone_and_in_any_batch(steps, groups):
    policy = Policy(GaussianKernels(), groups, horizon=steps * 0.002, timestep=0.002, hold_steps=5)
    weights = random_weights(policy, n=19)
    batch = policy.reference(weights)
    for trials in ([0], [7], [18], [3, 4, 5], [18, 0]):
        part = policy.reference(weights[trials])
        np.testing.assert_array_equal(part.position, batch.position[trials])
        np.testing.assert_array_equal(part.velocity, batch.velocity[trials])
    longer = policy.reference(weights, hold_steps=50)
    np.testing.assert_array_equal(longer.position[:, : batch.steps], batch.position)


@pytest.mark.parametrize("horizon", [0.02, 0.074, 0.3, 2.3])
def test_followers_mirror_their_leader_to_the_last_bit(horizon):
    reference = rearing(horizon, hold_steps=4).reference(random_weights(rearing()))
    for q in (reference.position, reference.velocity):
        for leader, follower in ((0, 3), (6, 9)):
            np.testing.assert_array_equal(q[..., follower : follower + 3], q[..., leader : leader + 3] * [-1, 1, 1])


def test_groups_may_be_in_any_order_and_of_any_number_of_legs():
    groups = (Group((5, 1), (Follower((0, 3), (1, -1)), Follower((2, 4), (-1, 1)))),)
    policy = Policy(GaussianKernels(2, 1e-9), groups, horizon=0.1, timestep=0.05)
    position = policy.reference(np.array([[1.0, 1.0, 2.0, 2.0]])).position[0]
    np.testing.assert_array_equal(position, [[1, 2, -1, -2, 2, 1]] * 2)


@pytest.mark.slow
def test_threads_do_not_change_a_bit():
    script = (
        "import hashlib, numpy as np\n"
        "from levade.policies import *\n"
        "p = Policy(GaussianKernels(), independent_joints(12), horizon=24.0, timestep=0.002)\n"
        "r = p.reference(np.random.default_rng(0).normal(size=(2, p.size)))\n"
        "print(hashlib.sha256(r.position.tobytes() + r.velocity.tobytes()).hexdigest())\n"
    )
    digests = set()
    for threads in ("1", "2", "4"):
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": threads, "PYTHONPATH": os.pathsep.join(sys.path)}
        digests.add(
            subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, check=True).stdout
        )
    assert len(digests) == 1


def test_interpolation_follows_the_line_and_its_weights_stay_near_it():
    policy = recovery()
    start, goal = np.linspace(-1, 1, 12), np.linspace(0.5, -1.5, 12)
    weights = policy.interpolate(start, goal)
    position = policy.reference(weights[None]).position[0]
    share = np.arange(1, 151)[:, None] / 150
    way = np.abs(goal - start)
    assert (np.abs(position - (start + share * (goal - start))) <= 0.005 * way).all()
    overshoot = np.abs(weights.reshape(12, 16) - 0.5 * (start + goal)[:, None]) - 0.5 * way[:, None]
    assert (overshoot <= way[:, None] / 5).all()


def test_interpolation_goes_through_the_postures_at_equal_distances_in_time():
    policy = recovery()
    start, over, goal = np.zeros(12), np.linspace(-1, 1, 12), np.full(12, 0.2)
    position = policy.reference(policy.interpolate(start, goal, through=[over, over])[None]).position[0]
    np.testing.assert_allclose(position[74], over, atol=0.05)  # half way between the two; corners are rounded
    np.testing.assert_allclose(position[24], over / 2, atol=0.05)
    np.testing.assert_allclose(position[-1], goal, atol=0.05)
    straight = policy.interpolate(start, goal, through=[goal / 2])
    np.testing.assert_allclose(straight, policy.interpolate(start, goal))


def test_refined_weights_reproduce_the_reference():
    coarse, fine = rearing(), rearing(kernels=GaussianKernels(32, 0.005))
    weights = random_weights(coarse)
    finer = refine(weights, coarse, fine)
    assert finer.shape == (5, 192)
    np.testing.assert_allclose(fine.reference(finer).position, coarse.reference(weights).position, atol=1e-3)
    assert np.abs(finer).max() < 5


def test_fit_finds_the_weights_of_well_separated_kernels_again():
    policy = rearing(kernels=GaussianKernels(8, 0.005))
    weights = random_weights(policy)
    np.testing.assert_allclose(policy.fit(policy.reference(weights).position), weights, atol=1e-9)


def test_horizon_is_rounded_to_whole_steps():
    policy = Policy(GaussianKernels(4), independent_joints(1), horizon=0.0109, timestep=0.002)
    assert policy.horizon_steps == 5
    assert policy.reference(np.zeros((1, 4))).position.shape == (1, 5, 1)
    assert Policy(GaussianKernels(4), independent_joints(1), horizon=1e-5, timestep=0.002).horizon_steps == 1


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: rearing().reference(np.zeros(96)),
            r"expected \(n, 96\), 6 joints x 16 kernels, got \(96,\); add an axis",
        ),
        (lambda: rearing().reference(np.zeros((2, 95))), r"expected \(n, 96\).*got \(2, 95\)"),
        (lambda: rearing().reference(np.full((2, 96), np.nan)), r"trials \[0, 1\] are not finite"),
        (lambda: rearing().hold(np.zeros(8)), "posture: expected 12 finite angles"),
        (lambda: rearing().interpolate(np.zeros(12), [np.inf] * 12), "posture: expected 12 finite angles"),
        (lambda: rearing().fit(np.zeros((1, 3, 12))), r"position: expected \(n, 150, 12\), got \(1, 3, 12\)"),
        (lambda: rearing(horizon=-1), "horizon: -1 s is not a duration"),
        (lambda: rearing(hold_steps=-1), "hold_steps: -1 is negative"),
        (lambda: refine(np.zeros((1, 96)), rearing(), rearing(0.4)), "give both the same"),
        (lambda: Policy(GaussianKernels(), (), 1, 0.1), "put every joint in one"),
        (lambda: Policy(GaussianKernels(), (Group((0, 2)),), 1, 0.1), r"joints \[1\] are in no group"),
        (lambda: Policy(GaussianKernels(), (Group((0,)), Group((0,))), 1, 0.1), "joint 0 is already in a group"),
        (
            lambda: Policy(GaussianKernels(), (Group((0,), (Follower((1,), (0.5,)),)),), 1, 0.1),
            "the sign of joint 1 is 0.5; give 1 or -1",
        ),
        (
            lambda: Policy(GaussianKernels(), (Group((0, 1), (Follower((2,), (1,)),)),), 1, 0.1),
            "a leg has 1 joints and 1 signs, but its leader has 2 joints",
        ),
    ],
)
def test_errors_say_what_would_be_right(call, message):
    with pytest.raises(LevadeError, match=message):
        call()


def test_references_within_ranges_are_those_without_clamped_and_at_rest_at_the_ends():
    lower, upper = np.full(12, -0.4), np.full(12, 0.3)
    upper[4] = np.inf
    free = rearing(hold_steps=5)
    policy = replace(free, within=(tuple(lower), tuple(upper)))
    weights = random_weights(policy)
    reference, without = policy.reference(weights), free.reference(weights)
    assert (without.position < lower).any()
    assert (without.position > upper).any()
    np.testing.assert_array_equal(reference.position, np.clip(without.position, lower, upper))
    inside = (without.position >= lower) & (without.position <= upper)
    np.testing.assert_array_equal(reference.velocity, np.where(inside, without.velocity, 0.0))
    time = np.arange(1, 151) * 0.002
    position, velocity = policy.at(weights, time)
    np.testing.assert_allclose(position, reference.position[:, :150], atol=1e-12)
    np.testing.assert_allclose(velocity, reference.velocity[:, :150], atol=1e-9)
    again = policy_from_dict(json.loads(json.dumps(policy_to_dict(policy))))
    np.testing.assert_array_equal(again.reference(weights).position, reference.position)


def test_policies_of_earlier_files_have_no_ranges():
    content = policy_to_dict(rearing())
    del content["within"]
    assert policy_from_dict(content).within is None
