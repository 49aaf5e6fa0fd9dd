"""What an export says about the simulation, against MuJoCo: drives, what may touch, friction, the start."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from levade.arrays import Array
from levade.exports import export
from levade.exports.simulation import never_touch, simulation
from levade.motions import Motion
from levade.robots import load_robot
from levade.scenes import Scene, compose
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task, task_to_dict


@pytest.fixture(scope="module")
def facts(rearing: Motion, rearing_model: mujoco.MjModel) -> dict[str, Any]:
    return simulation(rearing, rearing_model)


def per_joint(facts: dict[str, Any], name: str) -> Array:
    values = [joint["drive"][name] for joint in facts["joints"].values()]
    return np.array([np.inf if value is None else value for value in values])


def test_the_drives_are_those_of_the_robots_description(facts: dict[str, Any]) -> None:
    actuation: Any = load_robot("hyq2max").actuation
    assert {joint["drive"]["kind"] for joint in facts["joints"].values()} == {"dcmotor"}
    for name in ("kp", "kd", "torque", "stall_torque", "no_load_speed", "time_constant"):
        wanted = np.broadcast_to(getattr(actuation, name), 12)
        np.testing.assert_allclose(per_joint(facts, name), wanted, rtol=1e-5)


def test_a_drive_without_line_and_lag_says_so(held: Motion) -> None:
    joint = simulation(held, held.compiled())["joints"]["lf_kfe"]
    assert joint["drive"] == {
        "kind": "pid",
        "kp": 600.0,
        "kd": 20.0,
        "torque": 250.0,
        "stall_torque": None,
        "no_load_speed": None,
        "time_constant": 0.0,
    }
    assert (joint["damping"], joint["armature"], joint["friction"], joint["spring"]) == (0.1, 0.0, 0.0, None)


def test_the_drives_of_the_documentation_deliver_what_the_simulation_did(
    rearing: Motion, rearing_model: mujoco.MjModel, facts: dict[str, Any]
) -> None:
    """kp and kd make a torque, the line bounds it, the lag delays it, the limit bounds what is delivered."""
    kp, kd, limit, stall, fastest, lag = (
        per_joint(facts, name) for name in ("kp", "kd", "torque", "stall_torque", "no_load_speed", "time_constant")
    )
    at = rearing.addresses(rearing_model)
    angle = np.concatenate([rearing["qpos0"][at.joint_qpos][None], rearing["joint_position"][:-1]])
    speed = np.concatenate([rearing["qvel0"][at.joint_qvel][None], rearing["joint_velocity"][:-1]])
    wanted = kp * (rearing["ctrl"][:, 0::2] - angle) + kd * (rearing["ctrl"][:, 1::2] - speed)
    slope = stall / fastest
    within = np.clip(wanted, slope * (-fastest - speed), slope * (fastest - speed))
    share = -np.expm1(-rearing.timestep / lag)
    state, delivered = rearing["act0"].copy(), []
    for row in within:
        state += share * (row - state)
        delivered.append(np.clip(state, -limit, limit))
    assert np.abs(within - wanted).max() > 10.0  # the line is felt
    np.testing.assert_allclose(np.array(delivered), rearing["joint_torque"], atol=0.01)


def touching(large: mujoco.MjModel) -> set[frozenset[str]]:
    """Pairs of bodies that MuJoCo finds in contact when every shape is so large that all overlap. Changes the model."""
    robots = large.geom_bodyid > 0
    large.geom_type[robots] = mujoco.mjtGeom.mjGEOM_SPHERE
    large.geom_size[robots], large.geom_rbound[robots] = 5.0, 5.0
    large.geom_aabb[robots] = [0, 0, 0, 5, 5, 5]
    large.bvh_aabb[:] = np.where(np.arange(6) < 3, 0.0, 5.0)
    data = mujoco.MjData(large)
    mujoco.mj_kinematics(large, data)
    mujoco.mj_comPos(large, data)
    mujoco.mj_collision(large, data)
    bodies = [large.geom_bodyid[contact.geom] for contact in data.contact]
    return {frozenset(large.body(int(body)).name for body in pair) for pair in bodies if (pair > 0).all()}


@pytest.mark.slow
def test_links_never_touch_that_mujoco_lets_pass_through_each_other(tmp_path: Path, quadruped: type) -> None:
    text = (
        quadruped()
        .mjcf()
        .replace("<actuator>", '<contact><exclude body1="lf_shank" body2="rf_shank"/></contact><actuator>')
    )
    (tmp_path / "toy.xml").write_text(text)
    for name in ("hyq2max", tmp_path / "toy.xml"):
        model = compose(load_robot(name), Scene()).compile()
        never = {frozenset(pair) for pair in never_touch(model)}
        masks = model.geom_contype | model.geom_conaffinity
        bodies = {model.body(int(b)).name for b in model.geom_bodyid[masks > 0] if b > 0}
        both = {frozenset(pair) for pair in itertools.combinations(bodies, 2)}
        assert touching(model) == both - never
        assert never
    assert frozenset({"lf_shank", "rf_shank"}) in never


def test_explicit_pairs_touch_with_their_own_friction(rearing: Motion) -> None:
    pair = '<contact><pair geom1="lf_foot" geom2="ground" friction="0.3 0.3 0.01 0.001 0.001"/></contact><actuator>'
    model = mujoco.MjModel.from_xml_string(rearing.model_xml.replace("<actuator>", pair))
    friction = {shape["name"]: shape["friction"]["ground"] for shape in simulation(rearing, model)["shapes"]}
    assert (friction["lf_foot"], friction["rf_foot"]) == (0.3, 1.0)


@pytest.mark.parametrize("friction", [None, 0.6])
def test_friction_is_that_of_mujocos_contacts(rearing: Motion, friction: float | None) -> None:
    model = compose(load_robot("hyq2max"), Scene(friction=friction)).compile()
    shapes = {shape["name"]: shape for shape in simulation(rearing, model)["shapes"]}
    data, seen = mujoco.MjData(model), set()
    for height, tilt in itertools.product((0.1, 0.3, 0.5), (0.0, 0.7, 1.5, 3.1)):
        data.qpos[:7] = [0, 0, height, np.cos(tilt / 2), np.sin(tilt / 2), 0, 0]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        for contact in data.contact:
            names = [model.geom(int(geom)).name for geom in contact.geom]
            if "ground" in names:
                (part,) = set(names) - {"ground"}
                assert shapes[part]["friction"] == {"ground": contact.friction[0]}
                seen.add(contact.friction[0])
    assert seen == ({1.0, 1.5} if friction is None else {friction})
    assert {name for name, shape in shapes.items() if shape["foot"]} == set(rearing.embodiment.feet)


def test_the_goal_is_the_tasks(rearing: Motion, facts: dict[str, Any]) -> None:
    assert facts["success"] == task_to_dict(rearing.task)["success"]
    assert facts["success"]["height"]["target"] == 0.9
    assert json.loads(json.dumps(facts)) == facts


@pytest.mark.slow
@pytest.mark.parametrize("contact", [None, "stiff"])
def test_feet_in_the_floor_at_the_start_are_said(tmp_path: Path, quadruped: type, contact: str | None) -> None:
    text = quadruped().mjcf().replace('_foot" size', '_foot" solimp="0.015 1 0.031" priority="1" size')
    (tmp_path / "soft.xml").write_text(text)
    changes = ["search.population=4", "search.trials=4", *([f"scene.contact={contact}"] if contact else [])]
    small = make_objective(load_task("squat-jump", robot=str(tmp_path / "soft.xml"), changes=changes))
    motion = record(small, solve(small, seed=0), seed=0)
    notes = [note for note in export(motion, "csv", tmp_path / "out").notes if "in the ground" in note]
    depth = json.loads((tmp_path / "out/meta.json").read_text())["simulation"]["start_depth"]
    if contact:
        assert notes == []
        assert 0.0 < max(depth.values()) < 0.001
        return
    (note,) = notes
    assert note.startswith("at the start lf_foot, rf_foot, lh_foot, rh_foot are up to ")
    assert "of a radius of 20 mm" in note
    assert note.endswith("solve the task with scene: {contact: stiff}")
    assert min(depth.values()) > 0.005
