"""``levade robots rightability`` says from which ways to lie a robot gets up, by joints alone and by a library's motions."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.markup import escape
from rich.table import Table

from levade.cli.tables import make_console
from levade.errors import LevadeError
from levade.library import Library
from levade.library.falls import FACES
from levade.rightability import Found, Graph, found_motions, rightability
from levade.rightability.map import check_map, draw_map
from levade.rightability.righting import Share
from levade.robots import Robot, load_robot

SLOPES = (0.0, 10.0, 20.0, 30.0)
"""[degrees]"""
_STEEPEST = 45.0


def tell_rightability(
    name: str,
    *,
    slopes: Sequence[float] | None,
    library: Path | None,
    picture: Path | None,
    angles: int,
    as_json: bool,
) -> None:
    """Print from which ways to lie a robot gets up.

    Args:
        name: Name or file of the robot.
        slopes: Slopes of the ground [degrees].
        library: Directory of a library.
        picture: File for the map.
        angles: Largest number of combinations of angles for each leg.
        as_json: Whether to print one JSON object.

    Raises:
        LevadeError: If an argument is wrong.
    """
    chosen = sorted(set(slopes or SLOPES))
    for slope in chosen:
        if not 0.0 <= slope <= _STEEPEST:
            raise LevadeError(f"is {slope:g}; should be from 0 to {_STEEPEST:g} degrees", field="slope")
    if picture is not None:
        check_map(picture)
    robot = load_robot(name)
    falls = None if library is None else Library.load(library)
    found = None if falls is None else found_motions(falls, robot)
    graphs = rightability(robot, slopes=[math.radians(slope) for slope in chosen], angles=angles)
    if picture is not None:
        draw_map(graphs[0], picture, () if falls is None else falls.records)
    if as_json:
        print(json.dumps(_content(robot, graphs, found, library, picture), ensure_ascii=False))
        return
    console = make_console()
    for table in _slow(graphs, found):
        console.print(table)
        console.print()
    first = graphs[0].postures
    per_leg = " x ".join(f"{len(values)} of {joint}" for joint, values in first.values.items())
    console.print(
        f"[dim]Joint angles of each leg: {escape(per_leg)}. {first.count} postures, {len(first.steps)} steps.[/]"
    )
    console.print(
        "[dim]Slowly: no momentum, no slipping, no limit of torque. docs/rightability.md says what that means.[/]"
    )
    if picture is not None:
        console.print(f"Written: {escape(str(picture))}")


def _slow(graphs: list[Graph], found: dict[str, Found] | None) -> list[Table]:
    slope = np.degrees(graphs[0].slope)
    ground = "flat ground" if slope == 0 else f"a slope of {slope:g}°"
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold", title=f"On {ground}", title_justify="left")
    for heading in ("rests on", "neutral posture", "gets up slowly", "any posture", "gets up slowly"):
        table.add_column(heading, justify="left" if heading == "rests on" else "right")
    if found is not None:
        for heading in ("falls", "with a motion", "95 % interval"):
            table.add_column(heading, justify="right")
    shares = [(graph.shares(neutral=True), graph.shares()) for graph in graphs]
    neutral, anyhow = shares[0]
    for face in (*FACES, "all"):
        row = [face, *_cells(neutral[face]), *_cells(anyhow[face])]
        if found is not None:
            one = found[face]
            low, high = one.interval
            row += (
                [str(one.falls), f"{one.share:.1%}", f"{low:.1%} to {high:.1%}"]
                if one.share is not None
                else ["0", "", ""]
            )
        table.add_row(*row, end_section=face == FACES[-1])
    tables = [table]
    if len(graphs) > 1:
        other = Table(box=None, padding=(0, 2, 0, 0), header_style="bold", title="By slope", title_justify="left")
        for heading in ("slope", "gets up slowly: neutral posture", "any posture", "rolls on"):
            other.add_column(heading, justify="right")
        for graph, (neutral, anyhow) in zip(graphs, shares, strict=True):
            other.add_row(
                f"{np.degrees(graph.slope):g}°",
                f"{neutral['all'].leads:.1%}",
                f"{anyhow['all'].leads:.1%}",
                f"{anyhow['rolls'].likelihood:.1%}",
            )
        tables.append(other)
    return tables


def _cells(share: Share) -> tuple[str, str]:
    return f"{share.likelihood:.1%}", "" if math.isnan(share.leads) else f"{share.leads:.1%}"


def _content(
    robot: Robot, graphs: list[Graph], found: dict[str, Found] | None, library: Path | None, picture: Path | None
) -> dict[str, Any]:
    """Return what ``--json`` prints: shares from 0 to 1, null where nothing was counted."""
    postures = graphs[0].postures
    dynamic = None
    if found is not None:
        dynamic = {"library": str(library), "faces": {}}
        for face, one in found.items():
            low, high = one.interval
            dynamic["faces"][face] = {
                "falls": one.falls, "motions": one.motions, "share": one.share, "low": low, "high": high,
            }  # fmt: skip
    return {
        "robot": robot.name,
        "angles": {joint: list(values) for joint, values in postures.values.items()},
        "postures": postures.count,
        "steps": len(postures.steps),
        "slopes": [_on(graph) for graph in graphs],
        "dynamic": dynamic,
        **({} if picture is None else {"written": [str(picture)]}),
    }


def _on(graph: Graph) -> dict[str, Any]:
    def shares(neutral: bool) -> dict[str, Any]:
        return {
            name: {"likelihood": share.likelihood, "leads": None if math.isnan(share.leads) else share.leads}
            for name, share in graph.shares(neutral=neutral).items()
        }

    poses = [
        {
            "up": pose.up.tolist(),
            "on": pose.on,
            "likelihood": pose.likelihood,
            "upright": pose.upright,
            "leads": pose.leads,
            "moves": pose.moves,
        }
        for pose in graph.poses()
    ]
    return {
        "slope": float(np.degrees(graph.slope)),
        "poses": poses,
        "neutral": shares(neutral=True),
        "any": shares(neutral=False),
    }
