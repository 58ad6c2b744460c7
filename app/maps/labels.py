"""Texts of a drawing as names of the things beside which, or in which, they stand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from app.maps.features import MapFeature, area_of, holds
from app.wire.geojson import INNER_SQUARE
from core.values import Point

# A text that is at most this many of its heights from a thing stands beside it [1]; a letter is 0.6 heights wide.
BESIDE, LETTER = 1.5, 0.6
# Most pairs of a text and a side of a thing that are compared: some seconds of work. Texts of more name nothing.
PAIRS_MAX = 3_000_000


@dataclass(frozen=True)
class MapText:
    """A text. places: its beginning, its middle and its end [m]; height: of its letters [m]"""

    text: str
    places: tuple[Point, ...]
    height: float


def label_of(text: str, at: Point, height: float, turned: float, align: float) -> MapText:
    """A text at a place. turned: its direction [rad]; align: share of it before the place [1]"""
    letters = max((len(line) for line in text.splitlines()), default=0)
    length = LETTER * height * letters
    shares = [(share - align) * length for share in (0.0, 0.5, 1.0)]
    places = ((at[0] + share * math.cos(turned), at[1] + share * math.sin(turned)) for share in shares)
    return MapText(text, tuple(places), height)


def are_too_many(features: Sequence[MapFeature], labels: Sequence[MapText]) -> bool:
    """True if the texts are not compared with the things."""
    return sum(len(ring) for one in features for ring in one.rings) * len(labels) > PAIRS_MAX


def names_of(features: Sequence[MapFeature], labels: Sequence[MapText]) -> dict[int, str]:
    """Names of things by their places in the list.

    A text names the smallest thing that it stands in; but if that holds other things too, the nearest one beside it.
    """
    names: dict[int, str] = {}
    for label in labels:
        around = [k for k, one in enumerate(features) if _is_in(one, label.places[0])]
        own = min(around, key=lambda k: area_of(features[k]), default=None)
        near = _nearest(features, label, own)
        if (owner := own if near is None else near) is not None:
            names.setdefault(owner, label.text)
    return names


def _nearest(features: Sequence[MapFeature], label: MapText, own: int | None) -> int | None:
    """The thing beside a text; None without one, and if the text stands in a thing that holds no other one."""
    others = [k for k, one in enumerate(features) if k != own and one.role not in ("mark", INNER_SQUARE)]
    if own is not None:
        if features[own].shape != "polygon":
            return None
        others = [k for k in others if holds(features[own].rings, features[k].rings[0][0])]
    apart = {k: _distance(features[k], label) for k in others}
    nearest = min(apart, key=apart.__getitem__, default=None)
    return nearest if nearest is not None and apart[nearest] <= BESIDE * label.height else None


def _distance(one: MapFeature, label: MapText) -> float:
    """Distance of a text from a thing, 0 on it [m]."""
    return max(0.0, min(_from_point(one, place) for place in label.places) - (one.radius or 0.0))


def _from_point(one: MapFeature, place: Point) -> float:
    if one.shape == "point":
        return math.dist(one.rings[0][0], place)
    if one.shape == "polygon" and holds(one.rings, place):
        return 0.0
    return min((_from_side(a, b, place) for ring in one.rings for a, b in pairwise(ring)), default=math.inf)


def _from_side(a: Point, b: Point, place: Point) -> float:
    along = (b[0] - a[0], b[1] - a[1])
    squared = along[0] ** 2 + along[1] ** 2
    share = ((place[0] - a[0]) * along[0] + (place[1] - a[1]) * along[1]) / squared if squared else 0.0
    share = min(1.0, max(0.0, share))
    return math.dist((a[0] + share * along[0], a[1] + share * along[1]), place)


def _is_in(feature: MapFeature, place: Point) -> bool:
    if feature.shape == "polygon":
        return holds(feature.rings, place)
    return feature.shape == "point" and math.dist(feature.rings[0][0], place) <= (feature.radius or 0.0)
