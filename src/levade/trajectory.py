"""The arrays that pass between the rooms: joint references, and the robot's motion.

Everything is batched over ``n`` trials and sampled once per physics step. Row ``k`` of every array belongs to physics step
``k``, which starts at ``k * timestep`` and ends at ``time[k] = (k + 1) * timestep``. References and torques are those *during*
the step, positions and velocities those at its *end*. Rows ``[:horizon_steps]`` lead up to the horizon T; later rows are the
hold.

Trials may have different horizons. Their references then begin together in row 0 (``JointReference.horizons``). In trajectories
their horizons are in the same row. A shorter trial begins later, at row ``Trajectories.begin``, and the rows before repeat its
first. So the rows of the horizon, the hold and extremes need no special case.

Units are SI, quaternions w-x-y-z; the joint order is the robot's.
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
        position: Desired angle during each step [rad], shape (n, steps, joints).
        velocity: Its analytic time derivative [rad/s], shape (n, steps, joints).
        timestep: Time step [s].
        horizon_steps: Number of rows up to the horizon T; later rows are the hold.
        before: Commands at rest before the first row [rad], shape (joints,) or (n, joints). None if not known.
        horizons: Rows up to the horizon of each trial, at most ``horizon_steps``, shape (n,). None if all have that. After a
            trial's own horizon and a hold as long as that of the longest, its last row repeats, and is not simulated.
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
        """Rows of each trial with its hold, shape (n,). None if all have ``steps``."""
        return None if self.horizons is None else self.horizons + (self.steps - self.horizon_steps)

    def __getitem__(self, trials: slice | NDArray[np.integer | np.bool_] | list[int]) -> JointReference:
        """Select trials."""
        before = self.before if self.before is None or self.before.ndim == 1 else self.before[trials]
        horizons = None if self.horizons is None else self.horizons[trials]
        position, velocity = self.position[trials], self.velocity[trials]
        return replace(self, position=position, velocity=velocity, before=before, horizons=horizons)

    def repeated(self, n: int) -> JointReference:
        """Repeat a reference of one trial for n trials. A reference of n trials is returned unchanged.

        Args:
            n: Number of trials.

        Returns:
            A reference of n trials. Repeated arrays are read-only views.
        """
        if len(self.position) == n:
            return self
        shape = (n, *self.position.shape[1:])
        position, velocity = np.broadcast_to(self.position, shape), np.broadcast_to(self.velocity, shape)
        horizons = None if self.horizons is None else np.broadcast_to(self.horizons, n)
        return replace(self, position=position, velocity=velocity, horizons=horizons)

    @classmethod
    def stacked(cls, references: Sequence[JointReference]) -> JointReference:
        """Join the trials of several references of one length.

        Args:
            references: The references, in sequence.

        Returns:
            One reference.

        Raises:
            ValueError: If lengths, time steps or horizons differ, or only some know their earlier commands.
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
    """Records of n trials, and the only input of a cost.

    Attributes:
        joint_position: Angles at the end of each step [rad], shape (n, steps, joints).
        joint_velocity: Velocities at the end of each step [rad/s], shape (n, steps, joints).
        joint_torque: Torques that the actuators deliver during each step [Nm], shape (n, steps, joints).
        trunk_position: Origin of the trunk frame in the world [m], shape (n, steps, 3).
        trunk_quaternion: Trunk frame to world, w-x-y-z, unit length, shape (n, steps, 4).
        trunk_linear_velocity: Velocity of the frame's origin in world axes [m/s], shape (n, steps, 3).
        trunk_angular_velocity: Angular velocity in trunk axes, as a gyroscope measures it [rad/s], shape (n, steps, 3).
        reference: Joint references, with the same n and steps.
        embodiment: The robot: its limits, its legs and its trunk's centre of mass.
        timestep: Time step [s].
        horizon_steps: Rows up to the horizon T.
        diverged: Trials whose simulation broke down, shape (n,). Their later rows repeat the last sound one.
        foot_contact_force: Net contact force on each foot in world axes [N], in the robot's leg order, shape (n, steps, feet,
            3). None if not recorded.
        body_contact_force: Body -> magnitude of the net force that ground and obstacles exert on it [N], shape (n, steps), for
            the recorded bodies.
        self_force: Magnitude of the strongest contact between two parts of the robot during each step [N], shape (n, steps).
            None if not recorded.
        self_distance: Least distance between two parts of the robot at the end of each step [m], shape (n, steps). It is
            negative if they overlap, and at most the clearance (`levade.engines.clearance`). None if not recorded.
        begin: Row in which each trial begins, shape (n,). Rows before it repeat that row and do not count. None if all begin in
            row 0.
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
    self_force: Array | None = None
    self_distance: Array | None = None
    begin: NDArray[np.intp] | None = None

    def __getitem__(self, trials: slice) -> Trajectories:
        """Select trials. The arrays are views, not copies."""
        arrays = {
            one.name: value[trials] for one in fields(self) if isinstance(value := getattr(self, one.name), np.ndarray)
        }
        forces = {body: force[trials] for body, force in self.body_contact_force.items()}
        return replace(self, **arrays, reference=self.reference[trials], body_contact_force=forces)

    def aligned(self, trials: NDArray[np.intp]) -> Trajectories:
        """Move horizons into one row, for trials that began together.

        Args:
            trials: Row of the arrays of each trial of the result, shape (n,).

        Returns:
            Trajectories as this class describes them.
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
        """Select one trial, without the rows before it begins.

        Args:
            trial: Index of the trial, from 0.

        Returns:
            Trajectories of one trial, which begins in row 0.
        """
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
        """Tell which of the rows belong to each trial.

        Args:
            rows: Rows to look at.

        Returns:
            True where a row belongs to the trial, shape (n, rows). None if all do.
        """
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
        """End of each step [s], shape (steps,)."""
        return np.arange(1, self.steps + 1) * self.timestep

    def trunk_com_position(self, rows: slice | int = slice(None)) -> Array:
        """Compute the trunk's centre of mass in the world (the paper's x_B).

        Args:
            rows: Rows to compute. All by default. A single row leaves out the rows' dimension.

        Returns:
            Positions [m], shape (n, rows, 3).
        """
        return self.trunk_position[:, rows] + rotate(self.trunk_quaternion[:, rows], self.trunk_com_offset)

    def trunk_com_velocity(self, rows: slice | int = slice(None)) -> Array:
        """Compute the velocity of the trunk's centre of mass in world axes.

        Args:
            rows: Rows to compute. All by default. A single row leaves out the rows' dimension.

        Returns:
            Velocities [m/s], shape (n, rows, 3).
        """
        lever = cross(self.trunk_angular_velocity[:, rows], self.trunk_com_offset)
        return self.trunk_linear_velocity[:, rows] + rotate(self.trunk_quaternion[:, rows], lever)

    def sole_height(self, leg: LegGeometry, rows: slice | int = slice(None)) -> Array:
        """Compute the lowest point of a leg's foot over z = 0.

        Args:
            leg: One of the robot's legs.
            rows: Rows to compute. All by default. A single row leaves out the rows' dimension.

        Returns:
            Heights [m], shape (n, rows).
        """
        foot = rotate(self.trunk_quaternion[:, rows], leg.foot_position(self.joint_position[:, rows]))
        return self.trunk_position[:, rows][..., 2] + foot[..., 2] - leg.sole

    def trunk_clearance(self, rows: slice | int = slice(None)) -> Array:
        """Compute the trunk's lowest point over z = 0.

        Args:
            rows: Rows to compute. All by default. A single row leaves out the rows' dimension.

        Returns:
            Heights [m], shape (n, rows).

        Raises:
            ValueError: If the embodiment has no ``trunk_balls``.
        """
        balls = self.embodiment.trunk_balls
        up = rotate(conjugate(self.trunk_quaternion[:, rows]), np.array([0.0, 0.0, 1.0]))
        below = np.einsum("...c,kc->...k", up, balls[:, :3]) - balls[:, 3]  # in one order for any number of rows
        return self.trunk_position[:, rows][..., 2] + below.min(axis=-1)
