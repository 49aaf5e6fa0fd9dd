"""MJCF: what is kept of a model, what is left out, and what stops it; on a robot whose every number is known."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import PID, DCMotor, Robot, load_robot
from levade.robots.meshes import stl

FLOOR = '<geom name="floor" type="plane" size="1 1 1"/>'
TRUNK = '<geom name="trunk" type="box" size="0.2 0.04 0.05"/>'
ARM = """
<body name="arm" pos="0.1 0 0.1" euler="0 0 0.5">
  <joint name="arm1" axis="0 0 1" ref="0.3"/><inertial mass="1" pos="0.1 0 0" diaginertia="0.01 0.01 0.01"/>
  <body name="arm_tip" pos="0.2 0 0">
    <joint name="arm2" axis="0 1 0" range="0.5 1"/><inertial mass="0.5" pos="0.1 0 0" diaginertia="0.01 0.01 0.01"/>
    <body name="finger" pos="0.1 0 0">
      <joint name="grip" type="slide" axis="1 0 0"/><inertial mass="0.1" pos="0 0 0" diaginertia="0.001 0.001 0.001"/>
    </body>
  </body>
</body>
"""
TENDON = (
    '<tendon><fixed name="t"><joint joint="arm1" coef="1"/></fixed></tendon><equality><tendon tendon1="t"/></equality>'
)
BALANCE = "body trunk: its inertia breaks the triangle inequality (two of its moments are below the third); fix it"
POSE = "0 0 0.3 1 0 0 0" + " 0 0.9 -1.8" * 2 + " 0 -0.9 1.8" * 2


def load(folder: Path, text: str, *changes: tuple[str, str]) -> Robot:
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "toy.xml").write_text(text)
    return load_robot(folder / "toy.xml")


def findings(robot: Robot, kind: str) -> list[str]:
    """Without the one that every MJCF has, which knows no speed limits."""
    of_kind = [str(finding) for finding in robot.findings if finding.kind == kind]
    return [finding for finding in of_kind if "no speed limit; " not in finding]


@pytest.mark.slow
def test_a_pd_step_is_that_of_the_models_own_servos(tmp_path: Path, quadruped: type) -> None:
    """From one state, with one target, MuJoCo's ``position`` actuators and levade's give the same, saturated or not."""
    text = quadruped().mjcf().replace(FLOOR, "")
    robot = load(tmp_path, text)
    assert isinstance(robot.actuation, DCMotor)
    robot = replace(robot, actuation=PID("servo", robot.actuation.kp, robot.actuation.kd, robot.limits.torque))
    own, ours = mujoco.MjModel.from_xml_string(text), robot.spec().compile()
    rng = np.random.default_rng(0)
    for scale in (0.05, 1.0):
        one, other = mujoco.MjData(own), mujoco.MjData(ours)
        angles, speeds = robot.postures["neutral"] + scale * rng.normal(size=12), scale * rng.normal(size=12)
        target = robot.postures["neutral"]
        for model, data, ctrl in ((own, one, target), (ours, other, np.stack([target, np.zeros(12)], axis=1).ravel())):
            assert [model.joint(j).name for j in range(1, 13)] == list(robot.joint_names)
            data.qpos[7:], data.qvel[6:], data.ctrl[:] = angles, speeds, ctrl
            mujoco.mj_step(model, data)
        saturated = np.abs(one.qfrc_actuator[6:]) > 18 - 1e-9
        assert saturated.any() == (scale == 1.0)
        np.testing.assert_allclose(other.qfrc_actuator, one.qfrc_actuator, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(other.qvel, one.qvel, rtol=1e-6, atol=1e-9)


def test_gains_limits_and_damping_are_the_models(tmp_path: Path, quadruped: type) -> None:
    robot = load(tmp_path, quadruped().mjcf())
    np.testing.assert_allclose(robot.actuation.kp, 60)
    np.testing.assert_allclose(robot.actuation.kd, 1.5)
    np.testing.assert_allclose(robot.limits.torque, 18)
    np.testing.assert_allclose(robot.model.dof_damping[6:], 0.1)
    np.testing.assert_allclose(robot.limits.velocity, 4 * np.sqrt(9.81 / 0.4))
    assert (robot.limits.assumed_velocity, robot.limits.assumed_torque) == (tuple(range(12)), ())
    assert robot.origins["gains"] == "the model's servos"
    assert findings(robot, "warning") == []


@pytest.mark.parametrize(
    ("actuator", "torque"),
    [
        ('<motor joint="{}" ctrlrange="-25 25"/>', 25),
        ('<motor joint="{}" ctrlrange="-1 1" gear="25"/>', 25),
        ('<general joint="{}" gainprm="2" ctrlrange="-30 30" forcerange="-22 22"/>', 22),
        ('<velocity joint="{}" kv="3" forcerange="-21 21"/>', 21),
    ],
)
def test_what_is_no_position_servo_is_replaced_by_one(
    tmp_path: Path, quadruped: type, actuator: str, torque: float
) -> None:
    robot = load(tmp_path, quadruped().mjcf(actuator))
    np.testing.assert_allclose(robot.limits.torque, torque)
    assert robot.origins["gains"] == "derived from mass and inertia"
    assert robot.spec().compile().nu == 24


@pytest.mark.parametrize(
    "default",
    ['ctrlrange="-1 1"', 'gear="25" ctrlrange="-1 1"', 'forcerange="-1 1"', 'ctrllimited="true" ctrlrange="-1 1"'],
)
def test_defaults_of_actuators_are_not_those_of_levades_servos(tmp_path: Path, quadruped: type, default: str) -> None:
    """The servos are those of the same file with the numbers at each actuator."""
    text = quadruped().mjcf('<motor joint="{}"/>')
    ours = load(tmp_path, text, ("<worldbody>", f"<default><motor {default}/></default><worldbody>")).spec().compile()
    theirs = load(tmp_path, quadruped().mjcf(f'<motor joint="{{}}" {default}/>')).spec().compile()
    for name in ("gear", "ctrllimited", "ctrlrange", "forcelimited", "forcerange", "gainprm", "biasprm"):
        np.testing.assert_array_equal(getattr(ours, f"actuator_{name}"), getattr(theirs, f"actuator_{name}"), name)


def test_servos_geared_are_those_of_the_joint(tmp_path: Path, quadruped: type) -> None:
    robot = load(tmp_path, quadruped().mjcf('<position joint="{}" kp="2" kv="0.1" gear="5" forcerange="-3 3"/>'))
    np.testing.assert_allclose(robot.actuation.kp, 50)
    np.testing.assert_allclose(robot.actuation.kd, 2.5)
    np.testing.assert_allclose(robot.limits.torque, 15)


def test_limits_of_the_joint_count_too(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf().replace(' damping="0.1"', ' damping="0.1" actuatorfrcrange="-12 12"')
    np.testing.assert_allclose(load(tmp_path, text).limits.torque, 12)


def test_a_leg_joint_without_an_actuator_gets_one_and_a_warning(tmp_path: Path, quadruped: type) -> None:
    missing = '<position joint="lf_haa" kp="60" kv="1.5" forcerange="-18 18"/>'
    robot = load(tmp_path, quadruped().mjcf(), (missing, ""))
    assumed = robot.mass * 9.81 * 0.2
    np.testing.assert_allclose(robot.limits.torque, [assumed] + [18] * 11)
    np.testing.assert_allclose(robot.actuation.kp[1:], 60)
    assert findings(robot, "warning") == [
        f"joint lf_haa: without an actuator in the model: servos of {assumed:.3g} Nm are added;"
        " robot.yaml, limits: {torque: ...} gives the real one"
    ]


def test_a_model_without_actuators_gets_servos(tmp_path: Path, quadruped: type) -> None:
    robot = load(tmp_path, re.sub(r"<actuator>.*</actuator>", "", quadruped().mjcf(), flags=re.DOTALL))
    assert robot.spec().compile().nu == 24
    assert len(findings(robot, "warning")) == 1
    assert findings(robot, "warning")[0].startswith("all joints: no torque limit; ")


def test_an_arm_is_held_fixed_and_its_mass_counts(tmp_path: Path, quadruped: type) -> None:
    """Where MuJoCo's own kinematics put its bodies at the angles that levade takes."""
    text = quadruped().mjcf().replace(TRUNK, TRUNK + ARM).replace("</mujoco>", TENDON + "</mujoco>")
    robot = load(tmp_path, text)
    assert robot.mass == pytest.approx(quadruped().mass - 4 * 0.05 + 1.6)  # feet of this model weigh nothing
    assert robot.joint_names[0] == "lf_haa"
    assert len(robot.joint_names) == 12
    assert (robot.model.njnt, robot.model.ntendon, robot.model.neq) == (13, 0, 0)
    full = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(full)
    data.qpos[:3] = 0.0
    data.joint("arm1").qpos[0] = 0.0
    data.joint("arm2").qpos[0] = 0.5  # the nearest to zero in its range
    mujoco.mj_kinematics(full, data)
    ours = robot.data_at(np.zeros(12))
    for body in ("arm", "arm_tip", "finger"):
        np.testing.assert_allclose(ours.body(body).xpos, data.body(body).xpos, atol=1e-6)
        np.testing.assert_allclose(ours.body(body).xmat, data.body(body).xmat, atol=1e-6)
    assert any(said.startswith("arm1, arm2, grip: in no leg: held fixed at zero") for said in findings(robot, "note"))


