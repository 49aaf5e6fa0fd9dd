"""Robots and tasks standing still: the page's own kinematics against MuJoCo's, and the goal's ghost where the goal is."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from levade.report.packing import UNIT, unpack
from levade.robots import Robot, load_robot
from levade.scenes import Scene, compose
from levade.search import make_objective
from levade.tasks import load_task
from levade.viewer.pages import view_page
from levade.viewer.still import robot_data, task_data


def standing(robot: Robot, angles: np.ndarray) -> mujoco.MjData:
    """By MuJoCo: trunk level, lowest foot on the ground."""
    model = mujoco.MjModel.from_xml_string(compose(robot, Scene()).to_xml(), dict(robot.assets))
    data = mujoco.MjData(model)
    data.qpos[:7] = [0, 0, robot.foot_depths(angles).max(), 1, 0, 0, 0]
    for joint, angle in zip(robot.joint_names, angles, strict=True):
        data.joint(joint).qpos[0] = angle
    mujoco.mj_kinematics(model, data)
    return data


def data_of(text: str) -> dict[str, Any]:
    (found,) = re.findall(r'<script type="application/json" id="levade-data">(.*?)</script>', text, re.DOTALL)
    return json.loads(found)


def open_page(tab: Any, path: Path, title: str, data: dict[str, Any]) -> None:
    path.write_text(view_page(title, data), encoding="utf-8")
    tab.context.set_offline(True)
    tab.goto(path.as_uri())
    tab.wait_for_selector("html[data-ready]")


@pytest.fixture(scope="module")
def hyq() -> Robot:
    return load_robot("hyq2max")


def test_a_robot_is_told_with_its_limits(hyq: Robot) -> None:
    data = json.loads(json.dumps(robot_data(hyq), allow_nan=False))
    assert [joint["name"] for joint in data["joints"]] == list(hyq.joint_names)
    for key, values in (("lower", hyq.limits.lower), ("upper", hyq.limits.upper), ("torque", hyq.limits.torque)):
        np.testing.assert_allclose([joint[key] for joint in data["joints"]], values)
    assert {foot["name"] for foot in data["scene"]["motion"]["feet"]} == set(hyq.feet)
    assert "collision" in [layer["name"] for layer in data["scene"]["layers"]]


def test_ways_to_move_legs_together_are_the_mirror_images(hyq: Robot) -> None:
    """The neutral posture is the same on both sides, front and hind: moving all legs to it moves none."""
    ways = {way["label"]: way["joints"] for way in robot_data(hyq)["together"]}
    assert list(ways) == ["left and right", "all legs"]
    neutral = hyq.postures["neutral"]
    for joints in ways.values():
        for one, (group, sign) in enumerate(joints):
            for other, (its, its_sign) in enumerate(joints):
                if group == its:
                    assert neutral[one] * sign * its_sign == pytest.approx(neutral[other], abs=1e-9)
    assert len({group for group, _ in ways["all legs"]}) == 3
    assert len({group for group, _ in ways["left and right"]}) == 6


@pytest.mark.slow
def test_the_page_poses_the_robot_as_mujoco_does(hyq: Robot, tab: Any, tmp_path: Path) -> None:
    open_page(tab, tmp_path / "robot.html", "hyq2max", robot_data(hyq))
    random = np.random.default_rng(2)
    for angles in (hyq.postures["neutral"], *(random.uniform(hyq.limits.lower, hyq.limits.upper) for _ in range(4))):
        tab.evaluate("angles => window.levade.set(angles)", angles.tolist())
        got = tab.evaluate("() => [...window.levade.kinematics.position]")
        turned = tab.evaluate("() => [...window.levade.kinematics.quaternion]")
        data = standing(hyq, angles)
        bodies = [data.body(name).id for name in robot_data(hyq)["scene"]["model"]["bodies"]]
        np.testing.assert_allclose(np.reshape(got, (-1, 3)), data.xpos[bodies], atol=2e-6)
        quaternion = np.roll(np.reshape(turned, (-1, 4)), 1, axis=1)
        np.testing.assert_allclose(np.abs(np.sum(quaternion * data.xquat[bodies], axis=1)), 1.0, atol=1e-6)
    assert tab.complaints == []


def test_sliders_move_joints_within_their_limits(hyq: Robot, tab: Any, tmp_path: Path) -> None:
    open_page(tab, tmp_path / "robot.html", "hyq2max", robot_data(hyq))
    canvas = tab.locator(".stage canvas")
    before = canvas.screenshot()
    sliders = tab.locator(".joints input[type=range]")
    assert sliders.count() == 12
    for k, joint in enumerate(hyq.joint_names):
        assert sliders.nth(k).get_attribute("aria-label") == joint
        for name, bound in (("min", hyq.limits.lower[k]), ("max", hyq.limits.upper[k])):
            assert float(sliders.nth(k).get_attribute(name)) == pytest.approx(bound)
    tab.get_by_role("radio", name="left and right").check()
    knee = tab.get_by_role("slider", name="lf_kfe")
    knee.press("Home")
    angles = tab.evaluate("() => window.levade.angles")
    assert angles[2] == angles[5] == pytest.approx(hyq.limits.lower[2])
    assert angles[8] == pytest.approx(hyq.postures["neutral"][8])  # a hind knee
    assert tab.locator("#posture").inner_text() == "{lf_kfe: -2.914, rf_kfe: -2.914}"
    assert canvas.screenshot() != before
    tab.get_by_role("button", name="neutral").click()
    assert tab.locator("#posture").inner_text() == "neutral"
    assert hyq.posture({"lf_kfe": -2.914, "rf_kfe": -2.914})[5] == -2.914  # what was copied is a posture
    tab.get_by_role("checkbox", name="collision shapes").check()
    assert tab.complaints == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rearing", "posture-recovery"])
def test_a_task_shows_its_start_and_its_goal(name: str, tab: Any, tmp_path: Path) -> None:
    objective = make_objective(load_task(name), threads=1)
    robot, data = objective.robot, task_data(objective)
    moving, model = data["scene"]["motion"], objective.engine.model
    start = mujoco.MjData(model)
    start.qpos[:] = objective.state.qpos[0]
    mujoco.mj_kinematics(model, start)
    bodies = [start.body(body).id for body in data["scene"]["model"]["bodies"]]
    np.testing.assert_allclose(unpack(moving["position"])[0], start.xpos[bodies], atol=1e-6)

    ghost = moving["reference"]
    position, quaternion = unpack(ghost["position"])[0], unpack(ghost["quaternion"])[0] / UNIT
    x, y, z, w = quaternion[ghost["bodies"].index(0)]  # of the trunk
    goal = mujoco.MjData(model)
    if name == "rearing":  # nothing is said about joints: the trunk alone, pitched by -60 degrees
        assert ghost["bodies"] == [0]
        assert np.arcsin(2 * (w * y - z * x)) == pytest.approx(-1.0472, abs=1e-4)
        goal.qpos[3:7] = w, x, y, z
        height = 0.90
    else:  # the goal posture, level
        assert ghost["bodies"] == list(range(13))
        np.testing.assert_allclose([x, y, z, w], [0, 0, 0, 1], atol=1e-4)
        for joint, angle in zip(robot.joint_names, robot.posture(objective.task.policy.goal), strict=True):
            goal.joint(joint).qpos[0] = angle
        height = 0.61
    goal.qpos[:3] = position[0]
    mujoco.mj_kinematics(model, goal)
    mujoco.mj_comPos(model, goal)
    assert goal.body(robot.trunk).xipos[2] == pytest.approx(height, abs=1e-4)
    np.testing.assert_allclose(position, goal.xpos[[bodies[place] for place in ghost["bodies"]]], atol=1e-4)

    open_page(tab, tmp_path / "task.html", name, data)
    shown = tab.locator("main").inner_text()
    assert f"levade solve {name} --watch" in shown
    assert all(cost.replace("_", " ") in shown for cost in objective.task.costs)
    assert tab.complaints == []


@pytest.mark.slow
def test_a_task_that_says_nothing_about_the_trunk_has_no_ghost() -> None:
    objective = make_objective(load_task("rearing", changes=["success={}", "stages.0.promote={}"]), threads=1)
    moving = task_data(objective)["scene"]["motion"]
    assert (moving["reference"], moving["goal"]) == (None, None)


@pytest.mark.slow
@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("what", ["robot", "task"])
def test_nothing_overflows(hyq: Robot, tab: Any, tmp_path: Path, what: str, width: int) -> None:
    data = robot_data(hyq) if what == "robot" else task_data(make_objective(load_task("posture-recovery"), threads=1))
    tab.set_viewport_size({"width": width, "height": 800})
    open_page(tab, tmp_path / "page.html", "page", data)
    tab.evaluate("() => document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width


def test_a_title_is_text_and_data_are_data(hyq: Robot) -> None:
    text = view_page("<b>&", {"what": "robot", "name": "</script><script>alert(1)"})
    assert "<title>&lt;b&gt;&amp;</title>" in text
    assert data_of(text)["name"] == "</script><script>alert(1)"


def test_an_origin_on_the_ground_does_not_make_a_robot_low() -> None:
    footprint = Path(__file__).parents[1] / "robots" / "cases" / "world" / "footprint.urdf"
    assert ["Trunk's centre of mass, standing", "0.320 m high"] in robot_data(load_robot(footprint))["facts"]
