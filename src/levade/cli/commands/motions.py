"""Commands for a motion that is there: ``levade show``, ``view`` and ``export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Json, MotionFile, OpenPage


def show(
    motions: Annotated[list[Path], typer.Argument(metavar="MOTION", help="A motion.npz; several are compared.")],
    figures: Annotated[Path | None, typer.Option(metavar="DIR", help="Write figures for a paper to DIR.")] = None,
    format: Annotated[str | None, typer.Option(help="Format of the figures: pdf (default), svg or png.")] = None,
    strip: Annotated[Path | None, typer.Option(metavar="FILE", help="Write poses side by side, as .png.")] = None,
    poses: Annotated[int | None, typer.Option(help="Number of poses in the strip; by default 6.")] = None,
    video: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a video: .mp4, .gif or .webp.")] = None,
    slow: Annotated[
        float | None, typer.Option(help="How many times slower than real time the video runs; by default 8.")
    ] = None,
    camera: Annotated[
        str | None,
        typer.Option(
            metavar="AZ,EL[,DIST]",
            help="View of strip and video: azimuth and elevation in degrees, distance in m, such as 118,-12.",
        ),
    ] = None,
    report: Annotated[
        bool | None,
        typer.Option("--report/--no-report", help="Write report.html next to the motion. Default, except with --json."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Summarise motions, and write a page next to each: report.html, to open in any browser.

    \b
    levade show rearing/motion.npz                               numbers, and the page
    levade show a/motion.npz b/motion.npz                        several motions side by side
    levade show rearing/motion.npz --strip s.png --video v.mp4   pictures (extra video)

    Exit status: 0 every motion meets its criteria; 1 one does not; 2 the input is wrong.
    """
    from levade.cli.picturing import Pictures
    from levade.cli.showing import show_motions

    pictures = Pictures(figures, format, strip, poses, video, slow, camera)
    return show_motions(motions, pictures, report=not as_json if report is None else report, as_json=as_json)


def view(
    what: Annotated[
        str,
        typer.Argument(metavar="MOTION|ROBOT|TASK", help="A built-in name, or a file: motion.npz, robot.yaml, task."),
    ],
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write the page to this .html file instead of serving it.")
    ] = None,
    host: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Address to serve at; by default only this machine can reach it."),
    ] = None,
    port: Annotated[int | None, typer.Option(min=0, max=65535, help="Port to serve at; 0 for a free one.")] = None,
    open_page: OpenPage = False,
) -> None:
    """Look at a motion, a robot (with movable joints) or a task (start, scene, goal) in the browser.

    \b
    levade view rearing/motion.npz --open
    levade view my.urdf --out my.html             a page to keep or to send
    levade view squat-jump --open                 a built-in task
    """
    from levade.cli.viewing import view as show_page

    show_page(what, out=out, host=host, port=port, browse=open_page)


def export(
    motion: MotionFile,
    to: Annotated[
        str | None,
        typer.Option(metavar="FORMAT", help="csv, json, ros2, mjlab, unitree, urdf or mjcf; see docs/export.md."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Directory to write; by default MOTION-FORMAT.")
    ] = None,
    rate: Annotated[float | None, typer.Option(metavar="HZ", help="Rows per second; by default the format's.")] = None,
    reference: Annotated[
        str, typer.Option(help="What to send: measured (with feed-forward torque) or commanded (as simulated).")
    ] = "measured",
    hold: Annotated[bool, typer.Option("--hold/--no-hold", help="Go on after the horizon, or stop there.")] = True,
    kp: Annotated[
        float | None, typer.Option(help="Position gain of all joints [Nm/rad]; by default the simulation's.")
    ] = None,
    kd: Annotated[
        float | None, typer.Option(help="Velocity gain of all joints [Nm s/rad]; by default the simulation's.")
    ] = None,
    certificate: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write nothing unless this certificate belongs to the motion and passes."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Write a motion for a robot or another tool, with a player.py that plays it.

    \b
    levade export rearing/motion.npz --to csv
    python rearing/motion-csv/player.py rearing/motion-csv/motion.csv --dry-run

    Exit status: 0 written; 2 the input is wrong.
    """
    from levade.cli.exporting import export_motion

    return export_motion(
        motion,
        to,
        out,
        rate=rate,
        reference=reference,
        hold=hold,
        kp=kp,
        kd=kd,
        certificate=certificate,
        as_json=as_json,
    )
