"""Make a robot from a `mujoco.MjSpec` that was made or changed in Python."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path, PurePosixPath

import mujoco

from levade.errors import LevadeError
from levade.robots.loading import load_robot
from levade.robots.robot import Robot


def robot_of_spec(spec: mujoco.MjSpec, *, name: str | None = None, like: Robot | None = None) -> Robot:
    """Understand the robot in a spec, as `levade.robots.load_robot` does for a file.

    Args:
        spec: A model of one robot; it is not changed. Its meshes must be in ``spec.assets`` or in files that it finds.
        name: Name of the robot. Defaults to the spec's model name.
        like: The robot whose `Robot.spec` was changed, with the same joints and feet. Its legs, limits, actuation and
            postures are kept, and the actuators in ``spec`` are left out.

    Returns:
        The robot.

    Raises:
        LevadeError: If MuJoCo does not accept the spec, the robot is not understood, or it lacks something that ``like`` has.
    """
    name = name or spec.modelname or "robot"
    copy = spec.copy()
    try:
        if like is not None:
            for actuator in list(copy.actuators):
                copy.delete(actuator)
        model = copy.compile()
        text = copy.to_xml()
    except ValueError as error:
        raise LevadeError(f"robot {name}: MuJoCo does not accept the spec: {' '.join(str(error).split())}") from None
    assets = {asset: data if isinstance(data, bytes) else str(data).encode() for asset, data in spec.assets.items()}
    if like is not None:
        return _changed(like, f"{name}-changed" if name == like.name else name, model, text, assets)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / f"{PurePosixPath(name.replace(' ', '_')).name}.xml"
        place.write_text(text, encoding="utf-8")
        for asset, content in assets.items():
            file = Path(folder) / (copy.meshdir or "") / asset
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        robot = load_robot(place)
    return replace(robot, name=name, source="")


def _changed(robot: Robot, name: str, model: mujoco.MjModel, text: str, assets: dict[str, bytes]) -> Robot:
    """Return the robot with another model, which must have everything that the robot names."""
    for kind, find, wanted in (
        ("body", mujoco.mjtObj.mjOBJ_BODY, (robot.trunk,)),
        ("joint", mujoco.mjtObj.mjOBJ_JOINT, robot.joint_names),
        ("geom", mujoco.mjtObj.mjOBJ_GEOM, robot.feet),
    ):
        for one in wanted:
            if mujoco.mj_name2id(model, find, one) < 0:
                raise LevadeError(
                    f"robot {name}: no {kind} {one!r}, which {robot.name} has; load the spec on its own instead"
                )
    moved = [i for i in range(model.njnt) if model.jnt_type[i] != mujoco.mjtJoint.mjJNT_FREE]
    extra = sorted({model.joint(i).name for i in moved} - set(robot.joint_names))
    if extra:
        raise LevadeError(f"robot {name}: {robot.name} has no joint {extra[0]!r}; load the spec on its own instead")
    return replace(robot, name=name, mjcf=text, assets={**robot.assets, **assets}, source="")
