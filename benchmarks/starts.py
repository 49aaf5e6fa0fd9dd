"""From where a search for a new fall should begin: trials per fall, cold, around the nearest motion, and around a learned one.

    python benchmarks/starts.py run --robots go1 hyq2max        # goes on where it was; rows in results/starts.jsonl
    python benchmarks/starts.py show                            # the tables
    python benchmarks/library.py write                          # docs/falls.md, with these tables

Each fall of seed 11 gets a motion of its own, from a search from nothing that ends with its first success. Any such motions
are a small library. A learned start is a vector of weights that is predicted from how the robot lies. How it is predicted,
and how large the first steps of the search are, is chosen on these falls, each with a library of others. Results are from
falls of seed 12.

A search around a start has 240 trials. If they are not enough, a search from nothing follows, and its trials count, too.
"""

from __future__ import annotations

import argparse
import json
import statistics
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.exports.asker import features
from levade.library.falls import Falls
from levade.library.knowledge import Knowledge
from levade.library.mirror import Mirror
from levade.library.plays import tried
from levade.policies import JointPolicy
from levade.search import InitialGuess, Objective, solve
from levade.search.initial import AROUND
from levade.tasks import Task, load_task

RESULTS = Path(__file__).resolve().parent / "results" / "starts.jsonl"
LIBRARY_SEED, UNSEEN_SEED = 11, 12
SIZES = (3, 10, 30)
"""Number of falls, each with its own motion, in a library."""

NEAR = 240
"""Trials of a search around a start."""

STEPS = (AROUND, AROUND / 2)
"""Factors on the first step of a search around a learned start; around a known motion it is the first."""

NEIGHBOURS, VARIANCE = 3, 0.9
"""Motions of a mean; share of the variance that the basis of a regression keeps."""

Row = dict[str, Any]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    running = commands.add_parser("run")
    running.add_argument("--robots", nargs="+", default=["go1", "hyq2max"])
    running.add_argument(
        "--folds", action="store_true", help="falls after which the robot folds up, as libraries have them"
    )
    running.add_argument("--library", type=int, default=max(SIZES), help="falls of the libraries")
    running.add_argument("--falls", type=int, default=20, help="unseen falls")
    running.add_argument("--threads", type=int, default=1)
    showing = commands.add_parser("show")
    for one in (running, showing):
        one.add_argument("--out", type=Path, default=RESULTS)
    options = parser.parse_args()
    if options.command == "show":
        print("\n\n".join(tables(rows_in(options.out)).values()))
        return
    for robot in options.robots:
        bench = Bench(robot, options.folds, options.threads, options.out)
        bench.choose(options.library)
        bench.report(options.library, options.falls)


@dataclass(frozen=True, eq=False)
class Start:
    """Weights to begin at, of shape (d,): a motion of the library is one, and a mean of some."""

    weights: Array

    def decisions(self, policy: JointPolicy) -> Array:
        return self.weights[None]


@dataclass(frozen=True, eq=False)
class Examples:
    """Falls, and a motion for each, with the mirror images of both.

    Attributes:
        up, joint_position: How the robot lies, shape (n, 3) and (n, joints).
        weights: Weights of the motion, shape (n, d).
    """

    up: Array
    joint_position: Array
    weights: Array

    @classmethod
    def of(
        cls, sensed: Sequence[tuple[Array, Array]], weights: Array, policy: JointPolicy, mirror: Mirror | None
    ) -> Examples:
        up, joints = (np.array(one) for one in zip(*sensed, strict=True))
        if mirror is None:
            return cls(up, joints, weights)
        image = mirror.decisions(policy, weights)
        assert image is not None  # otherwise the falls would have no mirror
        parts = ((up, mirror.up(up)), (joints, mirror.posture(joints)), (weights, image))
        return cls(*(np.concatenate(part) for part in parts))

    def distances(self, up: Array, joint_position: Array) -> Array:
        """The distance that a library has, shape (n,)."""
        n = len(self.up)
        none = np.zeros((n, 0))
        return Knowledge(
            np.arange(n, dtype=float), self.up, self.joint_position, np.zeros(0, int), none, none
        ).distances(up, joint_position)

    @cached_property
    def inputs(self) -> Array:
        return features(self.up, self.joint_position)

    @cached_property
    def basis(self) -> tuple[Array, Array, Array]:
        """Mean of the weights, principal components of shape (k, d), and each motion's coordinates, shape (n, k)."""
        mean = self.weights.mean(axis=0)
        left, size, right = np.linalg.svd(self.weights - mean, full_matrices=False)
        k = 1 + int(np.searchsorted(np.cumsum(size**2) / (size**2).sum(), VARIANCE))
        return mean, right[:k], left[:, :k] * size[:k]


