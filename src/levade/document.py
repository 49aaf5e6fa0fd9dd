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
from collections import deque
from collections.abc import Hashable, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from levade.errors import LevadeError, did_you_mean

T = TypeVar("T")


_LARGEST = 10_000_000
"""[characters], of a document: the largest height field takes a tenth of it."""

_DEEPEST, _MOST, _LONGEST_KEY = 50, 200_000, 200
"""Levels, values with those that aliases stand for, and characters of a key. YAML's own composer recurses in C."""

_TAGS = tuple(f"tag:yaml.org,2002:{name}" for name in ("null", "bool", "int", "float", "str", "seq", "map"))
"""What a value may be: what JSON knows. A date is a text."""

_LONGEST_SHOWN = 60
"""[characters], of a text in a message."""

CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
"""What a terminal takes for a command; line ends and tabs it does not."""


_HIDDEN = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def hides(name: str) -> bool:
    """Tell whether a name holds what a terminal takes for a command or another order of letters, or what is no text.

    Args:
        name: The name.

    Returns:
        True if it holds any such character.
    """
    return _HIDDEN.search(name) is not None


def read_yaml(path: Path, *, like: str = "") -> dict[str, Any]:
    """Read the table in a YAML file.

    Args:
        path: The file.
        like: Some of its keys, for the message.

    Raises:
        LevadeError: If the file cannot be read, is not YAML or not a table.
    """
    content = parse_yaml(read_text(path), where=str(path))
    if not isinstance(content, dict):
        expected = f"keys like {like};" if like else "keys and values,"
        raise LevadeError(f"{path}: should be a table of {expected} is {kind_of(content)}")
    return content


def read_text(path: Path) -> str:
    """Read the text of a file.

    Args:
        path: The file, in UTF-8.

    Returns:
        Its text.

    Raises:
        LevadeError: If it cannot be read, or is far larger than a document.
    """
    try:
        with path.open(encoding="utf-8") as file:
            text = file.read(_LARGEST + 1)
    except (OSError, UnicodeDecodeError) as error:
        raise LevadeError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or 'not UTF-8 text'})") from None
    if len(text) > _LARGEST:
        raise LevadeError(f"{path}: has more than {_LARGEST // 1_000_000} million characters; a document has far less")
    return text


def parse_yaml(text: str, *, where: str) -> Any:
    """Read YAML: tables, lists, texts, numbers, true, false and null.

    The work is bounded by the length of the text: aliases that stand for more than they say are refused, and so is what is
    nested deeply. So are keys that are there twice, and texts with control characters.

    Args:
        text: The text.
        where: What error messages start with.

    Raises:
        LevadeError: If the text is not YAML, or refused.
    """
    import yaml

    try:
        _measure(text)
        loader = _loader()(text)
        try:
            node = loader.get_single_node()
            _check_scalars(loader, node)
            return None if node is None else loader.construct_document(node)
        finally:
            loader.dispose()
    except yaml.YAMLError as error:
        said = " ".join(str(error).replace('in "<unicode string>", ', "in ").split())
        raise LevadeError(f"{where}: not YAML: {said[:300]}") from None
    except UnicodeError:
        raise LevadeError(f"{where}: not YAML: it holds characters that are no text") from None
    except LevadeError as error:
        raise LevadeError(f"{where}: {error}") from None


def _measure(text: str) -> None:
    """Raise LevadeError if a text is nested too deeply, or has too many values with those that aliases stand for."""
    import yaml

    count, sizes = 0, {}  # of anchors: values that an alias stands for
    inside: list[tuple[str | None, int]] = []  # of what is open: its anchor, and the count before it
    for event in yaml.parse(text, Loader=_loader()):
        if isinstance(event, yaml.CollectionEndEvent):
            anchor, before = inside.pop()
            sizes[anchor] = count - before
            continue
        if not isinstance(event, yaml.NodeEvent):
            continue
        line, anchor = event.start_mark.line + 1, event.anchor
        if isinstance(event, yaml.AliasEvent):
            if anchor not in sizes:
                raise LevadeError(f"line {line}: *{anchor[:40]} stands for nothing that comes before it")
            count += sizes[anchor]
        else:
            sizes.pop(anchor, None)  # nothing may stand for what it is part of
            if isinstance(event, yaml.CollectionStartEvent):
                inside.append((anchor, count))
            count += 1
            if isinstance(event, yaml.ScalarEvent) and anchor is not None:
                sizes[anchor] = 1
        if len(inside) > _DEEPEST:
            raise LevadeError(f"line {line}: nested more than {_DEEPEST} levels deep")
        if count > _MOST:
            raise LevadeError(f"line {line}: more than {_MOST} values, aliases counted as what they stand for")


def _check_scalars(loader: Any, root: Any) -> None:
    """Raise LevadeError for a key that is there twice or too long, and for control characters."""
    import yaml

    waiting, seen = deque([root]), set()
    while waiting:
        node = waiting.popleft()
        if id(node) in seen:
            continue
        seen.add(id(node))
        if isinstance(node, yaml.ScalarNode):
            if CONTROL.search(node.value):
                raise LevadeError(f"line {node.start_mark.line + 1}: a text with control characters; take them out")
        elif isinstance(node, yaml.SequenceNode):
            waiting.extend(node.value)
        elif isinstance(node, yaml.MappingNode):
            _check_keys_differ(loader, [key for key, _ in node.value if isinstance(key, yaml.ScalarNode)])
            waiting.extend(part for pair in node.value for part in pair)


