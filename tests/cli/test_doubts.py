"""What a solve says beside success: motions that hold at this time step only, and limits that no file gives."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.checks import Numeric, numerics
from levade.cli.doubts import binding_limits, in_other_numbers, tell_numerics, tell_unknown_limits
from levade.cli.tables import make_console
from levade.motions import Motion, RecordedSimulation
from levade.robots import load_robot
from levade.tasks import load_task

STAND = (
    "--set",
    "stages=[{name: full}]",
    "--set",
    "success={height: {target: 0.57, tolerance: 5 cm}}",
    "--set",
    "search.step=1e-9",
)
SHORT = ("--set", "search.trials=8", "--set", "search.population=8", "--set", "search.optimizer=cma")


@pytest.fixture
def limits():
    return load_robot("hyq2max").limits


@pytest.mark.slow
def test_a_success_is_tried_in_other_numbers_and_a_failure_is_not(levade) -> None:
    code, out, _ = levade("solve", "rearing", "--json", *STAND, *SHORT)
    assert code == 0
    motion = Motion.load("rearing/motion.npz")
    found = numerics(RecordedSimulation(motion, threads=1))
    said = json.loads(out)["numerics"]
    assert {name: one["errors"] for name, one in said.items()} == {
        name: found[name].errors for name in ("half time step", "other contact cone")
    }
    assert [one["success"] for one in said.values()] == [True, True]
    failing = replace(motion, meta={**motion.meta, "success": False})
    assert in_other_numbers(failing) == {}


@pytest.mark.slow
def test_a_success_says_that_it_holds_in_other_numbers(levade) -> None:
    code, out, _ = levade("solve", "rearing", *STAND, *SHORT)
    assert code == 0
    assert "\nIt also succeeds at half the time step and with the other contact cone.\n" in out


@pytest.mark.parametrize(
    ("task", "robot", "directory", "command"),
    [
        ("rearing", "hyq2max", "runs", "levade solve rearing --hardware"),
        ("rearing", "hyq2max", "rearing", "levade solve rearing --hardware --out rearing-hardware"),
        ("rearing", "a b.xml", "runs", "levade solve rearing --hardware --robot 'a b.xml'"),
        ("leap", "hyq2max", "runs", "levade solve leap --hardware"),
        ("mine", "hyq2max", "runs", "levade check runs/motion.npz"),
    ],
)
@pytest.mark.slow
def test_what_fails_at_half_the_step_is_said_with_the_next_command(
    unmet: Path, capsys: pytest.CaptureFixture[str], task: str, robot: str, directory: str, command: str
) -> None:
    motion = Motion.load(unmet / "motion.npz")
    content = {**motion.meta["task"], "name": task}
    content["robot"] = {**content["robot"], "name": robot}
    one = Numeric(True, False, 0.002, {}, "policy", {})
    found = {"half time step": replace(one, success=False), "other contact cone": one}
    changed = replace(motion, meta={**motion.meta, "task": content})
    tell_numerics(make_console(), found, changed, Path(directory))
    assert capsys.readouterr().out == (
        f"It does not succeed at half the time step: its success may depend on how contact is computed. Next: {command}\n"
    )


@pytest.mark.parametrize(
    ("task", "change", "unknown"),
    [
        ("rearing-within-limits", {}, ""),
        ("rearing-within-limits", {"assumed_velocity": (2,)}, "speed"),
        ("rearing-within-limits", {"assumed_torque": (2,)}, "torque"),
        ("self-righting-within-limits", {"velocity": np.full(12, np.inf), "assumed_torque": (0,)}, "speed and torque"),
        ("rearing", {"assumed_velocity": (2,)}, ""),
    ],
)
def test_tasks_within_limits_promise_none_that_no_file_gives(
    limits, capsys: pytest.CaptureFixture[str], task: str, change: dict, unknown: str
) -> None:
    tell_unknown_limits(make_console(), load_task(task), replace(limits, **change))
    said = capsys.readouterr().out
    assert said.startswith(f"task: asks for margins to {unknown} limits that the robot's file does not give") or (
        unknown == said == ""
    )


@pytest.mark.slow
def test_a_solve_names_the_limits_that_are_assumed(levade, tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy.xml").write_text(quadruped().mjcf())
    words = ("self-righting-within-limits", "--robot", "toy.xml", "--trials", "4", "--set", "search.population=4")
    changes = ("stages=[{name: full}]", "robust=null", "horizon=0.5", "hold=0.1")
    _, out, _ = levade("solve", *words, *(word for change in changes for word in ("--set", change)))
    first, second = out.splitlines()[:2]
    assert (
        first == "robot: 1 warning (speed limits of 19.81 rad/s are assumed); levade robots inspect toy.xml says more"
    )
    assert second.startswith("task: asks for margins to speed limits that the robot's file does not give, so success")


@pytest.mark.parametrize(
    ("half", "assumed", "said"),
    [
        ({}, (), []),
        ({"joint_velocity": 11.5}, (), ["the speed of lf_kfe (12 rad/s, at it for 50% of the motion)"]),
        ({"joint_velocity": -11.5}, (2,), ["the speed of lf_kfe (12 rad/s, assumed, at it for 50% of the motion)"]),
        ({"joint_torque": -250.0}, (), ["the torque of lf_kfe (250 Nm, at it for 50% of the motion)"]),
    ],
)
def test_a_limit_that_binds_is_named(unmet: Path, half: dict, assumed: tuple[int, ...], said: list[str]) -> None:
    motion = Motion.load(unmet / "motion.npz")
    arrays = dict(motion.arrays)
    for name in ("joint_velocity", "joint_torque"):
        arrays[name] = np.zeros_like(arrays[name])
        arrays[name][: motion.horizon_steps // 2, 2] = half.get(name, 0.0)
    limits = {**motion.meta["limits"], "assumed_velocity": list(assumed)}
    assert binding_limits(replace(motion, arrays=arrays, meta={**motion.meta, "limits": limits})) == said


def test_a_drive_on_its_torque_speed_line_is_at_its_speed_limit(unmet: Path) -> None:
    motion = Motion.load(unmet / "motion.npz")
    arrays, limits = dict(motion.arrays), motion.embodiment.limits
    speed, torque = np.zeros_like(arrays["joint_velocity"]), np.zeros_like(arrays["joint_torque"])
    speed[:, 4] = 9.0
    torque[:, 4] = limits.stall_torque[4] * (1 - 9.0 / limits.no_load_speed[4])
    assert torque[0, 4] < 0.9 * limits.torque[4]
    (said,) = binding_limits(replace(motion, arrays=arrays | {"joint_velocity": speed, "joint_torque": torque}))
    assert said == f"the speed of {motion.joint_names[4]} (12 rad/s, at it for 100% of the motion)"
