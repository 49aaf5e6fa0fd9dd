"""The robot: model, legs, joint order, limits, actuators and postures.

    robot = load_robot("hyq2max")
    spec = robot.spec()                     # with actuators, without ground
    robot.joint_names                       # ("lf_haa", "lf_hfe", "lf_kfe", "rf_haa", ...)
    robot.postures["neutral"]               # (12,) [rad], in that order

The joint order is that of the legs, each from the trunk outward. Every array over joints follows it. The model's own order may
differ, so look joints up by name (``model.joint(name).qposadr``). Actuators are attached in joint order and take two controls
each, position and velocity, interleaved.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import mujoco
import numpy as np

from levade.arrays import Array
from levade.embodiment import Embodiment, JointLimits, LegGeometry, TorqueCurve
from levade.errors import LevadeError, did_you_mean
from levade.robots.actuation import Actuation
from levade.robots.findings import Finding
from levade.robots.shapes import balls, support
from levade.robots.understanding import Leg

ON_TWO_LEGS = ("swayed", "one-leg", "kneeling")
"""Postures of every robot on two legs, searched when asked for: see `levade.robots.poses`."""
_TOES = 0.02
"""Share of the height by which soles must be ahead of the ankles to show which way the robot faces."""
_ROLES = {"haa": "hip abduction", "hfe": "hip flexion", "kfe": "knee"}
_SPRAWLED_ROLES = {"swing": "swing", "haa": "spread", "hfe": "lift", "kfe": "fold"}
_ARM_ROLES = {"swing": "yaw", "haa": "spread", "hfe": "lift", "kfe": "fold"}


@dataclass(frozen=True, eq=False, repr=False)
class Robot:
    """Represents a legged robot that can be put into a scene.

    Attributes:
        name: Name of the robot.
        mjcf: MJCF text with one free joint on the trunk, without actuators and ground.
        assets: File name in ``mjcf`` -> content.
        trunk: Name of the trunk's body.
        legs: The legs, and other limbs that move.
        limits: Joint limits, in joint order.
        actuation: The chosen actuation.
        postures: Name -> joint angles [rad], shape (joints,). "neutral" is always there.
        description: One line for listings.
        variant: Name of the description's variant. None for the plain model.
        linkage: Whether ``limits`` has the linkage's torque curves.
        curves: Index of each joint with a linkage -> the linkage's torque curve, whether ``limits`` has it or not.
        source: Path of the description, for messages.
        findings: What was noticed, chosen and left out when the robot was read.
        origins: "legs", "neutral", "torque", "velocity", "gains" and, if joints are held, "fixed" -> where it comes from.
        held: Joint of the file that is held fixed -> its angle [rad], or position of a slide [m].
        model_joints: All joints of the file except the free one, in its order, including held ones.
    """

    name: str
    mjcf: str
    assets: Mapping[str, bytes]
    trunk: str
    legs: tuple[Leg, ...]
    limits: JointLimits
    actuation: Actuation
    postures: Mapping[str, Array]
    description: str = ""
    variant: str | None = None
    linkage: bool = False
    curves: Mapping[int, TorqueCurve] = field(default_factory=dict)
    source: str = ""
    findings: tuple[Finding, ...] = ()
    origins: Mapping[str, str] = field(default_factory=dict)
    held: Mapping[str, float] = field(default_factory=dict)
    model_joints: tuple[str, ...] = ()

    def __repr__(self) -> str:
        legs = ", ".join(leg.name for leg in self.legs)
        return f"Robot({self.name}: {len(self.joint_names)} joints, legs {legs})"

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The robot's joint order: the legs' joints, one leg after the other."""
        return tuple(joint for leg in self.legs for joint in leg.joints)

    @property
    def standing(self) -> tuple[Leg, ...]:
        """The legs that stand: all limbs except arms and others that only move."""
        return tuple(leg for leg in self.legs if leg.stands)

    @property
    def stance(self) -> str:
        """How the robot stands.

        "upright" means on two legs. "sprawled" means on more legs that begin with a joint about the vertical, as an insect's.
        All others are "level".
        """
        standing = self.standing
        if len(standing) == 2:
            return "upright"
        return "sprawled" if sum(leg.roles[:1] == ("swing",) for leg in standing) > len(standing) / 2 else "level"

    @cached_property
    def ahead(self) -> float:
        """1 if a robot on two legs faces along x of its trunk, -1 if it faces the other way, judged by its toes."""
        if self.stance != "upright":
            return 1.0
        data = self.data_at(self.postures["neutral"])
        toes = [_middle(data, leg)[0] - data.joint(leg.joints[-1]).xanchor[0] for leg in self.standing]
        return -1.0 if float(np.mean(toes)) < -_TOES * abs(self.neutral_height) else 1.0

    @property
    def feet(self) -> tuple[str, ...]:
        """Names of the feet's geoms, in leg order. For an arm it is the geom at its end."""
        return tuple(leg.foot for leg in self.legs)

    def leg(self, name: str) -> Leg:
        """Return a leg by name.

        Args:
            name: Name of the leg.

        Raises:
            LevadeError: If there is no such leg.
        """
        for leg in self.legs:
            if leg.name == name:
                return leg
        raise LevadeError(f"robot {self.name}: no leg {name!r}; {did_you_mean(name, [leg.name for leg in self.legs])}")

    @property
    def posture_names(self) -> tuple[str, ...]:
        """Names of all postures, those included that are searched when asked for."""
        more = ON_TWO_LEGS if self.stance == "upright" else ()
        return (*self.postures, *(name for name in more if name not in self.postures))

    @cached_property
    def _poses(self) -> dict[str, Array]:
        return {}

    def posture(self, posture: str | Mapping[str, float | str]) -> Array:
        """Return a posture by name, or the neutral posture with some legs or joints changed.

        Args:
            posture: Name of a posture, or a mapping of changes. A change is a joint or pattern, such as "*_kfe" -> angle
                [rad]; limbs, such as "hind" or "arm" -> name of the posture that they take; or limbs and a role, such as
                "hind kfe" -> either. An angle is then that of the first limb, which the others mirror: see
                `levade.robots.naming`. Angles take precedence over names of postures.

        Returns:
            Joint angles [rad], shape (joints,).

        Raises:
            LevadeError: If a name is unknown or an angle is out of range.
        """
        if isinstance(posture, str):
            if posture in self.postures:
                return self.postures[posture].copy()
            if posture not in self.posture_names:
                hint = did_you_mean(posture, self.posture_names)
                raise LevadeError(f"robot {self.name}: no posture {posture!r}; {hint}")
            from levade.robots.poses import pose

            if posture not in self._poses:
                self._poses[posture] = pose(self, posture)
            return self._poses[posture].copy()
        from levade.robots.description import per_joint
        from levade.robots.naming import by_joint, limb_words, require_joints

        angles = self.postures["neutral"].copy()
        where = f"robot {self.name}: posture"
        joints: dict[str, float] = {}
        for key, value in posture.items():
            named = list(require_joints(self, key, where))
            if not isinstance(value, str):
                joints[key] = value
            elif named:
                angles[named] = self.posture(value)[named]
            else:
                hint = did_you_mean(key, limb_words(self))
                raise LevadeError(f"{where}: no leg {key!r} to take the posture {value!r}; {hint}")
        joints = by_joint(self, joints, where)
        for joint, angle in per_joint(joints, self.joint_names, where, all_joints=False).items():
            i = self.joint_names.index(joint)
            if not self.limits.lower[i] <= angle <= self.limits.upper[i]:
                raise LevadeError(
                    f"{where}: {joint} {angle} rad is out of its range,"
                    f" {self.limits.lower[i]:.4g} to {self.limits.upper[i]:.4g} rad"
                )
            angles[i] = angle
        return angles

    def with_linkage(self) -> Robot:
        """Return the same robot with torque limits lowered by its linkages' curves, as `load_robot` does with ``linkage``."""
        return replace(self, linkage=True, limits=replace(self.limits, torque_curves=self.curves))

    def role_words(self, leg: Leg) -> tuple[str, ...]:
        """Describe in words what each joint of a limb does.

        Args:
            leg: The limb.
        """
        words = _SPRAWLED_ROLES if self.stance == "sprawled" and leg.stands else _ROLES if leg.stands else _ARM_ROLES
        return tuple(words.get(role, role) for role in leg.roles or ("other",) * len(leg.joints))

    def joint_indices(self, leg: Leg) -> slice:
        """Return the indices of a leg's joints in arrays over joints.

        Args:
            leg: The leg.
        """
        first = self.joint_names.index(leg.joints[0])
        return slice(first, first + len(leg.joints))

    def spec(self, *, gain_scale: float = 1.0, damping_scale: float = 1.0) -> mujoco.MjSpec:
        """Make a new `mujoco.MjSpec` of the robot with its actuators, to be completed by a scene.

        ``to_xml()`` writes six digits, so simulate what is compiled from that text, not from the spec.

        Args:
            gain_scale: Factor on kp and kd.
            damping_scale: Factor on the passive damping of the joints.
        """
        spec = mujoco.MjSpec.from_string(self.mjcf, assets=dict(self.assets))
        self.actuation.attach(spec, self.joint_names, gain_scale=gain_scale)
        if damping_scale != 1.0:
            for name in self.joint_names:
                joint = spec.joint(name)
                joint.damping = np.asarray(joint.damping) * damping_scale
        return spec

    @cached_property
    def model(self) -> mujoco.MjModel:
        """The compiled model of the robot alone, for kinematics. Do not change it.

        Raises:
            LevadeError: If MuJoCo does not accept the model.
        """
        try:
            return mujoco.MjModel.from_xml_string(self.mjcf, dict(self.assets))
        except ValueError as error:
            raise LevadeError(f"robot {self.name}: {' '.join(str(error).split())}") from None

    def data_at(self, joint_position: Array) -> mujoco.MjData:
        """Compute kinematics of `model`, with the trunk frame at the world frame.

        Args:
            joint_position: Joint angles [rad], shape (joints,).
        """
        data = mujoco.MjData(self.model)
        data.qpos[:] = 0.0
        data.qpos[self.model.jnt_qposadr[self._free_joint] + 3] = 1.0
        for name, angle in zip(self.joint_names, joint_position, strict=True):
            data.joint(name).qpos[0] = angle
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        return data

    @cached_property
    def zero_data(self) -> mujoco.MjData:
        """`data_at` zero angles. Do not change it."""
        return self.data_at(np.zeros(len(self.joint_names)))

    def foot_positions(self, joint_position: Array) -> Array:
        """Compute the centres of the feet in the trunk frame.

        Args:
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Positions [m], shape (standing legs, 3).
        """
        data = self.data_at(joint_position)
        return np.array([_middle(data, leg) for leg in self.standing])

    def foot_depths(self, joint_position: Array) -> Array:
        """Compute how far the lowest point of each foot is below the trunk's origin.

        Args:
            joint_position: Joint angles [rad], shape (joints,).

        Returns:
            Depths [m], shape (standing legs,).
        """
        data = self.data_at(joint_position)
        return np.array([max(_depth(self.model, data, geom) for geom in leg.soles) for leg in self.standing])

    def standing_height(self, posture: str | Mapping[str, float | str] = "neutral") -> float:
        """Compute the height of the trunk's origin above the lowest point of the feet, with a level trunk.

        It may be negative if the file puts the origin on the ground or below it. See also `levade.robots.dimensions`.

        Args:
            posture: The posture, as in `posture`.

        Returns:
            Height [m].
        """
        return float(self.foot_depths(self.posture(posture)).max())

    @cached_property
    def neutral_height(self) -> float:
        """`standing_height` of the neutral posture [m]."""
        return self.standing_height("neutral")

    @cached_property
    def leg_geometry(self) -> tuple[LegGeometry, ...]:
        """The legs as costs and criteria see them, in leg order."""
        stood, data = self.data_at(self.postures["neutral"]), self.zero_data
        geometry = []
        for leg in self.legs:
            joints, indices = [data.joint(name) for name in leg.joints], self.joint_indices(leg)
            geometry.append(
                LegGeometry(
                    name=leg.name,
                    side=leg.side,
                    end=leg.end,
                    joints=tuple(range(indices.start, indices.stop)),
                    anchors=np.array([joint.xanchor for joint in joints]),
                    axes=np.array([joint.xaxis for joint in joints]),
                    foot=_middle(data, leg),
                    sole=max(_depth(self.model, stood, geom) for geom in leg.soles) + float(_middle(stood, leg)[2]),
                    stands=leg.stands,
                )
            )
        return tuple(geometry)

    @cached_property
    def embodiment(self) -> Embodiment:
        """The robot as simulations, costs and motion files know it."""
        return Embodiment(
            trunk=self.trunk,
            joint_names=self.joint_names,
            feet=self.feet,
            limits=self.limits,
            trunk_com_offset=self.trunk_com_offset,
            legs=self.leg_geometry,
            trunk_balls=self.trunk_balls,
        )

    @cached_property
    def mass(self) -> float:
        """Mass of the whole robot [kg]."""
        return float(self.model.body_mass.sum())

    @cached_property
    def trunk_parts(self) -> tuple[int, ...]:
        """Ids of the trunk, which is first, and of the bodies with mass that are fixed to it, such as a held arm."""
        model, trunk = self.model, self.model.body(self.trunk).id
        fixed = np.flatnonzero((model.body_weldid == model.body_weldid[trunk]) & (model.body_mass > 0))
        return (trunk, *(int(body) for body in fixed if body != trunk))

    @cached_property
    def trunk_com_offset(self) -> Array:
        """Centre of mass of the trunk and everything fixed to it, without the legs, in the trunk frame [m], shape (3,)."""
        if len(self.trunk_parts) == 1:
            return self.model.body(self.trunk).ipos.copy()
        parts = list(self.trunk_parts)
        places = self.data_at(self.postures["neutral"]).xipos[parts]
        return np.average(places, axis=0, weights=self.model.body_mass[parts])

    @cached_property
    def trunk_balls(self) -> Array:
        """Balls around the parts of the trunk that can touch [m], shape (k, 4); see `levade.embodiment.Embodiment`."""
        model, data = self.model, self.zero_data
        touching = (model.geom_contype | model.geom_conaffinity) != 0
        geoms = np.flatnonzero(touching & np.isin(model.geom_bodyid, self.trunk_parts))
        return np.concatenate([np.zeros((0, 4)), *(balls(model, data, int(geom)) for geom in geoms)])

    @property
    def _free_joint(self) -> int:
        return int(self.model.body(self.trunk).jntadr[0])


def _middle(data: mujoco.MjData, leg: Leg) -> Array:
    """Return the centre of the leg's foot, or of the shapes that are its sole [m], shape (3,)."""
    if not leg.pads:
        return data.geom(leg.foot).xpos.copy()
    return np.mean([data.geom(pad).xpos for pad in leg.pads], axis=0)


def _depth(model: mujoco.MjModel, data: mujoco.MjData, geom: str) -> float:
    """Return how far the geom reaches below the world's origin [m]."""
    return -float(support(model, data, model.geom(geom).id, np.array([0.0, 0.0, -1.0]))[2])
