"""The map of a plan: square, obstacles, path, swept ground, zone to keep clear, marks, benches at an instant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from matplotlib.patches import Rectangle

from app.files.drawing import with_square
from app.files.performances import colour_of
from app.maps.features import inner_point
from app.maps.marks import line_of
from app.plan.sheet import POINT, Box, PaperName, Scale, Sheet, north_arrow, scale_of
from app.plan.timing import Timing
from core import Dance, Venue
from core.language import say
from core.plots import BLUE, VERMILION
from core.shapes.engines import Polygons, widest_place
from core.values import Floats

EDGE, STONE = "#B8860B", "#D9D9D9"
# Looks of the ground that benches sweep, of the zone to keep clear, of the head and of the other benches.
IN_SWEPT: dict[str, Any] = {"facecolor": "#FFE3B3", "edgecolor": EDGE, "linewidth": 0.3}
IN_CLEAR: dict[str, Any] = {"facecolor": "#FFF6E5", "edgecolor": EDGE, "linestyle": (0, (4, 2)), "linewidth": 0.5}
IN_HEAD: dict[str, Any] = {"facecolor": VERMILION, "edgecolor": "black", "linewidth": 0.3}
IN_BENCH = IN_HEAD | {"facecolor": "#9CC7E5"}
# Text turned about its middle.
CENTRED: dict[str, Any] = {"ha": "center", "va": "center_baseline", "rotation_mode": "anchor"}
# Distance of two points of an outline [mm].
SEEN = 0.12
# Half the length of a mark, distance of its number from the path, and spacing of the arrows along the path [mm].
TICK, BESIDE, ARROWS = 1.1, 2.6, 45.0
# Smallest readable type on a bench [pt].
SMALLEST = 3.4
# Distance of the name of a dragon from its path [mm], and shares of the path, in order, at which the name may stand.
NAME_AWAY, NAME_PLACES = 3.5, (0.04, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.97)
# Type of numbers at marks, of names, of benches, and of coordinates along the frame [pt].
MARK_TYPE, NAME_TYPE, BENCH_TYPE, COORDINATE_TYPE = 5.5, 7.0, 5.0, 5.0
# Numbers that are multiples of this are placed first, because not all of them may have room.
ROUND = 4


@dataclass(frozen=True)
class GroundMap:
    """The content of a map.

    swept: the ground that benches sweep; clear: the zone to keep clear around it; width: of that zone [m]
    gates: name, x and y [m] of each
    """

    dance: Dance
    venue: Venue | None
    swept: Polygons
    clear: Polygons
    width: float
    timing: Timing
    geographic: bool
    gates: Sequence[tuple[str, float, float]] = ()

    @cached_property
    def line(self) -> Floats:
        """Points of the path (N, 2) [m]."""
        path, marks = self.dance.path, self.timing.marks
        return line_of(path, *path.drawn_between(float(marks.s[0]), float(marks.s[-1]) + marks.spacing))


def scale_for(grounds: Sequence[GroundMap], name: PaperName) -> Scale:
    """The scale at which the whole ground of one dragon or of several fits on the paper. raises: InvalidValue"""
    rings = np.concatenate([rings[0] for ground in grounds for rings in ground.clear])
    low, high = rings.min(axis=0), rings.max(axis=0)
    return scale_of(name, *with_square(grounds[0].venue, low, high))


def draw_ground(sheet: Sheet, ground: GroundMap, scale: Scale, *, numbers: bool) -> Rectangle:
    """Draw the map on a sheet; returns its frame. numbers: of the marks, and the names of obstacles"""
    frame = _draw_areas(sheet, [ground], scale)
    line = scale.on_paper(ground.line)
    sheet.line(line, frame, color=BLUE, linewidth=0.9 if numbers else 0.4, zorder=4)
    if numbers:
        _draw_arrows(sheet, line, frame)
        _draw_gates(sheet, ground, scale)
        _draw_marks(sheet, ground, scale, line)
    return frame


def draw_grounds(sheet: Sheet, grounds: Sequence[GroundMap], names: Sequence[str], scale: Scale) -> Rectangle:
    """Draw one map of several dragons on a sheet; returns its frame. names: of the dragons, beside their paths"""
    frame = _draw_areas(sheet, grounds, scale)
    lines = [scale.on_paper(ground.line) for ground in grounds]
    for k, line in enumerate(lines):
        colour = colour_of(k)
        sheet.line(line, frame, color=colour, linewidth=0.9, zorder=4)
        _draw_arrows(sheet, line, frame, colour)
    _draw_gates(sheet, grounds[0], scale)
    for k, (line, name) in enumerate(zip(lines, names, strict=True)):
        places = _beside(line, 0.5 * sheet.width(name, NAME_TYPE, bold=True))
        look: dict[str, Any] = {
            "color": colour_of(k),
            "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.8},
        }
        if not sheet.label(name, NAME_TYPE, places, scale.paper.room, fontweight="bold", **look):
            sheet.words(*places[0], name, NAME_TYPE, ha="center", fontweight="bold", **look)
    return frame


def _beside(line: Floats, half: float) -> list[tuple[float, float]]:
    """Places on both sides of a path for a word of that half width, at several shares of it [mm]."""
    places = []
    for k in (max(1, int(share * (len(line) - 1))) for share in NAME_PLACES):
        along = line[k] - line[k - 1]
        normal = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-9)
        away = NAME_AWAY + half * abs(float(normal[0]))
        places += [line[k] + side * away * normal for side in (1.0, -1.0)]
    return [(x, y) for x, y in np.array(places).tolist()]


def _draw_areas(sheet: Sheet, grounds: Sequence[GroundMap], scale: Scale) -> Rectangle:
    """Draw frame, coordinates, swept ground, the zone to keep clear and the venue; returns the frame."""
    room = scale.paper.room
    frame = sheet.frame(room)
    _draw_coordinates(sheet, scale, room)
    north_arrow(sheet, room[2] - 7.0, room[3] - 16.0, grounds[0].geographic)
    for order, (name, look) in enumerate((("clear", IN_CLEAR), ("swept", IN_SWEPT)), start=1):
        for rings in [rings for ground in grounds for rings in getattr(ground, name)]:
            sheet.area([_drawn(scale.on_paper(ring)) for ring in rings], frame, zorder=order, **look)
    _draw_venue(sheet, grounds[0], scale, frame)
    return frame


def _drawn(ring: Floats) -> Floats:
    """A closed ring, without points that are too close together to be seen on paper."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(ring, axis=0).T))])
    _, kept = np.unique((along / SEEN).astype(int), return_index=True)
    return np.concatenate([ring[kept], ring[:1]]) if kept.size > ROUND else ring


