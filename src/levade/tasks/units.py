"""Numbers with units in task files: ``pitch: -60 deg``, ``horizon: 300 ms``, ``z: 1.5 heights``. Plain numbers are SI.

A task in units of the robot means the same on every robot. These units are `levade.robots.Dimensions`, in singular or plural:
``1 height``, ``0.5 legs``, ``2 trunks``, ``6 falls``, ``0.2 heights/fall``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

from levade.costs.quantities import QUANTITIES
from levade.errors import LevadeError, did_you_mean
from levade.robots import Dimensions

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
"""Unit -> kind of quantity, and size in SI."""

ROBOT_UNITS: dict[str, tuple[str, Callable[[Dimensions], float]]] = {
    "height": ("a length", lambda robot: robot.height),
    "leg": ("a length", lambda robot: robot.leg),
    "trunk": ("a length", lambda robot: robot.trunk),
    "fall": ("a duration", lambda robot: robot.fall),
    "height/fall": ("a speed", lambda robot: robot.height / robot.fall),
    "rad/fall": ("an angular speed", lambda robot: 1.0 / robot.fall),
}
"""Unit of the robot -> kind of quantity, and size in SI."""

PLURALS = {  # of units of the robot
    "heights": "height",
    "legs": "leg",
    "trunks": "trunk",
    "falls": "fall",
    "heights/fall": "height/fall",
}

_KEYS: dict[str, str] = {
    **dict.fromkeys(("roll", "pitch", "yaw", "slope", "spread", "angle"), "an angle"),
    **dict.fromkeys(
        ("x", "y", "z", "height", "heights", "position", "size", "width", "depth", "midplane", "self_distance"),
        "a length",
    ),
    **dict.fromkeys(("horizon", "hold", "timestep", "time"), "a duration"),
    # of perturbations
    **dict.fromkeys(("start_joint", "start_attitude", "ground_slope"), "an angle"),
    **dict.fromkeys(("com", "ground_height", "obstacle"), "a length"),
    **dict.fromkeys(("start_rate", "start_joint_velocity"), "an angular speed"),
    "latency": "a duration",
    "room": "an angle",
    "start_velocity": "a speed",
}
_VELOCITIES = {
    "linear_velocity": "a speed",
    "angular_velocity": "an angular speed",
    "joint_velocity": "an angular speed",
}
_BOUNDS = ("target", "tolerance", "minimum", "maximum", "scale")
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z°][\w°/²^]*)\s*")


def to_si(
    content: Any, *, where: str, measures: str | None = None, robot: Callable[[], Dimensions] | None = None
) -> Any:
    """Turn every "number unit" in tables and lists into a number in SI units.

    Args:
        content: A table, a list or a value.
        where: Place of the content, for messages.
        measures: Kind of quantity of a bare value here ("an angle", ...); None where no unit is allowed.
        robot: Finds the size of the robot; called only if a number is in units of the robot. None refuses these units.

    Returns:
        The same content with numbers in SI.

    Raises:
        LevadeError: If a unit does not exist or does not fit the key.
    """
    if isinstance(content, Mapping):
        table = {}
        for key, value in content.items():
            inside = f"{where}.{key}"
            if key == "horizon" and isinstance(value, Mapping):
                table[key] = {
                    name: to_si(bound, where=f"{inside}.{name}", measures="a duration", robot=robot)
                    for name, bound in value.items()
                }
            elif key == "through" and isinstance(value, (list, tuple)):
                table[key] = [
                    to_si({"posture": posture}, where=f"{inside}.{i}", robot=robot)["posture"]
                    for i, posture in enumerate(value)
                ]
            elif key in ("posture", "goal") and isinstance(value, Mapping) and "weight" not in value:
                table[key] = {
                    joint: to_si(angle, where=f"{inside}.{joint}", measures="an angle")
                    for joint, angle in value.items()
                }
            else:
                table[key] = to_si(value, where=inside, measures=measured(str(key), content), robot=robot)
        return table
    if isinstance(content, (list, tuple)):
        return [to_si(value, where=f"{where}.{i}", measures=measures, robot=robot) for i, value in enumerate(content)]
    match = _NUMBER.fullmatch(content) if isinstance(content, str) and not is_number(content) else None
    if match is None:
        return content
    number, unit = match.groups()
    name = PLURALS.get(unit, unit)
    kinds = {name: kind for name, (kind, _) in (UNITS | (ROBOT_UNITS if robot else {})).items()}
    fitting = [name for name, kind in kinds.items() if kind == measures]
    if name not in kinds:
        hint = f"units here: {', '.join(fitting)}" if fitting else did_you_mean(unit, kinds)
        raise LevadeError(f"{where}: unknown unit {unit!r} in {content!r}; {hint}")
    kind = kinds[name]
    if measures is None:
        raise LevadeError(f"{where}: {content!r} has a unit, but this number takes none; give it in SI, without one")
    if kind != measures:
        raise LevadeError(f"{where}: {content!r} is {kind}, but this is {measures}; units here: {', '.join(fitting)}")
    if name in UNITS:
        return float(number) * UNITS[name][1]
    assert robot is not None
    return float(number) * ROBOT_UNITS[name][1](robot())


def is_number(text: str) -> bool:
    """Find out whether a text is a number without a unit, such as 1e3.

    Args:
        text: The text.

    Returns:
        Whether Python reads it as a number.
    """
    try:
        float(text)
    except ValueError:
        return False
    return True


def measure_of(criterion: Any) -> str | None:
    """Find the kind of quantity of a criterion's numbers.

    Args:
        criterion: Table of the criterion.

    Returns:
        The kind ("a length", ...); None if the numbers take no unit, or it is not a criterion.
    """
    quantity = criterion.get("quantity") if isinstance(criterion, Mapping) else None
    unit = QUANTITIES.get(quantity) if isinstance(quantity, str) else None
    return UNITS[unit][0] if unit in UNITS else None


def measured(key: str, siblings: Mapping[str, Any]) -> str | None:
    """Find the kind of quantity of a key's value.

    Args:
        key: The key.
        siblings: The table that the key is in.

    Returns:
        The kind ("an angle", ...); None if the value takes no unit.
    """
    term = str(siblings.get("term"))
    if key in _BOUNDS and (kind := measure_of(siblings)):
        return kind
    if key == "tolerance" and siblings.get("term") in ("orientation", "position"):
        return "an angle" if siblings["term"] == "orientation" else "a length"
    # terms that aim at a velocity also name their components x, y, z
    if term in _VELOCITIES and key in ("x", "y", "z", "tolerance", "velocity"):
        return _VELOCITIES[term]
    if key == "position" and term == "posture":
        return "an angle"
    return _KEYS.get(key)
