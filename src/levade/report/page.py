"""Write report.html: a motion on one offline page, with a 3D player, plots that follow it, and its provenance.

    path = write_page(motion, "rearing/report.html", progress_csv="rearing/progress.csv", source="motion.npz")

The page's script and style are `web/` of the repository, bundled into `src/levade/report/web/`. Its colours are those of
`levade.report.style`. The same motion gives the same bytes.
"""

from __future__ import annotations

import html
import json
import math
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from levade.errors import LevadeError
from levade.motions import Motion
from levade.report.files import writing
from levade.report.scene import scene_data
from levade.report.series import read_progress, series_data
from levade.report.style import stylesheet
from levade.report.summary import provenance_data, summary_data
from levade.version import __version__
from levade.writing import check_replaceable

_MARK = '<meta name="generator" content="levade'
"""Identifies a page of levade."""

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
{mark} {version}">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<noscript><p>{title}. This page draws itself with JavaScript, which is off.</p></noscript>
<script type="application/json" id="levade-data">{data}</script>
<script>{script}</script>
</body>
</html>
"""


def write_page(
    motion: Motion,
    path: str | Path,
    *,
    progress_csv: str | Path | None = None,
    source: str | None = None,
    certificate: Mapping[str, str] | None = None,
    instead: str = "give another path",
) -> Path:
    """Write a motion's page.

    Args:
        motion: The motion.
        path: File to write.
        progress_csv: Progress of the motion's search. Without it there is no plot of the cost.
        source: Name of the motion's file on the page.
        certificate: The motion's certificate: `page`, relative to this one, and `says`, its verdict.
        instead: What else the user could do, for the message of an error.

    Returns:
        The file.

    Raises:
        LevadeError: If the file cannot be written, or exists and is not a page of levade.
    """
    check_page(Path(path), instead=instead)
    text = page(motion, progress_csv=progress_csv, source=source, certificate=certificate)
    return save_page(text, path, instead=instead)


def save_page(text: str, path: str | Path, *, instead: str) -> Path:
    """Write a page, or leave the existing file unchanged.

    Args:
        text: The page.
        path: File to write.
        instead: What else the user could do, for the message of an error.

    Returns:
        The file.

    Raises:
        LevadeError: As `write_page`.
    """
    path = Path(path)
    check_page(path, instead=instead)
    with writing(path, instead=instead) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")
    return path


def page(
    motion: Motion,
    *,
    progress_csv: str | Path | None = None,
    source: str | None = None,
    certificate: Mapping[str, str] | None = None,
) -> str:
    """Return the page as text: see `write_page`.

    Args:
        motion: The motion.
        progress_csv: Progress of the motion's search. Without it there is no plot of the cost.
        source: Name of the motion's file on the page.
        certificate: The motion's certificate: `page`, relative to this one, and `says`, its verdict.

    Returns:
        The page, as HTML.
    """
    progress = None if progress_csv is None else read_progress(progress_csv)
    provenance = provenance_data(motion) | {
        "written_by": f"levade {__version__}",
        "motion": source,
        "certificate": None if certificate is None else dict(certificate),
    }
    data = {
        "summary": summary_data(motion),
        "series": series_data(motion, progress),
        "scene": scene_data(motion),
        "provenance": provenance,
    }
    return assembled(f"{provenance['task']} on {provenance['robot']}, seed {provenance['seed']}", data, "report")


def assembled(title: str, data: Any, entry: Literal["report", "certificate", "library", "live"]) -> str:
    """Build a self-contained page.

    Args:
        title: The page's title.
        data: Input of the script, JSON.
        entry: The function of web/src/levade.js that the page calls. Served pages ("live") have one more style sheet.

    Returns:
        The page as HTML.
    """
    style = stylesheet() + _bundled("style.css") + (_bundled("live.css") if entry == "live" else "")
    script = f"{_bundled('levade.js')}levade.{entry}();"
    return _PAGE.format(
        mark=_MARK,
        version=__version__,
        title=html.escape(title),
        style=style.replace("</style", "<\\/style"),
        data=_json(data),
        script=script.replace("</script", "<\\/script").replace("<!--", "<\\!--"),
    )


def _json(data: Any) -> str:
    """Return JSON for a script element: nothing in it ends the element or begins a comment."""
    return json.dumps(_sound(data), ensure_ascii=False, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _sound(data: Any) -> Any:
    """Replace infinity and NaN, which JSON lacks, by null."""
    if isinstance(data, dict):
        return {key: _sound(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_sound(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def _bundled(name: str) -> str:
    return (files("levade.report") / "web" / name).read_text(encoding="utf-8")


def check_page(path: Path, *, instead: str) -> None:
    """Check that a path is free or holds a page of levade. Errors of reading are left to the writing.

    Args:
        path: The path.
        instead: What else the user could do, for the message.

    Raises:
        LevadeError: If it holds anything else.
    """
    try:
        check_replaceable(path)  # opening a pipe would wait for its other end
        with path.open("rb") as file:
            ours = _MARK.encode() in file.read(2000)
    except OSError:
        return
    if not ours:
        raise LevadeError(f"{path}: is no report of levade's and would be replaced; move it away, or {instead}")
