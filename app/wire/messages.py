"""Error messages for a wrong value: its name, the value, its unit, the limit, and what to change."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import takewhile
from typing import Annotated, Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, Tag, ValidationError

from app.wire.dances import AXIS, SHAPES
from app.wire.fields import VALUE_LENGTH_MAX, Wire, extra_of, short_json
from app.wire.numbers import number_of
from app.wire.paths import KINDS
from core import InvalidValue
from core.language import Phrases, phrase, say
from core.quantities import Clause, Given, Parameter, Quantity, Value, format_field

Model = TypeVar("Model", bound=BaseModel)
# An object, in the words of JSON.
OBJECT = phrase("a JSON object")
# Similarity above which an unknown name counts as a slip [1] (difflib); higher for a name that other calls know, such
# as `width` for `widths`.
ALIKE_SLIP, ALIKE = 0.6, 0.8
IN_WORDS: Phrases = {
    "m": "lengths are in metres",
    "m/s": "speeds are in metres per second",
    "rad": "angles are in radians",
}


def checked(model: type[Model], values: object, thing: str = OBJECT) -> Model:
    """The values as a request of the service, which refuses wrong ones in its own words.

    thing: name of an object in the format of these values
    """
    try:
        return model.model_validate(values)
    except ValidationError as error:
        first = error.errors()[0]
        steps = [step for step in place_of(first) if step not in SHAPES]
        fault, field = fault_of({**first, "loc": ("request", *first["loc"])}, model, thing), ".".join(map(str, steps))
        subject: dict[str, Value] = {}
        if len(steps) > 1:
            last_name = next((step for step in reversed(steps) if isinstance(step, str)), fault.field)
            word = "table" if "table" in fault.values else "field"
            subject = {
                word: Parameter(field) if last_name == fault.field else f"{format_field(field)}: {fault.values[word]}"
            }
        raise fault.renamed(lambda name: field if name == fault.field else name, **subject) from error


def place_of(error: Mapping[str, Any]) -> tuple[str | int, ...]:
    """Steps to the wrong field of one of pydantic's errors; of a union without a matching `kind` that field."""
    place: tuple[str | int, ...] = tuple(error["loc"])
    return (*place, "kind") if error["type"].startswith("union_tag") else place


def fault_of(error: Mapping[str, Any], request_type: Any, thing: str = OBJECT) -> InvalidValue:
    """The fault behind one of pydantic's errors, with the last name in its place as the field.

    request_type: model of the request; thing: name of an object in the format of its values
    """
    units, place = known_units(), place_of(error)
    names = [part for part in place[1:] if isinstance(part, str)]
    if error["type"] == "extra_forbidden":
        rule, near = _unknown_name(names[-1], units, place, request_type)
        return InvalidValue(names[-1], rule, field=Given(names[-1], short_json(names[-1])), **near)
    name = _field_name(names, units, place, request_type)
    if isinstance(inner := error.get("ctx", {}).get("error"), InvalidValue):
        inner_values = {**inner.values, "table": Parameter(name)}
        return InvalidValue.in_words(
            name, f"{{table}}: {inner.template}", got=inner.got, reason=inner.reason, **inner_values
        )
    owner = next((part for part in reversed(names) if f"{part}.{name}" in units), "")
    unit = "" if AXIS in names else units.get(f"{owner}.{name}", units.get(name, ""))
    indices = list(takewhile(lambda part: isinstance(part, int), reversed(place)))
    subject = ".".join(map(str, [name, *reversed(indices)]))
    if AXIS in names:
        thing = Clause("{thing} or a list of values", thing=thing)
    elif subject == "times":
        thing = Clause("{thing}, or a list of instants [s]", thing=thing)
    rule, values = _rule(error, unit, thing)
    return InvalidValue(name, rule, field=Parameter(subject), **values)


