"""Loops: joints that follow others, and bodies that a constraint holds together; levade moves serial legs only.

A follower (``<mimic>`` of a URDF, a joint equality of an MJCF) is held where its leader's neutral angle puts it. A loop
(``<connect>``, ``<weld>``) is opened where one side of it is loose: no motor drives that side, so that nothing but its
own weight comes through it. What would push on a leg is refused.
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
"""Joints in a tendon from which on it binds a sum, and does not tie one joint to another."""
_SERIAL = "levade moves legs without closed loops: give it a serial model, each of whose joints has a motor"


@dataclass(frozen=True)
class Coupling:
    """A joint that another one leads: its angle is the polynomial of the leader's.

    follower, leader: joint names; the leader is empty where the angle is constant. coefficients: lowest power first.
    kind: what the file calls it.
    """

    follower: str
    leader: str
    coefficients: tuple[float, ...]
    kind: str

    def at(self, leader: float) -> float:
        """The follower's angle."""
        return float(np.polynomial.polynomial.polyval(leader, self.coefficients))

    @property
    def relation(self) -> str:
        """How messages write the polynomial."""
        powers = ["", *(f" {self.leader}{f'^{k}' if k > 1 else ''}" for k in range(1, len(self.coefficients)))]
        terms = [f"{c:g}{power}" for c, power in zip(self.coefficients, powers, strict=True) if c]
        return " + ".join(terms).replace("+ -", "- ") or "0"


def take_couplings(spec: mujoco.MjSpec, model: mujoco.MjModel) -> list[Coupling]:
    """Take the joint equalities out of the spec of an MJCF; those that are switched off go, too.

    Args:
        spec: The robot; it is changed.
        model: Compiled from the file, for the joints' reference angles.
    """
    found = []
    for equality in [e for e in spec.equalities if e.type == mujoco.mjtEq.mjEQ_JOINT]:
        if equality.active:
            found.append(_coupling(spec, model, equality))
        spec.delete(equality)
    return found


def follower_angles(couplings: Iterable[Coupling], angles: Mapping[str, float]) -> dict[str, float]:
    """Follower -> angle, given the angles of the other joints; a leader that has none counts as zero.

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
    """Findings about followers that are held: warnings where their leader is a joint of a leg."""
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
    """Two bodies that a constraint holds together. name: for messages. joints: on the way from one to the other."""

    name: str
    joints: frozenset[str]


def take_loops(spec: mujoco.MjSpec) -> list[Loop]:
    """Take connects and welds out of a model; those that are switched off, or hold nothing that moves, count for nothing."""
    found = []
    for equality in [e for e in spec.equalities if e.type in _OF_BODIES]:
        one, other = sides(spec, equality)
        joints = _between(spec, one, other)
        if equality.active and joints:
            found.append(Loop(label(equality, one, other), frozenset(joints)))
        spec.delete(equality)
    return found


def why_no_legs(loops: Sequence[Loop], couplings: Sequence[Coupling]) -> str:
    """What about loops and followers may be the reason that no legs were found; empty if there are none."""
    reasons = []
    if couplings:
        first = couplings[0]
        verb = "follows" if len(couplings) == 1 else "follow"
        reasons.append(
            f"{named('joint', [c.follower for c in couplings])} {verb} other joints ({first.kind}: {first.follower} ="
            f" {first.relation}), and levade drives every joint of a leg by itself"
        )
    if loops:
        verb = "closes a loop" if len(loops) == 1 else "close loops"
        reasons.append(f"{some([loop.name for loop in loops], 2)} {verb}: {_SERIAL}")
    return "; ".join(reasons)


def open_loops(
    loops: Iterable[Loop], legs: Iterable[str], held: Iterable[str], driven: set[str], where: str
) -> list[Finding]:
    """Judge the loops that were taken out of a model.

    Args:
        loops: From `take_loops`.
        legs: Joints of the legs.
        held: Joints that are held fixed.
        driven: Joints that have an actuator; empty if the file has none.
        where: What messages start with.

    Returns:
        A warning of loops beside legs, a note of others.

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
        findings.append(note(some(idle, 2), "holds together what is held fixed anyway: left out"))
    return findings


def open_tendons(spec: mujoco.MjSpec, legs: Iterable[str], where: str) -> list[Finding]:
    """Delete tendons whose length is bound.

    Returns:
        A warning of those that bind a sum of three joints of a leg or more: the leg gets a freedom that its drives do not have.

    Raises:
        LevadeError: For others over joints of legs, which they couple as a belt does.
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
                f"{where}: <tendon> {tendon.name}, whose length is bound, couples joints of a leg; {_SERIAL}"
            )
        delete_tendons(spec, [tendon])
    if not sums:
        return []
    what = "binds a sum of joints of a leg: left out, and each of them gets a servo of its own"
    return [warning(named("tendon", sums), what, "motions may bend them as the robot's own drives do not")]


def _between(spec: mujoco.MjSpec, one: str, other: str) -> set[str]:
    """Names of the joints on the way from one body to another, free joints left aside."""
    ways = [_way(spec, body) for body in (one, other)]
    bodies = set(ways[0]) ^ set(ways[1])
    free = mujoco.mjtJoint.mjJNT_FREE
    return {joint.name for body in bodies for joint in spec.body(body).joints if joint.type != free}


def _way(spec: mujoco.MjSpec, name: str) -> list[str]:
    """Names of a body and of those between it and the world."""
    found = []
    body = spec.body(name)
    while body is not None and body.name != "world":
        found.append(body.name)
        body = body.parent
    return found


def _coupling(spec: mujoco.MjSpec, model: mujoco.MjModel, equality: mujoco.MjsEquality) -> Coupling:
    """A joint equality: joint1 - ref1 is the polynomial of joint2 - ref2.

    The one of the two that carries nothing that collides (a rotor, a rod) follows, if only one does.
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
    """Whether anything that moves with a joint collides."""
    body = spec.joint(joint).parent
    return any(geom.contype or geom.conaffinity for geom in [*body.geoms, *body.find_all("geom")])
