"""Loading a robot: what it yields, that it survives the way through text, and what it says about mistakes."""

from __future__ import annotations

import pickle
import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

import levade.robots
from levade.errors import LevadeError
from levade.robots import PID, builtin_robots, load_robot

HYQ2MAX = Path(levade.robots.__file__).parent / "data" / "hyq2max"

# A two-legged toy: one hinge a leg, a mesh, a motor and a ball foot; no free joint, so that the loader has to add it.
TOY_MODEL = """
<mujoco model="toy">
  <compiler meshdir="parts"/>
  <include file="shapes.xml"/>
  <worldbody>
    <body name="base" pos="0 0 1">
      <geom type="mesh" mesh="wedge" mass="2"/>
      <body name="left" pos="0 0.1 0">
        <joint name="left_hip" axis="0 1 0"/>
        <geom name="left_foot" type="sphere" size="0.02" pos="0 0 -0.5" mass="1"/>
      </body>
      <body name="right" pos="0 -0.1 0">
        <joint name="right_hip" axis="0 1 0" range="-90 90"/>
        <geom name="right_foot" type="box" size="0.05 0.05 0.01" pos="0 0 -0.5" mass="1"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="left_hip"/></actuator>
  <keyframe><key qpos="0 0"/></keyframe>
</mujoco>
"""
TOY = """
name: toy
model: toy.xml
trunk: base
legs:
  l: {joints: [left_hip], foot: left_foot, side: left, end: front}
  r: {joints: [right_hip], foot: right_foot, side: right, end: front}
postures:
  neutral: 0
limits: {torque: {left_hip: 5, "*_hip": 7}}
actuation: servo
actuations:
  servo: {kind: pid, kp: 20, kd: 1}
  motor: {kind: dcmotor, kp: 20, kd: 1, stall_torque: 9, no_load_speed: 30}
"""
TAIL = '<body><joint name="tail"/><geom size="1"/></body>'
WEDGE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    """The folder of the toy robot."""
    (tmp_path / "parts" / "trunk").mkdir(parents=True)
    (tmp_path / "parts" / "trunk" / "wedge.obj").write_text(WEDGE)
    (tmp_path / "shapes.xml").write_text('<mujoco><asset><mesh file="trunk/wedge.obj"/></asset></mujoco>')
    (tmp_path / "toy.xml").write_text(TOY_MODEL)
    (tmp_path / "robot.yaml").write_text(TOY)
    return tmp_path


def change(folder: Path, old: str, new: str, file: str = "robot.yaml") -> Path:
    text = (folder / file).read_text()
    assert old in text
    (folder / file).write_text(text.replace(old, new))
    return folder / "robot.yaml"


def test_hyq2max_in_its_own_words() -> None:
    robot = load_robot("hyq2max")
    assert robot.joint_names == tuple(
        f"{leg}_{joint}" for leg in ("lf", "rf", "lh", "rh") for joint in ("haa", "hfe", "kfe")
    )
    assert robot.feet == ("lf_foot", "rf_foot", "lh_foot", "rh_foot")
    np.testing.assert_allclose(robot.trunk_com_offset, [0.060663, 0.000598, -0.007592])
    np.testing.assert_allclose(robot.posture("neutral")[:9], [-0.075, 0.63, -1.32] * 2 + [-0.075, -0.63, 1.32])
    np.testing.assert_allclose(np.degrees(robot.limits.lower[:3]), [-45, -135, -167], atol=1e-3)
    np.testing.assert_allclose(np.degrees(robot.limits.upper[6:9]), [45, 135, 167], atol=1e-3)
    np.testing.assert_array_equal(robot.limits.torque[:3], [120, 245, 250])
    np.testing.assert_array_equal(robot.limits.velocity, 12)
    assert ("hyq2max", robot.description) in builtin_robots()


