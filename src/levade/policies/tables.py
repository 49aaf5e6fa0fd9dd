"""Write a policy as plain tables, which a file can hold, and read it again.

content = policy_to_dict(policy)        # JSON
policy = policy_from_dict(content)      # the same policy, to the bit
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies.ends import Ends
from levade.policies.groups import Follower, Group
from levade.policies.kernels import GaussianKernels
from levade.policies.policy import Policy
from levade.policies.slew import Slew


def policy_to_dict(policy: Policy) -> dict[str, Any]:
    """Write a policy as plain tables.

    Args:
        policy: The policy.

    Returns:
        Tables that JSON can hold, with times in s and angles in rad. ``groups`` has joint indices and mirror signs; ``ends``
        is None if the weights decide where a reference starts and ends.
    """
    ends = policy.ends
    return {
        "kernels": policy.kernels.kernels,
        "variance": policy.kernels.variance,
        "time": policy.kernels.time,
        "groups": [
            {
                "leader": list(group.leader),
                "followers": [
                    {"joints": list(follower.joints), "signs": list(follower.signs)} for follower in group.followers
                ],
            }
            for group in policy.groups
        ],
        "horizon": policy.horizon,
        "timestep": policy.timestep,
        "hold_steps": policy.hold_steps,
        "ends": None
        if ends is None
        else {
            "start": np.asarray(ends.start).tolist(),
            "goal": np.asarray(ends.goal).tolist(),
            "depart": ends.depart,
            "settle": ends.settle,
        },
        "within": None if policy.within is None else [[_finite(end) for end in ends] for ends in policy.within],
        "slew": None
        if policy.slew is None
        else {"speed": [_finite(speed) for speed in policy.slew.speed], "start": list(policy.slew.start)},
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _within(ends: Any) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """Read the ends of ranges; null stands for a joint without a range."""
    if ends is None:
        return None
    lower, upper = (
        tuple(without if end is None else float(end) for end in side)
        for side, without in zip(ends, (-math.inf, math.inf), strict=True)
    )
    return lower, upper


def _slew(table: Any) -> Slew | None:
    if table is None:
        return None
    speed = tuple(math.inf if one is None else float(one) for one in table["speed"])
    return Slew(speed, tuple(float(angle) for angle in table["start"]))


def policy_from_dict(content: Mapping[str, Any]) -> Policy:
    """Read a policy from the tables of `policy_to_dict`.

    Args:
        content: The tables.

    Returns:
        The same policy, to the bit.

    Raises:
        LevadeError: If a key is missing, or a value does not fit.
    """
    try:
        ends = content["ends"]
        policy = Policy(
            kernels=GaussianKernels(content["kernels"], content["variance"], content["time"]),
            groups=tuple(
                Group(
                    tuple(group["leader"]),
                    tuple(Follower(tuple(one["joints"]), tuple(one["signs"])) for one in group["followers"]),
                )
                for group in content["groups"]
            ),
            horizon=content["horizon"],
            timestep=content["timestep"],
            hold_steps=content["hold_steps"],
            ends=None
            if ends is None
            else Ends(_angles(ends["start"]), _angles(ends["goal"]), ends["depart"], ends["settle"]),
            within=_within(content.get("within")),
            slew=_slew(content.get("slew")),
        )
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise LevadeError(f"policy: its tables cannot be read ({type(error).__name__}: {error})") from None
    for name, angles in (("start", policy.ends.start), ("goal", policy.ends.goal)) if policy.ends else ():
        if angles.shape != (policy.joints,):
            raise LevadeError(f"policy.ends.{name}: has {angles.size} angles for {policy.joints} joints; give one each")
    if policy.within is not None:
        lower, upper = policy.within
        if not len(lower) == len(upper) == policy.joints:
            raise LevadeError(f"policy.within: should have two ends for each of {policy.joints} joints")
        if not all(low <= high for low, high in zip(lower, upper, strict=True)):  # also if one is NaN
            raise LevadeError("policy.within: a lower end is above the upper one, or not a number")
    if policy.slew is not None:
        if not len(policy.slew.speed) == len(policy.slew.start) == policy.joints:
            raise LevadeError(f"policy.slew: should have a speed and a start for each of {policy.joints} joints")
        if not (all(speed > 0 for speed in policy.slew.speed) and all(map(math.isfinite, policy.slew.start))):
            raise LevadeError("policy.slew: a speed is not positive, or a start is not a number")
    return policy


def _angles(values: Any) -> Array:
    return np.array(values, dtype=float)
