"""``levade show``: what a motion file holds."""

from __future__ import annotations

import json
from pathlib import Path

from rich.console import Console

from levade.cli.tables import motion_summary
from levade.motion import Motion


def show_motion(path: Path, *, as_json: bool) -> int:
    """Exit status 0 if the motion meets its success criteria, else 1."""
    motion = Motion.load(path)
    meta = motion.meta
    if as_json:
        print(json.dumps({"motion": str(path), **meta}, ensure_ascii=False))
    else:
        console = Console(highlight=False, soft_wrap=True)
        steps, horizon = len(motion["time"]), meta["horizon"]
        hold = motion["time"][-1] - horizon
        console.print(
            f"[bold]{meta['task']['name']}[/] on {meta['robot']}, seed {meta['seed']}: {horizon:g} s"
            + (f" and {hold:g} s of hold" if hold > 1e-9 else "")
            + f", {steps} steps of {meta['timestep'] * 1e3:g} ms"
        )
        for part in motion_summary(motion):
            console.print(part)
        made = ", ".join(f"{name} {version}" for name, version in meta["versions"].items())
        console.print(f"{meta['trials']} trials, cost {meta['cost']:.4g}; made with {made}")
    return 0 if meta["success"] else 1
