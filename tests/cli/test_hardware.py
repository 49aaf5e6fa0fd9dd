"""``levade solve --hardware``: what it prints, its exit status, and what it refuses."""

from __future__ import annotations

import functools
import json
import re
from pathlib import Path

import pytest
from tests.hardware.short import shorten

from levade import hardware
from levade.cli import pursuing

RUNS = 12
"""Perturbed runs of a certificate, instead of 500: what is tried here is what the command makes of it."""


@pytest.mark.slow
def test_the_certificate_decides(levade, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pursuing, "pursue", functools.partial(hardware.pursue, runs=RUNS))
    shorten(monkeypatch)
    short = [f"--set={one}" for one in ("horizon=2 falls", "hold=0.2", "physics={timestep: 0.004}")]
    status, out, err = levade("solve", "sit-to-stand", *short, "--hardware", "--json", "--out", "stand")
    assert (status, err.count("Traceback")) == (0, 0)
    content = json.loads(out)
    assert content["certificate"]["passed"] is True
    assert content["certificate"]["failed"] == content["obstacles"] == []
    *before, last = content["searches"]  # the first that surely passes is the last: of so few runs, all have to succeed
    assert (last["failed"], last["share"]) == ([], content["certificate"]["perturbed"]["share"])
    assert all(search["failed"] or search["share"] < 1 for search in before)
    assert {path.name for path in (tmp_path / "stand").iterdir()} == {
        *("motion.npz", "certificate.html", "certificate.json", "task.yaml", "hardware.json"),
        *(search["name"] for search in content["searches"]),
    }
    status, out, _ = levade("check", "stand/motion.npz", "--runs", RUNS, "--json")
    assert status == 0
    assert json.loads(out)["perturbed"] == content["certificate"]["perturbed"]

    # what nothing can do fails with what would have to give, and searches no more than there is time for
    strict = ["--demand", "speed=0.99", "--minutes", "0.05"]
    status, out, _ = levade("solve", "--resume", "stand", *strict)
    assert status == 1
    assert "The certificate fails" in out
    assert re.search(r"try a joint with [\d.]+ rad/s", " ".join(out.split()))
    assert "To go on: levade solve --resume stand" in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("solve rearing --minutes 3", "--minutes: only works with --hardware or --robust"),
        ("solve rearing --demand share=0.9", "--demand: only works with --hardware or --robust"),
        ("solve rearing --hardware --trials 30 --watch", "leave out --watch and --trials"),
        ("solve rearing --hardware --minutes 0", "--minutes: 0 should be a positive number of minutes"),
        ("solve rearing --hardware --demand sped=0.1", "no 'sped'; did you mean speed?"),
        ("solve rearing --hardware --robust", "--robust: --hardware includes it"),
        ("solve rearing --robust --from none.npz", "--robust: plans its own searches; leave out --from"),
        ("solve rearin --hardware", "no task 'rearin'; did you mean rearing?"),
        ("solve --hardware", "name a task"),
        ("solve rearing --hardware --out /proc/none", "/proc/none"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(levade, tmp_path: Path, words: str, message: str) -> None:
    status, out, err = levade(*words.split())
    assert status == 2, out
    assert err.startswith("levade: ")
    assert message in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_directory_that_holds_a_run_is_left_alone(levade, unmet: Path) -> None:
    before = {path.name: path.read_bytes() for path in unmet.iterdir() if path.is_file()}
    status, _, err = levade("solve", "rearing", "--hardware", "--minutes", "0.001", "--out", unmet)
    assert status == 2
    assert "holds a run that is no pursuit for hardware; write elsewhere: --out DIR, or replace it: --force" in err
    assert before == {path.name: path.read_bytes() for path in unmet.iterdir() if path.is_file()}
