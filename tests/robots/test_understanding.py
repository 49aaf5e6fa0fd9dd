"""Understanding: legs, roles, postures, gains and mirror signs, found from kinematics and compared with closed forms."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot, mirror_signs
from levade.robots.doctor import Patient, inspect

FRONT, HIND = (("lf", 1, 1), ("rf", 1, -1)), (("lh", -1, 1), ("rh", -1, -1))
MIDDLE = (("lm", 0, 1), ("rm", 0, -1))


@pytest.fixture
def build(tmp_path: Path, quadruped: type):
    """Load a variant of the robot: build("urdf", knees="back")."""

    def load(form: str = "urdf", *changes: tuple[str, str], **options) -> Robot:
        text = getattr(quadruped(**options), form)()
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / f"toy.{'urdf' if form == 'urdf' else 'xml'}"
        path.write_text(text)
        return load_robot(path)

    return load


@pytest.mark.parametrize("form", ["urdf", "mjcf"])
@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"legs": FRONT[:1]},
            "levade moves two and more legs of two to eight hinges each; this robot has a limb of 3 joints (from lf_haa)",
        ),
        (
            {"forward": "y"},
            "joints lf_haa, lf_hfe, lf_kfe turn about y, -x, -x of trunk; levade knows legs of hip abduction (about x), hip"
            " flexion and knee (about y), x forward; it seems that y is forward there: turn the model",
        ),
        ({"legs": ()}, "this model has no joints besides its free base"),
    ],
)
def test_what_has_no_legs_is_refused_with_what_it_has(build, form: str, options: dict, message: str) -> None:
    with pytest.raises(LevadeError, match=re.escape(message)):
        build(form, **options)


def test_limbs_about_other_axes_are_no_legs(build, quadruped: type) -> None:
    with pytest.raises(
        LevadeError, match=r"lf_haa, lf_hfe, lf_kfe turn about x, z, z of trunk; .*; this limb is not such a leg"
    ):
        build("urdf", ('<axis xyz="0 1 0"/>', '<axis xyz="0 0 1"/>'))


def test_a_knee_in_the_ground_plane_leaves_no_posture(build) -> None:
    stiff = ('lower="-2.5" upper="-0.2"', 'lower="-2.9" upper="-2.5"')
    with pytest.raises(LevadeError, match="no standing posture within the joints' ranges has the feet under the hips"):
        build("urdf", stiff)


@pytest.mark.parametrize("form", ["urdf", "mjcf"])
@pytest.mark.parametrize("knees", ["inward", "back"])
def test_the_neutral_posture_is_the_two_link_legs_closed_form(build, quadruped: type, form: str, knees: str) -> None:
    """Hip to foot is 75 % of two links of length l: cos(knee) = 2 * 0.75^2 - 1, and the hip turns by half of it."""
    robot = build(form, knees=knees)
    knee = math.acos(2 * 0.75**2 - 1)
    hind = -1 if knees == "inward" else 1
    expected = [0, knee / 2, -knee] * 2 + [0, hind * knee / 2, -hind * knee] * 2
    np.testing.assert_allclose(robot.postures["neutral"], expected, atol=1e-6)
    feet = robot.foot_positions(robot.postures["neutral"])
    hips = [[0.2, 0.13], [0.2, -0.13], [-0.2, 0.13], [-0.2, -0.13]]
    np.testing.assert_allclose(feet, [[*hip, -0.3] for hip in hips], atol=1e-6)
    assert robot.neutral_height == pytest.approx(0.32)
    assert np.ptp(robot.foot_positions(robot.postures["crouched"])[:, 2]) < 1e-6
    assert robot.foot_positions(robot.postures["crouched"])[0, 2] == pytest.approx(-0.45 * 0.4)
    assert robot.foot_positions(robot.postures["stretched"])[0, 2] == pytest.approx(-0.95 * 0.4)


def test_legs_that_are_too_weak_stand_straighter(build) -> None:
    """At 75 % the knee needs about 4 Nm; with less than that, the first extension at which the torque suffices."""
    robot = build("urdf", ('effort="20.0"', 'effort="3.5"'))
    heights = [round(extension * 0.4 + 0.02, 6) for extension in (0.8, 0.85, 0.9)]
    assert round(robot.neutral_height, 6) in heights
    needed = Patient(robot).bare.static_torque(dict(zip(robot.joint_names, robot.postures["neutral"], strict=True)))
    assert max(map(abs, needed.values())) <= 3.5


def test_static_torques_are_those_of_a_hand_computation(build, quadruped: type) -> None:
    """Each foot bears a quarter of the weight W; about each joint, its moment less that of the links beyond the joint."""
    robot = build("urdf")
    q = quadruped()
    angles = dict(zip(robot.joint_names, robot.postures["neutral"], strict=True))
    needed = Patient(robot).bare.static_torque(angles)
    g, (_, _, thigh, shank, foot) = 9.81, q.MASS
    knee = math.acos(2 * 0.75**2 - 1)
    force, x = q.mass * g / 4, q.LINK * math.sin(knee / 2)  # the knee is x behind hip and foot
    assert needed["lf_kfe"] == pytest.approx(x * force - g * (shank * x / 2 + foot * x), rel=1e-6)
    assert needed["lf_hfe"] == pytest.approx(g * (thigh + shank) * x / 2, rel=1e-6)
    out = q.OUT
    assert needed["lf_haa"] == pytest.approx(g * out * (thigh + shank + foot) - out * force, rel=1e-6)
    assert needed["rf_haa"] == pytest.approx(-needed["lf_haa"], rel=1e-6)
    assert needed["lh_kfe"] == pytest.approx(-needed["lf_kfe"], rel=1e-6)


def test_static_torques_hold_the_robot(build) -> None:
    """In MuJoCo, on vertical forces that bear its weight at the feet, the robot does not begin to move."""
    robot = build(
        "urdf", ('<origin xyz="0 0 0"/><mass value="6.0"/>', '<origin xyz="0.05 0.01 0.02"/><mass value="6.0"/>')
    )
    robot.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    neutral = dict(zip(robot.joint_names, robot.postures["neutral"], strict=True))
    data = robot.data_at(robot.postures["neutral"])
    feet = robot.foot_positions(robot.postures["neutral"])
    centre = robot.model.body_mass @ data.xipos / robot.mass
    # the forces of least norm that bear it: linear in the feet's places
    balance = np.stack([np.ones(4), feet[:, 0], feet[:, 1]])
    force = np.linalg.pinv(balance) @ (robot.mass * 9.81 * np.array([1.0, centre[0], centre[1]]))
    assert np.ptp(force) > 1.0
    for foot, place, bearing in zip(robot.feet, feet, force, strict=True):
        body = int(robot.model.geom(foot).bodyid[0])
        data.xfrc_applied[body, 2] = bearing
        data.xfrc_applied[body, 3:] = np.cross(place - data.xipos[body], [0.0, 0.0, bearing])
    for joint, torque in Patient(robot).bare.static_torque(neutral).items():
        data.joint(joint).qfrc_applied[0] = torque
    mujoco.mj_forward(robot.model, data)
    np.testing.assert_allclose(data.qacc, 0.0, atol=1e-6)


@pytest.mark.parametrize(("knees", "hind"), [("inward", [1, -1, -1]), ("back", [1, 1, 1])])
def test_mirror_signs_from_front_to_hind_follow_the_knees(build, knees: str, hind: list[int]) -> None:
    robot = build("urdf", knees=knees)
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("lh")), hind)
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("rf")), [-1, 1, 1])
    signs = mirror_signs(robot, robot.leg("lf"), robot.leg("rh"))
    np.testing.assert_array_equal(signs, np.array([-1, 1, 1]) * hind)
    angles = np.array([0.1, 0.6, -1.2])
    moved = np.zeros(12)
    moved[:3], moved[9:] = angles, signs * angles
    one, other = robot.foot_positions(moved)[[0, 3]]
    centre = np.array([0.2, 0.0, 0.0])
    x = -1 if knees == "inward" else 1
    np.testing.assert_allclose((other + centre), (one - centre) * [x, -1, 1], atol=1e-9)


def test_two_jointed_legs_work_too(build) -> None:
    robot = build("urdf", joints=2)
    assert [leg.roles for leg in robot.legs] == [("hfe", "kfe")] * 4
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("lh")), [-1, -1])


def test_derived_gains_are_those_of_the_formula(build, quadruped: type) -> None:
    """kp = m g l / 0.4 with l half a leg; kd for a damping ratio of 0.7 of the whole leg swinging about its hip."""
    robot = build("urdf")
    q = quadruped()
    kp = q.mass * 9.81 * 0.2 / 0.4
    np.testing.assert_allclose(robot.actuation.kp, kp)
    _, _, thigh, shank, foot = q.MASS
    knee = math.acos(2 * 0.75**2 - 1)
    x, z = q.LINK * math.sin(knee / 2), q.LINK * math.cos(knee / 2)

    def about(mass: float, y: float, down: float, ahead: float) -> tuple[float, float]:
        return mass * (y**2 + down**2), mass * (ahead**2 + down**2)

    parts = [
        about(thigh, q.OUT, z / 2, x / 2),
        about(shank, q.OUT, 1.5 * z, x / 2),
        about(foot, q.OUT, 2 * z, 0.0),
    ]
    abduction = sum(part[0] for part in parts) + 3 * 0.002 + 1e-5
    flexion = sum(part[1] for part in parts) + 2 * 0.002 + 1e-5
    inertia = Patient(robot).bare.joint_inertia(dict(zip(robot.joint_names, robot.postures["neutral"], strict=True)))
    assert inertia["lf_haa"] == pytest.approx(abduction, rel=1e-5)
    assert inertia["lf_hfe"] == pytest.approx(flexion, rel=1e-5)
    np.testing.assert_allclose(robot.actuation.kd, 2 * 0.7 * math.sqrt(kp * max(abduction, flexion)), rtol=1e-5)


@pytest.mark.slow
def test_bodies_that_overlap_at_rest_pass_through_each_other(build) -> None:
    wide = ('<box size="0.4 0.08 0.1"/>', '<box size="0.5 0.3 0.3"/>')
    tall = ("<collision><geometry><sphere", '<collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.02" length="0.1"/>'
            "</geometry></collision><collision><geometry><sphere")  # fmt: skip
    free = build("urdf")
    assert free.model.nexclude == 0
    robot = build("urdf", wide, tall)
    assert robot.model.nexclude == 4
    notes = [str(f) for f in robot.findings if "overlap" in f.what]
    assert len(notes) == 1
    assert notes[0].startswith(
        "bodies trunk - lf_shank, trunk - rf_shank, trunk - lh_shank, trunk - rh_shank: overlap by"
    )
    data = robot.data_at(robot.postures["neutral"])
    mujoco.mj_collision(robot.model, data)
    assert data.ncon == 0


@pytest.mark.slow
def test_feet_are_the_tips_whatever_their_shape(build) -> None:
    box = build("urdf", ('<sphere radius="0.02"/>', '<box size="0.02 0.02 0.04"/>'))
    assert box.model.geom(box.legs[0].foot).type[0] == mujoco.mjtGeom.mjGEOM_BOX
    both = ("<collision><geometry><sphere", '<collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.01" length="0.2"/>'
            "</geometry></collision><collision><geometry><sphere")  # fmt: skip
    robot = build("urdf", both)
    assert robot.model.geom(robot.legs[0].foot).type[0] == mujoco.mjtGeom.mjGEOM_SPHERE


@pytest.mark.slow
def test_a_yaml_beside_the_model_overrides_what_was_found(build, tmp_path: Path) -> None:
    build("urdf")
    (tmp_path / "robot.yaml").write_text(
        "name: mine\nmodel: toy.urdf\nlimits: {torque: {'*_haa': 9, '*_hfe': 8, '*_kfe': 7}}\n"
        "postures: {neutral: {'*_haa': 0, '?f_hfe': 0.5, '?f_kfe': -1, '?h_hfe': -0.5, '?h_kfe': 1}}\n"
        "actuations: {soft: {kind: pid, kp: 33, kd: 2}}\n"
    )
    robot = load_robot(tmp_path / "toy.urdf")
    assert robot.name == "mine"
    np.testing.assert_array_equal(robot.limits.torque[:3], [9, 8, 7])
    np.testing.assert_array_equal(robot.limits.velocity, 15)
    np.testing.assert_array_equal(robot.posture("neutral")[:3], [0, 0.5, -1])
    np.testing.assert_array_equal(robot.actuation.kp, 33)
    assert robot.origins == {
        "legs": "found in the kinematics",
        "neutral": "robot.yaml",
        "torque": "robot.yaml",
        "velocity": "the URDF",
        "gains": "robot.yaml, actuation soft",
    }
    (tmp_path / "robot.yaml").write_text("model: other.urdf\n")
    assert load_robot(tmp_path / "toy.urdf").name == "toy"


@pytest.mark.slow
def test_a_yaml_with_only_the_model_is_the_model(build, tmp_path: Path) -> None:
    plain = build("urdf")
    (tmp_path / "robot.yaml").write_text("model: toy.urdf\n")
    described = load_robot(tmp_path / "robot.yaml")
    assert replace(described, source="").mjcf == plain.mjcf
    assert described.name == "toy"
    assert described.findings == plain.findings


@pytest.mark.slow
def test_a_yaml_can_name_four_legs_of_six_and_fix_the_others(build, tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy.urdf").write_text(quadruped(legs=FRONT + MIDDLE + HIND).urdf())
    ends = {"lf": ("left", "front"), "rf": ("right", "front"), "lh": ("left", "hind"), "rh": ("right", "hind")}
    legs = "".join(
        f"  {leg}: {{joints: [{leg}_haa, {leg}_hfe, {leg}_kfe], foot: {leg}_tip, side: {side}, end: {end}}}\n"
        for leg, (side, end) in ends.items()
    )
    text = f'model: toy.urdf\nfixed: {{"?m_haa": 0, "?m_hfe": 0.7, "?m_kfe": -2.4}}\nlegs:\n{legs}'
    (tmp_path / "robot.yaml").write_text(text.replace("_tip", "_foot_0"))
    robot = load_robot(tmp_path / "robot.yaml")
    assert len(robot.joint_names) == 12
    assert robot.mass == pytest.approx(quadruped(legs=FRONT + MIDDLE + HIND).mass)


def test_a_yaml_can_fix_the_fourth_joint_of_a_leg(tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy.urdf").write_text(quadruped(joints=4).urdf())
    (tmp_path / "robot.yaml").write_text('model: toy.urdf\nfixed: {"*_ankle": 0.3}\n')
    robot = load_robot(tmp_path)
    assert [leg.roles for leg in robot.legs] == [("haa", "hfe", "kfe")] * 4
    zero = robot.foot_positions(np.zeros(12))[0]
    np.testing.assert_allclose(zero, [0.2 - 0.2 * math.sin(0.3), 0.13, -0.4 - 0.2 * math.cos(0.3)], atol=1e-6)
    (tmp_path / "robot.yaml").write_text('model: toy.urdf\nfixed: {"*_ankel": 0.3}\n')
    with pytest.raises(LevadeError, match=r"robot\.yaml: fixed: no joint '\*_ankel'"):
        load_robot(tmp_path)


@pytest.mark.slow
def test_the_same_robot_in_both_forms_is_the_same(build, quadruped: type) -> None:
    """But for the feet's mass, which the MJCF leaves out."""
    urdf = build("urdf", ('<mass value="0.05"/>', '<mass value="1e-5"/>'))
    mjcf = build("mjcf")
    assert urdf.mass == pytest.approx(mjcf.mass, abs=1e-4)
    np.testing.assert_allclose(urdf.postures["neutral"], mjcf.postures["neutral"], atol=1e-9)
    for leg, other in zip(urdf.legs, mjcf.legs, strict=True):
        assert leg.joints == other.joints


