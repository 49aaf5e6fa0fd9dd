"""A run: a solve that keeps a directory, so that nothing it computed is lost.

outcome = run(load_task("rearing"), seed=0, directory=Path("rearing"))
outcome = resume(Path("rearing"))

DIR/task.yaml         the task with every default filled in, and what was changed on the way; solving it again with the
                      same seed gives the same motion
DIR/motion.npz        the best motion: written at the end, and on the way whenever there is a better one (at most every
                      few seconds)
DIR/progress.csv      a line per generation
DIR/checkpoint.jsonl  a line per generation: what its simulations said (`levade.solve.Record`); a resumed run goes
                      through these again without simulating, to exactly the state where the run stopped
"""

from __future__ import annotations

import csv
import json
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, Any

import numpy as np

from levade.document import read_yaml
from levade.errors import LevadeError
from levade.motion import Motion, record, versions
from levade.solve import Generation, Objective, Record, Solution, solve
from levade.tasks import Change, Task, task_checksum, task_from_dict, task_to_yaml

TASK, MOTION, PROGRESS, CHECKPOINT = "task.yaml", "motion.npz", "progress.csv", "checkpoint.jsonl"

_END = '{"finished": true}\n'
"""Last line of the checkpoint of a run that came to its end."""

_SAVE_EVERY = 5.0
"""[s], between motions that are written on the way."""


@dataclass(frozen=True)
class Outcome:
    """What a run came to. wall: [s], of the search alone."""

    objective: Objective
    solution: Solution
    motion: Motion
    directory: Path
    seed: int
    wall: float


Steer = Callable[[int], Mapping[str, float] | None]
"""See `levade.solve.solve`."""


class StorageError(LevadeError):
    """The directory can no longer be written; what was there before still is."""


def run(
    task: Task | Objective,
    *,
    seed: int = 0,
    threads: int = 0,
    directory: Path,
    observe: Callable[[Generation], object] | None = None,
    steer: Steer | None = None,
) -> Outcome:
    """Solve a task and keep everything in a directory, which is made if need be; an earlier run in it is replaced.

    observe, steer: as in `levade.solve.solve`; task.yaml takes in what steer changes, before it is simulated.
    Raises LevadeError before anything is written if the task does not fit together or the directory cannot be written.
    """
    objective = task if isinstance(task, Objective) else Objective(task, threads=threads)
    task = objective.task
    made = versions(task.physics.engine)
    header = {"task": task.name, "seed": seed, "versions": made, "task_checksum": _checksum(task)}
    new = not directory.exists()
    try:
        directory.mkdir(parents=True, exist_ok=True)
        _write(directory / TASK, task_to_yaml(task))
        _write(directory / CHECKPOINT, json.dumps(header) + "\n")
        (directory / MOTION).unlink(missing_ok=True)
        checkpoint = (directory / CHECKPOINT).open("a", encoding="utf-8")
    except OSError as error:
        if new:
            with suppress(OSError):
                directory.rmdir()
        raise LevadeError(
            f"{directory}: cannot be written ({error.strerror}); give a directory that can: --out DIR"
        ) from None
    with _closing(checkpoint):
        return _run(objective, seed, directory, checkpoint, [], observe, steer)


def resume(
    directory: Path,
    *,
    objective: Objective | None = None,
    threads: int = 0,
    observe: Callable[[Generation], object] | None = None,
    steer: Steer | None = None,
) -> Outcome:
    """Go on with a run that was interrupted, to exactly the motion that it would have come to.

    objective: of the run's task, if there is one already. Raises LevadeError if there is no run in the directory, its
    task has been changed since, or other versions of the libraries made it.
    """
    task, header, records = read_run(directory)
    assert objective is None or objective.task == task
    now = versions(task.physics.engine)
    for name, version in header["versions"].items():
        if now.get(name) != version:
            raise LevadeError(
                f"{directory}: was started with {name} {version}, this is {now.get(name)}: going on would give another"
                f" motion; install {name}=={version}, or start anew"
            )
    if header.get("task_checksum") != _checksum(task):
        raise LevadeError(
            f"{directory / TASK}: has changed since the run began, so that it cannot go on; put it back, or start anew:"
            f" levade solve {directory / TASK} --force"
        )
    objective = objective or Objective(task, threads=threads)
    try:
        # a line that was cut off in the middle is written anew
        kept = [json.dumps(header), *(json.dumps(record.to_json()) for record in records)]
        _write(directory / CHECKPOINT, "".join(line + "\n" for line in kept))
        checkpoint = (directory / CHECKPOINT).open("a", encoding="utf-8")
    except OSError as error:
        raise LevadeError(f"{directory}: cannot be written ({error.strerror})") from None
    with _closing(checkpoint):
        return _run(objective, header["seed"], directory, checkpoint, records, observe, steer)


