"""Samples of a motion: what was recorded, where it was recorded; between that, the policy itself and stated bounds."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from levade.engines import Physics, make_engine
from levade.errors import LevadeError
from levade.exports.model import gains, holding_torque
from levade.exports.samples import sample
from levade.motions import Motion
from levade.robots import load_robot
from levade.scenes import Scene
from levade.search import Objective


def test_at_the_rate_of_the_simulation_every_row_is_what_was_recorded(
    rearing: Motion, held: Motion, rearing_model: mujoco.MjModel
) -> None:
    for motion, model in ((rearing, rearing_model), (held, held.compiled())):
        samples = sample(motion, model, rate=500.0, reference="commanded")
        steps = len(motion["time"])
        assert len(samples.time) == steps + 1
        np.testing.assert_array_equal(samples.command_position[:-1], motion["ctrl"][:, 0::2])
        np.testing.assert_array_equal(samples.command_velocity[:-1], motion["ctrl"][:, 1::2])
        np.testing.assert_array_equal(samples.joint_torque[:-1], motion["joint_torque"])
        np.testing.assert_array_equal(samples.foot_contact_force[:-1], motion["foot_contact_force"])
        for name in ("joint_position", "joint_velocity", "trunk_position", "trunk_quaternion", "trunk_com_position"):
            np.testing.assert_array_equal(getattr(samples, name)[1:], motion[name])
        np.testing.assert_array_equal(samples.joint_position[0], motion["qpos0"][7:])
        np.testing.assert_array_equal(samples.trunk_position[0], motion["qpos0"][:3])
        np.testing.assert_array_equal(samples.command_position[-1], motion["joint_position_reference"][-1])
        np.testing.assert_array_equal(samples.command_velocity[-1], 0.0)


def test_commands_between_the_steps_are_the_policy_itself(
    objective: Objective, rearing: Motion, rearing_model: mujoco.MjModel
) -> None:
    fine = replace(objective.policy, timestep=0.0005)  # its row k is the end of its step k
    reference = fine.reference(rearing["weights"][None], hold_steps=0)
    samples = sample(rearing, rearing_model, rate=2000.0, reference="commanded")
    assert samples.analytic
    # in force from t on: the policy at t + 2 ms, four rows of the finer one later; at T it stays
    np.testing.assert_allclose(samples.command_position[:597], reference.position[0, 3:], atol=1e-12)
    np.testing.assert_allclose(samples.command_velocity[:597], reference.velocity[0, 3:], atol=1e-10)
    np.testing.assert_array_equal(samples.command_position[597:], np.tile(samples.command_position[596], (4, 1)))
    np.testing.assert_array_equal(samples.command_velocity[597:], 0.0)


def test_references_that_are_not_the_policy_of_the_weights_are_cubics(
    rearing: Motion, rearing_model: mujoco.MjModel
) -> None:
    other = replace(rearing, arrays={**rearing.arrays, "weights": rearing["weights"] + 0.01})
    found, exact = (sample(motion, rearing_model, rate=2000.0, reference="commanded") for motion in (other, rearing))
    assert not found.analytic
    np.testing.assert_array_equal(found.command_position[::4], exact.command_position[::4])
    # |x''''| of a kernel policy with sigma = 0.1 T is at most a few times its range / sigma^4
    spread = np.ptp(rearing["weights"].reshape(6, 16), axis=1).max()
    bound = 0.002**4 / 384 * 10 * spread / 0.03**4
    assert np.abs(found.command_position - exact.command_position).max() < bound < 1e-4
    without = replace(rearing, meta={**rearing.meta, "policy": None, "task": {"name": "mine"}})
    assert not sample(without, rearing_model, rate=700.0).analytic


def test_measured_motion_is_nearer_to_a_finer_simulation_between_the_steps_than_the_step_allows(
    rearing: Motion, rearing_model: mujoco.MjModel
) -> None:
    """MuJoCo at a quarter of the step, told the same: what is between the steps is as good as what is on them."""
    model = mujoco.MjModel.from_xml_string(rearing.model_xml)
    model.opt.timestep = 0.0005
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = rearing["qpos0"], rearing["qvel0"], rearing["act0"]
    states = [data.qpos.copy()]
    for ctrl in np.repeat(rearing["ctrl"], 4, axis=0):
        data.ctrl[:] = ctrl
        mujoco.mj_step(model, data)
        states.append(data.qpos.copy())
    fine = np.array(states)
    samples = sample(rearing, rearing_model, rate=2000.0)
    for found, exact in ((samples.joint_position, fine[:, 7:]), (samples.trunk_position, fine[:, :3])):
        off = np.abs(found - exact).max(axis=1)
        between = np.concatenate([off[1::4], off[2::4], off[3::4]])
        assert between.max() < 1.1 * off[::4].max()


def test_measured_commands_make_the_recorded_torque_the_equilibrium(
    rearing: Motion, rearing_model: mujoco.MjModel
) -> None:
    for options in ({}, {"kp": 37.0, "kd": 1.5}):
        samples = sample(rearing, rearing_model, rate=500.0, **options)
        pull = samples.joints.kp * (samples.command_position - samples.joint_position)
        brake = samples.joints.kd * (samples.command_velocity - samples.joint_velocity)
        np.testing.assert_array_equal((pull + brake + samples.command_torque)[:-1], rearing["joint_torque"])
    assert (samples.joints.kp == 37.0).all()
    assert (samples.joints.kd == 1.5).all()


def test_resampling_keeps_impulses_and_ends_where_it_should(held: Motion) -> None:
    model = held.compiled()
    steps, timestep = len(held["time"]), held.meta["timestep"]
    for rate in (100.0, 250.0, 1000.0, 2500.0):
        samples = sample(held, model, rate=rate)
        assert samples.time[-1] == pytest.approx(0.4)
        for found, recorded in (
            (samples.joint_torque, held["joint_torque"]),
            (samples.foot_contact_force, held["foot_contact_force"]),
        ):
            np.testing.assert_allclose(found[:-1].sum(axis=0) / rate, recorded.sum(axis=0) * timestep, atol=1e-9)
        np.testing.assert_array_equal(samples.joint_position[-1], held["joint_position"][-1])
    short = sample(held, model, rate=500.0, hold=False)
    assert short.time[-1] == pytest.approx(held.meta["horizon"])
    np.testing.assert_array_equal(short.joint_position[-1], held["joint_position"][held.horizon_steps - 1])
    assert steps == 200


@pytest.mark.parametrize("actuation", ["hydraulic", "ideal"])
def test_gains_are_the_robots(actuation: str) -> None:
    kp = {"hydraulic": None, "ideal": 451.0}[actuation]
    robot = load_robot("hyq2max", actuation=actuation, kp=kp)
    model = make_engine(robot, Scene(), Physics()).model
    found = gains(model, robot.joint_names)
    np.testing.assert_allclose(found, [robot.actuation.kp, robot.actuation.kd])
    # and MuJoCo's own torque is that much: at once by a pid, at the end of its lag by a dcmotor
    data = mujoco.MjData(model)
    data.qpos[2] = 5.0
    for control in (0, 1):
        data.ctrl[:], data.act[:] = 0.0, 0.0
        data.ctrl[control::2] = 0.01
        mujoco.mj_forward(model, data)
        torque = data.act_dot * robot.actuation.time_constant if model.na else data.actuator_force
        np.testing.assert_allclose(torque, 0.01 * found[control], rtol=1e-9)


def test_the_holding_torque_is_what_the_drives_delivered_before_the_motion(
    rearing: Motion, rearing_model: mujoco.MjModel
) -> None:
    """Inverse dynamics against the state of the drives' lag, which is the torque that carried the robot."""
    np.testing.assert_allclose(holding_torque(rearing, rearing_model), rearing["act0"], atol=0.05)


