"""Run searches that write to a directory, so that nothing they computed is lost.

outcome = run(load_task("rearing"), seed=0, directory=Path("rearing"))
outcome = resume(Path("rearing"))

DIR/task.yaml         the task with every default filled in, and the changes made on the way; solving it again with the
                      same seed gives the same motion
DIR/motion.npz        the best motion: written at the end, and on the way when a better one is found (at most every
                      few seconds)
DIR/progress.csv      a line per generation
DIR/checkpoint.jsonl  a line per evaluation: see `levade.search.checkpoint`
DIR/.levade-lock      exists while the run goes on: see `levade.locking`
"""

from __future__ import annotations

import errno
import time
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from levade import locking, writing
from levade.document import read_yaml
from levade.errors import LevadeError, Remedy
from levade.locking import locked
from levade.motions import Motion, versions
from levade.search import checkpoint as checkpoints
from levade.search.checkpoint import CHECKPOINT, Checkpoint, Header, LayoutError, Writer
from levade.search.evaluation import Record
from levade.search.initial import InitialGuess
from levade.search.loop import Observe, solve
from levade.search.objective import Objective, make_objective
from levade.search.outcome import Generation, Solution, Stopped, Trial
from levade.search.progress import PROGRESS, Progress
from levade.search.recording import record
from levade.search.search import Steer
from levade.search.storage import closing, storing
from levade.tasks import Change, Task, task_checksum, task_from_dict, task_to_dict, task_to_yaml
from levade.writing import write_text

TASK, MOTION = "task.yaml", "motion.npz"

PURSUIT = "hardware.json"
"""File in a directory that holds several runs but is no run itself: see `levade.hardware`."""

_SAVE_EVERY = 5.0
"""Least time between motions that are written on the way [s]."""

_REPLACE, _ELSEWHERE = Remedy("replace it", "replace"), Remedy("write elsewhere", "elsewhere")
_ANOTHER_DIRECTORY = Remedy("give another directory", "elsewhere")


@dataclass(frozen=True, eq=False)
class Outcome:
    """The outcome of a run.

    Attributes:
        objective: Objective of the search.
        solution: What the search found.
        motion: The best motion, as written.
        directory: Directory of the run.
        seed: Seed of the run.
        wall: Duration of the search alone [s].
    """

    objective: Objective
    solution: Solution
    motion: Motion
    directory: Path
    seed: int
    wall: float


def run(
    task: Task | Objective,
    *,
    seed: int = 0,
    threads: int = 0,
    directory: Path,
    initial: InitialGuess | None = None,
    observe: Observe | None = None,
    steer: Steer | None = None,
) -> Outcome:
    """Search for a motion and keep everything in a directory. This replaces an earlier run there.

    Args:
        task: The task, or an objective made from one.
        seed: Seed of all random numbers.
        threads: Number of engine threads (0: one per core).
        directory: Where to write. The directory is made if it does not exist.
        initial: Weights to begin around.
        observe: Called after each generation, as in `solve`.
        steer: Changes cost weights, as in `solve`. A change is written to task.yaml before it takes effect.

    Returns:
        The solution, its motion, and where they were written.

    Raises:
        LevadeError: If the parts of the task do not fit together or the directory cannot be written. Nothing is written then.
    """
    objective = task if isinstance(task, Objective) else make_objective(task, threads=threads)
    task = objective.task
    made = versions(task.physics.engine)
    header = Header(task.name, seed, made, _checksum(_as_read(task)), None if initial is None else initial.to_json())
    new = not directory.exists()
    with ExitStack() as stack:
        try:
            if not new and not directory.is_dir():
                raise NotADirectoryError(errno.ENOTDIR, "Is not a directory")
            directory.mkdir(parents=True, exist_ok=True)
            stack.enter_context(locked(directory, "run"))
            _check_files(directory, (_ANOTHER_DIRECTORY,))
            write_text(directory / TASK, task_to_yaml(task, code=True))
            file = checkpoints.begin(directory, header)
        except OSError as error:
            stack.close()
            if new:
                with suppress(OSError):
                    directory.rmdir()
            raise LevadeError(
                f"{directory}: cannot be written ({error.strerror})", remedies=(_ANOTHER_DIRECTORY,)
            ) from None
        stack.enter_context(closing(file))
        with storing(directory / MOTION, then=_ANOTHER_DIRECTORY):
            (directory / MOTION).unlink(missing_ok=True)  # only now: a full disk costs no earlier motion
        return _Run(objective, header, directory, file).go([], initial, observe, steer)


