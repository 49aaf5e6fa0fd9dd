"""Tasks: the paper's numbers in the built-in ones, the way through YAML and back, units, and mistakes."""

from __future__ import annotations

import dataclasses
import math
import re
import zlib
from pathlib import Path

import numpy as np
import pytest
import yaml

from levade.costs import Criterion, Effort, JointLimitExcess, Margins, Orientation, Position
from levade.engines import Fall, Settled
from levade.errors import LevadeError
from levade.robots import dimensions, load_robot
from levade.search import make_objective
from levade.search.optimizing import make_attempt
from levade.tasks import (
    Cost,
    HorizonRange,
    Search,
    Task,
    available_tasks,
    load_task,
    task_checksum,
    task_from_dict,
    task_text,
    task_to_dict,
    task_to_yaml,
)
from levade.tasks.units import UNITS, to_si

BUILT_IN = list(available_tasks())
RANGE = {"minimum": 0.2, "maximum": 1.0}
HORIZON = "horizon: should be a number of seconds, or bounds for the search such as {minimum: 0.3 s, maximum: 1.5 s}"


@pytest.mark.slow
@pytest.mark.parametrize("name", BUILT_IN)
def test_a_task_survives_the_way_through_its_file(name: str, tmp_path: Path) -> None:
    task = load_task(name)
    assert task.name == name
    path = tmp_path / "task.yaml"
    path.write_text(task_to_yaml(task))
    again = load_task(path)
    assert again == task
    assert task_to_yaml(again) == path.read_text()
    plain = yaml.safe_load(path.read_text())  # no tags: any YAML reader will do
    assert plain["horizon"] == (
        dataclasses.asdict(task.horizon) if isinstance(task.horizon, HorizonRange) else task.horizon
    )
    assert {type(value) for value in plain["costs"].values()} == {dict}


def papers_population(name: str) -> int:
    """Of CMA-ES over all the weights, which the paper's budgets are multiples of."""
    plain = ["search.optimizer=cma", "search.population=null", "search.modes=null"]
    objective = make_objective(load_task(name, changes=plain), threads=1)
    return make_attempt(objective.task, objective.space, seed=0).population


@pytest.mark.slow
def test_rearing_has_the_papers_numbers() -> None:
    """Section IV.A: pitch -60 degrees, height 90 cm, Q = (1000, 100, 0.1, 1), 6 x 16 weights, sigma^2 = 0.01, 3009."""
    task = load_task("rearing")
    assert task.horizon == 0.3
    weights = {name: task.costs[name].weight for name in ("orientation", "position", "effort", "joint_limits")}
    assert weights == {"orientation": 1000, "position": 100, "effort": 0.1, "joint_limits": 1}
    orientation, position = task.costs["orientation"].term, task.costs["position"].term
    assert isinstance(orientation, Orientation)
    assert (orientation.roll, orientation.yaw) == (None, None)
    assert orientation.pitch == pytest.approx(-math.radians(60), abs=1e-5)
    assert position == Position(z=0.9)
    assert task.costs["effort"].term == Effort()
    assert task.costs["joint_limits"].term == JointLimitExcess()
    assert (task.policy.kernels, task.policy.variance, task.policy.groups) == (16, 0.01, "pairs")
    assert isinstance(task.start.choice, Settled)
    assert task.search.trials == 3009 == 177 * 17
    pitch, height = task.success["pitch"], task.success["height"]
    assert (pitch.tolerance, height.tolerance, height.target) == (0.006, 0.02, 0.9)
    assert pitch.target == orientation.pitch
    assert set(task.success) == {"pitch", "height"}
    objective = make_objective(task, threads=1)
    assert objective.policy.size == 96
    assert papers_population("rearing") == 17


