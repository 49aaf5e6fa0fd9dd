"""Processes that share the trials of a roll-out: ODE draws from one random generator a process, so threads will not do.

The processes are started with this module as their program, not forked: the caller may have threads, and needs no
``if __name__ == "__main__"``. What they compute does not depend on how many there are.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import weakref
from collections.abc import Mapping
from contextlib import suppress
from typing import IO, Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.ode.multibody import multibody_of
from levade.engines.ode.simulation import Record, Simulation
from levade.engines.physics import Physics
from levade.engines.state import State

_WORTH = 1500
"""Steps, over all trials, from which on a roll-out is shared."""

_START = 20_000
"""Steps simulated before another process is started, which costs as much as thousands."""


class WorkerPool:
    """Simulations of one model, in this process and others.

    Args:
        threads: How many processes at most, this one included; 0 for one per core.
    """

    def __init__(self, xml: str, assets: Mapping[str, bytes], physics: Physics, threads: int) -> None:
        self._model = (xml, dict(assets), physics)
        self.simulation = simulation(*self._model)
        self._size = threads or _cores()
        self._done = 0
        self._workers: list[subprocess.Popen[bytes]] = []
        weakref.finalize(self, _stop_workers, self._workers)

    def run(self, starts: State, position: Array, velocity: Array, **forces: Any) -> Record:
        """Simulate n trials, from starts of 1 or n rows; the rest as of `Simulation.run`.

        Args:
            starts: Starts of the trials, 1 or n rows.
            position: Desired hinge angles [rad], shape (n, steps, hinges).
            velocity: Desired hinge speeds [rad/s], shape (n, steps, hinges).
            forces: ``soles`` and ``bodies`` whose contact forces are recorded: see `Simulation.run`.

        Returns:
            The record of all trials, in their order.
        """
        n, steps = position.shape[:2]
        self._done += n * steps
        size = min(self._size, n) if n * steps >= _WORTH and self._done >= _START else 1
        shares = np.array_split(np.arange(n), size)
        while len(self._workers) < size - 1:
            self._workers.append(_start_worker(self._model))

        def arguments(share: NDArray[np.intp]) -> tuple[Array, ...]:
            of = starts if len(starts) == 1 else starts[share]
            return of.qpos, of.qvel, of.act, position[share], velocity[share]

        try:
            for worker, share in zip(self._workers, shares[1:], strict=False):
                _send(worker.stdin, (arguments(share), forces))
            records = [self.simulation.run(*arguments(shares[0]), **forces)]
            for worker, _ in zip(self._workers, shares[1:], strict=False):
                records.append(_receive(worker.stdout))
        except BaseException:  # an answer that nobody waits for would be taken for the next one
            _stop_workers(self._workers)
            raise
        return Record.joined(records)


def simulation(xml: str, assets: Mapping[str, bytes], physics: Physics) -> Simulation:
    """Make the simulation of a model.

    Args:
        xml: MJCF text of robot and scene.
        assets: File name in ``xml`` -> content.
        physics: Numerical settings.

    Returns:
        The simulation.

    Raises:
        LevadeError: For what ODE cannot simulate.
    """
    model = mujoco.MjModel.from_xml_string(xml, dict(assets))
    return Simulation(multibody_of(model), physics.ode, physics.timestep)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _start_worker(model: tuple[str, dict[str, bytes], Physics]) -> subprocess.Popen[bytes]:
    paths = [path for path in sys.path if path]
    worker = subprocess.Popen(
        [sys.executable, "-m", "levade.engines.ode.workers"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        process_group=0,  # Ctrl-C is for this process, which knows what to do
    )
    _send(worker.stdin, model)
    return worker


def _stop_workers(workers: list[subprocess.Popen[bytes]]) -> None:
    while workers:
        worker = workers.pop()
        worker.kill()
        for pipe in (worker.stdin, worker.stdout):
            if pipe is not None:
                with suppress(BrokenPipeError):  # of what was not yet sent
                    pipe.close()
        worker.wait()


def _send(pipe: IO[bytes] | None, content: object) -> None:
    assert pipe is not None
    pickle.dump(content, pipe, protocol=5)
    pipe.flush()


def _receive(pipe: IO[bytes] | None) -> Record:
    assert pipe is not None
    answer = pickle.load(pipe)
    if isinstance(answer, BaseException):
        raise answer
    return answer


def _work() -> None:
    """What a worker does: read a model, then simulate roll-outs until the pipe ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # nothing that a library prints may come between the answers
    try:
        mine = simulation(*pickle.load(sys.stdin.buffer))
        while True:
            arguments, forces = pickle.load(sys.stdin.buffer)
            _send(answers, mine.run(*arguments, **forces))
    except (EOFError, BrokenPipeError):
        pass
    except Exception as error:
        _send(answers, error)


if __name__ == "__main__":
    _work()
