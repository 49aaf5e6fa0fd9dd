"""Plan the searches that turn a task into a motion for hardware: the same goal, and what hardware needs in addition.

    plan = Plan.of(load_task("rearing"), robot)
    plan.within_limits()            # the nominal model, every limit a criterion, the duration free
    plan.robust(0.42)               # perturbed models too, at the duration that was found
    plan.closed_loop(0.42)          # the same with feedback
    plan.in_one_search()            # both of the first, as the task's variants have them

All tasks have the same plan; nothing here depends on a task's name. Each success criterion becomes a cost, which is 1 where the
motion misses by half of the tolerance. These costs replace the task's costs of the goal. Costs of effort and Python code stay.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from levade.costs import (
    AngularVelocity,
    Criterion,
    Duration,
    LinearVelocity,
    Margins,
    Miss,
    Orientation,
    Position,
    Posture,
)
from levade.engines import Perturbation, engine_kind
from levade.robots import Robot, dimensions
from levade.tasks.demands import Demands
from levade.tasks.goals import good_enough, miss_of
from levade.tasks.parts import Cost, HorizonRange, PolicyChoice, Search, Stage
from levade.tasks.regulation import Regulation
from levade.tasks.robust import Robust
from levade.tasks.task import Task

LONGEST = 2.5
"""Longest duration of a motion, as a multiple of its task's duration."""

_BEGIN = 1.4
"""Where the search for a duration begins, as a multiple of the task's duration: slower motions keep limits more easily."""

ROOM = {
    "angle_margin": 0.0,
    "speed_margin": 0.01,
    "torque_speed_margin": 0.01,
    "linkage_margin": 0.01,
    "self_distance": 0.0,
}
"""Quantity -> least slack to the limit on the model [rad, shares, m]. The search stops once the motion leaves this much."""

WANTED = {"angle": 0.05, "speed": 0.1, "torque_speed": 0.1, "linkage": 0.1, "self_distance": 0.01}
"""Slack that the cost of margins asks for: more, since drives, joints and shanks never equal those of the model."""

_KERNELS, _VARIANCE = 6, 0.02
"""Most kernels of a joint, and their variance if the task has more. Smooth motions keep limits more easily. With its own
sixteen kernels rearing met every limit for one of three seeds, with five wide kernels for three of four.
"""

RUN_UP = 1
"""Number of the search within limits that begins around a rough motion."""

_NARROW, _DEPART, _RUN_UP_MARGINS_WEIGHT = (10, 0.004), 0.3, 2.0
"""Settings of that search: the most kernels and their variance if the task has more, the least share of the horizon in which
references leave the start, and the weight of margins. If references leave the start within a tenth, HyQ2Max jumps at once from
standing, which its knees are too slow for. From a crouch they are fast enough."""

_DURATION_WEIGHT = 0.5
"""Cost of a duration as long as the task's: in a quick motion, a robot that differs from the model has less time to fall."""

_MARGINS_WEIGHT, _ROBUST_MARGINS_WEIGHT = 0.5, 0.2
"""Weights of margins on the nominal model, and on perturbed ones. They are so large that a search keeps the limits on its way
to the goal: a search that first reaches the goal beyond the limits seldom comes back."""

_GOALS = (Orientation, Position, Posture, LinearVelocity, AngularVelocity, Miss, Margins)
"""Terms that the plan replaces by costs of the criteria and of margins."""

_REFERENCES_ROOM = 0.2
"""Distance of references from the ends of ranges [rad]: a joint that is pushed gives way, by this much at its torque limit."""

_NEAR = 0.3
"""Factor on the step of a search around a motion that nearly keeps the limits."""

_ON_OTHERS = 5
"""Budget of a search on perturbed models, as a multiple of the task's, if there is no other search before it."""

_FINER, _FINER_VALIDATION, _FINER_TRIALS = 0.1, 120, 4000
"""Settings of a search around a motion that succeeds on most perturbed models: factor on the step, models to judge on, and
trials."""

_SOFTNESS, _CONE = (0.8, 2.0), (0.0, 0.75)
"""Softness and friction cone of contacts on perturbed models: certificates try others, too. Usual time steps cannot resolve
stiffer contacts than these. One model of three has the other cone."""

_SMOOTHNESS = 0.15
"""Correlation length of neighbouring kernels, as in tasks with few kernels."""

_HELD = 0.3
"""Part of the hold that candidates are simulated through [s]: a robot that falls over has begun to by then. A success is
simulated through the whole hold."""


