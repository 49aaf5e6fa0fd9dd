"""Tests run in a process per core, but in one where they are debugged; their processes share compiled modules."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.conftest import keep_bytecode

pytest.importorskip("xdist", reason="the workers are xdist's: pip install pytest-xdist")

TEST = "import os\n\ndef test_where():\n    print('worker:', os.environ.get('PYTEST_XDIST_WORKER'))\n\ndef never():\n    pass\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "worker"),
    [
        ("-m pytest", "gw0"),
        ("-m pytest --pdb", None),
        ("-m pytest --trace", None),
        ("-m pytest -s", None),
        ("-m pdb -m pytest", None),
        ("-m pytest -n 0", None),
        ("-m pytest -p no:xdist", None),
    ],
)
def test_a_debugger_has_no_workers(tmp_path: Path, command: str, worker: str | None) -> None:
    (tmp_path / "conftest.py").write_text((Path(__file__).parent / "conftest.py").read_text(encoding="utf-8"))
    (tmp_path / "test_it.py").write_text(TEST)
    (tmp_path / ".pdbrc").write_text("break test_it.py:7\ncontinue\n")  # without a breakpoint pdb lets go
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    done = subprocess.run(
        [sys.executable, *command.split(), "-rA"],
        cwd=tmp_path,
        env={**environment, "PYTEST_XDIST_AUTO_NUM_WORKERS": "1"},
        input="continue\nq\n",
        capture_output=True,
        text=True,
        check=False,
    )
    assert f"worker: {worker}" in done.stdout, done.stdout + done.stderr


def test_modules_are_compiled_once_where_python_may_not_keep_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not next to their sources: a process that tests start finds them in pytest's cache."""
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(sys, "pycache_prefix", None)
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    monkeypatch.delenv("PYTHONPYCACHEPREFIX", raising=False)
    keep_bytecode(tmp_path)
    (tmp_path / "module.py").write_text("")
    subprocess.run([sys.executable, "-c", "import module"], cwd=tmp_path, check=True)
    (compiled,) = tmp_path.rglob("module.*.pyc")
    assert compiled.is_relative_to(tmp_path / ".pytest_cache")
    assert not (tmp_path / "__pycache__").exists()
