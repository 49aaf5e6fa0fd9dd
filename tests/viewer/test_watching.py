"""A solve that is watched: that nobody notices who does not look or touch, and what touching does."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from levade.errors import LevadeError
from levade.motions import ARRAYS, Motion
from levade.search import Generation, Objective, make_objective
from levade.search.run import CHECKPOINT, MOTION, PROGRESS, TASK, Outcome, resume, run
from levade.tasks import load_task
from levade.viewer.watching import Watch

CHANGES = [
    "search.optimizer=cma",
    "search.population=8",
    "search.trials=120",
    "horizon=0.1",
    "success.height.tolerance=0",
]


@pytest.fixture(scope="module")
def objective() -> Objective:
    return make_objective(load_task("rearing", changes=CHANGES), threads=1)


@pytest.fixture(scope="module")
def plain(objective: Objective, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """A run without a page."""
    return run(objective, seed=3, directory=tmp_path_factory.mktemp("plain"))


class Watched:
    """A run with a page, or the part of it that needs no server."""

    def __init__(
        self, objective: Objective, directory: Path, *, interrupted: Callable[[], bool] = lambda: False
    ) -> None:
        self.drawn: list[Motion] = []
        self.watch = Watch(objective, seed=3, directory=directory, draw=self._draw, interrupted=interrupted)
        self.objective, self.directory = objective, directory

    def _draw(self, motion: Motion) -> dict[str, Any]:
        self.drawn.append(motion)
        return {"model": "shapes", "motion": len(self.drawn), "layers": [], "palette": {}}

    def run(self, observe: Callable[[Generation], object] = lambda _: None) -> Outcome:
        def both(generation: Generation) -> None:
            self.watch.observe(generation)
            observe(generation)

        outcome = run(self.objective, seed=3, directory=self.directory, observe=both, steer=self.watch.steer)
        self.watch.finish(outcome)
        return outcome


class Page:
    """Listens as a browser would, in a thread of its own."""

    def __init__(self, watch: Watch) -> None:
        self.messages: list[dict[str, Any]] = []
        self.events = watch.events()
        self._first = threading.Event()
        self.thread = threading.Thread(target=self._listen, daemon=True)
        self.thread.start()
        assert self._first.wait(10)

    def _listen(self) -> None:
        for message in self.events:
            if message is not None:
                self.messages.append(json.loads(json.dumps(message, allow_nan=False)))
            self._first.set()

    def until(self, condition: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        for _ in range(2000):
            for message in list(self.messages):
                if condition(message):
                    return message
            time.sleep(0.01)
        raise AssertionError(f"nothing like it among {len(self.messages)} messages")

    def rows(self) -> list[list[Any]]:
        return [row for message in self.messages for row in message.get("rows", [])]


def assert_same_files(one: Path, other: Path) -> None:
    first, second = Motion.load(one / MOTION), Motion.load(other / MOTION)
    for name in ARRAYS:
        assert first[name].tobytes() == second[name].tobytes(), name
    assert first.meta == second.meta
    for name in (TASK, PROGRESS, CHECKPOINT):
        assert (one / name).read_bytes() == (other / name).read_bytes(), name


@pytest.mark.slow
def test_a_page_that_nobody_opens_changes_no_bit(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    watched.run()
    assert_same_files(tmp_path, plain.directory)
    assert len(watched.drawn) == 1  # at the end, where it costs the search nothing


@pytest.mark.slow
def test_a_page_that_is_looked_at_changes_no_bit(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    watched.run(observe=lambda _: setattr(watched.watch, "_next_replay", 0.0))
    assert_same_files(tmp_path, plain.directory)
    assert len(watched.drawn) > 2  # each better motion was simulated once more, for the page
    page.thread.join(5)
    rows = page.rows()
    assert [row[0] for row in rows] == list(range(8, 121, 8))
    assert rows[-1][2] == pytest.approx(plain.solution.best.cost, rel=1e-5)
    assert rows[-1][10] == pytest.approx(list(plain.solution.best.errors.values()), rel=1e-5)
    assert sum(rows[-1][9]) == pytest.approx(plain.solution.best.cost, rel=1e-4)


@pytest.mark.slow
def test_a_page_that_is_closed_does_not_stop_the_solve(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    events = watched.watch.events()
    assert "task" in (next(events) or {})

    def close(generation: Generation) -> None:
        if generation.generation == 4:
            events.close()  # type: ignore[attr-defined]

    watched.run(close)
    assert_same_files(tmp_path, plain.directory)


@pytest.mark.slow
def test_a_motion_that_cannot_be_shown_does_not_stop_the_solve(
    objective: Objective, plain: Outcome, tmp_path: Path
) -> None:
    watched = Watched(objective, tmp_path)

    def broken(motion: Motion) -> dict[str, Any]:
        raise RuntimeError("no picture")

    watched.watch._draw = broken
    page = Page(watched.watch)
    watched.run()
    assert_same_files(tmp_path, plain.directory)
    page.thread.join(5)
    assert len(page.rows()) == 15
    assert page.messages[-1]["verdict"]["outcome"] == "budget"


@pytest.mark.slow
def test_the_trial_that_found_the_best_is_told(objective: Objective, tmp_path: Path) -> None:
    """Also after its cost has changed with the weights."""
    watched = Watched(objective, tmp_path)
    bests: list[bytes] = []
    command = {"say": "factors", "factors": {"position": 1.5}}

    def observe(generation: Generation) -> None:
        bests.append(generation.best.weights.tobytes())
        if generation.generation == 7:
            watched.watch.command(command)

    watched.run(observe)
    rows = next(iter(watched.watch.events()))["rows"]  # type: ignore[index]
    assert [row[11] for row in rows] == [8 * (bests.index(best) + 1) for best in bests]


@pytest.mark.slow
def test_motions_are_shown_for_a_small_part_of_the_time(objective: Objective, tmp_path: Path) -> None:
    """The longer it takes to show one, the longer until the next: the clock is made slow here."""
    now = [0.0]
    watched = Watched(objective, tmp_path)
    watch = watched.watch
    draws: list[float] = []

    def draw(motion: Motion) -> dict[str, Any]:
        draws.append(now[0])
        now[0] += 0.3
        return {"model": 0, "motion": 0, "layers": 0}

    watch._draw = draw
    page = Page(watch)
    generations: list[Generation] = []
    run(objective, seed=3, directory=tmp_path, observe=generations.append)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("levade.viewer.watching.time.perf_counter", lambda: now[0])
        for k in range(1000):
            now[0] += 0.1
            best = generations[k % 2].best  # a new one every time
            watch._latest = generations[k % 2]
            watch._best = best.weights
            watch._show()
    watch.finish(None)
    page.thread.join(5)
    assert len(draws) > 3
    assert 0.3 * len(draws) < 0.025 * now[0]


@pytest.mark.slow
def test_the_first_message_says_all_and_the_last_how_it_ended(objective: Objective, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    outcome = watched.run()
    page.thread.join(5)
    about = page.messages[0]["task"]
    assert (about["name"], about["robot"], about["seed"], about["budget"]) == ("rearing", "hyq2max", 3, 120)
    assert [cost["name"] for cost in about["costs"]] == list(objective.task.costs)
    assert [criterion["unit"] for criterion in about["criteria"]] == ["rad", "m"]
    verdict = page.messages[-1]["verdict"]
    assert verdict["outcome"] == "budget"
    assert verdict["success"] is False
    assert verdict["trials"] == 120
    assert Path(verdict["motion"]) == (tmp_path / MOTION).resolve()
    assert verdict["errors"] == pytest.approx(outcome.motion.meta["errors"])
    assert [message for message in page.messages[1:] if "task" in message] == []
    # who comes later gets the same at once
    late = [message for message in watched.watch.events() if message is not None]
    assert len(late) == 1
    assert (late[0]["verdict"], len(late[0]["rows"]), late[0]["scene"]["model"]) == (verdict, 15, "shapes")


@pytest.mark.slow
def test_shapes_are_told_once_and_motions_when_there_is_a_better_one(objective: Objective, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    watched.run(at(3, lambda: page.until(lambda message: "scene" in message)))
    page.thread.join(5)
    scenes = [message["scene"] for message in page.messages if "scene" in message]
    assert len(scenes) > 1
    assert set(scenes[0]) == {"model", "motion", "layers", "palette"}
    assert all(set(scene) == {"motion", "layers"} for scene in scenes[1:])
    numbers = [scene["motion"] for scene in scenes]
    assert numbers == sorted(set(numbers))


def at(generation: int, act: Callable[[], object]) -> Callable[[Generation], None]:
    def observe(g: Generation) -> None:
        if g.generation == generation:
            act()

    return observe


@pytest.mark.slow
def test_a_slider_acts_from_the_next_generation_on_and_is_recorded(
    objective: Objective, plain: Outcome, tmp_path: Path
) -> None:
    watched = Watched(objective, tmp_path / "watched")
    page = Page(watched.watch)
    command = {"say": "factors", "factors": {"position": 4, "effort": 1.0}}
    outcome = watched.run(at(5, lambda: watched.watch.command(command)))
    (change,) = load_task(tmp_path / "watched" / TASK).search.changes
    assert (change.generation, change.factors) == (6, {"position": 4.0})  # a slider at 1 is not moved
    assert outcome.solution.changes == (change,)
    assert outcome.solution.best.cost != plain.solution.best.cost
    again = run(load_task(tmp_path / "watched" / TASK), seed=3, directory=tmp_path / "again")
    assert_same_files(tmp_path / "watched", again.directory)
    page.thread.join(5)
    told = [message["state"] for message in page.messages if "state" in message][-1]
    assert (told["factors"], told["wanted"]) == ({"position": 4.0}, {})


@pytest.mark.slow
def test_a_slider_that_is_put_back_in_time_is_not_moved(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)

    def there_and_back() -> None:
        watched.watch.command({"say": "factors", "factors": {"position": 4}})
        watched.watch.command({"say": "factors", "factors": {"position": 1}})

    watched.run(at(5, there_and_back))
    assert_same_files(tmp_path, plain.directory)


@pytest.mark.slow
def test_pause_holds_the_solve_until_it_goes_on(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    seen: list[int] = []

    def pause(generation: Generation) -> None:
        seen.append(generation.generation)
        if generation.generation == 4:
            watched.watch.command({"say": "pause"})

    thread = threading.Thread(target=watched.run, args=(pause,))
    thread.start()
    page.until(lambda message: message.get("state", {}).get("paused", False) and len(seen) == 4)
    time.sleep(0.5)
    assert seen == [1, 2, 3, 4]
    before = watched.watch._elapsed()
    watched.watch.command({"say": "factors", "factors": {"effort": 2}})
    page.until(lambda message: message.get("state", {}).get("wanted") == {"effort": 2.0})
    watched.watch.command({"say": "factors", "factors": {"effort": 1}})
    time.sleep(0.2)
    assert watched.watch._elapsed() == before  # a pause is no time of the solve
    watched.watch.command({"say": "continue"})
    thread.join(60)
    assert seen == list(range(1, 16))
    assert_same_files(tmp_path, plain.directory)


@pytest.mark.slow
def test_stop_keeps_the_best_and_the_run_can_go_on(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    outcome = watched.run(at(5, lambda: watched.watch.command({"say": "stop"})))
    assert (outcome.solution.stopped, outcome.solution.trials) == ("interrupted", 40)
    assert Motion.load(tmp_path / MOTION).meta["stopped"] == "interrupted"
    page.thread.join(5)
    assert page.messages[-1]["verdict"]["outcome"] == "interrupted"
    resume(tmp_path)
    assert_same_files(tmp_path, plain.directory)


@pytest.mark.parametrize("way", ["page", "keyboard"])
def test_a_paused_solve_can_be_stopped(objective: Objective, tmp_path: Path, way: str) -> None:
    pressed = threading.Event()
    watched = Watched(objective, tmp_path, interrupted=pressed.is_set)
    outcomes: list[Outcome] = []

    def pause() -> None:
        watched.watch.command({"say": "pause"})
        stop = pressed.set if way == "keyboard" else lambda: watched.watch.command({"say": "stop"})
        threading.Timer(0.2, stop).start()

    thread = threading.Thread(target=lambda: outcomes.append(watched.run(at(3, pause))))
    thread.start()
    thread.join(30)
    assert (outcomes[0].solution.stopped, outcomes[0].solution.trials) == ("interrupted", 24)


@pytest.mark.slow
def test_a_resumed_run_shows_what_was_before(objective: Objective, plain: Outcome, tmp_path: Path) -> None:
    run(objective, seed=3, directory=tmp_path, observe=at(6, lambda: (_ for _ in ()).throw(KeyboardInterrupt)))
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    outcome = resume(tmp_path, objective=objective, observe=watched.watch.observe, steer=watched.watch.steer)
    watched.watch.finish(outcome)
    assert_same_files(tmp_path, plain.directory)
    page.thread.join(5)
    assert [row[0] for row in page.rows()] == list(range(8, 121, 8))


def test_an_error_ends_the_page_too(objective: Objective, tmp_path: Path) -> None:
    watched = Watched(objective, tmp_path)
    page = Page(watched.watch)
    watched.watch.finish(None)
    watched.watch.finish(None)
    page.thread.join(5)
    assert page.messages[-1]["verdict"]["outcome"] == "error"


@pytest.mark.parametrize(
    ("message", "complaint"),
    [
        ({}, "say: None is no command; pause, continue, stop or factors"),
        ({"say": ["stop"]}, "is no command"),
        ({"say": "factors"}, "factors: a table of costs"),
        ({"say": "factors", "factors": [1]}, "factors: a table of costs"),
        ({"say": "factors", "factors": {"efort": 2}}, "factors: no 'efort' in this task; did you mean effort"),
        ({"say": "factors", "factors": {"effort": 11}}, r"factors.effort: 11 should be a number from 0.1 to 10"),
        ({"say": "factors", "factors": {"effort": 0}}, "factors.effort: 0 should be a number"),
        ({"say": "factors", "factors": {"effort": "2"}}, "factors.effort: '2' should be a number"),
        ({"say": "factors", "factors": {"effort": True}}, "factors.effort: True should be a number"),
        ({"say": "factors", "factors": {"effort": float("nan")}}, "factors.effort: nan should be a number"),
    ],
)
def test_commands_that_are_wrong(objective: Objective, tmp_path: Path, message: dict[str, Any], complaint: str) -> None:
    watch = Watched(objective, tmp_path).watch
    with pytest.raises(LevadeError, match=complaint):
        watch.command(message)
    assert watch.steer(1) is None


@pytest.mark.slow
def test_numbers_that_json_has_not(objective: Objective, tmp_path: Path) -> None:
    """Terms of a hold that is not simulated yet are not a number."""
    changes = [*CHANGES, "search.trials=24", "hold=0.05", "stages.0.hold=false", "costs.orientation.at=end"]
    other = make_objective(load_task("rearing", changes=changes), threads=1)
    watched = Watched(other, tmp_path)
    page = Page(watched.watch)
    watched.run()
    page.thread.join(5)
    assert None in page.rows()[0][9]