@pytest.mark.slow
def test_recovery_has_the_papers_numbers() -> None:
    """Section IV.B: level at 61 cm, Q = (1000, 1000, 0.1, 1), 12 x 16 weights, 2 s of holding the final posture."""
    task = load_task("posture-recovery")
    assert (task.horizon, task.hold) == (0.3, 2.0)
    weights = {name: task.costs[name].weight for name in ("orientation", "position", "effort", "joint_limits")}
    assert weights == {"orientation": 1000, "position": 1000, "effort": 0.1, "joint_limits": 1}
    assert task.costs["orientation"].term == Orientation(roll=0.0, pitch=0.0, yaw=0.0)
    assert task.costs["position"].term == Position(z=0.61)
    assert (task.policy.kernels, task.policy.variance, task.policy.groups) == (16, 0.01, "independent")
    assert task.policy.initial == "interpolate"
    assert isinstance(task.start.choice, Fall)
    assert len(task.scene.boxes) == 1
    assert task.search.trials == 3002 == 158 * 19
    for angle in ("roll", "pitch", "yaw"):
        assert (task.success[angle].target, task.success[angle].tolerance, task.success[angle].at) == (
            0,
            0.002,
            "horizon",
        )
    assert (task.success["height"].target, task.success["height"].tolerance) == (0.61, 0.005)
    after = {c.quantity: c for c in task.success.values() if c.at == "end"}
    assert {name: (c.target, c.tolerance) for name, c in after.items()} == {
        "roll": (0, 0.1),
        "pitch": (0, 0.1),
        "height": (0.61, 0.05),
    }
    objective = make_objective(task, threads=1)
    assert objective.policy.size == 192
    assert papers_population("posture-recovery") == 19


@pytest.mark.parametrize("name", [name for name in BUILT_IN if name.endswith("-slow")])
def test_slow_tasks_are_the_fast_ones_with_more_time(name: str) -> None:
    slow, fast = load_task(name), load_task(name.removesuffix("-slow"))
    assert (slow.horizon, fast.horizon) == (3.0, 0.3)
    assert (slow.success, slow.scene, slow.start, slow.hold) == (fast.success, fast.scene, fast.start, fast.hold)
    for term in ("orientation", "position", "effort", "joint_limits"):
        assert slow.costs[term] == fast.costs[term]


def test_changes_add_whole_costs_and_criteria() -> None:
    added = [
        "costs.apart={term: margins, weight: 0.02, self_distance: 1 cm}",
        "success.self_distance={minimum: 5 mm, at: min}",
    ]
    task = load_task("rearing", changes=added)
    assert task.costs["apart"] == Cost(Margins(self_distance=0.01), 0.02)
    assert task.success["self_distance"] == Criterion("self_distance", minimum=0.005, at="min")
    assert task.clearance == 0.01
    assert task_from_dict(task_to_dict(task), where="task") == task
    assert load_task("rearing").clearance is None


def test_changes_by_path() -> None:
    task = load_task("rearing", changes=["horizon=0.4", "stages.0.promote.pitch=1e-1", "costs.effort.weight=2"])
    assert (task.horizon, task.stages[0].promote["pitch"], task.costs["effort"].weight) == (0.4, 0.1, 2.0)
    changed = load_task("rearing", changes=["success.height.tolerance=3 cm", "horizon=350 ms", "search.polish=null"])
    assert changed.success["height"].tolerance == pytest.approx(0.03)
    assert changed.horizon == pytest.approx(0.35)
    assert changed.search.polish is None
    boxes = load_task(
        "rearing", changes=["scene.boxes=[{position: [1, 0, 10 cm], size: [0.2, 0.2, 20 cm]}]"]
    ).scene.boxes
    np.testing.assert_allclose((boxes[0].position, boxes[0].size), [(1, 0, 0.1), (0.2, 0.2, 0.2)])
    assert load_task("rearing", robot="hyq2max").robot.name == "hyq2max"


def minimal(**changes: object) -> dict[str, object]:
    content: dict[str, object] = {
        "name": "mine",
        "horizon": 0.1,
        "costs": {"position": {"weight": 1, "z": 0.5}},
        "success": {"height": {"target": 0.5, "tolerance": 0.1}},
    }
    return content | changes


def test_a_short_task_has_sound_defaults() -> None:
    task = task_from_dict(minimal(), where="mine.yaml")
    assert task == Task(
        "mine", 0.1, {"position": Cost(Position(z=0.5), 1.0)}, task.success, search=Search(), stages=task.stages
    )
    assert task_from_dict(task_to_dict(task), where="x") == task
    several = minimal(costs={"up": {"term": "position", "weight": 1, "z": 0.5}, "position": {"weight": 2, "x": 1.0}})
    assert set(task_from_dict(several, where="x").costs) == {"up", "position"}


