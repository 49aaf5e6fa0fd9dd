"""Inertias of plates and rods lie at the limit of what a body can have, so rounding to six digits can make them invalid.

The principal moments A <= B <= C of a body satisfy A + B >= C, with equality for a plate; A = 0 for a rod. Files round them,
and so does the text that is simulated. A small added moment about every axis, far below a file's precision, compensates that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError

if TYPE_CHECKING:
    from levade.robots.reading import Draft

_ROOM = 3e-5
"""Share of C by which A + B should exceed C: more than rounding to six digits can remove."""
_LEAST = 1e-14
"""Smallest moment [kg m2]; MuJoCo treats less as zero."""
ROUNDED = 0.01
"""Share of C by which A + B may be below C, and A below zero, in a file with two or three digits."""


def lifted(tensor: Array) -> Array | None:
    """Make an inertia that is at the limit safely valid.

    Args:
        tensor: Inertia about the centre of mass [kg m2], shape (3, 3).

    Returns:
        The tensor with the same moment added about every axis. Unchanged if it is valid anyway. None if it violates the
        limit by more than rounding explains.
    """
    least, middle, most = np.linalg.eigvalsh(tensor)
    if not np.isfinite(most) or most <= 0 or least < -ROUNDED * most or middle <= ROUNDED * most:
        return None
    gap = most * (1 + _ROOM) - least - middle
    if gap > (ROUNDED + _ROOM) * most:
        return None
    needed = max(gap / (1 - _ROOM), _ROOM * most - least)
    return tensor if needed <= 0 else tensor + needed * np.eye(3)


def lift_explicit(spec: mujoco.MjSpec) -> None:
    """Correct the inertias of an MJCF that are invalid only because of rounding.

    Args:
        spec: The model; it is changed.
    """
    for body in spec.bodies[1:]:
        if not body.explicitinertial:
            continue
        tensor = _given(body)
        if not np.isfinite(tensor).all():
            continue
        least, middle, most = np.linalg.eigvalsh(tensor)
        slight = 1e-6 * most if body.compiler.balanceinertia else np.inf
        if (least > _LEAST and least + middle >= most) or most - least - middle > slight:
            continue
        better = lifted(tensor)
        if better is not None and not np.isnan(body.fullinertia).any():
            body.fullinertia = better[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        elif better is not None:
            body.inertia = np.diag(better)


def survive_text(draft: Draft) -> tuple[str, mujoco.MjModel]:
    """Compile the draft's text, which is what is simulated, with inertias that stay valid when rounded to six digits.

    Args:
        draft: The model; its inertias may be changed.

    Returns:
        The text, and the model that it describes.

    Raises:
        LevadeError: If MuJoCo does not accept the text.
    """
    model = draft.compile()
    text = draft.spec.to_xml()
    try:
        return text, mujoco.MjModel.from_xml_string(text, draft.assets)
    except ValueError:
        pass
    for body in draft.spec.bodies[1:]:
        index = model.body(body.name).id
        moments = model.body_inertia[index]
        better = lifted(np.diag(moments))
        if better is None or model.body_mass[index] <= 0 or np.array_equal(better, np.diag(moments)):
            continue
        body.explicitinertial, body.mass = True, float(model.body_mass[index])
        body.ipos, body.iquat = model.body_ipos[index].copy(), model.body_iquat[index].copy()
        body.inertia, body.fullinertia = np.diag(better).copy(), np.full(6, np.nan)
    draft.compile()
    text = draft.spec.to_xml()
    try:
        return text, mujoco.MjModel.from_xml_string(text, draft.assets)
    except ValueError as error:
        raise LevadeError(f"{draft.path}: {' '.join(str(error).split())}") from None


def _given(body: mujoco.MjsBody) -> Array:
    """Return the inertia in the frame of the file [kg m2], shape (3, 3)."""
    xx, yy, zz, xy, xz, yz = body.fullinertia
    full = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return np.diag(np.array(body.inertia, dtype=float)) if np.isnan(full).any() else full
