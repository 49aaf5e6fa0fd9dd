"""Assets: find and read the meshes, height fields and textures of a model. Leave out those that cannot be read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.files import is_pointer, pointer_problem
from levade.robots.findings import Finding, named, note, warning
from levade.robots.meshes import find_mesh, read_mesh

if TYPE_CHECKING:
    from levade.robots.reading import Draft

_REMEDY = "put the file where it says"


class Losses:
    """Collects what was left out because files cannot be read, to make one finding of each kind."""

    def __init__(self) -> None:
        self._bodies: dict[str, dict[str, str]] = {}

    def add(self, kind: str, body: str, problem: str) -> None:
        """Note a file that was left out.

        Args:
            kind: What the body lost: "whole", "part" (of its collision shapes), "visual" or "texture".
            body: Name of the body.
            problem: What is wrong with the file.
        """
        self._bodies.setdefault(kind, {}).setdefault(body, problem)

    def findings(self) -> list[Finding]:
        """Return warnings about bodies that collide differently, and notes about those that look different."""
        return [self._finding(kind, bodies) for kind, bodies in self._bodies.items()]

    def _finding(self, kind: str, bodies: dict[str, str]) -> Finding:
        names, problem = list(bodies), next(iter(bodies.values()))
        more = len(set(bodies.values())) - 1
        problem += f" and {more} more" if more else ""
        where = named("texture" if kind == "texture" else "body", names)
        verb = "collides" if len(names) == 1 else "collide"
        if kind == "whole":
            return warning(
                where, f"{verb} with nothing, {problem}", f"{_REMEDY}, or give the body a collision primitive"
            )
        if kind == "part":
            return warning(
                where, f"{verb} as {'its' if len(names) == 1 else 'their'} other geoms only, {problem}", _REMEDY
            )
        if kind == "visual":
            return note(where, f"not shown as {'its mesh' if len(names) == 1 else 'meshes'}, {problem}")
        return note(where, f"not shown, {problem}")


def read_assets(draft: Draft, folders: Sequence[Path]) -> None:
    """Read the files that an MJCF names into the draft's assets. Leave out unreadable ones that the physics does not need.

    Args:
        draft: The model; its spec and assets are changed.
        folders: Folders of the MJCF and of the files that it includes and attaches.

    Raises:
        LevadeError: If an inertia comes from a mesh that cannot be read.
    """
    spec, losses = draft.spec, Losses()
    names: dict[Path, str] = {}
    for kind in ("meshes", "hfields", "textures"):
        for element in list(getattr(spec, kind)):
            files = [file for file in (element.file, *getattr(element, "cubefiles", ())) if file]
            if not files:
                continue
            place = _find(element, spec, folders, kind) if element.file else None
            element.name = element.name or Path(files[0]).stem
            problem = None if place is not None else f"missing: {files[0]}"
            if place is not None and place not in names:
                try:
                    suffix, content = _read(place, kind)
                    stem = f"{place.stem}{suffix}"
                    names[place] = stem if stem not in draft.assets else f"{len(draft.assets)}-{stem}"
                    draft.assets[names[place]] = content
                except (LevadeError, OSError) as error:
                    problem = str(error)
            if problem is None and place is not None:
                element.file = names[place]
            else:
                _do_without(draft, kind, element, problem or "", losses)
    spec.meshdir = spec.texturedir = ""
    for element in [*spec.meshes, *spec.hfields, *spec.textures]:
        element.compiler.meshdir = element.compiler.texturedir = ""
    spec.assets = draft.assets
    draft.findings += losses.findings()


def compile_readable(draft: Draft) -> mujoco.MjModel:
    """Compile a model. Leave out files that MuJoCo cannot read, unless the physics needs them.

    Args:
        draft: The model; its spec may be changed.

    Returns:
        The compiled model.

    Raises:
        LevadeError: If the model cannot be compiled.
    """
    try:
        return draft.compile()
    except LevadeError as error:
        first, losses, spec = error, Losses(), draft.spec
    unreadable = [("meshes", mesh, _problem(draft, mesh)) for mesh in spec.meshes if mesh.file]
    unreadable += [("textures", texture, _problem(draft, texture)) for texture in spec.textures if texture.file]
    unreadable = [(kind, element, problem) for kind, element, problem in unreadable if problem]
    if not unreadable:
        raise first
    for kind, element, problem in unreadable:
        _do_without(draft, kind, element, problem, losses)
    model = draft.compile()
    draft.findings += losses.findings()
    return model


def _find(element, spec: mujoco.MjSpec, folders: Sequence[Path], kind: str) -> Path | None:
    """Return where MuJoCo finds the file of an element. Attached models have their own folder and meshdir."""
    of_element = element.compiler.texturedir if kind == "textures" else element.compiler.meshdir
    of_spec = spec.texturedir if kind == "textures" else spec.meshdir
    bare = PurePosixPath(element.file.replace("\\", "/")).name
    places = [
        folder / inner / name
        for name in (element.file, bare)
        for folder in folders
        for inner in dict.fromkeys((of_element, of_spec, ""))
    ]
    exact = [place for place in places if place.name and _is_file(place)]
    return exact[0] if exact else find_mesh(str(Path(of_spec) / element.file), folders[0])


def _is_file(place: Path) -> bool:
    try:
        return place.is_file()
    except OSError:  # a name too long, or with characters that no file has
        return False


def _read(place: Path, kind: str) -> tuple[str, bytes]:
    if kind == "meshes":
        return read_mesh(place)
    content = place.read_bytes()
    if is_pointer(content):
        raise LevadeError(pointer_problem(place.name))
    return place.suffix, content


def _problem(draft: Draft, element) -> str:
    """Return what MuJoCo reports about the file of a mesh or texture; empty if it can read the file."""
    alone = mujoco.MjSpec()
    alone.assets = draft.assets
    if isinstance(element, mujoco.MjsTexture):
        alone.add_texture(name="alone", type=element.type, file=element.file)
    else:
        alone.add_mesh(name="alone", file=element.file, scale=element.scale, inertia=element.inertia)
        alone.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="alone")
    try:
        alone.compile()
    except ValueError as error:
        text = " ".join(str(error).split()).removeprefix("Error: ").partition(" Element name")[0]
        return f"{element.file} cannot be read ({text})"
    return ""


def _do_without(draft: Draft, kind: str, element, problem: str, losses: Losses) -> None:
    """Remove an element whose file cannot be read from the model, if the physics does not need it."""
    spec, name = draft.spec, element.name
    if kind == "textures":
        losses.add("texture", name, problem)
        for material in spec.materials:
            material.textures = ["" if texture == name else texture for texture in material.textures]
        spec.delete(element)
        return
    users = [geom for geom in spec.geoms if (geom.meshname if kind == "meshes" else geom.hfieldname) == name]
    for geom in users:
        body = geom.parent
        others = [g for g in body.geoms if g not in users]
        colliding = bool(geom.contype or geom.conaffinity)
        if not body.explicitinertial and not _massless(geom) and body.name != "world":
            raise LevadeError(
                f"{draft.path}: the inertia of body {body.name} comes from the mesh {name}, {problem};"
                " put the file where it says, or give the body an <inertial>"
            )
        if colliding:
            losses.add("part" if any(g.contype or g.conaffinity for g in others) else "whole", body.name, problem)
        else:
            losses.add("visual", body.name, problem)
        _delete_geom(spec, geom)
    spec.delete(element)


def _delete_geom(spec: mujoco.MjSpec, geom: mujoco.MjsGeom) -> None:
    """Delete a geom and the pairs that name it."""
    for pair in [pair for pair in spec.pairs if geom.name and geom.name in (pair.geomname1, pair.geomname2)]:
        spec.delete(pair)
    spec.delete(geom)


def _massless(geom: mujoco.MjsGeom) -> bool:
    return geom.mass == 0 or (np.isnan(geom.mass) and geom.density == 0)
