"""Roll-outs against a plain loop over mj_step, and against mechanics."""

from __future__ import annotations

import dataclasses
import shutil
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

import levade.robots
from levade.engines import (
    FOOT_CONTACT_FORCE,
    Engine,
    Fall,
    Physics,
    Settled,
    State,
    make_engine,
    start_state,
)
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.scenes import Scene
from levade.trajectory import JointReference, Trajectories

ARRAYS = ("joint_position", "joint_velocity", "joint_torque", "trunk_position", "trunk_quaternion")
ARRAYS = (*ARRAYS, "trunk_linear_velocity", "trunk_angular_velocity")


def copied(trajectories: Trajectories) -> dict[str, np.ndarray]:
    return {name: np.array(getattr(trajectories, name)) for name in ARRAYS}


def plain_loop(engine: Engine, state: State, reference: JointReference) -> dict[str, np.ndarray]:
    """The same by names, one trial and one step at a time."""
    model = mujoco.MjModel.from_xml_string(engine.xml, engine.assets)
    n, steps, joints = reference.position.shape
    out = {name: np.zeros((n, steps, joints)) for name in ARRAYS[:3]}
    out |= {name: np.zeros((n, steps, 4 if "quaternion" in name else 3)) for name in ARRAYS[3:]}
    for i in range(n):
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
        for k in range(steps):
            for j, name in enumerate(engine.embodiment.joint_names):
                asked = (reference.position[i, k, j], reference.velocity[i, k, j])
                address = model.actuator(name).ctrladr[0] if hasattr(model.actuator(name), "ctrladr") else 2 * j
                data.ctrl[address : address + 2] = asked
            mujoco.mj_step(model, data)
            for j, name in enumerate(engine.embodiment.joint_names):
                out["joint_position"][i, k, j] = data.joint(name).qpos[0]
                out["joint_velocity"][i, k, j] = data.joint(name).qvel[0]
                out["joint_torque"][i, k, j] = data.actuator(name).force[0]
            out["trunk_position"][i, k], out["trunk_quaternion"][i, k] = data.qpos[:3], data.qpos[3:7]
            out["trunk_linear_velocity"][i, k], out["trunk_angular_velocity"][i, k] = data.qvel[:3], data.qvel[3:6]
    return out


@pytest.mark.slow
@pytest.mark.parametrize("actuation", ["hydraulic", "ideal"])
def test_a_batch_equals_a_plain_loop_to_the_bit(actuation: str, wave: Callable[..., JointReference]) -> None:
    robot = load_robot("hyq2max", actuation=actuation)
    engine = make_engine(robot, Scene(), Physics(), threads=2)
    state = start_state(engine, robot, Scene(), Settled(time=0.5))
    reference = wave(state.joint_reference, n=3, steps=120)
    expected = plain_loop(engine, state, reference)
    for record in ((), (FOOT_CONTACT_FORCE,), ("trunk",), ()):
        out = engine.rollout(state, reference, record=record)
        assert not out.diverged.any()
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(out, name), expected[name], err_msg=f"{name} {record}")


def test_threads_order_and_size_of_the_batch_do_not_matter(
    robot: Robot, engine: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(state.joint_reference, n=7)
    expected = copied(engine.rollout(state, reference))
    two = make_engine(robot, Scene(), Physics(), threads=2)
    order = [6, 2, 4, 0, 1, 3, 5]
    for label, out, rows in (
        ("2 threads", two.rollout(state, reference), slice(None)),
        ("shuffled", two.rollout(state, reference[order]), order),
        ("one of them, after a larger batch", engine.rollout(state, reference[3:4]), slice(3, 4)),
        ("some, with forces", engine.rollout(state, reference[2:5], record=(FOOT_CONTACT_FORCE, "trunk")), slice(2, 5)),
        ("again", engine.rollout(state, reference), slice(None)),
    ):
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(out, name), expected[name][rows], err_msg=f"{label}: {name}")


