"""Optimizers: ask for candidates, tell their costs. They know nothing of robots.

optimizer = CMAES(mean, factor=factor, step=0.1, seed=0)
while ...:
    weights = optimizer.ask()              # (n, d)
    optimizer.tell(cost(weights))          # (n,)
"""

from levade.optimizers.aim import Aim
from levade.optimizers.cmaes import CMAES
from levade.optimizers.protocol import Optimizer

OPTIMIZERS = {"cma": CMAES}
"""Name on the command line and in task files -> class."""

__all__ = ["CMAES", "OPTIMIZERS", "Aim", "Optimizer"]
