"""Three motions, each beginning where the last one ended: roll over, jump, rear up. Then all of them as one roll-out."""

import argparse

import levade
from levade.motions.chaining import chain
from levade.motions.simulation import RecordedSimulation

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=3000)
trials = parser.parse_args().trials

motions = []
for name in ("self-righting", "squat-jump", "rearing"):
    result = levade.solve(name, trials=trials, after=motions[-1] if motions else None)
    motions.append(result.motion)
    print(f"{name}: {result}")

start, reference = chain(motions)
whole = RecordedSimulation(motions[0]).engine.rollout(start, reference)
up = 1 - 2 * (whole.trunk_quaternion[0, :, 1:3] ** 2).sum(axis=-1)
ends = [sum(motion.steps for motion in motions[: i + 1]) for i in range(len(motions))]
for motion, end in zip(motions, ends, strict=True):
    print(f"after {motion.task_name}, at {end * motion.timestep:.1f} s: up {up[end - 1]:+.2f}, height", end=" ")
    print(f"{whole.trunk_position[0, end - 1, 2]:.2f} m, in its own file {motion['trunk_position'][-1, 2]:.2f} m")
