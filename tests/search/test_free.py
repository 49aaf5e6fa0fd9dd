"""Duration and final posture as decisions of a search: each trial its own, and the motion that is kept has them fixed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.costs import Criterion
from levade.errors import LevadeError
from levade.motions import Motion, ReferenceCurve
from levade.policies import FreePolicy, Policy
from levade.search import Generation, Objective, Stopped, Trials, make_objective, solve
from levade.search.initial import initial_guess
from levade.search.objective import evaluate_many
from levade.search.recording import record
from levade.search.run import MOTION, resume, run
from levade.tasks import HorizonRange, load_task, task_text
from levade.tasks.policy import goal_posture

RANGE = "horizon={minimum: 60 ms, maximum: 0.3 s, initial: 0.12}"
SMALL = [
    *("search.optimizer=cma", "search.population=6", "hold=0.04", "search.polish=null", "search.trials=36"),
    "success={pitch: {target: 0, tolerance: 0.2}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
]
GOAL = ["policy.goal={hind: free, front: crouched}", "policy.settle=0.4"]


@pytest.fixture(scope="module")
def free() -> Objective:
    return make_objective(load_task("rearing", changes=[*SMALL, RANGE]), threads=1)


@pytest.fixture(scope="module")
def decisions(free: Objective) -> np.ndarray:
    space, random = free.space, np.random.default_rng(0)
    return space.mean + 3 * space.step * random.standard_normal((7, space.factor.shape[1])) @ space.factor.T


@pytest.mark.slow
def test_a_trial_achieves_what_it_does_in_a_task_of_its_horizon(free: Objective, decisions: np.ndarray) -> None:
    assert isinstance(free.policy, FreePolicy)
    found = free.evaluate(decisions)
    lengths = free.policy.lengths(decisions)
    assert len(set(lengths.tolist())) > 4
    for i, steps in enumerate(lengths):
        fixed = make_objective(load_task("rearing", changes=[*SMALL, f"horizon={steps * 0.002}"]), threads=1)
        alone = fixed.evaluate(decisions[i : i + 1, :-1])
        for name, errors in alone.errors.items():
            assert errors[0] == found.errors[name][i]
        for name, values in alone.terms.items():
            np.testing.assert_allclose(found.terms[name][i], values[0], rtol=1e-12)


@pytest.mark.parametrize(("step", "wide"), [(0.3, 0.08), (0.05, 0.015)])
def test_a_search_begins_as_close_around_its_duration_as_around_its_motion(
    free: Objective, step: float, wide: float
) -> None:
    """The duration has a coordinate of its own, in which no candidate is aimed."""
    task = replace(free.task, search=replace(free.task.search, step=step))
    space = free.with_task(task).space
    assert space.rough is not None
    spread = space.step * space.factor[:, space.rough]
    np.testing.assert_allclose(spread[-1], [wide])
    assert not spread[:-1].any()
    assert not space.factor[-1, ~space.rough].any()


def drawn_goals(goal: str) -> tuple[Objective, np.ndarray]:
    """Final postures that a search draws first, less the one that it begins with, shape (n, k)."""
    changes = [*SMALL, "policy.groups=independent", "policy.settle=0.4", f"policy.goal={goal}"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    assert isinstance(objective.policy, FreePolicy)
    space = objective.space
    drawn = np.random.default_rng(0).standard_normal((300, space.factor.shape[1])) @ space.factor.T
    return objective, objective.policy.goals(space.mean + space.step * drawn) - objective.policy.goals(space.mean[None])


@pytest.mark.slow
def test_final_postures_that_are_tried_first_hardly_push_the_feet_apart_but_raise_and_turn_the_trunk() -> None:
    """Feet that stand do not slip, so joints as stiff as servos would push them against each other."""
    objective, moved = drawn_goals("free")
    robot, step = objective.robot, objective.space.step
    alone = step * np.random.default_rng(1).standard_normal(moved.shape)

    def stood(change: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        feet = np.array([robot.foot_positions(robot.posture("neutral") + one) for one in 0.1 * change])
        i, j = np.triu_indices(4, 1)
        return np.linalg.norm(feet[:, i] - feet[:, j], axis=-1).std(axis=0), feet[:, :, 2].mean(axis=1).std()

    (apart, height), (apart_alone, height_alone) = stood(moved), stood(alone)
    assert (apart < 0.15 * apart_alone).all()
    assert height > 0.6 * height_alone


def test_a_range_says_where_to_look_for_a_final_angle() -> None:
    objective, moved = drawn_goals('{"?f_kfe": [-2.8, -0.1], "?h_kfe": [0.1, 2.8]}')
    angles = moved[:, [name.endswith("_kfe") for name in objective.robot.joint_names]]
    np.testing.assert_allclose(
        np.cov(angles.T), objective.space.step**2 * np.eye(4), atol=0.2 * objective.space.step**2
    )


def test_trials_are_simulated_no_longer_than_they_need(free: Objective, decisions: np.ndarray) -> None:
    assert isinstance(free.policy, FreePolicy)
    before = free.engine.steps
    free.evaluate(Trials(decisions, hold_steps=5))
    assert free.engine.steps - before == (free.policy.lengths(decisions) + 5).sum()


def test_a_trial_has_the_same_bits_in_any_batch(free: Objective, decisions: np.ndarray) -> None:
    together = free.evaluate(decisions)
    fixed = free.with_task(load_task("rearing", changes=[*SMALL, "horizon=0.3"]))
    parts = [
        (free, Trials(decisions[2:3], 20)),
        (fixed, Trials(decisions[:2, :-1], 20)),
        (free, Trials(decisions[3:], 20)),
    ]
    first, _, rest = evaluate_many(parts)
    for tables in ("terms", "errors"):
        for name, values in getattr(together, tables).items():
            np.testing.assert_array_equal(values[2:], np.r_[getattr(first, tables)[name], getattr(rest, tables)[name]])


def test_a_trial_that_breaks_down_takes_nobody_with_it(free: Objective, decisions: np.ndarray) -> None:
    wild = decisions.copy()
    wild[3, :-1] = 1e30
    found, before = free.evaluate(wild), free.evaluate(decisions)
    assert found.diverged.tolist() == [False] * 3 + [True] + [False] * 3
    kept = [0, 1, 2, 4, 5, 6]
    np.testing.assert_array_equal(found.terms["effort"][kept], before.terms["effort"][kept])


@pytest.mark.slow
@pytest.mark.parametrize("changes", [[RANGE], GOAL, [RANGE, *GOAL]], ids=["duration", "posture", "both"])
def test_the_motion_that_is_kept_has_its_own(changes: list[str], tmp_path: Path) -> None:
    objective = make_objective(load_task("rearing", changes=[*SMALL, *changes]), threads=1)
    outcome = run(objective, seed=3, directory=tmp_path)
    motion, policy = Motion.load(tmp_path / MOTION), objective.policy
    assert isinstance(policy, FreePolicy)
    assert isinstance(motion.policy, Policy)
    assert motion.policy.horizon_steps == motion.horizon_steps == round(motion.horizon / motion.timestep)
    assert motion.steps == motion.horizon_steps + 20 == len(motion["time"]) == len(motion["ctrl"])
    assert policy.bounds[0] <= motion.horizon_steps <= policy.bounds[1]
    assert ReferenceCurve.of(motion).policy is not None  # weights and policy of the file give its rows
    np.testing.assert_allclose(motion["time"][-1], motion.horizon + 0.04)
    best = outcome.solution.best.weights
    reference = motion["joint_position_reference"]
    if policy.goal is not None:
        settled = policy.goals(best[None])[0]
        np.testing.assert_allclose(reference[-1], settled, atol=1e-12)
        front = objective.robot.posture({"front": "crouched"})[:6]
        np.testing.assert_allclose(settled[:6], front)
        assert np.abs(settled[6:] - objective.robot.posture("neutral")[6:]).max() > 0.01
    near = initial_guess(policy, motion).candidates
    again = policy.reference(near, hold_steps=20).position[0, : len(reference)]
    np.testing.assert_allclose(again, reference, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(near[0, : policy.policy.size], motion["weights"])


@pytest.mark.slow
def test_a_search_resumes_to_the_same_motion(tmp_path: Path) -> None:
    objective = make_objective(load_task("rearing", changes=[*SMALL, RANGE, *GOAL]), threads=1)
    whole = run(objective, seed=1, directory=tmp_path / "whole").motion

    def stop(generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if generation.trials >= 18 else None

    assert run(objective, seed=1, directory=tmp_path / "part", observe=stop).solution.trials < 36
    part = resume(tmp_path / "part", objective=objective).motion
    for name in ("weights", "joint_position", "time"):
        np.testing.assert_array_equal(part[name], whole[name])


@pytest.mark.slow
def test_a_search_finds_the_duration_that_a_task_asks_for() -> None:
    """Rearing in 0.45 s at least, from a first guess of 0.3 s: and no more than that, as time costs."""
    task = load_task("rearing", changes=["horizon={minimum: 0.2, maximum: 0.9, initial: 0.3}"])
    task = replace(task, success={**task.success, "duration": Criterion("duration", minimum=0.45)})
    objective = make_objective(task)
    motion = record(objective, solve(objective, seed=100), seed=100)
    assert motion.result.success
    assert 0.45 <= motion.horizon <= 0.9


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        (["horizon={minimum: 0.5, maximum: 0.3}"], "horizon.minimum: 0.5 s is above the maximum"),
        (["horizon={minimum: 0.1, maximum: 0.3, initial: 0.4}"], "horizon.initial: 0.4 s should be within the bounds"),
        (["horizon={minimum: 0.1}"], "horizon.maximum: missing"),
        (["horizon={minimum: 0.1, maxmum: 0.3}"], "no 'maxmum'|maximum"),
        (["horizon=free"], "horizon: should be a number of seconds, or bounds .*minimum: 0.3 s.* is 'free'"),
        (["horizon=[0.3, 1.5]"], "bounds for the search such as .*is a list"),
        (["policy.goal=fre", "policy.settle=0.4"], "policy.goal: no posture 'fre'; did you mean free"),
        (["horizon={minimum: 0.0001, maximum: 0.3}"], "at least one time step"),
        (["policy.goal=free"], "policy.goal: is free, but no reference settles there"),
        (["policy.goal={hnd: free}", "policy.settle=0.4"], "no leg or joint 'hnd'.*hind"),
        (['policy.goal={"lf_kfe": free}', "policy.settle=0.4"], "lf_kfe and rf_kfe share a policy"),
        (['policy.goal={"*_kfe": [-9, 9]}', "policy.settle=0.4"], "should be a range within that of lf_kfe"),
    ],
)
def test_what_makes_no_sense_is_one_line(changes: list[str], says: str) -> None:
    with pytest.raises(LevadeError, match=says) as error:
        make_objective(load_task("rearing", changes=changes))
    assert "\n" not in str(error.value)


def test_a_goal_like_another_tasks_start_is_its_posture(tmp_path: Path) -> None:
    task = load_task("rearing", changes=["policy.settle=0.4", "policy.goal={like: sit-to-stand}"])
    assert task.policy.goal == {"hind": "crouched"}
    assert load_task("rearing", changes=["policy.goal={like: rearing}"]).policy.goal == "neutral"
    with pytest.raises(LevadeError, match="posture-recovery does not start standing in a posture"):
        load_task("rearing", changes=["policy.goal={like: posture-recovery}"])
    with pytest.raises(LevadeError, match=r"policy.goal.like: no task 'sit-to-stnd'; did you mean sit-to-stand"):
        load_task("rearing", changes=["policy.goal={like: sit-to-stnd}"])


@pytest.mark.slow
def test_a_goal_like_a_file_is_relative_to_the_task_file(
    free: Objective, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A task next to it, and a motion; with a file of the same name where one is, which is not meant."""
    away = tmp_path / "away"
    for folder in (away, tmp_path / "sit"):
        folder.mkdir()
    (tmp_path / "next.yaml").write_text("name: next\nstart: {settled: {posture: {front: crouched}}}\n")
    (away / "next.yaml").write_text("name: other\nstart: {settled: {posture: stretched}}\n")
    text = task_text("sit-to-stand").replace("goal: neutral", "goal: {like: next.yaml}")
    (tmp_path / "sit.yaml").write_text(text)
    (tmp_path / "on.yaml").write_text(text.replace("next.yaml", "./sit/motion.npz"))
    monkeypatch.chdir(away)
    assert load_task("../sit.yaml").policy.goal == {"front": "crouched"}
    assert load_task("sit-to-stand", changes=["policy.goal={like: next.yaml}"]).policy.goal == "stretched"

    record(free, solve(free, seed=0), seed=0).save(tmp_path / "sit" / "motion.npz")
    task = load_task("../on.yaml")
    assert isinstance(task.policy.goal, dict)
    np.testing.assert_array_equal(goal_posture(task.policy, free.robot), free.robot.posture("neutral"))