Predict = Callable[[Examples, Array, Array], Array]


def nearest(of: Examples, up: Array, joints: Array) -> Array:
    """The motion of the nearest fall."""
    return of.weights[int(np.argmin(of.distances(up, joints)))]


def mean(of: Examples, up: Array, joints: Array) -> Array:
    """The mean of the nearest falls' motions, those further away with less weight."""
    distance = of.distances(up, joints)
    order = np.argsort(distance, kind="stable")[:NEIGHBOURS]
    share = np.exp(-((distance[order] / max(distance[order[-1]], 1e-6)) ** 2))
    return share @ of.weights[order] / share.sum()


def ridge(of: Examples, up: Array, joints: Array) -> Array:
    """Ridge regression in the motions' principal components, with the penalty of the smallest leave-one-out error."""
    centre, components, y = of.basis
    x = of.inputs - of.inputs.mean(axis=0)
    best = (np.inf, np.zeros((x.shape[1], y.shape[1])))
    for penalty in 10.0 ** np.arange(-3, 4):
        inverse = np.linalg.solve(x.T @ x + penalty * np.eye(x.shape[1]), x.T)
        fitted = inverse @ y
        left_out = (y - x @ fitted) / (1.0 - np.einsum("nf,fn->n", x, inverse) - 1.0 / len(x))[:, None]
        best = min(best, (float((left_out**2).sum()), fitted), key=lambda one: one[0])
    return centre + (features(up, joints) - of.inputs.mean(axis=0)) @ best[1] @ components


def process(of: Examples, up: Array, joints: Array) -> Array:
    """A Gaussian process in the motions' principal components, with the likeliest length and noise."""
    import warnings

    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    centre, components, y = of.basis
    scale = y.std()
    kernel = ConstantKernel(1.0, (1e-2, 1e2)) * RBF(0.5, (0.05, 5.0)) + WhiteKernel(0.5, (1e-3, 1e1))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a hyperparameter may end at its bound
        fitted = GaussianProcessRegressor(kernel).fit(of.inputs, y / scale)
    return centre + scale * fitted.predict(features(up, joints)[None]).reshape(-1) @ components


LEARNED: dict[str, Predict] = {"mean of 3": mean, "ridge": ridge, "gaussian process": process}
"""Kinds of learned starts, the simplest first."""


