"""The staged loop: ask the optimizer, evaluate the trials, tell it their costs; the only place where these meet.

    solution = solve(load_task("rearing"), seed=0)
    solution.success, solution.trials_to_success, solution.errors

Everything is deterministic: the same task, seed and versions give the same solution to the bit, for any number of threads.
Weights that a caller changes on the way (``steer``) are part of the solution, as `levade.tasks.Change`: a task with these
changes gives it again. A `Record` of each generation holds what its simulations said; given the records of an interrupted
solve, the loop runs through them again without simulating (the optimizer asks for the same candidates) and goes on to the
same end.
"""

from __future__ import annotations

import zlib
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import DIVERGED, evaluate, total
from levade.costs.risk import ranked_behind, risk
from levade.engines import Variations, make_engine
from levade.errors import LevadeError, did_you_mean, located
from levade.optimizers import Optimizer, SearchSpace, UsesErrors, settings
from levade.optimizers import make_optimizer as make_optimizer_of
from levade.optimizers.blas import single_threaded
from levade.policies import smoothness_factor
from levade.robots import load_robot
from levade.robust import Sampler, Samples
from levade.tasks import Change, Stage, Task, looks_at_hold
from levade.tasks.policy import goal_posture, make_policy
from levade.tasks.reach import check_reach
from levade.trajectory import Trajectories

ENDING = 0.25
"""Share of the horizon in which an optimizer may finish a motion, without a change to what comes before."""

BESIDE_BOUND = 0.015
"""[SI: m, rad, ...], as far inside a bound as the middle of a tolerance is inside the tolerance."""


_AROUND = 1
"""Keeps the numbers drawn around a motion to start from apart from those of the next attempt."""
_AT_ONCE = 20
"""Models together on which a candidate is simulated through the hold."""


@dataclass(frozen=True)
class Evaluation:
    """What n trials achieved.

    terms: cost -> (n,), unweighted. errors: criterion -> (n,), SI. Both are NaN where the hold was not simulated and the
    cost or criterion looks at it. success, diverged: (n,). samples: what they did on perturbed models, if they were tried on
    any; a success is then one on enough of these, too. verified: roll-outs that it took to tell, beyond these.
    room: criterion with bounds -> (n,), SI, what is left to the nearer one, negative beyond it; NaN as in ``errors``.
    """

    terms: Mapping[str, Array]
    errors: Mapping[str, Array]
    success: NDArray[np.bool_]
    diverged: NDArray[np.bool_]
    samples: Samples | None = None
    verified: int = 0
    room: Mapping[str, Array] = field(default_factory=dict)

    @property
    def trials(self) -> int:
        """Roll-outs that were made."""
        return len(self.success) + (0 if self.samples is None else int(self.samples.known.sum()) + self.verified)


