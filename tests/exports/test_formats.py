"""Each format, read back by a library that is not ours."""

from __future__ import annotations

import csv
import importlib.util
import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.exports import FORMATS, export
from levade.exports.export import Format
from levade.exports.player import Motion as Played
from levade.motions import Motion
from levade.rotations import rotate
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


def test_csv_by_the_standard_library(rearing: Motion, tmp_path: Path) -> None:
    done = export(rearing, "csv", tmp_path / "out", command="levade export x --to csv")
    assert [str(path.relative_to(tmp_path)) for path in done.written] == [
        "out/meta.json",
        "out/motion.csv",
        "out/player.py",
    ]
    with (tmp_path / "out/motion.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 151
    for i, joint in enumerate(rearing["joint_names"]):
        for name in ("position", "velocity", "torque"):
            shift = 0 if name == "torque" else 1  # torques in force from a row on, positions reached at it
            column = np.array([float(row[f"command/{joint}/{name}"]) for row in rows])
            np.testing.assert_array_equal(column[shift : 150 + shift], rearing[f"joint_{name}"][:, i])
            np.testing.assert_array_equal(column, [float(row[f"state/{joint}/{name}"]) for row in rows])
        assert {row[f"command/{joint}/kp"] for row in rows} == {"600.0"}
        assert {row[f"command/{joint}/kd"] for row in rows} == {"20.0"}
    for i, axis in enumerate("wxyz"):
        column = [float(row[f"state/trunk/quaternion/{axis}"]) for row in rows]
        np.testing.assert_array_equal(column[1:], rearing["trunk_quaternion"][:, i])
    for i, axis in enumerate("xyz"):
        turning = rotate(rearing["trunk_quaternion"], rearing["trunk_angular_velocity"])  # in world axes
        np.testing.assert_array_equal(
            [float(row[f"state/trunk/angular_velocity/{axis}"]) for row in rows[1:]], turning[:, i]
        )
        for name in ("position", "com_position", "linear_velocity"):
            column = [float(row[f"state/trunk/{name}/{axis}"]) for row in rows]
            np.testing.assert_array_equal(column[1:], rearing[f"trunk_{name}"][:, i])
        for foot, leg in enumerate(("lf", "rf", "lh", "rh")):
            column = [float(row[f"state/{leg}_foot/contact_force/{axis}"]) for row in rows]
            np.testing.assert_array_equal(column[:-1], rearing["foot_contact_force"][:, foot, i])
    meta = json.loads((tmp_path / "out/meta.json").read_text())
    assert meta["provenance"]["command"] == "levade export x --to csv"
    assert (meta["provenance"]["task"], meta["provenance"]["robot"], meta["provenance"]["seed"]) == (
        "rearing",
        "hyq2max",
        0,
    )
    assert meta["limits"]["torque"] == rearing.meta["limits"]["torque"]


def test_csv_by_numpy_at_another_rate(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "csv", tmp_path, rate=1000.0, reference="commanded")
    table = np.genfromtxt(tmp_path / "motion.csv", delimiter=",", names=True, deletechars="", replace_space=" ")
    assert len(table) == 301
    np.testing.assert_allclose(np.diff(table["time"]), 0.001, atol=1e-12)
    np.testing.assert_array_equal(table["command/lf_kfe/position"][:-1:2], rearing["ctrl"][:, 4])
    np.testing.assert_array_equal(table["command/lf_kfe/torque"], 0.0)


def test_json_by_json(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "json", tmp_path)
    content = json.loads((tmp_path / "motion.json").read_text(), parse_constant=pytest.fail)
    assert content["meta"]["joints"] == rearing["joint_names"].tolist()
    np.testing.assert_array_equal(content["command"]["torque"][:-1], rearing["joint_torque"])
    np.testing.assert_array_equal(content["state"]["velocity"][1:], rearing["joint_velocity"])
    np.testing.assert_array_equal(content["state"]["trunk"]["quaternion"][1:], rearing["trunk_quaternion"])
    np.testing.assert_array_equal(
        content["state"]["contact_force"]["rh_foot"][:-1], rearing["foot_contact_force"][:, 3]
    )
    assert content["meta"]["provenance"]["made_with"] == rearing.meta["versions"]


@pytest.mark.golden
def test_unitree_by_numpy(rearing: Motion, tmp_path: Path) -> None:
    done = export(rearing, "unitree", tmp_path, rate=None, kp=60.0, kd=3.0)
    path = tmp_path / "unitree.csv"
    fields = [
        f"{leg}_{k}/{field}"
        for leg in ("FR", "FL", "RR", "RL")
        for k in range(3)
        for field in ("q", "dq", "tau", "kp", "kd")
    ]
    assert path.read_text().splitlines()[0].split(",") == ["time", *fields]
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    commands = table[:, 1:].reshape(-1, 12, 5)  # row, motor, field
    np.testing.assert_allclose(np.diff(table[:, 0]), 0.002, atol=1e-12)
    names = rearing["joint_names"].tolist()
    order = [names.index(f"{leg}_{k}") for leg in ("rf", "lf", "rh", "lh") for k in ("haa", "hfe", "kfe")]
    np.testing.assert_array_equal(commands[1:, :, 0], rearing["joint_position"][:, order])
    np.testing.assert_array_equal(commands[1:, :, 1], rearing["joint_velocity"][:, order])
    np.testing.assert_array_equal(commands[:-1, :, 2], rearing["joint_torque"][:, order])
    assert (commands[..., 3] == 60.0).all()
    assert (commands[..., 4] == 3.0).all()
    meta = json.loads((tmp_path / "meta.json").read_text())
    assert meta["provenance"]["motors"]["FR_0"] == "rf_haa"
    assert meta["joints"][:3] == ["FR_0", "FR_1", "FR_2"]
    assert meta["start"]["position"][0] == rearing["qpos0"][10]
    # the outward axes of HyQ2Max's left hips are not Unitree's, nor are hind knees that point forward
    assert [note.split(":")[0] for note in done.notes] == [
        "of hyq2max, lf_haa, lh_haa do not turn about the axes of Unitree's joints and rh_kfe, lh_kfe bend to positive angles,"
        " which Unitree's calves have not"
    ]
    assert (rearing["joint_position"][:, [names.index(f"{leg}_kfe") for leg in ("lh", "rh")]] > 0).any(axis=0).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda legs: legs["lh"]["joints"].pop(), "leg lh of hyq2max has 2 joints; Unitree's legs have three"),
        (lambda legs: legs["lh"].update(end="front"), "hyq2max has 2 front left legs"),
        (lambda legs: legs.pop("rf"), "hyq2max has 0 front right legs"),
    ],
)
def test_unitree_only_for_robots_with_such_legs(
    rearing: Motion, tmp_path: Path, change: Callable[[dict], object], message: str
) -> None:
    legs = json.loads(json.dumps(rearing.meta["legs"]))
    change(legs)
    with pytest.raises(LevadeError) as error:
        export(replace(rearing, meta={**rearing.meta, "legs": legs}), "unitree", tmp_path / "a" / "b")
    assert message in str(error.value)
    assert list(tmp_path.iterdir()) == []


