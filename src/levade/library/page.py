"""Write library.html: a page that needs no network, with how the robot lies, what gets it up, and a few motions to play.

    write_library(library, "falls/library.html")

The page has the script and style of `levade.report.page`. The same library gives the same bytes, wherever it lies. It may still
be under construction: the page says how far it has come.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.library.asking import Library
from levade.library.building import rounds
from levade.library.failing import failures
from levade.library.falls import FACES, face
from levade.library.figure import projected
from levade.library.pursuing import read_certificate
from levade.library.records import Method, Record, fall_of, image_of, motion_path
from levade.library.storing import read_library, read_shard, read_starts
from levade.motions import Motion
from levade.report.packing import pack
from levade.report.page import assembled, save_page
from levade.report.scene import scene_data
from levade.version import __version__

PAGE = "library.html"
"""Name of the page in a library's directory."""

_METHODS = tuple(Method)
"""How falls are solved, in the order of the page's numbers."""

_RATE = 60.0
"""Most poses of a motion per second [Hz]. A page holds several motions."""

_PLAYED = 5
"""Number of motions that can be played on the page."""

_SHOWN = 3
"""Number of failures that can be played on the page."""

_LISTED = 8
"""Number of motions that the page lists. Beyond those that cover all falls, they are the ones that work from most."""

_PITCH = 0.05
"""Largest distance between neighbouring dots of the map, as a share of the disc's radius."""

_ROOM = 3.0
"""Smallest number of places on a disc for each dot."""


def write_library(library: Library, path: str | Path | None = None, *, instead: str = "give another path") -> Path:
    """Write a library's page.

    Args:
        library: The library.
        path: File to write. Defaults to library.html in the library's directory.
        instead: What to do instead, for an error's message.

    Returns:
        The page's path.

    Raises:
        LevadeError: If the library is damaged, the file cannot be written, or the path holds a file that is no page of levade.
    """
    return save_page(library_page(library), library.directory / PAGE if path is None else path, instead=instead)


def library_page(library: Library) -> str:
    """Return the page as text.

    Args:
        library: The library.

    Raises:
        LevadeError: If the library is damaged.
    """
    data = library_data(library)
    return assembled(f"Motion library: {data['task']} on {data['robot']}", data, "library")


def library_data(library: Library) -> dict[str, Any]:
    """Return the page's data for JSON. web/src/library.js draws it.

    Args:
        library: The library.

    Raises:
        LevadeError: If the library is damaged.
    """
    task, seed = read_library(library.directory)
    known, records = library.knowledge, library.records
    works, perturbed = known.success == 1.0, known.perturbed == 1.0
    pitch, place = placed(known.up)
    played = _played(library)
    starts = len(read_shard(library.directory).of(read_starts(library.directory)))
    drawn = [record for record in records if not record.rare]
    rare = len(records) - len(drawn)
    complete = bool(len(records)) and not np.isnan(known.success + known.perturbed).any()
    return {
        "task": task.name,
        "description": task.description,
        "robot": next((one["robot"] for one in played), task.robot.name),
        "starts": starts + rare,
        "rare": rare,
        "folds": library.fold is not None,
        "complete": complete,
        "motions": sum(record.motion == record.fall for record in records),
        "mirrored": known.mirror is not None,
        "coverage": int(works.any(axis=1).sum()),
        "perturbed": int(perturbed.any(axis=1).sum()) if complete else None,
        "certificates": _certificates(library) if library.hardware else None,
        "falls": {
            "number": pack([record.fall for record in records], "u4"),
            "method": pack([_METHODS.index(record.method) for record in records], "u2"),
            "motion": [record.motion for record in records],
            "trials": pack([record.trials for record in records], "u4"),
            "face": pack([FACES.index(face(record.up)) for record in records], "u2"),
            "tilt": pack(np.arccos(np.clip(known.up[:, 2], -1.0, 1.0))),
            "above": pack(known.up[:, 2] >= 0, "u2"),
            "place": pack(place),
            "works": pack(works.sum(axis=1), "u4"),
            "perturbed": pack(perturbed.sum(axis=1), "u4") if complete else None,
        },
        "methods": [method.value for method in _METHODS],
        "lying": list(FACES),
        "pitch": pitch,
        "rounds": [
            {"first": first, "last": last - 1, "trials": float(np.mean([one.trials for one in drawn[first:last]]))}
            for first, last in rounds(len(drawn))
        ],
        "faces": list(_faces(records, works, perturbed if complete else None)),
        "cover": [{"motion": number, "falls": falls} for number, falls in known.cover()],
        "listed": list(_listed(library, works, perturbed if complete else None)),
        "scene": played[0]["scene"] if played else None,
        "failed": list(_failed(library, played[0]["scene"])) if played else [],
        "played": [{key: value for key, value in one.items() if key not in ("robot", "scene")} for one in played],
        "provenance": {
            "seed": seed,
            "fallen": None if task.start.fallen is None else {"height": task.start.fallen.height},
            "trials": sum(record.trials for record in records),
            "written_by": f"levade {__version__}",
        },
    }


