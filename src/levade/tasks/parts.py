"""The parts of a task: which robot, where it starts, policy, costs, stages, and how to look."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Literal

from levade.costs import Term
from levade.engines import Fall, Fallen, GivenState, Settled
from levade.errors import LevadeError
from levade.optimizers import Choice, canonical
from levade.robots import Robot, load_robot

if TYPE_CHECKING:
    OptimizerChoice = Choice
else:
    OptimizerChoice = str  # what a task file may hold


@dataclass(frozen=True)
class RobotChoice:
    """Which robot, and in which version: see `levade.robots.load_robot`. kp [Nm/rad], kd [Nm s/rad]."""

    name: str = "hyq2max"
    actuation: str | None = None
    variant: str | None = None
    linkage: bool = False
    kp: float | None = None
    kd: float | None = None

    def load(self) -> Robot:
        """Load the robot. Raises LevadeError."""
        options = asdict(self)
        return load_robot(options.pop("name"), **options)


@dataclass(frozen=True)
class StartChoice:
    """Where the motion starts: exactly one of the four."""

    settled: Settled | None = None
    fall: Fall | None = None
    fallen: Fallen | None = None
    state: GivenState | None = None

    def __post_init__(self) -> None:
        if sum(one is not None for one in self._all) != 1:
            raise LevadeError(
                "start: give one of settled, fall, fallen and state, such as start: {settled: {posture: neutral}}"
            )

    @property
    def _all(self) -> tuple[Settled | Fall | Fallen | GivenState | None, ...]:
        return self.settled, self.fall, self.fallen, self.state

    @property
    def choice(self) -> Settled | Fall | Fallen | GivenState:
        return next(one for one in self._all if one is not None)


@dataclass(frozen=True)
class HorizonRange:
    """A horizon T that is a decision of the search: each trial has its own.

    minimum, maximum: bounds [s], both always there. initial: where the search begins [s]; the geometric mean of the bounds if
        None, as T is searched in its logarithm.
    """

    minimum: float
    maximum: float
    initial: float | None = None

    def __post_init__(self) -> None:
        for name in ("minimum", "maximum", "initial"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise LevadeError(f"horizon.{name}: {value} s should be a positive number of seconds")
        if self.minimum > self.maximum:
            raise LevadeError(f"horizon.minimum: {self.minimum} s is above the maximum, {self.maximum} s")
        if self.initial is not None and not self.minimum <= self.initial <= self.maximum:
            raise LevadeError(
                f"horizon.initial: {self.initial} s should be within the bounds, {self.minimum} to {self.maximum} s"
            )

    def __str__(self) -> str:
        return f"{self.minimum:g} to {self.maximum:g} s"

    @property
    def begin(self) -> float:
        """Where the search begins [s]."""
        return math.sqrt(self.minimum * self.maximum) if self.initial is None else self.initial


@dataclass(frozen=True)
class PolicyChoice:
    """How weights become joint references (eq. 3-4).

    kernels, variance, time: see `levade.policies.GaussianKernels`.
    groups: which legs share a policy, mirrored: "pairs" (front and hind, as the paper's rearing), "sides" (left and
        right), "all" (one for all legs), "independent" (one each, as the paper's recovery), or lists of leg names.
    initial: the first mean of the search: "hold" what the joints were told last, or "interpolate" in a straight line from
        the joint angles at the start to the posture ``goal``, or from posture to posture of ``through`` on the way there.
    goal: a posture, as in `levade.engines.Settled`; or "free": the search finds it, within the joints' ranges. Legs, ends and
        sides may be free (``{hind: free}``), and joints, within the two angles of a range (``{"*_kfe": [-2.0, -1.0]}``); the
        rest of the posture is the neutral one. A free one needs ``settle``.
    through: postures that ``interpolate`` goes through, at equal distances in time between the start and the goal.
    depart, settle: shares of the horizon in which every reference leaves what the joints were told last, and goes over to
        the goal; 0 leaves the ends to the weights. See `levade.policies.Ends`.
    room: how far references stay from the ends of the joints' ranges [rad], at rest where they would come nearer, as with a
        drive that clamps them; at most a quarter of a range. None lets them go anywhere.
    slew: share of the joints' speed limits that references keep to, which otherwise begin early what is too sudden: see
        `levade.policies.Slew`. None lets them be as fast as the weights say.
    """

    kernels: int = 16
    variance: float = 0.01
    time: Literal["normalised", "seconds"] = "normalised"
    groups: Literal["pairs", "sides", "all", "independent"] | tuple[tuple[str, ...], ...] = "independent"
    initial: Literal["hold", "interpolate"] = "hold"
    goal: str | Mapping[str, float | str | tuple[float, float]] = "neutral"
    through: tuple[str | Mapping[str, float | str], ...] = ()
    depart: float = 0.0
    settle: float = 0.0
    room: float | None = None
    slew: float | None = None

    @property
    def goal_is_free(self) -> bool:
        """Whether some of the final posture is for the search to find."""
        values = [self.goal] if isinstance(self.goal, str) else self.goal.values()
        return any(value == FREE or isinstance(value, tuple) for value in values)


FREE = "free"
"""What stands for a posture that the search finds."""


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

    optimizer: name, where an alias becomes the name; or, in Python, a class, function or object: see `levade.optimizers`.
    trials: budget, all stages counted.
    population: trials per generation, the optimizer's default if None.
    step: initial standard deviation of the weights [rad].
    smoothness: correlation length of neighbouring weights in the initial covariance, as a share of the horizon; 0 for
        none, as plain CMA-ES has it. modes: search only over so many of the smoothest directions of each joint's weights;
        all if None. step_adaptation: see `levade.optimizers.CMAES`.
    restart: trials without a success after which the search starts anew, from the first stage, with other random numbers:
        whoever rolled to the wrong side seldom finds the way back. Not once candidates are tried on perturbed models. None
        goes on to the end of the budget.
    patience: with restart, trials over which the best cost has to have fallen by a tenth for an attempt to go on all the
        same. None restarts it in any case.
    polish: trials to go on for after the first success, for a lower cost; None goes on to the end of the budget.
    settings: numbers that only this optimizer takes, such as {elite: 0.2}; see its class in `levade.optimizers`.
    changes: of the costs' weights on the way.
    """

    optimizer: OptimizerChoice = "cma-aimed"
    trials: int = 3000
    population: int | None = None
    step: float = 0.1
    smoothness: float = 0.3
    modes: int | None = None
    step_adaptation: Literal["csa", "tpa"] = "tpa"
    restart: int | None = None
    patience: int | None = None
    polish: int | None = 0
    settings: Mapping[str, float] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()

    def __post_init__(self) -> None:
        # so that a search has one form, however it is named
        object.__setattr__(self, "optimizer", canonical(self.optimizer))

    def factors(self, generation: int) -> dict[str, float]:
        """Cost -> factor on its weight in a generation; costs that nothing changed are left out."""
        due = sorted((c for c in self.changes if c.generation <= generation), key=lambda change: change.generation)
        return {name: factor for change in due for name, factor in change.factors.items()}
