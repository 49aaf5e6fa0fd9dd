"""Convex hulls of many postures, and how a rigid hull that is put on a plane comes to rest, without dynamics.

    hulls = Hulls.of([corners], np.zeros((1, 3)))      # a box, its centre of mass at the origin
    hulls.solid_angles(0)                              # share of the sphere that each triangle covers, (faces,)
    rest = hulls.settle(np.zeros(n, int), up, uphill)  # where it comes to rest from n attitudes

Kessens' framework and the first estimator of Goldberg et al., "Part pose statistics" (IEEE Transactions on Robotics and
Automation 15(5), 1999), treat a body this way: it touches the ground with the face that the vertical through its centre of
mass meets, and while this vertical misses the face, the body tips over the edge that it is beyond.

All positions are relative to the centre of mass, in axes of the body (of the trunk, for a robot). A face is a triangle; a flat
face with more corners is several triangles in one plane, of which `Hulls.plane` names one. `up` is the ground's normal, and
`uphill` the horizontal direction in the ground that rises most, both in axes of the body. Needs scipy
(`pip install 'levade[rightability]'`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError

Indices = NDArray[np.intp]

_TIPS = 256
"""Number of edges in a row after which a body counts as rolling on."""
_INSIDE = 1e-5
"""How far beyond an edge the centre of mass still rests, as a share of the hull's size; rounding decides otherwise."""
_LEAST = 1e-4
"""Least distance of a face from the centre of mass, as a share of the hull's size. A smaller one, or a centre outside the
hull, counts as this: the body tips over such a face."""
_ROWS = 4096


@dataclass(frozen=True, eq=False)
class Rest:
    """Describes where bodies come to rest.

    Attributes:
        face: The face on which it rests, by one triangle for each plane; -1 if it rolls on, shape (n,).
        up: The ground's normal in axes of the body, shape (n, 3).
        uphill: Direction in the ground that rises most, in axes of the body, shape (n, 3).
    """

    face: Indices
    up: Array
    uphill: Array


