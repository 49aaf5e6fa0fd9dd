"""Benches: results do not depend on processes or interruptions, and say what the solves did."""

from __future__ import annotations

import dataclasses
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from levade.bench import Plan, Progress, Result, bench, plan_of, read, report
from levade.bench.case import run_case
from levade.bench.comparison import RESULTS
from levade.bench.plan import cases
from levade.errors import LevadeError
from levade.search import Generation, make_objective, solve

QUICK = {"horizon": 0.06, "search.population": 8}
PLAN = Plan(tasks=("rearing",), optimizers=("cma", "random"), seeds=3, trials=40, changes=QUICK)
TIMES = ("core_seconds", "core_seconds_to_success")


def without_times(results: list[Result]) -> list[Result]:
    return [dataclasses.replace(result, **dict.fromkeys(TIMES, 0.0)) for result in results]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Result]]:
    """A bench that nothing interrupted, one case at a time."""
    directory = tmp_path_factory.mktemp("benches") / "deep" / "whole"
    done = bench(PLAN, directory, processes=1)
    assert done.left == 0
    return directory, done.results


@pytest.mark.slow
def test_a_result_is_what_the_solve_says(whole: tuple[Path, list[Result]]) -> None:
    directory, results = whole
    assert read(directory / RESULTS) == results
    assert plan_of(directory) == PLAN
    wanted = cases(PLAN)
    assert [result.key for result in results] == [case.key for case in wanted]
    for result, case in zip(results, wanted, strict=True):
        solution = solve(make_objective(case.task, threads=1), seed=case.seed)
        assert (result.trials, result.cost, result.diverged) == (solution.trials, solution.best.cost, solution.diverged)
        assert (result.success, result.trials_to_success) == (False, None)
        assert (result.stopped, result.budget_trials, result.until) == ("budget", 40, "success")
        assert result.steps == 40 * 30  # 0.06 s of 2 ms
        assert result.core_seconds > 0


@pytest.mark.slow
def test_results_do_not_depend_on_the_number_of_processes(whole: tuple[Path, list[Result]], tmp_path: Path) -> None:
    assert without_times(bench(PLAN, tmp_path, processes=3).results) == without_times(whole[1])


@pytest.mark.slow
def test_interrupted_it_keeps_what_is_done_and_goes_on(whole: tuple[Path, list[Result]], tmp_path: Path) -> None:
    seen: list[Progress] = []

    def stop_after_two(progress: Progress) -> None:
        seen.append(progress)
        if progress.done == 2:
            raise KeyboardInterrupt

    part = bench(PLAN, tmp_path, processes=1, observe=stop_after_two)
    assert (part.left, len(part.results), seen[0]) == (4, 2, Progress(0, 6, None))
    kept = (tmp_path / RESULTS).read_text()
    with (tmp_path / RESULTS).open("a") as file:
        file.write("rearing,hyq2max,ran")  # and a row that was cut off
    done: list[int] = []
    rest = bench(None, tmp_path, processes=2, observe=lambda progress: done.append(progress.done))
    assert (done[0], done[-1]) == (2, 6)
    assert without_times(rest.results) == without_times(whole[1])
    assert (tmp_path / RESULTS).read_text().startswith(kept.splitlines()[0])
    assert rest.results[:2] == part.results  # not run again: the same times


