"""Where motions start: at rest on the ground, or as a fall left the robot."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.engines import Engine, Fall, Fallen, Fold, Physics, Settled, State, make_engine, start_state
from levade.engines.folding import Folding
from levade.engines.start import Start
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.robots.tucking import tucked
from levade.rotations import roll_pitch_yaw, rotate
from levade.scenes import Box, Scene
from levade.tasks import builtin_tasks, load_task

MAST = Path(__file__).parents[1] / "robots" / "cases" / "mast" / "pup.urdf"


@pytest.mark.parametrize("posture", ["neutral", "h2m", {"*_haa": 0.1}])
def test_settled_is_at_rest_in_its_posture(engine: Engine, robot: Robot, posture: str | dict[str, float]) -> None:
    state = start_state(engine, robot, Scene(), Settled(posture))
    assert np.abs(state.qvel).max() < 0.01
    np.testing.assert_array_equal(state.joint_reference, [robot.posture(posture)])
    np.testing.assert_allclose(state.joint_position, state.joint_reference, atol=0.15)  # it sags under its weight
    assert abs(state.qpos[0, 2] - robot.standing_height(posture)) < 0.06
    np.testing.assert_allclose(roll_pitch_yaw(state.qpos[0, 3:7]), 0, atol=0.05)


def test_a_start_is_the_same_every_time_and_where_it_is_asked_for(engine: Engine, robot: Robot) -> None:
    other = make_engine(robot, Scene(), Physics(), threads=2)
    here, again = (start_state(e, robot, Scene(), Settled()) for e in (engine, other))
    np.testing.assert_array_equal(here.qpos, again.qpos)
    np.testing.assert_array_equal(here.qvel, again.qvel)
    there = start_state(engine, robot, Scene(), Settled(x=1.0, y=-2.0))
    np.testing.assert_allclose(there.qpos[0, :3] - here.qpos[0, :3], [1, -2, 0], atol=1e-3)


def test_without_time_it_is_as_put_down(engine: Engine, robot: Robot) -> None:
    state = start_state(engine, robot, Scene(), Settled(time=0.0))
    assert state.qpos[0, 2] == robot.standing_height("neutral")
    np.testing.assert_array_equal(state.joint_position, [robot.posture("neutral")])
    np.testing.assert_array_equal(state.qvel, 0)
    fall = start_state(engine, robot, Scene(), Fall(height=2.0, x=0.5, yaw=np.pi / 2, time=0.0))
    np.testing.assert_allclose(fall.qpos[0, :7], [0.5, 0, 2, np.sqrt(0.5), 0, 0, np.sqrt(0.5)])


def test_a_fall_is_free_until_it_lands(robot: Robot, engine: Engine) -> None:
    """0.2 s from 3 m: the speed of the centre of mass is g t, by conservation of momentum, whatever the joints do."""
    state = start_state(engine, robot, Scene(), Fall(height=3.0, time=0.2, roll=0.3))
    data = mujoco.MjData(engine.model)
    data.qpos[:], data.qvel[:] = state.qpos, state.qvel
    mujoco.mj_forward(engine.model, data)
    mujoco.mj_subtreeVel(engine.model, data)
    np.testing.assert_allclose(data.subtree_linvel[1], [0, 0, -9.81 * 0.2], atol=0.01)


@pytest.mark.slow
def test_falls_are_deterministic_and_spread_by_their_seed(robot: Robot, engine: Engine) -> None:
    fall = Fall(height=0.8, roll=0.5, time=0.3)
    one, same = start_state(engine, robot, Scene(), fall), start_state(engine, robot, Scene(), fall)
    np.testing.assert_array_equal(one.qpos, same.qpos)
    np.testing.assert_array_equal(
        one.qpos, start_state(engine, robot, Scene(), Fall(height=0.8, roll=0.5, time=0.3, seed=5)).qpos
    )

    def spread(seed: int) -> np.ndarray:
        return start_state(engine, robot, Scene(), Fall(height=0.8, roll=0.5, time=0.0, spread=0.1, seed=seed)).qpos[0]

    np.testing.assert_array_equal(spread(1), spread(1))
    samples = np.array([spread(seed)[7:] for seed in range(200)])
    np.testing.assert_allclose(samples.std(axis=0), 0.1, rtol=0.2)  # 5 % would be one standard deviation
    np.testing.assert_allclose(samples.mean(axis=0), one.joint_reference[0], atol=0.03)


@pytest.mark.parametrize("name", [name for name in builtin_tasks() if name.startswith("posture-recovery")])
def test_recovery_starts_lying_partly_on_the_obstacle(robot: Robot, name: str) -> None:
    task = load_task(name)
    engine = make_engine(robot, task.scene, task.physics)
    state = start_state(engine, robot, task.scene, task.start.choice)
    roll = roll_pitch_yaw(state.qpos[0, 3:7])[0]
    assert abs(roll) >= 0.35
    assert state.qpos[0, 2] < 0.35
    data = mujoco.MjData(engine.model)
    data.qpos[:], data.qvel[:], data.act[:] = state.qpos, state.qvel, state.act
    mujoco.mj_forward(engine.model, data)
    touching = {engine.model.geom(int(geom)).name for contact in data.contact for geom in contact.geom}
    assert {"ground", "box0"} <= touching


def test_on_a_slope_it_stands_still(robot: Robot) -> None:
    scene = Scene(slope=0.15, friction=0.9)
    engine = make_engine(robot, scene, Physics(), threads=1)
    state = start_state(engine, robot, scene, Settled(time=4.0))  # put down level, it sways a while
    assert np.abs(state.qvel).max() < 0.01
    pitch = roll_pitch_yaw(state.qpos[0, 3:7])[1]
    assert pitch == pytest.approx(-0.15, abs=0.06)  # uphill: nose up, which is negative


@pytest.mark.parametrize(
    ("scene", "start", "names"),
    [
        (Scene(boxes=(Box((0.0, 0.0, 0.5), (0.3, 0.3, 0.3)),)), Settled(), "box0"),
        (
            Scene(boxes=(Box((9.0, 9.0, 0.5), (0.3, 0.3, 0.3)), Box((0.4, 0.2, 0.0), (0.5, 0.5, 0.3)))),
            Settled(),
            "box1",
        ),
    ],
)
def test_a_robot_is_not_put_down_into_the_scene(robot: Robot, scene: Scene, start: Start, names: str) -> None:
    with pytest.raises(
        LevadeError, match=rf"start: .*\b{names}\b.* overlap by 0\.\d+ m where the robot is put down; move"
    ):
        start_state(make_engine(robot, scene, Physics(), threads=1), robot, scene, start)


@pytest.mark.parametrize("scene", [Scene(), Scene(slope=0.2)])
@pytest.mark.parametrize("roll", [0.0, 1.2, np.pi])
def test_a_fall_begins_clear_of_the_ground(robot: Robot, scene: Scene, roll: float) -> None:
    """Asked for in the ground, it begins where its lowest point is on it; MuJoCo measures how far away that is."""
    engine = make_engine(robot, scene, Physics(), threads=1)
    state = start_state(engine, robot, scene, Fall(height=0.1, roll=roll, time=0.0))
    model, data = engine.model, mujoco.MjData(engine.model)
    data.qpos[:] = state.qpos[0]
    mujoco.mj_forward(model, data)
    parts = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] and model.geom_contype[g] | model.geom_conaffinity[g]
    ]
    ground, ends = model.geom("ground").id, np.zeros(6)
    nearest = min(mujoco.mj_geomDistance(model, data, ground, part, 5.0, ends) for part in parts)
    assert abs(nearest) < (0.003 if scene.slope else 1e-9)


@pytest.mark.slow
def test_a_family_of_falls_has_every_attitude_and_posture_alike(robot: Robot, engine: Engine) -> None:
    """Archimedes: of a direction that is uniform on the sphere, each component is uniform between -1 and 1. Kolmogorov: then
    the empirical distribution is 1.95 / sqrt(n) off with a probability of one in a thousand.
    """
    n = 150
    released = [start_state(engine, robot, Scene(), Fallen(1.0, time=0.0, index=i)) for i in range(n)]
    qpos = np.concatenate([state.qpos for state in released])
    for axis in np.eye(3):
        for component in rotate(qpos[:, 3:7], np.tile(axis, (n, 1))).T:
            off = np.abs((np.sort(component) + 1) / 2 - (np.arange(n) + 0.5) / n).max()
            assert off < 1.95 / np.sqrt(n)
    lower, upper = robot.limits.lower, robot.limits.upper
    share = (qpos[:, 7:] - lower) / (upper - lower)
    assert share.min() >= 0
    assert share.max() <= 1
    np.testing.assert_allclose(share.min(axis=0), 0, atol=0.1)
    np.testing.assert_allclose(share.max(axis=0), 1, atol=0.1)
    np.testing.assert_array_equal(np.concatenate([state.joint_reference for state in released]), qpos[:, 7:])


def test_a_joint_that_turns_more_than_once_falls_within_a_turn(robot: Robot, engine: Engine) -> None:
    """An angle and the same one a turn further are one posture: such a joint would have turns to wind back first."""
    lower, upper = robot.limits.lower.copy(), robot.limits.upper.copy()
    knees = [i for i, name in enumerate(robot.joint_names) if name.endswith("_kfe")]
    lower[knees], upper[knees] = [-9.0, 0.0, -np.inf, -np.inf], [9.0, 9.0, np.inf, -1.0]
    turning = replace(robot, limits=replace(robot.limits, lower=lower, upper=upper))
    released = [start_state(engine, turning, Scene(), Fallen(1.0, time=0.0, index=i)) for i in range(60)]
    angles = np.concatenate([state.joint_reference for state in released])[:, knees]
    first = np.array([-np.pi, 0.0, -np.pi, -1.0 - 2 * np.pi])
    assert (angles >= first).all()
    assert (angles <= first + 2 * np.pi).all()
    assert (np.ptp(angles, axis=0) > np.pi).all()


def test_nothing_of_a_fall_overlaps_when_it_begins(robot: Robot) -> None:
    """Beside a wall that many attitudes would reach into, on a slope: by MuJoCo's own contacts."""
    wall = Box((0.9, 0.0, 1.0), (0.1, 4.0, 3.0))
    scene = Scene(boxes=(wall,), slope=0.1)
    engine = make_engine(robot, scene, Physics(), threads=1)
    model, data = engine.model, mujoco.MjData(engine.model)
    for i in range(20):
        state = start_state(engine, robot, scene, Fallen(0.2, time=0.0, seed=1, index=i))
        data.qpos[:] = state.qpos[0]
        mujoco.mj_forward(model, data)
        assert all(contact.dist > -0.0031 for contact in data.contact), i