@pytest.mark.slow
def test_a_torque_limit_of_the_description_is_what_a_joint_gets(quadruped: type, tmp_path: Path) -> None:
    """The file's own limit, which MuJoCo keeps at the joint, would cut it off again."""
    path = tmp_path / "toy.urdf"
    path.write_text(quadruped().urdf())
    (tmp_path / "robot.yaml").write_text("model: toy.urdf\nlimits: {torque: 35}\n")
    model = load_robot(path).model
    limited = model.jnt_actfrclimited[1:].astype(bool)
    assert (abs(model.jnt_actfrcrange[1:][limited]) == 35).all()
    (tmp_path / "robot.yaml").write_text("model: toy.urdf\nlimits: {torque: 5}\n")
    assert load_robot(path).limits.torque.tolist() == [5.0] * 12


@pytest.mark.parametrize("description", ["with.yaml", "with2.yaml"])
def test_legs_described_by_hand_may_have_other_roles(description: str) -> None:
    """A hexapod: no joint of it is an abduction; gains come from the length of its links, all of them."""
    robot = load_robot(Path(__file__).parent / "cases" / "hexa" / description)
    assert (len(robot.legs), len(robot.joint_names)) == (6, 18)
    assert [leg.roles for leg in robot.legs[::3]] != [("haa", "hfe", "kfe")] * 2
    assert not [finding for finding in inspect(robot) if finding.kind == "warning"]
    length = Patient(robot).leg_length
    assert length == pytest.approx(0.06 + 0.12 + 0.16, abs=1e-6)
    if description == "with.yaml":
        least = robot.mass * 9.81 * 0.5 * length / (4 * 0.1)
        femurs = np.array(["femur" in name for name in robot.joint_names])
        np.testing.assert_allclose(robot.actuation.kp[~femurs], least)
        assert (robot.actuation.kp[femurs] > least).all()  # they carry it


