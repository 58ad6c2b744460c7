"""Maps as DXF, the format of drawing programs, in metres or in the unit that the drawing states."""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from itertools import islice
from typing import Any

import orjson

from app.extras import require
from app.files.outlines import dxf_bytes, new_dxf
from app.maps.choice import EVERYTHING, Choice
from app.maps.entities import HOLES, MARKS, Entities, faults
from app.maps.features import LEAVE_OUT, Drawing, MapFeature, Unit, damaged_kind, inner_point, place_fields, points_in
from app.wire.geojson import GATE, INNER_SQUARE, LANE, gate_properties
from core import InvalidValue
from core.quantities import Quantity
from core.venue import Ring

# First line, end, and what stands there instead.
Change = tuple[int, int, list[bytes]]
# Metres in the units of $INSUNITS: inch, foot, mile, millimetre, centimetre, metre, kilometre, microinch, mil, yard,
# micrometre (13), decimetre, decametre, hectometre, and foot, inch, yard and mile of surveyors in the US (21 to 24).
UNITS = {1: 0.0254, 2: 0.3048, 3: 1609.344, 4: 0.001, 5: 0.01, 6: 1.0, 7: 1000.0, 8: 2.54e-8, 9: 2.54e-5, 10: 0.9144,
         13: 1e-6, 14: 0.1, 15: 10.0, 16: 100.0, 21: 1200 / 3937, 22: 100 / 3937, 23: 3600 / 3937,
         24: 6336000 / 3937}  # fmt: skip
# Largest width of a drawing without a unit, which is taken as metres: 2 km. The same number in millimetres would be a
# square of 2 m, too small for a dance [1].
ACROSS_MAX = 2_000.0
# Most lines and most records of a file, counted before ezdxf reads it: it takes 50 us for a record (2026-11-26).
LINES_MAX, RECORDS_MAX = 2_000_000, 100_000
RECORD_BEGIN = re.compile(rb"\n[^\S\n]*[+-]?0[0_]*[^\S\n]*\n[^\S\n]*[A-Za-z_]")
# Layer of each role, with its number in the colour index of AutoCAD: white or black, grey, blue, red, green, cyan.
LAYERS = {
    "square": ("SQUARE", 7),
    "obstacle": ("OBSTACLES", 8),
    "path": ("PATH", 5),
    "mark": (MARKS, 1),
    GATE: ("GATES", 3),
    INNER_SQUARE: (INNER_SQUARE.upper(), 7),
    LANE: ("EMERGENCY LANES", 4),
}
# Words of ezdxf for an entity that it has left out, with its kind in group 1.
DELETED = re.compile(r"(?:[Dd]elet|[Rr]emov)\w*[^#]*?\b([A-Z0-9]*[A-Z][A-Z0-9_]+)\(#")
# Words of ezdxf for an entity without the marker of one of its parts: the marker, the kind and the handle. It names an
# object, such as a style of lines, by the kind of what that styles. Kinds of which it misses one and that are drawn,
# and the most kinds that are mended; and codes that stand before it.
UNMARKED = re.compile(r"missing '(\w+)' subclass in (\w+)\(#(\w+)\)")
MARKERS, KINDS_MOST = ("LWPOLYLINE", "SPLINE"), 8
COMMON = {
    b"%d" % code for code in (5, 6, 8, 48, 60, 62, 67, 100, 102, 284, 330, 347, 360, 370, 380, 390, 410, 420, 430, 440)
}
# Records that are no entities, parts of a polyline, and a code of a real number before what is no number as DXF has it:
# ezdxf reads the beginning of 0,5 and of 1.2.3, and Python reads 1_0.
STRUCTURE = ("SECTION", "ENDSEC", "TABLE", "ENDTAB", "BLOCK", "ENDBLK", "SEQEND", "CLASS", "EOF")
PARTS = ("VERTEX", "SEQEND")
MISREAD = re.compile(
    rb"\n[^\S\n]*(?:[1-5]\d|1[1-4]\d|2[1-3]\d|46\d|10[1-5]\d)[^\S\n]*\n"
    rb"(?![^\S\n]*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[^\S\n]*(?:\n|\Z))"
)
# Version of a drawing whose entities have markers.
MODERN = re.compile(rb"\$ACADVER\s+1\s+AC10(?!09|06|04|03|02)")
# Record for values that no entity can hold: the path as a request describes it, the origin, and by handle names, radii
# of walls and properties of gates. A string of a record has at most 2,049 characters.
RECORD, CHUNK = "BENCH_DRAGON", 2_000
# Height of the text in a drawing, and side of the crosses at marks [m].
WORDS, CROSS = 0.3, 0.2


