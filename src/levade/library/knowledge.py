"""Collect which motion works from which fall, and predict it for other states.

    knowledge = Knowledge.of(records)
    knowledge.ranked(up, joint_position)            # motions, the likeliest first, each with its probability

A lying pose is the upward direction in trunk axes and the joint angles. A motion that works from nearby falls is likely to work
here, too. Each fall counts by how near it is; the mean over all falls counts once (`levade.exports.asker.Model`).
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
    """Holds falls, motions, and which motion is known to work from which fall.

    Attributes:
        falls: Numbers of the falls, shape (n,).
        up: Upward direction in each fall, in trunk axes, shape (n, 3).
        joint_position: Joint angles in each fall [rad], shape (n, joints).
        motions: Numbers of the motions (see `levade.library.records`), shape (m,).
        success: Whether each motion works from each fall: 1, 0, or NaN if it was not tried, shape (n, m).
        perturbed: The same on a perturbed model, another one for each pair, shape (n, m).
        mirror: Mirror of the robot. None if the robot is not symmetric. With a mirror, a motion's success is also that of its
            image from the image of the fall.
        again: On how many further perturbed models each motion was tried when the fall was solved, and on how many it worked,
            shape (2, n, m). None for none.
    """

    falls: Array
    up: Array
    joint_position: Array
    motions: NDArray[np.intp]
    success: Array
    perturbed: Array
    mirror: Mirror | None = None
    again: Array | None = None

    @classmethod
    def of(cls, records: Sequence[Record], mirror: Mirror | None = None) -> Knowledge:
        """Collect what records say.

        Args:
            records: Records of the falls.
            mirror: Mirror of the robot. None if it is not symmetric.
        """
        records = sorted(records, key=lambda record: record.fall)
        found = [record.fall for record in records if record.motion == record.fall]
        motions = np.array([*found, *(image_of(one) for one in found if mirror)], dtype=np.intp)
        column = {int(motion): j for j, motion in enumerate(motions)}
        success = np.full((len(records), len(motions)), np.nan)
        again = np.zeros((2, *success.shape))
        for i, record in enumerate(records):
            known = {motion: motion in record.worked for motion in record.tried}
            if record.motion is not None:
                known[record.motion] = True
            for motion in known.keys() & column.keys():  # the record of a motion may be lost
                success[i, column[motion]] = float(known[motion])
            for motion in record.perturbed.keys() & column.keys():
                again[:, i, column[motion]] = record.perturbed[motion]
        joints = len(records[0].joint_position) if records else 0
        return cls(
            np.array([record.fall for record in records], dtype=int),
            np.array([record.up for record in records]).reshape(len(records), 3),
            np.array([record.joint_position for record in records]).reshape(len(records), joints),
            motions,
            success,
            np.full(success.shape, np.nan),
            mirror,
            again,
        )

    def merged(self, tables: Mapping[str, Array]) -> Knowledge:
        """Fill unknown entries from tables of the same shape.

        Args:
            tables: "success" and "perturbed" -> table, shape (n, m), NaN where it is unknown.

        Returns:
            New knowledge; known entries are kept.
        """
        filled = {name: np.where(np.isnan(own := getattr(self, name)), table, own) for name, table in tables.items()}
        return replace(self, **filled)

    @property
    def on_others(self) -> Array:
        """Share of all perturbed models on which each motion works from each fall; NaN if there was none, shape (n, m)."""
        if self.again is None:
            return self.perturbed
        tried, worked = self.again + np.stack([~np.isnan(self.perturbed), self.perturbed == 1.0])
        return np.divide(worked, tried, out=np.full(worked.shape, np.nan), where=tried > 0)

    @cached_property
    def model(self) -> Model:
        """The model that predicts for other states; an exported library contains it (`levade.exports.asker`).

        From each fall, all perturbed models of a motion count as one try, like the nominal model: if more tries counted for
        more, falls from which a motion works at all would outweigh the others.
        """
        both, none = np.stack([self.success, self.on_others]), self.mirror is None
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
        """Measure the distance of a state from each fall: the angle between upward directions, and a share of the joints'.

        Args:
            up: Upward direction in trunk axes, shape (3,).
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Distances [rad], shape (n,).
        """
        return self.model.distances(up, joint_position)

    def probabilities(self, up: Array, joint_position: Array) -> Array:
        """Predict how likely each motion works from a state, on the model or on a perturbed model.

        Args:
            up: Upward direction in trunk axes, shape (3,).
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Probabilities, shape (m,).
        """
        return self.model.probabilities(up, joint_position)

    def ranked(self, up: Array, joint_position: Array) -> list[tuple[int, float]]:
        """Rank the motions for a state.

        Args:
            up: Upward direction in trunk axes, shape (3,).
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Numbers of the motions and their probabilities, the likeliest first.
        """
        return self.model.ranked(up, joint_position)

    def apart(self, up: Array, joint_position: Array) -> float:
        """Measure the distance from a state to the nearest fall, or image of a fall, for which a motion was found.

        Args:
            up: Upward direction in trunk axes, shape (3,).
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Distance [rad]; infinite if no motion was found yet.
        """
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
        """Choose few motions that together work from every fall from which any motion works.

        Each one adds as many falls as possible to those before it (greedy set cover). The number of motions is at most
        ln n + 1 times the smallest one: V. Chvátal, A greedy heuristic for the set-covering problem, 1979.

        Returns:
            Numbers of the motions, each with the number of falls from which it or one before it works.
        """
        works = self.success == 1.0
        left, chosen = works.any(axis=1), []
        while left.any():
            best = int(np.argmax((works & left[:, None]).sum(axis=0)))
            left = left & ~works[:, best]
            chosen.append((int(self.motions[best]), int(works.any(axis=1).sum() - left.sum())))
        return chosen
