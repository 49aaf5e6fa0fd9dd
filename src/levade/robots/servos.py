"""Read what the actuators of an MJCF say about its joints: limits, gains of position servos, windings of DC motors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.robots.winding import HOTTEST, Thermal, Winding


@dataclass(frozen=True)
class Servo:
    """Describes what drives a joint.

    Attributes:
        torque: Torque limit [Nm]; infinite for no limit.
        kp: Stiffness [Nm/rad]. None for a motor.
        kd: Damping [Nm s/rad]. None for a motor.
        driven: Whether there is an actuator, not only a limit on the joint.
        winding: Winding of a DC motor whose thermal data the file gives, arrays of shape (1,). None for other drives.
    """

    torque: float
    kp: float | None = None
    kd: float | None = None
    driven: bool = True
    winding: Winding | None = None


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
        torque = min(positive, default=math.inf)
        servos[name] = Servo(torque, kp, kd, winding=_winding(model, i, torque))
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


def windings(found: Mapping[str, Winding], joints: Sequence[str]) -> Winding | None:
    """Join the windings of single joints.

    Args:
        found: Joint -> winding, arrays of shape (1,).
        joints: All joints, in order.

    Returns:
        The windings of all joints. None if a joint has none.
    """
    if not joints or not set(joints) <= set(found):
        return None
    each = [found[joint] for joint in joints]
    motorconst, current = (np.concatenate([getattr(one, name) for one in each]) for name in ("motorconst", "current"))
    resistance = np.concatenate([one.resistance for one in each if one.resistance is not None])
    thermal = [one.thermal for one in each if one.thermal is not None]
    arrays = ("resistance", "capacitance", "tempcoef", "reftemp", "ambient", "limit")
    joined = Thermal(*(np.concatenate([getattr(one, name) for one in thermal]) for name in arrays), assumed=True)
    return Winding(motorconst, current, resistance, joined)


def _winding(model: mujoco.MjModel, actuator: int, torque: float) -> Winding | None:
    """Read the winding of a DC motor. None without thermal data: voltage and resistance may then be in arbitrary units."""
    gain, dynamics = model.actuator_gainprm[actuator], model.actuator_dynprm[actuator]
    if model.actuator_gaintype[actuator] != mujoco.mjtGain.mjGAIN_DCMOTOR:
        return None
    resistance, motorconst, tempcoef, reftemp = (np.array([float(value)]) for value in gain[:4])
    thermal_resistance, capacitance, ambient = (np.array([float(value)]) for value in dynamics[2:5])
    motorconst *= abs(float(model.actuator_gear[actuator, 0]))
    if not (thermal_resistance > 0 and capacitance > 0 and resistance > 0 and motorconst > 0):
        return None
    limit = np.maximum(HOTTEST, ambient + 1.0)
    thermal = Thermal(thermal_resistance, capacitance, tempcoef, reftemp, ambient, limit, assumed=True)
    return Winding(motorconst, torque / motorconst, resistance, thermal)
