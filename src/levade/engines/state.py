"""The state of the robot at the start of a roll-out, for one trial or for n."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError


@dataclass(frozen=True, eq=False)
class State:
    """The start of trials: one row for all of them, or one row each.

    `levade.engines.Layout.state` makes one from MuJoCo's vectors.

    Attributes:
        qpos: Positions in the model's own order, shape (rows, nq).
        qvel: Velocities, shape (rows, nv).
        act: States of the actuators, shape (rows, na).
        joint_position: Joint angles in the robot's joint order [rad], shape (rows, joints).
        joint_reference: Last commands of the joints [rad], from which a motion can begin without a jump, shape (rows, joints).

    Raises:
        LevadeError: If an array has no rows, or another number of rows than the others.
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
        """Select rows, in the order given; a row may come several times."""
        if isinstance(rows, int):
            rows = [rows]
        return State(**{name: values[rows] for name, values in self._arrays().items()})

    def repeated(self, n: int) -> State:
        """Repeat a state of one row for n trials. A state of n rows is returned unchanged.

        Args:
            n: Number of trials.

        Returns:
            The state, n rows.
        """
        return self if len(self) == n else self[np.zeros(n, dtype=np.intp)]

    @classmethod
    def stacked(cls, states: Sequence[State]) -> State:
        """Join the rows of several states, in sequence.

        Args:
            states: States of the same robot, at least one.

        Returns:
            One state with all rows.
        """
        parts = [state._arrays() for state in states]
        return cls(**{one.name: np.concatenate([part[one.name] for part in parts]) for one in fields(cls)})

    def _arrays(self) -> dict[str, Array]:
        return {one.name: getattr(self, one.name) for one in fields(self)}
