"""Actuators turn desired joint motion into torque inside the physics engine.

Both kinds follow a desired position and velocity, and both take two controls per joint, so that the control vector of a
robot with J joints is ``(2 J,)``: position and velocity of joint 0, position and velocity of joint 1, and so on.

They command the torque ``kp (q_des - q) + kd (qd_des - qd)`` [Nm]. `PID` delivers it at once, up to a constant limit.
`DCMotor` delivers it with a first-order lag, never more than ``torque``, and while driving no more than
``stall_torque (1 - qd / no_load_speed)``. For an electric drive this line is the physics. For a valve-driven cylinder, whose
torque falls as ``1 - (qd / no_load_speed)^2``, it is a straight line fitted to the parabola.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.arrays import Array
from levade.robots.winding import Winding

# MjsActuator.ctrlspec, a bit per input: "pos" is 1, "vel" is 2
_POSITION_AND_VELOCITY = 3


@dataclass(frozen=True, eq=False)
class PID:
    """Delivers torque at once, up to a constant limit, by MuJoCo's ``pid`` actuator.

    Attributes:
        name: Name of the actuation.
        kp: Stiffness [Nm/rad], shape (joints,).
        kd: Damping [Nm s/rad], shape (joints,).
        torque: Torque limits [Nm], shape (joints,); infinite for no limit.
    """

    name: str
    kp: Array
    kd: Array
    torque: Array

    def attach(self, spec: mujoco.MjSpec, joint_names: Sequence[str], *, gain_scale: float = 1.0) -> None:
        """Add one actuator per joint to ``spec``, in the order given and named after its joint.

        Args:
            spec: The robot. It is changed.
            joint_names: Names of the joints, in the order of the gains.
            gain_scale: Factor on stiffness and damping.
        """
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
    """Delivers torque after a lag, below a line that falls with speed, by MuJoCo's ``dcmotor`` actuator.

    Attributes:
        name: Name of the actuation.
        kp: Stiffness [Nm/rad], shape (joints,).
        kd: Damping [Nm s/rad], shape (joints,).
        torque: Largest torque at any speed [Nm], shape (joints,).
        stall_torque: Torque of the line at standstill [Nm], shape (joints,).
        no_load_speed: Speed at which the line reaches zero torque [rad/s], shape (joints,).
        time_constant: First-order lag from commanded to delivered torque [s]; 0 for none.
        supply_pressure: Supply pressure of a hydraulic drive [Pa]. None for other drives. The engine does not use it.
        winding: Windings of electric drives. None if nothing is known of them. The engine does not use them.
    """

    name: str
    kp: Array
    kd: Array
    torque: Array
    stall_torque: Array
    no_load_speed: Array
    time_constant: float
    supply_pressure: float | None = None
    winding: Winding | None = None

    def attach(self, spec: mujoco.MjSpec, joint_names: Sequence[str], *, gain_scale: float = 1.0) -> None:
        """Add one actuator per joint to ``spec``, in the order given and named after its joint.

        Args:
            spec: The robot. It is changed.
            joint_names: Names of the joints, in the order of the gains.
            gain_scale: Factor on stiffness and damping.
        """
        for i, joint in enumerate(joint_names):
            # The unit of voltage is arbitrary: with V = no_load_speed the motor constant is 1 and the current is the torque.
            voltage = speed = float(self.no_load_speed[i])
            torque = float(self.torque[i])
            _add(spec, joint).set_to_dcmotor(
                motorconst=[0.0, 0.0],
                resistance=0.0,
                nominal=[voltage, float(self.stall_torque[i]), speed],
                saturation=[torque if np.isfinite(torque) else 0.0, 0.0, 0.0],
                inductance=[0.0, self.time_constant],
                # Without the last number, the voltage limit, the driver compensates any back-EMF. Then there is no line, and
                # no bound on the current that the lag has to unwind.
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
