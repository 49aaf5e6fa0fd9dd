"""Margins: one joint 1 % beyond its limit is found, and named."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.checks import Demands, margins
from levade.checks.contacts import landings, poses, scene_forces
from levade.motions import Motion, RecordedSimulation

Change = Callable[..., Motion]
Wound = Callable[[str], Path]


def failed(motion: Motion, demands: Demands | None = None) -> dict[str, tuple[str, ...]]:
    return {
        name: one.failed
        for name, one in margins(RecordedSimulation(motion, threads=1), demands or Demands()).items()
        if one.passed is False
    }


def test_a_robot_that_stands_is_within_all_its_limits(standing: Motion) -> None:
    assert failed(standing) == {}


@pytest.mark.slow
@pytest.mark.parametrize("joint", [0, 4, 11])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_joint_pushed_one_percent_over_its_torque_limit_fails_and_is_named(
    joint: int, sign: int, standing: Motion, changed: Change
) -> None:
    torque, speed = (standing[f"joint_{name}"].copy() for name in ("torque", "velocity"))
    limit = standing.meta["limits"]["torque"][joint]
    speed[60, joint] = 0.0
    torque[60, joint] = sign * limit
    assert failed(changed(standing, joint_torque=torque, joint_velocity=speed)) == {}
    torque[60, joint] = sign * 1.01 * limit
    found = failed(changed(standing, joint_torque=torque, joint_velocity=speed))
    assert found == {"torque": (str(standing["joint_names"][joint]),)}


@pytest.mark.slow
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_joint_one_percent_over_its_speed_limit_fails_and_is_named(
    sign: int, standing: Motion, changed: Change
) -> None:
    speed, torque = (standing[f"joint_{name}"].copy() for name in ("velocity", "torque"))
    torque[70, 2] = 0.0
    speed[70, 2] = sign * 12.0
    assert failed(changed(standing, joint_velocity=speed, joint_torque=torque)) == {}
    speed[70, 2] = sign * 12.12
    assert failed(changed(standing, joint_velocity=speed, joint_torque=torque)) == {"speed": ("lf_kfe",)}


@pytest.mark.slow
@pytest.mark.parametrize("end", ["lower", "upper"])
def test_a_joint_one_percent_over_its_range_fails_and_is_named(end: str, standing: Motion, changed: Change) -> None:
    angle = standing["joint_position"].copy()
    limits = standing.meta["limits"]
    beyond = 0.01 * (limits["upper"][0] - limits["lower"][0])
    at, sign = limits[end][0], 1 if end == "upper" else -1
    angle[30, 0] = at
    assert "position" not in failed(changed(standing, joint_position=angle))
    angle[30, 0] = at + sign * beyond
    assert failed(changed(standing, joint_position=angle))["position"] == ("lf_haa",)


@pytest.mark.slow
def test_a_joint_beyond_its_torque_speed_line_fails_only_while_it_drives(standing: Motion, changed: Change) -> None:
    """HyQ2Max's knees: 400 Nm at standstill, nothing at 17 rad/s, so 164.7 Nm at 10 rad/s."""
    torque, speed = (standing[f"joint_{name}"].copy() for name in ("torque", "velocity"))
    speed[70, 2], torque[70, 2] = 10.0, 400 * (1 - 10 / 17)
    motion = changed(standing, joint_torque=torque, joint_velocity=speed)
    assert failed(motion) == {}
    assert margins(RecordedSimulation(motion), Demands())["torque_speed"].values["lf_kfe"] == pytest.approx(
        0.0, abs=1e-9
    )
    torque[70, 2] *= 1.01
    assert failed(changed(standing, joint_torque=torque, joint_velocity=speed)) == {"torque_speed": ("lf_kfe",)}
    torque[70, 2] *= -1
    assert failed(changed(standing, joint_torque=torque, joint_velocity=speed)) == {}


@pytest.mark.slow
def test_the_linkage_is_judged_where_the_task_has_it(standing: Motion, changed: Change) -> None:
    """The knee's linkage transmits half of its best, 125 Nm, at its stops."""
    angle, torque = (standing[f"joint_{name}"].copy() for name in ("position", "torque"))
    angle[30, 2], torque[30, 2] = standing.meta["limits"]["lower"][2], 130.0
    pushed = changed(standing, joint_position=angle, joint_torque=torque)
    margin = margins(RecordedSimulation(pushed), Demands())["linkage"]
    assert margin.passed is None
    assert "linkage: true" in margin.reason
    assert margin.values["lf_kfe"] == pytest.approx(1 - 130 / 125, abs=2e-3)
    task = {**standing.meta["task"], "robot": {**standing.meta["task"]["robot"], "linkage": True}}
    assert failed(changed(pushed, {"task": task})) == {"linkage": ("lf_kfe",)}


