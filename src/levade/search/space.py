"""Placeholder until optimizers/space.py lands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array


@dataclass(frozen=True, eq=False)
class SearchSpace:
    mean: Array
    factor: Array
    step: float
    population: int | None = None
    ending: Array | None = None
    one_sided: NDArray[np.bool_] | None = None
