"""Write the robot of a model as URDF: links, joints with limits and transmissions, inertias, and shapes.

    text = urdf(model, samples.joints, "hyq2max")                              # meshes become bounding boxes
    text = urdf(model, samples.joints, "go1", meshes=mesh_files(model))        # with `mesh_bytes` of each in these files

A description in a bag has no files next to it; one in a directory has. The scene does not matter: the same robot gives the same
text in every scene. Frames are those of `levade.exports.links`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from xml.etree import ElementTree as xml

import mujoco
import numpy as np

from levade.arrays import Array
from levade.exports.links import Link, links_of
from levade.exports.samples import Joints
from levade.rotations import roll_pitch_yaw, rotate

_NO_LIMIT = 1e9
"""URDF requires an effort and a velocity for every joint. This stands for no limit."""

_GREY = (0.5, 0.5, 0.5, 1.0)


def urdf(model: mujoco.MjModel, joints: Joints, name: str, *, meshes: Mapping[int, str] | None = None) -> str:
    """Write the robot of a model, without the scene.

    Args:
        model: Robot and scene.
        joints: Limits of the joints.
        name: Name of the robot.
        meshes: Mesh of the model -> its file. A mesh without a file becomes its bounding box.

    Returns:
        URDF.
    """
    links = links_of(model)
    root = xml.Element("robot", name=name)
    if meshes:  # for MuJoCo, which else looks for meshes by their name alone, and merges links that are fixed
        extension = xml.SubElement(root, "mujoco")
        xml.SubElement(extension, "compiler", strippath="false", fusestatic="false", discardvisual="false")
    for link in links:
        element = xml.SubElement(root, "link", name=link.name)
        if link.body is not None:
            _inertial(element, model, link)
            geoms = [int(geom) for geom in np.flatnonzero(model.geom_bodyid == link.body)]
            seen = [geom for geom in geoms if _seen(model, geom)]
            for geom in geoms:
                _shapes(element, model, geom, link.shift, meshes or {}, seen=geom in seen or not seen)
    for link in links:
        if link.parent is not None:
            _joint(root, model, joints, link, links[link.parent].name)
    for link in links:
        if link.joint is not None:
            _transmission(root, link.joint)
    xml.indent(root)
    return xml.tostring(root, encoding="unicode")


def mesh_files(model: mujoco.MjModel) -> dict[int, str]:
    """Choose a file for each mesh that the robot's shapes use.

    Args:
        model: Robot and scene.

    Returns:
        Index of the mesh in the model -> path next to the URDF.
    """
    used = {int(model.geom_dataid[geom]) for geom in range(model.ngeom) if _is_mesh(model, geom)}
    plain = {mesh: re.sub(r"[^A-Za-z0-9_-]", "_", model.mesh(mesh).name) for mesh in sorted(used)}
    return {mesh: f"meshes/{i}-{name}.stl" for i, (mesh, name) in enumerate(plain.items())}


def mesh_bytes(model: mujoco.MjModel, mesh: int) -> bytes:
    """Return a mesh of the model as binary STL, in MuJoCo's frame of the mesh.

    Args:
        model: Robot and scene.
        mesh: Index of the mesh in the model.

    Returns:
        Binary STL, lengths in [m].
    """
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    face, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    corners = model.mesh_vert[first : first + count][model.mesh_face[face : face + faces]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    table = np.zeros(faces, dtype=[("numbers", "<f4", (12,)), ("attribute", "<u2")])
    table["numbers"] = np.concatenate([normals[:, None], corners], axis=1).reshape(faces, 12)
    return b"\0" * 80 + np.array(faces, dtype="<u4").tobytes() + table.tobytes()


def shape_name(model: mujoco.MjModel, geom: int) -> str:
    """Return a name for a geom of the robot: its own, or that of its body with a number.

    Args:
        model: Robot and scene.
        geom: Index of the geom.

    Returns:
        The name.
    """
    body = int(model.geom_bodyid[geom])
    return model.geom(geom).name or f"{model.body(body).name or f'body{body}'}_shape{geom - model.body_geomadr[body]}"


def _is_mesh(model: mujoco.MjModel, geom: int) -> bool:
    return bool(model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and model.geom_bodyid[geom] != 0)


def _inertial(element: xml.Element, model: mujoco.MjModel, link: Link) -> None:
    body = link.body
    if model.body_mass[body] <= 0:
        return
    inertial = xml.SubElement(element, "inertial")
    _origin(inertial, link.shift + model.body_ipos[body], model.body_iquat[body])
    xml.SubElement(inertial, "mass", value=_text(model.body_mass[body]))
    ixx, iyy, izz = (_text(value) for value in model.body_inertia[body])
    xml.SubElement(inertial, "inertia", ixx=ixx, iyy=iyy, izz=izz, ixy="0", ixz="0", iyz="0")


def _seen(model: mujoco.MjModel, geom: int) -> bool:
    """Tell whether MuJoCo's viewers show a geom by default."""
    return bool(model.geom_group[geom] <= 2 and model.geom_rgba[geom, 3] > 0)


