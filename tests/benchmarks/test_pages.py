"""Pages that scripts in benchmarks/ write are what they would write now; every built-in task is in the gallery."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
Script = Callable[[str], ModuleType]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["duration", "gallery", "paper", "skills"])
def test_a_page_is_what_its_script_writes(script: Script, name: str) -> None:
    """Not so after a change to a template, to results or to what a task asks: python benchmarks/NAME.py --write."""
    module = script(name)
    assert module.PAGE.read_text(encoding="utf-8") == module.page()


def test_every_task_has_a_section_with_a_picture_or_says_that_it_has_none(script: Script) -> None:
    """python benchmarks/gallery.py --tasks NAME makes one."""
    page = ROOT / "docs" / "gallery.md"
    sections = {part.split("\n", 1)[0]: part for part in page.read_text(encoding="utf-8").split("\n## ")[1:]}
    films = re.findall(r"!\[[^]]*\]\((.*?)\)", sections.pop("Other kinds of robots"))
    assert len(films) == 4
    for film in films:
        content = (page.parent / film).read_bytes()
        assert content.startswith(b"GIF89a")
        assert len(content) < 700_000
    assert set(sections) == set(script("gallery").names())
    for section in sections.values():
        pictures = re.findall(r"!\[[^]]*\]\((.*?)\)", section)
        assert pictures or "No picture yet." in section
        for picture in pictures:
            content = (page.parent / picture).read_bytes()
            assert content.startswith(b"\x89PNG")
            assert len(content) < 200_000
        assert "success:\n" in section


def test_failures_stay_in_the_table_of_robots(script: Script) -> None:
    cell = script("skills").cell
    failure = {"task": "leap", "robot": "toy", "seed": 0, "success": False, "trials_to_success": None}
    success = {**failure, "success": True, "trials_to_success": 48}
    assert cell([], "leap", "toy") == "not run"
    assert cell([failure, failure], "leap", "toy") == "**0 of 2**"
    assert cell([failure, success, {**success, "trials_to_success": 24}], "leap", "toy") == "**2 of 3**; 36 (24 to 48)"
    assert cell([success] * 9 + [failure], "leap", "toy") == "9 of 10; 48 (48 to 48)"
    assert cell([{**failure, "refused": "why"}], "leap", "toy") == "refused"
