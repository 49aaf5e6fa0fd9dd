"""The default engine, MuJoCo: simulations are stepped in a batch on a thread pool."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from importlib.metadata import version
from operator import attrgetter
from typing import ClassVar

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.batches import ISLANDS_OFF, RESET_OFF, SENSORS_OFF, STATE, quiet, simulate
from levade.engines.clearance import SELF_DISTANCE, distances, distances_at
from levade.engines.engine import Engine, Trials, broke_down
from levade.engines.lean import Lean
from levade.engines.models import Models, with_free_frames
from levade.engines.state import State
from levade.feedback import Correcting, Feedback
from levade.trajectory import JointReference, Trajectories

_RECORDED = ("qpos", "qvel", "actuator_force")


class MujocoEngine(Engine):
    """The engine MuJoCo."""

    name: ClassVar[str] = "mujoco"
    stops: ClassVar[bool] = True
    feels: ClassVar[bool] = True

    def _prepare(self) -> None:
        self._batches: dict[tuple[tuple[int, ...] | None, bool], Batch] = {}
        self._varied: set[str] = set()
        self._latest: tuple[State, Array] | None = None

    @classmethod
    def versions(cls) -> dict[str, str]:
        """Versions that decide the bits; see `levade.engines.EngineKind.versions`."""
        return {name: version(name) for name in ("mujoco", "numpy")}

    def with_model(self, model: mujoco.MjModel) -> MujocoEngine:
        """Make an engine from a model that was changed after it was compiled, such as other options or contacts.

        Args:
            model: The changed model, with the names, joints and actuators of `model`. ``xml`` does not describe it.

        Returns:
            The engine.
        """
        physics = replace(self.physics, timestep=float(model.opt.timestep))
        return MujocoEngine(self.xml, self.assets, self.embodiment, physics, threads=self.threads, model=model)

    def states(
        self,
        starts: State,
        reference: JointReference,
        fields: Sequence[str],
        *,
        models: Models | None = None,
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
    ) -> tuple[dict[str, Array], NDArray[np.bool_]]:
        """Simulate as `rollout` does, and record MuJoCo's own arrays.

        Args:
            starts: Starts of the trials.
            reference: References that they follow.
            fields: Names of arrays of `mujoco.MjData`, except those of shapes: only shapes that can touch are simulated.
            models: As in `rollout`.
            feedback: As in `rollout`.
            sensor_errors: As in `rollout`.

        Returns:
            Field -> values after each step, shape (n, steps, ...); and which trials broke down, shape (n,).

        Raises:
            LevadeError: If the rows do not fit together.
        """
        trials = self._trials(starts, reference, models, feedback, sensor_errors)
        return self._recorded(trials, fields, None if "sensordata" in fields else ())

    def hold(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        """Simulate the robot while it holds a posture; see `levade.engines.Engine.hold`."""
        steps = round(time / self.physics.timestep)
        data.ctrl[:] = 0.0
        data.ctrl[self.layout.ctrl_position] = posture
        if steps:
            with quiet():
                mujoco.mj_step(model, data, nstep=steps)
        if data.warning.number.any():
            raise broke_down(time)
        return self.layout.state(data.qpos, data.qvel, data.act, joint_reference=posture)

    def _simulate(self, trials: Trials, record: Sequence[str]) -> Trajectories:
        fields = (*_RECORDED, "sensordata") if record else _RECORDED
        out, diverged = self._recorded(trials, fields, tuple(sorted(self.layout.addresses(record))))
        found = self.layout.trajectories(out, trials.reference, diverged=diverged, record=record)
        return found if SELF_DISTANCE not in record else replace(found, self_distance=self._distances(trials, out))

    def _distances(self, trials: Trials, out: Mapping[str, Array]) -> Array:
        """Return distances at the end of each step [m], shape (n, steps), from a sensor of those at its beginning."""
        address, clearance = self.layout.distance_sensor, self.layout.clearance
        assert address is not None
        assert clearance is not None
        trial = np.arange(trials.n)
        last = np.full(trials.n, trials.reference.steps) - 1 if trials.ends is None else trials.ends - 1
        least = np.roll(distances(out["sensordata"], address, clearance), -1, axis=1)
        least[trial, last] = distances_at(self.model, out["qpos"][trial, last])
        return least

    def _recorded(
        self, trials: Trials, fields: Sequence[str], sensors: tuple[int, ...] | None
    ) -> tuple[dict[str, Array], NDArray[np.bool_]]:
        n, models = trials.n, trials.models
        batch = self._batch_for(n, sensors=sensors, versions=models is not None)
        if models is not None:
            self._set_fields(batch, models.fields, n)
        rows, ctrl = self._rows(trials.starts), self.ctrl(trials.commanded, n)
        if trials.correcting is not None:
            return _in_parts(batch, rows, ctrl, fields, self._corrected(batch, ctrl, trials.correcting))
        if trials.ends is not None:
            return _in_parts(batch, rows, ctrl, fields, _ending(trials.ends))
        return simulate(batch, rows, ctrl, fields)

    def _corrected(self, batch: Batch, ctrl: Array, correcting: Correcting) -> Iterator[tuple[slice, int]]:
        """Write the corrected commands into ctrl tick by tick, and yield the tick's rows."""
        n, layout = len(ctrl), self.layout
        qpos, qvel = batch.bind("qpos"), batch.bind("qvel")
        for tick, part in correcting:
            seen = layout.sensed(qpos[:n], qvel[:n])
            commanded = ctrl[:, part, layout.ctrl_position]
            ctrl[:, part, layout.ctrl_position] = correcting.corrected(tick, part, seen, commanded)
            yield part, n

    @cached_property
    def _lean(self) -> Lean:
        """The model that is stepped."""
        return Lean.of(self.model, self.xml, self.assets)

    @cached_property
    def _free(self) -> mujoco.MjModel:
        """The model that versions are made of."""
        return with_free_frames(self._lean.model, self.layout)

    def _batch_for(self, n: int, *, sensors: tuple[int, ...] | None, versions: bool) -> Batch:
        """Return a batch of at least n simulations. A batch is made with its options and the sensors that it computes.

        Sensors are only read, so they do not change the motion. A batch of versions has separate fields in each simulation.

        Args:
            n: Number of simulations.
            sensors: Addresses of the sensors to compute, in ascending order. None for all.
            versions: Whether each simulation has a version of the model.
        """
        batch = self._batches.get((sensors, versions))
        if batch is None or batch.nsim < n:
            model = copy.deepcopy(self._free if versions else self._lean.model)
            model.opt.disableflags |= RESET_OFF | (0 if sensors is None or sensors else SENSORS_OFF)
            model.opt.disableflags |= ISLANDS_OFF if model.ntree == 1 else 0
            if sensors:  # all of them together take as long as a fifth of the physics
                model.sensor_needstage[~np.isin(model.sensor_adr, sensors)] = mujoco.mjtStage.mjSTAGE_NONE
            batch = self._batches[sensors, versions] = Batch(model, n, self.threads)
        return batch

    def _set_fields(self, batch: Batch, fields: Mapping[str, Array], n: int) -> None:
        """Give the first n simulations their versions' fields, and the values that depend on them."""
        self._varied |= set(fields)
        for name in self._varied:  # a version has the nominal values of what an earlier one differed in
            given = fields.get(name)
            batch.expand(name)[:n] = attrgetter(name)(self._free) if given is None else self._lean.fields(name, given)
        with quiet():
            batch.set_const(np.arange(n))

    def _rows(self, starts: State) -> Array:
        """Return the states as a batch takes them: after ``mj_resetData``, with qpos, qvel and act.

        They are made again only for another object, because a search starts every trial from the same one.
        """
        if self._latest is None or self._latest[0] is not starts:
            rows = np.repeat(self._reset[None], len(starts), axis=0)
            column = mujoco.mj_stateSize(self.model, mujoco.mjtState.mjSTATE_TIME)
            for values in (starts.qpos, starts.qvel, starts.act):  # in this order, after the time
                rows[:, column : column + values.shape[1]] = values
                column += values.shape[1]
            self._latest = starts, rows
        return self._latest[1]

    @cached_property
    def _reset(self) -> Array:
        row = np.empty(mujoco.mj_stateSize(self.model, STATE))
        mujoco.mj_getState(self.model, mujoco.MjData(self.model), row, STATE)
        return row


