"""One run of a peer: it proposes in its own environment, and levade simulates and judges."""

from __future__ import annotations

import argparse
import copy
import dataclasses
import json
import os
import subprocess
import time
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import wire

from levade.bench import Result
from levade.bench.case import made_with
from levade.errors import LevadeError
from levade.policies import Policy
from levade.policies.groups import expansion
from levade.search import Objective, make_objective
from levade.tasks import Task, load_task, task_to_yaml
from levade.tasks.writing import task_to_dict

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Peer:
    """environment: of `run.ENVIRONMENTS`. script: that proposes, or the whole run. settings: of the peer, by its own names."""

    environment: str
    script: str
    settings: Mapping[str, Any] = field(default_factory=dict)


PEERS = {  # chosen on rearing: see SETTINGS.md
    "plain": Peer("plain", "plain.py", {"step": 0.5}),
    "judo-ps": Peer("judo", "propose_judo.py", {"num_nodes": 6, "num_rollouts": 32, "sigma": 0.3}),
    "judo-mppi": Peer(
        "judo", "propose_judo.py", {"num_nodes": 6, "num_rollouts": 16, "sigma": 0.3, "temperature": 0.001}
    ),
    "judo-cem": Peer(
        "judo",
        "propose_judo.py",
        {"num_nodes": 6, "num_rollouts": 32, "num_elites": 4, "sigma_min": 0.1, "sigma_max": 1.0},
    ),
    "nevergrad": Peer("nevergrad", "propose_nevergrad.py", {"method": "NGOpt", "population": 16, "step": 0.3}),
    "nevergrad-de": Peer("nevergrad", "propose_nevergrad.py", {"method": "TwoPointsDE", "population": 30, "step": 0.3}),
    "fcmaes": Peer("fcmaes", "propose_fcmaes.py", {"population": 17, "step": 0.5}),
}


@dataclass(frozen=True)
class Job:
    """A peer's run of a task. budget: trials."""

    task: Task
    robot: str
    peer: str
    seed: int
    budget: int
    until: str
    python: str
    directory: Path

    @property
    def key(self) -> tuple[str, str, str, int]:
        return self.task.name, self.robot, self.peer, self.seed

    @property
    def checksum(self) -> int:
        """Of everything that decides the result but the seed and the versions: not of how levade itself would search."""
        given = {
            key: value for key, value in task_to_dict(self.task).items() if key not in ("search", "stages", "robust")
        }
        settings = dataclasses.asdict(PEERS[self.peer])
        return zlib.crc32(f"{json.dumps([given, settings], sort_keys=True)}{self.budget}".encode())


def job_of(task: str, robot: str | None, peer: str, seed: int, arguments: argparse.Namespace, python: str) -> Job:
    """One stage, all of the hold, nothing aimed: the task's cost as it stands."""
    plain = ["stages=[{name: full}]", "search.optimizer=cma"]
    loaded = load_task(task, robot=robot, changes=[*plain, *arguments.changes])
    budget = arguments.trials or loaded.search.trials
    name = _objective(loaded).robot.name
    return Job(loaded, name, peer, seed, budget, arguments.until, python, arguments.out)


def seeds_of(text: str) -> list[int]:
    return [int(part) for part in text.split(",")] if "," in text else list(range(int(text)))


def checked(job: Job, done: Mapping[tuple[str, str, str, int], Result]) -> bool:
    """Whether there is a result. Raises LevadeError if it is of something else under the same name."""
    result = done.get(job.key)
    if result is not None and (result.checksum, result.until) != (job.checksum, job.until):
        raise LevadeError(f"{job.directory}: has {job.key} with other settings; give another --out")
    return result is not None


def run_job(job: Job) -> Result:
    return _run_plain(job) if job.peer == "plain" else _run_proposer(job)


def _run_proposer(job: Job) -> Result:
    objective = _objective(job.task)
    peer, policy = PEERS[job.peer], objective.policy
    problem = {
        "do": "begin",
        "peer": job.peer,
        "settings": dict(peer.settings),
        "seed": job.seed,
        "trials": job.budget,
        "joints": policy.independent_joints,
        "kernels": policy.kernels.kernels,
        "rows": policy.horizon_steps,
        "horizon": policy.horizon_steps * policy.timestep,
    }
    log = job.directory / f"{job.task.name}-{job.peer}-{job.seed}.log"
    with (
        log.open("wb") as err,
        subprocess.Popen(
            [job.python, str(HERE / peer.script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=err, env=own()
        ) as process,
    ):
        assert process.stdin is not None
        assert process.stdout is not None
        to, back = process.stdin, process.stdout
        try:
            wire.send(to, problem)
            answer, basis = wire.receive(back)
            if basis is not None:
                objective = _with_basis(objective, basis)
            wire.send(to, {"do": "start"}, objective.space.mean)
            result = _search(job, objective, answer, to, back)
        except (EOFError, OSError):
            process.wait()
            raise LevadeError(f"{job.key}: the peer ended early; see {log}") from None
        to.close()
    log.unlink()
    return result


def _search(job: Job, objective: Objective, answer: Mapping[str, Any], to: Any, back: Any) -> Result:
    weights = {name: cost.weight for name, cost in job.task.costs.items()}
    engine, population = objective.engine, answer["population"]
    before, began = engine.steps, time.process_time()
    trials = diverged = 0
    cpu = 0.0
    best, first = (True, np.inf), None
    while trials + population <= job.budget:
        wire.send(to, {"do": "ask"})
        said, candidates = wire.receive(back)
        assert candidates is not None
        cpu = said["cpu"]
        evaluation = objective.evaluate(candidates)
        cost = evaluation.cost(weights)
        wire.send(to, {"do": "tell"}, cost)
        trials += len(candidates)
        diverged += int(evaluation.diverged.sum())
        best = min([best, *zip((~evaluation.success).tolist(), cost.tolist(), strict=True)])
        if first is None and evaluation.success.any():
            first = trials, engine.steps - before, time.process_time() - began + cpu, best[1]
            if job.until == "success":
                break
    core_seconds = time.process_time() - began + cpu
    made = f"{answer['version']}, {made_with()}"
    return _result(job, trials, engine.steps - before, core_seconds, best[1], first, diverged, made)


def _run_plain(job: Job) -> Result:
    case = job.directory / "cases" / job.task.name
    export(_objective(job.task), case)
    step = str(PEERS[job.peer].settings["step"])
    command = [job.python, str(HERE / "plain.py"), str(case), str(job.seed), str(job.budget)]
    _check_same(job, [*command, "check", step], case)
    said = _call([*command, job.until, step])
    a_trial, first = said["steps_a_trial"], said["first"]
    at = None if first is None else (first["trials"], first["trials"] * a_trial, first["core_seconds"], first["cost"])
    spent = said["trials"] * a_trial
    return _result(
        job, said["trials"], spent, said["core_seconds"], said["cost"], at, said["diverged"], said["version"]
    )


def _call(command: list[str]) -> dict[str, Any]:
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, env=own()).stdout)


