"""The form of a motion file's ``meta``: types of its keys, and how they fit each other and the arrays.

    check(meta, arrays)         # raises LevadeError: "meta.limits.torque: ..."

docs/motion-file.md explains the keys. Unknown keys are accepted, because later versions have more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from levade.arrays import Array
from levade.document import first_mistake, hides
from levade.errors import LevadeError
from levade.policies import policy_from_dict

_CLOSE = 1e-6
"""Largest relative difference between two values of the same number."""

_DEEPEST = 50


def _shown(name: str) -> str:
    if hides(name):
        raise ValueError("should be a name without control characters")
    return name


Name = Annotated[str, AfterValidator(_shown)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Timestep = Annotated[float, Field(ge=1e-9, le=1e3)]
Count = Annotated[int, Field(ge=0)]
Index = Annotated[int, Field(ge=0, le=10_000)]
Steps = Annotated[int, Field(ge=1, le=10_000_000)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]
PerJoint = list[Positive | None]


class _Form(BaseModel):
    model_config = ConfigDict(defer_build=True, extra="ignore", frozen=True, strict=True)


class GeometryForm(_Form):
    """See `levade.embodiment.LegGeometry`."""

    anchors: list[Vector]
    axes: list[Vector]
    foot: Vector
    sole: Number


class LegForm(_Form):
    """A limb: its joints from the trunk outward, its foot's geom, all geoms of the sole, and its kind (`levade.robots.Leg`)."""

    joints: Annotated[list[Name], Field(min_length=1)]
    foot: Name
    side: Name = ""
    end: Name = ""
    kind: Literal["leg", "arm", "waist", "head"] = "leg"
    pads: list[Name] = []
    geometry: GeometryForm | None = None


class CurveForm(_Form):
    """See `levade.embodiment.TorqueCurve`."""

    peak: Number
    rate: Number
    centre: Number


class LimitsForm(_Form):
    """Limits in joint order; None for no limit."""

    lower: list[Number | None]
    upper: list[Number | None]
    velocity: PerJoint
    torque: PerJoint
    stall_torque: PerJoint | None = None
    no_load_speed: PerJoint | None = None
    torque_curves: dict[Annotated[str, Field(pattern=r"^\d{1,4}$")], CurveForm] = {}
    assumed_velocity: list[Index] = []
    assumed_torque: list[Index] = []


class FollowerForm(_Form):
    """See `levade.policies.Follower`."""

    joints: list[Index]
    signs: list[Number]


class GroupForm(_Form):
    """See `levade.policies.Group`."""

    leader: list[Index]
    followers: list[FollowerForm]


class EndsForm(_Form):
    """See `levade.policies.Ends`."""

    start: list[Number]
    goal: list[Number]
    depart: Number
    settle: Number


class SlewForm(_Form):
    """See `levade.policies.Slew`."""

    speed: list[Positive | None]
    start: list[Number]


class PolicyForm(_Form):
    """See `levade.policies.policy_to_dict`."""

    kernels: Annotated[int, Field(ge=1, le=10_000)]
    variance: Positive
    time: Literal["normalised", "seconds"]
    groups: list[GroupForm]
    horizon: Positive
    timestep: Timestep
    hold_steps: Annotated[int, Field(ge=0, le=10_000_000)]
    ends: EndsForm | None
    within: Annotated[list[list[Number | None]], Field(min_length=2, max_length=2)] | None = None
    slew: SlewForm | None = None


class FeedbackForm(_Form):
    """Describes a stabiliser."""

    rate: Annotated[float, Field(ge=1e-3, le=1e9)]
    period_steps: Steps
    bound: NotNegative
    sensed: list[Name]


class TaskForm(_Form):
    """Keys of the task that are used as they are in the file. `levade.tasks.task_from_dict` reads the rest on demand."""

    name: Name
    costs: dict[Name, dict[str, Any]]
    success: dict[Name, dict[str, Any]]


