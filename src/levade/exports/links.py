"""Describe the robot as a tree of links, and compute where the links are during a motion.

    links = links_of(model)
    frames = frames_of(links, samples)            # every link at every row, without a loop over rows
    frames.position, frames.linear_velocity       # (rows, links, 3)

Each link is joined to its parent by one hinge or none. A link is a body of the model, under the body's name. A body that turns
about several hinges has links ``BODY_JOINT`` before it. If a hinge does not go through its body's origin, the link's frame is
on the hinge, because URDF knows no other place. ``shift`` is then the place of the body's frame.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.exports.samples import Samples
from levade.rotations import exponential, multiply, rotate


@dataclass(frozen=True, eq=False)
class Link:
    """Describes a link.

    Position [m], shape (3,), and quaternion, shape (4,), place its frame in the parent's at joint angle zero.

    Attributes:
        name: Name of the body.
        parent: Index of the parent's link. None for the trunk, which is free in the world.
        joint: Name of the hinge. None if the link is fixed to its parent.
        axis: Axis of the hinge in the link's frame, shape (3,).
        body: Index in the model. None for a link between two hinges of a body.
        shift: Origin of the body's frame in the link's [m], shape (3,).
    """

    name: str
    parent: int | None
    position: Array
    quaternion: Array
    joint: str | None
    axis: Array
    body: int | None
    shift: Array


@dataclass(frozen=True, eq=False)
class Frames:
    """Frames of links over time.

    Attributes:
        position: Origins in the world [m], shape (rows, n, 3).
        quaternion: Frame to world, shape (rows, n, 4).
        linear_velocity: Velocities of the origins, world axes [m/s], shape (rows, n, 3).
        angular_velocity: Angular velocities, world axes [rad/s], shape (rows, n, 3).
        relative_position: Origins in the parent's frame, the trunk's in the world [m], shape (rows, n, 3).
        relative_quaternion: Frame to the parent's, shape (rows, n, 4).
    """

    position: Array
    quaternion: Array
    linear_velocity: Array
    angular_velocity: Array
    relative_position: Array
    relative_quaternion: Array


def links_of(model: mujoco.MjModel) -> list[Link]:
    """List the robot's links, parents before children, in the model's order of bodies. The scene has no bodies.

    Args:
        model: Robot and scene.

    Returns:
        The links.
    """
    links: list[Link] = []
    of_body: dict[int, int] = {}
    for body in range(1, model.nbody):
        parent = int(model.body_parentid[body])
        joints = [model.joint(int(model.body_jntadr[body]) + i) for i in range(int(model.body_jntnum[body]))]
        hinges = [joint for joint in joints if model.jnt_type[joint.id] == mujoco.mjtJoint.mjJNT_HINGE]
        name = model.body(body).name or f"body{body}"
        # origin of the body's frame, at angle zero, in the frame of the link before
        before = links[of_body[parent]].shift if parent in of_body else np.zeros(3)
        position, quaternion = before + model.body_pos[body], model.body_quat[body].copy()
        above = of_body.get(parent)
        for i, hinge in enumerate(hinges):
            last, at, axis = i == len(hinges) - 1, hinge.pos.copy(), hinge.axis.copy()
            zero = exponential(-float(model.qpos0[hinge.qposadr[0]]) * axis)
            links.append(
                Link(
                    name=name if last else f"{name}_{hinge.name}",
                    parent=above,
                    position=position + rotate(quaternion, at),
                    quaternion=multiply(quaternion, zero),
                    joint=hinge.name,
                    axis=axis,
                    body=body if last else None,
                    shift=-at,
                )
            )
            # the next hinge hangs on this link
            above, position, quaternion = len(links) - 1, -at, np.array([1.0, 0.0, 0.0, 0.0])
        if not hinges:
            links.append(Link(name, above, position, quaternion, None, np.zeros(3), body, np.zeros(3)))
        of_body[body] = len(links) - 1
    return links


def frames_of(links: list[Link], samples: Samples) -> Frames:
    """Compute where each link is, and how it moves, at every row.

    Args:
        links: The links.
        samples: The motion.

    Returns:
        The frames of the links.
    """
    rows, n = len(samples.time), len(links)
    frames = Frames(*(np.empty((rows, n, width)) for width in (3, 4, 3, 3, 3, 4)))
    column = {name: i for i, name in enumerate(samples.joints.names)}
    for i, link in enumerate(links):
        if link.parent is None:
            frames.relative_position[:, i], frames.relative_quaternion[:, i] = (
                samples.trunk_position,
                samples.trunk_quaternion,
            )
            frames.position[:, i], frames.quaternion[:, i] = samples.trunk_position, samples.trunk_quaternion
            frames.linear_velocity[:, i] = samples.trunk_linear_velocity
            frames.angular_velocity[:, i] = samples.trunk_angular_velocity
            continue
        angle, rate = np.zeros(rows), np.zeros(rows)
        if link.joint is not None:
            angle = samples.joint_position[:, column[link.joint]]
            rate = samples.joint_velocity[:, column[link.joint]]
        relative = multiply(np.broadcast_to(link.quaternion, (rows, 4)), exponential(angle[:, None] * link.axis))
        p, q = frames.position[:, link.parent], frames.quaternion[:, link.parent]
        v, w = frames.linear_velocity[:, link.parent], frames.angular_velocity[:, link.parent]
        arm, turned = rotate(q, link.position), multiply(q, relative)
        frames.relative_position[:, i], frames.relative_quaternion[:, i] = link.position, relative
        frames.position[:, i], frames.quaternion[:, i] = p + arm, turned
        frames.linear_velocity[:, i] = v + np.cross(w, arm)
        frames.angular_velocity[:, i] = w + rotate(turned, rate[:, None] * link.axis)
    return frames


def body_frames(links: list[Link], frames: Frames) -> Frames:
    """Return the frames of the model's bodies, as in MuJoCo and in its order.

    Relative values remain those of the links.

    Args:
        links: The links, from `links_of`.
        frames: Frames of all of them, from `frames_of`.

    Returns:
        Frames of the bodies, shape (rows, bodies, ...) each.
    """
    index = [i for i, link in enumerate(links) if link.body is not None]
    shift = np.array([links[i].shift for i in index])
    quaternion, w = frames.quaternion[:, index], frames.angular_velocity[:, index]
    arm = rotate(quaternion, shift)
    return Frames(
        frames.position[:, index] + arm,
        quaternion,
        frames.linear_velocity[:, index] + np.cross(w, arm),
        w,
        frames.relative_position[:, index],
        frames.relative_quaternion[:, index],
    )
