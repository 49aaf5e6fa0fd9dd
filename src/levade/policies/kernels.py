"""Normalised Gaussian kernels over the horizon (eq. 3-4 of the paper).

    f(t) = sum_i w_i phi_i(t) / sum_i phi_i(t),        phi_i(t) = exp(-(t - mu_i)^2 / (2 sigma^2))

The paper prints eq. 4 without the square on (t - mu_i), but its Fig. 1 shows the Gaussian, which is used here. Its
sigma^2 = 0.01 has no unit: `GaussianKernels.time` says whether time is in seconds or normalised to [0, 1] over the horizon.
With M = 16 kernels the two agree at T = 1 s. At the printed T = 0.3 s, sigma = 0.1 s would be five times the spacing of the
means, so neighbouring kernels would be almost the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError


@dataclass(frozen=True)
class GaussianKernels:
    """Number and width of the kernels: the paper's M and sigma^2.

    Attributes:
        kernels: M, number of kernels; their means mu_i are evenly spaced over 0..T, both ends included.
        variance: sigma^2, in s^2 if ``time`` is "seconds", else in units of T^2.
        time: Time that sigma^2 is measured in: "normalised" to the horizon, or "seconds".

    Raises:
        LevadeError: If a value is out of range.
    """

    kernels: int = 16
    variance: float = 0.01
    time: Literal["normalised", "seconds"] = "normalised"

    def __post_init__(self) -> None:
        if self.kernels < 1:
            raise LevadeError(f"kernels: {self.kernels} should be at least 1; the paper has 16")
        if not (math.isfinite(self.variance) and 1e-12 <= self.variance <= 1e12):
            raise LevadeError(f"variance: {self.variance} should be between 1e-12 and 1e12; the paper has 0.01")
        if self.time not in ("normalised", "seconds"):
            raise LevadeError(f"time: {self.time!r} is unknown; give normalised or seconds")

    @property
    def means(self) -> Array:
        """Means mu_i [-], in time normalised to [0, 1] over the horizon, shape (kernels,)."""
        return np.linspace(0.0, 1.0, self.kernels)

    def basis(self, time: Array, horizon: float) -> tuple[Array, Array]:
        """Evaluate the share Phi of each kernel at each time, and its rate of change.

        However narrow the kernels, the one nearest to a row has a share of at least 1/kernels: there is no 0/0 between the
        means.

        Args:
            time: Times from 0 to the horizon [s], shape (rows,).
            horizon: T [s].

        Returns:
            Phi [-], shape (rows, kernels), each row non-negative with a sum of one, so that ``Phi @ w`` is eq. 3; and its
            exact time derivative [1/s], of the same shape.
        """
        means = self.means
        variance = self.variance if self.time == "normalised" else self.variance / horizon**2
        t = (np.asarray(time, dtype=np.float64) / horizon)[:, None]
        nearest = means[np.argmin(np.abs(t - means), axis=1)][:, None]
        # (t - nearest)^2 - (t - mu)^2, factored: exact where the squares would cancel, and never above 0
        exponent = (means - nearest) * (2.0 * t - means - nearest) / (2.0 * variance)
        phi = np.exp(np.minimum(exponent, 0.0))
        phi /= phi.sum(axis=1, keepdims=True)
        # d/dt log(phi_i) up to a part common to all kernels, which the normalisation removes again
        slope = (means - nearest) / (variance * horizon)
        return phi, phi * (slope - (phi * slope).sum(axis=1, keepdims=True))
