"""Compute how far geoms reach: the exact farthest point of a shape in a direction, from MuJoCo's model."""

from __future__ import annotations

import itertools

import mujoco
import numpy as np

from levade.arrays import Array

_SPHERE, _CAPSULE, _CYLINDER, _ELLIPSOID, _BOX, _MESH = (  # numbers, which compare ten times faster than enums
    int(getattr(mujoco.mjtGeom, f"mjGEOM_{name}"))
    for name in ("SPHERE", "CAPSULE", "CYLINDER", "ELLIPSOID", "BOX", "MESH")
)


def support(model: mujoco.MjModel, data: mujoco.MjData, geom: int, direction: Array) -> Array:
    """Find the point of a geom that is farthest in a direction.

    Args:
        model: The model.
        data: Its kinematics.
        geom: Id of the geom.
        direction: Direction in world axes, shape (3,).

    Returns:
        The point in the world [m], shape (3,).
    """
    rotation = data.geom_xmat[geom].reshape(3, 3)
    unit = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    return data.geom_xpos[geom] + rotation @ _farthest(model, geom, rotation.T @ unit)


def lowest(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> float:
    """Compute the height of a geom's lowest point in the world [m]: that of `support` downward, in less time.

    Args:
        model: The model.
        data: Its kinematics.
        geom: Id of the geom.
    """
    rotation = data.geom_xmat[geom].reshape(3, 3)
    return float(data.geom_xpos[geom][2] + (rotation @ _farthest(model, geom, -rotation[2]))[2])


def _farthest(model: mujoco.MjModel, geom: int, d: Array) -> Array:
    """Return the point that is farthest in a direction of unit length, both in the geom's frame, shape (3,)."""
    size, kind = model.geom_size[geom], int(model.geom_type[geom])
    sign = np.where(d < 0, -1.0, 1.0)
    if kind == _SPHERE:
        point = size[0] * d
    elif kind == _CAPSULE:
        point = size[0] * d + [0.0, 0.0, sign[2] * size[1]]
    elif kind == _CYLINDER:
        radial = float(np.hypot(d[0], d[1]))
        disc = size[0] * d[:2] / radial if radial > 1e-12 else np.zeros(2)
        point = np.array([*disc, sign[2] * size[1]])
    elif kind == _ELLIPSOID:
        point = size**2 * d / max(float(np.linalg.norm(size * d)), 1e-12)
    elif kind == _BOX:
        point = sign * size
    elif kind == _MESH:
        mesh = int(model.geom_dataid[geom])
        first = int(model.mesh_vertadr[mesh])
        vertices = model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])]
        point = vertices[int(np.argmax(vertices @ d))].astype(float)
    else:  # the box around it
        point = model.geom_aabb[geom, :3] + sign * model.geom_aabb[geom, 3:]
    return point


def reach(model: mujoco.MjModel, data: mujoco.MjData, geom: int, origin: Array) -> float:
    """Estimate how far a geom reaches from a point, by its farthest point in the direction of its centre.

    Args:
        model: The model.
        data: Its kinematics.
        geom: Id of the geom.
        origin: The point in the world [m], shape (3,).

    Returns:
        Distance [m].
    """
    away = data.geom_xpos[geom] - origin
    if np.linalg.norm(away) < 1e-9:
        return float(model.geom_rbound[geom])
    best = 0.0
    for _ in range(3):  # the direction of the farthest point leads to an even farther one
        point = support(model, data, geom, away)
        best, away = max(best, float(np.linalg.norm(point - origin))), point - origin
    return best


def thickness(model: mujoco.MjModel, geom: int) -> float:
    """Return the radius of a sphere or capsule; for other shapes, half their least extent.

    Args:
        model: The model.
        geom: Id of the geom.

    Returns:
        Thickness [m].
    """
    if model.geom_type[geom] in (int(mujoco.mjtGeom.mjGEOM_SPHERE), int(mujoco.mjtGeom.mjGEOM_CAPSULE)):
        return float(model.geom_size[geom, 0])
    return float(model.geom_aabb[geom, 3:].min())


def tip(model: mujoco.MjModel, data: mujoco.MjData, geom: int, joint: int) -> Array:
    """Find where a foot ends: at the centre of a sphere, otherwise at the point farthest from its joint.

    Args:
        model: The model.
        data: Its kinematics.
        geom: Id of the foot's geom.
        joint: Id of the foot's joint.

    Returns:
        The point in the world [m], shape (3,).
    """
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_SPHERE:
        return data.geom_xpos[geom].copy()
    away = data.geom_xpos[geom] - data.xanchor[joint]
    for _ in range(3):
        away = support(model, data, geom, away) - data.xanchor[joint]
    return data.xanchor[joint] + away


def balls(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Find balls that together have the same lowest point as a geom in any attitude.

    The result is exact for spheres, capsules, boxes, and shapes that are replaced by their bounding box. Others are sampled in
    a hundred directions, to a few per mille of their size.

    Args:
        model: The model.
        data: Its kinematics.
        geom: Id of the geom.

    Returns:
        Centres in the world and radii [m], shape (k, 4).
    """
    size, kind, place = model.geom_size[geom], int(model.geom_type[geom]), data.geom_xpos[geom]
    if kind == _SPHERE:
        return np.array([[*place, size[0]]])
    if kind == _CAPSULE:
        along = size[1] * data.geom_xmat[geom].reshape(3, 3)[:, 2]
        return np.array([[*(place + along), size[0]], [*(place - along), size[0]]])
    if kind == _BOX:
        points = place + (_CORNERS * size) @ data.geom_xmat[geom].reshape(3, 3).T
    else:
        points = np.unique([support(model, data, geom, direction).round(9) for direction in _DIRECTIONS], axis=0)
    return np.column_stack([points, np.zeros(len(points))])


def _spiral(n: int) -> Array:
    """Return evenly spread unit vectors, shape (n, 3)."""
    k = np.arange(n) + 0.5
    polar, azimuth = np.arccos(1 - 2 * k / n), np.pi * (1 + 5**0.5) * k
    return np.column_stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])


_DIRECTIONS = _spiral(100)
_CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
