"""What the built-in tasks say of themselves without their robots, and what happens where a robot's package is missing."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest

from levade.cli import main
from levade.robots import Robot, missing_package
from levade.tasks import Overview, available_tasks, builtin_tasks, is_unchanged, load_task, overview
from levade.tasks.task import Task

MISSING = "robot mjlab:unitree_g1: mjlab is not installed; pip install --no-deps mjlab"
ON_TWO_LEGS = ["kneel", "one-leg-stand"]


@pytest.fixture
def bare(monkeypatch: pytest.MonkeyPatch) -> None:
    """No package that holds robots is installed."""
    monkeypatch.setattr("levade.robots.packages.files", lambda package: [])


def said(task: Task) -> Overview:
    return Overview(task.name, task.description, task.robot.name)


def test_an_overview_is_what_the_loaded_task_says() -> None:
    for name in ("rearing", "rearing-within-limits", "self-righting-robust"):  # on its own, and by way of others
        assert overview(name) == said(load_task(name))
        assert missing_package(overview(name).robot) is None


@pytest.mark.slow
@pytest.mark.parametrize("name", ON_TWO_LEGS)
def test_an_overview_is_what_the_loaded_task_says_on_two_legs(name: str, packaged: Callable[[str], Robot]) -> None:
    packaged("g1")
    task = load_task(name)
    assert overview(name) == said(task)
    assert is_unchanged(task)


def test_without_its_package_a_task_is_listed_and_cannot_be_loaded(bare: None) -> None:
    there = available_tasks()
    assert [name for name in builtin_tasks() if name not in there] == ON_TWO_LEGS
    assert {missing_package(overview(name).robot) for name in ON_TWO_LEGS} == {MISSING}


def test_a_motion_of_a_task_without_its_package_is_known_to_be_none_of_the_built_in_ones(bare: None) -> None:
    """Its report is written all the same, and names its own task.yaml."""
    task = load_task("rearing")
    assert is_unchanged(task)
    assert not is_unchanged(load_task("rearing", changes=["horizon=0.4"]))
    assert not is_unchanged(Task(**{**vars(task), "name": "kneel"}))


def test_the_command_line_lists_all_and_says_what_a_task_needs(bare: None, capfd: pytest.CaptureFixture[str]) -> None:
    def call(*words: str) -> tuple[object, str, str]:
        with pytest.raises(SystemExit) as stopped:
            main(list(words))
        return stopped.value.code, *capfd.readouterr()

    status, out, err = call("tasks")
    assert (status, err) == (0, "")
    listed = [line.split()[0] for line in out.splitlines()]
    assert listed == [*builtin_tasks(), "NAME-robust", "NAME-within-limits"]
    assert [line.split()[0] for line in out.splitlines() if MISSING in line] == ON_TWO_LEGS
    status, out, err = call("tasks", "--json")
    assert {row["name"]: row["robot"] for row in json.loads(out)["tasks"]}["kneel"] == "g1"
    assert call("solve", "kneel") == (2, "", f"levade: {MISSING}\n")
    status, out, err = call("solve", "one-leg-stand", "--robot", "hyq2max")
    assert (status, out) == (2, "")
    assert err == "levade: one-leg-stand: does not apply to hyq2max: it does not stand on two legs\n"
