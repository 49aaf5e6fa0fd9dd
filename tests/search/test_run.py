"""Runs: a directory that keeps everything, whatever happens to the process or the disk."""

from __future__ import annotations

import csv
import dataclasses
import errno
import json
import os
import signal
import subprocess
import sys
import time
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.cli import main
from levade.errors import LevadeError
from levade.motions import ARRAYS, Motion
from levade.optimizers import OPTIMIZERS
from levade.search import Evaluation, Generation, Objective, Stopped, Trials, make_objective
from levade.search import checkpoint as checkpoints
from levade.search import run as run_module
from levade.search.run import (
    CHECKPOINT,
    MOTION,
    PROGRESS,
    TASK,
    Outcome,
    check_replaceable,
    read_run,
    resume,
    run,
)
from levade.tasks import load_task

SameEnd = Callable[[Path, Outcome], None]
GENERATIONS = 10
CHANGES = [
    "search.optimizer=cma",
    "search.population=8",
    "search.trials=80",
    "horizon=0.1",
    "success.height.tolerance=0",
]


@pytest.fixture(scope="module")
def objective() -> Objective:
    return make_objective(load_task("rearing", changes=CHANGES), threads=1)


@pytest.fixture(scope="module")
def whole(objective: Objective, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """A run that nothing interrupted."""
    return run(objective, seed=3, directory=tmp_path_factory.mktemp("runs") / "deep" / "whole")


def stop_after(generations: int) -> Callable[[Generation], None]:
    def observe(generation: Generation) -> None:
        if generation.generation == generations:
            raise KeyboardInterrupt

    return observe


@pytest.fixture(scope="module")
def assert_same_end(assert_same_files: Callable[[Path, Path], None]) -> SameEnd:
    return lambda directory, whole: assert_same_files(directory, whole.directory)


def records(directory: Path) -> int:
    """How many evaluations the checkpoint of a run has."""
    return len(read_run(directory)[1].records)


def test_what_a_run_leaves(whole: Outcome, objective: Objective) -> None:
    directory = whole.directory
    assert sorted(path.name for path in directory.iterdir()) == sorted([TASK, MOTION, PROGRESS, CHECKPOINT])
    assert load_task(directory / TASK) == objective.task
    assert Motion.load(directory / MOTION).meta == whole.motion.meta
    assert (whole.solution.trials, whole.solution.stopped, whole.seed) == (80, "budget", 3)
    with (directory / PROGRESS).open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [int(row["trials"]) for row in rows] == list(range(8, 81, 8))
    best = [float(row["cost_best"]) for row in rows]
    assert best == sorted(best, reverse=True)
    assert best[-1] == pytest.approx(whole.solution.best.cost, rel=1e-8)
    last = rows[-1]
    assert float(last["error_pitch"]) == pytest.approx(whole.solution.best.errors["pitch"], rel=1e-8)
    assert float(last["term_effort"]) == pytest.approx(whole.solution.best.terms["effort"], rel=1e-8)
    assert {row["stage"] for row in rows} <= {stage.name for stage in objective.task.stages}
    for row in rows:
        low, middle, high = (float(row[f"cost_generation_{name}"]) for name in ("best", "median", "worst"))
        assert low <= middle <= high


@pytest.mark.slow
def test_the_task_that_is_left_gives_the_run_again(whole: Outcome, tmp_path: Path, assert_same_end: SameEnd) -> None:
    run(load_task(whole.directory / TASK), seed=3, threads=2, directory=tmp_path / "again")
    assert_same_end(tmp_path / "again", whole)


@pytest.mark.slow
@pytest.mark.parametrize("generations", [1, 4, 9, 10])
def test_an_interrupted_run_goes_on_to_the_same_end(
    objective: Objective, whole: Outcome, tmp_path: Path, generations: int, assert_same_end: SameEnd
) -> None:
    part = run(objective, seed=3, directory=tmp_path, observe=stop_after(generations))
    assert part.solution.stopped == "interrupted"
    assert Motion.load(tmp_path / MOTION).meta["trials"] == 8 * generations
    assert records(tmp_path) == generations
    resume(tmp_path, threads=2)
    assert_same_end(tmp_path, whole)


def test_a_task_with_integers_from_python_goes_on(objective: Objective, tmp_path: Path) -> None:
    """A file reads 0 as 0.0 where a number belongs: the same task, and the second search of a pursuit has such a setting."""
    task = objective.task
    search = dataclasses.replace(task.search, optimizer="cma-aimed", settings={"aimed": 0})
    counted = dataclasses.replace(task, hold=0, search=search)
    run(counted, seed=3, threads=1, directory=tmp_path, observe=stop_after(2))
    outcome = resume(tmp_path, threads=1, observe=lambda g: Stopped.INTERRUPTED if g.generation == 4 else None)
    assert outcome.solution.generations == 4
    assert records(tmp_path) == 4


@pytest.mark.slow
def test_an_observer_ends_a_run_as_ctrl_c_does(
    objective: Objective, whole: Outcome, tmp_path: Path, assert_same_end: SameEnd
) -> None:
    run(objective, seed=3, directory=tmp_path / "raised", observe=stop_after(4))
    asked = run(
        objective,
        seed=3,
        directory=tmp_path / "asked",
        observe=lambda g: Stopped.INTERRUPTED if g.generation == 4 else None,
    )
    assert asked.solution.stopped is Stopped.INTERRUPTED
    assert_same_end(tmp_path / "asked", dataclasses.replace(whole, directory=tmp_path / "raised"))
    resume(tmp_path / "asked")
    assert_same_end(tmp_path / "asked", whole)


@pytest.mark.slow
def test_ctrl_c_in_a_simulation_loses_that_generation_alone(
    objective: Objective, whole: Outcome, tmp_path: Path, assert_same_end: SameEnd
) -> None:
    other, left, evaluate = objective.with_task(objective.task), 6, objective.evaluate

    def interrupted(trials: Trials) -> Evaluation:
        nonlocal left
        left -= 1
        if left == 0:
            raise KeyboardInterrupt
        return evaluate(trials)

    other.evaluate = interrupted  # type: ignore[method-assign]
    part = run(other, seed=3, directory=tmp_path)
    assert (part.solution.stopped, part.solution.generations, part.solution.trials) == ("interrupted", 5, 40)
    assert records(tmp_path) == 5
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


@pytest.mark.slow
@pytest.mark.parametrize("optimizer", [name for name in OPTIMIZERS if name != "cma"])
def test_a_run_of_any_optimizer_goes_on_to_the_same_end(
    tmp_path: Path, optimizer: str, assert_same_end: SameEnd
) -> None:
    """Through a stage that changes the step."""
    stages = "stages=[{name: first, trials: 24}, {name: second, step: 0.5}]"
    changes = [*CHANGES, f"search.optimizer={optimizer}", stages]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    whole = run(objective, seed=3, directory=tmp_path / "whole")
    run(objective, seed=3, directory=tmp_path / "part", observe=stop_after(5))
    resume(tmp_path / "part", threads=2)
    assert_same_end(tmp_path / "part", whole)
    other = run(objective, seed=4, directory=tmp_path / "other")
    assert not np.array_equal(other.motion["weights"], whole.motion["weights"])


@pytest.mark.slow
def test_a_run_from_when_the_default_was_called_levade_goes_on_to_the_same_end(tmp_path: Path) -> None:
    """Its task file has the alias, and its checkpoint the checksum of that file."""
    changes = [*CHANGES, "search.optimizer=cma-aimed"]
    whole = run(load_task("rearing", changes=changes), seed=3, threads=1, directory=tmp_path / "whole")
    part = tmp_path / "part"
    run(load_task("rearing", changes=changes), seed=3, threads=1, directory=part, observe=stop_after(3))
    text = (part / TASK).read_text()
    assert text.count("optimizer: cma-aimed\n") == 1
    text = text.replace("optimizer: cma-aimed\n", "optimizer: levade\n")
    keys = (
        "  room: null",
        "  slew: null",
        "  through: []",
        "  sketches: 0",
        "  patience: null",
        "hardware: null",
        "good_enough: {}",
    )
    for later in (f"{key}\n" for key in keys):
        assert text.count(later) == 1
        text = text.replace(later, "")
    (part / TASK).write_text(text)
    assert json.loads((part / CHECKPOINT).read_text().splitlines()[0])["task_checksum"] == zlib.crc32(text.encode())
    assert load_task(part / TASK) == load_task(tmp_path / "whole" / TASK)
    assert resume(part, threads=1).motion.meta == whole.motion.meta
    assert (part / CHECKPOINT).read_bytes() == (tmp_path / "whole" / CHECKPOINT).read_bytes()


@pytest.mark.slow
def test_it_may_be_interrupted_again_and_again(
    objective: Objective, whole: Outcome, tmp_path: Path, assert_same_end: SameEnd
) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(2))
    for generations in (2, 3, 7):  # the first of them before anything new
        assert resume(tmp_path, observe=stop_after(generations)).solution.stopped == "interrupted"
    simulated: list[bool] = []
    resume(tmp_path, observe=lambda g: simulated.append(not g.replayed))
    assert simulated == [False] * 7 + [True] * 3
    assert_same_end(tmp_path, whole)


