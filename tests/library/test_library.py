"""Motion libraries: what was done is kept, results depend on nothing but task and seed, answers are what they say."""

from __future__ import annotations

import itertools
import json
import multiprocessing
import shutil
import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import contents, rolling

from levade.engines import Perturbation
from levade.engines.perturbation import PARAMETERS
from levade.errors import LevadeError
from levade.library import Falls, Library, Method, Record, build, check_library
from levade.library.building import rounds
from levade.library.falls import face
from levade.library.figure import projected
from levade.library.knowledge import Knowledge
from levade.library.merging import merge
from levade.library.mirror import Mirror
from levade.library.plays import Plays
from levade.library.refining import refine, refined
from levade.library.storing import Shard
from levade.motions import Motion
from levade.robots import load_robot
from levade.search import make_objective
from levade.tasks import load_task

pytestmark = pytest.mark.slow

STARTS = 7


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    return build(rolling(), starts=STARTS, directory=tmp_path_factory.mktemp("libraries") / "rolling")


def test_every_fall_has_a_record_and_every_motion_found_a_file(library: Library) -> None:
    assert [record.fall for record in library.records] == list(range(STARTS))
    found = {record.fall for record in library.records if record.method in (Method.NEAR, Method.COLD)}
    assert {int(path.stem) for path in (library.directory / "motions").iterdir()} == found
    assert {int(motion) for motion in library.knowledge.motions} == {*found, *(-1 - fall for fall in found)}
    assert {record.method for record in library.records} >= {Method.COLD, Method.KNOWN}
    assert 0 < (library.knowledge.success == 1.0).mean() < 1  # there is something to tell apart
    assert not np.isnan(library.knowledge.success + library.knowledge.perturbed).any()


def test_a_fall_sees_the_library_as_it_was_when_its_round_began(library: Library) -> None:
    assert list(rounds(7)) == [(0, 1), (1, 2), (2, 4), (4, 7)]
    assert list(rounds(100)) == [(0, 1), (1, 2), (2, 4), (4, 8), (8, 16), (16, 32), (32, 64), (64, 96), (96, 100)]
    assert [end - begin for begin, end in rounds(400)][6:] == [32] * 8 + [36, 40, 36]  # an eighth of the falls before
    assert list(rounds(3000))[:13] == list(rounds(256))
    first = {fall: begin for begin, end in rounds(STARTS) for fall in range(begin, end)}
    found = [record.fall for record in library.records if record.motion == record.fall]
    for record in library.records:
        there = [fall for fall in found if fall < first[record.fall]]
        assert sorted(record.tried) == sorted([*there, *(-1 - fall for fall in there)])  # and the image of each


def test_what_a_record_says_is_so(library: Library) -> None:
    """Each motion from each fall once more, alone. HyQ2Max's left legs are its right ones, with other abduction."""
    names = load_robot("hyq2max").joint_names
    other = {"lf": "rf", "rf": "lf", "lh": "rh", "rh": "lh"}
    index = [names.index(other[name[:2]] + name[2:]) for name in names]

    def image(joints: np.ndarray) -> np.ndarray:
        return joints[..., index]

    falls = Falls(rolling())
    for record, row in zip(library.records, library.knowledge.success, strict=True):
        objective = falls.objective(record.fall)
        up, joints = falls.sensed(objective.state)
        np.testing.assert_array_equal(up, record.up)
        np.testing.assert_array_equal(joints, record.joint_position)
        for number, works in zip(library.knowledge.motions, row, strict=True):
            motion = Motion.load(library.directory / "motions" / f"{max(number, -1 - number):06}.npz")
            reference = objective.policy.reference(motion["weights"][None])
            if number < 0:  # the reference of the image: from where the image's joints are, and then mirrored
                start = replace(objective.policy.ends, start=image(objective.state.joint_reference[0]))
                reference = replace(objective.policy, ends=start).reference(motion["weights"][None])
                position, velocity = image(reference.position), image(reference.velocity)
                reference = replace(reference, position=position, velocity=velocity)
            trajectories = objective.engine.rollout(objective.state, reference)
            found = objective.judge(trajectories, objective.task.hold_steps)
            assert found.success[0] == (works == 1.0), (record.fall, number)
        if record.motion is not None:
            assert row[list(library.knowledge.motions).index(record.motion)] == 1.0


