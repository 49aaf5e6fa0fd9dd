"""A robot's portrait: every name is written, none on another, and points at what it names."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from levade.errors import LevadeError
from levade.report import portrait as module
from levade.report.portrait import Label, portrait, spread_out
from levade.report.rendering import Camera, Renderer, View
from levade.robots import Robot, load_robot
from levade.scenes import Scene, compose

Image: Any = pytest.importorskip("PIL.Image", reason="pictures need pillow: pip install 'levade[video]'")


@pytest.fixture
def robot(tmp_path: Path, quadruped: type) -> Robot:
    (tmp_path / "toy.xml").write_text(quadruped().mjcf())
    return load_robot(tmp_path / "toy.xml")


@pytest.fixture
def gl(robot: Robot) -> None:
    try:
        with Renderer(robot.spec().compile(), (64, 48)):
            pass
    except LevadeError as error:
        pytest.skip(f"no OpenGL on this machine: {error}")


@pytest.mark.slow
@pytest.mark.usefixtures("gl")
def test_it_is_a_picture_with_every_name(robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []
    draw = __import__("PIL.ImageDraw").ImageDraw.ImageDraw
    text = draw.text
    monkeypatch.setattr(
        draw, "text", lambda self, xy, words, *a, **k: (written.append(words), text(self, xy, words, *a, **k))
    )
    path = portrait(robot, tmp_path / "new" / "toy.png")
    with Image.open(path) as image:
        assert image.size == (1600, 1000)
    for name in (*robot.joint_names, *robot.feet):
        assert written.count(name) == 1
    for words in ("toy", "hip abduction", "hip flexion", "knee", "foot", "x forward", "y left", "z up"):
        assert words in written
    assert [file.name for file in path.parent.iterdir()] == ["toy.png"]


@pytest.mark.slow
@pytest.mark.usefixtures("gl")
def test_a_name_points_at_what_it_names(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """Against the renderer: pixels that change when one foot's colour does are around the place that `_Eye` computes."""
    import mujoco

    monkeypatch.setattr(module, "_SIZE", (480, 300))
    model = mujoco.MjModel.from_xml_string(compose(robot, Scene()).to_xml())
    data = module._standing(robot, model)
    camera = Camera(azimuth=module._azimuth(robot, data), elevation=-18.0)
    view = View(np.array([0.0, 0.0, 0.15]), 2.0, camera.azimuth, camera.elevation)
    labels = {label.name: label for label in module._labels(robot, data, module._Eye(camera, view))}
    images = []
    with Renderer(model, module._SIZE, shadows=1) as renderer:
        for red in [None, *robot.feet]:
            for foot in robot.feet:
                model.geom(foot).rgba = [float(foot == red), 0.0, 0.0, 1.0]
            images.append(renderer.image(data.qpos, view).astype(int))
    for foot, image in zip(robot.feet, images[1:], strict=True):
        rows, columns = np.nonzero(np.abs(image - images[0]).sum(axis=2) > 40)
        assert labels[foot].x == pytest.approx(columns.mean() + 0.5, abs=1.0)
        assert labels[foot].y == pytest.approx(rows.mean() + 0.5, abs=1.0)


def test_two_legs_are_named_on_each_side(robot: Robot) -> None:
    data = module._standing(robot, robot.spec().compile())
    camera = Camera(azimuth=module._azimuth(robot, data), elevation=-18.0)
    labels = module._labels(robot, data, module._Eye(camera, View(np.zeros(3), 2.0, camera.azimuth, camera.elevation)))
    assert [label.left for label in labels] == [True] * 8 + [False] * 8
    assert {label.name[:2] for label in labels if label.left} == {"lh", "rh"}


@pytest.mark.slow
@given(st.lists(st.floats(-200.0, 1200.0), max_size=16))
def test_names_never_touch_and_stay_in_the_picture(heights: list[float]) -> None:
    labels = [Label("", "", "", 0.0, y) for y in sorted(heights)]
    spread_out(labels, 50.0, 130.0, 960.0)
    rows = np.array([label.row for label in labels])
    assert (np.diff(rows) > 50.0 - 1e-6).all()
    assert ((rows > 130.0 - 1e-6) & (rows < 960.0 + 1e-6)).all()


def test_names_stay_where_they_point_if_there_is_room() -> None:
    labels = [Label("", "", "", 0.0, y) for y in (200.0, 300.0, 310.0, 500.0)]
    spread_out(labels, 50.0, 100.0, 900.0)
    assert [label.row for label in labels] == [200.0, 280.0, 330.0, 500.0]


def test_what_cannot_be_written_is_said(robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(LevadeError, match=r"toy\.jpg: a picture of a robot should be a \.png"):
        portrait(robot, tmp_path / "toy.jpg")
    (tmp_path / "file").write_text("")
    with pytest.raises(LevadeError, match=r"toy\.png: cannot be written"):
        portrait(robot, tmp_path / "file" / "toy.png")
    monkeypatch.setitem(__import__("sys").modules, "PIL", None)
    with pytest.raises(LevadeError, match=r"pictures need pillow; pip install 'levade\[video\]'"):
        portrait(robot, tmp_path / "toy.png")
