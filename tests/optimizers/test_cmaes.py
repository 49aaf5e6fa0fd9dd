"""CMA-ES behind ask and tell: what it draws first, what it finds, and that it keeps to itself."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest

from levade.optimizers import CMAES, SearchSpace


def sphere(x: np.ndarray) -> np.ndarray:
    return np.square(x - 1.0).sum(axis=1)


@pytest.mark.parametrize(("size", "population"), [(96, 17), (192, 19), (10, 10)])
def test_the_default_population_is_the_papers(size: int, population: int) -> None:
    """4 + floor(3 ln d)."""
    optimizer = CMAES(SearchSpace(np.zeros(size), step=0.1), seed=0)
    assert optimizer.population == population == 4 + int(3 * np.log(size))
    assert optimizer.ask().shape == (population, size)


def test_the_population_can_be_chosen() -> None:
    assert CMAES(SearchSpace(np.zeros(12), step=0.1, population=8), seed=0).ask().shape == (8, 12)


@pytest.mark.parametrize("adaptation", ["csa", "tpa"])
def test_the_same_seed_asks_for_the_same_and_two_do_not_interfere(adaptation: Literal["csa", "tpa"]) -> None:
    def make(seed: int) -> CMAES:
        return CMAES(SearchSpace(np.zeros(20), step=0.3), seed=seed, step_adaptation=adaptation)

    def run(optimizer: CMAES, generations: int = 6) -> np.ndarray:
        asked = []
        for _ in range(generations):
            asked.append(optimizer.ask())
            optimizer.tell(sphere(asked[-1]))
        return np.array(asked)

    alone = run(make(3))
    np.testing.assert_array_equal(run(make(3)), alone)
    assert not np.array_equal(run(make(4)), alone)
    one, other = make(3), make(4)
    interleaved = []
    for _ in range(6):
        x, y = one.ask(), other.ask()
        other.tell(sphere(y))
        one.tell(sphere(x))
        interleaved.append(x)
    np.testing.assert_array_equal(interleaved, alone)


@pytest.mark.parametrize("adaptation", ["csa", "tpa"])
def test_numpys_global_generator_is_left_alone_and_left_out(adaptation: Literal["csa", "tpa"]) -> None:
    np.random.seed(7)  # noqa: NPY002
    before = np.random.get_state()[1].copy()  # type: ignore[index]  # noqa: NPY002
    optimizer = CMAES(SearchSpace(np.zeros(8), step=0.2), seed=1, step_adaptation=adaptation)
    first = optimizer.ask()
    optimizer.tell(sphere(first))
    for _ in range(10):
        optimizer.tell(sphere(optimizer.ask()))
    np.testing.assert_array_equal(np.random.get_state()[1], before)  # type: ignore[index]  # noqa: NPY002
    np.random.seed(8)  # noqa: NPY002
    np.testing.assert_array_equal(
        CMAES(SearchSpace(np.zeros(8), step=0.2), seed=1, step_adaptation=adaptation).ask(), first
    )


def test_the_factor_is_the_root_of_the_initial_covariance() -> None:
    """Of 20000 candidates: covariance step^2 A A', and mean as given, within the sampling error."""
    random = np.random.default_rng(0)
    factor = random.normal(size=(6, 6))
    mean = random.normal(size=6)
    optimizer = CMAES(SearchSpace(mean, factor=factor, step=0.5, population=20_000), seed=0)
    asked = optimizer.ask()
    expected = 0.25 * factor @ factor.T
    np.testing.assert_allclose(np.cov(asked.T), expected, atol=0.05 * np.abs(expected).max())
    np.testing.assert_allclose(asked.mean(axis=0), mean, atol=0.05)
    assert optimizer.step == 0.5


