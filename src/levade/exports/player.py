#!/usr/bin/env python3
"""Play an exported motion on a robot. Needs only Python 3.10 and numpy.

    python player.py motion.csv --dry-run                       # without a robot: the file and the sequence, not the timing
    python player.py motion.csv --robot my_robot:MyRobot        # your class, see below

motion.csv is read together with the meta.json next to it; motion.json needs no other file. Your robot is a class with two
methods. Arrays are in the order of `Motion.joints`, in SI units:

    class MyRobot:
        joints = ["lf_haa", ...]                                # optional: compared with the motion's names

        def read(self):                                         # measured joint positions and velocities
            return position, velocity                           # (joints,) [rad], [rad/s]

        def write(self, position, velocity, torque, kp, kd):    # the command of each drive until the next call:
            ...                                                 # kp (position - q) + kd (velocity - qd) + torque; kp may be 0

        def read_trunk(self):                                   # needed for a stabiliser; optional without one
            return quaternion, rate                             # trunk to world, w x y z; (3,) [rad/s] in trunk axes

A motion may have a stabiliser (`feedback` in its meta; feedback.npz next to motion.csv). It corrects the positions from the
sensor readings, from the first row on. --no-feedback plays without it, and does not read the trunk.

At the rate of the file:

1. The joints must already be near the start and within their ranges, and the trunk near its attitude there. Otherwise nothing
   is sent.
2. The joints move to the start within the ramp, and must arrive.
3. Every row is sent at its time. The last one, and --hold after it, have velocity 0.

Every position that is sent is within the joint's range, and every torque within its limit. The motion stops if

- a joint is further from the simulation than the tolerance (in the ramp: from the ramp),
- a joint or the trunk moves much faster than it ever does in the simulation,
- the trunk is tilted further from the simulation than the tilt tolerance,
- a reading has another shape or is not finite, or a robot's method raises an exception,
- the loop, or a reading in it, is late,
- the program gets a signal to end.

After a stop, for a second, kp and torque are 0, kd is the file's, and the position is the last reading that passed every check.
Drives then damp. Drives that only know their own gains stay where they are. A failing write does not end the damping. Then your
controller takes over. The player does not know the height of the trunk, the ground, or people.

Exit status: 0 played to the end, 1 stopped, 2 the input is wrong.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import importlib
import io
import json
import math
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import numpy as np

Array = np.ndarray


class Robot(Protocol):
    """Describes the methods that a robot needs."""

    def read(self) -> tuple[Array, Array]:
        """Return positions [rad] and velocities [rad/s] of the joints, shape (joints,) each."""
        ...

    def write(self, position: Array, velocity: Array, torque: Array, kp: Array, kd: Array) -> None:
        """Command each drive until the next call, shape (joints,) each."""
        ...


class SensingRobot(Robot, Protocol):
    """Describes the method that a robot also needs for a stabiliser. Without a stabiliser the player checks the trunk by it."""

    def read_trunk(self) -> tuple[Array, Array]:
        """Return attitude, trunk to world, w-x-y-z (yaw does not matter), and angular velocity in trunk axes [rad/s]."""
        ...


class Stopped(Exception):
    """Says why a motion was not played to its end."""


class Astray(Stopped):
    """Says that the robot departs from the simulation. A library can be asked again where the robot is now."""


@dataclass(frozen=True, eq=False)
class Feedback:
    """A stabiliser: ``gain[j]`` times the deviation from ``reference[j]`` at tick j, in force from the next tick on.

    The sensed values are the upward direction in trunk axes (3), angular velocity in trunk axes (3) [rad/s], joint positions
    [rad] and joint velocities [rad/s].

    Attributes:
        gain: Gains, shape (gains, joints, sensed + joints). The last columns multiply the correction in force.
        reference: Expected sensed values, shape (ticks, sensed). After the last gain and reference, the last ones stay.
        rate: Ticks per second [Hz].
        bound: Largest correction of each joint [rad].
    """

    gain: Array
    reference: Array
    rate: float
    bound: float

    def correction(self, tick: int, measured: Array, last: Array) -> Array:
        """Compute the correction from the next tick on.

        Args:
            tick: Number of the tick.
            measured: Sensed values, shape (sensed,).
            last: Correction in force now [rad], shape (joints,).

        Returns:
            The correction [rad], shape (joints,).
        """
        off = np.concatenate([measured - self.reference[min(tick, len(self.reference) - 1)], last])
        gain = self.gain[min(tick, len(self.gain) - 1)]
        return np.clip(np.einsum("c,jc->j", off, gain), -self.bound, self.bound)

    def check(self, joints: int, rate: float) -> None:
        """Raise ValueError unless the stabiliser fits this many joints, and rows at this rate [Hz]."""
        fits = self.gain.shape[1:] == (joints, 6 + 3 * joints) and self.reference.shape[1:] == (6 + 2 * joints,)
        if not (fits and len(self.gain) and len(self.reference)):
            raise ValueError(f"its stabiliser is not one for {joints} joints")
        for name, values in (("gain", self.gain), ("reference", self.reference)):
            _check_numbers(f"feedback: {name}", values, values.shape, -LARGEST["gain"], LARGEST["gain"])
        if not 0.0 <= self.bound <= math.pi:
            raise ValueError(f"feedback: bound is {self.bound}; should be 0 to pi rad")
        rows = rate / self.rate if self.rate > 0 else 0.0
        if not (0.5 < rows < 1e6 and abs(rows - round(rows)) < 1e-6):
            raise ValueError(f"feedback: rate is {self.rate}; {rate:g} Hz should be a multiple of it")


def sensed(quaternion: Array, rate: Array, position: Array, velocity: Array) -> Array:
    """Compute the values that a stabiliser senses, shape (6 + 2 joints,)."""
    return np.concatenate([up_of(*quaternion), rate, position, velocity])


def up_of(w: Any, x: Any, y: Any, z: Any) -> list[Any]:
    """Return the direction opposite to gravity in trunk axes, for an attitude from trunk to world."""
    return [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]


LARGEST = {"position": 1e2, "velocity": 1e3, "torque": 1e5, "gain": 1e6}
"""Largest plausible values of a legged robot's joint [rad], [rad/s], [Nm], [Nm/rad] or [Nm s/rad]."""


