"""ODE on HyQ2Max, against MuJoCo on the same model, against conservation laws, and against itself in another process."""

from __future__ import annotations

import dataclasses
import gc
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import mujoco
import numpy as np
import pytest

import levade.robots
from levade.engines import FOOT_CONTACT_FORCE, Engine, Fall, Ode, Physics, Settled, State, make_engine, start_state
from levade.engines.ode import library, workers
from levade.engines.ode.broadphase import BroadPhase
from levade.engines.ode.joints import Torques, link_motion
from levade.engines.ode.library import load
from levade.engines.ode.multibody import multibody_of
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.scenes import Box, Scene
from levade.trajectory import JointReference, Trajectories

try:
    load()
except LevadeError as missing:
    pytest.skip(str(missing), allow_module_level=True)

ARRAYS = ("joint_position", "joint_velocity", "joint_torque", "trunk_position", "trunk_quaternion")
ARRAYS = (*ARRAYS, "trunk_linear_velocity", "trunk_angular_velocity")
PHYSICS = Physics(engine="ode")
DOUBLE = load().dtype == np.float64


@pytest.fixture(scope="module")
def ode(robot: Robot) -> Engine:
    return make_engine(robot, Scene(), PHYSICS, threads=1)


@pytest.fixture(scope="module")
def standing(robot: Robot, ode: Engine) -> State:
    return start_state(ode, robot, Scene(), Settled())


def hold(engine: Engine, state: State, steps: int, **options) -> Trajectories:
    position = np.repeat(state.joint_reference[None], steps, axis=1)
    return engine.rollout(state, JointReference(position, np.zeros_like(position), 0.002, steps), **options)


def states(engine: Engine, out: Trajectories, trial: int = 0) -> Iterator[mujoco.MjData]:
    """MuJoCo's kinematics of every row of a trial."""
    model, layout = engine.model, engine.layout
    data = mujoco.MjData(model)
    root, velocity = layout.root_qpos, layout.root_qvel
    for k in range(out.steps):
        data.qpos[root : root + 3] = out.trunk_position[trial, k]
        data.qpos[root + 3 : root + 7] = out.trunk_quaternion[trial, k]
        data.qvel[velocity : velocity + 3] = out.trunk_linear_velocity[trial, k]
        data.qvel[velocity + 3 : velocity + 6] = out.trunk_angular_velocity[trial, k]
        data.qpos[layout.joint_qpos], data.qvel[layout.joint_qvel] = (
            out.joint_position[trial, k],
            out.joint_velocity[trial, k],
        )
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_comVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        yield data


@pytest.mark.slow
@pytest.mark.parametrize("actuation", ["hydraulic", "ideal"])
def test_drives_deliver_what_mujoco_s_deliver(actuation: str) -> None:
    """At random angles, speeds, references and states of the lag, to rounding."""
    engine = make_engine(load_robot("hyq2max", actuation=actuation), Scene(), Physics(), threads=1)
    s, random = multibody_of(engine.model), np.random.default_rng(0)
    for _ in range(50):
        data = mujoco.MjData(engine.model)
        q, v, error, rate = random.normal(size=(4, 12)) * [[1], [8], [0.4], [5]]
        data.qpos[2], data.qpos[s.hinges.qpos], data.qvel[s.hinges.qvel] = 50, q, v
        data.ctrl[s.drives.ctrl], data.ctrl[s.drives.ctrl + 1] = q + error, rate
        data.act[:] = 150 * random.normal(size=engine.model.na)
        lag = data.act[None, s.drives.act].copy() if engine.model.na else np.zeros((1, 12))
        mujoco.mj_step(engine.model, data)
        torque = Torques(s, 0.002)(lag, q[None], v[None], (q + error)[None], rate[None])[0][0]
        np.testing.assert_allclose(torque, data.actuator_force, rtol=1e-9, atol=1e-9)


