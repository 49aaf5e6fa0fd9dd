"""Judge candidates: on the nominal model, and on perturbed models where the task asks for it.

    judge = Judge(task, seed=0)
    evaluation = yield from judge.evaluate(candidates, level, generation=3, racing=weights)

The methods are generators: they yield the `Trials` that they need, and the caller sends the `Evaluation` of each. The caller
therefore decides how to simulate: one search at a time, or hundreds in one batch. A judge keeps no state.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from levade.arrays import Array
from levade.search.evaluation import Evaluation, Gains, Index, Samples, Trials
from levade.search.outcome import Trial
from levade.search.schedule import Level, level_of
from levade.tasks import Robust, Task

Judging = Generator[Trials, Evaluation, Evaluation]

_AT_ONCE = 20
"""Models in one batch when a candidate is verified through the hold. Batches end once the answer is known."""

_CONTENDED = 8
"""The same when a contender is compared with the best trial so far."""

FIXED = 0
"""Number of the draw of perturbed models that stay the same."""


@dataclass(frozen=True)
class Judge:
    """Judges candidates for one search.

    Attributes:
        task: The task.
        seed: Seed of the search, which determines the perturbed models.
        closing: Whether this judges at the end of the search: see `Trials`.
        gains: Gains of the task's feedback. None judges without feedback.
    """

    task: Task
    seed: int
    closing: bool = False
    gains: Gains | None = None

    def evaluate(
        self,
        candidates: Array,
        level: Level,
        *,
        generation: int = FIXED,
        racing: Mapping[str, float] | None = None,
        best: Trial | None = None,
    ) -> Judging:
        """Judge candidates as a stage does.

        Args:
            candidates: Policy weights [rad], shape (n, d).
            level: How to simulate.
            generation: Generation whose perturbed models to use. `FIXED` uses the models that stay the same.
            racing: Cost weights that decide which candidates drop out after the first few models. None runs all candidates on
                all models.
            best: The best trial so far, on the models that stay the same. A candidate that can no longer rank above it is
                tried on no further models. None tries it on all.

        Returns:
            Their evaluation, n rows.
        """
        robust = self.task.robust
        if robust is None:
            return (yield from self.nominal(candidates, level.hold_steps, verify=True))
        if not level.robust:  # a candidate that was not tried on perturbed models has not succeeded
            evaluation = yield from self.nominal(candidates, level.hold_steps, verify=False)
            return evaluation.with_success(np.zeros(len(candidates), dtype=bool))
        # only candidates on models that stay the same may count as successes
        contend = generation == FIXED or robust.redraw == "never"
        draw = FIXED if robust.redraw == "never" else generation
        nominal = yield from self.nominal(candidates, level.hold_steps, verify=contend)
        return (yield from self._on_models(robust, nominal, candidates, level.hold_steps, draw, racing, best))

    def nominal(self, candidates: Array, hold_steps: int, *, verify: bool) -> Judging:
        """Judge candidates on the nominal model.

        Args:
            candidates: Policy weights [rad], shape (n, d).
            hold_steps: Number of steps of the hold to simulate.
            verify: With less than the whole hold, whether to simulate trials that meet every criterion so far again through
                all of it. Only these can then succeed. Without, none succeeds.

        Returns:
            Their evaluation, n rows.
        """
        evaluation = yield self._trials(candidates, hold_steps)
        if hold_steps >= self.task.hold_steps:
            return evaluation
        success = np.zeros(len(candidates), dtype=bool)
        promising = np.flatnonzero(evaluation.success) if verify else np.empty(0, dtype=np.intp)
        if promising.size:
            whole = yield self._trials(candidates[promising], self.task.hold_steps)
            success[promising] = whole.success
        verified = len(promising) if self.task.robust is not None else 0
        return replace(evaluation.with_success(success), verified=verified)

    def most(self, population: int, level: Level) -> int:
        """Count the most roll-outs of a generation, with those for judging the best trial once more after it.

        Args:
            population: Candidates of a generation.
            level: How to simulate them.
        """
        robust = self.task.robust
        if robust is None:
            return population
        if self.task.feedback is not None and level.robust:  # judges the best again, with other gains
            others = replace(self, task=replace(self.task, feedback=None)).most(population, level)
            judged = (1 + robust.fixed) * (1 + (level.hold_steps < self.task.hold_steps))
            return others + judged * (len(self.task.feedback.designs) if self.gains is None else 1)
        validated = 1 + robust.fixed
        if not level.robust:
            partial = any(
                level_of(self.task, stage).hold_steps < self.task.hold_steps
                for stage in self.task.stages
                if stage.robust
            )
            return population + validated * ((robust.starts > 1) + 1 + partial)
        through = validated if level.hold_steps < self.task.hold_steps else 0  # a contender, through the whole hold
        if robust.redraw == "never":
            return robust.rollouts(population) + robust.kept(population) * through + through
        return robust.rollouts(population) + validated + through + through

    def _on_models(
        self,
        robust: Robust,
        nominal: Evaluation,
        candidates: Array,
        hold_steps: int,
        draw: int,
        racing: Mapping[str, float] | None,
        best: Trial | None,
    ) -> Judging:
        """Also try the candidates on perturbed models."""
        models = robust.samples if draw else robust.fixed
        columns, everyone = np.arange(models), np.arange(len(candidates))
        samples = Samples.none(nominal.terms, len(candidates), models)
        first = models if racing is None or robust.racing is None else robust.racing.first
        at_once = models if best is None else _CONTENDED
        for start in range(0, first, at_once):
            left = everyone if best is None else _contenders(robust, nominal, samples, best)
            part = columns[:first][start : start + at_once]
            samples = yield from self._run(samples, candidates, hold_steps, draw, left, part)
        result = replace(nominal, samples=samples)
        if racing is not None and first < models:
            order = np.argsort(result.cost(racing, robust), kind="stable")
            kept = np.sort(order[: robust.kept(len(candidates))])
            samples = yield from self._run(samples, candidates, hold_steps, draw, kept, columns[first:])
        success, verified = nominal.success & robust.enough(samples.share), nominal.verified
        for trial in np.flatnonzero(success).tolist() if hold_steps < self.task.hold_steps else ():
            success[trial], made = yield from self._verify(robust, candidates, draw, trial, columns, nominal.terms)
            verified += made
        met = None if robust.success is None else nominal.success.copy()
        return replace(nominal.with_success(success), samples=samples, verified=verified, met=met)

    def _verify(
        self, robust: Robust, candidates: Array, draw: int, trial: int, columns: Index, terms: Iterable[str]
    ) -> Generator[Trials, Evaluation, tuple[bool, int]]:
        """Return whether a candidate succeeds on enough models through the whole hold, and the roll-outs that this took."""
        whole, made = Samples.none(dict.fromkeys(terms), len(candidates), len(columns)), 0
        for first in range(0, len(columns), _AT_ONCE):
            part = columns[first : first + _AT_ONCE]
            whole = yield from self._run(whole, candidates, self.task.hold_steps, draw, np.array([trial]), part)
            made += len(part)
            if not robust.enough(whole.attainable)[trial]:
                return False, made
        return True, made

    def _run(
        self, samples: Samples, candidates: Array, hold_steps: int, draw: int, rows: Index, columns: Index
    ) -> Generator[Trials, Evaluation, Samples]:
        """Simulate some candidates on some models, every one on every one, and add the results to the samples."""
        if not (len(rows) and len(columns)):
            return samples
        rows_of, columns_of = (axis.ravel() for axis in np.meshgrid(np.arange(len(rows)), columns, indexing="ij"))
        asked = self._trials(candidates[rows], hold_steps)
        found = yield replace(asked, draw=draw, pairs=(rows_of, columns_of), gains=self.gains)
        return samples.updated((rows[rows_of], columns_of), found)

    def _trials(self, candidates: Array, hold_steps: int) -> Trials:
        return Trials(candidates, hold_steps, seed=self.seed, closing=self.closing)


def _contenders(robust: Robust, nominal: Evaluation, samples: Samples, best: Trial) -> Index:
    """Return the candidates that may still rank above the best trial, by `Trial.rank`."""
    failing = best.success or (best.met and robust.success is not None)
    out = (~nominal.success & failing) | (samples.attainable < (best.share or 0.0))
    return np.flatnonzero(~out)
