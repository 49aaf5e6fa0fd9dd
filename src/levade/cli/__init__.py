"""The command line; the only room that prints. Exit status: 0 success, 1 no success, 2 wrong input."""

from levade.cli.app import main

__all__ = ["main"]
