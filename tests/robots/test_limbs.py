"""Limbs of any kind: which branches are legs, arms and waists; postures to stand in on two legs and on six."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import NoReturn

import mujoco
import numpy as np
import pytest

from levade.costs.success import success
from levade.engines import FOOT_CONTACT_FORCE, Fall, Physics, Settled, make_engine, start_state
from levade.engines.ode.library import load as load_ode
from levade.errors import LevadeError
from levade.policies import FreeGoal, FreePolicy, Policy
from levade.robots import Robot, dimensions, load_robot, settling
from levade.robots.limbs import read_limbs
from levade.robots.naming import limbs_of as limbs_named
from levade.robots.neutral import PostureSearch
from levade.robots.settling import Settled as PutDown
from levade.robots.settling import settle
from levade.robots.shapes import support
from levade.robots.understanding import find_trunk
from levade.scenes import Scene
from levade.search.objective import make_objective
from levade.tasks import load_task
from levade.tasks.policy import leg_groups, make_policy
from levade.trajectory import JointReference, Trajectories

HEAD = '<mujoco><compiler angle="radian" autolimits="true"/><worldbody>'


def hinge(name: str, axis: str, lower: float, upper: float, torque: float = 60.0) -> str:
    return f'<joint name="{name}" axis="{axis}" range="{lower} {upper}" actuatorfrcrange="-{torque} {torque}" armature="0.01"/>'


def leg(side: str, y: float) -> str:
    """Six hinges; the foot is two boxes on one link."""
    s = 1 if y > 0 else -1
    spread = sorted((-0.4 * s, 1.2 * s))
    return f"""
<body name="{side}1" pos="0 {y} -0.05">{hinge(side + "_yaw", "0 0 1", -0.6, 0.6)}<geom type="sphere" size="0.03" mass="0.8"/>
<body name="{side}2">{hinge(side + "_roll", "1 0 0", *spread)}<geom type="sphere" size="0.03" mass="0.8"/>
<body name="{side}3">{hinge(side + "_pitch", "0 1 0", -2.0, 1.0)}
 <geom type="capsule" fromto="0 0 -0.05 0 0 -0.3" size="0.035" mass="2.5"/>
<body name="{side}4" pos="0 0 -0.35">{hinge(side + "_knee", "0 1 0", 0.0, 2.3)}
 <geom type="capsule" fromto="0 0 -0.05 0 0 -0.28" size="0.03" mass="1.5"/>
<body name="{side}5" pos="0 0 -0.35">{hinge(side + "_foot_pitch", "0 1 0", -0.9, 0.6)}
 <geom type="sphere" size="0.02" mass="0.2"/>
<body name="{side}6">{hinge(side + "_foot_roll", "1 0 0", -0.5, 0.5)}
 <geom name="{side}_toe" type="box" size="0.05 0.04 0.015" pos="0.08 0 -0.05" mass="0.3"/>
 <geom name="{side}_heel" type="box" size="0.04 0.03 0.015" pos="-0.03 0 -0.05" mass="0.3"/>
</body></body></body></body></body></body>"""


def arm(side: str, y: float) -> str:
    """Three hinges that move the hand by much, and one that turns it; two fingers."""
    s = 1 if y > 0 else -1
    fingers = "".join(
        f'<body name="{side}_finger{k}" pos="0 {0.02 * k} -0.06">{hinge(f"{side}_finger{k}", "1 0 0", -0.5, 0.5, 1)}'
        '<geom type="sphere" size="0.01" mass="0.02"/></body>'
        for k in (-1, 1)
    )
    return f"""
<body name="{side}_a1" pos="0 {y} 0.3">{hinge(side + "_reach", "0 1 0", -2.5, 2.5, 20)}
 <geom type="sphere" size="0.03" mass="0.3"/>
<body name="{side}_a2">{hinge(side + "_lift", "1 0 0", *sorted((-0.3 * s, 2.5 * s)), 20)}
 <geom type="capsule" fromto="0 {0.03 * s} -0.04 0 {0.03 * s} -0.22" size="0.025" mass="0.8"/>
<body name="{side}_a3" pos="0 {0.03 * s} -0.25">{hinge(side + "_elbow", "0 1 0", -2.2, 0.1, 20)}
 <geom type="capsule" fromto="0 0 -0.04 0 0 -0.2" size="0.02" mass="0.5"/>
<body name="{side}_a4" pos="0 0 -0.24">{hinge(side + "_turn", "0 0 1", -1.5, 1.5, 5)}
 <geom name="{side}_palm" type="sphere" size="0.03" pos="0 0 -0.03" mass="0.15"/>{fingers}