class Objective:
    """From weights to costs: policy, engine and costs of one task, put together once and used for every generation.

    threads: of the engine; 0 for one per core. Raises LevadeError for whatever does not fit together.
    """

    def __init__(self, task: Task, *, threads: int = 0) -> None:
        self.task = task
        choice = asdict(task.robot)
        self.robot = load_robot(choice.pop("name"), **choice)
        self.engine = make_engine(self.robot, task.scene, task.physics, threads=threads)
        self.terms = {name: cost.term for name, cost in task.costs.items()}
        bodies = {name: getattr(term, "bodies", ()) for name, term in self.terms.items()}
        for name, body in ((term, body) for term in bodies for body in bodies[term]):
            if body not in self.engine.bodies:
                hint = did_you_mean(body, self.engine.bodies)
                raise LevadeError(f"costs.{name}.bodies: no body {body!r} in {self.robot.name}; {hint}")
        check_reach(task, self.robot, self.engine.model)
        self._bodies = tuple(sorted({body for named in bodies.values() for body in named}))
        self.state = self.engine.start(task.start.choice)
        self.policy = make_policy(task, self.robot, start=self.state.joint_reference)
        self.sampler = None if task.robust is None else Sampler(self.engine, self.state, task.robust)
        self.evaluate(self.initial_weights[None])  # terms that cannot be evaluated say so now
        make_optimizer(self, seed=0)  # and so do settings of its own that an optimizer does not take

    @cached_property
    def initial_weights(self) -> Array:
        """(d,) [rad], the first mean of the search."""
        choice = self.task.policy
        if choice.initial == "hold":
            return self.policy.hold(self.state.joint_reference)
        return self.policy.interpolate(self.state.joint_position, goal_posture(choice, self.robot))

    @cached_property
    def factor(self) -> Array:
        """(d, m), square root of the initial covariance of the search, up to its step."""
        search, policy = self.task.search, self.policy
        if search.smoothness > 0 or search.modes is not None:
            return smoothness_factor(policy.kernels, search.smoothness, policy.independent_joints, modes=search.modes)
        return np.eye(policy.size)

    @cached_property
    def ending(self) -> Array | None:
        """(q, d), one direction for each independent joint: a ramp over the last quarter of its weights, up to 1.

        None where the motion ends as it must, whatever the weights (`levade.policies.Ends`).
        """
        policy = self.policy
        if policy.ends is not None and policy.ends.settle > 0:
            return None
        ramp = np.clip(1.0 - (1.0 - np.linspace(0.0, 1.0, policy.kernels.kernels)) / ENDING, 0.0, 1.0)
        return np.kron(np.eye(policy.independent_joints), ramp)

    def rollout(self, weights: Array, *, hold_steps: int | None = None, feet: bool = False) -> Trajectories:
        """Simulate trials (n, d), through ``hold_steps`` of the hold; through all of it if None."""
        reference = self.policy.reference(weights, hold_steps=hold_steps)
        return self.engine.rollout(self.state, reference, feet=feet, bodies=self._bodies)

    def evaluate(
        self,
        weights: Array,
        *,
        hold_steps: int | None = None,
        models: Variations | None = None,
        race: Mapping[str, float] | None = None,
        through: bool = True,
    ) -> Evaluation:
        """Simulate and judge trials (n, d).

        hold_steps: how much of the hold to simulate; all of it if None. With less, those trials that meet every criterion
        so far are simulated again through all of it, to see whether they succeed. through: or not; then none does.
        models: perturbed models to try the candidates on as well, as the task's ``robust`` says. race: weights of the costs by
        which candidates are left behind after a few of the models; None runs all on all.
        """
        full = self.task.hold_steps
        hold_steps = full if hold_steps is None else hold_steps
        result = self._judge(self.rollout(weights, hold_steps=hold_steps), hold_steps)
        if hold_steps < full and not through:
            result.success[:] = False
        elif hold_steps < full:
            verified = np.flatnonzero(result.success)
            for trial in verified:
                result.success[trial] = self._judge(self.rollout(weights[trial : trial + 1]), full).success[0]
            result = replace(result, verified=len(verified) if models is not None else 0)
        return result if models is None else self._on_models(result, weights, hold_steps, models, race)

    def cost(self, evaluation: Evaluation, weights: Mapping[str, float]) -> Array:
        """(n,), the weighted sum of the terms, less those that look at the hold if none of it was simulated.

        Of candidates that were tried on perturbed models, the task's measure of all their roll-outs.
        """
        terms = {name: values for name, values in evaluation.terms.items() if not np.isnan(values).any()}
        cost = total(terms, {name: weights[name] for name in terms})
        cost = np.where(evaluation.diverged, DIVERGED, cost)
        samples, robust = evaluation.samples, self.task.robust
        if samples is None or robust is None:
            return cost
        on_models = total({name: samples.terms[name] for name in terms}, {name: weights[name] for name in terms})
        costs = np.column_stack([cost, np.where(samples.diverged, DIVERGED, on_models)])
        known = np.column_stack([np.ones(len(cost), dtype=bool), samples.known])
        measured = risk(costs, known, measure=robust.measure, tail=robust.tail)
        return ranked_behind(measured, samples.complete)

    def _on_models(
        self,
        nominal: Evaluation,
        weights: Array,
        hold_steps: int,
        models: Variations,
        race: Mapping[str, float] | None,
    ) -> Evaluation:
        """The same trials, tried on perturbed models as well."""
        robust, sampler, full = self.task.robust, self.sampler, self.task.hold_steps
        assert robust is not None
        assert sampler is not None

        def run(samples: Samples, trials: NDArray[np.intp], columns: NDArray[np.intp], steps: int) -> None:
            reference = self.policy.reference(weights, hold_steps=steps)
            reference = replace(reference, before=self.state.joint_reference)  # as a check has it, of the motion's file
            judge = partial(self._judge, hold_steps=steps)
            sampler.rollouts(samples, models, reference, (trials, columns), bodies=self._bodies, judge=judge)

        samples, columns = Samples.none(self.terms, len(weights), len(models)), np.arange(len(models))
        result, everyone = replace(nominal, samples=samples), np.arange(len(weights))
        first = len(models) if race is None or robust.racing is None else robust.racing.first
        run(samples, everyone, columns[:first], hold_steps)
        if race is not None and first < len(models):
            order = np.argsort(self.cost(result, race), kind="stable")
            run(samples, np.sort(order[: robust.kept(len(weights))]), columns[first:], hold_steps)
        success, verified = nominal.success & robust.enough(samples.share), nominal.verified
        for trial in np.flatnonzero(success) if hold_steps < full else ():
            whole = Samples.none(self.terms, len(weights), len(models))
            for first in range(0, len(models), _AT_ONCE):  # no more of them than it takes to tell
                part = columns[first : first + _AT_ONCE]
                run(whole, np.array([trial]), part, full)
                verified += len(part)
                success[trial] = robust.enough(whole.attainable)[trial]
                if not success[trial]:
                    break
        return replace(result, success=success, verified=verified)

    def _judge(self, trajectories: Trajectories, hold_steps: int) -> Evaluation:
        """hold_steps: how much of the hold was simulated. With none, nothing that looks at it is known; with a part, costs and
        criteria look at that, but for how fast the robot is at the end: it comes to rest on the way there.
        """
        terms, criteria, n = self.terms, self.task.success, trajectories.n
        if 0 == hold_steps < self.task.hold_steps:
            terms = {name: term for name, term in terms.items() if not looks_at_hold(term)}
            criteria = {name: criterion for name, criterion in criteria.items() if not looks_at_hold(criterion)}
        elif hold_steps < self.task.hold_steps:
            criteria = {name: one for name, one in criteria.items() if one.at != "end" or not one.is_speed}
        values, met = evaluate(terms, trajectories), ~trajectories.diverged
        unknown = np.full(n, np.nan)
        judged = {name: criterion.judge(trajectories) for name, criterion in criteria.items()}
        for name, (off, _) in judged.items():
            met &= criteria[name].met(off)
        off, room = ({name: judged.get(name, (unknown, unknown))[i] for name in self.task.success} for i in (0, 1))
        return Evaluation(
            {name: values.get(name, unknown) for name in self.terms},
            off,
            met,
            trajectories.diverged.copy(),
            room={name: room[name] for name, criterion in self.task.success.items() if criterion.target is None},
        )


