"""A task: what a motion has to achieve, and how to search for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from levade.costs import Criterion, clearance_of
from levade.engines import Physics, Settled
from levade.feedback import SensorErrors
from levade.scenes import Scene
from levade.tasks.demands import Demands
from levade.tasks.parts import Change, Cost, HorizonRange, PolicyChoice, RobotChoice, Search, Stage, StartChoice
from levade.tasks.regulation import Regulation
from levade.tasks.robust import Robust
from levade.tasks.validation import (
    check_asked_duration,
    check_costs,
    check_durations,
    check_feedback,
    check_free,
    check_good_enough,
    check_name,
    check_policy,
    check_search,
    check_stages,
    check_starts,
)


@dataclass(frozen=True)
class Task:
    """What a motion has to achieve, and how to search for it. `levade.tasks.load_task` reads it from a YAML file.

    Attributes:
        name: Name of the task, which also names the directory of its runs.
        horizon: T [s], or bounds between which the search finds it.
        costs: Name -> term and weight.
        success: Name -> criterion; a motion succeeds when all hold.
        description: What the motion does, in one line.
        robot: The robot, and its version.
        scene: The ground, and what stands on it.
        physics: Engine, time step and contact.
        start: Where the motion starts.
        hold: Time after T in which the reference stays at its last value [s].
        policy: How weights become joint references.
        stages: Stages of the search, in order. Each changes the weights of the task's costs; the last one should leave them
            as they are.
        search: Optimizer, budget and search distribution.
        robust: Perturbed models that candidates run on. None searches for a motion of the nominal model alone.
        feedback: Regulator that is on while candidates run on perturbed models. None runs them without feedback.
        hardware: Demands of a certificate: searches go on until a motion passes, as with ``levade solve --hardware``. None
            makes one search.
        good_enough: Name -> criterion that replaces one of ``success`` on perturbed models.

    Raises:
        LevadeError: If a value makes no sense, or two do not go together.
    """

    name: str
    horizon: float | HorizonRange
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
    feedback: Regulation | None = None
    hardware: Demands | None = None
    good_enough: Mapping[str, Criterion] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_name(self.name)
        check_durations(self.horizon, self.hold, self.physics.timestep)
        check_asked_duration(self.success, self.horizon, self.physics.timestep)
        check_policy(self.policy)
        check_costs(self.costs, self.success, self.hold)
        check_search(self.search, self.costs)
        check_stages(self.stages, self.costs, self.success, hold=self.hold, hold_steps=self.hold_steps)
        check_starts(self.robust, self.stages)
        check_free(self.robust, self.costs)
        check_good_enough(self.good_enough, self.success, self.hold, "good_enough")
        check_good_enough(self.robust.success or {} if self.robust else {}, self.success, self.hold, "robust.success")
        check_feedback(self.feedback, self.robust, self.horizon)

    def changed(self, change: Change) -> Task:
        """Make the same task with one more change of its weights.

        Args:
            change: The change. It replaces factors that an earlier change of the same generation gives to the same costs.

        Returns:
            The changed task.
        """
        before = {c.generation: c for c in self.search.changes}
        factors = before[change.generation].factors if change.generation in before else {}
        before[change.generation] = Change(change.generation, {**factors, **change.factors})
        changes = tuple(before[generation] for generation in sorted(before))
        return replace(self, search=replace(self.search, changes=changes))

    @property
    def on_others(self) -> Mapping[str, Criterion]:
        """Criteria that a motion has to meet on a perturbed model, by name."""
        if self.robust is not None and self.robust.success is not None:
            return self.robust.success
        return {**self.success, **self.good_enough}

    @property
    def sensors(self) -> SensorErrors:
        """Errors of the sensors that feedback measures with: those of the task's feedback, or usual ones."""
        return SensorErrors() if self.feedback is None else self.feedback.sensors

    @property
    def clearance(self) -> float | None:
        """Distance up to which two parts of the robot count as near [m]; None if no cost or criterion looks at it."""
        looking = [*(cost.term for cost in self.costs.values()), *self.success.values(), *self.on_others.values()]
        return clearance_of(looking)

    @property
    def self_force(self) -> bool:
        """Whether a cost looks at forces of the robot's parts on each other."""
        return any(getattr(cost.term, "self_force", False) for cost in self.costs.values())

    @property
    def usual_horizon(self) -> float:
        """T [s]; if it is free, the one with which a search begins."""
        return self.horizon.begin if isinstance(self.horizon, HorizonRange) else self.horizon

    @property
    def horizon_steps(self) -> int:
        """Rows up to the horizon; up to the longest one if the search finds it."""
        longest = self.horizon.maximum if isinstance(self.horizon, HorizonRange) else self.horizon
        return max(1, round(longest / self.physics.timestep))

    @property
    def hold_steps(self) -> int:
        """Rows of the hold, after the horizon."""
        return round(self.hold / self.physics.timestep)
