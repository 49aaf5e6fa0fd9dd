"""Put a robot into a scene: the model's text, its engine, and the state from which a motion starts.

engine = make_engine(load_robot("hyq2max"), Scene(), Physics())
state = start_state(engine, robot, Scene(), Settled("neutral"))
"""

from __future__ import annotations

import mujoco
import numpy as np

from levade.arrays import Array
from levade.engines.clearance import measure_clearance
from levade.engines.engine import Engine
from levade.engines.folding import Folding
from levade.engines.layout import add_contact_sensors, measure_self_force
from levade.engines.physics import Physics
from levade.engines.start import Fallen, GivenState, Settled, Start
from levade.engines.state import State
from levade.engines.table import engine_kind
from levade.errors import LevadeError, located
from levade.robots import Robot
from levade.robots.shapes import support
from levade.scenes import Scene, compose

_OVERLAP = 0.003
"""Largest overlap before the start [m]. Contacts at rest sink in by less."""
_DOWN = np.array([0.0, 0.0, -1.0])
_LEVEL = np.array([1.0, 0.0, 0.0, 0.0])

_DRAWS = 1000
"""Number of postures that are drawn for a fall until no parts overlap."""

_FAMILY = 1_178_686_574
"""Keeps the random numbers of families of falls apart from others."""


def model_xml(
    robot: Robot,
    scene: Scene,
    physics: Physics,
    *,
    gain_scale: float = 1.0,
    clearance: float | None = None,
    self_force: bool = False,
) -> str:
    """Write the model of a robot in a scene: MJCF with actuators, contact sensors and the numerical settings.

    Args:
        robot: The robot. Its ``assets`` are the files that the text names.
        scene: Ground and obstacles.
        physics: Numerical settings.
        gain_scale: Factor on the gains of the joints.
        clearance: Distance up to which the robot's parts are measured [m]. None for no measurement.
        self_force: Whether to measure the forces of the robot's parts on each other.

    Returns:
        The text.
    """
    spec = compose(robot, scene, gain_scale=gain_scale)
    option = spec.option
    option.timestep = physics.timestep
    option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{physics.integrator.upper()}")
    option.cone = getattr(mujoco.mjtCone, f"mjCONE_{physics.cone.upper()}")
    option.impratio = physics.impratio
    option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    add_contact_sensors(spec, robot.feet, [leg.foot for leg in robot.legs if leg.pads])
    if self_force:
        measure_self_force(spec, robot.trunk)
    if clearance is not None:
        measure_clearance(spec, robot.trunk, clearance)
    return spec.to_xml()


def make_engine(
    robot: Robot,
    scene: Scene,
    physics: Physics,
    *,
    threads: int = 0,
    clearance: float | None = None,
    self_force: bool = False,
) -> Engine:
    """Put a robot into a scene, in the engine that ``physics.engine`` names.

    Args:
        robot: The robot.
        scene: Ground and obstacles.
        physics: Engine and numerical settings.
        threads: Number of threads or processes (0: one per core). Results do not depend on it.
        clearance: Distance up to which the robot's parts are measured [m]. None for no measurement.
        self_force: Whether to measure the forces of the robot's parts on each other.

    Returns:
        The engine.

    Raises:
        LevadeError: If the engine needs a missing library, or cannot simulate the robot.
    """
    xml = model_xml(robot, scene, physics, clearance=clearance, self_force=self_force)
    return engine_kind(physics.engine).make(xml, robot.assets, robot.embodiment, physics, threads=threads)


def start_state(engine: Engine, robot: Robot, scene: Scene, start: Start) -> State:
    """Simulate how the robot comes to the start of a motion.

    Args:
        engine: The engine of the robot in the scene.
        robot: The robot.
        scene: The scene.
        start: How the motion starts.

    Returns:
        The state at the start, one row.

    Raises:
        LevadeError: If the robot overlaps the scene or itself before it is let go, or the simulation breaks down.
    """
    if isinstance(start, GivenState):
        return _given(engine, start)
    if isinstance(start, Settled):
        with located("start.settled.posture: "):
            posture = robot.posture(start.posture)
        feet = robot.foot_positions(posture)
        ground = scene.ground_height(start.x + feet[:, 0], start.y + feet[:, 1])
        height = robot.standing_height(start.posture) + float(ground.max())
        data = _put(engine, engine.model, scene, (start.x, start.y, height), _LEVEL, posture)
        _check_apart(engine.model, data)
        return engine.hold(engine.model, data, posture, start.time)
    if isinstance(start, Fallen):
        return _fallen(engine, robot, scene, start)
    generator = np.random.default_rng(start.seed)
    attitude = np.array([start.roll, start.pitch, start.yaw]) + start.spread * generator.standard_normal(3)
    with located("start.fall.posture: "):
        posture = robot.posture(start.posture)
    posture += start.spread * generator.standard_normal(posture.size)
    posture = np.clip(posture, robot.limits.lower, robot.limits.upper)
    model = _with_gain(engine, robot, scene, start.gain)
    roll, pitch, yaw = attitude
    quaternion = np.empty(4)
    mujoco.mju_euler2Quat(quaternion, np.array([yaw, pitch, roll]), "zyx")
    data = _put(engine, model, scene, (start.x, start.y, start.height), quaternion, posture)
    _check_apart(model, data)
    return engine.hold(model, data, posture, start.time)


