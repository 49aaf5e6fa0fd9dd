"""Starts that are predicted from how a robot lies; what is chosen on which falls; and what the tables count."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from levade.arrays import Array
from levade.library.mirror import Mirror

MIRROR = Mirror(np.array([1, 0]), np.array([1.0, 1.0]))
Script = Callable[[str], ModuleType]


def image(weights: Array) -> Array:
    return weights[..., [1, 0, 3, 2]]


def examples(starts: ModuleType, law: Callable[[Array, Array], Array], n: int = 20) -> Any:
    """Falls whose motions follow a law, and their images."""
    draw = np.random.default_rng(0)
    up = draw.standard_normal((n, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    joints = draw.uniform(-1, 1, (n, 2))
    weights = law(up, joints)
    return starts.Examples(
        np.concatenate([up, MIRROR.up(up)]),
        np.concatenate([joints, MIRROR.posture(joints)]),
        np.concatenate([weights, image(weights)]),
    )


def straight(up: Array, joints: Array) -> Array:
    """A linear law with one principal component: to the left one way, to the right the other."""
    return up[..., 1:2] * np.array([1.0, -1.0, 2.0, -2.0])


def test_the_nearest_motion_may_be_an_image(script: Script) -> None:
    starts = script("starts")
    of = examples(starts, lambda up, joints: np.arange(4.0 * len(up)).reshape(-1, 4))
    np.testing.assert_array_equal(starts.nearest(of, of.up[7], of.joint_position[7]), of.weights[7])
    here = MIRROR.up(of.up[7]), MIRROR.posture(of.joint_position[7])
    np.testing.assert_array_equal(starts.nearest(of, *here), image(of.weights[7]))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["ridge", "gaussian process"])
def test_a_regression_finds_a_law(script: Script, kind: str) -> None:
    if kind == "gaussian process":
        pytest.importorskip("sklearn.gaussian_process", reason="it needs scikit-learn: pip install levade[learn]")
    starts = script("starts")
    of, up, joints = examples(starts, straight), np.array([0.0, 0.6, 0.8]), np.array([0.1, -0.3])
    np.testing.assert_allclose(starts.LEARNED[kind](of, up, joints), straight(up, joints), atol=0.05)


@pytest.mark.parametrize("kind", ["mean of 3", "ridge"])
def test_the_image_of_a_state_has_the_image_of_the_start(script: Script, kind: str) -> None:
    starts = script("starts")
    draw = np.random.default_rng(1)
    of = examples(starts, lambda up, joints: draw.standard_normal((len(up), 4)))
    up, joints = np.array([0.6, 0.64, 0.48]), np.array([0.2, -0.5])
    start = starts.LEARNED[kind]
    np.testing.assert_allclose(
        start(of, MIRROR.up(up), MIRROR.posture(joints)), image(start(of, up, joints)), atol=1e-9
    )
    assert np.abs(image(start(of, up, joints)) - start(of, up, joints)).max() > 1e-3


def test_a_library_never_holds_the_fall_itself(script: Script) -> None:
    starts = script("starts")
    for fall in range(12):
        own = starts.members(10, fall, [one for one in range(12) if one != fall])
        assert fall not in own
        assert len(set(own)) == 10
    assert starts.members(3, 0, range(12)) != starts.members(3, 1, range(12))


def row(seed: int, fall: int, kind: str, step: float, **more: Any) -> dict[str, Any]:
    size = 0 if kind == "cold" else 3
    about = {"robot": "toy", "folds": False, "seed": seed, "fall": fall, "size": size, "kind": kind, "step": step}
    return {**about, "success": True, **more}


def test_unseen_falls_choose_nothing(script: Script) -> None:
    """Of the kinds, that which works at once most often; of the steps, that with fewer trials: both on the library's falls."""
    starts = script("starts")
    rows = []
    for seed, best, step in ((starts.LIBRARY_SEED, "ridge", 0.25), (starts.UNSEEN_SEED, "mean of 3", 0.5)):
        for kind in starts.LEARNED:
            rows.append(row(seed, 0, kind, 0.0, success=kind == best, cost=1.0))
            rows += [row(seed, 0, kind, one, trials=1 if one == step else 9) for one in starts.STEPS]
    assert starts.chosen(rows) == ("ridge", 0.25)


def test_trials_are_compared_on_the_same_fall(script: Script) -> None:
    """Only falls with every search count. Where no known motion works is told apart."""
    starts = script("starts")
    rows = [row(starts.LIBRARY_SEED, 0, kind, 0.0, success=kind == "ridge", cost=1.0) for kind in starts.LEARNED]
    rows += [row(starts.LIBRARY_SEED, 0, "ridge", step, trials=3) for step in starts.STEPS]
    for fall, (cold, nearest, learned) in enumerate([(40, 1, 1), (20, 10, 30)]):
        rows += [
            row(starts.UNSEEN_SEED, fall, "cold", 1.0, trials=cold),
            row(starts.UNSEEN_SEED, fall, "nearest", starts.AROUND, trials=nearest),
            row(starts.UNSEEN_SEED, fall, "ridge", starts.AROUND, trials=learned),
            row(starts.UNSEEN_SEED, fall, "known", starts.AROUND, trials=7, works=None if fall else 1),
        ]
    rows.append(row(starts.UNSEEN_SEED, 2, "cold", 1.0, trials=1000))
    parts = [("toy", rows)]
    assert "| toy | 3 | 2 | 30.0, 30 | 5.5, 5.5 | 7.0, 7 | 15.5, 15.5 | ridge, step 0.5 |" in starts.per_fall(parts)
    line = starts.paired(parts).splitlines()[-1]
    assert line == "| toy | 3 | -24.5 (-39.0 to -10.0) | -14.5 (-39.0 to +10.0) | +10.0 (+0.0 to +20.0) | 0, 1, 1 |"
    assert starts.hard(parts).splitlines()[-1] == "| toy | 3 | 1 of 2 | 20 | 10 | 7 | 30 |"
