"""``levade stabilise``: add feedback to a motion."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape

from levade.cli.checking import changed
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console
from levade.engines import Perturbation
from levade.errors import LevadeError
from levade.motions import Motion
from levade.stabilisers import stabilise
from levade.writing import check_replaceable


def stabilise_motion(
    path: Path,
    *,
    out: Path | None,
    rate: float,
    bound: float,
    runs: int,
    seed: int,
    perturb: Sequence[str],
    threads: int,
    as_json: bool,
) -> int:
    """Add a stabiliser to a motion.

    Ctrl-C keeps the best stabiliser so far.

    Args:
        path: File of the motion.
        out: File to write. None for MOTION-stabilised.npz next to the motion.
        rate: Measurements per second [Hz].
        bound: Largest correction of a joint's reference [rad].
        runs: Number of perturbed runs that choose the stabiliser.
        seed: Seed of these runs.
        perturb: Changes of the default ranges: files, or ``name=range``.
        threads: Number of engine threads (0: one per core).
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if the motion is written, 1 if it is better without.

    Raises:
        LevadeError: If the file cannot be written.
    """
    motion = Motion.load(path)
    place = out if out is not None else path.with_name(f"{path.stem}-stabilised.npz")
    if not place.parent.is_dir():
        raise LevadeError(f"--out {place}: no such directory; make it, or give another")
    if place.is_dir():
        raise LevadeError(
            f"--out {place}: is a directory; give a file in it, such as {place / 'motion-stabilised.npz'}"
        )
    if place.exists() and place.samefile(path):
        raise LevadeError(f"--out {place}: is the motion itself; give another file, or leave it out")
    try:
        check_replaceable(place)
    except OSError as error:
        raise LevadeError(f"--out {place}: cannot be written ({error.strerror}); give another") from None
    if not os.access(place.parent, os.W_OK):
        raise LevadeError(f"--out {place}: its directory cannot be written; give another")
    console = make_console()
    perturbation = changed(Perturbation(), perturb, option="--perturb")
    with stop_between("design") as stopping:
        found = stabilise(
            motion,
            rate=rate,
            bound=bound,
            runs=runs,
            seed=seed,
            perturbation=perturbation,
            threads=threads,
            tell=None if as_json else lambda line: console.print(f"  {line}", style="dim"),
            stopping=stopping,
        )
    if found.design is not None:
        try:
            found.motion.save(place)
        except OSError as error:
            raise LevadeError(
                f"{place}: cannot be written ({error.strerror}); give a path that can: --out FILE"
            ) from None
    if as_json:
        content = {
            "motion": str(path),
            "written": None if found.design is None else str(place),
            "runs": found.runs,
            "open_loop": None if math.isnan(found.open_loop) else found.open_loop,
            "share": None if math.isnan(found.share) else found.share,
            "design": None if found.design is None else vars(found.design),
            "interrupted": found.interrupted,
            "feedback": None if found.design is None else found.motion.stabiliser,
        }
        print(json.dumps(content, ensure_ascii=False))
        return 0 if found.design is not None else 1
    tried = len(found.tried)
    if found.interrupted:
        when = f"after {tried} design{'s' * (tried != 1)}" if tried else "before a design was tried: nothing is written"
        console.print(f"[yellow]Interrupted[/] {when}{': the best is kept' if found.design else ''}.")
    if found.design is None:
        if tried or not found.interrupted:
            console.print(
                f"No stabiliser is surely better than none ({found.open_loop:.1%} of {found.runs} runs): nothing is written."
            )
        return 1
    console.print(
        f"{found.share:.1%} of {found.runs} perturbed runs succeed with it, {found.open_loop:.1%} without."
        f" The check, with other runs: levade check {escape(str(place))}"
    )
    console.print(f"Written to {escape(str(place))}")
    return 0
