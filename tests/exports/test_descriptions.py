"""The robot as URDF and MJCF files: the same robot whoever reads it, and the same bytes whatever it does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest

from levade.engines import Physics, make_engine
from levade.engines.placing import model_xml
from levade.errors import LevadeError
from levade.exports import as_mjcf, export
from levade.exports.as_mjcf import robot_alone
from levade.exports.samples import Joints
from levade.exports.urdf import mesh_bytes, mesh_files, urdf
from levade.motions import Motion
from levade.robots import Robot, load_robot
from levade.scenes import Box, Gap, Scene, Terrain

SCENES = (
    Scene(),
    Scene(friction=0.4, slope=0.1, boxes=(Box((2, 0, 0.2), (1, 1, 0.4)), Box((4, 0, 0.2), (1, 1, 0.4)))),
    Scene(gaps=(Gap(1.0, 0.3),)),
    Scene(terrain=Terrain(size=(1.0, 1.0), position=(2.0, 0.0), heights=((0.0, 0.1), (0.2, 0.0)))),
)


@pytest.fixture(scope="module")
def wedged(tmp_path_factory: pytest.TempPathFactory, quadruped: type) -> Robot:
    """The toy with a wedge on its trunk, a mesh in a file, off its own origin and turned."""
    folder = tmp_path_factory.mktemp("wedged")
    corners = ("0 0 0", "0.3 0 0", "0 0.2 0", "0 0 0.1")
    faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (folder / "wedge.obj").write_text("".join(f"v {corner}\n" for corner in corners) + faces)
    text = quadruped().mjcf().replace("<worldbody>", '<asset><mesh file="wedge.obj"/></asset><worldbody>')
    mesh = '<geom name="back" type="mesh" mesh="wedge" pos="0.05 0 0.1" euler="0.2 0.1 0.4"/>'
    (folder / "toy.xml").write_text(text.replace('<geom name="trunk"', f'{mesh}<geom name="trunk"'))
    return load_robot(folder / "toy.xml")


def joints_of(robot: Robot) -> Joints:
    limits, zero = robot.limits, np.zeros(len(robot.joint_names))
    return Joints(robot.joint_names, zero, zero, limits.lower, limits.upper, limits.velocity, limits.torque, zero, zero)


def write_urdf(robot: Robot, model: mujoco.MjModel, folder: Path) -> Path:
    files = mesh_files(model)
    for mesh, file in files.items():
        (folder / file).parent.mkdir(exist_ok=True)
        (folder / file).write_bytes(mesh_bytes(model, mesh))
    (folder / "robot.urdf").write_text(urdf(model, joints_of(robot), "toy", meshes=files))
    return folder / "robot.urdf"


@pytest.mark.parametrize("name", [pytest.param("hyq2max", marks=pytest.mark.slow), "wedged"])
def test_the_same_robot_gives_the_same_bytes_in_every_scene(name: str, wedged: Robot, tmp_path: Path) -> None:
    robot = wedged if name == "wedged" else load_robot(name)
    descriptions = set()
    for scene in SCENES:
        xml = model_xml(robot, scene, Physics())
        model = make_engine(robot, scene, Physics(), threads=1).model
        path = write_urdf(robot, model, tmp_path)
        alone = robot_alone(xml, robot.assets, robot.feet)
        descriptions.add((path.read_bytes(), *(f.read_bytes() for f in sorted(tmp_path.glob("meshes/*"))), alone))
    assert len(descriptions) == 1
    (description,) = descriptions
    read = mujoco.MjModel.from_xml_string(description[-1], dict(robot.assets))
    assert read.ngeom == robot.model.ngeom
    assert (read.nsensor, read.nlight, read.nhfield) == (robot.model.nsensor, 0, 0)
    assert read.nu == 2 * len(robot.joint_names)
    assert read.body_mass.sum() == pytest.approx(robot.mass, rel=1e-6)


def test_a_mesh_next_to_the_urdf_is_where_and_as_large_as_in_the_model(wedged: Robot, tmp_path: Path) -> None:
    """MuJoCo reads both; corners in the trunk's frame are compared."""
    model = make_engine(wedged, Scene(), Physics(), threads=1).model
    read = mujoco.MjModel.from_xml_path(str(write_urdf(wedged, model, tmp_path)))
    corners = []
    for of in (model, read):
        (geom,) = np.flatnonzero((of.geom_type == mujoco.mjtGeom.mjGEOM_MESH) & (of.geom_contype > 0))
        mesh = of.geom_dataid[geom]
        vertices = of.mesh_vert[of.mesh_vertadr[mesh] :][: of.mesh_vertnum[mesh]]
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, of.geom_quat[geom])
        placed = vertices @ turn.reshape(3, 3).T + of.geom_pos[geom]
        corners.append(np.unique(placed.round(5), axis=0))
    np.testing.assert_allclose(*corners, atol=2e-5)


