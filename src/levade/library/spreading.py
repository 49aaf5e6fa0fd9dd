"""Spread the work on a library over the nodes of a Ray cluster, each process of which builds the simulation once.

    with Spread(directory, address="10.0.0.1:6379") as spread:
        spread.begin(robot)
        for piece, rows in spread.each([Fall(4, after=(0, 1, 2, 3)), Fall(5, after=(0, 1, 2, 3))]):
            ...

Nodes need neither the robot's files nor the library: the robot travels with the work, and of earlier falls their records and
the weights of their motions. A node that finds the build's mark in the library's directory writes its results there, and their
names travel. From other nodes their contents travel, and the process that builds the library writes them.
"""

from __future__ import annotations

import os
import secrets
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import Any

from levade.arrays import Array
from levade.bench.cluster import AUTO, Cluster, fetch
from levade.errors import LevadeError, Remedy
from levade.library.asking import LIBRARY, SUCCESS
from levade.library.pieces import Fall, Row, Workshop
from levade.library.records import Record, certificate_path, motion_path, record_path
from levade.library.storing import TASK
from levade.motions import Motion, versions
from levade.robots import Robot
from levade.search.storage import storing
from levade.writing import replacing, write_text

MARK = ".levade-cluster"
"""Name of the file by which nodes know the library's directory."""

_PATIENCE = 90.0
"""Time in which a file that a node wrote has to appear here [s]. Network file systems may hide a new file for a minute."""


@dataclass(frozen=True, eq=False)
class News:
    """Holds what a node has to know of some falls.

    Attributes:
        records: Records of the falls.
        motions: Number of a fall -> its motion, which has weights only.
    """

    records: tuple[Record, ...]
    motions: Mapping[int, Motion]

    @classmethod
    def of(cls, directory: Path, falls: Sequence[int]) -> News:
        """Read the news of falls that are done.

        Args:
            directory: Directory of the library.
            falls: Numbers of the falls.
        """
        records = tuple(Record.load(record_path(directory, fall)) for fall in falls)
        found = [record.fall for record in records if record.motion == record.fall]
        return cls(records, {fall: _weights_of(Motion.load(motion_path(directory, fall))) for fall in found})


def _weights_of(motion: Motion) -> Motion:
    """Return a motion with what it takes to play it: all but a hundredth of the file is how it ran from its own fall."""
    return Motion(motion.meta, "", {"weights": motion["weights"]}, {})


@dataclass(frozen=True)
class Parcel:
    """Carries a piece of work to a node.

    Attributes:
        piece: The piece.
        news: References to the news of all falls that it needs, the earliest first.
    """

    piece: Fall | Row
    news: tuple[Any, ...]

    def __str__(self) -> str:
        return str(self.piece)


@dataclass(frozen=True, eq=False)
class Delivery:
    """Carries the result of a piece back.

    Attributes:
        rows: Result of `Solver.rows`. None for a fall.
        files: Path within the library -> content, in the order to write them. None if the file is there.
    """

    rows: tuple[Array, Array] | None
    files: Mapping[str, bytes | None]


class Outpost:
    """Does pieces of a library's work in a process of a node. Pickling leaves out the simulation that it builds.

    Args:
        directory: Directory of the library, absolute.
        mark: Content of the mark in it.
        robot: The library's robot.
    """

    def __init__(self, directory: Path, mark: str, robot: Robot) -> None:
        self._directory, self._mark = directory, mark
        self._robot = replace(robot)  # without what it has computed of itself
        names = [name for name in (LIBRARY, TASK, SUCCESS) if (directory / name).is_file()]
        self._files = {name: (directory / name).read_bytes() for name in names}
        self._versions = versions()
        self._heard = 0
        self._workshops: dict[Path, Workshop] = {}
        self._own: Path | None = None

    def __call__(self, parcel: Parcel) -> Delivery:
        """Do a piece of work.

        Args:
            parcel: The piece, and what there is to know.

        Returns:
            The result.

        Raises:
            LevadeError: If this computer has other versions than the one that builds the library, or cannot write.
        """
        _check_versions(versions(), self._versions)
        with self._place() as place:
            if place not in self._workshops:
                self._workshops, self._heard = {place: Workshop(place, self._robot)}, 0
            workshop = self._workshops[place]
            for news in map(fetch, parcel.news[self._heard :]):
                workshop.learn(news.records, news.motions)
            self._heard = max(self._heard, len(parcel.news))
            rows = workshop(parcel.piece)
            return Delivery(rows, self._written(place, parcel.piece))

    @contextmanager
    def _place(self) -> Iterator[Path]:
        """The directory of the library, or one that is there for this piece: a cluster kills processes as it likes."""
        if self._shared():
            yield self._directory
            return
        with storing(Path(tempfile.gettempdir()), then=Remedy("make room there")):
            if self._own is None:
                self._own = Path(tempfile.mkdtemp(prefix="levade-"))
            else:
                self._own.mkdir(mode=0o700)
            try:
                for name in ("falls", "motions"):
                    (self._own / name).mkdir()
                for name, content in self._files.items():
                    (self._own / name).write_bytes(content)
                yield self._own
            finally:
                shutil.rmtree(self._own, ignore_errors=True)

    def _shared(self) -> bool:
        """Whether this node has the library's directory, and may write there."""
        try:
            return (self._directory / MARK).read_text(encoding="utf-8") == self._mark and os.access(
                self._directory, os.W_OK
            )
        except (OSError, UnicodeDecodeError):
            return False

    def _written(self, place: Path, piece: Fall | Row) -> dict[str, bytes | None]:
        """What a piece has written into a directory: the motion first, because a record says that all of a fall is there."""
        if isinstance(piece, Row):
            return {}
        paths = [path(place, piece.number) for path in (motion_path, certificate_path, record_path)]
        here = place == self._directory
        return {str(path.relative_to(place)): None if here else path.read_bytes() for path in paths if path.is_file()}


