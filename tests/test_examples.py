"""The examples run as they stand, with small budgets, and say what they should."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"


@pytest.fixture
def example(tmp_path: Path) -> Callable[..., str]:
    """Runs an example in an empty folder, and gives back what it says."""

    def example(name: str, *arguments: str) -> str:
        command = [sys.executable, str(EXAMPLES / f"{name}.py"), "--trials", "24", *arguments]
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return example


@pytest.mark.slow
def test_own_cost(example: Callable[..., str], tmp_path: Path) -> None:
    said = example("own_cost")
    assert "the file says: {'python': '__main__.fastest', 'weight': 0.01}" in said
    assert {"own_cost.npz", "own_cost.html"} <= {path.name for path in tmp_path.iterdir()}


@pytest.mark.slow
def test_own_robot(example: Callable[..., str]) -> None:
    masses = [float(mass) for mass in re.findall(r"([\d.]+) kg", example("own_robot"))]
    assert masses[1] - masses[0] == pytest.approx(8)


@pytest.mark.slow
def test_own_optimizer(example: Callable[..., str]) -> None:
    costs = dict(re.findall(r"^([\w-]+): cost ([\d.]+)", example("own_optimizer"), re.MULTILINE))
    assert set(costs) == {"Climber", "cma-aimed"}
    assert 0 < float(costs["Climber"]) < 1000


@pytest.mark.slow
def test_warm_start(example: Callable[..., str]) -> None:
    said = re.findall(r"^(cold|warm): (?:no )?success after (\d+) trials$", example("warm_start"), re.MULTILINE)
    assert [name for name, _ in said] == ["cold", "warm"]
    assert all(int(trials) > 0 for _, trials in said)


@pytest.mark.slow
def test_chain(example: Callable[..., str]) -> None:
    heights = re.findall(r"height ([\d.]+) m, in its own file ([\d.]+) m", example("chain"))
    assert len(heights) == 3
    assert heights[0][0] == heights[0][1]


@pytest.mark.slow
def test_many_seeds(example: Callable[..., str]) -> None:
    said = example("many_seeds", "--seeds", "3")
    assert re.search(r"^\d of 3 succeed", said, re.MULTILINE)
    assert "seed 1 alone gives the same motion" in said


@pytest.mark.slow
def test_perturbed_models(example: Callable[..., str]) -> None:
    """The heavier the robot, the lower it ends."""
    heights = re.findall(r"^mass: .*height by ([+-][\d.]+) m$", example("perturbed_models"), re.MULTILINE)
    assert len(heights) == 5
    assert float(heights[0]) > float(heights[-1])


@pytest.mark.slow
def test_replay(example: Callable[..., str], tmp_path: Path) -> None:
    assert re.search(r"^150 steps; the largest difference .* is 0$", example("replay"), re.MULTILINE)
    assert example("replay", "replay/motion.npz").startswith("150 steps")
    assert "import levade" not in (EXAMPLES / "replay.py").read_text(encoding="utf-8")


@pytest.mark.slow
def test_plot(example: Callable[..., str], tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    assert "the goal is -1.047 rad" in example("plot")
    assert (tmp_path / "plot.png").read_bytes().startswith(b"\x89PNG")


def test_the_list_of_examples_is_whole() -> None:
    listed = re.findall(r"\]\((\w+)\.py\)", (EXAMPLES / "README.md").read_text(encoding="utf-8"))
    assert sorted(listed) == sorted(path.stem for path in EXAMPLES.glob("*.py"))
    tested = {name.removeprefix("test_") for name in globals() if name.startswith("test_")}
    assert set(listed) <= tested
