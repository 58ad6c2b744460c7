"""Optional packages (pandas, xarray, matplotlib), imported when a method needs them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def wanted(module: str, extra: str, what: str) -> Any:
    """A module of an optional package.

    module: dotted name; extra: the extra of bench-dragon that installs it; what: the caller, for the message
    raises: ImportError naming the package and the extra if the package is not installed

    >>> wanted("no_such_package", "data", "Trajectory.to_dataframe()")
    Traceback (most recent call last):
        ...
    ImportError: Trajectory.to_dataframe() needs no_such_package: pip install 'bench-dragon[data]'
    """
    package = module.partition(".")[0]
    try:
        import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:  # the package is installed, but one of its own requirements is missing
            raise
        message = f"{what} needs {package}: pip install 'bench-dragon[{extra}]'"
        raise ImportError(message, name=package) from error
    return import_module(module)
