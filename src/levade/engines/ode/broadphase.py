"""The broad phase of collision: find the pairs of shapes that may touch.

It is a fast, conservative test of all pairs of all trials at once, so that ODE tests only few. Every shape is enclosed in a box
with rounded edges. A pair is passed on unless a plane, or a face of one of the boxes, separates the two. No pair that touches
is left out.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.ode.multibody import Index, Multibody

_MARGIN = 0.04
"""Pairs within this distance [m] are also passed on, so that the answer holds until something has moved by half of it."""


class BroadPhase:
    """Tests one multibody. It remembers its last answer: call it once per step, after `forget`."""

    def __init__(self, multibody: Multibody) -> None:
        shapes = multibody.shapes
        moving = np.array([shape.link >= 0 for shape in shapes], dtype=bool)
        self._link = np.array([max(shape.link, 0) for shape in shapes])
        com = np.array([multibody.com[s.link] if s.link >= 0 else np.zeros(3) for s in shapes]).reshape(-1, 3)
        self._centre = np.array([shape.position for shape in shapes]).reshape(-1, 3) - com  # from the body's origin
        self._axes = np.array([shape.rotation.T for shape in shapes]).reshape(-1, 3, 3)  # rows: the box's axes
        self._core = np.array([shape.core for shape in shapes]).reshape(-1, 3)
        self._radius = np.array([shape.radius for shape in shapes])
        self._reach = np.linalg.norm(self._core, axis=1) + self._radius
        self._fixed = ~moving
        flat = np.array([shape.kind == "plane" for shape in shapes], dtype=bool)
        first, second = multibody.pairs.T
        on_plane = flat[second] if len(multibody.pairs) else np.zeros(0, dtype=bool)
        self._planes = []
        for plane in np.unique(second[on_plane]):
            pairs = np.flatnonzero(second == plane)
            normal = shapes[plane].rotation[:, 2]
            self._planes.append((pairs, first[pairs], normal, float(normal @ shapes[plane].position)))
        self._others = np.flatnonzero(~on_plane)
        self._first, self._second = first[self._others], second[self._others]
        self._near = (self._reach[self._first] + self._reach[self._second] + _MARGIN) ** 2
        self._extent = np.zeros(len(multibody.mass))  # of each link, from its centre of mass
        np.maximum.at(self._extent, self._link[moving], (np.linalg.norm(self._centre, axis=1) + self._reach)[moving])
        self._moved: Array | None = None
        self._found: list[list[int]] = []

    def forget(self) -> None:
        """Forget the last answer, because links were moved."""
        self._moved = None

    def __call__(self, state: Mapping[str, Array], timestep: float) -> list[list[int]]:
        """List for each trial the pairs that may touch, in ascending order.

        Args:
            state: As `levade.engines.ode.worlds.Worlds.read` returns it, one ``timestep`` after that of the previous call.
            timestep: Duration of a step [s].

        Returns:
            Pairs of each trial.
        """
        if self._moved is not None:
            speed = np.sqrt(np.sum(state["linear"] ** 2, axis=2))
            speed += np.sqrt(np.sum(state["angular"] ** 2, axis=2)) * self._extent
            self._moved += timestep * speed
        if self._moved is None or not (self._moved < 0.49 * _MARGIN).all():
            self._moved = np.zeros(state["linear"].shape[:2])
            self._found = self._find(state)
        return self._found

    def _find(self, state: Mapping[str, Array]) -> list[list[int]]:
        position = state["position"]
        n, links = position.shape[:2]
        rotation = state["rotation"].reshape(n, links, 3, 3)
        found: list[list[int]] = [[] for _ in range(n)]
        for pairs, shapes, normal, offset in self._planes:
            along = np.einsum("nlij,i->nlj", rotation, normal)[:, self._link[shapes]]  # the normal in the link's frame
            height = (position @ normal)[:, self._link[shapes]] - offset
            height += np.einsum("nsj,sj->ns", along, self._centre[shapes])
            facing = np.abs(np.einsum("nsj,skj->nsk", along, self._axes[shapes]))
            height -= np.einsum("nsk,sk->ns", facing, self._core[shapes]) + self._radius[shapes]
            for trial, pair in zip(*(index.tolist() for index in np.nonzero(height < _MARGIN)), strict=True):
                found[trial].append(int(pairs[pair]))
        if len(self._others):
            centre = position[:, self._link] + np.einsum("nsij,sj->nsi", rotation[:, self._link], self._centre)
            centre[:, self._fixed] = self._centre[self._fixed]
            between = centre[:, self._second] - centre[:, self._first]
            trial, pair = np.nonzero(np.einsum("npi,npi->np", between, between) < self._near)
            if len(trial):
                keep = ~self._apart(rotation, between[trial, pair], trial, pair)
                for t, p in zip(trial[keep].tolist(), self._others[pair[keep]].tolist(), strict=True):
                    found[t].append(p)
        return [sorted(pairs) for pairs in found]

    def _apart(self, rotation: Array, between: Array, trial: Index, pair: Index) -> NDArray[np.bool_]:
        """Tell whether a face of one of the two boxes separates them, shape (k,)."""
        axes = []
        for shape in (self._first[pair], self._second[pair]):
            turned = np.einsum("kij,kaj->kai", rotation[trial, self._link[shape]], self._axes[shape])
            fixed = self._fixed[shape]
            turned[fixed] = self._axes[shape[fixed]]
            axes.append(turned)
        one, other = self._first[pair], self._second[pair]
        cosine = np.abs(np.einsum("kai,kbi->kab", axes[0], axes[1]))
        rounded = (self._radius[one] + self._radius[other])[:, None] + _MARGIN
        gaps = (
            np.abs(np.einsum("kai,ki->ka", axes[0], between))
            - self._core[one]
            - np.einsum("kab,kb->ka", cosine, self._core[other])
            - rounded,
            np.abs(np.einsum("kbi,ki->kb", axes[1], between))
            - self._core[other]
            - np.einsum("kab,ka->kb", cosine, self._core[one])
            - rounded,
        )
        return (np.maximum(*gaps) > 0).any(axis=1)
