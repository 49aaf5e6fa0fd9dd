"""Learn which motion works from where. Several kinds of models compete; the one whose first answers work most often wins.

    found = learn(Library.load("falls"))
    found.scores["trees"].first, found.chosen
    save(found, Path("falls"))                      # from then on, the library answers by it

Each kind is judged by cross-validation with five folds. Fitting needs scikit-learn (`pip install 'levade[learn]'`). A fitted
model consists of arrays, so answering needs only numpy (`levade.exports.asker.Learned`).
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from levade.archive import packed
from levade.arrays import Array
from levade.errors import LevadeError, Remedy
from levade.exports.asker import Learned, Model, calibrated, features
from levade.library.asking import LEARNED, Library
from levade.library.knowledge import Knowledge
from levade.search.storage import storing
from levade.writing import replacing

NEAREST = "nearest"
"""Kind of the model that a library uses if nothing was learned: the nearest falls."""

_PARTS = 5
"""Number of cross-validation folds."""

_FEWEST = 10
"""Fewest falls that are worth learning from."""

_BETTER = 0.001
"""Share of first answers by which a kind has to be better than an earlier, simpler one."""

_TREES, _DEPTH, _NETWORKS, _HIDDEN = 60, 3, 3, 16

Fit = Callable[[Array, Array], dict[str, NDArray[Any]]]


@dataclass(frozen=True)
class Score:
    """Reports how well a kind of model does on falls to which it was not fitted.

    Attributes:
        first: Share of first answers that work; the nominal and the perturbed model count equally.
        brier: Brier score: mean squared difference between the probability and the outcome of each pair of fall and motion.
        said: Mean probability that the first answers predict.
    """

    first: float
    brier: float
    said: float


@dataclass(frozen=True, eq=False)
class Learning:
    """Holds the result of learning.

    Attributes:
        scores: Kind of model -> its score.
        chosen: The kind whose first answers work most often; the simplest one among equals.
        model: The chosen model, fitted to all falls. None if it is `NEAREST`.
        knowledge: The data to which it was fitted.
    """

    scores: Mapping[str, Score]
    chosen: str
    model: Learned | None
    knowledge: Knowledge


def learn(library: Library) -> Learning:
    """Fit each kind of model, and choose the best one.

    Args:
        library: A library whose build is complete.

    Returns:
        Scores and the chosen model.

    Raises:
        LevadeError: If scikit-learn is missing, the library has too few falls, or its build is not complete.
    """
    try:
        import sklearn  # noqa: F401
    except ImportError:
        raise LevadeError("learning needs scikit-learn: pip install 'levade[learn]'") from None
    known = library.knowledge
    if len(known.falls) < _FEWEST or not len(known.motions):
        raise LevadeError(
            f"{library.directory}: {len(known.falls)} falls are too few to learn from; build {_FEWEST} or more"
        )
    if np.isnan(known.success + known.perturbed).any():
        raise LevadeError(f"{library.directory}: not every motion was tried from every fall; complete the build")
    with threadpool_limits(
        limits=1
    ):  # for small matrices, threads cost more than they gain; scikit-learn's own libraries are loaded now
        return _learned(known)


def _learned(known: Knowledge) -> Learning:
    works = (known.success + known.on_others) / 2
    held = {kind: np.zeros(works.shape) for kind in (NEAREST, *_FITS)}
    for part in range(_PARTS):
        out = np.arange(len(known.falls)) % _PARTS == part
        near, x, y = _part(known, ~out).model, *_table(known, ~out)
        models: dict[str, Model | Learned] = {NEAREST: near}
        models |= {kind: Learned(kind, known.motions, fit(x, y)) for kind, fit in _FITS.items()}
        for kind, model in models.items():
            for row in np.flatnonzero(out):
                held[kind][row] = model.probabilities(known.up[row], known.joint_position[row])
    lines = {kind: _line(raw, works) if kind != NEAREST else (1.0, 0.0) for kind, raw in held.items()}
    scores = {
        kind: _score(calibrated(held[kind], *lines[kind]) if kind != NEAREST else held[kind], works) for kind in held
    }
    chosen = NEAREST
    for kind, score in scores.items():
        if score.first > scores[chosen].first + _BETTER:
            chosen = kind
    model = None
    if chosen != NEAREST:
        arrays = _FITS[chosen](*_table(known, np.ones(len(known.falls), dtype=bool)))
        model = Learned(chosen, np.asarray(known.motions, dtype=np.int64), arrays, *lines[chosen])
    return Learning(scores, chosen, model, known)


def save(learning: Learning, directory: Path) -> None:
    """Write the learned model into a library's directory. If `NEAREST` was chosen, remove an earlier model.

    Args:
        learning: Result of `learn`.
        directory: Directory of the library.

    Raises:
        LevadeError: If the file cannot be written.
    """
    place = directory / LEARNED
    with storing(place, then=Remedy("make room, then learn again")):
        if learning.model is None:
            place.unlink(missing_ok=True)
            return
        with replacing(place) as partial:
            partial.write_bytes(packed(arrays_of(learning.model) | {"falls": learning.knowledge.falls}))


def arrays_of(model: Learned) -> dict[str, NDArray[Any]]:
    """Return what a file holds of a learned model.

    Args:
        model: The learned model.

    Returns:
        Arrays by name.
    """
    head = {"kind": np.array(model.kind), "motions": model.motions}
    numbers = {"slope": np.array(model.slope), "offset": np.array(model.offset)}
    return head | numbers | {name: np.asarray(values) for name, values in model.arrays.items()}


def _part(known: Knowledge, rows: NDArray[np.bool_]) -> Knowledge:
    """Return the knowledge about some of the falls."""
    names = ("falls", "up", "joint_position", "success", "perturbed")
    again = None if known.again is None else known.again[:, rows]
    return replace(known, again=again, **{name: getattr(known, name)[rows] for name in names})


def _table(known: Knowledge, rows: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Return features of some falls and their images, shape (k, f), and how often each motion works there, shape (k, m)."""
    up, joints = known.up[rows], known.joint_position[rows]
    works = ((known.success + known.on_others) / 2)[rows]
    x = features(up, joints)
    if known.mirror is None:
        return x, works
    image = features(known.mirror.up(up), known.mirror.posture(joints))
    return np.concatenate([x, image]), np.concatenate([works, works[:, known.model.image]])


