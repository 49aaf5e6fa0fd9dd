"""Which resting poses lead to upright by moving joints alone, quasi-statically.

    (graph,) = graphs(Postures.of(robot), [0.0])
    graph.poses()                # where the robot rests in its neutral posture, how likely, and whether upright is reached

A node is a posture that rests on one of the faces of its hull; on a slope, also with one of `HEADINGS` directions uphill. A
step moves one joint of a group of legs to the next value of the grid, in strides of at most
`levade.rightability.postures.STRIDE`. After each stride the robot comes to rest (`Hulls.settle`): it stays on its face, or
tips over an edge if the centre of mass has left it. So it never flies, never slides and has no momentum, and torque is not
limited.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.library.falls import FACES, face, lying_on
from levade.rightability.hulls import Hulls, Indices, tangent
from levade.rightability.postures import Postures

HEADINGS = 4
"""Directions uphill that are told apart on a slope."""
LEVEL = np.radians(30.0)
"""Largest angle between the trunk's up and the ground's normal when upright [rad]."""
_CHUNK = 256
"""Number of steps whose hulls are in memory at a time."""
_SAMPLE = 400
"""Number of postures, evenly spaced on the grid, over which `Graph.shares` averages."""


@dataclass(frozen=True, eq=False)
class Pose:
    """Describes a face on which the robot rests in its neutral posture.

    Attributes:
        up: The ground's normal in trunk axes, shape (3,).
        on: What the robot lies on, one of `levade.library.falls.FACES`.
        likelihood: Share of all attitudes from which it comes to rest here, 0 to 1.
        upright: Whether it stands on its feet alone, its trunk level.
        leads: Share of `likelihood` (over the directions uphill) from which upright is reached, 0 to 1; on flat ground 0 or 1.
        moves: Least number of steps to upright. None if it is not reached.
    """

    up: Array
    on: str
    likelihood: float
    upright: bool
    leads: float
    moves: int | None


@dataclass(frozen=True)
class Share:
    """Describes how the robot lies after falls, over many attitudes.

    Attributes:
        likelihood: Share of attitudes, 0 to 1.
        leads: Share of these from which upright is reached, 0 to 1; nan if there are none.
    """

    likelihood: float
    leads: float


@dataclass(frozen=True, eq=False)
class Graph:
    """Holds the nodes on one slope, and how far each one is from upright.

    Attributes:
        postures: The postures.
        slope: Slope of the ground [rad].
        headings: Number of directions uphill that are told apart; 1 on flat ground.
        node: Number of a node, or -1, shape (postures, faces, headings).
        place: Posture, face and direction uphill of each node, shape (nodes, 3).
        edges: Nodes at the ends of steps that are possible, shape (edges, 2).
        upright: Whether the robot is upright, shape (nodes,).
        moves: Least number of steps to upright, -1 if it is not reached, shape (nodes,).
    """

    postures: Postures
    slope: float
    headings: int
    node: Indices
    place: Indices
    edges: Indices
    upright: NDArray[np.bool_]
    moves: Indices

    @classmethod
    def nodes(cls, postures: Postures, slope: float) -> Graph:
        """Find the nodes, and leave the graph without edges.

        Args:
            postures: The postures.
            slope: Slope of the ground [rad].

        Returns:
            A graph with all nodes and no edges. Only upright nodes count as reaching upright.
        """
        hulls = postures.hulls
        headings = 1 if slope == 0.0 else HEADINGS
        up = -hulls.normal
        posture, triangle = np.nonzero(hulls.exists)
        plane = hulls.plane[posture, triangle]
        rests = np.zeros((*up.shape[:2], headings), dtype=bool)
        for k in range(headings):
            stable = hulls.stable(_uphill(up, np.full(up.shape[:2], k), headings), slope)
            np.logical_or.at(rests[:, :, k], (posture, plane), stable[posture, triangle])
        place = np.argwhere(rests)
        node = np.full(rests.shape, -1, dtype=np.intp)
        node[tuple(place.T)] = np.arange(len(place))
        at = place[:, 0], place[:, 1]
        upright = postures.on_feet[at] & (up[at][:, 2] >= np.cos(LEVEL))
        return cls(postures, slope, headings, node, place, np.empty((0, 2), np.intp), upright, np.where(upright, 0, -1))

    def through(self, steps: Indices, middle: Hulls, number: int) -> Indices:
        """Move the joints through steps, from every node of the posture where a step begins.

        Args:
            steps: Postures at both ends, shape (steps, 2).
            middle: Hulls in between: first all of the first step.
            number: Number of hulls in between for each step.

        Returns:
            The edges of the graph, shape (edges, 2).
        """
        first = np.searchsorted(self.place[:, 0], steps[:, 0], side="left")
        count = np.searchsorted(self.place[:, 0], steps[:, 0], side="right") - first
        step = np.repeat(np.arange(len(steps)), count)
        source = first[step] + np.arange(len(step)) - np.repeat(np.cumsum(count) - count, count)
        up, uphill = self.attitude(source)
        for k in range(number):
            rest = middle.settle(step * number + k, up, uphill, self.slope)
            kept = rest.face >= 0
            step, source, up, uphill = step[kept], source[kept], rest.up[kept], rest.uphill[kept]
        ends = steps[step, 1]
        rest = self.postures.hulls.settle(ends, up, uphill, self.slope)
        target = self.reached(ends, rest.face, rest.up, rest.uphill)
        return np.stack([source, target], axis=1)[target >= 0]

    def attitude(self, nodes: Indices) -> tuple[Array, Array]:
        """Return the ground's normal and the direction uphill in trunk axes.

        Args:
            nodes: Numbers of nodes, shape (n,).

        Returns:
            Both of shape (n, 3).
        """
        posture, face_, heading = self.place[nodes].T
        up = -self.postures.hulls.normal[posture, face_].astype(float)
        return up, _uphill(up, heading, self.headings)

    def reached(self, posture: Indices, face_: Indices, up: Array, uphill: Array) -> Indices:
        """Find the node in which a posture rests.

        Args:
            posture: Number of the posture, shape (n,).
            face_: Face on which it rests; -1 if it rolls on, shape (n,).
            up: The ground's normal in trunk axes, shape (n, 3).
            uphill: Direction uphill in trunk axes, shape (n, 3).

        Returns:
            Numbers of nodes, -1 where it does not rest, shape (n,).
        """
        ahead = tangent(up)
        angle = np.arctan2(np.sum(uphill * np.cross(up, ahead), axis=-1), np.sum(uphill * ahead, axis=-1))
        heading = np.rint(angle * self.headings / (2 * np.pi)).astype(np.intp) % self.headings
        return np.where(face_ >= 0, self.node[posture, face_, heading], -1)

    def dropped(self, posture: Indices) -> tuple[Indices, Array]:
        """Put postures down in every attitude, and let them come to rest.

        The share of attitudes in which the vertical meets a face is the solid angle of the face.

        Args:
            posture: Numbers of postures, shape (p,).

        Returns:
            Nodes, -1 where it rolls on, shape (n,), and the share of each row in its posture's attitudes, shape (n,).
        """
        hulls = self.postures.hulls
        which, face_ = np.nonzero(hulls.exists[posture])
        share = hulls.solid_angles(posture)
        share = (share / share.sum(axis=1, keepdims=True))[which, face_] / self.headings
        rows = posture[which]
        up = -hulls.normal[rows, face_].astype(float)
        nodes = []
        for heading in range(self.headings):
            rest = hulls.roll(rows, face_, _uphill(up, np.full(len(up), heading), self.headings), self.slope)
            nodes.append(self.reached(rows, rest.face, rest.up, rest.uphill))
        return np.concatenate(nodes), np.tile(share, self.headings)

    def poses(self) -> list[Pose]:
        """Return the poses in which the robot rests in its neutral posture, the most likely ones first."""
        nodes, share = self.dropped(np.array([self.postures.neutral]))
        found = []
        for face_ in np.unique(self.place[self.place[:, 0] == self.postures.neutral, 1]):
            here = (nodes >= 0) & (self.place[nodes, 1] == face_)
            likelihood = float(share[here].sum())
            own = np.flatnonzero((self.place[:, 0] == self.postures.neutral) & (self.place[:, 1] == face_))
            moves = self.moves[own]
            up, _ = self.attitude(own[:1])
            leads = float(share[here & (self.moves[nodes] >= 0)].sum())
            found.append(
                Pose(
                    up[0],
                    face(up[0]),
                    likelihood,
                    bool(self.upright[own[0]]),
                    leads / likelihood if likelihood > 0 else float((moves >= 0).mean()),
                    int(moves[moves >= 0].min()) if (moves >= 0).any() else None,
                )
            )
        return sorted(found, key=lambda pose: -pose.likelihood)

    def shares(self, *, neutral: bool = False) -> dict[str, Share]:
        """Return how the robot lies after falls in any attitude, and from what share of these upright is reached.

        Args:
            neutral: Whether it falls in the neutral posture, rather than in any posture of the grid.

        Returns:
            One entry for each of `levade.library.falls.FACES`, "rolls" for what does not come to rest, and "all".
        """
        count = self.postures.count
        chosen = [self.postures.neutral] if neutral else np.unique(np.linspace(0, count - 1, _SAMPLE).astype(np.intp))
        nodes, share = self.dropped(np.asarray(chosen))
        share = share / share.sum()
        up, _ = self.attitude(np.maximum(nodes, 0))
        lies = lying_on(up)
        leads = (nodes >= 0) & (self.moves[np.maximum(nodes, 0)] >= 0)
        result = {}
        for name, rows in [
            *((name, (nodes >= 0) & (lies == i)) for i, name in enumerate(FACES)),
            ("rolls", nodes < 0),
            ("all", np.ones(len(nodes), dtype=bool)),
        ]:
            likelihood = float(share[rows].sum())
            result[name] = Share(likelihood, float(share[rows & leads].sum()) / likelihood if likelihood else np.nan)
        return result


def graphs(postures: Postures, slopes: Sequence[float]) -> list[Graph]:
    """Build the graphs on several slopes.

    Args:
        postures: The postures.
        slopes: Slopes of the ground [rad].
    """
    found = [Graph.nodes(postures, slope) for slope in slopes]
    edges: list[list[Indices]] = [[] for _ in found]
    for number in np.unique(postures.middles).tolist():
        which = np.flatnonzero(postures.middles == number)
        for first in range(0, len(which), _CHUNK):
            chosen = which[first : first + _CHUNK]
            steps = postures.steps[chosen]
            middle = postures.between(chosen) if number else postures.hulls
            backward = middle if not number else middle.take(_reversed(len(chosen), number))
            for graph, own in zip(found, edges, strict=True):
                own.append(graph.through(steps, middle, number))
                own.append(graph.through(steps[:, ::-1], backward, number))
    result = []
    for graph, own in zip(found, edges, strict=True):
        joined = np.concatenate([np.empty((0, 2), dtype=np.intp), *own])
        moves = _distances(len(graph.place), joined, graph.upright)
        result.append(replace(graph, edges=joined, moves=moves))
    return result


def _reversed(steps: int, number: int) -> Indices:
    return np.arange(steps * number).reshape(steps, number)[:, ::-1].ravel()


def _uphill(up: Array, heading: Indices, headings: int) -> Array:
    """Direction uphill in trunk axes: forward of the trunk for heading 0, then to the left."""
    ahead = tangent(up)
    angle = (2 * np.pi / headings * heading)[..., None]
    return np.cos(angle) * ahead + np.sin(angle) * np.cross(up, ahead)


def _distances(nodes: int, edges: Indices, goals: NDArray[np.bool_]) -> Indices:
    """Least number of edges from each node to a goal; -1 if there is no way."""
    moves = np.where(goals, 0, -1)
    step = 0
    while True:
        new = (moves[edges[:, 0]] < 0) & (moves[edges[:, 1]] == step)
        if not new.any():
            return moves
        step += 1
        moves[edges[new, 0]] = step


def require_upright(graph: Graph, name: str) -> None:
    """Raise LevadeError if the robot is upright in no posture.

    Args:
        graph: The graph.
        name: Name of the robot.

    Raises:
        LevadeError: If no node is upright.
    """
    if not graph.upright.any():
        slope = f" on a slope of {np.degrees(graph.slope):.3g} degrees" if graph.slope else ""
        raise LevadeError(
            f"robot {name}: rests on its feet alone in none of {graph.postures.count} postures{slope};"
            " robot.yaml, legs: {lf: {foot: ...}} names the shapes to stand on"
        )
