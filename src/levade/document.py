"""YAML documents at the edge: reading them, and one clear line for each mistake in them.

    content = read_yaml(path)
    task = build(Task, content, where=str(path))

Dataclasses say what a document may hold; pydantic checks it.
"""

from __future__ import annotations

import dataclasses
import functools
import re
import types
import typing
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from levade.errors import LevadeError, did_you_mean

T = TypeVar("T")


def read_yaml(path: Path, *, like: str = "") -> dict[str, Any]:
    """The table in a YAML file. Raises LevadeError if it cannot be read, is not YAML or not a table.

    like: some of its keys, for the message.
    """
    content = parse_yaml(read_text(path), where=str(path))
    if not isinstance(content, dict):
        expected = f"keys like {like};" if like else "keys and values,"
        raise LevadeError(f"{path}: should be a table of {expected} is {kind_of(content)}")
    return content


def read_text(path: Path) -> str:
    """The text of a file. Raises LevadeError if it cannot be read."""
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise LevadeError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or 'not UTF-8 text'})") from None


def parse_yaml(text: str, *, where: str) -> Any:
    """The value that a YAML text stands for; LevadeError, which starts with ``where``, if it is not YAML."""
    import yaml

    try:
        return yaml.load(text, Loader=_loader())
    except yaml.YAMLError as error:
        raise LevadeError(f"{where}: not YAML: {' '.join(str(error).split())}") from None


@functools.cache
def _loader() -> Any:
    """YAML's safe loader, for which 1e3 is a number, as in YAML 1.2; PyYAML's own takes it for a word."""
    import yaml

    base: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

    class Loader(base):
        pass

    number = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$")
    Loader.add_implicit_resolver("tag:yaml.org,2002:float", number, list("-+.0123456789"))
    return Loader


def build(kind: type[T], content: Any, *, where: str) -> T:
    """An instance of a dataclass from plain tables, lists and scalars.

    Raises LevadeError, one line that starts with ``where`` and the path of the key: unknown keys (with the nearest
    valid one), missing keys, values of a wrong type, and what the dataclasses themselves refuse.
    """
    import pydantic

    _check_keys(kind, content, where)
    try:
        return _adapter(kind).validate_python(content)
    except pydantic.ValidationError as error:
        raise LevadeError(f"{where}.{first_mistake(error)}") from None
    except LevadeError as error:
        said = str(error)
        raise LevadeError(said if said.startswith(f"{where}.") else f"{where}: {said}") from None


@functools.cache
def _adapter(kind: Any) -> Any:
    """The pydantic adapter of a type: making one costs more than a hundred validations."""
    import pydantic

    return pydantic.TypeAdapter(kind)


_CLASS = re.compile(r"([A-Z][a-z]+){2,}")
"""The name of a dataclass, which is no key: pydantic names the alternative of a union by it."""


def first_mistake(error: Any) -> str:
    """One line about the first mistake of a pydantic.ValidationError: the path of its key, what is wrong, what is
    there.
    """
    # pydantic tries each alternative of a union, and names it in the path; the one that it got furthest with was meant
    tags = ("str", "bool", "float", "int")
    paths = [
        [s for s in mistake["loc"] if s not in tags and "[" not in str(s) and not _CLASS.fullmatch(str(s))]
        for mistake in error.errors()
    ]
    furthest = max(range(len(paths)), key=lambda i: len(paths[i]))
    mistake, path = error.errors()[furthest], ".".join(map(str, paths[furthest]))
    if mistake["type"] == "missing":
        return f"{path}: missing"
    message = mistake["msg"].removeprefix("Input ").removeprefix("Value ")
    for ours, theirs in (
        ("a table of keys and values", "a valid dictionary"),
        ("a list", "a valid tuple"),
        ("should be a list of", "Tuple should have"),
        (" items, not", " items after validation, not"),
    ):
        message = message.replace(theirs, ours)
    return f"{path}: {message[0].lower()}{message[1:]}, is {kind_of(mistake['input'])}"


def kind_of(value: Any) -> str:
    """What a value is, for a message: its text if it is short, else its kind."""
    names = {type(None): "empty", dict: "a table", list: "a list", bool: "true or false"}
    return names.get(type(value)) or repr(value)


def _check_keys(kind: Any, content: Any, where: str) -> None:
    """Unknown keys of a dataclass, and of the dataclasses within it; and true or false for a number, which Python
    allows.
    """
    options = [kind, *typing.get_args(kind)] if _is_union(kind) else [kind]
    if isinstance(content, bool) and bool not in options and (float in options or int in options):
        raise LevadeError(f"{where}: should be a number, is {kind_of(content)}")
    kind = next((option for option in options if dataclasses.is_dataclass(option)), kind)
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if dataclasses.is_dataclass(kind):
        if dataclasses.is_dataclass(content):
            return
        if not isinstance(content, Mapping):
            plain = (int, float, str) if not isinstance(content, (list, tuple)) else ()
            if not any(option in plain or (option is type(None) and content is None) for option in options):
                raise LevadeError(f"{where}: should be a table of keys and values, is {kind_of(content)}")
            return
        fields = typing.get_type_hints(kind)
        valid = [field.name for field in dataclasses.fields(kind) if field.init]
        for key, value in content.items():
            if key not in valid:
                raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), valid)}")
            _check_keys(fields[key], value, f"{where}.{key}")
    elif origin in (tuple, list) and isinstance(content, (list, tuple)):
        for i, value in enumerate(content):
            _check_keys(arguments[0], value, f"{where}.{i}")
    elif isinstance(origin, type) and issubclass(origin, Mapping) and isinstance(content, Mapping):
        for key, value in content.items():
            _check_keys(arguments[1], value, f"{where}.{key}")


def _is_union(kind: Any) -> bool:
    return typing.get_origin(kind) in (typing.Union, types.UnionType)
