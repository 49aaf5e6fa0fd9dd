"""The one roll-out: rows of starts, references and models, what is recorded, and what is counted; in every engine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from levade.engines import (
    ENGINES,
    FOOT_CONTACT_FORCE,
    Engine,
    Models,
    MujocoEngine,
    Perturbation,
    Physics,
    Settled,
    State,
    engine_kind,
    make_engine,
    perturbed_models,
    start_state,
)
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.robots import Robot
from levade.scenes import Scene
from levade.trajectory import JointReference

ARRAYS = (
    "joint_position",
    "joint_velocity",
    "joint_torque",
    "trunk_position",
    "trunk_quaternion",
    "foot_contact_force",
)
STEPS = 30


@pytest.fixture(scope="module", params=list(ENGINES))
def any_engine(robot: Robot, request: pytest.FixtureRequest) -> Engine:
    if missing := ENGINES[request.param].missing():
        pytest.skip(missing)
    return make_engine(robot, Scene(), Physics(engine=request.param), threads=2)


@pytest.fixture(scope="module")
def starts(robot: Robot, engine: Engine) -> State:
    """Four places and postures to start from."""
    four = [start_state(engine, robot, Scene(), Settled(x=0.1 * i, time=0.1 * i)) for i in range(1, 4)]
    return State.stacked([*four, start_state(engine, robot, Scene(), Settled("h2m", time=0.2))])


def same(one: object, other: object, rows: list[int]) -> None:
    """Every array of one is the rows of the other's, to the bit."""
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name)[rows], err_msg=name)