def unfinished(directory: Path) -> None:
    """Raise LevadeError if a run in the directory would replace an interrupted one, or files that are of no run."""
    if not (directory / CHECKPOINT).exists():
        for name in (TASK, MOTION, PROGRESS):
            if (directory / name).exists():
                raise LevadeError(
                    f"{directory / name}: is of no run here, and would be replaced; write elsewhere: --out DIR, or"
                    " replace it: --force"
                )
    try:
        _, header, records = read_run(directory)
    except LevadeError:
        return
    if (records or damage(directory)) and not _finished(directory):
        raise LevadeError(
            f"{directory}: holds an interrupted run (seed {header['seed']}, {len(records)} generations); go on with it:"
            f" levade solve --resume {directory}, replace it: --force, or write elsewhere: --out DIR"
        )


def _finished(directory: Path) -> bool:
    return (directory / CHECKPOINT).read_text(encoding="utf-8", errors="replace").endswith(_END)


def read_run(directory: Path) -> tuple[Task, dict[str, Any], list[Record]]:
    """Task, header (task, seed, versions) and records of a run's directory. Raises LevadeError if there is none."""
    if not (directory / CHECKPOINT).is_file() or not (directory / TASK).is_file():
        raise LevadeError(
            f"{directory}: no run to resume, {TASK} or {CHECKPOINT} is missing; give the --out of a solve"
        )
    task = task_from_dict(read_yaml(directory / TASK), where=str(directory / TASK))
    lines = (directory / CHECKPOINT).read_text(encoding="utf-8", errors="replace").splitlines()
    try:
        header = json.loads(lines[0])
        if not (isinstance(header["seed"], int) and isinstance(header["versions"], dict)):
            raise TypeError
    except (ValueError, LookupError, TypeError):
        raise LevadeError(f"{directory / CHECKPOINT}: damaged, its first line is no header; start anew") from None
    return task, header, list(_records(lines[1:]))


def damage(directory: Path) -> str | None:
    """What of a run's checkpoint cannot be read, in words; None if nothing. A last line that was cut off is no damage."""
    text = (directory / CHECKPOINT).read_text(encoding="utf-8", errors="replace").removesuffix(_END)
    lines = text[: text.rfind("\n") + 1].splitlines()[1:]
    whole = sum(1 for _ in _records(lines))
    if whole >= len(lines):
        return None
    return (
        f"{directory / CHECKPOINT}: line {whole + 2} of {len(lines) + 1} is damaged; what was recorded from generation"
        f" {whole + 1} on is simulated again"
    )


def _records(lines: list[str]) -> Iterator[Record]:
    """The records up to the first line that is not whole."""
    for line in lines:
        try:
            yield Record.from_json(json.loads(line))
        except (ValueError, LookupError, TypeError, AttributeError):
            return


