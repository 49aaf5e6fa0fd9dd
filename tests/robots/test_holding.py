"""Holding: bodies stay where MuJoCo's own kinematics put them at the angles at which their joints are held."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot

CASES = Path(__file__).parent / "cases"
TRUNK = '<geom name="trunk" type="box" size="0.2 0.04 0.05"/>'
HEAD = """
<body name="neck" pos="0.2 0 0.1" euler="0 0.3 0.5">
  <joint name="pan" axis="0 0 1" pos="0.01 0 0" ref="0.2"/><joint name="lift" type="slide" axis="0 0.6 0.8"/>
  <joint name="tilt" axis="0 1 0" pos="0 0 0.03" range="-1 1"/><inertial mass="1" pos="0.1 0 0" diaginertia="0.01 0.01 0.01"/>
  <body name="eye" pos="0.1 0 0"><joint name="gaze" type="ball"/><inertial mass="0.1" pos="0 0 0" diaginertia="1e-3 1e-3 1e-3"/>
  </body>
</body>
"""
POSE = "0 0 0.4 1 0 0 0"
LEGS = " 0 0.9 -1.8" * 2 + " 0 -0.9 1.8" * 2


def load(folder: Path, text: str, yaml: str = "") -> Robot:
    (folder / "toy.xml").write_text(text)
    (folder / "robot.yaml").write_text(f"model: toy.xml\n{yaml}")
    return load_robot(folder)


def expected(text: str, **angles: float | list[float]) -> mujoco.MjData:
    """The file's own kinematics, trunk on the world frame, legs at zero."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qpos[:3] = 0.0
    for joint, angle in angles.items():
        data.joint(joint).qpos[:] = angle
    mujoco.mj_kinematics(model, data)
    return data


def same_place(robot: Robot, data: mujoco.MjData, *bodies: str) -> None:
    ours = robot.data_at(np.zeros(len(robot.joint_names)))
    for body in bodies:
        np.testing.assert_allclose(ours.body(body).xpos, data.body(body).xpos, atol=2e-6)
        np.testing.assert_allclose(ours.body(body).xmat, data.body(body).xmat, atol=2e-6)


def test_several_joints_of_one_body_are_held_together(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf().replace(TRUNK, TRUNK + HEAD)
    robot = load(tmp_path, text, "fixed: {pan: 0.7, tilt: -0.4, lift: 0.05}\n")
    same_place(robot, expected(text, pan=0.7, tilt=-0.4, lift=0.05), "neck", "eye")
    assert robot.held == {"pan": 0.7, "lift": 0.05, "tilt": -0.4, "gaze": 0.0}


@pytest.mark.slow
@pytest.mark.parametrize("held", ["pan", "lift", "tilt"])
def test_joints_of_a_body_are_held_one_after_the_other(tmp_path: Path, quadruped: type, held: str) -> None:
    """First one that the description names, then the others, which are in no leg: the order does not matter."""
    text = quadruped().mjcf().replace(TRUNK, TRUNK + HEAD)
    angles = {"pan": 0.0, "lift": 0.0, "tilt": 0.0, held: 0.3}
    robot = load(tmp_path, text, f"fixed: {{{held}: 0.3}}\n")
    same_place(robot, expected(text, **angles), "neck", "eye")


def test_a_keyframe_holds_slides_and_balls_too(tmp_path: Path, quadruped: type) -> None:
    """qpos in the order of the bodies: the head comes before the legs."""
    ball = np.array([0.8, 0.0, 0.6, 0.0])
    key = f'<keyframe><key name="home" qpos="{POSE} 0.4 0.03 -0.2 0.8 0 0.6 0{LEGS}"/></keyframe></mujoco>'
    text = quadruped().mjcf().replace(TRUNK, TRUNK + HEAD).replace("</mujoco>", key)
    robot = load(tmp_path, text)
    same_place(robot, expected(text, pan=0.4, lift=0.03, tilt=-0.2, gaze=ball.tolist()), "neck", "eye")


def test_a_ball_is_held_at_zero_only(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf().replace(TRUNK, TRUNK + HEAD)
    with pytest.raises(LevadeError, match=r"robot\.yaml: fixed: joint gaze is a ball joint: it can be held at 0 only"):
        load(tmp_path, text, "fixed: {gaze: 0.3}\n")


def test_a_head_on_two_hinges_is_held() -> None:
    robot = load_robot(CASES / "head" / "pantilt.xml")
    assert robot.held == {"pan": 0.0, "tilt": 0.0}
    assert robot.mass == pytest.approx(12.9)


@pytest.mark.slow
def test_a_spine_is_held_and_the_legs_beyond_it_count() -> None:
    robot = load_robot(CASES / "spine" / "pup.xml")
    assert [leg.joints[0] for leg in robot.legs] == ["FL_hip", "FR_hip", "RL_hip", "RR_hip"]
    assert (robot.held, robot.mass) == ({"spine": 0.0}, pytest.approx(15.4))
    assert any(str(finding).startswith("spine: in no leg: held fixed") for finding in robot.findings)


@pytest.mark.slow
def test_an_arm_and_wheels_are_held_where_the_description_says() -> None:
    robot = load_robot(CASES / "armwheel" / "robot.yaml")
    wheels = dict.fromkeys(("RR_wheelj", "FL_wheelj", "RL_wheelj", "FR_wheelj"), 0.0)
    assert robot.held == {"arm_yaw": 0.4, "arm_pitch": -0.5, **wheels}
    text = (CASES / "armwheel" / "pup.xml").read_text()
    same_place(robot, expected(text, arm_yaw=0.4, arm_pitch=-0.5), "arm0", "arm1")


def test_the_centre_of_mass_of_a_trunk_with_an_arm_is_that_of_both() -> None:
    """MuJoCo's: that of the whole robot without what its legs carry."""
    robot = load_robot(CASES / "armwheel")
    model, data = robot.model, robot.data_at(robot.postures["neutral"])
    trunk = model.body(robot.trunk).id
    thighs = [int(model.jnt_bodyid[model.joint(leg.joints[0]).id]) for leg in robot.legs]
    masses = np.array([model.body_subtreemass[trunk], *-model.body_subtreemass[thighs]])
    moments = masses[:, None] * data.subtree_com[[trunk, *thighs]]
    np.testing.assert_allclose(robot.trunk_com_offset, moments.sum(axis=0) / masses.sum(), atol=1e-12)
    assert robot.trunk_com_offset[2] > 0.005  # the arm is on top
    assert masses.sum() == pytest.approx(6.6)


def test_a_trunk_alone_has_its_own_centre_of_mass_to_the_bit() -> None:
    robot = load_robot("hyq2max")
    np.testing.assert_array_equal(robot.trunk_com_offset, robot.model.body(robot.trunk).ipos)
