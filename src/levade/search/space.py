"""Make the search space of a task: the first distribution of its decisions."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines import State
from levade.optimizers import SearchSpace
from levade.policies import FreePolicy, JointPolicy, Policy, smoothness_factor
from levade.robots import Robot, dimensions
from levade.tasks import Task
from levade.tasks.policy import goal_posture, has_ranges, through_postures

ENDING = 0.25
"""Share of the horizon that an optimizer may change alone, as the ending of a motion."""

DURATION = 0.08
"""Initial standard deviation of ``log T`` where the duration is a decision."""

DURATION_PER_STEP = 0.3
"""Upper bound of the same per step of the weights [1/rad]: a search close around a motion also stays close to its duration."""


BRACED = 0.1
"""Displacement of the feet relative to each other at which the first step of a final angle is smaller by a factor of 1.4
[heights/rad]."""

SKETCHED = 3
"""Random postures that a sketch goes through."""

SIDEWAYS = 0.3
"""Factor on the first step of joints that turn or spread limbs of a robot that stands upright, if the search has sketches."""

_TO_THE_SIDE = math.cos(math.radians(45.0))
"""Smallest share of an axis along y with which a joint bends a limb forward and back."""


def search_space(task: Task, robot: Robot, policy: JointPolicy, start: State) -> SearchSpace:
    """Make the search space of a task.

    Args:
        task: The task.
        robot: Its robot.
        policy: Policy that turns decisions into references.
        start: State where roll-outs start, one row.
    """
    one_sided = np.array([criterion.target is None for criterion in task.success.values()], dtype=bool)
    if isinstance(policy, FreePolicy):
        space = _of_weights(task, robot, policy.policy, start)
        return _with_more(dataclasses.replace(space, one_sided=one_sided), policy, task, robot)
    if isinstance(policy, Policy):
        return dataclasses.replace(_of_weights(task, robot, policy, start), one_sided=one_sided)
    mean = policy.initial_weights(start.joint_reference[0])
    return SearchSpace(mean, step=task.search.step, population=task.search.population, one_sided=one_sided)


def _of_weights(task: Task, robot: Robot, policy: Policy, start: State) -> SearchSpace:
    search, choice = task.search, task.policy
    if choice.initial == "hold":
        mean = policy.hold(start.joint_reference[0])
    else:
        through = through_postures(choice, robot)
        mean = policy.interpolate(start.joint_position[0], goal_posture(choice, robot), through=through)
    if search.smoothness > 0 or search.modes is not None:
        smooth = smoothness_factor(policy.kernels, search.smoothness, policy.independent_joints, modes=search.modes)
    else:
        smooth = np.eye(policy.size)
    if search.sketches and robot.stance == "upright":
        share = np.where(_bends_forward(robot)[policy.leaders], 1.0, SIDEWAYS)
        smooth = smooth * np.repeat(share, policy.kernels.kernels)[:, None]
    space = SearchSpace(mean, smooth, step=search.step, population=search.population, ending=_ending(policy))
    if not search.sketches:
        return space
    return dataclasses.replace(space, span=_span(policy, robot), spread=_spread(policy))


def _spread(policy: Policy) -> Array:
    """Return the weights of a motion through a few postures, evenly spaced over the kernels, shape (d, postures * joints)."""
    kernels = policy.kernels.kernels
    postures = min(SKETCHED, kernels)
    at, knots = np.linspace(0.0, 1.0, kernels), np.linspace(0.0, 1.0, postures)
    between = np.stack([np.interp(at, knots, one) for one in np.eye(postures)], axis=-1)
    return np.kron(np.eye(policy.independent_joints), between)


def _span(policy: Policy, robot: Robot) -> Array:
    """Return the ranges that sketches are drawn from, shape (postures * joints, 2): of each joint in each posture [rad].

    A robot that stands upright gets up by bending forward and back: its other joints stay as in neutral.
    """
    leaders = policy.leaders
    lower, upper = robot.limits.lower[leaders], robot.limits.upper[leaders]
    unlimited = np.isinf(lower) | np.isinf(upper)
    span = np.stack([np.where(unlimited, -np.pi, lower), np.where(unlimited, np.pi, upper)], axis=-1)
    if robot.stance == "upright":
        still = ~_bends_forward(robot)[leaders]
        span[still] = robot.posture("neutral")[leaders][still, None]
    return np.repeat(span, min(SKETCHED, policy.kernels.kernels), axis=0)


def _bends_forward(robot: Robot) -> NDArray[np.bool_]:
    """Tell which joints' axes point to the side in the neutral posture, shape (joints,)."""
    data = robot.data_at(robot.posture("neutral"))
    axes = np.array([data.joint(joint).xaxis for joint in robot.joint_names])
    return np.abs(axes[:, 1]) > _TO_THE_SIDE