class Spread:
    """Holds the connection to a Ray cluster that works on a library, until the ``with`` block ends, also by an exception.

    Args:
        directory: Directory of the library.
        address: Address of the cluster, as for `levade.bench.cluster.Cluster`.
    """

    def __init__(self, directory: Path, *, address: str = AUTO) -> None:
        self._directory = directory
        self._cluster = Cluster(address)
        self._mark = secrets.token_hex(16)
        self._news: list[Any] = []
        self._told: set[int] = set()
        self._outpost: Any = None

    def __enter__(self) -> Spread:
        self._cluster.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._cluster.__exit__(kind, error, trace)
        if self._outpost is not None:
            with suppress(OSError):
                (self._directory / MARK).unlink(missing_ok=True)

    @property
    def cpus(self) -> int:
        """Number of CPUs that the cluster has now."""
        return self._cluster.cpus

    def begin(self, robot: Robot) -> None:
        """Hand out what a library is built from.

        Args:
            robot: The library's robot.

        Raises:
            LevadeError: If the directory cannot be written.
        """
        directory = self._directory.resolve()
        with storing(directory, then=Remedy("give another directory", "elsewhere")):
            write_text(directory / MARK, self._mark)
        self._outpost = self._cluster.put(Outpost(directory, self._mark, robot))

    def each(
        self, pieces: Sequence[Fall | Row], *, waiting: Callable[[], object] | None = None
    ) -> Iterator[tuple[Fall | Row, tuple[Array, Array] | None]]:
        """Yield each piece with its result, as they finish. The files of a fall are in the library's directory then.

        Args:
            pieces: What to do, after the same falls.
            waiting: Called about once a second while there is no result.

        Raises:
            LevadeError: If a piece raises one, its process dies each time, or a file cannot be written.
        """
        if not pieces:
            return
        self._tell(pieces[0].after if isinstance(pieces[0], Fall) else pieces[0].falls)
        parcels = [Parcel(piece, tuple(self._news)) for piece in pieces]
        for parcel, delivery in self._cluster.each(self._outpost, parcels, waiting=waiting):
            for name, content in delivery.files.items():
                self._store(self._directory / name, content, waiting)
            yield parcel.piece, delivery.rows

    def _tell(self, falls: Sequence[int]) -> None:
        """Put the news of falls that no piece was sent with before."""
        fresh = [fall for fall in falls if fall not in self._told]
        if fresh:
            self._news.append(self._cluster.put(News.of(self._directory, fresh)))
            self._told.update(fresh)

    def _store(self, path: Path, content: bytes | None, waiting: Callable[[], object] | None) -> None:
        if content is not None:
            with (
                storing(
                    self._directory, then=Remedy("make room, then build again"), kept="all falls that are done are kept"
                ),
                replacing(path) as partial,
            ):
                partial.write_bytes(content)
            return
        until = time.monotonic() + _PATIENCE
        while not path.is_file():
            if time.monotonic() > until:
                raise LevadeError(
                    f"{path}: a node has written it, but after {_PATIENCE:.0f} s it has not appeared here; build again when"
                    " the nodes' file system is well"
                )
            if waiting is not None:
                waiting()
            time.sleep(0.1)


def _check_versions(here: Mapping[str, str], there: Mapping[str, str]) -> None:
    """Raise LevadeError unless a node has the versions of the computer that builds the library, so that the bytes agree."""
    for name, own in there.items():
        if here.get(name) == own:
            continue
        if name == "blas":
            raise LevadeError(
                f"its linear algebra is {here.get(name, 'unknown')}, that of the computer that builds is {own}, which rounds in"
                " another way; build on equal processors, or set OPENBLAS_CORETYPE to the lesser kind on all of them"
            )
        raise LevadeError(
            f"has {name} {here.get(name, 'none')}, the computer that builds has {own}; install the same on every node"
        )
