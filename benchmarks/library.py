"""What a motion library is worth: a robot that fell in any way, and gets up or does not.

    python benchmarks/library.py run --robots go1 hyq2max --starts 300 --check 1000
    python benchmarks/library.py answers        # time of an answer, in a fresh process that has numpy alone
    python benchmarks/library.py scaling --note busy   # one process, two, and a plan for many nodes
    python benchmarks/library.py learn DIR ...  # kinds of learned answers, on libraries that are built
    python benchmarks/library.py write          # docs/falls.md, from benchmarks/falls.md.in and the results

A library of seed 0 is built and checked on falls of seed 3, and its export is driven from falls of seed 2
(`benchmarks/library_drive.py`). A row is written as soon as it is there, to results/library.jsonl. Tables of learned starts
are from `benchmarks/starts.py`.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import starts
from library_drive import drive
from library_figure import draw
from library_scaling import bottleneck, measured, plan_table, scaling, sent_table, tables

from levade.exports.as_csv import write_player, write_script
from levade.library import Library, Method, Record, Share, build, check_library
from levade.library.learning import learn
from levade.library.storing import read_library
from levade.tasks import load_task

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "library.jsonl"
TEMPLATE = HERE / "falls.md.in"
SCALING = HERE / "results" / "library_scaling.json"
ANSWERS = HERE / "results" / "library_answers.json"
LEARNED = HERE / "results" / "library_learned.jsonl"
PAGE = HERE.parent / "docs" / "falls.md"
DELAY = 0.004
"""[s], of what the robot is sent, and of what it senses."""

SIZES = ((30, 300), (300, 3000), (3000, 3000))
"""Motions and falls."""

ASKING = """
import json, sys, time
sys.modules["levade"] = None
import numpy as np
from ask import Model

m, n = map(int, sys.argv[1:])
draw = np.random.default_rng(0)
up = draw.standard_normal((n, 3))
up /= np.linalg.norm(up, axis=1, keepdims=True)
tried = np.full((n, m), 2.0)
model = Model(
    up, draw.standard_normal((n, 12)), tried, draw.integers(0, 3, (n, m)).astype(float),
    np.arange(m), np.arange(m)[::-1], np.arange(12), np.ones(12),
)
took = []
for one in up[:300]:
    began = time.perf_counter()
    model.ranked(one, np.zeros(12))
    took.append(1e3 * (time.perf_counter() - began))
median, p99 = np.percentile(took, [50, 99])
print(json.dumps({"median": float(median), "p99": float(p99)}))
"""
"""A process that has numpy, the exported script and nothing else; with a mirror, as it is the slower case."""

CHECK_SEED = 3
"""Of the falls that libraries are checked on: settings of falls that fold up were changed after a look at seeds 1 and 7."""

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
    running.add_argument("--drive", type=int, default=100, help="falls that the export is driven from")
    running.add_argument("--note", default="", help="what the page says of the machine: 'busy'")
    commands.add_parser("answers")
    scaled = commands.add_parser("scaling")
    scaled.add_argument("--task", default="self-righting")
    scaled.add_argument("--robot", default="go1")
    scaled.add_argument("--starts", type=int, default=24)
    scaled.add_argument(
        "--set", nargs="*", default=[], metavar="PATH=VALUE", help="change the task, such as search.trials=240"
    )
    scaled.add_argument("--note", default="quiet")
    learning = commands.add_parser("learn")
    learning.add_argument("directories", nargs="+", type=Path)
    commands.add_parser("write")
    options = parser.parse_args()
    if options.command == "write":
        PAGE.write_text(page(), encoding="utf-8")
        draw([row for row in rows_in(RESULTS) if "each" in row and row["task"] == "self-righting"], PAGE.parent)
        return
    if options.command == "answers":
        ANSWERS.write_text(json.dumps(answers()) + "\n")
        return
    if options.command == "scaling":
        per_fall = next(
            motions_per_fall(row) for row in rows_in(RESULTS) if row["robot"] == options.robot and row.get("folds")
        )
        found = scaling(options.task, options.robot, options.starts, options.set, per_fall, options.note)
        SCALING.write_text(json.dumps(found, indent=1) + "\n")
        return
    if options.command == "learn":
        for place in options.directories:
            row = learned(Library.load(place))
            with LEARNED.open("a") as file:
                file.write(json.dumps(row) + "\n")
        return
    for robot in options.robots:
        with tempfile.TemporaryDirectory() as folder:
            place = (options.directory or Path(folder)) / robot
            row = row_of(options.task, robot, place, options)
        with options.out.open("a") as file:
            file.write(json.dumps(row) + "\n")


class Spent:
    """What a build took, also if it was interrupted and went on: noted in a file beside it."""

    def __init__(self, place: Path) -> None:
        self._place = place
        before = json.loads(place.read_text()) if place.exists() else {"seconds": 0.0, "cpu": 0.0}
        self._began = time.perf_counter() - before["seconds"], time.process_time() - before["cpu"]

    def note(self) -> tuple[float, float]:
        """Wall-clock time and processor time so far [s]."""
        seconds, cpu = time.perf_counter() - self._began[0], time.process_time() - self._began[1]
        self._place.write_text(json.dumps({"seconds": seconds, "cpu": cpu}))
        return seconds, cpu


def row_of(task: str, robot: str, place: Path, options: argparse.Namespace) -> dict[str, Any]:
    """A library, and what it is worth."""
    spent = Spent(place.with_suffix(".spent.json"))
    library = build(
        load_task(task, robot=robot),
        starts=options.starts,
        seed=0,
        threads=options.threads,
        directory=place,
        observe=lambda progress: spent.note(),
    )
    seconds, cpu = spent.note()
    row: dict[str, Any] = {"task": task, "robot": robot, "starts": options.starts, "note": options.note}
    row["folds"] = library.fold is not None
    row |= {"seconds": seconds, "cpu": cpu}
    row |= facts(library)
    began = time.perf_counter()
    found = check_library(library, starts=options.check, seed=CHECK_SEED, threads=options.threads)
    row |= {"check": found.to_json(), "check_seconds": time.perf_counter() - began}
    if options.drive and library.fold is not None:
        row["driven"] = drive(library, options.drive, seed=2, delay=DELAY)
    return row


def answers() -> list[dict[str, float]]:
    """How long an answer takes at a size, median and 99th percentile [ms], each in a fresh process."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        write_player(Path(folder))
        write_script("asker.py", Path(folder) / "ask.py")
        for motions, falls in SIZES:
            done = subprocess.run(
                [sys.executable, "-c", ASKING, str(motions), str(falls)],
                cwd=folder,
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},  # more threads only wait for each other
                capture_output=True,
                text=True,
                check=True,
            )
            rows.append({"motions": motions, "falls": falls, **json.loads(done.stdout)})
    return rows