def test_a_step_in_flight_is_mujoco_s_explicit_step(robot: Robot, ode: Engine, standing: State) -> None:
    """From a random attitude and velocities: same accelerations as with MuJoCo's integrator Euler, to what QuickStep leaves
    unsolved. (The default, implicitfast, damps the drives within the step.)
    """
    engine = make_engine(robot, Scene(), Physics(integrator="Euler"), threads=1)
    random = np.random.default_rng(1)
    qpos, qvel = standing.qpos.copy(), random.normal(size=standing.qvel.shape)
    qpos[0, 2] = 5.0
    quaternion = random.normal(size=4)
    qpos[0, 3:7] = quaternion / np.linalg.norm(quaternion)
    start = dataclasses.replace(standing, qpos=qpos, qvel=qvel)
    out = {name: hold(e, start, 1) for name, e in (("ode", ode), ("mujoco", engine))}
    for name in ARRAYS:
        atol = {"joint_velocity": 0.02, "joint_torque": 1e-9, "joint_position": 1e-4}.get(name, 0.003)
        atol = atol if DOUBLE else max(atol, 1e-3)
        np.testing.assert_allclose(getattr(out["ode"], name), getattr(out["mujoco"], name), rtol=0, atol=atol)


@pytest.mark.parametrize("name", ["ode", "mujoco"])
def test_in_flight_momentum_is_kept_and_the_centre_of_mass_falls_freely(
    name: str, robot: Robot, wave: Callable[..., JointReference]
) -> None:
    """Whatever the legs do: the centre of mass by the closed form of symplectic Euler; angular momentum to 1 % of what the
    legs alone have, as first-order integrators with steps of 2 ms keep it (half of it at 1 ms).
    """
    engine = make_engine(robot, Scene(), Physics(engine=name), threads=1)
    state = start_state(engine, robot, Scene(), Fall(height=8.0, roll=0.3, pitch=-0.2, time=0.0))
    out = engine.rollout(state, wave(state.joint_reference, n=1, steps=200, scale=0.2))
    rows = [
        (d.subtree_com[0].copy(), d.subtree_linvel[0].copy(), d.subtree_angmom[0].copy()) for d in states(engine, out)
    ]
    com, velocity, spin = (np.array(values) for values in zip(*rows, strict=True))
    k = np.arange(1, 201)
    np.testing.assert_allclose(velocity[:, 2], -9.81 * 0.002 * k, rtol=0, atol=2e-3)
    np.testing.assert_allclose(velocity[:, :2], 0, rtol=0, atol=2e-3)
    fallen = -9.81 * 0.002**2 * k * (k + 1) / 2
    np.testing.assert_allclose(com[:, 2] - com[0, 2], fallen - fallen[0], rtol=0, atol=5e-4)
    legs = 4 * 10.2 * 0.3**2 * np.abs(out.joint_velocity).mean()  # four legs of 10 kg, their mass 0.3 m away
    assert legs > 3
    assert np.abs(spin).max() < 0.01 * legs


def test_standing_takes_the_same_torques_and_forces(
    robot: Robot, engine: Engine, ode: Engine, state: State, standing: State
) -> None:
    """Statics of a robot on four feet, which do not slip: what is left open is how hard the feet push against each other,
    and that depends on how they came down. So: heights within 2 mm, torques within 1.5 Nm of up to 37.
    """
    assert standing.qpos[0, 2] == pytest.approx(state.qpos[0, 2], abs=0.002)
    here, there = (
        hold(ode, standing, 100, record=[FOOT_CONTACT_FORCE]),
        hold(engine, state, 100, record=[FOOT_CONTACT_FORCE]),
    )
    torque = here.joint_torque[0, 50:].mean(axis=0) - there.joint_torque[0, 50:].mean(axis=0)
    assert np.abs(torque).max() < 1.5
    assert np.abs(there.joint_torque).max() > 30
    total = here.foot_contact_force[0, 50:].sum(axis=1).mean(axis=0)
    weight = ode.model.body_mass.sum() * 9.81
    np.testing.assert_allclose(total, [0, 0, weight], rtol=0, atol=0.003 * weight)
    share = here.foot_contact_force[0, 50:].mean(axis=0) - there.foot_contact_force[0, 50:].mean(axis=0)
    assert np.abs(share[:, 2]).max() < 0.01 * weight


