"""What a motion has to achieve, and how to look for it: robot, scene, start, policy, costs, stages, success, search."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from levade.costs import Criterion, Term
from levade.engines import Fall, Physics, Settled
from levade.errors import LevadeError, did_you_mean
from levade.optimizers import OPTIMIZERS, canonical, settings
from levade.scenes import Scene
from levade.tasks.robust import Robust


@dataclass(frozen=True)
class RobotChoice:
    """Which robot, and in which version: see `levade.robots.load_robot`. kp [Nm/rad], kd [Nm s/rad]."""

    name: str = "hyq2max"
    actuation: str | None = None
    variant: str | None = None
    linkage: bool = False
    kp: float | None = None
    kd: float | None = None


@dataclass(frozen=True)
class StartChoice:
    """Where the motion starts: exactly one of the two."""

    settled: Settled | None = None
    fall: Fall | None = None

    def __post_init__(self) -> None:
        if (self.settled is None) == (self.fall is None):
            raise LevadeError("start: give one of settled and fall, such as start: {settled: {posture: neutral}}")

    @property
    def choice(self) -> Settled | Fall:
        chosen = self.settled or self.fall
        assert chosen is not None
        return chosen


@dataclass(frozen=True)
class PolicyChoice:
    """How weights become joint references (eq. 3-4).

    kernels, variance, time: see `levade.policies.GaussianKernels`.
    groups: which legs share a policy, mirrored: "pairs" (front and hind, as the paper's rearing), "sides" (left and
        right), "all" (one for all legs), "independent" (one each, as the paper's recovery), or lists of leg names.
    initial: the first mean of the search: "hold" what the joints were told last, or "interpolate" in a straight line from
        the joint angles at the start to the posture ``goal``.
    goal: a posture, as in `levade.engines.Settled`.
    depart, settle: shares of the horizon in which every reference leaves what the joints were told last, and goes over to
        the goal; 0 leaves the ends to the weights. See `levade.policies.Ends`.
    """

    kernels: int = 16
    variance: float = 0.01
    time: Literal["normalised", "seconds"] = "normalised"
    groups: Literal["pairs", "sides", "all", "independent"] | tuple[tuple[str, ...], ...] = "independent"
    initial: Literal["hold", "interpolate"] = "hold"
    goal: str | Mapping[str, float | str] = "neutral"
    depart: float = 0.0
    settle: float = 0.0


@dataclass(frozen=True, eq=False)
class Cost:
    """A term and its weight, the paper's Q_i."""

    term: Term
    weight: float

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Cost) and (self.term, self.weight) == (other.term, other.weight)


@dataclass(frozen=True)
class Stage:
    """A part of the search with a cost of its own.

    trials: budget of the stage; what is left if None. Of the last one, only where there are several `Robust.starts`: after so
        many trials without a success, as many starts again are looked for, while the budget lasts for another such round.
    promote: criterion -> tolerance: the stage ends when one trial is within all of them.
    weights: cost -> weight, instead of the task's.
    hold: how much of the hold is simulated: all (true), none (false), or the first so many seconds. With less than all,
        only trials that meet every criterion so far are simulated through the rest, to see whether they succeed; with
        none, costs that look at the hold are left out.
    step: factor on the optimizer's step size when the stage begins; the rest of the search distribution is kept.
    robust: whether candidates are tried on perturbed models, where the task asks for it at all. Without, nothing succeeds yet.
    """

    name: str = "full"
    trials: int | None = None
    promote: Mapping[str, float] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)
    hold: bool | float = True
    step: float = 1.0
    robust: bool = True


@dataclass(frozen=True)
class Change:
    """Weights that change in the middle of a search, as the sliders of ``levade solve --watch`` do it.

    generation: the first one that they hold in, counted from 1. factors: cost -> factor on its weight, the task's own and
    those of the stages, until another change names the cost; 1 for what the task says.
    """

    generation: int
    factors: Mapping[str, float]


