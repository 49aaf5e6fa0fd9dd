"""The versions of everything that decides the bits of a motion."""

from __future__ import annotations

from functools import cache

from levade.engines import engine_kind


def versions(engine: str = "mujoco") -> dict[str, str]:
    """Name -> version; MuJoCo's with every engine, as each reads the model from it."""
    return dict(_versions(engine))


@cache
def _versions(engine: str) -> dict[str, str]:
    from importlib.metadata import version

    from levade import __version__

    made = {"levade": __version__, **{name: version(name) for name in ("mujoco", "numpy", "cma")}}
    return made | engine_kind(engine).versions()
