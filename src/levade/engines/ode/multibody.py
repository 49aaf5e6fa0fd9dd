"""Read what ODE needs from a compiled MuJoCo model: links, hinges, drives, shapes, pairs that may touch.

A link is a body with all bodies welded to it; its frame is that of the body with the joint. Both engines use the same model, so
masses, axes, shapes and limits are the same. A part that ODE cannot express is a LevadeError that names it; docs/engines.md
lists the exceptions.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.ode.shapes import Shape, shape_of
from levade.engines.touching import friction_between, may_touch
from levade.errors import LevadeError

Index = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Hinges:
    """Hinges between links, one for every link except the trunk: hinge j moves link j + 1.

    Attributes:
        parent: Parent links, shape (J,).
        axis: Unit axes in the moving link's frame, shape (J, 3).
        anchor: Points on the axes in the moving link's frame [m], shape (J, 3).
        rest: Quaternion of the moving link in its parent's frame at angle 0, shape (J, 4).
        zero: The model's coordinate at angle 0 [rad], shape (J,).
        lower: Lower ends of the ranges [rad], infinite for none, shape (J,).
        upper: Upper ends of the ranges [rad], infinite for none, shape (J,).
        armature: Inertia of the rotors [kg m²], shape (J,).
        damping: Viscous damping [Nm s/rad], shape (J,).
        friction: Dry friction [Nm], shape (J,).
        stiffness: Stiffness of springs [Nm/rad], shape (J,).
        spring: Resting angles of springs [rad], shape (J,).
        qpos: Addresses in the model's positions, shape (J,).
        qvel: Addresses in the model's velocities, shape (J,).
    """

    names: tuple[str, ...]
    parent: Index
    axis: Array
    anchor: Array
    rest: Array
    zero: Array
    lower: Array
    upper: Array
    armature: Array
    damping: Array
    friction: Array
    stiffness: Array
    spring: Array
    qpos: Index
    qvel: Index


@dataclass(frozen=True, eq=False)
class Drives:
    """Actuators as in `levade.robots.actuation`, in the order of the hinges.

    The command is kp (position error) + kd (velocity error) [Nm]. It is clamped to the line ``(no_load -+ speed) * slope``
    (no_load infinite for none). Then it is followed with ``time_constant`` [s] (0 for at once), and clamped to ``limit`` [Nm].

    Attributes:
        act: Address of the lag's state in the model's, -1 for none, shape (J,).
        gain: Torque per unit of that state [Nm].
        ctrl: Address of the desired position among the model's controls, shape (J,). The velocity's is the next.
    """

    kp: Array
    kd: Array
    limit: Array
    no_load: Array
    slope: Array
    time_constant: Array
    gain: Array
    act: Index
    ctrl: Index


@dataclass(frozen=True, eq=False)
class Multibody:
    """A multibody system: links, and everything on and between them. Link 0 is the trunk.

    Attributes:
        mass: Masses [kg], shape (L,).
        com: Centres of mass in the link's frame [m], shape (L, 3).
        inertia: Inertias about them [kg m²], shape (L, 3, 3).
        body: The model's body with the joint, shape (L,).
        shapes: Shapes of the links and, with link -1, of the world.
        pairs: Pairs of shapes that may touch, shape (P, 2). The first is never of the world.
        friction: Coulomb coefficient of each pair, shape (P,).
        gravity: Gravity [m/s²], shape (3,).
    """

    model: mujoco.MjModel
    mass: Array
    com: Array
    inertia: Array
    body: Index
    hinges: Hinges
    drives: Drives
    shapes: tuple[Shape, ...]
    pairs: Index
    friction: Array
    gravity: Array
    root_qpos: int
    root_qvel: int


def multibody_of(model: mujoco.MjModel) -> Multibody:
    """Read a model with one free body and hinges.

    Args:
        model: The compiled model.

    Returns:
        The multibody.

    Raises:
        LevadeError: If ODE cannot simulate a part of it.
    """
    _refuse(model)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    roots = [b for b in range(1, model.nbody) if model.body_weldid[b] == b]
    trunk = next(b for b in roots if model.jnt_type[model.body_jntadr[b]] == mujoco.mjtJoint.mjJNT_FREE)
    roots.remove(trunk)
    roots.insert(0, trunk)
    link_of = {b: roots.index(int(model.body_weldid[b])) if model.body_weldid[b] else -1 for b in range(model.nbody)}
    mass, com, inertia = zip(*(_inertia(model, data, root) for root in roots), strict=True)
    shapes, geoms = [], []
    for geom in range(model.ngeom):
        if model.geom_contype[geom] or model.geom_conaffinity[geom]:
            link = link_of[int(model.geom_bodyid[geom])]
            shapes.append(shape_of(model, data, geom, link, roots[link] if link >= 0 else 0))
            geoms.append(geom)
    pairs, friction = _pairs(model, geoms, [shape.link for shape in shapes])
    hinges = _hinges(model, data, roots, link_of)
    free = int(model.body_jntadr[trunk])
    return Multibody(
        model=model,
        mass=np.array(mass),
        com=np.array(com),
        inertia=np.array(inertia),
        body=np.array(roots),
        hinges=hinges,
        drives=_drives(model, hinges),
        shapes=tuple(shapes),
        pairs=pairs,
        friction=friction,
        gravity=model.opt.gravity.copy(),
        root_qpos=int(model.jnt_qposadr[free]),
        root_qvel=int(model.jnt_dofadr[free]),
    )


def _refuse(model: mujoco.MjModel) -> None:
    """Raise LevadeError for parts of a model that affect its motion and have no counterpart here."""
    kinds = {"equality constraints": model.neq, "tendons": model.ntendon, "explicit contact pairs": model.npair}
    kinds |= {"flexes": model.nflex, "mocap bodies": model.nmocap, "plugins": model.nplugin}
    for kind, count in kinds.items():
        if count:
            raise LevadeError(f"the engine ode has no {kind}, and the model has {count}; use the engine mujoco")
    if model.body_gravcomp.any():
        body = model.body(int(np.flatnonzero(model.body_gravcomp)[0])).name
        raise LevadeError(f"body {body}: the engine ode has no compensation of gravity; use the engine mujoco")
    if model.opt.density or model.opt.viscosity:
        raise LevadeError("the engine ode has no fluid, and the model's option has one; use the engine mujoco")
    hinge, free = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_FREE)
    for body in range(1, model.nbody):
        joints = [int(model.body_jntadr[body]) + i for i in range(model.body_jntnum[body])]
        if len(joints) > 1:
            names = ", ".join(model.joint(j).name for j in joints)
            raise LevadeError(
                f"body {model.body(body).name}: the engine ode has one joint to a body, and this one has {names};"
                " put a body with a mass between them, or use the engine mujoco"
            )
        for j in joints:
            if model.jnt_type[j] not in (hinge, free):
                raise LevadeError(f"joint {model.joint(j).name}: the engine ode has hinges only; use the engine mujoco")
            if np.any(model.dof_dampingpoly[model.jnt_dofadr[j]]) or np.any(model.jnt_stiffnesspoly[j]):
                raise LevadeError(
                    f"joint {model.joint(j).name}: the engine ode has linear damping and stiffness only; use the engine"
                    " mujoco"
                )
    count = int((model.jnt_type == free).sum())
    if count != 1:
        raise LevadeError(f"the engine ode wants one free body, the trunk, and the model has {count}")


def _inertia(model: mujoco.MjModel, data: mujoco.MjData, root: int) -> tuple[float, Array, Array]:
    """Return mass, centre of mass and inertia of a body with those welded to it, in the body's frame."""
    rotation, origin = data.xmat[root].reshape(3, 3), data.xpos[root]
    parts = np.flatnonzero(model.body_weldid == root)
    mass = model.body_mass[parts]
    total = float(mass.sum())
    if total <= 0:
        raise LevadeError(f"body {model.body(root).name}: has no mass, which the engine ode cannot move")
    centres = data.xipos[parts]
    com = mass @ centres / total
    inertia = np.zeros((3, 3))
    for m, body, centre in zip(mass, parts, centres, strict=True):
        axes, lever = data.ximat[body].reshape(3, 3), centre - com
        inertia += axes @ np.diag(model.body_inertia[body]) @ axes.T
        inertia += m * (lever @ lever * np.eye(3) - np.outer(lever, lever))
    return total, rotation.T @ (com - origin), rotation.T @ inertia @ rotation


