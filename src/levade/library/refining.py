"""Refine an answer: try the likeliest motions in simulation from the exact state, and search on while there is time.

    refined = refine(library, up, joint_position, seconds=1.0)
    refined.reference.position                      # commanded joint positions

The likeliest motions are tried on the model. The first that works is tried on perturbed models. If it does not work on all of
them, or no motion works, a search continues from the best one until the time is up. The result depends on the computer's speed.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.engines import Fall, Perturbation, State, start_state
from levade.errors import LevadeError
from levade.library.asking import Library
from levade.library.falls import Falls
from levade.library.hardening import harden
from levade.library.plays import Play, Plays, posed, tried, tried_on_others
from levade.library.storing import read_falls
from levade.policies import JointPolicy
from levade.robots import Robot
from levade.search import Generation, InitialGuess, Objective, Stopped, solve_many
from levade.search.initial import AROUND
from levade.trajectory import JointReference

LIKELIEST = 5
"""Number of motions that are tried first."""

_ROBOTS = 8
"""Number of perturbed models on which a working motion is tried."""

_SETTLING = 0.5
"""Time in which the robot comes to rest after it is put down in the given pose [s]."""


@dataclass(frozen=True, eq=False)
class Refined:
    """Holds an answer that was refined in simulation.

    Attributes:
        number: Number of the library's motion that is the answer, or from which the search began.
        works: Whether the answer works on the model from this state.
        share: Share of perturbed models on which it works; 0 if it does not work on the model.
        searched: Whether the search found the answer. False if it is a motion of the library.
        reference: Joint references to command.
        trials: Number of roll-outs that this took.
        seconds: Time that this took [s].
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
        up: Upward direction in trunk axes, shape (3,); see `Library.ask`.
        joint_position: Joint angles [rad], shape (joints,); see `Library.ask`.
        seconds: Time limit, which starts when the simulation is built [s].
        robot: The library's robot. Defaults to the one that the task names.
        threads: Number of engine threads (0: one per core).
        seed: Seed of the search.

    Returns:
        The refined answer.

    Raises:
        LevadeError: If ``up`` or ``joint_position`` is invalid, or the robot cannot be put down in this pose.
    """
    answer = library.ask(up, joint_position)
    falls, _ = read_falls(library.directory, robot=robot, threads=threads)
    objective = falls.from_state(_lying(falls, np.asarray(up, dtype=float), answer.joint_position))
    numbers = [answer.number, *(number for number, _ in answer.others)]
    return refined(falls, Plays(library.directory, falls.mirror), objective, numbers, seconds=seconds, seed=seed)


def refined(
    falls: Falls, plays: Plays, objective: Objective, numbers: Sequence[int], *, seconds: float, seed: int = 0
) -> Refined:
    """Refine an answer from a state that is simulated already.

    Args:
        falls: Falls of the library, with its simulation.
        plays: Motions of the library.
        objective: The task from the state.
        numbers: Numbers of the motions, the likeliest first.
        seconds: Time limit [s].
        seed: Seed of the search.

    Returns:
        The refined answer.

    Raises:
        LevadeError: If the time limit is not positive.
    """
    if not seconds > 0:
        raise LevadeError(f"{seconds} s leave no time to refine; give a longer time, such as 1 s", field="refine")
    began = time.monotonic()
    likeliest = list(numbers[:LIKELIEST])
    found = tried([objective], [[plays[number] for number in likeliest]])[0]
    cost = found.cost({name: one.weight for name, one in objective.task.costs.items()})
    works = bool(found.success.any())
    best = int(np.argmax(found.success)) if works else int(np.argmin(cost))
    play, trials, share, searched = plays[likeliest[best]], len(likeliest), 0.0, False
    own, weights = posed(objective, play)

    def observe(number: int, generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if time.monotonic() - began > seconds else None

    if not works and time.monotonic() - began < seconds:
        guess = InitialGuess(weights, step=AROUND)
        solution = solve_many([_searching(falls, own, play)], seeds=[seed], initial=[guess], observe=observe)[0]
        trials += solution.trials
        if solution.success:
            works = searched = True
            weights = solution.best.weights[None]
    if works:
        share = _share(own, weights, seed)
        trials += _ROBOTS
        if share < 1.0 and time.monotonic() - began < seconds:
            better = harden([own], [weights], seeds=[seed], observe=observe)[0]
            if better is not None:
                trials += better.trials
                now = _share(own, better.best.weights[None], seed) if better.success else 0.0
                if now > share:
                    weights, share, searched = better.best.weights[None], now, True
    return Refined(
        number=likeliest[best],
        works=works,
        share=share,
        searched=searched,
        reference=own.policy.reference(weights),
        trials=trials,
        seconds=time.monotonic() - began,
    )


def _searching(falls: Falls, objective: Objective, play: Play) -> Objective:
    """Return the objective of a search around a motion; with demands of hardware, of a search within limits."""
    if falls.plan is None:
        return objective
    task = falls.plan.nearer(falls.plan.number_of(play.policy), play.motion.horizon)
    return objective.with_task(replace(task, policy=play.policy))


def _share(objective: Objective, weights: Array, seed: int) -> float:
    """Return the share of perturbed models on which weights of shape (1, d) work."""
    plays = dict.fromkeys(range(_ROBOTS), _Weights(weights))
    return float(tried_on_others([objective], [plays], Perturbation(), seeds=[(seed, _ROBOTS)])[0].mean())


@dataclass(frozen=True, eq=False)
class _Weights:
    """Holds weights to play, shape (1, d)."""

    weights: Array
    policy: None = None

    def decisions(self, policy: JointPolicy) -> Array:
        """Return the weights, whatever the policy."""
        return self.weights


def _lying(falls: Falls, up: Array, joints: Array) -> State:
    """Put the robot down in the given pose, hold its joints there, and let it come to rest."""
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
