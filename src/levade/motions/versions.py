"""The versions of everything that decides the bits of a motion."""

from __future__ import annotations

from functools import cache

from levade.engines import engine_kind
from levade.optimizers.blas import kernels


def versions(engine: str = "mujoco") -> dict[str, str]:
    """Return name -> version. MuJoCo is always among them, because every engine reads the model from it.

    "blas" is the linear algebra library with the kind of processor for which it computes, which also decides bits.

    Args:
        engine: Name of the engine, a key of `levade.engines.ENGINES`.

    Returns:
        Name of the library -> its version.

    Raises:
        LevadeError: If the engine does not exist, or its library is missing.
    """
    return dict(_versions(engine))


@cache
def _versions(engine: str) -> dict[str, str]:
    from importlib.metadata import version

    from levade.version import __version__

    made = {"levade": __version__, **{name: version(name) for name in ("mujoco", "numpy", "cma")}}
    made |= engine_kind(engine).versions()
    return made | ({"blas": kernels()} if kernels() else {})
