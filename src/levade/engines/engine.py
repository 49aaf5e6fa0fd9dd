"""The interface of every engine: a model, a robot in it, and one roll-out. No engine's own code is here.

    engine = make_engine(robot, Scene(), Physics())                 # see `levade.engines.placing`
    engine = ENGINES["mujoco"].make(motion.model_xml, motion.assets, embodiment, physics)
    trajectories = engine.rollout(starts, reference, record=[FOOT_CONTACT_FORCE])

The model is always compiled from `Engine.xml`, the text in a motion file. So a replay from the file simulates the same model to
the last bit.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.embodiment import Embodiment
from levade.engines.clearance import SELF_DISTANCE, distances_at
from levade.engines.layout import FOOT_CONTACT_FORCE, SELF_FORCE, Layout
from levade.engines.models import CONE_FIELD, FIELDS, Models, delayed
from levade.engines.physics import Physics
from levade.engines.state import State
from levade.engines.table import ENGINES, no_feedback
from levade.errors import LevadeError, did_you_mean
from levade.feedback import Correcting, Feedback
from levade.trajectory import JointReference, Trajectories


@dataclass(frozen=True, eq=False)
class Trials:
    """Holds n trials that an engine simulates.

    Attributes:
        n: Number of trials.
        starts: Their starts, 1 or n rows.
        reference: Their references, n rows.
        commanded: What the servos receive without feedback, 1 or n rows.
        models: Versions of the model, 1 or n rows. None for the nominal model.
        correcting: Feedback on them. None for none.
        ends: Number of rows that each trial needs, shape (n,), the longest first. None if all need every row.
    """

    n: int
    starts: State
    reference: JointReference
    commanded: JointReference
    models: Models | None
    correcting: Correcting | None
    ends: NDArray[np.intp] | None = None


class Engine(ABC):
    """Simulates joint references of one robot in one scene. Use it from one Python thread at a time.

    An engine adds `_prepare`, `_simulate`, `hold` and `versions`, and a row in `levade.engines.table.ENGINES`.

    Attributes:
        name: The engine's name in the table.
        xml: MJCF text of robot, scene, actuators and contact sensors.
        assets: File name in ``xml`` -> content.
        embodiment: The robot.
        physics: Numerical settings.
        threads: Number of threads or processes (0: one per core). Results do not depend on it.
        model: MuJoCo's model of ``xml``. Every engine simulates what it describes.
        layout: Addresses of the robot in the model.
        steps: Physics steps of all roll-outs so far, over all trials. A trial that breaks down counts in full.
    """

    name: ClassVar[str]
    stops: ClassVar[bool] = False
    """Whether each trial ends at its own horizon and hold."""
    feels: ClassVar[bool] = False
    """Whether it measures the forces of the robot's parts on each other."""

    def __init__(
        self,
        xml: str,
        assets: Mapping[str, bytes],
        embodiment: Embodiment,
        physics: Physics,
        *,
        threads: int = 0,
        model: mujoco.MjModel | None = None,
    ) -> None:
        """Make an engine.

        Args:
            xml: MJCF text.
            assets: File name in ``xml`` -> content.
            embodiment: The robot.
            physics: Numerical settings. ``xml`` already has those of MuJoCo.
            threads: Number of threads or processes (0: one per core).
            model: The compiled model. None compiles ``xml``.

        Raises:
            LevadeError: If a library is missing, or the engine cannot simulate the model.
        """
        self.xml, self.assets, self.embodiment = xml, dict(assets), embodiment
        self.physics, self.threads = physics, threads
        self.steps = 0
        self.model = mujoco.MjModel.from_xml_string(xml, self.assets) if model is None else model
        self.layout = Layout.of_model(self.model, embodiment)
        self._ctrl: Array | None = None
        self._prepare()

    @abstractmethod
    def _prepare(self) -> None:
        """Make what the engine needs in addition. Called once, at the end of ``__init__``, with the same errors."""

    @classmethod
    @abstractmethod
    def versions(cls) -> dict[str, str]:
        """Versions of the libraries that decide the bits of a simulation.

        Raises:
            LevadeError: If a library is missing.
        """

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """Names of the robot's bodies, whose contact forces with the scene can be recorded."""
        return tuple(self.model.body(i).name for i in range(1, self.model.nbody))

    def rollout(
        self,
        starts: State,
        reference: JointReference,
        *,
        models: Models | None = None,
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
        record: Sequence[str] = (),
    ) -> Trajectories:
        """Simulate n trials. ``starts``, ``reference`` and ``models`` have n rows each, or one row for all trials.

        A trial has the same bits alone and in any batch. Trials of different horizons each run to their own end.

        Args:
            starts: Starts of the trials.
            reference: References that they follow.
            models: Versions of the model. None for the nominal model. A version without differences agrees with the nominal
                model to rounding, not to the bit.
            feedback: Stabiliser that corrects the reference by each trial's sensor readings.
            sensor_errors: Errors that are added to the sensor readings, shape (n, ticks, sensed): see
                `levade.feedback.SensorErrors`.
            record: What to record in addition: `FOOT_CONTACT_FORCE`, `levade.engines.SELF_FORCE`,
                `levade.engines.SELF_DISTANCE`, and names of `bodies` for their contact force with the scene.

        Returns:
            The trajectories. Trials whose simulation breaks down are marked in ``diverged``; their later rows repeat the last
            sound one.

        Raises:
            LevadeError: If the rows do not fit together, a name in ``record`` is unknown or cannot be measured, or the engine
                has no feedback.
        """
        for name in record:
            if name == SELF_DISTANCE and self.layout.clearance is None:
                raise LevadeError(
                    "record: the model measures no distances between the robot's parts; make it with a clearance"
                )
            if name == SELF_FORCE and not self.feels:
                raise LevadeError(
                    f"record: the engine {self.name} measures no forces between the robot's parts; use mujoco"
                )
            if name == SELF_FORCE and self.layout.force_sensor is None:
                raise LevadeError(
                    "record: the model measures no forces between the robot's parts; make it with self_force"
                )
            if name not in (FOOT_CONTACT_FORCE, SELF_FORCE, SELF_DISTANCE, *self.bodies):
                hint = did_you_mean(name, (FOOT_CONTACT_FORCE, SELF_FORCE, SELF_DISTANCE, *self.bodies))
                raise LevadeError(f"record: no body {name!r} in the model; {hint}")
        ends = reference.ends
        if ends is None:
            done = self._simulate(self._trials(starts, reference, models, feedback, sensor_errors), record)
            return self._with_distances(done, record)
        order = np.argsort(-ends, kind="stable")
        starts = starts if len(starts) == 1 else starts[order]
        models = models if models is None or len(models) == 1 else models[order]
        errors = None if sensor_errors is None else sensor_errors[order]
        done = self._simulate(self._trials(starts, reference[order], models, feedback, errors), record)
        return self._with_distances(done, record).aligned(np.argsort(order))

    def _with_distances(self, done: Trajectories, record: Sequence[str]) -> Trajectories:
        """Add the distances between the robot's parts, if they are recorded and the engine has not measured them itself."""
        if SELF_DISTANCE not in record or done.self_distance is not None:
            return done
        qpos = np.tile(self.model.qpos0, (done.n, done.steps, 1))
        qpos[..., self.layout.trunk_position] = done.trunk_position
        qpos[..., self.layout.trunk_quaternion] = done.trunk_quaternion
        qpos[..., self.layout.joint_qpos] = done.joint_position
        return replace(done, self_distance=np.stack([distances_at(self.model, one) for one in qpos]))

    @abstractmethod
    def _simulate(self, trials: Trials, record: Sequence[str]) -> Trajectories:
        """Simulate; see `rollout`."""

    @abstractmethod
    def hold(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        """Let a robot go while its joints hold a posture.

        Args:
            model: `model`, or the same with other gains.
            data: State in which the robot is let go; it may be changed.
            posture: Joint angles to hold [rad], shape (joints,).
            time: Duration [s].

        Returns:
            The state at the end, one row.

        Raises:
            LevadeError: If the simulation breaks down.
        """

    def ctrl(self, reference: JointReference, n: int | None = None) -> Array:
        """Compute the commands to the actuators: position and velocity of each joint.

        Args:
            reference: Reference of one trial or of n.
            n: Number of trials. Defaults to the rows of ``reference``.

        Returns:
            Controls of the model, shape (n, steps, nu). The next call reuses the memory if the shape is the same.
        """
        shape = (len(reference.position) if n is None else n, reference.steps, self.model.nu)
        if self._ctrl is None or self._ctrl.shape != shape:
            self._ctrl = np.zeros(shape)
        self._ctrl[..., self.layout.ctrl_position] = reference.position
        self._ctrl[..., self.layout.ctrl_velocity] = reference.velocity
        return self._ctrl

    def _trials(
        self,
        starts: State,
        reference: JointReference,
        models: Models | None,
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
    ) -> Trials:
        """Assemble a roll-out. Every simulation of trials passes here, and only here are steps counted."""
        rows = {"starts": len(starts), "reference": len(reference.position)}
        if models is not None:
            rows["models"] = len(models)
            for name in models.fields:
                if name != CONE_FIELD and not hasattr(self.model, name):
                    raise LevadeError(f"models: no field {name!r} in mujoco.MjModel; {did_you_mean(name, FIELDS)}")
        n = max(rows.values())
        if not set(rows.values()) <= {1, n}:
            each = ", ".join(f"{name} {count}" for name, count in rows.items())
            raise LevadeError(f"rollout: rows do not fit together ({each}); each should have 1 or the same number")
        delay = np.zeros(n) if models is None else np.broadcast_to(models.delay, n)
        correcting = None
        if feedback is not None:
            if not ENGINES[self.name].feedback:
                raise no_feedback(self.name)
            correcting = Correcting(
                feedback,
                steps=reference.steps,
                timestep=reference.timestep,
                delay=delay,
                lower=self.embodiment.limits.lower,
                upper=self.embodiment.limits.upper,
                errors=sensor_errors,
            )
        ends = reference.ends if self.stops and correcting is None else None
        self.steps += n * reference.steps if ends is None else int(ends.sum())
        return Trials(n, starts, reference.repeated(n), delayed(reference, delay), models, correcting, ends)


def broke_down(time: float) -> LevadeError:
    """Return the error for a robot whose simulation breaks down while it settles for a time [s].

    Args:
        time: Duration of the settling [s].

    Returns:
        The error, to be raised.
    """
    return LevadeError(
        f"start: the simulation broke down within {time} s; a smaller physics.timestep or lower gains may help"
    )
