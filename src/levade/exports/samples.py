"""Sample a motion at the rate of the program that plays or shows it: commands to the joints, and the robot's state.

    samples = sample(motion, rate=500.0)
    samples.command_position, samples.command_torque     # (rows, joints) [rad], [Nm]

Row j is the instant ``j / rate`` of the motion; row 0 is its start. A command is sent at its instant, and stays in force until
the next one. States are those of the instant. Torques and contact forces are means until the next instant, which keeps every
impulse.

Two kinds of command produce a motion:

    measured   the angles and velocities that the joints had in the simulation, and the torque that they delivered
    commanded  the angles and velocities that they were commanded in the simulation, and no torque

A drive delivers ``kp (position - q) + kd (velocity - qd) + torque``. On the motion, q and qd are the measured ones. With
measured commands the drive then delivers the recorded torque for any gains. With commanded ones it does so if it has the gains,
lag and limits of the simulated drive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.exports.model import gains, holding_torque
from levade.motions import Motion, ReferenceCurve
from levade.motions.interpolation import hermite, linear, locate, mean, rotations
from levade.rotations import rotate

REFERENCES = ("measured", "commanded")

_PER_JOINT = (
    "command_position",
    "command_velocity",
    "command_torque",
    "joint_position",
    "joint_velocity",
    "joint_torque",
)
_MOST = 1_000_000
"""Largest number of rows."""


@dataclass(frozen=True, eq=False)
class Joints:
    """Values for each joint, shape (joints,).

    Gains are in Nm/rad and Nm s/rad. Limits are in rad, rad/s and Nm, infinite for none. Angle [rad] and torque [Nm] are to be
    held before the motion starts.
    """

    names: tuple[str, ...]
    kp: Array
    kd: Array
    lower: Array
    upper: Array
    velocity: Array
    torque: Array
    start_position: Array
    start_torque: Array


@dataclass(frozen=True, eq=False)
class Samples:
    """Holds rows of commands and of the state at the same time. Arrays over joints are in the order of ``joints.names``.

    Attributes:
        time: Instants [s], shape (rows,).
        rate: Rows per second [Hz].
        reference: One of `REFERENCES`.
        command_position: Commanded angles [rad], shape (rows, joints).
        command_velocity: Commanded velocities [rad/s], shape (rows, joints).
        command_torque: Feed-forward torques [Nm], shape (rows, joints).
        joint_position: Angles in the simulation [rad], shape (rows, joints).
        joint_velocity: Velocities in the simulation [rad/s], shape (rows, joints).
        joint_torque: Delivered torques in the simulation [Nm], shape (rows, joints).
        trunk_position: Origin of the trunk frame [m], shape (rows, 3).
        trunk_com_position: The trunk's centre of mass [m], shape (rows, 3).
        trunk_quaternion: Trunk to world, w-x-y-z, shape (rows, 4).
        trunk_linear_velocity: Velocity of the trunk frame's origin, world axes [m/s], shape (rows, 3).
        trunk_angular_velocity: Angular velocity, world axes [rad/s], shape (rows, 3).
        foot_contact_force: Forces on the feet, world axes [N], shape (rows, feet, 3).
        analytic: Whether commanded references between the simulated ones come from the policy itself.
    """

    time: Array
    rate: float
    reference: str
    joints: Joints
    command_position: Array
    command_velocity: Array
    command_torque: Array
    joint_position: Array
    joint_velocity: Array
    joint_torque: Array
    trunk_position: Array
    trunk_com_position: Array
    trunk_quaternion: Array
    trunk_linear_velocity: Array
    trunk_angular_velocity: Array
    feet: tuple[str, ...]
    foot_contact_force: Array
    analytic: bool

    def reordered(self, order: Sequence[int], names: Sequence[str]) -> Samples:
        """Return the same samples with the joints in another order and under other names.

        Args:
            order: Index of each joint in these samples, in the new order.
            names: New name of each joint, in the new order.

        Returns:
            The reordered samples.
        """
        index = list(order)
        arrays = {name: getattr(self.joints, name)[index] for name in Joints.__dataclass_fields__ if name != "names"}
        joints = Joints(names=tuple(names), **arrays)
        return replace(self, joints=joints, **{name: getattr(self, name)[:, index] for name in _PER_JOINT})


def sample(
    motion: Motion,
    model: mujoco.MjModel,
    *,
    rate: float,
    reference: str = "measured",
    hold: bool = True,
    kp: float | None = None,
    kd: float | None = None,
) -> Samples:
    """Sample a motion.

    Args:
        motion: A motion.
        model: Its compiled model.
        rate: Rows per second [Hz].
        reference: "measured": positions, velocities and torques of the joints. "commanded": their commands.
        hold: Whether to go on after the horizon.
        kp: Position gain of all joints [Nm/rad], instead of the simulation's; only with "measured".
        kd: Velocity gain of all joints [Nm s/rad], instead of the simulation's; only with "measured".

    Returns:
        The motion at this rate.

    Raises:
        LevadeError: If the rate is not valid, the gains do not go with the reference, or the motion broke down.
    """
    if reference not in REFERENCES:
        raise LevadeError(f"no reference {reference!r}; {did_you_mean(reference, REFERENCES)}", field="reference")
    for field, gain in (("kp", kp), ("kd", kd)):
        if gain is not None and not (math.isfinite(gain) and gain >= 0):
            raise LevadeError(f"{gain} should be a number that is not negative", field=field)
        if gain is not None and reference == "commanded":
            raise LevadeError(
                "commanded references only make the motion with the gains of the simulation; leave it out, or choose"
                " the reference measured",
                field=field,
            )
    if motion.result.diverged or not all(np.isfinite(v).all() for v in motion.arrays.values() if v.dtype.kind == "f"):
        raise LevadeError("motion: its simulation broke down, there is nothing to export; solve the task again")
    timestep, steps = motion.timestep, motion.steps
    end = (steps if hold else motion.horizon_steps) * timestep
    time = _times(rate, end)
    state = _state(motion, model, time, timestep)
    until = time + 1.0 / rate
    names = motion.joint_names
    torque = mean(time, until, motion["joint_torque"], timestep)
    force = mean(time, until, motion["foot_contact_force"].reshape(steps, -1), timestep)
    curve = ReferenceCurve.of(motion)
    sent_position, sent_velocity = curve.in_force(time)
    measured = reference == "measured"
    return Samples(
        time=time,
        rate=float(rate),
        reference=reference,
        joints=_joints(motion, model, names, kp, kd),
        command_position=state["joint_position"] if measured else sent_position,
        command_velocity=state["joint_velocity"] if measured else sent_velocity,
        command_torque=torque if measured else np.zeros_like(torque),
        joint_torque=torque,
        feet=motion.embodiment.feet,
        foot_contact_force=force.reshape(len(time), -1, 3),
        analytic=curve.policy is not None,
        **state,
    )


def _times(rate: float, end: float) -> Array:
    if not (math.isfinite(rate) and rate > 0):
        raise LevadeError(f"{rate} should be a positive number of rows per second, such as 500", field="rate")
    rows = math.floor(end * rate * (1 + 1e-12)) + 1
    if not 2 <= rows <= _MOST:
        raise LevadeError(
            f"{rate:g} Hz gives {rows} row{'s' * (rows != 1)} for {end:g} s of motion; should be 2 to {_MOST}",
            field="rate",
        )
    return np.arange(rows) / rate


def _joints(
    motion: Motion, model: mujoco.MjModel, names: tuple[str, ...], kp: float | None, kd: float | None
) -> Joints:
    if kp is None or kd is None:
        own_kp, own_kd = gains(model, names)
    else:
        own_kp = own_kd = np.zeros(len(names))
    limits = motion.embodiment.limits
    return Joints(
        names=names,
        kp=own_kp if kp is None else np.full(len(names), float(kp)),
        kd=own_kd if kd is None else np.full(len(names), float(kd)),
        lower=limits.lower,
        upper=limits.upper,
        velocity=limits.velocity,
        torque=limits.torque,
        start_position=motion["qpos0"][motion.addresses(model).joint_qpos],
        start_torque=holding_torque(motion, model),
    )


def _state(motion: Motion, model: mujoco.MjModel, time: Array, timestep: float) -> dict[str, Array]:
    """Compute the state of joints and trunk at the times: the start, then the end of each step."""
    qpos, qvel = motion["qpos0"], motion["qvel0"]
    at = motion.addresses(model)

    def knots(first: Array, name: str) -> Array:
        return np.concatenate([first[None], motion[name]])

    angle, speed = knots(qpos[at.joint_qpos], "joint_position"), knots(qvel[at.joint_qvel], "joint_velocity")
    place = knots(qpos[at.trunk_position], "trunk_position")
    going = knots(qvel[at.trunk_linear_velocity], "trunk_linear_velocity")
    first = qpos[at.trunk_quaternion] / np.linalg.norm(qpos[at.trunk_quaternion])
    attitude = knots(first, "trunk_quaternion")
    rate = knots(qvel[at.trunk_angular_velocity], "trunk_angular_velocity")  # in trunk axes
    interval, share = locate(time, timestep, len(angle) - 1)
    position = hermite(interval, share, place, going, timestep)
    quaternion = rotations(interval, share, attitude, rate, timestep)
    return {
        "joint_position": hermite(interval, share, angle, speed, timestep),
        "joint_velocity": linear(interval, share, speed),
        "trunk_position": position,
        "trunk_com_position": position + rotate(quaternion, motion.embodiment.trunk_com_offset),
        "trunk_quaternion": quaternion,
        "trunk_linear_velocity": linear(interval, share, going),
        "trunk_angular_velocity": linear(interval, share, rotate(attitude, rate)),
    }
