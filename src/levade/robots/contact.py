"""How hard a robot's parts are where they touch something: MuJoCo's ``solref`` and ``solimp``.

A spring and damper pushes what has sunk in out of the ground again. MuJoCo gives them by time, not by stiffness. A foot of
effective mass m (`mujoco.MjModel.body_invweight0` is 1 / m) with a weight f on it rests at a depth z of

    z = (1 - d) / d^2 * (dmax * timeconst * dampratio)^2 * f / m,      d = solimp at z

The default of 20 ms lets light feet sink in by a millimetre or two in standing, and by their radius in landing.
"""

from __future__ import annotations

import mujoco

STIFF_SOLREF = (0.005, 1.0)
"""Time constant [s], and damping ratio. MuJoCo takes no less than two time steps: 4 ms at 2 ms a step."""
STIFF_SOLIMP = (0.9, 0.95, 0.001)
"""Least and largest impedance, and the depth [m] over which it grows from one to the other."""


def stiffen(spec: mujoco.MjSpec) -> None:
    """Make every shape and pair of shapes that collides as hard as `STIFF_SOLREF` and `STIFF_SOLIMP` say."""
    colliding = [geom for geom in spec.geoms if geom.contype or geom.conaffinity]
    for part in (*colliding, *spec.pairs):
        part.solref = [*STIFF_SOLREF]
        part.solimp = [*STIFF_SOLIMP, 0.5, 2.0]


def as_mjcf() -> str:
    """The settings as attributes of an MJCF's geoms."""
    solref, solimp = (" ".join(f"{value:g}" for value in values) for values in (STIFF_SOLREF, STIFF_SOLIMP))
    return f'solref="{solref}" solimp="{solimp}"'
