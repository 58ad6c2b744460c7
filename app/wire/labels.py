"""Answers in words for people: the labels of their fields, the texts of their values, and tables of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum
from typing import Any, get_args

from pydantic import BaseModel

import core
from app.wire import answers
from app.wire.fields import typed_fields
from core.display import Readable
from core.language import Listed, Phrases, counted, say
from core.plots import feature_words
from core.quantities import format_number
from core.values import Pair

# Labels of fields, where they are not the words of their names, or no answer of a question has them.
LABELS: Phrases = {
    "at_least": "proven least", "cells": "cells", "dances": "dances", "distance": "distance", "dragon": "dragon",
    "envelope": "envelope", "excess": "excess", "heads": "heads", "separation": "separation",
    "touching": "shown to touch", "witness_a": "witness a", "witness_b": "witness b",
}  # fmt: skip
# Words of codes, where they are not those of the code, or no answer that is shown as it is has the code.
VALUES: Phrases = {
    "contact_at_start": "contact_at_start", "eight": "eight", "fcl": "FCL", "parade": "parade", "ring": "ring",
    "serpentine": "serpentine",
    "least_radius": "the least radius of a bend: half of the longest chord and 0.1 % more, where every bench follows",
}  # fmt: skip
# The same where a margin is required, which makes a contact not always a touch.
NEAR: Phrases = {
    "contact": "within {margin} m",
    "contact_at_start": "within {margin} m from the start on",
    "clear": "never within {margin} m",
}
# Words for a null that is an answer.
NULLS: Phrases = {"proven_up_to": "every larger pitch", "scan_step": "no scan"}
# Proven fields, which are shown with all digits.
PROVEN = frozenset({"clear_until", "proven_from", "proven_up_to"})
# Fields whose values the sentences beside them have.
UNSHOWN = frozenset({"claim", "sentences", "words"})
# Decimals of lengths and speeds on a terminal.
DISPLAY_DECIMALS = 6
# Most entries of a list in a table; of a longer list only their number is shown.
LISTED_MOST = 50
# Fields that are separations of two benches: below zero the benches overlap.
SEPARATIONS = frozenset({"gap", "clearance"})

Line = tuple[str, ...]


class Heading(str):
    """A line above others."""

    __slots__ = ()


class TextTable:
    """Lines of texts below their heads; without heads, a label and a text in each line."""

    def __init__(self, title: str, *heads: str, lines: Iterator[Line] | Sequence[Line] = ()) -> None:
        self.title, self.heads, self.lines = title, heads, list(lines)

    def add(self, *texts: str) -> None:
        self.lines.append(texts)


Part = TextTable | Heading | str


def label(name: str, unit: str = "") -> str:
    """Label of a field of an answer, such as "time bracket" for time_bracket; with a unit, as the head of a column."""
    words = say(LABELS.get(name, name.replace("_", " ")))
    return f"{words} [{unit}]" if unit else words


def heads_of(kind: Any, *names: str) -> list[str]:
    """Labels with units of some fields of an answer, as heads of columns."""
    known = typed_fields(kind)
    return [label(name, known[name][1]) for name in names]


def kinds_in(kinds: Iterable[Any]) -> list[Any]:
    """These types of answers, and the types of all that stands in them and is shown."""
    found = list(kinds)
    for kind in found:  # which grows
        inner = list(get_args(kind))
        if isinstance(kind, type) and issubclass(kind, BaseModel | Readable) and kind not in PARTS:
            inner = [type_ for name, (type_, _) in typed_fields(kind).items() if name not in UNSHOWN]
        found += [one for one in inner if one not in found]
    return found


def labels_of(kinds: Iterable[Any]) -> dict[str, str]:
    """Labels with units of the fields of answers, and of all that stands in them, by their names."""
    models = (kind for kind in kinds_in(kinds) if isinstance(kind, type) and issubclass(kind, BaseModel | Readable))
    return {name: label(name, unit) for kind in models for name, (_, unit) in typed_fields(kind).items()}


def value_word(code: str, margin: float = 0.0) -> str:
    """Words of a code."""
    if margin and code in NEAR:
        return say(NEAR[code], margin=format_number(margin))
    return say(VALUES.get(code, code.replace("_", " ")))


def value_text(value: Any, decimals: int = 9) -> str:
    if isinstance(value, (tuple, list)):
        texts = [value_text(entry, 12) for entry in value]
        is_point = any(isinstance(entry, float) for entry in value)
        return (", ".join(texts) if is_point else str(Listed(texts))) or say("none")
    if isinstance(value, bool):
        return say("yes") if value else say("no")
    if value is None:
        return say("none")
    if isinstance(value, Enum):
        return value_word(value.value)
    # Adding 0.0 turns a rounded -0.0 into 0.0.
    return f"{round(value, decimals) + 0.0:.{decimals}f}" if isinstance(value, float) else str(value)


def separation(metres: float, unit: str = "", decimals: int = 9) -> str:
    """A separation of two benches [m] in words; a negative one as the depth of the overlap."""
    words = value_text(float(metres), decimals)
    return (say("overlap by {depth}", depth=words[1:]) if words.startswith("-") else words) + unit


def judged_words(judged: Sequence[int] | Sequence[Sequence[int]], benches: int) -> str:
    """Short description of the benches that the engines judged, one list or one for each dragon. benches: of all"""
    several = [one for one in judged if not isinstance(one, int)]
    known = [bench for own in several for bench in own] or [one for one in judged if isinstance(one, int)]
    if len(known) == benches:
        return say("all {benches} benches", benches=benches)
    if len(known) == len(("a", "b")):
        return say("only benches {pair}", pair=value_text(known))
    values = {"count": len(known), "all": f"{benches:,}"}
    if several:
        return say("{count} of {all} benches: those near the pair", **values)
    ends = {"first": known[0], "last": known[-1]}
    return say("{count} of {all} benches, from {first} to {last}: those near the pair", **values, **ends)


def fields_of(title: str, answer: BaseModel, request: Any = None) -> Iterator[Part]:
    """An answer as one table. request: as for lines_of()"""
    yield TextTable(title, lines=lines_of(answer, request))


def lines_of(answer: BaseModel | Readable, request: Any = None, outer: str = "") -> Iterator[tuple[str, str]]:
    """Label and text of every field of an answer that has a value.

    request: to which it answers; with a margin, and with benches if the answer names those judged
    outer: label of the field in which the answer stands
    """
    for name, (_, unit) in typed_fields(type(answer)).items():
        value = getattr(answer, name)
        if name in UNSHOWN:
            continue
        what = _inside(outer, label(name))
        if isinstance(value, core.ContactCheck | answers.EncounterCheck):
            yield from ((_inside(what, engine), text) for engine, text in _verdicts(value, request.benches))
        elif isinstance(value, list | tuple) and _is_short(value) and value and _has_fields(value[0]):
            for k, entry in enumerate(value):
                yield from lines_of(entry, request, f"{what}[{k}]")
        elif _has_fields(value) and not isinstance(value, tuple(PARTS)):
            yield from lines_of(value, request, what)
        elif name in ("outcome", "limited_by"):
            yield what, value_word(value.value, getattr(request, "margin", 0.0))
        elif value is not None:
            yield what, _field_text(name, value, unit)
        elif name in NULLS:
            yield what, say(NULLS[name])


def _has_fields(value: Any) -> bool:
    return isinstance(value, BaseModel | Readable)


def _inside(outer: str, inner: str) -> str:
    return say("{name}: {text}", name=outer, text=inner) if outer else inner


def _field_text(name: str, value: Any, unit: str) -> str:
    if text := next((text for part, text in PARTS.items() if isinstance(value, part)), None):
        return text(value)
    if not _is_short(value):
        return say("{count}, listed by --json", count=sum(map(_entries, value)))
    if isinstance(value, float) and name in SEPARATIONS:
        return separation(value, " m")
    if isinstance(value, (float, tuple)) and (name in PROVEN or name.endswith("_bracket")):
        return _digits(value, unit)
    return f"{value_text(value)} {unit if value != [] else ''}".rstrip()


def _is_short(value: Any) -> bool:
    return not isinstance(value, list) or sum(map(_entries, value)) <= LISTED_MOST


def _entries(value: Any) -> int:
    """Number of the entries of a list in a list; 1 for anything else."""
    return len(value) if isinstance(value, list) else 1


def _digits(value: float | tuple[float | None, ...], unit: str) -> str:
    """A proven value with all its digits, because a rounded value could claim more than the proof."""
    ends = value if isinstance(value, tuple) else (value,)
    each = f" {unit}" if None in ends else ""
    words = ", ".join(say("unknown") if end is None else format_number(end) + each for end in ends)
    return words if each else f"{words} {unit}".rstrip()


def _feature_text(feature: core.Feature | answers.OwnedFeature) -> str:
    """A corner or an edge of a bench, perhaps of one of several dragons."""
    words, dragon = feature_words(feature), getattr(feature, "dragon", None)
    return words if dragon is None else say("{feature} of dragon {dragon}", feature=words, dragon=dragon)


def _polygon_text(value: answers.Polygon | answers.MultiPolygon) -> str:
    several = [value.coordinates] if isinstance(value, answers.Polygon) else value.coordinates
    rings = [ring for polygon in several for ring in polygon]
    polygons = counted(len(several), "{count} polygon", "{count} polygons")
    holes = counted(len(rings) - len(several), "{count} hole", "{count} holes")
    points = say("{count} points", count=sum(map(len, rings)))
    return say("{polygons}, {holes}, {points}", polygons=polygons, holes=holes, points=points)


def _pair_text(pair: Pair | answers.DragonPair) -> str:
    if isinstance(pair, answers.DragonPair):
        both = zip(pair.benches, pair.dragons, strict=True)
        return str(Listed(say("{bench} of dragon {dragon}", bench=bench, dragon=dragon) for bench, dragon in both))
    return value_text(pair)


def _verdicts(check: core.ContactCheck | answers.EncounterCheck, benches: int) -> Iterator[tuple[str, str]]:
    yield label("agree"), value_text(check.agree)
    yield label("judged"), judged_words(check.judged, benches)
    for engine, verdict in check.engines.items():
        sides = [(name, side) for name in ("before", "after") if (side := getattr(verdict, name)) is not None]
        yield value_word(engine.value), say(", ").join(f"{label(name)} {value_text(side)}" for name, side in sides)
    if check.together:
        yield label("together"), say("; ").join(map(_pair_text, check.together))
    if check.left_out:
        yield label("left_out"), value_text(check.left_out)


# Parts of answers that are one text.
PARTS: dict[type[BaseModel | Readable], Callable[[Any], str]] = {
    answers.Polygon: _polygon_text,
    answers.MultiPolygon: _polygon_text,
    answers.DragonPair: _pair_text,
    answers.OwnedFeature: _feature_text,
    core.Feature: _feature_text,
}


def with_strays(title: str, stray: float) -> str:
    """Title of a first contact that allows for strays [m]."""
    if not stray:
        return title
    return say("{title} that may come about with strays up to {stray} m", title=title, stray=format_number(stray))
