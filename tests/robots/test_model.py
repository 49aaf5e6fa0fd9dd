"""HyQ2Max against its published numbers and against closed forms written here."""

from __future__ import annotations

import itertools

import mujoco
import numpy as np
import pytest

from levade.robots import Robot, dimensions, load_robot

# The public description (H2M): dimensions [m], masses [kg], and below the leg tensors about the centre of mass in link
# axes, of which x points along the hanging leg, while y and z depend on leg and link.
HAA_X, HAA_Y, HAA_TO_HFE, UPPER, LOWER, FOOT_RADIUS = 0.4435, 0.097, 0.117, 0.360, 0.380, 0.02175
TRUNK_MASS, HIP_MASS, UPPER_MASS, LOWER_MASS = 39.71, 3.54, 4.95, 1.71
TRUNK_COM = np.array([0.060663, 0.000598, -0.007592])
TRUNK_INERTIA = (0.3020795, 4.751448, 4.82415, -0.0050854, 0.0046576, -0.0017613)  # xx yy zz xy xz yz


def rotation(axis: str, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return {
        "x": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
    }[axis]


def tensor(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> np.ndarray:
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def foot_by_hand(leg: str, haa: float, hfe: float, kfe: float) -> np.ndarray:
    """Foot centre in the trunk frame. HAA turns the hanging leg inward, HFE and KFE about +y."""
    side, end = (1 if leg[0] == "l" else -1), (1 if leg[1] == "f" else -1)
    along = -UPPER * np.sin(hfe) - LOWER * np.sin(hfe + kfe)
    down = UPPER * np.cos(hfe) + LOWER * np.cos(hfe + kfe)
    y = side * (HAA_Y + HAA_TO_HFE * np.cos(haa) - down * np.sin(haa))
    z = -HAA_TO_HFE * np.sin(haa) - down * np.cos(haa)
    return np.array([end * HAA_X + along, y, z])


def links() -> list[tuple[str, float, np.ndarray, np.ndarray]]:
    """(body, mass, centre of mass in the trunk frame at q = 0, tensor about it in trunk axes), from H2M's numbers."""
    found = [("trunk", TRUNK_MASS, TRUNK_COM, tensor(*TRUNK_INERTIA))]
    for leg in ("lf", "rf", "lh", "rh"):
        side, end = (1 if leg[0] == "l" else -1), (1 if leg[1] == "f" else -1)
        haa = np.array([end * HAA_X, side * HAA_Y, 0.0])
        hfe = np.add(haa, [0, side * HAA_TO_HFE, 0])
        knee = hfe - [0, 0, UPPER]
        # columns: the link's x, y, z in trunk axes; the hip's z is its HAA axis, the leg's z is trunk y
        hip_axes = np.array([[0, 0, -1], [0, -side, 0], [-side, 0, 0]]).T
        leg_axes = np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]]).T
        parts = (
            (f"{leg}_hip", HIP_MASS, haa, hip_axes, (-0.000605, -0.001346, 0.000196),
             (0.007379, 0.004284, 0.00709, -5.3e-05, 1.7e-05, 3e-05)),
            (f"{leg}_upper", UPPER_MASS, hfe, leg_axes, (0.144296, -0.002071 * end, -0.005094 * side),
             (0.010046, 0.100989, 0.104445, 0.000841 * end, -0.003497 * side, 1.8e-05 * side * end)),
            (f"{leg}_lower", LOWER_MASS, knee, leg_axes, (0.114678, 0.022576 * end, 0.000219 * end),
             (0.003359, 0.036086, 0.036037, 0.001567 * end, 3.3e-05 * end, -2e-06)),
        )  # fmt: skip
        for name, mass, origin, axes, com, inertia in parts:
            found.append((name, mass, origin + axes @ np.array(com), axes @ tensor(*inertia) @ axes.T))
    return found


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


