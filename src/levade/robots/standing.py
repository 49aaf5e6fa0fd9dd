"""Standing: find postures with the feet under the hips from the kinematics, and compute the joint torques they need."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.robots.reading import Keyframe
from levade.robots.shapes import tip
from levade.robots.understanding import Leg

NEUTRAL_EXTENSION = (0.75, 0.8, 0.85, 0.9)
"""Heights of the hip above the foot, as shares of the leg's length. The first that the joints can carry is neutral."""
CROUCHED_EXTENSION, STRETCHED_EXTENSION = 0.45, 0.95

_NAMES = ("home", "stand", "standing", "neutral", "default", "nominal")
_SCAN = 181
_MARGIN = 0.02  # rad from the end of a range


@dataclass(frozen=True)
class Bare:
    """Holds a model without ground or actuators, and its legs.

    Attributes:
        model: The model.
        trunk: Id of the trunk's body.
        legs: The legs, and other limbs that move.
        ranges: Joint -> lower and upper end of its range [rad].
    """

    model: mujoco.MjModel
    trunk: int
    legs: tuple[Leg, ...]
    ranges: Mapping[str, tuple[float, float]]

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the legs' joints, in leg order."""
        return tuple(joint for leg in self.legs for joint in leg.joints)

    @property
    def standing(self) -> tuple[Leg, ...]:
        """The limbs that stand."""
        return tuple(leg for leg in self.legs if leg.stands)

    @property
    def columnar(self) -> bool:
        """Whether the postures have a closed form: four or more standing legs of two or three joints that lift and fold."""
        short = all(len(leg.joints) <= 3 and {"hfe", "kfe"} <= set(leg.roles) for leg in self.standing)
        return short and len(self.standing) >= 4 and all(leg.roles[0] != "swing" for leg in self.standing)

    @property
    def shares_gains(self) -> bool:
        """Whether one gain suits all joints: columnar legs and no other limb."""
        return self.columnar and len(self.standing) == len(self.legs)

    @cached_property
    def dofs(self) -> NDArray[np.intp]:
        """Degree of freedom of each joint, shape (joints,)."""
        return np.array([self.model.joint(joint).dofadr[0] for joint in self.joints], dtype=np.intp)

    @property
    def armature(self) -> Array:
        """Reflected rotor inertia of each joint [kg m2], shape (joints,)."""
        return self.model.dof_armature[self.dofs].copy()

    def data_at(self, angles: Mapping[str, float]) -> mujoco.MjData:
        """Compute kinematics with the trunk frame at the world frame.

        Args:
            angles: Joint -> angle [rad]. Other joints are at zero.
        """
        return self.put(mujoco.MjData(self.model), angles)

    @cached_property
    def _data(self) -> mujoco.MjData:
        """Data that many postures reuse, since making one takes longer than the kinematics of a posture."""
        return mujoco.MjData(self.model)

    def put(self, data: mujoco.MjData, angles: Mapping[str, float]) -> mujoco.MjData:
        """Compute kinematics as `data_at` does, in existing data.

        Args:
            data: Data of the model; it is changed.
            angles: Joint -> angle [rad]. Other joints are at zero.

        Returns:
            The data.
        """
        data.qpos[:] = 0.0
        data.qpos[int(self.model.jnt_qposadr[self.model.body_jntadr[self.trunk]]) + 3] = 1.0
        for joint, angle in angles.items():
            data.joint(joint).qpos[0] = angle
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        return data

    def tip(self, data: mujoco.MjData, leg: Leg) -> Array:
        """Find where the leg's foot ends.

        Args:
            data: Kinematics, as of `data_at`.
            leg: The leg.

        Returns:
            The point in the trunk frame [m], shape (3,).
        """
        return tip(self.model, data, self.model.geom(leg.foot).id, self.model.joint(leg.joints[-1]).id)

    def stand_point(self, data: mujoco.MjData, leg: Leg) -> Array:
        """Find where the ground pushes: at the middle if the sole has several shapes, otherwise at the foot's tip.

        Args:
            data: Kinematics, as of `data_at`.
            leg: The leg.

        Returns:
            The point in the trunk frame [m], shape (3,).
        """
        if not leg.pads:
            return self.tip(data, leg)
        return np.mean([data.geom(pad).xpos for pad in leg.pads], axis=0)

    def leg_length(self, leg: Leg) -> float:
        """Measure the length from hip flexion over the knee to the end of the foot; for other legs, along all links.

        Args:
            leg: The leg.

        Returns:
            Length [m].
        """
        data = self.put(self._data, self._zero(leg))
        if not {"hfe", "kfe"} <= set(leg.roles) or leg.roles[0] == "swing":
            points = [*(data.joint(joint).xanchor for joint in leg.joints), self.tip(data, leg)]
            return float(sum(np.linalg.norm(b - a) for a, b in itertools.pairwise(points)))
        hip, knee = (data.joint(leg.joints[leg.roles.index(role)]).xanchor for role in ("hfe", "kfe"))
        axis = data.joint(leg.joints[leg.roles.index("hfe")]).xaxis
        flat = np.eye(3) - np.outer(axis, axis)
        return float(np.linalg.norm(flat @ (knee - hip)) + np.linalg.norm(flat @ (self.tip(data, leg) - knee)))

    def resting(self, joint: str) -> float:
        """Return zero, or the nearest angle in range.

        Args:
            joint: Name of the joint.

        Returns:
            Angle [rad].
        """
        return float(np.clip(0.0, *self.ranges[joint]))

    def _zero(self, leg: Leg) -> dict[str, float]:
        return {joint: float(np.clip(0.0, *self.ranges[joint])) for joint in leg.joints}

    def posture(self, extension: float) -> dict[str, float] | None:
        """Find a posture with every foot under its hip.

        Args:
            extension: Height of the hip above the foot, as a share of the leg's length.

        Returns:
            Joint -> angle [rad]. None if a joint would be out of range.
        """
        angles: dict[str, float] = {}
        for leg in self.standing:
            found = self._stand(leg, extension)
            if found is None:
                return None
            angles.update(found)
        return angles

    def _stand(self, leg: Leg, extension: float) -> dict[str, float] | None:
        """Find knee angles for a distance of hip and foot, each with the hip angle that puts the foot below the hip."""
        angles = self._zero(leg)
        hip, knee = (leg.joints[leg.roles.index(role)] for role in ("hfe", "kfe"))
        wanted = extension * self.leg_length(leg)
        data = self.put(self._data, angles)
        anchor, axis = data.joint(hip).xanchor.copy(), data.joint(hip).xaxis.copy()
        pivot, hinge = data.joint(knee).xanchor.copy(), data.joint(knee).xaxis.copy()
        shank = self.tip(data, leg) - pivot
        flat = np.eye(3) - np.outer(axis, axis)
        sideways, along = np.cross(hinge, shank), hinge * (hinge @ shank)

        def across(bend: Array) -> Array:
            """Return vectors from hip to foot across the hip's axis [m], shape (n, 3), for extra bends [rad], shape (n,)."""
            c, s = np.cos(bend)[:, None], np.sin(bend)[:, None]
            turned = shank * c + sideways * s + along * (1 - c)
            return (pivot - anchor + turned) @ flat

        lower, upper = (limit - angles[knee] for limit in self.ranges[knee])
        wide = not np.isfinite([lower, upper]).all() or upper - lower > 2 * np.pi
        if wide:
            lower, upper = -np.pi, np.pi
        scan = np.linspace(lower + _MARGIN, upper - _MARGIN, _SCAN)
        gaps = np.linalg.norm(across(scan), axis=1) - wanted
        candidates = []
        for k in np.flatnonzero(np.signbit(gaps[:-1]) != np.signbit(gaps[1:])):
            low, high = float(scan[k]), float(scan[k + 1])
            for _ in range(50):
                middle = 0.5 * (low + high)
                gap = np.linalg.norm(across(np.array([middle]))) - wanted
                low, high = (middle, high) if np.signbit(gap) == np.signbit(gaps[k]) else (low, middle)
            bend = 0.5 * (low + high)
            vector = across(np.array([bend]))[0]
            down = flat @ np.array([0.0, 0.0, -1.0])
            turn = float(np.arctan2(axis @ np.cross(vector, down), vector @ down))
            turned = _within(angles[hip] + turn, *self.ranges[hip])
            bent = _within(angles[knee] + bend, *self.ranges[knee]) if wide else angles[knee] + bend
            if turned is not None and bent is not None:
                candidates.append({**angles, knee: bent, hip: turned})
        if not candidates:
            return None
        return min(candidates, key=lambda bent: self._outward(leg, bent))

    def _outward(self, leg: Leg, angles: Mapping[str, float]) -> float:
        """Return how far outward the knee is from the line between hip and foot [m].

        If both ways are in range, knees bend inward, as HyQ's and ANYmal's do.
        """
        data = self.put(self._data, angles)
        hip, knee = (data.joint(leg.joints[leg.roles.index(role)]).xanchor for role in ("hfe", "kfe"))
        ahead = float(knee[0] - 0.5 * (hip[0] + self.tip(data, leg)[0]))
        return ahead if leg.end == "front" else -ahead

    def static_torque(self, angles: Mapping[str, float]) -> dict[str, float]:
        """Compute the torques that carry the robot on vertical foot forces of least norm.

        Args:
            angles: Joint -> angle [rad].

        Returns:
            Joint -> torque [Nm].
        """
        data = self.data_at(angles)
        mujoco.mj_forward(self.model, data)
        return self._carried(data, data.qfrc_bias, data.qfrc_bias - data.qfrc_passive)

    def _carried(self, data: mujoco.MjData, bias: Array, load: Array) -> dict[str, float]:
        """Return joint -> torque [Nm] against a load, shape (nv,), while the feet carry the weight in ``bias``, shape (nv,)."""
        model = self.model
        contacts, rows = [], []
        for leg in self.standing:
            point, body = self.stand_point(data, leg), int(model.geom_bodyid[model.geom(leg.foot).id])
            jacobian = np.zeros((3, model.nv))
            mujoco.mj_jac(model, data, jacobian, None, point, body)
            contacts.append(jacobian[2])
        free = int(model.jnt_dofadr[model.body_jntadr[self.trunk]])
        base = np.array([row[free : free + 6] for row in contacts]).T
        rows = np.array(contacts)
        force = np.linalg.lstsq(base[2:5], bias[free + 2 : free + 5], rcond=None)[0]
        torque = load - rows.T @ force
        return {joint: float(torque[int(model.joint(joint).dofadr[0])]) for joint in self.joints}

    def joint_inertia(self, angles: Mapping[str, float]) -> dict[str, float]:
        """Compute the inertia about each joint's axis of everything that it carries outward, including armature.

        Args:
            angles: Joint -> angle [rad].

        Returns:
            Joint -> inertia [kg m2].
        """
        data = self.data_at(angles)
        mujoco.mj_makeM(self.model, data)
        full = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, data, full)
        return {joint: float(full[i, i]) for joint in self.joints for i in [int(self.model.joint(joint).dofadr[0])]}


