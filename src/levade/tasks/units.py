"""Numbers with units in task files: ``pitch: -60 deg``, ``horizon: 300 ms``. Plain numbers are SI."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from levade.costs.success import QUANTITIES
from levade.errors import LevadeError, did_you_mean

UNITS: dict[str, tuple[str, float]] = {
    "rad": ("an angle", 1.0),
    "deg": ("an angle", math.pi / 180),
    "m": ("a length", 1.0),
    "cm": ("a length", 0.01),
    "mm": ("a length", 0.001),
    "s": ("a duration", 1.0),
    "ms": ("a duration", 0.001),
    "m/s": ("a speed", 1.0),
    "rad/s": ("an angular speed", 1.0),
    "deg/s": ("an angular speed", math.pi / 180),
}
"""Unit -> what it measures, and its size in SI."""

_KEYS: dict[str, str] = {
    **dict.fromkeys(("roll", "pitch", "yaw", "slope", "spread"), "an angle"),
    **dict.fromkeys(("x", "y", "z", "height", "position", "size"), "a length"),
    **dict.fromkeys(("horizon", "hold", "timestep", "time"), "a duration"),
    # of perturbations
    **dict.fromkeys(("start_joint", "start_attitude", "ground_slope"), "an angle"),
    **dict.fromkeys(("com", "ground_height", "obstacle"), "a length"),
    **dict.fromkeys(("start_rate", "start_joint_velocity"), "an angular speed"),
    "latency": "a duration",
    "start_velocity": "a speed",
}
_BOUNDS = ("target", "tolerance", "minimum", "maximum")
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z°][\w°/²^]*)\s*")


def to_si(content: Any, *, where: str, measures: str | None = None) -> Any:
    """The same tables and lists with every "number unit" turned into a number in SI units.

    measures: what a bare value at this place stands for ("an angle", ...); None where no unit has a place.
    Raises LevadeError for a unit that does not exist or does not fit the key.
    """
    if isinstance(content, Mapping):
        return {
            key: to_si(value, where=f"{where}.{key}", measures=_measured(str(key), content))
            for key, value in content.items()
        }
    if isinstance(content, (list, tuple)):
        return [to_si(value, where=f"{where}.{i}", measures=measures) for i, value in enumerate(content)]
    match = _NUMBER.fullmatch(content) if isinstance(content, str) and not _is_number(content) else None
    if match is None:
        return content
    number, unit = match.groups()
    fitting = [name for name, (kind, _) in UNITS.items() if kind == measures]
    if unit not in UNITS:
        hint = f"units here: {', '.join(fitting)}" if fitting else did_you_mean(unit, UNITS)
        raise LevadeError(f"{where}: unknown unit {unit!r} in {content!r}; {hint}")
    kind, size = UNITS[unit]
    if measures is None:
        raise LevadeError(f"{where}: {content!r}, but this number takes no unit; give it in SI, without one")
    if kind != measures:
        raise LevadeError(f"{where}: {content!r} is {kind}, but this is {measures}; units here: {', '.join(fitting)}")
    return float(number) * size


def _is_number(text: str) -> bool:
    """Whether a text is a number without a unit: in 1e3 the e is none."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _measured(key: str, siblings: Mapping[str, Any]) -> str | None:
    quantity, term = str(siblings.get("quantity")), siblings.get("term")
    if key in _BOUNDS and quantity in QUANTITIES:
        return UNITS[QUANTITIES[quantity]][0]
    if key == "tolerance" and siblings.get("term") in ("orientation", "position"):
        return "an angle" if siblings["term"] == "orientation" else "a length"
    # terms that aim at a velocity name their components x, y, z too
    if key in ("x", "y", "z") and term in ("linear_velocity", "angular_velocity"):
        return "a speed" if term == "linear_velocity" else "an angular speed"
    if key == "position" and term == "posture":
        return "an angle"
    return _KEYS.get(key)