def test_an_alias_of_an_optimizer_becomes_its_name() -> None:
    task = load_task("rearing")
    assert task.search.optimizer == "cma-aimed"
    aimed = load_task("rearing", changes=["search.settings={aimed: 3}"])
    for name in ("levade", "cma-aimed"):
        assert load_task("rearing", changes=[f"search.optimizer={name}"]) == task
        assert task_from_dict(minimal(search={"optimizer": name}), where="x").search == Search()
        kept = load_task("rearing", changes=[f"search.optimizer={name}", "search.settings={aimed: 3}"])
        assert kept == aimed
    assert Search(optimizer="levade") == Search()
    assert "optimizer: cma-aimed\n" in task_to_yaml(task)


def test_the_checksum_is_of_the_task_and_of_what_else_decides() -> None:
    task = load_task("rearing")
    first = task_to_yaml(task).replace("optimizer: cma-aimed", "optimizer: levade")
    keys = ("  room: null", "  slew: null", "  through: []", "  sketches: 0", "  patience: null", "hardware: null")
    keys = (*keys, "good_enough: {}")
    for later in (f"{key}\n" for key in keys):
        first = first.replace(later, "")
    assert task_checksum(task) == zlib.crc32(first.encode())  # as in runs and benches from before it had this name
    assert task_checksum(task) == 3607212546  # of the version before the first of these keys
    assert task_checksum(task, None) == zlib.crc32(f"{first}None".encode())
    others = [
        task_checksum(load_task("rearing", changes=[change])) for change in ("search.optimizer=cma", "horizon=0.4")
    ]
    assert len({task_checksum(task), task_checksum(task, 7), *others}) == 4


def test_units_become_si() -> None:
    task = task_from_dict(
        minimal(
            horizon="300 ms",
            hold="1.5s",
            scene={
                "slope": "5 deg",
                "boxes": [{"position": ["10 cm", 0, "50mm"], "size": [1, 1, "10 cm"], "yaw": "90deg"}],
            },
            start={"fall": {"height": "65 cm", "roll": "-30 deg", "time": "1e3 ms", "posture": {"lf_haa": "9 deg"}}},
            costs={
                "orientation": {"weight": 1, "pitch": "-60 deg"},
                "linear_velocity": {"weight": 1, "z": "1 m/s"},
                "angular_velocity": {"weight": 1, "z": "90 deg/s"},
                "posture": {"weight": 1, "position": ["30 deg", *[None] * 11]},
            },
            success={
                "pitch": {"target": "-60 deg", "tolerance": "1 deg"},
                "h": {"quantity": "height", "minimum": "5 cm"},
            },
        ),
        where="mine.yaml",
    )
    assert (task.horizon, task.hold, task.scene.slope) == pytest.approx((0.3, 1.5, math.radians(5)))
    assert task.scene.boxes[0].position == pytest.approx((0.1, 0, 0.05))
    assert task.scene.boxes[0].yaw == pytest.approx(math.pi / 2)
    assert dataclasses.asdict(task.start.choice)["roll"] == pytest.approx(math.radians(-30))
    assert dataclasses.asdict(task.start.choice)["time"] == 1.0
    assert dataclasses.asdict(task.start.choice)["posture"] == {"lf_haa": pytest.approx(math.pi / 20)}
    targets = {name: dataclasses.asdict(cost.term) for name, cost in task.costs.items()}
    assert targets["orientation"]["pitch"] == task.success["pitch"].target == pytest.approx(-math.pi / 3)
    assert targets["angular_velocity"]["z"] == pytest.approx(math.pi / 2)
    assert targets["posture"]["position"][0] == pytest.approx(math.pi / 6)
    assert task.success["h"].minimum == pytest.approx(0.05)


