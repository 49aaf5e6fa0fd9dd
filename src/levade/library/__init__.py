"""Motion libraries, with which a robot gets up from any fall.

library = build(load_task("self-righting", robot="go1"), starts=100, directory=Path("falls"))
answer = library.ask(up, joint_position)        # a motion, and the probability that it works from there
check_library(library, starts=200, seed=1)      # on falls that the library has never seen
"""

from levade.library.asking import Answer, Library
from levade.library.building import Progress, build
from levade.library.checking import LibraryCheck, Share, check_library
from levade.library.falls import Falls
from levade.library.pursuing import Hardware
from levade.library.records import Method, Record

__all__ = [
    "Answer",
    "Falls",
    "Hardware",
    "Library",
    "LibraryCheck",
    "Method",
    "Progress",
    "Record",
    "Share",
    "build",
    "check_library",
]
