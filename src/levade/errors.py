"""The base exception, and the hint at the end of every "unknown name" message.

    raise LevadeError("0 should be 1 to 500 Hz", field="rate")
    raise LevadeError(f"{path}: exists", remedies=(Remedy("replace it", "replace"),))

Messages name fields and plain actions. `levade.cli.flags` turns them into options and commands.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Remedy:
    """A remedy for an error.

    Attributes:
        words: What to do, such as "write elsewhere".
        action: Entry of `levade.cli.flags.ACTIONS` that does it on the command line, or None.
        at: File or directory of the action, or None.
    """

    words: str
    action: str | None = None
    at: Path | None = None


_LONGEST = 1000
"""Largest number of characters of a message."""


class LevadeError(Exception):
    """The input is wrong. The message is one line: what, where, what would be right, nearest valid name.

    Attributes:
        message: What is wrong, without field and remedies; as `one_line` has it, whatever the input holds.
        field: The argument that is wrong, by its name in Python; the text begins with it. None if it is no single one.
        remedies: What can be done, any of them; the text ends with them.
    """

    def __init__(self, message: str, *, field: str | None = None, remedies: Sequence[Remedy] = ()) -> None:
        super().__init__(message)
        self.message, self.field, self.remedies = one_line(message), field, tuple(remedies)

    def __str__(self) -> str:
        begin = "" if self.field is None else f"{self.field}: "
        *most, last = [remedy.words for remedy in self.remedies] or [""]
        what = f"{', '.join(most)} or {last}" if most else last
        return f"{begin}{self.message}{what and f'; {what}'}"


class MissingPackage(LevadeError):
    """A package that holds a robot's files is not installed; the message says how to get it."""


def one_line(text: str) -> str:
    r"""Make text fit for a line on a terminal.

    Line ends become spaces, control characters are escaped, and a very long text loses its middle.

    >>> one_line("joint \x1b[31mknee")
    'joint \\x1b[31mknee'

    Args:
        text: Any text.

    Returns:
        One line of printable characters.
    """
    if len(text) > _LONGEST:
        text = f"{text[: _LONGEST - 300]} ... {text[-300:]}"
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else " " if c.isspace() else repr(c)[1:-1] for c in text)


_MOST = 3
"""Largest number of names that a hint suggests."""


def nearest(name: str, valid: Iterable[str]) -> list[str]:
    """Find the valid names that an unknown name may stand for.

    Names that begin with the unknown one come before names that only look like it: g1 is the beginning of
    g1_29dof_rev_1_0, and not a typing error for go1.

    Args:
        name: The unknown name.
        valid: The valid names.

    Returns:
        The name that is closest; up to three names if they begin with the unknown one and none is close; or no name.
    """
    names = sorted(valid)
    begun = sorted((one for one in names if name and one.startswith(name)), key=len)
    if near := difflib.get_close_matches(name, begun or names, n=1, cutoff=0.6):
        return near
    return [one for i, one in enumerate(begun) if not one.startswith(tuple(begun[:i]))][:_MOST]


def did_you_mean(name: str, valid: Iterable[str]) -> str:
    """Return the tail of an "unknown name" message: the nearest valid names, or all of them when none is near.

    >>> did_you_mean("rearin", ["rearing", "posture-recovery"])
    'did you mean rearing?'

    Args:
        name: The unknown name.
        valid: The valid names.

    Returns:
        The hint.
    """
    names = sorted(valid)
    near = nearest(name, names)
    if not near:
        return f"valid names: {', '.join(names)}"
    *most, last = near
    return f"did you mean {', '.join(most)}{' or ' if most else ''}{last}?"


@contextmanager
def located(where: str) -> Iterator[None]:
    """Make errors begin with the key of the task that they are about.

    Args:
        where: What the message of an error within the context starts with, such as ``policy.``.

    Raises:
        LevadeError: If one is raised within the context. Its message begins with ``where``.
    """
    try:
        yield
    except LevadeError as error:
        raise LevadeError(f"{where}{error}") from None
