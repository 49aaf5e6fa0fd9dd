"""Write a figure of the docs as a small PNG."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any


def save(draw: Callable[[], Any], path: Path) -> None:
    """Draw a figure, and write it with few colours, which takes a third of the bytes."""
    from PIL import Image

    from levade.report.figures import write_figures

    with tempfile.TemporaryDirectory() as directory:
        (drawn,) = write_figures({path.stem: draw}, Path(directory), "png")
        few = Image.open(drawn).convert("RGB").quantize(64, dither=Image.Dither.NONE)
        few.save(path, optimize=True)
