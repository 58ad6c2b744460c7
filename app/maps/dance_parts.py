"""What of a dance a map holds, and its venue as a request has it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.maps import geojson
from app.maps.features import MapFeature, edges_of, is_aside, place_fields
from app.wire.degrees import GeographicOrigin
from app.wire.geojson import gate_properties, outlined, read_things, venue_of
from core import InvalidValue, Venue
from core.values import Point
from core.venue import EDGES_MAX


@dataclass(frozen=True)
class DanceParts:
    """The parts of a dance in a file.

    path: in the form of a request; venue: in metres, the square first; origin: place of x = y = 0; grid: the same on a
        survey grid [m]
    things: features of the venue, where trees and walls have a radius; gates, and the square without streets
    dance: the other fields of a file that describes a dance; notes: assumptions, and things left out
    passages: speeds at which a track was walked, in the form of a request
    """

    path: Mapping[str, Any] | None = None
    venue: Venue | None = None
    origin: GeographicOrigin | None = None
    dance: Mapping[str, Any] | None = None
    notes: Sequence[str] = ()
    things: Sequence[MapFeature] = ()
    grid: Point | None = None
    passages: Sequence[Mapping[str, Any]] | None = None

    @property
    def geometry(self) -> dict[str, Any] | None:
        """The venue as GeoJSON in metres, in the form of a request."""
        if self.venue is None:
            return None
        places = place_fields(self.origin, self.grid)
        return {"type": "FeatureCollection", **places, "features": [_geojson_of(one) for one in self.things]}


def _geojson_of(one: MapFeature) -> dict[str, Any]:
    properties: dict[str, object] = {"name": one.name} | ({} if one.radius is None else {"radius": one.radius})
    if is_aside(one):
        properties["role"] = one.role
        properties |= gate_properties(one.properties)
    return geojson.feature_of(one, properties)


def refuse_many_edges(things: Sequence[MapFeature], *, of_areas: bool = False) -> None:
    """raises: InvalidValue at the field `file`, with the edges of all things, for more than a venue may have

    of_areas: only those of areas count, which are known at once
    """
    counted = [one for one in things if one.shape == "polygon"] if of_areas else things
    if sum(map(edges_of, counted)) > EDGES_MAX:
        got = sum(map(edges_of, things))
        raise InvalidValue("file", "must have at most {most} edges", got=got, most=EDGES_MAX)


def checked_venue(things: list[MapFeature]) -> Venue:
    """The venue of features, checked like a request, so that a request can use them."""
    collection = {"type": "FeatureCollection", "features": [_geojson_of(one) for one in things]}
    refuse_many_edges(things)
    try:
        return venue_of(outlined(read_things(collection)))
    except InvalidValue as error:
        raise error.with_field("file") from error
