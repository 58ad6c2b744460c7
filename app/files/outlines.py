"""The envelope of a dance, or those of several, as a file: GeoJSON, or DXF for drawing programs, both in metres.

The same envelope gives the same bytes, so an answer may carry a strong ETag.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from importlib import import_module
from typing import Any, NamedTuple

import orjson

from app.extras import require
from app.wire.geojson import geometry_of
from core import Envelope

GEOJSON_TYPE, DXF_TYPE = "application/geo+json", "image/vnd.dxf"
# Layers of outer rings and of holes, each with its number in the colour index of AutoCAD: red, blue.
LAYERS = (("ENVELOPE", 1), ("ENVELOPE_HOLES", 5))
# $INSUNITS of metres, and the version of the format that programs have read since the year 2000.
METRES, VERSION = 6, "R2000"


class NamedGround(NamedTuple):
    """The envelope of a dance; of one of several dragons with its number and its name."""

    envelope: Envelope
    number: int | None = None
    name: str | None = None


def ground_geojson(grounds: Sequence[NamedGround]) -> bytes:
    """A GeoJSON feature: the polygons, with their proven bounds as properties.

    Of several dragons a collection with the feature of each, which has its number, its name and the times of its dance.
    """
    if grounds[0].number is None:
        return orjson.dumps(_feature(grounds[0].envelope, {}))
    features = [_feature(one.envelope, {"dragon": one.number, "dragon_name": one.name}) for one in grounds]
    return orjson.dumps({"type": "FeatureCollection", "features": features})


def _feature(envelope: Envelope, own: dict[str, Any]) -> dict[str, Any]:
    known = {
        "name": "envelope",
        "excess": envelope.excess,
        "area": envelope.area,
        "start": envelope.start,
        "stop": envelope.stop,
    }
    properties = known | {"certificate": envelope.certificate.method} | own
    return {"type": "Feature", "properties": properties, "geometry": geometry_of(envelope.polygons)}


def new_dxf(layers: Iterable[tuple[str, int]]) -> Any:
    """An empty DXF drawing in metres with layers, each with its colour. raises: MissingPackage"""
    require("dxf", "output", "DXF")
    ezdxf = import_module("ezdxf")
    ezdxf.options.write_fixed_meta_data_for_testing = True  # no date and no random names
    drawing = ezdxf.new(VERSION, units=METRES)
    for name, colour in layers:
        drawing.layers.add(name, color=colour)
    return drawing


def dxf_bytes(drawing: Any) -> bytes:
    """The file of a DXF drawing."""
    sink = io.StringIO()
    drawing.write(sink)
    return sink.getvalue().encode()


def ground_dxf(grounds: Sequence[NamedGround]) -> bytes:
    """A DXF drawing: each ring is a closed polyline, holes on a separate layer. raises: MissingPackage

    Of several dragons each has two layers, which end in its number.
    """
    ends = ["" if one.number is None else f"_{one.number}" for one in grounds]
    drawing = new_dxf((f"{name}{end}", colour) for end in ends for name, colour in LAYERS)
    space = drawing.modelspace()
    for end, one in zip(ends, grounds, strict=True):
        for rings in one.envelope.polygons:
            for k, ring in enumerate(rings):
                layer = {"layer": f"{LAYERS[k > 0][0]}{end}"}
                space.add_lwpolyline(ring[:-1].tolist(), close=True, dxfattribs=layer)
    return dxf_bytes(drawing)
