"""Regulators along a motion, on linear models that are given: no simulation."""

from __future__ import annotations

import math

import numpy as np

from levade.regulators import Along, Design, Linear

JOINTS, TICKS, PERIOD = 2, 5, 0.004
SENSED = 6 + 2 * JOINTS
STATES = SENSED + 4


def along() -> Along:
    """Of a robot that stays as it is, with joints that go where their corrections say."""
    b = np.zeros((TICKS, STATES, JOINTS))
    b[:, 6 : 6 + JOINTS] = 0.5 * np.eye(JOINTS)
    a = np.repeat(0.9 * np.eye(STATES)[None], TICKS, axis=0)
    seen = np.zeros((TICKS + 20, SENSED))
    linear = Linear(a, b, seen, np.zeros((TICKS + 20, STATES)), np.zeros(0))
    return Along(linear, np.zeros((TICKS, STATES - SENSED, SENSED)), PERIOD, holds=True, size=0.6)


def test_corrections_fade_in_a_hold_without_feedback() -> None:
    """To 1/e within 0.1 s, whatever is sensed."""
    feedback = along().feedback(Design(hold=None, bound=0.3))
    sensed, correction = np.full(SENSED, 0.7), np.array([0.2, -0.1])
    for tick in range(TICKS - 1, TICKS - 1 + round(0.1 / PERIOD)):
        correction = feedback.correction(tick, sensed, correction)
    np.testing.assert_allclose(correction, np.array([0.2, -0.1]) / math.e)


def test_up_to_the_horizon_such_a_regulator_acts_on_what_is_sensed() -> None:
    gain = along().feedback(Design(hold=None)).gain
    assert len(gain) == TICKS  # one of each tick up to the horizon, and one of the hold
    assert (np.diag(gain[0][:, 6 : 6 + JOINTS]) < 0).all()  # a joint that is ahead is brought back
