"""``levade solve``: run a search, show its progress, and print its result."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.markup import escape

from levade.cli.display import Display
from levade.cli.doubts import binding_limits, in_other_numbers, tell_numerics, tell_unknown_limits
from levade.cli.inspecting import tell_warnings
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console, motion_summary
from levade.cli.watching import Watching, watched
from levade.errors import located
from levade.motions import Motion
from levade.robots.findings import counted
from levade.search import Generation, Objective, Stopped, make_objective
from levade.search.initial import initial_guess
from levade.search.memory import in_words, needed
from levade.search.objective import AT_ONCE
from levade.search.optimizing import make_attempt
from levade.search.run import MOTION, PURSUIT, Outcome, check_replaceable, check_unlocked, read_run, resume, run
from levade.tasks import HorizonRange, load_task

if TYPE_CHECKING:
    from levade.checks import Numeric


def solve_and_report(
    *,
    task: str | None,
    robot: str | None,
    seed: int,
    changes: list[str],
    begin: list[Path],
    after: Path | None,
    directory: Path | None,
    resume_from: Path | None,
    force: bool,
    threads: int,
    watching: Watching | None,
    as_json: bool,
) -> int:
    """Search for a motion and print the result.

    Args:
        task: Name of the task, or its file. Not used with ``resume_from``.
        robot: Name of the robot, or its file. None for the task's own.
        seed: Seed of the search.
        changes: Changes of the task, as ``path=value``.
        begin: Files of motions. The search begins around the best one.
        after: File of a motion at whose end the task starts. None for the task's own start.
        directory: Directory to write. None for one named after the task.
        resume_from: Directory of an interrupted run to continue. None for a new one.
        force: Whether to replace an interrupted run in the directory.
        threads: Number of engine threads (0: one per core).
        watching: Options of the page to watch the search on. None for no page.
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if the success criteria hold, else 1.
    """
    # with --json, standard output is only for the one object
    console = make_console(stderr=as_json)
    quiet = as_json and not console.is_terminal
    earlier: list[Motion] = []
    replayed, replaces = 0, False
    # errors in the input are raised before the display opens
    if resume_from is not None:
        check_unlocked(resume_from)
        chosen, checkpoint = read_run(resume_from)
        seed, out = checkpoint.header.seed, resume_from
        objective = make_objective(chosen, threads=threads)
        go = functools.partial(resume, out, objective=objective)
        replayed = sum(one.evaluation.trials for one in checkpoint.records)
        if checkpoint.damage is not None:
            console.print(f"[yellow]warning:[/] {escape(checkpoint.damage)}", soft_wrap=True)
    else:
        assert task is not None
        chosen = load_task(task, robot=robot, changes=changes)
        if after is not None:
            from levade.motions import chaining

            last = Motion.load(after)
            with located(f"{after}: "):
                chosen = chaining.after(chosen, last)
        out = directory or Path(chosen.name)
        if force:
            check_unlocked(out)
            if (out / PURSUIT).exists():
                from levade.hardware import discard

                discard(out)
        else:
            check_replaceable(out)
        replaces = (out / MOTION).exists()
        objective = make_objective(chosen, threads=threads)
        earlier = [Motion.load(path) for path in begin]
        guess = initial_guess(objective.policy, earlier) if earlier else None
        _tell_other_robots(console, begin, earlier, objective.robot.name)
        go = functools.partial(run, objective, seed=seed, directory=out, initial=guess)
    _tell_need(console, objective)
    tell_warnings(console, objective.robot, objective.task.robot.name)
    tell_unknown_limits(console, objective.task, objective.robot.limits)
    if replayed and not quiet:
        console.print(f"Replaying {counted(replayed, 'trial')} of the earlier run ...")
    with ExitStack() as stack:
        stopping = stack.enter_context(stop_between("generation"))
        watch = None
        if watching is not None:
            page = watched(watching, console, objective, seed=seed, directory=out, interrupted=stopping)
            watch = stack.enter_context(page)
        note = (lambda: "") if watch is None else (lambda: watch.note)
        with Display(console, chosen, quiet=quiet, note=note) as display:

            def observe(generation: Generation) -> Stopped | None:
                display.update(generation)
                if watch is not None:
                    watch.observe(generation)
                return Stopped.INTERRUPTED if stopping() else None

            outcome = go(observe=observe, steer=None if watch is None else watch.steer)
        if watch is not None:
            watch.finish(outcome)
        numerics = in_other_numbers(outcome.motion)
        if as_json:
            content = {**summary(outcome, numerics), **_warm(outcome, earlier)}
            print(json.dumps(content, ensure_ascii=False), flush=True)
        else:
            _tell(console, outcome, earlier, numerics, replayed=replayed, replaces=replaces)
    return 0 if outcome.motion.result.success else 1


def _tell_other_robots(console: Console, paths: list[Path], earlier: list[Motion], robot: str) -> None:
    """Print a line for each motion to begin around that another robot made."""
    for path, motion in zip(paths, earlier, strict=True):
        if motion.robot != robot:
            console.print(
                f"[yellow]--from {escape(str(path))}:[/] is a motion of {escape(motion.robot)}; its angles are taken joint by"
                f" joint and may mean something else on {escape(robot)}",
                soft_wrap=True,
            )


def _tell_need(console: Console, objective: Objective) -> None:
    """Say before a search if a generation does not fit into memory at once."""
    task = objective.task
    population = make_attempt(task, objective.space, seed=0).population
    need = needed(objective.engine, task.horizon_steps + task.hold_steps)
    if need.at_once is not None and need.at_once < min(population, AT_ONCE):
        console.print(
            f"A generation of {population} trials needs {in_words(population * need.trial)} of memory, but only"
            f" {in_words(need.free or 0)} are free: it is simulated {need.at_once} trials at a time, with the same results."
        )


def summary(outcome: Outcome, numerics: Mapping[str, Numeric]) -> dict[str, object]:
    """Return the object that ``solve --json`` prints.

    Args:
        outcome: Outcome of the search.
        numerics: Name -> result with other numerics.

    Returns:
        The object. Times are in seconds.
    """
    solution, motion, result = outcome.solution, outcome.motion, outcome.motion.result
    return {
        "task": motion.task_name,
        "robot": motion.robot,
        "seed": outcome.seed,
        "horizon": motion.horizon,
        "success": result.success,
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "wall_s": round(outcome.wall, 3),
        "cost": result.cost,
        "cost_terms": result.cost_terms,
        "errors": result.errors,
        "feedback": motion.stabiliser is not None,
        "numerics": {name: one.to_json() for name, one in numerics.items()},
        "stopped": str(solution.stopped),
        "diverged": solution.diverged,
        "out": str(outcome.directory),
    }


def _warm(outcome: Outcome, earlier: list[Motion]) -> dict[str, object]:
    """Return what ``--json`` adds for a search that began around earlier motions."""
    if not earlier:
        return {}
    took = [motion.result.trials_to_success for motion in earlier]
    return {"from_trials_to_success": took, "trials_saved": _saved(outcome, earlier)}


def _saved(outcome: Outcome, earlier: list[Motion]) -> int | None:
    """Return the trials to success of the quickest earlier motion, minus those of this search."""
    took = [trials for motion in earlier if (trials := motion.result.trials_to_success) is not None]
    now = outcome.solution.trials_to_success
    return min(took) - now if took and now is not None else None


def _tell(
    console: Console,
    outcome: Outcome,
    earlier: list[Motion],
    numerics: Mapping[str, Numeric],
    *,
    replayed: int,
    replaces: bool,
) -> None:
    solution, directory = outcome.solution, escape(str(outcome.directory))
    for part in motion_summary(outcome.motion):
        console.print(part)
    if isinstance(outcome.motion.task.horizon, HorizonRange):
        console.print(f"The search chose T = {outcome.motion.horizon:.3g} s from {outcome.motion.task.horizon}.")
    first = solution.trials_to_success
    spent = f"{solution.trials} trials in {outcome.wall:.1f} s"
    if replayed:
        spent = f"{solution.trials} trials, {replayed} of them replayed, in {outcome.wall:.1f} s of this run"
    if outcome.motion.met_on_the_model_only:
        console.print("All of this is met on the model, but not on enough of the robots that differ from it.")
    if solution.stopped is Stopped.INTERRUPTED:
        console.print(f"[yellow]Interrupted[/] after {spent}. To go on: levade solve --resume {directory}")
    elif outcome.motion.result.success:
        went_on = "it went on to lower the cost: " if _went_on(outcome) else ""
        console.print(f"[green]Success[/] at trial {first}; {went_on}{spent}.")
        if (saved := _saved(outcome, earlier)) is not None and first is not None:
            worth = f"{saved} saved" if saved > 0 else "none saved"
            console.print(f"The motion that it began around took {first + saved} trials: {worth}.")
        tell_numerics(console, numerics, outcome.motion, outcome.directory)
    else:
        binding = binding_limits(outcome.motion)
        advice = (
            f"Limits bind: {escape(' and '.join(binding))}. A longer horizon, or a goal that asks for less, is likelier to help"
            " than another --seed"
            if binding
            else "Another --seed or more --trials may find one"
        )
        console.print(
            f"[red]No success[/] within {spent}. {advice}; {directory}/progress.csv shows how the search went."
        )
    if (feedback := outcome.motion.stabiliser) is not None:
        console.print(
            f"A regulator at {feedback['rate']:g} Hz keeps the robot close to it; levade check says how much that helps."
        )
    if solution.diverged:
        broke = counted(solution.diverged, "trial")
        console.print(f"[yellow]{broke} diverged[/]: their simulations broke down, so they rank last.")
    done = "Replaced" if replaces else "Written"
    console.print(f"{done}: {directory}/motion.npz, task.yaml, progress.csv, checkpoint.jsonl")


def _went_on(outcome: Outcome) -> bool:
    """Whether the search spent trials after its first success, to lower the cost."""
    first, polish = outcome.solution.trials_to_success, outcome.objective.task.search.polish
    return first is not None and outcome.solution.trials > first and polish != 0
