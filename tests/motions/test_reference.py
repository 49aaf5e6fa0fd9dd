"""A motion's reference between its rows: the policy itself, ends and all, or cubics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.checks import numerics
from levade.errors import LevadeError
from levade.motions import Motion, RecordedSimulation, ReferenceCurve
from levade.policies import FreePolicy, policy_from_dict, policy_to_dict
from levade.report.series import policy_names
from levade.robots import load_robot
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import available_tasks, load_task
from levade.tasks.policy import make_policy


def test_references_at_half_the_step_are_the_policys_own(moving: Motion) -> None:
    curve = ReferenceCurve.of(moving)
    fine = curve.divided(2)
    assert curve.source == "policy"
    assert fine.timestep == moving.timestep / 2
    assert fine.steps == 2 * moving.reference.steps
    assert np.array_equal(fine.position[:, 1::2], moving.reference.position)
    # between two rows it is what the policy is there, not one of them again
    weights = moving["weights"].reshape(6, 16)
    time = (np.arange(300) + 1) / 300
    kernels = np.exp(-((time[:, None] - np.linspace(0, 1, 16)) ** 2) / 0.02)
    expected = (kernels / kernels.sum(axis=1, keepdims=True)) @ weights[1]
    assert np.allclose(fine.position[0, :300, 1], expected, atol=1e-9)


@pytest.mark.slow
def test_what_keeps_to_a_speed_is_the_same_curve_at_every_step(tmp_path: Path) -> None:
    """At shorter steps the bound is not applied once more: straight between the rows of the motion."""
    changes = ["search.population=4", "search.trials=4", "search.step=0.4", "hold=0.05", "policy.slew=0.3"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    record(objective, solve(objective, seed=3), seed=3).save(tmp_path / "motion.npz")
    motion = Motion.load(tmp_path / "motion.npz")
    recorded, curve = motion.reference, ReferenceCurve.of(motion)
    fine = curve.divided(4)
    assert curve.source == "policy"
    np.testing.assert_allclose(fine.position[:, 3::4], recorded.position, atol=1e-12)
    np.testing.assert_allclose(fine.velocity[:, 3::4], recorded.velocity, atol=1e-9)
    halfway = (recorded.position[0, :149] + recorded.position[0, 1:150]) / 2
    np.testing.assert_allclose(fine.position[0, 5:600:4], halfway, atol=1e-12)
    speed = np.abs(np.diff(recorded.position[0], axis=0)) / motion.timestep
    assert 0.3 * 12 * 0.999 < speed.max() <= 0.3 * 12 * 1.000001  # it is a bound that binds
    broken = {**motion.meta, "policy": {**motion.meta["policy"], "slew": {"speed": [-1.0] * 12, "start": [0.0] * 12}}}
    replace(motion, meta=broken).save(tmp_path / "broken.npz")
    with pytest.raises(LevadeError, match="slew"):
        Motion.load(tmp_path / "broken.npz")


@pytest.mark.slow
def test_a_horizon_of_no_whole_number_of_steps_stays_as_long_as_the_file() -> None:
    """300.9 ms are 150 steps of 2 ms, and would be 301 of 1 ms."""
    changes = ["search.population=4", "search.trials=4", "search.step=0.1", "horizon=0.3009", "hold=0.0509"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    motion = record(objective, solve(objective, seed=0), seed=0)
    curve, recorded = ReferenceCurve.of(motion), motion.reference
    fine = curve.divided(2)
    assert curve.source == "policy"
    assert (fine.steps, fine.horizon_steps) == (2 * recorded.steps, 2 * recorded.horizon_steps)
    assert np.array_equal(fine.position[:, 1::2], recorded.position)
    assert {"half time step", "quarter time step"} <= set(numerics(RecordedSimulation(motion, threads=1)))


@pytest.mark.slow
def test_it_takes_nothing_but_the_file(moving: Motion, changed: Callable[..., Motion]) -> None:
    """Where the robot's description is gone, the policy is in the file; where that is not, cubics come as near."""
    exact = ReferenceCurve.of(moving).divided(4)
    task = {**moving.meta["task"], "robot": {**moving.meta["task"]["robot"], "name": "gone.yaml"}}
    lost = ReferenceCurve.of(changed(moving, {"task": task}))
    assert lost.source == "policy"
    assert np.array_equal(lost.divided(4).position, exact.position)
    motion = changed(moving, {"task": task, "policy": None})
    cubic = ReferenceCurve.of(motion)
    assert cubic.source == "interpolation"
    ours = cubic.divided(4)
    assert 0 < np.abs(ours.position - exact.position).max() < 1e-6
    assert np.abs(ours.velocity - exact.velocity).max() < 1e-3
    np.testing.assert_allclose(ours.position[:, 3::4], moving.reference.position, rtol=0, atol=1e-14)
    assert numerics(RecordedSimulation(motion))["half time step"].reference == "interpolation"


def test_without_the_file_s_policy_the_robot_s_description_gives_it(
    moving: Motion, changed: Callable[..., Motion]
) -> None:
    curve = ReferenceCurve.of(changed(moving, {"policy": None}))
    assert curve.source == "policy"
    assert np.array_equal(curve.divided(3).position, ReferenceCurve.of(moving).divided(3).position)


