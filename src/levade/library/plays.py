"""Play motions from falls: on the nominal model, many falls in shared batches, or each on another perturbed model.

works = tried([falls.objective(4)], [[plays[0], plays[-1]]])[0].success
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines import Models, Perturbation, State, perturbed_models
from levade.library.mirror import Mirror
from levade.library.records import fall_of, motion_path
from levade.motions import Motion
from levade.policies import FreePolicy, JointPolicy
from levade.search.evaluation import Evaluation, Mask, Trials, joined
from levade.search.objective import AT_ONCE, Objective, Rollouts, evaluate_many, judge_together
from levade.search.outcome import Solution, Stopped, Trial
from levade.search.recording import record
from levade.tasks import PolicyChoice
from levade.trajectory import Trajectories

_TAG = 1_818_845_550
"""Part of a seed, so that perturbed models differ from those of searches and of checks of motions."""


@dataclass(frozen=True, eq=False)
class Play:
    """Holds a motion to play, or its mirror image.

    Attributes:
        motion: The motion.
        mirror: The mirror in which its image is played. None to play the motion itself.
    """

    motion: Motion
    mirror: Mirror | None = None

    @property
    def policy(self) -> PolicyChoice:
        """The motion's policy. Searches for hardware have several."""
        return self.motion.task.policy

    def decisions(self, policy: JointPolicy) -> Array:
        """Convert the motion to weights of a policy that differs from the motion's own only in its start.

        Args:
            policy: The policy.

        Returns:
            Weights, shape (1, d).
        """
        motion = self.motion
        weights = motion["weights"][None]
        if isinstance(policy, FreePolicy):
            own = motion.policy
            goal = None if policy.goal is None or own is None or own.ends is None else own.ends.goal
            weights = policy.decision(weights, steps=motion.horizon_steps, goal=goal)
        if self.mirror is None:
            return weights
        image = self.mirror.decisions(policy, weights)
        assert image is not None  # otherwise the library would have no mirror
        return image


class Playable(Protocol):
    """Can be played from a fall: a motion, or weights."""

    @property
    def policy(self) -> PolicyChoice | None:
        """Policy that the weights belong to. None if it is that of the objective."""
        ...

    def decisions(self, policy: JointPolicy) -> Array:
        """Return the weights for a policy.

        Args:
            policy: The policy.

        Returns:
            Weights, shape (1, d).
        """
        ...


class Plays:
    """Maps numbers of motions (`levade.library.records`) to motions to play; reads each file once."""

    def __init__(self, directory: Path, mirror: Mirror | None) -> None:
        self._directory, self._mirror = directory, mirror
        self._motions: dict[int, Motion] = {}

    def learn(self, motions: Mapping[int, Motion]) -> None:
        """Take note of motions, instead of reading them.

        Args:
            motions: Number of a fall -> its motion.
        """
        self._motions.update(motions)

    def __getitem__(self, number: int) -> Play:
        fall = fall_of(number)
        if fall not in self._motions:
            self._motions[fall] = Motion.load(motion_path(self._directory, fall))
        return Play(self._motions[fall], None if number == fall else self._mirror)


def posed(objective: Objective, play: Playable) -> tuple[Objective, Array]:
    """Pose what is to be played from a fall.

    Args:
        objective: The task from that fall.
        play: What to play.

    Returns:
        The objective, with the policy of what is played, and the weights, shape (1, d).
    """
    own = _policy(objective, play)
    if own != objective.task.policy:
        objective = objective.with_task(replace(objective.task, policy=own))
    return objective, play.decisions(objective.policy)


def simulated(objective: Objective, play: Play) -> Motion:
    """Simulate a motion from a fall, as if a search had found it there.

    Args:
        objective: The task from that fall.
        play: The motion, or its mirror image.

    Returns:
        The motion from there.
    """
    own, weights = posed(objective, play)
    found = own.evaluate(Trials(weights, own.task.hold_steps))
    cost_weights = {name: one.weight for name, one in own.task.costs.items()}
    solution = Solution(
        best=Trial.of(weights[0], float(found.cost(cost_weights)[0]), found, 0),
        trials=0,
        generations=0,
        trials_to_success=None,
        diverged=0,
        stopped=Stopped.SUCCESS,
        cost_weights=cost_weights,
        changes=(),
    )
    return record(own, solution, seed=play.motion.provenance.seed)


def _policy(objective: Objective, play: Playable) -> PolicyChoice:
    """Return the policy of what is played. Only tasks that are judged on perturbed models, for hardware, have several."""
    own = None if objective.task.robust is None else play.policy
    return own or objective.task.policy


def _by_policy(objective: Objective, plays: Sequence[Playable]) -> list[tuple[Objective, list[int]]]:
    """Group what is played by its policy: objectives with that policy, and the indices of what it plays."""
    groups: list[tuple[Objective, list[int]]] = []
    for k, play in enumerate(plays):
        policy = _policy(objective, play)
        members = next((members for one, members in groups if one.task.policy == policy), None)
        if members is None:
            groups.append((posed(objective, play)[0], members := []))
        members.append(k)
    return groups


