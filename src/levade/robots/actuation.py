"""Actuators: what turns desired joint motion into torque, inside the physics engine.

Both kinds follow a desired position and velocity, and both take two controls per joint, so that the control vector of a
robot with J joints is ``(2 J,)``: position and velocity of joint 0, position and velocity of joint 1, and so on.

They command the torque ``kp (q_des - q) + kd (qd_des - qd)`` [Nm]. `PID` delivers it at once, up to a constant limit.
`DCMotor` delivers it late, by a first-order lag, never more than ``torque``, and while driving no more than
``stall_torque (1 - qd / no_load_speed)``. For an electric drive that is the physics; for a valve-driven cylinder, whose
torque falls as ``1 - (qd / no_load_speed)^2``, it is a straight line fitted to the parabola.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array

# MjsActuator.ctrlspec, a bit per input: "pos" is 1, "vel" is 2
_POSITION_AND_VELOCITY = 3


@dataclass(frozen=True, eq=False)
class PID:
    """Torque at once, up to a constant limit; MuJoCo's ``pid`` actuator.

    kp: (joints,) [Nm/rad]. kd: (joints,) [Nm s/rad]. torque: (joints,) [Nm], infinite for none.
    """

    name: str
    kp: Array
    kd: Array
    torque: Array

    def attach(self, spec: mujoco.MjSpec, joint_names: Sequence[str], *, gain_scale: float = 1.0) -> None:
        """Add one actuator per joint to ``spec``, in the order given and named after its joint."""
        for i, joint in enumerate(joint_names):
            actuator = _add(spec, joint)
            actuator.set_to_pid(
                kp=float(self.kp[i] * gain_scale),
                kv=float(self.kd[i] * gain_scale),
                ctrlspec=_POSITION_AND_VELOCITY,
            )
            if np.isfinite(self.torque[i]):
                actuator.forcerange = [-self.torque[i], self.torque[i]]
                actuator.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE


@dataclass(frozen=True, eq=False)
class DCMotor:
    """Torque after a lag, within a line that falls with speed; MuJoCo's ``dcmotor`` actuator.

    kp: (joints,) [Nm/rad]. kd: (joints,) [Nm s/rad]. torque: (joints,) [Nm], the most it ever delivers.
    stall_torque: (joints,) [Nm] and no_load_speed: (joints,) [rad/s], the ends of the line.
    time_constant: [s], first-order lag from commanded to delivered torque; 0 for none.
    supply_pressure: [Pa], of a hydraulic drive; None for others. The engine does not see it.
    """

    name: str
    kp: Array
    kd: Array
    torque: Array
    stall_torque: Array
    no_load_speed: Array
    time_constant: float
    supply_pressure: float | None = None

    def attach(self, spec: mujoco.MjSpec, joint_names: Sequence[str], *, gain_scale: float = 1.0) -> None:
        """Add one actuator per joint to ``spec``, in the order given and named after its joint."""
        for i, joint in enumerate(joint_names):
            # The unit of voltage is free: with V = no_load_speed the motor constant is 1 and the current is the torque.
            voltage = speed = float(self.no_load_speed[i])
            torque = float(self.torque[i])
            _add(spec, joint).set_to_dcmotor(
                motorconst=[0.0, 0.0],
                resistance=0.0,
                nominal=[voltage, float(self.stall_torque[i]), speed],
                saturation=[torque if np.isfinite(torque) else 0.0, 0.0, 0.0],
                inductance=[0.0, self.time_constant],
                # Without its last number, the voltage limit, the driver makes up for any back-EMF: no line, no bound on
                # the current that the lag then has to unwind.
                controller=[float(self.kp[i] * gain_scale), 0.0, float(self.kd[i] * gain_scale), 0.0, 0.0, voltage],
                ctrlspec=_POSITION_AND_VELOCITY,
            )


Actuation = PID | DCMotor


def _add(spec: mujoco.MjSpec, joint: str):
    actuator = spec.add_actuator()
    actuator.name = joint
    actuator.trntype = mujoco.mjtTrn.mjTRN_JOINT
    actuator.target = joint
    return actuator
