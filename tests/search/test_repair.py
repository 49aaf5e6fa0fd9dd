"""A mean that misses criteria of the nominal model is moved to where it meets them, by the smallest step."""

from __future__ import annotations

import numpy as np
import pytest

from levade.search.repair import Repair

FACTOR = np.diag([0.5, 2.0, 1.0])
ONE_SIDED = np.array([False, True])
SLOPE = np.array([[1.0, 0.0], [0.0, 0.5], [0.0, 0.0]])
"""Of the two errors, in the search's coordinates: each depends on one of them, and none on the third."""


def told(offset: tuple[float, float], *, generations: int = 3) -> Repair:
    repair, random = Repair(FACTOR, ONE_SIDED), np.random.default_rng(0)
    for _ in range(generations):
        at = random.standard_normal((16, 3))
        repair.tell(at @ FACTOR.T, offset + at @ SLOPE)
    return repair


def test_a_mean_that_meets_every_criterion_stays() -> None:
    mean = np.zeros(3)
    for offset in ((0.9, 0.9), (-0.9, -50.0)):  # a bound may be kept by any distance
        np.testing.assert_array_equal(told(offset).repaired(mean), mean)


def test_where_errors_are_linear_it_moves_to_a_fifth_inside_the_tolerance_and_no_farther() -> None:
    """By hand: the first error from 3 to 0.8 with slope 1, the second from 2 to 0.8 with slope 1/2."""
    np.testing.assert_allclose(told((3.0, 0.0)).repaired(np.zeros(3)), FACTOR @ [-2.2, 0.0, 0.0], atol=0.02)
    np.testing.assert_allclose(told((-3.0, 0.0)).repaired(np.zeros(3)), FACTOR @ [2.2, 0.0, 0.0], atol=0.02)
    np.testing.assert_allclose(told((0.0, 2.0)).repaired(np.zeros(3)), FACTOR @ [0.0, -2.4, 0.0], atol=0.02)


def test_a_criterion_that_the_step_would_break_is_kept() -> None:
    repair, random = Repair(FACTOR, ONE_SIDED), np.random.default_rng(1)
    slope = np.array([[1.0, -1.0], [0.0, 0.5], [0.0, 0.0]])  # what mends the first error raises the second
    for _ in range(4):
        at = random.standard_normal((16, 3))
        repair.tell(at @ FACTOR.T, np.array([2.0, 0.7]) + at @ slope)
    moved = np.linalg.solve(FACTOR, repair.repaired(np.zeros(3)))
    first, second = np.array([2.0, 0.7]) + moved @ slope
    assert first == pytest.approx(0.8, abs=0.03)
    assert second <= 0.83


def test_it_waits_for_some_generations_and_does_not_trust_the_regression_far_off() -> None:
    mean = np.zeros(3)
    np.testing.assert_array_equal(told((3.0, 0.0), generations=2).repaired(mean), mean)
    far = np.linalg.solve(FACTOR, told((100.0, 0.0)).repaired(mean))
    assert 3.0 < np.linalg.norm(far) < 7.0  # three times the usual length of a candidate's step, about 1.5


def test_what_is_unknown_or_broke_down_is_left_out() -> None:
    repair, random = Repair(FACTOR, ONE_SIDED), np.random.default_rng(0)
    for _ in range(3):
        at = random.standard_normal((17, 3))
        errors = np.array([3.0, np.nan]) + at @ SLOPE  # the second criterion looks at a hold that is not simulated
        errors[0] = np.nan
        repair.tell(at @ FACTOR.T, errors)
    np.testing.assert_allclose(repair.repaired(np.zeros(3)), FACTOR @ [-2.2, 0.0, 0.0], atol=0.02)
    repair.forget()
    np.testing.assert_array_equal(repair.repaired(np.zeros(3)), np.zeros(3))
