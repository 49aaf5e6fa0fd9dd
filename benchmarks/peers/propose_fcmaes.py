"""fcmaes' active CMA-ES in C++ over levade's kernel weights, in the environment of fcmaes."""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

import numpy as np
import wire
from fcmaes.cmaescpp import ACMA_C


class Fcmaes:
    def __init__(self, problem: dict[str, Any]) -> None:
        self.problem = problem
        self.population = problem["settings"]["population"]
        self.version = f"fcmaes {version('fcmaes')}"
        self.basis = None

    def start(self, mean: np.ndarray) -> None:
        self.optimizer = ACMA_C(
            mean.size,
            None,
            mean,
            self.problem["settings"]["step"],
            popsize=self.population,
            max_evaluations=10**9,
            stop_hist=0,
            normalize=False,
            rg=np.random.Generator(np.random.PCG64(self.problem["seed"])),
        )

    def ask(self) -> np.ndarray:
        asked = self.optimizer.ask()
        assert asked is not None
        return np.asarray(asked)

    def tell(self, cost: np.ndarray) -> None:
        self.optimizer.tell(cost)


if __name__ == "__main__":
    wire.serve(Fcmaes)
