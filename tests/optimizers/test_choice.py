"""An optimizer is chosen by name, as a class or function, or as an object; those of one's own are checked."""

from __future__ import annotations

import inspect
import math
from typing import Any

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.optimizers import (
    ALIASES,
    CEM,
    OPTIMIZERS,
    AimedCMAES,
    SearchSpace,
    UsesErrors,
    can_restart,
    canonical,
    make_optimizer,
    settings,
)

SPACE = SearchSpace(np.zeros(3), step=0.1)


class Own:
    """The least that an optimizer can be: a fixed set of candidates around the mean."""

    def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...], rows: int = 5) -> None:
        self.random, self.space, self.rows = np.random.default_rng(seed), space, rows
        self.asked, self.told = 0, []

    def ask(self) -> Any:
        self.asked += 1
        return self.space.candidates(self.random.standard_normal((self.rows, self.space.dimensions)))

    def tell(self, cost: np.ndarray) -> None:
        self.told.append(cost)


class Whole(Own):
    """All that an optimizer may be."""

    population, mean, step = 9, (1.0, 2.0, 3.0), 0.25

    def tell(self, cost: np.ndarray, errors: np.ndarray | None = None) -> None:
        self.told.append((cost, errors))

    def scale_step(self, factor: float) -> None:
        self.step *= factor

    def forget_costs(self, changed: np.ndarray) -> None:
        self.forgotten = changed


@pytest.mark.parametrize("name", OPTIMIZERS)
def test_settings_are_declared_as_the_constructor_takes_them(name: str) -> None:
    parameters = inspect.signature(OPTIMIZERS[name]).parameters
    assert list(parameters) == ["space", "seed", *settings(name)]
    assert all(parameters[own].kind is inspect.Parameter.KEYWORD_ONLY for own in ("seed", *settings(name)))


def test_an_alias_is_the_same_optimizer() -> None:
    assert canonical("levade") == "cma-aimed" == canonical("cma-aimed")
    assert settings("levade") == settings("cma-aimed")
    assert set(ALIASES.values()) <= set(OPTIMIZERS)
    one, other = (make_optimizer(name, SPACE, seed=1) for name in ("levade", "cma-aimed"))
    assert type(one) is type(other) is AimedCMAES
    np.testing.assert_array_equal(one.ask(), other.ask())


@pytest.mark.parametrize("name", OPTIMIZERS)
def test_a_name_makes_what_its_class_makes(name: str) -> None:
    by_name = make_optimizer(name, SPACE, seed=(3, 1))
    assert type(by_name) is OPTIMIZERS[name]
    np.testing.assert_array_equal(by_name.ask(), OPTIMIZERS[name](SPACE, seed=(3, 1)).ask())


def test_settings_reach_the_optimizer_however_it_is_chosen() -> None:
    given, plain = (make_optimizer("cem", SPACE, seed=0, settings=own) for own in ({"smoothing": 1.0}, {}))
    for optimizer in (given, plain):
        optimizer.tell(np.square(optimizer.ask()).sum(axis=1))
    assert np.abs(given.mean).max() > np.abs(plain.mean).max()  # type: ignore[arg-type]
    assert make_optimizer(Own, SPACE, seed=0, settings={"rows": 7}).ask().shape == (7, 3)
    assert make_optimizer(CEM, SPACE, seed=0, settings={"elite": 0.5}).population == 7


@pytest.mark.parametrize("ready", [False, True])
def test_what_an_optimizer_of_ones_own_lacks_is_supplied(ready: bool) -> None:
    own = Own(SPACE, seed=0)
    optimizer = make_optimizer(own if ready else lambda space, *, seed: own, SPACE, seed=0)
    assert not isinstance(optimizer, UsesErrors)
    assert own.asked == 0
    assert optimizer.population == 5
    assert own.asked == 1  # its candidates are kept
    assert math.isnan(optimizer.step)
    assert optimizer.mean is None
    optimizer.scale_step(0.5)
    np.testing.assert_array_equal(optimizer.ask(), Own(SPACE, seed=0).ask())
    assert optimizer.population == 5
    assert own.asked == 1
    optimizer.tell(np.arange(5.0))
    np.testing.assert_array_equal(own.told, [np.arange(5.0)])
    own.rows = 8
    assert optimizer.population == 8
    assert optimizer.ask().shape == (8, 3)
    assert own.asked == 2


