"""Files: their kind is told by what they hold, their encoding by their bytes, and meshes are where MuJoCo finds them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.robots.meshes import stl

CASES = Path(__file__).parent / "cases"
TRUNK = '<geom name="trunk" type="box" size="0.2 0.04 0.05"/>'
POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:" + b"ab" * 32 + b"\nsize 482384\n"


def tetrahedron(path: Path, size: float) -> bytes:
    corners = size * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    path.parent.mkdir(parents=True, exist_ok=True)
    content = stl(corners[[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]])
    path.write_bytes(content)
    return content


def findings(robot: Robot, kind: str) -> list[str]:
    """Without the one that every MJCF has, which knows no speed limits."""
    of_kind = [str(finding) for finding in robot.findings if finding.kind == kind]
    return [finding for finding in of_kind if "no speed limit; " not in finding]


@pytest.mark.parametrize("name", ["latin1", "gb-declared-but-utf8"])
def test_an_encoding_is_that_of_the_bytes(name: str) -> None:
    robot = load_robot(CASES / "encoding" / f"{name}.urdf")
    assert (robot.mass, len(robot.joint_names)) == (pytest.approx(12.4), 12)


@pytest.mark.slow
@pytest.mark.parametrize("form", ["urdf", "mjcf"])
@pytest.mark.parametrize(
    ("codec", "declared"),
    [
        ("utf-8", ""),
        ("utf-8-sig", ""),
        ("utf-16", "utf-16"),
        ("utf-16-le", ""),
        ("utf-32", ""),
        ("gb2312", "gb2312"),
        ("shift_jis", "Shift_JIS"),
        ("cp1252", "windows-1252"),
        ("utf-8", "klingon"),
        ("utf-8", "ascii"),
        ("latin-1", ""),
    ],
)
def test_a_robot_is_the_same_in_every_encoding(
    tmp_path: Path, quadruped: type, form: str, codec: str, declared: str
) -> None:
    word = "für" if codec in ("cp1252", "latin-1") else "四足"
    name = word if form == "mjcf" else "trunk"  # MuJoCo names what it makes of a URDF
    text = getattr(quadruped(), form)().replace('body name="trunk"', f'body name="{name}"')
    encoding = f' encoding="{declared}"' if declared else ""
    path = tmp_path / ("toy.urdf" if form == "urdf" else "toy.xml")
    path.write_bytes(f'<?xml version="1.0"{encoding}?>\n<!-- {word} -->\n{text}'.encode(codec))
    robot = load_robot(path)
    assert (robot.trunk, len(robot.joint_names)) == (name, 12)


@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"<mujoco>\x00</mujoco>", b"\x89PNG\r\n\x1a\n\0"])
def test_what_is_no_text_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "toy.urdf").write_bytes(content)
    with pytest.raises(LevadeError, match=r"toy\.urdf: (not a text file|is empty)"):
        load_robot(tmp_path / "toy.urdf")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["toy.mjcf", "toy.XML", "toy.urdf", "toy.txt", "toy", "robot.yaml"])
@pytest.mark.parametrize("form", ["urdf", "mjcf"])
def test_a_model_is_told_by_its_root_element(tmp_path: Path, quadruped: type, form: str, name: str) -> None:
    (tmp_path / name).write_text(getattr(quadruped(), form)())
    assert len(load_robot(tmp_path / name).joint_names) == 12


@pytest.mark.slow
def test_an_mjcf_of_another_name_keeps_its_includes_and_meshes(tmp_path: Path, quadruped: type) -> None:
    """Also where a part that it includes has another encoding."""
    shell = tetrahedron(tmp_path / "parts" / "shell.stl", 0.1)
    (tmp_path / "more").mkdir()
    asset = '<mujoco><asset><!-- {} --><mesh name="shell" file="shell.stl"/></asset></mujoco>'
    text = (
        quadruped()
        .mjcf()
        .replace('angle="radian"/>', 'angle="radian" meshdir="parts"/><include file="more/asset.xml"/>')
    )
    text = text.replace(TRUNK, TRUNK + '<geom type="mesh" mesh="shell"/>').replace(
        "<mujoco ", '<!-- <include file="more/gone.xml"/> --><mujoco '
    )
    for name, encoding in (("toy.mjcf", "utf-8"), ("toy.xml", "latin-1")):
        (tmp_path / "more" / "asset.xml").write_bytes(asset.format("für").encode(encoding))
        (tmp_path / name).write_text(text)
        assert load_robot(tmp_path / name).assets == {"shell.stl": shell}


def test_the_example_of_another_suffix() -> None:
    assert load_robot(CASES / "ext2" / "pup.mjcf").mass == pytest.approx(12.4)


def test_a_xacro_file_is_named_as_such_and_not_printed() -> None:
    with pytest.raises(LevadeError, match="still contains xacro macros; expand them first: xacro") as caught:
        load_robot(CASES / "formats" / "pup.urdf.xacro")
    assert len(str(caught.value)) < 300


def test_other_xml_is_refused(tmp_path: Path) -> None:
    (tmp_path / "toy.sdf").write_text("<sdf version='1.6'><model name='x'/></sdf>")
    with pytest.raises(LevadeError, match="starts with <sdf>; a URDF starts with <robot>, an MJCF with <mujoco>"):
        load_robot(tmp_path / "toy.sdf")


def test_a_pointer_of_git_lfs_is_named_with_its_remedy(tmp_path: Path) -> None:
    robot = load_robot(CASES / "meshfiles" / "lfs-stl-visual.urdf")
    assert findings(robot, "warning") == []
    assert "thigh.stl is a git-lfs pointer, not the file itself: git lfs pull fetches it" in findings(robot, "note")[0]
    (tmp_path / "toy.urdf").write_bytes(POINTER)
    with pytest.raises(LevadeError, match="it is a git-lfs pointer, not the file itself: git lfs pull"):
        load_robot(tmp_path / "toy.urdf")


@pytest.mark.slow
@pytest.mark.parametrize("content", [POINTER, b"solid nothing\nendsolid\n", b"", b"\0" * 200, b"v 1 2\nf 1 2 3\n"])
@pytest.mark.parametrize("suffix", [".stl", ".obj", ".msh"])
def test_a_visual_mesh_that_cannot_be_read_stops_nothing(
    tmp_path: Path, quadruped: type, content: bytes, suffix: str
) -> None:
    (tmp_path / f"shell{suffix}").write_bytes(content)
    visual = '<geom type="mesh" mesh="shell" contype="0" conaffinity="0"/>'
    mjcf = quadruped().mjcf().replace(TRUNK, TRUNK + visual)
    mjcf = mjcf.replace("<worldbody>", f'<asset><mesh name="shell" file="shell{suffix}"/></asset><worldbody>')
    (tmp_path / "toy.xml").write_text(mjcf)
    visual = f'<visual><geometry><mesh filename="shell{suffix}"/></geometry></visual><collision>'
    (tmp_path / "toy.urdf").write_text(quadruped().urdf().replace("<collision>", visual, 1))
    for name in ("toy.xml", "toy.urdf"):
        robot = load_robot(tmp_path / name)
        assert robot.model.nmesh == 0
        assert findings(robot, "warning") == []
        (said,) = [note for note in findings(robot, "note") if "trunk: not shown as" in note]
        assert f"shell{suffix}" in said or "shell" in said


def test_a_skin_stops_nothing(tmp_path: Path, quadruped: type) -> None:
    skin = '<asset><skin name="fur" file="gone.skn"/></asset><worldbody>'
    (tmp_path / "toy.xml").write_text(quadruped().mjcf().replace("<worldbody>", skin))
    assert load_robot(tmp_path / "toy.xml").model.nskin == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bare", "package"])
def test_a_urdf_may_say_where_mujoco_finds_its_meshes(name: str) -> None:
    robot = load_robot(CASES / "urdf-meshdir" / "urdf" / f"{name}.urdf")
    assert findings(robot, "warning") == []
    mesh = (CASES / "urdf-meshdir" / "meshes" / "thigh.stl").read_bytes()
    assert list(robot.assets.values()) == [mesh]
    geoms = [g for g in range(robot.model.ngeom) if robot.model.geom_dataid[g] >= 0]
    assert len(geoms) == 8
    assert sum(bool(robot.model.geom_contype[g]) for g in geoms) == 4


@pytest.mark.slow
def test_a_mesh_that_is_nowhere_is_missing() -> None:
    robot = load_robot(CASES / "urdf-meshdir" / "urdf" / "deep.urdf")
    assert "collides as primitives only: thigh.stl is missing" in findings(robot, "warning")[0]


@pytest.mark.slow
def test_an_attached_model_keeps_its_folder_of_meshes(tmp_path: Path) -> None:
    """Two parts of one name in two folders; also where the model lies in a folder of its own."""
    shutil.copytree(CASES / "mjcf" / "att", tmp_path / "same")
    tetrahedron(tmp_path / "same" / "assets" / "vis" / "part.stl", 0.03)
    collision = tetrahedron(tmp_path / "same" / "assets" / "col" / "part.stl", 0.02)
    shutil.copytree(tmp_path / "same", tmp_path / "apart" / "parts")
    text = (tmp_path / "same" / "pup.xml").read_text()
    (tmp_path / "apart" / "pup.xml").write_text(text.replace('file="leg.xml"', 'file="parts/leg.xml"'))
    for folder in ("same", "apart"):
        robot = load_robot(tmp_path / folder / "pup.xml")
        assert not [said for said in findings(robot, "warning") + findings(robot, "note") if "missing" in said]
        spec = robot.spec()
        colliding = {geom.meshname for geom in spec.geoms if geom.meshname and geom.contype}
        assert {robot.assets[spec.mesh(name).file] for name in colliding} == {collision}
        assert len(colliding) == 4


def test_what_an_mjcf_lacks_is_said_once(tmp_path: Path, quadruped: type) -> None:
    text = quadruped().mjcf().replace("<worldbody>", '<asset><mesh name="m" file="gone.stl"/></asset><worldbody>')
    for leg in ("lf", "rf", "lh", "rh"):
        foot = f'<geom name="{leg}_foot"'
        text = text.replace(
            foot, f'<geom type="mesh" mesh="m"/><geom type="mesh" mesh="m" contype="0" conaffinity="0"/>{foot}'
        )
    (tmp_path / "toy.xml").write_text(text)
    robot = load_robot(tmp_path / "toy.xml")
    shanks = "bodies lf_shank, rf_shank, lh_shank, rh_shank"
    assert findings(robot, "warning") == [
        f"{shanks}: collide as their other geoms only, missing: gone.stl; put the file where it says"
    ]
    assert f"{shanks}: not shown as meshes, missing: gone.stl" in findings(robot, "note")


@pytest.mark.parametrize("hidden", ["&#27;[31m", "&#10;", "\x1b[31m", "\x9b31m", "\u202e"])
def test_names_that_a_terminal_would_obey_are_refused(tmp_path: Path, hidden: str) -> None:
    text = (CASES / "pairs" / "pup.xml").read_text(encoding="utf-8").replace('"FL_hip"', f'"FL{hidden}hip"')
    (tmp_path / "pup.xml").write_text(text, encoding="utf-8")
    with pytest.raises(
        LevadeError, match=r"pup\.xml: names contain control characters, which no terminal can show"
    ) as told:
        load_robot(tmp_path / "pup.xml")
    assert str(told.value).isprintable()
    (tmp_path / "pup\x1b[2J.xml").write_bytes((CASES / "pairs" / "pup.xml").read_bytes())
    with pytest.raises(LevadeError, match="its name holds control characters"):
        load_robot(tmp_path / "pup\x1b[2J.xml")


def test_a_text_about_something_else_is_said_to_be_no_robot(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("# Pup\n\nupstream: elsewhere\n", encoding="utf-8")
    with pytest.raises(LevadeError, match=r"README\.md: is no URDF, MJCF or robot\.yaml; give one of them"):
        load_robot(tmp_path / "README.md")