def on_ground(robot: Robot) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The robot in its neutral posture, its feet just on a plane."""
    spec = robot.spec()
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
    model = mujoco.MjModel.from_xml_string(spec.to_xml())
    data = mujoco.MjData(model)
    data.qpos[:3] = 0, 0, robot.neutral_height - 1e-5
    data.qpos[7:] = robot.postures["neutral"]
    mujoco.mj_forward(model, data)
    return model, data


def test_weighs_what_the_lab_publishes(robot: Robot) -> None:
    assert robot.mass == pytest.approx(80.51, abs=1e-9)


def test_feet_are_where_the_closed_form_puts_them(robot: Robot) -> None:
    generator = np.random.default_rng(0)
    for _ in range(20):
        angles = generator.uniform(robot.limits.lower, robot.limits.upper)
        expected = [foot_by_hand(leg.name, *angles[robot.joint_indices(leg)]) for leg in robot.legs]
        np.testing.assert_allclose(robot.foot_positions(angles), expected, atol=1e-9)


def test_negative_haa_is_outward_on_every_leg(robot: Robot) -> None:
    angles = np.tile([-0.3, 0.0, 0.0], 4)
    spread = np.abs(robot.foot_positions(angles)[:, 1]) - np.abs(robot.foot_positions(0 * angles)[:, 1])
    assert np.all(spread > 0.1)


def test_knees_point_inward(robot: Robot) -> None:
    data = robot.data_at(robot.postures["neutral"])
    knee_x = [data.joint(f"{leg.name}_kfe").xanchor[0] for leg in robot.legs]
    assert np.all(np.abs(knee_x) < HAA_X - 0.1)


def test_neutral_height_is_that_of_the_data_sheet(robot: Robot) -> None:
    assert robot.neutral_height == pytest.approx(0.595, abs=5e-4)
    assert robot.standing_height("h2m") == pytest.approx(0.549, abs=5e-4)


def test_every_body_has_the_published_inertia(robot: Robot) -> None:
    data = robot.data_at(np.zeros(12))
    for name, mass, com, inertia in links():
        body = robot.model.body(name)
        assert body.mass[0] == mass
        np.testing.assert_allclose(data.body(name).xipos, com, atol=1e-6, err_msg=name)
        axes = data.body(name).ximat.reshape(3, 3)
        actual = axes @ np.diag(body.inertia) @ axes.T
        np.testing.assert_allclose(actual, inertia, atol=5e-6 * np.trace(inertia), err_msg=name)


def test_composite_inertia_by_parallel_axes(robot: Robot) -> None:
    """The mass matrix's trunk block at q = 0, about the trunk's origin, against a sum over the sheet's links."""
    model, data = robot.model, robot.data_at(np.zeros(12))
    mujoco.mj_crb(model, data)
    matrix = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, matrix)
    total, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for _, mass, com, own in links():
        total += mass
        moment += mass * com
        inertia += own + mass * (com @ com * np.eye(3) - np.outer(com, com))
    np.testing.assert_allclose(matrix[:3, :3], total * np.eye(3), atol=1e-9)
    np.testing.assert_allclose(matrix[3:6, 3:6], inertia, atol=1e-4)
    np.testing.assert_allclose(matrix[:3, 3:6], np.cross(np.eye(3), moment).T, atol=1e-5)


def test_standing_torques_are_those_of_the_data_sheet(robot: Robot) -> None:
    """Inverse dynamics in the neutral posture, vertical foot forces of least norm that balance weight and moments."""
    model, data = on_ground(robot)
    data.qacc[:] = 0
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    mujoco.mj_inverse(model, data)
    needed = data.qfrc_inverse
    rows = []
    for foot in robot.feet:
        jacobian = np.zeros((3, model.nv))
        body = model.geom(foot).bodyid[0]
        mujoco.mj_jac(model, data, jacobian, None, data.geom(foot).xpos - [0, 0, FOOT_RADIUS], body)
        rows.append(jacobian[2])
    vertical = np.array(rows)
    force = np.linalg.lstsq(vertical[:, [2, 3, 4]].T, needed[[2, 3, 4]], rcond=None)[0]
    assert force.sum() == pytest.approx(80.51 * 9.81)
    torque = np.abs((needed - vertical.T @ force)[6:].reshape(4, 3))
    for joint, (low, high) in enumerate([(21, 25), (12, 13), (44, 50)]):
        assert np.all(torque[:, joint] > 0.98 * low), torque
        assert np.all(torque[:, joint] < 1.02 * high), torque


def test_in_neutral_only_the_feet_touch(robot: Robot) -> None:
    model, data = on_ground(robot)
    touching = {frozenset((model.geom(c.geom1).name, model.geom(c.geom2).name)) for c in data.contact}
    assert touching == {frozenset(("ground", foot)) for foot in robot.feet}


def test_standing_sinks_less_than_a_millimetre_into_the_ground(robot: Robot) -> None:
    model, data = on_ground(robot)
    model.opt.timestep, model.opt.integrator = 0.002, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    data.ctrl[::2] = robot.postures["neutral"]
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert data.ncon == 4
    assert -1e-3 < data.contact.dist.min() < 0
    assert data.qpos[2] > 0.55


def contacts(robot: Robot, angles: np.ndarray) -> set[frozenset[str]]:
    data = robot.data_at(angles)
    mujoco.mj_collision(robot.model, data)
    return {frozenset((robot.model.geom(c.geom1).name, robot.model.geom(c.geom2).name)) for c in data.contact}


@pytest.mark.slow
@pytest.mark.parametrize("leg", range(4))
def test_a_leg_moves_freely_beside_the_trunk(robot: Robot, leg: int) -> None:
    """No contact with itself or the trunk at HAA = 0, HFE and KFE anywhere; nor outward, while it stays below HAA."""
    lower, upper = robot.limits.lower[3 * leg :], robot.limits.upper[3 * leg :]
    hfes, kfes = np.linspace(lower[1], upper[1], 13), np.linspace(lower[2], upper[2], 9)
    tried = 0
    for haa, hfe, kfe in itertools.product((lower[0], -0.3, 0.0), hfes, kfes):
        if haa < 0 and (np.cos(hfe) < 0 or UPPER * np.cos(hfe) + LOWER * np.cos(hfe + kfe) < 0):
            continue  # a raised leg leans over the trunk when HAA turns outward
        angles = robot.postures["neutral"].copy()
        angles[3 * leg : 3 * leg + 3] = haa, hfe, kfe
        touching = {
            pair for pair in contacts(robot, angles) if len({name[:2] for name in pair}) == 1 or "trunk" in pair
        }
        assert not touching, (haa, hfe, kfe)
        tried += 1
    assert tried > 200


