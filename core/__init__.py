"""Bench Dragon: positions and speeds of every bench, first contact of two benches, and the tightest possible curve."""

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    if name == "proof":  # not in __all__, because it needs an extra
        from importlib import import_module

        return import_module("core.proof")
    if name != "__version__":
        return _lazily(name)
    from importlib.metadata import version

    return version("bench-dragon")