@pytest.mark.parametrize("cuts", [(1,), (3, 4), (2, 5, 6)])
def test_stopped_and_gone_on_with_it_has_the_same_bytes(
    library: Library, tmp_path: Path, cuts: tuple[int, ...]
) -> None:
    """Stopped after some parts of it, more than once, with another number of threads."""
    seen: list[int] = []
    for cut in (*cuts, 1000):
        until = len(seen) + cut
        build(
            rolling(),
            starts=STARTS,
            directory=tmp_path,
            threads=1,
            observe=lambda progress: seen.append(progress.done),
            stopping=partial(lambda until: len(seen) >= until, until),
        )
    assert seen[-1] == STARTS
    assert min(seen) < STARTS
    assert contents(tmp_path) == contents(library.directory)


def test_stopped_before_its_first_fall_is_done_it_is_a_library_without_motions(tmp_path: Path) -> None:
    empty = build(rolling(), starts=STARTS, directory=tmp_path, stopping=lambda: True)
    assert (empty.records, empty.coverage, empty.knowledge.cover()) == ((), 0.0, [])
    with pytest.raises(LevadeError, match="no motion was found for any of its 0 falls; continue the build"):
        empty.ask([0, 0, 1], np.zeros(12))


def test_it_grows_to_what_it_would_have_been(library: Library, tmp_path: Path) -> None:
    for starts in (3, 6, STARTS):
        grown = build(rolling(), starts=starts, directory=tmp_path)
        assert len(grown.records) == starts
    assert contents(tmp_path) == contents(library.directory)


def test_a_record_that_is_lost_is_made_again(library: Library, tmp_path: Path) -> None:
    shutil.copytree(library.directory, tmp_path / "again")
    (tmp_path / "again" / "falls" / "000005.json").unlink()
    build(rolling(), starts=STARTS, directory=tmp_path / "again")
    assert contents(tmp_path / "again") == contents(library.directory)


@pytest.mark.slow
def test_killed_at_any_time_it_goes_on_in_two_processes_to_the_same_bytes(library: Library, tmp_path: Path) -> None:
    """kill -9, of the one that others work for, too, once some more falls are done."""
    context, generator = multiprocessing.get_context("spawn"), np.random.default_rng(0)
    for processes, falls in ((1, 1), (2, 3)):
        how = {"starts": STARTS, "directory": tmp_path, "processes": processes}
        process = context.Process(target=build, args=(rolling(),), kwargs=how)
        process.start()
        while process.is_alive() and len(list(tmp_path.glob("falls/*.json"))) < falls:
            time.sleep(0.01)
        time.sleep(generator.uniform(0.0, 0.05))
        process.kill()
        process.join()
        for path in tmp_path.glob("falls/*.json"):  # whole, whenever it was
            assert path.read_bytes() == (library.directory / "falls" / path.name).read_bytes()
    assert not (tmp_path / "success.npz").exists()
    seen: list[int] = []
    build(
        rolling(), starts=STARTS, directory=tmp_path, processes=2, observe=lambda progress: seen.append(progress.done)
    )
    assert seen == list(range(STARTS - len(seen) + 1, STARTS + 1))  # one at a time, whoever did it
    assert contents(tmp_path) == contents(library.directory)


def test_shards_become_a_library(tmp_path: Path) -> None:
    """Each shard has its own falls, as they are in the whole; merged, nothing is left to do but to try every pair."""
    parts = [tmp_path / str(i) for i in range(2)]
    for i, part in enumerate(parts):
        built = build(rolling(), starts=5, directory=part, shard=Shard(i, 2))
        assert [record.fall for record in built.records] == list(range(i, 5, 2))
    whole = tmp_path / "whole"
    assert merge(parts[:1], whole).falls == 3
    merged = merge(parts, whole)
    assert (merged.falls, merged.starts) == (5, 5)
    falls = {path.name: path.read_bytes() for part in parts for path in (part / "falls").iterdir()}
    library = build(rolling(), starts=5, directory=whole)
    assert {path.name: path.read_bytes() for path in (whole / "falls").iterdir()} == falls
    assert not np.isnan(library.knowledge.success + library.knowledge.perturbed).any()
    for shards, said in (
        ([parts[0], parts[0]], "is shard 0/2, and so is .*0; give each shard once"),
        ([parts[0], whole], "whole: is a whole library, not a shard"),
        ([], "no shards to merge"),
    ):
        with pytest.raises(LevadeError, match=said):
            merge(shards, tmp_path / "other")
    with pytest.raises(LevadeError, match="holds shard 0/2 of a library; merge shards first"):
        build(rolling(), starts=5, directory=parts[0])
    with pytest.raises(LevadeError, match="2/2 is not a shard; give 0/2 to 1/2"):
        Shard(2, 2)
    with pytest.raises(LevadeError, match="1 falls have no shard 1/2"):
        build(rolling(), starts=1, directory=tmp_path / "other", shard=Shard(1, 2))


