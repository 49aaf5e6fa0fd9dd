"""``levade export``: what it writes where, what it prints, and what it says of wrong input."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from levade.checks import Demands
from levade.exports import FORMATS
from levade.motions import Motion


@pytest.fixture
def motion(unmet: Path) -> Path:
    return unmet / "motion.npz"


@pytest.mark.slow
@pytest.mark.parametrize("to", FORMATS)
def test_it_prints_what_was_written(motion: Path, tmp_path: Path, levade, to: str) -> None:
    if to == "ros2":
        pytest.importorskip("mcap", reason="a bag needs mcap: pip install 'levade[ros2]'")
    status, out, err = levade("export", motion, "--to", to, "--out", tmp_path / to, "--json")
    assert (status, err, out.count("\n")) == (0, "", 1)
    content = json.loads(out)
    assert content["format"] == to
    assert sorted(content["written"]) == sorted(str(p) for p in (tmp_path / to).rglob("*") if p.is_file())
    assert content["rate"] == {"mjlab": 50.0}.get(to, 500.0)
    assert content["rows"] == round(0.3 * content["rate"]) + 1
    assert len(content["joints"]) == 12
    assert content["notes"][0] == "the motion does not meet its success criteria"
    assert Path(tmp_path / to / "player.py").read_text().startswith("#!/usr/bin/env python3\n")
    status, out, err = levade("export", motion, "--to", to, "--out", tmp_path / to)
    assert (status, err) == (0, "")
    assert "rows at" in out
    assert "player.py" in out


def test_it_writes_beside_the_motion_and_records_the_command(motion: Path, tmp_path: Path, levade) -> None:
    (tmp_path / "my run").mkdir()
    copy = tmp_path / "my run" / "motion.npz"
    copy.write_bytes(motion.read_bytes())
    status, out, _ = levade(
        *("export", "my run/motion.npz", "--to", "csv", "--rate", 250, "--reference", "commanded", "--no-hold")
    )
    assert status == 0
    assert "Written to my run/motion-csv: meta.json, motion.csv, player.py" in out
    meta = json.loads((tmp_path / "my run" / "motion-csv" / "meta.json").read_text())
    command = "levade export 'my run/motion.npz' --to csv --rate 250 --reference commanded --no-hold"
    assert meta["provenance"]["command"] == command
    assert meta["rate"] == 250.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--to", "cvs"], "--to: no format 'cvs'; did you mean csv?"),
        (["--to", "sdf"], "--to: no format 'sdf'; valid names: csv, json, mjcf, mjlab, ros2, unitree, urdf"),
        ([], "no format given; add --to csv, json, ros2, mjlab, unitree, urdf, mjcf"),
        (["--to", "csv", "--out", "x.csv"], "--out x.csv: the export has several files; give a directory, such as x"),
        (["--to", "csv", "--rate", "0"], "--rate: 0.0 should be a positive number of rows per second"),
        (["--to", "csv", "--rate", "fast"], "Invalid value for '--rate'"),
        (["--to", "csv", "--reference", "both"], "--reference: no reference 'both'; valid names: commanded, measured"),
        (["--to", "csv", "--kp", "60", "--reference", "commanded"], "--kp: commanded references only make"),
        (["--to", "csv", "--kd", "-1"], "--kd: -1.0 should be a number that is not negative"),
        (["--to", "csv", "--out", "/dev/null/x"], "/dev/null/x: cannot be written (Not a directory)"),
        (["--to", "csv", "--out", "/proc/x"], "/proc/x: cannot be written"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(
    motion: Path,
    tmp_path: Path,
    levade,
    options: list[str],
    message: str,
) -> None:
    before = sorted(path.name for path in motion.parent.iterdir())
    status, out, err = levade("export", motion, *options)
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
    assert sorted(path.name for path in motion.parent.iterdir()) == before


def test_what_is_no_motion(tmp_path: Path, levade) -> None:
    status, _, err = levade("export", tmp_path / "none.npz", "--to", "csv")
    assert status == 2
    assert "no such file; give the motion.npz that levade solve wrote" in err
    assert levade("export")[0] == 2


def certificate(path: Path, motion: Path, **content: object) -> Path:
    usual = {"passed": True, "demands": asdict(Demands()), "perturbed": {"runs": 500}}
    path.write_text(json.dumps({**usual, "checksum": Motion.load(motion).checksum, **content}))
    return path


def test_a_certificate_that_is_asked_for_has_to_pass(motion: Path, tmp_path: Path, levade) -> None:
    failing = certificate(tmp_path / "fails.json", motion, passed=False, failed=["speed"])
    status, _, err = levade("export", motion, "--to", "csv", "--out", "out", "--certificate", failing)
    assert status == 2
    assert f"--certificate {failing}: it fails speed; nothing is written" in err
    assert not (tmp_path / "out").exists()
    status, _, err = levade("export", motion, "--to", "csv", "--out", "out", "--certificate", "none.json")
    assert (status, err.count("\n")) == (2, 1)
    passing = certificate(tmp_path / "passes.json", motion)
    status, out, _ = levade("export", motion, "--to", "csv", "--out", "out", "--certificate", passing)
    assert status == 0
    assert "no certificate" not in out


@pytest.mark.slow
def test_motions_for_robots_without_a_certificate_beside_them_are_remarked_on(
    motion: Path, tmp_path: Path, levade
) -> None:
    copy = tmp_path / "motion.npz"
    copy.write_bytes(motion.read_bytes())

    def notes(to: str) -> list[str]:
        _, out, _ = levade("export", copy, "--to", to, "--out", tmp_path / to, "--json")
        return [note for note in json.loads(out)["notes"] if "certificate" in note]

    assert notes("mjcf") == []
    assert "levade check" in notes("unitree")[0]
    certificate(tmp_path / "certificate.json", motion, checksum="0")
    assert "it belongs to another motion" in notes("csv")[0]
    certificate(tmp_path / "certificate.json", motion)
    assert notes("csv") == []
