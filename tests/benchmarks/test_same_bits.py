"""The comparison of two versions to the bit: what it takes for the same, and what it says where something is not."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest


@pytest.fixture(scope="module")
def bits(script):
    return script("same_bits")


def files(folder: Path, **changed) -> Path:
    """What a case of two generations made, with some values changed."""
    values = {
        "position": np.arange(6.0).reshape(3, 2),
        "cost": 0.5,
        "effort": [1.0, 2.0],
        "checksum": 2**60 + 1,
    } | changed
    run = folder / "run"
    run.mkdir(parents=True)
    meta = {"cost": values["cost"], "errors": {"pitch": None}, "schema": values.get("schema", 1)}
    np.savez(run / "motion.npz", meta=json.dumps(meta), joint_position=values["position"], **values.get("more", {}))
    (run / "progress.csv").write_text("generation,stage,cost_best\n1,full,0.75\n2,full,\n")
    records = [
        {"generation": 1, "checksum": values["checksum"], "terms": {"effort": values["effort"]}},
        {"generation": 2, "checksum": 7, "terms": {"effort": [3.0]}},  # the last one of a budget is smaller
    ]
    lines = [{"seed": 0}, *records, {"finished": True}]
    (run / "checkpoint.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    (folder / "solve.json").write_text(json.dumps({"success": True, "wall_s": values.get("wall", 1.0)}))
    return folder


@pytest.fixture
def compared(bits, tmp_path: Path):
    """What is found between the files of a case and the same ones with some values changed."""

    def compare(**changed):
        there, here = files(tmp_path / "there"), files(tmp_path / "here", **changed)
        return bits.compare(bits.arrays_of(there), bits.arrays_of(here))

    return compare


def test_the_same_files_are_the_same_and_all_of_them_are_compared(compared) -> None:
    found = compared(wall=2.0)  # a time is no result
    assert found.differences == found.new == []
    assert found.compared == 15
    assert found.numbers == 6 + 3 + 2 * 3 + 1 + 2 + 2 + 4 + 2 + 1 + 1 + 3


def test_one_unit_in_the_last_place_is_found_and_said_to_be_one(compared) -> None:
    moved = np.arange(6.0).reshape(3, 2)
    moved[1, 1] = np.nextafter(3.0, 4.0)
    [one] = compared(position=moved).differences
    assert one.name == "motion.joint_position"
    assert one.note.startswith("1 of 6, first at row 1 [1]: 3.0, now 3.0000000000000004; by at most 4.44e-16 (1 ULP)")


def test_a_generation_is_named_by_its_row_although_the_last_one_is_smaller(compared) -> None:
    one, _ = compared(effort=[1.0, 2.5]).differences
    assert one.name == "checkpoint.terms.effort"
    assert "1 of 4, first at row 0 [1]: 2.0, now 2.5" in one.note


def test_simulations_are_the_same_in_lines_of_another_kind(bits) -> None:
    """One line with samples in it, as layout 1 has it, and a line for each, with one simulation more."""
    samples = {"terms": {"effort": [[3.0, None], [4.0, 5.0]], "height": [[0.3, None], [0.4, 0.5]]}}
    one = [{"terms": {"effort": [1.0, 2.0], "height": [0.1, None]}, "samples": samples}]
    many = [
        {"terms": {"height": [0.1, None], "effort": [1.0, 2.0]}},
        {"terms": {"effort": [3.0, 4.0, 5.0, 6.0], "height": [0.3, 0.4, 0.5, 0.6]}},
    ]
    before, now = bits.trials_of(one), bits.trials_of(many)
    assert (len(before), len(now)) == (5, 6)
    assert bits.lost(before, now) is None
    now[2, 1] = np.nextafter(0.3, 1.0)
    said = bits.lost(before, now)
    assert said.startswith("1 of 5 simulations are not made now, first row 2; the nearest: 1 of 2, first at row 1: 0.3")
    assert said.endswith("(1 ULP)")


def test_an_angular_velocity_is_compared_in_the_axes_of_the_other_version(bits) -> None:
    """A quarter turn about z: what is about x in the trunk's axes is about y in the world's."""
    turned = {"motion.trunk_quaternion": np.sqrt([[0.5, 0.0, 0.0, 0.5]])}
    before = {**turned, "motion.meta.schema": np.array(1), "motion.trunk_angular_velocity": np.array([[0.0, 2.0, 0.0]])}
    now = {**turned, "motion.meta.schema": np.array(2), "motion.trunk_angular_velocity": np.array([[2.0, 0.0, 0.0]])}
    found = bits.in_the_axes_of(before, dict(now))
    np.testing.assert_allclose(found["motion.trunk_angular_velocity"], [[0.0, 2.0, 0.0]], atol=1e-15)
    assert bits.in_the_axes_of(now, dict(now)) == now


def test_checksums_are_compared_beyond_the_digits_of_a_float(compared) -> None:
    [one] = compared(checksum=2**60 + 2).differences
    assert one.name == "checkpoint.checksum"


def test_a_number_that_turned_into_none_differs(compared) -> None:
    [one] = compared(cost=None).differences
    assert one.name == "motion.meta.cost"
    assert "where one is no number" in one.note


def test_what_is_lost_differs_and_what_is_new_is_only_listed(bits) -> None:
    old, new = {"motion.weights": np.zeros(2)}, {"motion.latency": np.zeros(1)}
    found = bits.compare(old, new)
    assert [(one.name, one.note) for one in found.unexpected] == [("motion.weights", "is missing now")]
    assert found.new == ["motion.latency"]


def test_a_new_name_in_the_table_of_names_is_compared(bits, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bits, "RENAMED", {"motion.told": "motion.commanded"})
    found = bits.compare({"motion.told": np.zeros(2)}, {"motion.commanded": np.array([0.0, -0.0])})
    [one] = found.differences
    assert (one.name, found.new) == ("motion.commanded", [])
    assert "now -0.0" in one.note  # a zero of the other sign is another bit


def test_only_what_the_table_names_may_differ(compared, bits) -> None:
    found = compared(schema=2)
    assert found.unexpected == []
    assert [one.reason for one in found.differences] == [bits.EXPECTED["motion.meta.schema"]]


def test_rows_in_front_of_a_longer_array_are_compared(bits) -> None:
    found = bits.difference(np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0]))
    assert found == "shape (3,), now (2,); the rows of both are the same"
    assert "first at row 1" in bits.difference(np.array([1.0, 2.0, 3.0]), np.array([1.0, 4.0]))


def test_a_case_that_fails_in_both_is_not_the_same(bits) -> None:
    failed = {"solve failed": np.array("levade: no such task")}
    [one] = bits.compare(failed, dict(failed)).unexpected
    assert one.note.startswith("in both: ")


def test_every_built_in_task_of_hyq2max_is_a_case_and_six_tasks_are_on_go1(bits) -> None:
    from levade.tasks import builtin_tasks, builtin_variants, overview

    own = {name for name in builtin_tasks() if overview(name).robot == "hyq2max"}
    cases = {case.task for case in bits.CASES if case.robot == "hyq2max"}
    assert cases - builtin_variants().keys() == own
    assert {builtin_variants()[name][1] for name in cases & builtin_variants().keys()} == {"robust", "within-limits"}
    assert len({case.task for case in bits.CASES if case.robot == bits.GO1}) == 6
    assert len({case.name for case in bits.CASES}) == len(bits.CASES)
