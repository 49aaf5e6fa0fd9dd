"""Run numpy's linear algebra on one thread: faster at these sizes, and the same bits for any number of cores."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from pathlib import Path

import numpy as np
from threadpoolctl import ThreadpoolController


@cache
def _libraries() -> ThreadpoolController:
    """The libraries that are loaded when this is first asked for: by then cma has imported scipy, if it is there."""
    return ThreadpoolController()


_NUMPY = Path(np.__file__).resolve().parent.with_name("numpy.libs")
"""Directory of the linear algebra in a wheel of numpy. scipy has its own, which numpy does not use."""

_within = ContextVar("within", default=False)


def kernels() -> str:
    """Name the libraries behind numpy's linear algebra, each with the processor for which its kernels are made.

    An example is "openblas 0.3.31 Haswell". They decide how products are rounded. Empty if not known.
    """
    found = [one for one in _libraries().info() if one["user_api"] == "blas"]
    own = [one for one in found if _NUMPY in Path(one["filepath"]).resolve().parents]
    said = [
        " ".join(filter(None, (one["internal_api"], one.get("version"), one.get("architecture"))))
        for one in own or found  # where numpy brings none along, it is one of the others
    ]
    return ", ".join(sorted(set(said)))


@contextmanager
def single_threaded() -> Iterator[None]:
    """Within this context, numpy's linear algebra runs on one thread; contexts within it cost nothing."""
    if _within.get():
        yield
        return
    token = _within.set(True)
    try:
        with _libraries().limit(limits=1, user_api="blas"):
            yield
    finally:
        _within.reset(token)
