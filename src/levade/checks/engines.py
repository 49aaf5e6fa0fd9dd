"""Check whether a motion succeeds in another engine, and how far it differs there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from levade.checks.numerics import apart
from levade.costs.orientation import geodesic
from levade.engines import ENGINES
from levade.errors import LevadeError
from levade.motions import RecordedSimulation, replay_in
from levade.trajectory import Trajectories

_ROWS = 20
"""Number of times at which the difference is given."""


@dataclass(frozen=True)
class Replayed:
    """Result of a motion in another engine.

    Attributes:
        success: Whether the motion succeeds there; None if the engine is not available, as for all other results.
        errors: Criterion -> error [SI].
        apart: Distances from the recorded motion, as in `levade.checks.numerics.Numeric`.
        over_time: "time" [s], and the distances of the trunk's centre of mass, "position" [m], and of its "attitude" [rad].
        reason: Why the engine is not available.
    """

    success: bool | None = None
    errors: dict[str, float] | None = None
    apart: dict[str, float] | None = None
    over_time: dict[str, list[float]] | None = None
    reason: str = ""

    def to_json(self) -> dict[str, Any]:
        """Write the result as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        return dict(vars(self))


def other_engines(simulation: RecordedSimulation) -> dict[str, Replayed]:
    """Simulate a motion in every engine except its own.

    Args:
        simulation: The motion.

    Returns:
        Name of an engine -> result.
    """
    return {name: _replay(simulation, name) for name in ENGINES if name != simulation.motion.provenance.engine}


def _replay(simulation: RecordedSimulation, engine: str) -> Replayed:
    try:
        replay = replay_in(engine, simulation.motion, criteria=simulation.criteria)
    except LevadeError as error:
        return Replayed(reason=str(error))
    return Replayed(
        success=replay.success,
        errors=dict(replay.errors),
        apart=apart(simulation, replay.trajectories),
        over_time=_over_time(simulation, replay.trajectories),
    )


def _over_time(simulation: RecordedSimulation, trajectories: Trajectories) -> dict[str, list[float]]:
    steps = trajectories.steps
    rows = sorted(
        {round((i + 1) * steps / _ROWS) - 1 for i in range(_ROWS)} - {-1} | {simulation.motion.horizon_steps - 1}
    )
    moved = trajectories.trunk_com_position()[0, rows] - simulation.motion["trunk_com_position"][rows]
    turned = geodesic(trajectories.trunk_quaternion[0, rows], simulation.motion["trunk_quaternion"][rows])
    return {
        "time": trajectories.time[rows].tolist(),
        "position": ((moved**2).sum(axis=-1) ** 0.5).tolist(),
        "attitude": turned.tolist(),
    }
