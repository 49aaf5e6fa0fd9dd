"""Costs that are Python code: a file names them, but does not hold them.

A motion file writes such a cost as ``{python: mymodule.mycost, weight: 1.0}``. Read from there, its term is a `MissingCode`:
the task can be looked at, and its criteria judged; only the cost itself cannot be evaluated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories

KEY = "python"
"""Key of the table of such a cost, whose value is `code_name`."""


@dataclass(frozen=True)
class MissingCode:
    """The term of a cost that was Python code, in a task that was read from a file.

    Attributes:
        python: Where the code was: module and name.
    """

    python: str

    def __call__(self, trajectories: Trajectories) -> Array:
        """Always raises LevadeError: the code is not there."""
        raise LevadeError(f"costs: {self.python} was Python code, which is not in the file; give the task the function")


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
