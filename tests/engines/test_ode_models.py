"""Versions of a model in ODE: each is what a model compiled with its values does there."""

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
from levade.engines.ode.engine import OdeEngine
from levade.engines.ode.library import load
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.robots import Robot
from levade.scenes import Box, Scene
from levade.trajectory import JointReference, Trajectories

try:
    load()
except LevadeError as missing:
    pytest.skip(str(missing), allow_module_level=True)

PHYSICS = Physics(engine="ode")
BOXES = (Box(position=(0.0, 0.0, 0.21), size=(0.3, 0.16, 0.42), yaw=0.1),)  # a block below the trunk, 1 cm from it


@pytest.fixture(scope="module")
def boxed(robot: Robot) -> Engine:
    return make_engine(robot, Scene(boxes=BOXES), PHYSICS, threads=1)


@pytest.fixture(scope="module")
def state(robot: Robot, boxed: Engine) -> State:
    return start_state(boxed, robot, Scene(boxes=BOXES), Settled())


def on(engine: Engine, start: State, sample: Sample, reference: JointReference, **options) -> Trajectories:
    """Roll out the versions that a sample stands for."""
    starts, models = perturbed_models(engine.model, engine.layout, sample, start)
    return engine.rollout(starts, reference, models=models, **options)


def nominal(engine: Engine, n: int = 1) -> Sample:
    return Perturbation().nominal(engine.model, 12, n=n)


def only(engine: Engine, **values: float) -> Sample:
    """One run, nominal but for some numbers."""
    sample = dict(nominal(engine).values)
    return Sample(sample | {name: np.full_like(sample[name], value) for name, value in values.items()})


def held(state: State, steps: int) -> JointReference:
    still = np.broadcast_to(state.joint_reference, (1, steps, 12))
    return JointReference(still, np.zeros_like(still), PHYSICS.timestep, steps)


