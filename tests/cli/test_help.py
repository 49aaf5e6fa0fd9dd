"""Help texts: what they tell a person to type is there, and lines that belong together stay together."""

from __future__ import annotations

import re
from typing import Any

import pytest
from typer.main import get_command

from levade.cli.app import app

TREE = get_command(app)


def texts() -> list[tuple[str, str]]:
    return [("", TREE.help), *((name, command.help or "") for name, command in TREE.commands.items())]


def named(words: list[str]) -> Any:
    """The command that words begin with, which has to exist."""
    command = TREE
    for word in words:
        if word in getattr(command, "commands", {}):
            command = command.commands[word]
        elif command is TREE:
            raise AssertionError(f"no command {word}")
    return command


@pytest.mark.parametrize(("name", "text"), texts())
def test_commands_and_options_in_a_help_text_exist(name: str, text: str) -> None:
    for line in re.findall(r"\blevade ([a-z].*)", text):
        words = re.split(r"\s{2,}|[,;.]\s", line)[0].split()
        options = {option for param in named(words).params for option in (*param.opts, *param.secondary_opts)}
        assert [word for word in words if word.startswith("--") and word not in options] == [], line


@pytest.mark.parametrize(
    "name",
    [
        "",
        *("solve", "show", "view", "check", "stabilise", "export", "bench"),
        *("library", "library build", "library merge", "library check", "library export"),
        *("tasks", "robots", "robots inspect"),
    ],
)
def test_examples_keep_their_lines(levade, name: str) -> None:
    status, out, _ = levade(*name.split(), "--help")
    assert status == 0
    assert "\\b" not in out
    assert "\b" not in out
    assert len(re.findall(r"^ +(?:\w+: +)?levade \w+", out, re.MULTILINE)) >= 1
