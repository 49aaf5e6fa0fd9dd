"""The staged loop: its objective written out by hand, and what it keeps, promotes, spends and repeats."""

from __future__ import annotations

import dataclasses
import functools
import json
import math

import mujoco
import numpy as np
import pytest

from levade.costs import DIVERGED
from levade.errors import LevadeError
from levade.search import Evaluation, Generation, Objective, Record, Solution, Stopped, Trials, make_objective, solve
from levade.search.robust import Judge, Judging
from levade.tasks import Cost, load_task

# a hold that stages look at differently, and a goal that is easy to come near
STAGED = """
name: staged
horizon: 0.1
hold: 0.04
policy: {groups: pairs}
costs:
  orientation: {weight: 1000, pitch: -0.3}
  position: {weight: 100, z: 0.6}
  effort: {weight: 0.1}
  after: {term: orientation, weight: 50, pitch: -0.3, at: end}
stages:
  - {name: first, hold: false, trials: 24, weights: {effort: 0}}
  - {name: second, hold: 0.02, promote: {pitch: 0.05}, trials: 32, step: 0.5}
  - {name: third}
success:
  pitch: {target: -0.3, tolerance: 0.02}
  later: {quantity: pitch, target: -0.3, tolerance: 0.3, at: end}
  still: {quantity: speed, maximum: 10, at: end}
search: {optimizer: cma, trials: 120, population: 8, step: 0.2, smoothness: 0.2, polish: null}
"""


@functools.cache
def rearing() -> Objective:
    """With an optimizer whose generations are all of one size."""
    return make_objective(load_task("rearing", changes=["search.optimizer=cma"]), threads=1)


@pytest.fixture(scope="module")
def staged(tmp_path_factory: pytest.TempPathFactory) -> Objective:
    path = tmp_path_factory.mktemp("task") / "staged.yaml"
    path.write_text(STAGED)
    return make_objective(load_task(path), threads=1)


def changed(objective: Objective, **changes: object) -> Objective:
    """An objective whose task differs in what the simulation does not see."""
    return objective.with_task(dataclasses.replace(objective.task, **changes))


def collect(objective: Objective, **options: object) -> tuple[Solution, list[Generation]]:
    generations: list[Generation] = []
    return solve(objective, observe=generations.append, **options), generations  # type: ignore[arg-type]


def recorded(objective: Objective, **options: object) -> tuple[Solution, list[Generation], list[list[Record]]]:
    """A solve, with the records that it has kept by the end of each generation, once through JSON."""
    generations: list[Generation] = []
    records: list[Record] = []
    kept: list[list[Record]] = []

    def observe(generation: Generation) -> None:
        generations.append(generation)
        kept.append(list(records))

    def keep(record: Record) -> None:
        records.append(Record.from_json(json.loads(json.dumps(record.to_json()))))

    solution = solve(objective, observe=observe, keep=keep, **options)  # type: ignore[arg-type]
    return solution, generations, kept


def cost_weights(objective: Objective) -> dict[str, float]:
    return {name: cost.weight for name, cost in objective.task.costs.items()}


def answered(judging: Judging, objective: Objective) -> Evaluation:
    """What a judge comes to, its questions answered by simulation."""
    try:
        trials = next(judging)
        while True:
            trials = judging.send(objective.evaluate(trials))
    except StopIteration as end:
        return end.value


def assert_same(one: Solution, other: Solution) -> None:
    np.testing.assert_array_equal(one.best.weights, other.best.weights)
    assert {**vars(one.best), "weights": None} == {**vars(other.best), "weights": None}
    for key in ("trials", "generations", "trials_to_success", "diverged", "stopped"):
        assert getattr(one, key) == getattr(other, key), key


