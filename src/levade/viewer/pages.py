"""The pages that are served, as text: each is whole, its script and look in it."""

from __future__ import annotations

from typing import Any

from levade.report.page import assembled
from levade.viewer.server import TOKEN


def watch_page(task: str) -> str:
    """The page of a solve; the rest comes over the server's events."""
    return assembled(f"{task}, solving", {"kind": "watch", "token": TOKEN}, "live")


def view_page(title: str, data: dict[str, Any]) -> str:
    """The page of a robot or a task: `levade.viewer.subjects`."""
    return assembled(title, {"kind": "view", **data}, "live")
