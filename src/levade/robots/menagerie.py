"""Find robots of MuJoCo Menagerie by name: ``menagerie:unitree_g1``, or ``menagerie:unitree_g1/g1_with_hands`` for one model.

The package ``mujoco-menagerie`` lists the robots, and keeps those that it has fetched in a folder. This module neither imports
it nor makes it fetch anything. If ``MENAGERIE_ROOT`` names a checkout of Menagerie, the package is not needed.
"""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from levade.errors import LevadeError, MissingPackage, did_you_mean

PREFIX = "menagerie:"
_PUBLISHED = ".complete"
"""Name of the file that the package writes into a completely fetched folder."""


def find_menagerie_robot(name: str) -> Path | None:
    """Find the file of ``menagerie:robot``.

    Args:
        name: Name of a robot.

    Returns:
        Path of the file. None for names that do not begin with ``menagerie:``.

    Raises:
        MissingPackage: If the package is not installed.
        LevadeError: If there is no such robot, or its files are not on this machine.
    """
    if not name.startswith(PREFIX):
        return None
    robot, _, model = name.removeprefix(PREFIX).partition("/")
    root, known = os.environ.get("MENAGERIE_ROOT"), _registry()
    if known is None and not root:
        raise MissingPackage(
            f"robot {name}: mujoco-menagerie is not installed; pip install mujoco-menagerie, or set MENAGERIE_ROOT to a"
            " checkout of Menagerie"
        )
    if known is not None and robot not in known:
        raise LevadeError(f"robot {name}: no {robot!r} in Menagerie; {did_you_mean(robot, known)}")
    folder = Path(root) / robot if root else _fetched(robot, (known or {})[robot])
    if not folder.is_dir() or not (root or (folder / _PUBLISHED).is_file()):
        raise LevadeError(
            f"robot {name}: its files are not on this machine (looked in {folder}); with network access, python -m"
            f" mujoco_menagerie path {robot} fetches them; or set MENAGERIE_ROOT to a checkout of Menagerie"
        )
    models = _models(folder, (known or {}).get(robot))
    chosen = model or next(iter(models), "")
    if chosen not in models:
        raise LevadeError(f"robot {name}: no model {chosen!r} of {robot}; {did_you_mean(chosen, models)}")
    return models[chosen]


def _registry() -> Mapping[str, Any] | None:
    """Read the package's entry for each robot; None if the package is not installed."""
    found = importlib.util.find_spec("mujoco_menagerie")
    if found is None or not found.submodule_search_locations:
        return None
    try:
        text = (Path(found.submodule_search_locations[0]) / "registry.json").read_text(encoding="utf-8")
        robots = json.loads(text)["robots"]
    except (OSError, ValueError, LookupError):
        raise LevadeError("mujoco-menagerie: the registry cannot be read; reinstall the package") from None
    return robots


def _fetched(robot: str, entry: Mapping[str, Any]) -> Path:
    """Return the folder into which the package puts a robot's files."""
    return _cache() / "models" / f"{robot}-{str(entry.get('oid', ''))[:16]}"


def _cache() -> Path:
    if given := os.environ.get("MENAGERIE_CACHE_DIR"):
        return Path(given)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local") / "mujoco_menagerie" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library/Caches/mujoco_menagerie"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "mujoco_menagerie"


def _models(folder: Path, entry: Mapping[str, Any] | None) -> dict[str, Path]:
    """Map names to files of the robot's models, without scenes, the default one first."""
    if entry is None:
        files = [path for path in sorted(folder.glob("*.xml")) if not path.stem.startswith("scene")]
        files.sort(key=lambda path: (not folder.name.endswith(path.stem), len(path.stem)))
        return {path.stem: path for path in files}
    points = {name: folder / point["file"] for name, point in entry["entry_points"].items() if point["kind"] == "robot"}
    usual = entry["default_model"]
    return {name: points[name] for name in sorted(points, key=lambda name: name != usual) if points[name].is_file()}
