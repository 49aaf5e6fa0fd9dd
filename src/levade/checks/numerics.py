"""Check whether a motion depends on how the physics is computed: the same model, with other numerics."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from levade.costs import errors, success
from levade.costs.orientation import geodesic
from levade.engines.models import other_cone, soften
from levade.motions import RecordedSimulation
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Variant:
    """Another computation of the same physics.

    Attributes:
        parts: Divisor of the time step.
        integrator: Whether to use the other integrator.
        cone: Whether to use the other friction cone.
        softness: Factor on the time in which a contact pushes bodies apart (solref), and on its shortfall from the full force
            (1 - solimp).
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
    # at half the step, because MuJoCo does not resolve a contact that is stiffer than two steps
    "stiffer contact": Variant(parts=2, softness=0.5),
}
"""Name -> difference in the computation."""

QUICK = ("half time step", "other contact cone")
"""The two most telling variants, for a short check after a search."""

_OTHER_INTEGRATOR = {
    mujoco.mjtIntegrator.mjINT_IMPLICITFAST: mujoco.mjtIntegrator.mjINT_EULER,
}


@dataclass(frozen=True)
class Numeric:
    """Result of a motion with a variant.

    Attributes:
        success: Whether the motion succeeds.
        diverged: Whether its simulation broke down.
        timestep: Time step [s].
        errors: Criterion -> error [SI].
        reference: Source of the references between recorded rows: "policy" or "interpolation".
        apart: Distances of the trunk's centre of mass [m] and of its attitude [rad] from the recorded ones, at the horizon
            and at most.
    """

    success: bool
    diverged: bool
    timestep: float
    errors: dict[str, float]
    reference: str
    apart: dict[str, float]

    def to_json(self) -> dict[str, Any]:
        """Write the result as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        return dict(vars(self))


def numerics(simulation: RecordedSimulation, names: Iterable[str] = tuple(VARIANTS)) -> dict[str, Numeric]:
    """Simulate a motion with other numerics.

    Args:
        simulation: The motion.
        names: Names in `VARIANTS` to try. Defaults to all.

    Returns:
        Name of a variant -> result.
    """
    return {name: _try(simulation, VARIANTS[name]) for name in names}


def simulate_at(simulation: RecordedSimulation, variant: Variant) -> tuple[Trajectories, str]:
    """Simulate a motion with one variant.

    Args:
        simulation: The motion.
        variant: The variant.

    Returns:
        The trajectories, and the source of the references: "policy" or "interpolation".
    """
    other = simulation.with_model(varied(simulation.model_copy(), variant))
    source = other.curve.source if variant.parts > 1 else "policy"
    return other.rollout(feedback=simulation.motion.feedback), source


def varied(model: mujoco.MjModel, variant: Variant) -> mujoco.MjModel:
    """Change a model in place to compute as a variant says.

    Args:
        model: The model; written to.
        variant: The variant.

    Returns:
        The same model.
    """
    model.opt.timestep /= variant.parts
    if variant.integrator:
        model.opt.integrator = _OTHER_INTEGRATOR.get(
            mujoco.mjtIntegrator(model.opt.integrator), mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        )
    if variant.cone:
        model.opt.cone = other_cone(model)
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
    """Measure how far the trunk is from its recorded position and attitude.

    Args:
        simulation: The recorded motion.
        trajectories: Another simulation of it, of one trial.
        parts: Divisor of the time step in that simulation.

    Returns:
        Distance of the trunk's centre of mass [m] and of its attitude [rad], at the horizon and at most.
    """
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
