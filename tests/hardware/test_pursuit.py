"""Pursuits: no search more than it takes, nothing lost, and the certificate has the last word."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.hardware.short import shorten

import levade.hardware.pursuit as pursuit_module
from levade.checks import Demands, check
from levade.checks.record import CERTIFICATE
from levade.checks.statistics import wilson
from levade.costs import Criterion
from levade.errors import LevadeError
from levade.hardware import (
    Part,
    Plan,
    Pursued,
    binding,
    budget,
    discard,
    is_pursuit,
    keeping,
    obstacles,
    pursue,
    read_pursuit,
)
from levade.hardware.part import Rank
from levade.hardware.pursuit import Observe
from levade.hardware.state import ASKED
from levade.motions import Motion
from levade.search import Generation, Stopped
from levade.search.checkpoint import CHECKPOINT
from levade.tasks import HorizonRange, PolicyChoice, Task, load_task

pytestmark = pytest.mark.slow

RUNS = 12
"""Perturbed runs of a certificate: what is tried here is what becomes of it."""


def standing() -> Task:
    """A task that needs no more than its first search: short, with few time steps."""
    return load_task("sit-to-stand", changes=["horizon=2 falls", "hold=0.2", "physics={timestep: 0.004}"])


@pytest.fixture(scope="module", autouse=True)
def _short() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        shorten(patch)
        yield


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Callable[[str, Generation], None]:
    """Time passes with the generations, a second for each: which search ends when does not depend on the computer.

    Pursuits have to observe with it.
    """
    now = [0.0]

    def tick(name: str, generation: Generation) -> None:
        now[0] += not generation.replayed

    for module in (pursuit_module, budget):
        monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: now[0]))
    return tick


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Pursued:
    return pursue(standing(), seed=0, directory=tmp_path_factory.mktemp("pursuits") / "stand", runs=RUNS)


def test_a_certificate_that_passes_ends_it(found: Pursued) -> None:
    assert found.passed
    assert [part.name for part in found.parts] == ["limits-1"]
    assert "left" in binding(found.certificate)
    assert obstacles(found) == []


def test_what_is_written_is_the_motion_and_its_certificate(found: Pursued) -> None:
    motion = Motion.load(found.directory / "motion.npz")
    np.testing.assert_array_equal(motion["weights"], found.motion["weights"])
    written = json.loads((found.directory / CERTIFICATE).read_text())
    assert written["passed"] is True
    assert written["perturbed"]["share"] == found.certificate.perturbed.share
    again = check(motion, seed=0, runs=RUNS)  # as `levade check` judges the file: by what is good enough on hardware
    assert again.to_json() == found.certificate.to_json()


def test_the_motion_leaves_something_of_every_limit(found: Pursued) -> None:
    """From the file's arrays, by hand."""
    motion, limits = found.motion, found.motion.embodiment.limits
    assert (motion["joint_position"] >= limits.lower).all()
    assert (motion["joint_position"] <= limits.upper).all()
    assert (np.abs(motion["joint_velocity"]) < limits.velocity).all()


