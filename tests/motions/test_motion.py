"""Motion files: replayed with nothing of ours, the same every time, and safe to open whatever is in them."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tracemalloc
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade import archive as archive_module
from levade.checks import check
from levade.costs import Criterion
from levade.errors import LevadeError
from levade.exports import export
from levade.motions import ARRAYS, LATER, LATER_ARRAYS, META, SCHEMA, Motion, RecordedSimulation, replay_in
from levade.motions.facts import robot_facts
from levade.motions.model import check_text
from levade.report.summary import provenance_data, summary_data
from levade.robots import load_robot
from levade.rotations import rotate
from levade.search import Objective, Solution, make_objective, solve
from levade.search.recording import record
from levade.tasks import Cost, Stage, load_task, task_from_dict, task_to_dict
from levade.trajectory import Trajectories

HERE = [
    "search.optimizer=cma",
    "search.modes=null",
    "search.smoothness=0.15",
    "search.population=8",
    "search.trials=24",
    "hold=0.05",
]

# What docs/motion-file.md tells a stranger to do.
REPLAY = """
import json, math, sys
import mujoco
import numpy as np

data = np.load(sys.argv[1])
assets = {name[6:]: data[name].tobytes() for name in data if name.startswith("asset:")}
model = mujoco.MjModel.from_xml_string(str(data["model_xml"]), assets)
state = mujoco.MjData(model)
state.qpos[:], state.qvel[:], state.act[:] = data["qpos0"], data["qvel0"], data["act0"]
meta, worst = json.loads(str(data["meta"])), 0.0
joints = [str(name) for name in data["joint_names"]]
for k, ctrl in enumerate(data["ctrl"]):
    state.ctrl[:] = ctrl
    mujoco.mj_step(model, state)
    now = {
        "joint_position": [state.joint(name).qpos[0] for name in joints],
        "joint_velocity": [state.joint(name).qvel[0] for name in joints],
        "joint_torque": [state.actuator(name).force[0] for name in joints],
        "trunk_position": state.qpos[:3],
        "trunk_quaternion": state.qpos[3:7],
        "trunk_linear_velocity": state.qvel[:3],
        "trunk_angular_velocity": state.qvel[3:6],  # in trunk axes, as a gyroscope has it
    }
    for name, value in now.items():
        assert np.array_equal(value, data[name][k]), (name, k)
    assert abs(state.time - data["time"][k]) < 1e-12
    if k + 1 == meta["horizon_steps"]:
        mujoco.mj_forward(model, state)
        body = state.body(meta["trunk"])
        at_horizon = {
            "pitch": math.asin(-body.xmat[6]), "height": body.xipos[2], "com": list(body.xipos),
            "recorded": list(data["trunk_com_position"][k]),
        }
