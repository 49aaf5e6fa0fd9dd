"""How much memory roll-outs need, and how many fit at once."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from levade.engines import Engine
from levade.errors import LevadeError

_SHARE = 0.5
"""Of the free memory that roll-outs may take: the rest is for everything else."""

_CGROUP = Path("/sys/fs/cgroup")


@dataclass(frozen=True)
class Need:
    """Memory of trials of one length.

    Attributes:
        trial: What one trial takes while it is simulated and judged [bytes].
        free: What there is [bytes]; None where the system does not tell.
    """

    trial: int
    free: int | None

    @property
    def at_once(self) -> int | None:
        """How many trials fit at once, perhaps none; None if that is not known."""
        return None if self.free is None else int(_SHARE * self.free) // self.trial


def needed(engine: Engine, steps: int) -> Need:
    """Memory that a trial of an engine needs; steps: its physics steps, with the hold."""
    model, joints = engine.model, engine.embodiment.joints
    # what an engine records, the reference, the trajectory and what costs compute of it, all of 8 bytes; on average less
    numbers = 10 * joints + model.nq + model.nv + model.nu + model.nsensordata
    return Need(max(1, 8 * numbers * steps), free_memory())


def check_fits(engine: Engine, steps: int) -> None:
    """Raise LevadeError if not even one trial fits into the memory."""
    need = needed(engine, steps)
    if need.at_once is not None and need.at_once < 1:
        raise LevadeError(
            f"horizon: a trial of {steps} steps needs {in_words(need.trial)}, and {in_words(need.free or 0)} are free, half of"
            " which may be used; give a shorter horizon and hold, or a longer physics.timestep"
        )


def in_words(size: int) -> str:
    """A size [bytes] with its unit."""
    return f"{size / 1e9:.3g} GB" if size >= 1e9 else f"{size / 1e6:.3g} MB"


def free_memory() -> int | None:
    """Memory that this process may still take [bytes], of the machine and of its control group; None if it is not told."""
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