def resume(
    directory: Path,
    *,
    objective: Objective | None = None,
    threads: int = 0,
    observe: Observe | None = None,
    steer: Steer | None = None,
) -> Outcome:
    """Go on with an interrupted run. It ends with exactly the motion that it would have found without the interruption.

    Args:
        directory: Directory of the run.
        objective: An objective of the run's task, if there is one already.
        threads: Number of engine threads (0: one per core).
        observe: Called after each generation, as in `solve`.
        steer: Changes cost weights, as in `solve`.

    Returns:
        The solution, its motion, and where they were written.

    Raises:
        LevadeError: If there is no run in the directory, its task has changed since, or other versions of the libraries made
            it.
    """
    with ExitStack() as stack:
        _check_is_run(directory)
        try:
            stack.enter_context(locked(directory, "run"))
            _check_files(directory)
        except OSError as error:
            raise LevadeError(f"{directory}: cannot be written ({error.strerror})") from None
        task, checkpoint = read_run(directory)
        return _resumed(directory, task, checkpoint, objective, threads, observe, steer)


def _resumed(
    directory: Path,
    task: Task,
    checkpoint: Checkpoint,
    objective: Objective | None,
    threads: int,
    observe: Observe | None,
    steer: Steer | None,
) -> Outcome:
    """Go on with a run whose lock is held."""
    header = checkpoint.header
    now = versions(task.physics.engine)
    for name, version in header.versions.items():
        if now.get(name) != version:
            remedy = f"install {name}=={version}" if name != "blas" else "go on with a processor of that kind"
            raise LevadeError(
                f"{directory}: was started with {name} {version}, this is {now.get(name)}: going on would give another"
                f" motion; {remedy}, or start again"
            )
    if header.task_checksum != _checksum(task):
        raise LevadeError(
            f"{directory / TASK}: has changed since the run began, so that it cannot go on",
            remedies=(Remedy("put it back"), Remedy("start again", "solve again", directory / TASK)),
        )
    objective = objective or make_objective(task, threads=threads)
    initial = None if header.initial is None else InitialGuess.from_json(header.initial)
    try:
        # a line that was cut off in the middle is written again
        file = checkpoints.begin(directory, header, checkpoint.records)
    except OSError as error:
        raise LevadeError(f"{directory}: cannot be written ({error.strerror})") from None
    with closing(file):
        return _Run(objective, header, directory, file).go(checkpoint.records, initial, observe, steer)


def read_run(directory: Path) -> tuple[Task, Checkpoint]:
    """Read the task and the checkpoint of a run.

    Args:
        directory: Directory of the run.

    Raises:
        LevadeError: If there is no run in the directory.
    """
    _check_is_run(directory)
    task = task_from_dict(read_yaml(directory / TASK), where=str(directory / TASK), code=True)
    return task, checkpoints.read(directory)


def check_unlocked(directory: Path) -> None:
    """Check that no run is being written in a directory.

    Args:
        directory: The directory.

    Raises:
        LevadeError: If one is.
    """
    locking.check_unlocked(directory, "run")


def check_replaceable(directory: Path) -> None:
    """Check that a new run in a directory would not replace anything worth keeping.

    Args:
        directory: The directory.

    Raises:
        LevadeError: If it would replace an interrupted run, one that is still running, or files that belong to no run.
    """
    check_unlocked(directory)
    if (directory / PURSUIT).exists():
        raise LevadeError(f"{directory}: holds a pursuit for hardware", remedies=(_ELSEWHERE, _REPLACE))
    if not (directory / CHECKPOINT).exists():
        for name in (TASK, MOTION, PROGRESS):
            if (directory / name).exists():
                raise LevadeError(
                    f"{directory / name}: exists but does not belong to a run, and would be overwritten",
                    remedies=(_ELSEWHERE, _REPLACE),
                )
    try:
        _, checkpoint = read_run(directory)
    except LayoutError as error:
        if error.finished:
            return
        raise LevadeError(str(error), remedies=(_REPLACE, _ELSEWHERE)) from None
    except LevadeError:
        return
    if (checkpoint.records or checkpoint.damage) and not checkpoint.finished:
        raise LevadeError(
            f"{directory}: holds an interrupted run (seed {checkpoint.header.seed})",
            remedies=(Remedy("go on with it", "resume", directory), _REPLACE, _ELSEWHERE),
        )


