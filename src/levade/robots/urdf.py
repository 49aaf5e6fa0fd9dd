"""URDF: repair the files that robot makers publish, so that MuJoCo's own URDF reader accepts them.

The reader then makes the bodies. Links that are fixed to another are fused with it (mass, inertia and shapes), and the root
link gets a free joint. The findings list each repair and its reason.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.robots.findings import Finding, named, note, some, warning
from levade.robots.inertias import lifted
from levade.robots.loops import Coupling
from levade.robots.magnitudes import LARGEST
from levade.robots.meshes import coarse, find_mesh, read_mesh

_WORLD = "levade-world"
_NAME_OF_WORLD = "world"
_DUMMY = 1e-4
"""Links with less mass are markers for some parser, not bodies [kg]."""
_LARGE_VISUAL, _HUGE_VISUAL = 1_500_000, 12_000_000
"""Sizes above which visual meshes become coarse, and above which they are not even read [bytes]."""
_SMALLEST = 1e-4
"""Bodies with a smaller radius of gyration count as having no inertia [m]."""
_KNOWN_JOINTS = ("revolute", "continuous", "prismatic", "fixed")


@dataclass
class UrdfSource:
    """Holds a repaired URDF.

    Attributes:
        text: Text for MuJoCo's reader, in which meshes have unique names without folders.
        assets: Name -> content of a mesh.
        effort: Joint -> torque limit [Nm], if the file has a positive one.
        velocity: Joint -> speed limit [rad/s], if the file has a positive one.
        couplings: Joints that mimic others.
        findings: What was repaired or left out.
        files: Mesh file -> result of `read_mesh`.
    """

    text: str
    assets: dict[str, bytes] = field(default_factory=dict)
    effort: dict[str, float] = field(default_factory=dict)
    velocity: dict[str, float] = field(default_factory=dict)
    couplings: list[Coupling] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    files: dict[Path, tuple[str, bytes]] = field(default_factory=dict)


def read_urdf(path: Path, root: ET.Element) -> UrdfSource:
    """Repair a URDF.

    Args:
        path: Path of the file.
        root: Root of its XML; it is changed.

    Returns:
        The repaired URDF.

    Raises:
        LevadeError: If the robot cannot be simulated; the message names link or joint and the remedy.
    """
    if any(element.tag.startswith("{") and "xacro" in element.tag for element in root.iter()):
        raise LevadeError(f"{path}: still contains xacro macros; expand them first: xacro {path.name} > robot.urdf")
    source = UrdfSource("")
    for extra in [*root.findall("transmission"), *root.findall("gazebo"), *root.findall("ros2_control")]:
        root.remove(extra)
    links = {_name(link, path): link for link in root.findall("link")}
    if not links:
        raise LevadeError(f"{path}: has no links; give the URDF of a robot")
    joints = {_name(joint, path): joint for joint in root.findall("joint")}
    parents = _tree(path, links, joints)
    roots = [name for name in links if name not in parents]
    if len(roots) != 1:
        raise LevadeError(
            f"{path}: has {len(roots)} root links ({', '.join(roots[:3]) or 'a loop'}); it should have one"
        )
    folders = _mesh_folders(path, root)
    base = _real_root(path, root, links, joints, roots[0], source.findings)
    parents = {_link(joint, "child"): name for name, joint in joints.items()}
    _check_joints(path, joints, source)
    losses: dict[str, list[tuple[str, str]]] = {}
    mended: dict[str, dict[str, float]] = {}
    without: list[str] = []
    _name_shapes_apart(links)
    for name, link in links.items():
        fixed = name == base or joints[parents[name]].get("type") == "fixed"
        if link.find("inertial") is None and not fixed:
            without.append(name)
        problem, moment = _mend_inertial(path, name, link)
        if problem:
            mended.setdefault(problem, {})[name] = moment
        _mend_shapes(path, name, link, source, losses, folders)
    if without:
        remedy = "give it mass and inertia, otherwise the motion is not that of the robot"
        source.findings.append(warning(named("link", without), "no inertial", remedy))
    source.findings += [_replaced(problem, moments) for problem, moments in mended.items()]
    source.findings += [_lost(kind, links_and_problems) for kind, links_and_problems in losses.items()]
    _add_floating_base(root, base)
    _say_how_to_compile(root)
    source.text = ET.tostring(root, encoding="unicode")
    return source


def _name(element: ET.Element, path: Path) -> str:
    name = element.get("name")
    if not name:
        raise LevadeError(f"{path}: a <{element.tag}> has no name; every link and joint needs one")
    return name


def _tree(path: Path, links: dict[str, ET.Element], joints: dict[str, ET.Element]) -> dict[str, str]:
    """Map each link to the joint on which it hangs."""
    parents: dict[str, str] = {}
    for name, joint in joints.items():
        for end in ("parent", "child"):
            element = joint.find(end)
            link = None if element is None else element.get("link")
            if link not in links:
                raise LevadeError(f"{path}: joint {name}: its {end} link {link!r} is not in the file")
            if end == "child":
                if link in parents:
                    raise LevadeError(
                        f"{path}: link {link} hangs on two joints, {parents[link]} and {name}; levade simulates trees only"
                    )
                parents[link] = name
    for start in links:
        link, seen = start, {start}
        while link in parents:
            link = _link(joints[parents[link]], "parent")
            if link in seen:
                raise LevadeError(
                    f"{path}: joint {parents[link]}: link {link} hangs on itself; levade simulates trees only"
                )
            seen.add(link)
    return parents


def _real_root(
    path: Path,
    root: ET.Element,
    links: dict[str, ET.Element],
    joints: dict[str, ET.Element],
    base: str,
    findings: list[Finding],
) -> str:
    """Return the link that floats, skipping a "world" to which the file ties the robot by a floating or fixed joint."""
    while True:
        hanging = {name: joint for name, joint in joints.items() if _link(joint, "parent") == base}
        bare = links[base].find("inertial") is None and links[base].find("collision") is None
        loose = all(joint.get("type") in ("floating", "fixed") for joint in hanging.values())
        if base.lower() == _NAME_OF_WORLD and hanging and loose:
            carriers = [name for name in hanging if _carries_joints(joints, name)] or list(hanging)[:1]
            if len(carriers) > 1:
                names = [_link(joints[name], "child") for name in carriers]
                raise LevadeError(f"{path}: link {base} carries {len(names)} robots ({some(names)}); keep one of them")
            beside = [link for name in hanging if name != carriers[0] for link in _remove(root, links, joints, name)]
            if beside:
                findings.append(note(named("link", beside), f"fixed to the {base}, left out: not part of the robot"))
            (name,) = carriers
        elif bare and len(hanging) == 1 and [joint.get("type") for joint in hanging.values()] == ["floating"]:
            (name,) = hanging
        else:
            break
        child = _link(joints[name], "child")
        root.remove(links.pop(base))
        root.remove(joints.pop(name))
        base = child
    if bare and base.lower() == _NAME_OF_WORLD and hanging:
        raise LevadeError(
            f"{path}: joint {next(iter(hanging))} moves the robot against the link {base}, so that it does not float"
            " freely; make that joint floating or fixed"
        )
    return _rename_worlds(links, joints, base)


def _rename_worlds(links: dict[str, ET.Element], joints: dict[str, ET.Element], base: str) -> str:
    """Rename a link that is called world, since MuJoCo's reader would confuse it with its own world."""
    if _NAME_OF_WORLD not in links:
        return base
    name = next(n for n in (f"{_NAME_OF_WORLD}{'_' * k}link" for k in range(1, len(links) + 2)) if n not in links)
    renamed = {name if link == _NAME_OF_WORLD else link: element for link, element in links.items()}
    links.clear()
    links.update(renamed)
    links[name].set("name", name)
    for joint in joints.values():
        for end in ("parent", "child"):
            element = joint.find(end)
            if element is not None and element.get("link") == _NAME_OF_WORLD:
                element.set("link", name)
    return name if base == _NAME_OF_WORLD else base


