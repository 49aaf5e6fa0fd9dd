"""What an export needs of the motion's own model: gains, the state at the start, and the torque that keeps it."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion


def gains(model: mujoco.MjModel, joints: Sequence[str]) -> tuple[Array, Array]:
    """kp [Nm/rad] and kd [Nm s/rad] of each joint's actuator, (joints,) each.

    The actuators are MuJoCo's dcmotor with a controller, or pid (see `levade.robots.actuation`). Raises LevadeError for others.
    """
    kp, kd = np.zeros(len(joints)), np.zeros(len(joints))
    for i, name in enumerate(joints):
        joint = model.joint(name).id
        driving = np.flatnonzero(
            (model.actuator_trnid[:, 0] == joint) & (model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT)
        )
        kind = model.actuator_gaintype[driving[0]] if len(driving) == 1 else None
        if kind == mujoco.mjtGain.mjGAIN_DCMOTOR:
            kp[i], kd[i] = model.actuator_gainprm[driving[0], [4, 6]]
        elif kind == mujoco.mjtGain.mjGAIN_PID:
            kp[i], kd[i] = -model.actuator_biasprm[driving[0], [1, 2]]
        else:
            raise LevadeError(f"motion: joint {name} has no single pid or dcmotor actuator; give its gains, kp and kd")
    return kp, kd


def holding_torque(motion: Motion, model: mujoco.MjModel) -> Array:
    """(joints,) [Nm], what the joints deliver at the start, within their limits, if nothing accelerates there.

    By inverse dynamics. The little that a standing robot still moves counts: friction between feet and ground hangs on it.
    """
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.qacc[:] = motion["qpos0"], motion["qvel0"], 0.0
    mujoco.mj_inverse(model, data)
    limit = motion.embodiment.limits.torque
    return np.clip(data.qfrc_inverse[motion.addresses(model).joint_qvel], -limit, limit)
