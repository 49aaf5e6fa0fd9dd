"""Draw a library: how the robot lies after each fall, how each fall was solved, and how few motions are enough.

    draw(library, Path("figures"), format="png")    # figures/library.png

Two discs show the two halves of the sphere of upward directions, seen from above and from below the robot, in an equal-area
projection (Lambert's azimuthal). Each point is a fall. Near the middle of the second disc, the robot lies on its back. The
figure needs matplotlib (`pip install 'levade[figures]'`).
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
    Method.KNOWN: ("a known motion", LIGHT.muted, "o", 9.0),
    Method.NEAR: ("a search around a known motion", LIGHT.front_left, "^", 22.0),
    Method.COLD: ("a search from nothing", LIGHT.hind_left, "s", 22.0),
    Method.NONE: ("not at all", LIGHT.bad, "x", 26.0),
}
"""Method -> its label, colour, marker and area of the marker [pt^2]."""


def draw(library: Library, directory: Path, *, format: str = "pdf") -> list[Path]:
    """Write the figure ``library`` into a directory, which is created if it does not exist.

    Args:
        library: The library.
        directory: Directory to write to.
        format: "pdf", "svg" or "png".

    Returns:
        Paths of the files.

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
        disc(axes, f"{title} ({int(half.sum())} falls)")
        for method, (_, colour, marker, area) in _LOOK.items():
            which = half & np.array([record.method == method for record in library.records])
            axes.scatter(x[which], y[which], s=area, c=colour, marker=marker, linewidths=0.8, zorder=3)
    _cover(cover, library)
    counts = {method: sum(record.method == method for record in library.records) for method in _LOOK}
    handles = [_marker(method, n) for method, n in counts.items() if n]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title="solved by", title_fontsize=7)
    return figure


def projected(up: Array) -> tuple[Array, Array]:
    """Project upward directions onto a disc of radius 1.

    The top of the disc is a robot that lies on its tail, with its nose up. The left is one whose left side is up.

    Args:
        up: Upward directions in trunk axes, shape (n, 3).

    Returns:
        Positions to the right and upwards, shape (n,) each.
    """
    sideways = np.hypot(up[:, 0], up[:, 1])
    scale = np.sqrt(1.0 - np.abs(up[:, 2])) / np.maximum(sideways, 1e-12)
    return -up[:, 1] * scale, up[:, 0] * scale


def disc(axes: Any, title: str) -> None:
    """Draw an empty disc for `projected`, with its title and the four directions around it.

    Args:
        axes: The matplotlib axes to draw on. They are scaled to the disc, and their frame is hidden.
        title: Title above the disc.
    """
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
