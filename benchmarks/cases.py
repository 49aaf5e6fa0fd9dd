"""levade's default search, the paper's plain CMA-ES and other libraries on seven cases, and docs/benchmarks.md with what came.

    python benchmarks/cases.py --methods levade cma --seeds 20 --processes 2
    python benchmarks/cases.py --methods peers --seeds 5          # environments are made where they are missing
    python benchmarks/cases.py --cases rearing --methods levade --seeds 20 --anew    # the search has changed: run again
    python benchmarks/cases.py --wall 5                           # wall times of `levade solve`, on a quiet machine
    python benchmarks/cases.py --write                            # only write the page, from what is there

Runs are made by `levade bench` and by benchmarks/peers/run.py, in build/cases; rows are kept in results/cases.csv, and those
that are there are not run again. Every run has at most 3000 trials, and ends with its success (`levade` polishes as its
task says), but for Go1 upside down, where final costs are compared and everyone spends the whole budget.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image

from levade.bench import Plan, Progress, Result, Summary, bench, read, summarise
from levade.bench.figure import draw
from levade.bench.plan import Until
from levade.bench.results import write
from levade.bench.table import HEADINGS, legend, number
from levade.bench.table import rows as cells
from levade.document import parse_yaml
from levade.tasks import task_text

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parent
WORK = REPOSITORY / "build" / "cases"
RESULTS = HERE / "results" / "cases.csv"
WALL = HERE / "results" / "wall.json"
OVERHEAD = HERE / "results" / "overhead.md"
PAGE = REPOSITORY / "docs" / "benchmarks.md"
FIGURES = REPOSITORY / "docs" / "figures"
BUDGET, SEEDS = 3000, 20


@dataclass(frozen=True)
class Case:
    """task: name or file. median: trials to success that levade should need. wall: [s], of a whole solve on two cores.

    cheapest: whether its final cost has to be below the best of every peer. step: of plain CMA-ES [rad], 0.05 in the paper.
    ours: what levade's method is on this case, where it is not what the task says.
    """

    task: str
    title: str
    median: int
    wall: float | None = None
    cheapest: bool = False
    step: float = 0.3
    ours: Mapping[str, object] = field(default_factory=dict)

    @property
    def until(self) -> Until:
        return "budget" if self.cheapest else "success"


def righting() -> dict[str, object]:
    """Policy and search of the built-in self-righting, of which Go1's task knows nothing."""
    task = parse_yaml(task_text("self-righting"), where="self-righting")
    own = {"trials", "polish"}
    return {
        f"{part}.{key}": value for part in ("policy", "search") for key, value in task[part].items() if key not in own
    }


CASES = {
    "rearing": Case("rearing", "Rearing, 0.3 s", 300, wall=2.0, step=0.05),
    "posture-recovery": Case("posture-recovery", "Posture recovery, 0.3 s", 300, wall=4.0, step=0.05),
    "rearing-slow": Case("rearing-slow", "Rearing, 3 s", 400, step=0.05),
    "posture-recovery-slow": Case("posture-recovery-slow", "Posture recovery, 3 s", 400, step=0.05),
    "go1-upside-down": Case(
        str(HERE / "tasks" / "go1-upside-down.yaml"),
        "Go1, upside down to standing",
        200,
        cheapest=True,
        ours=righting(),
    ),
    "self-righting": Case("self-righting", "HyQ2Max, self-righting", 600),
    "squat-jump": Case("squat-jump", "HyQ2Max, squat jump", 400),
}
"""By the name of the task."""

OURS = ("levade", "cma")
PEERS = ("plain", "judo-ps", "judo-mppi", "judo-cem", "nevergrad", "nevergrad-de", "fcmaes")
METHODS = (*OURS, *PEERS)


def changes(method: str, case: Case) -> dict[str, object]:
    """What a method of levade's changes in the task: the task as it is, or the paper's settings (see paper.py)."""
    if method == "levade":
        return {"search.trials": BUDGET, **case.ours}
    return {
        "search.optimizer": "cma",
        "search.population": None,
        "search.smoothness": 0,
        "search.modes": None,
        "search.step": case.step,
        "search.step_adaptation": "csa",
        "search.restart": None,
        "search.polish": 0,
        "stages": [{"name": "full"}],
    }


def run_ours(name: str, methods: Sequence[str], seeds: int, processes: int) -> None:
    def tell(progress: Progress) -> None:
        if (result := progress.result) is not None and result not in told:
            told.append(result)
            print(f"{progress.done}/{progress.total}", *result.key, result.trials_to_success, result.cost, flush=True)

    case, told = CASES[name], list[Result]()
    plan = Plan(
        tasks=(case.task,),
        optimizers={method: changes(method, case) for method in methods},
        seeds=seeds,
        trials=BUDGET,
        until=case.until,
    )
    bench(plan, WORK / "ours", processes=processes, observe=tell)


