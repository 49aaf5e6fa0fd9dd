"""Divide the work on a library among processes, each of which builds the simulation once.

    with Pool(Workshop(directory, robot), processes=2) as pool:
        for piece, rows in pool.each([Fall(4, after=(0, 1, 2, 3)), Fall(5, after=(0, 1, 2, 3))]):
            ...

The process that finds a motion writes it and its record; the others read them from the directory. Only numbers go between
processes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from levade.arrays import Array
from levade.library.asking import read_success
from levade.library.knowledge import Knowledge
from levade.library.records import Record
from levade.library.solving import Solver
from levade.library.storing import read_falls, read_hardware
from levade.motions import Motion
from levade.robots import Robot


@dataclass(frozen=True)
class Fall:
    """Asks to solve a fall with the motions that were known after other falls.

    Attributes:
        number: Number of the fall.
        after: Numbers of the falls whose motions may be used.
    """

    number: int
    after: tuple[int, ...]

    def __str__(self) -> str:
        return f"fall {self.number}"


@dataclass(frozen=True)
class Row:
    """Asks to try every motion from a fall.

    Attributes:
        number: Number of the fall.
        falls: Numbers of all falls of the library.
    """

    number: int
    falls: tuple[int, ...]

    def __str__(self) -> str:
        return f"fall {self.number}"


class Workshop:
    """Does pieces of a library's work in this process. Pickling leaves out the simulation that it builds.

    Args:
        directory: Directory of the library.
        robot: The library's robot. Defaults to the one that the task names.
    """

    def __init__(self, directory: Path, robot: Robot | None = None) -> None:
        self._directory, self._robot = directory, robot

    def __getstate__(self) -> dict[str, Any]:
        return {"_directory": self._directory, "_robot": self._robot}

    @cached_property
    def _solver(self) -> Solver:
        self._falls, seed = read_falls(self._directory, robot=self._robot)
        return Solver(self._falls, self._directory, seed, hardware=read_hardware(self._directory))

    def learn(self, records: Sequence[Record], motions: Mapping[int, Motion]) -> None:
        """Take note of other falls, so that they need not be read from the directory.

        Args:
            records: Records of the falls.
            motions: Number of a fall -> its motion.
        """
        self._solver.learn(records, motions)

    def __call__(self, piece: Fall | Row) -> tuple[Array, Array] | None:
        """Do a piece of work. Return the result of `Solver.rows` for a row; for a fall, write its record and return None."""
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
