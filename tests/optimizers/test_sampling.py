"""What PI², PI²-CMA, MPPI, CEM and random search share, and what each computes, against formulas written out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.errors import LevadeError
from levade.optimizers import CEM, MPPI, OPTIMIZERS, PI2, PI2CMA, RandomSearch, SearchSpace
from levade.optimizers.mppi import weights
from levade.optimizers.pi2 import probabilities
from levade.optimizers.sampling import bounded

SAMPLERS = [name for name in OPTIMIZERS if name not in ("cma-aimed", "cma")]
LEARNERS = [name for name in SAMPLERS if name != "random"]


def sphere(x: np.ndarray) -> np.ndarray:
    return np.square(x - 1.0).sum(axis=1)


def rosenbrock(x: np.ndarray) -> np.ndarray:
    return (100 * np.square(x[:, 1:] - x[:, :-1] ** 2) + np.square(1 - x[:, :-1])).sum(axis=1)


def run(optimizer, cost, trials: int) -> tuple[float, np.ndarray]:
    """Best cost, and all that was asked for."""
    best, asked = math.inf, []
    while len(asked) * optimizer.population < trials:
        asked.append(optimizer.ask())
        costs = cost(asked[-1])
        optimizer.tell(costs)
        best = min(best, costs.min())
    return best, np.array(asked)


@pytest.mark.parametrize("name", SAMPLERS)
def test_the_same_seed_asks_for_the_same_and_two_do_not_interfere(name: str) -> None:
    def make(seed: int):
        return OPTIMIZERS[name](SearchSpace(np.zeros(20), step=0.3), seed=seed)

    _, alone = run(make(3), sphere, 80)
    assert run(make(3), sphere, 80)[1].tobytes() == alone.tobytes()
    assert not np.array_equal(run(make(4), sphere, 80)[1], alone)
    np.random.seed(7)  # noqa: NPY002
    before = np.random.get_state()[1].copy()  # type: ignore[index]  # noqa: NPY002
    one, other, asked = make(3), make(4), []
    for _ in range(len(alone)):
        x, y = one.ask(), other.ask()
        other.tell(sphere(y))
        one.tell(sphere(x))
        asked.append(x)
    assert np.array(asked).tobytes() == alone.tobytes()
    np.testing.assert_array_equal(np.random.get_state()[1], before)  # type: ignore[index]  # noqa: NPY002


@pytest.mark.parametrize("name", LEARNERS)
def test_it_finds_the_minimum_of_a_sphere_and_of_an_ellipsoid(name: str) -> None:
    """A thousandth and less of what it starts with: 10 for the sphere, up to 200 for the ellipsoid."""
    best, _ = run(OPTIMIZERS[name](SearchSpace(np.full(10, 2.0), step=0.5), seed=0), sphere, 3000)
    assert best < 1e-3
    scales = np.logspace(0, 1, 10)
    best, _ = run(
        OPTIMIZERS[name](SearchSpace(np.full(10, 2.0), step=0.5), seed=0),
        lambda x: (scales * np.square(x - 1)).sum(axis=1),
        3000,
    )
    assert best < 0.03


@pytest.mark.parametrize("name", LEARNERS)
def test_it_follows_rosenbrocks_valley(name: str) -> None:
    """From (-1, 1), where the cost is 4, round the bend to the minimum 0 at (1, 1)."""
    best, _ = run(
        OPTIMIZERS[name](SearchSpace(np.array([-1.0, 1.0]), step=0.5, population=20), seed=1), rosenbrock, 4000
    )
    assert best < 0.25
    by_chance, _ = run(
        RandomSearch(SearchSpace(np.array([-1.0, 1.0]), step=0.5, population=20), seed=1), rosenbrock, 4000
    )
    assert best < by_chance


@pytest.mark.parametrize("name", SAMPLERS)
def test_the_first_generation_has_the_given_mean_and_covariance(name: str) -> None:
    random = np.random.default_rng(0)
    factor, mean = random.normal(size=(6, 4)), random.normal(size=6)
    optimizer = OPTIMIZERS[name](SearchSpace(mean, factor=factor, step=0.5, population=20_000), seed=0)
    asked = optimizer.ask()
    np.testing.assert_array_equal(asked[0], mean)  # the centre itself, without noise
    expected = 0.25 * factor @ factor.T
    np.testing.assert_allclose(np.cov(asked.T), expected, atol=0.05 * np.abs(expected).max())
    assert optimizer.step == pytest.approx(0.5)
    assert np.linalg.matrix_rank(asked - mean, tol=1e-9) == 4


@pytest.mark.parametrize("name", SAMPLERS)
def test_the_step_can_be_scaled(name: str) -> None:
    one, other = (OPTIMIZERS[name](SearchSpace(np.zeros(5), step=0.4), seed=2) for _ in range(2))
    other.scale_step(0.5)
    assert other.step == pytest.approx(0.2)
    np.testing.assert_allclose(other.ask(), 0.5 * one.ask(), rtol=1e-6)


@pytest.mark.parametrize("name", LEARNERS)
def test_offset_and_unit_of_the_cost_do_not_matter(name: str) -> None:
    def search(cost) -> np.ndarray:
        return run(OPTIMIZERS[name](SearchSpace(np.zeros(8), step=0.3), seed=5), cost, 200)[1]

    plain = search(sphere)
    np.testing.assert_allclose(search(lambda x: 4.0 * sphere(x)), plain, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(search(lambda x: 1024.0 + sphere(x)), plain, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("name", SAMPLERS)
def test_a_trial_that_broke_down_counts_as_a_bad_one_only(name: str) -> None:
    """Without bounding costs, 1e12 among them makes all others equal, and the centre moves to their plain mean."""

    def breaks_down(x: np.ndarray) -> np.ndarray:
        return np.where(np.arange(len(x)) == 3, 1e12, sphere(x))

    best, _ = run(OPTIMIZERS[name](SearchSpace(np.full(6, 2.0), step=0.5), seed=0), breaks_down, 2000)
    assert best < (0.02 if name in LEARNERS else 6.0)


@pytest.mark.parametrize("name", SAMPLERS)
def test_flat_landscapes_do_not_stop_it(name: str) -> None:
    optimizer = OPTIMIZERS[name](SearchSpace(np.zeros(6), step=0.1), seed=0)
    for _ in range(300):
        optimizer.tell(np.full(len(optimizer.ask()), 1e12))
    assert np.isfinite(optimizer.ask()).all()
    assert optimizer.step > 0


@pytest.mark.slow
@given(
    cost=st.lists(st.floats(0, 1e3), min_size=2, max_size=30),
    offset=st.floats(-100, 100),
    unit=st.floats(0.1, 10),
)
def test_weights_are_a_distribution_that_prefers_what_costs_less(cost: list[float], offset: float, unit: float) -> None:
    costs = np.array(cost)
    for share in (lambda c: probabilities(c, 10.0), lambda c: weights(c, 0.1)):
        p = share(costs)
        assert p.sum() == pytest.approx(1.0)
        assert (p >= 0).all()
        assert (np.diff(p[np.argsort(costs)]) <= 1e-12).all()
        if np.ptp(costs) > 1e-3:
            np.testing.assert_allclose(share(unit * costs + offset), p, atol=1e-6)


def test_the_probabilities_of_pi2_are_those_of_the_paper() -> None:
    """h = 10: a trial in the middle between best and worst weighs e^-5 of the best."""
    p = probabilities(np.array([3.0, 5.0, 7.0]), 10.0)
    np.testing.assert_allclose(p[1:] / p[0], [math.exp(-5), math.exp(-10)], rtol=1e-12)
    np.testing.assert_array_equal(probabilities(np.full(4, 2.0), 10.0), np.full(4, 0.25))


def test_pi2_moves_to_the_weighted_mean_and_pi2_cma_learns_the_weighted_spread() -> None:
    cost_of = np.array([4.0, 1.0, 2.0, 3.0, 9.0])
    for kind in (PI2, PI2CMA):
        optimizer = kind(SearchSpace(np.array([1.0, -1.0]), step=0.2, population=5), seed=0)
        asked = optimizer.ask()
        optimizer.tell(cost_of)
        learned, costs = asked[1:], cost_of[1:]  # the first is the centre
        p = np.array([math.exp(-10 * (c - 1) / 8) for c in costs])
        p /= p.sum()
        np.testing.assert_allclose(optimizer.ask()[0], p @ learned, rtol=1e-12)
        if isinstance(optimizer, PI2CMA):
            spread = sum(w * np.outer(x - [1, -1], x - [1, -1]) for w, x in zip(p, learned, strict=True))
            rate = 0.5 / math.sqrt(2)
            expected = (1 - rate) * 0.04 * np.eye(2) + rate * spread
            assert optimizer.step == pytest.approx(math.sqrt(np.trace(expected) / 2), rel=1e-9)
        else:
            assert optimizer.step == pytest.approx(0.98 * 0.2)


def test_pi2_cma_learns_a_valley() -> None:
    """Along the valley of x0 = x1 it keeps a wider spread than across."""
    optimizer = PI2CMA(SearchSpace(np.array([3.0, 0.0]), step=0.5, population=20), seed=0)
    run(optimizer, lambda x: 100 * (x[:, 0] - x[:, 1]) ** 2 + (x[:, 0] + x[:, 1]) ** 2, 1000)
    asked = optimizer.ask()[1:]
    assert np.std(asked @ [1, 1]) > 2 * np.std(asked @ [1, -1])


def test_mppi_weighs_by_the_temperature_and_anneals() -> None:
    cost_of = np.array([50.0, 1.0, 2.0, 4.0, 5.0])
    optimizer = MPPI(SearchSpace(np.zeros(3), step=0.2, population=5), seed=0, temperature=0.5, decay=0.5, floor=0.2)
    asked = optimizer.ask()
    optimizer.tell(cost_of)
    w = np.array([math.exp(-(c - 1) / (0.5 * math.sqrt(2.5))) for c in cost_of[1:]])  # variance of 1, 2, 4, 5
    np.testing.assert_allclose(optimizer.ask()[0], w @ asked[1:] / w.sum(), rtol=1e-12)
    steps = [optimizer.step]
    for _ in range(4):
        optimizer.tell(cost_of)
        steps.append(optimizer.step)
        optimizer.ask()
    np.testing.assert_allclose(steps, [0.1, 0.05, 0.04, 0.04, 0.04])
    optimizer.scale_step(0.5)  # what a stage makes narrower than the floor stays so
    optimizer.tell(cost_of)
    assert optimizer.step == pytest.approx(0.02)


def test_cem_fits_the_elite() -> None:
    cost_of = np.array([0.0, 5.0, 2.0, 1.0, 4.0, 3.0, 6.0, 7.0, 8.0])
    optimizer = CEM(SearchSpace(np.zeros(3), step=0.2, population=9), seed=0, elite=0.25, smoothing=0.5, floor=0.001)
    asked = optimizer.ask()
    optimizer.tell(cost_of)
    elite = asked[[3, 2]]
    np.testing.assert_allclose(optimizer.ask()[0], 0.5 * elite.mean(axis=0), rtol=1e-12)
    variance = 0.5 * 0.04 + 0.5 * elite.var(axis=0)
    assert optimizer.step == pytest.approx(math.sqrt(variance.mean()))
    floored = CEM(SearchSpace(np.zeros(3), step=0.2, population=9), seed=0, smoothing=1.0, floor=1.0, decay=0.9)
    for generation in range(1, 5):
        floored.ask()
        floored.tell(cost_of)
        assert floored.step >= 0.2 * 0.9**generation


def test_random_search_learns_nothing() -> None:
    one, other = (RandomSearch(SearchSpace(np.zeros(4), step=0.3), seed=1) for _ in range(2))
    for k in range(5):
        x = one.ask()
        np.testing.assert_array_equal(other.ask(), x)
        one.tell(sphere(x))
        other.tell(np.full(len(x), float(k)))


def test_costs_far_off_are_brought_back_and_others_left() -> None:
    cost = np.array([2.0, 1.0, 3.0, 1e12])
    np.testing.assert_allclose(bounded(cost), [2.0, 1.0, 3.0, 1.0 + 10 * 1.5])
    np.testing.assert_array_equal(bounded(cost[:3]), cost[:3])
    np.testing.assert_array_equal(bounded(np.full(3, 5.0)), np.full(3, 5.0))


@pytest.mark.parametrize("name", [*SAMPLERS, "cma-aimed"])
def test_tell_before_ask_and_costs_that_do_not_fit(name: str) -> None:
    optimizer = OPTIMIZERS[name](SearchSpace(np.zeros(4), step=0.1), seed=0)
    with pytest.raises(RuntimeError, match="ask first"):
        optimizer.tell(np.zeros(optimizer.population))
    asked = len(optimizer.ask())
    for wrong in (np.zeros(3), np.full(asked, np.nan)):
        with pytest.raises(ValueError, match=f"cost: expected {asked} finite numbers"):
            optimizer.tell(wrong)


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("cem", {"elite": 0.0}, r"elite: 0.0 should be a share, more than 0 and at most 1"),
        ("pi2-cma", {"rate": 2.0}, r"rate: 2.0 should be a share"),
        ("pi2", {"eliteness": -1.0}, r"eliteness: -1.0 should be a positive number"),
        ("mppi", {"temperature": math.nan}, r"temperature: nan should be a positive number"),
    ],
)
def test_wrong_settings(name: str, options: dict, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        OPTIMIZERS[name](SearchSpace(np.zeros(4), step=0.1), seed=0, **options)


@pytest.mark.parametrize("name", OPTIMIZERS)
def test_candidates_are_drawn_round_the_mean(name: str) -> None:
    """Before and after it has moved; the average of 4000 of them is within five standard errors of it."""
    optimizer = OPTIMIZERS[name](SearchSpace(np.arange(5.0), step=0.3, population=4000), seed=0)
    for _ in range(2):
        mean, x = optimizer.mean, optimizer.ask()
        assert (np.abs(x.mean(axis=0) - mean) < 5 * x.std(axis=0) / np.sqrt(len(x))).all()
        optimizer.tell(np.square(x - 10).sum(axis=1))
    assert (np.square(optimizer.mean - 10).sum() < np.square(np.arange(5) - 10).sum()) == (name != "random")
