"""What of a dance a map holds, and its venue as a request has it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from app.maps import geojson
from app.maps.features import MapFeature, edges_of, is_aside
from app.wire.degrees import GeographicOrigin
from app.wire.geojson import outlined, read_things, venue_of
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
        origin = {} if self.origin is None else {"origin": asdict(self.origin)}
        grid = {} if self.grid is None else {"grid": dict(zip("xy", self.grid, strict=True))}
        return {"type": "FeatureCollection", **origin, **grid, "features": [_geojson_of(one) for one in self.things]}


def _geojson_of(one: MapFeature) -> dict[str, Any]:
    properties: dict[str, object] = {"name": one.name} | ({} if one.radius is None else {"radius": one.radius})
    if is_aside(one):
        properties |= {"role": one.role} | {
            name: one.properties[name] for name in ("heading",) if name in one.properties
        }
    return {"type": "Feature", "properties": properties, "geometry": geojson.geometry_of(one)}


def refuse_many_edges_of(things: Sequence[MapFeature], beside: Sequence[MapFeature] = ()) -> None:
    """raises: InvalidValue at the field `file` for more edges than a venue may have, counted with those beside them"""
    if sum(map(edges_of, things)) > EDGES_MAX:
        got = sum(map(edges_of, [*things, *beside]))
        raise InvalidValue("file", "must have at most {most} edges", got=got, most=EDGES_MAX)


def checked_venue(things: list[MapFeature]) -> Venue:
    """The venue of features, checked like a request, so that a request can use them."""
    collection = {"type": "FeatureCollection", "features": [_geojson_of(one) for one in things]}
    refuse_many_edges_of(things)
    try:
        return venue_of(outlined(read_things(collection)))
    except InvalidValue as error:
        raise error.with_field("file") from error
