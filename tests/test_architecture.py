"""docs/architecture.md: its picture is the order of the rooms, and its examples do what they say."""

from __future__ import annotations

import importlib
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from levade.costs.quantities import QUANTITIES
from levade.engines import ENGINES
from levade.exports import FORMATS
from levade.optimizers import OPTIMIZERS
from levade.tasks import TERMS

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs/architecture.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


@pytest.fixture
def tables() -> Iterator[None]:
    """Take out what an example adds to the tables of parts."""
    kept = [(table, dict(table)) for table in (TERMS, QUANTITIES, OPTIMIZERS, ENGINES, FORMATS)]
    yield
    for table, rows in kept:
        table.clear()  # type: ignore[attr-defined]
        table.update(rows)  # type: ignore[attr-defined]


@pytest.fixture
def example(tables: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Run an example of the page, by the name in its first line, in an empty folder."""

    def run(name: str) -> ModuleType:
        text = next(block for block in blocks("python") if block.startswith(f"# {name}.py\n"))
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
        monkeypatch.syspath_prepend(tmp_path)
        monkeypatch.chdir(tmp_path)
        monkeypatch.delitem(sys.modules, name, raising=False)
        return importlib.import_module(name)

    yield run
    for name in [name for name in sys.modules if name.startswith("own_")]:
        del sys.modules[name]


def test_the_picture_is_the_order_that_is_enforced() -> None:
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    layers = next(contract["layers"] for contract in contracts if contract["type"] == "layers")
    assert [re.split(r"\s{2,}", line)[0] for line in blocks("text")[0].splitlines()] == layers


@pytest.mark.parametrize(
    "page", ["README.md", "CONTRIBUTING.md", *sorted(f"docs/{p.name}" for p in PAGE.parent.glob("*.md"))]
)
def test_names_in_the_documents_exist(page: str) -> None:
    text = re.sub(r"```.*?```", "", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    assert [name for name in re.findall(r"`(levade(?:\.\w+)+)", text) if not _exists(name)] == []


def _exists(name: str) -> bool:
    """Whether a dotted name is a module, or an attribute in one."""
    parts = name.split(".")
    for i in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:i]))
        except ModuleNotFoundError:
            continue
        for attribute in parts[i:]:
            if not hasattr(found, attribute):
                return False
            found = getattr(found, attribute)
        return True
    return False


@pytest.mark.slow
def test_a_cost_is_evaluated_by_its_name(example) -> None:
    result = example("own_cost").result
    motion = result.motion
    power = motion["joint_torque"] * motion["joint_velocity"]
    work = np.clip(power[: motion.horizon_steps], 0, None).sum() * motion.timestep
    assert motion.result.cost_terms["work"] == pytest.approx(work)
    assert motion.task.costs["work"].weight == 0.01


@pytest.mark.slow
def test_a_criterion_of_ones_own_is_judged(example) -> None:
    motion = example("own_criterion").result.motion
    assert motion.result.errors["gentle"] == pytest.approx(max(0.0, abs(motion["joint_torque"]).max() - 100.0))


@pytest.mark.slow
def test_an_optimizer_gets_a_name(example) -> None:
    made = example("own_optimizer").result
    assert made.motion.task.search.optimizer == "climb"
    first = made.objective.evaluate(made.objective.space.mean[None])
    assert made.solution.best.cost < first.cost(made.solution.cost_weights)[0]


@pytest.mark.slow
def test_the_velocity_of_the_policy_is_the_derivative_of_its_position(example) -> None:
    made = example("own_policy").result
    reference = made.objective.policy.reference(made.solution.best.weights[None])
    position, velocity = reference.position[0], reference.velocity[0]
    change = (position[2:] - position[:-2]) / (2 * reference.timestep)
    np.testing.assert_allclose(change, velocity[1:-1], atol=2e-2)
    np.testing.assert_array_equal(made.motion["joint_position_reference"], position)


@pytest.mark.slow
def test_the_plain_engine_gives_the_bits_of_the_batch(example) -> None:
    module = example("own_engine")
    assert module.one.motion.provenance.engine == "plain"
    np.testing.assert_array_equal(module.one.motion["joint_position"], module.other.motion["joint_position"])


@pytest.mark.slow
def test_a_format_writes_its_file(example) -> None:
    exported = example("own_format").exported
    angles = np.load(exported.directory / "angles.npy")
    assert exported.written == (exported.directory / "angles.npy",)
    assert angles.shape == (76, 12)  # 0.3 s at 250 Hz


@pytest.mark.slow
def test_the_task_is_solved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from levade.cli import main

    text = blocks("yaml")[0]
    monkeypatch.chdir(tmp_path)
    (tmp_path / text.split()[1]).write_text(text, encoding="utf-8")
    with pytest.raises(SystemExit) as ended:
        main([*blocks("bash")[0].split()[1:], "--trials", "300"])
    assert ended.value.code == 0