def by_hand(objective: Objective, weights: np.ndarray) -> tuple[float, dict[str, float], dict[str, float]]:
    """Eq. 3-7 for one trial of rearing, with loops, from the paper's formulas; names of joints and legs by hand."""
    kernels, horizon, dt, variance = 16, 0.3, 0.002, 0.01
    w = weights.reshape(6, kernels)
    model = mujoco.MjModel.from_xml_string(objective.engine.xml, objective.engine.assets)
    data = mujoco.MjData(model)
    state = objective.state
    data.qpos[:], data.qvel[:], data.act[:] = state.qpos[0], state.qvel[0], state.act[0]
    limit = {"haa": 120.0, "hfe": 245.0, "kfe": 250.0}
    reach = {name: model.joint(name).range for name in objective.robot.joint_names}
    effort = excess = 0.0
    for k in range(1, 151):
        t = k * dt / horizon
        phi = [math.exp(-((t - i / 15) ** 2) / (2 * variance)) for i in range(kernels)]
        rate = [-(t - i / 15) / variance / horizon * p for i, p in enumerate(phi)]
        for row, (end, joint) in enumerate((end, joint) for end in "fh" for joint in ("haa", "hfe", "kfe")):
            total = sum(p * x for p, x in zip(phi, w[row], strict=True))
            slope = sum(r * x for r, x in zip(rate, w[row], strict=True))
            norm, norm_rate = sum(phi), sum(rate)
            position, velocity = total / norm, slope / norm - total * norm_rate / norm**2
            for side in "lr":  # left and right have mirrored axes: the same angle is the mirror image
                actuator = objective.robot.joint_names.index(f"{side}{end}_{joint}")
                data.ctrl[2 * actuator : 2 * actuator + 2] = position, velocity
        mujoco.mj_step(model, data)
        for name in objective.robot.joint_names:
            torque, angle = data.actuator(name).force[0], data.joint(name).qpos[0]
            effort += (torque / limit[name[3:]]) ** 2 * dt
            excess += max(0.0, angle - reach[name][1], reach[name][0] - angle) ** 2 * dt
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    pitch = math.asin(-data.body("trunk").xmat[6])
    height = data.body("trunk").xipos[2]
    terms = {
        "orientation": (pitch + 1.0472) ** 2,
        "position": (height - 0.9) ** 2,
        "effort": effort,
        "joint_limits": excess,
    }
    cost = 1000 * terms["orientation"] + 100 * terms["position"] + 0.1 * effort + excess
    return cost, terms, {"pitch": pitch + 1.0472, "height": height - 0.9}


@pytest.mark.slow
def test_the_objective_is_the_papers_formula() -> None:
    objective = rearing()
    random = np.random.default_rng(4)
    # knees bent to where they meet their stops, too
    weights = objective.space.mean + 0.15 * random.normal(size=(3, 96))
    weights[2, 32:48] = -3.2
    evaluation = objective.evaluate(weights)
    cost = evaluation.cost(cost_weights(objective))
    assert evaluation.terms["joint_limits"][2] > 0
    for i in range(3):
        expected, terms, errors = by_hand(objective, weights[i])
        assert cost[i] == pytest.approx(expected, rel=1e-6)
        for name, value in terms.items():
            assert evaluation.terms[name][i] == pytest.approx(value, rel=1e-6, abs=1e-12), name
        for name, value in errors.items():
            assert evaluation.errors[name][i] == pytest.approx(value, abs=1e-7), name


def test_the_first_mean_is_to_keep_standing() -> None:
    objective = rearing()
    evaluation = objective.evaluate(objective.space.mean[None])
    assert abs(evaluation.errors["pitch"][0] - 1.0472) < 0.05  # level
    assert not evaluation.success[0]
    out = objective.rollout(objective.space.mean[None])
    assert np.abs(out.joint_velocity).max() < 0.05


@pytest.mark.slow
def test_interpolation_leads_to_the_goal_posture() -> None:
    plain = ["policy.variance=0.01", "policy.time=normalised", "policy.kernels=16", "policy.goal=neutral"]
    objective = make_objective(load_task("posture-recovery", changes=plain), threads=1)
    reference = objective.policy.reference(objective.space.mean[None])
    span = np.abs(objective.robot.posture("neutral") - objective.state.joint_position[0])
    np.testing.assert_allclose(reference.position[0, -1], objective.robot.posture("neutral"), atol=0.02 * span.max())
    np.testing.assert_allclose(reference.position[0, 0], objective.state.joint_position[0], atol=0.03 * span.max())


