"""References that leave what the joints were told last, and settle in a posture, whatever the weights."""

from __future__ import annotations

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.policies import Ends, GaussianKernels, Policy, independent_joints

START, GOAL = np.array([0.3, -1.0, 2.0]), np.array([-0.2, 0.5, 1.0])


def policy(ends: Ends | None, hold_steps: int = 10) -> Policy:
    return Policy(GaussianKernels(6), independent_joints(3), 1.0, 0.002, hold_steps, ends)


def random_weights(n: int = 4) -> np.ndarray:
    return np.random.default_rng(1).uniform(-2, 2, (n, 18))


def test_it_ends_exactly_at_the_goal_and_at_rest() -> None:
    reference = policy(Ends(START, GOAL, settle=0.4)).reference(random_weights())
    np.testing.assert_array_equal(reference.position[:, 499:], np.broadcast_to(GOAL, (4, 11, 3)))
    np.testing.assert_array_equal(reference.velocity[:, 499:], 0.0)
    free = policy(None).reference(random_weights())
    np.testing.assert_allclose(reference.position[:, :300], free.position[:, :300], rtol=0, atol=1e-15)


def test_it_leaves_the_start_without_a_jump() -> None:
    reference = policy(Ends(START, GOAL, depart=0.1)).reference(random_weights())
    np.testing.assert_allclose(reference.position[:, 0], np.broadcast_to(START, (4, 3)), atol=1e-3)
    assert np.abs(reference.velocity[:, 0]).max() < 0.5
    free = policy(None).reference(random_weights())
    np.testing.assert_allclose(reference.position[:, 50:], free.position[:, 50:], rtol=0, atol=1e-15)


def test_the_velocity_is_the_time_derivative() -> None:
    reference = policy(Ends(START, GOAL, depart=0.2, settle=0.5)).reference(random_weights())
    slope = np.diff(reference.position, axis=1) / 0.002
    middle = 0.5 * (reference.velocity[:, 1:] + reference.velocity[:, :-1])
    np.testing.assert_allclose(slope[:, :499], middle[:, :499], atol=0.02)  # of up to 20 rad/s


def test_without_shares_nothing_changes() -> None:
    one, other = policy(Ends(START, GOAL)).reference(random_weights()), policy(None).reference(random_weights())
    np.testing.assert_array_equal(one.position, other.position)
    np.testing.assert_array_equal(one.velocity, other.velocity)


@pytest.mark.parametrize(
    ("depart", "settle", "message"),
    [
        (-0.1, 0.0, "depart: -0.1 should be a share of the horizon, 0 to 1"),
        (0.0, np.nan, "settle: nan should be a share"),
        (0.6, 0.5, "settle: 0.5 and depart: 0.6 are together more than the horizon"),
    ],
)
def test_shares_that_do_not_fit(depart: float, settle: float, message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        Ends(START, GOAL, depart, settle)
    assert str(caught.value).startswith(message)
