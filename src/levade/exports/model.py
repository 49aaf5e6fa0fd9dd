"""What an export needs of the motion's own model: actuators, the state at the start, and the torque that keeps it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion


def gains(model: mujoco.MjModel, joints: Sequence[str]) -> tuple[Array, Array]:
    """Position gain [Nm/rad] and velocity gain [Nm s/rad] of each joint's actuator, shape (joints,) each.

    The actuators are MuJoCo's dcmotor with a controller, or pid (see `levade.robots.actuation`).

    Raises:
        LevadeError: For others.
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
    """A joint's actuator, see `levade.robots.actuation`.

    Attributes:
        kind: "pid" or "dcmotor".
        kp: [Nm/rad].
        kd: [Nm s/rad].
        torque: [Nm], the most it delivers, infinite for no limit. stall_torque [Nm] and no_load_speed [rad/s]: the line
            that bounds the torque while driving; infinite for none.
        time_constant: [s], of the lag from commanded to delivered torque; 0 for none.
    """

    kind: str
    kp: float
    kd: float
    torque: float
    stall_torque: float = np.inf
    no_load_speed: float = np.inf
    time_constant: float = 0.0


def drive_of(model: mujoco.MjModel, joint: str) -> Drive | None:
    """Read a joint's actuator from the model; None unless it has a single pid or dcmotor."""
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
    """(joints,) [Nm], what the joints deliver at the start, within their limits, if nothing accelerates there.

    By inverse dynamics. The little that a standing robot still moves counts: friction between feet and ground hangs on it.
    """
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.qacc[:] = motion["qpos0"], motion["qvel0"], 0.0
    mujoco.mj_inverse(model, data)
    limit = motion.embodiment.limits.torque
    return np.clip(data.qfrc_inverse[motion.addresses(model).joint_qvel], -limit, limit)
