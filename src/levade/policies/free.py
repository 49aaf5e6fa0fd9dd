"""A policy whose duration is a decision of each trial, next to its weights.

    free = FreePolicy(policy, horizon=(0.3, 1.5))
    reference = free.reference(decisions)               # each trial has its own horizon
    policy, weights = free.chosen(decisions[0])         # one of the trials, as a policy of that duration

A decision is the policy's weights and, last, ``log(T / T0)`` with T0 the policy's own horizon. Beyond the bounds it counts as
the bound. Kernels and blends stay spread over [0, T].
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies.policy import Policy
from levade.trajectory import JointReference

_KEPT = 64
"""Policies of different durations that are kept: each has a basis of its own."""


@dataclass(frozen=True, eq=False)
class FreePolicy:
    """A policy of which each trial has a duration of its own.

    Attributes:
        policy: The policy at the duration where a search begins.
        horizon: Least and largest T [s].

    Raises:
        LevadeError: If the bounds do not enclose the policy's own horizon.
    """

    policy: Policy
    horizon: tuple[float, float]
    _made: dict[int, Policy] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        least, largest = self.horizon
        if not 0 < least <= self.policy.horizon <= largest < math.inf:
            raise LevadeError(
                f"horizon: {least} to {largest} s should be positive bounds around the policy's own, {self.policy.horizon} s"
            )

    @property
    def size(self) -> int:
        """d, the number of decisions of one trial."""
        return self.policy.size + 1

    @property
    def joints(self) -> int:
        """Joints of the robot."""
        return self.policy.joints

    @property
    def timestep(self) -> float:
        """Time step [s]."""
        return self.policy.timestep

    @property
    def bounds(self) -> tuple[int, int]:
        """Rows up to the shortest and the longest horizon."""
        shortest, longest = (max(1, round(bound / self.timestep)) for bound in self.horizon)
        return shortest, longest

    @property
    def horizon_steps(self) -> int:
        """Rows up to the longest horizon."""
        return self.bounds[1]

    def lengths(self, decisions: Array) -> NDArray[np.intp]:
        """Rows up to the horizon of each trial, shape (n,)."""
        least, largest = (math.log(bound / self.policy.horizon) for bound in self.horizon)
        ratio = np.exp(np.clip(decisions[:, -1], least, largest))
        return np.clip(np.rint(self.policy.horizon * ratio / self.timestep), *self.bounds).astype(np.intp)

    def at(self, steps: int) -> Policy:
        """The policy of a horizon of so many steps."""
        if steps not in self._made:
            if len(self._made) >= _KEPT:
                self._made.clear()
            self._made[steps] = replace(self.policy, horizon=steps * self.timestep)
        return self._made[steps]

    def chosen(self, decision: Array) -> tuple[Policy, Array]:
        """The policy of one decision, shape (size,), with its duration; and the weights, shape (policy.size,)."""
        checked = self._checked(np.asarray(decision)[None])
        return self.at(int(self.lengths(checked)[0])), checked[0, :-1].copy()

    def decision(self, weights: Array, steps: int) -> Array:
        """Decisions from weights, shape (n, policy.size), and a horizon of so many steps; shape (n, size)."""
        duration = math.log(steps * self.timestep / self.policy.horizon)
        return np.concatenate([weights, np.full((len(weights), 1), duration)], axis=1)

    def initial_weights(self, posture: ArrayLike) -> Array:
        """Decisions that keep a posture through the initial duration."""
        return self.decision(self.policy.hold(posture)[None], self.policy.horizon_steps)[0]

    def reference(self, weights: Array, *, hold_steps: int | None = None) -> JointReference:
        """Evaluate eq. 3 for trials of different durations.

        A trial has the same bits as `Policy.reference` gives it at its duration.

        Args:
            weights: Decisions, shape (n, size).
            hold_steps: Rows after each horizon. Defaults to the policy's own.

        Returns:
            Position [rad] and velocity [rad/s] of horizon_steps + hold_steps rows; rows after a trial's own horizon and hold
            stay at its last position.

        Raises:
            LevadeError: If the decisions have another shape or are not finite.
        """
        decisions = self._checked(weights)
        hold = self.policy.hold_steps if hold_steps is None else hold_steps
        lengths = self.lengths(decisions)
        position = np.empty((len(decisions), self.horizon_steps + hold, self.joints))
        velocity = np.zeros_like(position)
        for steps in np.unique(lengths):
            trials = np.flatnonzero(lengths == steps)
            one = self.at(int(steps)).reference(decisions[trials, :-1], hold_steps=hold)
            position[trials, : one.steps], velocity[trials, : one.steps] = one.position, one.velocity
            position[trials, one.steps :] = one.position[:, -1:]
        return JointReference(position, velocity, self.timestep, self.horizon_steps, horizons=lengths)

    def _checked(self, decisions: Array) -> Array:
        decisions = np.asarray(decisions, dtype=np.float64)
        if decisions.ndim != 2 or decisions.shape[1] != self.size:
            raise LevadeError(
                f"weights: expected (n, {self.size}), {self.policy.size} weights and the duration, got {decisions.shape}"
            )
        if not np.isfinite(decisions).all():
            bad = np.flatnonzero(~np.isfinite(decisions).all(axis=1)).tolist()
            raise LevadeError(f"weights: trials {bad} are not finite")
        return decisions
