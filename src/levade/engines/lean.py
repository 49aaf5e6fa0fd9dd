"""A model without its visual shapes: what is only looked at costs a roll-out up to a fifth of its time.

    lean = Lean.of(engine.model, engine.xml, engine.assets)
    lean.model, lean.fields("geom_friction", values)        # values of the whole model's shapes -> of those that are left

A step of the lean model has the bits of a step of the whole one: its shapes that touch nothing have no mass of their own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array

_SAME = ("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_parentid", "sensor_adr", "actuator_trnid")
"""Fields that must not change when shapes go."""


_SWITCHES = (
    *("jnt_limited", "tendon_limited", "eq_active0", "body_sameframe"),
    *(f"actuator_{name}" for name in ("ctrllimited", "forcelimited", "actlimited", "gaintype", "biastype", "dyntype")),
)
"""Integers and flags that are no addresses, and so may be taken from another model."""


@dataclass(frozen=True, eq=False)
class Lean:
    """A model to step.

    Attributes:
        model: The model without visual shapes, or the whole one where these cannot go.
        kept: Indices of its shapes in the whole model, shape (ngeom,).
    """

    model: mujoco.MjModel
    kept: NDArray[np.intp]

    @classmethod
    def of(cls, model: mujoco.MjModel, xml: str, assets: Mapping[str, bytes]) -> Lean:
        """Make the lean model of one that was compiled from a text, and perhaps changed since: it has the changes, too.

        Args:
            model: The whole model.
            xml: MJCF text from which it was compiled.
            assets: File name in ``xml`` -> content.

        Returns:
            The model to step: the whole one where its visual shapes cannot go.
        """
        there = (model.geom_contype | model.geom_conaffinity) != 0
        if there.all():
            return cls(model, np.arange(model.ngeom))
        spec = mujoco.MjSpec.from_string(xml, assets=dict(assets))
        spec.compiler.discardvisual = True
        lean = spec.compile()
        kept = np.flatnonzero(there)
        # a shape that a sensor, a tendon or a pair names stays
        alike = lean.ngeom == len(kept) and np.array_equal(lean.geom_bodyid, model.geom_bodyid[kept])
        if not alike or not all(np.array_equal(getattr(lean, name), getattr(model, name)) for name in _SAME):
            return cls(model, np.arange(model.ngeom))
        _take_over(lean, model, kept)
        return cls(lean, kept)

    def fields(self, name: str, values: Array) -> Array:
        """Return what a field of n versions of the whole model is in the lean one.

        Args:
            name: Name of the field in `mujoco.MjModel`.
            values: Its values in each version of the whole model, shape (n, ...).

        Returns:
            Its values in each version of the lean model, shape (n, ...). Shapes that are not in it are left out.
        """
        return values[:, self.kept] if name.startswith("geom_") else values


def _take_over(lean: mujoco.MjModel, model: mujoco.MjModel, kept: NDArray[np.intp]) -> None:
    """Give a lean model the options and numbers of another: addresses, which are integers, stay its own."""
    for name in dir(model.opt):
        value = getattr(model.opt, name)
        if isinstance(value, np.ndarray):
            getattr(lean.opt, name)[...] = value
        elif isinstance(value, int | float):
            setattr(lean.opt, name, value)
    for name in dir(model):
        values = None if name.startswith("_") else getattr(model, name)
        if not isinstance(values, np.ndarray) or values.dtype.kind != "f":
            continue
        own = getattr(lean, name)
        values = values[kept] if name.startswith("geom_") else values
        if own.shape == values.shape:
            own[...] = values
    for name in ("geom_contype", "geom_conaffinity", "geom_condim", "geom_priority", "geom_sameframe"):
        getattr(lean, name)[...] = getattr(model, name)[kept]
    for name in _SWITCHES:
        getattr(lean, name)[...] = getattr(model, name)
    lean.stat.meaninertia = model.stat.meaninertia
