"""The motion's linear model from tick to tick, by finite differences over whole ticks.

Differences are central, and as large as a robot's deviations (2 cm, 0.02 rad). So a contact that opens or closes within them
counts in proportion, unlike in derivatives at a point.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch

from levade.arrays import Array
from levade.engines import Layout, State
from levade.engines.batches import RESET_OFF, SENSORS_OFF, STATE, quiet
from levade.rotations import conjugate, rotate
from levade.trajectory import JointReference

UNSENSED = 4
"""Number of unsensed values of the trunk: height and velocity. The states of the actuators follow them."""


@dataclass(frozen=True, eq=False)
class Scales:
    """Sizes of deviations by kind of quantity, for a robot of 0.6 m.

    Attributes:
        attitude: Attitude [rad].
        joint: Joint angles [rad].
        height: Height [m].
        speed: Velocity of the trunk [m/s].
        rate: Angular velocity [rad/s].
        joint_speed: Joint velocities [rad/s].
        drive: Share of an actuator's largest state.
    """

    attitude: float
    height: float
    speed: float
    rate: float
    joint: float
    joint_speed: float
    drive: float = 0.05

    def sized(self, size: float) -> Scales:
        """Scale to a robot of a size: lengths in proportion, times like a pendulum's.

        Args:
            size: Approximate standing height of the robot [m].

        Returns:
            The scales for this robot.
        """
        f = size / 0.6
        return Scales(
            self.attitude,
            self.height * f,
            self.speed * f**0.5,
            self.rate / f**0.5,
            self.joint,
            self.joint_speed / f**0.5,
            self.drive,
        )

    def column(self, joints: int, drives: Array) -> Array:
        """Return the scale of each value of a state.

        Args:
            joints: Number of joints.
            drives: Largest state of each actuator, shape (drives,).

        Returns:
            Scales, shape (sensed + 4 + drives,), each in the unit of its value.
        """
        return np.concatenate(
            [
                np.repeat([self.attitude, self.rate], 3),
                np.repeat([self.joint, self.joint_speed], joints),
                [self.height],
                np.full(3, self.speed),
                self.drive * drives,
            ]
        )


STEPS = Scales(attitude=0.02, height=0.01, speed=0.05, rate=0.2, joint=0.02, joint_speed=0.3)
"""Sizes of the differences."""


@dataclass(frozen=True, eq=False)
class Linear:
    """A linear model ``x[k+1] = a[k] x[k] + b[k] c[k]`` from tick to tick.

    The last one is that of the motion's end, standing.

    x is the deviation of the sensed values, then of the trunk's height [m], its velocity in trunk axes [m/s], and the
    actuators' states. c are the corrections in force [rad].

    Attributes:
        a: Shape (ticks, states, states).
        b: Shape (ticks, states, joints).
        reference: Sensed values along the whole motion, shape (ticks of the motion, sensed).
        state: The whole state, shape (ticks, states).
        drives: Largest state of each actuator, shape (na,).
    """

    a: Array
    b: Array
    reference: Array
    state: Array
    drives: Array


def linearise(
    model: mujoco.MjModel,
    layout: Layout,
    start: State,
    reference: JointReference,
    *,
    period: int,
    size: float = 0.6,
    threads: int = 0,
) -> Linear:
    """Linearise a motion in MuJoCo by finite differences, from tick to tick.

    Args:
        model: The compiled model.
        layout: Addresses of the robot in it.
        start: Start of the motion, one row.
        reference: Reference of one trial.
        period: Physics steps from tick to tick.
        size: Size of the robot [m], which scales deviations of its trunk.
        threads: Number of engine threads (0: one per core).

    Returns:
        The linear model.
    """
    model = copy.deepcopy(model)
    model.opt.disableflags |= RESET_OFF | SENSORS_OFF
    ctrl = np.zeros((1, reference.steps, model.nu))
    ctrl[..., layout.ctrl_position] = reference.position
    ctrl[..., layout.ctrl_velocity] = reference.velocity
    rows = _rows(model, start, ctrl, period)
    joints = reference.position.shape[2]
    everything = Batch(model, len(rows), threads)
    everything.state[:] = rows
    state = _state(everything, layout)
    drives = np.maximum(np.abs(state[:, 6 + 2 * joints + UNSENSED :]).max(axis=0, initial=0.0), 1e-3)
    steps = STEPS.sized(size)
    scale = np.concatenate([steps.column(joints, drives), np.full(joints, steps.joint)])
    sides = _Sides(model, layout, steps, drives, threads)
    moving = -(-reference.horizon_steps // period)
    at = [*range(min(moving, len(rows) - 1)), *([len(rows) - 1] if reference.steps > reference.horizon_steps else [])]
    a, b = [], []
    for tick in at:
        last = ctrl[:, -1:].repeat(period, axis=1)
        told = np.concatenate([ctrl[:, tick * period : (tick + 1) * period], last], axis=1)[:, :period]
        before, after = sides.differences(rows[tick], told)
        # the direction of gravity is three numbers of two degrees of freedom: the smallest solution is meant
        both = np.linalg.lstsq(before / scale, after, rcond=1e-8)[0] / scale[:, None]
        a.append(both[:-joints].T)
        b.append(both[-joints:].T)
    return Linear(np.array(a), np.array(b), state[:, : 6 + 2 * joints], state, drives)


def _rows(model: mujoco.MjModel, start: State, ctrl: Array, period: int) -> Array:
    """Return MuJoCo's states at the ticks of a motion, shape (ticks, size of a state)."""
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = start.qpos[0], start.qvel[0], start.act[0]
    first = np.empty(mujoco.mj_stateSize(model, STATE))
    mujoco.mj_getState(model, data, first, STATE)
    batch = Batch(model, 1, 1)
    batch.state[0] = first
    with quiet():
        after = batch.rollout(ctrl.shape[1], ctrl, record=[int(STATE)])[int(STATE)][0]
    return np.concatenate([first[None], after])[: ctrl.shape[1] : period]


