"""What the player is given, altered: files that are not as they were exported, and robots that read or write badly.

The alterations are generated, bounded and the same in every run. Whatever they are, a motion is refused in one line, or every
command is made of numbers within the limits, and after a fault drives only damp.
"""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.exports import export
from levade.exports.player import Motion as Played
from levade.exports.player import Stopped, canonical, checksum, main, play
from levade.feedback import Feedback
from levade.feedback import sensed as sensed_on
from levade.motions import Motion
from levade.rotations import rotate

VALUES: tuple[Any, ...] = (
    *(math.nan, math.inf, -math.inf, None, True, "1", "", [], {}, [1.0], 0, -1, 1e9, -1e9, 1e308, 10**400),
    *([math.nan] * 12, [None] * 12, [1e308] * 12, ["1"] * 12, [[1.0]] * 12, "\x1b[2J"),
)
"""What is put in the place of a value of meta.json."""

RATE = 100.0
"""[Hz], of the rows: few, so that many motions can be played."""
RAMP, SECOND = 10, 100
"""Ticks of a ramp of 0.1 s, and of a second."""


def places(meta: Any, at: tuple = ()) -> Iterator[tuple]:
    """Keys down to every value of a meta; of lists the list, its first item and its last."""
    if at:
        yield at
    if isinstance(meta, dict):
        for key, value in meta.items():
            yield from places(value, (*at, key))
    elif isinstance(meta, list) and meta:
        yield from ((*at, i) for i in (0, len(meta) - 1))


def altered(meta: Any, at: tuple, value: Any) -> Any:
    """A meta with another value at a place; what is elsewhere is shared."""
    first, *rest = at
    other = copy.copy(meta)
    other[first] = altered(meta[first], tuple(rest), value) if rest else value
    return other


