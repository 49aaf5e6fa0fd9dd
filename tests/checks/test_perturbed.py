"""Perturbed runs: the same for any number of threads, and they find what was planted."""

from __future__ import annotations

import json
from dataclasses import fields, replace

import numpy as np
import pytest

from levade.checks import Demands, check, margins, perturbed
from levade.costs import Criterion, success
from levade.engines import Perturbation
from levade.motions import Motion, RecordedSimulation

NONE = dict.fromkeys(one.name for one in fields(Perturbation))


def only(**ranges: tuple[float, float]) -> Perturbation:
    return Perturbation(**{**NONE, **ranges})  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_result_depends_on_the_seed_and_not_on_threads(standing: Motion) -> None:
    one, two, other = (
        perturbed(RecordedSimulation(standing, threads=threads), Perturbation(), runs=70, seed=seed).to_json()
        for threads, seed in ((1, 3), (2, 3), (1, 4))
    )
    assert json.dumps(one, allow_nan=False) == json.dumps(two)
    assert one["worst"] != other["worst"]
    assert one["runs"] == 70
    assert one["low"] <= one["share"] <= one["high"]


@pytest.mark.slow
def test_fewer_runs_are_the_first_of_more(standing: Motion) -> None:
    few, many = (perturbed(RecordedSimulation(standing), Perturbation(), runs=runs, seed=0) for runs in (20, 80))
    for name, one in few.errors.items():
        assert many.errors[name]["lowest"] <= one["lowest"]
        assert one["missed"] <= many.errors[name]["missed"]


def test_without_perturbations_every_run_is_the_motion(standing: Motion) -> None:
    found = perturbed(RecordedSimulation(standing), only(), runs=5, seed=0)
    assert found.successes == 5
    assert found.sensitivity == ()
    for name, one in found.errors.items():
        for column in ("lowest", "mean", "highest"):
            assert one[column] == pytest.approx(standing.meta["errors"][name], abs=1e-9)


@pytest.mark.slow
def test_ground_that_rises_lifts_the_robot_by_as_much(standing: Motion) -> None:
    """Within +-1 cm of 5743 mm a share of 1/3 of +-3 cm of ground succeeds; and nothing but the ground explains it."""
    simulation = RecordedSimulation(standing)
    off = standing.meta["errors"]["height"]
    found = perturbed(simulation, only(ground_height=(-0.03, 0.03), friction=(0.99, 1.01)), runs=400, seed=1)
    values = Perturbation(ground_height=(-0.03, 0.03)).draw(simulation.model, simulation.joints, n=400, seed=1).values
    expected = int((np.abs(values["ground_height"][:, 0] + off) <= 0.01).sum())
    assert found.successes == pytest.approx(expected, abs=3)
    strongest, other = found.sensitivity
    assert (strongest.parameter, other.parameter) == ("ground_height", "friction")
    assert strongest.explains > 0.45
    assert other.explains < 0.02
    assert strongest.alone == (0, 2)
    assert other.alone == (2, 2)
    at_worst = found.worst["values"]["ground_height"][0]
    assert found.worst["errors"]["height"] == pytest.approx(at_worst + off, abs=1e-3)
    assert abs(at_worst) > 0.029


def test_a_slope_tilts_the_robot_that_stands_on_it(standing: Motion) -> None:
    simulation = RecordedSimulation(standing, criteria={"roll": Criterion("roll", target=0.0, tolerance=0.05)})
    found = perturbed(simulation, only(ground_slope=(0.04, 0.04)), runs=2, seed=0)
    assert found.errors["roll"]["mean"] == pytest.approx(0.04, abs=0.01)
    assert found.successes == 2


@pytest.mark.slow
def test_a_joint_is_named_where_it_alone_matters(standing: Motion) -> None:
    """The sag of one knee's servo moves the trunk; which knee, the errors tell: roll of left and right are opposite."""
    simulation = RecordedSimulation(standing, criteria={"roll": Criterion("roll", target=0.0, tolerance=0.001)})
    found = perturbed(simulation, only(kp=(0.5, 1.5)), runs=200, seed=0)
    assert found.sensitivity[0].parameter == "kp"
    assert found.sensitivity[0].number in simulation.embodiment.joint_names
    assert 0.2 < found.sensitivity[0].explains <= 1.0


@pytest.mark.slow
def test_the_worst_run_is_one_that_fails(standing: Motion) -> None:
    """Runs fail by 1 cm of a bound at the height, and succeed with up to 0.05 rad of a tolerance of 0.1."""
    bound = standing["trunk_com_position"][-1, 2] - 0.002
    criteria = {
        "height": Criterion("height", minimum=float(bound)),
        "pitch": Criterion("pitch", target=0.0, tolerance=0.1),
    }
    found = perturbed(
        RecordedSimulation(standing, criteria=criteria),
        only(ground_height=(-0.005, 0.005), ground_slope=(-0.05, 0.05)),
        runs=60,
        seed=0,
    )
    assert 0 < found.successes < 60
    assert found.worst["success"] is False


def test_the_line_of_the_actuators_is_a_criterion_in_a_check_too(standing: Motion) -> None:
    """As the search that made the motion judges it, and as the margins do."""
    criteria = {"line": Criterion("torque_speed_margin", minimum=0.99, at="min")}
    simulation = RecordedSimulation(standing, criteria=criteria)
    found = perturbed(simulation, only(), runs=2, seed=0)
    left = margins(simulation, Demands())["torque_speed"].value
    assert left is not None
    assert left < 0.98
    assert found.errors["line"]["mean"] == pytest.approx(left - 0.99, abs=1e-6)
    assert found.successes == 0


def test_the_certificate_names_what_the_task_says_and_what_counts_on_perturbed_models(standing: Motion) -> None:
    enough = {"height": replace(standing.task.success["height"], tolerance=0.05)}
    eased = standing.with_task(replace(standing.task, good_enough=enough))
    asked = {"pitch": replace(standing.task.success["pitch"], tolerance=0.006)}
    goal = {one.criterion: one for one in check(eased, runs=2, asked=asked).goal}
    assert (goal["height"].task, goal["height"].model) == ("0.574 ± 0.01 m", "0.574 ± 0.01 m")
    assert goal["height"].perturbed == "0.574 ± 0.05 m"
    assert (goal["pitch"].task, goal["pitch"].perturbed) == ("0 ± 0.006 rad", "0 ± 0.05 rad")
    assert Criterion("height", minimum=0.1).wording == "at least 0.1 m"
    assert Criterion("speed_margin", minimum=0.1, maximum=1.0).wording == "0.1 to 1 of limit"


@pytest.mark.slow
def test_a_broken_simulation_is_a_failure_not_a_crash(standing: Motion) -> None:
    simulation = RecordedSimulation(standing)
    sample = Perturbation().draw(simulation.model, simulation.joints, n=3, seed=0)
    sample.values["kd"][1] = 1e9
    trajectories = simulation.rollout(sample)
    assert not success(simulation.criteria, trajectories)[1] or trajectories.diverged[1] == 0
    whole = perturbed(simulation, Perturbation(kd=(1e6, 1e9)), runs=10, seed=0)
    json.dumps(whole.to_json(), allow_nan=False)
    assert whole.successes < 10