def _line(raw: Array, works: Array) -> tuple[float, float]:
    """Fit slope and offset of the log odds on held-out falls, so that probabilities are calibrated (Platt, 1999)."""
    from sklearn.linear_model import LogisticRegression

    raw = np.clip(raw.ravel(), 0.005, 0.995)
    odds, share = np.log(raw / (1.0 - raw))[:, None], works.ravel()
    if share.min() == 1.0 or share.max() == 0.0:
        return 1.0, 0.0
    fitted = LogisticRegression(C=10.0).fit(
        np.concatenate([odds, odds]),
        np.repeat([1, 0], len(share)),
        sample_weight=np.concatenate([share, 1.0 - share]),
    )
    slope = float(fitted.coef_[0, 0])
    return (slope, float(fitted.intercept_[0])) if slope > 0 else (1.0, 0.0)


def _score(probability: Array, works: Array) -> Score:
    rows, first = np.arange(len(works)), np.argmax(probability, axis=1)
    brier = float(((probability - works) ** 2).mean())
    return Score(float(works[rows, first].mean()), brier, float(probability[rows, first].mean()))


def _gaussian_process(x: Array, y: Array) -> dict[str, NDArray[Any]]:
    """Fit one kernel for all motions, with the likeliest length and noise (Rasmussen and Williams, 2006, ch. 5)."""
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    mean = y.mean(axis=0)
    kernel = ConstantKernel(0.1, (1e-3, 10.0)) * RBF(0.5, (0.05, 5.0)) + WhiteKernel(0.05, (1e-3, 1.0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a hyperparameter may end at its bound
        fitted = GaussianProcessRegressor(kernel).fit(x, y - mean)
    own = fitted.kernel_.k1
    weights = fitted.alpha_.reshape(len(x), y.shape[1])
    return {
        "states": x,
        "weights": weights,
        "mean": mean,
        "length": np.array([own.k2.length_scale]),
        "amplitude": np.array([own.k1.constant_value]),
    }


def _trees(x: Array, y: Array) -> dict[str, NDArray[Any]]:
    """Fit boosted trees for each motion."""
    from sklearn.ensemble import GradientBoostingRegressor

    nodes = 2 ** (_DEPTH + 1) - 1
    shape = (y.shape[1] * _TREES, nodes)
    feature, left, right = (np.zeros(shape, dtype=np.int64) for _ in range(3))
    threshold, value = np.zeros(shape), np.zeros(shape)
    first = np.zeros(y.shape[1])
    for j in range(y.shape[1]):
        fitted = GradientBoostingRegressor(n_estimators=_TREES, max_depth=_DEPTH, subsample=0.8, random_state=0).fit(
            x, y[:, j]
        )
        first[j] = fitted.init_.constant_[0, 0]
        for k, (one,) in enumerate(fitted.estimators_):
            tree, row = one.tree_, j * _TREES + k
            n, leaf = tree.node_count, tree.children_left < 0
            own = np.arange(n)
            feature[row, :n] = np.where(leaf, 0, tree.feature)
            threshold[row, :n] = tree.threshold
            left[row, :n] = np.where(leaf, own, tree.children_left)
            right[row, :n] = np.where(leaf, own, tree.children_right)
            value[row, :n] = fitted.learning_rate * tree.value[:, 0, 0]
    return {
        "feature": feature,
        "threshold": threshold,
        "left": left,
        "right": right,
        "value": value,
        "motion": np.repeat(np.arange(y.shape[1]), _TREES),
        "first": first,
        "depth": np.array([_DEPTH]),
    }


def _networks(x: Array, y: Array) -> dict[str, NDArray[Any]]:
    """Fit small networks that differ in their initial weights."""
    from sklearn.neural_network import MLPRegressor

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        fitted = [
            MLPRegressor(
                hidden_layer_sizes=(_HIDDEN,),
                activation="tanh",
                solver="lbfgs",
                alpha=0.03,
                max_iter=150,
                random_state=seed,
            ).fit(x, y)
            for seed in range(_NETWORKS)
        ]
    motions = y.shape[1]
    return {
        "into": np.array([one.coefs_[0] for one in fitted]),
        "bias": np.array([one.intercepts_[0] for one in fitted]),
        "out": np.array([one.coefs_[1].reshape(_HIDDEN, motions) for one in fitted]),
        "last": np.array([one.intercepts_[1].reshape(motions) for one in fitted]),
    }


_FITS: dict[str, Fit] = {"gaussian-process": _gaussian_process, "trees": _trees, "networks": _networks}
"""Kinds of models, the simplest first."""