def test_mjlab_by_numpy_and_mujoco(rearing: Motion, rearing_model: mujoco.MjModel, tmp_path: Path) -> None:
    done = export(rearing, "mjlab", tmp_path)
    data = np.load(tmp_path / "reference.npz", allow_pickle=False)
    assert data["fps"].tolist() == [50]
    assert data["body_names"].tolist()[:3] == ["trunk", "lf_hip", "lf_upper"]
    assert data["joint_names"].tolist() == rearing["joint_names"].tolist()
    assert len(data["joint_pos"]) == len(done.samples.time) == 16
    # the frames and velocities that mjlab itself computes, from MuJoCo's cvel (mjlab/entity/data.py)
    state = mujoco.MjData(rearing_model)
    for frame in range(1, 16):
        row = frame * 10 - 1
        state.qpos[:] = np.concatenate(
            [rearing[name][row] for name in ("trunk_position", "trunk_quaternion", "joint_position")]
        )
        spin = rearing["trunk_angular_velocity"][row]
        state.qvel[:] = np.concatenate([rearing["trunk_linear_velocity"][row], spin, rearing["joint_velocity"][row]])
        mujoco.mj_forward(rearing_model, state)
        spin, flow = state.cvel[1:, :3], state.cvel[1:, 3:]
        linear = flow - np.cross(spin, state.subtree_com[1] - state.xpos[1:])
        np.testing.assert_allclose(data["body_pos_w"][frame], state.xpos[1:], atol=1e-6)
        np.testing.assert_allclose(np.abs(np.sum(data["body_quat_w"][frame] * state.xquat[1:], axis=1)), 1, atol=1e-6)
        np.testing.assert_allclose(data["body_lin_vel_w"][frame], linear, atol=1e-5)
        np.testing.assert_allclose(data["body_ang_vel_w"][frame], spin, atol=1e-5)
        np.testing.assert_allclose(data["joint_vel"][frame], state.qvel[6:], atol=1e-5)
    table = np.loadtxt(tmp_path / "reference.csv", delimiter=",")
    np.testing.assert_allclose(table[1:, :3], rearing["trunk_position"][9::10], atol=1e-8)
    np.testing.assert_allclose(table[1:, 3:7], rearing["trunk_quaternion"][9::10][:, [1, 2, 3, 0]], atol=1e-8)
    np.testing.assert_allclose(table[1:, 7:], rearing["joint_position"][9::10], atol=1e-8)
    # and what is played is not at 50 Hz
    assert json.loads((tmp_path / "meta.json").read_text())["rate"] == 500.0


