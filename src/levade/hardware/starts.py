"""Draw rough motions through postures of the legs, which a search within limits tries first. It begins around the best one.

    guess = rough_start(objective, seed=0)      # an InitialGuess with all of them

A search around standing finds motions near to standing. A jump begins with a crouch, which raises the cost before it lowers it,
so no small step leads there. Rough motions therefore shorten and stretch the legs to random lengths, a new one for each kernel,
and have random durations.
"""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array
from levade.policies import FreePolicy, JointPolicy, Policy
from levade.robots import Robot
from levade.search import Objective
from levade.search.initial import AROUND, InitialGuess

ROUGH = 120
"""Number of rough motions. Half of them are drawn as the first candidates of a usual search are."""

_SPREAD = 0.1
"""Standard deviation of the noise that is added to postures [rad]."""

_TAG = 1_919_907_432
"""Separates its random numbers from those of the search."""


def rough_start(objective: Objective, *, seed: int) -> InitialGuess:
    """Draw the rough motions that a search tries before its optimizer begins around the best of them.

    Args:
        objective: Objective of the search.
        seed: Seed of the search.

    Returns:
        A guess with the decisions of all motions, shape (`ROUGH`, d).
    """
    generator = np.random.default_rng((seed, _TAG))
    space = objective.space
    drawn = space.candidates(space.step * generator.standard_normal((ROUGH // 2, space.dimensions)))
    through = through_postures(objective.policy, objective.simulation.robot, ROUGH - ROUGH // 2, generator)
    return InitialGuess(drawn if through is None else np.concatenate([through, drawn]), step=AROUND)


def through_postures(policy: JointPolicy, robot: Robot, n: int, generator: np.random.Generator) -> Array | None:
    """Draw decisions of motions whose legs have a random length at each kernel, between crouched and stretched.

    In half of the motions all legs have equal lengths.

    Args:
        policy: Policy that turns decisions into references.
        robot: Its robot.
        n: Number of motions.
        generator: Source of random numbers.

    Returns:
        Decisions, shape (n, d). None if the policy has no kernels or the robot has no such postures.
    """
    inner = policy.policy if isinstance(policy, FreePolicy) else policy
    if not isinstance(inner, Policy) or not {"crouched", "stretched"} <= set(robot.postures):
        return None
    crouched, neutral, stretched = (inner.project(robot.posture(name)) for name in ("crouched", "neutral", "stretched"))
    group = np.repeat(np.arange(len(inner.groups)), [len(one.leader) for one in inner.groups])
    kernels = inner.kernels.kernels
    length = generator.uniform(-1.0, 1.0, (n, len(inner.groups), kernels))
    length[: n // 2] = length[: n // 2, :1]
    extended = length[:, group]  # (n, independent joints, kernels): -1 is crouched, 0 is neutral, 1 is stretched
    towards = np.where(extended < 0, (crouched - neutral)[:, None], (stretched - neutral)[:, None])
    weights = neutral[:, None] + np.abs(extended) * towards + _SPREAD * generator.standard_normal(extended.shape)
    flat = weights.reshape(n, inner.size)
    if not isinstance(policy, FreePolicy):
        return flat
    shortest, longest = policy.bounds
    steps = np.exp(generator.uniform(math.log(shortest), math.log(longest), n))
    steps = np.clip(np.rint(steps), shortest, longest).astype(int)
    return np.concatenate([policy.decision(row[None], steps=int(k)) for row, k in zip(flat, steps, strict=True)])
