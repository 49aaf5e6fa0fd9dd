"""Files are written whole or not at all, and only in the place of regular files."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from levade.writing import append, check_replaceable, growing, replacing, write_text


def _odd(path: Path, kind: str) -> None:
    """Put something that is no regular file at a path."""
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "directory":
        path.mkdir()
    elif kind == "device":
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 7))  # the kernel's full device
    else:
        target = path.with_name("target")
        if kind == "link":
            target.write_text("precious")
        path.symlink_to(target)


KINDS = ("pipe", "directory", "device", "link", "dangling link")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("write", [write_text, lambda path, text: growing(path), lambda path, text: append(path, b"x")])
def test_what_is_no_regular_file_stays_as_it_is(tmp_path: Path, kind: str, write) -> None:
    path = tmp_path / "motion.npz"
    try:
        _odd(path, kind)
    except PermissionError:
        pytest.skip("needs the right to make devices")
    before = path.lstat()
    with pytest.raises(OSError, match=r"Is a (directory|pipe, not a file|device, not a file|symbolic link)"):
        write(path, "new")
    assert (path.lstat().st_ino, path.lstat().st_mode) == (before.st_ino, before.st_mode)
    expected = {"motion.npz", "target"} if kind == "link" else {"motion.npz"}
    assert {each.name for each in tmp_path.iterdir()} == expected
    if kind == "link":
        assert (tmp_path / "target").read_text() == "precious"


def test_a_link_to_a_directory_on_the_way_is_followed(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    write_text(tmp_path / "link" / "a.txt", "text")
    assert (tmp_path / "real" / "a.txt").read_text() == "text"


def test_a_failure_leaves_the_earlier_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("earlier")
    with pytest.raises(UnicodeEncodeError):
        write_text(path, "half \ud800")
    assert [each.name for each in tmp_path.iterdir()] == ["a.txt"]
    assert path.read_text() == "earlier"


def test_a_link_planted_meanwhile_is_not_replaced(tmp_path: Path) -> None:
    path, target = tmp_path / "a.txt", tmp_path / "target"
    target.write_text("precious")
    with pytest.raises(OSError, match="symbolic link"), replacing(path):
        path.symlink_to(target)
    assert path.is_symlink()
    assert target.read_text() == "precious"


def test_the_file_that_is_written_first_has_a_name_that_cannot_be_guessed(tmp_path: Path) -> None:
    names = set()
    for _ in range(3):
        with replacing(tmp_path / "a.png") as partial:
            assert partial.parent == tmp_path
            assert partial.suffix == ".png"
            names.add(partial.name)
    assert len(names) == 3


def test_names_up_to_the_limit_of_the_file_system_can_be_written(tmp_path: Path) -> None:
    path = tmp_path / ("n" * 251 + ".txt")
    write_text(path, "text")
    assert path.read_text() == "text"
    with pytest.raises(OSError, match="too long"):
        write_text(tmp_path / ("n" * 256), "text")


def test_what_grows_keeps_every_line(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    with growing(path) as file:
        file.write("one\n")
        file.flush()
        assert path.read_text() == "one\n"
    append(path, b"two\n")
    assert path.read_text() == "one\ntwo\n"
    check_replaceable(path)