def test_power_is_torque_times_speed_and_forces_carry_the_robot(standing: Motion) -> None:
    found = margins(RecordedSimulation(standing), Demands(power=1e-6, foot_force=0.2))
    power = np.abs(standing["joint_torque"] * standing["joint_velocity"]).max(axis=0)
    assert list(found["power"].values.values()) == pytest.approx(power.tolist())
    assert found["power"].passed is False
    mean = found["foot_force"].more["mean_N"]
    weight = 80.51 * 9.81
    assert standing["foot_contact_force"][:, :, 2].sum(axis=1).mean() == pytest.approx(weight, rel=0.01)
    assert weight <= sum(mean.values()) < 1.1 * weight  # feet press sideways, too
    assert found["foot_force"].failed


def test_what_heats_and_what_all_joints_take_at_once(standing: Motion) -> None:
    torque, speed = standing["joint_torque"], standing["joint_velocity"]
    found = margins(RecordedSimulation(standing), Demands(torque_rms=0.99, robot_power=1e-6))
    rms = [math.sqrt(sum(x * x for x in column) / len(column)) for column in torque.T.tolist()]
    limit = standing.embodiment.limits.torque
    assert list(found["torque_rms"].values.values()) == pytest.approx((1 - np.array(rms) / limit).tolist())
    assert found["torque_rms"].passed is False
    rows = zip(torque.tolist(), speed.tolist(), strict=True)
    driving = max(sum(max(t * v, 0.0) for t, v in zip(*row, strict=True)) for row in rows)
    assert found["robot_power"].value == pytest.approx(driving)
    assert found["robot_power"].passed is False


def with_windings(motion: Motion, change: Change, wound: Wound, limit: str = "", **arrays: np.ndarray) -> Motion:
    """The motion of a robot whose description has windings: 5 Nm/A, 40 A, 0.2 ohm, 10 s."""
    thermal = f"{{resistance: 2, capacitance: 5{limit}}}"
    robot = wound(f"{{motorconst: 0.5, gear: 10, current: 40, resistance: 0.2, thermal: {thermal}}}")
    named = {**motion.meta["task"]["robot"], "name": str(robot)}
    return change(motion, {"task": {**motion.meta["task"], "robot": named}}, **arrays)


@pytest.mark.slow
def test_windings_have_a_current_and_a_temperature(standing: Motion, changed: Change, wound: Wound) -> None:
    """At 150 Nm one takes 30 of 40 A, which is 180 W: from 25 degC it is 360 K (1 - e^(-t / 10 s)) warmer."""
    torque = np.zeros_like(standing["joint_torque"])
    torque[:, 4] = -150.0
    moved = with_windings(standing, changed, wound, ", limit: 75", joint_torque=torque)
    found = margins(RecordedSimulation(moved), Demands())
    name = moved.joint_names[4]
    current, warm = found["current"], found["winding_temperature"]
    assert (current.least, current.value, current.passed) == (name, pytest.approx(0.25), True)
    assert current.said == "30 A of 40 A"
    assert current.more["rms_A"][name] == pytest.approx(30.0)
    rise = 360.0 * (1 - math.exp(-moved.duration / 10.0))
    assert warm.more["hottest_C"][name] == pytest.approx(25.0 + rise)
    assert (warm.least, warm.value, warm.passed) == (name, pytest.approx((50 - rise) / 50), True)
    assert warm.said == f"{25 + rise:.1f} °C of 75 °C"
    assert warm.more["if_repeated_C"][name] == pytest.approx(385.0)
    speed = np.zeros_like(torque)
    speed[:, 4] = -2.0
    driving = margins(RecordedSimulation(changed(moved, joint_velocity=speed)), Demands(current=0.3))
    assert driving["current"].failed == (name,)
    assert driving["robot_power"].value == pytest.approx(300.0)
    assert driving["robot_power"].more["with_winding_heat"] == pytest.approx(480.0)


