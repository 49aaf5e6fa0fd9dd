"""``levade export``: write a motion in the formats of other tools and of robots."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from pathlib import Path

from rich.markup import escape

from levade.checks.record import CERTIFICATE, doubt
from levade.cli.tables import make_console
from levade.errors import LevadeError
from levade.exports import FORMATS, Exported, export
from levade.motions import Motion

_TO_ROBOTS = ("csv", "json", "ros2", "unitree")
"""Formats that a robot plays. The others are for simulators."""

_FILES = (".csv", ".json", ".npz", ".mcap", ".yaml", ".py")


def export_motion(
    path: Path,
    to: str | None,
    directory: Path | None,
    *,
    rate: float | None,
    reference: str,
    hold: bool,
    kp: float | None,
    kd: float | None,
    certificate: Path | None,
    as_json: bool,
) -> int:
    """Write a motion in a format.

    Args:
        path: File of the motion.
        to: Name of the format.
        directory: Directory to write. None for one next to the motion.
        rate: Rows per second [Hz]. None for the format's own rate.
        reference: What to send: "measured" or "commanded".
        hold: Whether to go on after the horizon.
        kp: Position gain of all joints [Nm/rad]. None for the simulation's gains.
        kd: Velocity gain of all joints [Nm s/rad]. None for the simulation's gains.
        certificate: File of a certificate. The motion is only written if it belongs to the motion and passes.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0.

    Raises:
        LevadeError: If no format is given, the directory looks like a file, or the certificate does not pass.
    """
    if to is None:
        raise LevadeError(f"export {path}: no format given; add --to {', '.join(FORMATS)}")
    if directory is not None and directory.suffix in _FILES:
        raise LevadeError(
            f"--out {directory}: the export has several files; give a directory, such as {directory.stem}"
        )
    motion = Motion.load(path)
    if certificate is not None and (reason := doubt(certificate, motion)) is not None:
        raise LevadeError(f"--certificate {certificate}: {reason}; nothing is written. levade check says what to fix")
    options = [
        ("--rate", rate),
        ("--reference", None if reference == "measured" else reference),
        ("--kp", kp),
        ("--kd", kd),
        ("--out", directory),
    ]
    words = ["levade", "export", str(path), "--to", to]
    words += [word for name, value in options if value is not None for word in (name, _text(value))]
    words += ["--no-hold"] * (not hold)
    place = directory if directory is not None else path.with_name(f"{path.stem}-{to}")
    done = export(motion, to, place, rate=rate, reference=reference, hold=hold, kp=kp, kd=kd, command=shlex.join(words))
    if certificate is None and to in _TO_ROBOTS:
        done = replace(done, notes=(*done.notes, *_uncertified(path, motion)))
    if as_json:
        print(json.dumps({"motion": str(path), **_summary(done)}, ensure_ascii=False))
        return 0
    console = make_console()
    samples = done.samples
    joints = len(samples.joints.names)
    console.print(
        f"[bold]{escape(motion.task_name)}[/] on {escape(motion.robot)}: {len(samples.time)} rows at"
        f" {samples.rate:g} Hz, {samples.time[-1]:g} s, {joints} joints, {samples.reference} references"
    )
    for note in done.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}")
    names = ", ".join(escape(str(file.relative_to(done.directory))) for file in done.written)
    console.print(f"Written to {escape(str(done.directory))}: {names}")
    return 0


def _uncertified(path: Path, motion: Motion) -> tuple[str, ...]:
    """Return a note for a motion that goes to a robot without a passing certificate next to it."""
    beside = path.with_name(CERTIFICATE)
    try:
        reason = doubt(beside, motion) if beside.is_file() else f"there is no {beside}"
    except LevadeError:
        reason = f"{beside} is no certificate"
    if reason is None:
        return ()
    return (f"no certificate says that hardware can do this ({reason}): levade check {path} --out {beside}",)


def _summary(done: Exported) -> dict[str, object]:
    samples = done.samples
    return {
        "format": done.format,
        "directory": str(done.directory),
        "written": [str(file) for file in done.written],
        "rate": samples.rate,
        "rows": len(samples.time),
        "duration": float(samples.time[-1]),
        "reference": samples.reference,
        "joints": list(samples.joints.names),
        "notes": list(done.notes),
    }


def _text(value: object) -> str:
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
