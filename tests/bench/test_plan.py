"""Plans: what is run, in what order, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from levade.bench import Plan, read_plan
from levade.bench.plan import cases, plan_to_yaml
from levade.errors import LevadeError

PLAN = """
tasks: [rearing]
optimizers:
  cem: {}
  plain: {search.optimizer: cma, search.smoothness: 0, "stages": [{name: full}]}
seeds: [3, 5]
trials: 400
steps: 1e6
changes: {horizon: 0.25}
"""


@pytest.mark.slow
def test_a_plan_is_the_product_of_its_lists(tmp_path: Path) -> None:
    (tmp_path / "plan.yaml").write_text(PLAN)
    plan = read_plan(tmp_path / "plan.yaml")
    found = cases(plan)
    assert [case.key for case in found] == [
        ("rearing", "hyq2max", name, seed) for name in ("cem", "plain") for seed in (3, 5)
    ]
    cem, _, plain, _ = (case.task for case in found)
    assert (cem.search.optimizer, cem.search.trials, cem.horizon, len(cem.stages)) == ("cem", 400, 0.25, 2)
    assert (plain.search.optimizer, plain.search.smoothness, len(plain.stages)) == ("cma", 0, 1)
    assert {case.budget_steps for case in found} == {1_000_000}
    assert found[0].checksum == found[1].checksum != found[2].checksum
    (tmp_path / "again.yaml").write_text(plan_to_yaml(plan))
    again = read_plan(tmp_path / "again.yaml")
    assert again == plan
    assert [case.checksum for case in cases(again)] == [case.checksum for case in found]


@pytest.mark.slow
def test_left_out_the_task_decides() -> None:
    (only,) = cases(Plan(tasks=("rearing",), seeds=1))
    assert only.key == ("rearing", "hyq2max", "cma-aimed", 0)
    assert (only.task.search.trials, only.task.search.polish, only.budget_steps) == (3009, 340, None)
    (through,) = cases(Plan(tasks=("rearing",), seeds=1, until="budget"))
    assert through.task.search.polish is None
    assert through.checksum != only.checksum
    assert Plan(tasks=("rearing",)).seed_list == (0, 1, 2, 3, 4)


@pytest.mark.slow
def test_an_alias_is_kept_as_a_label_and_finds_the_same_results() -> None:
    (by_name,) = cases(Plan(tasks=("rearing",), optimizers=("cma-aimed",), seeds=1))
    (by_alias,) = cases(Plan(tasks=("rearing",), optimizers=("levade",), seeds=1))
    assert (by_name.optimizer, by_alias.optimizer) == ("cma-aimed", "levade")
    assert (by_name.key, by_name.checksum) == (by_alias.key, by_alias.checksum)


def test_settings_of_the_tasks_optimizer_are_not_for_another(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(
        "{name: mine, horizon: 0.06, costs: {effort: {weight: 1}}, success: {},"
        " search: {optimizer: cem, settings: {elite: 0.5}}}"
    )
    own, other = cases(Plan(tasks=(str(path),), optimizers=("cem", "mppi"), seeds=1))
    assert own.task.search.settings == {"elite": 0.5}
    assert other.task.search.settings == {}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("tasks: []", r"plan.yaml: tasks: there are none; name at least one"),
        ("seeds: 3", r"plan.yaml.tasks: missing"),
        ("{tasks: [rearing], seed: 3}", r"unknown key 'seed'; did you mean seeds\?"),
        ("{tasks: [rearing, rearing]}", r"tasks: rearing is there twice"),
        ("{tasks: [rearing], seeds: 0}", r"seeds: 0 should be a number from 1, or a list"),
        ("{tasks: [rearing], seeds: [1, 1]}", r"seeds: .* should be a number from 1"),
        ("{tasks: [rearing], trials: 0}", r"trials: 0 should be at least 1"),
        ("{tasks: [rearing], steps: .nan}", r"steps: nan should be at least 1"),
        ("{tasks: [rearing], until: solved}", r"until: .*success.* or .*budget"),
        ("{tasks: [rearin]}", r"no task 'rearin'; did you mean rearing\?"),
        ("{tasks: [rearing], robots: [hyq]}", r"no robot 'hyq'; did you mean hyq2max\?"),
        ("{tasks: [rearing], optimizers: [levade, cma-aimed]}", r"optimizers: cma-aimed is there twice"),
        ("{tasks: [rearing], optimizers: [cmaa]}", r"optimizers: no optimizer 'cmaa'; did you mean cma\?"),
        ("{tasks: [rearing], optimizers: {mine: {}}}", r"optimizers: no optimizer 'mine'"),
        (
            "{tasks: [rearing], optimizers: {mine: {search.sep: 1}}}",
            r"optimizers.mine: search.sep: no 'sep' in search; did you mean step\?",
        ),
        ("{tasks: [rearing], changes: {horizn: 1}}", r"changes: horizn: no 'horizn' in the task"),
        (
            "{tasks: [rearing], changes: {start.settled.posture: netral}}",
            r"rearing on hyq2max: start.settled.posture: .*did you mean neutral\?",
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "plan.yaml"
    path.write_text(content)
    with pytest.raises(LevadeError, match=message) as caught:
        cases(read_plan(path))
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_two_tasks_of_one_name(tmp_path: Path) -> None:
    text = "{name: mine, horizon: 0.06, costs: {effort: {weight: 1}}, success: {}}"
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / name).write_text(text)
    with pytest.raises(LevadeError, match=r"a.yaml and .*b.yaml: have one name, mine on hyq2max"):
        cases(Plan(tasks=(str(tmp_path / "a.yaml"), str(tmp_path / "b.yaml"))))
