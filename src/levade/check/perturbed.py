"""How often a motion succeeds on robots that differ from the model, and which difference breaks it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.check.statistics import rank_correlation, wilson
from levade.check.subject import Subject
from levade.costs import DIVERGED, errors, success
from levade.engines import Engine, Perturbation, Sample, perturbed_models
from levade.engines.perturbation import PARAMETERS, joined, labels
from levade.feedback import Feedback, SensorErrors
from levade.trajectory import JointReference

_AT_ONCE = 64
"""Runs simulated together: what they record has to fit into memory."""
_SENSING = 7933
"""Keeps the sensors' errors apart from what is drawn with the same seed."""
_CORNERS = 8
"""Runs with one parameter alone at the ends of its range."""


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
    the one that misses by the most times its tolerance: its number, errors, and the parameters' values. sensitivity: in
    order, strongest first.
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
            "sensitivity": [one.to_json() for one in self.sensitivity],
        }


def perturbed(
    subject: Subject,
    perturbation: Perturbation,
    *,
    runs: int,
    seed: int,
    divide: int = 1,
    feedback: Feedback | None = None,
    stopping: Callable[[], bool] | None = None,
) -> Perturbed:
    """Simulate a motion on ``runs`` perturbed versions of its model, and once more with each parameter alone.

    divide: the motion's time step by so much. feedback: the stabiliser, whose sensors err (`levade.feedback.SensorErrors`).
    stopping: asked on the way; once it says so, what there is by then is the result, some runs at least.
    """
    model = subject.model_copy()
    model.opt.timestep /= divide
    engine, reference = subject.engine.with_model(model), subject.reference_at(divide)[0]
    sample = perturbation.draw(engine.model, subject.joints, n=runs, seed=seed)
    names = [
        name
        for name, values in sample.values.items()
        if values.shape[1] and getattr(perturbation, name) not in (None, (PARAMETERS[name].nominal,) * 2)
    ]
    corners = {name: perturbation.corners(engine.model, subject.joints, name, n=_CORNERS, seed=seed) for name in names}
    every = joined([sample, *corners.values()])
    whole = judge(subject, engine, reference, every, feedback=feedback, seed=seed, stopping=stopping)
    drawn, alone, first = whole.part(0, runs), {}, runs
    runs = len(drawn.success)
    sample = Sample({name: values[:runs] for name, values in sample.values.items()})
    for name, corner in corners.items():
        alone[name] = whole.part(first, first + len(corner)).success
        first += len(corner)
    successes = int(drawn.success.sum())
    low, high = wilson(successes, runs)
    worst = int(np.lexsort((-drawn.miss, drawn.success))[0])
    sound = ~drawn.diverged
    return Perturbed(
        runs=runs,
        successes=successes,
        low=low,
        high=high,
        seed=seed,
        timestep=reference.timestep,
        diverged=int(drawn.diverged.sum()),
        errors={
            name: {
                "lowest": float(values[sound].min(initial=np.inf)) if sound.any() else DIVERGED,
                "mean": float(values[sound].mean()) if sound.any() else DIVERGED,
                "highest": float(values[sound].max(initial=-np.inf)) if sound.any() else DIVERGED,
                "missed": int((~subject.criteria[name].met(values)).sum()),
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
        sensitivity=_sensitivities(subject, perturbation, sample, drawn, alone, names),
    )


@dataclass(frozen=True, eq=False)
class Judged:
    """n runs. miss: (n,) the largest error, in tolerances; of a criterion with a bound, as a share of that."""

    errors: Mapping[str, Array]
    success: NDArray[np.bool_]
    diverged: NDArray[np.bool_]
    miss: Array

    def part(self, first: int, last: int) -> Judged:
        at = slice(first, last)
        off = {name: values[at] for name, values in self.errors.items()}
        return Judged(off, self.success[at], self.diverged[at], self.miss[at])


def judge(
    subject: Subject,
    engine: Engine,
    reference: JointReference,
    sample: Sample,
    *,
    feedback: Feedback | None = None,
    seed: int = 0,
    stopping: Callable[[], bool] | None = None,
) -> Judged:
    """Simulate a motion on all models of a sample. seed: of the sensors' errors, which only feedback notices.

    stopping: as in `perturbed`.
    """
    criteria, parts = subject.criteria, []
    for first in range(0, len(sample), _AT_ONCE):
        if parts and stopping is not None and stopping():
            break
        part = Sample({name: values[first : first + _AT_ONCE] for name, values in sample.values.items()})
        wrong = None
        if feedback is not None:
            ticks = -(-reference.steps // feedback.steps(reference.timestep))
            wrong = SensorErrors().draw(_AT_ONCE, ticks, subject.joints, seed=(seed, first, _SENSING))[: len(part)]
        starts, models = perturbed_models(engine.model, engine.layout, part, subject.start)
        trajectories = engine.rollout(starts, reference, models=models, feedback=feedback, sensor_errors=wrong)
        parts.append((errors(criteria, trajectories), success(criteria, trajectories), trajectories.diverged))
    off = {name: np.concatenate([part[0][name] for part in parts]) for name in criteria}
    met, diverged = (np.concatenate([part[i] for part in parts]) for i in (1, 2))
    miss = np.zeros(len(met))
    for name, criterion in criteria.items():
        bound = next((abs(end) for end in (criterion.minimum, criterion.maximum) if end), 1.0)
        np.maximum(miss, np.abs(off[name]) / (criterion.tolerance or bound), out=miss)
    miss[diverged] = DIVERGED
    return Judged(off, met, diverged, miss)


def _sensitivities(
    subject: Subject,
    perturbation: Perturbation,
    sample: Sample,
    drawn: Judged,
    alone: Mapping[str, NDArray[np.bool_]],
    names: list[str],
) -> tuple[Sensitivity, ...]:
    missed = {name: 1 + int((~subject.criteria[name].met(off)).sum()) for name, off in drawn.errors.items()}
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
                number=labels(subject.model, subject.embodiment.joint_names, name)[which],
                failed=float(failed.mean()) if failed.size else None,
                succeeded=float(succeeded.mean()) if succeeded.size else None,
                alone=(int(alone[name].sum()), len(alone[name])),
            )
        )
    # what breaks the motion alone comes first where nothing else tells two apart
    return tuple(sorted(found, key=lambda one: (-one.explains, one.alone[0] / max(one.alone[1], 1), one.parameter)))