def _draw_coordinates(sheet: Sheet, scale: Scale, room: Box) -> None:
    """Draw short lines with their x or y [m] along the frame, one for each length of the scale bar."""
    step, unit = scale.bar, 1000.0 / scale.ratio
    for axis, (near, far) in enumerate(((room[0], room[2]), (room[1], room[3]))):
        low, high = (scale.middle[axis] + (end - 0.5 * (near + far)) / unit for end in (near, far))
        for value in np.arange(np.ceil(low / step), np.floor(high / step) + 1.0) * step:
            place = 0.5 * (near + far) + (value - scale.middle[axis]) * unit
            if not near + 8.0 < place < far - 8.0:
                continue
            words = f"{value + 0.0:g}"
            if axis == 0:
                sheet.line([(place, room[1]), (place, room[1] + 1.5)], linewidth=0.4)
                sheet.words(place, room[1] + 2.2, words, COORDINATE_TYPE, ha="center", color="#555555")
                sheet.take(np.array([place - 4.0, room[1], place + 4.0, room[1] + 4.5]))
            else:
                sheet.line([(room[0], place), (room[0] + 1.5, place)], linewidth=0.4)
                sheet.words(room[0] + 2.2, place - 0.7, words, COORDINATE_TYPE, color="#555555")
                sheet.take(np.array([room[0], place - 1.5, room[0] + 9.0, place + 1.5]))