def test_a_goal_like_a_motion_that_has_none_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "motion.npz"
    start = np.array('{"task": {"start": {"settled": null, "fall": {"height": 0.65}}}}')
    np.savez(path, joint_names=np.array(["lf_haa"]), joint_position_reference0=np.zeros(1), meta=start)
    with pytest.raises(LevadeError, match="does not start standing in a posture; name a motion that does"):
        load_task("rearing", changes=[f"policy.goal={{like: {path}}}"])
    np.savez(
        path, joint_names=np.array(["a\x1b"]), joint_position_reference0=np.zeros(1), meta=np.array('{"task": {}}')
    )
    with pytest.raises(LevadeError, match="its start cannot be read; the file is damaged"):
        load_task("rearing", changes=[f"policy.goal={{like: {path}}}"])
    np.savez(path, other=np.zeros(1))
    with pytest.raises(LevadeError, match="commanded posture before the start is missing"):
        load_task("rearing", changes=[f"policy.goal={{like: {path}}}"])
    with pytest.raises(LevadeError, match=r"policy.goal.like: .*nowhere.npz: no such file"):
        load_task("rearing", changes=["policy.goal={like: nowhere.npz}"])


def test_a_range_of_horizons_begins_in_the_middle_of_its_logarithm() -> None:
    task = load_task("rearing", changes=["horizon={minimum: 0.2, maximum: 0.8}"])
    assert isinstance(task.horizon, HorizonRange)
    assert task.horizon.begin == pytest.approx(0.4)
    assert task.horizon_steps == 400