@pytest.mark.slow
def test_a_finished_run_resumed_is_the_run(
    whole: Outcome, objective: Objective, tmp_path: Path, assert_same_end: SameEnd
) -> None:
    run(objective, seed=3, directory=tmp_path)
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


@pytest.mark.slow
@pytest.mark.parametrize("cut", [1, 7, 200, 201])
def test_a_line_that_was_cut_off_is_computed_anew(
    objective: Objective, whole: Outcome, tmp_path: Path, cut: int, assert_same_end: SameEnd
) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(5))
    path = tmp_path / CHECKPOINT
    path.write_bytes(path.read_bytes()[:-cut])
    with (tmp_path / PROGRESS).open("a") as file:
        file.write("6,4")
    assert records(tmp_path) == 5 - (cut > 1)  # without its line break a line is whole
    assert read_run(tmp_path)[1].damage is None
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


@pytest.mark.slow
@pytest.mark.parametrize("broken", [1, 3])
def test_a_damaged_line_is_told_and_what_follows_computed_anew(
    objective: Objective,
    whole: Outcome,
    tmp_path: Path,
    broken: int,
    capfd: pytest.CaptureFixture[str],
    assert_same_end: SameEnd,
) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(5))
    path = tmp_path / CHECKPOINT
    lines = path.read_text().splitlines()
    lines[broken] = lines[broken].replace('"success"', '"succes"')
    path.write_text("".join(line + "\n" for line in lines))
    assert records(tmp_path) == broken - 1
    with pytest.raises(LevadeError, match="holds an interrupted run"):
        check_replaceable(tmp_path)
    with pytest.raises(SystemExit):
        main(["solve", "--resume", str(tmp_path)])
    told = " ".join(capfd.readouterr().out.split())
    assert f"line {broken + 1} of 6 is damaged; what was recorded from there on is simulated again" in told
    assert_same_end(tmp_path, whole)
    assert read_run(tmp_path)[1].damage is None


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    ["", "{}", "[]", "3", '"text"', "null", '{"generation": 6, "checksum": 1, "terms": [], "errors": []}', "\0\0\0"],
)
def test_rubbish_after_the_last_line_is_left_out(
    objective: Objective, whole: Outcome, tmp_path: Path, line: str, assert_same_end: SameEnd
) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(3))
    with (tmp_path / CHECKPOINT).open("a") as file:
        file.write(line + "\n")
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


