"""The default engine: MuJoCo, its simulations stepped in a batch on a thread pool."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import mujoco
import numpy as np
from mujoco.batch import Batch, SimulationError

from levade.engines.engine import Engine
from levade.engines.physics import Physics
from levade.engines.start import State
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Scene
from levade.trajectory import Array, JointReference, Trajectories

_STATE = mujoco.mjtState.mjSTATE_INTEGRATION
_SENSORS_OFF = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
_RESET_OFF = int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)


class MujocoEngine(Engine):
    """MuJoCo. threads: of the batch; 0 for one per core. Results do not depend on it."""

    def __init__(self, robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> None:
        super().__init__(robot, scene, physics, threads=threads)
        self._batches: dict[bool, Batch] = {}

    def rollout(
        self, state: State, reference: JointReference, *, feet: bool = False, bodies: Sequence[str] = ()
    ) -> Trajectories:
        model = self.model
        n, steps = reference.position.shape[:2]
        recorded = ["qpos", "qvel", "actuator_force"]
        if feet or bodies:
            recorded.append("sensordata")
        batch = self._batch_for(n, sensors=feet or bool(bodies))
        batch.state[:n] = self._row(state)
        before = batch.warning[:n].copy()
        failed: list[int] = []
        ids = None if n == batch.nsim else np.arange(n)
        try:
            with _quiet():
                out = batch.rollout(steps, self.ctrl(reference), record=recorded, ids=ids)
        except SimulationError as error:
            failed = [int(i) for i in error.ids]
            ok = [i for i in range(n) if i not in failed]
            out = {}
            for name in recorded:
                out[name] = np.zeros((n, steps, *getattr(mujoco.MjData(model), name).shape))
            if ok:
                batch.state[ok] = self._row(state)
                with _quiet():
                    part = batch.rollout(steps, self.ctrl(reference[ok]), record=recorded, ids=np.array(ok))
                for name in recorded:
                    out[name][ok] = part[name]
            out["qpos"][failed], out["qvel"][failed] = state.qpos, state.qvel
        diverged = (batch.warning[:n] != before).reshape(n, -1).any(axis=1)
        diverged[failed] = True

        return self.layout.trajectories(
            out,
            reference,
            limits=self.robot.limits,
            trunk_com_offset=self.robot.trunk_com_offset,
            diverged=diverged,
            feet=feet,
            bodies=bodies,
        )

    def _batch_for(self, n: int, *, sensors: bool) -> Batch:
        """A batch of at least n simulations. A batch takes its options when it is made, so there are two.

        Sensors are read only: the motion is the same with and without them.
        """
        batch = self._batches.get(sensors)
        if batch is None or batch.nsim < n:
            model = copy.deepcopy(self.model)
            # a state that has gone bad stops the simulation; it must not start over unnoticed
            model.opt.disableflags |= _RESET_OFF | (0 if sensors else _SENSORS_OFF)
            batch = self._batches[sensors] = Batch(model, n, self.threads)
        return batch

    def _row(self, state: State) -> Array:
        """The state as a batch takes it: as after ``mj_resetData`` and setting qpos, qvel and act."""
        data = mujoco.MjData(self.model)
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
        row = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        mujoco.mj_getState(self.model, data, row, _STATE)
        return row

    def _settle(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        steps = round(time / self.physics.timestep)
        ctrl = np.zeros(model.nu)
        ctrl[self.layout.ctrl_position] = posture
        data.ctrl[:] = ctrl
        if steps:
            with _quiet():
                mujoco.mj_step(model, data, nstep=steps)
        if any(warning.number for warning in data.warning):
            raise LevadeError(
                f"start: the simulation broke down within {time} s; a smaller physics.timestep or lower gains may help"
            )
        return State(
            qpos=data.qpos.copy(),
            qvel=data.qvel.copy(),
            act=data.act.copy(),
            joint_position=data.qpos[self.layout.joint_qpos].copy(),
            joint_reference=posture.copy(),
        )


@contextmanager
def _quiet() -> Iterator[None]:
    """Simulations that break down are told to the caller, not to standard error and a MUJOCO_LOG.TXT."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(_ignore)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def _ignore(message: str) -> None:
    pass
