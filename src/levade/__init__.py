"""Whole-body, single-shot motions for legged robots by black-box optimisation in full rigid-body simulation.

    import levade

    result = levade.solve("rearing", seed=0)
    result.motion.save("rearing.npz")
    levade.check(result.motion)
    levade.show(result.motion)

Names are imported when they are first used, so that the command line starts fast.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from levade.version import __version__

if TYPE_CHECKING:
    from levade.api import Result, check, export, load_robot, pursue, show, solve, solve_many, stabilise
    from levade.costs import Criterion, Measure
    from levade.errors import LevadeError
    from levade.motions import Motion
    from levade.robots import Robot
    from levade.tasks import Cost, Task, load_task

_HOMES = {
    "Cost": "levade.tasks",
    "Criterion": "levade.costs",
    "LevadeError": "levade.errors",
    "Measure": "levade.costs",
    "Motion": "levade.motions",
    "Result": "levade.api",
    "Robot": "levade.robots",
    "Task": "levade.tasks",
    "check": "levade.api",
    "export": "levade.api",
    "load_robot": "levade.api",
    "load_task": "levade.tasks",
    "pursue": "levade.api",
    "show": "levade.api",
    "solve": "levade.api",
    "solve_many": "levade.api",
    "stabilise": "levade.api",
}

__all__ = [
    "Cost",
    "Criterion",
    "LevadeError",
    "Measure",
    "Motion",
    "Result",
    "Robot",
    "Task",
    "__version__",
    "check",
    "export",
    "load_robot",
    "load_task",
    "pursue",
    "show",
    "solve",
    "solve_many",
    "stabilise",
]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
        globals()[name] = value
        return value
    from levade.errors import did_you_mean

    raise AttributeError(f"module 'levade' has no attribute {name!r}; {did_you_mean(name, __all__)}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
