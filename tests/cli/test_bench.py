"""``levade bench`` as a user meets it: words and options, the table, JSON, and one line for what is wrong."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from levade.bench import read

QUICK = ["--seeds", "1", "--trials", "16", "--set", "horizon=0.06", "--set", "search.population=8", "--format", "svg"]


@pytest.mark.slow
def test_a_bench_from_options_then_more_of_it_then_with_others(levade) -> None:
    status, out, err = levade("bench", "--tasks", "rearing", "--optimizers", "cma", "random", *QUICK)
    assert (status, err) == (0, "")
    lines = out.splitlines()
    table = lines.index("rearing on hyq2max")
    assert lines[0] == "0 of 2 runs"
    assert all(line.endswith(" of 2 runs") for line in lines[:table])  # again every few seconds
    assert (
        " ".join(lines[table + 1].split()) == "optimizer success trials to success ERT [trials] ERT [core-s] final cost"
    )
    assert lines[table + 2].split()[:5] == ["cma", "0/1", "∞", "∞", "∞"]
    assert "Written: bench/results.csv, table.md, trials.svg, steps.svg, results.parquet" in lines
    assert {path.name for path in Path("bench").iterdir()} == {
        *("bench.yaml", "results.csv", "table.md", "trials.svg", "steps.svg", "results.parquet")
    }
    content = yaml.safe_load(Path("bench/bench.yaml").read_text())
    assert (content["optimizers"], content["changes"]["horizon"]) == (["cma", "random"], 0.06)

    # what the task has already: nothing to run
    status, out, err = levade("bench", "--json", "--set", "search.step=0.3")
    assert (status, err) == (0, "0 of 2 runs\n" if "0 of" in err else err)
    summary = json.loads(out)
    assert summary["left"] == 0
    assert [case["optimizer"] for case in summary["cases"]] == ["cma", "random"]
    assert summary["cases"][0]["ert"]["trials"] == {"value": None, "low": None, "high": None}
    assert summary["cases"][0]["trials_to_success"] == {"median": None, "least": None, "most": None}
    assert "bench/results.csv" in summary["written"]

    renamed = Path("bench/results.csv").read_text().replace(",cma,", ",theirs,").replace(",random,", ",chance,")
    Path("peers.csv").write_text(renamed)
    status, out, _ = levade("bench", "--add", "peers.csv", "--json")
    assert [case["optimizer"] for case in json.loads(out)["cases"]] == ["cma", "random", "theirs", "chance"]
    assert len(read(Path("bench/results.csv"))) == 2
    status, _, err = levade("bench", "--add", "peers.csv", "bench/results.csv")
    assert (status, "is in this bench and in what is added to it" in err) == (2, True)


@pytest.mark.slow
def test_a_bench_from_a_file_with_options_over_it(levade) -> None:
    plan = {
        "tasks": ["rearing"],
        "optimizers": {"wide": {"search.step": 0.5}},
        "seeds": 1,
        "trials": 8,
        "changes": {"horizon": 0.06},
    }
    Path("plan.yaml").write_text(yaml.safe_dump(plan))
    arguments = ("--seeds", "2", "--set", "search.population=8", "--out", "out", "--processes", "1", "--format", "svg")
    status, _, err = levade("bench", "plan.yaml", *arguments)
    assert (status, err) == (0, "")
    assert [(r.optimizer, r.seed, r.trials, r.steps) for r in read(Path("out/results.csv"))] == [
        ("wide", 0, 8, 240),
        ("wide", 1, 8, 240),
    ]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("bench", "bench: no bench to go on with; name tasks: --tasks rearing, or give a plan: levade bench FILE"),
        ("bench none.yaml", "none.yaml: cannot be read (No such file or directory)"),
        ("bench --tasks", "'--tasks' requires an argument"),
        ("bench --tasks rearin", "no task 'rearin'; did you mean rearing?"),
        ("bench --tasks rearing --robots hyq", "no robot 'hyq'; did you mean hyq2max?"),
        ("bench --tasks rearing --optimizers cma cmaa", "optimizers: no optimizer 'cmaa'; did you mean cma?"),
        ("bench --tasks rearing --seeds 0", "seeds: 0 should be a number from 1"),
        ("bench --tasks rearing --until solved", "until: 'solved' should be success or budget"),
        ("bench --tasks rearing --set horizon", "--set horizon: should be path=value"),
        ("bench --tasks rearing --set horizn=1", "changes: horizn: no 'horizn' in the task"),
        ("bench --tasks rearing --format jpg", "--format jpg: should be one of pdf, svg, png"),
        ("bench --tasks rearing --add none.csv", "none.csv: cannot be read"),
        ("bench --tasks rearing --out /dev/null/bench", "/dev/null/bench"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(levade, tmp_path: Path, arguments: str, message: str) -> None:
    status, out, err = levade(*arguments.split(" "))
    assert (status, out) == (2, "")
    assert err.startswith("levade: ")
    assert message in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
