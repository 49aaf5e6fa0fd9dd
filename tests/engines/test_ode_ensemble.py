"""Versions of a model in ODE: each is what a model compiled with its values does there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields

import mujoco
import numpy as np
import pytest

from levade.engines import Engine, Ensemble, Perturbation, Physics, Sample, Settled, State, make_engine
from levade.engines.ode.engine import OdeStage
from levade.engines.ode.library import load
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.robots import Robot
from levade.scenes import Box, Scene
from levade.trajectory import JointReference

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
def state(boxed: Engine) -> State:
    return boxed.start(Settled())


def start(state: State) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return state.qpos, state.qvel, state.act


def only(ensemble: Ensemble, **values: float) -> Sample:
    """One run, nominal but for some numbers."""
    sample = dict(Perturbation().nominal(ensemble.model, ensemble.joints).values)
    return Sample(sample | {name: np.full_like(sample[name], value) for name, value in values.items()})


def held(state: State, steps: int) -> JointReference:
    still = np.broadcast_to(state.joint_reference, (1, steps, state.joint_reference.size))
    return JointReference(still, np.zeros_like(still), PHYSICS.timestep, steps)


def test_the_nominal_version_is_the_engines_own(
    boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(state.joint_position, n=2, steps=40)
    ensemble = boxed.ensemble()
    nominal = ensemble.vary(start(state), Perturbation().nominal(ensemble.model, ensemble.joints, n=2))
    ours, theirs = ensemble.rollout(nominal, reference, feet=True), boxed.rollout(state, reference, feet=True)
    # the start is worked out from where the feet touch, to rounding
    assert np.allclose(ours.trunk_position, theirs.trunk_position, atol=1e-9, rtol=0)
    assert np.allclose(ours.joint_torque, theirs.joint_torque, atol=1e-4, rtol=0)
    assert np.allclose(ours.foot_contact_force, theirs.foot_contact_force, atol=1e-1, rtol=0)  # type: ignore[arg-type]


def test_a_version_is_a_model_compiled_with_its_values(
    boxed: Engine, state: State, wave: Callable[..., JointReference], compile_in: Callable[..., None]
) -> None:
    ensemble, steps, robot = boxed.ensemble(), 40, boxed.robot
    sample = Perturbation(latency=None).draw(ensemble.model, ensemble.joints, n=3, seed=1)
    variations = ensemble.vary(start(state), sample)
    reference = wave(state.joint_position, n=1, steps=steps, scale=0.1)
    ours = ensemble.rollout(variations, reference, feet=True)
    for run in range(3):
        v = {name: values[run] for name, values in sample.values.items()}
        spec = mujoco.MjSpec.from_string(boxed.xml)
        compile_in(spec, v)
        for name in ("ground", "box0"):
            geom, number = spec.geom(name), boxed.model.geom(name).id
            geom.pos, geom.quat = (variations.fields[f"geom_{what}"][run, number].copy() for what in ("pos", "quat"))
        stage = OdeStage(
            spec.to_xml(),
            boxed.assets,
            PHYSICS,
            robot.embodiment,
            threads=1,
        )
        at = (variations.qpos[run], variations.qvel[run], variations.act[run])
        theirs = stage.rollout(at, reference, feet=True)
        assert np.allclose(ours.trunk_position[run], theirs.trunk_position[0], atol=1e-6, rtol=0)
        assert np.allclose(ours.joint_position[run], theirs.joint_position[0], atol=1e-5, rtol=0)
        assert (theirs.foot_contact_force != 0).any()  # type: ignore[union-attr]


def test_the_feet_carry_the_mass(boxed: Engine, state: State) -> None:
    """At rest, weight is all that there is to carry."""
    ensemble, steps = boxed.ensemble(), 300
    for factor in (0.9, 1.1):
        out = ensemble.rollout(ensemble.vary(start(state), only(ensemble, mass=factor)), held(state, steps), feet=True)
        assert out.foot_contact_force is not None
        carried = out.foot_contact_force[0, -100:, :, 2].sum(axis=1).mean()
        weight = factor * float(boxed.model.body_mass.sum()) * -boxed.model.opt.gravity[2]
        assert carried == pytest.approx(weight, rel=0.01)


def test_friction_is_what_slows_the_sliding_robot(boxed: Engine, state: State) -> None:
    """Where all feet slide, the ground takes off momentum by Coulomb's law."""
    ensemble, steps = boxed.ensemble(), 8
    nominal = float(boxed.model.geom("lf_foot").friction[0])
    for factor in (0.4, 0.7):  # more, and the legs jam
        qpos, qvel, act = start(state)
        fast = qvel.copy()
        fast[0] = 3.0
        out = ensemble.rollout(
            ensemble.vary((qpos, fast, act), only(ensemble, friction=factor)), held(state, steps), feet=True
        )
        assert out.foot_contact_force is not None
        force = out.foot_contact_force[0].sum(axis=1)
        assert -force[:, 0].sum() / force[:, 2].sum() == pytest.approx(factor * nominal, rel=1e-3)


@pytest.mark.parametrize("name", [one.name for one in fields(Perturbation)])
def test_every_parameter_changes_the_motion(
    name: str, boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    ensemble, own = boxed.ensemble(), Perturbation()
    corners = own.corners(ensemble.model, ensemble.joints, name, n=2, seed=0)
    reference = wave(state.joint_position, n=1, steps=60, scale=0.6)
    nominal = ensemble.rollout(ensemble.vary(start(state), own.nominal(ensemble.model, ensemble.joints)), reference)
    moved = ensemble.rollout(ensemble.vary(start(state), corners), reference)
    assert not moved.diverged.any()
    apart = np.abs(moved.trunk_position - nominal.trunk_position).max(axis=(1, 2))
    assert (
        apart[np.abs(corners.values[name] - (own.nominal(ensemble.model, 12).values[name])).max(axis=1) > 0] > 1e-7
    ).all()


def test_a_run_depends_on_nothing_but_its_own_values(
    boxed: Engine, state: State, wave: Callable[..., JointReference]
) -> None:
    """Order, company, and whether its worlds were there already."""
    one, two = boxed.ensemble(), boxed.ensemble()
    varied = one.vary(start(state), Perturbation().draw(one.model, one.joints, n=4, seed=7))
    reference = wave(state.joint_position, n=4, steps=30)
    whole = one.rollout(varied, reference)
    some = [2, 0, 2]
    for ensemble in (one, two):
        again = ensemble.rollout(varied[some], reference[some])
        for field in ("trunk_position", "joint_torque"):
            assert np.array_equal(getattr(again, field), getattr(whole, field)[some])
    assert np.array_equal(again.reference.position, reference.position[some])


def test_feedback_is_said_to_have_no_place(boxed: Engine, state: State) -> None:
    ensemble = boxed.ensemble()
    nominal = ensemble.vary(start(state), Perturbation().nominal(ensemble.model, ensemble.joints))
    feedback = Feedback(np.zeros((1, 12, 42)), np.zeros((1, 30)), 0.004, 0.3)
    with pytest.raises(LevadeError, match="feedback: the engine ode has no place for it yet; use the engine mujoco"):
        ensemble.rollout(nominal, held(state, 2), feedback=feedback)
