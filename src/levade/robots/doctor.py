"""The doctor: find what is suspicious about a robot, and say what to do about it.

for finding in inspect(load_robot("my.urdf")):
    print(finding.kind, finding)

The result includes what was noticed on loading (`Robot.findings`). The checks here look at the robot as it will be simulated.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.dimensions import dimensions
from levade.robots.findings import Finding, named, named_joints, note, some, warning
from levade.robots.preparing import TIMESTEP
from levade.robots.robot import Robot
from levade.robots.settling import doubt_standing
from levade.robots.shapes import support
from levade.robots.standing import Bare
from levade.robots.symmetry import mirror_signs
from levade.robots.understanding import Leg, joint_positions, moved_bodies

_MASS = (0.2, 500.0)  # kg, of a robot
_DOWN = np.array([0.0, 0.0, -1.0])
_ANGLES = 11
"""Number of angles per joint when testing how high a leg of three joints reaches."""
_TRIES = 1500
"""Approximate limit on the combinations of angles for legs with more joints."""


@dataclass(frozen=True)
class Patient:
    """Holds a robot and values that several checks need.

    Attributes:
        robot: The robot.
    """

    robot: Robot

    @cached_property
    def bare(self) -> Bare:
        """The robot in the form that `levade.robots.standing` needs."""
        limits = self.robot.limits
        ranges = zip(limits.lower.tolist(), limits.upper.tolist(), strict=True)
        robot = self.robot
        return Bare(
            robot.model,
            robot.model.body(robot.trunk).id,
            robot.legs,
            dict(zip(robot.joint_names, ranges, strict=True)),
        )

    @cached_property
    def neutral(self) -> dict[str, float]:
        """Neutral posture: joint -> angle [rad]."""
        return dict(zip(self.robot.joint_names, self.robot.postures["neutral"].tolist(), strict=True))

    @cached_property
    def static_torque(self) -> Array:
        """Torques that carry the robot in the neutral posture [Nm], shape (joints,)."""
        return np.array(list(self.bare.static_torque(self.neutral).values()))

    @cached_property
    def leg_length(self) -> float:
        """Length of the longest leg [m]."""
        return max(self.bare.leg_length(leg) for leg in self.robot.standing)

    def mass(self, leg: Leg) -> float:
        """Return the mass of the bodies that a leg moves [kg].

        Args:
            leg: A leg of the robot.

        Returns:
            The mass [kg].
        """
        return float(self.robot.model.body_mass[moved_bodies(self.robot.model, leg)].sum())


def inspect(robot: Robot) -> list[Finding]:
    """Inspect a robot.

    Args:
        robot: The robot.

    Returns:
        Everything that was noticed, warnings first.
    """
    patient = Patient(robot)
    found = list(robot.findings)
    for check in (_masses, _ranges, _torques, _feet, _shapes, _back, _servos, _symmetry, _frame, _physics):
        found += check(patient)
    found += doubt_standing(robot)
    return sorted(dict.fromkeys(found), key=lambda finding: finding.kind != "warning")


def warnings(robot: Robot) -> list[Finding]:
    """Inspect a robot for what may spoil a motion.

    Args:
        robot: The robot.

    Returns:
        The warnings of `inspect`.
    """
    return [finding for finding in inspect(robot) if finding.kind == "warning"]


def _masses(patient: Patient) -> Iterator[Finding]:
    robot, model = patient.robot, patient.robot.model
    if not _MASS[0] <= robot.mass <= _MASS[1]:
        yield warning("robot", f"weighs {robot.mass:.3g} kg", "masses are in kg: check the unit in the file")
    legs = [patient.mass(leg) for leg in robot.legs]
    trunk = robot.mass - sum(legs)
    heavy = [leg.name for leg, mass in zip(robot.legs, legs, strict=True) if mass > trunk]
    if heavy:
        what = f"heavier than the trunk ({max(legs):.3g} kg, trunk {trunk:.3g} kg)"
        yield warning(named("leg", heavy), what, "check the masses of its links, and that the trunk has its own")
    small, large = [], []
    for body in range(1, model.nbody):
        if model.body_mass[body] < 1e-3 * robot.mass:
            continue
        gyration = float(np.sqrt(model.body_inertia[body].max() / model.body_mass[body]))
        if gyration < 1e-3 * patient.leg_length:
            small.append((model.body(body).name, gyration))
        if gyration > 2 * model.stat.extent:
            large.append((model.body(body).name, gyration))
    for bodies, what in ((small, "almost no inertia for its mass"), (large, "far too much inertia for its mass")):
        if bodies:
            radius = bodies[0][1]
            yield warning(
                named("body", [name for name, _ in bodies]),
                f"{what} (radius of gyration {radius:.2g} m)",
                "check its unit: kg m2, about the centre of mass",
            )


def _ranges(patient: Patient) -> Iterator[Finding]:
    robot, limits = patient.robot, patient.robot.limits
    width = limits.upper - limits.lower
    names = np.array(robot.joint_names)
    endless = ~np.isfinite(width)
    if endless.any():
        remedy = 'give one in the file: <limit lower= upper=> of a URDF, range="..." of an MJCF'
        yield warning(_joints(patient, endless), "no range: the joint turns without limit", remedy)
    wide = ~endless & (width > 2 * np.pi)
    if wide.any():
        what = f"a range of more than a whole turn ({width[wide].max():.3g} rad) does not limit the joint"
        yield note(_joints(patient, wide), what, "the file's range should be that of the hardware, in rad")
    narrow = width < 0.2
    if narrow.any():
        what = f"a range of only {width[narrow].min():.2g} rad"
        yield warning(_joints(patient, narrow), what, "is it in the file's unit of angles (a URDF has rad)?")
    neutral = robot.postures["neutral"]
    near = np.minimum(neutral - limits.lower, limits.upper - neutral) < np.minimum(0.02, 0.02 * width)
    near[endless] = False
    if near.any():
        what = f"at an end of its range in the neutral posture ({names[near][0]} at {neutral[near][0]:.3g} rad)"
        yield warning(_joints(patient, near), what, "check the range, or give robot.yaml, postures: {neutral: ...}")


def _torques(patient: Patient) -> Iterator[Finding]:
    robot, limits = patient.robot, patient.robot.limits
    free = ~np.isfinite(limits.torque)
    if free.any():
        remedy = "robot.yaml, limits: {torque: ...} gives one"
        yield warning(_joints(patient, free), "no torque limit: torque is unbounded in simulation", remedy)
    share = np.abs(patient.static_torque) / limits.torque
    worst = int(np.argmax(share))
    needs = f"{np.abs(patient.static_torque[worst]):.3g} Nm to stand"
    where, limit = f"joint {robot.joint_names[worst]}", f"{limits.torque[worst]:.3g} Nm"
    if share[worst] > 1.0:
        what = f"needs {needs} in the neutral posture; its limit is {limit}"
        yield warning(where, what, "check masses and limits, or stand straighter: robot.yaml, postures: {neutral: ...}")
    elif share[worst] > 0.6:
        yield note(
            where, f"needs {needs}, {share[worst]:.0%} of its limit of {limit}: little torque is left for motion"
        )
    slow = ~np.isfinite(limits.velocity)
    if slow.any():
        remedy = "robot.yaml, limits: {velocity: ...} gives one"
        yield warning(_joints(patient, slow), "no speed limit: speed is unbounded in simulation", remedy)


def _feet(patient: Patient) -> Iterator[Finding]:
    robot, model = patient.robot, patient.robot.model
    sphere = mujoco.mjtGeom.mjGEOM_SPHERE
    kinds = {leg.foot: mujoco.mjtGeom(int(model.geom(leg.foot).type[0])) for leg in robot.standing}
    flat = [foot for foot, kind in kinds.items() if kind != sphere] if len(robot.standing) > 2 else []
    if flat:
        shape = kinds[flat[0]].name.removeprefix("mjGEOM_").lower()
        many = kinds[flat[0]] in (mujoco.mjtGeom.mjGEOM_MESH, mujoco.mjtGeom.mjGEOM_BOX)
        what = f"a {shape}, not a sphere" + (": contact jumps from corner to corner" if many else "")
        remedy = "a sphere at the tip is best; robot.yaml, legs: {lf: {foot: ...}} names another shape of the model"
        yield Finding("warning" if many else "note", named("foot", flat), what, remedy)
    data = robot.data_at(robot.postures["neutral"])
    depth = {leg.foot: min(_lowest(model, data, model.geom(g).id) for g in leg.soles) for leg in robot.standing}
    ground = min(depth.values())
    height = max(dimensions(robot).height, 0.25 * patient.leg_length)
    uneven = [foot for foot, z in depth.items() if z > ground + 0.02 * height]
    if uneven:
        what = f"up to {max(depth.values()) - ground:.2g} m above the lowest one in the neutral posture"
        yield note(named("foot", uneven), what, "robot.yaml, postures: {neutral: ...}")
    feet = {model.geom(geom).id for leg in robot.standing for geom in leg.soles}
    lower = [
        model.geom(g).name or model.body(int(model.geom_bodyid[g])).name
        for g in range(model.ngeom)
        if g not in feet
        and (model.geom_contype[g] or model.geom_conaffinity[g])
        and _lowest(model, data, g) < ground - 0.01 * height
    ]
    if lower:
        what = "below the feet in the neutral posture: the robot stands on it"
        yield warning(named("shape", lower), what, "robot.yaml, legs: {lf: {foot: ...}} names the shape to stand on")


def _shapes(patient: Patient) -> Iterator[Finding]:
    robot, model = patient.robot, patient.robot.model
    if any("collides with nothing" in finding.what for finding in robot.findings):
        return
    colliding = {
        int(model.geom_bodyid[g]) for g in range(model.ngeom) if model.geom_contype[g] or model.geom_conaffinity[g]
    }
    trunk = model.body(robot.trunk).id
    welded = {b for b in range(model.nbody) if model.body_weldid[b] == model.body_weldid[trunk]}
    if not colliding & welded:
        what = "without a collision shape: falls through the ground"
        yield warning(f"trunk {robot.trunk}", what, "give it one, such as a box; falls and boxes need it")
    shanks = [model.body(int(model.geom(leg.foot).bodyid[0])).name for leg in robot.standing]
    links = [
        model.body(int(model.jnt_bodyid[model.joint(joint).id])).name
        for leg in robot.standing
        for joint, role in zip(leg.joints, leg.roles, strict=True)
        if role in ("hfe", "kfe") and int(model.jnt_bodyid[model.joint(joint).id]) not in colliding
    ]
    open_links = [link for link in links if link not in shanks]
    if open_links:
        what = "without a collision shape: nothing stops it"
        yield note(named("body", open_links), what, "give it a capsule where the motion may touch it")


def _back(patient: Patient) -> Iterator[Finding]:
    """Check whether feet reach the ground when the robot lies on its back, which self-righting needs."""
    robot, model = patient.robot, patient.robot.model
    if robot.stance == "upright":  # it sits up instead
        return
    data = robot.data_at(robot.postures["neutral"])
    trunk = int(model.body_weldid[model.body(robot.trunk).id])
    shapes = [
        g
        for g in range(model.ngeom)
        if model.body_weldid[model.geom_bodyid[g]] == trunk and (model.geom_contype[g] or model.geom_conaffinity[g])
    ]
    if not shapes:
        return
    back = max(float(support(model, data, g, -_DOWN)[2]) for g in shapes)
    endless = ~np.isfinite(robot.limits.upper - robot.limits.lower)
    lower = np.where(endless, -np.pi, robot.limits.lower)
    upper = np.where(endless, np.pi, robot.limits.upper)
    highest = -np.inf
    legs = [[robot.joint_names.index(joint) for joint in leg.joints] for leg in robot.standing]
    feet = [model.geom(leg.foot).id for leg in robot.standing]
    angles = robot.postures["neutral"].copy()
    addresses = joint_positions(model, robot.joint_names)
    most = max(map(len, legs))
    angles_tried = max(2, min(_ANGLES, int(_TRIES ** (1 / most))))
    for shares in itertools.product(np.linspace(0.0, 1.0, angles_tried), repeat=most):
        for leg in legs:
            angles[leg] = lower[leg] + np.array(shares[: len(leg)]) * (upper[leg] - lower[leg])
        data.qpos[addresses] = angles
        mujoco.mj_kinematics(model, data)
        highest = max(highest, *(float(support(model, data, foot, -_DOWN)[2]) for foot in feet))
        if highest >= back:
            return
    what = f"lying on its back, feet stay about {back - highest:.2f} m over the ground, within the ranges of the joints"
    yield note("robot", what, "it can turn over only by swinging its legs, if at all")


def _servos(patient: Patient) -> Iterator[Finding]:
    """Check the servos' stability.

    Explicit integration of M dv/dt = -D v - K q over a time step h is unstable for eigenvalues of h D / M above 2 and of
    h2 K / (M + h D) above 4.
    """
    robot, model = patient.robot, patient.robot.model
    data = robot.data_at(robot.postures["neutral"])
    mujoco.mj_makeM(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    if not np.isfinite(inertia).all() or not np.isfinite(np.linalg.inv(inertia)).all():
        return  # masses are far out of range, which another check reports
    dofs = [int(model.joint(joint).dofadr[0]) for joint in robot.joint_names]
    stiffness, damping = np.zeros(model.nv), np.zeros(model.nv)
    stiffness[dofs], damping[dofs] = robot.actuation.kp, robot.actuation.kd
    remedy = "lower gains (robot.yaml, actuations), more armature in the model, or a smaller physics.timestep"
    step = f"a time step of {TIMESTEP * 1000:g} ms"
    ratio, dof = _largest(inertia, damping)
    if ratio * TIMESTEP > 2.0:
        where = f"joint {robot.joint_names[dofs.index(dof)]}"
        what = f"its damping is {_times(ratio * TIMESTEP / 2)} what is stable at {step} once its torque saturates"
        yield warning(where, what, remedy)
    ratio, dof = _largest(inertia + np.diag(TIMESTEP * damping), stiffness)
    if ratio * TIMESTEP**2 > 4.0:
        where = f"joint {robot.joint_names[dofs.index(dof)]}"
        yield warning(where, f"its stiffness is {_times(ratio * TIMESTEP**2 / 4)} what is stable at {step}", remedy)


def _times(ratio: float) -> str:
    """Write a ratio above one for messages: 4 % above, 3 times."""
    return f"{100 * (ratio - 1):.2g} % above" if ratio < 2 else f"{ratio:.2g} times"


def _largest(inertia: Array, diagonal: Array) -> tuple[float, int]:
    """Return the largest eigenvalue of inertia^-1 diagonal, and the degree of freedom that it moves most."""
    root = np.sqrt(diagonal)
    values, vectors = np.linalg.eigh(root[:, None] * np.linalg.inv(inertia) * root)
    return float(values[-1]), int(np.argmax(np.abs(vectors[:, -1])))


def _symmetry(patient: Patient) -> Iterator[Finding]:
    robot, limits = patient.robot, patient.robot.limits
    by_place = {(leg.kind, leg.side, leg.end): leg for leg in robot.legs}
    pairs = [
        (leg, by_place[kind, "right", end])
        for (kind, side, end), leg in by_place.items()
        if side == "left" and (kind, "right", end) in by_place
    ]
    if 2 * len([left for left, _ in pairs if left.stands]) < len(robot.standing):
        return
    for left, right in pairs:
        where = f"{left.kind}s {left.name} and {right.name}"
        try:
            signs = mirror_signs(robot, left, right)
        except LevadeError as error:
            problem = str(error).partition("not mirror images: ")[2] or str(error)
            remedy = "fix the model; a task with policy: {groups: independent} works without"
            yield warning(where, f"not mirror images: {problem}", remedy)
            continue
        masses = [patient.mass(leg) for leg in (left, right)]
        if abs(masses[0] - masses[1]) > 0.05 * max(masses):
            yield warning(where, f"weigh {masses[0]:.3g} and {masses[1]:.3g} kg", "check the masses of their links")
        one, other = robot.joint_indices(left), robot.joint_indices(right)
        mirrored = np.sort(np.stack([signs * limits.lower[other], signs * limits.upper[other]]), axis=0)
        with np.errstate(invalid="ignore"):
            gaps = np.nan_to_num(np.abs(mirrored - np.stack([limits.lower[one], limits.upper[one]]))).max(axis=0)
        uneven = [f"{a} and {b}" for a, b, gap in zip(left.joints, right.joints, gaps, strict=True) if gap > 0.1]
        if uneven:
            what = f"ranges that are not mirror images, by {gaps.max():.2g} rad"
            yield warning(f"joints {some(uneven)}", what, "check the limits in the file")
        if not np.allclose(limits.torque[one], limits.torque[other], rtol=0.02):
            yield warning(where, "different torque limits left and right", "check the limits in the file")
    data = robot.data_at(robot.postures["neutral"])
    mujoco.mj_comPos(robot.model, data)
    feet = robot.foot_positions(robot.postures["neutral"])
    off = float(data.subtree_com[0, 1] - feet[:, 1].mean())
    if abs(off) > 0.1 * np.ptp(feet[:, 1]):
        what = (
            f"its centre of mass is {abs(off):.2g} m to the {'left' if off > 0 else 'right'} of the middle of the feet"
        )
        yield warning("robot", what, "check the origins of the inertials")


def _frame(patient: Patient) -> Iterator[Finding]:
    robot = patient.robot
    for leg in robot.legs:
        told = _place_in_name(leg.joints[0])
        if told is not None and told != (leg.side, leg.end):
            what = f"its joints' names ({leg.joints[0]}) say {' '.join(told)}, the kinematics {leg.side} {leg.end}"
            remedy = (
                f"does x of {robot.trunk} point forward, and y left? rotate that frame, or give robot.yaml, legs: ..."
            )
            yield warning(f"leg {leg.name}", what, remedy)
            return
    data = robot.data_at(robot.postures["neutral"])
    if robot.ahead < 0:
        what = "x points backward, judged by its toes: tasks take front and back from the toes, left and right from the frame"
        yield note(f"trunk {robot.trunk}", what, "rotate that frame")
    if robot.stance != "level":
        return
    hips = np.array([data.joint(leg.joints[0]).xanchor for leg in robot.standing])
    length, width = np.ptp(hips[:, 0]), np.ptp(hips[:, 1])
    if width > 1.5 * length:
        what = f"hips {width:.2g} m apart from left to right, but {length:.2g} m from front to hind"
        yield warning(f"trunk {robot.trunk}", what, "does its x point forward? rotate that frame if not")


_PLACES = {
    **dict.fromkeys(("lf", "fl"), ("left", "front")),
    **dict.fromkeys(("rf", "fr"), ("right", "front")),
    **dict.fromkeys(("lh", "hl", "rl", "bl", "lb"), ("left", "hind")),
    **dict.fromkeys(("rh", "hr", "rr", "br", "rb"), ("right", "hind")),
}
_SIDES = {"left": "left", "right": "right"}
_ENDS = {"front": "front", "fore": "front", "hind": "hind", "rear": "hind", "back": "hind"}


def _place_in_name(joint: str) -> tuple[str, str] | None:
    """Read (side, end) from a joint's name, such as FL_hip, lh_haa_joint, front_left_hip; None if it has none."""
    words = re.findall(r"[a-z]+", re.sub(r"([a-z])([A-Z])", r"\1_\2", joint).lower())
    for word in words:
        if word in _PLACES:
            return _PLACES[word]
    sides = {_SIDES[word] for word in words if word in _SIDES}
    ends = {_ENDS[word] for word in words if word in _ENDS}
    return (sides.pop(), ends.pop()) if len(sides) == len(ends) == 1 else None