def test_an_actuator_without_gains_is_told(rearing: Motion) -> None:
    spec = mujoco.MjSpec.from_string(rearing.model_xml)
    spec.actuators[2].set_to_motor()
    with pytest.raises(LevadeError, match="lf_kfe has no single pid or dcmotor actuator; give its gains, kp and kd"):
        gains(spec.compile(), rearing["joint_names"].tolist())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rate": 0.0}, "rate: 0.0 should be a positive number"),
        ({"rate": float("nan")}, "rate: nan should be"),
        ({"rate": 2.0}, "gives 1 row for 0.3 s of motion"),
        ({"rate": 1e9}, "should be 2 to 1000000"),
        ({"reference": "mesured"}, "no reference 'mesured'; did you mean measured?"),
        ({"kp": -1.0}, "kp: -1.0 should be a number that is not negative"),
        (
            {"kd": 3.0, "reference": "commanded"},
            "commanded references only make the motion with the gains of the simul",
        ),
    ],
)
def test_wrong_options(rearing: Motion, rearing_model: mujoco.MjModel, options: dict, message: str) -> None:
    with pytest.raises(LevadeError) as error:
        sample(rearing, rearing_model, **{"rate": 500.0, **options})
    assert message in str(error.value)


def test_a_motion_that_broke_down_is_not_exported(rearing: Motion, rearing_model: mujoco.MjModel) -> None:
    broken = replace(rearing, meta={**rearing.meta, "diverged": True})
    with pytest.raises(LevadeError, match="broke down"):
        sample(broken, rearing_model, rate=500.0)
    position = rearing["joint_position"].copy()
    position[3, 3] = np.nan
    with pytest.raises(LevadeError, match="broke down"):
        sample(replace(rearing, arrays={**rearing.arrays, "joint_position": position}), rearing_model, rate=500.0)
