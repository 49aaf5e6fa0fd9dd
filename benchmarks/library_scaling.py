"""How a build of a library scales: what a fall takes, what is sent for it, and what that makes on many nodes.

`python benchmarks/library.py scaling` runs it. Falls are solved piece by piece, as on a cluster, in one process and in two.
From the processor time of each, a simple model gives the time of larger builds on more nodes:

- In a round, a free node takes the next fall. The next round begins when the last fall is done.
- Falls of a larger build take what measured ones took, drawn again and again: the first `EARLY` falls as they were, later ones
  from those after them.
- One computer sends the news of a round to each node and receives the motions, over one line of `LINE` bytes per second.
- At the end, each row of the success matrix is a piece of its own. A roll-out takes what it took here. There are as many
  motions per fall as in the library of 300 falls of results/library.jsonl.
"""

from __future__ import annotations

import heapq
import pickle
import statistics
import tempfile
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from levade.bench.pool import Pool
from levade.library import Library
from levade.library.building import rounds
from levade.library.falls import Falls
from levade.library.pieces import Fall, Row, Workshop
from levade.library.records import FALLS, MOTIONS, motion_path, record_path
from levade.library.spreading import Delivery, News, Outpost, Parcel
from levade.library.storing import begin, read_library
from levade.tasks import Task, load_task

NODES = (1, 2, 10, 32, 100, 300)
SIZES = (300, 3000)
EARLY = 8
LINE = 125e6
"""A gigabit per second."""


class Timed:
    """A workshop that says what a piece takes: what it returns, processor time and wall-clock time [s]."""

    def __init__(self, directory: Path) -> None:
        self._workshop = Workshop(directory)

    def __call__(self, piece: Fall | Row) -> tuple[float, float]:
        self._workshop.learn((), {})  # builds the simulation the first time, which is not a part of the piece
        cpu, wall = time.process_time(), time.perf_counter()
        self._workshop(piece)
        return time.process_time() - cpu, time.perf_counter() - wall


def scaling(
    task: str, robot: str, starts: int, changes: list[str], motions_per_fall: float, note: str
) -> dict[str, Any]:
    """Measure a build in one process and in two, and predict larger ones."""
    with tempfile.TemporaryDirectory() as folder:
        runs = [built(load_task(task, robot=robot, changes=changes), starts, Path(folder) / str(n), n) for n in (1, 2)]
        sent = bytes_of(Path(folder) / "1", starts)
    found: dict[str, Any] = {"task": task, "robot": robot, "starts": starts, "changes": changes, "note": note}
    found |= {"processes": [{name: run[name] for name in ("processes", "trials", "seconds", "cpu")} for run in runs]}
    found |= {"sent": sent, "fall_cpu": runs[0]["falls"], "begin_cpu": runs[0]["begin"]}
    found["motions_per_fall"] = motions_per_fall
    found["rollout_cpu"] = sum(runs[0]["rows"]) / runs[0]["rollouts"]
    found["plans"] = [
        plan(found, falls, nodes, kind) for falls in SIZES for kind in ("32", "eighth", "none") for nodes in NODES
    ]
    return found


def built(task: Task, starts: int, directory: Path, processes: int) -> dict[str, Any]:
    """Build a library, piece by piece."""
    for name in (FALLS, MOTIONS):
        (directory / name).mkdir(parents=True)
    began, cpu = time.perf_counter(), time.process_time()
    falls = Falls(task, threads=1)
    begin_cpu = time.process_time() - cpu
    begin(directory, falls, 0, starts)
    took: dict[int, float] = {}
    with Pool(Timed(directory), processes) as pool:
        for first, last in rounds(starts):
            pieces = [Fall(i, tuple(range(first))) for i in range(first, last)]
            took |= {piece.number: cpu for piece, (cpu, _) in pool.each(pieces)}
            print(f"{processes} processes: {last} falls, {time.perf_counter() - began:.0f} s", flush=True)
        seconds = time.perf_counter() - began
        rows = [cpu for _, (cpu, _) in pool.each([Row(i, tuple(range(starts))) for i in range(starts)])]
    library = Library.load(directory)
    return {
        "processes": processes,
        "trials": sum(record.trials for record in library.records),
        "seconds": seconds,
        "cpu": sum(took.values()),
        "falls": [took[i] for i in range(starts)],
        "rows": rows,
        "rollouts": 2 * library.knowledge.success.size - int((~np.isnan(library.knowledge.success)).sum()),
        "begin": begin_cpu,
    }


def bytes_of(directory: Path, starts: int) -> dict[str, float]:
    """What travels, from the very objects [B]; per fall on average."""
    falls = Falls(read_library(directory)[0], threads=1)
    delivered, named = [], []
    for i in range(starts):
        paths = [path(directory, i) for path in (motion_path, record_path)]
        files = {str(path.relative_to(directory)): path for path in paths if path.is_file()}
        delivered.append(size(Delivery(None, {name: path.read_bytes() for name, path in files.items()})))
        named.append(size(Delivery(None, dict.fromkeys(files))))
    found = [i for i in range(starts) if motion_path(directory, i).is_file()]
    return {
        "once": size(Outpost(directory, "0" * 32, falls.simulation.robot)),
        "news": size(News.of(directory, range(starts))) / starts,
        "news_motion": size(News.of(directory, found)) / len(found),
        "parcel": size(Parcel(Fall(starts - 1, tuple(range(starts))), ())),
        "delivery": statistics.mean(delivered),
        "delivery_motion": statistics.mean(delivered[i] for i in found),
        "delivery_shared": statistics.mean(named),
        "row": size(Delivery((np.zeros(len(found) * 2), np.zeros(len(found) * 2)), {})),
    }


