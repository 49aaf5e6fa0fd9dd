"""Engines: physics behind one method, `Engine.rollout`. MuJoCo is the default; ODE is the other.

engine = make_engine(load_robot("hyq2max"), Scene(), Physics())
start = start_state(engine, robot, Scene(), Settled("neutral"))
trajectories = engine.rollout(start, policy.reference(weights))
"""

from levade.engines.clearance import SELF_DISTANCE
from levade.engines.engine import Engine
from levade.engines.layout import FOOT_CONTACT_FORCE, SELF_FORCE, Layout
from levade.engines.models import Models, perturbed_models
from levade.engines.mujoco import MujocoEngine
from levade.engines.perturbation import Perturbation, Sample
from levade.engines.physics import Ode, Physics
from levade.engines.placing import make_engine, model_xml, start_state
from levade.engines.start import Fall, Fallen, Fold, GivenState, Settled, Start
from levade.engines.state import State
from levade.engines.table import ENGINES, EngineKind, engine_kind

__all__ = [
    "ENGINES",
    "FOOT_CONTACT_FORCE",
    "SELF_DISTANCE",
    "SELF_FORCE",
    "Engine",
    "EngineKind",
    "Fall",
    "Fallen",
    "Fold",
    "GivenState",
    "Layout",
    "Models",
    "MujocoEngine",
    "Ode",
    "Perturbation",
    "Physics",
    "Sample",
    "Settled",
    "Start",
    "State",
    "engine_kind",
    "make_engine",
    "model_xml",
    "perturbed_models",
    "start_state",
]