def test_a_trial_has_the_same_bits_alone_and_in_a_batch() -> None:
    objective = rearing()
    weights = objective.space.mean + 0.1 * np.random.default_rng(0).normal(size=(9, 96))
    together = objective.evaluate(weights)
    for i in (0, 5, 8):
        alone = objective.evaluate(weights[i : i + 1])
        for name, values in together.terms.items():
            assert alone.terms[name][0] == values[i]
        for name, values in together.errors.items():
            assert alone.errors[name][0] == values[i]


def test_trials_that_break_down_cost_most_and_are_counted() -> None:
    objective = changed(rearing(), search=dataclasses.replace(rearing().task.search, population=8, trials=40, step=1e9))
    weights = objective.space.mean + np.zeros((4, 96))
    weights[2] += 1e15
    evaluation = objective.evaluate(weights)
    np.testing.assert_array_equal(evaluation.diverged, [False, False, True, False])
    cost = evaluation.cost(cost_weights(objective))
    assert cost[2] == DIVERGED > cost[[0, 1, 3]].max()
    for table in (evaluation.terms, evaluation.errors):
        assert np.isfinite(list(table.values())).all()
    solution, generations = collect(objective)  # steps of 10^9 rad: most of them break down
    assert solution.diverged == sum(g.diverged for g in generations) > 10
    assert all(np.isfinite(g.cost).all() for g in generations)
    assert (solution.success, solution.trials) == (False, 40)


