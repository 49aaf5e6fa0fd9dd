"""The actuators against the formulas that they stand for: torque-speed line, lag, saturation, gains."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from levade.robots import DCMotor, Robot, load_robot

STEP = 1e-3


def torque_history(robot: Robot, joint: str, speed: float, command: float, steps: int = 80) -> np.ndarray:
    """(steps,) [Nm], delivered after a step in commanded torque [Nm], the joint held at ``speed`` [rad/s]."""
    model = mujoco.MjModel.from_xml_string(robot.spec().to_xml())
    model.opt.timestep, model.opt.gravity[:] = STEP, 0
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(model)
    i = robot.joint_names.index(joint)
    history = []
    for _ in range(steps):
        data.qpos[:], data.qvel[:] = model.qpos0, 0
        data.qpos[7:] = angle = robot.postures["neutral"]
        data.joint(joint).qvel[0] = speed
        data.ctrl[0::2], data.ctrl[1::2] = angle, 0
        data.ctrl[2 * i] = angle[i] + command / robot.actuation.kp[i]
        data.ctrl[2 * i + 1] = speed
        mujoco.mj_step(model, data)
        history.append(data.actuator_force[i])
    return np.array(history)


@pytest.fixture(scope="module")
def hydraulic() -> Robot:
    return load_robot("hyq2max")


@pytest.mark.parametrize(
    ("joint", "limit", "no_load"), [("lf_haa", 120.0, 35.0), ("rf_hfe", 245.0, 17.0), ("lh_kfe", 250.0, 17.0)]
)
@pytest.mark.parametrize("share", [-0.9, -0.3, 0.0, 0.2, 0.375, 0.6, 0.8, 0.95])
def test_full_command_delivers_the_torque_speed_line(
    hydraulic: Robot, joint: str, limit: float, no_load: float, share: float
) -> None:
    delivered = torque_history(hydraulic, joint, share * no_load, command=1e5)[-1]
    assert delivered == pytest.approx(min(limit, 1.6 * limit * (1 - share)), rel=1e-4)
    if share >= 0:  # and the line stays close to the valve's parabola
        assert -0.045 * limit < delivered - limit * (1 - share**2) < 0.145 * limit


def test_at_nominal_speed_the_knee_has_about_half_its_torque(hydraulic: Robot) -> None:
    assert torque_history(hydraulic, "lf_kfe", 12.0, command=1e5)[-1] == pytest.approx(124, rel=0.06)


def test_the_line_is_the_same_in_both_directions(hydraulic: Robot) -> None:
    forward = torque_history(hydraulic, "lf_kfe", 9.0, command=1e5)
    np.testing.assert_allclose(torque_history(hydraulic, "lf_kfe", -9.0, command=-1e5), -forward, rtol=1e-9)


@pytest.mark.parametrize("speed", [0.0, 5.0])
def test_torque_lags_with_four_milliseconds(hydraulic: Robot, speed: float) -> None:
    history = torque_history(hydraulic, "lf_kfe", speed, command=100.0)
    t = STEP * np.arange(1, len(history) + 1)
    np.testing.assert_allclose(history, 100 * (1 - np.exp(-t / 0.004)), rtol=1e-6)


def test_saturation_does_not_wind_up(hydraulic: Robot) -> None:
    """After any excess the lag has no more to unwind than the stall torque: 1.6 of the limit, 2 ms."""
    model = mujoco.MjModel.from_xml_string(hydraulic.spec().to_xml())
    model.opt.timestep = STEP
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(model)
    i = hydraulic.joint_names.index("lf_kfe")
    for command, steps in ((1e5, 50), (0.0, 20)):
        for k in range(steps):
            data.qpos[:], data.qvel[:] = model.qpos0, 0
            data.ctrl[:] = 0
            data.ctrl[2 * i] = command
            mujoco.mj_step(model, data)
            if command == 0 and k == 4:
                assert data.actuator_force[i] < 0.5 * 250


def test_ideal_delivers_the_pd_torque_at_once_up_to_the_limit() -> None:
    ideal = load_robot("hyq2max", actuation="ideal")
    assert torque_history(ideal, "rh_hfe", 15.0, command=200.0, steps=1)[0] == pytest.approx(200, rel=1e-9)
    assert torque_history(ideal, "rh_hfe", 15.0, command=2000.0, steps=1)[0] == pytest.approx(245)
    assert torque_history(ideal, "rh_haa", 0.0, command=-2000.0, steps=1)[0] == pytest.approx(-120)


@pytest.mark.parametrize("actuation", ["hydraulic", "ideal"])
def test_torque_is_kp_position_error_plus_kd_velocity_error(actuation: str) -> None:
    robot = load_robot("hyq2max", actuation=actuation, kp=300, kd=7)
    model = mujoco.MjModel.from_xml_string(robot.spec(gain_scale=0.5).to_xml())
    model.opt.timestep = STEP
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(model)
    generator = np.random.default_rng(0)
    q, v = generator.uniform(-0.05, 0.05, (2, 12))
    for _ in range(80):
        data.qpos[:], data.qvel[:] = model.qpos0, 0
        data.qpos[7:], data.qvel[6:] = q, v
        data.ctrl[0::2], data.ctrl[1::2] = q + 0.1, v - 1.0
        mujoco.mj_step(model, data)
    np.testing.assert_allclose(data.actuator_force, 150 * 0.1 - 3.5 * 1.0, rtol=1e-6)


def test_actuators_come_in_joint_order_with_position_then_velocity(hydraulic: Robot) -> None:
    model = mujoco.MjModel.from_xml_string(hydraulic.spec().to_xml())
    assert [model.joint(j).name for j in model.actuator_trnid[:, 0]] == list(hydraulic.joint_names)
    np.testing.assert_array_equal(model.actuator_ctrladr, np.arange(0, 24, 2))
    assert isinstance(hydraulic.actuation, DCMotor)
