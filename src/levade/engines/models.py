"""Versions of one model, for any engine: robots and scenes that differ from the nominal one.

    sample = Perturbation().draw(engine.model, joints, n=500, seed=0)
    starts, models = perturbed_models(engine.model, engine.layout, sample, start)
    trajectories = engine.rollout(starts, reference, models=models)         # of 500 trials

Versions are fields of the compiled model, so none is compiled again. An engine computes the values that depend on them (inverse
inertias, bounding volumes). So a version equals a model compiled with its values, to rounding.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.layout import Layout
from levade.engines.perturbation import Sample, ground, obstacles
from levade.engines.stance import Stance
from levade.engines.state import State
from levade.errors import LevadeError
from levade.rotations import exponential, multiply, rotate
from levade.trajectory import JointReference

FIELDS = (
    *("geom_friction", "geom_pos", "geom_quat", "body_mass", "body_inertia", "body_ipos"),
    *("actuator_gainprm", "actuator_biasprm", "actuator_dynprm", "actuator_forcerange"),
)
"""Fields of `mujoco.MjModel` in which perturbed models differ."""

SOFTNESS_FIELDS = ("geom_solref", "geom_solimp", "pair_solref", "pair_solimp")
"""Further fields in which softer or harder models differ."""

CONE_FIELD = "opt.cone"
"""Further field in which models with another friction cone differ."""

_DCMOTOR = int(mujoco.mjtGain.mjGAIN_DCMOTOR)
_NONE = int(mujoco.mjtSameFrame.mjSAMEFRAME_NONE)
# where MuJoCo keeps an actuator's numbers
_RESISTANCE, _DC_KP, _DC_KD, _DC_LAG = 0, 4, 6, 0
_PID_KP, _PID_KD = 1, 2


@dataclass(frozen=True, eq=False)
class Models:
    """Holds n versions of a model.

    Attributes:
        fields: Field of `mujoco.MjModel` -> its values in each version, shape (n, ...). Other fields are those of the nominal
            model. Frames (``geom_pos``, ``geom_quat``, ``body_ipos``) may only differ for the scene and for the trunk
            (`with_free_frames`).
        delay: Time from a reference to the servos [s], shape (n,).
    """

    fields: Mapping[str, Array]
    delay: Array

    def __len__(self) -> int:
        return len(self.delay)

    def __getitem__(self, rows: int | slice | Sequence[int] | NDArray[np.integer | np.bool_]) -> Models:
        """Select versions, in the order given; a version may come several times."""
        if isinstance(rows, int):
            rows = [rows]
        return Models({name: values[rows] for name, values in self.fields.items()}, self.delay[rows])

    @classmethod
    def stacked(cls, models: Sequence[Models]) -> Models:
        """Join the versions of several, in sequence. All have the same fields.

        Args:
            models: Versions to join, at least one item.

        Returns:
            All the versions.
        """
        fields = {name: np.concatenate([one.fields[name] for one in models]) for name in models[0].fields}
        return cls(fields, np.concatenate([one.delay for one in models]))


def perturbed_models(model: mujoco.MjModel, layout: Layout, sample: Sample, start: State) -> tuple[State, Models]:
    """Make the versions of a sample, and their starts.

    Args:
        model: The nominal model.
        layout: Addresses of the robot in it.
        sample: Values of n versions.
        start: Start of the nominal model, one row.

    Returns:
        Starts of n rows, as near to ``start`` as the ground and the joints of each version allow; and the versions.

    Raises:
        LevadeError: If ``start`` has more than one row.
    """
    if len(start) != 1:
        raise LevadeError(f"perturbed models: the start has {len(start)} rows, should have one")
    model, values, n = with_free_frames(model, layout), sample.values, len(sample)
    fields = _fields(model, layout, values)
    qpos, qvel, act = (
        np.repeat(np.asarray(part, dtype=float), n, axis=0) for part in (start.qpos, start.qvel, start.act)
    )
    Stance(model, layout, start).perturb(qpos, qvel, values)
    _tilt(model, fields, qpos, qvel, layout, values["ground_slope"])
    starts = State(qpos, qvel, act, qpos[:, layout.joint_qpos].copy(), np.repeat(start.joint_reference, n, axis=0))
    return starts, Models(fields, values["latency"][:, 0])


def with_free_frames(model: mujoco.MjModel, layout: Layout) -> mujoco.MjModel:
    """Copy a model so that the frames of the scene's geoms and of the trunk's inertia may be changed.

    MuJoCo does not compute frames that coincide with their body's, and the last bits of a simulation depend on it.

    Args:
        model: The model; it is not changed.
        layout: Addresses of the robot in it.

    Returns:
        The copy.
    """
    model = copy.deepcopy(model)
    model.geom_sameframe[model.geom_bodyid == 0] = _NONE
    model.body_sameframe[model.body(layout.embodiment.trunk).id] = _NONE
    return model


def delayed(reference: JointReference, delay: Array) -> JointReference:
    """Delay a reference until it reaches the servos of n trials.

    Rows are interpolated linearly. Until the reference arrives, the joints keep their earlier command at rest
    (``reference.before``), or the first angles if that is not known.

    Args:
        reference: Reference of one trial or of n.
        delay: Delay of each trial [s], shape (n,).

    Returns:
        The delayed reference.
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
        held = reference.before[:, None] if reference.before.ndim == 2 else reference.before
        p0, p1 = (np.where(rest, held, p) for rest, p in zip(at_rest, (p0, p1), strict=True))
    return replace(reference, position=(1 - part) * p0 + part * p1, velocity=(1 - part) * v0 + part * v1, before=None)


