"""Nothing that is done is lost: a build is killed in the middle of a write, or the disk is full, and goes on to the same bytes.

`benchmarks/durability.py` kills at random moments and fills real disks.
"""

from __future__ import annotations

import errno
import itertools
import multiprocessing
import os
import signal
import sys
from pathlib import Path

import pytest
from tests.library.rolling import contents, rolling_quickly

from levade.errors import LevadeError
from levade.library import build

pytestmark = pytest.mark.slow

STARTS = 4


def built(directory: Path) -> None:
    build(rolling_quickly(), starts=STARTS, directory=directory, threads=1)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    directory = tmp_path_factory.mktemp("libraries") / "whole"
    built(directory)
    return contents(directory)


def check(directory: Path, before: dict[str, bytes], whole: dict[str, bytes]) -> dict[str, bytes]:
    """No record of before is lost, and what is there is whole. Returns the records and motions."""
    now = {name: text for name, text in contents(directory).items() if name.startswith(("falls/", "motions/"))}
    assert before.items() <= now.items()
    assert now.items() <= whole.items()
    return now


def built_and_killed(directory: Path, write: int) -> None:
    """Build, and die where the content of a file is written and has not replaced the file yet."""
    count = itertools.count(1)

    def fsync(descriptor: int) -> None:
        if next(count) == write:
            os.kill(os.getpid(), signal.SIGKILL)

    os.fsync = fsync  # type: ignore[assignment]
    built(directory)


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
def test_killed_in_the_middle_of_a_write_it_loses_that_write(
    whole: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first two writes of every build are those of task.yaml and library.yaml."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2]))  # the process finds this module by its name
    context, there = multiprocessing.get_context("spawn"), {}
    for write in (1, 2, 4, 5):
        process = context.Process(target=built_and_killed, args=(tmp_path, write))
        process.start()
        process.join()
        assert process.exitcode == -signal.SIGKILL
        there = check(tmp_path, there, whole)
    assert there
    built(tmp_path)
    assert contents(tmp_path) == whole


def test_on_a_full_disk_it_says_so_and_keeps_what_is_done(
    whole: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each build has room for two files, and no more, beyond those that it writes at its beginning."""
    there: dict[str, bytes] = {}
    for _ in range(len(whole)):
        left = itertools.count(4, -1)

        def fsync(descriptor: int, left: itertools.count[int] = left) -> None:
            if next(left) <= 0:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        with monkeypatch.context() as patch:
            patch.setattr(os, "fsync", fsync)
            try:
                built(tmp_path)
            except LevadeError as error:
                said = str(error)
                assert said.count("\n") == 0
                assert "No space left on device" in said
                assert "build again" in said
            else:
                break
        assert check(tmp_path, there, whole) != there  # it came further
        there = check(tmp_path, there, whole)
    assert len(there) > 2
    assert contents(tmp_path) == whole
    assert not list(tmp_path.rglob("*.partial*"))