@dataclass(frozen=True)
class Record:
    """What the simulations of one generation said: enough to run through it again without them.

    checksum: of the candidates that the optimizer asked for. The rest as in `Evaluation`.
    validated: of its contender alone, on the models that stay the same, where others are drawn for each generation, or the
    contender is one of several motions of the nominal model to start from.
    """

    generation: int
    checksum: int
    evaluation: Evaluation
    validated: Evaluation | None = None

    def to_json(self) -> dict[str, Any]:
        """Plain lists; floats survive JSON to the bit."""
        content = {"generation": self.generation, "checksum": self.checksum, **_to_json(self.evaluation)}
        return content if self.validated is None else {**content, "validated": _to_json(self.validated)}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> Record:
        """The record that `to_json` wrote."""
        validated = _from_json(content["validated"]) if "validated" in content else None
        return cls(content["generation"], content["checksum"], _from_json(content), validated)


def _to_json(evaluation: Evaluation) -> dict[str, Any]:
    numbers = {
        key: {name: [None if np.isnan(v) else v for v in values.tolist()] for name, values in table.items()}
        for key, table in (("terms", evaluation.terms), ("errors", evaluation.errors), ("room", evaluation.room))
    }
    content = {**numbers, "success": evaluation.success.tolist(), "diverged": evaluation.diverged.tolist()}
    if evaluation.samples is not None:
        content |= {"samples": evaluation.samples.to_json(), "verified": evaluation.verified}
    return content