@pytest.mark.slow
@pytest.mark.parametrize("actuation", ["hydraulic", "ideal"])
def test_a_step_of_a_hanging_leg(actuation: str) -> None:
    """A knee told to bend by 0.2 rad, and a hip by 0.1, with the robot in the air: both engines go the same way, within
    what their different integrators (damping explicit here, implicit there) make of steps of 2 ms.
    """
    robot = load_robot("hyq2max", actuation=actuation)
    engines = {name: make_engine(robot, Scene(), Physics(engine=name), threads=1) for name in ("mujoco", "ode")}
    state = start_state(engines["mujoco"], robot, Scene(), Fall(height=3.0, time=0.0))
    position = np.repeat(state.joint_position[None], 100, axis=1)
    position[:, :, 2] -= 0.2
    position[:, :, 1] += 0.1
    reference = JointReference(position, np.zeros_like(position), 0.002, 100)
    out = {name: engine.rollout(state, reference) for name, engine in engines.items()}
    moved = out["mujoco"].joint_position[0] - state.joint_position
    assert moved[:, 2].min() < -0.18
    assert moved[:, 1].max() > 0.05
    np.testing.assert_allclose(out["ode"].joint_position, out["mujoco"].joint_position, rtol=0, atol=0.01)
    # at the settled end
    np.testing.assert_allclose(
        out["ode"].joint_position[0, -1], out["mujoco"].joint_position[0, -1], rtol=0, atol=0.004
    )


def test_motions_stay_together_for_a_tenth_of_a_second(
    engine: Engine, ode: Engine, standing: State, wave: Callable[..., JointReference]
) -> None:
    """Legs that push the ground: contact tells the engines apart, slowly at first."""
    reference = wave(standing.joint_reference, n=5, steps=50)
    here, there = ode.rollout(standing, reference), engine.rollout(standing, reference)
    assert np.linalg.norm(here.trunk_position - there.trunk_position, axis=-1).max() < 0.01
    assert np.abs(there.joint_position - standing.joint_position).max() > 0.1


@pytest.mark.slow
def test_processes_order_and_company_do_not_matter(
    robot: Robot,
    ode: Engine,
    standing: State,
    wave: Callable[..., JointReference],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(workers, "_START", 0)
    reference = wave(standing.joint_reference, n=7, steps=220)
    expected = ode.rollout(standing, reference, record=(FOOT_CONTACT_FORCE, "trunk", "lf_lower"))
    three = make_engine(robot, Scene(), PHYSICS, threads=3)
    order = [6, 2, 4, 0, 1, 3, 5]
    for label, out, rows in (
        ("again", ode.rollout(standing, reference, record=[FOOT_CONTACT_FORCE]), slice(None)),
        ("three processes", three.rollout(standing, reference, record=[FOOT_CONTACT_FORCE]), slice(None)),
        ("shuffled", ode.rollout(standing, reference[order]), order),
        ("alone", ode.rollout(standing, reference[3:4], record=[FOOT_CONTACT_FORCE]), slice(3, 4)),
    ):
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(out, name), getattr(expected, name)[rows], err_msg=f"{label}: {name}")
        if out.foot_contact_force is not None:
            np.testing.assert_array_equal(out.foot_contact_force, expected.foot_contact_force[rows], err_msg=label)
    started = list(three._workers._workers)  # type: ignore[attr-defined]
    assert [worker.poll() for worker in started] == [None, None]
    del three
    gc.collect()
    assert None not in [worker.poll() for worker in started]  # they go with the engine
    # the shank's body has the foot on it, and only the foot touched the ground
    force = np.linalg.norm(expected.foot_contact_force[:, :, 0], axis=-1)
    np.testing.assert_allclose(expected.body_contact_force["lf_lower"], force, rtol=1e-6, atol=1e-6)
    np.testing.assert_array_equal(expected.body_contact_force["trunk"], 0)


