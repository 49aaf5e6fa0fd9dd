"""Fuzz: whatever a motion file holds, it is shown or refused in one line; the same files in every run."""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.cli.app import main
from levade.motions import Motion

DATA = Path(__file__).parent / "data"
Content = dict[str, np.ndarray]
Mistaken = Callable[[Any, random.Random], Any]

WORDS = [
    *(
        '<include file="/etc/passwd"/>',
        '<mesh name="m" file="there.obj"/>',
        '<replicate count="1000000">',
        "<!DOCTYPE x>",
    ),
    *(
        "<hfield name='h' nrow='99999' ncol='99999' size='1 1 1 1'/>",
        '<size memory="9999G"/>',
        "<",
        ">",
        '"',
        "&#27;",
        "&lt;",
    ),
    *("\x1b", "\ud800", "nan", "1e308", "-1", "0"),
]
TYPES = ["U5", "S3", "f2", "f4", ">f8", "i8", "bool", "O"]
NUMBERS = [np.nan, np.inf, -np.inf, 0.0, 1.0, -1e3, 1e300, 1e-300]


def other_array(content: Content, chance: random.Random) -> None:
    """One array has another shape, type or values, or is another one, or gone."""
    name = chance.choice(sorted(set(content) - {"meta", "model_xml"}))
    values = content[name]
    kind = chance.randrange(8)
    if kind == 0:
        del content[name]
    elif kind == 1:
        content[name] = values[: chance.randrange(len(values) + 1)]
    elif kind == 2:
        content[name] = values[..., None] if chance.random() < 0.5 else values.T
    elif kind == 3:
        content[name] = np.zeros(values.shape, dtype=chance.choice(TYPES))
    elif kind == 4:
        content[name] = content[chance.choice(sorted(content))]
    elif kind == 5:
        content[name] = np.full_like(values, chance.choice(NUMBERS)) if values.dtype.kind == "f" else values[::-1]
    elif values.size:
        content[name] = values.copy()
        content[name][tuple(chance.randrange(n) for n in values.shape)] = (
            chance.choice(NUMBERS) if values.dtype.kind == "f" else chance.choice(["", "x", "\x1b[2J", str(values[0])])
        )


def other_model(content: Content, chance: random.Random) -> None:
    """The model's text has other words in it, or lacks some."""
    text = str(content["model_xml"])
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(len(text))
        to = chance.choice([at, at + 1, at + chance.randrange(60)])
        text = text[:at] + chance.choice(["", *WORDS]) + text[to:]
    content["model_xml"] = np.array(text)


def broken(content: Content, mistaken: Mistaken, chance: random.Random) -> Content:
    content = dict(content)
    kind = chance.randrange(10)
    if kind < 6:
        meta = json.loads(str(content["meta"]))
        place = chance.choice([meta, meta, meta["task"], meta["limits"], meta["legs"]])
        wrong = mistaken(place, chance)
        place.clear()
        place.update(wrong if isinstance(wrong, dict) else {})
        content["meta"] = np.array(json.dumps(meta, ensure_ascii=chance.random() < 0.5))
    elif kind < 8:
        other_array(content, chance)
    else:
        other_model(content, chance)
    return content


def shown(words: list[str], capsys: pytest.CaptureFixture[str]) -> int:
    """The exit status of a command. Fails unless it is one of three, and 2 with one short line that a terminal can show."""
    capsys.readouterr()
    begin = time.process_time()
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert time.process_time() - begin < 20
    assert ended.value.code in (0, 1, 2)
    said = capsys.readouterr()
    assert all(c.isprintable() or c in "\n\t" for c in said.out), said.out
    if ended.value.code == 2:
        assert said.out == ""
        assert said.err.startswith("levade: ")
        assert said.err.endswith("\n")
        assert said.err[:-1].isprintable()
        assert len(said.err) < 2000
    else:
        assert said.err == ""
    return int(ended.value.code)


def contents(path: Path) -> Content:
    with np.load(path) as file:
        return {name: file[name] for name in file.files}


@pytest.fixture(scope="module")
def sources(moving: Motion, tmp_path_factory: pytest.TempPathFactory) -> list[Content]:
    """What is in a file of this layout, and in an early one with a stabiliser."""
    path = tmp_path_factory.mktemp("fuzz") / "motion.npz"
    moving.save(path)
    return [contents(path), contents(DATA / "rearing-robust-stabilised-1.npz")]


COMMANDS = {
    "show": ["show", "--no-report"],
    "json": ["show", "--json"],
    "export": ["export", "--to", "json"],
    "mjlab": ["export", "--to", "mjlab"],
    "view": ["view", "--out", "page.html"],
    "check": ["check", "--runs", "1", "--json"],
}


@pytest.mark.parametrize(("command", "files"), [
    ("show", 8),
    pytest.param("show", 60, marks=pytest.mark.slow),
    pytest.param("json", 15, marks=pytest.mark.slow),
    pytest.param("export", 40, marks=pytest.mark.slow),
    pytest.param("mjlab", 15, marks=pytest.mark.slow),
    pytest.param("view", 15, marks=pytest.mark.slow),
    pytest.param("check", 8, marks=pytest.mark.slow),
])  # fmt: skip
def test_a_broken_motion_is_shown_or_refused_in_one_line(
    command: str,
    files: int,
    sources: list[Content],
    mistaken: Mistaken,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    name, *options = COMMANDS[command]
    statuses = []
    for number in range(files):
        chance = random.Random(f"{command} {number}")
        np.savez("motion.npz", **broken(chance.choice(sources), mistaken, chance))  # type: ignore[arg-type]
        statuses.append(shown([name, "motion.npz", *options], capsys))
    assert 2 in statuses
    assert {0, 1} & set(statuses)
