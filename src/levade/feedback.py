"""Feedback: what a stabiliser adds to the joint references, from what the robot senses.

    column = sensed(quaternion, rate, joint_position, joint_velocity)          # (..., 6 + 2 joints)
    feedback.correction(tick, column, last)                                    # (..., joints) [rad]

A tick is a measurement. At tick j the deviation of what is sensed from ``reference[j]``, and the correction that is in force,
are multiplied by ``gain[j]`` and bounded; the result is in force from tick j + 1 to tick j + 2: one period of latency. After
the last gain the last one stays, and so does the last reference.

Sensed are: the direction of gravity's opposite in trunk axes (3), which is attitude without yaw, the trunk's angular velocity
in trunk axes (3) [rad/s], joint positions [rad] and velocities [rad/s]. Neither the trunk's place nor its velocity is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.rotations import conjugate, rotate

ARRAYS: dict[str, tuple[str, ...]] = {
    "feedback_gain": ("gains", "joints", "columns"),
    "feedback_reference": ("ticks", "sensed"),
}
"""Arrays of a file with feedback -> shape, by name of the dimension; columns are the sensed ones and the joints."""

META = ("rate", "period_steps", "bound", "sensed")
"""Keys of a file's ``meta["feedback"]``."""


@dataclass(frozen=True, eq=False)
class Feedback:
    """A stabiliser.

    Attributes:
        gain: Gains [rad per unit sensed; rad/rad for the correction in force], shape (gains, joints, sensed + joints).
        reference: Expected sensed values of the motion, shape (ticks, sensed); or those of each of n runs, shape (n, ticks,
            sensed).
        period: Time from tick to tick [s]; tick 0 is at 0 s.
        bound: Largest correction of each joint [rad].
    """

    gain: Array
    reference: Array
    period: float
    bound: float

    def correction(self, tick: int, measured: Array, last: Array) -> Array:
        """Compute the correction from the next tick on [rad], shape (..., joints).

        Args:
            tick: Number of the tick.
            measured: Sensed values, shape (..., sensed).
            last: Correction in force now [rad], shape (..., joints).

        Returns:
            The correction.
        """
        row = min(tick, self.reference.shape[-2] - 1)
        off = np.concatenate([measured - self.reference[..., row, :], last], axis=-1)
        gain = self.gain[min(tick, len(self.gain) - 1)]
        # summed in one order for any number of runs: the bits of a run do not depend on those beside it
        return np.clip(np.einsum("...c,jc->...j", off, gain), -self.bound, self.bound)

    def steps(self, timestep: float) -> int:
        """Return the physics steps in a period.

        Args:
            timestep: Time step [s].

        Returns:
            Number of steps.

        Raises:
            LevadeError: If the period is not a whole number of steps.
        """
        steps = round(self.period / timestep)
        if steps < 1 or abs(steps * timestep - self.period) > 1e-9:
            raise LevadeError(
                f"feedback: a period of {self.period:g} s is not a multiple of the time step, {timestep:g} s"
            )
        return steps

    def reordered(self, order: Sequence[int]) -> Feedback:
        """Return the same stabiliser with the joints in another order.

        Args:
            order: Present index of each joint in the new order, shape (joints,).

        Returns:
            The stabiliser, its gains and reference in the new order.
        """
        joints = self.gain.shape[1]
        index = np.asarray(order)
        sense = np.concatenate([np.arange(6), 6 + index, 6 + joints + index])
        columns = np.concatenate([sense, 6 + 2 * joints + index])
        return replace(self, gain=self.gain[:, index][:, :, columns], reference=self.reference[..., sense])

    def along(self, reference: Array) -> Feedback:
        """Return the same gains for other motions.

        Args:
            reference: Expected sensed values, shape (ticks, sensed) or (n, ticks, sensed).

        Returns:
            The stabiliser with this reference.
        """
        return replace(self, reference=reference)

    def arrays(self) -> dict[str, Array]:
        """Return the arrays of a motion file."""
        return {"feedback_gain": self.gain, "feedback_reference": self.reference}

    @classmethod
    def of(cls, meta: Mapping[str, Any], arrays: Mapping[str, Array]) -> Feedback:
        """Read a stabiliser from a motion file.

        Args:
            meta: The file's ``meta["feedback"]``, with the rate [Hz] and the bound [rad].
            arrays: The file's arrays, with those of `ARRAYS`.

        Returns:
            The stabiliser.
        """
        return cls(
            arrays["feedback_gain"], arrays["feedback_reference"], 1.0 / float(meta["rate"]), float(meta["bound"])
        )


def period_steps(rate: float, timestep: float) -> int:
    """Return the physics steps from tick to tick at a rate: the nearest number, at least one.

    Args:
        rate: Ticks a second [Hz].
        timestep: [s].
    """
    return max(1, round(1.0 / (rate * timestep)))


def up_in_trunk(quaternion: Array) -> Array:
    """Return the upward direction in trunk axes, shape (..., 3): the attitude without yaw.

    Args:
        quaternion: Trunk frame to world, shape (..., 4).

    Returns:
        Unit vectors.
    """
    return rotate(conjugate(quaternion), np.array([0.0, 0.0, 1.0]))


