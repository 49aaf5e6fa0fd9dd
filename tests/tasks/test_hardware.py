"""A task that asks for a certificate: true, or what it has to pass."""

from __future__ import annotations

from pathlib import Path

import pytest

import levade
from levade.errors import LevadeError
from levade.hardware import Plan
from levade.tasks import Demands, load_task, task_from_dict, task_to_dict
from levade.tasks.files import asks_for_hardware
from levade.tasks.schema import task_schema


@pytest.mark.parametrize(
    ("text", "demands"),
    [
        ("true", Demands()),
        ("false", None),
        ("null", None),
        ("{share: 0.9, speed: 0.1}", Demands(share=0.9, speed=0.1)),
        ("{impact_speed: null, numerics: false}", Demands(numerics=False)),
    ],
)
def test_it_is_written_as_a_word_or_as_demands(text: str, demands: Demands | None) -> None:
    change = f"hardware={text}"
    task = load_task("rearing", changes=[change])
    assert task.hardware == demands
    assert task_from_dict(task_to_dict(task), where="again").hardware == demands
    assert asks_for_hardware("rearing", [change]) is (demands is not None)
    assert not asks_for_hardware("rearing", [change, "hardware=false"])


def test_a_file_says_it(tmp_path: Path) -> None:
    text = Path(levade.__file__).parent.joinpath("tasks/data/sit-to-stand.yaml").read_text(encoding="utf-8")
    path = tmp_path / "stand.yaml"
    path.write_text(text + "\nhardware: {share: 0.9}\n", encoding="utf-8")
    assert load_task(path).hardware == Demands(share=0.9)
    assert asks_for_hardware(str(path), [])
    path.write_text(text + "\nhardware: {shore: 0.9}\n", encoding="utf-8")
    with pytest.raises(LevadeError, match=r"stand.yaml.hardware.*shore.*share"):
        load_task(path)
    path.write_text(text + "\nhardware: 3\n", encoding="utf-8")
    with pytest.raises(LevadeError, match=r"stand.yaml.hardware"):
        load_task(path)


def test_its_demands_reach_the_searches_and_its_searches_are_plain() -> None:
    task = load_task("rearing", changes=["hardware={speed: 0.2}"])
    plan = Plan.of(task, task.robot.load())
    searched = plan.within_limits()
    assert searched.success["speed_margin"].minimum == pytest.approx(0.21)
    assert searched.hardware is plan.robust(0.4).hardware is None


def test_one_search_is_not_what_it_asks_for() -> None:
    with pytest.raises(LevadeError, match=r"levade\.pursue"):
        levade.solve(load_task("rearing", changes=["hardware=true"]), trials=1)


def test_editors_know_both_forms() -> None:
    forms = task_schema()["properties"]["hardware"]
    assert {"type": "boolean"} in forms["anyOf"]
