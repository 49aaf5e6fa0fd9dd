"""``levade library``: build, merge, learn, export and show a library, and try it on falls that it has never seen."""

from __future__ import annotations

import json
import shlex
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from levade.cli.asking import named_motion, refining_time
from levade.cli.checking import changed
from levade.cli.pace import Pace
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console
from levade.errors import LevadeError
from levade.library import Hardware, Library, LibraryCheck, Progress, build, check_library
from levade.library.asking import LIBRARY
from levade.library.exporting import export_library
from levade.library.falls import FACES, face
from levade.library.figure import draw
from levade.library.learning import learn, save
from levade.library.merging import merge
from levade.library.page import write_library
from levade.library.pursuing import read_certificate
from levade.library.records import motion_path
from levade.library.storing import WHOLE, Shard, read_hardware
from levade.tasks import load_task

_WORDS = {
    "known": "by a known motion",
    "near": "by a search around a known motion",
    "cold": "by a search from nothing",
    "none": "not at all",
}


_WITHIN_LIMITS = {
    "known": "by a known motion, within the limits and on perturbed models",
    "near": "by a search around a known motion, with a certificate",
    "cold": "by a search from nothing, with a certificate",
    "none": "by no motion whose certificate passes; the best one is kept",
}
"""The same in a library for hardware."""


def build_library(
    task: str,
    *,
    robot: str | None,
    starts: int,
    seed: int,
    out: Path | None,
    changes: list[str],
    threads: int,
    jobs: int,
    ray: str | None,
    shard: str | None,
    hardware: bool,
    trials: int | None,
    demand: list[str],
    as_json: bool,
) -> int:
    """Build a library.

    Args:
        task: Name of the task of each motion, or its file.
        robot: Name of the robot, or its file. None for the task's own.
        starts: Number of falls in all.
        seed: Seed of the falls and of the searches.
        out: Directory to write. None for one named after the task.
        changes: Changes of the task, as ``path=value``.
        threads: Number of engine threads (0: one per core).
        jobs: Number of processes at a time.
        ray: Address of a Ray cluster. None for this computer alone.
        shard: Part to build, as ``I/N``. None for the whole library.
        hardware: Whether motions have to keep the limits of the hardware.
        trials: Most trials of the searches of one fall, for hardware. None for the directory's own number, or the usual one.
        demand: Changes of the demands of hardware: files, or ``name=value``.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if every fall is done, otherwise 1.
    """
    part = WHOLE if shard is None else _shard(shard)
    loaded = load_task(task, robot=robot, changes=changes)
    directory = out or Path(f"{loaded.name}-library")
    demanded = _demanded(directory, hardware, trials, demand)
    console = make_console(stderr=as_json)
    began, pace = time.monotonic(), Pace()

    def observe(progress: Progress) -> None:
        spent = time.monotonic() - began
        pace.add(progress.done)
        left = pace.left(progress.starts - progress.done) if progress.done < progress.starts else None
        console.print(
            f"  {progress.done} of {progress.starts} falls"
            + (f", {_rare_ones(progress.rare)}" if progress.rare else "")
            + f": {progress.motions} motions, {progress.trials} trials, {spent:.0f} s"
            + ("" if left is None else f", about {left} left")
            + ("" if progress.cpus is None else f", {progress.cpus} CPUs"),
            style="dim",
        )

    with stop_between("generation") as stopping:
        library = build(
            loaded,
            starts=starts,
            seed=seed,
            threads=threads,
            processes=jobs,
            ray=ray,
            shard=part,
            hardware=demanded,
            directory=directory,
            observe=observe,
            stopping=stopping,
        )
        stopped = stopping()
    place = escape(str(directory))
    written = [write_library(library, instead=_later(directory))] if library.records else []
    if as_json:
        summary = _summary(library, directory, written)
        print(json.dumps({**summary, "starts": starts, "interrupted": stopped}))
    else:
        _tell_library(console, library)
        if written:
            console.print(f"To open in a browser: {escape(str(written[0]))}")
        if stopped:
            console.print(f"[yellow]Interrupted[/]: build again to continue. All finished falls are in {place}.")
        else:
            console.print(f"To try it on falls that it has never seen: levade library check {place}")
    return 1 if stopped else 0


def _demanded(directory: Path, hardware: bool, trials: int | None, demand: list[str]) -> Hardware | None:
    """Return what a build demands of hardware: what the directory's library does, with the changes asked for."""
    if not hardware:
        for option, given in (("--trials", trials is not None), ("--demand", bool(demand))):
            if given:
                raise LevadeError(f"{option} only works with --hardware")
        return None
    known = read_hardware(directory) if (directory / LIBRARY).is_file() else None
    known = known or Hardware()
    demands = changed(known.demands, demand, option="--demand")
    return replace(known, demands=demands, trials=known.trials if trials is None else trials)


