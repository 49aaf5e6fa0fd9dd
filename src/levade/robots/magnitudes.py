"""Check for numbers that cannot be simulated: infinite ones, and ones beyond what MuJoCo accepts in a state."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from levade.errors import LevadeError

LARGEST: float = mujoco.mjMAXVAL
"""Largest number, in any unit: MuJoCo stops a simulation whose state exceeds it."""

_FIELDS = {
    "body": (
        *(("body_mass", "mass [kg]"), ("body_inertia", "inertia [kg m2]")),
        *(("body_ipos", "centre of mass [m]"), ("body_pos", "position [m]")),
    ),
    "joint": (("jnt_pos", "position [m]"), ("jnt_stiffness", "stiffness")),
    "dof": (("dof_damping", "damping"), ("dof_armature", "armature"), ("dof_frictionloss", "friction")),
    "geom": (("geom_size", "size [m]"), ("geom_pos", "position [m]")),
}


def check_magnitudes(path: Path, model: mujoco.MjModel) -> None:
    """Check that masses, lengths and joint properties are numbers that can be simulated.

    Args:
        path: Path of the file, for messages.
        model: The model.

    Raises:
        LevadeError: If a number cannot be simulated; the message names the element.
    """
    for kind, fields in _FIELDS.items():
        for field, what in fields:
            values = getattr(model, field)
            if not values.size:
                continue
            odd = ~(np.abs(values.reshape(len(values), -1)) <= LARGEST)
            if odd.any():
                index, column = (int(i) for i in np.argwhere(odd)[0])
                if kind == "dof":
                    name = f"joint {model.joint(int(model.dof_jntid[index])).name}"
                else:
                    name = f"{kind} {getattr(model, kind)(index).name}"
                value = values.reshape(len(values), -1)[index, column]
                raise LevadeError(
                    f"{path}: {name}: {what} {value:g} is not a number that can be simulated; it should be at most {LARGEST:g}"
                )
