"""Summarise a bench in tables, one for each task and robot."""

from __future__ import annotations

import math
from collections.abc import Sequence

from levade.bench.measures import LEVEL, Interval, Summary

HEADINGS = (
    "optimizer",
    "success",
    "trials to success",
    "ERT [trials]",
    "ERT [1000 steps]",
    "ERT [core-s]",
    "final cost",
)

SHORT_HEADINGS = ("optimizer", "success", "trials to success", "ERT [trials]", "ERT [core-s]", "final cost")
"""Headings that fit a terminal: without intervals of the core-seconds and quartiles of the cost."""

_ENDS = {
    "success": "when it has succeeded and polished",
    "budget": "when its budget is spent",
    "mixed": "of runs some of which stop at success",
}


def rows(summaries: Sequence[Summary], *, short: bool = False) -> list[tuple[str, ...]]:
    """Make cells under `HEADINGS`, or `SHORT_HEADINGS`, from summaries of one task and robot.

    Args:
        summaries: Summaries of one task and robot.
        short: Whether the cells are for `SHORT_HEADINGS`, with fewer columns.

    Returns:
        The cells of one row per summary.
    """
    if short:
        return [
            (
                *(cell.replace(" – ", "–") for cell in cells[:4]),
                number(summary.ert["core_seconds"].value),
                number(summary.cost[1]),
            )
            for summary, cells in zip(summaries, rows(summaries), strict=True)
        ]
    return [
        (
            summary.optimizer,
            f"{summary.successes}/{summary.runs}",
            f"{number(summary.median)} ({number(summary.least)} – {number(summary.most)})"
            if summary.successes
            else "∞",
            interval(summary.ert["trials"]),
            interval(summary.ert["steps"], unit=1000.0),
            interval(summary.ert["core_seconds"]),
            f"{number(summary.cost[1])} ({number(summary.cost[0])} – {number(summary.cost[2])})",
        )
        for summary in summaries
    ]


def by_case(summaries: Sequence[Summary]) -> dict[tuple[str, str], list[Summary]]:
    """Group summaries as task and robot -> its summaries.

    Args:
        summaries: Summaries of any tasks and robots.

    Returns:
        Task and robot -> summaries, in the order in which they come.
    """
    found: dict[tuple[str, str], list[Summary]] = {}
    for summary in summaries:
        found.setdefault((summary.task, summary.robot), []).append(summary)
    return found


def legend(summaries: Sequence[Summary], *, short: bool = False) -> str:
    """Say what the columns mean, in a sentence or two.

    Args:
        summaries: Summaries in the table. Their ends of a run are named.
        short: Whether it is for the table under `SHORT_HEADINGS`, which has no quartiles.

    Returns:
        The text, on one line.
    """
    ends = " or ".join(dict.fromkeys(_ENDS[summary.until] for summary in summaries))
    return (
        "Trials to success: median of all runs (least – most), ∞ for a run without success. ERT: expected running time, what"
        f" all runs spent until success or their end, divided by the number of successes [{LEVEL:.0%} bootstrap interval]."
        f" Final cost: median {'' if short else '(quartiles) '}of the best trial at a run's end, {ends}."
    )


def markdown(summaries: Sequence[Summary]) -> str:
    """Return all tables as Markdown, with headings.

    Args:
        summaries: Summaries of any tasks and robots.

    Returns:
        A table per task and robot, then the legend. "no results" if there are no summaries.
    """
    parts = []
    for (task, robot), mine in by_case(summaries).items():
        parts.append(f"## {task} on {robot}\n\n| {' | '.join(HEADINGS)} |\n|{'---|' * len(HEADINGS)}")
        parts[-1] += "".join(f"\n| {' | '.join(cell.replace('|', '/') for cell in row)} |" for row in rows(mine))
    return "\n\n".join([*parts, legend(summaries)]) + "\n" if parts else "no results\n"


def interval(value: Interval, *, unit: float = 1.0) -> str:
    """Write a value and its limits in a unit, as in 310 [250 – 402]. It is ∞ without a success.

    Args:
        value: Value with its low and high limit.
        unit: Number by which value and limits are divided.

    Returns:
        The text.
    """
    if math.isinf(value.value):
        return "∞"
    return f"{number(value.value / unit)} [{number(value.low / unit)} – {number(value.high / unit)}]"


def number(value: float) -> str:
    """Write a number with three digits, a whole number with all digits, or ∞.

    Args:
        value: The number, which may be infinite.

    Returns:
        The text.
    """
    if math.isinf(value):
        return "∞"
    if abs(value) >= 100 or value == int(value):
        return f"{value:.0f}"
    return f"{value:.3g}"