def read(data: bytes, choice: Choice = EVERYTHING) -> Drawing:
    """The map in a drawing, or a part of it. raises: InvalidValue; MissingPackage"""
    with _document(data) as (document, fixes):
        return _drawing(document, fixes, choice)


def layers_of(data: bytes) -> dict[str, int]:
    """The layers on which something is drawn that is read, and the edges of each in a venue. raises: as read()"""
    with _document(data) as (document, _):
        return Entities(document, UNITS.get(_unit_of(document), 1.0), _record_of(document), Choice(counts=True)).edges()


def _unit_of(document: Any) -> int:
    return int(document.header.get("$INSUNITS", 0))


@contextmanager
def _document(data: bytes) -> Iterator[tuple[Any, list[str]]]:
    """Context in which a document of ezdxf is used, and the faults that it has mended. raises: as read()"""
    require("dxf", "file", "DXF")
    if data.startswith(b"AutoCAD Binary DXF"):
        raise InvalidValue("file", "must be DXF as text: save it as ASCII DXF", got="binary DXF")
    if data.startswith(b"AC10"):
        raise InvalidValue("file", "must be DXF: save it as DXF", got="DWG")
    _refuse_many(data)
    # Its messages may hold parts of the file.
    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)
    try:
        yield _read(data)
    except InvalidValue:
        raise
    except faults() as error:
        rule, why = "must be DXF that can be read: {why}", str(error)[:200]
        raise InvalidValue("file", rule, why=why) from error


def _read(data: bytes) -> tuple[Any, list[str]]:
    """The document as ezdxf reads it, and the faults that it has mended.

    Small programs leave out the markers (code 100) of the parts of an entity. ezdxf does without those of simple ones;
    those that it misses are written into the file, and entities of other kinds without them are left out. So is an
    entity of which it can make nothing.
    """
    recover = import_module("ezdxf.recover")
    missing: list[str] = []
    attempts, is_searched = 0, False
    if MISREAD.search(data):
        data, missing = _without(data, _is_misread)
    while True:
        try:
            document, audit = recover.read(io.BytesIO(data))
            return document, [*missing, *(str(fix.message) for fix in audit.fixes)]
        except faults() as error:
            unmarked = UNMARKED.search(str(error))
            if unmarked is None or attempts == KINDS_MOST:
                if is_searched:
                    raise
                is_searched = True
                data, damaged = _without(data, _damage_test(data))
                if not damaged:
                    raise
                missing += damaged
                continue
            marker, kind, handle = unmarked.groups()
            data, left_out = _marked(data, kind, marker, handle)
            missing += [f"deleted {kind}(#)"] * left_out
            attempts += 1


def _marked(data: bytes, kind: str, marker: str, handle: str) -> tuple[bytes, int]:
    """The file with the marker in every entity of a kind that lacks it; or without these entities, and their number,
    for kinds that are not drawn, and without the object that has the handle."""
    lines, changes, left_out = data.split(b"\n"), list[Change](), 0
    for start, end in _records(lines):
        codes = range(start + 2, end - 1, 2)
        is_of_kind = _kind(lines, start) == kind
        handles = (lines[k + 1].strip() for k in codes if lines[k].strip() == b"5")
        if not is_of_kind and handle.encode() not in handles:
            continue
        if any(lines[k].strip() == b"100" and lines[k + 1].strip() == marker.encode() for k in codes):
            continue
        if kind not in MARKERS or not is_of_kind:
            changes.append((start, end, []))
            left_out += is_of_kind
            continue
        own = next((k for k in codes if lines[k].strip() not in COMMON), end)
        shared = [line for k in range(start + 2, own, 2) if lines[k].strip() != b"100" for line in lines[k : k + 2]]
        begin = [*lines[start : start + 2], b"100", b"AcDbEntity", *shared]
        changes.append((start, end, [*begin, b"100", marker.encode(), *lines[own:end]]))
    return _changed(lines, changes), left_out


