"""Optional packages (pandas, xarray, matplotlib), imported when a method needs them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def not_installed(what: str, package: str, extra: str) -> str:
    """The message about a package that is missing.

    what: the caller; package: its name in a package index; extra: the extra of bench-dragon that installs it
    """
    words = "{what} needs the package {package}, which is not installed: pip install 'bench-dragon[{extra}]'"
    return words.format(what=what, package=package, extra=extra)


def wanted(module: str, extra: str, what: str) -> Any:
    """A module of an optional package.

    module: dotted name; extra: the extra of bench-dragon that installs it; what: the caller, for the message
    raises: ImportError naming the package and the extra if the package is not installed

    >>> wanted("no_such", "data", "A table")
    Traceback (most recent call last):
        ...
    ImportError: A table needs the package no_such, which is not installed: pip install 'bench-dragon[data]'
    """
    package = module.partition(".")[0]
    try:
        import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:  # the package is installed, but one of its own requirements is missing
            raise
        raise ImportError(not_installed(what, package, extra), name=package) from error
    return import_module(module)
