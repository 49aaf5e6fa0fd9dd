"""From weights to what they achieve: a `Simulation` is built once, an `Objective` is a simulation and a task.

    objective = make_objective(load_task("rearing"))
    evaluation = objective.evaluate(Trials(weights, hold_steps=0))
    other = objective.with_task(task)               # the same simulation, other costs or policy: cheap

`evaluate_many` evaluates the trials of several objectives of one simulation in common batches.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from levade.arrays import Array
from levade.costs import evaluate
from levade.engines import (
    FOOT_CONTACT_FORCE,
    SELF_DISTANCE,
    Engine,
    Models,
    State,
    make_engine,
    perturbed_models,
    start_state,
)
from levade.errors import LevadeError, did_you_mean
from levade.feedback import Feedback
from levade.optimizers import SearchSpace
from levade.policies import FreePolicy, JointPolicy, Policy
from levade.robots import Robot
from levade.search.closed_loop import ClosedLoop
from levade.search.evaluation import Evaluation, Trials
from levade.search.memory import check_fits, needed
from levade.search.optimizing import make_attempt
from levade.search.space import search_space
from levade.tasks import Task, looks_at_hold
from levade.tasks.policy import make_policy
from levade.tasks.reach import check_clearance, check_reach
from levade.trajectory import JointReference, Trajectories

AT_ONCE = 128
"""Roll-outs in one batch: what they record has to fit into memory."""

_TAG = 1_380_930_130
"""Keeps perturbed models apart from those that `levade check` draws with the same seed."""


@dataclass(frozen=True, eq=False)
class Simulation:
    """A robot in a scene, in an engine, at the start of a motion.

    Attributes:
        robot: The robot.
        engine: The engine, which has the scene in its model.
        start: Where roll-outs start.
    """

    robot: Robot
    engine: Engine
    start: State

    @classmethod
    def of(cls, task: Task, *, robot: Robot | None = None, threads: int = 0) -> Simulation:
        """Build the simulation of a task.

        Args:
            task: Names the robot, scene, physics and start.
            robot: The robot, instead of the one that the task names.
            threads: Engine threads; 0 for one per core. Results do not depend on it.

        Raises:
            LevadeError: If they do not fit together, or the robot cannot be put down where the start says.
        """
        if robot is None:
            robot = task.robot.load()
        engine = make_engine(robot, task.scene, task.physics, threads=threads, clearance=task.clearance)
        return cls(robot, engine, start_state(engine, robot, task.scene, task.start.choice))

    def starting(self, start: State) -> Simulation:
        """The same simulation from another start."""
        return replace(self, start=start)


@dataclass(frozen=True, eq=False)
class Rollouts:
    """What an engine is asked to simulate: `levade.engines.Engine.rollout` says what each is."""

    starts: State
    reference: JointReference
    models: Models | None
    feedback: Feedback | None = None
    sensor_errors: Array | None = None

    def __getitem__(self, rows: slice) -> Rollouts:
        if rows == slice(0, len(self.reference.position)):
            return self  # a search starts all its trials from one state, which the engine knows again
        starts = self.starts if len(self.starts) == 1 else self.starts[rows]
        models = None if self.models is None else self.models[rows]
        if self.feedback is None or self.sensor_errors is None:
            return Rollouts(starts, self.reference[rows], models)
        feedback = self.feedback.along(self.feedback.reference[rows])
        return Rollouts(starts, self.reference[rows], models, feedback, self.sensor_errors[rows])

    @classmethod
    def joined(cls, parts: Sequence[Rollouts]) -> Rollouts:
        """Several, one after another; all on perturbed models, or none, and none under feedback unless it is the only one."""
        first = parts[0]
        if len(parts) == 1:
            return first
        rows = [len(part.reference.position) for part in parts]
        if all(part.starts is first.starts for part in parts) and len(first.starts) == 1:
            starts = first.starts
        else:
            starts = State.stacked([part.starts.repeated(n) for part, n in zip(parts, rows, strict=True)])
        models = [part.models for part in parts if part.models is not None]
        reference = JointReference.stacked([part.reference for part in parts])
        return cls(starts, reference, Models.stacked(models) if models else None)


class Objective:
    """A task on a simulation: policy, roll-out and costs.

    Args:
        simulation: Built for a task with the same robot, scene, physics and start.
        task: What to achieve.
        policy: A policy of one's own, instead of the task's: see `levade.policies.JointPolicy`.

    Raises:
        LevadeError: If they do not fit together.
    """

    def __init__(self, simulation: Simulation, task: Task, policy: JointPolicy | None = None) -> None:
        self.simulation, self.task = simulation, task
        self.robot, self.engine, self.state = simulation.robot, simulation.engine, simulation.start
        self.terms = {name: cost.term for name, cost in task.costs.items()}
        self.recorded = _recorded(task, simulation)
        check_reach(task, self.robot, self.engine.model)
        check_clearance(task, self.robot, self.engine.model)
        check_fits(self.engine, task.horizon_steps + task.hold_steps)
        self.policy = policy or make_policy(task, self.robot, start=self.state.joint_reference[0])
        self._drawn: dict[tuple[int, int], tuple[State, Models]] = {}
        self._closed = None if task.feedback is None else ClosedLoop(task.feedback, task, self.engine, self.state)

    def with_task(self, task: Task) -> Objective:
        """Another task with the same robot, scene, physics and start, on the same simulation."""
        own = None if isinstance(self.policy, Policy | FreePolicy) else self.policy
        return Objective(self.simulation, task, own)

    @cached_property
    def space(self) -> SearchSpace:
        """Where the task's search begins."""
        return search_space(self.task, self.robot, self.policy, self.state)

    def rollout(self, weights: Array, *, hold_steps: int | None = None, feet: bool = False) -> Trajectories:
        """Simulate candidates on the nominal model.

        Args:
            weights: Policy weights [rad], shape (n, d).
            hold_steps: How many steps of the hold to simulate. None for all of it.
            feet: Whether to record the contact forces on the feet.
        """
        reference = self.policy.reference(weights, hold_steps=hold_steps)
        record = (FOOT_CONTACT_FORCE, *self.recorded) if feet else self.recorded
        return self.engine.rollout(self.state, reference, record=record)

    def evaluate(self, trials: Trials | Array) -> Evaluation:
        """Simulate trials and judge them.

        Args:
            trials: What a search asks for; or policy weights [rad], shape (n, d), to be tried on the nominal model through the
                whole hold.
        """
        if not isinstance(trials, Trials):
            trials = Trials(trials, self.task.hold_steps)
        return evaluate_many([(self, trials)])[0]

    def check(self) -> None:
        """Simulate one trial, so that terms which cannot be evaluated say so now.

        Raises:
            LevadeError: If a term cannot be evaluated.
        """
        self.evaluate(self.space.mean[None])

    def rollouts(self, trials: Trials) -> Rollouts:
        """What an engine needs to simulate trials, one row a roll-out."""
        reference = self.policy.reference(trials.weights, hold_steps=trials.hold_steps)
        if trials.draw is None or trials.pairs is None:
            return Rollouts(self.state, reference, None)
        candidates, models = trials.pairs
        starts, drawn = self._models(trials.seed, trials.draw)
        # perturbed models have latency: until the first reference arrives, the joints have what they were commanded last
        each = replace(reference[candidates], before=self.state.joint_reference[0])
        made = Rollouts(starts[models], each, drawn[models])
        if trials.along is None or self._closed is None:
            return made
        on_model = self._closed.sensed(reference)
        feedback = self.regulator(trials.along, seed=trials.seed).along(on_model[candidates])
        errors = self._closed.sensor_errors(trials.seed, trials.draw, len(drawn))
        return replace(made, feedback=feedback, sensor_errors=errors[models])

    def regulator(self, along: Array, *, seed: int) -> Feedback:
        """The feedback of the task, with gains made along a motion, which holds the robot to that motion.

        Args:
            along: Weights of the motion, shape (d,).
            seed: Seed of the search.

        Raises:
            LevadeError: If the task has no feedback.
        """
        if self._closed is None:
            raise LevadeError("feedback: the task has none; give feedback: {}")
        reference = self.policy.reference(along[None], hold_steps=self.task.hold_steps)
        return self._closed.feedback(along, reference, seed)

    def sensed(self, weights: Array) -> Array:
        """What a motion senses on the nominal model at the ticks of the task's feedback, shape (ticks, sensed).

        Args:
            weights: Its weights, shape (d,).
        """
        assert self._closed is not None
        reference = self.policy.reference(weights[None], hold_steps=self.task.hold_steps)
        return self._closed.sensed(reference)[0]

    def remember(self, trials: Trials, trajectories: Trajectories) -> None:
        """Keep what trials on the nominal model sensed, if the task has feedback: it holds perturbed models to that.

        It is simulated again where it is not kept.
        """
        if self._closed is not None and trials.draw is None:
            self._closed.remember(trajectories)

    def judge(self, trajectories: Trajectories, hold_steps: int, *, perturbed: bool = False) -> Evaluation:
        """Judge trajectories of which ``hold_steps`` of the hold were simulated.

        On perturbed models, what is good enough there counts, and the errors of criteria that are not asked for are NaN.

        Without any of the hold, values that look at it are NaN. With part of it, they use that part, except speeds at the
        end, which are for the whole hold only: a robot comes to rest on the way there.
        """
        terms, n = self.terms, trajectories.n
        criteria = self.task.good_enough if perturbed else self.task.success
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
        off, slack = ({name: judged.get(name, (unknown, unknown))[i] for name in self.task.success} for i in (0, 1))
        return Evaluation(
            {name: values.get(name, unknown) for name in self.terms},
            off,
            met,
            trajectories.diverged.copy(),
            slack={name: slack[name] for name, criterion in self.task.success.items() if criterion.target is None},
        )

    def _models(self, seed: int, draw: int) -> tuple[State, Models]:
        """A draw of perturbed models and where each starts. The latest is kept, and the models that stay the same."""
        robust, engine, key = self.task.robust, self.engine, (seed, draw)
        assert robust is not None
        if key not in self._drawn:
            n = robust.samples if draw else robust.fixed
            sample = robust.perturb.spread(engine.model, engine.embodiment.joints, n=n, seed=(seed, draw, _TAG))
            kept = {other: models for other, models in self._drawn.items() if other[1] == 0}
            self._drawn = {**kept, key: perturbed_models(engine.model, engine.layout, sample, self.state)}
        return self._drawn[key]


