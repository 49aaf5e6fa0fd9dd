"""nevergrad's own choice of a method, NGOpt, over levade's kernel weights, in the environment of nevergrad."""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

import nevergrad
import numpy as np
import wire


class Nevergrad:
    def __init__(self, problem: dict[str, Any]) -> None:
        self.problem = problem
        self.population = problem["settings"]["population"]
        self.version = f"nevergrad {version('nevergrad')}"
        self.basis = None

    def start(self, mean: np.ndarray) -> None:
        array = nevergrad.p.Array(init=mean).set_mutation(sigma=self.problem["settings"]["step"])
        array.random_state.seed(self.problem["seed"])
        make = nevergrad.optimizers.registry[self.problem["settings"]["method"]]
        self.optimizer = make(parametrization=array, budget=self.problem["trials"], num_workers=self.population)

    def ask(self) -> np.ndarray:
        self.asked = [self.optimizer.ask() for _ in range(self.population)]
        return np.stack([candidate.value for candidate in self.asked])

    def tell(self, cost: np.ndarray) -> None:
        for candidate, value in zip(self.asked, cost, strict=True):
            self.optimizer.tell(candidate, float(value))


if __name__ == "__main__":
    wire.serve(Nevergrad)
