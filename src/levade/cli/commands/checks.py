"""Commands that try a motion on perturbed robots: ``levade check`` and ``stabilise``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Json, MotionFile, Threads


def check(
    motion: MotionFile,
    runs: Annotated[int, typer.Option(help="Number of perturbed runs.")] = 500,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the perturbations; the same seed gives the same runs.")] = 0,
    divide: Annotated[int, typer.Option(help="Divide the time step of the perturbed runs by this.")] = 1,
    perturb: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME=RANGE", help="Ranges instead of the defaults, such as friction=[0.5,1.5]. Repeatable."
        ),
    ] = None,
    demand: Annotated[
        list[str] | None,
        typer.Option(metavar="FILE|NAME=VALUE", help="Demands instead of the defaults, such as share=0.9. Repeatable."),
    ] = None,
    criteria: Annotated[
        str | None, typer.Option(metavar="TASK", help="Judge by this task's success criteria, not the motion's own.")
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the certificate, as JSON, to FILE.")] = None,
    page: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write it as one HTML page, with the poorest runs to play.")
    ] = None,
    threads: Threads = 0,
    as_json: Json = False,
) -> int:
    """Say whether a motion can be trusted: on perturbed robots, at other time steps, in another engine, within limits.

    \b
    levade check rearing/motion.npz --page certificate.html      then open the page
    Fails? levade solve TASK --hardware searches until it passes.

    Exit status: 0 the motion meets every demand; 1 it does not; 2 the input is wrong.
    """
    from levade.cli.checking import check_motion

    return check_motion(
        motion,
        runs=runs,
        seed=seed,
        divide=divide,
        perturb=perturb or [],
        demand=demand or [],
        criteria=criteria,
        out=out,
        page=page,
        threads=threads,
        as_json=as_json,
    )


def stabilise(
    motion: MotionFile,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="File to write; by default MOTION-stabilised.npz next to it.")
    ] = None,
    rate: Annotated[
        float, typer.Option(metavar="HZ", help="Measurements per second; a correction is late by one period.")
    ] = 250.0,
    bound: Annotated[float, typer.Option(metavar="RAD", help="Largest correction of a joint's reference.")] = 0.5,
    runs: Annotated[int, typer.Option(help="Number of perturbed runs that choose the stabiliser.")] = 96,
    seed: Annotated[
        int, typer.Option(min=0, help="Seed of these runs. They differ from the runs of levade check.")
    ] = 0,
    perturb: Annotated[
        list[str] | None, typer.Option(metavar="FILE|NAME=RANGE", help="Ranges, as in levade check. Repeatable.")
    ] = None,
    threads: Threads = 0,
    as_json: Json = False,
) -> int:
    """Find feedback from gyroscope, attitude and joint angles that keeps a motion on its path, and save both.

    \b
    levade stabilise squat-jump/motion.npz
    Next: levade check squat-jump/motion-stabilised.npz

    Exit status: 0 written; 1 no feedback helps, and nothing is written; 2 the input is wrong.
    """
    from levade.cli.stabilising import stabilise_motion

    return stabilise_motion(
        motion,
        out=out,
        rate=rate,
        bound=bound,
        runs=runs,
        seed=seed,
        perturb=perturb or [],
        threads=threads,
        as_json=as_json,
    )
