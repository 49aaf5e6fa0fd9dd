"""The command ``levade solve``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Changes, Json, OpenPage, Threads
from levade.errors import LevadeError


def solve(
    task: Annotated[str | None, typer.Argument(help="Name of a built-in task, or a YAML file.")] = None,
    robot: Annotated[
        str | None, typer.Option(help="Robot instead of the task's: a name, or a URDF, MJCF or robot.yaml file.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Seed of the search; by default 0. The same seed gives the same motion.")
    ] = None,
    trials: Annotated[int | None, typer.Option(help="Number of trials, instead of the task's.")] = None,
    optimizer: Annotated[
        str | None,
        typer.Option(help="Optimizer instead of the task's: cma-aimed, cma, pi2, pi2-cma, mppi, cem or random."),
    ] = None,
    engine: Annotated[str | None, typer.Option(help="Engine instead of the task's: mujoco or ode.")] = None,
    changes: Changes = None,
    out: Annotated[Path | None, typer.Option(help="Directory to write; by default the task's name.")] = None,
    begin: Annotated[
        list[Path] | None,
        typer.Option(
            "--from", metavar="MOTION", help="Begin around the motion in this file. Repeatable: the best one is used."
        ),
    ] = None,
    after: Annotated[
        Path | None,
        typer.Option(metavar="MOTION", help="Start where the motion in this file ends, instead of the task's start."),
    ] = None,
    resume: Annotated[Path | None, typer.Option(metavar="DIR", help="Continue the interrupted run in DIR.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an interrupted run in the directory.")] = False,
    threads: Threads = 0,
    hardware: Annotated[
        bool, typer.Option("--hardware", help="Search until a certificate passes: see levade check.")
    ] = False,
    robust: Annotated[
        bool,
        typer.Option("--robust", help="Like --hardware, but without limits: only robots that differ from the model."),
    ] = False,
    minutes: Annotated[
        float | None, typer.Option(help="With --hardware or --robust: minutes for all searches together.")
    ] = None,
    demand: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME=VALUE",
            help="With --hardware or --robust: what the certificate demands, as in levade check. Repeatable.",
        ),
    ] = None,
    watch: Annotated[
        bool,
        typer.Option(
            "--watch",
            help="Show the best motion so far on a page in the browser, with pause, stop and sliders for weights.",
        ),
    ] = False,
    watch_host: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Address to serve the page at; by default only this machine can reach it."
        ),
    ] = None,
    watch_port: Annotated[
        int | None, typer.Option(min=0, max=65535, help="Port to serve the page at; 0 for a free one.")
    ] = None,
    open_page: OpenPage = False,
    keep_open: Annotated[
        bool, typer.Option("--keep-open", help="Keep serving the page after the search, until Ctrl-C.")
    ] = False,
    as_json: Json = False,
) -> int:
    """Search for a motion that does TASK, and write it to a directory.

    \b
    levade solve rearing                          a built-in task; levade tasks lists them
    levade solve squat-jump --robot my.urdf       on your robot
    levade solve my-task.yaml --hardware          within limits, on robots that differ
    levade solve --resume DIR                     continue after Ctrl-C or a crash
    Next: levade show DIR/motion.npz, levade check DIR/motion.npz

    Exit status: 0 the success criteria hold, with --hardware or --robust the certificate passes; 1 they do not (everything
    is still written); 2 the input is wrong.
    """
    from levade.cli.watching import options

    watching = options(watch, watch_host, watch_port, open_page, keep_open)
    changed = list(changes or [])
    if trials is not None:
        changed.append(f"search.trials={trials}")
    if optimizer is not None:
        changed.append(f"search.optimizer={optimizer}")
    if engine is not None:
        changed.append(f"physics.engine={engine}")
    if resume is not None:
        given = {
            "TASK": task,
            "--robot": robot,
            "--seed": seed,
            "--out": out,
            "--force": force or None,
            "--from": begin or None,
            "--after": after,
            "--set, --trials, --optimizer or --engine": changed or None,
            "--hardware": hardware or None,
            "--robust": robust or None,
        }
        extra = [name for name, value in given.items() if value is not None]
        if extra:
            raise LevadeError(f"--resume {resume} takes its settings from the run; leave out {' and '.join(extra)}")
    elif task is None:
        raise LevadeError(
            "solve: name a task, such as: levade solve rearing (levade tasks lists them), or --resume DIR"
        )
    from levade.search.run import PURSUIT
    from levade.tasks.files import asks_for_hardware

    if hardware and robust:
        raise LevadeError("--robust: --hardware includes it; leave out one of them")
    flag = "--hardware" if hardware else "--robust" if robust else None
    hardware = hardware or (task is not None and asks_for_hardware(task, changed))
    if hardware or robust or (resume is not None and (resume / PURSUIT).is_file()):
        from levade.cli.pursuing import pursue_and_report

        beside = {"--watch": watch, "--from": begin, "--after": after, "--trials": trials, "--optimizer": optimizer}
        if extra := [name for name, value in beside.items() if value]:
            asks = flag or ("--hardware" if resume is not None else "hardware, which the task asks for")
            raise LevadeError(f"{asks}: plans its own searches; leave out {' and '.join(extra)}")
        return pursue_and_report(
            task=task,
            robot=robot,
            seed=seed or 0,
            changes=changed,
            directory=out,
            resume_from=resume,
            force=force,
            minutes=minutes,
            robust=robust,
            demand=demand or [],
            threads=threads,
            as_json=as_json,
        )
    if minutes is not None or demand:
        raise LevadeError(
            f"{'--minutes' if minutes is not None else '--demand'}: only works with --hardware or --robust"
        )
    from levade.cli.solving import solve_and_report

    return solve_and_report(
        task=task,
        robot=robot,
        seed=seed or 0,
        changes=changed,
        begin=begin or [],
        after=after,
        directory=out,
        resume_from=resume,
        force=force,
        threads=threads,
        watching=watching,
        as_json=as_json,
    )
