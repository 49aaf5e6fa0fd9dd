"""Choosing an optimizer: by name, as a class or function, or as a ready object."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from levade.errors import LevadeError, did_you_mean
from levade.optimizers.adapter import adapted
from levade.optimizers.aimed import AimedCMAES
from levade.optimizers.cem import CEM
from levade.optimizers.cmaes import CMAES
from levade.optimizers.mppi import MPPI
from levade.optimizers.pi2 import PI2, PI2CMA
from levade.optimizers.protocol import Optimizer
from levade.optimizers.random_search import RandomSearch
from levade.optimizers.space import SearchSpace

OPTIMIZERS = {
    "cma-aimed": AimedCMAES,
    "cma": CMAES,
    "pi2": PI2,
    "pi2-cma": PI2CMA,
    "mppi": MPPI,
    "cem": CEM,
    "random": RandomSearch,
}
"""Name on the command line and in task files -> class. The first is the default."""

ALIASES = {"levade": "cma-aimed"}
"""Names that are accepted, too -> name. Task files and results of earlier versions have them."""

Choice = str | Callable[..., Any] | Any
"""A name, a class or function ``(space, *, seed) -> optimizer``, or an object with ``ask`` and ``tell``."""


def canonical(name: Any) -> Any:
    """Return the name of an optimizer that may be given by an alias; anything else as it is.

    Args:
        name: A name, an alias, or another choice of an optimizer.

    Returns:
        The name that an alias stands for, or the argument itself.
    """
    return ALIASES.get(name, name) if isinstance(name, str) else name


def settings(name: str) -> tuple[str, ...]:
    """What an optimizer takes besides the space and a seed.

    Args:
        name: Name or alias of an optimizer.

    Returns:
        Names of its settings, as its class declares them.

    Raises:
        LevadeError: If there is no such optimizer.
    """
    return _named(name).SETTINGS


def can_restart(choice: Choice) -> bool:
    """Tell whether another optimizer can be made for a second attempt: a ready object is the only one there is.

    Args:
        choice: The choice of an optimizer.

    Returns:
        False for a ready object, else True.
    """
    return isinstance(choice, (str, type)) or not hasattr(choice, "ask")


def make_optimizer(
    choice: Choice,
    space: SearchSpace,
    *,
    seed: int | tuple[int, ...],
    settings: Mapping[str, Any] | None = None,
    again: bool = False,
) -> Optimizer:
    """Make an optimizer.

    Args:
        choice: Name or alias of an optimizer; a class or function, called as ``choice(space, seed=seed, **settings)``; or a
            ready object with ``ask`` and ``tell``. `levade.optimizers.protocol` says what an optimizer may provide.
        space: Where to search. A ready object is only held to its number of weights.
        seed: Seed of the optimizer's own random numbers. A ready object has its own.
        settings: Settings of this optimizer, such as ``{"elite": 0.2}``.
        again: Whether this is for another attempt of the same search.

    Returns:
        The optimizer. One that is not levade's own is checked: candidates that are not finite, or of another shape, are an
        error.

    Raises:
        LevadeError: If there is no such optimizer or setting, a setting has a wrong value, the choice has no ``ask`` and
            ``tell``, or a ready object is wanted again.
    """
    own = dict(settings or {})
    if isinstance(choice, str):
        kind = _named(choice)
        for name in own:
            if name not in kind.SETTINGS:
                hint = did_you_mean(name, kind.SETTINGS) if kind.SETTINGS else "it takes none"
                raise LevadeError(f"{name}: no such setting of {canonical(choice)}; {hint}")
        return kind(space, seed=seed, **own)
    if not isinstance(choice, type) and hasattr(choice, "ask"):
        what = f"optimizer: {type(choice).__name__} is a ready object"
        if again:
            raise LevadeError(
                f"{what}, and the search makes another for each attempt; give a class or function instead"
            )
        if own:
            raise LevadeError(f"{what}, which takes no settings; give them to it, or give a class or function instead")
        return adapted(choice, space.size)
    if not callable(choice):
        raise LevadeError(
            f"optimizer: expected a name, a class or function (space, *, seed), or an object with ask and tell; got {choice!r}"
        )
    return adapted(choice(space, seed=seed, **own), space.size)


def _named(name: str) -> Any:
    if canonical(name) not in OPTIMIZERS:
        raise LevadeError(f"no optimizer {name!r}; {did_you_mean(name, OPTIMIZERS)}")
    return OPTIMIZERS[canonical(name)]
