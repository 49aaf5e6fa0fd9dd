"""The robot as URDF, made from its model: links, joints with their limits, inertias, and shapes.

A mesh is the box round it: a description that travels in a bag cannot bring files along. Frames are those of
`levade.export.links`.
"""

from __future__ import annotations

from xml.etree import ElementTree as xml

import mujoco
import numpy as np

from levade.arrays import Array
from levade.export.links import Link, links_of
from levade.export.samples import Joints
from levade.rotations import roll_pitch_yaw, rotate

_NO_LIMIT = 1e9
"""URDF wants an effort and a velocity for every joint: where the robot gives none, more than any joint has."""

_GREY = (0.5, 0.5, 0.5, 1.0)


def urdf(model: mujoco.MjModel, joints: Joints, name: str) -> str:
    """URDF of the robot in a model, without the scene."""
    links = links_of(model)
    root = xml.Element("robot", name=name)
    for link in links:
        element = xml.SubElement(root, "link", name=link.name)
        if link.body is not None:
            _inertial(element, model, link)
            geoms = [int(geom) for geom in np.flatnonzero(model.geom_bodyid == link.body)]
            seen = [geom for geom in geoms if _seen(model, geom)]
            for geom in geoms:
                _shapes(element, model, geom, link.shift, seen=geom in seen or not seen)
    for link in links:
        if link.parent is not None:
            _joint(root, model, joints, link, links[link.parent].name)
    xml.indent(root)
    return xml.tostring(root, encoding="unicode")


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
    """Whether MuJoCo's viewers show it at first."""
    return bool(model.geom_group[geom] <= 2 and model.geom_rgba[geom, 3] > 0)


def _shapes(element: xml.Element, model: mujoco.MjModel, geom: int, shift: Array, *, seen: bool) -> None:
    """A geom as visual if it is seen, and as collision if it takes part in any; a capsule is a cylinder and two balls."""
    kind, size = model.geom_type[geom], model.geom_size[geom]
    place, quaternion = shift + model.geom_pos[geom], model.geom_quat[geom]
    sorts = mujoco.mjtGeom
    ball: tuple[str, dict[str, str]] = ("sphere", {"radius": _text(size[0])})
    bar: tuple[str, dict[str, str]] = ("cylinder", {"radius": _text(size[0]), "length": _text(2 * size[1])})
    end = rotate(quaternion, np.array([0.0, 0.0, size[1]]))
    parts: list[tuple[tuple[str, dict[str, str]], Array]] = []
    if kind == sorts.mjGEOM_SPHERE:
        parts = [(ball, place)]
    elif kind == sorts.mjGEOM_CYLINDER:
        parts = [(bar, place)]
    elif kind == sorts.mjGEOM_CAPSULE:
        parts = [(bar, place), (ball, place + end), (ball, place - end)]
    elif kind == sorts.mjGEOM_BOX:
        parts = [(("box", {"size": " ".join(_text(2 * edge) for edge in size)}), place)]
    else:
        middle, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        box = {"size": " ".join(_text(2 * edge) for edge in half)}
        parts = [(("box", box), place + rotate(quaternion, middle))]
    collides = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
    for role in ["visual"] * seen + ["collision"] * collides:
        for (shape, attributes), position in parts:
            part = xml.SubElement(element, role)
            _origin(part, position, quaternion)
            xml.SubElement(xml.SubElement(part, "geometry"), shape, attributes)
            if role == "visual":
                colour = xml.SubElement(part, "material", name=f"colour{geom}")
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


def _origin(element: xml.Element, position: Array, quaternion: Array) -> None:
    xyz = " ".join(_text(value) for value in position)
    xml.SubElement(element, "origin", xyz=xyz, rpy=" ".join(_text(value) for value in roll_pitch_yaw(quaternion)))


def _text(value: float) -> str:
    return f"{float(value):.12g}"
