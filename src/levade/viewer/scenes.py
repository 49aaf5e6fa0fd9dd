"""Scenes for the 3D player of a served page."""

from __future__ import annotations

from typing import Any

from levade.motions import Motion
from levade.report.scene import scene_data
from levade.search import Objective

_RATE = 100.0
"""Poses per second of motions that a better one will soon replace [Hz]."""


class LiveScenes:
    """Makes scenes of motions of one objective, with shapes and colours that are made once."""

    def __init__(self, objective: Objective) -> None:
        self._model = objective.engine.model
        self._like: dict[str, Any] | None = None

    def __call__(self, motion: Motion) -> dict[str, Any]:
        """Return the scene of a motion, like `levade.report.scene.scene_data`."""
        scene = scene_data(motion, like=self._like, model=self._model, rate=_RATE)
        self._like = self._like or scene
        return scene