</body></body></body></body>"""


def humanoid() -> str:
    """A pelvis with two legs, and a waist that carries two arms and a head."""
    return f"""{HEAD}<body name="pelvis" pos="0 0 1"><freejoint/><geom type="box" size="0.08 0.1 0.05" mass="5"/>
{leg("one", 0.1)}{leg("two", -0.1)}
<body name="chest" pos="0 0 0.08">{hinge("twist", "0 0 1", -1, 1)}
 <geom type="box" size="0.08 0.12 0.15" pos="0 0 0.2" mass="9"/>
{arm("p", 0.18)}{arm("q", -0.18)}
<body name="skull" pos="0 0 0.4">{hinge("nod", "0 1 0", -0.5, 0.5, 5)}<geom type="sphere" size="0.08" pos="0 0 0.08" mass="1"/>
</body></body></body></worldbody></mujoco>"""


def insect(legs: int) -> str:
    """Legs of coxa, femur and tibia, spread evenly on both sides."""
    rows = np.linspace(0.2, -0.2, legs // 2)
    parts = []
    for k, (x, side) in enumerate(itertools.product(rows, (1, -1))):
        angle = side * (np.pi / 2 - 0.8 * x / 0.2)
        parts.append(f"""
<body name="c{k}" pos="{x} {0.1 * side} 0" euler="0 0 {angle}">{hinge(f"coxa{k}", "0 0 1", -0.8, 0.8, 12)}
 <geom type="capsule" fromto="0 0 0 0.06 0 0" size="0.02" mass="0.15"/>
<body name="f{k}" pos="0.06 0 0">{hinge(f"femur{k}", "0 1 0", -1.5, 1.0, 12)}
 <geom type="capsule" fromto="0.03 0 0 0.12 0 0" size="0.015" mass="0.15"/>
<body name="t{k}" pos="0.12 0 0">{hinge(f"tibia{k}", "0 1 0", 0.3, 2.4, 12)}
 <geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.012" mass="0.08"/>
 <geom name="tip{k}" type="sphere" pos="0.16 0 0" size="0.015" mass="0.01"/></body></body></body>""")
    body = '<body name="base" pos="0 0 0.2"><freejoint/><geom type="box" size="0.22 0.08 0.03" mass="3"/>'
    return f"{HEAD}{body}{''.join(parts)}</body></worldbody></mujoco>"


def spokes(number: int, *, start: float = 0.0) -> str:
    """Legs of coxa, femur and tibia that point in all directions; the first one is turned from ahead by an angle [rad]."""
    parts = []
    for k in range(number):
        angle = start + 2 * np.pi * k / number
        parts.append(f"""
<body name="c{k}" pos="{0.1 * np.cos(angle)} {0.1 * np.sin(angle)} 0" euler="0 0 {angle}">
 {hinge(f"coxa{k}", "0 0 1", -0.8, 0.8, 12)}<geom type="capsule" fromto="0 0 0 0.06 0 0" size="0.02" mass="0.15"/>
<body name="f{k}" pos="0.06 0 0">{hinge(f"femur{k}", "0 1 0", -1.5, 1.0, 12)}
 <geom type="capsule" fromto="0.03 0 0 0.12 0 0" size="0.015" mass="0.15"/>