def tried_on_others(
    objectives: Sequence[Objective],
    plays: Sequence[Mapping[int, Playable]],
    perturbation: Perturbation,
    *,
    seeds: Sequence[tuple[int, ...]],
) -> list[Mask]:
    """Play motions from falls in shared batches, each on another perturbed model.

    Args:
        objectives: The task from each fall.
        plays: For each fall, number of a perturbed model -> what to play. A model depends on its own number and the seed only.
        perturbation: How far the models differ from the nominal one.
        seeds: Seed of the perturbed models of each fall.

    Returns:
        For each fall, whether each one works, shape (plays,).
    """
    found = [np.zeros(len(own), dtype=bool) for own in plays]
    together: dict[tuple[int, int, tuple[str, ...]], list[_Piece]] = {}
    for objective, own, seed, works in zip(objectives, plays, seeds, found, strict=True):
        numbers, playables = list(own), list(own.values())
        if not numbers:
            continue
        starts, models = others(objective, perturbation, numbers, seed=seed)
        for one, members in _by_policy(objective, playables):
            key = (id(one.engine), one.policy.horizon_steps, one.recorded)
            for first in range(0, len(members), AT_ONCE):
                rows = np.array(members[first : first + AT_ONCE])
                piece = _Piece(one, [playables[k] for k in rows], starts[rows], models[rows], works, rows)
                together.setdefault(key, []).append(piece)
    for pieces in together.values():
        for batch in _batches(pieces):
            made = _judged_together([(piece.objective, piece.rollouts) for piece in batch])
            for piece, one in zip(batch, made, strict=True):
                piece.works[piece.rows] = one.success
    return found


@dataclass(frozen=True, eq=False)
class _Piece:
    """Roll-outs from one fall: what to play, from where and on which models, and the rows of ``works`` that they fill in."""

    objective: Objective
    plays: Sequence[Playable]
    starts: State
    models: Models
    works: Mask
    rows: NDArray[np.intp]

    @property
    def rollouts(self) -> Rollouts:
        """The roll-outs."""
        weights = np.concatenate([play.decisions(self.objective.policy) for play in self.plays])
        return _on_others(self.objective, weights, self.starts, self.models)


def _batches(pieces: Sequence[_Piece]) -> Iterator[list[_Piece]]:
    """Group pieces so that no batch has more than `AT_ONCE` roll-outs; no piece has more."""
    batch: list[_Piece] = []
    for piece in pieces:
        if batch and sum(len(one.plays) for one in batch) + len(piece.plays) > AT_ONCE:
            yield batch
            batch = []
        batch.append(piece)
    yield batch


def others(
    objective: Objective, perturbation: Perturbation, numbers: Sequence[int], *, seed: tuple[int, ...]
) -> tuple[State, Models]:
    """Make perturbed models. Each depends on its own number only.

    Args:
        objective: The task from one fall.
        perturbation: How far the models differ from the nominal one.
        numbers: Numbers of the models.
        seed: Seed of the models.

    Returns:
        The start of each, and the models.
    """
    engine = objective.engine
    drawn = perturbation.draw(engine.model, engine.embodiment.joints, n=max(numbers) + 1, seed=(*seed, _TAG))
    return perturbed_models(engine.model, engine.layout, drawn[numbers], objective.state)


def judged_on_others(objective: Objective, weights: Array, starts: State, models: Models) -> Mask:
    """Play motions on perturbed models.

    Args:
        objective: The task.
        weights: Weights of the motions, shape (n, d).
        starts: Start of each.
        models: Model of each.

    Returns:
        Whether each one works, shape (n,).
    """
    (found,) = _judged_together([(objective, _on_others(objective, weights, starts, models))])
    return found.success


def _judged_together(asked: Sequence[tuple[Objective, Rollouts]]) -> Iterator[Evaluation]:
    """Judge roll-outs of one length on perturbed models, simulated in shared batches."""

    def judge(i: int, trajectories: Trajectories) -> Evaluation:
        objective = asked[i][0]
        return objective.judge(trajectories, objective.task.hold_steps, perturbed=True)

    return judge_together(asked, judge)


def _on_others(objective: Objective, weights: Array, starts: State, models: Models) -> Rollouts:
    """Make the roll-outs of weights on perturbed models. Until the first reference arrives, joints keep their last command."""
    reference = objective.policy.reference(weights, hold_steps=objective.task.hold_steps)
    return Rollouts(starts, replace(reference, before=objective.state.joint_reference[0]), models)


def tried(objectives: Sequence[Objective], plays: Sequence[Sequence[Playable]]) -> list[Evaluation]:
    """Play motions from falls in shared batches, on the nominal model.

    Args:
        objectives: The task from each fall.
        plays: What to play from each fall.

    Returns:
        One evaluation per fall.
    """
    asked, groups = [], []
    for objective, own in zip(objectives, plays, strict=True):
        groups.append(_by_policy(objective, own))
        for one, members in groups[-1]:
            weights = np.concatenate([own[k].decisions(one.policy) for k in members])
            asked.append((one, Trials(weights, one.task.hold_steps)))
    found = iter(evaluate_many(asked))
    return [_in_order([(next(found), members) for _, members in group]) for group in groups]


def _in_order(parts: Sequence[tuple[Evaluation, list[int]]]) -> Evaluation:
    """Join evaluations, each with the indices of its rows."""
    if len(parts) == 1:
        return parts[0][0]
    return joined([part for part, _ in parts], np.argsort(np.concatenate([members for _, members in parts])))
