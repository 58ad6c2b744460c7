"""How values and results print: one line in a console, a small table in a notebook."""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from dataclasses import fields
from enum import Enum
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from core.language import Phrases, say

# Significant digits of a number in one line, and in a table, where the two ends of a bracket must differ.
LINE_DIGITS, TABLE_DIGITS = 9, 15
# Longest text within a line, and longest repr of an input before it shows one line instead [characters].
TEXT_MOST, REPR_MOST = 60, 160
# Most entries of a list in a table; a longer list shows its first entries.
ENTRIES_MOST = 6
# Width of the picture below a table [pixels], and most benches in it.
PICTURE_WIDTH, PICTURE_MOST = 320, 1_000
# Most points of a path in it.
WAY_MOST = 800
TOUCHING = "#D55E00"  # colour of benches that touch
# Rows of a table that are no fields, or those of a path.
ROWS: Phrases = {
    "after": "after", "agree": "agree", "angle sum": "angle sum", "angles": "angles", "before": "before",
    "centre": "centre", "centres": "centres", "entry": "entry", "exit": "exit",
    "chords": "chords", "left out": "left out", "radii": "radii", "tangent point": "tangent point",
    "turning radius": "turning radius",
}  # fmt: skip
# What a line of a docstring says of a field.
ENTRY = re.compile(r"(?P<name>\w+): (?P<words>.*?)(?: \[(?P<unit>[^\]]*)\])?")


class Readable:
    """Base of dataclasses that print one line, and in a notebook a table of their fields with units.

    A class overrides `_line` and `_rows` to show more than its fields.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._line()}>"

    def _repr_html_(self) -> str:
        from html import escape

        rows = (
            f'<tr><th scope="row">{escape(say(name))}</th><td>{escape(text)}</td></tr>' for name, text in self._rows()
        )
        table = f"<table><caption>{escape(type(self).__name__)}</caption>{''.join(rows)}</table>"
        return table + _drawn(*self._benches(), self._drawn_way(), escape(self._line()))

    def _line(self) -> str:
        """The short fields, each with its unit; a bracket only if its two ends differ in these digits."""
        values = [one for one in self._values() if not _alike(*one[:2])]
        texts = [(name, display(value, unit, LINE_DIGITS)) for name, value, unit in values]
        return ", ".join(f"{say(name)} {text}" for name, text in texts if len(text) <= TEXT_MOST)

    def _rows(self) -> list[tuple[str, str]]:
        """Name and value of every row of the table."""
        return [(name, display(value, unit, TABLE_DIGITS)) for name, value, unit in self._values()]

    def _benches(self) -> tuple[np.ndarray[Any, Any] | None, Sequence[int]]:
        """Corners (n, 4, 2) [m] of the benches that a small picture below the table shows, and those that it fills."""
        return None, ()

    def _drawn_way(self) -> np.ndarray[Any, Any] | None:
        """Points (n, 2) [m] of the path that the picture shows."""
        return None

    def _values(self) -> list[tuple[str, object, str]]:
        """Name, value and unit of every field that has a value."""
        every = [field.name for field in fields(self) if field.repr]  # type: ignore[arg-type]
        kind: Any = type(self)
        known = meanings(kind)
        values = [(name, getattr(self, name), known.get(name, NO_MEANING).unit) for name in every]
        return [(name.replace("_", " "), value, unit) for name, value, unit in values if value is not None]


class WithArrays(Readable):
    """Base of results with arrays: equal if all fields are, and not hashable."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in fields(self) if field.compare]  # type: ignore[arg-type]
        return all(_equal(getattr(self, name), getattr(other, name)) for name in names)


class Meaning(NamedTuple):
    """What a field is in words, and its unit, empty for what is no quantity."""

    words: str
    unit: str


# Of a class without docstrings, which Python leaves out when it is asked to (-OO).
NO_MEANING = Meaning("", "")


@cache
def meanings(kind: Any) -> dict[str, Meaning]:
    """What the fields and properties of a class are. kind: the class

    Its docstring says it once for all readers, the service's description among them: after the first paragraph each
    field has a line `name: words [unit]`, continued by indented lines. A property says it in its own first line.
    """
    return {name: one for base in reversed(kind.__mro__) for name, one in _own_meanings(base).items()}


