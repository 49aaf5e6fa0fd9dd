"""Motions searched on on robots that differ: they work on as many of them, or more, and still on the model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from tests.library.rolling import rolling

from levade.library import Falls, build, hardening
from levade.library.falls import Plays
from levade.tasks.robust import Racing

pytestmark = pytest.mark.slow


def few(monkeypatch: pytest.MonkeyPatch, trials: int) -> None:
    """Harden with few roll-outs, on few robots."""
    robust = replace(hardening._ROBUST, samples=4, validation=8, racing=Racing(first=1, keep=0.5))
    for name, value in (("_ROBUST", robust), ("_TRIALS", trials), ("_SHARE", 1e9), ("_LEAST", 1)):
        monkeypatch.setattr(hardening, name, value)


def test_hardened_a_motion_works_on_as_many_robots_or_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the motions of a library are hardened ones: each still works on the model, from its own fall."""
    few(monkeypatch, 60)
    library = build(rolling(), starts=2, directory=tmp_path)
    falls = Falls(rolling())
    found = [record.fall for record in library.records if record.motion == record.fall]
    assert found
    columns = library.knowledge.motions.tolist()
    assert all(library.knowledge.success[fall, columns.index(fall)] == 1.0 for fall in found)
    objective = falls.objective(found[0])
    weights = Plays(tmp_path, falls.mirror)[found[0]].decisions(objective.policy)
    shares = []
    for trials in (1, 60):  # the motion alone, and some generations
        few(monkeypatch, trials)
        better = hardening.harden([objective], [weights], seeds=[5], observe=lambda number, generation: None)[0]
        assert better is not None
        assert better.success == objective.evaluate(better.best.weights[None]).success[0]
        shares.append(better.best.share)
    assert shares[1] >= shares[0]


def test_small_tasks_are_not_hardened(monkeypatch: pytest.MonkeyPatch) -> None:
    objective = Falls(rolling()).objective(0)
    weights = objective.policy.initial_weights(objective.robot.posture("neutral"))[None]
    assert hardening.harden([objective], [weights], seeds=[0], observe=lambda number, generation: None) == [None]
