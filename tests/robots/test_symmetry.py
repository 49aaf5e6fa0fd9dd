"""Mirror signs come from joint axes at zero angles; here they are compared with foot positions at other angles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot, mirror_signs


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.mark.parametrize("leader", ["lf", "rf", "lh", "rh"])
@pytest.mark.parametrize("follower", ["lf", "rf", "lh", "rh"])
def test_mirrored_angles_put_the_feet_at_mirrored_places(robot: Robot, leader: str, follower: str) -> None:
    one, other = robot.leg(leader), robot.leg(follower)
    signs = mirror_signs(robot, one, other)
    mirror = np.array([1 if one.end == other.end else -1, 1 if one.side == other.side else -1, 1])
    generator = np.random.default_rng(3)
    for _ in range(5):
        angles = np.zeros(12)
        angles[robot.joint_indices(one)] = generator.uniform(-1, 1, 3)
        angles[robot.joint_indices(other)] = signs * angles[robot.joint_indices(one)]
        feet = dict(zip(("lf", "rf", "lh", "rh"), robot.foot_positions(angles), strict=True))
        np.testing.assert_allclose(feet[follower], mirror * feet[leader], atol=1e-9)


def test_hind_legs_turn_the_sign_of_hfe_and_kfe(robot: Robot) -> None:
    """The data sheet's convention for postures."""
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("rf")), [1, 1, 1])
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("lh")), [1, -1, -1])
    np.testing.assert_array_equal(mirror_signs(robot, robot.leg("lf"), robot.leg("rh")), [1, -1, -1])


def changed(robot: Robot, old: str, new: str) -> Robot:
    assert robot.mjcf.count(old) == 1
    return replace(robot, mjcf=robot.mjcf.replace(old, new))


def test_a_turned_axis_turns_the_sign(robot: Robot) -> None:
    other = changed(
        robot, '<joint name="rf_haa" class="haa" axis="1 0 0"', '<joint name="rf_haa" class="haa" axis="-1 0 0"'
    )
    np.testing.assert_array_equal(mirror_signs(other, other.leg("lf"), other.leg("rf")), [-1, 1, 1])


def test_legs_that_are_not_mirror_images_are_refused(robot: Robot) -> None:
    tilted = changed(
        robot, '<joint name="rf_haa" class="haa" axis="1 0 0"', '<joint name="rf_haa" class="haa" axis="1 0.1 0"'
    )
    with pytest.raises(
        LevadeError, match=r"lf and rf are not mirror images: axes of lf_haa and rf_haa differ by 5.71 deg"
    ):
        mirror_signs(tilted, tilted.leg("lf"), tilted.leg("rf"))
    moved = changed(robot, '<body name="rh_hip" pos="-0.4435 -0.097 0"', '<body name="rh_hip" pos="-0.4435 -0.12 0"')
    with pytest.raises(LevadeError, match=r"joints lh_haa and rh_haa are 0\.023 m apart after reflection"):
        mirror_signs(moved, moved.leg("lh"), moved.leg("rh"))
    shorter = replace(robot.leg("rf"), joints=("rf_haa", "rf_hfe"))
    with pytest.raises(LevadeError, match="3 and 2 joints"):
        mirror_signs(robot, robot.leg("lf"), shorter)


def test_hind_legs_that_repeat_the_front_ones_copy_them(robot: Robot) -> None:
    """Knees ">>": the neutral posture decides between a reflection and a shift, as both take straight legs to each other."""
    neutral = robot.postures["neutral"].copy()
    neutral[6:] = neutral[:6]
    other = replace(robot, postures={"neutral": neutral})
    np.testing.assert_array_equal(mirror_signs(other, other.leg("lf"), other.leg("lh")), [1, 1, 1])
    np.testing.assert_array_equal(mirror_signs(other, other.leg("rh"), other.leg("lf")), [1, 1, 1])