@dataclass(frozen=True)
class Plan:
    """The searches for a task on a robot.

    Attributes:
        task: The task as the user gave it. If the robot has a linkage and the demands name it, the task asks for it, too.
        robot: Its robot, with its linkage in this case.
        goal: Criterion -> what is good enough on hardware: the task's own criterion, with a tolerance of at least that of
            `levade.tasks.goals`.
        on_others: Criterion -> what perturbed models have to meet.
        limits: Criterion -> the slack to keep for each kind of limit that the robot has, or what the task itself asks for.
        feedback: Whether motions may have feedback.
    """

    task: Task
    robot: Robot
    goal: Mapping[str, Criterion]
    on_others: Mapping[str, Criterion]
    limits: Mapping[str, Criterion]
    feedback: bool = True

    @classmethod
    def of(cls, task: Task, robot: Robot, demands: Demands | None = None, *, feedback: bool = True) -> Plan:
        """Make the plan for a task.

        Args:
            task: The task. What ``robust.success`` says also holds on the nominal model; what ``good_enough`` says does not.
            robot: Its robot.
            demands: Demands of the certificate. Defaults to the task's, or else to `levade.tasks.Demands`.
            feedback: Whether motions may have feedback.
        """
        demands = demands or task.hardware or Demands()
        if robot.curves and demands.linkage is not None:
            robot, task = robot.with_linkage(), replace(task, robot=replace(task.robot, linkage=True))
        size = dimensions(robot)
        stated = {} if task.robust is None else task.robust.success or {}
        own = {name: one for name, one in {**task.success, **stated}.items() if one.quantity not in ROOM}
        goal = {name: good_enough(one, size) for name, one in own.items()}
        on_others = {**goal, **({} if stated else task.good_enough)}
        on_others = {name: one for name, one in on_others.items() if name in goal and name in task.on_others}
        asked = {name: one for name, one in task.success.items() if one.quantity in ROOM}
        known = {one.quantity for one in asked.values()}
        limits = {name: one for name, one in _limits(robot, demands).items() if name not in known}
        return cls(task, robot, goal, on_others, {**limits, **asked}, feedback)

    @property
    def loosened(self) -> Mapping[str, tuple[Criterion, Criterion]]:
        """Criterion -> the task's own, and the one that replaces it, on perturbed models at least, where these differ."""
        enough = {**self.goal, **self.on_others}
        pairs = {name: (one, enough[name]) for name, one in self.task.success.items() if name in enough}
        return {name: pair for name, pair in pairs.items() if pair[0] != pair[1]}

    def within_limits(self, number: int = 0) -> Task:
        """Make the task on the nominal model, with limits as criteria. If there are any, its duration is free up to `LONGEST`.

        Args:
            number: Number of the search, from 0. The second search is for motions that need a run-up: it has narrow kernels,
                leaves the start slowly, weighs limits more, and begins around a rough motion (`levade.hardware.starts`). The
                second and third search aim candidates only where the task's own search does not. Aimed candidates find short
                motions sooner, but hinder searches that take long.
        """
        run_up = number == RUN_UP
        horizon = self.task.horizon
        demanding = self._demanding(_RUN_UP_MARGINS_WEIGHT if run_up else _MARGINS_WEIGHT)
        costs = dict(demanding.costs)
        if not isinstance(horizon, HorizonRange) and self.limits:
            horizon = HorizonRange(horizon, LONGEST * horizon, _BEGIN * horizon)
        if isinstance(horizon, HorizonRange):
            costs = {"duration": Cost(Duration(), _DURATION_WEIGHT / self.task.usual_horizon), **costs}
        return replace(
            demanding,
            costs=costs,
            horizon=horizon,
            policy=_with_run_up(self.task.policy, demanding.policy) if run_up else demanding.policy,
            stages=(Stage("within limits", hold=self._held),),
            search=replace(
                _other(demanding.search) if number else demanding.search,
                trials=6000,
                restart=None if run_up else 1200,
                patience=None if run_up else 600,
                polish=240,
                modes=None,
                smoothness=_SMOOTHNESS,
            ),
        )

    def number_of(self, policy: PolicyChoice) -> int:
        """Return the number of the first search within limits with a given policy; 0 if none has it.

        Args:
            policy: Policy of a motion.
        """
        return next((number for number in (0, RUN_UP) if self.within_limits(number).policy == policy), 0)

    def nearer(self, number: int, horizon: float, *, whole_hold: bool = False) -> Task:
        """Make the task of `within_limits` for a search around a motion that nearly keeps the limits.

        Args:
            number: Number of the search that found the motion.
            horizon: Duration of the motion [s].
            whole_hold: Whether to simulate candidates through the whole hold. A robot that falls late needs it.
        """
        task = self.within_limits(number)
        free = task.horizon
        if isinstance(free, HorizonRange):
            free = replace(free, initial=min(max(horizon, free.minimum), free.maximum))
        return replace(
            task,
            horizon=free,
            stages=(Stage("nearer", step=_NEAR, hold=True if whole_hold else self._held),),
            search=replace(task.search, restart=None, patience=None),
        )

    def robust(self, horizon: float, policy: PolicyChoice | None = None) -> Task:
        """Make the task on perturbed models. They have to reach the goal; the nominal model also has to keep the limits.

        The models also differ in how contact is computed.

        Args:
            horizon: Duration [s].
            policy: Policy of the motion to begin around. Defaults to the policy of the first search within limits.
        """
        search, demanding = self.task.search, self._demanding(_ROBUST_MARGINS_WEIGHT)
        perturb, size = self.perturb, dimensions(self.robot)
        eased = {name: one for name, one in self.on_others.items() if one != self.goal[name]}
        costs = {f"{name} (perturbed)": Cost(miss_of(one, size), 1.0) for name, one in eased.items()}
        return replace(
            demanding,
            costs={**demanding.costs, **costs},
            horizon=horizon,
            policy=policy or demanding.policy,
            stages=(Stage("robust", step=0.3, hold=self._held),),
            search=Search(
                optimizer="cma",
                trials=8000,
                population=16,
                step=search.step,
                smoothness=_SMOOTHNESS,
                step_adaptation="csa",
                polish=1500,
            ),
            robust=Robust(
                samples=3,
                measure="mean-log",
                redraw="generation",
                validation=40,
                contender="mean",
                success=self.on_others,
                free=(*eased, *(name for name in ("margins",) if name in demanding.costs)),
                perturb=replace(perturb, softness=perturb.softness or _SOFTNESS, cone=perturb.cone or _CONE),
            ),
        )

    def closed_loop(self, horizon: float, policy: PolicyChoice | None = None) -> Task:
        """Make the task of `robust` with feedback on the perturbed models.

        Args:
            horizon: Duration [s].
            policy: Policy of the motion to begin around, as in `robust`.
        """
        return replace(self.robust(horizon, policy), feedback=Regulation())

    def in_one_search(self) -> Task:
        """Make one task of the searches within limits and on perturbed models, as a variant of the task has them.

        Its first stage looks for a motion of the nominal model, its second one has perturbed models too. If there are limits,
        the duration is free in both.
        """
        within = self.within_limits()
        robust = self.robust(within.usual_horizon)
        assert robust.robust is not None
        reached = {name: one.tolerance or 0.0 for name, one in within.success.items()}
        margins = {name: within.costs[name].weight for name in ("margins",) if name in robust.costs}
        duration = {name: within.costs[name] for name in ("duration",) if name in within.costs}
        return replace(
            robust,
            horizon=within.horizon,
            costs={**duration, **self._demanding(_ROBUST_MARGINS_WEIGHT).costs},
            stages=(
                Stage("nominal", robust=False, hold=self._held, promote=reached, weights=margins),
                replace(robust.stages[0], name="robust"),
            ),
            robust=replace(
                robust.robust,
                measure="mean",
                free=(),
                perturb=self.perturb,
                success=None if robust.success == self.on_others else self.on_others,
                required=Demands().share or 0.0,
            ),
            search=replace(
                robust.search,
                trials=_ON_OTHERS * self.task.search.trials,
                restart=within.search.restart,
                patience=within.search.patience,
            ),
        )

    def finer(self, horizon: float, policy: PolicyChoice | None = None, *, feedback: bool) -> Task:
        """Make one of these tasks with small steps and more models, which distinguish 93 % from 97 %.

        Args:
            horizon: Duration [s].
            policy: Policy of the motion to begin around.
            feedback: Whether to use feedback.
        """
        task = (self.closed_loop if feedback else self.robust)(horizon, policy)
        assert task.robust is not None
        return replace(
            task,
            stages=(Stage("finer", step=_FINER, hold=self._held),),
            search=replace(task.search, trials=_FINER_TRIALS, polish=None),
            robust=replace(task.robust, validation=_FINER_VALIDATION),
        )

    @property
    def perturb(self) -> Perturbation:
        """The ranges in which robots may differ from the model."""
        return Perturbation() if self.task.robust is None else self.task.robust.perturb

    def certifiable(self, task: Task) -> Task:
        """Add to a task what is good enough on perturbed models, as the tasks of robust searches say it.

        Args:
            task: Task of one of the plan's searches.
        """
        if task.robust is not None:
            return task
        return replace(task, robust=Robust(success=self.on_others, perturb=self.perturb))

    @property
    def can_close_the_loop(self) -> bool:
        """Whether motions may have feedback, and the task's engine simulates it."""
        return self.feedback and engine_kind(self.task.physics.engine).feedback

    @property
    def _held(self) -> bool | float:
        return min(_HELD, self.task.hold) if self.task.hold else True

    def _demanding(self, margins_weight: float = _MARGINS_WEIGHT) -> Task:
        size = dimensions(self.robot)
        costs = {name: Cost(miss_of(one, size), 1.0) for name, one in self.goal.items()}
        kept = {
            f"{name} (cost)" if name in costs else name: cost
            for name, cost in self.task.costs.items()
            if not isinstance(cost.term, _GOALS)
        }
        wanted: dict[str, Any] = {}
        for one in self.limits.values():
            name = _OF_MARGINS[one.quantity]
            wanted[name] = max(
                wanted.get(name, 0.0), WANTED[name] + max(0.0, (one.minimum or 0.0) - ROOM[one.quantity])
            )
        margins = {"margins": Cost(Margins(**wanted), margins_weight)} if wanted else {}
        return replace(
            self.task,
            costs={**costs, **kept, **margins},
            success={**self.goal, **self.limits},
            stages=(Stage(hold=self._held),),
            policy=_smooth(self.task.policy),
            search=replace(self.task.search, changes=()),
            robust=None,
            feedback=None,
            hardware=None,
        )


