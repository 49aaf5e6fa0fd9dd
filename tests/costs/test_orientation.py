"""The orientation term of eq. 7, where Euler angles are sound and where they are not."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.costs import Orientation
from levade.costs.orientation import angle_between, geodesic, pitch_past_vertical, quaternion_from_roll_pitch_yaw
from levade.errors import LevadeError
from levade.rotations import roll_pitch_yaw, rotation_matrix

REAR = -1.0472
DEGREE = math.pi / 180

unit_vectors = (
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
)
quaternions = (
    st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
)


def product(a, b):
    (w, x, y, z), (W, X, Y, Z) = a, b
    return np.array(
        [
            w * W - x * X - y * Y - z * Z,
            w * X + x * W + y * Z - z * Y,
            w * Y - x * Z + y * W + z * X,
            w * Z + x * Y - y * X + z * W,
        ]
    )


def turn(axis, angle):
    return np.r_[math.cos(angle / 2), math.sin(angle / 2) * np.asarray(axis)]


def rpy(roll=0.0, pitch=0.0, yaw=0.0):
    return quaternion_from_roll_pitch_yaw(roll, pitch, yaw)


@pytest.mark.slow
@given(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5), st.floats(-3.1, 3.1))
def test_quaternions_are_those_of_the_angles(roll, pitch, yaw):
    np.testing.assert_allclose(roll_pitch_yaw(rpy(roll, pitch, yaw)), [roll, pitch, yaw], atol=1e-8)


@pytest.mark.slow
@given(quaternions, unit_vectors, st.floats(0, math.pi))
def test_the_geodesic_is_the_angle_of_the_turn_between(base, axis, angle):
    """Exact to rounding at 0 and at pi too, where arccos of a trace loses half the digits."""
    turned = product(base, turn(axis, angle))
    assert geodesic(turned, base) == pytest.approx(angle, abs=1e-14)
    assert geodesic(-turned, base) == pytest.approx(angle, abs=1e-14)


@pytest.mark.parametrize("angle", [1e-9, 1e-5, 1.0, math.pi - 1e-9, math.pi])
def test_a_turn_about_any_axis_costs_its_square_from_any_full_goal(standing, angle):
    for roll, pitch, yaw in itertools.product([0, 1, math.pi], [0, REAR, math.pi / 2, -math.pi / 2], [0, -2]):
        goal = rpy(roll, pitch, yaw)
        trial = standing([product(goal, turn(axis, angle)) for axis in np.eye(3)])
        cost = Orientation(roll, pitch, yaw)(trial)
        np.testing.assert_allclose(np.sqrt(cost), angle, rtol=0, atol=2e-15)


CHOICES = [
    Orientation(roll=0.2, pitch=REAR, yaw=0.1),
    Orientation(roll=0.0, pitch=0.0),
    Orientation(roll=0.0, pitch=-math.pi / 2),
    Orientation(pitch=REAR),
    Orientation(pitch=-math.pi / 2),
    Orientation(pitch=-2.2),
    Orientation(pitch=0.0, yaw=0.0),
]


@pytest.mark.slow
@pytest.mark.parametrize("term", CHOICES)
@given(base=quaternions, axis=unit_vectors)
def test_a_small_turn_changes_the_cost_little_from_any_attitude(standing, term, base, axis):
    costs = term(standing([base, product(base, turn(axis, 1e-6))]))
    assert costs.min() >= 0
    assert costs.max() <= math.pi**2 + 1e-9
    # |d cost| <= 2 error |d error| everywhere but for the pitch alone, whose blend with roll may be twice as steep
    assert abs(costs[1] - costs[0]) < 2e-5 * (2 if term.roll is None else 1)


@pytest.mark.parametrize("term", CHOICES)
def test_nothing_jumps_at_the_vertical_or_on_the_side(standing, term):
    for pitch, roll in itertools.product(np.radians([-90, 90, -89.99999, 0, 40]), np.radians([-90, 0, 90, 180])):
        base = rpy(roll, pitch, 0.3)
        costs = term(standing([product(base, turn(axis, a)) for axis in np.eye(3) for a in (-1e-6, 0, 1e-6)]))
        assert np.ptp(costs) < 2e-4


def test_the_cost_is_the_paper_s_difference_to_first_order_near_the_goal(standing):
    random = np.random.default_rng(0)
    for _ in range(20):
        d = 1e-4 * random.normal(size=3)
        free = random.uniform(-1, 1, 3)
        expected = [
            (Orientation(roll=0, pitch=0, yaw=0), rpy(*d), d @ d),
            (Orientation(roll=0, pitch=0), rpy(d[0], d[1], free[2]), d[:2] @ d[:2]),
            (Orientation(pitch=0, yaw=0), rpy(free[0], d[1], d[2]), d[1:] @ d[1:]),
            (Orientation(pitch=REAR), rpy(free[0], REAR + d[1], free[2]), d[1] ** 2),
            (Orientation(roll=0.5), rpy(0.5 + d[0], free[1], free[2]), d[0] ** 2),
            (Orientation(yaw=0.5), rpy(free[0], free[1], 0.5 + d[2]), d[2] ** 2),
            (Orientation(roll=0.5, yaw=-3), rpy(0.5 + d[0], free[1], -3 + d[2]), d[0] ** 2 + d[2] ** 2),
        ]
        for term, quaternion, cost in expected:
            assert term(standing(quaternion))[0] == pytest.approx(cost, rel=1e-3)


@pytest.mark.slow
@given(st.floats(-math.pi / 2, math.pi / 2), st.floats(-math.pi / 2, math.pi / 2), st.floats(-3, 3))
def test_pitch_alone_is_the_z_y_x_pitch_while_the_top_looks_up(standing, roll, pitch, yaw):
    cost = Orientation(pitch=REAR)(standing(rpy(roll, pitch, yaw)))[0]
    assert cost == pytest.approx((pitch - REAR) ** 2, abs=1e-7)


def test_over_backwards_and_upside_down_are_not_right(standing):
    over = standing(rpy(pitch=-120 * DEGREE))
    assert roll_pitch_yaw(over.trunk_quaternion[0, 0])[1] == pytest.approx(-60 * DEGREE)
    assert Orientation(pitch=-60 * DEGREE)(over)[0] == pytest.approx((60 * DEGREE) ** 2)
    assert pitch_past_vertical(over.trunk_quaternion)[0, 0] == pytest.approx(-120 * DEGREE)
    back = standing([rpy(roll=math.pi), rpy(pitch=math.pi), rpy(roll=math.pi, yaw=1.0)])
    for level in (Orientation(pitch=0.0), Orientation(roll=0.0, pitch=0.0)):
        np.testing.assert_allclose(level(back), math.pi**2)


def test_rearing_on_past_the_vertical_costs_more_and_more(standing):
    pitches = np.radians(np.arange(-60, -240, -1.0))
    costs = Orientation(pitch=-60 * DEGREE)(standing([rpy(pitch=p) for p in pitches]))
    np.testing.assert_allclose(np.sqrt(costs), np.radians(np.arange(180)), atol=1e-7)


@pytest.mark.slow
@given(quaternions, st.floats(-3, 3), st.floats(-math.pi, math.pi))
def test_roll_and_pitch_do_not_feel_yaw(standing, base, yaw, goal_pitch):
    trial = standing([base, product(turn([0, 0, 1], yaw), base)])
    costs = Orientation(roll=0.3, pitch=goal_pitch)(trial)
    assert costs[0] == pytest.approx(costs[1], abs=1e-9)


def test_roll_and_pitch_are_the_geodesic_to_the_nearest_yaw():
    base = product(rpy(0.7, -0.9, 0.4), turn([0.6, 0, 0.8], 1.1))
    yaws = np.linspace(-math.pi, math.pi, 20001)
    nearest = min(geodesic(base, rpy(0.1, REAR, yaw)) for yaw in yaws[::20])
    up, goal_up = rotation_matrix(base)[2], rotation_matrix(rpy(0.1, REAR))[2]
    assert angle_between(up, goal_up) == pytest.approx(nearest, abs=1e-4)


def test_the_term_looks_at_the_row_it_is_told(make):
    trajectories = make()
    goal = Orientation(roll=0.1, pitch=0.2, yaw=0.3)._goal
    angles = geodesic(trajectories.trunk_quaternion, goal) ** 2
    for at, expected in (("horizon", angles[:, 19]), ("end", angles[:, 24]), ("hold", angles[:, 20:].mean(axis=1))):
        np.testing.assert_allclose(Orientation(0.1, 0.2, 0.3, at=at)(trajectories), expected)


def test_errors():
    with pytest.raises(LevadeError, match="orientation: no target; give at least one of roll, pitch, yaw"):
        Orientation()
    with pytest.raises(LevadeError, match=r"orientation\.pitch: nan is not finite"):
        Orientation(pitch=math.nan)
