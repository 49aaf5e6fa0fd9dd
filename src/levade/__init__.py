"""Whole-body, single-shot motions for legged robots by black-box optimisation in full rigid-body simulation."""

__version__ = "0.1.0"