def _class(source: str, name: str) -> str:
    return re.search(rf"^class {name}\b.*?(?=^(?:class|def|@)\b|\Z)", source, re.DOTALL | re.MULTILINE)[0]  # type: ignore[index]


def test_mjlabs_own_loaders_read_the_reference(rearing: Motion, tmp_path: Path) -> None:
    """Their classes as they are installed, with numpy in the place of torch, which they come without here."""
    found = importlib.util.find_spec("mjlab")
    if found is None or not found.submodule_search_locations:
        pytest.skip("mjlab is not installed: pip install --no-deps mjlab==1.6.0")
    root = Path(found.submodule_search_locations[0])
    export(rearing, "mjlab", tmp_path)
    torch = SimpleNamespace(
        float32=np.float32,
        Tensor=np.ndarray,
        device=str,
        tensor=lambda values, dtype, device: np.asarray(values, dtype=dtype),
        from_numpy=lambda values: _Torchlike(values),
    )
    scope: dict = {"np": np, "torch": torch, "annotations": None}
    tracking = (root / "tasks/tracking/mdp/commands.py").read_text()
    exec(
        compile("from __future__ import annotations\n" + _class(tracking, "MotionLoader"), "commands.py", "exec"), scope
    )
    loader = scope["MotionLoader"](str(tmp_path / "reference.npz"), np.array([0, 3]))
    assert loader.time_step_total == 16
    assert loader.body_pos_w.shape == loader.body_lin_vel_w.shape == (16, 2, 3)
    np.testing.assert_allclose(loader.body_pos_w[1:, 0], rearing["trunk_position"][9::10], atol=1e-6)
    np.testing.assert_allclose(loader.body_quat_w[1:, 0], rearing["trunk_quaternion"][9::10], atol=1e-6)
    np.testing.assert_allclose(loader.joint_vel[1:], rearing["joint_velocity"][9::10], atol=1e-5)

    converter = (root / "scripts/csv_to_npz.py").read_text()
    exec(
        compile("from __future__ import annotations\n" + _class(converter, "MotionLoader"), "csv_to_npz.py", "exec"),
        scope,
    )
    raw = object.__new__(scope["MotionLoader"])
    raw.motion_file, raw.line_range, raw.device, raw.input_dt = str(tmp_path / "reference.csv"), None, "cpu", 0.02
    raw._load_motion()
    assert raw.input_frames == 16
    np.testing.assert_allclose(raw.motion_base_rots_input[1:], rearing["trunk_quaternion"][9::10], atol=1e-6)
    np.testing.assert_allclose(raw.motion_dof_poss_input[1:], rearing["joint_position"][9::10], atol=1e-6)


