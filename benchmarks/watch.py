"""What `levade solve --watch` costs the solve: nobody looking, and a page that is open, against no page at all.

    python benchmarks/watch.py [--task rearing] [--trials 680] [--repeats 7]

Each run searches with the same seed, so that all of them simulate the same trials; a page that is open is another process
that takes in all that the server tells it, as fast as a browser does (drawing is the browser's own business). Runs are
interleaved and ratios are medians of neighbours', because the machine is shared: by the clock, and by processor time of the
solving process, all of its threads, which other processes disturb less.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path

from levade.search import Objective, make_objective, solve
from levade.tasks import load_task
from levade.viewer.pages import watch_page
from levade.viewer.scenes import LiveScenes
from levade.viewer.server import Server
from levade.viewer.watching import Watch

LISTENER = """
import sys, urllib.request
url, token = sys.argv[1:]
urllib.request.urlopen(url).read()
size = scenes = 0
for line in urllib.request.urlopen(f"{url}events?token={token}"):
    size, scenes = size + len(line), scenes + (b'"scene"' in line)
    print("open", flush=True) if size == len(line) else None
print(size, scenes)
"""


def run(objective: Objective, kind: str) -> tuple[float, float, str]:
    """Seconds by the clock, and of the processor, for a whole search; and what the page was told."""
    if kind == "no page":
        return *timed(objective, None), ""
    watch = Watch(objective, seed=0, directory=Path("none"), draw=LiveScenes(objective))
    page = watch_page(objective.task.name)
    with Server(lambda: page, events=watch.events, command=watch.command) as server:
        if kind == "closed":
            return *timed(objective, watch), ""
        listener = subprocess.Popen(
            [sys.executable, "-c", LISTENER, server.url, server.token], stdout=subprocess.PIPE, text=True
        )
        assert listener.stdout is not None
        listener.stdout.readline()
        seconds = timed(objective, watch)
        watch.finish(None)
        size, scenes = listener.communicate()[0].split()
        return *seconds, f"{int(size) / 1e6:.1f} MB, {scenes} motions"


def timed(objective: Objective, watch: Watch | None) -> tuple[float, float]:
    began, work = time.perf_counter(), time.process_time()
    solve(objective, observe=watch and watch.observe, steer=watch and watch.steer)
    return time.perf_counter() - began, time.process_time() - work


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--task", default="rearing")
    parser.add_argument("--trials", type=int, default=680)
    parser.add_argument("--repeats", type=int, default=7)
    arguments = parser.parse_args()

    changes = [f"search.trials={arguments.trials}", "search.polish=null"]
    objective = make_objective(load_task(arguments.task, changes=changes))
    kinds = ("no page", "closed", "open")
    run(objective, "no page")  # warm
    clock: dict[str, list[float]] = {kind: [] for kind in kinds}
    work: dict[str, list[float]] = {kind: [] for kind in kinds}
    told = ""
    for repeat in range(arguments.repeats):
        for kind in kinds if repeat % 2 else kinds[::-1]:
            seconds, processor, note = run(objective, kind)
            clock[kind].append(seconds)
            work[kind].append(processor)
            told = note or told
    print(
        f"{arguments.task}: {arguments.trials} trials, {arguments.repeats} interleaved runs; the page was told {told}"
    )
    for kind in kinds:
        line = f"{kind:8} {statistics.median(clock[kind]):6.2f} s, processor {statistics.median(work[kind]):6.2f} s"
        if kind != "no page":
            for name, times in (("clock", clock), ("processor", work)):
                ratios = [one / none for one, none in zip(times[kind], times["no page"], strict=True)]
                line += f"; by the {name} {statistics.median(ratios) - 1:+.1%}"
        print(line)


if __name__ == "__main__":
    main()
