"""What the duration of the paper's two motions costs HyQ2Max, and docs/duration.md with it and the results of freedom.py.

    python benchmarks/duration.py                      # three seeds, both tasks, eight durations: 20 core-minutes
    python benchmarks/duration.py --write              # only draw the figure and write the page, from benchmarks/results

Searches have a fixed horizon T and look for a motion of little effort that keeps away from the limits: squared misses of the
goal, the effort, and the 8-norm of all shares of limits, with plain CMA-ES. A seed begins at T = 0.5 s with six short searches
from nothing, and a longer one around the best of them. It goes on to shorter and longer T, with two from nothing and one
around the best of these and the motions of the T before, stretched or after a wait. Of all trials that reach the goal, the one
of least effort and the one of the least norm are kept, and simulated again, the recovery through 2 s of hold. Results are in
results/duration.jsonl, seed by seed; what is there is not made again.
"""

from __future__ import annotations

import argparse
import json
import os
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "duration.jsonl"
PAGE = HERE.parent / "docs" / "duration.md"
FIGURE = "figures/duration.png"

DURATIONS = (0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 3.0)
"""[s]"""
FIRST = 0.5
"""[s], where a seed begins."""
STARTS, AGAIN, SHORT, LONG = 6, 2, 140, 400
"""Searches from nothing at `FIRST` and at every other T, the trials of each, and those of the search around the best."""
SPACING, FEWEST, WIDE = 0.15, 6, 0.7
"""[s] between kernels, the fewest of them, and their standard deviation in spacings: trials are not spent on details."""
LOAD = 3.0
"""Weight of the load."""
HOLD = 0.4
"""[s], of the recovery while it is searched: a robot that is falling then falls on."""
ANGLE, HEIGHT = 0.05, 0.05
"""[rad] and [m], how near the goal has to be reached."""
SHARES = ("speed", "torque", "torque-speed")
"""Kinds of limit. Torques end at theirs: the actuators give no more."""


def goal(angles: dict[str, float], height: float, at: str = "horizon", loose: float = 1.0) -> tuple[dict, dict]:
    """Costs and criteria of angles and a height: a miss of one tolerance more than half of one costs 10."""
    suffix = "" if at == "horizon" else f"_{at}"
    bounds = {name: (target, loose * ANGLE) for name, target in angles.items()} | {"height": (height, loose * HEIGHT)}
    costs = {
        f"miss_{name}{suffix}": {
            "term": "miss",
            "weight": 3,
            "quantity": name,
            "target": target,
            "at": at,
            "tolerance": tolerance / 2,
            "scale": tolerance,
        }
        for name, (target, tolerance) in bounds.items()
    }
    success = {
        f"{name}{suffix}": {"quantity": name, "target": target, "tolerance": tolerance, "at": at}
        for name, (target, tolerance) in bounds.items()
    }
    return costs, success


def task_of(name: str, horizon: float) -> Any:
    """One of the paper's tasks with another horizon, criteria and costs."""
    from levade.costs import Criterion
    from levade.tasks import Cost, load_task

    if name == "rearing":
        costs, success = goal({"pitch": -1.0472}, 0.90)
        changes = ["search.step=0.3", "search.smoothness=0.2", "search.modes=null"]
    else:
        level = {"roll": 0.0, "pitch": 0.0}
        (costs, success), (more, held) = goal({**level, "yaw": 0.0}, 0.61), goal(level, 0.61, "end", loose=2.5)
        costs, success = costs | more, success | held
        changes = ["search.step=0.1", "search.smoothness=0.3", "search.modes=null", f"hold={HOLD}"]
    costs |= {"effort": {"weight": 0.5}, "joint_limits": {"weight": 10}}
    success["angles"] = {"quantity": "angle_margin", "minimum": 0.0, "at": "min"}
    kernels = max(FEWEST, round(horizon / SPACING))
    changes += [
        *(
            f"horizon={horizon}",
            f"policy.kernels={kernels}",
            f"policy.variance={(WIDE / (kernels - 1)) ** 2}",
            "stages=[{}]",
        ),
        *(f"costs={json.dumps(costs)}", f"success={json.dumps(success)}"),
        *("search.population=16", "search.optimizer=cma", "search.restart=null", "search.polish=null"),
    ]
    task = load_task(name, changes=changes)
    assert all(isinstance(criterion, Criterion) for criterion in task.success.values())
    return replace(task, costs={**task.costs, "load": Cost(load, LOAD)})


