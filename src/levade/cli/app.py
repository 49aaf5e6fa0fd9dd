"""The tree of commands, and what their errors become: one line on standard error, and an exit status."""

from __future__ import annotations

import atexit
import copy
import gc
import sys
from collections.abc import Callable, Sequence
from functools import cache
from typing import Annotated, Any

import typer

from levade.cli.commands.bench import bench, spread
from levade.cli.commands.checks import check, stabilise
from levade.cli.commands.doctor import doctor
from levade.cli.commands.library import completed, library_app
from levade.cli.commands.motions import export, show, view
from levade.cli.commands.robots import robots_app
from levade.cli.commands.solve import solve
from levade.cli.commands.tasks import tasks_app
from levade.cli.flags import in_flags
from levade.cli.output import lasting_output
from levade.errors import LevadeError, one_line
from levade.patience import on_long_wait

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


_INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""


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
    arguments = completed(spread(sys.argv[1:] if arguments is None else arguments))
    first = arguments[0] if arguments else ""
    try:
        with on_long_wait(_waiting(arguments)):
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
        status = _INTERRUPTED
    if status == _INTERRUPTED:  # typer returns it, too
        print("levade: interrupted", file=sys.stderr)
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


def _waiting(arguments: Sequence[str]) -> Callable[[str], None]:
    """Return what prints why a command waits, once for each reason. With --json it prints on a terminal only."""
    said: set[str] = set()

    def waiting(message: str) -> None:
        if message not in said and ("--json" not in arguments or sys.stderr.isatty()):
            print(f"levade: {one_line(message)}", file=sys.stderr)
        said.add(message)

    return waiting


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


for _function, _summary in (
    (solve, "Find a motion that does a task."),
    (show, "Summarise motions; write a page, pictures, figures."),
    (bench, "Compare optimizers over tasks, robots and seeds."),
    (check, "Say whether a motion can be trusted."),
    (stabilise, "Add a feedback to a motion."),
    (view, "Look at a motion, a robot or a task in the browser."),
    (export, "Write a motion for a robot or another tool."),
    (doctor, "Say what this computer has and what it lacks."),
):
    app.command(short_help=_summary)(_function)
for _group, _name in ((library_app, "library"), (tasks_app, "tasks"), (robots_app, "robots")):
    app.add_typer(_group, name=_name)
