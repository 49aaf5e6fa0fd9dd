"""Order of a search: stages, attempts, and rounds of motions from which the robust stages start.

    schedule = Schedule(task)
    schedule.stage, schedule.level                  # stage of the next generation, and how to simulate it
    move = schedule.after(Report(spent=23, ...))    # what follows; the schedule has already entered it

A schedule knows no robot, no optimizer and no simulation: it counts trials. The moves:

    GO_ON             the same stage goes on
    NEXT_STAGE        the stage has ended, because its trials are used up or a trial was promoted
    RESTART           begin with the first stage and other random numbers: no success for too long, or a motion to start
                      from was found and more are wanted
    FROM_BEST_START   the robust stages begin, around the best of the motions to start from
    NEW_ROUND         the robust stages used up their trials without success: look for the same number of motions again
    STOP              a success has been polished for as long as the task says
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from levade.search.evaluation import Evaluation
from levade.tasks import Stage, Task

_ENOUGH = 0.1
"""Share by which the lowest cost of an attempt has to decrease within `Search.patience`."""


class Move(StrEnum):
    """The step that follows a generation."""

    GO_ON = "go on"
    NEXT_STAGE = "next stage"
    RESTART = "restart"
    FROM_BEST_START = "from best start"
    NEW_ROUND = "new round"
    STOP = "stop"


@dataclass(frozen=True)
class Level:
    """The way in which trials are simulated.

    Attributes:
        hold_steps: Number of steps of the hold.
        robust: Whether to simulate perturbed models, too.
    """

    hold_steps: int
    robust: bool


@dataclass(frozen=True)
class Report:
    """What a schedule needs to know about a generation.

    Attributes:
        spent: Roll-outs of the generation.
        trials: Roll-outs of the whole search so far, including these.
        trials_to_success: Trials at the first success. None while there is none.
        promoted: Whether a trial is within the tolerances that end the stage.
        found_start: Whether it ended the nominal stages with one of several motions to start from.
        cost: Lowest cost of its trials.
    """

    spent: int
    trials: int
    trials_to_success: int | None = None
    promoted: bool = False
    found_start: bool = False
    cost: float = np.inf


class Schedule:
    """Keeps track of where a search is in its order of stages.

    Args:
        task: The task, which names the stages.
    """

    def __init__(self, task: Task) -> None:
        self._task = task
        self._number = 0
        self._stage_trials = 0
        self._attempt_trials = 0
        self._rounds = 1
        self._starts = 0
        self._lowest: list[tuple[int, float]] = []  # trials of the stage, and the lowest cost up to then
        self.attempt = 0

    @property
    def number(self) -> int:
        """The number of the current stage, from 0."""
        return self._number

    @property
    def stage(self) -> Stage:
        """The current stage."""
        return self._task.stages[self._number]

    @property
    def level(self) -> Level:
        """The way in which the current stage simulates."""
        return level_of(self._task, self.stage)

    @property
    def wanted_starts(self) -> int:
        """The number of nominal motions to find before the robust stages begin; 1 if the stages simply follow."""
        return 1 if self._task.robust is None else self._task.robust.starts

    def ends(self, *, promoted: bool, spent: int = 0) -> bool:
        """Decide whether the current stage ends.

        Args:
            promoted: Whether a trial is within the tolerances that end the stage.
            spent: Trials that are not counted yet.
        """
        stage = self.stage
        if stage.trials is not None and self._stage_trials + spent >= stage.trials:
            return True
        return promoted

    def finds_start(self, *, promoted: bool, spent: int) -> bool:
        """Decide whether a generation ends the nominal stages of a search that starts the robust ones from several motions.

        Args:
            promoted: Whether a trial is within the tolerances that end the stage.
            spent: Trials of the generation.
        """
        if self.wanted_starts == 1 or self.level.robust or self._number + 1 != self._first_robust:
            return False
        return self.ends(promoted=promoted, spent=spent)

    def after(self, report: Report) -> Move:
        """Count a generation, decide what follows, and enter it.

        Args:
            report: What happened in the generation.

        Returns:
            The move.
        """
        self._stage_trials += report.spent
        self._attempt_trials += report.spent
        self._starts += report.found_start
        before = self._lowest[-1][1] if self._lowest else np.inf
        self._lowest.append((self._stage_trials, min(before, report.cost)))
        if self._polished(report):
            return Move.STOP
        if report.found_start or self._hopeless(report):
            if self._starts and self.attempt + 1 >= self.wanted_starts * self._rounds:
                return self._enter(self._first_robust, Move.FROM_BEST_START)
            return self._restart(Move.RESTART)
        if self._in_vain(report):
            self._rounds += 1
            self._starts = max(self._starts - 1, 0)
            return self._restart(Move.NEW_ROUND)
        if self._number + 1 < len(self._task.stages) and self.ends(promoted=report.promoted):
            return self._enter(self._number + 1, Move.NEXT_STAGE)
        return Move.GO_ON

    @property
    def _first_robust(self) -> int:
        return next(i for i, stage in enumerate(self._task.stages) if stage.robust)

    def _enter(self, number: int, move: Move) -> Move:
        self._number, self._stage_trials, self._lowest = number, 0, []
        return move

    def _restart(self, move: Move) -> Move:
        self.attempt, self._attempt_trials = self.attempt + 1, 0
        return self._enter(0, move)

    def _polished(self, report: Report) -> bool:
        polish = self._task.search.polish
        if report.trials_to_success is None or polish is None:
            return False
        return report.trials - report.trials_to_success >= polish

    def _hopeless(self, report: Report) -> bool:
        """Whether the search should restart, because it went on too long without a success.

        A search that has reached perturbed models already has a motion of the nominal model, so it goes on from there.
        """
        restart = self._task.search.restart
        if restart is None or report.trials_to_success is not None or self.level.robust:
            return False
        return self._attempt_trials >= restart and not self._improves

    @property
    def _improves(self) -> bool:
        """Whether the stage's lowest cost recently decreased enough for the attempt to go on."""
        patience = self._task.search.patience
        if patience is None:
            return False
        before = [lowest for trials, lowest in self._lowest if trials <= self._stage_trials - patience]
        fallen = before[-1] - self._lowest[-1][1] if before else np.inf
        return bool(fallen > 0 and (not before or fallen >= _ENOUGH * abs(before[-1])))

    def _in_vain(self, report: Report) -> bool:
        """Whether a multi-start search should begin another round.

        It should if the last stage used up its trials without success, and enough budget remains for a round as long.
        """
        stage, budget = self.stage, self._task.search.trials
        if self.wanted_starts == 1 or self._number + 1 < len(self._task.stages) or stage.trials is None:
            return False
        spent = report.trials_to_success is None and self._stage_trials >= stage.trials
        return spent and budget - report.trials >= report.trials / self._rounds


