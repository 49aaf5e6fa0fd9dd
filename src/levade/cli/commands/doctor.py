"""The command ``levade doctor``."""

from __future__ import annotations

from typing import Annotated

import typer

from levade.cli.commands.options import Json
from levade.errors import LevadeError


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
