"""Search neutral postures for robots of any kind: balanced, soles flat, away from joint limits and self-contact.

The legs of quadrupeds have a closed form (`levade.robots.standing`). Here CMA-ES searches the angles of least cost. Left and
right limbs move alike. Every cost term is a share of the robot's own measures, so that size has no effect.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.robots.shapes import lowest
from levade.robots.standing import Bare
from levade.robots.understanding import Leg

UPRIGHT_EXTENSION, SPRAWLED_EXTENSION, LEVEL_EXTENSION = 0.94, 0.4, 0.8
"""Height of the hip above the sole, as a share of the leg's length: on two legs, for limbs that point outward, for others."""
CROUCHED = 0.7
"""Extension of the crouched posture, as a share of the neutral posture's."""
UPRIGHT_STRETCHED = 1.2
"""Extension to which the stretched posture on two legs tends, which no leg reaches."""
_TIPTOE = 0.35
"""Angle by which feet point down in the stretched posture on two legs [rad]."""

_LEG_TRIES, _ARM_TRIES, _AGAIN, _POPULATION = 200, 100, 80, 12
"""Trials per searched joint: for legs, for arms, and for legs that begin near a solution; and trials per generation."""
_KIN = 3
"""Number of moving bodies between two bodies up to which overlaps of their shapes are ignored."""
_ATTEMPTS = 4
"""Most searches, each from the best result so far, until the robot is balanced."""
_STOP = 0.06
"""Margin between a posture and the ends of a joint's range, as a share of the range; at most 0.1 rad."""
DIGITS = 4
"""Digits of a posture's angles [rad]."""


@dataclass(frozen=True)
class Sole:
    """Describes the part of a leg that stands on the ground.

    Attributes:
        leg: The leg.
        geoms: Ids of the geoms.
        body: Id of the body.
        flat: Whether it can stand flat.
        first: Index of the leg's first joint.
        last: Index of the leg's last joint.
        lifting: Indices of the joints that lift and fold the leg.
    """

    leg: Leg
    geoms: tuple[int, ...]
    body: int
    flat: bool
    first: int
    last: int
    lifting: tuple[int, ...]


