"""Variants of tasks: the same motion on robots that differ from the model, and within limits, by the plan for hardware."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from levade.checks import numerics, other_engines, perturbed
from levade.costs import Effort, Margins, Miss
from levade.engines import Perturbation
from levade.errors import LevadeError
from levade.motions import RecordedSimulation
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import (
    HorizonRange,
    Task,
    available_tasks,
    builtin_tasks,
    builtin_variants,
    load_task,
    looks_at_hold,
    task_text,
)
from levade.tasks.plan import LONGEST, ROOM
from levade.tasks.schema import task_schema

SAID = sorted(name for name, path in builtin_tasks().items() if "variants" in yaml.safe_load(path.read_text()))
"""Tasks that say something of their variants."""

THERE = available_tasks()


def written(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_every_task_has_two_variants() -> None:
    assert builtin_variants().keys() == {
        f"{name}-{end}" for name in builtin_tasks() for end in ("robust", "within-limits")
    }
    assert builtin_variants()["rearing-slow-robust"] == ("rearing-slow", "robust")
    assert not builtin_tasks().keys() & builtin_variants().keys()


def ends(task: Task) -> tuple[float, float]:
    """Shortest and longest duration."""
    horizon = task.horizon
    return (horizon.minimum, horizon.maximum) if isinstance(horizon, HorizonRange) else (horizon, horizon)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, (task, _) in builtin_variants().items() if task in THERE])
def test_a_variant_asks_for_the_motion_of_its_task_on_other_robots(name: str) -> None:
    task, variant = builtin_variants()[name]
    made, nominal = load_task(name), load_task(task)
    assert made.name == name
    assert made.description.endswith(("the model", "times the time"))
    linked = variant == "within-limits" and nominal.robot.name == "hyq2max"  # its linkage limits it, too
    assert made.robot == replace(nominal.robot, linkage=linked)
    for key in ("scene", "physics", "start", "hold"):
        assert getattr(made, key) == getattr(nominal, key), key
    assert made.policy.groups == nominal.policy.groups
    assert made.robust is not None
    assert made.robust.perturb == Perturbation()  # all that a check perturbs, and as much
    assert made.search.trials <= 5 * nominal.search.trials
    assert [stage.robust for stage in made.stages] == [False, True]
    assert made.hardware is None
    for key, criterion in nominal.success.items():  # the same, with a tolerance that hardware needs
        own = made.success[key]
        assert (
            own == criterion
            if criterion.tolerance is None
            else replace(own, tolerance=criterion.tolerance) == criterion
        )
        assert (own.tolerance or 0) >= (criterion.tolerance or 0)
    limits = {one.quantity for one in made.success.values()} & set(ROOM)
    expected = set(ROOM) if linked else set(ROOM) - {"linkage_margin"}
    assert limits == (expected if variant == "within-limits" else set())
    assert not {one.quantity for one in made.on_others.values()} & set(ROOM)  # a weak robot may come to its limits
    if variant == "within-limits":
        assert isinstance(made.costs["margins"].term, Margins)
        assert ends(made)[1] == pytest.approx(LONGEST * ends(made)[0]) or isinstance(nominal.horizon, HorizonRange)
    else:
        assert "margins" not in made.costs


def test_costs_follow_from_the_criteria() -> None:
    """Sit-to-stand says nothing of its variants."""
    made, nominal = load_task("sit-to-stand-robust"), load_task("sit-to-stand")
    assert "sit-to-stand" not in SAID
    for name in nominal.success:
        assert isinstance(made.costs[name].term, Miss)
        assert made.costs[name].weight == 1.0
    assert isinstance(made.costs["effort"].term, Effort)
    assert "orientation" not in made.costs
    assert made.stages[0].promote == {
        name: one.tolerance if one.target is not None else 0.0 for name, one in made.success.items()
    }


def test_the_whole_attitude_counts_where_a_robot_rears() -> None:
    robust, within = load_task("rearing-robust"), load_task("rearing-within-limits")
    assert {one.quantity for one in robust.success.values()} == {"roll", "pitch", "yaw", "height"}
    assert set(robust.success) == set(within.on_others)
    assert {one.tolerance for name, one in robust.success.items() if name != "height"} == {0.1}
    assert (robust.horizon, ends(within)) == (0.3, (0.3, 0.75))


def test_costs_and_policy_that_are_kept_are_those_of_the_task() -> None:
    made, nominal = load_task("self-righting-robust"), load_task("self-righting")
    assert made.policy == nominal.policy
    assert (made.success, made.horizon) == (nominal.success, nominal.horizon)
    costs = dict(made.costs)  # in the hold, too, which its nominal task's costs do not look at
    assert looks_at_hold(costs.pop("stays").term)
    assert costs == nominal.costs


def test_within_limits_costs_that_are_kept_get_margins() -> None:
    made, nominal = load_task("self-righting-within-limits"), load_task("self-righting")
    assert {name: made.costs[name] for name in nominal.costs} == nominal.costs
    assert made.costs.keys() - nominal.costs.keys() == {"margins", "duration"}


def test_a_free_duration_becomes_the_one_that_the_variant_says() -> None:
    made, nominal = load_task("levade-robust"), load_task("levade")
    assert isinstance(nominal.horizon, HorizonRange)
    assert made.horizon == pytest.approx(nominal.horizon.begin)
    assert made.feedback is not None
    assert load_task("levade-within-limits").feedback is None  # what is said of the search holds for one variant alone


@pytest.mark.slow
def test_another_robot_has_limits_of_its_own(tmp_path: Path, quadruped: type[Any]) -> None:
    path = written(tmp_path / "toy.urdf", quadruped().urdf())
    made, own = load_task("sit-to-stand-within-limits", robot=path), load_task("sit-to-stand-within-limits")
    assert made.robot.name == path
    assert ends(made) != ends(own)  # in falls of its height


@pytest.mark.slow
@pytest.mark.parametrize("name", [f"{task}-{end}" for task in SAID for end in ("robust", "within-limits")])
def test_what_is_shown_is_the_variant(name: str, tmp_path: Path) -> None:
    assert load_task(written(tmp_path / "task.yaml", task_text(name))) == load_task(name)


BOW = """
name: bow
extends: rearing
success: {pitch: {target: -0.5, tolerance: 0.2}}
variants:
  robust: {search: {trials: 40}}
