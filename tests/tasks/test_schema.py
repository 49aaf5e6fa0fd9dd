"""The published JSON schema, judged by the validator jsonschema, against what levade itself reads and refuses."""

from __future__ import annotations

import copy
import json
from typing import Any

import jsonschema
import pytest
import yaml

from levade.tasks import available_tasks, builtin_tasks, load_task, task_to_dict
from levade.tasks.schema import task_schema
from levade.tasks.terms import TERMS

VALIDATOR = jsonschema.Draft202012Validator(task_schema())

TASK: dict[str, Any] = yaml.safe_load("""
name: mine
robot: {name: hyq2max, kp: 500}
scene:
  friction: 0.8
  slope: 5 deg
  boxes: [{position: [1 trunk, 0, 0.25 heights], size: [40 cm, 2, 0.5 heights]}]
  gaps: [{x: 0.6, width: 1 trunk}]
  terrain: {file: hills.png, height: 20 cm, size: [4, 2]}
start: {fall: {height: 0.7 heights, roll: 180 deg, posture: {"*_haa": 0.1}}}
horizon: 6 falls
hold: 2 s
policy: {groups: [[lf, rf], [lh], [rh]], settle: 0.4}
costs:
  orientation: {weight: 1, roll: 0, pitch: 20 deg}
  apex: {term: miss, weight: 1, quantity: height, minimum: 1.5 heights, at: max}
success:
  pitch: {target: 20 deg, tolerance: 1 deg}
  clear: {quantity: lowest_foot, minimum: 10 cm, at: max, legs: [lf, hind]}
stages:
  - {hold: 0.4, promote: {pitch: 5 deg, clear: 1 cm}, weights: {apex: 0}}
  - {}
search: {trials: 3000, population: null}
""")


@pytest.mark.slow
def test_it_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(task_schema())
    json.dumps(task_schema())


@pytest.mark.slow
@pytest.mark.parametrize("name", available_tasks())
def test_every_built_in_task_is_valid_as_written_and_in_full(name: str) -> None:
    written = yaml.safe_load(builtin_tasks()[name].read_text(encoding="utf-8"))
    assert [error.message for error in VALIDATOR.iter_errors(written)] == []
    assert [error.message for error in VALIDATOR.iter_errors(task_to_dict(load_task(name)))] == []


def test_every_form_of_a_value_is_valid() -> None:
    assert [error.message for error in VALIDATOR.iter_errors(TASK)] == []


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("horizn", 1),
        ("horizon", "5 cm"),
        ("horizon", "5 sec"),
        ("horizon", True),
        ("policy.kernel", 1),
        ("policy.groups", "pair"),
        ("policy.variance", "1 s"),
        ("costs", {}),
        ("costs.effort", {}),
        ("costs.effort", {"weight": "much"}),
        ("costs.effort", {"weight": 1, "ovr": "all"}),
        ("costs.efort", {"weight": 1}),
        ("costs.apex.term", "mis"),
        ("costs.apex.legs", 3),
        ("costs.orientation.pitch", "3 cm"),
        ("success.up", {"target": 1, "tolerance": 1}),
        ("success.pitch.at", "often"),
        ("success.clear.quantity", "lowest"),
        ("start", {}),
        ("start.settled", {}),
        ("start.fall.heigth", 1),
        ("scene.boxes", [{"position": [1, 1], "size": [1, 1, 1]}]),
        ("scene.gaps", [{"x": 1}]),
        ("scene.terrain.heights", [[0, 1], [1, 0]]),
        ("stages", [{"hold": "half"}]),
        ("search.trials", "many"),
        ("robot", "hyq2max"),
    ],
)
def test_a_wrong_key_or_value_is_not(path: str, value: object) -> None:
    task = copy.deepcopy(TASK)
    *parents, last = path.split(".")
    at = task
    for key in parents:
        at = at[key]
    at[last] = value
    assert not VALIDATOR.is_valid(task)


def test_names_and_keys_are_described() -> None:
    schema = task_schema()
    assert (
        schema["properties"]["hold"]["description"]
        == "Time after T in which the reference stays at its last value [s]."
    )
    assert set(schema["properties"]["costs"]["properties"]) == set(TERMS)
    assert schema["$defs"]["Search"]["properties"]["trials"]["default"] == 3000
