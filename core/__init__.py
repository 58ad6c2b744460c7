"""Bench Dragon: where is everyone, when do two benches first touch, how tight may the curve be."""

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    if name != "__version__":
        return _lazily(name)
    from importlib.metadata import version

    return version("bench-dragon")
