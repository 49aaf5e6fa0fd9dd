"""What a library keeps of each fall: a file, written when the fall is done, whole or not at all.

Record.of(path)                 # falls/000012.json
write_record(directory, record)
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.document import read_text
from levade.errors import LevadeError
from levade.writing import write_text

FALLS, MOTIONS = "falls", "motions"


class Method(StrEnum):
    """How a fall was solved: by a motion that was there, a search around one, a search from nothing; or not."""

    KNOWN = "known"
    NEAR = "near"
    COLD = "cold"
    NONE = "none"


@dataclass(frozen=True, eq=False)
class Record:
    """A fall, and what came of it.

    Attributes:
        fall: Its number in the family.
        up: Which way is up, in trunk axes, shape (3,).
        joint_position: Angles [rad], shape (joints,).
        method: How it was solved.
        motion: Number of the motion that works from here, its own if it was searched for; None if none was found.
        trials: Roll-outs that this took.
        tried: Numbers of the motions that were there and were tried from here.
        worked: Those of them that work.
    """

    fall: int
    up: Array
    joint_position: Array
    method: Method
    motion: int | None
    trials: int
    tried: tuple[int, ...]
    worked: tuple[int, ...]

    @classmethod
    def load(cls, path: Path) -> Record:
        """Read a record.

        Raises:
            LevadeError: If it cannot be read, or is damaged.
        """
        try:
            content = json.loads(read_text(path))
            up, joints = (np.array(content[name], dtype=float) for name in ("up", "joint_position"))
            if up.shape != (3,) or joints.ndim != 1 or not (np.isfinite(up).all() and np.isfinite(joints).all()):
                raise ValueError
            motion = content["motion"]
            tried, worked = (tuple(int(one) for one in content[name]) for name in ("tried", "worked"))
            return cls(
                int(content["fall"]),
                up,
                joints,
                Method(content["method"]),
                None if motion is None else int(motion),
                int(content["trials"]),
                tried,
                worked,
            )
        except (ValueError, TypeError, LookupError, RecursionError, OverflowError):
            raise LevadeError(
                f"{path}: is no record of a fall, or damaged; remove it, and build the library again"
            ) from None

    def write(self, directory: Path) -> None:
        """Write the record into a library's directory. Raises OSError."""
        content = {
            "fall": self.fall,
            "up": self.up.tolist(),
            "joint_position": self.joint_position.tolist(),
            "method": self.method.value,
            "motion": self.motion,
            "trials": self.trials,
            "tried": list(self.tried),
            "worked": list(self.worked),
        }
        write_text(record_path(directory, self.fall), json.dumps(content) + "\n")


Number = TypeVar("Number", int, NDArray[np.intp])


def image_of(motion: Number) -> Number:
    """Number of a motion's mirror image; of the image of a motion, that of the motion."""
    return -1 - motion


def fall_of(motion: int) -> int:
    """Number of the fall that a motion, or the one that it is the image of, was found for."""
    return max(motion, image_of(motion))


def record_path(directory: Path, fall: int) -> Path:
    """Where the record of a fall is."""
    return directory / FALLS / f"{fall:06}.json"


def motion_path(directory: Path, motion: int) -> Path:
    """Where a motion is, or the one that it is the image of."""
    return directory / MOTIONS / f"{fall_of(motion):06}.npz"
