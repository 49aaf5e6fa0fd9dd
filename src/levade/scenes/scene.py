"""Compose the ground and the obstacles with a robot into one model."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Literal

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots import Robot
from levade.robots.contact import stiffen
from levade.scenes.terrain import Gap, Terrain

GROUND, PLATFORM = "ground", "platform"
"""Names of the ground's geom, and of ground between gaps (``platform0``).

Obstacles are ``box0``, ``box1``, ..., ``terrain``.
"""
TERRAIN = "terrain"
_OBSTACLE, _SKY = "obstacle", "sky"
_FAR = 50.0
"""Extent of ground with gaps [m], which cannot be infinite."""


@dataclass(frozen=True)
class Box:
    """A box that is fixed in the world.

    Attributes:
        position: Centre [m], shape (3,).
        size: Full edge lengths [m], shape (3,).
        roll: Roll [rad], intrinsic z-y-x.
        pitch: Pitch [rad], intrinsic z-y-x.
        yaw: Yaw [rad], intrinsic z-y-x.
    """

    position: tuple[float, float, float]
    size: tuple[float, float, float]
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def __post_init__(self) -> None:
        if not all(math.isfinite(value) for value in (*self.position, self.roll, self.pitch, self.yaw)):
            raise LevadeError(f"box: position {list(self.position)} and roll, pitch, yaw should be finite numbers")
        if not all(math.isfinite(edge) and edge > 0 for edge in self.size):
            raise LevadeError(f"box.size: {list(self.size)} should be three positive edge lengths in m")


@dataclass(frozen=True)
class Scene:
    """The ground and the obstacles that a robot may touch.

    Attributes:
        friction: Coulomb friction coefficient of every contact with the ground and the obstacles. By default the robot's parts
            decide (feet and shell may differ), or 1 if they are below 1 and have no priority.
        contact: How hard contacts are. None leaves it to the robot's file. With "stiff", feet sink in by less than a millimetre
            (`levade.robots.contact.STIFF_SOLREF`). ODE ignores it.
        slope: Slope of the ground along x [rad], uphill positive.
        boxes: Obstacles.
        gaps: Ditches across the ground, along its slope. They must not overlap.
        terrain: A height field on the ground.
    """

    friction: float | None = None
    slope: float = 0.0
    boxes: tuple[Box, ...] = ()
    gaps: tuple[Gap, ...] = ()
    terrain: Terrain | None = None
    contact: Literal["stiff"] | None = None

    def __post_init__(self) -> None:
        if self.friction is not None and not (math.isfinite(self.friction) and self.friction > 0):
            raise LevadeError(f"scene.friction: {self.friction} should be a positive coefficient; 0.6 to 1 is usual")
        if self.contact not in (None, "stiff"):
            raise LevadeError(f"scene.contact: no contact {self.contact!r}; stiff, or leave it out for the robot's own")
        if not abs(self.slope) < math.pi / 2:
            raise LevadeError(f"scene.slope: {self.slope} rad is no slope to stand on; between -pi/2 and pi/2")
        ordered = sorted(self.gaps, key=lambda gap: gap.x)
        for one, other in itertools.pairwise(ordered):
            if one.x + one.width >= other.x:
                raise LevadeError(f"scene.gaps: the ones at x = {one.x} and {other.x} m overlap; make them one")

    def ground_height(self, x: Array, y: Array) -> Array:
        """Compute the height of slope and terrain over z = 0 at each x, y, without boxes and gaps.

        Args:
            x: Positions along x [m], any shape.
            y: Positions along y [m], the same shape.

        Returns:
            Heights [m], the same shape.
        """
        height = x * math.tan(self.slope)
        return height if self.terrain is None else np.maximum(height, self.terrain.height(x, y))


def compose(robot: Robot, scene: Scene, *, gain_scale: float = 1.0, damping_scale: float = 1.0) -> mujoco.MjSpec:
    """Put a robot with its actuators into a scene.

    Args:
        robot: The robot.
        scene: The scene.
        gain_scale: See `levade.robots.Robot.spec`.
        damping_scale: See `levade.robots.Robot.spec`.

    Returns:
        The spec. A motion file keeps its ``to_xml()``, so simulate the model that is compiled from that text.
    """
    spec = robot.spec(gain_scale=gain_scale, damping_scale=damping_scale)
    world = spec.worldbody
    _furnish(spec)
    ground = world.add_geom(
        name=GROUND,
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0.0, 0.0, 0.05],
        quat=_quaternion(0.0, -scene.slope, 0.0),
        material=GROUND,
    )
    if scene.gaps:
        ground.pos = _down_the_slope(scene, 0.0, max(gap.depth for gap in scene.gaps))
    obstacles = [
        world.add_geom(
            name=f"box{i}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[edge / 2 for edge in box.size],
            pos=list(box.position),
            quat=_quaternion(box.roll, box.pitch, box.yaw),
            material=_OBSTACLE,
        )
        for i, box in enumerate(scene.boxes)
    ]
    if scene.terrain is not None:
        obstacles.append(scene.terrain.add_to(spec, TERRAIN, GROUND))
    for geom in (ground, *_platforms(spec, scene), *obstacles):
        # everything of the robot that collides at all meets the scene; the scene never meets itself (all static)
        geom.contype = geom.conaffinity = 0x7FFFFFFF
        if scene.friction is not None:
            geom.priority = (
                2  # above the robot's geoms, which have at most 1: the contact takes everything from the scene
            )
            geom.friction = [scene.friction, 0.005, 0.0001]
            foot = robot.model.geom(robot.feet[0])
            geom.condim, geom.solref, geom.solimp = 3, foot.solref.copy(), foot.solimp.copy()
    if scene.contact == "stiff":
        stiffen(spec)
    return spec


def remove_scene(spec: mujoco.MjSpec) -> None:
    """Remove what `compose` put around the robot. The robot itself has only its trunk in the world.

    Args:
        spec: Robot and scene; it is changed.
    """
    world = spec.worldbody
    for element in (*world.geoms, *world.lights):
        spec.delete(element)
    for element in (*spec.hfields, *spec.materials, *spec.textures):
        if element.name in (GROUND, _OBSTACLE, _SKY, TERRAIN):
            spec.delete(element)


def _platforms(spec: mujoco.MjSpec, scene: Scene) -> list[mujoco.MjsGeom]:
    """Make ground with gaps: boxes with their tops where the ground would be, and the bottoms of the gaps deeper."""
    if not scene.gaps:
        return []
    gaps = sorted(scene.gaps, key=lambda gap: gap.x)
    deepest = max(gap.depth for gap in gaps)
    edges = [-_FAR, *(edge for gap in gaps for edge in (gap.x, gap.x + gap.width)), _FAR]
    tops = [(edges[i], edges[i + 1], 0.0) for i in range(0, len(edges), 2)]
    tops += [(gap.x, gap.x + gap.width, gap.depth) for gap in gaps if gap.depth < deepest]
    return [
        spec.worldbody.add_geom(
            name=f"{PLATFORM}{i}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[(end - begin) / 2, _FAR, (deepest - below) / 2],
            pos=_down_the_slope(scene, (begin + end) / 2, (deepest + below) / 2),
            quat=_quaternion(0.0, -scene.slope, 0.0),
            material=GROUND,
        )
        for i, (begin, end, below) in enumerate(tops)
    ]


def _down_the_slope(scene: Scene, along: float, below: float) -> list[float]:
    """Return the point at a distance along the ground and a depth below its surface."""
    sine, cosine = math.sin(scene.slope), math.cos(scene.slope)
    return [along * cosine + below * sine, 0.0, along * sine - below * cosine]


def _furnish(spec: mujoco.MjSpec) -> None:
    """Add light and surfaces for pictures, which do not affect the physics."""
    spec.add_texture(
        name=_SKY,
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.93, 0.95, 0.97],
        rgb2=[0.70, 0.76, 0.83],
        width=128,
        height=768,
    )
    spec.add_texture(
        name=GROUND,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_CHECKER,
        rgb1=[0.82, 0.83, 0.84],
        rgb2=[0.76, 0.77, 0.79],
        width=256,
        height=256,
    )
    ground = spec.add_material(name=GROUND, texrepeat=[1.0, 1.0], texuniform=True, reflectance=0.0)
    ground.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = GROUND
    spec.add_material(name=_OBSTACLE, rgba=[0.80, 0.62, 0.42, 1.0])
    spec.worldbody.add_light(
        name="sun",
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=[1.5, -2.0, 4.0],
        dir=[-0.35, 0.45, -0.85],
        diffuse=[0.75, 0.75, 0.75],
        specular=[0.2, 0.2, 0.2],
        castshadow=True,
    )
    spec.visual.headlight.ambient = [0.38, 0.38, 0.38]
    spec.visual.headlight.diffuse = [0.32, 0.32, 0.32]


def _quaternion(roll: float, pitch: float, yaw: float) -> list[float]:
    quaternion = np.empty(4)
    mujoco.mju_euler2Quat(quaternion, np.array([yaw, pitch, roll]), "zyx")
    return quaternion.tolist()