assert "levade" not in sys.modules and "cma" not in sys.modules
print(json.dumps(at_horizon | {"steps": k + 1}))
"""


@pytest.fixture(scope="module")
def objective() -> Objective:
    return make_objective(load_task("rearing", changes=HERE), threads=1)


@pytest.fixture(scope="module")
def solution(objective: Objective) -> Solution:
    return solve(objective, seed=1)


@pytest.fixture(scope="module")
def motion(objective: Objective, solution: Solution) -> Motion:
    return record(objective, solution, seed=1)


@pytest.fixture
def file(motion: Motion, tmp_path: Path) -> Path:
    motion.save(tmp_path / "motion.npz")
    return tmp_path / "motion.npz"


def replay(path: Path, folder: Path) -> dict[str, float]:
    script = folder / "replay.py"
    script.write_text(REPLAY)
    command = [sys.executable, "-I", str(script), str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_a_replay_without_levade_is_the_same_to_the_bit(motion: Motion, file: Path, tmp_path: Path) -> None:
    end = replay(file, tmp_path)
    assert end["steps"] == 175
    assert end["pitch"] + 1.0472 == pytest.approx(motion.meta["errors"]["pitch"], abs=1e-9)
    assert end["height"] - 0.9 == pytest.approx(motion.meta["errors"]["height"], abs=1e-9)
    np.testing.assert_allclose(end["recorded"], end["com"], atol=1e-9)


@pytest.mark.slow
def test_what_it_says_of_itself_is_of_a_fresh_simulation(objective: Objective, solution: Solution) -> None:
    """Whatever the search believed: nothing that it took for its own speed is passed on."""
    best = solution.best
    believed = replace(best, success=True, errors=dict.fromkeys(best.errors, 0.0), terms=dict.fromkeys(best.terms, 0.0))
    motion = record(objective, replace(solution, best=believed), seed=1)
    fresh = make_objective(load_task("rearing", changes=HERE)).evaluate(best.weights[None])
    assert motion.meta["success"] is bool(fresh.success[0])
    assert motion.meta["errors"] == {name: float(off[0]) for name, off in fresh.errors.items()}
    assert motion.meta["cost_terms"] == {name: float(term[0]) for name, term in fresh.terms.items()}


@pytest.mark.slow
def test_a_found_motion_meets_the_criteria_when_replayed_without_levade(tmp_path: Path) -> None:
    objective = make_objective(load_task("rearing", changes=["search.polish=0"]))
    for seed in range(3):
        outcome = solve(objective, seed=seed)
        if outcome.success:
            break
    assert outcome.success
    motion = record(objective, outcome, seed=seed)
    motion.save(tmp_path / "motion.npz")
    end = replay(tmp_path / "motion.npz", tmp_path)
    assert abs(end["pitch"] + 1.0472) <= 0.006
    assert abs(end["height"] - 0.9) <= 0.02
    assert motion.meta["success"] is True


def test_what_is_loaded_is_what_was_saved(motion: Motion, file: Path) -> None:
    again = Motion.load(file)
    assert again.meta == motion.meta
    assert set(again.meta) == {*META, *LATER}
    assert (again.model_xml, again.assets) == (motion.model_xml, motion.assets)
    assert set(again.arrays) == {*ARRAYS, *LATER_ARRAYS}
    for name in again.arrays:
        np.testing.assert_array_equal(again[name], motion[name])
    with np.load(file, allow_pickle=False) as plain:
        assert set(plain.files) == {"meta", "model_xml", *again.arrays, *(f"asset:{name}" for name in motion.assets)}


def test_arrays_and_meta_say_the_same(motion: Motion, objective: Objective, solution: Solution) -> None:
    meta, steps = motion.meta, 175
    assert (meta["seed"], meta["horizon"], meta["horizon_steps"], meta["timestep"]) == (1, 0.3, 150, 0.002)
    assert motion["ctrl"].shape == (steps, 24)
    np.testing.assert_array_equal(motion["ctrl"][:, ::2], motion["joint_position_reference"])
    np.testing.assert_array_equal(motion["ctrl"][:, 1::2], motion["joint_velocity_reference"])
    np.testing.assert_allclose(motion["time"], 0.002 * np.arange(1, steps + 1))
    np.testing.assert_array_equal(motion["weights"], solution.best.weights)
    assert list(motion["joint_names"]) == list(objective.robot.joint_names)
    assert meta["errors"] == solution.best.errors
    assert meta["cost"] == solution.best.cost
    weights = {name: cost.weight for name, cost in objective.task.costs.items()}
    assert sum(weights[name] * value for name, value in meta["cost_terms"].items()) == pytest.approx(meta["cost"])
    np.testing.assert_allclose(
        motion["trunk_com_position"],
        motion["trunk_position"] + rotate(motion["trunk_quaternion"], np.array(meta["trunk_com_offset"])),
    )
    assert motion["foot_contact_force"].shape == (steps, 4, 3)
    assert set(meta["versions"]) == {"blas", "levade", "mujoco", "numpy", "cma"}


@pytest.mark.golden
def test_the_feet_push_the_robot_as_newton_says(motion: Motion) -> None:
    """Over the first 40 ms, in which nothing but the feet touches the ground: m dv = impulse of the feet - m g t.

    Within 2 %: a first-order integrator at 2 ms keeps a robot's momentum no better while its legs are flung.
    """
    model = mujoco.MjModel.from_xml_string(motion.model_xml, dict(motion.assets))
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = motion["qpos0"], motion["qvel0"], motion["act0"]

    def momentum() -> np.ndarray:
        mujoco.mj_forward(model, data)
        mujoco.mj_subtreeVel(model, data)
        return model.body_mass.sum() * data.subtree_linvel[0]

    before = momentum()
    for ctrl in motion["ctrl"][:20]:
        data.ctrl[:] = ctrl
        mujoco.mj_step(model, data)
    impulse = motion["foot_contact_force"][:20].sum(axis=(0, 1)) * 0.002
    weight = model.body_mass.sum() * 9.81
    np.testing.assert_allclose(
        momentum() - before, impulse - [0, 0, 0.04 * weight], atol=0.02 * np.linalg.norm(impulse)
    )
    assert impulse[2] > 0.04 * weight


@pytest.mark.slow
def test_angular_velocity_is_in_trunk_axes() -> None:
    """As the rate of the rotation matrix, R' = R [w]x, of a robot that falls, turned by 2 rad about two axes."""
    fall = "start={fall: {roll: 1.2, pitch: 0.3, yaw: 2.0, height: 1.5, time: 0.25}}"
    changes = [*HERE, fall, "policy.initial=hold", "search.trials=8"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    motion = record(objective, solve(objective, seed=0), seed=0)
    matrices = np.empty((len(motion["time"]), 9))
    for row, quaternion in zip(matrices, motion["trunk_quaternion"], strict=True):
        mujoco.mju_quat2Mat(row, quaternion)
    matrices = matrices.reshape(-1, 3, 3)
    rate = (matrices[2:] - matrices[:-2]) / 0.004
    skew = matrices[1:-1].transpose(0, 2, 1) @ rate
    expected = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=-1)
    # central difference of what holds during a step: the mean of this row's and the next one's
    between = (motion["trunk_angular_velocity"][1:-1] + motion["trunk_angular_velocity"][2:]) / 2
    size = np.abs(expected).max()
    assert size > 1
    np.testing.assert_allclose(between, expected, atol=0.02 * size)
    world = rotate(motion["trunk_quaternion"], motion["trunk_angular_velocity"])[1:-1]
    assert np.abs(world - expected).max() > 0.5 * size  # the test tells them apart


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes(objective: Objective, motion: Motion) -> None:
    other = make_objective(load_task("rearing", changes=HERE), threads=2)
    again = record(other, solve(other, seed=1), seed=1)
    for name in ARRAYS:
        assert again[name].dtype == motion[name].dtype
        assert again[name].tobytes() == motion[name].tobytes(), name
    assert again.meta == motion.meta
    assert again.model_xml == motion.model_xml
    different = record(objective, solve(objective, seed=2), seed=2)
    assert different["weights"].tobytes() != motion["weights"].tobytes()


