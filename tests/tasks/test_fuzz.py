"""Fuzz: whatever a YAML document holds, it is read or refused in one line; the same documents in every run."""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from levade.bench.plan import read_plan
from levade.errors import LevadeError
from levade.robots import load_robot
from levade.tasks import load_task, task_text

ROBOTS = Path(__file__).parents[1] / "robots" / "cases"

TOKENS = ["- ", "- - - ", "[", "{", "}", "]", ": ", "? ", "&a ", "*a ", "<<: *a\n", "!!int ", "!!set ", "!!python/object:x ",
          "|\n", ">-\n", "---\n", "...\n", "%YAML 9.9\n", "#", "'", '"', "\t", "\0", "\ufeff", "\u2028", "\x85", '"\\e[31m"',
          "2026-02-30", "12:30:45", "=", "~", "0x" + "f" * 400, "9" * 5000, "k" * 3000, "&a [*a, *a]"]  # fmt: skip


def mutated_text(text: str, chance: random.Random) -> str:
    """One to four mistakes in how a document is written."""
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(text) + 1)
        to = min(len(text), at + chance.randint(0, 30))
        kind = chance.randrange(4)
        if kind == 0:
            text = text[:at] + text[to:]
        elif kind == 1:
            text = text[:at] + text[at:to] * 2 + text[to:]
        else:
            text = text[:at] + chance.choice(TOKENS) * chance.choice([1, 1, 1, 200]) + text[at:]
    return text


def read(load: Callable[[Path], object], path: Path, text: str, *, seconds: float) -> bool:
    """Whether a document is read. Fails if it is refused in any other way than by one short line, or takes long."""
    path.write_text(text, encoding="utf-8")
    begin = time.process_time()
    said = ""
    try:
        load(path)
    except LevadeError as error:
        said = str(error)
    assert time.process_time() - begin < seconds, text
    assert said == "" or said.isprintable(), said
    assert len(said) < 1500, said
    return not said


@pytest.fixture(scope="session")
def broken(mistaken: Callable[[Any, random.Random], Any]) -> Callable[[str, str, int], Iterator[str]]:
    """The same documents for a text and a name in every run, each with a few mistakes in how it is written or what it says."""

    def broken(text: str, name: str, documents: int) -> Iterator[str]:
        for number in range(documents):
            chance = random.Random(f"{name} {number}")
            if number % 3 == 0:
                yield mutated_text(text, chance)
            else:
                yield yaml.safe_dump(mistaken(yaml.safe_load(text), chance), sort_keys=False)

    return broken


Broken = Callable[[str, str, int], Iterator[str]]


@pytest.mark.parametrize(("name", "documents"), [
    ("rearing", 25),
    pytest.param("rearing", 200, marks=pytest.mark.slow),
    pytest.param("rearing-robust", 60, marks=pytest.mark.slow),
    pytest.param("leap", 30, marks=pytest.mark.slow),
])  # fmt: skip
def test_a_broken_task_is_read_or_refused_in_one_line(
    name: str, documents: int, broken: Broken, tmp_path: Path
) -> None:
    text = task_text(name)
    taken = [
        read(load_task, tmp_path / "task.yaml", one, seconds=10) for one in broken(text, f"task {name}", documents)
    ]
    assert 0 < sum(taken) < documents


@pytest.mark.slow
def test_a_broken_description_of_a_robot_is_read_or_refused_in_one_line(broken: Broken, tmp_path: Path) -> None:
    folder = ROBOTS / "hexa"
    for path in folder.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    text = (folder / "with2.yaml").read_text(encoding="utf-8")
    for one in broken(text, "robot", 60):
        read(load_robot, tmp_path / "robot.yaml", one, seconds=20)


def test_a_broken_plan_is_read_or_refused_in_one_line(broken: Broken, tmp_path: Path) -> None:
    text = "tasks: [rearing]\noptimizers: {a: {search.optimizer: cma}}\nseeds: 3\ntrials: 30\nchanges: {horizon: 0.3}\n"
    taken = [read(read_plan, tmp_path / "plan.yaml", one, seconds=5) for one in broken(text, "plan", 60)]
    assert 0 < sum(taken) < 60
