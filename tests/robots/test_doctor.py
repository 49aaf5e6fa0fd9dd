"""The doctor: it is silent about a sound robot, and finds each mistake that is put into it."""

from __future__ import annotations

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.robots import load_robot
from levade.robots.doctor import inspect, warnings

HIGH = ("<collision><geometry><sphere", '<collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="{}" length="0.1"/>'
        "</geometry></collision><collision><geometry><sphere")  # fmt: skip


@pytest.fixture
def examine(tmp_path: Path, quadruped: type):
    """The doctor's warnings: examine("urdf", (old, new), ...); without the speed limits that no MJCF has."""

    def load(form: str, *changes: tuple[str, str], count: int = 0, **options) -> list[str]:
        text = getattr(quadruped(**options), form)()
        for old, new in changes:
            assert re.search(old, text)
            text = re.sub(old, new, text, count=count)
        path = tmp_path / f"toy.{'urdf' if form == 'urdf' else 'xml'}"
        path.write_text(text)
        return [str(finding) for finding in warnings(load_robot(path)) if "no speed limit; " not in finding.what]

    return load


@pytest.mark.slow
@pytest.mark.parametrize("form", ["urdf", "mjcf"])
@pytest.mark.parametrize("options", [{}, {"knees": "back"}, {"joints": 2}])
def test_a_sound_robot_has_no_warnings(examine, form: str, options: dict) -> None:
    assert examine(form, **options) == []


def test_the_built_in_robot_is_sound() -> None:
    assert inspect(load_robot("hyq2max")) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("form", "changes", "message"),
    [
        ("urdf", [('mass value="[^"]+"', 'mass value="40"')], "robot: weighs 680 kg; masses are in kg"),
        ("mjcf", [('mass="[^"]+"', 'mass="0.01"')], "robot: weighs 0.13 kg; masses are in kg"),
        ("urdf", [('mass value="6.0"', 'mass value="1"')], "legs lf, rf, lh, rh: heavier than the trunk (1.55 kg, trunk 1 kg)"),
        ("urdf", [('"0.1" iyy="0.1" izz="0.1"', '"90" iyy="90" izz="90"')], "body trunk: far too much inertia for its mass"),
        ("mjcf", [("0.1 0.1 0.1", "1e-7 1e-7 1e-7")], "body trunk: almost no inertia for its mass (radius of gyration 0.00013"),
        ("urdf", [('lower="[^"]+" upper="[^"]+"', "")], "all joints: no range: the joint turns without limit; give one in the"),
        ("mjcf", [('range="-1.5 1.5"', "")], "joints lf_hfe, rf_hfe, lh_hfe, rh_hfe: no range: the joint turns without limit"),
        ("mjcf", [('range="-0.8 0.8"', 'range="-0.01 0.01"')], "haa: a range of only 0.02 rad; is it in the file's unit of"),
        ("urdf", [('lower="-0.8"', 'lower="0"')], "lf_haa, rf_haa, lh_haa, rh_haa: at an end of its range in the neutral"),
        ("urdf", [('effort="20.0"', 'effort="1.5"')], "_kfe: needs 2.48 Nm to stand in the neutral posture; its"),
        ("mjcf", [('_foot" size="0.02"', '_foot" type="box" size="0.02 0.02 0.02"')], "a box, not a sphere: contact jumps"),
        ("mjcf", [('<geom name="lf_foot"', '<geom name="heel" size="0.1" pos="0 0 -0.18"/><geom name="lf_foot"')], "heel"),
        ("mjcf", [('<geom name="trunk"', '<geom name="keel" size="0.02" pos="0 0 -0.4"/><geom name="trunk"')],
         "shape keel: below the feet in the neutral posture: the robot stands on it"),
        ("mjcf", [('<geom name="trunk"[^>]*>', "")], "trunk trunk: without a collision shape: falls through the ground"),
        ("urdf", [("<collision>.*box.*</collision>", "")], "trunk trunk: without a collision shape: falls through the ground"),
        ("mjcf", [('kv="1.5"', 'kv="40"')], "its damping is "),
        ("mjcf", [('kp="60"', 'kp="60000"')], "its stiffness is "),
        ("urdf", [('(name="lf_thigh"><inertial><origin xyz="0 0 -0.1"/><mass value=)"0.8"', r'\1"1.2"')],
         "legs lf and rf: weigh 1.95 and 1.55 kg; check the masses of their links"),
        ("urdf", [('(name="lf_hfe".*)lower="-1.5"', r'\1lower="-1.2"')],
         "joints lf_hfe and rf_hfe: ranges that are not mirror images, by 0.3 rad"),
        ("urdf", [('(name="lf_hfe".*)effort="20.0"', r'\1effort="10"')], "legs lf and rf: different torque limits"),
        ("urdf", [('(name="lf_kfe".*xyz=)"0 0 -0.2"', r'\1"0 0 -0.3"')],
         "legs lf and rf: not mirror images: joints lf_kfe and rf_kfe are 0.1 m apart after reflection"),
        ("urdf", [('origin xyz="0 0 0"/><mass value="6.0"', 'origin xyz="0 0.1 0"/><mass value="6.0"')],
         "robot: its centre of mass is 0.049 m to the left of the middle of the feet"),
        ("mjcf", [("<worldbody>", '<option gravity="0 0 -1.6"/><worldbody>')], "option gravity: is (0, 0, -1.6) m/s2"),
        ("mjcf", [("<worldbody>", '<option><flag contact="disable"/></option>\\g<0>')], "option flag contact: is turned off"),
        ("mjcf", [('body name="lf_hip"', 'body name="lf_hip" gravcomp="1"')], "body lf_hip: gravity is compensated there"),
    ],
)  # fmt: skip
def test_it_finds_what_was_made_wrong(examine, form: str, changes: list[tuple[str, str]], message: str) -> None:
    said = examine(form, *changes)
    assert any(message in line for line in said), said