def learned(library: Library) -> dict[str, Any]:
    """How well each kind of learned answers does on falls to which it was not fitted. The library stays as it is."""
    found = learn(library)
    robot = read_library(library.directory)[0].robot.name
    sizes = {"starts": len(library.records), "motions": len(library.knowledge.motions)}
    scores = {kind: vars(score) for kind, score in found.scores.items()}
    return {"robot": robot, "folds": library.fold is not None, **sizes, "scores": scores, "chosen": found.chosen}


def facts(library: Library) -> dict[str, Any]:
    """What a row says of a library that is built."""
    records = library.records
    return {
        "methods": {str(method): sum(one.method == method for one in records) for method in Method},
        "rare": sum(one.rare for one in records),
        "trials": sum(one.trials for one in records),
        "each": [one.trials for one in records if not one.rare],
        "trials_per_fall": trials_per_fall(records),
        "coverage": library.coverage,
        "cover": [works for _, works in library.knowledge.cover()],
        "perturbed": float(np.nanmax(library.knowledge.perturbed, axis=1).mean()),
    }


def motions_per_fall(row: dict[str, Any]) -> float:
    """How many falls a search found a motion for, as a share of all, rare ones included."""
    return (row["methods"]["near"] + row["methods"]["cold"]) / sum(row["methods"].values())


def trials_per_fall(records: tuple[Record, ...]) -> dict[str, float]:
    """First fall of a part -> mean of the trials that a fall took."""
    ends = (*PARTS[1:], len(records) + max(PARTS))
    parts = {
        first: [one.trials for one in records if first <= one.fall < end]
        for first, end in zip(PARTS, ends, strict=True)
    }
    return {str(first): float(np.mean(trials)) for first, trials in parts.items() if trials}


def rows_in(file: Path) -> list[dict[str, Any]]:
    """The latest row of each robot."""
    lines = file.read_text().splitlines() if file.exists() else []
    rows = [json.loads(line) for line in lines]
    return list({(row["task"], row["robot"], row.get("folds", False)): row for row in rows}.values())


def page() -> str:
    """The text of docs/falls.md."""
    rows = rows_in(RESULTS)
    text = TEMPLATE.read_text(encoding="utf-8")
    parts = {"builds": builds, "checks": checks, "costs": costs, "drives": drives}
    for name, part in parts.items():
        text = text.replace(f"{{{name}}}", part(rows))
    before, heading, section = text.partition("\n## On many computers\n")
    text = before + heading + scaled(section)
    text = text.replace("{learners}", learners([json.loads(line) for line in LEARNED.read_text().splitlines()]))
    for name, table in starts.tables(starts.rows_in(starts.RESULTS)).items():
        text = text.replace(f"{{{name}}}", table)
    return text.replace("{answers}", times(json.loads(ANSWERS.read_text())))


