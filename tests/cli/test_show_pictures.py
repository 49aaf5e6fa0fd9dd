"""``levade show`` with pictures: what it writes, how it compares motions, and what it says of wrong options."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from levade.cli.picturing import labels, progress_beside
from levade.motions import Motion


@pytest.mark.slow
def test_all_figures_are_written_and_nothing_else(unmet: Path, tmp_path: Path, levade) -> None:
    """That of the cost, too, from the run beside the motion."""
    pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install 'levade[figures]'")
    place = tmp_path / "figures"
    status, out, _ = levade("show", unmet / "motion.npz", "--figures", place, "--format", "svg", "--json")
    assert status == 1
    written = [Path(path) for path in json.loads(out)["written"]]
    assert sorted(written) == sorted(place.iterdir())
    names = {"trunk", "joints", "torques", "speeds", "foot-forces", "kernels", "cost"}
    assert {path.name for path in written} == {f"{name}.svg" for name in names}
    assert all(path.stat().st_size > 1000 for path in written)


@pytest.mark.slow
def test_several_motions_are_compared_column_by_column(unmet: Path, levade) -> None:
    motion = Motion.load(unmet / "motion.npz")
    status, out, _ = levade("show", unmet / "motion.npz", unmet / "other.npz")
    assert status == 1
    rows = {line.split("  ")[1].strip(): line for line in out.splitlines() if line.startswith("  ")}
    assert out.splitlines()[0].split() == ["motion", "other"]
    assert rows["trials"].split()[1:] == ["16", "16"]
    assert rows["success"].split()[1:] == ["no", "no"]
    assert rows["cost"].split()[1:] == [f"{motion.meta['cost']:.4g}"] * 2
    assert f"{motion.meta['errors']['pitch']:+.4f} rad" in rows["error of pitch"]
    status, out, _ = levade("show", unmet / "motion.npz", unmet / "other.npz", "--json")
    assert [shown["seed"] for shown in json.loads(out)["motions"]] == [0, 0]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--figures", "{}/a", "--format", "pgn"], "did you mean png"),
        (["--format", "pdf"], "add --figures DIR"),
        (["--slow", "4"], "add --video FILE"),
        (["--camera", "1,2"], "add --video FILE or --strip FILE"),
        (["--strip", "{}/a.png", "--camera", "1"], "should be AZIMUTH,ELEVATION"),
        (["--strip", "{}/a.png", "--camera", "1,2,3,4"], "should be AZIMUTH,ELEVATION"),
        (["--strip", "{}/a.png", "--camera", "1,200"], "between -90 and 90"),
        (["--strip", "{}/a.png", "--poses", "0"], "poses 0"),
        (["--video", "{}/a.mkv"], "unknown kind of video"),
    ],
)
def test_wrong_options_are_one_line_and_write_nothing(
    unmet: Path, tmp_path: Path, levade, options: list[str], message: str
) -> None:
    if "--format" in options and "--figures" in options:
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install 'levade[figures]'")
    filled = [option.format(tmp_path) for option in options]
    status, _, err = levade("show", unmet / "motion.npz", *filled)
    assert status == 2
    assert message in err
    assert err.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_video_shows_one_motion(unmet: Path, tmp_path: Path, levade) -> None:
    files = (unmet / "motion.npz", unmet / "other.npz")
    status, _, err = levade("show", *files, "--video", tmp_path / "a.gif")
    assert (status, "one motion, not 2" in err) == (2, True)


def test_names_of_motions_are_short_and_tell_them_apart() -> None:
    assert labels([Path("x/a.npz"), Path("x/b.npz")]) == ["a", "b"]
    assert labels([Path("x/motion.npz"), Path("y/motion.npz")]) == ["x", "y"]
    assert labels([Path("p/x/motion.npz"), Path("q/x/motion.npz")]) == ["p/x/motion.npz", "q/x/motion.npz"]


def test_progress_of_another_search_is_not_taken(unmet: Path, tmp_path: Path) -> None:
    motion = Motion.load(unmet / "motion.npz")
    assert progress_beside(unmet / "motion.npz", motion) == unmet / "progress.csv"
    assert progress_beside(tmp_path / "motion.npz", motion) is None
    (tmp_path / "progress.csv").write_text("generation,trials\n1,17\n")
    assert progress_beside(tmp_path / "motion.npz", motion) is None


@pytest.mark.slow
def test_a_page_is_written_beside_each_motion(unmet: Path, tmp_path: Path, levade) -> None:
    for name in ("motion.npz", "other.npz", "progress.csv"):
        (tmp_path / name).write_bytes((unmet / name).read_bytes())
    _, out, _ = levade("show", tmp_path / "motion.npz")
    assert f"To open in a browser: {tmp_path / 'report.html'}" in out
    assert '"cost":{"trials":[8,16]' in (tmp_path / "report.html").read_text(encoding="utf-8")
    _, out, _ = levade("show", tmp_path / "motion.npz", tmp_path / "other.npz")
    assert f"To open in a browser: {tmp_path / 'report.html'}, {tmp_path / 'other-report.html'}" in out
    assert (tmp_path / "other-report.html").stat().st_size > 100_000
    _, out, _ = levade("show", tmp_path / "motion.npz", "--report", "--json")
    assert json.loads(out)["written"] == [str(tmp_path / "report.html")]


@pytest.mark.parametrize("options", [["--no-report"], ["--json"]])
def test_no_page_where_none_is_wanted(unmet: Path, tmp_path: Path, levade, options: list[str]) -> None:
    (tmp_path / "motion.npz").write_bytes((unmet / "motion.npz").read_bytes())
    assert levade("show", tmp_path / "motion.npz", *options)[0] == 1
    assert [path.name for path in tmp_path.iterdir()] == ["motion.npz"]


def test_a_file_that_is_no_report_stays(unmet: Path, tmp_path: Path, levade) -> None:
    (tmp_path / "motion.npz").write_bytes((unmet / "motion.npz").read_bytes())
    (tmp_path / "report.html").write_text("notes")
    status, _, err = levade("show", tmp_path / "motion.npz")
    assert (status, err.count("\n")) == (2, 1)
    assert "is no report of levade's" in err
    assert (tmp_path / "report.html").read_text() == "notes"
