"""The linear-quadratic regulator with corrections one tick late, projected onto what a robot senses.

With z = (x, c), the deviation and the correction in force, and v the correction from the next tick on:

    z[k+1] = (a x + b c, v)      least sum of x' Q x + v' R v      v = gain z

Not all of x is sensed. By certainty equivalence, the rest is replaced by its estimate from the sensed values: `project`.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array


def sweep(a: Array, b: Array, state: Array, correction: Array, value: Array) -> tuple[Array, Array]:
    """Sweep backwards from the end.

    Args:
        a: As in `levade.regulators.linear.Linear`.
        b: As in `levade.regulators.linear.Linear`.
        state: Diagonal of Q, shape (states,).
        correction: Diagonal of R, shape (joints,).
        value: Value matrix at the end, shape (states + joints, states + joints).

    Returns:
        Gains, shape (ticks, joints, states + joints), and the value matrix at the start.
    """
    gains = np.zeros((len(a), len(correction), a.shape[1] + len(correction)))
    for k in range(len(a) - 1, -1, -1):
        gains[k], value = _step(a[k], b[k], state, correction, value)
    return gains, value


def steady(a: Array, b: Array, state: Array, correction: Array, *, most: int = 5000) -> tuple[Array, Array]:
    """Compute the stationary gain, shape (joints, states + joints), and its value matrix.

    Args:
        a: Matrix of one tick.
        b: Matrix of one tick.
        state: Diagonal of Q, shape (states,).
        correction: Diagonal of R, shape (joints,).
        most: Largest number of iterations.

    Returns:
        The gain and the value matrix.
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
    """Reduce a gain, shape (joints, states + joints), to the sensed values and the correction in force.

    Args:
        gain: Gain on the whole state, shape (..., joints, states).
        expected: Rest of the state per unit of the sensed values, shape (states - sensed, sensed).
        sensed: Number of sensed states, which come first.

    Returns:
        The reduced gain.
    """
    states = sensed + len(expected)
    own, rest, last = np.split(gain, [sensed, states], axis=1)
    return np.concatenate([own + rest @ expected, last], axis=1)


def expectation(seen: Array, hidden: Array, noise: Array) -> Array:
    """Estimate hidden deviations from seen ones by least squares.

    Args:
        seen: Sensed deviations, shape (runs, seen).
        hidden: Unsensed deviations, shape (runs, hidden).
        noise: Noise of sensing, shape (seen,).

    Returns:
        Matrix from seen to hidden, shape (hidden, seen).
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