def test_a_fall_of_a_family_is_the_same_alone_and_comes_to_rest(robot: Robot, engine: Engine) -> None:
    other = make_engine(robot, Scene(), Physics(), threads=2)
    fall = Fallen(0.6, seed=3, index=7, time=3.0)
    one, same = (start_state(e, robot, Scene(), fall) for e in (engine, other))
    np.testing.assert_array_equal(one.qpos, same.qpos)
    assert np.abs(one.qvel[0, :3]).max() < 0.1
    assert one.qpos[0, 2] < 0.6
    apart = [start_state(engine, robot, Scene(), replace(fall, time=0.0, **change)) for change in DIFFERENT]
    assert len({state.qpos.tobytes() for state in apart}) == len(DIFFERENT)


DIFFERENT: list[dict[str, int]] = [{"index": 7}, {"index": 8}, {"seed": 4}, {"seed": 7, "index": 3}]


def test_a_robot_that_folds_up_ends_as_its_drives_were_led(robot: Robot, engine: Engine) -> None:
    """Against MuJoCo stepped by hand along a smooth step to the posture, and then at rest there."""
    fall, fold = Fallen(0.6, seed=3, index=7, time=0.3), Fold("crouched", time=0.1, rest=0.05, jammed=None)
    before, after = (start_state(engine, robot, Scene(), replace(fall, fold=one)) for one in (None, fold))
    goal, told, timestep = robot.posture("crouched"), before.joint_reference[0], engine.physics.timestep
    data, layout = mujoco.MjData(engine.model), engine.layout
    data.qpos[:], data.qvel[:], data.act[:] = before.qpos[0], before.qvel[0], before.act[0]
    for s in np.minimum(np.arange(1, round(0.15 / timestep) + 1) * timestep / 0.1, 1.0):
        data.ctrl[layout.ctrl_position] = told + s**2 * (3 - 2 * s) * (goal - told)
        data.ctrl[layout.ctrl_velocity] = 6 * s * (1 - s) / 0.1 * (goal - told)
        mujoco.mj_step(engine.model, data)
    np.testing.assert_allclose(after.qpos[0], data.qpos, atol=1e-6)
    np.testing.assert_array_equal(after.joint_reference[0], goal)


