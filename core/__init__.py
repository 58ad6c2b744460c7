"""Bench Dragon: positions and speeds of every bench, first contact of two benches, and the tightest possible curve."""

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__.remove("proof")  # it needs an extra


def __getattr__(name: str) -> object:
    if name != "__version__":
        return _lazily(name)
    from importlib.metadata import version

    return version("bench-dragon")
