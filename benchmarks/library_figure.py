"""The figure of docs/falls.md: trials that a fall takes, over its number, for each library (`benchmarks/library.py`)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import small_figure

from levade.library.building import rounds

FIGURE = "figures/library-trials.png"


def draw(rows: Sequence[dict[str, Any]], docs: Path) -> None:
    """Write the figure, of the rows that have the trials of each fall."""
    small_figure.save(lambda: drawing(rows), docs / FIGURE)


def drawing(rows: Sequence[dict[str, Any]]) -> Any:
    """A panel for each library: every fall as a point, and the mean of each round as a line."""
    from matplotlib.figure import Figure

    from levade.report.figures import PAGE as WIDTH
    from levade.report.style import LIGHT

    figure = Figure(figsize=(WIDTH, 2.3), layout="constrained")
    panels = figure.subplots(1, len(rows), sharey=True, squeeze=False)[0]
    for axes, row in zip(panels, rows, strict=True):
        each = np.array(row["each"], dtype=float)
        axes.plot(np.arange(1, len(each) + 1), each, ".", color=LIGHT.front_left, markersize=2.5, alpha=0.6)
        edges, means = [], []
        for first, last in rounds(len(each)):
            edges += [first + 0.5, last + 0.5]
            means += [each[first:last].mean()] * 2
        axes.plot(edges, means, color=LIGHT.ink, linewidth=1.2)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xticks([1, 10, 100], ["1", "10", "100"])
        axes.set_yticks([10, 100, 1000], ["10", "100", "1000"])
        axes.minorticks_off()
        axes.set_title(row["robot"], loc="center")
        axes.set_xlabel("fall")
    panels[0].set_ylabel("trials")
    return figure
