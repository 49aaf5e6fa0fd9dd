"""``levade stabilise``: exit status, JSON, and what ``check`` then says."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import pytest

from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.stabilisers import stabilise
from levade.tasks import load_task


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    changes = ["success.pitch.tolerance=0.02", "success.height.tolerance=0.05", "search.settings={finish: 0}"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    path = tmp_path_factory.mktemp("stabilise") / "motion.npz"
    record(objective, solve(objective, seed=2), seed=2).save(path)
    return path


@pytest.mark.golden
@pytest.mark.slow
def test_it_writes_a_motion_that_a_check_knows_as_stabilised(motion: Path, levade) -> None:
    code, out, err = levade("stabilise", str(motion), "--runs", "32", "--json")
    content = json.loads(out)
    assert (code, err) == (0, "")
    assert content["share"] > content["open_loop"]
    written = Path(content["written"])
    assert written == motion.with_name("motion-stabilised.npz")
    assert Motion.load(written).feedback is not None
    _, out, _ = levade("check", str(written), "--runs", "40", "--out", "check.json")
    checked = json.loads(Path("check.json").read_text())
    assert checked["open_loop"]["runs"] == checked["perturbed"]["runs"] == 40
    assert checked["perturbed"]["successes"] > checked["open_loop"]["successes"]
    assert "without the stabiliser" in out


@pytest.mark.golden
@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_search_that_is_stopped_keeps_its_best(motion: Path, tmp_path: Path, process, number: signal.Signals) -> None:
    """The real thing: a signal while the second design is tried."""
    written = tmp_path / "kept.npz"
    stabilising = process("stabilise", motion, "--threads=1", "--runs=32", f"--out={written}")
    assert stabilising.stdout is not None
    told = [stabilising.stdout.readline() for _ in range(2)]
    assert told[0].strip().startswith("no feedback:")
    stabilising.send_signal(number)
    out, err = stabilising.communicate(timeout=100)
    assert (stabilising.returncode, err) == (0, "")
    count = 1 + sum(line.strip().startswith("corrections of") for line in out.splitlines())
    assert f"Interrupted after {count} design{'s' * (count > 1)}: the best is kept." in out
    assert count < 6
    kept = Motion.load(written)
    assert kept.feedback is not None
    assert kept.meta["feedback"]["runs"] == 32


@pytest.mark.slow
def test_before_the_first_design_there_is_nothing_to_keep(motion: Path) -> None:
    found = stabilise(Motion.load(motion), runs=8, threads=1, stopping=lambda: True)
    assert (found.interrupted, found.design, found.tried) == (True, None, {})
    assert found.motion.feedback is None


@pytest.mark.slow
def test_a_motion_that_nothing_disturbs_is_left_alone(motion: Path, tmp_path: Path, levade) -> None:
    from dataclasses import fields

    from levade.engines import Perturbation

    still = [word for one in fields(Perturbation) for word in ("--perturb", f"{one.name}=null")]
    out_file = tmp_path / "none.npz"
    code, out, err = levade("stabilise", str(motion), "--runs", "8", "--out", str(out_file), *still)
    assert (code, err) == (1, "")
    assert "nothing is written" in out
    assert not out_file.exists()


@pytest.mark.slow
def test_mistakes_are_one_line(unmet: Path, levade) -> None:
    motion = unmet / "motion.npz"
    for words, message in (
        (["--bound", "9"], "--bound: 9 should be more than 0"),
        (["--out", "/nowhere/motion.npz"], "/nowhere/motion.npz: no such directory"),
        (["--out", "."], "--out .: is a directory; give a file in it, such as motion-stabilised.npz"),
        (["--out", str(motion)], "is the motion itself; give another file, or leave it out"),
        (["--perturb", "frction=[1,1]"], "friction"),
    ):
        code, out, err = levade("stabilise", str(motion), *words)
        assert (code, out) == (2, "")
        assert message in err
        assert err.count("\n") == 1