def make_objective(
    task: Task,
    *,
    robot: Robot | None = None,
    policy: JointPolicy | Callable[[Task, Robot], JointPolicy] | None = None,
    threads: int = 0,
) -> Objective:
    """Build a task's simulation and objective, and try one trial.

    Args:
        task: The task.
        robot: The robot, instead of the one that the task names.
        policy: A policy, or a function that makes one for the task and the robot, instead of the task's.
        threads: Engine threads; 0 for one per core.

    Raises:
        LevadeError: For whatever does not fit together.
    """
    simulation = Simulation.of(task, robot=robot, threads=threads)
    made = policy(task, simulation.robot) if policy is not None and not isinstance(policy, JointPolicy) else policy
    objective = Objective(simulation, task, made)
    objective.check()
    make_attempt(task, objective.space, seed=0)  # settings that its optimizer does not take say so now
    return objective


def evaluate_many(asked: Sequence[tuple[Objective, Trials]]) -> list[Evaluation]:
    """Evaluate the trials of several objectives; those of one engine that last as long share batches.

    Each has the same bits as alone.
    """
    found: list[Evaluation | None] = [None] * len(asked)
    together: dict[tuple[int, int, bool, tuple[str, ...], int], list[int]] = {}
    for i, (objective, trials) in enumerate(asked):
        steps = objective.policy.horizon_steps + trials.hold_steps
        alone = -1 if trials.along is None else i  # under gains of its own
        key = (id(objective.engine), steps, trials.draw is None, objective.recorded, alone)
        together.setdefault(key, []).append(i)
    for members in together.values():
        for i, evaluation in zip(members, _evaluate_in_parts([asked[i] for i in members]), strict=True):
            found[i] = evaluation
    return [evaluation for evaluation in found if evaluation is not None]


