"""Evaluate policy weights: a `Simulation` is built once, an `Objective` is a simulation and a task.

    objective = make_objective(load_task("rearing"))
    evaluation = objective.evaluate(Trials(weights, hold_steps=0))
    other = objective.with_task(task)               # cheap: the same simulation with other costs or another policy

`evaluate_many` evaluates the trials of several objectives of one simulation in common batches.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from levade.arrays import Array
from levade.costs import evaluate
from levade.engines import (
    FOOT_CONTACT_FORCE,
    SELF_DISTANCE,
    SELF_FORCE,
    Engine,
    Models,
    Sample,
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
from levade.search.evaluation import Evaluation, Gains, Index, Trials, joined
from levade.search.memory import check_fits, needed
from levade.search.optimizing import make_attempt
from levade.search.space import search_space
from levade.tasks import Task, looks_at_hold
from levade.tasks.policy import make_policy
from levade.tasks.reach import check_clearance, check_reach
from levade.trajectory import JointReference, Trajectories

AT_ONCE = 128
"""Most roll-outs in one batch: their records have to fit into memory."""

_TAG = 1_380_930_130
"""Separates the perturbed models from those that `levade check` draws with the same seed."""

_ELSEWHERE = 1_701_606_770
"""Separates the order of the starts from all other random numbers."""


@dataclass(frozen=True, eq=False)
class Simulation:
    """A robot in a scene, in an engine, at the start of a motion.

    Attributes:
        robot: The robot.
        engine: The engine, whose model includes the scene.
        start: State where roll-outs start.
        elsewhere: Further states, one row each, where roll-outs on perturbed models start, in turn with ``start``. Motions that
            are robust in this sense also work from there.
    """

    robot: Robot
    engine: Engine
    start: State
    elsewhere: tuple[State, ...] = ()

    @classmethod
    def of(cls, task: Task, *, robot: Robot | None = None, threads: int = 0) -> Simulation:
        """Build the simulation of a task.

        Args:
            task: The task, which names the robot, scene, physics and start.
            robot: A robot to use instead of the task's.
            threads: Number of engine threads (0: one per core). Results do not depend on it.

        Raises:
            LevadeError: If these do not fit together, or the robot cannot be placed as the start says.
        """
        if robot is None:
            robot = task.robot.load()
        engine = make_engine(
            robot,
            task.scene,
            task.physics,
            threads=threads,
            clearance=task.clearance,
            self_force=task.self_force,
        )
        return cls(robot, engine, start_state(engine, robot, task.scene, task.start.choice))

    def starting(self, start: State, *elsewhere: State) -> Simulation:
        """Return the same simulation with another start.

        Args:
            start: State where roll-outs start.
            elsewhere: Further states where roll-outs on perturbed models start, one row each. Their joints' last commands
                should be those of ``start``.
        """
        return replace(self, start=start, elsewhere=elsewhere)


@dataclass(frozen=True, eq=False)
class Rollouts:
    """The roll-outs that an engine is to simulate. `levade.engines.Engine.rollout` describes each field."""

    starts: State
    reference: JointReference
    models: Models | None
    feedback: Feedback | None = None
    sensor_errors: Array | None = None

    def __getitem__(self, rows: slice) -> Rollouts:
        if rows == slice(0, len(self.reference.position)):
            return self  # a search starts all its trials from one state, which the engine recognises
        starts = self.starts if len(self.starts) == 1 else self.starts[rows]
        models = None if self.models is None else self.models[rows]
        if self.feedback is None or self.sensor_errors is None:
            return Rollouts(starts, self.reference[rows], models)
        feedback = self.feedback.along(self.feedback.reference[rows])
        return Rollouts(starts, self.reference[rows], models, feedback, self.sensor_errors[rows])

    @classmethod
    def joined(cls, parts: Sequence[Rollouts]) -> Rollouts:
        """Join several, one after another.

        Args:
            parts: Either all of them or none use perturbed models. One with feedback has to be alone.
        """
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
    """A task on a simulation: policy, roll-outs and costs.

    Args:
        simulation: Simulation of a task with the same robot, scene, physics and start.
        task: The task to achieve.
        policy: A custom policy to use instead of the task's: see `levade.policies.JointPolicy`.

    Raises:
        LevadeError: If these do not fit together.
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
        """Make an objective of another task on the same simulation.

        Args:
            task: A task with the same robot, scene, physics and start.
        """
        own = None if isinstance(self.policy, Policy | FreePolicy) else self.policy
        return Objective(self.simulation, task, own)

    @cached_property
    def space(self) -> SearchSpace:
        """The search space: where the task's search begins."""
        return search_space(self.task, self.robot, self.policy, self.state)

    def rollout(self, weights: Array, *, hold_steps: int | None = None, feet: bool = False) -> Trajectories:
        """Simulate candidates on the nominal model.

        Args:
            weights: Policy weights [rad], shape (n, d).
            hold_steps: Number of steps of the hold to simulate. None simulates all of it.
            feet: Whether to record the contact forces on the feet.
        """
        reference = self.policy.reference(weights, hold_steps=hold_steps)
        record = (FOOT_CONTACT_FORCE, *self.recorded) if feet else self.recorded
        return self.engine.rollout(self.state, reference, record=record)

    def evaluate(self, trials: Trials | Array) -> Evaluation:
        """Simulate trials and judge them.

        Args:
            trials: The trials that a search asks for; or policy weights [rad], shape (n, d), to try on the nominal model
                through the whole hold.
        """
        if not isinstance(trials, Trials):
            trials = Trials(trials, self.task.hold_steps)
        return evaluate_many([(self, trials)])[0]

    def check(self) -> None:
        """Simulate one trial, so that terms which cannot be evaluated raise their error now.

        Raises:
            LevadeError: If a term cannot be evaluated.
        """
        self.evaluate(self.space.mean[None])

    def rollouts(self, trials: Trials) -> Rollouts:
        """Prepare what an engine needs to simulate trials, one row per roll-out.

        Args:
            trials: The trials that a search asks for.
        """
        reference = self.policy.reference(trials.weights, hold_steps=trials.hold_steps)
        if trials.draw is None or trials.pairs is None:
            return Rollouts(self.state, reference, None)
        candidates, models = trials.pairs
        starts, drawn = self._models(trials.seed, trials.draw)
        # perturbed models have latency: until the first reference arrives, the joints keep their last command
        each = replace(reference[candidates], before=self.state.joint_reference[0])
        made = Rollouts(starts[models], each, drawn[models])
        if trials.gains is None or self._closed is None:
            return made
        on_model = self._closed.sensed(reference)
        feedback = self.regulator(trials.gains, seed=trials.seed).along(on_model[candidates])
        errors = self._closed.sensor_errors(trials.seed, trials.draw, len(drawn))
        return replace(made, feedback=feedback, sensor_errors=errors[models])

    def regulator(self, gains: Gains, *, seed: int) -> Feedback:
        """Make the task's feedback. It keeps the robot close to the motion along which its gains are made.

        Args:
            gains: What determines its gains.
            seed: Seed of the search.

        Raises:
            LevadeError: If the task has no feedback.
        """
        if self._closed is None:
            raise LevadeError("feedback: the task has none; add feedback: {} to the task")
        reference = self.policy.reference(gains.along[None], hold_steps=self.task.hold_steps)
        return self._closed.feedback(gains, reference, seed)

    def sensed(self, weights: Array) -> Array:
        """Return what a motion senses on the nominal model at the ticks of the task's feedback, shape (ticks, sensed).

        Args:
            weights: Weights of the motion, shape (d,).
        """
        assert self._closed is not None
        reference = self.policy.reference(weights[None], hold_steps=self.task.hold_steps)
        return self._closed.sensed(reference)[0]

    def remember(self, trials: Trials, trajectories: Trajectories) -> None:
        """Cache what trials on the nominal model sensed, if the task has feedback. It is the reference on perturbed models.

        Where it is not cached, it is simulated again.

        Args:
            trials: The trials that were simulated.
            trajectories: Their trajectories.
        """
        if self._closed is not None and trials.draw is None:
            self._closed.remember(trajectories)

    def judge(self, trajectories: Trajectories, hold_steps: int, *, perturbed: bool = False) -> Evaluation:
        """Judge trajectories by the task's costs and criteria.

        Without any of the hold, values that depend on it are NaN. With part of it, they use that part. Criteria on a speed at
        the end need the whole hold, since a robot comes to rest during it.

        Args:
            trajectories: Trajectories of n trials.
            hold_steps: Number of steps of the hold that were simulated.
            perturbed: Whether the trials ran on perturbed models. The criteria that are good enough there then count, and the
                errors of the others are NaN.
        """
        terms, n = self.terms, trajectories.n
        criteria = self.task.on_others if perturbed else self.task.success
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
        """Return a draw of perturbed models and the start of each. Caches the latest draw and the models that stay the same."""
        robust, engine, key = self.task.robust, self.engine, (seed, draw)
        assert robust is not None
        if key not in self._drawn:
            n = robust.samples if draw else robust.fixed
            sample = robust.perturb.spread(engine.model, engine.embodiment.joints, n=n, seed=(seed, draw, _TAG))
            kept = {other: models for other, models in self._drawn.items() if other[1] == 0}
            order = np.random.default_rng((seed, draw, _ELSEWHERE)).permutation(n) if draw else np.arange(n)
            self._drawn = {**kept, key: self._started(sample, order)}
        return self._drawn[key]

    def _started(self, sample: Sample, order: Index) -> tuple[State, Models]:
        """Make perturbed models, and start them in turn, in this order, from each of the states where roll-outs start."""
        starts = (self.state, *self.simulation.elsewhere)
        rows = [np.flatnonzero(order % len(starts) == i) for i in range(len(starts))]
        made = [
            perturbed_models(self.engine.model, self.engine.layout, sample[own], start)
            for own, start in zip(rows, starts, strict=True)
            if len(own)
        ]
        back = np.argsort(np.concatenate(rows))
        return State.stacked([states for states, _ in made])[back], Models.stacked([models for _, models in made])[back]


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
        robot: A robot to use instead of the task's.
        policy: A policy to use instead of the task's, or a function that makes one for the task and the robot.
        threads: Number of engine threads (0: one per core).

    Raises:
        LevadeError: If the parts of the task do not fit together.
    """
    simulation = Simulation.of(task, robot=robot, threads=threads)
    made = policy(task, simulation.robot) if policy is not None and not isinstance(policy, JointPolicy) else policy
    objective = Objective(simulation, task, made)
    objective.check()
    make_attempt(task, objective.space, seed=0)  # raises now if its optimizer does not take the settings
    return objective


def evaluate_many(asked: Sequence[tuple[Objective, Trials]]) -> list[Evaluation]:
    """Evaluate the trials of several objectives. Trials of one engine and of one length share batches.

    Args:
        asked: Objectives, each with the trials to evaluate.

    Returns:
        An evaluation for each, with the same bits as `Objective.evaluate` gives for it alone.
    """
    found: list[Evaluation | None] = [None] * len(asked)
    together: dict[tuple[int, int, bool, tuple[str, ...], int], list[int]] = {}
    for i, (objective, trials) in enumerate(asked):
        steps = objective.policy.horizon_steps + trials.hold_steps
        alone = -1 if trials.gains is None else i  # it has its own gains
        key = (id(objective.engine), steps, trials.draw is None, objective.recorded, alone)
        together.setdefault(key, []).append(i)
    for members in together.values():
        for i, evaluation in zip(members, _evaluate_in_parts([asked[i] for i in members]), strict=True):
            found[i] = evaluation
    return [evaluation for evaluation in found if evaluation is not None]


def _evaluate_in_parts(asked: Sequence[tuple[Objective, Trials]]) -> Iterable[Evaluation]:
    """Evaluate as `_evaluate_together` does, in parts that fit into memory if not all trials fit at once."""
    objective, trials = asked[0]
    steps = objective.policy.horizon_steps + trials.hold_steps
    fit = needed(objective.engine, steps).at_once
    if fit is None or fit >= sum(trials.n for _, trials in asked):
        return _evaluate_together(asked)
    check_fits(objective.engine, steps)
    most = min(fit, AT_ONCE)
    return [
        joined(
            [
                next(iter(_evaluate_together([(one, trials[first : first + most])])))
                for first in range(0, trials.n, most)
            ]
        )
        for one, trials in asked
    ]


def _evaluate_together(asked: Sequence[tuple[Objective, Trials]]) -> Iterator[Evaluation]:
    """Evaluate trials of one engine, of one length, all on the nominal model or all on perturbed ones."""

    def judge(i: int, trajectories: Trajectories) -> Evaluation:
        objective, trials = asked[i]
        objective.remember(trials, trajectories)
        return objective.judge(trajectories, trials.hold_steps, perturbed=trials.draw is not None)

    return judge_together([(objective, objective.rollouts(trials)) for objective, trials in asked], judge)


def judge_together(
    asked: Sequence[tuple[Objective, Rollouts]], judge: Callable[[int, Trajectories], Evaluation]
) -> Iterator[Evaluation]:
    """Simulate roll-outs of several objectives in shared batches, and judge them.

    Args:
        asked: Objectives of one engine, which record the same, each with its roll-outs. All roll-outs have one length, and all
            or none use perturbed models.
        judge: Function that judges the trajectories of one of them, given its index. A part of its roll-outs may come alone.

    Returns:
        An evaluation for each, in order.
    """
    engine, record = asked[0][0].engine, asked[0][0].recorded
    rollouts = Rollouts.joined([one for _, one in asked])
    owner = np.repeat(np.arange(len(asked)), [len(one.reference.position) for _, one in asked])
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
            own = np.flatnonzero(owner[rows] == i)
            judged = trajectories if len(own) == trajectories.n else trajectories[slice(own[0], own[-1] + 1)]
            parts[i].append(judge(int(i), judged))
    return map(joined, parts)


def _recorded(task: Task, simulation: Simulation) -> tuple[str, ...]:
    """Return what else to record for the task's costs and criteria: distances, and contact forces on bodies."""
    named: set[str] = set()
    for name, cost in task.costs.items():
        for body in getattr(cost.term, "bodies", ()):
            if body not in simulation.engine.bodies:
                hint = did_you_mean(body, simulation.engine.bodies)
                raise LevadeError(f"costs.{name}.bodies: no body {body!r} in {simulation.robot.name}; {hint}")
            named.add(body)
    if task.self_force:
        if not simulation.engine.feels:
            raise LevadeError(
                f"self_contact: the engine {simulation.engine.name} measures no forces between the robot's parts;"
                " use the engine mujoco"
            )
        if simulation.engine.layout.force_sensor is None:
            raise LevadeError(
                "self_contact: the simulation measures no forces between the robot's parts; build it for this task"
            )
    found = (*((SELF_FORCE,) if task.self_force else ()), *sorted(named))
    if task.clearance is None:
        return found
    measured = simulation.engine.layout.clearance
    if measured is None or measured < task.clearance:
        raise LevadeError(
            f"self_distance: the task asks for {task.clearance:g} m between the robot's parts, but the simulation measures"
            f" {'no distance' if measured is None else f'up to {measured:g} m'}; build the simulation for this task"
        )
    return (SELF_DISTANCE, *found)