@pytest.mark.slow
def test_a_robot_that_lies_on_a_leg_stretches_and_folds_up_once_more(robot: Robot, engine: Engine) -> None:
    """Of these falls the third jams a leg. It comes free; the others are folded up once, to the same bits."""
    once, twice = (
        [start_state(engine, robot, Scene(), Fallen(0.69, seed=0, index=i, time=1.5, fold=fold)) for i in range(3)]
        for fold in (Fold(jammed=None), Fold())
    )
    posture = tucked(robot)
    off = [[float(np.abs(state.joint_position[0] - posture).max()) for state in states] for states in (once, twice)]
    assert [distance > 0.5 for distance in off[0]] == [False, False, True]
    assert off[1][2] < 0.1
    for one, same in zip(once[:2], twice[:2], strict=True):
        np.testing.assert_array_equal(one.qpos, same.qpos)
    together = Folding.of(robot, Fold()).folded(engine, State.stacked(once))
    assert (np.abs(together.joint_position - posture).max(axis=1) < 0.1).all()


@pytest.mark.parametrize("jammed", [0.0, -0.5, math.nan])
def test_a_distance_that_jams_nothing_or_everything_is_refused(jammed: float) -> None:
    with pytest.raises(LevadeError, match=r"fold\.jammed: .* should be a positive angle"):
        Fold(jammed=jammed)