@pytest.mark.slow
def test_an_assumed_temperature_is_not_judged_and_unknown_windings_are_said(
    standing: Motion, changed: Change, wound: Wound
) -> None:
    torque = np.full_like(standing["joint_torque"], 200.0)
    moved = with_windings(standing, changed, wound, joint_torque=torque)
    warm = margins(RecordedSimulation(moved), Demands(winding_temperature=0.9))["winding_temperature"]
    assert (warm.passed, warm.unknown) == (None, moved.joint_names)
    assert "the limit is assumed" in warm.reason
    assert "assumed 100 °C" in warm.said
    plain = margins(RecordedSimulation(standing), Demands())
    assert (plain["current"].value, plain["current"].passed, plain["current"].unknown) == (None, None, ())
    assert plain["current"].reason == plain["winding_temperature"].reason == "the drives are hydraulic"
    asked = margins(RecordedSimulation(standing), Demands(current=0.1))["current"]
    assert asked.unknown == standing.joint_names


@pytest.mark.slow
def test_flow_is_displacement_times_speed(standing: Motion, changed: Change) -> None:
    """At 12 rad/s and 20 MPa a hip takes 120 / 20e6 m3/rad * 12 rad/s = 4.32 l/min, and all twelve joints 88.6 l/min."""
    speed = np.zeros_like(standing["joint_velocity"])
    speed[30], speed[31, :2] = 12.0, -6.0
    moving = changed(standing, joint_velocity=speed)
    found = margins(RecordedSimulation(moving), Demands(flow=5.0, pump_flow=80.0))
    assert found["flow"].values["lf_haa"] == pytest.approx(4.32)
    assert found["flow"].values["lf_hfe"] == pytest.approx(8.82)
    assert found["flow"].failed == tuple(name for name in moving.joint_names if not name.endswith("haa"))
    assert found["pump_flow"].value == pytest.approx(4 * (4.32 + 8.82 + 9.0))
    assert found["pump_flow"].passed is False
    other = {**moving.meta["task"], "robot": {**moving.meta["task"]["robot"], "actuation": "ideal"}}
    none = margins(RecordedSimulation(changed(moving, {"task": other})), Demands(flow=5.0))["flow"]
    assert (none.value, none.passed, none.unknown) == (None, None, moving.joint_names)
    assert "supply pressure" in none.reason


def test_a_foot_that_falls_lands_at_the_speed_of_free_fall(standing: Motion, changed: Change) -> None:
    """Poses of a robot that falls by 5 cm: it lands at sqrt(2 g h)."""
    step, height = standing.meta["timestep"], 0.05
    time = standing["time"]
    drop = np.maximum(height - 0.5 * 9.81 * time**2, 0.0)
    position = np.repeat(standing["trunk_position"][:1], len(time), axis=0)
    position[:, 2] += drop
    force = standing["foot_contact_force"].copy()
    contact = int(np.argmax(drop == 0))
    force[:contact] = 0.0
    falling = changed(
        standing,
        trunk_position=position,
        joint_position=np.repeat(standing["joint_position"][:1], len(time), axis=0),
        trunk_quaternion=np.repeat(standing["trunk_quaternion"][:1], len(time), axis=0),
        foot_contact_force=force,
    )
    simulation = RecordedSimulation(falling)
    centres, _, normals = poses(simulation)
    landed = landings(simulation, centres, normals, scene_forces(simulation, normals))
    assert {one.foot for one in landed} == set(simulation.embodiment.feet)
    expected = np.sqrt(2 * 9.81 * height)
    for one in landed:
        assert one.speed == pytest.approx(expected, abs=1.5 * 9.81 * step)
        assert one.time == pytest.approx(np.sqrt(2 * height / 9.81), abs=2 * step)


def test_feet_that_meet_in_the_air_bear_nothing_and_do_not_land(standing: Motion, changed: Change) -> None:
    """Half a metre up, with forces of their own on each other."""
    force = np.zeros_like(standing["foot_contact_force"])
    force[60:80, :2] = [0.0, 5000.0, 0.0]
    up = standing["trunk_position"] + np.array([0.0, 0.0, 0.5])
    found = margins(RecordedSimulation(changed(standing, trunk_position=up, foot_contact_force=force)), Demands())
    assert found["foot_force"].value == 0.0
    assert found["impact_speed"].more["landings"] == []