def run_peers(name: str, methods: Sequence[str], seeds: int, arguments: argparse.Namespace) -> None:
    case = CASES[name]
    command = [sys.executable, str(HERE / "peers" / "run.py"), case.task, "--peers", *methods, "--seeds", str(seeds)]
    command += ["--trials", str(BUDGET), "--until", case.until, "--processes", str(arguments.processes)]
    command += ["--out", str(WORK / "peers")]
    if arguments.environments is not None:
        command += ["--environments", str(arguments.environments)]
    subprocess.run(command, check=True)


def spread() -> None:
    """Rows that are kept, and not in the directories of this machine yet, go there."""
    kept = read(RESULTS) if RESULTS.exists() else []
    for directory, methods in (("ours", OURS), ("peers", PEERS)):
        path = WORK / directory / "results.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        rows = {row.key: row for row in kept if row.optimizer in methods}
        rows |= {row.key: row for row in (read(path) if path.exists() else [])}
        write(path, rows.values())


def drop(cases: Sequence[str], methods: Sequence[str]) -> None:
    """Forget the rows of some cases and methods."""
    for path in (RESULTS, WORK / "ours" / "results.csv", WORK / "peers" / "results.csv"):
        if path.exists():
            write(path, [row for row in read(path) if row.task not in cases or row.optimizer not in methods])


def gather() -> None:
    """Keep what the directories of this machine have, in order."""
    rows = [row for directory in ("ours", "peers") for row in read(WORK / directory / "results.csv")]
    rows = [row for row in rows if row.task in CASES and row.optimizer in METHODS]
    rows.sort(key=lambda row: (list(CASES).index(row.task), METHODS.index(row.optimizer), row.seed))
    RESULTS.parent.mkdir(exist_ok=True)
    write(RESULTS, rows)


def measure_wall(names: Iterable[str], seeds: int) -> None:
    """Wall times of `levade solve`, all of the process's own report, by seed."""
    content = json.loads(WALL.read_text(encoding="utf-8")) if WALL.exists() else {}
    for name in names:
        found = []
        for seed in range(seeds):
            with tempfile.TemporaryDirectory() as out:
                command = [sys.executable, "-m", "levade", "solve", CASES[name].task, "--seed", str(seed), "--json"]
                done = subprocess.run([*command, "--out", out, "--force"], stdout=subprocess.PIPE, check=False)
            said = json.loads(done.stdout)
            found.append({key: said[key] for key in ("seed", "success", "trials", "wall_s")})
            print(name, found[-1], flush=True)
        content[name] = {"cores": os.cpu_count(), "machine": machine(), "runs": found}
    WALL.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def machine() -> str:
    return f"{platform.machine()}, {platform.system()}, Python {platform.python_version()}"


def page(rows: Sequence[Result], wall: dict[str, Any]) -> str:
    """The text of docs/benchmarks.md. rows: of `levade.bench.Result`. wall: as `measure_wall` writes it."""
    order = {method: place for place, method in enumerate(METHODS)}
    results = sorted(rows, key=lambda row: (list(CASES).index(row.task), order[row.optimizer], row.seed))
    summaries = summarise(results)
    parts, overview = [], []
    for name, case in CASES.items():
        mine = [summary for summary in summaries if summary.task == name]
        parts.append(f"## {case.title}\n")
        if not mine:
            parts.append(f"No runs yet. Goal: {SEEDS} of {SEEDS}, median at most {case.median} trials.\n")
            continue
        by_name = {summary.optimizer: summary for summary in mine}
        verdicts = verdict(case, by_name, [row for row in results if row.task == name], wall.get(name))
        parts.append(" ".join(verdicts) + "\n")
        parts.append(f"| {' | '.join(('method', *HEADINGS[1:]))} |\n|{'---|' * len(HEADINGS)}")
        parts[-1] += "".join(f"\n| `{row[0]}` | {' | '.join(row[1:])} |" for row in cells(mine)) + "\n"
        parts.append(f"![Success over trials, expected running time and final cost: {case.title}]({figure_of(name)})\n")
        peers = [s for method, s in by_name.items() if method in PEERS]
        overview.append(
            f"| [{case.title}](#{anchor(case.title)}) | {short(by_name.get('levade'))} | 20/20, {case.median} |"
            f" {short(by_name.get('cma'))} | {best_of(peers)} |"
        )
    made = sorted({row.versions for row in results if row.optimizer in OURS})
    counts = {
        method: sorted({len([r for r in results if (r.task, r.optimizer) == (case, method)]) for case in CASES} - {0})
        for method in METHODS
    }
    seeds = ", ".join(f"`{m}` {' to '.join(map(str, sorted({n[0], n[-1]})))}" for m, n in counts.items() if n)
    text = (HERE / "benchmarks.md.in").read_text(encoding="utf-8")
    for key, value in {
        "@OVERVIEW@": "\n".join(overview),
        "@CASES@": "\n".join(parts),
        "@LEGEND@": legend(summaries) if summaries else "",
        "@SEEDS@": seeds or "none yet",
        "@OVERHEAD@": OVERHEAD.read_text(encoding="utf-8").rstrip() if OVERHEAD.exists() else "Not measured yet.",
        "@BUDGET@": number(BUDGET),
        "@MADE@": f"{'; '.join(made) or 'no runs of levade yet'}; {machine()}",
    }.items():
        text = text.replace(key, value)
    return text


