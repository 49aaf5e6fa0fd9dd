"""Simulate n trials side by side: actuators, contacts and steps.

simulation = Simulation(multibody, Ode(), timestep=0.002)
record = simulation.run(qpos, qvel, act, position, velocity)

The trials share every numpy call, but no number. So a trial gives the same bits alone, in a batch, and in another process. Most
of the time is ODE's: about 0.1 ms a step and trial for a robot of 12 joints on its feet.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.ode.broadphase import BroadPhase
from levade.engines.ode.joints import Angles, Torques, link_motion
from levade.engines.ode.library import load
from levade.engines.ode.multibody import Multibody
from levade.engines.ode.worlds import CONTACTS, Worlds
from levade.engines.physics import Ode
from levade.rotations import conjugate, rotate

_SPEED = 1e4
"""Speed above which a simulation has broken down [m/s], [rad/s]."""

_TORQUE = 1e9
"""Torque above which a simulation breaks down in one step [Nm]."""

_SEED = 2017
"""Seed of the order in which QuickStep takes the constraints. Each step has its own, the same in every trial."""


@dataclass(frozen=True, eq=False)
class Record:
    """Records of n trials, in the multibody's order of links and hinges.

    Attributes:
        angle: Angles of the hinges [rad], shape (n, steps, J).
        speed: Speeds of the hinges [rad/s], shape (n, steps, J).
        torque: Delivered torques [Nm], shape (n, steps, J).
        position: Origin of the trunk's frame [m], shape (n, steps, 3).
        quaternion: Orientation of the trunk's frame, shape (n, steps, 4).
        linear: Velocity of its origin in world axes [m/s], shape (n, steps, 3).
        angular: Angular velocity in world axes [rad/s], shape (n, steps, 3).
        lag: State of the drives at the end, shape (n, J).
        geom_force: Force on each recorded sole in world axes [N], shape (n, steps, soles, 3).
        body_force: Force of the world on each recorded body [N], shape (n, steps, bodies, 3).
        diverged: Whether each trial broke down, shape (n,).
    """

    angle: Array
    speed: Array
    torque: Array
    position: Array
    quaternion: Array
    linear: Array
    angular: Array
    lag: Array
    geom_force: Array
    body_force: Array
    diverged: NDArray[np.bool_]

    def __getitem__(self, trials: NDArray[np.intp]) -> Record:
        """Select trials, in the order given."""
        return Record(**{name: values[trials] for name, values in vars(self).items()})

    @classmethod
    def joined(cls, records: Sequence[Record]) -> Record:
        """Join the trials of several records, in sequence.

        Args:
            records: Records with the same steps and recorded forces, at least one.

        Returns:
            One record of all trials.
        """
        if len(records) == 1:
            return records[0]
        return cls(**{name: np.concatenate([getattr(one, name) for one in records]) for name in vars(records[0])})


class Simulation:
    """Holds ODE's worlds of one multibody for successive runs."""

    def __init__(self, multibody: Multibody, settings: Ode, timestep: float) -> None:
        self.multibody = multibody
        self._torques = Torques(multibody, timestep)
        self._worlds = Worlds(load(), multibody, settings, timestep, self._torques.resisted)
        self._broad_phase = BroadPhase(multibody)
        self._timestep = timestep
        self._angles = Angles(multibody)

    def run(
        self,
        qpos: Array,
        qvel: Array,
        act: Array,
        position: Array,
        velocity: Array,
        *,
        soles: Sequence[Sequence[int]] = (),
        bodies: Sequence[int] = (),
    ) -> Record:
        """Simulate n trials.

        Args:
            qpos: Where they start, in the model's order, shape (1 or n, nq).
            qvel: Velocities at the start, shape (1 or n, nv).
            act: Actuator states at the start, shape (1 or n, na).
            position: Desired hinge angles [rad], shape (n, steps, J).
            velocity: Desired hinge speeds [rad/s], shape (n, steps, J).
            soles: Geoms of the model whose contact forces are recorded, those of each sole together.
            bodies: Bodies of the model whose contact forces are recorded.
        """
        with np.errstate(all="ignore"):  # of simulations that break down
            return self._run(qpos, qvel, act, position, velocity, list(soles), list(bodies))

    def state_after(self, record: Record, trial: int) -> tuple[Array, Array, Array]:
        """Return qpos, qvel and act of the model at the end of a trial.

        Args:
            record: What `run` returned.
            trial: Index of the trial.

        Returns:
            Positions, shape (nq,); velocities, shape (nv,); and states of the actuators, shape (na,).
        """
        s, model = self.multibody, self.multibody.model
        qpos, qvel, act = model.qpos0.copy(), np.zeros(model.nv), np.zeros(model.na)
        last = (trial, -1)
        qpos[s.root_qpos : s.root_qpos + 7] = [*record.position[last], *record.quaternion[last]]
        qvel[s.root_qvel : s.root_qvel + 3] = record.linear[last]
        inverse = conjugate(record.quaternion[last])
        qvel[s.root_qvel + 3 : s.root_qvel + 6] = rotate(inverse, record.angular[last])
        qpos[s.hinges.qpos], qvel[s.hinges.qvel] = record.angle[last], record.speed[last]
        lagging = s.drives.act >= 0
        act[s.drives.act[lagging]] = record.lag[trial, lagging]
        return qpos, qvel, act

    def _run(
        self,
        qpos: Array,
        qvel: Array,
        act: Array,
        position: Array,
        velocity: Array,
        soles: list[Sequence[int]],
        bodies: list[int],
    ) -> Record:
        worlds, drives = self._worlds, self.multibody.drives
        n, steps, joints = position.shape
        worlds.grow(n)
        starts = [link_motion(self.multibody, *row) for row in zip(qpos, qvel, strict=True)]
        qpos, qvel, act = (np.broadcast_to(part, (n, part.shape[1])) for part in (qpos, qvel, act))

        def place(trials: Sequence[int]) -> None:
            """Put trials at their start."""
            if len(starts) == 1:
                worlds.place(trials, *starts[0])
            else:
                for i in trials:
                    worlds.place([i], *starts[i])
            self._broad_phase.forget()

        place(range(n))
        state = worlds.read(n)
        angle = qpos[:, self.multibody.hinges.qpos]
        angle, speed = self._angles(state, angle)
        lag = np.zeros((n, joints))
        if act.shape[1]:
            lag += np.where(drives.act >= 0, drives.gain * act[:, drives.act], 0.0)
        angles, speeds, torques = (np.zeros((n, steps, joints)) for _ in range(3))
        trunk = np.zeros((n, steps, 4 + 3 * 3))
        geom_force, body_force = (np.zeros((n, steps, len(of), 3)) for of in (soles, bodies))
        touching: list[tuple[int, int]] | None = [] if soles or bodies else None
        seeds = np.random.default_rng(_SEED).integers(2**32, size=steps).tolist()
        until = np.full(n, steps)  # the row from which on a trial has broken down
        running = list(range(n))
        resisted = bool(self._torques.resisted.any())
        for k in range(steps):
            torque, pushed, resistance, target = self._torques(lag, angle, speed, position[:, k], velocity[:, k])
            still = [i for i, sound in zip(running, _sound(pushed, _TORQUE, running), strict=True) if sound]
            pairs = self._broad_phase(state, self._timestep)
            if touching is not None:
                touching.clear()
                worlds.make_room(CONTACTS * sum(map(len, pairs)))
            push = pushed.tolist()
            for i in still:
                if resisted:
                    worlds.resist(i, target[i], resistance[i])
                worlds.advance(i, push[i], pairs[i], seeds[k], touching)
            state = worlds.read(n)
            fast = np.maximum(np.abs(state["linear"]), np.abs(state["angular"]))
            still = [i for i, sound in zip(still, _sound(fast, _SPEED, still), strict=True) if sound]
            if len(still) < len(running):
                broken = sorted(set(running) - set(still))
                until[broken] = k
                place(broken)
                state = worlds.read(n)
            running = still
            angle, speed = self._angles(state, angle)
            angles[:, k], speeds[:, k], torques[:, k] = angle, speed, torque
            trunk[:, k] = np.concatenate(
                [state[name][:, 0] for name in ("quaternion", "position", "linear", "angular")], 1
            )
            if touching:
                self._add_forces(k, touching, soles, bodies, geom_force, body_force)
        out = Record(
            *(angles, speeds, torques, *self._trunk(trunk), lag / drives.gain, geom_force, body_force),
            diverged=until < steps,
        )
        for i in np.flatnonzero(out.diverged):
            _repeat(out, int(i), int(until[i]), self.multibody, qpos[i], qvel[i])
        return out

    def _trunk(self, row: Array) -> tuple[Array, Array, Array, Array]:
        """Return position, quaternion, velocity and angular velocity of the trunk's frame from those of its centre of mass."""
        quaternion, centre, linear, angular = np.split(row, [4, 7, 10], axis=-1)
        quaternion = quaternion / np.sqrt(np.sum(quaternion**2, axis=-1, keepdims=True))
        lever = rotate(quaternion, self.multibody.com[0])
        return centre - lever, quaternion, linear - np.cross(angular, lever), angular.copy()

    def _add_forces(
        self,
        k: int,
        touching: list[tuple[int, int]],
        soles: list[Sequence[int]],
        bodies: list[int],
        geom_force: Array,
        body_force: Array,
    ) -> None:
        """Sum the contacts' forces by sole, and those of the world by body."""
        force = self._worlds.forces(len(touching))
        trial, pair = np.array(touching).T
        shapes = self.multibody.shapes
        one, other = ([shapes[i] for i in self.multibody.pairs[pair, side]] for side in (0, 1))
        for column, sole in enumerate(soles):
            for sign, side in ((1.0, one), (-1.0, other)):
                of = np.array([shape.geom in sole for shape in side])
                np.add.at(geom_force, (trial[of], k, column), sign * force[of])
        for column, body in enumerate(bodies):
            of = np.array([a.body == body and b.link < 0 for a, b in zip(one, other, strict=True)])
            np.add.at(body_force, (trial[of], k, column), force[of])


def _sound(values: Array, limit: float, trials: list[int]) -> list[bool]:
    """Tell for each trial whether all values, shape (n, ...), are finite and within the limit."""
    return np.all(np.abs(values).reshape(len(values), -1) < limit, axis=1)[trials].tolist()


def _repeat(out: Record, trial: int, row: int, multibody: Multibody, qpos: Array, qvel: Array) -> None:
    """Repeat the row before a row, or the start, from that row on."""
    start = {
        "angle": qpos[multibody.hinges.qpos],
        "speed": qvel[multibody.hinges.qvel],
        "position": qpos[multibody.root_qpos : multibody.root_qpos + 3],
        "quaternion": qpos[multibody.root_qpos + 3 : multibody.root_qpos + 7],
        "linear": qvel[multibody.root_qvel : multibody.root_qvel + 3],
    }
    names = ("angle", "speed", "torque", "position", "quaternion", "linear", "angular", "geom_force", "body_force")
    for name in names:
        values = getattr(out, name)[trial]
        values[row:] = values[row - 1] if row else start.get(name, 0.0)