def _check_is_run(directory: Path) -> None:
    if not (directory / CHECKPOINT).is_file() or not (directory / TASK).is_file():
        raise LevadeError(
            f"{directory}: holds no run to resume, {TASK} or {CHECKPOINT} is missing; give the directory of a run"
        )


def _check_files(directory: Path, remedies: Sequence[Remedy] = ()) -> None:
    """Raise LevadeError if the run would have to replace something that is no regular file."""
    for name in (TASK, CHECKPOINT, PROGRESS, MOTION):
        try:
            writing.check_replaceable(directory / name)
        except OSError as error:
            raise LevadeError(f"{directory / name}: cannot be written ({error.strerror})", remedies=remedies) from None


class _Run:
    """Writes the files of a run in progress."""

    def __init__(self, objective: Objective, header: Header, directory: Path, file: Writer) -> None:
        self._objective, self._seed, self._directory, self._file = objective, header.seed, directory, file
        self._room = Remedy("make room, then go on", "resume", directory)
        self._saved = time.perf_counter()
        self._best: Trial | None = None

    def go(
        self,
        records: list[Record],
        initial: InitialGuess | None,
        observe: Observe | None,
        steer: Steer | None,
    ) -> Outcome:
        began = time.perf_counter()
        objective, directory = self._objective, self._directory
        with storing(directory / PROGRESS, then=self._room):
            progress = Progress(objective.task, directory)

        def watch(generation: Generation) -> Stopped | None:
            with storing(directory, then=self._room, kept=f"{generation.trials} trials are kept"):
                progress.write(generation)
                self._save_interim(generation)
            return None if observe is None else observe(generation)

        with progress:
            solution = solve(
                objective,
                seed=self._seed,
                initial=initial,
                observe=watch,
                steer=None if steer is None else self._steering(steer),
                records=records,
                keep=self._keep,
            )
        wall = time.perf_counter() - began
        motion = record(objective, solution, seed=self._seed)
        with storing(directory / MOTION, then=self._room):
            motion.save(directory / MOTION)
            if solution.stopped is not Stopped.INTERRUPTED:
                checkpoints.finish(self._file)
        return Outcome(objective, solution, motion, directory, self._seed, wall)

    def _keep(self, new: Record) -> None:
        with storing(self._directory, then=self._room):
            checkpoints.add(self._file, new)

    def _save_interim(self, generation: Generation) -> None:
        """Save the best motion on the way, at most every few seconds."""
        if generation.replayed or generation.best is self._best or time.perf_counter() - self._saved <= _SAVE_EVERY:
            return
        self._best = generation.best
        record(self._objective, generation.solution(), seed=self._seed).save(self._directory / MOTION)
        self._saved = time.perf_counter()

    def _steering(self, steer: Steer) -> Steer:
        """Return the same steering, with every change written to the task before it takes effect."""
        task = self._objective.task

        def steering(generation: int) -> Mapping[str, float] | Stopped | None:
            nonlocal task
            factors = steer(generation)
            if factors and not isinstance(factors, Stopped):
                task = task.changed(Change(generation, dict(factors)))
                with storing(self._directory / TASK, then=self._room):
                    write_text(self._directory / TASK, task_to_yaml(task, code=True))
            return factors

        return steering


def _as_read(task: Task) -> Task:
    """Return a task as its file reads when the run goes on: numbers that Python code gave as integers are floats there."""
    return task_from_dict(task_to_dict(task, code=True), where=TASK, code=True)


def _checksum(task: Task) -> int:
    """Return the checksum of a task without the changes that a run makes to it on the way."""
    return task_checksum(replace(task, search=replace(task.search, changes=())))
