"""Refusals of core, reworded with the names and values of the request.

Core speaks of single instants, a radius and a path with fields. A request may have given a range of instants, a
diameter, or names without `dragon.` and `path.`; its author can only correct what the request contains.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from pydantic import BaseModel

from app.wire.dances import TimeSteps
from app.wire.paths import TurnFields
from core import BenchDragonError, Dragon
from core.dragon import BENCHES_MAX
from core.paths.following import follows
from core.quantities import Quantity, quantities

# A request without an object of this name holds the object's fields itself.
OUTER = re.compile(r"^(dragon|model|path|times)\.(?=[a-z])")
# Fields of a turn that can make it too tight where their defaults would not; otherwise its circle is too small.
MEND_A_TURN = ("ends", "middle", "exit_radius", "entry_radius", "ratio", "pitch")
# Rules for those of them that must not be larger; each with its unit.
OTHER_RULES = {"ratio": ("must be nearer to 1 than {given}", "")} | dict.fromkeys(
    ("ends", "middle"), ("must be shorter than {given}", "m")
)
# A part of a performance is one of the dances of a request.
PARTS = re.compile(r"^parts(?=\.|$)")
INSTANT = re.compile(r"times(?:\.(\d+))?")


@contextmanager
def refusing(request: BaseModel) -> Iterator[None]:
    """Context in which refusals of core name fields that the request has or could have."""
    try:
        yield
    except BenchDragonError as error:
        raise reworded(error, request) from error


def reworded(error: BenchDragonError, request: BaseModel) -> BenchDragonError:
    """The same error in the names and values of the request."""
    names = type(request).model_fields.keys()
    if match := INSTANT.fullmatch(error.field):
        error = _of_instants(error, request, int(match[1] or 0))
    *outer, last = error.field.split(".")
    if last == "turning_radius":
        got = error.got
        got = Quantity(2.0 * got.value, got.unit) if isinstance(got, Quantity) else got
        error = error.with_field(".".join([*outer, "turning_diameter"]), got)
    if error.field == "path" and isinstance(getattr(request, "path", request), TurnFields):
        error = _of_a_turn(error, request)
    if "dances" in names:
        error = error.renamed(lambda name: PARTS.sub("dances", name))
    # A range of times may exist beside the name `times`, as in the options of the command.
    objects = names - {"times"} if "stop" in names else names
    return error.renamed(lambda name: OUTER.sub(lambda outer: outer[0] * (outer[1] in objects), name))


def _of_instants(error: BenchDragonError, request: Any, index: int) -> BenchDragonError:
    """The error for one instant; of a range it names the start or the stop, of two the one at fault."""
    names = type(request).model_fields
    if "time" in names:
        return error.with_field("time")
    times = getattr(request, "times", None)
    if times is None:
        times = request if "stop" in names else TimeSteps()
    if not hasattr(times, "stop") or not isinstance(error.got, Quantity):
        return error
    stop_alone = times.model_fields_set & {"start", "stop"} == {"stop"}
    end = "stop" if index or stop_alone else "start"
    if (value := getattr(times, end)) is None:  # an end that was left to the question
        return error
    return error.with_field(f"times.{end}", Quantity(value, "s"))


def _of_a_turn(error: BenchDragonError, request: Any) -> BenchDragonError:
    """The error for a turn too tight for a bench, naming the field that makes it so tight."""
    body = not isinstance(request, TurnFields)
    fields: TurnFields = request.path if body else request
    dragon = (request.dragon if body else request).to_dragon(BENCHES_MAX)
    path = fields.to_turn()
    if follows(dragon, path):
        return error
    name = next((name for name in MEND_A_TURN if _mends(name, fields, dragon)), "turning_diameter")
    rule, unit = OTHER_RULES.get(name, ("must be larger than {given}", "m"))
    values = error.values | quantities(unit, given=getattr(fields, name))
    del values["field"]
    return type(error)(f"path.{name}" if body else name, f"{rule}: {error.reason}", **values)


def _mends(name: str, fields: TurnFields, dragon: Dragon) -> bool:
    """Whether the dragon can follow the turn if this field has its default."""
    default = TurnFields.model_fields[name].default
    if getattr(fields, name) == default:
        return False
    values = fields.model_dump(include=set(TurnFields.model_fields)) | {name: default}
    try:
        return follows(dragon, TurnFields.model_validate(values).to_turn())
    except BenchDragonError:
        return False
