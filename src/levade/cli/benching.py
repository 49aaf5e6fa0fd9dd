"""``levade bench``: run a comparison, show its progress, and print its results."""

from __future__ import annotations

import dataclasses
import json
import math
import os
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Table
from rich.text import Text

from levade.bench import Plan, Progress, Summary, bench, plan_of, read, read_plan, report, summarise
from levade.bench.table import SHORT_HEADINGS, by_case, legend, rows
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console
from levade.document import parse_yaml
from levade.errors import LevadeError
from levade.report.figures import FORMATS

_PLAIN_EVERY = 30.0
"""Time between lines in a pipe [s]."""


def bench_and_report(
    *,
    file: Path | None,
    options: dict[str, Any],
    changes: Sequence[str],
    add: Sequence[Path],
    directory: Path,
    processes: int,
    force: bool,
    format: str,
    as_json: bool,
) -> int:
    """Run a comparison and print its results.

    Args:
        file: File of the plan. None takes the plan of the directory, or one from the options.
        options: Field of `Plan` -> value. None where the option was not given.
        changes: Changes of every task, as ``path=value``.
        add: Other results.csv files to report as well.
        directory: Directory to write, or to continue in.
        processes: Runs at a time (0: one per core).
        force: Whether to begin again, without the results in the directory.
        format: Format of the figures: "pdf", "svg" or "png".
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if every case has been run, else 1.

    Raises:
        LevadeError: If an option, a file or a directory is not usable.
    """
    console = make_console(stderr=as_json)
    if format not in FORMATS:
        raise LevadeError(f"--format {format}: should be one of {', '.join(FORMATS)}")
    plan = _plan(file, directory, {name: value for name, value in options.items() if value is not None}, changes)
    others = [result for path in add for result in read(path)]
    with stop_between() as asked, _Display(console, quiet=as_json and not console.is_terminal) as display:

        def watch(progress: Progress) -> None:
            display.update(progress)
            if asked():
                raise KeyboardInterrupt

        done = bench(plan, directory, processes=processes or _cores(), force=force, others=others, observe=watch)
    results = [*done.results, *others]
    written, missing = report(results, directory, format=format)
    written.insert(0, directory / "results.csv")
    summaries = summarise(results)
    if as_json:
        content = {
            "left": done.left,
            "cases": [_plain(summary) for summary in summaries],
            "written": [str(path) for path in written],
        }
        print(json.dumps(content, ensure_ascii=False))
    else:
        for part in tables(summaries):
            console.print(part, soft_wrap=isinstance(part, Table))  # only the text below wraps, at words
        console.print(f"Written: {escape(str(directory))}/{', '.join(path.name for path in written)}")
        for reason in missing:
            console.print(f"[yellow]Left out[/]: {escape(reason)}")
        if done.left:
            console.print(
                f"[yellow]Interrupted[/], {done.left} runs left. To go on: levade bench --out {escape(str(directory))}"
            )
    return 1 if done.left else 0


def tables(summaries: Sequence[Summary]) -> Iterator[Table | Text]:
    """Make a table for each task and robot, and a legend of the columns.

    Args:
        summaries: Results of all cases.
    """
    for (task, robot), mine in by_case(summaries).items():
        table = Table(
            title=Text(f"{task} on {robot}", style="bold"), title_justify="left", box=None, padding=(0, 1, 0, 0)
        )
        for heading in SHORT_HEADINGS:
            table.add_column(Text(heading), justify="left" if heading == SHORT_HEADINGS[0] else "right", no_wrap=True)
        for summary, cells in zip(mine, rows(mine, short=True), strict=True):
            whole = summary.successes == summary.runs
            style = "green" if whole else "yellow" if summary.successes else "red"
            table.add_row(Text(cells[0]), Text(cells[1], style=style), *cells[2:])
        yield table
        yield Text()
    if summaries:
        yield Text(legend(summaries, short=True), style="dim")


def _plan(file: Path | None, directory: Path, options: dict[str, Any], changes: Sequence[str]) -> Plan:
    """Return the plan of the file, or else of the directory, with the changes of the options."""
    changed = {}
    for change in changes:
        path, equals, value = change.partition("=")
        if not equals:
            raise LevadeError(f"--set {change}: should be path=value, such as horizon=0.4")
        changed[path] = parse_yaml(value, where=f"--set {path}")
    if file is None and "tasks" in options:
        return Plan(**options, changes=changed)
    plan = plan_of(directory) if file is None else read_plan(file)
    return dataclasses.replace(plan, **options, changes={**plan.changes, **changed})


def _cores() -> int:
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


def _plain(summary: Summary) -> dict[str, Any]:
    """Return the summary for JSON, with null for infinite numbers."""

    def known(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: known(item) for name, item in value.items()}
        if isinstance(value, (list, tuple)):
            return [known(item) for item in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    content = known(dataclasses.asdict(summary))
    content["trials_to_success"] = {name: content.pop(name) for name in ("median", "least", "most")}
    content["cost"] = dict(zip(("lower_quartile", "median", "upper_quartile"), content["cost"], strict=True))
    return content


class _Display:
    """Shows the progress. It is drawn after an event, at most twice a second, since the cores are for the runs."""

    def __init__(self, console: Console, *, quiet: bool) -> None:
        live = console.is_terminal and not quiet
        columns = (TextColumn("runs"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TimeRemainingColumn())
        self._bar = Bar(*columns, console=console, auto_refresh=False, transient=True) if live else None
        self._task = None if self._bar is None else self._bar.add_task("", total=None)
        self._console, self._quiet = console, quiet
        self._told: float | None = None

    def __enter__(self) -> _Display:
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(self, *error: object) -> None:
        if self._bar is not None:
            self._bar.stop()

    def update(self, progress: Progress) -> None:
        now = time.monotonic()
        if self._quiet or (self._told is not None and now - self._told < (0.5 if self._bar else _PLAIN_EVERY)):
            return
        self._told = now
        if self._bar is None:
            self._console.print(f"{progress.done} of {progress.total} runs")
        elif self._task is not None:
            self._bar.update(self._task, completed=progress.done, total=progress.total, refresh=True)