class _Torchlike(np.ndarray):
    """A numpy array with the one method of a tensor that is called."""

    def __new__(cls, values: np.ndarray) -> _Torchlike:
        return np.asarray(values).view(cls)

    def to(self, kind: object) -> _Torchlike:
        return self if isinstance(kind, str) else self.astype(kind).view(_Torchlike)  # type: ignore[call-overload]


@pytest.mark.slow
@pytest.mark.parametrize("name", FORMATS)
def test_the_same_motion_gives_the_same_bytes(rearing: Motion, tmp_path: Path, name: str) -> None:
    if name == "ros2":
        pytest.importorskip("mcap", reason="a bag needs mcap: pip install 'levade[ros2]'")
    one, two = (export(rearing, name, tmp_path / place) for place in ("one", "two"))
    assert len(one.written) == len(two.written) >= 2
    for a, b in zip(one.written, two.written, strict=True):
        assert a.read_bytes() == b.read_bytes()


def test_unknown_formats(rearing: Motion, tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match=r"to: no format 'jason'; did you mean json\?"):
        export(rearing, "jason", tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("there", [True, False])
def test_all_files_or_none(
    rearing: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failure: BaseException, there: bool
) -> None:
    place = tmp_path / "a" / "b"
    if there:
        place.mkdir(parents=True)
        (place / "motion.csv").write_text("mine")

    def fails(content: object, directory: Path) -> list[str]:
        (directory / "motion.csv").write_text("half")
        (directory / "deep").mkdir()
        (directory / "deep" / "half").write_text("half")
        raise failure

    monkeypatch.setitem(FORMATS, "csv", Format("fails", fails))
    with pytest.raises((LevadeError, KeyboardInterrupt)) as error:
        export(rearing, "csv", place)
    if isinstance(failure, OSError):
        assert str(error.value) == f"{place}: cannot be written (No space left on device); make room, then again"
    left = sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*"))
    assert left == (["a", "a/b", "a/b/motion.csv"] if there else [])
    if there:
        assert (place / "motion.csv").read_text() == "mine"


def test_other_files_in_the_directory_stay(rearing: Motion, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "motion.csv").write_text("old")
    export(rearing, "csv", tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["meta.json", "motion.csv", "notes.txt", "player.py"]
    assert (tmp_path / "motion.csv").read_text().startswith("time,")
    (tmp_path / "file").write_text("")
    with pytest.raises(LevadeError, match=r"file: cannot be written \(Not a directory\)"):
        export(rearing, "csv", tmp_path / "file")


@pytest.mark.slow
def test_notes_say_what_the_robot_would_find_out(held: Motion, tmp_path: Path) -> None:
    around = "the motion needs 1 box where its task has it (scene in the provenance); the rows do not say so"
    assert export(held, "csv", tmp_path).notes == ("the motion does not meet its success criteria", around)
    meta = json.loads((tmp_path / "meta.json").read_text())
    assert meta["provenance"]["scene"]["boxes"] == held.meta["task"]["scene"]["boxes"]
    limits = json.loads(json.dumps(held.meta["limits"]))
    limits["upper"][4] = held["joint_position"][:, 4].max() - 0.25
    narrow = replace(held, meta={**held.meta, "limits": limits, "success": True})
    assert export(narrow, "csv", tmp_path).notes == (
        around,
        "positions to send go beyond the range of rf_hfe, by up to 0.250 rad; player.py clamps them",
    )


@pytest.fixture(scope="module")
def arm_and_wheels() -> Motion:
    """A quadruped that holds an arm and four wheels, whose order in the file is not that of the legs."""
    robot = str(Path(__file__).parents[1] / "robots/cases/armwheel/robot.yaml")
    changes = ["search.population=8", "search.trials=8"]
    small = make_objective(load_task("squat-jump", robot=robot, changes=changes))
    return record(small, solve(small, seed=0), seed=0)


HELD = {"arm_yaw": 0.4, "arm_pitch": -0.5, "RR_wheelj": 0.0, "FL_wheelj": 0.0, "RL_wheelj": 0.0, "FR_wheelj": 0.0}


@pytest.mark.slow
@pytest.mark.parametrize("to", ["csv", "json", "mjlab", "unitree"])
def test_joints_that_are_held_are_named(arm_and_wheels: Motion, tmp_path: Path, to: str) -> None:
    notes = export(arm_and_wheels, to, tmp_path).notes
    assert (
        "the simulation holds arm_yaw 0.4, arm_pitch -0.5, RR_wheelj 0, FL_wheelj 0, RL_wheelj 0, FR_wheelj 0"
        " [rad, slides m], and no command says so: hold them there (meta: held)"
    ) in notes
    name = "motion.json" if to == "json" else "meta.json"
    meta = json.loads((tmp_path / name).read_text())
    assert (meta["meta"] if to == "json" else meta)["held"] == HELD
    played = Played.load(tmp_path / ("motion.json" if to == "json" else "motion.csv"))
    assert played.held == HELD
    assert not set(played.joints) & set(HELD)


@pytest.mark.slow
def test_mjlabs_reference_has_a_column_for_every_joint_of_its_mjcf(arm_and_wheels: Motion, tmp_path: Path) -> None:
    export(arm_and_wheels, "mjlab", tmp_path)
    theirs = mujoco.MjModel.from_xml_path(str(Path(__file__).parents[1] / "robots/cases/armwheel/pup.xml"))
    data = np.load(tmp_path / "reference.npz")
    names = [theirs.joint(i).name for i in range(1, theirs.njnt)]
    assert data["joint_names"].tolist() == names
    assert data["body_names"].tolist() == [theirs.body(i).name for i in range(1, theirs.nbody)]
    assert data["joint_pos"].shape == data["joint_vel"].shape == (len(data["joint_pos"]), 18)
    for joint, angle in HELD.items():
        assert (data["joint_pos"][:, names.index(joint)] == np.float32(angle)).all()
        assert (data["joint_vel"][:, names.index(joint)] == 0.0).all()
    state = mujoco.MjData(theirs)
    table = np.loadtxt(tmp_path / "reference.csv", delimiter=",")
    for row in range(
        0, len(table), 5
    ):  # their model, put as the reference says, has its bodies where the reference has them
        state.qpos[:3], state.qpos[3:7] = table[row, :3], table[row, [6, 3, 4, 5]]
        state.qpos[7:] = table[row, 7:]
        mujoco.mj_kinematics(theirs, state)
        np.testing.assert_allclose(data["body_pos_w"][row], state.xpos[1:], atol=1e-5)


def test_motions_of_before_hold_nothing_by_name(rearing: Motion, tmp_path: Path) -> None:
    meta = {key: value for key, value in rearing.meta.items() if key not in ("held", "model_joints")}
    export(replace(rearing, meta=meta), "mjlab", tmp_path)
    assert json.loads((tmp_path / "meta.json").read_text())["held"] == {}
    assert np.load(tmp_path / "reference.npz")["joint_pos"].shape[1] == 12


@pytest.mark.golden
def test_rates_too_slow_for_a_robot_are_said(rearing: Motion, tmp_path: Path) -> None:
    slow = "is slow for sending to a robot, for whose motion 200 Hz or more is right"
    assert export(rearing, "csv", tmp_path, rate=50.0).notes == (f"50 Hz {slow}",)
    assert export(rearing, "csv", tmp_path, rate=200.0).notes == ()
    assert (
        export(rearing, "mjlab", tmp_path).notes == ()
    )  # its rows are not sent, and player.py's are of the simulation's rate


def test_a_directory_in_the_way_leaves_all_as_it_was(rearing: Motion, tmp_path: Path) -> None:
    (tmp_path / "motion.csv").mkdir()
    (tmp_path / "meta.json").write_text("mine")
    with pytest.raises(
        LevadeError, match=r"motion.csv: is a directory, and a file of that name is to be written; move it"
    ):
        export(rearing, "csv", tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["meta.json", "motion.csv"]
    assert (tmp_path / "meta.json").read_text() == "mine"


def test_the_place_may_be_on_another_file_system(rearing: Motion, tmp_path: Path) -> None:
    other = Path("/dev/shm")
    if not other.is_dir() or other.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("needs two file systems: /dev/shm is not one of its own here")
    with TemporaryDirectory(dir=other) as there:
        (tmp_path / "link").symlink_to(there)
        export(rearing, "csv", tmp_path / "link")
        assert sorted(path.name for path in Path(there).iterdir()) == ["meta.json", "motion.csv", "player.py"]