def test_to_xml_keeps_names_materials_and_masses() -> None:
    """MuJoCo's writer rounds to six digits: half a unit of the sixth is at most 5e-6 of a number."""
    robot = load_robot("hyq2max")
    text = robot.spec().to_xml()
    model, source = mujoco.MjModel.from_xml_string(text), mujoco.MjModel.from_xml_path(str(HYQ2MAX / "hyq2max.xml"))
    for kind, count in (("body", "nbody"), ("joint", "njnt"), ("geom", "ngeom"), ("material", "nmat")):
        assert getattr(model, count) == getattr(source, count)
        names = [[getattr(m, kind)(i).name for i in range(getattr(m, count))] for m in (model, source)]
        assert names[0] == names[1]
    np.testing.assert_array_equal(model.body_mass, source.body_mass)
    np.testing.assert_allclose(model.body_ipos, source.body_ipos, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(model.body_inertia, source.body_inertia, rtol=5e-6)
    np.testing.assert_allclose(model.jnt_range, source.jnt_range, rtol=5e-6)
    np.testing.assert_array_equal(model.geom_matid, source.geom_matid)
    np.testing.assert_array_equal(model.geom_friction, source.geom_friction)
    again = mujoco.MjSpec.from_string(text).to_xml()
    twice = mujoco.MjModel.from_xml_string(again)
    np.testing.assert_array_equal(twice.body_mass, model.body_mass)
    assert twice.nu == model.nu == 24


@pytest.mark.slow
def test_linkage_lowers_the_knees_limits_and_nothing_else() -> None:
    plain, linked = load_robot("hyq2max"), load_robot("hyq2max", linkage=True)
    assert not plain.limits.torque_curves
    assert sorted(linked.limits.torque_curves) == [2, 5, 8, 11]
    angles = np.zeros((3, 12))
    angles[:, [2, 5]], angles[:, [8, 11]] = -np.radians([[2], [84.5], [167]]), np.radians([[2], [84.5], [167]])
    limit = linked.limits.torque_at(angles)
    np.testing.assert_allclose(limit[:, [2, 5, 8, 11]], np.array([[125], [250], [125]]) * np.ones(4), rtol=2e-3)
    np.testing.assert_array_equal(limit[:, [0, 1]], plain.limits.torque_at(angles)[:, [0, 1]])
    assert linked.spec().to_xml() == plain.spec().to_xml()


def test_gains_can_be_replaced() -> None:
    robot = load_robot("hyq2max", kp=300, kd=5)
    np.testing.assert_array_equal(robot.actuation.kp, 300)
    np.testing.assert_array_equal(robot.actuation.kd, 5)


def test_a_robot_can_be_pickled_for_other_processes() -> None:
    robot = load_robot("hyq2max")
    assert robot.neutral_height > 0  # so that the compiled model rides along
    assert pickle.loads(pickle.dumps(robot)).spec().to_xml() == robot.spec().to_xml()


@pytest.mark.slow
def test_a_users_robot_with_mesh_include_and_no_free_joint(toy: Path) -> None:
    robot = load_robot(toy)
    assert list(robot.assets) == ["wedge.obj"]
    spec = robot.spec()
    model = mujoco.MjModel.from_xml_string(spec.to_xml(), dict(robot.assets))
    assert (model.nq, model.nu, model.nkey) == (9, 4, 0)
    np.testing.assert_allclose(model.actuator_forcerange, [[-5, 5], [-7, 7]])
    assert robot.limits.lower[0] == -np.inf
    assert robot.limits.lower[1] == pytest.approx(-np.pi / 2, rel=1e-5)
    np.testing.assert_allclose(robot.limits.velocity, 4 * np.sqrt(9.81 / 0.514675), rtol=1e-3)  # assumed
    assert robot.limits.assumed_velocity == (0, 1)
    assert isinstance(robot.actuation, PID)  # as the description says
    np.testing.assert_array_equal(load_robot(toy, actuation="motor").limits.velocity, 30)
    assert robot.neutral_height == pytest.approx(0.52)


@pytest.mark.slow
def test_a_path_may_be_the_folder_the_file_or_a_string(toy: Path) -> None:
    assert (
        load_robot(toy).name == load_robot(toy / "robot.yaml").name == load_robot(str(toy / "robot.yaml")).name == "toy"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("hyq2mx",), "no robot 'hyq2mx'; did you mean hyq2max? (or the path of an MJCF, URDF or robot.yaml)"),
        (
            ("spot/robot.yaml",),
            "spot/robot.yaml: no such file; give a built-in robot, or the path of an MJCF, URDF or robot.yaml",
        ),
        (
            ("go1.xml",),
            "go1.xml: no such file; give a built-in robot, or the path of an MJCF, URDF or robot.yaml",
        ),
    ],
)
def test_unknown_robot(arguments: tuple[str], message: str) -> None:
    with pytest.raises(LevadeError, match=f"^{re.escape(message)}$"):
        load_robot(*arguments)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"actuation": "hidraulic"}, "actuation: no actuation 'hidraulic'; did you mean hydraulic?"),
        ({"variant": "raw_inertia"}, "variant: no variant 'raw_inertia'; did you mean raw-inertia?"),
        ({"kp": -1.0}, "kp should be a number that is not negative, is -1.0"),
        ({"kd": float("nan")}, "kd should be a number that is not negative, is nan"),
    ],
)
def test_unknown_options(options: dict, message: str) -> None:
    with pytest.raises(LevadeError, match=re.escape(message)):
        load_robot("hyq2max", **options)