@dataclass(frozen=True)
class Search:
    """How to look.

    optimizer: name; an alias becomes the name. trials: budget, all stages counted.
    population: trials per generation, the optimizer's default if None.
    step: initial standard deviation of the weights [rad].
    smoothness: correlation length of neighbouring weights in the initial covariance, as a share of the horizon; 0 for
        none, as plain CMA-ES has it. modes: search only over so many of the smoothest directions of each joint's weights;
        all if None. step_adaptation: see `levade.optimizers.CMAES`.
    restart: trials without a success after which the search starts anew, from the first stage, with other random numbers:
        whoever rolled to the wrong side seldom finds the way back. Not once candidates are tried on perturbed models. None
        goes on to the end of the budget.
    polish: trials to go on for after the first success, for a lower cost; None goes on to the end of the budget.
    settings: numbers that only this optimizer takes, such as {elite: 0.2}; see its class in `levade.optimizers`.
    changes: of the costs' weights on the way.
    """

    optimizer: str = "cma-aimed"
    trials: int = 3000
    population: int | None = None
    step: float = 0.1
    smoothness: float = 0.3
    modes: int | None = None
    step_adaptation: Literal["csa", "tpa"] = "tpa"
    restart: int | None = None
    polish: int | None = 0
    settings: Mapping[str, float] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(
            self, "optimizer", canonical(self.optimizer)
        )  # so that a search has one form, however it is named

    def factors(self, generation: int) -> dict[str, float]:
        """Cost -> factor on its weight in a generation; costs that nothing changed are left out."""
        due = sorted((c for c in self.changes if c.generation <= generation), key=lambda change: change.generation)
        return {name: factor for change in due for name, factor in change.factors.items()}


@dataclass(frozen=True)
class Task:
    """The declarative whole. Tasks are YAML files; `levade.tasks.load_task` reads them.

    horizon: T [s]. hold: [s] after T in which the reference stays at its last value.
    costs: name -> term and weight. success: name -> criterion; a motion succeeds when all hold.
    stages: in order; each changes the weights of the task's costs, and the last one should leave them as they are.
    robust: None looks for a motion of the nominal model alone.
    """

    name: str
    horizon: float
    costs: Mapping[str, Cost]
    success: Mapping[str, Criterion]
    description: str = ""
    robot: RobotChoice = RobotChoice()
    scene: Scene = Scene()
    physics: Physics = Physics()
    start: StartChoice = StartChoice(settled=Settled())
    hold: float = 0.0
    policy: PolicyChoice = PolicyChoice()
    stages: tuple[Stage, ...] = (Stage(),)
    search: Search = Search()
    robust: Robust | None = None

    def __post_init__(self) -> None:
        if not self.name.strip(". ") or "/" in self.name or "\\" in self.name or not self.name.isprintable():
            raise LevadeError(f"name: {self.name!r} should be a word or two that can name a directory")
        if not (math.isfinite(self.horizon) and self.horizon >= self.physics.timestep):
            raise LevadeError(
                f"horizon: {self.horizon} s should be at least one time step ({self.physics.timestep} s); 0.3 to 3 s is usual"
            )
        if not (math.isfinite(self.hold) and self.hold >= 0):
            raise LevadeError(f"hold: {self.hold} s should be 0 or more")
        if self.horizon + self.hold > 120:
            raise LevadeError(f"horizon: {self.horizon} s and hold {self.hold} s are together more than 120 s")
        if not 1 <= self.policy.kernels <= 1000:
            raise LevadeError(f"policy.kernels: {self.policy.kernels} should be 1 to 1000; the paper has 16")
        if not self.costs:
            raise LevadeError("costs: there are none; at least one term says what to look for")
        if not self.stages:
            raise LevadeError("stages: there are none; leave the key out for a single one")
        _check_search(self.search)
        for name, cost in self.costs.items():
            if not math.isfinite(cost.weight):
                raise LevadeError(f"costs.{name}.weight: {cost.weight} is not a number")
            _check_hold(f"costs.{name}", cost.term, self.hold)
        for name, criterion in self.success.items():
            _check_hold(f"success.{name}", criterion, self.hold)
        for i, stage in enumerate(self.stages):
            where = f"stages.{i}"
            for key, valid in (("weights", self.costs), ("promote", self.success)):
                for name, value in getattr(stage, key).items():
                    if name not in valid:
                        raise LevadeError(f"{where}.{key}: no {name!r} in this task; {did_you_mean(name, valid)}")
                    if not math.isfinite(value):
                        raise LevadeError(f"{where}.{key}.{name}: {value} is not a number")
            if stage.trials is not None and stage.trials < 1:
                raise LevadeError(
                    f"{where}.trials: {stage.trials} should be at least 1; leave it out for all that is left"
                )
            if not 0 <= stage.hold <= max(self.hold, 1):
                raise LevadeError(
                    f"{where}.hold: {stage.hold} should be true, false, or at most the task's {self.hold} s"
                )
            if self.hold_steps and not stage.hold and all(looks_at_hold(cost.term) for cost in self.costs.values()):
                raise LevadeError(
                    f"{where}.hold: {stage.hold}, but every cost of the task looks at the hold; say hold: true"
                )
            if not (math.isfinite(stage.step) and stage.step > 0):
                raise LevadeError(f"{where}.step: {stage.step} should be a positive factor on the step size")

        if self.hold_steps and not any(stage.hold for stage in self.stages):
            for name, cost in self.costs.items():
                if looks_at_hold(cost.term):
                    raise LevadeError(
                        f"costs.{name}: looks at the hold, which no stage simulates, and so counts nowhere; let it look at"
                        " the horizon (at: horizon or over: horizon), or give a stage hold: true or a number of seconds"
                    )

        if self.robust is not None and self.robust.starts > 1:
            robust = [stage.robust for stage in self.stages]
            if robust[0] or not any(robust):
                missing = "the first stage is not robust: false" if robust[0] else "no stage is robust"
                raise LevadeError(
                    f"robust.starts: {self.robust.starts} motions of the nominal model to start from, but {missing}; give"
                    " stages of both kinds, or leave starts out"
                )
        for i, change in enumerate(self.search.changes):
            _check_change(f"search.changes.{i}", change, self.costs)

    def changed(self, change: Change) -> Task:
        """The same task with one more change of its weights; it replaces factors that it names in the same generation."""
        before = {c.generation: c for c in self.search.changes}
        factors = before[change.generation].factors if change.generation in before else {}
        before[change.generation] = Change(change.generation, {**factors, **change.factors})
        changes = tuple(before[generation] for generation in sorted(before))
        return replace(self, search=replace(self.search, changes=changes))

    @property
    def horizon_steps(self) -> int:
        return max(1, round(self.horizon / self.physics.timestep))

    @property
    def hold_steps(self) -> int:
        return round(self.hold / self.physics.timestep)


