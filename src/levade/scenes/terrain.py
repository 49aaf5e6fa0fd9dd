"""Ground that is not flat: gaps, and height fields from numbers or an image."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from tokenize import TokenError

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError

MOST_HEIGHTS = 40_000
"""Largest number of heights in one field, because task files and motions contain all of them."""


@dataclass(frozen=True)
class Gap:
    """A ditch across the ground, from side to side.

    Attributes:
        x: Where it begins [m].
        width: Width along x [m].
        depth: Depth [m].
    """

    x: float
    width: float
    depth: float = 1.0

    def __post_init__(self) -> None:
        if not math.isfinite(self.x):
            raise LevadeError(f"gap.x: {self.x} should be a finite number, where the gap begins")
        for name, value in (("width", self.width), ("depth", self.depth)):
            if not (math.isfinite(value) and value > 0):
                raise LevadeError(f"gap.{name}: {value} m should be a positive length")


@dataclass(frozen=True)
class Terrain:
    """A height field on the ground.

    Attributes:
        heights: Rows of heights over z = 0 [m], 0 or more, seen from above with x to the right and y up. So the first row is
            farthest left for a robot that looks along x. At least 2 x 2, with rows of one length. The field is the surface
            through these points.
        size: Size along x and y [m], shape (2,).
        position: x and y of its centre [m], shape (2,).
    """

    heights: tuple[tuple[float, ...], ...]
    size: tuple[float, float]
    position: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        lengths = sorted({len(row) for row in self.heights})
        if len(self.heights) < 2 or len(lengths) != 1 or lengths[0] < 2:
            raise LevadeError("terrain.heights: should be 2 rows or more, all of one length, at least 2")
        if len(self.heights) * lengths[0] > MOST_HEIGHTS:
            raise LevadeError(
                f"terrain.heights: {len(self.heights)} x {lengths[0]} are too many; at most {MOST_HEIGHTS} in all, so"
                " make it coarser or smaller"
            )
        values = np.array(self.heights)
        if not (np.isfinite(values).all() and values.min() >= 0 and values.max() > values.min()):
            raise LevadeError(
                "terrain.heights: should be finite, 0 m or more, and not all the same; a hole is one of the scene's gaps"
            )
        if not all(math.isfinite(edge) and edge > 0 for edge in self.size):
            raise LevadeError(f"terrain.size: {list(self.size)} should be two positive lengths in m, along x and y")
        if not all(math.isfinite(value) for value in self.position):
            raise LevadeError(f"terrain.position: {list(self.position)} should be finite numbers")

    def height(self, x: Array, y: Array) -> Array:
        """Compute the highest point of the field's cell at each x, y; 0 outside the field.

        Args:
            x: Positions along x [m], any shape.
            y: Positions along y [m], the same shape.

        Returns:
            Heights over z = 0 [m], the same shape.
        """
        heights = np.array(self.heights)[::-1]  # now from the least y
        rows, columns = heights.shape
        column = (x - self.position[0] + self.size[0] / 2) / self.size[0] * (columns - 1)
        row = (y - self.position[1] + self.size[1] / 2) / self.size[1] * (rows - 1)
        inside = (column >= 0) & (column <= columns - 1) & (row >= 0) & (row <= rows - 1)
        i = np.clip(np.floor(row).astype(int), 0, rows - 2)
        j = np.clip(np.floor(column).astype(int), 0, columns - 2)
        corners = np.stack([heights[i + a, j + b] for a in (0, 1) for b in (0, 1)])
        return np.where(inside, corners.max(axis=0), 0.0)

    def add_to(self, spec: mujoco.MjSpec, name: str, material: str) -> mujoco.MjsGeom:
        """Add the field to the world as a geom. Its heights are part of the model's text.

        Args:
            spec: Robot and scene; it is changed.
            name: Name of the geom and of the height field.
            material: Name of the geom's material.

        Returns:
            The geom.
        """
        heights = np.array(self.heights)
        low, high = float(heights.min()), float(heights.max())
        spec.add_hfield(
            name=name,
            nrow=heights.shape[0],
            ncol=heights.shape[1],
            size=[self.size[0] / 2, self.size[1] / 2, high - low, low + 0.1],
            userdata=((heights - low) / (high - low))[::-1].ravel(),
        )
        kind = mujoco.mjtGeom.mjGEOM_HFIELD
        position = [*self.position, low]
        return spec.worldbody.add_geom(name=name, type=kind, hfieldname=name, pos=position, material=material)


def read_heights(path: Path, height: float | None = None) -> tuple[tuple[float, ...], ...]:
    """Read heights from a file: a 2-D array of metres in .npy, or a grey image, black 0 and white ``height`` [m].

    Colours count by their brightness; transparency is ignored.

    Args:
        path: The file.
        height: Height of white in an image [m].

    Returns:
        Rows of heights [m].

    Raises:
        LevadeError: If the file cannot be read.
    """
    if not path.is_file():
        raise LevadeError(f"{path}: no such file; give a .npy of heights in m, or an image")
    if path.suffix == ".npy":
        if height is not None:
            raise LevadeError(f"{path}: an array is in metres, so leave the height out; it is that of an image's white")
        try:
            stored = np.load(path, allow_pickle=False, mmap_mode="r")  # its size before its content
            _check_number(path, stored.shape)
            values = stored.astype(np.float64)
        except (ValueError, OSError, EOFError, TypeError, AttributeError, ArithmeticError, TokenError) as error:
            raise LevadeError(f"{path}: not an array of numbers ({error})") from None
    else:
        if height is None:
            raise LevadeError(f"{path}: say how high white is: height: 20 cm")
        values = _brightness(path) * height
    if values.ndim != 2:
        raise LevadeError(f"{path}: an array of shape {values.shape}; should be two-dimensional, rows of heights")
    return tuple(tuple(float(f"{value:.6g}") for value in row) for row in values)


def _check_number(path: Path, shape: tuple[int, ...]) -> None:
    if math.prod(shape) > MOST_HEIGHTS:
        size = " x ".join(map(str, shape))
        raise LevadeError(
            f"{path}: {size} heights are too many; at most {MOST_HEIGHTS} in all, so make it coarser or smaller"
        )


def _brightness(path: Path) -> Array:
    """Return the brightness of an image, 0 to 1, shape (rows, columns)."""
    try:
        from PIL import Image, UnidentifiedImageError
    except ImportError:
        raise LevadeError(f"{path}: reading images takes Pillow: pip install 'levade[video]'") from None
    try:
        with (
            warnings.catch_warnings(action="error", category=Image.DecompressionBombWarning),
            Image.open(path) as image,
        ):
            _check_number(path, image.size)
            deep = image.mode.startswith("I")  # 16 bits
            return np.asarray(image if deep else image.convert("L"), dtype=np.float64) / (65535.0 if deep else 255.0)
    except (
        UnidentifiedImageError,
        OSError,
        ValueError,
        SyntaxError,
        Image.DecompressionBombError,
        Image.DecompressionBombWarning,
    ):
        raise LevadeError(
            f"{path}: not an image that Pillow can read; give a .png, or a .npy of heights in m"
        ) from None
