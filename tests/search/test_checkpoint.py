"""The checkpoint's own file: what is written is read, and damage of any kind ends it where it begins."""

from __future__ import annotations

import json
import pickle
import random
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.cli.app import main
from levade.errors import LevadeError
from levade.search import Evaluation, Record
from levade.search import checkpoint as checkpoints
from levade.search.checkpoint import CHECKPOINT, Header, LayoutError
from levade.search.evaluation import Trials
from levade.search.loop import solve
from levade.search.objective import make_objective
from levade.search.run import TASK, read_run, run
from levade.tasks import load_task

Mistaken = Callable[[Any, random.Random], Any]

HEADER = Header("rearing", 3, {"levade": "1.0"}, 17, {"candidates": [[0.5, -0.25]], "step": 1.0, "factor": None})


def a_record(number: int) -> Record:
    chance = np.random.default_rng(number)
    terms = {"effort": chance.normal(size=3), "pitch": np.array([1e-300, np.nan, np.inf])}
    errors, slack = {"pitch": chance.normal(size=3)}, {"height": chance.normal(size=3)}
    return Record(number, Evaluation(terms, errors, np.array([True, False, True]), np.zeros(3, dtype=bool), slack))


RECORDS = [a_record(number) for number in range(4)]


def written(directory: Path, *, finished: bool = False) -> str:
    file = checkpoints.begin(directory, HEADER, RECORDS[:2])
    for record in RECORDS[2:]:
        checkpoints.add(file, record)
    if finished:
        checkpoints.finish(file)
    file.close()
    return (directory / CHECKPOINT).read_text(encoding="utf-8")


def plain(records: list[Record]) -> list[str]:
    return [json.dumps(record.to_json()) for record in records]


@pytest.mark.parametrize("finished", [False, True])
def test_what_is_written_is_read(tmp_path: Path, finished: bool) -> None:
    text = written(tmp_path, finished=finished)
    found = checkpoints.read(tmp_path)
    assert found.header == HEADER
    assert plain(found.records) == plain(RECORDS)
    assert (found.finished, found.damage) == (finished, None)
    again = checkpoints.begin(tmp_path, found.header, found.records)
    if finished:
        checkpoints.finish(again)
    again.close()
    assert (tmp_path / CHECKPOINT).read_text() == text


def test_one_of_the_layout_before_is_read(tmp_path: Path) -> None:
    lines = [HEADER.to_json() | {"format": 2}, *(record.to_json() for record in RECORDS), {"finished": True}]
    (tmp_path / CHECKPOINT).write_text("".join(json.dumps(line) + "\n" for line in lines))
    found = checkpoints.read(tmp_path)
    assert (found.header, found.finished, found.damage) == (HEADER, True, None)
    assert plain(found.records) == plain(RECORDS)


def test_a_line_that_was_changed_or_moved_or_lost_ends_it_there(tmp_path: Path) -> None:
    lines = written(tmp_path).splitlines(keepends=True)
    changed = [*lines[:2], lines[2].replace("true", "false", 1), *lines[3:]]
    moved = [*lines[:2], lines[3], lines[2], lines[4]]
    lost = [*lines[:2], *lines[3:]]
    twice = [*lines[:3], *lines[2:]]
    for kept, left in ((changed, 1), (moved, 1), (lost, 1), (twice, 2)):
        (tmp_path / CHECKPOINT).write_text("".join(kept))
        found = checkpoints.read(tmp_path)
        assert plain(found.records) == plain(RECORDS[:left])
        assert found.damage is not None
        assert f"line {left + 2} of {len(kept)} is damaged" in found.damage
    (tmp_path / CHECKPOINT).write_text("".join([lines[0].replace('"seed": 3', '"seed": 4'), *lines[1:]]))
    with pytest.raises(LevadeError, match="damaged, its first line is no header; start again"):
        checkpoints.read(tmp_path)


def damaged(text: str, chance: random.Random) -> bytes:
    """A few bytes that are others, gone, or there again."""
    data = bytearray(text.encode())
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(data))
        to = at + chance.choice([1, 3, 200])
        kind = chance.randrange(4)
        if kind == 0:
            data[at] = chance.randrange(256)
        elif kind == 1:
            del data[at:to]
        elif kind == 2:
            data[at:at] = data[at:to]
        else:
            data[at:at] = chance.choice(
                [b"\n", b"\0", b"[" * 100_000, b"9" * 5000, b"\xff", b"\r", b"\xe2\x80\xa8", b"NaN"]
            )
    return bytes(data)


