"""Aimed candidates: where errors are linear in the candidate, they are the answer."""

from __future__ import annotations

import numpy as np
import pytest

from levade.optimizers.regression import RIDGE, WITHIN, ErrorRegression, corrected, ridge


def told(slope: np.ndarray, offset: np.ndarray, *, spread: float = 0.1, n: int = 60) -> ErrorRegression:
    candidates = spread * np.random.default_rng(1).standard_normal((n, len(slope)))
    errors = candidates @ slope + offset
    aim = ErrorRegression(np.eye(len(slope)))
    aim.tell(candidates, errors, (errors**2).sum(axis=1))
    return aim


def around(aim: ErrorRegression, *, count: int = 8, step: float = 0.1, seed: int = 0) -> np.ndarray:
    return aim.around(count, step=step, generator=np.random.default_rng(seed))


def test_candidates_around_the_best_differ_and_are_all_right_where_errors_are_linear() -> None:
    generator = np.random.default_rng(3)
    factor = np.linalg.qr(generator.standard_normal((20, 10)))[0]
    slope = generator.standard_normal((20, 3))
    z = 0.5 * generator.standard_normal((80, 10))
    errors = z @ factor.T @ slope + np.array([2.0, -1.0, 1.5])
    aim = ErrorRegression(factor)
    aim.tell(z @ factor.T, errors, (errors**2).sum(axis=1))
    found = around(aim, step=0.5)
    missed = found @ slope + np.array([2.0, -1.0, 1.5])
    assert found.shape == (8, 20)
    assert np.abs(missed).max() < 0.5  # within the tolerance, all of them
    assert len({row.tobytes() for row in found}) == 8
    assert np.linalg.norm(found[1:] - found[0], axis=1).min() > 0.01
    np.testing.assert_allclose(found, found @ factor @ factor.T, atol=1e-12)  # nowhere that the search does not go


def test_errors_far_beyond_what_any_trial_makes_up_for_vanish() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    offset = np.array([9.0, -7.0, 11.0])
    assert np.abs(around(told(slope, offset, spread=0.5))[0] @ slope + offset).max() < 0.5


def test_what_is_inside_a_bound_is_left_there_and_what_is_beyond_is_brought_inside() -> None:
    """Two errors of bounds, each of a direction of its own; and the same as errors of tolerances, which are."""
    slope, one_sided = np.eye(3)[:, :2], np.array([True, True])
    still = np.zeros((1, 3))
    moved = corrected(still, np.array([-50.0, 3.0]), slope, np.inf, one_sided)
    np.testing.assert_allclose(moved, [[0.0, WITHIN - 3.0, 0.0]], atol=1e-6)
    np.testing.assert_allclose(
        corrected(still, np.array([-50.0, 3.0]), slope, np.inf), [[50.0 - WITHIN, WITHIN - 3.0, 0.0]], atol=1e-6
    )


def test_candidates_keep_what_the_best_has_of_a_rough_coordinate() -> None:
    """And are right for it: how errors change along it is known from the trials, and is not used."""
    slope, rough = np.random.default_rng(0).standard_normal((20, 3)), np.arange(20) == 7
    slope[rough] *= 100  # the easiest way to no error, if it were one
    candidates = 0.1 * np.random.default_rng(1).standard_normal((60, 20))
    errors = candidates @ slope + np.array([2.0, -1.0, 1.5])
    aim, free = ErrorRegression(np.eye(20), rough=rough), ErrorRegression(np.eye(20))
    for one in (aim, free):
        one.tell(candidates, errors, (errors**2).sum(axis=1))
    best = candidates[np.argmin((errors**2).sum(axis=1))]
    found = around(aim, step=0.03)
    np.testing.assert_array_equal(found[:, 7], best[7])
    assert np.abs(found @ slope + np.array([2.0, -1.0, 1.5])).max() < 0.5
    assert np.abs(around(free, step=0.03)[:, 7] - best[7]).min() > 0


def test_candidates_are_none_without_enough_trials_and_repeat_with_the_same_random_numbers() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    assert around(ErrorRegression(np.eye(20))).shape == (0, 20)
    assert around(told(slope, np.ones(3), n=4)).shape == (0, 20)
    assert around(told(slope, np.ones(3)), count=0).shape == (0, 20)
    assert ErrorRegression(np.eye(20)).best is None
    one, other = (around(told(slope, np.ones(3))) for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_a_best_that_misses_nothing_is_not_tried_again() -> None:
    generator = np.random.default_rng(5)
    candidates, slope = generator.standard_normal((60, 12)), 1e-3 * generator.standard_normal((12, 2))
    aim, cost = ErrorRegression(np.eye(12)), (candidates**2).sum(axis=1)
    aim.tell(candidates, candidates @ slope, cost)
    found = aim.around(4, step=0.1, generator=generator)
    assert np.abs(found - candidates[np.argmin(cost)]).max(axis=1).min() > 0


def test_the_step_stays_near_the_trials_that_it_was_learnt_from() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 2))
    found = around(told(slope, np.array([1e6, 0.0])))
    assert np.linalg.norm(found, axis=1).max() < 10 * 0.1 * np.sqrt(20)


