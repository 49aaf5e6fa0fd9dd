"""Fuzz: whatever a robot's file holds, it is understood or refused in one line; the same files in every run."""

from __future__ import annotations

import copy
import random
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from levade.errors import LevadeError
from levade.robots import load_robot
from levade.robots.doctor import inspect

CASES = Path(__file__).parent / "cases"
FILES = ["free-damped/strong.xml", "rod/pup.xml", "head/pantilt.xml", "pairs/pup.xml", "mimic-ankle/pup.urdf",
         "world/world-camera.urdf", "plate/full.urdf"]  # fmt: skip
WORDS = ["", "0", "-1", "1e308", "-1e308", "1e-320", "nan", "inf", "-inf", "0 0 0", "1 2", "x", "world", "trunk", "base",
         "FL_hip", "FL_knee", "ä\u202e[31m", "9" * 400, "a" * 5000, "true", "free", "ball", "slide", "mesh", "../../../x",
         "%s%n", "&amp;"]  # fmt: skip


def mutate(root: ET.Element, chance: random.Random) -> str:
    """A file with one to four mistakes: of elements, of attributes, or of its text."""
    root = copy.deepcopy(root)
    for _ in range(chance.randint(1, 4)):
        parents = [element for element in root.iter() if len(element)]
        element = chance.choice(list(root.iter()))
        parent = chance.choice(parents) if parents else root
        kind = chance.randrange(7)
        if kind == 0 and len(parent):
            parent.remove(chance.choice(list(parent)))
        elif kind == 1 and len(parent):
            chance.choice(parents).append(copy.deepcopy(chance.choice(list(parent))))
        elif kind == 2 and element.attrib:
            del element.attrib[chance.choice(list(element.attrib))]
        elif kind == 3:
            element.tag = chance.choice([other.tag for other in root.iter()])
        elif element.attrib:
            values = [*WORDS, *(value for other in root.iter() for value in other.attrib.values())]
            element.set(chance.choice(list(element.attrib)), chance.choice(values))
    text = ET.tostring(root, encoding="unicode")
    if chance.random() < 0.1:
        at = chance.randrange(len(text))
        text = text[:at] if chance.random() < 0.5 else text[:at] + chance.choice(WORDS) + text[at + 5 :]
    return text


def refusal(path: Path) -> str:
    """Why a robot is refused; empty if it is not, and the doctor has seen it."""
    try:
        robot = load_robot(path)
    except LevadeError as error:
        return str(error)
    assert robot.model.nv > 6
    inspect(robot)
    return ""


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_a_broken_file_is_understood_or_refused_in_one_line(tmp_path: Path, name: str) -> None:
    root = ET.fromstring((CASES / name).read_bytes())
    path = tmp_path / f"toy{Path(name).suffix}"
    for seed in range(60):
        path.write_text(mutate(root, random.Random(f"{name} {seed}")), encoding="utf-8")
        begin = time.process_time()
        said = refusal(path)
        assert "\n" not in said, seed
        assert len(said) < 2000, seed
        assert time.process_time() - begin < 20, seed