@dataclass(frozen=True, eq=False)
class Hulls:
    """Holds hulls. Arrays have the shape (hulls, faces, ...); hulls with fewer faces are padded, and `normal` is 0 there.

    Attributes:
        normal: Outward normals.
        distance: Distance of each face's plane from the centre of mass [m].
        inward: In-plane normal of each edge, towards the inside of the face, shape (hulls, faces, 3, 3).
        offset: Distance of each edge from the foot of the perpendicular, along `inward` [m], shape (hulls, faces, 3).
        neighbour: The face beyond each edge, shape (hulls, faces, 3).
        corners: Places of the corners [m], shape (hulls, faces, 3, 3).
        corner: Index of each corner among the hull's points, shape (hulls, faces, 3).
        size: Largest distance of a corner from the centre of mass [m], shape (hulls,).
        plane: For each face, the first face in the same plane, shape (hulls, faces).
    """

    normal: Array
    distance: Array
    inward: Array
    offset: Array
    neighbour: NDArray[np.int16]
    corners: Array
    corner: NDArray[np.int16]
    size: Array
    plane: NDArray[np.int16]

    @classmethod
    def of(cls, points: Sequence[Array], centre: Array) -> Hulls:
        """Compute hulls.

        Args:
            points: Points of each body [m], shape (k, 3) each.
            centre: Centres of mass [m], shape (hulls, 3).

        Raises:
            LevadeError: If scipy is missing, or a body is flat.
        """
        found = [_hull(body - at) for body, at in zip(points, centre, strict=True)]
        most = max(len(corners) for _, corners, _, _ in found)
        n = len(found)
        corners = np.zeros((n, most, 3, 3), dtype=np.float32)
        normal, distance = np.zeros((n, most, 3)), np.ones((n, most))
        corner = np.zeros((n, most, 3), dtype=np.int16)
        neighbour = np.zeros((n, most, 3), dtype=np.int16)
        for i, (body, simplices, neighbours, equations) in enumerate(found):
            m = len(simplices)
            corners[i, :m], corner[i, :m], neighbour[i, :m] = body[simplices], simplices, neighbours
            normal[i, :m], distance[i, :m] = equations[:, :3], -equations[:, 3]
        size = np.linalg.norm(corners, axis=-1).max(axis=(1, 2))
        plane = _planes(normal, distance)
        normal = normal.astype(np.float32)
        inward, offset = _edges(corners, normal)
        distance = np.maximum(distance, _LEAST * size[:, None]).astype(np.float32)
        return cls(normal, distance, inward, offset, neighbour, corners, corner, size, plane)

    def take(self, which: Indices) -> Hulls:
        """Return some of the hulls.

        Args:
            which: Their numbers, shape (n,).
        """
        return Hulls(**{field.name: getattr(self, field.name)[which] for field in fields(self)})

    @cached_property
    def exists(self) -> NDArray[np.bool_]:
        """Which faces are not padding, shape (hulls, faces)."""
        return np.abs(self.normal).sum(axis=-1) > 0

    @cached_property
    def _scaled(self) -> Array:
        return self.normal / self.distance[..., None]

    def solid_angles(self, hull: int | Indices | slice = slice(None)) -> Array:
        """Compute the share of all directions in which each face is seen from the centre of mass.

        The formula is that of van Oosterom and Strackee, The solid angle of a plane triangle (1983).

        Args:
            hull: Which hulls.

        Returns:
            Shares, shape (faces,) or (hulls, faces). They add up to 1 if the centre of mass is inside.
        """
        corners = self.corners[hull].astype(float)
        length = np.linalg.norm(corners, axis=-1, keepdims=True)
        a, b, c = np.moveaxis(corners / np.maximum(length, 1e-12), -2, 0)
        triple = np.abs(np.einsum("...c,...c->...", a, _cross(b, c)))
        below = 1.0 + np.sum(a * b, axis=-1) + np.sum(b * c, axis=-1) + np.sum(c * a, axis=-1)
        return np.where(self.exists[hull], 2.0 * np.arctan2(triple, below), 0.0) / (4.0 * np.pi)

    def stable(self, uphill: Array, slope: float = 0.0) -> NDArray[np.bool_]:
        """Say on which faces the bodies rest.

        Args:
            uphill: Direction that rises most, for each face of the first n hulls, shape (n, faces, 3).
            slope: Slope of the ground [rad].

        Returns:
            Shape (n, faces).
        """
        n = len(uphill)
        shift = -np.tan(slope) * self.distance[:n, :, None] * uphill
        room = np.einsum("hfec,hfc->hfe", self.inward[:n], shift) - self.offset[:n]
        return self.exists[:n] & (room.min(axis=-1) >= -_INSIDE * self.size[:n, None])

    def locate(self, hull: Indices, down: Array) -> Indices:
        """Find the face that is met by a ray from the centre of mass.

        Args:
            hull: The hull of each row, shape (n,).
            down: Direction of the ray in axes of the body, shape (n, 3).

        Returns:
            The faces, shape (n,).
        """
        found = np.empty(len(hull), dtype=np.intp)
        scaled = self._scaled
        for first in range(0, len(hull), _ROWS):
            rows = slice(first, first + _ROWS)
            found[rows] = np.argmax(
                np.matmul(scaled[hull[rows]], down[rows].astype(np.float32)[:, :, None])[..., 0], axis=1
            )
        return found

    def settle(self, hull: Indices, up: Array, uphill: Array, slope: float = 0.0) -> Rest:
        """Let bodies come to rest from attitudes.

        Args:
            hull: The hull of each row, shape (n,).
            up: The ground's normal in axes of the body, shape (n, 3).
            uphill: Direction in the ground that rises most, in axes of the body, shape (n, 3).
            slope: Slope of the ground [rad].
        """
        down = -(np.cos(slope) * up + np.sin(slope) * uphill)
        face = self.locate(hull, down)
        return self.roll(hull, face, turned(uphill, up, -self.normal[hull, face]), slope)

    def roll(self, hull: Indices, face: Indices, uphill: Array, slope: float = 0.0) -> Rest:
        """Let bodies that lie on a face tip over its edges until they rest.

        Args:
            hull: The hull of each row, shape (n,).
            face: The face that is on the ground, shape (n,).
            uphill: Direction in the ground that rises most, in axes of the body, shape (n, 3).
            slope: Slope of the ground [rad].
        """
        face, uphill = face.copy(), np.array(uphill, dtype=float)
        active = np.arange(len(face))
        for _ in range(_TIPS):
            h, f = hull[active], face[active]
            shift = -np.tan(slope) * self.distance[h, f, None] * uphill[active]
            room = np.einsum("nec,nc->ne", self.inward[h, f], shift) - self.offset[h, f]
            edge = np.argmin(room, axis=1)
            tips = room[np.arange(len(active)), edge] < -_INSIDE * self.size[h]
            active, h, f, edge = active[tips], h[tips], f[tips], edge[tips]
            if not len(active):
                break
            beyond = self.neighbour[h, f, edge].astype(np.intp)
            uphill[active] = turned(uphill[active], self.normal[h, f], self.normal[h, beyond])
            face[active] = beyond
        rested = self.plane[hull, face].astype(np.intp)
        rested[active] = -1
        return Rest(rested, -self.normal[hull, face].astype(float), uphill)


