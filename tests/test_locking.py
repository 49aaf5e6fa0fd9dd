"""A directory has one writer at a time, and a dead one does not count."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from levade.locking import LOCK, TakenError, check_unlocked, locked


def test_the_second_is_told_who_has_it(tmp_path: Path) -> None:
    with locked(tmp_path, "run"):
        told = rf"this run is being written by process {os.getpid()} on {socket.gethostname()}, since 2"
        with pytest.raises(TakenError, match=told), locked(tmp_path, "run"):
            pass
        with pytest.raises(TakenError, match=told):
            check_unlocked(tmp_path, "run")
    check_unlocked(tmp_path, "run")
    assert list(tmp_path.iterdir()) == []
    with locked(tmp_path, "run"):
        pass


def test_a_killed_process_leaves_no_lock(tmp_path: Path) -> None:
    code = (
        "import sys, time\nfrom pathlib import Path\nfrom levade.locking import locked\n"
        "with locked(Path(sys.argv[1]), 'run'):\n    print('held', flush=True)\n    time.sleep(60)"
    )
    with subprocess.Popen([sys.executable, "-c", code, tmp_path], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        with pytest.raises(TakenError, match=f"process {process.pid} "):
            check_unlocked(tmp_path, "run")
        process.send_signal(signal.SIGKILL)
    assert (tmp_path / LOCK).exists()
    check_unlocked(tmp_path, "run")
    with locked(tmp_path, "run"):
        pass


def test_a_planted_link_is_not_followed(tmp_path: Path) -> None:
    target = tmp_path / "target"
    target.write_text("precious")
    (tmp_path / LOCK).symlink_to(target)
    with pytest.raises(OSError, match="symbolic links"), locked(tmp_path, "run"):
        pass
    assert target.read_text() == "precious"


@pytest.mark.parametrize("content", ["", "{}", "[1]", "\x1b[31m", '{"pid": "\\u001b[31m", "host": 1, "since": 2}'])
def test_whatever_the_lock_says_the_message_is_one_printable_line(tmp_path: Path, content: str) -> None:
    with locked(tmp_path, "run"):
        (tmp_path / LOCK).write_text(content)
        with pytest.raises(TakenError) as error:
            check_unlocked(tmp_path, "run")
        assert str(error.value).isprintable()
