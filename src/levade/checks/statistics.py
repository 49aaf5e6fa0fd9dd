"""Confidence intervals of a share of successes, and rank correlations."""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array

Z = 1.959963984540054
"""Standard deviations around the mean of a normal distribution that contain 95 % of it."""


def wilson(successes: int, runs: int) -> tuple[float, float]:
    """Compute the lowest and highest true share that fit a count, at 95 % confidence.

    E. B. Wilson, Probable inference, the law of succession, and statistical inference, JASA 22 (1927).

    Args:
        successes: Number of successes.
        runs: Number of runs.

    Returns:
        Lower and upper end of the interval, 0 to 1.
    """
    if runs == 0:
        return 0.0, 1.0
    share, square = successes / runs, Z * Z / runs
    middle = (share + square / 2) / (1 + square)
    half = Z * math.sqrt(share * (1 - share) / runs + square / (4 * runs)) / (1 + square)
    # with no success or no failure the bound is exact in theory, so rounding may not move it
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    return low, 1.0 if successes == runs else min(1.0, middle + half)


def ranks(values: Array) -> Array:
    """Rank values along the first axis; equal values share the mean of their ranks.

    Args:
        values: Values, shape (n, ...).

    Returns:
        Ranks, 0 for the smallest, of the same shape.
    """
    flat = values.reshape(len(values), -1)
    ranked = np.empty(flat.shape)
    for column in range(flat.shape[1]):
        _, where, count = np.unique(flat[:, column], return_inverse=True, return_counts=True)
        last = np.cumsum(count) - 1
        ranked[:, column] = (last - (count - 1) / 2)[where]
    return ranked.reshape(values.shape)


def rank_correlation(values: Array, outcome: Array) -> Array:
    """Compute Spearman's rank correlation of each column with an outcome.

    Args:
        values: Values, shape (n, m).
        outcome: Outcome, shape (n,).

    Returns:
        Coefficients, shape (m,); 0 for a column that does not change, or if the outcome does not.
    """
    one, other = ranks(values), ranks(outcome)
    one, other = one - one.mean(axis=0), other - other.mean()
    scale = np.sqrt((one**2).sum(axis=0) * (other**2).sum())
    return np.divide(one.T @ other, scale, out=np.zeros(values.shape[1]), where=scale > 0)
