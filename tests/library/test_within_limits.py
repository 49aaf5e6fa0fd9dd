"""Libraries for hardware: limits decide what works, a certificate what counts as solved, and nothing that was found is lost."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.library.rolling import FALLEN, contents

from levade.cli.app import main
from levade.costs import Criterion
from levade.errors import LevadeError
from levade.library import Falls, Hardware, Library, Method, build, check_library
from levade.library.merging import merge
from levade.library.page import library_data, library_page
from levade.library.plays import Plays, tried, tried_on_others
from levade.library.pursuing import read_certificate
from levade.library.records import fall_of
from levade.library.storing import Shard, read_hardware
from levade.motions import Motion
from levade.tasks import Demands, Task, load_task

pytestmark = pytest.mark.slow

STARTS = 4
FAST = Demands.robust()
FAST = replace(FAST, share=0.5, numerics=False, engines=False, speed=-5.0)
"""Demands that a joint may exceed: six times its speed limit. So some motions meet them after few trials."""

HARDWARE = Hardware(FAST, trials=40, runs=12)


def rolling() -> Task:
    """Lie with the back anywhere but down, after a third of a second: some motions do, from some falls."""
    small = ("hold=0.1", "horizon=0.3", "search.population=4", "search.settings.aimed=0", "physics={timestep: 0.004}")
    task = load_task("self-righting", changes=[FALLEN, *small])
    return replace(task, success={"over": Criterion("tilt", maximum=1.9, at="end")})


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    directory = tmp_path_factory.mktemp("libraries") / "within"
    return build(rolling(), starts=STARTS, directory=directory, hardware=HARDWARE, threads=1)


def test_a_search_solves_a_fall_only_with_a_certificate(library: Library) -> None:
    for record in library.records:
        if record.failed is None:
            assert record.method == Method.KNOWN
            continue
        certificate = read_certificate(library.directory, record.fall)
        assert record.failed == tuple(certificate["failed"])
        assert (record.method in (Method.NEAR, Method.COLD)) == certificate["passed"]
        motion = Motion.load(library.directory / "motions" / f"{record.fall:06}.npz")
        assert motion.checksum == certificate["checksum"]
        assert motion.stabiliser is None
        assert record.motion == (record.fall if motion.met else None)
    assert library.certificates.keys() == {record.fall for record in library.records if record.failed is not None}
    assert any(not failed for failed in library.certificates.values())


def test_what_the_table_says_is_so(library: Library) -> None:
    """Each motion from each fall once more, alone, with the policy of its own file, and the limits computed by hand."""
    falls = Falls(rolling(), threads=1, demands=FAST)
    limits = falls.simulation.robot.limits
    checked = 0
    for record, row in zip(library.records, library.knowledge.success, strict=True):
        objective = falls.objective(record.fall)
        for number, works in zip(library.knowledge.motions, row, strict=True):
            if number < 0:
                continue
            motion = Motion.load(library.directory / "motions" / f"{number:06}.npz")
            policy = motion.policy
            assert policy is not None
            assert policy.ends is not None
            policy = replace(policy, ends=replace(policy.ends, start=objective.state.joint_reference[0]))
            reference = policy.reference(motion["weights"][None], hold_steps=objective.task.hold_steps)
            done = objective.engine.rollout(objective.state, reference)
            slow = (np.abs(done.joint_velocity[0]).max(axis=0) <= (6.0 - 0.01) * limits.velocity).all()
            up = done.trunk_quaternion[0, -1]
            over = np.arccos(1 - 2 * np.square(up[1:3]).sum()) <= 1.9
            assert (slow and over) == (works == 1.0), (record.fall, number)
            checked += 1
    assert checked


def test_a_motion_that_works_on_the_model_is_not_known_beyond_a_limit(library: Library, tmp_path: Path) -> None:
    """Once the speed limit counts in full, motions of the library still roll the robot over, and no longer work."""
    strict = replace(HARDWARE, demands=replace(FAST, speed=0.0), trials=1)
    number = next(fall for fall, failed in library.certificates.items() if not failed)
    row = list(library.knowledge.motions).index(number)
    fall = next(int(one) for one in np.flatnonzero(library.knowledge.success[:, row] == 1.0))
    results = []
    for demands in (FAST, strict.demands):
        falls = Falls(rolling(), threads=1, demands=demands)
        play = Plays(library.directory, falls.mirror)[number]
        (found,) = tried([falls.objective(fall)], [[play]])
        assert falls.judged.success["over"].met(found.errors["over"])[0]
        results.append(
            (bool(found.success[0]), bool(falls.judged.success["speed_margin"].met(found.errors["speed_margin"])[0]))
        )
        if (
            demands is FAST
        ):  # perturbed models have to reach the goal; their limits are not demanded, as in a certificate
            (share,) = tried_on_others(
                [falls.objective(fall)], [dict.fromkeys(range(8), play)], falls.plan.perturb, seeds=[(1,)]
            )
            assert share.any()
    assert results == [(True, True), (False, False)]

    copy = tmp_path / "strict"
    shutil.copytree(library.directory, copy)
    text = (copy / "library.yaml").read_text()
    (copy / "library.yaml").write_text(
        text.replace('"speed": -5.0', '"speed": 0.0').replace('"trials": 40', '"trials": 1')
    )
    assert read_hardware(copy) == strict
    after = [one for one in library.records if one.fall >= 2]  # those of the last round see the motions of the others
    for record in after:
        (copy / "falls" / f"{record.fall:06}.json").unlink()
    again = build(rolling(), starts=STARTS, directory=copy, hardware=strict, threads=1)
    for record in again.records[2:]:
        assert record.worked == ()
        assert record.method == Method.NONE
        assert record.motion is None
        assert "speed" in (record.failed or ())
        assert (copy / "motions" / f"{record.fall:06}.npz").is_file()
    assert {fall_of(number) for number in again.knowledge.motions} <= {0, 1}


def built_in_parts(
    directory: Path, cuts: tuple[int, ...], *, starts: int, hardware: Hardware, threads: int, processes: int = 1
) -> Library:
    """Build, and stop at each of these calls of ``stopping``: between generations, and between parts of certificates.

    The processes do what is left after the last stop.
    """
    for cut in (*cuts, 10**9):
        calls: list[int] = []

        def stopping(calls: list[int], cut: int) -> bool:
            calls.append(1)
            return len(calls) > cut

        library = build(
            rolling(),
            starts=starts,
            directory=directory,
            hardware=hardware,
            threads=threads,
            processes=1 if cut in cuts else processes,
            stopping=partial(stopping, calls, cut),
        )
        assert (len(calls) > cut) == (cut in cuts)
    return library


def test_stopped_in_a_search_and_gone_on_with_it_has_the_same_bytes(tmp_path: Path) -> None:
    small = replace(HARDWARE, trials=10, runs=4)
    whole = built_in_parts(tmp_path / "whole", (), starts=1, hardware=small, threads=1)
    parts = built_in_parts(tmp_path / "parts", (2, 7), starts=1, hardware=small, threads=2)
    assert len(whole.records) == 1
    assert contents(parts.directory) == contents(whole.directory)


@pytest.mark.slow
def test_stopped_anywhere_and_gone_on_with_in_processes_it_has_the_same_bytes(library: Library, tmp_path: Path) -> None:
    built_in_parts(tmp_path, (3, 30, 5), starts=STARTS, hardware=HARDWARE, threads=2, processes=2)
    assert contents(tmp_path) == contents(library.directory)


def test_libraries_with_and_without_hardware_do_not_mix(library: Library, tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match="holds a library within the limits of hardware"):
        build(rolling(), starts=STARTS, directory=library.directory)
    for other, said in (
        (replace(HARDWARE, trials=41), "trials 40, not 41"),
        (replace(HARDWARE, demands=replace(FAST, speed=0.0)), "speed -5.0, not 0.0"),
    ):
        with pytest.raises(LevadeError, match=f"holds a library with other demands: {said}"):
            build(rolling(), starts=STARTS, directory=library.directory, hardware=other)
    build(rolling(), starts=1, directory=tmp_path, stopping=lambda: True)
    assert "hardware" not in (tmp_path / "library.yaml").read_text()
    with pytest.raises(LevadeError, match="holds a library without the limits of hardware"):
        build(rolling(), starts=1, directory=tmp_path, hardware=HARDWARE)
    with pytest.raises(LevadeError, match="0 trials are too few"):
        Hardware(trials=0)
    with pytest.raises(LevadeError, match="no success criteria to certify"):
        build(replace(rolling(), success={}), starts=1, directory=tmp_path / "none", hardware=HARDWARE)


def test_an_answer_says_whether_its_motion_has_a_certificate(library: Library) -> None:
    record = library.records[0]
    answer = library.ask(record.up, record.joint_position)
    assert answer.failed == library.certificates[fall_of(answer.number)]
    assert library.failed_by(-1 - fall_of(answer.number)) == answer.failed


def test_a_check_counts_certificates_and_what_answers_miss(library: Library) -> None:
    """Against each fall alone."""
    n, seed = 4, 3
    found = check_library(library, starts=n, seed=seed, threads=1)
    falls = Falls(rolling(), seed=seed, threads=1, demands=FAST)
    plays = Plays(library.directory, falls.mirror)
    certified, missed = 0, 0
    for i in range(n):
        objective = falls.objective(i)
        answer = library.ask(*falls.sensed(objective.state))
        (one,) = tried([objective], [[plays[answer.number]]])
        certified += bool(one.success[0]) and not answer.failed
        missed += not falls.judged.success["over"].met(one.errors["over"])[0]
    assert found.certified is not None
    assert (found.certified.successes, found.certified.runs) == (certified, n)
    assert found.missed.get("over", 0) == missed
    assert json.loads(json.dumps(found.to_json()))["hardware"]["certified"]["runs"] == n


@pytest.mark.slow
def test_shards_keep_their_certificates(tmp_path: Path) -> None:
    parts = [tmp_path / "0", tmp_path / "1"]
    for i, part in enumerate(parts):
        build(rolling(), starts=2, directory=part, hardware=replace(HARDWARE, trials=8), shard=Shard(i, 2), threads=1)
    merge(parts, tmp_path / "whole")
    for folder in ("motions", "certificates", "falls"):
        there = {path.name: path.read_bytes() for path in (tmp_path / "whole" / folder).iterdir()}
        assert there == {path.name: path.read_bytes() for part in parts for path in (part / folder).iterdir()}
    assert read_hardware(tmp_path / "whole") == replace(HARDWARE, trials=8)
    text = (parts[1] / "library.yaml").read_text()
    (parts[1] / "library.yaml").write_text(text.replace('"trials": 8', '"trials": 9'))
    with pytest.raises(LevadeError, match="makes other demands of hardware"):
        merge(parts, tmp_path / "other")


def test_the_command_line_says_which_certificates_pass(library: Library, capsys: pytest.CaptureFixture[str]) -> None:
    def run(*words: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as ended:
            main(["library", *words])
        out, err = capsys.readouterr()
        return int(str(ended.value.code)), out, err

    directory = str(library.directory)
    failed = library.certificates
    passed = [number for number, names in failed.items() if not names]
    status, out, _ = run("show", directory, "--json")
    assert status == 0
    assert json.loads(out)["certificates"]["passed"] == passed
    _, out, _ = run("show", directory, "--no-report")
    assert f"The certificates of {len(passed)} of {len(failed)} motions pass." in " ".join(out.split())
    assert "comes nearest to a limit" in out
    for words, said in (
        (["--trials", "5"], "--trials only works with --hardware"),
        (["--demand", "share=0.9"], "--demand only works with --hardware"),
        (["--hardware", "--trials", "0"], "--trials: 0 trials are too few"),
    ):
        status, _, err = run("build", "self-righting", "--out", directory, *words)
        assert (status, err.count("\n")) == (2, 1)
        assert said in err


def test_the_page_says_which_certificates_pass(library: Library) -> None:
    data = library_data(library)
    failed = library.certificates
    assert data["certificates"]["motions"] == len(failed)
    assert data["certificates"]["passed"] == sum(not names for names in failed.values())
    for row in data["listed"]:
        assert tuple(row["certificate"]["failed"]) == failed[row["fall"]]
        assert row["certificate"]["share"] >= (FAST.share or 0.0) or row["certificate"]["failed"]
    assert "Certificates" in library_page(library)
