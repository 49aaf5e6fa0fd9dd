"""Tasks that a search solves in seconds from some falls and not from others, and the bytes of the libraries of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from levade.costs import Criterion
from levade.tasks import Task, load_task

FALLEN = "start={fallen: {height: 0.5, time: 0.4}}"


def rolling(robot: str | None = None, *, start: str = FALLEN, polish: int = 4, trials: int = 24) -> Task:
    """Lie with the back anywhere but down, after a third of a second: some motions do, from some falls."""
    small = ("hold=0.1", "horizon=0.3", f"search.polish={polish}", "search.population=4", f"search.trials={trials}")
    task = load_task("self-righting", robot=robot, changes=[start, *small])
    return replace(task, success={"over": Criterion("tilt", maximum=1.9, at="end")})


def rolling_quickly(robot: str | None = None) -> Task:
    """`rolling` with half of the trials and no polish, for libraries that are built many times."""
    return rolling(robot, polish=0, trials=12)


def contents(directory: Path) -> dict[str, bytes]:
    """Every file of a library, except its lock and what an interrupted write left."""
    files = (path for path in sorted(directory.rglob("*")) if path.is_file() and path.name[0] != ".")
    return {str(path.relative_to(directory)): path.read_bytes() for path in files}
