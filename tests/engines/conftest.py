"""One engine for all tests of it, and references that make the robot move."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from levade.engines import MujocoEngine, Physics, Settled, State
from levade.robots import Robot, load_robot
from levade.scenes import Scene
from levade.trajectory import JointReference


@pytest.fixture(scope="session")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.fixture(scope="session")
def engine(robot: Robot) -> MujocoEngine:
    return MujocoEngine(robot, Scene(), Physics(), threads=1)


@pytest.fixture(scope="session")
def state(engine: MujocoEngine) -> State:
    return engine.start(Settled())


@pytest.fixture(scope="session")
def wave() -> Callable[..., JointReference]:
    """n different motions about a posture: sines of random phase and amplitude, position and velocity consistent."""

    def make(
        posture: np.ndarray, n: int = 5, steps: int = 100, *, timestep: float = 0.002, scale: float = 0.3, seed: int = 0
    ) -> JointReference:
        random = np.random.default_rng(seed)
        amplitude = scale * random.normal(size=(n, 1, posture.size))
        phase = random.uniform(0, 2 * np.pi, size=(n, 1, posture.size))
        angle = 12.0 * timestep * np.arange(1, steps + 1)[:, None] + phase
        return JointReference(
            posture + amplitude * np.sin(angle), 12.0 * amplitude * np.cos(angle), timestep, horizon_steps=steps
        )

    return make