def own() -> dict[str, str]:
    """What surrounds a peer: one thread, no modules but those of its environment, no word that matplotlib is missing."""
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return kept | dict.fromkeys(names, "1") | {"PYTHONWARNINGS": "ignore::UserWarning"}


def _check_same(job: Job, command: list[str], case: Path) -> None:
    """What was written by hand gives levade's costs and successes, or nothing is compared."""
    objective = _objective(job.task)
    random = np.random.default_rng(0)
    weights = objective.space.mean + 0.1 * random.standard_normal((4, objective.policy.size))
    np.save(case / "check.npy", weights)
    said = _call(command)
    evaluation = objective.evaluate(weights)
    cost = evaluation.cost({name: cost.weight for name, cost in job.task.costs.items()})
    np.testing.assert_allclose(said["cost"], cost, rtol=1e-6)
    assert said["success"] == evaluation.success.tolist()


def export(objective: Objective, case: Path) -> None:
    """What anyone needs to simulate the task: model, start, kernels, which joint follows which, where references come from
    and go to, and the task itself.
    """
    (case / "assets").mkdir(parents=True, exist_ok=True)
    engine, policy, state = objective.engine, objective.policy, objective.state
    (case / "model.xml").write_text(engine.xml)
    for name, content in engine.assets.items():
        (case / "assets" / name).write_bytes(content)
    (case / "task.yaml").write_text(task_to_yaml(objective.task))
    index, sign = expansion(policy.groups)
    phi, phi_rate = policy.basis
    arrays = {"mean": objective.space.mean, "phi": phi, "phi_rate": phi_rate, "index": index, "sign": sign}
    for name, value in zip(("factor", "added", "factor_rate", "added_rate"), _ends(policy), strict=True):
        arrays[name] = value
    np.savez(case / "arrays.npz", qpos=state.qpos[0], qvel=state.qvel[0], act=state.act[0], **arrays)


def _ends(policy: Policy) -> tuple[np.ndarray, ...]:
    """What `Ends.blend` says of each row up to the horizon, its rates by time; all of the kernels where there are none."""
    rows, horizon = policy.horizon_steps, policy.horizon_steps * policy.timestep
    if policy.ends is None:
        nothing = np.zeros((rows, 1))
        return np.ones((rows, 1)), nothing, nothing, nothing
    factor, added, factor_rate, added_rate = policy.ends.blend(np.arange(1, rows + 1) / rows)
    return factor, added, factor_rate / horizon, added_rate / horizon


def _result(
    job: Job,
    trials: int,
    steps: int,
    core_seconds: float,
    cost: float,
    first: tuple[int, int, float, float] | None,
    diverged: int,
    versions: str,
) -> Result:
    to_success = first or (None, None, None, None)
    return Result(
        task=job.task.name,
        robot=job.robot,
        optimizer=job.peer,
        seed=job.seed,
        until=job.until,
        budget_trials=job.budget,
        budget_steps=None,
        success=first is not None,
        trials=trials,
        trials_to_success=to_success[0],
        steps=steps,
        steps_to_success=to_success[1],
        core_seconds=round(core_seconds, 4),
        core_seconds_to_success=None if to_success[2] is None else round(to_success[2], 4),
        cost=cost,
        cost_to_success=to_success[3],
        diverged=diverged,
        stopped="success" if first is not None and job.until == "success" else "budget",
        checksum=job.checksum,
        versions=versions,
    )


class Basis:
    """A peer's basis in place of the kernels: what `levade.policies.Policy` asks of one."""

    def __init__(self, values: np.ndarray) -> None:
        self.values = values
        self.kernels = values.shape[2]
        self.means = np.linspace(0, 1, self.kernels)

    def basis(self, time: np.ndarray, horizon: float) -> tuple[np.ndarray, np.ndarray]:
        return self.values[0], self.values[1]


def _with_basis(objective: Objective, values: np.ndarray) -> Objective:
    other = copy.copy(objective)
    other.__dict__.pop("space", None)  # it was made for the kernels; a peer uses nothing but its mean
    other.task = dataclasses.replace(objective.task, search=dataclasses.replace(objective.task.search, modes=None))
    other.policy = dataclasses.replace(objective.policy, kernels=Basis(values))  # type: ignore[arg-type]
    return other


_latest: tuple[Task, Objective] | None = None


def _objective(task: Task) -> Objective:
    global _latest
    if _latest is None or _latest[0] != task:
        _latest = task, make_objective(task, threads=1)
    return _latest[1]
