"""Aimed candidates: on a linear problem the first proposal is the answer."""

from __future__ import annotations

import numpy as np
import pytest

from levade.optimizers import Aim


def told(slope: np.ndarray, offset: np.ndarray, *, spread: float = 0.1, n: int = 60) -> Aim:
    candidates = spread * np.random.default_rng(1).standard_normal((n, slope.shape[0]))
    errors = candidates @ slope + offset
    aim = Aim()
    aim.tell(candidates, errors, (errors**2).sum(axis=1))
    return aim


def test_errors_that_are_linear_vanish_at_the_proposal() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    offset = np.array([9.0, -7.0, 11.0])  # far beyond what any of the trials makes up for
    proposal = told(slope, offset, spread=0.5).propose()
    assert proposal is not None
    assert np.abs(proposal @ slope + offset).max() < 0.1


def test_an_error_well_within_its_bounds_is_left_alone() -> None:
    slope = np.eye(20)[:, :2]
    aim = Aim()
    candidates = 0.1 * np.random.default_rng(1).standard_normal((60, 20))
    errors = candidates @ slope + np.array([5.0, 0.0])
    aim.tell(candidates, errors, np.abs(errors[:, 0]))
    proposal = aim.propose()
    assert proposal is not None
    best = candidates[np.argmin(np.abs(errors[:, 0]))]
    assert abs(proposal[1] - best[1]) < 0.01
    assert proposal[0] < best[0]


def test_the_step_stays_near_the_trials_that_it_was_learnt_from() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 2))
    aim = told(slope, np.array([1e6, 0.0]))
    proposal = aim.propose()
    assert proposal is not None
    assert np.linalg.norm(proposal) < 10 * 0.1 * np.sqrt(20)


def test_no_proposal_without_enough_trials_or_once_all_is_well() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    assert Aim().propose() is None
    assert told(slope, np.ones(3), n=4).propose() is None
    assert told(1e-3 * slope, np.zeros(3)).propose() is None


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_trials_with_unknown_errors_are_left_out(bad: float) -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    offset = np.array([0.9, -0.7, 1.1])
    aim = told(slope, offset)
    before = aim.propose()
    aim.tell(np.full((5, 20), 9.0), np.full((5, 3), bad), np.zeros(5))
    after = aim.propose()
    assert before is not None
    np.testing.assert_array_equal(before, after)


def test_a_change_of_what_is_looked_at_starts_anew() -> None:
    aim = told(np.random.default_rng(0).standard_normal((20, 3)), np.ones(3))
    aim.tell(np.zeros((2, 20)), np.zeros((2, 5)), np.zeros(2))
    assert aim.propose() is None


def around(aim: Aim, *, count: int = 8, size: int = 20, step: float = 0.1, seed: int = 0) -> np.ndarray:
    factor = np.random.default_rng(7).standard_normal((size, 10))
    factor = np.linalg.qr(factor)[0] if size > 10 else np.eye(size)
    return aim.around(count, factor=factor, step=step, generator=np.random.default_rng(seed))


def test_candidates_around_the_best_differ_and_are_all_right_where_errors_are_linear() -> None:
    generator = np.random.default_rng(3)
    factor = np.linalg.qr(generator.standard_normal((20, 10)))[0]
    slope = generator.standard_normal((20, 3))
    z = 0.5 * generator.standard_normal((80, 10))
    errors = z @ factor.T @ slope + np.array([2.0, -1.0, 1.5])
    aim = Aim()
    aim.tell(z @ factor.T, errors, (errors**2).sum(axis=1))
    found = aim.around(8, factor=factor, step=0.5, generator=np.random.default_rng(0))
    missed = found @ slope + np.array([2.0, -1.0, 1.5])
    assert found.shape == (8, 20)
    assert np.abs(missed).max() < 0.5  # within the tolerance, all of them
    assert len({row.tobytes() for row in found}) == 8
    assert np.linalg.norm(found[1:] - found[0], axis=1).min() > 0.01
    np.testing.assert_allclose(found, found @ factor @ factor.T, atol=1e-12)  # nowhere that the search does not go


def test_candidates_around_are_none_without_enough_trials_and_repeat_with_the_same_random_numbers() -> None:
    slope = np.random.default_rng(0).standard_normal((20, 3))
    assert around(Aim()).shape == (0, 20)
    assert around(told(slope, np.ones(3), n=4)).shape == (0, 20)
    one, other = (around(told(slope, np.ones(3))) for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_candidates_around_a_best_that_misses_nothing_are_none_of_them_the_best() -> None:
    generator = np.random.default_rng(5)
    candidates, slope = generator.standard_normal((60, 12)), 1e-3 * generator.standard_normal((12, 2))
    aim, cost = Aim(), (candidates**2).sum(axis=1)
    aim.tell(candidates, candidates @ slope, cost)
    found = aim.around(4, factor=np.eye(12), step=0.1, generator=generator)
    assert np.abs(found - candidates[np.argmin(cost)]).max(axis=1).min() > 0
