"""Import the library `cma` without what it imports for its own plots and fits, which takes longer than all the rest."""

from __future__ import annotations

import sys
import warnings
from typing import Any

_modules: dict[str, Any] = sys.modules
_hidden = [name for name in ("matplotlib", "scipy") if name not in _modules]

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # that they are missing
    for _name in _hidden:
        _modules[_name] = None  # an import of it fails, as where it is not installed
    try:
        import cma
    finally:
        for _name in _hidden:
            del _modules[_name]

__all__ = ["cma"]