@dataclass(frozen=True, eq=False)
class Motion:
    """An exported motion.

    Attributes:
        joints: Names of the joints, in the order of all arrays over joints.
        rate: Rows per second [Hz].
        position: Positions to send [rad], shape (rows, joints).
        velocity: Velocities to send [rad/s], shape (rows, joints).
        torque: Torques to send [Nm], shape (rows, joints).
        expected: Joint positions in the simulation [rad], shape (rows, joints).
        expected_velocity: Joint velocities in the simulation [rad/s], shape (rows, joints).
        up: Direction opposite to gravity in trunk axes in the simulation, shape (rows, 3).
        turning: Angular speed of the trunk in the simulation [rad/s], shape (rows,).
        kp: Position gains [Nm/rad], shape (joints,).
        kd: Velocity gains [Nm s/rad], shape (joints,).
        start_position: Positions to hold before the motion [rad], shape (joints,).
        start_torque: Torques that hold them [Nm], shape (joints,).
        lower: Lower ends of the ranges [rad], infinite for none, shape (joints,).
        upper: Upper ends of the ranges [rad], infinite for none, shape (joints,).
        torque_limit: Torque limits [Nm], infinite for none, shape (joints,).
        held: Joints without commands -> where the simulation held them [rad], for slides [m].

    Raises:
        ValueError: If a number is not plausible for a robot.
    """

    joints: list[str]
    rate: float
    position: Array
    velocity: Array
    torque: Array
    expected: Array
    expected_velocity: Array
    up: Array
    turning: Array
    kp: Array
    kd: Array
    start_position: Array
    start_torque: Array
    lower: Array
    upper: Array
    torque_limit: Array
    feedback: Feedback | None = None
    held: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        named = all(isinstance(name, str) and name and name.isprintable() for name in [*self.joints, *self.held])
        if not (self.joints and named and len({*self.joints, *self.held}) == len(self.joints) + len(self.held)):
            raise ValueError("joints: should be names, each there once")
        if not 0.01 <= self.rate <= 1e7:
            raise ValueError(f"rate: is {self.rate:g} Hz; should be 0.01 to 1e7")
        rows, joints, unbounded = len(self.position), len(self.joints), math.inf
        if not rows:
            raise ValueError("rows: there are none")
        table, each = (rows, joints), (joints,)
        for name, shape, least, most in (
            *((name, table, -LARGEST["position"], LARGEST["position"]) for name in ("position", "expected")),
            *((name, table, -LARGEST["velocity"], LARGEST["velocity"]) for name in ("velocity", "expected_velocity")),
            ("torque", table, -LARGEST["torque"], LARGEST["torque"]),
            ("up", (rows, 3), -1.001, 1.001),
            ("turning", (rows,), 0.0, LARGEST["velocity"]),
            *((name, each, 0.0, LARGEST["gain"]) for name in ("kp", "kd")),
            ("start_position", each, -LARGEST["position"], LARGEST["position"]),
            ("start_torque", each, -LARGEST["torque"], LARGEST["torque"]),
            *((name, each, -unbounded, unbounded) for name in ("lower", "upper")),
            ("torque_limit", each, 0.0, unbounded),
            ("held", (len(self.held),), -LARGEST["position"], LARGEST["position"]),
        ):
            values = np.array(list(self.held.values())) if name == "held" else getattr(self, name)
            names = self.joints if shape[-1:] == each else None
            _check_numbers(name, values, shape, least, most, names)
        if not (self.lower <= self.upper).all():
            raise ValueError(f"limits: the range of {self.joints[int(np.argmin(self.lower <= self.upper))]} is empty")
        if self.feedback is not None:
            self.feedback.check(joints, self.rate)

    @classmethod
    def load(cls, path: str | Path) -> Motion:
        """Read motion.json, or motion.csv and the meta.json next to it.

        Args:
            path: The file.

        Returns:
            The motion. Everything that is played has been checked, and is unchanged since the export.

        Raises:
            OSError: If a file cannot be read.
            ValueError: If a file does not belong to an export, was changed since, or has implausible numbers.
        """
        try:
            return cls._load(Path(path))
        except OSError:
            raise
        except KeyError as error:
            raise ValueError(f"{path}: has no {error}; give motion.csv or motion.json, as exported") from None
        except ValueError as error:
            raise ValueError(f"{path}: {_line(error)}; export the motion again") from None
        except Exception as error:
            what = f"{type(error).__name__}: {_line(error)}".rstrip(": ")
            raise ValueError(
                f"{path}: it, or a file next to it, is damaged ({what}); export the motion again"
            ) from None

    @classmethod
    def _load(cls, path: Path) -> Motion:
        meta, column, gains, sealed = (_read_json if path.suffix == ".json" else _read_csv)(path)
        joints = list(meta["joints"])
        over = lambda name: np.stack([column[name.format(joint)] for joint in joints], axis=-1)  # noqa: E731
        commands = {name: over(f"command/{{}}/{name}") for name in ("position", "velocity", "torque")}
        time, turning = column["time"], np.stack([column[f"state/trunk/angular_velocity/{axis}"] for axis in "xyz"])
        if len(time) != meta["rows"] or not all(np.isfinite(values).all() for values in (time, *commands.values())):
            raise ValueError(f"not {meta['rows']} rows of numbers, as its meta says")
        w, x, y, z = (column[f"state/trunk/quaternion/{part}"] for part in "wxyz")
        rows, rate, limits, start = len(time), _number("rate", meta["rate"]), meta["limits"], meta["start"]
        motion = cls(
            joints=joints,
            rate=rate,
            **commands,
            expected=over("state/{}/position"),
            expected_velocity=over("state/{}/velocity"),
            up=np.stack(up_of(w, x, y, z), axis=-1),
            turning=np.linalg.norm(turning, axis=0),
            kp=_numbers("kp", meta["kp"]),
            kd=_numbers("kd", meta["kd"]),
            start_position=_numbers("start: position", start["position"]),
            start_torque=_numbers("start: torque", start["torque"]),
            lower=_numbers("limits: lower", limits["lower"], -np.inf),
            upper=_numbers("limits: upper", limits["upper"], np.inf),
            torque_limit=_numbers("limits: torque", limits["torque"], np.inf),
            feedback=_feedback(meta.get("feedback"), gains, joints),
            held={name: _number(f"held: {name}", value) for name, value in meta.get("held", {}).items()},
        )
        if not np.abs(time - np.arange(rows) / rate).max() < 1e-6:
            raise ValueError(f"rate: is {rate:g} Hz, and its rows come at other times")
        if not np.abs(motion.start_position - motion.expected[0]).max() < 1e-6:
            raise ValueError("start: its position is not that of the first row")
        if not (np.abs(motion.start_torque) <= motion.torque_limit * (1 + 1e-9)).all():
            raise ValueError("start: its torque is beyond the limits")
        if not ((motion.expected > motion.lower - 0.5) & (motion.expected < motion.upper + 0.5)).all():
            raise ValueError("limits: the simulation had joints far beyond them")
        for name in ("kp", "kd"):
            if path.suffix != ".json" and not (over(f"command/{{}}/{name}") == getattr(motion, name)).all():
                raise ValueError(f"{name}: its rows have other gains than meta.json")
        if meta.get("checksum") != sealed:
            raise ValueError("was changed since it was exported, or a file next to it was (checksum)")
        return motion

    def sent(self, row: int, added: Array, clamp: bool) -> Array:
        """Return the position to send [rad], shape (joints,).

        Corrections do not move it beyond a joint's range, nor further beyond.
        """
        told = np.clip(self.position[row], self.lower, self.upper) if clamp else self.position[row]
        return np.clip(told + added, np.minimum(self.lower, told), np.maximum(self.upper, told))

    def clamped(self) -> tuple[Array, Array]:
        """Return positions clamped to the joints' ranges and torques clamped to their limits, shape (rows, joints) each."""
        return np.clip(self.position, self.lower, self.upper), np.clip(
            self.torque, -self.torque_limit, self.torque_limit
        )


