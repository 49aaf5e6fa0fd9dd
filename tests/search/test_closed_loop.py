"""Feedback in the search: what is judged is the closed loop, and its gains follow the best motion."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from levade.arrays import Array
from levade.engines import MujocoEngine, Perturbation, State, perturbed_models
from levade.engines.ode.library import load
from levade.errors import LevadeError
from levade.feedback import SensorErrors, sensed
from levade.motions import Motion, RecordedSimulation
from levade.motions.trials import run_trials
from levade.search import Evaluation, Generation, Objective, Stopped, Trials, make_objective, solve
from levade.search.closed_loop import _SENSING as SENSING
from levade.search.evaluation import Gains
from levade.search.objective import _TAG as TAG
from levade.search.recording import record
from levade.search.run import resume, run
from levade.tasks import HorizonRange, Regulation, Task, load_task

CHANGES = [
    *("search.optimizer=cma", "search.population=6", "horizon=0.06", "hold=0.02", "search.polish=null"),
    "success={pitch: {target: 0, tolerance: 0.2}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
    "stages=[{name: nominal, robust: false, trials: 12, hold: false}, {name: robust, hold: 0.01}]",
    "robust={samples: 2, measure: mean, redraw: generation, validation: 5}",
    "search.trials=150",
]
FEEDBACK = Regulation(rate=100.0, every=2, runs=8, bound=0.2)


def task(**feedback: float) -> Task:
    return replace(load_task("rearing", changes=CHANGES), feedback=replace(FEEDBACK, **feedback))


@pytest.fixture(scope="module")
def objective() -> Objective:
    return make_objective(task(), threads=1)


@pytest.fixture(scope="module")
def found(objective: Objective) -> tuple[list[Generation], Motion]:
    seen: list[Generation] = []
    solution = solve(objective, seed=2, observe=lambda generation: seen.append(generation))
    return seen, record(objective, solution, seed=2)


def by_hand(objective: Objective, trials: Trials, sensors: SensorErrors) -> Evaluation:
    """Each roll-out on its own: the candidate on the nominal model, and the perturbed model held to what it senses there."""
    engine, policy, start, robust = objective.engine, objective.policy, objective.state, objective.task.robust
    assert isinstance(engine, MujocoEngine)
    assert robust is not None
    assert trials.gains is not None
    assert trials.pairs is not None
    assert trials.draw is not None
    n = robust.samples if trials.draw else robust.fixed
    joints = engine.embodiment.joints
    sample = robust.perturb.spread(engine.model, joints, n=n, seed=(trials.seed, trials.draw, TAG))
    starts, models = perturbed_models(engine.model, engine.layout, sample, start)
    gains = objective.regulator(trials.gains, seed=trials.seed)
    period = gains.steps(engine.physics.timestep)
    ticks = -(-(objective.task.horizon_steps + objective.task.hold_steps) // period)
    errors = sensors.draw(n, ticks, joints, seed=(trials.seed, trials.draw, SENSING))
    parts = []
    for candidate, model in zip(*trials.pairs, strict=True):
        reference = policy.reference(trials.weights[candidate : candidate + 1], hold_steps=trials.hold_steps)
        arrays = engine.states(start, reference, ["qpos", "qvel"])[0]
        feedback = gains.along(on_the_way(engine, start, arrays, period))
        reference = replace(reference, before=start.joint_reference[0])
        one = slice(int(model), int(model) + 1)
        trajectories = engine.rollout(
            starts[one], reference, models=models[one], feedback=feedback, sensor_errors=errors[one]
        )
        parts.append(objective.judge(trajectories, trials.hold_steps))
    terms = {name: np.concatenate([part.terms[name] for part in parts]) for name in parts[0].terms}
    return replace(parts[0], terms=terms, success=np.concatenate([part.success for part in parts]))


def on_the_way(engine: MujocoEngine, start: State, arrays: dict[str, Array], period: int) -> Array:
    """What is sensed at the start, and after each period."""
    layout = engine.layout
    rows = [(start.qpos[0], start.qvel[0])]
    rows += [
        (arrays["qpos"][0, k], arrays["qvel"][0, k]) for k in range(period - 1, arrays["qpos"].shape[1] - 1, period)
    ]
    return np.array(
        [
            sensed(
                qpos[layout.trunk_quaternion],
                qvel[layout.trunk_angular_velocity],
                qpos[layout.joint_qpos],
                qvel[layout.joint_qvel],
            )
            for qpos, qvel in rows
        ]
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sensors", "design"), [(SensorErrors(), 0), (SensorErrors(0.1, 0.0, 0.02, 0.3, 0.0), 1)], ids=["usual", "other"]
)
def test_a_batch_is_its_roll_outs_one_by_one(sensors: SensorErrors, design: int) -> None:
    objective = make_objective(replace(task(), feedback=replace(FEEDBACK, sensors=sensors)), threads=1)
    weights = objective.space.mean + 0.05 * np.random.default_rng(3).standard_normal((3, objective.space.size))
    pairs = (np.array([0, 0, 1, 2, 2]), np.array([0, 1, 1, 0, 1]))
    trials = Trials(weights, 5, seed=7, draw=4, pairs=pairs, gains=Gains(weights[1], design=design))
    found, expected = objective.evaluate(trials), by_hand(objective, trials, sensors)
    for name, values in found.terms.items():
        np.testing.assert_array_equal(values, expected.terms[name])
    np.testing.assert_array_equal(found.success, expected.success)
    without = objective.evaluate(replace(trials, gains=None))
    assert not np.array_equal(without.terms["orientation"], found.terms["orientation"])


@pytest.mark.slow
def test_what_was_kept_changes_no_bit(objective: Objective) -> None:
    weights = objective.space.mean + 0.05 * np.random.default_rng(4).standard_normal((2, objective.space.size))
    trials = Trials(weights, 5, draw=1, pairs=(np.array([0, 1]), np.array([1, 0])), gains=Gains(weights[0]))
    fresh = make_objective(objective.task, threads=2)
    objective.evaluate(Trials(weights, 5))  # sensed once, and kept
    once, again = objective.evaluate(trials), fresh.evaluate(trials)
    for name, values in once.terms.items():
        np.testing.assert_array_equal(values, again.terms[name])


def test_gains_identify_a_question() -> None:
    trials = Trials(np.ones((1, 3)), 0, draw=1, pairs=(np.array([0]), np.array([0])))
    others = [
        replace(trials, gains=one) for one in (Gains(np.ones(3)), Gains(np.zeros(3)), Gains(np.ones(3), design=1))
    ]
    assert len({one.checksum for one in (trials, *others)}) == 4


@pytest.mark.slow
def test_the_motion_has_the_regulator_that_it_was_found_with(found: tuple[list[Generation], Motion]) -> None:
    """On the nominal model it does nothing: what is sensed there is what it holds the robot to."""
    generations, motion = found
    assert generations[-1].best.gains is not None
    assert motion.feedback is not None
    simulation = RecordedSimulation(motion, threads=1)
    without, within = (
        simulation.engine.rollout(simulation.start, motion.reference, feedback=one) for one in (None, motion.feedback)
    )
    np.testing.assert_allclose(within.joint_position, without.joint_position, rtol=0, atol=1e-12)


@pytest.mark.slow
def test_runs_of_the_motion_have_the_sensors_of_its_task(found: tuple[list[Generation], Motion]) -> None:
    motion = found[1]
    perfect = replace(motion.task, feedback=replace(FEEDBACK, sensors=SensorErrors(0.0, 0.0, 0.0, 0.0, 0.0)))
    simulation = RecordedSimulation(motion.with_task(perfect), threads=1)
    sample = Perturbation().draw(simulation.model, simulation.joints, n=2, seed=1)
    runs = run_trials(simulation, sample, feedback=motion.feedback)
    without_errors = simulation.rollout(sample, feedback=motion.feedback)
    for name, criterion in motion.task.success.items():
        np.testing.assert_array_equal(runs.errors[name], criterion.error(without_errors))
    usual = run_trials(RecordedSimulation(motion, threads=1), sample, feedback=motion.feedback)
    assert not np.array_equal(usual.errors["pitch"], runs.errors["pitch"])


@pytest.mark.slow
def test_a_run_resumes_to_the_same_motion(tmp_path: Path, found: tuple[list[Generation], Motion]) -> None:
    generations, whole = found

    def stop(generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if generation.generation == len(generations) - 3 else None

    run(make_objective(task(), threads=1), seed=2, directory=tmp_path / "run", observe=stop)
    resume(tmp_path / "run", threads=2)
    again = Motion.load(tmp_path / "run" / "motion.npz")
    assert again.result.trials == whole.result.trials
    for name in ("weights", "joint_position", "feedback_gain", "feedback_reference"):
        np.testing.assert_array_equal(again.arrays[name], whole.arrays[name])


def test_what_makes_no_sense_is_one_line() -> None:
    with pytest.raises(LevadeError, match=r"^feedback: acts on perturbed models, but the task has none"):
        replace(task(), robust=None)
    with pytest.raises(
        LevadeError, match=r"^feedback: needs one horizon for its gains, but the task has 0.05 to 0.1 s"
    ):
        replace(task(), horizon=HorizonRange(0.05, 0.1))
    with pytest.raises(LevadeError, match=r"^feedback.sensors.joint: -0.1 should be 0 or more"):
        SensorErrors(joint=-0.1)
    with pytest.raises(LevadeError, match=r"^feedback.rate: 0.0 should be 1 to 10000 Hz"):
        Regulation(rate=0.0)


@pytest.mark.slow
def test_an_engine_without_feedback_says_so() -> None:
    try:
        load()
    except LevadeError as missing:
        pytest.skip(str(missing))
    with pytest.raises(LevadeError, match=r"^feedback: the engine ode does not simulate it yet; use the engine mujoco"):
        make_objective(replace(task(), physics=replace(task().physics, engine="ode")))
