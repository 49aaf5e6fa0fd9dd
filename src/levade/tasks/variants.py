"""Variants of a task: the same goal on robots that differ from the model, or within the robot's limits, too.

    load_task("rearing-robust")                   # as `levade solve rearing-robust` does
    load_task("squat-jump-within-limits", robot="my.urdf")

Every task has them. `levade.tasks.plan` makes them: one search of two stages, on the nominal model first and then on perturbed
models. A task file says under ``variants`` only what else differs, as it does for stances:

    variants:
      robust:
        success: {roll: {target: 0, tolerance: 0.1}}

Changes of what the motion has to do are made in the task, before anything follows from its criteria. All of them are made in
the result, so they win over the plan. What ``robust`` says of the motion, but not of the search, also holds within limits.
``keep: [costs, policy]`` keeps these tables of the task instead of the plan's; of costs, the plan then only adds those of
margins and of the duration. A file of one's own is a variant if it extends another task and says ``variant: robust``, or
extends a variant.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from levade.document import kind_of
from levade.errors import LevadeError, did_you_mean
from levade.robots import Robot
from levade.tasks.demands import Demands
from levade.tasks.files import BY_STANCE, BY_VARIANT, EXTENDS, VARIANT, VARIANTS, extended
from levade.tasks.plan import LONGEST, Plan
from levade.tasks.stances import for_stance
from levade.tasks.task import Task

ABOUT = {
    "robust": "on robots that differ from the model",
    "within-limits": "on robots that differ from the model, within the limits that the robot's file gives, in up to"
    f" {LONGEST:g} times the time",
}
"""Variant -> what its description adds to that of the task."""

KEEP, KEPT = "keep", ("costs", "policy")
"""Key of a variant's changes, and the tables of the task that it may name."""

OF_SEARCH = ("search", "stages", "robust", "feedback")
"""Keys of a task that say how to search, and not what the motion has to do."""

_ADDED = ("duration", "margins")
"""Costs that the plan adds where a variant keeps those of the task."""

_DEMANDS = {"robust": Demands.robust(), "within-limits": Demands()}
"""Variant -> the demands that its plan is made for."""


def check_variants(content: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Check the tables of variants and leave them out.

    Args:
        content: The tables of a task.
        where: Place of the tables, for messages.

    Returns:
        The tables without ``variant`` and ``variants``.

    Raises:
        LevadeError: If a variant does not exist, or its changes are no table.
    """
    content = dict(content)
    content.pop(VARIANT, None)
    variants = content.pop(BY_VARIANT, {})
    if not isinstance(variants, Mapping):
        raise LevadeError(
            f"{where}.{BY_VARIANT}: should be a table such as {{robust: {{...}}}}, is {kind_of(variants)}"
        )
    for name, changes in variants.items():
        if name not in VARIANTS:
            raise LevadeError(f"{where}.{BY_VARIANT}: no variant {name!r}; {did_you_mean(str(name), VARIANTS)}")
        if not isinstance(changes, Mapping):
            raise LevadeError(f"{where}.{BY_VARIANT}.{name}: should be a table of changes, is {kind_of(changes)}")
    return content


@dataclass(frozen=True)
class Changes:
    """What a variant changes.

    Attributes:
        goal: Changes of what the motion has to do, in which a cost or a criterion may be null.
        own: Changes of what the plan makes.
        keep: Tables of the task that stay instead of the plan's.
    """

    goal: dict[str, Any]
    own: dict[str, Any]
    keep: tuple[str, ...]


def variant_changes(content: Mapping[str, Any], robot: Robot, where: str) -> Changes:
    """Find what the variant of some tables changes on a robot.

    Within limits, the motion has to do what it has to in the robust variant.

    Args:
        content: The tables, with ``variant``.
        robot: The robot.
        where: Place of the tables, for messages.

    Returns:
        The changes.

    Raises:
        LevadeError: If its stances make no sense, it does not apply to the robot, or it keeps what it cannot.
    """

    def of(variant: str) -> dict[str, Any]:
        changes = dict(content.get(BY_VARIANT, {}).get(variant, {}))
        return for_stance(changes, robot, where, nulls=True) if BY_STANCE in changes else changes

    variant = content[VARIANT]
    own = of(variant)
    if "robot" in own:
        raise LevadeError(f"{where}.{BY_VARIANT}.{variant}.robot: a variant has the robot of its task; leave it out")
    goal = extended(of(VARIANTS[0]), own, nulls=True)
    keep = goal.pop(KEEP, [])
    if not isinstance(keep, list):
        raise LevadeError(
            f"{where}.{BY_VARIANT}.{variant}.{KEEP}: should be a list such as [costs], is {kind_of(keep)}"
        )
    for name in keep:
        if name not in KEPT:
            hint = did_you_mean(str(name), KEPT)
            raise LevadeError(f"{where}.{BY_VARIANT}.{variant}.{KEEP}: {name!r} cannot be kept; {hint}")
    return Changes(
        {key: value for key, value in goal.items() if key not in OF_SEARCH},
        {key: value for key, value in own.items() if key not in (KEEP, "description")},
        tuple(keep),
    )


def described(description: str, variant: str) -> str:
    """Describe a variant in one line.

    Args:
        description: Description of the task.
        variant: One of `VARIANTS`.
    """
    about = ABOUT[variant]
    return description if not description or description.endswith(about) else f"{description}, {about}"


def planned(task: Task, variant: str, robot: Robot, *, keep: Collection[str] = ()) -> Task:
    """Make a variant of a task.

    Args:
        task: The task, on the robot.
        variant: One of `VARIANTS`.
        robot: The robot.
        keep: Tables of the task to keep, of `KEPT`.

    Returns:
        The variant, with the task's name.

    Raises:
        LevadeError: If the task has no criteria.
    """
    if not task.success:
        raise LevadeError(f"{VARIANT}: the task {task.name} has no success criteria to plan for; add some to the task")
    made = Plan.of(task, robot, _DEMANDS[variant]).in_one_search()
    added = {name: made.costs[name] for name in _ADDED if name in made.costs}
    return replace(
        made,
        costs={**task.costs, **added} if "costs" in keep else made.costs,
        policy=task.policy if "policy" in keep else made.policy,
    )


def variant_text(name: str, task: str, variant: str, text: str) -> str:
    """Write the file that has the same meaning as a variant's name, to start one's own from.

    Args:
        name: Name of the variant.
        task: Name of its task.
        variant: One of `VARIANTS`.
        text: Text of the task's file. What it says of its variants is quoted.

    Returns:
        The text.
    """
    head = (
        f"# {task} {ABOUT[variant]}.\n"
        f"# Costs, stages and search follow from the criteria of {task}; what you add here wins over that.\n"
        f"# All of it: levade tasks show {name} --full\n"
        f"name: {name}\n{EXTENDS}: {task}\n{VARIANT}: {variant}\n"
    )
    said = re.search(rf"^{BY_VARIANT}:.*\n((?:[ ].*)?\n)*", text, re.MULTILINE)
    if said is None:
        return head
    quoted = re.sub("^", "# ", said[0].rstrip(), flags=re.MULTILINE)
    return f"{head}\n# {task} says of its variants:\n#\n{quoted}\n"