def shares_of_joints(trajectories: Any) -> np.ndarray:
    """The largest share of each kind of limit over time, shape (n, joints, 3): those of `levade check`."""
    limits = trajectories.limits
    torque, speed = trajectories.joint_torque, trajectories.joint_velocity
    kinds = (
        1 - limits.speed_left(speed),
        np.abs(torque) / limits.torque,
        1 - limits.torque_speed_left(torque, speed),
    )
    return np.stack([kind.max(axis=1) for kind in kinds], axis=2)


def shares(trajectories: Any) -> np.ndarray:
    """Those of the joint that has the largest, shape (n, 3)."""
    return shares_of_joints(trajectories).max(axis=1)


def load(trajectories: Any) -> np.ndarray:
    """The 8-norm of all shares, shape (n,): all large ones count, where of the largest alone a search does not see the next."""
    of_joints = shares_of_joints(trajectories)
    return np.power(np.power(of_joints, 8).reshape(len(of_joints), -1).sum(axis=1), 1 / 8)


class Kept:
    """The successful trials of least effort and of least load, of all that a search has tried."""

    def __init__(self) -> None:
        self.best: dict[str, tuple[float, np.ndarray]] = {}

    def look(self, weights: np.ndarray, evaluation: Any) -> None:
        won = np.flatnonzero(evaluation.success)
        for name in ("effort", "load"):
            values = evaluation.terms[name][won]
            if len(won) and values.min() < self.best.get(name, (np.inf,))[0]:
                self.best[name] = float(values.min()), weights[won[values.argmin()]].copy()


def search(name: str, horizon: float, seed: int, around: np.ndarray | None) -> tuple[dict[str, Any], np.ndarray]:
    """Some searches from nothing, and one around the best of them and the references ``around``.

    Args:
        name: The task.
        horizon: T [s].
        seed: Seed of the searches.
        around: References of motions of another T [rad], shape (motions, steps, joints); None if there are none.

    Returns:
        What was found, and the references of the motions that were kept.
    """
    from levade.optimizers.blas import single_threaded
    from levade.search import make_objective
    from levade.search.initial import InitialGuess

    objective = make_objective(task_of(name, horizon), threads=1)
    begun = [] if around is None else list(guesses(objective, around))
    looked = Kept()
    with single_threaded():
        for start in range(STARTS if around is None else AGAIN):
            own = Kept()
            begun.append(drive(objective, SHORT, (own, looked), seed=1000 * seed + start))
            begun += [weights for _, weights in own.best.values()]
        drive(objective, LONG, (looked,), seed=seed, initial=InitialGuess(np.stack(begun), step=0.3))
    row = {"task": name, "T": horizon, "seed": seed, "steps": objective.engine.steps}
    row |= {which: measured(objective, name, weights) for which, (_, weights) in looked.best.items()}
    kept = np.stack([weights for _, weights in looked.best.values()] or begun[-1:])
    return row, objective.policy.reference(kept, hold_steps=0).position


def drive(objective: Any, budget: int, looking: Sequence[Kept], *, seed: int, initial: Any = None) -> np.ndarray:
    """One search. Returns the weights of its best trial."""
    from levade.search import Search

    task = replace(objective.task, search=replace(objective.task.search, trials=budget))
    searching = Search(task, objective.space, seed=seed, initial=initial)
    while (trials := searching.ask()) is not None:
        evaluation = objective.evaluate(trials)
        for one in looking:
            one.look(trials.weights, evaluation)
        searching.tell(evaluation)
    return searching.solution.best.weights


def guesses(objective: Any, around: np.ndarray) -> np.ndarray:
    """Weights of motions of another duration: each stretched; and where it is shorter, as it is after a wait."""
    steps, before = objective.policy.horizon_steps, objective.state.joint_reference[0]
    share = np.arange(1, steps + 1) / steps * around.shape[1]
    rows = np.arange(1, around.shape[1] + 1)
    positions = [np.stack([np.interp(share, rows, angle) for angle in one.T], axis=1) for one in around]
    if steps > around.shape[1]:
        wait = np.repeat(before[None], steps - around.shape[1], axis=0)
        positions += [np.concatenate([wait, one]) for one in around]
    return objective.policy.imitate(np.stack(positions))


