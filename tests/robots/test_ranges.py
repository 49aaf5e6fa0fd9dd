"""Ranges and speeds that no joint has: degrees are taken for degrees, placeholders for nothing."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import DCMotor, Robot, load_robot

CASES = Path(__file__).parent / "cases"


def warnings(robot: Robot) -> list[str]:
    """Without the one that every MJCF has, which knows no speed limits."""
    said = [str(finding) for finding in robot.findings if finding.kind == "warning"]
    return [finding for finding in said if "no speed limit; " not in finding]


def in_degrees(text: str) -> str:
    """The same model with its ranges in degrees."""
    number = r'"([-\d.]+)( |" upper=")([-\d.]+)"'

    def turn(match: re.Match[str]) -> str:
        low, between, high = match.groups()[-3:]
        return f'{match[1]}"{np.degrees(float(low)):.9g}{between}{np.degrees(float(high)):.9g}"'

    text = re.sub(rf"( range=){number}", turn, text)
    return re.sub(rf"(lower=){number}", turn, text)


@pytest.mark.slow
@pytest.mark.parametrize("form", ["urdf", "mjcf"])
def test_ranges_in_degrees_are_taken_for_degrees(tmp_path: Path, quadruped: type, form: str) -> None:
    text = getattr(quadruped(), form)()
    suffix = "urdf" if form == "urdf" else "xml"
    (tmp_path / f"toy.{suffix}").write_text(text)
    (tmp_path / f"degrees.{suffix}").write_text(in_degrees(text))
    right, wrong = load_robot(tmp_path / f"toy.{suffix}"), load_robot(tmp_path / f"degrees.{suffix}")
    (said,) = warnings(wrong)
    assert "ranges of up to 143.2 rad look like degrees: read as degrees, 2.5 rad; write them in radians" in said
    np.testing.assert_allclose(wrong.limits.lower, right.limits.lower, atol=1e-5)
    np.testing.assert_allclose(wrong.limits.upper, right.limits.upper, atol=1e-5)
    np.testing.assert_allclose(wrong.postures["neutral"], right.postures["neutral"], atol=1e-5)
    joints = [wrong.model.joint(name).range for name in wrong.joint_names]
    np.testing.assert_allclose(joints, np.stack([right.limits.lower, right.limits.upper], axis=1), atol=1e-5)


def test_an_mjcf_that_says_degrees_has_them(tmp_path: Path, quadruped: type) -> None:
    text = in_degrees(quadruped().mjcf()).replace('angle="radian"', 'angle="degree"')
    (tmp_path / "toy.xml").write_text(text)
    robot = load_robot(tmp_path / "toy.xml")
    assert warnings(robot) == []
    np.testing.assert_allclose(robot.limits.upper[:3], [0.8, 1.5, -0.2], atol=1e-5)


def test_the_example_in_degrees_stands_with_its_knees_within_a_turn() -> None:
    robot = load_robot(CASES / "solidworks" / "degrees.urdf")
    assert "look like degrees" in warnings(robot)[0]
    assert np.abs(robot.postures["neutral"]).max() < np.pi
    np.testing.assert_allclose(robot.limits.upper[:3], np.radians([45, 170, -30]), rtol=1e-5)


@pytest.mark.parametrize("limit", ["1e6", "1000", "1e308", "inf"])
def test_ranges_that_no_joint_has_are_none(tmp_path: Path, quadruped: type, limit: str) -> None:
    text = quadruped().urdf().replace('lower="-1.5" upper="1.5"', f'lower="-{limit}" upper="{limit}"')
    (tmp_path / "toy.urdf").write_text(text)
    robot = load_robot(tmp_path / "toy.urdf")
    assert "lf_hfe, rf_hfe, lh_hfe, rh_hfe: limits of up to " in warnings(robot)[0]
    assert np.isinf(robot.limits.upper[1])
    assert robot.limits.upper[0] == 0.8
    assert np.abs(robot.postures["neutral"]).max() < np.pi


@pytest.mark.parametrize(("lower", "upper"), [(-9.42, 9.42), (-12.5, 12.5), (-12.0, -1.0), (4.0, 8.0)])
def test_ranges_of_a_few_turns_count_and_the_posture_is_nearest_to_zero(
    tmp_path: Path, quadruped: type, lower: float, upper: float
) -> None:
    """Of the angles that put the foot under the hip, those a turn apart; here for hips whose zero may be out of range."""
    text = quadruped(knees="back").urdf().replace('lower="-1.5" upper="1.5"', f'lower="{lower}" upper="{upper}"')
    (tmp_path / "toy.urdf").write_text(text)
    robot = load_robot(tmp_path / "toy.urdf")
    assert robot.limits.lower[1] == lower
    straight = float(np.arccos(0.75))  # a leg of two equal links, as high as three quarters of its length
    turned = [straight + 2 * np.pi * turns for turns in range(-3, 4)]
    nearest = min((angle for angle in turned if lower < angle < upper), key=abs)
    assert robot.postures["neutral"][1] == pytest.approx(nearest, abs=1e-6)


def test_a_range_that_is_no_number_is_refused(tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy.xml").write_text(quadruped().mjcf().replace('range="-1.5 1.5"', 'range="nan 1.5"'))
    with pytest.raises(LevadeError, match=r"toy\.xml"):
        load_robot(tmp_path / "toy.xml")


@pytest.mark.slow
@pytest.mark.parametrize("speed", ["1000", "1e12", "101", "1e300", "inf"])
def test_speeds_that_no_joint_has_are_none(tmp_path: Path, quadruped: type, speed: str) -> None:
    (tmp_path / "toy.urdf").write_text(quadruped().urdf().replace('velocity="15.0"', f'velocity="{speed}"'))
    robot = load_robot(tmp_path / "toy.urdf")
    np.testing.assert_allclose(robot.limits.velocity, 4 * np.sqrt(9.81 / 0.4))
    assert robot.limits.assumed_velocity == tuple(range(12))
    assert isinstance(robot.actuation, DCMotor)
    assert robot.origins["velocity"] == "assumed"
    said = [text for text in warnings(robot) if "speed limits of up to" in text]
    assert len(said) == (speed != "inf")
    robot.spec().compile()


@pytest.mark.slow
def test_the_example_of_a_huge_speed() -> None:
    robot = load_robot(CASES / "velocity-huge" / "v1e12.urdf")
    assert warnings(robot)[0].startswith("all joints: speed limits of up to 1e+12 rad/s are not plausible; 19.8")


@pytest.mark.parametrize("speed", [7.5, 25.0, 150.0])
def test_a_speed_limit_in_a_description_is_believed(tmp_path: Path, quadruped: type, speed: float) -> None:
    (tmp_path / "toy.xml").write_text(quadruped().mjcf())
    (tmp_path / "robot.yaml").write_text(f"model: toy.xml\nlimits: {{velocity: {speed}}}\n")
    robot = load_robot(tmp_path)
    assert set(robot.limits.velocity) == {speed}
    assert (robot.limits.assumed_velocity, robot.origins["velocity"]) == ((), "robot.yaml")
    assert isinstance(robot.actuation, DCMotor)
    np.testing.assert_array_equal(robot.actuation.no_load_speed, speed)
    assert robot.findings == tuple(finding for finding in robot.findings if "speed" not in finding.what)


def test_one_joint_without_a_speed_limit_is_named(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().urdf().replace('velocity="15.0"', "", 1)
    (tmp_path / "toy.urdf").write_text(text)
    robot = load_robot(tmp_path / "toy.urdf")
    (joint,) = robot.limits.assumed_velocity
    assert set(np.delete(robot.limits.velocity, joint)) == {15.0}
    said = [str(finding) for finding in robot.findings if "speed" in finding.what]
    remedy = "robot.yaml, limits: {velocity: ...} gives the real one"
    assert said == [f"joint {robot.joint_names[joint]}: no speed limit; 19.8 rad/s is assumed; {remedy}"]


def test_a_fast_joint_is_believed(tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy.urdf").write_text(quadruped().urdf().replace('velocity="15.0"', 'velocity="60"'))
    robot = load_robot(tmp_path / "toy.urdf")
    assert (warnings(robot), set(robot.limits.velocity)) == ([], {60.0})