@pytest.mark.slow
def test_every_pair_that_touches_is_found(robot: Robot) -> None:
    """ODE asked about every pair, in contorted postures among obstacles, against those that the quick test passes on."""
    scene = Scene(boxes=(Box((0.2, 0.2, 0.2), (0.5, 0.3, 0.3), roll=0.3, yaw=0.5),), slope=0.1)
    engine = make_engine(robot, scene, PHYSICS, threads=1)
    simulation = engine._workers.simulation  # type: ignore[attr-defined]
    s, worlds, ode = simulation.multibody, simulation._worlds, load()
    random, touched = np.random.default_rng(3), 0
    limits = robot.limits
    worlds.grow(1)
    for _ in range(60):
        qpos = engine.model.qpos0.copy()
        qpos[:3] = random.uniform([-0.3, -0.3, 0.1], [0.3, 0.3, 0.7])
        qpos[3:7] = random.normal(size=4)
        qpos[3:7] /= np.linalg.norm(qpos[3:7])
        qpos[s.hinges.qpos] = random.uniform(limits.lower, limits.upper)
        worlds.place([0], *link_motion(s, qpos, np.zeros(engine.model.nv)))
        passed_on = set(BroadPhase(s)(worlds.read(1), 0.002)[0])
        for pair, (one, other, _, _) in enumerate(worlds._sides[0]):
            if ode.dCollide(one, other, 8, worlds._geom_at, worlds._skip):
                touched += 1
                assert pair in passed_on, [s.shapes[i].kind for i in s.pairs[pair]]
    assert touched > 300


@pytest.fixture
def unstable(tmp_path: Path) -> Robot:
    """HyQ2Max with ideal actuators of no torque limit and a stiffness that no time step can follow."""
    folder = tmp_path / "robot"
    shutil.copytree(Path(levade.robots.__file__).parent / "data" / "hyq2max", folder)
    text = (folder / "robot.yaml").read_text()
    head, hydraulic, ideal = text.partition("  ideal:")
    head = head.replace("actuation: hydraulic", "actuation: ideal")
    head = head.replace('torque: {"*_haa": 120, "*_hfe": 245, "*_kfe": 250}', "")
    ideal = ideal.replace("kp: 600\n    kd: 20\n", "kp: 10000000\n    kd: 0\n", 1)
    (folder / "robot.yaml").write_text(head + hydraulic + ideal)
    return load_robot(folder / "robot.yaml")


@pytest.mark.slow
def test_simulations_that_break_down_are_marked_and_leave_the_others_alone(
    unstable: Robot, wave: Callable[..., JointReference], capfd: pytest.CaptureFixture[str]
) -> None:
    engine = make_engine(unstable, Scene(), dataclasses.replace(PHYSICS, timestep=0.01), threads=1)
    state = start_state(engine, unstable, Scene(), Settled(time=0.0))
    assert hold(engine, state, 40).diverged.all()
    with pytest.raises(LevadeError, match=r"start: the simulation broke down within 2.0 s; a smaller physics.timestep"):
        start_state(engine, unstable, Scene(), Settled(time=2.0))
    ideal = load_robot("hyq2max", actuation="ideal")
    good = make_engine(ideal, Scene(), PHYSICS, threads=1)
    state = start_state(good, ideal, Scene(), Settled(time=0.2))
    reference = wave(state.joint_reference, n=4, steps=60)
    expected = good.rollout(state, reference)
    broken = dataclasses.replace(reference, position=reference.position.copy(), velocity=reference.velocity.copy())
    broken.position[1, 30:] = np.nan
    broken.velocity[3] = np.nan
    out = good.rollout(state, broken, record=[FOOT_CONTACT_FORCE])
    np.testing.assert_array_equal(out.diverged, [False, True, False, True])
    for name in ARRAYS:
        value = getattr(out, name)
        assert np.isfinite(value).all(), name
        np.testing.assert_array_equal(value[[0, 2]], getattr(expected, name)[[0, 2]])
        np.testing.assert_array_equal(value[1, :30], getattr(expected, name)[1, :30])
        np.testing.assert_array_equal(value[1, 30:], np.broadcast_to(value[1, 29], value[1, 30:].shape))
    np.testing.assert_array_equal(good.rollout(state, reference).joint_position, expected.joint_position)
    assert capfd.readouterr() == ("", "")