def test_another_state_is_another_start(engine: Engine, state: State, wave: Callable[..., JointReference]) -> None:
    """An engine keeps what it made of the latest state."""
    reference = wave(state.joint_reference, n=2)
    expected = copied(engine.rollout(state, reference))
    higher = dataclasses.replace(state, qpos=state.qpos + np.eye(state.qpos.size)[[2]])
    off = engine.rollout(higher, reference).trunk_position[:, 0, 2] - expected["trunk_position"][:, 0, 2]
    np.testing.assert_allclose(off, 1.0, atol=1e-3)
    np.testing.assert_array_equal(engine.rollout(state, reference).trunk_position, expected["trunk_position"])


def test_trunk_velocities_are_the_rates_of_its_pose(
    engine: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    """The integrator moves by velocity * timestep: linear in world axes, angular in the trunk's own."""
    out = engine.rollout(state, wave(state.joint_reference, n=2, steps=150))
    dt = out.timestep
    np.testing.assert_allclose(
        np.diff(out.trunk_position, axis=1) / dt, out.trunk_linear_velocity[:, 1:], rtol=0, atol=1e-9
    )
    assert np.abs(out.trunk_angular_velocity).max() > 1.0
    for i in range(out.n):
        for k in range(1, out.steps):
            turn = np.zeros(3)
            mujoco.mju_subQuat(turn, out.trunk_quaternion[i, k], out.trunk_quaternion[i, k - 1])
            np.testing.assert_allclose(turn / dt, out.trunk_angular_velocity[i, k], rtol=0, atol=1e-6)
    com = out.trunk_com_position()
    np.testing.assert_allclose(
        (com[:, 2:] - com[:, :-2]) / (2 * dt), out.trunk_com_velocity()[:, 1:-1], rtol=0, atol=0.05
    )


def test_the_reference_in_force_is_the_rows_own() -> None:
    """Far from the ground, a step in row 10 of the reference shows in the torque of row 10 and not before."""
    robot = load_robot("hyq2max", actuation="ideal")
    engine = make_engine(robot, Scene(), Physics(), threads=1)
    state = start_state(engine, robot, Scene(), Fall(height=3.0, time=0.0))
    position = np.repeat(state.joint_position[None], 20, axis=1)
    position[:, 10:, 4] += 0.1
    still = np.zeros_like(position)
    torque = engine.rollout(state, JointReference(position, still, 0.002, 20)).joint_torque[0, :, 4]
    assert np.abs(torque[:10]).max() < 1.0
    assert torque[10] == pytest.approx(600 * 0.1, rel=0.05)  # kp * step


def standing(engine: Engine, state: State, steps: int) -> Trajectories:
    hold = np.repeat(state.joint_reference[None], steps, axis=1)
    reference = JointReference(hold, np.zeros_like(hold), engine.physics.timestep, steps)
    return engine.rollout(state, reference, record=(FOOT_CONTACT_FORCE, *engine.bodies))


def test_foot_forces_carry_the_weight(robot: Robot, engine: Engine, state: State) -> None:
    out = standing(engine, state, 400)
    force = out.foot_contact_force
    assert force is not None
    assert force.shape == (1, 400, 4, 3)
    total = force[0, 200:].sum(axis=1).mean(axis=0)
    weight = engine.model.body_mass.sum() * 9.81
    np.testing.assert_allclose(total, [0, 0, weight], rtol=0, atol=0.002 * weight)
    assert (force[..., 2] > 100).all()
    # the robot is all but mirror symmetric, and so are its feet's loads: left is lf, lh; right is rf, rh
    mean = force[0, 200:, :, 2].mean(axis=0)
    np.testing.assert_allclose(mean[[0, 2]], mean[[1, 3]], rtol=0.1)


def test_body_contact_forces_are_those_of_the_scene(robot: Robot, engine: Engine, state: State) -> None:
    out = standing(engine, state, 50)
    feet = out.foot_contact_force
    assert feet is not None
    lower = [engine.model.body(engine.model.geom(foot).bodyid[0]).name for foot in robot.feet]
    for i, body in enumerate(lower):
        np.testing.assert_allclose(out.body_contact_force[body], np.linalg.norm(feet[:, :, i], axis=-1), rtol=1e-9)
    for body in set(engine.bodies) - set(lower):
        np.testing.assert_array_equal(out.body_contact_force[body], 0)
    assert (
        standing(engine, start_state(engine, robot, Scene(), Fall(height=3.0, time=0.0)), 5).foot_contact_force.max()
        == 0
    )  # type: ignore[union-attr]


def test_forces_are_those_of_the_contacts_whatever_was_rolled_out_before(
    robot: Robot, state: State, wave: Callable[..., JointReference]
) -> None:
    """Each contact's force from mj_contactForce, summed by foot; the sensors lag the state by a step, as in mj_step."""
    reference = wave(state.joint_reference, n=6, steps=30)
    engine = make_engine(robot, Scene(), Physics(), threads=2)
    engine.rollout(state, reference[:1])
    engine.rollout(state, reference)
    out = engine.rollout(state, reference[2:3], record=(FOOT_CONTACT_FORCE, *engine.bodies))
    alone = make_engine(robot, Scene(), Physics(), threads=1).rollout(
        state, reference[2:3], record=[FOOT_CONTACT_FORCE]
    )
    engine.rollout(state, reference)
    together = engine.rollout(state, reference, record=[FOOT_CONTACT_FORCE])
    assert out.foot_contact_force is not None
    assert alone.foot_contact_force is not None
    assert together.foot_contact_force is not None
    np.testing.assert_array_equal(out.foot_contact_force, alone.foot_contact_force)
    np.testing.assert_array_equal(out.foot_contact_force[0], together.foot_contact_force[2])

    model = mujoco.MjModel.from_xml_string(engine.xml, engine.assets)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
    feet = [model.geom(foot).id for foot in robot.feet]
    for k, ctrl in enumerate(engine.ctrl(reference[2:3])[0]):
        data.ctrl[:] = ctrl
        mujoco.mj_step(model, data)
        force, on_bodies = np.zeros((4, 3)), {name: np.zeros(3) for name in engine.bodies}
        for i, contact in enumerate(data.contact):
            wrench = np.zeros(6)
            mujoco.mj_contactForce(model, data, i, wrench)
            on_second = contact.frame.reshape(3, 3).T @ wrench[:3]
            bodies = [int(model.geom_bodyid[geom]) for geom in contact.geom]
            for geom, body, other, sign in zip(contact.geom, bodies, bodies[::-1], (-1, 1), strict=True):
                if geom in feet:
                    force[feet.index(geom)] += sign * on_second
                if other == 0:
                    on_bodies[model.body(body).name] += sign * on_second
        np.testing.assert_allclose(out.foot_contact_force[0, k], force, atol=1e-6)
        for name, total in on_bodies.items():
            assert out.body_contact_force[name][0, k] == pytest.approx(np.linalg.norm(total), abs=1e-6)
    assert np.abs(out.foot_contact_force).max() > 100


def test_a_robot_on_its_belly_rests_on_its_trunk(robot: Robot, engine: Engine) -> None:
    folded = {"?f_hfe": 1.5, "?f_kfe": -2.8, "?h_hfe": -1.5, "?h_kfe": 2.8}
    state = start_state(engine, robot, Scene(), Fall(height=0.45, posture=folded, gain=0.02, time=1.5))
    first = standing(engine, state, 1)
    assert first.body_contact_force["trunk"][0, 0] > 50
    assert np.linalg.norm(first.foot_contact_force[0, 0], axis=-1).max() < first.body_contact_force["trunk"][0, 0]  # type: ignore[index]


@pytest.mark.slow
def test_trials_that_break_down_are_marked_and_leave_the_others_alone(
    engine: Engine, state: State, wave: Callable[..., JointReference], capfd: pytest.CaptureFixture[str]
) -> None:
    reference = wave(state.joint_reference, n=6, steps=80)
    expected = copied(engine.rollout(state, reference))
    broken = dataclasses.replace(reference, position=reference.position.copy())
    broken.position[1, 30:] = 1e30  # from the middle on
    broken.position[4] = 1e30
    for record in ((), (FOOT_CONTACT_FORCE, "trunk")):
        out = engine.rollout(state, broken, record=record)
        np.testing.assert_array_equal(out.diverged, [False, True, False, False, True, False])
        ok = ~out.diverged
        for name in ARRAYS:
            value = getattr(out, name)
            assert np.isfinite(value).all(), name
            np.testing.assert_array_equal(value[ok], expected[name][ok])
            np.testing.assert_array_equal(value[1, :30], expected[name][1, :30])
            np.testing.assert_array_equal(value[1, 31:], np.broadcast_to(value[1, 31], value[1, 31:].shape))
    assert capfd.readouterr() == ("", "")  # nothing is printed by the physics
    np.testing.assert_array_equal(engine.rollout(state, reference).diverged, False)  # it does not stick
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(engine.rollout(state, reference), name), expected[name])


