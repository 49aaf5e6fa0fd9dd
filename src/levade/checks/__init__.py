"""Checks that tell whether a motion can be trusted.

    certificate = check(Motion.load("motion.npz"), runs=500, seed=0)
    certificate.passed
    certificate.perturbed.share, certificate.perturbed.low      # of 500 perturbed runs, and its 95 % interval
    certificate.open_loop                                       # the same without the stabiliser, if the motion has one
    certificate.margins["torque"].failed                        # joints that go beyond their limits

docs/check.md describes each part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from levade.checks.certificate import Certificate, Goal
from levade.checks.engines import Replayed, other_engines
from levade.checks.margins import margins
from levade.checks.numerics import Numeric, numerics
from levade.checks.perturbed import Hopeless, Perturbed, Sensitivity, perturbed
from levade.checks.slack import Margin
from levade.checks.verdicts import Verdict
from levade.costs import Criterion
from levade.engines import Perturbation
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.motions import Motion, RecordedSimulation, versions
from levade.tasks import Demands, Task

__all__ = [
    "Certificate",
    "Demands",
    "Goal",
    "Margin",
    "Numeric",
    "Perturbed",
    "Replayed",
    "Sensitivity",
    "Verdict",
    "check",
    "margins",
    "numerics",
    "other_engines",
    "perturbed",
]


def check(
    motion: Motion,
    *,
    runs: int = 500,
    seed: int = 0,
    divide: int = 1,
    perturbation: Perturbation | None = None,
    demands: Demands | None = None,
    criteria: Task | None = None,
    asked: Mapping[str, Criterion] | None = None,
    threads: int = 0,
    hopeless: Hopeless | None = None,
    stopping: Callable[[], bool] | None = None,
) -> Certificate:
    """Check a motion on perturbed models, with other numerics, in other engines and against its hardware's limits.

    Args:
        motion: The motion.
        runs: Largest number of perturbed runs.
        seed: Seed of all random numbers.
        divide: Divisor of the time step in the perturbed runs.
        perturbation: Ranges of the perturbed parameters. Defaults to `levade.engines.Perturbation`.
        demands: Thresholds of the certificate. Defaults to `levade.tasks.Demands`.
        criteria: A task whose success criteria replace those of the motion's task, which are its criteria for perturbed
            models (`levade.tasks.Task.on_others`).
        asked: What the task asked for, if the motion's task has other tolerances. The certificate only repeats it.
        threads: Number of engine threads (0: one per core). Results do not depend on it.
        hopeless: Called with the successes and perturbed runs so far; once it returns true, no more runs are made.
        stopping: Called during the runs; once it returns true, the check ends, and the certificate is marked as interrupted.

    Returns:
        The certificate.

    Raises:
        LevadeError: If there are no success criteria, or ``runs`` or ``divide`` is out of range.
    """
    judged = motion.task.on_others if criteria is None else criteria.success
    simulation = RecordedSimulation(motion, criteria=judged, threads=threads)
    if not simulation.criteria:
        raise LevadeError(
            f"the task {simulation.task.name} has no success criteria; give a task that has some",
            field="criteria",
        )
    if not 1 <= runs <= 1_000_000:
        raise LevadeError(f"{runs} should be 1 to 1000000; 500 is usual", field="runs")
    if not 1 <= divide <= 64:
        raise LevadeError(f"{divide} should be 1 to 64; 2 is usual", field="divide")
    demands, feedback = demands or Demands(), motion.feedback
    ranges = perturbation or Perturbation()
    stop = stopping or (lambda: False)

    def tried(by: Feedback | None, runs: int, hopeless: Hopeless | None = None) -> Perturbed:
        return perturbed(
            simulation,
            ranges,
            runs=runs,
            seed=seed,
            divide=divide,
            feedback=by,
            hopeless=hopeless,
            stopping=stop,
        )

    found = tried(feedback, runs, hopeless)
    without = found if feedback is None else tried(None, found.runs)
    cut = stop()
    return Certificate(
        task=simulation.task.name,
        robot=motion.robot,
        criteria=simulation.task.name if criteria is None else criteria.name,
        goal=tuple(_goal(motion.task.success if criteria is None else criteria.success, judged, asked or {})),
        checksum=motion.checksum,
        versions=versions(simulation.engine.name),
        demands=demands,
        ranges=ranges,
        perturbed=found,
        open_loop=None if feedback is None else without,
        numerics={} if cut else numerics(simulation),
        engines={} if cut else other_engines(simulation),
        margins={} if cut else margins(simulation, demands),
        interrupted=cut,
    )


def _goal(
    model: Mapping[str, Criterion], perturbed: Mapping[str, Criterion], asked: Mapping[str, Criterion]
) -> Iterator[Goal]:
    for name, criterion in model.items():
        there = perturbed[name].wording if name in perturbed else ""
        yield Goal(name, asked.get(name, criterion).wording, criterion.wording, there)