class MetaForm(_Form):
    """The whole ``meta``. Numbers of a trial that diverged may be NaN."""

    task: TaskForm
    robot: Name
    trunk: Name
    legs: Annotated[dict[Name, LegForm], Field(min_length=1)]
    limits: LimitsForm
    trunk_com_offset: Vector
    trunk_balls: list[Annotated[list[Number], Field(min_length=4, max_length=4)]] = []
    held: dict[Name, Number] = {}
    model_joints: list[Name] = []
    policy: PolicyForm | None = None
    engine: Name
    versions: dict[Name, Name]
    seed: Count
    initial: Count = 0
    timestep: Timestep
    horizon: Positive
    horizon_steps: Steps
    success: bool
    diverged: bool
    errors: dict[Name, float]
    values: dict[Name, Number] = {}
    cost: float
    cost_weights: dict[Name, Number] | None = None
    cost_terms: dict[Name, float]
    trials: Count
    trials_to_success: Count | None
    stopped: Name
    feedback: FeedbackForm | None = None


def check(meta: Mapping[str, Any], arrays: Mapping[str, Array]) -> None:
    """Check a file's ``meta``, and that it fits the arrays, whose own shapes fit each other.

    Args:
        meta: The JSON.
        arrays: The arrays.

    Raises:
        LevadeError: For the first mistake.
    """
    _check_texts(meta)
    try:
        form = MetaForm.model_validate(meta)
    except ValidationError as error:
        raise LevadeError(f"meta.{first_mistake(error)}") from None
    for mistake in _mistakes(form, arrays):
        raise LevadeError(mistake)
    if form.policy is not None:
        _check_policy(form, meta["policy"], arrays)


def _check_texts(content: Any) -> None:
    """Raise LevadeError for keys and texts with control characters. A text may have several lines."""
    waiting = [(content, 0)]
    while waiting:
        value, depth = waiting.pop()
        if depth > _DEEPEST:
            raise LevadeError(f"meta: nested more than {_DEEPEST} levels deep")
        if isinstance(value, str) and hides(value.replace("\n", " ").replace("\t", " ")):
            raise LevadeError(f"meta: the text {value[:40]!r} holds control characters")
        if isinstance(value, dict):
            if any(map(hides, value)):
                raise LevadeError("meta: a key holds control characters")
            waiting += [(inner, depth + 1) for inner in value.values()]
        elif isinstance(value, list):
            waiting += [(inner, depth + 1) for inner in value]


def _mistakes(form: MetaForm, arrays: Mapping[str, Array]) -> Iterator[str]:
    """Yield what does not fit, in words."""
    names = [str(name) for name in arrays["joint_names"]]
    joints, steps = len(names), len(arrays["time"])
    if not joints or not steps:
        yield f"joint_names and time have {joints} joints and {steps} steps; a motion has at least one of each"
    if len(set(names)) < joints or any(map(hides, names)):
        yield "joint_names: names that are there twice, or hold control characters"
    yield from _mistakes_in_time(form, arrays["time"])
    yield from _mistakes_in_limits(form.limits, joints)
    yield from _mistakes_in_joints(form, names, feet=arrays["foot_contact_force"].shape[1])
    yield from _mistakes_in_numbers(form)
    if form.feedback is not None and len(form.feedback.sensed) != 6 + 2 * joints:
        yield f"meta.feedback.sensed: {len(form.feedback.sensed)} names; should be {6 + 2 * joints}"
    if form.feedback is not None and not _close(form.feedback.period_steps * form.timestep, 1 / form.feedback.rate):
        yield f"meta.feedback: {form.feedback.period_steps} steps are not a period at {form.feedback.rate:g} Hz"


def _mistakes_in_joints(form: MetaForm, names: list[str], *, feet: int) -> Iterator[str]:
    """Yield what does not fit in legs and joints.

    Args:
        form: The form.
        names: The arrays' joints.
        feet: Number of feet in the arrays.
    """
    if len(form.legs) != feet:
        yield f"foot_contact_force has {feet} feet, meta.legs has {len(form.legs)}"
    for name, leg in form.legs.items():
        shape = leg.geometry
        if shape is not None and not len(shape.anchors) == len(shape.axes) == len(leg.joints):
            yield f"meta.legs.{name}.geometry: should have an anchor and an axis for each of {len(leg.joints)} joints"
    of_legs = [joint for leg in form.legs.values() for joint in leg.joints]
    if len(set(of_legs)) < len(of_legs) or set(of_legs) != set(names):
        yield "meta.legs: should have each of joint_names in one leg"
    if form.model_joints and not set(form.model_joints) <= {*names, *form.held}:
        yield "meta.model_joints: has joints that are neither in joint_names nor in meta.held"


