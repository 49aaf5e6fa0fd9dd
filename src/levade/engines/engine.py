"""What the engines have in common: the model, how a robot is put into it, and what goes to its actuators.

The model is always the one compiled from `Engine.xml`, the text that a motion file keeps, so that whoever replays a
motion from its file simulates the same model to the last bit.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.layout import Layout, add_contact_sensors
from levade.engines.physics import Physics
from levade.engines.start import Settled, Start, State
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Scene, compose
from levade.trajectory import JointReference, Trajectories

if TYPE_CHECKING:
    from levade.engines.ensemble import Ensemble

_OVERLAP = 0.003
"""[m]: what may overlap before the start; contacts at rest sink in by less."""


class Engine(ABC):
    """Rolls out joint references of one robot in one scene: `start`, then `rollout`.

    An engine adds `rollout`, and `_settle`, which lets the robot go. model: MuJoCo's, compiled from ``xml`` and
    ``assets``; for every engine the one description of robot, scene and actuators. steps: physics steps of all roll-outs
    so far; a trial that breaks down counts in full. Not to be used from several Python threads at once.
    """

    def __init__(self, robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> None:
        self.robot = robot
        self.scene = scene
        self.physics = physics
        self.threads = threads
        self.steps = 0
        self.xml = self._compose(gain_scale=1.0)
        self.assets = dict(robot.assets)
        self.model = _compile(self.xml, self.assets)
        self.layout = Layout.of_model(self.model, robot.embodiment)
        self._ctrl: Array | None = None

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """Names of the robot's bodies, whose contact forces with the scene `rollout` can record."""
        return tuple(self.model.body(i).name for i in range(1, self.model.nbody))

    def start(self, start: Start) -> State:
        """The state at the start of a motion.

        Raises LevadeError if the robot overlaps the scene, or itself, before it is let go, or the simulation diverges.
        """
        if isinstance(start, Settled):
            posture = self._posture("start.settled.posture", start)
            feet = self.robot.foot_positions(posture)
            ground = self.scene.ground_height(start.x + feet[:, 0], start.y + feet[:, 1])
            height = self.robot.standing_height(start.posture) + float(ground.max())
            data = self._release((start.x, start.y, height), (0.0, 0.0, 0.0), posture, self.model)
            return self._settle(self.model, data, posture, start.time)
        generator = np.random.default_rng(start.seed)
        attitude = np.array([start.roll, start.pitch, start.yaw]) + start.spread * generator.standard_normal(3)
        posture = self._posture("start.fall.posture", start)
        posture += start.spread * generator.standard_normal(posture.size)
        limits = self.robot.limits
        posture = np.clip(posture, limits.lower, limits.upper)
        model = _compile(self._compose(gain_scale=start.gain), self.assets)
        data = self._release((start.x, start.y, start.height), tuple(attitude), posture, model)
        return self._settle(model, data, posture, start.time)

    @abstractmethod
    def rollout(
        self, state: State, reference: JointReference, *, feet: bool = False, bodies: Sequence[str] = ()
    ) -> Trajectories:
        """Simulate n trials that start in one state and follow their references.

        feet: record the contact force on each foot. bodies: record the contact force with the scene of these.
        Simulations that break down are marked in ``diverged``; their later rows repeat the last one.
        """

    @abstractmethod
    def ensemble(self) -> Ensemble:
        """For simulating versions of the model: robots that differ from the nominal one."""

    @abstractmethod
    def _settle(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        """The state after the robot has held a posture for a time [s], from ``data`` on. Raises LevadeError if the
        simulation breaks down.
        """

    def ctrl(self, reference: JointReference) -> Array:
        """What is sent to the actuators, (n, steps, nu): position and velocity of each joint. Reused by the next
        call.
        """
        shape = (*reference.position.shape[:2], self.model.nu)
        if self._ctrl is None or self._ctrl.shape != shape:
            self._ctrl = np.zeros(shape)
        self._ctrl[..., self.layout.ctrl_position] = reference.position
        self._ctrl[..., self.layout.ctrl_velocity] = reference.velocity
        return self._ctrl

    def _compose(self, *, gain_scale: float) -> str:
        spec = compose(self.robot, self.scene, gain_scale=gain_scale)
        option = spec.option
        option.timestep = self.physics.timestep
        option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{self.physics.integrator.upper()}")
        option.cone = getattr(mujoco.mjtCone, f"mjCONE_{self.physics.cone.upper()}")
        option.impratio = self.physics.impratio
        option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        add_contact_sensors(spec, self.robot.feet)
        return spec.to_xml()

    def _posture(self, where: str, start: Start) -> Array:
        try:
            return self.robot.posture(start.posture)
        except LevadeError as error:
            raise LevadeError(f"{where}: {error}") from None

    def _release(
        self,
        position: tuple[float, float, float],
        attitude: tuple[float, float, float],
        posture: Array,
        model: mujoco.MjModel,
    ) -> mujoco.MjData:
        data = mujoco.MjData(model)
        at = self.layout
        data.qpos[at.trunk_position] = position
        roll, pitch, yaw = attitude
        mujoco.mju_euler2Quat(data.qpos[at.trunk_quaternion], np.array([yaw, pitch, roll]), "zyx")
        data.qpos[self.layout.joint_qpos] = posture
        mujoco.mj_forward(model, data)
        for contact in data.contact:
            if contact.dist < -_OVERLAP and not contact.exclude:
                one, other = (_geom_name(model, int(geom)) for geom in contact.geom)
                raise LevadeError(
                    f"start: {one} and {other} overlap by {-contact.dist:.3f} m where the robot is put down;"
                    " move the robot (start) or the obstacle (scene)"
                )
        return data


def _compile(xml: str, assets: dict[str, bytes]) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(xml, assets)


def _geom_name(model: mujoco.MjModel, geom: int) -> str:
    name = model.geom(geom).name
    return name or f"a part of {model.body(int(model.geom_bodyid[geom])).name}"
