"""Normalised Gaussian kernels over the horizon (eq. 3-4 of the paper).

    f(t) = sum_i w_i phi_i(t) / sum_i phi_i(t),        phi_i(t) = exp(-(t - mu_i)^2 / (2 sigma^2))

The paper prints eq. 4 without the square on (t - mu_i); its Fig. 1 shows the Gaussian, which is what is meant and what
is used here. Its sigma^2 = 0.01 carries no unit: `GaussianKernels.time` says whether time is in seconds or normalised
to [0, 1] over the horizon. With M = 16 kernels the two agree at T = 1 s; at the printed T = 0.3 s, sigma = 0.1 s would
be five times the spacing of the means, so that neighbouring kernels are all but the same.
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
    """How the kernels lie: the paper's M, sigma^2, and the time that sigma^2 is measured in.

    kernels: M, number of kernels; their means mu_i are evenly spaced over 0..T, both ends included.
    variance: sigma^2, in s^2 where ``time`` is "seconds", else in units of T^2.
    time: "normalised" or "seconds".
    """

    kernels: int = 16
    variance: float = 0.01
    time: Literal["normalised", "seconds"] = "normalised"

    def __post_init__(self) -> None:
        if self.kernels < 1:
            raise LevadeError(f"kernels: {self.kernels} is not a number of kernels; at least 1, the paper has 16")
        if not (math.isfinite(self.variance) and 1e-12 <= self.variance <= 1e12):
            raise LevadeError(f"variance: {self.variance} is out of range; between 1e-12 and 1e12, the paper has 0.01")
        if self.time not in ("normalised", "seconds"):
            raise LevadeError(f"time: {self.time!r} is unknown; normalised or seconds")

    @property
    def means(self) -> Array:
        """(kernels,) mu_i [-], in time normalised to [0, 1] over the horizon."""
        return np.linspace(0.0, 1.0, self.kernels)

    def basis(self, time: Array, horizon: float) -> tuple[Array, Array]:
        """What each kernel contributes at each time, and its rate of change.

        time: (rows,) [s], in [0, horizon]. horizon: T [s].
        Returns Phi (rows, kernels) [-], each row non-negative and summing to one, so that ``Phi @ w`` is eq. 3, and its
        exact time derivative (rows, kernels) [1/s]. However narrow the kernels, the nearest one to a row has weight at
        least 1/kernels: there is no 0/0 between the means.
        """
        means = self.means
        variance = self.variance if self.time == "normalised" else self.variance / horizon**2
        t = (np.asarray(time, dtype=np.float64) / horizon)[:, None]
        nearest = means[np.argmin(np.abs(t - means), axis=1)][:, None]
        # (t - nearest)^2 - (t - mu)^2, factored: exact where the squares would cancel, and never above 0
        exponent = (means - nearest) * (2.0 * t - means - nearest) / (2.0 * variance)
        phi = np.exp(np.minimum(exponent, 0.0))
        phi /= phi.sum(axis=1, keepdims=True)
        # d/dt log(phi_i) up to what is common to all kernels, which the normalisation takes out again
        slope = (means - nearest) / (variance * horizon)
        return phi, phi * (slope - (phi * slope).sum(axis=1, keepdims=True))
