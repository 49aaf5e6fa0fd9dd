"""Try a motion on robots that differ from the model: heavier and lighter ones, chosen by hand, and some drawn at random.

`levade.check` does this with many more robots and judges them. Here it is done step by step.
"""

import argparse
from dataclasses import replace

import numpy as np

import levade
from levade.engines import Perturbation, perturbed_models

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
result = levade.solve("rearing", trials=parser.parse_args().trials)

objective, motion = result.objective, result.motion
engine, joints = objective.engine, objective.robot.embodiment.joints

masses = np.array([0.9, 0.95, 1.0, 1.05, 1.1])
nominal = Perturbation().nominal(engine.model, joints, n=len(masses))
by_mass = replace(nominal, values={**nominal.values, "mass": masses[:, None]})
drawn = Perturbation().draw(engine.model, joints, n=8, seed=0)

for name, sample in (("mass", by_mass), ("drawn", drawn)):
    starts, models = perturbed_models(engine.model, engine.layout, sample, objective.state)
    trajectories = engine.rollout(starts, motion.reference, models=models)
    errors = objective.judge(trajectories, objective.task.hold_steps).errors
    for mass, pitch, height in zip(sample.values["mass"][:, 0], errors["pitch"], errors["height"], strict=True):
        print(f"{name}: mass x {mass:.3f}, pitch off by {pitch:+.4f} rad, height by {height:+.4f} m")