def alterations(meta: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """What was altered, and the meta with it: every value replaced, negated, taken out, cut short, or there twice."""
    for at in places(meta):
        if at[0] in ("provenance", "units"):
            continue
        inner: Any = meta
        for key in at:
            inner = inner[key]
        values = list(VALUES)
        if isinstance(inner, list):
            values += [inner[:3], inner + inner[:1], inner[::-1], [inner[0]] * len(inner)]
        elif isinstance(inner, float | int):
            values += [-inner, inner * 1000, inner + 7]
        for value in values:
            same = type(value) is type(inner) and (value == inner or value != value)
            if not same:
                yield f"{'/'.join(map(str, at))} = {str(value)[:20]}", altered(meta, at, value)
        if isinstance(at[-1], str):
            without = altered(meta, at, None)
            outer: Any = without
            for key in at[:-1]:
                outer = outer[key]
            del outer[at[-1]]
            yield f"{'/'.join(at)} left out", without


@dataclass
class Robot:
    """Does what the simulation did; `read`, `read_trunk` and `write` can go wrong at a tick, counted from the first command."""

    motion: Any
    wrong: dict[str, Callable[[Any], Any]] = field(default_factory=dict)
    at: int = -1
    sent: list[tuple[np.ndarray, ...]] = field(default_factory=list)
    attempts: int = 0

    def row(self) -> int:
        return min(max(self.attempts - RAMP, 0), len(self.motion.expected) - 1)

    def _maybe(self, name: str, value: Any) -> Any:
        return self.wrong[name](value) if name in self.wrong and self.attempts == self.at else value

    def read(self) -> Any:
        position = self.motion.expected[self.row()].copy()
        return self._maybe("read", (position, np.zeros(len(position))))

    def read_trunk(self) -> Any:
        up = self.motion.up[self.row()]
        quaternion = np.array([1.0 + up[2], up[1], -up[0], 0.0])  # about the cross product of up and z
        return self._maybe("read_trunk", (quaternion / np.linalg.norm(quaternion), np.zeros(3)))

    def write(self, *command: np.ndarray) -> None:
        self.attempts += 1
        if "write" in self.wrong and self.attempts > self.at >= 0:
            self.wrong["write"](command)
        self.sent.append(command)


def faultless(motion: Any, sent: list[tuple[np.ndarray, ...]]) -> bool:
    """Whether every command is made of numbers, one for each joint, within the limits."""
    joints = len(motion.joints)
    return all(
        all(np.shape(part) == (joints,) and np.isfinite(part).all() for part in command)
        and (command[0] >= motion.lower).all()
        and (command[0] <= motion.upper).all()
        and (np.abs(command[2]) <= motion.torque_limit).all()
        and (command[3] >= 0).all()
        and (command[4] >= 0).all()
        for command in sent
    )


@pytest.fixture(scope="module")
def stabilised(rearing: Motion) -> Motion:
    """The motion with a stabiliser of small gains."""
    quaternion = np.concatenate([rearing["qpos0"][None, 3:7], rearing["trunk_quaternion"]])[::5]
    rate = rotate(quaternion * [1, -1, -1, -1], np.zeros((len(quaternion), 3)))
    angle = np.concatenate([rearing["qpos0"][None, 7:], rearing["joint_position"]])[::5]
    reference = sensed_on(quaternion, rate, angle, np.zeros_like(angle))
    gain = 1e-3 * np.random.default_rng(0).normal(size=(len(reference), 12, 42))
    return rearing.stabilised(Feedback(gain, reference, 0.01, 0.1))


@pytest.fixture(scope="module")
def place(stabilised: Motion, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("inputs")
    for to in ("csv", "json"):
        export(stabilised, to, directory, rate=RATE)
    return directory


@pytest.fixture(scope="module")
def motion(place: Path) -> Played:
    return Played.load(place / "motion.csv")


def written(place: Path, meta: dict[str, Any], *, sealed: bool) -> Path:
    """meta.json with another meta; sealed: with the checksum that goes with it, as a tool of somebody's might."""
    if sealed:
        belongs = [(place / name).read_bytes() for name in ("motion.csv", "feedback.npz")]
        with suppress(RecursionError):
            meta = meta | {"checksum": checksum(meta, *belongs)}
    (place / "meta.json").write_text(json.dumps(meta))
    return place / "motion.csv"


@pytest.fixture
def copied(place: Path, tmp_path: Path) -> Path:
    for name in ("motion.csv", "meta.json", "feedback.npz", "motion.json"):
        (tmp_path / name).write_bytes((place / name).read_bytes())
    return tmp_path


def loaded(path: Path) -> Played | str:
    """The motion, or why it is refused."""
    try:
        return Played.load(path)
    except ValueError as error:
        return str(error)


@pytest.mark.slow
@pytest.mark.parametrize(("sealed", "every"), [(False, 15), (True, 8)])
def test_an_altered_meta_is_refused_or_harmless(copied: Path, sealed: bool, every: int) -> None:
    """Without its checksum always refused; with one made for it, only what robots can be sent is played."""
    meta = json.loads((copied / "meta.json").read_text())
    played = []
    tried = list(alterations(meta))[::every]
    assert len(tried) * every > 900
    for what, other in tried:
        motion = loaded(written(copied, other, sealed=sealed))
        if isinstance(motion, str):
            assert motion.isprintable(), what  # and so on one line
            continue
        played.append(what)
        robot = Robot(motion)
        with suppress(Stopped):
            play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
        assert faultless(motion, robot.sent), what
    assert sealed or played == []
    strict = (
        "rate",
        "rows",
        "joints",
        "start/position",
        "kp",
        "kd",
        "feedback/rate",
        "feedback/sensed",
        "checksum = 0",
    )
    assert not [what for what in played if what.startswith(strict)]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["motion.csv", "feedback.npz", "motion.json", "meta.json"])
def test_files_with_bytes_changed_cut_or_swapped_are_refused(copied: Path, name: str) -> None:
    path = copied / ("motion.json" if name == "motion.json" else "motion.csv")
    whole = (copied / name).read_bytes()
    draw = np.random.default_rng(1)
    digits = [i for i in range(len(whole)) if whole[i : i + 1].isdigit()]
    for k in range(40):
        changed = bytearray(whole)
        where = int(draw.choice(digits)) if name != "feedback.npz" else int(draw.integers(len(whole)))
        if k % 4 == 0:
            changed = changed[:where]
        elif k % 4 == 1:
            changed[where] = ord("1") if changed[where] != ord("1") else ord("2")
        elif k % 4 == 2:
            changed[where : where + 1] = b"nan"
        else:
            del changed[where]
        (copied / name).write_bytes(changed)
        with pytest.raises(ValueError, match="motion") as error:
            Played.load(path)
        assert "\n" not in str(error.value)
    (copied / name).write_bytes(whole)
    Played.load(path)


def test_ends_of_lines_and_the_layout_of_json_do_not_count(copied: Path) -> None:
    table, meta = copied / "motion.csv", copied / "meta.json"
    table.write_bytes(table.read_bytes().replace(b"\n", b"\r\n"))
    meta.write_text(json.dumps(json.loads(meta.read_text()), sort_keys=True))
    Played.load(table)
    document = json.loads((copied / "motion.json").read_text())
    (copied / "motion.json").write_text(json.dumps(document, indent=1))
    Played.load(copied / "motion.json")
    assert document["meta"]["checksum"] == checksum(
        document["meta"], canonical({key: value for key, value in document.items() if key != "meta"})
    )


def test_one_row_changed_by_a_digit_is_said(copied: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = copied / "motion.csv"
    lines = table.read_text().splitlines()
    values = lines[20].split(",")
    values[1] = str(float(values[1]) + 0.001)
    lines[20] = ",".join(values)
    table.write_text("\n".join(lines) + "\n")
    assert main([str(table), "--dry-run"]) == 2
    said = capsys.readouterr().err
    assert said == (
        f"player: {table}: was changed since it was exported, or a file next to it was (checksum); export the motion again\n"
    )


def shifted(by: float, part: int = 0) -> Callable[[Any], Any]:
    """A reading one of whose numbers is off."""

    def change(value: Any) -> Any:
        value = tuple(np.array(values) for values in value)
        value[part][2] += by
        return value

    return change


def raising(value: Any) -> Any:
    raise OSError("bus off")


def constant(value: Any) -> Callable[[Any], Any]:
    return lambda _: value


READINGS: dict[str, Callable[[Any], Any]] = {
    **{
        f"position {by:g}": shifted(by) for by in (math.nan, math.inf, -math.inf, 1e300, 2 * math.pi, -2 * math.pi, 0.6)
    },
    **{f"velocity {by:g}": shifted(by, 1) for by in (math.nan, math.inf, 1e300, 1e6, -500.0, 60.0)},
    "raises": raising,
    **{
        f"gives {value!r:.20}": constant(value)
        for value in (
            None,
            (),
            1.0,
            "ab",
            ([0.0] * 11, [0.0] * 12),
            ([[0.0] * 12], [0.0] * 12),
            (None, None),
            ([],) * 3,
        )
    },
}
TRUNKS: dict[str, Callable[[Any], Any]] = {
    "upside down": lambda value: (np.array([-value[0][1], value[0][0], -value[0][3], value[0][2]]), value[1]),
    "no attitude": constant((np.zeros(4), np.zeros(3))),
    "not a unit": lambda value: (1.1 * value[0], value[1]),
    **{f"attitude {by:g}": shifted(by, 0) for by in (math.nan, math.inf, 1e200)},
    **{f"rate {by:g}": shifted(by, 1) for by in (math.nan, math.inf, 1e300, 1e3, -60.0)},
    "raises": raising,
    **{f"gives {value!r:.20}": constant(value) for value in (None, (), 1.0, ([1, 0, 0, 0], [0, 0]), "ab")},
}


@pytest.mark.slow
@pytest.mark.parametrize("clamp", [True, False])
@pytest.mark.parametrize(
    ("method", "fault"), [*(("read", name) for name in READINGS), *(("read_trunk", name) for name in TRUNKS)]
)
def test_a_bad_reading_is_never_sent(motion: Played, method: str, fault: str, clamp: bool) -> None:
    change = {"read": READINGS, "read_trunk": TRUNKS}[method][fault]
    for at in (0, 7, RAMP, RAMP + 15, RAMP + 34):
        robot = Robot(motion, {method: change}, at)
        with pytest.raises((Stopped, OSError)):
            play(motion, robot, ramp=0.1, hold=0.1, clamp=clamp, wait=lambda instant: 0.0)
        assert faultless(motion, robot.sent)
        moving = [command for command in robot.sent if command[3].any()]
        assert len(moving) == at
        damping = robot.sent[at:]
        assert len(damping) == (SECOND if at else 0)  # before the first command nothing is sent at all
        # the last reading before the fault, or that of the tick itself if its joints passed
        row = min(max(at - (method == "read") - RAMP, 0), len(motion.expected) - 1)
        for position, velocity, torque, kp, kd in damping:
            assert not np.any([velocity, torque, kp])
            np.testing.assert_array_equal(kd, motion.kd)
            np.testing.assert_array_equal(position, np.clip(motion.expected[row], motion.lower, motion.upper))


@pytest.mark.parametrize("lasting", [1, 3, 200])
def test_drives_go_on_being_damped_while_writes_fail(motion: Played, lasting: int) -> None:
    left = iter([True] * lasting)

    def failing(command: Any) -> None:
        if next(left, False):
            raise OSError("bus off")

    robot = Robot(motion, {"write": failing}, RAMP + 12)
    with pytest.raises(OSError, match="bus off") as error:
        play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
    assert robot.attempts == RAMP + 12 + 1 + SECOND
    assert len(robot.sent) == RAMP + 12 + max(0, SECOND + 1 - lasting)
    assert faultless(motion, robot.sent)
    notes = getattr(error.value, "__notes__", [])
    lost = min(lasting - 1, SECOND)
    assert notes == ([f"while damping, {lost} of 100 commands did not get through (OSError: bus off)"] if lost else [])


def test_a_second_interrupt_does_not_end_the_damping(motion: Played) -> None:
    def interrupting(command: Any) -> None:
        if robot.attempts in (RAMP + 13, RAMP + 30):
            raise KeyboardInterrupt

    robot = Robot(motion, {"write": interrupting}, RAMP + 12)
    with pytest.raises(KeyboardInterrupt):
        play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
    assert robot.attempts == RAMP + 12 + 1 + SECOND


@pytest.mark.parametrize("late", [math.nan, math.inf, 0.06])
def test_a_clock_that_is_late_or_no_number_stops(motion: Played, late: float) -> None:
    robot = Robot(motion)
    with pytest.raises(Stopped, match="ms late; 100 Hz is too fast for it"):
        play(motion, robot, ramp=0.1, wait=lambda instant: late if instant > 0.2 else 0.0)
    assert [bool(command[3].any()) for command in robot.sent] == [True] * 21 + [False] * SECOND


@pytest.mark.parametrize("method", ["read", "read_trunk"])
def test_no_row_follows_a_reading_that_hung(motion: Played, method: str) -> None:
    now = 0.0

    def hangs(value: Any) -> Any:
        nonlocal now
        now += 0.5
        return value

    def wait(instant: float) -> float:
        nonlocal now
        now = max(now, instant)
        return now - instant

    robot = Robot(motion, {method: hangs}, RAMP + 15)
    with pytest.raises(Stopped, match="the loop is 500 ms late"):
        play(motion, robot, ramp=0.1, wait=wait)
    assert sum(bool(command[3].any()) for command in robot.sent) == RAMP + 15


def test_slow_rows_do_not_make_a_late_loop_right(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "csv", tmp_path, rate=10.0)
    slow = Played.load(tmp_path / "motion.csv")
    with pytest.raises(Stopped, match="the loop is 200 ms late"):
        play(slow, Robot(slow), ramp=0.0, tolerance=9.0, wait=lambda instant: 0.2)


def test_a_joint_beyond_its_range_does_not_begin(motion: Played) -> None:
    """Its first command, clamped, would be a jump."""
    joint = motion.joints.index("lf_kfe")
    robot = Robot(motion, {"read": shifted(0.0)}, 0)
    robot.read = lambda: (motion.start_position + np.eye(12)[joint] * 1.5, np.zeros(12))  # type: ignore[method-assign]
    with pytest.raises(Stopped, match=r"lf_kfe is at 0\.\d+ rad, 0\.\d+ beyond its range"):
        play(motion, robot, ramp=0.1, start_tolerance=2.0, wait=lambda instant: 0.0)
    assert robot.sent == []


def test_the_trunk_is_watched_without_a_stabiliser_too(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "csv", tmp_path, rate=RATE)
    motion = Played.load(tmp_path / "motion.csv")
    robot = Robot(motion, {"read_trunk": TRUNKS["upside down"]}, RAMP + 12)
    with pytest.raises(
        Stopped, match=r"the trunk is tilted by 3\.14\d rad from the simulation, .* at most 1 at 0.120 s"
    ):
        play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
    robot = Robot(motion, {"read_trunk": TRUNKS["upside down"]}, 0)
    with pytest.raises(Stopped, match="before the ramp: bring it near the start first"):
        play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
    assert robot.sent == []
    robot = Robot(motion, {"read_trunk": raising}, RAMP + 12)
    play(motion, robot, ramp=0.1, feedback=False, wait=lambda instant: 0.0)  # then it is not read


def test_names_of_the_robots_joints_are_compared(
    motion: Played, place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for names, message in (
        (motion.joints[::-1], "the robot's joints are the same in another order; should be lf_haa, lf_hfe"),
        (motion.joints[:-1], "the robot's joints are lf_haa, .*; should be lf_haa"),
        (12, "the robot's joints are 12; should be lf_haa"),
    ):
        robot = Robot(motion)
        robot.joints = names  # type: ignore[attr-defined]
        with pytest.raises(Stopped, match=message):
            play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
        assert robot.sent == []
    for names in (motion.joints, tuple(motion.joints), np.array(motion.joints), None):
        robot = Robot(motion)
        robot.joints = names  # type: ignore[attr-defined]
        play(motion, robot, ramp=0.1, wait=lambda instant: 0.0)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "reversed_robot.py").write_text(
        "class Reversed:\n    joints = ['rh_kfe'] * 12\n    def read(self): raise OSError('never read')\n"
        "    read_trunk = write = read\n"
    )
    assert main([str(place / "motion.csv"), "--robot", "reversed_robot:Reversed"]) == 2
    assert "player: the robot's joints are rh_kfe, rh_kfe" in capsys.readouterr().err


@pytest.mark.slow
def test_what_a_robot_raises_is_one_line(
    motion: Played, place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "raising_robot.py").write_text(
        "import json, numpy as np\n"
        f"start = np.array({motion.start_position.tolist()})\n"
        "class Raising:\n    sent = 0\n"
        "    def read(self): return start, np.zeros(12)\n"
        "    def write(self, *command):\n"
        "        self.sent += 1\n"
        "        if self.sent > 5: raise RuntimeError('two\\nlines \\x1b[2J')\n"
    )
    arguments = [str(place / "motion.csv"), "--robot", "raising_robot:Raising", "--no-feedback"]
    assert main(arguments) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "\x1b" not in said
    assert said.startswith("player: stopped: RuntimeError: two lines ?[2J (raising_robot.py, line 8); while damping, ")
