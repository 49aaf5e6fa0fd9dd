"""Compute joint angles from the motion of links, and torques from commands, for all trials at once.

Sums of three are written out instead of left to a library, whose order may depend on the number of trials.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.ode.multibody import Multibody
from levade.rotations import rotation_matrix

_STIFF = 0.2
"""Largest share of a hinge's speed that damping may take off in one explicit step."""

_FREE = 1e-9
"""Resistance of a motor that should do nothing [Nm s/rad]."""


class Angles:
    """Measures angles and speeds of the hinges on the links, as the angle between two arms, one on either link."""

    def __init__(self, multibody: Multibody) -> None:
        hinges = multibody.hinges
        joints = len(hinges.names)
        child, self._parent, self._zero = np.arange(1, joints + 1), hinges.parent, hinges.zero
        least = np.eye(3)[np.argmin(np.abs(hinges.axis), axis=1)]
        arm = np.cross(hinges.axis, least)
        arm /= np.linalg.norm(arm, axis=1, keepdims=True)
        at_rest = rotation_matrix(hinges.rest)
        across, axis = (np.einsum("jab,jb->ja", at_rest, v) for v in (np.cross(hinges.axis, arm), hinges.axis))
        self._of = np.concatenate([child, hinges.parent, hinges.parent, hinges.parent])
        self._vectors = np.concatenate([arm, np.einsum("jab,jb->ja", at_rest, arm), across, axis])
        self._joints = joints

    def __call__(self, state: Mapping[str, Array], near: Array) -> tuple[Array, Array]:
        """Return angles [rad], of all turns the one nearest to ``near``, and speeds [rad/s], shape (n, J) each."""
        rotation = state["rotation"][:, self._of]
        n, j, v = len(rotation), self._joints, self._vectors
        turned = [
            rotation[..., 3 * i] * v[:, 0] + rotation[..., 3 * i + 1] * v[:, 1] + rotation[..., 3 * i + 2] * v[:, 2]
            for i in range(3)
        ]
        arm, along, across, axis = (slice(i * j, (i + 1) * j) for i in range(4))
        x, y, z = turned
        cosine = x[:, arm] * x[:, along] + y[:, arm] * y[:, along] + z[:, arm] * z[:, along]
        sine = x[:, arm] * x[:, across] + y[:, arm] * y[:, across] + z[:, arm] * z[:, across]
        angle = np.arctan2(sine, cosine) + self._zero
        angle += 2 * np.pi * np.round((near - angle) / (2 * np.pi))
        spin = state["angular"][:, 1 : j + 1] - state["angular"][:, self._parent]
        speed = spin[..., 0] * x[:, axis] + spin[..., 1] * y[:, axis] + spin[..., 2] * z[:, axis]
        return angle, speed.reshape(n, j)


class Torques:
    """Computes drive torques and passive torques of the hinges.

    Torques are explicit: those at the start of the step. If that would be unstable, and for armature, the hinge has a motor
    that resists. It applies ``hold * (speed before) - resistance * (speed after)``. armature / timestep is in both, damping in
    the second. MuJoCo's implicit integration does the same, to the same order.

    Attributes:
        resisted: Whether each hinge has such a motor, shape (J,).
    """

    def __init__(self, multibody: Multibody, timestep: float) -> None:
        self._hinges, self._drives = multibody.hinges, multibody.drives
        hinges, drives = self._hinges, self._drives
        implicit = np.where(drives.time_constant == 0, drives.kd, 0.0)  # with a lag, MuJoCo has it explicit as well
        stiff = (hinges.damping + implicit) * timestep * _mobility(multibody) > _STIFF
        self.resisted = stiff | (hinges.armature > 0)
        self._implicit = np.where(self.resisted, implicit, 0.0)
        self._explicit = np.where(self.resisted, 0.0, hinges.damping)
        self._hold = hinges.armature / timestep
        self._damping = self._hold + np.where(self.resisted, hinges.damping, 0.0)
        with np.errstate(divide="ignore"):
            self._follow = np.where(drives.time_constant > 0, -np.expm1(-timestep / drives.time_constant), 1.0)

    def __call__(
        self, lag: Array, angle: Array, speed: Array, position: Array, velocity: Array
    ) -> tuple[Array, Array, Array, Array]:
        """Compute the torques on each hinge in a step. ``lag`` [Nm], shape (n, J), is updated in place.

        Returns:
            Torque delivered by the drives [Nm], torque on the hinge [Nm], and resistance [Nm s/rad] and target [rad/s] of its
            motor, if it has one; shape (n, J) each.
        """
        d, hinges = self._drives, self._hinges
        command = d.kp * (position - angle) + d.kd * (velocity - speed)
        command = np.clip(command, (-d.no_load - speed) * d.slope, (d.no_load - speed) * d.slope)
        lag[:] = np.where(self._follow == 1.0, command, lag + self._follow * (command - lag))
        torque = np.clip(lag, -d.limit, d.limit)
        implicit = np.where(np.abs(lag) > d.limit, 0.0, self._implicit)  # at its limit a drive does not damp
        pushed = torque + implicit * speed - self._explicit * speed - hinges.stiffness * (angle - hinges.spring)
        resistance = np.maximum(self._damping + implicit, _FREE)
        return torque, pushed, resistance, self._hold * speed / resistance


def link_motion(multibody: Multibody, qpos: Array, qvel: Array) -> tuple[Array, Array, Array, Array]:
    """Return centres of mass, quaternions, velocities and angular velocities of the links in a state, in world axes.

    Args:
        multibody: The robot's L links.
        qpos: Positions in the model's order, shape (nq,).
        qvel: Velocities in the model's order, shape (nv,).

    Returns:
        Positions of the centres of mass [m], shape (L, 3); quaternions of the links' frames, w-x-y-z, shape (L, 4);
        velocities of the centres of mass [m/s], shape (L, 3); and angular velocities [rad/s], shape (L, 3).
    """
    model, com = multibody.model, multibody.com
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = qpos, qvel
    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_fwdVelocity(model, data)
    lever = np.einsum("lab,lb->la", data.xmat[multibody.body].reshape(-1, 3, 3), com)
    twist: Array = np.zeros((len(com), 6))
    for row, body in zip(twist, multibody.body, strict=True):
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, row, 0)
    angular, linear = twist[:, :3], twist[:, 3:]
    velocity = linear + np.asarray(np.cross(angular, lever), dtype=float)
    return data.xpos[multibody.body] + lever, data.xquat[multibody.body], velocity, angular


def _mobility(multibody: Multibody) -> Array:
    """Compute the mobility of each hinge between its two links alone [rad/s² per Nm], shape (J,): no less than in the robot."""
    hinges = multibody.hinges
    at_rest = rotation_matrix(hinges.rest)
    total = []
    for j, parent in enumerate(hinges.parent):
        axis = hinges.axis[j]
        over = at_rest[j] @ axis
        total.append(axis @ np.linalg.solve(multibody.inertia[j + 1], axis))
        total[-1] += over @ np.linalg.solve(multibody.inertia[parent], over)
    return np.array(total)
