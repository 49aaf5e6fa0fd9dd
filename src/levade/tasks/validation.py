"""Check that the parts of a task fit together, with one clear line for each mistake.

Every function raises `LevadeError` with a message that begins with the wrong key of the task.
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
"""[s]: longest horizon and hold together."""


def looks_at_hold(term: object) -> bool:
    """Find out whether a term or criterion needs the rows after the horizon.

    A term that looks at the largest or smallest value of all rows does not need them: it uses the rows that there are.

    Args:
        term: A term, or a criterion.

    Returns:
        Whether it needs them.
    """
    return getattr(term, "at", "horizon") in ("end", "hold") or getattr(term, "over", "horizon") == "all"


def check_name(name: str) -> None:
    """Check that a task's name can name the directory of its runs.

    Args:
        name: The name.

    Raises:
        LevadeError: If it cannot.
    """
    if not name.strip(". ") or "/" in name or "\\" in name or not name.isprintable():
        raise LevadeError(f"name: {name!r} should be a word or two that can name a directory, such as my-task")


def check_durations(horizon: float | HorizonRange, hold: float, timestep: float) -> None:
    """Check the durations of a task.

    Args:
        horizon: T [s], or bounds of it.
        hold: Time after T [s].
        timestep: Time step of the physics [s].

    Raises:
        LevadeError: If one is not positive or too long.
    """
    if isinstance(horizon, HorizonRange):
        check_durations(horizon.minimum, hold, timestep)
        horizon = horizon.maximum
    if not (math.isfinite(horizon) and horizon >= timestep):
        raise LevadeError(f"horizon: {horizon} s should be at least one time step ({timestep} s); 0.3 to 3 s is usual")
    if not (math.isfinite(hold) and hold >= 0):
        raise LevadeError(f"hold: {hold} s should be 0 or more")
    if horizon + hold > LONGEST:
        raise LevadeError(f"horizon: {horizon} s and hold {hold} s are together more than {LONGEST:g} s")


def check_asked_duration(success: Mapping[str, Criterion], horizon: float | HorizonRange, timestep: float) -> None:
    """Check that a duration that criteria ask for is possible.

    Args:
        success: Name -> criterion.
        horizon: T [s], or bounds of it.
        timestep: Time step of the physics, to which T is rounded [s].

    Raises:
        LevadeError: If no T meets a criterion.
    """
    least, most = (horizon.minimum, horizon.maximum) if isinstance(horizon, HorizonRange) else (horizon, horizon)
    for name, one in success.items():
        if one.quantity != "duration":
            continue
        low, high = one.minimum, one.maximum
        if one.target is not None:
            low, high = one.target - (one.tolerance or 0.0), one.target + (one.tolerance or 0.0)
        if (low is not None and low > most + timestep) or (high is not None and high < least - timestep):
            asked = " and ".join(
                f"{what} {value:g} s" for what, value in (("at least", low), ("at most", high)) if value is not None
            )
            there = horizon if isinstance(horizon, HorizonRange) else f"{horizon:g} s"
            raise LevadeError(
                f"success.{name}: asks for a duration of {asked}, but horizon is {there}; change one of them"
            )


def check_policy(policy: PolicyChoice) -> None:
    """Check the parts of a policy that do not depend on the robot.

    Args:
        policy: The task's policy.

    Raises:
        LevadeError: If a value is out of range, or two do not go together.
    """
    if policy.goal_is_free and policy.settle == 0:
        raise LevadeError(
            "policy.goal: is free, but no reference settles there; set policy.settle to a share of the horizon, such as 0.3"
        )
    if policy.through and policy.initial != "interpolate":
        raise LevadeError(
            f"policy.through: initial: {policy.initial} does not use these postures; set policy.initial to interpolate"
        )
    if not 1 <= policy.kernels <= 1000:
        raise LevadeError(f"policy.kernels: {policy.kernels} should be 1 to 1000; the paper has 16")
    if policy.room is not None and not (math.isfinite(policy.room) and policy.room >= 0):
        raise LevadeError(f"policy.room: {policy.room} rad should be 0 or more; 0.05 is usual")
    if policy.slew is not None and not (math.isfinite(policy.slew) and policy.slew > 0):
        raise LevadeError(f"policy.slew: {policy.slew} should be a share of speed limits above 0; 0.9 is usual")


def check_costs(costs: Mapping[str, Cost], success: Mapping[str, Criterion], hold: float) -> None:
    """Check the costs and criteria of a task, each by itself.

    Args:
        costs: Name -> term and weight.
        success: Name -> criterion.
        hold: Time after the horizon [s].

    Raises:
        LevadeError: If there are no costs, a weight is not finite, or one looks at a hold that the task does not have.
    """
    if not costs:
        raise LevadeError("costs: there are none; give at least one, such as costs: {effort: {weight: 1}}")
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
    """Check the stages of a task, and that every cost counts in one of them.

    Args:
        stages: The stages, in order.
        costs: Name -> term and weight.
        success: Name -> criterion.
        hold: Time after the horizon [s].
        hold_steps: Time steps of the hold.

    Raises:
        LevadeError: If a stage does not fit the task's costs, criteria or hold, or a cost counts nowhere.
    """
    if not stages:
        raise LevadeError("stages: there are none; leave the key out for a single one")
    for i, stage in enumerate(stages):
        where = f"stages.{i}"
        _check_names(where, stage, costs, success)
        if stage.trials is not None and stage.trials < 1:
            raise LevadeError(
                f"{where}.trials: {stage.trials} should be at least 1; leave it out to use all that is left"
            )
        if not 0 <= stage.hold <= max(hold, 1):
            raise LevadeError(f"{where}.hold: {stage.hold} should be true, false, or at most the task's {hold} s")
        if hold_steps and not stage.hold and all(looks_at_hold(cost.term) for cost in costs.values()):
            raise LevadeError(
                f"{where}.hold: {stage.hold}, but every cost of the task looks at the hold; set hold: true"
            )
        if not (math.isfinite(stage.step) and stage.step > 0):
            raise LevadeError(f"{where}.step: {stage.step} should be a positive factor on the step size")
    if hold_steps and not any(stage.hold for stage in stages):
        for name, cost in costs.items():
            if looks_at_hold(cost.term):
                raise LevadeError(
                    f"costs.{name}: looks at the hold, which no stage simulates, so it counts nowhere; let it look at"
                    " the horizon (at: horizon or over: horizon), or set the hold of a stage to true or a number of seconds"
                )


def check_starts(robust: Robust | None, stages: Sequence[Stage]) -> None:
    """Check that a task with several starts has stages with and without perturbed models.

    Args:
        robust: How candidates run on perturbed models; None if they do not.
        stages: The stages, in order.

    Raises:
        LevadeError: If it lacks one kind.
    """
    if robust is None or robust.starts == 1:
        return
    kinds = [stage.robust for stage in stages]
    if kinds[0] or not any(kinds):
        missing = "the first stage is not robust: false" if kinds[0] else "no stage is robust"
        raise LevadeError(
            f"robust.starts: {robust.starts} motions of the nominal model to start from, but {missing}; give"
            " stages of both kinds, or leave starts out"
        )


def check_free(robust: Robust | None, costs: Mapping[str, Cost]) -> None:
    """Check that the costs from which perturbed models are free are costs of the task.

    Args:
        robust: How candidates run on perturbed models; None if they do not.
        costs: Name -> term and weight.

    Raises:
        LevadeError: If one is not, or none is left.
    """
    free = () if robust is None else robust.free
    for name in free:
        if name not in costs:
            raise LevadeError(f"robust.free: no {name!r} in this task; {did_you_mean(name, costs)}")
    if free and not costs.keys() - set(free):
        raise LevadeError("robust.free: has every cost, so perturbed models would have none; leave one out")


def check_good_enough(
    good_enough: Mapping[str, Criterion], success: Mapping[str, Criterion], hold: float, where: str
) -> None:
    """Check that the criteria for perturbed models are criteria of the task.

    Args:
        good_enough: Name -> criterion for perturbed models.
        success: Name -> criterion of the task.
        hold: Time after the horizon [s].
        where: Key of the criteria, for messages.

    Raises:
        LevadeError: If one is not.
    """
    for name, criterion in good_enough.items():
        if name not in success:
            hint = did_you_mean(name, success) if success else "the task has none"
            raise LevadeError(f"{where}.{name}: is not a criterion of the task; {hint}")
        _check_hold(f"{where}.{name}", criterion, hold)


def check_feedback(feedback: Regulation | None, robust: Robust | None, horizon: float | HorizonRange) -> None:
    """Check that feedback has perturbed models to correct, and one horizon.

    Args:
        feedback: The regulator; None for none.
        robust: How candidates run on perturbed models; None if they do not.
        horizon: T [s], or bounds of it.

    Raises:
        LevadeError: If it has not.
    """
    if feedback is None:
        return
    if robust is None:
        raise LevadeError(
            "feedback: acts on perturbed models, but the task has none; add robust, such as robust: {samples: 8}"
        )
    if isinstance(horizon, HorizonRange):
        raise LevadeError(
            f"feedback: needs one horizon for its gains, but the task has {horizon}; give a number, such as the"
            " duration of a motion that a search without feedback found"
        )


def check_search(search: Search, costs: Mapping[str, Cost]) -> None:
    """Check the search settings of a task.

    Args:
        search: The settings.
        costs: Name -> term and weight.

    Raises:
        LevadeError: If a value is out of range, or two do not go together.
    """
    if isinstance(search.optimizer, str):
        _check_optimizer(search.optimizer, search.settings)
    elif not can_restart(search.optimizer) and search.restart is not None:
        raise LevadeError(
            "search.restart: an optimizer object cannot restart; give its class or a function that makes it, or leave"
            " restart out"
        )
    if search.trials < 1:
        raise LevadeError(f"search.trials: {search.trials} should be at least 1; the paper has about 3000")
    if search.sketches < 0:
        raise LevadeError(f"search.sketches: {search.sketches} should be 0 for none, or more; 120 is usual")
    if search.population is not None and not 4 <= search.population <= 100_000:
        raise LevadeError(f"search.population: {search.population} should be 4 or more; leave it out for the usual one")
    if not (math.isfinite(search.step) and search.step > 0):
        raise LevadeError(f"search.step: {search.step} should be a positive number of rad; 0.05 to 0.3 is usual")
    if not (math.isfinite(search.smoothness) and search.smoothness >= 0):
        raise LevadeError(f"search.smoothness: {search.smoothness} should be 0 or more, as a share of the horizon")
    _check_restart(search)
    if search.polish is not None and search.polish < 0:
        raise LevadeError(f"search.polish: {search.polish} should be 0 or more trials")
    for i, change in enumerate(search.changes):
        _check_change(f"search.changes.{i}", change, costs)


def _check_restart(search: Search) -> None:
    if search.patience is not None and search.patience < 1:
        raise LevadeError(
            f"search.patience: {search.patience} should be at least 1; leave it out to restart in any case"
        )
    if search.patience is not None and search.restart is None:
        raise LevadeError("search.patience: only works with a restart; set search.restart, too")
    if search.restart is not None and search.restart < 1:
        raise LevadeError(f"search.restart: {search.restart} should be at least 1; leave it out to go on")


def _check_optimizer(name: str, given: Mapping[str, float]) -> None:
    if name not in OPTIMIZERS:
        raise LevadeError(f"search.optimizer: no optimizer {name!r}; {did_you_mean(name, OPTIMIZERS)}")
    own = [setting for setting in settings(name) if setting != "step_adaptation"]
    for setting in given:
        if setting not in own:
            hint = did_you_mean(setting, own) if own else "it takes none"
            raise LevadeError(f"search.settings: no {setting!r} for {name}; {hint}")


def _check_names(where: str, stage: Stage, costs: Mapping[str, Cost], success: Mapping[str, Criterion]) -> None:
    """Check that a stage names costs and criteria of the task."""
    valid: Mapping[str, object]
    for key, valid in (("weights", costs), ("promote", success)):
        for name, value in getattr(stage, key).items():
            if name not in valid:
                raise LevadeError(f"{where}.{key}: no {name!r} in this task; {did_you_mean(name, valid)}")
            if not math.isfinite(value):
                raise LevadeError(f"{where}.{key}.{name}: {value} is not a number")


def _check_hold(where: str, term: object, hold: float) -> None:
    if getattr(term, "at", None) == "hold" and hold == 0:
        raise LevadeError(f"{where}.at: hold, but the task has no hold; give it one (hold: 2.0) or set at: horizon")


def _check_change(where: str, change: Change, costs: Mapping[str, Cost]) -> None:
    if change.generation < 1:
        raise LevadeError(f"{where}.generation: {change.generation} should be 1 or more; the first one is 1")
    for name, factor in change.factors.items():
        if name not in costs:
            raise LevadeError(f"{where}.factors: no {name!r} in this task; {did_you_mean(name, costs)}")
        if not (math.isfinite(factor) and factor >= 0):
            raise LevadeError(f"{where}.factors.{name}: {factor} should be a factor on the weight, 0 or more")
