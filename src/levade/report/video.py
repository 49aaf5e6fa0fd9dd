"""Moving and still pictures of a motion, drawn off screen (`levade.report.rendering`).

    video(motion, "rearing.mp4")                               # slow motion up to the horizon, then a still
    video(motion, "rearing.gif", slow=10, camera=Camera(90, -5))
    strip(motion, "rearing.png", n=6)

MP4 goes through imageio-ffmpeg, which brings its own ffmpeg (`pip install 'levade[video]'`); the others need pillow.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.motions import Motion
from levade.report.files import writing
from levade.report.rendering import Camera, Image, Poses, Renderer, View, outline, replay
from levade.report.style import LIGHT

Progress = Callable[[int, int], object]
"""Called with the pictures drawn so far, and how many there will be."""

FORMATS = (".mp4", ".gif", ".webp")

_STILL = 0.8
"""[s], how long the last picture stays."""


def video(
    motion: Motion,
    path: str | Path,
    *,
    slow: float = 8.0,
    fps: int | None = None,
    size: tuple[int, int] | None = None,
    camera: Camera | None = None,
    progress: Progress | None = None,
) -> Path:
    """Write a motion as .mp4, .gif or .webp; the last two loop for ever.

    Args:
        motion: A motion.
        path: File to write; its ending says which kind.
        slow: How many times slower than it was the motion runs up to the horizon. The hold always runs at true speed.
        fps: Pictures per second. Defaults to 30, or 20 for .gif and .webp.
        size: Width and height [pixels]. Defaults to (960, 720), or (480, 360) for .gif and .webp.
        camera: Where to look from.
        progress: Called after each picture with the number of those done and of all.

    Returns:
        The path.

    Raises:
        LevadeError: If any of these is impossible, the file cannot be written, or OpenGL or a library is missing.
    """
    path = Path(path)
    kind = path.suffix.lower()
    if kind not in FORMATS:
        hint = did_you_mean(kind, FORMATS) if kind else "give one that ends in .mp4, .gif or .webp"
        raise LevadeError(f"{path}: unknown kind of video; {hint}")
    moving = kind == ".mp4"
    fps = fps or (30 if moving else 20)
    width, height = size or ((960, 720) if moving else (480, 360))
    if not (math.isfinite(slow) and 0.01 <= slow <= 1000):
        raise LevadeError(f"slow {slow:g}: should be between 0.01 and 1000; 1 is true speed, 8 eight times slower")
    if not 1 <= fps <= 240:
        raise LevadeError(f"fps {fps}: should be between 1 and 240")
    if not (16 <= width <= 7680 and 16 <= height <= 4320 and (width % 2 == height % 2 == 0 or not moving)):
        raise LevadeError(f"size {width}x{height}: should be even numbers from 16 to 7680 and 4320")
    ffmpeg = _ffmpeg() if moving else None
    pillow = load_pillow()
    with writing(path) as partial:
        poses = replay(motion)
        times = frame_times(motion, slow=slow, fps=fps)
        images = _frames(motion, poses, times, (width, height), camera or Camera(), slow, pillow, progress)
        still = round(_STILL * fps)
        if ffmpeg is not None:
            _write_mp4(ffmpeg, partial, images, (width, height), fps, still)
        else:
            _write_loop(pillow, partial, kind, images, fps, still)
    return path


def strip(
    motion: Motion | Sequence[Motion],
    path: str | Path,
    *,
    n: int = 6,
    labels: Sequence[str] = (),
    height: int = 360,
    camera: Camera | None = None,
    progress: Progress | None = None,
) -> Path:
    """Write n poses side by side as .png, evenly spaced over the horizon; with a hold, the last one is its end.

    Several motions are put one below the other, all to the same scale.

    Args:
        motion: A motion, or several.
        path: File to write, a .png.
        n: Poses of each motion.
        labels: Names of the motions.
        height: Height of a pose [pixels].
        camera: Where to look from.
        progress: As `video` takes it.

    Raises:
        LevadeError: As `video` does.
    """
    path = Path(path)
    motions = [motion] if isinstance(motion, Motion) else list(motion)
    if path.suffix.lower() != ".png":
        raise LevadeError(f"{path}: a strip is a .png; give {path.with_suffix('.png').name}")
    if not 1 <= n <= 60:
        raise LevadeError(f"poses {n}: should be between 1 and 60")
    if not 32 <= height <= 4320:
        raise LevadeError(f"height {height}: should be between 32 and 4320 pixels")
    pillow, camera = load_pillow(), camera or Camera(elevation=-8.0)
    with writing(path) as partial:
        replays = [replay(each) for each in motions]
        clouds = [outline(poses.model, _sample(poses)) for poses in replays]
        extents = [np.ptp(camera.axes()[:2] @ points.T, axis=1) for points in clouds]
        across, up = np.max(extents, axis=0)
        aspect = float(np.clip(across / up, 0.4, 3.0))
        width = round(height * aspect)
        views = [camera.frame(points, aspect=aspect) for points in clouds]
        distance = max(view.distance for view in views)
        rows, done = [], 0
        for number, (each, poses, view) in enumerate(zip(motions, replays, views, strict=True)):
            images = []
            view = View(view.lookat, distance, view.azimuth, view.elevation)
            with Renderer(each, (2 * width, 2 * height), shadows=7) as renderer:  # twice the size, then averaged down
                for time in strip_times(each, n):
                    drawn = pillow.Image.fromarray(renderer.image(poses.at(time), _follow(camera, view, each, time)))
                    images.append((time, drawn.resize((width, height), pillow.Image.Resampling.BOX)))
                    done += 1
                    if progress is not None:
                        progress(done, n * len(motions))
            rows.append(_strip_row(pillow, images, labels[number] if number < len(labels) else ""))
        page = pillow.Image.new("RGB", (rows[0].width, sum(row.height for row in rows)), LIGHT.panel)
        top = 0
        for row in rows:
            page.paste(row, (0, top))
            top += row.height
        # 256 colours hold a strip without visible loss, at a third of the size
        page.quantize(256, method=pillow.Image.Quantize.MEDIANCUT, dither=pillow.Image.Dither.NONE).save(
            partial, format="PNG", optimize=True
        )
    return path


def frame_times(motion: Motion, *, slow: float, fps: int) -> list[float]:
    """Return the time in the motion of each picture: slowed down to the horizon, at true speed in the hold.

    Args:
        motion: The motion.
        slow: How many times slower than real time the motion runs up to the horizon.
        fps: Pictures per second [Hz].

    Returns:
        Times from 0 to the end of the motion [s].
    """
    horizon, end = motion.horizon, motion.duration
    moving = max(1, round(horizon * slow * fps))
    held = round((end - horizon) * fps)
    return [horizon * k / moving for k in range(moving + 1)] + [
        horizon + (end - horizon) * k / held for k in range(1, held + 1)
    ]


def strip_times(motion: Motion, n: int) -> list[float]:
    """Return the times of the poses of a strip.

    Args:
        motion: The motion.
        n: Number of poses.

    Returns:
        Times [s], evenly spaced up to the horizon. The last pose is the end of the hold if there are at least three.
    """
    horizon, end = motion.horizon, motion.duration
    held = [end] if end - horizon > 1e-9 and n > 2 else []
    moving = n - len(held)
    return [horizon * k / (moving - 1) for k in range(moving)] + held if moving > 1 else [horizon]


def _frames(
    motion: Motion,
    poses: Poses,
    times: Sequence[float],
    size: tuple[int, int],
    camera: Camera,
    slow: float,
    pillow: Any,
    progress: Progress | None,
) -> Iterator[Image]:
    points = outline(poses.model, _sample(poses))
    if camera.track and camera.distance is None:  # near enough for the robot, wherever it goes
        shift = np.repeat(
            _trunk(motion, _sample_rows(poses)) - _trunk(motion, np.array([0])),
            len(points) // len(_sample(poses)),
            axis=0,
        )
        points = points - shift
    view = camera.frame(points, aspect=size[0] / size[1])
    horizon = motion.horizon
    with Renderer(motion, size, shadows=4) as renderer:
        for number, time in enumerate(times, start=1):
            image = renderer.image(poses.at(time), _follow(camera, view, motion, time))
            speed = slow if time <= horizon + 1e-9 else 1.0
            yield _stamped(pillow, image, time, speed)
            if progress is not None:
                progress(number, len(times))


def _sample_rows(poses: Poses) -> Any:
    """Rows that show all of the way, a hundred at most, the last one among them."""
    return np.unique(np.linspace(0, len(poses.time) - 1, min(100, len(poses.time))).round().astype(int))


def _sample(poses: Poses) -> Any:
    return poses.qpos[_sample_rows(poses)]


def _trunk(motion: Motion, rows: Any) -> Any:
    """(rows, 3) [m], the trunk's centre of mass at rows of a replay, which has one more than the file."""
    return motion["trunk_com_position"][np.maximum(np.asarray(rows) - 1, 0)]


