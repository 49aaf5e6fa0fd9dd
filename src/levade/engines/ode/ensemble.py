"""Versions of one model in ODE: the same versions that MuJoCo simulates, each in worlds of its own.

ODE's worlds are made from a compiled model, so a version is that model with its fields changed, and worlds made from it.
Versions that come again, such as those that candidates are compared on, are kept.
"""

from __future__ import annotations

import copy
from collections import OrderedDict
from collections.abc import Sequence
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.engines.ensemble import Ensemble, Variations, delayed, repeated
from levade.engines.layout import Layout
from levade.engines.ode.engine import OdeStage
from levade.engines.ode.simulation import Record, Simulation
from levade.engines.ode.skeleton import skeleton
from levade.engines.physics import Physics
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.trajectory import JointReference, Trajectories

_KEPT = 64
"""Versions whose worlds are kept."""


class OdeEnsemble(Ensemble):
    """Simulates versions of a model in ODE, one after another, in this process; else as `Ensemble`."""

    def __init__(self, stage: OdeStage, physics: Physics, layout: Layout, **about: Any) -> None:
        super().__init__(stage.model, layout, **about)
        self._stage, self._physics = stage, physics
        self._kept: OrderedDict[bytes, Simulation] = OrderedDict()

    def rollout(
        self,
        variations: Variations,
        reference: JointReference,
        *,
        feet: bool = False,
        bodies: Sequence[str] = (),
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
    ) -> Trajectories:
        """As `Ensemble.rollout`. Raises LevadeError if there is feedback, which has to be between steps."""
        if feedback is not None or sensor_errors is not None:
            raise LevadeError("feedback: the engine ode has no place for it yet; use the engine mujoco")
        n = len(variations)
        told = repeated(delayed(reference, variations.delay), n)
        same: dict[bytes, list[int]] = {}
        for run in range(n):
            same.setdefault(_key(variations, run), []).append(run)
        parts, order = [], []
        for key, runs in same.items():
            start = tuple(part[runs[0]] for part in (variations.qpos, variations.qvel, variations.act))
            asked = self._stage.asked(told.position[runs], told.velocity[runs], feet=feet, bodies=bodies)
            parts.append(self._simulation(key, variations, runs[0]).run(*start, **asked))
            order += runs
        record = Record(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in vars(parts[0])})
        back = np.argsort(order)
        record = Record(**{name: values[back] for name, values in vars(record).items()})
        return self._stage.trajectories(record, repeated(reference, n), feet=feet, bodies=bodies)

    def _simulation(self, key: bytes, variations: Variations, run: int) -> Simulation:
        """The worlds of a version."""
        if key not in self._kept:
            model = copy.deepcopy(self.model)
            for name, values in variations.fields.items():
                getattr(model, name)[:] = values[run]
            self._kept[key] = Simulation(skeleton(model), self._physics.ode, self._physics.timestep)
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        return self._kept[key]


def _key(variations: Variations, run: int) -> bytes:
    """Of a version and its start."""
    state = (variations.qpos[run], variations.qvel[run], variations.act[run])
    return b"".join(part.tobytes() for part in (*state, *(values[run] for values in variations.fields.values())))