class Bench:
    """The searches of one robot. What was done before is read from the file."""

    def __init__(self, robot: str, folds: bool, threads: int, out: Path) -> None:
        changes = ["search.polish=0"] + ([] if folds else ["start={fallen: {height: 1 height}}"])
        task = load_task("self-righting", robot=robot, changes=changes)
        self._about = {"robot": robot, "folds": folds}
        self._families = {seed: Falls(task, seed=seed, threads=threads) for seed in (LIBRARY_SEED, UNSEEN_SEED)}
        self._objectives: dict[tuple[int, int], Objective] = {}
        self._out, self._rows = out, {key_of(row): row for row in rows_in(out)}

    def choose(self, library: int) -> None:
        """Try each kind of learned start from the falls of the library, each with others, in every size."""
        for i in range(library):
            self._cold(LIBRARY_SEED, i)
        for size in (one for one in SIZES if one <= library):
            for i in range(library):
                others = members(size, i, [one for one in range(library) if one != i])
                self._starts(LIBRARY_SEED, i, size, others)
        kind = chosen(of_bench(self._rows.values(), self._about))[0]
        size = min(SIZES[1], library)
        for i in range(library):
            others = members(size, i, [one for one in range(library) if one != i])
            for step in STEPS:
                self._search(LIBRARY_SEED, i, size, others, kind, step)

    def report(self, library: int, falls: int) -> None:
        """Search for each unseen fall: from nothing, around the nearest motion, around known ones, around a learned start."""
        kind, step = chosen(of_bench(self._rows.values(), self._about))
        for i in range(falls):
            self._cold(UNSEEN_SEED, i)
            for size in SIZES:
                if len(others := members(size, i, range(library))) < size:
                    continue
                self._starts(UNSEEN_SEED, i, size, others)
                self._search(UNSEEN_SEED, i, size, others, "nearest", AROUND)
                self._search(UNSEEN_SEED, i, size, others, kind, step)
                self._known(i, size, others)

    def _objective(self, seed: int, fall: int) -> Objective:
        if (seed, fall) not in self._objectives:
            self._objectives[seed, fall] = self._families[seed].objective(fall)
        return self._objectives[seed, fall]

    def _examples(self, others: Sequence[int]) -> Examples:
        falls = self._families[LIBRARY_SEED]
        objectives = [self._objective(LIBRARY_SEED, one) for one in others]
        weights = np.array([self._cold(LIBRARY_SEED, one)["weights"] for one in others])
        sensed = [falls.sensed(one.state) for one in objectives]
        return Examples.of(sensed, weights, objectives[0].policy, falls.mirror)

    def _sensed(self, seed: int, fall: int) -> tuple[Array, Array]:
        return self._families[seed].sensed(self._objective(seed, fall).state)

    def _cold(self, seed: int, fall: int) -> Row:
        """Search from nothing. The row of a library's fall has the motion's weights."""

        def search() -> Row:
            found = solve(self._objective(seed, fall), seed=fall)
            weights = {"weights": found.best.weights.tolist()} if seed == LIBRARY_SEED else {}
            return {"success": found.success, "trials": found.trials_to_success or found.trials, **weights}

        return self._row({"seed": seed, "fall": fall, "size": 0, "kind": "cold", "step": 1.0}, search)

    def _starts(self, seed: int, fall: int, size: int, others: Sequence[int]) -> None:
        """Whether each kind of start works at once, and its cost."""
        for kind in ("nearest", *LEARNED):
            self._row(
                {"seed": seed, "fall": fall, "size": size, "kind": kind, "step": 0.0},
                lambda kind=kind: self._try(seed, fall, self._start(seed, fall, others, kind)),
            )

    def _start(self, seed: int, fall: int, others: Sequence[int], kind: str) -> Array:
        return {"nearest": nearest, **LEARNED}[kind](self._examples(others), *self._sensed(seed, fall))

    def _try(self, seed: int, fall: int, weights: Array) -> Row:
        objective = self._objective(seed, fall)
        found = tried([objective], [[Start(weights)]])[0]
        cost = found.cost({name: one.weight for name, one in objective.task.costs.items()})
        return {"success": bool(found.success[0]), "cost": float(cost[0])}

    def _search(self, seed: int, fall: int, size: int, others: Sequence[int], kind: str, step: float) -> Row:
        """Search around a start, then from nothing."""

        def search() -> Row:
            at_once = self._rows[self._key({"seed": seed, "fall": fall, "size": size, "kind": kind, "step": 0.0})]
            if at_once["success"]:
                return {"success": True, "trials": 1}
            return self._around(seed, fall, self._start(seed, fall, others, kind), step)

        return self._row({"seed": seed, "fall": fall, "size": size, "kind": kind, "step": step}, search)

    def _around(self, seed: int, fall: int, weights: Array, step: float) -> Row:
        objective = self._objective(seed, fall)
        near = objective.with_task(short(objective.task))
        found = solve(near, seed=fall, initial=InitialGuess(weights[None], step=step))
        if found.success:
            return {"success": True, "trials": found.trials_to_success}
        cold = self._cold(seed, fall)
        return {"success": cold["success"], "trials": found.trials + cold["trials"], "near": False}

    def _known(self, fall: int, size: int, others: Sequence[int]) -> None:
        """Try the known motions, the nearest fall's first, until one works. Then search around the cheapest."""

        def search() -> Row:
            examples, costs = self._examples(others), []
            order = np.argsort(examples.distances(*self._sensed(UNSEEN_SEED, fall)), kind="stable")
            for k, one in enumerate(order, 1):
                found = self._try(UNSEEN_SEED, fall, examples.weights[one])
                if found["success"]:
                    return {"success": True, "trials": k, "works": k}
                costs.append(found["cost"])
            best = examples.weights[order[int(np.argmin(costs))]]
            row = self._around(UNSEEN_SEED, fall, best, AROUND)
            return {**row, "trials": row["trials"] + len(order), "works": None}

        self._row({"seed": UNSEEN_SEED, "fall": fall, "size": size, "kind": "known", "step": AROUND}, search)

    def _key(self, case: Mapping[str, Any]) -> tuple[Any, ...]:
        return key_of({**self._about, **case})

    def _row(self, case: Mapping[str, Any], make: Callable[[], Row]) -> Row:
        """Return the row of a case. Make and write it if it is not there."""
        key = self._key(case)
        if key not in self._rows:
            self._rows[key] = {**self._about, **case, **make()}
            with self._out.open("a") as file:
                file.write(json.dumps(self._rows[key]) + "\n")
        return self._rows[key]


