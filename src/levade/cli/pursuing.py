"""``levade solve --hardware`` and ``--robust``: search until a certificate passes, or say why none does."""

from __future__ import annotations

import json
from contextlib import ExitStack
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from levade.checks import Certificate
from levade.cli.checking import changed, verdict_table
from levade.cli.display import Display
from levade.cli.inspecting import tell_warnings
from levade.cli.pace import Deadline
from levade.cli.stopping import stop_between
from levade.cli.tables import make_console, quantity_unit
from levade.hardware import Part, Plan, Pursued, binding, obstacles, pursue, read_pursuit
from levade.search import Generation
from levade.tasks import Demands, HorizonRange, Task, load_task


def pursue_and_report(
    *,
    task: str | None,
    robot: str | None,
    seed: int,
    changes: list[str],
    directory: Path | None,
    resume_from: Path | None,
    force: bool,
    minutes: float | None,
    robust: bool,
    demand: list[str],
    threads: int,
    as_json: bool,
) -> int:
    """Pursue a motion for hardware and print what was found.

    With ``robust``, the certificate demands nothing of limits. The parameters are the options of the command.

    Args:
        task: Name of the task, or its file. Not used with ``resume_from``.
        robot: Name of the robot, or its file. None for the task's own.
        seed: Seed of the searches.
        changes: Changes of the task, as ``path=value``.
        directory: Directory to write. None for one named after the task.
        resume_from: Directory of an interrupted pursuit to continue. None for a new one.
        force: Whether to replace an interrupted run in the directory.
        minutes: Time for all searches together [min]. None for no limit.
        robust: Whether to demand only that perturbed robots succeed.
        demand: Changes of the demands: files, or ``name=value``.
        threads: Number of engine threads (0: one per core).
        as_json: Whether to print one JSON object.

    Returns:
        The exit status: 0 if the certificate passes, else 1.
    """
    console = make_console(stderr=as_json)
    before: Demands | None = None
    if resume_from is not None:
        chosen, seed, before = read_pursuit(resume_from)
        place = resume_from
    else:
        assert task is not None
        chosen = load_task(task, robot=robot, changes=changes)
        place = directory or Path(chosen.name)
    asked = before or (Demands.robust() if robust else chosen.hardware or Demands())
    demands = changed(asked, demand, option="--demand")
    loaded = chosen.robot.load()
    tell_warnings(console, loaded, chosen.robot.name)
    _tell_goal(console, Plan.of(chosen, loaded, demands))
    with stop_between("generation") as stopping, ExitStack() as stack:
        showing = _Showing(console, Deadline(minutes), quiet=as_json and not console.is_terminal)
        stack.callback(showing.close)
        pursued = pursue(
            chosen,
            robot=loaded,
            seed=seed,
            threads=threads,
            directory=place,
            minutes=minutes,
            demands=demands,
            replace=force,
            observe=showing.observe,
            begin=showing.begin,
            tell=showing.tell,
            stopping=stopping,
        )
    if as_json:
        print(json.dumps(summary(pursued), ensure_ascii=False), flush=True)
    else:
        _tell(console, pursued)
    return 0 if pursued.passed else 1


def summary(pursued: Pursued) -> dict[str, object]:
    """Return the object that ``solve --hardware --json`` prints.

    Args:
        pursued: The outcome of the pursuit.
    """
    motion, certificate = pursued.motion, pursued.certificate
    return {
        "task": motion.task_name,
        "robot": motion.robot,
        "seed": pursued.seed,
        "horizon": motion.horizon,
        "certificate": certificate.to_json(),
        "obstacles": obstacles(pursued),
        "trials": pursued.trials,
        "wall_s": round(sum(part.seconds for part in pursued.parts), 3),
        "feedback": motion.stabiliser is not None,
        "searches": [
            {
                "name": part.name,
                "trials": part.trials,
                "seconds": round(part.seconds, 3),
                "success": part.motion.result.success,
                "horizon": part.motion.horizon,
                "share": None if part.certificate is None else part.certificate.perturbed.share,
                "failed": None if part.certificate is None else list(part.certificate.failed),
            }
            for part in pursued.parts
        ],
        "stopped": pursued.stopped,
        "out": str(pursued.directory),
    }


