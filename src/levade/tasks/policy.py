"""Make a task's policy on a robot's joints: groups of legs become groups of joints."""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean, located
from levade.policies import Ends, Follower, FreeGoal, FreePolicy, GaussianKernels, Group, Policy, Slew
from levade.robots import Leg, Robot, mirror_signs
from levade.robots.naming import by_joint, limb_words, require_joints
from levade.tasks.parts import FREE, HorizonRange, PolicyChoice
from levade.tasks.task import Task


def make_policy(task: Task, robot: Robot, *, start: Array | None = None) -> Policy | FreePolicy:
    """Make the task's policy on the robot's joints.

    Args:
        task: The task.
        robot: The robot.
        start: Last commanded posture [rad], shape (joints,). Defaults to the policy's goal.

    Returns:
        The policy; a `levade.policies.FreePolicy` if the horizon or the goal is free.

    Raises:
        LevadeError: If the groups do not fit the robot's legs, or the goal does not fit its joints.
    """
    choice = task.policy
    ends = None
    with located("policy."):
        kernels = GaussianKernels(choice.kernels, choice.variance, choice.time)
    free = _free_ranges(choice, robot) if choice.goal_is_free else None
    if choice.depart or choice.settle:
        goal = goal_posture(choice, robot)
        with located("policy."):
            ends = Ends(goal if start is None else start, goal, choice.depart, choice.settle)
    policy = Policy(
        kernels, leg_groups(choice, robot), task.usual_horizon, task.physics.timestep, task.hold_steps, ends
    )
    if choice.room is not None:
        lower, upper = robot.limits.lower, robot.limits.upper
        room = np.minimum(choice.room, (upper - lower) / 4)  # infinite where a joint has no range
        policy = replace(policy, within=(tuple((lower + room).tolist()), tuple((upper - room).tolist())))
    if choice.slew is not None:
        speed = choice.slew * robot.limits.velocity
        told = goal_posture(choice, robot) if start is None else start
        policy = replace(policy, slew=Slew(tuple(speed.tolist()), tuple(np.asarray(told, dtype=float).tolist())))
    bounds = (task.horizon.minimum, task.horizon.maximum) if isinstance(task.horizon, HorizonRange) else None
    goal = None if free is None else _free_goal(policy, *free, robot)
    return policy if bounds is None and goal is None else FreePolicy(policy, bounds, goal)


def goal_posture(choice: PolicyChoice, robot: Robot) -> Array:
    """Find the posture in which the policy's references settle.

    Args:
        choice: The task's policy.
        robot: The robot.

    Returns:
        Joint angles [rad], shape (joints,). For free joints, the angles with which a search begins.

    Raises:
        LevadeError: If a posture does not exist, or is out of a joint's range.
    """
    if choice.goal == FREE:
        return robot.posture("neutral")
    goal = choice.goal
    if not isinstance(goal, str):
        goal = {
            key: sum(value) / 2 if isinstance(value, tuple) else value for key, value in goal.items() if value != FREE
        }
        for key in goal:
            _joints_named(key, robot)
    for value in [goal] if isinstance(goal, str) else goal.values():
        if isinstance(value, str) and value not in robot.posture_names:
            raise LevadeError(f"policy.goal: no posture {value!r}; {did_you_mean(value, [*robot.posture_names, FREE])}")
    with located("policy.goal: "):
        return robot.posture(goal)


def through_postures(choice: PolicyChoice, robot: Robot) -> list[Array]:
    """Find the postures that the policy's first references go through.

    Args:
        choice: The task's policy.
        robot: The robot.

    Returns:
        Joint angles [rad], shape (joints,) each, in order.

    Raises:
        LevadeError: If a posture does not exist, or is out of a joint's range.
    """
    found = []
    for i, posture in enumerate(choice.through):
        with located(f"policy.through.{i}: "):
            found.append(robot.posture(posture))
    return found