def test_levade_reads_its_own_urdf_as_the_same_robot(wedged: Robot, tmp_path: Path) -> None:
    model = make_engine(wedged, Scene(), Physics(), threads=1).model
    again = load_robot(write_urdf(wedged, model, tmp_path))
    assert again.joint_names == wedged.joint_names
    assert again.mass == pytest.approx(wedged.mass, rel=1e-6)
    np.testing.assert_allclose(again.limits.lower, wedged.limits.lower, atol=1e-5)
    np.testing.assert_allclose(again.limits.torque, wedged.limits.torque)
    assert [leg.side + leg.end for leg in again.legs] == [leg.side + leg.end for leg in wedged.legs]


def test_every_joint_has_a_transmission(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "urdf", tmp_path)
    root = ElementTree.fromstring((tmp_path / "robot.urdf").read_text())
    for joint in rearing.joint_names:
        (transmission,) = [t for t in root.findall("transmission") if t.find(f"joint[@name='{joint}']") is not None]
        assert transmission.findtext("type") == "transmission_interface/SimpleTransmission"
        assert transmission.findtext("joint/hardwareInterface") == "hardware_interface/EffortJointInterface"
        assert transmission.findtext("actuator/mechanicalReduction") == "1"
    assert len(root.findall("transmission")) == len(rearing.joint_names)


def test_the_scene_of_an_export_replays_the_motion_to_the_bit(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "mjcf", tmp_path)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "mjcf/scene.xml"))
    state = mujoco.MjData(model)
    state.qpos[:], state.qvel[:], state.act[:] = rearing["qpos0"], rearing["qvel0"], rearing["act0"]
    for ctrl in rearing["ctrl"]:
        state.ctrl[:] = ctrl
        mujoco.mj_step(model, state)
    np.testing.assert_array_equal(state.qpos[:3], rearing["trunk_position"][-1])
    alone = mujoco.MjModel.from_xml_path(str(tmp_path / "mjcf/robot.xml"))
    assert (alone.nbody, alone.nu) == (model.nbody, model.nu)
    assert not (alone.geom_bodyid == 0).any()


def with_assets(motion: Motion, assets: Mapping[str, bytes]) -> Motion:
    return replace(motion, assets=assets)


@pytest.mark.parametrize("name", ["../evil.stl", "/tmp/evil.stl", "a\\b.stl", "C:/evil.stl", "robot.xml", "", "a\nb"])
def test_files_of_a_strangers_model_stay_in_the_folder(rearing: Motion, tmp_path: Path, name: str) -> None:
    with pytest.raises(LevadeError, match=r"motion: its model needs a file .*, which cannot be put next to it"):
        export(with_assets(rearing, {name: b"x"}), "mjcf", tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_files_of_a_model_lie_where_its_text_says(rearing: Motion, tmp_path: Path) -> None:
    as_mjcf.check(with_assets(rearing, {"deep/wedge.stl": b"x"}))
    export(with_assets(rearing, {"deep/wedge.stl": b"x"}), "mjcf", tmp_path)
    assert (tmp_path / "mjcf/deep/wedge.stl").read_bytes() == b"x"