def verdict(
    case: Case, summaries: dict[str, Summary], runs: Sequence[Result], wall: dict[str, Any] | None
) -> list[str]:
    """State the goal of a case, and by how much it is missed, in sentences."""
    asked = f"Goal: {SEEDS} of {SEEDS}, median at most {case.median} trials"
    asked += "" if case.wall is None else f", at most {case.wall:g} s on two quiet cores"
    asked += ", and a final cost below every peer's best run." if case.cheapest else "."
    ours = summaries.get("levade")
    if ours is None:
        return [asked, "`levade` has not been run yet."]
    said = [asked]
    failed = ours.runs - ours.successes
    said.append(f"**Success: {ours.successes} of {ours.runs}**{f', {failed} missed' if failed else ', goal met'}.")
    median = ours.median
    if median <= case.median:
        said.append(f"**Median {number(median)}**, goal met.")
    elif math.isinf(median):
        said.append("**No median**: fewer than half succeeded.")
    else:
        said.append(
            f"**Median {number(median)}**: missed by {number(median - case.median)} ({median / case.median:.1f} times)."
        )
    if case.cheapest:
        peers = [row for row in runs if row.optimizer in PEERS]
        if peers:
            said.append(_cheapest(ours, min(peers, key=lambda row: row.cost)))
    if wall is not None and case.wall is not None:
        seconds = statistics.median(run["wall_s"] for run in wall["runs"])
        missed = "goal met" if seconds <= case.wall else f"missed by {seconds - case.wall:.1f} s"
        said.append(
            f"Wall time, median of {len(wall['runs'])} runs on {wall['cores']} cores: {seconds:.1f} s, {missed}."
        )
    return said


def _cheapest(ours: Summary, best: Result) -> str:
    median = ours.cost[1]
    below = "below" if median < best.cost else f"not below: {median / best.cost:.2f} times"
    return f"Final cost: median {number(median)}, {below} the best run of any peer ({number(best.cost)}, `{best.optimizer}`)."


def short(summary: Summary | None) -> str:
    """Success and median of a method."""
    return "" if summary is None else f"{summary.successes}/{summary.runs}, {number(summary.median)}"


def best_of(peers: Sequence[Summary]) -> str:
    """The peer with the least expected running time, or the one with the lowest cost if none succeeds."""
    if not peers:
        return ""
    best = min(peers, key=lambda s: (s.ert["trials"].value, s.cost[1]))
    return f"`{best.optimizer}` {short(best)}"


def anchor(title: str) -> str:
    kept = "".join(letter for letter in title.lower() if letter.isalnum() or letter in " -")
    return kept.replace(" ", "-")


def figure_of(name: str) -> str:
    return f"figures/benchmarks-{name}.png"


def write_page() -> None:
    rows = read(RESULTS) if RESULTS.exists() else []
    for name in CASES:
        mine = [row for row in rows if row.task == name]
        if mine:
            mine.sort(key=lambda row: (METHODS.index(row.optimizer), row.seed))
            with tempfile.TemporaryDirectory() as directory:
                draw(mine, Path(directory), format="png")
                drawn = Image.open(Path(directory) / "trials.png").convert("RGB")
                few = drawn.quantize(64, dither=Image.Dither.NONE)  # a third of the bytes
                few.save(PAGE.parent / figure_of(name), optimize=True)
    wall = json.loads(WALL.read_text(encoding="utf-8")) if WALL.exists() else {}
    PAGE.write_text(page(rows, wall), encoding="utf-8")
    print(f"written: {PAGE}, {RESULTS} ({len(rows)} runs)")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", nargs="+", default=list(CASES), choices=list(CASES), metavar="CASE")
    parser.add_argument(
        "--methods", nargs="+", default=["levade", "cma"], choices=[*METHODS, "peers"], metavar="METHOD"
    )
    parser.add_argument("--seeds", type=int, default=20, help="how many, from 0")
    parser.add_argument("--processes", type=int, default=1, help="runs at a time, each on one thread")
    parser.add_argument("--environments", type=Path, help="of the peers; where peers/run.py makes them if left out")
    parser.add_argument("--anew", action="store_true", help="forget what these methods did on these cases before")
    parser.add_argument("--wall", type=int, metavar="SEEDS", help="only measure wall times of levade solve")
    parser.add_argument("--write", action="store_true", help="only keep what is there, and write the page")
    arguments = parser.parse_args()
    methods = [m for given in arguments.methods for m in (PEERS if given == "peers" else (given,))]
    if arguments.wall:
        measure_wall([name for name in arguments.cases if CASES[name].wall is not None], arguments.wall)
    elif arguments.anew:
        drop(arguments.cases, methods)
    spread()
    try:
        for name in arguments.cases if not (arguments.write or arguments.wall) else ():
            if ours := [method for method in methods if method in OURS]:
                run_ours(name, ours, arguments.seeds, arguments.processes)
            if peers := [method for method in methods if method in PEERS]:
                run_peers(name, peers, arguments.seeds, arguments)
    finally:
        gather()
        write_page()


if __name__ == "__main__":
    main()
