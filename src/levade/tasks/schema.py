"""The form of a task file as a JSON schema, for editors: completion, and mistakes underlined while typing.

    schema = task_schema()                          # levade tasks schema > task.schema.json

It follows from the dataclasses of a task and its terms: their fields, types and docstrings. `levade.tasks.load_task` checks
what a schema cannot express, such as the order of bounds or a group for every leg.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import types
import typing
from collections.abc import Mapping
from typing import Any, Literal

from levade.costs import Criterion
from levade.costs.quantities import QUANTITIES
from levade.engines import ENGINES
from levade.tasks.families import FAMILIES
from levade.tasks.files import BY_STANCE, BY_VARIANT, EXTENDS, VARIANT, VARIANTS
from levade.tasks.parts import HorizonRange
from levade.tasks.stances import ATTITUDES, LYING, STANCES
from levade.tasks.task import Task
from levade.tasks.terms import TERMS
from levade.tasks.units import PLURALS, ROBOT_UNITS, UNITS, measured
from levade.tasks.variants import KEEP, KEPT

Schema = dict[str, Any]

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def task_schema() -> Schema:
    """Make the JSON schema (draft 2020-12) of task files.

    Returns:
        The schema, as tables that JSON can hold.
    """
    definitions: dict[str, Schema] = {}
    task = _table(Task, definitions)
    task["properties"]["costs"] = _costs(definitions)
    task["properties"]["success"] = _success(definitions)
    task["properties"]["good_enough"] = {
        "type": "object",
        "description": "Name -> what differs from this criterion of success on perturbed models.",
        "additionalProperties": {"anyOf": [_reference("Criterion"), {"type": "null"}]},
    }
    definitions["Stage"]["properties"]["promote"] = {"type": "object", "additionalProperties": _number("any")}
    heights = definitions["Terrain"]
    heights["properties"]["file"] = {"type": "string", "description": "File of heights: a .npy in m, or an image."}
    heights["properties"]["height"] = _number("a length") | {"description": "Height of white in an image."}
    heights["required"] = ["size"]
    heights["oneOf"] = [{"required": ["heights"]}, {"required": ["file"]}]
    engine = definitions["Physics"]["properties"]["engine"]
    del engine["type"]
    engine["enum"] = list(ENGINES)
    task["properties"]["hardware"] = {"anyOf": [{"type": "boolean"}, task["properties"]["hardware"]]}
    definitions["StartChoice"] |= {"minProperties": 1, "maxProperties": 1}
    definitions["StartChoice"]["properties"]["fallen"]["anyOf"].append({"enum": list(FAMILIES)})
    definitions["Fall"]["properties"][LYING] = {
        "enum": list(ATTITUDES["level"]),
        "description": "Side that the robot comes to lie on, instead of roll and pitch.",
    }
    task["properties"][BY_STANCE] = {
        "type": "object",
        "description": "Stance -> changes of the task for robots that stand so; or a text that says why it does not apply.",
        "properties": {name: {"type": ["object", "string"]} for name in STANCES},
        "additionalProperties": False,
    }
    task["properties"][VARIANT] = {
        "enum": list(VARIANTS),
        "description": f"Makes the file this variant of the task that it {EXTENDS}.",
    }
    kept = {"type": "array", "items": {"enum": list(KEPT)}, "description": "Tables that the plan leaves as they are."}
    task["properties"][BY_VARIANT] = {
        "type": "object",
        "description": "Variant -> changes of it, which win over what follows from the criteria.",
        "properties": {name: {"type": "object", "properties": {KEEP: kept}} for name in VARIANTS},
        "additionalProperties": False,
    }
    task["dependentRequired"] = {VARIANT: [EXTENDS]}
    _extending(task)
    return {"$schema": DIALECT, "title": "levade task", **task, "$defs": definitions}


def _extending(task: Schema) -> None:
    """Let a task that extends another one leave out what it does not change, and remove a cost or a criterion by null."""
    task["properties"][EXTENDS] = {
        "type": "string",
        "description": "Task, or its file, that provides what is left out.",
    }
    task |= {"if": {"required": [EXTENDS]}, "then": {"required": ["name"]}, "else": {"required": task.pop("required")}}
    for name in ("costs", "success"):
        table = task["properties"][name]
        for key, value in table["properties"].items():
            table["properties"][key] = {"anyOf": [value, {"type": "null"}]}
        table["additionalProperties"] = {"anyOf": [table["additionalProperties"], {"type": "null"}]}


def _costs(definitions: dict[str, Schema]) -> Schema:
    """Make the schema of the costs: each is named after its term, or names it."""
    for name, term in TERMS.items():
        definitions[f"term {name}"] = table = _table(term, definitions, term=name)
        table["properties"] |= {"term": {"const": name}, "weight": {"type": "number"}}
        table["required"] = [*table.get("required", []), "weight"]
    explicit = {"required": ["term"], "oneOf": [_reference(f"term {name}") for name in TERMS]}
    named = {
        name: {"if": {"required": ["term"]}, "then": explicit, "else": _reference(f"term {name}")} for name in TERMS
    }
    return {
        "type": "object",
        "description": "Name -> term and weight, the paper's Q.",
        "properties": named,
        "additionalProperties": explicit,
        "minProperties": 1,
    }


def _success(definitions: dict[str, Schema]) -> Schema:
    """Make the schema of the criteria: each is named after its quantity, or names it."""
    table = definitions["Criterion"] = _table(Criterion, definitions)
    del table["required"]
    return {
        "type": "object",
        "description": "Name -> criterion; a motion succeeds when all hold.",
        "properties": {name: _reference("Criterion") for name in QUANTITIES},
        "additionalProperties": {"allOf": [_reference("Criterion"), {"required": ["quantity"]}]},
    }


def _table(kind: Any, definitions: dict[str, Schema], *, term: str | None = None) -> Schema:
    """Make the schema of a dataclass."""
    fields = [field for field in dataclasses.fields(kind) if field.init]
    hints, texts = typing.get_type_hints(kind), _described(kind, [field.name for field in fields])
    properties: dict[str, Schema] = {}
    for field in fields:
        if kind is Task and field.name in ("costs", "success", "good_enough"):
            continue
        measures = "any" if kind is Criterion else measured(field.name, {"term": term})
        if kind is HorizonRange:
            measures = "a duration"
        if term == "miss" and field.name in ("target", "tolerance", "minimum", "maximum", "scale"):
            measures = "any"
        schema = _schema(hints[field.name], measures, definitions)
        if field.name in texts:
            schema = {"description": texts[field.name], **schema}
        if isinstance(field.default, (bool, int, float, str)):
            schema["default"] = field.default
        properties[field.name] = schema
    missing = dataclasses.MISSING
    required = [f.name for f in fields if f.default is missing and f.default_factory is missing]
    summary = " ".join((kind.__doc__ or "").strip().split("\n\n")[0].split())
    schema = {"type": "object", "description": summary, "properties": properties, "additionalProperties": False}
    return schema | ({"required": required} if required else {})


def _schema(hint: Any, measures: str | None, definitions: dict[str, Schema]) -> Schema:
    """Make the schema of a type; numbers may have the units of what they measure."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if dataclasses.is_dataclass(hint):
        name = typing.cast(type, hint).__name__
        if name not in definitions:
            definitions[name] = {}  # a placeholder, for classes that contain themselves
            definitions[name] = _table(hint, definitions)
        return _reference(name)
    if origin in (typing.Union, types.UnionType):
        return {"anyOf": [_schema(argument, measures, definitions) for argument in arguments]}
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin in (tuple, list):
        if arguments[-1] is Ellipsis or origin is list:
            return {"type": "array", "items": _schema(arguments[0], measures, definitions)}
        items = [_schema(argument, measures, definitions) for argument in arguments]
        return {"type": "array", "prefixItems": items, "minItems": len(items), "maxItems": len(items)}
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": _schema(arguments[1], measures, definitions)}
    if hint is float:
        return _number(measures)
    plain = {int: "integer", str: "string", bool: "boolean", type(None): "null"}
    return {"type": plain[hint]}