def looks_at_hold(term: object) -> bool:
    """Whether a term or criterion needs the rows after the horizon. One that looks at the largest or smallest value of
    all takes what there is.
    """
    return getattr(term, "at", "horizon") in ("end", "hold") or getattr(term, "over", "horizon") == "all"


def _check_hold(where: str, term: object, hold: float) -> None:
    if getattr(term, "at", None) == "hold" and hold == 0:
        raise LevadeError(f"{where}.at: hold, but the task has no hold; give it one (hold: 2.0) or say at: horizon")


def _check_change(where: str, change: Change, costs: Mapping[str, Cost]) -> None:
    if change.generation < 1:
        raise LevadeError(f"{where}.generation: {change.generation} should be 1 or more; the first one is 1")
    for name, factor in change.factors.items():
        if name not in costs:
            raise LevadeError(f"{where}.factors: no {name!r} in this task; {did_you_mean(name, costs)}")
        if not (math.isfinite(factor) and factor >= 0):
            raise LevadeError(f"{where}.factors.{name}: {factor} should be a factor on the weight, 0 or more")


def _check_search(search: Search) -> None:
    if search.optimizer not in OPTIMIZERS:
        raise LevadeError(
            f"search.optimizer: no optimizer {search.optimizer!r}; {did_you_mean(search.optimizer, OPTIMIZERS)}"
        )
    own = [name for name in settings(search.optimizer) if name != "step_adaptation"]
    for name in search.settings:
        if name not in own:
            hint = did_you_mean(name, own) if own else "it takes none"
            raise LevadeError(f"search.settings: no {name!r} for {search.optimizer}; {hint}")
    if search.trials < 1:
        raise LevadeError(f"search.trials: {search.trials} should be at least 1; the paper has about 3000")
    if search.population is not None and not 4 <= search.population <= 100_000:
        raise LevadeError(f"search.population: {search.population} should be 4 or more; leave it out for the usual one")
    if not (math.isfinite(search.step) and search.step > 0):
        raise LevadeError(f"search.step: {search.step} should be a positive number of rad; 0.05 to 0.3 is usual")
    if not (math.isfinite(search.smoothness) and search.smoothness >= 0):
        raise LevadeError(f"search.smoothness: {search.smoothness} should be 0 or more, as a share of the horizon")
    if search.restart is not None and search.restart < 1:
        raise LevadeError(f"search.restart: {search.restart} should be at least 1; leave it out to go on")
    if search.polish is not None and search.polish < 0:
        raise LevadeError(f"search.polish: {search.polish} should be 0 or more trials")