def _hinges(model: mujoco.MjModel, data: mujoco.MjData, roots: list[int], link_of: dict[int, int]) -> Hinges:
    joints = [int(model.body_jntadr[root]) for root in roots[1:]]
    dofs = model.jnt_dofadr[joints]
    parent, axis, anchor, rest = [], [], [], []
    for root, joint in zip(roots[1:], joints, strict=True):
        link = link_of[int(model.body_parentid[root])]
        if link < 0:
            raise LevadeError(
                f"joint {model.joint(joint).name}: hangs on the world; the engine ode wants it on the trunk"
            )
        rotation = data.xmat[root].reshape(3, 3)
        inverse, between = np.empty(4), np.empty(4)
        mujoco.mju_negQuat(inverse, data.xquat[roots[link]])
        mujoco.mju_mulQuat(between, inverse, data.xquat[root])
        parent.append(link)
        rest.append(between)
        axis.append(rotation.T @ data.xaxis[joint])
        anchor.append(rotation.T @ (data.xanchor[joint] - data.xpos[root]))
    limited = model.jnt_limited[joints].astype(bool)
    zero = model.qpos0[model.jnt_qposadr[joints]]
    return Hinges(
        names=tuple(model.joint(j).name for j in joints),
        parent=np.array(parent, dtype=np.intp),
        axis=np.array(axis).reshape(-1, 3),
        anchor=np.array(anchor).reshape(-1, 3),
        rest=np.array(rest).reshape(-1, 4),
        zero=zero.copy(),
        lower=np.where(limited, model.jnt_range[joints, 0], -np.inf),
        upper=np.where(limited, model.jnt_range[joints, 1], np.inf),
        armature=model.dof_armature[dofs].copy(),
        damping=model.dof_damping[dofs].copy(),
        friction=model.dof_frictionloss[dofs].copy(),
        stiffness=model.jnt_stiffness[joints].copy(),
        spring=model.qpos_spring[model.jnt_qposadr[joints]].copy(),
        qpos=model.jnt_qposadr[joints].astype(np.intp),
        qvel=dofs.astype(np.intp),
    )


