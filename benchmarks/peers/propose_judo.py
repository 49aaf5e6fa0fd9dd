"""judo-rai's optimizers: predictive sampling, MPPI and CEM, in the environment of judo-rai.

judo is a controller: it replans along a moving horizon, with a reward that a task of its own states, on MuJoCo 3.6, to which
its package is pinned and which cannot load levade's actuators (`pid` and `dcmotor` are of MuJoCo 4). So its optimizer classes
are used as they are, through the two methods that its controller calls, on one horizon from one state; the physics is levade's.

What is searched over is judo's own: a cubic spline through a few knots for each joint, which judo's `make_spline` gives.
Rewards are the negative costs over what the first mean costs, so that judo's temperatures mean something.
"""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

import numpy as np
import wire
from judo.optimizers import (
    MPPI,
    CrossEntropyMethod,
    CrossEntropyMethodConfig,
    MPPIConfig,
    PredictiveSampling,
    PredictiveSamplingConfig,
)
from scipy.interpolate import make_interp_spline

KINDS = {
    "judo-ps": (PredictiveSampling, PredictiveSamplingConfig),
    "judo-mppi": (MPPI, MPPIConfig),
    "judo-cem": (CrossEntropyMethod, CrossEntropyMethodConfig),
}


class Judo:
    """One of judo's optimizers over (nodes, joints)."""

    def __init__(self, problem: dict[str, Any]) -> None:
        np.random.seed(problem["seed"])  # noqa: NPY002 (what judo draws from)
        optimizer, config = KINDS[problem["peer"]]
        settings = dict(problem["settings"])
        self.joints, self.nodes = problem["joints"], settings["num_nodes"]
        self.optimizer = optimizer(config(**settings), self.joints)
        self.population = self.optimizer.num_rollouts
        self.version = f"judo-rai {version('judo-rai')}"
        self.basis = spline_basis(self.nodes, problem["rows"], problem["horizon"])
        self.scale: float | None = None

    def start(self, mean: np.ndarray) -> None:
        self.nominal = mean.reshape(self.joints, self.nodes).T

    def ask(self) -> np.ndarray:
        times = np.linspace(0, 1, self.nodes)
        self.optimizer.pre_optimization(times, times)
        self.knots = self.optimizer.sample_control_knots(self.nominal)
        return self.knots.transpose(0, 2, 1).reshape(len(self.knots), -1)

    def tell(self, cost: np.ndarray) -> None:
        if self.scale is None:
            self.scale = max(abs(float(cost[0])), 1e-9)  # the first candidate is the nominal one
        self.nominal = self.optimizer.update_nominal_knots(self.knots, -cost / self.scale)


def spline_basis(nodes: int, rows: int, horizon: float) -> np.ndarray:
    """(2, rows, nodes): what each knot contributes to a cubic spline at the end of each step, and its time derivative."""
    from judo.controller.controller import make_spline

    times = np.linspace(0, horizon, nodes)
    at = np.arange(1, rows + 1) * horizon / rows
    spline = make_interp_spline(times, np.eye(nodes), k=3)
    judos = make_spline(times, np.eye(nodes)[None], "cubic")(at)
    np.testing.assert_allclose(spline(at), np.asarray(judos).reshape(rows, nodes), atol=1e-9)
    return np.stack([spline(at), spline(at, 1)])


if __name__ == "__main__":
    wire.serve(Judo)
