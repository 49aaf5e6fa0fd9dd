"""Asking a library: from how the robot lies to the motion that most likely gets it up, without a simulator.

library = Library.load(Path("falls"))
answer = library.ask(up, joint_position)
answer.motion, answer.probability
answer.reference                                # what to tell the joints, from where they are
"""

from __future__ import annotations

import zipfile
import zlib
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.document import read_yaml
from levade.errors import LevadeError
from levade.exports.asker import Learned, Model, unpacked
from levade.library.knowledge import Knowledge
from levade.library.mirror import Mirror
from levade.library.records import FALLS, Record, motion_path
from levade.motions import Motion
from levade.trajectory import JointReference

LIBRARY = "library.yaml"
"""Seed and number of falls, and the robot's mirror."""

LEARNED = "learned.npz"
"""What was learned from the falls, if anything."""

SUCCESS = "success.npz"
"""Which motion works from which fall, once a build has come to its end."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What to do from where the robot lies.

    Attributes:
        number: Of the motion: `levade.library.records`.
        probability: How likely it works.
        others: The other motions and how likely each works, the likeliest first.
        path: File of the motion, or of the one that it is the image of.
        joint_position: Where the reference begins [rad], shape (joints,): where the joints are, or were commanded to fold to.
        mirror: What it is the image in; None if it is the motion itself.
    """

    number: int
    probability: float
    others: tuple[tuple[int, float], ...]
    path: Path
    joint_position: Array
    mirror: Mirror | None = None

    @cached_property
    def motion(self) -> Motion:
        """The motion as it was found, from its own fall, not mirrored."""
        return Motion.load(self.path)

    @cached_property
    def reference(self) -> JointReference:
        """What to tell the joints: the motion, from where they are now."""
        motion = self.motion
        policy = motion.policy
        if policy is None:
            raise LevadeError(f"{self.path}: has no policy that could begin elsewhere; build the library again")
        if policy.ends is not None:
            policy = replace(policy, ends=replace(policy.ends, start=self.joint_position))
        weights = motion["weights"][None]
        if self.mirror is not None:
            image = self.mirror.decisions(policy, weights)
            if image is None:
                raise LevadeError(f"{self.path}: has no image in this library's mirror; build the library again")
            weights = image
        return policy.reference(weights)


@dataclass(frozen=True, eq=False)
class Library:
    """Motions for a family of falls, and which works from which.

    Attributes:
        directory: Where it is.
        records: The falls, in order.
        knowledge: What they say.
        fold: Where the robot's joints go first, before it asks [rad], shape (joints,); None if it asks as it fell.
        learned: What it answers by, if it was learned from these very falls and motions; else it is what is nearby.
    """

    directory: Path
    records: tuple[Record, ...]
    knowledge: Knowledge
    fold: Array | None = None
    learned: Learned | None = None

    @classmethod
    def load(cls, directory: str | Path) -> Library:
        """Load a library, also one whose build goes on.

        Raises:
            LevadeError: If there is none, or it is damaged.
        """
        directory = Path(directory)
        place = directory / LIBRARY
        if not place.is_file():
            raise LevadeError(f"{directory}: holds no motion library; build one, or give its directory")
        records = tuple(Record.load(path) for path in sorted((directory / FALLS).glob("[0-9]*.json")))
        content = read_yaml(place)
        mirror = Mirror.from_json(content.get("mirror"), where=str(place))
        knowledge = Knowledge.of(records, mirror)
        fold = _read_fold(content.get("fold"), where=str(place))
        learned = _read_learned(directory / LEARNED, knowledge)
        return cls(directory, records, knowledge.merged(read_success(directory, knowledge)), fold, learned)

    def ask(self, up: Any, joint_position: Any) -> Answer:
        """Which motion to play.

        Args:
            up: Which way is up in trunk axes, of any length, shape (3,): an accelerometer's reading at rest, once the robot has
                folded up if the library has a `fold`.
            joint_position: Angles [rad] in the robot's joint order, shape (joints,).

        Raises:
            LevadeError: If a shape is wrong, not all are finite numbers, or there is no motion yet.
        """
        if not len(self.knowledge.motions):
            falls = len(self.records)
            raise LevadeError(f"{self.directory}: no motion was found for any of its {falls} falls; build it further")
        up, joints = self._checked(up, joint_position)
        (number, probability), *others = self.model.ranked(up, joints)
        mirror = self.knowledge.mirror if number < 0 else None
        begins = joints if self.fold is None else self.fold
        return Answer(number, probability, tuple(others), motion_path(self.directory, number), begins, mirror)

    @property
    def model(self) -> Model | Learned:
        """What it answers by."""
        return self.learned or self.knowledge.model

    def _checked(self, up: Any, joint_position: Any) -> tuple[Array, Array]:
        up, joints = np.asarray(up, dtype=float), np.asarray(joint_position, dtype=float)
        size = self.knowledge.joint_position.shape[1]
        if up.shape != (3,) or not np.isfinite(up).all() or not np.linalg.norm(up) > 0:
            raise LevadeError("up: should be three numbers, which way is up in trunk axes, such as [0, 0, 1] upright")
        if joints.shape != (size,) or not np.isfinite(joints).all():
            raise LevadeError(f"joint_position: {joints.size} numbers, should be the angles of {size} joints [rad]")
        return up / np.linalg.norm(up), joints

    @property
    def coverage(self) -> float:
        """Share of its falls that one of its motions works from; 0 of none."""
        if not self.records:
            return 0.0
        return float((self.knowledge.success == 1.0).any(axis=1).mean())


