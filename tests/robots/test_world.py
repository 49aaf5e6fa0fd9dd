"""World: which bodies of a file are the robot, and that nothing holds it from outside."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot

CASES = Path(__file__).parent / "cases"
GRAVITY = 9.81
TRUNK = '<body name="trunk" pos="0 0 0.4">'
ANCHOR = '<site name="hook" pos="0 0 2"/><body name="crane" mocap="true" pos="0 0 1"/>'


def load(folder: Path, text: str, *changes: tuple[str, str], yaml: str = "") -> Robot:
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "toy.xml").write_text(text)
    if yaml:
        (folder / "robot.yaml").write_text(f"model: toy.xml\n{yaml}")
    return load_robot(folder / "toy.xml")


def findings(robot: Robot, kind: str) -> list[str]:
    """Without the one that every MJCF has, which knows no speed limits."""
    of_kind = [str(finding) for finding in robot.findings if finding.kind == kind]
    return [finding for finding in of_kind if "no speed limit; " not in finding]


def fall(robot: Robot, duration: float = 0.1) -> float:
    """[m] by which the centre of mass of the robot, let go in mid-air, comes down."""
    model = robot.model
    data = robot.data_at(robot.postures["neutral"])
    data.qpos[2] = 1.0
    mujoco.mj_forward(model, data)
    before = float(data.subtree_com[0, 2])
    mujoco.mj_step(model, data, round(duration / model.opt.timestep))
    mujoco.mj_forward(model, data)
    return before - float(data.subtree_com[0, 2])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([("<freejoint/>", '<joint type="free" damping="10"/>')], "damping would tie the floating base to the world"),
        ([("<freejoint/>", '<joint type="free" armature="2" frictionloss="3"/>')], "armature, frictionloss would tie"),
        ([("<freejoint/>", '<joint type="free" stiffness="50"/>')], "stiffness would tie the floating base"),
        ([("<worldbody>", '<default><joint armature="0.5"/></default><worldbody>'),
          ("<freejoint/>", '<joint type="free"/>')], "armature would tie the floating base to the world"),
        ([("</mujoco>", '<equality><weld name="gantry" body1="trunk"/></equality></mujoco>')],
         "<weld> gantry between trunk and world: ties the robot to the world: left out"),
        ([("</mujoco>", '<equality><connect body1="trunk" anchor="0 0 0"/></equality></mujoco>')],
         "<connect> between trunk and world: ties the robot"),
        ([(TRUNK, ANCHOR + TRUNK), ("</mujoco>", '<equality><weld body1="crane" body2="trunk"/></equality></mujoco>')],
         "<weld> between crane and trunk: ties the robot"),
        ([(TRUNK, f'{ANCHOR}{TRUNK}<site name="eye"/>'),
          ("</mujoco>", '<equality><connect site1="hook" site2="eye"/></equality></mujoco>')],
         "<connect> between world and trunk: ties the robot"),
        ([(TRUNK, f'{ANCHOR}{TRUNK}<site name="eye"/>'),
          ("</mujoco>", '<tendon><spatial name="rope" stiffness="500"><site site="hook"/><site site="eye"/></spatial></tendon>'
           '<equality><tendon tendon1="rope"/></equality></mujoco>')],
         "<tendon> rope: ties the robot"),
        ([("<worldbody>", '<option density="1000" viscosity="0.1" wind="3 0 0"/><worldbody>')],
         "option density, viscosity, wind: the drag of a medium is left out"),
        ([(TRUNK, TRUNK.replace(">", ' gravcomp="1">'))], "body trunk: gravity is compensated there"),
    ],
)  # fmt: skip
def test_the_base_falls_as_galileo_says_whatever_the_file_ties_it_to(
    tmp_path: Path, quadruped: type, changes: list[tuple[str, str]], said: str
) -> None:
    robot = load(tmp_path, quadruped().mjcf(), *changes)
    assert any(said in warning for warning in findings(robot, "warning"))
    assert fall(robot) == pytest.approx(0.5 * GRAVITY * 0.1**2, rel=0.03)  # MuJoCo's first step: 2 % more
    assert (robot.model.neq, robot.model.ntendon) == (0, 0)


def test_a_free_robot_loses_nothing(tmp_path: Path, quadruped: type) -> None:
    robot = load(tmp_path, quadruped().mjcf())
    assert findings(robot, "warning") == []
    assert fall(robot) == pytest.approx(0.5 * GRAVITY * 0.1**2, rel=0.03)


def test_syrup_from_a_default_class_is_left_out() -> None:
    robot = load_robot(CASES / "free-damped" / "strong.xml")
    assert not robot.model.dof_damping[:6].any()
    assert not robot.model.dof_armature[:6].any()
    assert fall(robot) == pytest.approx(0.5 * GRAVITY * 0.1**2, rel=0.03)
    np.testing.assert_allclose(robot.model.dof_damping[6:], 10.0)  # of the legs, it is the model's


@pytest.mark.parametrize("scene", ["door", "cart"])
def test_furniture_is_no_part_of_the_robot(scene: str) -> None:
    robot = load_robot(CASES / "scene-ball" / f"{scene}.xml")
    assert robot.mass == pytest.approx(12.4)
    assert (robot.trunk, len(robot.joint_names), robot.model.nbody) == ("trunk", 12, 14)
    left_out = "body cart: of" if scene == "cart" else "body frame: of"
    assert any(note.startswith(left_out) for note in findings(robot, "note"))


def test_keyframes_count_with_furniture_in_the_scene() -> None:
    assert load_robot(CASES / "scene-ball" / "door.xml").origins["neutral"] == "keyframe home of the model"


@pytest.mark.slow
def test_of_two_robots_the_description_names_one(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf()
    inside = text[text.index(TRUNK) : text.index("</worldbody>")]
    renamed = inside.replace('name="', 'name="b_').replace('mass="6.0"', 'mass="7.0"')
    text = text.replace("</worldbody>", renamed + "</worldbody>")
    with pytest.raises(
        LevadeError, match=r"2 bodies float freely \(trunk, b_trunk\); name the robot's in a robot.yaml"
    ):
        load(tmp_path, text)
    assert load(tmp_path, text, yaml="trunk: b_trunk\n").joint_names[0] == "b_lf_haa"
    legs = "".join(
        f"  {leg}: {{joints: [{leg}_haa, {leg}_hfe, {leg}_kfe], foot: {leg}_foot, side: {side}, end: {end}}}\n"
        for leg, side, end in zip(
            ("lf", "rf", "lh", "rh"), ("left", "right") * 2, ("front",) * 2 + ("hind",) * 2, strict=True
        )
    )
    assert load(tmp_path, text, yaml=f"legs:\n{legs}").mass == pytest.approx(quadruped().mass - 4 * 0.05)


@pytest.mark.slow
def test_a_trunk_named_without_a_free_joint_floats_and_a_ball_does_not_stand_in_for_it(
    tmp_path: Path, quadruped: type
) -> None:
    ball = '<body name="ball"><freejoint/><geom size="0.1" mass="2"/></body></worldbody>'
    changes = (("<freejoint/>", ""), ("</worldbody>", ball))
    with pytest.raises(LevadeError, match="no free base, the robot is bolted to the world"):
        load(tmp_path, quadruped().mjcf(), *changes)
    robot = load(tmp_path, quadruped().mjcf(), *changes, yaml="trunk: trunk\n")
    assert robot.mass == pytest.approx(quadruped().mass - 4 * 0.05)


def test_a_tree_of_joints_that_is_tied_to_the_robot_is_furniture_too(tmp_path: Path, quadruped: type) -> None:
    gate = '<body name="gate"><joint name="g"/><geom name="bar" size="0.1" mass="9"/></body></worldbody>'
    extra = (
        '<contact><exclude body1="gate" body2="trunk"/><pair geom1="bar" geom2="lf_foot"/></contact>'
        '<equality><joint joint1="g" joint2="lf_haa"/></equality></mujoco>'
    )
    robot = load(tmp_path, quadruped().mjcf(), ("</worldbody>", gate), ("</mujoco>", extra))
    assert (robot.mass, robot.model.neq, robot.model.npair) == (pytest.approx(quadruped().mass - 4 * 0.05), 0, 0)


def test_feet_that_touch_by_pairs_only_stand_on_every_ground() -> None:
    robot = load_robot(CASES / "pairs" / "pup.xml")
    assert robot.feet == ("FL_foot", "FR_foot", "RL_foot", "RR_foot")
    spec = robot.spec()
    ground = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
    ground.contype = ground.conaffinity = 0x7FFFFFFF
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:7] = [0, 0, 0.2, 1, 0, 0, 0]
    for joint, angle in zip(robot.joint_names, robot.postures["neutral"], strict=True):
        data.joint(joint).qpos[0] = angle
    mujoco.mj_forward(model, data)
    touching = {model.geom(int(g)).name for contact in data.contact for g in contact.geom} - {""}
    assert touching == set(robot.feet)


def test_a_pairs_friction_comes_along(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf().replace('size="0.02" pos', 'contype="0" conaffinity="0" size="0.02" pos')
    pairs = "".join(
        f'<pair geom1="{leg}_foot" geom2="floor" friction="0.3 0.3 0.01 0.002 0.002" condim="6" solref="0.01 1"/>'
        for leg in ("lf", "rf", "lh", "rh")
    )
    robot = load(tmp_path, text, ("</mujoco>", f"<contact>{pairs}</contact></mujoco>"))
    foot = robot.model.geom("lf_foot")
    np.testing.assert_allclose(foot.friction, [0.3, 0.01, 0.002])
    assert (int(foot.condim[0]), foot.solref.tolist()) == (6, [0.01, 1.0])
