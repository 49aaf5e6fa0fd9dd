"""References that keep to a speed: the nearest ones that do, against a loop that tries every pair of rows."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.policies import (
    Ends,
    Follower,
    FreeGoal,
    FreePolicy,
    GaussianKernels,
    Group,
    Policy,
    Slew,
    policy_from_dict,
    policy_to_dict,
)
from levade.tasks import load_task
from levade.tasks.policy import make_policy

STEP, ROWS = 0.01, 60
GROUPS = (Group((0,), (Follower((1,), (-1.0,)),)), Group((2,), ()))
START = (0.2, -0.2, 0.0)
BOUND = 3.0


def policy(slew: Slew | None, **more: object) -> Policy:
    kernels = GaussianKernels(kernels=8, variance=0.005)
    ends = Ends(np.array(START), np.array([0.5, -0.5, 0.1]), depart=0.1, settle=0.3)
    return Policy(kernels, GROUPS, ROWS * STEP, STEP, hold_steps=5, ends=ends, slew=slew, **more)  # type: ignore[arg-type]


@pytest.fixture
def weights() -> np.ndarray:
    return np.random.default_rng(0).normal(size=(6, 16))


def slow(speed: float = BOUND) -> Slew:
    return Slew((speed, speed, np.inf), START)


def test_no_reference_is_faster_and_those_without_a_bound_are_as_they_were(weights: np.ndarray) -> None:
    free, kept = policy(None).reference(weights), policy(slow()).reference(weights)
    from_start = np.concatenate([np.broadcast_to(START, (6, 1, 3)), kept.position], axis=1)
    assert np.abs(np.diff(free.position[:, :, :2], axis=1)).max() > 3 * BOUND * STEP  # it is a bound that binds
    assert np.abs(np.diff(from_start[:, :, :2], axis=1)).max() <= BOUND * STEP * (1 + 1e-9)
    np.testing.assert_array_equal(kept.position[:, :, 2], free.position[:, :, 2])
    np.testing.assert_array_equal(kept.position[:, :, 1], -kept.position[:, :, 0])  # followers mirror exactly
    np.testing.assert_allclose(kept.position[:, ROWS - 1 :], free.position[:, ROWS - 1 :], rtol=0, atol=1e-12)
    rate = np.diff(from_start, axis=1)[:, : ROWS - 1, :2] / STEP
    np.testing.assert_allclose(kept.velocity[:, : ROWS - 1, :2], rate, atol=0.6)
    assert np.abs(kept.velocity[:, :, :2]).max() <= BOUND
    assert not kept.velocity[:, ROWS:].any()


def test_it_is_the_nearest_curve_that_keeps_to_the_speed() -> None:
    """Half the most by which any two instants are too far apart is what every such curve has to miss, and it misses no more."""
    random, rest = np.random.default_rng(3), 60
    for _ in range(5):
        middle = np.cumsum(random.normal(size=40)) * 0.05
        asked = np.concatenate([np.zeros(rest), middle, np.full(rest, middle[-1])])  # so that the ends do not count
        position = asked[None, :, None].copy()
        Slew((BOUND,), (0.0,)).limit(position, np.zeros_like(position), STEP)
        rows = range(len(asked))
        apart = max(abs(asked[i] - asked[j]) - BOUND * STEP * abs(i - j) for i in rows for j in rows)
        assert apart > 0.05
        assert np.abs(position[0, :, 0] - asked).max() == pytest.approx(apart / 2, abs=1e-12)


def test_the_last_rate_is_bounded_too_where_nothing_settles(weights: np.ndarray) -> None:
    kernels = GaussianKernels(kernels=8, variance=0.005)
    free = Policy(kernels, GROUPS, ROWS * STEP, STEP)
    assert np.abs(free.reference(weights).velocity[:, -1, :2]).max() > 2 * BOUND
    assert np.abs(replace(free, slew=slow()).reference(weights).velocity[:, :, :2]).max() <= BOUND


def test_a_free_final_posture_is_reached_no_faster(weights: np.ndarray) -> None:
    """As by the policy that the decision stands for."""
    free = FreePolicy(policy(slow()), goal=FreeGoal(np.array([0, 1]), np.full(2, -1.5), np.full(2, 1.5)))
    decisions = np.concatenate([weights, np.random.default_rng(5).uniform(-1.5, 1.5, size=(6, 2))], axis=1)
    found = free.reference(decisions)
    assert np.abs(np.diff(found.position[:, :, :2], axis=1)).max() <= BOUND * STEP * (1 + 1e-9)
    for trial, decision in enumerate(decisions):
        one, own = free.chosen(decision)
        np.testing.assert_allclose(found.position[trial], one.reference(own[None]).position[0], atol=1e-12)
        np.testing.assert_array_equal(found.position[trial, ROWS:], found.position[trial, [ROWS - 1] * 5])


def test_what_is_slow_enough_stays_to_the_bit(weights: np.ndarray) -> None:
    gentle = 0.01 * weights
    for free, kept in zip(
        *(
            (one.reference(gentle).position, one.reference(gentle).velocity)
            for one in (policy(None), policy(slow(50.0)))
        ),
        strict=True,
    ):
        np.testing.assert_array_equal(free, kept)


def test_the_batch_does_not_matter(weights: np.ndarray) -> None:
    whole = policy(slow()).reference(weights).position
    np.testing.assert_array_equal(whole[3], policy(slow()).reference(weights[3:4]).position[0])


def test_any_instant_and_a_file_give_the_same(weights: np.ndarray) -> None:
    one = policy(slow(), within=((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)))
    again = policy_from_dict(json.loads(json.dumps(policy_to_dict(one))))
    rows = one.reference(weights)
    np.testing.assert_array_equal(again.reference(weights).position, rows.position)
    position, velocity = again.at(weights, np.arange(1, ROWS + 1) * STEP)
    np.testing.assert_allclose(position, rows.position[:, :ROWS], atol=1e-12)
    np.testing.assert_allclose(velocity, rows.velocity[:, :ROWS], atol=1e-9)
    assert one.at(weights, np.array([0.0]))[0][0, 0].tolist() == list(START)
    halfway = one.at(weights, np.array([10.5 * STEP]))[0][:, 0]
    np.testing.assert_allclose(halfway, rows.position[:, 9:11].mean(axis=1), atol=1e-12)
    for broken in ({"speed": [1.0], "start": [0.0]}, {"speed": [0.0] * 3, "start": [0.0] * 3}, {"speed": 1}):
        with pytest.raises(LevadeError, match=r"^policy"):
            policy_from_dict({**policy_to_dict(one), "slew": broken})


def test_each_trial_of_a_free_policy_keeps_to_it_at_its_own_duration(weights: np.ndarray) -> None:
    free = FreePolicy(policy(slow()), horizon=(0.3, 1.2))
    decisions = free.decision(weights)
    decisions[:, -1] = np.linspace(-0.5, 0.5, 6)
    found = free.reference(decisions)
    lengths = free.lengths(decisions)
    assert len(set(lengths.tolist())) == 6
    for trial, steps in enumerate(lengths.tolist()):
        own = replace(policy(slow()), horizon=steps * STEP).reference(weights[trial : trial + 1])
        np.testing.assert_array_equal(found.position[trial, : steps + 5], own.position[0])
        np.testing.assert_array_equal(found.velocity[trial, : steps + 5], own.velocity[0])


def test_a_task_says_so_as_a_share_of_speed_limits() -> None:
    task = load_task("rearing", changes=["policy.slew=0.5"])
    robot = task.robot.load()
    made = make_policy(task, robot, start=np.full(12, 0.1))
    assert isinstance(made, Policy)
    assert made.slew == Slew(tuple((0.5 * robot.limits.velocity).tolist()), (0.1,) * 12)
    with pytest.raises(LevadeError, match=r"policy\.slew: 0\.0 should be"):
        load_task("rearing", changes=["policy.slew=0"])
