"""The documentation site's pages: every page is written, and a link to nothing is refused. CI builds the site itself."""

from __future__ import annotations

import importlib.util
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def build() -> Iterator[ModuleType]:
    """website/build.py; it puts its own directory on the path."""
    spec = importlib.util.spec_from_file_location("website_build", ROOT / "website" / "build.py")
    assert spec is not None
    assert spec.loader is not None
    module, before = importlib.util.module_from_spec(spec), list(sys.path)
    spec.loader.exec_module(module)
    yield module
    sys.path[:] = before
    sys.modules.pop("reference", None)


@pytest.fixture(scope="module")
def pages(build: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("latex2mathml", reason="mathematics becomes MathML: pip install 'levade[docs]'")
    out = tmp_path_factory.mktemp("website")
    build.write_pages(out)
    return out / "pages"


@pytest.mark.slow
def test_every_page_of_the_navigation_is_written(build: ModuleType, pages: Path) -> None:
    settings = build.tomllib.loads((pages.parent / "zensical.toml").read_text(encoding="utf-8"))
    listed = list(build._places(settings["project"]["nav"]))
    assert len(listed) > 40
    assert [place for place in listed if not (pages / place).is_file()] == []


@pytest.mark.slow
def test_the_command_line_s_page_has_every_option(pages: Path) -> None:
    text = (pages / "reference" / "cli.md").read_text(encoding="utf-8")
    commands = ROOT / "src" / "levade" / "cli" / "commands"
    source = "".join(path.read_text(encoding="utf-8") for path in commands.glob("*.py"))
    assert [name for name in re.findall(r'"(--[a-z-]+)"', source) if name not in text] == []


@pytest.mark.slow
def test_mathematics_needs_no_script(pages: Path) -> None:
    text = (pages / "search.md").read_text(encoding="utf-8")
    assert text.count("<math") == (ROOT / "docs" / "search.md").read_text(encoding="utf-8").count("$$") / 2
    assert "$$" not in text


def test_a_link_to_nothing_ends_the_build(build: ModuleType) -> None:
    with pytest.raises(SystemExit, match=r"there is no nowhere\.md"):
        build.prepared("see [this](nowhere.md)", ROOT / "docs" / "tasks.md", "tasks.md", {})
    code = "`[this](nowhere.md)`\n```\n[this](nowhere.md)\n```\n"
    assert build.prepared(code, ROOT / "docs" / "tasks.md", "tasks.md", {}) == code


def test_a_link_to_a_file_that_is_no_page_becomes_its_path(build: ModuleType) -> None:
    text = build.prepared("[the plan](../pyproject.toml)", ROOT / "docs" / "tasks.md", "tasks.md", {})
    assert text == "the plan (`pyproject.toml`)"


def test_a_list_right_after_a_paragraph_is_a_list(build: ModuleType) -> None:
    text = build.prepared(
        "Keys:\n- `one`\n- two\n  and more\n\n1. a\n2. b\n", ROOT / "docs" / "tasks.md", "tasks.md", {}
    )
    assert text == "Keys:\n\n- `one`\n- two\n  and more\n\n1. a\n2. b\n"
