"""Forces and impacts of every contact of a motion: between two parts of the robot, and between a part and the scene.

    contacts = replay_contacts(RecordedSimulation(motion))
    contacts.forces["lf_lower", "rf_lower"]         # the largest force between the two [N]
    contacts.impacts                                # each time that two bodies meet, and how fast

The motion is replayed in MuJoCo, because its file holds the forces on feet alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.batches import RESET_OFF, quiet
from levade.motions import RecordedSimulation

SCENE = "scene"
"""Name of the scene, among the bodies that meet."""

_FORCE = 1e-9
"""Below this force a contact exists in the solver's rounding only [N]."""


@dataclass(frozen=True)
class Impact:
    """Two bodies that meet.

    Attributes:
        bodies: Names of the two bodies, in ascending order, or of the body and `SCENE`.
        time: End of the step in which they first press on each other [s].
        speed: Speed with which the two surfaces approach each other where they meet, just before [m/s].
    """

    bodies: tuple[str, str]
    time: float
    speed: float


@dataclass(frozen=True)
class Contacts:
    """Contacts of a motion.

    Attributes:
        forces: Names of two parts of the robot -> largest net force between them [N].
        impacts: All impacts, in order. Bodies that touch at the start do not meet.
    """

    forces: Mapping[tuple[str, str], float]
    impacts: tuple[Impact, ...]

    def hardest(self) -> dict[tuple[str, str], float]:
        """Return the largest speed of each two bodies that meet [m/s]."""
        found: dict[tuple[str, str], float] = {}
        for one in self.impacts:
            found[one.bodies] = max(one.speed, found.get(one.bodies, 0.0))
        return found


def replay_contacts(simulation: RecordedSimulation) -> Contacts:
    """Replay a motion on the nominal model in MuJoCo, and collect its contacts.

    Args:
        simulation: The motion.

    Returns:
        The contacts. If the simulation breaks down, those before.
    """
    model = simulation.model_copy()
    model.opt.disableflags |= RESET_OFF
    data, start, time = mujoco.MjData(model), simulation.start, simulation.motion["time"]
    data.qpos[:], data.qvel[:], data.act[:] = start.qpos[0], start.qvel[0], start.act[0]
    forces: dict[tuple[int, int], float] = {}
    impacts: list[Impact] = []
    before: set[tuple[int, int]] | None = None
    for row, ctrl in enumerate(simulation.engine.ctrl(simulation.reference)[0]):
        data.ctrl[:] = ctrl
        velocity = data.qvel.copy()
        with quiet():
            mujoco.mj_step(model, data)
        if data.warning.number.any():
            break
        net, found = _pressing(model, data)
        for pair, force in net.items():
            if pair[0]:
                forces[pair] = max(float(np.linalg.norm(force)), forces.get(pair, 0.0))
        if before is not None:
            for pair in net.keys() - before:
                speed = max(_approach(model, data, contact, velocity) for contact in found[pair])
                impacts.append(Impact(_names(model, pair), float(time[row]), max(0.0, speed)))
        before = set(net)
    impacts.sort(key=lambda one: (one.time, one.bodies))
    return Contacts({_names(model, pair): force for pair, force in forces.items()}, tuple(impacts))


def _pressing(
    model: mujoco.MjModel, data: mujoco.MjData
) -> tuple[dict[tuple[int, int], Array], dict[tuple[int, int], list[int]]]:
    """Return the net force [N] between each two bodies that press on each other in a step, and indices of their contacts."""
    net: dict[tuple[int, int], Array] = {}
    found: dict[tuple[int, int], list[int]] = {}
    wrench = np.empty(6)
    contacts = data.contact
    bodies, frames = model.geom_bodyid[contacts.geom].tolist(), contacts.frame
    for i in np.flatnonzero(contacts.efc_address >= 0).tolist():
        one, other = bodies[i]
        mujoco.mj_contactForce(model, data, i, wrench)
        if one == other or not np.linalg.norm(wrench[:3]) > _FORCE:
            continue
        force = frames[i].reshape(3, 3).T @ wrench[:3]
        pair = (min(one, other), max(one, other))
        net[pair] = net.get(pair, 0.0) + (force if one < other else -force)
        found.setdefault(pair, []).append(i)
    return net, found


def _approach(model: mujoco.MjModel, data: mujoco.MjData, contact: int, velocity: Array) -> float:
    """Return the speed of a contact's two bodies towards each other at its place, at given velocities of the model [m/s]."""
    geom, frame = data.contact.geom[contact], data.contact.frame[contact]
    moving = []
    for body in model.geom_bodyid[geom]:
        jacobian = np.zeros((3, model.nv))
        mujoco.mj_jac(model, data, jacobian, None, data.contact.pos[contact], int(body))
        moving.append(jacobian @ velocity)
    return float(frame[:3] @ (moving[0] - moving[1]))  # the normal points from the first to the second


def _names(model: mujoco.MjModel, pair: tuple[int, int]) -> tuple[str, str]:
    """Return the names of two bodies, of which the first may be the world."""
    one, other = (model.body(body).name for body in pair)
    if not pair[0]:
        return other, SCENE
    return min(one, other), max(one, other)
