"""Write progress.csv: a line per generation."""

from __future__ import annotations

import csv
from contextlib import suppress
from pathlib import Path

import numpy as np

from levade.search.outcome import Generation
from levade.tasks import Task
from levade.writing import growing

PROGRESS = "progress.csv"


class Progress:
    """Writes progress.csv; a context manager.

    Args:
        task: The task, whose costs and criteria become columns.
        directory: Directory of the run.

    Raises:
        OSError: If the file cannot be written.
    """

    def __init__(self, task: Task, directory: Path) -> None:
        self._terms, self._criteria = list(task.costs), list(task.success)
        self._file = growing(directory / PROGRESS)
        self._table = csv.writer(self._file)
        self._table.writerow(
            [
                *("generation", "trials", "stage", "cost_best", "cost_generation_best", "cost_generation_median"),
                *("cost_generation_worst", "step", "diverged", "success"),
                *(f"term_{name}" for name in self._terms),
                *(f"error_{name}" for name in self._criteria),
            ]
        )

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(OSError):
            self._file.close()

    def write(self, g: Generation) -> None:
        """Add a line: costs of the generation by its stage's weights, and the best trial so far by the task's own weights.

        Args:
            g: The generation.

        Raises:
            OSError: If the file cannot be written.
        """
        numbers = [g.best.cost, g.cost.min(), np.median(g.cost), g.cost.max(), g.step]
        own = [*(g.best.terms[name] for name in self._terms), *(g.best.errors[name] for name in self._criteria)]
        self._table.writerow(
            [
                *(g.generation, g.trials, g.stage_name),
                *(f"{number:.9g}" for number in numbers),
                *(g.diverged, int(g.best.success)),
                *("" if np.isnan(number) else f"{number:.9g}" for number in own),
            ]
        )
        self._file.flush()