def _fields(model: mujoco.MjModel, layout: Layout, values: Mapping[str, Array]) -> dict[str, Array]:
    """Compute the model fields of a sample, shape (n, ...), without the slope."""
    n, trunk = len(values["mass"]), model.body(layout.embodiment.trunk).id
    fields = {name: np.repeat(getattr(model, name)[None], n, axis=0) for name in FIELDS}
    fields["geom_friction"][..., 0] *= values["friction"]
    fields["body_mass"] *= values["mass"]
    fields["body_inertia"] *= (values["mass"] * values["inertia"])[:, :, None]
    fields["body_ipos"][:, trunk] += values["com"]
    fields["geom_pos"][:, ground(model), 2] += values["ground_height"]
    for i, geom in enumerate(obstacles(model)):
        fields["geom_pos"][:, geom] += values["obstacle"][:, 3 * i : 3 * i + 3]
    if (values["softness"] != 1.0).any():
        fields |= {name: np.repeat(getattr(model, name)[None], n, axis=0) for name in SOFTNESS_FIELDS}
        for prefix in ("geom", "pair"):
            soften(fields[f"{prefix}_solref"], fields[f"{prefix}_solimp"], values["softness"][:, :, None])
    if values["cone"].any():
        fields[CONE_FIELD] = np.where(values["cone"][:, 0] >= 0.5, other_cone(model), int(model.opt.cone))
    gain, bias = fields["actuator_gainprm"], fields["actuator_biasprm"]
    fields["actuator_forcerange"] *= values["torque_limit"][:, :, None]
    for i, name in enumerate(layout.embodiment.joint_names):
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


def other_cone(model: mujoco.MjModel) -> int:
    """Return the friction cone that a model does not have.

    Args:
        model: The model.

    Returns:
        A value of `mujoco.mjtCone`.
    """
    elliptic, pyramidal = int(mujoco.mjtCone.mjCONE_ELLIPTIC), int(mujoco.mjtCone.mjCONE_PYRAMIDAL)
    return pyramidal if model.opt.cone == elliptic else elliptic


def soften(solref: Array, solimp: Array, factor: float | Array) -> None:
    """Make contacts softer, in place: MuJoCo's solref, shape (..., 2), and solimp, shape (..., 5).

    Args:
        solref: Time constant and damping ratio; or, if the first is not positive, minus stiffness and minus damping.
        solimp: Impedances, of which the first two are shares of the full force.
        factor: Factor on the time in which a contact pushes bodies apart, and on the missing share of the full force. It
            broadcasts to (..., 1).
    """
    direct = solref[..., :1] <= 0
    of_time = np.concatenate([np.broadcast_to(factor, direct.shape), np.ones(direct.shape)], axis=-1)
    of_stiffness = np.concatenate(
        [np.broadcast_to(1.0 / np.square(factor), direct.shape), 1.0 / of_time[..., :1]], axis=-1
    )
    solref *= np.where(direct, of_stiffness, of_time)
    solimp[..., :2] = np.clip(1 - (1 - solimp[..., :2]) * factor, 0.0001, 0.9999)


def _tilt(
    model: mujoco.MjModel, fields: dict[str, Array], qpos: Array, qvel: Array, layout: Layout, slope: Array
) -> None:
    """Turn the scene and the robot on it by a slope [rad], shape (n, 2), about x and y through the ground below the trunk."""
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