def _read_fold(content: Any, *, where: str) -> Array | None:
    """Where the joints go first, of a library's file. Raises LevadeError unless it is a list of numbers, or nothing."""
    if content is None:
        return None
    try:
        fold = np.array(content, dtype=float)
    except (ValueError, TypeError):
        fold = np.full(1, np.nan)
    if fold.ndim != 1 or not np.isfinite(fold).all():
        raise LevadeError(f"{where}: fold: is no list of joint angles; the file is damaged")
    return fold


def _read_learned(place: Path, knowledge: Knowledge) -> Learned | None:
    """What was learned from these falls and motions; None if nothing was, or from others, which a build has added to.

    Raises:
        LevadeError: If the file is damaged.
    """
    if not place.is_file():
        return None
    try:
        model = unpacked(place.read_bytes())
        if not isinstance(model, Learned):
            raise ValueError
        falls = model.arrays.pop("falls")
    except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile, zlib.error):
        raise LevadeError(f"{place}: is damaged; remove it, or learn again") from None
    same = np.array_equal(falls, knowledge.falls) and np.array_equal(model.motions, knowledge.motions)
    return model if same else None


def read_success(directory: Path, knowledge: Knowledge) -> dict[str, Array]:
    """Which of the motions works from which of the falls, as far as a build wrote it.

    Returns:
        The tables ``success`` and ``perturbed`` of `Knowledge`, NaN where nothing was written, shape (n, m) each.

    Raises:
        LevadeError: If the file is damaged.
    """
    place = directory / SUCCESS
    tables = {name: np.full(knowledge.success.shape, np.nan) for name in ("success", "perturbed")}
    if not place.is_file():
        return tables
    try:
        with np.load(place, allow_pickle=False) as file:
            falls, motions, *written = (file[name] for name in ("falls", "motions", *tables))
        if any(one.shape != (len(falls), len(motions)) for one in written):
            raise ValueError
    except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile, zlib.error):
        raise LevadeError(f"{place}: is damaged; remove it, and build the library again") from None
    rows, here = np.intersect1d(knowledge.falls, falls, return_indices=True)[1:]
    columns, there = np.intersect1d(knowledge.motions, motions, return_indices=True)[1:]
    for table, one in zip(tables.values(), written, strict=True):
        table[np.ix_(rows, columns)] = one[np.ix_(here, there)]
    return tables
