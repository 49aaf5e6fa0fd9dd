"""The served pages as text. Each contains its script and style."""

from __future__ import annotations

from typing import Any

from levade.report.page import assembled
from levade.viewer.server import TOKEN


def watch_page(task: str) -> str:
    """Return the page of a solve. Its data comes over the server's events.

    Args:
        task: Name of the task, for the title.

    Returns:
        The page, as HTML.
    """
    return assembled(f"{task}, solving", {"kind": "watch", "token": TOKEN}, "live")


def view_page(title: str, data: dict[str, Any]) -> str:
    """Return the page of a robot or a task: `levade.viewer.subjects`.

    Args:
        title: Title of the page.
        data: Description of the robot or the task, as JSON.

    Returns:
        The page, as HTML.
    """
    return assembled(title, {"kind": "view", **data}, "live")
