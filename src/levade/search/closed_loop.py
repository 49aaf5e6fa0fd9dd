"""The closed loop of a search: gains along its motions, and what each candidate senses on the nominal model.

    closed = ClosedLoop(task.feedback, task, engine, start)
    closed.feedback(weights, reference, seed=0)         # gains along a motion
    closed.sensed(reference)                            # (n, ticks, sensed): what perturbed models are held to

All of it follows from what is asked for; what is kept saves time only.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.engines import Engine, MujocoEngine, State, perturbed_models
from levade.engines.table import no_feedback
from levade.feedback import Feedback, SensorErrors, period_steps, sensed
from levade.tasks import Regulation, Task
from levade.trajectory import JointReference, Trajectories

_LEARNING, _SENSING = 1_279_610_446, 1_397_050_190
"""Keep what the gains are learned from, and the sensors' errors, apart from what else is drawn with the same seed."""

_KEPT = 1024
"""References of which is kept what was sensed."""


class ClosedLoop:
    """Makes the feedback of a task.

    Args:
        regulation: What the task asks for.
        task: The task, which has perturbed models.
        engine: Simulates it.
        start: Where it starts, one row.

    Raises:
        LevadeError: If the engine simulates no feedback.
    """

    def __init__(self, regulation: Regulation, task: Task, engine: Engine, start: State) -> None:
        if not isinstance(engine, MujocoEngine):
            raise no_feedback(engine.name)
        self._regulation, self._task, self._engine, self._start = regulation, task, engine, start
        self._period = period_steps(regulation.rate, task.physics.timestep)
        self._ticks = -(-(task.horizon_steps + task.hold_steps) // self._period)
        self._made: dict[tuple[int, bytes], Feedback] = {}
        self._sensed: dict[bytes, Array] = {}
        self._errors: dict[tuple[int, int], Array] = {}

    def feedback(self, along: Array, reference: JointReference, seed: int) -> Feedback:
        """The feedback with gains along a motion, holding the robot to that motion.

        Args:
            along: Weights of the motion, shape (d,).
            reference: What it asks of the joints, of one trial with the whole hold.
            seed: Seed of the search.
        """
        key = (seed, along.tobytes())
        if key not in self._made:
            from levade.regulators import Design, linearised  # of a task with feedback only

            robust, regulation, engine = self._task.robust, self._regulation, self._engine
            assert robust is not None
            joints = engine.embodiment.joints
            sample = robust.perturb.spread(engine.model, joints, n=regulation.runs, seed=(seed, _LEARNING))
            perturbed = perturbed_models(engine.model, engine.layout, sample, self._start)
            found = linearised(
                engine, self._start, reference, perturbed=perturbed, rate=regulation.rate, threads=engine.threads
            )
            design = Design(motion=regulation.motion, hold=regulation.hold, bound=regulation.bound)
            latest = dict(list(self._made.items())[-3:])
            self._made = {**latest, key: found.feedback(design)}
        return self._made[key]

    def sensed(self, reference: JointReference) -> Array:
        """What candidates sense on the nominal model, shape (n, ticks, sensed).

        Args:
            reference: What they ask of the joints, n rows.
        """
        keys = _keys(reference)
        missing = [i for i, key in enumerate(keys) if key not in self._sensed]
        if missing:
            wanted = np.array(missing)
            self.remember(self._engine.rollout(self._start, reference[wanted]))
        return np.stack([self._sensed[key] for key in keys])

    def remember(self, trajectories: Trajectories) -> None:
        """Keep what trials on the nominal model sensed."""
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
        """Errors of the sensors of each of a draw's models, shape (models, ticks, sensed)."""
        key = (seed, draw)
        if key not in self._errors:
            drawn = SensorErrors().draw(
                models, self._ticks, self._engine.embodiment.joints, seed=(seed, draw, _SENSING)
            )
            kept = {other: errors for other, errors in self._errors.items() if other[1] == 0}
            self._errors = {**kept, key: drawn}
        return self._errors[key]


def _keys(reference: JointReference) -> list[bytes]:
    """What identifies each trial: all that the engine is asked for."""
    return [row.tobytes() for row in reference.position]