@cache
def _own_meanings(base: Any) -> dict[str, Meaning]:
    """What a class says itself, without those that it is based on."""
    properties = {name: one.__doc__ for name, one in vars(base).items() if isinstance(one, property)}
    texts = {name: inspect.cleandoc(text) for name, text in properties.items() if text}
    lines = [f"{name}: {text.partition(chr(10))[0].removesuffix('.')}" for name, text in texts.items()]
    own = inspect.cleandoc(base.__doc__ or "").partition("\n\n")[2]
    lines += re.sub(r"\n {4}", " ", own).split("\n")
    return {one["name"]: Meaning(one["words"], one["unit"] or "") for one in map(ENTRY.fullmatch, lines) if one}


def display(value: object, unit: str = "", digits: int = LINE_DIGITS) -> str:
    """The text that shows a value: numbers with their unit, an array by its shape and range, a result by its line.

    >>> display((2.5, 1 / 3), "m", 4)
    '2.5, 0.3333 m'
    >>> display(np.arange(12.0).reshape(3, 4), "s")
    'array of 3 x 4, 0 to 11 s'
    >>> display(np.array(2.5), "m"), display(np.empty(0), "m")
    ('2.5 m', 'none')
    """
    if isinstance(value, np.ndarray):
        if value.size <= 1:
            return format_range(value, unit, digits) if value.size else say("none")
        shape = " x ".join(map(str, value.shape))
        return say("array of {shape}, {span}", shape=shape, span=format_range(value, unit, digits))
    if isinstance(value, (tuple, list)):
        return f"{_entries(value, digits) or say('none')} {unit if value else ''}".rstrip()
    return f"{_entry(value, digits)} {unit}".rstrip()


def format_range(values: Sequence[float] | np.ndarray, unit: str = "", digits: int = LINE_DIGITS) -> str:
    """The range of the values, or their common value. values: (...), not empty"""
    least, most = float(np.min(values)) + 0.0, float(np.max(values)) + 0.0  # no -0
    text = f"{least:.{digits}g}"
    if least != most:
        text = say("{least} to {most}", least=text, most=f"{most:.{digits}g}")
    return f"{text} {unit}".rstrip()


def _drawn(
    outlines: np.ndarray[Any, Any] | None, filled: Sequence[int], way: np.ndarray[Any, Any] | None, label: str
) -> str:
    """A drawing of benches or a path seen from above as SVG, or nothing.

    outlines: (n, 4, 2) [m]; way: points (n, 2) [m]; label: in words, escaped
    """
    if outlines is not None and 0 < len(outlines) <= PICTURE_MOST:
        lines, end = outlines * (1.0, -1.0), "z"
    elif way is not None:
        lines, end = (way[:: 1 + len(way) // WAY_MOST] * (1.0, -1.0))[None], ""
    else:
        return ""
    low = lines.min(axis=(0, 1)) - 0.5
    width, height = lines.max(axis=(0, 1)) + 0.5 - low
    shapes = ["M" + " ".join(f"{x:.2f},{y:.2f}" for x, y in line) + end for line in lines]
    benches = f'<path d="{"".join(shapes)}" fill="none" stroke="currentColor" stroke-width="0.05"/>'
    benches += f'<path d="{"".join(shapes[bench] for bench in filled)}" fill="{TOUCHING}"/>' if filled else ""
    return (
        f'<svg role="img" aria-label="{label}" width="{PICTURE_WIDTH}" style="max-height: {PICTURE_WIDTH}px" '
        f'viewBox="{low[0]:.2f} {low[1]:.2f} {width:.2f} {height:.2f}">{benches}</svg>'
    )


def _equal(one: object, other: object) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_equal(value, other[name]) for name, value in one.items())
    if isinstance(one, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(one) == len(other) and all(map(_equal, one, other))
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=np.asarray(one).dtype.kind == "f")  # type: ignore[arg-type]
    return bool(one == other)


def _alike(name: str, value: object) -> bool:
    """True for a bracket whose two ends have the same digits in one line."""
    return name.endswith(" bracket") and isinstance(value, tuple) and len({display(end) for end in value}) == 1


def _entries(values: Sequence[object], digits: int) -> str:
    between = "; " if values and isinstance(values[0], Readable) else ", "
    text = between.join(_entry(value, digits) for value in values[:ENTRIES_MOST])
    more = len(values) - ENTRIES_MOST
    return say("{entries} and {count} more", entries=text, count=more) if more > 0 else text


def _entry(value: object, digits: int) -> str:
    if value is None:
        return say("unknown")
    if isinstance(value, bool):
        return say("yes") if value else say("no")
    if isinstance(value, Enum):
        return say(str(value.value))
    if isinstance(value, float):
        return f"{value + 0.0:.{digits}g}"  # no -0
    if isinstance(value, tuple):
        return f"({_entries(value, digits)})"
    return value._line() if isinstance(value, Readable) and type(value).__repr__ is Readable.__repr__ else str(value)