def _changed(lines: list[bytes], changes: Iterable[Change]) -> bytes:
    """The file with these changes, in their order."""
    result, begin = list[bytes](), 0
    for start, end, instead in changes:
        result += [*lines[begin:start], *instead]
        begin = end
    return b"\n".join([*result, *lines[begin:]])


def _records(lines: list[bytes]) -> list[tuple[int, int]]:
    """Of every record its first line, and the first one behind it."""
    starts = [k for k in range(0, len(lines) - 1, 2) if lines[k].strip() == b"0"]
    return list(zip(starts, [*starts[1:], len(lines)], strict=True))


def _kind(lines: list[bytes], start: int) -> str:
    return lines[start + 1].strip().decode(errors="replace").upper()


def _without(data: bytes, is_damaged: Callable[[list[bytes]], bool]) -> tuple[bytes, list[str]]:
    """The file without its damaged entities, and words for each of them as ezdxf has them; a polyline with a damaged
    vertex is one."""
    lines, entities = data.split(b"\n"), list[tuple[int, int]]()
    for start, end in _records(lines):
        if _kind(lines, start) in PARTS and entities and _kind(lines, entities[-1][0]) == "POLYLINE":
            entities[-1] = (entities[-1][0], end)
        else:
            entities.append((start, end))
    damaged: list[Change] = [
        (start, end, [])
        for start, end in entities
        if _kind(lines, start) not in STRUCTURE and is_damaged(lines[start:end])
    ]
    return _changed(lines, damaged), [f"deleted {_kind(lines, start)}(#)" for start, *_ in damaged]


def _is_misread(lines: list[bytes]) -> bool:
    """True if something drawn has a number that DXF does not have."""
    return not _is_undrawn(_kind(lines, 0)) and MISREAD.search(b"\n" + b"\n".join(lines)) is not None


def _damage_test(data: bytes) -> Callable[[list[bytes]], bool]:
    """Whether ezdxf can make nothing of an entity, also where its markers are mended."""
    recover, tags, factory = (import_module(f"ezdxf.{name}") for name in ("recover", "lldxf.tags", "entities.factory"))
    extended, is_old = import_module("ezdxf.lldxf.extendedtags").ExtendedTags, not MODERN.search(data)
    document = import_module("ezdxf").new("R12" if is_old else "R2000")

    def is_damaged(lines: list[bytes]) -> bool:
        try:
            for record in tags.group_tags(recover.safe_tag_loader(io.BytesIO(b"\n".join([*lines, b"0", b"EOF", b""])))):
                factory.load(extended(record), document)
        except faults() as error:
            unmarked = UNMARKED.search(str(error))
            return unmarked is None or unmarked[2] not in MARKERS or unmarked[2] != _kind(lines, 0)
        return False

    return is_damaged


def _refuse_many(data: bytes) -> None:
    """Refuse a file that takes long to read, before it is read."""
    lines, records = data.count(b"\n"), sum(1 for _ in islice(RECORD_BEGIN.finditer(data), RECORDS_MAX + 1))
    if lines > LINES_MAX or records > RECORDS_MAX:
        rule = f"must have at most {{lines}} lines and {{records}} records: {LEAVE_OUT}"
        raise InvalidValue("file", rule, got="more", lines=LINES_MAX, records=RECORDS_MAX)


def _drawing(document: Any, fixes: Iterable[str], choice: Choice) -> Drawing:
    """fixes: what ezdxf says of faults that it has mended"""
    code, record = _unit_of(document), _record_of(document)
    entities = Entities(document, UNITS.get(code, 1.0), record, choice)
    choice.refuse_unknown(entities.seen_layers)
    for fix in fixes:
        if (deleted := DELETED.search(fix)) and not _is_undrawn(deleted[1]):
            entities.collector.leave_out(damaged_kind(deleted[1]))
    features, collector = tuple(entities.features()), entities.collector
    if code not in UNITS:
        _refuse_wide(collector.features)
    unit = Unit.METRES if code in UNITS else Unit.ASSUMED_METRES
    return replace(collector.drawing(unit, record), features=features)


