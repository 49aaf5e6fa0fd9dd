"""A prior for the search: neighbouring weights of a joint move together, so that sampled motions are smooth in time.

factor = smoothness_factor(policy.kernels, length=0.2, joints=policy.independent_joints)
samples = mean + sigma * normal((n, policy.size)) @ factor.T
"""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies.kernels import GaussianKernels

# Share of independent noise in every weight: keeps the covariance positive definite however long the length.
NUGGET = 1e-6


def smoothness(kernels: GaussianKernels, length: float) -> Array:
    """Correlation of the weights of one joint, ``exp(-(mu_i - mu_j)^2 / (2 length^2))``: (kernels, kernels) [-].

    length: [-], in time normalised to [0, 1] over the horizon; 0 leaves the weights independent.
    Unit diagonal; symmetric; positive definite in floating point, as a share `NUGGET` of every variance is independent.
    """
    if not (math.isfinite(length) and length >= 0):
        raise LevadeError(f"length: {length} is not a correlation length; 0 or more, as a share of the horizon")
    if length == 0:
        return np.eye(kernels.kernels)
    distance = (kernels.means[:, None] - kernels.means) / max(length, 1e-100)
    correlation = (1.0 - NUGGET) * np.exp(-0.5 * np.minimum(distance**2, 1e6))
    np.fill_diagonal(correlation, 1.0)
    return correlation


def smoothness_factor(kernels: GaussianKernels, length: float, joints: int, *, modes: int | None = None) -> Array:
    """A with ``A @ A.T`` the covariance of all weights: one `smoothness` block per joint.

    joints: the independent joints; size = joints * kernels. Standard normal z gives smooth weights ``A @ z``.
    modes: per joint, keep only that many of the directions that vary most, the smoothest. A is then (size, joints * modes)
    and the search has as many dimensions; all of them, lower triangular and (size, size), if None.
    Raises LevadeError unless 1 <= modes <= kernels.
    """
    correlation = smoothness(kernels, length)
    if modes is None:
        block: Array = np.asarray(np.linalg.cholesky(correlation), dtype=np.float64)
    else:
        if not 1 <= modes <= kernels.kernels:
            raise LevadeError(f"modes: {modes} of {kernels.kernels} kernels; 1 to {kernels.kernels}")
        variance, direction = np.linalg.eigh(correlation)
        largest = np.argsort(variance)[::-1][:modes]
        block = direction[:, largest] * np.sqrt(variance[largest])
    return np.asarray(np.kron(np.eye(joints), block), dtype=np.float64)