TURNS = [
    (order, signs)
    for order in itertools.permutations(range(3))
    for signs in itertools.product((1, -1), repeat=3)
    if np.linalg.det(np.eye(3)[list(order)] * np.array(signs)) > 0
]


@pytest.mark.parametrize(("order", "signs"), TURNS)
def test_a_model_in_another_frame_is_told_which_way_is_up(build, quadruped: type, order, signs) -> None:
    """All 24 turns of a robot of balls: x of the file is axis order[0] of the robot, and so on."""
    turn = np.array(signs)[:, None] * np.eye(3)[list(order)]
    text = quadruped().urdf()

    def turned(match: re.Match[str]) -> str:
        return 'xyz="{:g} {:g} {:g}"'.format(*turn @ np.array([float(value) for value in match[1].split()]))

    changes = [(text, re.sub(r'xyz="([^"]+)"', turned, text))]
    forward, up = turn[:, 0], turn[:, 2]
    if up[2] > 0 and forward[0] != 0:  # also turned by half a turn about z: nothing tells front from hind
        assert len(build("urdf", *changes).joint_names) == 12
        return
    along, high = "xyz"[int(np.argmax(np.abs(forward)))], "xyz"[int(np.argmax(np.abs(up)))]
    sign = "-" if up.sum() < 0 else ""
    if up[2] == 0:
        message = rf"it seems that {sign}?{high} is up and {along} along the robot there"
    else:
        message = (
            "it seems that -z is up there; turn"
            if up[2] < 0 and forward[0]
            else f"it seems that {along} is forward there"
        )
    with pytest.raises(LevadeError, match=message):
        build("urdf", *changes)