class PostureSearch:
    """Searches one robot's postures.

    Postures are angles [rad], shape (joints,), in the robot's joint order.

    Args:
        bare: The robot.
        torque: Torque limits [Nm], shape (joints,).
        during: Called in every generation of a search.
    """

    def __init__(self, bare: Bare, torque: Array, *, during: Callable[[], None] = lambda: None) -> None:
        self.bare, self.model, self._during = bare, bare.model, during
        model = self.model
        self.data = mujoco.MjData(model)
        self.joints = {name: k for k, name in enumerate(bare.joints)}
        self.ids = np.array([model.joint(name).id for name in bare.joints])
        self._qpos, self._dof = model.jnt_qposadr[self.ids], model.jnt_dofadr[self.ids]
        self.torque = np.where(np.isfinite(torque) & (torque > 0), torque, np.inf)
        spans = np.clip(np.array([bare.ranges[name] for name in bare.joints], dtype=float), -np.pi, np.pi)
        self.lower, self.upper = spans[:, 0], spans[:, 1]
        width = np.maximum(self.upper - self.lower, 1e-6)
        self._ease = np.clip(0.0, self.lower + width / 6, self.upper - width / 6)
        self._width, self._room = np.minimum(width, 3.0), np.minimum(_STOP * width, 0.1)
        self.zero = np.clip(np.zeros(len(bare.joints)), self.lower, self.upper)
        geoms = [g for g in range(model.ngeom) if model.geom_contype[g] or model.geom_conaffinity[g]]
        self.soles = tuple(self._sole(leg) for leg in bare.standing)
        feet = {int(model.geom_bodyid[g]) for sole in self.soles for g in sole.geoms}
        self._shapes = np.array([g for g in geoms if int(model.geom_bodyid[g]) not in feet], dtype=int)
        self._bounds = model.geom_rbound[self._shapes]
        self._free = int(model.jnt_dofadr[model.body_jntadr[bare.trunk]])
        self._near = _near(model)
        self._put(self.zero)
        self._links = [data_rotation(self.data, sole.body) for sole in self.soles]
        self._flat = [_between(np.array([0.0, 0.0, 1.0]), self._normal(sole)) for sole in self.soles]
        self.lengths = np.array([self._length(sole) for sole in self.soles])
        self.scale = float(self.lengths.max())
        self.sprawled = sprawled(bare)
        toes = [self._centre(sole)[0] - self.data.xanchor[sole.last][0] for sole in self.soles]
        self._ahead = -1.0 if float(np.mean(toes)) < -0.02 * self.scale else 1.0

    def extension(self) -> float:
        """Extension of the neutral posture: height of the hip above the sole, as a share of the leg's length."""
        if self.sprawled:
            return SPRAWLED_EXTENSION if max(len(sole.lifting) for sole in self.soles) > 1 else 0.85
        return UPRIGHT_EXTENSION if len(self.soles) == 2 else LEVEL_EXTENSION

    def neutral(self) -> Array:
        """Search the neutral posture: first lower the arms, then place the legs. A waist and a head stay straight.

        Returns:
            Angles [rad], shape (joints,).
        """
        angles = self.zero
        arms = [leg for leg in self.bare.legs if leg.kind == "arm"]
        if arms:
            angles = self._search(angles, arms, lambda posture: self._arm_cost(posture, arms), _ARM_TRIES)
        return self.standing(angles, self.extension(), _LEG_TRIES)

    def tiptoe(self, angles: Array) -> Array:
        """Straighten the legs and point the feet down, as at the end of a push for a jump. The robot need not balance.

        Args:
            angles: A standing posture to begin at [rad], shape (joints,).

        Returns:
            Angles [rad], shape (joints,).
        """
        straight = self.standing(angles, UPRIGHT_STRETCHED)
        self._put(straight)
        sideways = self.data.xaxis[self.ids, 1]
        for sole in self.soles:
            bending = [k for k in (self.joints[name] for name in sole.leg.joints) if abs(sideways[k]) > 0.7]
            if bending:
                ankle = bending[-1]  # about +y, what is ahead goes down
                down = straight[ankle] + np.sign(sideways[ankle]) * self._ahead * _TIPTOE
                straight[ankle] = np.clip(down, self.lower[ankle], self.upper[ankle])
        return straight.round(DIGITS)

    def standing(self, angles: Array, extension: float, tries: int = _AGAIN) -> Array:
        """Search a standing posture near given angles. Limbs that do not stand keep their angles.

        Args:
            angles: Angles to begin at [rad], shape (joints,).
            extension: Height of the hips above the soles, as a share of the legs' length.
            tries: Trials per joint.

        Returns:
            Angles [rad], shape (joints,).
        """
        legs = list(self.bare.standing)

        def cost(posture: Array) -> float:
            return self._leg_cost(posture, extension)

        if self.sprawled and len({len(leg.joints) for leg in legs}) == 1:  # all alike at first
            angles = self._search(angles, legs, cost, tries, self._turned(legs))
            self._put(angles)
            if np.ptp([self._lowest(sole) for sole in self.soles]) < 0.005 * self.scale:
                return angles
        best = angles
        for seed in range(1, _ATTEMPTS + 1):
            found = self._search(best, legs, cost, tries, seed=seed)
            best = min(best, found, key=cost) if seed > 1 else found
            if self._balanced(best):
                break
        return best

    def _balanced(self, angles: Array) -> bool:
        """Tell whether a search is done: the centre of mass is over the middle of the feet, and these are level."""
        self._put(angles)
        middle = np.mean([self._centre(sole)[:2] for sole in self.soles], axis=0)
        off = self.data.subtree_com[self.bare.trunk][:2] - middle
        lows = [self._lowest(sole) for sole in self.soles]
        return bool(np.linalg.norm(off) < 0.03 * self.scale and np.ptp(lows) < 0.01 * self.scale)

    def faults(self, angles: Array) -> list[str]:
        """Describe why the robot cannot stand in a posture.

        Args:
            angles: Angles [rad], shape (joints,).

        Returns:
            One line for each reason; empty if it can stand.
        """
        self._put(angles)
        lows = np.array([self._lowest(sole) for sole in self.soles])
        hips = np.array([self.data.xanchor[sole.lifting[0]][2] for sole in self.soles])
        found = []
        if np.ptp(lows) > 0.03 * self.scale:
            found.append(f"its feet are {np.ptp(lows):.2g} m apart in height")
        if float((hips - lows).min()) < 0.1 * self.scale:
            found.append("its feet do not come below its hips")
        return found

    # what is searched

    def _search(
        self,
        angles: Array,
        limbs: Sequence[Leg],
        cost: Callable[[Array], float],
        tries: int,
        alike: tuple[list[int], list[int], Array, list[int]] | None = None,
        *,
        seed: int = 1,
        spread: float = 0.6,
    ) -> Array:
        """Search the angles of least cost for some limbs.

        Args:
            angles: Angles to begin at [rad], shape (joints,).
            limbs: Limbs whose angles are searched.
            cost: Cost of a posture.
            tries: Trials per joint.
            alike: Which joints move alike (see `_leaders`). By default left and right ones do.
            seed: Seed of the search.
            spread: Initial step, in quarters of the joints' ranges of at most 2 rad.
        """
        from levade.evolution import cma

        leaders, followers, signs, images = alike or self._leaders(limbs)
        lower, upper = self.lower[leaders], self.upper[leaders]
        scale = np.maximum(np.minimum(upper - lower, 2.0) * 0.25, 1e-3)
        least, most = self.lower[followers], self.upper[followers]
        centre = angles[leaders]

        def posture(u: Array) -> Array:
            made = angles.copy()
            made[leaders] = np.minimum(np.maximum(centre + u * scale, lower), upper)
            made[followers] = np.minimum(np.maximum(signs * made[images], least), most)
            return made

        def total(u: Array) -> float:
            x = centre + u * scale
            over = (x - np.minimum(np.maximum(x, lower), upper)) / scale
            return cost(posture(u)) + 10.0 * float(over @ over)

        options = {
            "popsize": _POPULATION,
            "maxfevals": tries * len(leaders),
            "verbose": -9,
            # cma's own seeding goes through numpy's global generator, which is the user's
            "seed": np.nan,
            "randn": np.random.RandomState(seed).randn,
            "tolfun": 1e-6,
        }
        es = cma.CMAEvolutionStrategy(np.zeros(len(leaders)), spread, options)
        while not es.stop():
            self._during()
            asked = es.ask()
            es.tell(asked, [total(u) for u in asked])
        return posture(np.asarray(es.result.xbest)).round(DIGITS)

    def _leaders(self, limbs: Sequence[Leg]) -> tuple[list[int], list[int], Array, list[int]]:
        """Return the joints that are searched, those that follow, the signs of these, and whom they follow."""
        self._put(np.zeros(len(self.joints)))
        axes = self.data.xaxis[self.ids]
        leaders: list[int] = []
        followers: list[int] = []
        images: list[int] = []
        signs: list[float] = []
        for limb in limbs:
            own = [self.joints[joint] for joint in limb.joints]
            image = next(
                (one for one in limbs if (one.kind, one.end) == (limb.kind, limb.end) and one.side == "left"), None
            )
            if image is None or limb.side != "right" or len(image.joints) != len(limb.joints):
                leaders += own
                continue
            for joint, name in zip(own, image.joints, strict=True):
                mirrored = np.array([-1.0, 1.0, -1.0]) * axes[self.joints[name]]
                followers.append(joint)
                images.append(self.joints[name])
                signs.append(1.0 if mirrored @ axes[joint] >= 0 else -1.0)
        return leaders, followers, np.array(signs), images

    def _turned(self, legs: Sequence[Leg]) -> tuple[list[int], list[int], Array, list[int]]:
        """Return the same as `_leaders` for legs that all move alike, each in the direction in which it points."""
        self._put(np.zeros(len(self.joints)))
        axes = []
        for leg, sole in zip(legs, self.soles, strict=True):
            own = [self.joints[joint] for joint in leg.joints]
            away = (self._centre(sole) - self.data.xanchor[sole.first]) * [1.0, 1.0, 0.0]
            outward = away / max(float(np.linalg.norm(away)), 1e-9)
            hand = 1.0 if leg.side == legs[0].side else -1.0
            frame = np.array([outward, hand * np.cross([0.0, 0.0, 1.0], outward), [0.0, 0.0, 1.0]])
            axes.append(hand * self.data.xaxis[self.ids[own]] @ frame.T)
        first = [self.joints[joint] for joint in legs[0].joints]
        followers = [self.joints[joint] for leg in legs[1:] for joint in leg.joints]
        signs = np.where(np.sum(np.array(axes[1:]) * axes[0], axis=2) < 0, -1.0, 1.0).ravel()
        return first, followers, signs, first * (len(legs) - 1)

    # what it costs

    def _leg_cost(self, angles: Array, extension: float) -> float:
        self._put(angles)
        data = self.data
        centres = np.array([self._centre(sole) for sole in self.soles])
        lows = np.array([self._lowest(sole) for sole in self.soles])
        cost = 3e4 * float(np.var(lows)) / self.scale**2
        for k, (sole, centre, length) in enumerate(zip(self.soles, centres, self.lengths, strict=True)):
            hip, knee = data.xanchor[sole.lifting[0]], data.xanchor[sole.lifting[-1]]
            cost += 40.0 * ((hip[2] - lows[k]) / length - extension) ** 2
            if self.sprawled:
                shank = centre - knee
                cost += 1.5 * float(shank[:2] @ shank[:2]) / max(float(shank @ shank), 1e-9)
            else:
                cost += 30.0 * ((centre[1] - data.xanchor[sole.first][1]) / length) ** 2
                if len(self.soles) > 2:
                    cost += 10.0 * ((centre[0] - hip[0]) / length) ** 2
                else:
                    cost += self._knee_cost(k, centre)
            cost += self._tilt_cost(k)
        off = data.subtree_com[self.bare.trunk][:2] - centres[:, :2].mean(axis=0)
        cost += 0.1 * float(off @ off) / (0.02 * self.scale) ** 2
        cost += self._clearance_cost(float(lows.min()))
        return cost + self._comfort(angles) + self._load(centres)

    def _knee_cost(self, k: int, centre: Array) -> float:
        """Cost of a knee behind the line from hip to sole: knees of two legs bend forward if both ways are in range."""
        lifting = self.soles[k].lifting
        if len(lifting) < 2:
            return 0.0
        hip, knee = self.data.xanchor[lifting[0]], self.data.xanchor[lifting[1]]
        ahead = (knee[0] - 0.5 * (hip[0] + centre[0])) / self.lengths[k] * self._ahead
        return 20.0 * min(0.0, float(ahead)) ** 2

    def _tilt_cost(self, k: int) -> float:
        """Cost of a sole that should be flat, and is not level or does not point ahead."""
        if not self.soles[k].flat:
            return 0.0
        turned = self._turned_sole(k)
        return 60.0 * (1.0 - turned[2, 2]) + 10.0 * (1.0 - turned[0, 0])

    def _turned_sole(self, k: int) -> Array:
        """Return the rotation of a sole from level and pointing ahead, shape (3, 3)."""
        return data_rotation(self.data, self.soles[k].body) @ self._links[k].T @ self._flat[k]

    def _arm_cost(self, angles: Array, arms: Sequence[Leg]) -> float:
        self._put(angles)
        cost = 0.0
        for arm in arms:
            shoulder = self.data.xanchor[self.ids[self.joints[arm.joints[0]]]]
            hand = self.data.geom(arm.foot).xpos - shoulder
            cost += float(hand[2]) / max(float(np.linalg.norm(hand)), 1e-9) + 1.0  # it hangs
        return 2.0 * cost + self._comfort(angles) + 10.0 * self._overlap_cost()

    def _comfort(self, angles: Array) -> float:
        """Cost of angles far from zero and outside the middle two thirds of the range, and of those near its ends."""
        off = (angles - self._ease) / self._width
        room = self._room
        short = np.maximum(0.0, room - np.minimum(angles - self.lower, self.upper - angles)) / room
        return 0.2 * float(off @ off) + 0.5 * float(short @ short)

    def _load(self, centres: Array) -> float:
        """Cost of the torque that carries the robot on vertical foot forces, as shares of the limits."""
        model, data, nv = self.model, self.data, self.model.nv
        bias, jacobian = np.empty(nv), np.empty((3, nv))
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, bias)
        rows = np.empty((len(self.soles), nv))
        for k, (sole, centre) in enumerate(zip(self.soles, centres, strict=True)):
            mujoco.mj_jac(model, data, jacobian, None, centre, sole.body)
            rows[k] = jacobian[2]
        free = slice(self._free + 2, self._free + 5)
        force = np.linalg.lstsq(rows[:, free].T, bias[free], rcond=None)[0]
        shares = (bias - rows.T @ force)[self._dof] / self.torque
        return 0.1 * float(shares @ shares) + 20.0 * float(np.sum(np.maximum(np.abs(shares) - 0.7, 0.0) ** 2))

    def _clearance_cost(self, low: float) -> float:
        """Cost of parts other than soles near the ground, and of parts inside another."""
        reach = self.data.geom_xpos[self._shapes, 2] - self._bounds - low
        cost = 0.0
        for geom in self._shapes[reach < 0.05 * self.scale]:
            above = lowest(self.model, self.data, int(geom)) - low
            cost += 20.0 * min(0.0, above / self.scale - 0.05) ** 2
        return cost + self._overlap_cost()

    def _overlap_cost(self) -> float:
        mujoco.mj_collision(self.model, self.data)
        if not self.data.ncon:
            return 0.0
        contact = self.data.contact
        bodies = np.asarray(self.model.geom_bodyid)[contact.geom]
        deep = np.minimum(contact.dist[~self._near[bodies[:, 0], bodies[:, 1]]], 0.0) / self.scale
        return 300.0 * float(deep @ deep) - 2.0 * float(deep.sum())

    # what they look at

    def _put(self, angles: Array) -> None:
        data = self.data
        data.qpos[:] = 0.0
        data.qpos[self.model.jnt_qposadr[self.model.body_jntadr[self.bare.trunk]] + 3] = 1.0
        data.qpos[self._qpos] = angles
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)

    def _sole(self, leg: Leg) -> Sole:
        model = self.model
        geoms = tuple(int(model.geom(name).id) for name in leg.soles)
        foot = model.geom(leg.foot)
        round_ = int(foot.type[0]) in (mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_CAPSULE)
        wide = len(geoms) > 1 or not round_
        turns = any(role in ("pitch", "roll") for role in leg.roles)  # what can lay it flat
        flat = bool(wide and turns and len(self.bare.standing) == 2)
        joints = [model.joint(joint).id for joint in leg.joints]
        lifting = [j for j, role in zip(joints, leg.roles, strict=True) if role in ("hfe", "kfe", "pitch")]
        return Sole(leg, geoms, int(foot.bodyid[0]), flat, joints[0], joints[-1], tuple(lifting or joints))

    def _length(self, sole: Sole) -> float:
        """Return the length along the leg's links from the first joint that lifts it to the sole [m]."""
        end = self._centre(sole) if sole.flat else self.bare.tip(self.data, sole.leg)  # a shank may be its own foot
        points = [*(self.data.xanchor[j] for j in sole.lifting), end]
        return float(sum(np.linalg.norm(b - a) for a, b in itertools.pairwise(points)))

    def _centre(self, sole: Sole) -> Array:
        """Return the middle of the sole's shapes [m], shape (3,)."""
        place, turn, box = self.data.geom_xpos, self.data.geom_xmat, self.model.geom_aabb
        places = [place[g] + turn[g].reshape(3, 3) @ box[g, :3] for g in sole.geoms]
        return np.sum(places, axis=0) / len(places)

    def _lowest(self, sole: Sole) -> float:
        return min(lowest(self.model, self.data, g) for g in sole.geoms)

    def _normal(self, sole: Sole) -> Array:
        """Return the upward normal of the sole, shape (3,), judged by the direction in which its shapes are thinnest."""
        points = np.concatenate([_corners(self.model, self.data, g) for g in sole.geoms])
        _, spread, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
        normal = axes[2] if spread[2] < 0.5 * spread[1] else np.array([0.0, 0.0, 1.0])
        normal = normal if normal[2] >= 0 else -normal
        # a sole that is about flat at zero angles is flat: the thickness of shapes is not that precise
        return normal if normal[2] < np.cos(np.radians(25)) else np.array([0.0, 0.0, 1.0])