def tangent(up: Array) -> Array:
    """Return a direction in the plane with a normal: forward as far as it can, otherwise upward of the trunk.

    Args:
        up: Normals, shape (..., 3).
    """
    forward = np.where(np.abs(up[..., :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0])
    level = forward - np.sum(forward * up, axis=-1, keepdims=True) * up
    return level / np.maximum(np.linalg.norm(level, axis=-1, keepdims=True), 1e-9)


def turned(vector: Array, one: Array, other: Array) -> Array:
    """Turn vectors by the smallest rotation that takes one unit vector to another.

    Args:
        vector: Vectors that are normal to `one`, shape (n, 3).
        one: Unit vectors, shape (n, 3).
        other: Unit vectors, shape (n, 3).

    Returns:
        Unit vectors that are normal to `other`, shape (n, 3).
    """
    cosine = np.sum(one * other, axis=-1, keepdims=True)
    along = np.sum(vector * other, axis=-1, keepdims=True)
    result = vector - along / np.maximum(1.0 + cosine, 1e-6) * (one + other)
    result = result - np.sum(result * other, axis=-1, keepdims=True) * other
    return result / np.maximum(np.linalg.norm(result, axis=-1, keepdims=True), 1e-9)


def _hull(points: Array) -> tuple[Array, Any, Any, Any]:
    """Points, the corners of triangles, their neighbours, and their planes."""
    try:
        from scipy.spatial import ConvexHull, QhullError
    except ImportError:
        raise LevadeError("rightability needs scipy; pip install 'levade[rightability]'") from None
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        raise LevadeError(
            "rightability: the collision shapes lie in one plane and have no hull; give the robot's links shapes"
        ) from None
    return points, hull.simplices, hull.neighbors, hull.equations


def _edges(corners: Array, normal: Array) -> tuple[Array, Array]:
    """In-plane inward normals of the edges opposite each corner, and how far each edge is along them from the centre."""
    inward, offset = np.zeros(corners.shape, corners.dtype), np.zeros(corners.shape[:-1], corners.dtype)
    for edge, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        start = corners[:, :, one]
        across = _cross(normal, corners[:, :, other] - start)
        length = np.sqrt(np.einsum("hfc,hfc->hf", across, across))
        side = np.einsum("hfc,hfc->hf", across, corners[:, :, edge] - start)
        across *= (np.where(side < 0, -1.0, 1.0) / np.maximum(length, 1e-12))[..., None]
        inward[:, :, edge], offset[:, :, edge] = across, np.einsum("hfc,hfc->hf", across, start)
    return inward, offset


def _cross(a: Array, b: Array) -> Array:
    """Cross products; numpy's own takes several times as long."""
    result = np.empty_like(a)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[..., i] = a[..., j] * b[..., k] - a[..., k] * b[..., j]
    return result


def _planes(normal: Array, distance: Array) -> NDArray[np.int16]:
    """For each face, the first face in the same plane: Qhull gives triangles of one face the same equation, to the bit."""
    key = 0.618034 * normal[..., 0] + 1.414214 * normal[..., 1] + 1.732051 * normal[..., 2] + np.e * distance
    order = np.argsort(key, axis=1, kind="stable")
    ordered = np.take_along_axis(key, order, axis=1)
    first = np.ones(key.shape, dtype=bool)
    first[:, 1:] = ordered[:, 1:] != ordered[:, :-1]
    leader = np.maximum.accumulate(np.where(first, np.arange(key.shape[1]), 0), axis=1)
    plane = np.empty(key.shape, dtype=np.int16)
    np.put_along_axis(plane, order, np.take_along_axis(order, leader, axis=1).astype(np.int16), axis=1)
    return plane
