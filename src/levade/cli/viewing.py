"""``levade view``: serve a page for a motion, a robot or a task, or write it to a file."""

from __future__ import annotations

import time
import webbrowser
from pathlib import Path

from rich.markup import escape

from levade.cli.picturing import progress_beside
from levade.cli.tables import make_console
from levade.cli.watching import tell_where
from levade.errors import LevadeError
from levade.motions import Motion
from levade.report.page import page as motion_page
from levade.report.page import save_page
from levade.search import make_objective
from levade.tasks import is_builtin
from levade.viewer.pages import view_page
from levade.viewer.server import LOOPBACK, Server
from levade.viewer.still import robot_data, task_data
from levade.viewer.subjects import Found, find


def view(name: str, *, out: Path | None, host: str | None, port: int | None, browse: bool) -> None:
    """Serve the page of a motion, robot or task until Ctrl-C, or write it.

    Args:
        name: Name of a built-in robot or task, or a file.
        out: File for the page. None serves it instead.
        host: Address to serve at. None for this machine only.
        port: Port to serve at. None or 0 for a free one.
        browse: Whether to open the page in the browser.

    Raises:
        LevadeError: If a file is given together with an address or a port, or the name is unknown.
    """
    if out is not None and (host is not None or port is not None):
        raise LevadeError(f"--out {out}: writes the page instead of serving it; leave out --host and --port")
    console = make_console()
    found = find(name)
    text = _page(found)
    if found.task is not None and is_builtin(name) and (Path(name) / "motion.npz").is_file():
        console.print(
            f"This is the built-in task. For the motion in {escape(name)}/: levade view {escape(name)}/motion.npz"
        )
    if out is not None:
        path = save_page(text, out, instead="give another file: --out FILE.html")
        console.print(f"To open in a browser: {escape(str(path))}")
        if browse:
            webbrowser.open(path.resolve().as_uri())
        return
    with Server(lambda: text, host=host or LOOPBACK, port=port or 0) as server:
        tell_where(console, server, "Look at it at")
        console.print("Ctrl-C ends it.")
        if browse:
            webbrowser.open(server.url)
        try:
            while True:
                time.sleep(3600)
        except KeyboardInterrupt:
            console.print()


def _page(found: Found) -> str:
    if found.motion is not None:
        motion = Motion.load(found.motion)
        return motion_page(motion, progress_csv=progress_beside(found.motion, motion), source=found.motion.name)
    if found.robot is not None:
        return view_page(found.robot.name, robot_data(found.robot))
    assert found.task is not None
    objective = make_objective(found.task)
    return view_page(f"{found.task.name} on {objective.robot.name}", task_data(objective))
