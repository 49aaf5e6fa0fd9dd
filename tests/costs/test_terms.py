"""Each term against its equation, written out trial by trial and step by step."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from levade.costs import (
    AngularVelocity,
    Effort,
    GroundContact,
    JointLimitExcess,
    JointVelocity,
    LinearVelocity,
    Margins,
    Orientation,
    Position,
    Posture,
    ReferenceLimitExcess,
    SpeedLimitExcess,
    TorqueLimitExcess,
)
from levade.embodiment import JointLimits, TorqueCurve
from levade.errors import LevadeError
from levade.rotations import rotation_matrix
from levade.trajectory import Trajectories

DT = 0.002
POSTURE = tuple(None if i == 4 else 0.1 * i for i in range(12))

RUNNING = {
    "raw effort": (Effort(normalised=False), lambda t, i, k, j: t.joint_torque[i, k, j] ** 2),
    "joint limits": (JointLimitExcess(), lambda t, i, k, j: beyond(t, t.joint_position[i, k, j], j)),
    "reference limits": (ReferenceLimitExcess(), lambda t, i, k, j: beyond(t, t.reference.position[i, k, j], j)),
    "speed limits": (
        SpeedLimitExcess(),
        lambda t, i, k, j: max(0.0, abs(t.joint_velocity[i, k, j]) / t.limits.velocity[j] - 1) ** 2,
    ),
    "torque limits": (
        TorqueLimitExcess(),
        lambda t, i, k, j: max(0.0, abs(t.joint_torque[i, k, j]) / torque_limit(t, i, k, j) - 1) ** 2,
    ),
}


def with_limits(trajectories: Trajectories, limits: JointLimits) -> Trajectories:
    """The same trajectories of a robot with other limits."""
    return dataclasses.replace(trajectories, embodiment=dataclasses.replace(trajectories.embodiment, limits=limits))


def beyond(t, angle, j):
    if angle > t.limits.upper[j]:
        return (angle - t.limits.upper[j]) ** 2
    if angle < t.limits.lower[j]:
        return (angle - t.limits.lower[j]) ** 2
    return 0.0


def torque_limit(t, i, k, j):
    if j != 2:
        return t.limits.torque[j]
    return max(0.0, 110 * math.cos(0.727 * (abs(t.joint_position[i, k, j]) - 1.475)))


@pytest.mark.parametrize("over", ["horizon", "all"])
@pytest.mark.parametrize("name", RUNNING)
def test_running_terms_are_the_sum_over_steps_and_joints(make, name, over):
    t = make()
    term, rate = RUNNING[name]
    rows = 20 if over == "horizon" else 25
    expected = [sum(rate(t, i, k, j) * DT for k in range(rows) for j in range(12)) for i in range(3)]
    assert min(expected) > 0
    np.testing.assert_allclose(dataclasses.replace(term, over=over)(t), expected, rtol=1e-12)


def test_effort_is_one_second_per_joint_that_works_at_its_limit_for_a_second(make):
    torque = np.array([100.0, 250.0])
    limits = JointLimits(np.full(2, -1.0), np.full(2, 1.0), np.full(2, 12.0), torque)
    t = make(1, 500, 0, limits=limits, joint_torque=np.tile(torque * [1, -1], (1, 500, 1)))
    np.testing.assert_allclose(Effort()(t), 2.0)


def centre_of_mass(t, i, k):
    """Position and velocity of the trunk's centre of mass, from the rotation matrix."""
    R, offset = rotation_matrix(t.trunk_quaternion[i, k]), t.trunk_com_offset
    spin = np.cross(R @ t.trunk_angular_velocity[i, k], R @ offset)
    return t.trunk_position[i, k] + R @ offset, t.trunk_linear_velocity[i, k] + spin


def heading(t, i, k):
    """Turned about z only, as far as the trunk's x axis points."""
    R = rotation_matrix(t.trunk_quaternion[i, k])
    forward = np.array([R[0, 0], R[1, 0], 0.0]) / np.hypot(R[0, 0], R[1, 0])
    return np.stack([forward, np.cross([0.0, 0.0, 1.0], forward), [0.0, 0.0, 1.0]], axis=1)


