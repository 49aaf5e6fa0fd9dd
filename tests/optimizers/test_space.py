"""The space that every optimizer is given: what it takes, and what it refuses."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.optimizers import SearchSpace


def test_the_factor_is_the_identity_unless_given() -> None:
    space = SearchSpace([1.0, 2.0, 3.0], step=0.1)  # type: ignore[arg-type]  # a list will do
    np.testing.assert_array_equal(space.factor, np.eye(3))
    assert (space.size, space.dimensions) == (3, 3)


def test_candidates_are_the_mean_and_the_factor_times_their_coordinates() -> None:
    random = np.random.default_rng(0)
    mean, factor, z = random.standard_normal(5), random.standard_normal((5, 2)), random.standard_normal((7, 2))
    space = SearchSpace(mean, factor, step=0.1)
    assert (space.size, space.dimensions) == (5, 2)
    expected = [[mean[i] + sum(factor[i, j] * row[j] for j in range(2)) for i in range(5)] for row in z]
    np.testing.assert_allclose(space.candidates(z), expected, rtol=1e-12)


def test_nothing_in_it_can_be_changed() -> None:
    mean = np.zeros(3)
    space = SearchSpace(mean, step=0.1, rough=np.array([False, True, False]), one_sided=np.array([True]))
    with pytest.raises(dataclasses.FrozenInstanceError):
        space.step = 0.2  # type: ignore[misc]
    for array in (space.mean, space.factor, space.rough, space.one_sided):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0  # type: ignore[index]
    mean[0] = 1.0  # who gave it may go on to use it


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"step": 0.0}, "step: 0.0 is not a step size; a positive number of rad, 0.05 to 0.3 is usual"),
        ({"step": float("nan")}, "step: nan is not a step size; a positive number of rad, 0.05 to 0.3 is usual"),
        ({"step": float("inf")}, "step: inf is not a step size; a positive number of rad, 0.05 to 0.3 is usual"),
        ({"population": 3}, "population: 3 is too small; at least 4"),
        ({"mean": np.zeros((2, 2))}, "mean: expected shape (d,), got (2, 2)"),
        ({"mean": np.zeros(0)}, "mean: expected shape (d,), got (0,)"),
        ({"mean": "zeros"}, "mean: expected an array of numbers, got str"),
        ({"mean": np.array([0.0, np.inf, np.nan, 0.0])}, "mean: 2 of 4 numbers are not finite"),
        ({"factor": np.eye(3)}, "factor: expected shape (4, m) for a mean of shape (4,), got (3, 3)"),
        ({"factor": np.ones(4)}, "factor: expected shape (4, m) for a mean of shape (4,), got (4,)"),
        ({"factor": np.full((4, 2), np.nan)}, "factor: 8 of 8 numbers are not finite"),
        ({"ending": np.zeros((2, 3))}, "ending: expected shape (q, 4), got (2, 3)"),
        ({"rough": np.zeros(3)}, "rough: expected shape (4,), got (3,)"),
        ({"one_sided": np.zeros((2, 3))}, "one_sided: expected shape (k,), got (2, 3)"),
    ],
)
def test_what_does_not_fit_is_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(LevadeError) as refused:
        SearchSpace(**{"mean": np.zeros(4), "step": 0.1} | options)
    assert str(refused.value) == message
