"""Costs: terms over Trajectories (eq. 5-7 of the paper), and success criteria. They need only numpy.

    terms = {
        "orientation": Orientation(pitch=-1.0472),
        "position": Position(z=0.9),
        "effort": Effort(),
        "joint_limits": JointLimitExcess(),
        "quiet": lambda trajectories: abs(trajectories.joint_velocity).max(axis=(1, 2)),
    }
    values = evaluate(terms, trajectories)                                    # name -> (n,), unweighted
    cost = total(values, {"orientation": 1e3, "position": 1e2, "effort": 0.1, "joint_limits": 1, "quiet": 0})
    won = Criterion("pitch", target=-1.0472, tolerance=0.05).holds(trajectories)

A term is a function that takes Trajectories and returns one number per trial, unweighted, in its own unit.
"""

from levade.costs.clearance import clearance_of
from levade.costs.contact import GroundContact, SelfContact
from levade.costs.duration import Duration
from levade.costs.effort import Effort
from levade.costs.evaluate import DIVERGED, HIGHEST, Term, evaluate, total
from levade.costs.limits import JointLimitExcess, ReferenceLimitExcess, SpeedLimitExcess, TorqueLimitExcess
from levade.costs.margins import Margins
from levade.costs.miss import Miss
from levade.costs.orientation import Orientation
from levade.costs.position import Position
from levade.costs.posture import Posture
from levade.costs.quantities import Measure, Quantity, unit_of
from levade.costs.success import Criterion, errors, success
from levade.costs.velocity import AngularVelocity, JointVelocity, LinearVelocity

__all__ = [
    "DIVERGED",
    "HIGHEST",
    "AngularVelocity",
    "Criterion",
    "Duration",
    "Effort",
    "GroundContact",
    "JointLimitExcess",
    "JointVelocity",
    "LinearVelocity",
    "Margins",
    "Measure",
    "Miss",
    "Orientation",
    "Position",
    "Posture",
    "Quantity",
    "ReferenceLimitExcess",
    "SelfContact",
    "SpeedLimitExcess",
    "Term",
    "TorqueLimitExcess",
    "clearance_of",
    "errors",
    "evaluate",
    "success",
    "total",
    "unit_of",
]
