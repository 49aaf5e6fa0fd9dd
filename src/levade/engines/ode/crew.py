"""Processes that share the trials of a roll-out: ODE draws from one random generator a process, so threads will not do.

The processes are started with this module as their program, not forked: whoever calls may have threads, and needs no
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

from levade.arrays import Array
from levade.engines.ode.simulation import Record, Simulation
from levade.engines.ode.skeleton import skeleton
from levade.engines.physics import Physics

_WORTH = 1500
"""Steps, over all trials, from which on a roll-out is shared."""

_HIRE = 20_000
"""Steps simulated before another process is started, which costs as much as thousands."""


class Crew:
    """Simulations of one model, in this process and others.

    threads: how many processes at most, this one included; 0 for one per core.
    """

    def __init__(self, xml: str, assets: Mapping[str, bytes], physics: Physics, threads: int) -> None:
        self._model = (xml, dict(assets), physics)
        self.simulation = simulation(*self._model)
        self._size = threads or _cores()
        self._done = 0
        self._helpers: list[subprocess.Popen[bytes]] = []
        weakref.finalize(self, _dismiss, self._helpers)

    def run(self, start: tuple[Array, Array, Array], position: Array, velocity: Array, **forces: Any) -> Record:
        """`Simulation.run` of n trials; start: qpos, qvel, act."""
        n, steps = position.shape[:2]
        self._done += n * steps
        size = min(self._size, n) if n * steps >= _WORTH and self._done >= _HIRE else 1
        shares = np.array_split(np.arange(n), size)
        while len(self._helpers) < size - 1:
            self._helpers.append(_hire(self._model))
        try:
            for helper, share in zip(self._helpers, shares[1:], strict=False):
                _send(helper.stdin, ((*start, position[share], velocity[share]), forces))
            records = [self.simulation.run(*start, position[shares[0]], velocity[shares[0]], **forces)]
            for helper, _ in zip(self._helpers, shares[1:], strict=False):
                records.append(_receive(helper.stdout))
        except BaseException:  # an answer that nobody waits for would be taken for the next one
            _dismiss(self._helpers)
            raise
        if len(records) == 1:
            return records[0]
        return Record(**{name: np.concatenate([getattr(r, name) for r in records]) for name in vars(records[0])})


def simulation(xml: str, assets: Mapping[str, bytes], physics: Physics) -> Simulation:
    """The simulation of a model. Raises LevadeError for what ODE cannot simulate."""
    model = mujoco.MjModel.from_xml_string(xml, dict(assets))
    return Simulation(skeleton(model), physics.ode, physics.timestep)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _hire(model: tuple[str, dict[str, bytes], Physics]) -> subprocess.Popen[bytes]:
    paths = [path for path in sys.path if path]
    helper = subprocess.Popen(
        [sys.executable, "-m", "levade.engines.ode.crew"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        process_group=0,  # Ctrl-C is for this process, which knows what to do
    )
    _send(helper.stdin, model)
    return helper


def _dismiss(helpers: list[subprocess.Popen[bytes]]) -> None:
    while helpers:
        helper = helpers.pop()
        helper.kill()
        for pipe in (helper.stdin, helper.stdout):
            if pipe is not None:
                with suppress(BrokenPipeError):  # of what was not yet sent
                    pipe.close()
        helper.wait()


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
    """A helper's life: a model, then roll-outs until the pipe ends."""
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
