"""Draw a bench: for each task and robot a row of three panels.

- Left: the share of runs that have succeeded after a given effort. A dot marks the last success; from there the curve is level
  to the end of the budget.
- Middle: the expected running time with its interval. An arrow means that the interval has no upper end. Without a success the
  row is empty.
- Right: the final cost of each run, hollow without success, and the median.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from levade.bench.measures import BUDGETS, expected_running_time, grouped, spent, success_curve
from levade.bench.results import Result
from levade.report.figures import PAGE, write_figures
from levade.report.style import LIGHT

_COLOURS = (
    LIGHT.best,
    LIGHT.x,
    LIGHT.y,
    LIGHT.limit,
    LIGHT.hind_right,
    LIGHT.front_right,
    LIGHT.ink,
    LIGHT.reference,
)
_DASHES: tuple[Any, ...] = ("-", (0, (4, 1.4)), (0, (1.2, 1.2)), (0, (5, 1.4, 1, 1.4)))
_MARKERS = "osD^vP*X"
"""Markers of the optimizers. After 8 optimizers the colours repeat, with other dashes and markers."""


def draw(results: Sequence[Result], directory: Path, *, format: str = "pdf") -> list[Path]:
    """Write the figures ``trials`` and ``steps`` to a directory.

    Args:
        results: Results of runs.
        directory: Directory to write.
        format: pdf, svg or png.

    Returns:
        The files that were written.

    Raises:
        LevadeError: If the format is unknown, the directory cannot be written, or matplotlib is missing.
    """
    groups = grouped(results)
    names = list(dict.fromkeys(name for optimizers in groups.values() for name in optimizers))
    looks = {name: _look(number) for number, name in enumerate(names)}
    what = ("trials", "steps")
    return write_figures({w: (lambda w=w: _figure(groups, looks, w)) for w in what}, directory, format)


def _look(number: int) -> dict[str, Any]:
    again = number // len(_COLOURS)
    return {
        "color": _COLOURS[number % len(_COLOURS)],
        "marker": _MARKERS[(number + 3 * again) % len(_MARKERS)],
        "linestyle": _DASHES[(number + again) % len(_DASHES)],
    }


def _figure(
    groups: Mapping[tuple[str, str], Mapping[str, list[Result]]], looks: Mapping[str, Mapping[str, Any]], what: str
) -> Any:
    from matplotlib.figure import Figure

    heights = [1.05 + 0.19 * max(len(optimizers), 3) for optimizers in groups.values()]
    figure = Figure(figsize=(PAGE, sum(heights)), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.04, h_pad=0.04, wspace=0.03, hspace=0.03)  # type: ignore[union-attr]
    grid = figure.subplots(
        len(groups), 3, squeeze=False, gridspec_kw={"width_ratios": (1.25, 1.0, 1.0), "height_ratios": heights}
    )
    for row, ((task, robot), optimizers) in zip(grid, groups.items(), strict=True):
        _curves(row[0], optimizers, looks, what)
        row[0].set_title(f"{task} on {robot}", fontweight="bold")
        _expected(row[1], optimizers, looks, what)
        _costs(row[2], optimizers, looks)
    return figure


def _curves(
    axes: Any, optimizers: Mapping[str, list[Result]], looks: Mapping[str, Mapping[str, Any]], what: str
) -> None:
    curves = {name: success_curve(runs, what) for name, runs in optimizers.items()}
    ends = {name: _budget(runs, what) or spent(runs, what)[0].max() for name, runs in optimizers.items()}
    first = min([amounts[0] for amounts, _ in curves.values() if amounts.size] or list(ends.values()))
    low = max(first, 2.0) / 2
    for name, (amounts, shares) in curves.items():
        look = dict(looks[name])
        marker = look.pop("marker")
        last = shares[-1:] if amounts.size else np.zeros(1)
        x, y = np.concatenate([[low], amounts, [ends[name]]]), np.concatenate([[0.0], shares, last])
        axes.step(x, y, where="post", clip_on=False, zorder=3, **look)
        if amounts.size:
            axes.plot(amounts[-1], last, marker=marker, markersize=3.5, color=look["color"], clip_on=False, zorder=4)
    _log_axis(axes, low, max(ends.values()))
    axes.set_ylim(0, 1)
    axes.set_yticks([0, 0.5, 1])
    axes.set_xlabel(BUDGETS[what])
    axes.set_ylabel("runs that succeeded")


def _expected(
    axes: Any, optimizers: Mapping[str, list[Result]], looks: Mapping[str, Mapping[str, Any]], what: str
) -> None:
    shown = []
    for y, (name, runs) in enumerate(optimizers.items()):
        ert = expected_running_time(*spent(runs, what))
        colour, marker = looks[name]["color"], looks[name]["marker"]
        won = f"{sum(run.success for run in runs)}/{len(runs)}"
        axes.annotate(won, (1.0, y), xycoords=("axes fraction", "data"), xytext=(3, 0), textcoords="offset points",
                      va="center", ha="left", color=LIGHT.muted, fontsize=6.5)  # fmt: skip
        if math.isinf(ert.value):
            axes.annotate("no success", (0.03, y), xycoords=("axes fraction", "data"), va="center", color=LIGHT.muted)
            continue
        high = ert.high if math.isfinite(ert.high) else ert.value
        axes.plot([ert.low, high], [y, y], color=colour, linewidth=1.4, solid_capstyle="butt")
        axes.plot(
            ert.value, y, marker=marker, color=colour, markersize=4.5, markeredgecolor="white", markeredgewidth=0.4
        )
        shown += [ert.low, high]
        if math.isinf(ert.high):
            axes.annotate("", (0.995, y), xycoords=("axes fraction", "data"), xytext=(ert.value, y), textcoords="data",
                          arrowprops={"arrowstyle": "->", "color": colour, "linewidth": 1.0, "shrinkA": 0})  # fmt: skip
    _log_axis(axes, min(shown) / 1.25, max(shown) * 1.25) if shown else axes.set_xticks([])
    _rows(axes, optimizers, looks, named=True)
    axes.set_xlabel(f"expected {BUDGETS[what]} to success")


def _costs(axes: Any, optimizers: Mapping[str, list[Result]], looks: Mapping[str, Mapping[str, Any]]) -> None:
    everything = []
    for y, (name, runs) in enumerate(optimizers.items()):
        colour = looks[name]["color"]
        cost = np.array([run.cost for run in runs])
        won = np.array([run.success for run in runs], dtype=bool)
        # side by side where many are alike: the same every time
        offset = 0.16 * ((np.arange(len(runs)) % 5) - 2) / 2 if len(runs) > 2 else np.zeros(len(runs))
        common = {"linestyle": "", "marker": "o", "markersize": 2.6, "markeredgewidth": 0.6, "color": colour}
        axes.plot(cost[won], y + offset[won], alpha=0.75, **common)
        axes.plot(cost[~won], y + offset[~won], markerfacecolor="white", **common)
        axes.plot(np.median(cost), y, marker="|", markersize=11, markeredgewidth=1.4, color=colour)
        everything += cost.tolist()
    if min(everything) > 0:
        _log_axis(axes, min(everything) / 1.25, max(everything) * 1.25)
    _rows(axes, optimizers, looks, named=False)
    axes.set_xlabel("final cost (hollow: no success)")


def _rows(axes: Any, optimizers: Mapping[str, Any], looks: Mapping[str, Mapping[str, Any]], *, named: bool) -> None:
    """Label the rows: one optimizer in each, the first on top."""
    axes.set_ylim(len(optimizers) - 0.5, -0.5)
    axes.set_yticks(range(len(optimizers)), list(optimizers) if named else [])
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False, axis="y")
    if named:
        for label, name in zip(axes.get_yticklabels(), optimizers, strict=True):
            label.set_color(looks[name]["color"])


def _log_axis(axes: Any, low: float, high: float) -> None:
    """Make a logarithmic axis with plain numbers: decades, and a few in between if there is room."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xscale("log")
    axes.set_xlim(low, high)
    span = high / low
    between = (1.0, 2.0, 5.0) if span < 25 else (1.0, 3.0) if span < 100 else (1.0,)
    axes.xaxis.set_major_locator(LogLocator(subs=between, numticks=6 if span > 1e4 else 12))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: _plain(value)))
    axes.xaxis.set_minor_formatter(NullFormatter())


def _plain(value: float) -> str:
    """Write a number briefly: 200, 20k, 2M, 0.02."""
    if value >= 1e6:
        return f"{value / 1e6:g}M"
    return f"{value / 1e3:g}k" if value >= 1e4 else f"{value:g}"


def _budget(runs: Sequence[Result], what: str) -> float | None:
    budgets = [run.budget_trials if what == "trials" else run.budget_steps for run in runs]
    known = [budget for budget in budgets if budget is not None]
    return float(max(known)) if known else None
