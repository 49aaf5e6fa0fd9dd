"""The result: a motion in one self-contained file, which anyone with only mujoco and numpy can replay.

    motion.save("motion.npz")
    motion = Motion.load("motion.npz")
    motion.meta["success"], motion["joint_position"]          # (steps, joints) [rad]

What is in the file is documented in docs/motion-file.md. Replaying it needs none of levade:

    data = np.load("motion.npz")
    assets = {name[6:]: data[name].tobytes() for name in data if name.startswith("asset:")}
    model = mujoco.MjModel.from_xml_string(str(data["model_xml"]), assets)
    state = mujoco.MjData(model)
    state.qpos[:], state.qvel[:], state.act[:] = data["qpos0"], data["qvel0"], data["act0"]
    for ctrl in data["ctrl"]:
        state.ctrl[:] = ctrl
        mujoco.mj_step(model, state)
"""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.table import engine_kind
from levade.errors import LevadeError
from levade.feedback import ARRAYS as FEEDBACK_ARRAYS
from levade.feedback import META as FEEDBACK_META
from levade.feedback import Feedback
from levade.feedback import names as sensed_names

SCHEMA = 1
"""Version of the file's layout; raised when a reader of the old one would be wrong."""

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
"""Array -> shape, by name of the dimension. Beside these: ``meta`` and ``model_xml``, texts, and ``asset:NAME``,
bytes.
"""

LATER_ARRAYS: dict[str, tuple[str, ...]] = {"joint_position_reference0": ("joints",)}
"""Arrays that files of earlier versions lack."""


META = (
    *(
        "schema",
        "task",
        "robot",
        "trunk",
        "legs",
        "limits",
        "trunk_com_offset",
        "engine",
        "versions",
        "seed",
        "timestep",
    ),
    *("horizon", "horizon_steps", "success", "diverged", "errors", "cost", "cost_terms", "trials", "trials_to_success"),
    "stopped",
)
"""Keys of ``meta``."""

LATER = ("cost_weights", "held", "model_joints")
"""Keys of ``meta`` that files of earlier versions lack. ``feedback`` is there if the motion has a stabiliser."""

