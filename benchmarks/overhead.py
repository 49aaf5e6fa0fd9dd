"""Where the time of a whole solve goes: the engine, and everything that is not the engine.

    python benchmarks/overhead.py [rearing posture-recovery] [--trials 600] [--repeats 3] [--seed 0] [--keep]

--keep writes the table to results/overhead.md, which `cases.py` puts on its page.

Each task is solved as `levade solve` does, through its stages, for so many trials, on one thread and on two. Clocks are read
around the calls: *engine* is `mujoco.batch`'s own roll-out, in C; *recording* what `levade.engines` does around it; *policy*,
*costs* (terms, criteria, sums) and *optimizer* (ask, tell, aimed candidates) as named; *rest* the loop. Medians over repeats.
CPU time counts one thread as it is; with two, the engine's threads share its work, and the rest has the wall to itself: its
share there is measured by the wall, and also predicted from one thread, which a busy machine does not disturb.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

KEPT = Path(__file__).parent / "results" / "overhead.md"
PARTS = ("engine", "recording", "policy", "costs", "optimizer", "rest")


class Clock:
    """Time spent in parts of a program; a part within another counts for itself alone."""

    def __init__(self, read: Callable[[], float]) -> None:
        self.read = read
        self.spent: dict[str, float] = dict.fromkeys(PARTS, 0.0)
        self._within: list[str] = ["rest"]
        self._since = read()

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        self._turn()
        self._within.append(name)
        try:
            yield
        finally:
            self._turn()
            self._within.pop()

    def end(self) -> dict[str, float]:
        self._turn()
        return self.spent

    def _turn(self) -> None:
        now = self.read()
        self.spent[self._within[-1]] += now - self._since
        self._since = now


@contextmanager
def watched(owner: Any, name: str, clock: Clock, part: str) -> Iterator[None]:
    """Calls of a function or method count for a part."""
    real = getattr(owner, name)

    def timed(*arguments: Any, **named: Any) -> Any:
        with clock.part(part):
            return real(*arguments, **named)

    setattr(owner, name, timed)
    try:
        yield
    finally:
        setattr(owner, name, real)


def measure(task: str, *, threads: int, trials: int, seed: int, read: Callable[[], float]) -> dict[str, float]:
    """Part -> time [s] of one solve, without loading, compiling and settling."""
    from contextlib import ExitStack

    from mujoco.batch import Batch

    from levade.engines import MujocoEngine
    from levade.policies import Policy
    from levade.search import Evaluation, Objective, make_objective, solve
    from levade.search.optimizing import make_attempt
    from levade.tasks import load_task

    changes = [f"search.trials={trials}", "search.polish=null"]
    objective = make_objective(load_task(task, changes=changes), threads=threads)
    optimizer = type(make_attempt(objective.task, objective.space, seed=seed))
    clock = Clock(read)
    with ExitStack() as stack:
        for owner, name, part in (
            (Batch, "rollout", "engine"),
            (MujocoEngine, "rollout", "recording"),
            (Policy, "reference", "policy"),
            (Objective, "judge", "costs"),
            (Evaluation, "cost", "costs"),
            (optimizer, "ask", "optimizer"),
            (optimizer, "tell", "optimizer"),
        ):
            stack.enter_context(watched(owner, name, clock, part))
        solve(objective, seed=seed)
    return clock.end()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*", default=["rearing", "posture-recovery"])
    parser.add_argument("--trials", type=int, default=600)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", action="store_true", help="write the table to results/overhead.md")
    arguments = parser.parse_args()
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    lines: list[str] = []

    def say(line: str) -> None:
        print(line, flush=True)
        lines.append(line)

    say(f"| task | clock | {' | '.join(PARTS)} | not engine |\n|---|---|{'---|' * (len(PARTS) + 1)}")
    for task in arguments.tasks:
        ways = {"CPU, one thread": (1, time.process_time), "wall, two threads": (2, time.perf_counter)}
        found: dict[str, list[dict[str, float]]] = {way: [] for way in ways}
        for _ in range(arguments.repeats):
            for way, (threads, read) in ways.items():
                found[way].append(
                    measure(task, threads=threads, trials=arguments.trials, seed=arguments.seed, read=read)
                )
        for way, runs in found.items():
            say(row(task, way, {part: statistics.median(run[part] for run in runs) for part in PARTS}))
        one = {part: statistics.median(run[part] for run in found["CPU, one thread"]) for part in PARTS}
        say(row(task, "two threads, predicted", {**one, "engine": one["engine"] / 2}))
    if arguments.keep:
        KEPT.write_text("\n".join(lines) + "\n", encoding="utf-8")


def row(task: str, way: str, spent: dict[str, float]) -> str:
    whole = sum(spent.values())
    cells = " | ".join(f"{spent[part]:.2f} s" for part in PARTS)
    return f"| {task} | {way} | {cells} | {1 - spent['engine'] / whole:.1%} |"


if __name__ == "__main__":
    main()
