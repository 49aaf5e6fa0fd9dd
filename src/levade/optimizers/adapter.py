"""An optimizer of one's own, checked and completed to what `levade.optimizers.Optimizer` says."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.protocol import Optimizer


def adapted(optimizer: Any, size: int) -> Optimizer:
    """Complete an object that has ``ask`` and ``tell``.

    Args:
        optimizer: The object; `levade.optimizers.protocol` says what it may provide.
        size: Weights of a candidate, d.

    Returns:
        An optimizer; a `UsesErrors` if the object has ``forget_costs``.

    Raises:
        LevadeError: If it lacks ``ask`` or ``tell``.
    """
    for method in ("ask", "tell"):
        if not callable(getattr(optimizer, method, None)):
            raise LevadeError(f"optimizer: {type(optimizer).__name__} has no method {method}; it needs ask and tell")
    kind = AdaptedWithErrors if callable(getattr(optimizer, "forget_costs", None)) else Adapted
    return kind(optimizer, size)


class Adapted:
    """Passes ask and tell on, checks what `ask` returns, and supplies what the optimizer does not have."""

    def __init__(self, optimizer: Any, size: int) -> None:
        self._optimizer, self._size = optimizer, size
        self._candidates: Array | None = None
        self._asked = False

    @property
    def population(self) -> int:
        """The optimizer's own, or else the number of candidates that it returns next."""
        own = getattr(self._optimizer, "population", None)
        return int(own) if own is not None else len(self._next())

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return float(getattr(self._optimizer, "step", np.nan))

    @property
    def mean(self) -> Array | None:
        """Mean of the search distribution, shape (d,)."""
        mean = getattr(self._optimizer, "mean", None)
        return None if mean is None else np.asarray(mean, dtype=np.float64)

    def ask(self) -> Array:
        """The next candidates, shape (n, d).

        Raises:
            LevadeError: If they have another shape or are not finite.
        """
        candidates = self._next()
        self._asked = True
        return candidates

    def tell(self, cost: Array) -> None:
        """Pass on the costs of the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (n,); all finite, lower is better.

        Raises:
            RuntimeError: If no candidates were asked for since the last call.
        """
        self._tell(cost)

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, where the optimizer can.

        Args:
            factor: Factor on the step size, above 0.
        """
        if callable(scale := getattr(self._optimizer, "scale_step", None)):
            scale(factor)

    def _next(self) -> Array:
        """Candidates whose costs are not known yet, from an earlier call or from the optimizer."""
        if self._candidates is None:
            self._candidates = self._checked(self._optimizer.ask())
        return self._candidates

    def _tell(self, *told: Array) -> None:
        if not self._asked:
            raise RuntimeError("tell: there are no candidates to tell about; ask first")
        self._candidates, self._asked = None, False
        self._optimizer.tell(*told)

    def _checked(self, asked: object) -> Array:
        name, expected = type(self._optimizer).__name__, f"expected candidates of shape (n, {self._size})"
        try:
            candidates = np.array(asked, dtype=np.float64)
        except (TypeError, ValueError):
            raise LevadeError(f"{name}.ask: {expected}, got {type(asked).__name__}") from None
        if candidates.ndim != 2 or candidates.shape[1] != self._size or not len(candidates):
            hint = "; one row for each candidate" if candidates.shape == (self._size,) else ""
            raise LevadeError(f"{name}.ask: {expected} with n of at least 1, got {candidates.shape}{hint}")
        wrong = np.flatnonzero(~np.isfinite(candidates).all(axis=1))
        if wrong.size:
            raise LevadeError(
                f"{name}.ask: candidates {wrong.tolist()} of {len(candidates)} are not finite; expected angles in rad"
            )
        return candidates


class AdaptedWithErrors(Adapted):
    """The same for an optimizer that uses the errors behind the costs."""

    def tell(self, cost: Array, errors: Array | None = None) -> None:
        """Pass on costs and errors of the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (n,); all finite, lower is better.
            errors: Signed errors as shares of the tolerances, shape (n, k). NaN where unknown. None to pass on costs
                only.

        Raises:
            RuntimeError: If no candidates were asked for since the last call.
        """
        self._tell(cost) if errors is None else self._tell(cost, errors)

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """Pass on that costs have another meaning from now on.

        Args:
            changed: Which of the errors have another meaning, too, shape (k,).
        """
        self._optimizer.forget_costs(changed)
