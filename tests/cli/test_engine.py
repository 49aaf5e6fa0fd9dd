"""``--engine``: which physics, and what it says where ODE is not installed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from levade.engines.ode import library
from levade.errors import LevadeError
from levade.motions import Motion

QUICK = ["--set", "search.population=8", "--trials", "8", "--set", "horizon=0.06", "--set", "start.settled.time=0.1"]


@pytest.mark.slow
def test_a_task_is_solved_in_ode(levade, tmp_path: Path) -> None:
    try:
        library.load()
    except LevadeError as missing:
        pytest.skip(str(missing))
    status, out, err = levade("solve", "rearing", "--engine", "ode", "--json", *QUICK)
    assert (status, err) == (1, "")  # nobody rears in 8 trials
    assert json.loads(out)["trials"] == 8
    meta = Motion.load(tmp_path / "rearing" / "motion.npz").meta
    assert (meta["engine"], meta["diverged"]) == ("ode", False)
    assert "engine: ode\n" in (tmp_path / "rearing" / "task.yaml").read_text()
    status, out, err = levade("solve", "rearing", "--json", *QUICK)
    assert Motion.load(tmp_path / "rearing" / "motion.npz").meta["engine"] == "mujoco"


def test_an_engine_that_is_none(levade, tmp_path: Path) -> None:
    status, out, err = levade("solve", "rearing", "--engine", "od")
    assert (status, out) == (2, "")
    assert err.startswith("levade: --set physics.engine: ")
    assert "no engine 'od'; did you mean ode?" in err
    assert list(tmp_path.iterdir()) == []


def test_without_ode_one_line_says_what_to_install(levade, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_SYSTEM", "_WHEEL"):
        monkeypatch.setattr(library, name, "libode-is-not-here.so")
    library.load.cache_clear()
    try:
        status, out, err = levade("solve", "rearing", "--engine", "ode")
    finally:
        library.load.cache_clear()
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert "apt install libode8" in err
    assert "pip install 'levade[ode]'" in err
    assert list(tmp_path.iterdir()) == []