def _physics(patient: Patient) -> Iterator[Finding]:
    """Check for settings of an MJCF that do not hold for a robot on the ground."""
    model = patient.robot.model
    if not np.allclose(model.opt.gravity, [0.0, 0.0, -9.81], atol=0.02):
        gravity = ", ".join(f"{value:g}" for value in model.opt.gravity)
        yield warning("option gravity", f"is ({gravity}) m/s2", "remove it from the file, for 9.81 m/s2 downward")
    off = [
        name.removeprefix("mjDSBL_").lower()
        for name, bit in mujoco.mjtDisableBit.__members__.items()
        if name in ("mjDSBL_CONTACT", "mjDSBL_GRAVITY", "mjDSBL_CONSTRAINT", "mjDSBL_LIMIT", "mjDSBL_ACTUATION")
        and model.opt.disableflags & bit
    ]
    if off:
        yield warning(f"option flag {', '.join(off)}", "is turned off", "remove it from the file")
    floating = [model.body(b).name for b in range(1, model.nbody) if model.body_gravcomp[b]]
    if floating:
        what = "gravity is compensated there, but not on the hardware"
        yield warning(named("body", floating), what, 'remove gravcomp="..." from the file')


def _joints(patient: Patient, chosen: NDArray[np.bool_]) -> str:
    names = [name for name, taken in zip(patient.robot.joint_names, chosen, strict=True) if taken]
    return named_joints(names, len(patient.robot.joint_names))


def _lowest(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> float:
    return float(support(model, data, geom, _DOWN)[2])
