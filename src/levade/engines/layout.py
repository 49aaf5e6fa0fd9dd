"""Addresses of the robot's quantities in the vectors of an engine's model, and sensors that record contact forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.embodiment import Embodiment
from levade.engines.clearance import SELF_DISTANCE, clearance_in, sensor_address
from levade.engines.state import State
from levade.feedback import sensed
from levade.robots.addresses import Addresses, Index, compact
from levade.trajectory import JointReference, Trajectories

FOOT_CONTACT_FORCE = "foot_contact_force"
"""Name of the contact forces on the feet, among the quantities that a roll-out records. Other names are those of bodies."""

SELF_FORCE = "self_force"
"""Name of the strongest contact between parts of the robot, among the quantities that a roll-out records."""

_SELF_SENSOR = "_self_force"
"""Name of its sensor."""

_FOOT_SENSOR, _BODY_SENSOR = "_contact_force", "_scene_force"
"""Suffixes of a foot's geom, and of a body, in the names of their sensors."""


@dataclass(frozen=True, eq=False)
class Layout(Addresses):
    """Addresses of a robot in the model of an engine, with its actuators and contact sensors.

    Attributes:
        embodiment: The robot.
        actuators: Addresses of the joints' torques in actuator_force.
        ctrl_position: Addresses of the joints' position references in ctrl.
        ctrl_velocity: Addresses of their velocity references.
        foot_sensors: Addresses of the force on each foot in sensordata.
        body_sensors: Body -> addresses of the force on it in sensordata.
        force_sensor: Address of the strongest contact between the robot's parts in sensordata. None if it is not measured.
        distance_sensor: Address of the least distance between the robot's parts in sensordata. None if it is not measured.
        clearance: Distance from which parts count as apart [m]. None if it is not measured.
    """

    embodiment: Embodiment
    actuators: Index
    ctrl_position: Index
    ctrl_velocity: Index
    foot_sensors: tuple[int, ...]
    body_sensors: Mapping[str, int]
    force_sensor: int | None = None
    distance_sensor: int | None = None
    clearance: float | None = None

    @classmethod
    def of_model(cls, model: mujoco.MjModel, embodiment: Embodiment) -> Layout:
        """Look up a robot in a model whose actuators are named after its joints and which has `add_contact_sensors`.

        Args:
            model: Robot and scene.
            embodiment: The robot.

        Returns:
            Addresses of the robot in the model.

        Raises:
            KeyError: If the model lacks one of the names.
        """
        actuators = [model.actuator(name).id for name in embodiment.joint_names]
        ctrl = [int(model.actuator_ctrladr[i]) for i in actuators]
        sensors = {model.sensor(i).name: int(model.sensor(i).adr[0]) for i in range(model.nsensor)}
        return cls(
            **vars(Addresses.of(model, embodiment.trunk, embodiment.joint_names)),
            embodiment=embodiment,
            actuators=compact([int(model.actuator_outadr[i]) for i in actuators]),
            ctrl_position=compact(ctrl),
            ctrl_velocity=compact([address + 1 for address in ctrl]),
            foot_sensors=tuple(sensors[foot + _FOOT_SENSOR] for foot in embodiment.feet),
            body_sensors={
                name.removesuffix(_BODY_SENSOR): address
                for name, address in sensors.items()
                if name.endswith(_BODY_SENSOR)
            },
            force_sensor=sensors.get(_SELF_SENSOR),
            distance_sensor=sensor_address(model),
            clearance=clearance_in(model),
        )

    def state(self, qpos: Array, qvel: Array, act: Array, *, joint_reference: Array | None = None) -> State:
        """Make a state from copies of the model's vectors.

        Args:
            qpos: Positions, shape (nq,) or (rows, nq).
            qvel: Velocities, shape (nv,) or (rows, nv).
            act: States of the actuators, shape (na,) or (rows, na).
            joint_reference: Last commands of the joints [rad], shape (joints,) or (rows, joints). Defaults to the joint
                positions.

        Returns:
            The state.
        """
        joint_position = np.asarray(qpos)[..., self.joint_qpos]
        parts = (qpos, qvel, act, joint_position, joint_position if joint_reference is None else joint_reference)
        return State(*(np.array(np.atleast_2d(part), dtype=float) for part in parts))

    def sensed(self, qpos: Array, qvel: Array) -> Array:
        """Compute the sensed values of a robot: see `levade.feedback.sensed`.

        Args:
            qpos: MuJoCo's positions, shape (..., nq).
            qvel: MuJoCo's velocities, shape (..., nv).

        Returns:
            Sensed values, shape (..., 6 + 2 joints).
        """
        return sensed(
            qpos[..., self.trunk_quaternion],
            qvel[..., self.trunk_angular_velocity],
            qpos[..., self.joint_qpos],
            qvel[..., self.joint_qvel],
        )

    def trajectories(
        self,
        out: Mapping[str, Array],
        reference: JointReference,
        *,
        diverged: NDArray[np.bool_],
        record: Sequence[str] = (),
    ) -> Trajectories:
        """Make trajectories from MuJoCo's records.

        Args:
            out: qpos, qvel, actuator_force, and sensordata if forces are recorded; shape (n, steps, ...) each.
            reference: Joint references of the same n trials.
            diverged: Trials that broke down, shape (n,).
            record: Forces to include: `FOOT_CONTACT_FORCE`, `SELF_FORCE`, and bodies for their contact force with the scene.

        Returns:
            The trajectories.
        """
        qpos, qvel = out["qpos"], out["qvel"]
        return Trajectories(
            joint_position=qpos[..., self.joint_qpos],
            joint_velocity=qvel[..., self.joint_qvel],
            joint_torque=out["actuator_force"][..., self.actuators],
            trunk_position=qpos[..., self.trunk_position],
            trunk_quaternion=qpos[..., self.trunk_quaternion],
            trunk_linear_velocity=qvel[..., self.trunk_linear_velocity],
            trunk_angular_velocity=qvel[..., self.trunk_angular_velocity],
            reference=reference,
            embodiment=self.embodiment,
            timestep=reference.timestep,
            horizon_steps=reference.horizon_steps,
            diverged=diverged,
            foot_contact_force=self.foot_forces(out["sensordata"]) if FOOT_CONTACT_FORCE in record else None,
            body_contact_force={
                body: self.force_on(body, out["sensordata"]) for body in record if body in self.body_sensors
            },
            self_force=None if SELF_FORCE not in record else self._magnitude(self.force_sensor, out["sensordata"]),
        )

    def addresses(self, record: Sequence[str]) -> list[int]:
        """Return the addresses in sensordata of what a roll-out records.

        Args:
            record: What is recorded: `FOOT_CONTACT_FORCE`, `SELF_FORCE`, `levade.engines.SELF_DISTANCE`, and names of bodies.

        Returns:
            Index of the first value of each sensor. Names without a sensor have none.
        """
        found = [self.body_sensors[name] for name in record if name in self.body_sensors]
        if FOOT_CONTACT_FORCE in record:
            found += self.foot_sensors
        if SELF_FORCE in record and self.force_sensor is not None:
            found.append(self.force_sensor)
        if SELF_DISTANCE in record and self.distance_sensor is not None:
            found.append(self.distance_sensor)
        return found

    def foot_forces(self, sensordata: Array) -> Array:
        """Return the forces on the feet, in world axes.

        Args:
            sensordata: MuJoCo's sensor values, shape (n, steps, nsensordata).

        Returns:
            Forces [N], shape (n, steps, feet, 3).
        """
        return np.stack([-sensordata[..., a : a + 3] for a in self.foot_sensors], axis=2)

    def force_on(self, body: str, sensordata: Array) -> Array:
        """Compute the magnitude of the scene's force on a body.

        Args:
            body: Name of the body, a key of ``body_sensors``.
            sensordata: MuJoCo's sensor values, shape (n, steps, nsensordata).

        Returns:
            Magnitude of the force [N], shape (n, steps).
        """
        return self._magnitude(self.body_sensors[body], sensordata)

    @staticmethod
    def _magnitude(address: int | None, sensordata: Array) -> Array:
        """Return the length of the vector at an address, shape (n, steps)."""
        assert address is not None
        return np.linalg.norm(sensordata[..., address : address + 3], axis=-1)


