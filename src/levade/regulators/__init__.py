"""Regulators: gains from sensor readings to corrections of the joint references, along one motion.

    along = linearised(engine, start, reference, perturbed=(starts, models), rate=250.0)
    feedback = along.feedback(Design())

`levade.stabilisers` chooses among such designs for a recorded motion. A search with ``feedback`` makes them along its best
motion.
"""

from __future__ import annotations

from levade.regulators.along import Along, linearised
from levade.regulators.design import Design
from levade.regulators.linear import Linear, linearise
from levade.regulators.quadratic import project, steady, sweep

__all__ = ["Along", "Design", "Linear", "linearise", "linearised", "project", "steady", "sweep"]
