"""Try a library on falls that it has never seen, on the nominal model and on perturbed models.

found = check_library(Library.load(Path("falls")), starts=200, seed=1)
found.first, found.after[3], found.perturbed, found.twice
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from levade.arrays import Array
from levade.checks.statistics import wilson
from levade.engines import Models, MujocoEngine, Perturbation, State
from levade.errors import LevadeError
from levade.exports.asker import without_repeats
from levade.library.asking import Answer, Library
from levade.library.falls import FACES, Falls, face
from levade.library.plays import Play, Plays, judged_on_others, others, posed, tried, tried_on_others
from levade.library.refining import refined
from levade.library.storing import read_falls, read_library
from levade.robots import Robot
from levade.search.evaluation import Evaluation, Mask
from levade.search.objective import Objective

AFTER = (2, 3, 5)
"""Numbers k for which the check counts whether one of the k likeliest motions works in simulation from that state."""

_AT_ONCE = 32
"""Number of falls in one batch."""


@dataclass(frozen=True)
class Share:
    """Holds a share of successes and its 95 % confidence interval (Wilson).

    Attributes:
        successes: Number of successes.
        runs: Number of runs.
    """

    successes: int
    runs: int

    @property
    def share(self) -> float:
        """Successes divided by runs; 0 without runs."""
        return self.successes / self.runs if self.runs else 0.0

    @property
    def low(self) -> float:
        """Lower end of the confidence interval."""
        return wilson(self.successes, self.runs)[0]

    @property
    def high(self) -> float:
        """Upper end of the confidence interval."""
        return wilson(self.successes, self.runs)[1]

    def __str__(self) -> str:
        return f"{self.share:.1%} ({self.low:.1%} to {self.high:.1%})"

    def to_json(self) -> dict[str, float | int]:
        """Convert the share to plain numbers."""
        return {"share": self.share, "low": self.low, "high": self.high, "successes": self.successes, "runs": self.runs}


@dataclass(frozen=True, eq=False)
class LibraryCheck:
    """Reports how well a library does on falls that it has never seen.

    Attributes:
        starts: Number of falls that were tried.
        seed: Seed of these falls.
        first: How often the first answer works on the nominal model.
        after: Number k -> how often one of the k likeliest motions works.
        refined: How often the first answer works on the model after refinement. None without refinement.
        twice: How often the first answer works, or a second answer works from where the first one left the robot.
        perturbed_twice: The same on perturbed models.
        lying: What the robot lies on (`levade.library.falls.FACES`) -> how often the first answer works from there.
        perturbed: How often the first answer works on a perturbed model, which is another one for each fall.
        expected: Mean probability that the first answers predict. Calibrated probabilities lie between `first` and
            `perturbed`, since the library's own falls are tried on both.
        answer_ms: Median and 99th percentile of the time of an answer [ms], without a simulator.
        failed: Indices of the falls from which the first answer did not work.
        certified: How often the first answer works and has a certificate that passes. None in a library that demands nothing
            of hardware. Motions of one that does work only if they keep its limits.
        missed: Criterion or limit -> number of falls from which the first answer missed it on the model. Empty in a library
            that demands nothing of hardware.
        interrupted: Whether the check was stopped before its end.
    """

    starts: int
    seed: int
    first: Share
    after: Mapping[int, Share]
    refined: Share | None
    twice: Share
    lying: Mapping[str, Share]
    perturbed: Share
    perturbed_twice: Share
    expected: float
    answer_ms: tuple[float, float]
    failed: tuple[int, ...]
    interrupted: bool = False
    certified: Share | None = None
    missed: Mapping[str, int] = field(default_factory=dict)

    def to_json(self) -> dict[str, object]:
        """Convert the result to plain numbers."""
        after = {str(k): share.to_json() for k, share in self.after.items()}
        lying = {name: share.to_json() for name, share in self.lying.items()}
        refined = {} if self.refined is None else {"refined": self.refined.to_json()}
        hardware = {}
        if self.certified is not None:
            hardware = {"hardware": {"certified": self.certified.to_json(), "missed": dict(self.missed)}}
        nominal = {
            "first": self.first.to_json(),
            "after": after,
            **refined,
            "twice": self.twice.to_json(),
            "lying": lying,
        }
        return {
            "starts": self.starts,
            "seed": self.seed,
            "nominal": nominal,
            "perturbed": {"first": self.perturbed.to_json(), "twice": self.perturbed_twice.to_json()},
            **hardware,
            "expected": self.expected,
            "answer_ms": {"median": self.answer_ms[0], "p99": self.answer_ms[1]},
            "failed": list(self.failed),
            "interrupted": self.interrupted,
        }


def check_library(
    library: Library,
    *,
    robot: Robot | None = None,
    starts: int,
    seed: int,
    threads: int = 0,
    perturbation: Perturbation | None = None,
    refine: float | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> LibraryCheck:
    """Try a library on falls of another seed than its own.

    Args:
        library: The library.
        robot: The library's robot. Defaults to the one that the task names.
        starts: Number of falls.
        seed: Seed of the falls.
        threads: Number of engine threads (0: one per core).
        perturbation: How perturbed models differ from the nominal one. Defaults to that of `levade check`.
        refine: Time for which an answer that does not work is refined in simulation [s] (`levade.library.refining`). The
            result then depends on the computer. None: no refinement.
        stopping: Function that is called between batches. When it returns True, the check ends with the falls so far.

    Returns:
        The shares of falls from which the library's answers work.

    Raises:
        LevadeError: If the seed is that of the library's own falls, or the task is not consistent.
    """
    _, own = read_library(library.directory)
    if seed == own:
        raise LevadeError(f"{seed} is the seed of the library's own falls; give another", field="seed")
    if starts < 1:
        raise LevadeError(f"{starts} falls are too few; give 1 or more, such as 200", field="starts")
    falls, _ = read_falls(library.directory, robot=robot, seed=seed, threads=threads)
    trial = _Trial(library, falls, seed, perturbation or Perturbation(), refine)
    for first in range(0, starts, _AT_ONCE):
        if stopping():
            break
        trial.go(range(first, min(first + _AT_ONCE, starts)))
    return trial.found(interrupted=trial.n < starts)


class _Trial:
    def __init__(
        self, library: Library, falls: Falls, seed: int, perturbation: Perturbation, refine: float | None
    ) -> None:
        self._library, self._falls, self._seed, self._perturbation = library, falls, seed, perturbation
        self._refine, self._refined = refine, 0
        self._plays = Plays(library.directory, library.knowledge.mirror)
        # per fall, whether each of the likeliest motions works, up to the first one that does
        self._works: list[Mask] = []
        self._perturbed: list[bool] = []
        self._faces: list[str] = []
        self._recovered, self._recovered_perturbed, self._certified = 0, 0, 0
        self._missed: Counter[str] = Counter()
        self._times: list[float] = []
        self._expected: list[float] = []

    @property
    def n(self) -> int:
        return len(self._works)

    def go(self, indices: Sequence[int]) -> None:
        """Try some falls."""
        objectives = [self._falls.objective(i) for i in indices]
        sensed = [self._falls.sensed(objective.state) for objective in objectives]
        answers = [self._asked(*one) for one in sensed]
        self._faces += [face(up) for up, _ in sensed]
        numbers = [(one.number, *(number for number, _ in one.others))[: max(AFTER)] for one in answers]
        plays = [[self._plays[number] for number in own] for own in numbers]
        found = tried(objectives, [own[:1] for own in plays])
        works: list[Mask] = [one.success for one in found]
        left = [j for j, one in enumerate(works) if not one[0] and len(plays[j]) > 1]
        for j, further in zip(left, tried([objectives[j] for j in left], [plays[j][1:] for j in left]), strict=True):
            works[j] = np.concatenate([works[j], further.success])
        self._works += works
        if self._library.hardware:
            self._judge(answers, found)
        self._expected += [one.probability for one in answers]
        first = [own[0] for own in plays]
        on_others = tried_on_others(
            objectives, [{0: play} for play in first], self._perturbation, seeds=[(self._seed, i) for i in indices]
        )
        perturbed = [bool(one[0]) for one in on_others]
        self._perturbed += perturbed
        failed = [j for j, one in enumerate(works) if not one[0]]
        for j in failed if self._refine is not None else ():
            assert self._refine is not None
            better = refined(self._falls, self._plays, objectives[j], numbers[j], seconds=self._refine, seed=self._seed)
            self._refined += better.works
        asked = [_Asked(objectives[j], first[j], numbers[j][0], *sensed[j]) for j in range(len(indices))]
        self._recovered += self._again([(asked[j], objectives[j].state, None) for j in failed])
        self._recovered_perturbed += self._again(
            [
                (asked[j], *others(objectives[j], self._perturbation, [0], seed=(self._seed, i)))
                for j, i in enumerate(indices)
                if not perturbed[j]
            ]
        )

    def _judge(self, answers: Sequence[Answer], found: Sequence[Evaluation]) -> None:
        """Count first answers with a certificate, and the criteria and limits that first answers miss."""
        for answer, one in zip(answers, found, strict=True):
            self._certified += bool(one.success[0]) and answer.failed == ()
            for name, criterion in self._falls.judged.success.items():
                self._missed[name] += not criterion.met(one.errors[name][:1])[0]

    def found(self, *, interrupted: bool) -> LibraryCheck:
        n, first = self.n, sum(bool(one[0]) for one in self._works)
        median, late = np.percentile(self._times, [50, 99]) if self._times else (0.0, 0.0)
        return LibraryCheck(
            starts=n,
            seed=self._seed,
            first=Share(first, n),
            after={k: Share(sum(bool(one[:k].any()) for one in self._works), n) for k in AFTER},
            refined=None if self._refine is None else Share(first + self._refined, n),
            twice=Share(first + self._recovered, n),
            lying={name: self._of_those_on(name) for name in FACES if name in self._faces},
            perturbed=Share(sum(self._perturbed), n),
            perturbed_twice=Share(sum(self._perturbed) + self._recovered_perturbed, n),
            expected=float(np.mean(self._expected)) if self._expected else 0.0,
            answer_ms=(1e3 * float(median), 1e3 * float(late)),
            failed=tuple(i for i, one in enumerate(self._works) if not one[0]),
            interrupted=interrupted,
            certified=Share(self._certified, n) if self._library.hardware else None,
            missed={name: count for name, count in self._missed.items() if count},
        )

    def _of_those_on(self, name: str) -> Share:
        works = [bool(one[0]) for one, lies in zip(self._works, self._faces, strict=True) if lies == name]
        return Share(sum(works), len(works))

    def _asked(self, up: Array, joint_position: Array) -> Answer:
        began = time.perf_counter()
        answer = self._library.ask(up, joint_position)
        self._times.append(time.perf_counter() - began)
        return answer

    def _again(self, failures: Sequence[tuple[_Asked, State, Models | None]]) -> int:
        """Count the failures of first answers that a second one recovers, from where the first one left the robot.

        Each failure has the start of the first answer, and the perturbed model on which it failed. None is the nominal one.
        """
        engine = self._falls.simulation.engine
        if not isinstance(engine, MujocoEngine):
            return 0
        recovered = 0
        for asked, start, models in failures:
            own, weights = posed(asked.objective, asked.play)
            reference = own.policy.reference(weights, hold_steps=own.task.hold_steps)
            if models is not None:
                reference = replace(reference, before=start.joint_reference[0])
            out, diverged = engine.states(start, reference, ["qpos", "qvel", "act"], models=models)
            if diverged[0]:
                continue
            qpos, qvel, act = (out[name][0, -1] for name in ("qpos", "qvel", "act"))
            fallen = engine.layout.state(qpos, qvel, act, joint_reference=reference.position[0, -1])
            left = self._falls.from_state(self._falls.folded(fallen, models))
            up, joint_position = self._falls.sensed(left.state)
            answer = self._asked(up, joint_position)
            answers = [(answer.number, answer.probability), *answer.others]
            failed = (asked.number, asked.up, asked.joint_position)
            play = self._plays[without_repeats(answers, [failed], up, joint_position)[0][0]]
            if models is None:
                recovered += bool(tried([left], [[play]])[0].success[0])
            else:
                again, weights = posed(left, play)
                recovered += bool(judged_on_others(again, weights, left.state, models)[0])
        return recovered


@dataclass(frozen=True, eq=False)
class _Asked:
    """A first answer: the task from its fall, what is played, its number, and what the robot sensed before it."""

    objective: Objective
    play: Play
    number: int
    up: Array
    joint_position: Array
