"""Processes that run cases side by side, one thread each; a case's result does not depend on how many there are.

A process is told the next case when it has sent the last result. Signals that ask to end are for the parent, even where all
get them, as from the keyboard: it kills the processes, and loses no more than the cases that they were at.
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
from typing import Any

from levade.bench.case import run_case
from levade.bench.plan import Case
from levade.bench.results import Result
from levade.errors import LevadeError

_ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
_FOR_THE_PARENT = (signal.SIGINT, signal.SIGTERM)


def run_cases(
    cases: Sequence[Case], *, processes: int, waiting: Callable[[], object] | None = None
) -> Iterator[tuple[Case, Result]]:
    """Yield each case and its result, as they come.

    The processes end when the iteration does, however it ends.

    Args:
        cases: Cases to run.
        processes: Cases at a time.
        waiting: Called about once a second while there is no result.

    Raises:
        LevadeError: If a case does not fit together or a process dies.
    """
    left = list(reversed(cases))
    workers: list[_Worker] = []
    try:
        with _one_thread(), _undisturbed():
            workers += [_Worker() for _ in range(min(processes, len(cases)))]
        for worker in workers:
            worker.give(left.pop())
        while busy := {worker.connection: worker for worker in workers if worker.case is not None}:
            ready = wait(list(busy), timeout=1.0)
            if not ready and waiting is not None:
                waiting()
            for connection in ready:
                worker = busy[connection]  # type: ignore[index]
                case, result = worker.take()
                if left:
                    worker.give(left.pop())
                yield case, result
    finally:
        for worker in workers:
            worker.end()


class _Worker:
    """A process, and the case that it is at."""

    def __init__(self) -> None:
        # a fresh interpreter: forking one whose libraries have threads is not safe
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process: BaseProcess = context.Process(target=_serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.case: Case | None = None

    def give(self, case: Case) -> None:
        self.case = case
        self.connection.send(case)

    def take(self) -> tuple[Case, Result]:
        """What it has sent.

        Raises:
            LevadeError: If that is an error, or nothing because it died.
        """
        case, self.case = self.case, None
        assert case is not None
        try:
            answer: Any = self.connection.recv()
        except (EOFError, OSError):
            self.process.join()
            raise LevadeError(
                f"{case}: the process that ran it died (exit code {self.process.exitcode}); what is done is kept: call"
                " again to go on, with fewer processes if memory was short"
            ) from None
        if isinstance(answer, LevadeError):
            raise LevadeError(f"{case}: {answer}")
        if isinstance(answer, BaseException):
            raise answer
        return case, answer

    def end(self) -> None:
        self.connection.close()
        self.process.kill()
        self.process.join()


def _serve(connection: Connection) -> None:
    """A process: results for cases, until nobody asks any more."""
    for number in _FOR_THE_PARENT:
        signal.signal(number, signal.SIG_IGN)
    while True:
        try:
            case: Case = connection.recv()
        except (EOFError, OSError):
            return
        try:
            answer: Result | Exception = run_case(case)
        except LevadeError as error:
            answer = error
        except Exception:
            answer = RuntimeError(f"{case}\n{traceback.format_exc()}")  # whatever it was may not survive the journey
        try:
            connection.send(answer)
        except OSError:
            return


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Processes that start now do not hear signals that are for the parent, not even before `_serve`."""
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
    """Processes that start now have linear algebra on one thread."""
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
