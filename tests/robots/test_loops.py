"""Loops: what closes a loop beside a leg is opened where it is loose, and refused where it drives the leg."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot

CASES = Path(__file__).parent / "cases"
LEGS = ("lf", "rf", "lh", "rh")
ROD = ('<body name="{0}_rod" pos="0.03 0 0"><joint name="{0}_rodj" axis="0 1 0"/>'
       '<geom size="0.005" pos="0 0 -0.1" mass="0.03" contype="0" conaffinity="0"/></body>')  # fmt: skip
ROTOR = ('<body name="{0}_rotor" pos="0 0.02 0"><joint name="{0}_motor" axis="0 1 0"/>'
         '<inertial mass="0.1" pos="0 0 0" diaginertia="1e-4 1e-4 1e-4"/></body>')  # fmt: skip
TRUNK = '<geom name="trunk" type="box" size="0.2 0.04 0.05"/>'


def warnings(robot: Robot) -> list[str]:
    """Without the one that every MJCF has, which knows no speed limits."""
    said = [str(finding) for finding in robot.findings if finding.kind == "warning"]
    return [finding for finding in said if "no speed limit; " not in finding]


def with_parts(text: str, part: str) -> str:
    """A part in every thigh."""
    for leg in LEGS:
        place = f'<body name="{leg}_shank"'
        assert place in text
        text = text.replace(place, part.format(leg) + place)
    return text


def load(folder: Path, text: str, yaml: str = "") -> Robot:
    (folder / "toy.xml").write_text(text)
    (folder / "robot.yaml").write_text(f"model: toy.xml\n{yaml}")
    return load_robot(folder)


def constraint(text: str, kind: str, **names: str) -> str:
    rows = "".join(
        f"<{kind} " + " ".join(f'{key}="{value.format(leg)}"' for key, value in names.items()) + "/>" for leg in LEGS
    )
    return text.replace("</mujoco>", f"<equality>{rows}</equality></mujoco>")


@pytest.mark.slow
@pytest.mark.parametrize("description", ["pup.xml", "held.yaml"])
def test_a_loose_rod_pulls_on_no_leg(description: str) -> None:
    """Neither where levade holds it, nor where the description does."""
    robot = load_robot(CASES / "rod" / description)
    assert (len(robot.joint_names), robot.model.neq) == (12, 0)
    assert robot.mass == pytest.approx(12.52)
    (said,) = warnings(robot)
    assert said.startswith(
        "<connect> between FL_rod and FL_shankl, <connect> between FR_rod and FR_shankl and 2 more: "
    )
    assert "opened, and joints FL_rodj, FR_rodj, RL_rodj, RR_rodj, which nothing drives, held fixed" in said
    data = robot.data_at(robot.postures["neutral"])
    mujoco.mj_forward(robot.model, data)
    assert data.nefc == 0


def test_a_loop_that_a_motor_drives_is_refused(tmp_path: Path) -> None:
    (tmp_path / "fivebar.xml").write_text((CASES / "fivebar" / "named.xml").read_text())
    with pytest.raises(
        LevadeError, match="<connect> between FL_al and FL_bl closes a loop with a leg, and joint FL_b drives"
    ):
        load_robot(CASES / "fivebar" / "robot.yaml")
    with pytest.raises(
        LevadeError, match=r"closes a loop with a leg, and it runs through .*; levade moves legs without closed loops"
    ):
        load_robot(tmp_path / "fivebar.xml")


def test_a_loop_through_legs_alone_is_refused(tmp_path: Path, quadruped: type) -> None:
    bar = '<equality><connect body1="lf_shank" body2="rf_shank" anchor="0 0 -0.2"/></equality></mujoco>'
    with pytest.raises(
        LevadeError, match="closes a loop with a leg, and it runs through lf_haa, lf_hfe, lf_kfe, rf_haa and 2"
    ):
        load(tmp_path, quadruped().mjcf().replace("</mujoco>", bar))


@pytest.mark.slow
def test_a_loop_of_what_is_held_and_one_that_is_off_cost_nothing(tmp_path: Path, quadruped: type) -> None:
    text = with_parts(quadruped().mjcf(), ROD)
    off = text.replace(
        "</mujoco>", '<equality><weld body1="lf_rod" body2="lf_shank" active="false"/></equality></mujoco>'
    )
    assert warnings(load(tmp_path, off)) == []
    head = '<body name="horn"><inertial mass="1" pos="0 0 0" diaginertia="0.01 0.01 0.01"/></body>'
    weld = '<equality><weld body1="horn" body2="trunk"/></equality></mujoco>'
    within = text.replace(TRUNK, TRUNK + head).replace("</mujoco>", weld)
    assert load(tmp_path, within).model.neq == 0


def test_loops_by_sites_are_loops(tmp_path: Path, quadruped: type) -> None:
    text = with_parts(quadruped().mjcf(), ROD.replace("</body>", '<site name="{0}_a" pos="0 0 -0.18"/></body>'))
    for leg in LEGS:
        foot = f'<geom name="{leg}_foot"'
        text = text.replace(foot, f'<site name="{leg}_b" pos="0.03 0 0"/>{foot}')
    robot = load(tmp_path, constraint(text, "connect", site1="{}_a", site2="{}_b"))
    assert robot.model.neq == 0
    assert warnings(robot)[0].startswith("<connect> between lf_rod and lf_shank, ")


@pytest.mark.slow
def test_a_rotor_that_a_joint_turns_follows_it(tmp_path: Path, quadruped: type) -> None:
    """Whichever of the two the file names first: the one that carries nothing is the follower."""
    text = with_parts(quadruped().mjcf(), ROTOR)
    for names, slope in (
        ({"joint1": "{}_motor", "joint2": "{}_kfe", "polycoef": "0 6 0 0 0"}, 6.0),
        ({"joint1": "{}_kfe", "joint2": "{}_motor", "polycoef": "0 0.125 0 0 0"}, 8.0),
    ):
        robot = load(tmp_path, constraint(text, "joint", **names))
        assert (robot.model.neq, len(robot.joint_names)) == (0, 12)
        knee = robot.postures["neutral"][2]
        assert robot.held["lf_motor"] == pytest.approx(slope * knee)
        assert "follow other joints (lf_motor = " in warnings(robot)[0]


def test_a_joint_that_follows_another_of_its_leg_is_refused(tmp_path: Path, quadruped: type) -> None:
    text = constraint(quadruped().mjcf(), "joint", joint1="{}_kfe", joint2="{}_hfe", polycoef="0 -2 0 0 0")
    with pytest.raises(
        LevadeError, match=r"lf_kfe, rf_kfe, lh_kfe, rh_kfe follow other joints \(<equality>: lf_kfe = -2 lf_hfe\)"
    ):
        load(tmp_path, text)


def test_a_tendon_of_fixed_length_over_a_leg_is_refused(tmp_path: Path, quadruped: type) -> None:
    belt = (
        '<tendon><fixed name="belt"><joint joint="lf_hfe" coef="1"/><joint joint="lf_kfe" coef="1"/></fixed></tendon>'
        '<equality><tendon tendon1="belt"/></equality></mujoco>'
    )
    with pytest.raises(LevadeError, match="<tendon> belt, whose length is constrained, couples joints of a leg"):
        load(tmp_path, quadruped().mjcf().replace("</mujoco>", belt))


@pytest.mark.slow
def test_an_ankle_that_mimics_the_knee_is_held_where_its_relation_puts_it() -> None:
    robot = load_robot(CASES / "mimic-ankle" / "pup.urdf")
    knees = robot.postures["neutral"][2::3]
    assert list(robot.held) == ["FL_ankle", "FR_ankle", "RL_ankle", "RR_ankle"]
    np.testing.assert_allclose(list(robot.held.values()), 0.4 - 0.5 * knees, atol=1e-5)
    assert "(FL_ankle = 0.4 - 0.5 FL_knee): held fixed at " in warnings(robot)[0]
    # where the file's own kinematics put the foot: along the shank, then the ankle's turn, from the knee
    hip, knee = robot.postures["neutral"][1:3]
    shank, toe = hip + knee, hip + knee + 0.4 - 0.5 * knee
    x = 0.2 - 0.2 * np.sin(hip) - 0.2 * np.sin(shank) + 0.08 * np.cos(toe)
    z = -0.2 * np.cos(hip) - 0.2 * np.cos(shank) - 0.08 * np.sin(toe)
    np.testing.assert_allclose(robot.foot_positions(robot.postures["neutral"])[0, [0, 2]], [x, z], atol=1e-5)


def test_a_described_angle_of_a_follower_counts(tmp_path: Path) -> None:
    (tmp_path / "pup.urdf").write_text((CASES / "mimic-ankle" / "pup.urdf").read_text())
    (tmp_path / "robot.yaml").write_text('model: pup.urdf\nfixed: {"*_ankle": 0.9}\n')
    robot = load_robot(tmp_path)
    assert set(robot.held.values()) == {0.9}
    assert warnings(robot) == []


def test_a_knee_that_mimics_the_hip_is_refused_with_the_reason(tmp_path: Path) -> None:
    with pytest.raises(
        LevadeError, match=r"FL_knee, FR_knee, RL_knee, RR_knee follow other joints \(<mimic>: FL_knee = -2 FL_thigh"
    ):
        load_robot(CASES / "mimic-knee" / "pup.urdf")
    (tmp_path / "pup.urdf").write_text((CASES / "mimic-knee" / "pup.urdf").read_text())
    legs = "".join(
        f"  {name}: {{joints: [{leg}_hip, {leg}_thigh, {leg}_knee], foot: {leg}_shankl_0, side: {side}, end: {end}}}\n"
        for name, leg, side, end in (("lf", "FL", "left", "front"), ("rf", "FR", "right", "front"))
    )
    (tmp_path / "robot.yaml").write_text(f"model: pup.urdf\nlegs:\n{legs}")
    with pytest.raises(
        LevadeError, match=r"legs: joint FL_knee follows other joints .* remove that from pup\.urdf if the joint"
    ):
        load_robot(tmp_path)


@pytest.mark.parametrize(
    ("mimic", "message"),
    [
        ('<mimic joint="FR_ankle"/>', "follow each other in a circle"),
        ('<mimic joint="FL_knee" multiplier="two"/>', "joint FL_ankle: mimic multiplier: 'two' is not a number"),
    ],
)
def test_relations_that_say_nothing_are_refused(tmp_path: Path, mimic: str, message: str) -> None:
    text = (CASES / "mimic-ankle" / "pup.urdf").read_text()
    text = text.replace('<mimic joint="FL_knee" multiplier="-0.5" offset="0.4"/>', mimic)
    text = text.replace('<mimic joint="FR_knee" multiplier="-0.5" offset="0.4"/>', '<mimic joint="FL_ankle"/>')
    (tmp_path / "pup.urdf").write_text(text)
    with pytest.raises(LevadeError) as caught:
        load_robot(tmp_path / "pup.urdf")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_leader_that_is_not_there_leaves_its_follower_fixed(tmp_path: Path) -> None:
    text = (CASES / "mimic-ankle" / "pup.urdf").read_text().replace('<mimic joint="FL_knee"', '<mimic joint="FL_kneee"')
    (tmp_path / "pup.urdf").write_text(text)
    robot = load_robot(tmp_path / "pup.urdf")
    assert robot.held["FL_ankle"] == 0.4
    assert warnings(robot)[0] == (
        "joint FL_ankle: mimics 'FL_kneee', which is not another joint of the file: held fixed; did you mean FL_knee?"
    )
