"""What can be seen in a drawing: entities on visible layers, those of blocks at each place, as features in metres."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib import import_module
from math import dist, radians
from typing import Any

from app.maps.choice import EVERYTHING, Choice
from app.maps.curves import Damaged, points_of
from app.maps.dance_parts import refuse_many_edges
from app.maps.features import (
    LEAVE_OUT,
    OBSTACLE,
    PATH,
    FeatureCollector,
    MapFeature,
    damaged_kind,
    drawn_as,
    edges_of,
    holds,
    points_in,
    role_of,
    round_area,
)
from app.maps.joined import joined
from app.maps.labels import MapText, are_too_many, label_of, names_of
from app.wire.geojson import LANE, SQUARE, gate_properties
from app.wire.parts import APART
from core import InvalidValue
from core.language import phrase
from core.quantities import Clause
from core.values import Point

# Deepest nesting of blocks, and most entities of a drawing, without and with those that are not read; those of a block
# count each time it is used.
DEPTH_MAX, ENTITIES_MAX, SEEN_MAX = 4, 20_000, 100_000
CURVES = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "ELLIPSE", "SPLINE")
TEXTS = ("TEXT", "MTEXT", "ATTRIB")
# Layer of marks, whose crosses are not things; and the layer whose entities take that of their block.
MARKS, OF_BLOCK = "MARKS", "0"
# Ending of the layer of the holes in what stands on a layer.
HOLES = "_HOLES"
# Meshes and surfaces that DXF stores as polylines, by the name under which they are left out.
MESHES = (("is_polygon_mesh", "POLYMESH"), ("is_poly_face_mesh", "POLYFACE"))
# What an entity must state, because ezdxf would put a number in its place.
STATED = {"CIRCLE": ("center", "radius"), "LINE": ("start", "end"), "POINT": ("location",)}
# Flags of a block that stands in another file.
EXTERNAL = 4 | 8
# Points nearer to one another are one [m].
SAME = 1e-9
# The middle column and line of the nine places of an MTEXT, from 1 at the upper left.
COLUMNS = 3


def faults() -> tuple[type[Exception], ...]:
    """Errors that ezdxf raises for a faulty drawing or entity."""
    own = import_module("ezdxf.lldxf.const").DXFError
    return (
        *(own, OSError, ValueError, ArithmeticError, LookupError, AttributeError, TypeError),
        *(AssertionError, RuntimeError),
    )


@dataclass(frozen=True)
class OneOfBlock:
    """A block reference as ezdxf reads it, but to one entity of its block."""

    entity: Any
    matrix: Any

    def dxftype(self) -> str:
        return "INSERT"

    def matrix44(self) -> Any:
        return self.matrix

    def block(self) -> list[Any]:
        return [self.entity]


class Entities:
    """Collects the features of a drawing, in metres."""

    def __init__(self, document: Any, factor: float, record: Mapping[str, Any], choice: Choice = EVERYTHING) -> None:
        """factor: metres in a unit; record: of this program; by handle names, radii of walls [m], and what is known of
            gates, of which older files have the headings alone [rad]

        choice: what is read; seen_layers: names of those on which something stands that can be seen
        """
        self.factor, self.names = factor, _mapping(record.get("names"))
        self.radii, older = _numbers(record.get("radii")), _numbers(record.get("headings"))
        self.gates = {handle: {"heading": one} for handle, one in older.items()} | dict(_mapping(record.get("gates")))
        self.collector, self.labels = FeatureCollector(is_limited=not choice.counts), list[MapText]()
        self.layers, self.choice = document.layers, choice
        self.most = ENTITIES_MAX if choice.is_all else SEEN_MAX
        self.seen, self.seen_layers = 0, dict[str, None]()
        for entity, layer in self._visible(document.modelspace()):
            if choice.has_layer(layer):
                with self._left_out_if_damaged(entity.dxftype()):
                    self._take(entity, layer)
            else:
                self.seen_layers[layer] = None

    @contextmanager
    def _left_out_if_damaged(self, kind: str) -> Iterator[None]:
        """Context of what ezdxf may not be able to read, which then is left out."""
        try:
            yield
        except InvalidValue:
            raise
        except faults():
            self.collector.leave_out(damaged_kind(kind))

    def _visible(self, some: Any, depth: int = 0, around: str = OF_BLOCK) -> Iterator[tuple[Any, str]]:
        """Every entity that can be seen, with its layer; those of a block wherever the block is inserted."""
        for entity in some:
            self._count(1)
            own = str(entity.dxf.get("layer", OF_BLOCK))
            layer = around if own == OF_BLOCK else own
            is_off, is_frozen = self._state(layer)
            # A block on a frozen layer is hidden with all that is in it; on one that is off, only what takes its layer.
            if entity.dxf.get("invisible", 0) or is_frozen:
                self.collector.hide(entity.dxftype())
            elif entity.dxftype() == "INSERT" and depth < DEPTH_MAX:
                yield from self._of_block(entity, depth, layer)
            elif is_off:
                self.collector.hide(entity.dxftype())
            else:
                yield entity, layer

    def _of_block(self, insert: Any, depth: int, layer: str) -> Iterator[tuple[Any, str]]:
        def skipped(entity: Any, reason: str) -> None:
            self.collector.leave_out(entity.dxftype())

        block = insert.block()
        if block is None or block.block.dxf.flags & EXTERNAL:
            self.collector.leave_out(phrase("missing block") if block is None else phrase("block of another drawing"))
            return
        if not (insert.dxf.get("xscale", 1.0) and insert.dxf.get("yscale", 1.0)):
            self.collector.leave_out(damaged_kind("INSERT"))
            return
        if not insert.dxf.get("zscale", 1.0):  # a drawing of a plan; ezdxf divides by it
            insert.dxf.zscale = 1.0
        copies = max(1, int(insert.mcount))
        if copies > 1:
            self._count(copies)
        virtual_entities = import_module("ezdxf.explode").virtual_block_reference_entities
        for one in self._readable("INSERT", insert.multi_insert()) if copies > 1 else (insert,):
            matrix = one.matrix44()
            for entity in block:
                inside = virtual_entities(OneOfBlock(entity, matrix), skipped_entity_callback=skipped)
                yield from self._visible(self._readable(entity.dxftype(), inside), depth + 1, layer)
        yield from self._visible(insert.attribs, DEPTH_MAX, layer)

    def _readable(self, kind: str, some: Iterator[Any]) -> Iterator[Any]:
        """Entities, up to one that cannot be read, which is left out by the kind of what they are in."""
        while True:
            one = None
            with self._left_out_if_damaged(kind):
                one = next(some, None)
            if one is None:
                return
            yield one

    def _count(self, more: int) -> None:
        self.seen += more
        if self.seen > self.most:
            rule = f"must draw at most {{most}} entities, counting a block at each use: {LEAVE_OUT}"
            raise InvalidValue("file", rule, got="more", most=self.most)

    def _state(self, layer: str) -> tuple[bool, bool]:
        """Whether a layer is off, and whether it is frozen."""
        if not self.layers.has_entry(layer):
            return False, False
        entry = self.layers.get(layer)
        return bool(entry.is_off()), bool(entry.is_frozen())

    def _take(self, entity: Any, layer: str) -> None:
        kind, handle = entity.dxftype(), str(entity.dxf.get("handle"))
        name, radius = self.names.get(handle), self.radii.get(handle)
        own: dict[str, object] = {"layer": layer, **gate_properties(_mapping(self.gates.get(handle)))}
        feature = MapFeature("point", (), name, role_of(layer, name), radius, own)
        if not all(map(entity.dxf.hasattr, STATED.get(kind, ()))):
            self.collector.leave_out(damaged_kind(kind))
        elif kind in TEXTS:
            self._read_text(entity, kind)
        elif kind == "POINT":
            self._add(replace(feature, rings=((self._place(entity.dxf.location),),)))
        elif kind == "CIRCLE":
            centre = self._place(entity.ocs().to_wcs(entity.dxf.center))
            # A circle of radius 0 has a radius, too small for anything.
            radius = max(float(entity.dxf.radius) * self.factor, SAME)
            circle = replace(feature, rings=((centre,),), radius=radius)
            self._add(round_area(circle) if circle.role == SQUARE else circle)
        elif mesh := next((word for test, word in MESHES if getattr(entity, test, False)), None):
            self.collector.leave_out(mesh)
        elif kind in CURVES:
            self._add_curve(entity, feature)
        elif layer != MARKS:
            self.collector.leave_out(kind)

    def _read_text(self, entity: Any, kind: str) -> None:
        if kind == "MTEXT":
            words, height, at = entity.plain_text(), float(entity.dxf.char_height), entity.dxf.insert
            align = 0.5 * ((int(entity.dxf.attachment_point) - 1) % COLUMNS)
            turned = radians(float(entity.get_rotation()))
        else:
            words, height, turned = str(entity.dxf.text), float(entity.dxf.height), radians(float(entity.dxf.rotation))
            is_left = entity.dxf.halign == 0 and entity.dxf.valign == 0
            at = entity.dxf.insert if is_left else entity.dxf.get("align_point", entity.dxf.insert)
            at, align = entity.ocs().to_wcs(at), {1: 0.5, 2: 1.0, 4: 0.5}.get(int(entity.dxf.halign), 0.0)
        if words.strip() and self.choice.reaches([self._place(at)]):
            self.labels.append(label_of(words.strip(), self._place(at), abs(height) * self.factor, turned, align))

    def _add_curve(self, entity: Any, feature: MapFeature) -> None:
        try:
            places = [(x, y) for x, y in points_of(entity, self.factor).tolist()]
        except Damaged as error:
            self.collector.leave_out(error.args[0] if error.args else damaged_kind(entity.dxftype()))
            return
        points = tuple(b for a, b in zip((None, *places), places, strict=False) if a is None or dist(a, b) > SAME)
        if len(points) < 2:
            self.collector.leave_out(Clause("one-point {kind}", kind=entity.dxftype()))
            return
        closed = bool(getattr(entity, "closed", False) or getattr(entity, "is_closed", False))
        if closed and points[0] != points[-1]:
            points = (*points, points[0])
        # A closing point that a program adds may differ from the first one in the last digits.
        if len(points) > 3 and dist(points[0], points[-1]) < APART:
            points = (*points[:-1], points[0])
        width = 0.0 if feature.radius or feature.role == PATH else _width(entity) * self.factor
        self._add_line(replace(feature, rings=(points,)), 0.5 * width)

    def _add_line(self, line: MapFeature, half: float) -> None:
        """Add a line; one with a width reaches to both sides of it, also where it is the outline of an area."""
        drawn = drawn_as(line)
        if half == 0.0:
            self._add(drawn)
        elif drawn.shape == "polygon":
            self._add(drawn)
            if drawn.role == LANE:
                return
            edge = f"edge of {drawn.name}" if drawn.name else None
            self._add(replace(line, shape="line", name=edge, role=OBSTACLE, radius=half))
        else:
            self._add(replace(line, shape="line", radius=half))

    def _add(self, feature: MapFeature) -> None:
        self.seen_layers[_layer_of(feature)] = None
        if self.choice.counts or self.choice.reaches(points_in([feature])):
            self.collector.add(feature)

    def edges(self) -> dict[str, int]:
        """Edges in a venue of what each layer holds."""
        counts = dict.fromkeys(self.seen_layers, 0)
        for one in joined(self.collector.features):
            counts[_layer_of(one)] += edges_of(replace(one, role=one.role or role_of(one.name)))
        return counts

    def _place(self, point: Any) -> Point:
        return float(point[0]) * self.factor, float(point[1]) * self.factor

    def features(self) -> Iterator[MapFeature]:
        """The features, with holes in their polygons; each thing is named by the text in it or beside it."""
        # Before any of them is compared with the others.
        refuse_many_edges(self.collector.features, of_areas=True)
        features = list(_with_holes(joined(self.collector.features)))
        if are_too_many(features, self.labels):
            self.collector.left_out[phrase("text")] = len(self.labels)
            self.labels = []
        words = names_of(features, self.labels)
        for k, feature in enumerate(features):
            name, layer = feature.name or words.get(k), _layer_of(feature)
            own = layer if layer not in ("", OF_BLOCK) and role_of(layer) is None else None
            kept = {word: value for word, value in feature.properties.items() if word != "layer"}
            yield replace(feature, name=name or own, role=feature.role or role_of(name), properties=kept)


def _mapping(value: object) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _numbers(value: object) -> dict[str, float]:
    return {handle: one for handle, one in _mapping(value).items() if isinstance(one, float)}


def _width(entity: Any) -> float:
    """Largest width of a polyline; 0 without one."""
    if entity.dxftype() == "LWPOLYLINE":
        widths = [float(one) for pair in entity.get_points("se") for one in pair]
        widths.append(float(entity.dxf.get("const_width", 0.0)))
        return max(map(abs, widths))
    if entity.dxftype() != "POLYLINE":
        return 0.0
    names = ("start_width", "end_width")
    widths = [float(one.dxf.get(name, 0.0)) for one in entity.vertices for name in names]
    widths += [float(entity.dxf.get(f"default_{name}", 0.0)) for name in names]
    return max(map(abs, widths))


def _with_holes(features: list[MapFeature]) -> Iterator[MapFeature]:
    """The features; a ring on a layer of holes becomes a hole of the polygon of that layer around it, if any."""
    polygons = [one for one in features if one.shape == "polygon"]
    own: dict[int, list[MapFeature]] = {}
    for hole in polygons:
        layer = _layer_of(hole)
        if layer.endswith(HOLES):
            outer = (one for one in polygons if _layer_of(one) == layer.removesuffix(HOLES))
            around = next((one for one in outer if holds(one.rings, hole.rings[0][0])), None)
            if around is not None:
                own.setdefault(id(around), []).append(hole)
    inside = {id(hole) for holes in own.values() for hole in holes}
    for feature in features:
        if id(feature) not in inside:
            yield replace(feature, rings=(*feature.rings, *(one.rings[0] for one in own.get(id(feature), ()))))


def _layer_of(feature: MapFeature) -> str:
    return str(feature.properties.get("layer", ""))
