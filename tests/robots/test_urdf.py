"""URDF: what becomes of links, joints and meshes; compared with closed forms, on a robot whose every number is known."""

from __future__ import annotations

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import DCMotor, Robot, load_robot
from levade.robots.meshes import stl

SHAPE = '<box size="0.4 0.08 0.1"/>'
XACRO = '<robot name="toy" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="a"/>'
MESH = '<mesh filename="{}" scale="1 1 1"/>'


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Where a test writes its robot."""
    (tmp_path / "toy_description" / "urdf").mkdir(parents=True)
    return tmp_path / "toy_description" / "urdf" / "toy.urdf"


def load(file: Path, text: str, *changes: tuple[str, str]) -> Robot:
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    file.write_text(text)
    return load_robot(file)


def findings(robot: Robot, kind: str) -> list[str]:
    return [str(finding) for finding in robot.findings if finding.kind == kind]


def box(path: Path, size: float = 0.1) -> None:
    """A tetrahedron, in a binary STL."""
    corners = size * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(stl(corners[[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]]))


def test_it_floats_freely_with_its_mass_and_no_ground(file: Path, quadruped: type) -> None:
    robot = load(file, quadruped().urdf())
    model = robot.model
    assert [model.jnt_type[j] for j in model.body("trunk").jntadr] == [mujoco.mjtJoint.mjJNT_FREE]
    assert (model.nq, model.nv, model.nu) == (7 + 12, 6 + 12, 0)
    assert model.nbody == 1 + 1 + 12
    assert robot.mass == pytest.approx(quadruped().mass)
    assert not any(model.geom_bodyid == 0)
    assert robot.trunk == "trunk"
    assert robot.joint_names == tuple(f"{leg}_{j}" for leg in ("lf", "rf", "lh", "rh") for j in ("haa", "hfe", "kfe"))
    assert [leg.roles for leg in robot.legs] == [("haa", "hfe", "kfe")] * 4


def test_limits_and_damping_are_the_files(file: Path, quadruped: type) -> None:
    old, new = (
        'lower="-0.8" upper="0.8" effort="20.0" velocity="15.0"',
        'lower="-0.7" upper="0.6" effort="11" velocity="9"',
    )
    robot = load(file, quadruped().urdf(), (old, new))
    assert isinstance(robot.actuation, DCMotor)
    for k, (torque, velocity, lower) in enumerate([(11, 9, -0.7), (20, 15, -1.5), (20, 15, -2.5)]):
        assert robot.limits.torque[k] == robot.actuation.torque[k] == torque
        assert robot.limits.velocity[k] == robot.actuation.no_load_speed[k] == velocity
        assert robot.limits.lower[k] == pytest.approx(lower, rel=1e-5)
    model = robot.spec().compile()
    np.testing.assert_allclose(model.dof_damping[6:], 0.1)
    data = mujoco.MjData(model)
    knee = model.joint("lf_kfe")
    data.joint("lf_kfe").qpos[0] = -1.0
    for speed, wanted in (
        (0.0, 20.0),
        (15.0, 0.0),
    ):  # asked for far more than it has: all of it at rest, none at full speed
        data.joint("lf_kfe").qvel[0] = speed
        data.ctrl[:] = 0.0
        data.ctrl[4:6] = 1.9, speed
        mujoco.mj_forward(model, data)
        assert data.qfrc_actuator[knee.dofadr[0]] == pytest.approx(wanted, abs=1e-6)


def test_fixed_links_are_fused_as_by_hand(file: Path, quadruped: type) -> None:
    """Shank and foot: total mass, common centre of mass, and the parallel axis theorem."""
    robot = load(file, quadruped().urdf())
    masses, places = np.array([0.2, 0.05]), np.array([-0.1, -0.2])
    centre = masses @ places / masses.sum()
    across = 0.002 + 1e-5 + masses @ (places - centre) ** 2
    shank = robot.model.body("lf_shank")
    assert shank.mass[0] == pytest.approx(0.25)
    np.testing.assert_allclose(shank.ipos, [0, 0, centre], atol=1e-9)
    np.testing.assert_allclose(np.sort(shank.inertia), [0.002 + 1e-5, across, across], rtol=1e-5)
    np.testing.assert_allclose(robot.foot_positions(np.zeros(12))[0], [0.2, 0.13, -0.4], atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("reference", "place"),
    [
        ("package://toy_description/meshes/part.stl", "toy_description/meshes/part.stl"),
        ("package://elsewhere/meshes/part.stl", "toy_description/meshes/part.stl"),
        ("../meshes/part.stl", "toy_description/meshes/part.stl"),
        ("meshes/part.stl", "toy_description/urdf/meshes/part.stl"),
        ("/home/somebody/ws/src/toy_description/meshes/part.stl", "toy_description/meshes/part.stl"),
        ("file:///opt/ros/share/toy_description/meshes/part.stl", "toy_description/meshes/part.stl"),
        ("C:\\robots\\toy\\meshes\\part.stl", "toy_description/meshes/part.stl"),
    ],
)
def test_meshes_are_found_where_they_are(
    file: Path, tmp_path: Path, quadruped: type, reference: str, place: str
) -> None:
    box(tmp_path / place)
    robot = load(file, quadruped().urdf(), (SHAPE, MESH.format(reference)))
    assert len(robot.assets) == 1
    assert findings(robot, "warning") == []
    corners = robot.model.mesh_vert
    distances = np.linalg.norm(corners[:, None] - corners[None], axis=-1)
    assert distances.max() == pytest.approx(0.1 * np.sqrt(2), rel=1e-5)


def test_ros_paths_are_looked_through(
    file: Path, tmp_path: Path, quadruped: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    box(tmp_path / "overlay" / "share" / "toy_meshes" / "part.stl")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path / 'overlay'}")
    assert load(file, quadruped().urdf(), (SHAPE, MESH.format("package://toy_meshes/part.stl"))).assets


@pytest.mark.slow
def test_a_mesh_that_is_missing_stops_nothing(file: Path, quadruped: type) -> None:
    text = quadruped().urdf()
    robot = load(file, text, (f"<geometry>{SHAPE}</geometry></collision>", f"<geometry>{SHAPE}</geometry></collision>"
                             f'<collision><geometry>{MESH.format("gone.stl")}</geometry></collision>'))  # fmt: skip
    assert findings(robot, "warning") == [
        "link trunk: collides as primitives only: gone.stl is missing; put the files where the URDF says"
    ]
    assert robot.model.ngeom == 5
    robot = load(file, text, (SHAPE, MESH.format("gone.stl")))
    assert findings(robot, "warning")[0].startswith("link trunk: collides with nothing: gone.stl is missing;")
    assert robot.mass == pytest.approx(quadruped().mass)
    robot = load(
        file, text, ("<collision>", f"<visual><geometry>{MESH.format('gone.stl')}</geometry></visual><collision>")
    )
    assert findings(robot, "warning") == []
    assert "not shown as meshes: gone.stl is missing" in findings(robot, "note")[0]


def test_a_foot_whose_shape_is_missing_is_an_error(file: Path, quadruped: type) -> None:
    message = (
        r"leg lf: no foot: nothing collides on lf_shank, behind lf_kfe; give it a .*"
        r" \(collides with nothing: gone\.stl is missing\)$"
    )
    with pytest.raises(LevadeError, match=message):
        load(file, quadruped().urdf(), ('<sphere radius="0.02"/>', MESH.format("gone.stl")))


@pytest.mark.slow
def test_a_mesh_that_is_no_mesh_is_said(file: Path, tmp_path: Path, quadruped: type) -> None:
    (tmp_path / "toy_description" / "urdf" / "part.dae").write_text("<collada/>")
    pytest.importorskip("trimesh", reason="reads .dae: pip install 'levade[meshes]'")
    robot = load(file, quadruped().urdf(), (SHAPE, MESH.format("part.dae")))
    assert "part.dae: not a mesh that can be read" in findings(robot, "warning")[0]


@pytest.mark.slow
def test_a_collada_mesh_without_the_extra_says_what_to_install(
    file: Path, tmp_path: Path, quadruped: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "toy_description" / "urdf" / "part.dae").write_text("<collada/>")
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    robot = load(file, quadruped().urdf(), (SHAPE, MESH.format("part.dae")))
    assert "part.dae: MuJoCo does not read .dae; pip install 'levade[meshes]'" in findings(robot, "warning")[0]


@pytest.mark.slow
def test_flat_meshes_and_repeated_names_are_taken(
    file: Path, tmp_path: Path, quadruped: type, capfd: pytest.CaptureFixture[str]
) -> None:
    flat = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=float)
    (tmp_path / "toy_description" / "urdf" / "flat.stl").write_bytes(stl(np.concatenate([flat, flat + 0.5])))
    visual = f'<visual name="shell"><geometry>{MESH.format("flat.stl")}</geometry></visual>'
    robot = load(file, quadruped().urdf(), ("<collision>", f'{visual}<collision name="shell">'))
    assert robot.mass == pytest.approx(quadruped().mass)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("inertia", "problem", "moment"),
    [
        ((0.01, 0.01, 0.05), "breaks the triangle inequality", 0.07 / 3),
        ((-0.02, 0.02, 0.03), "is not positive", 0.01),
        ((0.0, 0.0, 0.0), "is not positive", 0.4 * 6 * (3 * 6 / (4 * np.pi * 1000)) ** (2 / 3)),
        ((1e-12, 1e-12, 1e-12), "is that of a point", 0.4 * 6 * (3 * 6 / (4 * np.pi * 1000)) ** (2 / 3)),
    ],
)
def test_inertias_that_no_body_has_become_those_of_a_sphere(
    file: Path, quadruped: type, inertia: tuple[float, float, float], problem: str, moment: float
) -> None:
    bad = 'ixx="{}" iyy="{}" izz="{}"'.format(*inertia)
    robot = load(file, quadruped().urdf(), ('ixx="0.1" iyy="0.1" izz="0.1"', bad))
    (said,) = findings(robot, "warning")
    assert said.startswith(f"link trunk: the inertia {problem}")
    assert f"{moment:.3g} kg m2 is taken about every axis; fix it in the file" in said
    np.testing.assert_allclose(robot.model.body("trunk").inertia, moment, rtol=1e-5)
    assert robot.mass == pytest.approx(quadruped().mass)


@pytest.mark.slow
def test_joints_without_a_range_turn_without_end(file: Path, quadruped: type) -> None:
    text = re.sub(r'lower="\S+" upper="\S+"', "", quadruped().urdf())
    robot = load(file, text)
    assert np.isinf(robot.limits.lower).all()
    assert (robot.foot_positions(robot.postures["neutral"])[:, 2] < -0.2).all()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("</robot>", "", "toy.urdf: broken XML (no element found: line"),
        ('<robot name="toy">', "<robot", "toy.urdf: broken XML (not well-formed"),
        ('"-0.8" upper="0.8"', '"0.8" upper="-0.8"', "joint lf_haa: limits are inverted, lower 0.8 is above upper -0.8"),
        ('"-0.8" upper="0.8"', '"0.5" upper="0.5"', "joint lf_haa: limits leave it no room, both are 0.5; give a range"),
        ('"-0.8" upper="0.8"', '"-0.8" upper="much"', "joint lf_haa: limit upper: 'much' is not a number"),
        ('<mass value="0.8"/>', '<mass value="0"/>', "body lf_thigh moves but has no mass or no inertia; give"),
        ('<mass value="6.0"/>', '<mass value="0"/>', "body trunk moves but has no mass or no inertia; give it both"),
        ('<mass value="6.0"/>', '<mass value="-6"/>', "link trunk: mass -6 kg is negative"),
        ('type="revolute"', 'type="planar"', "joint lf_haa: type 'planar' cannot be simulated; use one of revolute,"),
        ('<child link="lf_hip"/>', '<child link="lf_hop"/>', "joint lf_haa: its child link 'lf_hop' is not in the file"),
        ('<parent link="lf_hip"/>', '<parent link="lf_shank"/>', "joint lf_hfe: link lf_thigh hangs on itself; levade"),
        ('<child link="rf_hip"/>', '<child link="lf_hip"/>', "link lf_hip hangs on two joints, lf_haa and rf_haa;"),
        ('<link name="lf_hip">', "<link>", "a <link> has no name; every link and joint needs one"),
        ('<robot name="toy">', XACRO, "still contains xacro macros; expand them first: xacro toy.urdf > robot.urdf"),
    ],
)  # fmt: skip
def test_what_cannot_be_simulated_is_refused(file: Path, quadruped: type, old: str, new: str, message: str) -> None:
    with pytest.raises(LevadeError, match=re.escape(message)) as caught:
        load(file, quadruped().urdf(), (old, new))
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_joints_without_effort_get_an_assumed_torque(file: Path, quadruped: type) -> None:
    """Enough for two legs to bear the robot: m g l / 2, and warned of; likewise where the number says "no limit"."""
    assumed = quadruped().mass * 9.81 * 0.2
    for effort, said in (
        ("0", "no torque limit"),
        ("1000", "torque limits of up to 1e+03 Nm are not plausible for its weight"),
    ):
        robot = load(file, quadruped().urdf(), ('effort="20.0"', f'effort="{effort}"'))
        np.testing.assert_allclose(robot.limits.torque, assumed)
        assert findings(robot, "warning") == [
            f"all joints: {said}; {assumed:.3g} Nm is assumed; robot.yaml, limits: {{torque: ...}} gives the real one"
        ]
        assert robot.origins["torque"] == "assumed"


def test_joints_that_mimic_others_and_a_world_link_are_no_trouble(file: Path, quadruped: type) -> None:
    world = '<link name="world"/><joint name="f" type="floating"><parent link="world"/><child link="trunk"/></joint>'
    tail = (
        '<link name="tail"><inertial><mass value="0.3"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/>'
        '</inertial></link><joint name="wag" type="revolute"><parent link="trunk"/><child link="tail"/>'
        '<mimic joint="lf_haa"/><limit lower="-1" upper="1"/></joint>'
    )
    robot = load(file, quadruped().urdf(), ("</robot>", f"{world}{tail}</robot>"))
    assert robot.trunk == "trunk"
    assert robot.mass == pytest.approx(quadruped().mass + 0.3)
    assert any("joint wag: follows other joints (wag = 1 lf_haa)" in said for said in findings(robot, "warning"))


@pytest.mark.slow
def test_light_links_get_armature_for_stable_servos(file: Path, quadruped: type) -> None:
    """Saturated servos damp explicitly: kd dt must stay below the inertia that the joint moves."""
    text = quadruped().urdf().replace("0.002", "0.00002").replace('<mass value="0.2"/>', '<mass value="0.02"/>')
    robot = load(file, text.replace('<mass value="0.05"/>', '<mass value="0.001"/>'))
    model, data = robot.model, robot.data_at(robot.postures["neutral"])
    mujoco.mj_makeM(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    assert (np.diag(inertia)[6:] >= robot.actuation.kd * 0.002 * (1 - 1e-5)).all()
    assert any("reflected rotor inertia (armature)" in said for said in findings(robot, "note"))
    assert not load(file, quadruped().urdf()).model.dof_armature.any()


CASES = Path(__file__).parent / "cases"
CAMERA = (
    '<link name="cam"/><joint name="camj" type="fixed"><parent link="world"/><child link="cam"/></joint>'
    '<link name="lens"/><joint name="lensj" type="fixed"><parent link="cam"/><child link="lens"/></joint>'
)


@pytest.mark.slow
def test_a_world_with_a_camera_is_no_robot(file: Path, quadruped: type) -> None:
    robot = load_robot(CASES / "world" / "world-camera.urdf")
    assert (robot.trunk, robot.mass) == ("base", pytest.approx(12.4))
    assert findings(robot, "note")[0] == "link cam: fixed to the world, left out: not part of the robot"
    for shape in ("", f"<collision><geometry>{SHAPE}</geometry></collision>"):  # a floor, perhaps
        tie = '<joint name="f" type="fixed"><parent link="world"/><child link="trunk"/></joint>'
        world = f'<link name="world">{shape}</link>{tie}'
        robot = load(file, quadruped().urdf(), ("</robot>", f"{world}{CAMERA}</robot>"))
        assert (robot.trunk, robot.mass) == ("trunk", pytest.approx(quadruped().mass))
        assert findings(robot, "note")[0].startswith("links cam, lens: fixed to the world, left out")


def test_a_robot_that_a_joint_moves_against_the_world_is_refused_with_the_reason(file: Path, quadruped: type) -> None:
    rail = '<link name="world"/><joint name="lift" type="prismatic"><parent link="world"/><child link="trunk"/></joint>'
    with pytest.raises(
        LevadeError, match="joint lift moves the robot against the link world, so that it does not float"
    ):
        load(file, quadruped().urdf(), ("</robot>", f"{rail}</robot>"))


def test_a_trunk_may_be_called_world(file: Path, quadruped: type) -> None:
    robot = load(file, quadruped().urdf(), ('"trunk"', '"world"'))
    assert (robot.trunk, robot.mass) == ("world_link", pytest.approx(quadruped().mass))
