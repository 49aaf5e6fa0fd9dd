"""Replay a motion file with MuJoCo and NumPy only, and compare with what the file says. Nothing here imports levade.

    python examples/replay.py rearing/motion.npz

Without a file, the command line makes one first.
"""

import argparse
import subprocess
import sys

import mujoco
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("motion", nargs="?", help="a motion file")
parser.add_argument("--trials", type=int, default=1200)
options = parser.parse_args()
if options.motion is None:
    options.motion = "replay/motion.npz"
    subprocess.run(
        [sys.executable, "-m", "levade", "solve", "rearing", "--trials", str(options.trials), "--out", "replay"]
    )

data = np.load(options.motion)
assets = {name[6:]: data[name].tobytes() for name in data if name.startswith("asset:")}
model = mujoco.MjModel.from_xml_string(str(data["model_xml"]), assets)
state = mujoco.MjData(model)
state.qpos[:], state.qvel[:], state.act[:] = data["qpos0"], data["qvel0"], data["act0"]

largest = 0.0
for ctrl, position, quaternion in zip(data["ctrl"], data["trunk_position"], data["trunk_quaternion"], strict=True):
    state.ctrl[:] = ctrl
    mujoco.mj_step(model, state)
    now = np.concatenate([position, quaternion])
    largest = max(largest, float(abs(state.qpos[:7] - now).max()))  # the trunk's free joint is the model's first
print(f"{len(data['ctrl'])} steps; the largest difference of the trunk's position and quaternion is {largest:g}")