def test_a_hanging_leg_swings_over_the_whole_haa_range(robot: Robot) -> None:
    for leg, haa in itertools.product(range(4), np.linspace(-0.785, 0.785, 21)):
        angles = robot.postures["neutral"].copy()
        angles[3 * leg] = haa
        assert not contacts(robot, angles), (leg, haa)


def test_legs_collide_with_each_other_and_shanks_with_the_trunk(robot: Robot) -> None:
    crossed = robot.postures["neutral"].copy()
    crossed[[0, 3]] = 0.7
    crossed[[1, 4]], crossed[[2, 5]] = 0.0, -0.04
    assert any({"lf", "rf"} == {name[:2] for name in pair} for pair in contacts(robot, crossed))
    tucked = robot.postures["neutral"].copy()
    tucked[:3] = 0.75, 1.57, -2.6
    assert any(
        "trunk" in pair and any(name in ("lf_foot", "lf_shank") for name in pair) for pair in contacts(robot, tucked)
    )


def test_robot_rests_on_side_and_back_without_falling_through(robot: Robot) -> None:
    for quaternion in ([np.sqrt(0.5), np.sqrt(0.5), 0, 0], [0, 1, 0, 0]):
        model, data = on_ground(robot)
        model.opt.timestep, model.opt.integrator = 0.002, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        data.qpos[2], data.qpos[3:7] = 0.5, quaternion
        data.ctrl[::2] = robot.postures["neutral"]
        for _ in range(1000):
            mujoco.mj_step(model, data)
        assert 0.1 < data.qpos[2] < 0.5
        assert data.contact.dist.min() > -5e-3
        assert np.abs(data.qvel).max() < 0.5


def test_looks_weigh_nothing_and_touch_nothing(robot: Robot) -> None:
    model = robot.model
    looks = model.geom_group == 2
    assert looks.sum() > 50
    assert not model.geom_contype[looks].any()
    assert not model.geom_conaffinity[looks].any()
    assert np.all(model.geom_group[~looks] == 3)


@pytest.mark.slow
def test_raw_inertia_variant_has_the_tensors_as_published() -> None:
    raw = load_robot("hyq2max", variant="raw-inertia")
    assert raw.mass == pytest.approx(80.51, abs=1e-9)
    data = raw.data_at(np.zeros(12))
    # H2M, lh lower leg in link axes: com and tensor as written; link x, y, z are trunk -z, -x, y
    np.testing.assert_allclose(
        data.body("lh_lower").xipos - data.joint("lh_kfe").xanchor, [0.042147, -0.000219, -0.109015]
    )
    axes = data.body("lh_lower").ximat.reshape(3, 3)
    actual = axes @ np.diag(raw.model.body("lh_lower").inertia) @ axes.T
    turn = np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]]).T
    expected = turn @ tensor(0.006848, 0.055957, 0.059397, -0.011981, -8e-06, 1.2e-05) @ turn.T
    np.testing.assert_allclose(actual, expected, atol=5e-7)
    heavier = np.array(raw.model.body("rf_upper").inertia) / load_robot("hyq2max").model.body("rf_upper").inertia
    assert heavier.max() == pytest.approx(2.0, abs=0.1)


def test_its_own_units_follow_from_its_dimensions(robot: Robot) -> None:
    size = dimensions(robot)
    neutral = dict(zip(robot.joint_names, robot.postures["neutral"], strict=True))
    foot = foot_by_hand("lf", neutral["lf_haa"], neutral["lf_hfe"], neutral["lf_kfe"])
    assert size.height == pytest.approx(FOOT_RADIUS - foot[2] + TRUNK_COM[2], abs=1e-5)
    assert size.leg == pytest.approx(UPPER + LOWER)
    assert size.trunk == pytest.approx(2 * HAA_X)
    assert 0.5 * 9.81 * size.fall**2 == pytest.approx(size.height)


def test_some_legs_take_a_posture_and_some_joints_an_angle(robot: Robot) -> None:
    neutral, low = robot.posture("neutral"), robot.posture("crouched")
    np.testing.assert_array_equal(robot.posture({"hind": "crouched"}), [*neutral[:6], *low[6:]])
    np.testing.assert_array_equal(robot.posture({"left": "crouched"})[[0, 1, 2, 6, 7, 8]], low[[0, 1, 2, 6, 7, 8]])
    both = robot.posture({"hind": "crouched", "front": "h2m", "lh_haa": 0.2})
    np.testing.assert_array_equal(both, [*robot.posture("h2m")[:6], 0.2, *low[7:]])
