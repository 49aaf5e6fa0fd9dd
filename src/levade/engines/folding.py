"""Fold a robot up after a fall. It then lies in one of a few ways, always with the same joint angles.

folding = Folding.of(robot, Fold("tucked"))
lying = folding.folded(engine, fallen)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.engines.engine import Engine
from levade.engines.models import Models
from levade.engines.mujoco import MujocoEngine
from levade.engines.start import Fold
from levade.engines.state import State
from levade.errors import LevadeError, did_you_mean, located
from levade.robots import Robot
from levade.robots.tucking import tucked
from levade.trajectory import JointReference

_FREEING = "stretched"
"""Posture between two folds. It frees legs on which the robot lies: after random falls of HyQ2Max, all of 13 jammed robots then
folded up. After neutral, crouched or nothing in between, 11, 3 and 1 of them did."""


@dataclass(frozen=True, eq=False)
class Folding:
    """How a robot folds up.

    Attributes:
        fold: Durations, and how far joints may be off.
        posture: The folded posture [rad], shape (joints,).
        freeing: The posture that it takes before it folds up once more, if a leg is jammed [rad], shape (joints,). None if it
            folds up only once.
    """

    fold: Fold
    posture: Array
    freeing: Array | None

    @classmethod
    def of(cls, robot: Robot, fold: Fold) -> Folding:
        """Find the postures of a robot.

        Args:
            robot: The robot.
            fold: How to fold it up.

        Raises:
            LevadeError: If the robot has no such posture.
        """
        frees = fold.jammed is not None and _FREEING in robot.postures
        return cls(fold, _posture(robot, fold), robot.posture(_FREEING) if frees else None)

    def folded(self, engine: Engine, state: State, models: Models | None = None) -> State:
        """Simulate how robots fold up: their joints move smoothly to the posture, and rest there.

        If a joint of a robot is farther from the posture then than `Fold.jammed`, this robot takes the freeing posture and
        folds up once more.

        Args:
            engine: The engine.
            state: How the robots lie.
            models: Perturbed models, as many rows. None for the nominal one.

        Returns:
            How they lie afterwards, as many rows.

        Raises:
            LevadeError: If the engine cannot simulate this, or the simulation breaks down.
        """
        lying = self._moved(engine, state, self.posture, self.fold.rest, models)
        if self.freeing is None or self.fold.jammed is None:
            return lying
        jammed = np.abs(lying.joint_position - self.posture).max(axis=1) > self.fold.jammed
        if not jammed.any():
            return lying
        own = None if models is None else models[jammed]
        stretched = self._moved(engine, lying[jammed], self.freeing, 0.0, own)
        again = self._moved(engine, stretched, self.posture, self.fold.rest, own)
        row = np.where(jammed, np.cumsum(jammed) - 1 + len(lying), np.arange(len(lying)))
        return State.stacked([lying, again])[row]

    def _moved(self, engine: Engine, state: State, posture: Array, rest: float, models: Models | None) -> State:
        """Simulate a smooth move to a posture, and a rest there [s]."""
        if not isinstance(engine, MujocoEngine):
            raise LevadeError(f"start.fallen.fold: engine {engine.name} simulates no folding; use the engine mujoco")
        timestep, before = engine.physics.timestep, state.joint_reference
        ramp, still = max(1, round(self.fold.time / timestep)), round(rest / timestep)
        s = np.minimum(np.arange(1, ramp + still + 1) / ramp, 1.0)[:, None]
        way = (posture - before)[:, None]
        position = before[:, None] + s**2 * (3.0 - 2.0 * s) * way
        velocity = 6.0 * s * (1.0 - s) / (ramp * timestep) * way
        reference = JointReference(position, velocity, timestep, ramp, before=before)
        out, diverged = engine.states(state, reference, ["qpos", "qvel", "act"], models=models)
        if diverged.any():
            raise LevadeError("start.fallen.fold: the simulation breaks down; give it more time, or another posture")
        qpos, qvel, act = (out[name][:, -1] for name in ("qpos", "qvel", "act"))
        return engine.layout.state(qpos, qvel, act, joint_reference=np.broadcast_to(posture, before.shape))


def _posture(robot: Robot, fold: Fold) -> Array:
    with located("start.fallen.fold.posture: "):
        if fold.posture == "tucked" and "tucked" not in robot.postures:
            return tucked(robot)
        if isinstance(fold.posture, str) and fold.posture not in robot.postures:
            names = {"tucked", *robot.postures}
            raise LevadeError(f"robot {robot.name}: no posture {fold.posture!r}; {did_you_mean(fold.posture, names)}")
        return robot.posture(fold.posture)