@pytest.mark.parametrize("unit", UNITS)
def test_every_unit_has_its_size(unit: str) -> None:
    angle, length, time = math.pi / 180, 0.01, 0.001
    size = {"deg": angle, "deg/s": angle, "cm": length, "mm": length / 10, "ms": time}.get(unit, 1.0)
    assert to_si(f"-2.5 {unit}", where="x", measures=UNITS[unit][0]) == pytest.approx(-2.5 * size)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"horizon": "5 cm"}, "horizon: '5 cm' is a length, but this is a duration; units here: s, ms"),
        ({"horizon": "5 sec"}, "horizon: unknown unit 'sec' in '5 sec'; units here: s, ms"),
        (
            {"policy": {"variance": "1 s"}},
            "policy.variance: '1 s' has a unit, but this number takes none; give it in SI, without one",
        ),
        (
            {"scene": {"boxes": [{"position": ["1 deg", 0, 0], "size": [1, 1, 1]}]}},
            "scene.boxes.0.position.0: '1 deg' is an",
        ),
        (
            {"success": {"pitch": {"target": "3 cm", "tolerance": 1}}},
            "success.pitch.target: '3 cm' is a length, but this is",
        ),
        (
            {"costs": {"posture": {"weight": 1, "position": ["3 cm"]}}},
            "costs.posture.position.0: '3 cm' is a length, but",
        ),
        ({"horizn": "4 falls"}, "unknown key 'horizn'; did you mean horizon?"),
        ({"scene": {"fricton": "1 s"}}, "scene: unknown key 'fricton'; did you mean friction?"),
        ({"costs": {"effort": {"weight": 1, "ovr": "1 s"}}}, "costs.effort: unknown key 'ovr'; did you mean over?"),
        ({"horizn": 1}, "unknown key 'horizn'; did you mean horizon?"),
        ({"policy": {"kernel": 1}}, "policy: unknown key 'kernel'; did you mean kernels?"),
        ({"costs": {"efort": {"weight": 1}}}, "costs.efort: no term 'efort'; did you mean effort?"),
        ({"costs": {"effort": {"weight": 1, "ovr": "all"}}}, "costs.effort: unknown key 'ovr'; did you mean over?"),
        ({"costs": {"effort": {}}}, "costs.effort.weight: should be a number, is missing"),
        ({"costs": {"effort": 3}}, "costs.effort: should be a table such as {weight: 1}, is 3"),
        ({"costs": {"effort": {"weight": "much"}}}, "costs.effort.weight: should be a number, is 'much'"),
        ({"costs": {"effort": {"weight": math.nan}}}, "costs.effort.weight: nan is not a number"),
        ({"costs": {"effort": {"weight": 1, "term": [1]}}}, "costs.effort: no term [1]; valid names: angular_velocity"),
        ({"costs": {}}, "costs: there are none; give at least one"),
        ({"costs": 3}, "costs: should be a table of keys and values, is 3"),
        ({"costs": {"position": {"weight": 1}}}, "costs.position: position: no target; give at least one of x, y, z"),
        (
            {"success": {"up": {"target": 1, "tolerance": 1}}},
            "success.up: 'up' is not a quantity; add the key quantity;",
        ),
        ({"success": {"up": {"quantity": ["height"], "target": 1}}}, "success.up.quantity: should be 'roll', 'pitch'"),
        (
            {"success": {"height": {"target": 1}}},
            "success.height: a target goes with a tolerance, and only a target does",
        ),
        (
            {"success": {"height": {"target": 1, "tolerance": 1, "at": "hold"}}},
            "success.height.at: hold, but the task has no",
        ),
        ({"start": {}}, "start: give one of settled, fall, fallen and state"),
        ({"start": {"settled": {}, "fall": {"height": 1}}}, "start: give one of settled, fall, fallen and state"),
        ({"start": {"fall": {}}}, "start.fall.height: missing"),
        (
            {"start": {"settled": {"posture": {"*_haa": "3 cm"}}}},
            "start.settled.posture.*_haa: '3 cm' is a length, but this is an angle; units here: rad, deg",
        ),
        ({"start": {"settled": {"posture": 3}}}, "start.settled.posture: should be a valid string, is 3"),
        ({"horizon": 0}, "horizon: 0.0 s should be at least one time step (0.002 s); 0.3 to 3 s is usual"),
        ({"horizon": -1}, "horizon: -1.0 s should be at least one time step"),
        (
            {"success": {"duration": {"maximum": 0.1}}, "horizon": 0.3},
            "success.duration: asks for a duration of at most 0.1 s, but horizon is 0.3 s; change one of them",
        ),
        (
            {"success": {"short": {"quantity": "duration", "target": 2, "tolerance": 0.5}}, "horizon": RANGE},
            "success.short: asks for a duration of at least 1.5 s and at most 2.5 s, but horizon is 0.2 to 1 s; change",
        ),
        ({"horizon": math.inf}, "horizon: inf s should be"),
        ({"horizon": True}, f"{HORIZON}, is true or false"),
        ({"horizon": 100, "hold": 100}, "horizon: 100.0 s and hold 100.0 s are together more than 120 s"),
        ({"hold": -1}, "hold: -1.0 s should be 0 or more"),
        ({"policy": {"kernels": 0}}, "policy.kernels: 0 should be 1 to 1000; the paper has 16"),
        ({"policy": {"kernels": -3}}, "policy.kernels: -3 should be"),
        (
            {"policy": {"through": ["crouched"]}},
            "policy.through: initial: hold does not use these postures",
        ),
        ({"feedback": {"hold": 0}}, "feedback.hold: 0"),
        (
            {"policy": {"groups": "pair"}},
            "policy.groups: should be 'pairs', 'sides', 'all' or 'independent', is 'pair'",
        ),
        ({"stages": []}, "stages: there are none; leave the key out for a single one"),
        ({"stages": [{"promote": {"pich": 1}}]}, "stages.0.promote: no 'pich' in this task; valid names: height"),
        (
            {"stages": [{}, {"weights": {"positon": 1}}]},
            "stages.1.weights: no 'positon' in this task; did you mean position?",
        ),
        ({"stages": [{"trials": 0}]}, "stages.0.trials: 0 should be at least 1; leave it out to use all that is left"),
        ({"stages": [{"step": 0}]}, "stages.0.step: 0.0 should be a positive factor on the step size"),
        ({"stages": [{"hold": 3.0}]}, "stages.0.hold: 3.0 should be true, false, or at most the task's 0.0 s"),
        ({"stages": [{"hold": "half"}]}, "stages.0.hold: should be a valid boolean"),
        (
            {"hold": 1, "costs": {"position": {"weight": 1, "z": 1, "at": "end"}}, "stages": [{"hold": False}]},
            "stages.0.hold: False, but every cost of the task looks at the hold; set hold: true",
        ),
        (
            {
                "hold": 1,
                "costs": {"position": {"weight": 1, "z": 1}, "margins": {"weight": 1, "speed": 0.1}},
                "stages": [{"hold": False}],
            },
            "costs.margins: looks at the hold, which no stage simulates, so it counts nowhere; let it look at the horizon",
        ),
        ({"search": {"optimizer": "cmaes"}}, "search.optimizer: no optimizer 'cmaes'; did you mean cma?"),
        ({"search": {"settings": {"aim": 6}}}, "search.settings: no 'aim' for cma-aimed; did you mean aimed?"),
        (
            {"search": {"optimizer": "cma", "settings": {"aimed": 6}}},
            "search.settings: no 'aimed' for cma; it takes none",
        ),
        (
            {"search": {"optimizer": "cem", "settings": {"elit": 0.2}}},
            "search.settings: no 'elit' for cem; did you mean elite?",
        ),
        ({"search": {"trials": 0}}, "search.trials: 0 should be at least 1; the paper has about 3000"),
        ({"search": {"trials": "many"}}, "search.trials: should be a valid integer"),
        ({"search": {"population": 3}}, "search.population: 3 should be 4 or more; leave it out for the usual one"),
        ({"search": {"step": -0.1}}, "search.step: -0.1 should be a positive number of rad"),
        ({"search": {"smoothness": -0.1}}, "search.smoothness: -0.1 should be 0 or more"),
        ({"search": {"restart": 0}}, "search.restart: 0 should be at least 1; leave it out to go on"),
        ({"search": {"polish": -1}}, "search.polish: -1 should be 0 or more trials"),
        ({"robot": "hyq2max"}, "robot: should be a table of keys and values, is 'hyq2max'"),
        (
            {"physics": {"integrator": "euler"}},
            "physics.integrator: should be 'implicitfast', 'implicit', 'Euler' or 'RK4'",
        ),
        ({"physics": {"timestep": 0.1}}, "physics.timestep: 0.1 s is out of range"),
        ({"scene": {"boxes": [{"size": [1, 1, 1]}]}}, "scene.boxes.0.position: missing"),
        ({"scene": {"boxes": [{"position": [1, 1], "size": [1, 1, 1]}]}}, "scene.boxes.0.position.2: missing"),
        ({"name": ""}, "name: '' should be a word or two that can name a directory"),
        ({"name": "../up"}, "name: '../up' should be a word or two"),
    ],
)
def test_each_mistake_is_one_line_that_names_the_key(changes: dict[str, object], message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        task_from_dict(minimal(**changes), where="mine.yaml")
    assert "\n" not in str(caught.value)
    assert re.match(r"mine\.yaml(\.|: )" + re.escape(message), str(caught.value)), str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("horizn=1", "changes: horizn: no 'horizn' in the task; did you mean horizon?"),
        ("costs.efort.weight=1", "changes: costs.efort.weight: no 'efort' in costs; did you mean effort?"),
        ("costs.effort.wight=1", "changes: costs.effort.wight: no 'wight' in costs.effort; did you mean weight?"),
        ("stages.7.step=1", "changes: stages.7.step: no '7' in stages; valid names: 0, 1"),
        ("costs.near=0.1", "changes: costs.near: no 'near' in costs; valid names: "),
        ("costs.near={weight: 1}", "changes: costs.near: no term 'near'; valid names: "),
        ("success.apart={minimum: 0}", "changes: success.apart: 'apart' is not a quantity; add the key quantity; "),
        ("horizon.ms=300", "changes: horizon.ms: horizon is a single value, 0.3; set it as a whole"),
        ("scene.boxes.0=1", "changes: scene.boxes.0: scene.boxes is empty; set it as a whole"),
        ("search.settings.aimd=3", "changes: search.settings: no 'aimd' for cma-aimed; did you mean aimed?"),
        ("horizon", "changes: horizon: should be path=value, such as horizon=0.4"),
        ("=3", "changes: : no '' in the task"),
        ("horizon=[1", "changes: horizon: not YAML"),
        ("horizon=", f"changes: {HORIZON}, is empty"),
        ("horizon=long", f"changes: {HORIZON}, is 'long'"),
        ("horizon=0", "changes: horizon: 0.0 s should be at least one time step"),
        ("start.fall.height=1", "changes: start.fall.height: no 'fall' in start"),
        ("start.settled.posture=[1]", "changes: start.settled.posture: should be a valid string, is a list"),
    ],
)
def test_changes_that_do_not_fit(change: str, message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        load_task("rearing", changes=[change])
    assert str(caught.value).startswith(message), str(caught.value)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("rearin", "no task 'rearin'; did you mean rearing? (or the path of a YAML file)"),
        ("no/such.yaml", "no/such.yaml: no such file; give a built-in task or the path of a YAML file"),
        ("such.yaml", "such.yaml: no such file"),
        ("", "no task ''; valid names: "),
    ],
)
def test_tasks_that_are_not_there(name: str, message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        load_task(name)
    assert str(caught.value).startswith(message), str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (["robot.name=hyq2mx"], r"no robot 'hyq2mx'; did you mean hyq2max\?"),
        (["robot.actuation=hydralic"], r"actuation: no actuation 'hydralic'; did you mean hydraulic\?"),
        (["robot.kp=-1"], r"kp should be a number that is not negative"),
        (["start.settled.posture={lf_ha: 0.1}"], r"^start.settled.posture: .*no joint 'lf_ha'; did you mean lf_haa\?"),
        (
            ["start.settled.posture={hnd: crouched}"],
            r"^start.settled.posture: .*no leg 'hnd' to take the posture 'crou",
        ),
        (["start.settled.posture={hind: low}"], r"^start.settled.posture: .*no posture 'low'; valid names: crouched"),
        (["start.settled.posture=netral"], r"^start.settled.posture: .*no posture 'netral'; did you mean neutral\?"),
        (
            ["policy.initial=interpolate", "policy.goal=stand"],
            r"^policy.goal: .*no posture 'stand'; valid names: crouched, free, h2m, neutral, stretched",
        ),
        (
            ["policy.initial=interpolate", "policy.through=[crouched, {hind: low}]"],
            r"^policy.through.1: .*no posture 'low'; valid names: crouched",
        ),
        (
            ["policy.initial=interpolate", "policy.through=[{'?h_kfe': 170 deg}]"],
            r"^policy.through.0: .*lh_kfe.* 2.967",
        ),
        (
            ["policy.settle=0.3", "policy.goal={lik: squat-jump}"],
            r"^policy.goal: no leg or joint 'lik' in hyq2max; did you mean like\?",
        ),
        (
            ["policy.settle=0.3", "policy.goal={'*_hfe': [-1, -2]}"],
            r"^policy.goal.\*_hfe: \[-1.0, -2.0\] should be \[lowest, highest\]",
        ),
        (["policy.variance=-1"], r"^policy.variance: -1.0 should be between"),
        (["policy.groups=[[lf, rf], [lh, xx]]"], r"^policy.groups: .*no leg 'xx'; valid names: lf, lh, rf, rh"),
        (["policy.groups=[[lf, rf], [lh]]"], r"^policy.groups: rh in no group; put every leg of hyq2max in one group"),
        (["policy.groups=[[lf, rf, lh, rh], [rh]]"], r"^policy.groups: a leg is in two groups; put every leg"),
        (["policy.groups=[[lf, rf, lh, rh], []]"], r"^policy.groups: a group is empty; leave it out"),
        (
            ["costs.effort={term: ground_contact, bodies: [trnk], weight: 1}"],
            r"^costs.effort.bodies: no body 'trnk' in hyq2",
        ),
        (["costs.effort={term: posture, position: [1], weight: 1}"], r"1 angles for a robot of 12 joints"),
        (["scene.boxes=[{position: [0, 0, 0.4], size: [1, 1, 0.8]}]"], r"^start: .*box0.* overlap by 0.\d+ m"),
        (
            ["search.optimizer=cem", "search.settings={elite: 2}"],
            r"^search.settings.elite: 2.0 should be a share, more than 0 and at most 1",
        ),
    ],
)
def test_what_does_not_fit_the_robot(changes: list[str], message: str) -> None:
    with pytest.raises(LevadeError, match=message) as caught:
        make_objective(load_task("rearing", changes=changes), threads=1)
    assert "\n" not in str(caught.value)


