"""The plan for hardware: the same goal for any task and robot, limits beside it, costs that all count alike."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import yaml

from levade.checks import Demands
from levade.costs import Criterion, Effort, Margins, Measure, Miss
from levade.errors import LevadeError
from levade.hardware import Plan
from levade.robots import Dimensions, Robot, dimensions, load_robot
from levade.tasks import Change, Cost, HorizonRange, builtin_tasks, load_task, overview, task_from_dict, task_to_yaml
from levade.tasks.files import read_task
from levade.tasks.goals import miss_of, tolerance
from levade.tasks.policy import make_policy
from levade.trajectory import Trajectories

OWN = [name for name in builtin_tasks() if overview(name).robot == "hyq2max"]
NOMINAL = [name for name in OWN if "robust" not in read_task(builtin_tasks()[name])]


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("hyq2max")


@pytest.mark.parametrize("name", NOMINAL)
def test_every_nominal_task_has_one(name: str, robot: Robot) -> None:
    task = load_task(name)
    plan = Plan.of(task, robot)
    within, robust = plan.within_limits(), plan.robust(0.5)
    for made in (within, robust, plan.closed_loop(0.5)):
        assert (made.scene, made.start, made.hold) == (task.scene, task.start, task.hold)
        assert made.robot == replace(task.robot, linkage=True)
        assert set(made.success) == {*task.success, *plan.limits}
        for key, criterion in task.success.items():
            one = made.success[key]
            assert (one.quantity, one.target, one.minimum, one.at) == (
                *(criterion.quantity, criterion.target, criterion.minimum, criterion.at),
            )
            assert (one.tolerance or 0.0) >= (criterion.tolerance or 0.0)
    assert set(plan.limits) == {
        *("angle_margin", "speed_margin", "torque_speed_margin"),
        "linkage_margin",
        "self_distance",
    }
    assert robust.horizon == 0.5
    assert robust.policy == within.policy
    assert plan.closed_loop(0.5, task.policy).policy == task.policy  # of the motion that it is around
    assert robust.robust is not None
    assert robust.robust.success == {**plan.goal, **task.good_enough}
    assert isinstance(within.horizon, HorizonRange)
    finer = plan.finer(0.5, feedback=False)
    assert (finer.success, finer.costs, finer.horizon) == (robust.success, robust.costs, robust.horizon)
    assert finer.robust == replace(robust.robust, validation=120)
    assert plan.finer(0.5, feedback=True).feedback == plan.closed_loop(0.5).feedback
    assert robust.robust.perturb == replace(plan.perturb, softness=(0.8, 2.0), cone=(0.0, 0.75))
    nearer = plan.nearer(0, 99.0)
    assert nearer.horizon == replace(within.horizon, initial=within.horizon.maximum)
    assert (nearer.success, set(nearer.costs)) == (within.success, set(within.costs))
    if not isinstance(task.horizon, HorizonRange):
        assert within.horizon.minimum == task.horizon


def test_what_is_tighter_than_hardware_needs_is_loosened_and_told(robot: Robot) -> None:
    plan = Plan.of(load_task("rearing"), robot)
    assert set(plan.loosened) == {"pitch", "height"}
    asked, enough = plan.loosened["pitch"]
    assert (asked.tolerance, enough.tolerance) == (0.006, 0.1)
    assert plan.goal["height"].tolerance == pytest.approx(dimensions(robot).height / 12)
    assert Plan.of(load_task("self-righting"), robot).loosened == {}


def test_what_a_task_calls_good_enough_holds_on_perturbed_models_alone(robot: Robot) -> None:
    task = load_task("squat-jump")
    plan = Plan.of(task, robot)
    assert plan.loosened == {name: (task.success[name], one) for name, one in task.good_enough.items()}
    assert plan.goal["straight"] == task.success["straight"]
    for made in (plan.robust(1.0), plan.certifiable(plan.within_limits()), plan.in_one_search()):
        assert made.success["straight"] == task.success["straight"]
        assert made.on_others["straight"] == task.good_enough["straight"]
        assert "speed_margin" in made.success
        assert "speed_margin" not in made.on_others
    robust = plan.robust(1.0)
    assert robust.robust is not None
    assert set(robust.robust.free) == {*task.good_enough, "margins"}  # perturbed models have the easier costs alone
    assert robust.costs["apex"].term.minimum > robust.costs["apex (perturbed)"].term.minimum
    assert {f"{name} (perturbed)" for name in task.good_enough} < set(robust.costs)


def test_what_the_task_says_of_perturbed_models_counts(robot: Robot) -> None:
    changes = ["robust={samples: 4, success: {pitch: {tolerance: 0.2}}}"]
    plan = Plan.of(load_task("rearing", changes=changes), robot)
    assert plan.goal["pitch"].tolerance == 0.2
    assert plan.goal["height"].tolerance == pytest.approx(dimensions(robot).height / 12)


def test_a_robot_without_speed_limits_or_lines_is_asked_for_neither(robot: Robot) -> None:
    limits = replace(robot.limits, velocity=np.full(12, np.inf), stall_torque=None, no_load_speed=None)
    plan = Plan.of(load_task("rearing"), replace(robot, limits=limits, curves={}))
    assert set(plan.limits) == {"angle_margin", "self_distance"}
    (margins,) = (cost.term for cost in plan.within_limits().costs.values() if isinstance(cost.term, Margins))
    assert (margins.speed, margins.torque_speed) == (None, None)


def test_what_a_linkage_transmits_is_asked_of_search_and_certificate_alike(robot: Robot) -> None:
    task = load_task("rearing")
    plan = Plan.of(task, robot, Demands(linkage=0.2))
    assert plan.limits["linkage_margin"].minimum == pytest.approx(0.21)
    made = plan.within_limits()
    (margins,) = (cost.term for cost in made.costs.values() if isinstance(cost.term, Margins))
    assert margins.linkage == pytest.approx(0.3)
    assert plan.robot.limits.torque_curves == robot.curves == load_robot("hyq2max", linkage=True).limits.torque_curves
    assert set(robot.curves) == {2, 5, 8, 11}
    assert made.robot.linkage  # so the certificate judges it
    for other in (Plan.of(task, robot, replace(Demands(), linkage=None)), Plan.of(task, replace(robot, curves={}))):
        assert "linkage_margin" not in other.limits
        assert other.robot.limits.torque_curves == {}
        assert other.within_limits().robot == task.robot


def test_a_limit_of_the_task_s_own_stays(robot: Robot) -> None:
    task = load_task("rearing", changes=["success.gap={quantity: self_distance, minimum: 0.02, at: min}"])
    plan = Plan.of(task, robot)
    assert plan.limits["gap"].minimum == 0.02
    assert "gap" not in plan.goal


def test_costs_of_effort_stay_and_code_too(robot: Robot) -> None:
    task = load_task("rearing")
    task = replace(task, costs={**task.costs, "mine": Cost(lambda trajectories: np.zeros(trajectories.n), 3.0)})
    costs = Plan.of(task, robot).within_limits().costs
    assert costs["mine"] is task.costs["mine"]
    assert isinstance(costs["effort"].term, Effort)
    assert isinstance(costs["pitch"].term, Miss)
    assert "orientation" not in costs


SIZE = Dimensions(height=0.6, leg=0.7, trunk=0.8)


@pytest.mark.parametrize(
    ("criterion", "values"),
    [
        (Criterion("pitch", target=-1.0, tolerance=0.1), {-1.0: 0.0, -0.95: 1.0, -1.1: 4.0}),
        (Criterion("height", minimum=0.5), {0.5: 1.0, 0.525: 0.0, 0.6: 0.0, 0.475: 4.0}),
        (Criterion("tilt", maximum=0.2), {0.2: 1.0, 0.15: 0.0, 0.0: 0.0, 0.25: 4.0}),
        (Criterion("pitch", minimum=-1.1, maximum=-1.0), {-1.05: 0.0, -1.1: 1.0, -1.0: 1.0}),
    ],
)
def test_a_bound_costs_1_and_so_does_half_a_tolerance(criterion: Criterion, values: dict[float, float]) -> None:
    """By hand: squared distance from what costs nothing, over the scale."""
    miss = miss_of(criterion, SIZE)
    for value, cost in values.items():
        low = -np.inf if miss.minimum is None else miss.minimum
        high = np.inf if miss.maximum is None else miss.maximum
        nearest = miss.target if miss.target is not None else np.clip(value, low, high)
        assert ((value - nearest) / miss.scale) ** 2 == pytest.approx(cost)


def test_good_enough_grows_with_the_robot() -> None:
    assert tolerance("rad", SIZE) == 0.1
    assert tolerance("m", SIZE) == pytest.approx(0.05)
    assert tolerance("m/s", SIZE) == 0.0


def test_what_a_certificate_will_ask_for_is_searched_for(robot: Robot) -> None:
    plan = Plan.of(load_task("rearing"), robot, Demands(speed=0.5, position=0.1))
    assert plan.limits["speed_margin"].minimum == pytest.approx(0.51)
    assert plan.limits["angle_margin"].minimum == pytest.approx(0.1)
    (margins,) = (cost.term for cost in plan.within_limits().costs.values() if isinstance(cost.term, Margins))
    assert margins.speed == pytest.approx(0.6)


def test_what_perturbed_models_need_not_do_is_asked_of_the_nominal_one(robot: Robot) -> None:
    plan = Plan.of(load_task("rearing", changes=["robust={samples: 4, success: {pitch: {tolerance: 0.2}}}"]), robot)
    robust = plan.robust(0.4)
    assert {"pitch", "height"} <= set(robust.success)
    assert {"pitch", "height"} <= set(robust.costs)
    assert set(robust.on_others) == {"pitch"}


def test_a_measure_of_one_s_own_is_a_cost_that_a_file_names(robot: Robot) -> None:
    def knee(trajectories: Trajectories, rows: slice) -> np.ndarray:
        return trajectories.joint_position[:, rows, 2]

    task = load_task("rearing")
    own = Criterion(Measure("knee", "rad", knee), target=-1.6, tolerance=0.05)
    made = Plan.of(replace(task, success={**task.success, "knee": own}), robot).within_limits()
    assert made.success["knee"].tolerance == 0.1
    text = task_to_yaml(made, code=True)
    read = task_from_dict(yaml.safe_load(text), where="file", code=True)
    assert read.success["knee"].target == -1.6
    with pytest.raises(LevadeError, match="Python function cannot be written"):
        task_to_yaml(made)


def test_weights_that_sliders_moved_are_no_hindrance(robot: Robot) -> None:
    task = load_task("rearing").changed(Change(3, {"orientation": 2.0}))
    assert Plan.of(task, robot).within_limits().search.changes == ()


def test_a_cost_of_a_criterion_s_name_stays_beside_it(robot: Robot) -> None:
    task = load_task("rearing")
    task = replace(task, costs={**task.costs, "pitch": Cost(Effort(), 2.0)})
    costs = Plan.of(task, robot).within_limits().costs
    assert isinstance(costs["pitch"].term, Miss)
    assert costs["pitch (cost)"].weight == 2.0


def test_references_stay_within_the_joints_ranges(robot: Robot) -> None:
    """Self-righting asks -1.8 rad of a hip that ends at -0.785."""
    task = Plan.of(load_task("self-righting"), robot).within_limits()
    policy = make_policy(task, robot)
    weights = 3.0 * np.random.default_rng(0).normal(size=(4, policy.size))
    position = policy.reference(weights).position
    assert (position >= robot.limits.lower + 0.05).all()
    assert (position <= robot.limits.upper - 0.05).all()
    loose = make_policy(load_task("self-righting"), robot)
    assert (loose.reference(weights[:, : loose.size]).position < robot.limits.lower).any()


def test_the_searches_within_limits_differ(robot: Robot) -> None:
    first, second, third = (Plan.of(load_task("rearing"), robot).within_limits(number) for number in range(3))
    assert [one.search.settings for one in (first, second, third)] == [{}, {"aimed": 0}, {"aimed": 0}]
    assert first.success == second.success == third.success
    assert (third.costs, third.policy) == (first.costs, first.policy)
    assert {name for name in first.costs if first.costs[name] != second.costs[name]} == {"margins"}
    task = load_task("self-righting")
    settings = [Plan.of(task, robot).within_limits(number).search.settings for number in range(3)]
    assert settings == [{"aimed": 0}, {}, {}]


def test_the_second_search_has_narrow_kernels_and_leaves_the_start_slowly(robot: Robot) -> None:
    jump, rearing, slow = (load_task(name) for name in ("squat-jump", "rearing", "rearing-slow"))
    first, second = (Plan.of(jump, robot).within_limits(number).policy for number in range(2))
    assert (second.kernels, second.variance) == (jump.policy.kernels, jump.policy.variance)
    assert (first.kernels, second.room) == (6, first.room)
    assert (first.depart, second.depart) == (0.1, 0.3)
    assert Plan.of(rearing, robot).within_limits(1).policy.kernels == 10  # of 16
    departs = [Plan.of(task, robot).within_limits(1).policy.depart for task in (rearing, slow)]
    assert departs == [rearing.policy.depart, slow.policy.depart]
    assert Plan.of(jump, robot).nearer(1, 1.5).policy == second


def test_without_demands_of_limits_the_goal_alone_is_searched_for_in_the_task_s_own_time(robot: Robot) -> None:
    task = load_task("rearing")
    plan = Plan.of(task, robot, Demands.robust())
    within = plan.within_limits()
    assert not plan.limits
    assert set(within.success) == set(task.success)
    assert within.horizon == plan.nearer(0, 0.4).horizon == task.horizon
    assert not {"margins", "duration"} & set(within.costs)
    assert plan.robust(0.3).robust is not None
    partly = Plan.of(task, robot, replace(Demands(), speed=None))
    assert set(partly.limits) == {"angle_margin", "torque_speed_margin", "linkage_margin", "self_distance"}
    margins = partly.within_limits().costs["margins"].term
    assert isinstance(margins, Margins)
    assert margins.speed is None
