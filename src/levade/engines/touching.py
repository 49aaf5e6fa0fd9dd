"""Which geoms of a model may touch, and with how much friction, by MuJoCo's rules.

Explicit pairs (`mujoco.MjModel.pair_geom1`) come in addition, and are ignored here.
"""

from __future__ import annotations

import mujoco


def may_touch(model: mujoco.MjModel, one: int, other: int) -> bool:
    """Tell whether MuJoCo looks for contact between two geoms.

    Their masks decide. Geoms of one body, or of a body and its parent, do not touch.

    Args:
        model: Robot and scene.
        one: Index of a geom.
        other: Index of another geom.

    Returns:
        Whether the two may touch.
    """
    affine = (model.geom_contype[one] & model.geom_conaffinity[other]) or (
        model.geom_contype[other] & model.geom_conaffinity[one]
    )
    bodies = sorted((int(model.geom_bodyid[one]), int(model.geom_bodyid[other])))
    weld = [int(model.body_weldid[body]) for body in bodies]
    if not affine or weld[0] == weld[1] or (bodies[0] << 16) + bodies[1] in model.exclude_signature.tolist():
        return False
    if model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT) or 0 in weld:
        return True
    over = [int(model.body_weldid[model.body_parentid[w]]) for w in weld]
    return weld[0] != over[1] and weld[1] != over[0]


def friction_between(model: mujoco.MjModel, one: int, other: int) -> float:
    """Return the coefficient of sliding friction: that of the geom with higher priority, otherwise the larger one.

    Args:
        model: Robot and scene.
        one: Index of a geom.
        other: Index of another geom.

    Returns:
        The coefficient. It is 0 if the contact has no friction.
    """
    priority = model.geom_priority[one] - model.geom_priority[other]
    deciding = [one] if priority > 0 else [other] if priority < 0 else [one, other]
    if max(model.geom_condim[geom] for geom in deciding) == 1:
        return 0.0
    return float(max(model.geom_friction[geom, 0] for geom in deciding))