def checksum(meta: dict[str, Any], *contents: bytes) -> str:
    """Compute the checksum of an export's meta, except its own "checksum", and of the files that belong to it.

    Args:
        meta: The meta, JSON.
        contents: With csv the bytes of motion.csv (lines end with a newline alone), and of feedback.npz if it exists; with json
            `canonical` of the rest of the document.

    Returns:
        The value that "checksum" should have.
    """
    digest = hashlib.sha256()
    for part in (canonical({key: value for key, value in meta.items() if key != "checksum"}), *contents):
        digest.update(len(part).to_bytes(8, "big") + part)
    return f"sha256:{digest.hexdigest()}"


def canonical(content: Any) -> bytes:
    """Return the same bytes for the same JSON in any layout."""
    return json.dumps(content, sort_keys=True, separators=(",", ":")).encode()


_Export = tuple[dict[str, Any], dict[str, Array], dict[str, Any], str]
"""meta; column of motion.csv -> values, shape (rows,); arrays of the stabiliser; checksum of what was read."""


def _read_json(path: Path) -> _Export:
    content = json.loads(path.read_text(encoding="utf-8"))
    meta, joints = content["meta"], content["meta"]["joints"]
    columns = {"time": np.array(content["time"], dtype=float)}
    for what in ("command", "state"):
        for name in ("position", "velocity", "torque"):
            table = np.array(content[what][name], dtype=float).reshape(len(columns["time"]), len(joints))
            columns |= {f"{what}/{joint}/{name}": table[:, i] for i, joint in enumerate(joints)}
    for name, parts in (("quaternion", "wxyz"), ("angular_velocity", "xyz")):
        table = np.array(content["state"]["trunk"][name], dtype=float).reshape(len(columns["time"]), len(parts))
        columns |= {f"state/trunk/{name}/{part}": table[:, i] for i, part in enumerate(parts)}
    rest = canonical({key: value for key, value in content.items() if key != "meta"})
    return meta, columns, content.get("feedback") or {}, checksum(meta, rest)


