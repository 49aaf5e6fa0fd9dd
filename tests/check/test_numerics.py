"""The same motion in other numbers: references from the policy itself, and the physics converges."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from levade.check import Subject, numerics, other_engines
from levade.check.numerics import VARIANTS, Variant, simulate_at, varied
from levade.check.subject import interpolated
from levade.motion import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


@pytest.fixture(scope="module")
def moving() -> Motion:
    changes = ["search.population=6", "search.trials=6", "search.step=0.2", "hold=0.05"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    return record(objective, solve(objective, seed=3), seed=3)


def test_as_recorded_is_the_motion_itself(moving: Motion) -> None:
    found = numerics(Subject(moving, threads=1))
    assert list(found) == list(VARIANTS)
    own = found["as recorded"]
    assert own.apart["position_largest"] < 1e-9
    for name, error in own.errors.items():
        assert error == pytest.approx(moving.meta["errors"][name], abs=1e-9)
    for name, one in found.items():
        assert one.reference == "policy", name
        assert (one.apart["position_largest"] > 1e-6) == (name != "as recorded"), name


def test_references_at_half_the_step_are_the_policys_own(moving: Motion) -> None:
    subject = Subject(moving)
    fine, source = subject.reference_at(2)
    assert source == "policy"
    assert fine.timestep == subject.timestep / 2
    assert fine.steps == 2 * subject.reference.steps
    assert np.array_equal(fine.position[:, 1::2], subject.reference.position)
    # between two rows it is what the policy is there, not one of them again
    weights = moving["weights"].reshape(6, 16)
    time = (np.arange(300) + 1) / 300
    kernels = np.exp(-((time[:, None] - np.linspace(0, 1, 16)) ** 2) / 0.02)
    expected = (kernels / kernels.sum(axis=1, keepdims=True)) @ weights[1]
    assert np.allclose(fine.position[0, :300, 1], expected, atol=1e-9)


def test_a_horizon_of_no_whole_number_of_steps_stays_as_long_as_the_file() -> None:
    """300.9 ms are 150 steps of 2 ms, and would be 301 of 1 ms."""
    changes = ["search.population=4", "search.trials=4", "search.step=0.1", "horizon=0.3009", "hold=0.0509"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    subject = Subject(record(objective, solve(objective, seed=0), seed=0), threads=1)
    fine, source = subject.reference_at(2)
    assert source == "policy"
    assert (fine.steps, fine.horizon_steps) == (2 * subject.reference.steps, 2 * subject.reference.horizon_steps)
    assert np.array_equal(fine.position[:, 1::2], subject.reference.position)
    assert {"half time step", "quarter time step"} <= set(numerics(subject))


def test_without_the_robots_description_cubics_come_as_near(moving: Motion, changed: Callable[..., Motion]) -> None:
    subject = Subject(moving)
    exact, ours = subject.reference_at(4)[0], interpolated(subject.reference, 4)
    assert np.abs(ours.position - exact.position).max() < 1e-6
    assert np.abs(ours.velocity - exact.velocity).max() < 1e-3
    task = {**moving.meta["task"], "robot": {**moving.meta["task"]["robot"], "name": "gone.yaml"}}
    lost = Subject(changed(moving, {"task": task}))
    found, source = lost.reference_at(4)
    assert source == "interpolation"
    assert np.array_equal(found.position, ours.position)
    assert numerics(lost)["half time step"].reference == "interpolation"


def test_smaller_steps_converge(moving: Motion) -> None:
    subject = Subject(moving)
    ends = [simulate_at(subject, Variant(parts=parts))[0].trunk_com_position()[0, -1] for parts in (1, 2, 4, 8)]
    differences = [float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(ends)]
    assert differences[2] < differences[0]


def test_variants_change_what_they_say(moving: Motion) -> None:
    subject = Subject(moving)
    soft = varied(subject.model_copy(), Variant(softness=2.0))
    foot = subject.model.geom("lf_foot").id
    assert soft.geom_solref[foot, 0] == 2 * subject.model.geom_solref[foot, 0]
    assert 1 - soft.geom_solimp[foot, 0] == pytest.approx(2 * (1 - subject.model.geom_solimp[foot, 0]))
    other = varied(subject.model_copy(), Variant(parts=2, integrator=True, cone=True))
    assert other.opt.integrator == mujoco.mjtIntegrator.mjINT_EULER
    assert other.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL
    assert other.opt.timestep == 0.001
    assert varied(other, Variant(integrator=True, cone=True)).opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC


def test_another_engine_is_tried_or_says_why_not(standing: Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    from levade.check import engines
    from levade.errors import LevadeError

    found = other_engines(Subject(standing))
    assert set(found) == {"ode"}
    one = found["ode"]
    if one.success is None:
        assert one.reason
    else:
        assert one.apart is not None
        assert one.apart["position_at_horizon"] < 0.02  # a robot that stands
        assert one.over_time is not None
        assert one.over_time["time"][-1] == pytest.approx(0.3)
        assert len(one.over_time["position"]) == len(one.over_time["time"])

    def missing(*_: object) -> None:
        raise LevadeError("ode: not installed; install it")

    monkeypatch.setattr(engines, "replay_in", missing)
    gone = other_engines(Subject(standing))["ode"]
    assert (gone.success, gone.reason) == (None, "ode: not installed; install it")
