"""Intervals and correlations against closed forms and published numbers."""

from __future__ import annotations

import numpy as np
import pytest

from levade.checks.statistics import Z, rank_correlation, ranks, wilson


@pytest.mark.parametrize(
    ("successes", "runs", "low", "high"),
    [  # R. G. Newcombe, Statistics in Medicine 17 (1998), table I, method 3
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0000, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_wilsons_interval_is_the_published_one(successes: int, runs: int, low: float, high: float) -> None:
    assert wilson(successes, runs) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize("successes", [0, 1, 250, 475, 500])
def test_at_the_ends_of_the_interval_the_count_is_z_standard_deviations_off(successes: int) -> None:
    share = successes / 500
    for end in wilson(successes, 500):
        if 0 < end < 1:
            assert abs(share - end) == pytest.approx(Z * np.sqrt(end * (1 - end) / 500), rel=1e-9)
    assert wilson(successes, 500)[0] <= share <= wilson(successes, 500)[1]


def test_equal_values_share_the_mean_of_their_ranks() -> None:
    assert ranks(np.array([3.0, 1.0, 3.0, 2.0])).tolist() == [2.5, 0.0, 2.5, 1.0]


def test_rank_correlation_is_spearmans() -> None:
    # Spearman's own formula, without ties: 1 - 6 sum d^2 / (n (n^2 - 1))
    random = np.random.default_rng(0)
    values, outcome = random.normal(size=(30, 2)), random.normal(size=30)
    values[:, 1] = np.exp(outcome)
    difference = np.argsort(np.argsort(values[:, 0])) - np.argsort(np.argsort(outcome))
    by_formula = 1 - 6 * (difference**2).sum() / (30 * (30**2 - 1))
    assert rank_correlation(values, outcome) == pytest.approx([by_formula, 1.0])
    assert rank_correlation(np.ones((30, 1)), outcome).tolist() == [0.0]
