"""Visuals: make visual meshes small enough to be part of every motion file."""

from __future__ import annotations

import mujoco
import numpy as np

from levade.arrays import Array
from levade.robots.meshes import cluster, stl
from levade.robots.reading import Draft

_SMALL = 150_000
"""Smaller meshes are kept unchanged [bytes]."""
_COARSE = ".coarse.stl"
"""What the names of coarse meshes end with."""


def thin_visuals(draft: Draft, model: mujoco.MjModel) -> None:
    """Replace large visual meshes by coarse ones, and drop textures, which no longer fit. Coarse ones stay as they are.

    Args:
        draft: The model; its spec and assets are changed.
        model: Model compiled from the draft's spec.
    """
    spec = draft.spec
    colliding = {geom.meshname for geom in spec.geoms if geom.meshname and (geom.contype or geom.conaffinity)}
    weighing = {geom.meshname for geom in spec.geoms if geom.meshname and not geom.parent.explicitinertial}
    for mesh in spec.meshes:
        content = draft.assets.get(mesh.file, b"")
        if mesh.name in colliding or mesh.name in weighing or len(content) <= _SMALL or mesh.file.endswith(_COARSE):
            continue
        triangles = _triangles(model, mesh.name)
        name = f"{mesh.name.replace('/', '-')}{_COARSE}"
        draft.assets[name] = stl(cluster(triangles))
        mesh.file, mesh.scale = name, [1.0, 1.0, 1.0]
        mesh.refpos, mesh.refquat = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # the surface need not be closed any more
    for material in spec.materials:
        if any(material.textures):
            material.textures = [""] * len(material.textures)
            if min(material.rgba[:3]) > 0.99:
                material.rgba = [0.62, 0.64, 0.67, material.rgba[3]]
    for texture in list(spec.textures):
        spec.delete(texture)
    spec.assets = draft.assets


def _triangles(model: mujoco.MjModel, name: str) -> Array:
    """Return the scaled triangles of a compiled mesh in the frame of its file [m], shape (n, 3, 3)."""
    i = model.mesh(name).id
    first, count = int(model.mesh_vertadr[i]), int(model.mesh_vertnum[i])
    face, faces = int(model.mesh_faceadr[i]), int(model.mesh_facenum[i])
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, model.mesh_quat[i].astype(float))
    vertices = model.mesh_vert[first : first + count].astype(float) @ rotation.reshape(3, 3).T + model.mesh_pos[i]
    return vertices[model.mesh_face[face : face + faces]]
