"""Watch a solve: messages to its page, and commands from the page.

    watch = Watch(objective, seed=0, directory=Path("rearing"), draw=LiveScene())
    with Server(page, events=watch.events, command=watch.command) as server:
        outcome = run(objective, directory=..., observe=watch.observe, steer=watch.steer)
        watch.finish(outcome)

The solve's thread calls `observe` and `steer`; the server's threads call `events` and `command`. The solve only waits for a
page if the page pauses it. Without a page, watching takes a few microseconds a generation. With a page, it takes at most
`SHARE` of the time to simulate the best motion so far for the 3D view, and sends a few messages a second.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.costs.quantities import unit_of
from levade.errors import LevadeError, did_you_mean
from levade.motions import Motion
from levade.search import Generation, Objective, Stopped
from levade.search.recording import record
from levade.search.run import MOTION, Outcome
from levade.tasks import Change

_MOVING = ("motion", "layers")
"""Parts of a scene that differ between motions of one solve."""

SHARE = 0.02
"""Largest share of the solve's time for showing the best motion."""

_REPLAY_EVERY = 1.0
"""Least time between two motions that are shown [s]."""

_TELL_EVERY = 0.2
"""Least time between two messages to a page [s]."""

_SIGN_OF_LIFE = 5.0
"""Time between two empty messages, which detect a closed page [s]."""

_RANGE = 10.0
"""Largest factor on weights, and its inverse the smallest."""