def neutral_from(bare: Bare, keyframes: Sequence[Keyframe]) -> tuple[dict[str, float], str] | None:
    """Find a keyframe in which the robot stands: trunk level, joints in range, feet below the hips.

    Args:
        bare: The bare robot.
        keyframes: Keyframes of the model.

    Returns:
        Joint -> angle [rad], and the name of the keyframe. None if the robot stands in none.
    """
    standing = [frame for frame in keyframes if _stands(bare, frame)]
    if not standing:
        return None
    preferred = [frame for name in _NAMES for frame in standing if frame.name.lower() == name]
    chosen = (preferred or standing)[0]
    return {joint: chosen.angles[joint] for joint in bare.joints}, chosen.name


def _stands(bare: Bare, frame: Keyframe) -> bool:
    _, x, y, _ = frame.quaternion / max(float(np.linalg.norm(frame.quaternion)), 1e-9)
    if 1.0 - 2.0 * (x * x + y * y) < 0.98 or not set(bare.joints) <= set(frame.angles):
        return False
    angles = {joint: frame.angles[joint] for joint in bare.joints}
    if any(not lower <= angles[joint] <= upper for joint, (lower, upper) in bare.ranges.items()):
        return False
    data = bare.data_at(angles)
    feet = np.array([bare.tip(data, leg)[2] for leg in bare.standing])
    lengths = np.array([bare.leg_length(leg) for leg in bare.standing])
    hips = np.array([data.joint(leg.joints[_lift(leg)]).xanchor[2] for leg in bare.standing])
    deep = 0.5 if all("swing" not in leg.roles[:1] for leg in bare.standing) else 0.15
    return bool(np.ptp(feet) < 0.1 * lengths.mean() and ((hips - feet) > deep * lengths).all())


def _lift(leg: Leg) -> int:
    """Return the index of the joint that lifts the leg."""
    return leg.roles.index("hfe") if "hfe" in leg.roles else 0


def _within(angle: float, lower: float, upper: float) -> float | None:
    """Add whole turns to an angle to bring it into a range, as near to zero as possible; None if that is impossible."""
    turned = (angle + turns * 2 * np.pi for turns in (0, -1, 1, -2, 2))
    inside = [float(a) for a in turned if lower + _MARGIN <= a <= upper - _MARGIN]
    return min(inside, key=abs) if inside else None