def _from_json(content: Mapping[str, Any]) -> Evaluation:
    terms, off, room = (
        {name: np.array(values, dtype=float) for name, values in content[key].items()}
        for key in ("terms", "errors", "room")
    )
    success, diverged = (np.array(content[key], dtype=bool) for key in ("success", "diverged"))
    samples = Samples.from_json(content["samples"]) if "samples" in content else None
    return Evaluation(terms, off, success, diverged, samples, content.get("verified", 0), room)


@dataclass(frozen=True)
class Trial:
    """One trial and what it achieved: cost, by the task's own weights, as changed so far; terms, unweighted; errors, SI.

    share: of the perturbed models that it succeeds on; None where it was not tried on any.
    """

    weights: Array
    cost: float
    terms: Mapping[str, float]
    errors: Mapping[str, float]
    success: bool
    share: float | None = None


@dataclass(frozen=True)
class Generation:
    """The state of the search after a generation.

    cost: (candidates,). best: over all generations and stages.
    trials: spent so far.
    trials_to_success: trials spent when one first met every criterion. replayed: whether it came from a record.
    weights: of the best trial's cost. changes: of the weights, that hold or are still to come.
    starts: shares of the models that stay the same, on which motions of the nominal model to start from succeed; found so
        far and not yet started from in vain.
    """

    generation: int
    stage: int
    stage_name: str
    trials: int
    cost: Array
    step: float
    diverged: int
    best: Trial
    trials_to_success: int | None
    record: Record
    replayed: bool
    weights: Mapping[str, float]
    changes: tuple[Change, ...]
    starts: tuple[float, ...] = ()


@dataclass(frozen=True)
class Solution:
    """The outcome: the best trial, and what it took.

    stopped: "success" (and polished), "budget" or "interrupted". weights, changes: as in `Generation`.
    """

    best: Trial
    trials: int
    generations: int
    trials_to_success: int | None
    diverged: int
    stopped: str
    weights: Mapping[str, float]
    changes: tuple[Change, ...]

    @property
    def success(self) -> bool:
        return self.best.success


@dataclass
class _Search:
    """What changes while the loop runs."""

    best: Trial | None = None
    stage: int = 0
    stage_trials: int = 0
    attempt: int = 0
    attempt_trials: int = 0
    trials: int = 0
    generations: int = 0
    diverged: int = 0
    trials_to_success: int | None = None
    hold_steps: int = 0
    seed: int = 0
    robust: bool = False
    starts: list[Trial] = field(default_factory=list)
    """Motions of the nominal model that the robust stages may start from, judged on the models that stay the same."""
    rounds: int = 1
    """How often as many of them as the task says have been looked for."""
    kept: Trial | None = None
    """The best of the rounds before."""


