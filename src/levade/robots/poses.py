"""Postures of robots on two legs beyond standing: swayed over the left foot, on the left leg alone, and kneeling.

    load_robot("mjlab:unitree_g1").posture("kneeling")

They are searched when something asks for them, as the neutral posture is (`levade.robots.neutral`): the trunk is level, and
the centre of mass is over what stands on the ground. Standing on one leg leaves little room, so the first two are commands:
servos give way by their torque over their stiffness, and come to rest in the posture.
"""

from __future__ import annotations

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.neutral import DIGITS, PostureSearch, Sole
from levade.robots.robot import Robot
from levade.robots.shapes import support
from levade.robots.standing import Bare

_SWAY = 0.85
"""Place of a swayed robot's centre of mass between the middle of its feet (0) and the left one (1)."""
_LIFT = 0.16
"""Height of the lifted sole over the other one, as a share of the leg's length."""
_EXTENSION = 0.8
"""Height of the hip over the sole that carries the robot, as a share of the leg's length. With the knee bent the centre of mass
is lower, and the servos of the ankle hold it more easily."""
_BEHIND = 0.4
"""Place of a kneeling robot's centre of mass between its knees (0) and its toes (1)."""
_BENT = 1.6
"""Bend of a kneeling robot's knees at which the search begins [rad]."""
_TRIES = 150
_NEWTON, _MOVED = 20, 1e-5
"""Steps of Gauss-Newton, and change of a joint in its differences [rad]."""
_GIVEN = 0.5
"""Largest angle by which a command makes up for a servo that gives way [rad]."""
_DOWN = np.array([0.0, 0.0, -1.0])


def pose(robot: Robot, name: str) -> Array:
    """Search a posture of a robot on two legs.

    Args:
        robot: The robot.
        name: One of `levade.robots.robot.ON_TWO_LEGS`.

    Returns:
        Joint angles [rad], shape (joints,).

    Raises:
        LevadeError: If the robot has no such posture.
    """
    search = _PoseSearch(robot)
    return {"swayed": search.swayed, "one-leg": search.one_leg, "kneeling": search.kneeling}[name]()


