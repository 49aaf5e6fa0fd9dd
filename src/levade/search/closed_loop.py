"""Closed loop of a search: gains along its motions, and what each candidate senses on the nominal model.

    closed = ClosedLoop(task.feedback, task, engine, start)
    closed.feedback(Gains(weights), reference, seed=0)  # gains along a motion
    closed.sensed(reference)                            # (n, ticks, sensed): the reference for perturbed models

Everything follows from the arguments. The caches only save time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from levade.arrays import Array
from levade.engines import Engine, MujocoEngine, State, perturbed_models
from levade.engines.table import no_feedback
from levade.feedback import Feedback, period_steps, sensed
from levade.search.evaluation import Gains
from levade.tasks import Regulation, Task
from levade.trajectory import JointReference, Trajectories

if TYPE_CHECKING:
    from levade.regulators import Along

_LEARNING, _SENSING = 1_279_610_446, 1_397_050_190
"""Separate the random numbers for learning gains, and for sensor errors, from others drawn with the same seed."""

_KEPT = 1024
"""Number of references whose sensed values are cached."""

_MADE = 7
"""Number of earlier gains that are cached."""


class ClosedLoop:
    """Makes the feedback of a task.

    Args:
        regulation: The feedback that the task asks for.
        task: The task, which needs perturbed models.
        engine: The engine that simulates it.
        start: The state where roll-outs start, one row.

    Raises:
        LevadeError: If the engine cannot simulate feedback.
    """

    def __init__(self, regulation: Regulation, task: Task, engine: Engine, start: State) -> None:
        if not isinstance(engine, MujocoEngine):
            raise no_feedback(engine.name)
        self._regulation, self._task, self._engine, self._start = regulation, task, engine, start
        self._period = period_steps(regulation.rate, task.physics.timestep)
        self._ticks = -(-(task.horizon_steps + task.hold_steps) // self._period)
        self._linear: dict[tuple[int, bytes], Along] = {}  # the latest: all its designs are made in succession
        self._made: dict[tuple[int, bytes, int], Feedback] = {}
        self._sensed: dict[bytes, Array] = {}
        self._errors: dict[tuple[int, int], Array] = {}

    def feedback(self, gains: Gains, reference: JointReference, seed: int) -> Feedback:
        """Make feedback with gains along a motion, which keeps the robot close to that motion.

        Args:
            gains: The motion, and which design to use.
            reference: Joint reference of the motion: one trial with the whole hold.
            seed: Seed of the search.
        """
        key = (seed, gains.along.tobytes(), gains.design)
        if key not in self._made:
            from levade.regulators import Design  # only tasks with feedback need it

            chosen = self._regulation.designs[gains.design]
            design = Design(motion=chosen.motion, hold=chosen.hold, bound=chosen.bound)
            made = self._linearised(gains.along, reference, seed).feedback(design)
            self._made = {**dict(list(self._made.items())[-_MADE:]), key: made}
        return self._made[key]

    def _linearised(self, along: Array, reference: JointReference, seed: int) -> Along:
        key = (seed, along.tobytes())
        if key not in self._linear:
            from levade.regulators import linearised

            robust, regulation, engine = self._task.robust, self._regulation, self._engine
            assert robust is not None
            joints = engine.embodiment.joints
            sample = robust.perturb.spread(engine.model, joints, n=regulation.runs, seed=(seed, _LEARNING))
            perturbed = perturbed_models(engine.model, engine.layout, sample, self._start)
            found = linearised(
                engine,
                self._start,
                reference,
                perturbed=perturbed,
                rate=regulation.rate,
                errors=regulation.sensors,
                threads=engine.threads,
            )
            self._linear = {key: found}
        return self._linear[key]

    def sensed(self, reference: JointReference) -> Array:
        """Return what candidates sense on the nominal model, shape (n, ticks, sensed).

        Args:
            reference: Joint references of the candidates, n rows.
        """
        keys = _keys(reference)
        missing = [i for i, key in enumerate(keys) if key not in self._sensed]
        if missing:
            wanted = np.array(missing)
            self.remember(self._engine.rollout(self._start, reference[wanted]))
        return np.stack([self._sensed[key] for key in keys])

    def remember(self, trajectories: Trajectories) -> None:
        """Cache what trials on the nominal model sensed.

        Args:
            trajectories: The trials, n rows.
        """
        rows = slice(self._period - 1, trajectories.steps - 1, self._period)
        later = sensed(
            trajectories.trunk_quaternion[:, rows],
            trajectories.trunk_angular_velocity[:, rows],
            trajectories.joint_position[:, rows],
            trajectories.joint_velocity[:, rows],
        )
        first = self._engine.layout.sensed(self._start.qpos, self._start.qvel)
        whole = np.concatenate([np.broadcast_to(first[:, None], (trajectories.n, 1, first.shape[1])), later], axis=1)
        self._sensed.update(zip(_keys(trajectories.reference), whole, strict=True))
        if len(self._sensed) > _KEPT:
            self._sensed = dict(list(self._sensed.items())[-max(_KEPT // 2, trajectories.n) :])

    def sensor_errors(self, seed: int, draw: int, models: int) -> Array:
        """Draw the sensor errors of each perturbed model, shape (models, ticks, sensed).

        Args:
            seed: Seed of the search.
            draw: Number of the draw of perturbed models.
            models: Number of models in the draw.
        """
        key = (seed, draw)
        if key not in self._errors:
            joints = self._engine.embodiment.joints
            drawn = self._regulation.sensors.draw(models, self._ticks, joints, seed=(seed, draw, _SENSING))
            kept = {other: errors for other, errors in self._errors.items() if other[1] == 0}
            self._errors = {**kept, key: drawn}
        return self._errors[key]


def _keys(reference: JointReference) -> list[bytes]:
    """Return a key for each trial: the bytes of its reference."""
    return [row.tobytes() for row in reference.position]
