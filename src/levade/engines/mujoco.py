"""The default engine: MuJoCo, its simulations stepped in a batch on a thread pool.

The model is always the one compiled from `MujocoEngine.xml`, the text that a motion file keeps, so that whoever
replays a motion from its file simulates the same model to the last bit.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property

import mujoco
import numpy as np
from mujoco.batch import Batch, SimulationError

from levade.engines.physics import Physics
from levade.engines.start import Settled, Start, State
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Scene, compose
from levade.trajectory import Array, JointReference, Trajectories

_STATE = mujoco.mjtState.mjSTATE_INTEGRATION
_SENSORS_OFF = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
_RESET_OFF = int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
_OVERLAP = 0.003
"""[m]: what may overlap before the start; contacts at rest sink in by less."""


class MujocoEngine:
    """Rolls out joint references of one robot in one scene.

    threads: of the batch; 0 for one per core. Results do not depend on it.
    steps: physics steps of all roll-outs so far; a trial that breaks down counts in full.
    Not to be used from several Python threads at once.
    """

    def __init__(self, robot: Robot, scene: Scene, physics: Physics, *, threads: int = 0) -> None:
        self.robot = robot
        self.scene = scene
        self.physics = physics
        self.steps = 0
        self._threads = threads
        self.xml = self._compose(gain_scale=1.0)
        self.assets = dict(robot.assets)
        self.model = _compile(self.xml, self.assets)
        self._layout = _Layout(robot, self.model)
        self._batches: dict[bool, Batch] = {}
        self._ctrl: Array | None = None

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """Names of the robot's bodies, whose contact forces with the scene `rollout` can record."""
        return tuple(self.model.body(i).name for i in range(1, self.model.nbody))

    def start(self, start: Start) -> State:
        """The state at the start of a motion.

        Raises LevadeError if the robot overlaps the scene, or itself, before it is let go, or the simulation diverges.
        """
        if isinstance(start, Settled):
            posture = self._posture("start.settled.posture", start)
            feet = self.robot.foot_positions(posture)
            ground = self.scene.ground_height(start.x + feet[:, 0], start.y + feet[:, 1])
            height = self.robot.standing_height(start.posture) + float(ground.max())
            data = self._release((start.x, start.y, height), (0.0, 0.0, 0.0), posture, self.model)
            return self._let_go(self.model, data, posture, start.time)
        generator = np.random.default_rng(start.seed)
        attitude = np.array([start.roll, start.pitch, start.yaw]) + start.spread * generator.standard_normal(3)
        posture = self._posture("start.fall.posture", start)
        posture += start.spread * generator.standard_normal(posture.size)
        limits = self.robot.limits
        posture = np.clip(posture, limits.lower, limits.upper)
        model = _compile(self._compose(gain_scale=start.gain), self.assets)
        data = self._release((start.x, start.y, start.height), tuple(attitude), posture, model)
        return self._let_go(model, data, posture, start.time)

    def rollout(
        self, state: State, reference: JointReference, *, feet: bool = False, bodies: Sequence[str] = ()
    ) -> Trajectories:
        """Simulate n trials that start in one state and follow their references.

        feet: record the contact force on each foot. bodies: record the contact force with the scene of these.
        Simulations that break down are marked in ``diverged``; their later rows repeat the last one.
        """
        model, layout = self.model, self._layout
        n, steps = reference.position.shape[:2]
        self.steps += n * steps
        recorded = ["qpos", "qvel", "actuator_force"]
        if feet or bodies:
            recorded.append("sensordata")
        batch = self._batch_for(n, sensors=feet or bool(bodies))
        batch.state[:n] = self._row(state)
        before = batch.warning[:n].copy()
        failed: list[int] = []
        ids = None if n == batch.nsim else np.arange(n)
        try:
            with _quiet():
                out = batch.rollout(steps, self.ctrl(reference), record=recorded, ids=ids)
        except SimulationError as error:
            failed = [int(i) for i in error.ids]
            ok = [i for i in range(n) if i not in failed]
            out = {}
            for name in recorded:
                out[name] = np.zeros((n, steps, *getattr(mujoco.MjData(model), name).shape))
            if ok:
                batch.state[ok] = self._row(state)
                with _quiet():
                    part = batch.rollout(steps, self.ctrl(reference[ok]), record=recorded, ids=np.array(ok))
                for name in recorded:
                    out[name][ok] = part[name]
            out["qpos"][failed], out["qvel"][failed] = state.qpos, state.qvel
        diverged = (batch.warning[:n] != before).reshape(n, -1).any(axis=1)
        diverged[failed] = True

        root = layout.root_qpos
        sensordata = out.get("sensordata")
        return Trajectories(
            joint_position=out["qpos"][..., layout.joint_qpos],
            joint_velocity=out["qvel"][..., layout.joint_qvel],
            joint_torque=out["actuator_force"][..., layout.actuators],
            trunk_position=out["qpos"][..., root : root + 3],
            trunk_quaternion=out["qpos"][..., root + 3 : root + 7],
            trunk_linear_velocity=out["qvel"][..., layout.root_qvel : layout.root_qvel + 3],
            trunk_angular_velocity=out["qvel"][..., layout.root_qvel + 3 : layout.root_qvel + 6],
            trunk_com_offset=self.robot.trunk_com_offset,
            reference=reference,
            limits=self.robot.limits,
            legs=self.robot.leg_geometry,
            timestep=self.physics.timestep,
            horizon_steps=reference.horizon_steps,
            diverged=diverged,
            foot_contact_force=None if sensordata is None or not feet else layout.foot_forces(sensordata),
            body_contact_force={}
            if sensordata is None
            else {body: layout.force_on(body, sensordata) for body in bodies},
        )

    def ctrl(self, reference: JointReference) -> Array:
        """What is sent to the actuators, (n, steps, nu): position and velocity of each joint. Reused by the next
        call.
        """
        shape = (*reference.position.shape[:2], self.model.nu)
        if self._ctrl is None or self._ctrl.shape != shape:
            self._ctrl = np.zeros(shape)
        self._ctrl[..., self._layout.ctrl_position] = reference.position
        self._ctrl[..., self._layout.ctrl_velocity] = reference.velocity
        return self._ctrl

    def _compose(self, *, gain_scale: float) -> str:
        spec = compose(self.robot, self.scene, gain_scale=gain_scale)
        option = spec.option
        option.timestep = self.physics.timestep
        option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{self.physics.integrator.upper()}")
        option.cone = getattr(mujoco.mjtCone, f"mjCONE_{self.physics.cone.upper()}")
        option.impratio = self.physics.impratio
        option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        _add_contact_sensors(spec, self.robot)
        return spec.to_xml()

    def _batch_for(self, n: int, *, sensors: bool) -> Batch:
        """A batch of at least n simulations. A batch takes its options when it is made, so there are two.

        Sensors are read only: the motion is the same with and without them.
        """
        batch = self._batches.get(sensors)
        if batch is None or batch.nsim < n:
            model = copy.deepcopy(self.model)
            # a state that has gone bad stops the simulation; it must not start over unnoticed
            model.opt.disableflags |= _RESET_OFF | (0 if sensors else _SENSORS_OFF)
            batch = self._batches[sensors] = Batch(model, n, self._threads)
        return batch

    def _row(self, state: State) -> Array:
        """The state as a batch takes it: as after ``mj_resetData`` and setting qpos, qvel and act."""
        data = mujoco.MjData(self.model)
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
        row = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        mujoco.mj_getState(self.model, data, row, _STATE)
        return row

    def _posture(self, where: str, start: Start) -> Array:
        try:
            return self.robot.posture(start.posture)
        except LevadeError as error:
            raise LevadeError(f"{where}: {error}") from None

    def _release(
        self,
        position: tuple[float, float, float],
        attitude: tuple[float, float, float],
        posture: Array,
        model: mujoco.MjModel,
    ) -> mujoco.MjData:
        data = mujoco.MjData(model)
        root = self._layout.root_qpos
        data.qpos[root : root + 3] = position
        roll, pitch, yaw = attitude
        mujoco.mju_euler2Quat(data.qpos[root + 3 : root + 7], np.array([yaw, pitch, roll]), "zyx")
        data.qpos[self._layout.joint_qpos] = posture
        mujoco.mj_forward(model, data)
        for contact in data.contact:
            if contact.dist < -_OVERLAP and not contact.exclude:
                one, other = (_geom_name(model, int(geom)) for geom in contact.geom)
                raise LevadeError(
                    f"start: {one} and {other} overlap by {-contact.dist:.3f} m where the robot is put down;"
                    " move the robot (start) or the obstacle (scene)"
                )
        return data

    def _let_go(self, model: mujoco.MjModel, data: mujoco.MjData, posture: Array, time: float) -> State:
        steps = round(time / self.physics.timestep)
        ctrl = np.zeros(model.nu)
        ctrl[self._layout.ctrl_position] = posture
        data.ctrl[:] = ctrl
        if steps:
            with _quiet():
                mujoco.mj_step(model, data, nstep=steps)
        if any(warning.number for warning in data.warning):
            raise LevadeError(
                f"start: the simulation broke down within {time} s; a smaller physics.timestep or lower gains may help"
            )
        return State(
            qpos=data.qpos.copy(),
            qvel=data.qvel.copy(),
            act=data.act.copy(),
            joint_position=data.qpos[self._layout.joint_qpos].copy(),
            joint_reference=posture.copy(),
        )