@pytest.mark.slow
def test_the_resolved_task_in_the_file_gives_the_motion_again(motion: Motion, tmp_path: Path) -> None:
    from levade.tasks import task_from_dict

    objective = make_objective(task_from_dict(motion.meta["task"], where="meta"), threads=1)
    again = record(objective, solve(objective, seed=motion.meta["seed"]), seed=1)
    for name in ARRAYS:
        np.testing.assert_array_equal(again[name], motion[name])


def test_a_wrong_name_brings_the_nearest(motion: Motion) -> None:
    with pytest.raises(LevadeError, match=r"^motion: no array 'joint_positions'; did you mean joint_position\?$"):
        motion["joint_positions"]
    with pytest.raises(KeyError):
        motion["nothing of the kind"]
    assert "joint_position" in motion
    assert "joint_positions" not in motion


def test_its_attributes_say_what_the_file_says(motion: Motion, objective: Objective, solution: Solution) -> None:
    assert repr(motion).startswith("Motion(rearing on hyq2max: ")
    assert repr(motion).endswith(f"T = 0.3 s and 0.05 s of hold, {solution.trials} trials)")
    assert motion.task == objective.task
    assert motion.robot == objective.robot.name
    assert motion.legs == tuple(replace(leg, roles=()) for leg in objective.robot.legs)
    assert motion.result.errors == solution.best.errors
    off = {name: value - (motion.task.success[name].target or 0.0) for name, value in motion.result.values.items()}
    assert off == pytest.approx(motion.result.errors, abs=1e-12)
    assert motion.result.cost == solution.best.cost
    assert motion.result.cost_weights == solution.cost_weights
    assert (motion.result.trials, motion.result.stopped) == (solution.trials, solution.stopped)
    assert (motion.provenance.engine, motion.provenance.seed, motion.provenance.schema) == ("mujoco", 1, SCHEMA)
    assert (motion.timestep, motion.horizon, motion.steps) == (0.002, 0.3, 175)
    assert motion.hold == pytest.approx(0.05)
    state = objective.state
    for name in ("qpos", "qvel", "act", "joint_position", "joint_reference"):
        np.testing.assert_array_equal(getattr(motion.start, name), getattr(state, name), err_msg=name)
    reference = objective.policy.reference(motion["weights"][None])
    np.testing.assert_array_equal(motion.reference.position, reference.position)
    assert motion.policy is not None
    np.testing.assert_array_equal(motion.policy.reference(motion["weights"][None]).velocity, reference.velocity)


