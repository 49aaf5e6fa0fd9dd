"""Families of falls that have a name, as others have published them, so that numbers compare.

    start: {fallen: playground}

It stands for the table of `FAMILIES`. `task.yaml` of a run has the table.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from levade.errors import LevadeError, did_you_mean

FAMILIES: dict[str, dict[str, Any]] = {"playground": {"height": 0.5, "time": 0.5, "gain": 1.0, "fold": {}}}
"""Name -> table of ``start.fallen``, in SI units.

"playground": the falls of MuJoCo Playground's get-up of Go1 (`Go1Getup`, getup.py). The trunk is released at 0.5 m, its
attitude is uniform over all rotations, each joint is uniform over its range, and the servos hold for 0.5 s. Then the robot
folds up, which counts as a part of getting up: until then the state is Playground's, and the robot may still move."""


def with_family(content: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Resolve the name of a family of falls in the tables of a task.

    Args:
        content: The tables.
        where: Place of the tables, for messages.

    Returns:
        The tables, with the family's own in place of its name.

    Raises:
        LevadeError: If there is no such family.
    """
    start = content.get("start")
    name = start.get("fallen") if isinstance(start, Mapping) else None
    if not (isinstance(start, Mapping) and isinstance(name, str)):
        return dict(content)
    if name not in FAMILIES:
        raise LevadeError(f"{where}.start.fallen: no family of falls {name!r}; {did_you_mean(name, FAMILIES)}")
    return {**content, "start": {**start, "fallen": dict(FAMILIES[name])}}