_Part = tuple[str, dict[str, str], Array]
"""A shape of URDF, its attributes, and its position in the link [m], shape (3,)."""


def _parts(model: mujoco.MjModel, geom: int, shift: Array, meshes: Mapping[int, str]) -> list[_Part]:
    """Split a geom into shapes of URDF: a capsule is a cylinder and two balls."""
    kind, size = model.geom_type[geom], model.geom_size[geom]
    place, quaternion = shift + model.geom_pos[geom], model.geom_quat[geom]
    sorts = mujoco.mjtGeom
    ball = "sphere", {"radius": _text(size[0])}
    bar = "cylinder", {"radius": _text(size[0]), "length": _text(2 * size[1])}
    end = rotate(quaternion, np.array([0.0, 0.0, size[1]]))
    if kind == sorts.mjGEOM_SPHERE:
        return [(*ball, place)]
    if kind == sorts.mjGEOM_CYLINDER:
        return [(*bar, place)]
    if kind == sorts.mjGEOM_CAPSULE:
        return [(*bar, place), (*ball, place + end), (*ball, place - end)]
    if kind == sorts.mjGEOM_BOX:
        return [("box", {"size": " ".join(_text(2 * edge) for edge in size)}, place)]
    if kind == sorts.mjGEOM_MESH and (file := meshes.get(int(model.geom_dataid[geom]))):
        return [("mesh", {"filename": file}, place)]
    middle, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    return [("box", {"size": " ".join(_text(2 * edge) for edge in half)}, place + rotate(quaternion, middle))]


def _shapes(
    element: xml.Element, model: mujoco.MjModel, geom: int, shift: Array, meshes: Mapping[int, str], *, seen: bool
) -> None:
    """Add a geom as visual if it is visible, and as collision if it collides."""
    collides = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
    collides |= geom in model.pair_geom1 or geom in model.pair_geom2
    name = shape_name(model, geom)
    for role in ["visual"] * seen + ["collision"] * collides:
        for i, (shape, attributes, position) in enumerate(_parts(model, geom, shift, meshes)):
            part = xml.SubElement(element, role, name=f"{name}_{i}" if i else name)
            _origin(part, position, model.geom_quat[geom])
            xml.SubElement(xml.SubElement(part, "geometry"), shape, attributes)
            if role == "visual":
                colour = xml.SubElement(part, "material", name=f"{name}_colour")
                rgba = model.geom_rgba[geom] if model.geom_rgba[geom, 3] > 0 else _GREY
                xml.SubElement(colour, "color", rgba=" ".join(_text(value) for value in rgba))


def _joint(root: xml.Element, model: mujoco.MjModel, joints: Joints, link: Link, parent: str) -> None:
    element = xml.SubElement(root, "joint", name=link.joint or f"{link.name}_fixed", type="fixed")
    xml.SubElement(element, "parent", link=parent)
    xml.SubElement(element, "child", link=link.name)
    _origin(element, link.position, link.quaternion)
    if link.joint is None:
        return
    i = joints.names.index(link.joint)
    bounded = bool(np.isfinite(joints.lower[i]) and np.isfinite(joints.upper[i]))
    element.set("type", "revolute" if bounded else "continuous")
    xml.SubElement(element, "axis", xyz=" ".join(_text(value) for value in link.axis))
    limits = {"lower": joints.lower[i], "upper": joints.upper[i]} if bounded else {}
    for name, limit in (("effort", joints.torque[i]), ("velocity", joints.velocity[i])):
        limits[name] = limit if np.isfinite(limit) else _NO_LIMIT
    xml.SubElement(element, "limit", {name: _text(value) for name, value in limits.items()})
    dof = model.joint(link.joint).dofadr[0]
    passive = {"damping": model.dof_damping[dof], "friction": model.dof_frictionloss[dof]}
    xml.SubElement(element, "dynamics", {name: _text(value) for name, value in passive.items()})


def _transmission(root: xml.Element, joint: str) -> None:
    """Add a motor that turns the joint one to one, as ros_control's effort interfaces expect."""
    element = xml.SubElement(root, "transmission", name=f"{joint}_transmission")
    xml.SubElement(element, "type").text = "transmission_interface/SimpleTransmission"
    driven = xml.SubElement(element, "joint", name=joint)
    motor = xml.SubElement(element, "actuator", name=f"{joint}_motor")
    for part in (driven, motor):
        xml.SubElement(part, "hardwareInterface").text = "hardware_interface/EffortJointInterface"
    xml.SubElement(motor, "mechanicalReduction").text = "1"


def _origin(element: xml.Element, position: Array, quaternion: Array) -> None:
    xyz = " ".join(_text(value) for value in position)
    xml.SubElement(element, "origin", xyz=xyz, rpy=" ".join(_text(value) for value in roll_pitch_yaw(quaternion)))


def _text(value: float) -> str:
    return f"{float(value):.12g}"
