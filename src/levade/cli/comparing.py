"""``levade show A B ...``: motions side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from rich.table import Table
from rich.text import Text

from levade.cli.tables import quantity_unit, signed
from levade.motion import Motion, cost_weights, meets


def comparison_table(motions: Mapping[str, Motion]) -> Table:
    """A column per motion, named by the keys: success, errors, cost and its terms, trials, peaks against the limits."""
    table = Table(box=None, padding=(0, 2), header_style="bold")
    table.add_column("")
    for name in motions:
        table.add_column(Text(name), justify="right")
    metas = [motion.meta for motion in motions.values()]

    def row(name: str, value: Callable[[Mapping[str, Any]], Text | str]) -> None:
        table.add_row(Text(name), *(value(meta) for meta in metas))

    row("task", lambda meta: Text(meta["task"]["name"]))
    row("robot", lambda meta: Text(meta["robot"]))
    row("seed", lambda meta: str(meta["seed"]))
    row("success", lambda meta: Text("yes", style="green") if meta["success"] else Text("no", style="red"))
    for name in _union(meta["errors"] for meta in metas):
        row(f"error of {name}", lambda meta, name=name: _error(meta, name))
    row("cost", lambda meta: f"{meta['cost']:.4g}")
    for name in _union(meta["cost_terms"] for meta in metas):
        row(f"  {name}", lambda meta, name=name: _weighted(meta, name))
    row("trials", lambda meta: str(meta["trials"]))
    row("trials to success", lambda meta: _count(meta["trials_to_success"]))
    for name, array, limit in (("torque", "joint_torque", "torque"), ("speed", "joint_velocity", "velocity")):
        shares = [_peak_share(motion[array], motion.meta["limits"][limit]) for motion in motions.values()]
        table.add_row(Text(f"peak {name}, share of limit"), *shares)
    return table


def _union(mappings: Any) -> list[str]:
    """Keys of all, in the order they first come."""
    return list(dict.fromkeys(key for mapping in mappings for key in mapping))


def _error(meta: Mapping[str, Any], name: str) -> Text | str:
    if name not in meta["errors"]:
        return ""
    criterion, error = meta["task"]["success"][name], meta["errors"][name]
    style = "green" if meets(meta, name) else "red"
    return Text(f"{signed(error)} {quantity_unit(criterion['quantity'])}", style=style)


def _weighted(meta: Mapping[str, Any], name: str) -> str:
    if name not in meta["cost_terms"]:
        return ""
    return f"{cost_weights(meta)[name] * meta['cost_terms'][name]:.4g}"


def _count(trials: int | None) -> str:
    return "-" if trials is None else str(trials)


def _peak_share(values: Any, limits: list[float | None]) -> Text | str:
    bounds = np.array([np.inf if limit is None else limit for limit in limits])
    if not np.isfinite(bounds).any():
        return "no limit"
    share = float((np.abs(values).max(axis=0) / bounds).max())
    return Text(f"{share:.0%}", style="yellow" if share > 1.0 + 1e-9 else "green")
