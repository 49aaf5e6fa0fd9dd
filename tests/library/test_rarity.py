"""Rare falls: which they are, and that a build finds the same ones however it is divided."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import contents, rolling

from levade.exports.asker import distances
from levade.library import Falls, Library, build
from levade.library.mirror import Mirror
from levade.library.rarity import FURTHER, RARE, Lying, further, rare
from levade.rightability.dynamic import found_motions

FOLD = "start={fallen: {height: 0.5, time: 0.4, fold: {time: 0.1, rest: 0.1}}}"


def lying(first: int, n: int, seed: int) -> list[Lying]:
    """Falls that end with the nose somewhat up, each in its own way."""
    generator = np.random.default_rng(seed)
    up = np.array([1.0, 0.0, 0.3]) + 0.2 * generator.standard_normal((n, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    return [Lying(first + i, up[i], 0.1 * generator.standard_normal(2)) for i in range(n)]


def apart(one: Lying, others: list[Lying]) -> float:
    """Distance to the nearest."""
    ups, joints = (np.array([getattr(other, name) for other in others]) for name in ("up", "joint_position"))
    return float(distances(ups, joints, one.up, one.joint_position).min())


def test_each_further_fall_has_its_own_number() -> None:
    numbers = [number for fall in range(100) for number in further(fall)]
    assert len(set(numbers)) == len(numbers) == 100 * FURTHER
    assert min(numbers) >= RARE
    assert not further(RARE)


def test_rare_falls_are_apart_from_all_others_and_leave_none_out() -> None:
    known, dropped = lying(0, 400, seed=1), lying(RARE, 150, seed=2)
    by_number = {one.fall: one for one in dropped}
    chosen = [by_number[fall] for fall in rare(dropped, known, None)]
    assert 3 < len(chosen) < 100
    for i, one in enumerate(chosen):
        assert apart(one, [*known, *chosen[:i]]) > 0.05
    for one in dropped:
        assert apart(one, [*known, *chosen]) <= 0.05
    far = [apart(one, known) for one in dropped]
    assert chosen[0] is dropped[int(np.argmax(far))]


def test_a_small_library_stays_small() -> None:
    """At most one rare fall for four others, counting those that it has already."""
    dropped = lying(RARE, 60, seed=2)
    for falls, there in ((3, 0), (4, 0), (40, 0), (40, 6), (40, 12)):
        known = [*lying(0, falls, seed=1), *lying(2 * RARE, there, seed=3)]
        assert len(rare(dropped, known, None)) <= max(0, falls // 4 - there)
    assert len(rare(dropped, lying(0, 40, seed=1), None)) == 10


def test_the_image_of_a_known_fall_is_known() -> None:
    mirror = Mirror(np.array([1, 0]), np.array([-1.0, -1.0]))
    known = lying(0, 40, seed=1)
    images = [Lying(RARE + i, mirror.up(one.up), mirror.posture(one.joint_position)) for i, one in enumerate(known)]
    assert rare(images, known, mirror) == ()
    assert rare(images, known, None)


@pytest.mark.slow
def test_falls_that_fold_up_together_end_as_they_do_alone() -> None:
    falls = Falls(rolling(start=FOLD))
    for one in falls.lying([3, RARE + 7]):
        up, joint_position = falls.sensed(falls.objective(one.fall).state)
        np.testing.assert_array_equal(one.up, up)
        np.testing.assert_array_equal(one.joint_position, joint_position)


@pytest.mark.slow
def test_a_build_finds_the_same_rare_falls_grown_and_in_several_processes(tmp_path: Path) -> None:
    task = rolling(start=FOLD, polish=0, trials=12)
    library = build(task, starts=8, directory=tmp_path / "one", threads=1)
    added = [record for record in library.records if record.rare]
    assert 0 < len(added) <= 2
    dropped = [one.fall for record in library.records for one in record.further]
    assert dropped == [number for fall in range(8) for number in further(fall)]
    assert {record.fall for record in added} < set(dropped)
    assert not any(record.further for record in added)
    assert not np.isnan(library.knowledge.success).any()
    for starts in (5, 8):
        build(task, starts=starts, directory=tmp_path / "grown", processes=2)
    assert contents(tmp_path / "grown") == contents(tmp_path / "one")
    assert found_motions(Library.load(tmp_path / "one"))["all"].falls == 8  # shares are of falls as they come