# what numpy and zipfile raise for files that are damaged, or something else
_UNREADABLE = (
    *(OSError, ValueError, EOFError, AttributeError, TypeError, LookupError, RuntimeError, MemoryError, SyntaxError),
    *(zipfile.BadZipFile, zlib.error),
)


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion: what was sent to the actuators, what the robot then did, and the model that says so.

    meta: schema, task (resolved), robot, engine and library versions, seed, success, errors, cost, trials, limits, and
    cost_weights, those of the cost, which differ from the task's where they were changed on the way.
    arrays: see `ARRAYS`; rows as in `levade.trajectory`. assets: files that the model needs.
    """

    meta: Mapping[str, Any]
    model_xml: str
    arrays: Mapping[str, Array]
    assets: Mapping[str, bytes]

    def __getitem__(self, name: str) -> Array:
        return self.arrays[name]

    @property
    def horizon_steps(self) -> int:
        """Rows up to the horizon; later ones are the hold."""
        return int(self.meta["horizon_steps"])

    @property
    def feedback(self) -> Feedback | None:
        """The stabiliser, if the motion has one; what is recorded is the motion without disturbance, where it does nothing."""
        meta = self.meta.get("feedback")
        return None if meta is None else Feedback.of(meta, self.arrays)

    def compiled(self) -> mujoco.MjModel:
        """The model. Raises LevadeError if MuJoCo does not take it, or the arrays are not of it."""
        try:
            model = mujoco.MjModel.from_xml_string(self.model_xml, dict(self.assets))
        except ValueError as error:
            what = " ".join(str(error).split())
            raise LevadeError(
                f"motion: MuJoCo {mujoco.__version__} does not take its model: {what}; the file is damaged"
            ) from None
        for name, size in (("qpos0", model.nq), ("qvel0", model.nv), ("act0", model.na), ("ctrl", model.nu)):
            if self[name].shape[-1] != size:
                raise LevadeError(
                    f"motion: {name} has {self[name].shape[-1]} numbers, its model {size}; the file is damaged"
                )
        return model

    def stabilised(self, feedback: Feedback | None, **about: Any) -> Motion:
        """The same motion with a stabiliser, or without. about: what its meta says beside what it is."""
        arrays = {name: self.arrays[name] for name in (*ARRAYS, *LATER_ARRAYS) if name in self.arrays}
        meta = {key: value for key, value in self.meta.items() if key != "feedback"}
        if feedback is not None:
            arrays |= feedback.arrays()
            meta["feedback"] = {
                "rate": 1.0 / feedback.period,
                "period_steps": feedback.steps(float(meta["timestep"])),
                "latency": feedback.period,
                "bound": feedback.bound,
                "sensed": sensed_names(self["joint_names"].tolist()),
                **about,
            }
        return Motion(meta, self.model_xml, arrays, self.assets)

    def save(self, path: str | Path) -> None:
        """Write the file, or leave the one that is there: it is written beside it first. Raises OSError."""
        path = Path(path)
        content: dict[str, Any] = {
            "meta": np.array(json.dumps(self.meta, ensure_ascii=False)),
            "model_xml": np.array(self.model_xml),
            **self.arrays,
            **{f"asset:{name}": np.frombuffer(data, dtype=np.uint8) for name, data in self.assets.items()},
        }
        partial = path.with_name(f".{path.name}.partial")
        try:
            with partial.open("wb") as file:
                np.savez_compressed(file, **content)
                file.flush()
                os.fsync(file.fileno())
            partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)

    @classmethod
    def load(cls, path: str | Path) -> Motion:
        """The motion in a file. Raises LevadeError if it is missing, damaged, or something else."""
        path = Path(path)
        if path.is_dir():
            raise LevadeError(f"{path}: is a directory; give the motion.npz in it: {path / 'motion.npz'}")
        try:
            # opened here: of a file that is damaged, numpy would leave its own handle open
            with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
                content = {name: file[name] for name in file.files}
        except FileNotFoundError:
            raise LevadeError(f"{path}: no such file; give the motion.npz that levade solve wrote") from None
        except _UNREADABLE:
            raise LevadeError(
                f"{path}: cannot be read as a motion; damaged, or not a motion.npz of levade solve"
            ) from None
        missing = [name for name in ("meta", "model_xml", *ARRAYS) if name not in content]
        if missing:
            raise LevadeError(
                f"{path}: not a motion file, {', '.join(missing[:3])} missing; give a motion.npz of levade solve"
            )
        try:
            meta = json.loads(str(content["meta"]))
            schema = meta["schema"]
        except (ValueError, TypeError, KeyError):
            raise LevadeError(
                f"{path}: its meta cannot be read; damaged, or not a motion.npz of levade solve"
            ) from None
        if schema != SCHEMA and isinstance(schema, int):
            raise LevadeError(
                f"{path}: layout {schema}, but this levade reads layout {SCHEMA}; use the levade that wrote it"
            )
        lacking = [key for key in META if key not in meta]
        if lacking or schema != SCHEMA:
            raise LevadeError(
                f"{path}: its meta lacks {', '.join(lacking[:3]) or 'a schema'}; not made by levade solve"
            )
        _check_shapes(path, content)
        if not meta["diverged"]:
            _check_numbers(path, content)
        if "feedback" in meta:
            _check_feedback(path, meta["feedback"], content)
        assets = {name[6:]: content[name].tobytes() for name in content if name.startswith("asset:")}
        later = (name for name in LATER_ARRAYS if name in content)
        kept = [*ARRAYS, *later, *(FEEDBACK_ARRAYS if "feedback" in meta else ())]
        return cls(meta, str(content["model_xml"]), {name: content[name] for name in kept}, assets)


def meets(meta: Mapping[str, Any], name: str) -> bool:
    """Whether the motion meets a criterion of its task on the model, by the numbers in its file."""
    return abs(meta["errors"][name]) <= (meta["task"]["success"][name]["tolerance"] or 0.0)


def met_on_the_model_only(meta: Mapping[str, Any]) -> bool:
    """Whether it meets every criterion on the model and still is no success: one of a robust search."""
    return not (meta["success"] or meta["diverged"]) and all(meets(meta, name) for name in meta["task"]["success"])


def cost_weights(meta: Mapping[str, Any]) -> dict[str, float]:
    """Cost -> the weight that a motion's ``meta["cost"]`` has it with: the task's, unless changed on the way."""
    return meta.get("cost_weights") or {name: cost["weight"] for name, cost in meta["task"]["costs"].items()}


def versions(engine: str = "mujoco") -> dict[str, str]:
    """The versions that decide a motion's bits; MuJoCo's too with another engine, which reads the model from it."""
    return dict(_versions(engine))


@cache
def _versions(engine: str) -> dict[str, str]:
    from importlib.metadata import version

    from levade import __version__

    made = {"levade": __version__, **{name: version(name) for name in ("mujoco", "numpy", "cma")}}
    return made | engine_kind(engine).versions()


def finite(limit: Array) -> list[float | None]:
    """JSON has no infinity: None where there is no limit."""
    return [float(value) if np.isfinite(value) else None for value in limit]


def _check_shapes(path: Path, content: Mapping[str, Array]) -> None:
    """Every array has as many dimensions as it should, and dimensions of one name agree."""
    later = {name: shape for name, shape in LATER_ARRAYS.items() if name in content}
    _check_arrays(path, content, {**ARRAYS, **later}, {"3": 3, "4": 4})


def _check_feedback(path: Path, meta: Any, content: Mapping[str, Array]) -> None:
    lacking = [
        *(name for name in FEEDBACK_ARRAYS if name not in content),
        *(f"meta.feedback.{key}" for key in FEEDBACK_META if not isinstance(meta, dict) or key not in meta),
    ]
    if lacking:
        raise LevadeError(f"{path}: its stabiliser lacks {', '.join(lacking[:3])}; stabilise the motion anew")
    joints = len(content["joint_names"])
    _check_arrays(
        path, content, FEEDBACK_ARRAYS, {"joints": joints, "sensed": 6 + 2 * joints, "columns": 6 + 3 * joints}
    )


def _check_numbers(path: Path, content: Mapping[str, Array]) -> None:
    for name in ARRAYS:
        if content[name].dtype.kind == "f" and not np.isfinite(content[name]).all():
            raise LevadeError(f"{path}: {name} has values that are no numbers; the file is damaged")


def _check_arrays(
    path: Path, content: Mapping[str, Array], arrays: Mapping[str, tuple[str, ...]], sizes: dict[str, int]
) -> None:
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