def test_a_python_function_is_a_cost_that_no_file_holds() -> None:
    task = load_task("rearing")
    mine = dataclasses.replace(task, costs={**task.costs, "mine": Cost(lambda t: t.joint_torque.max(axis=(1, 2)), 1.0)})
    objective = make_objective(mine, threads=1)
    assert objective.evaluate(objective.space.mean[None]).terms["mine"][0] > 10
    with pytest.raises(LevadeError, match=r"costs.mine: a Python function cannot be written to a task file"):
        task_to_yaml(mine)


def test_units_of_the_robot_are_its_own_size() -> None:
    """HyQ2Max: links of 0.36 and 0.38 m, hips 0.4435 m before and behind (data sheet); the rest by definition."""
    size = dimensions(load_robot("hyq2max"))
    assert (size.leg, size.trunk) == pytest.approx((0.74, 0.887))
    assert size.fall == pytest.approx(math.sqrt(2 * size.height / 9.81))
    task = task_from_dict(
        minimal(
            horizon="6 falls",
            scene={"boxes": [{"position": ["1 trunk", 0, "0.25 heights"], "size": [1, 2, "0.5 heights"]}]},
            start={"settled": {"x": "-0.5 legs"}},
            success={
                "apex": {"quantity": "height", "minimum": "1.5 heights", "at": "max"},
                "still": {"quantity": "speed", "maximum": "0.1 heights/fall"},
                "calm": {"quantity": "angular_speed", "maximum": "1 rad/fall"},
            },
            stages=[{"promote": {"apex": "0.1 heights"}}, {}],
        ),
        where="mine.yaml",
    )
    assert task.horizon == pytest.approx(6 * size.fall)
    assert task.scene.boxes[0].position == pytest.approx((0.887, 0, 0.25 * size.height))
    assert task.scene.boxes[0].size == pytest.approx((1, 2, 0.5 * size.height))
    assert dataclasses.asdict(task.start.choice)["x"] == pytest.approx(-0.37)
    assert task.success["apex"].minimum == pytest.approx(1.5 * size.height)
    assert task.success["still"].maximum == pytest.approx(0.1 * size.height / size.fall)
    assert task.success["calm"].maximum == pytest.approx(1 / size.fall)
    assert task.stages[0].promote["apex"] == pytest.approx(0.1 * size.height)
    assert task_from_dict(task_to_dict(task), where="x") == task


