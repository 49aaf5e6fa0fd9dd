"""Shares of a library's falls, by how the robot lies."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.library.records import Method, Record
from levade.rightability import found_motions
from levade.robots import Robot


def library(*falls: tuple[tuple[float, ...], Method]) -> Any:
    records = tuple(
        Record(i, np.array(up), np.zeros(12), method, None, 0, (), ()) for i, (up, method) in enumerate(falls)
    )
    return SimpleNamespace(records=records, directory=Path("falls"))


def test_falls_are_counted_by_what_the_robot_lies_on() -> None:
    up, down, left_up = (0.1, 0.0, 0.99), (0.0, 0.3, -0.95), (0.1, 0.99, 0.0)
    found = found_motions(
        library(
            (down, Method.COLD), (down, Method.NONE), (up, Method.KNOWN), (left_up, Method.NEAR), (down, Method.NEAR)
        )
    )
    assert {name: (one.falls, one.motions) for name, one in found.items() if one.falls} == {
        "back": (3, 2),
        "belly": (1, 1),
        "right": (1, 1),
        "all": (5, 4),
    }
    assert found["tail"].share is None
    assert found["all"].share == 0.8
    # Wilson's interval of 4 of 5, from his formula
    assert found["all"].interval == pytest.approx((0.3755, 0.9638), abs=1e-4)


@pytest.mark.slow
def test_a_library_of_another_robot_is_refused(packaged: Callable[[str], Robot]) -> None:
    other = packaged("g1")
    with pytest.raises(LevadeError, match=r"library: falls: its robot has 12 joints, g1 has \d+"):
        found_motions(library(((0.0, 0.0, 1.0), Method.COLD)), other)
