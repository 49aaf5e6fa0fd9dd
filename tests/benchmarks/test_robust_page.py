"""docs/check.md and docs/robust.md say what the code says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from types import ModuleType

import pytest

from levade.checks import Demands
from levade.engines.perturbation import PARAMETERS
from levade.tasks import Racing, Robust

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGE = (DOCS / "check.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def robust(script: Callable[[str], ModuleType]) -> ModuleType:
    return script("robust")


def test_the_page_has_every_parameter_with_its_range_and_reason(robust: ModuleType) -> None:
    table = robust.parameters()
    assert table in PAGE
    for name, about in PARAMETERS.items():
        assert f"| `{name}` | {about.what} |" in table
        assert about.why in table


def test_the_page_has_every_demand_and_every_key_of_robust() -> None:
    for field in fields(Demands):
        assert f"`{field.name}`" in PAGE, field.name
    for field in fields(Robust):
        assert f"| `{field.name}` |" in PAGE, field.name
    assert f"first: {Racing().first}, keep: {Racing().keep:g}" in PAGE


@pytest.mark.slow
@pytest.mark.parametrize("name", ["check.md", "robust.md"])
def test_the_page_is_what_the_script_writes(robust: ModuleType, name: str) -> None:
    """Except for the line about the machine."""
    assert name in robust.PAGES
    written = (DOCS / name).read_text(encoding="utf-8").splitlines()
    made = [line for line in robust.page(name, robust.kept()).splitlines() if not line.startswith("Made by")]
    assert made == [line for line in written if not line.startswith("Made by")]
