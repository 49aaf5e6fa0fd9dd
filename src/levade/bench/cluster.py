"""Run pieces of work on the nodes of a Ray cluster. Results do not depend on the number of nodes.

    with Cluster("10.0.0.1:6379") as cluster:
        run = cluster.put(run_case)
        for case, result in cluster.each(run, cases):
            ...

A piece takes one CPU of the cluster. If its node dies, it begins again on another one, `_TRIES` times at most. Nodes may come
and go. What runs a piece is unpickled once per process, so it can keep what it builds. It can read other values that were put
with `fetch`. Needs ray (`pip install 'levade[ray]'`), which nothing else imports.
"""

from __future__ import annotations

import logging
import os
import secrets
import signal
import socket
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from types import TracebackType
from typing import Any, TypeVar

from levade.bench.pool import answered, checked
from levade.errors import LevadeError, Remedy

Piece = TypeVar("Piece")

AUTO = "auto"
"""Address of the running cluster that this computer belongs to, or that ``RAY_ADDRESS`` names; else one is started here."""

LOCAL = "local"
"""Address of a cluster of this computer alone, which is started, and ends with the work."""

_TRIES = 5
"""Number of times that a piece begins again because its process or node died."""

_PATIENCE = 5.0
"""Time for a cluster to answer [s]. Ray itself would try for minutes."""


class Cluster:
    """Holds a connection to a Ray cluster until the ``with`` block ends, also by an exception.

    Pieces that are not done then are abandoned. A cluster that was started here is shut down; another one is left as it was.

    Args:
        address: Address of the cluster: HOST:PORT, `AUTO` or `LOCAL`. If `ray.init` was called before, that cluster is used.
    """

    def __init__(self, address: str = AUTO) -> None:
        self._address = address
        self._key = secrets.token_hex(8)
        self._left: dict[Any, Any] = {}
        self._connected = False

    def __enter__(self) -> Cluster:
        """Connect to the cluster.

        Raises:
            LevadeError: If ray is missing, or no cluster of this version answers at the address.
        """
        ray = _ray()
        if not ray.is_initialized():
            with _signals_kept():
                _connect(self._address)
            self._connected = True
            _show_messages(False)
        self._serve = ray.remote(num_cpus=1, max_retries=_TRIES)(_serve)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        ray = _ray()
        for reference in self._left:
            with suppress(ray.exceptions.RayError):
                ray.cancel(reference, force=True)
        self._left.clear()
        if self._connected:
            with _signals_kept():
                ray.shutdown()
            self._connected = False
            _show_messages(True)

    @property
    def cpus(self) -> int:
        """Number of CPUs that the cluster has now, whoever uses them."""
        return int(_ray().cluster_resources().get("CPU", 0))

    def put(self, value: Any) -> Any:
        """Hand a value to the cluster. Each node that needs it gets it once.

        Args:
            value: Anything that can be pickled.

        Returns:
            A reference for `each` and `fetch`, small enough to be part of a piece.
        """
        return _ray().put(value)

    def each(
        self, run: Any, pieces: Sequence[Piece], *, waiting: Callable[[], object] | None = None
    ) -> Iterator[tuple[Piece, Any]]:
        """Yield each piece with its result, as they finish.

        Args:
            run: Reference to the function that does a piece; always the same one for a cluster.
            pieces: What to do. Messages name a piece by its text.
            waiting: Called about once a second while there is no result.

        Raises:
            LevadeError: If a piece raises one, or its process dies each time.
        """
        ray = _ray()
        # a reference within a list is not replaced by its value
        self._left = {self._serve.remote(self._key, [run], piece): piece for piece in pieces}
        while self._left:
            ready, _ = ray.wait(list(self._left), timeout=1.0)
            if not ready and waiting is not None:
                waiting()
            for reference in ready:
                piece = self._left.pop(reference)
                try:
                    answer = _taken(reference, piece)
                except LevadeError:
                    if waiting is not None:
                        waiting()  # Ctrl-C may have ended processes of this computer, too
                    raise
                yield piece, answer