@pytest.mark.parametrize(
    ("successes", "runs", "sure"),
    [(475, 500, False), (484, 500, False), (485, 500, True), (12, 12, True), (474, 500, False)],
)
def test_what_barely_passes_is_not_sure(found: Pursued, successes: int, runs: int, sure: bool) -> None:
    """Wilson's interval: of 500 runs, 485 are the least of which the lower end is 95 %."""
    low, high = wilson(successes, runs)
    seen = replace(found.certificate.perturbed, successes=successes, runs=runs, low=low, high=high)
    part = replace(found.best, certificate=replace(found.certificate, perturbed=seen))
    assert part.sure is sure
    assert part.near
    few = replace(seen, successes=runs // 2)
    assert not replace(part, certificate=replace(found.certificate, perturbed=few)).near
    assert not replace(part, certificate=None).sure


def ranked(found: Pursued, share: float, *, fails: Sequence[str] = (), limit: bool = False) -> Rank:
    """The rank of a certificate with another share, which fails in some variants, and keeps a limit or not."""
    known = found.certificate
    numerics = {name: replace(one, success=name not in fails) for name, one in known.numerics.items()}
    margins = {**known.margins, "speed": replace(known.margins["speed"], passed=not limit)}
    runs = replace(known.perturbed, successes=round(100 * share), runs=100)
    return replace(found.best, certificate=replace(known, perturbed=runs, numerics=numerics, margins=margins)).rank


def test_of_motions_that_fail_the_nearest_to_passing_is_best(found: Pursued) -> None:
    contacts = ["softer contact", "stiffer contact"]
    order = [
        ranked(found, 0.97),
        ranked(found, 0.96),
        ranked(found, 0.99, fails=contacts[:1]),
        ranked(found, 0.96, fails=contacts),
        ranked(found, 0.84, fails=contacts),
        ranked(found, 0.43, fails=contacts[:1]),
        ranked(found, 0.43, fails=contacts),
        ranked(found, 1.0, limit=True),
        replace(found.best, certificate=replace(found.certificate, interrupted=True)).rank,
        replace(found.best, certificate=None).rank,
    ]
    assert order == sorted(order)
    assert len(set(order)) == len(order)


def test_called_again_it_searches_no_more(found: Pursued) -> None:
    seen: list[bool] = []

    def observe(name: str, generation: Generation) -> None:
        seen.append(generation.replayed)

    again = pursue(standing(), seed=0, directory=found.directory, runs=RUNS, observe=observe)
    assert all(seen)
    for name, array in found.motion.arrays.items():
        assert again.motion[name].tobytes() == array.tobytes(), name


def test_another_seed_s_directory_is_left_alone(found: Pursued) -> None:
    with pytest.raises(LevadeError, match="holds the pursuit of another task, robot or seed"):
        pursue(standing(), seed=1, directory=found.directory)


def test_interrupted_it_keeps_its_best_and_goes_on(found: Pursued, tmp_path: Path) -> None:
    """To the motion that it would have come to."""
    task = standing()

    def third(name: str, generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if generation.generation == 3 else None

    cut = pursue(task, seed=0, directory=tmp_path / "cut", runs=RUNS, observe=third)
    assert cut.stopped == "interrupted"
    assert Motion.load(tmp_path / "cut" / "motion.npz").result.stopped == "interrupted"
    whole = pursue(task, seed=0, directory=tmp_path / "cut", runs=RUNS)
    assert whole.stopped == ""
    assert whole.motion["weights"].tobytes() == found.motion["weights"].tobytes()


def test_out_of_time_it_ends_and_names_what_fails_with_what_would_have_to_give(tmp_path: Path) -> None:
    """A demand that nothing meets: a whole speed limit to spare."""
    told: list[Part] = []
    late = pursue(
        standing(), directory=tmp_path, runs=RUNS, minutes=0.002, demands=Demands(speed=1.0), tell=told.append
    )
    assert late.stopped == "time"
    assert [(part.name, part.certificate is None) for part in told] == [("limits-1", True), ("limits-1", False)]
    assert late.trials == late.motion.result.trials < 6000
    assert not late.passed
    (speed,) = (text for text in obstacles(late) if "speed limit" in text)
    assert "rad/s, a slower motion" in speed


def test_what_is_forgotten_is_no_pursuit_any_more(tmp_path: Path) -> None:
    (tmp_path / "limits-1").mkdir()
    files = [tmp_path / ASKED, tmp_path / "limits-1" / CHECKPOINT, tmp_path / CHECKPOINT]
    for file in (*files, tmp_path / "notes.txt"):
        file.write_text("{}")
    discard(tmp_path)
    assert not is_pursuit(tmp_path)
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["notes.txt"]


def test_a_task_without_criteria_cannot_be_certified(tmp_path: Path) -> None:
    task = replace(standing(), success={})
    with pytest.raises(LevadeError, match="no success criteria to certify"):
        pursue(task, directory=tmp_path / "none")
    assert not (tmp_path / "none").exists()


def test_a_page_that_is_not_levades_is_said_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "certificate.html").write_text("mine")
    with pytest.raises(LevadeError, match=r"certificate\.html: is no report of levade's"):
        pursue(standing(), directory=tmp_path, runs=RUNS)
    assert [path.name for path in tmp_path.iterdir()] == ["certificate.html"]


def test_what_was_demanded_and_chosen_is_kept(found: Pursued) -> None:
    task, seed, demands = read_pursuit(found.directory)
    assert (task, seed, demands) == (standing(), 0, Demands())
    assert json.loads((found.directory / ASKED).read_text())["chosen"] == "limits-1"


def test_a_search_that_was_not_chosen_is_not_gone_on_with(found: Pursued, tmp_path: Path) -> None:
    """The second search passed while the first was cut short: a later call leaves the first alone."""
    shutil.copytree(found.directory, tmp_path / "run")
    content = json.loads((tmp_path / "run" / ASKED).read_text())
    (tmp_path / "run" / ASKED).write_text(json.dumps({**content, "chosen": "limits-2"}))

    def first(demands: Demands | None) -> str:
        """The search that a call begins with, and is stopped in."""
        stopped = pursue(
            standing(),
            directory=tmp_path / "run",
            runs=RUNS,
            demands=demands,
            observe=lambda name, generation: Stopped.INTERRUPTED,
        )
        return stopped.parts[0].name

    assert first(None) == "limits-2"
    assert first(Demands(share=0.9)) == "limits-1"  # it was chosen by other demands


def test_where_none_is_within_the_limits_the_nearest_is_certified(
    tmp_path: Path, clock: Callable[[str, Generation], None]
) -> None:
    """Interrupted in the second search: the first, which comes nearer, is what there is to show."""

    def interrupted(name: str, generation: Generation) -> Stopped | None:
        clock(name, generation)
        late = generation.generation == (3 if name == "limits-1" else 1)
        return Stopped.INTERRUPTED if late and name == "limits-2" else None

    task = standing()
    changes = replace(
        task, success={**task.success, "high": Criterion("height", minimum=9.0, at="max")}
    )  # nothing does
    seen = pursue(changes, directory=tmp_path, runs=RUNS, minutes=0.2, observe=interrupted)
    assert not seen.passed
    certified = [part for part in seen.parts if part.certificate is not None]
    assert [part.name for part in certified] == [seen.best.name]
    assert seen.best.motion.result.cost == min(part.motion.result.cost for part in seen.parts)


def test_with_time_left_it_searches_again_with_another_seed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A demand that no search knows of, so that all fail it: another attempt begins, and a later call goes on with it."""
    within_limits, robust = Plan.within_limits, Plan.robust

    def shorter(task: Task) -> Task:
        return replace(task, search=replace(task.search, trials=36, polish=12))

    def robust_for_short(self: Plan, horizon: float, policy: PolicyChoice | None = None) -> Task:
        return shorter(robust(self, horizon, policy))

    monkeypatch.setattr(Plan, "within_limits", lambda self, number=0: shorter(within_limits(self, number)))
    monkeypatch.setattr(Plan, "robust", robust_for_short)
    for part in ("numerics", "other_engines"):  # what certificates say of them is of no account here
        monkeypatch.setattr(f"levade.checks.{part}", lambda simulation: {})
    monkeypatch.setattr(
        pursuit_module, "_GOOD", 1.1
    )  # no share is good enough: one more motion to begin around is looked for
    monkeypatch.setattr(pursuit_module, "MORE", pursuit_module.MORE[:1])
    monkeypatch.setattr(keeping, "write_certificate", lambda *_, **__: None)  # the page, after each search
    demands, begun = Demands(trunk_acceleration=1e-6), list[str]()

    def stop(name: str, generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if name == "again-1/limits-1" and generation.generation == 2 else None

    def pursuit(minutes: float | None, observe: Observe | None) -> Pursued:
        return pursue(
            standing(),
            directory=tmp_path,
            runs=4,
            minutes=minutes,
            demands=demands,
            begin=lambda name, task: begun.append(name),
            observe=observe,
        )

    cut = pursuit(60.0, stop)
    assert cut.stopped == "interrupted"
    assert [part.name for part in cut.parts] == begun
    assert begun[:4] == ["limits-1", "limits-2", "limits-3", "limits-4"]
    best = max(cut.parts[:4], key=lambda part: part.share)
    assert begun[4] == best.name.replace("limits", "feedback")
    assert begun[-1] == "again-1/limits-1"
    seeds = [part.motion.provenance.seed for part in cut.parts[:4]]
    assert len(set(seeds)) == 4
    assert cut.certificate.failed == ("trunk acceleration",)
    first = cut.parts[0].motion
    assert cut.parts[-1].motion.provenance.seed != first.provenance.seed
    assert read_pursuit(tmp_path / "again-1")[1] == cut.parts[-1].motion.provenance.seed
    begun.clear()
    whole = pursuit(None, None)  # what has begun comes to its end; without a time, nothing more is begun
    assert whole.stopped == ""
    assert any(name.startswith("again-1/") for name in begun)
    assert not any(name.startswith("again-2/") for name in begun)
    kept = Motion.load(tmp_path / "motion.npz")
    assert kept["weights"].tobytes() == whole.motion["weights"].tobytes()
    discard(tmp_path)
    assert not is_pursuit(tmp_path / "again-1")


def references(motion: Motion) -> np.ndarray:
    """Joint references [rad] of shape (101, joints) over the duration, whatever it is."""
    phases = motion["time"] / motion.horizon
    return np.stack(
        [np.interp(np.linspace(0, 1, 101), phases, one) for one in motion["joint_position_reference"].T], axis=1
    )


def test_the_last_search_within_limits_is_around_the_nearest(
    tmp_path: Path, clock: Callable[[str, Generation], None]
) -> None:
    told: list[Part] = []
    task = standing()
    impossible = replace(task, success={**task.success, "high": Criterion("height", minimum=9.0, at="max")})
    late = pursue(impossible, directory=tmp_path, runs=RUNS, minutes=0.2, observe=clock, tell=told.append)
    assert late.stopped == "time"
    first, second, third, certified = told
    assert [part.name for part in told[:3]] == ["limits-1", "limits-2", "limits-3"]
    costs = first.motion.task.costs  # the second has other weights
    nearest = min(
        first,
        second,
        key=lambda part: sum(costs[name].weight * term for name, term in part.motion.result.cost_terms.items()),
    )
    assert third.motion.task.stages[0].name == "nearer"
    begun = third.motion.task.horizon
    assert isinstance(begun, HorizonRange)
    # within a time step, which the horizon is rounded to
    assert begun.initial == pytest.approx(nearest.motion.horizon, abs=nearest.motion.timestep)
    other = second if nearest is first else first
    apart = [np.abs(references(part.motion) - references(nearest.motion)).max() for part in (third, other)]
    assert apart[0] < apart[1]
    assert certified.certificate is not None
    # with more time, it goes on: where it was, although the nearest of the others may now be another
    seen: dict[str, list[bool]] = {}

    def observe(name: str, generation: Generation) -> None:
        clock(name, generation)
        seen.setdefault(name, []).append(generation.replayed)

    more = pursue(impossible, directory=tmp_path, runs=RUNS, minutes=0.3, observe=observe)
    assert list(seen) == ["limits-1", "limits-2", "limits-3"]
    assert all(flags[0] for flags in seen.values())
    assert more.parts[2].motion.task.horizon == begun
    # and a pursuit that was gone on from it goes on from it, without the others
    content = json.loads((tmp_path / ASKED).read_text())
    (tmp_path / ASKED).write_text(json.dumps({**content, "chosen": "limits-3"}))
    alone = pursue(impossible, directory=tmp_path, runs=RUNS, observe=lambda name, generation: Stopped.INTERRUPTED)
    assert [part.name for part in alone.parts] == ["limits-3"]
    assert alone.parts[0].motion.task.horizon == begun