def _rule(error: Mapping[str, Any], unit: str, thing: str) -> tuple[str, dict[str, Value]]:
    """The rule that the wrong field breaks, and its values."""
    kind, value, limits = error["type"], error["input"], error.get("ctx", {})
    number = _number(value, text=error["loc"][0] == "query")
    words = str(value) if isinstance(value, str) and number is not None else short_json(value)
    got: Value = Given(value, words)
    if number is not None:
        got = Quantity(number, unit, text=f"{words} {unit}".rstrip() if len(words) < VALUE_LENGTH_MAX else "")
    values: dict[str, Value] = {"got": got, "unit": unit}
    bounds = {"ge": "least", "gt": "least", "le": "most", "lt": "most"}
    values |= {word: Quantity(limits[key], unit, 15) for key, word in bounds.items() if key in limits}
    match kind:
        case "greater_than_equal":
            return "must be at least {least}", values
        case "greater_than":
            return "must be more than {least}", values
        case "less_than_equal":
            why, hint = _unit_hint(number, limits["le"], unit)
            return f"must be at most {{most}}: {why}".removesuffix(": "), values | hint
        case "finite_number":
            return "must be a finite number [{unit}]" if unit else "must be a finite number", values
        case "float_type" if isinstance(value, int) and not isinstance(value, bool):
            return "must be a finite number [{unit}]" if unit else "must be a finite number", values
        case "float_type" | "float_parsing":
            why, hint = _centimetres(value) if unit == "m" else ("", {})
            rule = "must be a number [{unit}]" if unit else "must be a number"
            return f"{rule}: {why}".removesuffix(": "), values | hint
        case "int_type" | "int_parsing" | "int_from_float" | "int_parsing_size":
            return "must be a whole number", values
        case "list_type":
            values["got"] = Given(value, words)
            return "must be a list of numbers [{unit}]" if unit else "must be a list", values
    return _rule_of_shape(error, thing, values)


def _rule_of_shape(error: Mapping[str, Any], thing: str, values: dict[str, Value]) -> tuple[str, dict[str, Value]]:
    """The rule that a field breaks which is no number, and its values. values: of all rules"""
    value, limits = error["input"], error.get("ctx", {})
    match error["type"]:
        case "string_type":
            return "must be a string", values
        case "string_pattern_mismatch":
            return "must match the pattern {pattern}", values | {"pattern": limits["pattern"]}
        case "string_too_short":
            return "must have at least {least} characters", values | {"least": limits["min_length"]}
        case "string_too_long":
            return "must have at most {most} characters", values | {"most": limits["max_length"]}
        case "missing" | "union_tag_not_found":
            rule = "is missing"
            return rule, {}
        case "model_type" | "model_attributes_type" | "dict_type":
            return "must be {thing}", values | {"thing": thing}
        case "too_short":
            least, count = limits["min_length"], limits["actual_length"]
            rule = "must have at least {least} entry" if least == 1 else "must have at least {least} entries"
            return rule, {"least": least, "got": count or Given(0, "none")}
        case "too_long":
            return "must have at most {most} entries", {"most": limits["max_length"], "got": "more"}
        case "union_tag_invalid":
            kind = value.get("kind") if isinstance(value, dict) else limits["tag"]
            values = {"allowed": _quoted(limits["expected_tags"]), "got": Given(kind, short_json(kind))}
            return "must be one of {allowed}", values
        case "too_deep":
            return "must nest objects and lists at most {most} deep", {"most": limits["most"]}
        case "literal_error" | "enum":
            return "must be {allowed}", values | {"allowed": _quoted(limits["expected"])}
        case "too_many_names":
            values = {"most": limits["most"], "got": limits["given"]}
            return "must have at most {most} names: see /docs for all names", values
        case "rule":
            return error["msg"], values
        case "beside":
            return error["msg"], {}
    rule = "is not valid: {why}"
    return rule, values | {"why": f"{error['msg'][:1].lower()}{error['msg'][1:]}"}


def _quoted(words: str) -> str:
    """Words of pydantic about allowed values, in the quotes of JSON."""
    return words.replace("'", '"')


def _unknown_name(
    name: str, units: Mapping[str, str], place: Sequence[Any], request_type: Any
) -> tuple[str, dict[str, Value]]:
    """The rule for a name that is unknown at its place, and its values."""
    if homes := _homes(name, request_type, place[1:-1]):
        rule = "is unknown here: it belongs in {home}"
        return rule, {"home": say(" or ").join(homes)}
    if place[-2] in KINDS:
        kinds = sorted(kind for kind in KINDS if name in names_at(request_type, (*place[1:-2], kind)))
        if kinds:
            values: dict[str, Value] = {"kind": short_json(place[-2]), "home": say(" or ").join(map(short_json, kinds))}
            rule = "is unknown in the kind {kind}: it belongs to {home}"
            return rule, values
    alike = ALIKE if name in units else ALIKE_SLIP
    near = difflib.get_close_matches(name, names_at(request_type, place[1:-1]), n=1, cutoff=alike)
    if near:
        rule = "is unknown here: did you mean {near}?"
        return rule, {"near": near[0]}
    rule = "is unknown here: leave it out"
    return rule, {}


