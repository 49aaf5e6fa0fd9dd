"""What a search needs of a policy: how to write one's own.

    class Sine:
        size, joints, horizon_steps = 2, 12, 150

        def initial_weights(self, posture): return np.zeros(2)
        def reference(self, weights, *, hold_steps=None): ...       # a JointReference

Give such an object, or a function ``(task, robot) -> policy``, to `levade.solve` as ``policy``.
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from levade.arrays import Array
from levade.trajectory import JointReference


@runtime_checkable
class JointPolicy(Protocol):
    """From weights to joint references. A trial's bits should depend on its own weights alone, not on the batch."""

    @property
    def size(self) -> int:
        """Number of weights, d."""
        ...

    @property
    def joints(self) -> int:
        """Number of the robot's joints."""
        ...

    @property
    def horizon_steps(self) -> int:
        """Rows of a reference up to the horizon."""
        ...

    def initial_weights(self, posture: Array) -> Array:
        """Weights around which a search begins.

        Args:
            posture: What the joints were commanded last [rad], shape (joints,).

        Returns:
            Shape (size,).
        """
        ...

    def reference(self, weights: Array, *, hold_steps: int | None = None) -> JointReference:
        """What weights ask of the joints.

        Args:
            weights: Shape (n, size).
            hold_steps: Rows after the horizon. Defaults to the task's hold.

        Returns:
            References of n trials, horizon_steps + hold_steps rows.
        """
        ...