def add_contact_sensors(spec: mujoco.MjSpec, feet: Sequence[str], whole: Sequence[str] = ()) -> None:
    """Add sensors of the net force of each foot's contacts, and of each body's with the scene, in world axes.

    Args:
        spec: The robot in its scene; it is changed.
        feet: Geom names of the feet.
        whole: Those of them that are soles of several geoms: the forces on all of the body count.
    """
    data_force = 1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE)
    netforce = 3

    def add(name: str, **match) -> None:
        sensor = spec.add_sensor(name=name, type=mujoco.mjtSensor.mjSENS_CONTACT, **match)
        sensor.intprm[:3] = [data_force, netforce, 1]

    geom, body = mujoco.mjtObj.mjOBJ_GEOM, mujoco.mjtObj.mjOBJ_BODY
    for foot in feet:
        if foot in whole:
            add(foot + _FOOT_SENSOR, objtype=body, objname=spec.geom(foot).parent.name)
        else:
            add(foot + _FOOT_SENSOR, objtype=geom, objname=foot)
    for element in spec.bodies[1:]:
        add(element.name + _BODY_SENSOR, objtype=body, objname=element.name, reftype=body, refname="world")


def measure_self_force(spec: mujoco.MjSpec, trunk: str) -> None:
    """Add the sensor of the strongest contact between two parts of the robot.

    Args:
        spec: The robot, with or without its scene; it is changed.
        trunk: Name of the body that holds all other bodies of the robot.
    """
    tree, strongest = mujoco.mjtObj.mjOBJ_XBODY, 2
    sensor = spec.add_sensor(
        name=_SELF_SENSOR,
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=tree,
        objname=trunk,
        reftype=tree,
        refname=trunk,
    )
    sensor.intprm[:3] = [1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE), strongest, 1]


def sole(model: mujoco.MjModel, foot: str) -> list[int]:
    """Return the geoms whose contact forces the sensor of a foot adds up.

    Args:
        model: A model with the sensors that `add_contact_sensors` adds.
        foot: Geom name of the foot.
    """
    sensor = model.sensor(foot + _FOOT_SENSOR)
    of = int(sensor.objid[0])
    if int(sensor.objtype[0]) == int(mujoco.mjtObj.mjOBJ_GEOM):
        return [of]
    return np.flatnonzero(np.asarray(model.geom_bodyid) == of).tolist()


def remove_contact_sensors(spec: mujoco.MjSpec, feet: Sequence[str]) -> None:
    """Take away what `add_contact_sensors` and `measure_self_force` added.

    Args:
        spec: The robot, with or without its scene; it is changed.
        feet: Geom names of the feet.
    """
    names = (
        {_SELF_SENSOR} | {foot + _FOOT_SENSOR for foot in feet} | {body.name + _BODY_SENSOR for body in spec.bodies[1:]}
    )
    for sensor in [sensor for sensor in spec.sensors if sensor.name in names]:
        spec.delete(sensor)
