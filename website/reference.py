"""Reference pages from the code: the command line, task files, Python names."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Iterator
from typing import Any

from typer.main import get_command

from levade.cli.app import app
from levade.tasks.schema import task_schema

ROOMS = (
    "search", "tasks", "motions", "robots", "scenes", "costs", "policies", "optimizers", "engines", "regulators", "stabilisers",
    "checks", "exports", "hardware", "library", "bench", "trajectory", "embodiment", "feedback", "errors",
)  # fmt: skip
"""Rooms with names for users, after `levade` itself."""


def command_line() -> str:
    """Every command, with its arguments and options."""
    text = [
        "# Command line\n",
        "This page is generated from the code. `levade COMMAND --help` prints the same in a terminal.\n",
        "The exit status of a command is 0 if the answer is yes, and 1 if it is no or the command was interrupted. It is 2 if "
        "the input is wrong. One line on standard error then says what is wrong, where, and what to do.\n",
    ]
    for name, command in commands(get_command(app), "levade"):
        text.append(f"## {name}\n")
        text.append(_paragraphs(command.help or ""))
        arguments = [one for one in command.params if one.param_type_name == "argument" and not one.hidden]
        options = [one for one in command.params if one.param_type_name == "option" and "--help" not in one.opts]
        usage = [name, *(["[OPTIONS]"] if options else []), *(_metavar(one) for one in arguments)]
        text.append(f"```text\n{' '.join(usage)}\n```\n")
        if arguments or options:
            rows = [(f"`{_metavar(one)}`", one.help or "") for one in arguments]
            rows += [(_option(one), _with_default(one)) for one in options]
            text.append(table(("argument or option", "meaning"), rows))
    return "\n".join(text)


def _paragraphs(text: str) -> str:
    """A help text; paragraphs whose lines are kept, after a backspace, become code blocks."""
    parts = (part.strip("\n") for part in inspect.cleandoc(text).split("\n\n"))
    return "".join(
        f"```text\n{part[2:]}\n```\n\n" if part.startswith("\b") else f"{part}\n\n" for part in parts if part
    )


def commands(command: Any, name: str) -> Iterator[tuple[str, Any]]:
    """(name, command) of all commands, those of groups after them."""
    for word, one in getattr(command, "commands", {}).items():
        yield f"{name} {word}", one
        yield from commands(one, f"{name} {word}")


def _metavar(argument: Any) -> str:
    word = (argument.metavar or argument.name or "").upper()
    many = "..." if getattr(argument, "nargs", 1) == -1 else ""
    return f"{word}{many}" if argument.required else f"[{word}]{many}"


def _option(option: Any) -> str:
    names = " / ".join([*option.opts, *option.secondary_opts])
    if option.is_flag:
        return f"`{names}`"
    kind = {"int": "N", "float": "X", "Path": "PATH"}.get(option.type_descriptor.annotation.__name__, "TEXT")
    return f"`{names} {option.metavar or kind}`"


def _with_default(option: Any) -> str:
    text = option.help or ""
    if (
        option.is_flag
        or option.default is None
        or not getattr(option, "show_default", True)
        or callable(option.default)
    ):
        return text
    shown = str(option.default)
    return text if shown in ("None", "[]", "()") else f"{text} Default: `{shown}`."


def task_file() -> str:
    """Every key of a task file, from its schema."""
    schema = task_schema()
    definitions = schema.pop("$defs")
    text = [
        "# Task files: every key\n",
        "This page is generated from the schema that `levade tasks schema` prints. [Task files](../tasks.md) explains the keys "
        "and shows examples. Numbers are SI, or texts with a unit.\n",
        "## The task\n",
        _keys(schema, definitions),
    ]
    terms = {name.removeprefix("term "): one for name, one in definitions.items() if name.startswith("term ")}
    for name, one in sorted(definitions.items()):
        if not name.startswith("term ") and one.get("properties"):
            text += [f"## {name}\n", f"{_escaped(one.get('description', ''))}\n", _keys(one, definitions)]
    text += ["## Terms of costs\n", "Each takes `weight` as well.\n"]
    for name, one in sorted(terms.items()):
        keys = {key: value for key, value in one["properties"].items() if key not in ("term", "weight")}
        text += [f"### {name}\n", f"{_escaped(one.get('description', ''))}\n"]
        if keys:
            text.append(_keys({**one, "properties": keys}, definitions))
    return "\n".join(text)


def _keys(schema: dict[str, Any], definitions: dict[str, Any]) -> str:
    required = schema.get("required", [])
    rows = []
    for name, one in schema["properties"].items():
        default = f"`{one['default']}`" if one.get("default", "") != "" else "required" if name in required else ""
        rows.append((f"`{name}`", _kind(one, definitions), default, _escaped(_description(one))))
    return table(("key", "value", "default", "meaning"), rows)


def _description(schema: dict[str, Any]) -> str:
    """The description of a key, or of one of its alternatives."""
    alternatives = (_description(one) for one in schema.get("anyOf", []))
    return schema.get("description") or next((text for text in alternatives if text), "")


def _kind(schema: dict[str, Any], definitions: dict[str, Any]) -> str:
    """What may stand there, in words."""
    if "oneOf" in schema:  # the terms, chosen by a key
        return "[term](#terms-of-costs)"
    if "allOf" in schema:  # a definition, and a key that it has to have here
        return _kind(schema["allOf"][0], definitions)
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1].replace("%20", " ")
        return name if name.startswith("term ") else f"[{name}](#{name.lower()})"
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "anyOf" in schema:
        kinds = [_kind(one, definitions) for one in schema["anyOf"]]
        return " or ".join(dict.fromkeys(kind for kind in kinds if kind))
    kind = schema.get("type", "")
    if "pattern" in schema:
        return "number with a unit"
    if kind == "array":
        inner = schema.get("items") or (schema.get("prefixItems") or [{}])[0]
        count = f"{schema['maxItems']} times " if schema.get("maxItems") else "list of "
        return count + (_kind(inner, definitions) or "values")
    if kind == "object":
        inner = schema.get("additionalProperties")
        return f"table of {_kind(inner, definitions)}" if isinstance(inner, dict) and inner else "table"
    return {"string": "text", "boolean": "`true` or `false`", "null": "`null`"}.get(str(kind), str(kind))


def api_pages() -> dict[str, str]:
    """A page for `levade` and one for each room with names for users: title -> text for mkdocstrings."""
    pages = {}
    for room in ("levade", *(f"levade.{room}" for room in ROOMS)):
        module = importlib.import_module(room)
        names = [name for name in _public(module) if _documented(module, name)]
        summary = (module.__doc__ or "").strip().split("\n\n")[0].replace("\n", " ")
        entries = "\n".join(f"::: {_home(module, name)}\n" for name in names)
        pages[room] = f"# {room}\n\n{_escaped(summary)}\n\n{entries}"
    return pages


def _public(module: Any) -> list[str]:
    listed = getattr(module, "__all__", None)
    if listed is not None:
        return sorted((name for name in listed if not name.startswith("__")), key=str.lower)
    own = [name for name, value in vars(module).items() if getattr(value, "__module__", None) == module.__name__]
    return [name for name in own if not name.startswith("_")]


def _documented(module: Any, name: str) -> bool:
    value = getattr(module, name)
    return inspect.isclass(value) or inspect.isfunction(value)


def _home(module: Any, name: str) -> str:
    """The dotted name of the module that defines it: where a reader of source finds it."""
    value = getattr(module, name)
    home = getattr(value, "__module__", module.__name__)
    return f"{home}.{value.__name__}" if home.startswith("levade") else f"{module.__name__}.{name}"


def table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, tuple("---" for _ in head), *rows]
    return "".join("| " + " | ".join(_cell(cell) for cell in line) + " |\n" for line in lines)


def _cell(text: str) -> str:
    """One line; a bar ends a cell only outside code, where the generator shows a backslash before it."""
    parts = re.split(r"(`[^`]*`)", " ".join(text.split()))
    return "".join(part if i % 2 else part.replace("|", "\\|") for i, part in enumerate(parts))


def _escaped(text: str) -> str:
    """Prose of a docstring as Markdown: what looks like HTML is text."""
    text = text.replace("``", "`")
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if i % 2 else part.replace("<", "&lt;").replace("*", "\\*") for i, part in enumerate(parts))
