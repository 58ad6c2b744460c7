"""Bench Dragon: positions and speeds of every bench, first contact of two benches, and the tightest possible curve."""

from importlib.util import find_spec

import lazy_loader

_lazily, _, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__.remove("proof")  # it needs an extra


def __dir__() -> list[str]:
    return [*__all__, "__version__", *(["proof"] if find_spec("flint") else [])]


def __getattr__(name: str) -> object:
    if name.startswith(("performance_", "first_encounter", "encounter_check")):
        from core.old_names import NEW, question_of

        if name in NEW:
            return question_of(name, _lazily)
    if name != "__version__":
        return _lazily(name)
    from importlib.metadata import version

    return version("bench-dragon")
