"""Ask a library, without a simulator, for the motion that most likely gets the robot up from where it lies.

library = Library.load(Path("falls"))
answer = library.ask(up, joint_position)
answer.motion, answer.probability
answer.reference                                # joint references, from where the joints are
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
from levade.library.records import FALLS, Record, fall_of, motion_path
from levade.motions import Motion
from levade.trajectory import JointReference

LIBRARY = "library.yaml"
"""Name of the file that holds seed, number of falls, and the robot's mirror."""

LEARNED = "learned.npz"
"""Name of the file that holds the learned model, if there is one."""

SUCCESS = "success.npz"
"""Name of the file that holds which motion works from which fall; a build writes it at its end."""


@dataclass(frozen=True, eq=False)
class Answer:
    """Names the motion to play from where the robot lies.

    Attributes:
        number: Number of the motion (see `levade.library.records`).
        probability: Probability that it works.
        others: Numbers of the other motions and their probabilities, the likeliest first.
        path: File of the motion. For a mirror image it is the file of the original.
        joint_position: Joint angles at which the reference begins [rad], shape (joints,): the measured ones, or the
            commanded ones if the robot folds up first.
        mirror: The mirror, if the answer is the mirror image of a motion. None if it is the motion itself.
        failed: Demands of hardware that the motion's certificate fails; none if it passes. None in a library that demands
            nothing of hardware. The certificate is that of the motion from its own fall.
    """

    number: int
    probability: float
    others: tuple[tuple[int, float], ...]
    path: Path
    joint_position: Array
    mirror: Mirror | None = None
    failed: tuple[str, ...] | None = None

    @cached_property
    def motion(self) -> Motion:
        """The motion as it was found, from its own fall and not mirrored."""
        return Motion.load(self.path)

    @cached_property
    def reference(self) -> JointReference:
        """The motion's joint references, starting from where the joints are now.

        Raises:
            LevadeError: If the motion cannot start elsewhere, or has no mirror image.
        """
        motion = self.motion
        policy = motion.policy
        if policy is None:
            raise LevadeError(
                f"{self.path}: the motion has no policy, so it cannot start elsewhere; build the library again"
            )
        if policy.ends is not None:
            policy = replace(policy, ends=replace(policy.ends, start=self.joint_position))
        weights = motion["weights"][None]
        if self.mirror is not None:
            image = self.mirror.decisions(policy, weights)
            if image is None:
                raise LevadeError(
                    f"{self.path}: the motion has no image in this library's mirror; build the library again"
                )
            weights = image
        return policy.reference(weights)