TERMINAL = {
    "position": (Position(x=0.5, z=0.9), lambda t, i, k: squares(centre_of_mass(t, i, k)[0], (0.5, None, 0.9))),
    "height": (Position(z=0.61), lambda t, i, k: squares(centre_of_mass(t, i, k)[0], (None, None, 0.61))),
    "velocity": (LinearVelocity(0.0, 0.0, 1.0), lambda t, i, k: squares(centre_of_mass(t, i, k)[1], (0, 0, 1.0))),
    "spin": (AngularVelocity(y=-2.0), lambda t, i, k: squares(t.trunk_angular_velocity[i, k], (None, -2.0, None))),
    "forward": (
        LinearVelocity(0.5, 0.0, frame="heading"),
        lambda t, i, k: squares(heading(t, i, k).T @ centre_of_mass(t, i, k)[1], (0.5, 0, None)),
    ),
    "along the trunk": (
        LinearVelocity(x=0.5, frame="trunk"),
        lambda t, i, k: squares(
            rotation_matrix(t.trunk_quaternion[i, k]).T @ centre_of_mass(t, i, k)[1], (0.5, None, None)
        ),
    ),
    "spin in the world": (
        AngularVelocity(z=1.0, frame="world"),
        lambda t, i, k: squares(
            rotation_matrix(t.trunk_quaternion[i, k]) @ t.trunk_angular_velocity[i, k], (None, None, 1.0)
        ),
    ),
    "roll rate of the heading": (
        AngularVelocity(x=1.0, y=0.0, frame="heading"),
        lambda t, i, k: squares(
            heading(t, i, k).T @ rotation_matrix(t.trunk_quaternion[i, k]) @ t.trunk_angular_velocity[i, k],
            (1.0, 0, None),
        ),
    ),
    "two joints": (
        JointVelocity(velocity=(3.0, *[None] * 10, -2.0)),
        lambda t, i, k: squares(t.joint_velocity[i, k], (3.0, *[None] * 10, -2.0)),
    ),
    "nearly at rest": (
        JointVelocity(tolerance=5.0),
        lambda t, i, k: sum(max(0.0, abs(v) - 5.0) ** 2 for v in t.joint_velocity[i, k]),
    ),
    "nearly still": (
        LinearVelocity(0.0, 0.0, 0.0, tolerance=1.0),
        lambda t, i, k: max(0.0, np.linalg.norm(centre_of_mass(t, i, k)[1]) - 1.0) ** 2,
    ),
    "joint velocity": (JointVelocity(), lambda t, i, k: squares(t.joint_velocity[i, k], (0,) * 12)),
    "posture": (Posture(POSTURE), lambda t, i, k: squares(t.joint_position[i, k], POSTURE)),
}


def squares(values, target):
    return sum((v - g) ** 2 for v, g in zip(values, target, strict=True) if g is not None)


@pytest.mark.parametrize(("at", "rows"), [("horizon", [19]), ("end", [24]), ("hold", range(20, 25))])
@pytest.mark.parametrize("name", TERMINAL)
def test_terminal_terms_look_at_their_rows_only(make, name, at, rows):
    t = make()
    term, value = TERMINAL[name]
    expected = [np.mean([value(t, i, k) for k in rows]) for i in range(3)]
    np.testing.assert_allclose(dataclasses.replace(term, at=at)(t), expected, rtol=1e-12)


def test_contact_is_time_or_impulse_over_the_bodies(make):
    force = np.zeros((2, 25))
    force[0, 3:8], force[1, 22] = 50.0, 10.0
    t = make(2, body_contact_force={"trunk": force, "hip": 2 * force})
    np.testing.assert_allclose(GroundContact(("trunk",))(t), [5 * DT, 0])
    np.testing.assert_allclose(GroundContact(("trunk", "hip"), over="all")(t), [10 * DT, 2 * DT])
    np.testing.assert_allclose(GroundContact(("trunk", "hip"), "impulse")(t), [5 * 150 * DT, 0])
    np.testing.assert_allclose(GroundContact(("trunk", "hip"), "peak")(t), [100, 0])
    np.testing.assert_allclose(GroundContact(("trunk",), "peak", over="all")(t), [50, 10])
    force[1, 4] = np.nan  # a trial that broke down has no peak
    assert np.isnan(GroundContact(("trunk", "hip"), "peak")(t)).tolist() == [False, True]


def test_within_the_limits_nothing_is_exceeded(make):
    t = make()
    wide = JointLimits(*[s * np.full(12, 1e6) for s in (-1, 1, 1, 1)])
    none = JointLimits(*[s * np.full(12, np.inf) for s in (-1, 1, 1, 1)])
    for limits in (wide, none):
        free = with_limits(t, limits)
        for term in (JointLimitExcess(), ReferenceLimitExcess(), SpeedLimitExcess(), TorqueLimitExcess()):
            assert (term(free) == 0).all()


