"""Stabilised motions, against loops over MuJoCo that know nothing of levade's."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.checks import perturbed
from levade.engines import Perturbation, perturbed_models
from levade.errors import LevadeError
from levade.exports import export
from levade.exports.player import Motion as Played
from levade.exports.player import Stopped, play
from levade.motions import Motion, RecordedSimulation
from levade.regulators import linearise
from levade.regulators.linear import state_of
from levade.stabilisers import Stabilised, stabilise

from .conftest import PUSHED

# all of one motion and the stabiliser found for it: see conftest.py
pytestmark = [pytest.mark.slow, pytest.mark.golden]

NONE = dict.fromkeys(one.name for one in fields(Perturbation))


def sense(data: mujoco.MjData) -> np.ndarray:
    """Up and angular velocity in trunk axes, joint angles and speeds; MuJoCo's own rotation."""
    up, inverse = np.zeros(3), np.zeros(4)
    mujoco.mju_negQuat(inverse, data.qpos[3:7])
    mujoco.mju_rotVecQuat(up, np.array([0.0, 0.0, 1.0]), inverse)
    return np.concatenate([up, data.qvel[3:6], data.qpos[7:], data.qvel[6:]])


def loop(motion: Motion, push: np.ndarray, *, clamp: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """qpos (steps, nq) and corrections (steps, joints) of a motion whose start is pushed: qvel is changed by so much.

    clamp: whether a reference that is beyond the joints' limits by itself is brought back, too, as the player does.
    """
    model = mujoco.MjModel.from_xml_string(motion.model_xml, dict(motion.assets))
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = motion["qpos0"], motion["qvel0"] + push, motion["act0"]
    gain, reference = motion["feedback_gain"], motion["feedback_reference"]
    about = motion.meta["feedback"]
    lower, upper = (np.array(motion.meta["limits"][name]) for name in ("lower", "upper"))
    last = due = np.zeros(gain.shape[1])
    qpos, corrections = [], []
    for k, ctrl in enumerate(motion["ctrl"]):
        if k % about["period_steps"] == 0:
            tick = k // about["period_steps"]
            last = due
            off = np.concatenate([sense(data) - reference[min(tick, len(reference) - 1)], last])
            due = np.clip(gain[min(tick, len(gain) - 1)] @ off, -about["bound"], about["bound"])
        told = np.clip(ctrl[0::2], lower, upper) if clamp else ctrl[0::2]
        data.ctrl[0::2] = np.clip(told + last, np.minimum(told, lower), np.maximum(told, upper))
        data.ctrl[1::2] = ctrl[1::2]
        mujoco.mj_step(model, data)
        qpos.append(data.qpos.copy())
        corrections.append(last)
    return np.array(qpos), np.array(corrections)


def test_it_holds_what_open_loop_does_not(found: Stabilised) -> None:
    """Of 100 other runs that are pushed hard at the start."""
    assert found.design is not None
    simulation = RecordedSimulation(found.motion)
    without = perturbed(simulation, PUSHED, runs=100, seed=0)
    within = perturbed(simulation, PUSHED, runs=100, seed=0, feedback=found.motion.feedback)
    assert without.high < within.low
    assert within.share > without.share + 0.15


def test_undisturbed_it_does_nothing_at_all(found: Stabilised, rearing: Motion) -> None:
    motion = found.motion
    qpos, corrections = loop(motion, np.zeros(18))
    assert not corrections.any()
    assert np.array_equal(qpos[:, 7:], motion["joint_position"])
    assert np.array_equal(qpos[:, 3:7], motion["trunk_quaternion"])
    assert all(np.array_equal(motion[name], rearing[name]) for name in rearing.arrays)


def test_the_batch_is_the_loop(found: Stabilised) -> None:
    """Three pushed runs, one of them late by nothing; within rounding, which the robot's falling makes larger."""
    motion, simulation = found.motion, RecordedSimulation(found.motion)
    engine = simulation.engine
    start = Perturbation(**{**NONE, "start_rate": (-0.2, 0.2)})  # type: ignore[arg-type]
    sample = start.draw(engine.model, simulation.joints, n=3, seed=5)
    starts, models = perturbed_models(engine.model, engine.layout, sample, simulation.start)
    batch = engine.rollout(starts, simulation.reference, models=models, feedback=motion.feedback)
    for run in range(3):
        qpos, corrections = loop(motion, starts.qvel[run] - motion["qvel0"])
        assert np.abs(corrections).max() > 0.01
        assert np.allclose(batch.joint_position[run], qpos[:, 7:], rtol=0, atol=1e-5)
        assert np.allclose(batch.trunk_position[run], qpos[:, :3], rtol=0, atol=1e-5)
    alone = engine.rollout(starts[1], simulation.reference, models=models[1], feedback=motion.feedback)
    assert np.array_equal(alone.joint_position[0], batch.joint_position[1])


def test_threads_and_calls_do_not_change_it(rearing: Motion, found: Stabilised) -> None:
    again = stabilise(rearing, runs=32, seed=0, perturbation=PUSHED, threads=2)
    assert again.design == found.design
    assert again.motion["feedback_gain"].tobytes() == found.motion["feedback_gain"].tobytes()
    simulation = [RecordedSimulation(found.motion, threads=threads) for threads in (1, 2)]
    one, two = (
        perturbed(s, Perturbation(), runs=70, seed=3, feedback=found.motion.feedback).to_json() for s in simulation
    )
    assert one == two


def test_the_linear_model_foretells_small_deviations(rearing: Motion) -> None:
    """Of everything at once, in the air, from the first tick to the next; to 5 %."""
    simulation = RecordedSimulation(rearing)
    qpos, qvel, act = (part[0].copy() for part in (simulation.start.qpos, simulation.start.qvel, simulation.start.act))
    qpos[2] += 1.0
    start = simulation.layout.state(qpos, qvel, act)
    linear = linearise(simulation.model, simulation.layout, start, simulation.reference, period=2)
    generator = np.random.default_rng(2)
    before, after = [], []
    for size in (0.0, 1.0):
        data = mujoco.MjData(simulation.model)
        data.qpos[:], data.qvel[:], data.act[:] = qpos, qvel + size * 0.1 * generator.standard_normal(18), act
        data.qpos[7:] += size * 0.01 * generator.standard_normal(12)
        before.append(state_of(simulation.layout, data.qpos, data.qvel, data.act))
        for k in range(2):
            data.ctrl[:] = rearing["ctrl"][k]
            data.ctrl[0::2] += size * 0.005
            mujoco.mj_step(simulation.model, data)
        after.append(state_of(simulation.layout, data.qpos, data.qvel, data.act))
    change = after[1] - after[0]
    expected = linear.a[0] @ (before[1] - before[0]) + linear.b[0] @ np.full(12, 0.005)
    for part in (slice(0, 3), slice(3, 6), slice(6, 18), slice(18, 30), slice(30, 34), slice(34, None)):
        assert np.linalg.norm(change[part] - expected[part]) < 0.05 * np.linalg.norm(change[part])


def test_the_file_keeps_it(found: Stabilised, tmp_path: Path) -> None:
    path = tmp_path / "motion.npz"
    found.motion.save(path)
    loaded = Motion.load(path)
    assert loaded.feedback is not None
    assert np.array_equal(loaded.feedback.gain, found.motion["feedback_gain"])
    assert loaded.meta["feedback"]["sensed"][0] == "up/x"
    assert len(loaded.meta["feedback"]["sensed"]) == loaded["feedback_reference"].shape[1] == 30
    damaged = dict(np.load(path))
    np.savez(tmp_path / "damaged.npz", **{k: v for k, v in damaged.items() if k != "feedback_gain"})
    with pytest.raises(LevadeError, match="its stabiliser lacks feedback_gain; stabilise the motion again"):
        Motion.load(tmp_path / "damaged.npz")
    np.savez(tmp_path / "damaged.npz", **{**damaged, "feedback_gain": damaged["feedback_gain"][:, :, 1:]})
    with pytest.raises(LevadeError, match=r"feedback_gain has the shape .* columns=42"):
        Motion.load(tmp_path / "damaged.npz")


class Pushed:
    """The motion's robot, pushed at the start, one physics step a command."""

    def __init__(self, motion: Motion, push: np.ndarray) -> None:
        self.model = mujoco.MjModel.from_xml_string(motion.model_xml, dict(motion.assets))
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:], self.data.act[:] = motion["qpos0"], motion["act0"]
        self.data.qvel[:] = motion["qvel0"] + push
        self.qpos: list[np.ndarray] = []

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos[7:].copy(), self.data.qvel[6:].copy()

    def write(self, position, velocity, torque, kp, kd) -> None:
        self.data.ctrl[0::2], self.data.ctrl[1::2] = position, velocity
        mujoco.mj_step(self.model, self.data)
        self.qpos.append(self.data.qpos.copy())


