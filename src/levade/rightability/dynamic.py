"""From what share of a library's falls a motion was found, by how the robot lies.

found_motions(library)["back"]              # Found(falls=81, motions=81)
"""

from __future__ import annotations

from dataclasses import dataclass

from levade.checks.statistics import wilson
from levade.errors import LevadeError
from levade.library import Library
from levade.library.falls import FACES, face
from levade.library.records import Method
from levade.robots import Robot


@dataclass(frozen=True)
class Found:
    """Counts falls.

    Attributes:
        falls: Number of falls.
        motions: Number of these from which a motion was found.
    """

    falls: int
    motions: int

    @property
    def share(self) -> float | None:
        """Share of falls from which a motion was found; None without falls."""
        return self.motions / self.falls if self.falls else None

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % confidence interval of the share."""
        return wilson(self.motions, self.falls)


def found_motions(library: Library, robot: Robot | None = None) -> dict[str, Found]:
    """Count falls as they come, without the rare ones that a build adds, and motions that were found.

    Args:
        library: The library.
        robot: The robot to which it should belong. Not compared by default.

    Returns:
        One entry for each of `levade.library.falls.FACES`, and "all".

    Raises:
        LevadeError: If the library is of a robot with other joints.
    """
    joints = {len(record.joint_position) for record in library.records}
    if robot is not None and joints - {len(robot.joint_names)}:
        raise LevadeError(
            f"{library.directory}: its robot has {min(joints)} joints, {robot.name} has {len(robot.joint_names)};"
            " give a library of this robot",
            field="library",
        )
    lies = [(face(record.up), record.method != Method.NONE) for record in library.records if not record.rare]
    counted = {name: Found(*_count([up for at, up in lies if at == name])) for name in FACES}
    return {**counted, "all": Found(*_count([up for _, up in lies]))}


def _count(found: list[bool]) -> tuple[int, int]:
    return len(found), sum(found)
