"""Tasks: what a motion has to achieve, read from YAML or built in Python. The built-in ones are YAML files in ``data/``.

task = load_task("rearing", changes=["horizon=0.4"])
task = load_task("rearing-robust")              # a variant, which every task has: `levade.tasks.variants`
task = load_task("my-task.yaml", robot="my/robot.yaml")
"""

from levade.tasks.demands import Demands
from levade.tasks.document import load_task, task_from_dict, task_text
from levade.tasks.files import builtin_tasks, builtin_variants, is_builtin
from levade.tasks.listing import Overview, available_tasks, is_unchanged, overview
from levade.tasks.parts import Change, Cost, HorizonRange, PolicyChoice, RobotChoice, Search, Stage, StartChoice
from levade.tasks.regulation import Regulation
from levade.tasks.robust import Racing, Robust
from levade.tasks.task import Task
from levade.tasks.terms import TERMS
from levade.tasks.validation import looks_at_hold
from levade.tasks.writing import holds_code, task_checksum, task_to_dict, task_to_yaml

__all__ = [
    "TERMS",
    "Change",
    "Cost",
    "Demands",
    "HorizonRange",
    "Overview",
    "PolicyChoice",
    "Racing",
    "Regulation",
    "RobotChoice",
    "Robust",
    "Search",
    "Stage",
    "StartChoice",
    "Task",
    "available_tasks",
    "builtin_tasks",
    "builtin_variants",
    "holds_code",
    "is_builtin",
    "is_unchanged",
    "load_task",
    "looks_at_hold",
    "overview",
    "task_checksum",
    "task_from_dict",
    "task_text",
    "task_to_dict",
    "task_to_yaml",
]
