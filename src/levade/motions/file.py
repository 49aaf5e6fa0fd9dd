"""The motion file: its layout, reading and writing it, and what is checked on the way. docs/motion-file.md documents it.

content = read("motion.npz")            # of any layout from 1 on, as one of layout `SCHEMA`
write("copy.npz", content)
"""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.feedback import ARRAYS as FEEDBACK_ARRAYS
from levade.feedback import META as FEEDBACK_META
from levade.rotations import conjugate, rotate

SCHEMA = 2
"""Version of the file's layout; raised when a reader of the old one would be wrong.

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
"""Array -> shape, by name of the dimension. Next to these: ``meta`` and ``model_xml``, texts, and ``asset:NAME``, bytes."""

LATER_ARRAYS: dict[str, tuple[str, ...]] = {"joint_position_reference0": ("joints",)}
"""Arrays that files of early versions lack."""

META = (
    *("schema", "task", "robot", "trunk", "legs", "limits", "trunk_com_offset", "engine", "versions", "seed"),
    *("timestep", "horizon", "horizon_steps", "success", "diverged", "errors", "cost", "cost_terms"),
    *("trials", "trials_to_success", "stopped"),
)
"""Keys of ``meta``."""

LATER = ("cost_weights", "policy", "held", "model_joints", "initial")
"""Keys of ``meta`` that files of early versions lack. ``feedback`` is there if the motion has a stabiliser."""

# what numpy and zipfile raise for files that are damaged, or something else
_UNREADABLE = (
    *(OSError, ValueError, EOFError, AttributeError, TypeError, LookupError, RuntimeError, MemoryError, SyntaxError),
    *(zipfile.BadZipFile, zlib.error),
)


@dataclass(frozen=True, eq=False)
class Content:
    """What is in a motion file.

    Attributes:
        meta: Its JSON.
        model_xml: The model's MJCF.
        arrays: Those of `ARRAYS`, and of `LATER_ARRAYS` and the stabiliser where it has them.
        assets: Files that the model needs, by name.
    """

    meta: Mapping[str, Any]
    model_xml: str
    arrays: Mapping[str, Array]
    assets: Mapping[str, bytes]


def write(path: str | Path, content: Content) -> None:
    """Write the file, or leave the one that is there as it is: a new one is written next to it first. Raises OSError."""
    path = Path(path)
    data: dict[str, Any] = {
        "meta": np.array(json.dumps(content.meta, ensure_ascii=False)),
        "model_xml": np.array(content.model_xml),
        **content.arrays,
        **{f"asset:{name}": np.frombuffer(data, dtype=np.uint8) for name, data in content.assets.items()},
    }
    partial = path.with_name(f".{path.name}.partial")
    try:
        with partial.open("wb") as file:
            np.savez_compressed(file, **data)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def read(path: str | Path) -> Content:
    """Read a motion file of any layout up to `SCHEMA`, converted to that one.

    Raises:
        LevadeError: If the file is missing, damaged, something else, or of a later layout.
    """
    path = Path(path)
    data = _opened(path)
    missing = [name for name in ("meta", "model_xml", *ARRAYS) if name not in data]
    if missing:
        raise LevadeError(
            f"{path}: not a motion file, {', '.join(missing[:3])} missing; give a motion.npz of levade solve"
        )
    meta = _meta(path, data["meta"])
    later = {name: shape for name, shape in LATER_ARRAYS.items() if name in data}
    _check_arrays(path, data, {**ARRAYS, **later}, {"3": 3, "4": 4})
    if not meta["diverged"]:
        _check_numbers(path, data)
    if "feedback" in meta:
        _check_feedback(path, meta["feedback"], data)
    assets = {name[6:]: data[name].tobytes() for name in data if name.startswith("asset:")}
    kept = [*ARRAYS, *later, *(FEEDBACK_ARRAYS if "feedback" in meta else ())]
    return _converted(Content(meta, str(data["model_xml"]), {name: data[name] for name in kept}, assets))


def finite(values: Array) -> list[float | None]:
    """A list for JSON, which has no infinity: None where there is no limit."""
    return [float(value) if np.isfinite(value) else None for value in values]


def with_infinity(values: Sequence[float | None], infinity: float = np.inf) -> Array:
    """The inverse of `finite`. infinity: what stands for no limit, ``-np.inf`` for a lower one."""
    return np.array([infinity if value is None else value for value in values], dtype=float)


def _converted(content: Content) -> Content:
    """Content of layout `SCHEMA`. What an early version did not know stays out."""
    if content.meta["schema"] == SCHEMA:
        return content
    arrays = dict(content.arrays)
    arrays["trunk_angular_velocity"] = rotate(conjugate(arrays["trunk_quaternion"]), arrays["trunk_angular_velocity"])
    return Content({**content.meta, "schema": SCHEMA}, content.model_xml, arrays, content.assets)


def _opened(path: Path) -> dict[str, Array]:
    if path.is_dir():
        raise LevadeError(f"{path}: is a directory; give the motion.npz in it: {path / 'motion.npz'}")
    try:
        # opened here: of a file that is damaged, numpy would leave its own handle open
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except FileNotFoundError:
        raise LevadeError(f"{path}: no such file; give the motion.npz that levade solve wrote") from None
    except _UNREADABLE:
        raise LevadeError(f"{path}: cannot be read as a motion; damaged, or not a motion.npz of levade solve") from None


def _meta(path: Path, text: Array) -> dict[str, Any]:
    try:
        meta = json.loads(str(text))
        schema = meta["schema"]
    except (ValueError, TypeError, KeyError):
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


def _check_feedback(path: Path, meta: Any, content: Mapping[str, Array]) -> None:
    lacking = [
        *(name for name in FEEDBACK_ARRAYS if name not in content),
        *(f"meta.feedback.{key}" for key in FEEDBACK_META if not isinstance(meta, dict) or key not in meta),
    ]
    if lacking:
        raise LevadeError(f"{path}: its stabiliser lacks {', '.join(lacking[:3])}; stabilise the motion again")
    joints = len(content["joint_names"])
    sizes = {"joints": joints, "sensed": 6 + 2 * joints, "columns": 6 + 3 * joints}
    _check_arrays(path, content, FEEDBACK_ARRAYS, sizes)


def _check_numbers(path: Path, content: Mapping[str, Array]) -> None:
    for name in _floating(content):
        if not np.isfinite(content[name]).all():
            raise LevadeError(f"{path}: {name} has values that are no numbers; the file is damaged")


def _floating(content: Mapping[str, Array]) -> Iterator[str]:
    return (name for name in ARRAYS if content[name].dtype.kind == "f")


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