def _with_gain(engine: Engine, robot: Robot, scene: Scene, gain: float) -> mujoco.MjModel:
    """Return the engine's model with a factor on the gains of the joints."""
    if gain == 1.0:
        return engine.model
    xml = model_xml(robot, scene, engine.physics, gain_scale=gain)
    return mujoco.MjModel.from_xml_string(xml, engine.assets)


def _fallen(engine: Engine, robot: Robot, scene: Scene, start: Fallen) -> State:
    model = _with_gain(engine, robot, scene, start.gain)
    generator = np.random.default_rng((start.seed, start.index, _FAMILY))
    attitude = generator.standard_normal(4)
    attitude /= np.linalg.norm(attitude)
    lower, upper = _within_a_turn(robot.limits.lower, robot.limits.upper)
    height = start.height + float(scene.ground_height(np.array([start.x]), np.array([start.y]))[0])
    overlap = ""
    for _ in range(_DRAWS):
        posture = generator.uniform(lower, upper)
        data = _put(engine, model, scene, (start.x, start.y, height), attitude, posture)
        overlap = _overlap(model, data)
        if not overlap:
            state = engine.hold(model, data, posture, start.time)
            return state if start.fold is None else Folding.of(robot, start.fold).folded(engine, state)
    raise LevadeError(
        f"start.fallen: {overlap} in the last of {_DRAWS} postures that were drawn; move the robot (start) or the obstacle"
        " (scene)"
    )


def _within_a_turn(lower: Array, upper: Array) -> tuple[Array, Array]:
    """Return the ranges of joints [rad], and of those wider than a turn the turn around zero, as far as they reach."""
    begin = np.clip(-np.pi, lower, upper - 2 * np.pi)
    wide = upper - lower > 2 * np.pi
    return np.where(wide, begin, lower), np.where(wide, begin + 2 * np.pi, upper)


def _given(engine: Engine, start: GivenState) -> State:
    model = engine.model
    sizes = {"qpos": model.nq, "qvel": model.nv, "act": model.na, "joint_reference": engine.embodiment.joints}
    for name, size in sizes.items():
        if len(getattr(start, name)) != size:
            raise LevadeError(
                f"start.state.{name}: {len(getattr(start, name))} numbers, should be {size} for this robot, scene and"
                " actuation; a motion's end can only begin a motion of the same robot"
            )
    qpos, qvel, act = (np.array(getattr(start, name)) for name in ("qpos", "qvel", "act"))
    return engine.layout.state(qpos, qvel, act, joint_reference=np.array(start.joint_reference))


def _check_apart(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Raise LevadeError if parts overlap."""
    overlap = _overlap(model, data)
    if overlap:
        raise LevadeError(
            f"start: {overlap} where the robot is put down; move the robot (start) or the obstacle (scene)"
        )


def _put(
    engine: Engine,
    model: mujoco.MjModel,
    scene: Scene,
    position: tuple[float, float, float],
    quaternion: Array,
    posture: Array,
) -> mujoco.MjData:
    """Put the robot down at a position, or higher if a part of it would be in the ground."""
    data, layout = mujoco.MjData(model), engine.layout
    data.qpos[layout.trunk_position] = position
    data.qpos[layout.trunk_quaternion] = quaternion
    data.qpos[layout.joint_qpos] = posture
    data.qpos[layout.trunk_position][2:] += _lift(model, data, scene)
    mujoco.mj_forward(model, data)
    return data


def _overlap(model: mujoco.MjModel, data: mujoco.MjData) -> str:
    """Say which two parts overlap, and by how much; "" if none do."""
    for contact in data.contact:
        if contact.dist < -_OVERLAP and not contact.exclude:
            one, other = (_geom_name(model, int(geom)) for geom in contact.geom)
            return f"{one} and {other} overlap by {-contact.dist:.3f} m"
    return ""


def _lift(model: mujoco.MjModel, data: mujoco.MjData, scene: Scene) -> float:
    """Compute how far a robot must be lifted until its lowest point is on the ground [m]; 0 if no part is below."""
    mujoco.mj_kinematics(model, data)
    points = np.array(
        [
            support(model, data, geom, _DOWN)
            for geom in range(model.ngeom)
            if model.body_weldid[model.geom_bodyid[geom]] and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        ]
    )
    if not len(points):
        return 0.0
    below = float((scene.ground_height(points[:, 0], points[:, 1]) - points[:, 2]).max())
    return below if below > _OVERLAP else 0.0


def _geom_name(model: mujoco.MjModel, geom: int) -> str:
    name = model.geom(geom).name
    return name or f"a part of {model.body(int(model.geom_bodyid[geom])).name}"
