"""Commands of ``levade tasks``."""

from __future__ import annotations

import json
from typing import Annotated, Any

import typer

from levade.cli.commands.options import Json
from levade.errors import LevadeError

tasks_app = typer.Typer(
    help="""List the built-in tasks; print one, or the schema of task files.

    \b
    levade tasks
    levade tasks show rearing > mine.yaml         then edit it: docs/your-task.md
    Next: levade solve mine.yaml
    """,
    rich_markup_mode=None,
)


@tasks_app.callback(invoke_without_command=True)
def _list_tasks(context: typer.Context, as_json: Json = False) -> None:
    from levade.robots import missing_package
    from levade.tasks import builtin_tasks, overview
    from levade.tasks.variants import ABOUT

    if context.invoked_subcommand is not None:
        return
    listed = [overview(name) for name in builtin_tasks()]
    if as_json:
        rows = [
            {
                "name": task.name,
                "description": task.description,
                "robot": task.robot,
                "variants": [f"{task.name}-{variant}" for variant in ABOUT],
            }
            for task in listed
        ]
        _print_json({"tasks": rows})
    else:
        lacks = {robot: missing_package(robot) for robot in {task.robot for task in listed}}
        needs = {robot: "" if lack is None else f" ({lack})" for robot, lack in lacks.items()}
        variants = [(f"NAME-{variant}", f"Any of these, {about}") for variant, about in ABOUT.items()]
        _print_rows([*((task.name, f"{task.description}{needs[task.robot]}") for task in listed), *variants])


@tasks_app.command("show")
def _show_task(
    task: Annotated[str, typer.Argument(help="Name of a built-in task, or a YAML file.")],
    robot: Annotated[str | None, typer.Option(help="Robot instead of the task's, for --full.")] = None,
    full: Annotated[bool, typer.Option("--full", help="Fill in every default, in SI, for the task's robot.")] = False,
) -> None:
    """Print TASK as it was written, to start your own from."""
    from levade.tasks import load_task, task_text, task_to_yaml

    if robot is not None and not full:
        raise LevadeError("tasks show: --robot only works with --full; add --full")
    print(task_to_yaml(load_task(task, robot=robot)) if full else task_text(task), end="")


@tasks_app.command("schema")
def _schema() -> None:
    """Print the JSON schema of task files, for editors."""
    from levade.tasks.schema import task_schema

    print(json.dumps(task_schema(), indent=2, ensure_ascii=False))


def _print_json(content: dict[str, Any]) -> None:
    print(json.dumps(content, ensure_ascii=False))


def _print_rows(rows: list[tuple[str, str]]) -> None:
    width = max(len(name) for name, _ in rows)
    for name, description in rows:
        print(f"{name:<{width}}  {description}")
