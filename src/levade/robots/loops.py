"""Loops: handle joints that follow others, and bodies that a constraint holds together. Levade moves only serial legs.

A follower (``<mimic>`` of a URDF, a joint equality of an MJCF) is held where its leader's neutral angle puts it. A loop
(``<connect>``, ``<weld>``) is opened where one side is loose: no motor drives that side, so it transmits only its own
weight. A loop that would push on a leg is refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.findings import Finding, named, note, some, warning
from levade.robots.world import delete_tendons, label, sides, tendon_bodies

_OF_BODIES = (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD)
_SUM = 3
"""Number of joints from which on a tendon binds a sum instead of coupling one joint to another."""
_SERIAL = "levade moves legs without closed loops: give it a serial model, each of whose joints has a motor"


@dataclass(frozen=True)
class Coupling:
    """Describes a joint whose angle is a polynomial of another joint's.

    Attributes:
        follower: Name of the joint.
        leader: Name of the joint that it follows. Empty if the angle is constant.
        coefficients: Coefficients of the polynomial, lowest power first.
        kind: Name of this coupling in the file.
    """

    follower: str
    leader: str
    coefficients: tuple[float, ...]
    kind: str

    def at(self, leader: float) -> float:
        """Return the follower's angle at an angle of the leader.

        Args:
            leader: Angle of the leader [rad].

        Returns:
            Angle of the follower [rad].
        """
        return float(np.polynomial.polynomial.polyval(leader, self.coefficients))

    @property
    def relation(self) -> str:
        """The polynomial as messages write it."""
        powers = ["", *(f" {self.leader}{f'^{k}' if k > 1 else ''}" for k in range(1, len(self.coefficients)))]
        terms = [f"{c:g}{power}" for c, power in zip(self.coefficients, powers, strict=True) if c]
        return " + ".join(terms).replace("+ -", "- ") or "0"


def take_couplings(spec: mujoco.MjSpec, model: mujoco.MjModel) -> list[Coupling]:
    """Remove the joint equalities from the spec of an MJCF, including inactive ones.

    Args:
        spec: The robot; it is changed.
        model: Model compiled from the file, for the joints' reference angles.

    Returns:
        The active ones.
    """
    found = []
    for equality in [e for e in spec.equalities if e.type == mujoco.mjtEq.mjEQ_JOINT]:
        if equality.active:
            found.append(_coupling(spec, model, equality))
        spec.delete(equality)
    return found


def follower_angles(couplings: Iterable[Coupling], angles: Mapping[str, float]) -> dict[str, float]:
    """Compute the angles of followers.

    Args:
        couplings: Which joints follow which.
        angles: Joint -> angle of the other joints [rad]. A leader without one counts as zero.

    Returns:
        Follower -> angle [rad].

    Raises:
        LevadeError: If joints follow each other in a circle.
    """
    by_follower = {coupling.follower: coupling for coupling in couplings}

    def angle(joint: str, seen: tuple[str, ...] = ()) -> float:
        coupling = by_follower.get(joint)
        if coupling is None or joint in angles:
            return angles.get(joint, 0.0)
        if joint in seen:
            raise LevadeError(f"joints {some([*seen])} follow each other in a circle; one of them should lead")
        return coupling.at(angle(coupling.leader, (*seen, joint)) if coupling.leader else 0.0)

    return {joint: angle(joint) for joint in by_follower}


def say_followers(couplings: Iterable[Coupling], held: Mapping[str, float], legs: Iterable[str]) -> list[Finding]:
    """Describe held followers.

    Args:
        couplings: Which joints follow which.
        held: Follower -> angle at which it is held [rad].
        legs: Names of the legs' joints.

    Returns:
        Warnings about followers of a leg's joint, notes about others.
    """
    legs = set(legs)
    findings = []
    for in_leg, add in ((True, warning), (False, note)):
        group = [c for c in couplings if c.follower in held and (c.leader in legs) == in_leg]
        if not group:
            continue
        first = group[0]
        values = sorted({f"{held[c.follower]:.3g}" for c in group}, key=float)
        at = values[0] if len(values) == 1 else f"{values[0]} to {values[-1]}"
        what = f"{'follows' if len(group) == 1 else 'follow'} other joints ({first.follower} = {first.relation}):"
        where = "where the neutral posture puts them" if in_leg else "where these are held"
        what = f"{what} held fixed at {at} rad, {where}"
        findings.append(
            add(
                named("joint", [c.follower for c in group]),
                what,
                "robot.yaml, fixed: {joint: angle} holds them elsewhere",
            )
        )
    return findings


@dataclass(frozen=True)
class Loop:
    """Describes two bodies that a constraint holds together.

    Attributes:
        name: Name for messages.
        joints: Names of the joints between the two bodies.
    """

    name: str
    joints: frozenset[str]


def take_loops(spec: mujoco.MjSpec) -> list[Loop]:
    """Remove connects and welds from a model.

    Args:
        spec: The robot; it is changed.

    Returns:
        The loops, without inactive ones and those that hold nothing that moves.
    """
    found = []
    for equality in [e for e in spec.equalities if e.type in _OF_BODIES]:
        one, other = sides(spec, equality)
        joints = _between(spec, one, other)
        if equality.active and joints:
            found.append(Loop(label(equality, one, other), frozenset(joints)))
        spec.delete(equality)
    return found


def why_no_legs(loops: Sequence[Loop], couplings: Sequence[Coupling]) -> str:
    """Explain which loops and followers may be the reason that no legs were found.

    Args:
        loops: The loops.
        couplings: Which joints follow which.

    Returns:
        The reason for a message. Empty without loops and followers.
    """
    reasons = []
    if couplings:
        first = couplings[0]
        verb = "follows" if len(couplings) == 1 else "follow"
        reasons.append(
            f"{named('joint', [c.follower for c in couplings])} {verb} other joints ({first.kind}: {first.follower} ="
            f" {first.relation}), but levade drives every joint of a leg separately"
        )
    if loops:
        verb = "closes a loop" if len(loops) == 1 else "close loops"
        reasons.append(f"{some([loop.name for loop in loops], 2)} {verb}: {_SERIAL}")
    return "; ".join(reasons)


def open_loops(
    loops: Iterable[Loop], legs: Iterable[str], held: Iterable[str], driven: set[str], where: str
) -> list[Finding]:
    """Judge the loops that were removed from a model.

    Args:
        loops: Loops from `take_loops`.
        legs: Joints of the legs.
        held: Joints that are held fixed.
        driven: Joints that have an actuator. Empty if the file has none.
        where: Prefix of messages.

    Returns:
        A warning about loops with a leg, and a note about others.

    Raises:
        LevadeError: If opening a loop changes how a leg is driven.
    """
    legs, held = set(legs), set(held)
    opened: list[str] = []
    loose: dict[str, None] = {}
    idle: list[str] = []
    for loop in loops:
        moving, still = loop.joints & legs, sorted(loop.joints & held)
        if not moving:
            idle.append(loop.name)
            continue
        motors = [joint for joint in still if joint in driven]
        if motors or not still:
            through = (
                f"{named('joint', motors)} drives it" if motors else f"it runs through {some(sorted(moving))} alone"
            )
            raise LevadeError(f"{where}: {loop.name} closes a loop with a leg, and {through}; {_SERIAL}")
        opened.append(loop.name)
        loose.update(dict.fromkeys(still))
    findings = []
    if opened:
        verb = "closes a loop" if len(opened) == 1 else "close loops"
        what = f"{verb} with a leg: opened, and {named('joint', list(loose))}, which nothing drives, held fixed"
        findings.append(warning(some(opened, 2), what, "check that motors act on the joints of the leg themselves"))
    if idle:
        findings.append(note(some(idle, 2), "holds together parts that are held fixed anyway: left out"))
    return findings


def open_tendons(spec: mujoco.MjSpec, legs: Iterable[str], where: str) -> list[Finding]:
    """Delete tendons whose length is constrained.

    Args:
        spec: The robot; it is changed.
        legs: Joints of the legs.
        where: Prefix of messages.

    Returns:
        A warning about tendons that bind a sum of three or more joints of a leg. Without them the leg has a degree of freedom
        that its drives do not have.

    Raises:
        LevadeError: If another tendon couples joints of a leg, as a belt does.
    """
    bound = {
        name
        for e in spec.equalities
        if e.type == mujoco.mjtEq.mjEQ_TENDON and e.active
        for name in (e.name1, e.name2)
        if name
    }
    bodies = {spec.joint(joint).parent.name for joint in legs}
    sums = []
    for tendon in [tendon for tendon in spec.tendons if tendon.name in bound]:
        wraps = [wrap.type for wrap in tendon.path]
        if tendon_bodies(tendon) & bodies and len(wraps) >= _SUM and set(wraps) == {mujoco.mjtWrap.mjWRAP_JOINT}:
            sums.append(tendon.name)
        elif tendon_bodies(tendon) & bodies:
            raise LevadeError(
                f"{where}: <tendon> {tendon.name}, whose length is constrained, couples joints of a leg; {_SERIAL}"
            )
        delete_tendons(spec, [tendon])
    if not sums:
        return []
    what = "binds a sum of joints of a leg: left out, and each of these joints gets its own servo"
    return [
        warning(
            named("tendon", sums), what, "check that motions do not bend them in a way that the robot's drives cannot"
        )
    ]


def _between(spec: mujoco.MjSpec, one: str, other: str) -> set[str]:
    """Name the joints between two bodies, without free joints."""
    ways = [_way(spec, body) for body in (one, other)]
    bodies = set(ways[0]) ^ set(ways[1])
    free = mujoco.mjtJoint.mjJNT_FREE
    return {joint.name for body in bodies for joint in spec.body(body).joints if joint.type != free}


def _way(spec: mujoco.MjSpec, name: str) -> list[str]:
    """Name a body and those between it and the world."""
    found = []
    body = spec.body(name)
    while body is not None and body.name != "world":
        found.append(body.name)
        body = body.parent
    return found


def _coupling(spec: mujoco.MjSpec, model: mujoco.MjModel, equality: mujoco.MjsEquality) -> Coupling:
    """Read a joint equality, in which joint1 - ref1 is a polynomial of joint2 - ref2.

    If exactly one of the two carries nothing that collides (a rotor, a rod), that one follows.
    """
    first, second = equality.name1, equality.name2
    shape = [float(c) for c in np.asarray(equality.data)[:5]]
    ref1 = float(model.qpos0[int(model.joint(first).qposadr[0])])
    if not second:
        return Coupling(first, "", (shape[0] + ref1,), "<equality>")
    ref2 = float(model.qpos0[int(model.joint(second).qposadr[0])])
    linear = shape[1] != 0 and not any(shape[2:])
    if linear and _collides(spec, first) and not _collides(spec, second):
        slope = 1.0 / shape[1]
        return Coupling(second, first, (ref2 - (shape[0] + ref1) * slope, slope), "<equality>")
    polynomial = np.polynomial.Polynomial(shape)(np.polynomial.Polynomial([-ref2, 1.0]))
    coefficients = np.trim_zeros(polynomial.coef + np.eye(1, len(polynomial.coef))[0] * ref1, "b")
    return Coupling(first, second, tuple(float(c) for c in coefficients), "<equality>")


def _collides(spec: mujoco.MjSpec, joint: str) -> bool:
    """Tell whether anything that moves with a joint collides."""
    body = spec.joint(joint).parent
    return any(geom.contype or geom.conaffinity for geom in [*body.geoms, *body.find_all("geom")])
