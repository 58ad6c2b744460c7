"""What core refuses, by the names and values of the request that asked for it.

Core knows one dance: its instants one by one, a radius, a path with fields. A request may have given a range of
instants, a diameter, or names without `dragon.` and `path.` before them; whoever wrote those cannot mend others.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from pydantic import BaseModel

from app.schemas import TimeSteps
from core import BenchDragonError

# A request without these names its fields flat.
NESTED = frozenset({"dragon", "path"})
PREFIX = re.compile(r"\b(?:dragon|path|times)\.(?=[a-z])")
INSTANT = re.compile(r"times(?:\.(\d+))?")


@contextmanager
def refusing(request: BaseModel) -> Iterator[None]:
    """Within it, what core refuses names what the request gave, or could have given."""
    try:
        yield
    except BenchDragonError as error:
        raise reworded(error, request) from error


def reworded(error: BenchDragonError, request: BaseModel) -> BenchDragonError:
    """The same error about what the request gave."""
    names = type(request).model_fields.keys()
    if found := INSTANT.fullmatch(error.field):
        error = _of_instants(error, request, int(found[1] or 0))
    if error.field.endswith("turning_radius"):
        radius = error.field
        error = error.named(radius.replace("radius", "diameter"), None if error.got is None else 2.0 * error.got)
    if names & NESTED:
        return error
    if error.field == "path" and "turning_diameter" in names:
        error = _of_a_turn(error, request)
    return type(error)(PREFIX.sub("", error.field), PREFIX.sub("", error.message))


def _of_instants(error: BenchDragonError, request: Any, index: int) -> BenchDragonError:
    """One of the instants: of a range, its start or what lets it run so far."""
    names = type(request).model_fields
    if "time" in names:
        return error.named("time")
    times = getattr(request, "times", None)
    if times is None:
        times = request if "stop" in names else TimeSteps()
    if not hasattr(times, "stop") or error.got is None:
        return error
    end = "start" if index == 0 else "stop"
    return error.named(f"times.{end}", getattr(times, end))


def _of_a_turn(error: BenchDragonError, request: Any) -> BenchDragonError:
    """A turn that bends too tight for a bench: by what makes it so small."""
    name = "turning_diameter" if getattr(request, "entry_radius", None) is None else "entry_radius"
    why = error.message.replace("path", "the turn", 1)
    rule = f"must be larger than {getattr(request, name):g} m, or the ratio nearer to 1"
    return type(error)(name, f"{name} {rule}: {why}")
