"""Graphs over postures: a chain of two links that can be worked out by hand, and robots."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.rightability import Postures, graphs, rightability
from levade.rightability.hulls import Hulls, Indices
from levade.rightability.postures import _values, on_soles
from levade.rightability.righting import Graph
from levade.robots import Robot, load_robot

pytest.importorskip("scipy", reason="hulls need scipy: pip install 'levade[rightability]'")

BOX = 0.1 * np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def chain(degrees: list[float]) -> Postures:
    """A cube of 1 kg, half a side of 0.1 m, and an arm of 0.3 m from the middle of its top with 1 kg at the end.

    The arm turns from straight up (90 degrees) to forward (0). The soles are the corners of the bottom.
    """
    points, centres, soles = [], [], []
    for angle in np.radians(degrees):
        tip = np.array([0.3 * np.cos(angle), 0.0, 0.1 + 0.3 * np.sin(angle)])
        points.append(np.vstack([BOX, tip]))
        centres.append(tip / 2)
        soles.append(np.array([*(BOX[:, 2] < 0), False]))
    hulls = Hulls.of(points, np.array(centres))

    def none(steps: Indices) -> Hulls:
        raise AssertionError("there is nothing between")

    steps = np.array([[i, i + 1] for i in range(len(degrees) - 1)])
    return Postures(hulls, 0, steps, np.zeros(len(steps), dtype=int), none, on_soles(hulls, soles), {})


def ways(graph: Graph, posture: int) -> list[list[float]]:
    """Up directions of the nodes of a posture."""
    return graph.attitude(np.flatnonzero(graph.place[:, 0] == posture))[0].round(3).tolist()


def step(graph: Graph, start: tuple[int, list[float]], end: int) -> list[list[float]]:
    """Up directions in a posture to which a step leads from a node."""
    up, _ = graph.attitude(np.arange(len(graph.place)))
    source, target = graph.edges.T
    chosen = (graph.place[source, 0] == start[0]) & np.isclose(up[source], start[1], atol=1e-3).all(axis=1)
    return up[target[chosen & (graph.place[target, 0] == end)]].round(3).tolist()


def test_an_arm_tips_the_cube_when_the_centre_of_mass_leaves_its_bottom() -> None:
    """The centre of mass is 0.15 cos(angle) in front, the edge 0.1: it tips below acos(2/3), 48.19 degrees."""
    (graph,) = graphs(chain([90.0, 49.0, 47.5, 0.0]), [0.0])
    level, tipped = [0.0, 0.0, 1.0], [-0.707, 0.0, 0.707]
    assert step(graph, (0, level), 1) == [level]
    ((x, _, z),) = step(graph, (1, level), 2)
    assert x < -0.3  # on the edge and the arm's end
    # with the arm forward, the plane through the bottom's edge and the arm's end is inclined by 45 degrees
    assert tipped in [[round(v, 3) for v in up] for up in ways(graph, 3)]
    assert step(graph, (2, [x, 0.0, z]), 3) == [tipped]


def test_tipping_is_not_undone_by_moving_the_arm_back() -> None:
    """Upright is the cube on its bottom. What lies on the arm's end falls on its side as the arm goes up again."""
    (graph,) = graphs(chain(np.linspace(90.0, 0.0, 19).tolist()), [0.0])
    up, _ = graph.attitude(np.arange(len(graph.place)))
    assert graph.upright.any()
    np.testing.assert_array_equal(graph.upright, up[:, 2] > 0.99)
    last = np.flatnonzero((graph.place[:, 0] == 18) & (up[:, 0] < -0.7) & (up[:, 2] > 0.7))
    assert graph.moves[last].tolist() == [-1]
    assert (graph.moves[graph.upright] == 0).all()


def test_moves_count_the_steps_to_upright() -> None:
    """A node is one step farther than the nearest node to which a step leads."""
    (graph,) = graphs(chain(np.linspace(90.0, 0.0, 10).tolist()), [0.0])
    for node in np.flatnonzero(graph.moves > 0):
        after = graph.edges[graph.edges[:, 0] == node, 1]
        assert graph.moves[after][graph.moves[after] >= 0].min() == graph.moves[node] - 1