@pytest.mark.slow
def test_the_robot_is_changed_before_its_units_are_read(tmp_path: Path) -> None:
    content = minimal(horizon="2 falls", robot={"name": "hyq2max", "kp": 500.0})
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(content))
    folder = Path(str(load_robot("hyq2max").source)).parent
    (tmp_path / "long").mkdir()
    (tmp_path / "long" / "hyq2max.xml").write_text((folder / "hyq2max.xml").read_text())
    crouched = (
        (folder / "robot.yaml").read_text().replace('"?f_hfe": 0.63, "?f_kfe": -1.32', '"?f_hfe": 1.0, "?f_kfe": -2')
    )
    crouched = crouched.replace('"?h_hfe": -0.63, "?h_kfe": 1.32', '"?h_hfe": -1.0, "?h_kfe": 2')
    (tmp_path / "long" / "robot.yaml").write_text(crouched)
    other = str(tmp_path / "long" / "robot.yaml")
    fall, low = (dimensions(load_robot(name)).fall for name in ("hyq2max", other))
    assert low < 0.95 * fall
    assert load_task(tmp_path / "mine.yaml").horizon == pytest.approx(2 * fall)
    assert load_task(tmp_path / "mine.yaml", robot=other).horizon == pytest.approx(2 * low)
    by_path = load_task(tmp_path / "mine.yaml", changes=[f"robot.name={other}", "hold=1 falls", "robot.kp=400"])
    assert (by_path.horizon, by_path.hold) == pytest.approx((2 * low, low))
    assert by_path.robot.kp == 400.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"horizon": "5 heights"}, "horizon: '5 heights' is a length, but this is a duration; units here: s, ms, fall"),
        ({"horizon": "5 hights"}, "horizon: unknown unit 'hights' in '5 hights'; units here: s, ms, fall"),
        ({"robot": {"name": "hyq"}, "horizon": "5 falls"}, "no robot 'hyq'; did you mean hyq2max?"),
        ({"robot": {"nam": "hyq"}, "horizon": "5 falls"}, "mine.yaml.robot: unknown key 'nam'; did you mean name?"),
    ],
)
def test_units_of_the_robot_that_do_not_fit(changes: dict[str, object], message: str) -> None:
    with pytest.raises(LevadeError) as caught:
        task_from_dict(minimal(**changes), where="mine.yaml")
    assert message in str(caught.value)


