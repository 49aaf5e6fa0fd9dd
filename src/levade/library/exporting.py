"""Export a library for a robot: one folder that needs only numpy. It asks, plays, checks whether the robot stands, and repeats.

    exported = export_library(Library.load("falls"), Path("falls-robot"))

FOLDER/ask.py                       asks and plays (`levade.exports.asker`)
FOLDER/player.py                    plays one motion (`levade.exports.player`)
FOLDER/library.json, model.npz      joints, the fold, paths of the motions; the model that ranks them
FOLDER/motions/000012/from-000034   a motion of the library from a fall, as `levade export` writes it

A motion that gets up from many falls runs differently from each of them. A player has to compare the robot with a simulation
from where the robot lies. So the folder holds a motion once for each lying pose to which it is the first answer. Mirror images
of motions are in 000012-mirrored; they are simulated from the mirror images of falls.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from levade.archive import packed
from levade.arrays import Array
from levade.engines import State
from levade.errors import LevadeError
from levade.exports import export
from levade.exports.as_csv import write_json, write_player, write_script
from levade.exports.asker import SIMILAR, Model, apart, checksum
from levade.exports.directory import filling
from levade.library.asking import Library
from levade.library.falls import Falls
from levade.library.knowledge import Knowledge
from levade.library.learning import arrays_of
from levade.library.plays import Plays, simulated
from levade.library.records import fall_of, image_of
from levade.library.storing import read_falls
from levade.motions import Motion
from levade.robots import Robot


@dataclass(frozen=True)
class ExportedLibrary:
    """Lists what an export wrote.

    Attributes:
        directory: Directory of the export.
        motions: Number of each motion -> its folders, one for each lying pose from which it was simulated.
        failed: Folders in which the motion does not work. The model accounts for these in its probabilities.
    """

    directory: Path
    motions: dict[int, tuple[Path, ...]]
    failed: tuple[Path, ...]


def export_library(
    library: Library,
    directory: Path,
    *,
    robot: Robot | None = None,
    rate: float | None = None,
    command: str | None = None,
    observe: Callable[[int, int], object] = lambda done, motions: None,
) -> ExportedLibrary:
    """Write a library for a robot, either all its files or none.

    Args:
        library: The library.
        directory: Directory to write to.
        robot: The library's robot. Defaults to the one that the task names.
        rate: Rate of the motions' rows [Hz]. Defaults to the simulation's.
        command: Command line that asked for the export, which is written into the files.
        observe: Function that is called with the number of finished motions and the total.

    Returns:
        The paths that were written.

    Raises:
        LevadeError: If the library has no motions, its robot does not fold up first, or the directory cannot be written.
    """
    knowledge = library.knowledge
    if not len(knowledge.motions):
        raise LevadeError(f"{library.directory}: no motion was found yet; continue the build")
    if library.fold is None:
        raise LevadeError(
            f"{library.directory}: the robot does not fold up first, so a player cannot check where a motion begins;"
            " build a library whose start has fallen: {fold: {}}"
        )
    falls, seed = read_falls(library.directory, robot=robot)
    task = falls.task
    folding = falls.folding
    assert folding is not None
    fold, freeing = folding.fold, folding.freeing
    plays = Plays(library.directory, knowledge.mirror)
    folders: dict[int, list[str]] = {}
    failed: list[str] = []
    ways, written = _ways(library), 0
    with filling(directory) as partial:
        for number, lying in ways.items():
            motion = f"motions/{fall_of(number):06}{'-mirrored' * (number < 0)}"
            for fall, image in lying:
                folder = f"{motion}/from-{fall:06}{'-mirrored' * image}"
                motion_there = _simulated(falls, plays, number, fall, image=image)
                if not motion_there.result.success:
                    failed.append(folder)
                export(motion_there, "csv", partial / folder, rate=rate, reference="commanded", command=command)
                (partial / folder / "player.py").unlink()
                folders.setdefault(number, []).append(folder)
                written += 1
                observe(written, sum(map(len, ways.values())))
        own = {one.name: getattr(knowledge.model, one.name) for one in fields(Model)}
        model = packed(own if library.learned is None else arrays_of(library.learned))
        (partial / "model.npz").write_bytes(model)
        about: dict[str, Any] = {
            "joints": list(falls.simulation.robot.joint_names),
            "fold": {
                "position": library.fold.tolist(),
                "time": fold.time,
                "rest": fold.rest,
                "freeing": None if freeing is None else {"position": freeing.tolist(), "jammed": fold.jammed},
            },
            "motions": {str(number): places for number, places in folders.items()},
            "library": {
                "task": task.name,
                "robot": falls.simulation.robot.name,
                "seed": seed,
                "falls": len(library.records),
            },
            "command": command,
        }
        write_json(partial / "library.json", {**about, "checksum": checksum(about, model)}, indent=2)
        write_player(partial)
        write_script("asker.py", partial / "ask.py")
    places = {number: tuple(directory / folder for folder in own) for number, own in folders.items()}
    return ExportedLibrary(directory, places, tuple(directory / folder for folder in failed))


def _ways(library: Library) -> dict[int, list[tuple[int, bool]]]:
    """Choose the falls from which each motion is simulated, each with whether its mirror image is meant.

    A motion gets its own fall, and each fall to which it is the first answer and works. Falls that are close to one that was
    chosen already are left out.
    """
    known, mirror = library.knowledge, library.knowledge.mirror
    row = {int(fall): i for i, fall in enumerate(known.falls)}
    column = {int(number): j for j, number in enumerate(known.motions)}
    ways = {number: [(fall_of(number), number < 0)] for number in column}
    states = {number: [_lying(known, row[fall], image=image)] for number, ((fall, image),) in ways.items()}
    for fall, i in row.items():
        number = library.model.ranked(known.up[i], known.joint_position[i])[0][0]
        if known.success[i, column[number]] != 1.0:
            continue
        for image in (False, True) if mirror else (False,):
            played, lying = image_of(number) if image else number, _lying(known, i, image=image)
            if min(apart(*other, *lying) for other in states[played]) > SIMILAR:
                ways[played].append((fall, image))
                states[played].append(lying)
    return ways


def _lying(known: Knowledge, row: int, *, image: bool) -> tuple[Array, Array]:
    """Return the upward direction in a fall, or in its mirror image, and the joint angles."""
    up, joints = known.up[row], known.joint_position[row]
    return (known.mirror.up(up), known.mirror.posture(joints)) if image and known.mirror is not None else (up, joints)


def _simulated(falls: Falls, plays: Plays, number: int, fall: int, *, image: bool) -> Motion:
    """Simulate a motion from a fall; or, after folding up, from the mirror image of the fall."""
    lying, play = falls.objective(fall), plays[number]
    return simulated(falls.from_state(_mirrored(falls, lying.state)) if image else lying, play)


def _mirrored(falls: Falls, lying: State) -> State:
    """Return the mirror image of a state, at rest."""
    mirror, layout = falls.mirror, falls.simulation.engine.layout
    assert mirror is not None
    qpos = lying.qpos[0].copy()
    qpos[layout.trunk_position] *= np.array([1.0, -1.0, 1.0])
    qpos[layout.trunk_quaternion] *= np.array([1.0, -1.0, 1.0, -1.0])
    qpos[layout.joint_qpos] = mirror.posture(lying.joint_position[0])
    told = mirror.posture(lying.joint_reference[0])
    still = np.zeros_like(lying.qvel[0]), np.zeros_like(lying.act[0])
    return falls.folded(layout.state(qpos, *still, joint_reference=told))
