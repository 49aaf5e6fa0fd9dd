"""Motions: the result of a search as a typed object, its file, and its simulation.

The room lies below the search, so a motion can be an input of another search.

    motion = Motion.load("motion.npz")
    replay_in("ode", motion).success
    ReferenceCurve.of(motion).at(time)
    RecordedSimulation(motion).rollout(sample)
"""

from levade.motions.file import ARRAYS, LATER, LATER_ARRAYS, META, SCHEMA
from levade.motions.motion import Motion, Provenance, Result, UnknownArray
from levade.motions.reference import ReferenceCurve
from levade.motions.simulation import RecordedSimulation, Replay, configurations, replay_in
from levade.motions.trials import Trials, run_again, run_trials
from levade.motions.versions import versions

__all__ = [
    "ARRAYS",
    "LATER",
    "LATER_ARRAYS",
    "META",
    "SCHEMA",
    "Motion",
    "Provenance",
    "RecordedSimulation",
    "ReferenceCurve",
    "Replay",
    "Result",
    "Trials",
    "UnknownArray",
    "configurations",
    "replay_in",
    "run_again",
    "run_trials",
    "versions",
]
