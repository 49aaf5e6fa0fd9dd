"""Give a task a cost and a criterion of your own, both Python functions, and keep the motion in a file.

The cost asks for slow joints. The criterion asks for knees that stay bent. The file names both functions but does not hold
them, so the motion can be loaded, replayed and shown anywhere.
"""

import argparse
from dataclasses import replace

import levade


def fastest(trajectories):
    """Largest joint speed of each trial, squared [rad^2/s^2], shape (n,)."""
    return (trajectories.joint_velocity**2).max(axis=(1, 2))


def straightest(trajectories, rows):
    """Angle of the knee that is nearest to straight [rad], shape (n, rows). Every third joint is a knee."""
    return abs(trajectories.joint_position[:, rows, 2::3]).min(axis=2)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
trials = parser.parse_args().trials

bent = levade.Criterion(levade.Measure("straightest_knee", "rad", straightest), minimum=0.1, at="min")
task = levade.load_task("rearing")
task = replace(
    task,
    costs={**task.costs, "fastest": levade.Cost(fastest, weight=0.01)},
    success={**task.success, "knees": bent},
)
result = levade.solve(task, trials=trials)
print(result)
print("nearest to straight is off by", result.motion.result.errors["knees"], "rad")

result.motion.save("own_cost.npz")
motion = levade.Motion.load("own_cost.npz")
print("the file says:", motion.meta["task"]["costs"]["fastest"])
print("the page is", levade.show(motion, "own_cost.html", browse=False))