def size(value: Any) -> int:
    return len(pickle.dumps(value, protocol=5))


def plan(found: dict[str, Any], falls: int, nodes: int, kind: str) -> dict[str, Any]:
    """Predict the time of a build [s].

    kind: rounds of "32" falls at most, of an "eighth" of the falls before as they are, or "none", which no build could have.
    """
    draw, took = np.random.default_rng(0), found["fall_cpu"]
    times = [*took[:EARLY], *draw.choice(took[EARLY:], falls - EARLY)]
    sent, searching, sending, longest = found["sent"], 0.0, 0.0, 0.0
    for first, last in sizes(falls, kind):
        here = times[first:last]
        searching += makespan(here, nodes)
        longest += max(here)
        # the news of the round go to each node, and each fall comes back
        sending += (last - first) * (sent["news"] * nodes + sent["delivery"]) / LINE
    motions = 2 * found["motions_per_fall"] * falls  # with their images
    row = 2 * motions * found["rollout_cpu"]
    matrix = makespan([row] * falls, nodes) + falls * 2 * 8 * motions / LINE
    start = found["begin_cpu"] + nodes * sent["once"] / LINE
    return {
        "falls": falls,
        "rounds": kind,
        "nodes": nodes,
        "searching": searching,
        "longest": longest,
        "sending": sending,
        "matrix": matrix,
        "seconds": start + searching + sending + matrix,
        "busy": sum(times) / (nodes * searching),
    }


def sizes(falls: int, kind: str) -> Iterable[tuple[int, int]]:
    if kind == "none":
        return [(0, falls)]
    if kind == "eighth":
        return rounds(falls)
    early = [(first, last) for first, last in rounds(min(falls, 32))]
    return early + [(first, min(first + 32, falls)) for first in range(32, falls, 32)]


def makespan(times: Sequence[float], nodes: int) -> float:
    """Time until the last piece is done, if a free node takes the next one."""
    free = [0.0] * nodes
    for one in times:
        heapq.heappush(free, heapq.heappop(free) + one)
    return max(free)


def measured(found: dict[str, Any]) -> str:
    """What was measured, in words."""
    changed = f" with {', '.join(f'`{one}`' for one in found['changes'])}" if found["changes"] else ""
    return f"{found['starts']} falls of `{found['task']}` on {found['robot']}{changed}"


def tables(found: dict[str, Any]) -> str:
    """Markdown."""
    lines = [
        "| processes | trials | time [s] | CPU [s] | trials per s | trials per CPU s |",
        "|--:|--:|--:|--:|--:|--:|",
    ]
    for run in found["processes"]:
        per = run["trials"] / run["seconds"], run["trials"] / run["cpu"]
        lines.append(
            f"| {run['processes']} | {run['trials']} | {run['seconds']:.0f}, {found['note']} | {run['cpu']:.0f} |"
            f" {per[0]:.1f} | {per[1]:.1f} |"
        )
    return "\n".join(lines)


def sent_table(found: dict[str, Any]) -> str:
    """Markdown: what travels."""
    sent = found["sent"]
    rows = (
        ("once to each process: robot, task, code's settings", sent["once"]),
        ("news of a fall, to each node", sent["news"]),
        ("news of a fall with a motion", sent["news_motion"]),
        ("a fall to solve", sent["parcel"]),
        ("its result, if the node shares the directory", sent["delivery_shared"]),
        ("its result, if not: on average", sent["delivery"]),
        ("its result, if not: with a motion", sent["delivery_motion"]),
    )
    lines = ["| what | kB |", "|---|--:|"]
    return "\n".join([*lines, *(f"| {what} | {bytes_ / 1e3:.1f} |" for what, bytes_ in rows)])


def plan_table(found: dict[str, Any]) -> str:
    """Markdown: predicted times."""
    lines = [
        "| falls | nodes | rounds of 32: time [s] | rounds as they are: time [s] | nodes at work | longest falls | sending |"
        " matrix | no rounds: time [s] |",
        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|",
    ]
    of = {(one["falls"], one["nodes"], one["rounds"]): one for one in found["plans"]}
    for falls in SIZES:
        for nodes in NODES:
            old, now, free = (of[falls, nodes, kind] for kind in ("32", "eighth", "none"))
            lines.append(
                f"| {falls} | {nodes} | {old['seconds']:.0f} | {now['seconds']:.0f} | {now['busy']:.0%} |"
                f" {now['longest']:.0f} | {now['sending']:.1f} | {now['matrix']:.0f} | {free['seconds']:.0f} |"
            )
    return "\n".join(lines)


def bottleneck(found: dict[str, Any]) -> str:
    """What limits a large build on 100 nodes, in words."""
    of = {(one["falls"], one["nodes"], one["rounds"]): one for one in found["plans"]}
    old, now, most = of[3000, 100, "32"], of[3000, 100, "eighth"], of[3000, 300, "eighth"]
    return (
        f"on 100 nodes, 3000 falls in rounds of 32 take {old['seconds']:.0f} s, of which the longest falls are"
        f" {old['longest']:.0f} s, and keep {old['busy']:.0%} of the nodes at work. The larger rounds take"
        f" {now['seconds']:.0f} s, of which the longest falls are {now['longest']:.0f} s, and keep {now['busy']:.0%} at work."
        f" Three times as many nodes would still need {most['seconds']:.0f} s. Sending takes {now['sending']:.1f} s."
    )
