"""The state of the robot that a roll-out starts from, of one trial or of n."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError


@dataclass(frozen=True, eq=False)
class State:
    """Where trials start: one row for all of them, or a row for each.

    `levade.engines.Layout.state` makes one of MuJoCo's vectors alone.

    Attributes:
        qpos: Positions in the model's own order, shape (rows, nq).
        qvel: Velocities, shape (rows, nv).
        act: States of the actuators, shape (rows, na).
        joint_position: Joint angles [rad] in the robot's joint order, shape (rows, joints).
        joint_reference: What the joints were commanded last [rad], so that a motion can begin there without a jump,
            shape (rows, joints).

    Raises:
        LevadeError: If an array has no rows, or not as many as the others.
    """

    qpos: Array
    qvel: Array
    act: Array
    joint_position: Array
    joint_reference: Array

    def __post_init__(self) -> None:
        for name, values in self._arrays().items():
            if values.ndim != 2 or len(values) != len(self.qpos):
                raise LevadeError(f"state: {name} has the shape {values.shape}, should be (rows, size), as qpos's rows")

    def __len__(self) -> int:
        return len(self.qpos)

    def __getitem__(self, rows: int | slice | Sequence[int] | NDArray[np.integer | np.bool_]) -> State:
        """Some of the rows, in the order given; a row may be there several times."""
        if isinstance(rows, int):
            rows = [rows]
        return State(**{name: values[rows] for name, values in self._arrays().items()})

    def repeated(self, n: int) -> State:
        """The same state for n trials, if it is of one; itself if it is of n."""
        return self if len(self) == n else self[np.zeros(n, dtype=np.intp)]

    @classmethod
    def stacked(cls, states: Sequence[State]) -> State:
        """The rows of several states, one after another."""
        parts = [state._arrays() for state in states]
        return cls(**{one.name: np.concatenate([part[one.name] for part in parts]) for one in fields(cls)})

    def _arrays(self) -> dict[str, Array]:
        return {one.name: getattr(self, one.name) for one in fields(self)}
