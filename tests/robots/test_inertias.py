"""Inertias of plates and rods, at the edge of what a body can have: taken as the file gives them, to its own precision."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.robots.inertias import lifted

CASES = Path(__file__).parent / "cases"
KEYS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def warnings(robot: Robot) -> list[str]:
    return [str(finding) for finding in robot.findings if finding.kind == "warning"]


def rotation(numbers: np.ndarray) -> np.ndarray:
    """(3, 3), from a vector that is turned into a unit quaternion."""
    w, (x, y, z) = 1.0, numbers
    n = np.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])  # fmt: skip


def six(tensor: np.ndarray) -> list[float]:
    return [float(tensor[k]) for k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]


def urdf(text: str, tensor: np.ndarray, digits: int) -> str:
    inertia = " ".join(f'{key}="{value:.{digits}g}"' for key, value in zip(KEYS, six(tensor), strict=True))
    old = 'ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"'
    assert old in text
    return text.replace(old, inertia)


def mjcf(text: str, tensor: np.ndarray, digits: int) -> str:
    inertia = " ".join(f"{value:.{digits}g}" for value in six(tensor))
    old = 'diaginertia="0.1 0.1 0.1"'
    assert old in text
    return text.replace(old, f'fullinertia="{inertia}"', 1)


def test_the_example_of_a_plate() -> None:
    robot = load_robot(CASES / "plate" / "full.urdf")
    assert warnings(robot) == []
    tensor = np.array([[0.03, 0.012, 0], [0.012, 0.11, 0], [0, 0, 0.14]])
    moments = sorted(robot.model.body("base").inertia)
    np.testing.assert_allclose(moments, np.linalg.eigvalsh(tensor), rtol=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("digits", [3, 4, 6, 17])
@pytest.mark.parametrize("share", [0.0, 0.02, 0.3, 0.5])
def test_plates_and_rods_are_taken_however_they_lie(tmp_path: Path, quadruped: type, share: float, digits: int) -> None:
    """share: of the smallest moment in the largest; 0 is a rod, whose two other moments are equal."""
    random = np.random.default_rng(round(100 * share) + digits)
    size, folder = float(np.exp(random.uniform(-11, 2))), tmp_path
    matrix = rotation(random.normal(size=3))
    tensor = matrix @ np.diag([share * size, (1 - share) * size, size]) @ matrix.T
    (folder / "toy.urdf").write_text(urdf(quadruped().urdf(), tensor, digits))
    (folder / "toy.xml").write_text(mjcf(quadruped().mjcf(), tensor, digits))
    for name in ("toy.urdf", "toy.xml"):
        robot = load_robot(folder / name)
        assert not [said for said in warnings(robot) if "inertia" in said]
        moments = np.array(sorted(robot.model.body("trunk").inertia))
        np.testing.assert_allclose(moments, [share * size, (1 - share) * size, size], atol=0.03 * size)
        robot.spec().compile()


@pytest.mark.parametrize(
    "shape", ["0.0123456 0.0234567 0.0358023", "0.0123 0.0123 0.0247", "1.2345678e-5 2.3456789e-5 3.5802467e-5"]
)
def test_diagonal_inertias_of_an_mjcf_too(tmp_path: Path, quadruped: type, shape: str) -> None:
    text = quadruped().mjcf().replace('diaginertia="0.1 0.1 0.1"', f'diaginertia="{shape}"')
    (tmp_path / "toy.xml").write_text(text)
    moments = sorted(load_robot(tmp_path / "toy.xml").model.body("trunk").inertia)
    np.testing.assert_allclose(moments, [float(value) for value in shape.split()], rtol=0.01)


def test_a_plate_beside_an_arm_that_is_held(tmp_path: Path, quadruped: type) -> None:
    """An MJCF whose joints are held goes through text once more."""
    arm = ('<body name="arm"><joint name="swing" axis="0 1 0"/><inertial mass="0.5" pos="0.1 0 0"'
           ' fullinertia="0.0311111 0.1222222 0.1533333 0.0123456 0 0"/></body>')  # fmt: skip
    trunk = '<geom name="trunk" type="box" size="0.2 0.04 0.05"/>'
    (tmp_path / "toy.xml").write_text(quadruped().mjcf().replace(trunk, trunk + arm))
    assert load_robot(tmp_path / "toy.xml").model.body("arm").mass[0] == pytest.approx(0.5)


@pytest.mark.parametrize(
    "moments", [(0.01, 0.01, 0.05), (-0.02, 0.02, 0.03), (0.0, 0.0, 0.1), (0.0, 0.0, 0.0), (1.0, 1.0, np.inf)]
)
def test_what_rounding_does_not_explain_is_not_lifted(moments: tuple[float, float, float]) -> None:
    assert lifted(np.diag(moments)) is None


def test_what_is_clear_of_the_edge_stays() -> None:
    tensor = np.diag([0.01, 0.02, 0.029])
    assert lifted(tensor) is tensor


def test_no_exception_but_ours_leaves_the_model(quadruped: type, tmp_path: Path) -> None:
    from dataclasses import replace

    (tmp_path / "toy.urdf").write_text(quadruped().urdf())
    robot = load_robot(tmp_path / "toy.urdf")
    with pytest.raises(LevadeError, match="robot toy: "):
        _ = replace(robot, mjcf=robot.mjcf.replace('mass="6"', 'mass="-6"')).model
