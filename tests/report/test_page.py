"""report.html: what is in it, what it refuses to replace, and that it works in a real browser without a network."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.motions import Motion
from levade.report.packing import unpack
from levade.report.page import page, write_page
from levade.report.series import series_data
from levade.report.summary import provenance_data, summary_data
from levade.search.run import run
from levade.tasks import load_task, task_to_dict

MINUS = "\N{MINUS SIGN}"


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> tuple[Motion, Path]:
    """A rearing after a short search, with a hold, and its progress.csv."""
    directory = tmp_path_factory.mktemp("rearing")
    task = load_task(
        "rearing", changes=["search.optimizer=cma", "search.population=8", "search.trials=40", "hold=0.05"]
    )
    return run(task, seed=0, directory=directory).motion, directory / "progress.csv"


def data_of(text: str) -> dict[str, Any]:
    """What the page's script reads."""
    (found,) = re.findall(r'<script type="application/json" id="levade-data">(.*?)</script>', text, re.DOTALL)
    return json.loads(found)


def test_the_numbers_of_the_page_are_those_of_the_motion(solved: tuple[Motion, Path]) -> None:
    motion, progress = solved
    series = data_of(page(motion, progress_csv=progress))["series"]
    joints, force = series["joints"], motion["foot_contact_force"]
    for name, array in (
        ("position", "joint_position"),
        ("reference", "joint_position_reference"),
        ("velocity", "joint_velocity"),
        ("torque", "joint_torque"),
    ):
        np.testing.assert_array_equal(unpack(joints[name]), motion[array].astype(np.float32))
    np.testing.assert_array_equal(unpack(series["trunk"]["position"]), motion["trunk_com_position"].astype(np.float32))
    feet = np.hypot(unpack(series["feet"]["vertical"]), unpack(series["feet"]["horizontal"]))
    np.testing.assert_allclose(feet, np.linalg.norm(force, axis=-1), rtol=1e-5, atol=1e-3)
    lines = progress.read_text().splitlines()
    assert len(series["cost"]["trials"]) == len(lines) - 1
    assert [series["cost"]["best"][-1], series["cost"]["trials"][-1]] == [float(lines[-1].split(",")[3]), 40]


def test_policies_and_kernels_give_the_reference(solved: tuple[Motion, Path]) -> None:
    motion, _ = solved
    policy = series_data(motion)["policy"]
    phi, time = unpack(policy["kernels"]).astype(float), unpack(policy["time"])
    column = [str(name) for name in motion["joint_names"]].index("lf_kfe")
    (kfe,) = (entry for entry in policy["policies"] if entry["name"] == "LF, RF KFE")
    angle = phi @ unpack(kfe["weights"])
    rows = motion.horizon_steps
    at_rows = np.interp(motion["time"][:rows], time, angle)
    np.testing.assert_allclose(at_rows, motion["joint_position_reference"][:rows, column], atol=2e-3)


def test_summary_adds_up_and_agrees_with_the_arrays(solved: tuple[Motion, Path]) -> None:
    motion, _ = solved
    summary = summary_data(motion)
    assert math.isclose(sum(term["weighted"] for term in summary["terms"]), summary["cost"], rel_tol=1e-9)
    height = next(criterion for criterion in summary["criteria"] if criterion["name"] == "height")
    assert math.isclose(height["result"], motion["trunk_com_position"][motion.horizon_steps - 1, 2], rel_tol=1e-12)
    assert height["met"] == (abs(height["result"] - 0.9) <= 0.02)
    torque = next(peak for peak in summary["peaks"] if peak["what"] == "joint torque")
    assert torque["value"] <= np.abs(motion["joint_torque"]).max()
    assert torque["share"] == torque["value"] / torque["limit"]