@pytest.mark.slow
def test_a_frame_that_does_not_point_forward_is_suspected(examine) -> None:
    """Legs whose names and places contradict each other, and a robot that is wider than long."""
    backward = (("lf", -1, -1), ("rf", -1, 1), ("lh", 1, -1), ("rh", 1, 1))
    (said,) = examine("urdf", legs=backward, knees="back")
    assert said.startswith(
        "leg lf: its joints' names (rh_haa) say right hind, the kinematics left front; does x of trunk"
    )
    said, falls = examine(
        "mjcf", ('pos="-?0.2 ', 'pos="0.05 '), legs=(("a", 1, 1), ("b", 1, -1), ("c", 0, 1), ("d", 0, -1))
    )
    assert said.startswith(
        "trunk trunk: hips 0.16 m apart from left to right, but 0.05 m from front to hind; does its x"
    )
    assert falls.startswith("robot: does not stand in its neutral posture: ")


@pytest.mark.slow
def test_legs_that_overlap_are_warned_of(examine) -> None:
    old, new = HIGH
    said = examine("urdf", (old, new.format("0.1")))
    assert any("overlap by up to" in line and "legs should stand apart" in line for line in said), said
    assert examine("urdf", (old, new.format("0.02"))) == []


@pytest.mark.slow
@pytest.mark.parametrize(("what", "at"), [("damping", "kd"), ("stiffness", "kp")])
def test_gains_are_called_unstable_where_the_simulation_is(tmp_path: Path, quadruped: type, what: str, at: str) -> None:
    """On both sides of the bound that the doctor names: explicit damping, and stiffness beside implicit damping, of small
    motions in the air, by MuJoCo's own steps."""
    path = tmp_path / "toy.xml"
    path.write_text(quadruped().mjcf())
    other = {"kp": 1e-6} if at == "kd" else {"kd": 0.0}
    high = {"kd": 50.0} if at == "kd" else {"kp": 1e5}
    said = [str(f) for f in warnings(load_robot(path, **high, **other)) if f"its {what} is" in f.what]
    times = float(re.search(r"is (\S+) times", said[0])[1])
    growth = []
    for share in (0.93, 1.07):
        robot = load_robot(path, **{at: share * high[at] / times}, **other)
        assert any(f"its {what} is" in f.what for f in warnings(robot)) == (share > 1)
        model, data = robot.model, mujoco.MjData(robot.model)
        model.opt.timestep, model.opt.gravity[:] = 0.002, 0.0
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        model.dof_damping[:] = 0.0
        model.jnt_limited[:] = 0
        rng = np.random.default_rng(0)
        dofs = [int(model.joint(joint).dofadr[0]) for joint in robot.joint_names]
        rest = robot.data_at(robot.postures["neutral"]).qpos.copy()
        data.qpos[:] = rest
        data.qvel[dofs] = 1e-6 * rng.normal(size=12)
        sizes = []
        for _ in range(400):
            error = np.zeros(model.nv)
            mujoco.mj_differentiatePos(model, error, 1.0, rest, data.qpos)
            data.qfrc_applied[dofs] = -robot.actuation.kd * data.qvel[dofs] - robot.actuation.kp * error[dofs]
            mujoco.mj_step(model, data)
            sizes.append(float(np.abs(data.qvel[dofs]).max()))
            if sizes[-1] > 1e-2:
                break
        growth.append(max(sizes) / 1e-6)
    assert growth[0] < 1e2
    assert growth[1] > 1e4


@pytest.mark.slow
def test_a_back_that_no_foot_gets_beyond_is_said(quadruped: type, tmp_path: Path) -> None:
    """Thigh as far up as it goes and shank upright, turned by the abduction so that its arm helps."""
    robot, path = quadruped(), tmp_path / "toy.xml"
    rack = '<geom name="trunk" type="box" size="0.2 0.04 0.4"/>'
    text = robot.mjcf()
    path.write_text(text.replace('<geom name="trunk" type="box" size="0.2 0.04 0.05"/>', rack))
    highest = robot.FOOT + np.hypot(robot.LINK * (1 - np.cos(robot.FLEXION[1])), robot.OUT)
    said = re.search(r"lying on its back, feet stay about (\S+) m over", "".join(map(str, inspect(load_robot(path)))))
    assert said is not None
    assert float(said[1]) == pytest.approx(0.4 - highest, abs=0.01)
    path.write_text(text)
    assert "on its back" not in "".join(map(str, inspect(load_robot(path))))
