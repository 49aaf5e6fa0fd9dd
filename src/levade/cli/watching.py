"""``levade solve --watch``: serve a page next to the run."""

from __future__ import annotations

import time
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.markup import escape

from levade.errors import LevadeError
from levade.search import Objective

if TYPE_CHECKING:
    from levade.viewer.server import Server
    from levade.viewer.watching import Watch


@dataclass(frozen=True)
class Watching:
    """Options of the page.

    Attributes:
        host: Address to serve at.
        port: Port to serve at (0: a free one).
        browse: Whether to open the page in the browser.
        keep: Whether to serve the page after the search has ended, until Ctrl-C.
    """

    host: str
    port: int
    browse: bool
    keep: bool


def options(watch: bool, host: str | None, port: int | None, browse: bool, keep: bool) -> Watching | None:
    """Return the options of the page.

    Args:
        watch: Whether to show the page.
        host: Address to serve at. None if not given.
        port: Port to serve at (0: a free one). None if not given.
        browse: Whether to open the page in the browser.
        keep: Whether to serve the page after the search has ended, until Ctrl-C.

    Returns:
        The options, or None without --watch.

    Raises:
        LevadeError: If other options are given without --watch.
    """
    given = {"--watch-host": host, "--watch-port": port, "--open": browse or None, "--keep-open": keep or None}
    named = [name for name, value in given.items() if value is not None]
    if named and not watch:
        raise LevadeError(
            f"{' and '.join(named)} only {'work' if len(named) > 1 else 'works'} with --watch; add --watch"
        )
    return Watching(host or "127.0.0.1", port or 0, browse, keep) if watch else None


@contextmanager
def watched(
    chosen: Watching,
    console: Console,
    objective: Objective,
    *,
    seed: int,
    directory: Path,
    interrupted: Callable[[], bool],
) -> Iterator[Watch]:
    """Serve the page of a run within the context, and print its address. With ``keep`` it stays until Ctrl-C.

    Args:
        chosen: Options of the page.
        console: Console for the address and for messages.
        objective: Objective of the search.
        seed: Seed of the search.
        directory: Directory of the run.
        interrupted: Tells whether the keyboard asks to end.

    Yields:
        The watch, which takes the generations and the outcome.
    """
    from levade.viewer.pages import watch_page
    from levade.viewer.scenes import LiveScenes
    from levade.viewer.server import Server
    from levade.viewer.watching import Watch

    watch = Watch(objective, seed=seed, directory=directory, draw=LiveScenes(objective), interrupted=interrupted)
    page = watch_page(objective.task.name)
    with Server(lambda: page, events=watch.events, command=watch.command, host=chosen.host, port=chosen.port) as server:
        tell_where(console, server, "Watch it at")
        if chosen.browse:
            webbrowser.open(server.url)
        try:
            yield watch
        finally:
            watch.finish(None)  # changes nothing if it already knows the outcome
        if chosen.keep and not interrupted():
            console.print("The page stays until Ctrl-C.")
            while not interrupted():
                time.sleep(0.1)


def tell_where(console: Console, server: Server, what: str) -> None:
    """Print the page's address, and a warning if other machines can reach it.

    Args:
        console: Console to print on.
        server: Server of the page.
        what: Words before the address.
    """
    console.print(f"{what} [link={server.url}]{escape(server.url)}[/link]")
    if server.public:
        console.print(
            "[yellow]Other machines can reach this page[/]: anybody with its address can see it and use its buttons."
        )
