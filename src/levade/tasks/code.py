"""Costs, measures and optimizers that are Python code: a file names them, but does not hold them.

A motion file writes such a cost as ``{python: mymodule.mycost, weight: 1.0}``. Read from there, its term is a `MissingCode`:
the task can be looked at, and its criteria judged; only the cost itself cannot be evaluated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

from levade.costs import Criterion, Measure
from levade.errors import LevadeError, did_you_mean

KEY = "python"
"""Key of the table of such a cost, whose value is `code_name`."""


@dataclass(frozen=True)
class MissingCode:
    """What was Python code, in a task that was read from a file.

    Attributes:
        python: Where the code was: module and name.
    """

    python: str

    def __call__(self, *_: object, **__: object) -> NoReturn:
        """Always raises LevadeError: the code is not there."""
        raise LevadeError(f"task: {self.python} was Python code, which is not in the file; give the task the function")


def code_name(term: object) -> str:
    """Name a term that is Python code: its module and its name, or those of its class."""
    if isinstance(term, MissingCode):
        return term.python
    named = term if hasattr(term, "__qualname__") else type(term)
    return f"{named.__module__}.{named.__qualname__}"  # type: ignore[attr-defined]


def missing_code(content: Mapping[str, Any], *, where: str) -> tuple[MissingCode, Any]:
    """Read the table of a cost that was code: its term and what is given as its weight.

    Raises:
        LevadeError: If the table has other keys, or the name is no text.
    """
    rest = {key: value for key, value in content.items() if key not in (KEY, "weight", "term")}
    for key in rest:
        raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), [KEY, 'weight'])}")
    if not isinstance(content[KEY], str):
        raise LevadeError(f"{where}.{KEY}: should be the name of a Python function")
    return MissingCode(content[KEY]), content.get("weight")


def measure_to_dict(quantity: object) -> dict[str, str]:
    """What the table of a criterion says of a measure that is Python code; nothing for a built-in quantity."""
    if not isinstance(quantity, Measure):
        return {}
    return {KEY: code_name(quantity.function), "unit": quantity.unit}


def criterion_of_missing(content: Mapping[str, Any], *, where: str) -> Criterion:
    """Read the table of a criterion whose measure was code. Raises LevadeError if it makes no sense."""
    table = dict(content)
    python, unit, name = table.pop(KEY), table.pop("unit", ""), table.pop("quantity", "")
    if not all(isinstance(text, str) for text in (python, unit, name)):
        raise LevadeError(
            f"{where}.{KEY}: should be the name of a Python function, with its unit and quantity as texts"
        )
    legs = table.get("legs", "all")
    table["legs"] = tuple(legs) if isinstance(legs, list) else legs
    try:
        return Criterion(Measure(name, unit, MissingCode(python)), **table)
    except TypeError:
        raise LevadeError(f"{where}: has keys or values that no criterion has") from None