@pytest.mark.parametrize(
    ("height", "after", "late"),
    [(0.0, 0.2, True), (0.0, 0.0, False), (0.2, 0.2, False), (0.2, 0.0, False)],
)
def test_it_falls_late_if_it_misses_only_what_the_hold_has_to_show(
    height: float, after: float, late: bool, moving: Motion, changed: Callable[..., Motion]
) -> None:
    criteria = {
        "height": Criterion("height", target=0.9, tolerance=0.1),
        "after": Criterion("height", target=0.9, tolerance=0.1, at="end"),
    }
    motion = moving.with_task(replace(moving.task, success=criteria, stages=(Stage(),)))
    meta = {"errors": {"height": height, "after": after}, "trials_to_success": 6}
    assert changed(motion, meta).falls_late == late


@pytest.mark.parametrize("linkage", [False, True])
def test_its_embodiment_is_the_robots_own(linkage: bool, motion: Motion) -> None:
    robot = load_robot("hyq2max", linkage=linkage)
    facts = json.loads(json.dumps(robot_facts(robot.embodiment, robot.legs)))
    ours, own = replace(motion, meta={**motion.meta, **facts}).embodiment, robot.embodiment
    assert (ours.trunk, ours.joint_names, ours.feet) == (own.trunk, own.joint_names, own.feet)
    for name in ("lower", "upper", "velocity", "torque", "stall_torque", "no_load_speed"):
        np.testing.assert_array_equal(getattr(ours.limits, name), getattr(own.limits, name), err_msg=name)
    assert dict(ours.limits.torque_curves) == dict(own.limits.torque_curves)
    assert bool(ours.limits.torque_curves) == linkage
    np.testing.assert_array_equal(ours.trunk_com_offset, own.trunk_com_offset)
    for mine, theirs in zip(ours.legs, own.legs, strict=True):
        assert (mine.name, mine.side, mine.end, mine.joints, mine.sole) == (
            *(theirs.name, theirs.side, theirs.end, theirs.joints, theirs.sole),
        )
        for name in ("anchors", "axes", "foot"):
            np.testing.assert_array_equal(getattr(mine, name), getattr(theirs, name))


@pytest.mark.slow
def test_a_cost_that_is_python_code_is_named_in_the_file(tmp_path: Path) -> None:
    """It can be recorded, saved, loaded, checked, shown and exported; only the cost itself is not there."""
    task = load_task("rearing", changes=[*HERE, "search.trials=8"])
    task = replace(task, costs={**task.costs, "leaning": Cost(leaning, 2.0)})
    objective = make_objective(task, threads=1)
    motion = record(objective, solve(objective, seed=0), seed=0)
    motion.save(tmp_path / "motion.npz")
    motion = Motion.load(tmp_path / "motion.npz")
    assert motion.meta["task"]["costs"]["leaning"] == {"python": f"{__name__}.leaning", "weight": 2.0}
    assert motion.result.cost_weights["leaning"] == 2.0
    assert motion.task.success == task.success
    assert task_to_dict(motion.task, code=True) == motion.meta["task"]
    certificate = check(motion, runs=2)
    assert certificate.criteria == "rearing"
    assert any(term["name"] == "leaning" for term in summary_data(motion)["terms"])
    assert "python: " in provenance_data(motion)["task_yaml"]
    assert export(motion, "json", tmp_path / "out").written
    term = motion.task.costs["leaning"].term
    with pytest.raises(
        LevadeError, match=r"leaning was Python code, which is not in the file; give the task its function"
    ):
        term(replay_in("mujoco", motion).trajectories)
    with pytest.raises(LevadeError, match=r"^task\.yaml\.costs\.leaning: was Python code"):
        task_from_dict(motion.meta["task"], where="task.yaml")


