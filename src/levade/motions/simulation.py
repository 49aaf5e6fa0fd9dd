"""Simulate a recorded motion from its file: as recorded, on perturbed models, and in other engines.

simulation = RecordedSimulation(Motion.load("motion.npz"))
sample = Perturbation().draw(simulation.model, simulation.joints, n=64, seed=0)
trajectories = simulation.rollout(sample)                    # on 64 perturbed models
replay_in("ode", motion).errors["pitch"]                     # the same references, other physics
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import Criterion, clearance_of, errors, success
from levade.embodiment import Embodiment
from levade.engines import (
    FOOT_CONTACT_FORCE,
    SELF_DISTANCE,
    Engine,
    Layout,
    Models,
    MujocoEngine,
    Ode,
    Perturbation,
    Sample,
    State,
    engine_kind,
    perturbed_models,
)
from levade.engines.clearance import clearance_in, with_clearance
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.motions.motion import Motion
from levade.motions.reference import ReferenceCurve
from levade.tasks import Task
from levade.trajectory import JointReference, Trajectories


class RecordedSimulation:
    """Simulates a motion, in MuJoCo unless another engine is given, independent of the engine that made it.

    Args:
        motion: The motion.
        criteria: Success criteria. Defaults to those of the motion's task.
        threads: Number of threads (0: one per core). Results do not depend on it.
        engine: Engine with the motion's model, or a version of it whose time step is a whole fraction of the motion's. Defaults
            to MuJoCo with its own model.

    Attributes:
        model: MuJoCo's model.
        layout: Addresses of the robot in the model.

    Raises:
        LevadeError: If the file's model or task is damaged.
    """

    def __init__(
        self,
        motion: Motion,
        *,
        criteria: Mapping[str, Criterion] | None = None,
        threads: int = 0,
        engine: Engine | None = None,
    ) -> None:
        self.motion, self.threads = motion, threads
        self.task: Task = motion.task
        self.criteria = dict(self.task.success if criteria is None else criteria)
        self.embodiment: Embodiment = motion.embodiment
        self.timestep = motion.timestep
        self.engine = _mujoco(motion, threads, self._clearance) if engine is None else engine
        self.model, self.layout = self.engine.model, self.engine.layout

    @property
    def _clearance(self) -> float | None:
        """Distance up to which the criteria measure between the robot's parts [m]. None if no criterion does."""
        return clearance_of(self.criteria.values())

    @property
    def joints(self) -> int:
        """Number of joints."""
        return self.embodiment.joints

    @cached_property
    def start(self) -> State:
        """The start of the motion, one row."""
        return _start(self.motion, self.layout)

    @cached_property
    def curve(self) -> ReferenceCurve:
        """The motion's reference as a function of time."""
        return ReferenceCurve.of(self.motion)

    @cached_property
    def reference(self) -> JointReference:
        """The joint references of one trial, at the time steps of `model`."""
        parts = round(self.timestep / self.model.opt.timestep)
        return self.curve.divided(parts) if parts > 1 else self.motion.reference

    def model_copy(self) -> mujoco.MjModel:
        """Copy the model, to change it and give it to `with_model`."""
        return copy.deepcopy(self.model)

    def with_model(self, model: mujoco.MjModel) -> RecordedSimulation:
        """Return the same motion with another version of its model. A shorter time step gives a finer reference.

        Args:
            model: The version.

        Returns:
            A simulation.

        Raises:
            LevadeError: If another engine than MuJoCo simulates it, which takes no changed model.
        """
        if not isinstance(self.engine, MujocoEngine):
            raise LevadeError(f"simulation: the engine {self.engine.name} takes no changed model; only mujoco does")
        engine = self.engine.with_model(model)
        other = RecordedSimulation(self.motion, criteria=self.criteria, threads=self.threads, engine=engine)
        if "curve" in vars(self):  # found once
            vars(other)["curve"] = self.curve
        return other

    def divided(self, parts: int) -> RecordedSimulation:
        """Return the same motion at time steps that are shorter by a whole factor.

        Args:
            parts: Number of steps in one step of the model, at least 1. With 1 this simulation is returned.

        Returns:
            A simulation.

        Raises:
            LevadeError: If another engine than MuJoCo simulates it, which takes no changed model.
        """
        if parts == 1:
            return self
        model = self.model_copy()
        model.opt.timestep /= parts
        return self.with_model(model)

    def rollout(
        self,
        sample: Sample | None = None,
        *,
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
        record: Sequence[str] = (),
    ) -> Trajectories:
        """Simulate the motion.

        Args:
            sample: Perturbed models, one run on each. Defaults to one run of the nominal model.
            feedback: Corrects the reference in every run.
            sensor_errors: Errors that are added to the sensed values, shape (n, ticks, sensed).
            record: What to record besides the quantities of the criteria: see `levade.engines.Engine.rollout`.

        Returns:
            The trajectories.
        """
        starts, models = self._models(self.nominal if sample is None else sample)
        record = (*record, *(() if self._clearance is None else (SELF_DISTANCE,)))
        return self.engine.rollout(
            starts, self.reference, models=models, feedback=feedback, sensor_errors=sensor_errors, record=record
        )

    def states(self, sample: Sample, fields: Sequence[str]) -> dict[str, Array]:
        """Simulate the motion on perturbed models, and record arrays of `mujoco.MjData`.

        Args:
            sample: Perturbed models.
            fields: Names of the arrays.

        Returns:
            Name -> array, shape (n, steps, ...).

        Raises:
            LevadeError: If another engine than MuJoCo simulates it, which has no such arrays.
        """
        if not isinstance(self.engine, MujocoEngine):
            raise LevadeError(f"simulation: the engine {self.engine.name} has no arrays of MuJoCo's; only mujoco has")
        starts, models = self._models(sample)
        return self.engine.states(starts, self.reference, fields, models=models)[0]

    def starts(self, sample: Sample) -> State:
        """Return the starts of the runs on perturbed models.

        Args:
            sample: The perturbed models.

        Returns:
            The starts, one row for each run.
        """
        return self._models(sample)[0]

    @property
    def nominal(self) -> Sample:
        """Return a sample of one model, the nominal one."""
        return Perturbation().nominal(self.model, self.joints)

    def _models(self, sample: Sample) -> tuple[State, Models]:
        return perturbed_models(self.model, self.layout, sample, self.start)


