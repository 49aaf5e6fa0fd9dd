"""Engines: physics behind two methods, `start` and `rollout`. MuJoCo is the default.

engine = MujocoEngine(load_robot("hyq2max"), Scene(), Physics())
state = engine.start(Settled("neutral"))
trajectories = engine.rollout(state, policy.reference(weights))
"""

from levade.engines.mujoco import MujocoEngine
from levade.engines.physics import Physics
from levade.engines.start import Fall, Settled, Start, State

__all__ = ["Fall", "MujocoEngine", "Physics", "Settled", "Start", "State"]