def test_an_arm_of_three_hinges_is_told_from_legs_by_its_axes(tmp_path: Path, quadruped: type) -> None:
    arm = ARM.replace('name="grip" type="slide"', 'name="grip"')
    robot = load(tmp_path, quadruped().mjcf(), (TRUNK, TRUNK + arm))
    assert [leg.joints[0] for leg in robot.legs] == ["lf_haa", "rf_haa", "lh_haa", "rh_haa"]


def test_a_keyframe_that_stands_is_the_neutral_posture(tmp_path: Path, quadruped: type) -> None:
    lying = POSE.replace("1.8", "2.4").replace("0.9", "0")
    keys = f'<keyframe><key name="lying" qpos="{lying}"/><key name="home" qpos="{POSE}"/>'
    robot = load(tmp_path, quadruped().mjcf(), ("</mujoco>", keys + "</keyframe></mujoco>"))
    np.testing.assert_allclose(robot.postures["neutral"], [0, 0.9, -1.8] * 2 + [0, -0.9, 1.8] * 2)
    assert robot.origins["neutral"] == "keyframe home of the model"


@pytest.mark.parametrize(
    "pose",
    [
        POSE.replace("1 0 0 0", "0 1 0 0"),  # upside down
        POSE.replace("1.8", "2.4"),  # lying
        POSE.replace("-1.8", "1.8"),  # out of range
    ],
)
def test_a_keyframe_that_does_not_stand_is_not(tmp_path: Path, quadruped: type, pose: str) -> None:
    key = f'<keyframe><key name="home" qpos="{pose}"/></keyframe></mujoco>'
    robot = load(tmp_path, quadruped().mjcf(), ("</mujoco>", key))
    assert robot.origins["neutral"].startswith("found by search")


