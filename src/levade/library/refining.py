"""An answer tried in simulation, and searched on for as long as there is time: from the very state, best first.

    refined = refine(library, up, joint_position, seconds=1.0)
    refined.reference.position                      # what to tell the joints

The likeliest motions are tried on the model; the first that works is tried on robots that differ. If it does not work on all of
them, or none works at all, a search goes on from the best until the time is up. How far that gets depends on the computer.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.engines import Fall, Perturbation, State, start_state
from levade.errors import LevadeError
from levade.library.asking import Library
from levade.library.falls import Falls, Plays, tried, tried_on_others
from levade.library.hardening import harden
from levade.library.storing import read_library
from levade.policies import JointPolicy
from levade.robots import Robot
from levade.search import Generation, InitialGuess, Objective, Stopped, solve_many
from levade.search.initial import AROUND
from levade.trajectory import JointReference

LIKELIEST = 5
"""Motions that are tried first."""

_ROBOTS = 8
"""Robots that differ, on which what works is tried."""

_SETTLING = 0.5
"""[s], for which a robot that is put down as it says it lies comes to rest."""


@dataclass(frozen=True, eq=False)
class Refined:
    """What to do from where the robot lies, as simulation has it.

    Attributes:
        number: Of the motion that it is, or began at.
        works: Whether it works on the model, from there.
        share: Of robots that differ, on which it works; 0 if it does not on the model.
        searched: Whether it was found by the search, and is no motion of the library.
        reference: What to tell the joints.
        trials: Roll-outs that this took.
        seconds: How long it took [s].
    """

    number: int
    works: bool
    share: float
    searched: bool
    reference: JointReference
    trials: int
    seconds: float


def refine(
    library: Library,
    up: Any,
    joint_position: Any,
    *,
    seconds: float,
    robot: Robot | None = None,
    threads: int = 0,
    seed: int = 0,
) -> Refined:
    """Try the first answers in simulation, and search on until the time is up.

    Args:
        library: The library.
        up: As `Library.ask` takes it.
        joint_position: As well.
        seconds: How long at most [s], once the simulation is built.
        robot: The library's robot, if the task's name does not say it.
        threads: Engine threads; 0 for one per core.
        seed: Seed of the search.

    Raises:
        LevadeError: If the question is wrong, or the robot cannot be put down as it lies.
    """
    answer = library.ask(up, joint_position)
    task, own = read_library(library.directory)
    falls = Falls(task, robot=robot, seed=own, threads=threads)
    objective = falls.from_state(_lying(falls, np.asarray(up, dtype=float), answer.joint_position))
    numbers = [answer.number, *(number for number, _ in answer.others)]
    return refined(falls, Plays(library.directory, falls.mirror), objective, numbers, seconds=seconds, seed=seed)


def refined(
    falls: Falls, plays: Plays, objective: Objective, numbers: Sequence[int], *, seconds: float, seed: int = 0
) -> Refined:
    """The same from a state that is simulated already.

    Args:
        falls: The library's simulation.
        plays: Its motions.
        objective: The task from the state.
        numbers: Motions, the likeliest first.
        seconds: How long at most [s].
        seed: Seed of the search.
    """
    if not seconds > 0:
        raise LevadeError(f"{seconds} s leave no time to refine; 1 is usual", field="refine")
    began = time.monotonic()
    likeliest = list(numbers[:LIKELIEST])
    found = tried([objective], [[plays[number] for number in likeliest]])[0]
    cost = found.cost({name: one.weight for name, one in objective.task.costs.items()})
    works = bool(found.success.any())
    best = int(np.argmax(found.success)) if works else int(np.argmin(cost))
    weights, trials, share, searched = plays[likeliest[best]].decisions(objective.policy), len(likeliest), 0.0, False

    def observe(number: int, generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if time.monotonic() - began > seconds else None

    if not works and time.monotonic() - began < seconds:
        guess = InitialGuess(weights, step=AROUND)
        solution = solve_many([objective], seeds=[seed], initial=[guess], observe=observe)[0]
        trials += solution.trials
        if solution.success:
            works = searched = True
            weights = solution.best.weights[None]
    if works:
        share = _share(objective, weights, seed)
        trials += _ROBOTS
        if share < 1.0 and time.monotonic() - began < seconds:
            better = harden([objective], [weights], seeds=[seed], observe=observe)[0]
            if better is not None:
                trials += better.trials
                now = _share(objective, better.best.weights[None], seed) if better.success else 0.0
                if now > share:
                    weights, share, searched = better.best.weights[None], now, True
    return Refined(
        number=likeliest[best],
        works=works,
        share=share,
        searched=searched,
        reference=objective.policy.reference(weights),
        trials=trials,
        seconds=time.monotonic() - began,
    )


def _share(objective: Objective, weights: Array, seed: int) -> float:
    """Of robots that differ, on how many weights work, shape (1, d)."""
    plays = dict.fromkeys(range(_ROBOTS), _Weights(weights))
    return float(tried_on_others(objective, plays, Perturbation(), seed=(seed, _ROBOTS)).mean())


@dataclass(frozen=True, eq=False)
class _Weights:
    """Weights to play, shape (1, d)."""

    weights: Array

    def decisions(self, policy: JointPolicy) -> Array:
        """The weights, whatever the policy."""
        return self.weights


def _lying(falls: Falls, up: Array, joints: Array) -> State:
    """The state of a robot that is put down as it lies, and comes to rest, its joints where they are."""
    up = up / np.linalg.norm(up)
    engine, robot, task = falls.simulation.engine, falls.simulation.robot, falls.task
    within = np.clip(joints, robot.limits.lower, robot.limits.upper)
    posture = dict(zip(robot.joint_names, within.tolist(), strict=True))
    fall = Fall(
        height=0.0,
        roll=float(np.arctan2(up[1], up[2])),
        pitch=float(-np.arcsin(np.clip(up[0], -1.0, 1.0))),
        posture=posture,
        gain=1.0,
        time=_SETTLING,
    )
    return start_state(engine, robot, task.scene, fall)
