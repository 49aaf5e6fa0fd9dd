"""Check how often a motion succeeds on robots that differ from the model, and which difference breaks it."""

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
"""Number of the poorest runs that a certificate lists."""

_CORNERS = 8
"""Number of runs with one parameter alone at the ends of its range."""

Hopeless = Callable[[int, int], bool]
"""Function of the successes and runs so far: whether more runs are pointless."""


@dataclass(frozen=True)
class Sensitivity:
    """Effect of one parameter.

    Attributes:
        parameter: Name of the parameter.
        unit: Its unit.
        explains: Share of the differences between the runs that the parameter explains, 0 to 1. It sums squared rank
            correlations of the criteria's errors with the parameter's numbers and with their distance from the middle, less
            what chance alone would give. Criteria that are missed more often count more.
        number: Name of its most important number; "" if it has only one.
        failed: Mean of that number over the runs that failed; None if there are none.
        succeeded: Mean of that number over the runs that succeeded; None if there are none.
        alone: Successes and runs with this parameter alone perturbed, at the ends of its range.
    """

    parameter: str
    unit: str
    explains: float
    number: str
    failed: float | None
    succeeded: float | None
    alone: tuple[int, int]

    def to_json(self) -> dict[str, Any]:
        """Write the effect as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        return {
            **{
                name: getattr(self, name) for name in ("parameter", "unit", "explains", "number", "failed", "succeeded")
            },
            "alone": {"successes": self.alone[0], "runs": self.alone[1]},
        }


@dataclass(frozen=True)
class Perturbed:
    """Result of the perturbed runs.

    Attributes:
        runs: Number of runs.
        successes: Number of runs that succeeded.
        low: Lower end of Wilson's interval of the share, at 95 %.
        high: Upper end of this interval.
        seed: Seed of all random numbers.
        timestep: Time step [s].
        diverged: Number of runs whose simulation broke down.
        errors: Criterion -> lowest, mean and highest error [SI], and the number of runs that missed it.
        worst: Number, errors and parameters of the worst run: among the failed ones, if any, the one with the largest miss
            as a multiple of the tolerance.
        poorest: Numbers of the poorest runs, the worst first.
        sensitivity: Effect of each parameter, strongest first.
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
        """Share of the runs that succeeded."""
        return self.successes / self.runs

    def to_json(self) -> dict[str, Any]:
        """Write the result as plain tables.

        Returns:
            Tables that JSON can hold.
        """
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
    """Simulate a motion on perturbed versions of its model, and then with each parameter perturbed alone.

    Args:
        simulation: The motion, and the criteria.
        perturbation: Ranges of the perturbed parameters.
        runs: Largest number of perturbed versions.
        seed: Seed of all random numbers.
        divide: Divisor of the motion's time step.
        feedback: The stabiliser, whose sensors have errors (`levade.feedback.SensorErrors`).
        hopeless: Once it returns true, no more runs are made, and no parameter is tried alone: see `Hopeless`. None makes all
            runs.
        stopping: Called during the runs; once it returns true, the result has the runs made so far, at least some.

    Returns:
        The result.
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
    # of two parameters that explain the same, the one that breaks the motion alone more often comes first
    return tuple(sorted(found, key=lambda one: (-one.explains, one.alone[0] / max(one.alone[1], 1), one.parameter)))