@pytest.mark.slow
def test_finished_it_has_nothing_to_do_and_more_seeds_are_added(
    whole: tuple[Path, list[Result]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    directory, results = whole
    started: list[str] = []
    monkeypatch.setattr("levade.bench.pool._Worker", lambda: started.append("a process"))
    assert bench(None, directory) == bench(PLAN, directory, processes=8)
    assert bench(None, directory).results == results
    assert started == []


@pytest.mark.slow
def test_other_tasks_budgets_or_versions_are_not_mixed(
    whole: tuple[Path, list[Result]], monkeypatch: pytest.MonkeyPatch
) -> None:
    directory, results = whole
    before = (directory / RESULTS).read_bytes()
    for other in ({"trials": 48}, {"steps": 1e5}, {"changes": {**QUICK, "horizon": 0.08}}):
        with pytest.raises(LevadeError, match=r"has rearing on hyq2max, cma, seed 0 with another task, budget or end"):
            bench(dataclasses.replace(PLAN, **other), directory)
    with pytest.raises(LevadeError, match="is in this bench and in what is added to it"):
        bench(PLAN, directory, others=results[:1])
    monkeypatch.setattr("levade.bench.comparison.made_with", lambda: "levade 9")
    with pytest.raises(LevadeError, match=r"was made with levade .*, this is levade 9; write elsewhere"):
        bench(PLAN, directory)
    assert (directory / RESULTS).read_bytes() == before


@pytest.mark.slow
def test_force_begins_anew(tmp_path: Path) -> None:
    small = dataclasses.replace(PLAN, seeds=1, optimizers=("random",))
    bench(small, tmp_path)
    other = bench(dataclasses.replace(small, trials=48), tmp_path, force=True)
    assert [result.budget_trials for result in other.results] == [48]


def easy(**changes: object) -> Plan:
    criteria = {"pitch": {"quantity": "pitch", "target": 0, "tolerance": 9, "at": "horizon"}}
    return dataclasses.replace(PLAN, optimizers=("cma",), seeds=1, changes={**QUICK, "success": criteria, **changes})


STAGES = [{"name": "full"}]


@pytest.mark.slow
def test_spent_to_success_is_counted_in_whole_generations() -> None:
    """Every trial succeeds: the first generation does, and polishing spends more."""
    (case,) = cases(easy(**{"search.polish": 16, "stages": STAGES}))
    result = run_case(case)
    assert (result.success, result.stopped) == (True, "success")
    assert (result.trials_to_success, result.trials) == (8, 24)
    assert (result.steps_to_success, result.steps) == (8 * 30, 24 * 30)
    assert result.core_seconds_to_success is not None
    assert 0 < result.core_seconds_to_success <= result.core_seconds
    assert result.cost_to_success is not None
    assert result.cost <= result.cost_to_success
    (through,) = cases(dataclasses.replace(easy(stages=STAGES), until="budget"))
    result = run_case(through)
    assert (result.trials_to_success, result.trials, result.stopped) == (8, 40, "budget")


@pytest.mark.slow
def test_a_budget_of_physics_steps_ends_a_run_with_the_generation_that_spends_it() -> None:
    (case,) = cases(dataclasses.replace(PLAN, optimizers=("cma",), seeds=1, steps=500.0))
    result = run_case(case)
    assert (result.stopped, result.trials, result.steps, result.budget_steps) == ("steps", 24, 720, 500)


@pytest.mark.slow
def test_what_is_simulated_twice_is_counted_twice() -> None:
    """With none of the hold simulated, trials that succeed so far are simulated again, through all of it."""
    stages = [{"name": "full", "hold": False}]
    (case,) = cases(easy(hold=0.04, stages=stages, **{"search.polish": 0}))
    result = run_case(case)
    every_trial, all_again, best_at_the_end = 8 * 30, 8 * 50, 50
    assert result.steps_to_success == every_trial + all_again
    assert result.steps == every_trial + all_again + best_at_the_end


@pytest.mark.slow
def test_the_engine_counts_steps() -> None:
    objective = make_objective(cases(PLAN)[0].task, threads=1)
    before = objective.engine.steps
    seen: list[int] = []

    def watch(generation: Generation) -> None:
        seen.append(objective.engine.steps - before)

    solve(objective, observe=watch)
    assert seen == [240, 480, 720, 960, 1200]


@pytest.mark.slow
def test_the_report(whole: tuple[Path, list[Result]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written, missing = report(whole[1], tmp_path, format="svg")
    assert [path.name for path in written] == ["table.md", "trials.svg", "steps.svg", "results.parquet"]
    assert missing == []
    assert "| random | 0/3 | ∞ |" in (tmp_path / "table.md").read_text()
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    written, missing = report(whole[1], tmp_path)
    assert [path.name for path in written] == ["table.md"]
    assert [reason.split("; ")[1] for reason in missing] == ["pip install 'levade[bench]'"] * 2


@pytest.mark.slow
def test_a_case_that_does_not_fit_says_which(tmp_path: Path) -> None:
    """The first optimizer's task is put together before anything is written, another's in its process."""
    plan = dataclasses.replace(
        PLAN, seeds=1, optimizers={"cma": {}, "narrow": {"policy.groups": [["lf", "rf"], ["lh"]]}}
    )
    with pytest.raises(LevadeError, match=r"^rearing on hyq2max, narrow, seed 0: policy.groups: rh in no group"):
        bench(plan, tmp_path)
    assert [result.optimizer for result in read(tmp_path / RESULTS)] == ["cma"]


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="signals as POSIX has them")
def test_a_process_that_dies_is_said_and_what_is_done_is_kept(tmp_path: Path) -> None:
    def kill_the_next(progress: Progress) -> None:
        if progress.done == 1:
            import multiprocessing

            for child in multiprocessing.active_children():
                assert child.pid is not None
                os.kill(child.pid, signal.SIGKILL)

    with pytest.raises(
        LevadeError, match=r"seed 1: the process that ran it died \(exit code -9\); what is done is kept"
    ):
        bench(PLAN, tmp_path, processes=1, observe=kill_the_next)
    assert len(read(tmp_path / RESULTS)) == 1


@pytest.mark.skipif(not hasattr(os, "fork"), reason="signals as POSIX has them")
@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_command_with_whole_rows_and_no_process_left(tmp_path: Path, number: signal.Signals) -> None:
    command = [
        sys.executable,
        "-m",
        "levade",
        "bench",
        "--tasks",
        "rearing",
        "--optimizers",
        "random",
        "--seeds",
        "500",
    ]
    command += ["--set", "horizon=0.06", "--trials", "40", "--processes", "2", "--out", str(tmp_path / "b"), "--json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
    path = tmp_path / "b" / RESULTS
    deadline = time.monotonic() + 120
    while not (path.exists() and path.read_bytes().count(b"\n") > 3):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    os.killpg(process.pid, number)  # as the keyboard does: to all of them
    out, err = process.communicate(timeout=120)
    assert process.returncode == 1, err
    assert b"Traceback" not in err
    assert out.startswith(b'{"left": ')
    assert len(read(path)) == path.read_bytes().count(b"\n") - 1 >= 3
    while running_in_group(process.pid):  # one that only looks after shared memory may take a moment
        assert time.monotonic() < deadline
        time.sleep(0.05)


def running_in_group(group: int) -> list[str]:
    """Processes of a group that are not merely waiting to be buried; by /proc, nothing where there is none."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, its_group = path.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(its_group) == group and state != "Z":
            found.append(path.parent.name)
    return found
