"""Draw a robot in its neutral posture, with the names of its joints and feet.

    portrait(load_robot("hyq2max"), Path("hyq2max.png"))

It needs pillow (`pip install 'levade[video]'`) and OpenGL off screen (`levade.report.rendering`).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.report.files import writing
from levade.report.rendering import FIELD_OF_VIEW, Camera, Renderer, View, outline
from levade.report.style import LIGHT, leg_colours
from levade.report.video import load_pillow
from levade.robots import Leg, Robot, dimensions
from levade.robots.addresses import Addresses
from levade.scenes import Scene, compose

_SIZE = (1600, 1000)
_EDGE = 24.0
"""Distance of the names from the edge of the picture [px]."""
_NAME, _SMALL = 17, 14
"""Heights of letters [px]."""
_FINE = 2
"""Factor by which names and lines are drawn finer than the picture."""
_AXES = (("x", "x forward"), ("y", "y left"), ("z", "z up"))


@dataclass
class Label:
    """A name, the point in the picture to which it refers [px], and the side and height at which it is written [px]."""

    name: str
    what: str
    colour: str
    x: float
    y: float
    left: bool = True
    row: float = 0.0


def portrait(robot: Robot, path: Path) -> Path:
    """Draw the robot to a .png file.

    Args:
        robot: The robot.
        path: File to write.

    Returns:
        The file.

    Raises:
        LevadeError: If it cannot be written or drawn.
    """
    if path.suffix.lower() != ".png":
        raise LevadeError(f"{path}: a picture of a robot should be a .png")
    pillow = load_pillow()
    with writing(path) as partial:
        _draw(pillow, robot).save(partial, format="PNG", optimize=True)
    return path


def _draw(pillow: Any, robot: Robot) -> Any:
    model = mujoco.MjModel.from_xml_string(compose(robot, Scene()).to_xml(), dict(robot.assets))
    data = _standing(robot, model)
    camera = Camera(azimuth=_azimuth(robot, data), elevation=-18.0)
    (width, height), column = _SIZE, _column(pillow, robot)
    top = data.xpos[model.body(robot.trunk).id] + robot.trunk_com_offset + [0.0, 0.0, 0.5 * dimensions(robot).height]
    points = np.concatenate([outline(model, data.qpos[None]), [top]])
    room = 0.88
    view = camera.frame(points, aspect=(width - 2 * column) / (room * height))
    view = View(view.lookat, view.distance / room, view.azimuth, view.elevation)
    with Renderer(model, _SIZE) as renderer:
        image = pillow.Image.fromarray(renderer.image(data.qpos, view))
    fine = image.resize((width * _FINE, height * _FINE), pillow.Image.Resampling.NEAREST)
    eye = _Eye(camera, view)
    _write(pillow, fine, robot, _labels(robot, data, eye), _frame(robot, data, eye))
    return fine.resize(_SIZE, pillow.Image.Resampling.BOX)


def _column(pillow: Any, robot: Robot) -> float:
    """Return the width of the names on each side [px]."""
    font = pillow.ImageFont.load_default(_NAME)
    longest = max(font.getlength(name) for name in (*robot.joint_names, *robot.feet, "hip abduction"))
    return min(_EDGE + longest + 70.0, 0.3 * _SIZE[0])


def _standing(robot: Robot, model: Any) -> Any:
    """Compute the kinematics of the robot on level ground."""
    data = mujoco.MjData(model)
    at = Addresses.of(model, robot.trunk, robot.joint_names)
    data.qpos[at.trunk_pose] = [0.0, 0.0, robot.neutral_height, 1.0, 0.0, 0.0, 0.0]
    data.qpos[at.joint_qpos] = robot.postures["neutral"]
    mujoco.mj_kinematics(model, data)
    return data


def _azimuth(robot: Robot, data: Any) -> float:
    """Return the azimuth [deg]: from the right front, so that the four legs are equally far apart (tan = length / 2 width)."""
    feet = np.array([data.geom(leg.foot).xpos for leg in robot.standing])
    length, width = np.ptp(feet[:, 0]), np.ptp(feet[:, 1])
    aside = math.degrees(math.atan2(max(length, 1e-6), 2.0 * max(width, 1e-6)))
    return 180.0 - float(np.clip(aside, 30.0, 62.0))


@dataclass(frozen=True)
class _Eye:
    """Maps points to pixels."""

    camera: Camera
    view: View

    def see(self, point: Array) -> tuple[float, float]:
        """Return (x, y) from the left and the top [px].

        Args:
            point: Point [m], shape (3,).
        """
        right, up, forward = self.camera.axes() @ (np.asarray(point) - self.view.lookat)
        scale = _SIZE[1] / 2 / math.tan(math.radians(FIELD_OF_VIEW / 2)) / (self.view.distance + forward)
        return _SIZE[0] / 2 + scale * right, _SIZE[1] / 2 - scale * up


def _labels(robot: Robot, data: Any, eye: _Eye) -> list[Label]:
    colours = leg_colours(robot.legs, LIGHT)
    labels: list[list[Label]] = []
    for leg in robot.legs:
        seen = [(eye.see(place), name, what) for place, name, what in _places(robot, data, leg)]
        labels.append([Label(name, what, colours[leg.name], *at) for at, name, what in seen])
    labels.sort(key=lambda of_leg: float(np.mean([label.x for label in of_leg])))
    for of_leg in labels[len(labels) // 2 :]:
        for label in of_leg:
            label.left = False
    return [label for of_leg in labels for label in of_leg]


def _places(robot: Robot, data: Any, leg: Leg) -> list[tuple[Array, str, str]]:
    """Return the position of each joint and of the foot of a leg [m], with its name and kind."""
    roles = ["joint" if role == "other" else role for role in robot.role_words(leg)]
    places = zip(leg.joints, roles, strict=True)
    joints = [(data.joint(joint).xanchor.copy(), joint, role) for joint, role in places]
    return [*joints, (data.geom(leg.foot).xpos.copy(), leg.foot, "foot" if leg.stands else "end")]


def _frame(robot: Robot, data: Any, eye: _Eye) -> list[tuple[str, str, tuple[float, float], tuple[float, float]]]:
    """Return the trunk's axes: text, colour, both ends [px]."""
    body = data.body(robot.trunk)
    length = 0.45 * dimensions(robot).height
    ends = body.xpos + length * body.xmat.reshape(3, 3).T
    return [
        (text, getattr(LIGHT, axis), eye.see(body.xpos), eye.see(end))
        for (axis, text), end in zip(_AXES, ends, strict=True)
    ]


