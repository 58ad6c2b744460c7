"""How values and results print: one line in a console, a small table in a notebook."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Sequence
from dataclasses import fields
from enum import Enum
from functools import cache
from itertools import chain
from typing import Any, NamedTuple, TypeVar

import numpy as np

from core.language import Phrases, say, sense
from core.quantities import say_unit

R = TypeVar("R", bound="Readable")

# Significant digits of a number in one line, and in a table, where the two ends of a bracket must differ.
LINE_DIGITS, TABLE_DIGITS = 9, 15
# Longest text within a line, and longest repr of an input before it shows one line instead [characters].
TEXT_MOST, REPR_MOST = 60, 160
# The head of a row, which languages without spaces would break between any two characters.
ROW_HEAD = '<th scope="row" style="white-space: nowrap">'
# Longest text within a row of a table of many [characters].
CELL_MOST = 80
# Most entries of a list in a table, and most rows of a table of many; a longer one shows its first.
ENTRIES_MOST, ROWS_MOST = 6, 12
# Width of the picture below a table [pixels], and most benches in it.
PICTURE_WIDTH, PICTURE_MOST = 320, 1_000
# Most points of a path in it, and the width of its line as a share of the picture [1].
WAY_MOST, WAY_WIDTH = 800, 0.004
TOUCHING = "#D55E00"  # colour of benches that touch
# Rows of a table that are no fields, or those of a path.
ROWS: Phrases = {
    "after": "after", "agree": "agree", "angle sum": "angle sum", "angles": "angles", "before": "before",
    "centre": "centre", "centres": "centres", "entry": "entry", "exit": "exit",
    "chords": "chords", "left out": "left out", "radii": "radii", "tangent point": "tangent point",
    "turning radius": "turning radius",
    "straight": "straight piece",
    "bench a": "bench a", "bench b": "bench b", "dragon a": "dragon a", "dragon b": "dragon b", "piece": "piece",
    "velocity x": "velocity x", "velocity y": "velocity y",
    # Codes.
    "in": "in", "out": "out",
    "contact at start": "contact at start", "contact probability": "contact probability",
    "folds": "folds", "held": "held",
    "least radius": "least radius", "left": "left", "loose tail": "loose tail", "meeting": "meeting",
    "no safe stray": "no safe stray", "outside": "outside", "pause": "pause", "safe stray": "safe stray",
    "separating axis": "separating axis", "swept ground": "swept ground", "unused": "unused",
}  # fmt: skip
# What a line of a docstring says of a field.
ENTRY = re.compile(r"(?P<name>\w+): (?P<words>.*?)(?: \[(?P<unit>[^\]]*)\])?")


class Name(str):
    """The name of a row that a person gave, in no language."""

    __slots__ = ()


class Readable:
    """Base of dataclasses that print one line, and in a notebook a table of their fields with units.

    A class overrides `_line` and `_rows` to show more than its fields.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._line()}>"

    def _repr_html_(self) -> str:
        from html import escape

        table = f"<table><caption>{escape(type(self).__name__)}</caption>{self._body()}</table>"
        return table + _drawn(*self._benches(), self._drawn_lines(), escape(self._line()))

    def _body(self) -> str:
        """The rows of the table as HTML."""
        rows = [(name if isinstance(name, Name) else row_name(name), text) for name, text in self._rows() if text]
        return "".join(f"<tr>{ROW_HEAD}{_html(name)}</th>{_td(text)}</tr>" for name, text in rows)

    def _line(self) -> str:
        """The short fields, each with its unit; a bracket only if its two ends differ in these digits."""
        values = [one for one in self._values() if not _alike(*one[:2])]
        texts = [(name, display(value, unit, LINE_DIGITS)) for name, value, unit in values]
        return ", ".join(f"{say(name)} {text}" for name, text in texts if len(text) <= TEXT_MOST)

    def _rows(self) -> list[tuple[str, str]]:
        """Name and value of every row of the table."""
        return [(name, _cell(value, unit)) for name, value, unit in self._values()]

    def _benches(self) -> tuple[np.ndarray[Any, Any] | None, Sequence[int]]:
        """Corners (n, 4, 2) [m] of the benches that a small picture below the table shows, and those that it fills."""
        return None, ()

    def _drawn_lines(self) -> Sequence[np.ndarray[Any, Any]]:
        """Points (n, 2) [m] of the lines that the picture shows: of its polygons, or of its turn, path or dance."""
        rings = getattr(self, "polygons", None)
        if rings:
            return [ring for polygon in rings for ring in polygon]
        values = [getattr(self, name, None) for name in ("turn", "path", "dance")]
        return next((value._drawn_lines() for value in values if isinstance(value, Readable)), ())

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


class Markup(str):
    """A text that is HTML already."""

    __slots__ = ()


