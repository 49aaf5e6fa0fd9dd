"""Describe the looks of a model for the page: shapes, colours and triangles. Only poses change later.

    shapes = shapes_of(model)
    shapes["geoms"][0]      # {"type": "capsule", "size": [0.022, 0.44], "body": 0, "pos", "quat", "material", "layer"}

body: index into ``bodies``, or -1 for what stands still, in world axes. pos [m] and quat x-y-z-w are in the frame of the body.
size: as in MuJoCo, half lengths and radii [m]. layer: "robot", "collision" or "scene".
"""

from __future__ import annotations

import hashlib
import json
import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.report.packing import pack
from levade.report.rendering import drawn_geoms
from levade.scenes.scene import GROUND

TRIANGLES = 60_000
"""Approximate largest number of triangles in all meshes. More make a page slow to open without looking better."""

Triangles = tuple[Array, NDArray[np.int64]]
"""A mesh: vertices [m], shape (n, 3), and numbers of vertices, shape (triangles, 3)."""

_TYPES = {
    mujoco.mjtGeom.mjGEOM_PLANE: "plane",
    mujoco.mjtGeom.mjGEOM_HFIELD: "mesh",
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
    mujoco.mjtGeom.mjGEOM_CAPSULE: "capsule",
    mujoco.mjtGeom.mjGEOM_ELLIPSOID: "ellipsoid",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_MESH: "mesh",
}

_SIZES = {"plane": 2, "sphere": 1, "capsule": 2, "ellipsoid": 3, "cylinder": 2, "box": 3, "mesh": 0}

_GREY = (0.5, 0.5, 0.5, 1.0)
"""MuJoCo's default colour."""

_PLAIN = ("#c9ced4", "#3c434b")
"""Two alternating colours, from the trunk outward, for robots without colours."""


def shapes_of(model: Any) -> dict[str, Any]:
    """Describe the drawn geoms of a model (`levade.report.rendering.drawn_geoms`), and its collision shapes.

    The result has ``bodies``, ``geoms``, ``materials``, ``meshes`` and ``key``, which identifies the shapes.

    Args:
        model: The model.

    Returns:
        The shapes, as JSON. Sizes and positions are in [m], and quaternions are x-y-z-w.
    """
    bodies = moving_bodies(model)
    places = {body: place for place, body in enumerate(bodies)}
    shown = drawn_geoms(model)
    touching = (model.geom_contype | model.geom_conaffinity) != 0
    materials: dict[tuple[Any, ...], int] = {}
    meshes: dict[tuple[str, int], int] = {}
    still = mujoco.MjData(model)
    mujoco.mj_kinematics(model, still)
    geoms = []
    for geom in range(model.ngeom):
        kind = _TYPES.get(mujoco.mjtGeom(int(model.geom_type[geom])))
        body = int(model.geom_bodyid[geom])
        fixed = body not in places
        if kind is None or not (shown[geom] or (touching[geom] and not fixed)):
            continue
        layer = "scene" if fixed else "robot" if shown[geom] else "collision"
        pos, quat = model.geom_pos[geom], model.geom_quat[geom]
        if fixed:
            pos, quat = still.geom_xpos[geom], np.empty(4)
            mujoco.mju_mat2Quat(quat, still.geom_xmat[geom])
        drawn = {
            "name": model.geom(geom).name,
            "type": kind,
            "size": _numbers(model.geom_size[geom][: _SIZES[kind]]),
            "body": places.get(body, -1),
            "pos": _numbers(pos),
            "quat": _numbers(np.roll(quat, -1)),
            "material": materials.setdefault(_material(model, geom), len(materials)),
            "layer": layer,
        }
        if kind == "mesh":
            which = "hfield" if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_HFIELD else "mesh"
            drawn["mesh"] = meshes.setdefault((which, int(model.geom_dataid[geom])), len(meshes))
        if fixed and model.geom(geom).name == GROUND:
            drawn["layer"] = "ground"
        geoms.append(drawn)
    shapes: dict[str, Any] = {
        "bodies": [model.body(body).name or f"body{body}" for body in bodies],
        "geoms": geoms,
        "materials": [dict(zip(("color", "opacity", "roughness", "metalness"), key, strict=True)) for key in materials],
        "meshes": _meshes(model, list(meshes)),
    }
    return shapes | {"key": hashlib.sha256(json.dumps(shapes).encode()).hexdigest()[:16]}


def moving_bodies(model: Any) -> list[int]:
    """List the bodies that can move and have a shape, in the model's order.

    Args:
        model: The model.

    Returns:
        Ids of the bodies.
    """
    bodies = np.unique(model.geom_bodyid)
    return [int(body) for body in bodies if model.body_weldid[body] != 0]


def _numbers(values: Array) -> list[float]:
    return [round(float(value), 6) + 0.0 for value in values]


