"""Commands of ``levade library``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Changes, Json, LibraryDirectory, LibraryThreads

library_app = typer.Typer(
    help="""Get a robot up from any fall: build, ask and check a library of motions.

    \b
    levade library build self-righting --robot go1 --starts 24 --out falls
    levade library check falls --starts 100
    levade library ask falls --state state.json
    levade library export falls --out falls-robot
    """,
    rich_markup_mode=None,
)


_ALONE = {"--ray": "auto"}
"""Options of ``library build`` that may stand alone -> the value that they have then."""


def completed(arguments: Sequence[str]) -> list[str]:
    """Rewrite ``library build --ray`` as ``library build --ray auto``, since no option of typer's may do without a value.

    Args:
        arguments: Arguments of any command.

    Returns:
        The arguments. Those of other commands stay as they are.
    """
    if list(arguments[:2]) != ["library", "build"]:
        return list(arguments)
    taken: list[str] = []
    for word, then in zip(arguments, [*arguments[1:], "-"], strict=True):
        taken.append(word)
        if word in _ALONE and then.startswith("-"):
            taken.append(_ALONE[word])
    return taken


@library_app.command("build")
def _build_library(
    task: Annotated[str, typer.Argument(help="Task of each motion: self-righting, or your own task.")],
    robot: Annotated[str | None, typer.Option(help="Robot instead of the task's: a name or a file.")] = None,
    starts: Annotated[int, typer.Option(help="Number of falls in all; a later build may add more.")] = 100,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the falls and of the searches.")] = 0,
    out: Annotated[Path | None, typer.Option(help="Directory to write; by default TASK-library.")] = None,
    changes: Changes = None,
    threads: LibraryThreads = 0,
    jobs: Annotated[int, typer.Option(min=1, help="Number of processes at a time, with one thread each.")] = 1,
    ray: Annotated[
        str | None,
        typer.Option(
            metavar="[ADDRESS]",
            help="Build on a Ray cluster: HOST:PORT of its head; without ADDRESS the one that runs here, or else a new one.",
        ),
    ] = None,
    shard: Annotated[
        str | None,
        typer.Option(metavar="I/N", help="Build only every N-th fall, from fall I (0 to N - 1); see library merge."),
    ] = None,
    hardware: Annotated[
        bool,
        typer.Option("--hardware", help="Keep every limit, succeed on perturbed robots, and certify each motion."),
    ] = False,
    trials: Annotated[
        int | None,
        typer.Option(help="With --hardware: most trials of the searches of one fall. [default: 6000]"),
    ] = None,
    demand: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME=VALUE",
            help="With --hardware: what certificates demand, as in levade check. Repeatable.",
        ),
    ] = None,
    as_json: Json = False,
) -> int:
    """Find a motion for each of many falls. Called again, it continues where it stopped.

    \b
    levade library build self-righting --robot go1 --starts 24 --out falls
    Next: levade library check falls

    With --hardware, motions keep the robot's limits, and each says whether it passes the certificate of levade check.

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
        ray=ray,
        shard=shard,
        hardware=hardware,
        trials=trials,
        demand=demand or [],
        as_json=as_json,
    )


@library_app.command("merge")
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


@library_app.command("learn")
def _learn_library(
    library: Annotated[Path, typer.Argument(metavar="DIR", help="A library that is built.")],
    as_json: Json = False,
) -> int:
    """Learn in several ways which motion works from which state. The library then answers in the best of these ways.

    It says how often the first answer is right.
    """
    from levade.cli.librarian import learn_library

    return learn_library(library, as_json=as_json)


@library_app.command("export")
def _export_library(
    library: LibraryDirectory,
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


@library_app.command("show")
def _show_library(
    library: LibraryDirectory,
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


@library_app.command("ask")
def _ask_library(
    library: LibraryDirectory,
    state: Annotated[
        Path | None, typer.Option(help="JSON or YAML: attitude (w-x-y-z) or up (in trunk axes), and joints.")
    ] = None,
    attitude: Annotated[
        str | None, typer.Option(metavar="W,X,Y,Z", help="Without --state: attitude of the trunk, a quaternion.")
    ] = None,
    up: Annotated[
        str | None, typer.Option(metavar="X,Y,Z", help="Instead of --attitude: upward direction in trunk axes.")
    ] = None,
    joints: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLES", help="Without --state: angles in the robot's joint order, or NAME=ANGLE,... [rad]."
        ),
    ] = None,
    reference: Annotated[Path | None, typer.Option(help="Write the joints' references to this file, as CSV.")] = None,
    refine: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Try the answer in simulation, and improve it for this time, such as 1s."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Say which motion most likely works from the state in which the robot lies. Only --refine simulates.

    \b
    levade library ask falls --state state.json
    levade library ask falls --up 0,0,-1 --joints 0,1.3,-2.6,0,1.3,-2.6,0,1.3,-2.6,0,1.3,-2.6

    Exit status: 0 there is an answer, 1 it does not work even after --refine, 2 the input is wrong.
    """
    from levade.cli.asking import ask_library

    sensed = {"attitude": attitude, "up": up, "joints": joints}
    return ask_library(library, state=state, sensed=sensed, reference=reference, refine=refine, as_json=as_json)


@library_app.command("check")
def _check_library(
    library: LibraryDirectory,
    starts: Annotated[int, typer.Option(help="Number of falls to try.")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="Seed of these falls; it should differ from the library's.")] = 1,
    refine: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Improve for this time each answer that does not work, such as 1s."),
    ] = None,
    threads: LibraryThreads = 0,
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
