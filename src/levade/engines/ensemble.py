"""Many versions of one model, simulated side by side: a motion on robots that differ from the nominal one.

    ensemble = Ensemble(model, layout)
    sample = Perturbation().draw(model, len(names), n=500, seed=0)
    variations = ensemble.vary((qpos, qvel, act), sample)
    trajectories = ensemble.rollout(variations, reference)          # of 500 runs

Per-simulation model fields of `mujoco.batch.Batch`: no model is compiled anew. What follows from the fields (inverse inertias,
bounding volumes) is computed again for each run, so that a run is that of a model compiled with its values, to rounding.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.layout import Layout
from levade.engines.perturbation import Sample, ground, obstacles
from levade.engines.simulating import RESET_OFF, SENSORS_OFF, STATE, quiet, simulate
from levade.engines.stance import Stance
from levade.feedback import Correcting, Feedback, sensed
from levade.rotations import exponential, multiply, rotate
from levade.trajectory import JointReference, Trajectories

Start = tuple[Array, Array, Array]
"""qpos (nq,), qvel (nv,) and act (na,) of the model."""

_DCMOTOR = int(mujoco.mjtGain.mjGAIN_DCMOTOR)
_NONE = int(mujoco.mjtSameFrame.mjSAMEFRAME_NONE)
# where MuJoCo keeps an actuator's numbers
_RESISTANCE, _DC_KP, _DC_KD, _DC_LAG = 0, 4, 6, 0
_PID_KP, _PID_KD = 1, 2


@dataclass(frozen=True, eq=False)
class Variations:
    """n versions of a model, and where each starts.

    fields: name in `mujoco.MjModel` -> (n, ...), instead of the model's own.
    qpos, qvel, act: (n, ...), at the start. delay: (n,) [s], from the reference to the servos.
    """

    fields: Mapping[str, Array]
    qpos: Array
    qvel: Array
    act: Array
    delay: Array

    def __len__(self) -> int:
        return len(self.qpos)

    def __getitem__(self, runs: slice | NDArray[np.integer | np.bool_] | list[int]) -> Variations:
        """Some of the versions, in the order given; one may be there several times."""
        return Variations(
            {name: values[runs] for name, values in self.fields.items()},
            self.qpos[runs],
            self.qvel[runs],
            self.act[runs],
            self.delay[runs],
        )


class Ensemble:
    """Simulates versions of a model.

    Costs and criteria see the nominal point of the trunk, as the robot's own estimate does, wherever its centre of mass is.
    threads: results do not depend on it. Not to be used from several Python threads at once.
    """

    def __init__(self, model: mujoco.MjModel, layout: Layout, *, threads: int = 0) -> None:
        self.model = copy.deepcopy(model)
        self.layout, self.joint_names = layout, layout.embodiment.joint_names
        self._trunk = self.model.body(layout.embodiment.trunk).id
        self._threads = threads
        # frames that coincide with their body's are not computed: these may not from now on
        self.model.geom_sameframe[self.model.geom_bodyid == 0] = _NONE
        self.model.body_sameframe[self._trunk] = _NONE
        self._batches: dict[bool, Batch] = {}
        self._stance: tuple[bytes, Stance] | None = None

    @property
    def joints(self) -> int:
        return len(self.joint_names)

    def vary(self, start: Start, sample: Sample) -> Variations:
        """The versions that a sample stands for, each started as near to ``start`` as its ground and joints allow."""
        values, n = sample.values, len(sample)
        fields = self._fields(values)
        qpos, qvel, act = (np.repeat(np.asarray(part, dtype=float)[None], n, axis=0) for part in start)
        stance = self._stance_at(start)
        stance.perturb(qpos, qvel, values)
        _tilt(self.model, fields, qpos, qvel, self.layout, values["ground_slope"])
        return Variations(fields, qpos, qvel, act, values["latency"][:, 0])

    def rollout(
        self,
        variations: Variations,
        reference: JointReference,
        *,
        feet: bool = False,
        bodies: Sequence[str] = (),
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
    ) -> Trajectories:
        """Simulate n versions; reference: of n trials, or of one for all. Else as `levade.engines.MujocoEngine.rollout`.

        feedback: corrects the reference from what each run senses. sensor_errors: (n, ticks, sensed), added to that.
        """
        recorded = ["qpos", "qvel", "actuator_force"]
        if feet or bodies:
            recorded.append("sensordata")
        out, diverged = self.record(variations, reference, recorded, feedback=feedback, sensor_errors=sensor_errors)
        return self.layout.trajectories(
            out,
            repeated(reference, len(variations)),
            diverged=diverged,
            feet=feet,
            bodies=bodies,
        )

    def record(
        self,
        variations: Variations,
        reference: JointReference,
        recorded: Sequence[str],
        *,
        feedback: Feedback | None = None,
        sensor_errors: Array | None = None,
    ) -> tuple[dict[str, Array], NDArray[np.bool_]]:
        """As `rollout`, but fields of `mujoco.MjData`, name -> (n, steps, ...), and which runs broke down."""
        n, layout = len(variations), self.layout
        batch = self._batch_for(n, sensors="sensordata" in recorded)
        self._set_fields(batch, variations.fields, n)
        data = mujoco.MjData(self.model)
        row = np.empty(mujoco.mj_stateSize(self.model, STATE))
        mujoco.mj_getState(self.model, data, row, STATE)
        batch.state[:n] = row
        for name in ("qpos", "qvel", "act"):
            if getattr(self.model, {"qpos": "nq", "qvel": "nv", "act": "na"}[name]):
                batch.bind(name)[:n] = getattr(variations, name)
        told = delayed(reference, variations.delay)
        ctrl = np.zeros((n, reference.steps, self.model.nu))
        ctrl[..., layout.ctrl_position] = told.position
        ctrl[..., layout.ctrl_velocity] = told.velocity
        rows = batch.state[:n].copy()
        if feedback is None:
            return simulate(batch, rows, ctrl, recorded)
        correcting = Correcting(
            feedback,
            steps=reference.steps,
            timestep=reference.timestep,
            delay=variations.delay,
            lower=layout.embodiment.limits.lower,
            upper=layout.embodiment.limits.upper,
            errors=sensor_errors,
        )
        return self._corrected(batch, rows, ctrl, recorded, correcting)

    def _corrected(
        self, batch: Batch, rows: Array, ctrl: Array, recorded: Sequence[str], correcting: Correcting
    ) -> tuple[dict[str, Array], NDArray[np.bool_]]:
        """As `simulate`, tick by tick, under feedback. ctrl: without it; changed to what is sent."""
        n, layout = len(rows), self.layout
        root, rate = layout.root_qpos, layout.root_qvel
        qpos, qvel = batch.bind("qpos"), batch.bind("qvel")
        diverged = np.zeros(n, dtype=bool)
        out: dict[str, Array] = {}
        for tick, part in correcting:
            seen = sensed(
                qpos[:n, root + 3 : root + 7],
                qvel[:n, rate + 3 : rate + 6],
                qpos[:n, layout.joint_qpos],
                qvel[:n, layout.joint_qvel],
            )
            told = ctrl[:, part, layout.ctrl_position]
            ctrl[:, part, layout.ctrl_position] = correcting.corrected(tick, part, seen, told)
            now, broken = simulate(batch, batch.state[:n].copy(), ctrl[:, part], recorded)
            for name, values in now.items():
                whole = out.setdefault(name, np.zeros((n, ctrl.shape[1], *values.shape[2:]), values.dtype))
                whole[:, part] = values
                whole[diverged, part] = whole[diverged, part.start - 1][:, None]
            batch.state[:n][broken | diverged] = rows[broken | diverged]  # nothing to see there any more
            diverged |= broken
        return out, diverged

    def _fields(self, values: Mapping[str, Array]) -> dict[str, Array]:
        """Model fields (n, ...) of a sample, but for the slope."""
        model, trunk = self.model, self._trunk
        n = len(values["mass"])
        fields = {
            name: np.repeat(getattr(model, name)[None], n, axis=0)
            for name in (
                *("geom_friction", "geom_pos", "geom_quat", "body_mass", "body_inertia", "body_ipos"),
                *("actuator_gainprm", "actuator_biasprm", "actuator_dynprm", "actuator_forcerange"),
            )
        }
        fields["geom_friction"][..., 0] *= values["friction"]
        fields["body_mass"] *= values["mass"]
        fields["body_inertia"] *= (values["mass"] * values["inertia"])[:, :, None]
        fields["body_ipos"][:, trunk] += values["com"]
        fields["geom_pos"][:, ground(model), 2] += values["ground_height"]
        for i, geom in enumerate(obstacles(model)):
            fields["geom_pos"][:, geom] += values["obstacle"][:, 3 * i : 3 * i + 3]
        gain, bias = fields["actuator_gainprm"], fields["actuator_biasprm"]
        fields["actuator_forcerange"] *= values["torque_limit"][:, :, None]
        for i, name in enumerate(self.joint_names):
            actuator = model.actuator(name).id
            kp, kd = values["kp"][:, i], values["kd"][:, i]
            if model.actuator_gaintype[actuator] == _DCMOTOR:
                gain[:, actuator, _DC_KP] *= kp
                gain[:, actuator, _DC_KD] *= kd
                gain[:, actuator, _RESISTANCE] /= values["torque_limit"][:, 0]
                fields["actuator_dynprm"][:, actuator, _DC_LAG] *= values["torque_lag"][:, 0]
            else:
                bias[:, actuator, _PID_KP] *= kp
                bias[:, actuator, _PID_KD] *= kd
        return fields

    def _stance_at(self, start: Start) -> Stance:
        """How the robot touches the scene at the start; the last one is kept."""
        key = b"".join(np.asarray(part, dtype=float).tobytes() for part in start)
        if self._stance is None or self._stance[0] != key:
            self._stance = (key, Stance(self.model, self.layout, start, threads=self._threads))
        return self._stance[1]

    def _batch_for(self, n: int, *, sensors: bool) -> Batch:
        """A batch of at least n simulations; as in `levade.engines.MujocoEngine`, one with sensors and one without."""
        batch = self._batches.get(sensors)
        if batch is None or batch.nsim < n:
            model = copy.deepcopy(self.model)
            model.opt.disableflags |= RESET_OFF | (0 if sensors else SENSORS_OFF)
            batch = self._batches[sensors] = Batch(model, n, self._threads)
        return batch

    def _set_fields(self, batch: Batch, fields: Mapping[str, Array], n: int) -> None:
        for name, values in fields.items():
            batch.expand(name)[:n] = values
        with quiet():
            batch.set_const(np.arange(n))


def repeated(reference: JointReference, n: int) -> JointReference:
    """The same reference, of n trials if it is of one for all."""
    if len(reference.position) == n:
        return reference
    shape = (n, *reference.position.shape[1:])
    return replace(
        reference,
        position=np.broadcast_to(reference.position, shape),
        velocity=np.broadcast_to(reference.velocity, shape),
    )


def delayed(reference: JointReference, delay: Array) -> JointReference:
    """The same reference, late by (n,) [s], between rows in proportion; until it comes, what the joints were told before,
    at rest: its first angles where that is not known.

    reference: of one trial or of n.
    """
    n, steps = len(delay), reference.steps
    if not delay.any():
        return reference
    late = delay / reference.timestep
    whole = np.floor(late).astype(int)
    part = (late - whole)[:, None, None]
    rows = np.arange(steps)[None] - whole[:, None]
    trial = np.zeros((n, 1), dtype=int) if reference.position.shape[0] == 1 else np.arange(n)[:, None]
    position, velocity = reference.position, reference.velocity
    now, before = np.maximum(rows, 0), np.maximum(rows - 1, 0)
    at_rest = [(index < 0)[:, :, None] for index in (rows, rows - 1)]
    v0, v1 = (np.where(rest, 0.0, velocity[trial, row]) for rest, row in zip(at_rest, (now, before), strict=True))
    p0, p1 = (position[trial, row] for row in (now, before))
    if reference.before is not None:
        p0, p1 = (np.where(rest, reference.before, p) for rest, p in zip(at_rest, (p0, p1), strict=True))
    return replace(reference, position=(1 - part) * p0 + part * p1, velocity=(1 - part) * v0 + part * v1, before=None)


def _tilt(
    model: mujoco.MjModel, fields: dict[str, Array], qpos: Array, qvel: Array, layout: Layout, slope: Array
) -> None:
    """Turn the scene and the robot on it by slope (n, 2) [rad], about x and y through the ground below the trunk."""
    if not slope.any():
        return
    scene = np.flatnonzero(model.geom_bodyid == 0)
    root, rate = layout.root_qpos, layout.root_qvel
    pivot = qpos[:, root : root + 3] * np.array([1.0, 1.0, 0.0])
    turn = exponential(np.concatenate([slope, np.zeros((len(slope), 1))], axis=1))
    pos, quat = fields["geom_pos"], fields["geom_quat"]
    pos[:, scene] = rotate(turn[:, None], pos[:, scene] - pivot[:, None]) + pivot[:, None]
    quat[:, scene] = multiply(np.broadcast_to(turn[:, None], quat[:, scene].shape), quat[:, scene])
    qpos[:, root : root + 3] = rotate(turn, qpos[:, root : root + 3] - pivot) + pivot
    qpos[:, root + 3 : root + 7] = multiply(turn, qpos[:, root + 3 : root + 7])
    qvel[:, rate : rate + 3] = rotate(turn, qvel[:, rate : rate + 3])
