"""Fuzz: whatever a YAML document holds, it is read or refused in one line; the same documents in every run."""

from __future__ import annotations

import copy
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
from levade.tasks import load_task

TASKS = Path(load_task.__code__.co_filename).parent / "data"
ROBOTS = Path(__file__).parents[1] / "robots" / "cases"

TOKENS = ["- ", "- - - ", "[", "{", "}", "]", ": ", "? ", "&a ", "*a ", "<<: *a\n", "!!int ", "!!set ", "!!python/object:x ",
          "|\n", ">-\n", "---\n", "...\n", "%YAML 9.9\n", "#", "'", '"', "\t", "\0", "\ufeff", "\u2028", "\x85", '"\\e[31m"',
          "2026-02-30", "12:30:45", "=", "~", "0x" + "f" * 400, "9" * 5000, "k" * 3000, "&a [*a, *a]"]  # fmt: skip
VALUES: list[Any] = [None, True, 0, -1, 3, 10**17, 1e308, -1e-320, float("inf"), float("nan"), "", "x", "nan", "1e999 m",
                     "60 deg", "1 m", "2 heights", "99 parsecs", "all", "a" * 5000, "\u202e", "../../../etc/passwd", "/dev/zero",
                     [], [1], [[]], ["x"], [1, 2, 3], {}, {"x": 1}, {1: 2}, {None: None}, {"term": []}]  # fmt: skip


def places(content: Any) -> Iterator[tuple[Any, Any]]:
    """Every table or list in a document, with each of its keys."""
    for key, value in content.items() if isinstance(content, dict) else enumerate(content):
        yield content, key
        if isinstance(value, (dict, list)):
            yield from places(value)


def mutated_values(text: str, chance: random.Random) -> str:
    """One to three mistakes in what a document says: other values, other keys, keys that are gone or elsewhere."""
    content = copy.deepcopy(yaml.safe_load(text))
    for _ in range(chance.randint(1, 3)):
        found = list(places(content))
        if not found:
            break
        table, key = chance.choice(found)
        other, another = chance.choice(found)
        kind = chance.randrange(6)
        if kind == 0:
            del table[key]
        elif kind == 1 and isinstance(table, dict):
            table[chance.choice([another, 3, None, True, "x", "a" * 300])] = table.pop(key)
        elif kind == 2:
            table[key] = copy.deepcopy(other[another])
        else:
            table[key] = copy.deepcopy(chance.choice(VALUES))
    return yaml.safe_dump(content, sort_keys=False)


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
    try:
        load(path)
    except LevadeError as error:
        assert "\n" not in str(error), str(error)
        assert len(str(error)) < 1500, str(error)
        assert str(error).isprintable(), str(error)
        return False
    finally:
        assert time.process_time() - begin < seconds, text
    return True


def broken(text: str, name: str, documents: int) -> Iterator[str]:
    for number in range(documents):
        chance = random.Random(f"{name} {number}")
        yield mutated_text(text, chance) if number % 3 == 0 else mutated_values(text, chance)


@pytest.mark.parametrize(("name", "documents"), [
    ("rearing", 25),
    *(pytest.param(name, 120, marks=pytest.mark.slow) for name in ("rearing", "posture-recovery", "leap", "rearing-robust")),
])  # fmt: skip
def test_a_broken_task_is_read_or_refused_in_one_line(name: str, documents: int, tmp_path: Path) -> None:
    text = (TASKS / f"{name}.yaml").read_text(encoding="utf-8")
    taken = [
        read(load_task, tmp_path / "task.yaml", one, seconds=10) for one in broken(text, f"task {name}", documents)
    ]
    assert 0 < sum(taken) < documents


@pytest.mark.slow
def test_a_broken_description_of_a_robot_is_read_or_refused_in_one_line(tmp_path: Path) -> None:
    folder = ROBOTS / "hexa"
    for path in folder.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    text = (folder / "with2.yaml").read_text(encoding="utf-8")
    for one in broken(text, "robot", 40):
        read(load_robot, tmp_path / "robot.yaml", one, seconds=20)


def test_a_broken_plan_is_read_or_refused_in_one_line(tmp_path: Path) -> None:
    text = "tasks: [rearing]\noptimizers: [cma, {name: pi2}]\nseeds: [0, 1]\ntrials: 30\nchanges: {horizon: 0.3}\n"
    for one in broken(text, "plan", 60):
        read(read_plan, tmp_path / "plan.yaml", one, seconds=5)
