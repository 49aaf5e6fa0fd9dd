"""``levade library ask``: how the robot lies, and the library's answer as text, JSON and a table of references."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.markup import escape

from levade.arrays import Array
from levade.cli.tables import make_console
from levade.document import read_yaml
from levade.errors import LevadeError, did_you_mean
from levade.feedback import up_in_trunk
from levade.library import Library
from levade.library.records import motion_path
from levade.library.refining import refine as refined_answer
from levade.tasks.units import to_si
from levade.trajectory import JointReference
from levade.writing import write_text


def ask_library(
    directory: Path,
    *,
    state: Path | None,
    sensed: Mapping[str, str | None],
    reference: Path | None,
    refine: str | None,
    as_json: bool,
) -> int:
    """Ask a library.

    Args:
        directory: Directory of the library.
        state: File of the robot's attitude and joint angles, as JSON or YAML. None if the command line has them.
        sensed: "attitude", "up" and "joints" as the command line has them; None what it does not have.
        reference: File for the references of the joints, as CSV. None writes none.
        refine: Time to improve the answer in simulation, such as "1s". None does not improve it.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 1 if the answer was refined but still fails on the model, otherwise 0.
    """
    library = Library.load(directory)
    first = library.ask([0.0, 0.0, 1.0], np.zeros(library.knowledge.joint_position.shape[1]))
    names = first.motion.joint_names
    given = {name: text for name, text in sensed.items() if text is not None}
    typed = "joints" in given and ("attitude" in given) != ("up" in given)
    if given if state is not None else not typed:
        raise LevadeError("give how the robot lies: --state FILE, or else --joints and one of --attitude and --up")
    question = _typed(given, names) if state is None else _read_state(state, names)
    answer = library.ask(*question)
    better = None if refine is None else refined_answer(library, *question, seconds=refining_time(refine))
    if reference is not None:
        _write_reference(answer.reference if better is None else better.reference, names, reference)
    if as_json:
        content = {
            "motion": str(answer.path),
            "mirrored": answer.mirror is not None,
            "probability": answer.probability,
            **(
                {} if answer.failed is None else {"certificate": {"passed": not answer.failed, "failed": answer.failed}}
            ),
            "others": [
                {"motion": str(motion_path(directory, number)), "mirrored": number < 0, "probability": probability}
                for number, probability in answer.others
            ],
        }
        if better is not None:
            content["refined"] = {
                "motion": str(motion_path(directory, better.number)),
                "mirrored": better.number < 0,
                **{name: getattr(better, name) for name in ("works", "share", "searched", "trials", "seconds")},
            }
        print(json.dumps(content))
        return 0 if better is None or better.works else 1
    console = make_console()
    console.print(f"{named_motion(answer.path, answer.number)}: works with a probability of {answer.probability:.1%}")
    if answer.failed is not None:
        said = f"fails {', '.join(answer.failed)}" if answer.failed else "passes"
        console.print(f"  Its certificate, from its own fall, {escape(said)}.")
    for number, probability in answer.others[:3]:
        place = named_motion(Path(motion_path(directory, number).name), number)
        console.print(f"  next: {place}, {probability:.1%}", style="dim")
    if better is None:
        return 0
    place = named_motion(Path(motion_path(directory, better.number).name), better.number)
    what = f"a search from {place}" if better.searched else place
    works = f"works on the model, and on {better.share:.0%} of perturbed models" if better.works else "does not work"
    console.print(f"In simulation, {what} {works} ({better.trials} trials, {better.seconds:.1f} s).")
    return 0 if better.works else 1


def refining_time(text: str) -> float:
    """Read the time of ``--refine``.

    Args:
        text: A duration, such as "1s", "500 ms" or "1.5".

    Returns:
        Time [s].

    Raises:
        LevadeError: If it is no duration, or not a positive one.
    """
    value = to_si(text, where="--refine", measures="a duration")
    try:
        seconds = float(value)
    except (TypeError, ValueError):
        seconds = 0.0
    if not 0 < seconds < 1e6:
        raise LevadeError(f"--refine {text}: should be a time, such as 1s")
    return seconds


def named_motion(path: Path, number: int) -> str:
    """Name an answer for people, in markup.

    Args:
        path: Path of the motion.
        number: Number of the answer in the library; negative for the mirror image of a motion.
    """
    return f"{'the mirror image of ' if number < 0 else ''}{escape(str(path))}"


def _typed(given: Mapping[str, str], names: tuple[str, ...]) -> tuple[Array, Array]:
    """Read the upward direction in trunk axes and the joint angles from the command line."""
    content: dict[str, Any] = {name: _listed(text) for name, text in given.items()}
    if "=" in given.get("joints", ""):
        pairs = [word.partition("=")[::2] for word in _words(given["joints"])]
        content["joints"] = {name: _number(value) for name, value in pairs}
    return _question(content, names, "--")


def _words(text: str) -> list[str]:
    return text.replace(",", " ").split()


def _listed(text: str) -> list[Any]:
    return [_number(word) for word in _words(text)]


def _number(word: str) -> float | str:
    """Convert a word to a number. A word that is none stays as it is, and `_numbers` refuses it."""
    try:
        return float(word)
    except ValueError:
        return word


def _read_state(path: Path, names: tuple[str, ...]) -> tuple[Array, Array]:
    """Read the upward direction in trunk axes and the joint angles from a JSON or YAML file."""
    content = read_yaml(path, like="attitude and joints")
    known = {"attitude", "up", "joints"}
    for key in content:
        if key not in known:
            raise LevadeError(f"{path}: unknown key {key!r}; {did_you_mean(str(key), sorted(known))}")
    if ("attitude" in content) == ("up" in content):
        raise LevadeError(
            f"{path}: give either attitude, a quaternion w-x-y-z, or up, the upward direction in trunk axes"
        )
    return _question(content, names, f"{path}: ")


def _question(content: Mapping[str, Any], names: tuple[str, ...], where: str) -> tuple[Array, Array]:
    """Return the upward direction and the joint angles; ``where`` precedes the names of the entries in messages."""
    joints, place = content.get("joints"), f"{where}joints"
    if isinstance(joints, Mapping):
        for name in joints:
            if name not in names:
                raise LevadeError(f"{place}: no joint {name!r}; {did_you_mean(str(name), names)}")
        missing = [name for name in names if name not in joints]
        if missing:
            raise LevadeError(f"{place}: {missing[0]} is missing; give the angle of each joint [rad]")
        joints = [joints[name] for name in names]
    return _up(content, where), _numbers(joints, len(names), place)


def _up(content: Mapping[str, Any], where: str) -> Array:
    if "up" in content:
        return _numbers(content["up"], 3, f"{where}up")
    quaternion = _numbers(content["attitude"], 4, f"{where}attitude")
    norm = float(np.linalg.norm(quaternion))
    if not norm > 0:
        raise LevadeError(f"{where}attitude: four zeros are not a rotation; [1, 0, 0, 0] is level")
    return up_in_trunk(quaternion / norm)


def _numbers(values: Any, n: int, where: str) -> Array:
    good = isinstance(values, list) and len(values) == n
    if not good or any(isinstance(one, bool) or not isinstance(one, int | float) for one in values):
        raise LevadeError(f"{where}: should be {n} numbers")
    return np.array(values, dtype=float)


def _write_reference(reference: JointReference, names: Sequence[str], path: Path) -> None:
    """Write a table of time [s] and joint references [rad] of the motion, from where the joints are."""
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise LevadeError(f"--reference {path}: its directory is missing or not writable; give another path")
    position = reference.position[0]
    times = (np.arange(len(position)) + 1) * reference.timestep
    lines = [",".join(["time", *names])]
    lines += [",".join(map(repr, [float(t), *map(float, row)])) for t, row in zip(times, position, strict=True)]
    try:
        write_text(path, "\n".join(lines) + "\n")
    except OSError as error:
        raise LevadeError(f"--reference {path}: cannot be written ({error.strerror}); give another path") from None