def _run(
    objective: Objective,
    seed: int,
    directory: Path,
    checkpoint: IO[str],
    records: list[Record],
    observe: Callable[[Generation], object] | None,
    steer: Steer | None,
) -> Outcome:
    began = time.perf_counter()
    try:
        progress = _Progress(objective, directory)
    except OSError as error:
        raise StorageError(f"{directory / PROGRESS}: cannot be written ({error.strerror})") from None
    saved = time.perf_counter()
    best: Any = None

    def watch(generation: Generation) -> None:
        nonlocal saved, best
        try:
            if not generation.replayed:
                checkpoint.write(json.dumps(generation.record.to_json()) + "\n")
                checkpoint.flush()
            progress.write(generation)
            if generation.best is not best and not generation.replayed and time.perf_counter() - saved > _SAVE_EVERY:
                best = generation.best
                record(objective, so_far(generation), seed=seed).save(directory / MOTION)
                saved = time.perf_counter()
        except OSError as error:
            raise StorageError(
                f"{directory}: cannot be written any more ({error.strerror}) after {generation.trials} trials; make"
                f" room, then: levade solve --resume {directory}"
            ) from None
        if observe is not None:
            observe(generation)

    with progress:
        recorded = None if steer is None else _recorded(steer, objective.task, directory)
        solution = solve(objective, seed=seed, observe=watch, steer=recorded, records=records)
    wall = time.perf_counter() - began
    motion = record(objective, solution, seed=seed)
    try:
        motion.save(directory / MOTION)
        if solution.stopped != "interrupted":
            checkpoint.write(_END)
            checkpoint.flush()
    except OSError as error:
        raise StorageError(
            f"{directory / MOTION}: cannot be written ({error.strerror}); make room, then:"
            f" levade solve --resume {directory}"
        ) from None
    return Outcome(objective, solution, motion, directory, seed, wall)


def _recorded(steer: Steer, task: Task, directory: Path) -> Steer:
    """The same, with every change written to the task before it takes effect."""

    def recorded(generation: int) -> Mapping[str, float] | None:
        nonlocal task
        factors = steer(generation)
        if factors:
            task = task.changed(Change(generation, dict(factors)))
            try:
                _write(directory / TASK, task_to_yaml(task))
            except OSError as error:
                raise StorageError(
                    f"{directory / TASK}: cannot be written any more ({error.strerror}); make room, then:"
                    f" levade solve --resume {directory}"
                ) from None
        return factors

    return recorded


def so_far(generation: Generation) -> Solution:
    return Solution(
        best=generation.best,
        trials=generation.trials,
        generations=generation.generation,
        trials_to_success=generation.trials_to_success,
        diverged=generation.diverged,
        stopped="running",
        weights=generation.weights,
        changes=generation.changes,
    )


def _checksum(task: Task) -> int:
    """Of the task without the changes that a run makes in it on the way."""
    return task_checksum(replace(task, search=replace(task.search, changes=())))


def _write(path: Path, text: str) -> None:
    """Write a file, or leave the one that is there. Raises OSError."""
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


@contextmanager
def _closing(file: IO[str]) -> Iterator[None]:
    """Close a file whose every line has been flushed: what a full disk refused is not tried, and reported, again."""
    try:
        yield
    finally:
        with suppress(OSError):
            file.close()


class _Progress:
    """progress.csv: a line per generation."""

    def __init__(self, objective: Objective, directory: Path) -> None:
        task = objective.task
        self._terms, self._criteria = list(task.costs), list(task.success)
        self._file = (directory / PROGRESS).open("w", encoding="utf-8", newline="")
        self._table = csv.writer(self._file)
        self._table.writerow(
            [
                *("generation", "trials", "stage", "cost_best", "cost_generation_best", "cost_generation_median"),
                *("cost_generation_worst", "step", "diverged", "success"),
                *(f"term_{name}" for name in self._terms),
                *(f"error_{name}" for name in self._criteria),
            ]
        )

    def __enter__(self) -> _Progress:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(OSError):
            self._file.close()

    def write(self, g: Generation) -> None:
        """A line: costs of the generation as its stage weighs them, the best trial so far by the task's own weights."""
        numbers = [g.best.cost, g.cost.min(), np.median(g.cost), g.cost.max(), g.step]
        own = [*(g.best.terms[name] for name in self._terms), *(g.best.errors[name] for name in self._criteria)]
        self._table.writerow(
            [
                *(g.generation, g.trials, g.stage_name),
                *(f"{number:.9g}" for number in numbers),
                *(g.diverged, int(g.best.success)),
                *("" if np.isnan(number) else f"{number:.9g}" for number in own),
            ]
        )
        self._file.flush()
