"""Optimizers: ask for candidates, tell their costs. They know nothing of robots.

optimizer = CMAES(mean, factor=factor, step=0.1, seed=0)
while ...:
    weights = optimizer.ask()              # (n, d)
    optimizer.tell(cost(weights))          # (n,)
"""

from __future__ import annotations

import inspect

from levade.optimizers.cem import CEM
from levade.optimizers.cmaes import CMAES
from levade.optimizers.levade import Levade
from levade.optimizers.mppi import MPPI
from levade.optimizers.pi2 import PI2, PI2CMA
from levade.optimizers.protocol import Informed, Optimizer
from levade.optimizers.random_search import RandomSearch

OPTIMIZERS = {
    "levade": Levade,
    "cma": CMAES,
    "pi2": PI2,
    "pi2-cma": PI2CMA,
    "mppi": MPPI,
    "cem": CEM,
    "random": RandomSearch,
}
"""Name on the command line and in task files -> class."""

_COMMON = ("mean", "factor", "step", "seed", "population", "ending", "one_sided")


def settings(optimizer: str) -> tuple[str, ...]:
    """Names of what one optimizer takes beside what all take."""
    return tuple(name for name in inspect.signature(OPTIMIZERS[optimizer]).parameters if name not in _COMMON)


def takes(optimizer: str, parameter: str) -> bool:
    """Whether it is to be told of something beside what all take: `Levade` of ``ending`` and ``one_sided``."""
    return parameter in inspect.signature(OPTIMIZERS[optimizer]).parameters


__all__ = [
    "CEM",
    "CMAES",
    "MPPI",
    "OPTIMIZERS",
    "PI2",
    "PI2CMA",
    "Informed",
    "Levade",
    "Optimizer",
    "RandomSearch",
    "settings",
    "takes",
]
