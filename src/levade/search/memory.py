"""Estimate the memory that roll-outs need, and how many fit at once."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from levade.engines import Engine
from levade.errors import LevadeError

_SHARE = 0.5
"""Share of the free memory that roll-outs may take. The rest is for everything else."""

_CGROUP = Path("/sys/fs/cgroup")


@dataclass(frozen=True)
class Need:
    """The memory that trials of one length need.

    Attributes:
        trial: Memory of one trial while it is simulated and judged [bytes].
        free: Free memory [bytes]. None where the system does not report it.
    """

    trial: int
    free: int | None

    @property
    def at_once(self) -> int | None:
        """The number of trials that fit at once, perhaps none; None if it is unknown."""
        return None if self.free is None else int(_SHARE * self.free) // self.trial


def needed(engine: Engine, steps: int) -> Need:
    """Estimate the memory that a trial needs.

    Args:
        engine: The engine that simulates it.
        steps: Number of physics steps, with the hold.
    """
    model, joints = engine.model, engine.embodiment.joints
    # the engine's records, the reference, the trajectory and what costs compute from it, 8 bytes each; the average is lower
    numbers = 10 * joints + model.nq + model.nv + model.nu + model.nsensordata
    return Need(max(1, 8 * numbers * steps), free_memory())


def check_fits(engine: Engine, steps: int) -> None:
    """Check that at least one trial fits into memory.

    Args:
        engine: The engine that simulates it.
        steps: Number of physics steps, with the hold.

    Raises:
        LevadeError: If not even one trial fits.
    """
    need = needed(engine, steps)
    if need.at_once is not None and need.at_once < 1:
        raise LevadeError(
            f"horizon: a trial of {steps} steps needs {in_words(need.trial)}, but only half of the {in_words(need.free or 0)}"
            " that are free may be used; give a shorter horizon and hold, or a longer physics.timestep"
        )


def in_words(size: int) -> str:
    """Write a size with its unit.

    Args:
        size: Size [bytes].
    """
    return f"{size / 1e9:.3g} GB" if size >= 1e9 else f"{size / 1e6:.3g} MB"


def free_memory() -> int | None:
    """Return the memory that this process may still take [bytes], by the machine and by its control group.

    Returns:
        The smaller of the two. None if the system reports neither.
    """
    known = []
    with suppress(OSError, ValueError, LookupError):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        sizes = {name: value.split()[0] for name, _, value in (line.partition(":") for line in lines)}
        known.append(1024 * int(sizes["MemAvailable"]))
    for most, used in (
        ("memory.max", "memory.current"),
        ("memory/memory.limit_in_bytes", "memory/memory.usage_in_bytes"),
    ):
        with suppress(OSError, ValueError):
            text = [(_CGROUP / name).read_text(encoding="ascii").strip() for name in (most, used)]
            known.append(max(0, int(text[0]) - int(text[1])))
    return min(known, default=None)
