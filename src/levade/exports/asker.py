#!/usr/bin/env python3
"""Get a robot up from any fall: ask a motion library, play the answer, check, ask again. Needs Python 3.10 and numpy.

    python ask.py --state state.json                        # name a motion, and its probability
    python ask.py --robot my_robot:MyRobot --attempts 3     # your class with read_trunk: see player.py

state.json has the sensor readings of a robot that lies still, with its joints in the library's `fold`:

    {"attitude": [0.1, 0.99, 0.0, 0.05], "joints": {"lf_haa": 0.0, "lf_hfe": 1.5, "...": 0.0}}

``attitude`` is a quaternion w-x-y-z; its yaw does not matter. Instead, ``up`` gives the upward direction in trunk axes. An
attempt has these steps:

1. The joints move to the fold's posture within its time, and rest there. If a leg is jammed, they move to the posture `freeing`
   and back once.
2. The library is asked with the trunk's attitude and the joints.
3. Its likeliest motion is played, with the start checks, limits and stops of player.py. The player compares the robot with the
   simulation from the nearest lying pose.
4. The robot stands if its trunk is level and its joints are where the motion ends.

If the robot departs so far from the simulation that player.py stops, the drives damp for a second, and the next attempt begins.
If the robot does not stand, the next attempt begins at once. Any other stop, an error between two motions, and the last attempt
end the program. Then the drives damp for a second, or hold a robot that stands.

Exit status: 0 it stands, 1 it does not or was stopped, 2 the input is wrong.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from levade.exports import player

Array = np.ndarray

JOINTS = 0.25
"""Weight of a difference of 1 rad in all joints, relative to 1 rad in attitude.

A robot on its back has to roll over for any leg posture, and its joints soon move elsewhere.
"""

NEAREST, LEAST_REACH = 8, 0.05
"""The distance to this many nearest falls is the width of the weights, and its minimum [rad]."""

HEARD = 128
"""Number of nearest falls, including mirror images, that count. An answer then takes as long for thousands of falls."""

PRIOR = 0.5
"""Weight of the share over all falls, in falls. Nearby falls soon outweigh it."""

SIMILAR = 0.3
"""Distance between two lying poses up to which they count as one [rad]: see `apart`."""

LEVEL, THERE = 0.35, 0.4
"""Largest tilt of a standing robot, and largest distance of its joints from the end of the motion [rad]."""


def distances(ups: Array, joint_positions: Array, up: Array, joint_position: Array) -> Array:
    """Compute the distance of a state from others, of shapes (n, 3) and (n, joints) [rad], shape (n,).

    It combines the angle between upward directions with the joints' differences.
    """
    angle = np.arccos(np.clip(ups @ up, -1.0, 1.0))
    joints = np.sqrt(((joint_positions - joint_position) ** 2).mean(axis=1))
    return np.hypot(angle, JOINTS * joints)


@dataclass(frozen=True, eq=False)
class Model:
    """Predicts which motion works from where.

    Each nearby fall counts by its distance, and the share over all falls counts, too.

    Attributes:
        up: Upward direction in trunk axes in each fall, shape (n, 3).
        joint_position: Joint angles in each fall [rad], shape (n, joints).
        tried: How often each motion was tried from each fall, shape (n, m).
        worked: How often it worked, shape (n, m).
        motions: Numbers of the motions, shape (m,).
        image: Column of each motion's mirror image, shape (m,); of size 0 if the robot is not symmetric.
        mirror_joints: Joint whose angle each joint of the mirror image takes, shape (joints,).
        mirror_signs: Sign of that angle, shape (joints,).
    """

    up: Array
    joint_position: Array
    tried: Array
    worked: Array
    motions: Array
    image: Array
    mirror_joints: Array
    mirror_signs: Array

    def distances(self, up: Array, joint_position: Array) -> Array:
        """Compute the distance of a state from each fall [rad], shape (n,)."""
        return distances(self.up, self.joint_position, up, joint_position)

    def probabilities(self, up: Array, joint_position: Array) -> Array:
        """Predict how likely each motion works from a state, on the nominal model or a perturbed one, shape (m,)."""
        if not len(self.motions):
            return np.zeros(0)
        distance = self.distances(up, joint_position)
        if len(self.image):
            sideways = up * np.array([1.0, -1.0, 1.0])
            image = self.distances(sideways, joint_position[self.mirror_joints] * self.mirror_signs)
            distance = np.concatenate([distance, image])
        order = np.argsort(distance, kind="stable")[:HEARD]
        reach = max(LEAST_REACH, float(distance[order[min(NEAREST, len(order)) - 1]]))
        say = np.exp(-((distance[order] / reach) ** 2))
        n = len(self.up)
        own, other = order < n, order >= n
        for_it, all_of_it = say[own] @ self.worked[order[own]], say[own] @ self.tried[order[own]]
        if len(self.image):  # a motion works from a fall as its image does from the fall's image
            rows = order[other] - n
            for_it = for_it + (say[other] @ self.worked[rows])[self.image]
            all_of_it = all_of_it + (say[other] @ self.tried[rows])[self.image]
        return (for_it + PRIOR * self._share) / (all_of_it + PRIOR)

    @cached_property
    def _share(self) -> Array:
        """Share of all falls from which each motion works, or its mirror image from their mirror images, shape (m,)."""
        share = (self.worked.sum(axis=0) + 1.0) / (self.tried.sum(axis=0) + 2.0)
        return (share + share[self.image]) / 2 if len(self.image) else share

    def ranked(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Return motions and their probabilities from a state, the likeliest first."""
        return ranked(self.motions, self.probabilities(up, joint_position))


