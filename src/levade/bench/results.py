"""Keep the results of a bench: one row per run, in a CSV file that grows, and in Parquet.

A row is appended in one write, so an interruption leaves whole rows. An incomplete last row is ignored.
"""

from __future__ import annotations

import csv
import dataclasses
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from levade import writing
from levade.errors import LevadeError
from levade.optimizers import canonical


@dataclass(frozen=True)
class Result:
    """Reports one run.

    Attributes:
        budget_trials: Budget in trials. None for no limit.
        budget_steps: Budget in physics steps. None for no limit.
        trials: Trials that were spent.
        steps: Physics steps of all roll-outs.
        core_seconds: CPU time of the search [s].
        trials_to_success: Trials until one first met every success criterion, in whole generations. None if none did.
        steps_to_success: Physics steps until then. None if none did.
        core_seconds_to_success: CPU time until then [s]. None if none did.
        cost_to_success: Cost of the best trial at that time.
        success: Whether a trial met every success criterion.
        cost: Cost of the best trial at the end, by the task's own weights.
        stopped: Why the run ended: "success" (and polished), "budget" or "steps".
        checksum: Checksum of the task and the budget.
        versions: Versions that made it.
    """

    task: str
    robot: str
    optimizer: str
    seed: int
    until: str
    budget_trials: int
    budget_steps: int | None
    success: bool
    trials: int
    trials_to_success: int | None
    steps: int
    steps_to_success: int | None
    core_seconds: float
    core_seconds_to_success: float | None
    cost: float
    cost_to_success: float | None
    diverged: int
    stopped: str
    checksum: int
    versions: str

    @property
    def key(self) -> tuple[str, str, str, int]:
        """The key of its case: see `levade.bench.plan.Case.key`."""
        return self.task, self.robot, canonical(self.optimizer), self.seed


COLUMNS = tuple(field.name for field in dataclasses.fields(Result))
_KINDS = {field.name: str(field.type) for field in dataclasses.fields(Result)}


def append(path: Path, result: Result) -> None:
    """Add a row to a file, which is created if it does not exist.

    Args:
        path: The file.
        result: The row.

    Raises:
        LevadeError: If it cannot be written.
    """
    new = not path.exists() or path.stat().st_size == 0
    text = (_line(COLUMNS) if new else "") + _line([_text(getattr(result, name)) for name in COLUMNS])
    try:
        writing.append(path, text.encode())
    except OSError as error:
        raise LevadeError(
            f"{path}: cannot be written ({error.strerror}); make room, then call again to go on"
        ) from None


def write(path: Path, results: Iterable[Result]) -> None:
    """Replace a file by these rows, or leave it unchanged.

    Args:
        path: The file.
        results: The rows.

    Raises:
        LevadeError: If it cannot be written.
    """
    lines = [_line(COLUMNS), *(_line([_text(getattr(result, name)) for name in COLUMNS]) for result in results)]
    try:
        writing.write_text(path, "".join(lines))
    except OSError as error:
        raise LevadeError(f"{path}: cannot be written ({error.strerror})") from None


def read(path: Path) -> list[Result]:
    """Read the rows of a file, without an incomplete last one. If several have the same key, the first counts.

    Args:
        path: The file.

    Returns:
        The rows.

    Raises:
        LevadeError: If the file cannot be read, or does not belong to a bench.
    """
    try:
        text = path.read_bytes().decode("utf-8", errors="replace")
    except OSError as error:
        raise LevadeError(f"{path}: cannot be read ({error.strerror}); give the results.csv of a bench") from None
    lines = text.splitlines(keepends=True)
    if lines and not lines[-1].endswith("\n"):
        lines.pop()
    rows = list(csv.reader(lines))
    if not rows or tuple(rows[0]) != COLUMNS:
        raise LevadeError(f"{path}: is no results.csv of a bench, or of another version of levade")
    found: dict[tuple[str, str, str, int], Result] = {}
    for number, row in enumerate(rows[1:], start=2):
        try:
            result = Result(**{name: _value(name, text) for name, text in zip(COLUMNS, row, strict=True)})
        except ValueError:
            raise LevadeError(f"{path}: line {number} is damaged; remove it, and its run will be made again") from None
        found.setdefault(result.key, result)
    return list(found.values())


def write_parquet(path: Path, results: Sequence[Result]) -> None:
    """Write rows to a Parquet file.

    Args:
        path: The file.
        results: The rows.

    Raises:
        LevadeError: If it cannot be written, or pyarrow is missing.
    """
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise LevadeError("Parquet needs pyarrow; pip install 'levade[bench]'") from None
    kinds = {"str": pyarrow.string(), "int": pyarrow.int64(), "float": pyarrow.float64(), "bool": pyarrow.bool_()}
    schema = pyarrow.schema([(name, kinds[kind.split(" ")[0]]) for name, kind in _KINDS.items()])
    table = pyarrow.Table.from_pylist([dataclasses.asdict(result) for result in results], schema=schema)
    try:
        with writing.replacing(path) as partial:
            pyarrow.parquet.write_table(table, partial)
    except OSError as error:
        raise LevadeError(f"{path}: cannot be written ({error.strerror})") from None


def _line(cells: Sequence[str]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


def _text(value: Any) -> str:
    return "" if value is None else str(int(value)) if isinstance(value, bool) else str(value)


def _value(name: str, text: str) -> Any:
    kind = _KINDS[name]
    if text == "" and kind.endswith("None"):
        return None
    kind = kind.split(" ")[0]
    if kind == "bool":
        return bool(int(text))
    return {"str": str, "int": int, "float": float}[kind](text)
