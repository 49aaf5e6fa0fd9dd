"""Mesh files: where a robot's file says they are, and in a form that MuJoCo reads."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path, PurePosixPath

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.files import is_pointer, pointer_problem

READABLE = (".stl", ".obj", ".msh")
"""Suffixes that MuJoCo reads."""

CONVERTIBLE = (".dae", ".ply", ".glb", ".gltf", ".off", ".3mf")
"""Suffixes that trimesh, of the extra `meshes`, reads."""

_LARGEST = 200_000
"""Faces that MuJoCo takes of an STL file."""

_RECORD = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
_CELLS = 40
"""Along the longest edge of a mesh; vertices in one cell of the grid become one."""


def find_mesh(reference: str, beside: Path, also: Iterable[Path] = ()) -> Path | None:
    """The file that a URDF or MJCF names; None if there is none.

    reference: a path relative to ``beside``, the folder of the robot's file, or absolute; ``file://...``; or
    ``package://NAME/...``, where NAME is a folder above the robot's file, or in the ROS paths (ROS_PACKAGE_PATH,
    AMENT_PREFIX_PATH). Of paths that another machine wrote down, the tail counts: the file below the nearest folder
    above that has it.
    also: where MuJoCo would look, which counts more than such a tail.
    """
    beside = beside.resolve()
    for place in (*_places(reference, beside), *also, *_tails(reference, beside)):
        try:
            if place.is_file():
                return place
        except OSError:  # a name too long, or with characters that no file has
            continue
    return None


def _places(reference: str, beside: Path) -> Iterator[Path]:
    scheme, separator, rest = reference.partition("://")
    if separator and scheme in ("package", "model"):
        package, _, inside = rest.partition("/")
        for folder in (beside, *beside.parents):
            if folder.name == package:
                yield folder / inside
            yield folder / rest
        for variable, middle in (
            ("ROS_PACKAGE_PATH", ""),
            ("AMENT_PREFIX_PATH", "share"),
            ("GZ_SIM_RESOURCE_PATH", ""),
        ):
            for root in filter(None, os.environ.get(variable, "").split(os.pathsep)):
                yield Path(root) / middle / rest
    else:
        yield beside / (rest if separator else reference)  # an absolute path stays what it is


def _tails(reference: str, beside: Path) -> Iterator[Path]:
    scheme, separator, rest = reference.partition("://")
    if separator and scheme in ("package", "model"):
        rest = rest.partition("/")[2]
    tail = PurePosixPath((rest if separator else reference).replace("\\", "/"))
    parts = [part for part in tail.parts if part not in ("/", ".", "..")]
    for folder in (beside, *list(beside.parents)[:3]):
        for first in range(len(parts)):
            yield folder.joinpath(*parts[first:])


def read_mesh(path: Path) -> tuple[str, bytes]:
    """(suffix, content) of a mesh in a form that MuJoCo reads; others are converted to STL.

    Raises LevadeError if the form is unknown, needs the extra `meshes`, or the file is broken.
    """
    suffix = path.suffix.lower()
    with path.open("rb") as file:
        if is_pointer(file.read(64)):
            raise LevadeError(pointer_problem(path.name))
    if suffix in READABLE:
        content = path.read_bytes()
        return (".stl", _binary_stl(path)) if suffix == ".stl" and _is_text_stl(content) else (suffix, content)
    if suffix not in CONVERTIBLE:
        raise LevadeError(f"{path.name}: cannot read {suffix or 'a mesh without suffix'}; convert it to .stl or .obj")
    return ".stl", _binary_stl(path)


def _is_text_stl(content: bytes) -> bool:
    """Whether it is the text form, which MuJoCo does not read; binary files may begin with "solid" too."""
    faces = int.from_bytes(content[80:84], "little") if len(content) >= 84 else -1
    return content[:5] == b"solid" and len(content) != 84 + 50 * faces


def _binary_stl(path: Path) -> bytes:
    try:
        import trimesh
    except ImportError:
        raise LevadeError(
            f"{path.name}: MuJoCo does not read {path.suffix}; install levade[meshes], or convert it to binary .stl or .obj"
        ) from None
    try:
        # from memory: beside a path it would read the textures too, which are larger than the mesh
        mesh = trimesh.load_mesh(BytesIO(path.read_bytes()), file_type=path.suffix[1:].lower(), process=False)
        vertices, faces = np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces)
    except Exception as error:  # readers of foreign files raise whatever they like
        if isinstance(error, ImportError):
            raise LevadeError(
                f"{path.name}: reading {path.suffix} needs {error.name}; install levade[meshes]"
            ) from None
        raise LevadeError(f"{path.name}: not a mesh that can be read ({type(error).__name__}: {error})") from None
    if not len(faces) or not np.isfinite(vertices).all():
        raise LevadeError(f"{path.name}: has no surface; a mesh needs triangles")
    if len(faces) > _LARGEST:
        raise LevadeError(f"{path.name}: has {len(faces)} faces, more than {_LARGEST}; simplify it")
    return stl(vertices[faces])


def stl(triangles: np.ndarray) -> bytes:
    """A binary STL file of triangles (n, 3, 3) [m]."""
    record = np.zeros(len(triangles), dtype=_RECORD)
    record["corners"] = triangles
    return bytes(80) + len(triangles).to_bytes(4, "little") + record.tobytes()


def coarse(content: bytes) -> bytes:
    """A binary STL file of the same shape in few triangles."""
    record = np.frombuffer(content, dtype=_RECORD, offset=84, count=int.from_bytes(content[80:84], "little"))
    return stl(cluster(record["corners"].astype(float)))


def cluster(triangles: Array) -> Array:
    """Fewer triangles (m, 3, 3) of the same shape: vertices that share a cell of a grid become their mean."""
    vertices = triangles.reshape(-1, 3)
    low = vertices.min(axis=0)
    cell = max(float((vertices.max(axis=0) - low).max()) / _CELLS, 1e-9)
    keys = np.floor((vertices - low) / cell).astype(np.int64) @ np.array([1, 1 << 20, 1 << 40])
    _, inverse = np.unique(keys, return_inverse=True)
    counts = np.bincount(inverse)
    means = np.stack([np.bincount(inverse, vertices[:, k]) / counts for k in range(3)], axis=1)
    corners = inverse.reshape(-1, 3)
    distinct = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    corners = corners[distinct]
    _, first = np.unique(np.sort(corners, axis=1), axis=0, return_index=True)
    kept = means[corners[np.sort(first)]]
    return kept if len(kept) >= 4 else triangles
