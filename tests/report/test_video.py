"""Pictures of a motion: as many as announced, of the robot, in frame; and one clear line where that cannot be."""

from __future__ import annotations

import gc
import sys
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.motions import Motion
from levade.report import rendering
from levade.report.rendering import Camera, Renderer, View, outline, replay
from levade.report.video import frame_times, strip, strip_times, video
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

Image: Any = pytest.importorskip("PIL.Image", reason="pictures need pillow: pip install 'levade[video]'")

SMALL = (96, 72)


@pytest.fixture(scope="module")
def motion() -> Motion:
    objective = make_objective(load_task("rearing", changes=["search.population=8", "search.trials=24", "hold=0.05"]))
    return record(objective, solve(objective, seed=0), seed=0)


@pytest.fixture
def gl(motion: Motion) -> None:
    try:
        with Renderer(motion, SMALL):
            pass
    except LevadeError as error:
        pytest.skip(f"no OpenGL on this machine: {error}")


@pytest.mark.slow
def test_replay_gives_the_trunk_that_the_file_has(motion: Motion) -> None:
    poses = replay(motion)
    assert np.array_equal(poses.qpos[1:, :3], motion["trunk_position"])
    assert np.array_equal(poses.at(float(poses.time[7])), poses.qpos[7])
    between = poses.at(float(poses.time[7] + poses.time[8]) / 2)
    np.testing.assert_allclose(between[:3], (poses.qpos[7, :3] + poses.qpos[8, :3]) / 2, atol=1e-12)


@pytest.mark.parametrize("camera", [Camera(), Camera(90, 0), Camera(200, -60), Camera(30, 40)])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.0])
def test_camera_takes_in_the_whole_motion_and_no_more(motion: Motion, camera: Camera, aspect: float) -> None:
    poses = replay(motion)
    points = outline(poses.model, poses.qpos[::20])
    view = camera.frame(points, aspect=aspect)
    right, up, forward = camera.axes() @ (points - view.lookat).T
    depth = forward + view.distance
    tangent = np.tan(np.radians(rendering.FIELD_OF_VIEW / 2))
    across, high = np.abs(right / depth / (tangent * aspect)), np.abs(up / depth / tangent)
    assert depth.min() > 0
    assert max(across.max(), high.max()) == pytest.approx(1 / rendering._MARGIN)


@pytest.mark.slow
@pytest.mark.usefixtures("gl")
def test_the_robot_is_in_the_picture_and_nothing_touches_its_edge(motion: Motion) -> None:
    poses = replay(motion)
    view = Camera().frame(outline(poses.model, poses.qpos[::10]), aspect=4 / 3)
    with Renderer(motion, SMALL, shadows=1) as renderer:
        away = poses.qpos[0].copy()
        away[:3] = view.lookat - 50 * Camera().axes()[2]  # far behind the camera
        empty = renderer.image(away, view).astype(int)
        for time in (0.0, 0.15, 0.3):
            drawn = np.abs(renderer.image(poses.at(time), view) - empty).sum(axis=2) > 90
            assert 0.04 < drawn.mean() < 0.6
            assert not drawn[0].any()
            assert not drawn[:, 0].any()
            assert not drawn[:, -1].any()


@pytest.mark.usefixtures("gl")
@pytest.mark.slow
def test_only_what_is_for_looking_at_is_drawn(motion: Motion) -> None:
    model = replay(motion).model
    assert (rendering.drawn_geoms(model) == (model.geom_group <= 2)).all()


