"""Motion libraries: a robot that gets up however it fell.

library = build(load_task("self-righting", robot="go1"), starts=100, directory=Path("falls"))
answer = library.ask(up, joint_position)        # a motion, and how likely it works from there
check_library(library, starts=200, seed=1)      # on falls that it has never seen
"""

from levade.library.asking import Answer, Library
from levade.library.building import Progress, build
from levade.library.checking import LibraryCheck, Share, check_library
from levade.library.falls import Falls
from levade.library.records import Method, Record

__all__ = [
    "Answer",
    "Falls",
    "Library",
    "LibraryCheck",
    "Method",
    "Progress",
    "Record",
    "Share",
    "build",
    "check_library",
]