def _follow(camera: Camera, view: View, motion: Motion, time: float) -> View:
    if not camera.track:
        return view
    com = motion["trunk_com_position"]
    now = np.array([np.interp(time, motion["time"], com[:, axis]) for axis in range(3)])
    return View(view.lookat + now - com[0], view.distance, view.azimuth, view.elevation)


def _write_mp4(ffmpeg: Any, path: Path, images: Iterator[Image], size: tuple[int, int], fps: int, still: int) -> None:
    writer = ffmpeg.write_frames(
        str(path),
        size,
        fps=fps,
        codec="libx264",
        pix_fmt_out="yuv420p",
        macro_block_size=2,
        ffmpeg_log_level="error",
        output_params=[
            "-f",
            "mp4",
            "-crf",
            "18",
            "-preset",
            "medium",
            "-movflags",
            "+faststart",
            "-fflags",
            "+bitexact",
        ],
    )
    writer.send(None)
    image = None
    try:
        for image in images:
            writer.send(image)
        for _ in range(still):
            writer.send(image)
    except OSError as error:
        raise LevadeError(f"{path}: ffmpeg stopped: {' '.join(str(error).split())[:200]}") from None
    finally:
        writer.close()


def _write_loop(pillow: Any, path: Path, kind: str, images: Iterator[Image], fps: int, still: int) -> None:
    pictures = [pillow.Image.fromarray(image) for image in images]
    # both formats count in whole hundredths or thousandths of a second: rounded so that no error adds up
    unit = 10 if kind == ".gif" else 1
    ends = [round(1000 / unit * (k + 1) / fps) * unit for k in range(len(pictures))]
    durations = np.diff([0, *ends]).tolist()
    durations[-1] += round(1000 / unit * still / fps) * unit
    if kind == ".webp":
        pictures[0].save(
            path,
            format="WEBP",
            save_all=True,
            append_images=pictures[1:],
            duration=durations,
            loop=0,
            quality=80,
            method=4,
        )
        return
    # one palette for all pictures, from a few of them, and no dither: what stands still does not flicker
    few = pictures[:: max(1, len(pictures) // 8)]
    sheet = pillow.Image.new("RGB", (few[0].width, few[0].height * len(few)))
    for number, picture in enumerate(few):
        sheet.paste(picture, (0, number * picture.height))
    palette = sheet.quantize(128, method=pillow.Image.Quantize.MEDIANCUT)
    reduced = [picture.quantize(palette=palette, dither=pillow.Image.Dither.NONE) for picture in pictures]
    reduced[0].save(
        path, format="GIF", save_all=True, append_images=reduced[1:], duration=durations, loop=0, optimize=True
    )


def _stamped(pillow: Any, image: Image, time: float, slow: float) -> Image:
    """The picture with time and speed in its corner."""
    height = len(image)
    picture = pillow.Image.fromarray(image)
    draw = pillow.ImageDraw.Draw(picture)
    size = max(11, round(height / 30))
    font = pillow.ImageFont.load_default(size)
    speed = "" if slow == 1 else f"   1/{slow:g} speed" if slow > 1 else f"   {1 / slow:g}\u00d7 speed"
    draw.text((size, height - 2 * size), f"{time:.3f} s{speed}", fill=LIGHT.muted, font=font)
    return np.asarray(picture)


def _strip_row(pillow: Any, images: Sequence[tuple[float, Any]], label: str) -> Any:
    """Pictures side by side, each with its time below."""
    width, height = images[0][1].size
    gap, size = max(2, height // 90), max(11, round(height / 15))
    head, foot = (round(1.9 * size) if label else 0), round(1.9 * size)
    row = pillow.Image.new("RGB", (len(images) * (width + gap) - gap, head + height + foot), LIGHT.panel)
    draw, font = pillow.ImageDraw.Draw(row), pillow.ImageFont.load_default(size)
    if label:
        draw.text((0, head / 2), label, fill=LIGHT.ink, font=font, anchor="lm")
    digits = 2 if all(abs(time * 100 - round(time * 100)) < 1e-6 for time, _ in images) else 3
    for number, (time, image) in enumerate(images):
        left = number * (width + gap)
        row.paste(image, (left, head))
        text = f"{time:.{digits}f} s"
        draw.text((left + width / 2, head + height + foot / 2), text, fill=LIGHT.ink, font=font, anchor="mm")
    return row


def load_pillow() -> Any:
    """The parts of pillow that pictures need.

    Raises:
        LevadeError: If it is not installed.
    """
    try:
        from PIL import Image, ImageDraw, ImageFont
    except ImportError:
        raise LevadeError("pictures need pillow; pip install 'levade[video]'") from None
    pillow = ModuleType("pillow")
    pillow.__dict__.update(Image=Image, ImageDraw=ImageDraw, ImageFont=ImageFont)
    return pillow


def _ffmpeg() -> Any:
    try:
        import imageio_ffmpeg
    except ImportError:
        raise LevadeError("an mp4 needs imageio-ffmpeg; pip install 'levade[video]', or write a .gif") from None
    return imageio_ffmpeg
