"""Figures, videos and pages from motion files."""