def test_a_part_that_has_nothing_to_look_at_shows_what_collides() -> None:
    """Also where other parts have: body by body, those that are fixed to each other taken together."""
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><geom group="3" size="1"/><body><freejoint/><geom group="3" size="1"/>
        <body><joint/><geom group="3" size="1"/><body><geom group="2" size="1"/></body></body>
        <body><joint/><geom group="3" size="1"/><geom group="4" size="1"/></body></body></worldbody></mujoco>"""
    )
    # in the model's order: the world's, the trunk's, the first link's and its fixed shell, the second link's two
    assert rendering.drawn_geoms(model).tolist() == [False, True, False, True, True, False]


@pytest.mark.slow
@pytest.mark.usefixtures("gl")
def test_gif_has_the_pictures_and_lasts_as_long_as_said(motion: Motion, tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    path = video(motion, tmp_path / "a.gif", slow=2, fps=20, size=SMALL, progress=lambda *at: told.append(at))
    n = len(frame_times(motion, slow=2, fps=20))
    assert n == 13 + 1
    assert told == [(k, n) for k in range(1, n + 1)]
    with Image.open(path) as picture:
        assert picture.size == SMALL
        assert picture.info["loop"] == 0
        lasts = []
        for k in range(picture.n_frames):
            picture.seek(k)
            lasts.append(picture.info["duration"])
    assert sum(lasts) == pytest.approx(n * 50 + 800)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::ResourceWarning")  # imageio-ffmpeg leaves its pipes to the garbage collector
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.usefixtures("gl")
def test_mp4_has_the_pictures_and_lasts_as_long_as_said(motion: Motion, tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="mp4 needs imageio-ffmpeg: pip install 'levade[video]'")
    path = video(motion, tmp_path / "a.mp4", slow=2, fps=20, size=SMALL)
    frames, seconds = ffmpeg.count_frames_and_secs(str(path))
    assert frames == len(frame_times(motion, slow=2, fps=20)) + 16
    assert seconds == pytest.approx(frames / 20, abs=0.02)
    reader = ffmpeg.read_frames(str(path))
    assert tuple(next(reader)["size"]) == SMALL
    first, *_, last = (np.frombuffer(image, np.uint8).astype(int) for image in reader)
    reader.close()
    del reader
    gc.collect()
    assert np.abs(first - last).mean() > 2  # the robot has moved


@pytest.mark.slow
@pytest.mark.usefixtures("gl")
def test_strip_has_n_poses_that_differ(motion: Motion, tmp_path: Path) -> None:
    path = strip([motion, motion], tmp_path / "strip.png", n=4, height=60, labels=["one", "two"])
    with Image.open(path) as opened:
        picture = np.asarray(opened.convert("RGB")).astype(int)
    columns = np.array_split(np.arange(picture.shape[1]), 4)
    half = picture.shape[0] // 2
    width = min(len(column) for column in columns)
    poses = [picture[:half, column[:width]] for column in columns]
    for k in range(3):
        assert np.abs(poses[k] - poses[k + 1]).mean() > 2
    below = picture[half : 2 * half]
    np.testing.assert_array_equal(picture[24:half], below[24:])  # the same motion, under another name


def test_poses_are_evenly_spaced_and_the_hold_has_its_end(motion: Motion) -> None:
    assert strip_times(motion, 5) == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.35])
    assert strip_times(motion, 2) == pytest.approx([0.0, 0.3])
    assert strip_times(motion, 1) == pytest.approx([0.3])


@pytest.mark.usefixtures("gl")
@pytest.mark.slow
def test_a_camera_that_tracks_keeps_the_trunk_where_it_was(motion: Motion) -> None:
    from levade.report.video import _follow

    view = View(np.zeros(3), 3.0, 90.0, 0.0)
    still, moved = (_follow(Camera(track=track), view, motion, 0.3) for track in (False, True))
    com = motion["trunk_com_position"]
    assert np.array_equal(still.lookat, view.lookat)
    np.testing.assert_allclose(moved.lookat, com[motion.horizon_steps - 1] - com[0], atol=1e-9)


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("a.mp3", {}, r"did you mean \.mp4"),
        ("a", {}, r"unknown kind of video"),
        ("a.gif", {"slow": 0.0}, "slow 0"),
        ("a.gif", {"slow": float("nan")}, "slow nan"),
        ("a.gif", {"fps": -1}, "fps -1"),
        ("a.mp4", {"size": (95, 72)}, "even numbers"),
        ("missing.gif/a.gif", {}, "cannot be written"),
    ],
)
def test_wrong_input_is_one_line(
    motion: Motion, tmp_path: Path, name: str, options: dict[str, Any], message: str
) -> None:
    (tmp_path / "missing.gif").write_text("a file, not a directory")
    with pytest.raises(LevadeError, match=message) as raised:
        video(motion, tmp_path / name, **options)
    assert "\n" not in str(raised.value)
    assert [path.name for path in tmp_path.iterdir()] == ["missing.gif"]


@pytest.mark.parametrize(("name", "n"), [("a.png", 0), ("a.png", -3), ("a.jpg", 6), ("a.png", 1000)])
def test_wrong_strips_are_told(motion: Motion, tmp_path: Path, name: str, n: int) -> None:
    with pytest.raises(LevadeError, match=r"poses|\.png"):
        strip(motion, tmp_path / name, n=n)


@pytest.mark.parametrize("angles", [(0.0, 91.0), (float("nan"), 0.0), (0.0, 0.0, -1.0)])
def test_impossible_cameras_are_told(angles: tuple[float, ...]) -> None:
    with pytest.raises(LevadeError, match="camera"):
        Camera(*angles)


def test_without_opengl_the_remedy_is_named(motion: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.delenv("PYOPENGL_PLATFORM", raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(rendering, "_egl_devices", lambda: 0)
    monkeypatch.setattr("ctypes.util.find_library", lambda name: None)
    with pytest.raises(LevadeError, match="libosmesa6"):
        strip(motion, tmp_path / "a.png", n=1)
    assert not list(tmp_path.iterdir())
    monkeypatch.setenv("MUJOCO_GL", "off")
    with pytest.raises(LevadeError, match="MUJOCO_GL=off"):
        strip(motion, tmp_path / "a.png", n=1)


def test_without_ffmpeg_the_remedy_is_named(motion: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(LevadeError, match=r"pip install 'levade\[video\]'"):
        video(motion, tmp_path / "a.mp4")