def _carries_joints(joints: dict[str, ET.Element], name: str) -> bool:
    """Tell whether anything beyond a joint moves."""
    return any(joints[further].get("type") != "fixed" for further in _beyond(joints, name))


def _beyond(joints: dict[str, ET.Element], name: str) -> list[str]:
    """Return the joints that a joint carries."""
    found, waiting = [], [_link(joints[name], "child")]
    while waiting:
        link = waiting.pop()
        further = [other for other, joint in joints.items() if _link(joint, "parent") == link]
        found += further
        waiting += [_link(joints[other], "child") for other in further]
    return found


def _remove(root: ET.Element, links: dict[str, ET.Element], joints: dict[str, ET.Element], name: str) -> list[str]:
    """Remove a joint and what it carries from the file, and return the names of the removed links."""
    gone = []
    for joint in [name, *_beyond(joints, name)]:
        element = joints.pop(joint)
        link = _link(element, "child")
        root.remove(element)
        root.remove(links.pop(link))
        gone.append(link)
    return gone


def _link(joint: ET.Element, end: str) -> str:
    element = joint.find(end)
    return "" if element is None else element.get("link", "")


def _check_joints(path: Path, joints: dict[str, ET.Element], source: UrdfSource) -> None:
    for name, joint in joints.items():
        kind = joint.get("type", "")
        if kind not in _KNOWN_JOINTS:
            raise LevadeError(
                f"{path}: joint {name}: type {kind!r} cannot be simulated; use one of {', '.join(_KNOWN_JOINTS)}"
            )
        mimic = joint.find("mimic")
        if mimic is not None:
            joint.remove(mimic)
            if kind != "fixed":
                source.couplings.append(_mimicry(path, name, mimic, joints, source.findings))
        limit = joint.find("limit")
        if limit is None and kind == "revolute":
            limit = ET.SubElement(joint, "limit")
        if limit is None or kind == "fixed":
            continue
        for key, table in (("effort", source.effort), ("velocity", source.velocity)):
            value = _number(limit.get(key), f"{path}: joint {name}: limit {key}")
            if value is not None and 0 < value < math.inf:
                table[name] = value
        lower = _number(limit.get("lower"), f"{path}: joint {name}: limit lower")
        upper = _number(limit.get("upper"), f"{path}: joint {name}: limit upper")
        if kind == "revolute" and lower is not None and upper is not None and lower > upper:
            raise LevadeError(
                f"{path}: joint {name}: limits are inverted, lower {lower:g} is above upper {upper:g}; exchange them"
            )
        if kind == "revolute" and (lower or 0.0) == (upper or 0.0):
            if lower:
                raise LevadeError(
                    f"{path}: joint {name}: limits leave it no room, both are {lower:g}; give a range, or make it fixed"
                )
            joint.set("type", "continuous")


