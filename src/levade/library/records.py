"""Records of falls: one file per fall, which is written as a whole when the fall is done.

Record.of(path)                 # falls/000012.json
write_record(directory, record)
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.document import read_text
from levade.errors import LevadeError
from levade.library.rarity import RARE, Lying
from levade.writing import write_text

FALLS, MOTIONS, CERTIFICATES = "falls", "motions", "certificates"


class Method(StrEnum):
    """Names how a fall was solved: by a known motion, by a search around one, by a search from nothing, or not at all.

    In a library for hardware, a fall is solved only by a motion whose certificate passes.
    """

    KNOWN = "known"
    NEAR = "near"
    COLD = "cold"
    NONE = "none"


@dataclass(frozen=True, eq=False)
class Record:
    """Describes a fall and how it was solved.

    Attributes:
        fall: Number of the fall in its family.
        up: Upward direction in trunk axes, shape (3,).
        joint_position: Joint angles [rad], shape (joints,).
        method: How the fall was solved.
        motion: Number of the motion that works from here; the fall's own number if a search found it. None if there is none.
        trials: Number of roll-outs that this took.
        tried: Numbers of the known motions that were tried from here.
        worked: Numbers of those that work.
        failed: Demands of hardware that the motion which a search found for this fall does not meet; none if its certificate
            passes. None if it has no certificate.
        perturbed: Number of a known motion that works -> how many perturbed models it was tried on, and on how many it worked.
        further: How the robot lies after further falls, which were dropped with this one (`levade.library.rarity`).
    """

    fall: int
    up: Array
    joint_position: Array
    method: Method
    motion: int | None
    trials: int
    tried: tuple[int, ...]
    worked: tuple[int, ...]
    failed: tuple[str, ...] | None = None
    perturbed: Mapping[int, tuple[int, int]] = field(default_factory=dict[int, tuple[int, int]])
    further: tuple[Lying, ...] = ()

    @property
    def rare(self) -> bool:
        """Whether the fall was chosen because it is rare, and not drawn as it comes."""
        return self.fall >= RARE

    @property
    def lying(self) -> Lying:
        """How the robot lies after this fall."""
        return Lying(self.fall, self.up, self.joint_position)

    @classmethod
    def load(cls, path: Path) -> Record:
        """Read a record.

        Args:
            path: File of the record.

        Raises:
            LevadeError: If the file cannot be read or is damaged.
        """
        try:
            content = json.loads(read_text(path))
            lying = _lying(content)
            motion = content["motion"]
            tried, worked = (tuple(int(one) for one in content[name]) for name in ("tried", "worked"))
            failed = content.get("failed")
            perturbed = {int(name): (int(n), int(k)) for name, (n, k) in content.get("perturbed", {}).items()}
            return cls(
                lying.fall,
                lying.up,
                lying.joint_position,
                Method(content["method"]),
                None if motion is None else int(motion),
                int(content["trials"]),
                tried,
                worked,
                None if failed is None else tuple(str(one) for one in failed),
                perturbed,
                tuple(_lying(one) for one in content.get("further", [])),
            )
        except (ValueError, TypeError, LookupError, AttributeError, RecursionError, OverflowError):
            raise LevadeError(
                f"{path}: is not the record of a fall, or is damaged; remove it, and build the library again"
            ) from None

    def write(self, directory: Path) -> None:
        """Write the record into a library's directory.

        Args:
            directory: Directory of the library.

        Raises:
            OSError: If the file cannot be written.
        """
        content = {
            **_told(self.lying),
            "method": self.method.value,
            "motion": self.motion,
            "trials": self.trials,
            "tried": list(self.tried),
            "worked": list(self.worked),
            **({} if self.failed is None else {"failed": list(self.failed)}),
            **({"perturbed": {str(motion): list(n) for motion, n in self.perturbed.items()}} if self.perturbed else {}),
            **({"further": [_told(one) for one in self.further]} if self.further else {}),
        }
        write_text(record_path(directory, self.fall), json.dumps(content) + "\n")


def _lying(content: Mapping[str, Any]) -> Lying:
    """Read how the robot lies. Raise ValueError, TypeError or LookupError if it is no such thing."""
    up, joints = (np.array(content[name], dtype=float) for name in ("up", "joint_position"))
    if up.shape != (3,) or joints.ndim != 1 or not (np.isfinite(up).all() and np.isfinite(joints).all()):
        raise ValueError
    return Lying(int(content["fall"]), up, joints)


def _told(lying: Lying) -> dict[str, Any]:
    return {"fall": lying.fall, "up": lying.up.tolist(), "joint_position": lying.joint_position.tolist()}


Number = TypeVar("Number", int, NDArray[np.intp])


def image_of(motion: Number) -> Number:
    """Return the number of a motion's mirror image; for an image, the number of the original.

    Args:
        motion: Number of a motion, or an array of numbers of any shape. It is negative for a mirror image.

    Returns:
        The other number, or an array of the same shape.
    """
    return -1 - motion


def fall_of(motion: int) -> int:
    """Return the number of the fall for which a motion was found; for a mirror image, that of the original.

    Args:
        motion: Number of a motion. It is negative for a mirror image.

    Returns:
        Number of the fall, from 0.
    """
    return max(motion, image_of(motion))


def record_path(directory: Path, fall: int) -> Path:
    """Return the path of a fall's record.

    Args:
        directory: Directory of the library.
        fall: Number of the fall, from 0.

    Returns:
        Path of the JSON file. It need not exist.
    """
    return directory / FALLS / f"{fall:06}.json"


def certificate_path(directory: Path, motion: int) -> Path:
    """Return the path of a motion's certificate; for a mirror image, that of the original.

    Args:
        directory: Directory of the library.
        motion: Number of the motion. It is negative for a mirror image.

    Returns:
        Path of the JSON file. It exists in a library for hardware only.
    """
    return directory / CERTIFICATES / f"{fall_of(motion):06}.json"


def motion_path(directory: Path, motion: int) -> Path:
    """Return the path of a motion's file; for a mirror image, that of the original.

    Args:
        directory: Directory of the library.
        motion: Number of the motion. It is negative for a mirror image.

    Returns:
        Path of the .npz file. It need not exist.
    """
    return directory / MOTIONS / f"{fall_of(motion):06}.npz"
