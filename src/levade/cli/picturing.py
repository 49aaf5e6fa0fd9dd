"""Draw the pictures of ``levade show``: figures, strip and video, of one motion or of several side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from levade.cli.tables import make_console
from levade.errors import LevadeError
from levade.motions import Motion


@dataclass(frozen=True)
class Pictures:
    """What the options ask to draw. None where an option was not given."""

    figures: Path | None = None
    format: str | None = None
    strip: Path | None = None
    poses: int | None = None
    video: Path | None = None
    slow: float | None = None
    camera: str | None = None

    def __post_init__(self) -> None:
        for name, value, of in (
            ("--format", self.format, {"--figures DIR": self.figures}),
            ("--poses", self.poses, {"--strip FILE": self.strip}),
            ("--slow", self.slow, {"--video FILE": self.video}),
            ("--camera", self.camera, {"--video FILE": self.video, "--strip FILE": self.strip}),
        ):
            if value is not None and all(wanted is None for wanted in of.values()):
                raise LevadeError(f"{name} {value}: draws nothing by itself; add {' or '.join(of)}")


def labels(paths: Sequence[Path]) -> list[str]:
    """Return a short name for each motion: that of its file, or of its directory if all files have the same name.

    Args:
        paths: Files of the motions.

    Returns:
        The names, in the same order. They are the paths if the short names are not unique.
    """
    stems = [path.stem for path in paths]
    if len(set(stems)) < len(stems):
        stems = [path.resolve().parent.name for path in paths]
    return stems if len(set(stems)) == len(stems) else [str(path) for path in paths]


def draw(motions: Mapping[Path, Motion], wanted: Pictures) -> list[Path]:
    """Draw the pictures that are wanted.

    Args:
        motions: File -> motion.
        wanted: What the options ask to draw.

    Returns:
        The files that were written.

    Raises:
        LevadeError: If a video of several motions is wanted.
    """
    several, names = len(motions) > 1, labels(list(motions))
    camera = _camera(wanted.camera)
    if wanted.video is not None and several:
        raise LevadeError(
            f"--video {wanted.video}: shows one motion, not {len(motions)}; use --strip or --figures to compare"
        )
    written: list[Path] = []
    if wanted.figures is not None:
        from levade.report.figures import compare, figures

        format = wanted.format or "pdf"
        progress = {path: found for path, motion in motions.items() if (found := progress_beside(path, motion))}
        if several:
            by_name = dict(zip(names, motions.values(), strict=True))
            of = {name: progress[path] for name, path in zip(names, motions, strict=True) if path in progress}
            written += compare(by_name, wanted.figures, format=format, progress_csv=of)
        else:
            ((path, motion),) = motions.items()
            written += figures(motion, wanted.figures, format=format, progress_csv=progress.get(path))
    if wanted.strip is not None:
        from levade.report.video import strip

        looks: dict[str, Any] = {} if camera is None else {"camera": camera}
        n = 6 if wanted.poses is None else wanted.poses
        with _bar(wanted.strip) as tick:
            shown = names if several else []
            written.append(strip(list(motions.values()), wanted.strip, n=n, labels=shown, progress=tick, **looks))
    if wanted.video is not None:
        from levade.report.video import video

        (motion,) = motions.values()
        slow = 8.0 if wanted.slow is None else wanted.slow
        with _bar(wanted.video) as tick:
            written.append(video(motion, wanted.video, slow=slow, camera=camera, progress=tick))
    return written


def progress_beside(path: Path, motion: Motion) -> Path | None:
    """Return progress.csv of the motion's search, if it is next to the motion and belongs to this search.

    Args:
        path: File of the motion.
        motion: The motion.

    Returns:
        Path of progress.csv, or None.
    """
    progress = path.parent / "progress.csv"
    try:
        last = progress.read_text(encoding="utf-8").splitlines()[-1].split(",")
        return progress if int(last[1]) == motion.result.trials else None
    except (OSError, ValueError, LookupError):
        return None


def _camera(text: str | None) -> Any:
    """Read AZ,EL or AZ,EL,DIST."""
    if text is None:
        return None
    from levade.report.rendering import Camera

    try:
        azimuth, elevation, *rest = (float(part) for part in text.split(","))
        (distance,) = rest or (None,)
    except ValueError:
        raise LevadeError(
            f"--camera {text}: should be AZIMUTH,ELEVATION in degrees, or with a distance in m, such as 118,-12,4"
        ) from None
    return Camera(azimuth, elevation, distance)


@contextmanager
def _bar(path: Path) -> Any:
    """Show a progress bar on standard error while drawing, if that is a terminal."""
    console = make_console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task(f"drawing {path.name}", total=None)
        tick: Callable[[int, int], object] = lambda done, total: progress.update(task, completed=done, total=total)  # noqa: E731
        yield tick
