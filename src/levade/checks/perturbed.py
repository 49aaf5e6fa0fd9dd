"""How often a motion succeeds on robots that differ from the model, and which difference breaks it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.checks.statistics import rank_correlation, wilson
from levade.costs import DIVERGED
from levade.engines import Perturbation, Sample
from levade.engines.perturbation import PARAMETERS, joined, labels
from levade.feedback import Feedback
from levade.motions import RecordedSimulation, Trials, run_trials

_POOREST = 3
"""Runs that can be looked at afterwards."""

_CORNERS = 8
"""Runs with one parameter alone at the ends of its range."""

Hopeless = Callable[[int, int], bool]
"""Asked on the way with successes and runs so far: whether there is no point in more runs."""


@dataclass(frozen=True)
class Sensitivity:
    """What one parameter does.

    explains: share of the differences between the runs that goes along with it, 0 to 1: squared rank correlations of the
    criteria's errors (those missed more often counting more) with the parameter's numbers and with their distance from the
    middle, less what chance alone would give.
    number: which of its numbers matters most; "" if it has but one. failed, succeeded: mean of that number over the runs that
    failed and over those that succeeded; None where there are none.
    alone: (successes, runs) with this parameter alone perturbed, at the ends of its range.
    """

    parameter: str
    unit: str
    explains: float
    number: str
    failed: float | None
    succeeded: float | None
    alone: tuple[int, int]

    def to_json(self) -> dict[str, Any]:
        return {
            **{
                name: getattr(self, name) for name in ("parameter", "unit", "explains", "number", "failed", "succeeded")
            },
            "alone": {"successes": self.alone[0], "runs": self.alone[1]},
        }


@dataclass(frozen=True)
class Perturbed:
    """What came of the perturbed runs.

    low, high: of the share, Wilson's interval at 95 %. errors: criterion -> lowest, mean and highest error [SI], and in how
    many runs it was missed. timestep: [s]. diverged: runs whose simulation broke down. worst: of the runs that fail, if any,
    the one that misses by the most times its tolerance: its number, errors, and the parameters' values. poorest: numbers of
    the few that come next to it, and its own before them. sensitivity: in order, strongest first.
    """

    runs: int
    successes: int
    low: float
    high: float
    seed: int
    timestep: float
    diverged: int
    errors: Mapping[str, Mapping[str, float]]
    worst: Mapping[str, Any]
    poorest: tuple[int, ...]
    sensitivity: tuple[Sensitivity, ...]

    @property
    def share(self) -> float:
        return self.successes / self.runs

    def to_json(self) -> dict[str, Any]:
        return {
            **{
                name: getattr(self, name)
                for name in ("runs", "successes", "share", "low", "high", "seed", "timestep", "diverged")
            },
            "errors": {name: dict(values) for name, values in self.errors.items()},
            "worst": dict(self.worst),
            "poorest": list(self.poorest),
            "sensitivity": [one.to_json() for one in self.sensitivity],
        }


def perturbed(
    simulation: RecordedSimulation,
    perturbation: Perturbation,
    *,
    runs: int,
    seed: int,
    divide: int = 1,
    feedback: Feedback | None = None,
    hopeless: Hopeless | None = None,
    stopping: Callable[[], bool] | None = None,
) -> Perturbed:
    """Simulate a motion on ``runs`` perturbed versions of its model, and once more with each parameter alone.

    Args:
        simulation: The motion, and the criteria.
        perturbation: Ranges of what differs.
        runs: Perturbed versions, at most.
        seed: Seed of all random numbers.
        divide: What to divide the motion's time step by.
        feedback: The stabiliser, whose sensors err (`levade.feedback.SensorErrors`).
        hopeless: See `Hopeless`; no parameter is then tried alone. None makes all runs.
        stopping: Asked on the way; once it says so, the result is of what there is by then, some runs at least.
    """
    simulation = simulation.divided(divide)
    model, joints = simulation.model, simulation.joints
    sample = perturbation.draw(model, joints, n=runs, seed=seed)
    names = [
        name
        for name, values in sample.values.items()
        if values.shape[1] and getattr(perturbation, name) not in (None, (PARAMETERS[name].nominal,) * 2)
    ]
    corners = {name: perturbation.corners(model, joints, name, n=_CORNERS, seed=seed) for name in names}

    def stopped(_: Trials | None = None) -> bool:
        return stopping is not None and stopping()

    def ending(made: Trials) -> bool:
        return stopped() or (hopeless is not None and hopeless(int(made.success.sum()), len(made)))

    drawn = run_trials(simulation, sample, feedback=feedback, seed=seed, ending=ending)
    runs = len(drawn)
    sample = sample[:runs]
    whole, alone, first = drawn.part(0, 0), {}, 0
    if corners and not ending(drawn):
        every = joined(list(corners.values()))
        whole = run_trials(simulation, every, feedback=feedback, seed=seed, ending=stopped)
    for name, corner in corners.items():
        alone[name] = whole.part(first, first + len(corner)).success
        first += len(corner)
    successes = int(drawn.success.sum())
    low, high = wilson(successes, runs)
    poorest = np.lexsort((-drawn.miss, drawn.success))[:_POOREST].tolist()
    worst = poorest[0]
    sound = ~drawn.diverged
    return Perturbed(
        runs=runs,
        successes=successes,
        low=low,
        high=high,
        seed=seed,
        timestep=simulation.reference.timestep,
        diverged=int(drawn.diverged.sum()),
        errors={
            name: {
                "lowest": float(values[sound].min(initial=np.inf)) if sound.any() else DIVERGED,
                "mean": float(values[sound].mean()) if sound.any() else DIVERGED,
                "highest": float(values[sound].max(initial=-np.inf)) if sound.any() else DIVERGED,
                "missed": int((~simulation.criteria[name].met(values)).sum()),
            }
            for name, values in drawn.errors.items()
        },
        worst={
            "run": worst,
            "success": bool(drawn.success[worst]),
            "diverged": bool(drawn.diverged[worst]),
            "errors": {name: float(values[worst]) for name, values in drawn.errors.items()},
            "values": {name: sample.values[name][worst].tolist() for name in names},
        },
        poorest=tuple(poorest),
        sensitivity=_sensitivities(simulation, perturbation, sample, drawn, alone, names),
    )


def _sensitivities(
    simulation: RecordedSimulation,
    perturbation: Perturbation,
    sample: Sample,
    drawn: Trials,
    alone: Mapping[str, NDArray[np.bool_]],
    names: list[str],
) -> tuple[Sensitivity, ...]:
    missed = {name: 1 + int((~simulation.criteria[name].met(off)).sum()) for name, off in drawn.errors.items()}
    weights = {name: count / sum(missed.values()) for name, count in missed.items()}
    found = []
    for name in names:
        values = sample.values[name]
        middle = sum(getattr(perturbation, name)) / 2
        squared = np.zeros(values.shape[1])
        for criterion, off in drawn.errors.items():
            both = rank_correlation(values, off) ** 2 + rank_correlation(abs(values - middle), off) ** 2
            squared += weights[criterion] * both
        by_chance = 2 * values.shape[1] / max(len(values) - 1, 1)
        which = int(np.argmax(squared))
        failed = values[~drawn.success, which]
        succeeded = values[drawn.success, which]
        found.append(
            Sensitivity(
                parameter=name,
                unit=PARAMETERS[name].unit,
                explains=float(np.clip(squared.sum() - by_chance, 0.0, 1.0)),
                number=labels(simulation.model, simulation.embodiment.joint_names, name)[which],
                failed=float(failed.mean()) if failed.size else None,
                succeeded=float(succeeded.mean()) if succeeded.size else None,
                alone=(int(alone[name].sum()), len(alone[name])),
            )
        )
    # what breaks the motion alone comes first where nothing else tells two apart
    return tuple(sorted(found, key=lambda one: (-one.explains, one.alone[0] / max(one.alone[1], 1), one.parameter)))
