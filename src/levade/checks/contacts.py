"""Contacts of a motion's feet, and of the robot's parts with each other, computed from poses by geometry alone."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.clearance import self_contacts
from levade.motions import RecordedSimulation


@dataclass(frozen=True)
class Collision:
    """Two bodies of the robot that enter each other.

    Attributes:
        bodies: Names of the two bodies.
        depth: Largest depth [m].
        time: Time of the largest depth [s].
        share: Share of the motion's rows in which they overlap.
    """

    bodies: tuple[str, str]
    depth: float
    time: float
    share: float


@dataclass(frozen=True)
class Landing:
    """A foot that meets the scene.

    Attributes:
        foot: Name of the foot.
        time: Time of the contact [s].
        speed: Speed of the foot's centre towards the surface, just before [m/s].
    """

    foot: str
    time: float
    speed: float


def poses(simulation: RecordedSimulation) -> tuple[Array, list[Collision], Array]:
    """Pose the model as in each row of the motion, and find its contacts.

    Args:
        simulation: The motion.

    Returns:
        Centres of the feet [m], shape (steps, feet, 3); collisions, deepest first; and unit normals of the contacts on the
        feet, out of the scene, shape (steps, feet, 3), NaN for a foot without contact.
    """
    motion, model, names = simulation.motion, simulation.model, simulation.embodiment
    data = mujoco.MjData(model)
    feet = [model.geom(foot).id for foot in names.feet]
    soles = {model.geom(geom).id: number for number, leg in enumerate(motion.legs) for geom in leg.soles}
    steps = len(motion["time"])
    centres = np.empty((steps, len(feet), 3))
    normals = np.full((steps, len(feet), 3), np.nan)
    found: dict[tuple[str, str], list[tuple[float, int]]] = {}
    data.qpos[:] = motion["qpos0"]
    layout, root = simulation.layout, simulation.layout.root_qpos
    for row in range(steps):
        data.qpos[root : root + 3] = motion["trunk_position"][row]
        data.qpos[root + 3 : root + 7] = motion["trunk_quaternion"][row]
        data.qpos[layout.joint_qpos] = motion["joint_position"][row]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        centres[row] = data.geom_xpos[feet]
        for one, other, distance in self_contacts(model, data):
            if distance < 0:
                bodies = sorted((model.body(one).name, model.body(other).name))
                found.setdefault((bodies[0], bodies[1]), []).append((-distance, row))
        pairs, frames = data.contact.geom, data.contact.frame
        for pair, (one, other), frame in zip(pairs.tolist(), model.geom_bodyid[pairs].tolist(), frames, strict=True):
            if one and other:
                continue
            part = pair[1] if one == 0 else pair[0]
            if part in soles:
                normals[row, soles[part]] = frame[:3] if one == 0 else -frame[:3]
    collisions = [
        Collision(bodies, *_deepest(depths, motion["time"]), share=len({row for _, row in depths}) / steps)
        for bodies, depths in found.items()
    ]
    return centres, sorted(collisions, key=lambda one: -one.depth), normals


def scene_forces(simulation: RecordedSimulation, normals: Array) -> Array:
    """Select the recorded forces on the feet that come from the scene.

    The motion also records forces of the robot's own parts. A foot that touches a part and the scene at once keeps both.

    Args:
        simulation: The motion.
        normals: Normals of the contacts, from `poses`, shape (steps, feet, 3).

    Returns:
        Forces [N], shape (steps, feet); 0 for a foot that does not touch the scene.
    """
    known = np.asarray(np.isfinite(normals).all(axis=-1))
    touches = known.copy()
    touches[1:] |= known[:-1]  # forces of a row act during its step, but contacts belong to its end
    return np.where(touches, np.linalg.norm(simulation.motion["foot_contact_force"], axis=-1), 0.0)


def landings(simulation: RecordedSimulation, centres: Array, normals: Array, force: Array) -> list[Landing]:
    """Find all landings: a foot without force comes to bear some. The start does not count.

    Args:
        simulation: The motion.
        centres: Centres of the feet, from `poses` [m], shape (steps, feet, 3).
        normals: Normals of the contacts, from `poses`, shape (steps, feet, 3).
        force: Forces of the scene on the feet [N], shape (steps, feet).

    Returns:
        The landings, in order.
    """
    motion, step, loaded = simulation.motion, simulation.timestep, force > 0
    first = loaded[1:] & ~loaded[:-1]
    found = []
    for row, foot in zip(*np.nonzero(first), strict=True):
        # forces of a row act during its step, but positions belong to its end: the foot was free until the row before
        before = int(row)
        if before == 0:
            continue
        velocity = (centres[before, foot] - centres[before - 1, foot]) / step
        out = normals[before : before + 2, foot]
        normal = out[np.isfinite(out).all(axis=-1)][-1]
        speed = max(0.0, -float(velocity @ normal))
        found.append(Landing(simulation.embodiment.feet[foot], float(motion["time"][row]), speed))
    return found


def _deepest(depths: list[tuple[float, int]], time: Array) -> tuple[float, float]:
    depth, row = max(depths)
    return depth, float(time[row])
