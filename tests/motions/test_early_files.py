"""Files of layout 1, as levade 0.1 wrote them, go on loading; ``data`` holds two.

side-recovery-1: 12 trials of a robot that rolls, horizon 0.5 s, with a policy that departs and settles.
rearing-robust-stabilised-1: 53 trials of a robust search, with an invented stabiliser at 25 Hz.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from levade.checks import check
from levade.motions import SCHEMA, Motion, RecordedSimulation, ReferenceCurve, replay_in, run_trials
from levade.rotations import rotate
from levade.tasks import load_task

DATA = Path(__file__).parent / "data"
FILES = sorted(DATA.glob("*-1.npz"), key=lambda path: path.stem)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_an_early_file_is_one_of_this_layout(path: Path, tmp_path: Path) -> None:
    motion = Motion.load(path)
    with np.load(path) as plain:
        assert json.loads(str(plain["meta"]))["schema"] == 1
        for name in set(motion.arrays) - {"trunk_angular_velocity"}:
            np.testing.assert_array_equal(motion[name], plain[name])
        world = rotate(motion["trunk_quaternion"], motion["trunk_angular_velocity"])
        np.testing.assert_allclose(world, plain["trunk_angular_velocity"], rtol=0, atol=1e-12)
    assert motion.provenance.schema == SCHEMA
    motion.save(tmp_path / "again.npz")
    again = Motion.load(tmp_path / "again.npz")
    assert again.meta == motion.meta
    for name in motion.arrays:
        np.testing.assert_array_equal(again[name], motion[name])


def test_its_numbers_are_those_that_were_written() -> None:
    side, robust = (Motion.load(DATA / f"{name}-1.npz") for name in ("side-recovery", "rearing-robust-stabilised"))
    assert repr(side) == ("Motion(side-recovery on hyq2max: no success, T = 0.5 s and 0.02 s of hold, 12 trials)")
    assert (side.result.trials, side.result.success, side.result.diverged) == (12, False, False)
    assert side.result.errors == pytest.approx({"upright": 1.26046, "height": -0.21621, "still": 0.54213}, abs=1e-5)
    assert side.result.values == {}
    assert not side.meets("upright")
    assert side.feedback is None
    assert side.task.policy.depart == load_task("side-recovery").policy.depart
    assert robust.task.robust is not None
    feedback = robust.feedback
    assert feedback is not None
    assert (feedback.gain.shape, feedback.period, feedback.bound) == ((8, 12, 42), 0.04, 0.3)
    assert robust.stabiliser is not None
    assert robust.stabiliser["runs"] == 96


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_it_is_simulated_as_it_was_then(path: Path) -> None:
    """On another processor, or by another MuJoCo, not to the bit: within 1 mm and 0.05 rad/s for 50 ms."""
    motion = Motion.load(path)
    replay = replay_in("mujoco", motion).trajectories
    np.testing.assert_allclose(replay.trunk_position[0, :25], motion["trunk_position"][:25], rtol=0, atol=1e-3)
    turning, recorded = replay.trunk_angular_velocity[0, :25], motion["trunk_angular_velocity"][:25]
    np.testing.assert_allclose(turning, recorded, rtol=0, atol=0.05)
    simulation = RecordedSimulation(motion, threads=1)
    trials = run_trials(simulation, simulation.nominal, feedback=motion.feedback)
    assert len(trials) == 1
    assert trials.errors.keys() == motion.result.errors.keys()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_its_policy_comes_from_the_task_and_the_robot(path: Path) -> None:
    motion = Motion.load(path)
    assert motion.policy is None
    curve = ReferenceCurve.of(motion)
    assert curve.source == "policy"
    assert curve.policy is not None
    assert (curve.policy.ends is not None) == (motion.task_name == "side-recovery")


def test_its_embodiment_is_the_robots() -> None:
    """Limits and legs from the file; the lines of the actuators, which it lacks, from its model."""
    limits = Motion.load(FILES[0]).embodiment.limits
    assert limits.stall_torque is not None
    assert limits.no_load_speed is not None
    assert np.isfinite(limits.stall_torque).all()
    assert (limits.stall_torque > limits.torque * 0.999).all()


@pytest.mark.slow
def test_it_can_be_checked() -> None:
    certificate = check(Motion.load(DATA / "side-recovery-1.npz"), runs=3)
    assert certificate.numerics["half time step"].reference == "policy"
    assert certificate.numerics["as recorded"].apart["position_at_horizon"] < 0.1
    assert not certificate.passed
