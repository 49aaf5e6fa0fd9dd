"""Write an `Embodiment` as JSON into a motion file's ``meta``, and read it back."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.embodiment import Embodiment, JointLimits, LegGeometry, TorqueCurve
from levade.motions.file import finite, with_infinity
from levade.robots import Leg

Lines = tuple[Array, Array] | tuple[None, None]
"""Stall torque [Nm] and no-load speed [rad/s], shape (joints,) each. None if no actuator has such a line."""


def robot_facts(embodiment: Embodiment, legs: Sequence[Leg]) -> dict[str, Any]:
    """Describe a robot for ``meta``: ``trunk``, ``legs``, ``limits``, ``trunk_com_offset`` and ``trunk_balls``.

    Args:
        embodiment: The robot as simulations and costs describe it.
        legs: Its legs, in the order of ``embodiment.legs``.

    Returns:
        JSON.
    """
    return {
        "trunk": embodiment.trunk,
        "legs": {
            leg.name: {
                "joints": list(leg.joints),
                "foot": leg.foot,
                "side": leg.side,
                "end": leg.end,
                **({} if leg.stands else {"kind": leg.kind}),
                **({"pads": list(leg.pads)} if leg.pads else {}),
                "geometry": {
                    "anchors": shape.anchors.tolist(),
                    "axes": shape.axes.tolist(),
                    "foot": shape.foot.tolist(),
                    "sole": shape.sole,
                },
            }
            for leg, shape in zip(legs, embodiment.legs, strict=True)
        },
        "limits": _limit_facts(embodiment.limits),
        "trunk_com_offset": embodiment.trunk_com_offset.tolist(),
        "trunk_balls": embodiment.trunk_balls.tolist(),
    }


def legs_of(meta: Mapping[str, Any]) -> tuple[Leg, ...]:
    """Read the robot's legs.

    Args:
        meta: The file's ``meta``.

    Returns:
        The legs, without the roles of their joints.
    """
    return tuple(
        Leg(
            name,
            tuple(leg["joints"]),
            str(leg["foot"]),
            str(leg.get("side", "")),
            str(leg.get("end", "")),
            kind=str(leg.get("kind", "leg")),
            pads=tuple(str(pad) for pad in leg.get("pads", ())),
        )
        for name, leg in meta["legs"].items()
    )


def embodiment_of(meta: Mapping[str, Any], joint_names: tuple[str, ...], lines: Callable[[], Lines]) -> Embodiment:
    """Read the robot.

    Args:
        meta: The file's ``meta``.
        joint_names: Names of the joints, in order.
        lines: Called for the actuators' lines if the file has none, as files of layout 1.

    Returns:
        The robot.
    """
    return Embodiment(
        trunk=str(meta["trunk"]),
        joint_names=joint_names,
        feet=tuple(str(leg["foot"]) for leg in meta["legs"].values()),
        limits=_limits_of(meta["limits"], lines),
        trunk_com_offset=np.array(meta["trunk_com_offset"], dtype=float),
        legs=tuple(
            LegGeometry(
                name=name,
                side=leg.get("side", ""),
                end=leg.get("end", ""),
                joints=tuple(joint_names.index(joint) for joint in leg["joints"]),
                anchors=np.array(leg["geometry"]["anchors"], dtype=float),
                axes=np.array(leg["geometry"]["axes"], dtype=float),
                foot=np.array(leg["geometry"]["foot"], dtype=float),
                sole=float(leg["geometry"]["sole"]),
                stands=leg.get("kind", "leg") == "leg",
            )
            for name, leg in meta["legs"].items()
            if leg.get("geometry") is not None
        ),
        trunk_balls=np.array(meta.get("trunk_balls", []), dtype=float).reshape(-1, 4),
    )


def actuator_lines(model: mujoco.MjModel, joint_names: Sequence[str]) -> Lines:
    """Read the torque–speed lines of a model's actuators; infinite for an actuator without one.

    Args:
        model: The compiled model, whose actuators have the names of the joints.
        joint_names: Names of the joints, in order.

    Returns:
        Stall torque [Nm] and no-load speed [rad/s], shape (joints,) each. None for both if no actuator has a line.
    """
    lines = np.full((2, len(joint_names)), np.inf)
    for i, name in enumerate(joint_names):
        actuator = model.actuator(name).id
        if model.actuator_gaintype[actuator] == mujoco.mjtGain.mjGAIN_DCMOTOR:
            resistance, constant, voltage = (float(model.actuator_gainprm[actuator, k]) for k in (0, 1, 7))
            if resistance > 0 and constant > 0 and voltage > 0:
                lines[:, i] = voltage * constant / resistance, voltage / constant
    return (lines[0], lines[1]) if np.isfinite(lines).any() else (None, None)


def _limit_facts(limits: JointLimits) -> dict[str, Any]:
    stall, speed = limits.stall_torque, limits.no_load_speed
    return {
        "lower": finite(limits.lower),
        "upper": finite(limits.upper),
        "velocity": finite(limits.velocity),
        "torque": finite(limits.torque),
        "stall_torque": None if stall is None else finite(stall),
        "no_load_speed": None if speed is None else finite(speed),
        "torque_curves": {
            str(joint): {"peak": curve.peak, "rate": curve.rate, "centre": curve.centre}
            for joint, curve in limits.torque_curves.items()
        },
        "assumed_velocity": list(limits.assumed_velocity),
        "assumed_torque": list(limits.assumed_torque),
    }


def _limits_of(facts: Mapping[str, Any], lines: Callable[[], Lines]) -> JointLimits:
    if "stall_torque" in facts:
        stall, speed = (facts[name] for name in ("stall_torque", "no_load_speed"))
        line = (None, None) if stall is None or speed is None else (with_infinity(stall), with_infinity(speed))
    else:
        line = lines()
    return JointLimits(
        lower=with_infinity(facts["lower"], -np.inf),
        upper=with_infinity(facts["upper"]),
        velocity=with_infinity(facts["velocity"]),
        torque=with_infinity(facts["torque"]),
        torque_curves={int(joint): TorqueCurve(**curve) for joint, curve in facts.get("torque_curves", {}).items()},
        stall_torque=line[0],
        no_load_speed=line[1],
        assumed_velocity=tuple(facts.get("assumed_velocity", ())),
        assumed_torque=tuple(facts.get("assumed_torque", ())),
    )
