"""A robot from a `mujoco.MjSpec` that was made or changed in Python."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path, PurePosixPath

import mujoco

from levade.errors import LevadeError
from levade.robots.loading import load_robot
from levade.robots.robot import Robot


def robot_of_spec(spec: mujoco.MjSpec, *, name: str | None = None) -> Robot:
    """Understand the robot in a spec, as `levade.robots.load_robot` does for a file.

    Args:
        spec: A model of one robot; it is not changed. Its meshes have to be in ``spec.assets`` or in files that it finds.
        name: What to call the robot. Defaults to the spec's model name.

    Raises:
        LevadeError: If MuJoCo does not take the spec, or the robot is not understood.
    """
    name = name or spec.modelname or "robot"
    copy = spec.copy()
    try:
        copy.compile()
        text = copy.to_xml()
    except ValueError as error:
        raise LevadeError(f"robot {name}: MuJoCo does not take the spec: {' '.join(str(error).split())}") from None
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / f"{PurePosixPath(name.replace(' ', '_')).name}.xml"
        place.write_text(text, encoding="utf-8")
        for asset, content in spec.assets.items():
            file = Path(folder) / (copy.meshdir or "") / asset
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content if isinstance(content, bytes) else str(content).encode())
        robot = load_robot(place)
    return replace(robot, name=name, source="")