def leaning(trajectories: Trajectories) -> np.ndarray:
    return trajectories.trunk_quaternion[:, -1, 2] ** 2


def test_saving_is_all_or_nothing(motion: Motion, file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = file.read_bytes()

    def full(handle: object, **content: object) -> None:
        handle.write(b"half of it")  # type: ignore[attr-defined]
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez_compressed", full)
    with pytest.raises(OSError, match="No space left"):
        motion.save(file)
    assert file.read_bytes() == before
    assert [path.name for path in file.parent.iterdir()] == ["motion.npz"]


def rewrite(path: Path, change: Callable[[dict[str, np.ndarray]], object]) -> None:
    with np.load(path) as data:
        content = {name: data[name] for name in data.files}
    change(content)
    np.savez(path, **content)  # type: ignore[arg-type]


def edit_meta(change: Callable[[dict], object]) -> Callable[[dict[str, np.ndarray]], object]:
    def edit(content: dict[str, np.ndarray]) -> None:
        meta = json.loads(str(content["meta"]))
        change(meta)
        content["meta"] = np.array(json.dumps(meta))

    return edit


def nested(levels: int) -> dict:
    return {"in": nested(levels - 1)} if levels else {}


class Boom:
    def __reduce__(self) -> tuple:
        return (exec, ("raise SystemExit('a pickle was opened')",))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: c.pop("ctrl"), "not a motion file, ctrl missing; give a motion.npz of levade solve"),
        (lambda c: [c.pop(name) for name in list(c)], "not a motion file, meta, model_xml, qpos0 missing"),
        (lambda c: c.update(meta=np.array("{")), "its meta cannot be read"),
        (lambda c: c.update(meta=np.array([1, 2])), "its meta cannot be read"),
        (lambda c: c.update(meta=np.array('"text"')), "its meta cannot be read"),
        (
            edit_meta(lambda m: m.update(schema=3)),
            "layout 3, but this levade reads layouts 1 to 2; use the levade that wrote it",
        ),
        (edit_meta(lambda m: m.update(schema=True)), "its meta lacks a schema; not made by levade solve"),
        (edit_meta(lambda m: m.update(schema="2")), "its meta lacks a schema; not made by levade solve"),
        (edit_meta(lambda m: m.pop("schema")), "its meta cannot be read"),
        (edit_meta(lambda m: m.pop("limits")), "its meta lacks limits"),
        (lambda c: c.update(ctrl=c["ctrl"][:-1]), r"time has the shape \(175,\), should be \(steps=174\)"),
        (lambda c: c.update(trunk_position=c["trunk_position"][:, :2]), r"trunk_position has the shape \(175, 2\)"),
        (lambda c: c.update(qpos0=c["qpos0"][None]), r"qpos0 has the shape \(1, 19\), should be \(nq\)"),
        (lambda c: c.update(qpos0=c["qpos0"].astype(str)), "qpos0 is of <U.*, should be floating-point numbers"),
        (
            lambda c: c["joint_position"].fill(np.nan),
            "joint_position has values that are no numbers; the file is damaged",
        ),
        (lambda c: c.update(weights=np.array([Boom()])), "cannot be read as a motion; damaged, or not a motion.npz"),
        (lambda c: c.update(time=c["time"] * 2), "time: should be multiples of meta.timestep, 0.002 s"),
        (lambda c: c.update(weights=c["weights"][1:]), "meta.policy: takes 96 weights, there are 95"),
        (lambda c: c["trunk_quaternion"].fill(0.1), "trunk_quaternion has rows that are no rotations"),
        (lambda c: c["ctrl"].fill(1e13), "ctrl has values that are no numbers"),
        (lambda c: c["joint_names"].put(3, c["joint_names"][0]), "joint_names: names that are there twice"),
        (lambda c: c["joint_names"].put(3, "\x1b[2J"), "joint_names: names that are there twice, or hold control char"),
        (lambda c: c.update({"asset:a": np.zeros(3)}), "'asset:a' is of float64, should be bytes"),
        (lambda c: c.update(model_xml=np.array(["<mujoco/>"])), "its model_xml cannot be read"),
        (lambda c: c.update({name: c[name][:0] for name in c if c[name].shape[:1] == (175,)}), "joint_names and time"),
        *((edit_meta(change), message) for change, message in (
            (lambda m: m.update(robot="go\x1b[31m1"), r"meta: the text 'go\\x1b\[31m1' holds control characters"),
            (lambda m: m["task"].update({"a\x07": 1}), "meta: a key holds control characters"),
            (lambda m: m.update(robot="go\n1"), "meta.robot: .*should be a name without control characters"),
            (lambda m: m.update(success=1), "meta.success: should be a valid boolean, is 1"),
            (lambda m: m.update(trials="12"), "meta.trials: should be a valid integer, is '12'"),
            (lambda m: m.update(timestep=0), "meta.timestep: should be greater than or equal to 0.0"),
            (lambda m: m.update(timestep=0.001), "meta.horizon: 0.3 s, but 150 steps are of 0.001 s"),
            (lambda m: m.update(horizon_steps=176), "meta.horizon_steps: 176, but time has 175 steps"),
            (lambda m: m.update(errors={"pitch": 0.1}), "meta.errors: lacks 'height', a criterion of the task"),
            (lambda m: m["cost_terms"].update(more=1.0), "meta.cost_terms: 'more' has no weight"),
            (lambda m: m["limits"]["torque"].pop(), "meta.limits.torque: 11 numbers for 12 joints"),
            (lambda m: m["limits"]["upper"].__setitem__(3, -9.0), "meta.limits: a lower limit is above its upper one"),
            (lambda m: m["limits"].pop("no_load_speed"), "meta.limits: has one of stall_torque and no_load_speed"),
            (lambda m: m["limits"].update(assumed_velocity=[12]), "meta.limits.assumed_velocity: no joint 12; there are 12"),
            (lambda m: m["legs"].pop("lf"), "foot_contact_force has 4 feet, meta.legs has 3"),
            (lambda m: m["legs"]["lf"]["joints"].__setitem__(0, "rf_haa"), "meta.legs: should have each of joint_names"),
            (lambda m: m["legs"]["lf"]["geometry"]["axes"].pop(), "meta.legs.lf.geometry: should have an anchor and an"),
            (lambda m: m["policy"]["groups"].pop(), "meta.policy: groups: joints|meta.policy: is for 6 joints"),
            (lambda m: m["policy"].update(timestep=0.001), "meta.policy: 0.3 s in steps of 0.001 s, the motion has 150"),
            (lambda m: m.update(model_joints=["nose"]), "meta.model_joints: has joints that are neither"),
            (lambda m: m.update(task=nested(60)), "meta: nested more than 50 levels deep"),
            (lambda m: m.update(seed=10**400), "its meta cannot be read"),
        )),
    ],
)  # fmt: skip
def test_files_that_are_not_quite_motions(file: Path, change: Callable, message: str) -> None:
    rewrite(file, change)
    with pytest.raises(LevadeError, match=f"^{re.escape(str(file))}: ({message})") as caught:
        Motion.load(file)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: c.update(qpos0=c["qpos0"][:5]), "motion: qpos0 has 5 numbers, its model 19; the file is damaged"),
        (lambda c: c.update(ctrl=c["ctrl"][:, 1:]), "motion: ctrl has 23 numbers, its model 24; the file is damaged"),
        (
            lambda c: c.update(model_xml=np.array("<mujoco><nothing/></mujoco>")),
            "motion: MuJoCo .* does not take its model: ",
        ),
    ],
)
def test_arrays_are_those_of_the_model(file: Path, change: Callable, message: str) -> None:
    rewrite(file, change)
    motion = Motion.load(file)
    for use in (motion.compiled, lambda: RecordedSimulation(motion), lambda: replay_in("mujoco", motion)):
        with pytest.raises(LevadeError, match=message) as caught:
            use()
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("<worldbody>", '<include file="/etc/hostname"/><worldbody>'), "has <include>; a motion's model stands alone"),
        (("<worldbody>", '<worldbody><replicate count="100000"/>'), "has <replicate>; a motion's model stands alone"),
        (
            ("<asset>", '<asset><mesh name="m" file="/tmp/there.obj"/>'),
            "<mesh> needs the file '/tmp/there.obj', which is not in the motion",
        ),
        (
            ("<asset>", '<asset><hfield name="h" nrow="1" ncol="1" size="1 1 1 1" file="h.png"/>'),
            "<hfield> needs the f",
        ),
        (("<asset>", '<asset><texture name="h" fileright="h.png"/>'), "<texture> needs the file 'h.png'"),
        (("<asset>", '<asset><hfield name="h" nrow="99999" ncol="99999"/>'), r"<hfield> asks for 1e\+10 numbers"),
        (("<asset>", '<size memory="900G"/><asset>'), r"<size> asks for 9.66e\+11 numbers"),
        (("<mujoco", "<!DOCTYPE mujoco><mujoco"), "declares a document type, which no model needs"),
        (("</mujoco>", ""), "is no XML"),
        (("mujoco", "robot"), "begins with <robot>; should begin with <mujoco>"),
    ],
)
def test_a_model_that_needs_more_than_the_motion_has(file: Path, change: tuple[str, str], message: str) -> None:
    rewrite(file, lambda c: c.update(model_xml=np.array(str(c["model_xml"]).replace(*change))))
    with pytest.raises(LevadeError, match=f"^{re.escape(str(file))}: model_xml: {message}"):
        Motion.load(file)