"""


def test_a_file_of_one_s_own_has_them_too(tmp_path: Path) -> None:
    bow = written(tmp_path / "bow.yaml", BOW)
    text = f"name: bow-robust\nextends: {bow}\nvariant: robust\nsearch: {{step: 0.7}}\nsuccess: {{height: null}}\n"
    made = load_task(written(tmp_path / "bow-robust.yaml", text))
    assert set(made.success) == set(made.costs) - {"effort", "joint_limits"} == {"pitch"}
    assert made.success["pitch"].target == -0.5
    assert (made.search.trials, made.search.step) == (40, 0.7)
    assert load_task(bow).robust is None


def test_own_words_win_over_the_plan(tmp_path: Path) -> None:
    text = """
    name: mine
    extends: rearing-robust
    description: My own
    horizon: 0.5
    policy: {kernels: 9}
    costs: {yaw: null, effort: {weight: 3}}
    success: {pitch: {target: -0.8, tolerance: 0.3}}
    robust: {samples: 5}
    """
    made, other = load_task(written(tmp_path / "mine.yaml", text)), load_task("rearing-robust")
    assert (made.name, made.horizon, made.policy.kernels, made.costs["effort"].weight) == ("mine", 0.5, 9, 3)
    assert made.policy.variance == other.policy.variance
    assert made.costs.keys() == other.costs.keys() - {"yaw"}
    assert isinstance(made.costs["pitch"].term, Miss)
    assert (made.costs["pitch"].term.target, made.costs["pitch"].term.scale) == (
        -0.8,
        0.15,
    )  # follows from the criterion
    assert made.robust is not None
    assert other.robust is not None
    assert replace(made.robust, samples=3) == other.robust
    again = load_task(written(tmp_path / "again.yaml", "name: again\nextends: mine.yaml\nhorizon: 0.6\n"))
    assert replace(again, name="mine", description=made.description, horizon=0.5) == made
    within = load_task(written(tmp_path / "w.yaml", "name: w\nextends: rearing-within-limits\nhorizon: 0.5\n"))
    assert within.horizon == 0.5


@pytest.mark.slow
def test_a_robot_that_is_asked_for_comes_before_the_file_s(tmp_path: Path, quadruped: type[Any]) -> None:
    toy = written(tmp_path / "toy.urdf", quadruped().urdf())
    path = written(tmp_path / "it.yaml", "name: it\nextends: sit-to-stand-robust\nrobot: {linkage: true}\n")
    assert load_task(path).robot.linkage
    assert load_task(path, robot=toy).robot.name == toy


def test_a_variant_says_what_differs_for_a_stance(tmp_path: Path) -> None:
    text = BOW.replace("{search: {trials: 40}}", "{stances: {level: {search: {trials: 50}}, upright: it has no neck}}")
    written(tmp_path / "bow.yaml", text)
    path = written(tmp_path / "it.yaml", "name: it\nextends: bow.yaml\nvariant: robust\n")
    assert load_task(path).search.trials == 50


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("extends: rearing\nvariant: robst\n", r"it\.yaml: variant: no variant 'robst'; did you mean robust"),
        ("extends: rearing-robust\nvariant: robust\n", r"variant: rearing-robust is a variant already"),
        ("variant: robust\n", r"it\.yaml: variant: is that of another task; name the task with extends"),
        (
            "extends: rearing\nvariants: [robust]\n",
            r"variants: should be a table such as {robust: {\.\.\.}}, is a list",
        ),
        ("extends: rearing\nvariant: robust\nvariants: {}\n", r"it\.yaml: variants: a variant has none of its own"),
        ("extends: rearing\nvariants: {robst: {}}\n", r"variants: no variant 'robst'; did you mean robust"),
        ("extends: rearing\nvariants: {robust: 3}\n", r"variants\.robust: should be a table of changes, is 3"),
        ("extends: rearing\nvariant: robust\nkeep: costs\n", r"robust\.keep: should be a list such as \[costs\]"),
        (
            "extends: rearing\nvariant: robust\nkeep: [cots]\n",
            r"robust\.keep: 'cots' cannot be kept; did you mean costs",
        ),
        ("extends: rearing\nvariant: robust\ncosts: {efort: {weight: 1}}\n", r"costs\.efort: no term 'efort'"),
        (
            "extends: rearing\nvariant: robust\nsuccess: {pitch: null, height: null, roll: null, yaw: null}\n",
            r"variant: the task it has no success criteria",
        ),
        ("extends: rearing-robst\n", r"no task 'rearing-robst'; did you mean rearing-robust"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(LevadeError, match=said) as raised:
        load_task(written(tmp_path / "it.yaml", f"name: it\n{text}"))
    assert "\n" not in str(raised.value)


def test_an_unknown_name_gets_the_nearest_of_both_kinds() -> None:
    for name, near in (("squat-jmp", "squat-jump"), ("squatjump-robust", "squat-jump-robust")):
        with pytest.raises(LevadeError, match=f"did you mean {near}\\?"):
            load_task(name)


def test_the_schema_knows_them() -> None:
    validator = jsonschema.Draft202012Validator(task_schema())
    task = {"name": "it", "extends": "rearing", "variant": "robust", "variants": {"robust": {"keep": ["costs"]}}}
    assert not list(validator.iter_errors(task))
    for wrong in ({"variant": "robst"}, {"variants": {"robst": {}}}, {"variants": {"robust": {"keep": ["x"]}}}):
        assert list(validator.iter_errors({**task, **wrong})), wrong
    assert list(validator.iter_errors({key: value for key, value in task.items() if key != "extends"}))


@pytest.mark.golden
@pytest.mark.slow
def test_a_robust_search_finds_a_motion_that_holds_on_robots_it_has_not_seen() -> None:
    """With feedback, which needs fewer trials; docs/check.md has the shares of whole searches without."""
    task = load_task("rearing-robust", changes=["feedback={}", "search.trials=2000"])
    solution = solve(objective := make_objective(task, threads=0), seed=0)
    motion = record(objective, solution, seed=0)
    simulation = RecordedSimulation(motion)
    found = perturbed(simulation, Perturbation(), runs=200, seed=0, feedback=motion.feedback)
    assert found.share >= 0.95, found.errors
    assert numerics(simulation)["half time step"].success
    ode = other_engines(simulation)["ode"]
    assert ode.success or ode.reason
