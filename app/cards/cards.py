"""Cue cards on paper: four on a sheet of A4, eight on A3, with marks where to cut.

The same dance gives the same bytes on the same fonts and versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Literal

import numpy as np

from app.cards.words import CardWords
from app.files.addresses import address_of_bench
from app.files.codes import Code
from app.files.typeset import Face, measured, typeset
from app.maps.marks import line_of, mark_name
from app.plan.drawing import MapDrawing, Scale, look, turned_by
from app.plan.ground import CIRCLE, IN_BENCH, draw_arrows, draw_venue, thinned
from app.plan.paper import Paper, PaperName, TextRoom, box_about
from core import Budget, Dance, Venue
from core.language import joined, say
from core.people.cards import Card, Cue
from core.plots import BLUE, VERMILION
from core.values import Floats, Progress

# The blank between a number and its unit, at which no line may break.
UNIT_BLANK = re.compile(r"(?<=\d) (?=[ms]\b|%)")
# Space between the way and the frame of the picture, and distance of the arrows along the way [mm].
INSIDE, ARROWS = 2.0, 25.0
# Ground around the way of a bench in the picture [m], and type of the names of marks and of numbers [pt].
AROUND, NAME_TYPE, NUMBER_TYPE = 1.5, 6.5, 7.5
# Radius of the circle with the number of a moment and of its dot, space between the circle and the way, and distances
# from the dot that are tried for the circle, in order [mm].
MOMENT, DOT, BESIDE, AWAY = 1.9, 0.46, 0.9, (4.0, 6.5, 9.0, 12.0)
# Directions from the dot that are tried for the circle (16, 2) [1].
AROUND_DOT = np.stack([np.cos(turns := np.pi * (0.25 + np.arange(16) / 8.0)), np.sin(turns)], axis=1)
# Width of a code that can be so narrow [mm].
CODE = 22.0
# Half the length of the arrow on the own bench, and of its head [mm].
FORWARD, HEAD = 4.5, 2.2
# Half the width of the way that text keeps free [mm].
WAY = 0.4
# Half the size of the cross at a chalk mark [mm].
CROSS = 0.9
# Places that are tried for its name, from the cross [mm].
NEAR_CROSS = (
    (0.0, -2.6), (5.0, 0.0), (-5.0, 0.0), (0.0, 2.6), (4.5, -2.6), (-4.5, -2.6), (4.5, 2.6), (-4.5, 2.6), (0.0, -4.0),
    (0.0, 4.0),
)  # fmt: skip
# Middle of the arrow from the sides of the picture if it points up, and if it is turned, its foot above the lower side
# and its top below the upper one, and the same in the box that the template draws [mm].
ARROW_SIDE, ARROW_TURNED, ARROW_FOOT, ARROW_TOP, ARROW_IN_BOX = 4.0, 9.0, 1.0, 14.0, (6.0, 16.0)


# What is up on a picture: north, or the y axis of a plan, or the way on which a bench begins.
MapUp = Literal["north", "way"]


@dataclass(frozen=True, slots=True)
class CardSheets:
    """The content of a file of cards.

    name: of the dragon, empty for the only one; title: of the dance; verdict: of its check, and whether nothing fails
    address: of the page with the dance, empty without one; map_up: what is up on the pictures
    """

    dance: Dance
    name: str
    venue: Venue | None
    cards: Sequence[Card]
    words: CardWords
    title: str
    verdict: tuple[str, bool]
    face: Face
    budget: Budget
    address: str
    map_up: MapUp


def cards_pdf(decks: Sequence[CardSheets], paper: PaperName, progress: Progress) -> bytes:
    """The bytes of the PDF. decks: of one dragon, or of each of several; raises: Halted once the budget is stopped"""
    first, template = decks[0], files("app.cards").joinpath("cards.typ").read_bytes()
    cards = [(sheets, card, _words_on(sheets, card)) for sheets in decks for card in sheets.cards]
    data = {
        "title": first.title,
        "paper": paper,
        "decks": [[words for own, _, words in cards if own is sheets] for sheets in decks],
    }
    rooms = measured(template, first.face, {**data, "measures": True}, first.budget)
    for k, ((sheets, card, words), room) in enumerate(zip(cards, rooms, strict=True), start=1):
        words |= room | (_picture(sheets, card, room["width"], room["height"]) if room["height"] > 0.0 else {})
        progress(0.5 * k / len(cards))
    content_of_file = typeset(template, first.face, {**data, "measures": False}, first.budget)
    progress(1.0)
    return content_of_file


def _words_on(sheets: CardSheets, card: Card) -> dict[str, Any]:
    """The words of a card, as the template takes them."""
    words, bench, stand = sheets.words, card.bench, card.bench.start
    front = say(
        "front handle at x {x:.2f} m, y {y:.2f} m; a step is {words.chalk.step:g} m",
        x=stand.x + 0.0,
        y=stand.y + 0.0,
        words=words,
    )
    marks = say(
        "Chalk marks (x) name the metres along the path. The line is the way of your front handle; "
        "the dot of a meeting is the middle of your bench.",
    )
    name = words.names[bench.bench] if words.names else ""
    title = say("{name}: {text}", name=sheets.title, text=sheets.name) if sheets.name else sheets.title
    verdict, passes = sheets.verdict
    return {
        "number": str(bench.bench),
        "name": name or (say("head") if bench.bench == 0 else ""),
        "title": title,
        "stand": say("Stand {place}", place=words.at_mark(stand)),
        "front": front,
        "neighbours": words.neighbours(bench.ahead, bench.behind),
        "cues": [_cue(sheets, card, cue) for cue in card.cues],
        "notes": joined([marks, words.distances(card), words.left_out(card), verdict if passes else ""]),
        "warning": "" if passes else verdict,
        "code": code_of_bench(sheets.address, bench.bench, words.dragon),
    }


def code_of_bench(address: str, bench: int, dragon: int | None) -> dict[str, Any] | None:
    """The code of the card of a bench on the page; None without an address."""
    return Code.of(address_of_bench(address, bench, dragon)).to_json(CODE) if address else None


def _cue(sheets: CardSheets, card: Card, cue: Cue) -> tuple[str, str]:
    """The time of a cue, and its sentence. With music the count stands before the sentence, and the time behind it."""
    sentence, clock = sheets.words.sentence(card, cue), sheets.words.clock
    count, time = clock.count(cue.time), clock.clock(cue.time)
    return count or time, UNIT_BLANK.sub("\u00a0", f"{sentence} ({time})" if count else sentence)


def _picture(sheets: CardSheets, card: Card, wide: float, high: float) -> dict[str, Any]:
    """The way of the front handle from start to end, with the numbered moments. wide, high: of the picture [mm]"""
    bench = card.bench
    line = line_of(sheets.dance.path, bench.start.s, max(bench.done.s, bench.start.s + 0.1))
    turned = 0.5 * np.pi - bench.direction if sheets.map_up == "way" else 0.0
    seen = turned_by(turned, line)
    low, high_corner = seen.min(axis=0) - AROUND, seen.max(axis=0) + AROUND
    unit = float(((np.array([wide, high]) - 2.0 * INSIDE) / np.maximum(high_corner - low, 1.0)).min())
    middle = turned_by(-turned, 0.5 * (low + high_corner)).tolist()
    scale = Scale(Paper(wide, high, 0.0, 0.0), 1000.0 / unit, (middle[0], middle[1]), turned)
    drawing, track = MapDrawing(scale, sheets.face, sheets.budget), thinned(scale.on_paper(line))
    points = thinned(track, WAY)
    on_track = np.concatenate([points - WAY, points + WAY], axis=1)
    arrow = _arrow(drawing, track)
    drawing.line(track, 6, 1.2, BLUE)
    draw_arrows(drawing, track, apart=ARROWS)
    _draw_bench(drawing, sheets.dance, card)
    way = TextRoom()
    way.take(on_track)
    _draw_marks(drawing, sheets, (bench.start.s, bench.done.s), way)
    draw_venue(drawing, sheets.venue, small=True, off=way)
    _draw_landmarks(drawing, sheets, way)
    _draw_moments(drawing, card.cues, way)
    return {
        **drawing.to_json(),
        "alt": say("Map of the way of your front handle, with the number of each cue"),
        "arrow": arrow,
        "geographic": sheets.words.geographic,
        "turned": -float(np.degrees(turned)),
    }


def _draw_bench(drawing: MapDrawing, dance: Dance, card: Card) -> None:
    """Draw the bench where it starts, in its true size, with an arrow to its front."""
    dragon, k, stand = dance.dragon, card.bench.bench, card.bench.start
    along = np.array([np.cos(stand.heading), np.sin(stand.heading)])
    across, front = 0.5 * dragon.widths[k] * np.array([-along[1], along[0]]), np.array([stand.x, stand.y])
    nose = front + dragon.overhangs[k] * along
    tail = nose - dragon.lengths[k] * along
    drawing.shape(
        [drawing.scale.on_paper(np.array([nose + across, nose - across, tail - across, tail + across]))], IN_BENCH, 7
    )
    middle, forward = drawing.scale.on_paper(0.5 * (nose + tail)), turned_by(drawing.scale.turned, along)
    tip, side = middle + FORWARD * forward, 0.5 * HEAD * np.array([-forward[1], forward[0]])
    neck = tip - HEAD * forward
    drawing.line(np.array([middle - FORWARD * forward, neck]), 7.5, 1.6, "black")
    shaft = np.linspace(middle - FORWARD * forward, tip, 12)
    drawing.places.take(np.concatenate([shaft - 0.5 * HEAD, shaft + 0.5 * HEAD], axis=1))
    drawing.shape([np.array([tip, neck + side, neck - side])], look("black"), 7.5)


def _arrow(drawing: MapDrawing, track: Floats) -> tuple[float, float]:
    """Keep the corner that is furthest from the track for the arrow up; returns where its box stands [mm]."""
    _, _, right, top = drawing.room
    side = ARROW_TURNED if drawing.scale.turned else ARROW_SIDE
    sides, feet = (side, right - side), (top - ARROW_TOP, ARROW_FOOT)
    corners = np.array([(x, y) for x in sides for y in feet])
    away = np.hypot(*np.moveaxis(corners[:, None] + (0.0, 6.0) - track, -1, 0)).min(axis=1)
    x, y = corners[int(away.argmax())].tolist()
    drawing.places.take(np.array([x + 1.0 - side, y - 1.0, x - 1.0 + side, y + ARROW_TOP]))
    return x - ARROW_IN_BOX[0], top - y - ARROW_IN_BOX[1]


def _draw_moments(drawing: MapDrawing, cues: Sequence[Cue], way: TextRoom) -> None:
    """Draw a dot for each cue, and its number in a circle, which covers no other one, and not the way if that can
    be; at the dot itself if there is no other place."""
    wide, space = 2.0 * MOMENT, 2.0 * (MOMENT + BESIDE)
    for number, cue in enumerate(cues, start=1):
        at = drawing.scale.on_paper(np.array([cue.x, cue.y]))
        drawing.shape([at + DOT * CIRCLE], look(VERMILION), 8)
        near = [at + away * one for away in AWAY for one in AROUND_DOT]
        free = [(x, y) for x, y in near if way.is_free(box_about(x, y, space, space))]
        place = drawing.places.first_free(wide + 0.3, wide + 0.3, [*free, *near], drawing.room)
        middle = at if place is None else np.array(place)
        drawing.line(np.stack([at, middle]), 7, 0.4, VERMILION)
        drawing.shape([middle + MOMENT * CIRCLE], look("white", width=0.6), 9)
        x, y = middle.tolist()
        drawing.write(str(number), x, y, NUMBER_TYPE, bold=True)


def _draw_landmarks(drawing: MapDrawing, sheets: CardSheets, way: TextRoom) -> None:
    """Name the landmarks of the words, such as gates, that are no things of the square, where there is room."""
    things = {area.name for area in sheets.venue.areas} if sheets.venue else ()
    for name, place in sheets.words.landmarks:
        if name not in things:
            x, y = drawing.scale.on_paper(np.array(place)).tolist()
            beside = 0.5 * drawing.width(name, NAME_TYPE) + 1.0
            places = [(x + beside, y), (x - beside, y), (x, y + 2.5), (x, y - 2.5)]
            drawing.label(name, NAME_TYPE, places, off=way)


def _draw_marks(drawing: MapDrawing, sheets: CardSheets, places: Sequence[float], way: TextRoom) -> None:
    """Draw a cross at the chalk mark nearest to each of these places along the path, with its name where room is."""
    chalk, path = sheets.words.chalk, sheets.dance.path
    low, high = path.drawn_between(min(chalk.first, path.begin), path.end)
    for mark in dict.fromkeys(chalk.nearest(s)[0] for s in places):
        if not low <= (s := chalk.first + mark) <= high:
            continue
        at = drawing.scale.on_paper(path.position(s))
        x, y = at.tolist()
        strokes = [at + CROSS * np.array([(-1.0, side), (1.0, -side)]) for side in (1.0, -1.0)]
        drawing.shape(strokes, look(edge="black", width=0.9), 8, "")
        drawing.label(f"{mark_name(mark)} m", NAME_TYPE, [(x + dx, y + dy) for dx, dy in NEAR_CROSS], off=way)
