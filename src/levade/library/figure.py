"""A library as a picture: how its falls lie, how each was solved, and how few motions are enough.

    draw(library, Path("figures"), format="png")    # figures/library.png

Two discs are the two halves of the sphere of ways up, seen from above the robot and from below it, with equal areas equal
(Lambert's azimuthal projection). A fall is a point: near the middle of the second disc, the robot lies on its back. Needs
matplotlib (`pip install levade[figures]`).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.library.asking import Library
from levade.library.records import Method
from levade.report.figures import PAGE, write_figures
from levade.report.style import LIGHT

_LOOK: dict[Method, tuple[str, str, str, float]] = {
    Method.KNOWN: ("a motion that was there", LIGHT.muted, "o", 9.0),
    Method.NEAR: ("a search around one", LIGHT.front_left, "^", 22.0),
    Method.COLD: ("a search from nothing", LIGHT.hind_left, "s", 22.0),
    Method.NONE: ("not at all", LIGHT.bad, "x", 26.0),
}
"""Method -> what solved a fall, colour, marker and its area [pt^2]."""


def draw(library: Library, directory: Path, *, format: str = "pdf") -> list[Path]:
    """Write the figure ``library`` into a directory, which is made if need be.

    Args:
        library: The library.
        directory: Where to write.
        format: "pdf", "svg" or "png".

    Returns:
        What was written.

    Raises:
        LevadeError: If the format is unknown, the directory cannot be written, or matplotlib is missing.
    """
    return write_figures({"library": lambda: _figure(library)}, directory, format)


def _figure(library: Library) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(PAGE, 2.7), layout="constrained")
    above, below, cover = figure.subplots(1, 3, width_ratios=[1.0, 1.0, 1.1])
    up = np.array([record.up for record in library.records])
    x, y = projected(up)
    for axes, half, title in (
        (above, up[:, 2] >= 0, "on its belly, or its feet"),
        (below, up[:, 2] < 0, "on its back"),
    ):
        _disc(axes, f"{title} ({int(half.sum())} falls)")
        for method, (_, colour, marker, area) in _LOOK.items():
            which = half & np.array([record.method == method for record in library.records])
            axes.scatter(x[which], y[which], s=area, c=colour, marker=marker, linewidths=0.8, zorder=3)
    _cover(cover, library)
    counts = {method: sum(record.method == method for record in library.records) for method in _LOOK}
    handles = [_marker(method, n) for method, n in counts.items() if n]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title="solved by", title_fontsize=7)
    return figure


def projected(up: Array) -> tuple[Array, Array]:
    """Where ways up are drawn in their disc of radius 1: to the right and upwards, shape (n,) each.

    Upwards is a robot that lies on its tail, with its nose up; to the left one whose left is up.

    Args:
        up: Shape (n, 3), in trunk axes.
    """
    sideways = np.hypot(up[:, 0], up[:, 1])
    scale = np.sqrt(1.0 - np.abs(up[:, 2])) / np.maximum(sideways, 1e-12)
    return -up[:, 1] * scale, up[:, 0] * scale


def _disc(axes: Any, title: str) -> None:
    from matplotlib.patches import Circle

    axes.set_title(title, loc="center")
    axes.add_patch(Circle((0, 0), 1.0, facecolor=LIGHT.page, edgecolor=LIGHT.muted, linewidth=0.6))
    for angle in (30.0, 60.0):
        radius = np.sqrt(1.0 - np.cos(np.radians(angle)))
        axes.add_patch(Circle((0, 0), radius, fill=False, edgecolor=LIGHT.grid, linewidth=0.6))
        axes.text(0.0, -radius, f"{angle:.0f}°", fontsize=5.5, color=LIGHT.muted, ha="center", va="top")
    for where, text, place in (
        ((0, 1.06), "nose up", ("center", "bottom")),
        ((0, -1.06), "nose down", ("center", "top")),
        ((-1.06, 0), "left up", ("right", "center")),
        ((1.06, 0), "right up", ("left", "center")),
    ):
        rotation = 0 if where[0] == 0 else 90
        axes.text(*where, text, fontsize=6, ha=place[0], va=place[1], rotation=rotation)
    axes.set_aspect("equal")
    axes.set_xlim(-1.25, 1.25)
    axes.set_ylim(-1.25, 1.25)
    axes.set_axis_off()


def _cover(axes: Any, library: Library) -> None:
    from matplotlib.ticker import MaxNLocator

    covered = [100.0 * falls / len(library.records) for _, falls in library.knowledge.cover()]
    axes.plot(range(len(covered) + 1), [0.0, *covered], color=LIGHT.front_left, marker="o", markersize=3)
    axes.set_xlabel("motions, the best ones")
    axes.set_ylabel("falls that one of them works from [%]")
    axes.set_title(f"{covered[-1]:.1f} % with {len(covered)}" if covered else "", loc="center")
    axes.set_ylim(0, 104)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))


def _marker(method: Method, n: int) -> Any:
    from matplotlib.lines import Line2D

    text, colour, marker, _ = _LOOK[method]
    return Line2D([], [], linestyle="none", color=colour, marker=marker, markersize=4, label=f"{text}: {n}")
