"""Which motion works from where: what is known of the falls so far, and what follows for another one.

    knowledge = Knowledge.of(records)
    knowledge.ranked(up, joint_position)            # motions, the likeliest first, each with its probability

How a robot lies is which way is up for it, and where its joints are. A motion that works from the falls nearby is likely to
work here: each of them has a say by how near it is, and all falls together have one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.library.mirror import Mirror
from levade.library.records import Record, image_of

_JOINTS = 0.25
"""Of a difference of 1 rad in all joints, against one of 1 rad in attitude: a robot on its back has to roll over, however its
legs are, and its joints are elsewhere in a moment."""

_NEAREST, _LEAST_REACH = 8, 0.1
"""Falls whose distance is how far a fall reaches, and the least of it [rad]."""

_PRIOR = 0.5
"""Falls that the share of all of them counts as: what is known nearby soon outweighs it."""


@dataclass(frozen=True, eq=False)
class Knowledge:
    """Falls, motions, and which of these are known to work from which.

    Attributes:
        falls: Numbers of the falls, shape (n,).
        up: Which way is up in each, in trunk axes, shape (n, 3).
        joint_position: Joint angles in each [rad], shape (n, joints).
        motions: Numbers of the motions, shape (m,): `levade.library.records`.
        success: Whether each motion works from each fall: 1, 0, or NaN where it was not tried, shape (n, m).
        perturbed: The same on a robot that differs from the model, another one for each pair, shape (n, m).
        mirror: Of the robot, if its sides are alike. A motion's success is then its image's, from the image of the fall.
    """

    falls: Array
    up: Array
    joint_position: Array
    motions: NDArray[np.intp]
    success: Array
    perturbed: Array
    mirror: Mirror | None = None

    @classmethod
    def of(cls, records: Sequence[Record], mirror: Mirror | None = None) -> Knowledge:
        """What records say, of a robot with a mirror, if its sides are alike."""
        records = sorted(records, key=lambda record: record.fall)
        found = [record.fall for record in records if record.motion == record.fall]
        motions = np.array([*found, *(image_of(one) for one in found if mirror)], dtype=np.intp)
        column = {int(motion): j for j, motion in enumerate(motions)}
        success = np.full((len(records), len(motions)), np.nan)
        for i, record in enumerate(records):
            known = {motion: motion in record.worked for motion in record.tried}
            if record.motion is not None:
                known[record.motion] = True
            for motion in known.keys() & column.keys():  # the record of a motion may be lost
                success[i, column[motion]] = float(known[motion])
        joints = len(records[0].joint_position) if records else 0
        return cls(
            np.array([record.fall for record in records], dtype=int),
            np.array([record.up for record in records]).reshape(len(records), 3),
            np.array([record.joint_position for record in records]).reshape(len(records), joints),
            motions,
            success,
            np.full(success.shape, np.nan),
            mirror,
        )

    def merged(self, tables: Mapping[str, Array]) -> Knowledge:
        """The same, with what tables of the same shape say where nothing was known.

        Args:
            tables: "success" and "perturbed" -> table, NaN where it says nothing.
        """
        filled = {name: np.where(np.isnan(own := getattr(self, name)), table, own) for name, table in tables.items()}
        return replace(self, **filled)

    def distances(self, up: Array, joint_position: Array) -> Array:
        """How far a state is from each fall [rad], shape (n,): the angle between ways up, and a share of the joints'."""
        angle = np.arccos(np.clip(self.up @ up, -1.0, 1.0))
        joints = np.sqrt(((self.joint_position - joint_position) ** 2).mean(axis=1))
        return np.hypot(angle, _JOINTS * joints)

    def apart(self, up: Array, joint_position: Array) -> float:
        """How far a state is from the nearest fall, or image of one, that a motion was found for [rad]; infinite of none."""
        own = np.isin(self.falls, self.motions)
        if not own.any():
            return np.inf
        distance = self.distances(up, joint_position)[own]
        if self.mirror is not None:
            image = self.distances(self.mirror.up(up), self.mirror.posture(joint_position))[own]
            distance = np.minimum(distance, image)
        return float(distance.min())

    def probabilities(self, up: Array, joint_position: Array) -> Array:
        """How likely each motion works from a state, on the model or on a robot near it, shape (m,)."""
        if not len(self.motions):
            return np.zeros(0)
        distance = self.distances(up, joint_position)
        if self.mirror is not None:
            image = self.distances(self.mirror.up(up), self.mirror.posture(joint_position))
            distance = np.concatenate([distance, image])
        reach = max(_LEAST_REACH, float(np.sort(distance)[min(_NEAREST, len(distance)) - 1]))
        tried, worked = self._evidence
        near = np.exp(-((distance / reach) ** 2))
        n = len(self.falls)
        for_it, all_of_it = near[:n] @ worked, near[:n] @ tried
        share = (worked.sum(axis=0) + 1.0) / (tried.sum(axis=0) + 2.0)
        if self.mirror is not None:
            image = self._image
            for_it, all_of_it = for_it + near[n:] @ worked[:, image], all_of_it + near[n:] @ tried[:, image]
            share = (share + share[image]) / 2
        return (for_it + _PRIOR * share) / (all_of_it + _PRIOR)

    @cached_property
    def _evidence(self) -> tuple[Array, Array]:
        """How often each motion was tried from each fall, on the model and beside it, and how often it worked, shape (n, m)."""
        both = np.stack([self.success, self.perturbed])
        return (~np.isnan(both)).sum(axis=0), np.nansum(both, axis=0)

    @cached_property
    def _image(self) -> NDArray[np.intp]:
        """Column of each motion's image, shape (m,)."""
        order = np.argsort(self.motions)
        return order[np.searchsorted(self.motions, image_of(self.motions), sorter=order)]

    def ranked(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Motions and how likely each works from a state, the likeliest first."""
        probability = self.probabilities(up, joint_position)
        order = np.argsort(-probability, kind="stable")
        return [(int(self.motions[j]), float(probability[j])) for j in order]

    def cover(self) -> list[tuple[int, int]]:
        """The fewest motions that work from all falls that any works from, nearly: motions, each with how many falls it and
        those before it work from.

        Each is the one that works from most falls that those before it do not (greedy set cover, at most ln n + 1 times the
        fewest: V. Chvátal, A greedy heuristic for the set-covering problem, 1979).
        """
        works = self.success == 1.0
        left, chosen = works.any(axis=1), []
        while left.any():
            best = int(np.argmax((works & left[:, None]).sum(axis=0)))
            left = left & ~works[:, best]
            chosen.append((int(self.motions[best]), int(works.any(axis=1).sum() - left.sum())))
        return chosen