@pytest.mark.slow
def test_whatever_is_damaged_what_is_read_was_written(tmp_path: Path) -> None:
    text, path = written(tmp_path, finished=True), tmp_path / CHECKPOINT
    known, counts = plain(RECORDS), set()
    for seed in range(200):
        path.write_bytes(damaged(text, random.Random(seed)))
        try:
            found = checkpoints.read(tmp_path)
        except LevadeError as error:
            said = str(error)
            counts.add(-1)
        else:
            said = found.damage or ""
            assert found.header == HEADER
            assert plain(found.records) == known[: len(found.records)]
            counts.add(len(found.records))
        assert said == "" or (said.isprintable() and len(said) < 1500), seed
    assert counts == {-1, 0, 1, 2, 3, 4}


@pytest.mark.parametrize(
    "change",
    [
        {"terms": {"effort": [1.0, 2.0]}},
        {"terms": {"effort": 1.0}},
        {"terms": {"effort": [1.0, 2.0, "3"]}},
        {"terms": {"effort": [1.0, 2.0, True]}},
        {"terms": {"effort": [[1.0], [2.0], [3.0]]}},
        {"terms": [1.0]},
        {"errors": None},
        {"slack": {"height": [10**400, 0, 0]}},
        {"success": [1, 0, 1]},
        {"success": "yes"},
        {"success": [], "diverged": [], "terms": {}, "errors": {}, "slack": {}},
        {"diverged": [True]},
        {"checksum": "1"},
        {"checksum": True},
    ],
)
def test_a_record_of_another_shape_is_damage(tmp_path: Path, change: dict) -> None:
    """Its running checksum is right: someone wrote it."""
    file = checkpoints.begin(tmp_path, HEADER, RECORDS[:1])
    file.add(RECORDS[1].to_json() | change)
    file.close()
    found = checkpoints.read(tmp_path)
    assert plain(found.records) == plain(RECORDS[:1])
    assert found.damage is not None


def test_an_error_of_the_layout_survives_another_process() -> None:
    error = pickle.loads(pickle.dumps(LayoutError("checkpoint.jsonl: layout 1", finished=True)))
    assert (type(error), str(error), error.finished) == (LayoutError, "checkpoint.jsonl: layout 1", True)


SMALL = ["search.population=6", "search.trials=12", "hold=0.02", "horizon=0.1"]


@pytest.mark.slow
def test_records_of_other_costs_or_criteria_are_refused() -> None:
    objective = make_objective(load_task("rearing", changes=SMALL), threads=1)
    asked: list[Trials] = []
    evaluate = objective.evaluate

    def remembered(trials: Trials) -> Evaluation:
        asked.append(trials)
        return evaluate(trials)

    kept: list[Record] = []
    objective.evaluate = remembered  # type: ignore[method-assign]
    solve(objective, keep=kept.append)
    first = kept[0].evaluation
    for terms, errors in (
        ({}, first.errors),
        (first.terms, {}),
        ({**first.terms, "x": first.terms["effort"]}, first.errors),
    ):
        wrong = Record(kept[0].checksum, Evaluation(terms, errors, first.success, first.diverged, first.slack))
        with pytest.raises(LevadeError, match="record 1 belongs to another search"):
            solve(objective, records=[wrong])


@pytest.mark.slow
def test_a_run_with_a_broken_checkpoint_goes_on_or_is_refused_in_one_line(
    tmp_path: Path, mistaken: Mistaken, capfd: pytest.CaptureFixture[str]
) -> None:
    """Half of them are damaged; half were written so, with running checksums that are right."""
    directory = tmp_path / "run"
    run(load_task("rearing", changes=SMALL), seed=3, threads=1, directory=directory)
    checkpoint, text = read_run(directory)[1], (directory / CHECKPOINT).read_text()
    task, statuses = (directory / TASK).read_bytes(), []
    for seed in range(24):
        chance = random.Random(seed)
        if seed % 2:
            (directory / CHECKPOINT).write_bytes(damaged(text, chance))
        else:
            lines = [checkpoint.header.to_json(), *(record.to_json() for record in checkpoint.records)]
            at = chance.randrange(len(lines))
            lines[at] = mistaken(lines[at], chance)
            (directory / CHECKPOINT).write_text("")
            with (directory / CHECKPOINT).open("w", encoding="utf-8") as file:
                writer = checkpoints.Writer(file, 0)
                for line in lines:
                    writer.add(line)
        capfd.readouterr()
        begin = time.process_time()
        with pytest.raises(SystemExit) as ended:
            main(["solve", "--resume", str(directory), "--threads", "1"])
        assert time.process_time() - begin < 10, seed
        said = capfd.readouterr().err
        statuses.append(ended.value.code)
        assert ended.value.code in (0, 1, 2), seed
        if ended.value.code == 2:
            assert said.startswith("levade: "), said
            assert said[:-1].isprintable(), said
            assert len(said) < 2000, said
        (directory / TASK).write_bytes(task)
    assert 2 in statuses
    assert {0, 1} & set(statuses)
