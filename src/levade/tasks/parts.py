"""The parts of a task: robot, start, horizon, policy, costs, stages and search settings."""

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
    """Which robot the task is for, and in which version: see `levade.robots.load_robot`.

    Attributes:
        name: Name of a robot, or path of its file.
        actuation: Actuation of the joints. Defaults to the robot's own.
        variant: Variant of the robot. Defaults to the robot's own.
        linkage: Whether linkages limit the torque of the joints that they drive.
        kp: Proportional gain of the joints [Nm/rad]. Defaults to the robot's own.
        kd: Derivative gain of the joints [Nm s/rad]. Defaults to the robot's own.
    """

    name: str = "hyq2max"
    actuation: str | None = None
    variant: str | None = None
    linkage: bool = False
    kp: float | None = None
    kd: float | None = None

    def load(self) -> Robot:
        """Load the robot.

        Returns:
            The robot.

        Raises:
            LevadeError: If there is no such robot, version or gain.
        """
        options = asdict(self)
        return load_robot(options.pop("name"), **options)


@dataclass(frozen=True)
class StartChoice:
    """Where the motion starts: exactly one of the four.

    Attributes:
        settled: The robot stands, settled in a posture.
        fall: The robot lies as one fall, simulated first, left it.
        fallen: The robot lies as any of a family of falls left it.
        state: The robot is in a given state.

    Raises:
        LevadeError: If none or several are given.
    """

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
        """The one that is given."""
        return next(one for one in self._all if one is not None)


@dataclass(frozen=True)
class HorizonRange:
    """A horizon T that the search chooses, for each trial separately.

    Attributes:
        minimum: Lower bound of T [s].
        maximum: Upper bound of T [s].
        initial: T with which the search begins [s]. Defaults to the geometric mean of the bounds, because the search uses the
            logarithm of T.

    Raises:
        LevadeError: If a value is not positive, or they are out of order.
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
        return f"{self.minimum:.3g} to {self.maximum:.3g} s"

    @property
    def begin(self) -> float:
        """T with which the search begins [s]."""
        return math.sqrt(self.minimum * self.maximum) if self.initial is None else self.initial


@dataclass(frozen=True)
class PolicyChoice:
    """How weights become joint references (eq. 3-4).

    Attributes:
        kernels: M, the number of kernels: see `levade.policies.GaussianKernels`.
        variance: Variance of the kernels, the paper's sigma^2, in the unit that ``time`` gives.
        time: Time that the variance is measured in: "normalised" to the horizon, or "seconds".
        groups: Which legs share a policy, mirrored: "pairs" (front and hind, as in the paper's rearing), "sides" (left and
            right), "all" (one for all legs), "independent" (one for each leg, as in the paper's recovery), or lists of leg
            names.
        initial: First mean of the search: "hold" the last commanded posture, or "interpolate" in a straight line from the
            joint angles at the start to the posture ``goal``, by way of the postures in ``through``.
        goal: Final posture, as in `levade.engines.Settled`; or "free": the search finds it, within the joints' ranges. Limbs
            may be free (``{hind: free}``), and joints, within the two angles of a range (``{"*_kfe": [-2.0, -1.0]}`` or
            ``{hind knee: [1.0, 2.0]}``). The other joints take the neutral posture. A free goal needs ``settle``.
        through: Postures that ``interpolate`` passes, at equal distances in time between the start and the goal.
        depart: Share of the horizon in which every reference leaves the last commanded posture; 0 leaves the start to the
            weights. See `levade.policies.Ends`.
        settle: Share of the horizon in which every reference moves to the goal; 0 leaves the end to the weights. See
            `levade.policies.Ends`.
        room: Least distance of references from the ends of the joints' ranges [rad], at most a quarter of a range.
            References that would come nearer rest there, as with a drive that clamps them. None sets no bound.
        slew: Share of the joints' speed limits that references keep to. References that would move faster begin earlier: see
            `levade.policies.Slew`. None sets no bound.
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
        """Whether the search finds part of the final posture."""
        values = [self.goal] if isinstance(self.goal, str) else self.goal.values()
        return any(value == FREE or isinstance(value, tuple) for value in values)


FREE = "free"
"""Value of ``goal`` for a posture that the search finds."""


@dataclass(frozen=True, eq=False)
class Cost:
    """A term and its weight, the paper's Q_i.

    Attributes:
        term: The term: a number for each trial, unweighted.
        weight: Factor on the term's number.
    """

    term: Term
    weight: float

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Cost) and (self.term, self.weight) == (other.term, other.weight)


