"""Optional packages, and the extra that installs each."""

from __future__ import annotations

from importlib.util import find_spec

from core import BenchDragonError
from core.extras import not_installed

_DXF, _FIGURES, _SWEEP, _XLSX = ("ezdxf",), ("matplotlib",), ("pyarrow",), ("xlsxwriter", "openpyxl")
_CALLS = ("fastapi", "fastapi_swagger", "mcp", "prometheus_client", "starlette", "uplot", "uvicorn")
_PAPER = ("typst", "segno", *_FIGURES)
_SERVICE = (*_CALLS, "av", *_DXF, *_PAPER, *_SWEEP, *_XLSX)
# Modules that each extra of pyproject.toml installs, as far as this program imports them.
MODULES = {
    "arrow": ("pyarrow",),
    "ccd": ("Box2D", "ipctk", "flint", *_FIGURES),
    "dask": ("dask", "distributed", *_SWEEP),
    "data": ("pandas", "xarray"),
    "dxf": _DXF,
    "figures": _FIGURES,
    "film": ("av", *_FIGURES),
    "paper": _PAPER,
    "polars": ("polars",),
    "proof": ("flint",),
    "service": _SERVICE,
    "sweep": _SWEEP,
    "xlsx": _XLSX,
}


class MissingPackage(BenchDragonError):
    """A package that the request needs is not installed."""

    code = "missing-package"


class NotTypeset(RuntimeError):
    """The typesetter of the extra paper failed."""


def require(extra: str, field: str, what: str) -> None:
    """raises: MissingPackage, at the field and with what to install, when a module of the extra is missing"""
    for module in MODULES[extra]:
        if find_spec(module) is None:
            words, values = not_installed("{what}", "{package}", "{extra}"), {"package": module, "extra": extra}
            raise MissingPackage.in_words(field, words, what=what, **values)