class Answers(list[R]):
    """A list of results that shows as a table in a notebook, a row each."""

    __slots__ = ()

    def __getitem__(self, k: Any) -> Any:
        return Answers(super().__getitem__(k)) if isinstance(k, slice) else super().__getitem__(k)

    def _repr_html_(self) -> str:
        return listing(self)


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
        return f"{_entries(value, digits) or say('none')} {say_unit(unit) if value else ''}".rstrip()
    return f"{_entry(value, digits)} {say_unit(unit)}".rstrip()


def format_range(values: Sequence[float] | np.ndarray, unit: str = "", digits: int = LINE_DIGITS) -> str:
    """The range of the values, or their common value. values: (...), not empty"""
    least, most = float(np.min(values)) + 0.0, float(np.max(values)) + 0.0  # no -0
    text = f"{least:.{digits}g}"
    if least != most:
        text = say("{least} to {most}", least=text, most=f"{most:.{digits}g}")
    return f"{text} {unit}".rstrip()


def listing(values: Sequence[Readable]) -> Markup:
    """A table of HTML with a row for each result, their units in its head: the fields that are short in all of them."""
    shown = [{(name, unit): value for name, value, unit in one._values()} for one in values[:ROWS_MOST]]
    texts = [{head: display(value) for head, value in row.items()} for row in shown]
    heads = [head for head in dict.fromkeys(chain.from_iterable(shown)) if not _alike(head[0], shown[0].get(head))]
    heads = [head for head in heads if all(len(row.get(head, "")) <= CELL_MOST for row in texts)]
    rows = [[str(k), *(row.get(head, "") for head in heads)] for k, row in enumerate(texts)]
    return Markup(f"<table>{table_rows([('', ''), *heads], rows, len(values))}</table>")


def table_rows(heads: Iterable[tuple[str, str]], rows: Iterable[Sequence[str]], count: int) -> str:
    """Rows of HTML below a row of heads. heads: name and unit of each column; count: of all rows, shown or not"""
    names = [row_name(name) + (f" [{say_unit(unit)}]" if unit else "") for name, unit in heads]
    cells = [f'<th scope="col">{_html(name)}</th>' for name in names]
    lines = ["".join(cells), *("".join(map(_td, row)) for row in rows)]
    if (more := count - len(lines) + 1) > 0:
        lines.append(f'<td colspan="{len(cells)}">{_html(say("and {count} more", count=more))}</td>')
    return "".join(f"<tr>{line}</tr>" for line in lines)


def row_name(name: str) -> str:
    """The name of a row or column in the language that is spoken."""
    return say(ROWS.get(name, name)) if name else ""


def _html(text: str) -> str:
    from html import escape

    return text if isinstance(text, Markup) else escape(text)


def _td(text: str) -> str:
    return f"<td>{_html(text)}</td>"


def _cell(value: object, unit: str) -> str:
    """The text of a value in a table: several results are a table of their own, or a line each."""
    if isinstance(value, (tuple, list)) and value and isinstance(value[0], Readable):
        if type(value[0])._line is Readable._line:
            return listing(value)
        lines = [_html(_entry(one, LINE_DIGITS)) for one in value[:ROWS_MOST]]
        more = len(value) - len(lines)
        return Markup("<br>".join([*lines, *[say("and {count} more", count=more)] * (more > 0)]))
    return display(value, unit, TABLE_DIGITS)


def _drawn(
    outlines: np.ndarray[Any, Any] | None, filled: Sequence[int], ways: Sequence[np.ndarray[Any, Any]], label: str
) -> str:
    """A drawing of benches or paths seen from above as SVG, or nothing.

    outlines: (n, 4, 2) [m]; ways: points (n, 2) [m]; label: in words, escaped
    """
    if outlines is not None and 0 < len(outlines) <= PICTURE_MOST:
        lines, end = [*outlines * (1.0, -1.0)], "z"
    elif ways:
        lines, end = [way[:: 1 + len(way) // WAY_MOST] * (1.0, -1.0) for way in ways], ""
    else:
        return ""
    points = np.concatenate(lines)
    low = points.min(axis=0) - 0.5
    width, height = points.max(axis=0) + 0.5 - low
    stroke = 0.05 if end else max(width, height) * WAY_WIDTH
    shapes = ["M" + " ".join(f"{x:.2f},{y:.2f}" for x, y in line) + end for line in lines]
    benches = f'<path d="{"".join(shapes)}" fill="none" stroke="currentColor" stroke-width="{stroke:.2g}"/>'
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
        text = str(getattr(value, "words", value.value)).replace("_", " ")
        if text == "both":
            return sense("gate", "both")
        return sense("side", "right") if text == "right" else say(text)
    if isinstance(value, dict):
        return ", ".join(f"{_entry(name, digits)} {display(one, '', digits)}" for name, one in value.items())
    if isinstance(value, np.ndarray):
        return display(value, "", digits)
    if isinstance(value, float):
        return f"{value + 0.0:.{digits}g}"  # no -0
    if isinstance(value, tuple):
        return f"({_entries(value, digits)})"
    return value._line() if isinstance(value, Readable) and type(value).__str__ is object.__str__ else str(value)