def test_a_run_that_was_interrupted_leaves_nothing_behind(
    robot: Robot, standing: State, wave: Callable[..., JointReference]
) -> None:
    """In the middle of a step: torques put on, contacts made, nothing integrated."""
    engine = make_engine(robot, Scene(), PHYSICS, threads=1)
    worlds = engine._workers.simulation._worlds  # type: ignore[attr-defined]
    reference = wave(standing.joint_reference, n=2, steps=20)
    expected, step, calls = engine.rollout(standing, reference), worlds._step, []

    def interrupt(world: int, timestep: float) -> None:
        calls.append(world)
        if len(calls) == 24:
            raise KeyboardInterrupt
        step(world, timestep)

    worlds._step = interrupt
    with pytest.raises(KeyboardInterrupt):
        engine.rollout(standing, reference)
    worlds._step = step
    np.testing.assert_array_equal(engine.rollout(standing, reference).joint_position, expected.joint_position)


@pytest.mark.slow
def test_settings_reach_the_solver(robot: Robot, ode: Engine, standing: State) -> None:
    reference = hold(ode, standing, 30)
    for changed in (Ode(iterations=10), Ode(solver="exact"), Ode(erp=0.5), Ode(relaxation=1.0), Ode(surface_layer=0.0)):
        other = make_engine(robot, Scene(), dataclasses.replace(PHYSICS, ode=changed), threads=1)
        out = hold(other, standing, 30)
        assert not np.array_equal(out.joint_position, reference.joint_position), changed
        np.testing.assert_allclose(out.joint_position, reference.joint_position, rtol=0, atol=0.01)


@pytest.mark.slow
def test_the_library_of_the_wheel_agrees_with_the_system_s(
    robot: Robot, ode: Engine, standing: State, wave: Callable[..., JointReference], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Single precision against double: a tenth of a second later the trunk is where it was to a millimetre."""
    wheel = pytest.importorskip("importlib.util").find_spec("panda3d")
    if wheel is None or not DOUBLE:
        pytest.skip("both libraries are needed: apt install libode8, pip install 'levade[ode]'")
    reference = wave(standing.joint_reference, n=3, steps=50)
    expected = ode.rollout(standing, reference)
    monkeypatch.setattr(library, "_SYSTEM", "libode-is-not-here.so")
    load.cache_clear()
    try:
        assert load().name.endswith("single")
        other = make_engine(robot, Scene(), PHYSICS, threads=1)
        out = other.rollout(standing, reference)
    finally:
        load.cache_clear()
    assert np.linalg.norm(out.trunk_position - expected.trunk_position, axis=-1).max() < 2e-3


def test_without_a_library_the_error_says_what_to_install(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(library, "_SYSTEM", "libode-is-not-here.so")
    monkeypatch.setattr(library, "_WHEEL", "libode-is-not-here.so")
    load.cache_clear()
    try:
        with pytest.raises(
            LevadeError, match=r"needs the library .* apt install libode8 .* pip install 'levade\[ode\]'"
        ):
            make_engine(robot, Scene(), PHYSICS)
    finally:
        load.cache_clear()