def _drives(model: mujoco.MjModel, hinges: Hinges) -> Drives:
    """Read the actuator of every hinge from the model's parameters: see MuJoCo's ``pid`` and ``dcmotor``."""
    dcmotor, pid = int(mujoco.mjtGain.mjGAIN_DCMOTOR), int(mujoco.mjtGain.mjGAIN_PID)
    of_joint = {
        int(model.actuator_trnid[i, 0]): i
        for i in range(model.nu and len(model.actuator_trntype))
        if model.actuator_trntype[i] == mujoco.mjtTrn.mjTRN_JOINT
    }
    rows = []
    for name in hinges.names:
        joint = model.joint(name).id
        if joint not in of_joint:
            raise LevadeError(f"joint {name}: has no actuator; the engine ode wants one on every joint")
        i = of_joint[joint]
        kind = int(model.actuator_gaintype[i])
        gain, bias, dyn = model.actuator_gainprm[i], model.actuator_biasprm[i], model.actuator_dynprm[i]
        limited = bool(model.actuator_forcelimited[i])
        low, high = model.actuator_forcerange[i] if limited else (-np.inf, np.inf)
        ours = model.actuator_ctrlspec[i] == 3 and model.actuator_gear[i, 0] == 1 and low == -high
        if kind == pid and ours and not gain.any() and not dyn.any():
            rows.append((-bias[1], -bias[2], high, np.inf, 1.0, 0.0, 1.0, -1))
        elif kind == dcmotor and ours and not (gain[[2, 3, 5, 8, 9]].any() or bias.any() or dyn[1:].any()):
            no_load = gain[7] / gain[1] if gain[7] else np.inf
            act = int(model.actuator_actadr[i])
            slope = gain[1] ** 2 / gain[0] if gain[0] else 1.0
            rows.append((gain[4], gain[6], high, no_load, slope, dyn[0] if act >= 0 else 0.0, gain[1], act))
        else:
            raise LevadeError(
                f"actuator {model.actuator(i).name}: the engine ode has position and velocity control by pid and dcmotor,"
                " without further options; use the engine mujoco"
            )
    kp, kd, limit, no_load, slope, lag, gain, act = np.array(rows, dtype=float).reshape(-1, 8).T
    ctrl = np.array([model.actuator_ctrladr[of_joint[model.joint(n).id]] for n in hinges.names], dtype=np.intp)
    return Drives(kp, kd, limit, no_load, slope, lag, gain, act.astype(np.intp), ctrl)


def _pairs(model: mujoco.MjModel, geoms: list[int], links: list[int]) -> tuple[Index, Array]:
    """List pairs of shapes that may touch, by MuJoCo's rules, and the friction coefficient of each."""
    pairs, friction = [], []
    for i, one in enumerate(geoms):
        for j in range(i):
            if may_touch(model, one, geoms[j]):
                pairs.append((i, j) if links[i] >= 0 else (j, i))
                friction.append(friction_between(model, one, geoms[j]))
    return np.array(pairs, dtype=np.intp).reshape(-1, 2), np.array(friction, dtype=float)