def _read_csv(path: Path) -> _Export:
    meta = json.loads(path.with_name("meta.json").read_text(encoding="utf-8"))
    text = path.read_bytes().replace(b"\r\n", b"\n")
    lines = csv.reader(io.StringIO(text.decode(), newline=""))
    header = next(lines, [])
    rows = [line for line in lines if line]
    if not header or len(set(header)) != len(header) or any(len(row) != len(header) for row in rows):
        raise ValueError("not a whole table")
    table = np.array(rows, dtype=float).reshape(len(rows), len(header))
    contents, gains = [text], {}
    if meta["feedback"]:
        contents.append(path.with_name("feedback.npz").read_bytes())
        with np.load(io.BytesIO(contents[-1]), allow_pickle=False) as file:
            gains = {name: file[name] for name in ("gain", "reference")}
    return meta, {name: table[:, i] for i, name in enumerate(header)}, gains, checksum(meta, *contents)


def _feedback(about: Any, gains: dict[str, Any], joints: list[str]) -> Feedback | None:
    """Return the stabiliser that a meta describes, with its arrays. None if it describes none."""
    if not about:
        return None
    seen = [f"{what}/{axis}" for what in ("up", "rate") for axis in "xyz"]
    seen += [f"{joint}/{what}" for what in ("position", "velocity") for joint in joints]
    if about["sensed"] != seen:
        raise ValueError("feedback: sensed are other things than the player reads")
    gain, reference = (np.array(gains[name], dtype=float) for name in ("gain", "reference"))
    return Feedback(gain, reference, *(_number(f"feedback: {name}", about[name]) for name in ("rate", "bound")))


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"{name}: is {_line(value)}; should be a number")
    return float(value)


def _numbers(name: str, values: Any, none: float | None = None) -> Array:
    """Return a list of JSON as an array. Null becomes `none`, if none is allowed."""
    if not isinstance(values, list):
        raise ValueError(f"{name}: is {_line(values)}; should be a list of numbers")
    empty = none is not None
    return np.array(
        [none if value is None and empty else _number(f"{name}[{i}]", value) for i, value in enumerate(values)],
        dtype=float,
    )


def _check_numbers(
    name: str, values: Array, shape: tuple[int, ...], least: float, most: float, joints: list[str] | None = None
) -> None:
    """Raise ValueError unless an array has a shape, and all its values are in a range."""
    if values.shape != shape:
        raise ValueError(f"{name}: has the shape {values.shape}; should be {shape}")
    wrong = np.argwhere(~((values >= least) & (values <= most)))
    if len(wrong):
        place = tuple(wrong[0])
        of = "" if joints is None else f" of {joints[place[-1]]}"
        raise ValueError(f"{name}{of}: is {values[place]:g}; should be {least:g} to {most:g}")


def _line(what: object, longest: int = 200) -> str:
    """Return text as one line that a terminal can show."""
    text = " ".join(str(what).split())
    text = "".join(char if char.isprintable() else "?" for char in text)
    return text if len(text) <= longest else f"{text[:longest]}..."