_OF_MARGINS = {
    "angle_margin": "angle",
    "speed_margin": "speed",
    "torque_speed_margin": "torque_speed",
    "linkage_margin": "linkage",
    "self_distance": "self_distance",
}
"""Quantity -> its name in `levade.costs.Margins`."""


def _other(search: Search) -> Search:
    """Return the search without aimed candidates if it has some, and with the usual number if it has none."""
    if search.optimizer != "cma-aimed":
        return search
    aimed = search.settings.get("aimed", 1)
    settings = {name: value for name, value in search.settings.items() if name != "aimed"}
    return replace(search, settings={**settings, "aimed": 0} if aimed else settings)


def _with_run_up(own: PolicyChoice, smooth: PolicyChoice) -> PolicyChoice:
    """Return narrow kernels, for quick moves in the middle of a long motion. Leaving the start early is a quick move, too."""
    kernels, variance = _NARROW
    if own.time == "normalised" and own.kernels <= kernels:
        kernels, variance = own.kernels, own.variance
    depart = max(smooth.depart, _DEPART) if smooth.depart else 0.0
    return replace(smooth, kernels=kernels, variance=variance, time="normalised", depart=depart)


def _smooth(policy: PolicyChoice) -> PolicyChoice:
    # a straight line begins at the joints' positions; the last command of weak servos would jolt strong ones
    if policy.initial == "interpolate" and not policy.through:
        policy = replace(policy, depart=0.0)
    policy = replace(policy, room=_REFERENCES_ROOM if policy.room is None else policy.room)
    if policy.kernels <= _KERNELS and policy.time == "normalised":
        return policy
    return replace(policy, kernels=min(policy.kernels, _KERNELS), variance=_VARIANCE, time="normalised")


def _limits(robot: Robot, demands: Demands) -> dict[str, Criterion]:
    """Return a criterion for each kind of limit that the robot has and the demands name."""
    limits = robot.limits
    demanded = {
        "angle_margin": demands.position,
        "speed_margin": demands.speed,
        "torque_speed_margin": demands.torque_speed,
        "linkage_margin": demands.linkage,
        "self_distance": None if demands.self_collision is None else 0.0,
    }
    there = {
        "angle_margin": bool(np.isfinite([limits.lower, limits.upper]).any()),
        "speed_margin": bool(np.isfinite(limits.velocity).any()),
        "torque_speed_margin": limits.stall_torque is not None,
        "linkage_margin": bool(limits.torque_curves),
        "self_distance": True,
    }
    return {
        name: Criterion(name, minimum=ROOM[name] + demand, at="min")  # type: ignore[arg-type]
        for name, demand in demanded.items()
        if there[name] and demand is not None
    }
