"""Interpolate between recorded instants, which are evenly spaced.

At a recorded instant every function returns the recorded value, to the bit.

    interval, share = locate(time, timestep, intervals)
    position = hermite(interval, share, positions, velocities, timestep)

Errors between them, for a motion of step h with exact values and rates:

    hermite    at most h^4 / 384 max|x''''|: a cubic through both ends with both rates
    linear     at most h^2 / 8 max|x''|
    rotations  also of fourth order; exact for a fixed axis and a constant rate
    mean       exact for values that a simulation holds constant over each step, such as torques: it keeps impulses

MuJoCo's velocities are not exactly the rates of its positions, because positions move by the velocity at the end of a step.
That adds up to 0.05 h |dv| to a position between the instants, where dv is the change of velocity within the step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.rotations import conjugate, exponential, log, multiply

_SNAP = 1e-9
"""Distance in steps within which a time counts as a recorded instant."""

Index = NDArray[np.intp]


def locate(time: Array, timestep: float, intervals: int) -> tuple[Index, Array]:
    """Find the interval between recorded instants that contains each time.

    Args:
        time: Times [s], shape (rows,). Instant i is at ``i * timestep``, from 0 to ``intervals``. Later times count as the end.
        timestep: Time between instants [s].
        intervals: Number of intervals.

    Returns:
        The interval, from 0 to intervals - 1, and the share of it that has passed, in [0, 1]; shape (rows,) each.
    """
    x = np.asarray(time, dtype=np.float64) / timestep
    nearest = np.rint(x)
    x = np.clip(np.where(np.abs(x - nearest) < _SNAP, nearest, x), 0.0, intervals)
    interval = np.minimum(np.floor(x), intervals - 1)
    return interval.astype(np.intp), x - interval


def hermite(interval: Index, share: Array, values: Array, rates: Array, timestep: float) -> Array:
    """Evaluate cubics through values with given rates.

    Args:
        interval: Interval of each time, shape (rows,).
        share: Share of the interval that has passed, in [0, 1], shape (rows,).
        values: Values at the instants, shape (instants, n).
        rates: Their rates of change, shape (instants, n).
        timestep: Time between instants [s].

    Returns:
        Values at the times, shape (rows, n).
    """
    s = share[:, None]
    return (
        (1 + 2 * s) * (1 - s) ** 2 * values[interval]
        + s**2 * (3 - 2 * s) * values[interval + 1]
        + timestep * s * (1 - s) * ((1 - s) * rates[interval] - s * rates[interval + 1])
    )


def hermite_rate(interval: Index, share: Array, values: Array, rates: Array, timestep: float) -> Array:
    """Evaluate the rates of change of the cubics of `hermite`.

    Args:
        interval: Interval of each time, shape (rows,).
        share: Share of the interval that has passed, in [0, 1], shape (rows,).
        values: Values at the instants, shape (instants, n).
        rates: Their rates of change, shape (instants, n).
        timestep: Time between instants [s].

    Returns:
        Rates at the times, shape (rows, n).
    """
    s = share[:, None]
    return (
        6 * s * (1 - s) / timestep * (values[interval + 1] - values[interval])
        + (1 - s) * (1 - 3 * s) * rates[interval]
        + s * (3 * s - 2) * rates[interval + 1]
    )


def linear(interval: Index, share: Array, values: Array) -> Array:
    """Interpolate values linearly.

    Args:
        interval: Interval of each time, shape (rows,).
        share: Share of the interval that has passed, from 0 to 1, shape (rows,).
        values: Values at the instants, shape (instants, n).

    Returns:
        Values at the times, shape (rows, n).
    """
    s = share[:, None]
    return (1 - s) * values[interval] + s * values[interval + 1]


def mean(start: Array, stop: Array, values: Array, timestep: float) -> Array:
    """Average values that are constant over each step.

    Args:
        start: Start of each period [s], shape (rows,).
        stop: End of each period [s], shape (rows,).
        values: Value of each step, shape (steps, n). Row k holds from ``k * timestep`` to ``(k + 1) * timestep``, the last one
            for ever.
        timestep: Duration of a step [s].

    Returns:
        Mean of each period, shape (rows, n).
    """
    steps = len(values)
    first, into = locate(start, timestep, steps)
    first = np.where(into == 1.0, first + 1, first)  # where a period starts with a step, that step is in force
    last, after = locate(stop, timestep, steps)
    single = (last <= first) | ((last == first + 1) & (after == 0.0))
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0) * timestep])

    def integral(time: Array) -> Array:
        interval, share = locate(time, timestep, steps)
        beyond = np.maximum(time - steps * timestep, 0.0)[:, None]
        return total[interval] + (share * timestep)[:, None] * values[interval] + beyond * values[-1]

    period = (stop - start)[:, None]
    return np.where(single[:, None], values[np.minimum(first, steps - 1)], (integral(stop) - integral(start)) / period)


def rotations(interval: Index, share: Array, quaternions: Array, rates: Array, timestep: float) -> Array:
    """Interpolate rotations with given angular velocities.

    Args:
        interval: Interval of each time, shape (rows,).
        share: Share of the interval that has passed, in [0, 1], shape (rows,).
        quaternions: Body to world, w-x-y-z, shape (instants, 4).
        rates: Angular velocities in body axes [rad/s], shape (instants, 3). The rotation vector from the start of each interval
            is a cubic with the rates at both ends.
        timestep: Time between instants [s].

    Returns:
        Quaternions at the times, shape (rows, 4).
    """
    s = share[:, None]
    start, stop = quaternions[interval], quaternions[interval + 1]
    way = log(multiply(conjugate(start), stop))
    first, last = rates[interval] * timestep, _vector_rate(way, rates[interval + 1] * timestep)
    vector = s**2 * (3 - 2 * s) * way + s * (1 - s) * ((1 - s) * first - s * last)
    # at the ends as recorded, not up to rounding
    return np.where(s == 0.0, start, np.where(s == 1.0, stop, multiply(start, exponential(vector))))


def _vector_rate(vector: Array, rate: Array) -> Array:
    """Compute the rate of a rotation vector, shape (..., 3), of a body that turns with a rate in body axes, shape (..., 3)."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    near = np.maximum(angle, 1e-4)  # below that, the limit of 1/12 to twelve digits
    share = np.where(angle < 1e-4, 1 / 12, 1 / near**2 - 1 / (2 * near * np.tan(near / 2)))
    across = np.cross(vector, rate)
    return rate + across / 2 + share * np.cross(vector, across)