<body name="t{k}" pos="0.12 0 0">{hinge(f"tibia{k}", "0 1 0", 0.3, 2.4, 12)}
 <geom name="tip{k}" type="capsule" fromto="0 0 0 0.15 0 0" size="0.012" mass="0.08"/></body></body></body>""")
    body = '<body name="base" pos="0 0 0.2"><freejoint/><geom type="cylinder" size="0.1 0.03" mass="3"/>'
    return f"{HEAD}{body}{''.join(parts)}</body></worldbody></mujoco>"


def raised(text: str, by: float) -> str:
    """Put everything on the trunk higher in its frame [m]."""
    spec = mujoco.MjSpec.from_string(text)
    trunk = spec.worldbody.first_body()
    for part in [*trunk.geoms, *trunk.bodies]:
        part.pos = part.pos + np.array([0.0, 0.0, by])
    return spec.to_xml()


def limbs_of(text: str, wanted: dict[str, str] | None = None):
    model = mujoco.MjModel.from_xml_string(text)
    return read_limbs(model, find_trunk(model, "here"), "here", wanted or {})


def load(folder: Path, text: str, more: str = "") -> Robot:
    (folder / "robot.xml").write_text(text)
    (folder / "robot.yaml").write_text(f"model: robot.xml\n{more}")
    return load_robot(folder)


@pytest.mark.slow
def test_postures_of_the_same_model_are_searched_once(
    walker: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> NoReturn:
        raise AssertionError

    for name in ("neutral", "standing", "tiptoe"):
        monkeypatch.setattr(PostureSearch, name, fail)
    again = load(tmp_path, humanoid())
    assert {name: again.posture(name).tolist() for name in again.postures} == {
        name: walker.posture(name).tolist() for name in walker.postures
    }
    with pytest.raises(AssertionError):
        load(tmp_path, humanoid().replace('mass="5"', 'mass="6"'))


@pytest.fixture(scope="module")
def walker(tmp_path_factory: pytest.TempPathFactory) -> Robot:
    return load(tmp_path_factory.mktemp("walker"), humanoid())


def test_a_humanoid_has_legs_and_arms_and_holds_the_rest() -> None:
    found = limbs_of(humanoid())
    assert [(limb.name, limb.kind, limb.side) for limb in found.legs] == [
        ("l", "leg", "left"),
        ("r", "leg", "right"),
        ("la", "arm", "left"),
        ("ra", "arm", "right"),
    ]
    assert found.legs[0].roles == ("yaw", "haa", "hfe", "kfe", "pitch", "roll")
    assert set(found.legs[0].pads) == {"one_toe", "one_heel"}
    assert found.legs[2].joints == ("p_reach", "p_lift", "p_elbow")
    assert {"twist", "nod", "p_turn", "p_finger1"} <= set(found.held)


def test_limbs_are_freed_and_held_as_asked_for() -> None:
    found = limbs_of(humanoid(), {"arm": "held", "waist": "free"})
    assert [limb.kind for limb in found.legs] == ["leg", "leg", "waist"]
    assert found.legs[2].joints == ("twist",)
    assert "p_elbow" in found.held


@pytest.mark.parametrize(
    ("number", "names"),
    [(4, "lf rf lh rh"), (6, "lf rf lm rm lh rh"), (8, "l1 r1 l2 r2 l3 r3 l4 r4")],
)
def test_legs_of_an_insect_are_named_by_place(number: int, names: str) -> None:
    found = limbs_of(insect(number))
    assert " ".join(limb.name for limb in found.legs) == names
    assert {limb.roles for limb in found.legs} == {("swing", "hfe", "kfe")}
    assert not found.held


def test_wheels_are_locked_and_are_the_feet() -> None:
    text = insect(4)
    for k in range(4):
        old = f'<geom name="tip{k}" type="sphere" pos="0.16 0 0" size="0.015" mass="0.01"/>'
        wheel = f'<body pos="0.16 0 0"><joint name="wheel{k}" axis="0 1 0"/><geom name="tyre{k}" type="cylinder"'
        text = text.replace(old, f'{wheel} size="0.04 0.01" zaxis="0 1 0" mass="0.1"/></body>')
    found = limbs_of(text)
    assert found.wheels == ("wheel0", "wheel1", "wheel2", "wheel3")
    assert sorted(limb.foot for limb in found.legs) == ["tyre0", "tyre1", "tyre2", "tyre3"]


@pytest.mark.slow
def test_the_height_of_the_trunk_frame_has_no_effect() -> None:
    """Some files put its origin between the soles, or far above the head."""
    for text in (humanoid(), insect(6)):
        here = limbs_of(text)
        for by in (0.83, 0.9, -2.0):
            there = limbs_of(raised(text, by))
            assert (there.problem, there.held) == ("", here.held)
            assert [(one.name, one.joints) for one in there.legs] == [(one.name, one.joints) for one in here.legs]


@pytest.mark.parametrize(("number", "start"), [(3, 0.0), (3, np.pi), (4, 0.0), (5, 0.0)])
def test_legs_straight_ahead_and_behind_are_legs(number: int, start: float) -> None:
    found = limbs_of(spokes(number, start=start))
    assert [limb.kind for limb in found.legs] == ["leg"] * number
    assert not found.held


@pytest.mark.slow
def test_legs_ahead_behind_and_aside_are_not_in_another_frame(tmp_path: Path) -> None:
    robot = load(tmp_path, spokes(4))
    assert robot.stance == "sprawled"
    assert settle(robot).tilt < 0.05


@pytest.mark.parametrize("start", [0.0, 0.3, np.pi / 4])
def test_a_robot_with_one_odd_leg_does_not_stand_on_the_others(start: float) -> None:
    text = spokes(4, start=start)
    slides = text.replace('<joint name="tibia0"', '<joint type="slide" name="tibia0"')
    assert "the limb from coxa0 reaches as deep as the legs" in limbs_of(slides).problem
    tip = '<geom name="tip0" type="capsule" fromto="0 0 0 0.15 0 0" size="0.012" mass="0.08"/>'
    bare = text.replace(tip, '<inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>')
    with pytest.raises(LevadeError, match=r"no foot|nothing collides at the end of the limb from coxa0") as raised:
        limbs_of(bare)
    assert "0" in str(raised.value)


def test_an_arm_without_fingers_that_turns_without_end_has_no_wheel() -> None:
    text = humanoid()
    for side in "pq":
        text = text.replace(f'name="{side}_turn" axis="0 0 1" range="-1.5 1.5"', f'name="{side}_turn" axis="0 0 1"')
        for k in (-1, 1):
            joint = hinge(f"{side}_finger{k}", "1 0 0", -0.5, 0.5, 1)
            finger = f'<body name="{side}_finger{k}" pos="0 {0.02 * k} -0.06">{joint}'
            text = text.replace(f'{finger}<geom type="sphere" size="0.01" mass="0.02"/></body>', "")
    assert "finger" not in text
    found = limbs_of(text, {"arm": "free"})
    assert found.wheels == ()
    assert found.legs[2].joints == ("p_reach", "p_lift", "p_elbow", "p_turn")


def test_a_robot_on_one_leg_is_refused(tmp_path: Path) -> None:
    text = humanoid().replace(leg("two", -0.1), "")
    with pytest.raises(LevadeError, match="levade moves two and more legs"):
        load(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "old", "new", "why"),
    [
        (humanoid(), leg("two", -0.1), "", "no two of its limbs that can stand are mirror images left and right"),
        (humanoid(), leg("one", 0.1) + leg("two", -0.1), "", "the limbs that may be legs are arms: they hang high"),
        (spokes(4), 'name="tibia0"', 'name="tibia0" type="slide"', "the limb from coxa0 reaches as deep as the legs"),
    ],
)
def test_a_refusal_says_why_the_limbs_are_no_legs(tmp_path: Path, text: str, old: str, new: str, why: str) -> None:
    assert old in text
    with pytest.raises(LevadeError, match=f"this robot has .*; {why}"):
        load(tmp_path, text.replace(old, new))


def test_two_legs_ahead_of_each_other_are_in_another_frame(tmp_path: Path) -> None:
    text = (
        humanoid()
        .replace('pos="0 0.1 -0.05"', 'pos="0.3 0.01 -0.05"')
        .replace('pos="0 -0.1 -0.05"', 'pos="-0.3 -0.01 -0.05"')
    )
    with pytest.raises(LevadeError, match="levade moves two and more legs"):
        load(tmp_path, text)


def test_a_humanoid_stands_for_three_seconds(walker: Robot) -> None:
    settled = settle(walker, time=3.0)
    assert not settled.broken
    assert settled.tilt < 0.15
    assert abs(settled.sag) < 0.05 * dimensions(walker).height
    assert walker.stance == "upright"


def test_a_goal_names_limbs_by_what_they_are(walker: Robot) -> None:
    def goal(table: str) -> FreeGoal | None:
        task = load_task("squat-jump", robot=walker, changes=[f"policy.goal={table}"])
        return make_policy(task, walker).goal  # type: ignore[union-attr]

    names, groups = walker.joint_names, len({(leg.kind, leg.end) for leg in walker.legs})
    assert groups == 2
    free = goal("{arm: free, leg knee: [0.4, 1.2]}")
    assert free is not None
    assert [name for leg in limbs_named(walker, "arm") for name in leg.joints if leg.side == "left"] == [
        "p_reach",
        "p_lift",
        "p_elbow",
    ]
    assert (free.lower[0], free.upper[0]) == (0.4, 1.2)
    assert len(free.joints) == 1 + 3
    angles = walker.posture({"leg haa": 0.1})
    data = walker.data_at(angles)
    left, right = (data.geom(leg.foot).xpos for leg in limbs_named(walker, "leg"))
    np.testing.assert_allclose(left * [1, -1, 1], right, atol=1e-6)
    assert angles[names.index(walker.leg("l").joints[1])] == 0.1
    with pytest.raises(
        LevadeError, match=r"^policy.goal: hind: robot has no such limb, only leg \(l, r\), arm \(la, ra\)"
    ):
        goal("{hind: free}")


def turned_round(text: str) -> str:
    """Turn everything on the trunk about the vertical by half a turn: the robot faces backward in the trunk's frame."""
    spec = mujoco.MjSpec.from_string(text)
    for part in spec.worldbody.first_body().bodies:
        part.pos = part.pos * np.array([-1.0, -1.0, 1.0])
        part.quat = np.array([0.0, 0.0, 0.0, 1.0])
    return spec.to_xml()


