"""What a command line loads before it does anything: nothing that takes long and is not needed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HEXAPOD = str(Path(__file__).parents[1] / "benchmarks" / "robots" / "hexapod.xml")
"""A robot whose postures are searched."""


def loaded(program: str) -> set[str]:
    """Names of the modules that a fresh interpreter has loaded after a program."""
    program += "\nimport sys; print('\\n'.join(name for name, module in sys.modules.items() if module is not None))"
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    return set(done.stdout.split())


def test_help_and_version_need_neither_physics_nor_arrays() -> None:
    assert not loaded("import levade.cli") & {"numpy", "mujoco", "cma", "yaml"}


@pytest.mark.slow
def test_a_solve_needs_no_figures() -> None:
    """cma imports pyplot where it is installed, which takes longer than everything else together."""
    pytest.importorskip("matplotlib")
    needed = loaded(f"from levade.robots import load_robot; load_robot({HEXAPOD!r}); import levade.cli.solving")
    assert {"cma", "mujoco"} <= needed
    assert not needed & {"matplotlib", "matplotlib.pyplot", "scipy", "pyarrow", "PIL", "trimesh"}


@pytest.mark.slow
def test_a_library_on_this_computer_needs_no_cluster() -> None:
    needed = loaded("import levade.cli.librarian")
    assert "levade.library.spreading" in needed
    assert "ray" not in needed


@pytest.mark.slow
def test_figures_can_be_made_after_it() -> None:
    pytest.importorskip("matplotlib")
    assert "matplotlib.pyplot" in loaded("import levade.optimizers; from matplotlib import pyplot")
    assert "cma" in loaded("import matplotlib; import levade.optimizers; assert matplotlib.__version__")
