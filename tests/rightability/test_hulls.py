"""Hulls that rest on a plane, against closed forms of boxes and tetrahedra."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.rightability.hulls import Hulls, tangent, turned

pytest.importorskip("scipy", reason="hulls need scipy: pip install 'levade[rightability]'")


def box(a: float, b: float, c: float) -> np.ndarray:
    """Corners of a box with half sizes a, b, c around the origin."""
    return np.array([a, b, c]) * np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def solid_angle(a: float, b: float, distance: float) -> float:
    """Share of the sphere that a rectangle with half sizes a, b covers, seen from above its centre."""
    return np.arctan2(a * b, distance * np.sqrt(a * a + b * b + distance * distance)) / np.pi


def likelihoods(hulls: Hulls) -> dict[tuple[float, ...], float]:
    """Up direction, to two digits -> share of attitudes from which the first hull comes to rest there, on flat ground."""
    face = np.flatnonzero(hulls.exists[0])
    up = -hulls.normal[0, face].astype(float)
    rest = hulls.roll(np.zeros(len(face), dtype=int), face, tangent(up))
    found: dict[tuple[float, ...], float] = {}
    for place, share in zip(rest.up.round(2) + 0.0, hulls.solid_angles(0)[face], strict=True):
        found[tuple(place.tolist())] = found.get(tuple(place.tolist()), 0.0) + float(share)
    return found


@pytest.mark.slow
def test_a_cube_rests_on_each_face_with_one_sixth() -> None:
    found = likelihoods(Hulls.of([box(0.2, 0.2, 0.2)], np.zeros((1, 3))))
    assert len(found) == 6
    assert found[0.0, 0.0, 1.0] == pytest.approx(1 / 6, abs=1e-6)
    assert max(found.values()) - min(found.values()) < 1e-6


def test_a_box_rests_on_a_face_with_its_solid_angle() -> None:
    found = likelihoods(Hulls.of([box(0.1, 0.2, 0.3)], np.zeros((1, 3))))
    assert found[0.0, 0.0, 1.0] == pytest.approx(solid_angle(0.1, 0.2, 0.3), abs=1e-6)
    assert found[0.0, -1.0, 0.0] == pytest.approx(solid_angle(0.1, 0.3, 0.2), abs=1e-6)
    assert found[1.0, 0.0, 0.0] == pytest.approx(solid_angle(0.2, 0.3, 0.1), abs=1e-6)


def test_a_regular_tetrahedron_rests_on_each_face_with_one_quarter() -> None:
    corners = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    found = likelihoods(Hulls.of([corners], np.zeros((1, 3))))
    assert len(found) == 4
    assert all(share == pytest.approx(0.25, abs=1e-6) for share in found.values())


def test_a_weighted_ball_comes_to_rest_the_same_way_from_any_attitude() -> None:
    """A ball with a flat bottom, its centre of mass close to that, and a pointed hat: it rolls there from anywhere."""
    k = np.arange(400) + 0.5
    polar, azimuth = np.arccos(1 - 2 * k / 400), np.pi * (1 + 5**0.5) * k
    points = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=1)
    points[:, 2] = np.maximum(points[:, 2], -0.9)
    points = np.vstack([points, [[0.0, 0.0, 2.0]]])  # facets of a polyhedron near the top would balance
    found = likelihoods(Hulls.of([points], np.array([[0.0, 0.0, -0.6]])))
    assert found == {(0.0, 0.0, 1.0): pytest.approx(1.0, abs=1e-6)}


@pytest.mark.parametrize(("uphill", "half"), [([1.0, 0.0, 0.0], 0.1), ([0.0, -1.0, 0.0], 0.2)])
def test_a_box_tips_on_a_slope_of_its_half_width_over_its_height(uphill: list[float], half: float) -> None:
    hulls = Hulls.of([box(0.1, 0.2, 0.3)], np.zeros((1, 3)))
    limit = np.arctan(half / 0.3)
    up, ahead = np.array([[0.0, 0.0, 1.0]]), np.array([uphill])
    below = hulls.settle(np.array([0]), up, ahead, limit - 0.01)
    np.testing.assert_allclose(below.up, up, atol=1e-6)
    above = hulls.settle(np.array([0]), up, ahead, limit + 0.01)
    # downhill is now below it, so that the ground's normal is opposite to uphill in axes of the box ...
    np.testing.assert_allclose(above.up, ahead, atol=1e-6)
    # ... and it was turned by a right angle
    np.testing.assert_allclose(above.uphill, -up, atol=1e-6)
    wide = np.zeros((1, *hulls.normal.shape[1:]))
    wide[:] = ahead
    bottom = hulls.normal[0, :, 2] < -0.9
    assert hulls.stable(wide, limit - 0.01)[0, bottom].any()
    assert not hulls.stable(wide, limit + 0.01)[0, bottom].any()


def test_a_cube_rolls_down_a_slope_that_is_too_steep_for_all_its_faces() -> None:
    hulls = Hulls.of([box(0.1, 0.1, 0.1)], np.zeros((1, 3)))
    rest = hulls.settle(np.array([0]), np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 0.0, 0.0]]), np.radians(50.0))
    assert rest.face.tolist() == [-1]


def test_hulls_of_different_numbers_of_faces_do_not_disturb_each_other() -> None:
    tetrahedron = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    both = Hulls.of([tetrahedron, box(0.1, 0.2, 0.3)], np.zeros((2, 3)))
    alone = Hulls.of([box(0.1, 0.2, 0.3)], np.zeros((1, 3)))
    up = np.random.default_rng(0).standard_normal((50, 3))
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    np.testing.assert_array_equal(
        both.settle(np.ones(50, dtype=int), up, tangent(up)).up,
        alone.settle(np.zeros(50, dtype=int), up, tangent(up)).up,
    )
    assert both.exists.sum(axis=1).tolist() == [4, 12]
    assert both.solid_angles(0).sum() == pytest.approx(1.0, abs=1e-6)


def test_a_turn_keeps_length_and_angle() -> None:
    one, other = np.array([[0.0, 0.0, 1.0]]), np.array([[0.6, 0.0, 0.8]])
    np.testing.assert_allclose(turned(np.array([[1.0, 0.0, 0.0]]), one, other), [[0.8, 0.0, -0.6]], atol=1e-12)
    np.testing.assert_allclose(turned(np.array([[0.0, 1.0, 0.0]]), one, other), [[0.0, 1.0, 0.0]], atol=1e-12)


def test_flat_shapes_are_refused() -> None:
    with pytest.raises(LevadeError, match="lie in one plane"):
        Hulls.of([box(0.1, 0.2, 0.0)], np.zeros((1, 3)))
