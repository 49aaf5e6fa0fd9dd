"""Motions one after another: where one ends the next begins, and all of them are one roll-out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.engines import MujocoEngine
from levade.errors import LevadeError
from levade.motions import Motion
from levade.motions.chaining import after, chain, end_of
from levade.motions.simulation import RecordedSimulation
from levade.rotations import roll_pitch_yaw
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task, task_from_dict, task_to_dict

SMALL = [
    *(
        "search.optimizer=cma",
        "search.population=6",
        "horizon=0.1",
        "hold=0.06",
        "search.polish=null",
        "search.trials=12",
    ),
    "start={settled: {posture: neutral, x: 0.4, y: -0.2}}",
]


@pytest.fixture(scope="module")
def motions() -> tuple[Motion, Motion]:
    """A short motion away from the origin, and one that begins at its end."""
    objective = make_objective(load_task("rearing", changes=SMALL), threads=1)
    first = record(objective, solve(objective, seed=1), seed=1)
    task = after(load_task("rearing", changes=[*SMALL, "policy.groups=sides"]), first)
    objective = make_objective(task, threads=1)
    return first, record(objective, solve(objective, seed=2), seed=2)


def test_the_next_motion_begins_at_the_end_over_the_origin(motions: tuple[Motion, Motion]) -> None:
    first, second = motions
    engine = RecordedSimulation(first).engine
    assert isinstance(engine, MujocoEngine)
    out, _ = engine.states(RecordedSimulation(first).start, first.reference, ["qpos", "qvel", "act"])
    qpos, yaw = out["qpos"][0, -1], roll_pitch_yaw(out["qpos"][0, -1, 3:7])[2]
    assert abs(yaw) > 1e-4
    assert abs(qpos[0]) > 0.3
    np.testing.assert_array_equal(second["qpos0"][:2], 0.0)
    np.testing.assert_array_equal(second["qpos0"][2], qpos[2])
    np.testing.assert_array_equal(second["qpos0"][7:], qpos[7:])
    np.testing.assert_array_equal(second["act0"], out["act"][0, -1])
    np.testing.assert_allclose(roll_pitch_yaw(second["qpos0"][3:7]), [*roll_pitch_yaw(qpos[3:7])[:2], 0.0], atol=1e-12)
    qvel = out["qvel"][0, -1]
    turned = [np.cos(yaw) * qvel[0] + np.sin(yaw) * qvel[1], np.cos(yaw) * qvel[1] - np.sin(yaw) * qvel[0]]
    np.testing.assert_allclose(second["qvel0"][:2], turned, atol=1e-12)
    np.testing.assert_array_equal(second["qvel0"][2:], qvel[2:])
    np.testing.assert_array_equal(second["joint_position_reference0"], first["joint_position_reference"][-1])


def test_played_as_one_they_do_what_they_do_one_by_one(motions: tuple[Motion, Motion]) -> None:
    start, reference = chain(motions)
    whole = RecordedSimulation(motions[0]).engine.rollout(start, reference)
    rows = motions[0].steps
    np.testing.assert_array_equal(whole.joint_position[0, :rows], motions[0]["joint_position"])
    # from there on in another place and direction, which physics does not mind
    np.testing.assert_allclose(whole.joint_position[0, rows : rows + 20], motions[1]["joint_position"][:20], atol=1e-6)
    np.testing.assert_allclose(
        whole.trunk_position[0, rows : rows + 20, 2], motions[1]["trunk_position"][:20, 2], atol=1e-6
    )


def test_the_start_is_in_the_task_to_the_bit(motions: tuple[Motion, Motion]) -> None:
    task = after(load_task("rearing", changes=SMALL), motions[0])
    assert task_from_dict(task_to_dict(task), where="task") == task
    assert motions[1].task.start == task.start


@pytest.mark.slow
def test_what_does_not_go_together_is_refused(motions: tuple[Motion, Motion], tmp_path: Path) -> None:
    first, second = motions
    with pytest.raises(LevadeError, match="there are no motions"):
        chain([])
    other = replace(second, meta={**second.meta, "timestep": 0.001})
    with pytest.raises(LevadeError, match="should be of one robot and time step"):
        chain([first, other])
    with pytest.raises(LevadeError, match="motion 2, rearing, does not begin where rearing ends: a joint is"):
        chain([second, first])
    task = load_task("rearing")
    with pytest.raises(LevadeError, match="the motion is of hyq2max and the task of go1; should be the same robot"):
        after(replace(task, robot=replace(task.robot, name="go1")), first)
    with pytest.raises(LevadeError, match="only those of mujoco"):
        end_of(replace(first, meta={**first.meta, "engine": "ode"}))
    wrong = replace(load_task("rearing"), start=after(load_task("rearing"), first).start)
    state = wrong.start.state
    assert state is not None
    with pytest.raises(LevadeError, match=r"start.state.qpos: 3 numbers, should be 19"):
        make_objective(replace(wrong, start=replace(wrong.start, state=replace(state, qpos=(0.0, 0.0, 1.0)))))
