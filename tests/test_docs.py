"""What the documents show, done literally."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from levade.search import make_objective, solve
from levade.tasks import TERMS, task_from_dict

ROOT = Path(__file__).parents[1]


def block(document: str, language: str, containing: str) -> str:
    """The first code block of a language in a document that contains a text."""
    blocks = re.findall(rf"```{language}\n(.*?)```", (ROOT / document).read_text(encoding="utf-8"), re.DOTALL)
    return next(found for found in blocks if containing in found)


@pytest.mark.slow
def test_the_task_in_the_documentation_is_solved() -> None:
    task = task_from_dict(yaml.safe_load(block("docs/tasks.md", "yaml", "bow")), where="docs/tasks.md")
    assert solve(make_objective(task), seed=0).success


def test_the_documentation_lists_every_term() -> None:
    text = (ROOT / "docs/tasks.md").read_text(encoding="utf-8")
    assert [term for term in TERMS if f"`{term}`" not in text] == []


@pytest.mark.slow
def test_the_python_example_of_the_readme_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(block("README.md", "python", "import levade"), "README.md", "exec"), {})
    first, shape, second = capsys.readouterr().out.splitlines()
    assert first.startswith("True {'pitch': ")
    assert shape == "(150, 12)"
    assert second.startswith("Result(success at trial ")
    assert (tmp_path / "rearing.npz").is_file()


@pytest.mark.slow
def test_the_replay_of_the_documentation_gives_the_motion_in_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import numpy as np

    from levade.search.run import run
    from levade.tasks import load_task

    monkeypatch.chdir(tmp_path)
    run(load_task("rearing", changes=["search.trials=34"]), seed=0, directory=Path("rearing"))
    scope: dict = {}
    exec(compile(block("docs/motion-file.md", "python", "mj_step"), "docs/motion-file.md", "exec"), scope)
    data, state = scope["data"], scope["state"]
    np.testing.assert_array_equal(state.qpos[:3], data["trunk_position"][-1])
    np.testing.assert_array_equal(state.qvel[:3], data["trunk_linear_velocity"][-1])


def follow(document: str, folder: Path) -> None:
    """Do what a document says, in one folder, which is the working directory.

    YAML is written under the name in its first line, commands and Python run as they stand; ``text`` is what they say.
    Pictures (``bash picture``) are left out where there is no OpenGL.
    """
    text = (ROOT / document).read_text(encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
    run = f'"{sys.executable}"'
    prelude = f'set -e; levade() {{ {run} -m levade "$@"; }}; python() {{ {run} "$@"; }}\n'
    scope: dict = {}
    for language, code in re.findall(r"```(\w+(?: picture)?)\n(.*?)```", text, re.DOTALL):
        if language == "yaml":
            (folder / code.split()[1]).write_text(code)
        elif language.startswith("bash"):
            done = subprocess.run(["bash", "-c", prelude + code], env=environment, capture_output=True, text=True)
            drawn = not ("picture" in language and ("OpenGL" in done.stderr or "pillow" in done.stderr))
            assert done.returncode == 0 or not drawn, f"{code}{done.stdout}{done.stderr}"
        elif language == "python":
            exec(compile(code, document, "exec"), scope)


@pytest.mark.slow
def test_your_task_step_by_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    follow("docs/your-task.md", tmp_path)
    assert capsys.readouterr().out.startswith("True ")
    assert {"mine.yaml", "task.schema.json", "bow", "bow-outdoors", "gentle.npz", "gentle.html"} <= {
        path.name for path in tmp_path.iterdir()
    }


@pytest.mark.slow
def test_your_robot_step_by_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    follow("docs/your-robot.md", tmp_path)
    assert capsys.readouterr().out.startswith("pony ('fl_hip', 'fl_thigh', 'fl_knee') 17.2 kg, 0.344 m high\n")
    assert {"pony.html", "jump", "robot.yaml"} <= {path.name for path in tmp_path.iterdir()}
    (tmp_path / "robot.yaml").unlink()
    said = next(iter(re.findall(r"```text\n(.*?)```", (ROOT / "docs/your-robot.md").read_text(), re.DOTALL)))
    command = [sys.executable, "-m", "levade", "robots", "inspect", "pony.urdf"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
    assert said in subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout


@pytest.mark.slow
def test_get_started_step_by_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    follow("docs/get-started.md", tmp_path)
    assert "120\n" in capsys.readouterr().out
    assert {"rearing", "lower", "mine.yaml", "from-python.npz"} <= {path.name for path in tmp_path.iterdir()}
    assert (tmp_path / "rearing" / "report.html").is_file()


@pytest.mark.slow
def test_rightability_step_by_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("scipy", reason="hulls need scipy: pip install 'levade[rightability]'")
    monkeypatch.chdir(tmp_path)
    follow("docs/rightability.md", tmp_path)


def test_the_numbers_of_the_readme_are_those_of_the_results(monkeypatch: pytest.MonkeyPatch) -> None:
    """After new results: python benchmarks/readme.py --write."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    spec = importlib.util.spec_from_file_location("readme_numbers", ROOT / "benchmarks" / "readme.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text == module.with_numbers(text)
    assert text.count("\n") <= 120


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "smaller"),
    [
        ("first_motion", "TRIALS = 60"),
        ("compare_optimizers", "TASK, OPTIMIZERS, SEEDS, TRIALS = 'rearing', ('cma-aimed', 'cem'), 1, 24"),
    ],
)
def test_a_notebook_runs(name: str, smaller: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At reduced size, in a kernel of its own."""
    nbformat = pytest.importorskip("nbformat", reason="notebooks: pip install 'levade[notebooks]'")
    nbclient = pytest.importorskip("nbclient", reason="notebooks: pip install 'levade[notebooks]'")
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "src"))
    notebook = nbformat.read(ROOT / "examples" / "notebooks" / f"{name}.ipynb", as_version=4)
    (settings,) = (cell for cell in notebook.cells if "parameters" in cell.metadata.get("tags", []))
    settings.source = smaller
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    shown = {kind for output in outputs for kind in output.get("data", {})}
    assert "image/png" in shown
    if name == "first_motion":
        pages = [output["data"]["text/html"] for output in outputs if "text/html" in output.get("data", {})]
        assert "srcdoc=" in pages[0]
        assert "levade.report();" in pages[0]  # the page's script is in it


def test_citation_and_changelog_are_of_this_version() -> None:
    from levade.version import __version__

    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    released = re.findall(r"^## \[(\d\S*)\] - (\d{4}-\d\d-\d\d)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert citation["version"] == __version__
    assert released[0] == (__version__, str(citation["date-released"]))
