"""Collision shapes: each a geom of a MuJoCo model, placed on a link, with its enclosing box."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError

_KIND = mujoco.mjtGeom
_PRIMITIVES = {
    int(_KIND.mjGEOM_PLANE): "plane",
    int(_KIND.mjGEOM_SPHERE): "sphere",
    int(_KIND.mjGEOM_CAPSULE): "capsule",
    int(_KIND.mjGEOM_CYLINDER): "cylinder",
    int(_KIND.mjGEOM_BOX): "box",
    int(_KIND.mjGEOM_MESH): "convex",
}


@dataclass(frozen=True, eq=False)
class Hull:
    """A convex hull.

    Attributes:
        points: Corners [m], shape (V, 3).
        planes: Planes with outward normals, shape (F, 4).
        polygons: The polygons as ODE reads them: for each, the number of its corners and their indices.
    """

    points: Array
    planes: Array
    polygons: NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Shape:
    """A shape.

    Attributes:
        kind: Sphere, capsule, cylinder, box, plane or convex.
        size: As MuJoCo has it [m].
        link: -1 for the world. position (3,) [m], rotation (3, 3): in the link's frame, or the world. core (3,) [m],
            half edges, and radius [m]: a box, rounded, that encloses the shape; a plane has none.
        body: Of the model.
        geom: Of the model.
        hull: Of a convex one.
    """

    kind: str
    size: Array
    link: int
    position: Array
    rotation: Array
    core: Array
    radius: float
    body: int
    geom: int
    hull: Hull | None = None


def shape_of(model: mujoco.MjModel, data: mujoco.MjData, geom: int, link: int, root: int) -> Shape:
    """Make the shape of a geom on a link whose frame is that of the body ``root``.

    Args:
        model: The compiled model.
        data: Data with computed kinematics.
        geom: The geom.
        link: The link.
        root: The body of the link's frame.

    Returns:
        The shape.

    Raises:
        LevadeError: If ODE lacks its kind. The message names the geom.
    """
    kind = _PRIMITIVES.get(int(model.geom_type[geom]))
    if kind is None or (kind == "plane" and link >= 0):
        what = str(_KIND(int(model.geom_type[geom])).name).removeprefix("mjGEOM_").lower()
        raise LevadeError(
            f"geom {_name(model, geom)}: the engine ode has no {what}{' that moves' if kind else ''};"
            " boxes, spheres, capsules, cylinders and meshes (by their convex hulls) will do"
        )
    frame, origin = data.xmat[root].reshape(3, 3), data.xpos[root]
    size = model.geom_size[geom].copy()
    core, radius = np.zeros(3), 0.0
    if kind in ("sphere", "capsule"):
        radius = float(size[0])
        core[2] = size[1] if kind == "capsule" else 0.0
    elif kind != "plane":  # MuJoCo's own bounding box, made symmetric about the geom's frame
        aabb = model.geom_aabb[geom]
        core = np.abs(aabb[:3]) + aabb[3:]
    return Shape(
        kind=kind,
        size=size,
        link=link,
        position=frame.T @ (data.geom_xpos[geom] - origin),
        rotation=frame.T @ data.geom_xmat[geom].reshape(3, 3),
        core=core,
        radius=radius,
        body=int(model.geom_bodyid[geom]),
        geom=geom,
        hull=_hull(model, geom) if kind == "convex" else None,
    )


def _hull(model: mujoco.MjModel, geom: int) -> Hull:
    """Return the polygons of the convex hull that MuJoCo computed when it compiled the mesh."""
    mesh = int(model.geom_dataid[geom])
    first, count = int(model.mesh_polyadr[mesh]), int(model.mesh_polynum[mesh])
    if not count:
        raise LevadeError(f"geom {_name(model, geom)}: its mesh has no convex hull, which the engine ode wants")
    polygons = []
    for i in range(first, first + count):
        start = int(model.mesh_polyvertadr[i])
        polygons.append(model.mesh_polyvert[start : start + int(model.mesh_polyvertnum[i])])
    used, local = np.unique(np.concatenate(polygons), return_inverse=True)
    points = model.mesh_vert[model.mesh_vertadr[mesh] + used].astype(float)
    normals = model.mesh_polynormal[first : first + count].astype(float)
    planes, words, at = [], [], 0
    for polygon, normal in zip(polygons, normals, strict=True):
        corners = local[at : at + len(polygon)]
        at += len(polygon)
        planes.append([*normal, np.max(points[corners] @ normal)])
        words += [len(corners), *corners]
    return Hull(points, np.array(planes), np.array(words, dtype=np.uint32))


def _name(model: mujoco.MjModel, geom: int) -> str:
    name = model.geom(geom).name
    return name or f"{geom} of body {model.body(int(model.geom_bodyid[geom])).name}"
