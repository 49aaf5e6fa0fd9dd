"""Simulate what the likeliest motion does from falls that no motion gets up from, so that a person can see why.

for failure in failures(library, most=3):
    failure.fall, failure.number, failure.motion, failure.missed
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from levade.costs import errors
from levade.library.asking import Library
from levade.library.plays import Plays, posed
from levade.library.storing import read_falls
from levade.motions import Motion
from levade.robots import Robot


@dataclass(frozen=True, eq=False)
class Failure:
    """Holds a motion that does not work from a fall.

    Attributes:
        fall: Number of the fall.
        number: Number of the motion (see `levade.library.records`).
        motion: What the robot does with it from this fall.
        missed: Criterion that it misses -> error, in the criterion's SI unit.
    """

    fall: int
    number: int
    motion: Motion
    missed: dict[str, float]


def failures(library: Library, *, most: int, robot: Robot | None = None) -> list[Failure]:
    """Play the likeliest motion from each of the first falls that no motion gets up from, on the model.

    Args:
        library: The library.
        most: Largest number of falls.
        robot: The robot. Defaults to the one that the task names.

    Returns:
        The failures, in the order of the falls; none if the library has no motions.

    Raises:
        LevadeError: If the library is damaged, or its robot cannot be loaded.
    """
    known = library.knowledge
    rows = np.flatnonzero(~(known.success == 1.0).any(axis=1))[:most]
    if not len(rows) or not len(known.motions):
        return []
    falls, _ = read_falls(library.directory, robot=robot)
    success = falls.judged.success
    plays = Plays(library.directory, falls.mirror)
    found = []
    for row in rows:
        fall, number = int(known.falls[row]), library.model.ranked(known.up[row], known.joint_position[row])[0][0]
        play = plays[number]
        objective, weights = posed(falls.objective(fall), play)
        done = objective.rollout(weights, feet=True).alone(0)
        assert done.foot_contact_force is not None
        arrays = {
            "qpos0": objective.state.qpos[0],
            "time": done.time,
            "joint_position": done.joint_position[0],
            "joint_position_reference": done.reference.position[0],
            "trunk_position": done.trunk_position[0],
            "trunk_quaternion": done.trunk_quaternion[0],
            "trunk_com_position": done.trunk_com_position()[0],
            "foot_contact_force": done.foot_contact_force[0],
        }
        off = {name: error[:1] for name, error in errors(success, done).items()}
        missed = {name: float(error[0]) for name, error in off.items() if not success[name].met(error)[0]}
        horizon = {"horizon_steps": done.horizon_steps, "horizon": done.horizon_steps * play.motion.timestep}
        motion = replace(play.motion, meta={**play.motion.meta, **horizon}, arrays={**play.motion.arrays, **arrays})
        found.append(Failure(fall, number, motion, missed))
    return found
