"""YAML at the edge: what is read, and the one line for each mistake."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import pytest

from levade.document import build, kind_of, parse_yaml, read_text, read_yaml
from levade.errors import LevadeError


@dataclass(frozen=True)
class Part:
    size: float
    kind: Literal["round", "square"] = "round"
    flag: bool = False


@dataclass(frozen=True)
class Whole:
    name: str
    count: int = 3
    part: Part = Part(1.0)
    spare: Part | None = None
    parts: tuple[Part, ...] = ()
    table: Mapping[str, Part] = field(default_factory=dict)
    share: bool | float = True
    pose: str | Mapping[str, float] = "up"
    limit: int | None = None

    def __post_init__(self) -> None:
        if self.count < 0:
            raise LevadeError(f"count: {self.count} is negative")


def test_a_whole_document() -> None:
    text = """
    name: it
    count: 4
    part: {size: 1e3, kind: square, flag: true}
    parts: [{size: .5}, {size: -2E-1}]
    table: {a: {size: 3}}
    share: 0.5
    pose: {knee: 1.0, "*_hip": -1}
    """
    whole = build(Whole, parse_yaml(text, where="text"), where="text")
    assert whole == Whole(
        "it",
        4,
        Part(1000.0, "square", True),
        None,
        (Part(0.5), Part(-0.2)),
        {"a": Part(3.0)},
        0.5,
        {"knee": 1.0, "*_hip": -1.0},
    )
    assert build(Whole, {"name": "it", "spare": {"size": 1}, "share": False}, where="x").spare == Part(1.0)


@pytest.mark.parametrize("text", ["1e3", "1E+3", "+1e3", "1.0e3", "1000", "1_000", ".1e4", "10e2"])
def test_numbers_are_numbers_in_every_spelling(text: str) -> None:
    assert parse_yaml(text, where="x") == 1000


@pytest.mark.parametrize("text", ["e3", "1e", "1e3x", "1.2.3", "--1e3", "1e3 s", "'1e3'"])
def test_and_words_are_words(text: str) -> None:
    assert isinstance(parse_yaml(text, where="x"), str)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({}, "doc.name: missing"),
        ({"name": "it", "cuont": 1}, "doc: unknown key 'cuont'; did you mean count\\?"),
        ({"name": "it", "part": {"size": 1, "knd": 1}}, "doc.part: unknown key 'knd'; did you mean kind\\?"),
        ({"name": "it", "parts": [{"size": 1}, {"sze": 1}]}, "doc.parts.1: unknown key 'sze'; did you mean size\\?"),
        ({"name": "it", "table": {"a": {"sze": 1}}}, "doc.table.a: unknown key 'sze'; did you mean size\\?"),
        ({"name": "it", "spare": {"sze": 1}}, "doc.spare: unknown key 'sze'; did you mean size\\?"),
        ({"name": "it", "part": {"kind": "round"}}, "doc.part.size: missing"),
        ({"name": "it", "part": {"size": "big"}}, "doc.part.size: should be a valid number, .* is 'big'"),
        ({"name": "it", "part": {"size": True}}, "doc.part.size: should be a number, is true or false"),
        ({"name": "it", "count": False}, "doc.count: should be a number, is true or false"),
        ({"name": "it", "limit": True}, "doc.limit: should be a number, is true or false"),
        ({"name": "it", "part": {"size": None}}, "doc.part.size: should be a valid number, is empty"),
        ({"name": "it", "part": {"size": [1]}}, "doc.part.size: should be a valid number, is a list"),
        ({"name": "it", "part": 5}, "doc.part: should be a table of keys and values, is 5"),
        ({"name": "it", "parts": [5]}, "doc.parts.0: should be a table of keys and values, is 5"),
        ({"name": "it", "parts": 5}, "doc.parts: should be a list, is 5"),
        ({"name": "it", "table": [1]}, "doc.table: should be a table of keys and values, is a list"),
        ({"name": "it", "count": 1.5}, "doc.count: should be a valid integer, .* is 1.5"),
        ({"name": 7}, "doc.name: should be a valid string, is 7"),
        (
            {"name": "it", "part": {"size": 1, "kind": "oval"}},
            "doc.part.kind: should be 'round' or 'square', is 'oval'",
        ),
        ({"name": "it", "share": "half"}, "doc.share: should be a valid boolean, .* is 'half'"),
        ({"name": "it", "pose": {"*_hip": "bent"}}, r"doc.pose.\*_hip: should be a valid number, .* is 'bent'"),
        ({"name": "it", "count": -1}, "doc: count: -1 is negative"),
        ([1], "doc: should be a table of keys and values, is a list"),
    ],
)
def test_each_mistake_is_one_line_that_names_the_key(content: object, message: str) -> None:
    with pytest.raises(LevadeError, match=f"^{message}$") as caught:
        build(Whole, content, where="doc")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "should be a table of keys and values, is empty"),
        (b"- 1\n", "should be a table of keys and values, is a list"),
        (b"word", "should be a table of keys and values, is 'word'"),
        (b"a: [1,\nb: 2", "not YAML: .*line 1"),
        (b"\xff\xfe\x00a", "cannot be read"),
        (b"a: \x00", "not YAML"),
        (b"!!python/object:os.system {}", "not YAML"),
    ],
)
def test_files_that_are_no_tables(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes(data)
    with pytest.raises(LevadeError, match=f"^{re.escape(str(path))}: {message}") as caught:
        read_yaml(path)
    assert "\n" not in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match=r"none.yaml: cannot be read \(No such file or directory\)"):
        read_yaml(tmp_path / "none.yaml")
    with pytest.raises(LevadeError, match=r"cannot be read \(Is a directory\)"):
        read_yaml(tmp_path)


PAIRS = zip("abcdefgh", "bcdefghi", strict=True)
ALIASES = "a: &a [x,x,x,x]\n" + "".join(f"{n}: &{n} [{','.join([f'*{m}'] * 9)}]\n" for m, n in PAIRS)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("- " * 50_000, "line 1: nested more than 50 levels deep"),
        ("[" * 50_000, "line 1: nested more than 50 levels deep"),
        (ALIASES, "line 6: more than 200000 values, aliases counted as what they stand for"),
        ("a: &a [1, *a]", r"line 1: \*a stands for nothing that comes before it"),
        ("a:\n  b: *x", r"line 2: \*x stands for nothing that comes before it"),
        ("a: 1\n\nb: 2\n'a': 3", "line 4: the key 'a' is in line 1 already; keep one of them"),
        ("- {b: 1}\n- {1: x, 0x1: y}", "line 2: the key '0x1' is in line 2 already; keep one of them"),
        ("yes: 1\ntrue: 2", "line 2: the key 'true' is in line 1 already; keep one of them"),
        ("a: !!int abc", "line 1: 'abc' is no int"),
        ("a: !!bool abc", "line 1: 'abc' is no bool"),
        ("a: 3\nb: " + "9" * 5000, "line 2: '999999999999999999999999999999'..., a text of 5000 characters is no int"),
        (
            "a: !!set {b}",
            "not YAML: could not determine a constructor for the tag 'tag:yaml.org,2002:set' in line 1, .*",
        ),
        ("a: !!binary aGVsbG8=", "not YAML: could not determine a constructor .*"),
        ('a: 1\nb: "\\e[31m"', "line 2: a text with control characters; take them out"),
        ('"a\\x9b": 1', "line 1: a text with control characters; take them out"),
        ("? " + "k" * 500 + "\n: 1", "line 1: a key of 500 characters"),
        ("a: \ud800", "not YAML: it holds characters that are no text"),
        ("--- 1\n--- 2", "not YAML: expected a single document .*"),
    ],
    ids=lambda value: value[:30].encode("ascii", "backslashreplace").decode(),
)
def test_texts_that_are_refused(text: str, message: str) -> None:
    with pytest.raises(LevadeError, match=f"^here: {message}$"):
        parse_yaml(text, where="here")


def test_aliases_and_merges_stand_for_what_they_say() -> None:
    text = "a: &a {x: 1, y: [2]}\nb: *a\nc: {<<: *a, x: 3}\nd: {<<: [*a, {z: 4}]}\ne: &e 5\nf: *e"
    a = {"x": 1, "y": [2]}
    assert parse_yaml(text, where="x") == {"a": a, "b": a, "c": {"x": 3, "y": [2]}, "d": {**a, "z": 4}, "e": 5, "f": 5}


def test_a_date_is_a_text_and_a_huge_whole_number_a_number() -> None:
    text = "[2026-02-30, 2026-02-28 10:00:00, 9223372036854775807, 9223372036854775808, -1" + "0" * 300 + "]"
    assert parse_yaml(text, where="x") == ["2026-02-30", "2026-02-28 10:00:00", 2**63 - 1, 2.0**63, -1e300]


@pytest.mark.slow
def test_a_table_of_many_numbers_is_no_attack() -> None:
    row = f"[{', '.join(['0.125'] * 200)}]"
    assert len(parse_yaml("heights:\n" + f"- {row}\n" * 200, where="x")["heights"]) == 200


def test_a_file_that_has_no_end(tmp_path: Path) -> None:
    (tmp_path / "endless").symlink_to("/dev/zero")
    with pytest.raises(LevadeError, match="endless: has more than 10 million characters; a document has far less"):
        read_text(tmp_path / "endless")


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("word", "'word'"),
        ("<?xml version='1.0'?>\n" + "x" * 100, "\"<?xml version='1.0'?>\\nxxxxxxxx\"..., a text of 122 characters"),
        (1.5, "1.5"),
        (16**5000, "a huge number"),
        (("a",) * 100, "('a', 'a', 'a', 'a', 'a', 'a',..."),
        (None, "empty"),
        (True, "true or false"),
    ],
    ids=["word", "text", "number", "huge", "tuple", "none", "bool"],
)
def test_what_a_message_shows_of_a_value(value: object, said: str) -> None:
    assert kind_of(value) == said