def _is_undrawn(kind: str) -> bool:
    """True for what stands nowhere in a drawing, such as a style, a view or a dictionary."""
    classes = import_module("ezdxf.entities.factory").ENTITY_CLASSES
    return kind in classes and not issubclass(classes[kind], import_module("ezdxf.entities").DXFGraphic)


def _refuse_wide(features: list[MapFeature]) -> None:
    """Refuse a drawing without a unit that is too wide for metres."""
    across = max((max(column) - min(column) for column in zip(*points_in(features), strict=True)), default=0.0)
    if across > ACROSS_MAX:
        rule = "must state its unit: without one it is read in metres, and the drawing is {across} across"
        advice = "set $INSUNITS, 4 for millimetres, or scale it to metres"
        raise InvalidValue("file", f"{rule}: {advice}", across=Quantity(across, "", 6))


def _record_of(document: Any) -> Mapping[str, Any]:
    """Content of this program's record in a drawing; empty without one."""
    try:
        record = document.rootdict.get(RECORD)
        content = orjson.loads("".join(tag.value for tag in record.tags if tag.code == 1))
    except (AttributeError, orjson.JSONDecodeError, TypeError):
        return {}
    return content if isinstance(content, dict) else {}


def written(drawing: Drawing) -> bytes:
    """A drawing in metres: areas as closed polylines, the path and walls as polylines, trees and marks as circles, and
    gates as points, each with its text.

    raises: MissingPackage
    """
    document = new_dxf((f"{name}{holes}", colour) for name, colour in LAYERS.values() for holes in ("", HOLES))
    space, names, radii, gates = document.modelspace(), {}, {}, {}
    content: dict[str, object] = {}
    for feature in drawing.features:
        layer = LAYERS[feature.role or "obstacle"][0]
        for k, ring in enumerate(feature.rings):
            entity = _drawn(space, feature, ring, f"{layer}{HOLES}" if k else layer)
            if feature.name is not None and not k:
                names[entity.dxf.handle] = feature.name
            if feature.shape == "line" and feature.radius is not None:
                radii[entity.dxf.handle] = float(feature.radius)
            if own := gate_properties(feature.properties):
                gates[entity.dxf.handle] = own
        if feature.role in ("obstacle", "mark", GATE) and feature.name:
            point = inner_point(feature.rings) if feature.shape == "polygon" else feature.rings[0][0]
            x, y = point if feature.role != "mark" else (point[0] + CROSS, point[1] + CROSS)
            space.add_text(feature.name, dxfattribs={"layer": layer, "height": WORDS, "insert": (x, y)})
        if feature.role == "path":
            content.setdefault("path", feature.properties["path"])  # the first one, which is read again
    content |= place_fields(drawing.origin, drawing.grid)
    text = orjson.dumps(content | {"names": names, "radii": radii, "gates": gates}).decode()
    # The format is text in lines of limited length, and a character outside ASCII takes several places.
    text = text.encode("ascii", "backslashreplace").decode().replace("\\x", "\\u00")
    record = document.rootdict.add_xrecord(RECORD)
    record.reset([(1, text[k : k + CHUNK]) for k in range(0, len(text), CHUNK)])
    return dxf_bytes(document)


def _drawn(space: Any, feature: MapFeature, ring: Ring, layer: str) -> Any:
    attributes: dict[str, object] = {"layer": layer}
    if feature.role == GATE:
        return space.add_point(ring[0], dxfattribs=attributes)
    if feature.shape == "point":
        return space.add_circle(ring[0], feature.radius or 0.5 * CROSS, dxfattribs=attributes)
    closed = feature.shape == "polygon"
    if feature.radius is not None:
        attributes["const_width"] = 2.0 * feature.radius
    return space.add_lwpolyline(ring[:-1] if closed else ring, close=closed, dxfattribs=attributes)
