"""Costs, measures and optimizers that are Python code: a file names them, but does not contain them.

A motion file writes such a cost as ``{python: mymodule.mycost, weight: 1.0}``. When it is read again, the term is a
`MissingCode`: the task can be shown, and its criteria evaluated, but not the cost itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

from levade.costs import Criterion, Measure
from levade.errors import LevadeError, did_you_mean

KEY = "python"
"""Key of a table that names Python code; its value is `code_name`."""


@dataclass(frozen=True)
class MissingCode:
    """Stands for Python code in a task that was read from a file.

    Attributes:
        python: Module and name of the code.
    """

    python: str

    def __call__(self, *_: object, **__: object) -> NoReturn:
        """Raise LevadeError, always: the code is not there."""
        raise LevadeError(f"task: {self.python} was Python code, which is not in the file; give the task its function")


def code_name(term: object) -> str:
    """Name a term that is Python code.

    Args:
        term: A function, class or object.

    Returns:
        Its module and its name, or those of its class.
    """
    if isinstance(term, MissingCode):
        return term.python
    named = term if hasattr(term, "__qualname__") else type(term)
    return f"{named.__module__}.{named.__qualname__}"  # type: ignore[attr-defined]


def missing_code(content: Mapping[str, Any], *, where: str) -> tuple[MissingCode, Any]:
    """Read the table of a cost that was Python code.

    Args:
        content: The table.
        where: Place of the table, for messages.

    Returns:
        The term, and the value of the key ``weight``, unchecked.

    Raises:
        LevadeError: If the table has other keys, or the name is not a text.
    """
    rest = {key: value for key, value in content.items() if key not in (KEY, "weight", "term")}
    for key in rest:
        raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), [KEY, 'weight'])}")
    if not isinstance(content[KEY], str):
        raise LevadeError(f"{where}.{KEY}: should be the name of a Python function")
    return MissingCode(content[KEY]), content.get("weight")


def measure_to_dict(quantity: object) -> dict[str, str]:
    """Write the keys that name a measure which is Python code.

    Args:
        quantity: The quantity of a criterion.

    Returns:
        Keys for the table of the criterion; none for a built-in quantity.
    """
    if not isinstance(quantity, Measure):
        return {}
    return {KEY: code_name(quantity.function), "unit": quantity.unit}


def criterion_of_missing(content: Mapping[str, Any], *, where: str) -> Criterion:
    """Read the table of a criterion whose measure was Python code.

    Args:
        content: The table.
        where: Place of the table, for messages.

    Returns:
        The criterion, whose measure cannot be evaluated.

    Raises:
        LevadeError: If a key or value of the table does not fit.
    """
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
        raise LevadeError(f"{where}: has keys or values that no criterion takes") from None
