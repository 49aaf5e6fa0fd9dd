"""Gaps and height fields: where MuJoCo's rays meet them, what falls into them, and what their files say."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.engines import Fall, Physics, Settled, Start, State, make_engine, start_state
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.scenes import Gap, Scene, Terrain, compose, read_heights

HILLS = ((0.0, 0.1, 0.3), (0.05, 0.2, 0.1), (0.1, 0.0, 0.0), (0.0, 0.15, 0.05))


def put(robot: Robot, scene: Scene, start: Start) -> State:
    return start_state(make_engine(robot, scene, Physics()), robot, scene, start)


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


def surface(robot: Robot, scene: Scene, x: float, y: float) -> float:
    """Where a ray from above meets the scene, compiled from the text that motions keep."""
    model = mujoco.MjModel.from_xml_string(compose(robot, scene).to_xml(), dict(robot.assets))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geom = np.zeros(1, dtype=np.int32)
    robot_out = int(model.body(robot.trunk).id)
    start = np.array([x, y, 20.0])
    data.qpos[:3] = [0.0, 0.0, -30.0]  # out of the way
    mujoco.mj_forward(model, data)
    return 20.0 - mujoco.mj_ray(model, data, start, np.array([0.0, 0.0, -1.0]), None, 1, robot_out, geom)


def test_the_first_row_is_on_the_left_and_columns_run_along_x(robot: Robot) -> None:
    scene = Scene(terrain=Terrain(HILLS, size=(2.0, 3.0), position=(5.0, 1.0)))
    inside = 1e-6
    for row, column in ((0, 0), (0, 2), (3, 2), (3, 0), (1, 1), (2, 1)):
        x = 5.0 - 1.0 + column * 1.0 + (inside if column == 0 else -inside)
        y = 1.0 + 1.5 - row * 1.0 + (-inside if row == 0 else inside)
        assert surface(robot, scene, x, y) == pytest.approx(HILLS[row][column], abs=1e-4)
    assert surface(robot, scene, 0.0, 0.0) == pytest.approx(0.0)


@pytest.mark.slow
def test_nothing_of_the_terrain_is_above_the_height_that_starts_count_on(robot: Robot) -> None:
    scene = Scene(terrain=Terrain(HILLS, size=(2.0, 3.0)))
    x, y = np.random.default_rng(0).uniform(-1.2, 1.2, (2, 30))
    height = scene.ground_height(x, y)
    seen = [surface(robot, scene, *at) for at in zip(x, y, strict=True)]
    assert (height >= np.array(seen) - 1e-5).all()
    assert height.max() <= 0.3


def test_the_robot_is_put_down_on_the_terrain_and_stands(robot: Robot) -> None:
    flat = tuple(tuple(0.25 + 0.001 * ((i + j) % 2) for j in range(10)) for i in range(10))
    state = put(robot, Scene(terrain=Terrain(flat, size=(3.0, 3.0))), Settled())
    level = put(robot, Scene(), Settled())
    assert state.qpos[0, 2] - level.qpos[0, 2] == pytest.approx(0.25, abs=0.005)


@pytest.mark.parametrize("slope", [0.0, 0.3, -0.2])
def test_a_gap_is_where_it_should_be_and_as_deep(robot: Robot, slope: float) -> None:
    scene = Scene(slope=slope, gaps=(Gap(3.0, 0.5, depth=0.4), Gap(1.0, 0.6)))
    for along, below in ((0.99, 0.0), (1.01, 1.0), (1.59, 1.0), (1.61, 0.0), (2.99, 0.0), (3.25, 0.4), (3.51, 0.0)):
        if slope and below:  # straight down misses the bottom of a ditch that leans
            continue
        x = along * math.cos(slope)
        z = along * math.sin(slope) - below
        assert surface(robot, scene, x, 0.3) == pytest.approx(z, abs=1e-4)


def test_a_robot_over_a_gap_falls_to_its_bottom(robot: Robot) -> None:
    scene = Scene(gaps=(Gap(-2.0, 4.0, depth=0.5),))
    state = put(robot, scene, Fall(height=0.6, gain=1.0, time=1.5))
    level = put(robot, Scene(), Settled())
    assert state.qpos[0, 2] == pytest.approx(level.qpos[0, 2] - 0.5, abs=0.01)


def test_heights_from_files(tmp_path: Path) -> None:
    np.save(tmp_path / "hills.npy", np.array(HILLS))
    np.testing.assert_allclose(read_heights(tmp_path / "hills.npy"), HILLS)
    image = pytest.importorskip("PIL.Image", reason="reading images takes Pillow")
    grey = np.array([[0, 51, 255], [102, 0, 204]], dtype=np.uint8)
    image.fromarray(grey).save(tmp_path / "grey.png")
    np.testing.assert_allclose(read_heights(tmp_path / "grey.png", 0.5), [[0, 0.1, 0.5], [0.2, 0, 0.4]], atol=1e-6)
    image.fromarray(np.stack([grey] * 3, axis=-1)).save(tmp_path / "colour.png")
    assert read_heights(tmp_path / "colour.png", 0.5) == read_heights(tmp_path / "grey.png", 0.5)
    image.fromarray(grey.astype(np.uint16) * 257).save(tmp_path / "deep.png")
    np.testing.assert_allclose(
        read_heights(tmp_path / "deep.png", 0.5), read_heights(tmp_path / "grey.png", 0.5), atol=1e-6
    )


@pytest.mark.slow
def test_files_that_hold_no_heights(tmp_path: Path) -> None:
    (tmp_path / "words.npy").write_text("words")
    (tmp_path / "words.png").write_text("words")
    np.save(tmp_path / "line.npy", np.zeros(4))
    for name, height, message in (
        ("none.npy", None, r"none.npy: no such file; give a .npy of heights in m, or an image"),
        ("words.npy", None, r"words.npy: not an array of numbers"),
        ("line.npy", None, r"line.npy: an array of shape \(4,\); should be two-dimensional"),
        ("line.npy", 0.2, r"line.npy: an array is in metres, so leave the height out"),
        ("words.png", None, r"words.png: say how high white is: height: 20 cm"),
        ("words.png", 0.2, r"words.png: not an image that Pillow can read"),
    ):
        with pytest.raises(LevadeError, match=message) as caught:
            read_heights(tmp_path / name, height)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("heights", "message"),
    [
        (((0.0, 1.0),), "2 rows or more, all of one length, at least 2"),
        (((0.0, 1.0), (0.0,)), "2 rows or more, all of one length"),
        (((0.0,), (1.0,)), "at least 2"),
        (((0.0, -1.0), (0.0, 0.0)), "a hole is one of the scene's gaps"),
        (((1.0, 1.0), (1.0, 1.0)), "not all the same"),
        (((0.0, math.nan), (0.0, 0.0)), "should be finite"),
        (((0.0, 1.0) * 200,) * 200, "200 x 400 are too many; at most 40000"),
    ],
)
def test_heights_that_make_no_terrain(heights: tuple[tuple[float, ...], ...], message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        Terrain(heights, size=(1.0, 1.0))


@pytest.mark.slow
def test_the_size_of_a_file_is_looked_at_before_its_heights(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    whole = b"\x93NUMPY\x01\x00v\x00" + b"{'descr': '<f8', 'fortran_order': False, 'shape': %s}".ljust(128)
    for name, shape in (("claims", b"(900000, 900000)"), ("more", b"(1, 1, 1" + b", 1" * 90 + b")"), ("text", b"'x'")):
        (tmp_path / f"{name}.npy").write_bytes((whole % shape)[:128] + b" \n")
        with pytest.raises(LevadeError, match="npy: not an array of numbers"):
            read_heights(tmp_path / f"{name}.npy")
    np.save(tmp_path / "large.npy", np.zeros((300, 300)))
    np.savez(tmp_path / "several", a=np.zeros(3))
    (tmp_path / "several.npz").rename(tmp_path / "several.npy")
    image.new("1", (2000, 3000)).save(tmp_path / "large.png")
    image.new("1", (20_000, 10_000)).save(tmp_path / "bomb.png")
    for name, height, message in (
        ("large.npy", None, "300 x 300 heights are too many; at most 40000 in all"),
        ("several.npy", None, "not an array of numbers"),
        ("large.png", 0.5, "2000 x 3000 heights are too many"),
        ("bomb.png", 0.5, "not an image that Pillow can read"),
    ):
        with pytest.raises(LevadeError, match=message):
            read_heights(tmp_path / name, height)


def test_gaps_that_make_no_ground() -> None:
    with pytest.raises(LevadeError, match=r"gap.width: 0.0 m should be a positive length"):
        Gap(1.0, 0.0)
    with pytest.raises(LevadeError, match=r"gap.depth: -1.0 m should be a positive length"):
        Gap(1.0, 1.0, -1.0)
    with pytest.raises(LevadeError, match=r"scene.gaps: the ones at x = 0.5 and 1.0 m overlap; make them one"):
        Scene(gaps=(Gap(1.0, 1.0), Gap(0.5, 0.6)))
    with pytest.raises(LevadeError, match=r"terrain.size: \[1.0, 0.0\] should be two positive lengths"):
        Terrain(HILLS, size=(1.0, 0.0))