def level_of(task: Task, stage: Stage) -> Level:
    """Return how a stage of a task simulates.

    Args:
        task: The task.
        stage: The stage.
    """
    share = stage.hold * task.hold_steps if isinstance(stage.hold, bool) else stage.hold / task.physics.timestep
    return Level(min(round(share), task.hold_steps), task.robust is not None and stage.robust)


def full_level(task: Task) -> Level:
    """Return how a motion is judged in the end: through the whole hold, and on perturbed models if the task has them.

    Args:
        task: The task.
    """
    return Level(task.hold_steps, task.robust is not None)


def promoted(stage: Stage, evaluation: Evaluation) -> NDArray[np.bool_]:
    """Find the trials that are within the tolerances that end a stage.

    Args:
        stage: The stage.
        evaluation: Results of n trials.

    Returns:
        Which trials are within them, shape (n,). None of them if the stage names no tolerance.
    """
    within = ~evaluation.diverged if stage.promote else np.zeros(len(evaluation.success), dtype=bool)
    for name, tolerance in stage.promote.items():
        within = within & (np.abs(evaluation.errors[name]) <= tolerance)  # NaN, if not simulated, is never within
    return within


def first_to_end(stage: Stage, cost: NDArray[np.floating], evaluation: Evaluation) -> int:
    """Find the cheapest of the trials that end a stage, or of all trials if the stage ended for another reason.

    Args:
        stage: The stage.
        cost: Costs of n trials, shape (n,).
        evaluation: Their results.

    Returns:
        Row of the trial.
    """
    within = promoted(stage, evaluation)
    return int(np.argmin(np.where(within, cost, np.inf) if within.any() else cost))
