"""Optimizers: ask for candidates, tell their costs. They know nothing of robots.

    optimizer = make_optimizer("cma-aimed", SearchSpace(mean, factor, step=0.1), seed=0)
    while ...:
        candidates = optimizer.ask()           # (n, d)
        optimizer.tell(cost(candidates))       # (n,)

`levade.optimizers.protocol` says how to write one's own.
"""

from __future__ import annotations

from levade.optimizers.aimed import AimedCMAES
from levade.optimizers.cem import CEM
from levade.optimizers.choice import (
    ALIASES,
    OPTIMIZERS,
    Choice,
    can_restart,
    canonical,
    make_optimizer,
    settings,
)
from levade.optimizers.cmaes import CMAES
from levade.optimizers.mppi import MPPI
from levade.optimizers.pi2 import PI2, PI2CMA
from levade.optimizers.protocol import Optimizer, UsesErrors
from levade.optimizers.random_search import RandomSearch
from levade.optimizers.space import SearchSpace

__all__ = [
    "ALIASES",
    "CEM",
    "CMAES",
    "MPPI",
    "OPTIMIZERS",
    "PI2",
    "PI2CMA",
    "AimedCMAES",
    "Choice",
    "Optimizer",
    "RandomSearch",
    "SearchSpace",
    "UsesErrors",
    "can_restart",
    "canonical",
    "make_optimizer",
    "settings",
]
