"""Make tables about a motion that several commands print."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from levade.costs.quantities import unit_of
from levade.motions import Motion

_WIDE = 200
"""Number of columns where the output is no terminal, so that nothing wraps there."""


def make_console(*, stderr: bool = False) -> Console:
    """Make a console to print on: styled on a terminal, plain and unwrapped in a pipe.

    Args:
        stderr: Whether to print on standard error instead of standard output.

    Returns:
        The console.
    """
    console = Console(stderr=stderr, highlight=False, soft_wrap=True)
    return console if console.is_terminal else Console(stderr=stderr, highlight=False, soft_wrap=True, width=_WIDE)


def quantity_unit(quantity: str) -> str:
    """Return the SI unit of a success quantity.

    Args:
        quantity: Name of the quantity.

    Returns:
        The unit, as text.
    """
    return unit_of(quantity)


def signed(value: float) -> str:
    """Write a number with four digits and a sign, so that columns line up.

    Args:
        value: The number.

    Returns:
        The text. From 1000 it has three significant digits instead of four decimals.
    """
    return f"{value:+.4f}" if abs(value) < 1000 else f"{value:+.3g}"


def motion_summary(motion: Motion) -> Iterator[RenderableType]:
    """Make the tables of a motion: goal against result, and peaks against the limits.

    Args:
        motion: The motion.

    Yields:
        The tables, one by one.
    """
    yield goal_table(motion)
    yield peak_table(motion)


def goal_table(motion: Motion) -> Table:
    """Make a table with a row per success criterion.

    Args:
        motion: The motion.

    Returns:
        The table. Its values are in SI units.
    """
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("criterion", "goal", "result", "error", "allowed", ""):
        justify = "left" if heading in ("criterion", "") else "right"
        table.add_column(heading, justify=justify)
    when = {"horizon": "", "end": " at the end", "max": ", largest", "min": ", smallest", "hold": " in the hold"}
    for name, criterion in motion.task.success.items():
        unit, error = quantity_unit(criterion.quantity), motion.result.errors[name]
        target = criterion.target
        tolerance = criterion.tolerance or 0.0
        if target is not None:
            goal, value = f"{target:.4f} {unit}", criterion.value_of(error)
        else:
            low, high = criterion.minimum, criterion.maximum
            ends = [f"{bound:.4f}" for bound in (low, high) if bound is not None]
            side = "" if len(ends) == 2 else "at least " if high is None else "at most "
            goal = f"{side}{' to '.join(ends)} {unit}"
            value = motion.result.values.get(name, criterion.value_of(error))
        result = "within" if value is None else f"{value:.4f} {unit}"
        met = motion.meets(name)
        table.add_row(
            name + when[criterion.at] if name == criterion.quantity else name,
            goal,
            result,
            f"{signed(error)} {unit}",
            f"{tolerance:.4f} {unit}",
            Text("ok", style="green") if met else Text("missed", style="red"),
        )
    return table


def peak_table(motion: Motion) -> Table:
    """Make a table of the joints nearest to their limits, or furthest beyond, in torque, speed and range.

    Args:
        motion: The motion.

    Returns:
        The table, with a row each for torque [Nm], speed [rad/s] and angle [rad].
    """
    limits, names = motion.embodiment.limits, motion.joint_names
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("peak", "joint", "value", "limit", "share"):
        justify = "left" if heading in ("peak", "joint") else "right"
        table.add_column(heading, justify=justify)
    for what, unit, array, bounds in (
        ("torque", "Nm", "joint_torque", limits.torque),
        ("speed", "rad/s", "joint_velocity", limits.velocity),
    ):
        peak = np.abs(motion[array]).max(axis=0)
        joint = int(np.argmax(peak / bounds)) if np.isfinite(bounds).any() else int(np.argmax(peak))
        share = peak[joint] / bounds[joint]
        table.add_row(
            what,
            names[joint],
            f"{peak[joint]:.1f} {unit}",
            f"{bounds[joint]:.1f} {unit}" if np.isfinite(bounds[joint]) else "none",
            _share(share),
        )
    lower, upper, position = limits.lower, limits.upper, motion["joint_position"]
    beyond = np.maximum(lower - position, position - upper).max(axis=0)
    joint = int(np.argmax(beyond))
    angle = position[np.argmax(np.maximum(lower - position, position - upper)[:, joint]), joint]
    table.add_row(
        "angle",
        names[joint],
        f"{angle:.3f} rad",
        f"{lower[joint]:.3f} to {upper[joint]:.3f} rad",
        Text(f"{beyond[joint]:.3f} beyond", style="yellow") if beyond[joint] > 0 else Text("inside", style="green"),
    )
    return table


def _share(share: float) -> Text:
    return Text(f"{share:.0%}", style="yellow" if share > 1.0 + 1e-9 else "green")