def test_trials_with_unknown_errors_are_left_out() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    one, other = (told(slope, np.array([0.9, -0.7, 1.1])) for _ in range(2))
    other.tell(np.full((5, 20), 9.0), np.full((5, 3), np.nan), np.zeros(5))
    np.testing.assert_array_equal(around(one), around(other))


def test_without_criteria_there_is_nothing_to_aim_at() -> None:
    aim = ErrorRegression(np.eye(4))
    aim.tell(np.random.default_rng(0).standard_normal((40, 4)), np.empty((40, 0)), np.zeros(40))
    assert around(aim).shape == (0, 4)


def test_what_is_looked_at_only_lately_is_aimed_at_as_soon_as_enough_is_known_and_the_rest_from_all_trials() -> None:
    """A stage that simulates the hold: its costs are others, its errors new, those at the horizon the same."""
    generator = np.random.default_rng(2)
    slope, offset = generator.standard_normal((20, 3)), np.array([2.0, -1.0, 1.5])
    early = 0.3 * generator.standard_normal((60, 20))
    unknown = early @ slope + offset
    unknown[:, 2] = np.nan
    aim = ErrorRegression(np.eye(20))
    aim.tell(early, unknown, (unknown[:, :2] ** 2).sum(axis=1))
    before = around(aim)[0]
    assert np.abs((before @ slope + offset)[:2]).max() < 0.5 < abs((before @ slope + offset)[2])
    aim.forget_costs(np.array([False, False, True]))
    assert around(aim).shape == (0, 20)  # none is the best by the new costs
    late = 0.3 * generator.standard_normal((24, 20))
    errors = late @ slope + offset
    aim.tell(late, errors, (errors**2).sum(axis=1))
    np.testing.assert_array_equal(aim.best[0] if aim.best else None, late[np.argmin((errors**2).sum(axis=1))])
    assert np.abs(around(aim)[0] @ slope + offset).max() < 0.5


@pytest.mark.parametrize("farthest", [np.inf, 1.0])
def test_points_are_moved_by_the_smallest_step(farthest: float) -> None:
    generator = np.random.default_rng(0)
    drawn, slope, errors = generator.standard_normal((5, 6)), generator.standard_normal((6, 2)), np.array([3.0, 0.1])
    moved = corrected(drawn, errors, slope, farthest)
    if farthest == 1.0:
        assert np.linalg.norm(moved, axis=1).max() <= 1.0 + 1e-12
        return
    predicted = errors + moved @ slope
    assert np.abs(predicted).max() < WITHIN + 1e-6
    across = np.linalg.svd(slope.T)[2][2:]  # directions that no error depends on
    np.testing.assert_allclose((moved - drawn) @ across.T, 0, atol=1e-9)
    already = corrected(np.zeros((1, 6)), np.array([0.1, -0.2]), slope, farthest)
    np.testing.assert_allclose(already, 0, atol=1e-12)


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-200, 1e-170, 1e-150])
@pytest.mark.parametrize("farthest", [np.inf, 1.0])
def test_points_stay_finite_whatever_the_slope(size: float, farthest: float) -> None:
    """A step is errors over slope: with a slope near zero it overflows."""
    drawn = 0.1 * np.random.default_rng(0).standard_normal((5, 6))
    slope = size * np.random.default_rng(1).standard_normal((6, 2))
    moved = corrected(drawn, np.array([170.0, -16.0]), slope, farthest)
    assert np.isfinite(moved).all()
    if size == 0:
        np.testing.assert_array_equal(moved, drawn)
        origin = np.zeros((1, 6))
        np.testing.assert_array_equal(corrected(origin, np.array([170.0, -16.0]), slope, 100.0), origin)


@pytest.mark.parametrize(("n", "m"), [(40, 12), (12, 40), (20, 20)])
def test_ridge_is_least_squares_with_rows_added_that_ask_for_nothing(n: int, m: int) -> None:
    generator = np.random.default_rng(2)
    difference, change = generator.standard_normal((n, m)), generator.standard_normal((n, 3))
    damping = RIDGE * (difference**2).sum(axis=1).mean()
    added = np.vstack([difference, np.sqrt(damping) * np.eye(m)])
    expected = np.linalg.lstsq(added, np.vstack([change, np.zeros((m, 3))]), rcond=None)[0]
    np.testing.assert_allclose(ridge(difference, change), expected, rtol=1e-9, atol=1e-9)
