"""Return the numbers in a motion's figures and page: curves over time, goals, limits, the search, the policies.

series_data(motion, progress)      # JSON for the page; web/src/plots.js draws it
trunk_values(motion), goals(motion), read_progress(path), policy_names(motion, count)
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions import Motion, ReferenceCurve
from levade.motions.file import finite
from levade.policies import GaussianKernels
from levade.report.packing import pack
from levade.report.style import leg_places
from levade.rotations import roll_pitch_yaw

_TOUCHES = 1.0
"""Contact force from which a foot counts as on the ground [N]."""


@dataclass(frozen=True)
class Progress:
    """Holds a progress.csv: a row per generation.

    Attributes:
        stage: Names of the stages, shape (generations,).
        columns: Column -> values, shape (generations,).
    """

    stage: tuple[str, ...]
    columns: Mapping[str, Array]

    def __getitem__(self, name: str) -> Array:
        return self.columns[name]


def read_progress(path: str | Path) -> Progress:
    """Read a progress.csv.

    Args:
        path: The file.

    Returns:
        Its columns.

    Raises:
        LevadeError: If the file is missing, or is not the progress.csv of a search.
    """
    path = Path(path)
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        if not rows:
            raise ValueError("no generation")
        columns = {
            name: np.array([float(row[name] or "nan") for row in rows])
            for name in (
                "trials",
                "cost_best",
                "cost_generation_best",
                "cost_generation_median",
                "cost_generation_worst",
            )
        }
        return Progress(tuple(row["stage"] for row in rows), columns)
    except OSError as error:
        raise LevadeError(f"{path}: cannot be read ({error.strerror}); give the progress.csv of a solve") from None
    except (KeyError, ValueError, TypeError, csv.Error):
        raise LevadeError(f"{path}: is no progress.csv of a solve, or is damaged") from None


def series_data(motion: Motion, progress: Progress | None = None) -> dict[str, Any]:
    """Return all curves of a motion for web/src/plots.js, in SI units.

    Arrays over time are those of `levade.report.packing`.

    Args:
        motion: A motion.
        progress: Progress of the motion's search. None for no curve of the cost.

    Returns:
        JSON.
    """
    names, limits = motion.joint_names, motion.embodiment.limits
    bounds = {key: finite(getattr(limits, key)) for key in ("lower", "upper", "velocity", "torque")}
    position, orientation = trunk_values(motion)
    places = leg_places(motion.legs)
    force = motion["foot_contact_force"]
    return {
        "time": pack(motion["time"]),
        "horizon": motion.horizon,
        "end": motion.duration,
        "trunk": {"position": pack(position), "orientation": pack(orientation), "goals": _goal_rows(motion)},
        "legs": [
            {
                "name": leg.name,
                "colour": places[leg.name],
                "joints": [
                    {
                        "index": names.index(joint),
                        "name": joint,
                        "short": short(joint, leg.name),
                        **{key: values[names.index(joint)] for key, values in bounds.items()},
                    }
                    for joint in leg.joints
                ],
            }
            for leg in motion.legs
        ],
        "joints": {
            "reference": pack(motion["joint_position_reference"]),
            "position": pack(motion["joint_position"]),
            "velocity": pack(motion["joint_velocity"]),
            "torque": pack(motion["joint_torque"]),
        },
        "feet": {
            "vertical": pack(force[..., 2]),
            "horizontal": pack(np.hypot(force[..., 0], force[..., 1])),
            "touches": _TOUCHES,
        },
        "cost": None if progress is None else cost_data(progress, motion.result.trials_to_success),
        "policy": _policy_data(motion),
    }


def cost_data(progress: Progress, trials_to_success: int | None) -> dict[str, Any]:
    """Describe the search: a row per generation, null for a cost that is not finite, and where each stage begins.

    Args:
        progress: Progress of the search.
        trials_to_success: Number of trials up to the first success. None without a success.

    Returns:
        Costs, trials and stages, as JSON.
    """
    stages = [
        {"name": name, "start": float(progress["trials"][i - 1]) if i else 0.0}
        for i, name in enumerate(progress.stage)
        if i == 0 or name != progress.stage[i - 1]
    ]
    return {
        "trials": [int(count) for count in progress["trials"]],
        "best": _numbers(progress["cost_best"]),
        "low": _numbers(progress["cost_generation_best"]),
        "median": _numbers(progress["cost_generation_median"]),
        "high": _numbers(progress["cost_generation_worst"]),
        "stages": stages,
        "first_success": trials_to_success,
    }


def _numbers(values: Array) -> list[float | None]:
    return [float(value) if math.isfinite(value) else None for value in values]


def _policy_data(motion: Motion) -> dict[str, Any]:
    """Return the kernels over the horizon and, per policy, its weights at the kernels' means and their blend."""
    kernels, horizon = kernels_of(motion), motion.horizon
    weights = weights_of(motion, kernels)
    time = np.linspace(0.0, horizon, 201)
    phi, _ = kernels.basis(time, horizon)
    names = policy_names(motion, len(weights))
    return {
        "time": pack(time),
        "kernels": pack(phi),
        "means": pack(kernels.means * horizon),
        "policies": [
            {"name": name, "weights": pack(w), "angle": pack(phi @ w)} for name, w in zip(names, weights, strict=True)
        ],
    }