@pytest.mark.slow
def test_the_command_gives_the_same_task(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    motion, _ = solved
    changed = provenance_data(motion)
    assert changed["command"] == "levade solve task.yaml --seed 0"
    (tmp_path / "task.yaml").write_text(changed["task_yaml"], encoding="utf-8")
    assert task_to_dict(load_task(str(tmp_path / "task.yaml"))) == motion.meta["task"]
    builtin = replace(motion, meta={**motion.meta, "task": task_to_dict(load_task("rearing")), "seed": 3})
    assert provenance_data(builtin)["command"] == "levade solve rearing --seed 3"


def test_nothing_in_a_task_ends_the_script_or_begins_one(solved: tuple[Motion, Path]) -> None:
    motion, _ = solved
    nasty = "</script><script>alert(1)</script><!-- & \u2028"
    task = {**motion.meta["task"], "description": nasty, "name": "<script>alert(1)<!-- &"}  # no name has a slash
    text = page(replace(motion, meta={**motion.meta, "task": task, "robot": nasty}))
    assert data_of(text)["provenance"]["description"] == nasty
    assert text.count("<script") == text.count("</script>") == 2
    assert "alert(1)</script>" not in text


def test_the_same_motion_gives_the_same_bytes_and_small_ones(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    motion, progress = solved
    one = write_page(motion, tmp_path / "one" / "report.html", progress_csv=progress)
    other = write_page(motion, tmp_path / "other.html", progress_csv=progress)
    assert one.read_bytes() == other.read_bytes()
    assert one.stat().st_size < 4e6
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one", "other.html"]


@pytest.mark.slow
def test_a_motion_of_three_seconds_is_below_8_mb(tmp_path: Path) -> None:
    task = load_task("posture-recovery-slow", changes=["search.population=4", "search.trials=4"])
    motion = run(task, seed=0, directory=tmp_path / "run").motion
    assert motion["time"][-1] > 4.9
    assert write_page(motion, tmp_path / "report.html").stat().st_size < 8e6


def test_only_a_report_is_replaced(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    motion, path = solved[0], tmp_path / "report.html"
    path.write_text("<h1>my notes</h1>")
    with pytest.raises(LevadeError, match=r"no report of levade's and would be replaced; .*give another path"):
        write_page(motion, path)
    assert path.read_text() == "<h1>my notes</h1>"
    path.unlink()
    write_page(motion, path)
    before = path.read_bytes()
    write_page(replace(motion, meta={**motion.meta, "seed": 8}), path)
    assert path.read_bytes() != before


def test_a_report_that_cannot_be_written_is_one_line(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file" / "report.html", tmp_path):
        with pytest.raises(LevadeError, match=r"cannot be written \(.*\); give another path"):
            write_page(solved[0], path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


# in a browser


@pytest.fixture(scope="module")
def opened(offline: Any, solved: tuple[Motion, Path], tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The page, opened from disk with the network off; what it asked for and complained of."""
    return offline(write_page(solved[0], tmp_path_factory.mktemp("page") / "report.html", progress_csv=solved[1]))


def cursor(tab: Any) -> float:
    return float(tab.locator("#trunk .cursor line").first.get_attribute("x1"))


def seek(tab: Any, key: str) -> None:
    tab.get_by_role("slider", name="Time").press(key)


def test_play_moves_robot_and_cursors(opened: Any) -> None:
    seek(opened, "Home")
    canvas = opened.locator(".stage canvas")
    picture, place = canvas.screenshot(), cursor(opened)
    opened.get_by_role("button", name="Play", exact=True).click()
    opened.wait_for_function(
        "place => Number(document.querySelector('#trunk .cursor line').getAttribute('x1')) > place + 20", arg=place
    )
    opened.get_by_role("button", name="Pause").click()
    assert canvas.screenshot() != picture
    assert float(opened.locator("output.now").inner_text().split()[0]) > 0


def test_the_end_shows_the_last_numbers_of_the_motion_file(opened: Any, solved: tuple[Motion, Path]) -> None:
    motion, _ = solved
    seek(opened, "End")
    opened.wait_for_timeout(400)  # plots out of sight follow once the time stands still
    shown = opened.locator("main").inner_text()

    def has(value: float, digits: int) -> bool:
        return f"{value:.{digits}f}".replace("-", MINUS) in shown

    assert f"{motion['time'][-1]:.3f} / {motion['time'][-1]:.3f} s" in shown
    assert all(has(value, 4) for value in motion["trunk_com_position"][-1])
    assert all(has(value, 3) for value in motion["joint_position"][-1])
    assert all(has(value, 1) for value in motion["joint_torque"][-1])
    assert has(motion.meta["errors"]["pitch"], 4)
    assert f"levade solve task.yaml --seed {motion.meta['seed']}" in shown


def test_a_click_in_a_plot_seeks(opened: Any, solved: tuple[Motion, Path]) -> None:
    plot = opened.locator("#angles svg.chart").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    plot.click(position={"x": 36 + (box["width"] - 46) / 2, "y": 50})
    now = float(opened.locator("output.now").inner_text().split()[0])
    assert math.isclose(now, solved[0]["time"][-1] / 2, abs_tol=0.01)


@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_nothing_overflows(opened: Any, width: int, theme: str) -> None:
    opened.set_viewport_size({"width": width, "height": 800})
    opened.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
    opened.wait_for_timeout(200)
    beyond = opened.evaluate(
        """() => [document.documentElement, ...document.querySelectorAll("body *:not(svg *)")]
            .filter((e) => e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== "inline"
                && e.clientWidth > 1 && getComputedStyle(e).overflowX === "visible" && e.tagName !== "svg"
                || e.getBoundingClientRect().right > innerWidth + 1)
            .map((e) => `${e.tagName}.${e.className.baseVal ?? e.className}`)"""
    )
    assert beyond == []


def test_it_asks_for_nothing_and_complains_of_nothing(opened: Any) -> None:
    assert [url for url in opened.asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert len([url for url in opened.asked if url.startswith("file:")]) == 1
    assert opened.complaints == []