@pytest.mark.slow
def test_the_budget_is_kept_and_the_best_only_gets_better() -> None:
    """A tolerance that no trial meets: as many whole generations as fit, and not one more."""
    base = rearing()
    success = {name: dataclasses.replace(c, tolerance=0.0) for name, c in base.task.success.items()}
    for trials, population, spent in ((100, 8, 96), (96, 8, 96), (5, 8, 8), (34, 17, 34)):
        search = dataclasses.replace(base.task.search, trials=trials, population=population)
        solution, generations = collect(changed(base, success=success, search=search, stages=base.task.stages[-1:]))
        assert solution.trials == spent
        assert solution.generations == len(generations) == spent // population
        assert (solution.stopped, solution.trials_to_success, solution.success) == ("budget", None, False)
        best = [g.best.cost for g in generations]
        assert best == sorted(best, reverse=True)
        assert best == list(np.minimum.accumulate([g.cost.min() for g in generations]))
        assert [g.trials for g in generations] == list(range(population, spent + 1, population))
    # the paper's budget, in whole generations of the default population
    assert (base.task.search.trials // 17) * 17 == 3009 == base.task.search.trials


@pytest.mark.slow
def test_the_best_of_all_generations_is_what_comes_out() -> None:
    """Weights and cost of the solution are those of one trial that was tried, the best by the full cost."""
    base = rearing()
    search = dataclasses.replace(base.task.search, trials=160, population=8, polish=None)
    objective = changed(base, search=search)
    seen: list[tuple[bool, float]] = []
    weights = cost_weights(objective)

    def observe(g: Generation) -> None:
        costs = g.evaluation.cost(weights)
        seen.extend((not s, c) for s, c in zip(g.evaluation.success.tolist(), costs.tolist(), strict=True))
        assert (not g.best.success, g.best.cost) == min(seen)

    solution = solve(objective, seed=3, observe=observe)
    assert (not solution.best.success, solution.best.cost) == min(seen)
    again = objective.evaluate(solution.best.weights[None])
    assert again.cost(weights)[0] == solution.best.cost
    assert {name: float(values[0]) for name, values in again.terms.items()} == solution.best.terms


def test_success_beats_a_lower_cost(monkeypatch: pytest.MonkeyPatch) -> None:
    base = rearing()
    search = dataclasses.replace(base.task.search, trials=24, population=8, polish=None)
    objective = changed(base, search=search, stages=base.task.stages[-1:])
    calls = 0

    def evaluate(trials: Trials) -> Evaluation:
        nonlocal calls
        calls += 1
        n = trials.n
        zero = {name: np.zeros(n) for name in objective.task.costs}
        zero["position"] = np.arange(n) + 1.0 + calls  # trial 0 of the first generation has the least cost
        success = np.zeros(n, dtype=bool)
        success[5] = calls == 2
        return Evaluation(zero, {name: np.ones(n) for name in objective.task.success}, success, np.zeros(n, dtype=bool))

    monkeypatch.setattr(objective, "evaluate", evaluate, raising=False)
    solution, generations = collect(objective)
    assert [g.best.success for g in generations] == [False, True, True]
    assert solution.best.cost == 100 * (5 + 1 + 2)
    assert (solution.trials_to_success, solution.trials, solution.stopped) == (16, 24, "budget")
    assert [g.trials_to_success for g in generations] == [None, 16, 16]
    for polish, spent in ((0, 16), (1, 24), (8, 24)):
        calls = 0
        stopping = changed(objective, search=dataclasses.replace(search, polish=polish))
        monkeypatch.setattr(stopping, "evaluate", evaluate, raising=False)
        outcome = solve(stopping)
        assert (outcome.trials, outcome.stopped, outcome.trials_to_success) == (spent, "success", 16)


@pytest.mark.slow
def test_stages_end_by_their_budget_or_their_criteria(staged: Objective) -> None:
    solution, generations = collect(staged)
    names = [g.stage_name for g in generations]
    assert names[:3] == ["first"] * 3  # 24 trials
    assert names[3] == "second"
    second = [g for g in generations if g.stage_name == "second"]
    assert [g.stage for g in generations] == sorted(g.stage for g in generations)
    assert names[-1] == "third"
    within = [bool((np.abs(g.evaluation.errors["pitch"]) <= 0.05).any()) for g in second]
    assert within[:-1] == [False] * (len(within) - 1)
    assert within[-1] or len(second) == 4  # 32 trials
    assert solution.trials == 120
    assert staged.task.stages[1].step == 0.5
    # what the first stage does not simulate it cannot know
    for g in generations:
        assert np.isnan(g.evaluation.terms["after"]).all() == (g.stage_name == "first")
        assert np.isnan(g.evaluation.errors["later"]).all() == (g.stage_name == "first")
        # how fast it is at the end, a part of the hold does not tell
        assert np.isnan(g.evaluation.errors["still"]).all() == (g.stage_name != "third")
        assert not np.isnan(g.evaluation.terms["orientation"]).any()
    assert np.isfinite([*solution.best.terms.values(), *solution.best.errors.values()]).all()


@pytest.mark.slow
def test_the_best_never_gets_worse_within_a_stage(staged: Objective) -> None:
    _, generations = collect(staged, seed=5)
    for stage in range(3):
        ranks = [(not g.best.success, g.best.cost) for g in generations if g.stage == stage]
        assert ranks == sorted(ranks, reverse=True)


@pytest.mark.slow
def test_costs_of_a_stage_are_by_its_own_weights(staged: Objective) -> None:
    _, generations = collect(staged)
    full = {"orientation": 1000.0, "position": 100.0, "effort": 0.1, "after": 50.0}
    for g in generations:
        weights = full | ({"effort": 0.0, "after": 0.0} if g.stage == 0 else {})
        terms = g.evaluation.terms
        expected = sum(weights[name] * np.nan_to_num(terms[name]) for name in full)
        np.testing.assert_allclose(g.cost, expected, rtol=1e-12)


@pytest.mark.slow
def test_a_step_factor_multiplies_the_step_at_the_start_of_its_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    from levade.optimizers import CMAES

    base = rearing()
    first, last = (dataclasses.replace(stage, promote={}) for stage in base.task.stages)
    stages = (dataclasses.replace(first, trials=16), dataclasses.replace(last, step=0.25))
    objective = changed(base, stages=stages, search=dataclasses.replace(base.task.search, trials=40, population=8))
    scaled: list[tuple[float, float]] = []
    scale = CMAES.scale_step

    def watch(self: CMAES, factor: float) -> None:
        before = self.step
        scale(self, factor)
        scaled.append((before, self.step))

    monkeypatch.setattr(CMAES, "scale_step", watch)
    _, generations = collect(objective)
    assert [g.stage for g in generations] == [0, 0, 1, 1, 1]
    assert scaled == [(generations[1].step, 0.25 * generations[1].step)]


@pytest.mark.slow
def test_without_success_a_search_starts_anew_from_its_first_stage(staged: Objective) -> None:
    never = {"pitch": dataclasses.replace(staged.task.success["pitch"], tolerance=0.0)}
    stages = tuple(dataclasses.replace(stage, promote={}) for stage in staged.task.stages)
    search = dataclasses.replace(staged.task.search, restart=40, trials=96)
    objective = changed(staged, success=never, stages=stages, search=search)
    solution, generations, records = recorded(objective)
    assert solution.trials_to_success is None
    assert [g.stage for g in generations] == [0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0]
    first = [generations[i] for i in (0, 5, 10)]
    assert len({g.cost.tobytes() for g in first}) == 3  # other candidates
    assert all(g.step == pytest.approx(first[0].step, rel=0.5) for g in first)
    costs = [g.best.cost for g in generations[:3]]
    assert costs == sorted(costs, reverse=True)
    assert_same(solve(objective, records=records[6]), solution)
    once = changed(objective, search=dataclasses.replace(search, restart=None))
    assert [g.cost.tolist() for g in collect(once)[1]][:5] == [g.cost.tolist() for g in generations][:5]


def test_only_a_whole_hold_counts_as_success(staged: Objective) -> None:
    """Trials that look good before the hold is simulated are simulated through it."""
    criteria = dict(staged.task.success)
    criteria["pitch"] = dataclasses.replace(criteria["pitch"], tolerance=1.0)
    weights = staged.space.mean + 0.1 * np.random.default_rng(0).normal(size=(6, staged.policy.size))
    through = changed(staged, success=criteria).evaluate(weights)
    late = np.median(np.abs(through.errors["later"]))
    criteria["later"] = dataclasses.replace(criteria["later"], tolerance=float(late))  # half of them fail it
    objective = changed(staged, success=criteria)
    whole = objective.evaluate(weights)
    assert 0 < whole.success.sum() < 6
    for hold_steps in (0, 10):
        judging = Judge(objective.task, 0).nominal(weights, hold_steps, verify=True)
        np.testing.assert_array_equal(answered(judging, objective).success, whole.success)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_for_any_number_of_threads(staged: Objective) -> None:
    two = make_objective(staged.task, threads=2)
    one, first = collect(staged, seed=2)
    other, second = collect(two, seed=2)
    assert_same(one, other)
    for g, h in zip(first, second, strict=True):
        np.testing.assert_array_equal(g.cost, h.cost)
    different, _ = collect(staged, seed=3)
    assert not np.array_equal(different.best.weights, one.best.weights)


@pytest.mark.slow
@pytest.mark.parametrize("stop_after", [1, 3, 4, 6, 14, 15])
def test_an_interrupted_search_goes_on_to_the_same_end(staged: Objective, stop_after: int) -> None:
    """Interruptions before, at and after changes of the stage, and after the last generation."""
    whole, generations, records = recorded(staged, seed=1)
    assert len(generations) == 15

    def stop(g: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if g.generation == stop_after else None

    part = solve(staged, seed=1, observe=stop)
    assert (part.stopped, part.generations, part.trials) == ("interrupted", stop_after, 8 * stop_after)
    rank = (not part.best.success, part.best.cost)
    assert np.isfinite(rank).all()
    rest, again = collect(staged, seed=1, records=records[stop_after - 1])
    assert_same(rest, whole)
    assert [g.replayed for g in again] == [True] * stop_after + [False] * (15 - stop_after)
    for g, h in zip(generations, again, strict=True):
        np.testing.assert_array_equal(g.cost, h.cost)
        assert (g.best.cost, g.best.success, g.step, g.stage, g.diverged) == (
            h.best.cost,
            h.best.success,
            h.step,
            h.stage,
            h.diverged,
        )


def test_an_interruption_before_the_first_generation_leaves_the_first_mean(staged: Objective) -> None:
    other = changed(staged)

    evaluate = other.evaluate
    calls = 0

    def first_fails(trials: Trials) -> Evaluation:
        nonlocal calls
        calls += 1
        if calls == 1:
            raise KeyboardInterrupt
        return evaluate(trials)

    other.evaluate = first_fails  # type: ignore[method-assign]
    solution = solve(other)
    assert (solution.stopped, solution.trials, solution.generations) == ("interrupted", 0, 0)
    np.testing.assert_array_equal(solution.best.weights, staged.space.mean)


@pytest.mark.slow
def test_an_interruption_while_the_best_is_simulated_again_keeps_it(staged: Objective) -> None:
    """The change of stage after generation 3 simulates the best trial through its hold."""
    _, generations = collect(staged)
    other = changed(staged)
    calls, evaluate = 0, staged.evaluate

    def fourth_fails(trials: Trials) -> Evaluation:
        nonlocal calls
        calls += 1
        if calls == 4:
            assert trials.n == 1
            raise KeyboardInterrupt
        return evaluate(trials)

    other.evaluate = fourth_fails  # type: ignore[method-assign]
    solution = solve(other)
    assert solution.stopped == "interrupted"
    np.testing.assert_array_equal(solution.best.weights, generations[2].best.weights)


@pytest.mark.slow
def test_records_of_another_search_are_refused(staged: Objective) -> None:
    records = recorded(staged, seed=1)[2][3]
    with pytest.raises(LevadeError, match="record 1 belongs to another search: the task, the seed or"):
        solve(staged, seed=2, records=records)
    with pytest.raises(LevadeError, match="record 2 belongs to another search"):
        solve(staged, seed=1, records=[records[0], records[2]])


def test_a_record_survives_json_to_the_bit() -> None:
    random = np.random.default_rng(0)
    numbers = np.concatenate(
        [random.normal(size=50) * 10.0 ** random.integers(-300, 300, size=50), [np.nan, -0.0, 1e12]]
    )
    evaluation = Evaluation(
        {"a": numbers, "b": np.full(53, np.nan)},
        {"c": numbers / 3},
        random.random(53) < 0.5,
        random.random(53) < 0.5,
        slack={"c": numbers / 7},
    )
    text = json.dumps(Record(2**32 - 1, evaluation).to_json(), allow_nan=False)
    again = Record.from_json(json.loads(text))
    assert again.checksum == 2**32 - 1
    for one, other in (
        (evaluation.terms["a"], again.evaluation.terms["a"]),
        (evaluation.terms["b"], again.evaluation.terms["b"]),
        (evaluation.errors["c"], again.evaluation.errors["c"]),
        (evaluation.slack["c"], again.evaluation.slack["c"]),
        (evaluation.success, again.evaluation.success),
        (evaluation.diverged, again.evaluation.diverged),
    ):
        assert one.dtype == other.dtype
        assert one.tobytes() == other.tobytes()


@pytest.mark.slow
def test_a_cost_of_ones_own_is_optimised() -> None:
    base = load_task(
        "rearing",
        changes=["search.population=8", "search.trials=160", "search.polish=null", "horizon=0.1", "search.step=0.02"],
    )
    mine = {"knee": Cost(lambda t: np.square(t.joint_position[:, -1, 2] + 1.6), 1.0)}
    stage = dataclasses.replace(base.stages[-1], weights={}, promote={}, step=1.0)
    task = dataclasses.replace(base, costs=mine, success={}, stages=(stage,))
    solution, generations = collect(make_objective(task, threads=1))
    assert solution.best.cost < 0.3 * generations[0].cost.min()
    assert solution.success  # no criteria: every trial that does not break down


@pytest.mark.slow
def test_levades_search_goes_through_stages_within_its_budget_and_again_from_records(staged: Objective) -> None:
    """Its generations differ in size: with aimed candidates, of them alone, and of probes and steps of a finish."""
    search = dataclasses.replace(staged.task.search, optimizer="levade", trials=240)
    objective = changed(staged, search=search)
    solution, generations, records = recorded(objective)
    sizes = {len(g.cost) for g in generations}
    assert 8 in sizes
    assert {14, objective.policy.independent_joints} & sizes
    assert generations[0].stage_name == "first"
    assert {g.stage_name for g in generations} >= {"first", "second", "third"}
    assert generations[-1].trials == solution.trials == sum(len(g.cost) for g in generations) <= 240
    assert_same(solve(objective, records=records[8]), solution)