def _mistakes_in_numbers(form: MetaForm) -> Iterator[str]:
    """Yield what does not fit in errors, costs and their weights."""
    if missing := set(form.task.success) - set(form.errors):
        yield f"meta.errors: lacks {min(missing)!r}, a criterion of the task"
    numbers = [form.cost, *form.errors.values(), *form.cost_terms.values()]
    if not form.diverged and not np.isfinite(numbers).all():
        yield "meta: cost, cost_terms or errors are no numbers, and the motion has not diverged"
    weights = form.cost_weights or {
        name: cost["weight"] for name, cost in form.task.costs.items() if _is_number(cost.get("weight"))
    }
    if missing := set(form.cost_terms) - set(weights):
        yield f"meta.cost_terms: {min(missing)!r} has no weight"


def _mistakes_in_time(form: MetaForm, time: Array) -> Iterator[str]:
    if form.horizon_steps > len(time):
        yield f"meta.horizon_steps: {form.horizon_steps}, but time has {len(time)} steps"
    if not _close(form.horizon_steps * form.timestep, form.horizon):
        yield f"meta.horizon: {form.horizon:g} s, but {form.horizon_steps} steps are of {form.timestep:g} s"
    expected = np.arange(1, len(time) + 1) * form.timestep
    if not np.allclose(time, expected, rtol=_CLOSE, atol=0.0):
        yield f"time: should be multiples of meta.timestep, {form.timestep:g} s"


def _mistakes_in_limits(limits: LimitsForm, joints: int) -> Iterator[str]:
    for name in ("lower", "upper", "velocity", "torque", "stall_torque", "no_load_speed"):
        values = getattr(limits, name)
        if values is not None and len(values) != joints:
            yield f"meta.limits.{name}: {len(values)} numbers for {joints} joints"
    pairs = zip(limits.lower, limits.upper, strict=False)
    if any(low is not None and high is not None and low > high for low, high in pairs):
        yield "meta.limits: a lower limit is above its upper one"
    given = limits.model_fields_set
    if ("stall_torque" in given) != ("no_load_speed" in given):
        yield "meta.limits: has one of stall_torque and no_load_speed; should have both or neither"
    for joint in limits.torque_curves:
        if int(joint) >= joints:
            yield f"meta.limits.torque_curves: no joint {joint}; there are {joints}"
    for name in ("assumed_velocity", "assumed_torque"):
        for joint in getattr(limits, name):
            if joint >= joints:
                yield f"meta.limits.{name}: no joint {joint}; there are {joints}"


def _check_policy(form: MetaForm, content: Mapping[str, Any], arrays: Mapping[str, Array]) -> None:
    assert form.policy is not None
    steps = max(1.0, form.policy.horizon / form.policy.timestep)
    if abs(steps - form.horizon_steps) > 0.5 + _CLOSE or not _close(form.policy.timestep, form.timestep):
        raise LevadeError(
            f"meta.policy: {form.policy.horizon:g} s in steps of {form.policy.timestep:g} s, the motion has"
            f" {form.horizon_steps} of {form.timestep:g} s"
        )
    try:
        policy = policy_from_dict(content)
    except LevadeError as error:
        raise LevadeError(f"meta.policy: {error}") from None
    joints, weights = len(arrays["joint_names"]), len(arrays["weights"])
    if policy.joints != joints:
        raise LevadeError(f"meta.policy: is for {policy.joints} joints, joint_names has {joints}")
    if policy.size != weights:
        raise LevadeError(f"meta.policy: takes {policy.size} weights, there are {weights}")


def _close(one: float, other: float) -> bool:
    return abs(one - other) <= _CLOSE * max(abs(one), abs(other))


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