@single_threaded()
def solve(
    task: Task | Objective,
    *,
    seed: int = 0,
    threads: int = 0,
    observe: Callable[[Generation], object] | None = None,
    steer: Callable[[int], Mapping[str, float] | None] | None = None,
    records: Iterable[Record] = (),
) -> Solution:
    """Search for a motion that does the task.

    task: or an `Objective` that was made of one. seed: of the optimizer.
    observe: called after each generation. KeyboardInterrupt, from it or from the keyboard, ends the search with the best
    trial so far.
    steer: called before each generation that is simulated, with its number; what it returns, cost -> factor on its
    weight, holds from this generation on, as a `levade.tasks.Change` in the task would. It may take its time, and raise
    KeyboardInterrupt.
    records: of an earlier solve of the same task and seed; the search goes on after them.
    Raises LevadeError if the records are not of this search, or steer names a cost that the task has not.
    """
    objective = task if isinstance(task, Objective) else Objective(task, threads=threads)
    task = objective.task
    stages, search = task.stages, _Search(seed=seed)
    optimizer = make_optimizer(objective, seed)
    earlier = deque(records)
    weights = _weights(task, 0)
    stopped = "budget"
    _enter(search, objective, stages[0], optimizer)
    try:
        while search.trials + (most := _most(search, task, optimizer)) <= max(task.search.trials, most):
            stage, number = stages[search.stage], search.generations + 1
            if steer is not None and not earlier:
                factors = steer(number)
                if factors:
                    task = task.changed(Change(number, dict(factors)))
            if weights != (weights := _weights(task, number)):
                _weigh_anew(search, objective, weights)
                _forget_costs(optimizer, task)
            candidates = optimizer.ask()
            stage_weights = {**weights, **_stage_weights(task, stage, number)}
            by_mean = task.robust is not None and task.robust.contender == "mean"
            mean = optimizer.mean if by_mean else None
            record, replayed = _evaluate(objective, candidates, search, stage_weights, earlier, mean=mean)
            cost = objective.cost(record.evaluation, stage_weights)
            if isinstance(optimizer, UsesErrors):
                optimizer.tell(cost, _missed(task, record.evaluation))
            else:
                optimizer.tell(cost)

            search.generations += 1
            spent = record.evaluation.trials + (0 if record.validated is None else record.validated.trials)
            search.trials += spent
            search.stage_trials += spent
            search.attempt_trials += spent
            search.diverged += int(record.evaluation.diverged.sum())
            contenders, judged, start = candidates, record.evaluation, None
            if record.validated is not None and search.robust:
                contenders, judged = _contender(candidates, cost, mean), record.validated
            elif record.validated is not None:
                first = _first_to_end(stage, cost, record.evaluation)
                cost_there = float(objective.cost(record.validated, weights)[0])
                start = _trial(candidates[first], cost_there, record.validated, 0)
                if start.success:
                    contenders, judged = candidates[first : first + 1], record.validated
            if search.trials_to_success is None and judged.success.any():
                search.trials_to_success = search.trials
            search.starts += [start] if start is not None else []
            _keep_best(search, objective, contenders, judged, weights)
            assert search.best is not None
            if observe is not None:
                observe(
                    Generation(
                        generation=search.generations,
                        stage=search.stage,
                        stage_name=stage.name,
                        trials=search.trials,
                        cost=cost,
                        step=optimizer.step,
                        diverged=int(record.evaluation.diverged.sum()),
                        best=_better(search.kept, search.best),
                        trials_to_success=search.trials_to_success,
                        record=record,
                        replayed=replayed,
                        weights=weights,
                        changes=task.search.changes,
                        starts=tuple(start.share or 0.0 for start in search.starts),
                    )
                )
            polish = task.search.polish
            since = None if search.trials_to_success is None else search.trials - search.trials_to_success
            if since is not None and polish is not None and since >= polish:
                stopped = "success"
                break
            if _hopeless(task, search) or start is not None:
                if search.starts and search.attempt + 1 >= _starts(task) * search.rounds:
                    search.best, following = min(search.starts, key=_rank), _first_robust(stages)
                    mean = search.best.weights
                    optimizer = make_optimizer(objective, seed, attempt=search.attempt + 1, mean=mean)
                else:
                    optimizer, following = _anew(search, objective), 0
            elif _in_vain(task, search):
                search.rounds, search.kept = search.rounds + 1, _better(search.kept, search.best)
                search.starts = sorted(search.starts, key=_rank)[1:]
                optimizer, following = _anew(search, objective), 0
            elif search.stage + 1 < len(stages) and _ends(stage, search.stage_trials, record.evaluation):
                following = search.stage + 1
            else:
                continue
            search.stage, before = following, (search.hold_steps, search.robust)
            _enter(search, objective, stages[search.stage], optimizer)
            _forget_costs(optimizer, task, hold=search.hold_steps != before[0])
            if (search.hold_steps, search.robust) != before:
                search.trials += _reconsider(search, objective, weights, search.hold_steps)
            if search.robust:
                search.best = _better(search.kept, search.best)
    except KeyboardInterrupt:
        stopped = "interrupted"
    if search.best is None:
        _keep_best(search, objective, objective.initial_weights[None], None, weights)
    elif search.starts and not search.robust and not search.best.success:
        search.best = min(search.starts, key=_rank)
    if search.hold_steps != task.hold_steps or search.robust != (task.robust is not None):
        search.robust = task.robust is not None
        search.trials += _reconsider(search, objective, weights, task.hold_steps)
    assert search.best is not None
    if search.trials_to_success is None and search.best.success:  # as it turns out at the end
        search.trials_to_success = search.trials
    return Solution(
        best=_better(search.kept, search.best),
        trials=search.trials,
        generations=search.generations,
        trials_to_success=search.trials_to_success,
        diverged=search.diverged,
        stopped=stopped,
        weights=weights,
        changes=task.search.changes,
    )


