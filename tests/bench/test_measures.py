"""Expected running time, its interval and the curves, against numbers worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from levade.bench import summarise
from levade.bench.measures import expected_running_time, grouped, spent, success_curve
from levade.bench.table import markdown, number


def test_expected_running_time_counts_the_failures(make) -> None:
    """COCO's: (200 + 400 + 1000 + 1000) / 2."""
    runs = [make(200), make(400, seed=1), make(None, seed=2), make(None, seed=3)]
    amount, success = spent(runs, "trials")
    assert amount.tolist() == [200, 400, 1000, 1000]  # what was polished after the success does not count
    assert success.tolist() == [True, True, False, False]
    assert expected_running_time(amount, success).value == 1300
    assert expected_running_time(*spent(runs, "steps")).value == 150 * 1300
    assert expected_running_time(*spent(runs, "core_seconds")).value == (1.5 + 1.5 + 3.5 + 3.5) / 2


def test_restarting_until_success_spends_the_expected_running_time() -> None:
    """What ERT claims, tried: runs drawn again and again until one succeeds."""
    random = np.random.default_rng(0)
    amount = np.array([100.0, 150, 300, 1000, 1000, 1000])
    success = np.array([True, True, True, False, False, False])
    totals = []
    for _ in range(20_000):
        total = 0.0
        while True:
            k = random.integers(6)
            total += amount[k]
            if success[k]:
                break
        totals.append(total)
    assert expected_running_time(amount, success).value == pytest.approx(np.mean(totals), rel=0.02)


def test_without_success_it_is_infinite() -> None:
    ert = expected_running_time(np.array([10.0, 10.0]), np.array([False, False]))
    assert (ert.value, ert.low, ert.high) == (math.inf, math.inf, math.inf)
    ert = expected_running_time(np.array([10.0, 20.0, 30.0]), np.array([True, False, False]))
    assert ert.value == 60
    assert 10 <= ert.low < 60
    assert ert.high == math.inf  # (2/3)^3 of the samples have no success


@pytest.mark.slow
def test_the_interval_is_the_same_each_time_and_covers_what_it_should() -> None:
    """Of 200 benches of 20 runs from one distribution, about 95 % of the intervals hold its mean."""
    random = np.random.default_rng(1)
    everyone = np.ones(20, dtype=bool)
    inside = 0
    for _ in range(200):
        amount = random.gamma(4.0, 100.0, size=20)
        ert = expected_running_time(amount, everyone)
        assert ert == expected_running_time(amount, everyone)
        assert ert.low <= ert.value <= ert.high
        inside += ert.low <= 400 <= ert.high
    assert 0.86 < inside / 200 < 0.99


def test_the_curve_is_the_share_of_all_runs(make) -> None:
    runs = [make(400), make(200, seed=1), make(None, seed=2), make(200, seed=3)]
    amounts, shares = success_curve(runs, "trials")
    assert amounts.tolist() == [200, 200, 400]
    assert shares.tolist() == [0.25, 0.5, 0.75]
    assert success_curve([make(None)], "steps")[0].size == 0


def test_a_summary_is_of_one_task_robot_and_optimizer(make) -> None:
    results = [make(200 + 100 * seed, seed=seed) for seed in range(4)]
    results += [make(None, optimizer="random", seed=seed) for seed in range(3)]
    results += [make(300, task="jump")]
    assert [(key, list(value)) for key, value in grouped(results).items()] == [
        (("rearing", "hyq2max"), ["cma", "random"]),
        (("jump", "hyq2max"), ["cma"]),
    ]
    first, second, third = summarise(results)
    assert (first.runs, first.successes, first.median, first.least, first.most) == (4, 4, 350, 200, 500)
    assert first.cost == pytest.approx((0.1075, 0.115, 0.1225))
    assert (second.runs, second.successes, second.median) == (3, 0, math.inf)
    assert (third.task, third.runs) == ("jump", 1)
    half = summarise([make(200), make(None, seed=1), make(300, seed=2)])[0]
    assert (half.median, half.most) == (300, math.inf)
    assert summarise([make(200), make(300, seed=1, until="budget")])[0].until == "mixed"


def test_runs_from_before_an_optimizer_had_its_name_are_with_those_from_after(make) -> None:
    before, after = make(200, optimizer="levade"), make(300, optimizer="cma-aimed", seed=1)
    assert grouped([before, after]) == {("rearing", "hyq2max"): {"levade": [before, after]}}
    assert before.key == make(200, optimizer="cma-aimed").key


def test_the_table_in_markdown(make) -> None:
    text = markdown(summarise([make(200), make(None, optimizer="a|b")]))
    lines = text.splitlines()
    assert lines[0] == "## rearing on hyq2max"
    assert lines[4].startswith(
        "| cma | 1/1 | 200 (200 – 200) | 200 [200 – 200] | 30 [30 – 30] | 1.5 [1.5 – 1.5] | 0.1 ("
    )
    assert lines[5].startswith("| a/b | 0/1 | ∞ | ∞ | ∞ | ∞ | 5.1 (")
    assert {line.count("|") for line in lines[2:6]} == {8}
    assert markdown([]) == "no results\n"


def test_numbers() -> None:
    given = (math.inf, 0.0, 7.0, 12345.6, 1.23456, 0.000123456, -3.21987)
    assert [number(value) for value in given] == ["∞", "0", "7", "12346", "1.23", "0.000123", "-3.22"]
