"""Search for a stabiliser: try regulators with a few weights, and keep the one that succeeds on most perturbed runs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from levade.engines import ENGINES, MujocoEngine, Perturbation, engine_kind, perturbed_models
from levade.engines.perturbation import Sample
from levade.errors import LevadeError
from levade.motions import Motion, RecordedSimulation, Trials, run_trials
from levade.regulators import Design, linearised

_TRAINING, _JUDGING = 7919, 7927
"""Numbers that keep these runs apart from others of the same seed.

The runs that choose differ from those of a check with the same seed. The runs that judge the choice differ from both, because
the best of several useless designs looks better than none on the runs that chose it.
"""


@dataclass(frozen=True, eq=False)
class Stabilised:
    """Reports the search for a stabiliser.

    Attributes:
        motion: The motion with the stabiliser; the original motion if no stabiliser is significantly better.
        open_loop: Share of successes without the stabiliser, in runs that did not choose it. If none was chosen, in the runs
            that choose. NaN if the search was interrupted before.
        share: Share of successes with the stabiliser, in the same runs.
        tried: Design -> share of successes.
        interrupted: Whether designs were left untried.
    """

    motion: Motion
    design: Design | None
    open_loop: float
    share: float
    runs: int
    tried: dict[Design, float]
    interrupted: bool = False


def stabilise(
    motion: Motion,
    *,
    rate: float = 250.0,
    bound: float = 0.5,
    runs: int = 96,
    seed: int = 0,
    perturbation: Perturbation | None = None,
    threads: int = 0,
    tell: Callable[[str], None] | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> Stabilised:
    """Find a stabiliser for a motion.

    Args:
        motion: A motion, recorded in MuJoCo.
        rate: Measurements per second [Hz]; the nearest rate that the time step allows is used.
        bound: Largest correction of a joint's reference [rad].
        runs: Number of perturbed runs that choose between designs, drawn from ``perturbation`` with ``seed``, apart from those
            of a check. The same number of other runs judges the choice.
        seed: Seed of these runs.
        perturbation: Ranges in which robots differ. Defaults to `levade.engines.Perturbation`.
        threads: Number of engine threads (0: one per core).
        tell: Called with one line about each design that was tried.
        stopping: Called before each design. If it returns True, the best design so far is the result.

    Returns:
        The motion with its stabiliser, and how often it succeeds with and without.

    Raises:
        LevadeError: If another engine than MuJoCo made the motion, it broke down or has no criteria, or a number is not valid.
    """
    simulation = RecordedSimulation(motion, criteria=motion.task.on_others, threads=threads)
    _check(simulation, rate, bound, runs)
    assert isinstance(simulation.engine, MujocoEngine)  # the one that a recorded motion is simulated in
    drawing = perturbation or Perturbation()
    sample, fresh = (
        drawing.draw(simulation.model, simulation.joints, n=runs, seed=(seed, tag)) for tag in (_TRAINING, _JUDGING)
    )
    perturbed = perturbed_models(simulation.model, simulation.layout, sample, simulation.start)
    along = linearised(
        simulation.engine,
        simulation.start,
        simulation.reference,
        perturbed=perturbed,
        rate=rate,
        errors=simulation.task.sensors,
        threads=threads,
    )

    def runs_of(design: Design | None, sample: Sample, tag: int, what: str = "") -> Trials:
        given = None if design is None else along.feedback(design)
        found = run_trials(simulation, sample, feedback=given, seed=seed + tag)
        if tell is not None:
            tell(f"{what}{'no feedback' if design is None else _text(design)}: {found.success.mean():.1%}")
        return found

    scores: dict[Design | None, tuple[float, float]] = {}
    best, interrupted = Design(bound=min(Design.bound, bound)), False
    hold = simulation.reference.steps > simulation.reference.horizon_steps
    for change in (None, {}, *_designs(bound, hold=hold)):
        design = None if change is None else replace(best, **change)
        if design in scores:
            continue
        if interrupted := stopping():
            break
        scores[design] = _score(runs_of(design, sample, _TRAINING))
        if design is None and scores[None][0] == 1.0:  # nothing to gain
            break
        if design is not None and scores[design] > scores.get(best, (0.0, -math.inf)):
            best = design
    open_loop = scores[None][0] if None in scores else math.nan
    share, better = open_loop, False
    if best in scores and scores[best][0] > open_loop:
        without, within = (runs_of(design, fresh, _JUDGING, "other runs, ").success for design in (None, best))
        better, open_loop = _surely_more(without, within), float(without.mean())
        share = float(within.mean()) if better else open_loop
    return Stabilised(
        motion=motion.stabilised(along.feedback(best), runs=runs, seed=seed, design=vars(best)) if better else motion,
        design=best if better else None,
        open_loop=open_loop,
        share=share,
        runs=runs,
        tried={design: share for design, (share, _) in scores.items() if design is not None},
        interrupted=interrupted,
    )


def _check(simulation: RecordedSimulation, rate: float, bound: float, runs: int) -> None:
    motion = simulation.motion
    if not engine_kind(motion.provenance.engine).feedback:
        able = " or ".join(kind.title for kind in ENGINES.values() if kind.feedback)
        raise LevadeError(
            f"stabilise: the motion was made in {motion.provenance.engine}, which simulates no feedback;"
            f" solve the task in {able}"
        )
    if motion.result.diverged:
        raise LevadeError(
            "stabilise: the motion's simulation broke down, there is nothing to hold; solve the task again"
        )
    if not simulation.criteria:
        raise LevadeError(f"stabilise: the task {simulation.task.name} has no success criteria to choose by")
    if not (math.isfinite(rate) and 1.0 <= rate <= 1.0001 / simulation.timestep):
        raise LevadeError(
            f"{rate:g} should be 1 to {1 / simulation.timestep:g} Hz, one measurement a step", field="rate"
        )
    slowest = 1.0 / (motion.horizon_steps * simulation.timestep)
    if rate < slowest:
        raise LevadeError(
            f"{rate:g} Hz has no measurement within the motion's {1 / slowest:g} s; should be {slowest:.3g} Hz at least,"
            " 250 is usual",
            field="rate",
        )
    if not (math.isfinite(bound) and 0.0 < bound <= 2.0):
        raise LevadeError(f"{bound:g} should be more than 0 and at most 2 rad; 0.5 is usual", field="bound")
    if not 8 <= runs <= 100_000:
        raise LevadeError(f"{runs} should be 8 to 100000; 96 is usual", field="runs")


def _designs(bound: float, *, hold: bool) -> Iterator[dict[str, float | None]]:
    """Yield changes of the best design so far, one after another."""
    for motion in (0.15, 0.6, 1.2):
        yield {"motion": motion}
    if bound > Design.bound:
        yield {"bound": bound}
        for motion in (0.3, 0.6):
            yield {"motion": motion}
    if hold:
        for value in (0.03, 0.2, None):
            yield {"hold": value}


def _surely_more(before: NDArray[np.bool_], after: NDArray[np.bool_]) -> bool:
    """Tell whether significantly more runs gain success than lose it: two standard deviations (McNemar's test)."""
    gained, lost = int((after & ~before).sum()), int((before & ~after).sum())
    return gained > lost and (gained - lost) ** 2 >= 4 * (gained + lost)


def _text(design: Design) -> str:
    hold = "none" if design.hold is None else f"{design.hold:g}"
    return f"corrections of {design.motion:g} rad, {hold} in the hold, {design.bound:g} at most"


def _score(found: Trials) -> tuple[float, float]:
    """Return the share of successes, and how near the other runs are, which decides between equal shares."""
    return float(found.success.mean()), -float(np.minimum(found.miss, 10.0).mean())
