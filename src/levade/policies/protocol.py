"""The protocol of policies: what a policy of your own has to offer to a search.

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
    """A function from weights to joint references. A trial's bits should depend on its own weights alone, not on the batch."""

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
        """Find the weights around which a search begins.

        Args:
            posture: Last commanded posture [rad], shape (joints,).

        Returns:
            Weights, shape (size,).
        """
        ...

    def reference(self, weights: Array, *, hold_steps: int | None = None) -> JointReference:
        """Evaluate the joint references of weights.

        Args:
            weights: Weights of n trials, shape (n, size).
            hold_steps: Rows after the horizon. Defaults to the task's hold.

        Returns:
            References of n trials, horizon_steps + hold_steps rows.
        """
        ...
