"""Numbers that nothing simulates are refused by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from levade.errors import LevadeError
from levade.robots import load_robot


@pytest.mark.parametrize("value", ["inf", "1e300", "1e11"])
@pytest.mark.parametrize(
    ("kind", "text", "said"),
    [
        ("urdf", 'ixx="0.1"', "link trunk: "),
        ("urdf", 'ixy="0"', "link trunk: "),
        ("urdf", 'mass value="6.0"', "link trunk: mass"),
        ("urdf", 'damping="0.1"', "joint lf_haa: damping "),
        ("mjcf", 'mass="6.0"', "body trunk: mass "),
        ("mjcf", 'damping="0.1"', "joint lf_haa: damping "),
        ("mjcf", 'pos="0 0 0.4"', "body trunk: position "),
    ],
)
def test_numbers_beyond_what_can_be_simulated(
    tmp_path: Path, quadruped, kind: str, text: str, said: str, value: str
) -> None:
    content = getattr(quadruped(), kind)()
    assert text in content
    old = text.split('"')[1]
    path = tmp_path / f"robot.{'urdf' if kind == 'urdf' else 'xml'}"
    path.write_text(content.replace(text, text.replace(old, f"{value} 0 0" if "pos" in text else value), 1))
    with pytest.raises(LevadeError, match=said):
        load_robot(path)
