#!/usr/bin/env python3
"""Play an exported motion on a robot. Needs Python 3.10 and numpy, nothing else.

    python player.py motion.csv --dry-run                       # without a robot: the file and the sequence, not the timing
    python player.py motion.csv --robot my_robot:MyRobot        # MyRobot is yours, see below

motion.csv is read together with the meta.json beside it; motion.json needs nothing beside it. Your robot is a class with two
methods; arrays are in the order of `Motion.joints`, SI units:

    class MyRobot:
        def read(self):                                         # what the joints do now
            return position, velocity                           # (joints,) [rad], [rad/s]

        def write(self, position, velocity, torque, kp, kd):    # what each drive is to do until the next call:
            ...                                                 # kp (position - q) + kd (velocity - qd) + torque; kp may be 0

        def read_trunk(self):                                   # only for a motion with a stabiliser:
            return quaternion, rate                             # trunk to world, w x y z; (3,) [rad/s] in trunk axes

A motion with a stabiliser (`feedback` in its meta; feedback.npz beside motion.csv) corrects the positions by what the robot
senses, from the first row on; --no-feedback plays it without.

What happens, at the rate of the file: the joints have to be near the start already, or nothing is sent at all; they are led
from where they are to the start within the ramp, and have to be there; then every row is sent at its time, positions clamped
to the joints' ranges and torques to their limits; with the last one, and for as long as --hold, the velocity is 0. If a
joint is further from where the simulation had it than the tolerance (in the ramp: from where it is led than the start
tolerance), or a reading is not a number, or the loop comes too late, or the program is told to end, the motion is stopped:
for a second kp is 0 and the position is where the joints were last read, so that drives damp, or stay where they are if they
know no gains but their own. Then it is your controller's turn again. The attitude and height of the trunk are not looked at:
that is yours to do before.

Exit status: 0 played to the end, 1 stopped, 2 the input is wrong.
"""

from __future__ import annotations

import argparse
import csv
import importlib
import json
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np

Array = np.ndarray


class Robot(Protocol):
    """What the player asks of a robot."""

    def read(self) -> tuple[Array, Array]:
        """Position [rad] and velocity [rad/s] of the joints, (joints,) each."""
        ...

    def write(self, position: Array, velocity: Array, torque: Array, kp: Array, kd: Array) -> None:
        """What each drive is to do until the next call, (joints,) each."""
        ...


class SensingRobot(Robot, Protocol):
    """What the player asks of a robot beside, if the motion has a stabiliser."""

    def read_trunk(self) -> tuple[Array, Array]:
        """Attitude, trunk to world, w-x-y-z (yaw does not matter), and angular velocity in trunk axes [rad/s]."""
        ...


class Stopped(Exception):
    """The motion was not played to its end; why."""


@dataclass(frozen=True, eq=False)
class Feedback:
    """A stabiliser: ``gain[j]`` times the deviation from ``reference[j]`` at tick j, in force from the next tick on.

    gain: (gains, joints, sensed + joints); the last columns are for the correction in force. reference: (ticks, sensed). After
    the last of each the last one stays. rate: [Hz], of ticks. bound: [rad], on each joint's correction.
    Sensed are: up in trunk axes (3), angular velocity in trunk axes (3) [rad/s], joint positions [rad] and velocities [rad/s].
    """

    gain: Array
    reference: Array
    rate: float
    bound: float

    def correction(self, tick: int, measured: Array, last: Array) -> Array:
        """(joints,) [rad], from the next tick on. measured: (sensed,). last: (joints,) [rad], in force now."""
        off = np.concatenate([measured - self.reference[min(tick, len(self.reference) - 1)], last])
        gain = self.gain[min(tick, len(self.gain) - 1)]
        return np.clip(np.einsum("c,jc->j", off, gain), -self.bound, self.bound)