@pytest.mark.slow
def test_a_push_forward_is_one_to_where_the_toes_point(
    walker: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    backward = load(tmp_path, turned_round(humanoid()))
    assert (walker.ahead, backward.ahead) == (1.0, -1.0)
    for robot, felled in ((walker, 1.0), (backward, -1.0)):

        def settled(
            _: Robot, *, push: tuple[float, float] = (0.0, 0.0), felled: float = felled, **__: float
        ) -> PutDown:
            return PutDown(0.0, 1.0 if push[0] * felled > 0 else 0.0, {}, False)

        monkeypatch.setattr(settling, "settle", settled)
        (said,) = [str(finding) for finding in settling.doubt_standing(robot)]
        assert ", forward, fells it" in said


@pytest.fixture(scope="module")
def without_rotors(tmp_path_factory: pytest.TempPathFactory) -> Robot:
    """Its feet are light, too: nothing but a rotor gives their joints an inertia."""
    return load(
        tmp_path_factory.mktemp("rotors"),
        humanoid().replace(' armature="0.01"', "").replace('mass="0.3"', 'mass="0.01"'),
    )


def armature_of(robot: Robot, joint: str) -> float:
    return float(robot.model.joint(joint).armature[0])


@pytest.mark.slow
def test_a_model_without_armature_gets_that_of_drives_of_its_torque(walker: Robot, without_rotors: Robot) -> None:
    assert all(armature_of(walker, joint) == 0.01 for joint in walker.joint_names)
    for joint, torque in zip(without_rotors.joint_names, without_rotors.limits.torque, strict=True):
        assert armature_of(without_rotors, joint) == pytest.approx(1.5e-4 * torque)
    assert any("no armature" in finding.what for finding in without_rotors.findings)


@pytest.mark.slow
def test_a_description_gives_armature(tmp_path: Path) -> None:
    own = load(tmp_path, humanoid(), "armature: {one_knee: 0.02, '*_elbow': 0.003}\n")
    given = {"one_knee": 0.02, "two_knee": 0.01, "p_elbow": 0.003, "q_elbow": 0.003}
    assert {joint: armature_of(own, joint) for joint in given} == given
    with pytest.raises(LevadeError, match="armature: no joint 'one_kneee'; did you mean one_knee"):
        load(tmp_path, humanoid(), "armature: {one_kneee: 0.02}\n")


def test_a_torque_that_a_heavy_rotor_needs_is_believed(tmp_path: Path) -> None:
    """As of gymnasium's ant: rotors of 1 kg m2, which 150 Nm bring to 15 rad/s in 0.1 s, though it weighs next to nothing."""
    strong = insect(4).replace("-12 12", "-150 150")
    light = load(tmp_path, strong)
    heavy = load(tmp_path, strong.replace('armature="0.01"', 'armature="1"'))
    assert (heavy.limits.torque == 150.0).all()
    assert light.limits.torque.max() < 15.0


@pytest.mark.slow
def test_a_servo_is_not_slower_than_its_rotor_needs(tmp_path: Path) -> None:
    torque = 4000.0
    text = humanoid().replace('armature="0.01"', 'armature="1"').replace("-60.0 60.0", f"-{torque} {torque}")
    robot = load(tmp_path, text, f"limits: {{torque: {torque}, velocity: 20}}\n")
    assert (np.sqrt(robot.actuation.kp / 1.0) >= 2 * np.pi * 5.0 - 1e-9).all()  # 5 Hz


def test_its_servos_are_stable_in_the_air(without_rotors: Robot) -> None:
    """A foot that touches nothing follows its servo, though the reference jumps so far that the torque saturates."""
    engine = make_engine(without_rotors, Scene(), Physics(), threads=1)
    start = start_state(engine, without_rotors, Scene(), Fall(height=4.0, gain=1.0, time=0.01))
    lower, upper = without_rotors.limits.lower, without_rotors.limits.upper
    goal = start.joint_reference[0] + 0.4 * (upper - start.joint_reference[0])
    goal[goal < lower] = lower[goal < lower]
    position = np.repeat(goal[None, None], 350, axis=1)  # 0.7 s: it falls 2.4 m
    out = engine.rollout(start, JointReference(position, np.zeros_like(position), 0.002, 350))
    assert np.abs(out.joint_velocity[0, -25:]).max() < 1.0
    assert np.abs(out.joint_position[0, -1] - goal).max() < 0.1


def test_its_soles_lie_flat_and_it_is_balanced(walker: Robot) -> None:
    data = walker.data_at(walker.postures["neutral"])
    for side in ("one", "two"):
        for part in ("toe", "heel"):
            assert data.geom(f"{side}_{part}").xmat[8] > np.cos(0.06)
    mujoco.mj_comPos(walker.model, data)
    feet = walker.foot_positions(walker.postures["neutral"])
    com = data.subtree_com[walker.model.body("pelvis").id]
    assert abs(com[1] - feet[:, 1].mean()) < 0.01
    assert abs(com[0] - feet[:, 0].mean()) < 0.05
    ranges = walker.limits.upper - walker.limits.lower
    room = np.minimum(
        walker.postures["neutral"] - walker.limits.lower, walker.limits.upper - walker.postures["neutral"]
    )
    assert (room > 0.02 * ranges).all()
    knee = walker.joint_names.index("one_knee")
    assert walker.postures["neutral"][knee] > 0.1


def test_its_stretched_posture_is_straight_and_on_its_toes(walker: Robot) -> None:
    neutral, stretched = walker.postures["neutral"], walker.postures["stretched"]
    assert stretched[walker.joint_names.index("one_knee")] < 0.2
    assert walker.foot_depths(stretched).min() > walker.foot_depths(neutral).max()
    data = walker.data_at(stretched)
    for side in ("one", "two"):
        assert data.geom(f"{side}_toe").xpos[2] < data.geom(f"{side}_heel").xpos[2] - 0.02


def test_left_and_right_limbs_are_pairs_and_arms_are_none_of_the_legs(walker: Robot) -> None:
    groups = leg_groups(load_task("squat-jump", robot=walker).policy, walker)
    assert [len(group.leader) for group in groups] == [6, 3]
    assert [len(group.followers) for group in groups] == [1, 1]
    names = walker.joint_names
    for group in groups:
        for leader, follower, sign in zip(
            group.leader, group.followers[0].joints, group.followers[0].signs, strict=True
        ):
            same = walker.postures["neutral"][leader] * sign
            assert same == pytest.approx(walker.postures["neutral"][follower], abs=2e-4), names[leader]


def test_tasks_fit_how_a_robot_stands(walker: Robot) -> None:
    back = load_task("self-righting", robot=walker).start.fall
    front = load_task("self-righting", robot=walker, changes=["start.fall.lying=front"]).start.fall
    assert back is not None
    assert front is not None
    assert (back.roll, back.pitch) == pytest.approx((0.0, -np.pi / 2))
    assert (front.roll, front.pitch) == pytest.approx((0.0, np.pi / 2))
    with pytest.raises(LevadeError, match="handstand: does not apply to robot: it has no hindquarters"):
        load_task("handstand", robot=walker)
    with pytest.raises(LevadeError, match="no side 'belly'"):
        load_task("self-righting", robot=walker, changes=["start.fall.lying=belly"])


@pytest.mark.slow
def test_an_insect_stands_with_its_feet_level(tmp_path: Path) -> None:
    robot = load(tmp_path, insect(6))
    depths = robot.foot_depths(robot.postures["neutral"])
    assert np.ptp(depths) < 2e-3
    settled = settle(robot)
    assert settled.tilt < 0.05
    assert robot.stance == "sprawled"
    groups = leg_groups(load_task("self-righting", robot=robot).policy, robot)
    assert [len(group.followers) for group in groups] == [2, 2]
    # of legs that do the same, the knees of all fold
    signs = {sign for group in groups for follower in group.followers for sign in follower.signs[1:]}
    assert signs == {1.0}


def test_sketches_of_an_upright_robot_bend_it_forward_and_back(walker: Robot) -> None:
    objective = make_objective(load_task("self-righting", robot=walker), robot=walker, threads=1)
    space, names = objective.space, walker.joint_names
    assert isinstance(objective.policy, Policy)
    assert space.span is not None
    assert space.spread is not None
    joints, kernels = objective.policy.independent_joints, objective.policy.kernels.kernels
    spans = space.span.reshape(joints, 3, 2)
    steps = np.linalg.norm(space.factor, axis=1).reshape(joints, kernels)
    sketch = space.sketches(1, np.random.default_rng(0)).reshape(joints, kernels)
    drawn = np.random.default_rng(0).uniform(space.span[:, 0], space.span[:, 1]).reshape(joints, 3)
    between = [
        np.interp(np.linspace(0, 2, kernels), [0, 1, 2], angles) for angles in drawn
    ]  # three postures on the way
    np.testing.assert_allclose(sketch, between, atol=1e-12)
    leaders = [joint for group in objective.policy.groups for joint in group.leader]
    for joint, span, step in zip(leaders, spans, steps, strict=True):
        bends = names[joint].partition("_")[2] in ("pitch", "knee", "foot_pitch", "reach", "elbow")
        whole = (walker.limits.lower[joint], walker.limits.upper[joint])
        neutral = walker.postures["neutral"][joint]
        assert span == pytest.approx(np.tile(whole if bends else (neutral, neutral), (len(span), 1))), names[joint]
        assert step == pytest.approx(np.full(len(step), 1.0 if bends else 0.3), rel=0.05), names[joint]


@pytest.mark.parametrize("name", ["mujoco", pytest.param("ode", marks=pytest.mark.slow)])
def test_the_force_on_a_sole_is_that_on_all_of_its_shapes(walker: Robot, name: str) -> None:
    """Standing, the soles carry the weight, whichever engine says so."""
    if name == "ode":
        try:
            load_ode()
        except LevadeError as missing:
            pytest.skip(str(missing))
    engine = make_engine(walker, Scene(), Physics(engine=name), threads=1)
    standing = start_state(make_engine(walker, Scene(), Physics(), threads=1), walker, Scene(), Settled())
    position = np.repeat(standing.joint_reference[None], 150, axis=1)
    reference = JointReference(position, np.zeros_like(position), 0.002, 150)
    out = engine.rollout(standing, reference, record=[FOOT_CONTACT_FORCE])
    assert out.foot_contact_force is not None
    carried = out.foot_contact_force[0, -100:, :, 2].sum(axis=1).mean()
    weight = 9.81 * float(walker.model.body_mass.sum())
    assert carried == pytest.approx(weight, rel=0.1)


@pytest.mark.slow
def test_sketches_have_any_duration_that_the_task_allows(walker: Robot) -> None:
    free = load_task("self-righting", robot=walker, changes=["horizon={minimum: 2.0, maximum: 4.0}"])
    objective = make_objective(free, robot=walker, threads=1)
    assert isinstance(objective.policy, FreePolicy)
    horizons = objective.policy.lengths(objective.space.sketches(200, np.random.default_rng(1))) * 0.002
    assert horizons.min() < 2.1
    assert horizons.max() > 3.9
    assert horizons.min() >= 2.0 - 1e-9
    assert horizons.max() <= 4.0 + 1e-9


def lowest(robot: Robot, data: mujoco.MjData, geoms: tuple[str, ...]) -> np.ndarray:
    points = [support(robot.model, data, robot.model.geom(geom).id, np.array([0.0, 0.0, -1.0])) for geom in geoms]
    return min(points, key=lambda point: point[2])


@pytest.mark.slow
def test_commanded_onto_one_leg_servos_give_way_until_the_centre_of_mass_is_over_the_sole(walker: Robot) -> None:
    """Servos and weight are in balance where the energy of both is stationary, with the left sole level on the ground."""
    command, kp = walker.posture("one-leg"), walker.actuation.kp
    trunk, left = walker.model.body(walker.trunk).id, walker.leg("l")
    weight = 9.81 * float(walker.model.body_mass.sum())

    def seen(angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The centre of mass from the middle of the left sole, and the trunk's up, in axes of the sole."""
        data = walker.data_at(angles)
        turn = data.body("one6").xmat.reshape(3, 3)
        sole = np.mean([data.geom(pad).xpos for pad in left.pads], axis=0)
        return turn.T @ (data.subtree_com[trunk] - sole), turn.T @ data.body(walker.trunk).xmat.reshape(3, 3)[:, 2]

    angles = command.copy()
    for _ in range(40):
        slopes = [(seen(angles + h)[0][2] - seen(angles - h)[0][2]) / 2e-4 for h in 1e-4 * np.eye(len(angles))]
        angles += 0.5 * (command - weight * np.array(slopes) / kp - angles)
    com, up = seen(angles)
    assert np.abs(com[:2]).max() < 0.005
    assert up[2] > np.cos(0.01)
    data = walker.data_at(angles)
    lift = lowest(walker, data, walker.leg("r").pads)[2] - lowest(walker, data, left.pads)[2]
    assert lift > 0.1 * dimensions(walker).leg


@pytest.mark.slow
def test_swayed_the_feet_stay_and_the_left_one_carries_most_of_the_weight(walker: Robot) -> None:
    engine = make_engine(walker, Scene(), Physics(), threads=1)
    state = start_state(engine, walker, Scene(), Settled(posture="swayed", time=4.0))
    data = mujoco.MjData(engine.model)
    data.qpos[:] = state.qpos[0]
    mujoco.mj_forward(engine.model, data)
    feet = [np.mean([data.geom(pad).xpos for pad in walker.leg(name).pads], axis=0) for name in ("l", "r")]
    neutral = walker.data_at(walker.posture("neutral"))
    apart = [np.mean([neutral.geom(pad).xpos for pad in walker.leg(name).pads], axis=0) for name in ("l", "r")]
    np.testing.assert_allclose(feet[0] - feet[1], apart[0] - apart[1], atol=0.02)
    com = data.subtree_com[engine.model.body(walker.trunk).id]
    step = feet[0][:2] - feet[1][:2]
    share = (com[:2] - feet[1][:2]) @ step / (step @ step)
    assert share == pytest.approx(0.925, abs=0.06)  # of the weight, by the lever


@pytest.mark.slow
def test_a_kneeling_robot_stays_on_its_knees(walker: Robot) -> None:
    """Put down in the posture, it rests on shanks and toes with the trunk upright."""
    engine = make_engine(walker, Scene(), Physics(), threads=1)
    state = start_state(engine, walker, Scene(), Settled(posture="kneeling", time=1.5))
    _, x, y, _ = state.qpos[0][3:7]
    assert 1 - 2 * (x * x + y * y) > np.cos(0.2)
    assert state.qpos[0][2] < 0.8 * walker.neutral_height
    data = walker.data_at(walker.posture("kneeling"))
    shank = walker.model.body("one4").id
    shapes = tuple(walker.model.geom(g).name for g in range(walker.model.ngeom) if walker.model.geom_bodyid[g] == shank)
    knee, toe = lowest(walker, data, shapes), lowest(walker, data, walker.leg("l").pads)
    assert knee[2] == pytest.approx(toe[2], abs=0.02)
    assert toe[0] < data.subtree_com[walker.model.body(walker.trunk).id][0] < knee[0]


@pytest.mark.slow
def test_only_robots_on_two_legs_kneel(tmp_path: Path) -> None:
    robot = load(tmp_path, insect(6))
    with pytest.raises(LevadeError, match="no posture 'kneeling'"):
        robot.posture("kneeling")


def at_rest(robot: Robot, posture: str) -> Trajectories:
    """A trial in which nothing moves: in a posture, level, its lowest part on the ground."""
    angles = robot.posture(posture)
    data = robot.data_at(angles)
    geoms = [g for g in range(robot.model.ngeom) if robot.model.geom_contype[g] or robot.model.geom_conaffinity[g]]
    low = min(support(robot.model, data, g, np.array([0.0, 0.0, -1.0]))[2] for g in geoms if robot.model.geom_bodyid[g])
    place = data.body(robot.trunk).xpos - [0.0, 0.0, low]
    joints, still = np.tile(angles, (1, 20, 1)), np.zeros((1, 20, 3))
    return Trajectories(
        joint_position=joints,
        joint_velocity=np.zeros_like(joints),
        joint_torque=np.zeros_like(joints),
        trunk_position=still + place,
        trunk_quaternion=np.tile([1.0, 0.0, 0.0, 0.0], (1, 20, 1)),
        trunk_linear_velocity=still,
        trunk_angular_velocity=still,
        reference=JointReference(joints, np.zeros_like(joints), 0.1, 10),
        embodiment=robot.embodiment,
        timestep=0.1,
        horizon_steps=10,
        diverged=np.array([False]),
    )


@pytest.mark.slow
def test_a_robot_that_rests_kneels_only_on_its_knees_and_stands_on_one_leg_only_with_a_foot_in_the_air(
    walker: Robot,
) -> None:
    """The criteria of both tasks, against the height of every shape over the ground."""
    names = ("neutral", "crouched", "swayed", "one-leg", "kneeling")
    met = {task: [name for name in names if success(load_task(task, robot=walker).success, at_rest(walker, name))[0]]
           for task in ("kneel", "one-leg-stand")}  # fmt: skip
    assert met == {"kneel": ["kneeling"], "one-leg-stand": ["one-leg"]}
    model = walker.model
    touching = {}
    for name in ("kneeling", "one-leg"):
        data = walker.data_at(walker.posture(name))
        lows = {
            g: support(model, data, g, np.array([0.0, 0.0, -1.0]))[2]
            for g in range(model.ngeom)
            if (model.geom_contype[g] or model.geom_conaffinity[g]) and model.geom_bodyid[g]
        }
        ground = min(lows.values())
        touching[name] = {model.body(model.geom_bodyid[g]).name for g, low in lows.items() if low < ground + 0.04}
    knees = {"one3", "one4", "two3", "two4"}  # a thigh ends where the shank rests
    assert touching == {"kneeling": {*knees, "one6", "two6"}, "one-leg": {"one6"}}


@pytest.mark.parametrize("task", ["kneel", "one-leg-stand"])
def test_tasks_on_two_legs_say_so_on_four_and_six(task: str, tmp_path: Path, quadruped: type) -> None:
    four = tmp_path / "four.urdf"
    four.write_text(quadruped().urdf())
    for robot in (load_robot(four), load(tmp_path, insect(6))):
        with pytest.raises(
            LevadeError, match=f"^{task}: does not apply to {robot.name}: it does not stand on two legs$"
        ):
            load_task(task, robot=robot)
