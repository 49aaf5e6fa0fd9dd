"""Render a motion off screen from its file, without a window or a display.

    poses = replay(motion)
    with Renderer(motion, (960, 720)) as renderer:
        view = Camera().frame(outline(poses.model, poses.qpos[::10]), aspect=960 / 720)
        image = renderer.image(poses.at(0.3), view)           # (720, 960, 3) uint8

OpenGL comes from EGL or, if that is missing, from OSMesa (software). The environment variable MUJOCO_GL overrides this.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import math
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion, configurations
from levade.report.style import LIGHT
from levade.scenes.scene import GROUND

Image = NDArray[np.uint8]

FIELD_OF_VIEW = 30.0
"""Vertical field of view [deg]. It is narrow, so that near legs do not look larger than far ones."""

_MARGIN = 1.10
"""Room around the motion, as a factor on its size."""

_LARGE = 1.5
"""Half edge from which obstacles count as ground, which need not be in the picture [m]."""


@dataclass(frozen=True)
class Poses:
    """A motion's configurations: time [s] from 0, shape (rows,), and qpos, shape (rows, nq)."""

    model: Any
    time: Array
    qpos: Array

    def at(self, time: float) -> Array:
        """Return the configuration at a time, interpolated linearly between rows.

        Args:
            time: Time in the motion [s]. It is clipped to the recorded times.

        Returns:
            The configuration qpos, shape (nq,).
        """
        time = min(max(time, 0.0), float(self.time[-1]))
        row = min(int(np.searchsorted(self.time, time, side="right")) - 1, len(self.time) - 2)
        share = (time - self.time[row]) / (self.time[row + 1] - self.time[row])
        qpos, step = self.qpos[row].copy(), np.empty(self.model.nv)
        if share > 0.0:
            mujoco.mj_differentiatePos(self.model, step, 1.0, self.qpos[row], self.qpos[row + 1])
            mujoco.mj_integratePos(self.model, qpos, step, share)
        return qpos


@dataclass(frozen=True)
class View:
    """A view: its centre [m], shape (3,), distance [m], azimuth and elevation [deg] as in MuJoCo."""

    lookat: Array
    distance: float
    azimuth: float
    elevation: float


@dataclass(frozen=True)
class Camera:
    """Chooses a view.

    Attributes:
        azimuth: Direction of the view in the ground plane [deg]: 90 from the robot's right side, 180 from the front.
        elevation: Elevation from -90 to 90 [deg], negative from above.
        distance: Distance [m]. None for the nearest that shows the whole motion.
        track: Whether to follow the trunk.
    """

    azimuth: float = 118.0
    elevation: float = -12.0
    distance: float | None = None
    track: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.azimuth) and -90.0 <= self.elevation <= 90.0):
            raise LevadeError(
                f"camera {self.azimuth:g},{self.elevation:g}: should be the azimuth and an elevation, between -90 and"
                " 90, in degrees, such as 118,-12"
            )
        if self.distance is not None and not (math.isfinite(self.distance) and self.distance > 0):
            raise LevadeError(f"camera distance {self.distance:g} m: should be positive; 3 to 5 is usual")

    def axes(self) -> Array:
        """Return the picture's right, up and forward directions as rows, shape (3, 3)."""
        azimuth, elevation = math.radians(self.azimuth), math.radians(self.elevation)
        forward = [
            math.cos(elevation) * math.cos(azimuth),
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
        ]
        right = [math.sin(azimuth), -math.cos(azimuth), 0.0]
        return np.array([right, np.cross(right, forward), forward])

    def frame(self, points: Array, *, aspect: float) -> View:
        """Return the nearest view with all points in the picture.

        Args:
            points: Points [m], shape (n, 3).
            aspect: Width divided by height.

        Returns:
            The view.
        """
        right, up, forward = self.axes() @ points.T
        vertical = math.tan(math.radians(FIELD_OF_VIEW / 2)) / _MARGIN
        place, depth = [], math.inf
        for across, tangent in ((right, vertical * aspect), (up, vertical)):
            # the frustum's two planes touch the points: |across - place| <= tangent * (forward - depth)
            high, low = np.max(across - tangent * forward), np.max(-across - tangent * forward)
            place.append((high - low) / 2)
            depth = min(depth, -(high + low) / (2 * tangent))
        middle = float(forward.min() + forward.max()) / 2
        lookat = np.array([*place, middle]) @ self.axes()
        return View(lookat, float(self.distance or middle - depth), self.azimuth, self.elevation)


