"""The envelope of a dance as a file: GeoJSON, or DXF for drawing programs, both in metres.

The same envelope gives the same bytes, so an answer may carry a strong ETag.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from importlib import import_module
from typing import Any

import orjson

from app.extras import require
from app.wire.geojson import geometry_of
from core import Envelope

GEOJSON_TYPE, DXF_TYPE = "application/geo+json", "image/vnd.dxf"
# Layers of outer rings and of holes, each with its number in the colour index of AutoCAD: red, blue.
LAYERS = (("ENVELOPE", 1), ("ENVELOPE_HOLES", 5))
# $INSUNITS of metres, and the version of the format that programs have read since the year 2000.
METRES, VERSION = 6, "R2000"


def envelope_geojson(envelope: Envelope) -> bytes:
    """A GeoJSON feature: the polygons, with their proven bounds as properties."""
    known = {
        "name": "envelope",
        "excess": envelope.excess,
        "area": envelope.area,
        "start": envelope.start,
        "stop": envelope.stop,
    }
    properties = known | {"certificate": envelope.certificate.method}
    return orjson.dumps({"type": "Feature", "properties": properties, "geometry": geometry_of(envelope)})


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
    drawing = new_dxf(LAYERS)
    space = drawing.modelspace()
    for rings in envelope.polygons:
        for k, ring in enumerate(rings):
            space.add_lwpolyline(ring[:-1].tolist(), close=True, dxfattribs={"layer": LAYERS[k > 0][0]})
    return dxf_bytes(drawing)


# Functions of an envelope by the ending of the file.
WRITERS = {".geojson": envelope_geojson, ".json": envelope_geojson, ".dxf": envelope_dxf}
