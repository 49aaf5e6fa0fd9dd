"""One BLAS thread: faster at these sizes, and the same bits whatever the machine's number of cores."""

from __future__ import annotations

from contextlib import AbstractContextManager

from threadpoolctl import ThreadpoolController

_libraries = ThreadpoolController()


def single_threaded() -> AbstractContextManager[object]:
    """Within this context, numpy's linear algebra runs on one thread."""
    return _libraries.limit(limits=1, user_api="blas")
