"""What is between recorded instants, against closed forms and MuJoCo."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.motions.interpolation import conjugate, exponential, hermite, linear, locate, log, mean, multiply, rotations

H = 0.01


def wave(time: np.ndarray, omega: float) -> tuple[np.ndarray, np.ndarray]:
    """A sine and a cosine of amplitude 1, and their rates."""
    angle = omega * time[:, None] + np.array([0.3, 1.9])
    return np.sin(angle), omega * np.cos(angle)


def top(time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A symmetric top that precesses and spins at constant rates: quaternions, and angular velocity in world axes."""
    precession, spin = np.array([0.0, 0.0, 9.0]), np.array([0.0, 0.0, -5.0])
    tilt = exponential(np.array([0.4, 0.7, 0.0]))
    quaternion = multiply(multiply(exponential(time[:, None] * precession), tilt), exponential(time[:, None] * spin))
    axis = np.array([0.0, 0.0, 1.0])
    body = multiply(multiply(quaternion, np.concatenate([[0.0], axis])[None]), conjugate(quaternion))[:, 1:]
    return quaternion, precession + spin[2] * body


@pytest.mark.slow
@given(st.floats(1.0, 120.0), st.floats(10.0, 3000.0))
def test_cubics_and_lines_keep_their_bounds_and_the_recorded_values(omega: float, rate: float) -> None:
    recorded, time = np.arange(41) * H, np.arange(int(0.4 * rate) + 1) / rate
    value, slope = wave(recorded, omega)
    interval, share = locate(time, H, 40)
    exact, exact_slope = wave(time, omega)
    assert np.abs(hermite(interval, share, value, slope, H) - exact).max() <= H**4 * omega**4 / 384 + 1e-12
    assert np.abs(linear(interval, share, slope) - exact_slope).max() <= H**2 * omega**3 / 8 + 1e-9
    at, share = locate(recorded, H, 40)
    np.testing.assert_array_equal(hermite(at, share, value, slope, H), value)
    np.testing.assert_array_equal(linear(at, share, slope), slope)


def test_rotations_are_those_of_a_top_to_the_fourth_order() -> None:
    errors = []
    for h in (0.02, 0.01, 0.005):
        recorded, time = np.arange(round(0.4 / h) + 1) * h, np.arange(1001) * 4e-4
        quaternion, world = top(recorded)
        rates = multiply(multiply(conjugate(quaternion), np.insert(world, 0, 0.0, axis=1)), quaternion)[:, 1:]
        interval, share = locate(time, h, len(recorded) - 1)
        found = rotations(interval, share, quaternion, rates, h)
        errors.append(np.linalg.norm(log(multiply(conjugate(top(time)[0]), found)), axis=1).max())
        at, share = locate(recorded, h, len(recorded) - 1)
        np.testing.assert_array_equal(rotations(at, share, quaternion, rates, h), quaternion)
        np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0, atol=1e-14)
    assert errors[1] < 1e-5
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(16, rel=0.1)


def test_rotation_about_a_fixed_axis_is_exact_whatever_the_sign_of_the_quaternions() -> None:
    rate = np.array([3.0, -20.0, 9.0])
    recorded, time = np.arange(21) * H, np.linspace(0.0, 0.2, 333)
    exact = []
    for instant in time:
        quaternion = np.array([0.5, 0.5, 0.5, 0.5])
        mujoco.mju_quatIntegrate(quaternion, rate, instant)  # MuJoCo's rates are in body axes
        exact.append(quaternion)
    quaternion = multiply(np.full((21, 4), 0.5), exponential(recorded[:, None] * rate))
    quaternion[::3] *= -1.0
    interval, share = locate(time, H, 20)
    found = rotations(interval, share, quaternion, np.tile(rate, (21, 1)), H)
    np.testing.assert_allclose(np.abs(np.sum(found * np.array(exact), axis=1)), 1.0, atol=1e-14)


@pytest.mark.slow
@given(st.lists(st.floats(-1.8, 1.8), min_size=3, max_size=3))
def test_exponential_and_log_are_those_of_mujoco(vector: list[float]) -> None:
    rotation = np.array(vector)
    quaternion, back = np.empty(4), np.empty(3)
    angle = np.linalg.norm(rotation)
    axis = rotation / angle if angle > 0 else np.array([1.0, 0.0, 0.0])
    mujoco.mju_axisAngle2Quat(quaternion, axis, angle)
    np.testing.assert_allclose(exponential(rotation), quaternion, atol=1e-14)
    mujoco.mju_quat2Vel(back, quaternion, 1.0)
    np.testing.assert_allclose(log(quaternion), back, atol=1e-12)
    np.testing.assert_allclose(log(-exponential(rotation)), rotation, atol=1e-12)


@pytest.mark.slow
@given(st.integers(1, 60), st.floats(5.0, 2000.0))
def test_the_mean_of_steps_keeps_every_impulse(steps: int, rate: float) -> None:
    values = np.random.default_rng(steps).normal(size=(steps, 2))
    start = np.arange(int(steps * H * rate) + 1) / rate
    stop = start + 1 / rate
    found = mean(start, stop, values, H)
    beyond = (stop[-1] - steps * H) * values[-1]
    np.testing.assert_allclose(found.sum(axis=0) / rate, values.sum(axis=0) * H + beyond, atol=1e-9)
    assert (found <= values.max(axis=0) + 1e-9).all()
    assert (found >= values.min(axis=0) - 1e-9).all()


def test_the_mean_over_one_step_is_what_was_recorded() -> None:
    values = np.random.default_rng(0).normal(size=(50, 3))
    time = np.arange(51) * H
    np.testing.assert_array_equal(mean(time, time + H, values, H)[:-1], values)
    np.testing.assert_array_equal(mean(time[:-1] + H / 4, time[:-1] + H / 2, values, H), values)
    np.testing.assert_array_equal(mean(time, time + H, values, H)[-1], values[-1])