def test_the_nominal_version_is_the_engines_own(
    boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(state.joint_position, n=2, steps=40)
    ours = on(boxed, state, nominal(boxed, 2), reference, record=[FOOT_CONTACT_FORCE])
    theirs = boxed.rollout(state, reference, record=[FOOT_CONTACT_FORCE])
    # the start is worked out from where the feet touch, to rounding
    assert np.allclose(ours.trunk_position, theirs.trunk_position, atol=1e-9, rtol=0)
    assert np.allclose(ours.joint_torque, theirs.joint_torque, atol=1e-4, rtol=0)
    assert np.allclose(ours.foot_contact_force, theirs.foot_contact_force, atol=1e-1, rtol=0)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_version_is_a_model_compiled_with_its_values(
    robot: Robot, boxed: Engine, state: State, wave: Callable[..., JointReference], compile_in: Callable[..., None]
) -> None:
    sample = Perturbation(latency=None).draw(boxed.model, 12, n=3, seed=1)
    starts, models = perturbed_models(boxed.model, boxed.layout, sample, state)
    reference = wave(state.joint_position, n=1, steps=40, scale=0.1)
    ours = boxed.rollout(starts, reference, models=models, record=[FOOT_CONTACT_FORCE])
    for run in range(3):
        v = {name: values[run] for name, values in sample.values.items()}
        spec = mujoco.MjSpec.from_string(boxed.xml)
        compile_in(spec, v)
        for name in ("ground", "box0"):
            geom, number = spec.geom(name), boxed.model.geom(name).id
            geom.pos, geom.quat = (models.fields[f"geom_{what}"][run, number].copy() for what in ("pos", "quat"))
        compiled = OdeEngine(spec.to_xml(), boxed.assets, robot.embodiment, PHYSICS, threads=1)
        theirs = compiled.rollout(starts[run], reference, record=[FOOT_CONTACT_FORCE])
        assert np.allclose(ours.trunk_position[run], theirs.trunk_position[0], atol=1e-6, rtol=0)
        assert np.allclose(ours.joint_position[run], theirs.joint_position[0], atol=1e-5, rtol=0)
        assert (theirs.foot_contact_force != 0).any()  # type: ignore[union-attr]


@pytest.mark.slow
def test_the_feet_carry_the_mass(boxed: Engine, state: State) -> None:
    """At rest, weight is all that there is to carry."""
    for factor in (0.9, 1.1):
        out = on(boxed, state, only(boxed, mass=factor), held(state, 300), record=[FOOT_CONTACT_FORCE])
        assert out.foot_contact_force is not None
        carried = out.foot_contact_force[0, -100:, :, 2].sum(axis=1).mean()
        weight = factor * float(boxed.model.body_mass.sum()) * -boxed.model.opt.gravity[2]
        assert carried == pytest.approx(weight, rel=0.01)


def test_friction_is_what_slows_the_sliding_robot(boxed: Engine, state: State) -> None:
    """Where all feet slide, the ground takes off momentum by Coulomb's law."""
    own = float(boxed.model.geom("lf_foot").friction[0])
    for factor in (0.4, 0.7):  # more, and the legs jam
        fast = replace(state, qvel=state.qvel + 3.0 * np.eye(18)[[0]])
        out = on(boxed, fast, only(boxed, friction=factor), held(state, 8), record=[FOOT_CONTACT_FORCE])
        assert out.foot_contact_force is not None
        force = out.foot_contact_force[0].sum(axis=1)
        assert -force[:, 0].sum() / force[:, 2].sum() == pytest.approx(factor * own, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", [one.name for one in fields(Perturbation)])
def test_every_parameter_changes_the_motion(
    name: str, boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    own = Perturbation()
    corners = own.corners(boxed.model, 12, name, n=2, seed=0)
    reference = wave(state.joint_position, n=1, steps=60, scale=0.6)
    unmoved = on(boxed, state, nominal(boxed), reference)
    moved = on(boxed, state, corners, reference)
    assert not moved.diverged.any()
    apart = np.abs(moved.trunk_position - unmoved.trunk_position).max(axis=(1, 2))
    assert (apart[np.abs(corners.values[name] - nominal(boxed).values[name]).max(axis=1) > 0] > 1e-7).all()


@pytest.mark.slow
def test_a_run_depends_on_nothing_but_its_own_values(
    robot: Robot, boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    """Order, company, and whether its worlds were there already."""
    other = make_engine(robot, Scene(boxes=BOXES), PHYSICS, threads=1)
    sample = Perturbation().draw(boxed.model, 12, n=4, seed=7)
    starts, models = perturbed_models(boxed.model, boxed.layout, sample, state)
    reference = wave(state.joint_position, n=4, steps=30)
    whole = boxed.rollout(starts, reference, models=models)
    some = [2, 0, 2]
    for engine in (boxed, other):
        again = engine.rollout(starts[some], reference[some], models=models[some])
        for field in ("trunk_position", "joint_torque"):
            assert np.array_equal(getattr(again, field), getattr(whole, field)[some])
    assert np.array_equal(again.reference.position, reference.position[some])


def test_trials_on_one_version_are_the_same_together(
    boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    """One model for three trials, each from another start."""
    starts, models = perturbed_models(
        boxed.model, boxed.layout, Perturbation().draw(boxed.model, 12, n=3, seed=2), state
    )
    reference = wave(state.joint_position, n=3, steps=30)
    together = boxed.rollout(starts, reference, models=models[1])
    for i in range(3):
        alone = boxed.rollout(starts[i], reference[[i]], models=models[1])
        assert np.array_equal(alone.trunk_position[0], together.trunk_position[i])
    assert not np.array_equal(together.trunk_position[0], together.trunk_position[1])


def test_feedback_is_said_to_have_no_place(boxed: Engine, state: State) -> None:
    feedback = Feedback(np.zeros((1, 12, 42)), np.zeros((1, 30)), 0.004, 0.3)
    with pytest.raises(LevadeError, match="feedback: the engine ode does not simulate it yet; use the engine mujoco"):
        boxed.rollout(state, held(state, 2), feedback=feedback)