class _Showing:
    """A display for each search in turn, and a line for each certificate."""

    def __init__(self, console: Console, deadline: Deadline, *, quiet: bool) -> None:
        self._console, self._deadline, self._quiet = console, deadline, quiet
        self._display: Display | None = None

    def begin(self, name: str, task: Task) -> None:
        self._display = Display(self._console, task, quiet=self._quiet, deadline=self._deadline)
        self._display.__enter__()

    def observe(self, name: str, generation: Generation) -> None:
        if self._display is not None:
            self._display.update(generation)

    def tell(self, part: Part) -> None:
        self.close()
        if self._quiet:
            return
        found = "it does not keep the limits" if part.certificate is None else _found(part.certificate)
        left = self._deadline.left
        self._console.print(
            f"{part.name}: {part.trials} trials, {part.seconds:.0f} s, T = {part.motion.horizon:.3g} s; {found}"
            + (f"; {left}" if left else "")
        )

    def close(self) -> None:
        """Close the display of the current search, if any."""
        if self._display is not None:
            self._display.__exit__(None, None, None)
            self._display = None


def _found(certificate: Certificate) -> str:
    """Return the outcome of a certificate, in markup."""
    if certificate.interrupted:
        return "the certificate was interrupted"
    if certificate.passed:
        return f"the certificate [green]passes[/]: {certificate.perturbed.share:.1%} of perturbed robots"
    return f"the certificate fails {escape(', '.join(certificate.failed))}"


def _tell_goal(console: Console, plan: Plan) -> None:
    """Print the demands that the task does not state itself."""
    horizon = plan.within_limits().horizon
    if isinstance(horizon, HorizonRange) and horizon != plan.task.horizon:
        console.print(
            f"On hardware: T may be {horizon}, and the motion has to keep the limits of {escape(plan.robot.name)}."
        )
    for name, (asked, enough) in plan.loosened.items():
        unit = quantity_unit(asked.quantity)
        if asked.tolerance is None or enough.tolerance is None:
            said = f"{enough.wording} is good enough; the task says {asked.wording}"
            console.print(f"On perturbed robots {escape(name)}: {said}.")
            continue
        within = f"{enough.tolerance:.3g} {unit}; the task says {asked.tolerance:.3g} {unit}"
        console.print(f"On hardware {escape(name)} is good enough within {within}.")


def _tell(console: Console, pursued: Pursued) -> None:
    console.print(verdict_table(pursued.certificate))
    console.print()
    spent = f"{pursued.trials} trials in {sum(part.seconds for part in pursued.parts):.0f} s"
    place = escape(str(pursued.directory))
    if binds := binding(pursued.certificate):
        console.print(f"{escape(binds)}.")
    if pursued.motion.stabiliser is not None:
        console.print(f"A regulator at {pursued.motion.stabiliser['rate']:g} Hz keeps the robot close to it.")
    if pursued.passed:
        unknown = ", ".join(pursued.certificate.unknown)
        console.print(f"[green]The certificate passes[/]; {spent}.{escape(unknown and f' Unknown: {unknown}.')}")
    else:
        if pursued.certificate.interrupted:
            console.print(f"The certificate was interrupted and therefore does not pass; {spent}.")
        else:
            console.print(f"[red]The certificate fails[/] after {spent}. The reasons:")
        for text in obstacles(pursued):
            console.print(f"- {escape(text)}")
    if pursued.stopped:
        why = "Interrupted" if pursued.stopped == "interrupted" else "Out of time"
        console.print(f"[yellow]{why}[/]. To go on: levade solve --resume {place}")
    console.print(
        f"Written: {place}/motion.npz, certificate.html, certificate.json, task.yaml, and a run for each search"
    )