def test_the_world_beside_the_robot_is_left_out(tmp_path: Path, quadruped: type) -> None:
    world = (
        '<body name="table"><geom name="top" size="1"/></body><body name="ball"><freejoint/><geom name="b" size="0.1"/></body>'
        '<body mocap="true" name="target"><geom size=".1" contype="0" conaffinity="0"/></body>'
        '<light pos="0 0 1"/><camera name="c" mode="trackcom" target="trunk"/></worldbody>'
        '<contact><pair geom1="floor" geom2="lf_foot"/><pair geom1="b" geom2="rf_foot"/>'
        '<exclude body1="table" body2="trunk"/></contact><sensor><framequat objtype="body" objname="trunk"/></sensor>'
    )
    robot = load(tmp_path, quadruped().mjcf(), ("</worldbody>", world))
    model = robot.model
    assert (model.nbody, model.ngeom, model.npair, model.ncam, model.nlight, model.nsensor) == (14, 5, 0, 0, 0, 0)


def test_nameless_parts_get_names_that_are_free(tmp_path: Path, quadruped: type) -> None:
    parts = (
        '<body name="body3"><geom size="0.01" mass="0.1"/></body>' + '<body><geom size="0.01" mass="0.1"/></body>' * 3
    )
    robot = load(tmp_path, quadruped().mjcf().replace('name="lf_foot"', ""), (TRUNK, TRUNK + parts))
    names = [robot.model.body(b).name for b in range(robot.model.nbody)]
    assert len(set(names)) == len(names)
    assert robot.legs[0].foot.startswith("lf_shank")


