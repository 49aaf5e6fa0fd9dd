"""Read, write and check motion files. docs/motion-file.md documents their layout.

content = read("motion.npz")            # of any layout from 1 on, converted to layout `SCHEMA`
write("copy.npz", content)
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from levade.archive import unpack
from levade.arrays import Array
from levade.errors import LevadeError
from levade.feedback import ARRAYS as FEEDBACK_ARRAYS
from levade.feedback import META as FEEDBACK_META
from levade.motions.model import check_text
from levade.rotations import conjugate, rotate
from levade.writing import replacing

SCHEMA = 2
"""Version of the file's layout. It increases if a reader of the old one would be wrong.

1: ``trunk_angular_velocity`` is in world axes; there is no ``meta["policy"]``, and no stall torque in ``meta["limits"]``.
2: ``trunk_angular_velocity`` is in trunk axes.
"""

ARRAYS: dict[str, tuple[str, ...]] = {
    "qpos0": ("nq",),
    "qvel0": ("nv",),
    "act0": ("na",),
    "ctrl": ("steps", "nu"),
    "time": ("steps",),
    "joint_names": ("joints",),
    "joint_position_reference": ("steps", "joints"),
    "joint_velocity_reference": ("steps", "joints"),
    "joint_position": ("steps", "joints"),
    "joint_velocity": ("steps", "joints"),
    "joint_torque": ("steps", "joints"),
    "trunk_position": ("steps", "3"),
    "trunk_com_position": ("steps", "3"),
    "trunk_quaternion": ("steps", "4"),
    "trunk_linear_velocity": ("steps", "3"),
    "trunk_angular_velocity": ("steps", "3"),
    "foot_contact_force": ("steps", "feet", "3"),
    "weights": ("d",),
}
"""Array -> shape, by the names of its dimensions.

A file also has the texts ``meta`` and ``model_xml``, and bytes ``asset:NAME``.
"""

LATER_ARRAYS: dict[str, tuple[str, ...]] = {"joint_position_reference0": ("joints",)}
"""Arrays that files of early versions lack."""

META = (
    *("schema", "task", "robot", "trunk", "legs", "limits", "trunk_com_offset", "engine", "versions", "seed"),
    *("timestep", "horizon", "horizon_steps", "success", "diverged", "errors", "cost", "cost_terms"),
    *("trials", "trials_to_success", "stopped"),
)
"""Keys of ``meta``."""

LATER = ("cost_weights", "policy", "held", "model_joints", "initial", "trunk_balls", "values")
"""Keys of ``meta`` that files of early versions lack. A motion with a stabiliser also has ``feedback``."""

_LONGEST_META = 8_000_000
"""Largest number of characters of ``meta``. The largest height field takes an eighth of it."""

_FARTHEST = 1e12
"""Larger than any number of a motion that has not diverged, in any unit."""

_UNIT = 1e-3
"""Largest deviation of a quaternion's length from 1."""


@dataclass(frozen=True, eq=False)
class Content:
    """Holds the content of a motion file.

    Attributes:
        meta: The JSON.
        model_xml: MJCF of the model.
        arrays: The arrays of `ARRAYS`, and those of `LATER_ARRAYS` and the stabiliser that the file has.
        assets: Files that the model needs, by name.
    """

    meta: Mapping[str, Any]
    model_xml: str
    arrays: Mapping[str, Array]
    assets: Mapping[str, bytes]


def write(path: str | Path, content: Content) -> None:
    """Write a file, or leave the existing one unchanged: a new file is written next to it first.

    Args:
        path: The file.
        content: What to write.

    Raises:
        OSError: If the file cannot be written.
    """
    path = Path(path)
    data: dict[str, Any] = {
        "meta": np.array(json.dumps(content.meta, ensure_ascii=False)),
        "model_xml": np.array(content.model_xml),
        **content.arrays,
        **{f"asset:{name}": np.frombuffer(data, dtype=np.uint8) for name, data in content.assets.items()},
    }
    with replacing(path) as partial, partial.open("wb") as file:
        np.savez_compressed(file, **data)


def read(path: str | Path) -> Content:
    """Read a motion file of any layout up to `SCHEMA`, converted to that one.

    Args:
        path: The file.

    Returns:
        Its content.

    Raises:
        LevadeError: If the file is missing, damaged, something else, or of a later layout.
    """
    from levade.motions.form import check  # only now: a search that writes a motion needs no forms

    path = Path(path)
    data = unpack(path)
    missing = [name for name in ("meta", "model_xml", *ARRAYS) if name not in data]
    if missing:
        raise LevadeError(
            f"{path}: not a motion file, {', '.join(missing[:3])} missing; give a motion.npz of levade solve"
        )
    meta = _meta(path, data["meta"])
    later = {name: shape for name, shape in LATER_ARRAYS.items() if name in data}
    _check_arrays(path, data, {**ARRAYS, **later}, {"3": 3, "4": 4})
    if "feedback" in meta:
        _check_feedback(path, meta["feedback"], data)
    kept = [*ARRAYS, *later, *(FEEDBACK_ARRAYS if "feedback" in meta else ())]
    arrays = {name: _native(data[name]) for name in kept}
    assets = {name[6:]: _bytes(path, name, data[name]) for name in data if name.startswith("asset:")}
    xml = _text(path, "model_xml", data["model_xml"])
    try:
        check(meta, arrays)
        if not meta["diverged"]:
            _check_numbers(arrays)
        check_text(xml, assets)
    except LevadeError as error:
        raise LevadeError(f"{path}: {error}; the file is damaged, or not made by levade solve") from None
    return _converted(Content(meta, xml, arrays, assets))