def _field_name(names: Sequence[str], units: Mapping[str, str], place: Sequence[Any], request_type: Any) -> str:
    """Name of the wrong field. names: the words in its place; units: of the known fields"""
    if not names:
        return f"the {place[0]}"
    if names[-1] in names_at(request_type, place[1:-1]):
        return names[-1]
    fields = [part for part in names if part not in SHAPES]
    return next((part for part in reversed(names) if part in units), (fields or names)[-1])


@cache
def known_units() -> dict[str, str]:
    """Name of every request field -> its unit, empty for a pure number.

    Fields of a path stand there also as kind.name, and those of the objects in a list as list.name.
    """
    owned, units = owners(), dict[str, str]()
    for model, before in sorted(owned.items(), key=lambda one: bool(one[1])):
        for name, field in model.model_fields.items():
            units.setdefault(name, extra_of(field, "unit"))
            units |= {f"{owner}.{name}": extra_of(field, "unit") for owner in before}
    return units


def owners() -> dict[type[Wire], list[str]]:
    """For every model of requests what stands before its names: its kinds, or the fields that are lists of it."""
    result: dict[type[Wire], list[str]] = {}
    left: list[type[Wire]] = [Wire]
    while left:
        left = [inner for outer in left for inner in outer.__subclasses__()]
        for model in left:
            kind = model.model_fields.get("kind")
            result[model] = [*get_args(kind.annotation)] if kind else []
    for model in list(result):
        for name, field in model.model_fields.items():
            for form in (field.annotation, *get_args(field.annotation)):
                for entry in get_args(form) if get_origin(form) is list else ():
                    if entry in result and name not in result[entry]:
                        result[entry].append(name)
    return result


def names_at(kind: Any, place: Sequence[Any]) -> list[str]:
    """Names that a request may have at a place in it. kind: type of the request or of an inner part"""
    if get_origin(kind) is Annotated:
        inner, *tags = get_args(kind)
        if not any(isinstance(tag, Tag) for tag in tags):
            return names_at(inner, place)
        return names_at(inner, place[1:]) if place and Tag(place[0]) in tags else []
    if not isinstance(kind, type) or get_origin(kind):
        further = place[1:] if get_origin(kind) in (list, dict) else place
        return [name for inner in get_args(kind) for name in names_at(inner, further)]
    if not issubclass(kind, BaseModel):
        return []
    fields = kind.model_fields
    if not place:
        return list(fields)
    if place[0] in fields:
        return names_at(fields[place[0]].annotation, place[1:])
    is_kind = "kind" in fields and place[0] in get_args(fields["kind"].annotation)
    return names_at(kind, place[1:]) if is_kind else []


def _homes(name: str, request_type: Any, place: Sequence[Any]) -> list[str]:
    """Objects at a place in a request that may have a name inside."""
    inner = ((), *((shape,) for shape in SHAPES))
    return [
        home
        for home in names_at(request_type, place)
        if any(name in names_at(request_type, (*place, home, *shape)) for shape in inner)
    ]


def _number(value: Any, *, text: bool) -> float | None:
    """The value as a finite number, also from text if text is allowed."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str) if text else (int, float)):
        return None
    try:
        number = number_of(value) if isinstance(value, str) else float(value)
    except (ValueError, OverflowError):
        return None
    return number if math.isfinite(number) else None


def _centimetres(value: Any) -> tuple[str, dict[str, Value]]:
    """Hint for text such as 55cm in place of a length, and its values."""
    match = re.fullmatch(r"\s*(\d+(?:\.\d*)?)\s*cm\s*", value) if isinstance(value, str) else None
    return _in_metres(float(match[1])) if match else ("", {})


def _in_metres(centimetres: float) -> tuple[str, dict[str, Value]]:
    values = {"cm": Quantity(centimetres, "cm", 6), "m": Quantity(centimetres / 100, "m", 6)}
    return phrase("lengths are in metres, and {cm} is {m}"), dict(values)


def _unit_hint(value: float | None, limit: float, unit: str) -> tuple[str, dict[str, Value]]:
    if unit == "m" and value is not None and value / 100 <= limit:
        return _in_metres(value)
    return IN_WORDS.get(unit, ""), {}
