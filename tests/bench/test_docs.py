"""What docs/bench.md shows, done literally."""

from __future__ import annotations

import dataclasses
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import levade
from levade.bench import Plan
from levade.bench.plan import cases
from levade.bench.results import COLUMNS
from levade.document import build
from levade.optimizers import OPTIMIZERS

TEXT = (Path(__file__).parents[2] / "docs" / "bench.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    return next(iter(re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)))


@pytest.mark.slow
def test_the_plan_is_one() -> None:
    plan = build(Plan, yaml.safe_load(block("yaml")), where="docs/bench.md")
    found = cases(dataclasses.replace(plan, tasks=("rearing",)))
    assert len(found) == 60
    assert {case.task.horizon for case in found} == {0.4}


def test_it_names_every_optimizer_and_every_column() -> None:
    assert [name for name in OPTIMIZERS if f"`{name}`" not in TEXT] == []
    words = TEXT.replace("-", "_").replace(" ", "_")
    missing = [name for name in COLUMNS if name.removesuffix("_to_success") not in words]
    assert missing == []


@pytest.mark.slow
def test_the_python_example_runs(tmp_path: Path) -> None:
    script = tmp_path / "example.py"
    script.write_text(block("python").replace("trials=400", "trials=34"))
    environment = {**os.environ, "PYTHONPATH": str(Path(levade.__file__).parents[1])}
    done = subprocess.run([sys.executable, str(script)], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.stderr == ""
    assert [line.split()[0] for line in done.stdout.splitlines()] == ["cma", "pi2"]
    assert (tmp_path / "out/bench/trials.pdf").exists()
