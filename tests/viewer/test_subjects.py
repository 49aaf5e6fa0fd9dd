"""What `levade view` makes of a name, and what it says when it can make nothing of it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

import levade.viewer.subjects as subjects
from levade.errors import LevadeError
from levade.robots import Robot, builtin_robots, load_robot
from levade.tasks import available_tasks, builtin_tasks, load_task
from levade.viewer.subjects import find

HYQ = Path(load_robot("hyq2max").source).parent


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def task_file(path: str) -> Path:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copy(builtin_tasks()["rearing"], path))


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, _ in builtin_robots()])
def test_names_of_built_in_robots(name: str, packaged: Callable[[str], Robot]) -> None:
    packaged(name)
    robot = find(name).robot
    assert robot is not None
    assert robot.name == name


@pytest.mark.slow
def test_names_of_built_in_tasks() -> None:
    for name in available_tasks():
        assert find(name).task == load_task(name)


@pytest.mark.slow
def test_names_go_before_directories_and_paths_say_the_directory() -> None:
    """After a solve there is a directory of the task's name."""
    Path("rearing").mkdir()
    Path("rearing/motion.npz").touch()
    Path("rearing/task.yaml").touch()
    assert find("rearing").task == load_task("rearing")
    assert find("./rearing").motion == Path("rearing/motion.npz")
    assert find("rearing/").motion == Path("rearing/motion.npz")


@pytest.mark.slow
def test_files_are_known_by_what_is_in_them() -> None:
    assert find(str(task_file("mine/odd.yaml"))).task == load_task("rearing")
    robot = find(str(HYQ / "robot.yaml")).robot
    assert robot is not None
    assert robot.name == "hyq2max"
    assert find(str(HYQ)).robot is not None
    Path("some.npz").touch()
    assert find("some.npz").motion == Path("some.npz")


def test_a_run_that_has_no_motion_yet_shows_its_task() -> None:
    task_file("run/task.yaml")
    assert find("run").task == load_task("rearing")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("rearin", "view: no robot, task or file 'rearin'; did you mean rearing?"),
        ("hyq2mx", "view: no robot, task or file 'hyq2mx'; did you mean hyq2max?"),
        ("zzz", "view: no robot, task or file 'zzz'; valid names: .*hyq2max, .*rearing"),
        ("none.npz", "none.npz: no such file; give a motion.npz, a robot.yaml or a task's YAML file"),
        ("no/where", "no/where: no such file"),
        ("empty", "empty: holds no robot.yaml, motion.npz or task.yaml; give a file"),
        ("both", "both: holds a robot and a motion; say both/robot.yaml or both/motion.npz"),
        ("neither.yaml", "neither.yaml: has keys neither of a task nor of a robot"),
        ("mixed.yaml", "mixed.yaml: has keys both of a task and of a robot"),
        ("list.yaml", "list.yaml: should be a table"),
        ("robot.xml", "robot.xml: no free base, the robot is bolted to the world"),
    ],
)
def test_what_is_nothing(name: str, message: str) -> None:
    Path("empty").mkdir()
    Path("both").mkdir()
    for path, text in {
        "both/robot.yaml": "",
        "both/motion.npz": "",
        "neither.yaml": "a: 1",
        "mixed.yaml": "legs: {}\ncosts: {}",
        "list.yaml": "- 1",
        "robot.xml": "<mujoco/>",
    }.items():
        Path(path).write_text(text)
    with pytest.raises(LevadeError, match=message) as error:
        find(name)
    assert "\n" not in str(error.value)


def test_a_name_of_two_things(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subjects, "builtin_tasks", lambda: {"hyq2max": Path("x.yaml")})
    with pytest.raises(LevadeError, match="hyq2max is a built-in robot and a built-in task; give the file"):
        find("hyq2max")