def test_a_narrow_factor_searches_in_its_own_subspace() -> None:
    factor = np.random.default_rng(1).normal(size=(10, 3))
    optimizer = CMAES(SearchSpace(np.ones(10), factor=factor, step=0.5), seed=0)
    deviation = optimizer.ask() - 1.0
    assert np.linalg.matrix_rank(deviation, tol=1e-9) == 3
    missed = deviation.T - factor @ np.linalg.lstsq(factor, deviation.T)[0]
    np.testing.assert_allclose(missed, 0, atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("adaptation", ["csa", "tpa"])
@pytest.mark.parametrize("condition", [1.0, 1e4])
def test_it_finds_the_minimum_of_an_ellipsoid(adaptation: Literal["csa", "tpa"], condition: float) -> None:
    scales = np.logspace(0, np.log10(condition), 8)
    target = np.linspace(-1, 1, 8)
    optimizer = CMAES(SearchSpace(np.full(8, 2.0), step=0.5), seed=0, step_adaptation=adaptation)
    for _ in range(400):
        x = optimizer.ask()
        cost = (scales * np.square(x - target)).sum(axis=1)
        optimizer.tell(cost)
        if (
            cost.min() < 1e-20
        ):  # soon costs are nothing but rounding errors, and where it goes then is the processor's business
            break
    np.testing.assert_allclose(x[np.argmin(cost)], target, atol=1e-4)
    assert optimizer.step < 1e-3


def test_a_good_factor_is_as_good_as_a_round_landscape() -> None:
    """Coordinates in which the ellipsoid is a sphere: the search is the sphere's, candidate by candidate."""
    scales = np.logspace(0, 2, 6)
    round_, long = (
        CMAES(SearchSpace(np.ones(6), step=0.3), seed=0),
        CMAES(SearchSpace(1 / scales, factor=np.diag(1 / scales), step=0.3), seed=0),
    )
    for _ in range(20):
        x, y = round_.ask(), long.ask()
        np.testing.assert_allclose(y * scales, x, rtol=1e-9, atol=1e-12)
        round_.tell(np.square(x).sum(axis=1))
        long.tell(np.square(x).sum(axis=1))


def test_a_step_factor_scales_the_spread() -> None:
    one, other = (CMAES(SearchSpace(np.zeros(5), step=0.4), seed=2) for _ in range(2))
    other.scale_step(0.5)
    assert other.step == 0.2
    np.testing.assert_allclose(other.ask(), 0.5 * one.ask(), rtol=1e-12)


def test_flat_and_broken_landscapes_do_not_stop_it() -> None:
    """The costs of trials that all diverged are equal, and huge."""
    optimizer = CMAES(SearchSpace(np.zeros(6), step=0.1), seed=0)
    for _ in range(60):
        optimizer.tell(np.full(len(optimizer.ask()), 1e12))
    assert np.isfinite(optimizer.ask()).all()


def test_tell_before_ask_and_costs_that_do_not_fit() -> None:
    optimizer = CMAES(SearchSpace(np.zeros(4), step=0.1), seed=0)
    with pytest.raises(RuntimeError, match="tell: there are no candidates to tell about; ask first"):
        optimizer.tell(np.zeros(optimizer.population))
    optimizer.ask()
    for wrong in (np.zeros(3), np.full(optimizer.population, np.nan)):
        with pytest.raises(ValueError, match=f"cost: expected {optimizer.population} finite numbers"):
            optimizer.tell(wrong)
    optimizer.tell(np.zeros(optimizer.population))
    with pytest.raises(RuntimeError, match="ask first"):
        optimizer.tell(np.zeros(optimizer.population))


@pytest.mark.slow
@pytest.mark.parametrize("adaptation", ["csa", "tpa"])
@pytest.mark.parametrize("kind", ["flat", "falls without end"])
def test_it_never_asks_for_what_is_not_finite(adaptation: Literal["csa", "tpa"], kind: str) -> None:
    """On a slope without end its step would reach inf within 2500 generations, on a plateau its covariance degenerates.

    Either way it begins again around its mean: the spread of the candidates stays within bounds.
    """
    optimizer = CMAES(SearchSpace(np.zeros(3), step=0.1, population=6), seed=0, step_adaptation=adaptation)
    for _ in range(450):
        x = optimizer.ask()
        assert np.isfinite(x).all()
        assert 1e-10 < np.ptp(x, axis=0).max() < 1e4 * 0.1
        assert np.abs(x - optimizer.mean).max() < 1e4 * 0.1
        optimizer.tell(-x[:, 0] if kind == "falls without end" else np.zeros(6))


@pytest.mark.slow
def test_a_search_that_begins_again_has_the_step_of_its_stage() -> None:
    optimizer = CMAES(SearchSpace(np.zeros(3), step=0.1), seed=0)
    optimizer.scale_step(0.5)
    steps = []
    for _ in range(200):
        optimizer.tell(-optimizer.ask()[:, 0])
        steps.append(optimizer.step)
    assert max(steps) > 10  # it grew a thousandfold
    assert 0.05 in steps