def make_optimizer(objective: Objective, seed: int, *, attempt: int = 0, mean: Array | None = None) -> Optimizer:
    """The task's optimizer, around the objective's initial weights, or a mean (d,); each attempt draws other numbers, and
    others around a mean.
    """
    search = objective.task.search
    space = SearchSpace(
        objective.initial_weights if mean is None else mean,
        objective.factor,
        step=search.step,
        population=search.population,
        ending=objective.ending,
        one_sided=np.array([criterion.target is None for criterion in objective.task.success.values()], dtype=bool),
    )
    own: dict[str, Any] = dict(search.settings)
    if "step_adaptation" in settings(search.optimizer):
        own = {"step_adaptation": search.step_adaptation, **own}
    with located("search.settings."):
        return make_optimizer_of(
            search.optimizer,
            space,
            seed=seed if not attempt else (seed, attempt) if mean is None else (seed, attempt, _AROUND),
            settings=own,
            again=attempt > 0,
        )


def _forget_costs(optimizer: Optimizer, task: Task, *, hold: bool = False) -> None:
    """Costs are weighed by other weights from now on. hold: whether another part of the hold is simulated, too."""
    if isinstance(optimizer, UsesErrors):
        optimizer.forget_costs(np.array([hold and looks_at_hold(criterion) for criterion in task.success.values()]))


def _weights(task: Task, generation: int) -> dict[str, float]:
    """Cost -> weight in a generation, by the task's own weights."""
    factors = task.search.factors(generation)
    return {name: cost.weight * factors.get(name, 1.0) for name, cost in task.costs.items()}


def _stage_weights(task: Task, stage: Stage, generation: int) -> dict[str, float]:
    """Cost -> weight in a generation, of those costs that the stage weighs by itself."""
    factors = task.search.factors(generation)
    return {name: weight * factors.get(name, 1.0) for name, weight in stage.weights.items()}


def _missed(task: Task, evaluation: Evaluation) -> Array:
    """(n, k), errors as a share of what is allowed; NaN where unknown, all of a trial that diverged.

    Of a criterion with bounds, 1 is the bound, and what is farther inside is less.
    """
    shares = [
        1.0 - evaluation.room[name] / BESIDE_BOUND
        if name in evaluation.room
        else off / (task.success[name].tolerance or 1.0)
        for name, off in evaluation.errors.items()
    ]
    missed = np.stack(shares, axis=1) if shares else np.empty((len(evaluation.success), 0))
    return np.where(evaluation.diverged[:, None], np.nan, missed)


def _enter(search: _Search, objective: Objective, stage: Stage, optimizer: Optimizer) -> None:
    search.stage_trials = 0
    task = objective.task
    search.hold_steps = _hold_steps(task, stage)
    search.robust = task.robust is not None and stage.robust
    if stage.step != 1.0:
        optimizer.scale_step(stage.step)


def _hold_steps(task: Task, stage: Stage) -> int:
    """How much of the hold a stage simulates."""
    share = stage.hold * task.hold_steps if isinstance(stage.hold, bool) else stage.hold / task.physics.timestep
    return min(round(share), task.hold_steps)


def _hopeless(task: Task, search: _Search) -> bool:
    """Whether the search has gone on for so long without a success that it had better start anew.

    Where candidates are tried on perturbed models, a motion of the nominal model has been found: it goes on from there.
    """
    restart = task.search.restart
    if restart is None or search.trials_to_success is not None or search.robust:
        return False
    return search.attempt_trials >= restart


def _ends(stage: Stage, trials: int, evaluation: Evaluation) -> bool:
    """Whether a stage ends with a generation; trials: that it took so far."""
    if stage.trials is not None and trials >= stage.trials:
        return True
    return bool(stage.promote) and bool(_promoted(stage, evaluation).any())