HEADER = '{"task": "rearing", "seed": %s, "versions": %s, "task_checksum": 1, "format": %s}'


@pytest.mark.slow
@pytest.mark.parametrize(
    ("first", "message"),
    [
        ("", "damaged, its first line is no header; start again"),
        ("{}", "damaged, its first line is no header"),
        ("[1]", "damaged, its first line is no header"),
        ('{"seed": "x", "versions": {}}', "damaged, its first line is no header"),
        ('{"seed": 1, "versions": [1]}', "damaged, its first line is no header"),
        (HEADER % ('"x"', "{}", 2), "damaged, its first line is no header"),
        (HEADER % (1, "[1]", 2), "damaged, its first line is no header"),
        (HEADER[:-1] % (1, "{}", 2) + ', "more": 1}', "damaged, its first line is no header"),
        ('{"seed": 3, "versions": {}, "format": 2}', "damaged, its first line is no header"),
        (HEADER % (3, '{"mujoco": "1.0"}', 2), r"was started with mujoco 1\.0, this is .*install mujoco==1\.0"),
        (
            HEADER % (3, '{"blas": "openblas 9 Z80"}', 2),
            r"was started with blas openblas 9 Z80, this is \w.*; go on with a processor of that kind, or start again$",
        ),
        ('{"task": "rearing", "seed": 3, "versions": {}}', "layout 1, but this levade reads layout 3; start again"),
        (HEADER % (3, "{}", 4), "layout 4, but this levade reads layout 3; .* the levade that wrote it"),
        (HEADER % (3, "{}", 3), "damaged, its first line is no header"),
        (HEADER % (-3, "{}", 2), "damaged, its first line is no header"),
        (HEADER % (3, '{"mujoco": "\\u001b[2J"}', 2), "damaged, its first line is no header"),
        (HEADER[:-1] % (3, "{}", 2) + ', "initial": {"step": 1}}', "damaged, its first line is no header"),
    ],
)
def test_headers_that_do_not_fit(objective: Objective, tmp_path: Path, first: str, message: str) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(2))
    path = tmp_path / CHECKPOINT
    path.write_text("\n".join([first, *path.read_text().splitlines()[1:]]))
    before = path.read_bytes()
    with pytest.raises(LevadeError, match=message):
        resume(tmp_path)
    assert path.read_bytes() == before


