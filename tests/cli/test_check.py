"""``levade check``: exit status, JSON as the contract has it, mistakes in one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from levade.cli import main
from levade.motion import record
from levade.solve import Objective, solve
from levade.tasks import load_task


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    changes = [
        "success={height: {target: 0.5743, tolerance: 3 cm}, pitch: {target: 0, tolerance: 0.1}}",
        *("search.population=4", "search.trials=4", "search.step=1e-9"),
    ]
    objective = Objective(load_task("rearing", changes=changes), threads=1)
    path = tmp_path_factory.mktemp("check") / "motion.npz"
    record(objective, solve(objective, seed=0), seed=0).save(path)
    return path


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as caught:
        main(["check", *arguments])
    captured = capsys.readouterr()
    return int(caught.value.code or 0), captured.out, captured.err


def test_a_motion_that_meets_every_demand_passes(motion: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, str(motion), "--runs", "40", "--json")
    content = json.loads(out)
    assert (code, err) == (0, "")
    assert content["passed"] is True
    assert content["failed"] == []
    assert {"passed", "perturbed", "numerics", "engines", "margins"} <= set(content)
    found = content["perturbed"]
    assert {"runs", "successes", "share", "low", "high"} <= set(found)
    assert (found["runs"], found["successes"], found["share"]) == (40, 40, 1.0)
    assert 0.9 < found["low"] < 1.0


def test_a_motion_that_does_not_fails_and_says_in_what(
    motion: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wide = tmp_path / "wide.yaml"
    wide.write_text("ground_height: [-10 cm, 10 cm]\nfriction: null\n", encoding="utf-8")
    written = tmp_path / "certificate.json"
    code, out, _ = run(
        capsys,
        *(str(motion), "--runs", "40", "--perturb", str(wide), "--demand", "speed=0.99999", "--out", str(written)),
    )
    assert code == 1
    assert "Fails: perturbed, speed" in out
    assert "ground_height" in out
    content = json.loads(written.read_text(encoding="utf-8"))
    assert content["failed"] == ["perturbed", "speed"]
    assert content["perturbed"]["sensitivity"][0]["parameter"] == "ground_height"
    assert "friction" not in [one["parameter"] for one in content["perturbed"]["sensitivity"]]


def test_another_tasks_criteria_can_be_used(motion: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, str(motion), "--runs", "4", "--criteria", "rearing", "--json")
    content = json.loads(out)
    assert code == 1
    assert content["criteria"] == "rearing"
    assert set(content["perturbed"]["errors"]) == {"pitch", "height"}
    assert content["perturbed"]["successes"] == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--perturb", "frction=[1, 2]"], "no 'frction'; did you mean friction?"),
        (["--perturb", "nowhere.yaml"], "nowhere.yaml: no such file; give a YAML file, or name=value"),
        (["--perturb", "friction=[2, 1]"], "perturb.friction: [2.0, 1.0] should be [lowest, highest]"),
        (["--perturb", "friction=3"], "perturb.friction: should be"),
        (["--perturb", "com=[-1 s, 1 s]"], "perturb.com.0: '-1 s' is a duration, but this is a length"),
        (["--demand", "share=2"], "demand.share: 2.0 should be a share"),
        (["--runs", "0"], "check: 0 runs; 1 or more"),
        (["--criteria", "rearin"], "no task 'rearin'; did you mean rearing?"),
    ],
)
def test_mistakes_are_one_line_and_exit_status_2(
    arguments: list[str], message: str, motion: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = run(capsys, str(motion), *arguments)
    assert (code, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1
