"""A library for a robot: one folder that needs numpy alone, which asks, plays, looks whether it stands, and asks again.

    exported = export_library(Library.load("falls"), Path("falls-robot"))

FOLDER/ask.py                       asks and plays (`levade.exports.asker`)
FOLDER/player.py                    plays one motion (`levade.exports.player`)
FOLDER/library.json, model.npz      joints, the fold, where motions are; what it answers by
FOLDER/motions/000012/motion.csv    a motion of the library, as `levade export` writes it; its image is in 000012-mirrored

A mirrored motion is simulated from where the image of its fall lies.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from levade.errors import LevadeError
from levade.exports import export
from levade.exports.as_csv import write_json, write_player, write_script
from levade.exports.asker import Model, checksum
from levade.exports.directory import filling
from levade.library.asking import Library
from levade.library.falls import Falls, Plays
from levade.library.learning import packed as learned_bytes
from levade.library.records import fall_of
from levade.library.storing import read_library
from levade.motions import Motion
from levade.robots import Robot
from levade.search.evaluation import Trials
from levade.search.objective import Objective
from levade.search.outcome import Solution, Stopped, Trial
from levade.search.recording import record


@dataclass(frozen=True)
class ExportedLibrary:
    """What was written.

    Attributes:
        directory: Where.
        motions: Number of each motion -> its folder.
        failed: Numbers of mirrored motions that do not work where they are simulated from; the model knows how often they do.
    """

    directory: Path
    motions: dict[int, Path]
    failed: tuple[int, ...]


def export_library(
    library: Library,
    directory: Path,
    *,
    robot: Robot | None = None,
    rate: float | None = None,
    kp: float | None = None,
    kd: float | None = None,
    command: str | None = None,
    observe: Callable[[int, int], object] = lambda done, motions: None,
) -> ExportedLibrary:
    """Write a library for a robot, all files of it or none.

    Args:
        library: The library.
        directory: Where to write.
        robot: Its robot, if the task's name does not say it.
        rate: Of the motions' rows [Hz]. Defaults to the simulation's.
        kp: Gain of the robot's drives instead of the simulated ones' [Nm/rad].
        kd: As well [Nm s/rad].
        command: How it was asked for, for the record.
        observe: Called with the number of motions that are done, and of all.

    Raises:
        LevadeError: If the library has no motions, or its falls do not fold up first, or the directory cannot be written.
    """
    knowledge = library.knowledge
    if not len(knowledge.motions):
        raise LevadeError(f"{library.directory}: no motion was found yet; build it further")
    if library.fold is None:
        raise LevadeError(
            f"{library.directory}: its falls do not fold up first, so that its motions begin anywhere, and no player can check"
            " that; build one whose start has fallen: {fold: {}}"
        )
    task, seed = read_library(library.directory)
    falls = Falls(task, robot=robot, seed=seed, threads=1)
    fold = task.start.fallen and task.start.fallen.fold
    assert fold is not None
    plays, folders, failed = Plays(library.directory, knowledge.mirror), {}, []
    with filling(directory) as partial:
        for number in map(int, knowledge.motions):
            folder = f"motions/{fall_of(number):06}{'-mirrored' if number < 0 else ''}"
            motion = plays[number].motion if number >= 0 else _image(falls, plays, number)
            if not motion.result.success:
                failed.append(number)
            export(motion, "csv", partial / folder, rate=rate, reference="commanded", kp=kp, kd=kd, command=command)
            (partial / folder / "player.py").unlink()
            folders[number] = folder
            observe(len(folders), len(knowledge.motions))
        model = packed(knowledge.model) if library.learned is None else learned_bytes(library.learned)
        (partial / "model.npz").write_bytes(model)
        about: dict[str, Any] = {
            "joints": list(falls.simulation.robot.joint_names),
            "fold": {"position": library.fold.tolist(), "time": fold.time, "rest": fold.rest},
            "motions": {str(number): folder for number, folder in folders.items()},
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
    return ExportedLibrary(directory, {number: directory / folder for number, folder in folders.items()}, tuple(failed))


def packed(model: Model) -> bytes:
    """A model's arrays, for numpy; the same ones give the same bytes."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for one in fields(Model):
            values = io.BytesIO()
            np.save(values, getattr(model, one.name), allow_pickle=False)
            file.writestr(zipfile.ZipInfo(f"{one.name}.npy"), values.getvalue(), zipfile.ZIP_DEFLATED)
    return content.getvalue()


def _image(falls: Falls, plays: Plays, number: int) -> Motion:
    """A mirrored motion, simulated from where the image of its fall lies once it has folded up."""
    play, mirror, layout = plays[number], falls.mirror, falls.simulation.engine.layout
    assert mirror is not None
    lying = falls.objective(fall_of(number)).state
    qpos = lying.qpos[0].copy()
    qpos[layout.trunk_position] *= np.array([1.0, -1.0, 1.0])
    qpos[layout.trunk_quaternion] *= np.array([1.0, -1.0, 1.0, -1.0])
    qpos[layout.joint_qpos] = mirror.posture(lying.joint_position[0])
    told = mirror.posture(lying.joint_reference[0])
    state = layout.state(qpos, np.zeros_like(lying.qvel[0]), np.zeros_like(lying.act[0]), joint_reference=told)
    objective = falls.from_state(falls.folded(state))
    return record(objective, _as_found(objective, play.decisions(objective.policy)), seed=play.motion.provenance.seed)


def _as_found(objective: Objective, weights: np.ndarray) -> Solution:
    """A motion as if it had been searched for: what it achieves on the model."""
    found = objective.evaluate(Trials(weights, objective.task.hold_steps))
    own = {name: one.weight for name, one in objective.task.costs.items()}
    best = Trial.of(weights[0], float(found.cost(own)[0]), found, 0)
    return Solution(
        best=best,
        trials=0,
        generations=0,
        trials_to_success=None,
        diverged=0,
        stopped=Stopped.SUCCESS,
        cost_weights=own,
        changes=(),
    )