def test_another_task_or_seed_is_refused(library: Library) -> None:
    for task, seed in ((rolling(), 1), (replace(rolling(), hold=0.2), 0)):
        with pytest.raises(LevadeError, match="holds the library of another task, robot or seed"):
            build(task, starts=STARTS, seed=seed, directory=library.directory)


def test_a_library_whose_robot_folded_up_in_another_way_is_refused(library: Library, tmp_path: Path) -> None:
    """Its motions begin in that posture, so that falls of a later version would not fit them."""
    shutil.copytree(library.directory, tmp_path / "old")
    place = tmp_path / "old" / "library.yaml"
    place.write_text(place.read_text() + f"fold: {[0.1] * 12}\n")
    with pytest.raises(LevadeError, match="folded up in another way, as an earlier version"):
        build(rolling(), starts=STARTS, directory=tmp_path / "old")
    with pytest.raises(LevadeError, match="folded up in another way, as an earlier version"):
        check_library(Library.load(tmp_path / "old"), starts=1, seed=1)


def test_an_answer_is_the_motion_from_where_the_joints_are(library: Library) -> None:
    """To the bit what a search from there would have commanded."""
    falls = Falls(rolling(), seed=5)
    objective = falls.objective(0)
    up, _ = falls.sensed(objective.state)
    told = objective.state.joint_reference[0]
    answer = library.ask(7.0 * up, told)  # of any length
    policy = objective.policy
    if answer.mirror is None:
        expected = policy.reference(answer.motion["weights"][None])
        np.testing.assert_array_equal(answer.reference.position, expected.position)
    assert np.abs(answer.reference.position[0, 0] - told).max() < 0.05
    assert answer.others
    assert answer.probability >= max(probability for _, probability in answer.others)


def test_it_is_checked_on_falls_that_it_has_not_seen(library: Library) -> None:
    """Against each fall alone, by hand."""
    n, seed = 5, 3
    found = check_library(library, starts=n, seed=seed)
    falls = Falls(rolling(), seed=seed)
    first = []
    for i in range(n):
        objective = falls.objective(i)
        answer = library.ask(*falls.sensed(objective.state))
        trajectories = objective.engine.rollout(objective.state, answer.reference)
        first.append(bool(objective.judge(trajectories, objective.task.hold_steps).success[0]))
    assert (found.first.successes, found.first.runs) == (sum(first), n)
    assert found.failed == tuple(i for i, works in enumerate(first) if not works)
    assert found.first.successes <= found.after[2].successes <= found.after[3].successes <= found.after[5].successes
    assert found.first.successes <= found.twice.successes <= n
    assert found.perturbed.successes <= found.perturbed_twice.successes <= n
    assert 0 < found.expected < 1
    assert sum(share.runs for share in found.lying.values()) == n
    assert sum(share.successes for share in found.lying.values()) == sum(first)
    assert json.loads(json.dumps(found.to_json()))["nominal"]["first"]["share"] == found.first.share
    with pytest.raises(LevadeError, match="0 is the seed of the library's own falls"):
        check_library(library, starts=n, seed=0)


def test_perturbed_models_that_do_not_differ_give_the_results_of_the_model(library: Library) -> None:
    same = Perturbation(**dict.fromkeys(PARAMETERS))  # type: ignore[arg-type]
    found = check_library(library, starts=8, seed=3, perturbation=same)
    assert 0 < found.first.successes < 8
    assert (found.perturbed, found.perturbed_twice) == (found.first, found.twice)


