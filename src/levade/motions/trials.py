"""Try a recorded motion on perturbed models.

sample = Perturbation().draw(simulation.model, simulation.joints, n=500, seed=0)
trials = run_trials(simulation, sample, feedback=motion.feedback, seed=0)
trials.success.mean(), trials.errors["pitch"]
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import DIVERGED, errors, success
from levade.engines import Sample
from levade.feedback import Feedback
from levade.motions.simulation import RecordedSimulation
from levade.trajectory import Trajectories

_AT_ONCE = 64
"""Number of runs that are simulated together. Their records must fit into memory."""

_SENSING = 7933
"""Keeps the random numbers of the sensors' errors apart from others of the same seed."""


@dataclass(frozen=True, eq=False)
class Trials:
    """Holds the results of n trials.

    Attributes:
        errors: Criterion -> error [SI], shape (n,).
        success: Whether every criterion is met, shape (n,).
        diverged: Whether the simulation broke down, shape (n,).
        miss: The largest error in tolerances; for a criterion with a bound, as a share of the bound. Shape (n,).
    """

    errors: Mapping[str, Array]
    success: NDArray[np.bool_]
    diverged: NDArray[np.bool_]
    miss: Array

    def __len__(self) -> int:
        return len(self.success)

    def part(self, first: int, last: int) -> Trials:
        """Return the trials from ``first`` to before ``last``.

        Args:
            first: Index of the first trial.
            last: Index after the last trial.

        Returns:
            These trials.
        """
        at = slice(first, last)
        off = {name: values[at] for name, values in self.errors.items()}
        return Trials(off, self.success[at], self.diverged[at], self.miss[at])

    def joined(self, others: Trials) -> Trials:
        """Return these trials, followed by others.

        Args:
            others: Trials with the same criteria.

        Returns:
            All trials.
        """
        return Trials(
            {name: np.concatenate([values, others.errors[name]]) for name, values in self.errors.items()},
            np.concatenate([self.success, others.success]),
            np.concatenate([self.diverged, others.diverged]),
            np.concatenate([self.miss, others.miss]),
        )


def run_trials(
    simulation: RecordedSimulation,
    sample: Sample,
    *,
    feedback: Feedback | None = None,
    seed: int = 0,
    ending: Callable[[Trials], bool] | None = None,
) -> Trials:
    """Simulate a motion on all models of a sample.

    Args:
        simulation: The motion, and the criteria.
        sample: The perturbed models.
        feedback: The stabiliser, with sensor errors (`levade.feedback.SensorErrors`).
        seed: Seed of the sensor errors.
        ending: Called with the trials so far. If it returns True, these are the result.

    Returns:
        The results.
    """
    found: Trials | None = None
    for first in range(0, len(sample), _AT_ONCE):
        if found is not None and ending is not None and ending(found):
            break
        part = sample[first : first + _AT_ONCE]
        wrong = None
        if feedback is not None:
            wrong = _sensor_errors(simulation, first, feedback, seed)[: len(part)]
        made = _judged(simulation, simulation.rollout(part, feedback=feedback, sensor_errors=wrong))
        found = made if found is None else found.joined(made)
    assert found is not None
    return found


def _judged(simulation: RecordedSimulation, trajectories: Trajectories) -> Trials:
    criteria, diverged = simulation.criteria, trajectories.diverged
    off, miss = errors(criteria, trajectories), np.zeros(trajectories.n)
    for name, criterion in criteria.items():
        bound = next((abs(end) for end in (criterion.minimum, criterion.maximum) if end), 1.0)
        np.maximum(miss, np.abs(off[name]) / (criterion.tolerance or bound), out=miss)
    miss[diverged] = DIVERGED
    return Trials(off, success(criteria, trajectories), diverged, miss)


def run_again(
    simulation: RecordedSimulation,
    sample: Sample,
    runs: Sequence[int],
    *,
    feedback: Feedback | None = None,
    seed: int = 0,
    record: Sequence[str] = (),
) -> Trajectories:
    """Simulate some of the runs of `run_trials` again, to see their trajectories.

    Args:
        simulation: As in `run_trials`.
        sample: As in `run_trials`, with all the runs.
        runs: Numbers of the runs to simulate.
        feedback: As in `run_trials`.
        seed: As in `run_trials`.
        record: What to record besides the quantities of the criteria: see `levade.engines.Engine.rollout`.

    Returns:
        The trajectories.
    """
    wrong = None
    if feedback is not None:
        drawn = {first: _sensor_errors(simulation, first, feedback, seed) for first in {_first(run) for run in runs}}
        wrong = np.stack([drawn[_first(run)][run - _first(run)] for run in runs])
    return simulation.rollout(sample[list(runs)], feedback=feedback, sensor_errors=wrong, record=record)


def _first(run: int) -> int:
    """Return the first of the runs that are simulated together with a run."""
    return run - run % _AT_ONCE


def _sensor_errors(simulation: RecordedSimulation, first: int, feedback: Feedback, seed: int) -> Array:
    """Draw the sensor errors of the runs that are simulated together, from a run on."""
    reference = simulation.reference
    ticks = -(-reference.steps // feedback.steps(reference.timestep))
    return simulation.task.sensors.draw(_AT_ONCE, ticks, simulation.joints, seed=(seed, first, _SENSING))
