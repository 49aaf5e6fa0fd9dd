"""The kernels of eq. 3-4."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.errors import LevadeError
from levade.policies import GaussianKernels, smoothness, smoothness_factor

kernel_configs = st.builds(
    GaussianKernels,
    kernels=st.integers(1, 40),
    variance=st.floats(1e-12, 1e12),
    time=st.sampled_from(["normalised", "seconds"]),
)


@pytest.mark.slow
@given(kernel_configs, st.floats(0.01, 100.0), st.integers(1, 300))
def test_kernels_sum_to_one_however_narrow_or_wide(kernels, horizon, rows):
    time = np.linspace(0.0, horizon, rows)
    phi, rate = kernels.basis(time, horizon)
    assert np.isfinite(phi).all()
    assert np.isfinite(rate).all()
    assert (phi >= 0).all()
    np.testing.assert_allclose(phi.sum(axis=1), 1.0, rtol=0, atol=1e-14)
    assert (phi.max(axis=1) >= 0.999 / kernels.kernels).all()
    np.testing.assert_allclose(rate.sum(axis=1), 0.0, atol=1e-9 * max(1.0, np.abs(rate).max()))


@pytest.mark.parametrize("time", ["normalised", "seconds"])
def test_the_basis_is_eq_3_and_4_written_out(time):
    horizon, kernels = 0.3, GaussianKernels(16, 0.01, time)
    times = [0.002 * (k + 1) for k in range(150)]
    phi, _ = kernels.basis(np.array(times), horizon)
    unit = horizon if time == "normalised" else 1.0
    for k, t in enumerate(times):
        gaussians = [math.exp(-((t / unit - i / 15 * horizon / unit) ** 2) / (2 * 0.01)) for i in range(16)]
        np.testing.assert_allclose(phi[k], np.array(gaussians) / sum(gaussians), rtol=1e-11)


@pytest.mark.parametrize("variance", [1e-4, 0.01, 1.0])
def test_the_rate_is_the_time_derivative(variance):
    kernels, horizon, h = GaussianKernels(16, variance), 0.3, 1e-7
    time = np.linspace(0.01, 0.29, 57)
    before, after = kernels.basis(time - h, horizon)[0], kernels.basis(time + h, horizon)[0]
    rate = kernels.basis(time, horizon)[1]
    np.testing.assert_allclose(rate, (after - before) / (2 * h), atol=1e-5 * np.abs(rate).max())


def test_the_paper_s_figure_1_stays_within_its_weights_and_reaches_each_mean_with_narrow_kernels():
    weights = np.random.default_rng(1).uniform(-1, 1, 16)
    kernels = GaussianKernels(16, 0.01)
    curve = kernels.basis(np.linspace(0, 1, 501), 1.0)[0] @ weights
    assert weights.min() < curve.min()
    assert curve.max() < weights.max()
    narrow = GaussianKernels(16, 1e-9)
    np.testing.assert_allclose(narrow.basis(narrow.means, 1.0)[0] @ weights, weights, rtol=1e-12)


def test_seconds_and_normalised_agree_at_one_second_and_scale_between():
    time = np.linspace(0, 1, 11)
    np.testing.assert_array_equal(
        GaussianKernels(time="seconds").basis(time, 1.0)[0], GaussianKernels(time="normalised").basis(time, 1.0)[0]
    )
    np.testing.assert_allclose(
        GaussianKernels(8, 0.09, "seconds").basis(3 * time, 3.0)[0], GaussianKernels(8, 0.01).basis(time, 1.0)[0]
    )


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({"kernels": 0}, "kernels: 0 should be at least 1"),
        ({"variance": 0.0}, "variance: 0.0 should be between"),
        ({"variance": math.nan}, "variance: nan should be between"),
        ({"time": "minutes"}, "time: 'minutes' is unknown; give normalised or seconds"),
    ],
)
def test_wrong_kernels_are_named(config, message):
    with pytest.raises(LevadeError, match=message):
        GaussianKernels(**config)


@pytest.mark.slow
@given(st.integers(1, 64), st.floats(0.0, 1e6))
def test_smoothness_is_a_correlation_and_positive_definite(kernels, length):
    correlation = smoothness(GaussianKernels(kernels), length)
    assert (np.diag(correlation) == 1.0).all()
    assert (correlation == correlation.T).all()
    assert np.linalg.eigvalsh(correlation).min() > 0
    factor = smoothness_factor(GaussianKernels(kernels), length, joints=2)
    np.testing.assert_allclose(factor @ factor.T, np.kron(np.eye(2), correlation), atol=1e-12)


def test_smooth_weights_are_closer_to_their_neighbours_than_independent_ones():
    kernels = GaussianKernels()
    z = np.random.default_rng(0).normal(size=(2000, 16))
    smooth = z @ smoothness_factor(kernels, 0.2, joints=1).T
    np.testing.assert_allclose(smooth.std(axis=0), 1.0, atol=0.06)
    expected = math.sqrt(2 * (1 - math.exp(-((1 / 15) ** 2) / (2 * 0.2**2))))
    np.testing.assert_allclose(np.diff(smooth, axis=1).std(axis=0), expected, rtol=0.06)
    np.testing.assert_array_equal(smoothness_factor(kernels, 0.0, joints=1), np.eye(16))


@pytest.mark.parametrize("length", [-0.1, math.inf, math.nan])
def test_a_wrong_length_is_named(length):
    with pytest.raises(LevadeError, match=r"length: .* should be 0 or more"):
        smoothness(GaussianKernels(), length)
