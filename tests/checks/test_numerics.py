"""The same motion in other numbers: references from the policy itself, and the physics converges."""

from __future__ import annotations

import itertools

import mujoco
import numpy as np
import pytest

from levade.checks import numerics, other_engines
from levade.checks.numerics import VARIANTS, Variant, simulate_at, varied
from levade.motions import Motion, RecordedSimulation
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


@pytest.fixture(scope="module")
def moving() -> Motion:
    changes = ["search.population=6", "search.trials=6", "search.step=0.2", "hold=0.05"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    return record(objective, solve(objective, seed=3), seed=3)


@pytest.mark.slow
def test_as_recorded_is_the_motion_itself(moving: Motion) -> None:
    found = numerics(RecordedSimulation(moving, threads=1))
    assert list(found) == list(VARIANTS)
    own = found["as recorded"]
    assert own.apart["position_largest"] < 1e-9
    for name, error in own.errors.items():
        assert error == pytest.approx(moving.meta["errors"][name], abs=1e-9)
    for name, one in found.items():
        assert one.reference == "policy", name
        assert (one.apart["position_largest"] > 1e-6) == (name != "as recorded"), name


@pytest.mark.golden
def test_smaller_steps_converge(moving: Motion) -> None:
    simulation = RecordedSimulation(moving)
    ends = [simulate_at(simulation, Variant(parts=parts))[0].trunk_com_position()[0, -1] for parts in (1, 2, 4, 8)]
    differences = [float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(ends)]
    assert differences[2] < differences[0]


def test_variants_change_what_they_say(moving: Motion) -> None:
    simulation = RecordedSimulation(moving)
    soft = varied(simulation.model_copy(), Variant(softness=2.0))
    foot = simulation.model.geom("lf_foot").id
    assert soft.geom_solref[foot, 0] == 2 * simulation.model.geom_solref[foot, 0]
    assert 1 - soft.geom_solimp[foot, 0] == pytest.approx(2 * (1 - simulation.model.geom_solimp[foot, 0]))
    other = varied(simulation.model_copy(), Variant(parts=2, integrator=True, cone=True))
    assert other.opt.integrator == mujoco.mjtIntegrator.mjINT_EULER
    assert other.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL
    assert other.opt.timestep == 0.001
    assert varied(other, Variant(integrator=True, cone=True)).opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC


def test_another_engine_is_tried_or_says_why_not(standing: Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    from levade.checks import engines
    from levade.errors import LevadeError

    found = other_engines(RecordedSimulation(standing))
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

    def missing(*_: object, **__: object) -> None:
        raise LevadeError("ode: not installed; install it")

    monkeypatch.setattr(engines, "replay_in", missing)
    gone = other_engines(RecordedSimulation(standing))["ode"]
    assert (gone.success, gone.reason) == (None, "ode: not installed; install it")
