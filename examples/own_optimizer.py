"""Search with your own optimizer: a class with ``ask`` and ``tell``.

This one is a (1 + n) evolution strategy. It draws candidates around the best so far, and widens or narrows its step with
success. Nothing else is needed: `levade.optimizers.protocol` says what an optimizer may add.
"""

import argparse

import numpy as np

import levade


class Climber:
    """Draws candidates around the best one so far."""

    def __init__(self, space, *, seed):
        self.space, self.random = space, np.random.default_rng(seed)
        self.best, self.cost, self.step = space.mean, np.inf, space.step

    def ask(self):
        """The next candidates, shape (n, d)."""
        noise = self.random.standard_normal((self.space.population or 12, self.space.factor.shape[1]))
        self.candidates = self.best + self.step * noise @ self.space.factor.T
        return self.candidates

    def tell(self, cost):
        """Learn from the cost of each candidate, shape (n,)."""
        first, better = int(np.argmin(cost)), np.min(cost) < self.cost
        if better:
            self.best, self.cost = self.candidates[first], cost[first]
        self.step *= 1.1 if better else 0.85


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
trials = parser.parse_args().trials

for optimizer in (Climber, "cma-aimed"):
    result = levade.solve("rearing", optimizer=optimizer, trials=trials)
    print(f"{getattr(optimizer, '__name__', optimizer)}: cost {result.motion.result.cost:.4g}, {result}")
