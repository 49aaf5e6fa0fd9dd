"""Initial guesses: a search may begin around earlier motions, around weights, or with a distribution.

guess = initial_guess(objective, [Motion.load("rearing/motion.npz")])
solution = solve(objective, initial=guess)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion
from levade.optimizers import SearchSpace
from levade.policies import FreePolicy, JointPolicy, Policy


@dataclass(frozen=True, eq=False)
class InitialGuess:
    """Weights to begin around. The search tries all of them first; the optimizer begins around the best.

    Attributes:
        candidates: Policy weights [rad], shape (k, d).
        step: Factor on the optimizer's initial step size.
        factor: Square root of the initial covariance, without the step, shape (d, m). None keeps the task's own.
    """

    candidates: Array
    step: float = 1.0
    factor: Array | None = None

    def __post_init__(self) -> None:
        if self.candidates.ndim != 2 or not len(self.candidates) or not np.isfinite(self.candidates).all():
            raise LevadeError(
                f"initial: weights should be finite numbers of shape (motions, d), got shape {self.candidates.shape}"
            )
        if not (np.isfinite(self.step) and self.step > 0):
            raise LevadeError(f"initial: the factor on the step is {self.step}; give a positive number")

    def to_json(self) -> dict[str, Any]:
        """Return plain lists; floats survive JSON to the bit."""
        factor = None if self.factor is None else self.factor.tolist()
        return {"candidates": self.candidates.tolist(), "step": self.step, "factor": factor}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> InitialGuess:
        """Read the guess that `to_json` wrote.

        Args:
            content: What a checkpoint's header holds.

        Raises:
            LevadeError: If the content is no guess.
        """
        try:
            factor = None if content["factor"] is None else np.array(content["factor"], dtype=float)
            guess = cls(np.array(content["candidates"], dtype=float), float(content["step"]), factor)
        except (ValueError, TypeError, LookupError, OverflowError):
            raise LevadeError("initial: this is no guess that a run wrote") from None
        size = guess.candidates.shape[1]
        if factor is not None and not (factor.ndim == 2 and len(factor) == size and np.isfinite(factor).all()):
            raise LevadeError(f"initial: the factor should be finite numbers of shape ({size}, m)")
        return guess

    def space(self, space: SearchSpace, mean: Array) -> SearchSpace:
        """Move a search space to one of the candidates.

        Args:
            space: The task's search space.
            mean: The candidate, shape (d,).
        """
        around = replace(space, mean=mean, step=space.step * self.step)
        return around if self.factor is None else replace(around, factor=self.factor, rough=None)


AROUND = 0.5
"""Factor on the initial step size around motions: the solution is near, so the search needs smaller steps."""


def initial_guess(policy: JointPolicy, given: Motion | Array | InitialGuess | Sequence[Motion | Array]) -> InitialGuess:
    """Make an initial guess from what a caller gives.

    Args:
        policy: Policy of the search that begins there.
        given: A motion with any kernels, horizon and groups; policy weights [rad], shape (size,) or (k, size); a sequence of
            these; or an `InitialGuess`, which is returned as it is.

    Raises:
        LevadeError: If a motion moves other joints than the policy's robot, or weights have another shape.
    """
    if isinstance(given, InitialGuess):
        return given
    several = [given] if isinstance(given, Motion | np.ndarray) else list(given)
    if not several:
        raise LevadeError("initial: is empty; give motions or weights, or leave it out")
    rows = []
    for one in several:
        weights = fitted(policy, one) if isinstance(one, Motion) else np.atleast_2d(np.asarray(one, dtype=float))
        if weights.ndim != 2 or weights.shape[1] != policy.size:
            raise LevadeError(f"initial: weights have shape {weights.shape}, should be (k, {policy.size})")
        rows.append(weights)
    return InitialGuess(np.concatenate(rows), step=AROUND)


def fitted(policy: JointPolicy, motion: Motion) -> Array:
    """Fit policy weights [rad] to a motion, shape (1, size): their reference is nearest to the motion's.

    A motion of another duration is stretched to the policy's horizon. A policy with a free horizon takes the motion's duration,
    within its bounds. Weights that already give the motion are kept as they are.

    Args:
        policy: Policy to fit.
        motion: Motion to imitate.

    Raises:
        LevadeError: If the motion moves another number of joints, or the policy cannot be fitted.
    """
    position = motion["joint_position_reference"][: motion.horizon_steps]
    if position.shape[1] != policy.joints:
        raise LevadeError(
            f"initial: the motion moves {position.shape[1]} joints, the task's robot has {policy.joints}; give a motion of"
            " the same robot"
        )
    if isinstance(policy, FreePolicy):
        steps = int(np.clip(len(position), *policy.bounds))
        own = motion.policy
        if own is not None and own.size == policy.policy.size and steps == len(position):
            goal = None if policy.goal is None or own.ends is None else own.ends.goal
            decision = policy.decision(motion["weights"][None], steps=steps, goal=goal)
            if np.allclose(policy.reference(decision, hold_steps=0).position[0, :steps], position, rtol=0, atol=1e-12):
                return decision
        return policy.imitate(_stretched(position, steps))
    weights = motion["weights"][None]
    if weights.shape[1] == policy.size and len(position) == policy.horizon_steps:
        same = policy.reference(weights, hold_steps=0).position[0]
        if np.array_equal(same, position):
            return weights
    if not isinstance(policy, Policy):
        raise LevadeError("initial: levade cannot fit a custom policy to a motion; give weights instead")
    return policy.imitate(_stretched(position, policy.horizon_steps)[None])


def _stretched(position: Array, steps: int) -> Array:
    """Resample a joint motion to another number of steps [rad], shape (steps, joints)."""
    share = np.arange(1, steps + 1) / steps * len(position)
    rows = np.arange(1, len(position) + 1)
    return np.stack([np.interp(share, rows, angle) for angle in position.T], axis=1)