@pytest.mark.slow
def test_a_terrain_from_a_file_is_part_of_the_task(tmp_path: Path) -> None:
    np.save(tmp_path / "hills.npy", np.linspace(0, 0.1, 12).reshape(3, 4))
    content = minimal(scene={"terrain": {"file": "hills.npy", "size": ["2 trunks", 1]}})
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(content))
    task = load_task(tmp_path / "mine.yaml")
    assert task.scene.terrain is not None
    np.testing.assert_allclose(task.scene.terrain.heights, np.linspace(0, 0.1, 12).reshape(3, 4), rtol=1e-5)
    (tmp_path / "hills.npy").unlink()
    (tmp_path / "again.yaml").write_text(task_to_yaml(task))
    assert load_task(tmp_path / "again.yaml") == task
    with pytest.raises(LevadeError, match=r"scene.terrain.file: .*hills.npy: no such file"):
        load_task(tmp_path / "mine.yaml")
    for terrain, message in (
        (
            {"file": "hills.npy", "heights": [[0, 1], [1, 0]], "size": [1, 1]},
            "give heights or a file of them, not both",
        ),
        ({"file": 3, "size": [1, 1]}, "terrain.file: should be the path of a file, is 3"),
        ({"file": "a.png", "height": "low", "size": [1, 1]}, "terrain.height: should be the height of white"),
    ):
        with pytest.raises(LevadeError, match=message):
            task_from_dict(minimal(scene={"terrain": terrain}), where="mine.yaml")


