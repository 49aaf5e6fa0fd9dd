"""The export formats, and the export of a motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.exports import as_csv, as_json, as_mjcf, as_mjlab, as_ros2, as_unitree, as_urdf
from levade.exports.content import Content, held, provenance, surroundings
from levade.exports.directory import filling
from levade.exports.samples import Samples, sample
from levade.exports.simulation import simulation
from levade.feedback import Feedback
from levade.motions import Motion
from levade.robots.settling import sunk_feet

SLOW = 200.0
"""Lowest useful rate [Hz]. Commands that last longer than 5 ms no longer give a motion of tenths of seconds."""

Write = Callable[[Content, Path], list[str]]


@dataclass(frozen=True)
class Format:
    """Describes an export format.

    Attributes:
        description: Purpose of the format.
        write: Writes the files into a directory, and returns notes for the user.
        rate: Rows per second [Hz]. None for the simulation's.
        plays: Whether its rows can be sent to a robot. If not, the files for playing have the simulation's rate.
        check: Raises LevadeError if the motion does not fit the format.
    """

    description: str
    write: Write
    rate: float | None = None
    plays: bool = True
    check: Callable[[Motion], object] | None = None


FORMATS = {
    "csv": Format("a table, with meta.json", as_csv.write),
    "json": Format("everything in one file", as_json.write),
    "ros2": Format("an MCAP bag and a JointTrajectory in YAML", as_ros2.write, check=as_ros2.check),
    "mjlab": Format("a reference motion for mjlab's tracking task", as_mjlab.write, as_mjlab.RATE, plays=False),
    "unitree": Format("low-level motor commands", as_unitree.write, as_unitree.RATE, check=as_unitree.motors),
    "urdf": Format("the robot as URDF, with its meshes", as_urdf.write),
    "mjcf": Format("robot and scene as MuJoCo models", as_mjcf.write, check=as_mjcf.check),
}


@dataclass(frozen=True, eq=False)
class Exported:
    """Lists what was written.

    Attributes:
        notes: Sentences that the user should read.
    """

    format: str
    directory: Path
    written: tuple[Path, ...]
    samples: Samples
    notes: tuple[str, ...]


def export(
    motion: Motion,
    to: str,
    directory: Path,
    *,
    rate: float | None = None,
    reference: str = "measured",
    hold: bool = True,
    kp: float | None = None,
    kd: float | None = None,
    command: str | None = None,
) -> Exported:
    """Write a motion in a format: all files or none.

    Args:
        motion: A motion.
        to: Name of the format, a key of `FORMATS`.
        directory: Directory to write. It is created if it does not exist.
        rate: Rows per second [Hz]. Defaults to the format's.
        reference: What to send, "measured" or "commanded": see `levade.exports.samples.sample`.
        hold: Whether to go on after the horizon.
        kp: Position gain of all joints [Nm/rad]. Defaults to the simulation's.
        kd: Velocity gain of all joints [Nm s/rad]. Defaults to the simulation's.
        command: The command line, for the provenance.

    Returns:
        The files that were written, with samples and notes.

    Raises:
        LevadeError: If the format does not exist, or the motion does not fit it.
    """
    if to not in FORMATS:
        raise LevadeError(f"no format {to!r}; {did_you_mean(to, FORMATS)}", field="to")
    form = FORMATS[to]
    if form.check is not None:
        form.check(motion)
    model = motion.compiled()
    own = 1.0 / motion.timestep

    def at(rate: float) -> Samples:
        return sample(motion, model, rate=rate, reference=reference, hold=hold, kp=kp, kd=kd)

    samples = at(rate if rate is not None else form.rate or own)
    playing = samples if form.plays else at(own)
    feedback = _feedback(motion, playing, own_gains=kp is None and kd is None)
    facts = simulation(motion, model)
    content = Content(motion, model, samples, playing, provenance(motion, command), facts, feedback)
    with filling(directory) as partial:
        notes = form.write(content, partial)
        names = sorted(path.relative_to(partial) for path in partial.rglob("*") if path.is_file())
    if (
        feedback is None and Path(as_csv.META) in names
    ):  # of an earlier export to the same directory: nothing here says any more that it belongs to it
        (directory / as_csv.FEEDBACK).unlink(missing_ok=True)
    sunk = _sunk_notes(model, facts["start_depth"])
    notes = [*_notes(motion, playing), *sunk, *_feedback_notes(motion, feedback), *notes]
    return Exported(to, directory, tuple(directory / name for name in names), samples, tuple(notes))


def _feedback(motion: Motion, playing: Samples, *, own_gains: bool) -> Feedback | None:
    """Return the motion's stabiliser if it fits the rows: drives of the same gains, and a row at each of its ticks."""
    feedback = motion.feedback
    if feedback is None or not own_gains:
        return None
    rows = playing.rate * feedback.period
    return feedback if rows > 0.5 and abs(rows - round(rows)) < 1e-6 else None


def _feedback_notes(motion: Motion, feedback: Feedback | None) -> list[str]:
    own = motion.feedback
    if own is None or feedback is not None:
        return []
    return [
        f"the stabiliser is left out: it goes with the simulation's gains, and with rates that are"
        f" multiples of {1 / own.period:g} Hz"
    ]


def _sunk_notes(model: mujoco.MjModel, depth: Mapping[str, float]) -> list[str]:
    """Note that the robot's feet lie in the floor at the start, if they do.

    Args:
        model: The compiled model of the motion.
        depth: How deep each foot is in the floor [m], by name.
    """
    deep = sunk_feet(model, depth)
    if not deep:
        return []
    foot = max(deep, key=lambda foot: depth[foot] / deep[foot])
    return [
        f"at the start {', '.join(deep)} are up to {1000 * depth[foot]:.2g} mm in the ground, of a radius of"
        f" {1000 * deep[foot]:.2g} mm: contact is soft, and on hard ground the robot starts higher; solve the task with"
        " scene: {contact: stiff}"
    ]


def _notes(motion: Motion, samples: Samples) -> list[str]:
    """Say what the user of the files should know before playing them."""
    notes = [] if motion.result.success else ["the motion does not meet its success criteria"]
    if around := surroundings(motion):
        notes.append(
            f"the motion needs {around} where its task has it (scene in the provenance); the rows do not say so"
        )
    if samples.rate < SLOW:
        notes.append(
            f"{samples.rate:g} Hz is slow for sending to a robot, for whose motion {SLOW:g} Hz or more is right"
        )
    if still := held(motion):
        angles = ", ".join(f"{joint} {angle:g}" for joint, angle in still.items())
        notes.append(
            f"the simulation holds {angles} [rad, slides m], and no command says so: hold them there (meta: held)"
        )
    joints = samples.joints
    over = np.maximum(joints.lower - samples.command_position, samples.command_position - joints.upper).max(axis=0)
    if (over > 0).any():
        names = ", ".join(name for name, by in zip(joints.names, over, strict=True) if by > 0)
        notes.append(
            f"positions to send go beyond the range of {names}, by up to {over.max():.3f} rad; player.py clamps them"
        )
    return notes