def test_the_chain_rests_as_its_solid_angles_say() -> None:
    (graph,) = graphs(chain([90.0, 60.0]), [0.0])
    poses = graph.poses()
    assert sum(pose.likelihood for pose in poses) == pytest.approx(1.0, abs=1e-6)
    shares = graph.shares(neutral=True)
    assert shares["all"].likelihood == pytest.approx(1.0)
    upright = next(pose for pose in poses if pose.upright)
    # the bottom as seen from the centre of mass, 0.3 above it
    assert upright.likelihood == pytest.approx(np.arctan2(0.01, 0.3 * np.sqrt(0.02 + 0.09)) / np.pi, abs=1e-6)
    assert (upright.on, upright.leads, upright.moves) == ("belly", 1.0, 0)


def test_a_slope_shrinks_what_stands() -> None:
    """The centre of mass is 0.3 above the bottom, whose half side is 0.1: it stands up to atan(1/3), 18.4 degrees."""
    flat, gentle, steep = graphs(chain([90.0, 80.0]), [0.0, np.radians(18.0), np.radians(19.0)])
    standing = [int((graph.upright & (graph.place[:, 0] == 0)).sum()) for graph in (flat, gentle, steep)]
    assert standing == [1, 4, 0]  # four directions uphill


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hyq2max", "go1", "g1"])
def test_a_robot_stands_on_its_soles_at_the_height_of_its_centre_of_mass(
    name: str, packaged: Callable[[str], Robot]
) -> None:
    robot = packaged(name)
    postures = Postures.of(robot, angles=1)
    assert (postures.count, len(postures.steps)) == (1, 0)
    (graph,) = graphs(postures, [0.0])
    standing = np.flatnonzero(graph.upright)  # a sole of several shapes has several faces, almost in one plane
    up, _ = graph.attitude(standing)
    node = standing[np.argmax(up[:, 2])]
    data = robot.data_at(robot.postures["neutral"])
    mujoco.mj_comPos(robot.model, data)
    bottom = min(float(data.geom(foot).xpos[2]) for leg in robot.standing for foot in leg.soles)
    radius = float(robot.model.geom(robot.standing[0].foot).size[0])
    height = float(postures.hulls.distance[0, graph.place[node, 1]])
    assert height == pytest.approx(data.subtree_com[0, 2] - bottom + radius, abs=0.01)
    assert up[:, 2].max() > 0.99


@pytest.mark.slow
def test_left_and_right_are_as_likely_on_a_symmetric_robot() -> None:
    (graph,) = rightability(load_robot("hyq2max"), angles=3)
    shares = graph.shares()
    assert shares["left"].likelihood == pytest.approx(shares["right"].likelihood, abs=0.01)
    assert shares["all"].likelihood == pytest.approx(1.0)


@pytest.mark.parametrize(("most", "counts"), [(2, (1, 1, 1)), (3, (1, 3, 1)), (9, (1, 3, 3)), (27, (3, 3, 3))])
@pytest.mark.slow
def test_joints_get_both_ends_of_their_ranges_and_the_neutral_angle(
    most: int, counts: tuple[int, ...], packaged: Callable[[str], Robot]
) -> None:
    """The joints with the widest ranges first."""
    robot = packaged("go1")
    found = _values(robot, robot.legs[0], most)
    assert tuple(map(len, found)) == counts
    for values, low, high, neutral in zip(
        found, robot.limits.lower, robot.limits.upper, robot.postures["neutral"], strict=False
    ):
        assert values == ([neutral] if len(values) == 1 else [low, neutral, high])


def test_no_combination_of_angles_is_refused() -> None:
    with pytest.raises(LevadeError, match=r"angles: is 0; should be from 1 to 100"):
        Postures.of(load_robot("hyq2max"), angles=0)


@pytest.mark.slow
def test_a_robot_whose_legs_never_pass_its_back_stays_there(quadruped: type, tmp_path: Path) -> None:
    """Its feet and its centre of mass are above its back in every posture, so no step moves it off its back."""
    narrow = type("Narrow", (quadruped,), {"ABDUCTION": (-0.2, 0.2), "FLEXION": (-0.7, 0.7), "KNEE": (0.4, 1.3)})
    (tmp_path / "narrow.urdf").write_text(narrow().urdf())
    (graph,) = rightability(load_robot(str(tmp_path / "narrow.urdf")), angles=9)
    back = next(pose for pose in graph.poses() if pose.up[2] < -0.99)
    assert (back.on, back.leads, back.moves) == ("back", 0.0, None)
    assert 0.0 < graph.shares()["all"].leads < 1.0
    stuck = (graph.attitude(graph.edges[:, 0])[0][:, 2] < -0.99) & (graph.moves[graph.edges[:, 0]] < 0)
    assert stuck.any()
    assert (graph.attitude(graph.edges[stuck, 1])[0][:, 2] < -0.99).all()
