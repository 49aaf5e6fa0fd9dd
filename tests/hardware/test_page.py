"""certificate.html: the runs that it plays are those of the check, and it works in a browser without a network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.checks import Certificate, Demands, check
from levade.engines import Perturbation
from levade.errors import LevadeError
from levade.feedback import Feedback
from levade.hardware import write_certificate
from levade.hardware.page import certificate_data, limits_data
from levade.motions import Motion, RecordedSimulation, run_again, run_trials
from levade.report.packing import unpack
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

pytestmark = pytest.mark.slow

RUNS = 70
"""More than are simulated together."""


@pytest.fixture(scope="module")
def motion() -> Motion:
    """A robot that stands on its feet, and has to be where the model says it is, to the millimetre."""
    changes = [
        "success={height: {target: 0.5743, tolerance: 1 mm}, pitch: {target: 0, tolerance: 0.05}}",
        *("search.population=4", "search.trials=4", "search.step=1e-9"),
    ]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    return record(objective, solve(objective, seed=0), seed=0)


@pytest.fixture(scope="module")
def certificate(motion: Motion) -> Certificate:
    return check(motion, runs=RUNS, seed=3, threads=2)


def test_a_run_can_be_made_again_alone(motion: Motion) -> None:
    """To the bit, with what its sensors got wrong."""
    simulation = RecordedSimulation(motion, threads=2)
    sample = Perturbation().draw(simulation.model, simulation.joints, n=RUNS, seed=1)
    random = np.random.default_rng(0)
    joints = simulation.joints
    gain = 1e-3 * random.normal(size=(1, joints, 3 * joints + 6))
    feedback = Feedback(gain, np.zeros((1, 2 * joints + 6)), 0.02, 0.3)
    trials = run_trials(simulation, sample, feedback=feedback, seed=5)
    runs = [66, 2]
    again = run_again(simulation, sample, runs, feedback=feedback, seed=5)
    for name, criterion in simulation.criteria.items():
        np.testing.assert_array_equal(criterion.judge(again)[0], trials.errors[name][runs], err_msg=name)


def test_the_poorest_runs_are_those_that_miss_most(motion: Motion, certificate: Certificate) -> None:
    found = certificate.perturbed
    assert found.successes < RUNS
    assert found.poorest[0] == found.worst["run"]
    runs = certificate_data(motion, certificate)["runs"]
    assert [run["name"] for run in runs] == [f"run {number}" for number in found.poorest]
    worst = {one["name"]: one["error"] for one in runs[0]["missed"]}
    assert worst
    for name, error in worst.items():
        assert error == found.worst["errors"][name]
    sizes = [max(abs(one["error"]) for one in run["missed"] if one["name"] == "height") for run in runs]
    assert sizes == sorted(sizes, reverse=True)


def test_limits_over_time_are_of_the_joint_that_has_least_left(motion: Motion) -> None:
    data = limits_data(motion)
    limits = motion.embodiment.limits
    kinds = {one["name"]: one for one in data["kinds"]}
    assert set(kinds) == {"speed", "torque_speed", "torque", "range"}
    left = 1 - np.abs(motion["joint_velocity"]) / limits.velocity
    np.testing.assert_allclose(unpack(kinds["speed"]["left"]), left.min(axis=1), rtol=1e-6)
    np.testing.assert_array_equal(unpack(kinds["speed"]["joint"]), left.argmin(axis=1))


def test_other_files_are_not_replaced(motion: Motion, certificate: Certificate, tmp_path: Path) -> None:
    place = tmp_path / "certificate.html"
    place.write_text("<p>mine</p>")
    with pytest.raises(LevadeError, match="is no report of levade's"):
        write_certificate(motion, certificate, place)
    place.unlink()
    first = write_certificate(motion, certificate, place).read_bytes()
    assert write_certificate(motion, certificate, place).read_bytes() == first


@pytest.fixture(scope="module")
def opened(offline: Any, motion: Motion, certificate: Certificate, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The page, opened from disk with the network off, and what it complained of."""
    place = tmp_path_factory.mktemp("page") / "certificate.html"
    return offline(write_certificate(motion, certificate, place, source="m.npz"))


def test_every_verdict_and_the_checksum_are_on_the_page(opened: Any, motion: Motion, certificate: Certificate) -> None:
    shown = opened.locator("body").inner_text()
    for verdict in certificate.verdicts:
        assert verdict.name in shown
    assert "Does not pass" in shown
    assert certificate.checksum == motion.checksum
    assert motion.checksum in shown
    assert f"{certificate.perturbed.successes} of {RUNS} succeed" in shown
    assert all(goal.perturbed in shown for goal in certificate.goal)
    assert opened.complaints == []


def test_the_poorest_run_can_be_played(opened: Any, certificate: Certificate) -> None:
    canvas = opened.locator(".stage canvas")
    opened.get_by_role("slider", name="Time").press("End")
    opened.wait_for_timeout(300)
    before = canvas.screenshot()
    opened.get_by_role("radio", name=f"run {certificate.perturbed.poorest[0]}", exact=True).check()
    opened.wait_for_timeout(300)
    assert "It misses height" in opened.locator(".said").inner_text()
    assert canvas.screenshot() != before
    assert opened.complaints == []


def test_what_passes_says_so(motion: Motion) -> None:
    nothing = Demands(share=None, numerics=None, engines=None, speed=None)
    found = certificate_data(motion, check(motion, runs=4, demands=nothing))
    assert found["passed"] is True
    assert found["failed"] == []