def play(
    motion: Motion,
    robot: Robot,
    *,
    ramp: float = 2.0,
    start_tolerance: float = 0.5,
    tolerance: float = 0.5,
    speed_tolerance: float = 20.0,
    tilt_tolerance: float = 1.0,
    hold: float = 0.0,
    feedback: bool = True,
    clamp: bool = True,
    wait: Callable[[float], float] | None = None,
    damping: Callable[[float], float] | None = None,
) -> float:
    """Play a motion.

    Args:
        motion: The motion.
        robot: The robot.
        ramp: Time from the present joint positions to the start [s]; 0 for none.
        start_tolerance: How far the joints may be from the start before the ramp, and from the ramp during it [rad]. Beyond it
            before the ramp, nothing is sent.
        tolerance: How far the joints may be from the simulation after the ramp [rad]. The stabiliser's correction in force is
            added to it.
        speed_tolerance: How much faster joints and trunk may move than they ever do in the simulation [rad/s].
        tilt_tolerance: Largest angle between the trunk's attitude and that in the simulation, without yaw [rad].
        hold: How long the last row is sent after the end [s].
        feedback: Whether to read the trunk, if the robot can, and to use the motion's stabiliser, if it has one. A stabiliser
            needs a robot with ``read_trunk``.
        clamp: Whether positions are kept within the joints' ranges. Without it, they may go as far as in the simulation, which
            suits commanded references on drives like the simulated ones.
        wait: Called before each tick, and again before its command is sent, with the tick's time since the first [s]. Returns
            how late it is [s]. Defaults to the clock.
        damping: The same for the second in which the drives damp after an error. Defaults to the clock if ``wait`` is the
            clock, otherwise to no waiting.

    Returns:
        The largest tracking error [rad].

    Raises:
        Stopped: If the motion did not begin, or was not played to its end. Exceptions of the robot's methods are passed on.
        ValueError: If a time or tolerance is negative or not finite.
    """
    times = {"ramp": ramp, "hold": hold}
    tolerances = {"start_tolerance": start_tolerance, "tolerance": tolerance}
    wider = {"speed_tolerance": speed_tolerance, "tilt_tolerance": tilt_tolerance}
    for name, value in (times | tolerances | wider).items():
        if not 0.0 <= value < np.inf:
            raise ValueError(f"{name}: {value} should be a number, 0 or more")
    check_robot(motion, robot, feedback=feedback)
    late = wait or clock()
    zero, period = np.zeros(len(motion.joints)), 1.0 / motion.rate
    correcting = _Correcting(motion.feedback, motion) if feedback and motion.feedback is not None else None
    trunk = _Trunk(motion, robot, speed_tolerance, tilt_tolerance) if feedback and _senses(robot) else None
    start = np.clip(motion.start_position, motion.lower, motion.upper)
    joints = _Joints(motion, robot, speed_tolerance, clamp=clamp)
    before = "before the ramp: bring it near the start first"
    # nothing is sent if the motion does not begin: the robot's own controller holds it
    present, _, _ = joints.read(motion.start_position, start_tolerance, before)
    joints.check_range(present)
    if trunk is not None:
        trunk.read(0, before)
    ticks, rows, holding = round(ramp * motion.rate), len(motion.position), round(hold * motion.rate)
    worst, led = 0.0, present
    try:
        for tick in range(ticks):
            _on_time(late(tick * period), motion.rate)
            when = f"in the ramp at {tick * period:.3f} s"
            joints.read(led, start_tolerance, when)
            if trunk is not None:
                trunk.read(0, when)
            led = present + _smooth((tick + 1) / ticks) * (start - present)
            share = _smooth(min(1.0, (tick + 1) * period / HOLDING))
            _on_time(late(tick * period), motion.rate)
            joints.write(led, zero, share * motion.start_torque, motion.kp, motion.kd)
        for tick in range(rows + holding):
            _on_time(late((ticks + tick) * period), motion.rate)
            row, holds = min(tick, rows - 1), tick >= rows
            added = zero if correcting is None else correcting.in_force(tick)
            when = f"in the hold at {(tick - rows) * period:.3f} s" if holds else f"at {tick * period:.3f} s"
            now, rate, off = joints.read(motion.expected[row], tolerance + np.abs(added), when)
            if trunk is not None and (correcting is None or correcting.measures(tick)):
                attitude, turning = trunk.read(row, when)
                if correcting is not None:
                    correcting.measure(tick, sensed(attitude, turning, now, rate))
            worst = max(worst, 0.0 if holds else off)
            going = motion.velocity[row] if row < rows - 1 else zero  # the last row ends the motion: nothing follows
            _on_time(late((ticks + tick) * period), motion.rate)
            joints.write(motion.sent(row, added, clamp), going, motion.torque[row], motion.kp, motion.kd)
    except BaseException as error:
        patience = damping or (clock() if wait is None else lambda instant: 0.0)
        if failed := _damp(joints, patience):
            error.__notes__ = [*getattr(error, "__notes__", []), *failed]
        raise
    return worst


def let_go(motion: Motion, robot: Robot, *, wait: Callable[[float], float] | None = None) -> list[str]:
    """Let drives that hold a motion's last command damp for a second.

    Args:
        motion: The motion.
        robot: The robot.
        wait: As for ``play``.

    Returns:
        A line about the commands that failed, if any did.
    """
    joints = _Joints(motion, robot, math.inf, clamp=True)
    joints.position = motion.expected[-1]
    return _damp(joints, wait or clock())


def check_robot(motion: Motion, robot: Any, *, feedback: bool = True) -> None:
    """Raise Stopped if a robot's joints have other names than the motion's, or if a stabiliser lacks its method."""
    names = getattr(robot, "joints", None)
    if names is not None:
        names = [str(name) for name in names] if isinstance(names, list | tuple | np.ndarray) else [_line(names)]
        other = [(own, theirs) for own, theirs in zip(motion.joints, names, strict=False) if own != theirs]
        if other or len(names) != len(motion.joints):
            order = "the same in another order" if sorted(names) == sorted(motion.joints) else _line(", ".join(names))
            raise Stopped(f"the robot's joints are {order}; should be {', '.join(motion.joints)}")
    if feedback and motion.feedback is not None and not _senses(robot):
        raise Stopped("the motion has a stabiliser, and the robot no read_trunk; add it, or play with --no-feedback")