def test_legs_that_enter_each_other_are_found(standing: Motion, changed: Change) -> None:
    angle = standing["joint_position"].copy()
    angle[40:50, [0, 3]] = 0.785, 0.785  # both front legs inward
    found = margins(RecordedSimulation(changed(standing, joint_position=angle)), Demands())["self_collision"]
    assert found.passed is False
    deepest = found.more["collisions"][0]
    assert all(name.startswith(("lf", "rf")) for name in deepest["bodies"])
    assert deepest["share"] == pytest.approx(10 / 150)
    assert standing["time"][40] <= deepest["time"] <= standing["time"][49]
    model = mujoco.MjModel.from_xml_string(standing.model_xml)
    data = mujoco.MjData(model)
    data.qpos[:3], data.qpos[3:7], data.qpos[7:] = 0.0, [1, 0, 0, 0], angle[45]
    mujoco.mj_forward(model, data)
    depth = max(-c.dist for c in data.contact if all(model.geom_bodyid[g] for g in c.geom))
    assert deepest["depth"] == pytest.approx(depth, abs=1e-4)


def test_where_the_robot_gives_no_limit_nothing_is_judged(standing: Motion, changed: Change) -> None:
    limits = dict(standing.meta["limits"])
    limits["velocity"] = [None] * 12
    limits["torque"] = [None, *limits["torque"][1:]]
    found = margins(RecordedSimulation(changed(standing, {"limits": limits})), Demands())
    assert (found["speed"].passed, found["speed"].value) == (None, None)
    assert found["speed"].reason == "the robot gives no limit"
    assert found["speed"].unknown == tuple(standing.joint_names)
    assert found["torque"].values["lf_haa"] is None
    assert (found["torque"].passed, found["torque"].unknown) == (None, ("lf_haa",))
    assert found["torque"].reason == "the robot gives no limit of lf_haa"


@pytest.mark.slow
def test_an_assumed_limit_is_neither_met_nor_missed(standing: Motion, changed: Change) -> None:
    """Joint 2 is beyond its limit, which is assumed; joint 3 too, and the file gives that one."""
    limits = {**standing.meta["limits"], "assumed_velocity": [1, 2]}
    speed, torque = standing["joint_velocity"].copy(), np.zeros_like(standing["joint_torque"])
    speed[70, 2] = 13.0
    found = margins(
        RecordedSimulation(changed(standing, {"limits": limits}, joint_velocity=speed, joint_torque=torque)), Demands()
    )
    assert (found["speed"].passed, found["speed"].failed) == (None, ())
    assert found["speed"].unknown == found["torque_speed"].unknown == ("lf_hfe", "lf_kfe")
    assert found["speed"].reason == "the limit is assumed of lf_hfe, lf_kfe; beyond what is assumed: lf_kfe"
    assert found["torque"].passed is True
    speed[70, 3] = 13.0
    found = margins(RecordedSimulation(changed(standing, {"limits": limits}, joint_velocity=speed)), Demands())["speed"]
    assert (found.passed, found.failed, found.unknown) == (False, ("rf_haa",), ("lf_hfe", "lf_kfe"))
    nothing = margins(RecordedSimulation(changed(standing, {"limits": limits})), Demands(speed=None))["speed"]
    assert (nothing.passed, nothing.unknown) == (None, ())


@pytest.mark.slow
def test_the_force_on_any_part_is_in_weights_of_the_robot(standing: Motion) -> None:
    """A robot that stands bears itself on its shanks, and its trunk touches nothing."""
    found = margins(RecordedSimulation(standing), Demands(part_force=1.0))["part_force"]
    shanks = [share for body, share in found.values.items() if body.endswith("_lower") and share is not None]
    assert len(shanks) == 4
    assert 1.0 < sum(shanks) < 1.3  # the most of each, not at one instant
    assert found.values["trunk"] == 0.0
    assert found.passed is True
    assert margins(RecordedSimulation(standing), Demands(part_force=0.2))["part_force"].failed


def test_a_jolt_of_the_trunk_is_its_acceleration(standing: Motion, changed: Change) -> None:
    velocity = np.zeros_like(standing["trunk_linear_velocity"])
    velocity[50:, 2] = 0.3
    moved = changed(standing, trunk_linear_velocity=velocity)
    found = margins(RecordedSimulation(moved), Demands(trunk_acceleration=10.0))["trunk_acceleration"]
    assert found.value == pytest.approx(0.3 / standing.timestep / 9.81)
    assert found.failed == ("trunk",)
