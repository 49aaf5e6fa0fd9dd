"""Errors of the library speak of fields and of plain actions."""

from __future__ import annotations

import ast
import copy
import pickle
import re
from pathlib import Path

import pytest

import levade
from levade.errors import LevadeError, Remedy, did_you_mean

SOURCE = Path(levade.__file__).parent
OPTION = re.compile(r"(^|[\s(\"'`])--[a-z]|\blevade [a-z]+ (\w+ )*--")
NOT_OURS = {
    ("robots/packages.py", "--no-deps "),
    ("bench/cluster.py", "give the address that `ray start --head` printed"),
}
"""Options of pip and of Ray."""
COMMANDS = {
    ("report/summary.py", "--seed"),
    ("report/summary.py", " --from MOTION"),
    ("viewer/still.py", "--watch"),
    ("tasks/variants.py", " --full\nname: "),
}
"""Words of the command that a page or a file shows to copy."""


def messages(path: Path) -> list[str]:
    """Every string of a module that is no docstring."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    alone = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    return [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in alone
    ]


ALONE = [SOURCE / "exports" / name for name in ("player.py", "asker.py")]
"""Programs of their own, next to an export."""


@pytest.mark.slow
def test_only_the_command_line_speaks_of_its_options() -> None:
    found = {
        (str(path.relative_to(SOURCE).as_posix()), text)
        for path in SOURCE.rglob("*.py")
        if "cli" not in path.relative_to(SOURCE).parts and path not in ALONE
        for text in messages(path)
        if OPTION.search(text)
    }
    assert found == NOT_OURS | COMMANDS


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (LevadeError("motion.npz: no such file"), "motion.npz: no such file"),
        (LevadeError("0 should be more than 0", field="rate"), "rate: 0 should be more than 0"),
        (LevadeError("there: exists", remedies=[Remedy("replace it", "replace")]), "there: exists; replace it"),
        (
            LevadeError("exists", field="out", remedies=[Remedy("go on"), Remedy("move it"), Remedy("delete it")]),
            "out: exists; go on, move it or delete it",
        ),
        (
            LevadeError("two\nlines of \x1b]0;a title\x07 \x9b1m\u202e"),
            "two lines of \\x1b]0;a title\\x07 \\x9b1m\\u202e",
        ),
        (LevadeError("a" * 5000 + "; the remedy"), "a" * 700 + " ... " + "a" * 288 + "; the remedy"),
    ],
)
def test_an_error_is_field_message_and_remedies(error: LevadeError, text: str) -> None:
    assert str(error) == text


def test_an_error_survives_the_way_between_processes() -> None:
    error = LevadeError("exists", field="out", remedies=[Remedy("go on with it", "resume", Path("run"))])
    for same in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert (same.message, same.field, same.remedies) == (error.message, error.field, error.remedies)
        assert str(same) == "out: exists; go on with it"


@pytest.mark.parametrize(
    ("name", "valid", "hint"),
    [
        ("rearin", ["rearing", "squat"], "did you mean rearing?"),
        ("g1", ["go1", "g1_29dof_rev_1_0"], "did you mean g1_29dof_rev_1_0?"),
        ("g1", ["go1", "g1_29dof_with_hand", "g1_29dof"], "did you mean g1_29dof?"),
        ("g1", ["go1", "g1_29dof_hand", "g1_29dof_arm"], "did you mean g1_29dof_arm or g1_29dof_hand?"),
        ("lf", ["lf_haa", "lf_hfe", "lf_kfe", "rf_haa"], "did you mean lf_haa, lf_hfe or lf_kfe?"),
        ("lf", ["lf_a", "lf_bcdef", "lf_cdefg"], "did you mean lf_a?"),  # near enough, alone
        ("position", ["positions", "position_of_the_trunk"], "did you mean positions?"),
        ("stand", ["handstand", "stand-on-one-leg-only"], "did you mean stand-on-one-leg-only?"),
        ("x", ["go1", "a1"], "valid names: a1, go1"),
        ("", ["go1", "a1"], "valid names: a1, go1"),
    ],
)
def test_a_hint_prefers_names_that_begin_with_what_was_given(name: str, valid: list[str], hint: str) -> None:
    assert did_you_mean(name, valid) == hint