def measured(objective: Any, name: str, weights: np.ndarray) -> dict[str, Any]:
    """Effort, shares, what standing costs in a second, and whether a recovered robot stays up through 2 s."""
    from levade.costs import Effort

    motion = objective.rollout(weights[None])
    row = {
        "effort": float(objective.terms["effort"](motion)[0]),
        "shares": dict(zip(SHARES, shares(motion)[0].tolist(), strict=True)),
    }
    if name == "rearing":
        still = objective.policy.hold(objective.state.joint_reference[0])[None]
        return row | {"standing": float(Effort()(objective.rollout(still))[0]) / objective.task.horizon}
    held = objective.rollout(weights[None], hold_steps=round(2.0 / objective.task.physics.timestep))
    criteria = [one for one in objective.task.success.values() if one.at == "end"]
    share = held.joint_torque[0, -250:] / held.limits.torque
    standing = float(np.square(share).sum(axis=1).mean())
    return row | {"standing": standing, "stays": bool(all(criterion.holds(held)[0] for criterion in criteria))}


def chain(name: str, seed: int) -> Iterator[dict[str, Any]]:
    """All durations of one seed."""
    first, guess = search(name, FIRST, seed, None)
    yield first
    start = DURATIONS.index(FIRST)
    for way in (DURATIONS[:start][::-1], DURATIONS[start + 1 :]):
        around = guess
        for horizon in way:
            row, around = search(name, horizon, seed, around)
            yield row


def checksum(name: str) -> int:
    """What decides the results of a task, the seed apart."""
    from levade.tasks import task_to_dict

    content = json.dumps(task_to_dict(task_of(name, FIRST), code=True), default=str)
    return zlib.crc32(f"{content} {DURATIONS} {STARTS} {AGAIN} {SHORT} {LONG}".encode())


def kept() -> list[dict[str, Any]]:
    """What is in the results."""
    if not RESULTS.exists():
        return []
    return [json.loads(line) for line in RESULTS.read_text(encoding="utf-8").splitlines()]


def run(tasks: Sequence[str], seeds: Sequence[int]) -> None:
    """Make what is missing. A seed that was stopped on the way begins again when this is run again."""
    from levade.motions import versions

    for seed in seeds:
        for name in tasks:
            about = {"checksum": checksum(name), "versions": versions()}
            done = [
                row for row in kept() if (row["task"], row["seed"], row["checksum"]) == (name, seed, about["checksum"])
            ]
            if len(done) == len(DURATIONS):
                continue
            others, rows = [row for row in kept() if (row["task"], row["seed"]) != (name, seed)], []
            for row in chain(name, seed):
                rows.append({**row, **about})
                print({key: row[key] for key in row if key != "trials"}, flush=True)
                text = "".join(json.dumps(row) + "\n" for row in [*others, *rows])
                RESULTS.write_text(text, encoding="utf-8")


def of(rows: Sequence[dict[str, Any]], task: str, horizon: float, which: str) -> list[dict[str, Any]]:
    """The motions of all seeds that were kept for one reason: "effort" or "load"."""
    return [row[which] for row in rows if (row["task"], row["T"]) == (task, horizon) and which in row]


def hardest(motion: dict[str, Any]) -> float:
    """The largest share of speed and torque-speed; torques are at their limit at some instant of most motions."""
    return max(motion["shares"]["speed"], motion["shares"]["torque-speed"])


