"""Export ``csv``: a table with one header line, for spreadsheets, pandas, PlotJuggler and `player.py`."""

from __future__ import annotations

import csv
import json
from importlib import resources
from pathlib import Path

import numpy as np

from levade.archive import packed
from levade.arrays import Array
from levade.exports.content import Content, describe
from levade.exports.player import checksum
from levade.exports.samples import Samples
from levade.feedback import Feedback

META, FEEDBACK = "meta.json", "feedback.npz"
XYZ, WXYZ = ("x", "y", "z"), ("w", "x", "y", "z")


def columns(samples: Samples) -> dict[str, Array]:
    """Return the name of each column -> its values.

    Args:
        samples: The rows.

    Returns:
        Name -> values, shape (rows,), in the order of the table.
    """
    table = {"time": samples.time}
    for i, joint in enumerate(samples.joints.names):
        for name in ("position", "velocity", "torque"):
            table[f"command/{joint}/{name}"] = getattr(samples, f"command_{name}")[:, i]
        for name in ("kp", "kd"):
            table[f"command/{joint}/{name}"] = np.full(len(samples.time), getattr(samples.joints, name)[i])
    for i, joint in enumerate(samples.joints.names):
        for name in ("position", "velocity", "torque"):
            table[f"state/{joint}/{name}"] = getattr(samples, f"joint_{name}")[:, i]
    for name in ("position", "com_position", "quaternion", "linear_velocity", "angular_velocity"):
        values = getattr(samples, f"trunk_{name}")
        for i, axis in enumerate(WXYZ if name == "quaternion" else XYZ):
            table[f"state/trunk/{name}/{axis}"] = values[:, i]
    for i, foot in enumerate(samples.feet):
        for k, axis in enumerate(XYZ):
            table[f"state/{foot}/contact_force/{axis}"] = samples.foot_contact_force[:, i, k]
    return table


def write_table(path: Path, table: dict[str, Array]) -> None:
    """Write columns with all their digits. Reading the numbers gives the same bits.

    Args:
        path: File to write.
        table: Name of each column -> its values, shape (rows,).
    """
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(np.column_stack(list(table.values())).tolist())


def write(content: Content, directory: Path) -> list[str]:
    """Write motion.csv, and next to it meta.json and player.py. A stabiliser adds feedback.npz.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    table, feedback = directory / "motion.csv", directory / FEEDBACK
    write_table(table, columns(content.playing))
    belongs = [table.read_bytes()]
    if content.feedback is not None:
        write_feedback(feedback, content.feedback)
        belongs.append(feedback.read_bytes())
    meta = describe(content, content.playing)
    write_json(directory / META, meta | {"checksum": checksum(meta, *belongs)}, indent=2)
    write_player(directory)
    return []


def write_feedback(path: Path, feedback: Feedback) -> None:
    """Write a stabiliser's arrays for numpy. The same arrays give the same bytes.

    Args:
        path: File to write.
        feedback: The stabiliser.
    """
    path.write_bytes(packed({"gain": feedback.gain, "reference": feedback.reference}))


def write_player(directory: Path) -> None:
    """Write player.py, a copy of the module.

    Args:
        directory: Directory to write into; it exists.
    """
    write_script("player.py", directory / "player.py")


def write_script(name: str, place: Path) -> None:
    """Write a script of this room that runs on its own. If it imports the player, the player must be next to it.

    Args:
        name: File name of the script in `levade.exports`.
        place: File to write.
    """
    source = resources.files("levade.exports").joinpath(name).read_text(encoding="utf-8")
    place.write_text(source.replace("from levade.exports import player\n", "import player\n"), encoding="utf-8")


def write_json(path: Path, content: object, *, indent: int | None = None) -> None:
    """Write a JSON file. Numbers have all their digits.

    Args:
        path: File to write.
        content: Content that JSON can hold.
        indent: Spaces by which each level is indented. None writes one line.
    """
    path.write_text(to_json(content, indent=indent) + "\n", encoding="utf-8")


def to_json(content: object, *, indent: int | None = None) -> str:
    """Return strict JSON: it has no NaN or infinity.

    Args:
        content: Content that JSON can hold.
        indent: Spaces by which each level is indented. None gives one line.

    Returns:
        JSON.

    Raises:
        ValueError: If a number is NaN or infinite.
    """
    return json.dumps(content, ensure_ascii=False, allow_nan=False, indent=indent)
