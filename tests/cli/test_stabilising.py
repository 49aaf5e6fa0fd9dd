"""``levade stabilise``: exit status, JSON, and what ``check`` then says."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from levade.cli import main
from levade.motion import Motion, record
from levade.solve import Objective, solve
from levade.tasks import load_task


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    changes = ["success.pitch.tolerance=0.02", "success.height.tolerance=0.05"]
    objective = Objective(load_task("rearing", changes=changes), threads=1)
    path = tmp_path_factory.mktemp("stabilise") / "motion.npz"
    record(objective, solve(objective, seed=0), seed=0).save(path)
    return path


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    captured = capsys.readouterr()
    return int(caught.value.code or 0), captured.out, captured.err


@pytest.mark.slow
def test_it_writes_a_motion_that_a_check_knows_as_stabilised(motion: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, "stabilise", str(motion), "--runs", "32", "--json")
    content = json.loads(out)
    assert (code, err) == (0, "")
    assert content["share"] > content["open_loop"]
    written = Path(content["written"])
    assert written == motion.with_name("motion-stabilised.npz")
    assert Motion.load(written).feedback is not None
    _, out, _ = run(capsys, "check", str(written), "--runs", "40", "--json")
    checked = json.loads(out)
    assert checked["open_loop"]["runs"] == checked["perturbed"]["runs"] == 40
    assert checked["perturbed"]["successes"] > checked["open_loop"]["successes"]
    _, out, _ = run(capsys, "check", str(written), "--runs", "8")
    assert "without the stabiliser" in out


def test_a_motion_that_nothing_disturbs_is_left_alone(
    motion: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from dataclasses import fields

    from levade.engines import Perturbation

    still = [word for one in fields(Perturbation) for word in ("--perturb", f"{one.name}=null")]
    out_file = tmp_path / "none.npz"
    code, out, err = run(capsys, "stabilise", str(motion), "--runs", "8", "--out", str(out_file), *still)
    assert (code, err) == (1, "")
    assert "nothing is written" in out
    assert not out_file.exists()


def test_mistakes_are_one_line(motion: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words, message in (
        (["--bound", "9"], "--bound 9"),
        (["--out", "/nowhere/motion.npz"], "/nowhere/motion.npz: no such directory"),
        (["--perturb", "frction=[1,1]"], "friction"),
    ):
        code, out, err = run(capsys, "stabilise", str(motion), *words)
        assert (code, out) == (2, "")
        assert message in err
        assert err.count("\n") == 1