def _mimicry(
    path: Path, name: str, mimic: ET.Element, joints: dict[str, ET.Element], findings: list[Finding]
) -> Coupling:
    where = f"{path}: joint {name}: mimic"
    leader = mimic.get("joint", "")
    slope, offset = (_number(mimic.get(key), f"{where} {key}") for key in ("multiplier", "offset"))
    if leader not in joints or leader == name:
        hint = did_you_mean(leader, set(joints) - {name})
        findings.append(
            warning(f"joint {name}", f"mimics {leader!r}, which is not another joint of the file: held fixed", hint)
        )
        return Coupling(name, "", (offset or 0.0,), "<mimic>")
    return Coupling(name, leader, (offset or 0.0, 1.0 if slope is None else slope), "<mimic>")


def _mend_inertial(path: Path, name: str, link: ET.Element) -> tuple[str, float]:
    """Replace an inertia that no body can have. Return what was wrong with it, and the moment that replaces it [kg m2]."""
    inertial = link.find("inertial")
    if inertial is None:
        return "", 0.0
    mass_element, inertia = inertial.find("mass"), inertial.find("inertia")
    mass = _number(None if mass_element is None else mass_element.get("value"), f"{path}: link {name}: mass") or 0.0
    if mass < 0:
        raise LevadeError(f"{path}: link {name}: mass {mass:g} kg is negative")
    if mass <= _DUMMY:
        link.remove(inertial)
        return "", 0.0
    if inertia is None:
        raise LevadeError(
            f"{path}: link {name}: has a mass but no <inertia>; give it, [kg m2] about its centre of mass"
        )
    xx, yy, zz, xy, xz, yz = (
        _number(inertia.get(key), f"{path}: link {name}: inertia {key}") or 0.0
        for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    )
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if not (mass <= LARGEST and (np.abs(tensor) <= LARGEST).all()):
        raise LevadeError(f"{path}: link {name}: mass and inertia should be at most {LARGEST:g}, in kg and kg m2")
    principal = np.linalg.eigvalsh(tensor)
    least = mass * _SMALLEST**2
    if principal[0] > least and principal[0] + principal[1] >= principal[2] * (1 + 1e-6):
        return "", 0.0
    edge = lifted(tensor) if principal[2] > least else None
    if edge is not None:
        for (i, k), key in zip(((0, 0), (1, 1), (2, 2)), ("ixx", "iyy", "izz"), strict=True):
            inertia.set(key, repr(float(edge[i, k])))
        return "", 0.0
    # an impossible inertia becomes that of a sphere with the same mean, or of a sphere of water if there is none at all
    mean = float(np.mean(np.diag(tensor)))
    mended = mean if mean > least else 0.4 * mass * (0.75 * mass / (math.pi * 1000)) ** (2 / 3)
    for key in ("ixx", "iyy", "izz"):
        inertia.set(key, repr(mended))
    for key in ("ixy", "ixz", "iyz"):
        inertia.set(key, "0")
    if principal[0] <= least:
        return "is not positive" if principal[0] <= 0 else "is that of a point", mended
    return "breaks the triangle inequality (two of its moments are below the third)", mended


def _replaced(problem: str, moments: dict[str, float]) -> Finding:
    low, high = min(moments.values()), max(moments.values())
    taken = f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"
    what = f"the inertia {problem}; {taken} kg m2 is taken about every axis"
    return warning(named("link", list(moments)), what, "fix it in the file")


