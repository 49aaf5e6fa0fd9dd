"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Changes = Annotated[
    list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change a value of the task. Repeatable.")
]

Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, and nothing else, on standard output.")]

LibraryDirectory = Annotated[Path, typer.Argument(metavar="DIR", help="A library.")]

LibraryThreads = Annotated[int, typer.Option(min=0, help="Number of engine threads; 0 for one per core.")]

MotionFile = Annotated[Path, typer.Argument(metavar="MOTION", help="A motion.npz.")]

OpenPage = Annotated[bool, typer.Option("--open", help="Open the page in the browser.")]

RobotName = Annotated[str, typer.Argument(metavar="NAME|FILE", help="A name, or a file: URDF, MJCF or robot.yaml.")]

Threads = Annotated[
    int, typer.Option(min=0, help="Number of engine threads; 0 for one per core. No effect on the result.")
]
