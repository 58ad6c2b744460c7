"""Packages that only some installations have: pandas, xarray and matplotlib, imported when a method needs them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def wanted(module: str, extra: str, what: str) -> Any:
    """A module of an optional package.

    module: its dotted name; extra: of bench-dragon, which brings it; what: needs it, for the message
    raises: ImportError naming the package and the extra where the package is not installed

    >>> wanted("no_such_package", "data", "Trajectory.to_dataframe()")
    Traceback (most recent call last):
        ...
    ImportError: Trajectory.to_dataframe() needs no_such_package: pip install 'bench-dragon[data]'
    """
    package = module.partition(".")[0]
    try:
        import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:  # the package is there and lacks something of its own
            raise
        message = f"{what} needs {package}: pip install 'bench-dragon[{extra}]'"
        raise ImportError(message, name=package) from error
    return import_module(module)
