"""``levade show``: summarise motion files on the terminal and as a page."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from levade.cli.comparing import comparison_table
from levade.cli.picturing import Pictures, draw, labels, progress_beside
from levade.cli.tables import make_console, motion_summary
from levade.motions import Motion


def show_motions(paths: Sequence[Path], pictures: Pictures, *, report: bool, as_json: bool) -> int:
    """Summarise motions.

    Args:
        paths: Files of the motions.
        pictures: What to draw of them.
        report: Whether to write a page for each.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if all of them meet their success criteria, else 1.
    """
    motions = {path: Motion.load(path) for path in paths}
    if as_json:
        written = draw(motions, pictures) + (_reports(motions) if report else [])
        shown = [{"motion": str(path), **motion.meta} for path, motion in motions.items()]
        content = shown[0] if len(shown) == 1 else {"motions": shown}
        print(
            json.dumps(content | ({"written": [str(path) for path in written]} if written else {}), ensure_ascii=False)
        )
    else:
        console = make_console()
        if len(motions) == 1:
            _show(console, *motions.values())
        else:
            console.print(comparison_table(dict(zip(labels(list(motions)), motions.values(), strict=True))))
        if written := draw(motions, pictures):
            console.print(f"Written: {_listed(written)}")
        if report:
            console.print(f"To open in a browser: {_listed(_reports(motions))}")
    return 0 if all(motion.result.success for motion in motions.values()) else 1


def _listed(paths: Sequence[Path]) -> str:
    return ", ".join(escape(str(path)) for path in paths)


def report_path(motion: Path) -> Path:
    """Return the path of a motion's page: report.html next to motion.npz, best-report.html next to best.npz.

    Args:
        motion: File of the motion.

    Returns:
        Path of the page. It need not exist.
    """
    return motion.with_name("report.html" if motion.stem == "motion" else f"{motion.stem}-report.html")


def _reports(motions: Mapping[Path, Motion]) -> list[Path]:
    from levade.checks.record import certificate_beside  # only now: not every call writes a page
    from levade.report.page import write_page

    return [
        write_page(
            motion,
            report_path(path),
            progress_csv=progress_beside(path, motion),
            source=path.name,
            certificate=certificate_beside(path, motion),
            instead=f"write one elsewhere: levade view {shlex.quote(str(path))} --out FILE.html, or none: --no-report",
        )
        for path, motion in motions.items()
    ]


def _show(console: Console, motion: Motion) -> None:
    origin, hold, summary = motion.provenance, motion.hold, list(motion_summary(motion))
    console.print(
        f"[bold]{escape(motion.task_name)}[/] on {escape(motion.robot)}, seed {origin.seed}: {motion.horizon:g} s"
        + (f" and {hold:g} s of hold" if hold > 1e-9 else "")
        + f", {motion.steps} steps of {motion.timestep * 1e3:g} ms"
    )
    for part in summary:
        console.print(part)
    made = ", ".join(f"{name} {version}" for name, version in origin.versions.items())
    console.print(f"{motion.result.trials} trials, cost {motion.result.cost:.4g}; made with {made}")