def test_a_policy_that_is_not_what_was_recorded_is_not_believed(moving: Motion, changed: Callable[..., Motion]) -> None:
    rows = moving["joint_position_reference"].copy()
    rows[70, 3] += 1e-6
    held = moving["joint_position_reference"].copy()
    held[moving.horizon_steps :] += 0.1
    for motion in (
        changed(moving, weights=moving["weights"] + 0.01),
        changed(moving, weights=moving["weights"][:-1]),
        changed(moving, weights=np.full_like(moving["weights"], np.nan)),
        changed(moving, joint_position_reference=rows),
        changed(moving, joint_position_reference=held),
    ):
        assert ReferenceCurve.of(motion).source == "interpolation"


@pytest.mark.slow
@pytest.mark.parametrize("task", available_tasks())
def test_every_built_in_task_has_an_analytic_reference(
    task: str, moving: Motion, changed: Callable[..., Motion]
) -> None:
    """From what the file holds, ends and all: no robot is read, no cubic is drawn. Against a policy of finer steps."""
    chosen = load_task(task)
    robot = load_robot(chosen.robot.name)
    generator = np.random.default_rng(0)
    start = robot.postures["neutral"] + 0.1 * generator.standard_normal(len(robot.joint_names))
    policy = make_policy(chosen, robot, start=start)
    weights = 0.3 * generator.standard_normal(policy.size)
    if isinstance(policy, FreePolicy):
        policy, weights = policy.chosen(weights)
    reference = policy.reference(weights[None])
    timestep, rows = reference.timestep, reference.horizon_steps
    motion = changed(
        moving,
        {
            "task": {"name": task, "robot": {"name": "gone.yaml"}},
            "policy": policy_to_dict(policy),
            "timestep": timestep,
            "horizon": rows * timestep,
            "horizon_steps": rows,
        },
        weights=weights,
        joint_position_reference=reference.position[0],
        joint_velocity_reference=reference.velocity[0],
        joint_position_reference0=start,
        time=np.arange(1, reference.steps + 1) * timestep,
    )
    curve = ReferenceCurve.of(motion)
    assert curve.source == "policy"
    fine = replace(policy, timestep=timestep / 4, horizon=rows * timestep, hold_steps=0).reference(weights[None])
    time = np.arange(4 * rows - 3) * timestep / 4
    position, velocity = curve.in_force(time)
    np.testing.assert_allclose(position, fine.position[0, 3:], rtol=0, atol=1e-12)
    np.testing.assert_allclose(velocity, fine.velocity[0, 3:], rtol=0, atol=1e-9)
    np.testing.assert_array_equal(position[::4], reference.position[0, :rows])
    # the cubics are near, but not the same: that a policy was found is no accident of the comparison
    cubic = replace(curve, policy=None).in_force(time)[0]
    assert np.abs(cubic - position).max() > 1e-12


def test_after_the_horizon_the_reference_stays(moving: Motion) -> None:
    curve, last = ReferenceCurve.of(moving), moving["joint_position_reference"][-1]
    for one in (curve, replace(curve, policy=None)):
        time = moving.horizon + np.array([-1e-4, 0.0, 1e-4, 0.0131, moving.hold])
        position, velocity = one.in_force(time)
        np.testing.assert_array_equal(position, np.tile(last, (5, 1)))
        np.testing.assert_array_equal(velocity, 0.0)


def test_the_cubics_velocity_is_their_derivative(moving: Motion) -> None:
    cubic = replace(ReferenceCurve.of(moving), policy=None)
    time = np.linspace(0.0005, moving.horizon - 0.0005, 400)
    near = [cubic.at(time + step)[0] for step in (-1e-7, 1e-7)]
    np.testing.assert_allclose(cubic.at(time)[1], (near[1] - near[0]) / 2e-7, rtol=0, atol=1e-6)


@pytest.mark.slow
def test_a_policy_is_itself_again_from_its_tables() -> None:
    for task in ("rearing", "self-righting"):
        chosen = load_task(task)
        robot = load_robot(chosen.robot.name)
        policy = make_policy(chosen, robot)
        again = policy_from_dict(policy_to_dict(policy))
        weights = np.random.default_rng(1).standard_normal((2, policy.size))
        for name in ("position", "velocity"):
            ours, theirs = (getattr(one.reference(weights), name) for one in (again, policy))
            np.testing.assert_array_equal(ours, theirs)
        assert (policy.ends is not None) == (task == "self-righting")


@pytest.mark.slow
def test_the_page_names_policies_with_ends_after_their_joints() -> None:
    early = Motion.load(Path(__file__).parent / "data" / "side-recovery-1.npz")
    assert policy_names(early, 6) == [
        f"{legs} {joint}" for legs in ("LF, LH", "RF, RH") for joint in ("HAA", "HFE", "KFE")
    ]
    assert policy_names(early, 5) == [f"policy {number}" for number in range(1, 6)]
