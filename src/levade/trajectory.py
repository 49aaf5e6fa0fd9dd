"""The arrays that pass between the rooms: what is asked of the joints, and what the robot then did.

Everything is batched over ``n`` trials and sampled once per physics step. Row ``k`` of every array belongs to physics
step ``k``, which starts at ``k * timestep`` and ends at ``time[k] = (k + 1) * timestep``: references and torques are
those in force *during* the step, positions and velocities those reached at its *end*. Rows ``[:horizon_steps]`` are the
motion proper, up to the horizon T; the rows after them, if any, are the hold.

Where each trial has a horizon of its own, references begin together, in row 0 (``JointReference.horizons``), and trajectories
have their horizons in the same row: a shorter trial begins later, at row ``Trajectories.begin``, and the rows before repeat
its first. A look at the horizon, at the hold or at an extreme therefore needs no case for it.

SI units; quaternions w-x-y-z; joint order is the robot's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.embodiment import Embodiment, JointLimits, LegGeometry
from levade.rotations import conjugate, cross, rotate


@dataclass(frozen=True)
class JointReference:
    """Desired joint motion of n trials.

    Attributes:
        position: (n, steps, joints) [rad], desired angle during each step.
        velocity: (n, steps, joints) [rad/s], its analytic time derivative.
        timestep: [s].
        horizon_steps: Number of rows up to the horizon T; later rows are the hold.
        before: (joints,) or (n, joints) [rad], what the joints were commanded until the first row came, at rest; None where
            it is not known.
        horizons: (n,) rows up to the horizon of each trial, at most ``horizon_steps``; None where all have that. After
            a trial's own horizon and a hold as long as that of the longest, its last row repeats, and is not simulated.
    """

    position: Array
    velocity: Array
    timestep: float
    horizon_steps: int
    before: Array | None = None
    horizons: NDArray[np.intp] | None = None

    @property
    def steps(self) -> int:
        """Physics steps of a trial."""
        return self.position.shape[1]

    @property
    def ends(self) -> NDArray[np.intp] | None:
        """Rows of each trial with its hold, shape (n,); None where all have ``steps``."""
        return None if self.horizons is None else self.horizons + (self.steps - self.horizon_steps)

    def __getitem__(self, trials: slice | NDArray[np.integer | np.bool_] | list[int]) -> JointReference:
        """The same reference for a subset of the trials."""
        before = self.before if self.before is None or self.before.ndim == 1 else self.before[trials]
        horizons = None if self.horizons is None else self.horizons[trials]
        position, velocity = self.position[trials], self.velocity[trials]
        return replace(self, position=position, velocity=velocity, before=before, horizons=horizons)

    def repeated(self, n: int) -> JointReference:
        """The same reference for n trials, if it is of one trial; itself if it is of n."""
        if len(self.position) == n:
            return self
        shape = (n, *self.position.shape[1:])
        position, velocity = np.broadcast_to(self.position, shape), np.broadcast_to(self.velocity, shape)
        horizons = None if self.horizons is None else np.broadcast_to(self.horizons, n)
        return replace(self, position=position, velocity=velocity, horizons=horizons)

    @classmethod
    def stacked(cls, references: Sequence[JointReference]) -> JointReference:
        """The trials of several references of one length, one after another.

        Raises:
            ValueError: If their lengths, time steps or horizons differ, or some know what came before and some do not.
        """
        first = references[0]
        alike = {(one.steps, one.timestep, one.horizon_steps, one.before is None) for one in references}
        if len(alike) > 1:
            raise ValueError(f"references: of several kinds (steps, timestep, horizon, known before): {sorted(alike)}")
        before = None
        if first.before is not None:
            rows = [
                np.broadcast_to(one.before, (len(one.position), one.position.shape[2]))
                for one in references
                if one.before is not None
            ]
            before = np.concatenate(rows)
        position, velocity = (
            np.concatenate([getattr(one, name) for one in references]) for name in ("position", "velocity")
        )
        horizons = None
        if any(one.horizons is not None for one in references):
            each = [
                np.full(len(one.position), one.horizon_steps) if one.horizons is None else one.horizons
                for one in references
            ]
            horizons = np.concatenate(each)
        return replace(first, position=position, velocity=velocity, before=before, horizons=horizons)


@dataclass(frozen=True)
class Trajectories:
    """What n trials did, and everything a cost may look at.

    Attributes:
        joint_position: (n, steps, joints) [rad] at the end of each step.
        joint_velocity: (n, steps, joints) [rad/s].
        joint_torque: (n, steps, joints) [Nm], delivered by the actuators during each step.
        trunk_position: (n, steps, 3) [m], origin of the trunk frame, in the world.
        trunk_quaternion: (n, steps, 4), trunk frame to world, w-x-y-z, unit length.
        trunk_linear_velocity: (n, steps, 3) [m/s], of the frame origin, in world axes.
        trunk_angular_velocity: (n, steps, 3) [rad/s], in trunk axes: what a gyroscope on the trunk reads.
        reference: What was asked of the joints, same n and steps.
        embodiment: What is known of the robot: its limits, legs and where its trunk's centre of mass is.
        timestep: [s].
        horizon_steps: Rows up to the horizon T.
        diverged: (n,) bool, trials whose simulation broke down; their later rows repeat the last sound one.
        foot_contact_force: (n, steps, feet, 3) [N], net contact force on each foot in world axes, in the robot's leg
            order; None unless asked for.
        body_contact_force: Body name -> (n, steps) [N], magnitude of the net force that the ground and the obstacles
            put on the body; holds the bodies that were asked for.
        self_distance: (n, steps) [m], least distance between two parts of the robot at the end of each step; negative
            where they are in each other, and never more than the clearance that was asked for
            (`levade.engines.clearance`). None unless asked for.
        begin: (n,) the row in which each trial begins; rows before it repeat that one and do not count. None where all
            begin in row 0.
    """

    joint_position: Array
    joint_velocity: Array
    joint_torque: Array
    trunk_position: Array
    trunk_quaternion: Array
    trunk_linear_velocity: Array
    trunk_angular_velocity: Array
    reference: JointReference
    embodiment: Embodiment
    timestep: float
    horizon_steps: int
    diverged: NDArray[np.bool_]
    foot_contact_force: Array | None = None
    body_contact_force: Mapping[str, Array] = field(default_factory=dict)
    self_distance: Array | None = None
    begin: NDArray[np.intp] | None = None

    def __getitem__(self, trials: slice) -> Trajectories:
        """The trajectories of some of the trials; views, not copies."""
        arrays = {
            one.name: value[trials] for one in fields(self) if isinstance(value := getattr(self, one.name), np.ndarray)
        }
        forces = {body: force[trials] for body, force in self.body_contact_force.items()}
        return replace(self, **arrays, reference=self.reference[trials], body_contact_force=forces)

    def aligned(self, trials: NDArray[np.intp]) -> Trajectories:
        """Put horizons into one row: from trials that began together to what this class says of them.

        Args:
            trials: Which row of the arrays each trial of the result is, shape (n,).
        """
        horizons = self.reference.horizons
        assert horizons is not None
        begin = self.horizon_steps - horizons[trials]
        rows = np.maximum(np.arange(self.steps) - begin[:, None], 0)

        def moved(values: Array) -> Array:
            return values[trials[:, None], rows]

        # every array of trials and rows; what is of trials alone has one dimension
        arrays = {
            one.name: moved(value) if value.ndim > 1 else value[trials]
            for one in fields(self)
            if isinstance(value := getattr(self, one.name), np.ndarray)
        }
        forces = {body: moved(force) for body, force in self.body_contact_force.items()}
        reference = replace(
            self.reference[trials],
            position=moved(self.reference.position),
            velocity=moved(self.reference.velocity),
            horizons=None,
        )
        return replace(self, **arrays, reference=reference, body_contact_force=forces, begin=begin)

    def alone(self, trial: int) -> Trajectories:
        """One trial, without the rows before it begins."""
        one = self[trial : trial + 1]
        if one.begin is None:
            return one
        first = int(one.begin[0])
        arrays = {
            field.name: value[:, first:]
            for field in fields(one)
            if isinstance(value := getattr(one, field.name), np.ndarray) and value.ndim > 1
        }
        reference = replace(
            one.reference,
            position=one.reference.position[:, first:],
            velocity=one.reference.velocity[:, first:],
            horizon_steps=self.horizon_steps - first,
        )
        forces = {body: force[:, first:] for body, force in one.body_contact_force.items()}
        return replace(
            one,
            **arrays,
            reference=reference,
            horizon_steps=self.horizon_steps - first,
            body_contact_force=forces,
            begin=None,
        )

    @property
    def horizon(self) -> Array:
        """T of each trial [s], shape (n,)."""
        begin = np.zeros(self.n, dtype=np.intp) if self.begin is None else self.begin
        return (self.horizon_steps - begin) * self.timestep

    def counted(self, rows: slice) -> NDArray[np.bool_] | None:
        """Which of the rows belong to each trial, shape (n, rows); None where all do."""
        if self.begin is None:
            return None
        return np.arange(*rows.indices(self.steps)) >= self.begin[:, None]

    @property
    def limits(self) -> JointLimits:
        """The robot's joint limits."""
        return self.embodiment.limits

    @property
    def legs(self) -> tuple[LegGeometry, ...]:
        """The robot's legs."""
        return self.embodiment.legs

    @property
    def trunk_com_offset(self) -> Array:
        """Centre of mass of the trunk in the trunk frame [m], shape (3,)."""
        return self.embodiment.trunk_com_offset

    @property
    def n(self) -> int:
        """Number of trials."""
        return self.joint_position.shape[0]

    @property
    def steps(self) -> int:
        """Physics steps of a trial."""
        return self.joint_position.shape[1]

    @cached_property
    def time(self) -> Array:
        """(steps,) [s], end of each step."""
        return np.arange(1, self.steps + 1) * self.timestep

    def trunk_com_position(self, rows: slice | int = slice(None)) -> Array:
        """(n, rows, 3) [m], the trunk's centre of mass in the world (the paper's x_B), for the given rows only."""
        return self.trunk_position[:, rows] + rotate(self.trunk_quaternion[:, rows], self.trunk_com_offset)

    def trunk_com_velocity(self, rows: slice | int = slice(None)) -> Array:
        """(n, rows, 3) [m/s], velocity of the trunk's centre of mass in world axes, for the given rows only."""
        lever = cross(self.trunk_angular_velocity[:, rows], self.trunk_com_offset)
        return self.trunk_linear_velocity[:, rows] + rotate(self.trunk_quaternion[:, rows], lever)

    def sole_height(self, leg: LegGeometry, rows: slice | int = slice(None)) -> Array:
        """(n, rows) [m], the lowest point of a leg's foot over z = 0, for the given rows only."""
        foot = rotate(self.trunk_quaternion[:, rows], leg.foot_position(self.joint_position[:, rows]))
        return self.trunk_position[:, rows][..., 2] + foot[..., 2] - leg.sole

    def trunk_clearance(self, rows: slice | int = slice(None)) -> Array:
        """(n, rows) [m], the trunk's lowest point over z = 0, for the given rows only."""
        balls = self.embodiment.trunk_balls
        up = rotate(conjugate(self.trunk_quaternion[:, rows]), np.array([0.0, 0.0, 1.0]))
        below = np.einsum("...c,kc->...k", up, balls[:, :3]) - balls[:, 3]  # in one order for any number of rows
        return self.trunk_position[:, rows][..., 2] + below.min(axis=-1)
