"""The default optimizer: CMA-ES where nothing is known of errors, and soon right where they say what is missing."""

from __future__ import annotations

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.optimizers import CMAES, AimedCMAES, SearchSpace, uses_errors
from levade.optimizers.ending import FARTHEST, KEPT, PROBE, EndingRefinement, lengths
from levade.optimizers.regression import WITHIN

D = 24
ENDING = np.kron(np.eye(4), np.array([0.0, 0.0, 0.0, 0.0, 0.5, 1.0]))  # of four joints with six weights


def test_without_errors_it_is_cma_es() -> None:
    own = CMAES(SearchSpace(np.ones(6), step=0.3, population=8), seed=5)
    aimed = AimedCMAES(SearchSpace(np.ones(6), step=0.3, population=8), seed=5, aimed=6)
    for _ in range(5):
        x = own.ask()
        np.testing.assert_array_equal(aimed.ask(), x)
        own.tell((x**2).sum(axis=1))
        aimed.tell((x**2).sum(axis=1))
    assert aimed.step == own.step
    assert uses_errors(aimed)
    assert not uses_errors(own)


def trials_until_right(
    optimizer: AimedCMAES | CMAES, slope: np.ndarray, offset: np.ndarray, *, most: int = 4000
) -> int:
    """Trials until one misses nothing by more than is allowed."""
    trials = 0
    while trials < most:
        x = optimizer.ask()
        trials += len(x)
        assert len(x) <= optimizer.population
        errors = np.sin(x) @ slope + offset
        if (np.abs(errors) <= 1).all(axis=1).any():
            return trials
        cost = (errors**2).sum(axis=1)
        if isinstance(optimizer, AimedCMAES):
            optimizer.tell(cost, errors)
        else:
            optimizer.tell(cost)
    return most


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_tight_tolerances_take_a_fraction_of_the_trials_of_cma_es(seed: int) -> None:
    generator = np.random.default_rng(seed)
    slope, offset = 300 * generator.standard_normal((D, 4)), 300 * generator.standard_normal(4)
    plain = trials_until_right(CMAES(SearchSpace(np.zeros(D), step=0.1, population=12), seed=seed), slope, offset)
    aimed = trials_until_right(AimedCMAES(SearchSpace(np.zeros(D), step=0.1, population=12), seed=seed), slope, offset)
    assert aimed < 0.4 * plain


@pytest.mark.parametrize("kind", ["aimed", "finish"])
def test_errors_of_bounds_need_not_vanish(kind: str) -> None:
    """One error within a tolerance, three at most 1; no motion has all four small, for two are opposites but for 100."""
    generator = np.random.default_rng(0)
    slope = 300 * generator.standard_normal((D, 4))
    slope[:, 3] = -slope[:, 2]
    offset, one_sided = np.array([30.0, 20.0, 20.0, -120.0]), np.array([False, True, True, True])
    space = SearchSpace(np.zeros(D), step=0.01, population=12, ending=ENDING, one_sided=one_sided)
    own = {"aimed": 6, "finish": 0.0} if kind == "aimed" else {"aimed": 0, "finish": 200.0}
    optimizer = AimedCMAES(space, seed=0, **own)
    trials = 0
    while trials < 120:
        x = optimizer.ask()
        trials += len(x)
        errors = x @ slope + offset
        if ((errors <= 1).all(axis=1) & (errors[:, 0] >= -1)).any():
            return
        optimizer.tell(np.square(np.where(one_sided, np.maximum(errors, 0), errors)).sum(axis=1), errors)
    raise AssertionError("no candidate was right within 120 trials")


def test_aimed_candidates_are_finite_where_trials_all_miss_by_the_same() -> None:
    """As motions do that are too short to change anything, or whose joints are all at the end of their range."""
    optimizer = AimedCMAES(SearchSpace(np.zeros(D), step=0.1, ending=ENDING), seed=0)
    for _ in range(40):
        x = optimizer.ask()
        assert np.isfinite(x).all()
        assert len(np.unique(x, axis=0)) == len(x)
        optimizer.tell(np.full(len(x), 1000.0), np.tile([170.0, -16.0], (len(x), 1)))
    assert len(x) == optimizer.population  # aimed ones among them


