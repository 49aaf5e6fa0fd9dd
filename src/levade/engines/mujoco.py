"""The default engine: MuJoCo, its simulations stepped in a batch on a thread pool."""

from __future__ import annotations

import copy
from collections.abc import Sequence

import mujoco
import numpy as np
from mujoco.batch import Batch

from levade.arrays import Array
from levade.engines.engine import Engine
from levade.engines.ensemble import Ensemble
from levade.engines.physics import Physics
from levade.engines.simulating import RESET_OFF, SENSORS_OFF, STATE, quiet, simulate
from levade.engines.start import State
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Scene
from levade.trajectory import JointReference, Trajectories


class MujocoEngine(Engine):
    """MuJoCo. threads: of the batch; 0 for one per core. Results do not depend on it."""

    def __init__(self, robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> None:
        super().__init__(robot, scene, physics, threads=threads)
        self._batches: dict[bool, Batch] = {}
        self._latest: tuple[State, Array] | None = None

    def rollout(
        self, state: State, reference: JointReference, *, feet: bool = False, bodies: Sequence[str] = ()
    ) -> Trajectories:
        n = reference.position.shape[0]
        self.steps += n * reference.steps
        recorded = ["qpos", "qvel", "actuator_force"]
        if feet or bodies:
            recorded.append("sensordata")
        batch = self._batch_for(n, sensors=feet or bool(bodies))
        out, diverged = simulate(batch, self._row(state), self.ctrl(reference), recorded)
        return self.layout.trajectories(
            out,
            reference,
            diverged=diverged,
            feet=feet,
            bodies=bodies,
        )

    def ensemble(self, *, threads: int | None = None) -> Ensemble:
        """For simulating versions of the model: robots that differ from the nominal one."""
        return Ensemble(self.model, self.layout, threads=self.threads if threads is None else threads)

    def _batch_for(self, n: int, *, sensors: bool) -> Batch:
        """A batch of at least n simulations. A batch takes its options when it is made, so there are two.

        Sensors are read only: the motion is the same with and without them.
        """
        batch = self._batches.get(sensors)
        if batch is None or batch.nsim < n:
            model = copy.deepcopy(self.model)
            model.opt.disableflags |= RESET_OFF | (0 if sensors else SENSORS_OFF)
            batch = self._batches[sensors] = Batch(model, n, self.threads)
        return batch

    def _row(self, state: State) -> Array:
        """The state as a batch takes it: as after ``mj_resetData`` and setting qpos, qvel and act.

        Made anew for another state only: a search starts every trial from one.
        """
        if self._latest is not None and self._latest[0] is state:
            return self._latest[1]
        data = mujoco.MjData(self.model)
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
        row = np.empty(mujoco.mj_stateSize(self.model, STATE))
        mujoco.mj_getState(self.model, data, row, STATE)
        self._latest = state, row
        return row

    def _settle(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        steps = round(time / self.physics.timestep)
        ctrl = np.zeros(model.nu)
        ctrl[self.layout.ctrl_position] = posture
        data.ctrl[:] = ctrl
        if steps:
            with quiet():
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
