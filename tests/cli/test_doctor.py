"""`levade doctor`: what it finds is there, and what it misses names its remedy."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from levade.cli import diagnosing
from levade.cli.diagnosing import Finding, extras, packages

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without OpenGL, which takes another process."""
    monkeypatch.setattr(diagnosing, "_opengl", lambda: Finding("Computer", "opengl", "missing", "no EGL", "install it"))


def test_it_looks_at_every_required_package() -> None:
    found = {one.name: one for one in packages()}
    needed = {line.split(">=")[0] for line in PROJECT["dependencies"]}
    assert needed <= set(found)
    assert {found[name].state for name in needed} == {"ok"}


def test_it_knows_every_extra_that_a_user_may_want() -> None:
    for_developers = {"dev", "docs", "package"}
    an_engine = {"ode"}
    assert {one.name for one in extras()} == set(PROJECT["optional-dependencies"]) - for_developers - an_engine


@pytest.mark.usefixtures("quick")
def test_a_missing_extra_says_what_to_install(levade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(diagnosing, "_there", lambda module: module not in ("mcap", "mjlab"))
    status, out, _ = levade("doctor")
    assert status == 0
    assert "pip install 'levade[ros2]'" in out
    assert "levade[robots]" not in out  # two other packages of robots are there


@pytest.mark.usefixtures("quick")
def test_an_old_package_is_broken(levade, monkeypatch: pytest.MonkeyPatch) -> None:
    real = diagnosing.version
    monkeypatch.setattr(diagnosing, "version", lambda name: "0.9" if name == "pydantic" else real(name))
    status, out, _ = levade("doctor", "--json")
    content = json.loads(out)
    assert (status, content["works"]) == (1, False)
    assert [one["name"] for one in content["findings"] if one["state"] == "broken"] == ["pydantic"]


def test_it_takes_no_robot_and_says_which_command_does(levade) -> None:
    status, _, err = levade("doctor", "pony.urdf")
    assert status == 2
    assert "levade robots inspect pony.urdf" in err


@pytest.mark.slow
def test_what_draws_is_named_where_there_is_opengl() -> None:
    found = diagnosing._opengl()
    assert found.state == "ok" or "install" in found.remedy or "MUJOCO_GL" in found.remedy
