"""Adapt the trunk's pose at the start of a motion, if the robot or its joints differ a little.

A joint that is off by 0.03 rad moves a foot by 2 cm. A standing robot then neither floats nor penetrates the ground, but its
trunk has another pose. So the trunk moves in height, roll and pitch until the same points touch the scene again, as well as a
rigid robot can. Other perturbations follow.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np
from mujoco.batch import Batch

from levade.arrays import Array
from levade.engines.layout import Layout
from levade.engines.perturbation import ground, obstacles
from levade.engines.state import State
from levade.rotations import exponential, multiply, rotate

_TOUCHING = 0.003
"""Gap up to which a part counts as touching [m]."""
_RIDGE = 1e-3
"""Keeps the trunk from turning about an axis that nothing holds [m2]; feet are some 0.5 m apart."""
_STEEP = 0.3
"""Least vertical share of a contact's normal for which lifting the robot resolves the contact."""


class Stance:
    """The contacts of a model with its scene in one state, of one row."""

    def __init__(self, model: mujoco.MjModel, layout: Layout, start: State) -> None:
        self._model, self._layout = model, layout
        data = mujoco.MjData(model)
        data.qpos[:] = start.qpos[0]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        bodies, local, normals, geoms = [], [], [], []
        for contact in data.contact:
            one, other = (int(geom) for geom in contact.geom)
            on_scene = [model.geom_bodyid[geom] == 0 for geom in (one, other)]
            if contact.dist > _TOUCHING or on_scene[0] == on_scene[1]:
                continue
            scene, part = (one, other) if on_scene[0] else (other, one)
            body = int(model.geom_bodyid[part])
            bodies.append(body)
            local.append(data.xmat[body].reshape(3, 3).T @ (contact.pos - data.xpos[body]))
            normals.append(contact.frame[:3] if on_scene[0] else -contact.frame[:3])
            geoms.append(scene)
        self._bodies = np.array(bodies, dtype=int)
        self._local = np.array(local).reshape(-1, 3)
        self._normals = np.array(normals).reshape(-1, 3)
        self._points = np.array(
            [data.xpos[b] + data.xmat[b].reshape(3, 3) @ p for b, p in zip(bodies, local, strict=True)]
        )
        self._points = self._points.reshape(-1, 3)
        self._geoms = np.array(geoms, dtype=int)

    def perturb(self, qpos: Array, qvel: Array, values: Mapping[str, Array]) -> None:
        """Change states in place by a sample's values. All of them begin as the start.

        Args:
            qpos: Positions in the model's order, shape (n, nq); they are changed.
            qvel: Velocities in the model's order, shape (n, nv); they are changed.
            values: Parameter -> its values, shape (n, numbers), as in `levade.engines.Sample`.
        """
        layout = self._layout
        position = slice(layout.root_qpos, layout.root_qpos + 3)
        attitude = slice(layout.root_qpos + 3, layout.root_qpos + 7)
        qpos[:, layout.joint_qpos] += values["start_joint"]
        moved = self._scene_moved(values)
        if self._bodies.size:
            points = self._where(qpos)
            gap = self._gap(points, moved)
            lift, turn = self._fit(points - qpos[:, None, position], gap)
            _move(qpos, position, attitude, lift, turn)
            points = _moved(points, qpos[:, position] - lift, lift, turn)
        else:
            points = np.empty((len(qpos), 0, 3))
        turn = values["start_attitude"]
        origin = qpos[:, position].copy()
        _move(qpos, position, attitude, np.zeros_like(origin), turn)
        points = _moved(points, origin, np.zeros_like(origin), turn)
        below = self._normals[:, 2] > _STEEP
        if below.any():  # no part deeper in what is below it than at the start, and one as deep
            gap = self._gap(points, moved)[:, below] / self._normals[below, 2]
            qpos[:, layout.root_qpos + 2] -= gap.min(axis=1)
        rate = layout.root_qvel
        qvel[:, rate : rate + 3] += values["start_velocity"]
        qvel[:, rate + 3 : rate + 6] += values["start_rate"]
        qvel[:, layout.joint_qvel] += values["start_joint_velocity"]

    def _scene_moved(self, values: Mapping[str, Array]) -> Array:
        """Compute how far the scene's part in each contact has moved [m], shape (n, contacts, 3)."""
        model = self._model
        moved = np.zeros((len(values["mass"]), model.ngeom, 3))
        moved[:, ground(model), 2] = values["ground_height"]
        for i, geom in enumerate(obstacles(model)):
            moved[:, geom] = values["obstacle"][:, 3 * i : 3 * i + 3]
        return moved[:, self._geoms]

    def _where(self, qpos: Array) -> Array:
        """Compute the positions of the robot's touching points [m], shape (n, contacts, 3)."""
        n = len(qpos)
        batch = Batch(self._model, n, 1)
        position, matrix = batch.bind("xpos"), batch.bind("xmat")
        batch.bind("qpos")[:n] = qpos
        batch.forward(np.arange(n), stage=mujoco.mjtStage.mjSTAGE_POS)
        turned = np.einsum("ncij,cj->nci", matrix[:n, self._bodies].reshape(n, -1, 3, 3), self._local)
        return position[:n, self._bodies] + turned

    def _gap(self, points: Array, moved: Array) -> Array:
        """Compute the gaps between robot and scene beyond those at the start [m], shape (n, contacts); negative if deeper."""
        return np.einsum("nci,ci->nc", points - self._points - moved, self._normals)

    def _fit(self, lever: Array, gap: Array) -> tuple[Array, Array]:
        """Fit the lift [m] and small turn [rad] of the trunk, shape (n, 3) each, that close the gaps best."""
        normal = self._normals
        turning = np.cross(lever, normal)  # n . (turn x lever) = turn . (lever x n)
        rates = np.stack([np.broadcast_to(normal[:, 2], gap.shape), turning[..., 0], turning[..., 1]], axis=-1)
        square = np.einsum("nci,ncj->nij", rates, rates) + np.diag([1e-9, _RIDGE, _RIDGE])
        change = -np.linalg.solve(square, np.einsum("nci,nc->ni", rates, gap)[..., None])[..., 0]
        zero = np.zeros(len(gap))
        lift = np.stack([zero, zero, change[:, 0]], axis=-1)
        return lift, np.stack([change[:, 1], change[:, 2], zero], axis=-1)


def _move(qpos: Array, position: slice, attitude: slice, lift: Array, turn: Array) -> None:
    """Lift the trunk, and turn it about its frame's origin, in world axes."""
    qpos[:, position] += lift
    qpos[:, attitude] = multiply(exponential(turn), qpos[:, attitude])


def _moved(points: Array, origin: Array, lift: Array, turn: Array) -> Array:
    """Return the points, shape (n, contacts, 3), after `_move` of a trunk with its origin at (n, 3) before."""
    lever = rotate(exponential(turn)[:, None], points - origin[:, None])
    return (origin + lift)[:, None] + lever