def test_assets_are_found_as_mujoco_finds_them() -> None:
    mesh = '<mujoco><asset><mesh name="m" file="{}"/></asset></mujoco>'
    for name in ("box.obj", "BOX.obj", "meshes/box.obj", "..\\meshes\\Box.OBJ"):
        check_text(mesh.format(name), ["box.obj"])
    check_text(mesh.format("meshes/box.obj"), ["meshes/box.obj"])
    for name in ("other.obj", "box.obj/x", "meshes/box.stl"):
        with pytest.raises(LevadeError, match="which is not in the motion"):
            check_text(mesh.format(name), ["box.obj"])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda m: m.update(trunk="nose"), "motion: its model has no body 'nose'"),
        (lambda m: m["legs"]["lf"].update(foot="nose"), "motion: its model has no geom 'nose'"),
        (lambda m: m.update(trunk="lf_hip"), "motion: its trunk does not move freely"),
    ],
)
def test_names_are_those_of_the_model(file: Path, change: Callable, message: str) -> None:
    rewrite(file, edit_meta(change))
    with pytest.raises(LevadeError, match=message):
        Motion.load(file).compiled()


def test_steps_are_those_of_the_model(file: Path) -> None:
    xml = '<option timestep="0.001" '
    rewrite(file, lambda c: c.update(model_xml=np.array(str(c["model_xml"]).replace("<option ", xml))))
    with pytest.raises(LevadeError, match=r"motion: has steps of 0\.002 s, its model of 0\.001 s; the file is damaged"):
        Motion.load(file).compiled()


