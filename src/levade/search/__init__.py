"""Search for a motion: a task, an engine and an optimizer together give a solution.

solution = solve(load_task("rearing"), seed=0)
"""

from levade.search.evaluation import Evaluation, Record, Samples, Trials
from levade.search.initial import InitialGuess
from levade.search.loop import solve, solve_many
from levade.search.objective import Objective, Simulation, make_objective
from levade.search.outcome import Generation, Solution, Stopped, Trial
from levade.search.schedule import Move, Report, Schedule
from levade.search.search import Search

__all__ = [
    "Evaluation",
    "Generation",
    "InitialGuess",
    "Move",
    "Objective",
    "Record",
    "Report",
    "Samples",
    "Schedule",
    "Search",
    "Simulation",
    "Solution",
    "Stopped",
    "Trial",
    "Trials",
    "make_objective",
    "solve",
    "solve_many",
]
