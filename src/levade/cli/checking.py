"""``levade check``: say whether a motion can be trusted."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from levade.checks import Certificate, Demands, check
from levade.checks.perturbed import Perturbed
from levade.cli.doubts import hardware_command
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console
from levade.document import build, parse_yaml, read_yaml
from levade.engines import Perturbation
from levade.errors import LevadeError, did_you_mean
from levade.motions import Motion
from levade.report.files import writing
from levade.report.page import check_page
from levade.tasks import load_task
from levade.tasks.units import to_si

T = TypeVar("T", Perturbation, Demands)

_SHOWN = 6
"""Number of parameters in the table of what breaks the motion. The JSON has all of them."""


def check_motion(
    path: Path,
    *,
    runs: int,
    seed: int,
    divide: int,
    perturb: Sequence[str],
    demand: Sequence[str],
    criteria: str | None,
    out: Path | None,
    page: Path | None,
    threads: int,
    as_json: bool,
) -> int:
    """Check a motion and print its certificate.

    Ctrl-C ends the check and keeps the finished runs. The parameters are the options of the command.

    Args:
        path: File of the motion.
        runs: Number of perturbed runs.
        seed: Seed of the perturbations.
        divide: Number by which the time step of the perturbed runs is divided.
        perturb: Changes of the default ranges: files, or ``name=range``.
        demand: Changes of the default demands: files, or ``name=value``.
        criteria: Task that gives the success criteria. None for the motion's own.
        out: File for the certificate, as JSON. None writes none.
        page: File for the certificate, as a page. None writes none.
        threads: Number of engine threads (0: one per core).
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if the motion meets every demand, else 1.
    """
    motion = Motion.load(path)
    perturbation = changed(Perturbation(), perturb, option="--perturb")
    demands = changed(Demands(), demand, option="--demand")
    task = None if criteria is None else load_task(criteria, robot=motion.task.robot.name)
    place = nullcontext(None) if out is None else writing(out, instead="give a path that can: --out FILE")
    sheet = nullcontext(None)
    if page is not None:
        check_page(page, instead="give a path that can: --page FILE")
        sheet = writing(page, instead="give a path that can: --page FILE")
    with place as file, sheet as leaf:  # fails before the work if something cannot be written
        with stop_between() as stopping:
            certificate = check(
                motion,
                runs=runs,
                seed=seed,
                divide=divide,
                perturbation=perturbation,
                demands=demands,
                criteria=task,
                threads=threads,
                stopping=stopping,
            )
        content = {"motion": str(path), **certificate.to_json()}
        if as_json:
            print(json.dumps(content, ensure_ascii=False))
        else:
            _tell(make_console(), path, motion, certificate, runs)
        if file is not None:
            file.write_text(json.dumps(content, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
        if leaf is not None:
            from levade.hardware import certificate_page  # only now: it imports searches and scenes

            judged = None if task is None else task.success
            leaf.write_text(
                certificate_page(motion, certificate, criteria=judged, source=str(path)), encoding="utf-8", newline="\n"
            )
    return 0 if certificate.passed else 1


def changed(default: T, changes: Sequence[str], *, option: str) -> T:
    """Change a dataclass by YAML files and ``name=value`` texts. Later changes override earlier ones.

    Args:
        default: The dataclass to change.
        changes: Files and texts, in order.
        option: Option of the command line, for messages.

    Raises:
        LevadeError: If a change names no field, no file, or a value that does not fit.
    """
    content: dict[str, Any] = dataclasses.asdict(default)
    for change in changes:
        name, equals, text = change.partition("=")
        if equals:
            if name not in content:
                raise LevadeError(f"{option} {change}: no {name!r}; {did_you_mean(name, content)}")
            if not text.strip():
                raise LevadeError(f"{option} {change}: no value; give one, or null for none: {name}=null")
            content[name] = parse_yaml(text, where=f"{option} {name}")
        elif not Path(change).is_file():
            if change in content:
                raise LevadeError(f"{option} {change}: no value; give one, as {_like(default, change)}")
            hint = did_you_mean(change, content) if change.isidentifier() else "give a YAML file, or name=value"
            raise LevadeError(f"{option} {change}: no such file; {hint}")
        else:
            table = read_yaml(Path(change), like=", ".join(list(content)[:3]))
            build(type(default), to_si(table, where=change), where=change)  # mistakes are the file's
            content |= table
    return build(type(default), to_si(content, where=option[2:]), where=option[2:])


def _like(default: Perturbation | Demands, name: str) -> str:
    """Return NAME=VALUE with the default, or with a possible value."""
    value = getattr(default, name)
    if isinstance(default, Demands):
        return f"{name}={'0.1' if value is None else 'true' if value is True else f'{value:g}'}"
    return f"{name}={'[0.9,1.1]' if value is None else f'[{value[0]:g},{value[1]:g}]'}"


def _tell(console: Console, path: Path, motion: Motion, certificate: Certificate, runs: int) -> None:
    console.print(
        f"[bold]{escape(certificate.task)}[/] on {escape(certificate.robot)}, {escape(str(path))}"
        + (f", by the criteria of {escape(certificate.criteria)}" if certificate.criteria != certificate.task else "")
    )
    console.print(verdict_table(certificate))
    for goal in certificate.goal:
        if goal.perturbed and not goal.task == goal.model == goal.perturbed:
            own = "" if goal.task == goal.model else f"; the task says {goal.task}"
            console.print(
                f"{escape(goal.criterion)}: {goal.perturbed} on perturbed robots, {goal.model} on the model{own}",
                style="dim",
            )
    console.print()
    console.print(_errors(certificate.perturbed))
    if certificate.perturbed.successes:  # where nothing succeeds, nothing can be compared
        console.print()
        console.print(_sensitivity(certificate.perturbed))
    failed = certificate.failed
    console.print()
    if certificate.interrupted:
        console.print(
            f"[yellow]Interrupted[/] after {certificate.perturbed.runs} of {runs} perturbed runs; nothing else was checked."
        )
        return
    unknown = escape(", ".join(certificate.unknown))
    if failed:
        console.print(f"[red]Fails[/]: {escape(', '.join(failed))}.{unknown and f' Unknown: {unknown}.'}")
    elif unknown:
        console.print(
            f"[green]Passes[/] what is known. [yellow]Unknown[/]: {unknown}; add them to robot.yaml, under limits."
        )
    else:
        console.print("[green]Passes[/].")
    recorded = certificate.numerics.get("as recorded")
    if recorded is not None and not recorded.success:
        console.print(
            "It does not succeed even as recorded, without any change, so nothing here says how robust it is."
            f" Next: {escape(hardware_command(motion, path.parent))}"
        )


def _table(*headings: str, right: Sequence[str] = ()) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in headings:
        table.add_column(heading, justify="right" if heading in right else "left")
    return table


def verdict_table(certificate: Certificate) -> Table:
    """Make a table of a certificate, with a row per criterion.

    Args:
        certificate: The certificate.
    """
    table = _table("criterion", "", "found", "required")
    for verdict in certificate.verdicts:
        mark = {True: Text("pass", style="green"), False: Text("fail", style="red"), None: Text("-", style="dim")}
        if verdict.unknown:
            mark[None] = Text("unknown", style="yellow")
        found = " ".join(part for part in (verdict.value, f"({verdict.reason})" if verdict.reason else "") if part)
        table.add_row(Text(verdict.name), mark[verdict.passed], Text(found), Text(verdict.required))
    return table


def _errors(found: Perturbed) -> Table:
    columns = ("lowest", "mean", "highest", "missed in")
    table = _table("error in the perturbed runs", *columns, right=columns)
    for name, one in found.errors.items():
        numbers = [f"{one[column]:+.4f}" for column in ("lowest", "mean", "highest")]
        table.add_row(Text(name), *numbers, f"{one['missed']:.0f} of {found.runs}")
    return table


def _sensitivity(found: Perturbed) -> Table:
    columns = ("explains", "mean where it failed", "where it succeeded", "succeeds with it alone")
    table = _table("what breaks it", *columns, right=columns)
    for one in found.sensitivity[:_SHOWN]:
        name = f"{one.parameter} {one.number}".strip()
        means = ["-" if mean is None else f"{mean:.3g} {one.unit}" for mean in (one.failed, one.succeeded)]
        table.add_row(
            Text(name), f"{one.explains:.0%}", *means, f"{one.alone[0]} of {one.alone[1]}" if one.alone[1] else "-"
        )
    return table