def finite(values: Array) -> list[float | None]:
    """Return a list for JSON, which has no infinity: None stands for no limit.

    Args:
        values: Numbers, shape (n,).

    Returns:
        The n numbers, with None for each that is not finite.
    """
    return [float(value) if np.isfinite(value) else None for value in values]


def with_infinity(values: Sequence[float | None], infinity: float = np.inf) -> Array:
    """The inverse of `finite`.

    Args:
        values: Numbers; None stands for infinity.
        infinity: What stands for no limit, ``-np.inf`` for a lower one.
    """
    return np.array([infinity if value is None else value for value in values], dtype=float)


def _converted(content: Content) -> Content:
    """Convert content to layout `SCHEMA`. What an early version did not know stays out."""
    if content.meta["schema"] == SCHEMA:
        return content
    arrays = dict(content.arrays)
    arrays["trunk_angular_velocity"] = rotate(conjugate(arrays["trunk_quaternion"]), arrays["trunk_angular_velocity"])
    return Content({**content.meta, "schema": SCHEMA}, content.model_xml, arrays, content.assets)


def _text(path: Path, name: str, text: Array) -> str:
    if text.dtype.kind != "U" or text.shape:
        raise LevadeError(f"{path}: its {name} cannot be read; damaged, or not a motion.npz of levade solve")
    return str(text)


def _bytes(path: Path, name: str, data: Array) -> bytes:
    if data.dtype != np.uint8 or data.ndim != 1:
        raise LevadeError(f"{path}: {name!r} is of {data.dtype}, should be bytes; the file is damaged")
    return data.tobytes()


def _native(values: Array) -> Array:
    """Return an array as levade writes it: 64-bit floats, row by row."""
    return np.ascontiguousarray(values, dtype=None if values.dtype.kind == "U" else np.float64)


def _meta(path: Path, array: Array) -> dict[str, Any]:
    text = _text(path, "meta", array)
    try:
        if len(text) > _LONGEST_META:
            raise ValueError
        meta = json.loads(text, parse_int=_whole)
        schema = meta["schema"]
    except (ValueError, TypeError, KeyError, RecursionError):
        raise LevadeError(f"{path}: its meta cannot be read; damaged, or not a motion.npz of levade solve") from None
    numbered = isinstance(schema, int) and not isinstance(schema, bool)
    if numbered and not 1 <= schema <= SCHEMA:
        raise LevadeError(
            f"{path}: layout {schema}, but this levade reads layouts 1 to {SCHEMA}; use the levade that wrote it"
        )
    lacking = [key for key in META if key not in meta]
    if lacking or not numbered:
        raise LevadeError(f"{path}: its meta lacks {', '.join(lacking[:3]) or 'a schema'}; not made by levade solve")
    return meta


def _whole(digits: str) -> int:
    """Read a whole number of JSON, if a float can hold it.

    Raises:
        ValueError: If it cannot.
    """
    if len(digits) > 300:
        raise ValueError
    return int(digits)


def _check_feedback(path: Path, meta: Any, content: Mapping[str, Array]) -> None:
    lacking = [
        *(name for name in FEEDBACK_ARRAYS if name not in content),
        *(f"meta.feedback.{key}" for key in FEEDBACK_META if not isinstance(meta, dict) or key not in meta),
    ]
    if lacking:
        raise LevadeError(f"{path}: its stabiliser lacks {', '.join(lacking[:3])}; stabilise the motion again")
    joints = len(content["joint_names"])
    if not all(content[name].size for name in FEEDBACK_ARRAYS):
        raise LevadeError(f"{path}: its stabiliser has no gains; stabilise the motion again")
    sizes = {"joints": joints, "sensed": 6 + 2 * joints, "columns": 6 + 3 * joints}
    _check_arrays(path, content, FEEDBACK_ARRAYS, sizes)


def _check_numbers(arrays: Mapping[str, Array]) -> None:
    for name, values in arrays.items():
        if values.dtype.kind == "f" and not (np.abs(values) < _FARTHEST).all():
            raise LevadeError(f"{name} has values that are no numbers")
    turned = np.linalg.norm(arrays["trunk_quaternion"], axis=1)
    if (np.abs(turned - 1.0) > _UNIT).any():
        raise LevadeError("trunk_quaternion has rows that are no rotations")


def _check_arrays(
    path: Path, content: Mapping[str, Array], arrays: Mapping[str, tuple[str, ...]], sizes: dict[str, int]
) -> None:
    """Check that every array has as many dimensions as it should, and that dimensions of one name agree."""
    for name, dimensions in arrays.items():
        shape = content[name].shape
        if content[name].dtype.kind != ("U" if name == "joint_names" else "f"):
            kind = "texts" if name == "joint_names" else "floating-point numbers"
            raise LevadeError(f"{path}: {name} is of {content[name].dtype}, should be {kind}; the file is damaged")
        if len(shape) != len(dimensions) or any(
            sizes.setdefault(d, n) != n for d, n in zip(dimensions, shape, strict=True)
        ):
            expected = ", ".join(f"{d}={sizes[d]}" if d in sizes and not d.isdigit() else d for d in dimensions)
            raise LevadeError(f"{path}: {name} has the shape {shape}, should be ({expected}); the file is damaged")
