"""What is wrong with a value, in words: its name, the value, its unit, the limit, and what to change."""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import takewhile
from typing import Annotated, Any, get_args, get_origin

from pydantic import BaseModel, Tag

from app.wire.models import Wire, unit_of
from app.wire.paths import KINDS
from core.errors import said

# Longer values are shortened [characters].
SHOWN_MAX = 60
# Names so much alike are taken for a slip [1] (difflib); of one that other calls know, `width` for `widths`, more so.
ALIKE_SLIP, ALIKE = 0.6, 0.8
IN_WORDS = {"m": "lengths are in metres", "m/s": "speeds are in metres per second", "rad": "angles are in radians"}


def shown(value: Any) -> str:
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    if isinstance(value, float):
        return said(value)
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= SHOWN_MAX else f"{text[:SHOWN_MAX]}... ({len(text)} characters)"


def message(error: Mapping[str, Any], asked: Any) -> str:
    """What is wrong with one field: its name, the value, the unit, the limit, and what to change.

    asked: type of the request
    """
    units = known_units()
    names = [part for part in error["loc"][1:] if isinstance(part, str)]
    name = next((part for part in reversed(names) if part in units), names[-1] if names else f"the {error['loc'][0]}")
    kind, value, limits = error["type"], error["input"], error.get("ctx", {})
    told_apart = next((part for part in reversed(names) if part in KINDS), "")
    unit = units.get(f"{told_apart}.{name}", units.get(name, ""))
    name += "".join(f"[{part}]" for part in _last_indices(error["loc"]))
    number = _number(value, text=error["loc"][0] == "query")
    words = str(value) if isinstance(value, str) and number is not None else shown(value)
    got = f"got {words}" + (f" {unit}" if unit and number is not None else "")
    limit = next((f"{limits[key]:.15g} {unit}".rstrip() for key in ("ge", "gt", "le", "lt") if key in limits), "")
    of_unit = f" [{unit}]" if unit else ""
    match kind:
        case "greater_than_equal":
            return f"{name} must be at least {limit}, {got}"
        case "greater_than":
            return f"{name} must be more than {limit}, {got}"
        case "less_than_equal":
            return f"{name} must be at most {limit}, {got}{_unit_hint(number, limits['le'], unit)}"
        case "finite_number":
            return f"{name} must be a finite number{of_unit}, {got}"
        case "float_type" | "float_parsing":
            return f"{name} must be a number{of_unit}, {got}"
        case "int_type" | "int_parsing" | "int_from_float" | "int_parsing_size":
            return f"{name} must be a whole number, {got}"
        case "missing":
            return f"{names[-1] if names else name} is missing"
        case "extra_forbidden":
            alike = ALIKE if names[-1] in units else ALIKE_SLIP
            near = difflib.get_close_matches(names[-1], names_at(asked, error["loc"][1:-1]), n=1, cutoff=alike)
            return f"{shown(names[-1])} is unknown here: " + (f"did you mean {near[0]}?" if near else "leave it out")
        case "model_type" | "model_attributes_type" | "dict_type":
            other = ", or a list of instants [s]" if name == "times" else ""
            return f"{name} must be a JSON object{other}, {got}"
        case "too_short":
            least, given = limits["min_length"], limits["actual_length"]
            return f"{name} must have at least {least} {'entry' if least == 1 else 'entries'}, got {given or 'none'}"
        case "too_long":
            return f"{name} must have at most {limits['max_length']} entries, got more"
        case "union_tag_invalid":
            return f"kind must be one of {limits['expected_tags']}, got {shown(limits['tag'])}"
        case "union_tag_not_found":
            return "kind is missing"
        case "too_deep":
            return f"{name} must hold at most {limits['most']} objects and lists in one another"
        case "literal_error" | "enum":
            return f"{name} must be {limits['expected']}, {got}"
        case "too_many_names":
            return f"{name} must have at most {limits['most']} names, got {limits['given']}: see /docs for all names"
    return f"{name}: {error['msg'][:1].lower()}{error['msg'][1:]}, {got}"


@cache
def known_units() -> dict[str, str]:
    """Name of every field of a request -> its unit, empty for a pure number; of a path also by its kind and name."""
    return _units(Wire.__subclasses__())


def _units(models: list[type[Wire]]) -> dict[str, str]:
    found: dict[str, str] = {}
    for model in sorted(models, key=lambda model: "kind" in model.model_fields):
        kind = model.model_fields.get("kind")
        for name, field in model.model_fields.items():
            for word in get_args(kind.annotation) if kind else ():
                found[f"{word}.{name}"] = unit_of(field)
            found.setdefault(name, unit_of(field))
        found = _units(model.__subclasses__()) | found
    return found


def names_at(kind: Any, place: Sequence[Any]) -> list[str]:
    """Names that a request may have at a place in it. kind: type of the request, or of what lies further in"""
    if get_origin(kind) is Annotated:
        inner, *tags = get_args(kind)
        if not any(isinstance(tag, Tag) for tag in tags):
            return names_at(inner, place)
        return names_at(inner, place[1:]) if place and Tag(place[0]) in tags else []
    if not isinstance(kind, type) or get_origin(kind):
        further = place[1:] if get_origin(kind) is list else place
        return [name for inner in get_args(kind) for name in names_at(inner, further)]
    if not issubclass(kind, BaseModel):
        return []
    fields = kind.model_fields
    if not place:
        return list(fields)
    if place[0] in fields:
        return names_at(fields[place[0]].annotation, place[1:])
    told_apart = "kind" in fields and place[0] in get_args(fields["kind"].annotation)
    return names_at(kind, place[1:]) if told_apart else []


def _last_indices(place: Sequence[Any]) -> list[int]:
    """Indices at the end of a place."""
    indices = list(takewhile(lambda part: isinstance(part, int), reversed(place)))
    return indices[::-1]


def _number(value: Any, *, text: bool) -> float | None:
    """The value as a finite number, also from text if that counts."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str) if text else (int, float)):
        return None
    try:
        number = float(value)
    except (ValueError, OverflowError):
        return None
    return number if math.isfinite(number) else None


def _unit_hint(value: float | None, limit: float, unit: str) -> str:
    if unit == "m" and value is not None and value / 100 <= limit:
        return f": lengths are in metres, and {value:g} cm is {value / 100:g} m"
    return f": {IN_WORDS[unit]}" if unit in IN_WORDS else ""
