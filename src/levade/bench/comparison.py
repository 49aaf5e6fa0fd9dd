"""Run a plan in a directory that keeps each result as soon as it exists.

DIR/bench.yaml       the plan
DIR/results.csv      a row per run; in the plan's order once all are done
DIR/results.parquet  the same, with types
DIR/table.md         the summary
DIR/trials.pdf, steps.pdf  success over effort, expected running time, final cost

A second call continues with the cases that have no row yet.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from levade.bench.case import made_with
from levade.bench.figure import draw
from levade.bench.measures import summarise
from levade.bench.plan import Case, Plan, cases, plan_to_yaml, read_plan
from levade.bench.pool import run_cases
from levade.bench.results import Result, append, read, write, write_parquet
from levade.bench.table import markdown
from levade.errors import LevadeError, Remedy
from levade.locking import locked
from levade.writing import write_text

PLAN, RESULTS, PARQUET, TABLE = "bench.yaml", "results.csv", "results.parquet", "table.md"


@dataclass(frozen=True)
class Progress:
    """Reports how far a bench has come.

    Attributes:
        result: The latest result. None before the first.
    """

    done: int
    total: int
    result: Result | None


@dataclass(frozen=True)
class Bench:
    """Holds the results of a bench, those of the plan first and in its order, and the number of cases that are left."""

    results: list[Result]
    left: int


def bench(
    plan: Plan | None,
    directory: Path,
    *,
    processes: int = 1,
    force: bool = False,
    others: Sequence[Result] = (),
    observe: Callable[[Progress], object] | None = None,
) -> Bench:
    """Run the cases of a plan that have no result in the directory yet.

    Args:
        plan: What to run. None continues the directory's own plan.
        directory: Directory of the results. It is created if it does not exist.
        processes: Number of cases at a time, each on one thread. Results do not depend on it.
        force: Whether to begin again and lose the results in the directory.
        others: Results that will be reported next to these.
        observe: Called before the first case, after each, and about once a second in between. A KeyboardInterrupt from it or
            from the keyboard ends the bench, and finished runs are kept.

    Returns:
        The results, and how many cases are left.

    Raises:
        LevadeError: Before anything is written, if a case does not fit together, if results in the directory belong to other
            tasks, budgets or versions under the same names, or if one of ``others`` has the name of a case.
    """
    plan = plan or plan_of(directory)
    wanted = cases(plan)
    with ExitStack() as stack:
        if not directory.exists():
            _check_others(others, wanted, [])
        _begin(directory, stack)
        return _bench(plan, wanted, directory, processes=processes, force=force, others=others, observe=observe)


def _bench(
    plan: Plan,
    wanted: Sequence[Case],
    directory: Path,
    *,
    processes: int,
    force: bool,
    others: Sequence[Result],
    observe: Callable[[Progress], object] | None,
) -> Bench:
    """Run cases in a directory whose lock is held."""
    path = directory / RESULTS
    before = [] if force or not path.exists() else read(path)
    _check_same(path, before, wanted)
    _check_others(others, wanted, before)
    try:
        write_text(directory / PLAN, plan_to_yaml(plan))
    except OSError as error:
        raise LevadeError(f"{directory}: cannot be written ({error.strerror}); give a directory that can") from None
    write(path, before)  # without what was cut off
    done = {result.key for result in before}
    total = len(wanted)
    left = [case for case in wanted if case.key not in done]
    latest: Result | None = None

    def tell() -> None:
        if observe is not None:
            observe(Progress(total - len(left), total, latest))

    try:
        tell()
        for case, result in run_cases(tuple(left), processes=processes, waiting=tell):
            append(path, result)
            latest = result
            left.remove(case)
            tell()
    except KeyboardInterrupt:
        pass
    ordered = in_order(read(path), wanted)  # the file knows best: an interrupt may come between any two lines above
    write(path, ordered)
    return Bench(ordered, total - len({case.key for case in wanted} & {result.key for result in ordered}))


def plan_of(directory: Path) -> Plan:
    """Read the plan with which a directory was last used.

    Args:
        directory: Directory of a bench.

    Returns:
        The plan.

    Raises:
        LevadeError: If there is none.
    """
    if not (directory / PLAN).is_file():
        raise LevadeError(
            f"{directory}: no bench to go on with",
            remedies=(Remedy("name tasks", "name tasks"), Remedy("give a plan", "give a plan")),
        )
    return read_plan(directory / PLAN)


def report(results: Sequence[Result], directory: Path, *, format: str = "pdf") -> tuple[list[Path], list[str]]:
    """Write the table, the figures and the Parquet file.

    Args:
        results: Results of runs.
        directory: Directory to write.
        format: Format of the figures: pdf, svg or png.

    Returns:
        The files that were written, and a sentence for each that needs a missing extra.

    Raises:
        LevadeError: If a file cannot be written.
    """
    table = directory / TABLE
    try:
        write_text(table, markdown(summarise(results)))
    except OSError as error:
        raise LevadeError(f"{table}: cannot be written ({error.strerror})") from None
    written, missing = [table], list[str]()
    if importlib.util.find_spec("matplotlib") is None:
        missing.append("figures need matplotlib; pip install 'levade[bench]'")
    else:
        written += draw(results, directory, format=format)
    if importlib.util.find_spec("pyarrow") is None:
        missing.append(f"{PARQUET} needs pyarrow; pip install 'levade[bench]'")
    else:
        write_parquet(directory / PARQUET, results)
        written.append(directory / PARQUET)
    return written, missing


def in_order(results: Iterable[Result], wanted: Sequence[Case]) -> list[Result]:
    """Sort results: those of the given cases first, in their order, then the others by name.

    Args:
        results: Results to sort.
        wanted: Cases that come first, in their order.

    Returns:
        The sorted results.
    """
    place = {case.key: number for number, case in enumerate(wanted)}
    return sorted(results, key=lambda result: (place.get(result.key, len(place)), result.key))


def _begin(directory: Path, stack: ExitStack) -> None:
    """Make a directory and take its lock."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        stack.enter_context(locked(directory, "bench"))
    except OSError as error:
        raise LevadeError(f"{directory}: cannot be written ({error.strerror}); give a directory that can") from None


def _check_others(others: Sequence[Result], wanted: Sequence[Case], before: Sequence[Result]) -> None:
    """Raise LevadeError if a result that is reported next to these has the name of one of them."""
    keys = {case.key for case in wanted} | {result.key for result in before}
    for other in others:
        if other.key in keys:
            task, robot, optimizer, seed = other.key
            raise LevadeError(
                f"{task} on {robot}, {optimizer}, seed {seed}: is in this bench and in what is added to it"
            )
        keys.add(other.key)


_ANEW = (Remedy("write elsewhere", "elsewhere"), Remedy("begin again", "replace"))


def _check_same(path: Path, results: Iterable[Result], wanted: Iterable[Case]) -> None:
    by_key = {result.key: result for result in results}
    for case in wanted:
        result = by_key.get(case.key)
        if result is None:
            continue
        if result.checksum != case.checksum or result.until != case.until:
            raise LevadeError(f"{path}: has {case} with another task, budget or end", remedies=_ANEW)
        if result.versions != made_with():
            raise LevadeError(f"{path}: was made with {result.versions}, this is {made_with()}", remedies=_ANEW)
