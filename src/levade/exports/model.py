"""Values that an export takes from the motion's model: actuators, the start, and the torque that holds it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion


def gains(model: mujoco.MjModel, joints: Sequence[str]) -> tuple[Array, Array]:
    """Return position gain [Nm/rad] and velocity gain [Nm s/rad] of each joint's actuator, shape (joints,) each.

    The actuators are MuJoCo's dcmotor with a controller, or pid (see `levade.robots.actuation`).

    Args:
        model: The compiled model.
        joints: Names of the joints.

    Returns:
        The gains.

    Raises:
        LevadeError: If a joint has another actuator.
    """
    kp, kd = np.zeros(len(joints)), np.zeros(len(joints))
    for i, name in enumerate(joints):
        drive = drive_of(model, name)
        if drive is None:
            raise LevadeError(f"motion: joint {name} has no single pid or dcmotor actuator; give its gains, kp and kd")
        kp[i], kd[i] = drive.kp, drive.kd
    return kp, kd


@dataclass(frozen=True)
class Drive:
    """Describes a joint's actuator: see `levade.robots.actuation`.

    Attributes:
        kind: "pid" or "dcmotor".
        kp: Position gain [Nm/rad].
        kd: Velocity gain [Nm s/rad].
        torque: Largest delivered torque [Nm], infinite for no limit.
        stall_torque: Torque at standstill of the line that bounds a driving joint [Nm], infinite for none.
        no_load_speed: Speed at which that line is zero [rad/s], infinite for none.
        time_constant: Lag from commanded to delivered torque [s]; 0 for none.
    """

    kind: str
    kp: float
    kd: float
    torque: float
    stall_torque: float = np.inf
    no_load_speed: float = np.inf
    time_constant: float = 0.0


def drive_of(model: mujoco.MjModel, joint: str) -> Drive | None:
    """Read a joint's actuator from the model. None unless it has a single pid or dcmotor.

    Args:
        model: The compiled model.
        joint: Name of the joint.

    Returns:
        The actuator, or None.
    """
    at_joint = model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT
    driving = np.flatnonzero((model.actuator_trnid[:, 0] == model.joint(joint).id) & at_joint)
    if len(driving) != 1:
        return None
    i = int(driving[0])
    torque = float(model.actuator_forcerange[i, 1]) if model.actuator_forcelimited[i] else np.inf
    gain, bias = model.actuator_gainprm[i], model.actuator_biasprm[i]
    if model.actuator_gaintype[i] == mujoco.mjtGain.mjGAIN_PID:
        return Drive("pid", -float(bias[1]), -float(bias[2]), torque)
    if model.actuator_gaintype[i] != mujoco.mjtGain.mjGAIN_DCMOTOR:
        return None
    # resistance, motor constant and voltage limit: the line is (voltage - constant * speed) * constant / resistance
    resistance, constant, voltage = float(gain[0]), float(gain[1]), float(gain[7])
    lined = resistance > 0 and voltage > 0
    return Drive(
        kind="dcmotor",
        kp=float(gain[4]),
        kd=float(gain[6]),
        torque=torque,
        stall_torque=voltage * constant / resistance if lined else np.inf,
        no_load_speed=voltage / constant if lined else np.inf,
        time_constant=float(model.actuator_dynprm[i, 0]) if model.actuator_actadr[i] >= 0 else 0.0,
    )


def holding_torque(motion: Motion, model: mujoco.MjModel) -> Array:
    """Compute the torques of the joints at the start, within their limits, if nothing accelerates.

    They come from inverse dynamics. A standing robot still moves a little, and that counts: it decides the friction of
    its feet.

    Args:
        motion: The motion.
        model: Its compiled model.

    Returns:
        Torques [Nm], shape (joints,).
    """
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.qacc[:] = motion["qpos0"], motion["qvel0"], 0.0
    mujoco.mj_inverse(model, data)
    limit = motion.embodiment.limits.torque
    return np.clip(data.qfrc_inverse[motion.addresses(model).joint_qvel], -limit, limit)