def _promoted(stage: Stage, evaluation: Evaluation) -> NDArray[np.bool_]:
    within = ~evaluation.diverged
    for name, tolerance in stage.promote.items():
        within = within & (np.abs(evaluation.errors[name]) <= tolerance)  # nan, of what was not simulated, never is
    return within


def _first_to_end(stage: Stage, cost: Array, evaluation: Evaluation) -> int:
    """The cheapest of those candidates that end a stage; of all, where it ended for its trials."""
    within = _promoted(stage, evaluation)
    return int(np.argmin(np.where(within, cost, np.inf) if within.any() else cost))


def _starts(task: Task) -> int:
    return 1 if task.robust is None else task.robust.starts


def _first_robust(stages: tuple[Stage, ...]) -> int:
    return next(i for i, stage in enumerate(stages) if stage.robust)


def _in_vain(task: Task, search: _Search) -> bool:
    """Whether the last stage of a search from several starts has spent what it may without a success, and as much is left
    as it and the search for starts have taken.
    """
    stage, trials = task.stages[search.stage], task.search.trials
    if _starts(task) == 1 or search.stage + 1 < len(task.stages) or stage.trials is None:
        return False
    spent = search.trials_to_success is None and search.stage_trials >= stage.trials
    return spent and trials - search.trials >= search.trials / search.rounds


def _anew(search: _Search, objective: Objective) -> Optimizer:
    """The optimizer of the next attempt."""
    search.attempt, search.attempt_trials = search.attempt + 1, 0
    return make_optimizer(objective, search.seed, attempt=search.attempt)


def _rank(trial: Trial) -> tuple[bool, float, float]:
    """Less is better: success first, then the share of perturbed models that it succeeds on, then cost."""
    return not trial.success, -(trial.share or 0.0), trial.cost


def _better(one: Trial | None, other: Trial) -> Trial:
    return other if one is None or _rank(other) <= _rank(one) else one


def _most(search: _Search, task: Task, optimizer: Optimizer) -> int:
    """Trials that a generation may take, and looking at the best once more after it."""
    if task.robust is None:
        return optimizer.population
    validated = 1 + task.robust.fixed
    if not search.robust:
        partial_hold = any(_hold_steps(task, stage) < task.hold_steps for stage in task.stages if stage.robust)
        return optimizer.population + validated * ((task.robust.starts > 1) + 1 + partial_hold)
    through = validated if search.hold_steps < task.hold_steps else 0  # of a contender, through the whole hold
    if task.robust.redraw == "never":
        return task.robust.rollouts(optimizer.population) + task.robust.kept(optimizer.population) * through + through
    return task.robust.rollouts(optimizer.population) + validated + through + through


def _try(
    search: _Search,
    objective: Objective,
    candidates: Array,
    *,
    generation: int = 0,
    hold_steps: int | None = None,
    race: Mapping[str, float] | None = None,
) -> Evaluation:
    """Evaluate candidates as the stage says. generation: whose perturbed models; 0 for those that stay the same."""
    hold_steps = search.hold_steps if hold_steps is None else hold_steps
    if objective.sampler is not None and search.robust:
        models = objective.sampler.models(search.seed, generation)
        robust = objective.task.robust
        contend = generation == 0 or robust is None or robust.redraw == "never"  # those that may count as successes
        return objective.evaluate(candidates, hold_steps=hold_steps, models=models, race=race, through=contend)
    evaluation = objective.evaluate(candidates, hold_steps=hold_steps, through=objective.sampler is None)
    if objective.sampler is not None:  # what is yet to be tried on other models has not succeeded
        evaluation.success[:] = False
    return evaluation


def _evaluate(
    objective: Objective,
    candidates: Array,
    search: _Search,
    weights: Mapping[str, float],
    earlier: deque[Record],
    *,
    mean: Array | None,
) -> tuple[Record, bool]:
    """The record of a generation: an earlier one while there are any, else from simulation. weights: of the costs."""
    checksum = zlib.crc32(np.ascontiguousarray(candidates).tobytes())
    number = search.generations + 1
    if not earlier:
        evaluation, validated = _try(search, objective, candidates, generation=number, race=weights), None
        if search.robust and objective.task.robust and objective.task.robust.redraw == "generation":
            contender = _contender(candidates, objective.cost(evaluation, weights), mean)
            validated = _try(search, objective, contender)
        elif _to_start_from(objective.task, search, evaluation):
            stage = objective.task.stages[search.stage]
            first = _first_to_end(stage, objective.cost(evaluation, weights), evaluation)
            validated = _try(
                replace(search, robust=True),
                objective,
                candidates[first : first + 1],
                hold_steps=objective.task.hold_steps,
            )
        return Record(number, checksum, evaluation, validated), False
    record = earlier.popleft()
    if (record.generation, record.checksum) != (number, checksum):
        raise LevadeError(
            f"generation {number} of the records is of another search: the task, the seed or a library has changed since;"
            " start anew in an empty directory"
        )
    return record, True


