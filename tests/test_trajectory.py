"""Algebra of the arrays that pass between the rooms, compared with numpy's own."""

from __future__ import annotations

import numpy as np
import pytest

from levade.rotations import components, cross, rotate, rotation_matrix


@pytest.mark.parametrize(("a", "b"), [((5, 7, 3), (3,)), ((3,), (3,)), ((4, 1, 3), (4, 6, 3)), ((0, 2, 3), (3,))])
def test_cross_products_have_the_bits_of_numpys(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    random = np.random.default_rng(0)
    one, other = random.standard_normal(a), random.standard_normal(b)
    np.testing.assert_array_equal(cross(one, other), np.cross(one, other))


def test_rotating_is_multiplying_by_the_matrix() -> None:
    random = np.random.default_rng(1)
    quaternion = random.standard_normal((6, 4))
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    vector = random.standard_normal((6, 3))
    np.testing.assert_allclose(
        rotate(quaternion, vector), np.einsum("nij,nj->ni", rotation_matrix(quaternion), vector), atol=1e-14
    )


def test_components_are_views() -> None:
    values = np.zeros((2, 3))
    components(values)[1][:] = 1
    np.testing.assert_array_equal(values, [[0, 1, 0], [0, 1, 0]])