def test_a_task_that_was_changed_in_between_is_refused(objective: Objective, tmp_path: Path) -> None:
    """Stored costs of trials would be mixed with new ones."""
    run(objective, seed=3, directory=tmp_path, observe=stop_after(3))
    text = (tmp_path / TASK).read_text()
    assert "weight: 0.1" in text
    (tmp_path / TASK).write_text(text.replace("weight: 0.1", "weight: 0.2"))
    with pytest.raises(
        LevadeError, match=r"task.yaml: has changed since the run began, .*; put it back or start again"
    ):
        resume(tmp_path)
    (tmp_path / TASK).write_text("horizon: [")
    with pytest.raises(LevadeError, match=r"task.yaml: not YAML"):
        resume(tmp_path)


@pytest.mark.slow
def test_records_of_another_seed_are_refused(objective: Objective, tmp_path: Path) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(3))
    checkpoint = read_run(tmp_path)[1]
    checkpoints.begin(tmp_path, dataclasses.replace(checkpoint.header, seed=4), checkpoint.records).close()
    with pytest.raises(LevadeError, match="record 1 belongs to another search"):
        resume(tmp_path)


def test_there_has_to_be_a_run(tmp_path: Path, whole: Outcome) -> None:
    with pytest.raises(
        LevadeError, match=r"no run to resume, task.yaml or checkpoint.jsonl is missing; give the directory of a run"
    ):
        resume(tmp_path)
    with pytest.raises(LevadeError, match="no run to resume"):
        resume(whole.directory / MOTION)