def _free_ranges(choice: PolicyChoice, robot: Robot) -> tuple[Array, Array]:
    """Find the bounds of the final angle of each joint [rad], shape (joints,) each; NaN for joints that are not free.

    Raises:
        LevadeError: If a leg or joint does not exist, a range is out of the joint's own, or a joint without one is free.
    """
    names, limits = robot.joint_names, robot.limits
    lower, upper = np.full(len(names), np.nan), np.full(len(names), np.nan)
    table = choice.goal if isinstance(choice.goal, Mapping) else dict.fromkeys((leg.name for leg in robot.legs), FREE)
    for key, value in table.items():
        if value != FREE and not isinstance(value, tuple):
            continue
        if isinstance(value, tuple):
            by_joint(robot, dict.fromkeys([key], 0.0), "policy.goal")  # a range is for joints, as a number is
        for joint, sign in _joints_named(key, robot).items():
            least, largest = limits.lower[joint], limits.upper[joint]
            if not isinstance(value, tuple):
                lower[joint], upper[joint] = least, largest
                continue
            if value[0] > value[1]:
                raise LevadeError(f"policy.goal.{key}: {list(value)} should be [lowest, highest]")
            low, high = value if sign > 0 else (-value[1], -value[0])
            if not least <= low <= high <= largest:
                raise LevadeError(
                    f"policy.goal.{key}: {low:.4g} to {high:.4g} rad should be a range within that of {names[joint]},"
                    f" {least:.4g} to {largest:.4g} rad"
                )
            lower[joint], upper[joint] = low, high
    unlimited = np.flatnonzero(np.isinf(lower) | np.isinf(upper))
    if unlimited.size:
        name = names[unlimited[0]]
        raise LevadeError(f'policy.goal: {name} is free and has no range; give one: goal: {{"{name}": [-1.0, 1.0]}}')
    return lower, upper


def has_ranges(choice: PolicyChoice) -> bool:
    """Tell whether ranges say where a free final posture is.

    Args:
        choice: The task's policy.
    """
    return isinstance(choice.goal, Mapping) and any(isinstance(value, tuple) for value in choice.goal.values())


def _free_goal(policy: Policy, lower: Array, upper: Array, robot: Robot) -> FreeGoal:
    """Intersect the free range of each independent joint with those of the joints that follow it.

    Raises:
        LevadeError: If only some of the joints that share a policy are free.
    """
    leaders = policy.leaders
    low, high = lower[leaders], upper[leaders]
    for i, joint in enumerate(leaders):
        for follower, sign in policy.following(i):
            if np.isnan(lower[follower]) != np.isnan(lower[joint]):
                names = robot.joint_names[joint], robot.joint_names[follower]
                raise LevadeError(
                    f"policy.goal: {names[0]} and {names[1]} share a policy, but only one of them is free"
                )
            ends = sorted((sign * lower[follower], sign * upper[follower]))
            low[i], high[i] = max(low[i], ends[0]), min(high[i], ends[1])
    free = np.flatnonzero(~np.isnan(low))
    with located("policy."):
        return FreeGoal(free, low[free], high[free])


def _joints_named(key: str, robot: Robot) -> dict[int, float]:
    """Find the joints of limbs, those with a role, or those that match a pattern, and how each mirrors the first limb's.

    Raises:
        LevadeError: If there are none.
    """
    found = require_joints(robot, key, "policy.goal")
    found = found or {i: 1.0 for i, name in enumerate(robot.joint_names) if fnmatch.fnmatchcase(name, key)}
    if not found:
        valid = {*robot.joint_names, *limb_words(robot), "like"}
        raise LevadeError(f"policy.goal: no leg or joint {key!r} in {robot.name}; {did_you_mean(key, valid)}")
    return found


def leg_groups(choice: PolicyChoice, robot: Robot) -> tuple[Group, ...]:
    """Turn groups of legs into groups of joints, with mirror signs from the robot's kinematics.

    Args:
        choice: The task's policy.
        robot: The robot.

    Returns:
        Groups of joint indices; legs and arms never share one.

    Raises:
        LevadeError: If a group is empty, or a leg does not exist, is in no group or is in two.
    """
    legs = robot.legs
    key: dict[str, Callable[[Leg], str]] = {
        "pairs": lambda leg: leg.end,
        "sides": lambda leg: leg.side,
        "all": lambda leg: "",
        "independent": lambda leg: leg.name,
    }  # groups have limbs of one kind: arms do not copy legs
    if isinstance(choice.groups, str):
        of = key[choice.groups]
        grouped = [
            [leg for leg in legs if (leg.kind, of(leg)) == name]
            for name in dict.fromkeys((leg.kind, of(leg)) for leg in legs)
        ]
    else:
        with located("policy.groups: "):
            grouped = [[robot.leg(name) for name in names] for names in choice.groups]
        named = [leg.name for group in grouped for leg in group]
        if not all(grouped):
            raise LevadeError("policy.groups: a group is empty; leave it out")
        if sorted(named) != sorted(leg.name for leg in legs):
            missing = sorted({leg.name for leg in legs} - set(named))
            problem = f"{', '.join(missing)} in no group" if missing else "a leg is in two groups"
            raise LevadeError(f"policy.groups: {problem}; put every leg of {robot.name} in one group")

    def indices(leg: Leg) -> tuple[int, ...]:
        where = robot.joint_indices(leg)
        return tuple(range(where.start, where.stop))

    with located("policy.groups: "):
        return tuple(
            Group(
                indices(leader),
                tuple(Follower(indices(leg), tuple(map(float, mirror_signs(robot, leader, leg)))) for leg in followers),
            )
            for leader, *followers in grouped
        )
