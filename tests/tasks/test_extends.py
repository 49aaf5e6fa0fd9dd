"""Tasks that extend others: they have what they say, and of all else what the other task has."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from levade.costs import Miss
from levade.errors import LevadeError
from levade.tasks import load_task
from levade.tasks.files import asks_for_hardware
from levade.tasks.schema import task_schema
from levade.viewer.subjects import find

HIGHER = """
name: higher
extends: squat-jump
costs:
  apex: {term: miss, weight: 5, quantity: height, minimum: 1.2, at: max}
  straight: null
success:
  apex: {quantity: height, minimum: 1.1, at: max}
  straight: null
"""


def written(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_it_has_what_it_says_and_the_rest_of_the_other(tmp_path: Path) -> None:
    task, other = load_task(written(tmp_path / "higher.yaml", HIGHER)), load_task("squat-jump")
    assert task.costs["apex"].weight == 5
    assert isinstance(task.costs["apex"].term, Miss)
    assert task.costs["apex"].term.scale == Miss("height", minimum=1.2).scale  # replaced as a whole
    assert task.success["apex"].minimum == 1.1
    for ours, theirs in ((task.costs, other.costs), (task.success, other.success)):
        assert ours.keys() == theirs.keys() - {"straight"}
        assert all(ours[name] == theirs[name] for name in ours.keys() - {"apex"})
    assert task.good_enough == {}  # what it said of a criterion goes with it
    same = {"costs": other.costs, "success": other.success, "good_enough": other.good_enough}
    assert replace(task, name=other.name, **same) == other


def test_a_criterion_that_is_stated_anew_holds_on_perturbed_models_too(tmp_path: Path) -> None:
    text = "name: strict\nextends: squat-jump\nsuccess: {straight: {quantity: travel, maximum: 0.1 m, at: max}}\n"
    for task in (
        load_task(written(tmp_path / "strict.yaml", text)),
        load_task("squat-jump", changes=["success.straight.maximum=0.1"]),
        load_task(
            "squat-jump", changes=["success={straight: {quantity: travel, maximum: 0.1, at: max}}", "stages=[{}]"]
        ),
    ):
        assert task.on_others["straight"].maximum == 0.1
    text += "good_enough: {straight: {maximum: 0.2 m}}\n"
    assert load_task(written(tmp_path / "both.yaml", text)).on_others["straight"].maximum == 0.2


def test_nothing_but_a_name_is_the_other_task_on_any_robot(tmp_path: Path, quadruped: type[Any]) -> None:
    """In the units of the robot that is asked for, not of the other task's."""
    path = written(tmp_path / "same.yaml", "name: same\nextends: self-righting\n")
    for robot in ("hyq2max", written(tmp_path / "toy.urdf", quadruped().urdf())):
        ours, theirs = load_task(path, robot=robot), load_task("self-righting", robot=robot)
        assert replace(ours, name=theirs.name) == theirs


def test_a_start_a_horizon_and_a_robot_are_replaced(tmp_path: Path) -> None:
    text = """
    name: other
    extends: linked.yaml
    robot: {name: hyq2max}
    start: {settled: {posture: crouched}}
    horizon: {minimum: 0.5, maximum: 1.5}
    """
    written(tmp_path / "linked.yaml", "name: linked\nextends: self-righting\nrobot: {linkage: true}\n")
    task = load_task(written(tmp_path / "other.yaml", text))
    assert task.start.fall is None
    assert not task.robot.linkage
    assert task.horizon == load_task("self-righting", changes=["horizon={minimum: 0.5, maximum: 1.5}"]).horizon


STANDING = """
name: base
extends: squat-jump
horizon: 3
stances:
  level:
    description: On four legs
    horizon: 2
    policy: {kernels: 5, settle: 0.3}
    costs: {straight: null, effort: {weight: 3}, joint_limits: {weight: 3}}
    search: {trials: 7, population: 6}
  upright: it has two legs
"""


def test_its_own_words_win_over_what_the_other_changes_for_a_stance(tmp_path: Path) -> None:
    written(tmp_path / "base.yaml", STANDING)
    text = """
    name: child
    extends: base.yaml
    horizon: 4
    policy: {settle: 0.2}
    costs: {effort: {weight: 1}, joint_limits: null}
    search: {trials: 9}
    stances:
      level: {search: {population: 8}}
    """
    base, child = load_task(str(tmp_path / "base.yaml")), load_task(written(tmp_path / "child.yaml", text))
    assert (base.horizon, base.policy.settle, base.search.trials) == (2.0, 0.3, 7)
    assert (child.horizon, child.policy.settle, child.search.trials) == (4.0, 0.2, 9)
    assert (child.policy.kernels, child.search.population, child.description) == (5, 8, "On four legs")
    assert child.costs["effort"].weight == 1
    assert base.costs.keys() - child.costs.keys() == {"joint_limits"}
    assert "straight" not in child.costs


