"""How far an exported motion ends from itself when its player plays it on other drives than it was found with.

    python benchmarks/replay.py [--tasks rearing squat-jump] [--seeds 10]

Each motion is exported as csv and played in MuJoCo by the player.py of the export, from its start, with a ramp of 1 s, a
physics step a row, positions as far out as they were told. Drives: the simulated ones (torque-speed line, lag of 4 ms;
torque goes in by way of the position), ones that deliver what is commanded up to the torque limit, and these with half the
gains. Printed are median and largest distance, over the seeds, from what the motion has at its end: attitude (the angle
between the two) and height of the trunk; and the largest tracking error, which the player's tolerance has to allow.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory

import mujoco
import numpy as np

from levade.export import export, player
from levade.export.model import gains as gains_of
from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

TASKS = ("rearing", "posture-recovery", "squat-jump", "self-righting")
NEVER = 100.0
"""[rad], a tolerance that nothing is beyond."""
ROWS = (
    ("measured", "simulated", 1.0),
    ("measured", "ideal", 1.0),
    ("measured", "ideal", 0.5),
    ("commanded", "simulated", 1.0),
    ("commanded", "ideal", 1.0),
)


class Drives:
    """The robot of a motion in MuJoCo, on its own drives or on ideal ones."""

    def __init__(self, motion: Motion, kind: str) -> None:
        spec = mujoco.MjSpec.from_string(motion.model_xml, assets=dict(motion.assets))
        self.ideal = kind == "ideal"
        if self.ideal:
            for name, limit in zip(motion.joint_names, motion.embodiment.limits.torque, strict=True):
                actuator = spec.actuator(name)
                actuator.set_to_motor()
                actuator.ctrlspec, actuator.actdim = 0, -1
                actuator.forcerange = [-limit, limit]
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:], self.data.qvel[:] = motion["qpos0"], motion["qvel0"]
        self.data.act[:] = motion["act0"][: self.model.na]
        joints = [self.model.joint(str(name)) for name in motion.joint_names]
        self.qpos, self.qvel = ([int(j.qposadr[0]) for j in joints], [int(j.dofadr[0]) for j in joints])
        self.last = self.data.qpos.copy()

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos[self.qpos].copy(), self.data.qvel[self.qvel].copy()

    def write(self, position, velocity, torque, kp, kd) -> None:
        self.last = self.data.qpos.copy()  # the last command comes at the horizon
        if self.ideal:
            now, rate = self.read()
            self.data.ctrl[:] = kp * (position - now) + kd * (velocity - rate) + torque
        else:
            push = np.divide(torque, kp, out=np.zeros_like(kp), where=kp > 0)
            self.data.ctrl[0::2], self.data.ctrl[1::2] = position + push, velocity
        mujoco.mj_step(self.model, self.data)


def distance(motion: Motion, reference: str, drives: str, gain: float) -> tuple[float, float, float]:
    """[rad], [m], of attitude and height at the end; and the largest tracking error [rad]."""
    gains = {}
    if gain != 1.0:
        kp, kd = (values[0] for values in gains_of(motion.compiled(), motion["joint_names"].tolist()))
        gains = {"kp": kp * gain, "kd": kd * gain}
    robot = Drives(motion, drives)
    with TemporaryDirectory() as directory:
        export(motion, "csv", Path(directory), reference=reference, **gains)
        played = player.Motion.load(Path(directory) / "motion.csv")
    worst = player.play(
        played,
        robot,
        ramp=1.0,
        start_tolerance=NEVER,
        tolerance=NEVER,
        speed_tolerance=NEVER,
        clamp=False,
        wait=lambda instant: 0.0,
    )
    between = np.zeros(3)
    mujoco.mju_subQuat(between, robot.last[3:7], motion["trunk_quaternion"][-1])
    return float(np.linalg.norm(between)), abs(robot.last[2] - motion["trunk_position"][-1, 2]), worst


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=TASKS)
    parser.add_argument("--seeds", type=int, default=10)
    arguments = parser.parse_args()
    print(f"seeds 0 to {arguments.seeds - 1}, MuJoCo {mujoco.__version__}: median (largest)\n")
    print(
        "| task | references | drives | attitude [rad] | height [cm] | tracking error [rad] |\n|---|---|---|---|---|---|"
    )
    for task in arguments.tasks:
        objective = make_objective(load_task(task))
        motions = [record(objective, solve(objective, seed=seed), seed=seed) for seed in range(arguments.seeds)]
        for reference, drives, gain in ROWS:
            off = np.array([distance(motion, reference, drives, gain) for motion in motions])
            (turn, height, worst), (most_turn, most_height, most) = np.median(off, axis=0), off.max(axis=0)
            name = f"{drives}, half the gains" if gain != 1.0 else drives
            print(
                f"| `{task}` | {reference} | {name} | {turn:.3f} ({most_turn:.3f}) |"
                f" {100 * height:.1f} ({100 * most_height:.1f}) | {worst:.2f} ({most:.2f}) |",
                flush=True,
            )


if __name__ == "__main__":
    main()
