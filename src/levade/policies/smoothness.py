"""A prior for the search: neighbouring weights of a joint are correlated, so sampled motions are smooth in time.

factor = smoothness_factor(policy.kernels, length=0.2, joints=policy.independent_joints)
samples = mean + sigma * normal((n, policy.size)) @ factor.T
"""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies.kernels import GaussianKernels

# Share of independent noise in every weight: it keeps the covariance positive definite for any length.
NUGGET = 1e-6


def smoothness(kernels: GaussianKernels, length: float) -> Array:
    """Compute the correlation of the weights of one joint, ``exp(-(mu_i - mu_j)^2 / (2 length^2))``.

    Args:
        kernels: The kernels.
        length: Correlation length as a share of the horizon [-]; 0 leaves the weights independent.

    Returns:
        Correlation [-], shape (kernels, kernels): symmetric, with a unit diagonal, and positive definite in floating point,
        because a share `NUGGET` of every variance is independent.

    Raises:
        LevadeError: If the length is negative or not finite.
    """
    if not (math.isfinite(length) and length >= 0):
        raise LevadeError(f"length: {length} should be 0 or more, as a share of the horizon")
    if length == 0:
        return np.eye(kernels.kernels)
    distance = (kernels.means[:, None] - kernels.means) / max(length, 1e-100)
    correlation = (1.0 - NUGGET) * np.exp(-0.5 * np.minimum(distance**2, 1e6))
    np.fill_diagonal(correlation, 1.0)
    return correlation


def smoothness_factor(kernels: GaussianKernels, length: float, joints: int, *, modes: int | None = None) -> Array:
    """Factor the covariance of all weights, with one `smoothness` block per joint, as ``A @ A.T``.

    A standard normal z gives smooth weights ``A @ z``.

    Args:
        kernels: The kernels.
        length: Correlation length as a share of the horizon [-].
        joints: Number of independent joints; size = joints * kernels.
        modes: Number of directions per joint to keep, those that vary most and are smoothest. The search then has
            joints * modes dimensions. Defaults to all.

    Returns:
        A [-], shape (size, joints * modes); lower triangular, shape (size, size), if ``modes`` is None.

    Raises:
        LevadeError: If the length is negative, or ``modes`` is not between 1 and the number of kernels.
    """
    correlation = smoothness(kernels, length)
    if modes is None:
        block: Array = np.asarray(np.linalg.cholesky(correlation), dtype=np.float64)
    else:
        if not 1 <= modes <= kernels.kernels:
            raise LevadeError(f"modes: {modes} should be 1 to {kernels.kernels}, the number of kernels")
        variance, direction = np.linalg.eigh(correlation)
        largest = np.argsort(variance)[::-1][:modes]
        block = direction[:, largest] * np.sqrt(variance[largest])
    return np.asarray(np.kron(np.eye(joints), block), dtype=np.float64)