def _mujoco(motion: Motion, threads: int, clearance: float | None) -> MujocoEngine:
    physics = replace(motion.task.physics, engine="mujoco", timestep=motion.timestep)
    model = _measuring(motion, clearance)
    return MujocoEngine(motion.model_xml, motion.assets, motion.embodiment, physics, threads=threads, model=model)


def _measuring(motion: Motion, clearance: float | None) -> mujoco.MjModel:
    """Return the motion's model, measuring distances at least up to a clearance [m], unless that is None."""
    model = motion.compiled()
    measured = clearance_in(model)
    if clearance is None or (measured is not None and measured >= clearance):
        return model
    return with_clearance(motion.model_xml, motion.assets, motion.embodiment.trunk, clearance)


def _start(motion: Motion, layout: Layout) -> State:
    commanded = motion.arrays.get("joint_position_reference0")
    return layout.state(motion["qpos0"], motion["qvel0"], motion["act0"], joint_reference=commanded)


@dataclass(frozen=True, eq=False)
class Replay:
    """Reports a replay.

    Attributes:
        engine: Name of the engine.
        trajectories: Trajectories of one trial, with foot forces.
        errors: Criterion -> error [SI].
        success: Whether all criteria are met.
    """

    engine: str
    trajectories: Trajectories
    errors: Mapping[str, float]
    success: bool


def replay_in(
    engine: str, motion: Motion, *, ode: Ode | None = None, criteria: Mapping[str, Criterion] | None = None
) -> Replay:
    """Simulate a motion's references from its start in an engine.

    The replay begins in the file's own state, not in one that the engine settles. In the engine that made the motion, with the
    same versions, it is the motion itself, to the bit.

    Args:
        engine: A name in `levade.engines.ENGINES`.
        motion: The motion.
        ode: Settings of the engine ode. Defaults to those of the motion's task.
        criteria: Success criteria. Defaults to those of the motion's task.

    Returns:
        The replay.

    Raises:
        LevadeError: If the engine is missing, or cannot simulate the motion's model.
    """
    kind = engine_kind(engine)
    criteria = motion.task.success if criteria is None else criteria
    clearance = clearance_of(criteria.values())
    model = _measuring(motion, clearance)  # what is wrong with the model is told as of a motion
    physics = motion.task.physics
    physics = replace(physics, engine=engine, timestep=motion.timestep, ode=ode or physics.ode)
    simulated = kind.make(motion.model_xml, motion.assets, motion.embodiment, physics, threads=1, model=model)
    start = _start(motion, simulated.layout)
    record = (FOOT_CONTACT_FORCE,) if clearance is None else (FOOT_CONTACT_FORCE, SELF_DISTANCE)
    trajectories = simulated.rollout(start, motion.reference, record=record)
    off = errors(criteria, trajectories)
    return Replay(
        engine=engine,
        trajectories=trajectories,
        errors={name: float(error[0]) for name, error in off.items()},
        success=bool(success(criteria, trajectories)[0]),
    )


def configurations(motion: Motion, model: mujoco.MjModel) -> Array:
    """Return the robot's recorded poses: the start, and the end of each step.

    Args:
        motion: The motion.
        model: Its compiled model.

    Returns:
        Positions of the model, shape (steps + 1, nq). Rows that are not finite repeat the last sound one.
    """
    at = motion.addresses(model)
    qpos = np.tile(motion["qpos0"], (motion.steps + 1, 1))
    qpos[1:, at.trunk_position] = motion["trunk_position"]
    qpos[1:, at.trunk_quaternion] = motion["trunk_quaternion"]
    qpos[1:, at.joint_qpos] = motion["joint_position"]
    sound = np.isfinite(qpos).all(axis=1)  # a trial that diverged stays where it last was
    return qpos[np.maximum.accumulate(np.where(sound, np.arange(len(qpos)), 0))]