def _write(pillow: Any, image: Any, robot: Robot, labels: list[Label], frame: Any) -> None:
    draw = pillow.ImageDraw.Draw(image)
    width, height = _SIZE
    font, muted, title = (pillow.ImageFont.load_default(_FINE * size) for size in (_NAME, _SMALL, 28))
    k = float(_FINE)
    draw.text((k * _EDGE, k * 22), robot.name, fill=LIGHT.ink, font=title)
    tall = f"trunk's centre of mass {dimensions(robot).height:.2f} m high"
    under = f"neutral posture · {robot.mass:.3g} kg · {tall} · {len(robot.joint_names)} joints"
    draw.text((k * _EDGE, k * 60), under, fill=LIGHT.muted, font=muted)
    for _, colour, start, end in frame:
        _arrow(draw, start, end, colour)
    for text, colour, start, end in frame:
        x, y = end[0] + 0.12 * (end[0] - start[0]), end[1] + 0.12 * (end[1] - start[1])
        box = draw.textbbox((k * x, k * y), text, font=muted, anchor="mm")
        draw.rounded_rectangle([box[0] - 8, box[1] - 6, box[2] + 8, box[3] + 6], 8, fill=LIGHT.panel)
        draw.text((k * x, k * y), text, fill=colour, font=muted, anchor="mm")
    for one, other in itertools.pairwise(labels):
        if one.colour == other.colour:  # of the same leg: its bones, for what is hidden or has no shape
            ends = [(k * label.x, k * label.y) for label in (one, other)]
            draw.line(ends, fill=one.colour, width=round(2.6 * k))
    boxes = {}
    for left in (True, False):
        chosen = sorted((label for label in labels if label.left == left), key=lambda label: label.y)
        spread_out(chosen, 2.9 * _NAME, 130.0, height - 40.0)
        for label in chosen:
            wide = max(draw.textlength(label.name, font=font), draw.textlength(label.what, font=muted)) / k + 22
            near = _EDGE if left else width - _EDGE
            far = near + wide if left else near - wide
            boxes[label.name] = (min(near, far), label.row - 1.3 * _NAME, max(near, far), label.row + 1.3 * _NAME)
            path = [(far, label.row), (far + (16 if left else -16), label.row), (label.x, label.y)]
            scaled = [(k * x, k * y) for x, y in path]
            draw.line(scaled, fill="#ffffff", width=round(4.5 * k), joint="curve")
            draw.line(scaled, fill=label.colour, width=round(1.8 * k), joint="curve")
    for label in labels:
        for radius, fill in ((7.0, "#ffffff"), (5.2, label.colour)):
            x, y = k * label.x, k * label.y
            draw.ellipse([x - k * radius, y - k * radius, x + k * radius, y + k * radius], fill=fill)
    for label in labels:
        x0, y0, x1, y1 = boxes[label.name]
        draw.rounded_rectangle([k * x0, k * y0, k * x1, k * y1], round(4 * k), fill=LIGHT.panel)
        bar = (x1 - 4, x1) if label.left else (x0, x0 + 4)
        draw.rectangle([k * bar[0], k * y0, k * bar[1], k * y1], fill=label.colour)
        at, anchor = (x0 + 8, "l") if label.left else (x1 - 8, "r")
        draw.text((k * at, k * (label.row - 0.08 * _NAME)), label.name, fill=LIGHT.ink, font=font, anchor=f"{anchor}s")
        draw.text(
            (k * at, k * (label.row + 0.95 * _NAME)), label.what, fill=LIGHT.muted, font=muted, anchor=f"{anchor}s"
        )


