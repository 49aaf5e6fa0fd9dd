"""Export ``mjcf``: the robot and the whole simulation as MuJoCo models, with their files, and the files for playing.

mjcf/robot.xml     the robot with its actuators, without ground and obstacles; it does not depend on the motion
mjcf/scene.xml     robot and scene, exactly as the motion was simulated
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath

import mujoco

from levade.engines.clearance import forget_clearance
from levade.engines.layout import remove_contact_sensors
from levade.errors import LevadeError
from levade.exports import as_csv
from levade.exports.content import Content
from levade.motions import Motion
from levade.scenes import remove_scene

ROBOT, SCENE = "robot.xml", "scene.xml"


def check(motion: Motion) -> None:
    """Check that no file name would leave the directory, or replace the models.

    Args:
        motion: The motion.

    Raises:
        LevadeError: If a file name would.
    """
    for name in motion.assets:
        parts = PurePosixPath(name).parts
        leads_away = PureWindowsPath(name).anchor or PurePosixPath(name).anchor or ".." in parts or "\\" in name
        if leads_away or not parts or name in (ROBOT, SCENE) or not name.isprintable():
            raise LevadeError(f"motion: its model needs a file {name!r}, which cannot be put next to it")


def write(content: Content, directory: Path) -> list[str]:
    """Write mjcf/robot.xml, mjcf/scene.xml, the files that they need, and the files for playing.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    motion, folder = content.motion, directory / "mjcf"
    folder.mkdir()
    for name, data in motion.assets.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(data)
    (folder / SCENE).write_text(motion.model_xml, encoding="utf-8")
    (folder / ROBOT).write_text(robot_alone(motion.model_xml, motion.assets, motion.embodiment.feet), encoding="utf-8")
    as_csv.write(content, directory)
    return []


def robot_alone(model_xml: str, assets: Mapping[str, bytes], feet: Sequence[str]) -> str:
    """Remove the scene, and levade's sensors, from a simulation's MJCF.

    Args:
        model_xml: Robot and scene.
        assets: Files that it names.
        feet: Names of the robot's feet.

    Returns:
        MJCF of the robot with its actuators.
    """
    spec = mujoco.MjSpec.from_string(model_xml, assets=dict(assets))
    forget_clearance(spec)
    remove_contact_sensors(spec, feet)
    remove_scene(spec)
    return spec.to_xml()