def table(rows: Sequence[dict[str, Any]], task: str) -> str:
    """One row for each duration: least effort of all seeds, and the motion that keeps farthest from the limits."""
    lines = []
    for horizon in DURATIONS:
        asked = [row for row in rows if (row["task"], row["T"]) == (task, horizon)]
        if not asked:
            continue
        thrifty, gentle = of(rows, task, horizon, "effort"), of(rows, task, horizon, "load")
        cells = [f"{horizon:g} s", f"{len(gentle)} of {len(asked)}"]
        if gentle:
            best = min(gentle, key=hardest)
            cells.append(f"{min(one['effort'] for one in thrifty):.2f}")
            cells += [f"{best['shares'][kind]:.2f}" for kind in SHARES]
            cells.append(", ".join(f"{hardest(one):.2f}" for one in sorted(gentle, key=hardest)))
            cells += [f"{sum(one['stays'] for one in gentle)} of {len(gentle)}"] if task != "rearing" else []
        else:
            cells += [""] * (5 if task == "rearing" else 6)
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def front(rows: Sequence[dict[str, Any]], task: str) -> list[tuple[float, float, dict[str, float]]]:
    """T, least effort and the shares of the gentlest motion of all seeds, where a longer T may wait, before or after."""
    found: list[tuple[float, float, dict[str, float]]] = []
    thrifty, gentle = [], []
    for horizon in DURATIONS:
        thrifty += [(horizon, one) for one in of(rows, task, horizon, "effort")]
        gentle += of(rows, task, horizon, "load")
        if gentle:
            effort = min(one["effort"] + one["standing"] * (horizon - own) for own, one in thrifty)
            found.append((horizon, effort, min(gentle, key=hardest)["shares"]))
    return found


def conclusion(rows: Sequence[dict[str, Any]]) -> str:
    """What the front says of 0.3 s and 3 s, and the shortest T within the limits, for each task that has results."""
    said = []
    for task, does in (("rearing", "Rearing"), ("posture-recovery", "Recovery")):
        line = {horizon: (effort, shares) for horizon, effort, shares in front(rows, task)}
        within = [T for T, (_, shares) in line.items() if max(shares["speed"], shares["torque-speed"]) <= 1]
        if 0.3 not in line or 3.0 not in line:
            continue
        effort, shares = line[0.3]
        own = min(one["effort"] for one in of(rows, task, 3.0, "effort"))
        least = f"{within[0]:g} s" if within else "none of these"
        said.append(
            f"- **{does}** in 0.3 s needs {shares['speed']:.2f} of the speed limit and {shares['torque-speed']:.2f} of the"
            f" torque–speed line at best, and an effort of {effort:.2f} s. The shortest T for which a motion within both was"
            f" found is {least}. Of the motions found at 3 s the least effort is {own:.2f} s; a shorter one, and standing for"
            f" the rest of 3 s, takes {line[3.0][0]:.2f} s."
        )
    return "\n".join(said)