@pytest.mark.parametrize(
    "data",
    [b"", b"PK", b"hello\n" * 100, b"\x93NUMPY\x01\x00", bytes(range(256)) * 40, b"\x80\x04K\x01."],
    ids=["empty", "PK", "text", "npy header", "bytes", "pickle"],
)
def test_files_that_are_something_else(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "motion.npz"
    path.write_bytes(data)
    with pytest.raises(LevadeError, match=r"cannot be read as a motion; damaged, or not a motion.npz of levade solve"):
        Motion.load(path)


def test_other_files_of_numpy_and_of_no_one(tmp_path: Path) -> None:
    np.save(tmp_path / "array.npy", np.zeros(3))
    np.savez(tmp_path / "other.npz", a=np.zeros(3))
    with zipfile.ZipFile(tmp_path / "other.zip", "w") as archive:
        archive.writestr("readme.txt", "hello")
    for name, message in (
        ("array.npy", "cannot be read as a motion"),
        ("other.npz", "not a motion file, meta, model_xml, qpos0 missing"),
        ("other.zip", "not a motion file|cannot be read as a motion"),
        ("none.npz", "no such file; give the motion.npz that levade solve wrote"),
        (".", "is a directory; give the motion.npz in it: "),
        ("array.npy/motion.npz", "cannot be read as a motion"),
    ):
        with pytest.raises(LevadeError, match=message):
            Motion.load(tmp_path / name)


def zipped(path: Path, compression: int = zipfile.ZIP_DEFLATED, **members: bytes) -> None:
    with zipfile.ZipFile(path, "w", compression) as archive:
        for name, data in members.items():
            archive.writestr(f"{name}.npy", data)


def header(shape: str, kind: str = "<f8") -> bytes:
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}}}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode()