def _evaluate_in_parts(asked: Sequence[tuple[Objective, Trials]]) -> Iterable[Evaluation]:
    """As `_evaluate_together`, in parts that fit into the memory if all do not fit at once."""
    objective, trials = asked[0]
    steps = objective.policy.horizon_steps + trials.hold_steps
    fit = needed(objective.engine, steps).at_once
    if fit is None or fit >= sum(trials.n for _, trials in asked):
        return _evaluate_together(asked)
    check_fits(objective.engine, steps)
    most = min(fit, AT_ONCE)
    return [
        _joined(
            [
                next(iter(_evaluate_together([(one, trials[first : first + most])])))
                for first in range(0, trials.n, most)
            ]
        )
        for one, trials in asked
    ]


def _evaluate_together(asked: Sequence[tuple[Objective, Trials]]) -> Iterator[Evaluation]:
    """Evaluate trials of one engine, of one length, all on the nominal model or all on perturbed ones."""
    engine, record = asked[0][0].engine, asked[0][0].recorded
    rollouts = Rollouts.joined([objective.rollouts(trials) for objective, trials in asked])
    owner = np.repeat(np.arange(len(asked)), [trials.n for _, trials in asked])
    parts: list[list[Evaluation]] = [[] for _ in asked]
    for first in range(0, len(owner), AT_ONCE):
        rows = slice(first, min(first + AT_ONCE, len(owner)))
        part = rollouts[rows]
        trajectories = engine.rollout(
            part.starts,
            part.reference,
            models=part.models,
            feedback=part.feedback,
            sensor_errors=part.sensor_errors,
            record=record,
        )
        for i in np.unique(owner[rows]):
            objective, trials = asked[i]
            own = np.flatnonzero(owner[rows] == i)
            judged = trajectories if len(own) == trajectories.n else trajectories[slice(own[0], own[-1] + 1)]
            objective.remember(trials, judged)
            parts[i].append(objective.judge(judged, trials.hold_steps, perturbed=trials.draw is not None))
    return map(_joined, parts)


