"""Draw a map over the direction of up: what a robot comes to lie on, and whether that leads to upright.

    draw_map(graph, Path("map.png"))

The discs are those of a library's figure (`levade.library.figure`): two halves of the sphere of upward directions in trunk
axes, in an equal-area projection. A place is the attitude in which the robot is put down, in its neutral posture. Its colour
says on what it comes to rest, without dynamics; hatching says that joints alone do not lead from there to upright. Points are
the falls of a library, where they ended. Needs matplotlib (`pip install 'levade[figures]'`).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.library.falls import FACES
from levade.library.figure import disc, projected
from levade.library.records import Method, Record
from levade.report.figures import FORMATS, PAGE, write_figures
from levade.report.style import LIGHT
from levade.rightability.hulls import Indices, tangent
from levade.rightability.righting import Graph

_COLOURS = {
    "belly": "#8fd0bb",
    "back": "#e0a188",
    "left": "#7fb2d6",
    "right": "#b9dcf3",
    "tail": "#f2cf86",
    "nose": "#dcb3cb",
}
"""Paler than the house's colours, so that points show."""
_WORDS = {
    "tail": "its tail",
    "nose": "its nose",
    "right": "its right side",
    "left": "its left side",
    "back": "its back",
}
_UPRIGHT = 6
_CELLS = 220
"""Number of cells across a disc."""


def check_map(path: Path) -> None:
    """Raise LevadeError if a map cannot be drawn into a file, for its name.

    Args:
        path: The file.

    Raises:
        LevadeError: If the name does not end in .png, .svg or .pdf.
    """
    if path.suffix.lstrip(".") not in FORMATS:
        raise LevadeError(f"{path}: should end in .png, .svg or .pdf", field="map")


def draw_map(graph: Graph, path: Path, records: Sequence[Record] = ()) -> None:
    """Write the map.

    Args:
        graph: The graph of the slope to draw. On a slope, the nose points uphill.
        path: File to write; its name ends in .png, .svg or .pdf.
        records: Falls of a library, to be drawn as points.

    Raises:
        LevadeError: If the file cannot be written, or matplotlib is missing.
    """
    check_map(path)
    write_figures({path.stem: lambda: _figure(graph, records)}, path.parent, path.suffix.lstrip("."))


def _figure(graph: Graph, records: Sequence[Record]) -> Any:
    from matplotlib import rcParams
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle, Patch

    rcParams["hatch.linewidth"] = 0.4  # for this figure: `write_figures` restores it
    figure = Figure(figsize=(0.75 * PAGE, 3.3), layout="constrained")
    axes = figure.subplots(1, 2)
    side = (np.arange(_CELLS) + 0.5) / _CELLS * 2.0 - 1.0
    x, y = np.meshgrid(side, side)
    lies, leads = {}, {}
    for half in (1.0, -1.0):
        lies[half], leads[half] = _outcome(graph, _directions(x, y, half))
    seen = np.unique(np.concatenate([lies[half].ravel() for half in lies]))
    colours = ListedColormap([*(_COLOURS[name] for name in FACES), LIGHT.front_left, LIGHT.grid])
    for one, half, title in ((axes[0], 1.0, "put down with its back up"), (axes[1], -1.0, "upside down")):
        disc(one, title)
        extent = (-1.0, 1.0, -1.0, 1.0)
        inside = np.hypot(x, y) < 1.0
        shown = np.where(inside, lies[half], np.nan)
        one.imshow(
            shown, extent=extent, origin="lower", cmap=colours, vmin=-0.5, vmax=7.5, interpolation="nearest", zorder=1.5
        )
        stuck = np.where(inside, ~leads[half], False).astype(float)
        if stuck.any():
            one.contourf(x, y, stuck, levels=[0.5, 1.5], colors="none", hatches=["/////"], zorder=1.7)
        for angle in (30.0, 60.0):  # those of the disc are under the colours
            radius = float(np.sqrt(1.0 - np.cos(np.radians(angle))))
            one.add_patch(Circle((0, 0), radius, fill=False, edgecolor=LIGHT.panel, linewidth=0.5, zorder=2))
        one.set_xlim(-1.25, 1.25)
        one.set_ylim(-1.25, 1.25)
        up = np.array([record.up for record in records]).reshape(-1, 3)
        solved = np.array([record.method != Method.NONE for record in records], dtype=bool)
        px, py = projected(up)
        for which, marker, colour in ((solved, "o", LIGHT.ink), (~solved, "x", LIGHT.bad)):
            rows = which & (np.sign(up[:, 2] + 1e-12) == half)
            one.scatter(px[rows], py[rows], s=5.0, marker=marker, c=colour, linewidths=0.5, zorder=3)
    words = {i: f"rests on {_WORDS.get(name, 'its belly or feet')}" for i, name in enumerate(FACES)}
    words |= {_UPRIGHT: "stands on its feet", 7: "rolls on"}
    handles: list[Any] = [Patch(facecolor=colours(int(k)), label=words[int(k)]) for k in seen]
    if not all(array.all() for array in leads.values()):
        handles.append(
            Patch(facecolor="none", edgecolor=LIGHT.ink, hatch="/////", label="joints alone do not right it")
        )
    if len(records):
        done = sum(record.method != Method.NONE for record in records)
        look: dict[str, Any] = {"linestyle": "none", "markersize": 2.5}
        handles.append(Line2D([], [], marker="o", color=LIGHT.ink, label=f"fall with a motion: {done}", **look))
        if done < len(records):
            label = f"fall without: {len(records) - done}"
            handles.append(Line2D([], [], marker="x", color=LIGHT.bad, label=label, **look))
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure


def _directions(x: Array, y: Array, half: float) -> Array:
    """Upward directions at places of a disc, the inverse of `levade.library.figure.projected`."""
    radius = np.minimum(np.hypot(x, y), 1.0)
    height = 1.0 - radius**2
    sideways = np.sqrt(1.0 - height**2) / np.maximum(radius, 1e-12)
    return np.stack([y * sideways, -x * sideways, half * height], axis=-1)


def _outcome(graph: Graph, up: Array) -> tuple[Indices, NDArray[np.bool_]]:
    """On what the robot comes to rest, as an index into the colours, and whether that leads to upright."""
    flat = up.reshape(-1, 3)
    posture = np.full(len(flat), graph.postures.neutral)
    rest = graph.postures.hulls.settle(posture, flat, tangent(flat), graph.slope)
    nodes = graph.reached(posture, rest.face, rest.up, rest.uphill)
    largest = np.argmax(np.abs(rest.up), axis=1)
    lies = 2 * largest + (rest.up[np.arange(len(flat)), largest] < 0)
    lies = np.where(graph.upright[nodes], _UPRIGHT, lies)
    lies = np.where(nodes < 0, _UPRIGHT + 1, lies)
    leads = (nodes >= 0) & (graph.moves[nodes] >= 0)
    return lies.reshape(up.shape[:-1]), leads.reshape(up.shape[:-1])