def _later(directory: Path) -> str:
    """Say what to do when a build cannot write the page."""
    return f"all falls are kept, and levade library show {directory} writes it later"


def _shard(text: str) -> Shard:
    parts = text.split("/")
    if len(parts) != 2 or not all(part.isdecimal() for part in parts):
        raise LevadeError(f"--shard {text}: should be I/N, such as 0/4 for the first of four shards")
    return Shard(*map(int, parts))


def merge_libraries(shards: list[Path], *, out: Path, as_json: bool) -> int:
    """Merge shards.

    Args:
        shards: Directories of the shards of one library.
        out: Directory of the library.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0.
    """
    merged = merge(shards, out)
    if as_json:
        print(
            json.dumps({"library": str(out), "falls": merged.falls, "starts": merged.starts, "motions": merged.motions})
        )
        return 0
    console, place = make_console(), escape(str(out))
    console.print(f"{merged.falls} of {merged.starts} falls and {merged.motions} motions are in {place}.")
    console.print(
        "To try every motion from every fall, build it again: use the command of its shards without --shard and with"
        f" --starts {merged.starts} --out {place}"
    )
    return 0


def learn_library(directory: Path, *, as_json: bool) -> int:
    """Learn which motion works from where.

    Args:
        directory: Directory of a library.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0.
    """
    found = learn(Library.load(directory))
    save(found, directory)
    if as_json:
        scores = {kind: vars(score) for kind, score in found.scores.items()}
        print(json.dumps({"library": str(directory), "scores": scores, "chosen": found.chosen}))
        return 0
    console = make_console()
    for kind, score in found.scores.items():
        console.print(
            f"{kind:<18} first answers on held-out falls work in {score.first:.1%} (predicted: {score.said:.1%});"
            f" Brier score {score.brier:.4f}"
        )
    console.print(f"{escape(str(directory))} answers by: {found.chosen}.")
    return 0


def export_the_library(
    directory: Path,
    *,
    out: Path | None,
    rate: float | None,
    as_json: bool,
) -> int:
    """Export a library for a robot.

    Args:
        directory: Directory of the library.
        out: Directory to write. None for one next to the library.
        rate: Rows per second [Hz]. None for the simulation's rate.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0.
    """
    place = out or directory.with_name(f"{directory.resolve().name}-robot")
    console = make_console(stderr=as_json)
    words = [] if rate is None else ["--rate", f"{rate:g}"]
    exported = export_library(
        Library.load(directory),
        place,
        rate=rate,
        command=shlex.join(["levade", "library", "export", str(directory), *words]),
        observe=lambda done, n: console.print(f"  {done} of {n} motions", style="dim"),
    )
    if as_json:
        motions = {str(number): list(map(str, paths)) for number, paths in exported.motions.items()}
        print(json.dumps({"directory": str(place), "motions": motions, "failed": list(map(str, exported.failed))}))
        return 0
    for path in exported.failed:
        console.print(f"[yellow]{escape(str(path))}: the motion does not work from there.[/]")
    console.print(f"{len(exported.motions)} motions are in {escape(str(place))}; it needs only Python and numpy:")
    console.print(f"  python {escape(str(place / 'ask.py'))} --robot my_robot:MyRobot")
    return 0


def show_library(directory: Path, *, figures: Path | None, format: str, report: bool, as_json: bool) -> int:
    """Describe a library.

    Args:
        directory: Directory of the library.
        figures: Directory for the figure. None draws none.
        format: Format of the figure: "pdf", "svg" or "png".
        report: Whether to write the library's page.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0.
    """
    library = Library.load(directory)
    console = make_console(stderr=as_json)
    written = [] if figures is None else draw(library, figures, format=format)
    page = [write_library(library, instead="write none: --no-report")] if report else []
    if as_json:
        print(json.dumps(_summary(library, directory, [*written, *page])))
        return 0
    _tell_library(console, library)
    for name in FACES:
        there = [face(record.up) == name for record in library.records]
        if any(there):
            works = (library.knowledge.success[there] == 1.0).any(axis=1).mean()
            n = sum(there)
            console.print(f"  lying on its {name}: {n} fall{'s' * (n != 1)}, {works:.1%} solved")
    for path in written:
        console.print(f"Written: {escape(str(path))}")
    for path in page:
        console.print(f"To open in a browser: {escape(str(path))}")
    return 0


def _summary(library: Library, directory: Path, written: Sequence[Path]) -> dict[str, Any]:
    """Return what ``build`` and ``show`` print as JSON."""
    certificates = {}
    if library.hardware:
        passed = [number for number, failed in library.certificates.items() if not failed]
        certificates = {
            "certificates": {"motions": len(library.certificates), "passed": passed, "failed": _failing(library)}
        }
    return {
        "library": str(directory),
        "done": sum(not record.rare for record in library.records),
        "rare": sum(record.rare for record in library.records),
        "methods": {name: sum(record.method == name for record in library.records) for name in _WORDS},
        "trials": sum(record.trials for record in library.records),
        "coverage": library.coverage,
        "rare_coverage": library.rare_coverage,
        "cover": [{"motion": number, "falls": works} for number, works in library.knowledge.cover()],
        **certificates,
        "written": [str(path) for path in written],
    }


