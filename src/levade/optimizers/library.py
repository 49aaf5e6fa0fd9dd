"""The library `cma` without matplotlib, which it imports for plots of its own, and which takes longer than all the rest."""

from __future__ import annotations

import sys
import warnings
from typing import Any

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # that matplotlib is missing
    _hidden = "matplotlib" not in sys.modules
    if _hidden:
        _modules: dict[str, Any] = sys.modules
        _modules["matplotlib"] = None  # an import of it fails, as where it is not installed
    try:
        import cma
    finally:
        if _hidden:
            del sys.modules["matplotlib"]

__all__ = ["cma"]