def test_a_reason_why_the_other_does_not_apply_stays_unless_it_says_otherwise(tmp_path: Path) -> None:
    written(tmp_path / "base.yaml", STANDING.replace("level:", "sprawled:").replace("upright:", "level:"))
    with pytest.raises(LevadeError, match="child: does not apply to hyq2max: it has two legs"):
        load_task(written(tmp_path / "child.yaml", "name: child\nextends: base.yaml\nhorizon: 4\n"))
    text = "name: child\nextends: base.yaml\nstances: {level: {horizon: 5}}\n"
    assert load_task(written(tmp_path / "child.yaml", text)).horizon == 5.0


def test_paths_in_stances_are_relative_to_the_file_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "hills").mkdir()
    written(
        tmp_path / "hills" / "next.yaml", "name: next\nextends: squat-jump\nstart: {settled: {posture: crouched}}\n"
    )
    text = "name: onward\nextends: squat-jump\nstances: {level: {policy: {goal: {like: next.yaml}}}}\n"
    assert load_task(written(tmp_path / "hills" / "on.yaml", text)).policy.goal == "crouched"


def test_another_optimizer_comes_without_the_settings(tmp_path: Path) -> None:
    text = "name: plain\nextends: squat-jump\nsearch: {{{}}}\n"
    search = load_task(written(tmp_path / "plain.yaml", text.format("optimizer: cma"))).search
    assert (search.settings, search.restart) == ({}, load_task("squat-jump").search.restart)
    kept = load_task(written(tmp_path / "plain.yaml", text.format("trials: 10"))).search
    assert (kept.settings, kept.trials) == ({"aimed": 0}, 10)


def test_files_extend_files_beside_them(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    written(tmp_path / "higher.yaml", HIGHER + "hardware: {share: 0.9}\n")
    last = written(tmp_path / "inner" / "last.yaml", "name: last\nextends: ../higher.yaml\nhold: 1 s\n")
    task = load_task(last)
    assert (task.hold, task.costs["apex"].weight) == (1.0, 5)
    assert asks_for_hardware(last, [])


def test_paths_are_relative_to_the_file_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "hills").mkdir()
    written(tmp_path / "next.yaml", "name: next\nextends: squat-jump\nstart: {settled: {posture: crouched}}\n")
    text = "name: onward\nextends: squat-jump\npolicy: {goal: {like: ../next.yaml}}\n"
    written(tmp_path / "hills" / "on.yaml", text)
    last = written(tmp_path / "last.yaml", "name: last\nextends: hills/on.yaml\n")
    assert load_task(last).policy.goal == "crouched"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name: it\nextends: squat-jmp\n", r"it\.yaml: extends: no task 'squat-jmp'; did you mean squat-jump"),
        ("name: it\nextends: ./none.yaml\n", r"it\.yaml: extends: .*none\.yaml: no such file"),
        ("name: it\nextends: it.yaml\n", r"it\.yaml extends it\.yaml, in a circle"),
        ("name: it\nextends: {task: rearing}\n", r"extends: should be the name or the file of a task, is a table"),
        ("extends: rearing\n", r"it\.yaml: name: is missing"),
        ("name: it\nextends: rearing\ncosts: {efort: {weight: 1}}\n", r"costs\.efort: no term 'efort'"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(LevadeError, match=said):
        load_task(written(tmp_path / "it.yaml", text))


def test_the_schema_knows_it() -> None:
    validator = jsonschema.Draft202012Validator(task_schema())
    task = yaml.safe_load(HIGHER)
    assert not list(validator.iter_errors(task))
    assert list(validator.iter_errors({key: value for key, value in task.items() if key != "extends"}))
    assert list(validator.iter_errors({key: value for key, value in task.items() if key != "name"}))


def test_it_is_found_to_be_a_task(tmp_path: Path) -> None:
    path = written(tmp_path / "same.yaml", "name: same\nextends: self-righting\n")
    found = find(path)
    assert found.task is not None
    assert found.task.name == "same"
