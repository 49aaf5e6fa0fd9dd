"""``levade check``: whether a motion can be trusted."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from levade.check import Certificate, Demands, check
from levade.check.perturbed import Perturbed
from levade.cli.tables import make_console
from levade.document import build, parse_yaml, read_yaml
from levade.engines import Perturbation
from levade.errors import LevadeError, did_you_mean
from levade.motion import Motion
from levade.tasks import load_task
from levade.tasks.units import to_si

T = TypeVar("T", Perturbation, Demands)

_SHOWN = 6
"""Parameters in the table of what breaks the motion; all of them are in the JSON."""


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
    threads: int,
    as_json: bool,
) -> int:
    """Exit status 0 if the motion meets every demand, else 1."""
    certificate = check(
        Motion.load(path),
        runs=runs,
        seed=seed,
        divide=divide,
        perturbation=changed(Perturbation(), perturb, option="--perturb"),
        demands=changed(Demands(), demand, option="--demand"),
        criteria=None if criteria is None else load_task(criteria),
        threads=threads,
    )
    content = {"motion": str(path), **certificate.to_json()}
    if out is not None:
        try:
            out.write_text(json.dumps(content, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
        except OSError as error:
            raise LevadeError(
                f"{out}: cannot be written ({error.strerror}); give a path that can: --out FILE"
            ) from None
    if as_json:
        print(json.dumps(content, ensure_ascii=False))
    else:
        _tell(make_console(), path, certificate)
    return 0 if certificate.passed else 1


def changed(default: T, changes: Sequence[str], *, option: str) -> T:
    """The dataclass with values from YAML files and ``name=value`` texts, the later ones counting."""
    content: dict[str, Any] = dataclasses.asdict(default)
    for change in changes:
        name, equals, text = change.partition("=")
        if equals:
            if name not in content:
                raise LevadeError(f"{option} {change}: no {name!r}; {did_you_mean(name, content)}")
            content[name] = parse_yaml(text, where=f"{option} {name}")
        elif not Path(change).is_file():
            hint = did_you_mean(change, content) if change.isidentifier() else "give a YAML file, or name=value"
            raise LevadeError(f"{option} {change}: no such file; {hint}")
        else:
            table = read_yaml(Path(change), like=", ".join(list(content)[:3]))
            build(type(default), to_si(table, where=change), where=change)  # mistakes are the file's
            content |= table
    return build(type(default), to_si(content, where=option[2:]), where=option[2:])


def _tell(console: Console, path: Path, certificate: Certificate) -> None:
    console.print(
        f"[bold]{escape(certificate.task)}[/] on {escape(certificate.robot)}, {escape(str(path))}"
        + (f", by the criteria of {escape(certificate.criteria)}" if certificate.criteria != certificate.task else "")
    )
    console.print(_verdicts(certificate))
    console.print()
    console.print(_errors(certificate.perturbed))
    console.print()
    console.print(_sensitivity(certificate.perturbed))
    failed = [verdict.name for verdict in certificate.verdicts if verdict.passed is False]
    console.print()
    console.print(f"[red]Fails[/]: {escape(', '.join(failed))}." if failed else "[green]Passes[/].")


def _table(*headings: str, right: Sequence[str] = ()) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in headings:
        table.add_column(heading, justify="right" if heading in right else "left")
    return table


def _verdicts(certificate: Certificate) -> Table:
    table = _table("criterion", "", "found", "required")
    for verdict in certificate.verdicts:
        mark = {True: Text("pass", style="green"), False: Text("fail", style="red"), None: Text("-", style="dim")}
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
        table.add_row(Text(name), f"{one.explains:.0%}", *means, f"{one.alone[0]} of {one.alone[1]}")
    return table
