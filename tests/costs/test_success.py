"""Whether a motion did what was required."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.costs import DIVERGED, Criterion, errors, success
from levade.costs.orientation import quaternion_from_roll_pitch_yaw as rpy
from levade.errors import LevadeError
from levade.rotations import rotate

REAR = -1.0472
DEGREE = math.pi / 180


def test_the_paper_s_rearing(standing):
    pitch = Criterion("pitch", target=REAR, tolerance=0.006)
    trial = standing([rpy(0, REAR + 0.005, 0), rpy(0, REAR - 0.007, 2.0), rpy(1.0, REAR, 0)])
    np.testing.assert_allclose(pitch.error(trial), [0.005, -0.007, 0.0], atol=1e-12)
    np.testing.assert_array_equal(pitch.holds(trial), [True, False, True])


def test_a_robot_that_went_over_backwards_has_not_reared(standing):
    over = standing(rpy(0, -math.pi - REAR, 0))
    criterion = Criterion("pitch", target=REAR, tolerance=0.5)
    assert not criterion.holds(over)[0]
    assert criterion.error(over)[0] == pytest.approx(-60 * DEGREE, abs=1e-4)


@pytest.mark.slow
@given(st.floats(1.6, 4.6), st.floats(-math.pi, math.pi), st.floats(-0.5, 0.5))
def test_upside_down_is_never_level(standing, roll, yaw, pitch):
    trial = standing([rpy(roll, pitch, yaw), rpy(0, pitch + math.pi, yaw)])
    level = {
        "pitch": Criterion("pitch", target=0.0, tolerance=1.0),
        "tilt": Criterion("tilt", maximum=1.5),
    }
    for criterion in level.values():
        assert not criterion.holds(trial).any()
    assert not success(level, trial).any()


def test_angles_wrap(standing):
    trial = standing(rpy(-179 * DEGREE, 0, 179 * DEGREE))
    np.testing.assert_allclose(Criterion("roll", target=math.pi, tolerance=1).error(trial), DEGREE)
    np.testing.assert_allclose(Criterion("yaw", target=-math.pi, tolerance=1).error(trial), -DEGREE)


@pytest.mark.slow
@given(st.floats(0, math.pi), st.floats(0, 2 * math.pi))
def test_tilt_is_the_angle_from_upright_whichever_way(standing, angle, heading):
    axis = np.array([math.cos(heading), math.sin(heading), 0.0])
    trial = standing(np.r_[math.cos(angle / 2), math.sin(angle / 2) * axis])
    np.testing.assert_allclose(Criterion("tilt", target=0.0, tolerance=1).error(trial), angle, atol=1e-12)


def test_each_quantity_is_what_its_name_says(make):
    t = make()
    position, velocity = t.trunk_com_position(), t.trunk_com_velocity()
    ahead = rotate(t.trunk_quaternion, np.array([1.0, 0.0, 0.0]))[..., :2]
    ahead /= np.linalg.norm(ahead, axis=-1, keepdims=True)
    expected = {
        "x": position[..., 0],
        "y": position[..., 1],
        "height": position[..., 2],
        "travel": np.linalg.norm(position[..., :2] - position[:, :1, :2], axis=-1),
        "speed": np.sqrt((velocity**2).sum(axis=-1)),
        "vertical_speed": velocity[..., 2],
        "forward_speed": velocity[..., 0] * ahead[..., 0] + velocity[..., 1] * ahead[..., 1],
        "sideways_speed": velocity[..., 1] * ahead[..., 0] - velocity[..., 0] * ahead[..., 1],
        "angular_speed": np.sqrt((t.trunk_angular_velocity**2).sum(axis=-1)),
        "roll_rate": t.trunk_angular_velocity[..., 0],
        "pitch_rate": t.trunk_angular_velocity[..., 1],
        "yaw_rate": t.trunk_angular_velocity[..., 2],
        "joint_speed": np.maximum(t.joint_velocity, -t.joint_velocity).max(axis=-1),
    }
    for quantity, value in expected.items():
        error = {
            at: Criterion(quantity, target=0.25, tolerance=1, at=at).error(t)
            for at in ("horizon", "end", "max", "min", "hold")
        }
        np.testing.assert_allclose(error["horizon"], value[:, 19] - 0.25)
        np.testing.assert_allclose(error["end"], value[:, 24] - 0.25)
        np.testing.assert_allclose(error["max"], value.max(axis=1) - 0.25)
        np.testing.assert_allclose(error["min"], value.min(axis=1) - 0.25)
        hold = value[:, 20:] - 0.25
        np.testing.assert_allclose(error["hold"], [row[np.abs(row).argmax()] for row in hold])


def test_bounds_report_what_is_beyond_them(make):
    height = np.zeros((4, 25, 3))
    height[:, :, 2] = np.array([0.2, 0.5, 0.9, 0.6])[:, None]
    t = make(4, trunk_position=height, trunk_com_offset=np.zeros(3), diverged=np.array([0, 0, 0, 1], dtype=bool))
    criterion = Criterion("height", minimum=0.4, maximum=0.8)
    np.testing.assert_allclose(criterion.error(t), [-0.2, 0.0, 0.1, DIVERGED])
    np.testing.assert_array_equal(criterion.holds(t), [False, True, False, False])
    np.testing.assert_array_equal(Criterion("height", minimum=0.4).holds(t), [False, True, True, False])
    np.testing.assert_array_equal(Criterion("height", maximum=0.8).holds(t), [True, True, False, False])


def test_holding_is_for_every_row_of_the_hold(make):
    height = np.full((2, 25, 3), 0.6)
    height[1, 22] = 0.5
    t = make(2, trunk_position=height, trunk_com_offset=np.zeros(3))
    np.testing.assert_array_equal(Criterion("height", target=0.6, tolerance=0.02, at="hold").holds(t), [True, False])
    np.testing.assert_array_equal(Criterion("height", target=0.6, tolerance=0.02, at="end").holds(t), [True, True])
    np.testing.assert_array_equal(Criterion("height", minimum=0.55, at="min").holds(t), [True, False])


def test_the_value_is_that_of_the_instant_that_decides(make):
    height = np.full((3, 25, 3), 0.6)
    height[0, 22, 2], height[1, 21, 2], height[2, 5, 2] = 0.5, 0.65, 0.9
    t = make(3, trunk_position=height, trunk_com_offset=np.zeros(3))
    cases = {
        Criterion("height", target=0.61, tolerance=1, at="hold"): [0.5, 0.65, 0.6],
        Criterion("height", minimum=0.2, at="hold"): [0.5, 0.6, 0.6],
        Criterion("height", minimum=0.2, maximum=0.7, at="hold"): [0.6, 0.65, 0.6],
        Criterion("height", maximum=1.0, at="max"): [0.6, 0.65, 0.9],
        Criterion("height", target=0.0, tolerance=0, at="horizon"): [0.6, 0.6, 0.6],
    }
    for criterion, expected in cases.items():
        np.testing.assert_array_equal(criterion.value(t), expected)


def test_success_is_all_criteria_and_no_divergence(make):
    t = make(3, diverged=np.array([False, True, False]))
    always = Criterion("height", minimum=-1e9)
    never = Criterion("height", minimum=1e9)
    np.testing.assert_array_equal(success({}, t), [True, False, True])
    np.testing.assert_array_equal(success({"a": always}, t), [True, False, True])
    assert not success({"a": always, "b": never}, t).any()
    assert list(errors({"a": always, "b": never}, t)) == ["a", "b"]


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({"quantity": "pich", "target": 0, "tolerance": 1}, "pich is not a quantity; did you mean pitch?"),
        ({"quantity": "pitch"}, "give either a target and a tolerance, or a minimum and/or a maximum"),
        ({"quantity": "pitch", "target": 0, "tolerance": 1, "minimum": 0}, "give either"),
        ({"quantity": "pitch", "target": 0}, "a target goes with a tolerance"),
        ({"quantity": "pitch", "minimum": 0, "tolerance": 1}, "a target goes with a tolerance"),
        ({"quantity": "pitch", "target": 0, "tolerance": -1}, r"success\.pitch\.tolerance: -1 is negative"),
        ({"quantity": "pitch", "target": math.nan, "tolerance": 1}, r"success\.pitch\.target: nan is not finite"),
        ({"quantity": "pitch", "minimum": 2, "maximum": 1}, "the minimum 2 is above the maximum 1"),
        ({"quantity": "pitch", "minimum": 2, "at": "often"}, "'often' is unknown; horizon, end, max, min or hold"),
    ],
)
def test_errors_say_what_would_be_right(config, message):
    with pytest.raises(LevadeError, match=message):
        Criterion(**config)


def test_a_hold_is_needed_to_look_at_it(make):
    with pytest.raises(LevadeError, match="the motion ends at its horizon"):
        Criterion("height", minimum=0.0, at="hold").holds(make(hold_steps=0))


def test_room_is_what_is_left_to_the_nearer_bound_at_the_worst_instant(make):
    height = np.broadcast_to(np.array([0.0, 0.0, 0.5]), (2, 25, 3)).copy()
    height[0, -3, 2], height[1, -1, 2] = 0.58, 0.35
    level = np.broadcast_to(np.array([1.0, 0.0, 0.0, 0.0]), (2, 25, 4)).copy()
    trial = make(2, trunk_position=height, trunk_quaternion=level)
    offset = trial.trunk_com_position(slice(0, 1))[0, 0, 2] - 0.5
    within = {"minimum": 0.4 + offset, "maximum": 0.6 + offset}
    between = Criterion("height", at="hold", **within)
    np.testing.assert_allclose(between.judge(trial)[0], [0.0, -0.05], atol=1e-12)
    np.testing.assert_allclose(between.judge(trial)[1], [0.02, -0.05], atol=1e-12)
    np.testing.assert_allclose(Criterion("height", at="max", **within).judge(trial)[1], [0.02, 0.1], atol=1e-12)
    assert np.isnan(Criterion("height", target=0.5, tolerance=0.1).judge(trial)[1]).all()
