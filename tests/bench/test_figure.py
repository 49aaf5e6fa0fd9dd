"""The figures of a bench: that they hold what they should, for few and many optimizers, success or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from levade.bench.figure import draw
from levade.errors import LevadeError

pytest.importorskip("matplotlib", reason="needs the extra bench")


def several(make) -> list:
    names = [f"optimizer-{k}" for k in range(11)]
    return [
        make(None if k == 10 or seed > k else 100 * (k + 1) + 17 * seed, seed=seed, optimizer=name, task=task)
        for task in ("rearing", "posture-recovery-slow")
        for k, name in enumerate(names)
        for seed in range(4)
    ]


@pytest.mark.slow
def test_the_figures_name_tasks_optimizers_and_successes(make, tmp_path: Path) -> None:
    written = draw(several(make), tmp_path / "new", format="svg")
    assert [path.name for path in written] == ["trials.svg", "steps.svg"]
    text = written[0].read_text()
    for words in ("rearing on hyq2max", "posture-recovery-slow on hyq2max", "optimizer-10", "1/4", "no success"):
        assert f"<!-- {words} -->" in text, words
    assert "<!-- expected trials to success -->" in text
    assert "<!-- expected physics steps to success -->" in written[1].read_text()


@pytest.mark.slow
@pytest.mark.parametrize("format", ["pdf", "svg", "png"])
def test_the_same_results_give_the_same_bytes(make, tmp_path: Path, format: str) -> None:
    one, other = (draw([make(200), make(300, seed=1)], tmp_path / name, format=format) for name in "ab")
    for first, second in zip(one, other, strict=True):
        assert first.read_bytes() == second.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        {"trials_to_success": None},
        {"trials_to_success": 1, "trials": 1},
        {"cost": -3.0},
        {"cost": 0.0},
        {"budget_steps": 10**6},
        {"cost": 1e12},
    ],
)
def test_it_draws_whatever_came_out(make, tmp_path: Path, changes: dict) -> None:
    """Warnings are errors: a layout that does not fit, a logarithm of zero."""
    first = changes.pop("trials_to_success", 200)
    draw([make(first, **changes), make(first, seed=1, optimizer="cem", **changes)], tmp_path, format="png")


def test_an_unknown_format(make, tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match=r"format jpg: unknown; did you mean png\?"):
        draw([make()], tmp_path, format="jpg")
