"""docs/another-simulator.md, followed step by step in Bullet."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import pytest

from levade.cli import main

bullet = pytest.importorskip("pybullet", reason="motions are played in Bullet, too: pip install pybullet")

TEXT = (Path(__file__).parents[2] / "docs/another-simulator.md").read_text(encoding="utf-8")


@pytest.fixture
def followed(
    motion_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> tuple[dict[str, Any], list[str]]:
    """Names that the page defines, and the lines that it prints, after all of it was done."""
    (tmp_path / "rearing").mkdir()
    (tmp_path / "rearing/motion.npz").write_bytes(motion_file.read_bytes())
    monkeypatch.chdir(tmp_path)
    scope: dict[str, Any] = {}
    printed = ""
    for language, code in re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL):
        if language == "python":
            capsys.readouterr()
            exec(compile(code, "another-simulator.md", "exec"), scope)
            printed += capsys.readouterr().out
        elif code.startswith("levade"):
            with pytest.raises(SystemExit) as stopped:
                main(shlex.split(code)[1:])
            assert stopped.value.code == 0
    return scope, printed.splitlines()


@pytest.mark.slow
def test_the_page_plays_the_motion_in_bullet(followed: tuple[dict[str, Any], list[str]]) -> None:
    scope, printed = followed
    assert [line.split(":")[0] for line in printed] == ["ideal drives", "goal", "simulated drives"]
    measured, commanded = Path("rearing/motion-urdf"), Path("rearing/commanded")
    for folder, drives in ((measured, scope["ideal"]), (commanded, scope["simulated"])):
        height, turned = scope["play"](folder, drives)
        assert abs(height) < 0.015
        assert turned < 0.06
    # commanded references make another motion with other drives
    height, turned = scope["play"](commanded, scope["ideal"])
    assert abs(height) > 0.03
    assert turned > 0.1
    robot = scope["Robot"](measured)
    # Bullet's own reading of the URDF: the robot weighs the same, and the joints have the ranges of the file
    info = [bullet.getDynamicsInfo(robot.body, link)[0] for link in range(-1, bullet.getNumJoints(robot.body))]
    assert sum(info) == pytest.approx(80.51, rel=1e-6)
    limits = [bullet.getJointInfo(robot.body, joint)[8:12] for joint in robot.joints]
    for i, name in enumerate(("lower", "upper", "torque", "velocity")):
        assert [limit[i] for limit in limits] == pytest.approx(robot.meta["limits"][name])
    bullet.disconnect()
