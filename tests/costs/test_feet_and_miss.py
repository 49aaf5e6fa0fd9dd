"""Heights of the feet against MuJoCo's own kinematics, and criteria as costs."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from levade.costs import Criterion, Miss
from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.robots.shapes import balls
from levade.trajectory import JointReference, Trajectories


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.fixture(scope="module")
def motion(robot: Robot) -> tuple[Trajectories, np.ndarray]:
    """Random poses, and the height of each sole (n, rows, feet) as MuJoCo has it."""
    random = np.random.default_rng(5)
    n, rows = 2, 6
    joints = random.uniform(-1.5, 1.5, (n, rows, 12))
    position, quaternion = random.normal(size=(n, rows, 3)), random.normal(size=(n, rows, 4))
    quaternion /= np.linalg.norm(quaternion, axis=-1, keepdims=True)
    heights = np.empty((n, rows, 4))
    model, data = robot.model, mujoco.MjData(robot.model)
    for i, k in np.ndindex(n, rows):
        data.qpos[:7] = [*position[i, k], *quaternion[i, k]]
        for name, angle in zip(robot.joint_names, joints[i, k], strict=True):
            data.joint(name).qpos[0] = angle
        mujoco.mj_kinematics(model, data)
        heights[i, k] = [data.geom(foot).xpos[2] - model.geom(foot).size[0] for foot in robot.feet]
    zeros = np.zeros((n, rows, 12))
    trajectories = Trajectories(
        joint_position=joints,
        joint_velocity=zeros,
        joint_torque=zeros,
        trunk_position=position,
        trunk_quaternion=quaternion,
        trunk_linear_velocity=np.zeros((n, rows, 3)),
        trunk_angular_velocity=np.zeros((n, rows, 3)),
        reference=JointReference(zeros, zeros, 0.002, 4),
        embodiment=robot.embodiment,
        timestep=0.002,
        horizon_steps=4,
        diverged=np.zeros(n, dtype=bool),
    )
    return trajectories, heights


@pytest.mark.parametrize("kind", ["box", "sphere", "capsule", "cylinder", "ellipsoid"])
def test_balls_reach_as_low_as_the_shape_whichever_way_it_is_turned(kind: str) -> None:
    """Against the support of each shape, in closed form; a cylinder and an ellipsoid are sampled."""
    size = np.array([0.5, 0.2, 0.1])
    geom = f"<geom type='{kind}' size='0.5 0.2 0.1' mass='1'/>"
    world = f"<mujoco><worldbody><body><freejoint/>{geom}</body></worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(world)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    found = balls(model, data, 0)
    for up in np.random.default_rng(1).normal(size=(50, 3)):
        up /= np.linalg.norm(up)
        depth = {
            "box": np.abs(size * up).sum(),
            "sphere": 0.5,
            "capsule": 0.5 + 0.2 * abs(up[2]),
            "cylinder": 0.5 * np.hypot(*up[:2]) + 0.2 * abs(up[2]),
            "ellipsoid": np.linalg.norm(size * up),
        }[kind]
        lowest = (found[:, 3] - found[:, :3] @ up).max()
        assert lowest == pytest.approx(depth, abs=1e-8 if kind in ("box", "sphere", "capsule") else 0.02)


def test_the_clearance_of_the_trunk_is_that_of_its_lowest_corner(motion: tuple[Trajectories, np.ndarray]) -> None:
    """HyQ2Max's trunk is a box; its corners, by rotation matrices."""
    trajectories, _ = motion
    model = load_robot("hyq2max").model
    boxes = [g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("trunk").id and model.geom_contype[g]]
    assert [model.geom_type[g] for g in boxes] == [mujoco.mjtGeom.mjGEOM_BOX]
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
    corners = model.geom_pos[boxes[0]] + signs * model.geom_size[boxes[0]]
    found = Criterion("trunk_clearance", minimum=100.0, at="min").error(trajectories)
    for i in range(trajectories.n):
        lowest = np.inf
        for k in range(trajectories.steps):
            matrix = np.empty(9)
            mujoco.mju_quat2Mat(matrix, trajectories.trunk_quaternion[i, k])
            height = (corners @ matrix.reshape(3, 3).T)[:, 2] + trajectories.trunk_position[i, k, 2]
            lowest = min(lowest, height.min())
        assert found[i] == pytest.approx(lowest - 100.0, abs=1e-9)


