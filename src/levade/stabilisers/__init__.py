"""Stabilisers: gains from what the robot senses to corrections of the joint references, along a motion.

    found = stabilise(Motion.load("motion.npz"), seed=0)
    found.open_loop, found.share            # of perturbed runs, without and with
    found.motion.save("stabilised.npz")     # a motion with `levade.feedback.Feedback`

What it does, what it senses and what it cannot do is in docs/feedback.md.
"""

from __future__ import annotations

from levade.regulators import Design
from levade.stabilisers.stabiliser import Stabilised, stabilise

__all__ = ["Design", "Stabilised", "stabilise"]
