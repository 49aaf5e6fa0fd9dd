"""Trials of different horizons: whatever looks at them sees of each what it would see of that trial alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.costs import (
    Criterion,
    Duration,
    Effort,
    GroundContact,
    JointLimitExcess,
    JointVelocity,
    LinearVelocity,
    Margins,
    Measure,
    Miss,
    Orientation,
    Position,
    Posture,
    ReferenceLimitExcess,
    SpeedLimitExcess,
    TorqueLimitExcess,
    evaluate,
)
from levade.trajectory import Trajectories

TERMS = {
    "effort": Effort(normalised=False),
    "effort with the hold": Effort(normalised=False, over="all"),
    "range": JointLimitExcess(over="all"),
    "reference": ReferenceLimitExcess(),
    "torque": TorqueLimitExcess(),
    "speed": SpeedLimitExcess(),
    "contact": GroundContact(("trunk", "hip"), measure="impulse", over="all"),
    "blow": GroundContact(("trunk", "hip"), measure="peak"),
    "margins": Margins(angle=0.1, speed=0.2),
    "at the horizon": Position(x=0.1, z=0.5),
    "at the end": Orientation(pitch=0.2, at="end"),
    "in the hold": LinearVelocity(x=0.0, z=1.0, at="hold"),
    "posture": Posture((0.1,) * 12, at="hold"),
    "still": JointVelocity(at="end"),
    "through the motion": Miss("height", minimum=0.3, at="motion"),
    "apex": Miss("height", target=2.0, at="max"),
    "duration": Duration(),
}
CRITERIA = {
    "horizon": Criterion("pitch", target=0.1, tolerance=0.1),
    "lowest": Criterion("height", minimum=-1.0, at="min"),
    "highest": Criterion("speed", maximum=2.0, at="max"),
    "hold": Criterion("tilt", maximum=0.5, at="hold"),
    "duration": Criterion("duration", maximum=0.02),
}


@pytest.fixture(scope="module")
def together(make) -> Trajectories:
    """Four trials that begin together, with horizons of 20, 7, 13 and 20 steps, and a hold of 5."""
    made = make(n=4, steps=20, hold_steps=5)
    return replace(made, reference=replace(made.reference, horizons=np.array([20, 7, 13, 20])))


@pytest.fixture(scope="module")
def aligned(together: Trajectories) -> Trajectories:
    return together.aligned(np.arange(4))


def cut(together: Trajectories, trial: int) -> Trajectories:
    """A trial as it would be alone: its first rows, up to the end of its own hold."""
    assert together.reference.horizons is not None
    steps = int(together.reference.horizons[trial])
    one = together[trial : trial + 1]
    arrays = {
        name: getattr(one, name)[:, : steps + 5]
        for name in (
            *("joint_position", "joint_velocity", "joint_torque", "trunk_position", "trunk_quaternion"),
            *("trunk_linear_velocity", "trunk_angular_velocity"),
        )
    }
    reference = replace(
        one.reference,
        position=one.reference.position[:, : steps + 5],
        velocity=one.reference.velocity[:, : steps + 5],
        horizon_steps=steps,
        horizons=None,
    )
    forces = {body: force[:, : steps + 5] for body, force in one.body_contact_force.items()}
    return replace(one, **arrays, reference=reference, horizon_steps=steps, body_contact_force=forces)


@pytest.mark.parametrize("name", TERMS)
def test_a_term_of_each_trial_is_that_of_the_trial_alone(
    together: Trajectories, aligned: Trajectories, name: str
) -> None:
    alone = [TERMS[name](cut(together, trial))[0] for trial in range(4)]
    np.testing.assert_allclose(TERMS[name](aligned), alone, rtol=1e-13)


@pytest.mark.parametrize("name", CRITERIA)
def test_a_criterion_of_each_trial_is_that_of_the_trial_alone(
    together: Trajectories, aligned: Trajectories, name: str
) -> None:
    judged = [CRITERIA[name].judge(cut(together, trial)) for trial in range(4)]
    for i, values in enumerate(CRITERIA[name].judge(aligned)):
        np.testing.assert_array_equal(values, [one[i][0] for one in judged])


OWN = {
    "sum": lambda t: np.square(t.joint_torque).sum(axis=(1, 2)) * t.timestep,
    "rows": lambda t: np.full(t.n, float(t.steps)),
    "horizon": lambda t: t.trunk_position[:, t.horizon_steps - 1, 2],
    "moved": lambda t: t.trunk_position[:, -1, 0] - t.trunk_position[:, 0, 0],
}
RISEN = Measure("risen", "m", lambda t, rows: np.cumsum(np.abs(t.trunk_position[..., 2]), axis=1)[:, rows])


@pytest.mark.parametrize("name", OWN)
def test_a_function_of_ones_own_sees_each_trial_alone(together: Trajectories, aligned: Trajectories, name: str) -> None:
    alone = [OWN[name](cut(together, trial))[0] for trial in range(4)]
    np.testing.assert_array_equal(evaluate({"own": OWN[name]}, aligned)["own"], alone)


@pytest.mark.parametrize("at", ["horizon", "end", "max", "min", "hold"])
def test_a_measure_of_ones_own_sees_each_trial_alone(together: Trajectories, aligned: Trajectories, at: str) -> None:
    criterion = Criterion(RISEN, target=0.1, tolerance=0.1, at=at)  # type: ignore[arg-type]
    alone = [criterion.error(cut(together, trial))[0] for trial in range(4)]
    np.testing.assert_array_equal(criterion.error(aligned), alone)


def test_one_of_them_alone_has_its_own_rows(together: Trajectories, aligned: Trajectories) -> None:
    for trial in range(4):
        one, expected = aligned.alone(trial), cut(together, trial)
        assert (one.horizon_steps, one.steps, one.begin) == (expected.horizon_steps, expected.steps, None)
        np.testing.assert_array_equal(one.joint_torque, expected.joint_torque)
        np.testing.assert_array_equal(one.reference.position, expected.reference.position)
        np.testing.assert_array_equal(one.body_contact_force["hip"], expected.body_contact_force["hip"])


def test_aligning_puts_trials_in_the_order_asked_for(together: Trajectories) -> None:
    moved = together.aligned(np.array([2, 0]))
    assert moved.begin is not None
    assert moved.begin.tolist() == [7, 0]
    np.testing.assert_array_equal(moved.joint_position[0, 7:], together.joint_position[2, :18])
    assert (moved.joint_position[0, :7] == together.joint_position[2, 0]).all()
    np.testing.assert_allclose(moved.horizon, [0.026, 0.04])
