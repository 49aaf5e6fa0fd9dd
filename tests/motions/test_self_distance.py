"""Distances between a robot's parts in motions: of tasks that ask for them, and of those that did not."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from levade.costs import Criterion
from levade.engines.clearance import clearance_in, distances_at
from levade.exports.as_mjcf import robot_alone
from levade.motions import Motion, RecordedSimulation, replay_in
from levade.motions.simulation import configurations
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

CLEARANCE = 0.03
APART = {"apart": Criterion("self_distance", minimum=CLEARANCE, at="min")}


@pytest.fixture(scope="module")
def measured() -> Motion:
    """As `moving` of conftest.py, of a task that asks for the distance."""
    changes = ["search.population=6", "search.trials=6", "search.step=0.2", "hold=0.05"]
    changes.append(f"success.apart={{quantity: self_distance, minimum: {CLEARANCE}, at: min}}")
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    return record(objective, solve(objective, seed=3), seed=3)


def test_a_motion_whose_task_did_not_ask_can_be_judged_by_it(moving: Motion) -> None:
    """The model that measures is made of the file's; distances are those of the recorded poses."""
    assert clearance_in(moving.compiled()) is None
    replay = replay_in("mujoco", moving, criteria=APART)
    simulation = RecordedSimulation(moving, criteria=APART, threads=1)
    assert clearance_in(simulation.model) == pytest.approx(CLEARANCE)
    least = distances_at(simulation.model, configurations(moving, simulation.model)[1:])
    assert replay.trajectories.self_distance is not None
    assert np.array_equal(replay.trajectories.self_distance[0], least)
    assert replay.errors == {"apart": min(0.0, float(least.min()) - CLEARANCE)}
    nominal = simulation.rollout().self_distance  # of a model with free frames, which agrees to rounding
    assert nominal is not None
    np.testing.assert_allclose(nominal[0], least, atol=1e-6)


def test_the_file_has_the_model_that_measures_and_replays_to_the_bit(measured: Motion) -> None:
    assert clearance_in(measured.compiled()) == pytest.approx(CLEARANCE)
    model = mujoco.MjModel.from_xml_string(measured.model_xml)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = measured["qpos0"], measured["qvel0"], measured["act0"]
    for row, ctrl in zip(measured["joint_position"], measured["ctrl"], strict=True):
        data.ctrl[:] = ctrl
        mujoco.mj_step(model, data)
        assert np.array_equal(data.qpos[measured.addresses(model).joint_qpos], row)
    assert replay_in("mujoco", measured).errors == measured.result.errors


def test_the_robot_alone_has_nothing_of_it(moving: Motion, measured: Motion) -> None:
    one, other = (robot_alone(motion.model_xml, motion.assets, motion.embodiment.feet) for motion in (moving, measured))
    assert one == other
