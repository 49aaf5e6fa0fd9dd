"""What library errors become on the command line."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
import typer

import levade as package
from levade.cli.app import app as commands
from levade.cli.flags import ACTIONS, in_flags
from levade.errors import LevadeError, Remedy

SOURCE = Path(package.__file__).parent
app = typer.main.get_command(commands)


@pytest.mark.parametrize(
    ("field", "arguments", "text"),
    [
        ("rate", ["stabilise", "motion.npz"], "--rate: no"),
        ("changes", ["solve", "rearing"], "--set no"),  # repeatable: which one it is comes next
        ("hold", ["export", "motion.npz"], "--hold: no"),
        ("robot", ["tasks", "show", "rearing"], "--robot: no"),
        ("task", ["solve", "rearing"], "task: no"),  # an argument has no flag
        ("rate", ["solve", "rearing"], "rate: no"),  # another command's
        ("rate", [], "rate: no"),
        (None, ["solve"], "no"),
    ],
)
def test_a_field_becomes_the_option_of_its_name(field: str | None, arguments: list[str], text: str) -> None:
    assert in_flags(LevadeError("no", field=field), app, arguments) == text


def test_remedies_come_with_what_to_type() -> None:
    run = Path("my run")
    remedies = [Remedy("go on with it", "resume", run), Remedy("replace it", "replace"), Remedy("move it")]
    assert in_flags(LevadeError("my run: there", remedies=remedies), app, ["solve"]) == (
        "my run: there; go on with it: levade solve --resume 'my run', replace it: --force, or move it"
    )
    one = LevadeError("my run: there", remedies=remedies[1:2])
    assert in_flags(one, app, ["solve"]) == "my run: there; replace it: --force"


@pytest.mark.slow
def test_every_remedy_of_the_library_can_be_typed() -> None:
    used = set()
    for path in SOURCE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "Remedy":
                used |= {argument.value for argument in node.args[1:2] if isinstance(argument, ast.Constant)}
    assert used == set(ACTIONS)


@pytest.mark.slow
def test_every_field_of_the_library_is_an_option() -> None:
    """Of some command: else nobody who types commands can find it."""
    fields = set()
    for path in SOURCE.rglob("*.py"):
        fields |= set(re.findall(r'LevadeError\([^#]*?field="(\w+)"', path.read_text(encoding="utf-8")))
    names = [
        ["solve"],
        ["show"],
        ["bench"],
        ["check"],
        ["stabilise"],
        ["export"],
        ["library", "build"],
        ["library", "check"],
        ["robots", "rightability"],
    ]
    assert len(fields) >= 6
    for field in fields:
        assert any(in_flags(LevadeError("", field=field), app, name).startswith("--") for name in names), field