class Sensing(Pushed):
    def read_trunk(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos[3:7].copy(), self.data.qvel[3:6].copy()


@pytest.mark.parametrize("to", ["csv", "json"])
@pytest.mark.parametrize("clamp", [True, False])
def test_the_player_does_the_same(found: Stabilised, tmp_path: Path, to: str, clamp: bool) -> None:
    export(found.motion, to, tmp_path, reference="commanded")
    played = Played.load(tmp_path / f"motion.{to}")
    push = np.zeros(18)
    push[3:6] = 0.1, -0.2, 0.1
    robot = Sensing(found.motion, push)
    play(played, robot, ramp=0.0, tolerance=1.0, clamp=clamp, wait=lambda instant: 0.0)
    qpos, corrections = loop(found.motion, push, clamp=clamp)
    assert np.abs(corrections).max() > 0.01
    assert np.allclose(np.array(robot.qpos)[: len(qpos)], qpos, rtol=0, atol=1e-6)


def test_the_player_wants_a_trunk_or_to_be_told(found: Stabilised, tmp_path: Path) -> None:
    export(found.motion, "csv", tmp_path)
    played = Played.load(tmp_path / "motion.csv")
    with pytest.raises(Stopped, match="no read_trunk; add it, or play with --no-feedback"):
        play(played, Pushed(found.motion, np.zeros(18)), ramp=0.0, wait=lambda instant: 0.0)
    play(played, Pushed(found.motion, np.zeros(18)), ramp=0.0, tolerance=2.0, feedback=False, wait=lambda instant: 0.0)


def test_what_does_not_fit_is_left_out_and_said(found: Stabilised, tmp_path: Path) -> None:
    for options in ({"rate": 333.0}, {"kp": 100.0}):
        done = export(found.motion, "csv", tmp_path / str(options), **options)  # type: ignore[arg-type]
        assert any("the stabiliser is left out" in note for note in done.notes)
        assert Played.load(tmp_path / str(options) / "motion.csv").feedback is None
    export(found.motion, "csv", tmp_path / "again")
    assert (tmp_path / "again" / "feedback.npz").exists()
    export(found.motion, "json", tmp_path / "again", kp=100.0)
    assert (tmp_path / "again" / "feedback.npz").exists()  # motion.csv's
    export(found.motion, "csv", tmp_path / "again", kp=100.0)
    assert not (tmp_path / "again" / "feedback.npz").exists()
    ordered = export(found.motion, "unitree", tmp_path / "unitree")
    assert not any("stabiliser" in note for note in ordered.notes)
    feedback = Played.load(tmp_path / "unitree" / "motion.csv").feedback
    assert feedback is not None
    order = [found.motion["joint_names"].tolist().index(j) for j in _motors(found.motion)]
    assert np.array_equal(feedback.gain[:, :, :6], found.motion["feedback_gain"][:, order, :6])
    assert np.array_equal(feedback.reference[:, 6:18], found.motion["feedback_reference"][:, 6:18][:, order])


def _motors(motion: Motion) -> list[str]:
    from levade.exports.as_unitree import motors

    return list(motors(motion).values())


def test_numbers_that_make_no_sense_are_said(rearing: Motion) -> None:
    for options, message in (
        ({"rate": 1e6}, "rate: 1e[+]06 should be 1 to 500 Hz"),
        ({"rate": 1.0}, "rate: 1 Hz has no measurement within the motion's 0.3 s; should be 3.33 Hz at least"),
        ({"bound": 0.0}, "bound: 0 should be more than 0"),
        ({"runs": 1}, "runs: 1 should be 8 to 100000"),
    ):
        with pytest.raises(LevadeError, match=message):
            stabilise(rearing, **options)  # type: ignore[arg-type]