def test_options_that_the_robot_does_not_have(toy: Path) -> None:
    with pytest.raises(LevadeError, match=r"robot\.yaml: linkage: asked for, but the description has none"):
        load_robot(toy, linkage=True)
    with pytest.raises(LevadeError, match=r"variant: no variant 'light'; it has none"):
        load_robot(toy, variant="light")


def test_unknown_leg_and_posture() -> None:
    robot = load_robot("hyq2max")
    with pytest.raises(LevadeError, match="robot hyq2max: no leg 'fl'; "):
        robot.leg("fl")
    with pytest.raises(LevadeError, match=r"robot hyq2max: no posture 'neutrl'; did you mean neutral\?"):
        robot.posture("neutrl")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        # keys
        ("trunk: base", "trunc: base", "robot.yaml: trunc: unknown key; did you mean trunk?"),
        ("foot: left_foot", "fot: left_foot", "robot.yaml: legs.l.fot: unknown key; did you mean foot?"),
        ("stall_torque: 9", "stal_torque: 9", "actuations.motor.stal_torque: unknown key; did you mean stall_torque?"),
        ("limits: {torque:", "limits: {torques:", "limits.torques: unknown key; did you mean torque?"),
        ("trunk: base", "", "robot.yaml: no free base, the robot is bolted to the world; give its trunk a <freejoint/>"),
        ("no_load_speed: 30", "time_constant: 0", "actuations.motor.no_load_speed: missing"),
        # types and values
        ("name: toy", "name: [toy]", "robot.yaml: name: should be a valid string, is a list"),
        ("side: left", "side: port", "legs.l.side: should be 'left' or 'right', is 'port'"),
        ("kd: 1}", "kd: soft}", "actuations.servo.kd: should be a valid number, unable to parse string"),
        ("kp: 20", "kp: -20", "actuations.servo.kp: should be greater than 0, is -20"),
        ("[left_hip]", "left_hip", "legs.l.joints: should be a valid list, is 'left_hip'"),
        ("kind: pid", "kind: pd", "actuations.servo.kind: no kind 'pd'; did you mean pid?"),
        (TOY, "- toy", "should be a table of keys like name, model, trunk, legs; is a list"),
        ("name: toy", "name: {toy", "robot.yaml: not YAML: "),
        # names
        ("trunk: base", "trunk: bas", "trunk: no body 'bas' in toy.xml; did you mean base?"),
        ("[left_hip]", "[left_hipp]", "legs.l.joints: no joint 'left_hipp' in toy.xml; did you mean left_hip?"),
        ("[left_hip]", "[right_hip]", "legs.r.joints: joint right_hip is listed twice"),
        ("[left_hip]", "[left_hip, right_hip]", "legs.l.joints: left_hip should be nearer to the trunk than right_hip"),
        ("foot: left_foot", "foot: left_food", "legs.l.foot: no geom 'left_food' in toy.xml; did you mean left_foot?"),
        ("trunk: base", "trunk: left", "trunk: body left should have one free joint and no other"),
        ("neutral: 0", "neutral: {left_hop: 0}", "postures.neutral: no joint 'left_hop'; did you mean left_hip?"),
        ("neutral: 0", "neutral: {left_hip: 0}", "postures.neutral: no value for joint right_hip;"),
        ("neutral: 0", 'neutral: {"l*": 0, "*hip": 0}', "left_hip fits 'l*' and '*hip'; it should fit one"),
        ("neutral: 0", "neutral: 1.7", "neutral: right_hip = 1.7 rad is outside its range -1.571 .. 1.571 rad"),
        ("actuation: servo", "actuation: sevro", "actuation: no actuation 'sevro'; did you mean servo?"),
        ("actuation: servo", "variants: {x: {inertials: {bas: {}}}}\nactuation: servo", "no body 'bas' in toy.xml;"),
        ("toy.xml", "toys.xml", "robot.yaml: model: no file "),
    ],
)  # fmt: skip
def test_mistakes_in_the_description(toy: Path, old: str, new: str, message: str) -> None:
    path = change(toy, old, new)
    variant = "x" if "variants" in new else None
    with pytest.raises(LevadeError, match=re.escape(message)) as caught:
        load_robot(path, variant=variant)
    assert str(toy) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("toy.xml", "</mujoco>", "", "toy.xml: broken XML (no element found: line 21"),
        ("toy.xml", 'name="base"', 'nam="base"', "toy.xml: Schema violation: unrecognized attribute: 'nam'"),
        ("toy.xml", 'mass="1"', 'mass="-1"', "toy.xml: "),
        ("shapes.xml", "wedge.obj", "wedges.obj", "toy.xml: mesh 'wedge' not found in geom"),
        ("toy.xml", 'axis="0 1 0"/>', 'axis="0 1 0" type="slide"/>', "legs.l.joints: joint left_hip should be a hinge"),
        ("toy.xml", '<geom type="mesh"', '<joint name="turn"/><geom type="mesh"', "base should have one free joint"),
        ("toy.xml", '<body name="right"', TAIL + '<body name="right"', "legs: joint tail of toy.xml is in no leg"),
    ],
)  # fmt: skip
def test_mistakes_in_the_model(toy: Path, file: str, old: str, new: str, message: str) -> None:
    change(toy, old, new, file)
    with pytest.raises(LevadeError, match=re.escape(message)) as caught:
        load_robot(toy)
    assert str(toy) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_variant_replaces_only_what_it_names(toy: Path) -> None:
    change(toy, "actuation: servo", "variants: {heavy: {inertials: {left: {mass: 3}}}}\nactuation: servo")
    plain, heavy = load_robot(toy), load_robot(toy, variant="heavy")
    assert heavy.mass == pytest.approx(plain.mass + 2)
    np.testing.assert_allclose(heavy.model.body_ipos, plain.model.body_ipos)
    np.testing.assert_allclose(heavy.model.body_inertia, plain.model.body_inertia)


def test_what_a_caller_changes_is_not_in_the_next_copy_of_a_built_in_robot() -> None:
    """A process reads it only once."""
    first, neutral = load_robot("hyq2max"), load_robot("hyq2max").postures["neutral"].copy()
    first.postures["neutral"][:] = 9.0
    first.limits.torque[:] = 0.0
    again = load_robot("hyq2max")
    np.testing.assert_array_equal(again.postures["neutral"], neutral)
    assert (again.limits.torque > 0).all()
    assert again.mjcf == first.mjcf