def test_a_refined_answer_works_where_it_says_so(library: Library) -> None:
    """Simulated by hand. Of five likeliest motions one that works is taken; else a search goes on, until there is no time."""
    falls, plays = Falls(rolling(), seed=3), Plays(library.directory, library.knowledge.mirror)
    for i in range(4):
        objective = falls.objective(i)
        answer = library.ask(*falls.sensed(objective.state))
        numbers = [answer.number, *(number for number, _ in answer.others)]
        better = refined(falls, plays, objective, numbers, seconds=60.0)
        trajectories = objective.engine.rollout(objective.state, better.reference)
        judged = objective.judge(trajectories, objective.task.hold_steps)
        assert bool(judged.success[0]) == better.works
        known = [objective.evaluate(plays[one].decisions(objective.policy)).success[0] for one in numbers[:5]]
        assert better.works >= any(known)
        assert better.searched or better.trials <= len(known) + 24 + 8
        quick = refined(falls, plays, objective, numbers, seconds=1e-9)
        assert (quick.works, quick.searched) == (any(known), False)


def test_a_robot_lies_where_it_is_put_down_to_be_refined(library: Library) -> None:
    """Which way is up for it is what was asked with, until it comes to rest."""
    better = refine(library, [0.0, 0.1, -0.99], np.full(12, 0.1), seconds=1e-9)
    assert better.trials in (5, 13)
    with pytest.raises(LevadeError, match="0 s leave no time to refine"):
        refine(library, [0.0, 0.1, -0.99], np.zeros(12), seconds=0)


def test_a_robot_that_does_not_differ_is_the_model(library: Library) -> None:
    nothing = Perturbation(**dict.fromkeys(vars(Perturbation())))
    found = check_library(library, starts=4, seed=3, perturbation=nothing)
    assert found.perturbed == found.first


@pytest.mark.parametrize(
    ("roll", "pitch", "on"),
    [(0, 0, "belly"), (180, 0, "back"), (90, 0, "right"), (-90, 0, "left"), (0, 90, "nose"), (0, -90, "tail")],
)
def test_what_it_lies_on(roll: float, pitch: float, on: str) -> None:
    """Rolled by 90 degrees the left side is up, and pitched by 90 degrees it looks down."""
    task = load_task(
        "self-righting", changes=[f"start={{fall: {{height: 1.5, roll: {roll} deg, pitch: {pitch} deg, time: 0}}}}"]
    )
    state = make_objective(task, threads=1).state
    assert face(Falls(rolling()).sensed(state)[0]) == on


