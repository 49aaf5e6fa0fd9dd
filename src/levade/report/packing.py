"""Pack arrays as text for a page: base64 of little-endian numbers, which keeps a motion small and exact.

    pack(points)                    # {"dtype": "f4", "shape": [75, 3], "data": "AACAPw..."}
    unpack(pack(points))            # the same, as float32

The page reads them with a typed array (`web/src/player-data.js`).
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

import numpy as np

from levade.arrays import Array

UNIT = 32767
"""The int16 that stands for 1 in `pack_unit`."""

_DTYPES = ("f4", "i2", "u2", "u4")


def pack(values: Any, dtype: str = "f4") -> dict[str, Any]:
    """Pack numbers for a page. Nothing is clipped, so numbers must fit the type.

    Args:
        values: Numbers of any shape.
        dtype: "f4", "i2", "u2" or "u4".

    Returns:
        Type, shape and data in base64.
    """
    values = np.asarray(values)
    assert dtype in _DTYPES
    data = np.ascontiguousarray(values, dtype=f"<{dtype}").tobytes()
    return {"dtype": dtype, "shape": list(values.shape), "data": base64.b64encode(data).decode("ascii")}


def pack_unit(values: Array) -> dict[str, Any]:
    """Pack numbers between -1 and 1, such as quaternions, to 1.6e-5.

    Args:
        values: Numbers of any shape.

    Returns:
        As `pack`.

    Raises:
        ValueError: If a number is outside.
    """
    if not (np.abs(values) <= 1.0 + 1e-9).all():
        raise ValueError("pack_unit takes numbers between -1 and 1")
    return pack(np.round(np.clip(values, -1.0, 1.0) * UNIT), "i2")


def unpack(packed: Mapping[str, Any]) -> Array:
    """Unpack numbers in their packed type. Those of `pack_unit` are multiples of 1 / `UNIT`, still as int16.

    Args:
        packed: Type, shape and data in base64, as `pack` returns them.

    Returns:
        The numbers, in their shape. The array is read-only.
    """
    data = base64.b64decode(packed["data"])
    return np.frombuffer(data, dtype=f"<{packed['dtype']}").reshape(packed["shape"])
