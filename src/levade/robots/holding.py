"""Holding: remove joints that belong to no leg from the model. Their bodies stay where the joints' angles put them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.inertias import survive_text
from levade.robots.reading import Draft
from levade.robots.world import delete_tendons

_HINGE, _SLIDE, _BALL = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_BALL

Angle = float | Array
"""Position of a joint: of a hinge [rad], of a slide [m], or the quaternion of a ball, shape (4,)."""


@dataclass(frozen=True)
class Held:
    """Holds a joint that was removed and the pose of its body without it, so that it can be held elsewhere.

    Attributes:
        body: Name of the body.
        kind: Kind of joint (`mujoco.mjtJoint`).
        axis: Axis in the body's frame, shape (3,).
        anchor: Anchor in the body's frame [m], shape (3,).
        ref: Angle at which the body has ``position`` and ``quaternion`` [rad], or [m] of a slide.
        position: Position of the body in its parent [m], shape (3,).
        quaternion: Attitude of the body in its parent, shape (4,).
    """

    body: str
    kind: int
    axis: Array
    anchor: Array
    ref: float
    position: Array
    quaternion: Array

    def pose(self, angle: Angle) -> tuple[Array, Array]:
        """Return the pose of the body in its parent, with the joint at an angle.

        Args:
            angle: Position of the joint: of a hinge [rad], of a slide [m], or the quaternion of a ball, shape (4,).

        Returns:
            Position [m], shape (3,), and quaternion, shape (4,).
        """
        turned, product = np.empty(3), self.quaternion.copy()
        if self.kind == _SLIDE:
            shift = self.axis / np.linalg.norm(self.axis) * (float(angle) - self.ref)
            mujoco.mju_rotVecQuat(turned, shift, self.quaternion)
            return self.position + turned, product
        turn, moved = self.turn(angle), np.empty(3)
        mujoco.mju_rotVecQuat(moved, self.anchor, turn)
        mujoco.mju_rotVecQuat(turned, self.anchor - moved, self.quaternion)
        product = np.empty(4)
        mujoco.mju_mulQuat(product, self.quaternion, turn)
        return self.position + turned, product

    def turn(self, angle: Angle) -> Array:
        """Return the rotation by which a hinge or ball at an angle turns its body.

        Args:
            angle: Angle of the hinge [rad], or the quaternion of a ball, shape (4,). For a ball, any number means no
                rotation.

        Returns:
            Quaternion, shape (4,).
        """
        turn = np.empty(4)
        if self.kind == _BALL:
            turn = np.array([1.0, 0.0, 0.0, 0.0]) if np.ndim(angle) == 0 else np.array(angle, dtype=float)
            mujoco.mju_normalize4(turn)
            return turn
        mujoco.mju_axisAngle2Quat(turn, self.axis / np.linalg.norm(self.axis), float(angle) - self.ref)
        return turn


def fix_joints(draft: Draft, angles: Mapping[str, Angle], path: Path) -> dict[str, Held]:
    """Remove joints from the model. Their bodies stay where the angles put them.

    Args:
        draft: The model; it is changed.
        angles: Joint name -> angle [rad], or [m] of a slide.
        path: Path of the description, for messages.

    Returns:
        Joint name -> held joint, for `hold_elsewhere`.

    Raises:
        LevadeError: If a joint cannot be held at that angle.
    """
    if not draft.urdf:  # in the saved text, frames and Euler angles are resolved and angles are in radians
        text, _ = survive_text(draft)
        draft.spec = mujoco.MjSpec.from_string(text, assets=draft.assets)
        draft.spec.assets = draft.assets
    spec = draft.spec
    _loosen(spec, set(angles))
    # joints of one body act in sequence: each one carries those before it
    order = [joint.name for body in spec.bodies for joint in body.joints if joint.name in angles]
    found = {}
    for name in order:
        joint, angle = spec.joint(name), angles[name]
        if joint.type not in (_HINGE, _SLIDE, _BALL):
            raise LevadeError(f"{path}: joint {name} cannot be held fixed: it floats freely")
        if joint.type == _BALL and np.ndim(angle) == 0 and angle != 0:
            raise LevadeError(f"{path}: fixed: joint {name} is a ball joint: it can be held at 0 only")
        body = joint.parent
        held = Held(
            body.name,
            int(joint.type),
            np.array(joint.axis, dtype=float),
            np.array(joint.pos, dtype=float),
            float(joint.ref),
            np.array(body.pos, dtype=float),
            np.array(body.quat, dtype=float),
        )
        if not np.isclose(np.linalg.norm(held.quaternion), 1.0):
            raise LevadeError(f"{path}: joint {name} cannot be held fixed: body {body.name} has no orientation")
        _carry_earlier(body, name, held, angle)
        body.pos, body.quat = held.pose(angle)
        spec.delete(joint)
        found[name] = held
        if np.ndim(angle) == 0:
            draft.held[name] = float(angle)
    return found


def hold_elsewhere(draft: Draft, name: str, held: Held, angle: float) -> None:
    """Move the body of a held joint to another angle. The body must have no other joint.

    Args:
        draft: The model; it is changed.
        name: Name of the joint.
        held: The held joint.
        angle: Angle of the joint [rad], or [m] of a slide.
    """
    body = draft.spec.body(held.body)
    body.pos, body.quat = held.pose(angle)
    draft.held[name] = float(angle)


def _carry_earlier(body: mujoco.MjsBody, name: str, held: Held, angle: Angle) -> None:
    """Restate the remaining joints of a body that come before a removed one, since the body turns under them.

    With T the pose without joints, E an earlier joint and H the one that is held, T E H = (T H) (H^-1 E H).
    """
    for other in body.joints:
        if other.name == name:
            return
        axis, anchor = np.array(other.axis, dtype=float), np.array(other.pos, dtype=float)
        if held.kind == _SLIDE:
            anchor = anchor - held.axis / np.linalg.norm(held.axis) * (float(angle) - held.ref)
        else:
            back, turned = np.empty(4), np.empty(3)
            mujoco.mju_negQuat(back, held.turn(angle))
            mujoco.mju_rotVecQuat(turned, axis, back)
            axis = turned.copy()
            mujoco.mju_rotVecQuat(turned, anchor - held.anchor, back)
            anchor = held.anchor + turned
        other.axis, other.pos = axis, anchor


def _loosen(spec: mujoco.MjSpec, joints: set[str]) -> None:
    """Delete the tendons that run over the joints, and the equalities that bind them."""
    kinds = mujoco.mjtWrap.mjWRAP_JOINT
    delete_tendons(spec, [t for t in spec.tendons if any(w.type == kinds and w.target.name in joints for w in t.path)])
    for equality in list(spec.equalities):
        if equality.type == mujoco.mjtEq.mjEQ_JOINT and joints & {equality.name1, equality.name2}:
            spec.delete(equality)
