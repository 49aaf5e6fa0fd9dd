"""Forces and impacts between the robot's parts, against free flight, Newton's second law and a loop over contacts."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import mujoco
import numpy as np
import pytest

from levade.checks import Demands, margins
from levade.checks.impacts import SCENE, replay_contacts
from levade.motions import Motion, RecordedSimulation

BALLS = """
<mujoco>
  <option timestep="0.0005" gravity="0 0 {gravity}" integrator="implicitfast"/>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body name="trunk" pos="0 0 {height}">
      <freejoint/>
      <geom type="sphere" size="0.05" mass="1" contype="{own}" conaffinity="{own}"/>
      <body name="left" pos="-0.5 0 0"><joint name="left" type="slide" axis="1 0 0"/><geom size="0.1" mass="2"/></body>
      <body name="right" pos="0.5 0 0"><joint name="right" type="slide" axis="1 0 0"/><geom size="0.1" mass="2"/></body>
    </body>
  </worldbody>
</mujoco>
"""


def simulation(text: str, qvel: list[float], steps: int) -> RecordedSimulation:
    """What a replay needs of a recorded simulation, for a model without actuators."""
    model = mujoco.MjModel.from_xml_string(text)
    start = SimpleNamespace(qpos=model.qpos0[None], qvel=np.array([qvel]), act=np.zeros((1, 0)))
    time = model.opt.timestep * np.arange(1, steps + 1)
    engine = SimpleNamespace(ctrl=lambda reference: np.zeros((1, steps, 0)))
    made = SimpleNamespace(
        model_copy=lambda: model, start=start, motion={"time": time}, engine=engine, reference=None, model=model
    )
    return cast(RecordedSimulation, made)


def test_two_parts_meet_with_the_speed_between_them_and_the_force_that_stops_them() -> None:
    """Two balls of 2 kg on rails, 0.8 m apart, at 3 and 1 m/s: they meet after 0.2 s, at 4 m/s."""
    text = BALLS.format(gravity=0, height=3, own=0)
    moving = simulation(text, [0, 0, 0, 0, 0, 0, 3.0, -1.0], steps=500)
    found = replay_contacts(moving)
    (impact,) = found.impacts
    assert impact.bodies == ("left", "right")
    assert impact.speed == pytest.approx(4.0, abs=1e-6)
    assert impact.time == pytest.approx(0.2, abs=0.0011)
    # the same by hand: of two balls, the force is the mass times the acceleration
    data, model = mujoco.MjData(moving.model), moving.model
    data.qvel[:] = moving.start.qvel[0]
    most = 0.0
    for _ in range(500):
        mujoco.mj_step(model, data)
        most = max(most, float(np.abs(data.qfrc_constraint[7])))  # along the rail of the right ball
    assert most > 100.0
    assert found.forces["left", "right"] == pytest.approx(most, rel=1e-6)


def test_a_part_falls_on_the_scene_at_the_speed_of_free_fall() -> None:
    """From 0.5 m below its centre less its radius of 0.1 m, at sqrt(2 g h); the trunk touches nothing."""
    found = replay_contacts(simulation(BALLS.format(gravity=-9.81, height=0.5, own=0), [0.0] * 8, steps=700))
    first = [one for one in found.impacts if one.time < 0.3]
    assert {one.bodies for one in first} == {("left", SCENE), ("right", SCENE)}
    for one in first:
        assert one.speed == pytest.approx(np.sqrt(2 * 9.81 * 0.4), abs=2 * 9.81 * 0.0005)
        assert one.time == pytest.approx(np.sqrt(2 * 0.4 / 9.81), abs=0.0011)
    assert found.forces == {}  # of parts on each other


def test_what_touches_at_the_start_does_not_meet() -> None:
    at_rest = simulation(BALLS.format(gravity=-9.81, height=0.0999, own=0), [0.0] * 8, steps=100)
    assert replay_contacts(at_rest).impacts == ()


@pytest.mark.slow
def test_legs_that_are_driven_into_each_other_are_named(standing: Motion) -> None:
    """Both front legs are commanded inward. The forces are those of a loop over MuJoCo's contacts."""
    plain = margins(RecordedSimulation(standing, threads=1), Demands(self_force=0.0, self_impact_speed=0.0))
    assert (plain["self_force"].values, plain["self_force"].passed, plain["self_impact_speed"].passed) == (
        {},
        True,
        True,
    )
    assert plain["part_impact_speed"].values == {}

    position, start = standing["joint_position_reference"].copy(), standing["qpos0"].copy()
    position[5:, [0, 3]], start[2] = 0.78, start[2] + 0.6  # in the air
    moved = replace(standing, arrays={**standing.arrays, "joint_position_reference": position, "qpos0": start})
    simulation = RecordedSimulation(moved, threads=1)
    demands = Demands(self_force=0.1, self_impact_speed=0.1)
    found = margins(simulation, demands)
    force, speed = found["self_force"], found["self_impact_speed"]
    assert force.failed
    assert speed.failed
    assert all(name.count(" and ") == 1 for name in force.values)
    assert {name[:2] for name in force.values} <= {"lf", "rf"}
    assert all("_" in body for one in speed.more["impacts"] for body in one["bodies"])

    model, data = simulation.model, mujoco.MjData(simulation.model)
    data.qpos[:], data.qvel[:], data.act[:] = moved["qpos0"], standing["qvel0"], standing["act0"]
    most, wrench = 0.0, np.zeros(6)
    for ctrl in simulation.engine.ctrl(moved.reference)[0].copy():
        data.ctrl[:] = ctrl
        mujoco.mj_step(model, data)
        pairs: dict[Any, list[np.ndarray]] = {}
        for i, contact in enumerate(data.contact):
            bodies = [int(model.geom_bodyid[geom]) for geom in contact.geom]
            if all(bodies):
                mujoco.mj_contactForce(model, data, i, wrench)
                sign = 1 if bodies[0] < bodies[1] else -1
                pairs.setdefault(frozenset(bodies), []).append(sign * (wrench[:3] @ contact.frame.reshape(3, 3)))
        most = max([most, *(float(np.linalg.norm(np.sum(forces, axis=0))) for forces in pairs.values())])
    assert max(force.more["peak_N"].values()) == pytest.approx(most, rel=1e-9)
    assert force.value == pytest.approx(most / (80.51 * 9.81), rel=1e-3)