def _senses(robot: Any) -> bool:
    return callable(getattr(robot, "read_trunk", None))


HOLDING = 0.02
"""Time within which the torque that holds the start is reached [s]. Without it a standing robot would sink."""


BEYOND = 0.1
"""How far beyond its range a joint may be before the ramp [rad], because soft stops give way."""


def _smooth(s: float) -> float:
    """Return a smooth step from 0 to 1 that begins and ends at rest."""
    return s * s * (3.0 - 2.0 * s)


def pair(what: str, values: Any, sizes: tuple[int, int]) -> tuple[Array, Array]:
    """Return two readings as new arrays. Raises Stopped unless they are finite and of these sizes."""
    try:
        one, other = (np.array(part, dtype=float) for part in values)
    except (TypeError, ValueError, OverflowError):
        raise Stopped(f"the robot reads {_line(values)} as {what}; should be two arrays of numbers") from None
    for part, name, size in zip((one, other), what.split(" and "), sizes, strict=True):
        if part.shape != (size,) or not np.isfinite(part).all():
            raise Stopped(f"the robot reads {_line(part.tolist())} as {name}; should be {size} numbers")
    return one, other


class _Joints:
    """Checks every reading of the robot's joints, and clamps every command.

    Arrays are copied in both directions, so the robot may keep using its own.
    """

    def __init__(self, motion: Motion, robot: Robot, speed_tolerance: float, *, clamp: bool) -> None:
        self.motion, self._robot = motion, robot
        self._fastest = np.abs(motion.expected_velocity).max(axis=0) + speed_tolerance
        self._lower, self._upper = motion.lower, motion.upper
        if not clamp:  # as far out as the motion's own commands
            self._lower = np.minimum(self._lower, motion.position.min(axis=0))
            self._upper = np.maximum(self._upper, motion.position.max(axis=0))
        self.position = motion.start_position
        """Last reading that passed every check [rad], shape (joints,)."""

    def read(self, expected: Array, tolerance: float | Array, when: str) -> tuple[Array, Array, float]:
        """Return position and velocity, shape (joints,) each, and the largest distance from the expected position [rad].

        Raises Stopped if a reading is not valid, or is further off than the tolerance.
        """
        joints = len(self.motion.joints)
        position, velocity = pair("position and velocity", self._robot.read(), (joints, joints))
        off = _check(self.motion, position, expected, tolerance, when)
        wild = np.abs(velocity) > self._fastest
        if wild.any():
            joint = int(np.argmax(wild))
            raise Astray(
                f"{self.motion.joints[joint]} moves at {velocity[joint]:.4g} rad/s, should be at most"
                f" {self._fastest[joint]:.4g} {when}"
            )
        self.position = position.copy()
        return position, velocity, off

    def check_range(self, position: Array) -> None:
        """Raise Stopped if a joint reads far beyond its range. The first command, clamped to the range, would be a jump."""
        beyond = np.maximum(self._lower - position, position - self._upper)
        joint = int(np.argmax(beyond))
        if not beyond[joint] <= BEYOND:
            raise Stopped(
                f"{self.motion.joints[joint]} is at {position[joint]:.3f} rad, {beyond[joint]:.3f} beyond its range: check"
                " its zero, or bring it into the range first"
            )

    def write(self, position: Array, velocity: Array, torque: Array, kp: Array, kd: Array) -> None:
        """Send a command. If it is not finite, raise Stopped and send nothing."""
        limit = self.motion.torque_limit
        command = (np.clip(position, self._lower, self._upper), velocity, np.clip(torque, -limit, limit), kp, kd)
        if not all(np.isfinite(values).all() for values in command):
            raise Stopped("a command would not be made of numbers, and is not sent")
        self._robot.write(*(values.copy() for values in command))


def trunk(robot: Any) -> tuple[Array, Array]:
    """Read the trunk: attitude, a unit quaternion, shape (4,), and rate [rad/s], shape (3,).

    Raises Stopped if they are not valid.
    """
    quaternion, rate = pair("the trunk's attitude and the trunk's rate", robot.read_trunk(), (4, 3))
    length = math.hypot(*quaternion)
    if not abs(length - 1.0) < 0.01:
        raise Stopped(f"the robot's trunk reads {quaternion.tolist()}; should be a unit quaternion")
    return quaternion / length, rate


class _Trunk:
    """Checks every reading of the robot's trunk."""

    def __init__(self, motion: Motion, robot: Any, speed_tolerance: float, tilt_tolerance: float) -> None:
        self._motion, self._robot, self._most = motion, robot, tilt_tolerance
        self._fastest = float(motion.turning.max()) + speed_tolerance

    def read(self, row: int, when: str) -> tuple[Array, Array]:
        """Return attitude, a unit quaternion, shape (4,), and rate [rad/s], shape (3,).

        Raises Stopped if they are far from the simulation.
        """
        quaternion, rate = trunk(self._robot)
        cosine = float(np.dot(up_of(*quaternion), self._motion.up[row]))
        tilt = math.acos(min(1.0, max(-1.0, cosine)))
        if not tilt <= self._most:
            raise Astray(
                f"the trunk is tilted by {tilt:.3f} rad from the simulation, should be by at most {self._most:g} {when}"
            )
        speed = math.hypot(*rate)
        if not speed <= self._fastest:
            raise Astray(f"the trunk turns at {speed:.4g} rad/s, should be at most {self._fastest:.4g} {when}")
        return quaternion, rate