def test_a_file_that_a_terminal_would_obey_is_not_printed(tmp_path: Path) -> None:
    path = tmp_path / "task.yaml"
    path.write_text("name: x  # \x1b[2J\n")
    with pytest.raises(LevadeError, match=r"task.yaml: is not a text file, as it contains control characters"):
        task_text(path)
    path.write_bytes(b"name: x  # caf\xc3\xa9\r\n\tand a tab\r\n")
    assert task_text(path) == "name: x  # café\n\tand a tab\n"


def test_a_motions_task_reads_no_files(tmp_path: Path) -> None:
    content = task_to_dict(load_task("rearing"))
    np.save(tmp_path / "heights.npy", np.eye(2))
    content["scene"] |= {"terrain": {"file": str(tmp_path / "heights.npy"), "size": [1, 1]}}
    assert task_from_dict(content, where="task").scene.terrain is not None
    with pytest.raises(LevadeError, match=r"task\.scene\.terrain: unknown key 'file'"):
        task_from_dict(content, where="task", code=True)


class Own:
    """An optimizer with a setting that no other has."""

    SETTINGS = ("limits",)


def test_the_settings_of_an_optimizer_of_ones_own_survive_a_file() -> None:
    task = load_task("rearing")
    own = dataclasses.replace(task, search=dataclasses.replace(task.search, optimizer=Own, settings={"limits": 3}))
    content = task_to_dict(own, code=True)
    read = task_from_dict(content, where="file", code=True)
    assert read.search.settings == {"limits": 3}
    assert task_to_dict(read, code=True) == content
