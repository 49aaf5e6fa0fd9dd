"""Engines: physics behind two methods, `start` and `rollout`. MuJoCo is the default; ODE is the other.

engine = make_engine(load_robot("hyq2max"), Scene(), Physics())
state = engine.start(Settled("neutral"))
trajectories = engine.rollout(state, policy.reference(weights))
"""

from levade.engines.engine import Engine
from levade.engines.ensemble import Ensemble, Variations
from levade.engines.mujoco import MujocoEngine
from levade.engines.perturbation import Perturbation, Sample
from levade.engines.physics import Ode, Physics
from levade.engines.start import Fall, Settled, Start, State
from levade.robots import Robot
from levade.scenes import Scene

__all__ = [
    "Engine",
    "Ensemble",
    "Fall",
    "MujocoEngine",
    "Ode",
    "Perturbation",
    "Physics",
    "Sample",
    "Settled",
    "Start",
    "State",
    "Variations",
    "make_engine",
]


def make_engine(robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> Engine:
    """The engine that ``physics.engine`` names. Raises LevadeError if it needs what is not installed."""
    if physics.engine == "ode":
        from levade.engines.ode.engine import OdeEngine

        return OdeEngine(robot, scene, physics, threads=threads)
    return MujocoEngine(robot, scene, physics, threads=threads)
