"""Evaluate a motion's joint reference at any time, and at other time steps.

    curve = ReferenceCurve.of(motion)
    position, velocity = curve.at(np.array([0.1, 0.1005]))      # (2, joints) [rad], [rad/s]
    fine = curve.divided(4)                                     # a JointReference at a quarter of the time step

The curve is the policy itself if it is known, including its ends. The file holds it. For a file of layout 1 it comes from the
task and the robot's description, if these can be found. In both cases it is checked against the recorded rows. Without such a
policy, cubics join the rows with their velocities.

Instants are the policy's. At ``(k + 1) * timestep`` the curve equals row k, which holds during step k, as in `levade.policies`.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.motions.interpolation import hermite, hermite_rate, locate
from levade.motions.motion import Motion
from levade.policies import Policy
from levade.robots import Robot, load_robot
from levade.tasks.policy import make_policy
from levade.trajectory import JointReference

_SAME = 1e-9
"""Largest difference between a policy's references and the recorded ones [rad]."""


@dataclass(frozen=True, eq=False)
class ReferenceCurve:
    """Describes the reference of one trial at any time.

    Attributes:
        rows: The recorded reference.
        weights: Policy weights [rad], shape (d,).
        policy: The policy that gives the rows from the weights. None if it is not known.
    """

    rows: JointReference
    weights: Array
    policy: Policy | None

    @classmethod
    def of(cls, motion: Motion) -> ReferenceCurve:
        """Return the curve of a motion, with its policy if that is known and gives the recorded rows.

        Args:
            motion: The motion.

        Returns:
            The curve. Without such a policy, cubics join the recorded rows.
        """
        policy = motion.policy or _policy_of_task(motion)
        curve = cls(motion.reference, motion["weights"], policy)
        return curve if curve._fits() else replace(curve, policy=None)

    @property
    def source(self) -> str:
        """Source of the values between the rows: "policy" or "interpolation"."""
        return "interpolation" if self.policy is None else "policy"

    def at(self, time: Array) -> tuple[Array, Array]:
        """Evaluate the curve.

        Args:
            time: Instants [s], shape (rows,), from 0 to the horizon. Before the first row the cubics are extrapolated.

        Returns:
            Position [rad] and velocity [rad/s], shape (rows, joints) each.
        """
        if self.policy is not None:
            position, velocity = self.policy.at(self.weights[None], time)
            return position[0], velocity[0]
        rows, step = self.rows.horizon_steps, self.rows.timestep
        position, velocity = self.rows.position[0, :rows], self.rows.velocity[0, :rows]
        if rows == 1:
            return position.repeat(len(time), axis=0), np.zeros((len(time), position.shape[1]))
        place = np.asarray(time) / step - 1.0  # in steps, 0 at the first row
        left = np.clip(np.floor(place), 0, rows - 2).astype(np.intp)
        cubic = left, place - left, position, velocity, step
        return hermite(*cubic), hermite_rate(*cubic)

    def divided(self, parts: int) -> JointReference:
        """Return the reference at steps that are shorter by a whole factor.

        Every ``parts``-th row is a row of the motion.

        Args:
            parts: Number of steps in one step of the motion, at least 1.

        Returns:
            The reference of one trial, with ``parts`` times as many rows.
        """
        recorded = self.rows
        if parts == 1:
            return recorded
        rows, step = recorded.horizon_steps, recorded.timestep / parts
        hold_steps = (recorded.steps - rows) * parts
        if self.policy is not None and self.policy.slew is None:  # a slower reference is that of the motion's own rows
            # whole steps of the file: a horizon that is rounded to other steps would be another one
            horizon = rows * recorded.timestep
            fine = replace(self.policy, timestep=step, horizon=horizon, hold_steps=hold_steps)
            return replace(fine.reference(self.weights[None]), before=recorded.before)
        position, velocity = self.at(np.arange(1, rows * parts + 1) / parts * recorded.timestep)
        held_position, held_velocity = (
            np.repeat(values[0, rows:], parts, axis=0) for values in (recorded.position, recorded.velocity)
        )
        return JointReference(
            np.concatenate([position, held_position])[None],
            np.concatenate([velocity, held_velocity])[None],
            step,
            rows * parts,
            recorded.before,
        )

    def in_force(self, time: Array) -> tuple[Array, Array]:
        """Evaluate the commands to the joints at each instant of the motion. The curve is one step ahead of them.

        At the beginning of a step they equal the recorded row of that step. After the horizon the position stays, and the
        velocity is zero.

        Args:
            time: Instants [s], shape (rows,), from 0 to the end of the motion.

        Returns:
            Position [rad] and velocity [rad/s], shape (rows, joints) each.
        """
        recorded = self.rows
        rows, step = recorded.horizon_steps, recorded.timestep
        # after the last step the reference stays too
        position = np.concatenate([recorded.position[0], recorded.position[0, -1:]])
        velocity = np.concatenate([recorded.velocity[0], np.zeros((1, position.shape[1]))])
        interval, share = locate(time, step, recorded.steps)
        x, v = self.at(np.minimum(time + step, rows * step))
        held = interval >= rows - 1
        x[held], v[held] = position[interval[held]], 0.0
        begins = np.flatnonzero(share % 1.0 == 0.0)
        row = interval[begins] + (share[begins] == 1.0)
        x[begins], v[begins] = position[row], velocity[row]
        return x, v

    def _fits(self) -> bool:
        """Tell whether the policy takes the weights and gives the rows, including the hold."""
        policy, rows = self.policy, self.rows
        if policy is None or (policy.size, policy.joints) != (len(self.weights), rows.position.shape[2]):
            return False
        if policy.horizon_steps != rows.horizon_steps or policy.timestep != rows.timestep:
            return False
        try:
            own = policy.reference(self.weights[None], hold_steps=rows.steps - rows.horizon_steps)
        except LevadeError:  # weights that are no numbers, of a motion that broke down
            return False
        off = np.abs(own.position - rows.position).max(), np.abs(own.velocity - rows.velocity).max()
        return bool(off[0] <= _SAME and off[1] <= _SAME / rows.timestep)


def _policy_of_task(motion: Motion) -> Policy | None:
    """Make the policy of a motion whose file lacks it. None if the task or the robot cannot be read."""
    try:
        robot = described_robot(motion)
        policy = None if robot is None else make_policy(motion.task, robot, start=motion.reference.before)
    except LevadeError:
        return None
    return policy if isinstance(policy, Policy) else None


def described_robot(motion: Motion) -> Robot | None:
    """Return the robot's description, if it exists and has the motion's joints.

    Args:
        motion: The motion.

    Returns:
        The robot, or None.
    """
    choice = asdict(motion.task.robot)
    try:
        robot = load_robot(choice.pop("name"), **choice)
    except LevadeError:
        return None
    return robot if robot.joint_names == motion.joint_names else None
