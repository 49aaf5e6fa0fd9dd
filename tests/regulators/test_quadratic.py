"""The regulator, against the minimum found by least squares over all corrections at once."""

from __future__ import annotations

import numpy as np
import pytest

from levade.regulators import project, steady, sweep
from levade.regulators.quadratic import expectation


def system(ticks: int) -> tuple[np.ndarray, np.ndarray]:
    """Unstable, two states, one correction; a pendulum that is upside down."""
    a = np.array([[1.0, 0.05], [0.6, 1.0]]) + np.zeros((ticks, 1, 1))
    return a, np.array([[0.0], [0.08]]) + np.zeros((ticks, 1, 1))


def best_first(a: np.ndarray, b: np.ndarray, q: np.ndarray, r: float, end: np.ndarray, z0: np.ndarray) -> float:
    """First of the corrections v that make least sum x'Qx + r v^2 + the end's x'Ex; x is linear in them."""
    ticks = len(a)

    def run(v: np.ndarray, z: np.ndarray) -> np.ndarray:
        x, c, costs = z[:2].copy(), z[2:], []
        for k in range(ticks):
            costs.append(np.sqrt(q) * x)
            costs.append(np.sqrt(r) * v[k : k + 1])
            x, c = a[k] @ x + b[k] @ c, v[k : k + 1]
        return np.concatenate([*costs, np.sqrt(end) * x])

    zero = np.zeros(ticks)
    free = run(zero, z0)
    effect = np.column_stack([run(one, np.zeros(3)) for one in np.eye(ticks)])
    return float(np.linalg.lstsq(effect, -free, rcond=None)[0][0])


def test_the_sweep_is_the_least_squares_solution() -> None:
    a, b = system(12)
    q, end, r = np.array([2.0, 0.1]), np.array([30.0, 3.0]), 0.05
    value = np.diag([*end, 0.0])
    gains, _ = sweep(a, b, q, np.array([r]), value)
    for z in (np.array([0.1, 0.0, 0.0]), np.array([-0.2, 0.3, 0.4])):
        assert float(gains[0, 0] @ z) == pytest.approx(best_first(a, b, q, r, end, z), abs=1e-9)


def test_the_steady_gain_is_that_of_a_long_sweep_and_holds_what_falls_by_itself() -> None:
    a, b = system(400)
    q, r = np.array([2.0, 0.1]), np.array([0.05])
    gain, _ = steady(a[0], b[0], q, r)
    gains, _ = sweep(a, b, q, r, np.zeros((3, 3)))
    assert np.allclose(gain, gains[0], atol=1e-8)
    open_loop = np.block([[a[0], b[0]], [np.zeros((1, 3))]])
    assert np.abs(np.linalg.eigvals(open_loop)).max() > 1.1
    closed = open_loop + np.array([[0.0], [0.0], [1.0]]) @ gain
    assert np.abs(np.linalg.eigvals(closed)).max() < 0.99


def test_what_is_not_sensed_is_expected_from_what_is() -> None:
    """With hidden = 2 seen, a gain on both is one on what is seen; noise as large as the signal halves the expectation."""
    seen = np.random.default_rng(0).standard_normal((4000, 1))
    sure, unsure = (expectation(seen, 2 * seen, np.array([noise])) for noise in (0.0, seen.std()))
    assert sure[0, 0] == pytest.approx(2.0)
    assert unsure[0, 0] == pytest.approx(1.0, rel=0.01)
    assert project(np.array([[3.0, 5.0, 0.5]]), sure, 1) == pytest.approx(np.array([[13.0, 0.5]]))
