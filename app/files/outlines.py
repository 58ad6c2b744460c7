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
    """The envelope of one of several dragons, and its name."""

    name: str | None
    envelope: Envelope


def envelope_geojson(envelope: Envelope) -> bytes:
    """A GeoJSON feature: the polygons, with their proven bounds as properties."""
    return orjson.dumps(_feature(envelope))


def grounds_geojson(grounds: Sequence[NamedGround]) -> bytes:
    """A collection with the feature of each dragon, which has its number, its name and the times of its own dance."""
    features = [_feature(one.envelope, {"dragon": k, "dragon_name": one.name}) for k, one in enumerate(grounds)]
    return orjson.dumps({"type": "FeatureCollection", "features": features})


def _feature(envelope: Envelope, own: dict[str, Any] | None = None) -> dict[str, Any]:
    known = {
        "name": "envelope",
        "excess": envelope.excess,
        "area": envelope.area,
        "start": envelope.start,
        "stop": envelope.stop,
    }
    properties = known | {"certificate": envelope.certificate.method} | (own or {})
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


def envelope_dxf(envelope: Envelope) -> bytes:
    """A DXF drawing: each ring is a closed polyline, holes on a separate layer. raises: MissingPackage"""
    return _drawing([(LAYERS, envelope)])


def grounds_dxf(grounds: Sequence[NamedGround]) -> bytes:
    """A DXF drawing with two layers for each dragon, whose number they end in. raises: MissingPackage"""
    layers = [[(f"{name}_{k}", colour) for name, colour in LAYERS] for k in range(len(grounds))]
    return _drawing(list(zip(layers, [one.envelope for one in grounds], strict=True)))


def _drawing(drawn: Sequence[tuple[Sequence[tuple[str, int]], Envelope]]) -> bytes:
    """The file of envelopes, each on two layers, of outer rings and of holes."""
    drawing = new_dxf(layer for layers, _ in drawn for layer in layers)
    space = drawing.modelspace()
    for layers, envelope in drawn:
        for rings in envelope.polygons:
            for k, ring in enumerate(rings):
                space.add_lwpolyline(ring[:-1].tolist(), close=True, dxfattribs={"layer": layers[k > 0][0]})
    return dxf_bytes(drawing)
