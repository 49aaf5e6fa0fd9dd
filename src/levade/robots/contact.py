"""Contact stiffness of a robot's parts: MuJoCo's ``solref`` and ``solimp``.

In MuJoCo a spring and damper pushes a penetrating part out of the ground. Its parameters are times, not stiffnesses. A foot of
effective mass m (`mujoco.MjModel.body_invweight0` is 1 / m) that carries a weight f rests at a depth z of

    z = (1 - d) / d^2 * (dmax * timeconst * dampratio)^2 * f / m,      d = solimp at z

With the default of 20 ms, light feet sink in by a millimetre or two in standing, and by their radius in landing.
"""

from __future__ import annotations

import mujoco

STIFF_SOLREF = (0.005, 1.0)
"""Time constant [s] and damping ratio. MuJoCo accepts no less than two time steps: 4 ms at 2 ms a step."""
STIFF_SOLIMP = (0.9, 0.95, 0.001)
"""Smallest and largest impedance, and the depth over which it grows from one to the other [m]."""


def stiffen(spec: mujoco.MjSpec) -> None:
    """Set `STIFF_SOLREF` and `STIFF_SOLIMP` for every shape and pair of shapes that collides.

    Args:
        spec: The model; it is changed.
    """
    colliding = [geom for geom in spec.geoms if geom.contype or geom.conaffinity]
    for part in (*colliding, *spec.pairs):
        part.solref = [*STIFF_SOLREF]
        part.solimp = [*STIFF_SOLIMP, 0.5, 2.0]


def as_mjcf() -> str:
    """Write the settings as attributes for geoms of an MJCF."""
    solref, solimp = (" ".join(f"{value:g}" for value in values) for values in (STIFF_SOLREF, STIFF_SOLIMP))
    return f'solref="{solref}" solimp="{solimp}"'
