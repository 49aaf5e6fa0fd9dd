"""Commands and their options. Rooms are imported where they are used: ``levade --help`` needs none of the physics."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from levade.errors import LevadeError

app = typer.Typer(
    name="levade",
    help="Whole-body, single-shot motions for legged robots: state the goal, get a motion.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, and nothing else, on standard output.")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; whatever is wrong with the input is one line on standard error and exit status 2."""
    # typer names these by its own copy of click since 0.26, by click itself before
    _, usage_error, click_exception, *_ = typer.BadParameter.__mro__
    try:
        status = app(args=arguments, standalone_mode=False)
    except LevadeError as error:
        _fail(str(error))
    except usage_error as error:  # type: ignore[misc]
        command = error.ctx.command_path if error.ctx else "levade"
        message = " ".join(error.format_message().split())
        _fail(
            f"{message} See: {command} --help" if message.endswith((".", "?")) else f"{message}; see {command} --help"
        )
    except click_exception as error:  # type: ignore[misc]
        _fail(" ".join(error.format_message().split()))
    except BrokenPipeError:  # the reader of a pipe has seen enough
        sys.stderr.close()
        sys.exit(1)
    except (KeyboardInterrupt, typer.Abort):
        sys.exit(130)
    sys.exit(status if isinstance(status, int) else 0)


def _fail(message: str) -> NoReturn:
    print(f"levade: {' '.join(message.split())}", file=sys.stderr)
    sys.exit(2)


@app.callback(invoke_without_command=True)
def _levade(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    if version:
        from levade import __version__

        print(f"levade {__version__}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command()
def solve(
    task: Annotated[str | None, typer.Argument(help="Name of a built-in task, or a YAML file.")] = None,
    robot: Annotated[str | None, typer.Option(help="Another robot: a name, or its robot.yaml.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the search; the same seed gives the same motion.")] = 0,
    trials: Annotated[int | None, typer.Option(help="Budget, instead of the task's.")] = None,
    optimizer: Annotated[str | None, typer.Option(help="Instead of the task's.")] = None,
    engine: Annotated[str | None, typer.Option(help="mujoco or ode, instead of the task's.")] = None,
    change: Annotated[
        list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change a value of the task. Repeatable.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Directory to write; by default the task's name.")] = None,
    resume: Annotated[Path | None, typer.Option(metavar="DIR", help="Go on with the interrupted run in DIR.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an interrupted run in the directory.")] = False,
    threads: Annotated[int, typer.Option(min=0, help="0 for one per core; no effect on the result.")] = 0,
    as_json: Json = False,
) -> int:
    """Search for a motion that does TASK, and write it to a directory.

    Exit status: 0 the success criteria hold, 1 they do not (everything is still written), 2 the input is wrong.
    """
    from levade.cli.solving import solve_and_report

    changes = list(change or [])
    if trials is not None:
        changes.append(f"search.trials={trials}")
    if optimizer is not None:
        changes.append(f"search.optimizer={optimizer}")
    if engine is not None:
        changes.append(f"physics.engine={engine}")
    if resume is not None:
        given = {
            "TASK": task,
            "--robot": robot,
            "--out": out,
            "--set, --trials, --optimizer or --engine": changes or None,
        }
        extra = [name for name, value in given.items() if value is not None]
        if extra:
            raise LevadeError(f"--resume {resume}: the run says all; leave out {' and '.join(extra)}")
    elif task is None:
        raise LevadeError(
            "solve: name a task, such as: levade solve rearing (levade tasks lists them), or --resume DIR"
        )
    return solve_and_report(
        task=task,
        robot=robot,
        seed=seed,
        changes=changes,
        directory=out,
        resume_from=resume,
        force=force,
        threads=threads,
        as_json=as_json,
    )


@app.command()
def show(
    motions: Annotated[list[Path], typer.Argument(metavar="MOTION", help="A motion.npz; several are compared.")],
    figures: Annotated[Path | None, typer.Option(metavar="DIR", help="Write figures for a paper to DIR.")] = None,
    format: Annotated[str | None, typer.Option(help="Of the figures: pdf (default), svg or png.")] = None,
    strip: Annotated[Path | None, typer.Option(metavar="FILE", help="Write poses side by side, as .png.")] = None,
    poses: Annotated[int | None, typer.Option(help="In the strip; by default 6.")] = None,
    video: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a video: .mp4, .gif or .webp.")] = None,
    slow: Annotated[float | None, typer.Option(help="Times slower than it was, in the video; by default 8.")] = None,
    camera: Annotated[
        str | None, typer.Option(metavar="AZ,EL[,DIST]", help="Of strip and video: degrees and m, such as 118,-12.")
    ] = None,
    report: Annotated[
        bool | None,
        typer.Option("--report/--no-report", help="Write report.html beside the motion; without --json the default."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Summarise a motion, and write its page beside it: report.html, to open in any browser."""
    from levade.cli.picturing import Pictures
    from levade.cli.showing import show_motions

    pictures = Pictures(figures, format, strip, poses, video, slow, camera)
    return show_motions(motions, pictures, report=not as_json if report is None else report, as_json=as_json)


@app.command()
def check(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="A motion.npz.")],
    runs: Annotated[int, typer.Option(help="Perturbed runs.")] = 500,
    seed: Annotated[int, typer.Option(min=0, help="Of the perturbations; the same seed gives the same runs.")] = 0,
    divide: Annotated[int, typer.Option(help="Divide the time step of the perturbed runs by this.")] = 1,
    perturb: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME=RANGE", help="Ranges instead of the defaults, as friction=[0.5,1.5]. Repeatable."
        ),
    ] = None,
    demand: Annotated[
        list[str] | None,
        typer.Option(metavar="FILE|NAME=VALUE", help="What to demand instead, as share=0.9. Repeatable."),
    ] = None,
    criteria: Annotated[
        str | None, typer.Option(metavar="TASK", help="Judge by this task's success criteria, not the motion's own.")
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the certificate, as JSON, to FILE.")] = None,
    threads: Annotated[int, typer.Option(min=0, help="0 for one per core; no effect on the result.")] = 0,
    as_json: Json = False,
) -> int:
    """Say whether a motion can be trusted: perturbed, in other numbers, in another engine, against the hardware.

    Exit status: 0 it meets every demand, 1 it does not, 2 the input is wrong.
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
        threads=threads,
        as_json=as_json,
    )


@app.command()
def tasks(as_json: Json = False) -> None:
    """List the built-in tasks."""
    from levade.tasks import builtin_tasks, load_task

    loaded = [load_task(name) for name in builtin_tasks()]
    if as_json:
        rows = [{"name": task.name, "description": task.description, "robot": task.robot.name} for task in loaded]
        _print_json({"tasks": rows})
    else:
        _print_rows([(task.name, task.description) for task in loaded])


@app.command()
def robots(as_json: Json = False) -> None:
    """List the built-in robots."""
    from levade.robots import builtin_robots

    listed = builtin_robots()
    if as_json:
        _print_json({"robots": [{"name": name, "description": description} for name, description in listed]})
    else:
        _print_rows(listed)


def _print_json(content: dict[str, Any]) -> None:
    print(json.dumps(content, ensure_ascii=False))


def _print_rows(rows: list[tuple[str, str]]) -> None:
    width = max(len(name) for name, _ in rows)
    for name, description in rows:
        print(f"{name:<{width}}  {description}")
