"""Robust optimisation: whole roll-outs on perturbed models, the same to the bit every time."""

from __future__ import annotations

import copy
import itertools
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import levade.search.robust
from levade.costs import total
from levade.engines import MujocoEngine, Perturbation, perturbed_models
from levade.engines.ode.library import load
from levade.errors import LevadeError
from levade.motions import Motion, RecordedSimulation, run_trials
from levade.search import (
    Evaluation,
    Generation,
    Objective,
    Record,
    Search,
    Stopped,
    Trials,
    make_objective,
    solve,
)
from levade.search.objective import _TAG as TAG
from levade.search.optimizing import make_attempt
from levade.search.recording import record
from levade.search.repair import Repair
from levade.search.robust import Judge, Judging
from levade.search.run import MOTION, TASK, read_run, resume, run
from levade.search.schedule import Level, full_level
from levade.tasks import Racing, Robust, load_task, task_to_yaml

SMALL = [
    *("search.optimizer=cma", "search.population=6", "horizon=0.06", "hold=0.02", "search.polish=null"),
    "success={pitch: {target: 0, tolerance: 0.2}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
    "stages=[{name: nominal, robust: false, trials: 12, hold: false}, {name: robust, hold: 0.01}]",
]
FIXED = "robust={samples: 4, measure: cvar, racing: {first: 1, keep: 0.5}}"
REDRAWN = "robust={samples: 3, measure: mean, redraw: generation, required: 0.5}"
VALIDATED = "robust={samples: 2, measure: mean, redraw: generation, validation: 5}"
MEAN = "robust={samples: 2, measure: mean, redraw: generation, validation: 5, contender: mean}"
STARTS = "robust={samples: 3, measure: mean, redraw: generation, validation: 20, starts: 3}"
Answered = Callable[[Judging, Objective], Evaluation]
BUDGET = {FIXED: 120, REDRAWN: 120, VALIDATED: 120, MEAN: 120, STARTS: 250}


def objective(robust: str = FIXED, *more: str, threads: int = 1) -> Objective:
    task = load_task("rearing", changes=[*SMALL, robust, f"search.trials={BUDGET[robust]}", *more])
    return make_objective(task, threads=threads)


def generations(objective: Objective, seed: int = 2, **options) -> list[Generation]:
    seen: list[Generation] = []
    solve(objective, seed=seed, observe=seen.append, **options)
    return seen


def asked(objective: Objective, seed: int = 2) -> list[tuple[Generation, list[Trials]]]:
    """Each generation of a search, with the trials that were asked for since the one before."""
    search, trials, seen = Search(objective.task, objective.space, seed=seed), [], []
    while (wanted := search.ask()) is not None:
        trials.append(wanted)
        if (generation := search.tell(objective.evaluate(wanted))) is not None:
            seen.append((generation, trials))
            trials = []
    return seen


def candidates(trials: list[Trials]) -> np.ndarray:
    """The candidates of a generation of six: the first of so many that are asked for on the nominal model."""
    return next(one.weights for one in trials if one.draw is None and one.n == 6)


@pytest.fixture(scope="module")
def fixed() -> list[Generation]:
    return generations(objective())


