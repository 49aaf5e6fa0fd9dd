"""``levade stabilise``: a motion with feedback."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape

from levade.cli.checking import changed
from levade.cli.tables import make_console
from levade.engines import Perturbation
from levade.errors import LevadeError
from levade.motion import Motion
from levade.stabilise import stabilise


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
    """Exit status 0 if a stabiliser is written, 1 if the motion is better without."""
    motion = Motion.load(path)
    place = out if out is not None else path.with_name(f"{path.stem}-stabilised.npz")
    if not place.parent.is_dir():
        raise LevadeError(f"--out {place}: no such directory; make it, or give another")
    console = make_console()
    found = stabilise(
        motion,
        rate=rate,
        bound=bound,
        runs=runs,
        seed=seed,
        perturbation=changed(Perturbation(), perturb, option="--perturb"),
        threads=threads,
        tell=None if as_json else lambda line: console.print(f"  {line}", style="dim"),
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
            "open_loop": found.open_loop,
            "share": found.share,
            "design": None if found.design is None else vars(found.design),
            "feedback": None if found.design is None else found.motion.meta["feedback"],
        }
        print(json.dumps(content, ensure_ascii=False))
        return 0 if found.design is not None else 1
    if found.design is None:
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