def _near(model: mujoco.MjModel) -> NDArray[np.bool_]:
    """Tell which bodies carry each other over few joints, shape (bodies, bodies). Their shapes often overlap."""
    near = np.eye(model.nbody, dtype=bool)
    for body in range(1, model.nbody):
        above = body
        for _ in range(_KIN):
            above = int(model.body_parentid[above])
            while above and not model.body_jntnum[above]:
                above = int(model.body_parentid[above])
            near[body, above] = near[above, body] = True
    return near


def data_rotation(data: mujoco.MjData, body: int) -> Array:
    """Return the rotation matrix of a body.

    Args:
        data: State of the model, with the kinematics computed.
        body: Id of the body.

    Returns:
        A copy of the matrix from the body's axes to the world's, shape (3, 3).
    """
    return data.xmat[body].reshape(3, 3).copy()


def sprawled(bare: Bare) -> bool:
    """Tell whether a robot's legs point outward like an insect's: most of them begin with a joint about the vertical.

    The result is False for robots on two legs.

    Args:
        bare: The robot.
    """
    standing = bare.standing
    swings = [bool(leg.roles) and leg.roles[0] == "swing" for leg in standing]
    return len(standing) > 2 and sum(swings) > len(standing) / 2


def _corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Return the corners of the box around a geom [m], shape (8, 3)."""
    signs = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    local = model.geom_aabb[geom, :3] + signs * model.geom_aabb[geom, 3:]
    return data.geom_xpos[geom] + local @ data.geom_xmat[geom].reshape(3, 3).T


def _between(one: Array, other: Array) -> Array:
    """Return the smallest rotation that takes one unit vector to another, shape (3, 3)."""
    axis, cosine = np.cross(one, other), float(one @ other)
    if np.linalg.norm(axis) < 1e-9:
        return np.eye(3)
    skew = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + skew + skew @ skew / (1.0 + cosine)
