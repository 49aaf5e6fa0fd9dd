"""Run pieces of work in several processes with one thread each. Results do not depend on the number of processes.

    with Pool(run_case, 2) as pool:
        for case, result in pool.each(cases):
            ...

A process gets its next piece when it has sent its last result. Signals that end the program are for the parent, even if all
processes get them, as from the keyboard. The parent kills the processes, and loses only the pieces in progress. If the parent
is killed, its processes end after their current piece.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from types import TracebackType
from typing import Any, Generic, TypeVar

from levade.bench.case import run_case
from levade.bench.plan import Case
from levade.bench.results import Result
from levade.errors import LevadeError

Piece = TypeVar("Piece")
Outcome = TypeVar("Outcome")

_ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
_FOR_THE_PARENT = (signal.SIGINT, signal.SIGTERM)


def run_cases(
    cases: Sequence[Case], *, processes: int, waiting: Callable[[], object] | None = None
) -> Iterator[tuple[Case, Result]]:
    """Yield each case with its result, as they finish: see `Pool.each`.

    Args:
        cases: Cases to run.
        processes: Largest number of processes at a time.
        waiting: Called about once a second while there is no result.

    Yields:
        Pairs of a case and its result.

    Raises:
        LevadeError: If a case raises one, or a process dies.
    """
    with Pool(run_case, min(processes, len(cases))) as pool:
        yield from pool.each(cases, waiting=waiting)


class Pool(Generic[Piece, Outcome]):
    """Holds processes that wait for work until the ``with`` block ends, also by an exception.

    Args:
        run: Does a piece of work. It is sent to the processes by pickle, as are pieces and results.
        processes: Number of processes.
    """

    def __init__(self, run: Callable[[Piece], Outcome], processes: int) -> None:
        self._run, self._processes = run, processes
        self._workers: list[_Worker] = []

    def __enter__(self) -> Pool[Piece, Outcome]:
        try:
            with _one_thread(), _undisturbed():
                for _ in range(self._processes):
                    self._workers.append(_Worker())
            for worker in self._workers:
                worker.connection.send(self._run)
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._end()

    def each(
        self, pieces: Sequence[Piece], *, waiting: Callable[[], object] | None = None
    ) -> Iterator[tuple[Piece, Outcome]]:
        """Yield each piece with its result, as they finish.

        Args:
            pieces: What to do. Messages name a piece by its text.
            waiting: Called about once a second while there is no result.

        Raises:
            LevadeError: If a piece raises one, or a process dies.
        """
        left = list(reversed(pieces))
        for worker in self._workers:
            if left:
                worker.give(left.pop())
        while busy := {worker.connection: worker for worker in self._workers if worker.piece is not None}:
            ready = wait(list(busy), timeout=1.0)
            if not ready and waiting is not None:
                waiting()
            for connection in ready:
                worker = busy[connection]  # type: ignore[index]
                piece, outcome = worker.take()
                if left:
                    worker.give(left.pop())
                yield piece, outcome

    def _end(self) -> None:
        while self._workers:
            self._workers.pop().end()


class _Worker:
    """A process and its current piece of work."""

    def __init__(self) -> None:
        # a fresh interpreter: forking one whose libraries have threads is not safe
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process: BaseProcess = context.Process(target=_serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.piece: Any = None

    def give(self, piece: Any) -> None:
        self.piece = piece
        self.connection.send(piece)

    def take(self) -> tuple[Any, Any]:
        """Return what the process has sent.

        Raises:
            LevadeError: If it has sent an error, or died.
        """
        piece, self.piece = self.piece, None
        assert piece is not None
        try:
            answer: Any = self.connection.recv()
        except (EOFError, OSError):
            self.process.join()
            raise LevadeError(
                f"{piece}: the process that ran it died (exit code {self.process.exitcode}); what is done is kept: call"
                " again to go on, with fewer processes if memory was short"
            ) from None
        return piece, checked(str(piece), answer)

    def end(self) -> None:
        self.connection.close()
        self.process.kill()
        self.process.join()


def _serve(connection: Connection) -> None:
    """Serve in a process: receive what to run, then pieces of work, until the parent asks no more."""
    for number in _FOR_THE_PARENT:
        signal.signal(number, signal.SIG_IGN)
    run: Callable[[Any], Any] | None = None
    while True:
        try:
            piece = connection.recv()
        except (EOFError, OSError):
            return
        if run is None:
            run = piece
            continue
        try:
            connection.send(answered(run, piece))
        except OSError:
            return


def answered(run: Callable[[Any], Any], piece: Any) -> Any:
    """Do a piece of work in a process of its own.

    Args:
        run: Does the piece.
        piece: The piece.

    Returns:
        The result, or an error for `checked`.
    """
    try:
        return run(piece)
    except LevadeError as error:
        return error
    except Exception:
        return RuntimeError(f"{piece}\n{traceback.format_exc()}")  # whatever it was may not survive the journey


def checked(piece: str, answer: Any) -> Any:
    """Return what a process has answered.

    Args:
        piece: Name of the piece of work, for messages.
        answer: Answer of `answered`.

    Returns:
        The result.

    Raises:
        LevadeError: If the piece raised one.
        RuntimeError: If the piece raised anything else.
    """
    if isinstance(answer, LevadeError):
        raise LevadeError(f"{piece}: {answer}")
    if isinstance(answer, BaseException):
        raise answer
    return answer


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Start processes that ignore signals for the parent, even before `_serve`."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, signal.SIG_IGN) for number in _FOR_THE_PARENT}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def _one_thread() -> Iterator[None]:
    """Start processes whose linear algebra runs on one thread."""
    before = {name: os.environ.get(name) for name in _ONE_THREAD}
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
