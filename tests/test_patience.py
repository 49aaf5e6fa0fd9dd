"""What takes long says so once, and only to a program that listens; the command line prints it."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest

from levade import patience
from levade.cli import main
from levade.patience import Patience, on_long_wait
from levade.robots import load_robot, neutral, posing


@pytest.fixture(autouse=True)
def _anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """Earlier tests found the same postures."""
    monkeypatch.setattr(posing, "_FOUND", {})


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every wait is a long one."""
    monkeypatch.setattr(patience, "PATIENCE", 0.0)


@pytest.fixture
def ankled(quadruped: type, tmp_path: Path) -> Path:
    """The model of a robot whose postures are searched: its legs have no closed form."""
    (tmp_path / "toy.xml").write_text(quadruped(joints=4).mjcf())
    return tmp_path / "toy.xml"


def test_a_wait_is_said_once_and_not_before_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    now, said = [0.0], []
    monkeypatch.setattr(patience.time, "monotonic", lambda: now[0])
    with on_long_wait(said.append):
        waiting = Patience("it takes long")
        for now[0] in (0.0, 1.9, 2.0, 5.0):
            waiting.check()
            assert said == ["it takes long"] * (now[0] >= 2.0)
    Patience("nobody hears it").check()


@pytest.mark.slow
def test_a_search_of_postures_says_what_would_spare_it(
    slow: None, ankled: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said: list[str] = []
    with on_long_wait(said.append):
        robot = load_robot(ankled)
        standing, crouched = said
        assert standing.startswith("searching for a posture in which toy stands; a keyframe")
        assert crouched.startswith("searching for the postures crouched and stretched of toy; its robot.yaml")
        lines = ["model: toy.xml", "postures:"]
        for name in ("neutral", "crouched", "stretched"):
            angles = robot.postures.get(name, robot.postures["neutral"])
            lines += [f"  {name}:", *(f"    {one}: {x}" for one, x in zip(robot.joint_names, angles, strict=True))]
        (tmp_path / "robot.yaml").write_text("\n".join(lines))
        load_robot(tmp_path / "robot.yaml")  # which spares it
    assert len(said) == 2
    load_robot(ankled.rename(tmp_path / "other.xml"))
    assert capsys.readouterr() == ("", "")


@pytest.mark.slow
@pytest.mark.parametrize(("words", "lines"), [([], 2), (["--json"], 0)])
def test_the_command_line_prints_it_except_to_programs(
    slow: None, ankled: Path, words: list[str], lines: int, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["robots", "inspect", str(ankled), *words])
    out, err = capsys.readouterr()
    assert "toy" in out
    begins = ["levade: searching for a posture in", "levade: searching for the postures"]
    assert [line[:34] for line in err.splitlines()] == begins[:lines]


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_ends_a_search_of_postures(
    ankled: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(neutral.PostureSearch, "_leg_cost", lambda *_: os.kill(os.getpid(), signal.SIGINT) or 0.0)
    with pytest.raises(SystemExit, match="130"):
        main(["robots", "inspect", str(ankled)])
    assert capsys.readouterr().err.splitlines()[-1] == "levade: interrupted"
