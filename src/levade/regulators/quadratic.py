"""The linear-quadratic regulator whose corrections come one tick late, and what of it is left to a robot that senses less.

With z = (x, c), the deviation and the correction in force, and v the correction from the next tick on:

    z[k+1] = (a x + b c, v)      least sum of x' Q x + v' R v      v = gain z

Not all of x is sensed. By certainty equivalence the rest is what it is expected to be, given what is sensed: `project`.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array


def sweep(a: Array, b: Array, state: Array, correction: Array, value: Array) -> tuple[Array, Array]:
    """Backwards from the end: gains (ticks, joints, states + joints), and the value matrix at the start.

    Args:
        a: As in `levade.regulators.linear.Linear`.
        b: As in `levade.regulators.linear.Linear`.
        state: (states,), diagonal of Q.
        correction: (joints,), of R.
        value: (states + joints,) squared, of what comes after.
    """
    gains = np.zeros((len(a), len(correction), a.shape[1] + len(correction)))
    for k in range(len(a) - 1, -1, -1):
        gains[k], value = _step(a[k], b[k], state, correction, value)
    return gains, value


def steady(a: Array, b: Array, state: Array, correction: Array, *, most: int = 5000) -> tuple[Array, Array]:
    """The gain (joints, states + joints) that does not change any more, and its value matrix.

    Args:
        a: Of one tick.
        b: Of one tick.
        state: Weight of the state, shape (states, states).
        correction: Weight of the correction, shape (joints, joints).
        most: Most iterations.
    """
    size = len(a) + len(correction)
    value, gain = np.zeros((size, size)), np.zeros((len(correction), size))
    for _ in range(most):
        before = value
        gain, value = _step(a, b, state, correction, value)
        if np.abs(value - before).max() <= 1e-10 * np.abs(value).max():
            break
    return gain, value


def project(gain: Array, expected: Array, sensed: int) -> Array:
    """A gain (joints, states + joints) on what is sensed and the correction in force alone.

    Args:
        gain: Gain on the whole state, shape (..., joints, states).
        expected: (states - sensed, sensed), of the rest of the state, per unit of what is sensed.
        sensed: Number of states that are sensed; the first ones.
    """
    states = sensed + len(expected)
    own, rest, last = np.split(gain, [sensed, states], axis=1)
    return np.concatenate([own + rest @ expected, last], axis=1)


def expectation(seen: Array, hidden: Array, noise: Array) -> Array:
    """Least-squares estimate of hidden (runs, h) from seen (runs, s), deviations both: (h, s).

    Args:
        seen: What is sensed, shape (runs, seen).
        hidden: What is not sensed, shape (runs, hidden).
        noise: (s,), of sensing.
    """
    covariance = seen.T @ seen / len(seen) + np.diag(noise**2)
    return np.linalg.solve(covariance, seen.T @ hidden / len(seen)).T


def _step(a: Array, b: Array, state: Array, correction: Array, value: Array) -> tuple[Array, Array]:
    states = len(a)
    late = value[states:, states:]  # of v, which is all that it acts on within the tick
    forward = np.zeros_like(value)
    forward[:states] = np.concatenate([a, b], axis=1)
    gain = -np.linalg.solve(np.diag(correction) + late, value[states:] @ forward)
    closed = forward.copy()
    closed[states:] += gain
    value = forward.T @ value @ closed
    value[:states, :states] += np.diag(state)
    return gain, (value + value.T) / 2
