"""Sampled postures of a robot: a grid over joint angles in which legs move together, and the steps between its postures.

    postures = Postures.of(load_robot("go1"))
    postures.hulls                       # one for each posture
    postures.steps                       # (steps, 2): the postures at both ends

All legs of a group take the same angles, mirrored. There are two ways to group: the left legs and the right ones, and the front
legs and the hind ones. A posture in which all legs agree belongs to both, so steps lead from one way to the other. Arms and
other limbs that do not stand keep their neutral angles.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.rightability.hulls import Hulls, Indices
from levade.robots import Robot
from levade.robots.shapes import support
from levade.robots.symmetry import mirror_signs
from levade.robots.understanding import Leg, joint_positions, moved_bodies

ANGLES = 27
"""Default for the largest number of combinations of angles that a leg takes."""
STRIDE = 0.35
"""[rad]: how far a joint moves at most before the robot is brought to rest again."""
_MOST = 100
_OVERLAP = 0.005
"""[m]: postures in which parts of the robot overlap by more are left out."""
_DIRECTIONS = np.array([d for d in itertools.product((-1.0, 0.0, 1.0), repeat=3) if any(d)])
"""Directions in trunk axes in which round shapes have corners."""


@dataclass(frozen=True, eq=False)
class Postures:
    """Holds postures as rigid bodies, and the steps that join them.

    Attributes:
        hulls: Hulls of the postures, in trunk axes.
        neutral: Number of the neutral posture.
        steps: The postures at both ends of each step, shape (steps, 2). A step goes both ways.
        middles: Number of postures between both ends of a step, shape (steps,).
        between: Makes the hulls of these postures, for steps with equally many: first all of the first step.
        on_feet: Whether only soles touch the ground when the body lies on a face, shape (postures, faces).
        values: Joint -> the angles that it takes on the first leg [rad].
        overlapping: Number of postures that were left out because parts overlap.
    """

    hulls: Hulls
    neutral: int
    steps: Indices
    middles: Indices
    between: Callable[[Indices], Hulls]
    on_feet: NDArray[np.bool_]
    values: dict[str, tuple[float, ...]]
    overlapping: int = 0

    @property
    def count(self) -> int:
        """Number of postures."""
        return len(self.on_feet)

    @classmethod
    def of(cls, robot: Robot, *, angles: int = ANGLES) -> Postures:
        """Sample a robot's postures.

        Args:
            robot: The robot.
            angles: Largest number of combinations of angles for each leg.

        Raises:
            LevadeError: If the legs are not mirror images, or the collision shapes have no hull.
        """
        body = _Body(robot, angles)
        every = body.postures()
        numbers = {posture: i for i, posture in enumerate(every)}
        paths: list[list[tuple[int, ...]]] = []
        steps = []
        for posture, i in numbers.items():
            for path, end in body.steps(posture):
                if end in numbers and not any(body.overlaps(middle) for middle in path):
                    steps.append((i, numbers[end]))
                    paths.append(path)

        def hulls(postures: list[tuple[int, ...]]) -> tuple[Hulls, list[NDArray[np.bool_]]]:
            points, soles, centres = zip(*map(body.points, postures), strict=True)
            return Hulls.of(points, np.array(centres)), list(soles)

        def between(chosen: Indices) -> Hulls:
            return hulls([middle for step in chosen for middle in paths[step]])[0]

        own, soles = hulls(every)
        return cls(
            own,
            numbers[body.neutral],
            np.array(steps, dtype=np.intp).reshape(-1, 2),
            np.array([len(path) for path in paths], dtype=np.intp),
            between,
            on_soles(own, soles),
            {joint: tuple(v) for joint, v in zip(body.legs[0].joints, body.values, strict=True)},
            body.left_out,
        )


def on_soles(hulls: Hulls, soles: list[NDArray[np.bool_]]) -> NDArray[np.bool_]:
    """Say for the first hulls on which faces only soles touch the ground.

    Args:
        hulls: The hulls.
        soles: Which points of a hull belong to soles, for each hull.

    Returns:
        Shape (len(soles), faces). It counts all triangles in the plane of a face.
    """
    result = np.zeros((len(soles), hulls.normal.shape[1]), dtype=bool)
    for i, sole in enumerate(soles):
        own = np.all(sole[hulls.corner[i]], axis=-1)
        whole = np.ones(result.shape[1], dtype=bool)
        np.logical_and.at(whole, hulls.plane[i], own)
        result[i] = whole[hulls.plane[i]]
    return result


class _Body:
    """The parts of a robot that are rigid in themselves, at every state of a leg.

    A state is a number: first the combinations of grid values, then what is between two of them. A posture is a state for each
    leg.
    """

    def __init__(self, robot: Robot, angles: int) -> None:
        if not 1 <= angles <= _MOST:
            raise LevadeError(f"is {angles}; should be from 1 to {_MOST}", field="angles")
        self.robot, self.legs = robot, robot.standing
        self.values = _values(robot, self.legs[0], angles)
        grid = list(itertools.product(*(range(len(values)) for values in self.values)))
        self.states = [tuple(v[k] for v, k in zip(self.values, place, strict=True)) for place in grid]
        self.grid = len(grid)
        place_of = {place: i for i, place in enumerate(grid)}
        self.next: dict[int, list[tuple[list[int], int]]] = {i: [] for i in range(len(grid))}
        for i, place in enumerate(grid):
            for joint in range(len(place)):
                other = place_of.get((*place[:joint], place[joint] + 1, *place[joint + 1 :]))
                if other is None:
                    continue
                one, end = np.array(self.states[i]), np.array(self.states[other])
                strides = max(1, math.ceil(float(np.abs(end - one).max()) / STRIDE))
                first = len(self.states)
                self.states += [tuple(one + k / strides * (end - one)) for k in range(1, strides)]
                self.next[i].append((list(range(first, len(self.states))), other))
        self.signs = [
            np.ones(len(self.legs[0].joints)) if leg is self.legs[0] else mirror_signs(robot, self.legs[0], leg)
            for leg in self.legs
        ]
        home = robot.postures["neutral"][robot.joint_indices(self.legs[0])]
        self.neutral = (self.states.index(tuple(home.tolist())),) * len(self.legs)
        self.groups = self._groups()
        self.left_out = 0
        self._data = robot.data_at(robot.postures["neutral"])
        self._addresses = joint_positions(robot.model, robot.joint_names)
        self._shapes = self._measure()

    def _groups(self) -> list[list[int]]:
        """For each way to group, which legs are in the first group."""
        ways = [[i for i, leg in enumerate(self.legs) if test(leg)] for test in (_is_left, _is_front)]
        return [way for way in ways if 0 < len(way) < len(self.legs)]

    def _spread(self, way: list[int], one: int, other: int) -> tuple[int, ...]:
        return tuple(one if leg in way else other for leg in range(len(self.legs)))

    def postures(self) -> list[tuple[int, ...]]:
        """The postures in which parts do not overlap, and the neutral one."""
        every = dict.fromkeys(
            self._spread(way, *pair) for way in self.groups for pair in itertools.product(range(self.grid), repeat=2)
        )
        kept = [states for states in every if states == self.neutral or not self.overlaps(states)]
        self.left_out = len(every) - len(kept)
        return kept

    def steps(self, states: tuple[int, ...]) -> list[tuple[list[tuple[int, ...]], tuple[int, ...]]]:
        """Steps upward from a posture: what is between, and the end of each."""
        found = []
        for way in self.groups:
            one, other = states[way[0]], states[next(i for i in range(len(states)) if i not in way)]
            if self._spread(way, one, other) != states:
                continue
            for path, end in self.next[one]:
                found.append(([self._spread(way, m, other) for m in path], self._spread(way, end, other)))
            for path, end in self.next[other]:
                found.append(([self._spread(way, one, m) for m in path], self._spread(way, one, end)))
        return found

    def overlaps(self, states: tuple[int, ...]) -> bool:
        """Say whether parts of the robot overlap."""
        model, data = self.robot.model, self._data
        data.qpos[self._addresses] = self._angles(states)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        contact = data.contact
        return bool(np.any((np.asarray(contact.dist) < -_OVERLAP) & (np.asarray(contact.exclude) == 0)))

    def points(self, states: tuple[int, ...]) -> tuple[Array, NDArray[np.bool_], Array]:
        """Points in trunk axes, which of them are soles, and the centre of mass."""
        rest, *legs = self._shapes
        parts = [rest[0], *(leg[state] for leg, state in zip(legs, states, strict=True))]
        mass = sum(part[2] for part in parts)
        moment = np.sum([part[3] for part in parts], axis=0)
        return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts]), moment / mass

    def _angles(self, states: tuple[int, ...]) -> Array:
        angles, limits = self.robot.postures["neutral"].copy(), self.robot.limits
        for leg, signs, state in zip(self.legs, self.signs, states, strict=True):
            joints = self.robot.joint_indices(leg)
            angles[joints] = np.clip(signs * self.states[state], limits.lower[joints], limits.upper[joints])
        return angles

    def _measure(self) -> list[list[tuple[Array, NDArray[np.bool_], float, Array]]]:
        """For the rest of the robot, and each leg at each state: points, soles, mass, and mass times place."""
        model, data, robot = self.robot.model, self._data, self.robot
        moved = [np.asarray(moved_bodies(model, leg)) for leg in self.legs]
        bodies = [np.isin(np.arange(model.nbody), own) for own in moved]
        rest = ~np.any(bodies, axis=0)
        rest[0] = False
        feet = {model.geom(geom).id for leg in self.legs for geom in leg.soles}
        parts: list[list[tuple[Array, NDArray[np.bool_], float, Array]]] = [[] for _ in range(1 + len(bodies))]
        trunk = model.body(robot.trunk).id
        for state in range(len(self.states)):
            data.qpos[self._addresses] = self._angles((state,) * len(self.legs))
            mujoco.mj_kinematics(model, data)
            turn, place = data.xmat[trunk].reshape(3, 3), data.xpos[trunk]
            for part, own in zip(parts, (rest, *bodies), strict=True):
                if state and own is rest:
                    continue
                points, soles = _points(model, data, own, feet, turn)
                masses = model.body_mass[own]
                moment = masses @ ((data.xipos[own] - place) @ turn)
                part.append(((points - place) @ turn, soles, float(masses.sum()), moment))
        return parts


def _is_left(leg: Leg) -> bool:
    return leg.side == "left"


def _is_front(leg: Leg) -> bool:
    return leg.end == "front"


def _values(robot: Robot, leg: Leg, most: int) -> list[list[float]]:
    """Angles that each joint of a leg takes [rad]; joints with a wide range get more."""
    joints = robot.joint_indices(leg)
    lower, upper = robot.limits.lower[joints], robot.limits.upper[joints]
    neutral = robot.postures["neutral"][joints]
    endless = ~np.isfinite(upper - lower)
    lower, upper = np.where(endless, neutral - np.pi, lower), np.where(endless, neutral + np.pi, upper)
    counts = np.ones(len(neutral), dtype=int)
    while True:
        # every joint that can gets both ends of its range before one gets more values
        spacing = np.where(counts == 1, 1e3 * (upper - lower), (upper - lower) / np.maximum(counts - 1, 1))
        for joint in np.argsort(-spacing):
            more = counts.copy()
            more[joint] = 3 if counts[joint] == 1 else counts[joint] + 1
            if more.prod() <= most:
                break
        else:
            break
        counts = more
    values = []
    for low, high, home, count in zip(lower.tolist(), upper.tolist(), neutral.tolist(), counts.tolist(), strict=True):
        grid = np.linspace(low, high, count).tolist() if count > 1 else [home]
        if count > 1:
            inner = min(range(1, count - 1), key=lambda k: abs(grid[k] - home))
            grid[inner] = home
        values.append(grid)
    return values


def _points(
    model: mujoco.MjModel, data: mujoco.MjData, bodies: NDArray[np.bool_], feet: set[int], turn: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Corners of the bodies' collision shapes in the world, and which of them are soles'."""
    points: list[Array] = [np.empty((0, 3))]
    soles: list[NDArray[np.bool_]] = [np.empty(0, dtype=bool)]
    for geom in range(model.ngeom):
        if not bodies[model.geom_bodyid[geom]] or not (model.geom_contype[geom] or model.geom_conaffinity[geom]):
            continue
        own = np.unique([support(model, data, geom, turn @ d).round(7) for d in _DIRECTIONS], axis=0)
        points.append(own)
        soles.append(np.full(len(own), geom in feet))
    found, sole = np.concatenate(points), np.concatenate(soles)
    return _outermost(found, sole)


def _outermost(points: Array, soles: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
    """Leave out points inside the hull of a leg or trunk."""
    from scipy.spatial import ConvexHull, QhullError

    if len(points) < 5:
        return points, soles
    try:
        outer = ConvexHull(points).vertices
    except QhullError:  # flat: nothing is inside
        return points, soles
    return points[outer], soles[outer]
