"""The command line, as a user meets it: a process, its exit status, and what it prints where."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
from pathlib import Path

import pytest

from levade.cli.display import _errors
from levade.motions import Motion
from levade.optimizers import OPTIMIZERS
from levade.report.summary import summary_data
from levade.version import __version__

QUICK = ["--set", "search.optimizer=cma", "--set", "search.population=8", "--trials", "16", "--set", "horizon=0.06"]
LOOSE = ["--set", "success.pitch.tolerance=9", "--set", "success.height.tolerance=9"]


@pytest.mark.slow
def test_help_and_version(levade) -> None:
    status, out, err = levade("--version")
    assert (status, out, err) == (0, f"levade {__version__}\n", "")
    for arguments in ((), ("--help",)):
        status, out, err = levade(*arguments)
        assert (status, err) == (0, "")
        for command in ("solve", "show", "tasks", "robots"):
            assert f"\n  {command} " in out
    status, out, err = levade("solve", "--help")
    assert (status, err) == (0, "")
    for option in ("--robot", "--seed", "--trials", "--optimizer", "--set", "--out", "--json", "--resume"):
        assert option in out
    listed = re.search(r"--optimizer \S+ Optimizer instead of the task's: (.*?)\.", " ".join(out.split()))
    assert listed is not None
    assert re.split(", | or ", listed[1]) == list(OPTIMIZERS)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("solv", "No such command 'solv'. Did you mean 'solve'?"),
        ("--nonsense", "No such option: --nonsense"),
        ("solve rearing --sed 1", "No such option: --sed"),
        ("solve rearing --seed one", "Invalid value for '--seed'"),
        ("solve rearing --seed -1", "Invalid value for '--seed'"),
        ("solve rearing --threads -1", "Invalid value for '--threads'"),
        ("solve rearing --trials many", "Invalid value for '--trials'"),
        ("solve rearing --trials", "requires an argument"),
        ("solve rearing twice", "unexpected extra argument"),
        ("solve", "solve: name a task, such as: levade solve rearing (levade tasks lists them), or --resume DIR"),
        ("solve rearin", "no task 'rearin'; did you mean rearing? (or the path of a YAML file)"),
        ("solve none.yaml", "none.yaml: no such file"),
        ("solve rearing --robot hyq2", "no robot 'hyq2'; did you mean hyq2max?"),
        ("solve rearing --robot my/robot.yaml", "my/robot.yaml: no such file"),
        ("solve rearing --optimizer cmaes", "--set search.optimizer: no optimizer 'cmaes'; did you mean cma?"),
        ("solve rearing --optimizer pi", "no optimizer 'pi'; did you mean pi2?"),
        ("tasks show rearin", "no task 'rearin'; did you mean rearing?"),
        ("tasks show rearing --robot hyq2max", "tasks show: --robot only works with --full"),
        ("tasks shw", "No such command 'shw'."),
        ("solve rearing --trials 0", "--set search.trials: 0 should be at least 1; the paper has about 3000"),
        ("solve rearing --set horizn=1", "--set horizn: no 'horizn' in the task; did you mean horizon?"),
        ("solve rearing --set horizon=0", "--set horizon: 0.0 s should be at least one time step (0.002 s)"),
        (
            "solve rearing --set horizon=5cm",
            "--set horizon: '5cm' is a length, but this is a duration; units here: s, ms",
        ),
        ("solve rearing --set policy.kernels=0", "--set policy.kernels: 0 should be 1 to 1000; the paper has 16"),
        ("solve rearing --set policy.kernels=two", "--set policy.kernels: should be a valid integer"),
        (
            "solve rearing --set start.settled.posture=low",
            "start.settled.posture: robot hyq2max: no posture 'low'; valid",
        ),
        ('solve rearing --set scene.boxes=[{"position":[0,0,0.4],"size":[1,1,0.8]}]', "overlap by"),
        ("solve --resume here --seed 0 --force", "leave out --seed and --force"),
        ("solve rearing --resume here", "leave out TASK"),
        (
            "solve --resume here --trials 3",
            "leave out --set, --trials, --optimizer or --engine",
        ),
        (
            "solve --resume here",
            "here: holds no run to resume, task.yaml or checkpoint.jsonl is missing; give the directory of a run",
        ),
        (
            "solve rearing --out /proc/none",
            "/proc/none: cannot be written (No such file or directory); give another directory: --out DIR",
        ),
        ("solve rearing --out /dev/null/none", "/dev/null/none: cannot be written (Not a directory)"),
        ("show none.npz", "none.npz: no such file; give the motion.npz that levade solve wrote"),
        ("show .", ".: is a directory; give the motion.npz in it: motion.npz"),
        ("show", "Missing argument"),
    ],
)
@pytest.mark.parametrize("json_too", [False, True])
def test_wrong_input_is_one_line_and_nothing_is_written(
    levade, tmp_path: Path, arguments: str, message: str, json_too: bool
) -> None:
    if json_too and not arguments.startswith(("solve", "show")):
        pytest.skip("no --json here")
    status, out, err = levade(*arguments.split(" ", 1)[:1], *["--json"] * json_too, *arguments.split(" ")[1:])
    assert status == 2
    assert err.startswith("levade: ")
    assert message in err
    assert err.count("\n") == 1
    assert err.endswith("\n")
    assert "Traceback" not in err + out
    assert out == "" or not json_too
    assert list(tmp_path.iterdir()) == []


def test_a_task_file_with_a_mistake(levade, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(
        "name: mine\nhorizon: 300 ms\ncosts: {position: {weight: 1, z: 90 deg}}\nsuccess: {}\n"
    )
    status, out, err = levade("solve", "mine.yaml")
    assert (status, out) == (2, "")
    assert err == (
        "levade: mine.yaml.costs.position.z: '90 deg' is an angle, but this is a length;"
        " units here: m, cm, mm, height, leg, trunk\n"
    )
    (tmp_path / "mine.yaml").write_bytes(b"\x00\xff")
    assert levade("solve", "mine.yaml")[0] == 2
    assert [path.name for path in tmp_path.iterdir()] == ["mine.yaml"]


@pytest.mark.slow
@pytest.mark.parametrize(("extra", "status"), [(LOOSE, 0), ([], 1)])
def test_solve_says_by_its_status_whether_it_succeeded(levade, tmp_path: Path, extra: list[str], status: int) -> None:
    code, out, err = levade("solve", "rearing", *QUICK, *extra)
    assert (code, err) == (status, "")
    assert "\x1b" not in out
    for name in ("motion.npz", "task.yaml", "progress.csv", "checkpoint.jsonl"):
        assert (tmp_path / "rearing" / name).is_file()
    assert "Written: rearing/motion.npz, task.yaml, progress.csv, checkpoint.jsonl" in out
    assert ("Success at trial 8" if status == 0 else "No success within 16 trials") in out
    for word in ("criterion", "goal", "result", "pitch", "height", "torque", "speed", "angle"):
        assert word in out
    assert Motion.load(tmp_path / "rearing" / "motion.npz").meta["success"] is (status == 0)


@pytest.mark.slow
def test_a_robust_search_without_success_says_that_the_model_alone_does_it(levade) -> None:
    """A quarter turn at the start is nothing that standing still makes up for."""
    turned = "robust={samples: 2, perturb: {start_attitude: [1.5, 1.6]}}"
    stand = ["success={height: {target: 0.57, tolerance: 5 cm}}", "stages=[{name: full}]", turned]
    code, out, _ = levade("solve", "rearing", *QUICK, "--trials", "48", *(word for s in stand for word in ("--set", s)))
    assert code == 1
    assert "All of this is met on the model, but not on enough of the robots that differ from it.\nNo success" in out
    motion = Motion.load("rearing/motion.npz")
    assert summary_data(motion)["verdict"] == "met on the model, but not on enough robots that differ from it"


@pytest.mark.slow
@pytest.mark.parametrize(("extra", "status"), [(LOOSE, 0), ([], 1)])
def test_json_is_one_object_and_nothing_else(levade, extra: list[str], status: int) -> None:
    code, out, err = levade("solve", "rearing", "--json", "--seed", "5", "--out", "x/y", *QUICK, *extra)
    assert (code, err) == (status, "")
    assert out.count("\n") == 1
    content = json.loads(out)
    contract = (
        "task",
        "robot",
        "seed",
        "success",
        "trials",
        "trials_to_success",
        "wall_s",
        "cost",
        "cost_terms",
        "errors",
    )
    assert set(contract) <= set(content)
    assert (content["task"], content["robot"], content["seed"]) == ("rearing", "hyq2max", 5)
    assert content["success"] is (status == 0)
    assert content["trials_to_success"] == (8 if status == 0 else None)
    assert set(content["errors"]) == {"pitch", "height"}
    assert {"orientation", "position", "effort", "joint_limits"} <= set(content["cost_terms"])
    motion = Motion.load("x/y/motion.npz")
    assert motion.meta["errors"] == content["errors"]
    assert motion.meta["cost"] == content["cost"]


@pytest.mark.slow
def test_the_same_seed_and_the_file_that_is_left_give_the_same_motion(levade) -> None:
    levade("solve", "rearing", "--seed", "4", "--out", "one", *QUICK)
    levade("solve", "one/task.yaml", "--seed", "4", "--out", "two", "--threads", "2")
    levade("solve", "rearing", "--seed", "5", "--out", "three", *QUICK)
    one, two, three = (Motion.load(f"{name}/motion.npz") for name in ("one", "two", "three"))
    for name, values in one.arrays.items():
        assert values.tobytes() == two[name].tobytes()
    assert one["weights"].tobytes() != three["weights"].tobytes()


@pytest.mark.slow
def test_files_of_ones_own_are_kept_unless_forced(levade, tmp_path: Path) -> None:
    levade("solve", "rearing", *QUICK)
    (tmp_path / "task.yaml").write_text((tmp_path / "rearing" / "task.yaml").read_text())
    before = (tmp_path / "task.yaml").read_bytes()
    status, out, err = levade("solve", "task.yaml", "--out", ".")
    assert (status, out) == (2, "")
    assert "task.yaml: exists but does not belong to a run, and would be overwritten; write elsewhere: --out DIR" in err
    assert (tmp_path / "task.yaml").read_bytes() == before
    assert levade("solve", "task.yaml", "--out", ".", "--force")[0] == 1
    assert levade("solve", "rearing/task.yaml")[0] == 1  # a finished run is replaced by itself


@pytest.mark.slow
def test_odd_names_are_printed_as_they_are(levade) -> None:
    status, out, _ = levade("solve", "rearing", "--out", "out[bold]", *QUICK)
    assert status == 1
    assert "Written: out[bold]/motion.npz" in out


@pytest.mark.slow
@pytest.mark.parametrize("extra", [LOOSE, []])
def test_show(levade, extra: list[str]) -> None:
    solved = levade("solve", "rearing", "--seed", "2", *QUICK, *extra)[0]
    status, out, err = levade("show", "rearing/motion.npz")
    assert (status, err) == (solved, "")
    assert "\x1b" not in out
    assert "rearing on hyq2max, seed 2: 0.06 s, 30 steps of 2 ms" in out
    assert "-1.0472 rad" in out
    lines = out.splitlines()
    assert len({line.split()[0] for line in lines}) >= 6  # no row is broken in two
    assert all(len(line.split()) > 3 for line in lines)
    status, out, err = levade("show", "rearing/motion.npz", "--json")
    assert (status, err, out.count("\n")) == (solved, "", 1)
    assert json.loads(out)["seed"] == 2


@pytest.mark.slow
def test_listings(levade) -> None:
    from levade.robots import builtin_robots
    from levade.robots.packages import package_robots
    from levade.tasks import builtin_tasks, builtin_variants

    status, out, err = levade("tasks")
    assert (status, err) == (0, "")
    assert [line.split()[0] for line in out.splitlines()] == [*builtin_tasks(), "NAME-robust", "NAME-within-limits"]
    status, out, _ = levade("tasks", "--json")
    rows = json.loads(out)["tasks"]
    assert [task["name"] for task in rows] == list(builtin_tasks())
    assert [name for task in rows for name in task["variants"]] == list(builtin_variants())
    status, out, _ = levade("robots")
    assert any(line.startswith("hyq2max  ") for line in out.splitlines())
    status, out, _ = levade("robots", "--json")
    assert (status, out.count("\n")) == (0, 1)
    robots = [(r["name"], r["description"]) for r in json.loads(out)["robots"]]
    packaged = [(name, path.name) for name, path in package_robots().items()]  # whatever is installed
    assert robots == [*builtin_robots(), *packaged]


@pytest.mark.slow
def test_a_task_to_start_from(levade, tmp_path: Path) -> None:
    from levade.tasks import builtin_tasks, load_task

    status, out, err = levade("tasks", "show", "rearing")
    assert (status, err) == (0, "")
    assert out == builtin_tasks()["rearing"].read_text(encoding="utf-8")
    status, out, err = levade("tasks", "show", "rearing", "--full", "--robot", "hyq2max")
    assert (status, err) == (0, "")
    (tmp_path / "full.yaml").write_text(out)
    assert load_task(tmp_path / "full.yaml") == load_task("rearing")
    status, out, err = levade("tasks", "schema")
    assert (status, err, json.loads(out)["title"]) == (0, "", "levade task")


@pytest.mark.slow
def test_as_a_process_in_a_pipe(tmp_path: Path) -> None:
    """Once from outside: status, plain text, and a reader who leaves early."""
    command = [sys.executable, "-m", "levade", "solve", "rearing", *QUICK, *LOOSE]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "\x1b" not in done.stdout
    assert done.stdout.isprintable() or set(done.stdout) - {"\n"}
    early = subprocess.run(f"'{sys.executable}' -m levade tasks | true", shell=True, capture_output=True, check=False)
    assert early.stderr == b""


@pytest.mark.slow
def test_on_a_terminal_the_display_is_live_and_leaves_the_tables(tmp_path: Path) -> None:
    """A pseudo-terminal of 80 columns."""
    shown = bytearray()

    def read(descriptor: int) -> bytes:
        data = os.read(descriptor, 4096)
        shown.extend(data)
        return b"."  # pytest keeps what is echoed

    command = ["env", "TERM=xterm-256color", "COLUMNS=80", "LINES=40", sys.executable, "-m", "levade"]
    status = pty.spawn(
        [*command, "solve", "posture-recovery", "--trials", "300", "--set", "search.population=8", "--set", "hold=0.1"],
        read,
        lambda descriptor: b"",
    )
    text = shown.decode()
    assert os.waitstatus_to_exitcode(status) in (0, 1)
    assert "Traceback" not in text
    assert "\x1b[" in text
    for word in (
        "generation",
        "trials/s",
        "best cost",
        "criterion",
        "weighted",
        "Written: posture-recovery/motion.npz",
    ):
        assert word in text, word


def test_a_line_of_progress_says_which_criteria_are_not_simulated_yet() -> None:
    assert _errors({"pitch": 0.25, "still": float("nan")}) == "; errors: pitch +0.25; 1 criterion not simulated yet"
    assert _errors({"up": float("nan"), "still": float("nan")}) == "; 2 criteria not simulated yet"
    assert _errors({"pitch": 0.25}) == "; errors: pitch +0.25"


@pytest.mark.slow
def test_a_second_run_says_that_it_replaces_the_first_and_a_resumed_one_what_it_replays(levade, tmp_path: Path) -> None:
    out = levade("solve", "rearing", *QUICK)[1]
    assert "Written: rearing/motion.npz" in out
    assert "replayed" not in out
    assert "Replaced: rearing/motion.npz" in levade("solve", "rearing", *QUICK)[1]
    checkpoint = tmp_path / "rearing" / "checkpoint.jsonl"
    checkpoint.write_bytes(b"".join(checkpoint.read_bytes().splitlines(keepends=True)[:2]))
    out = levade("solve", "--resume", "rearing")[1]
    assert "Replaying 8 trials of the earlier run ..." in out
    assert "16 trials, 8 of them replayed, in " in out


@pytest.mark.slow
def test_a_search_says_that_it_went_on_to_lower_the_cost(levade) -> None:
    out = levade("solve", "rearing", *QUICK, *LOOSE, "--set", "search.polish=8")[1]
    assert "Success at trial 8; it went on to lower the cost: 16 trials in " in out
