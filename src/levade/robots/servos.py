"""Read what the actuators of an MJCF say about its joints: torque limits, and the gains of position servos."""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco


@dataclass(frozen=True)
class Servo:
    """Describes what drives a joint.

    Attributes:
        torque: Torque limit [Nm]; infinite for no limit.
        kp: Stiffness [Nm/rad]. None for a motor.
        kd: Damping [Nm s/rad]. None for a motor.
        driven: Whether there is an actuator, not only a limit on the joint.
    """

    torque: float
    kp: float | None = None
    kd: float | None = None
    driven: bool = True


def read_servos(model: mujoco.MjModel) -> dict[str, Servo]:
    """Read the servos of all hinges that an actuator drives.

    MuJoCo's affine position servo, force = gain * ctrl - kp * length - kd * velocity with gain = kp, keeps its gains. Of other
    actuators only the limit is used.

    Args:
        model: The model, with its actuators.

    Returns:
        Joint -> servo.
    """
    servos: dict[str, Servo] = {}
    for i in range(model.nactuator):  # an actuator may take several controls: nu is the number of these
        kind = int(model.actuator_trntype[i])
        if kind not in (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)):
            continue
        joint = int(model.actuator_trnid[i, 0])
        if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_HINGE:
            continue
        name = model.joint(joint).name
        control = int(model.actuator_ctrladr[i])
        gear = abs(float(model.actuator_gear[i, 0]))
        limits = []
        if model.actuator_forcelimited[i]:
            limits.append(gear * float(abs(model.actuator_forcerange[i]).min()))
        if model.jnt_actfrclimited[joint]:
            limits.append(float(abs(model.jnt_actfrcrange[joint]).min()))
        gain, bias = model.actuator_gainprm[i], model.actuator_biasprm[i]
        fixed = model.actuator_gaintype[i] == mujoco.mjtGain.mjGAIN_FIXED
        affine = model.actuator_biastype[i] == mujoco.mjtBias.mjBIAS_AFFINE
        kp = kd = None
        if fixed and affine and gain[0] > 0 and math.isclose(gain[0], -bias[1], rel_tol=1e-9):
            kp, kd = float(gain[0]) * gear**2, float(-bias[2]) * gear**2 + 0.0  # no negative zero
        elif fixed and not affine and model.actuator_ctrllimited[control]:  # a motor: its command is its force
            limits.append(gear * float(gain[0]) * float(abs(model.actuator_ctrlrange[control]).min()))
        positive = [limit for limit in limits if limit > 0]
        servos[name] = Servo(min(positive, default=math.inf), kp, kd)
    for joint in range(model.njnt):
        name = model.joint(joint).name
        if (
            model.jnt_actfrclimited[joint]
            and name not in servos
            and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
        ):
            limit = float(abs(model.jnt_actfrcrange[joint]).min())
            if limit > 0:
                servos[name] = Servo(limit, driven=False)
    return servos