@pytest.mark.slow
def test_an_interrupted_run_is_not_replaced_unasked(
    objective: Objective, whole: Outcome, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check_replaceable(tmp_path / "new")
    check_replaceable(whole.directory)  # finished: solving again replaces it
    run(objective, seed=3, directory=tmp_path, observe=stop_after(3))
    with pytest.raises(
        LevadeError, match=r"holds an interrupted run \(seed 3\); go on with it, replace it or write elsewhere"
    ):
        check_replaceable(tmp_path)
    with pytest.raises(SystemExit):
        main(["solve", "rearing", "--out", str(tmp_path)])
    assert capsys.readouterr().err == (
        f"levade: {tmp_path}: holds an interrupted run (seed 3); go on with it: levade solve --resume {tmp_path},"
        " replace it: --force, or write elsewhere: --out DIR\n"
    )


def test_an_interrupted_run_of_an_earlier_levade_is_not_replaced_unasked(objective: Objective, tmp_path: Path) -> None:
    run(objective, seed=3, directory=tmp_path, observe=stop_after(3))
    path = tmp_path / CHECKPOINT
    path.write_text(path.read_text().replace('"format": 3', '"format": 1', 1))
    with pytest.raises(LevadeError, match=r"layout 1, but this levade reads layout 3; .*replace it or write elsewhere"):
        check_replaceable(tmp_path)
    with path.open("a") as file:
        file.write('{"finished": true}\n')
    check_replaceable(tmp_path)


@pytest.mark.parametrize("name", [TASK, MOTION, PROGRESS])
def test_files_of_ones_own_are_not_replaced_unasked(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("mine")
    told = f"{name}: exists but does not belong to a run, and would be overwritten; write elsewhere or replace it"
    with pytest.raises(LevadeError, match=told):
        check_replaceable(tmp_path)


@pytest.mark.slow
def test_a_run_replaces_a_run(objective: Objective, whole: Outcome, tmp_path: Path, assert_same_end: SameEnd) -> None:
    run(objective, seed=9, directory=tmp_path, observe=stop_after(3))
    run(objective, seed=3, directory=tmp_path)
    assert_same_end(tmp_path, whole)


@pytest.mark.parametrize("where", ["file/below", "/proc/levade", "/dev/null/levade"])
def test_a_directory_that_cannot_be_written(objective: Objective, tmp_path: Path, where: str) -> None:
    (tmp_path / "file").write_text("x")
    with pytest.raises(LevadeError, match=r"cannot be written \(.+\); give another directory"):
        run(objective, directory=tmp_path / where)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


class FullDisk:
    """Writes fail once so many bytes have been taken; what fits of the last one is written, as the system does it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, room: int) -> None:
        self.room = room
        self._open = Path.open
        monkeypatch.setattr(Path, "open", lambda path, *args, **options: self.open(path, *args, **options))
        monkeypatch.setattr(Path, "write_text", lambda path, text, **options: self.write_text(path, text, **options))

    def open(self, path: Path, mode: str = "r", *args: Any, **options: Any) -> Any:
        file = self._open(path, mode, *args, **options)
        if set(mode) & {"w", "a"}:
            write, close, flush, pending = file.write, file.close, file.flush, []

            def full_write(data: Any) -> int:
                pending.append(data)
                return len(data)

            def full_flush() -> None:
                while pending:
                    if len(pending[0]) > self.room:
                        write(pending[0][: self.room])
                        pending[0], self.room = pending[0][self.room :], 0
                        flush()
                        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
                    self.room -= len(pending[0])
                    write(pending.pop(0))
                flush()

            def full_close() -> None:
                try:
                    full_flush()
                finally:
                    close()

            class Proxy:
                def __getattr__(self, name: str) -> Any:
                    known = {"write": full_write, "flush": full_flush, "close": full_close}
                    return known[name] if name in known else getattr(file, name)

                def __enter__(self) -> Proxy:
                    return self

                def __exit__(self, *_: object) -> None:
                    full_close()

                def __iter__(self) -> Any:
                    return iter(file)

            return Proxy()
        return file

    def write_text(self, path: Path, text: str, **options: Any) -> None:
        with self.open(path, "w", **options) as file:
            file.write(text)


@pytest.mark.slow
@pytest.mark.parametrize("room", [0, 500, 3000])
def test_a_disk_that_is_full_at_the_start(
    objective: Objective, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, room: int
) -> None:
    """Nothing of an earlier run is lost, and no new directory is left behind."""
    run(objective, seed=9, directory=tmp_path / "old")
    before = {path.name: path.read_bytes() for path in (tmp_path / "old").iterdir()}
    with monkeypatch.context() as patch:
        FullDisk(patch, room if room < 3000 else len(before[TASK]))
        with pytest.raises(LevadeError, match=r"cannot be written \(No space left on device\)"):
            run(objective, seed=3, directory=tmp_path / "new")
        if room < 3000:
            with pytest.raises(LevadeError, match=r"cannot be written \(No space left on device\)"):
                run(objective, seed=3, directory=tmp_path / "old")
    if room < 3000:
        with monkeypatch.context() as patch:  # the task fits, the checkpoint does not
            FullDisk(patch, len(before[TASK]))
            with pytest.raises(LevadeError, match=r"cannot be written \(No space left on device\)"):
                run(objective, seed=3, directory=tmp_path / "old")
    assert {path.name: path.read_bytes() for path in (tmp_path / "old").iterdir()} == before
    if room < 3000:
        assert not (tmp_path / "new").exists()


@pytest.mark.slow
@pytest.mark.parametrize("room", [5_000, 9_000, 14_000])
def test_a_disk_that_fills_up_on_the_way(
    objective: Objective,
    whole: Outcome,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    room: int,
    assert_same_end: SameEnd,
) -> None:
    """One line says so, and when there is room again the run goes on to the same end."""
    generations: list[int] = []
    with monkeypatch.context() as patch:
        FullDisk(patch, room)
        with pytest.raises(
            LevadeError, match=r"cannot be written.* \(No space left on device\).*make room, then go on"
        ) as e:
            run(objective, seed=3, directory=tmp_path, observe=lambda g: generations.append(g.generation))
    assert "\n" not in str(e.value)
    assert records(tmp_path) >= len(generations)
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


@pytest.mark.slow
def test_a_motion_that_does_not_fit_at_the_end(
    objective: Objective, whole: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, assert_same_end: SameEnd
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(np, "savez_compressed", full)
        with pytest.raises(LevadeError, match=r"motion.npz: cannot be written \(No space left on device\); make room"):
            run(objective, seed=3, directory=tmp_path)
    assert not (tmp_path / MOTION).exists()
    with pytest.raises(LevadeError, match="holds an interrupted run"):
        check_replaceable(tmp_path)
    resume(tmp_path)
    assert_same_end(tmp_path, whole)


def test_a_progress_file_that_cannot_be_written(objective: Objective, tmp_path: Path) -> None:
    (tmp_path / PROGRESS).mkdir()
    with pytest.raises(LevadeError, match=r"progress.csv: cannot be written \(Is a directory\)"):
        run(objective, directory=tmp_path)


@pytest.mark.slow
def test_the_best_so_far_is_written_on_the_way(
    objective: Objective, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_module, "_SAVE_EVERY", 0.0)
    best: list[float] = []

    def observe(generation: Generation) -> None:
        motion = Motion.load(tmp_path / MOTION)
        assert motion.meta["cost"] == generation.best.cost
        assert motion.meta["stopped"] == "running"
        best.append(generation.best.cost)

    run(objective, seed=3, directory=tmp_path, observe=observe)
    assert len(best) == GENERATIONS


def solve_in_a_process(directory: Path, *more: str) -> subprocess.Popen[str]:
    arguments = [f"--set={change}" for change in LONG]
    command = [sys.executable, "-m", "levade", "solve", "rearing", "--seed=3", f"--out={directory}", *arguments, *more]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


LONG = [
    "search.optimizer=cma",
    "search.population=8",
    "search.trials=4000",
    "success.height.tolerance=0",
    "horizon=0.6",
]


def wait_for_generations(directory: Path, process: subprocess.Popen[str], count: int) -> None:
    for _ in range(6000):
        if (directory / CHECKPOINT).exists() and (directory / CHECKPOINT).read_bytes().count(b"\n") > count:
            return
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    raise AssertionError("no generations within a minute")


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_process_that_is_stopped_can_be_gone_on_with(
    tmp_path: Path, number: signal.Signals, capsys: pytest.CaptureFixture[str]
) -> None:
    """The real thing: a signal in the middle, then as far as a run that was cut at the same place in its budget."""
    directory = tmp_path / "stopped"
    process = solve_in_a_process(directory)
    wait_for_generations(directory, process, 12)
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert err == ""
    if number == signal.SIGKILL:
        assert process.returncode == -signal.SIGKILL
    else:
        assert process.returncode == 1
        assert f"Interrupted after {8 * records(directory)} trials" in out
        assert f"To go on: levade solve --resume {directory}" in out
        assert Motion.load(directory / MOTION).meta["stopped"] == "interrupted"
    task, done = read_run(directory)[0], records(directory)
    assert 12 <= done < 500
    with pytest.raises(SystemExit) as ended:
        main(["solve", "rearing", f"--out={directory}"])
    said = capsys.readouterr()
    assert (ended.value.code, said.out) == (2, "")
    assert "holds an interrupted run (seed 3)" in said.err

    # both for twenty generations more, one of them from the start
    objective = make_objective(task)
    further = resume(directory, observe=stop_after(done + 20))
    straight = run(objective, seed=3, directory=tmp_path / "straight", observe=stop_after(done + 20))
    for name in ARRAYS:
        assert further.motion[name].tobytes() == straight.motion[name].tobytes(), name
    assert (directory / CHECKPOINT).read_bytes() == (tmp_path / "straight" / CHECKPOINT).read_bytes()


@pytest.mark.slow
def test_an_interrupted_process_resumes_to_its_end(tmp_path: Path, assert_same_end: SameEnd) -> None:
    """On the command line, to the end of the budget."""
    changes = [*CHANGES[:-1], "success.height.tolerance=0", "search.trials=400"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    run(objective, seed=3, directory=tmp_path / "one", observe=stop_after(20))
    command = [sys.executable, "-m", "levade", "solve", "--resume", str(tmp_path / "one"), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (1, "")
    straight = run(objective, seed=3, directory=tmp_path / "two")
    assert json.loads(done.stdout)["trials"] == straight.solution.trials == 400
    assert_same_end(tmp_path / "one", dataclasses.replace(straight, directory=tmp_path / "two"))
