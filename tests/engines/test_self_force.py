"""The strongest contact between parts of the robot, against a loop over MuJoCo's contacts; as a cost, too."""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from levade.costs import SelfContact
from levade.engines import SELF_FORCE, Engine, Physics, State, make_engine
from levade.errors import LevadeError
from levade.exports.as_mjcf import robot_alone
from levade.robots import Robot
from levade.scenes import Scene
from levade.search import make_objective
from levade.tasks import load_task
from levade.trajectory import JointReference

Wave = Callable[..., JointReference]


@pytest.fixture(scope="module")
def feeling(robot: Robot) -> Engine:
    return make_engine(robot, Scene(), Physics(), threads=1, self_force=True)


def test_the_strongest_contact_is_that_of_a_loop_over_contacts_and_changes_no_bit(
    feeling: Engine, engine: Engine, state: State, wave: Wave
) -> None:
    reference = wave(state.joint_reference[0], n=2, steps=150, scale=0.6)
    done, plain = feeling.rollout(state, reference, record=[SELF_FORCE]), engine.rollout(state, reference)
    assert np.array_equal(done.joint_position, plain.joint_position)
    assert plain.self_force is None
    model, expected = feeling.model, np.zeros((2, 150))
    wrench = np.zeros(6)
    for trial, controls in enumerate(feeling.ctrl(reference).copy()):
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos[0], state.qvel[0], state.act[0]
        for row, ctrl in enumerate(controls):
            data.ctrl[:] = ctrl
            mujoco.mj_step(model, data)
            for i, contact in enumerate(data.contact):
                if all(model.geom_bodyid[geom] for geom in contact.geom):
                    mujoco.mj_contactForce(model, data, i, wrench)
                    expected[trial, row] = max(expected[trial, row], np.linalg.norm(wrench[:3]))
    assert expected.max() > 100.0
    assert done.self_force == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_a_model_or_engine_that_does_not_measure_says_so(
    robot: Robot, engine: Engine, state: State, wave: Wave
) -> None:
    with pytest.raises(LevadeError, match="record: the model measures no forces between the robot's parts"):
        engine.rollout(state, wave(state.joint_reference[0], n=1, steps=2), record=[SELF_FORCE])


def test_an_exported_robot_has_no_sensor_of_it(feeling: Engine) -> None:
    assert "_self_force" in feeling.xml
    assert "_self_force" not in robot_alone(feeling.xml, feeling.assets, feeling.embodiment.feet)


@pytest.mark.slow
def test_it_is_a_cost() -> None:
    task = load_task("rearing", changes=["costs.apart={term: self_contact, measure: peak, weight: 1e-4}", "hold=0"])
    assert task.self_force
    objective = make_objective(task, threads=1)
    weights = objective.space.mean + 2.0 * np.random.default_rng(0).standard_normal((4, objective.policy.size))
    done = objective.rollout(weights, hold_steps=0)
    assert done.self_force is not None
    assert done.self_force.max() > 100.0
    assert objective.evaluate(weights).terms["apart"] == pytest.approx(done.self_force.max(axis=1))
    other = load_task("rearing")
    assert not other.self_force
    with pytest.raises(LevadeError, match="self_contact: the simulation measures no forces"):
        make_objective(other, threads=1).with_task(task)
    with pytest.raises(LevadeError, match="self_contact: the engine ode measures no forces"):
        make_objective(
            load_task("rearing", changes=["costs.apart={term: self_contact, weight: 1}", "physics.engine=ode"])
        )
    with pytest.raises(LevadeError, match=r"self_contact\.measure: 'most' is unknown"):
        SelfContact(measure="most")  # type: ignore[arg-type]
