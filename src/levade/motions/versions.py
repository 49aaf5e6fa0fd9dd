"""The versions of everything that decides the bits of a motion."""

from __future__ import annotations

from functools import cache

from levade.engines import engine_kind
from levade.optimizers.blas import kernels


def versions(engine: str = "mujoco") -> dict[str, str]:
    """Name -> version; MuJoCo's with every engine, as each reads the model from it.

    "blas" is the library with the kind of processor that it computes for, which decides bits, too.
    """
    return dict(_versions(engine))


@cache
def _versions(engine: str) -> dict[str, str]:
    from importlib.metadata import version

    from levade.version import __version__

    made = {"levade": __version__, **{name: version(name) for name in ("mujoco", "numpy", "cma")}}
    made |= engine_kind(engine).versions()
    return made | ({"blas": kernels()} if kernels() else {})
