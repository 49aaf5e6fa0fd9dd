"""Where a search begins that does not begin from nothing: weights of earlier motions, or a distribution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.search.space import SearchSpace


@dataclass(frozen=True, eq=False)
class InitialGuess:
    """Weights to begin around. All of them are tried first; the optimizer begins around the best.

    Attributes:
        candidates: Policy weights [rad], shape (k, d).
        step: Factor on the optimizer's initial step size.
        factor: Square root of the initial covariance up to the step, shape (d, m). None keeps the task's own.
    """

    candidates: Array
    step: float = 1.0
    factor: Array | None = None

    def __post_init__(self) -> None:
        if self.candidates.ndim != 2 or not len(self.candidates) or not np.isfinite(self.candidates).all():
            raise LevadeError(
                f"initial: weights should be finite numbers of shape (motions, d), got shape {self.candidates.shape}"
            )
        if not (np.isfinite(self.step) and self.step > 0):
            raise LevadeError(f"initial: a factor of {self.step} on the step makes no sense; give a positive number")

    def to_json(self) -> dict[str, Any]:
        """Plain lists; floats survive JSON to the bit."""
        factor = None if self.factor is None else self.factor.tolist()
        return {"candidates": self.candidates.tolist(), "step": self.step, "factor": factor}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> InitialGuess:
        """The guess that `to_json` wrote."""
        factor = None if content["factor"] is None else np.array(content["factor"], dtype=float)
        return cls(np.array(content["candidates"], dtype=float), float(content["step"]), factor)

    def space(self, space: SearchSpace, mean: Array) -> SearchSpace:
        """The search space around one of the candidates."""
        factor = space.factor if self.factor is None else self.factor
        return replace(space, mean=mean, step=space.step * self.step, factor=factor)
