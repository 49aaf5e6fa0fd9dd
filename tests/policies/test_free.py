"""Decisions besides weights: a trial's own duration and final posture are those of a policy that has them fixed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.policies import Ends, Follower, FreeGoal, FreePolicy, GaussianKernels, Group, Policy

HOLD = 7


@pytest.fixture(scope="module")
def policy() -> Policy:
    """Two independent joints, the second of which another one mirrors."""
    groups = (Group((0,)), Group((1,), (Follower((2,), (-1.0,)),)))
    ends = Ends(np.array([0.1, 0.2, -0.2]), np.array([0.3, -0.4, 0.4]), depart=0.2, settle=0.4)
    return Policy(GaussianKernels(5), groups, 0.2, 0.002, HOLD, ends)


@pytest.fixture(scope="module")
def decisions(policy: Policy) -> np.ndarray:
    random = np.random.default_rng(1)
    return np.concatenate([random.normal(size=(6, policy.size)), random.normal(scale=0.6, size=(6, 3))], axis=1)


@pytest.fixture(scope="module")
def goal() -> FreeGoal:
    return FreeGoal(np.array([0, 1]), np.array([-0.5, -1.0]), np.array([0.5, 1.0]))


def test_a_trial_has_the_bits_of_a_policy_of_its_duration(policy: Policy, decisions: np.ndarray) -> None:
    free = FreePolicy(policy, (0.1, 0.5))
    asked = decisions[:, : policy.size + 1]
    reference = free.reference(asked)
    assert reference.horizons is not None
    assert len(set(reference.horizons.tolist())) > 3
    for i, steps in enumerate(reference.horizons):
        own, weights = free.chosen(asked[i])
        assert own.horizon_steps == steps == np.clip(round(0.2 * np.exp(asked[i, -1]) / 0.002), 50, 250)
        one = own.reference(weights[None])
        np.testing.assert_array_equal(reference.position[i, : steps + HOLD], one.position[0])
        np.testing.assert_array_equal(reference.velocity[i, : steps + HOLD], one.velocity[0])
        assert (reference.position[i, steps + HOLD :] == one.position[0, -1]).all()
        assert not reference.velocity[i, steps:].any()


def test_the_final_posture_is_the_one_decided_within_its_bounds(
    policy: Policy, decisions: np.ndarray, goal: FreeGoal
) -> None:
    free = FreePolicy(policy, (0.1, 0.5), goal)
    reference = free.reference(decisions)
    angles = np.clip(decisions[:, -2:], goal.lower, goal.upper)
    np.testing.assert_allclose(reference.position[:, -1], np.c_[angles, -angles[:, 1]], atol=1e-14)
    for i in range(len(decisions)):
        own, weights = free.chosen(decisions[i])
        rows = own.horizon_steps + HOLD
        one = own.reference(weights[None])
        np.testing.assert_allclose(reference.position[i, :rows], one.position[0], atol=1e-13)
        np.testing.assert_allclose(reference.velocity[i, :rows], one.velocity[0], atol=1e-10)


def test_the_policys_own_decisions_give_its_own_reference(policy: Policy, decisions: np.ndarray) -> None:
    goal = FreeGoal(np.array([1]), np.array([-1.0]), np.array([1.0]))
    weights = decisions[:, : policy.size]
    for free in (FreePolicy(policy, (0.1, 0.5)), FreePolicy(policy, goal=goal), FreePolicy(policy, (0.1, 0.5), goal)):
        reference = free.reference(free.decision(weights))
        rows = policy.horizon_steps + HOLD
        np.testing.assert_array_equal(reference.position[:, :rows], policy.reference(weights).position)


def test_the_velocity_is_the_rate_of_the_position(policy: Policy, decisions: np.ndarray, goal: FreeGoal) -> None:
    fine = Policy(policy.kernels, policy.groups, 0.2, 1e-4, HOLD, policy.ends)
    reference = FreePolicy(fine, (0.1, 0.5), goal).reference(decisions)
    assert reference.horizons is not None
    for i, steps in enumerate(reference.horizons):
        rate = np.gradient(reference.position[i, :steps], 1e-4, axis=0)[1:-1]
        np.testing.assert_allclose(reference.velocity[i, 1 : steps - 1], rate, atol=2e-2)


def test_a_motion_of_any_duration_and_end_is_imitated(policy: Policy, decisions: np.ndarray, goal: FreeGoal) -> None:
    free = FreePolicy(policy, (0.1, 0.5), goal)
    own, weights = free.chosen(decisions[0])
    position = own.reference(weights[None], hold_steps=0).position[0]
    near = free.reference(free.imitate(position), hold_steps=0)
    assert near.horizons is not None
    assert near.horizons[0] == own.horizon_steps
    np.testing.assert_allclose(near.position[0, : own.horizon_steps], position, atol=2e-3)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda p: FreePolicy(p), "neither the horizon nor the goal is free"),
        (lambda p: FreePolicy(p, (0.3, 0.5)), "around the policy's own, 0.2 s"),
        (lambda p: FreePolicy(p, (0.1, 0.5)).reference(np.zeros((1, 3))), r"expected \(n, 11\)"),
        (lambda p: FreePolicy(p, (0.1, 0.5)).reference(np.full((1, 11), np.nan)), "not finite"),
        (lambda p: FreeGoal(np.array([0]), np.array([1.0]), np.array([0.0])), "make no range"),
    ],
)
def test_what_makes_no_sense_is_refused(policy: Policy, make, says: str) -> None:
    with pytest.raises(LevadeError, match=says):
        make(policy)


def test_references_within_ranges_are_those_of_the_chosen_policy(
    policy: Policy, decisions: np.ndarray, goal: FreeGoal
) -> None:
    """Where the end moves, too: what is simulated is what the file's policy says."""
    ends = (tuple([-0.3] * policy.joints), tuple([0.3] * policy.joints))
    free = FreePolicy(replace(policy, within=ends), (0.1, 0.5), goal)
    reference = free.reference(decisions)
    assert (np.abs(reference.position) <= 0.3).all()
    assert (np.abs(reference.position) == 0.3).any()
    for i in range(len(decisions)):
        own, weights = free.chosen(decisions[i])
        rows = own.horizon_steps + HOLD
        np.testing.assert_allclose(reference.position[i, :rows], own.reference(weights[None]).position[0], atol=1e-13)
