"""Whether the parts of a task make sense together: one clear line for each mistake.

Every function raises LevadeError that begins with the key of the task which is wrong.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from levade.costs import Criterion
from levade.errors import LevadeError, did_you_mean
from levade.optimizers import OPTIMIZERS, can_restart, settings
from levade.tasks.parts import Change, Cost, HorizonRange, PolicyChoice, Search, Stage
from levade.tasks.regulation import Regulation
from levade.tasks.robust import Robust

LONGEST = 120.0
"""[s], of horizon and hold together."""


def looks_at_hold(term: object) -> bool:
    """Whether a term or criterion needs the rows after the horizon. One that looks at the largest or smallest value of
    all takes what there is.
    """
    return getattr(term, "at", "horizon") in ("end", "hold") or getattr(term, "over", "horizon") == "all"


def check_name(name: str) -> None:
    """A task's name names the directory of its runs."""
    if not name.strip(". ") or "/" in name or "\\" in name or not name.isprintable():
        raise LevadeError(f"name: {name!r} should be a word or two that can name a directory")


def check_durations(horizon: float | HorizonRange, hold: float, timestep: float) -> None:
    """Horizon, hold and time step [s]."""
    if isinstance(horizon, HorizonRange):
        check_durations(horizon.minimum, hold, timestep)
        horizon = horizon.maximum
    if not (math.isfinite(horizon) and horizon >= timestep):
        raise LevadeError(f"horizon: {horizon} s should be at least one time step ({timestep} s); 0.3 to 3 s is usual")
    if not (math.isfinite(hold) and hold >= 0):
        raise LevadeError(f"hold: {hold} s should be 0 or more")
    if horizon + hold > LONGEST:
        raise LevadeError(f"horizon: {horizon} s and hold {hold} s are together more than {LONGEST:g} s")


def check_policy(policy: PolicyChoice) -> None:
    """What no robot decides."""
    if policy.goal_is_free and policy.settle == 0:
        raise LevadeError(
            "policy.goal: it is free, but no reference settles there; give policy.settle a share of the horizon, such as 0.3"
        )
    if policy.through and policy.initial != "interpolate":
        raise LevadeError(
            f"policy.through: the search begins with initial: {policy.initial}, which goes through no posture; say"
            " initial: interpolate"
        )
    if not 1 <= policy.kernels <= 1000:
        raise LevadeError(f"policy.kernels: {policy.kernels} should be 1 to 1000; the paper has 16")
    if policy.room is not None and not (math.isfinite(policy.room) and policy.room >= 0):
        raise LevadeError(f"policy.room: {policy.room} rad should be 0 or more; 0.05 is usual")
    if policy.slew is not None and not (math.isfinite(policy.slew) and policy.slew > 0):
        raise LevadeError(f"policy.slew: {policy.slew} should be a share of speed limits above 0; 0.9 is usual")


def check_costs(costs: Mapping[str, Cost], success: Mapping[str, Criterion], hold: float) -> None:
    """Costs and criteria, each by itself."""
    if not costs:
        raise LevadeError("costs: there are none; at least one term says what to look for")
    for name, cost in costs.items():
        if not math.isfinite(cost.weight):
            raise LevadeError(f"costs.{name}.weight: {cost.weight} is not a number")
        _check_hold(f"costs.{name}", cost.term, hold)
    for name, criterion in success.items():
        _check_hold(f"success.{name}", criterion, hold)


def check_stages(
    stages: Sequence[Stage],
    costs: Mapping[str, Cost],
    success: Mapping[str, Criterion],
    *,
    hold: float,
    hold_steps: int,
) -> None:
    """Stages, each against the task's costs, criteria and hold; and that every cost counts in one of them."""
    if not stages:
        raise LevadeError("stages: there are none; leave the key out for a single one")
    for i, stage in enumerate(stages):
        where = f"stages.{i}"
        _check_names(where, stage, costs, success)
        if stage.trials is not None and stage.trials < 1:
            raise LevadeError(f"{where}.trials: {stage.trials} should be at least 1; leave it out for all that is left")
        if not 0 <= stage.hold <= max(hold, 1):
            raise LevadeError(f"{where}.hold: {stage.hold} should be true, false, or at most the task's {hold} s")
        if hold_steps and not stage.hold and all(looks_at_hold(cost.term) for cost in costs.values()):
            raise LevadeError(
                f"{where}.hold: {stage.hold}, but every cost of the task looks at the hold; say hold: true"
            )
        if not (math.isfinite(stage.step) and stage.step > 0):
            raise LevadeError(f"{where}.step: {stage.step} should be a positive factor on the step size")
    if hold_steps and not any(stage.hold for stage in stages):
        for name, cost in costs.items():
            if looks_at_hold(cost.term):
                raise LevadeError(
                    f"costs.{name}: looks at the hold, which no stage simulates, and so counts nowhere; let it look at"
                    " the horizon (at: horizon or over: horizon), or give a stage hold: true or a number of seconds"
                )


