"""One engine for all tests of it, and references that make the robot move."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import mujoco
import numpy as np
import pytest

from levade.engines import Engine, Physics, Settled, State, make_engine, start_state
from levade.robots import Robot, load_robot
from levade.scenes import Scene
from levade.trajectory import JointReference


@pytest.fixture(scope="session")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.fixture(scope="session")
def engine(robot: Robot) -> Engine:
    return make_engine(robot, Scene(), Physics(), threads=1)


@pytest.fixture(scope="session")
def state(robot: Robot, engine: Engine) -> State:
    return start_state(engine, robot, Scene(), Settled())


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


@pytest.fixture(scope="session")
def compile_in() -> Callable[[mujoco.MjSpec, Mapping[str, np.ndarray]], None]:
    """Changes a model by the numbers of one run of a sample, but for its start and where ground and obstacles are."""

    def change(spec: mujoco.MjSpec, v: Mapping[str, np.ndarray]) -> None:
        for body in spec.bodies[1:]:
            body.mass = body.mass * v["mass"][0]
            body.inertia = body.inertia * v["mass"][0] * v["inertia"][0]
            body.fullinertia[:] = body.fullinertia * v["mass"][0] * v["inertia"][0]
        trunk = spec.body("trunk")
        trunk.ipos = trunk.ipos + v["com"]
        for geom in spec.geoms:
            geom.friction[0] *= v["friction"][0]
        for i, actuator in enumerate(spec.actuators):
            actuator.forcerange = actuator.forcerange * v["torque_limit"][0]
            actuator.gainprm[0] /= v["torque_limit"][0]
            actuator.gainprm[4] *= v["kp"][i]
            actuator.gainprm[6] *= v["kd"][i]
            actuator.dynprm[0] *= v["torque_lag"][0]

    return change
