"""Versions of a model side by side: each is what a model compiled with its values does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace

import mujoco
import numpy as np
import pytest

from levade.engines import (
    FOOT_CONTACT_FORCE,
    Engine,
    Perturbation,
    Physics,
    Sample,
    Settled,
    State,
    make_engine,
    perturbed_models,
    start_state,
)
from levade.engines.models import delayed
from levade.engines.perturbation import PARAMETERS
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Box, Gap, Scene
from levade.trajectory import JointReference, Trajectories

PYRAMIDAL = int(mujoco.mjtCone.mjCONE_PYRAMIDAL)
BOXES = (Box(position=(0.0, 0.0, 0.21), size=(0.3, 0.16, 0.42), yaw=0.1),)  # a block below the trunk, 1 cm from it


@pytest.fixture(scope="module")
def boxed(robot: Robot) -> Engine:
    return make_engine(robot, Scene(boxes=BOXES), Physics(), threads=1)


@pytest.fixture(scope="module")
def start(robot: Robot, boxed: Engine) -> State:
    return start_state(boxed, robot, Scene(boxes=BOXES), Settled())


def on(engine: Engine, start: State, sample: Sample, reference: JointReference, **options) -> Trajectories:
    """Roll out the versions that a sample stands for."""
    starts, models = perturbed_models(engine.model, engine.layout, sample, start)
    return engine.rollout(starts, reference, models=models, **options)


def nominal(engine: Engine, n: int = 1) -> Sample:
    return Perturbation().nominal(engine.model, 12, n=n)


def test_the_nominal_version_is_the_engines_own(
    engine: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(state.joint_position, n=1, steps=60)
    ours = on(engine, state, nominal(engine, 2), reference, record=[FOOT_CONTACT_FORCE])
    theirs = engine.rollout(state, reference, record=[FOOT_CONTACT_FORCE])
    for run in range(2):
        assert np.allclose(ours.trunk_position[run], theirs.trunk_position[0], atol=1e-9, rtol=0)
        assert np.allclose(ours.joint_torque[run], theirs.joint_torque[0], atol=1e-5, rtol=0)
        assert np.allclose(ours.foot_contact_force[run], theirs.foot_contact_force[0], atol=1e-3, rtol=0)  # type: ignore[index]


def test_a_version_is_a_model_compiled_with_its_values(
    boxed: Engine, start: State, wave: Callable[..., JointReference], compile_in: Callable[..., None]
) -> None:
    steps = 60
    everything = Perturbation(latency=None, softness=(0.9, 2.0), cone=(0.0, 1.0)).draw(boxed.model, 12, n=3, seed=1)
    starts, models = perturbed_models(boxed.model, boxed.layout, everything, start)
    reference = wave(start.joint_position, n=1, steps=steps, scale=0.1)
    ours = boxed.rollout(starts, reference, models=models)
    ctrl = boxed.ctrl(reference)[0]
    for run in range(3):
        v = {name: values[run] for name, values in everything.values.items()}
        spec = mujoco.MjSpec.from_string(boxed.xml)
        compile_in(spec, v)
        angle = np.linalg.norm(v["ground_slope"])
        turn, product, turned = np.empty(4), np.empty(4), np.empty(3)
        mujoco.mju_axisAngle2Quat(turn, np.array([*(v["ground_slope"] / angle), 0.0]), angle)
        pivot = np.array([*start.qpos[0, :2], 0.0])
        for name, moved in (("ground", [0.0, 0.0, v["ground_height"][0]]), ("box0", v["obstacle"])):
            geom = spec.geom(name)
            mujoco.mju_rotVecQuat(turned, geom.pos + moved - pivot, turn)
            mujoco.mju_mulQuat(product, turn, boxed.model.geom(name).quat)
            geom.pos, geom.quat = turned + pivot, product.copy()
        model = spec.compile()
        softer = v["softness"][0]
        model.geom_solref[:, 0] *= softer
        model.geom_solimp[:, :2] = 1 - (1 - model.geom_solimp[:, :2]) * softer
        model.opt.cone = [int(boxed.model.opt.cone), PYRAMIDAL][int(v["cone"][0] >= 0.5)]
        assert not np.allclose(model.dof_invweight0, boxed.model.dof_invweight0)
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:], data.act[:] = starts.qpos[run], starts.qvel[run], starts.act[run]
        for k in range(steps):
            data.ctrl[:] = ctrl[k]
            mujoco.mj_step(model, data)
        assert data.ncon > 1
        assert np.allclose(ours.trunk_position[run, -1], data.qpos[:3], atol=1e-7, rtol=0)
        assert np.allclose(ours.joint_position[run, -1], data.qpos[boxed.layout.joint_qpos], atol=1e-7, rtol=0)


def test_a_run_depends_on_nothing_but_its_own_values(
    robot: Robot, boxed: Engine, start: State, wave: Callable[..., JointReference]
) -> None:
    other = make_engine(robot, Scene(boxes=BOXES), Physics(), threads=3)
    many, few = (Perturbation().draw(boxed.model, 12, n=n, seed=7) for n in (9, 4))
    for name in many.values:
        assert np.array_equal(many.values[name][:4], few.values[name])
    reference = wave(start.joint_position, n=1, steps=40)
    starts, models = perturbed_models(boxed.model, boxed.layout, many, start)
    whole = boxed.rollout(starts, reference, models=models).trunk_position
    part = on(other, start, few, reference).trunk_position
    assert np.array_equal(whole[:4], part)
    again = boxed.rollout(starts[[5, 2]], reference, models=models[[5, 2]]).trunk_position
    assert np.array_equal(again, whole[[5, 2]])


@pytest.mark.parametrize(("late", "ends"), [("softness", (0.5, 2.0)), ("cone", (0.0, 1.0))])
def test_what_was_added_later_leaves_the_other_numbers_as_they_are(
    late: str, ends: tuple[float, float], boxed: Engine
) -> None:
    for draw in (Perturbation.draw, Perturbation.spread):
        without, other = (
            draw(one, boxed.model, 12, n=5, seed=3)
            for one in (Perturbation(), Perturbation(**{late: ends}))  # type: ignore[arg-type]
        )
        for name in without.values:
            assert np.array_equal(without.values[name], other.values[name]) == (name != late), name
        assert len(np.unique(other.values[late])) == 5


@pytest.mark.parametrize("name", [one.name for one in fields(Perturbation)])
def test_every_parameter_changes_the_motion_and_its_corners_are_the_ends_of_its_range(
    name: str, boxed: Engine, start: State, wave: Callable[..., JointReference]
) -> None:
    own = Perturbation(softness=(0.9, 2.0), cone=(0.0, 1.0))
    corners = own.corners(boxed.model, 12, name, n=4, seed=0)
    ends = getattr(own, name)
    assert set(np.unique(corners.values[name])) == set(ends)
    reference = wave(start.joint_position, n=1, steps=80, scale=0.6)
    unmoved = on(boxed, start, nominal(boxed), reference)
    moved = on(boxed, start, corners, reference)
    assert not moved.diverged.any()
    apart = np.abs(moved.trunk_position - unmoved.trunk_position).max(axis=(1, 2))
    assert (apart[~(np.isclose(corners.values[name], nominal_of(name)).all(axis=1))] > 1e-7).all()


def nominal_of(name: str) -> float:
    return PARAMETERS[name].nominal


@pytest.mark.slow
def test_the_robot_starts_on_the_ground_whatever_is_perturbed(robot: Robot, boxed: Engine, start: State) -> None:
    sample = Perturbation(obstacle=None).draw(boxed.model, 12, n=40, seed=5)
    starts, models = perturbed_models(boxed.model, boxed.layout, sample, start)
    gaps = []
    for run in range(-1, 40):
        model, data = mujoco.MjModel.from_xml_string(boxed.xml), mujoco.MjData(boxed.model)
        if run >= 0:
            model.geom_sameframe[:] = 0
            model.geom_pos[:], model.geom_quat[:] = (models.fields[f"geom_{what}"][run] for what in ("pos", "quat"))
        data.qpos[:] = starts.qpos[run] if run >= 0 else start.qpos[0]
        mujoco.mj_forward(model, data)
        ground = model.geom("ground").id
        feet = [model.geom(foot).id for foot in robot.feet]
        gaps.append([mujoco.mj_geomDistance(model, data, foot, ground, 0.2, None) for foot in feet])
    before, after = np.array(gaps[0]), np.array(gaps[1:])
    lowest = (after - before).min(axis=1)
    assert np.abs(lowest).max() < 2e-4  # one foot as deep in the ground as at the start, none deeper
    assert (after - before).max() < 0.03
    assert np.mean(after - before) < 0.012


def test_a_perturbed_joint_alone_leaves_the_feet_on_the_ground(robot: Robot, boxed: Engine, start: State) -> None:
    """With one joint off, the trunk can follow in height, roll and pitch: what is left is the twist of four feet."""
    values = dict(nominal(boxed).values)
    for leg in range(4):  # every thigh by the same angle, so that all feet rise by about the same
        values["start_joint"][0, 3 * leg + 1] = 0.03 * (1 if leg < 2 else -1)
    starts, _ = perturbed_models(boxed.model, boxed.layout, Sample(values), start)
    data = mujoco.MjData(boxed.model)
    data.qpos[:] = starts.qpos[0]
    mujoco.mj_kinematics(boxed.model, data)
    moved = np.array([data.geom(foot).xpos[2] for foot in robot.feet])
    data.qpos[:] = start.qpos[0]
    mujoco.mj_kinematics(boxed.model, data)
    before = np.array([data.geom(foot).xpos[2] for foot in robot.feet])
    assert np.abs(moved - before).max() < 1e-3
    assert not np.allclose(starts.qpos[0, :7], start.qpos[0, :7], atol=3e-4)


def test_a_late_reference_is_the_reference_of_earlier() -> None:
    timestep, steps = 0.002, 50
    time = np.arange(1, steps + 1) * timestep
    line = np.stack([3.0 * time, -time], axis=-1)[None]
    reference = JointReference(line, np.broadcast_to([3.0, -1.0], line.shape).copy(), timestep, steps)
    delay = np.array([0.0, 0.002, 0.0033, 0.5])
    late = delayed(reference, delay)
    expected = np.maximum(time - delay[:, None], timestep)[..., None] * np.array([3.0, -1.0])
    assert np.allclose(late.position, expected, atol=1e-12)
    assert np.array_equal(late.position[1, 1:], line[0, :-1])
    assert np.array_equal(late.velocity[1, 1:], reference.velocity[0, :-1])
    assert (late.velocity[3] == 0).all()
    assert np.allclose(late.velocity[2, 10], [3.0, -1.0])


def test_until_a_late_reference_comes_the_joints_are_told_what_they_were_before(
    boxed: Engine, start: State, wave: Callable[..., JointReference]
) -> None:
    """A reference that jumps by 0.3 rad, late by two steps: as a loop that holds the start for two steps."""
    steps, told = 40, start.joint_reference[0]
    reference = wave(told + 0.3, n=1, steps=steps, scale=0.1)
    values = dict(nominal(boxed).values) | {"latency": np.array([[0.004]])}
    late = replace(reference, before=told)
    ours = on(boxed, start, Sample(values), late)
    data = mujoco.MjData(boxed.model)
    data.qpos[:], data.qvel[:], data.act[:] = start.qpos[0], start.qvel[0], start.act[0]
    ctrl = boxed.ctrl(reference)[0]
    before = ctrl[0].copy()
    before[boxed.layout.ctrl_position], before[boxed.layout.ctrl_velocity] = told, 0.0
    for k in range(steps):
        data.ctrl[:] = before if k < 2 else ctrl[k - 2]
        mujoco.mj_step(boxed.model, data)
    np.testing.assert_allclose(ours.joint_position[0, -1], data.qpos[boxed.layout.joint_qpos], atol=1e-9)
    unknown = on(boxed, start, Sample(values), reference)
    assert np.abs(unknown.joint_position[0] - ours.joint_position[0]).max() > 0.01


def test_ground_between_gaps_rises_as_ground_and_is_no_obstacle(robot: Robot) -> None:
    scene = Scene(gaps=(Gap(1.0, 0.5, depth=0.4),))
    engine = make_engine(robot, scene, Physics(), threads=1)
    state, values = start_state(engine, robot, scene, Settled()), dict(nominal(engine).values)
    assert values["obstacle"].shape == (1, 0)
    raised = Sample(values | {"ground_height": np.array([[0.02]])})
    starts, models = perturbed_models(engine.model, engine.layout, raised, state)
    names = [engine.model.geom(i).name for i in range(engine.model.ngeom) if engine.model.geom_bodyid[i] == 0]
    assert set(names) == {"ground", "platform0", "platform1"}
    for name in names:
        geom = engine.model.geom(name)
        np.testing.assert_allclose(models.fields["geom_pos"][0, geom.id] - geom.pos, [0, 0, 0.02], atol=1e-12)
    assert starts.qpos[0, 2] == pytest.approx(state.qpos[0, 2] + 0.02, abs=1e-4)


def test_ranges_that_make_no_sense_are_refused() -> None:
    with pytest.raises(LevadeError, match=r"perturb.friction: -0.1 is too low; 0.01 or more, 1 is nominal"):
        Perturbation(friction=(-0.1, 1.0))
    with pytest.raises(LevadeError, match=r"perturb.mass: \[1.2, 0.8\] should be \[lowest, highest\]"):
        Perturbation(mass=(1.2, 0.8))
    with pytest.raises(LevadeError, match="latency"):
        Perturbation(latency=(-0.001, 0.0))
