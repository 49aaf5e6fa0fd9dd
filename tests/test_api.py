"""The Python face: lazy, with objects wherever there may be names, and motions that know the Python code behind them."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

import levade
from levade.engines import ENGINES, EngineKind
from levade.optimizers import SearchSpace
from levade.search import InitialGuess, make_objective
from levade.tasks.code import MissingCode
from levade.trajectory import JointReference, Trajectories

SMALL = [
    *("search.optimizer=cma", "search.population=6", "search.trials=12", "search.polish=null", "horizon=0.06"),
    "success={pitch: {target: 0, tolerance: 0.2}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
]


@pytest.fixture(scope="module")
def task() -> levade.Task:
    return levade.load_task("rearing", changes=SMALL)


@pytest.fixture(scope="module")
def found(task: levade.Task) -> levade.Result:
    return levade.solve(task, seed=2)


def fastest(trajectories: Trajectories) -> np.ndarray:
    return (trajectories.joint_velocity**2).max(axis=(1, 2))


def knee(trajectories: Trajectories, rows: slice) -> np.ndarray:
    return trajectories.joint_position[:, rows, 2]


class Climber:
    """The least that an optimizer can be."""

    def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...]) -> None:
        self.space, self.random, self.told = space, np.random.default_rng(seed), 0

    def ask(self) -> np.ndarray:
        return self.space.mean + 0.01 * self.random.standard_normal((6, self.space.size))

    def tell(self, cost: np.ndarray) -> None:
        self.told += len(cost)


class Bend:
    """A policy of two weights: how far the front and the hind knees bend, in a ramp."""

    size, joints, horizon_steps = 2, 12, 30

    def initial_weights(self, posture: np.ndarray) -> np.ndarray:
        self.posture = posture
        return np.zeros(2)

    def reference(self, weights: np.ndarray, *, hold_steps: int | None = None) -> JointReference:
        share = np.minimum(np.arange(1, 31 + (hold_steps or 0)) / 30, 1.0)
        by_joint = np.zeros((len(weights), 12))
        by_joint[:, [2, 5]], by_joint[:, [8, 11]] = weights[:, :1], weights[:, 1:]
        neutral = levade.load_robot("hyq2max").posture("neutral")
        position = neutral + share[None, :, None] * by_joint[:, None]
        velocity = np.broadcast_to(by_joint[:, None] / 0.06, position.shape).copy()
        return JointReference(position, velocity, 0.002, 30)


def python(program: str) -> str:
    return subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout.strip()


# the face


@pytest.mark.slow
def test_import_levade_loads_nothing_that_takes_long() -> None:
    heavy = "import levade, sys; print({'numpy', 'mujoco', 'cma', 'pydantic'} & set(sys.modules))"
    assert python(heavy) == "set()"
    assert python("import levade, sys; levade.Motion; print('mujoco' in sys.modules)") == "True"


def test_every_name_of_the_face_is_there() -> None:
    assert all(getattr(levade, name) is not None for name in levade.__all__)
    assert set(levade.__all__) <= set(dir(levade))


def test_an_unknown_name_is_told_the_nearest() -> None:
    with pytest.raises(AttributeError, match="module 'levade' has no attribute 'solve_may'; did you mean solve_many"):
        _ = levade.solve_may


def test_types_are_in_the_package_that_is_built() -> None:
    assert files("levade").joinpath("py.typed").is_file()
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["tool"]["hatch"]["build"]["targets"]["wheel"] == {"packages": ["src/levade"]}


# what solve gives back


def test_a_result_says_what_was_found(found: levade.Result) -> None:
    assert found.success
    assert found.motion.result.success
    assert found.trials == found.solution.trials <= 12
    assert repr(found) == f"Result(success at trial {found.solution.trials_to_success}, {found.motion!r})"
    assert repr(found.motion).startswith("Motion(rearing on hyq2max: success, T = 0.06 s")
    again = found.objective.evaluate(found.motion["weights"][None])
    assert again.errors["pitch"][0] == found.motion.result.errors["pitch"]


def test_a_motion_suggests_the_nearest_array(found: levade.Result) -> None:
    with pytest.raises(levade.LevadeError, match="no array 'joint_positions'; did you mean joint_position"):
        _ = found.motion["joint_positions"]


@pytest.mark.slow
def test_a_run_in_a_directory_finds_the_same(task: levade.Task, found: levade.Result, tmp_path: Path) -> None:
    kept = levade.solve(task, seed=2, out=tmp_path / "run")
    np.testing.assert_array_equal(kept.motion["ctrl"], found.motion["ctrl"])
    loaded = levade.Motion.load(tmp_path / "run" / "motion.npz")
    np.testing.assert_array_equal(loaded["ctrl"], found.motion["ctrl"])


@pytest.mark.slow
def test_a_motion_or_its_file_may_be_given(found: levade.Result, tmp_path: Path) -> None:
    found.motion.save(tmp_path / "motion.npz")
    one = levade.export(found.motion, "csv", tmp_path / "one")
    other = levade.export(tmp_path / "motion.npz", "csv", tmp_path / "other")
    assert [file.name for file in one.written] == [file.name for file in other.written]
    page = levade.show(found.motion, tmp_path / "page.html", browse=False)
    assert "<html" in page.read_text(encoding="utf-8")


# many at once


@pytest.mark.slow
def test_many_are_what_each_is_alone(task: levade.Task, found: levade.Result) -> None:
    first, second, third = levade.solve_many([task, task, task], seeds=[1, 2, 2], trials=12)
    np.testing.assert_array_equal(second.motion["ctrl"], found.motion["ctrl"])
    np.testing.assert_array_equal(third.motion["ctrl"], found.motion["ctrl"])
    assert not np.array_equal(first.motion["weights"], second.motion["weights"])
    assert second.objective is first.objective  # built once


# robots


@pytest.mark.slow
def test_a_robot_may_be_an_object_a_file_or_a_spec(task: levade.Task, quadruped: Any, tmp_path: Path) -> None:
    text = quadruped().mjcf()
    (tmp_path / "toy.xml").write_text(text, encoding="utf-8")
    path = tmp_path / "toy.xml"
    given = (path, str(path), levade.load_robot(path), mujoco.MjSpec.from_string(text))
    low = replace(task, costs={"effort": task.costs["effort"]}, stages=task.stages[-1:], success={})
    motions = [levade.solve(low, robot=robot).motion for robot in given]
    for motion in motions[1:]:
        np.testing.assert_array_equal(motion["ctrl"], motions[0]["ctrl"])
    assert [motion.robot for motion in motions] == ["toy"] * 4


@pytest.mark.slow
def test_a_spec_that_was_a_robots_keeps_what_is_known_of_it(task: levade.Task, found: levade.Result) -> None:
    robot = levade.load_robot("hyq2max")
    same = levade.load_robot(robot.spec(), like="hyq2max")
    assert same.name == "hyq2max-changed"
    assert repr(same) == "Robot(hyq2max-changed: 12 joints, legs lf, rf, lh, rh)"
    np.testing.assert_array_equal(same.actuation.torque, robot.actuation.torque)
    motion = levade.solve(task, seed=2, robot=same).motion
    np.testing.assert_allclose(motion["joint_position"], found.motion["joint_position"], rtol=1e-6)

    spec = robot.spec()
    load = spec.body("trunk").add_body(name="load")
    load.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0], mass=8, contype=0, conaffinity=0)
    loaded = levade.load_robot(spec, like=robot)
    assert loaded.model.body_subtreemass[0] == pytest.approx(robot.model.body_subtreemass[0] + 8)
    assert len(list(spec.actuators)) == 12  # what was given is not changed


@pytest.mark.slow
def test_a_spec_with_actuators_of_two_controls_is_understood_on_its_own() -> None:
    robot = levade.load_robot(levade.load_robot("hyq2max").spec())
    assert robot.joint_names == levade.load_robot("hyq2max").joint_names


def test_a_spec_with_other_joints_is_refused_in_one_line() -> None:
    robot = levade.load_robot("hyq2max")
    spec = mujoco.MjSpec.from_string(robot.mjcf)
    tail = spec.body("trunk").add_body(name="tail", mass=1, inertia=[0.01, 0.01, 0.01])
    tail.add_joint(name="wag")
    with pytest.raises(levade.LevadeError, match=r"robot .*: hyq2max has no joint 'wag'; load the spec on its own"):
        levade.load_robot(spec, like=robot)
    spec = mujoco.MjSpec.from_string(robot.mjcf)
    spec.geom("lh_foot").name = "hoof"
    with pytest.raises(levade.LevadeError, match=r"robot .*: no geom 'lh_foot', which hyq2max has"):
        levade.load_robot(spec, like=robot)
    with pytest.raises(levade.LevadeError, match=r"like goes with a mujoco\.MjSpec"):
        levade.load_robot("hyq2max", like="hyq2max")


# optimizers, policies, engines


@pytest.mark.slow
@pytest.mark.parametrize("ready", [False, True])
def test_an_optimizer_may_be_a_class_or_an_object(task: levade.Task, found: levade.Result, ready: bool) -> None:
    optimizer = Climber(found.objective.space, seed=0) if ready else Climber
    result = levade.solve(task, optimizer=optimizer)
    assert result.trials == 12
    if ready:
        assert optimizer.told == 12
    assert "Climber" in str(result.motion.meta["task"]["search"]["optimizer"])


@pytest.mark.slow
@pytest.mark.parametrize("policy", [Bend(), lambda task, robot: Bend()], ids=["object", "function"])
def test_a_policy_may_be_ones_own(task: levade.Task, policy: Any) -> None:
    result = levade.solve(task, policy=policy)
    assert result.motion["weights"].shape == (2,)
    assert result.motion.policy is None  # the file cannot hold it
    bent = result.motion["joint_position_reference"][-1] - result.motion["joint_position_reference0"]
    np.testing.assert_allclose(bent[[2, 5, 8, 11]], result.motion["weights"][[0, 0, 1, 1]], atol=1e-9)


@pytest.fixture
def row() -> Iterator[EngineKind]:
    mine = replace(ENGINES["mujoco"], name="mine", title="My engine")
    yield mine
    ENGINES.pop("mine", None)


@pytest.mark.slow
def test_an_engine_may_be_a_name_or_a_row(task: levade.Task, found: levade.Result, row: EngineKind) -> None:
    named = levade.solve(task, seed=2, engine="mujoco").motion
    np.testing.assert_array_equal(named["ctrl"], found.motion["ctrl"])
    own = levade.solve(task, seed=2, engine=row).motion
    assert own.provenance.engine == "mine"
    np.testing.assert_array_equal(own["joint_position"], found.motion["joint_position"])
    with pytest.raises(levade.LevadeError, match="another engine is called mine already"):
        levade.solve(task, engine=replace(row, feedback=not row.feedback))


# where to begin


@pytest.mark.slow
@pytest.mark.parametrize(
    "initial",
    [
        lambda motion: motion,
        lambda motion: motion["weights"],
        lambda motion: [motion, motion["weights"]],
        lambda motion: InitialGuess(motion["weights"][None], step=0.5),
    ],
    ids=["motion", "weights", "several", "guess"],
)
def test_a_search_may_begin_around_what_succeeds(
    task: levade.Task, found: levade.Result, initial: Callable[[levade.Motion], Any]
) -> None:
    warm = levade.solve(task, seed=5, initial=initial(found.motion))
    assert warm.success
    assert warm.solution.trials_to_success in (1, 2)


# Python code behind a motion


@pytest.fixture(scope="module")
def coded(task: levade.Task) -> levade.Result:
    bent = levade.Criterion(levade.Measure("knee", "rad", knee), minimum=-3, maximum=0)
    costs = {**task.costs, "fastest": levade.Cost(fastest, weight=0.1)}
    return levade.solve(replace(task, costs=costs, success={**task.success, "knee": bent}), seed=2)


def test_costs_and_measures_in_python_are_searched_with(coded: levade.Result) -> None:
    motion = coded.motion
    assert motion.result.cost_terms["fastest"] == pytest.approx((motion["joint_velocity"] ** 2).max())
    assert motion.result.errors["knee"] == 0
    assert coded.success


@pytest.mark.slow
def test_a_motion_that_was_just_found_is_checked_with_its_code(coded: levade.Result) -> None:
    assert coded.motion.task.costs["fastest"].term is fastest
    certificate = levade.check(coded.motion, runs=2)
    assert all("knee" in numeric.errors for numeric in certificate.numerics.values())


@pytest.mark.slow
def test_the_code_is_not_in_the_file_which_says_so(coded: levade.Result, tmp_path: Path) -> None:
    coded.motion.save(tmp_path / "motion.npz")
    motion = levade.Motion.load(tmp_path / "motion.npz")
    assert motion.source_task is None
    cost = motion.task.costs["fastest"]
    assert isinstance(cost.term, MissingCode)
    assert cost.term.python == f"{__name__}.fastest"
    assert motion.result == coded.motion.result
    np.testing.assert_array_equal(motion["joint_position"], coded.motion["joint_position"])
    assert "<html" in levade.show(motion, tmp_path / "page.html", browse=False).read_text(encoding="utf-8")
    with pytest.raises(levade.LevadeError, match=r"fastest was Python code, which is not in the file"):
        make_objective(motion.task)