def scaled(section: str) -> str:
    """The section on many computers, if there are results for it."""
    if not SCALING.exists():
        return "\n`python benchmarks/library.py scaling` measures how builds scale. It has not been run yet.\n"
    found = json.loads(SCALING.read_text())
    parts = {
        "measured": measured,
        "processes": tables,
        "sent": sent_table,
        "plan": plan_table,
        "bottleneck": bottleneck,
    }
    for name, part in parts.items():
        section = section.replace(f"{{{name}}}", part(found))
    return section


def family(row: dict[str, Any]) -> str:
    """Robot, and whether it draws its legs in first, or falls and is judged as in MuJoCo Playground."""
    if "playground" in row.get("task", ""):
        return f"{row['robot']}, by Playground's test"
    return row["robot"] + ("" if row.get("folds") else ", as it fell")


def drives(rows: list[dict[str, Any]]) -> str:
    """Markdown: how often the exported loop gets a simulated robot up."""
    lines = [
        "| robot | falls | delay [ms] | 1st attempt | 2nd | 3rd | none, or refused |",
        "|---|--:|--:|--:|--:|--:|--:|",
    ]
    for row in rows:
        if one := row.get("driven"):
            tries = [one["attempts"][k] for k in ("1", "2", "3")]
            left = one["starts"] - sum(tries)
            lines.append(
                f"| {family(row)} | {one['starts']} | {1e3 * one['delay']:g} | {tries[0]} | {tries[1]} | {tries[2]} | {left} |"
            )
    return "\n".join(lines)


def learners(rows: list[dict[str, Any]]) -> str:
    """Markdown: first answers of each kind of model, and how well its probabilities fit."""
    lines = [
        "| robot | falls | motions, with images | model | first answer | predicted | Brier score |",
        "|---|--:|--:|---|--:|--:|--:|",
    ]
    for row in rows:
        for kind, score in row["scores"].items():
            name = f"**{kind}**" if kind == row["chosen"] else kind
            numbers = f"{score['first']:.1%} | {score['said']:.1%} | {score['brier']:.4f}"
            lines.append(f"| {family(row)} | {row['starts']} | {row['motions']} | {name} | {numbers} |")
    return "\n".join(lines)


def times(rows: list[dict[str, float]]) -> str:
    """Markdown: time of an answer."""
    lines = ["| motions | falls | median [ms] | 99th percentile [ms] |", "|--:|--:|--:|--:|"]
    lines += [f"| {row['motions']} | {row['falls']} | {row['median']:.2f} | {row['p99']:.2f} |" for row in rows]
    return "\n".join(lines)


def builds(rows: list[dict[str, Any]]) -> str:
    """Markdown: what a build took, and what came of it."""
    lines = [
        "| robot | falls | rare ones | known | near | cold | none | trials | time [s] | CPU [s] | best 1, 2, 3, 5 motions |",
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|",
    ]
    for row in rows:
        of = row["methods"]
        counts = " | ".join(str(of[name]) for name in ("known", "near", "cold", "none"))
        falls = sum(of.values())
        cover = ", ".join(f"{row['cover'][k - 1] / falls:.1%}" for k in (1, 2, 3, 5) if k <= len(row["cover"]))
        took = f"{row['trials']} | {row['seconds']:.0f}{', ' * bool(row.get('note'))}{row.get('note', '')} | {row['cpu']:.0f}"
        lines.append(f"| {family(row)} | {row['starts']} | {row.get('rare', 0)} | {counts} | {took} | {cover} |")
    return "\n".join(lines)


def checks(rows: list[dict[str, Any]]) -> str:
    """Markdown: how often the robot gets up from falls that the build has not seen."""
    lines = [
        "| robot | built | tried, of seed | first | one of 3 | one of 5 | twice | first, perturbed | twice, perturbed"
        " | predicted | answer [ms] |",
        "|---|--:|--:|---|---|---|---|---|---|--:|---|",
    ]
    for row in rows:
        found = row["check"]
        nominal, after = found["nominal"], found["nominal"]["after"]
        on_others = found["perturbed"]
        told = (nominal["first"], after["3"], after["5"], nominal["twice"], on_others["first"], on_others.get("twice"))
        shares = " | ".join("" if one is None else str(Share(one["successes"], one["runs"])) for one in told)
        ms = found["answer_ms"]
        lines.append(
            f"| {family(row)} | {row['starts']} | {found['starts']} of {found['seed']} | {shares} | {found['expected']:.1%} |"
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
        lines.append(f"| {family(row)} | {' | '.join(numbers)} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
