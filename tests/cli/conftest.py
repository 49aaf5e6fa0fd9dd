"""The command line as a user meets it: in a directory of its own, in this process or as another, on a run that is there."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from levade.cli import main
from levade.search.run import run
from levade.tasks import load_task

Finished = tuple[int, str, str]
"""Exit status, standard output, standard error."""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every test runs in an empty directory, and without the colours that a CI machine may ask for."""
    monkeypatch.chdir(tmp_path)
    for name in ("FORCE_COLOR", "CLICOLOR_FORCE", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def urdf(tmp_path: Path, quadruped: type) -> Path:
    """The file of a small quadruped, in the test's directory."""
    path = tmp_path / "toy.urdf"
    path.write_text(quadruped().urdf())
    return path


@pytest.fixture
def levade(capfd: pytest.CaptureFixture[str]) -> Callable[..., Finished]:
    """Run the command line in this process; numbers and paths are taken as words."""

    def call(*words: object) -> Finished:
        with pytest.raises(SystemExit) as stopped:
            main([str(word) for word in words])
        out, err = capfd.readouterr()
        assert isinstance(stopped.value.code, int)
        return stopped.value.code, out, err

    return call


@pytest.fixture
def process() -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Start the command line as a process of its own, to send signals to; what is left of it at the end is killed."""
    started: list[subprocess.Popen[str]] = []

    def start(*words: object) -> subprocess.Popen[str]:
        one = subprocess.Popen(
            [sys.executable, "-m", "levade", *map(str, words)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1", "COLUMNS": "200"},
        )
        started.append(one)
        return one

    yield start
    for one in started:
        if one.poll() is None:
            one.kill()
            one.communicate()


@pytest.fixture(scope="session")
def unmet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of a run of two generations that has not met its goal, and a copy of its motion, other.npz."""
    directory = tmp_path_factory.mktemp("runs") / "rearing"
    changes = ["search.optimizer=cma", "search.population=8", "search.trials=16"]
    run(load_task("rearing", changes=changes), seed=0, directory=directory)
    (directory / "other.npz").write_bytes((directory / "motion.npz").read_bytes())
    return directory