def _check_keys_differ(loader: Any, keys: Sequence[Any]) -> None:
    lines: dict[Any, int] = {}
    for key in keys:
        line = key.start_mark.line + 1
        if len(key.value) > _LONGEST_KEY:
            raise LevadeError(f"line {line}: a key of {len(key.value)} characters")
        name = "<<" if key.tag == "tag:yaml.org,2002:merge" else loader.construct_object(key)
        if not isinstance(name, Hashable):  # of a wrong tag; refused later
            continue
        if name in lines:
            raise LevadeError(f"line {line}: the key {key.value!r} is in line {lines[name]} already; keep one of them")
        lines[name] = line


@functools.cache
def _loader() -> Any:
    """YAML's safe loader for the tags of `_TAGS`. 1e3 is a number, as in YAML 1.2; PyYAML's own takes it for a word."""
    import yaml

    base: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

    class Loader(base):
        yaml_constructors: ClassVar = {tag: base.yaml_constructors[tag] for tag in (None, *_TAGS)}
        yaml_implicit_resolvers: ClassVar = {
            first: [(tag, pattern) for tag, pattern in pairs if tag in _TAGS or tag.endswith(":merge")]
            for first, pairs in base.yaml_implicit_resolvers.items()
        }

        def construct_object(self, node: Any, deep: bool = False) -> Any:
            try:
                return super().construct_object(node, deep)
            except (ValueError, LookupError, ArithmeticError, AttributeError, TypeError):
                kind = node.tag.rpartition(":")[2]
                raise LevadeError(f"line {node.start_mark.line + 1}: {kind_of(node.value)} is no {kind}") from None

        def construct_whole_number(self, node: Any) -> int | float:
            number = self.construct_yaml_int(node)
            return number if abs(number) < 2**63 else float(number)

    Loader.add_constructor("tag:yaml.org,2002:int", Loader.construct_whole_number)
    number = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$")
    Loader.add_implicit_resolver("tag:yaml.org,2002:float", number, list("-+.0123456789"))
    return Loader


def build(kind: type[T], content: Any, *, where: str) -> T:
    """Make an instance of a dataclass from plain tables, lists and scalars.

    Args:
        kind: The dataclass.
        content: The table, such as `read_yaml` returns it.
        where: What error messages start with. The path of the key follows.

    Returns:
        The instance.

    Raises:
        LevadeError: If a key is unknown (the message has the nearest valid one) or missing, a value has a wrong type,
            or the dataclass itself refuses a value. The message is one line.
    """
    import pydantic

    check_keys(kind, content, where)
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


@functools.cache
def _hints(kind: Any) -> dict[str, Any]:
    """The types of a class's fields: to evaluate their text takes as long as to validate a task."""
    return typing.get_type_hints(kind)


_CLASS = re.compile(r"([A-Z][a-z]+){2,}")
"""The name of a dataclass, which is no key: pydantic names the alternative of a union by it."""


def first_mistake(error: Any) -> str:
    """Say the first mistake of a pydantic.ValidationError in one line.

    Args:
        error: The pydantic.ValidationError.

    Returns:
        The path of the key, what is wrong, and what is there.
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
    """Say what a value is, for a message: itself if it is short, else how it begins.

    The text never holds a line end or a command to a terminal.

    Args:
        value: Any value of a document.

    Returns:
        The text, such as "a list".
    """
    names = {type(None): "empty", dict: "a table", list: "a list", bool: "true or false"}
    if type(value) in names:
        return names[type(value)]
    if isinstance(value, str) and len(value) > _LONGEST_SHOWN:
        return f"{value[:30]!r}..., a text of {len(value)} characters"
    try:
        text = repr(value)
    except ValueError:  # a whole number of thousands of digits
        return "a huge number"
    return text if len(text) <= 2 * _LONGEST_SHOWN else f"{text[:30]}..."


def check_keys(kind: Any, content: Any, where: str) -> None:
    """Refuse unknown keys of a dataclass and of those within it, and true or false for a number, which Python allows.

    Args:
        kind: Type that is expected: a dataclass, a container of them, a union or a plain type.
        content: Plain tables, lists and scalars.
        where: What error messages start with. The path of the key follows.

    Raises:
        LevadeError: If a key is unknown, something else is where a table should be, or true or false where a number
            should.
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
        fields = _hints(kind)
        valid = [field.name for field in dataclasses.fields(kind) if field.init]
        for key, value in content.items():
            if key not in valid:
                raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), valid)}")
            check_keys(fields[key], value, f"{where}.{key}")
    elif origin in (tuple, list) and isinstance(content, (list, tuple)):
        for i, value in enumerate(content):
            check_keys(arguments[0], value, f"{where}.{i}")
    elif isinstance(origin, type) and issubclass(origin, Mapping) and isinstance(content, Mapping):
        for key, value in content.items():
            check_keys(arguments[1], value, f"{where}.{key}")


def _is_union(kind: Any) -> bool:
    return typing.get_origin(kind) in (typing.Union, types.UnionType)
