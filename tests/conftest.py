"""Settings that every test shares."""

from __future__ import annotations

from hypothesis import settings

# The same examples in every run, and no time limit for one: CI machines differ in speed by a factor.
settings.register_profile("levade", derandomize=True, deadline=None)
settings.load_profile("levade")
