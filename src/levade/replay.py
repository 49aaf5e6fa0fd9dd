"""Replay: a motion from its file, in the engine of choice; the same references, another physics.

    replay = replay_in("ode", Motion.load("motion.npz"))
    replay.success, replay.errors["pitch"]
    replay.trajectories.trunk_position[0]               # (steps, 3) [m]

Nothing but the file is needed: the model, the state at the start and the references are in it. The replay begins in the
file's own state, wherever the engine itself would have the robot settle.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import errors, success
from levade.embodiment import Embodiment, JointLimits, LegGeometry
from levade.engines import FOOT_CONTACT_FORCE, Ode, engine_kind
from levade.motion import Motion
from levade.tasks import task_from_dict
from levade.trajectory import JointReference, Trajectories


@dataclass(frozen=True, eq=False)
class Replay:
    """What came of it. trajectories: of one trial, with foot forces. errors, success: by the criteria of its task."""

    engine: str
    trajectories: Trajectories
    errors: Mapping[str, float]
    success: bool


def replay_in(engine: str, motion: Motion, *, ode: Ode | None = None) -> Replay:
    """The motion's references, simulated from its start in an engine.

    engine: a name in `levade.engines.ENGINES`. ode: settings of the engine ode; those of the motion's task if None.
    In the engine that made the motion, with the same versions, it is the motion itself, to the bit.
    Raises LevadeError for an engine that is not there, or cannot simulate the motion's model.
    """
    kind = engine_kind(engine)
    task = task_from_dict(motion.meta["task"], where="the motion's task")
    reference = JointReference(
        motion["joint_position_reference"][None],
        motion["joint_velocity_reference"][None],
        float(motion.meta["timestep"]),
        motion.horizon_steps,
    )
    model = motion.compiled()
    physics = replace(task.physics, engine=engine, timestep=reference.timestep, ode=ode or task.physics.ode)
    simulated = kind.make(motion.model_xml, motion.assets, embodiment(motion, model), physics, threads=1)
    start = simulated.layout.state(motion["qpos0"], motion["qvel0"], motion["act0"])
    trajectories = simulated.rollout(start, reference, record=[FOOT_CONTACT_FORCE])
    off = errors(task.success, trajectories)
    return Replay(
        engine=engine,
        trajectories=trajectories,
        errors={name: float(error[0]) for name, error in off.items()},
        success=bool(success(task.success, trajectories)[0]),
    )


def embodiment(motion: Motion, model: mujoco.MjModel) -> Embodiment:
    """The motion's robot, by its file alone. model: the motion's own."""
    meta = motion.meta
    joint_names = tuple(str(name) for name in motion["joint_names"])
    stall_torque, no_load_speed = _lines(model, joint_names)
    return Embodiment(
        trunk=str(meta["trunk"]),
        joint_names=joint_names,
        feet=tuple(str(leg["foot"]) for leg in meta["legs"].values()),
        trunk_com_offset=np.array(meta["trunk_com_offset"], dtype=float),
        legs=tuple(
            LegGeometry(
                name=name,
                side=leg["side"],
                end=leg["end"],
                joints=tuple(joint_names.index(joint) for joint in leg["joints"]),
                anchors=np.array(leg["geometry"]["anchors"], dtype=float),
                axes=np.array(leg["geometry"]["axes"], dtype=float),
                foot=np.array(leg["geometry"]["foot"], dtype=float),
                sole=float(leg["geometry"]["sole"]),
            )
            for name, leg in meta["legs"].items()
            if "geometry" in leg
        ),
        limits=JointLimits(
            lower=_limit(meta["limits"]["lower"], -np.inf),
            upper=_limit(meta["limits"]["upper"], np.inf),
            velocity=_limit(meta["limits"]["velocity"], np.inf),
            torque=_limit(meta["limits"]["torque"], np.inf),
            stall_torque=stall_torque,
            no_load_speed=no_load_speed,
        ),
    )


def _lines(model: mujoco.MjModel, joint_names: tuple[str, ...]) -> tuple[Array, Array] | tuple[None, None]:
    """Stall torque [Nm] and no-load speed [rad/s], (joints,) each, of the actuators in the model; infinite for those
    that have none, None if no one has.
    """
    lines = np.full((2, len(joint_names)), np.inf)
    for i, name in enumerate(joint_names):
        actuator = model.actuator(name).id
        if model.actuator_gaintype[actuator] == mujoco.mjtGain.mjGAIN_DCMOTOR:
            resistance, constant, voltage = (float(model.actuator_gainprm[actuator, k]) for k in (0, 1, 7))
            if resistance > 0 and constant > 0 and voltage > 0:
                lines[:, i] = voltage * constant / resistance, voltage / constant
    return (lines[0], lines[1]) if np.isfinite(lines).any() else (None, None)


def _limit(values: Sequence[float | None], none: float) -> Array:
    return np.array([none if value is None else value for value in values], dtype=float)