def test_a_trial_of_its_own_start_is_the_same_alone_and_in_a_batch(
    any_engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(starts.joint_reference[:1], n=4, steps=STEPS)
    force = [FOOT_CONTACT_FORCE]
    batch = any_engine.rollout(starts, reference, record=force)
    assert len(np.unique(batch.trunk_position[:, -1, 0])) == 4
    for i in range(4):
        same(any_engine.rollout(starts[i], reference[[i]], record=force), batch, [i])
    order = [2, 0, 3, 2]
    same(any_engine.rollout(starts[order], reference[order], record=force), batch, order)
    # one start for all is that start, four times
    repeated = any_engine.rollout(starts[[1] * 4], reference, record=force)
    same(any_engine.rollout(starts[1], reference, record=force), repeated, [0, 1, 2, 3])
    # and so is one reference for all
    shared = any_engine.rollout(starts, reference[[2]], record=force)
    same(any_engine.rollout(starts[3], reference[[2]], record=force), shared, [3])
    np.testing.assert_array_equal(shared.reference.position, np.repeat(reference.position[[2]], 4, axis=0))


def test_one_model_for_all_trials_is_that_model_for_each(
    any_engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    sample = Perturbation().draw(any_engine.model, 12, n=2, seed=4)
    _, models = perturbed_models(any_engine.model, any_engine.layout, sample, starts[0])
    assert models.delay[0] > 0
    reference = replace(wave(starts.joint_reference[:1], n=4, steps=STEPS), before=starts.joint_reference)
    one = any_engine.rollout(starts, reference, models=models[0], record=[FOOT_CONTACT_FORCE])
    four = any_engine.rollout(starts, reference, models=models[[0] * 4], record=[FOOT_CONTACT_FORCE])
    same(one, four, [0, 1, 2, 3])
    alone = any_engine.rollout(starts[2], reference[[2]], models=models[0], record=[FOOT_CONTACT_FORCE])
    same(alone, four, [2])


@pytest.mark.slow
def test_steps_are_counted_in_every_roll_out(
    any_engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(starts.joint_reference[:1], n=4, steps=STEPS)
    sample = Perturbation().draw(any_engine.model, 12, n=3, seed=4)
    varied, models = perturbed_models(any_engine.model, any_engine.layout, sample, starts[0])
    before = any_engine.steps
    any_engine.rollout(starts[0], reference)  # 4 trials of 30 steps
    any_engine.rollout(starts[:3], reference[[0]])  # 3
    any_engine.rollout(varied, reference[[0]], models=models)  # 3
    any_engine.rollout(varied[0], reference, models=models[0], record=["trunk"])  # 4
    with pytest.raises(LevadeError):
        any_engine.rollout(starts, reference[:3])  # none
    assert any_engine.steps - before == (4 + 3 + 3 + 4) * 30


def test_steps_are_counted_where_mujocos_own_arrays_are_recorded(
    robot: Robot, starts: State, wave: Callable[..., JointReference]
) -> None:
    engine = make_engine(robot, Scene(), Physics(), threads=1)
    assert isinstance(engine, MujocoEngine)
    reference = wave(starts.joint_reference[:1], n=2, steps=STEPS)
    out, diverged = engine.states(starts[0], reference, ["qpos", "act"])
    assert engine.steps == 2 * 30
    assert out["act"].shape == (2, 30, engine.model.na)
    assert not diverged.any()
    np.testing.assert_array_equal(out["qpos"][..., :3], engine.rollout(starts[0], reference).trunk_position)


def test_a_nominal_model_under_feedback_that_does_nothing_is_open_loop_to_the_bit(
    engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(starts.joint_reference[:1], n=4, steps=STEPS, scale=0.1)
    idle = Feedback(np.zeros((1, 12, 42)), np.zeros((1, 30)), 0.004, 0.3)
    record = [FOOT_CONTACT_FORCE]
    same(
        engine.rollout(starts, reference, feedback=idle, record=record),
        engine.rollout(starts, reference, record=record),
        [0, 1, 2, 3],
    )


def test_a_version_is_nominal_in_what_only_an_earlier_one_differed_in(
    engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    reference = wave(starts.joint_reference[:1], n=1, steps=STEPS)
    heavy = Models({"body_mass": 1.3 * engine.model.body_mass[None]}, np.zeros(1))
    slick = Models({"geom_friction": 0.1 * engine.model.geom_friction[None]}, np.zeros(1))
    first = engine.rollout(starts[0], reference, models=slick)
    between = engine.rollout(starts[0], reference, models=heavy)
    again = engine.rollout(starts[0], reference, models=slick)
    assert not np.array_equal(first.joint_position, between.joint_position)
    np.testing.assert_array_equal(first.joint_position, again.joint_position)


def test_what_does_not_fit_is_said(any_engine: Engine, starts: State, wave: Callable[..., JointReference]) -> None:
    reference = wave(starts.joint_reference[:1], n=3, steps=2)
    with pytest.raises(LevadeError, match=r"rollout: rows do not fit together \(starts 4, reference 3\); each should"):
        any_engine.rollout(starts, reference)
    with pytest.raises(LevadeError, match=r"record: no body 'trnk' in the model; did you mean trunk\?"):
        any_engine.rollout(starts[0], reference, record=["trnk"])
    with pytest.raises(LevadeError, match=r"record: no body 'foot_force' .*; did you mean foot_contact_force\?"):
        any_engine.rollout(starts[0], reference, record=["foot_force"])
    wrong = Models({"body_mas": np.ones((3, 1))}, np.zeros(3))
    with pytest.raises(LevadeError, match=r"models: no field 'body_mas' in mujoco.MjModel; did you mean body_mass\?"):
        any_engine.rollout(starts[0], reference, models=wrong)
    sample = Perturbation().draw(any_engine.model, 12, n=2, seed=4)
    with pytest.raises(LevadeError, match=r"perturbed models: the start has 4 rows, should have one"):
        perturbed_models(any_engine.model, any_engine.layout, sample, starts)
    with pytest.raises(LevadeError, match=r"state: qvel has the shape \(18,\), should be \(rows, size\)"):
        replace(starts, qvel=starts.qvel[0])


def test_an_engine_of_a_models_text_alone_simulates_the_same(
    robot: Robot, any_engine: Engine, starts: State, wave: Callable[..., JointReference]
) -> None:
    """What a motion file keeps is enough."""
    kind = ENGINES[any_engine.name]
    again = kind.make(any_engine.xml, any_engine.assets, robot.embodiment, any_engine.physics, threads=1)
    reference = wave(starts.joint_reference[:1], n=4, steps=STEPS)
    record = [FOOT_CONTACT_FORCE]
    same(
        again.rollout(starts, reference, record=record),
        any_engine.rollout(starts, reference, record=record),
        [*range(4)],
    )


def test_rows_of_states(starts: State) -> None:
    assert len(starts) == 4
    np.testing.assert_array_equal(starts[-1].qpos, starts.qpos[3:])
    np.testing.assert_array_equal(starts[[2, 2, 0]].act, starts.act[[2, 2, 0]])
    np.testing.assert_array_equal(State.stacked(list(starts)).joint_position, starts.joint_position)


@pytest.mark.parametrize("name", list(ENGINES))
def test_a_row_of_the_table_is_of_its_engine(name: str) -> None:
    kind = ENGINES[name]
    assert issubclass(kind.load(), Engine)
    assert kind.load().name == kind.name == name
    if kind.missing() is None:
        assert {"mujoco", "numpy"} <= set(kind.versions())
    # what is of MuJoCo alone cannot be asked of another engine
    assert hasattr(kind.load(), "states") == (name == "mujoco")


def test_an_engine_that_is_none_is_named() -> None:
    with pytest.raises(LevadeError, match=r"^no engine 'mujco'; did you mean mujoco\?"):
        engine_kind("mujco")
    with pytest.raises(LevadeError, match=r"^physics.engine: no engine 'mujco'; did you mean mujoco\?"):
        Physics(engine="mujco")
