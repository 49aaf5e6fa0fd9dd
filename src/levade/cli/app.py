"""Commands and their options. Rooms are imported where they are used: ``levade --help`` needs none of the physics."""

from __future__ import annotations

import atexit
import copy
import gc
import json
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Annotated, Any

import typer

from levade.cli.flags import in_flags
from levade.cli.output import lasting_output
from levade.errors import LevadeError, one_line

app = typer.Typer(
    name="levade",
    help="""Whole-body motions for legged robots: state the goal, get a motion.

    \b
    Begin:   levade solve rearing                 find a motion
             levade show rearing/motion.npz       see it in the browser
             levade tasks                         list the built-in tasks
    Robot:   levade robots inspect FILE           how levade reads your URDF or MJCF
             levade solve squat-jump --robot FILE
    Check:   levade solve TASK --hardware         search until a certificate passes
    Stuck:   levade doctor                        what is missing here, and how to get it
    """,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, and nothing else, on standard output.")]


_SEVERAL = ("--tasks", "--robots", "--optimizers", "--add")
"""Options of ``bench`` that take every word up to the next option."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line. Wrong input gives one line on standard error and exit status 2.

    Args:
        arguments: Words after the program's name. Defaults to those of the process.
    """
    if arguments is None:
        _collect_seldom()
    with lasting_output() as output:
        status = _run(arguments)
        output.flush()
        if output.refused is not None and status != 2:
            status = _failed(f"standard output: cannot be written ({output.refused.strerror}); the work is done")
    sys.exit(status)


def _collect_seldom() -> None:
    """Let the garbage collector run seldom, and not at the end: both took a quarter of the start-up time."""
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)


def _run(arguments: Sequence[str] | None) -> int:
    """Run the command line. Returns the exit status."""
    # since 0.26 these come from typer's own copy of click, before from click itself
    _, usage_error, click_exception, *_ = typer.BadParameter.__mro__
    arguments = _spread(sys.argv[1:] if arguments is None else arguments)
    first = arguments[0] if arguments else ""
    try:
        status = _command(first)(args=arguments, standalone_mode=False)
    except LevadeError as error:
        return _failed(in_flags(error, _command(first), arguments))
    except usage_error as error:  # type: ignore[misc]
        command = error.ctx.command_path if error.ctx else "levade"
        message = " ".join(error.format_message().split())
        return _failed(
            f"{message} See: {command} --help" if message.endswith((".", "?")) else f"{message}; see {command} --help"
        )
    except click_exception as error:  # type: ignore[misc]
        return _failed(" ".join(error.format_message().split()))
    except OSError as error:  # the system refuses a path, for example because its name is too long
        place = error.filename if isinstance(error.filename, str) else "the system"
        return _failed(f"{place}: {error.strerror or error}; give another path")
    except MemoryError as error:
        return _failed(f"not enough memory{f' ({error})' if str(error) else ''}; fewer or shorter trials need less")
    except (KeyboardInterrupt, typer.Abort):
        return 130
    return status if isinstance(status, int) else 0


@cache
def _command(word: str) -> Any:
    """Make the tree of commands. If the word names a command, the tree holds only that one: typer reads every signature."""
    alone = copy.copy(app)
    alone.registered_commands = [
        one for one in app.registered_commands if one.callback and one.callback.__name__ == word
    ]
    alone.registered_groups = []
    return typer.main.get_command(alone if alone.registered_commands else app)


def _spread(arguments: Sequence[str]) -> list[str]:
    """Rewrite ``bench --tasks A B`` as ``bench --tasks A --tasks B``, since typer takes several values in this form."""
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


def _failed(message: str) -> int:
    print(f"levade: {one_line(' '.join(message.split()))}", file=sys.stderr)
    return 2