def _arrow(draw: Any, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
    k = float(_FINE)
    a, b = np.array(start) * k, np.array(end) * k
    along = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
    across = np.array([-along[1], along[0]])
    tip = 11 * k
    for extra, fill in ((2.0 * k, "#ffffff"), (0.0, colour)):
        draw.line([tuple(a), tuple(b - 0.5 * tip * along)], fill=fill, width=round(3 * k + 2 * extra))
        corners = [b + extra * along, b - (tip + extra) * along + (0.45 * tip + extra) * across]
        corners.append(b - (tip + extra) * along - (0.45 * tip + extra) * across)
        draw.polygon([tuple(corner) for corner in corners], fill=fill)


def spread_out(labels: list[Label], least: float, top: float, bottom: float) -> None:
    """Choose rows for labels in the order of their y, with a least distance, between top and bottom.

    Rows are as near to y as possible. Neighbours that are too near form a block around their mean; touching blocks merge.

    Args:
        labels: Labels in the order of their y. Their ``row`` is set.
        least: Least distance between rows [px].
        top: First row that may be used [px].
        bottom: Last row that may be used [px]. Too many labels go beyond it.
    """
    blocks: list[tuple[list[Label], float]] = []  # labels, row of the first

    def first_row(block: list[Label]) -> float:
        wanted = float(np.mean([label.y - least * i for i, label in enumerate(block)]))
        return float(np.clip(wanted, top, max(top, bottom - least * (len(block) - 1))))

    for label in labels:
        block = [label]
        while blocks and blocks[-1][1] + least * len(blocks[-1][0]) > first_row(block):
            block = blocks.pop()[0] + block
        blocks.append((block, first_row(block)))
    for block, row in blocks:
        for i, label in enumerate(block):
            label.row = row + least * i