@contextmanager
def _quiet() -> Iterator[None]:
    """Simulations that break down are told to the caller, not to standard error and a MUJOCO_LOG.TXT."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(_ignore)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def _ignore(message: str) -> None:
    pass


class _Layout:
    """Where the robot's quantities are in the vectors of the model."""

    def __init__(self, robot: Robot, model: mujoco.MjModel) -> None:
        joints = [model.joint(name) for name in robot.joint_names]
        actuators = [model.actuator(name).id for name in robot.joint_names]
        root = model.joint(int(model.body(robot.trunk).jntadr[0]))
        self.root_qpos, self.root_qvel = int(root.qposadr[0]), int(root.dofadr[0])
        # slices where the model's order is the robot's: views instead of copies of what is recorded
        self.joint_qpos = _compact([int(joint.qposadr[0]) for joint in joints])
        self.joint_qvel = _compact([int(joint.dofadr[0]) for joint in joints])
        self.actuators = _compact([int(model.actuator_outadr[i]) for i in actuators])
        first = [int(model.actuator_ctrladr[i]) for i in actuators]
        self.ctrl_position = _compact(first)
        self.ctrl_velocity = _compact([address + 1 for address in first])
        self._feet = [int(model.sensor(_foot_sensor(foot)).adr[0]) for foot in robot.feet]
        self._model = model

    def foot_forces(self, sensordata: Array) -> Array:
        """(n, steps, feet, 3) [N], on the feet."""
        return np.stack([-sensordata[..., a : a + 3] for a in self._feet], axis=2)

    def force_on(self, body: str, sensordata: Array) -> Array:
        """(n, steps) [N]."""
        address = int(self._model.sensor(_body_sensor(body)).adr[0])
        return np.linalg.norm(sensordata[..., address : address + 3], axis=-1)


