"""Mesh files: find those that a robot's file names, and convert them to a format that MuJoCo reads."""

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
"""Suffixes of files that MuJoCo reads."""

CONVERTIBLE = (".dae", ".ply", ".glb", ".gltf", ".off", ".3mf")
"""Suffixes of files that trimesh reads, which the extra `meshes` installs."""

_LARGEST = 200_000
"""Largest number of faces that MuJoCo accepts in an STL file."""

_RECORD = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
_CELLS = 40
"""Number of grid cells along the longest edge of a mesh; vertices in one cell are merged."""


def find_mesh(reference: str, beside: Path, also: Iterable[Path] = ()) -> Path | None:
    """Find the mesh file that a URDF or MJCF names.

    If the path itself does not exist, as with paths from another machine, its tail is searched below the folders above the
    robot's file, the nearest first.

    Args:
        reference: Path that is absolute or relative to ``beside``; ``file://...``; or ``package://NAME/...``, where NAME is a
            folder above the robot's file or in the ROS paths (ROS_PACKAGE_PATH, AMENT_PREFIX_PATH).
        beside: Folder of the robot's file.
        also: Folders in which MuJoCo would look. They take precedence over the search for the tail.

    Returns:
        Path of the file. None if it does not exist.
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
        yield beside / (rest if separator else reference)  # an absolute path is kept


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
    """Read a mesh, and convert it to STL if MuJoCo does not read its format.

    Args:
        path: Path of the file.

    Returns:
        Suffix and content.

    Raises:
        LevadeError: If the format is unknown or needs the extra `meshes`, or the file is damaged.
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
    """Tell whether an STL file is text, which MuJoCo does not read. Binary files may begin with "solid", too."""
    faces = int.from_bytes(content[80:84], "little") if len(content) >= 84 else -1
    return content[:5] == b"solid" and len(content) != 84 + 50 * faces


def _binary_stl(path: Path) -> bytes:
    try:
        import trimesh
    except ImportError:
        raise LevadeError(
            f"{path.name}: MuJoCo does not read {path.suffix}; "
            "pip install 'levade[meshes]', or convert it to binary .stl or .obj"
        ) from None
    try:
        # from memory: given a path, it would also read the textures, which are larger than the mesh
        mesh = trimesh.load_mesh(BytesIO(path.read_bytes()), file_type=path.suffix[1:].lower(), process=False)
        vertices, faces = np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces)
    except Exception as error:  # readers of foreign formats raise exceptions of any kind
        if isinstance(error, ImportError):
            raise LevadeError(
                f"{path.name}: reading {path.suffix} needs {error.name}; pip install 'levade[meshes]'"
            ) from None
        raise LevadeError(f"{path.name}: not a mesh that can be read ({type(error).__name__}: {error})") from None
    if not len(faces) or not np.isfinite(vertices).all():
        raise LevadeError(f"{path.name}: has no surface; give a mesh with triangles")
    if len(faces) > _LARGEST:
        raise LevadeError(f"{path.name}: has {len(faces)} faces, more than {_LARGEST}; simplify it")
    return stl(vertices[faces])


def stl(triangles: np.ndarray) -> bytes:
    """Write triangles as a binary STL file.

    Args:
        triangles: Corners of the triangles [m], shape (n, 3, 3).

    Returns:
        Content of the file. Its normals are zero.
    """
    record = np.zeros(len(triangles), dtype=_RECORD)
    record["corners"] = triangles
    return bytes(80) + len(triangles).to_bytes(4, "little") + record.tobytes()


def coarse(content: bytes) -> bytes:
    """Reduce a binary STL file to few triangles of about the same shape.

    Args:
        content: Content of the file.

    Returns:
        Content of the reduced file.
    """
    record = np.frombuffer(content, dtype=_RECORD, offset=84, count=int.from_bytes(content[80:84], "little"))
    return stl(cluster(record["corners"].astype(float)))


def cluster(triangles: Array) -> Array:
    """Reduce triangles by replacing all vertices in one grid cell by their mean.

    Args:
        triangles: Triangles [m], shape (n, 3, 3).

    Returns:
        Triangles [m], shape (m, 3, 3).
    """
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
