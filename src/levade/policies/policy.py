"""Turn weights into joint references (eq. 3), and find weights that hold a posture, move between two, or copy a motion.

Rows follow `levade.trajectory`: row k is the reference in force during step k. It is evaluated at ``(k + 1) * timestep``, the
end of that step, so the last row up to the horizon is the policy at T itself. In the hold the reference stays at its value at
T, and its velocity is zero.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies.ends import Ends
from levade.policies.groups import Group, expansion
from levade.policies.kernels import GaussianKernels
from levade.policies.slew import Slew
from levade.trajectory import JointReference

# A fit leaves out singular values of the basis below this share of the largest. With kernels that overlap almost entirely,
# they would require huge weights of opposite sign, to follow details that no kernel can represent.
FIT_CUTOFF = 1e-4
LINE_CUTOFF = 1e-2


_HEARD = 0.05
"""Rows of a blended reference with a smaller share of the kernels' reference say nothing about the weights."""


@dataclass(frozen=True)
class Policy:
    """One kernel policy for each independent joint, which the groups spread over the joints of the robot.

    Weights have shape (n, size). For each trial they are the ``kernels.kernels`` weights of the first independent joint, then
    those of the next; independent joints are numbered group by group, in the order of each leader's joints. A weight is a
    desired angle of the leader's joint [rad], the paper's w_i.

    Attributes:
        kernels: The kernels, the same for every joint.
        groups: Groups of joints that share weights.
        horizon: T [s], rounded to a whole number of steps, at least one.
        timestep: Time step [s].
        hold_steps: Rows after T.
        ends: Postures in which every reference starts and ends. None leaves them to the weights.
        within: Lower and upper bound of each joint [rad], infinite for a joint without one. A reference that would go beyond
            a bound rests there. None sets no bounds.
        slew: Bounds on the speed of references; None sets none. A reference that starts beyond the bounds of ``within``
            returns as fast as ``slew`` allows, and so does a follower that starts elsewhere than its leader.

    Raises:
        LevadeError: If the groups do not cover every joint once, or a duration is not positive.
    """

    kernels: GaussianKernels
    groups: tuple[Group, ...]
    horizon: float
    timestep: float
    hold_steps: int = 0
    ends: Ends | None = None
    within: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    slew: Slew | None = None

    def __post_init__(self) -> None:
        for name, value in (("horizon", self.horizon), ("timestep", self.timestep)):
            if not (math.isfinite(value) and value > 0):
                raise LevadeError(f"{name}: {value} s is not a duration; give a positive number of seconds")
        if self.hold_steps < 0:
            raise LevadeError(f"hold_steps: {self.hold_steps} is negative; give 0 for no hold")
        expansion(self.groups)

    @property
    def horizon_steps(self) -> int:
        """Rows up to the horizon."""
        return max(1, round(self.horizon / self.timestep))

    @property
    def joints(self) -> int:
        """Number of the robot's joints."""
        return len(self._expansion[0])

    @property
    def independent_joints(self) -> int:
        """Number of joints that have weights of their own."""
        return sum(len(group.leader) for group in self.groups)

    @property
    def size(self) -> int:
        """Number of weights of one trial, d."""
        return self.independent_joints * self.kernels.kernels

    @cached_property
    def basis(self) -> tuple[Array, Array]:
        """Phi (horizon_steps, kernels) [-] and its time derivative [1/s], at the end of each step up to the horizon."""
        steps = self.horizon_steps
        return self.kernels.basis(np.arange(1, steps + 1, dtype=np.float64) * self.timestep, steps * self.timestep)

    @cached_property
    def _blend(self) -> tuple[Array, Array, Array, Array] | None:
        """`Ends.blend` at the end of each step up to the horizon, with rates by time [1/s] and [rad/s]."""
        return self._blend_at(np.arange(1, self.horizon_steps + 1) / self.horizon_steps)

    def _blend_at(self, share: Array) -> tuple[Array, Array, Array, Array] | None:
        """Evaluate `Ends.blend` at shares (rows,) of the horizon, with rates by time [1/s] and [rad/s]."""
        if self.ends is None:
            return None
        factor, added, factor_rate, added_rate = self.ends.blend(share)
        horizon = self.horizon_steps * self.timestep
        return factor, added, factor_rate / horizon, added_rate / horizon

    @cached_property
    def _expansion(self) -> tuple[NDArray[np.intp], Array]:
        return expansion(self.groups)

    @cached_property
    def leaders(self) -> NDArray[np.intp]:
        """Joint of the robot that each independent joint is, shape (independent_joints,)."""
        return np.array([joint for group in self.groups for joint in group.leader], dtype=np.intp)

    def reference(self, weights: Array, *, hold_steps: int | None = None) -> JointReference:
        """Evaluate eq. 3: joint references from policy weights.

        A trial's bits depend on its own weights alone, not on the batch. Equal weights of a joint give exactly that angle and
        exactly zero velocity. Followers mirror their leader exactly.

        Args:
            weights: Policy weights [rad], shape (n, size).
            hold_steps: Rows after the horizon. Defaults to the policy's own.

        Returns:
            Position [rad] and velocity [rad/s], shape (n, horizon_steps + hold_steps, joints), C-contiguous.

        Raises:
            LevadeError: If the weights have another shape or are not finite.
        """
        weights = self._checked(weights)
        n, rows = weights.shape[0], self.horizon_steps
        steps = rows + (self.hold_steps if hold_steps is None else hold_steps)
        position = np.empty((n, steps, self.joints))
        velocity = np.empty((n, steps, self.joints))
        self._evaluate(weights, self.basis, self._blend, position[:, :rows], velocity[:, :rows])
        self.bound(position[:, :rows], velocity[:, :rows])
        position[:, rows:] = position[:, rows - 1 : rows]
        velocity[:, rows:] = 0.0
        return JointReference(position, velocity, self.timestep, rows)

    def at(self, weights: Array, time: Array) -> tuple[Array, Array]:
        """Evaluate eq. 3 at any instants; with ``slew``, interpolate linearly between the rows of `reference`.

        Args:
            weights: Policy weights [rad], shape (n, size).
            time: Instants [s], shape (rows,), from 0 to the horizon T.

        Returns:
            Position [rad] and velocity [rad/s], shape (n, rows, joints). At the end of a step they equal those of
            `reference`, up to rounding.

        Raises:
            LevadeError: If the weights have another shape or are not finite.
        """
        weights = self._checked(weights)
        if self.slew is not None:
            return self._between_rows(self.slew, weights, np.asarray(time, dtype=np.float64))
        horizon = self.horizon_steps * self.timestep
        position = np.empty((len(weights), len(time), self.joints))
        velocity = np.empty_like(position)
        self._evaluate(weights, self.kernels.basis(time, horizon), self._blend_at(time / horizon), position, velocity)
        self.bound(position, velocity)
        return position, velocity

    def _between_rows(self, slew: Slew, weights: Array, time: Array) -> tuple[Array, Array]:
        """Interpolate linearly between the rows of `reference`, beginning at the last commanded angles: `at`, with ``slew``."""
        rows = self.reference(weights, hold_steps=0)
        n, joints = len(weights), self.joints
        position = np.concatenate([np.broadcast_to(np.array(slew.start), (n, 1, joints)), rows.position], axis=1)
        velocity = np.concatenate([rows.velocity[:, :1], rows.velocity], axis=1)
        place = np.clip(time / self.timestep, 0.0, self.horizon_steps)
        left = np.minimum(place.astype(np.intp), self.horizon_steps - 1)
        share = (place - left)[:, None]
        between = [one[:, left] + share * (one[:, left + 1] - one[:, left]) for one in (position, velocity)]
        return between[0], between[1]

    def _evaluate(
        self,
        weights: Array,
        basis: tuple[Array, Array],
        blend: tuple[Array, Array, Array, Array] | None,
        position: Array,
        velocity: Array,
    ) -> None:
        """Fill position and velocity, (n, rows, joints) each, from weights (n, size) and a basis of as many rows."""
        index, sign = self._expansion
        w = weights.reshape(len(weights), self.independent_joints, self.kernels.kernels)
        # sum_i w_i Phi_i = w_1 + sum_i (w_i - w_1) Phi_i, as Phi sums to one: exact where all weights are equal
        start = w[:, :, 0]
        deviation = np.ascontiguousarray((w - start[:, :, None])[:, index].transpose(0, 2, 1))
        # a stacked matmul is one product of the same shape per trial, whatever n: no bit depends on the batch
        np.matmul(basis[0], deviation, out=position)
        position += start[:, None, index]
        np.matmul(basis[1], deviation, out=velocity)
        # two columns of one product may differ in the last bit even if their weights agree, so followers are copied
        for joint, leader in enumerate(self.leaders[index]):
            if joint != leader:
                np.multiply(position[:, :, leader], sign[joint], out=position[:, :, joint])
                np.multiply(velocity[:, :, leader], sign[joint], out=velocity[:, :, joint])
        if blend is not None:
            factor, added, factor_rate, added_rate = blend
            velocity *= factor
            velocity += factor_rate * position
            velocity += added_rate
            position *= factor
            position += added

    def bound(self, position: Array, velocity: Array) -> None:
        """Clip references to the bounds of ``within``, at rest where they were beyond, and slow them down to ``slew``.

        Args:
            position: References at the end of each step up to the horizon [rad], shape (n, rows, joints); written to.
            velocity: Their rates [rad/s], of the same shape; written to.
        """
        if self._ends_of_ranges is not None:
            lower, upper = self._ends_of_ranges
            velocity[(position < lower) | (position > upper)] = 0.0
            np.clip(position, lower, upper, out=position)
        if self.slew is not None:
            self.slew.limit(position, velocity, self.timestep)

    @property
    def bounded(self) -> bool:
        """Whether ``within`` or ``slew`` bounds the references."""
        return self.within is not None or self.slew is not None

    @cached_property
    def _ends_of_ranges(self) -> Array | None:
        return None if self.within is None else np.array(self.within)

    def initial_weights(self, posture: ArrayLike) -> Array:
        """Find the weights that keep a posture: see `hold`.

        Args:
            posture: Joint angles [rad], shape (joints,).

        Returns:
            Policy weights [rad], shape (size,).
        """
        return self.hold(posture)

    def hold(self, posture: ArrayLike) -> Array:
        """Find the weights that keep a posture, the paper's start for rearing.

        Args:
            posture: Joint angles [rad], shape (joints,). Legs that share a policy need not mirror each other: each
                independent joint takes the mean of the leader's angle and its followers' mirrored ones.

        Returns:
            Policy weights [rad], shape (size,).

        Raises:
            LevadeError: If the posture has another shape or is not finite.
        """
        return np.repeat(self.project(self._posture(posture)), self.kernels.kernels)

    def interpolate(self, start: ArrayLike, goal: ArrayLike, *, through: Sequence[ArrayLike] = ()) -> Array:
        """Find the weights of a straight line from one posture to another, the paper's start for posture recovery.

        With 16 kernels of variance 0.01, normalised, the reference strays from the line by less than 0.5 % of the way, and
        the outermost weights overshoot it by a sixth of the way. Wider kernels overshoot more: by the whole way for 0.01 s^2
        at T = 0.3 s.

        Args:
            start: Joint angles at t = 0 [rad], shape (joints,), projected onto the groups as `hold` does.
            goal: Joint angles at t = T [rad], shape (joints,), projected in the same way.
            through: Postures on the way [rad], at equal distances in time. The line is straight from each to the next.

        Returns:
            Policy weights [rad], shape (size,): a least-squares fit to the line that also keeps the weights near it, see
            `fit`.

        Raises:
            LevadeError: If a posture has another shape or is not finite.
        """
        first, last = self._posture(start), self._posture(goal)
        share = np.arange(1, self.horizon_steps + 1) / self.horizon_steps
        if not len(through):
            return self.fit((first + share[:, None] * (last - first))[None], cutoff=LINE_CUTOFF)[0]
        postures = np.array([first, *map(self._posture, through), last])
        at = np.linspace(0.0, 1.0, len(postures))
        line = np.stack([np.interp(share, at, angles) for angles in postures.T], axis=-1)
        return self.fit(line[None], cutoff=LINE_CUTOFF)[0]

    def fit(self, position: Array, *, cutoff: float = FIT_CUTOFF) -> Array:
        """Find the weights whose reference is nearest to given joint motions, by least squares over the steps.

        Many weights fit about equally well if kernels overlap widely. The result is nearest to the motion sampled at the
        kernel means; others may lie far outside the motion.

        Args:
            position: Joint angles at the end of each step [rad], shape (n, horizon_steps, joints).
            cutoff: Directions of the basis weaker than this share of its strongest are not used. A larger value keeps the
                weights nearer to the motion, and fits less exactly.

        Returns:
            Policy weights [rad], shape (n, size).

        Raises:
            LevadeError: If the motions have another shape.
        """
        position = np.asarray(position, dtype=np.float64)
        if position.ndim != 3 or position.shape[1:] != (self.horizon_steps, self.joints):
            raise LevadeError(f"position: expected (n, {self.horizon_steps}, {self.joints}), got {position.shape}")
        leader = self.project(position).transpose(0, 2, 1)
        rows = np.clip(np.round(self.kernels.means * self.horizon_steps).astype(int) - 1, 0, None)
        sampled = leader[:, :, rows]
        deviation = sampled - sampled[:, :, :1]
        missed = leader - sampled[:, :, :1] - deviation @ self.basis[0].T
        return (sampled + missed @ np.linalg.pinv(self.basis[0], rcond=cutoff).T).reshape(len(position), self.size)

    def imitate(self, position: Array) -> Array:
        """Find the weights whose reference, blended at its ends, is nearest to given joint motions.

        `fit` does the same for the kernels alone. Rows in which the blend leaves little of the kernels' reference count
        little, whatever the given motions do there.

        Args:
            position: Joint angles at the end of each step up to the horizon [rad], shape (n, horizon_steps, joints).

        Returns:
            Policy weights [rad], shape (n, size).
        """
        if self._blend is None:
            return self.fit(position)
        factor, added = self._blend[0][:, 0], self._blend[1]
        heard = np.flatnonzero(factor > _HEARD)
        nearest = heard[np.abs(np.arange(len(factor))[:, None] - heard).argmin(axis=1)]
        wanted = ((position - added) / np.maximum(factor, _HEARD)[:, None])[:, nearest]
        leader = self.project(wanted).transpose(0, 2, 1)
        rows = np.clip(np.round(self.kernels.means * self.horizon_steps).astype(int) - 1, 0, None)
        sampled = leader[:, :, rows]
        missed = (leader - sampled[:, :, :1] - (sampled - sampled[:, :, :1]) @ self.basis[0].T) * factor
        solve = np.linalg.pinv(factor[:, None] * self.basis[0], rcond=FIT_CUTOFF)
        return (sampled + missed @ solve.T).reshape(len(position), self.size)

    def project(self, angles: Array) -> Array:
        """Average each leader's angle with the mirrored ones of its followers.

        Args:
            angles: Joint angles [rad], shape (..., joints).

        Returns:
            Angles of the independent joints [rad], shape (..., independent_joints).
        """
        index, sign = self._expansion
        mirrored = angles * sign
        leaders = [mirrored[..., index == i] for i in range(self.independent_joints)]
        # the mean as first + mean deviation: exact where the legs agree
        return np.stack([a[..., 0] + (a - a[..., :1]).mean(axis=-1) for a in leaders], axis=-1)

    def following(self, independent: int) -> list[tuple[int, float]]:
        """Find the joints of the robot that follow an independent joint.

        Args:
            independent: Index of the independent joint.

        Returns:
            Index and sign of each joint that follows it.
        """
        index, sign = self._expansion
        leader = self.leaders[independent]
        return [(int(joint), float(sign[joint])) for joint in np.flatnonzero(index == independent) if joint != leader]

    def spread(self, angles: Array) -> Array:
        """Spread the angles of independent joints over all joints: followers mirror their leaders.

        Args:
            angles: Angles of the independent joints [rad], shape (..., independent_joints).

        Returns:
            Joint angles [rad], shape (..., joints).
        """
        index, sign = self._expansion
        return angles[..., index] * sign

    def _posture(self, posture: ArrayLike) -> Array:
        angles = np.asarray(posture, dtype=np.float64)
        if angles.shape != (self.joints,) or not np.isfinite(angles).all():
            raise LevadeError(f"posture: expected {self.joints} finite angles, got {angles.tolist()}")
        return angles

    def _checked(self, weights: Array) -> Array:
        weights = np.asarray(weights, dtype=np.float64)
        if weights.ndim != 2 or weights.shape[1] != self.size:
            raise LevadeError(
                f"weights: expected (n, {self.size}), {self.independent_joints} joints x {self.kernels.kernels}"
                f" kernels, got {weights.shape}" + ("; add an axis: weights[None]" if weights.ndim == 1 else "")
            )
        if not np.isfinite(weights).all():
            bad = np.flatnonzero(~np.isfinite(weights).all(axis=1)).tolist()
            raise LevadeError(f"weights: trials {bad} are not finite; give finite angles in rad")
        return weights


def refine(weights: Array, old: Policy, new: Policy) -> Array:
    """Find weights of another policy, usually with more kernels, that best reproduce the same references.

    Args:
        weights: Weights of the old policy [rad], shape (n, old.size).
        old: The old policy.
        new: The new policy. Its kernels and groups may differ.

    Returns:
        Weights of the new policy [rad], shape (n, new.size): see `Policy.fit`.

    Raises:
        LevadeError: If the policies differ in joints, horizon or time step.
    """
    if (old.joints, old.horizon_steps, old.timestep) != (new.joints, new.horizon_steps, new.timestep):
        raise LevadeError(
            f"refine: the old policy has {old.joints} joints and {old.horizon_steps} steps of {old.timestep} s, the new one"
            f" {new.joints} joints and {new.horizon_steps} steps of {new.timestep} s; give both the same"
        )
    return new.fit(old.reference(weights, hold_steps=0).position)