def _number(measures: str | None) -> Schema:
    """Make the schema of a number, or of a text with a number and a unit that fits."""
    if measures is None:
        return {"type": "number"}
    kinds = {name: kind for name, (kind, _) in (UNITS | ROBOT_UNITS).items()}
    kinds |= {plural: kinds[one] for plural, one in PLURALS.items()}
    fitting = sorted(name for name, kind in kinds.items() if measures in ("any", kind))
    pattern = r"^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*(" + "|".join(map(re.escape, fitting)) + r")\s*$"
    return {"anyOf": [{"type": "number"}, {"type": "string", "pattern": pattern}]}


def _reference(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name.replace(' ', '%20')}"}


def _described(kind: Any, names: list[str]) -> dict[str, str]:
    """Find what a docstring says about each field, under ``Attributes:`` or as ``field: ...`` or ``one, other: ...``."""
    text = inspect.cleandoc(kind.__doc__ or "")
    _, found, section = text.partition("\nAttributes:\n")
    if found:
        section = re.split(r"\n(?=\S)", section)[0]  # up to the next section
        entries = re.findall(r"^ {4}(\w+): (.*(?:\n {8}.*)*)", section, re.MULTILINE)
        return {name: " ".join(what.split()).replace("``", "'") for name, what in entries if name in names}
    text = " ".join(text.split())
    label = r"(?:" + "|".join(map(re.escape, names)) + r")"
    parts = re.split(rf"(?:^|(?<=[.;)] ))({label}(?:, {label})*): ", text)
    described = {}
    for labels, what in zip(parts[1::2], parts[2::2], strict=True):
        for name in labels.split(", "):
            described[name] = re.sub(r" ?Raises LevadeError.*", "", what).strip().replace("``", "'")
    return described