def _ending(ends: NDArray[np.intp]) -> Iterator[tuple[slice, int]]:
    """Yield the rows between successive ends of trials, and the number of trials that still run. The longest come first."""
    begin = 0
    for end in np.unique(ends):
        yield slice(begin, int(end)), int(np.count_nonzero(ends >= end))
        begin = int(end)


def _in_parts(
    batch: Batch, rows: Array, ctrl: Array, fields: Sequence[str], parts: Iterator[tuple[slice, int]]
) -> tuple[dict[str, Array], NDArray[np.bool_]]:
    """Simulate like `simulate`, part by part. A part names its rows, and how many of the first trials run through it.

    ``ctrl`` and the batch's state are read when a part begins, after the iterator has yielded it.
    """
    n = len(ctrl)
    batch.state[:n] = rows
    rows = batch.state[:n].copy()
    diverged = np.zeros(n, dtype=bool)
    out: dict[str, Array] = {}
    for part, going in parts:
        now, broken = simulate(batch, batch.state[:going].copy(), ctrl[:going, part], fields)
        before = np.flatnonzero(diverged[:going])
        for name, values in now.items():
            if name not in out:
                out[name] = np.zeros((n, ctrl.shape[1], *values.shape[2:]), values.dtype)
            whole = out[name]
            whole[:going, part] = values
            whole[before, part] = whole[before, part.start - 1][:, None]
        diverged[:going] |= broken
        # nothing to see there any more
        batch.state[:going][diverged[:going]] = rows[:going][diverged[:going]]
    return out, diverged