@pytest.mark.parametrize("name", [pytest.param("go1", marks=pytest.mark.slow), "hyq2max"])
def test_tucked_is_a_deep_crouch_with_the_feet_under_the_hips(name: str, packaged: Callable[[str], Robot]) -> None:
    robot = packaged(name)
    posture, crouched = tucked(robot), robot.posture("crouched")
    assert (posture >= robot.limits.lower).all()
    assert (posture <= robot.limits.upper).all()
    assert (robot.foot_depths(posture) < robot.foot_depths(crouched) - 0.02).all()
    assert np.abs(robot.foot_positions(posture)[:, 0] - robot.foot_positions(crouched)[:, 0]).max() < 0.01


@pytest.mark.slow
def test_a_robot_that_fits_nowhere_is_said(robot: Robot) -> None:
    scene = Scene(boxes=(Box((0.0, 0.0, 1.0), (0.5, 0.5, 0.5)),))
    with pytest.raises(LevadeError, match=r"start\.fallen: .*box0.* overlap by .* in the last of 1000 postures"):
        start_state(make_engine(robot, scene, Physics(), threads=1), robot, scene, Fallen(1.0))


@pytest.mark.slow
def test_a_mast_is_put_down_on_its_tip_and_rolls_over() -> None:
    """Upside down, what reaches highest above the trunk is what the start has to clear."""
    robot = load_robot(MAST)
    task = load_task("self-righting", robot=str(MAST))
    state = start_state(make_engine(robot, task.scene, task.physics, threads=1), robot, task.scene, task.start.choice)
    assert np.isfinite(state.qpos).all()
    assert np.abs(roll_pitch_yaw(state.qpos[0, 3:7])[0]) > 1.0  # it lies on its back or side


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (
            lambda: Settled(posture="neutrl"),
            r"start.settled.posture: robot hyq2max: no posture 'neutrl'; did you mean neu",
        ),
        (lambda: Fall(1.0, posture={"lf_ha": 1.0}), r"start.fall.posture: .*no joint 'lf_ha'; did you mean lf_haa\?"),
        (lambda: Settled({"lf_haa": 2.0}), r"start.settled.posture: .*lf_haa 2.0 rad is out of its range, -0.785"),
        (lambda: Settled(time=-1.0), r"start.settled.time: -1.0 s is not a duration"),
        (lambda: Settled(x=float("inf")), r"start.settled.x: inf is not a number"),
        (lambda: Fall(float("nan")), r"start.fall.height: nan is not a number"),
        (lambda: Fall(1.0, gain=-0.1), r"start.fall.gain: -0.1 should be 0 or more"),
        (lambda: Fallen(1.0, index=-1), r"start.fallen.index: -1 should be 0 or more"),
        (lambda: Fallen(1.0, gain=-1.0), r"start.fallen.gain: -1.0 should be 0 or more"),
        (lambda: Fallen(float("inf")), r"start.fallen.height: inf is not a number"),
        (lambda: Fall(1.0, spread=float("nan")), r"start.fall.spread: nan should be 0 or more"),
        (lambda: Fallen(1.0, fold=Fold(time=-1.0)), r"start.fallen.fold.time: -1.0 s is not a duration"),
        (lambda: Fallen(1.0, fold=Fold("tuked")), r"start.fallen.fold.posture: .*no posture 'tuked'; did you mean"),
    ],
)
def test_wrong_starts(robot: Robot, engine: Engine, start: object, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        start_state(engine, robot, Scene(), start())  # type: ignore[operator]