def test_what_it_has_is_used() -> None:
    own = Whole(SPACE, seed=0)
    optimizer = make_optimizer(own, SPACE, seed=0)
    assert isinstance(optimizer, UsesErrors)
    assert (optimizer.population, own.asked) == (9, 0)
    np.testing.assert_array_equal(optimizer.mean, [1.0, 2.0, 3.0])
    optimizer.scale_step(2.0)
    assert optimizer.step == 0.5
    optimizer.ask()
    optimizer.tell(np.zeros(5), np.ones((5, 2)))
    np.testing.assert_array_equal(own.told[0][1], np.ones((5, 2)))
    optimizer.forget_costs(np.array([True, False]))
    np.testing.assert_array_equal(own.forgotten, [True, False])


def test_one_of_levades_own_by_its_class_is_as_by_its_name() -> None:
    wrapped, plain = make_optimizer(AimedCMAES, SPACE, seed=2), make_optimizer("cma-aimed", SPACE, seed=2)
    assert isinstance(wrapped, UsesErrors)
    assert isinstance(plain, UsesErrors)
    for _ in range(4):
        x = wrapped.ask()
        np.testing.assert_array_equal(x, plain.ask())
        wrapped.tell(np.square(x).sum(axis=1), x)
        plain.tell(np.square(x).sum(axis=1), x)
    assert wrapped.population == plain.population


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (
            np.zeros(3),
            "Own.ask: expected candidates of shape (n, 3) with n of at least 1, got (3,); one row for each candidate",
        ),
        (np.zeros((5, 4)), "Own.ask: expected candidates of shape (n, 3) with n of at least 1, got (5, 4)"),
        (np.zeros((0, 3)), "Own.ask: expected candidates of shape (n, 3) with n of at least 1, got (0, 3)"),
        (np.array([[0, 0, 0], [0, np.inf, 0]]), "Own.ask: candidates [1] of 2 are not finite; expected angles in rad"),
        ([[1, 2, 3], [4]], "Own.ask: expected candidates of shape (n, 3), got list"),
        (None, "Own.ask: expected candidates of shape (n, 3) with n of at least 1, got ()"),
    ],
)
def test_what_it_asks_for_is_checked(asked: Any, message: str) -> None:
    own = Own(SPACE, seed=0)
    own.ask = lambda: asked  # type: ignore[method-assign]
    for look in ("ask", "population"):
        optimizer = make_optimizer(own, SPACE, seed=0)
        with pytest.raises(LevadeError) as refused:
            optimizer.ask() if look == "ask" else optimizer.population
        assert str(refused.value) == message


def test_candidates_are_kept_apart_from_an_array_that_it_uses_again() -> None:
    own, buffer = Own(SPACE, seed=0), np.zeros((2, 3))
    own.ask = lambda: buffer  # type: ignore[method-assign]
    asked = make_optimizer(own, SPACE, seed=0).ask()
    buffer[:] = 1.0
    assert (asked == 0).all()


def test_tell_before_ask_is_refused() -> None:
    optimizer = make_optimizer(Own, SPACE, seed=0)
    assert optimizer.population == 5  # which is not to ask
    with pytest.raises(RuntimeError, match="ask first"):
        optimizer.tell(np.zeros(5))


def test_a_ready_object_cannot_be_made_again() -> None:
    own = Own(SPACE, seed=0)
    assert [can_restart(choice) for choice in ("cma", Own, lambda space, *, seed: own, own)] == [
        True,
        True,
        True,
        False,
    ]
    make_optimizer(Own, SPACE, seed=(0, 1), again=True)
    with pytest.raises(LevadeError, match=r"Own is a ready object, .*; give a class or function instead"):
        make_optimizer(own, SPACE, seed=(0, 1), again=True)


@pytest.mark.parametrize(
    ("choice", "own", "message"),
    [
        ("cmaa", {}, "no optimizer 'cmaa'; did you mean cma?"),
        ("cem", {"elit": 0.2}, "elit: no such setting of cem; did you mean elite?"),
        ("random", {"elite": 0.2}, "elite: no such setting of random; it takes none"),
        ("levade", {"aimd": 6}, "aimd: no such setting of cma-aimed; did you mean aimed?"),
        (
            object(),
            {},
            "optimizer: expected a name, a class or function (space, *, seed), or an object with ask and tell; got ",
        ),
        (lambda space, *, seed: 3, {}, "optimizer: int has no method ask; it needs ask and tell"),
        (Own(SPACE, seed=0), {"rows": 3}, "optimizer: Own is a ready object, which takes no settings; "),
    ],
)
def test_what_is_no_optimizer_is_refused(choice: Any, own: dict[str, Any], message: str) -> None:
    with pytest.raises(LevadeError) as refused:
        make_optimizer(choice, SPACE, seed=0, settings=own)
    assert str(refused.value).startswith(message)
