"""Goals above what the legs reach are refused, with the numbers that say so."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from levade.costs import Criterion, Position
from levade.errors import LevadeError
from levade.scenes import Box, Scene
from levade.search import make_objective
from levade.tasks import Cost, Stage, Task, load_task
from levade.tasks.task import RobotChoice

# of the robot in conftest.py: hips 0.2 m ahead and 0.08 m aside, 0.05 m further out to the legs of 2 x 0.2 m, feet of 0.02 m
LEG, HIP = 0.05 + 0.4 + 0.02, (0.2**2 + 0.08**2) ** 0.5
HIGHEST = LEG + HIP


@pytest.fixture
def task(tmp_path: Path, quadruped: type) -> Task:
    (tmp_path / "toy.urdf").write_text(quadruped().urdf())
    plain = load_task("rearing", changes=["search.population=8", "horizon=0.02", "start.settled.time=0"])
    robot = RobotChoice(str(tmp_path / "toy.urdf"))
    return replace(plain, robot=robot, success={}, stages=(Stage(),), costs={"z": Cost(Position(z=0.3), 1.0)})


def asking(task: Task, criterion: Criterion, **other) -> Task:
    return replace(task, success={"goal": criterion}, **other)


@pytest.mark.parametrize(
    ("criterion", "key"),
    [
        (Criterion("height", target=HIGHEST + 0.05, tolerance=0.01), "target"),
        (Criterion("height", minimum=HIGHEST + 0.03), "minimum"),
        (Criterion("height", minimum=HIGHEST + 0.03, at="min"), "minimum"),
        (Criterion("height", target=HIGHEST + 0.05, tolerance=0.01, at="end"), "target"),
    ],
)
def test_a_height_above_the_stretched_leg_and_the_trunk_is_refused(task: Task, criterion: Criterion, key: str) -> None:
    least = criterion.minimum or criterion.target - criterion.tolerance
    message = (
        f"success.goal.{key}: asks for {least:.2f} m, but the trunk's centre of mass of toy is at {HIGHEST:.2f} m at most"
        f" with a foot on the ground (leg {LEG:.2f} m, hip to centre of mass {HIP:.2f} m); ask for less"
    )
    with pytest.raises(LevadeError, match=f"^{re.escape(message)}"):
        make_objective(asking(task, criterion))


@pytest.mark.slow
@pytest.mark.parametrize(
    "criterion",
    [
        Criterion("height", target=HIGHEST + 0.05, tolerance=0.06),
        Criterion("height", maximum=9.0),
        Criterion("height", minimum=HIGHEST + 0.5, at="max"),  # the apex of a jump
        Criterion("x", minimum=9.0),
    ],
)
def test_a_height_within_reach_or_of_a_jump_is_accepted(task: Task, criterion: Criterion) -> None:
    make_objective(asking(task, criterion))  # does not raise


HIGH = {"z": Cost(Position(z=HIGHEST + 0.1), 1.0)}
IDLE = {"z": Cost(Position(z=HIGHEST + 0.1), 0.0), "low": Cost(Position(z=0.3), 1.0)}
"""A cost that asks for a height out of reach, with a weight and without."""


@pytest.mark.slow
def test_a_cost_that_pulls_out_of_reach_is_refused(task: Task) -> None:
    with pytest.raises(LevadeError, match=r"^costs\.z\.z: asks for 0\.79 m, but"):
        make_objective(replace(task, costs=HIGH))


@pytest.mark.slow
def test_a_cost_without_weight_pulls_only_in_a_stage_that_gives_it_one(task: Task) -> None:
    make_objective(replace(task, costs=IDLE))  # does not raise
    with pytest.raises(LevadeError, match=r"^costs\.z\.z: "):
        make_objective(replace(task, costs=IDLE, stages=(Stage(weights={"z": 1.0}),)))


def test_a_cost_may_pull_out_of_reach_where_the_task_is_a_jump(task: Task) -> None:
    make_objective(asking(task, Criterion("height", minimum=1.0, at="max"), costs=HIGH))  # does not raise


@pytest.mark.slow
def test_the_height_of_the_scene_adds_to_the_reach(task: Task) -> None:
    """A step of 0.3 m raises what can be reached; a slope has no highest place."""
    high = asking(task, Criterion("height", minimum=HIGHEST + 0.25))
    with pytest.raises(LevadeError, match=r"^success\.goal"):
        make_objective(high)
    make_objective(replace(high, scene=Scene(boxes=(Box((1.5, 0.0, 0.15), (1.0, 1.0, 0.3)),))))
    make_objective(replace(high, scene=Scene(slope=0.1)))
    with pytest.raises(LevadeError, match=r"hip to centre of mass 0\.22 m, 0\.10 m of the scene\)"):
        make_objective(replace(high, scene=Scene(boxes=(Box((1.5, 0.0, 0.05), (1.0, 1.0, 0.1)),))))


@pytest.mark.slow
def test_more_distance_between_parts_than_a_posture_leaves_is_refused(task: Task) -> None:
    """The thighs of the two sides are 0.24 m apart, less two radii."""
    near = Criterion("self_distance", minimum=0.9, at="min")
    with pytest.raises(
        LevadeError, match=r"^success.goal.minimum: asks for 900 mm between the parts of toy, but \w+ and \w+"
    ):
        make_objective(asking(task, near))
    make_objective(asking(task, replace(near, minimum=0.001)))
