"""The table of engines. To add an engine, write its class and add its row.

    ENGINES["ode"].deterministic
    ENGINES["ode"].missing()        # None, or one line that says what to install
    engine = ENGINES["ode"].make(xml, assets, embodiment, physics, threads=0)

An engine's class is imported on first use, and its library is loaded when an engine is made.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from levade.errors import LevadeError, did_you_mean


@dataclass(frozen=True)
class EngineKind:
    """Describes an engine before it is made.

    Attributes:
        name: Its name in a task, as ``physics.engine``.
        title: Its name in texts.
        path: Module and class, as "module:class".
        deterministic: Whether the same inputs give the same bits, for any number of threads and in any batch.
        feedback: Whether it simulates feedback (`levade.feedback`).
    """

    name: str
    title: str
    path: str
    deterministic: bool
    feedback: bool

    def load(self) -> Any:
        """Import the class, a `levade.engines.Engine`."""
        module, _, name = self.path.partition(":")
        return getattr(import_module(module), name)

    def make(
        self,
        xml: str,
        assets: Mapping[str, bytes],
        embodiment: Any,
        physics: Any,
        *,
        threads: int = 0,
        model: Any = None,
    ) -> Any:
        """Make an engine. The arguments are those of `levade.engines.Engine`.

        Args:
            xml: MJCF text of robot, scene, actuators and contact sensors.
            assets: File name in ``xml`` -> content.
            embodiment: The robot, a `levade.embodiment.Embodiment`.
            physics: Numerical settings, a `levade.engines.Physics`.
            threads: Number of threads or processes (0: one per core).
            model: The compiled model, a `mujoco.MjModel`. None compiles ``xml``.

        Returns:
            The engine, a `levade.engines.Engine`.

        Raises:
            LevadeError: If a library is missing, or the engine cannot simulate the model.
        """
        return self.load()(xml, assets, embodiment, physics, threads=threads, model=model)

    def versions(self) -> dict[str, str]:
        """Versions that decide the bits of a simulation, by the names of packages and libraries.

        Raises:
            LevadeError: If a library is missing.
        """
        return self.load().versions()

    def missing(self) -> str | None:
        """Say in one line what to install before an engine can be made. None if nothing is missing."""
        try:
            self.versions()
        except LevadeError as error:
            return str(error)
        return None


ENGINES: dict[str, EngineKind] = {
    kind.name: kind
    for kind in (
        EngineKind("mujoco", "MuJoCo", "levade.engines.mujoco:MujocoEngine", deterministic=True, feedback=True),
        EngineKind("ode", "ODE", "levade.engines.ode.engine:OdeEngine", deterministic=True, feedback=False),
    )
}
"""Name -> engine."""


def engine_kind(name: str) -> EngineKind:
    """Look up an engine by name.

    Args:
        name: A key of `ENGINES`.

    Returns:
        The engine's row.

    Raises:
        LevadeError: If it does not exist.
    """
    if name not in ENGINES:
        raise LevadeError(f"no engine {name!r}; {did_you_mean(name, ENGINES)}")
    return ENGINES[name]


def no_feedback(name: str) -> LevadeError:
    """Return the error for an engine that cannot simulate feedback.

    Args:
        name: Name of the engine.

    Returns:
        The error, to be raised.
    """
    able = " or ".join(kind.name for kind in ENGINES.values() if kind.feedback)
    return LevadeError(f"feedback: the engine {name} does not simulate it yet; use the engine {able}")
