"""The numbers in the README, from the results of the other scripts.

python benchmarks/readme.py            # prints the four lines
python benchmarks/readme.py --write    # writes them into README.md, between its two comments

Run it after `cases.py`, `hardware.py`, `library.py` or `skills.py` have new results; a test compares.
"""

from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path
from statistics import median
from typing import Any

from skills import ROBOTS

HERE = Path(__file__).resolve().parent
README = HERE.parent / "README.md"
BEGIN, END = "<!-- numbers: benchmarks/readme.py -->\n", "<!-- end of numbers -->\n"
PAPER = 3009
"""Trials of the paper's rearing."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write the lines into README.md")
    if parser.parse_args().write:
        README.write_text(with_numbers(README.read_text(encoding="utf-8")), encoding="utf-8")
    else:
        print(lines(), end="")


def with_numbers(text: str) -> str:
    """The README's text with the numbers of today's results."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}{lines()}{END}{after}"


def lines() -> str:
    """The four lines."""
    return "".join(f"- {line}\n" for line in (trials(), hardware(), library(), robots()))


def trials() -> str:
    with (HERE / "results" / "cases.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["task"] == "rearing" and row["optimizer"] == "levade"]
    found = [int(row["trials_to_success"]) for row in rows if row["success"] == "1"]
    return (
        f"**Few trials.** {len(found)} of {len(rows)} seeds solve the paper's rearing, after {median(found):.0f} simulated "
        f"motions (median); the paper needs {PAPER} ([benchmarks](docs/benchmarks.md))."
    )


def hardware() -> str:
    chosen = {
        row["arm"]: row for row in rows_of("hardware") if (row["task"], row["robot"]) == ("posture-recovery", "hyq2max")
    }
    nominal, found = chosen["nominal"], chosen["hardware"]
    return (
        f"**Motions for hardware.** A posture recovery found on the model alone works on {nominal['share']:.0%} of 500 robots "
        f"that differ from it. With `--hardware` it works on {found['share']:.1%}, within every limit, after "
        f"{found['seconds']:.0f} s on two cores ([hardware](docs/hardware-results.md))."
    )


def library() -> str:
    rows = [row for row in rows_of("library") if row["task"] == "self-righting" and row.get("folds")]
    checks = {row["robot"]: row["check"] for row in rows}  # the latest of each robot
    go1, others = checks["go1"], (checks["go2"], checks["hyq2max"])
    return (
        f"**Any fall.** The first answer of a library of motions gets Go1 up from {up_from(go1)} of {go1['starts']} falls that "
        f"it has never seen, and from {up_from(go1, 'perturbed')} if the robot differs from its model; Go2 from "
        f"{' and '.join(up_from(others[0], kind) for kind in ('nominal', 'perturbed'))}, and HyQ2Max from "
        f"{' and '.join(up_from(others[1], kind) for kind in ('nominal', 'perturbed'))}. It says which "
        f"motion to play in {go1['answer_ms']['median']:.1f} ms, without a simulator ([falls](docs/falls.md))."
    )


def up_from(check: dict, kind: str = "nominal") -> str:
    """The share of first answers that work, in words."""
    share = check[kind]["first"]["share"]
    return "all" if share == 1 else f"{share:.1%}"


def robots() -> str:
    found = [row for row in rows_of("skills") if row["task"].startswith("self-righting")]
    per_robot = {robot: [row for row in found if row["robot"] == robot] for robot in ROBOTS}
    able = {name: rows for name, rows in per_robot.items() if all(row["success"] for row in rows)}
    medians = sorted(median(row["trials_to_success"] for row in rows) for rows in able.values())
    humanoid = [row for row in found if row["robot"] == "g1"]
    up = [row["trials_to_success"] for row in humanoid if row["success"]]
    return (
        f"**Your robot.** The same `self-righting` works for every seed on {len(able)} of {len(per_robot)} quadrupeds, after "
        f"{medians[0]:.0f} to {medians[-1]:.0f} trials (medians). It gets the humanoid G1 up from its back and its front for "
        f"{len(up)} of {len(humanoid)} seeds, after {median(up):.0f} trials (median). Its settings for two legs are from "
        "other seeds ([robots](docs/robots.md))."
    )


def rows_of(name: str) -> list[dict[str, Any]]:
    text = (HERE / "results" / f"{name}.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


if __name__ == "__main__":
    main()