def test_equal_parts_of_the_sphere_are_equal_parts_of_the_disc() -> None:
    """Lambert's projection: of ways up that are uniform, a quarter is within half the radius, whatever the half."""
    up = np.random.default_rng(0).standard_normal((40_000, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    x, y = projected(up)
    radius = np.hypot(x, y)
    assert radius.max() <= 1 + 1e-9
    for half in (up[:, 2] >= 0, up[:, 2] < 0):
        assert (radius[half] < 0.5).mean() == pytest.approx(0.25, abs=0.01)
    x, y = projected(np.array([[1.0, 0, 0], [0, 1.0, 0]]))  # nose up is at the top, left up at the left
    np.testing.assert_allclose(np.c_[x, y], [[0, 1], [-1, 0]], atol=1e-9)


# what is known


def known(success: list[list[float]], angles: list[float]) -> Knowledge:
    up = np.array([[0.0, np.sin(angle), np.cos(angle)] for angle in angles])
    table = np.array(success, dtype=float)
    return Knowledge(
        np.arange(len(up)), up, np.zeros((len(up), 2)), np.arange(table.shape[1]), table, np.full(table.shape, np.nan)
    )


def test_what_worked_nearby_is_likeliest() -> None:
    knowledge = known([[1, 0], [1, 0], [0, 1], [0, 1]], [0.0, 0.1, 3.0, 3.1])
    here, there = (np.array([0.0, np.sin(a), np.cos(a)]) for a in (0.05, 3.05))
    assert knowledge.ranked(here, np.zeros(2))[0][0] == 0
    assert knowledge.ranked(there, np.zeros(2))[0][0] == 1
    for where in (here, there):
        assert all(0 < probability < 1 for _, probability in knowledge.ranked(where, np.zeros(2)))


def test_of_two_motions_that_work_the_one_that_does_on_other_robots_is_likelier() -> None:
    angles = [0.0, 0.1, 0.2]
    knowledge = replace(known([[1, 1]] * 3, angles), perturbed=np.array([[0.0, 1.0]] * 3))
    ranked = knowledge.ranked(np.array([0.0, 0.0, 1.0]), np.zeros(2))
    assert [fall for fall, _ in ranked] == [1, 0]
    assert ranked[0][1] > 0.9
    assert ranked[1][1] == pytest.approx(0.5, abs=0.1)


def test_all_other_robots_count_as_one_try() -> None:
    """A motion that was tried on further models where it works on the model: these tries do not outweigh the other falls."""
    angles = [0.0, 0.001]
    knowledge = replace(known([[1, 1], [0, 0]], angles), perturbed=np.array([[1.0, 1.0], [0.0, 0.0]]))
    again = np.zeros((2, 2, 2))
    again[:, 0, 0] = (6, 6)
    up, joints = np.array([0.0, 0.0, 1.0]), np.zeros(2)
    np.testing.assert_array_equal(
        replace(knowledge, again=again).probabilities(up, joints), knowledge.probabilities(up, joints)
    )
    again[:, 0, 0] = (5, 2)
    more = replace(knowledge, again=again)
    np.testing.assert_allclose(more.on_others, [[3 / 6, 1], [0, 0]])
    assert more.ranked(up, joints)[0][0] == 1


def test_what_was_not_tried_counts_neither_way() -> None:
    up, joints = np.array([0.0, 0.0, 1.0]), np.zeros(2)
    unknown = known([[1, np.nan], [1, np.nan], [1, 1]], [0.0, 0.1, 0.2]).probabilities(up, joints)
    failed = known([[1, 0], [1, 0], [1, 1]], [0.0, 0.1, 0.2]).probabilities(up, joints)
    assert unknown[1] > failed[1]
    assert unknown[0] == failed[0]


def test_the_distance_of_a_turn_is_its_angle() -> None:
    knowledge = known([[1.0]] * 3, [0.0, 1.0, np.pi])
    np.testing.assert_allclose(knowledge.distances(np.array([0.0, 0.0, 1.0]), np.zeros(2)), [0, 1, np.pi], atol=1e-7)


def test_few_motions_cover_all_that_any_does() -> None:
    """Against all subsets: greedy is at most ln n + 1 times the fewest, and here one more at most."""
    generator = np.random.default_rng(0)
    for _ in range(20):
        success = (generator.random((12, 6)) < 0.3).astype(float)
        knowledge = known(success.tolist(), [0.0] * 12)
        cover = knowledge.cover()
        chosen, counts = [motion for motion, _ in cover], [falls for _, falls in cover]
        reachable = int(success.any(axis=1).sum())
        assert counts == [int(success[:, chosen[: k + 1]].any(axis=1).sum()) for k in range(len(chosen))]
        assert counts == sorted(set(counts))
        assert (counts[-1] if counts else 0) == reachable
        fewest = next(
            k
            for k in range(7)
            if any(
                success[:, list(some)].any(axis=1).sum() == reachable for some in itertools.combinations(range(6), k)
            )
        )
        assert len(chosen) <= fewest + 1


def test_the_image_of_a_fall_has_the_image_of_the_answer() -> None:
    """Which way is up is mirrored by y; of these two joints each is the other's image, the other way round."""
    generator = np.random.default_rng(1)
    mirror = Mirror(np.array([1, 0]), np.array([-1.0, -1.0]))
    up = generator.standard_normal((6, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    tables = (generator.random((2, 6, 4)) < 0.5).astype(float)
    knowledge = Knowledge(
        np.arange(6), up, generator.standard_normal((6, 2)), np.array([0, 3, -1, -4]), *tables, mirror
    )
    for _ in range(10):
        where, joints = generator.standard_normal(3), generator.standard_normal(2)
        where /= np.linalg.norm(where)
        here = dict(knowledge.ranked(where, joints))
        there = dict(knowledge.ranked(where * [1, -1, 1], -joints[::-1]))
        assert {-1 - number: probability for number, probability in there.items()} == pytest.approx(here)


@pytest.mark.parametrize(("groups", "has"), [("sides", True), ("independent", True), ("pairs", True)])
def test_the_image_of_a_motion_is_what_the_mirrored_robot_does(groups: str, has: bool) -> None:
    """Simulated from the image of the state, the trunk goes the mirrored way, until contacts make it chaotic."""
    task = load_task("self-righting", changes=[f"policy.groups={groups}", "start={fallen: {height: 2.0, time: 0.0}}"])
    falls = Falls(task)
    objective = falls.objective(3)
    mirror = Mirror.of(objective.robot)
    assert mirror is not None
    weights = np.random.default_rng(2).uniform(-0.3, 0.3, (1, objective.policy.size))
    image = mirror.decisions(objective.policy, weights)
    assert (image is not None) is has
    assert image is not None
    qpos = objective.state.qpos[0].copy()
    qpos[[1, 4, 6]] *= -1  # y, and the quaternion's x and z
    layout = objective.engine.layout
    qpos[layout.joint_qpos] = mirror.posture(objective.state.joint_position[0])
    state = objective.engine.layout.state(qpos, objective.state.qvel[0], objective.state.act[0])
    mirrored = falls.from_state(state)
    one = objective.rollout(weights, hold_steps=0)
    other = mirrored.rollout(image, hold_steps=0)
    steps = 250  # in the air, where only the robot's own asymmetry tells left from right
    np.testing.assert_allclose(
        other.joint_position[0, :steps], mirror.posture(one.joint_position[0, :steps]), atol=0.02
    )
    np.testing.assert_allclose(
        other.trunk_quaternion[0, :steps], one.trunk_quaternion[0, :steps] * [1, -1, 1, -1], atol=0.02
    )


def test_what_does_not_fit_a_mirror_has_none() -> None:
    policy = Falls(load_task("self-righting", changes=["policy.goal={lf_hfe: 0.9}"])).mirror
    assert policy is None
    assert Falls(load_task("self-righting", changes=["policy.groups=[[lf, rh], [rf], [lh]]"])).mirror is None
    box = "scene.boxes=[{position: [3, 0, 0.1], size: [1, 1, 0.2]}]"
    assert Falls(load_task("self-righting", changes=[box])).mirror is None
    assert Falls(load_task("self-righting")).mirror is not None


# what is wrong


@pytest.mark.parametrize(
    ("up", "joints", "said"),
    [
        ([0, 0], np.zeros(12), "up: should be three numbers"),
        ([0, 0, 0], np.zeros(12), "up: should be three numbers"),
        ([0, 0, np.nan], np.zeros(12), "up: should be three numbers"),
        ([0, 0, 1], np.zeros(11), "joint_position: has 11 numbers, should be the angles of 12 joints"),
        ([0, 0, 1], np.full(12, np.inf), "joint_position: has 12 numbers"),
    ],
)
def test_wrong_questions(library: Library, up: list[float], joints: np.ndarray, said: str) -> None:
    with pytest.raises(LevadeError, match=said):
        library.ask(up, joints)


@pytest.mark.parametrize(
    ("file", "content", "said"),
    [
        ("falls/000002.json", "{", r"000002\.json: .*is not the record of a fall, or is damaged"),
        ("falls/000002.json", '{"fall": 2}', r"000002\.json: is not the record of a fall"),
        ("success.npz", "no archive", r"success\.npz: the file is damaged; remove it"),
        ("library.yaml", "seed: x\n", r"library\.yaml: seed: should be a whole number"),
    ],
)
def test_damaged_libraries(library: Library, tmp_path: Path, file: str, content: str, said: str) -> None:
    shutil.copytree(library.directory, tmp_path / "damaged")
    (tmp_path / "damaged" / file).write_text(content)
    with pytest.raises(LevadeError, match=said):
        check_library(Library.load(tmp_path / "damaged"), starts=1, seed=1)


def test_what_is_no_library_is_said(tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match="holds no motion library"):
        Library.load(tmp_path)
    with pytest.raises(LevadeError, match="0 falls are too few"):
        build(rolling(), starts=0, directory=tmp_path)
    with pytest.raises(LevadeError, match="remove robust and hardware"):
        build(load_task("self-righting-robust"), starts=1, directory=tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_records_survive_json(library: Library, tmp_path: Path) -> None:
    (tmp_path / "falls").mkdir()
    for record in library.records:
        record.write(tmp_path)
        again = vars(Record.load(tmp_path / "falls" / f"{record.fall:06}.json"))
        for name, value in vars(record).items():
            np.testing.assert_array_equal(again[name], value, err_msg=name)
