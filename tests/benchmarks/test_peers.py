"""The peers' script, with this Python in place of their environments: what it counts, and that a plain loop has its costs."""

from __future__ import annotations

import argparse
import dataclasses
import os
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import levade

PEERS = Path(__file__).parents[2] / "benchmarks" / "peers"

STUB = """
import sys
sys.path.insert(0, {peers!r})
import numpy as np
import wire

class Chance:
    version = "stub 1"
    def __init__(self, problem):
        self.population = problem["settings"]["n"]
        self.random = np.random.default_rng(problem["seed"])
        self.rows, self.told = problem["rows"], 0
        nodes = problem["settings"].get("nodes")
        line = np.arange(1, self.rows + 1) / self.rows
        values = None if nodes is None else np.stack([1 - line, line], axis=1)
        rate = np.tile([-1.0, 1.0], (self.rows, 1)) / problem["horizon"]
        self.basis = None if nodes is None else np.stack([values, rate])
        print("a library that prints")
    def start(self, mean):
        self.mean = mean
    def ask(self):
        if self.told == problem_breaks_at:
            raise SystemExit(3)
        return self.mean + 0.01 * self.random.standard_normal((self.population, self.mean.size))
    def tell(self, cost):
        assert np.isfinite(cost).all() and cost.shape == (self.population,)
        self.told += 1

problem_breaks_at = {breaks_at}
wire.serve(Chance)
"""


@pytest.fixture(scope="module")
def case() -> ModuleType:
    sys.path.insert(0, str(PEERS))
    try:
        import case

        return case
    finally:
        sys.path.remove(str(PEERS))


@pytest.fixture
def job(case: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A job of the stub, or of another peer."""

    def make(
        peer: str = "stub", *, task: str = "rearing", changes: tuple[str, ...] = (), breaks_at: int = -1, **settings
    ):
        script = tmp_path / "stub.py"
        script.write_text(STUB.format(peers=str(PEERS), breaks_at=breaks_at))
        if peer == "stub":
            monkeypatch.setitem(case.PEERS, "stub", case.Peer("here", str(script), {"n": 5, **settings}))
        here = str(Path(levade.__file__).parents[1])
        monkeypatch.setattr(case, "own", lambda: {**os.environ, "PYTHONPATH": here})
        arguments = argparse.Namespace(changes=["horizon=0.06", *changes], trials=20, until="success", out=tmp_path)
        return case.job_of(task, None, peer, 3, arguments, sys.executable)

    return make


@pytest.mark.slow
def test_a_peer_spends_its_budget_in_whole_generations(case: ModuleType, job, tmp_path: Path) -> None:
    mine = job()
    result = case.run_job(mine)
    assert (result.optimizer, result.seed, result.trials, result.steps) == ("stub", 3, 20, 20 * 30)
    assert (result.success, result.stopped, result.trials_to_success) == (False, "budget", None)
    assert result.versions.startswith("stub 1, levade ")
    assert not list(tmp_path.glob("*.log"))
    assert case.run_job(mine).cost == result.cost
    assert case.checked(mine, {result.key: result})
    with pytest.raises(Exception, match="with other settings; give another --out"):
        case.checked(dataclasses.replace(mine, budget=21), {result.key: result})


@pytest.mark.slow
def test_it_stops_at_success_unless_told_to_go_on(case: ModuleType, job) -> None:
    easy = ("success.pitch.tolerance=9", "success.height.tolerance=9")
    result = case.run_job(job(changes=easy))
    assert (result.trials_to_success, result.trials, result.steps_to_success, result.stopped) == (5, 5, 150, "success")
    assert result.cost_to_success == result.cost
    result = case.run_job(dataclasses.replace(job(changes=easy), until="budget"))
    assert (result.trials_to_success, result.trials, result.stopped) == (5, 20, "budget")


@pytest.mark.slow
def test_a_basis_of_its_own_is_what_the_joints_follow(case: ModuleType, job) -> None:
    """Two nodes and straight lines between them: the reference is that line, and its slope."""
    mine = job(nodes=2)
    objective = case._objective(mine.task)
    line = np.arange(1, 31) / 30
    values = np.stack([np.stack([1 - line, line], axis=1), np.tile([-1.0, 1.0], (30, 1)) / 0.06])
    other = case._with_basis(objective, values)
    start, end = objective.space.mean.reshape(6, 16)[:, 0], np.arange(6) / 10
    reference = other.policy.reference(np.stack([start, end], axis=1).reshape(1, 12))
    leader = other.policy.project(reference.position[0])
    np.testing.assert_allclose(leader, start + line[:, None] * (end - start), atol=1e-12)
    np.testing.assert_allclose(other.policy.project(reference.velocity[0])[7], (end - start) / 0.06, rtol=1e-9)
    assert objective.policy.size == 96
    np.testing.assert_allclose(other.space.mean.reshape(6, 2)[:, 0], start)
    assert case.run_job(mine).trials == 20


@pytest.mark.slow
def test_a_peer_that_breaks_down_says_where_to_look(case: ModuleType, job, tmp_path: Path) -> None:
    with pytest.raises(Exception, match=r"stub.* the peer ended early; see .*rearing-stub-3.log"):
        case.run_job(job(breaks_at=2))
    assert "a library that prints" in (tmp_path / "rearing-stub-3.log").read_text()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("task", "changes"),
    [
        ("rearing", ()),
        ("posture-recovery", ("hold=0.04",)),
        ("squat-jump", ("hold=0.04",)),
        ("rearing", ("costs.effort={term: ground_contact, bodies: [trunk, lf_foot], weight: 3}",)),
    ],
)
def test_the_loop_by_hand_has_levades_costs(case: ModuleType, job, task: str, changes: tuple[str, ...]) -> None:
    """run.py compares them before each run: with the hold, an obstacle, and forces on bodies as well."""
    if changes and "bodies" in changes[0]:
        bodies = case._objective(job("plain", task=task).task).engine.bodies
        changes = (changes[0].replace("lf_foot", bodies[-1]),)
    result = case.run_job(job("plain", task=task, changes=changes))
    assert result.trials == {"rearing": 17, "posture-recovery": 19, "squat-jump": 16}[task]
    assert result.versions.startswith("cma ")
    assert np.isfinite(result.cost)
