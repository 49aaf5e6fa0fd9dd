"""Read and write which motion works from which fall: a library's file ``success.npz``.

known = read_outcomes(directory, Knowledge.of(records, mirror))
write_outcomes(directory, known)

The file has a table of all falls and motions, on the model and on perturbed models. It also has practice: further falls from
which no motion was searched for, and from each of which only the likeliest motions were tried.
"""

from __future__ import annotations

import zipfile
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from levade.errors import LevadeError, Remedy
from levade.library.knowledge import Knowledge, Practice
from levade.search.storage import storing
from levade.writing import replacing

SUCCESS = "success.npz"
"""Name of the file; a build writes it at its end."""

_TABLES = ("success", "perturbed")
_STATES = ("falls", "up", "joint_position")
_UNKNOWN = -1


def read_outcomes(directory: Path, knowledge: Knowledge) -> Knowledge:
    """Add to knowledge what a build has written, as far as it did.

    Args:
        directory: Directory of the library.
        knowledge: What the records say. It names falls and motions.

    Returns:
        The knowledge with the tables of the file. With its practice too, if the file has the same falls and motions.

    Raises:
        LevadeError: If the file is damaged.
    """
    place = directory / SUCCESS
    if not place.is_file():
        return knowledge
    try:
        with np.load(place, allow_pickle=False) as file:
            falls, motions, *written = (file[name] for name in ("falls", "motions", *_TABLES))
            practice = _practice_of(file, len(motions)) if "practice_falls" in file else None
        if any(one.shape != (len(falls), len(motions)) for one in written):
            raise ValueError
    except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile, zlib.error):
        raise LevadeError(f"{place}: the file is damaged; remove it, and build the library again") from None
    rows, here = np.intersect1d(knowledge.falls, falls, return_indices=True)[1:]
    columns, there = np.intersect1d(knowledge.motions, motions, return_indices=True)[1:]
    tables = {name: np.full(knowledge.success.shape, np.nan) for name in _TABLES}
    for table, one in zip(tables.values(), written, strict=True):
        table[np.ix_(rows, columns)] = one[np.ix_(here, there)]
    known = knowledge.merged(tables)
    same = np.array_equal(falls, known.falls) and np.array_equal(motions, known.motions)
    return replace(known, practice=practice) if same else known


def write_outcomes(directory: Path, known: Knowledge) -> None:
    """Write which motion works from which fall.

    Args:
        directory: Directory of the library.
        known: Knowledge without NaN in its tables.

    Raises:
        LevadeError: If the file cannot be written.
    """
    place = directory / SUCCESS
    arrays: dict[str, Any] = {name: getattr(known, name) == 1.0 for name in _TABLES}
    if known.practice is not None:
        arrays |= {f"practice_{name}": getattr(known.practice, name) for name in _STATES}
        for name in _TABLES:
            arrays[f"practice_{name}"] = np.nan_to_num(getattr(known.practice, name), nan=_UNKNOWN).astype(np.int8)
    with storing(place, then=Remedy("make room, then build again")), replacing(place) as partial:
        np.savez(partial, falls=known.falls, motions=known.motions, **arrays)


def _practice_of(file: Any, motions: int) -> Practice:
    states = [file[f"practice_{name}"] for name in _STATES]
    tables = [file[f"practice_{name}"].astype(float) for name in _TABLES]
    n = len(states[0])
    if any(len(one) != n for one in states) or any(one.shape != (n, motions) for one in tables):
        raise ValueError
    return Practice(*states, *(np.where(one == _UNKNOWN, np.nan, one) for one in tables))
