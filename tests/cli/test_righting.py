"""``levade robots rightability``: what it prints, draws and refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("scipy", reason="hulls need scipy: pip install 'levade[rightability]'")


@pytest.mark.slow
def test_it_is_said_in_words_and_as_json(levade, urdf: Path) -> None:
    pytest.importorskip("matplotlib", reason="maps need matplotlib: pip install 'levade[figures]'")
    words = ("robots", "rightability", "toy.urdf", "--angles", 3, "--slope", 0, "--slope", 20)
    status, out, err = levade(*words)
    assert (status, err) == (0, "")
    assert "On flat ground" in out
    assert "By slope" in out
    status, out, err = levade(*words, "--json", "--map", "map.png")
    assert (status, err) == (0, "")
    content = json.loads(out)
    assert content["written"] == ["map.png"]
    assert (urdf.parent / "map.png").read_bytes()[1:4] == b"PNG"
    assert [slope["slope"] for slope in content["slopes"]] == [0.0, pytest.approx(20.0)]
    assert content["dynamic"] is None
    flat = content["slopes"][0]
    assert sum(pose["likelihood"] for pose in flat["poses"]) == pytest.approx(1.0)
    for shares in (flat["neutral"], flat["any"]):
        assert shares["all"]["likelihood"] == pytest.approx(1.0)
        parts = [share["likelihood"] for name, share in shares.items() if name != "all"]
        assert sum(parts) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--slope", 50), "--slope is 50; should be from 0 to 45 degrees"),
        (("--slope", "nan"), "--slope is nan; should be from 0 to 45 degrees"),
        (("--angles", 0), "--angles: is 0; should be from 1 to 100"),
        (("--map", "map.txt"), "--map: map.txt: should end in .png, .svg or .pdf"),
        (("--library", "nowhere"), "nowhere"),
    ],
)
def test_wrong_input_is_refused_in_one_line(levade, urdf: Path, options: tuple[object, ...], said: str) -> None:
    status, out, err = levade("robots", "rightability", "toy.urdf", *options)
    assert (status, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1
