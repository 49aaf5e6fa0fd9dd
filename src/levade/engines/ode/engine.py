"""The engine ode: the Open Dynamics Engine, the paper's contact model.

engine = make_engine(load_robot("hyq2max"), Scene(), Physics(engine="ode"))

ODE's worlds are made from a compiled model. A version of it (`levade.engines.Models`) is that model with changed fields, and
has its own worlds. Versions that occur again, such as those on which candidates are compared, are kept.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from importlib.metadata import version
from typing import Any, ClassVar

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.engine import Engine, Trials, broke_down
from levade.engines.layout import FOOT_CONTACT_FORCE, sole
from levade.engines.models import CONE_FIELD, Models, with_free_frames
from levade.engines.ode.library import load
from levade.engines.ode.multibody import multibody_of
from levade.engines.ode.simulation import Record, Simulation
from levade.engines.ode.workers import WorkerPool
from levade.engines.state import State
from levade.rotations import conjugate, rotate
from levade.trajectory import Trajectories

_KEPT = 64
"""Number of versions whose worlds are kept."""


class OdeEngine(Engine):
    """The engine ODE. ``threads`` processes share trials on the nominal model; this process simulates versions of it."""

    name: ClassVar[str] = "ode"

    def _prepare(self) -> None:
        self._workers = WorkerPool(self.xml, self.assets, self.physics, self.threads)
        self._kept: OrderedDict[bytes, Simulation] = OrderedDict()
        hinges, joints = self._workers.simulation.multibody.hinges.names, self.embodiment.joint_names
        self._to = [hinges.index(joint) for joint in joints]
        self._from = [joints.index(hinge) for hinge in hinges]

    @classmethod
    def versions(cls) -> dict[str, str]:
        """Return the versions, including MuJoCo's, which reads the model from its text."""
        return {**{name: version(name) for name in ("mujoco", "numpy")}, "ode": load().name}

    def hold(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        """Simulate the robot while it holds a posture; see `levade.engines.Engine.hold`."""
        steps = round(time / self.physics.timestep)
        start = self.layout.state(data.qpos, data.qvel, data.act, joint_reference=posture)
        if not steps:
            return start
        simulation = self._simulation(model)
        held = np.broadcast_to(posture[self._from], (1, steps, posture.size))
        record = simulation.run(start.qpos, start.qvel, start.act, held, np.zeros_like(held))
        if record.diverged[0]:
            raise broke_down(time)
        return self.layout.state(*simulation.state_after(record, 0), joint_reference=posture)

    def _simulate(self, trials: Trials, record: Sequence[str]) -> Trajectories:
        commanded, bodies = trials.commanded.repeated(trials.n), [name for name in record if name in self.bodies]
        position, velocity = commanded.position[..., self._from], commanded.velocity[..., self._from]
        forces = {
            "soles": [sole(self.model, foot) for foot in self.embodiment.feet] if FOOT_CONTACT_FORCE in record else [],
            "bodies": [self.model.body(body).id for body in bodies],
        }
        if trials.models is None:
            done = self._workers.run(trials.starts, position, velocity, **forces)
        else:
            done = self._run_versions(trials.models, trials.starts, position, velocity, forces)
        return Trajectories(
            joint_position=done.angle[..., self._to],
            joint_velocity=done.speed[..., self._to],
            joint_torque=done.torque[..., self._to],
            trunk_position=done.position,
            trunk_quaternion=done.quaternion,
            trunk_linear_velocity=done.linear,
            trunk_angular_velocity=rotate(conjugate(done.quaternion), done.angular),
            reference=trials.reference,
            embodiment=self.embodiment,
            timestep=trials.reference.timestep,
            horizon_steps=trials.reference.horizon_steps,
            diverged=done.diverged,
            foot_contact_force=done.geom_force if FOOT_CONTACT_FORCE in record else None,
            body_contact_force={
                body: np.linalg.norm(done.body_force[:, :, i], axis=-1) for i, body in enumerate(bodies)
            },
        )

    def _run_versions(
        self, models: Models, starts: State, position: Array, velocity: Array, forces: dict[str, Any]
    ) -> Record:
        """Simulate trials on versions of the model, those of one version together."""
        n = len(position)
        same: dict[bytes, list[int]] = {}
        for trial in range(n):
            same.setdefault(_key(models, trial % len(models)), []).append(trial)
        parts, order = [], []
        for key, some in same.items():
            of = starts if len(starts) == 1 else starts[some]
            simulation = self._version(key, models, some[0] % len(models))
            parts.append(simulation.run(of.qpos, of.qvel, of.act, position[some], velocity[some], **forces))
            order += some
        return Record.joined(parts)[np.argsort(order)]

    def _version(self, key: bytes, models: Models, row: int) -> Simulation:
        """Return the worlds of a version."""
        if key not in self._kept:
            model = with_free_frames(self.model, self.layout)
            for name, values in models.fields.items():
                if name != CONE_FIELD:  # ODE has its own
                    getattr(model, name)[:] = values[row]
            self._kept[key] = self._simulation(model)
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        return self._kept[key]

    def _simulation(self, model: mujoco.MjModel) -> Simulation:
        return Simulation(multibody_of(model), self.physics.ode, self.physics.timestep)


def _key(models: Models, row: int) -> bytes:
    """Return bytes that identify a version."""
    return b"".join(name.encode() + values[row].tobytes() for name, values in models.fields.items())
