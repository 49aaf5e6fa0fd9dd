"""The weighted sum of eq. 5, and what becomes of trials that broke down."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from levade.costs import (
    DIVERGED,
    HIGHEST,
    Criterion,
    Effort,
    GroundContact,
    JointLimitExcess,
    LinearVelocity,
    Orientation,
    Position,
    TorqueLimitExcess,
    evaluate,
    total,
)
from levade.errors import LevadeError

TERMS = {
    "orientation": Orientation(pitch=-1.0472),
    "position": Position(z=0.9),
    "effort": Effort(normalised=False),
    "joint_limits": JointLimitExcess(),
    "torque_limits": TorqueLimitExcess(over="all"),
    "rest": LinearVelocity(0.0, 0.0, 0.0, at="hold"),
    "contact": GroundContact(("trunk",), "impulse"),
    "mine": lambda trajectories: trajectories.joint_velocity.max(axis=(1, 2)),
}
WEIGHTS = {"orientation": 1e3, "position": 1e2, "effort": 0.1, "joint_limits": 1, "torque_limits": 2, "rest": 3} | {
    "contact": 0.5,
    "mine": 0,
}


def test_the_cost_is_the_weighted_sum(make):
    t = make()
    values = evaluate(TERMS, t)
    assert list(values) == list(TERMS)
    for name, term in TERMS.items():
        np.testing.assert_array_equal(values[name], term(t))
    np.testing.assert_allclose(total(values, WEIGHTS), sum(WEIGHTS[name] * TERMS[name](t) for name in TERMS))


def test_the_cost_has_the_same_bits_for_one_trial_as_for_a_batch():
    random = np.random.default_rng(0)
    values = {f"term {i}": random.normal(size=19) for i in range(20)}
    weights = {name: random.normal() for name in values}
    batch = total(values, weights)
    for i in range(19):
        assert total({name: value[i : i + 1] for name, value in values.items()}, weights)[0] == batch[i]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e300, 1e200])
def test_broken_trials_cost_a_finite_amount_and_rank_last(make, bad):
    """Warnings are errors in these tests: none may leak either."""
    t = make(4)
    arrays = {
        field.name: value.copy()
        for field in dataclasses.fields(t)
        if isinstance(value := getattr(t, field.name), np.ndarray) and value.dtype == float and value.ndim == 3
    }
    for value in arrays.values():
        value[2] = bad
    t = dataclasses.replace(t, **arrays, diverged=np.array([False, True, False, False]))
    values = evaluate(TERMS, t)
    assert np.isfinite(list(values.values())).all()
    for name in values:
        assert values[name][1] == DIVERGED
        np.testing.assert_array_equal(values[name][[0, 3]], evaluate({name: TERMS[name]}, make(4))[name][[0, 3]])
    cost = total(values, WEIGHTS)
    assert np.isfinite(cost).all()
    assert cost[1] == DIVERGED
    assert max(cost[0], cost[3]) < cost[2] <= DIVERGED
    for quantity in ("pitch", "tilt", "height", "speed", "angular_speed"):
        for at in ("horizon", "end", "max", "min", "hold"):
            criterion = Criterion(quantity, maximum=1e3, at=at)
            error, holds = criterion.error(t), criterion.holds(t)
            assert np.isfinite(error).all()
            assert list(holds[[0, 1, 3]]) == [True, False, True]
            assert quantity == "angular_speed" or np.abs(bad) < np.inf or not holds[2]


def test_a_diverged_trial_ranks_below_the_worst_that_did_not(make):
    t = make(2, diverged=np.array([True, False]))
    values = evaluate({"huge": lambda t: np.full(t.n, 1e300), "tiny": lambda t: np.full(t.n, -1e300)}, t)
    np.testing.assert_array_equal(values["huge"], [DIVERGED, HIGHEST])
    np.testing.assert_array_equal(values["tiny"], [DIVERGED, -HIGHEST])
    for weights in ({"huge": 1e300, "tiny": 1e300}, {"huge": 1e3, "tiny": 0}, {"huge": 0, "tiny": 0}):
        cost = total(values, weights)
        assert cost[0] == DIVERGED
        assert cost[1] <= HIGHEST < DIVERGED


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda t: evaluate({"mine": lambda t: 1.0}, t), r"mine: the term returned \(\); one number per trial, \(3,\)"),
        (lambda t: total({}, {}), "costs: no terms"),
        (lambda t: total({"effort": np.ones(3)}, {}), "the term effort has none"),
        (
            lambda t: total({"effort": np.ones(3)}, {"effort": 1.0, "efort": 1.0}),
            "efort is not a term; did you mean effort?",
        ),
        (lambda t: total({"effort": np.ones(3)}, {"effort": np.nan}), "that of effort is nan; give a finite number"),
    ],
)
def test_errors_say_what_would_be_right(make, call, message):
    with pytest.raises(LevadeError, match=message):
        call(make())
