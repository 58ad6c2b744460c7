"""Refusals in sentences for people: the labels of the page in place of dotted names, and its units."""

from __future__ import annotations

import math
import re

from app.wire.fields import LABELLED, extra_of
from core.errors import BenchDragonError
from core.language import Phrases, say
from core.quantities import Given, Parameter, Quantity, Value, format_field, message_of

# What a place is, with # for an index: {number} is one more than the first of them.
PLACES: Phrases = {
    "collision_time": "“First contact”",
    "turn_length": "“Length of the turn”",
    "speed": "“Maximum head speed”",
    "file": "the file",
    "file.features": "the list of things in the file",
    "path": "the path",
    "venue": "the square",
    "origin": "the place of x = y = 0",
    "start": "the beginning",
    "stop": "the end",
    "times.start": "the beginning",
    "times.stop": "the end",
    "time": "the time",
    "path.start": "“Head at time 0, along the path”",
    "path.radius": "“Radius of corners”",
    "venue.origin.latitude": "“Latitude of x = y = 0”",
    "venue.origin.longitude": "“Longitude of x = y = 0”",
    "venue.features.#.properties.radius": "the radius of thing {number}",
    "venue.features.#.properties.name": "the name of thing {number}",
    "venue.features.#.geometry.coordinates.#.#.#": "a coordinate of thing {number}",
    "points": "the list of points",
    "path.points": "the list of points",
    "path.points.#": "point {number} of the path",
    "path.points.#.#": "a coordinate of point {number} of the path",
    "dragon.names.#": "the name of bench {number}",
    "dances": "the list of dragons",
    "part": "the dragon that gets cards",
    "most": "the longest wait",
    "least": "the shortest wait",
    "gates": "the list of gates",
    "gates.#.point": "gate {number}",
    "gates.#.heading": "the direction of gate {number}",
    "gates.#.street_width": "the width of the street at gate {number}",
    "gates.#.street_length": "the length of the street at gate {number}",
    "dances.#": "dragon {number}",
    "dances.#.dragon": "the benches of dragon {number}",
    "dances.#.path": "the path of dragon {number}",
    "dances.#.name": "the name of dragon {number}",
    "dances.#.delay": "the delay of dragon {number}",
}
# Fields that the page shows in centimetres.
SMALL = ("stray", "hole", "pin")
# Sentences in place of those for programs, by their templates.
INSTEAD: Phrases = {
    "{field} must end at until_s [m] or at until_time [s]": "A passage ends at a place or at a time",
    "{field} must be GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON": (
        "This file cannot be read here: save it as GeoJSON, KML, KMZ or DXF, or as a dance in TOML or JSON"
    ),
    "{file} must describe a path": (
        "The path in the file is not valid: it needs at least two points, each with two coordinates"
    ),
    "Jobs and uploads need the token of this service: send the header Authorization: Bearer TOKEN.": (
        "Jobs and uploads need the token of this service: give it below, at “Token, if this service needs one”"
    ),
    "The body must be at most {most} bytes": "The file is longer than {most} bytes",
    "venue: a ring of {polygon} must be closed and have at least 4 points": "{polygon} needs at least three corners",
}
# Before a sentence about a table or the square, beside which the page shows it.
BESIDE = re.compile(r"^(?:\{table\}|venue): ")
# Points that a sentence counts from 0, and people from 1.
POINTS = "between points {first} and {second}"
# A space between two characters of a language without spaces.
SPACE = re.compile(r"(?<=[^\0-\x7f]) (?=[^\0-\x7f])")


def sentence_for(error: BenchDragonError, pointer: str | None = None) -> str:
    """What an error says to people, in the language that is spoken. pointer: to its place in the body"""
    field = error.values.get("field")
    name = field.name if isinstance(field, Parameter) else error.field
    is_small = name.rpartition(".")[2] in SMALL

    def shown(value: Value) -> Value:
        match value:
            case Parameter(dotted):
                return Given(None, label_of(dotted, pointer if value == field else None))
            case Given("" | None, "" | '""' | "null"):
                return say("an empty field")
            case Quantity(metres, "m") if is_small:
                return Quantity(100.0 * metres, "cm", 12)
            case Quantity(radians, "rad"):
                return Quantity(degrees := round(math.degrees(radians), 2), "degrees", text=f"{degrees:g}°")
            case "m" if is_small:
                return "cm"
        return value

    values = {word: shown(value) for word, value in error.values.items()}
    if POINTS in error.template:
        values = {word: value + 1 if isinstance(value, int) else value for word, value in values.items()}
    got = None if error.got is None else shown(error.got)
    reason = "" if is_small and error.reason.startswith("lengths are") else error.reason
    if error.template in INSTEAD:
        words = say(INSTEAD[error.template], **values)
    else:
        words = message_of(BESIDE.sub("", error.template), reason, got, values)
    words = SPACE.sub("", words[:1].upper() + words[1:])
    return words if words.endswith((".", "?", "。", "？")) else say("{words}.", words=words)


def label_of(dotted: str, pointer: str | None = None) -> str:
    """The label of a parameter, or of its place in a body."""
    for place in ((pointer or "")[1:].replace("/", "."), dotted):
        if words := PLACES.get(re.sub(r"\d+", "#", place)):
            number = re.search(r"\d+", place)
            return say(words, number=int(number[0]) + 1) if number else say(words)
    names = [part for part in dotted.split(".") if not part.isdigit()]
    field = LABELLED.get(names[-1]) if names else None
    return say("“{name}”", name=say(extra_of(field, "label"))) if field else format_field(dotted)
