"""Stabilisers: gains from sensor readings to corrections of the joint references, along a motion.

    found = stabilise(Motion.load("motion.npz"), seed=0)
    found.open_loop, found.share            # shares of perturbed runs, without and with
    found.motion.save("stabilised.npz")     # a motion with `levade.feedback.Feedback`

docs/feedback.md explains what a stabiliser does, what it senses and what it cannot do.
"""

from __future__ import annotations

from levade.regulators import Design
from levade.stabilisers.stabiliser import Stabilised, stabilise

__all__ = ["Design", "Stabilised", "stabilise"]
