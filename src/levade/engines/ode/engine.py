"""The engine ode: the Open Dynamics Engine, the paper's contact model, behind the same two methods as MuJoCo.

engine = OdeEngine(load_robot("hyq2max"), Scene(), Physics(engine="ode"))
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.embodiment import Embodiment
from levade.engines.engine import Engine
from levade.engines.ode.crew import Crew
from levade.engines.ode.simulation import Record, Simulation
from levade.engines.ode.skeleton import skeleton
from levade.engines.physics import Physics
from levade.engines.start import State
from levade.errors import LevadeError
from levade.robots import Robot
from levade.rotations import conjugate, rotate
from levade.scenes import Scene
from levade.trajectory import JointReference, Trajectories

if TYPE_CHECKING:
    from levade.engines.ode.ensemble import OdeEnsemble


class OdeEngine(Engine):
    """ODE. threads: processes at most, 0 for one per core; results do not depend on it.

    Raises LevadeError if the library is missing, or the robot has something that ODE cannot simulate.
    """

    def __init__(self, robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> None:
        super().__init__(robot, scene, physics, threads=threads)
        self._stage = OdeStage(
            self.xml,
            self.assets,
            physics,
            robot.embodiment,
            threads=threads,
        )

    def rollout(
        self, state: State, reference: JointReference, *, feet: bool = False, bodies: Sequence[str] = ()
    ) -> Trajectories:
        self.steps += reference.position.shape[0] * reference.steps
        return self._stage.rollout((state.qpos, state.qvel, state.act), reference, feet=feet, bodies=bodies)

    def ensemble(self) -> OdeEnsemble:
        """For simulating versions of the model: robots that differ from the nominal one."""
        from levade.engines.ode.ensemble import OdeEnsemble

        return OdeEnsemble(self._stage, self.physics, self.layout, threads=self.threads)

    def _settle(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        steps = round(time / self.physics.timestep)
        start = (data.qpos.copy(), data.qvel.copy(), data.act.copy())
        if steps:
            simulation = Simulation(skeleton(model), self.physics.ode, self.physics.timestep)
            held = np.broadcast_to(posture[_order(simulation, self.robot.joint_names)[1]], (1, steps, posture.size))
            record = simulation.run(*start, held, np.zeros_like(held))
            if record.diverged[0]:
                raise LevadeError(
                    f"start: the simulation broke down within {time} s; a smaller physics.timestep or lower gains may help"
                )
            start = simulation.state_after(record, 0)
        return State(*start, joint_position=start[0][self.layout.joint_qpos].copy(), joint_reference=posture.copy())


class OdeStage:
    """A model in ODE, by names: what a motion file has is enough.

    xml, assets: MJCF and its files.
    """

    def __init__(
        self,
        xml: str,
        assets: Mapping[str, bytes],
        physics: Physics,
        embodiment: Embodiment,
        *,
        threads: int = 0,
    ) -> None:
        self._crew = Crew(xml, assets, physics, threads)
        self._physics, self._embodiment = physics, embodiment
        self._to, self._from = _order(self._crew.simulation, embodiment.joint_names)
        self.model = self._crew.simulation.skeleton.model
        self._feet = [self.model.geom(foot).id for foot in embodiment.feet]

    def rollout(
        self,
        start: tuple[Array, Array, Array],
        reference: JointReference,
        *,
        feet: bool = False,
        bodies: Sequence[str] = (),
    ) -> Trajectories:
        """As `Engine.rollout`; start: qpos, qvel, act of the model."""
        asked = self.asked(reference.position, reference.velocity, feet=feet, bodies=bodies)
        record = self._crew.run(start, **asked)
        return self.trajectories(record, reference, feet=feet, bodies=bodies)

    def asked(self, position: Array, velocity: Array, *, feet: bool, bodies: Sequence[str]) -> dict[str, Any]:
        """What `Simulation.run` takes: desired joint motion (n, steps, joints), and whose forces to record."""
        return {
            "position": position[..., self._from],
            "velocity": velocity[..., self._from],
            "geoms": self._feet if feet else [],
            "bodies": [self.model.body(body).id for body in bodies],
        }

    def trajectories(
        self, record: Record, reference: JointReference, *, feet: bool, bodies: Sequence[str]
    ) -> Trajectories:
        """What was simulated, in the robot's order of joints."""
        return Trajectories(
            joint_position=record.angle[..., self._to],
            joint_velocity=record.speed[..., self._to],
            joint_torque=record.torque[..., self._to],
            trunk_position=record.position,
            trunk_quaternion=record.quaternion,
            trunk_linear_velocity=record.linear,
            trunk_angular_velocity=rotate(conjugate(record.quaternion), record.angular),
            reference=reference,
            embodiment=self._embodiment,
            timestep=self._physics.timestep,
            horizon_steps=reference.horizon_steps,
            diverged=record.diverged,
            foot_contact_force=record.geom_force if feet else None,
            body_contact_force={
                body: np.linalg.norm(record.body_force[:, :, i], axis=-1) for i, body in enumerate(bodies)
            },
        )


def _order(simulation: Simulation, joints: Sequence[str]) -> tuple[list[int], list[int]]:
    """Where the joints are among the hinges, and the hinges among the joints."""
    names = simulation.skeleton.hinges.names
    return [names.index(joint) for joint in joints], [list(joints).index(name) for name in names]
