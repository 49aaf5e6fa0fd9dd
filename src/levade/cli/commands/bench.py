"""The command ``levade bench``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Json

_SEVERAL = ("--tasks", "--robots", "--optimizers", "--add")
"""Options of ``bench`` that take every word up to the next option."""


def spread(arguments: Sequence[str]) -> list[str]:
    """Rewrite ``bench --tasks A B`` as ``bench --tasks A --tasks B``, since typer takes several values in this form.

    Args:
        arguments: Arguments of any command.

    Returns:
        The arguments. Those of other commands stay as they are.
    """
    if not arguments or arguments[0] != "bench":
        return list(arguments)
    taken: list[str] = []
    option: str | None = None
    for word in arguments:
        if word.startswith("-"):
            option = word if word in _SEVERAL else None
        elif option is not None and taken[-1] != option:
            taken.append(option)
        taken.append(word)
    return taken


def bench(
    plan: Annotated[Path | None, typer.Argument(metavar="FILE", help="A plan: see docs/bench.md.")] = None,
    tasks: Annotated[list[str] | None, typer.Option(metavar="NAME ...", help="Names or files.")] = None,
    robots: Annotated[
        list[str] | None, typer.Option(metavar="NAME ...", help="Names or files, instead of each task's own.")
    ] = None,
    optimizers: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME ...", help="Optimizers instead of each task's own; see solve --optimizer."),
    ] = None,
    seeds: Annotated[int | None, typer.Option(help="Number of seeds, from 0; by default 5.")] = None,
    trials: Annotated[int | None, typer.Option(help="Trials of a run, instead of the task's.")] = None,
    steps: Annotated[float | None, typer.Option(help="Largest number of physics steps of a run.")] = None,
    until: Annotated[
        str | None, typer.Option(help="When a run ends: success (and polished; the default) or budget.")
    ] = None,
    changes: Annotated[
        list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change a value of every task. Repeatable.")
    ] = None,
    out: Annotated[Path, typer.Option(help="Directory to write, or to continue in.")] = Path("bench"),
    processes: Annotated[
        int, typer.Option(min=0, help="Runs at a time; 0 for one per core. No effect on the results.")
    ] = 0,
    force: Annotated[bool, typer.Option("--force", help="Begin again; the results in the directory are lost.")] = False,
    add: Annotated[
        list[Path] | None, typer.Option(metavar="FILE ...", help="Other results.csv files to report as well.")
    ] = None,
    format: Annotated[str, typer.Option(help="Format of the figures: pdf, svg or png.")] = "pdf",
    as_json: Json = False,
) -> int:
    """Compare optimizers: tasks x robots x optimizers x seeds, in parallel. Called again, it continues where it stopped.

    \b
    levade bench --tasks rearing --optimizers cma-aimed cma --seeds 5 --out rearing-bench
    Next: rearing-bench/table.md

    Exit status: 0 every run is done, 1 it was interrupted, 2 the input is wrong.
    """
    from levade.cli.benching import bench_and_report

    options = {
        "tasks": tuple(tasks) if tasks else None,
        "robots": tuple(robots) if robots else None,
        "optimizers": tuple(optimizers) if optimizers else None,
        "seeds": seeds,
        "trials": trials,
        "steps": steps,
        "until": until,
    }
    return bench_and_report(
        file=plan,
        options=options,
        changes=changes or [],
        add=add or [],
        directory=out,
        processes=processes,
        force=force,
        format=format,
        as_json=as_json,
    )