def _joined(parts: Sequence[Evaluation]) -> Evaluation:
    if len(parts) == 1:
        return parts[0]

    def tables(name: str) -> Mapping[str, Array]:
        return {key: np.concatenate([getattr(part, name)[key] for part in parts]) for key in getattr(parts[0], name)}

    success, diverged = (np.concatenate([getattr(part, name) for part in parts]) for name in ("success", "diverged"))
    return Evaluation(tables("terms"), tables("errors"), success, diverged, tables("slack"))


def _recorded(task: Task, simulation: Simulation) -> tuple[str, ...]:
    """What else has to be recorded for the task's costs and criteria: distances, and bodies' contact forces."""
    named: set[str] = set()
    for name, cost in task.costs.items():
        for body in getattr(cost.term, "bodies", ()):
            if body not in simulation.engine.bodies:
                hint = did_you_mean(body, simulation.engine.bodies)
                raise LevadeError(f"costs.{name}.bodies: no body {body!r} in {simulation.robot.name}; {hint}")
            named.add(body)
    if task.clearance is None:
        return tuple(sorted(named))
    measured = simulation.engine.layout.clearance
    if measured is None or measured < task.clearance:
        raise LevadeError(
            f"self_distance: the task asks for {task.clearance:g} m between the robot's parts, but the simulation measures"
            f" {'none' if measured is None else f'up to {measured:g} m'}; build the simulation for this task"
        )
    return (SELF_DISTANCE, *sorted(named))