def check_starts(robust: Robust | None, stages: Sequence[Stage]) -> None:
    """Several motions to start robust stages from need stages of both kinds."""
    if robust is None or robust.starts == 1:
        return
    kinds = [stage.robust for stage in stages]
    if kinds[0] or not any(kinds):
        missing = "the first stage is not robust: false" if kinds[0] else "no stage is robust"
        raise LevadeError(
            f"robust.starts: {robust.starts} motions of the nominal model to start from, but {missing}; give"
            " stages of both kinds, or leave starts out"
        )


def check_good_enough(robust: Robust | None, success: Mapping[str, Criterion], hold: float) -> None:
    """What is good enough on perturbed models are criteria of the task."""
    for name, criterion in ({} if robust is None else robust.success or {}).items():
        if name not in success:
            hint = did_you_mean(name, success) if success else "the task has none"
            raise LevadeError(f"robust.success.{name}: is no criterion of the task; {hint}")
        _check_hold(f"robust.success.{name}", criterion, hold)


def check_feedback(feedback: Regulation | None, robust: Robust | None, horizon: float | HorizonRange) -> None:
    """Feedback needs something to correct."""
    if feedback is None:
        return
    if robust is None:
        raise LevadeError(
            "feedback: is on while candidates run on perturbed models, and the task has none; give robust, such as"
            " robust: {samples: 8}"
        )
    if isinstance(horizon, HorizonRange):
        raise LevadeError(
            f"feedback: its gains are made for one duration, and the horizon is {horizon}; give a number, such as the"
            " duration of a motion that a search without feedback found"
        )


def check_search(search: Search, costs: Mapping[str, Cost]) -> None:
    """How to look."""
    if isinstance(search.optimizer, str):
        _check_optimizer(search.optimizer, search.settings)
    elif not can_restart(search.optimizer) and search.restart is not None:
        raise LevadeError(
            "search.restart: a ready optimizer cannot be made again for another attempt; give a class or function, or no"
            " restart"
        )
    if search.trials < 1:
        raise LevadeError(f"search.trials: {search.trials} should be at least 1; the paper has about 3000")
    if search.population is not None and not 4 <= search.population <= 100_000:
        raise LevadeError(f"search.population: {search.population} should be 4 or more; leave it out for the usual one")
    if not (math.isfinite(search.step) and search.step > 0):
        raise LevadeError(f"search.step: {search.step} should be a positive number of rad; 0.05 to 0.3 is usual")
    if not (math.isfinite(search.smoothness) and search.smoothness >= 0):
        raise LevadeError(f"search.smoothness: {search.smoothness} should be 0 or more, as a share of the horizon")
    if search.patience is not None and search.patience < 1:
        raise LevadeError(
            f"search.patience: {search.patience} should be at least 1; leave it out to restart in any case"
        )
    if search.patience is not None and search.restart is None:
        raise LevadeError("search.patience: counts where there is a restart; give search.restart, too")
    if search.restart is not None and search.restart < 1:
        raise LevadeError(f"search.restart: {search.restart} should be at least 1; leave it out to go on")
    if search.polish is not None and search.polish < 0:
        raise LevadeError(f"search.polish: {search.polish} should be 0 or more trials")
    for i, change in enumerate(search.changes):
        _check_change(f"search.changes.{i}", change, costs)


def _check_optimizer(name: str, given: Mapping[str, float]) -> None:
    if name not in OPTIMIZERS:
        raise LevadeError(f"search.optimizer: no optimizer {name!r}; {did_you_mean(name, OPTIMIZERS)}")
    own = [setting for setting in settings(name) if setting != "step_adaptation"]
    for setting in given:
        if setting not in own:
            hint = did_you_mean(setting, own) if own else "it takes none"
            raise LevadeError(f"search.settings: no {setting!r} for {name}; {hint}")


def _check_names(where: str, stage: Stage, costs: Mapping[str, Cost], success: Mapping[str, Criterion]) -> None:
    """What a stage weighs and promotes is in the task."""
    valid: Mapping[str, object]
    for key, valid in (("weights", costs), ("promote", success)):
        for name, value in getattr(stage, key).items():
            if name not in valid:
                raise LevadeError(f"{where}.{key}: no {name!r} in this task; {did_you_mean(name, valid)}")
            if not math.isfinite(value):
                raise LevadeError(f"{where}.{key}.{name}: {value} is not a number")


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