def features(up: Array, joint_position: Array) -> Array:
    """Compute the inputs of learned models, shape (..., 3 + joints). Their distance is about that of `Model.distances`."""
    return np.concatenate([up, joint_position * (JOINTS / math.sqrt(joint_position.shape[-1]))], axis=-1)


@dataclass(frozen=True, eq=False)
class Learned:
    """A model that was learned from which motion works from which fall: `levade.library.learning`.

    Attributes:
        kind: "gaussian-process", "trees" or "networks".
        motions: Numbers of the motions, shape (m,).
        arrays: Arrays of the model.
        slope: Slope of the line that calibrates the log odds.
        offset: Offset of that line.
    """

    kind: str
    motions: Array
    arrays: dict[str, Array]
    slope: float = 1.0
    offset: float = 0.0

    def probabilities(self, up: Array, joint_position: Array) -> Array:
        """Predict how likely each motion works from a state, shape (m,)."""
        return calibrated(_RAW[self.kind](self.arrays, features(up, joint_position)), self.slope, self.offset)

    def ranked(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Return motions and their probabilities from a state, the likeliest first."""
        return ranked(self.motions, self.probabilities(up, joint_position))


def calibrated(raw: Array, slope: float, offset: float) -> Array:
    """Calibrate probabilities of any shape by a line through their log odds."""
    raw = np.clip(raw, 0.005, 0.995)
    return 1.0 / (1.0 + np.exp(-(slope * np.log(raw / (1.0 - raw)) + offset)))


def ranked(motions: Array, probability: Array) -> list[tuple[int, float]]:
    """Return motions, shape (m,), and their probabilities, the likeliest first."""
    order = np.argsort(-probability, kind="stable")
    return [(int(motions[j]), float(probability[j])) for j in order]


def _gaussian_process(of: dict[str, Array], x: Array) -> Array:
    """Compute the posterior mean. states: (k, f). weights: (k, m). mean: (m,). length, amplitude: (1,)."""
    squared = ((of["states"] - x) ** 2).sum(axis=1)
    return of["mean"] + of["amplitude"] * np.exp(-0.5 * squared / of["length"] ** 2) @ of["weights"]


def _trees(of: dict[str, Array], x: Array) -> Array:
    """Sum boosted trees, each of one motion. feature, threshold, left, right, value: (trees, nodes). motion: (trees,).

    first, shape (m,), is the value from which they start. A leaf is its own child.
    """
    tree, node = np.arange(len(of["motion"])), np.zeros(len(of["motion"]), dtype=int)
    for _ in range(int(of["depth"][0])):
        goes = x[of["feature"][tree, node]] <= of["threshold"][tree, node]
        node = np.where(goes, of["left"][tree, node], of["right"][tree, node])
    return of["first"] + np.bincount(of["motion"], of["value"][tree, node], minlength=len(of["first"]))


def _networks(of: dict[str, Array], x: Array) -> Array:
    """Average networks with one hidden layer. into: (e, f, h). bias: (e, h). out: (e, h, m). last: (e, m)."""
    hidden = np.tanh(np.einsum("f,efh->eh", x, of["into"]) + of["bias"])
    return (np.einsum("eh,ehm->em", hidden, of["out"]) + of["last"]).mean(axis=0)


_RAW = {"gaussian-process": _gaussian_process, "trees": _trees, "networks": _networks}


@dataclass(frozen=True, eq=False)
class Library:
    """An exported library.

    Attributes:
        joints: Names of the joints.
        model: The model that ranks motions.
        fold: The folded posture, as a motion that rests there.
        fold_time: Time to move there [s].
        freeing: The posture that it takes if a leg is jammed, as a motion that rests there, before it folds up once more. None
            if it folds up only once.
        jammed: Distance of a joint from the folded posture beyond which a leg counts as jammed [rad].
        motions: Number -> the motion, once for each lying pose from which it was simulated.

    Raises:
        ValueError: If it is not a library.
    """

    joints: list[str]
    model: Model | Learned
    fold: player.Motion
    fold_time: float
    motions: dict[int, list[player.Motion]]
    freeing: player.Motion | None = None
    jammed: float = math.inf

    @classmethod
    def load(cls, folder: str | Path) -> Library:
        """Read library.json, model.npz and the motions next to them.

        Args:
            folder: Directory of the export.

        Returns:
            The library.

        Raises:
            OSError: If a file cannot be read.
            ValueError: If a file does not belong to an export, or was changed since.
        """
        folder = Path(folder)
        try:
            about = json.loads((folder / "library.json").read_text(encoding="utf-8"))
            content = (folder / "model.npz").read_bytes()
            if about["checksum"] != checksum(about, content):
                raise ValueError("library.json, or model.npz, was changed since it was exported (checksum)")
            model = unpacked(content)
            motions = {
                int(number): [player.Motion.load(folder / place / "motion.csv") for place in places]
                for number, places in about["motions"].items()
            }
            posture, joints = np.array(about["fold"]["position"], dtype=float), list(about["joints"])
            if set(motions) != {int(number) for number in model.motions} or not motions:
                raise ValueError("its motions are not those of its model")
            if any(not own or any(one.joints != joints for one in own) for own in motions.values()):
                raise ValueError("its motions have other joints")
            first = next(iter(motions.values()))[0]
            fold, time = resting(first, posture, float(about["fold"]["rest"])), float(about["fold"]["time"])
            if about["fold"].get("freeing") is None:
                return cls(joints, model, fold, time, motions)
            freeing = np.array(about["fold"]["freeing"]["position"], dtype=float)
            jammed = float(about["fold"]["freeing"]["jammed"])
            return cls(joints, model, fold, time, motions, resting(first, freeing, 0.0), jammed)
        except (OSError, ValueError):
            raise
        except Exception as error:
            raise ValueError(
                f"{folder}: is damaged ({type(error).__name__}: {error}); export the library again"
            ) from None

    def ask(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Rank motions for a state.

        Args:
            up: Upward direction in trunk axes, of any length, shape (3,).
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Motions and their probabilities, the likeliest first.

        Raises:
            ValueError: If a shape is wrong, or a value is not finite.
        """
        up, joints = np.asarray(up, dtype=float), np.asarray(joint_position, dtype=float)
        if up.shape != (3,) or not np.isfinite(up).all() or not np.linalg.norm(up) > 0:
            raise ValueError("up: should be three numbers, the upward direction in trunk axes")
        if joints.shape != (len(self.joints),) or not np.isfinite(joints).all():
            raise ValueError(f"joints: should be the angles of {len(self.joints)} joints [rad]")
        return self.model.ranked(up / np.linalg.norm(up), joints)


def nearest(motions: list[player.Motion], up: Array, joint_position: Array) -> player.Motion:
    """Return the motion that was simulated from the nearest state.

    Args:
        motions: The same motion, simulated from several states.
        up: Upward direction in trunk axes, shape (3,).
        joint_position: Joint angles [rad], shape (joints,).

    Returns:
        One of the motions.
    """
    return min(motions, key=lambda one: apart(one.up[0], one.start_position, up, joint_position))


def apart(up: Array, joint_position: Array, other_up: Array, other_position: Array) -> float:
    """Compute the distance of two lying poses [rad]: the angle between upward directions, or the largest joint difference."""
    angle = math.acos(min(1.0, max(-1.0, float(up @ other_up))))
    return max(angle, float(np.abs(joint_position - other_position).max()))


def without_repeats(
    answers: list[tuple[int, float]], failed: list[tuple[int, Array, Array]], up: Array, joint_position: Array
) -> list[tuple[int, float]]:
    """Rank motions that just failed from a similar state behind all others: they would fail again.

    Args:
        answers: Motions and their probabilities, the likeliest first.
        failed: Motions that failed, each with the upward direction in trunk axes and the joint angles where it began.
        up: Upward direction in trunk axes, shape (3,).
        joint_position: Joint angles [rad], shape (joints,).

    Returns:
        The same motions and probabilities.
    """
    similar = {number for number, *where in failed if apart(where[0], where[1], up, joint_position) < SIMILAR}
    return sorted(answers, key=lambda answer: answer[0] in similar)


def unpacked(content: bytes) -> Model | Learned:
    """Return the model of a model.npz: that of the nearest falls, or a learned one."""
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        if "kind" not in file:
            return Model(**{one.name: file[one.name] for one in fields(Model)})
        of = {name: file[name] for name in file}
    kind, motions, slope, offset = (of.pop(name) for name in ("kind", "motions", "slope", "offset"))
    if str(kind) not in _RAW:
        raise ValueError(f"unknown kind of model {kind}; valid kinds: {', '.join(_RAW)}")
    return Learned(str(kind), motions, of, float(slope), float(offset))


def checksum(about: dict[str, Any], model: bytes) -> str:
    """Compute the checksum of library.json, except its own "checksum", and of model.npz."""
    rest = {key: value for key, value in about.items() if key != "checksum"}
    return f"sha256:{hashlib.sha256(player.canonical(rest) + model).hexdigest()}"


def resting(like: player.Motion, posture: Array, rest: float) -> player.Motion:
    """Make a motion that stays in a posture, with the drives of another one.

    Args:
        like: Motion whose drives it has.
        posture: Joint angles [rad], shape (joints,).
        rest: Duration [s].

    Returns:
        The motion.
    """
    rows, joints = max(1, round(rest * like.rate)), len(like.joints)
    still, table = np.zeros((rows, joints)), np.tile(posture, (rows, 1))
    return player.Motion(
        joints=like.joints,
        rate=like.rate,
        position=table,
        velocity=still,
        torque=still,
        expected=table,
        expected_velocity=still,
        up=np.tile([0.0, 0.0, 1.0], (rows, 1)),
        turning=np.zeros(rows),
        kp=like.kp,
        kd=like.kd,
        start_position=posture,
        start_torque=np.zeros(joints),
        lower=like.lower,
        upper=like.upper,
        torque_limit=like.torque_limit,
        held=like.held,
    )


@dataclass(frozen=True)
class Attempt:
    """Reports an attempt.

    Attributes:
        motion: Number of the motion. None if the robot did not fold up.
        stopped: Why it was stopped, if it was.
    """

    motion: int | None
    probability: float
    stands: bool
    stopped: str = ""

    def __str__(self) -> str:
        what = "folding up" if self.motion is None else f"motion {self.motion}, {self.probability:.1%}"
        return f"{what}: {'it stands' if self.stands else self.stopped or 'it does not stand'}"


def get_up(
    library: Library,
    robot: Any,
    *,
    attempts: int = 3,
    fold_tolerance: float = 2.0 * math.pi,
    tolerance: float = 1.0,
    speed_tolerance: float = 20.0,
    tilt_tolerance: float = 2.0,
    clamp: bool = True,
    wait: Callable[[], Callable[[float], float]] = player.clock,
    observe: Callable[[Attempt], object] = lambda attempt: None,
) -> list[Attempt]:
    """Sense, ask, play and check, until the robot stands.

    Args:
        library: The library.
        robot: The robot, with ``read``, ``write`` and ``read_trunk``: see player.py.
        attempts: Largest number of attempts.
        fold_tolerance: How far joints may be from the fold's posture once they rest there [rad]. By default they may be
            anywhere, because legs may lie under the robot. The motion then has to begin near where they are.
        tolerance: How far the joints may be from the simulation in a motion [rad].
        speed_tolerance: How much faster joints and trunk may move than they ever do in the simulation [rad/s].
        tilt_tolerance: Largest angle between the trunk's attitude and that in the simulation [rad].
        clamp: As in ``player.play``.
        wait: Makes a clock for each motion, as in ``player.play``.
        observe: Called after each attempt.

    Returns:
        The attempts. There are none if the robot stands already; otherwise it stands if the last one says so.

    Raises:
        Stopped: If the robot's joints have other names, it has no ``read_trunk``, or a reading or the loop is not valid.
            Exceptions of the robot's methods are passed on.
    """
    player.check_robot(library.fold, robot)
    if not callable(getattr(robot, "read_trunk", None)):
        raise player.Stopped("the robot has no read_trunk, but a library needs the trunk's attitude")
    done: list[Attempt] = []
    failed: list[tuple[int, Array, Array]] = []
    if any(stands(motion, robot) for own in library.motions.values() for motion in own):
        return done
    limits = {"speed_tolerance": speed_tolerance, "clamp": clamp}
    held: player.Motion | None = None  # whose last command the drives have, if they were left with one

    def rest(posture: player.Motion) -> None:
        player.play(
            posture,
            robot,
            ramp=library.fold_time,
            start_tolerance=2.0 * math.pi,
            tolerance=fold_tolerance,
            feedback=False,
            wait=wait(),
            damping=wait(),
            **limits,
        )

    try:
        while len(done) < attempts and not (done and done[-1].stands):
            motion, probability, stopped, standing = None, 0.0, "", False
            try:
                rest(library.fold)
                held = library.fold
                up, joints = sense(robot, len(library.joints))
                if library.freeing is not None and np.abs(joints - held.start_position).max() > library.jammed:
                    rest(library.freeing)
                    held = library.freeing
                    rest(library.fold)
                    held = library.fold
                    up, joints = sense(robot, len(library.joints))
                motion, probability = without_repeats(library.ask(up, joints), failed, up, joints)[0]
                failed.append((motion, up, joints))  # unless it stands afterwards, when this is the last attempt
                played = nearest(library.motions[motion], up, joints)
                player.play(
                    played,
                    robot,
                    ramp=0.1,
                    start_tolerance=tolerance,
                    tolerance=tolerance,
                    tilt_tolerance=tilt_tolerance,
                    wait=wait(),
                    damping=wait(),
                    **limits,
                )
                held = played
                standing = stands(played, robot)
            except player.Astray as astray:
                stopped = str(astray)
                if held is not None:  # a motion that did not begin has not damped
                    player.let_go(held, robot, wait=wait())
                    held = None
            done.append(Attempt(motion, probability, standing, stopped))
            observe(done[-1])
    except BaseException as error:
        if held is not None and (lines := player.let_go(held, robot, wait=wait())):
            error.__notes__ = [*getattr(error, "__notes__", []), *lines]
        raise
    if held is not None and not done[-1].stands:
        player.let_go(held, robot, wait=wait())
    return done


def sense(robot: Any, joints: int) -> tuple[Array, Array]:
    """Return the upward direction in trunk axes, shape (3,), and the joint angles [rad].

    Raises Stopped if a reading is not valid.
    """
    position, _ = player.pair("position and velocity", robot.read(), (joints, joints))
    quaternion, _ = player.trunk(robot)
    return np.array(player.up_of(*quaternion)), position


def stands(motion: player.Motion, robot: Any) -> bool:
    """Tell whether the trunk is level, and the joints are where a motion ends."""
    up, joints = sense(robot, len(motion.joints))
    return bool(up[2] > math.cos(LEVEL) and np.abs(joints - motion.expected[-1]).max() < THERE)


def read_state(path: Path, joints: list[str]) -> tuple[Array, Array]:
    """Read the upward direction and the joint angles from a JSON file. Raises ValueError if they are missing."""
    content = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(content, dict) or "joints" not in content or not {"up", "attitude"} & set(content):
        raise ValueError(f"{path}: should have joints, and attitude (w-x-y-z) or up")
    angles = content["joints"]
    if isinstance(angles, dict):
        if missing := [name for name in joints if name not in angles]:
            raise ValueError(f"{path}: joints: {', '.join(missing)} missing")
        angles = [angles[name] for name in joints]
    if "up" in content:
        return np.array(content["up"], dtype=float), np.array(angles, dtype=float)
    attitude = np.array(content["attitude"], dtype=float)
    if attitude.shape != (4,) or not 0.0 < np.linalg.norm(attitude) < math.inf:
        raise ValueError(f"{path}: attitude: {content['attitude']} should be a quaternion w-x-y-z")
    return np.array(player.up_of(*(attitude / np.linalg.norm(attitude)))), np.array(angles, dtype=float)


def _say_what_is_sent(library: Library, *, clamp: bool) -> None:
    """Say which joints to hold, and how many commands are clamped."""
    motions = [motion for own in library.motions.values() for motion in own]
    if library.fold.held:
        held = ", ".join(f"{joint} {angle:g}" for joint, angle in library.fold.held.items())
        print(f"not among its joints, hold them yourself where the simulation had them [rad, slides m]: {held}")
    beyond = sum(int((motion.clamped()[0] != motion.position).sum()) for motion in motions)
    if clamp and beyond:
        sent = sum(motion.position.size for motion in motions)
        print(
            f"{beyond} of {sent} positions are beyond the joints' ranges, and are clamped, which changes the simulated motions;"
        )
        print("add --no-clamp for drives like the simulated ones")


def main(arguments: list[str] | None = None) -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description="Get a robot up from any fall, with an exported motion library.")
    parser.add_argument(
        "--library",
        metavar="DIR",
        default=str(Path(__file__).resolve().parent),
        help="directory of the library; by default this one",
    )
    parser.add_argument(
        "--state", metavar="FILE", help="only name a motion for this state: JSON with attitude or up, and joints"
    )
    parser.add_argument("--robot", metavar="MODULE:CLASS", help="your class with read, write and read_trunk")
    parser.add_argument("--attempts", type=int, default=3, help="largest number of attempts; by default 3")
    player.add_tolerances(parser, joints=1.0, tilt=2.0)
    options = parser.parse_args(arguments)
    tolerances = (options.tolerance, options.tilt_tolerance, options.speed_tolerance)
    if (options.state is None) == (options.robot is None):
        parser.error("give one of --state FILE and --robot MODULE:CLASS")
    if options.attempts < 1 or not all(0 <= value < np.inf for value in tolerances):
        parser.error("--attempts should be 1 or more, and tolerances numbers, 0 or more")
    try:
        library = Library.load(options.library)
        if options.state is not None:
            ranked = library.ask(*read_state(Path(options.state), library.joints))
            print(json.dumps([{"motion": number, "probability": share} for number, share in ranked]))
            return 0
        robot = player.load_robot(options.robot)
        player.check_robot(library.fold, robot)
    except (OSError, ValueError, TypeError, player.Stopped) as error:
        print(f"ask: {error}", file=sys.stderr)
        return 2
    _say_what_is_sent(library, clamp=not options.no_clamp)
    try:
        done = get_up(
            library,
            robot,
            attempts=options.attempts,
            tolerance=options.tolerance,
            speed_tolerance=options.speed_tolerance,
            tilt_tolerance=options.tilt_tolerance,
            clamp=not options.no_clamp,
            observe=print,
        )
    except (Exception, KeyboardInterrupt) as stopped:
        print(f"ask: stopped: {player.why(stopped)}", file=sys.stderr)
        return 1
    if not done:
        print("it stands already")
    return 0 if not done or done[-1].stands else 1


if __name__ == "__main__":
    player.heed_signals()
    sys.exit(main())