@dataclass(frozen=True, eq=False)
class Library:
    """Holds motions for a family of falls, and which motion works from which fall.

    Attributes:
        directory: Directory of the library.
        records: The falls, in order; rare ones come last.
        knowledge: Outcomes of the motions, collected from the records.
        fold: Joint angles to which the robot folds up before it asks [rad], shape (joints,). None if it asks as it fell.
        learned: Learned model, if it was fitted to these very falls and motions. None if the library answers by the
            nearest falls.
        hardware: Whether motions have to keep the limits of hardware. A motion then works only if it does.
    """

    directory: Path
    records: tuple[Record, ...]
    knowledge: Knowledge
    fold: Array | None = None
    learned: Learned | None = None
    hardware: bool = False

    @classmethod
    def load(cls, directory: str | Path) -> Library:
        """Load a library, which may still be under construction.

        Args:
            directory: Directory of the library.

        Raises:
            LevadeError: If the directory holds no library, or the library is damaged.
        """
        directory = Path(directory)
        place = directory / LIBRARY
        if not place.is_file():
            raise LevadeError(f"{directory}: holds no motion library; build one, or give the directory of one")
        records = tuple(Record.load(path) for path in sorted((directory / FALLS).glob("[0-9]*.json")))
        content = read_yaml(place)
        mirror = Mirror.from_json(content.get("mirror"), where=str(place))
        knowledge = Knowledge.of(records, mirror)
        fold = fold_of(content.get("fold"), where=f"{place}: fold")
        learned = _read_learned(directory / LEARNED, knowledge)
        known = knowledge.merged(read_success(directory, knowledge))
        return cls(directory, records, known, fold, learned, content.get("hardware") is not None)

    def ask(self, up: Any, joint_position: Any) -> Answer:
        """Choose the motion to play.

        Args:
            up: Upward direction in trunk axes, of any length, shape (3,). An accelerometer's reading at rest is one. If the
                library has a `fold`, measure it after the robot has folded up.
            joint_position: Joint angles in the robot's joint order [rad], shape (joints,).

        Returns:
            The motion that most likely works from there.

        Raises:
            LevadeError: If a shape is wrong, a number is not finite, or the library has no motion yet.
        """
        if not len(self.knowledge.motions):
            falls = len(self.records)
            raise LevadeError(f"{self.directory}: no motion was found for any of its {falls} falls; continue the build")
        up, joints = self._checked(up, joint_position)
        (number, probability), *others = self.model.ranked(up, joints)
        mirror = self.knowledge.mirror if number < 0 else None
        begins = joints if self.fold is None else self.fold
        failed = self.failed_by(number)
        return Answer(number, probability, tuple(others), motion_path(self.directory, number), begins, mirror, failed)

    def failed_by(self, motion: int) -> tuple[str, ...] | None:
        """Return the demands of hardware that a motion's certificate fails; none if it passes, None if it has none.

        Args:
            motion: Number of the motion. The certificate of an image is that of the original.
        """
        return self.certificates.get(fall_of(motion))

    @cached_property
    def certificates(self) -> dict[int, tuple[str, ...]]:
        """Number of each motion with a certificate -> the demands that it fails, none if it passes.

        Falls without a motion that passes keep the one with the best certificate. It counts here, but answers only if it keeps
        the limits on the model.
        """
        return {record.fall: record.failed for record in self.records if record.failed is not None}

    @property
    def model(self) -> Model | Learned:
        """The model that ranks the motions: the learned one if there is one, else the nearest falls."""
        return self.learned or self.knowledge.model

    def _checked(self, up: Any, joint_position: Any) -> tuple[Array, Array]:
        up, joints = np.asarray(up, dtype=float), np.asarray(joint_position, dtype=float)
        size = self.knowledge.joint_position.shape[1]
        if up.shape != (3,) or not np.isfinite(up).all() or not np.linalg.norm(up) > 0:
            raise LevadeError(
                "up: should be three numbers, the upward direction in trunk axes, such as [0, 0, 1] when upright"
            )
        if joints.shape != (size,) or not np.isfinite(joints).all():
            raise LevadeError(f"joint_position: has {joints.size} numbers, should be the angles of {size} joints [rad]")
        return up / np.linalg.norm(up), joints

    @property
    def coverage(self) -> float:
        """Share of its falls, without the rare ones, from which at least one of its motions works; 0 without falls."""
        return self._coverage(rare=False)

    @property
    def rare_coverage(self) -> float:
        """Share of its rare falls (`levade.library.rarity`) from which at least one of its motions works; 0 without any."""
        return self._coverage(rare=True)

    def _coverage(self, *, rare: bool) -> float:
        which = np.array([record.rare == rare for record in self.records], dtype=bool)
        return float((self.knowledge.success == 1.0)[which].any(axis=1).mean()) if which.any() else 0.0


def fold_of(content: Any, *, where: str) -> Array | None:
    """Read the folded posture from a library's file.

    Args:
        content: What the file says.
        where: Name of the file and of the posture, for messages.

    Returns:
        Joint angles [rad], shape (joints,). None if the file names no posture.

    Raises:
        LevadeError: If they are not numbers.
    """
    if content is None:
        return None
    try:
        fold = np.array(content, dtype=float)
    except (ValueError, TypeError):
        fold = np.full(1, np.nan)
    if fold.ndim != 1 or not np.isfinite(fold).all():
        raise LevadeError(f"{where}: should be a list of joint angles; the file is damaged")
    return fold


def _read_learned(place: Path, knowledge: Knowledge) -> Learned | None:
    """Read the learned model; return None if there is none, or if a build has changed the falls or motions since.

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
        raise LevadeError(f"{place}: the file is damaged; remove it, or learn again") from None
    same = np.array_equal(falls, knowledge.falls) and np.array_equal(model.motions, knowledge.motions)
    return model if same else None


def read_success(directory: Path, knowledge: Knowledge) -> dict[str, Array]:
    """Read which motion works from which fall, as far as a build has written it.

    Args:
        directory: Directory of the library.
        knowledge: Names the falls and motions.

    Returns:
        The tables ``success`` and ``perturbed`` of `Knowledge`, shape (n, m) each, NaN where nothing was written.

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
        raise LevadeError(f"{place}: the file is damaged; remove it, and build the library again") from None
    rows, here = np.intersect1d(knowledge.falls, falls, return_indices=True)[1:]
    columns, there = np.intersect1d(knowledge.motions, motions, return_indices=True)[1:]
    for table, one in zip(tables.values(), written, strict=True):
        table[np.ix_(rows, columns)] = one[np.ix_(here, there)]
    return tables
