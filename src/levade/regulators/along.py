"""Make the regulators along one motion: its linear model and the estimates of unsensed values once, then gains per design."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.embodiment import Embodiment
from levade.engines import Models, MujocoEngine, State
from levade.feedback import Feedback, SensorErrors, period_steps
from levade.regulators.design import Design
from levade.regulators.linear import Linear, Scales, linearise, state_of
from levade.regulators.quadratic import expectation, project, steady, sweep
from levade.trajectory import JointReference

WEIGHED = Scales(attitude=0.03, height=0.03, speed=0.3, rate=1.0, joint=0.3, joint_speed=10.0, drive=math.inf)
"""Deviations that cost 1 each at the end, and a tenth on the way. They make different quantities comparable."""

_CAP = Scales(attitude=1 / 6, height=math.inf, speed=math.inf, rate=2.0, joint=1 / 4, joint_speed=20 / 3)
"""Gains are limited to 1 rad per this deviation: near a contact that opens or closes, the linear model holds for less."""

_LAST = 0.5
"""Largest gain of the correction in force."""

FADING = 0.1
"""Time constant with which corrections fade in a hold without feedback [s]."""

_NEAR = 0.2
"""Largest deviation of attitude in runs that are used for learning [rad]."""


@dataclass(frozen=True, eq=False)
class Along:
    """Holds what all regulators along one motion share.

    Attributes:
        linear: The motion's linear model.
        expected: Unsensed values per unit of sensed ones, shape (ticks of the linear model, states - sensed, sensed).
        period: Time between ticks [s].
        holds: Whether the motion has a hold after its horizon.
        size: Approximate standing height of the robot [m].
    """

    linear: Linear
    expected: Array
    period: float
    holds: bool
    size: float

    def feedback(self, design: Design) -> Feedback:
        """Compute the regulator of a design.

        Args:
            design: The design.

        Returns:
            The regulator, with the motion's sensed values as its reference.
        """
        return Feedback(self._gains(design), self.linear.reference, self.period, design.bound)

    def _gains(self, design: Design) -> Array:
        """Compute the gains, shape (gains, joints, sensed + joints)."""
        linear = self.linear
        a, b, last = linear.a, linear.b, []
        states, joints = b.shape[1:]
        weight = 1.0 / WEIGHED.sized(self.size).column(joints, linear.drives) ** 2
        moving = np.full(joints, design.motion**-2)
        value = np.zeros((states + joints, states + joints))
        value[:states, :states] = np.diag(weight)
        if self.holds:
            if design.hold is not None:
                gain, value = steady(a[-1], b[-1], 0.1 * weight, np.full(joints, design.hold**-2))
                last = [gain]
            a, b = a[:-1], b[:-1]
        gains, _ = sweep(a, b, 0.1 * weight, moving, value)
        width = 6 + 2 * joints
        whole = np.concatenate([gains, *(one[None] for one in last)])
        expected = self.expected[: len(whole)]
        projected = np.array([project(one, what, width) for one, what in zip(whole, expected, strict=True)])
        cap = 1.0 / _CAP.sized(self.size).column(joints, np.zeros(0))[:width]
        limit = np.concatenate([cap, np.full(joints, _LAST)])
        bounded = np.clip(projected, -limit, limit)
        if not self.holds or design.hold is not None:
            return bounded
        fading = np.zeros((1, joints, width + joints))
        fading[0, :, width:] = math.exp(-self.period / FADING) * np.eye(joints)
        return np.concatenate([bounded, fading])


def linearised(
    engine: MujocoEngine,
    start: State,
    reference: JointReference,
    *,
    perturbed: tuple[State, Models],
    rate: float,
    errors: SensorErrors | None = None,
    threads: int = 0,
) -> Along:
    """Linearise a motion, and learn estimates of unsensed values from perturbed runs of it.

    Args:
        engine: Simulates the motion.
        start: Start of the motion, one row.
        reference: Joint references of one trial.
        perturbed: Starts and models of the perturbed runs.
        rate: Measurements per second [Hz]; the nearest rate that steps allow.
        errors: Errors of the sensors. None for usual ones.
        threads: Number of threads (0: one per core). Results do not depend on it.

    Returns:
        The linear model with its estimates.
    """
    timestep, size = reference.timestep, size_of(engine.embodiment)
    period = period_steps(rate, timestep)
    linear = linearise(engine.model, engine.layout, start, reference, period=period, size=size, threads=threads)
    expected = _expectations(engine, reference, linear, perturbed, period, errors or SensorErrors())
    holds = reference.steps > reference.horizon_steps
    return Along(linear, expected, period * timestep, holds, size)


def size_of(embodiment: Embodiment) -> float:
    """Estimate how high a robot stands: 0.7 of its longest leg.

    Args:
        embodiment: The robot.

    Returns:
        The height [m]. It is 0.6 m if no leg is known.
    """
    lengths = [
        float(np.linalg.norm(np.diff(np.concatenate([leg.anchors, leg.foot[None]]), axis=0), axis=1).sum())
        for leg in embodiment.legs
    ]
    return 0.7 * max(lengths, default=0.0) or 0.6


def _expectations(
    engine: MujocoEngine,
    reference: JointReference,
    linear: Linear,
    perturbed: tuple[State, Models],
    period: int,
    errors: SensorErrors,
) -> Array:
    """Learn the estimates from perturbed runs without feedback, shape (ticks of the linear model, states - sensed, sensed)."""
    joints = engine.embodiment.joints
    ticks = len(linear.a)
    fields = ["qpos", "qvel", *(["act"] if engine.model.na else [])]
    starts, models = perturbed
    found = engine.states(starts, reference, fields, models=models)[0]
    every = slice(period - 1, None, period)  # the end of the last step before each tick but the first
    state = state_of(engine.layout, *(found[name][:, every] for name in fields))
    noise = np.concatenate(
        [
            np.full(3, errors.attitude),
            np.full(3, errors.rate + errors.rate_noise),
            np.full(joints, errors.joint),
            np.full(joints, errors.joint_noise),
        ]
    )
    states, width = linear.a.shape[1], 6 + 2 * joints
    expected = np.zeros((ticks, states - width, width))
    hold = reference.steps > reference.horizon_steps
    count = min(state.shape[1], len(linear.state) - 1)
    off = state[:, :count] - linear.state[1 : count + 1]
    # those that are far off say nothing about those that are near
    near = np.abs(off[..., :3]).max(axis=2) < _NEAR
    for k in range(1, ticks):
        rows = slice(ticks - 2, None) if hold and k == ticks - 1 else slice(k - 1, k)
        these = near[:, rows]
        if these.any():
            both = off[:, rows][these]
            expected[k] = expectation(both[:, :width], both[:, width:], noise)
    return expected
