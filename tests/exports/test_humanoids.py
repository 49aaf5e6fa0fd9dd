"""Exports of a humanoid: all 29 joints of G1 in Unitree's order and in mjlab's, those included that are held."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.exports import export
from levade.exports.as_unitree import G1
from levade.exports.player import Motion as Played
from levade.motions import Motion
from levade.robots.packages import find_package_robot
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

pytestmark = pytest.mark.slow

SDK = {
    0: "left_hip_pitch",
    3: "left_knee",
    5: "left_ankle_roll",
    6: "right_hip_pitch",
    12: "waist_yaw",
    14: "waist_pitch",
    15: "left_shoulder_pitch",
    18: "left_elbow",
    19: "left_wrist_roll",
    22: "right_shoulder_pitch",
    28: "right_wrist_yaw",
}
"""Some of ``G1JointIndex`` in unitree_sdk2_python's example/g1/low_level/g1_low_level_example.py."""


@pytest.fixture(scope="module")
def g1() -> Motion:
    """A short motion of 20 joints; waist and wrists are held."""
    try:
        find_package_robot("mjlab:unitree_g1")
    except LevadeError as missing:
        pytest.skip(str(missing))
    changes = ["search.population=4", "search.trials=4", "hold=0.1", "horizon=0.2"]
    small = make_objective(load_task("squat-jump", robot="mjlab:unitree_g1", changes=changes), threads=1)
    return record(small, solve(small, seed=0), seed=0)


def test_unitrees_order_of_29_motors(g1: Motion, tmp_path: Path) -> None:
    notes = export(g1, "unitree", tmp_path).notes
    assert any("unitree_hg" in note and "mode_machine" in note for note in notes)
    meta = json.loads((tmp_path / "meta.json").read_text())
    motors = meta["provenance"]["motors"]
    assert len(G1) == 29
    assert list(motors) == list(G1)
    assert {i: list(motors.values())[i] for i in SDK} == {i: f"{name}_joint" for i, name in SDK.items()}
    with (tmp_path / "unitree.csv").open() as file:
        assert file.readline().strip().split(",") == [
            "time",
            *(f"{m}/{f}" for m in G1 for f in ("q", "dq", "tau", "kp", "kd")),
        ]
        commands = np.loadtxt(file, delimiter=",")[:, 1:].reshape(-1, 29, 5)
    names = list(g1.joint_names)
    for i, joint in enumerate(motors.values()):
        if joint in g1.held:
            np.testing.assert_array_equal(commands[:, i, :3], [[g1.held[joint], 0.0, 0.0]] * len(commands))
            assert (commands[:, i, 3:] > 0).all()
        else:
            np.testing.assert_array_equal(commands[1:, i, 0], g1["joint_position"][:, names.index(joint)])
    played = Played.load(tmp_path / "motion.csv")
    assert list(played.joints) == [motor for motor, joint in motors.items() if joint in names]
    assert set(played.held) == set(motors.values()) - set(names)


def test_unitrees_order_is_of_g1_alone(g1: Motion, tmp_path: Path) -> None:
    fewer = {name: angle for name, angle in g1.meta["held"].items() if name != "waist_roll_joint"}
    with pytest.raises(LevadeError, match=r"g1 has no waist_roll_joint; of robots on two legs, .* G1 with 29 joints"):
        export(replace(g1, meta={**g1.meta, "held": fewer}), "unitree", tmp_path / "a")
    assert list(tmp_path.iterdir()) == []


def test_mjlabs_order_of_joints_and_bodies(g1: Motion, tmp_path: Path) -> None:
    """mjlab's MotionLoader takes the arrays as they are, for the entity's joints and bodies: those of its MJCF."""
    export(g1, "mjlab", tmp_path)
    path = find_package_robot("mjlab:unitree_g1")
    assert path is not None
    theirs = mujoco.MjModel.from_xml_path(str(path))
    data = np.load(tmp_path / "reference.npz")
    assert data["joint_names"].tolist() == [theirs.joint(i).name for i in range(1, theirs.njnt)]
    assert data["body_names"].tolist() == [theirs.body(i).name for i in range(1, theirs.nbody)]
    assert data["joint_pos"].shape[1] == 29
    state = mujoco.MjData(theirs)
    for row in (0, -1):
        state.qpos[:3], state.qpos[3:7] = data["body_pos_w"][row, 0], data["body_quat_w"][row, 0]
        state.qpos[7:] = data["joint_pos"][row]
        mujoco.mj_kinematics(theirs, state)
        np.testing.assert_allclose(data["body_pos_w"][row], state.xpos[1:], atol=1e-5)
