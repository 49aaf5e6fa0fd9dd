"""Summarise a motion for the page: verdict, criteria, peaks against limits, cost terms, and provenance.

summary_data(motion)        # JSON; web/src/summary.js draws it
provenance_data(motion)     # JSON; with the command that gives the same motion again
"""

from __future__ import annotations

import math
import shlex
from collections.abc import Iterator
from typing import Any

import numpy as np

from levade.costs import Criterion
from levade.costs.quantities import CIRCULAR, unit_of
from levade.motions import Motion
from levade.tasks import is_unchanged, task_to_yaml

WHEN = {
    "horizon": "At the horizon T",
    "end": "At the end",
    "max": "Largest of the whole motion",
    "min": "Smallest of the whole motion",
    "hold": "At the worst instant of the hold",
}


def summary_data(motion: Motion) -> dict[str, Any]:
    """Describe goal and result, peaks against limits, and cost terms, in SI units; null if there is no number.

    Args:
        motion: The motion.

    Returns:
        The summary, as JSON.
    """
    result = motion.result
    criteria = [
        _criterion(name, one, result.errors[name], result.values.get(name)) for name, one in motion.task.success.items()
    ]
    terms = [
        {"name": name, "value": value, "weight": result.cost_weights[name]} for name, value in result.cost_terms.items()
    ]
    return {
        "success": result.success,
        "verdict": _verdict(motion, criteria),
        "criteria": criteria,
        "peaks": list(_peaks(motion)),
        "cost": result.cost,
        "terms": [term | {"weighted": term["weight"] * term["value"]} for term in terms],
        "trials": result.trials,
        "trials_to_success": result.trials_to_success,
    }


def _criterion(name: str, criterion: Criterion, error: float, value: float | None) -> dict[str, Any]:
    target, low, high = criterion.target, criterion.minimum, criterion.maximum
    tolerance = criterion.tolerance or 0.0
    result = criterion.value_of(error)
    if target is None and value is not None:
        result = value
    elif target is not None and criterion.quantity in CIRCULAR:
        result = math.remainder(target + error, 2 * math.pi)
    return {
        "name": name,
        "quantity": criterion.quantity,
        "when": WHEN[criterion.at],
        "unit": unit_of(criterion.quantity),
        "target": target,
        "minimum": low,
        "maximum": high,
        "tolerance": tolerance,
        "result": result,
        "error": error,
        "met": abs(error) <= tolerance,
    }


def _verdict(motion: Motion, criteria: list[dict[str, Any]]) -> str:
    missed = sum(not criterion["met"] for criterion in criteria)
    if motion.result.diverged:
        return "the simulation diverged"
    if not criteria:
        return "nothing was required"
    if motion.met_on_the_model_only:
        return "met on the model, but not on enough robots that differ from it"
    if not missed:
        return "every criterion met" if len(criteria) > 1 else "its criterion met"
    return f"{missed} of {len(criteria)} criteria missed" if len(criteria) > 1 else "its criterion missed"


def _peaks(motion: Motion) -> Iterator[dict[str, Any]]:
    """Yield the joint with the least slack, or the largest excess, in torque, speed and range."""
    limits, names = motion.embodiment.limits, motion.joint_names
    for what, unit, array, bounds in (
        ("torque", "Nm", "joint_torque", limits.torque),
        ("speed", "rad/s", "joint_velocity", limits.velocity),
    ):
        peak = np.abs(motion[array]).max(axis=0)
        joint = int(np.argmax(peak / bounds)) if np.isfinite(bounds).any() else int(np.argmax(peak))
        bounded = math.isfinite(bounds[joint])
        yield {
            "what": f"joint {what}",
            "joint": names[joint],
            "unit": unit,
            "value": float(peak[joint]),
            "limit": float(bounds[joint]) if bounded else None,
            "share": float(peak[joint] / bounds[joint]) if bounded else None,
        }
    lower, upper = limits.lower, limits.upper
    with np.errstate(invalid="ignore"):
        share = np.abs(motion["joint_position"] - (lower + upper) / 2) / ((upper - lower) / 2)
    if np.isnan(share).all():  # no joint has a range, or the simulation broke down at once
        return
    row, joint = np.unravel_index(np.nanargmax(share), share.shape)
    yield {
        "what": "joint angle",
        "joint": names[joint],
        "unit": "rad",
        "value": float(motion["joint_position"][row, joint]),
        "limit": [float(lower[joint]), float(upper[joint])],
        "share": float(share[row, joint]),
    }


def provenance_data(motion: Motion) -> dict[str, Any]:
    """Describe where a motion comes from: task, robot, seed, versions, and the command that gives it again.

    ``task_yaml`` is the task with every default filled in. ``command`` is as typed in a shell. If the task differs from the
    built-in one of its name, it names a task.yaml, which is ``task_yaml``.

    Args:
        motion: The motion.

    Returns:
        The description, as JSON.
    """
    task, result, origin = motion.task, motion.result, motion.provenance
    name = task.name
    known = is_unchanged(task)
    return {
        "task": name,
        "description": task.description,
        "robot": motion.robot,
        "seed": origin.seed,
        "timestep": motion.timestep,
        "horizon": motion.horizon,
        "hold": motion.hold,
        "engine": origin.engine,
        "versions": origin.versions,
        "trials": result.trials,
        "trials_to_success": result.trials_to_success,
        "stopped": result.stopped,
        "command": shlex.join(["levade", "solve", name if known else "task.yaml", "--seed", str(origin.seed)])
        + " --from MOTION" * origin.initial,
        "builtin": known,
        "task_yaml": task_to_yaml(task, code=True),
    }
