"""What the documents show, done literally."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from levade.solve import Objective, solve
from levade.tasks import TERMS, task_from_dict

ROOT = Path(__file__).parents[1]


def block(document: str, language: str, containing: str) -> str:
    """The first code block of a language in a document that contains a text."""
    blocks = re.findall(rf"```{language}\n(.*?)```", (ROOT / document).read_text(encoding="utf-8"), re.DOTALL)
    return next(found for found in blocks if containing in found)


def test_the_task_in_the_documentation_is_solved() -> None:
    task = task_from_dict(yaml.safe_load(block("docs/tasks.md", "yaml", "kneel")), where="docs/tasks.md")
    assert solve(Objective(task), seed=0).success


def test_the_documentation_lists_every_term() -> None:
    text = (ROOT / "docs/tasks.md").read_text(encoding="utf-8")
    assert [term for term in TERMS if f"`{term}`" not in text] == []


def test_the_python_example_of_the_readme_runs(capsys: pytest.CaptureFixture[str]) -> None:
    code = block("README.md", "python", "from levade.solve import")
    exec(compile(code, "README.md", "exec"), {})
    assert capsys.readouterr().out.startswith("True ")


def test_the_replay_of_the_documentation_gives_the_motion_in_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import numpy as np

    from levade.run import run
    from levade.tasks import load_task

    monkeypatch.chdir(tmp_path)
    run(load_task("rearing", changes=["search.trials=34"]), seed=0, directory=Path("rearing"))
    scope: dict = {}
    exec(compile(block("docs/motion-file.md", "python", "mj_step"), "docs/motion-file.md", "exec"), scope)
    data, state = scope["data"], scope["state"]
    np.testing.assert_array_equal(state.qpos[:3], data["trunk_position"][-1])
    np.testing.assert_array_equal(state.qvel[:3], data["trunk_linear_velocity"][-1])


def test_your_task_step_by_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Files are written under the name in their first line, commands and Python run as they stand, all in one folder."""
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs/your-task.md").read_text(encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
    prelude = f'set -e; levade() {{ "{sys.executable}" -m levade "$@"; }}\n'
    scope: dict = {}
    for language, code in re.findall(r"```(\w+)\n(.*?)```", text, re.DOTALL):
        if language == "yaml":
            (tmp_path / code.split()[1]).write_text(code)
        elif language == "bash":
            subprocess.run(["bash", "-c", prelude + code], env=environment, check=True, capture_output=True)
        else:
            exec(compile(code, "docs/your-task.md", "exec"), scope)
    assert capsys.readouterr().out.startswith("True ")
    assert {"mine.yaml", "task.schema.json", "bow", "bow-outdoors"} <= {path.name for path in tmp_path.iterdir()}
