"""Fold a robot up after a fall. It then lies in one of a few ways, always with the same joint angles.

posture = fold_posture(robot, Fold("tucked"))
lying = folded(engine, fallen, posture, Fold("tucked"))
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.engines.engine import Engine
from levade.engines.mujoco import MujocoEngine
from levade.engines.start import Fold
from levade.engines.state import State
from levade.errors import LevadeError, did_you_mean, located
from levade.robots import Robot
from levade.robots.tucking import tucked
from levade.trajectory import JointReference


def fold_posture(robot: Robot, fold: Fold) -> Array:
    """Return the folded posture of a robot.

    Args:
        robot: The robot.
        fold: How to fold it up. Only its posture matters here.

    Returns:
        Joint angles [rad], shape (joints,).

    Raises:
        LevadeError: If the robot has no such posture.
    """
    with located("start.fallen.fold.posture: "):
        if fold.posture == "tucked" and "tucked" not in robot.postures:
            return tucked(robot)
        if isinstance(fold.posture, str) and fold.posture not in robot.postures:
            names = {"tucked", *robot.postures}
            raise LevadeError(f"robot {robot.name}: no posture {fold.posture!r}; {did_you_mean(fold.posture, names)}")
        return robot.posture(fold.posture)


def folded(engine: Engine, state: State, posture: Array, fold: Fold) -> State:
    """Simulate how robots fold up: their joints move smoothly to a posture, and rest there.

    Args:
        engine: The engine.
        state: How the robots lie.
        posture: The posture [rad], shape (joints,).
        fold: Durations.

    Returns:
        How they lie afterwards, as many rows.

    Raises:
        LevadeError: If the engine cannot simulate this, or the simulation breaks down.
    """
    if not isinstance(engine, MujocoEngine):
        raise LevadeError(f"start.fallen.fold: engine {engine.name} simulates no folding; use the engine mujoco")
    timestep, before = engine.physics.timestep, state.joint_reference
    ramp, rest = max(1, round(fold.time / timestep)), round(fold.rest / timestep)
    s = np.minimum(np.arange(1, ramp + rest + 1) / ramp, 1.0)[:, None]
    way = (posture - before)[:, None]
    position = before[:, None] + s**2 * (3.0 - 2.0 * s) * way
    velocity = 6.0 * s * (1.0 - s) / (ramp * timestep) * way
    reference = JointReference(position, velocity, timestep, ramp, before=before)
    out, diverged = engine.states(state, reference, ["qpos", "qvel", "act"])
    if diverged.any():
        raise LevadeError("start.fallen.fold: the simulation breaks down; give it more time, or another posture")
    qpos, qvel, act = (out[name][:, -1] for name in ("qpos", "qvel", "act"))
    return engine.layout.state(qpos, qvel, act, joint_reference=np.broadcast_to(posture, before.shape))