def test_soles_are_where_mujoco_has_them(motion: tuple[Trajectories, np.ndarray]) -> None:
    trajectories, heights = motion
    for i, leg in enumerate(trajectories.legs):
        np.testing.assert_allclose(trajectories.sole_height(leg), heights[..., i], atol=1e-9)
        np.testing.assert_allclose(trajectories.sole_height(leg, slice(3, 4)), heights[:, 3:4, i], atol=1e-9)


@pytest.mark.parametrize(
    ("legs", "feet"),
    [("all", [0, 1, 2, 3]), ("front", [0, 1]), ("left", [0, 2]), ("rh", [3]), (("lf", "hind"), [0, 2, 3])],
)
def test_the_lowest_and_the_highest_foot_of_some_legs(
    motion: tuple[Trajectories, np.ndarray], legs: str | tuple[str, ...], feet: list[int]
) -> None:
    trajectories, heights = motion
    lowest = Criterion("lowest_foot", minimum=100.0, at="max", legs=legs)
    np.testing.assert_allclose(lowest.error(trajectories), heights[..., feet].min(axis=2).max(axis=1) - 100)
    highest = Criterion("highest_foot", target=0.5, tolerance=0.1, legs=legs)
    np.testing.assert_allclose(highest.error(trajectories), heights[:, 3, feet].max(axis=1) - 0.5)


def test_a_standing_robot_has_its_soles_on_the_ground(robot: Robot) -> None:
    neutral = robot.postures["neutral"]
    for leg in robot.leg_geometry:
        assert leg.foot_position(neutral)[2] - leg.sole == pytest.approx(-robot.neutral_height)


def test_legs_that_are_not_there(motion: tuple[Trajectories, np.ndarray]) -> None:
    trajectories, _ = motion
    with pytest.raises(LevadeError, match="legs: no 'fore'; valid names: all, front, hind"):
        Criterion("lowest_foot", minimum=0.0, legs="fore").error(trajectories)
    with pytest.raises(LevadeError, match="legs: an empty list"):
        Criterion("lowest_foot", minimum=0.0, legs=()).error(trajectories)
    with pytest.raises(LevadeError, match=r"success.height.legs: height is no quantity of the legs; lowest_foot and"):
        Criterion("height", minimum=0.0, legs="front")


def test_a_miss_is_the_squared_error_of_its_criterion(motion: tuple[Trajectories, np.ndarray]) -> None:
    trajectories, _ = motion
    height = trajectories.trunk_com_position()[..., 2]
    beyond = np.maximum(0.0, 3.0 - height)
    for at, value in (
        ("horizon", beyond[:, 3] ** 2),
        ("end", beyond[:, 5] ** 2),
        ("max", np.maximum(0.0, 3.0 - height.max(axis=1)) ** 2),
        ("min", np.maximum(0.0, 3.0 - height.min(axis=1)) ** 2),
        ("hold", (beyond[:, 4:] ** 2).mean(axis=1)),
        ("motion", (beyond[:, :4] ** 2).mean(axis=1)),
    ):
        np.testing.assert_allclose(Miss("height", minimum=3.0, at=at, scale=0.5)(trajectories), value / 0.25)
    off = np.maximum(0.0, np.abs(height[:, 3] - 0.5) - 0.1)
    np.testing.assert_allclose(Miss("height", target=0.5, tolerance=0.1)(trajectories), off**2)


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({}, "miss.height: give either a target and a tolerance, or a minimum and/or a maximum"),
        ({"target": 1.0, "scale": 0.0}, "miss.scale: 0.0 should be a positive number"),
        ({"target": 1.0, "tolerance": -1.0}, "miss.height.tolerance: -1.0 is negative"),
        ({"minimum": 2.0, "maximum": 1.0}, "miss.height: the minimum 2.0 is above the maximum 1.0"),
        ({"target": 1.0, "at": "often"}, "miss.height.at: 'often' is unknown; horizon, end, max, min, hold or motion"),
    ],
)
def test_mistakes_in_a_miss(config: dict[str, object], message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        Miss("height", **config)  # pyright: ignore[reportArgumentType]
    assert str(caught.value).startswith(message)
