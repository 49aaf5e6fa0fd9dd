"""Motions searched on on robots that differ: they work on as many of them, or more, and still on the model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import rolling

from levade.library import Falls, Method, build, hardening, solving
from levade.library.plays import Plays
from levade.tasks.robust import Racing

pytestmark = pytest.mark.slow


def few(monkeypatch: pytest.MonkeyPatch, trials: int) -> None:
    """Harden with few roll-outs, on few robots."""
    robust = replace(hardening._ROBUST, samples=4, validation=8, racing=Racing(first=1, keep=0.5))
    for name, value in (("_ROBUST", robust), ("_trials", lambda task: trials), ("_LEAST", 1)):
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


def test_hardened_motions_also_start_from_falls_nearby(monkeypatch: pytest.MonkeyPatch) -> None:
    """After folding up, which leaves the joints with the same commands."""
    monkeypatch.setattr("levade.library.falls._DRAWN", 24)
    fold = "start={fallen: {height: 0.5, time: 0.4, fold: {time: 0.1, rest: 0.1}}}"
    falls = Falls(rolling(start=fold))
    objective = falls.objective(0)
    wide = falls.widened(objective)
    up = falls.sensed(objective.state)[0]
    others = [falls.sensed(state)[0] for state in wide.simulation.elsewhere]
    assert 1 <= len(others) <= 24
    assert all(np.arccos(np.clip(other @ up, -1, 1)) < 0.6 for other in others)
    assert len({tuple(other) for other in others} | {tuple(up)}) == len(others) + 1
    assert wide.task == objective.task
    np.testing.assert_array_equal(wide.state.qpos, objective.state.qpos)
    assert Falls(rolling()).widened(objective).simulation.elsewhere == ()


def test_motions_found_around_known_ones_are_hardened_with_the_tasks_own_budget(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The short search around a known motion has too few roll-outs left for it."""
    budgets: list[int] = []

    def harden(objectives, weights, **options):
        budgets.extend(one.task.search.trials for one in objectives)
        return [None] * len(objectives)

    monkeypatch.setattr(solving, "harden", harden)
    monkeypatch.setattr(solving, "_NEAR_TRIALS", 40)
    library = build(rolling(trials=60), starts=2, directory=tmp_path)
    assert [record.method for record in library.records] == [Method.COLD, Method.NEAR]
    assert budgets == [60, 60]
