"""Whether a motion depends on how the physics is computed: the same model, other numbers behind it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from levade.costs import errors, success
from levade.costs.orientation import geodesic
from levade.engines.models import soften
from levade.motions import RecordedSimulation
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Variant:
    """Another computation of the same physics.

    parts: by which the time step is divided. integrator, cone: the other one. softness: factor on the time that a contact
    takes to push bodies apart (solref), and on what it may be short of the full force (1 - solimp).
    """

    parts: int = 1
    integrator: bool = False
    cone: bool = False
    softness: float = 1.0


VARIANTS: dict[str, Variant] = {
    "as recorded": Variant(),
    "half time step": Variant(parts=2),
    "quarter time step": Variant(parts=4),
    "other integrator": Variant(integrator=True),
    "other contact cone": Variant(cone=True),
    "softer contact": Variant(softness=2.0),
    # at half the step: a contact stiffer than two steps is not resolved
    "stiffer contact": Variant(parts=2, softness=0.5),
}
"""Name -> what is computed differently."""

QUICK = ("half time step", "other contact cone")
"""The two that tell most, for a look right after a search."""

_OTHER_INTEGRATOR = {
    mujoco.mjtIntegrator.mjINT_IMPLICITFAST: mujoco.mjtIntegrator.mjINT_EULER,
}
_OTHER_CONE = {mujoco.mjtCone.mjCONE_ELLIPTIC: mujoco.mjtCone.mjCONE_PYRAMIDAL}


@dataclass(frozen=True)
class Numeric:
    """What came of a variant. errors: criterion -> error [SI]. timestep: [s]. reference: "policy" or "interpolation".

    apart: how far the trunk's centre of mass [m], and its attitude [rad], are from the recorded ones, at the horizon and at
    most.
    """

    success: bool
    diverged: bool
    timestep: float
    errors: dict[str, float]
    reference: str
    apart: dict[str, float]

    def to_json(self) -> dict[str, Any]:
        return dict(vars(self))


def numerics(simulation: RecordedSimulation, names: Iterable[str] = tuple(VARIANTS)) -> dict[str, Numeric]:
    """Each variant's name -> what came of it. names: those of `VARIANTS` to try."""
    return {name: _try(simulation, VARIANTS[name]) for name in names}


def simulate_at(simulation: RecordedSimulation, variant: Variant) -> tuple[Trajectories, str]:
    """The motion, computed another way; and where its references come from."""
    other = simulation.with_model(varied(simulation.model_copy(), variant))
    source = other.curve.source if variant.parts > 1 else "policy"
    return other.rollout(feedback=simulation.motion.feedback), source


def varied(model: mujoco.MjModel, variant: Variant) -> mujoco.MjModel:
    """The model, changed in place to compute as the variant says."""
    model.opt.timestep /= variant.parts
    if variant.integrator:
        model.opt.integrator = _OTHER_INTEGRATOR.get(
            mujoco.mjtIntegrator(model.opt.integrator), mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        )
    if variant.cone:
        model.opt.cone = _OTHER_CONE.get(mujoco.mjtCone(model.opt.cone), mujoco.mjtCone.mjCONE_ELLIPTIC)
    if variant.softness != 1.0:
        for prefix in ("geom", "pair"):
            soften(getattr(model, f"{prefix}_solref"), getattr(model, f"{prefix}_solimp"), variant.softness)
    return model


def _try(simulation: RecordedSimulation, variant: Variant) -> Numeric:
    trajectories, source = simulate_at(simulation, variant)
    off = errors(simulation.criteria, trajectories)
    return Numeric(
        success=bool(success(simulation.criteria, trajectories)[0]),
        diverged=bool(trajectories.diverged[0]),
        timestep=trajectories.timestep,
        errors={name: float(error[0]) for name, error in off.items()},
        reference=source,
        apart=apart(simulation, trajectories, variant.parts),
    )


def apart(simulation: RecordedSimulation, trajectories: Trajectories, parts: int = 1) -> dict[str, float]:
    """How far the trunk is from where the file has it, at rows of the file: position [m] and attitude [rad]."""
    motion, rows = simulation.motion, slice(parts - 1, None, parts)
    position = trajectories.trunk_com_position()[0, rows] - motion["trunk_com_position"]
    distance = np.linalg.norm(position, axis=-1)
    angle = geodesic(trajectories.trunk_quaternion[0, rows], motion["trunk_quaternion"])
    last = motion.horizon_steps - 1
    return {
        "position_at_horizon": float(distance[last]),
        "attitude_at_horizon": float(angle[last]),
        "position_largest": float(distance.max()),
        "attitude_largest": float(angle.max()),
    }
