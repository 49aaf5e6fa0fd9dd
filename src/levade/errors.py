"""The one base exception, and the hint that every "unknown name" message ends with."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager


class LevadeError(Exception):
    """The input is wrong. The message is one line: what, where, what would be right, nearest valid name."""


def did_you_mean(name: str, valid: Iterable[str]) -> str:
    """The tail of an "unknown name" message: the nearest valid name, or all of them when none is near.

    >>> did_you_mean("rearin", ["rearing", "posture-recovery"])
    'did you mean rearing?'
    """
    names = sorted(valid)
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.6)
    return f"did you mean {near[0]}?" if near else f"valid names: {', '.join(names)}"


@contextmanager
def located(where: str) -> Iterator[None]:
    """Make errors begin with the key of the task that they are about, such as ``policy.``."""
    try:
        yield
    except LevadeError as error:
        raise LevadeError(f"{where}{error}") from None