def sensed(quaternion: Array, rate: Array, position: Array, velocity: Array) -> Array:
    """What a stabiliser looks at, (6 + 2 joints,)."""
    w, x, y, z = quaternion
    up = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
    return np.concatenate([up, rate, position, velocity])


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion as exported. Arrays (rows, joints): what to send, and where the simulation had the joints.

    start_position, start_torque: what to hold before; lower, upper, torque_limit: infinite for none; (joints,) each.
    """

    joints: list[str]
    rate: float
    position: Array
    velocity: Array
    torque: Array
    expected: Array
    kp: Array
    kd: Array
    start_position: Array
    start_torque: Array
    lower: Array
    upper: Array
    torque_limit: Array
    feedback: Feedback | None = None

    @classmethod
    def load(cls, path: str | Path) -> Motion:
        """Read motion.json, or motion.csv and the meta.json beside it. Raises OSError or ValueError."""
        try:
            return cls._load(Path(path))
        except (OSError, ValueError):
            raise
        except KeyError as error:
            raise ValueError(f"{path}: has no {error}; give motion.csv or motion.json, as exported") from None
        except Exception as error:
            what = f"{type(error).__name__}: {error}".rstrip(": ")
            raise ValueError(f"{path}: it, or a file beside it, is damaged ({what}); export the motion again") from None

    @classmethod
    def _load(cls, path: Path) -> Motion:
        if path.suffix == ".json":
            content = json.loads(path.read_text(encoding="utf-8"))
            meta, command = content["meta"], content["command"]
            arrays = {name: np.array(command[name], dtype=float) for name in ("position", "velocity", "torque")}
            arrays["expected"] = np.array(content["state"]["position"], dtype=float)
            gains = content.get("feedback") or {}
        else:
            meta = json.loads(path.with_name("meta.json").read_text(encoding="utf-8"))
            with path.open(encoding="utf-8", newline="") as file:
                lines = csv.reader(file)
                header = next(lines, [])
                rows = [line for line in lines if line]
            if not header or any(len(row) != len(header) for row in rows):
                raise ValueError(f"{path}: not a whole table; export the motion again")
            table = np.array(rows, dtype=float).reshape(len(rows), len(header))
            place = {name: i for i, name in enumerate(header)}
            pick = lambda what, name: table[:, [place[f"{what}/{joint}/{name}"] for joint in meta["joints"]]]  # noqa: E731
            arrays = {name: pick("command", name) for name in ("position", "velocity", "torque")}
            arrays["expected"] = pick("state", "position")
            gains = {}
            if meta.get("feedback"):
                with np.load(path.with_name("feedback.npz"), allow_pickle=False) as file:
                    gains = {name: file[name] for name in ("gain", "reference")}
        if not all(np.isfinite(values).all() and len(values) == meta["rows"] for values in arrays.values()):
            raise ValueError(f"{path}: not {meta['rows']} rows of numbers, as its meta says; export the motion again")
        limits = meta["limits"]
        feedback = None
        if meta.get("feedback"):
            gain, reference = (np.array(gains[name], dtype=float) for name in ("gain", "reference"))
            joints, about = len(meta["joints"]), meta["feedback"]
            fits = gain.shape[1:] == (joints, 6 + 3 * joints) and reference.shape[1:] == (6 + 2 * joints,)
            if not (fits and np.isfinite(gain).all() and np.isfinite(reference).all()):
                raise ValueError(f"{path}: its stabiliser is not one for {joints} joints; export the motion again")
            feedback = Feedback(gain, reference, float(about["rate"]), float(about["bound"]))
        bound = lambda name, none: np.array([none if value is None else value for value in limits[name]], dtype=float)  # noqa: E731
        return cls(
            joints=list(meta["joints"]),
            rate=float(meta["rate"]),
            kp=np.array(meta["kp"], dtype=float),
            kd=np.array(meta["kd"], dtype=float),
            start_position=np.array(meta["start"]["position"], dtype=float),
            start_torque=np.array(meta["start"]["torque"], dtype=float),
            lower=bound("lower", -np.inf),
            upper=bound("upper", np.inf),
            torque_limit=bound("torque", np.inf),
            feedback=feedback,
            **arrays,
        )

    def sent(self, row: int, added: Array, clamp: bool) -> Array:
        """Position to send, (joints,) [rad]: corrections do not take it out of the joints' ranges, nor further out."""
        told = np.clip(self.position[row], self.lower, self.upper) if clamp else self.position[row]
        return np.clip(told + added, np.minimum(self.lower, told), np.maximum(self.upper, told))

    def clamped(self) -> tuple[Array, Array]:
        """Positions within the joints' ranges and torques within their limits, (rows, joints)."""
        return np.clip(self.position, self.lower, self.upper), np.clip(
            self.torque, -self.torque_limit, self.torque_limit
        )


