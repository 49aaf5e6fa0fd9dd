"""Rotations as unit quaternions, w-x-y-z, batched over leading axes.

    up = rotate(conjugate(quaternion), np.array([0.0, 0.0, 1.0]))    # world axis z in body axes
    turned = multiply(exponential(vector), quaternion)               # turned about a world axis

A quaternion takes body axes to world axes. Functions are plain numpy and compute each row alone, so a row has the same bits
in any batch.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array

_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


def rotate(quaternion: Array, vector: Array) -> Array:
    """Rotate vectors by unit quaternions; leading shapes broadcast.

    Args:
        quaternion: Unit quaternions, w-x-y-z, shape (..., 4).
        vector: Vectors in any unit, shape (..., 3).

    Returns:
        Rotated vectors in the same unit, shape (..., 3).
    """
    w, u = quaternion[..., :1], quaternion[..., 1:]
    t = 2.0 * cross(u, vector)
    return vector + w * t + cross(u, t)


def multiply(first: Array, second: Array) -> Array:
    """Compute the Hamilton product of quaternions: the rotation ``second``, then ``first``.

    Args:
        first: Quaternions, w-x-y-z, shape (..., 4).
        second: Quaternions, w-x-y-z, shape (..., 4); leading shapes broadcast.

    Returns:
        Products, shape (..., 4).
    """
    w, u, x, v = first[..., :1], first[..., 1:], second[..., :1], second[..., 1:]
    return np.concatenate([w * x - np.sum(u * v, axis=-1, keepdims=True), w * v + x * u + np.cross(u, v)], axis=-1)


def conjugate(quaternion: Array) -> Array:
    """Return the inverse rotations.

    Args:
        quaternion: Unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Unit quaternions, shape (..., 4).
    """
    return quaternion * _CONJUGATE


def exponential(vector: Array) -> Array:
    """Turn rotation vectors into quaternions.

    Args:
        vector: Rotation vectors [rad], shape (..., 3).

    Returns:
        Unit quaternions, w-x-y-z, shape (..., 4).
    """
    half = np.linalg.norm(vector, axis=-1, keepdims=True) / 2
    return np.concatenate([np.cos(half), np.sinc(half / np.pi) / 2 * vector], axis=-1)


def log(quaternion: Array) -> Array:
    """Turn quaternions into rotation vectors. The inverse of `exponential`.

    Args:
        quaternion: Unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Rotation vectors [rad], shape (..., 3), no longer than pi.
    """
    quaternion = np.where(quaternion[..., :1] < 0, -quaternion, quaternion)
    sine = np.linalg.norm(quaternion[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, quaternion[..., :1])
    return np.where(sine > 1e-12, angle / np.maximum(sine, 1e-12), 2.0) * quaternion[..., 1:]


def cross(a: Array, b: Array) -> Array:
    """Compute cross products; leading shapes broadcast.

    The result has the bits of numpy's own, whose care for axes takes several times as long as the products of a
    generation.

    Args:
        a: Vectors, shape (..., 3).
        b: Vectors, shape (..., 3).

    Returns:
        Products, shape (..., 3).
    """
    (a0, a1, a2), (b0, b1, b2) = components(a), components(b)
    first = np.asarray(a1 * b2 - a2 * b1)
    out = np.empty((*first.shape, 3))
    out[..., 0] = first
    out[..., 1] = a2 * b0 - a0 * b2
    out[..., 2] = a0 * b1 - a1 * b0
    return out


def components(values: Array) -> tuple[Array, ...]:
    """Return the components along the last axis, as views.

    Args:
        values: Values, shape (..., k).

    Returns:
        k views, shape (...) each.
    """
    return tuple(values[..., i] for i in range(values.shape[-1]))


def rotation_matrix(quaternion: Array) -> Array:
    """Compute rotation matrices, which take trunk axes to world axes.

    Args:
        quaternion: Trunk frame to world, unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Matrices, shape (..., 3, 3).
    """
    w, x, y, z = components(quaternion)
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1),
            np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], axis=-1),
            np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1),
        ],
        axis=-2,
    )


def roll_pitch_yaw(quaternion: Array) -> Array:
    """Compute intrinsic z-y-x angles.

    Pitch is from -pi/2 to pi/2, roll and yaw from -pi to pi. At pitch = +-pi/2 roll and yaw are not unique; costs and
    success criteria therefore measure orientation as `levade.costs.orientation` says, not by subtracting these angles.

    Args:
        quaternion: Unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Roll, pitch and yaw [rad], shape (..., 3).
    """
    w, x, y, z = components(quaternion)
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.stack([roll, pitch, yaw], axis=-1)
