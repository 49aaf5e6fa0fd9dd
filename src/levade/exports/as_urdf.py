"""Export ``urdf``: the robot as URDF, its meshes next to it, and the files for playing.

    robot.urdf, meshes/*.stl

The URDF comes from the motion's model, without the scene. So the same robot gives the same bytes for every motion.
"""

from __future__ import annotations

from pathlib import Path

from levade.exports import as_csv
from levade.exports.content import Content
from levade.exports.urdf import mesh_bytes, mesh_files, urdf


def write(content: Content, directory: Path) -> list[str]:
    """Write robot.urdf, its meshes, and the files for playing.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    files = mesh_files(content.model)
    for mesh, file in files.items():
        (directory / file).parent.mkdir(exist_ok=True)
        (directory / file).write_bytes(mesh_bytes(content.model, mesh))
    text = urdf(content.model, content.samples.joints, content.motion.robot, meshes=files)
    (directory / "robot.urdf").write_text(text + "\n", encoding="utf-8")
    as_csv.write(content, directory)
    return []
