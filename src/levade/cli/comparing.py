"""``levade show A B ...``: motions side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from rich.table import Table
from rich.text import Text

from levade.arrays import Array
from levade.cli.tables import quantity_unit, signed
from levade.motions import Motion


def comparison_table(motions: Mapping[str, Motion]) -> Table:
    """Make a table with a column per motion: success, errors, cost and its terms, trials, and peaks against the limits.

    Args:
        motions: Heading of the column -> motion.
    """
    table = Table(box=None, padding=(0, 2), header_style="bold")
    table.add_column("")
    for name in motions:
        table.add_column(Text(name), justify="right")
    shown = list(motions.values())

    def row(name: str, value: Callable[[Motion], Text | str]) -> None:
        table.add_row(Text(name), *(value(motion) for motion in shown))

    row("task", lambda motion: Text(motion.task_name))
    row("robot", lambda motion: Text(motion.robot))
    row("seed", lambda motion: str(motion.provenance.seed))
    row("success", lambda motion: _yes_or_no(motion.result.success))
    for name in _union(motion.result.errors for motion in shown):
        row(f"error of {name}", lambda motion, name=name: _error(motion, name))
    row("cost", lambda motion: f"{motion.result.cost:.4g}")
    for name in _union(motion.result.cost_terms for motion in shown):
        row(f"  {name}", lambda motion, name=name: _weighted(motion, name))
    row("trials", lambda motion: str(motion.result.trials))
    row("trials to success", lambda motion: _count(motion.result.trials_to_success))
    for name, array, limit in (("torque", "joint_torque", "torque"), ("speed", "joint_velocity", "velocity")):
        shares = [_peak_share(motion[array], getattr(motion.embodiment.limits, limit)) for motion in shown]
        table.add_row(Text(f"peak {name}, share of limit"), *shares)
    return table


def _union(mappings: Any) -> list[str]:
    """Return the keys of all mappings, in the order of their first appearance."""
    return list(dict.fromkeys(key for mapping in mappings for key in mapping))


def _yes_or_no(success: bool) -> Text:
    return Text("yes", style="green") if success else Text("no", style="red")


def _error(motion: Motion, name: str) -> Text | str:
    if name not in motion.result.errors:
        return ""
    style = "green" if motion.meets(name) else "red"
    unit = quantity_unit(motion.task.success[name].quantity)
    return Text(f"{signed(motion.result.errors[name])} {unit}", style=style)


def _weighted(motion: Motion, name: str) -> str:
    result = motion.result
    if name not in result.cost_terms:
        return ""
    return f"{result.cost_weights[name] * result.cost_terms[name]:.4g}"


def _count(trials: int | None) -> str:
    return "-" if trials is None else str(trials)


def _peak_share(values: Array, bounds: Array) -> Text | str:
    if not np.isfinite(bounds).any():
        return "no limit"
    share = float((np.abs(values).max(axis=0) / bounds).max())
    return Text(f"{share:.0%}", style="yellow" if share > 1.0 + 1e-9 else "green")
