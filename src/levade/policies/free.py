"""A policy whose duration, final posture, or both are decisions of each trial, next to its weights.

    free = FreePolicy(policy, horizon=(0.3, 1.5))
    reference = free.reference(decisions)               # each trial has its own horizon
    policy, weights = free.chosen(decisions[0])         # one of the trials, as a policy of that duration

The decisions of a trial are, one after another:

- the policy's weights [rad];
- ``log(T / T0)``, with T0 the policy's own horizon, if the duration is free;
- the angles in which the free joints settle [rad], if the final posture is (`FreeGoal`).

A decision beyond a bound counts as the bound. Kernels and blends stay spread over [0, T].
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
"""Number of policies of different durations that are kept: each has a basis of its own."""


@dataclass(frozen=True, eq=False)
class FreeGoal:
    """Joints whose final angle the search finds: joints of leaders, which the followers mirror.

    Attributes:
        joints: Indices of the policy's independent joints, shape (k,).
        lower: Least angle of each [rad], shape (k,).
        upper: Largest angle of each [rad], shape (k,).

    Raises:
        LevadeError: If a lower bound is above its upper one, or not finite.
    """

    joints: NDArray[np.intp]
    lower: Array
    upper: Array

    def __post_init__(self) -> None:
        if not (np.isfinite(self.lower).all() and np.isfinite(self.upper).all() and (self.lower <= self.upper).all()):
            raise LevadeError(
                f"goal: bounds {self.lower.tolist()} to {self.upper.tolist()} rad make no range; give finite bounds, the"
                " lower one first"
            )


@dataclass(frozen=True, eq=False)
class FreePolicy:
    """A policy in which each trial has a duration or a final posture of its own.

    Attributes:
        policy: Policy with the duration and final posture with which a search begins.
        horizon: Least and largest T [s]; None if it is the policy's own.
        goal: Joints whose final angle is free; None if all settle where the policy's ``ends`` say.

    Raises:
        LevadeError: If nothing is free, the bounds do not enclose the policy's own horizon, or the goal is free and nothing
            settles there.
    """

    policy: Policy
    horizon: tuple[float, float] | None = None
    goal: FreeGoal | None = None
    _made: dict[int, Policy] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if self.horizon is None and self.goal is None:
            raise LevadeError("free policy: neither the horizon nor the goal is free; use a Policy")
        if self.horizon is not None and not 0 < self.horizon[0] <= self.policy.horizon <= self.horizon[1] < math.inf:
            raise LevadeError(
                f"horizon: {self.horizon[0]} to {self.horizon[1]} s should be positive bounds around the policy's own,"
                f" {self.policy.horizon} s"
            )
        if self.goal is not None and (self.policy.ends is None or self.policy.ends.settle == 0):
            raise LevadeError("goal: is free, but no reference settles there; set settle to a share of the horizon")

    @property
    def size(self) -> int:
        """Number of decisions of one trial, d."""
        return self.policy.size + (self.horizon is not None) + (0 if self.goal is None else len(self.goal.joints))

    @property
    def joints(self) -> int:
        """Number of the robot's joints."""
        return self.policy.joints

    @property
    def timestep(self) -> float:
        """Time step [s]."""
        return self.policy.timestep

    @property
    def bounds(self) -> tuple[int, int]:
        """Rows up to the shortest and the longest horizon."""
        bounds = (self.policy.horizon, self.policy.horizon) if self.horizon is None else self.horizon
        shortest, longest = (max(1, round(bound / self.timestep)) for bound in bounds)
        return shortest, longest

    @property
    def horizon_steps(self) -> int:
        """Rows up to the longest horizon."""
        return self.bounds[1]

    @property
    def span(self) -> Array:
        """Bounds of the decisions after the weights, shape (size - policy.size, 2): ``log(T / T0)``, then angles [rad]."""
        rows = []
        if self.horizon is not None:
            rows.append(np.log(np.array([self.bounds]) * self.timestep / self.policy.horizon))
        if self.goal is not None:
            rows.append(np.stack([self.goal.lower, self.goal.upper], axis=-1))
        return np.concatenate(rows)

    def lengths(self, decisions: Array) -> NDArray[np.intp]:
        """Find the horizon of each trial.

        Args:
            decisions: Decisions, shape (n, size).

        Returns:
            Rows up to the horizon, shape (n,).
        """
        if self.horizon is None:
            return np.full(len(decisions), self.horizon_steps, dtype=np.intp)
        least, largest = (math.log(bound / self.policy.horizon) for bound in self.horizon)
        ratio = np.exp(np.clip(decisions[:, self.policy.size], least, largest))
        return np.clip(np.rint(self.policy.horizon * ratio / self.timestep), *self.bounds).astype(np.intp)

    def goals(self, decisions: Array) -> Array:
        """Find the posture in which each trial settles.

        Args:
            decisions: Decisions, shape (n, size).

        Returns:
            Joint angles [rad], shape (n, joints).
        """
        ends = self.policy.ends
        assert ends is not None
        return ends.goal + self._moved(decisions)

    def chosen(self, decision: Array) -> tuple[Policy, Array]:
        """Make the policy that one trial decides on.

        Args:
            decision: Decisions of one trial, shape (size,).

        Returns:
            A policy with this duration and final posture, and its weights [rad], shape (policy.size,).

        Raises:
            LevadeError: If the decisions have another shape or are not finite.
        """
        checked = self._checked(np.asarray(decision)[None])
        policy = self._at(int(self.lengths(checked)[0]))
        if self.goal is not None and policy.ends is not None:
            policy = replace(policy, ends=replace(policy.ends, goal=self.goals(checked)[0]))
        return policy, checked[0, : policy.size].copy()

    def decision(self, weights: Array, *, steps: int | None = None, goal: Array | None = None) -> Array:
        """Join weights, a duration and a final posture into decisions.

        Args:
            weights: Policy weights [rad], shape (n, policy.size).
            steps: Rows up to the horizon. Defaults to the policy's own.
            goal: Final posture [rad], shape (joints,). Defaults to the policy's own.

        Returns:
            Decisions, shape (n, size).
        """
        parts = [weights]
        if self.horizon is not None:
            ratio = (self.policy.horizon_steps if steps is None else steps) * self.timestep / self.policy.horizon
            parts.append(np.full((len(weights), 1), math.log(ratio)))
        if self.goal is not None and self.policy.ends is not None:
            angles = self.policy.project(self.policy.ends.goal if goal is None else goal)[self.goal.joints]
            parts.append(np.repeat(np.clip(angles, self.goal.lower, self.goal.upper)[None], len(weights), axis=0))
        return np.concatenate(parts, axis=1)

    def imitate(self, position: Array) -> Array:
        """Find the decisions whose reference is nearest to a given joint motion.

        Args:
            position: Joint angles at the end of each step [rad], shape (steps, joints); the steps are within `bounds`.

        Returns:
            Decisions, shape (1, size).
        """
        goal = position[-1] if self.goal is not None else None
        near = self.decision(np.zeros((1, self.policy.size)), steps=len(position), goal=goal)
        near[:, : self.policy.size] = self.chosen(near[0])[0].imitate(position[None])
        return near

    def initial_weights(self, posture: ArrayLike) -> Array:
        """Find the decisions that keep a posture for the initial duration.

        Args:
            posture: Joint angles [rad], shape (joints,).

        Returns:
            Decisions, shape (size,).
        """
        return self.decision(self.policy.hold(posture)[None])[0]

    def reference(self, weights: Array, *, hold_steps: int | None = None) -> JointReference:
        """Evaluate eq. 3 for trials of different durations and final postures.

        If the final posture is not free, a trial has the same bits as those of `Policy.reference` at its duration.

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
        lengths, moved = self.lengths(decisions), self._moved(decisions) if self.goal is not None else None
        position = np.empty((len(decisions), self.horizon_steps + hold, self.joints))
        velocity = np.zeros_like(position)
        for steps in np.unique(lengths):
            trials = np.flatnonzero(lengths == steps)
            policy = self._at(int(steps))
            # the shift of the end is added before the references are bounded
            plain = policy if moved is None or not policy.bounded else replace(policy, within=None, slew=None)
            one = plain.reference(decisions[trials, : policy.size], hold_steps=hold)
            position[trials, : one.steps], velocity[trials, : one.steps] = one.position, one.velocity
            if moved is not None and policy.ends is not None:
                share, rate = policy.ends.settling(np.arange(1, one.steps + 1) / steps)
                position[trials, : one.steps] += share * moved[trials, None]
                velocity[trials, : one.steps] += rate / (steps * self.timestep) * moved[trials, None]
            if plain is not policy:
                bounded, rate = position[trials, :steps], velocity[trials, :steps]
                policy.bound(bounded, rate)
                position[trials, :steps], velocity[trials, :steps] = bounded, rate
                position[trials, steps : one.steps] = bounded[:, -1:]
            position[trials, one.steps :] = position[trials, one.steps - 1][:, None]
        horizons = None if self.horizon is None else lengths
        return JointReference(position, velocity, self.timestep, self.horizon_steps, horizons=horizons)

    def _at(self, steps: int) -> Policy:
        """The policy whose horizon has this many steps."""
        if steps == self.policy.horizon_steps:
            return self.policy
        if steps not in self._made:
            if len(self._made) >= _KEPT:
                self._made.clear()
            self._made[steps] = replace(self.policy, horizon=steps * self.timestep)
        return self._made[steps]

    def _moved(self, decisions: Array) -> Array:
        """Find the distance of each trial's final posture from the policy's own [rad], shape (n, joints)."""
        goal, ends = self.goal, self.policy.ends
        assert goal is not None
        assert ends is not None
        own = self.policy.project(ends.goal)
        moved = np.zeros((len(decisions), self.policy.independent_joints))
        angles = np.clip(decisions[:, -len(goal.joints) :], goal.lower, goal.upper)
        moved[:, goal.joints] = angles - own[goal.joints]
        return self.policy.spread(moved)

    def _checked(self, decisions: Array) -> Array:
        decisions = np.asarray(decisions, dtype=np.float64)
        if decisions.ndim != 2 or decisions.shape[1] != self.size:
            raise LevadeError(
                f"weights: expected (n, {self.size}), {self.policy.size} weights and the other decisions, got"
                f" {decisions.shape}"
            )
        if not np.isfinite(decisions).all():
            bad = np.flatnonzero(~np.isfinite(decisions).all(axis=1)).tolist()
            raise LevadeError(f"weights: trials {bad} are not finite; give finite numbers")
        return decisions
