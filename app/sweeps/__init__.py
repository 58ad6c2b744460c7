"""Sweeps: a million designs in one call.

`sweep()` answers any question for many values of its parameters into a folder, on the cores of this machine or on a
Dask cluster; a second call continues a stopped one. Names are loaded on first use, as they need the extra `sweep`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__all__ = ["Range", "Samples", "Spec", "Sweep", "SweepQuestion", "sweep"]

if TYPE_CHECKING:
    from app.sweeps.call import sweep
    from app.sweeps.questions import SweepQuestion
    from app.sweeps.spec import Range, Samples, Spec
    from app.sweeps.table import Sweep

_PLACES = {
    "SweepQuestion": "questions",
    "Range": "spec",
    "Samples": "spec",
    "Spec": "spec",
    "Sweep": "table",
    "sweep": "call",
}


def __getattr__(name: str) -> Any:
    """A public name, loaded on its first use."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
