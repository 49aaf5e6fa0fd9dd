"""The built-in robust variants: the nominal tasks on robots that differ from the model, and nothing else of another kind."""

from __future__ import annotations

from dataclasses import replace

import pytest

from levade.checks import numerics, other_engines, perturbed
from levade.costs import Margins
from levade.engines import Perturbation
from levade.motions import RecordedSimulation
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import HorizonRange, builtin_tasks, load_task, looks_at_hold

VARIANTS = [name for name in builtin_tasks() if name.endswith("-robust")]
OWN_CRITERIA = {"rearing-robust", "posture-recovery-robust"}
"""Those that ask for what hardware needs, where the nominal task asks for what one exact model can do."""


def test_every_variant_is_there() -> None:
    assert set(VARIANTS) == {
        *("rearing-robust", "posture-recovery-robust", "self-righting-robust", "squat-jump-robust", "levade-robust"),
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", VARIANTS)
def test_a_variant_has_the_robot_scene_start_and_five_times_the_budget_of_its_nominal_task(name: str) -> None:
    variant, nominal = load_task(name), load_task(name.removesuffix("-robust"))
    for key in ("robot", "scene", "physics", "start", "hold"):
        assert getattr(variant, key) == getattr(nominal, key), key
    assert variant.policy.groups == nominal.policy.groups
    assert nominal.robust is None
    assert variant.robust is not None
    assert variant.robust.perturb == Perturbation()  # all that a check perturbs, and as much
    assert variant.robust.required == 1.0
    assert variant.search.trials <= 5 * nominal.search.trials
    assert [stage.robust for stage in variant.stages] == [False, True]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(VARIANTS) - OWN_CRITERIA))
def test_a_variant_asks_for_the_same_motion(name: str) -> None:
    variant, nominal = load_task(name), load_task(name.removesuffix("-robust"))
    where_it_begins = {"initial": nominal.policy.initial, "through": nominal.policy.through}
    assert replace(variant.policy, **where_it_begins) == nominal.policy
    assert variant.success == nominal.success
    if isinstance(nominal.horizon, HorizonRange):
        assert nominal.horizon.begin == pytest.approx(variant.horizon)
    else:
        assert variant.horizon == nominal.horizon
    costs = dict(variant.costs)
    if name == "self-righting-robust":  # in the hold, too, which its nominal task's costs do not look at
        assert looks_at_hold(costs.pop("stays").term)
    assert costs == nominal.costs


@pytest.mark.parametrize("name", sorted(OWN_CRITERIA))
def test_criteria_of_its_own_are_those_of_the_nominal_task_as_hardware_needs_them(name: str) -> None:
    """0.1 rad and 5 cm, of the same targets, and of at least as many quantities."""
    variant, nominal = load_task(name), load_task(name.removesuffix("-robust"))
    for one in nominal.success.values():
        assert any(
            (one.quantity, one.target, one.at) == (other.quantity, other.target, other.at)
            for other in variant.success.values()
        )
    for one in variant.success.values():
        if one.target is not None:
            assert one.tolerance == (0.05 if one.quantity == "height" else 0.1)
        else:
            assert (one.quantity, one.at) == ("speed", "end")


def test_within_the_limits_is_the_robust_rearing_with_margins() -> None:
    """The same motion is asked for, a tenth of a second later; of the costs, only the margins are new."""
    variant, robust = load_task("rearing-within-limits"), load_task("rearing-robust")
    for key in ("robot", "scene", "physics", "start", "hold", "success"):
        assert getattr(variant, key) == getattr(robust, key), key
    assert variant.horizon == 0.4
    costs = dict(variant.costs)
    margins = costs.pop("margins")
    assert costs == robust.costs
    assert isinstance(margins.term, Margins)
    assert margins.term.over == "all"
    assert variant.robust is not None
    assert variant.robust.perturb == Perturbation()


@pytest.mark.slow
def test_self_righting_within_the_limits_is_the_robust_one_that_keeps_them() -> None:
    variant, robust = load_task("self-righting-within-limits"), load_task("self-righting-robust")
    for key in ("robot", "scene", "physics", "start", "hold", "policy"):
        assert getattr(variant, key) == getattr(robust, key), key
    assert variant.horizon == pytest.approx(1.5 * robust.horizon, abs=variant.physics.timestep)
    costs, success = dict(variant.costs), dict(variant.success)
    assert isinstance(costs.pop("margins").term, Margins)
    assert costs == {name: cost for name, cost in robust.costs.items() if name != "stays"}
    kept = [success.pop(name) for name in ("range", "speeds", "line")]
    assert success == robust.success
    assert {one.quantity for one in kept} == {"angle_margin", "speed_margin", "torque_speed_margin"}
    assert all((one.minimum, one.at) == (0, "min") for one in kept)
    assert variant.search.trials == robust.search.trials
    assert variant.robust is not None
    assert variant.robust.perturb == Perturbation()


@pytest.mark.golden
@pytest.mark.slow
def test_a_robust_search_finds_a_motion_that_holds_on_robots_it_has_not_seen() -> None:
    """With feedback, which needs fewer trials; docs/check.md has the shares of whole searches without."""
    task = load_task("rearing-robust", changes=["feedback={}", "search.trials=4000"])
    solution = solve(objective := make_objective(task, threads=0), seed=0)
    motion = record(objective, solution, seed=0)
    simulation = RecordedSimulation(motion)
    found = perturbed(simulation, Perturbation(), runs=200, seed=0, feedback=motion.feedback)
    assert found.share >= 0.95, found.errors
    assert numerics(simulation)["half time step"].success
    ode = other_engines(simulation)["ode"]
    assert ode.success or ode.reason
