"""Measure how far the robot's parts are from each other, by the contacts that MuJoCo finds and a sensor of the nearest.

    measure_clearance(spec, trunk, 0.01)                # before the model is compiled
    engine.rollout(start, reference, record=[SELF_DISTANCE]).self_distance        # (n, steps) [m], at most 0.01

A pair of the robot's shapes counts if the two may touch in the model. So adjacent bodies do not count, nor do bodies that
overlap in the neutral posture, which the robot's model lets pass through each other (`levade.robots.preparing`).

With a clearance, MuJoCo also finds contacts of shapes that are only near each other. They have no force. Two shapes are found
from the sum of their margins and gaps on. So each shape of the robot has a ``gap`` of half of the clearance, less the least
margin, and each shape of the scene has as much less: contacts with the scene are found as before. Spheres and capsules, and
boxes that meet these, have the same contacts with and without a clearance, to the bit. For shapes whose contacts MuJoCo finds
by iteration (cylinders, ellipsoids, meshes), the last digits of a depth depend on the gap, so a clearance changes the model.
A clearance of 0, or of at most two margins, sets no gap, and changes no bit of a motion.

A distance is never less than that of the shapes. For shapes found by iteration it may be more, since MuJoCo may replace the
nearest points by several contacts where an edge meets a flat side.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import mujoco
import numpy as np

from levade.arrays import Array

SELF_DISTANCE = "self_distance"
"""Name of the least distance between parts of the robot, among the quantities that a roll-out records."""

_NAME = "_self_distance"
"""Name of the sensor, and of the number that holds the clearance."""
_WORLD = "world"
_MICRON = 1e-6


def measure_clearance(spec: mujoco.MjSpec, trunk: str, clearance: float) -> None:
    """Add the sensor of the least distance, and gaps that make contacts within a clearance visible.

    Args:
        spec: Robot and scene.
        trunk: Name of the body that holds all other bodies of the robot.
        clearance: Distance from which parts count as apart [m]; 0 to measure only depths.
    """
    clearance = _microns(clearance)  # a model's text has six digits
    gap = _microns(max(clearance / 2 - _least_margin(spec), 0.0)) if clearance else 0.0  # of each shape
    _widen(spec, gap, clearance)
    found, distance = (1 << int(field) for field in (_FOUND, _DISTANCE))
    tree = mujoco.mjtObj.mjOBJ_XBODY
    sensor = spec.add_sensor(
        name=_NAME, type=mujoco.mjtSensor.mjSENS_CONTACT, objtype=tree, objname=trunk, reftype=tree, refname=trunk
    )
    sensor.intprm[:3] = [found | distance, _NEAREST, 1]
    spec.add_numeric(name=_NAME, data=[clearance, gap])


_FOUND, _DISTANCE = mujoco.mjtConDataField.mjCONDATA_FOUND, mujoco.mjtConDataField.mjCONDATA_DIST
_NEAREST = 1  # of contact sensors' ways to choose among contacts


def forget_clearance(spec: mujoco.MjSpec) -> None:
    """Remove what `measure_clearance` added, if it did.

    Args:
        spec: Robot and scene; it is changed.
    """
    number = next((one for one in spec.numerics if one.name == _NAME), None)
    if number is None:
        return
    clearance, *rest = (float(value) for value in number.data)
    gap = rest[0] if rest else clearance / 2  # version 0.2 gave each shape half of the clearance
    _widen(spec, -gap, -clearance)
    spec.delete(number)
    spec.delete(spec.sensor(_NAME))


def _microns(length: float) -> float:
    """Round a length up to whole micrometres [m]."""
    return math.ceil(length / _MICRON - 1e-9) * _MICRON


def _colliding(spec: mujoco.MjSpec) -> Iterator[tuple[mujoco.MjsGeom, bool]]:
    """Yield shapes that may touch others, and whether they belong to the scene."""
    for geom in spec.geoms:
        if geom.contype or geom.conaffinity:
            yield geom, geom.parent.name == _WORLD


def _least_margin(spec: mujoco.MjSpec) -> float:
    """Return the least margin of the robot's shapes [m]: MuJoCo finds their contacts at twice as much without a gap."""
    return min((float(geom.margin) for geom, scene in _colliding(spec) if not scene), default=0.0)


def _widen(spec: mujoco.MjSpec, gap: float, clearance: float) -> None:
    """Find contacts within the robot at a larger distance.

    Args:
        spec: Robot and scene; it is changed.
        gap: What each shape of the robot gets, and each shape of the scene loses [m].
        clearance: What pairs get that the model lists, whose gap is their own [m].
    """
    if gap:
        for geom, scene in _colliding(spec):
            geom.gap += -gap if scene else gap
    scene = {geom.name for geom in spec.geoms if geom.parent.name == _WORLD}
    for pair in spec.pairs:
        if not {pair.geomname1, pair.geomname2} & scene:
            pair.gap += clearance


def with_clearance(xml: str, assets: Mapping[str, bytes], trunk: str, clearance: float) -> mujoco.MjModel:
    """Compile a model with another clearance than its text has.

    Args:
        xml: MJCF text of robot and scene.
        assets: File name in ``xml`` -> content.
        trunk: Name of the body that holds all other bodies of the robot.
        clearance: Distance from which parts count as apart [m]; 0 to measure only depths.

    Returns:
        The compiled model.
    """
    spec = mujoco.MjSpec.from_string(xml, assets=dict(assets))
    forget_clearance(spec)
    measure_clearance(spec, trunk, clearance)
    return spec.compile()


def clearance_in(model: mujoco.MjModel) -> float | None:
    """Return the clearance of a model [m]. None if it measures no distances.

    Args:
        model: Robot and scene.

    Returns:
        The clearance [m], or None.
    """
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, _NAME)
    return None if number < 0 else float(model.numeric_data[model.numeric_adr[number]])


def sensor_address(model: mujoco.MjModel) -> int | None:
    """Return the address of the sensor in sensordata. None if there is none.

    Args:
        model: Robot and scene.

    Returns:
        Index of the sensor's first value, or None.
    """
    sensor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, _NAME)
    return None if sensor < 0 else int(model.sensor_adr[sensor])


def distances(sensordata: Array, address: int, clearance: float) -> Array:
    """Read the sensor's values at the beginning of each step [m], shape (n, steps).

    Args:
        sensordata: Shape (n, steps, nsensordata).
        address: Address of the sensor.
        clearance: Distance from which parts count as apart [m].

    Returns:
        Distances [m], shape (n, steps).
    """
    found, distance = sensordata[..., address], sensordata[..., address + 1]
    return np.where(found > 0, np.minimum(distance, clearance), clearance)


def self_contacts(model: mujoco.MjModel, data: mujoco.MjData) -> Iterator[tuple[int, int, float]]:
    """Yield contacts between bodies of the robot: the two bodies, in ascending order, and their distance [m].

    Args:
        model: Robot and scene.
        data: Data after ``mj_collision``.
    """
    contacts = data.contact  # its arrays at once: one contact after the other takes ten times as long
    bodies, distances = np.sort(model.geom_bodyid[contacts.geom], axis=-1), contacts.dist
    for (one, other), distance in zip(bodies.tolist(), distances.tolist(), strict=True):
        if one and one != other:
            yield one, other, distance


def distances_at(model: mujoco.MjModel, configurations: Array) -> Array:
    """Compute the sensor's values at given configurations, for other engines and for the end of a simulation.

    Args:
        model: Model after `measure_clearance`.
        configurations: Positions of the model, shape (rows, nq).

    Returns:
        Distances [m], shape (rows,).
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