def drawing(rows: Sequence[dict[str, Any]]) -> Any:
    """The figure: a row for each task; effort, and shares of limits, over T."""
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from levade.report.figures import PAGE as WIDTH
    from levade.report.style import LIGHT

    looks = {
        "speed": {"color": LIGHT.z, "marker": "o", "linestyle": "-"},
        "torque": {"color": LIGHT.x, "marker": "s", "linestyle": (0, (4, 1.6))},
        "torque-speed": {"color": LIGHT.y, "marker": "^", "linestyle": (0, (1.2, 1.2))},
    }
    figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    grid = figure.subplots(2, 2, sharex=True)
    for (effort, share), task in zip(grid, ("rearing", "posture-recovery"), strict=True):
        line = front(rows, task)
        curve(
            effort,
            [(T, one["effort"]) for T in DURATIONS for one in of(rows, task, T, "effort")],
            [(T, least) for T, least, _ in line],
            {"color": LIGHT.ink, "marker": "o", "linestyle": "-"},
        )
        for kind, look in looks.items():
            points = [(T, one["shares"][kind]) for T in DURATIONS for one in of(rows, task, T, "load")]
            curve(share, points, [(T, shares[kind]) for T, _, shares in line], look)
        top = max(1.15, 1.06 * share.get_ylim()[1])
        share.axhspan(1.0, top, facecolor=LIGHT.limit, alpha=0.22, linewidth=0, zorder=0.5)
        share.axhline(1.0, color=LIGHT.limit, linewidth=0.7, zorder=1)
        share.set_ylim(0.0, top)
        effort.set_ylim(0.0, None)
        effort.set_ylabel("effort [s]")
        share.set_ylabel("share of the limit")
        effort.set_title(f"{task}: least effort", fontweight="bold")
        share.set_title(f"{task}: farthest from the limits", fontweight="bold")
        note(share, "beyond the limit", (0.94, 1.0), ("axes fraction", "data"), (0, 3), "right", LIGHT.limit)
        tried = {row["T"] for row in rows if row["task"] == task}
        failed = [T for T in DURATIONS if T in tried and not of(rows, task, T, "load")]
        for axes in (effort, share):
            axes.plot(
                *(failed, [0.04] * len(failed)),
                transform=axes.get_xaxis_transform(),
                linestyle="",
                marker="x",
                markersize=5,
                color=LIGHT.bad,
            )
            for T, reading, side in ((0.3, "paper", "left"), (3.0, "its code", "right")):
                axes.axvline(T, color=LIGHT.muted, linewidth=0.6, dashes=(1, 2), zorder=1)
                shift = (2 if side == "left" else -2, -8)
                note(axes, reading, (T, 1.0), ("data", "axes fraction"), shift, side, LIGHT.muted)
    for axes in grid[1]:
        axes.set_xscale("log")
        axes.set_xticks(DURATIONS, [f"{T:g}" for T in DURATIONS])
        axes.minorticks_off()
        axes.set_xlabel("duration T [s]")
    handles = [
        Line2D([], [], label="effort", color=LIGHT.ink, marker="o", markersize=4),
        *(Line2D([], [], label=kind.replace("-", "–"), markersize=4, **look) for kind, look in looks.items()),
        Line2D([], [], label="no seed reached the goal", color=LIGHT.bad, marker="x", linestyle=""),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    return figure


def note(axes: Any, text: str, place: Any, coordinates: Any, shift: tuple[int, int], side: str, colour: str) -> None:
    """A small word at a place."""
    axes.annotate(
        *(text, place),
        xycoords=coordinates,
        xytext=shift,
        textcoords="offset points",
        ha=side,
        color=colour,
        fontsize=6.5,
    )


def curve(axes: Any, points: Sequence[tuple[float, float]], line: Sequence[tuple[float, float]], look: dict) -> None:
    """Every seed as a point, and the front as a line."""
    axes.plot(*zip(*line, strict=True) if line else ([], []), color=look["color"], linestyle=look["linestyle"])
    axes.plot(
        *(zip(*points, strict=True) if points else ([], [])),
        linestyle="",
        marker=look["marker"],
        markersize=3.4,
        color=look["color"],
        zorder=3,
        markeredgecolor="white",
        markeredgewidth=0.4,
    )


def page() -> str:
    """The page, from the template and the results of this script and of freedom.py."""
    import freedom

    rows = kept()
    seeds = " and ".join(
        f"{len({row['seed'] for row in rows if row['task'] == task})}" for task in ("rearing", "posture-recovery")
    )
    found = {name: sorted({row["versions"][name] for row in rows}) for name in (rows[0]["versions"] if rows else ())}
    made = ", ".join(f"{name} {' and '.join(versions)}" for name, versions in found.items()) or "nothing"
    filled = {
        "@REARING@": table(rows, "rearing"),
        "@RECOVERY@": table(rows, "posture-recovery"),
        "@CONCLUSION@": conclusion(rows),
        "@SEEDS@": seeds,
        "@MADE@": made,
        "@FREE@": freedom.duration_table(),
        "@GRID@": freedom.grid_table(),
        "@POSTURE@": freedom.posture_table(),
    }
    text = (HERE / "duration.md.in").read_text(encoding="utf-8")
    for place, content in filled.items():
        text = text.replace(place, content)
    return text


def write() -> None:
    """The figure and the page."""
    import small_figure

    rows = kept()
    small_figure.save(lambda: drawing(rows), PAGE.parent / FIGURE)
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=["rearing", "posture-recovery"])
    parser.add_argument("--seeds", nargs=2, type=int, default=(0, 3))
    parser.add_argument("--write", action="store_true", help="only write the page and its figure")
    arguments = parser.parse_args()
    if not arguments.write:
        os.environ["OPENBLAS_NUM_THREADS"] = "1"
        run(arguments.tasks, range(*arguments.seeds))
    write()


if __name__ == "__main__":
    main()