@dataclass(frozen=True)
class Stage:
    """A part of the search with a cost of its own.

    Attributes:
        name: Name of the stage.
        trials: Budget of the stage. Defaults to what is left. The last stage takes it only with several `Robust.starts`:
            after this many trials without a success, the search looks for another set of starts while the budget lasts.
        promote: Criterion -> tolerance: the stage ends when one trial is within all of them.
        weights: Cost -> weight, instead of the task's.
        hold: Simulated part of the hold: all (true), none (false), or the first seconds. With less than all, only trials that
            meet every criterion so far are simulated through the rest, to see whether they succeed. With none, costs that
            look at the hold are left out.
        step: Factor on the optimizer's step size when the stage begins; the rest of the search distribution is kept.
        robust: Whether candidates also run on perturbed models, if the task asks for that. In a stage without them, no
            candidate of such a task counts as a success.
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
    """A change of the costs' weights during a search, as the sliders of ``levade solve --watch`` make it.

    Attributes:
        generation: First generation that the factors apply to, counted from 1.
        factors: Cost -> factor on its weight, in the task and in its stages, until another change names the cost; 1 restores
            the task's weight.
    """

    generation: int
    factors: Mapping[str, float]


@dataclass(frozen=True)
class Search:
    """How to search: optimizer, budget and search distribution.

    Attributes:
        optimizer: Name of the optimizer; an alias becomes the name. In Python also a class, function or object: see
            `levade.optimizers`.
        trials: Budget of all stages together.
        sketches: Number of motions that each attempt tries first, before the optimizer begins around the best of them. Each
            goes through three random postures, with angles from the whole of the joints' ranges; on robots that stand
            upright only of the joints that bend them forward and back. For motions far from the posture at the start, such
            as a get-up.
        population: Trials per generation. Defaults to the optimizer's own.
        step: Initial standard deviation of the weights [rad].
        smoothness: Correlation length of neighbouring weights in the initial covariance, as a share of the horizon; 0 for
            none, as in plain CMA-ES.
        modes: Number of the smoothest directions of each joint's weights that the search uses. Defaults to all.
        step_adaptation: Rule that adapts the step size: see `levade.optimizers.CMAES`.
        restart: Trials without a success after which the search starts again, from the first stage, with other random
            numbers: a search that commits to the wrong side rarely recovers. Robust stages do not restart. None goes on to
            the end of the budget.
        patience: With restart, an attempt goes on if its best cost fell by a tenth over this many trials. None restarts it
            in any case.
        polish: Trials after the first success, to lower the cost. None goes on to the end of the budget.
        settings: Numbers that only this optimizer takes, such as {elite: 0.2}: see its class in `levade.optimizers`.
        changes: Changes of the costs' weights during the search.
    """

    optimizer: OptimizerChoice = "cma-aimed"
    trials: int = 3000
    sketches: int = 0
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
        # a search has one form, whichever alias names its optimizer
        object.__setattr__(self, "optimizer", canonical(self.optimizer))

    def factors(self, generation: int) -> dict[str, float]:
        """Find the factors that apply in a generation.

        Args:
            generation: The generation, counted from 1.

        Returns:
            Cost -> factor on its weight. Costs that nothing has changed are left out.
        """
        due = sorted((c for c in self.changes if c.generation <= generation), key=lambda change: change.generation)
        return {name: factor for change in due for name, factor in change.factors.items()}
