"""From weights to what they achieve: a `Simulation` is built once, an `Objective` is a simulation and a task.

    objective = make_objective(load_task("rearing"))
    evaluation = objective.evaluate(Trials(weights, hold_steps=0))
    other = objective.with_task(task)               # the same simulation, other costs or policy: cheap

`evaluate_many` evaluates the trials of several objectives of one simulation in common batches.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property

import numpy as np

from levade.arrays import Array
from levade.costs import evaluate
from levade.engines import Engine, State, Variations, make_engine
from levade.errors import LevadeError, did_you_mean
from levade.policies import Policy, smoothness_factor
from levade.robots import Robot, load_robot
from levade.search.evaluation import Evaluation, Trials
from levade.search.space import SearchSpace
from levade.tasks import Task, looks_at_hold
from levade.tasks.policy import goal_posture, make_policy
from levade.tasks.reach import check_reach
from levade.trajectory import JointReference, Trajectories

ENDING = 0.25
"""Share of the horizon in which an optimizer may finish a motion, without a change to what comes before."""

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
    def of(cls, task: Task, *, threads: int = 0) -> Simulation:
        """Build the simulation of a task.

        Args:
            task: Names the robot, scene, physics and start.
            threads: Engine threads; 0 for one per core. Results do not depend on it.

        Raises:
            LevadeError: If they do not fit together, or the robot cannot be put down where the start says.
        """
        choice = asdict(task.robot)
        robot = load_robot(choice.pop("name"), **choice)
        engine = make_engine(robot, task.scene, task.physics, threads=threads)
        return cls(robot, engine, engine.start(task.start.choice))

    def starting(self, start: State) -> Simulation:
        """The same simulation from another start."""
        return replace(self, start=start)


class Objective:
    """A task on a simulation: policy, roll-out and costs.

    Args:
        simulation: Built for a task with the same robot, scene, physics and start.
        task: What to achieve.

    Raises:
        LevadeError: If they do not fit together.
    """

    def __init__(self, simulation: Simulation, task: Task) -> None:
        self.simulation, self.task = simulation, task
        self.robot, self.engine, self.state = simulation.robot, simulation.engine, simulation.start
        self.terms = {name: cost.term for name, cost in task.costs.items()}
        self.bodies = _bodies(task, simulation)
        check_reach(task, self.robot, self.engine.model)
        self.policy = make_policy(task, self.robot, start=self.state.joint_reference)
        self._models: dict[tuple[int, int], Variations] = {}

    def with_task(self, task: Task) -> Objective:
        """Another task with the same robot, scene, physics and start, on the same simulation."""
        return Objective(self.simulation, task)

    @cached_property
    def space(self) -> SearchSpace:
        """Where the task's search begins."""
        search, policy, choice = self.task.search, self.policy, self.task.policy
        if choice.initial == "hold":
            mean = policy.hold(self.state.joint_reference)
        else:
            mean = policy.interpolate(self.state.joint_position, goal_posture(choice, self.robot))
        if search.smoothness > 0 or search.modes is not None:
            smooth = smoothness_factor(policy.kernels, search.smoothness, policy.independent_joints, modes=search.modes)
        else:
            smooth = np.eye(policy.size)
        return SearchSpace(
            mean=mean,
            factor=smooth,
            step=search.step,
            population=search.population,
            ending=_ending(policy),
            one_sided=np.array([criterion.target is None for criterion in self.task.success.values()]),
        )

    def rollout(self, weights: Array, *, hold_steps: int | None = None, feet: bool = False) -> Trajectories:
        """Simulate candidates on the nominal model.

        Args:
            weights: Policy weights [rad], shape (n, d).
            hold_steps: How many steps of the hold to simulate. None for all of it.
            feet: Whether to record the contact forces on the feet.
        """
        reference = self.policy.reference(weights, hold_steps=hold_steps)
        return self.engine.rollout(self.state, reference, feet=feet, bodies=self.bodies)

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

    def reference(self, trials: Trials) -> JointReference:
        """What trials ask of the joints, one row a roll-out."""
        reference = self.policy.reference(trials.weights, hold_steps=trials.hold_steps)
        if trials.pairs is None:
            return reference
        # perturbed models have latency: until the first reference arrives, the joints have what they were commanded last
        return replace(reference[trials.pairs[0]], before=self.state.joint_reference)

    def models(self, trials: Trials) -> Variations | None:
        """The perturbed models of trials, one row a roll-out. None for the nominal model."""
        if trials.draw is None or trials.pairs is None:
            return None
        key = (trials.seed, trials.draw)
        if key not in self._models:
            kept = {other: models for other, models in self._models.items() if other[1] == 0}
            self._models = {**kept, key: self._drawn(*key)}
        return self._models[key][trials.pairs[1]]

    def judge(self, trajectories: Trajectories, hold_steps: int) -> Evaluation:
        """Judge trajectories of which ``hold_steps`` of the hold were simulated.

        Without any of the hold, values that look at it are NaN. With part of it, they use that part, except speeds at the
        end, which are for the whole hold only: a robot comes to rest on the way there.
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
        off, slack = ({name: judged.get(name, (unknown, unknown))[i] for name in self.task.success} for i in (0, 1))
        return Evaluation(
            {name: values.get(name, unknown) for name in self.terms},
            off,
            met,
            trajectories.diverged.copy(),
            slack={name: slack[name] for name, criterion in self.task.success.items() if criterion.target is None},
        )

    def _drawn(self, seed: int, draw: int) -> Variations:
        robust = self.task.robust
        assert robust is not None
        ensemble = self._ensemble
        n = robust.samples if draw else robust.fixed
        sample = robust.perturb.spread(ensemble.model, ensemble.joints, n=n, seed=(seed, draw, _TAG))
        return ensemble.vary((self.state.qpos, self.state.qvel, self.state.act), sample)

    @cached_property
    def _ensemble(self):
        return self.engine.ensemble()


def make_objective(task: Task, *, threads: int = 0) -> Objective:
    """Build a task's simulation and objective, and try one trial.

    Raises:
        LevadeError: For whatever does not fit together.
    """
    objective = Objective(Simulation.of(task, threads=threads), task)
    objective.check()
    return objective


def evaluate_many(asked: Sequence[tuple[Objective, Trials]]) -> list[Evaluation]:
    """Evaluate the trials of several objectives on one simulation; each has the same bits as alone."""
    evaluations: list[Evaluation] = []
    for objective, trials in asked:
        reference, models = objective.reference(trials), objective.models(trials)
        parts = []
        for first in range(0, trials.n, AT_ONCE):
            rows = np.arange(first, min(first + AT_ONCE, trials.n))
            if models is None:
                done = objective.engine.rollout(objective.state, reference[rows], bodies=objective.bodies)
            else:
                done = objective._ensemble.rollout(models[rows], reference[rows], bodies=objective.bodies)
            parts.append(objective.judge(done, trials.hold_steps))
        evaluations.append(_joined(parts))
    return evaluations


def _joined(parts: Sequence[Evaluation]) -> Evaluation:
    if len(parts) == 1:
        return parts[0]

    def tables(name: str) -> Mapping[str, Array]:
        return {key: np.concatenate([getattr(part, name)[key] for part in parts]) for key in getattr(parts[0], name)}

    success, diverged = (np.concatenate([getattr(part, name) for part in parts]) for name in ("success", "diverged"))
    return Evaluation(tables("terms"), tables("errors"), success, diverged, tables("slack"))


def _bodies(task: Task, simulation: Simulation) -> tuple[str, ...]:
    """Bodies whose contact forces the task's costs look at."""
    named: set[str] = set()
    for name, cost in task.costs.items():
        for body in getattr(cost.term, "bodies", ()):
            if body not in simulation.engine.bodies:
                hint = did_you_mean(body, simulation.engine.bodies)
                raise LevadeError(f"costs.{name}.bodies: no body {body!r} in {simulation.robot.name}; {hint}")
            named.add(body)
    return tuple(sorted(named))


def _ending(policy: Policy) -> Array | None:
    """One direction for each independent joint, shape (q, d): a ramp over the last quarter of its weights, up to 1.

    None where the motion ends as it must, whatever the weights (`levade.policies.Ends`).
    """
    if policy.ends is not None and policy.ends.settle > 0:
        return None
    ramp = np.clip(1.0 - (1.0 - np.linspace(0.0, 1.0, policy.kernels.kernels)) / ENDING, 0.0, 1.0)
    return np.kron(np.eye(policy.independent_joints), ramp)
