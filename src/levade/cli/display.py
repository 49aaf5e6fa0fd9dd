"""Show a solve live: on a terminal the display stays in place, in a pipe it is a few plain lines."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

import numpy as np
from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.markup import escape
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from levade.cli.pace import Deadline, Pace
from levade.cli.tables import quantity_unit, signed
from levade.search import Generation
from levade.tasks import Task

_PLAIN_EVERY = 10.0
"""Time between lines in a pipe [s]."""


class Display:
    """Shows generations as they come; a context manager.

    Args:
        console: Where to print.
        task: The task of the search.
        quiet: Whether to print nothing.
        note: Tells what else there is to say, each time.
        deadline: The end of the command, of which the search is a part.
    """

    def __init__(
        self,
        console: Console,
        task: Task,
        *,
        quiet: bool,
        note: Callable[[], str] = lambda: "",
        deadline: Deadline | None = None,
    ) -> None:
        self._console, self._task, self._quiet, self._note = console, task, quiet, note
        self._deadline = deadline or Deadline(None)
        self._live: Live | None = None
        self._latest: Generation | None = None
        self._pace = Pace()
        self._told = time.perf_counter()
        self._stage: str | None = None
        if console.is_terminal and not quiet:
            self._live = Live(get_renderable=self._render, console=console, refresh_per_second=8, transient=True)

    def __enter__(self) -> Display:
        if self._live is not None:
            self._live.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        if self._live is not None:
            self._live.__exit__(None, None, None)

    def update(self, generation: Generation) -> None:
        """Take in a generation; drawing it happens elsewhere, a few times a second.

        Args:
            generation: The generation, as the search reports it.
        """
        if self._latest is None and not self._quiet:  # from here on the input is known to be right
            robot = escape(self._task.robot.name)
            budget = self._task.search.trials
            self._console.print(f"[bold]{escape(self._task.name)}[/] on {robot}: up to {budget} trials")
        self._latest = generation
        if not generation.replayed:
            self._pace.add(generation.trials)
        if self._quiet or self._live is not None:
            return
        now = time.perf_counter()
        if generation.stage_name != self._stage or now - self._told > _PLAIN_EVERY:
            self._stage, self._told = generation.stage_name, now
            self._console.print(
                f"trial {generation.trials}, {escape(_stage(generation))}:"
                f" best cost {generation.best.cost:.4g}{escape(_errors(generation.best.errors))}{self._left('; ')}"
            )

    def _render(self) -> RenderableType:
        g = self._latest
        if g is None:
            return Text("starting ...", style="dim")
        budget = self._task.search.trials
        bar = Table.grid(padding=(0, 1))
        bar.add_row(
            ProgressBar(total=budget, completed=g.trials, width=24),
            f"trial {g.trials} of {budget}   {self._pace.rate:.0f} trials/s{self._left('   ')}",
            Text(self._note(), style="yellow"),
        )
        found = Text("success", style="green") if g.best.success else Text("not yet", style="dim")
        head = Table.grid(padding=(0, 3))
        head.add_row(
            f"generation {g.generation}",
            escape(_stage(g)),
            f"best cost {g.best.cost:.4g}",
            f"step {g.step:.3g}",
            f"diverged {g.diverged}",
            found,
        )
        return Group(bar, head, _criteria(self._task, g), _terms(self._task, g))

    def _left(self, before: str) -> str:
        """Return how long the search may still take, and in all, with what separates it from the text before."""
        assert self._latest is not None
        left = self._pace.left(self._task.search.trials - self._latest.trials)
        parts = [f"at most {left} left" if left else "", self._deadline.left]
        return "".join(before + part for part in parts if part)


def _stage(g: Generation) -> str:
    """With how many motions to start from there are, where several are looked for."""
    found = f", best of {len(g.starts)} starts holds on {max(g.starts):.0%} of models" if g.starts else ""
    return f"stage {g.stage_name}{found}"


def _errors(errors: Mapping[str, float]) -> str:
    """Return what a plain line says about the criteria. Those of a hold are NaN while a stage simulates none of it."""
    known = ", ".join(f"{name} {value:+.3g}" for name, value in errors.items() if not np.isnan(value))
    unknown = int(np.isnan(list(errors.values())).sum())
    later = f"{unknown} {'criterion' if unknown == 1 else 'criteria'} not simulated yet"
    return (f"; errors: {known}" if known else "") + (f"; {later}" if unknown else "")


def _criteria(task: Task, g: Generation) -> Table:
    table = Table(box=None, padding=(0, 2), header_style="dim")
    for heading, justify in (("criterion", "left"), ("error", "right"), ("allowed", "right"), ("", "left")):
        table.add_column(heading, justify=justify)  # type: ignore[arg-type]
    for name, criterion in task.success.items():
        error = g.best.errors[name]
        met = bool(criterion.met(np.array(error))) if error == error else False
        table.add_row(
            name,
            "" if error != error else f"{signed(error)} {quantity_unit(criterion.quantity)}",
            f"{criterion.tolerance or 0:.4g} {quantity_unit(criterion.quantity)}",
            Text("ok", style="green") if met else Text("-", style="dim"),
        )
    return table


def _terms(task: Task, g: Generation) -> Table:
    table = Table(box=None, padding=(0, 2), header_style="dim")
    for heading, justify in (("cost", "left"), ("weighted", "right"), ("share", "right")):
        table.add_column(heading, justify=justify)  # type: ignore[arg-type]
    weighted = {name: g.cost_weights[name] * g.best.terms[name] for name in task.costs}
    whole = sum(value for value in weighted.values() if value == value) or 1.0
    for name, value in weighted.items():
        table.add_row(name, "" if value != value else f"{value:.4g}", "" if value != value else f"{value / whole:.0%}")
    return table
