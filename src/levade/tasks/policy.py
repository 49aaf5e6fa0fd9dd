"""From a task's policy to one on a robot's joints: groups of legs become groups of joints."""

from __future__ import annotations

from collections.abc import Callable

from levade.arrays import Array
from levade.errors import LevadeError, located
from levade.policies import Ends, Follower, FreePolicy, GaussianKernels, Group, Policy
from levade.robots import Leg, Robot, mirror_signs
from levade.tasks.parts import HorizonRange, PolicyChoice
from levade.tasks.task import Task


def make_policy(task: Task, robot: Robot, *, start: Array | None = None) -> Policy | FreePolicy:
    """Make the task's policy on the robot's joints.

    Args:
        task: The task.
        robot: The robot.
        start: What the joints were commanded last [rad], shape (joints,). Defaults to the policy's goal.

    Raises:
        LevadeError: If its groups do not fit the robot's legs.
    """
    choice = task.policy
    ends = None
    with located("policy."):
        kernels = GaussianKernels(choice.kernels, choice.variance, choice.time)
    if choice.depart or choice.settle:
        goal = goal_posture(choice, robot)
        with located("policy."):
            ends = Ends(goal if start is None else start, goal, choice.depart, choice.settle)
    horizon = task.horizon.begin if isinstance(task.horizon, HorizonRange) else task.horizon
    policy = Policy(kernels, leg_groups(choice, robot), horizon, task.physics.timestep, task.hold_steps, ends)
    if not isinstance(task.horizon, HorizonRange):
        return policy
    return FreePolicy(policy, (task.horizon.minimum, task.horizon.maximum))


def goal_posture(choice: PolicyChoice, robot: Robot) -> Array:
    """The posture in which the policy's references settle [rad], shape (joints,)."""
    with located("policy.goal: "):
        return robot.posture(choice.goal)


def leg_groups(choice: PolicyChoice, robot: Robot) -> tuple[Group, ...]:
    """Groups of legs as groups of joints, mirror signs derived from the robot's kinematics."""
    legs = robot.legs
    key: dict[str, Callable[[Leg], str]] = {
        "pairs": lambda leg: leg.end,
        "sides": lambda leg: leg.side,
        "all": lambda leg: "",
        "independent": lambda leg: leg.name,
    }
    if isinstance(choice.groups, str):
        of = key[choice.groups]
        grouped = [[leg for leg in legs if of(leg) == name] for name in dict.fromkeys(map(of, legs))]
    else:
        with located("policy.groups: "):
            grouped = [[robot.leg(name) for name in names] for names in choice.groups]
        named = [leg.name for group in grouped for leg in group]
        if not all(grouped):
            raise LevadeError("policy.groups: a group is empty; leave it out")
        if sorted(named) != sorted(leg.name for leg in legs):
            missing = sorted({leg.name for leg in legs} - set(named))
            problem = f"{', '.join(missing)} in none" if missing else "a leg in two"
            raise LevadeError(f"policy.groups: {problem}; every leg of {robot.name} goes in one group")

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
