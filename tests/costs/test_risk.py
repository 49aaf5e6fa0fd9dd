"""Measures of many costs, against their definitions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.costs.risk import ranked_behind, risk

COSTS = np.array([[1.0, 5.0, 3.0, 7.0], [2.0, 2.0, 2.0, 2.0], [9.0, 0.0, 0.0, 0.0]])
ALL = np.ones(COSTS.shape, dtype=bool)


def test_mean_and_worst_are_what_they_say() -> None:
    assert risk(COSTS, ALL, measure="mean").tolist() == [4.0, 2.0, 2.25]
    assert risk(COSTS, ALL, measure="worst").tolist() == [7.0, 2.0, 9.0]


def test_mean_log_prefers_few_failures_to_mild_ones() -> None:
    """One robot of four that fails badly is better than two that fail less; for the mean it is the other way round."""
    costs = np.array([[0.5, 0.5, 0.5, 500.0], [0.5, 0.5, 50.0, 50.0]])
    mean, logarithm = (risk(costs, ALL[:2], measure=one) for one in ("mean", "mean-log"))
    assert mean[0] > mean[1]
    assert logarithm[0] < logarithm[1]
    np.testing.assert_allclose(logarithm[0], (3 * np.log(1.5) + np.log(501)) / 4)
    assert risk(np.array([[-2.0, 0.0]]), ALL[:1, :2], measure="mean-log").tolist() == [-1.0]


@pytest.mark.parametrize(
    ("tail", "expected"), [(0.5, [6.0, 2.0, 4.5]), (0.25, [7.0, 2.0, 9.0]), (1.0, [4.0, 2.0, 2.25])]
)
def test_cvar_is_the_mean_of_the_worst_share(tail: float, expected: list[float]) -> None:
    assert risk(COSTS, ALL, measure="cvar", tail=tail).tolist() == expected


def test_what_is_not_known_does_not_count() -> None:
    known = np.array([[True, False, True, False], [True] * 4, [True, False, False, False]])
    costs = np.where(known, COSTS, np.nan)
    assert risk(costs, known, measure="mean").tolist() == [2.0, 2.0, 9.0]
    assert risk(costs, known, measure="worst").tolist() == [3.0, 2.0, 9.0]
    assert risk(costs, known, measure="cvar", tail=0.5).tolist() == [3.0, 2.0, 9.0]


@pytest.mark.slow
@given(st.lists(st.floats(0, 1e12), min_size=1, max_size=9), st.floats(0.05, 1.0))
def test_measures_are_in_order(costs: list[float], tail: float) -> None:
    row = np.array([costs])
    mean, cvar, worst = (
        risk(row, np.ones_like(row, dtype=bool), measure=m, tail=tail)[0] for m in ("mean", "cvar", "worst")
    )  # type: ignore[arg-type]
    assert mean <= cvar * (1 + 1e-12) + 1e-12
    assert cvar <= worst * (1 + 1e-12)


@pytest.mark.slow
@given(
    st.lists(st.tuples(st.floats(-1e12, 1e12), st.booleans()), min_size=1, max_size=12),
)
def test_who_was_left_behind_ranks_behind_in_the_same_order(candidates: list[tuple[float, bool]]) -> None:
    cost, kept = np.array([c for c, _ in candidates]), np.array([k for _, k in candidates])
    ranked = ranked_behind(cost, kept)
    assert np.isfinite(ranked).all()
    assert np.array_equal(ranked[kept], cost[kept])
    if kept.any() and not kept.all():
        assert ranked[~kept].min() >= ranked[kept].max()
    left = np.argsort(cost[~kept], kind="stable")
    assert (np.diff(ranked[~kept][left]) >= 0).all()