def _name_shapes_apart(links: dict[str, ET.Element]) -> None:
    """Remove names that several shapes share, since the reader would complain on standard error."""
    taken: set[str] = set()
    for link in links.values():
        for shape in [*link.findall("collision"), *link.findall("visual")]:
            name = shape.attrib.pop("name", "")
            if name and name not in taken:
                taken.add(name)
                shape.set("name", name)


def _mend_shapes(
    path: Path,
    name: str,
    link: ET.Element,
    source: UrdfSource,
    losses: dict[str, list[tuple[str, str]]],
    folders: list[Path],
) -> None:
    """Attach the content of meshes, and leave out those that cannot be read."""
    collisions = link.findall("collision")
    primitives = [shape for shape in collisions if shape.find("geometry/mesh") is None]
    for kind, shapes in (("visual", link.findall("visual")), ("collision", collisions)):
        for shape in shapes:
            geometry = shape.find("geometry")
            mesh = None if geometry is None else geometry.find("mesh")
            if geometry is None or len(geometry) == 0:
                link.remove(shape)
                continue
            if mesh is None:
                continue
            problem = _attach_mesh(path, mesh, source, folders, visual=kind == "visual")
            if problem is None:
                continue
            link.remove(shape)
            loss = "visual" if kind == "visual" else "part" if primitives else "whole"
            losses.setdefault(loss, []).append((name, problem))


def _lost(kind: str, losses: list[tuple[str, str]]) -> Finding:
    """Make one finding for all links that lost a mesh in the same way."""
    names = list(dict.fromkeys(name for name, _ in losses))
    problem = losses[0][1]
    where = named("link", names)
    if kind == "visual":
        return note(where, f"not shown as meshes: {problem}")
    if kind == "part":
        return warning(where, f"collides as primitives only: {problem}", "put the files where the URDF says")
    return warning(
        where,
        f"collides with nothing: {problem}",
        "put the files where the URDF says, or give the links collision primitives",
    )


def _mesh_folders(path: Path, root: ET.Element) -> list[Path]:
    """Return where MuJoCo looks for meshes: in the folder that the URDF's MuJoCo extension names, and next to the file."""
    compiler = root.find("mujoco/compiler")
    named = [] if compiler is None else [compiler.get(key) for key in ("meshdir", "assetdir")]
    return [path.parent / folder for folder in (*filter(None, named), "")]


def _attach_mesh(path: Path, mesh: ET.Element, source: UrdfSource, folders: list[Path], *, visual: bool) -> str | None:
    """Attach the mesh's content; return the reason if it cannot be read."""
    reference = mesh.get("filename", "")
    bare = PurePosixPath(reference.replace("\\", "/")).name
    also = [folder / name for folder in folders for name in (reference, bare) if name]
    place = find_mesh(reference, path.parent, also)
    if place is None:
        return f"{reference} is missing"
    scale = mesh.get("scale", "1 1 1")
    if visual and place.stat().st_size > _HUGE_VISUAL:
        return f"{place.name} is large ({place.stat().st_size / 1e6:.1f} MB)"
    try:
        if (
            place not in source.files
        ):  # most files are named several times: as visual and collision mesh, and by every leg
            source.files[place] = read_mesh(place)
        suffix, content = source.files[place]
    except LevadeError as error:
        return str(error)
    except OSError as error:
        return f"{place.name} cannot be read ({error.strerror})"
    if visual and suffix == ".stl" and len(content) > _LARGE_VISUAL:
        content = coarse(content)
    # MuJoCo names a mesh asset after its file: one file for each scale and content
    for known, other in source.assets.items():
        if other == content and known.split("@")[-1] == f"{scale}{suffix}".replace(" ", "_"):
            mesh.set("filename", known)
            return None
    name = f"{place.stem}-{len(source.assets)}@{scale}{suffix}".replace(" ", "_")
    source.assets[name] = content
    mesh.set("filename", name)
    return None


def _add_floating_base(root: ET.Element, base: str) -> None:
    ET.SubElement(root, "link", name=_WORLD)
    joint = ET.SubElement(root, "joint", name="root", type="floating")
    ET.SubElement(joint, "parent", link=_WORLD)
    ET.SubElement(joint, "child", link=base)


def _say_how_to_compile(root: ET.Element) -> None:
    extension = root.find("mujoco")
    if extension is None:
        extension = ET.SubElement(root, "mujoco")
    compiler = extension.find("compiler")
    if compiler is None:
        compiler = ET.SubElement(extension, "compiler")
    for key in ("meshdir", "texturedir", "assetdir"):
        compiler.attrib.pop(key, None)
    compiler.attrib.update(
        fusestatic="true", discardvisual="false", strippath="false", inertiafromgeom="false", balanceinertia="false"
    )


def _number(text: str | None, where: str) -> float | None:
    if text is None:
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise LevadeError(f"{where}: {text!r} is not a number")
    return value
