"""Pursue motions for hardware from falls: within every limit, on perturbed models, and with a certificate.

    found = pursue_fall(falls, 4, around=None, hardware=Hardware(), seed=0, directory=Path("falls/pursuits/000004"))
    found.method, found.motion, found.certificate.passed

The searches are those of `levade.hardware`, one fall at a time, since their parts follow from certificates. Motions have no
feedback: a library commands the same references from falls that differ.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from levade.checks import Certificate
from levade.document import read_yaml
from levade.errors import LevadeError
from levade.hardware import Pursued, binding, pursue
from levade.library.falls import Falls
from levade.library.records import Method, certificate_path, fall_of, motion_path
from levade.motions import Motion
from levade.tasks import Demands
from levade.writing import write_text

PURSUITS = "pursuits"
"""Directory of the searches of unfinished falls, so that a build goes on where it was."""

TRIALS = 6000
"""Usual budget of roll-outs of one fall."""

_ON_NEAR = 0.3
"""Share of the budget for the search around a known motion."""


@dataclass(frozen=True)
class Hardware:
    """What a library for hardware demands of each motion, and how long it searches.

    Attributes:
        demands: Demands of the certificate.
        trials: Most roll-outs of the searches of one fall. Those that try known motions, and those of certificates, do not
            count.
        runs: Most perturbed runs of each certificate.

    Raises:
        LevadeError: If there are no trials.
    """

    demands: Demands = field(default_factory=Demands)
    trials: int = TRIALS
    runs: int = 500

    def __post_init__(self) -> None:
        if self.trials < 1:
            raise LevadeError(f"{self.trials} trials are too few; give 1 or more, such as {TRIALS}", field="trials")


@dataclass(frozen=True, eq=False)
class Found:
    """What the searches from a fall found.

    Attributes:
        method: Which search found a motion with a certificate that passes; `Method.NONE` if none did.
        motion: The motion with the best certificate.
        certificate: Its certificate.
        trials: Number of roll-outs of the searches.
    """

    method: Method
    motion: Motion
    certificate: Certificate
    trials: int


def pursue_fall(
    falls: Falls,
    fall: int,
    *,
    around: Motion | None,
    hardware: Hardware,
    seed: int,
    directory: Path,
    stopping: Callable[[], bool] = lambda: False,
) -> Found | None:
    """Search around a motion, and then from nothing, until a certificate passes or the budget is spent.

    Args:
        falls: The family of falls.
        fall: Number of the fall.
        around: Motion to search around first. None for none.
        hardware: Demands and budget.
        seed: Seed of the searches.
        directory: Directory of the searches. Those that an interrupted call left there go on, to the same result.
        stopping: Function that is called between generations. When it returns True, the searches end.

    Returns:
        The motion with the best certificate. None if the searches were stopped.

    Raises:
        LevadeError: If the task is not consistent, or the directory cannot be written.
    """
    made: list[Pursued] = []
    for method, near in ((Method.NEAR, around), (Method.COLD, None)):
        if method == Method.NEAR and near is None:
            continue
        left = hardware.trials - sum(one.trials for one in made)
        if method == Method.NEAR:
            left = max(1, round(_ON_NEAR * left))
        elif left < 1:
            break
        directory.mkdir(parents=True, exist_ok=True)
        found = pursue(
            falls.task_from(fall),
            robot=falls.simulation.robot,
            seed=seed,
            threads=falls.threads,
            directory=directory / method.value,
            trials=left,
            around=near,
            feedback=False,
            demands=hardware.demands,
            runs=hardware.runs,
            stopping=stopping,
        )
        if found.stopped == "interrupted":
            return None
        made.append(found)
        if found.passed:
            return Found(method, found.motion, found.certificate, sum(one.trials for one in made))
    best = min(made, key=lambda one: one.best.rank)
    return Found(Method.NONE, best.motion, best.certificate, sum(one.trials for one in made))


def write_certificate(directory: Path, fall: int, certificate: Certificate) -> None:
    """Write the certificate of a fall's motion.

    Args:
        directory: Directory of the library.
        fall: Number of the fall.
        certificate: The certificate.

    Raises:
        OSError: If the file cannot be written.
    """
    place = certificate_path(directory, fall)
    motion = Path("..") / motion_path(directory, fall).relative_to(directory)
    content = {"motion": motion.as_posix(), "binding": binding(certificate), **certificate.to_json()}
    place.parent.mkdir(exist_ok=True)
    write_text(place, json.dumps(content, ensure_ascii=False, indent=1) + "\n")


def read_certificate(directory: Path, motion: int) -> dict[str, Any]:
    """Read the certificate of a motion, which is also that of its mirror image.

    Args:
        directory: Directory of the library.
        motion: Number of the motion.

    Returns:
        What `write_certificate` wrote.

    Raises:
        LevadeError: If the file is missing or damaged.
    """
    place = certificate_path(directory, fall_of(motion))
    content = read_yaml(place)
    if not isinstance(content, dict) or not isinstance(content.get("passed"), bool):
        raise LevadeError(f"{place}: is not a certificate, or is damaged; remove the fall's record, and build again")
    return content