@pytest.mark.slow
def test_meshes_travel_with_the_robot(tmp_path: Path, quadruped: type) -> None:
    triangles = 0.1 * np.array([[[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
                                [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 0, 0], [0, 0, 1], [0, 1, 0]]])  # fmt: skip
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "shell.stl").write_bytes(stl(triangles))
    changes = (
        ('angle="radian"', 'angle="radian" meshdir="parts"'),
        ("<worldbody>", '<asset><mesh file="shell.stl"/><mesh file="gone.stl"/></asset><worldbody>'),
        (TRUNK, TRUNK + '<geom type="mesh" mesh="shell"/><geom type="mesh" mesh="gone"/>'),
    )
    robot = load(tmp_path, quadruped().mjcf(), *changes)
    assert list(robot.assets) == ["shell.stl"]
    assert findings(robot, "warning") == [
        "body trunk: collides as its other geoms only, missing: gone.stl; put the file where it says"
    ]
    assert robot.spec().compile().nmesh == 1
    visual = (changes[2][0], TRUNK + '<geom type="mesh" mesh="gone" contype="0" conaffinity="0"/>')
    assert findings(load(tmp_path, quadruped().mjcf(), *changes[:2], visual), "warning") == []


def test_a_missing_mesh_that_the_inertia_needs_is_an_error(tmp_path: Path, quadruped: type) -> None:
    changes = (
        ("<worldbody>", '<asset><mesh name="hull" file="gone.stl"/></asset><worldbody>'),
        (TRUNK, '<geom type="mesh" mesh="hull"/>'),
        ('<inertial mass="6.0" pos="0 0 0" diaginertia="0.1 0.1 0.1"/>', ""),
    )
    with pytest.raises(
        LevadeError, match=r"the inertia of body trunk comes from the mesh hull, missing: gone\.stl; put"
    ):
        load(tmp_path, quadruped().mjcf(), *changes)


def test_compilers_that_hide_mistakes_are_told_of(tmp_path: Path, quadruped: type) -> None:
    flags = ('angle="radian"', 'angle="radian" balanceinertia="true" boundmass="0.1"')
    robot = load(tmp_path, quadruped().mjcf(), flags, ('diaginertia="0.1 0.1 0.1"', 'diaginertia="0.1 0.1 0.4"'))
    assert findings(robot, "warning") == [
        "body trunk: the inertia breaks the triangle inequality; balanceinertia takes the mean of its moments about every"
        " axis; fix it in the file",
        "compiler boundmass: raises smaller and missing values to 0.1 kg; give every body its own value, and remove"
        " this setting",
    ]
    np.testing.assert_allclose(robot.model.body("trunk").inertia, 0.2)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("</mujoco>", "", "toy.xml: broken XML (no element found: line"),
        ('range="-0.8 0.8"', 'range="0.8 -0.8"', "joint lf_haa: limits are inverted, lower 0.8 is above upper -0.8; exchange"),
        ("<freejoint/>", "", "no free base, the robot is bolted to the world; give its trunk a <freejoint/> (a URDF gets one)"),
        ('mass="0.2"', 'mass="0"', "body lf_shank moves but has no mass or no inertia; give it both, in kg and kg m2"),
        ('diaginertia="0.1 0.1 0.1"', 'diaginertia="0.1 0.1 0.4"', BALANCE),
        ("<worldbody>", '<include file="gone.xml"/><worldbody>', "Error opening file 'gone.xml'"),
        ('joint="lf_haa"', 'joint="lf_hab"', "lf_hab"),
        ('angle="radian"', 'angle="degree"', "no standing posture within the joints' ranges has the feet under the hips; give"),
        ('<joint name="lf_kfe"', '<joint name="lf_kfe" type="slide"', "a limb of 3 joints (1 of them sliding) (from lf_haa)"),
    ],
)  # fmt: skip
def test_what_cannot_be_simulated_is_refused(tmp_path: Path, quadruped: type, old: str, new: str, message: str) -> None:
    with pytest.raises(LevadeError, match=re.escape(message)) as caught:
        load(tmp_path, quadruped().mjcf(), (old, new))
    assert str(tmp_path / "toy.xml") in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is empty; give an MJCF or URDF"),
        (b"<sdf></sdf>", "starts with <sdf>; a URDF starts with <robot>, an MJCF with <mujoco>"),
        (b"\x89PNG\xff", "not a text file; give an MJCF or URDF"),
        (b"robot", "broken XML (syntax error: line 1, column 0); fix it there"),
    ],
)
def test_what_is_no_model_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    (tmp_path / "toy.xml").write_bytes(content)
    with pytest.raises(LevadeError, match=re.escape(f"{tmp_path / 'toy.xml'}: {message}")):
        load_robot(tmp_path / "toy.xml")
