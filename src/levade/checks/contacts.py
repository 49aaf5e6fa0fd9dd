"""What a motion does with its feet, and with parts of the robot that meet each other: from poses, by geometry alone."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.clearance import self_contacts
from levade.motions import RecordedSimulation


@dataclass(frozen=True)
class Collision:
    """Two bodies of the robot in each other. depth: [m], the deepest. time: [s], when. share: of the motion's rows."""

    bodies: tuple[str, str]
    depth: float
    time: float
    share: float


@dataclass(frozen=True)
class Landing:
    """A foot that meets the scene. time: [s]. speed: [m/s], of the foot's centre towards what it meets, just before."""

    foot: str
    time: float
    speed: float


def poses(simulation: RecordedSimulation) -> tuple[Array, list[Collision], Array]:
    """The motion's poses in the model.

    Returns (steps, feet, 3) [m], centres of the feet; what collides with what; and (steps, feet, 3), unit normals of the
    contacts on the feet, out of the scene, NaN where there is none. A row at a time: a motion is checked once.
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
        for contact in data.contact:
            pair = [int(geom) for geom in contact.geom]
            one, other = (int(model.geom_bodyid[geom]) for geom in pair)
            if one and other:
                continue
            part = pair[1] if one == 0 else pair[0]
            if part in soles:
                normals[row, soles[part]] = contact.frame[:3] if one == 0 else -contact.frame[:3]
    collisions = [
        Collision(bodies, *_deepest(depths, motion["time"]), share=len({row for _, row in depths}) / steps)
        for bodies, depths in found.items()
    ]
    return centres, sorted(collisions, key=lambda one: -one.depth), normals


def scene_forces(simulation: RecordedSimulation, normals: Array) -> Array:
    """(steps, feet) [N]: the file's forces on the feet where they touch the scene, else 0.

    The file has those of the robot's own parts, too; a foot that touches both at once keeps both.
    """
    known = np.asarray(np.isfinite(normals).all(axis=-1))
    touches = known.copy()
    touches[1:] |= known[:-1]  # forces of a row act during its step, contacts are those at its end
    return np.where(touches, np.linalg.norm(simulation.motion["foot_contact_force"], axis=-1), 0.0)


def landings(simulation: RecordedSimulation, centres: Array, normals: Array, force: Array) -> list[Landing]:
    """Every time that a foot without force (steps, feet) comes to bear some; nothing at the start."""
    motion, step, loaded = simulation.motion, simulation.timestep, force > 0
    first = loaded[1:] & ~loaded[:-1]
    found = []
    for row, foot in zip(*np.nonzero(first), strict=True):
        # forces of a row act during its step, positions are those at its end: the foot was free until the row before
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
