"""How far the robot's parts are from each other: contacts that MuJoCo finds anyway, and a sensor of the nearest.

    measure_clearance(spec, trunk, 0.01)                # before the model is compiled
    engine.rollout(start, reference, record=[SELF_DISTANCE]).self_distance        # (n, steps) [m], at most 0.01

A pair of the robot's shapes counts if the two may touch in the model. So adjacent bodies do not, and neither do bodies that
overlap in the neutral posture, which the robot's model lets pass through each other (`levade.robots.preparing`).

With a clearance, MuJoCo also finds contacts of shapes that are only near each other. They have no force. Each shape of the
robot has half of the clearance as its ``gap``, and each of the scene as much less. Gaps add up, so contacts with the scene are
found as before. Spheres and capsules, and boxes that meet these, have the same contacts with a clearance and without, to the
bit. Where MuJoCo finds contacts by iteration (cylinders, ellipsoids, meshes), the last digits of a depth depend on the gap, so
a model with a clearance is another model. A clearance of 0 sets no gap, and leaves every motion its bits.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import mujoco
import numpy as np

from levade.arrays import Array

SELF_DISTANCE = "self_distance"
"""In what a roll-out records: the least distance between parts of the robot."""

_NAME = "_self_distance"
"""Name of the sensor, and of the number that holds the clearance."""
_WORLD = "world"
_MICRON = 1e-6


def measure_clearance(spec: mujoco.MjSpec, trunk: str, clearance: float) -> None:
    """Add the sensor of the least distance, and gaps so that contacts are found up to a clearance.

    Args:
        spec: Robot and scene.
        trunk: Name of the body that holds all others of the robot.
        clearance: Distance from which on parts count as apart [m]; 0 to measure depths only.
    """
    clearance = math.ceil(clearance / _MICRON - 1e-9) * _MICRON  # a model's text has six digits
    _widen(spec, clearance)
    found, distance = (1 << int(field) for field in (_FOUND, _DISTANCE))
    tree = mujoco.mjtObj.mjOBJ_XBODY
    sensor = spec.add_sensor(
        name=_NAME, type=mujoco.mjtSensor.mjSENS_CONTACT, objtype=tree, objname=trunk, reftype=tree, refname=trunk
    )
    sensor.intprm[:3] = [found | distance, _NEAREST, 1]
    spec.add_numeric(name=_NAME, data=[clearance])


_FOUND, _DISTANCE = mujoco.mjtConDataField.mjCONDATA_FOUND, mujoco.mjtConDataField.mjCONDATA_DIST
_NEAREST = 1  # of contact sensors' ways to choose among contacts


def forget_clearance(spec: mujoco.MjSpec) -> None:
    """Take away what `measure_clearance` added, if it did."""
    number = next((one for one in spec.numerics if one.name == _NAME), None)
    if number is None:
        return
    _widen(spec, -float(np.asarray(number.data)[0]))
    spec.delete(number)
    spec.delete(spec.sensor(_NAME))


def _widen(spec: mujoco.MjSpec, clearance: float) -> None:
    """Find contacts within the robot from farther away."""
    if not clearance:
        return
    for geom in spec.geoms:
        if geom.contype or geom.conaffinity:
            geom.gap += -clearance / 2 if geom.parent.name == _WORLD else clearance / 2
    scene = {geom.name for geom in spec.geoms if geom.parent.name == _WORLD}
    for pair in spec.pairs:
        if not {pair.geomname1, pair.geomname2} & scene:
            pair.gap += clearance


def with_clearance(xml: str, assets: Mapping[str, bytes], trunk: str, clearance: float) -> mujoco.MjModel:
    """Compile a model with another clearance than its text has."""
    spec = mujoco.MjSpec.from_string(xml, assets=dict(assets))
    forget_clearance(spec)
    measure_clearance(spec, trunk, clearance)
    return spec.compile()


def clearance_in(model: mujoco.MjModel) -> float | None:
    """The clearance of a model [m]; None if it measures no distances."""
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, _NAME)
    return None if number < 0 else float(model.numeric_data[model.numeric_adr[number]])


def sensor_address(model: mujoco.MjModel) -> int | None:
    """Where the sensor is in sensordata; None if there is none."""
    sensor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, _NAME)
    return None if sensor < 0 else int(model.sensor_adr[sensor])


def distances(sensordata: Array, address: int, clearance: float) -> Array:
    """What the sensor found at the beginning of each step [m], shape (n, steps), from (n, steps, nsensordata)."""
    found, distance = sensordata[..., address], sensordata[..., address + 1]
    return np.where(found > 0, np.minimum(distance, clearance), clearance)


def self_contacts(model: mujoco.MjModel, data: mujoco.MjData) -> Iterator[tuple[int, int, float]]:
    """The contacts between bodies of the robot: the two bodies, in ascending order, and their distance [m].

    Args:
        model: Robot and scene.
        data: After ``mj_collision``.
    """
    for contact in data.contact:
        one, other = sorted(int(model.geom_bodyid[geom]) for geom in contact.geom)
        if one and one != other:
            yield one, other, float(contact.dist)


def distances_at(model: mujoco.MjModel, configurations: Array) -> Array:
    """What the sensor would find at given configurations, one by one: for other engines, and for where a simulation ends.

    Args:
        model: After `measure_clearance`.
        configurations: Positions of the model, shape (rows, nq).

    Returns:
        Shape (rows,) [m].
    """
    clearance = clearance_in(model)
    assert clearance is not None
    data, least = mujoco.MjData(model), np.full(len(configurations), clearance)
    for row, qpos in enumerate(configurations):
        data.qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        least[row] = min((distance for *_, distance in self_contacts(model, data)), default=clearance)
    return np.minimum(least, clearance)