def short(task: Task) -> Task:
    """The task with a search around a motion, as a build has it."""
    return replace(task, search=replace(task.search, trials=NEAR, restart=None, patience=None))


def members(size: int, fall: int, falls: Iterable[int]) -> list[int]:
    """Draw the falls of a small library: others for each fall. Fewer where there are not as many."""
    falls = list(falls)
    drawn = np.random.default_rng((size, fall)).permutation(len(falls))[:size]
    return sorted(falls[one] for one in drawn)


def key_of(row: Mapping[str, Any]) -> tuple[Any, ...]:
    """What tells a row from others."""
    return tuple(row[name] for name in ("robot", "folds", "seed", "fall", "size", "kind", "step"))


def rows_in(file: Path) -> list[Row]:
    """The rows of a file, each case once."""
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    return list({key_of(row): row for row in rows}.values())


def of_bench(rows: Iterable[Row], about: Mapping[str, Any]) -> list[Row]:
    """The rows of a robot and a family of falls."""
    return [row for row in rows if all(row[name] == value for name, value in about.items())]


def chosen(rows: Sequence[Row]) -> tuple[str, float]:
    """The kind of learned start that works at once most often on the library's falls, and the better step for it."""
    own = [row for row in rows if row["seed"] == LIBRARY_SEED]

    def works(kind: str) -> tuple[int, float]:
        at_once = [row for row in own if row["kind"] == kind and row["step"] == 0.0]
        return sum(row["success"] for row in at_once), -sum(row["cost"] for row in at_once)

    kind = max(LEARNED, key=works)
    spent = {step: sum(row["trials"] for row in own if (row["kind"], row["step"]) == (kind, step)) for step in STEPS}
    return kind, min(STEPS, key=lambda step: spent[step])


def tables(rows: Sequence[Row]) -> dict[str, str]:
    """The tables of docs/falls.md, in Markdown."""
    benches = list(dict.fromkeys((row["robot"], row["folds"]) for row in rows))
    parts = [(name_of(*one), of_bench(rows, {"robot": one[0], "folds": one[1]})) for one in benches]
    return {"at_once": at_once(parts), "per_fall": per_fall(parts), "paired": paired(parts), "hard": hard(parts)}


Parts = Sequence[tuple[str, Sequence[Row]]]


def name_of(robot: str, folds: bool) -> str:
    return robot if folds else f"{robot}, as it fell"


