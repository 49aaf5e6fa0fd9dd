"""Trajectories made of nothing but numbers, to put terms to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from levade.embodiment import Embodiment, JointLimits, TorqueCurve
from levade.trajectory import JointReference, Trajectories

JOINTS = 12


def make_trajectories(
    n: int = 3, steps: int = 20, hold_steps: int = 5, *, seed: int = 0, **changes: Any
) -> Trajectories:
    """Random trajectories of a robot with 12 joints, one linkage curve (joint 2) and one joint without limits (11)."""
    random = np.random.default_rng(seed)
    shape = (n, steps + hold_steps)

    def normal(*last: int, scale: float = 1.0) -> np.ndarray:
        return scale * random.normal(size=(*shape, *last))

    quaternion = normal(4)
    unlimited = np.r_[np.ones(JOINTS - 1), np.inf]
    arrays: dict[str, Any] = {
        "joint_position": normal(JOINTS),
        "joint_velocity": normal(JOINTS, scale=10),
        "joint_torque": normal(JOINTS, scale=100),
        "trunk_position": normal(3),
        "trunk_quaternion": quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True),
        "trunk_linear_velocity": normal(3),
        "trunk_angular_velocity": normal(3),
        "trunk_com_offset": np.array([0.06, 0.001, -0.008]),
        "reference": JointReference(normal(JOINTS), normal(JOINTS), 0.002, steps),
        "limits": JointLimits(
            lower=-0.7 * unlimited,
            upper=0.9 * unlimited,
            velocity=12.0 * unlimited,
            torque=np.r_[np.full(JOINTS - 1, 120.0), np.inf],
            torque_curves={2: TorqueCurve(peak=110.0, rate=0.727, centre=1.475)},
        ),
        "timestep": 0.002,
        "horizon_steps": steps,
        "diverged": np.zeros(n, dtype=bool),
        "body_contact_force": {"trunk": np.maximum(0, normal(scale=100)), "hip": np.maximum(0, normal(scale=50))},
    }
    arrays |= changes
    about = {name: arrays.pop(name) for name in ("limits", "legs", "trunk_com_offset") if name in arrays}
    embodiment = Embodiment("trunk", tuple(f"joint{i}" for i in range(JOINTS)), (), **about)
    return Trajectories(embodiment=embodiment, **arrays)


@pytest.fixture(scope="session")
def make() -> Callable[..., Trajectories]:
    return make_trajectories


@pytest.fixture(scope="session")
def standing() -> Callable[..., Trajectories]:
    """One trial per quaternion (n, 4), in that attitude from the first row to the last."""

    def build(quaternion: Any, **changes: Any) -> Trajectories:
        quaternion = np.atleast_2d(np.asarray(quaternion, dtype=float))
        rows = np.repeat(quaternion[:, None], 4, axis=1)
        return make_trajectories(len(quaternion), 3, 1, trunk_quaternion=rows, **changes)

    return build
