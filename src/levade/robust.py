"""Candidates on perturbed models: draws the models, and rolls out pairs of candidate and model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines import Engine, Models, State, perturbed_models
from levade.tasks import Robust
from levade.trajectory import JointReference, Trajectories

_AT_ONCE = 128
"""Roll-outs together: what they record has to fit into memory."""
_TAG = 1_380_930_130
"""Keeps samples apart from those that `levade check` draws with the same seed."""


@dataclass(frozen=True, eq=False)
class Samples:
    """What n candidates did on m perturbed models; nothing where ``known`` is false.

    terms: cost -> (n, m), unweighted, as in `levade.solve.Evaluation`. success, diverged, known: (n, m).
    """

    terms: Mapping[str, Array]
    success: NDArray[np.bool_]
    diverged: NDArray[np.bool_]
    known: NDArray[np.bool_]

    @classmethod
    def none(cls, terms: Iterable[str], candidates: int, models: int) -> Samples:
        """Nothing known yet, to be filled in."""
        shape = (candidates, models)
        return cls({name: np.full(shape, np.nan) for name in terms}, *np.zeros((3, *shape), dtype=bool))

    @property
    def complete(self) -> NDArray[np.bool_]:
        """(n,) whether a candidate was tried on all models."""
        return np.asarray(self.known.all(axis=1))

    @property
    def share(self) -> Array:
        """(n,) successes of all m samples; those not run count as failures."""
        return (self.success & self.known).mean(axis=1)

    @property
    def attainable(self) -> Array:
        """(n,) the share if all those not run succeed."""
        return (self.success | ~self.known).mean(axis=1)

    def to_json(self) -> dict[str, Any]:
        terms = {
            name: [[None if np.isnan(v) else v for v in row] for row in t.tolist()] for name, t in self.terms.items()
        }
        flags = {name: getattr(self, name).astype(int).tolist() for name in ("success", "diverged", "known")}
        return {"terms": terms, **flags}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> Samples:
        terms = {name: np.array(values, dtype=float) for name, values in content["terms"].items()}
        return cls(terms, *(np.array(content[name], dtype=bool) for name in ("success", "diverged", "known")))


class Judged(Protocol):
    """What of `levade.solve.Evaluation` is kept of each sample."""

    @property
    def terms(self) -> Mapping[str, Array]: ...
    @property
    def success(self) -> NDArray[np.bool_]: ...
    @property
    def diverged(self) -> NDArray[np.bool_]: ...


@dataclass(frozen=True, eq=False)
class Drawn:
    """Perturbed models, and where each starts."""

    starts: State
    models: Models

    def __len__(self) -> int:
        return len(self.models)

    def __getitem__(self, rows: NDArray[np.intp] | list[int]) -> Drawn:
        return Drawn(self.starts[rows], self.models[rows])


class Sampler:
    """Perturbed models of one task."""

    def __init__(self, engine: Engine, state: State, robust: Robust) -> None:
        self._engine, self._start, self._robust = engine, state, robust
        self._drawn: tuple[tuple[int, int], Drawn] | None = None

    def models(self, seed: int, generation: int) -> Drawn:
        """The models of a generation; those of generation 0 for all where they are never redrawn."""
        key = (seed, 0 if self._robust.redraw == "never" else generation)
        if self._drawn is None or self._drawn[0] != key:
            engine, robust = self._engine, self._robust
            perturb, n = robust.perturb, robust.samples if key[1] else robust.fixed
            sample = perturb.spread(engine.model, engine.embodiment.joints, n=n, seed=(*key, _TAG))
            self._drawn = (key, Drawn(*perturbed_models(engine.model, engine.layout, sample, self._start)))
        return self._drawn[1]

    def rollouts(
        self,
        samples: Samples,
        models: Drawn,
        reference: JointReference,
        pairs: tuple[NDArray[np.intp], NDArray[np.intp]],
        *,
        bodies: tuple[str, ...],
        judge: Callable[[Trajectories], Judged],
    ) -> None:
        """Roll out every one of some candidates on every one of some models, and note what judge says in samples."""
        candidates, columns = (axis.ravel() for axis in np.meshgrid(*pairs, indexing="ij"))
        for first in range(0, len(candidates), _AT_ONCE):
            at = (candidates[first : first + _AT_ONCE], columns[first : first + _AT_ONCE])
            tried = models[at[1]]
            out = self._engine.rollout(tried.starts, reference[at[0]], models=tried.models, record=bodies)
            found = judge(out)
            for name, values in found.terms.items():
                samples.terms[name][at] = values
            samples.success[at], samples.diverged[at], samples.known[at] = found.success, found.diverged, True
