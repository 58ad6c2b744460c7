"""A part of a drawing: what stands on some of its layers, or in an area of it.

Plans of buildings have ten thousand edges and more, of which a dance needs the square and what stands in it.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

from app.wire.numbers import number_of
from core import InvalidValue
from core.language import phrase
from core.quantities import Given
from core.values import Point

# Most layers that a refusal names.
NAMED_MOST = 8
# Advice for a drawing with more than a venue may have.
PARTLY = phrase("read only some layers of the drawing, or an area of it, or draw it with fewer points")


@dataclass(frozen=True, slots=True)
class Choice:
    """What is read of a drawing.

    layers: by their names, in any case; None: all. area: least x and y, largest x and y [m]; None: everywhere
    counts: nothing is read, and the edges of every layer are counted
    """

    layers: tuple[str, ...] | None = None
    area: tuple[float, float, float, float] | None = None
    counts: bool = False

    @classmethod
    def of(cls, layers: str | None, area: str | None) -> Self:
        """The choice in texts: names as listed() writes them, and four numbers. raises: InvalidValue"""
        names = None if layers is None else _names_in(layers)
        if area is None:
            return cls(names)
        try:
            left, low, right, high = (number_of(one.strip()) for one in area.split(","))
        except ValueError:
            left = low = right = high = math.nan
        if not (left < right and low < high and math.isfinite(right - left) and math.isfinite(high - low)):
            rule = "must be the least x and y and then the largest x and y, as in -20,-20,20,20"
            raise InvalidValue("area", rule, got=Given(area))
        return cls(names, (left, low, right, high))

    def has_layer(self, name: str) -> bool:
        """True if what stands on this layer is read."""
        return self.layers is None or name.casefold() in map(str.casefold, self.layers)

    def reaches(self, points: Iterable[Point]) -> bool:
        """True if the box around points has a part in the area."""
        if self.area is None:
            return True
        left, low, right, high = self.area
        xs, ys = zip(*points, strict=True)
        return bool(min(xs) <= right and max(xs) >= left and min(ys) <= high and max(ys) >= low)

    @property
    def is_all(self) -> bool:
        """True if everything is read."""
        return self.layers is None and self.area is None and not self.counts

    def refuse_unknown(self, layers: Iterable[str]) -> None:
        """raises: InvalidValue for a name that none of the layers has"""
        names = list(layers)
        known = {name.casefold() for name in names}
        if unknown := [name for name in self.layers or () if name.casefold() not in known]:
            rule, more = "must be layers of the drawing on which something stands: {known}", len(names) > NAMED_MOST
            known_names = listed(names[:NAMED_MOST]) + (", …" if more else "")
            raise InvalidValue("layers", rule, got=Given(unknown[0]), known=known_names)


EVERYTHING = Choice()


def listed(names: Iterable[str]) -> str:
    """Names with commas between them; one that holds a comma or a quotation mark stands in quotation marks.

    >>> listed(["SITE", "desks, chairs"])
    'SITE, "desks, chairs"'
    """
    quoted = ('"' + name.replace('"', '""') + '"' if set(name) & set(',"') else name for name in names)
    return ", ".join(quoted)


def _names_in(text: str) -> tuple[str, ...]:
    """The names in a text, as listed() writes them. raises: InvalidValue"""
    try:
        (names,) = csv.reader([text], skipinitialspace=True, strict=True)
    except (csv.Error, ValueError):
        rule = "must be names with commas between them, and quotation marks around one that holds a comma"
        raise InvalidValue("layers", rule, got=Given(text)) from None
    return tuple(name.strip() for name in names)