def kernels_of(motion: Motion) -> GaussianKernels:
    """Return the kernels of the motion's policy, or those of its task.

    Args:
        motion: The motion.

    Returns:
        The kernels.
    """
    if motion.policy is not None:
        return motion.policy.kernels
    choice = motion.task.policy
    return GaussianKernels(choice.kernels, choice.variance, choice.time)


def weights_of(motion: Motion, kernels: GaussianKernels) -> Array:
    """Return the weights by policy.

    A policy in Python has no rows, because its weights differ.

    Args:
        motion: The motion.
        kernels: Kernels of its policy.

    Returns:
        Weights [rad], shape (policies, kernels). Shape (0, kernels) if they do not fill whole rows.
    """
    weights = motion["weights"]
    whole = len(weights) % kernels.kernels == 0
    return weights.reshape(-1, kernels.kernels) if whole else np.empty((0, kernels.kernels))


QUANTITIES = (("x", "y", "height"), ("roll", "pitch", "yaw"))
"""Names of the columns of `trunk_values` in success criteria."""


def trunk_values(motion: Motion) -> tuple[Array, Array]:
    """Return the trunk's centre of mass and its angles.

    An angle that jumps by a turn is NaN.

    Args:
        motion: The motion.

    Returns:
        Position [m], and roll, pitch and yaw [rad], shape (steps, 3) each.
    """
    angles = roll_pitch_yaw(motion["trunk_quaternion"])
    angles[1:][np.abs(np.diff(angles, axis=0)) > math.pi] = np.nan
    return motion["trunk_com_position"], angles


def goals(motion: Motion) -> dict[str, list[tuple[float, float, float]]]:
    """Map each quantity to its goals at the horizon, at the end and in the hold.

    Args:
        motion: The motion.

    Returns:
        Quantity -> time [s], target and tolerance of each goal. The last two are in the unit of the quantity.
    """
    found: dict[str, list[tuple[float, float, float]]] = {}
    for criterion in motion.task.success.values():
        if criterion.target is not None and criterion.at in ("horizon", "end", "hold"):
            when = motion.horizon if criterion.at == "horizon" else motion.duration
            found.setdefault(criterion.quantity, []).append((when, criterion.target, criterion.tolerance or 0.0))
    return found


def _goal_rows(motion: Motion) -> list[dict[str, Any]]:
    wanted = goals(motion)
    return [
        {"what": what, "column": column, "time": when, "target": target, "tolerance": tolerance}
        for what, quantities in zip(("position", "orientation"), QUANTITIES, strict=True)
        for column, quantity in enumerate(quantities)
        for when, target, tolerance in wanted.get(quantity, [])
    ]


def short(joint: str, leg: str) -> str:
    """Shorten a joint's name: lf_haa of leg lf becomes HAA.

    Args:
        joint: Name of the joint.
        leg: Name of its leg.

    Returns:
        The name without that of the leg. It is in capitals if it has at most four characters.
    """
    rest = joint[len(leg) :].strip("_-") if joint.lower().startswith(leg.lower()) else joint
    rest = rest.removesuffix("_joint") or joint
    return rest.upper() if len(rest) <= 4 else rest


def policy_names(motion: Motion, count: int) -> list[str]:
    """Name each policy after the joints that it moves: "LF, RF HAA".

    Args:
        motion: A motion.
        count: Number of policies.

    Returns:
        The names.
    """
    policy = ReferenceCurve.of(motion).policy
    if policy is None or policy.independent_joints != count:
        return [f"policy {number + 1}" for number in range(count)]
    legs = {joint: leg.name for leg in motion.legs for joint in leg.joints}
    names = []
    for group in policy.groups:
        for k, leader in enumerate(group.leader):
            indices = sorted([leader, *(follower.joints[k] for follower in group.followers)])
            joints = [motion.joint_names[joint] for joint in indices]
            name = short(joints[0], legs[joints[0]])
            names.append(", ".join(legs[joint].upper() for joint in joints) + f" {name}")
    return names
