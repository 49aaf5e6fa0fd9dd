"""Motion files: replayed with nothing of ours, the same every time, and safe to open whatever is in them."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.check import Subject
from levade.errors import LevadeError
from levade.motion import ARRAYS, LATER, LATER_ARRAYS, META, Motion
from levade.replay import replay_in
from levade.rotations import rotate
from levade.search import Objective, Solution, make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

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


def test_a_replay_without_levade_is_the_same_to_the_bit(motion: Motion, file: Path, tmp_path: Path) -> None:
    end = replay(file, tmp_path)
    assert end["steps"] == 175
    assert end["pitch"] + 1.0472 == pytest.approx(motion.meta["errors"]["pitch"], abs=1e-9)
    assert end["height"] - 0.9 == pytest.approx(motion.meta["errors"]["height"], abs=1e-9)
    np.testing.assert_allclose(end["recorded"], end["com"], atol=1e-9)


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
    assert set(meta["versions"]) == {"levade", "mujoco", "numpy", "cma"}


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


def test_angular_velocity_is_in_world_axes(motion: Motion) -> None:
    """As the rate of the rotation matrix: R' = [w]x R."""
    matrices = np.empty((len(motion["time"]), 9))
    for row, quaternion in zip(matrices, motion["trunk_quaternion"], strict=True):
        mujoco.mju_quat2Mat(row, quaternion)
    matrices = matrices.reshape(-1, 3, 3)
    rate = (matrices[2:] - matrices[:-2]) / 0.004
    skew = rate @ matrices[1:-1].transpose(0, 2, 1)
    expected = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=-1)
    # central difference of what holds during a step: the mean of this row's and the next one's
    between = (motion["trunk_angular_velocity"][1:-1] + motion["trunk_angular_velocity"][2:]) / 2
    assert np.abs(expected).max() > 1
    np.testing.assert_allclose(between, expected, atol=0.02 * np.abs(expected).max())


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


def test_the_resolved_task_in_the_file_gives_the_motion_again(motion: Motion, tmp_path: Path) -> None:
    from levade.tasks import task_from_dict

    objective = make_objective(task_from_dict(motion.meta["task"], where="meta"), threads=1)
    again = record(objective, solve(objective, seed=motion.meta["seed"]), seed=1)
    for name in ARRAYS:
        np.testing.assert_array_equal(again[name], motion[name])


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
            edit_meta(lambda m: m.update(schema=2)),
            "layout 2, but this levade reads layout 1; use the levade that wrote it",
        ),
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
    ],
)
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
    for use in (motion.compiled, lambda: Subject(motion), lambda: replay_in("mujoco", motion)):
        with pytest.raises(LevadeError, match=message) as caught:
            use()
        assert "\n" not in str(caught.value)


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