def sensed(quaternion: Array, rate: Array, joint_position: Array, joint_velocity: Array) -> Array:
    """Return the sensed values of a robot, shape (..., 6 + 2 joints).

    Args:
        quaternion: Trunk frame to world, shape (..., 4).
        rate: Angular velocity in trunk axes, as a gyroscope measures it [rad/s], shape (..., 3).
        joint_position: Joint angles [rad], shape (..., joints).
        joint_velocity: Joint velocities [rad/s], shape (..., joints).

    Returns:
        The values.
    """
    return np.concatenate([up_in_trunk(quaternion), rate, joint_position, joint_velocity], axis=-1)


def names(joints: Sequence[str]) -> list[str]:
    """Name each sensed value.

    Args:
        joints: Names of the joints.

    Returns:
        6 + 2 joints names, such as "up/x", in the order of `sensed`.
    """
    return [
        *(f"up/{axis}" for axis in "xyz"),
        *(f"rate/{axis}" for axis in "xyz"),
        *(f"{joint}/position" for joint in joints),
        *(f"{joint}/velocity" for joint in joints),
    ]


@dataclass(frozen=True)
class SensorErrors:
    """Errors of a robot's sensors, uniform within plus and minus each.

    Attributes:
        attitude: Error of the attitude [rad], constant through a run.
        rate: Error of the angular velocity [rad/s], constant through a run.
        joint: Offset of each encoder [rad], constant through a run.
        rate_noise: Noise of the angular velocity [rad/s], drawn for each tick.
        joint_noise: Noise of the joint velocities [rad/s], drawn for each tick.

    Raises:
        LevadeError: If one is negative or not finite.
    """

    attitude: float = 0.01
    rate: float = 0.02
    joint: float = 0.005
    rate_noise: float = 0.05
    joint_noise: float = 0.1

    def __post_init__(self) -> None:
        for name in ("attitude", "rate", "joint", "rate_noise", "joint_noise"):
            value: float = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise LevadeError(f"feedback.sensors.{name}: {value} should be 0 or more")

    def draw(self, runs: int, ticks: int, joints: int, *, seed: int | Sequence[int]) -> Array:
        """Draw errors that are added to sensed values.

        Args:
            runs: Number of runs.
            ticks: Ticks of each run.
            joints: Joints of the robot.
            seed: Seed of the random numbers.

        Returns:
            Errors in the units of the sensed values, shape (runs, ticks, 6 + 2 joints).
        """
        generator = np.random.default_rng(seed)
        constant = np.array([self.attitude] * 3 + [self.rate] * 3 + [self.joint] * joints + [0.0] * joints)
        changing = np.array([0.0] * 3 + [self.rate_noise] * 3 + [0.0] * joints + [self.joint_noise] * joints)
        drawn = generator.uniform(-1.0, 1.0, (runs, ticks + 1, 6 + 2 * joints))
        return constant * drawn[:, :1] + changing * drawn[:, 1:]


class Correcting:
    """Runs feedback tick by tick, and keeps the corrections, which reach the servos late by each run's delay.

    Args:
        feedback: The stabiliser.
        steps: Physics steps of the roll-out.
        timestep: Time step [s].
        delay: Delay of each run [s], shape (n,).
        lower: Lower ends of the ranges [rad], shape (joints,). No correction moves a reference beyond them, or further beyond.
        upper: Upper ends of the ranges [rad], shape (joints,).
        errors: Errors that are added to the sensed values, shape (n, ticks, sensed). None for none.
    """

    def __init__(
        self,
        feedback: Feedback,
        *,
        steps: int,
        timestep: float,
        delay: Array,
        lower: Array,
        upper: Array,
        errors: Array | None = None,
    ) -> None:
        self.feedback, self.errors = feedback, errors
        self._steps, self.period = steps, feedback.steps(timestep)
        self._lower, self._upper = lower, upper
        n, joints = len(delay), feedback.gain.shape[1]
        late = delay / timestep
        self._whole = np.floor(late).astype(int)
        self._part = (late - self._whole)[:, None, None]
        self.corrections = np.zeros((n, steps, joints))

    def __iter__(self) -> Iterator[tuple[int, slice]]:
        """Yield each tick, and the steps from it to the next."""
        for tick, first in enumerate(range(0, self._steps, self.period)):
            yield tick, slice(first, min(first + self.period, self._steps))

    def corrected(self, tick: int, rows: slice, measured: Array, told: Array) -> Array:
        """Return the commands to the servos in the steps from a tick to the next [rad], shape (n, rows, joints).

        Args:
            tick: Number of the tick.
            rows: Rows of the reference to which the correction is added.
            measured: Sensed values at the tick, shape (n, sensed).
            told: Commands without feedback [rad], shape (n or 1, rows, joints).

        Returns:
            The corrected commands.
        """
        if self.errors is not None:
            measured = measured + self.errors[:, min(tick, self.errors.shape[1] - 1)]
        last = self.corrections[:, rows.start]
        due = slice(rows.start + self.period, rows.start + 2 * self.period)
        self.corrections[:, due] = self.feedback.correction(tick, measured, last)[:, None]
        index = np.arange(rows.start, rows.stop)[None] - self._whole[:, None]
        run = np.arange(len(index))[:, None]

        def at(row: Array) -> Array:
            return np.where((row >= 0)[..., None], self.corrections[run, np.maximum(row, 0)], 0.0)

        added = (1 - self._part) * at(index) + self._part * at(index - 1)
        return np.clip(told + added, np.minimum(self._lower, told), np.maximum(self._upper, told))