def placed(up: Array) -> tuple[float, Array]:
    """Place a dot for each upward direction on the discs of `levade.library.figure`, so that no two overlap.

    The dots of a disc lie on a triangular grid. In turn, each takes the free place that is nearest to where its direction is
    projected. Where many falls end alike, their dots form a patch, whose area is their number.

    Args:
        up: Upward directions in trunk axes, shape (n, 3).

    Returns:
        Distance between neighbouring places, as a share of the disc's radius, and places to the right and upwards, shape
        (n, 2).
    """
    above = up[:, 2] >= 0
    most = max(int(above.sum()), int((~above).sum()), 1)
    pitch = float(min(_PITCH, np.sqrt(np.pi / (np.sqrt(0.75) * _ROOM * most))))
    rows = np.arange(-np.ceil(1.0 / (pitch * np.sqrt(0.75))), np.ceil(1.0 / (pitch * np.sqrt(0.75))) + 1)
    columns = np.arange(-np.ceil(1.0 / pitch), np.ceil(1.0 / pitch) + 1)
    grid = np.array(
        [(pitch * (column + row % 2 / 2), pitch * np.sqrt(0.75) * row) for row in rows for column in columns]
    )
    grid = grid[np.hypot(grid[:, 0], grid[:, 1]) <= 1.0]
    there = np.stack(projected(up), axis=1)
    for half in (above, ~above):
        free = np.ones(len(grid), dtype=bool)
        for i in np.flatnonzero(half):
            far = np.where(free, np.square(grid - there[i]).sum(axis=1), np.inf)
            place = int(np.argmin(far))
            free[place], there[i] = False, grid[place]
    return pitch, there


def _faces(records: tuple[Record, ...], works: Array, perturbed: Array | None) -> Iterator[dict[str, Any]]:
    """Yield what the robot lies on, in how many falls, and from how many of them a motion works."""
    lying = np.array([face(record.up) for record in records])
    for name in FACES:
        which = lying == name
        if which.any():
            yield {
                "name": name,
                "falls": int(which.sum()),
                "works": int(works[which].any(axis=1).sum()),
                "perturbed": None if perturbed is None else int(perturbed[which].any(axis=1).sum()),
            }


def _listed(library: Library, works: Array, perturbed: Array | None) -> Iterator[dict[str, Any]]:
    """Yield motions: those of the cover, in its order, then those that work from most falls."""
    motions = library.knowledge.motions
    column = {int(number): j for j, number in enumerate(motions)}
    records = {record.fall: record for record in library.records}
    cover = dict(library.knowledge.cover())
    most = sorted(column, key=lambda number: (-int(works[:, column[number]].sum()), number < 0, fall_of(number)))
    for number in [*cover, *(one for one in most if one not in cover)][: max(_LISTED, len(cover))]:
        record, which = records[fall_of(number)], works[:, column[number]]
        yield {
            "motion": number,
            "fall": fall_of(number),
            "mirrored": number < 0,
            "method": record.method.value,
            "trials": record.trials,
            "covered": cover.get(number),
            "works": int(which.sum()),
            "perturbed": None if perturbed is None else int(perturbed[:, column[number]].sum()),
            "falls": pack(np.flatnonzero(which), "u4"),
            "certificate": _certificate(library, number) if library.hardware else None,
        }


def _certificates(library: Library) -> dict[str, Any]:
    """Return how many motions have a certificate that passes, and how many fail each demand, the most frequent first."""
    failed = library.certificates
    counts = Counter(name for one in failed.values() for name in one)
    return {
        "motions": len(failed),
        "passed": sum(not one for one in failed.values()),
        "failed": [{"name": name, "motions": n} for name, n in counts.most_common()],
    }


def _certificate(library: Library, motion: int) -> dict[str, Any]:
    """Return what a motion's certificate says: the demands it fails, its share of perturbed robots, and the nearest limit."""
    content = read_certificate(library.directory, motion)
    return {
        "failed": list(content["failed"]),
        "share": content["perturbed"]["share"],
        "binding": content.get("binding", ""),
    }


def _played(library: Library) -> list[dict[str, Any]]:
    """Return the first motions of the cover, as the page plays them. A mirror image is shown by the motion itself."""
    falls = list(dict.fromkeys(fall_of(number) for number, _ in library.knowledge.cover()))
    falls += [record.fall for record in library.records if record.motion == record.fall and record.fall not in falls]
    found: list[dict[str, Any]] = []
    for fall in falls[:_PLAYED]:
        motion = Motion.load(motion_path(library.directory, fall))
        found.append({"motions": [fall, image_of(fall)], **_scene(motion, found[0]["scene"] if found else None)})
    return found


def _failed(library: Library, like: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield what the likeliest motion does from the first falls that no motion gets up from."""
    for one in failures(library, most=_SHOWN):
        missed = [{"name": name, "error": error} for name, error in one.missed.items()]
        scene = _scene(one.motion, like)
        del scene["scene"], scene["robot"]
        yield {"fall": one.fall, "motions": [one.number], "missed": missed, **scene}


def _scene(motion: Motion, like: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return a motion as the page plays it, with the shapes of another one's scene."""
    scene = scene_data(motion, like=like, rate=_RATE)
    return {
        "robot": motion.robot,
        "scene": scene,
        "horizon": motion.horizon,
        "end": motion.duration,
        "motion": {**scene["motion"], "reference": None},
        "layers": [layer for layer in scene["layers"] if layer["name"] != "reference"],
    }
