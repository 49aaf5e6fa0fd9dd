"""What a motion library is worth: a robot that fell in any way, and gets up or does not.

    python benchmarks/library.py run --robots go1 hyq2max --starts 300 --check 1000
    python benchmarks/library.py write          # docs/falls.md, from benchmarks/falls.md.in and the results

A library of seed 0 is built and checked on falls of seed 1. A row is written as soon as it is there, to results/library.jsonl.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from levade.library import Library, Method, Record, Share, build, check_library
from levade.tasks import load_task

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "library.jsonl"
TEMPLATE = HERE / "falls.md.in"
PAGE = HERE.parent / "docs" / "falls.md"
PARTS = (0, 10, 30, 100, 300)
"""Falls are told in parts that begin here: later ones should cost less."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    running = commands.add_parser("run")
    running.add_argument("--task", default="self-righting")
    running.add_argument("--robots", nargs="+", default=["go1", "hyq2max"])
    running.add_argument("--starts", type=int, default=300)
    running.add_argument("--check", type=int, default=1000, help="unseen falls")
    running.add_argument("--threads", type=int, default=0)
    running.add_argument("--directory", type=Path, help="keep the libraries here, and go on with them")
    running.add_argument("--out", type=Path, default=RESULTS)
    commands.add_parser("write")
    options = parser.parse_args()
    if options.command == "write":
        PAGE.write_text(page(), encoding="utf-8")
        return
    for robot in options.robots:
        with tempfile.TemporaryDirectory() as folder:
            place = (options.directory or Path(folder)) / robot
            row = row_of(options.task, robot, place, options)
        with options.out.open("a") as file:
            file.write(json.dumps(row) + "\n")


def row_of(task: str, robot: str, place: Path, options: argparse.Namespace) -> dict[str, Any]:
    """A library, and what it is worth."""
    began, cpu = time.perf_counter(), time.process_time()
    library = build(
        load_task(task, robot=robot), starts=options.starts, seed=0, threads=options.threads, directory=place
    )
    row: dict[str, Any] = {"task": task, "robot": robot, "starts": options.starts}
    row |= {"seconds": time.perf_counter() - began, "cpu": time.process_time() - cpu}
    row |= facts(library)
    began = time.perf_counter()
    found = check_library(library, starts=options.check, seed=1, threads=options.threads)
    return {**row, "check": found.to_json(), "check_seconds": time.perf_counter() - began}


def facts(library: Library) -> dict[str, Any]:
    """What a row says of a library that is built."""
    records = library.records
    return {
        "methods": {str(method): sum(one.method == method for one in records) for method in Method},
        "trials": sum(one.trials for one in records),
        "trials_per_fall": trials_per_fall(records),
        "coverage": library.coverage,
        "cover": [works for _, works in library.knowledge.cover()],
        "perturbed": float(np.nanmax(library.knowledge.perturbed, axis=1).mean()),
    }


def trials_per_fall(records: tuple[Record, ...]) -> dict[str, float]:
    """First fall of a part -> mean of the trials that a fall took."""
    ends = (*PARTS[1:], len(records) + max(PARTS))
    parts = {
        first: [one.trials for one in records if first <= one.fall < end]
        for first, end in zip(PARTS, ends, strict=True)
    }
    return {str(first): float(np.mean(trials)) for first, trials in parts.items() if trials}


def rows_in(file: Path) -> list[dict[str, Any]]:
    """The latest row of each robot and size."""
    lines = file.read_text().splitlines() if file.exists() else []
    rows = [json.loads(line) for line in lines]
    return list({(row["task"], row["robot"], row["starts"]): row for row in rows}.values())


def page() -> str:
    """The text of docs/falls.md."""
    rows = rows_in(RESULTS)
    text = TEMPLATE.read_text(encoding="utf-8")
    return text.replace("{builds}", builds(rows)).replace("{checks}", checks(rows)).replace("{costs}", costs(rows))


def builds(rows: list[dict[str, Any]]) -> str:
    """Markdown: what a build took, and what came of it."""
    lines = [
        "| robot | falls | known | near | cold | none | trials | time [s] | CPU [s] | best 1, 2, 3, 5 motions |",
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|---|",
    ]
    for row in rows:
        of = row["methods"]
        counts = " | ".join(str(of[name]) for name in ("known", "near", "cold", "none"))
        cover = ", ".join(f"{row['cover'][k - 1] / row['starts']:.1%}" for k in (1, 2, 3, 5) if k <= len(row["cover"]))
        took = f"{row['trials']} | {row['seconds']:.0f} | {row['cpu']:.0f}"
        lines.append(f"| {row['robot']} | {row['starts']} | {counts} | {took} | {cover} |")
    return "\n".join(lines)


def checks(rows: list[dict[str, Any]]) -> str:
    """Markdown: how often the robot gets up from falls that the build has not seen."""
    lines = [
        "| robot | built | tried | first | one of 3 | one of 5 | twice | first, other robots | said | answer [ms] |",
        "|---|--:|--:|---|---|---|---|---|--:|---|",
    ]
    for row in rows:
        found = row["check"]
        nominal, after = found["nominal"], found["nominal"]["after"]
        told = (nominal["first"], after["3"], after["5"], nominal["twice"], found["perturbed"]["first"])
        shares = " | ".join(str(Share(one["successes"], one["runs"])) for one in told)
        ms = found["answer_ms"]
        lines.append(
            f"| {row['robot']} | {row['starts']} | {found['starts']} | {shares} | {found['expected']:.1%} |"
            f" {ms['median']:.2f}, {ms['p99']:.2f} |"
        )
    return "\n".join(lines)


def costs(rows: list[dict[str, Any]]) -> str:
    """Markdown: mean trials of a fall, by when it was done."""
    parts = [first for first in PARTS if any(str(first) in row["trials_per_fall"] for row in rows)]
    lines = [f"| robot | falls from {' | '.join(map(str, parts))} |", f"|---|{'--:|' * len(parts)}"]
    for row in rows:
        each = row["trials_per_fall"]
        numbers = [f"{each[str(first)]:.0f}" if str(first) in each else "" for first in parts]
        lines.append(f"| {row['robot']} | {' | '.join(numbers)} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