def _with_more(space: SearchSpace, policy: FreePolicy, task: Task, robot: Robot) -> SearchSpace:
    """Add the policy's further decisions: the spread of a duration is `DURATION`, and that of angles is that of weights.

    They do not belong to the ending of a motion. A duration is rough: it is rounded to time steps, and errors change by more
    than a tight tolerance from one to the next. Where a criterion asks for a duration it is not rough, since that error
    follows it closely. Where no range says where to look for the final posture, angles that push standing feet against each
    other spread less.
    """
    before, (d, m) = space, space.factor.shape
    more = policy.size - d
    factor = np.zeros((d + more, m + more))
    factor[:d, :m], factor[d:, m:] = space.factor, np.eye(more)
    if policy.goal is not None and not has_ranges(task.policy):
        angles = len(policy.goal.joints)
        factor[-angles:, -angles:] = _unbraced(policy, robot)
    rough = None
    if policy.horizon is not None:
        factor[d, m] = min(DURATION / space.step, DURATION_PER_STEP)
        asked = any(criterion.quantity == "duration" for criterion in task.success.values())
        rough = None if asked else np.arange(m + more) == m
    ending = None if space.ending is None else np.pad(space.ending, ((0, 0), (0, more)))
    mean = policy.decision(space.mean[None])[0]
    space = dataclasses.replace(space, mean=mean, factor=factor, ending=ending, rough=rough, span=None, spread=None)
    if before.span is None or before.spread is None:
        return space
    spread = np.zeros((policy.size, before.spread.shape[1] + more))
    spread[:d, :-more], spread[d:, -more:] = before.spread, np.eye(more)
    return dataclasses.replace(space, span=np.concatenate([before.span, policy.span]), spread=spread)


def _unbraced(policy: FreePolicy, robot: Robot) -> Array:
    """Return the factor of final angles, shape (k, k): small in directions in which the feet do not move as one body.

    Feet that stand do not slip. Where angles tell them to move apart, or one of them to leave the ground, stiff joints brace
    them against each other and the ground.
    """
    assert policy.goal is not None
    k, step = len(policy.goal.joints), 1e-3
    decisions = np.tile(policy.decision(np.zeros((1, policy.policy.size))), (k + 1, 1))
    decisions[1:, -k:] += step * np.eye(k)
    feet = np.array([robot.foot_positions(posture) for posture in policy.goals(decisions)]) / dimensions(robot).height
    moved = (feet[1:] - feet[0]).reshape(k, -1) / step
    turned = np.cross(np.eye(3)[:, None], feet[0]).reshape(3, -1)
    as_one = np.concatenate([np.tile(np.eye(3), len(feet[0])), turned])
    braced = moved - moved @ np.linalg.pinv(as_one) @ as_one
    values, vectors = np.linalg.eigh(braced @ braced.T)
    return np.asarray(vectors / np.sqrt(1.0 + values / BRACED**2) @ vectors.T)


def _ending(policy: Policy) -> Array | None:
    """Return a direction for each independent joint, shape (q, d): a ramp over the last quarter of its weights, up to 1.

    None where the policy fixes the end of the motion, whatever the weights (`levade.policies.Ends`).
    """
    if policy.ends is not None and policy.ends.settle > 0:
        return None
    ramp = np.clip(1.0 - (1.0 - np.linspace(0.0, 1.0, policy.kernels.kernels)) / ENDING, 0.0, 1.0)
    return np.kron(np.eye(policy.independent_joints), ramp)