def _to_start_from(task: Task, search: _Search, evaluation: Evaluation) -> bool:
    """Whether a generation ends the stages of the nominal model, with a motion that is one of several to start from."""
    stages, following = task.stages, search.stage + 1
    if _starts(task) == 1 or search.robust or following != _first_robust(stages):
        return False
    return _ends(stages[search.stage], search.stage_trials + evaluation.trials, evaluation)


def _contender(candidates: Array, cost: Array, mean: Array | None) -> Array:
    """(1, d), who of a generation is compared on the models that stay the same: its distribution's mean, where given."""
    return (candidates[np.argmin(cost)] if mean is None else mean)[None]


def _keep_best(
    search: _Search,
    objective: Objective,
    candidates: Array,
    evaluation: Evaluation | None,
    weights: Mapping[str, float],
) -> None:
    """Keep the best trial of all, by its rank."""
    if evaluation is None:
        evaluation = _try(search, objective, candidates)
    cost = objective.cost(evaluation, weights)
    share = np.zeros(len(cost)) if evaluation.samples is None else evaluation.samples.share
    first = np.lexsort((cost, -share, ~evaluation.success))[0]
    trial = _trial(candidates[first], float(cost[first]), evaluation, first)
    if search.best is None or _rank(trial) < _rank(search.best):
        search.best = trial


def _trial(candidate: Array, cost: float, evaluation: Evaluation, i: int) -> Trial:
    """Candidate ``i`` of an evaluation."""
    return Trial(
        weights=candidate.copy(),
        cost=cost,
        terms={name: float(values[i]) for name, values in evaluation.terms.items()},
        errors={name: float(values[i]) for name, values in evaluation.errors.items()},
        success=bool(evaluation.success[i]),
        share=None if evaluation.samples is None else float(evaluation.samples.share[i]),
    )


def _weigh_anew(search: _Search, objective: Objective, weights: Mapping[str, float]) -> None:
    """What the best trial costs by other weights: those that it will be compared with are weighed by them, too."""

    def weighed(trial: Trial | None, hold_steps: int) -> Trial | None:
        if trial is None:
            return None
        if trial.share is not None:  # its cost is one of many roll-outs
            on_models = replace(search, robust=True)
            evaluation = _try(on_models, objective, trial.weights[None], hold_steps=hold_steps)
        else:
            one = {name: np.array([value]) for name, value in trial.terms.items()}
            diverged = np.array([any(value >= DIVERGED for value in trial.terms.values())])
            evaluation = Evaluation(one, {}, np.array([trial.success]), diverged)
        return replace(trial, cost=float(objective.cost(evaluation, weights)[0]))

    full = objective.task.hold_steps
    search.best = weighed(search.best, search.hold_steps if search.robust else full)
    search.kept = weighed(search.kept, _hold_steps(objective.task, objective.task.stages[-1]))
    search.starts = [start for start in (weighed(start, full) for start in search.starts) if start is not None]


def _reconsider(search: _Search, objective: Objective, weights: Mapping[str, float], hold_steps: int) -> int:
    """Simulate the best trial through as much of the hold as those that it will be compared with, and on the same models.

    Returns how many trials that was: of one model none, as it was one already.
    """
    best = search.best
    assert best is not None
    candidate = best.weights[None]
    evaluation = _try(search, objective, candidate, hold_steps=hold_steps)
    search.best = None  # only now: whoever interrupts the simulation keeps the best
    _keep_best(search, objective, candidate, evaluation, weights)
    return 0 if evaluation.samples is None else evaluation.trials
