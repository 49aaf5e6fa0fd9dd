"""Pursuits that are short: what is tried with them depends neither on how good a motion is, nor on why."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from levade.hardware import Plan, starts
from levade.tasks import Task


def shorten(patch: pytest.MonkeyPatch) -> None:
    """Searches go on for 48 trials after a success, not 240, and rough starts are the best of 24 motions.

    Certificates have 2 runs with each parameter alone.
    """
    within_limits = Plan.within_limits

    def shorter(self: Plan, number: int = 0) -> Task:
        task = within_limits(self, number)
        return replace(task, search=replace(task.search, polish=48))

    patch.setattr(Plan, "within_limits", shorter)
    patch.setattr(starts, "ROUGH", 24)
    patch.setattr(sys.modules["levade.checks.perturbed"], "_CORNERS", 2)  # the package has a function of that name
