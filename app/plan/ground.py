"""The map of a plan: square, obstacles, path, swept ground, zone to keep clear, marks, benches at an instant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from app.files.looks import ink_on, square_alone, with_square
from app.files.typeset import POINT, Face
from app.maps.features import inner_point
from app.maps.marks import line_of
from app.plan.drawing import HATCHED, MapDrawing, Scale, look, scale_of, svg_of
from app.plan.paper import Box, PaperName, TextRoom
from app.plan.timing import Timing
from core import Budget, Dance, Venue
from core.language import phrase, say
from core.plots import BLUE, VERMILION
from core.shapes.engines import Polygons, merged, widest_place
from core.values import Floats, Point

EDGE, GREY = "#B8860B", "#888888"
# Looks of the ground that benches sweep, of the zone to keep clear, of the head and the other benches, and of stone.
IN_SWEPT = look("#FFE3B3", EDGE, 0.3)
IN_CLEAR = look("#FFF6E5", EDGE, 0.5, (4, 2))
IN_HEAD, IN_BENCH = look(VERMILION, width=0.3), look("#9CC7E5", width=0.3)
IN_STONE = look(HATCHED, width=0.7)
# Looks of a lane to keep free, and of the ground that a loose tail can reach.
IN_LANE, IN_LOOSE = look("#CFE3F1", BLUE, 0.4), look(edge=VERMILION, width=0.8, dash=(1, 2))
# Radius of the dot at a place of a nearest approach, and distance of its number [mm].
DOT, BESIDE = 0.6, 2.6
# White gaps in outlines that go on beyond the sheet, near its edge, and above what they are.
BROKEN, CUT = (2, 2), 8
IN_CUT = look(edge="white", width=1.3, dash=BROKEN) + ' clip-path="url(#edge)"'
# Distance of two points of an outline [mm].
SEEN = 0.12
# Half the length of a mark, distance of its number from the path, and spacing of the arrows along the path [mm].
TICK, BESIDE, ARROWS = 1.1, 2.6, 45.0
# Share of that spacing within which laps on one another have one arrow [1].
ALONE = 0.25
# Spacing of points on the path before a mark [m], largest distance of a lap from one under it [m], and least cosine of
# the angle between both.
LAP_STEP, ON_LAP, PARALLEL = 0.5, 0.05, 0.99
# Smallest readable type on a bench [pt].
SMALLEST = 3.4
# Distance of the name of a dragon from its path [mm], and shares of the path, in order, at which the name may stand.
NAME_AWAY, NAME_PLACES = 3.5, (0.04, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.97)
# Least distance of a name from its bench [mm].
BESIDE_BENCH = 0.62
# Type of numbers at marks, of names and of benches [pt].
MARK_TYPE, NAME_TYPE, BENCH_TYPE = 5.5, 7.0, 5.0
# Numbers that are multiples of this are placed first, because not all of them may have room.
ROUND = 4
# A swatch of the legend [mm], and an area, a line and a line with a mark in it [parts of a millimetre].
SWATCH = (0.0, 0.0, 8.3, 2.6)
AREA, LINE, MARK = "M30-20H800V-240H30z", "M30-130H800", "M30-130H800M400-20V-240"
# A circle of radius 1; every sixth point of it is a corner of a square.
CIRCLE = np.stack([np.cos(turns := np.pi * (np.arange(24) / 12.0 + 0.25)), np.sin(turns)], axis=1)


@dataclass(frozen=True)
class GroundMap:
    """The content of a map.

    swept: the ground that benches sweep; clear: the zone to keep clear around it; width: of that zone [m]
    gates: name, x and y [m] of each; colour: of the path, and of the benches among those of other dragons
    """

    dance: Dance
    venue: Venue | None
    swept: Polygons
    clear: Polygons
    width: float
    timing: Timing
    geographic: bool
    gates: Sequence[tuple[str, float, float]] = ()
    colour: str = BLUE

    @cached_property
    def first_time(self) -> NDArray[np.bool_]:
        """Which marks (M,) lie where the path has not been before: of laps on one another those of the first."""
        path, marks = self.dance.path, self.timing.marks
        s = np.arange(marks.s[0], marks.s[-1], LAP_STEP)
        points, tangents, own = path.position(s), path.tangent(s), path.tangent(marks.s)
        first = np.ones(len(marks.s), dtype=bool)
        for k, (place, point) in enumerate(zip(marks.s, marks.points, strict=True)):
            past = slice(0, int(np.searchsorted(s, place - marks.spacing)))
            (dx, dy), (x, y) = (point - points[past]).T, tangents[past].T
            on_lap = (np.hypot(dx, dy) < LAP_STEP) & (np.abs(x * dy - y * dx) < ON_LAP)
            first[k] = not (on_lap & (np.abs(tangents[past] @ own[k]) > PARALLEL)).any()
        return first

    @cached_property
    def line(self) -> Floats:
        """Points of the path (N, 2) [m]."""
        path, marks = self.dance.path, self.timing.marks
        return line_of(path, *path.drawn_between(float(marks.s[0]), float(marks.s[-1]) + marks.spacing))


def scale_for(grounds: Sequence[GroundMap], name: PaperName, benches: Floats | None = None) -> Scale:
    """The scale at which the ground of one dragon or of several fits on the paper, with each street of the square cut
    beyond the benches in it.

    benches: their corners (..., 2) [m]
    raises: InvalidValue
    """
    rings = np.concatenate([rings[0] for ground in grounds for rings in ground.clear])
    venue, low, high = grounds[0].venue, rings.min(axis=0), rings.max(axis=0)
    least, most = with_square(venue, low, high)
    if venue is not None:
        # The sides of the map at which the dance leaves the square by a street.
        inner, ring = square_alone(venue), np.array(venue.square.rings[0])
        cut = (
            np.where(ring.min(axis=0) < inner[0], np.maximum(least, inner[0]), least),
            np.where(ring.max(axis=0) > inner[1], np.minimum(most, inner[1]), most),
        )
        places = np.reshape(cut if benches is None else benches, (-1, 2))
        least = np.maximum(least, np.minimum(cut[0], places.min(axis=0)))
        most = np.minimum(most, np.maximum(cut[1], places.max(axis=0)))
    return scale_of(name, least, most)


def draw_ground(ground: GroundMap, scale: Scale, face: Face, budget: Budget, *, numbers: bool) -> MapDrawing:
    """The map of a dragon. numbers: of the marks"""
    drawing = _draw_areas([ground], scale, face, budget)
    line = scale.on_paper(ground.line)
    drawing.line(line, 4, 0.9 if numbers else 0.4, BLUE)
    if numbers:
        draw_arrows(drawing, line)
        _draw_gates(drawing, ground)
        _draw_marks(drawing, ground, line)
    return drawing


def draw_grounds(
    grounds: Sequence[GroundMap], names: Sequence[str], scale: Scale, face: Face, budget: Budget
) -> MapDrawing:
    """One map of several dragons. names: of the dragons, beside their paths"""
    drawing = _draw_areas(grounds, scale, face, budget)
    _draw_paths(drawing, grounds, names)
    return drawing


def _draw_paths(drawing: MapDrawing, grounds: Sequence[GroundMap], names: Sequence[str]) -> None:
    """Draw the path of each dragon, in its colour, and gates. names: of the dragons; none for a single one"""
    lines = [drawing.scale.on_paper(ground.line) for ground in grounds]
    for ground, line in zip(grounds, lines, strict=True):
        drawing.line(line, 4.5, 0.9, ground.colour)
        draw_arrows(drawing, line, ground.colour)
    _draw_gates(drawing, grounds[0])
    for ground, line, name in zip(grounds, lines, names, strict=False):
        places = _beside(line, 0.5 * drawing.width(name, NAME_TYPE, bold=True))
        if not drawing.label(name, NAME_TYPE, places, bold=True, colour=ground.colour, on_paper=True):
            drawing.write(name, *places[0], NAME_TYPE, bold=True, colour=ground.colour, on_paper=True)


def _beside(line: Floats, half: float) -> list[Point]:
    """Places on both sides of a path for a word of that half width, at several shares of it [mm]."""
    places = []
    for k in (max(1, int(share * (len(line) - 1))) for share in NAME_PLACES):
        along = line[k] - line[k - 1]
        normal = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-9)
        away = NAME_AWAY + half * abs(float(normal[0]))
        places += [line[k] + side * away * normal for side in (1.0, -1.0)]
    return [(x, y) for x, y in np.array(places).tolist()]


def _draw_areas(grounds: Sequence[GroundMap], scale: Scale, face: Face, budget: Budget) -> MapDrawing:
    """A map with coordinates, swept ground, the zone to keep clear and the venue."""
    drawing = MapDrawing(scale, face, budget)
    _draw_coordinates(drawing)
    right, top = drawing.room[2:]
    drawing.places.take(np.array([right - 10.0, top - 17.0, right - 4.0, top]))  # An arrow stands there.
    for height, (name, attributes) in enumerate((("clear", IN_CLEAR), ("swept", IN_SWEPT)), start=1):
        for rings in merged(getattr(ground, name) for ground in grounds):
            drawing.shape([thinned(scale.on_paper(ring)) for ring in rings], attributes, height)
    draw_venue(drawing, grounds[0].venue)
    return drawing


def thinned(line: Floats, apart: float = SEEN) -> Floats:
    """A line, or a closed ring, without points that are too close together to be seen on paper. apart: [mm]"""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    _, kept = np.unique((along / apart).astype(int), return_index=True)
    return np.concatenate([line[kept], line[-1:]]) if kept.size > ROUND else line


def _draw_coordinates(drawing: MapDrawing) -> None:
    """Name x and y [m] along the frame, one for each length of the scale bar."""
    scale, (left, bottom, right, top) = drawing.scale, drawing.room
    step = scale.bar
    for axis, (near, far) in enumerate(((left, right), (bottom, top))):
        middle, count = round(scale.middle[axis] / step), int((far - near) * scale.ratio / 2000.0 / step) + 1
        for value in (step * k for k in range(middle - count, middle + count + 1)):
            place = float(scale.on_paper(np.full(2, value))[axis])
            if near + 8.0 < place < far - 8.0:
                drawing.ticks.append((axis, place - near, f"{value + 0.0:g}"))
                box = (
                    (left, place - 1.5, left + 9.0, place + 1.5)
                    if axis
                    else (place - 4.0, bottom, place + 4.0, bottom + 4.5)
                )
                drawing.places.take(np.array(box))


def draw_venue(drawing: MapDrawing, venue: Venue | None, *, small: bool = False, off: TextRoom | None = None) -> None:
    """Draw the square and its obstacles, with their names where there is room.

    small: True for thin lines, whole up to the edge of the map, and a square without its name
    off: what names keep off besides
    """
    if venue is None:
        return
    square, scale = venue.square, drawing.scale
    for area in venue.areas:
        rings = [scale.on_paper(np.array(ring)) for ring in area.rings]
        if not small:
            _draw_cut(drawing, rings)
        if area is square:
            drawing.shape(rings, look(edge=GREY, width=0.5) if small else look(width=1.2), 5)
            continue
        drawing.shape(rings, look("#D9D9D9", GREY, 0.5) if small else IN_STONE, 3)
        x, y = scale.on_paper(np.array(inner_point(area.rings))).tolist()
        (left, low), (right, high) = rings[0].min(axis=0).tolist(), rings[0].max(axis=0).tolist()
        beside = 0.5 * drawing.width(area.name, NAME_TYPE) + 1.0
        wide = 2.0 * beside < right - left and high - low > 4.0
        around = [(right + beside, y), (left - beside, y), (x, high + 2.0), (x, low - 2.0)]
        drawing.label(area.name, NAME_TYPE, [(x, y), *around] if wide else around, off, on_paper=wide)
        drawing.places.take(np.array([left, low, right, high]))
    if small:
        return
    middle = scale.on_paper(np.array(widest_place(square.rings)[:2]))
    beside = 0.5 * drawing.width(square.name, NAME_TYPE) + 1.5
    drawing.label(square.name, NAME_TYPE, _inside(scale.on_paper(np.array(square.rings[0])), middle, beside))


def _draw_cut(drawing: MapDrawing, rings: Sequence[Floats]) -> None:
    """Break outlines on paper where they go on beyond the sheet."""
    if len(cut := np.concatenate([_leaving(ring, drawing.room) for ring in rings])):
        drawing.shape(cut, IN_CUT, CUT, "")


def _leaving(ring: Floats, room: Box) -> Floats:
    """The sides of a ring (N, 2, 2) of which an end is outside the room."""
    outside = np.any((ring < room[:2]) | (ring > room[2:]), axis=1)
    sides: Floats = np.stack([ring[:-1], ring[1:]], axis=1)[outside[:-1] | outside[1:]]
    return sides


def _inside(ring: Floats, middle: Floats, beside: float) -> list[Point]:
    """Places for a word of that half width inside a closed ring: at the middle of each side.

    Sides as long as the word come first, and of them those nearest to the middle, which is not in a street.
    """
    along = np.diff(ring, axis=0)
    area = float((ring[:-1, 0] * ring[1:, 1] - ring[1:, 0] * ring[:-1, 1]).sum())
    inwards = np.sign(area) * np.stack([-along[:, 1], along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
    places = ring[:-1] + 0.5 * along + inwards * (beside * np.abs(inwards[:, :1]) + 2.5 * np.abs(inwards[:, 1:]))
    order = np.lexsort((np.hypot(*(places - middle).T), np.hypot(*along.T) < 2.0 * beside))
    middles: list[Point] = [tuple(places[k].tolist()) for k in order]
    return middles


def draw_arrows(drawing: MapDrawing, line: Floats, colour: str = BLUE, apart: float = ARROWS) -> None:
    """Draw arrows along a path, in the direction of the dance. apart: their distance [mm]"""
    steps, middles = np.hypot(*np.diff(line, axis=0).T), np.full((1, 2), np.inf)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    for place in np.arange(0.5 * apart, along[-1], apart):
        k = int(np.searchsorted(along, place))
        if np.hypot(*(middles - line[k]).T).min() < ALONE * apart:
            continue
        middles = np.vstack([middles, line[k]])
        tangent = (line[k] - line[k - 1]) / max(steps[k - 1], 1e-9)
        side, back = 0.9 * np.array([-tangent[1], tangent[0]]), line[k] - 1.0 * tangent
        drawing.shape([np.array([line[k] + 1.6 * tangent, back + side, back - side])], look(colour), 6)


def _draw_marks(drawing: MapDrawing, ground: GroundMap, line: Floats) -> None:
    """Draw marks with their numbers beside the path, or on it where another part of the path is beside it; of laps that
    lie on one another those of the first."""
    marks, path, scale = ground.timing.marks, ground.dance.path, drawing.scale
    first = ground.first_time
    names = [name for name, is_first in zip(marks.names, first, strict=True) if is_first]
    points, tangents = scale.on_paper(marks.points[first]), path.tangent(marks.s[first])
    normals = np.stack([-tangents[:, 1], tangents[:, 0]], axis=-1)
    ticks = np.stack([points - TICK * normals, points + TICK * normals])
    for tick in ticks.swapaxes(0, 1):
        drawing.line(tick, 6, 0.6)
    begin = scale.on_paper(path.position(ground.timing.start_place + marks.first))
    drawing.shape([begin + 0.8 * CIRCLE], look("white", VERMILION, 1.0), 7)
    words = say("head at the start")
    beside = 0.5 * drawing.width(words, 6.0) + 2.0
    near = [(begin[0] + side * beside, begin[1] + up) for up in (4.0, -4.0) for side in (1.0, -1.0)]
    drawing.label(words, 6.0, near, colour=VERMILION, on_paper=True)
    drawing.places.take(np.concatenate([ticks.min(axis=0), ticks.max(axis=0)], axis=1))
    on_path = TextRoom()
    on_path.take(np.concatenate([line, line], axis=1))
    for k in sorted(range(len(points)), key=lambda k: (k % ROUND != 0, k)):
        near_by = [points[k] + side * BESIDE * normals[k] for side in (1.0, -1.0, 1.5, -1.5)]
        wide = 0.5 * drawing.width(names[k], MARK_TYPE)
        free = [(x, y) for x, y in near_by if on_path.is_free((x - wide, y - 1.0, x + wide, y + 1.0))]
        along = [points[k] + side * (wide + 1.0) * tangents[k] for side in (1.0, -1.0)]
        drawing.label(names[k], MARK_TYPE, free or along, on_paper=True, order=k + 1)


def _draw_gates(drawing: MapDrawing, ground: GroundMap) -> None:
    """Draw each gate as a small square with its name beside it."""
    left, bottom, right, top = drawing.room
    for name, *place in ground.gates:
        x, y = drawing.scale.on_paper(np.array(place)).tolist()
        if not (left < x < right and bottom < y < top):
            continue
        drawing.shape([np.array([x, y]) + 1.0 * CIRCLE[::6]], look("white", width=1.0), 7)
        drawing.places.take(np.array([x - 1.0, y - 1.0, x + 1.0, y + 1.0]))
        beside = 0.5 * drawing.width(name, NAME_TYPE) + 2.0
        near = [(x + beside, y), (x - beside, y), (x, y + 3.0), (x, y - 3.0)]
        drawing.label(name, NAME_TYPE, near, on_paper=True)


def draw_benches(drawing: MapDrawing, outlines: Floats, names: Sequence[str], colour: str = "") -> None:
    """Draw every bench in its true size, with its name where there is room for it.

    outlines: corners (n, 4, 2) [m]; colour: of all benches, empty for those of the only dragon
    """
    own, ink = look(colour, width=0.3) if colour else "", ink_on(colour) if colour else "#000000"
    corners = drawing.scale.on_paper(outlines)
    for k, bench in enumerate(corners):
        drawing.shape([bench], own or (IN_BENCH if k else IN_HEAD), 5)
    middles = corners.mean(axis=1)
    across = corners[:, 0] - corners[:, 1]
    wide = np.hypot(*across.T)
    normals = across / wide[:, None]
    # Text must not cover a bench, which is taken as eight boxes along its length.
    shares = ((np.arange(8) + 0.5) / 8.0)[None, :, None]
    spots = (shares * corners[:, 0:1] + (1.0 - shares) * corners[:, 3:4] - 0.5 * across[:, None]).reshape(-1, 2)
    drawing.places.take(np.concatenate([spots - 0.4, spots + 0.4], axis=1))
    drawing.width("".join(names), BENCH_TYPE)  # All characters are measured at once.
    # The names of the head, the tail and every tenth bench are placed first, because there may not be room for all.
    last = len(names) - 1
    for k in sorted(range(len(names)), key=lambda k: (k not in (0, last), k % 10 != 0, k % 5 != 0, k)):
        size = min(NAME_TYPE, 0.8 * float(wide[k]) / POINT)
        long = np.hypot(*(corners[k, 0] - corners[k, 3]))
        if size >= SMALLEST and drawing.width(names[k], size) < 0.9 * long:
            turned = float(np.degrees(np.arctan2(normals[k, 1], normals[k, 0]))) % 180.0 - 90.0
            x, y = middles[k].tolist()
            drawing.write(names[k], x, y, size, turned=-turned, order=k + 1, colour=ink)
            continue
        size = NAME_TYPE if k == 0 else BENCH_TYPE
        for words in (names[k], names[k].partition(" ")[0]):
            # Text is wider than it is high.
            across_text = size * POINT + abs(normals[k, 0]) * drawing.width(words, size)
            reach = 0.5 * (wide[k] + across_text) + BESIDE_BENCH
            if drawing.label(
                words, size, [middles[k] + side * reach * normals[k] for side in (1.0, -1.0)], order=k + 1
            ):
                break


@dataclass(frozen=True)
class SafetyLayers:
    """What a safety sheet shows besides a map's ground: the line behind which people stand is that around `clear`.

    loose: ground that the last benches can reach when they are let go; lanes: name and rings of each lane to keep free
    box: corners of what the map shows (2,) [m]; dragons: their names where there are several
    near: places of the nearest approaches in their order [m]
    """

    loose: Polygons
    lanes: Sequence[tuple[str, Sequence[Floats]]]
    box: tuple[Floats, Floats]
    dragons: Sequence[str] = ()
    near: Sequence[Sequence[float]] = ()


def draw_safety(
    grounds: Sequence[GroundMap], layers: SafetyLayers, scale: Scale, face: Face, budget: Budget
) -> MapDrawing:
    """The map of a safety sheet: ground swept and to keep clear, loose tails, lanes, paths and gates."""
    drawing = _draw_areas(grounds, scale, face, budget)
    for name, rings in layers.lanes:
        placed = [scale.on_paper(ring) for ring in rings]
        drawing.shape(placed, IN_LANE, 2.5)
        _draw_cut(drawing, placed)
        x, y = placed[0].mean(axis=0).tolist()
        drawing.label(name, NAME_TYPE, [(x, y), (x, y + 4.0), (x, y - 4.0)], on_paper=True)
    for rings in layers.loose:
        drawing.shape([thinned(scale.on_paper(ring)) for ring in rings], IN_LOOSE, 4)
    _draw_paths(drawing, grounds, layers.dragons)
    for number, point in enumerate(layers.near, start=1):
        x, y = scale.on_paper(np.array([point]))[0].tolist()
        drawing.shape([np.array([x, y]) + DOT * CIRCLE], look("black"), 6)
        beside = [(x + u, y + v) for v in (-BESIDE, BESIDE, 0.0) for u in (BESIDE, -BESIDE, 0.0) if u or v]
        if not drawing.label(str(number), NAME_TYPE, beside, on_paper=True, bold=True):
            drawing.write(str(number), *beside[0], NAME_TYPE, on_paper=True, bold=True)
    return drawing


def legend_of_safety(drawing: MapDrawing, ground: GroundMap, layers: SafetyLayers) -> list[tuple[str, str]]:
    """The meaning of colours and lines on the map of a safety sheet."""
    path = say("path of each dragon, in its own colour") if layers.dragons else say("path of the handles")
    rows = [
        (AREA, IN_SWEPT, say("ground swept by benches")),
        (AREA, IN_CLEAR, say("people stay out, {ground.width:g} m", ground=ground)),
        (AREA, IN_LOOSE, say("reach of the last benches, let go")),
        (LINE, look(edge=BLUE, width=0.9), path),
    ]
    if layers.lanes:
        rows.append((AREA, IN_LANE, say("lane to keep free")))
    return _swatches([*rows, *_of_venue(drawing, ground)])


def _of_venue(drawing: MapDrawing, ground: GroundMap) -> list[tuple[str, str, str]]:
    """The rows of a legend about the venue."""
    obstacle = AREA, IN_STONE, say("obstacle")
    rows = [obstacle] if ground.venue and ground.venue.obstacles else []
    if any(height == CUT for height, _ in drawing.shapes):
        rows.append((LINE, look(width=1.2, dash=BROKEN), say("goes on beyond the sheet")))
    return rows


def legend_of(drawing: MapDrawing, ground: GroundMap, benches: bool, several: bool) -> list[tuple[str, str]]:
    """The meaning of colours and lines: a picture of each, and its words.

    benches: True if they are on the map; several: True for a map of several dragons
    """
    on_path = look(edge=BLUE, width=0.9)
    rows = [
        (AREA, IN_SWEPT, say("ground swept by benches")),
        (AREA, IN_CLEAR, say("keep clear, {ground.width:g} m", ground=ground)),
        (LINE, on_path, say("path of each dragon, in its own colour") if several else say("path of the handles")),
    ]
    if several and benches:
        rows.append((AREA, IN_BENCH, say("bench, in the colour of its dragon")))
    elif benches:
        rows += [(AREA, IN_BENCH, say("bench")), (AREA, IN_HEAD, say("head"))]
    elif not several:
        once = phrase("chalk mark every {spacing:g} m; of equal laps only the first has them")
        words = phrase("chalk mark every {spacing:g} m") if ground.first_time.all() else once
        rows.append((MARK, on_path, say(words, spacing=ground.timing.marks.spacing)))
    return _swatches([*rows, *_of_venue(drawing, ground)])


def _swatches(rows: Sequence[tuple[str, str, str]]) -> list[tuple[str, str]]:
    """A picture and words of each row of a legend: shape, look, words."""
    return [(svg_of(SWATCH, [f'<path d="{shape}" {one}/>']), words) for shape, one, words in rows]
