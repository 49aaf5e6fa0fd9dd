"""The margins that a motion leaves, joint by joint and instant by instant."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from levade.costs import Criterion, Margins, Miss, clearance_of
from levade.embodiment import JointLimits, TorqueCurve
from levade.errors import LevadeError
from levade.robots import load_robot
from levade.trajectory import Trajectories

LIMITS = JointLimits(
    lower=np.full(2, -1.0),
    upper=np.full(2, 1.0),
    velocity=np.array([10.0, np.inf]),
    torque=np.full(2, 100.0),
    stall_torque=np.full(2, 200.0),
    no_load_speed=np.full(2, 20.0),
)


def with_limits(trajectories: Trajectories, limits: JointLimits) -> Trajectories:
    """The same trajectories of a robot with other limits."""
    return dataclasses.replace(trajectories, embodiment=dataclasses.replace(trajectories.embodiment, limits=limits))


@pytest.fixture
def at_rest(make):
    """Two joints at rest in the middle of their ranges; make: from tests/costs/conftest.py."""
    still = np.zeros((2, 25, 2))
    return make(2, joint_position=still, joint_velocity=still, joint_torque=still, limits=LIMITS, legs=())


def test_what_is_left_counts_as_a_multiple_of_what_is_wanted(at_rest):
    """At rest nothing is missed; at the limit each joint misses 1, beyond by the margin again 4."""
    assert Margins(angle=0.1, speed=0.05, torque_speed=0.05)(at_rest).tolist() == [0, 0]
    angle, speed = np.zeros((2, 25, 2)), np.zeros((2, 25, 2))
    angle[0, 7, 1], angle[1, 9, 0] = 1.0, -1.1
    speed[0, 24, 0], speed[1, 3, 1] = -10.25, 1e6  # the second joint has no speed limit
    moved = dataclasses.replace(at_rest, joint_position=angle, joint_velocity=speed)
    assert Margins(angle=0.1)(moved) == pytest.approx([1.0, 4.0])
    assert Margins(speed=0.05)(moved) == pytest.approx([1.5**2, 0.0])
    assert Margins(speed=0.05, over="horizon")(moved) == pytest.approx([0.0, 0.0])  # row 24 is in the hold
    assert Margins(angle=0.1, speed=0.05)(moved) == pytest.approx([1.0 + 1.5**2, 4.0])


def test_the_line_counts_while_driving_only(at_rest):
    torque, speed = np.zeros((2, 25, 2)), np.zeros((2, 25, 2))
    torque[0, 4, 0], speed[0, 4, 0] = 100.0, 12.0  # half the stall torque, 0.6 of the no-load speed
    torque[1, 4, 0], speed[1, 4, 0] = 100.0, -12.0
    moved = dataclasses.replace(at_rest, joint_torque=torque, joint_velocity=speed)
    assert Margins(torque_speed=0.1)(moved) == pytest.approx([4.0, 0.0])
    without = dataclasses.replace(LIMITS, stall_torque=None, no_load_speed=None)
    assert (Margins(torque_speed=0.1)(with_limits(moved, without)) == 0).all()


@pytest.mark.parametrize(
    ("quantity", "expected"), [("angle_margin", 0.25), ("speed_margin", 0.3), ("torque_speed_margin", 0.15)]
)
def test_margins_are_criteria_too(at_rest, quantity, expected):
    """What the tightest joint leaves at the tightest instant, of trial 0; trial 1 is at rest in the middle."""
    angle, speed, torque = np.zeros((2, 25, 2)), np.zeros((2, 25, 2)), np.zeros((2, 25, 2))
    angle[0, 7, 1], speed[0, 3], torque[0, 3] = -0.75, (7.0, 1e6), (100.0, -100.0)  # the second brakes, without a limit
    moved = dataclasses.replace(at_rest, joint_position=angle, joint_velocity=speed, joint_torque=torque)
    met, missed = (Criterion(quantity, minimum=expected + off, at="min") for off in (-0.01, 0.01))
    assert met.error(moved)[0] == 0
    assert missed.error(moved)[0] == pytest.approx(-0.01)
    assert missed.holds(moved).tolist() == [False, True]


def test_a_linkage_s_slack_is_a_share_of_what_it_transmits_there(at_rest):
    """100 Nm at the best angle, cos(0.5) of it half a radian away: 40 Nm leave 0.6, and 1 - 0.4 / cos(0.5)."""
    linked = dataclasses.replace(LIMITS, torque_curves={1: TorqueCurve(peak=100.0, rate=1.0, centre=1.0)})
    torque, angle = np.zeros((2, 25, 2)), np.ones((2, 25, 2))
    torque[:, 3], angle[1, 3, 1] = (1e6, -40.0), -1.5  # the other joint has no linkage; the curve is of |angle|
    moved = dataclasses.replace(with_limits(at_rest, linked), joint_torque=torque, joint_position=angle)
    left = np.array([0.6, 1 - 0.4 / np.cos(0.5)])
    assert Margins(linkage=0.8)(moved) == pytest.approx(((0.8 - left) / 0.8) ** 2)
    assert Margins(linkage=0.5)(moved).tolist() == [0.0, 0.0]
    for trial, slack in enumerate(left):
        met, missed = (Criterion("linkage_margin", minimum=slack + off, at="min") for off in (-1e-6, 1e-6))
        assert met.holds(moved)[trial]
        assert not missed.holds(moved)[trial]
    assert Criterion("linkage_margin", minimum=1.0, at="min").holds(at_rest).all()


def test_joints_without_limits_have_all_of_them_left(at_rest):
    ends = np.full(2, np.inf)
    none = JointLimits(-ends, ends, ends, ends)
    free = dataclasses.replace(with_limits(at_rest, none), joint_velocity=np.full((2, 25, 2), 1e3))
    for quantity in ("angle_margin", "speed_margin", "torque_speed_margin"):
        assert Criterion(quantity, minimum=1.0, at="min").holds(free).all()


def test_feet_keep_to_their_side(make):
    robot = load_robot("hyq2max")
    neutral = np.broadcast_to(robot.posture("neutral"), (1, 25, 12)).copy()
    standing = make(1, joint_position=neutral, limits=robot.limits, legs=robot.leg_geometry)
    aside = [abs(leg.foot_position(neutral)[0, 0, 1]) for leg in robot.leg_geometry]
    assert Margins(midplane=0.9 * min(aside))(standing).tolist() == [0]
    wanted = min(aside) + 0.1
    assert Margins(midplane=wanted)(standing) == pytest.approx(sum(((wanted - a) / wanted) ** 2 for a in aside))


@pytest.mark.slow
def test_limits_come_with_the_robots_line():
    limits = load_robot("hyq2max").limits
    assert limits.stall_torque is not None
    assert limits.no_load_speed is not None
    assert limits.stall_torque.tolist() == [192, 392, 400] * 4
    assert limits.no_load_speed.tolist() == [35, 17, 17] * 4
    assert load_robot("hyq2max", actuation="ideal").limits.stall_torque is None


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        (
            {},
            "margins: none is wanted; give at least one of angle, speed, torque_speed, linkage, midplane, self_distance",
        ),
        ({"speed": 0.0}, "margins.speed: 0.0 should be a positive margin; leave it out if none is wanted"),
        ({"angle": float("nan")}, "margins.angle: nan should be a positive margin"),
    ],
)
def test_margins_that_make_no_sense_are_refused(wanted, message):
    with pytest.raises(LevadeError, match=message):
        Margins(**wanted)


def test_parts_that_are_too_near_each_other_miss_a_margin(at_rest):
    """At the clearance nothing is missed, touching costs 1, and a centimetre deep 4."""
    distance = np.full((2, 25), 0.01)
    distance[0, 7], distance[1, 24] = 0.0, -0.01  # the second in the hold
    near = dataclasses.replace(at_rest, self_distance=distance)
    assert Margins(self_distance=0.01)(near) == pytest.approx([1.0, 4.0])
    assert Margins(self_distance=0.01, over="horizon")(near) == pytest.approx([1.0, 0.0])
    apart = Criterion("self_distance", minimum=0.0, at="min")
    assert apart.error(near) == pytest.approx([0.0, -0.01])
    assert apart.holds(near).tolist() == [True, False]


def test_the_clearance_that_is_measured_is_the_largest_that_something_looks_at():
    apart, wide = Criterion("self_distance", minimum=0.005, at="min"), Margins(self_distance=0.02)
    assert clearance_of([Criterion("height", minimum=1.0), Margins(speed=0.1)]) is None
    assert clearance_of([Criterion("self_distance", minimum=-0.01)]) == 0.0
    assert clearance_of([apart, Criterion("self_distance", target=0.01, tolerance=0.002)]) == pytest.approx(0.012)
    assert clearance_of([apart, wide, Miss("self_distance", minimum=0.01)]) == 0.02


def test_distances_that_were_not_recorded_are_missing_in_one_line(at_rest):
    with pytest.raises(LevadeError, match="self_distance: distances between the robot's parts were not recorded"):
        Margins(self_distance=0.01)(at_rest)