@app.callback(invoke_without_command=True)
def _levade(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    if version:
        from levade.version import __version__

        print(f"levade {__version__}")
        raise typer.Exit
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command(short_help="Find a motion that does a task.")
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
    changes: Annotated[
        list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change a value of the task. Repeatable.")
    ] = None,
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
    threads: Annotated[
        int, typer.Option(min=0, help="Number of engine threads; 0 for one per core. No effect on the result.")
    ] = 0,
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
    open_page: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
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


@app.command(short_help="Summarise motions; write a page, pictures, figures.")
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


@app.command(short_help="Compare optimizers over tasks, robots and seeds.")
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


@app.command(short_help="Say whether a motion can be trusted.")
def check(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="A motion.npz.")],
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
    threads: Annotated[
        int, typer.Option(min=0, help="Number of engine threads; 0 for one per core. No effect on the result.")
    ] = 0,
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


@app.command(short_help="Add a feedback to a motion.")
def stabilise(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="A motion.npz.")],
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
    threads: Annotated[
        int, typer.Option(min=0, help="Number of engine threads; 0 for one per core. No effect on the result.")
    ] = 0,
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


@app.command(short_help="Look at a motion, a robot or a task in the browser.")
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
    open_page: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
) -> None:
    """Look at a motion, a robot (with movable joints) or a task (start, scene, goal) in the browser.

    \b
    levade view rearing/motion.npz --open
    levade view my.urdf --out my.html             a page to keep or to send
    levade view squat-jump --open                 a built-in task
    """
    from levade.cli.viewing import view as show_page

    show_page(what, out=out, host=host, port=port, browse=open_page)


@app.command(short_help="Write a motion for a robot or another tool.")
def export(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="A motion.npz.")],
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


@app.command(short_help="Say what this computer has and what it lacks.")
def doctor(
    robot: Annotated[str | None, typer.Argument(hidden=True)] = None,
    as_json: Json = False,
) -> int:
    """Say what this computer has for levade: versions, engines, OpenGL, browser, GPU, and what each feature still needs.

    Exit status: 0 searches can run; 1 a package is missing or too old; 2 the input is wrong.
    """
    if robot is not None:
        raise LevadeError(
            f"doctor: looks at this computer and takes no {robot}; to look at a robot: levade robots inspect {robot}"
        )
    from levade.cli.diagnosing import diagnose

    return diagnose(as_json=as_json)


_library = typer.Typer(
    help="""Get a robot up from any fall: build, ask and check a library of motions.

    \b
    levade library build self-righting --robot go1 --starts 24 --out falls
    levade library check falls --starts 100
    levade library ask falls --state state.json
    levade library export falls --out falls-robot
    """,
    rich_markup_mode=None,
)
app.add_typer(_library, name="library")