@pytest.mark.slow
@pytest.mark.parametrize("robust", BUDGET)
def test_every_rollout_is_a_trial(robust: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """And every step of it a step that the engine says it made."""
    made, counted = objective(robust), [0, 0]
    rollout, before = MujocoEngine.rollout, made.engine.steps

    def count(self: MujocoEngine, *arguments, **options):
        out = rollout(self, *arguments, **options)
        counted[0] += out.n
        counted[1] += out.n * out.steps
        return out

    monkeypatch.setattr(MujocoEngine, "rollout", count)
    solution = solve(made, seed=2)
    assert solution.trials == counted[0]
    assert solution.trials <= BUDGET[robust]
    assert made.engine.steps - before == counted[1]


def test_a_generation_takes_as_many_trials_as_racing_leaves(fixed: list[Generation]) -> None:
    spent = [b.trials - a.trials for a, b in zip([None, *fixed], fixed, strict=False) if a is not None]
    # two generations of the nominal stage, then 6 nominal, 6 on the first model and the better 3 on the other three
    assert fixed[0].trials == 6
    assert fixed[0].evaluation.samples is None
    assert spent[0] == 6
    more = [t - (6 + 6 + 3 * 3 + g.evaluation.verified) for g, t in zip(fixed[2:], spent[1:], strict=True)]
    assert (
        1 + 4 <= more[0] <= 2 * (1 + 4)
    )  # the best so far, on the models, and through the hold if it succeeds until then
    assert more[1:] == [0] * (len(more) - 1)


@pytest.mark.slow
def test_a_candidates_cost_is_the_measure_of_its_whole_rollouts(fixed: list[Generation]) -> None:
    made = objective()
    weights = {name: cost.weight for name, cost in made.task.costs.items()}
    generation = fixed[3]
    samples, nominal = generation.evaluation.samples, generation.evaluation
    assert samples is not None
    assert samples.complete.sum() == 3
    assert samples.known[:, 0].all()
    on_models = total(dict(samples.terms), weights)
    own = total(dict(nominal.terms), weights)
    for i in np.flatnonzero(samples.complete):
        worst = sorted([own[i], *on_models[i]], reverse=True)[:3]  # half of five, rounded up
        assert generation.cost[i] == pytest.approx(sum(worst) / 3, rel=1e-12)
    assert generation.cost[~samples.complete].min() >= generation.cost[samples.complete].max()


@pytest.mark.slow
def test_samples_are_rollouts_of_the_perturbed_models_themselves(answered: Answered) -> None:
    made = objective()
    starts, models = made._models(2, 0)
    weights = made.space.mean[None] + 0.1 * np.random.default_rng(0).normal(size=(2, 96))
    found = answered(Judge(made.task, 2).evaluate(weights, Level(5, robust=True)), made)
    assert found.samples is not None
    assert found.samples.known.all()
    told_before = made.state.joint_reference[0]
    for i in range(2):
        reference = replace(made.policy.reference(weights[i : i + 1], hold_steps=5), before=told_before)
        for j in range(4):
            alone = made.engine.rollout(starts[j], reference, models=models[j])
            for name, term in made.terms.items():
                assert found.samples.terms[name][i, j] == term(alone)[0], name


@pytest.mark.slow
@pytest.mark.parametrize("robust", [FIXED, REDRAWN, MEAN, STARTS])
def test_the_search_is_the_same_to_the_bit_for_any_number_of_threads_and_after_a_resume(
    robust: str, tmp_path: Path, assert_same_files: Callable[[Path, Path], None]
) -> None:
    whole = run(objective(robust), seed=5, directory=tmp_path / "whole")
    run(load_task(tmp_path / "whole" / TASK), seed=5, threads=2, directory=tmp_path / "again")

    def stop(generation: Generation) -> None:
        if generation.generation == 4:
            raise KeyboardInterrupt

    run(objective(robust), seed=5, directory=tmp_path / "part", observe=stop)
    replayed: list[bool] = []
    resume(tmp_path / "part", threads=2, observe=lambda g: replayed.append(g.replayed))
    assert replayed[:4] == [True] * 4
    assert not any(replayed[4:])
    for other in ("again", "part"):
        assert_same_files(tmp_path / other, tmp_path / "whole")
    assert Motion.load(tmp_path / "whole" / MOTION).meta["success"] == whole.solution.best.success


@pytest.mark.slow
@pytest.mark.parametrize("robust", [FIXED, REDRAWN, MEAN, STARTS])
def test_a_search_that_is_interrupted_inside_a_generation_loses_nothing_that_was_simulated(
    robust: str, tmp_path: Path, assert_same_files: Callable[[Path, Path], None]
) -> None:
    """Between any two evaluations of what follows the nominal stages, on other models or through the hold among them."""
    whole = run(made := objective(robust), seed=5, directory=tmp_path / "whole")
    of = [len(trials) for _, trials in asked(made, seed=5)]
    later = next(i for i, count in enumerate(of) if count > 2)
    assert of[later] > 2
    before = sum(of[:later])
    for place in range(before, before + of[later] + 1):
        part, calls, evaluate = copy.copy(made), 0, made.evaluate

        def stops(trials: Trials, *, place: int = place) -> Evaluation:
            nonlocal calls
            calls += 1
            if calls == place + 1:
                raise KeyboardInterrupt
            return evaluate(trials)  # noqa: B023

        part.evaluate = stops  # type: ignore[method-assign]
        directory = tmp_path / str(place)
        outcome = run(part, seed=5, directory=directory)
        assert (outcome.solution.stopped, len(read_run(directory)[1].records)) == (Stopped.INTERRUPTED, place)
        replayed: list[bool] = []
        resume(directory, objective=made, observe=lambda g: replayed.append(g.replayed))  # noqa: B023
        assert replayed[: later + 2] == [True] * later + [place == before + of[later], False]
        assert_same_files(directory, tmp_path / "whole")
    assert whole.solution.generations >= later + 2


@pytest.mark.slow
def test_records_survive_json() -> None:
    for robust in (FIXED, REDRAWN):
        records: list[Record] = []
        seen = generations(objective(robust), keep=records.append)
        assert len(records) > len(seen)
        for one in records:
            text = json.dumps(one.to_json(), allow_nan=False)
            assert Record.from_json(json.loads(text)).to_json() == json.loads(text)
    assert seen[-1].validated is not None


@pytest.mark.slow
def test_models_are_redrawn_when_asked_and_never_those_of_a_check() -> None:
    for robust, own in ((FIXED, False), (REDRAWN, True)):
        for generation, trials in asked(objective(robust)):
            drawn = {one.draw for one in trials} - {None}
            assert drawn <= ({0, generation.generation} if own else {0})
            assert (generation.generation in drawn) == (own and generation.stage_name == "robust")
    made = objective()
    qpos = {key: made._models(*key)[0].qpos for key in ((0, 1), (0, 2), (0, 0), (1, 0))}
    assert not np.array_equal(qpos[0, 1], qpos[0, 2])
    assert not np.array_equal(qpos[0, 0], qpos[1, 0])
    assert np.array_equal(qpos[0, 0], objective()._models(0, 0)[0].qpos)
    # numpy's seeds 0 and (0, 0) are the same: a check with the solve's seed must not find the models that were trained on
    kept = made._models(0, 0)[1]
    for draw in (Perturbation().spread, Perturbation().draw):
        sample = draw(made.engine.model, 12, n=4, seed=0)
        _, checked = perturbed_models(made.engine.model, made.engine.layout, sample, made.state)
        assert not np.isclose(kept.delay[:, None], checked.delay).any()


@pytest.mark.slow
def test_the_best_of_a_generation_is_compared_on_a_sample_of_its_own_size() -> None:
    made = objective(VALIDATED)
    assert [len(made._models(0, draw)[1]) for draw in (0, 1, 2)] == [5, 2, 2]
    seen = generations(made)
    spent = [b.trials - a.trials for a, b in itertools.pairwise(seen[1:])]
    assert len(spent) >= 2
    for i, (generation, trials) in enumerate(zip(seen[2:], spent, strict=True)):
        validated = generation.validated
        assert validated is not None
        assert validated.samples is not None
        assert validated.samples.known.shape == (1, 5)
        verified = generation.evaluation.verified + validated.verified
        more = trials - (6 * (1 + 2) + 1 + int(validated.samples.known.sum()) + verified)
        assert 1 + 5 <= more <= 2 * (1 + 5) if i == 0 else more == 0  # the best of the nominal stage, on these models


@pytest.mark.slow
def test_the_mean_of_a_generation_may_be_compared_in_place_of_its_best(answered: Answered) -> None:
    made = objective(MEAN)
    optimizer, compared = make_attempt(made.task, made.space, seed=2), 0
    for generation, trials in asked(made):  # the same search, told the same costs
        mean = optimizer.mean
        np.testing.assert_array_equal(optimizer.ask(), candidates(trials))
        validated = generation.validated
        assert (validated is None) == (generation.stage_name == "nominal")
        if validated is not None:
            again = answered(Judge(made.task, 2).evaluate(mean[None], Level(5, robust=True)), made)
            assert {name: v.tolist() for name, v in validated.terms.items()} == {
                name: v.tolist() for name, v in again.terms.items()
            }
            assert validated.samples is not None
            assert again.samples is not None
            for name, values in validated.samples.terms.items():
                np.testing.assert_array_equal(values, again.samples.terms[name])
            compared += 1
        optimizer.tell(generation.cost)
    assert compared >= 2


@pytest.mark.slow
def test_a_mean_that_misses_a_criterion_is_repaired_before_it_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    moved: list[np.ndarray] = []

    def repaired(self: Repair, mean: np.ndarray) -> np.ndarray:
        moved.append(mean + 0.001)
        return moved[-1]

    monkeypatch.setattr(Repair, "repaired", repaired)
    rounds = [trials for generation, trials in asked(objective(MEAN)) if generation.validated is not None]
    for trials, mean in zip(rounds, moved, strict=True):
        assert any(np.array_equal(one.weights, mean[None]) for one in trials if one.draw is None)
    assert len(moved) >= 2


@pytest.mark.slow
def test_perturbed_models_are_free_from_some_costs(fixed: list[Generation]) -> None:
    evaluation, robust = fixed[3].evaluation, Robust(samples=4, measure="mean", free=("effort",))
    weights = {name: cost.weight for name, cost in objective().task.costs.items()}
    samples = evaluation.samples
    less = {name: weight for name, weight in weights.items() if name != "effort"}
    on_models = total({name: samples.terms[name] for name in less}, less)
    expected = np.column_stack([total(dict(evaluation.terms), weights), on_models]).mean(axis=1)
    whole = samples.complete
    np.testing.assert_allclose(evaluation.cost(weights, robust)[whole], expected[whole], rtol=1e-12)
    assert (expected[whole] < evaluation.cost(weights, replace(robust, free=()))[whole]).all()


@pytest.mark.slow
def test_a_search_starts_anew_on_the_nominal_model_only() -> None:
    """Each nominal stage has two generations of six: it starts anew after one, or goes on with other models."""
    never = "success={pitch: {target: 1.5, tolerance: 0.1}}"
    names = {
        restart: [g.stage_name for g in generations(objective(FIXED, never, f"search.restart={restart}"))]
        for restart in (6, 18)
    }
    assert set(names[6]) == {"nominal"}
    assert len(names[6]) == (BUDGET[FIXED] - 2 * (1 + 4)) // 6  # as much is left to try its best on the models
    assert names[18][:2] == ["nominal", "nominal"]
    assert set(names[18][2:]) == {"robust"}


BARELY = ("success={pitch: {target: 0, tolerance: 0.02}}", "search.step=0.03")


@pytest.mark.slow
@pytest.mark.parametrize("success", ["", ", success: {pitch: {target: 0, tolerance: 0.5}}"])
def test_contenders_that_cannot_win_are_tried_on_fewer_models_with_the_same_winners(
    success: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    robust = f"robust={{samples: 2, measure: mean, redraw: generation, validation: 24{success}}}"
    more = ("search.trials=400", *BARELY, robust)
    soon = generations(objective(VALIDATED, *more))
    monkeypatch.setattr(levade.search.robust, "_contenders", lambda robust, nominal, samples, best: np.arange(1))
    whole = generations(objective(VALIDATED, *more))
    assert len(whole) > 4
    assert whole[-1].best.share
    for one, other in zip(soon, whole, strict=False):
        assert one.best.rank == other.best.rank
        np.testing.assert_array_equal(one.best.weights, other.best.weights)
    assert soon[len(whole) - 1].trials < whole[-1].trials


@pytest.mark.slow
def test_of_several_motions_of_the_nominal_model_the_one_that_holds_on_most_others_goes_on(answered: Answered) -> None:
    """Each is found by a search of its own, of two generations here; the robust stage begins around the best of them."""
    made = objective(STARTS, *BARELY)
    seen, trials = map(list, zip(*asked(made), strict=True))
    judge = Judge(made.task, 2)
    assert [g.stage_name for g in seen] == ["nominal"] * 6 + ["robust"] * (len(seen) - 6)
    assert [g.validated is None for g in seen[:6]] == [True, False] * 3
    assert [g.trials for g in seen[:6]] == [6, 33, 39, 66, 72, 99]  # 1 + 20 for a motion, beside six candidates
    found = []
    for attempt in range(3):
        optimizer = make_attempt(made.task, made.space, seed=2, attempt=attempt)
        for number in (2 * attempt, 2 * attempt + 1):
            tried, cost = optimizer.ask(), seen[number].cost
            np.testing.assert_array_equal(tried, candidates(trials[number]))
            optimizer.tell(cost)
        start = tried[np.argmin(cost)]
        share = answered(judge.evaluate(start[None], full_level(made.task)), made).samples
        assert share is not None
        found.append((share.share[0], start))
    shares = [share for share, _ in found]
    assert len(set(shares)) == 3
    assert [len(g.starts) for g in seen[:6]] == [0, 1, 1, 2, 2, 3]
    assert seen[-1].starts == tuple(shares)
    best = found[int(np.argmax(shares))][1]
    around = make_attempt(made.task, replace(made.space, mean=best), seed=2, attempt=3, around=True).ask()
    np.testing.assert_array_equal(around, candidates(trials[6]))


@pytest.mark.slow
def test_a_search_that_is_given_up_counts_as_a_start_and_one_motion_is_enough() -> None:
    """Of three searches those that meet nothing within one generation are given up; without any the next one begins."""
    hard = "stages=[{name: nominal, robust: false, promote: {pitch: 1e-5}}, {name: robust}]"
    seen = generations(objective(STARTS, *BARELY, hard, "search.restart=6"))
    assert {g.stage_name for g in seen} == {"nominal"}
    easy = hard.replace("1e-5", "0.0005")
    seen = generations(objective(STARTS, *BARELY, easy, "search.restart=6", "search.trials=400"))
    nominal = [g for g in seen if g.stage_name == "nominal"]
    assert sum(g.validated is not None for g in nominal) in (1, 2)
    assert len(nominal) >= 3
    assert seen[-1].stage_name == "robust"


@pytest.mark.slow
def test_where_the_best_start_leads_nowhere_as_many_are_looked_for_again() -> None:
    """The last stage has 30 trials: it ends in its first generation of 6 + 3 * 6 + 21. The second round starts from new motions
    and those of the first that have not been started from, while the budget lasts for as much again; the best of all is kept.
    """
    stages = "stages=[{name: nominal, robust: false, trials: 12, hold: false}, {name: robust, hold: 0.01, trials: 30}]"
    made = objective(STARTS, *BARELY, stages, "search.trials=420")
    seen, trials = map(list, zip(*asked(made), strict=True))
    names = [g.stage_name for g in seen]
    assert names == ["nominal"] * 6 + ["robust"] + ["nominal"] * 6 + ["robust"] * (len(seen) - 13)
    assert len(seen) > 14  # nothing is left for a third round: it goes on
    first = sorted(g.validated.samples.share[0] for g in seen[:6] if g.validated)  # type: ignore[union-attr]
    shares = [g.best.share for g in seen]
    assert seen[7].starts == tuple(reversed(first[:2]))
    assert len(seen[12].starts) == 5
    assert all(a <= b for a, b in itertools.pairwise(share for share in shares if share is not None))
    np.testing.assert_array_equal(make_attempt(made.task, made.space, seed=2, attempt=3).ask(), candidates(trials[7]))
    solution = solve(made, seed=2)
    assert solution.best.share == max(share for share in shares if share is not None)


@pytest.mark.slow
def test_a_motion_to_start_from_that_holds_on_all_is_a_success() -> None:
    seen = generations(objective(STARTS, "search.polish=0"))
    assert len(seen) == 2
    assert seen[-1].best.success
    assert seen[-1].trials_to_success == seen[-1].trials == 12 + 21


@pytest.mark.slow
def test_an_interrupted_search_keeps_the_start_that_holds_best(answered: Answered) -> None:
    made, at = objective(STARTS, *BARELY), []

    def stop(generation: Generation) -> None:
        at.append(generation)
        if len(at) == 5:
            raise KeyboardInterrupt

    solution = solve(made, seed=2, observe=stop)
    kept = answered(Judge(made.task, 2).evaluate(solution.best.weights[None], full_level(made.task)), made).samples
    starts = [g.validated.samples.share[0] for g in at if g.validated and g.validated.samples]
    assert kept is not None
    assert kept.share[0] == max(starts)


@pytest.mark.slow
def test_few_samples_cover_every_range_evenly() -> None:
    sample = Perturbation(friction=(0.0 + 0.1, 1.1), softness=(0.5, 2.0), cone=(0.0, 1.0)).spread(
        objective().engine.model, 12, n=10, seed=1
    )
    assert sorted(np.floor((sample.values["friction"][:, 0] - 0.1) * 10).tolist()) == list(range(10))
    for values in sample.values.values():
        assert len(np.unique(values[:, 0])) == 10 if values.shape[1] else True


@pytest.mark.slow
def test_success_takes_the_nominal_model_and_enough_of_the_others(answered: Answered) -> None:
    made = objective(REDRAWN)
    evaluation = answered(Judge(made.task, 0).evaluate(made.space.mean[None], full_level(made.task)), made)
    assert evaluation.success.tolist() == [True]
    robust = made.task.robust
    assert robust is not None
    shares = np.array([1 / 3, 2 / 3, 1.0])
    assert robust.enough(shares).tolist() == [False, True, True]
    assert Robust().enough(shares).tolist() == [False, False, True]
    assert evaluation.samples is not None
    assert evaluation.samples.share.tolist() == [1.0]
    assert evaluation.trials == 4


def test_nothing_succeeds_before_it_was_tried_on_perturbed_models(fixed: list[Generation]) -> None:
    assert all(not generation.best.success for generation in fixed[:2])
    assert fixed[-1].best.success  # a robot that stands


def test_tasks_keep_what_they_ask_for(tmp_path: Path) -> None:
    task = load_task("rearing", changes=[*SMALL, "robust={samples: 5, perturb: {com: [-1 cm, 1 cm], friction: null}}"])
    assert task.robust == Robust(samples=5, perturb=Perturbation(com=(-0.01, 0.01), friction=None))
    path = tmp_path / "task.yaml"
    path.write_text(task_to_yaml(task), encoding="utf-8")
    assert load_task(path) == task
    assert load_task("rearing").robust is None


@pytest.mark.parametrize(
    ("robust", "message"),
    [
        ("{samples: 0}", r"robust.samples: 0 should be 1 to 1000"),
        ("{measure: wurst}", r"robust.measure"),
        ("{validation: 9}", r"robust.validation: only works with redraw: generation"),
        ("{redraw: generation, contender: median}", r"robust.contender: should be 'best' or 'mean'"),
        ("{contender: mean}", r"robust.contender: only works with redraw: generation"),
        ("{redraw: generation, validation: 0}", r"robust.validation: 0 should be 1 to 1000"),
        ("{starts: 0}", r"robust.starts: 0 should be 1 to 1000"),
        ("{tail: 0}", r"robust.tail: 0.0 should be a share"),
        ("{samples: 2, racing: {first: 2}}", r"robust.racing.first: 2 should be less than samples, 2"),
        ("{racing: {first: 1, keep: 0}}", r"robust.racing.keep: 0.0 should be a share"),
        ("{free: [effrt]}", r"robust.free: no 'effrt' in this task; did you mean effort\?"),
        ("{free: [orientation, position, effort, joint_limits]}", r"robust.free: has every cost"),
        ("{perturb: {frction: [1, 1]}}", r"unknown key 'frction'; did you mean friction\?"),
    ],
)
def test_mistakes_are_told_in_one_line(robust: str, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        load_task("rearing", changes=[*SMALL, f"robust={robust}"])
    assert Racing(first=0).keep == 0.5


@pytest.mark.parametrize(
    ("stages", "missing"),
    [("[{name: robust}]", "the first stage is not robust: false"), ("[{robust: false}]", "no stage is robust")],
)
def test_starts_need_stages_of_both_kinds(stages: str, missing: str) -> None:
    with pytest.raises(
        LevadeError, match=f"robust.starts: 3 motions of the nominal model to start from, but {missing}"
    ):
        load_task("rearing", changes=[*SMALL, f"stages={stages}", STARTS])


@pytest.mark.slow
def test_another_engine_has_its_own_perturbed_models() -> None:
    """The same robots, other physics: in ODE as reproducible, and not what MuJoCo says of them."""
    try:
        load()
    except LevadeError as missing:
        pytest.skip(str(missing))
    found: list[list[Record]] = [[], []]
    first, _ = (generations(objective(REDRAWN, "physics.engine=ode"), keep=records.append) for records in found)
    assert [a.to_json() for a in found[0]] == [b.to_json() for b in found[1]]
    samples, theirs = first[-1].evaluation.samples, generations(objective(REDRAWN))[-1].evaluation.samples
    assert samples is not None
    assert theirs is not None
    assert samples.known.all()
    assert not np.isclose(samples.terms["position"], theirs.terms["position"], rtol=1e-6).any()


@pytest.mark.slow
@pytest.mark.parametrize("robust", [FIXED, STARTS])
def test_weights_that_hardly_change_leave_the_best_what_it_cost_on_all_models(robust: str) -> None:
    plain, steered = [], []
    solve(objective(robust), seed=2, observe=plain.append)
    solve(
        objective(robust),
        seed=2,
        observe=steered.append,
        steer=lambda number: {"orientation": 1.0 + 1e-12} if number == len(plain) else None,
    )
    assert plain[-1].stage_name == "robust"
    assert len(plain) == len(steered)
    for one, other in zip(plain, steered, strict=True):
        assert other.best.cost == pytest.approx(one.best.cost, rel=1e-6)
        assert other.best.share == one.best.share


@pytest.mark.slow
def test_a_success_that_only_the_end_brings_to_light_is_one_after_all_trials() -> None:
    """The nominal stage never ends: its best is tried on the models when the budget is spent."""
    never = "stages=[{name: nominal, robust: false, hold: false, promote: {pitch: 0}}, {name: robust}]"
    solution = solve(objective(REDRAWN, never, "robust.required=0.1", "search.step=0.01"), seed=2)
    assert solution.success
    assert solution.trials_to_success == solution.trials <= BUDGET[REDRAWN]


@pytest.mark.slow
def test_a_check_of_the_models_of_a_search_finds_what_the_search_did(answered: Answered) -> None:
    """Latency included: until the first reference comes, the joints have what they were told before."""
    made = objective(FIXED, "success={height: {target: 0.57, tolerance: 0.5 cm}}")
    solution = solve(made, seed=2)
    simulation = RecordedSimulation(record(made, solution, seed=2))
    drawn = Perturbation().spread(simulation.model, simulation.joints, n=4, seed=(2, 0, TAG))
    found = run_trials(simulation, drawn)
    judging = Judge(made.task, 2).evaluate(solution.best.weights[None], full_level(made.task))
    samples = answered(judging, made).samples
    assert samples is not None
    np.testing.assert_array_equal(found.success, samples.success[0])
    trajectories = simulation.rollout(drawn)
    for name, term in made.terms.items():
        np.testing.assert_allclose(term(trajectories), samples.terms[name][0], rtol=1e-9, atol=1e-12)
