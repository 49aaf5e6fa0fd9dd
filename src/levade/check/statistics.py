"""How sure a share of successes is, and what moves with what."""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array

Z = 1.959963984540054
"""Standard deviations of the normal distribution that hold 95 % of it."""


def wilson(successes: int, runs: int) -> tuple[float, float]:
    """Lowest and highest true share that fit the count, at 95 % confidence.

    E. B. Wilson, Probable inference, the law of succession, and statistical inference, JASA 22 (1927).
    """
    if runs == 0:
        return 0.0, 1.0
    share, square = successes / runs, Z * Z / runs
    middle = (share + square / 2) / (1 + square)
    half = Z * math.sqrt(share * (1 - share) / runs + square / (4 * runs)) / (1 + square)
    # at the ends the root is exact in theory: no confidence is lost to rounding there
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    return low, 1.0 if successes == runs else min(1.0, middle + half)


def ranks(values: Array) -> Array:
    """(n, ...) ranks along the first axis, 0 for the smallest; equal values share the mean of theirs."""
    flat = values.reshape(len(values), -1)
    ranked = np.empty(flat.shape)
    for column in range(flat.shape[1]):
        _, where, count = np.unique(flat[:, column], return_inverse=True, return_counts=True)
        last = np.cumsum(count) - 1
        ranked[:, column] = (last - (count - 1) / 2)[where]
    return ranked.reshape(values.shape)


def rank_correlation(values: Array, outcome: Array) -> Array:
    """Spearman's coefficient of each column of (n, m) with (n,); 0 where either does not change."""
    one, other = ranks(values), ranks(outcome)
    one, other = one - one.mean(axis=0), other - other.mean()
    scale = np.sqrt((one**2).sum(axis=0) * (other**2).sum())
    return np.divide(one.T @ other, scale, out=np.zeros(values.shape[1]), where=scale > 0)
