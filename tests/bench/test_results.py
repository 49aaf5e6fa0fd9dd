"""The file of results: every row whole, whatever happens, and every value what it was."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path

import pytest

from levade.bench.results import COLUMNS, append, read, write, write_parquet
from levade.errors import LevadeError


def test_rows_come_back_as_they_were(make, tmp_path: Path) -> None:
    path = tmp_path / "results.csv"
    rows = [make(200), make(None, seed=1, cost=0.1 + 0.2, budget_steps=10**9), make(3, seed=2, optimizer='a "b", c')]
    for row in rows:
        append(path, row)
    assert read(path) == rows
    assert path.read_text().splitlines()[0] == ",".join(COLUMNS)
    write(path, reversed(rows))
    assert read(path) == rows[::-1]
    assert [entry.name for entry in tmp_path.iterdir()] == ["results.csv"]


@pytest.mark.parametrize("cut", [1, 20, 90])
def test_a_row_that_was_cut_off_is_left_out(make, tmp_path: Path, cut: int) -> None:
    path = tmp_path / "results.csv"
    append(path, make(200))
    append(path, make(300, seed=1))
    path.write_bytes(path.read_bytes()[:-cut])
    assert read(path) == [make(200)]


def test_of_two_rows_of_one_run_the_first_counts(make, tmp_path: Path) -> None:
    path = tmp_path / "results.csv"
    append(path, make(200))
    append(path, make(300))
    assert read(path) == [make(200)]


def test_a_row_is_one_write(make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A full disk or a kill between two writes would leave half of one."""
    path = tmp_path / "results.csv"
    append(path, make(200))
    size = path.stat().st_size
    synced: list[int] = []
    monkeypatch.setattr(os, "fsync", lambda file: synced.append(os.fstat(file).st_size))
    append(path, make(300, seed=1))
    assert synced == [path.stat().st_size] > [size]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is no results.csv of a bench, or of another version"),
        ("generation,trials\n1,17\n", "is no results.csv of a bench"),
        (",".join(COLUMNS) + "\nrearing,hyq2max\n", "line 2 is damaged; remove it"),
        (",".join(COLUMNS) + "\n" + ",".join("x" for _ in COLUMNS) + "\n", "line 2 is damaged"),
    ],
)
def test_what_is_no_file_of_results(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "results.csv"
    path.write_text(text)
    with pytest.raises(LevadeError, match=message):
        read(path)
    with pytest.raises(LevadeError, match=r"none.csv: cannot be read \(No such file or directory\)"):
        read(tmp_path / "none.csv")


def test_a_file_that_cannot_be_written(make, tmp_path: Path) -> None:
    (tmp_path / "results.csv").mkdir()
    for do in (lambda path: append(path, make(1)), lambda path: write(path, [make(1)])):
        with pytest.raises(LevadeError, match=r"results.csv: cannot be written \(Is a directory\)"):
            do(tmp_path / "results.csv")


@pytest.mark.slow
def test_parquet_has_the_same_rows_with_their_types(make, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="needs the extra bench")
    rows = [make(200), make(None, seed=1)]
    write_parquet(tmp_path / "results.parquet", rows)
    table = parquet.read_table(tmp_path / "results.parquet")
    assert table.to_pylist() == [dataclasses.asdict(row) for row in rows]
    kinds = {field.name: str(field.type) for field in table.schema}
    assert (kinds["success"], kinds["trials_to_success"], kinds["cost"]) == ("bool", "int64", "double")
    assert [entry.name for entry in tmp_path.iterdir()] == ["results.parquet"]


def test_without_pyarrow_it_says_what_to_install(make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(LevadeError, match=r"Parquet needs pyarrow; pip install 'levade\[bench\]'"):
        write_parquet(tmp_path / "results.parquet", [make(1)])