class _PoseSearch(PostureSearch):
    """Searches postures of one robot on two legs; see `PostureSearch`."""

    def __init__(self, robot: Robot) -> None:
        lower, upper = robot.limits.lower, robot.limits.upper
        ranges = {name: (float(a), float(b)) for name, a, b in zip(robot.joint_names, lower, upper, strict=True)}
        bare = Bare(robot.model, robot.model.body(robot.trunk).id, robot.legs, ranges)
        super().__init__(bare, robot.limits.torque)
        self.robot = robot
        self.neutral_posture = robot.postures["neutral"]
        self.left, self.right = sorted(self.soles, key=lambda sole: sole.leg.side)
        self._put(self.neutral_posture)
        self._step = self._centre(self.left) - self._centre(self.right)
        joints = [self.joints[joint] for leg in self.bare.standing for joint in leg.joints]
        self._alone: tuple[list[int], list[int], Array, list[int]] = (joints, [], np.zeros(0), [])

    def swayed(self) -> Array:
        """Search commands for a posture on both feet, which stay in place, with the centre of mass almost over the left one."""
        return self._commanded(self._over_left(), 0.5 + 0.5 * _SWAY).round(DIGITS)

    def one_leg(self) -> Array:
        """Search commands for a posture on the left foot, with the right one lifted: servos give way to balance."""
        lifted = self._search(self._over_left(), self.bare.standing, self._lift_cost, _TRIES, self._alone, spread=0.3)
        return self._commanded(self._over_sole(lifted), 1.0).round(DIGITS)

    def kneeling(self) -> Array:
        """Search a posture on both shanks and toes, with the thighs about upright."""
        model = self.model
        bent: list[tuple[int, int, list[int], Sole]] = []
        for sole in self.soles:
            joints = dict(zip(sole.leg.roles, sole.leg.joints, strict=True))
            if not {"hfe", "kfe"} <= set(joints):
                raise LevadeError(
                    f"robot {self.robot.name}: has no kneeling posture: leg {sole.leg.name} has no hip and knee"
                )
            hip, knee = (model.joint(joints[role]).id for role in ("hfe", "kfe"))
            shank = int(model.jnt_bodyid[knee])
            shapes = [g for g in range(model.ngeom) if int(model.body_weldid[model.geom_bodyid[g]]) == shank]
            shapes = [g for g in shapes if model.geom_contype[g] or model.geom_conaffinity[g]]
            if not shapes or shank == sole.body:
                raise LevadeError(
                    f"robot {self.robot.name}: has no kneeling posture: nothing collides on the shank"
                    f" {model.body(shank).name}"
                )
            bent.append((hip, knee, shapes, sole))
        angles = self.neutral_posture.copy()
        for _, knee, _, sole in bent:
            at = [self.joints[joint] for joint in sole.leg.joints]
            k = self.joints[model.joint(knee).name]
            bends = -1.0 if self.neutral_posture[k] < self.zero[k] else 1.0
            angles[at] = self.zero[at]
            angles[k] = np.clip(bends * _BENT, self.lower[k], self.upper[k])

        def cost(posture: Array) -> float:
            return self._kneel_cost(posture, bent)

        return self._search(angles, self.bare.standing, cost, 2 * _TRIES, spread=0.3)

    def _over_left(self) -> Array:
        """Search a posture on both feet, which stay where they are, with the centre of mass almost over the left one."""
        return self._search(self.neutral_posture, self.bare.standing, self._sway_cost, _TRIES, self._alone, spread=0.2)

    def _over_sole(self, angles: Array) -> Array:
        """Move the left leg until its sole is level, and the centre of mass over the middle of it: Gauss-Newton."""
        leg = [self.joints[joint] for joint in self.left.leg.joints]

        def off(posture: Array) -> Array:  # shape (2,) or (4,), to be 0
            self._put(posture)
            away = (self.data.subtree_com[self.bare.trunk] - self._centre(self.left))[:2] / self.scale
            return (
                np.concatenate([away, self._turned_sole(self.soles.index(self.left))[:2, 2]])
                if self.left.flat
                else away
            )

        best, least = angles, off(angles)
        for _ in range(_NEWTON):
            slopes = []
            for joint in leg:
                moved = best.copy()
                moved[joint] += _MOVED
                slopes.append((off(moved) - least) / _MOVED)
            step = np.linalg.lstsq(np.stack(slopes, axis=1), -least, rcond=1e-3)[0]
            tried = best.copy()
            tried[leg] = np.clip(best[leg] + step, self.lower[leg], self.upper[leg])
            error = off(tried)
            if not error @ error < least @ least:
                break
            best, least = tried, error
        return best

    def _commanded(self, angles: Array, share: float) -> Array:
        """Return the commands with which servos give way to a posture: each is beyond it by torque over stiffness.

        Args:
            angles: The posture, with the centre of mass over what stands on the ground [rad], shape (joints,).
            share: Share of the weight that the left foot carries. The right one carries the rest.
        """
        self._put(angles)
        model, data, nv = self.model, self.data, self.model.nv
        torque, jacobian = np.zeros(nv), np.zeros((3, nv))
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, torque)
        weight = torque[self._free + 2]
        for sole, carried in ((self.left, share), (self.right, 1.0 - share)):
            mujoco.mj_jac(model, data, jacobian, None, self._centre(sole), sole.body)
            torque -= jacobian[2] * weight * carried
        given = torque[self._dof] / np.maximum(self.robot.actuation.kp, 1e-9)
        return np.clip(angles + np.clip(given, -_GIVEN, _GIVEN), self.lower, self.upper)

    # what it costs

    def _sway_cost(self, angles: Array) -> float:
        self._put(angles)
        step = self._centre(self.left) - self._centre(self.right) - self._step
        left, right = self._centre(self.left), self._centre(self.right)
        cost = 300.0 * float(step @ step) / self.scale**2 + self._over(right + (0.5 + 0.5 * _SWAY) * (left - right))
        cost += self._shape_cost(self.left, self._lowest(self.left)) + self._shape_cost(self.right, None)
        return cost + self._comfort(angles) + self._overlap_cost()

    def _lift_cost(self, angles: Array) -> float:
        self._put(angles)
        low, lifted = self._lowest(self.left), self._centre(self.right)
        hip = self.data.xanchor[self.right.first]
        cost = 400.0 * ((self._lowest(self.right) - low) / self.scale - _LIFT) ** 2 + self._over(
            self._centre(self.left)
        )
        cost += 30.0 * ((lifted[1] - hip[1]) / self.scale) ** 2
        cost += 10.0 * ((lifted[0] - self._centre(self.left)[0]) / self.scale) ** 2
        cost += self._shape_cost(self.left, low) + 0.3 * self._shape_cost(self.right, None)
        return cost + self._comfort(angles) + self._clearance_cost(low)

    def _kneel_cost(self, angles: Array, bent: list[tuple[int, int, list[int], Sole]]) -> float:
        self._put(angles)
        data, cost = self.data, 0.0
        com = data.subtree_com[self.bare.trunk]
        for hip, knee, shapes, sole in bent:
            shank = min((support(self.model, data, g, _DOWN) for g in shapes), key=lambda point: point[2])
            toes = min((support(self.model, data, g, _DOWN) for g in sole.geoms), key=lambda point: point[2])
            thigh = data.xanchor[knee] - data.xanchor[hip]
            length = max(float(np.linalg.norm(thigh)), 1e-9)
            cost += 3e3 * float((shank[2] - toes[2]) / self.scale) ** 2
            cost += 3.0 * float(thigh[0] / length) ** 2 + 30.0 * float(thigh[1] / length) ** 2
            cost += 20.0 * max(0.0, float(thigh[2]) / length + 0.7) ** 2  # the knee is below the hip
            off = shank[0] + _BEHIND * (toes[0] - shank[0]) - com[0]
            cost += 0.3 * float(off / (0.02 * self.scale)) ** 2
            cost += 50.0 * max(0.0, self._ahead * float(toes[0] - shank[0]) / length + 0.7) ** 2  # the foot is behind
            cost += 30.0 * float((toes[1] - data.xanchor[hip][1]) / length) ** 2
        return cost + self._comfort(angles) + self._overlap_cost()

    def _over(self, place: Array) -> float:
        """Cost of a centre of mass that is not over a place on the ground."""
        off = self.data.subtree_com[self.bare.trunk][:2] - place[:2]
        return float(off @ off) / (0.02 * self.scale) ** 2

    def _shape_cost(self, sole: Sole, low: float | None) -> float:
        """Cost of a sole that is not level, of a knee that bends backward, and of a hip at another height than it should."""
        k, cost = self.soles.index(sole), 0.0
        if low is not None:
            hip = self.data.xanchor[sole.lifting[0]]
            cost += 40.0 * ((hip[2] - low) / self.lengths[k] - _EXTENSION) ** 2
        return cost + self._knee_cost(k, self._centre(sole)) + self._tilt_cost(k)