def fetch(reference: Any) -> Any:
    """Return a value that was put, on a node.

    Args:
        reference: Reference from `Cluster.put`.
    """
    return _ray().get(reference)


def _ray() -> Any:
    """Import ray. Raises LevadeError if it is missing."""
    try:
        return import_module("ray")
    except ImportError:
        raise LevadeError("a cluster needs ray; pip install 'levade[ray]'", field="ray") from None


_running: dict[str, Callable[[Any], Any]] = {}
"""In a process of a node: key of a cluster -> what does its pieces."""


def _serve(key: str, run: Sequence[Any], piece: Any) -> tuple[str, Any]:
    """Do a piece in a process of a node. Returns the name of the computer, and the result or error."""
    if key not in _running:
        _running.clear()
        _running[key] = fetch(run[0])
    return socket.gethostname(), answered(_running[key], piece)


def _taken(reference: Any, piece: Any) -> Any:
    ray = _ray()
    try:
        computer, answer = ray.get(reference)
    except ray.exceptions.RayTaskError as error:
        raise LevadeError(f"{piece}: {_reason(error)}") from None
    except ray.exceptions.RayError as error:
        raise LevadeError(
            f"{piece}: {_TRIES + 1} processes that ran it died; what is done is kept: call again to go on, with more memory"
            f" per CPU if it was short ({_first_line(error)})"
        ) from None
    return checked(f"{piece} on {computer}", answer)


def _reason(error: Exception) -> str:
    """Say why a process could not even begin: what it should run is another version there, or is missing."""
    lines = [line.strip() for line in str(error).splitlines()]
    found = [line for line in lines if line.startswith(("ModuleNotFoundError", "ImportError", "AttributeError"))]
    what = found[-1] if found else lines[-1]
    return f"a node cannot run it; install the same levade on every node ({what})"


def _first_line(error: Exception) -> str:
    return next(iter(str(error).splitlines()), type(error).__name__)


def _connect(address: str) -> None:
    """Connect to a cluster, or start one. Raises LevadeError if that is not possible."""
    ray = _ray()
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": logging.ERROR}
    given = os.environ.get("RAY_ADDRESS", AUTO) if address == AUTO else address
    if given not in (AUTO, LOCAL):
        _check_answers(given, "" if address == given else "RAY_ADDRESS is ")
        options["address"] = given
    elif address == LOCAL:
        options["address"] = LOCAL
    try:
        ray.init(**options)
    except Exception as error:  # of any kind: another version of Ray or Python there, or a start that takes too long
        ray.shutdown()
        where = "" if given in (AUTO, LOCAL) else f"{given}: "
        raise LevadeError(f"{where}{' '.join(str(error).split())}", field="ray") from None


def _check_answers(address: str, whose: str) -> None:
    """Raise LevadeError unless something answers at an address. Ray goes on trying for minutes, and then ends the process."""
    if "://" in address:
        raise LevadeError(
            f"{whose}{address}: should be HOST:PORT; start the build on a computer of the cluster", field="ray"
        )
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise LevadeError(
            f"{whose}{address}: is not an address; give HOST:PORT of the cluster's head, such as 10.0.0.1:6379",
            field="ray",
        )
    try:
        socket.create_connection((host.strip("[]"), int(port)), timeout=_PATIENCE).close()
    except OSError as error:
        raise LevadeError(
            f"{whose}{address}: no Ray cluster answers there ({error.strerror or error})",
            field="ray",
            remedies=(Remedy("give the address that `ray start --head` printed"),),
        ) from None


def _show_messages(show: bool) -> None:
    """Say whether Ray prints messages of its nodes. It does so on standard output, where they mix with the results."""
    worker: Any = import_module("ray._private.worker")
    worker._worker_logs_enabled = show  # also what Ray's debugger sets; ray.init has no argument for these messages


@contextmanager
def _signals_kept() -> Iterator[None]:
    """Keep the handlers of signals within the context: Ray sets its own for the end of the program."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