@pytest.mark.parametrize("seed", range(3))
def test_what_the_ending_can_mend_is_mended_at_the_second_look(seed: int) -> None:
    """A generation of CMA-ES, one of probes, one of steps."""
    generator = np.random.default_rng(seed)
    slope, offset = 300 * generator.standard_normal((D, 2)), 30 * generator.standard_normal(2)
    finished = AimedCMAES(
        SearchSpace(np.zeros(D), step=0.01, population=12, ending=ENDING), seed=seed, aimed=0, finish=200
    )
    assert trials_until_right(finished, slope, offset) <= 12 + len(ENDING) + 1


def rough(x: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Three errors: two that follow the ending, but jump with the rest of the motion; and one that the ending cannot change."""
    rest = np.where(ENDING.sum(axis=0) == 0, x, 0.0)
    jumps = 6 * np.sin(1e6 * rest @ np.arange(D)[:, None] + np.arange(2))
    return np.column_stack([jumps + (x - rest) @ slope, 1.2 + 100 * rest.mean(axis=1)])


@pytest.mark.parametrize("seed", range(5))
def test_an_ending_is_refined_that_a_small_change_should_correct_though_another_motion_is_cheaper(seed: int) -> None:
    """The cost hardly counts the error that no ending can change, so the cheapest motion is seldom one to refine."""
    slope = 300 * np.random.default_rng(seed).standard_normal((D, 2))
    optimizer = AimedCMAES(SearchSpace(np.zeros(D), step=0.03, population=12, ending=ENDING), seed=seed)
    trials, probes = 0, 0
    while trials < 200:
        x = optimizer.ask()
        trials += len(x)
        probes += len(x) == len(ENDING) and bool(np.ptp(x[:, ENDING.sum(axis=0) == 0], axis=0).max() == 0)
        errors = rough(x, slope)
        if (np.abs(errors) <= 1).all(axis=1).any():
            break
        optimizer.tell(errors**2 @ [1.0, 1.0, 1e-3], errors)
    assert trials < 100
    assert probes == 1


def test_no_ending_is_refined_once_the_goal_is_reached() -> None:
    """CMA-ES then has all generations to lower the cost, but for the aimed candidates."""
    slope = 300 * np.random.default_rng(2).standard_normal((D, 2))
    optimizer = AimedCMAES(SearchSpace(np.zeros(D), step=0.03, population=12, ending=ENDING), seed=2)
    reached, after = False, 0
    while after < 20:
        x = optimizer.ask()
        after += reached
        assert not reached or len(x) >= 12 or len(np.unique(x @ np.diag(ENDING.sum(axis=0) == 0), axis=0)) > 1
        errors = rough(x, slope)
        reached |= bool((np.abs(errors) <= 1).all(axis=1).any())
        optimizer.tell(errors**2 @ [1.0, 1.0, 1e-3], errors)


def test_a_refinement_with_slopes_makes_no_probes_and_is_right_at_once() -> None:
    slope = 200 * np.random.default_rng(1).standard_normal((D, 3))
    along = ENDING @ slope
    errors = np.array([9.0, -4.0, 0.9])
    attempt = EndingRefinement(np.ones(D), errors, ENDING, count=1, generator=np.random.default_rng(0), slope=along)
    missed = errors + (attempt.ask() - 1) @ slope
    np.testing.assert_allclose(missed, [[WITHIN, -WITHIN, KEPT]], atol=1e-3)
    attempt.tell(missed)
    np.testing.assert_allclose(attempt.slope, along, atol=1e-6)


def test_the_length_of_a_correction_is_that_of_the_step_that_a_refinement_makes() -> None:
    generator = np.random.default_rng(2)
    slope, errors = 200 * generator.standard_normal((len(ENDING), 2)), 10 * generator.standard_normal((5, 2))
    for row, length in zip(errors, lengths(errors, slope, None), strict=True):
        attempt = EndingRefinement(np.zeros(D), row, ENDING, count=1, generator=generator, slope=slope)
        assert np.abs(attempt.ask()).max() == pytest.approx(length, rel=1e-6)


def test_the_same_seed_gives_the_same_candidates_and_another_others() -> None:
    slope, offset = np.random.default_rng(0).standard_normal((D, 3)), np.array([20.0, -10.0, 5.0])
    asked: list[list[np.ndarray]] = []
    for seed in (1, 1, (1, 1)):
        optimizer, asked_of = AimedCMAES(SearchSpace(np.zeros(D), step=0.1, ending=ENDING), seed=seed), []
        for _ in range(12):
            asked_of.append(x := optimizer.ask())
            errors = x @ slope + offset
            optimizer.tell((errors**2).sum(axis=1), errors)
        asked.append(asked_of)
    for one, other in zip(asked[0], asked[1], strict=True):
        np.testing.assert_array_equal(one, other)
    assert not np.array_equal(asked[0][0], asked[2][0])


def test_a_new_stage_begins_with_the_best_of_the_last() -> None:
    optimizer = AimedCMAES(SearchSpace(np.zeros(D), step=0.1, population=12), seed=0)
    slope = np.random.default_rng(0).standard_normal((D, 2))
    best, least = np.zeros(D), np.inf
    for _ in range(4):
        x = optimizer.ask()
        errors = x @ slope + 50.0
        cost = (errors**2).sum(axis=1)
        if cost.min() < least:
            best, least = x[np.argmin(cost)], cost.min()
        optimizer.tell(cost, errors)
    optimizer.forget_costs(np.zeros(2, dtype=bool))
    np.testing.assert_array_equal(optimizer.ask()[-1], best)


def test_a_generation_in_which_all_diverge_is_survived() -> None:
    optimizer = AimedCMAES(SearchSpace(np.zeros(D), step=0.1, ending=ENDING), seed=0)
    for _ in range(3):
        n = len(optimizer.ask())
        optimizer.tell(np.full(n, 1e12), np.full((n, 3), np.nan))
    assert np.isfinite(optimizer.ask()).all()


@pytest.mark.parametrize(("name", "value"), [("aimed", -1), ("aimed", 2.5), ("finish", -1.0), ("finish", np.nan)])
def test_settings_that_make_no_sense_are_refused(name: str, value: float) -> None:
    with pytest.raises(LevadeError, match=name):
        AimedCMAES(SearchSpace(np.zeros(4), step=0.1), seed=0, **{name: value})


def finish(errors: np.ndarray) -> EndingRefinement:
    return EndingRefinement(np.ones(D), errors, ENDING, count=3, generator=np.random.default_rng(0))


def test_a_finish_probes_each_direction_then_is_right_and_leaves_the_rest_of_the_motion_alone() -> None:
    slope = 200 * np.random.default_rng(1).standard_normal((D, 3))
    offset = -np.ones(D) @ slope + np.array([9.0, -4.0, 2.0])
    attempt = finish(np.ones(D) @ slope + offset)
    probes = attempt.ask()
    np.testing.assert_allclose(probes, 1 + PROBE * ENDING)
    attempt.tell(probes @ slope + offset)
    steps = attempt.ask()
    assert steps.shape == (3, D)
    missed = steps @ slope + offset
    assert np.abs(missed[[0, 2]]).max() < 1
    assert 2 < np.abs(missed[1]).max() < 6  # half of the way from 9
    np.testing.assert_array_equal(steps[:, ENDING.sum(axis=0) == 0], 1.0)
    attempt.tell(steps @ slope + offset)
    assert attempt.miss < 1
    assert any(np.array_equal(attempt.best, step) for step in steps)


def test_a_finish_ignores_what_is_unknown_and_trials_that_diverged() -> None:
    slope = 200 * np.random.default_rng(1).standard_normal((D, 3))
    slope[:, 2] = np.nan
    offset = -np.ones(D) @ slope + np.array([9.0, -4.0, 0.0])
    attempt = finish(np.ones(D) @ slope + offset)
    missed = attempt.ask() @ slope + offset
    missed[1] = np.nan
    attempt.tell(missed)
    assert np.abs((attempt.ask() @ slope + offset)[:1, :2]).max() < 1


def test_a_finish_gives_up_where_the_ending_cannot_help_or_steps_do_not() -> None:
    slope = np.zeros((D, 1))
    slope[-1] = 9.0 / (4 * FARTHEST)
    attempt = finish(np.array([9.0]))
    attempt.tell((attempt.ask() - 1) @ slope + 9.0)
    assert attempt.over  # it would take a step of more than a radian
    attempt = finish(np.array([9.0]))
    attempt.tell(9.0 + 300 * (attempt.ask() - 1)[:, -1:])
    assert not attempt.over
    attempt.tell(np.full((3, 1), 8.9))  # not as predicted
    assert attempt.over
    assert attempt.miss <= 9.0


@pytest.mark.parametrize("missed", [np.nan, 9.0, 0.5])
def test_a_refinement_gives_up_where_probes_diverge_or_make_no_difference(missed: float) -> None:
    attempt = finish(np.array([0.5 if missed == 0.5 else 9.0]))
    attempt.tell(np.full((len(attempt.ask()), 1), missed))
    assert attempt.over
    np.testing.assert_array_equal(attempt.best, np.ones(D))
