"""What run.py and a peer in an environment of its own say to each other: lines of JSON, each followed by an array or none.

run.py starts ``propose_NAME.py`` with the peer's Python and writes to its standard input:

    {"do": "begin", ...}        the problem; answered with {"population": n, "version": ...} and, where the peer has a basis
                                of its own, that: (2, rows, nodes), values and time derivatives
    {"do": "start"} + mean      (d,)
    {"do": "ask"}               answered with {"cpu": [s] so far} and candidates (n, d)
    {"do": "tell"} + cost       (n,)

Needs numpy only.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable
from typing import IO, Any, Protocol

import numpy as np


class Proposer(Protocol):
    """A peer. d is laid out as levade's weights are: joint by joint, the nodes of each."""

    population: int
    version: str
    basis: np.ndarray | None

    def start(self, mean: np.ndarray) -> None: ...

    def ask(self) -> np.ndarray: ...

    def tell(self, cost: np.ndarray) -> None: ...


def send(stream: IO[bytes], content: dict[str, Any], array: np.ndarray | None = None) -> None:
    shape = None if array is None else list(array.shape)
    stream.write(json.dumps({**content, "shape": shape}).encode() + b"\n")
    if array is not None:
        stream.write(np.ascontiguousarray(array, dtype="<f8").tobytes())
    stream.flush()


def receive(stream: IO[bytes]) -> tuple[dict[str, Any], np.ndarray | None]:
    line = stream.readline()
    if not line:
        raise EOFError
    content = json.loads(line)
    shape = content.pop("shape")
    if shape is None:
        return content, None
    size = 8 * int(np.prod(shape))
    return content, np.frombuffer(stream.read(size), dtype="<f8").reshape(shape).copy()


def serve(make: Callable[[dict[str, Any]], Proposer]) -> None:
    """Answer until nobody asks any more. make: from the problem to the peer."""
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints is not for the wire
    proposer: Proposer | None = None
    began = 0.0
    while True:
        try:
            content, array = receive(sys.stdin.buffer)
        except EOFError:
            return
        if content["do"] == "begin":
            proposer = make(content)
            send(out, {"population": proposer.population, "version": proposer.version}, proposer.basis)
            continue
        assert proposer is not None
        if content["do"] == "start":
            assert array is not None
            began = time.process_time()
            proposer.start(array)
        elif content["do"] == "ask":
            candidates = proposer.ask()
            send(out, {"cpu": time.process_time() - began}, candidates)
        elif content["do"] == "tell":
            assert array is not None
            proposer.tell(array)