def complete(rows: Sequence[Row], size: int) -> list[dict[str, Row]]:
    """The unseen falls that have every search with libraries of a size: kind -> row."""
    kind, step = chosen(rows)
    named = {("cold", 1.0): "cold", ("nearest", AROUND): "nearest", ("known", AROUND): "known", (kind, step): "learned"}
    falls: dict[int, dict[str, Row]] = {}
    for row in rows:
        name = named.get((row["kind"], row["step"]))
        if row["seed"] == UNSEEN_SEED and name and row["size"] in (0, size):
            falls.setdefault(row["fall"], {})[name] = row
    return [found for found in falls.values() if len(found) == len(named)]


def sized(parts: Parts) -> Iterator[tuple[str, int, Sequence[Row], list[dict[str, Row]]]]:
    """Each robot and size that has results."""
    for name, rows in parts:
        for size in SIZES:
            if found := complete(rows, size):
                yield name, size, rows, found


def at_once(parts: Parts) -> str:
    """Markdown: how often each kind of start works without a search."""
    lines = [
        f"| robot | library | falls | nearest | {' | '.join(LEARNED)} |",
        f"|---|--:|--:|{'--:|' * (1 + len(LEARNED))}",
    ]
    for name, rows in parts:
        for size in SIZES:
            own = [row for row in rows if (row["seed"], row["size"], row["step"]) == (UNSEEN_SEED, size, 0.0)]
            works = {kind: [row["success"] for row in own if row["kind"] == kind] for kind in ("nearest", *LEARNED)}
            if n := min(map(len, works.values())):
                shares = " | ".join(f"{sum(one) / len(one):.0%}" for one in works.values())
                lines.append(f"| {name} | {size} | {n} | {shares} |")
    return "\n".join(lines)


def per_fall(parts: Parts) -> str:
    """Markdown: trials of a fall, mean and median."""
    names = ("cold", "nearest", "known", "learned")
    lines = [
        f"| robot | library | falls | {' | '.join(names)} | learned is |",
        f"|---|--:|--:|{'--:|' * len(names)}---|",
    ]
    for name, size, rows, found in sized(parts):
        trials = {one: [fall[one]["trials"] for fall in found] for one in names}
        cells = " | ".join(f"{statistics.mean(one):.1f}, {statistics.median(one):g}" for one in trials.values())
        kind, step = chosen(rows)
        lines.append(f"| {name} | {size} | {len(found)} | {cells} | {kind}, step {step:g} |")
    return "\n".join(lines)


def paired(parts: Parts) -> str:
    """Markdown: the difference of trials on the same fall, with a bootstrap interval of its mean."""
    lines = ["| robot | library | nearest − cold | learned − cold | learned − nearest | fewer, same, more |"]
    lines.append("|---|--:|---|---|---|---|")
    for name, size, _, found in sized(parts):
        of = {one: np.array([fall[one]["trials"] for fall in found], dtype=float) for one in found[0]}
        apart = of["learned"] - of["nearest"]
        counts = ", ".join(str(int(one.sum())) for one in (apart < 0, apart == 0, apart > 0))
        cells = [between(one) for one in (of["nearest"] - of["cold"], of["learned"] - of["cold"], apart)]
        lines.append(f"| {name} | {size} | {' | '.join(cells)} | {counts} |")
    return "\n".join(lines)


def between(values: Array) -> str:
    """A mean and its 95 % bootstrap interval."""
    drawn = np.random.default_rng(0).integers(len(values), size=(4000, len(values)))
    low, high = np.percentile(values[drawn].mean(axis=1), [2.5, 97.5])
    return f"{values.mean():+.1f} ({low:+.1f} to {high:+.1f})"


def hard(parts: Parts) -> str:
    """Markdown: mean trials of the falls from which no known motion works, nor its image."""
    names = ("cold", "nearest", "known", "learned")
    lines = [
        f"| robot | library | falls from which none works | {' | '.join(names)} |",
        f"|---|--:|--:|{'--:|' * len(names)}",
    ]
    for name, size, _, found in sized(parts):
        left = [fall for fall in found if fall["known"]["works"] is None]
        cells = " | ".join(
            f"{statistics.mean(fall[one]['trials'] for fall in left):.0f}" if left else "" for one in names
        )
        lines.append(f"| {name} | {size} | {len(left)} of {len(found)} | {cells} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
