"""What a search's summary says next to success: limits that are not known, and motions that live by their numbers alone."""

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
from levade.tasks import Task, builtin_tasks, load_task

if TYPE_CHECKING:
    from levade.checks import Numeric

_AT_TORQUE, _AT_SPEED = 0.99, 0.95
"""Shares of a limit from which on a joint is at it."""
_LONG = 0.5
"""Share of a motion that a joint spends at a limit that binds; good motions are at one for up to a third, for take-off."""


def tell_unknown_limits(console: Console, task: Task, limits: JointLimits) -> None:
    """One line if the task asks for margins to limits that no file of the robot gives."""
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
            " so success does not mean that the hardware can do it; robot.yaml, limits, gives them"
        )


def _asked(task: Task, limit: str) -> bool:
    """Whether a cost or criterion looks at what is left of the speed, or torque, limits."""
    lines = any(one.quantity == "torque_speed_margin" for one in task.success.values())
    speeds = any(one.quantity == "speed_margin" for one in task.success.values())
    terms = [cost.term for cost in task.costs.values() if isinstance(cost.term, Margins)]
    lines |= any(term.torque_speed is not None for term in terms)
    speeds |= any(term.speed is not None for term in terms)
    return lines or (speeds and limit == "speed")


def in_other_numbers(motion: Motion) -> dict[str, Numeric]:
    """A motion that succeeds, at half the time step and with the other contact cone: name -> what came of it.

    Nothing of one that does not succeed, or that another engine than MuJoCo made.
    """
    if not motion.result.success or motion.task.physics.engine != "mujoco":
        return {}
    from levade.checks.numerics import QUICK, numerics  # only now: a search begins without the room of checks

    try:
        return numerics(RecordedSimulation(motion, threads=1), QUICK)
    except LevadeError:  # the search has succeeded, and its motion is written: nothing here may make it fail
        return {}


def tell_numerics(console: Console, found: Mapping[str, Numeric], motion: Motion, directory: Path) -> None:
    """Whether the motion succeeds in other numbers, too, and what to do if it does not."""
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
    """The joint that is longest at its speed limit, and at its torque limit, if that is half of the motion or more.

    At the speed limit is also a drive on its torque-speed line, which leaves it no more torque at its speed.
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
    """The command that looks for a motion that hardware can do, or looks closer at this one."""
    task, robot = motion.task_name, motion.task.robot.name
    if task not in builtin_tasks():
        return f"levade check {shlex.quote(str(directory / 'motion.npz'))}"
    words = ["levade", "solve", task, "--hardware"]
    if robot != load_task(task).robot.name:
        words += ["--robot", robot]
    if directory == Path(task):  # where this run is, and the pursuit would go
        words += ["--out", f"{task}-hardware"]
    return shlex.join(words)