def _foot_sensor(foot: str) -> str:
    return f"{foot}_contact_force"


def _body_sensor(body: str) -> str:
    return f"{body}_scene_force"


def _add_contact_sensors(spec: mujoco.MjSpec, robot: Robot) -> None:
    """Net force of each foot's contacts, and of each body's contacts with the scene, in world axes."""
    data_force = 1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE)
    netforce = 3

    def add(name: str, **match) -> None:
        sensor = spec.add_sensor(name=name, type=mujoco.mjtSensor.mjSENS_CONTACT, **match)
        sensor.intprm[:3] = [data_force, netforce, 1]

    geom, body = mujoco.mjtObj.mjOBJ_GEOM, mujoco.mjtObj.mjOBJ_BODY
    for foot in robot.feet:
        add(_foot_sensor(foot), objtype=geom, objname=foot)
    for element in spec.bodies[1:]:
        add(_body_sensor(element.name), objtype=body, objname=element.name, reftype=body, refname="world")


def _compact(indices: list[int]) -> slice | list[int]:
    if len(indices) > 1:
        stride = indices[1] - indices[0]
        if stride > 0 and indices == list(range(indices[0], indices[-1] + 1, stride)):
            return slice(indices[0], indices[-1] + 1, stride)
    return indices


def _compile(xml: str, assets: dict[str, bytes]) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(xml, assets)


def _geom_name(model: mujoco.MjModel, geom: int) -> str:
    name = model.geom(geom).name
    return name or f"a part of {model.body(int(model.geom_bodyid[geom])).name}"