def state_of(layout: Layout, qpos: Array, qvel: Array, act: Array | None = None) -> Array:
    """Return states of the linear model from MuJoCo's vectors.

    Args:
        layout: Addresses of the robot in the model.
        qpos: Positions, shape (..., nq).
        qvel: Velocities, shape (..., nv).
        act: States of the actuators, shape (..., na). None if there are none.

    Returns:
        States, shape (..., states): sensed values, height of the trunk [m], its velocity in trunk axes [m/s], and
        ``act``.
    """
    root, rate = layout.root_qpos, layout.root_qvel
    quaternion = qpos[..., root + 3 : root + 7]
    inverse = conjugate(quaternion)
    parts = [layout.sensed(qpos, qvel), qpos[..., root + 2 : root + 3], rotate(inverse, qvel[..., rate : rate + 3])]
    return np.concatenate(parts if act is None else [*parts, act], axis=-1)


def _state(batch: Batch, layout: Layout) -> Array:
    """Return the current states of the simulations, shape (n, states)."""
    fields = ["qpos", "qvel", *(["act"] if batch.model.na else [])]
    return state_of(layout, *(batch.bind(name) for name in fields))


class _Sides:
    """Two simulations for each quantity, one with more of it and one with less."""

    def __init__(self, model: mujoco.MjModel, layout: Layout, steps: Scales, drives: Array, threads: int) -> None:
        self._model, self._layout, self._steps, self._drives = model, layout, steps, drives
        self._qpos_of = np.arange(model.nq)[layout.joint_qpos]
        self._qvel_of = np.arange(model.nv)[layout.joint_qvel]
        self._joints = len(self._qpos_of)
        self._count = 1 + 3 * 3 + 3 * self._joints + model.na
        self._batch = Batch(model, 2 * self._count, threads)
        self._sign = np.tile([1.0, -1.0], self._count)

    def differences(self, row: Array, told: Array) -> tuple[Array, Array]:
        """Return the differences of each pair before a tick and after it.

        Their shapes are (quantities, states + joints) and (quantities, states).
        """
        batch, layout, joints, s = self._batch, self._layout, self._joints, self._steps
        batch.state[:] = row
        qpos, qvel = batch.bind("qpos"), batch.bind("qvel")
        root, rate = layout.root_qpos, layout.root_qvel
        quaternion = qpos[0, root + 3 : root + 7].copy()
        ctrl = np.repeat(told, 2 * self._count, axis=0)
        correction = np.zeros((2 * self._count, joints))
        pairs = iter(np.arange(2 * self._count).reshape(-1, 2))
        more = np.array([1.0, -1.0])
        qpos[next(pairs), root + 2] += more * s.height
        for axis in range(3):
            unit = np.eye(3)[axis]
            for one, sign in zip(next(pairs), more, strict=True):
                mujoco.mju_quatIntegrate(qpos[one, root + 3 : root + 7], unit, float(sign * s.attitude))
            qvel[next(pairs), rate : rate + 3] += more[:, None] * s.speed * rotate(quaternion, unit)
            qvel[next(pairs), rate + 3 + axis] += more * s.rate
        position = np.arange(self._model.nu)[layout.ctrl_position]
        for joint in range(joints):
            qpos[next(pairs), self._qpos_of[joint]] += more * s.joint
            qvel[next(pairs), self._qvel_of[joint]] += more * s.joint_speed
            pair = next(pairs)
            correction[pair, joint] = more * s.joint
            ctrl[pair, :, position[joint]] += (more * s.joint)[:, None]
        for drive, largest in enumerate(self._drives):
            batch.bind("act")[next(pairs), drive] += more * s.drive * largest
        before = np.concatenate([_state(batch, layout), correction], axis=1)
        with quiet():
            batch.rollout(told.shape[1], ctrl, record=[])
        after = _state(batch, layout)
        return before[0::2] - before[1::2], after[0::2] - after[1::2]