CLAIMS = [
    ("(10**12,)", "<f8"),
    ("(1000000000000,)", "<f8"),
    ("(-1,)", "<f8"),
    ("()", "<U999999999"),
    ("(9999999999,)", "<U0"),
]


def test_sizes_are_looked_at_before_anything_is_unfolded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Zeros that unfold to a thousand times the file, and headers that claim what is not there."""
    monkeypatch.setattr(archive_module, "LARGEST", 5_000_000)
    path, zeros = tmp_path / "motion.npz", bytes(6_000_000)
    zipped(path, meta=header("(750000,)") + zeros)
    assert path.stat().st_size < 10_000
    tracemalloc.start()
    with pytest.raises(LevadeError, match="unfolds to 6 MB, a motion to at most 5 MB; not made by levade solve"):
        Motion.load(path)
    for shape, kind in CLAIMS:
        zipped(path, meta=header(shape, kind) + bytes(1000))
        with pytest.raises(LevadeError, match="cannot be read as a motion"):
            Motion.load(path)
    assert tracemalloc.get_traced_memory()[1] < 1_000_000
    tracemalloc.stop()


def test_a_file_that_says_it_is_smaller_than_it_is(tmp_path: Path) -> None:
    """Its table of contents says 1000 bytes; it unfolds to 5 MB."""
    path = tmp_path / "motion.npz"
    zipped(path, meta=header("(625000,)") + bytes(5_000_000))
    size = (5_000_128).to_bytes(4, "little")
    assert path.read_bytes().count(size) == 2
    path.write_bytes(path.read_bytes().replace(size, (1000).to_bytes(4, "little")))
    with pytest.raises(LevadeError, match="cannot be read as a motion"):
        Motion.load(path)


@pytest.mark.slow
def test_an_archive_that_numpy_does_not_write(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with zipfile.ZipFile(file) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    path, stored = tmp_path / "other.npz", zipfile.ZIP_STORED
    for compression, more, comment in (
        (zipfile.ZIP_BZIP2, {}, b""),
        (zipfile.ZIP_LZMA, {}, b""),
        (stored, {"readme.txt": b"hello"}, b""),
        (stored, {}, b"hello"),
    ):
        with zipfile.ZipFile(path, "w", compression) as archive:
            for name, data in (members | more).items():
                archive.writestr(name, data)
            archive.comment = comment
        with pytest.raises(LevadeError, match="cannot be read as a motion"):
            Motion.load(path)
    Motion.load(file)
    monkeypatch.setattr(archive_module, "_DIRECTORY", 1000)
    with pytest.raises(LevadeError, match="cannot be read as a motion"):
        Motion.load(file)


def test_arrays_of_other_floats_are_of_64_bits(file: Path) -> None:
    rewrite(file, lambda c: c.update(weights=c["weights"].astype(">f8"), ctrl=np.asfortranarray(c["ctrl"])))
    motion = Motion.load(file)
    assert (motion["weights"].dtype, motion["ctrl"].flags.c_contiguous) == (np.dtype("<f8"), True)


@pytest.mark.slow
def test_a_damaged_file_is_refused_or_harmless(file: Path) -> None:
    """Cut off anywhere, or with any few bytes changed: one clear error, or a motion that reads as it was."""
    whole, random = file.read_bytes(), np.random.default_rng(0)
    for length in [*random.integers(0, len(whole), 30), len(whole) - 1]:
        file.write_bytes(whole[:length])
        with pytest.raises(LevadeError, match=r"cannot be read as a motion|not a motion file"):
            Motion.load(file)
    refused = 0
    for _ in range(150):
        broken = bytearray(whole)
        for place in random.integers(0, len(whole), 3):
            broken[place] = random.integers(0, 256)
        file.write_bytes(broken)
        try:
            Motion.load(file)
        except LevadeError:
            refused += 1
    assert refused > 100