def play(
    motion: Motion,
    robot: Robot,
    *,
    ramp: float = 2.0,
    start_tolerance: float = 0.5,
    tolerance: float = 0.5,
    hold: float = 0.0,
    feedback: bool = True,
    clamp: bool = True,
    wait: Callable[[float], float] | None = None,
) -> float:
    """Play a motion. Returns the largest tracking error [rad]. Raises Stopped, and ValueError of times and tolerances.

    ramp: [s], from the present joint positions to the start; 0 for none. start_tolerance: [rad], how far the joints may be
    from the start before the ramp (else nothing is sent), and in it from where they are led. tolerance: [rad], how far from
    where the simulation had them, from the end of the ramp on. hold: [s], for which the last row is sent on after the end.
    feedback: whether to use the motion's stabiliser, if it has one; the robot then needs ``read_trunk``. The tolerance
    is wider by the correction in force. clamp: whether positions are kept within the joints' ranges; without it, they go
    as far out as they were told in the simulation: for commanded references on drives like the simulated ones.
    wait: called before each tick with its time [s] since the first; returns how late it is [s]. By default the clock.
    """
    for name, value in {"ramp": ramp, "start_tolerance": start_tolerance, "tolerance": tolerance, "hold": hold}.items():
        if not 0.0 <= value < np.inf:
            raise ValueError(f"{name}: {value} should be a number, 0 or more")
    late = wait or clock()
    zero, period = np.zeros(len(motion.joints)), 1.0 / motion.rate
    torque = motion.clamped()[1]
    correcting = _Correcting(motion, robot) if feedback and motion.feedback is not None else None
    start = np.clip(motion.start_position, motion.lower, motion.upper)
    joints = _Joints(motion, robot)
    present, _ = joints.read()  # nothing is sent if the motion does not begin: the robot's own controller holds it
    _check(motion, present, motion.start_position, start_tolerance, "before the ramp: bring it near the start first")
    ticks, rows, holding = round(ramp * motion.rate), len(motion.position), round(hold * motion.rate)
    worst, led = 0.0, present
    try:
        for tick in range(ticks):
            _on_time(late(tick * period), motion.rate)
            _check(motion, joints.read()[0], led, start_tolerance, f"in the ramp at {tick * period:.3f} s")
            led = present + _smooth((tick + 1) / ticks) * (start - present)
            share = _smooth(min(1.0, (tick + 1) * period / HOLDING))
            joints.write(led, zero, share * motion.start_torque, motion.kp, motion.kd)
        for tick in range(rows + holding):
            _on_time(late((ticks + tick) * period), motion.rate)
            row, holds = min(tick, rows - 1), tick >= rows
            now, rate = joints.read()
            added = zero if correcting is None else correcting(tick, now, rate)
            when = f"in the hold at {(tick - rows) * period:.3f} s" if holds else f"at {tick * period:.3f} s"
            off = _check(motion, now, motion.expected[row], tolerance + np.abs(added), when)
            worst = max(worst, 0.0 if holds else off)
            going = motion.velocity[row] if row < rows - 1 else zero  # the last row ends the motion: nothing follows
            joints.write(motion.sent(row, added, clamp), going, torque[row], motion.kp, motion.kd)
    except BaseException:
        _damp(joints, clock() if wait is None else lambda instant: 0.0)
        raise
    return worst


HOLDING = 0.02
"""[s], within which the torque that holds the start comes in: a robot that stands there already would sink without it."""


def _smooth(s: float) -> float:
    """From 0 to 1, beginning and ending at rest."""
    return s * s * (3.0 - 2.0 * s)


class _Joints:
    """The robot's joints, read and told. Arrays are copied both ways: the robot may go on using its own."""

    def __init__(self, motion: Motion, robot: Robot) -> None:
        self.motion, self._robot = motion, robot
        self.position = motion.start_position
        """Where they were when they were last read, (joints,) [rad]."""

    def read(self) -> tuple[Array, Array]:
        """Position and velocity, (joints,) each. Raises Stopped if they are not numbers."""
        position, velocity = (np.array(values, dtype=float) for values in self._robot.read())
        for what, values in (("position", position), ("velocity", velocity)):
            if values.shape != (len(self.motion.joints),) or not np.isfinite(values).all():
                raise Stopped(
                    f"the robot reads {values.tolist()} as {what}; should be {len(self.motion.joints)} numbers"
                )
        self.position = position.copy()
        return position, velocity

    def write(self, *command: Array) -> None:
        self._robot.write(*(values.copy() for values in command))


