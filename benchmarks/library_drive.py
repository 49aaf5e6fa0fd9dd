"""An exported library against a simulated robot with delays: how often the loop of sensing, asking and playing gets it up.

    python benchmarks/library_drive.py LIBRARY --starts 50 --delay 0.004

The library is exported, and its own script does the rest, at full speed: fold, ask, play, look, ask again. The robot is MuJoCo
with the library's drives, from falls of another seed, as they lie before they fold up. What it is sent arrives late by the
delay, and so does what it senses.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from levade.engines import State
from levade.exports import asker, player
from levade.library import Library
from levade.library.exporting import export_library
from levade.library.falls import Falls
from levade.library.storing import read_library
from levade.tasks import StartChoice


class Delayed:
    """A robot in MuJoCo, one physics step a command; commands and readings are late by some steps each."""

    def __init__(self, falls: Falls, state: State, steps: int) -> None:
        self.engine, self._layout = falls.simulation.engine, falls.simulation.engine.layout
        self.joints = list(falls.simulation.robot.joint_names)
        self.model, self.data = self.engine.model, mujoco.MjData(self.engine.model)
        self.data.qpos[:], self.data.qvel[:], self.data.act[:] = state.qpos[0], state.qvel[0], state.act[0]
        still = np.zeros(len(self.joints))
        self._sent = deque([(state.joint_reference[0].copy(), still)] * (steps + 1), maxlen=steps + 1)
        self._seen = deque([self._now()] * (steps + 1), maxlen=steps + 1)

    def _now(self) -> tuple[np.ndarray, ...]:
        qpos, qvel, layout = self.data.qpos, self.data.qvel, self._layout
        rate = qvel[layout.root_qvel + 3 : layout.root_qvel + 6]
        parts = (qpos[layout.joint_qpos], qvel[layout.joint_qvel], qpos[layout.trunk_quaternion], rate)
        return tuple(part.copy() for part in parts)

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        return self._seen[0][:2]

    def read_trunk(self) -> tuple[np.ndarray, np.ndarray]:
        return self._seen[0][2:]

    def write(self, position, velocity, torque, kp, kd) -> None:
        if not kp.any():  # damped: the drives of this model hold, so they are told where they are
            position, velocity = self._now()[0], np.zeros_like(position)
        self._sent.append((position.copy(), velocity.copy()))
        self.data.ctrl[self._layout.ctrl_position], self.data.ctrl[self._layout.ctrl_velocity] = self._sent[0]
        mujoco.mj_step(self.model, self.data)
        self._seen.append(self._now())


def no_clock() -> Callable[[float], float]:
    return lambda instant: 0.0


def drive(library: Library, starts: int, *, seed: int, delay: float, attempts: int = 3) -> dict[str, object]:
    """How many of these falls the robot gets up from, in how many attempts, and why motions were stopped."""
    task, _ = read_library(library.directory)
    fallen = task.start.fallen
    assert fallen is not None
    falls = Falls(task, seed=seed, threads=1)
    before = replace(task, start=StartChoice(fallen=replace(fallen, fold=None)))
    lying = Falls(before, seed=seed, threads=1)
    steps = round(delay / task.physics.timestep)
    with tempfile.TemporaryDirectory() as folder:
        export_library(library, Path(folder))
        exported = asker.Library.load(folder)
    done, stopped, refused = [], [], 0
    for i in range(starts):
        state = lying.objective(i).state
        robot = Delayed(falls, state, steps)
        try:
            tried = asker.get_up(exported, robot, attempts=attempts, clamp=False, wait=no_clock)
        except player.Stopped as error:
            refused += 1
            stopped.append(str(error))
            continue
        stopped += [one.stopped for one in tried if one.stopped]
        height = float(robot.data.qpos[robot._layout.trunk_position][2])
        stands = not tried or tried[-1].stands
        done.append(len(tried) if stands and height > 0.6 * falls.simulation.robot.neutral_height else 0)
    counts = {str(k): sum(one == k for one in done) for k in range(1, attempts + 1)}
    return {"starts": starts, "delay": delay, "attempts": counts, "refused": refused, "stopped": stopped}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", type=Path)
    parser.add_argument("--starts", type=int, default=50)
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--delay", type=float, default=0.004, help="[s], of commands, and of readings")
    options = parser.parse_args()
    print(
        json.dumps(
            drive(Library.load(options.library), options.starts, seed=options.seed, delay=options.delay), indent=2
        )
    )


if __name__ == "__main__":
    main()