def _failing(library: Library) -> dict[str, int]:
    """Return each demand of hardware that certificates fail, and how many fail it; the most frequent first."""
    return dict(Counter(name for failed in library.certificates.values() for name in failed).most_common())


def _tell_library(console: Console, library: Library) -> None:
    falls, cover = len(library.records), library.knowledge.cover()
    words = {**_WORDS, **(_WITHIN_LIMITS if library.hardware else {})}
    for name in _WORDS:
        n = sum(record.method == name for record in library.records)
        if n:
            console.print(f"{n} fall{'s' * (n != 1)} solved {words[name]}.")
    motions = sum(record.motion == record.fall for record in library.records)
    images = " and their mirror images" if library.knowledge.mirror else ""
    within = " within the limits" * library.hardware
    rare = sum(record.rare for record in library.records)
    added = f", and from {library.rare_coverage:.1%} of {_rare_ones(rare)}" if rare else ""
    console.print(
        f"{motions} motions{images} get up{within} from {library.coverage:.1%} of {falls - rare} falls{added}."
    )
    if cover:
        enough = ", ".join(f"{k + 1}: {works / falls:.1%}" for k, (_, works) in enumerate(cover[:6]))
        console.print(f"The best few of them: {enough}.")
    if library.certificates:
        _tell_certificates(console, library)


def _rare_ones(n: int) -> str:
    return f"{n} rare one{'s' * (n != 1)}"


def _tell_certificates(console: Console, library: Library) -> None:
    """Say how many certificates pass, which demands the others fail, and what binds the best few motions."""
    passed = sum(not failed for failed in library.certificates.values())
    failing = ", ".join(f"{name} ({n})" for name, n in _failing(library).items())
    others = f" The others fail {escape(failing)}." if failing else ""
    console.print(f"The certificates of {passed} of {len(library.certificates)} motions pass.{others}")
    for number, _ in library.knowledge.cover()[:6]:
        certificate = read_certificate(library.directory, number)
        share, binds = certificate["perturbed"]["share"], certificate.get("binding") or "no limit is known"
        said = f"succeeds on {share:.1%} of perturbed robots; {binds}"
        console.print(
            f"  {named_motion(Path(motion_path(library.directory, number).name), number)}: {escape(said)}", style="dim"
        )


def check_the_library(
    directory: Path, *, starts: int, seed: int, refine: str | None, threads: int, as_json: bool
) -> int:
    """Check a library.

    Args:
        directory: Directory of the library.
        starts: Number of falls to try.
        seed: Seed of these falls.
        refine: Time to improve each answer that does not work, such as "1s". None does not improve answers.
        threads: Number of engine threads (0: one per core).
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if all falls were tried, 1 if interrupted.
    """
    library, time_left = Library.load(directory), None if refine is None else refining_time(refine)
    console = make_console(stderr=as_json)
    with stop_between("part") as stopping:
        found = check_library(library, starts=starts, seed=seed, threads=threads, refine=time_left, stopping=stopping)
    if as_json:
        print(json.dumps(found.to_json()))
    else:
        for what, value in _told(found):
            console.print(f"{what:<52} {value}")
    return 1 if found.interrupted else 0


def _told(found: LibraryCheck) -> list[tuple[str, str]]:
    after = [(f"one of the {k} likeliest, tried in simulation", str(share)) for k, share in found.after.items()]
    lying = [(f"  lying on its {name}: {share.runs} falls", str(share)) for name, share in found.lying.items()]
    return [
        (f"{found.starts} falls of seed {found.seed}", ""),
        ("the first answer works", str(found.first)),
        *lying,
        *_told_of_hardware(found),
        *after,
        *([("the first answer, refined in simulation", str(found.refined))] if found.refined else []),
        ("within two attempts, the second from where it lies", str(found.twice)),
        ("the first answer, on perturbed models", str(found.perturbed)),
        ("within two attempts, on perturbed models", str(found.perturbed_twice)),
        ("mean probability predicted by the answers", f"{found.expected:.1%}"),
        ("an answer takes", f"{found.answer_ms[0]:.2f} ms, 99 % at most {found.answer_ms[1]:.2f} ms"),
    ]


def _told_of_hardware(found: LibraryCheck) -> list[tuple[str, str]]:
    if found.certified is None:
        return []
    missed = ", ".join(f"{name} {n}" for name, n in found.missed.items()) or "none"
    return [
        ("  works within the limits, with a certificate", str(found.certified)),
        ("  falls from which it misses a criterion or limit", missed),
    ]
