"""How a motion starts: standing in a posture, lying after a fall, one of a family of them, or as an earlier motion ended."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from levade.errors import LevadeError


@dataclass(frozen=True)
class Settled:
    """Standing on the ground in a posture, at rest.

    The robot is put down level, with its lowest foot touching (or whatever is lower), above the point x, y, and holds
    the posture with its own gains for ``time`` [s]; it sags a little, as its joints give way to gravity.

    Attributes:
        posture: Name of a posture of the robot; or, on top of the neutral one, joint -> angle [rad], and leg, "front",
            "hind", "left" or "right" -> name of the posture that these legs take.
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
    """Lying as a fall with weak joints left it: deterministic, from the numbers here.

    Attributes:
        height: [m], trunk's origin over z = 0 at release; higher where a part of the robot would be in the ground.
        x: [m].
        y: [m].
        roll: [rad] at release, z-y-x.
        pitch: [rad] at release, z-y-x.
        yaw: [rad] at release, z-y-x.
        posture: As in `Settled`; the joints hold it with ``gain`` times their gains while they fall.
        time: [s] from release to the start of the motion.
        spread: [rad], standard deviation of random changes of the joints and of roll, pitch and yaw at release, drawn
            with ``seed``: a family of falls for a library or a test.
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
    """What a robot does first once it has fallen: its joints go to a posture, smoothly, and rest there.

    posture: as in `Settled`; or "tucked", with the legs drawn in (`levade.robots.tucking`): it then lies in one of a few
        ways, however it fell.
    time: [s], of going there. rest: [s], until the motion starts.
    """

    posture: str | Mapping[str, float | str] = "tucked"
    time: float = 1.0
    rest: float = 0.5

    def __post_init__(self) -> None:
        for name in ("time", "rest"):
            _check_time(f"start.fallen.fold.{name}", getattr(self, name))


@dataclass(frozen=True)
class Fallen:
    """Lying however it fell: one of a family of falls, from any attitude and with any posture.

    The attitude is uniform over all rotations. Each joint's angle is uniform over its range, a whole turn if it has
    none, and all are drawn again where parts of the robot overlap each other or an obstacle.

    Attributes:
        height: [m], trunk's origin over the ground under it at release; higher where a part of the robot would be in
            the ground.
        x: [m].
        y: [m].
        gain: The joints hold the angles that they were released with, with this many times their gains.
        time: [s] from release to the start of the motion.
        seed: Which fall of which family. A fall does not depend on how many of its family are asked for.
        index: Which fall of which family. A fall does not depend on how many of its family are asked for.
        fold: What the joints do then, before the motion starts; None if nothing.
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
        qpos: In the model's own order, SI.
        qvel: In the model's own order, SI.
        act: In the model's own order, SI.
        joint_reference: What the joints were commanded last [rad], in the robot's joint order.
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
"""[s], of simulation before a motion starts: a minute of computing, where robots come to rest in seconds."""


def _check_time(name: str, time: float) -> None:
    if not (math.isfinite(time) and 0 <= time <= _LONGEST):
        raise LevadeError(f"{name}: {time} s is not a duration from 0 to {_LONGEST:g} s")