def test_where_the_linkage_transmits_nothing_the_torque_excess_stays_finite(make):
    curve = TorqueCurve(peak=100.0, rate=1.0, centre=0.0)
    limits = JointLimits(np.full(1, -3.0), np.full(1, 3.0), np.full(1, 12.0), np.full(1, np.inf), {0: curve})
    t = make(1, 1, 0, limits=limits, joint_position=np.full((1, 1, 1), 2.0), joint_torque=np.full((1, 1, 1), 3.0))
    np.testing.assert_allclose(TorqueLimitExcess()(t), (3.0 / 1.0 - 1) ** 2 * DT)


ALL = [
    *[term for term, _ in (RUNNING | TERMINAL).values()],
    *[dataclasses.replace(term, at="hold") for term, _ in TERMINAL.values()],
    Orientation(pitch=-1.0),
    Orientation(roll=0.0, yaw=1.0),
    Orientation(0.0, 0.0, 0.0, at="hold"),
    GroundContact(("trunk", "hip"), "impulse"),
    GroundContact(("trunk", "hip"), "peak"),
    Margins(angle=0.1, speed=0.1),
]


@pytest.mark.parametrize("term", ALL, ids=lambda term: type(term).__name__)
def test_a_trial_has_the_same_bits_alone_and_in_the_batch(make, term):
    t = make(19, 150, 50)
    batch = term(t)
    assert batch.shape == (19,)
    assert batch.dtype == np.float64
    for i in (0, 11, 18):
        alone = {
            field.name: value[i : i + 1]
            for field in dataclasses.fields(t)
            if isinstance(value := getattr(t, field.name), np.ndarray)
        }
        forces = {body: force[i : i + 1] for body, force in t.body_contact_force.items()}
        single = dataclasses.replace(t, **alone, reference=t.reference[i : i + 1], body_contact_force=forces)
        assert term(single)[0] == batch[i]


def test_the_terms_can_be_read_from_plain_data():
    """What tasks/ does at its YAML edge."""
    read = TypeAdapter(Orientation).validate_python({"pitch": -1.0472, "at": "hold"})
    assert read == Orientation(pitch=-1.0472, at="hold")
    assert TypeAdapter(GroundContact).validate_python({"bodies": ["trunk"]}) == GroundContact(("trunk",))
    assert TypeAdapter(Posture).validate_python({"position": [0.1, None]}) == Posture((0.1, None))
    with pytest.raises(ValidationError):
        TypeAdapter(Effort).validate_python({"over": "sometimes"})


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda t: Effort()(t), r"effort: joints \[11\] have no finite, positive torque limit .* normalised: false"),
        (lambda t: Position(), "position: no target; give at least one of x, y, z"),
        (lambda t: Position(x=math.inf), r"position\.x: inf is not finite"),
        (lambda t: LinearVelocity(), "linear_velocity: no target"),
        (lambda t: AngularVelocity(), "angular_velocity: no target"),
        (
            lambda t: AngularVelocity(x=0.0, frame="body"),
            "angular_velocity.frame: 'body' is unknown; valid names: heading, ",
        ),
        (lambda t: LinearVelocity(x=0.0, tolerance=-1.0), "linear_velocity.tolerance: -1.0 should be 0 or more"),
        (lambda t: JointVelocity(velocity=(None, None)), "joint_velocity: no target"),
        (lambda t: JointVelocity(velocity=(0.0,))(t), "joint_velocity.velocity: 1 speeds for a robot of 12 joints"),
        (lambda t: Posture((0.0, 1.0))(t), r"posture\.position: 2 angles for a robot of 12 joints"),
        (lambda t: GroundContact(()), "name those that should stay off the ground"),
        (lambda t: GroundContact(("trnk",))(t), "the contact force of trnk was not recorded; did you mean trunk"),
        (
            lambda t: GroundContact(("trunk",))(dataclasses.replace(t, body_contact_force={})),
            "no body's contact force was recorded",
        ),
        (lambda t: Position(z=1, at="later")(t), "at: 'later' is unknown; horizon, end or hold"),  # pyright: ignore
        (lambda t: Effort(over="later")(t), "over: 'later' is unknown; horizon or all"),  # pyright: ignore
        (
            lambda t: SpeedLimitExcess()(with_limits(t, dataclasses.replace(t.limits, velocity=np.zeros(12)))),
            "have no positive speed limit; give one, or inf for none",
        ),
    ],
)
def test_errors_say_what_would_be_right(make, call, message):
    with pytest.raises(LevadeError, match=message):
        call(make())


def test_a_hold_is_needed_to_look_at_it(make):
    with pytest.raises(LevadeError, match="at: hold, but the motion ends at its horizon"):
        Position(z=1.0, at="hold")(make(hold_steps=0))
