"""The engines there are, one row each. To add an engine, write its class and add its row.

    ENGINES["ode"].deterministic
    ENGINES["ode"].missing()        # None, or one line that says what to install
    engine = ENGINES["ode"].make(xml, assets, embodiment, physics, threads=0)

The class of an engine is imported when it is first asked for, and its library is looked for when an engine is made.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from levade.errors import LevadeError, did_you_mean


@dataclass(frozen=True)
class EngineKind:
    """What is known of an engine before it is made.

    Attributes:
        name: Its name in a task, as ``physics.engine``.
        title: Its name in texts.
        path: Module and class, as "module:class".
        deterministic: Whether the same inputs give the same bits: for any number of threads, and in any batch.
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
        """Make an engine; arguments as of `levade.engines.Engine`.

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
        """What to install before an engine can be made, in one line; None if everything is there."""
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
    """Look up an engine.

    Raises:
        LevadeError: If there is none of this name.
    """
    if name not in ENGINES:
        raise LevadeError(f"no engine {name!r}; {did_you_mean(name, ENGINES)}")
    return ENGINES[name]


def no_feedback(name: str) -> LevadeError:
    """The error of an engine that is asked for feedback and simulates none."""
    able = " or ".join(kind.name for kind in ENGINES.values() if kind.feedback)
    return LevadeError(f"feedback: the engine {name} does not simulate it yet; use the engine {able}")
