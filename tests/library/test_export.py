"""An exported library: the same answers with numpy alone, and a loop that asks, plays, looks and asks again."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import rolling

from levade.engines import Fold
from levade.errors import LevadeError
from levade.exports import asker
from levade.exports.player import Stopped
from levade.library import Falls, Library, build
from levade.library.exporting import export_library
from levade.robots import Robot
from levade.tasks import Task, load_task

pytestmark = pytest.mark.slow

FOLD = "start={fallen: {height: 0.5, time: 0.4, fold: {time: 0.1, rest: 0.1}}}"


def folding() -> Task:
    """`rolling` from where the robot has drawn its legs in."""
    return rolling(start=FOLD)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    return build(folding(), starts=3, directory=tmp_path_factory.mktemp("libraries") / "rolling")


@pytest.fixture(scope="module")
def folder(library: Library, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("robots") / "rolling"
    export_library(library, place)
    return place


@pytest.fixture(scope="module")
def exported(folder: Path) -> asker.Library:
    return asker.Library.load(folder)


def no_clock() -> Callable[[float], float]:
    return lambda instant: 0.0


@dataclass
class Lying:
    """Lies on its back, its joints where they are sent; or stands as its motions end, as soon as it is told one.

    trips: reading that is none. blind_after: readings of the trunk after which these are none.
    """

    exported: asker.Library
    trips: int = -1
    stands: bool = False
    blind_after: int = 10**9

    def __post_init__(self) -> None:
        self.position, self.readings, self.written = 0.8 * self.exported.fold.start_position, 0, 0
        self.looks, self.stiff = 0, list[bool]()

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        self.readings += 1
        if self.readings == self.trips:
            return np.full_like(self.position, np.nan), self.position
        return self.position, np.zeros_like(self.position)

    def read_trunk(self) -> tuple[np.ndarray, np.ndarray]:
        self.looks += 1
        if self.looks > self.blind_after:
            return np.full(4, np.nan), np.zeros(3)
        return np.array([1.0, 0, 0, 0] if self.stands else [0, 1.0, 0, 0]), np.zeros(3)

    def write(self, position, velocity, torque, kp, kd) -> None:
        self.written += 1
        self.stiff.append(bool(kp.any()))
        if kp.any():
            self.position = position.copy()


def test_it_answers_as_the_library_does(library: Library, exported: asker.Library) -> None:
    generator = np.random.default_rng(0)
    assert set(exported.motions) == {int(one) for one in library.knowledge.motions}
    for _ in range(10):
        up, joints = generator.standard_normal(3), generator.standard_normal(12)
        answer = library.ask(up, joints)
        assert exported.ask(up, joints) == [(answer.number, answer.probability), *answer.others]


def test_a_motion_is_sent_as_the_library_commands_it(library: Library, exported: asker.Library) -> None:
    """From the fold on; the image's joints do what the motion's do on the other side."""
    fold = np.array(exported.fold.start_position)
    np.testing.assert_array_equal(fold, library.fold)
    each = [(number, motion) for number, own in exported.motions.items() for motion in own]
    for number, motion in each:  # from wherever the robot lies
        if number < 0:
            own = exported.motions[-1 - number][0]
            mirror = library.knowledge.mirror
            assert mirror is not None
            np.testing.assert_allclose(motion.position, mirror.posture(own.position), atol=1e-9)
        else:
            answer = replace(
                library.ask([0, 0, 1], fold), path=library.directory / f"motions/{number:06}.npz", mirror=None
            )
            reference = answer.reference.position[0]
            np.testing.assert_allclose(motion.position[: len(reference)], reference, rtol=0, atol=1e-9)


def test_it_asks_again_until_it_stands_and_gives_up(exported: asker.Library) -> None:
    lying = Lying(exported)
    tried = asker.get_up(exported, lying, attempts=2, tolerance=4.0, tilt_tolerance=4.0, wait=no_clock)
    assert [(one.stands, one.stopped) for one in tried] == [(False, "")] * 2
    rows = len(exported.fold.position) + round((exported.fold_time + 0.1) * exported.fold.rate)
    answers = exported.ask(np.array([0.0, 0.0, -1.0]), exported.fold.start_position)[:2]
    assert [(one.motion, one.probability) for one in tried] == answers  # not the same again: it lies as before
    number = answers[0][0]
    second = round(exported.fold.rate)  # in which the drives damp, as it has given up
    played = sum(len(exported.motions[number][0].position) for number, _ in answers)
    assert lying.written == 2 * rows + played + second
    assert not any(lying.stiff[-second:])
    assert all(lying.stiff[:-second])
    lying.stands, lying.position = (
        True,
        exported.motions[number][0].expected[-1],
    )
    assert asker.get_up(exported, lying, wait=no_clock) == []  # it stands already
    lying.position = exported.fold.start_position  # level, with its legs drawn in: it does not
    tried = asker.get_up(exported, lying, attempts=3, tolerance=4.0, tilt_tolerance=4.0, wait=no_clock)
    fold = exported.fold.start_position
    played = asker.nearest(exported.motions[tried[0].motion or 0], np.array([0.0, 0.0, 1.0]), fold)
    ends = bool(np.abs(played.position[-1] - played.expected[-1]).max() < asker.THERE)
    assert [one.stands for one in tried] == ([True] if ends else [False] * 3)


def test_motions_that_failed_from_here_come_last() -> None:
    answers = [(3, 0.9), (-4, 0.8), (7, 0.3)]
    up, joints = np.array([0.0, 0.6, 0.8]), np.zeros(12)
    near, far = np.array([0.0, 0.8, 0.6]), np.array([0.0, -0.6, 0.8])  # turned by 0.28 and by 1.29 rad
    order = [
        [number for number, _ in asker.without_repeats(answers, failed, up, joints)]
        for failed in (
            [],
            [(3, near, joints)],
            [(3, far, joints)],
            [(3, near, joints + 0.4)],
            [(3, up, joints), (-4, up, joints)],
        )
    ]
    assert order == [[3, -4, 7], [-4, 7, 3], [3, -4, 7], [3, -4, 7], [7, 3, -4]]


def test_what_is_astray_is_asked_again_and_what_is_not_to_be_trusted_ends_it(exported: asker.Library) -> None:
    lying = Lying(exported)
    tried = asker.get_up(exported, lying, attempts=2, tilt_tolerance=0.0, wait=no_clock)
    assert len(tried) == 2
    assert all("tilted by" in one.stopped and not one.stands for one in tried)
    with pytest.raises(Stopped, match="should be 12 numbers"):
        asker.get_up(exported, Lying(exported, trips=30), tilt_tolerance=4.0, wait=no_clock)
    blind = Lying(exported)
    blind.read_trunk = None  # type: ignore[assignment]
    with pytest.raises(Stopped, match="no read_trunk"):
        asker.get_up(exported, blind, wait=no_clock)


def test_a_jammed_leg_is_freed_once_before_the_library_is_asked(exported: asker.Library) -> None:
    assert exported.freeing is not None
    free, fold = exported.freeing.start_position, exported.fold.start_position
    told: list[np.ndarray] = []

    @dataclass
    class Jammed(Lying):
        """A knee stays half bent until the legs were stretched."""

        freed: bool = False

        def write(self, position, velocity, torque, kp, kd) -> None:
            super().write(position, velocity, torque, kp, kd)
            if kp.any():
                told.append(position.copy())
                self.freed = self.freed or np.allclose(position, free)
                self.position[2] += 0.0 if self.freed else 2 * exported.jammed

    lying = Jammed(exported)
    tried = asker.get_up(exported, lying, attempts=2, tolerance=4.0, tilt_tolerance=4.0, wait=no_clock)
    assert [one.stopped for one in tried] == ["", ""]
    rests = [fold, free, fold]
    at = [next(i for i in range(len(told)) if np.allclose(told[i], rests[0]))]
    for posture in rests[1:]:
        at.append(next(i for i in range(at[-1] + 1, len(told)) if np.allclose(told[i], posture)))
    stretched = [i for i in range(len(told)) if np.allclose(told[i], free)]
    assert stretched[0] == at[1]
    assert np.ptp(stretched) == len(stretched) - 1  # only once: the second attempt finds nothing jammed


def test_between_two_motions_an_error_lets_the_drives_damp_for_a_second(exported: asker.Library) -> None:
    """The robot looks once per motion before it begins, to see whether it stands; then the fold is played without a look."""
    motions = sum(len(own) for own in exported.motions.values())
    lying, waited = Lying(exported, blind_after=motions), list[float]()

    def clock() -> Callable[[float], float]:
        def wait(instant: float) -> float:
            waited.append(instant)
            return 0.0

        return wait

    with pytest.raises(Stopped, match="numbers"):
        asker.get_up(exported, lying, wait=clock)
    second = round(exported.fold.rate)
    assert lying.stiff[-second - 1]
    assert not any(lying.stiff[-second:])
    assert waited[-1] == pytest.approx(1.0, abs=1.5 / exported.fold.rate)
    before = Lying(exported, blind_after=0)  # nothing was sent yet: the robot's own controller holds it
    with pytest.raises(Stopped):
        asker.get_up(exported, before, wait=clock)
    assert not before.written


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"joints": [0.0]}, "should have joints, and attitude"),
        ({"attitude": [0, 0, 0, 0], "joints": [0.0]}, "should be a quaternion"),
        ({"attitude": [1, 0, 0], "joints": [0.0]}, "should be a quaternion"),
        ({"attitude": [1, 0, 0, 0], "joints": {"knee": 1.0}}, "joints: hip missing"),
    ],
)
def test_a_state_that_says_too_little_is_refused(content: dict[str, object], message: str, tmp_path: Path) -> None:
    place = tmp_path / "state.json"
    place.write_text(json.dumps(content))
    with pytest.raises(ValueError, match=message):
        asker.read_state(place, ["hip"])


def test_an_attitude_need_not_be_of_unit_length(tmp_path: Path) -> None:
    place = tmp_path / "state.json"
    place.write_text(json.dumps({"attitude": [1, 1, 0, 0], "joints": [0.0]}))
    up, _ = asker.read_state(place, ["hip"])
    np.testing.assert_allclose(up, [0.0, 1.0, 0.0], atol=1e-12)  # rolled by 90 degrees: up is to its left


def test_alone_with_numpy_it_says_which_motion(exported: asker.Library, folder: Path, tmp_path: Path) -> None:
    state = tmp_path / "state.json"
    joints = dict(zip(exported.joints, exported.fold.start_position.tolist(), strict=True))
    state.write_text(json.dumps({"attitude": [0, 1, 0, 0], "joints": joints}))
    code = "import runpy, sys; sys.modules['levade'] = None; del sys.argv[0]; runpy.run_path(sys.argv[0], run_name='__main__')"
    ask = [sys.executable, "-c", code, str(folder / "ask.py")]
    done = subprocess.run([*ask, "--state", str(state)], capture_output=True, text=True, cwd=folder, check=True)
    ranked = [(one["motion"], one["probability"]) for one in json.loads(done.stdout)]
    assert ranked == exported.ask(np.array([0.0, 0.0, -1.0]), exported.fold.start_position)


def test_a_folder_that_was_changed_is_refused(folder: Path, tmp_path: Path) -> None:
    for name in ("library.json", "model.npz"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    about = json.loads((tmp_path / "library.json").read_text())
    about["fold"]["time"] = 0.0
    (tmp_path / "library.json").write_text(json.dumps(about))
    with pytest.raises(ValueError, match="was changed since it was exported"):
        asker.Library.load(tmp_path)


def test_a_robot_that_folds_lies_with_its_legs_drawn_in(packaged: Callable[[str], Robot]) -> None:
    """However it fell: its joints are told the same, and are there; its knees are nearly at their ends."""
    robot = packaged("go1")
    falls = Falls(load_task("self-righting", robot="go1"), robot=robot, seed=4, threads=1)
    assert falls.task.start.fallen is not None
    assert falls.task.start.fallen.fold == Fold()
    assert falls.fold is not None
    for state in (falls.objective(i).state for i in range(2)):
        np.testing.assert_array_equal(state.joint_reference[0], falls.fold)
        assert np.median(np.abs(state.joint_position - falls.fold)) < 0.1
    limits = falls.simulation.robot.limits
    knees = np.arange(2, 12, 3)
    assert np.all(falls.fold[knees] < limits.lower[knees] + 0.15)


def test_only_what_folds_is_exported(tmp_path: Path) -> None:
    library = build(rolling(), starts=1, directory=tmp_path / "library")
    with pytest.raises(LevadeError, match="the robot does not fold up first"):
        export_library(library, tmp_path / "robot")
