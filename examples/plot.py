"""Plot how a motion's pitch and height come to what the task asks for. Needs matplotlib."""

import argparse

import numpy as np
from matplotlib.figure import Figure

import levade

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--trials", type=int, default=1200)
motion = levade.solve("rearing", trials=parser.parse_args().trials).motion

w, x, y, z = motion["trunk_quaternion"].T
pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1, 1))
height = motion["trunk_com_position"][:, 2]

figure = Figure(figsize=(6, 5), layout="constrained")
upper, lower = figure.subplots(2, sharex=True)
for axes, name, values, unit in ((upper, "pitch", pitch, "rad"), (lower, "height", height, "m")):
    goal = motion.task.success[name].target
    axes.plot(motion["time"], values)
    axes.axhline(goal, color="grey", linestyle="--", label="goal")
    axes.set_ylabel(f"{name} [{unit}]")
    axes.legend()
    print(f"{name} ends at {values[-1]:.3f} {unit}, the goal is {goal:.3f} {unit}")
lower.set_xlabel("time [s]")
figure.savefig("plot.png")
