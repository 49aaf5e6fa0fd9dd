"""Windings of electric drives: current from torque, heat from current, temperature from heat.

    winding = robot.actuation.winding               # None if the description has no data
    winding.currents(torque)                        # [A], shape (..., joints)
    winding.temperatures(torque, 0.002)             # [degC] after each step, from the ambient temperature

The model is that of MuJoCo's ``dcmotor``. The current is torque / motorconst, and heats the winding with I^2 R. The resistance
grows with temperature, ``R(T) = R (1 + tempcoef (T - reftemp))``. The winding loses heat to its surroundings, so that
``C dT/dt = I^2 R(T) - (T - ambient) / R_th``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from levade.arrays import Array

HOTTEST = 100.0
"""Limit that is assumed where none is given [degC]. Insulation of class A, the lowest of motors, bears 105 (IEC 60085)."""

AMBIENT = 25.0
"""Temperature of the surroundings where none is given [degC]."""


@dataclass(frozen=True, eq=False)
class Thermal:
    """Describes how windings warm up.

    Attributes:
        resistance: Thermal resistance from the winding to its surroundings [K/W], shape (joints,).
        capacitance: Heat capacity of the winding [J/K], shape (joints,).
        tempcoef: Relative growth of the electrical resistance with temperature [1/K], shape (joints,).
        reftemp: Temperature at which the electrical resistance is given [degC], shape (joints,).
        ambient: Temperature of the surroundings [degC], shape (joints,).
        limit: Highest temperature of the winding [degC], shape (joints,).
        assumed: Whether ``limit`` is assumed.
    """

    resistance: Array
    capacitance: Array
    tempcoef: Array
    reftemp: Array
    ambient: Array
    limit: Array
    assumed: bool = False


@dataclass(frozen=True, eq=False)
class Winding:
    """Describes the windings of electric drives, as seen from the joints.

    Attributes:
        motorconst: Torque of a joint over the current of its motor, with the gear [Nm/A], shape (joints,).
        current: Largest current [A], shape (joints,); infinite for no limit.
        resistance: Electrical resistance [ohm], shape (joints,). None if it is not known.
        thermal: How windings warm up. None if it is not known, or the resistance is not.
    """

    motorconst: Array
    current: Array
    resistance: Array | None = None
    thermal: Thermal | None = None

    def currents(self, torque: Array) -> Array:
        """Compute the magnitude of the currents.

        Args:
            torque: Joint torques [Nm], shape (..., joints).

        Returns:
            Currents [A], shape (..., joints).
        """
        return np.abs(torque) / self.motorconst

    def heat(self, torque: Array) -> Array:
        """Compute the heat in the windings, at the temperature for which the resistance is given.

        Args:
            torque: Joint torques [Nm], shape (..., joints).

        Returns:
            Heat I^2 R [W], shape (..., joints).
        """
        assert self.resistance is not None
        return np.square(self.currents(torque)) * self.resistance

    def temperatures(self, torque: Array, timestep: float) -> Array:
        """Compute the temperatures of windings that begin at the ambient temperature.

        The torque is constant during each step, so each step has a closed form.

        Args:
            torque: Joint torques during each step [Nm], shape (steps, joints).
            timestep: Duration of a step [s].

        Returns:
            Temperatures at the end of each step [degC], shape (steps, joints).
        """
        heat, thermal = self.heat(torque), self.thermal
        assert thermal is not None
        cold = 1 + thermal.tempcoef * (thermal.ambient - thermal.reftemp)
        # C d(rise)/dt = source - loss * rise. A loss below zero is a runaway: the resistance grows faster than heat leaves
        source = heat * cold
        loss = 1 / thermal.resistance - heat * thermal.tempcoef
        decay = -loss * timestep / thermal.capacitance
        flat = np.abs(decay) < 1e-12
        gain = np.where(flat, 1.0, np.expm1(decay) / np.where(flat, 1.0, decay)) * timestep / thermal.capacitance
        rise, now = np.empty_like(heat), np.zeros(heat.shape[1])
        for row, (factor, added) in enumerate(zip(np.exp(decay), gain * source, strict=True)):
            now = rise[row] = now * factor + added
        return thermal.ambient + rise

    def repeated(self, torque: Array) -> Array:
        """Compute the temperatures that windings come to if the motion is repeated without pause.

        Args:
            torque: Joint torques during each step [Nm], shape (steps, joints).

        Returns:
            Temperatures [degC], shape (joints,); infinite for a runaway.
        """
        thermal, mean = self.thermal, self.heat(torque).mean(axis=0)
        assert thermal is not None
        cold = 1 + thermal.tempcoef * (thermal.ambient - thermal.reftemp)
        loss = 1 / thermal.resistance - mean * thermal.tempcoef
        return thermal.ambient + np.where(loss > 0, mean * cold / np.where(loss > 0, loss, 1.0), np.inf)