@pytest.fixture
def unstable(tmp_path: Path) -> Robot:
    """HyQ2Max with ideal actuators of no torque limit and a stiffness that no time step can follow."""
    folder = tmp_path / "robot"
    shutil.copytree(Path(levade.robots.__file__).parent / "data" / "hyq2max", folder)
    text = (folder / "robot.yaml").read_text()
    head, hydraulic, ideal = text.partition("  ideal:")
    head = head.replace("actuation: hydraulic", "actuation: ideal")
    head = head.replace('torque: {"*_haa": 120, "*_hfe": 245, "*_kfe": 250}', "")
    ideal = ideal.replace("kp: 600\n    kd: 20\n", "kp: 1000000000\n    kd: 0\n", 1)
    (folder / "robot.yaml").write_text(head + hydraulic + ideal)
    return load_robot(folder / "robot.yaml")


def test_absurd_gains_diverge_quietly(
    unstable: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert np.isinf(unstable.limits.torque).all()
    assert unstable.actuation.kp[0] == 1e9
    engine = make_engine(unstable, Scene(), Physics(timestep=0.02, integrator="Euler"), threads=2)
    state = start_state(engine, unstable, Scene(), Settled(time=0.0))
    out = standing(engine, state, 30)
    assert out.diverged.all()
    for name in ARRAYS:
        assert np.isfinite(getattr(out, name)).all(), name
    with pytest.raises(LevadeError, match=r"start: the simulation broke down within 2.0 s; a smaller physics.timestep"):
        start_state(engine, unstable, Scene(), Settled(time=2.0))
    assert capfd.readouterr() == ("", "")
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()


def test_a_model_that_says_so_is_the_one_that_is_simulated(engine: Engine) -> None:
    """What a motion file keeps gives the engine's model back, number by number."""
    again = mujoco.MjModel.from_xml_string(engine.xml, engine.assets)
    for name in (
        "body_mass",
        "body_inertia",
        "body_ipos",
        "jnt_range",
        "geom_friction",
        "geom_size",
        "actuator_gainprm",
    ):
        np.testing.assert_array_equal(getattr(again, name), getattr(engine.model, name))
    assert (again.opt.timestep, again.opt.impratio, again.opt.cone) == (0.002, 10.0, mujoco.mjtCone.mjCONE_ELLIPTIC)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"timestep": 0.0}, r"physics.timestep: 0.0 s is out of range"),
        ({"timestep": 0.05}, r"physics.timestep: 0.05 s is out of range; 0.001 to 0.004 is usual"),
        ({"timestep": float("nan")}, r"physics.timestep: nan"),
        ({"impratio": -1.0}, r"physics.impratio: -1.0 should be a positive number"),
    ],
)
def test_wrong_physics(values: dict[str, float], message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        Physics(**values)  # type: ignore[arg-type]
