"""Learning which motion works from where: it is true, numpy alone answers as scikit-learn does, the best kind is taken."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from levade.archive import packed
from levade.errors import LevadeError
from levade.exports.asker import Learned, features, unpacked
from levade.library import Library, learning
from levade.library.knowledge import Knowledge
from levade.library.learning import NEAREST, arrays_of, learn, save
from levade.library.mirror import Mirror

if find_spec("sklearn") is None:  # without importing it, which takes seconds
    pytest.skip("learning needs scikit-learn: pip install 'levade[learn]'", allow_module_level=True)

MIRROR = Mirror(np.array([1, 0]), np.array([1.0, 1.0]))


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    """As `learn` has it: small matrices wait for each other on several."""
    with threadpool_limits(limits=1):
        yield


def known(falls: int = 60, seed: int = 0) -> Knowledge:
    """Two motions and their images: one works where the robot lies on its left more than on its right, one on its back."""
    draw = np.random.default_rng(seed)
    up = draw.standard_normal((falls, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    works = np.stack([up[:, 1] > 0.2, up[:, 2] < 0, up[:, 1] < -0.2, up[:, 2] < 0], axis=1).astype(float)
    joints = draw.uniform(-1, 1, (falls, 2))
    return Knowledge(np.arange(falls, dtype=float), up, joints, np.array([0, 3, -1, -4]), works, works.copy(), MIRROR)


def library(directory: Path, knowledge: Knowledge) -> Library:
    return Library(directory, (), knowledge)


@pytest.mark.slow
@pytest.mark.parametrize("kind", list(learning._FITS))
def test_what_is_learned_is_true(kind: str) -> None:
    """On falls of another seed; and the image of a state has the image of the answer, nearly."""
    knowledge, other = known(), known(100, seed=1)
    x, y = learning._table(knowledge, np.ones(len(knowledge.falls), dtype=bool))
    model = Learned(kind, knowledge.motions, learning._FITS[kind](x, y))
    said = np.array(
        [model.probabilities(up, joints) for up, joints in zip(other.up, other.joint_position, strict=True)]
    )
    assert ((said > 0.5) == (other.success > 0.5)).mean() > 0.85
    image = np.array(
        [
            model.probabilities(MIRROR.up(up), MIRROR.posture(joints))
            for up, joints in zip(other.up, other.joint_position, strict=True)
        ]
    )
    assert np.abs(image - said[:, [2, 3, 0, 1]]).mean() < 0.1


@pytest.mark.slow
def test_trees_answer_as_those_of_scikit_learn() -> None:
    """Which motion's tree is which, where a leaf is, and which way an equal value goes: of 20 rows, and of those fitted to."""
    from sklearn.ensemble import GradientBoostingRegressor

    knowledge = known()
    x, y = learning._table(knowledge, np.ones(len(knowledge.falls), dtype=bool))
    arrays = learning._trees(x, y)
    for j in range(y.shape[1]):
        settings = {"n_estimators": learning._TREES, "max_depth": learning._DEPTH, "subsample": 0.8, "random_state": 0}
        theirs = GradientBoostingRegressor(**settings).fit(x, y[:, j]).predict(x.astype(np.float32))
        ours = [learning_raw(arrays, row)[j] for row in x.astype(np.float32).astype(float)]
        np.testing.assert_allclose(ours, theirs, atol=1e-9)


def learning_raw(arrays: dict[str, np.ndarray], x: np.ndarray) -> np.ndarray:
    from levade.exports.asker import _trees

    return _trees(arrays, x)


@pytest.mark.slow
def test_the_kind_is_taken_whose_first_answers_work_most_often(tmp_path: Path) -> None:
    """Here, probabilities are 0 or 1 at a sharp edge. Written and read back, it answers the same to the bit."""
    knowledge = known()
    found = learn(library(tmp_path, knowledge))
    best = max(score.first for score in found.scores.values())
    assert found.scores[found.chosen].first >= best - learning._BETTER
    assert all(0.0 <= score.brier < 0.25 and score.first > 0.5 for score in found.scores.values())
    assert (found.model is None) == (found.chosen == NEAREST)
    x, y = learning._table(knowledge, np.ones(len(knowledge.falls), dtype=bool))
    model = Learned("networks", knowledge.motions, learning._networks(x, y), 1.5, -0.2)
    again = unpacked(packed(arrays_of(model)))
    assert isinstance(again, Learned)
    for up, joints in zip(knowledge.up[:5], knowledge.joint_position, strict=False):
        assert again.ranked(up, joints) == model.ranked(up, joints)
    assert packed(arrays_of(again)) == packed(arrays_of(model))


@pytest.mark.slow
def test_what_was_learned_answers_until_the_library_grows(tmp_path: Path) -> None:
    knowledge = known()
    x, y = learning._table(knowledge, np.ones(len(knowledge.falls), dtype=bool))
    model = Learned("networks", knowledge.motions, learning._networks(x, y))
    save(learning.Learning({}, "networks", model, knowledge), tmp_path)
    (tmp_path / "library.yaml").write_text(f"seed: 0\nstarts: 60\nmirror: {json.dumps(MIRROR.to_json())}\n")
    (tmp_path / "falls").mkdir()
    for i in range(60):
        motion = {0: 0, 3: 3}.get(i)
        record = {"fall": i, "up": knowledge.up[i].tolist(), "joint_position": knowledge.joint_position[i].tolist()}
        record |= {"method": "cold", "motion": motion, "trials": 1, "tried": [], "worked": []}
        (tmp_path / "falls" / f"{i:06}.json").write_text(json.dumps(record))
    loaded = Library.load(tmp_path)
    up, joints = knowledge.up[7], knowledge.joint_position[7]
    answer = loaded.ask(up, joints)
    numbers, probabilities = zip(*model.ranked(up, joints), strict=True)
    assert (answer.number, *(number for number, _ in answer.others)) == numbers
    # the last bit of a product depends on where its arrays lie in memory
    assert [answer.probability, *(one for _, one in answer.others)] == pytest.approx(probabilities, rel=1e-12)
    (tmp_path / "falls" / "000059.json").unlink()
    assert Library.load(tmp_path).learned is None
    (tmp_path / "learned.npz").write_bytes(b"PK")
    with pytest.raises(LevadeError, match=r"learned\.npz: the file is damaged; remove it, or learn again"):
        Library.load(tmp_path)
    save(learning.Learning({}, NEAREST, None, knowledge), tmp_path)
    assert not (tmp_path / "learned.npz").exists()


def test_too_little_to_learn_from_is_said(tmp_path: Path) -> None:
    with pytest.raises(LevadeError, match="5 falls are too few to learn from; build 10 or more"):
        learn(library(tmp_path, known(5)))
    unfinished = known()
    unfinished.perturbed[3, 1] = np.nan
    with pytest.raises(LevadeError, match="not every motion was tried from every fall; complete the build"):
        learn(library(tmp_path, unfinished))


def test_features_are_as_far_apart_as_states_are() -> None:
    """Of states that are near: a small turn, and a share of the joints' root mean square."""
    up, turned = np.array([0.0, 0.0, 1.0]), np.array([0.0, np.sin(0.02), np.cos(0.02)])
    joints = np.full(12, 0.3)
    apart = features(turned, joints + 0.05) - features(up, joints)
    assert np.linalg.norm(apart) == pytest.approx(np.hypot(0.02, 0.25 * 0.05), rel=1e-3)
