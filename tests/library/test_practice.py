"""Practice: the likeliest motions are tried from falls of which the library has no record, and answers count it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import contents, rolling_quickly

from levade.exports.asker import SIMILAR, apart
from levade.library import Falls, Library, build, building
from levade.library.building import _FIRST_PRACTICE as FIRST
from levade.library.exporting import _ways
from levade.library.knowledge import Knowledge, Practice
from levade.library.plays import Plays, posed

pytestmark = pytest.mark.slow

STARTS = 5


@pytest.fixture(autouse=True)
def short_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(building, "_ROUND", 4)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(building, "_ROUND", 4)
        return build(rolling_quickly(), starts=STARTS, directory=tmp_path_factory.mktemp("libraries") / "practised")


def practice_of(library: Library) -> Practice:
    assert library.knowledge.practice is not None
    return library.knowledge.practice


def test_the_likeliest_motions_are_tried_from_two_further_falls_for_each(library: Library) -> None:
    practice, known = practice_of(library), replace(library.knowledge, practice=None)
    assert practice.falls.tolist() == [FIRST + i for i in range(2 * STARTS)]
    assert len(known.falls) == STARTS
    plays, falls = Plays(library.directory, known.mirror), Falls(rolling_quickly())
    for k, fall in enumerate(practice.falls.tolist()):
        objective = falls.objective(fall)
        up, joints = falls.sensed(objective.state)
        np.testing.assert_array_equal(up, practice.up[k])
        likely = [motion for motion, _ in known.ranked(up, joints)[:4]]
        tried = ~np.isnan(practice.success[k])
        assert {int(motion) for motion in known.motions[tried]} == set(likely)
        assert np.array_equal(tried, ~np.isnan(practice.perturbed[k]))
        for number, works in zip(known.motions[tried], practice.success[k, tried], strict=True):
            own, weights = posed(objective, plays[int(number)])
            assert own.judge(own.rollout(weights), own.task.hold_steps).success[0] == works


def test_stopped_and_gone_on_with_in_two_processes_it_has_the_same_bytes(library: Library, tmp_path: Path) -> None:
    calls: list[int] = []

    def stopping(until: int) -> bool:
        calls.append(1)
        return practised() >= until

    def practised() -> int:
        try:
            known = Library.load(tmp_path).knowledge
        except Exception:  # not there yet
            return 0
        return 0 if known.practice is None else len(known.practice.falls)

    build(rolling_quickly(), starts=STARTS, directory=tmp_path, stopping=partial(stopping, 4))
    assert practised() == 4
    build(rolling_quickly(), starts=STARTS, directory=tmp_path, processes=2)
    assert contents(tmp_path) == contents(library.directory)


def test_a_library_that_grows_practises_anew(library: Library, tmp_path: Path) -> None:
    assert len(practice_of(build(rolling_quickly(), starts=STARTS - 1, directory=tmp_path)).falls) == 2 * (STARTS - 1)
    build(rolling_quickly(), starts=STARTS, directory=tmp_path)
    assert contents(tmp_path) == contents(library.directory)


def test_motions_are_exported_as_they_run_from_where_they_are_the_first_answer_in_practice(library: Library) -> None:
    practice, known, ways = practice_of(library), library.knowledge, _ways(library)
    states = {
        **{int(fall): (known.up[i], known.joint_position[i]) for i, fall in enumerate(known.falls)},
        **{int(fall): (practice.up[i], practice.joint_position[i]) for i, fall in enumerate(practice.falls)},
    }
    near = 0
    for i in range(len(practice.falls)):
        here = practice.up[i], practice.joint_position[i]
        first = library.ask(*here).number
        if practice.success[i, list(known.motions).index(first)] == 1.0:
            assert min(apart(*states[fall], *here) for fall, image in ways[first] if not image) <= SIMILAR
            near += 1
    assert near


def test_a_small_library_does_not_practise(tmp_path: Path) -> None:
    assert build(rolling_quickly(), starts=3, directory=tmp_path).knowledge.practice is None


def test_what_failed_in_practice_is_less_likely_there() -> None:
    up, joints = np.array([0.0, 0.0, 1.0]), np.zeros(2)
    works = np.array([[1.0, 1.0]])
    known = Knowledge(np.zeros(1, int), up[None], joints[None], np.array([3, 5]), works, works)
    np.testing.assert_array_equal(*known.probabilities(up, joints)[:, None])
    failed = np.array([[0.0, np.nan]])
    practised = replace(known, practice=Practice(np.array([FIRST]), up[None], joints[None], failed, failed))
    assert practised.ranked(up, joints)[0][0] == 5
    assert practised.probabilities(up, joints)[0] == pytest.approx(
        (2 + 0.5 * 3 / 6) / 4.5
    )  # 2 of 4, and the share of all