class Watch:
    """Holds the state of a solve for its page.

    Args:
        objective: The objective.
        seed: Seed of the run, for display.
        directory: Directory of the run, for display.
        draw: Returns the scene of a motion for the page's 3D player.
        interrupted: Tells whether the keyboard asks to end; called while the solve is paused.
    """

    def __init__(
        self,
        objective: Objective,
        *,
        seed: int,
        directory: Path,
        draw: Callable[[Motion], dict[str, Any]],
        interrupted: Callable[[], bool] = lambda: False,
    ) -> None:
        self._objective, self._seed, self._directory = objective, seed, directory
        self._draw, self._interrupted = draw, interrupted
        self._began = time.perf_counter()
        self._rested = 0.0
        self._lock = threading.Lock()
        self._told = threading.Event()
        # written by the solve's thread, read by the server's
        self._rows: list[list[Any]] = []
        self._latest: Generation | None = None
        self._scene: dict[str, Any] | None = None
        self._changes: tuple[Change, ...] = objective.task.search.changes
        self._generation = 1
        self._ended = threading.Event()
        self._verdict: dict[str, Any] | None = None
        # written by the server's threads, read by the solve's
        self._paused_at: float | None = None
        self._stop = False
        self._wanted: dict[str, float] = {}
        self._listeners = 0
        self._best: Array | None = None
        self._found = 0
        self._shown: Array | None = None
        self._next_replay = 0.0

    # the solve's thread

    def observe(self, generation: Generation) -> None:
        """Record a generation.

        Args:
            generation: The generation, as the solve reports it.
        """
        cost, best = generation.cost, generation.best
        if self._best is None or not np.array_equal(best.weights, self._best):
            self._best, self._found = best.weights, generation.trials
        row = [
            *(generation.trials, generation.stage, best.cost, float(cost.min()), float(_median(cost))),
            *(float(cost.max()), generation.step, generation.diverged, int(best.success)),
            [generation.cost_weights[name] * value for name, value in best.terms.items()],
            list(best.errors.values()),
            self._found,
        ]
        with self._lock:
            self._rows.append(row)
            self._latest, self._changes, self._generation = generation, generation.changes, generation.generation
        if not generation.replayed:
            self._show()

    @property
    def note(self) -> str:
        """Return what the terminal should print; empty for nothing."""
        return "paused on the page" if self._paused_at is not None and not self._stop else ""

    def steer(self, generation: int) -> Mapping[str, float] | Stopped | None:
        """Return the factors that the page's sliders ask for. Waits while the page pauses.

        Args:
            generation: Number of the generation to which the factors apply.

        Returns:
            Name of the cost -> factor on its weight, for the factors that change. None if no factor changes.
            `Stopped.INTERRUPTED` if the page, or the keyboard, stops the solve.
        """
        while self._paused_at is not None and not self._stop:
            if self._interrupted():
                return Stopped.INTERRUPTED
            self._show()
            self._told.wait(0.1)
            self._told.clear()
        if self._stop:
            return Stopped.INTERRUPTED
        with self._lock:
            wanted, self._wanted = self._wanted, {}
            in_force = _factors(self._changes, generation)
            moved = {name: factor for name, factor in wanted.items() if factor != in_force.get(name, 1.0)}
            if moved:
                self._changes = (*self._changes, Change(generation, moved))
            self._generation = generation
        return moved or None

    def finish(self, outcome: Outcome | None) -> None:
        """End with an outcome, and inform every page before this returns.

        Only the first call counts.

        Args:
            outcome: Outcome of the solve. None after an error.
        """
        if self._ended.is_set():
            return
        verdict: dict[str, Any] = {"outcome": "error"}
        scene = None
        if outcome is not None:
            solution, result = outcome.solution, outcome.motion.result
            verdict = {
                "outcome": str(solution.stopped),
                "success": result.success,
                "trials": solution.trials,
                "trials_to_success": solution.trials_to_success,
                "cost": result.cost,
                "errors": result.errors,
                "motion": str((outcome.directory / MOTION).resolve()),
            }
            motion = outcome.motion
            scene = self._drawn(lambda: motion)
        with self._lock:
            self._rest(None)
            self._verdict = {**verdict, "elapsed": self._elapsed()}
            self._scene = scene or self._scene
            self._ended.set()
        until = time.perf_counter() + 2.0
        while self._listeners and time.perf_counter() < until:
            time.sleep(0.01)

    def _show(self) -> None:
        """Simulate the best motion again for viewers, unless that was done just now."""
        generation, now = self._latest, time.perf_counter()
        if generation is None or not self._listeners or now < self._next_replay:
            return
        if self._best is self._shown:
            return
        scene = self._drawn(lambda: record(self._objective, generation.solution(), seed=self._seed))
        with self._lock:
            self._scene, self._shown = scene or self._scene, self._best
        took = time.perf_counter() - now
        self._next_replay = now + took + max(_REPLAY_EVERY, took / SHARE)

    def _drawn(self, motion: Callable[[], Motion]) -> dict[str, Any] | None:
        """Return a motion's scene. None if it cannot be shown, which does not end a solve."""
        try:
            return self._draw(motion())
        except Exception:
            return None

    # the server's threads

    def command(self, message: Mapping[str, Any]) -> None:
        """Take a page's command: pause, continue, stop, or factors on the costs' weights.

        Args:
            message: The command under ``say``. With "factors", ``factors`` maps names of costs to factors on their
                weights.

        Raises:
            LevadeError: If it is another command, or a cost or factor is not valid.
        """
        say = message.get("say")
        with self._lock:
            if say == "pause":
                self._rest(time.perf_counter())
            elif say == "continue":
                self._rest(None)
            elif say == "stop":
                self._stop = True
            elif say == "factors":
                self._wanted |= self._checked(message.get("factors"))
            else:
                raise LevadeError(f"say: {say!r} is no command; pause, continue, stop or factors")
        self._told.set()

    def events(self) -> Iterator[dict[str, Any] | None]:
        """Yield messages for one page: the current state, then news, then the verdict."""
        with self._lock:
            self._listeners += 1
        try:
            known, shown, said, spoken = 0, None, None, time.perf_counter()
            message: dict[str, Any] = {"task": self._about()}
            while True:
                ended = self._ended.is_set()
                with self._lock:
                    rows, known = self._rows[known:], len(self._rows)
                    scene, state = self._scene, self._state()
                if rows:
                    message["rows"] = [_plain(row) for row in rows]
                if scene is not shown:
                    # shapes and colours stay: only the first time all of it
                    message["scene"] = scene if shown is None or scene is None else {key: scene[key] for key in _MOVING}
                    shown = scene
                if rows or state != said:
                    message |= {"state": state, "elapsed": self._elapsed()}
                    said = state
                if ended:
                    message["verdict"] = self._verdict
                now = time.perf_counter()
                if message:
                    yield message
                    spoken = now
                elif now - spoken > _SIGN_OF_LIFE:
                    yield None
                    spoken = now
                if ended:
                    return
                message = {}
                self._ended.wait(_TELL_EVERY)
        finally:
            with self._lock:
                self._listeners -= 1

    def _about(self) -> dict[str, Any]:
        """Return what does not change: the task, as the page shows it."""
        task, objective = self._objective.task, self._objective
        return {
            "name": task.name,
            "description": task.description,
            "robot": objective.robot.name,
            "seed": self._seed,
            "directory": str(self._directory.resolve()),
            "budget": task.search.trials,
            "stages": [{"name": stage.name, "weights": dict(stage.weights)} for stage in task.stages],
            "costs": [{"name": name, "weight": cost.weight} for name, cost in task.costs.items()],
            "range": _RANGE,
            "criteria": [
                {
                    "name": name,
                    "unit": unit_of(criterion.quantity),
                    "tolerance": criterion.tolerance or 0.0,
                    "target": criterion.target,
                    "minimum": criterion.minimum,
                    "maximum": criterion.maximum,
                    "at": criterion.at,
                }
                for name, criterion in task.success.items()
            ],
        }

    def _state(self) -> dict[str, Any]:
        in_force = _factors(self._changes, self._generation)
        return {
            "paused": self._paused_at is not None,
            "stopping": self._stop,
            "factors": in_force,
            "wanted": {name: factor for name, factor in self._wanted.items() if factor != in_force.get(name, 1.0)},
            "changes": [{"generation": c.generation, "factors": dict(c.factors)} for c in self._changes],
        }

    def _checked(self, factors: Any) -> dict[str, float]:
        if not isinstance(factors, Mapping):
            raise LevadeError("factors: a table of costs and factors on their weights")
        costs = self._objective.task.costs
        for name, factor in factors.items():
            if name not in costs:
                raise LevadeError(f"factors: no {name!r} in this task; {did_you_mean(str(name), costs)}")
            known = isinstance(factor, (int, float)) and not isinstance(factor, bool)
            if not known or not 1 / _RANGE <= factor <= _RANGE:
                raise LevadeError(f"factors.{name}: {factor!r} should be a number from {1 / _RANGE:g} to {_RANGE:g}")
        return {name: float(factor) for name, factor in factors.items()}

    def _rest(self, since: float | None) -> None:
        """Pause from now on, or continue. Pauses do not count as time of the solve."""
        if self._paused_at is not None and since is None:
            self._rested += time.perf_counter() - self._paused_at
        if self._paused_at is None or since is None:
            self._paused_at = since

    def _elapsed(self) -> float:
        """Return the time without pauses [s]."""
        now = time.perf_counter() if self._paused_at is None else self._paused_at
        return now - self._began - self._rested


def _factors(changes: tuple[Change, ...], generation: int) -> dict[str, float]:
    """Return the factors in force in a generation. Changes are in the order of their generations."""
    return {name: factor for c in changes if c.generation <= generation for name, factor in c.factors.items()}


def _median(values: Any) -> float:
    """Compute a median. numpy's takes longer for a few numbers."""
    ordered = sorted(values.tolist())
    return (ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def _plain(value: Any) -> Any:
    """Round to six digits for JSON. None if the value is not finite."""
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    return value
