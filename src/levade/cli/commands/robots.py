"""Commands of ``levade robots``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from levade.cli.commands.options import Json, RobotName

robots_app = typer.Typer(
    help="""List the robots; inspect one: a built-in name or your own file.

    \b
    levade robots
    levade robots inspect my.urdf
    Next: levade solve squat-jump --robot my.urdf
    """,
    rich_markup_mode=None,
)


@robots_app.callback(invoke_without_command=True)
def _list_robots(context: typer.Context, as_json: Json = False) -> None:
    from levade.cli.inspecting import list_robots

    if context.invoked_subcommand is None:
        list_robots(as_json=as_json)


@robots_app.command("inspect")
def _inspect_robot(
    robot: RobotName,
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


@robots_app.command("rightability")
def _robot_rightability(
    robot: RobotName,
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