class _Correcting:
    """Runs a stabiliser: it measures at its ticks, and keeps the correction in force."""

    def __init__(self, feedback: Feedback, motion: Motion) -> None:
        self._feedback = feedback
        self._rows = round(motion.rate / feedback.rate)
        self._due = self._last = np.zeros(len(motion.joints))

    def measures(self, tick: int) -> bool:
        """Tell whether a measurement is due."""
        return tick % self._rows == 0

    def in_force(self, tick: int) -> Array:
        """Return the correction to add now [rad], shape (joints,). Call it once a tick, before the measurement."""
        if self.measures(tick):
            self._last = self._due
        return self._last

    def measure(self, tick: int, seen: Array) -> None:
        """Take the sensed values at a tick."""
        self._due = self._feedback.correction(tick // self._rows, seen, self._last)


def _check(motion: Motion, position: Array, expected: Array, tolerance: float | Array, when: str) -> float:
    off = np.abs(position - expected)
    allowed = np.broadcast_to(tolerance, off.shape)
    joint = int(np.argmax(off - allowed))
    if not off[joint] <= allowed[joint]:
        raise Astray(
            f"{motion.joints[joint]} is at {position[joint]:.3f} rad, should be at {expected[joint]:.3f} within"
            f" {allowed[joint]:g}"
            f" {when}"
        )
    return float(off.max())


def _on_time(late: float, rate: float) -> None:
    if not late <= min(max(5.0 / rate, 0.02), 0.1):
        raise Stopped(f"the loop is {late * 1e3:.0f} ms late; {rate:g} Hz is too fast for it")


def _damp(joints: _Joints, wait: Callable[[float], float], seconds: float = 1.0) -> list[str]:
    """Let the drives only damp, wherever the joints are. Readings are no longer used.

    The position is the last known one: a drive that needs its own kp stays there. Nothing ends the damping early, not even
    Ctrl-C. Returns a line about the commands that failed, if any did.
    """
    motion = joints.motion
    zero, ticks = np.zeros(len(motion.joints)), max(1, round(seconds * motion.rate))
    failed, last = 0, ""
    for tick in range(ticks):
        try:
            if tick / motion.rate + wait(tick / motion.rate) > 2 * seconds:  # writes hang: it has taken long enough
                break
            joints.write(joints.position, zero, zero, zero, motion.kd)
        except BaseException as error:
            failed, last = failed + 1, f"{type(error).__name__}: {_line(error)}".rstrip(": ")
    return [f"while damping, {failed} of {ticks} commands did not get through ({last})"] if failed else []


def clock() -> Callable[[float], float]:
    """Return a function that waits for each instant since its first call, and returns how late it is."""
    began: list[float] = []

    def wait(instant: float) -> float:
        if not began:
            began.append(time.perf_counter() - instant)
        left = began[0] + instant - time.perf_counter()
        if left > 0:
            time.sleep(left)
        return max(0.0, -left)

    return wait


class StandIn:
    """Stands in for a robot in a dry run. Its joints follow the ramp and then the recorded motion, without simulation."""

    def __init__(self, motion: Motion, ramp: float) -> None:
        self._motion, self._ticks = motion, round(ramp * motion.rate)
        self._position, self.calls = motion.start_position + 0.05, 0

    def read(self) -> tuple[Array, Array]:
        """Return joint angles [rad] and velocities [rad/s]."""
        return self._position, np.zeros_like(self._position)

    def write(self, position: Array, velocity: Array, torque: Array, kp: Array, kd: Array) -> None:
        """Take the command of each drive."""
        row = self.calls - self._ticks + 1
        self._position = position if row <= 0 else self._motion.expected[min(row, len(self._motion.expected) - 1)]
        self.calls += 1


def main(arguments: list[str] | None = None) -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description="Play an exported motion on a robot.")
    parser.add_argument("motion", help="motion.csv (with meta.json next to it) or motion.json")
    parser.add_argument("--dry-run", action="store_true", help="play without a robot, without waiting")
    parser.add_argument("--robot", metavar="MODULE:CLASS", help="your class with read and write")
    parser.add_argument("--ramp", type=float, default=2.0, help="time to the start [s]; by default 2")
    parser.add_argument(
        "--start-tolerance",
        type=float,
        default=0.5,
        help="largest distance from the start before the ramp [rad]; by default 0.5",
    )
    add_tolerances(parser, joints=0.5, tilt=1.0)
    parser.add_argument(
        "--no-feedback", action="store_true", help="play without the stabiliser, and do not read the trunk"
    )
    parser.add_argument(
        "--hold", type=float, default=0.0, help="how long to send the last row after the end [s]; by default 0"
    )
    options = parser.parse_args(arguments)
    if options.dry_run == (options.robot is not None):
        parser.error("give one of --dry-run and --robot MODULE:CLASS")
    tolerances = (options.tolerance, options.start_tolerance, options.speed_tolerance, options.tilt_tolerance)
    if not all(0 <= value < np.inf for value in (options.ramp, options.hold, *tolerances)):
        parser.error("--ramp, --hold and tolerances should be numbers, 0 or more")
    try:
        motion = Motion.load(options.motion)
        robot: Any = StandIn(motion, options.ramp) if options.dry_run else load_robot(options.robot)
        check_robot(motion, robot, feedback=not (options.dry_run or options.no_feedback))
    except (OSError, ValueError, Stopped) as error:
        print(f"player: {error}", file=sys.stderr)
        return 2
    position, torque = motion.clamped()
    beyond = 0 if options.no_clamp else int((position != motion.position).sum())
    changed = beyond + int((torque != motion.torque).sum())
    rows = len(motion.position)
    print(f"{rows} rows at {motion.rate:g} Hz for {len(motion.joints)} joints: {', '.join(motion.joints)}")
    if motion.feedback is not None:
        off = " (not in a dry run)" if options.dry_run else " (switched off)" if options.no_feedback else ""
        print(
            f"with a stabiliser at {motion.feedback.rate:g} Hz, corrections of {motion.feedback.bound:g} rad at most{off}"
        )
    if motion.held:
        held = ", ".join(f"{joint} {angle:g}" for joint, angle in motion.held.items())
        print(f"not among them, hold them yourself where the simulation had them [rad, slides m]: {held}")
    if changed:
        print(f"{changed} commands of {2 * position.size} are beyond the joints' limits, and are clamped")
    if beyond and not motion.torque.any():  # commanded references: the torque is in how far out they are
        print("with them clamped it is not the simulated motion; on drives like the simulated ones: --no-clamp")
    try:
        worst = play(
            motion,
            robot,
            ramp=options.ramp,
            start_tolerance=options.start_tolerance,
            tolerance=options.tolerance,
            speed_tolerance=options.speed_tolerance,
            tilt_tolerance=options.tilt_tolerance,
            hold=options.hold,
            feedback=not (options.no_feedback or options.dry_run),
            clamp=not options.no_clamp,
            wait=(lambda instant: 0.0) if options.dry_run else None,
        )
    except (Exception, KeyboardInterrupt) as stopped:
        print(f"player: stopped: {'; '.join([why(stopped), *getattr(stopped, '__notes__', [])])}", file=sys.stderr)
        return 1
    print(f"played to the end; largest tracking error {worst:.4f} rad")
    return 0


