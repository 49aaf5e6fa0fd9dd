"""Tasks on robots that they were not written for: what differs there, or why they do not apply."""

from __future__ import annotations

from pathlib import Path

import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.tasks import load_task


@pytest.fixture(scope="module")
def toy(tmp_path_factory: pytest.TempPathFactory, quadruped: type) -> Robot:
    """A quadruped whose joints have other names than HyQ2Max's."""
    path = tmp_path_factory.mktemp("toy") / "toy.urdf"
    path.write_text(quadruped().urdf().replace("_haa", "_a").replace("_hfe", "_b").replace("_kfe", "_c"))
    return load_robot(path)


@pytest.mark.parametrize(
    ("name", "where"),
    [
        ("levade", r"policy\.goal: \?h_haa"),
        ("levade-robust", r"policy\.goal: \?h_haa"),
        ("posture-recovery", r"start\.fall\.posture: \*_haa"),
        ("posture-recovery-slow", r"start\.fall\.posture: \*_haa"),
        ("posture-recovery-robust", r"start\.fall\.posture: \*_haa"),
    ],
)
def test_a_task_with_postures_of_one_robot_says_that_it_does_not_apply_to_others(
    toy: Robot, name: str, where: str
) -> None:
    said = rf"^{name}: does not apply to toy: its postures are angles of hyq2max's joints \({where}\); give it postures of toy"
    with pytest.raises(LevadeError, match=said) as raised:
        load_task(name, robot=toy)
    assert "\n" not in str(raised.value)


def test_it_applies_with_postures_of_the_other_robot(toy: Robot, tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(
        "name: own\nextends: posture-recovery\nrobot: {name: go1}\npolicy: {goal: {'*_c': -1.1}}\n"
        "start: {fall: {height: 0.4, posture: {hind: crouched, 'lf_a': 0.1}}}\n"
    )
    task = load_task(path, robot=toy)
    assert task.policy.goal == {"*_c": -1.1}
    changes = ["start.fall.posture=crouched", "policy.goal=neutral"]
    assert load_task("posture-recovery", robot=toy, changes=changes).policy.goal == "neutral"
    typo = load_task("squat-jump", robot=toy, changes=["start.settled.posture={lf_haa: 0.1}"])
    assert typo.start.settled is not None  # the engine says what is wrong with it
    with pytest.raises(LevadeError, match=r"own: does not apply to hyq2max: its postures are angles of go1's joints"):
        load_task(path, robot="hyq2max")
