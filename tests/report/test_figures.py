"""Figures for a paper: of the right size, the same bytes every time, and nothing left behind on errors."""

from __future__ import annotations

import struct
import sys
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.motions import Motion
from levade.search.run import run
from levade.tasks import load_task

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install 'levade[figures]'")

import levade.report.figures as module
from levade.report.figures import COLUMN, FORMATS, PAGE, compare, figures, read_progress


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> tuple[Motion, Path]:
    """A short search's motion, with a hold, and its progress.csv."""
    directory = tmp_path_factory.mktemp("rearing")
    task = load_task("rearing", changes=["search.population=8", "search.trials=24", "hold=0.05"])
    return run(task, seed=0, directory=directory).motion, directory / "progress.csv"


@pytest.mark.slow
@pytest.mark.parametrize("format", FORMATS)
def test_the_same_motion_gives_the_same_bytes(solved: tuple[Motion, Path], tmp_path: Path, format: str) -> None:
    motion, progress = solved
    one, other = (
        compare({"a": motion}, tmp_path / name, format=format, progress_csv={"a": progress})
        for name in ("one", "other")
    )
    assert [path.read_bytes() for path in one] == [path.read_bytes() for path in other]


@pytest.mark.slow
def test_png_has_the_width_of_a_column_or_of_two_at_300_dpi(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    (two,) = compare({"a": solved[0]}, tmp_path, format="png")  # without progress.csv there is no cost
    (one,) = module.write_figures({"foot-forces": lambda: module._foot_forces(solved[0])}, tmp_path, "png")
    for path, inches in ((one, COLUMN), (two, PAGE)):
        width, height = struct.unpack(">II", path.read_bytes()[16:24])
        assert width == round(inches * 300)
        assert height > 300


@pytest.mark.slow
def test_units_names_and_goals_are_in_the_trunk_figure(solved: tuple[Motion, Path]) -> None:
    figure = module._trunk({"": solved[0]})
    position, orientation = figure.axes
    assert position.get_ylabel() == "trunk position [m]"
    assert orientation.get_ylabel() == "trunk orientation [rad]"
    drawn = {round(float(y), 4) for axes in figure.axes for line in axes.get_lines() for y in line.get_ydata()}
    assert {-1.0472, 0.9} <= drawn
    com = solved[0]["trunk_com_position"]
    x, y, z = (line.get_ydata() for line in position.get_lines() if len(line.get_ydata()) == len(com))
    assert np.array_equal(np.stack([x, y, z], axis=1), com)


@pytest.mark.slow
def test_kernels_are_named_after_the_joints_they_move(solved: tuple[Motion, Path]) -> None:
    titles = [axes.get_title(loc="left") or axes.get_title() for axes in module._kernels(solved[0]).axes]
    assert titles[1:] == [f"{legs} {joint}" for legs in ("LF, RF", "LH, RH") for joint in ("HAA", "HFE", "KFE")]


@pytest.mark.slow
def test_comparison_lays_motions_over_one_another(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    motion, progress = solved
    written = compare({"a": motion, "b": motion}, tmp_path, format="svg", progress_csv={"a": progress})
    assert [path.name for path in written] == ["trunk.svg", "cost.svg"]


def test_unknown_format_names_the_nearest_and_writes_nothing(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match="did you mean pdf"):
        figures(solved[0], tmp_path / "new", format="pfd")
    assert not (tmp_path / "new").exists()
    assert "pdf" in FORMATS


def test_directory_that_cannot_be_made_is_one_line(solved: tuple[Motion, Path], tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(LevadeError, match=r"file.trunk\.pdf: cannot be written"):
        figures(solved[0], tmp_path / "file")


@pytest.mark.parametrize("content", ["", "a,b\n1,2\n", "trials,stage\n1,full\n", "\0"])
def test_what_is_no_progress_is_said_so(tmp_path: Path, content: str) -> None:
    path = tmp_path / "progress.csv"
    path.write_text(content)
    with pytest.raises(LevadeError, match=r"no progress\.csv of a solve"):
        read_progress(path)


def test_without_matplotlib_the_remedy_is_named(
    solved: tuple[Motion, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(LevadeError, match=r"pip install 'levade\[figures\]'"):
        figures(solved[0], tmp_path)
