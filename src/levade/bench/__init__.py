"""Compare optimizers over tasks, robots and seeds.

result = bench(Plan(tasks=("rearing",), optimizers=("cma", "cem")), Path("out"), processes=2)
written, missing = report(result.results, Path("out"))

Processes start as fresh interpreters. A script that calls `bench` does so under ``if __name__ == "__main__":``.
"""

from levade.bench.comparison import Bench, Progress, bench, plan_of, report
from levade.bench.measures import Summary, summarise
from levade.bench.plan import Plan, read_plan
from levade.bench.results import Result, read

__all__ = [
    "Bench",
    "Plan",
    "Progress",
    "Result",
    "Summary",
    "bench",
    "plan_of",
    "read",
    "read_plan",
    "report",
    "summarise",
]
