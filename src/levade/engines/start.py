"""How a motion starts: standing in a posture, lying after a fall or one of a family of falls, or where a motion ended."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from levade.errors import LevadeError


@dataclass(frozen=True)
class Settled:
    """Standing on the ground in a posture, at rest.

    The robot is put down level above the point x, y, with its lowest foot (or any lower part) touching the ground. It holds the
    posture with its own gains for ``time`` [s], and sags a little, because its joints give way to gravity.

    Attributes:
        posture: Name of a posture of the robot. Or a table that changes the neutral posture: joint -> angle [rad], and limbs,
            such as "hind" or "arm" -> name of the posture that they take. See `levade.robots.Robot.posture`.
        x: Position [m].
        y: Position [m].
        time: Time to come to rest [s].
    """

    posture: str | Mapping[str, float | str] = "neutral"
    x: float = 0.0
    y: float = 0.0
    time: float = 2.0

    def __post_init__(self) -> None:
        _check_time("start.settled.time", self.time)
        _check_finite("start.settled", x=self.x, y=self.y)


@dataclass(frozen=True)
class Fall:
    """Lying after a fall with weak joints. The same numbers give the same fall.

    Attributes:
        height: Height of the trunk's origin over z = 0 at release [m]. It is higher if a part of the robot would be in the
            ground.
        x: Position at release [m].
        y: Position at release [m].
        roll: Roll at release [rad], z-y-x.
        pitch: Pitch at release [rad], z-y-x.
        yaw: Yaw at release [rad], z-y-x.
        posture: Posture as in `Settled`, which the joints hold during the fall.
        gain: Factor on the gains of the joints during the fall.
        time: Time from release to the start of the motion [s].
        spread: Standard deviation of random changes of the joints and of roll, pitch and yaw at release [rad]: a family of
            falls.
        seed: Seed of these changes.
    """

    height: float
    x: float = 0.0
    y: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0
    posture: str | Mapping[str, float | str] = "neutral"
    gain: float = 0.1
    time: float = 1.5
    spread: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        _check_time("start.fall.time", self.time)
        places = {name: getattr(self, name) for name in ("height", "x", "y", "roll", "pitch", "yaw")}
        _check_finite("start.fall", **places)
        for name in ("gain", "spread"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise LevadeError(f"start.fall.{name}: {value} should be 0 or more")


@dataclass(frozen=True)
class Fold:
    """How a robot folds up after it has fallen: its joints move smoothly to a posture, and rest there.

    Attributes:
        posture: Posture as in `Settled`; or "tucked", with the legs drawn in (`levade.robots.tucking`), in which it lies in one
            of a few ways.
        time: Duration of the movement [s].
        rest: Time at rest until the motion starts [s].
        jammed: Distance of a joint from the posture [rad] beyond which a leg counts as jammed. A robot with a jammed leg
            stretches its legs and folds up once more, if it has a posture "stretched". None for never.
    """

    posture: str | Mapping[str, float | str] = "tucked"
    time: float = 1.0
    rest: float = 0.5
    jammed: float | None = 0.5

    def __post_init__(self) -> None:
        for name in ("time", "rest"):
            _check_time(f"start.fallen.fold.{name}", getattr(self, name))
        if self.jammed is not None and not (math.isfinite(self.jammed) and self.jammed > 0):
            raise LevadeError(
                f"start.fallen.fold.jammed: {self.jammed} should be a positive angle [rad], such as 0.5, or null"
            )


@dataclass(frozen=True)
class Fallen:
    """Lying after one of a family of falls, from any attitude and with any posture.

    The attitude is uniform over all rotations. Each joint's angle is uniform over its range, or over a turn if that is
    less. All angles are drawn again if parts of the robot overlap each other or an obstacle.

    Attributes:
        height: Height of the trunk's origin over the ground below it at release [m]. It is higher if a part of the robot would
            be in the ground.
        x: Position at release [m].
        y: Position at release [m].
        gain: Factor on the gains with which the joints hold their angles at release.
        time: Time from release to the start of the motion, or to the fold [s].
        seed: Seed of the family.
        index: Number of the fall in its family. A fall does not depend on how many others are used.
        fold: What the joints do before the motion starts. None for nothing.
    """

    height: float
    x: float = 0.0
    y: float = 0.0
    gain: float = 1.0
    time: float = 1.5
    seed: int = 0
    index: int = 0
    fold: Fold | None = None

    def __post_init__(self) -> None:
        _check_time("start.fallen.time", self.time)
        _check_finite("start.fallen", height=self.height, x=self.x, y=self.y)
        if not (math.isfinite(self.gain) and self.gain >= 0):
            raise LevadeError(
                f"start.fallen.gain: {self.gain} should be 0 or more; 1 is a robot that holds on as it falls"
            )
        for name in ("seed", "index"):
            if getattr(self, name) < 0:
                raise LevadeError(f"start.fallen.{name}: {getattr(self, name)} should be 0 or more")


@dataclass(frozen=True)
class GivenState:
    """A state in numbers, such as the end of an earlier motion (`levade.motions.end_of`).

    Attributes:
        qpos: Positions in the model's own order, SI.
        qvel: Velocities in the model's own order, SI.
        act: States of the actuators in the model's own order, SI.
        joint_reference: Last commands of the joints [rad], in the robot's joint order.
    """

    qpos: tuple[float, ...]
    qvel: tuple[float, ...]
    act: tuple[float, ...]
    joint_reference: tuple[float, ...]

    def __post_init__(self) -> None:
        for name in ("qpos", "qvel", "act", "joint_reference"):
            if not all(map(math.isfinite, getattr(self, name))):
                raise LevadeError(f"start.state.{name}: not all of it are finite numbers")


Start = Settled | Fall | Fallen | GivenState


def _check_finite(where: str, **values: float) -> None:
    for name, value in values.items():
        if not math.isfinite(value):
            raise LevadeError(f"{where}.{name}: {value} is not a number")


_LONGEST = 600.0
"""Largest simulated time before a motion starts [s]: a minute of computing. Robots come to rest in seconds."""


def _check_time(name: str, time: float) -> None:
    if not (math.isfinite(time) and 0 <= time <= _LONGEST):
        raise LevadeError(f"{name}: {time} s is not a duration from 0 to {_LONGEST:g} s")