def _material(model: Any, geom: int) -> tuple[str, float, float, float]:
    """Return colour, opacity, roughness and metalness of a geom: MuJoCo's material in the page's terms."""
    material = int(model.geom_matid[geom])
    rgba, roughness, metalness = model.geom_rgba[geom], 0.6, 0.05
    if material >= 0:
        rgba = model.mat_rgba[material] if tuple(rgba) == _GREY else rgba
        texture = model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB.value]
        if texture >= 0:
            rgba = np.append(rgba[:3] * _mean_colour(model, texture), rgba[3])
        specular, shininess = float(model.mat_specular[material]), float(model.mat_shininess[material])
        roughness = float(np.clip(0.85 - 0.6 * shininess, 0.2, 0.9))
        metalness = float(np.clip(1.4 * (specular - 0.3), 0.0, 0.9))
        if model.mat_roughness[material] >= 0:
            roughness = float(model.mat_roughness[material])
        if model.mat_metallic[material] >= 0:
            metalness = float(model.mat_metallic[material])
    elif tuple(rgba) == _GREY:
        colour = _PLAIN[_depth(model, int(model.geom_bodyid[geom])) % 2]
        return colour, 1.0, roughness, metalness
    return _hex(rgba), round(float(rgba[3]), 3), round(roughness, 3), round(metalness, 3)


def _depth(model: Any, body: int) -> int:
    """Count the joints between a body and its trunk."""
    depth = -1
    while body:
        depth += model.body_jntnum[body] > 0
        body = int(model.body_parentid[body])
    return max(depth, 0)


def _mean_colour(model: Any, texture: int) -> Array:
    start, channels = model.tex_adr[texture], model.tex_nchannel[texture]
    pixels = model.tex_width[texture] * model.tex_height[texture]
    return model.tex_data[start : start + pixels * channels].reshape(pixels, channels)[:, :3].mean(axis=0) / 255.0


def _hex(rgba: Array) -> str:
    return "#" + "".join(f"{round(255 * float(np.clip(value, 0, 1))):02x}" for value in rgba[:3])


def _meshes(model: Any, used: list[tuple[str, int]]) -> list[dict[str, Any]]:
    """Return vertices, as int16 within a box, and triangles of each used mesh."""
    triangles = [_height_field(model, number) if kind == "hfield" else _mesh(model, number) for kind, number in used]
    return [_packed(vertices, faces) for vertices, faces in simplify(triangles, TRIANGLES)]


def _mesh(model: Any, number: int) -> Triangles:
    vertex, face = model.mesh_vertadr[number], model.mesh_faceadr[number]
    vertices = model.mesh_vert[vertex : vertex + model.mesh_vertnum[number]].astype(float)
    return vertices, model.mesh_face[face : face + model.mesh_facenum[number]].astype(np.int64)


def _height_field(model: Any, number: int) -> Triangles:
    rows, columns = int(model.hfield_nrow[number]), int(model.hfield_ncol[number])
    across, along, top, _ = model.hfield_size[number]
    start = model.hfield_adr[number]
    height = top * model.hfield_data[start : start + rows * columns].reshape(rows, columns)
    y, x = np.meshgrid(np.linspace(-along, along, rows), np.linspace(-across, across, columns), indexing="ij")
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + columns + 1], axis=1)
    upper = np.stack([corner, corner + columns + 1, corner + columns], axis=1)
    return np.stack([x, y, height], axis=-1).reshape(-1, 3), np.concatenate([lower, upper])


def simplify(meshes: list[Triangles], triangles: int) -> list[Triangles]:
    """Simplify meshes to this many triangles in all: the vertices in one cell of a grid become one, their mean.

    Args:
        meshes: Vertices [m], shape (n, 3), and triangles, shape (m, 3), of each mesh.
        triangles: Largest number of triangles of all meshes together.

    Returns:
        The meshes in the same order. They are only welded if they already have few enough triangles.
    """
    reduced = [_welded(vertices, faces, 1e-7) for vertices, faces in meshes]
    if sum(len(faces) for _, faces in reduced) <= triangles:
        return reduced
    # a surface of area A in cells of edge c has about A / c^2 vertices, and twice as many triangles
    cell = 0.6 * math.sqrt(2.0 * sum(_area(vertices, faces) for vertices, faces in meshes) / triangles)
    while sum(len(faces) for _, faces in reduced) > triangles:
        cell *= 1.15
        reduced = [_welded(vertices, faces, cell) for vertices, faces in meshes]
    return reduced


def _area(vertices: Array, faces: NDArray[np.int64]) -> float:
    one, two, three = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(two - one, three - one), axis=1).sum()) / 2


def _welded(vertices: Array, faces: NDArray[np.int64], cell: float) -> Triangles:
    place = np.floor((vertices - vertices.min(axis=0)) / cell).astype(np.int64)
    size = place.max(axis=0) + 1
    key = (place[:, 0] * size[1] + place[:, 1]) * size[2] + place[:, 2]
    _, inverse, count = np.unique(key, return_inverse=True, return_counts=True)
    welded = np.stack([np.bincount(inverse, vertices[:, axis]) / count for axis in range(3)], axis=1)
    faces = inverse[faces]
    kept = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return welded, faces[kept]


def _packed(vertices: Array, faces: NDArray[np.int64]) -> dict[str, Any]:
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    scale = np.maximum(high - low, 1e-9) / 65535
    return {
        "low": low.tolist(),
        "scale": scale.tolist(),
        "vertices": pack(np.round((vertices - low) / scale), "u2"),
        "faces": pack(faces, "u2" if len(vertices) <= 65536 else "u4"),
    }
