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
            ...                                                 # kp (position - q) + kd (velocity - qd) + torque

What happens, at the rate of the file: the joints have to be near the start already; they are led from where they are to
the start within the ramp, and have to be there; then every row is sent at its time, positions clamped to the joints'
ranges and torques to their limits. If a joint is further from where the simulation had it than the tolerance, or a reading
is not a number, or the loop comes too late, the motion is stopped: the drives only damp, for a second. Then it is your
controller's turn again. The attitude and height of the trunk are not looked at: that is yours to do before.

Exit status: 0 played to the end, 1 stopped, 2 the input is wrong.
"""

from __future__ import annotations

import argparse
import csv
import importlib
import json
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


class Stopped(Exception):
    """The motion was not played to its end; why."""


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

    @classmethod
    def load(cls, path: str | Path) -> Motion:
        """Read motion.json, or motion.csv and the meta.json beside it. Raises OSError, ValueError or KeyError."""
        path = Path(path)
        if path.suffix == ".json":
            content = json.loads(path.read_text(encoding="utf-8"))
            meta, command = content["meta"], content["command"]
            arrays = {name: np.array(command[name], dtype=float) for name in ("position", "velocity", "torque")}
            arrays["expected"] = np.array(content["state"]["position"], dtype=float)
        else:
            meta = json.loads(path.with_name("meta.json").read_text(encoding="utf-8"))
            with path.open(encoding="utf-8", newline="") as file:
                lines = csv.reader(file)
                header = next(lines)
                table = np.array([line for line in lines if line], dtype=float)
            place = {name: i for i, name in enumerate(header)}
            pick = lambda what, name: table[:, [place[f"{what}/{joint}/{name}"] for joint in meta["joints"]]]  # noqa: E731
            arrays = {name: pick("command", name) for name in ("position", "velocity", "torque")}
            arrays["expected"] = pick("state", "position")
        if not all(np.isfinite(values).all() and len(values) == meta["rows"] for values in arrays.values()):
            raise ValueError(f"{path}: not {meta['rows']} rows of numbers, as its meta says; export the motion again")
        limits = meta["limits"]
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
            **arrays,
        )

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
    tolerance: float = 0.3,
    hold: float = 0.0,
    wait: Callable[[float], float] | None = None,
) -> float:
    """Play a motion. Returns the largest tracking error [rad]. Raises Stopped.

    ramp: [s], from the present joint positions to the start; 0 for none. start_tolerance: [rad], how far the joints may be
    from the start before the ramp. tolerance: [rad], how far from where the simulation had them, from the end of the ramp
    on. hold: [s], for which the last row is sent on after the end.
    wait: called before each tick with its time [s] since the first; returns how late it is [s]. By default the clock.
    """
    late = wait or clock()
    zero = np.zeros(len(motion.joints))
    position, torque = motion.clamped()
    start = np.clip(motion.start_position, motion.lower, motion.upper)
    try:
        present, _ = _read(motion, robot)
        _check(
            motion, present, motion.start_position, start_tolerance, "before the ramp: bring it near the start first"
        )
        ticks, tick, worst = round(ramp * motion.rate), 0, 0.0
        for tick in range(ticks):
            _on_time(late(tick / motion.rate), motion.rate)
            s = (tick + 1) / ticks
            share = s * s * (3.0 - 2.0 * s)
            robot.write(present + share * (start - present), zero, share * motion.start_torque, motion.kp, motion.kd)
        for row in range(len(position)):
            _on_time(late((ticks + row) / motion.rate), motion.rate)
            now, _ = _read(motion, robot)
            worst = max(worst, _check(motion, now, motion.expected[row], tolerance, f"at {row / motion.rate:.3f} s"))
            robot.write(position[row], motion.velocity[row], torque[row], motion.kp, motion.kd)
        for tick in range(round(hold * motion.rate)):
            _on_time(late((ticks + len(position) + tick) / motion.rate), motion.rate)
            robot.write(position[-1], zero, torque[-1], motion.kp, motion.kd)
    except BaseException:
        _damp(motion, robot, clock() if wait is None else lambda instant: 0.0)
        raise
    return worst


def _read(motion: Motion, robot: Robot) -> tuple[Array, Array]:
    position, velocity = (np.asarray(values, dtype=float) for values in robot.read())
    if position.shape != (len(motion.joints),) or not (np.isfinite(position).all() and np.isfinite(velocity).all()):
        raise Stopped(f"the robot reads {position.tolist()}; should be {len(motion.joints)} numbers")
    return position, velocity


def _check(motion: Motion, position: Array, expected: Array, tolerance: float, when: str) -> float:
    off = np.abs(position - expected)
    joint = int(np.argmax(off))
    if off[joint] > tolerance:
        raise Stopped(
            f"{motion.joints[joint]} is at {position[joint]:.3f} rad, should be at {expected[joint]:.3f} within {tolerance:g}"
            f" {when}"
        )
    return float(off[joint])


def _on_time(late: float, rate: float) -> None:
    if late > max(5.0 / rate, 0.02):
        raise Stopped(f"the loop is {late * 1e3:.0f} ms late; {rate:g} Hz is too fast for it")


def _damp(motion: Motion, robot: Robot, wait: Callable[[float], float], seconds: float = 1.0) -> None:
    """Let the drives only damp, wherever the joints are; readings are not trusted any more."""
    zero = np.zeros(len(motion.joints))
    for tick in range(max(1, round(seconds * motion.rate))):
        wait(tick / motion.rate)
        robot.write(zero, zero, zero, zero, motion.kd)


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
    parser.add_argument("--tolerance", type=float, default=0.3, help="from the simulation, in the motion [rad]; 0.3")
    parser.add_argument("--hold", type=float, default=0.0, help="send the last row for longer [s]; 0")
    options = parser.parse_args(arguments)
    if options.dry_run == (options.robot is not None):
        parser.error("give one of --dry-run and --robot MODULE:CLASS")
    if min(options.ramp, options.hold, options.tolerance, options.start_tolerance) < 0:
        parser.error("--ramp, --hold and tolerances should not be negative")
    try:
        motion = Motion.load(options.motion)
        robot: Any = StandIn(motion, options.ramp) if options.dry_run else _load_robot(options.robot)
    except (OSError, ValueError, LookupError, ImportError, AttributeError) as error:
        print(f"player: {type(error).__name__}: {error}", file=sys.stderr)
        return 2
    position, torque = motion.clamped()
    changed = int((position != motion.position).sum() + (torque != motion.torque).sum())
    rows = len(motion.position)
    print(f"{rows} rows at {motion.rate:g} Hz for {len(motion.joints)} joints: {', '.join(motion.joints)}")
    if changed:
        print(f"{changed} commands of {2 * position.size} are beyond the joints' limits, and are clamped")
    try:
        worst = play(
            motion,
            robot,
            ramp=options.ramp,
            start_tolerance=options.start_tolerance,
            tolerance=options.tolerance,
            hold=options.hold,
            wait=(lambda instant: 0.0) if options.dry_run else None,
        )
    except Stopped as stopped:
        print(f"player: stopped: {stopped}", file=sys.stderr)
        return 1
    print(f"played to the end; largest tracking error {worst:.4f} rad")
    return 0


def _load_robot(name: str) -> Any:
    module, _, kind = name.partition(":")
    if not kind:
        raise ValueError(f"--robot {name}: should be MODULE:CLASS, such as my_robot:MyRobot")
    sys.path.insert(0, str(Path.cwd()))
    return getattr(importlib.import_module(module), kind)()


if __name__ == "__main__":
    sys.exit(main())
