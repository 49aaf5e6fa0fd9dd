"""What the simulation sent to the joints, at any instant: the policy itself where the file's weights give it.

The reference that is in force from an instant t on is the policy at ``t + timestep``: at the end of the step that begins
at t, as `levade.policies` has it. After the horizon it stays, and its velocity is zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.export.interpolation import hermite, linear, locate
from levade.motion import Motion
from levade.policies import GaussianKernels

_SAME = 1e-9
"""[rad]: the policy of the weights is the motion's if it gives the recorded references to this."""


@dataclass(frozen=True, eq=False)
class Policy:
    """Eq. 3 with the weights of each joint. weights: (kernels, joints) [rad]. horizon: [s]."""

    kernels: GaussianKernels
    weights: Array
    horizon: float

    def __call__(self, time: Array) -> tuple[Array, Array]:
        """Position [rad] and velocity [rad/s], (rows, joints), at times (rows,) up to the horizon [s]."""
        basis, rate = self.kernels.basis(time, self.horizon)
        return basis @ self.weights, rate @ self.weights


def policy_of(motion: Motion) -> Policy | None:
    """The policy behind a motion's references, found from its weights and checked against them; None if it is another.

    Which joint has whose weights, and with which sign, is told by the references themselves: no robot is needed.
    """
    timestep, rows = float(motion.meta["timestep"]), motion.horizon_steps
    horizon = rows * timestep
    try:
        choice = motion.meta["task"]["policy"]
        kernels = GaussianKernels(choice["kernels"], choice["variance"], choice["time"])
        own = motion["weights"].reshape(-1, kernels.kernels)
    except (LookupError, TypeError, ValueError, LevadeError):
        return None
    if not len(own) or motion.horizon_steps < 1:
        return None
    basis, _ = kernels.basis(np.arange(1, rows + 1) * timestep, horizon)
    either = np.concatenate([own, -own])
    off = np.abs(motion["joint_position_reference"][:rows, :, None] - (basis @ either.T)[:, None, :]).max(axis=0)
    nearest = np.argmin(off, axis=1)
    if not off[np.arange(len(nearest)), nearest].max() <= _SAME:
        return None
    return Policy(kernels, either[nearest].T.copy(), horizon)


def commands(motion: Motion, time: Array) -> tuple[Array, Array, bool]:
    """References in force from each instant on: what was recorded, where a step begins there.

    time: (rows,) [s], from 0. Returns position [rad] and velocity [rad/s], (rows, joints), and whether what is between the
    recorded ones is the policy itself; else it is a cubic through them (`levade.export.interpolation.hermite`).
    """
    timestep, rows = float(motion.meta["timestep"]), motion.horizon_steps
    # after the last step the reference stays too
    position = np.concatenate([motion["joint_position_reference"], motion["joint_position_reference"][-1:]])
    velocity = np.concatenate([motion["joint_velocity_reference"], np.zeros((1, position.shape[1]))])
    interval, share = locate(time, timestep, len(position) - 1)
    stays = bool((position[rows:] == position[rows - 1]).all() and (velocity[rows:] == 0.0).all())
    policy = policy_of(motion) if stays else None
    if policy is not None:
        x, v = policy(np.minimum(time + timestep, policy.horizon))
    else:
        x, v = hermite(interval, share, position, velocity, timestep), linear(interval, share, velocity)
    if stays:
        after = interval >= rows - 1
        x[after], v[after] = position[rows - 1], 0.0
    at = np.flatnonzero(share % 1.0 == 0.0)
    step = interval[at] + (share[at] == 1.0)
    x[at], v[at] = position[step], velocity[step]
    return x, v, policy is not None
