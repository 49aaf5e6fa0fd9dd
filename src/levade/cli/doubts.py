"""Say what a search's summary adds to a success: unknown limits, and motions that only work with their own numerics."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.markup import escape

from levade.costs.margins import Margins
from levade.embodiment import JointLimits
from levade.errors import LevadeError
from levade.motions import Motion, RecordedSimulation
from levade.tasks import Task, is_builtin, overview

if TYPE_CHECKING:
    from levade.checks import Numeric

_AT_TORQUE, _AT_SPEED = 0.99, 0.95
"""Shares of a limit from which on a joint counts as at the limit."""
_LONG = 0.5
"""Share of a motion that a joint spends at a binding limit. Good motions spend up to a third at one, at take-off."""


def tell_unknown_limits(console: Console, task: Task, limits: JointLimits) -> None:
    """Print a line if the task asks for margins to limits that the robot's files do not give.

    Args:
        console: Where to print.
        task: The task.
        limits: Limits of the robot's joints.
    """
    unknown = [
        name
        for name, values, assumed in (
            ("speed", limits.velocity, limits.assumed_velocity),
            ("torque", limits.torque, limits.assumed_torque),
        )
        if (assumed or not np.isfinite(values).all()) and _asked(task, name)
    ]
    if unknown:
        console.print(
            f"[yellow]task: asks for margins to {' and '.join(unknown)} limits that the robot's file does not give[/],"
            " so success does not mean that the hardware can do it; add them to robot.yaml, under limits"
        )


def _asked(task: Task, limit: str) -> bool:
    """Whether a cost or criterion depends on the slack to the speed, or torque, limits."""
    lines = any(one.quantity == "torque_speed_margin" for one in task.success.values())
    speeds = any(one.quantity == "speed_margin" for one in task.success.values())
    terms = [cost.term for cost in task.costs.values() if isinstance(cost.term, Margins)]
    lines |= any(term.torque_speed is not None for term in terms)
    speeds |= any(term.speed is not None for term in terms)
    return lines or (speeds and limit == "speed")


def in_other_numbers(motion: Motion) -> dict[str, Numeric]:
    """Simulate a motion that succeeds at half the time step and with the other contact cone.

    Args:
        motion: The motion.

    Returns:
        Name -> result. Empty if the motion does not succeed, or another engine than MuJoCo made it.
    """
    if not motion.result.success or motion.task.physics.engine != "mujoco":
        return {}
    from levade.checks.numerics import QUICK, numerics  # only now: a search starts faster without checks

    try:
        return numerics(RecordedSimulation(motion, threads=1), QUICK)
    except LevadeError:  # the search succeeded and its motion is written, so nothing here may fail
        return {}


def tell_numerics(console: Console, found: Mapping[str, Numeric], motion: Motion, directory: Path) -> None:
    """Print whether the motion also succeeds with other numerics, and what to do if it does not.

    Args:
        console: Where to print.
        found: Result of `in_other_numbers`.
        motion: The motion.
        directory: Directory of its run.
    """
    failed = [name for name, one in found.items() if not one.success]
    if not found:
        return
    if not failed:
        console.print(f"It also succeeds {_listed(list(found))}.")
        return
    console.print(
        f"[yellow]It does not succeed {_listed(failed)}[/]: its success may depend on how contact is computed."
        f" Next: {escape(_next(motion, directory))}"
    )


def binding_limits(motion: Motion) -> list[str]:
    """Name the joints that are longest at their speed limit and at their torque limit, if for half of the motion or more.

    A drive on its torque-speed line counts as at the speed limit, since it has no more torque at its speed.

    Args:
        motion: The motion.
    """
    limits, rows = motion.embodiment.limits, slice(0, motion.horizon_steps)
    torque, speed = motion["joint_torque"][rows], motion["joint_velocity"][rows]
    strained = np.abs(torque) >= _AT_TORQUE * limits.torque
    on_line = (torque * speed > 0) & (limits.torque_speed_left(torque, speed) <= 1 - _AT_TORQUE) & ~strained
    found = []
    for what, there, values, assumed, unit in (
        ("speed", (np.abs(speed) >= _AT_SPEED * limits.velocity) | on_line, limits.velocity, limits.assumed_velocity, "rad/s"),
        ("torque", strained, limits.torque, limits.assumed_torque, "Nm"),
    ):  # fmt: skip
        share = there.mean(axis=0)
        joint = int(np.argmax(share))
        if share[joint] >= _LONG and np.isfinite(values[joint]):
            made_up = ", assumed" * (joint in assumed)
            found.append(
                f"the {what} of {motion.joint_names[joint]} ({values[joint]:.3g} {unit}{made_up}, at it for"
                f" {share[joint]:.0%} of the motion)"
            )
    return found


def _listed(names: Sequence[str]) -> str:
    words = {"half time step": "at half the time step", "other contact cone": "with the other contact cone"}
    return " and ".join(words[name] for name in names)


def _next(motion: Motion, directory: Path) -> str:
    """Return the command that searches for a motion that hardware can do, or that checks this one."""
    if not is_builtin(motion.task_name):
        return f"levade check {shlex.quote(str(directory / 'motion.npz'))}"
    return hardware_command(motion, directory)


def hardware_command(motion: Motion, directory: Path) -> str:
    """Return the command that searches for a motion that does the same task and passes a certificate.

    Args:
        motion: The motion.
        directory: Directory of its run.
    """
    task, robot = motion.task_name, motion.task.robot.name
    own = not is_builtin(task)
    file = directory / "task.yaml" if (directory / "task.yaml").is_file() else f"{task}.yaml"
    words = ["levade", "solve", str(file) if own else task, "--hardware"]
    if not own and robot != overview(task).robot:
        words += ["--robot", robot]
    if directory == Path(task):  # the pursuit would use the directory of this run
        words += ["--out", f"{task}-hardware"]
    return shlex.join(words)