class _Correcting:
    """A stabiliser at work: measures at its ticks, and keeps the correction that is in force."""

    def __init__(self, motion: Motion, robot: Any) -> None:
        if not hasattr(robot, "read_trunk"):
            raise Stopped(
                "the motion has a stabiliser, and the robot no read_trunk; add it, or play with --no-feedback"
            )
        assert motion.feedback is not None
        self._feedback, self._robot = motion.feedback, robot
        self._rows = round(motion.rate / motion.feedback.rate)
        self._due = self._last = np.zeros(len(motion.joints))

    def __call__(self, row: int, position: Array, velocity: Array) -> Array:
        """(joints,) [rad], to be added to what is sent now."""
        if row % self._rows == 0:
            quaternion, rate = (np.asarray(values, dtype=float) for values in self._robot.read_trunk())
            if quaternion.shape != (4,) or rate.shape != (3,):
                raise Stopped(
                    f"the robot's trunk reads {quaternion.tolist()}, {rate.tolist()}; should be 4 and 3 numbers"
                )
            length = float(np.linalg.norm(quaternion))
            if not abs(length - 1.0) < 0.01:
                raise Stopped(f"the robot's trunk reads {quaternion.tolist()}; should be a unit quaternion")
            if not np.isfinite(rate).all():
                raise Stopped(f"the robot's trunk turns at {rate.tolist()}; should be 3 numbers")
            self._last = self._due
            seen = sensed(quaternion / length, rate, position, velocity)
            self._due = self._feedback.correction(row // self._rows, seen, self._last)
        return self._last


def _check(motion: Motion, position: Array, expected: Array, tolerance: float | Array, when: str) -> float:
    off = np.abs(position - expected)
    allowed = np.broadcast_to(tolerance, off.shape)
    joint = int(np.argmax(off - allowed))
    if not off[joint] <= allowed[joint]:
        raise Stopped(
            f"{motion.joints[joint]} is at {position[joint]:.3f} rad, should be at {expected[joint]:.3f} within"
            f" {allowed[joint]:g}"
            f" {when}"
        )
    return float(off.max())


def _on_time(late: float, rate: float) -> None:
    if late > max(5.0 / rate, 0.02):
        raise Stopped(f"the loop is {late * 1e3:.0f} ms late; {rate:g} Hz is too fast for it")


def _damp(joints: _Joints, wait: Callable[[float], float], seconds: float = 1.0) -> None:
    """Let the drives only damp, wherever the joints are; readings are not trusted any more.

    The position is where the joints were last: a drive that cannot do without its own kp stays there.
    """
    motion = joints.motion
    zero = np.zeros(len(motion.joints))
    for tick in range(max(1, round(seconds * motion.rate))):
        wait(tick / motion.rate)
        joints.write(joints.position, zero, zero, zero, motion.kd)


def clock() -> Callable[[float], float]:
    """Wait for each instant since the first call; returns how late it is."""
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
    """For a dry run: its joints go where the ramp says, then do what the simulation did. Not a simulation."""

    def __init__(self, motion: Motion, ramp: float) -> None:
        self._motion, self._ticks = motion, round(ramp * motion.rate)
        self._position, self.calls = motion.start_position + 0.05, 0

    def read(self) -> tuple[Array, Array]:
        return self._position, np.zeros_like(self._position)

    def write(self, position: Array, velocity: Array, torque: Array, kp: Array, kd: Array) -> None:
        row = self.calls - self._ticks + 1
        self._position = position if row <= 0 else self._motion.expected[min(row, len(self._motion.expected) - 1)]
        self.calls += 1


def main(arguments: list[str] | None = None) -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Play an exported motion on a robot.")
    parser.add_argument("motion", help="motion.csv (with meta.json beside it) or motion.json")
    parser.add_argument("--dry-run", action="store_true", help="without a robot, as fast as it goes")
    parser.add_argument("--robot", metavar="MODULE:CLASS", help="your class with read and write")
    parser.add_argument("--ramp", type=float, default=2.0, help="to the start [s]; 2")
    parser.add_argument("--start-tolerance", type=float, default=0.5, help="from the start, before the ramp [rad]; 0.5")
    parser.add_argument("--tolerance", type=float, default=0.5, help="from the simulation, in the motion [rad]; 0.5")
    parser.add_argument("--no-feedback", action="store_true", help="without the motion's stabiliser")
    parser.add_argument(
        "--no-clamp", action="store_true", help="send positions beyond the joints' ranges, too, as told"
    )
    parser.add_argument("--hold", type=float, default=0.0, help="send the last row for longer [s]; 0")
    options = parser.parse_args(arguments)
    if options.dry_run == (options.robot is not None):
        parser.error("give one of --dry-run and --robot MODULE:CLASS")
    if not all(0 <= v < np.inf for v in (options.ramp, options.hold, options.tolerance, options.start_tolerance)):
        parser.error("--ramp, --hold and tolerances should be numbers, 0 or more")
    try:
        motion = Motion.load(options.motion)
        robot: Any = StandIn(motion, options.ramp) if options.dry_run else _load_robot(options.robot)
        if motion.feedback is not None and not (options.dry_run or options.no_feedback):
            _Correcting(motion, robot)
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
            hold=options.hold,
            feedback=not (options.no_feedback or options.dry_run),
            clamp=not options.no_clamp,
            wait=(lambda instant: 0.0) if options.dry_run else None,
        )
    except (Stopped, KeyboardInterrupt) as stopped:
        print(f"player: stopped: {str(stopped) or 'interrupted'}", file=sys.stderr)
        return 1
    print(f"played to the end; largest tracking error {worst:.4f} rad")
    return 0


def _heed_signals() -> None:
    """Let kill and a lost terminal end the program as Ctrl-C does, with drives that damp; but not if they are to be ignored."""

    def interrupted(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, interrupted)


def _load_robot(name: str) -> Any:
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
    _heed_signals()
    sys.exit(main())