class Renderer:
    """Draws configurations of a model: the robot's visible shapes, the scene, and soft shadows. It is a context manager.

    Args:
        what: A motion, whose model is used; or a model, which is changed.
        size: Width and height [pixels].
        shadows: Number of lights that form the sun. More are softer and slower.

    Raises:
        LevadeError: If there is no OpenGL.
    """

    def __init__(self, what: Motion | Any, size: tuple[int, int], *, shadows: int = 6) -> None:
        self._size, self._shadows = size, max(1, shadows)
        self.model: Any = what.compiled() if isinstance(what, Motion) else what
        _furnish(self.model, size)
        self._data = mujoco.MjData(self.model)
        self._option = mujoco.MjvOption()
        drawn = drawn_geoms(self.model)
        self.model.geom_group[drawn & (self.model.geom_group == 3)] = 2
        self._option.geomgroup[:] = [1, 1, 1, 0, 0, 0]
        self._scene = mujoco.MjvScene(self.model, maxgeom=10_000)
        self._camera = mujoco.MjvCamera()
        self._gl: Any = None

    def __enter__(self) -> Renderer:
        self._gl = _open_gl(self._size)
        self._gl.make_current()
        self._context = mujoco.MjrContext(self.model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._context)
        return self

    def __exit__(self, *error: object) -> None:
        self._gl.make_current()
        self._context.free()
        self._gl.free()

    def image(self, qpos: Array, view: View) -> Image:
        """Draw a configuration.

        Args:
            qpos: The configuration, shape (nq,).
            view: The camera's view.

        Returns:
            RGB, shape (height, width, 3).
        """
        self._data.qpos[:] = qpos
        mujoco.mj_kinematics(self.model, self._data)
        mujoco.mj_comPos(self.model, self._data)
        mujoco.mj_camlight(self.model, self._data)
        camera = self._camera
        camera.lookat[:], camera.distance = view.lookat, view.distance
        camera.azimuth, camera.elevation = view.azimuth, view.elevation
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(self.model, self._data, self._option, None, camera, everything, self._scene)
        self._light(np.asarray(qpos[:3] if self.model.nq > 6 else view.lookat))
        width, height = self._size
        rectangle, image = mujoco.MjrRect(0, 0, width, height), np.empty((height, width, 3), np.uint8)
        mujoco.mjr_render(rectangle, self._scene, self._context)
        mujoco.mjr_readPixels(image, None, rectangle, self._context)
        return np.ascontiguousarray(image[::-1])

    def _light(self, subject: Array) -> None:
        """Keep the sun above the robot, as a disc of several lights whose shadows have soft edges."""
        scene = self._scene
        suns = [i for i in range(scene.nlight) if scene.lights[i].castshadow and not scene.lights[i].headlight]
        if not suns:
            return
        sun, n = scene.lights[suns[0]], self._shadows
        towards = np.array(sun.dir, dtype=float) / np.linalg.norm(sun.dir)
        across = np.cross(towards, [1.0, 0.0, 0.0])
        across /= np.linalg.norm(across)
        along = np.cross(towards, across)
        diffuse, specular = sun.diffuse / n, sun.specular / n
        places = [suns[0], *range(scene.nlight, min(scene.nlight + n - 1, 7))]
        for k, place in enumerate(places):
            light = scene.lights[place]
            radius = 0.05 * math.sqrt((k + 0.5) / n) * (n > 1)
            angle = k * math.pi * (3.0 - math.sqrt(5.0))  # sunflower: evenly over the disc
            direction = towards + radius * (math.cos(angle) * across + math.sin(angle) * along)
            direction /= np.linalg.norm(direction)
            for name in ("type", "castshadow", "headlight", "cutoff", "exponent"):
                setattr(light, name, getattr(sun, name))
            light.ambient[:], light.attenuation[:] = sun.ambient, sun.attenuation
            light.diffuse[:], light.specular[:] = diffuse, specular
            light.dir[:] = direction
            light.pos[:] = np.array([subject[0], subject[1], 0.0]) - 4.0 * direction
        scene.nlight += len(places) - 1


def replay(motion: Motion) -> Poses:
    """Return the robot's recorded poses in a motion: the start, then every row.

    Args:
        motion: The motion.

    Returns:
        Time [s] and configuration of each row.
    """
    model = motion.compiled()
    return Poses(model, np.concatenate([[0.0], motion["time"]]), configurations(motion, model))


def outline(model: Any, qpos: Array) -> Array:
    """Return corners of the drawn shapes of the robot and of small obstacles, in each configuration.

    Args:
        model: The model.
        qpos: Configurations, shape (rows, nq), or one configuration, shape (nq,).

    Returns:
        Corners of the boxes around these shapes [m], shape (n, 3). All rows follow one another.
    """
    seen = drawn_geoms(model) & (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE)
    seen &= model.geom_type != mujoco.mjtGeom.mjGEOM_HFIELD
    fixed = model.geom_bodyid == 0
    seen &= ~fixed | (model.geom_rbound < _LARGE)
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    centre, half = model.geom_aabb[:, :3], model.geom_aabb[:, 3:]
    corners = (centre[:, None] + signs * half[:, None])[seen]
    data, points = mujoco.MjData(model), []
    for row in np.atleast_2d(qpos):
        data.qpos[:] = row
        mujoco.mj_kinematics(model, data)
        frames = data.geom_xmat[seen].reshape(-1, 3, 3)
        points.append((np.einsum("gij,gkj->gki", frames, corners) + data.geom_xpos[seen][:, None]).reshape(-1, 3))
    return np.concatenate(points)


