"""Which motion works from where: what is known of the falls so far, and what follows for another one.

    knowledge = Knowledge.of(records)
    knowledge.ranked(up, joint_position)            # motions, the likeliest first, each with its probability

How a robot lies is which way is up for it, and where its joints are. A motion that works from the falls nearby is likely to
work here: each of them has a say by how near it is, and all falls together have one (`levade.exports.asker.Model`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.exports.asker import Model
from levade.library.mirror import Mirror
from levade.library.records import Record, image_of


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

    @cached_property
    def model(self) -> Model:
        """What follows for other states: `levade.exports.asker`, which goes with an exported library."""
        both, none = np.stack([self.success, self.perturbed]), self.mirror is None
        return Model(
            up=self.up,
            joint_position=self.joint_position,
            tried=(~np.isnan(both)).sum(axis=0).astype(float),
            worked=np.nansum(both, axis=0),
            motions=np.asarray(self.motions, dtype=np.int64),
            image=np.zeros(0, dtype=np.int64) if none else self._image.astype(np.int64),
            mirror_joints=np.zeros(0, dtype=np.int64) if self.mirror is None else self.mirror.joints.astype(np.int64),
            mirror_signs=np.zeros(0) if self.mirror is None else self.mirror.signs,
        )

    def distances(self, up: Array, joint_position: Array) -> Array:
        """How far a state is from each fall [rad], shape (n,): the angle between ways up, and a share of the joints'."""
        return self.model.distances(up, joint_position)

    def probabilities(self, up: Array, joint_position: Array) -> Array:
        """How likely each motion works from a state, on the model or on a robot near it, shape (m,)."""
        return self.model.probabilities(up, joint_position)

    def ranked(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Motions and how likely each works from a state, the likeliest first."""
        return self.model.ranked(up, joint_position)

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

    @cached_property
    def _image(self) -> NDArray[np.intp]:
        """Column of each motion's image, shape (m,)."""
        order = np.argsort(self.motions)
        return order[np.searchsorted(self.motions, image_of(self.motions), sorter=order)]

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