@_library.command("build")
def _build_library(
    task: Annotated[str, typer.Argument(help="Task of each motion: self-righting, or your own task.")],
    robot: Annotated[str | None, typer.Option(help="Robot instead of the task's: a name or a file.")] = None,
    starts: Annotated[int, typer.Option(help="Number of falls in all; a later build may add more.")] = 100,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the falls and of the searches.")] = 0,
    out: Annotated[Path | None, typer.Option(help="Directory to write; by default TASK-library.")] = None,
    changes: Annotated[
        list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change a value of the task. Repeatable.")
    ] = None,
    threads: Annotated[int, typer.Option(min=0, help="Number of engine threads; 0 for one per core.")] = 0,
    jobs: Annotated[int, typer.Option(min=1, help="Number of processes at a time, with one thread each.")] = 1,
    shard: Annotated[
        str | None,
        typer.Option(metavar="I/N", help="Build only every N-th fall, from fall I (0 to N - 1); see library merge."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Find a motion for each of many falls. Called again, it continues where it stopped.

    \b
    levade library build self-righting --robot go1 --starts 24 --out falls
    Next: levade library check falls

    Exit status: 0 every fall is done, 1 it was interrupted, 2 the input is wrong.
    """
    from levade.cli.librarian import build_library

    return build_library(
        task,
        robot=robot,
        starts=starts,
        seed=seed,
        out=out,
        changes=changes or [],
        threads=threads,
        jobs=jobs,
        shard=shard,
        as_json=as_json,
    )


@_library.command("merge")
def _merge_library(
    shards: Annotated[list[Path], typer.Argument(metavar="SHARD...", help="Directories of shards of one library.")],
    out: Annotated[Path, typer.Option(help="Directory of the library.")],
    as_json: Json = False,
) -> int:
    """Join shards that were built on several machines.

    \b
    levade library merge shard-* --out falls
    Next: levade library build with the same task and --out falls, which tries every motion from every fall

    Exit status: 0 all is joined, 2 the input is wrong.
    """
    from levade.cli.librarian import merge_libraries

    return merge_libraries(shards, out=out, as_json=as_json)


@_library.command("learn")
def _learn_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library that is built.")],
    as_json: Json = False,
) -> int:
    """Learn in several ways which motion works from which state. The library then answers in the best of these ways.

    It says how often the first answer is right.
    """
    from levade.cli.librarian import learn_library

    return learn_library(library, as_json=as_json)


@_library.command("export")
def _export_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library.")],
    out: Annotated[Path | None, typer.Option(help="Directory to write; by default DIR-robot.")] = None,
    rate: Annotated[float | None, typer.Option(help="Rows per second [Hz]; by default the simulation's.")] = None,
    as_json: Json = False,
) -> int:
    """Write a library for a robot. The exported script needs only numpy: it asks, plays, checks and asks again.

    \b
    levade library export falls --out falls-robot
    Next: python falls-robot/ask.py --state state.json
    """
    from levade.cli.librarian import export_the_library

    return export_the_library(library, out=out, rate=rate, as_json=as_json)


@_library.command("show")
def _show_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library.")],
    figures: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Draw the falls and the motions that cover them, into DIR.")
    ] = None,
    format: Annotated[str, typer.Option(help="Format of the figure: pdf, svg or png.")] = "pdf",
    report: Annotated[
        bool | None,
        typer.Option("--report/--no-report", help="Write library.html into DIR. Default, except with --json."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Show what a library holds, and write library.html, a page to open in any browser.

    The page shows how the robot lies after each fall, how each was solved, how few motions are enough, and plays some of
    them. A build also writes it.
    """
    from levade.cli.librarian import show_library

    write = not as_json if report is None else report
    return show_library(library, figures=figures, format=format, report=write, as_json=as_json)


@_library.command("ask")
def _ask_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library.")],
    state: Annotated[Path, typer.Option(help="JSON or YAML: attitude (w-x-y-z) or up (in trunk axes), and joints.")],
    reference: Annotated[Path | None, typer.Option(help="Write the joints' references to this file, as CSV.")] = None,
    refine: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Try the answer in simulation, and improve it for this time, such as 1s."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Say which motion most likely works from the state in which the robot lies. Only --refine simulates.

    Exit status: 0 there is an answer, 1 it does not work even after --refine, 2 the input is wrong.
    """
    from levade.cli.librarian import ask_library

    return ask_library(library, state=state, reference=reference, refine=refine, as_json=as_json)


@_library.command("check")
def _check_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library.")],
    starts: Annotated[int, typer.Option(help="Number of falls to try.")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="Seed of these falls; it should differ from the library's.")] = 1,
    refine: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Improve for this time each answer that does not work, such as 1s."),
    ] = None,
    threads: Annotated[int, typer.Option(min=0, help="Number of engine threads; 0 for one per core.")] = 0,
    as_json: Json = False,
) -> int:
    """Try a library on new falls, and say how often the robot gets up.

    \b
    levade library check falls --starts 100
    Next: levade library export falls

    Exit status: 0 all were tried, 1 it was interrupted, 2 the input is wrong.
    """
    from levade.cli.librarian import check_the_library

    return check_the_library(library, starts=starts, seed=seed, refine=refine, threads=threads, as_json=as_json)


_tasks = typer.Typer(
    help="""List the built-in tasks; print one, or the schema of task files.

    \b
    levade tasks
    levade tasks show rearing > mine.yaml         then edit it: docs/your-task.md
    Next: levade solve mine.yaml
    """,
    rich_markup_mode=None,
)
app.add_typer(_tasks, name="tasks")


@_tasks.callback(invoke_without_command=True)
def _list_tasks(context: typer.Context, as_json: Json = False) -> None:
    from levade.tasks import builtin_tasks, load_task

    if context.invoked_subcommand is not None:
        return
    loaded = [load_task(name) for name in builtin_tasks()]
    if as_json:
        rows = [{"name": task.name, "description": task.description, "robot": task.robot.name} for task in loaded]
        _print_json({"tasks": rows})
    else:
        _print_rows([(task.name, task.description) for task in loaded])


@_tasks.command("show")
def _show_task(
    task: Annotated[str, typer.Argument(help="Name of a built-in task, or a YAML file.")],
    robot: Annotated[str | None, typer.Option(help="Robot instead of the task's, for --full.")] = None,
    full: Annotated[bool, typer.Option("--full", help="Fill in every default, in SI, for the task's robot.")] = False,
) -> None:
    """Print TASK as it was written, to start your own from."""
    from levade.tasks import load_task, task_text, task_to_yaml

    if robot is not None and not full:
        raise LevadeError("tasks show: --robot only works with --full; add --full")
    print(task_to_yaml(load_task(task, robot=robot)) if full else task_text(task), end="")


@_tasks.command("schema")
def _schema() -> None:
    """Print the JSON schema of task files, for editors."""
    from levade.tasks.schema import task_schema

    print(json.dumps(task_schema(), indent=2, ensure_ascii=False))


_robots = typer.Typer(
    help="""List the robots; inspect one: a built-in name or your own file.

    \b
    levade robots
    levade robots inspect my.urdf
    Next: levade solve squat-jump --robot my.urdf
    """,
    rich_markup_mode=None,
)
app.add_typer(_robots, name="robots")


@_robots.callback(invoke_without_command=True)
def _list_robots(context: typer.Context, as_json: Json = False) -> None:
    from levade.cli.inspecting import list_robots

    if context.invoked_subcommand is None:
        list_robots(as_json=as_json)


@_robots.command("inspect")
def _inspect_robot(
    robot: Annotated[str, typer.Argument(metavar="NAME|FILE", help="A name, or a file: URDF, MJCF or robot.yaml.")],
    picture: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw it standing, with the names of joints and feet, as .png.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Say how levade understands a robot (legs, limits, posture, actuators), and what looks suspicious, with remedies.

    \b
    levade robots inspect my.urdf --picture my.png
    Next: levade view my.urdf --open, levade solve squat-jump --robot my.urdf

    Exit status: 0 the robot can be used; 2 it cannot, and one line says why.
    """
    from levade.cli.inspecting import inspect_robot

    inspect_robot(robot, picture=picture, as_json=as_json)


@_robots.command("rightability")
def _robot_rightability(
    robot: Annotated[str, typer.Argument(metavar="NAME|FILE", help="A name, or a file: URDF, MJCF or robot.yaml.")],
    slope: Annotated[
        list[float] | None,
        typer.Option(metavar="DEG", help="Slope of the ground [degrees]; may be repeated. Default: 0, 10, 20, 30."),
    ] = None,
    library: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="A library of this robot: also say from how many of its falls a motion was found."
        ),
    ] = None,
    map: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Draw what the robot comes to lie on, over the direction of up: .png, .svg or .pdf."
        ),
    ] = None,
    angles: Annotated[
        int, typer.Option(metavar="N", help="Combinations of joint angles that each leg takes, at most.")
    ] = 27,
    as_json: Json = False,
) -> None:
    """Say from which ways to lie a robot can get up: by moving its joints slowly, and by the motions of a library.

    The slow way has no momentum: the robot rests on a face of its convex hull, and tips over an edge where its centre of mass
    has left the face. It takes tens of seconds, more with a larger N. Torque is not limited and nothing slips, so read "yes"
    as "the shape allows it". See docs/rightability.md.
    """
    from levade.cli.righting import tell_rightability

    tell_rightability(robot, slopes=slope, library=library, picture=map, angles=angles, as_json=as_json)


def _print_json(content: dict[str, Any]) -> None:
    print(json.dumps(content, ensure_ascii=False))


def _print_rows(rows: list[tuple[str, str]]) -> None:
    width = max(len(name) for name, _ in rows)
    for name, description in rows:
        print(f"{name:<{width}}  {description}")
