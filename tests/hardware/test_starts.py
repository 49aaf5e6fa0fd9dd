"""Rough motions: through postures that the legs have, and the best of them is where a search begins."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.hardware import Plan, starts
from levade.hardware.starts import rough_start, through_postures
from levade.policies import FreePolicy, Policy
from levade.robots import Robot, load_robot
from levade.search import Objective, make_objective
from levade.search.search import Search
from levade.tasks import load_task


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.fixture(scope="module")
def objective(robot: Robot) -> Objective:
    return make_objective(
        Plan.of(load_task("squat-jump", changes=["physics={timestep: 0.004}"]), robot).within_limits(1),
        robot=robot,
        threads=1,
    )


def test_legs_are_between_crouched_and_stretched(robot: Robot, objective: Objective) -> None:
    policy = objective.policy
    assert isinstance(policy, FreePolicy)
    decisions = through_postures(policy, robot, 200, np.random.default_rng(0))
    assert decisions is not None
    assert decisions.shape == (200, policy.size)
    knees = [i for i, name in enumerate(robot.joint_names) if name.endswith("kfe")]
    for i in range(0, 200, 20):
        inner, weights = policy.chosen(decisions[i])
        angles = inner.spread(weights.reshape(inner.independent_joints, -1).T)[:, knees]
        ends = np.stack([robot.posture(name)[knees] for name in ("crouched", "stretched")])
        assert (angles > ends.min(axis=0) - 0.5).all()  # five standard deviations of what is added
        assert (angles < ends.max(axis=0) + 0.5).all()
    shortest, longest = policy.bounds
    lengths = policy.lengths(decisions)
    assert (shortest, longest) == (pytest.approx(lengths.min(), rel=0.1), pytest.approx(lengths.max(), rel=0.1))


def test_in_half_of_them_front_and_hind_legs_are_equally_long(robot: Robot, objective: Objective) -> None:
    policy = objective.policy
    assert isinstance(policy, FreePolicy)
    decisions = through_postures(policy, robot, 100, np.random.default_rng(0))
    assert decisions is not None
    inner = policy.policy
    neutral = inner.project(robot.posture("neutral"))
    joints = [robot.joint_names[joint] for group in inner.groups for joint in group.leader]
    knees = [i for i, name in enumerate(joints) if name.endswith("kfe")]
    weights = decisions[:, : inner.size].reshape(100, len(joints), -1)[:, knees] - neutral[knees][:, None]
    front, hind = (np.abs(weights[:, i]) for i in range(2))  # they bend in opposite directions
    apart = np.abs(front - hind)
    assert 2 * apart[:50].mean() < apart[50:].mean()  # what is added is not the same


@pytest.mark.slow
def test_a_seed_gives_the_same_start_and_another_one_another(
    objective: Objective, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(starts, "ROUGH", 16)
    guess = rough_start(objective, seed=3)
    np.testing.assert_array_equal(guess.candidates, rough_start(objective, seed=3).candidates)
    assert (guess.candidates != rough_start(objective, seed=4).candidates).any()


@pytest.mark.slow
def test_the_search_begins_around_the_best(objective: Objective, monkeypatch: pytest.MonkeyPatch) -> None:
    n = 40
    monkeypatch.setattr(starts, "ROUGH", n)
    guess = rough_start(objective, seed=3)
    assert guess.candidates.shape == (n, objective.policy.size)
    search = Search(objective.task, objective.space, seed=3, initial=guess)
    weights = {name: cost.weight for name, cost in objective.task.costs.items()}
    tried, costs = 0, []
    while tried < n:  # in parts
        asked = search.ask()
        assert asked is not None
        np.testing.assert_array_equal(asked.weights, guess.candidates[tried : tried + asked.n])
        evaluation = objective.evaluate(asked)
        costs.append(evaluation.cost(weights))
        search.tell(evaluation)
        tried += asked.n
    cost = np.concatenate(costs)
    first = search.ask()
    assert first is not None
    far = np.linalg.norm(guess.candidates - first.weights.mean(axis=0), axis=1)
    assert far.argmin() == cost.argmin()
    # no motion of a start from nothing is as good, though there are as many
    space = objective.space
    drawn = space.candidates(space.step * np.random.default_rng(0).standard_normal((n, space.dimensions)))
    assert cost.min() < objective.evaluate(replace(first, weights=drawn)).cost(weights).min()


def test_a_robot_without_such_postures_has_none(robot: Robot, objective: Objective) -> None:
    inner = objective.policy.policy if isinstance(objective.policy, FreePolicy) else objective.policy
    assert isinstance(inner, Policy)
    bare = replace(robot, postures={"neutral": robot.posture("neutral")})
    assert through_postures(objective.policy, bare, 4, np.random.default_rng(0)) is None
    fixed = through_postures(inner, robot, 4, np.random.default_rng(0))
    assert fixed is not None
    assert fixed.shape == (4, inner.size)