def drawn_geoms(model: Any) -> NDArray[np.bool_]:
    """Tell which geoms are drawn: groups 0 to 2, in which models keep their visible shapes.

    Group 3 also counts for parts of the robot that have nothing else; bodies that are fixed to each other form one part.

    Args:
        model: `mujoco.MjModel`.

    Returns:
        Shape (ngeom,).
    """
    drawn = model.geom_group <= 2
    part = model.body_weldid[model.geom_bodyid]
    bare = np.setdiff1d(part[~drawn], part[drawn])
    return drawn | ((model.geom_group == 3) & np.isin(part, bare) & (part != 0))


def _furnish(model: Any, size: tuple[int, int]) -> None:
    """Set picture size and quality, and the page's colours for sky and ground."""
    visual = model.vis
    visual.global_.offwidth, visual.global_.offheight = size
    visual.global_.fovy = FIELD_OF_VIEW
    visual.quality.offsamples = 8
    visual.quality.numslices, visual.quality.numstacks = 24, 8  # in software, corners are what costs
    visual.quality.shadowsize = 2 ** int(np.clip(math.ceil(math.log2(3 * size[1])), 8, 11))
    visual.map.shadowclip = 2.2 / max(model.stat.extent, 1e-6)  # [m], half width of what the shadows cover
    visual.map.znear, visual.map.zfar = 0.02 / model.stat.extent, 60.0 / model.stat.extent
    sky = _rgb(LIGHT.sky)
    visual.rgba.haze[:3] = sky / 255
    for texture in range(model.ntex):
        if model.tex_type[texture] == mujoco.mjtTexture.mjTEXTURE_SKYBOX:
            _texture(model, texture)[:] = sky
    ground = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, GROUND)
    material = model.geom_matid[ground] if ground >= 0 else -1
    texture = model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB] if material >= 0 else -1
    if texture >= 0:
        pixels = _texture(model, texture)
        light = pixels.reshape(len(pixels), -1).sum(axis=1)
        pixels[:] = np.where((light > (light.min() + light.max()) / 2)[:, None], 0.95, 0.89) * _rgb(LIGHT.ground).mean()


def _texture(model: Any, texture: int) -> Array:
    """Return a texture of the model, shape (pixels, channels), uint8, in the model's own memory."""
    start, channels = model.tex_adr[texture], model.tex_nchannel[texture]
    pixels = model.tex_width[texture] * model.tex_height[texture]
    return model.tex_data[start : start + pixels * channels].reshape(pixels, channels)[:, :3]


def _rgb(colour: str) -> Array:
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])


_NO_GL = (
    "no off-screen OpenGL found to draw with; install EGL (Debian: apt install libegl1 libgl1-mesa-dri) or OSMesa"
    " (apt install libosmesa6)"
)


def _open_gl(size: tuple[int, int]) -> Any:
    """Make an OpenGL context of MuJoCo's that is not current yet."""
    name = os.environ.get("MUJOCO_GL", "").lower().strip()
    if name in ("disable", "disabled", "off", "false", "0"):
        raise LevadeError(f"drawing needs OpenGL, but MUJOCO_GL={name} turns it off; unset it")
    if name not in ("egl", "osmesa"):
        if sys.platform != "linux" or name in ("glfw", "glx"):
            name = ""
        else:
            name = _find_gl()
    try:
        return _context_class(name)(*size)
    except Exception as error:  # whatever a driver says
        tried = f" ({name or 'window system'}: {' '.join(str(error).split())[:120]})"
        raise LevadeError(_NO_GL + tried) from None


def opengl() -> str:
    """Make an OpenGL context off screen, and name its renderer.

    Returns:
        The renderer, such as "llvmpipe (LLVM 15.0.6, 256 bits)".

    Raises:
        LevadeError: If there is no OpenGL. The message says what to install.
    """
    context = _open_gl((16, 16))
    try:
        context.make_current()
        from OpenGL import GL

        return GL.glGetString(GL.GL_RENDERER).decode()
    finally:
        context.free()


def _context_class(name: str) -> Callable[[int, int], Any]:
    # taken from their own modules: mujoco.gl_context decides once, when mujoco is first imported
    if name == "egl":
        from mujoco.egl import GLContext
    elif name == "osmesa":
        from mujoco.osmesa import GLContext
    else:
        from mujoco.gl_context import GLContext
    return GLContext


def _find_gl() -> str:
    """Find the available OpenGL before PyOpenGL is imported, which binds to one per process."""
    if bound := os.environ.get("PYOPENGL_PLATFORM", "").lower():
        return bound
    if _egl_devices() > 0:
        return "egl"
    if ctypes.util.find_library("OSMesa"):
        return "osmesa"
    raise LevadeError(_NO_GL)


def _egl_devices() -> int:
    try:
        egl = ctypes.CDLL("libEGL.so.1")
        egl.eglGetProcAddress.restype = ctypes.c_void_p
        address = egl.eglGetProcAddress(b"eglQueryDevicesEXT")
        query = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(ctypes.c_int))(address)
        number = ctypes.c_int(0)
        return number.value if query(0, None, ctypes.byref(number)) else 0
    except (OSError, AttributeError, ValueError, TypeError):
        return 0
