"""A library's falls as pieces of work for processes of their own, each of which builds the simulation once.

    with Pool(Workshop(directory, robot), processes=2) as pool:
        for piece, rows in pool.each([Fall(4, after=(0, 1, 2, 3)), Fall(5, after=(0, 1, 2, 3))]):
            ...

Records and motions are written by the process that found them, and read from the directory by the others: what goes between
processes is numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from levade.arrays import Array
from levade.library.asking import read_success
from levade.library.falls import Falls
from levade.library.knowledge import Knowledge
from levade.library.solving import Solver
from levade.library.storing import read_library
from levade.robots import Robot


@dataclass(frozen=True)
class Fall:
    """A fall to solve with the motions that were there after other ones."""

    number: int
    after: tuple[int, ...]

    def __str__(self) -> str:
        return f"fall {self.number}"


@dataclass(frozen=True)
class Row:
    """A fall from which every motion is to be tried; falls: all of the library."""

    number: int
    falls: tuple[int, ...]

    def __str__(self) -> str:
        return f"fall {self.number}"


class Workshop:
    """Does pieces of a library's work in this process; what it builds does not go to others by pickle.

    Args:
        directory: The library's.
        robot: Its robot, if the task's name does not say it.
    """

    def __init__(self, directory: Path, robot: Robot | None = None) -> None:
        self._directory, self._robot = directory, robot

    def __getstate__(self) -> dict[str, Any]:
        return {"_directory": self._directory, "_robot": self._robot}

    @cached_property
    def _solver(self) -> Solver:
        task, seed = read_library(self._directory)
        self._falls = Falls(task, robot=self._robot, seed=seed, threads=1)
        return Solver(self._falls, self._directory, seed)

    def __call__(self, piece: Fall | Row) -> tuple[Array, Array] | None:
        """Do a piece: of a row what `Solver.rows` gives; a fall's record is in the directory then."""
        solver = self._solver
        if isinstance(piece, Fall):
            solver.load(piece.after)
            solver.solve([piece.number], after=piece.after)
            return None
        solver.load(piece.falls)
        known = Knowledge.of([solver.records[i] for i in piece.falls], self._falls.mirror)
        known = known.merged(read_success(self._directory, known))
        success, perturbed = solver.rows(known, [list(known.falls).index(piece.number)])
        return success[0], perturbed[0]