def _draw_venue(sheet: Sheet, ground: GroundMap, scale: Scale, frame: Rectangle) -> None:
    if ground.venue is None:
        return
    square = ground.venue.square
    for area in ground.venue.areas:
        rings = [scale.on_paper(np.array(ring)) for ring in area.rings]
        if area is square:
            sheet.area(rings, frame, facecolor="none", edgecolor="black", linewidth=1.2, zorder=5)
            continue
        sheet.area(rings, frame, facecolor=STONE, edgecolor="black", hatch="////", linewidth=0.7, zorder=3)
        x, y = scale.on_paper(np.array(inner_point(area.rings))).tolist()
        (left, low), (right, high) = rings[0].min(axis=0).tolist(), rings[0].max(axis=0).tolist()
        beside = 0.5 * sheet.width(area.name, NAME_TYPE) + 1.0
        wide = 2.0 * beside < right - left and high - low > 4.0
        around = [(right + beside, y), (left - beside, y), (x, high + 2.0), (x, low - 2.0)]
        look = {"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.6}} if wide else {}
        sheet.label(area.name, NAME_TYPE, [(x, y), *around] if wide else around, scale.paper.room, **look)
        sheet.take(np.array([left, low, right, high]))
    middle = scale.on_paper(np.array(widest_place(square.rings)[:2]))
    places = _inside(scale.on_paper(np.array(square.rings[0])), middle, 0.5 * sheet.width(square.name, NAME_TYPE) + 1.5)
    sheet.label(square.name, NAME_TYPE, places, scale.paper.room)


def _inside(ring: Floats, middle: Floats, beside: float) -> list[tuple[float, float]]:
    """Places for a word of that half width inside a closed ring: at the middle of each side.

    Sides as long as the word come first, and of them those nearest to the middle, which is not in a street.
    """
    along = np.diff(ring, axis=0)
    area = float((ring[:-1, 0] * ring[1:, 1] - ring[1:, 0] * ring[:-1, 1]).sum())
    inwards = np.sign(area) * np.stack([-along[:, 1], along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
    places = ring[:-1] + 0.5 * along + inwards * (beside * np.abs(inwards[:, :1]) + 2.5 * np.abs(inwards[:, 1:]))
    order = np.lexsort((np.hypot(*(places - middle).T), np.hypot(*along.T) < 2.0 * beside))
    middles: list[tuple[float, float]] = [tuple(places[k].tolist()) for k in order]
    return middles


def _draw_arrows(sheet: Sheet, line: Floats, frame: Rectangle, colour: str = BLUE) -> None:
    """Draw arrows along the path, in the direction of the dance."""
    steps = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    for place in np.arange(0.5 * ARROWS, along[-1], ARROWS):
        k = int(np.searchsorted(along, place))
        tangent = (line[k] - line[k - 1]) / max(steps[k - 1], 1e-9)
        normal = np.array([-tangent[1], tangent[0]])
        tip = line[k] + 1.6 * tangent
        sheet.shape(
            np.array([tip, line[k] - 1.0 * tangent + 0.9 * normal, line[k] - 1.0 * tangent - 0.9 * normal]), frame,
            facecolor=colour, linewidth=0.0, zorder=6,
        )  # fmt: skip


def _draw_marks(sheet: Sheet, ground: GroundMap, scale: Scale, line: Floats) -> None:
    """Draw marks with their numbers beside the path, or on it where another part of the path is beside it."""
    room = scale.paper.room
    marks, path = ground.timing.marks, ground.dance.path
    points, tangents = scale.on_paper(marks.points), path.tangent(marks.s)
    normals = np.stack([-tangents[:, 1], tangents[:, 0]], axis=-1)
    for point, normal in zip(points, normals, strict=True):
        sheet.line([point - TICK * normal, point + TICK * normal], linewidth=0.6, zorder=6)
    begin = scale.on_paper(path.position(ground.timing.start_place + marks.first))
    sheet.axes.plot(*begin, marker="o", markersize=4.5, markerfacecolor="white", markeredgecolor=VERMILION, zorder=7)
    words = say("head at the start")
    beside = 0.5 * sheet.width(words, 6.0) + 2.0
    look = {"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.8}}
    near = [(begin[0] + side * beside, begin[1] + up) for up in (4.0, -4.0) for side in (1.0, -1.0)]
    sheet.label(words, 6.0, near, room, color=VERMILION, **look)
    ticks = np.stack([points - TICK * normals, points + TICK * normals])
    sheet.take(np.concatenate([ticks.min(axis=0), ticks.max(axis=0)], axis=1))
    for k in sorted(range(len(points)), key=lambda k: (k % ROUND != 0, k)):
        near_by = [points[k] + side * BESIDE * normals[k] for side in (1.0, -1.0, 1.5, -1.5)]
        wide = 0.5 * sheet.width(marks.names[k], MARK_TYPE)
        free = [one for one in near_by if not (np.abs(line - one) < (wide, 1.0)).all(axis=1).any()]
        along = [points[k] + side * (wide + 1.0) * tangents[k] for side in (1.0, -1.0)]
        sheet.label(marks.names[k], MARK_TYPE, free or along, room, **look)


def _draw_gates(sheet: Sheet, ground: GroundMap, scale: Scale) -> None:
    """Draw each gate as a small square with its name beside it."""
    left, bottom, right, top = scale.paper.room
    for name, *place in ground.gates:
        x, y = scale.on_paper(np.array(place)).tolist()
        if not (left < x < right and bottom < y < top):
            continue
        sheet.axes.plot(x, y, marker="s", markersize=4.0, markerfacecolor="white", markeredgecolor="black", zorder=7)
        sheet.take(np.array([x - 1.0, y - 1.0, x + 1.0, y + 1.0]))
        beside = 0.5 * sheet.width(name, NAME_TYPE) + 2.0
        near = [(x + beside, y), (x - beside, y), (x, y + 3.0), (x, y - 3.0)]
        sheet.label(
            name, NAME_TYPE, near, scale.paper.room, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4}
        )


def draw_benches(
    sheet: Sheet, scale: Scale, outlines: Floats, names: Sequence[str], frame: Rectangle, colour: str = ""
) -> None:
    """Draw every bench in its true size, with its name where there is room for it.

    outlines: corners (n, 4, 2) [m]; colour: of all benches, empty for those of the only dragon
    """
    own = {"facecolor": colour} if colour else {}
    room = scale.paper.room
    corners = scale.on_paper(outlines)
    for k, bench in enumerate(corners):
        sheet.shape(bench, frame, zorder=5, **(IN_BENCH if k else IN_HEAD) | own)
    middles = corners.mean(axis=1)
    across = corners[:, 0] - corners[:, 1]
    wide = np.hypot(*across.T)
    normals = across / wide[:, None]
    # Text must not cover a bench, which is taken as eight boxes along its length.
    shares = ((np.arange(8) + 0.5) / 8.0)[None, :, None]
    spots = (shares * corners[:, 0:1] + (1.0 - shares) * corners[:, 3:4] - 0.5 * across[:, None]).reshape(-1, 2)
    sheet.take(np.concatenate([spots - 0.4, spots + 0.4], axis=1))
    # The names of the head, the tail and every tenth bench are placed first, because there may not be room for all.
    last = len(names) - 1
    for k in sorted(range(len(names)), key=lambda k: (k not in (0, last), k % 10 != 0, k % 5 != 0, k)):
        size = min(NAME_TYPE, 0.8 * wide[k] / POINT)
        long = np.hypot(*(corners[k, 0] - corners[k, 3]))
        if size >= SMALLEST and sheet.width(names[k], size) < 0.9 * long:
            turned = (np.degrees(np.arctan2(normals[k, 1], normals[k, 0])) - 90.0 + 90.0) % 180.0 - 90.0
            x, y = middles[k].tolist()
            sheet.words(x, y, names[k], size, rotation=turned, **CENTRED)
            continue
        size = NAME_TYPE if k == 0 else BENCH_TYPE
        # Text is wider than it is high.
        reach = 0.5 * wide[k] + 1.5 + 0.5 * abs(normals[k, 0]) * sheet.width(names[k], size)
        places = [middles[k] + side * reach * normals[k] for side in (1.0, -1.0)]
        if not sheet.label(names[k], size, places, room):
            sheet.label(names[k].partition(" ")[0], size, places, room)


def draw_legend(
    sheet: Sheet, ground: GroundMap, left: float, right: float, bottom: float, *, benches: bool, several: bool = False
) -> None:
    """Draw the meaning of colours and lines, in a cell of the title block. several: of a map of several dragons"""
    wide = right - left - 14.0
    spacing = ground.timing.marks.spacing
    # Look of an area, or the kind of a line, and its words.
    rows: list[tuple[dict[str, Any] | Literal["path", "mark"], str]] = [
        (IN_SWEPT, say("ground swept by benches")),
        (IN_CLEAR, say("keep clear, {ground.width:g} m", ground=ground)),
        ("path", say("path of the handles")),
    ]
    if several:
        rows[-1] = ("path", say("path of each dragon, in its own colour"))
        if benches:
            rows.append((IN_BENCH, say("bench, in the colour of its dragon")))
    elif benches:
        rows += [(IN_BENCH, say("bench")), (IN_HEAD, say("head"))]
    else:
        rows.append(("mark", say("chalk mark every {spacing:g} m", spacing=spacing)))
    if ground.venue and ground.venue.obstacles:
        stone = {"facecolor": STONE, "edgecolor": "black", "hatch": "////", "linewidth": 0.5}
        rows.append((stone, say("obstacle")))
    for k, (look, words) in enumerate(rows):
        x, y = left + 2.0, bottom + 30.0 - 5.6 - 4.3 * k
        if isinstance(look, dict):
            sheet.shape(np.array([(x, y), (x + 8.0, y), (x + 8.0, y + 2.6), (x, y + 2.6)]), **look)
        else:
            sheet.line([(x, y + 1.3), (x + 8.0, y + 1.3)], color=BLUE, linewidth=0.9)
        if look == "mark":
            sheet.line([(x + 4.0, y + 0.2), (x + 4.0, y + 2.4)], linewidth=0.6)
        sheet.words(x + 10.0, y + 0.4, words, 6.5, within=wide)
