"""Where the system says no: odd places to write to, names, streams, and directories that are in use."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from levade.locking import locked
from levade.motions import Motion
from levade.motions.file import Content, read, write
from levade.search import memory

QUICK = "rearing --set search.optimizer=cma --set search.population=4 --trials 8 --set horizon=0.06"
LONG = "n" * 300


def _one_line(err: str) -> bool:
    return err.startswith("levade: ") and err.count("\n") == 1 and err.rstrip("\n").isprintable()


@pytest.fixture
def places(tmp_path: Path, unmet: Path) -> Path:
    """A motion, a pipe, links, and a directory with a link to it."""
    shutil.copy(unmet / "motion.npz", tmp_path / "motion.npz")
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "precious").write_text("precious")
    (tmp_path / "link").symlink_to("precious")
    (tmp_path / "dangling").symlink_to("nothing")
    for suffix in (".png", ".html", ".json", ".npz"):
        (tmp_path / f"link{suffix}").symlink_to("precious")
    (tmp_path / "real").mkdir()
    (tmp_path / "directory").symlink_to("real")
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize("place", ["/dev/null", "/dev/full", "/dev/stdout", "pipe", "link", "dangling", LONG])
@pytest.mark.parametrize(
    "command",
    [
        f"solve {QUICK}",
        "check motion.npz --runs 1",
        "view motion.npz",
        "stabilise motion.npz",
        "export motion.npz --to csv",
    ],
)
def test_out_is_never_what_is_no_file_or_directory(levade, places: Path, command: str, place: str) -> None:
    def state() -> dict[str, tuple[int, int]]:
        return {path.name: (path.lstat().st_ino, path.lstat().st_mode) for path in places.iterdir()}

    before = state()
    status, out, err = levade(*command.split(), "--out", place)
    assert (status, out) == (2, "")
    assert _one_line(err), err
    assert state() == before
    assert (places / "precious").read_text() == "precious"


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", ["--strip link.png", "--figures link", "--figures pipe", f"--strip {LONG}.png", "--strip pipe/a.png"]
)
def test_pictures_are_never_written_over_what_is_no_file(levade, places: Path, words: str) -> None:
    status, _, err = levade("show", "motion.npz", *words.split(), "--json")
    assert status == 2
    assert _one_line(err), err
    assert (places / "precious").read_text() == "precious"
    assert (places / "link.png").is_symlink()


def test_a_report_is_not_written_through_a_link(levade, places: Path) -> None:
    (places / "report.html").symlink_to("precious")
    status, _, err = levade("show", "motion.npz")
    assert status == 2
    assert _one_line(err), err
    assert (places / "precious").read_text() == "precious"


@pytest.mark.slow
def test_a_link_to_a_directory_is_a_directory(levade, places: Path) -> None:
    assert levade("export", "motion.npz", "--to", "json", "--out", "directory")[0] == 0
    assert (places / "directory").is_symlink()
    assert list((places / "real").iterdir())
    assert levade("solve", *QUICK.split(), "--out", "directory")[0] in (0, 1)
    Motion.load(places / "real" / "motion.npz")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["task.yaml", "checkpoint.jsonl", "progress.csv", "motion.npz"])
def test_a_run_replaces_no_link(levade, places: Path, name: str) -> None:
    (places / "real" / name).symlink_to("../precious")
    status, _, err = levade("solve", *QUICK.split(), "--out", "real", "--force")
    assert status == 2
    assert f"real/{name}: cannot be written (Is a symbolic link" in err
    assert _one_line(err), err
    assert [path.name for path in (places / "real").iterdir()] == [name]
    assert (places / "precious").read_text() == "precious"


@pytest.mark.parametrize(
    "words",
    [
        *(
            f"solve {LONG}.yaml",
            f"solve rearing --robot {LONG}.urdf",
            f"show {LONG}.npz",
            f"view {LONG}",
            f"check {LONG}",
        ),
        *(
            f"solve --resume {LONG}",
            f"robots {LONG}",
            f"inspect {LONG}",
            f"bench {LONG}",
            f"solve rearing --from {LONG}",
        ),
    ],
)
def test_a_name_that_is_too_long_is_one_line(levade, words: str) -> None:
    status, _, err = levade(*words.split())
    assert status == 2
    assert _one_line(err), err


@pytest.mark.slow
def test_a_run_in_progress_is_said_to_run(levade, tmp_path: Path, unmet: Path) -> None:
    shutil.copytree(unmet, tmp_path / "run")
    with locked(tmp_path / "run", "run"):
        for words in (f"solve {QUICK} --out run", f"solve {QUICK} --out run --force", "solve --resume run"):
            status, out, err = levade(*words.split())
            assert (status, out) == (2, "")
            assert f"run: this run is being written by process {os.getpid()} on " in err
            assert _one_line(err), err
    assert levade("solve", "--resume", "run")[0] in (0, 1)


@pytest.mark.parametrize(
    ("words", "redirection", "status", "said"),
    [
        (f"solve {QUICK}", "> /dev/full", 2, "standard output: cannot be written (No space left on device)"),
        (f"solve {QUICK} --json", "> /dev/full", 2, "standard output: cannot be written (No space left on device)"),
        (f"solve {QUICK}", ">&-", 1, ""),
        (f"solve {QUICK}", ">&- 2>&- <&-", 1, ""),
        (f"solve {QUICK} --json", "2> /dev/full", 1, None),
        (f"solve {QUICK}", "| true", 1, ""),
        ("tasks", "| true", 0, ""),
        ("--help", "> /dev/full", 2, "standard output: cannot be written (No space left on device)"),
    ],
)
@pytest.mark.slow
def test_a_command_does_its_work_whatever_becomes_of_its_output(
    tmp_path: Path, words: str, redirection: str, status: int, said: str | None
) -> None:
    command = f"{shlex.quote(sys.executable)} -m levade {words} {redirection}"
    if redirection == "| true":
        command += "; exit ${PIPESTATUS[0]}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert done.returncode == status
    if said is not None:
        assert (said in done.stderr) if said else done.stderr == ""
        assert done.stderr.count("\n") == bool(said)
    if words.startswith("solve"):
        assert Motion.load(tmp_path / "rearing" / "motion.npz").result.trials == 8
        assert sorted(path.name for path in (tmp_path / "rearing").iterdir()) == [
            *("checkpoint.jsonl", "motion.npz", "progress.csv", "task.yaml")
        ]


@pytest.mark.slow
def test_a_generation_that_does_not_fit_is_announced_and_split(
    levade, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert levade("solve", *QUICK.split(), "--out", "whole")[0] in (0, 1)
    monkeypatch.setattr(memory, "free_memory", lambda: 250_000)  # two trials of 30 steps

    status, out, err = levade("solve", *QUICK.split(), "--out", "parts")
    assert status in (0, 1), err
    assert "A generation of 4 trials needs" in out
    assert "with the same results" in out
    one, other = (Motion.load(tmp_path / name / "motion.npz") for name in ("whole", "parts"))
    assert one["joint_position"].tobytes() == other["joint_position"].tobytes()


@pytest.mark.parametrize("words", ["horizon=1e9", "hold=1e9", "start.settled.time=1e9", "search.population=1000000000"])
def test_numbers_that_would_run_for_ever_are_one_line(levade, tmp_path: Path, words: str) -> None:
    status, out, err = levade("solve", "rearing", "--set", words)
    assert (status, out) == (2, "")
    assert _one_line(err), err
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def broken(tmp_path: Path, unmet: Path) -> Path:
    """A motion whose simulation broke down at once: nothing but NaN."""
    content = read(unmet / "motion.npz")
    arrays = {name: np.full_like(a, np.nan) if a.ndim > 1 else a for name, a in content.arrays.items()}
    write(tmp_path / "nan.npz", Content({**content.meta, "diverged": True}, content.model_xml, arrays, content.assets))
    return tmp_path / "nan.npz"


@pytest.mark.parametrize(
    "words",
    [
        *("--no-report", "", "--json --report"),
        pytest.param("--figures figures --format svg --no-report", marks=pytest.mark.slow),
        pytest.param("--strip strip.png --no-report", marks=pytest.mark.slow),
    ],
)
def test_a_motion_of_nothing_but_nan_is_shown(levade, broken: Path, words: str) -> None:
    status, out, err = levade("show", broken.name, *words.split())
    assert status in (0, 1), err
    assert out
    assert "Traceback" not in err


def test_a_motion_of_nothing_but_nan_is_compared(levade, broken: Path, unmet: Path) -> None:
    assert levade("show", broken.name, unmet / "motion.npz", "--no-report")[0] in (0, 1)
