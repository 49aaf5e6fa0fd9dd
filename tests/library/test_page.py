"""library.html: its numbers are the library's, each fall has a dot of its own, and it works in a browser without a network."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.costs import Criterion
from levade.errors import LevadeError
from levade.library import Falls, Library, Record, build
from levade.library.failing import failures
from levade.library.figure import projected
from levade.library.page import library_data, library_page, placed, write_library
from levade.report.packing import unpack
from levade.tasks import load_task

pytestmark = pytest.mark.slow

STARTS = 6
FAILED = 4
"""The fall that is made a failure."""


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    """A library whose motions turn the back away from the ground, and which has one failure."""
    small = ("hold=0.1", "horizon=0.3", "search.polish=0", "search.population=4", "search.trials=24")
    task = load_task("self-righting", changes=["start={fallen: {height: 0.5, time: 0.4}}", *small])
    task = replace(task, success={"over": Criterion("tilt", maximum=1.9, at="end")})
    directory = tmp_path_factory.mktemp("libraries") / "rolling"
    build(task, starts=STARTS, directory=directory, threads=1)
    path = directory / "falls" / f"{FAILED:06}.json"
    record = Record.load(path)
    replace(record, method=type(record.method)("none"), motion=None, worked=()).write(directory)
    (directory / "motions" / f"{FAILED:06}.npz").unlink(missing_ok=True)
    with np.load(directory / "success.npz") as file:
        tables = dict(file)
    keep = ~np.isin(tables["motions"], [FAILED, -1 - FAILED])
    tables["success"], tables["perturbed"] = (tables[name][:, keep] for name in ("success", "perturbed"))
    tables["motions"] = tables["motions"][keep]
    for name in ("success", "perturbed"):
        tables[name][FAILED] = False
    np.savez(directory / "success.npz", **tables)
    return Library.load(directory)


def directions(n: int) -> np.ndarray:
    up = np.random.default_rng(0).standard_normal((n, 3))
    return up / np.linalg.norm(up, axis=1, keepdims=True)


def test_dots_lie_near_their_directions_and_never_on_each_other() -> None:
    up = directions(400)
    pitch, place = placed(up)
    true = np.stack(projected(up), axis=1)
    assert np.linalg.norm(place - true, axis=1).max() < 3 * pitch
    assert np.linalg.norm(place, axis=1).max() <= 1.0
    for half in (up[:, 2] >= 0, up[:, 2] < 0):
        apart = np.linalg.norm(place[half][:, None] - place[half][None], axis=-1)
        assert apart[~np.eye(len(apart), dtype=bool)].min() > 0.999 * pitch


@pytest.mark.parametrize("n", [1, 60, 3000])
def test_falls_that_end_alike_are_a_patch_around_their_direction(n: int) -> None:
    pitch, place = placed(np.tile([0.0, 0.0, -1.0], (n, 1)))
    assert len(np.unique(place.round(9), axis=0)) == n
    far = np.linalg.norm(place, axis=1)
    patch = pitch * np.sqrt(np.sqrt(0.75) * n / np.pi)  # radius of the disc that so many places fill
    assert far[0] == 0.0
    assert far.max() < patch + 1.2 * pitch
    assert far.max() < 0.8


def test_the_numbers_of_the_page_are_those_of_the_library(library: Library) -> None:
    data, known = library_data(library), library.knowledge
    works = known.success == 1.0
    np.testing.assert_array_equal(unpack(data["falls"]["number"]), known.falls)
    np.testing.assert_array_equal(unpack(data["falls"]["trials"]), [one.trials for one in library.records])
    np.testing.assert_array_equal(unpack(data["falls"]["works"]), works.sum(axis=1))
    methods = [data["methods"][k] for k in unpack(data["falls"]["method"])]
    assert methods == [one.method for one in library.records]
    assert data["coverage"] == works.any(axis=1).sum() == STARTS - 1
    assert sum(one["falls"] for one in data["faces"]) == STARTS
    assert sum(one["works"] for one in data["faces"]) == STARTS - 1
    for row in data["listed"]:
        column = works[:, list(known.motions).index(row["motion"])]
        np.testing.assert_array_equal(unpack(row["falls"]), np.flatnonzero(column))
    covered = [row["motion"] for row in data["listed"] if row["covered"] is not None]
    assert covered == [motion for motion, _ in known.cover()]
    spent = [round_["trials"] * (round_["last"] + 1 - round_["first"]) for round_ in data["rounds"]]
    assert sum(spent) == pytest.approx(sum(one.trials for one in library.records))


def test_the_first_motions_of_the_cover_are_played(library: Library) -> None:
    data = library_data(library)
    first = data["cover"][0]["motion"]
    assert first in data["played"][0]["motions"]
    assert len(data["played"]) <= 5
    assert all(one["motion"]["reference"] is None for one in data["played"])


def test_a_failure_is_played_as_it_is(library: Library) -> None:
    """By the motion that the library answers with there; the search's own verdict on it is the page's."""
    (failed,) = library_data(library)["failed"]
    assert failed["fall"] == FAILED
    record = next(one for one in library.records if one.fall == FAILED)
    number = library.model.ranked(record.up, record.joint_position)[0][0]
    assert failed["motions"] == [number]
    (played,) = failures(library, most=3)
    start = Falls(load_task(library.directory / "task.yaml"), seed=0, threads=1).objective(FAILED).state
    np.testing.assert_array_equal(played.motion["qpos0"], start.qpos[0])
    tilt = np.arccos(np.clip(1 - 2 * np.square(played.motion["trunk_quaternion"][-1, 1:3]).sum(), -1, 1))
    criterion = played.motion.task.success["over"].maximum
    assert criterion is not None
    assert played.missed.get("over", 0.0) == pytest.approx(max(0.0, tilt - criterion), abs=1e-6)


def test_the_same_library_gives_the_same_page_wherever_it_lies(library: Library, tmp_path: Path) -> None:
    other = tmp_path / "elsewhere"
    shutil.copytree(library.directory, other)
    assert library_page(Library.load(other)) == library_page(library)


def test_a_library_without_falls_or_without_its_table_has_a_page(library: Library, tmp_path: Path) -> None:
    early = tmp_path / "early"
    shutil.copytree(library.directory, early)
    (early / "success.npz").unlink()
    data = library_data(Library.load(early))
    assert data["complete"] is False
    assert data["perturbed"] is None
    for path in (early / "falls").iterdir():
        path.unlink()
    data = library_data(Library.load(early))
    assert (data["coverage"], data["starts"], data["scene"]) == (0, STARTS, None)


def test_other_files_are_not_replaced(library: Library, tmp_path: Path) -> None:
    place = tmp_path / "library.html"
    place.write_text("<p>mine</p>")
    with pytest.raises(LevadeError, match="is no report of levade's"):
        write_library(library, place)
    assert place.read_text() == "<p>mine</p>"


# in a browser


@pytest.fixture(scope="module")
def opened(offline: Any, library: Library, tmp_path_factory: pytest.TempPathFactory) -> Any:
    return offline(write_library(library, tmp_path_factory.mktemp("page") / "library.html"))


def test_every_fall_is_a_dot_and_says_how_it_was_solved(opened: Any, library: Library) -> None:
    assert opened.locator(".disc .mark").count() == STARTS
    titles = opened.locator(".disc .mark title").all_text_contents()
    for record in library.records:
        (title,) = [text for text in titles if text.startswith(f"Fall {record.fall}:")]
        assert f"{record.trials} trials" in title
    assert opened.complaints == []
    assert len(opened.asked) == 1


def test_a_motion_that_is_chosen_marks_its_falls_and_is_played(opened: Any, library: Library) -> None:
    row = library_data(library)["listed"][-1]
    name = f"Motion {row['fall']}, mirrored" if row["mirrored"] else f"Motion {row['fall']}"
    opened.get_by_role("button", name=name, exact=True).click()
    assert opened.locator(".disc .mark.faint").count() == STARTS - row["works"]
    assert opened.get_by_role("radio", name=f"motion {row['fall']}", exact=True).is_checked()
    opened.get_by_role("button", name=name, exact=True).click()
    assert opened.locator(".disc .mark.faint").count() == 0
    assert opened.complaints == []


def test_a_failure_is_listed_and_found_on_the_map(opened: Any) -> None:
    opened.get_by_role("button", name=f"Fall {FAILED}", exact=True).first.click()
    assert opened.locator(".about").inner_text().startswith(f"Fall {FAILED}: on its ")
    assert "No motion works from here." in opened.locator(".about").inner_text()
    assert opened.locator(".ring:visible").count() == 1
    cross, dot = (opened.locator(f".disc {which}").first for which in (".cross", "circle.mark"))
    colours = [mark.evaluate("mark => getComputedStyle(mark).stroke") for mark in (cross, dot)]
    assert colours[0] != colours[1]  # the edge of a dot is that of the panel; a cross has no other colour
    assert opened.get_by_role("radio", name=f"fall {FAILED}: fails", exact=True).is_checked()
    assert f"No motion gets up from fall {FAILED}." in opened.locator(".said").inner_text()
    assert opened.complaints == []


def test_an_empty_library_opens(offline: Any, library: Library, tmp_path: Path) -> None:
    shutil.copytree(library.directory, tmp_path / "empty")
    for path in (tmp_path / "empty" / "falls").iterdir():
        path.unlink()
    tab = offline(write_library(Library.load(tmp_path / "empty")))
    assert "Empty" in tab.locator(".verdict").inner_text()
    assert tab.complaints == []