def add_tolerances(parser: argparse.ArgumentParser, *, joints: float, tilt: float) -> None:
    """Add --tolerance, --tilt-tolerance, --speed-tolerance and --no-clamp, which ask.py takes, too.

    Args:
        parser: The parser.
        joints: Default of --tolerance [rad].
        tilt: Default of --tilt-tolerance [rad].
    """
    for option, default, what in (
        ("--tolerance", joints, "largest distance of joints from the simulation [rad]"),
        ("--tilt-tolerance", tilt, "largest tilt of the trunk from the simulation [rad]"),
        ("--speed-tolerance", 20.0, "largest speed beyond that in the simulation [rad/s]"),
    ):
        parser.add_argument(option, type=float, default=default, help=f"{what}; by default {default:g}")
    parser.add_argument(
        "--no-clamp", action="store_true", help="also send positions beyond the joints' ranges, as in the simulation"
    )


def why(stopped: BaseException) -> str:
    """Say in one line what ended a motion."""
    if isinstance(stopped, KeyboardInterrupt):
        return "interrupted"
    if isinstance(stopped, Stopped):
        return str(stopped)
    trace = stopped.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    where = "" if trace is None else f" ({Path(trace.tb_frame.f_code.co_filename).name}, line {trace.tb_lineno})"
    return f"{type(stopped).__name__}: {_line(stopped)}{where}"


def heed_signals() -> None:
    """Let kill and a lost terminal end the program as Ctrl-C does, with damping drives, unless they are ignored."""

    def interrupted(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, interrupted)


def load_robot(name: str) -> Any:
    """Make the robot that ``--robot MODULE:CLASS`` names."""
    module, _, kind = name.partition(":")
    if not kind:
        raise ValueError(f"--robot {name}: should be MODULE:CLASS, such as my_robot:MyRobot")
    sys.path.insert(0, str(Path.cwd()))
    try:
        robot = getattr(importlib.import_module(module), kind)()
    except Exception as error:  # whatever the robot's own code raises
        raise ValueError(f"--robot {name}: cannot be made ({type(error).__name__}: {error})") from error
    for method in ("read", "write"):
        if not callable(getattr(robot, method, None)):
            raise ValueError(f"--robot {name}: has no method {method}; it needs read and write")
    return robot


if __name__ == "__main__":
    heed_signals()
    sys.exit(main())
