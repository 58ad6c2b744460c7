"""Cue cards on paper: four on a sheet of A4, with marks where to cut.

The same dance gives the same bytes on the same versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.patches import Circle

from app.cards.words import CardWords
from app.files.drawing import in_turn
from app.maps.marks import line_of, mark_name
from app.plan.paper import PAPERS, Box, Paper
from app.plan.sheet import POINT, Sheet, north_arrow
from core import Budget, Dance, Venue
from core.language import joined, say
from core.people.cards import Card
from core.plots import BLUE, VERMILION
from core.shapes.engines import widest_place
from core.values import Floats

# Type 42 puts the outlines of TrueType fonts into the file, so that every machine and printer draws them alike.
FONTS: dict[Any, Any] = {"pdf.fonttype": 42, "hatch.linewidth": 0.4}
# Cards side by side and one below the other on a sheet, and the space between a card's edge and its content [mm].
ACROSS, DOWN, PAD = 2, 2, 7.0
# Length of a mark where to cut [mm].
CUT = 6.0
# Sizes of type: of the bench's number, of where it stands, of times, sentences, neighbours and small print [pt].
BENCH_TYPE, STAND_TYPE, TIME_TYPE, WORDS_TYPE, NEAR_TYPE, SMALL_TYPE = 26.0, 12.0, 12.0, 11.0, 10.0, 6.5
# Height of a line of a sentence and of small print, space between two cues, and distance of sentences from the left
# edge [mm].
LINE, SMALL_LINE, BETWEEN, INDENT = 4.9, 2.9, 1.4, 24.0
# Least height of the picture, and the space between the picture and its frame [mm].
PICTURE, INSIDE = 24.0, 2.0
# Ground around the way of a bench in the picture [m], and the type of the names of obstacles [pt].
AROUND, NAME_TYPE = 1.5, 6.5
# The blank between a number and its unit, at which no line may break.
UNIT_BLANK = re.compile(r"(?<=\d) (?=[ms]\b|%)")
# Radius of the circle with the number of a moment, and distances from its place that are tried for it, in order [mm].
MOMENT, AWAY = 1.9, (4.0, 6.5, 9.0, 12.0)
# Half the size of the cross at a chalk mark [mm].
CROSS = 0.9
# Places that are tried for its name, from the cross [mm].
NEAR_CROSS = ((0.0, -2.6), (5.0, 0.0), (-5.0, 0.0), (0.0, 2.6), (4.5, -2.6), (-4.5, -2.6), (4.5, 2.6), (-4.5, 2.6))
# Space between the way and the circle of a moment, where there is room [mm].
BESIDE = 0.9


@dataclass(frozen=True, slots=True)
class CardSheets:
    """The content of a file of cards.

    title: of the dance; verdict: of its check; family: names of the fonts
    """

    dance: Dance
    venue: Venue | None
    cards: Sequence[Card]
    words: CardWords
    title: str
    verdict: str
    family: tuple[str, ...]
    budget: Budget


@dataclass(frozen=True, slots=True)
class _AreaName:
    """The name of an obstacle in the picture: the middle and the radius of the largest circle in it, half the width of
    the name [mm]."""

    name: str
    x: float
    y: float
    wide: float
    radius: float

    @property
    def fits(self) -> bool:
        """True if the name stands inside."""
        return self.wide <= self.radius

    @property
    def line(self) -> Floats:
        """Points along the name inside."""
        return np.array([(self.x + part * self.wide, self.y) for part in (-1.0, -0.5, 0.0, 0.5, 1.0)])


def cards_pdf(decks: Sequence[CardSheets], progress: Callable[[float], None] = lambda share: None) -> bytes:
    """The bytes of the PDF. decks: of one dragon, or of each of several; raises: Halted once the budget is stopped"""
    sink, on_sheet = io.BytesIO(), ACROSS * DOWN
    count, done = sum(len(sheets.cards) for sheets in decks), 0

    def drawn() -> bytes:
        nonlocal done
        with matplotlib.rc_context({"font.family": decks[0].family, **FONTS}):
            metadata = {"Title": decks[0].title, "Creator": "Bench Dragon", "CreationDate": None}
            with PdfPages(sink, metadata=metadata) as file:
                for sheets in decks:
                    for first in range(0, len(sheets.cards), on_sheet):
                        some = sheets.cards[first : first + on_sheet]
                        file.savefig(_sheet(sheets, some).figure)
                        done += len(some)
                        progress(done / count)
        return sink.getvalue()

    return in_turn(drawn, decks[0].budget)


def _sheet(sheets: CardSheets, cards: Sequence[Card]) -> Sheet:
    """One sheet with up to ACROSS x DOWN cards. The marks where to cut stand at the corners of all cards."""
    paper = Paper("A4", *PAPERS["A4"])
    sheet = Sheet(paper, sheets.family, sheets.budget)
    wide, high = paper.width / ACROSS, paper.height / DOWN
    for k, card in enumerate(cards):
        left, top = wide * (k % ACROSS), paper.height - high * (k // ACROSS)
        _draw_card(sheet, sheets, card, (left + PAD, top - high + PAD, left + wide - PAD, top - PAD))
    for x in (0.0, wide, paper.width):
        for y in (0.0, high, paper.height):
            for dx, dy in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
                sheet.line([(x, y), (x + CUT * dx, y + CUT * dy)], linewidth=0.4, color="#777777")
    return sheet


def _draw_card(sheet: Sheet, sheets: CardSheets, card: Card, box: Box) -> None:
    left, bottom, right, top = box
    words, bench = sheets.words, card.bench
    number, name = str(bench.bench), words.names[bench.bench] if words.names else ""
    name = name or (say("head") if bench.bench == 0 else "")
    sheet.words(left, top - 8.5, number, BENCH_TYPE, fontweight="bold")
    beside = left + sheet.width(number, BENCH_TYPE, bold=True) + 3.0
    sheet.words(beside, top - 8.5, name, 16.0, within=right - beside - 1.0, fontweight="bold")
    sheet.words(right, top - 1.5, sheets.title, 6.5, within=0.6 * (right - left), ha="right", color="#555555")
    y = top - 15.5
    stand = bench.start
    place = say("Stand {place}", place=words.at_mark(stand))
    sheet.words(left, y, place, STAND_TYPE, within=right - left, fontweight="bold")
    front = say(
        "front handle at x {x:.2f} m, y {y:.2f} m; a step is {words.chalk.step:g} m",
        x=stand.x + 0.0,
        y=stand.y + 0.0,
        words=words,
    )
    sheet.words(left, y - 4.3, front, 7.5, within=right - left)
    y -= 9.7
    sheet.words(left, y, words.neighbours(bench.ahead, bench.behind), NEAR_TYPE, within=right - left)
    y -= 2.6
    sheet.line([(left, y), (right, y)], linewidth=0.6)
    y = _draw_cues(sheet, sheets, card, (left, bottom, right, y))
    marks = say(
        "Chalk marks (x) name the metres along the path. The line is the way of your front handle; "
        "the dot of a meeting is the middle of your bench.",
    )
    notes = [marks, words.distances(card), words.left_out(card), sheets.verdict]
    lines = _wrapped(sheet, joined(notes), SMALL_TYPE, right - left)
    for k, line in enumerate(lines, start=1):
        sheet.words(left, bottom + SMALL_LINE * (len(lines) - k), line, SMALL_TYPE, color="#444444")
    _draw_track(sheet, sheets, card, (left, bottom + SMALL_LINE * len(lines) + 1.0, right, y))


def _draw_cues(sheet: Sheet, sheets: CardSheets, card: Card, box: Box) -> float:
    """Write the cues one below the other; returns the height at which the picture may begin [mm].

    If they leave too little room for the picture, all of them are written smaller.
    """
    left, bottom, right, top = box
    words, room = sheets.words, top - bottom - PICTURE - 7.0
    # With music the count stands before a cue, and its time behind it.
    counts = [words.clock.count(cue.time) for cue in card.cues]
    behind = [
        f" ({words.clock.clock(cue.time)})" if count else "" for count, cue in zip(counts, card.cues, strict=True)
    ]
    sentences = [words.sentence(card, cue) + time for cue, time in zip(card.cues, behind, strict=True)]
    size, shrink = WORDS_TYPE, 1.0
    lines = [_wrapped(sheet, one, size, right - left - INDENT) for one in sentences]
    while sum(LINE * shrink * len(one) + BETWEEN * shrink for one in lines) > room and shrink > 0.6:
        shrink -= 0.05
        lines = [_wrapped(sheet, one, size * shrink, right - left - INDENT) for one in sentences]
    y = top
    for number, (cue, own_lines) in enumerate(zip(card.cues, lines, strict=True), start=1):
        y -= BETWEEN * shrink
        base = y - 0.78 * LINE * shrink
        _draw_number(sheet, number, (left + 2.0, base + 1.1), shrink)
        time = counts[number - 1] or words.clock.clock(cue.time)
        sheet.words(left + 5.0, base, time, TIME_TYPE * shrink, within=INDENT - 6.0, fontweight="bold")
        for line in own_lines:
            sheet.entry(left + INDENT, base, line, size * shrink)
            base -= LINE * shrink
        y -= LINE * shrink * len(own_lines)
    return y - BETWEEN


def _draw_number(sheet: Sheet, number: int, at: tuple[float, float], shrink: float = 1.0) -> None:
    """Draw the number of a moment, in a circle."""
    radius = MOMENT * shrink
    sheet.axes.add_patch(Circle(at, radius, facecolor="white", edgecolor="black", linewidth=0.6, zorder=8))
    size = 7.5 * shrink
    sheet.words(at[0], at[1] - 0.36 * size * POINT, str(number), size, ha="center", fontweight="bold")


def _wrapped(sheet: Sheet, sentence: str, size: float, wide: float) -> list[str]:
    """Lines of a sentence no wider than `wide` [mm], broken at blanks and between Chinese characters."""
    pieces = [""]
    for character in UNIT_BLANK.sub("\u00a0", sentence):
        # A line may break before a blank, before and after a Chinese character, and never before a closing mark.
        may_break = character == " " or character > "\u2e80" or (pieces[-1] and pieces[-1][-1] > "\u2e80")
        if may_break and character not in "，。；：）、":
            pieces.append(character)
        else:
            pieces[-1] += character
    lines, line = [], ""
    for piece in pieces:
        if line.strip() and sheet.width((line + piece).strip(), size) > wide:
            lines.append(line.strip())
            line = ""
        line += piece
    return [*lines, line.strip()]


def _draw_track(sheet: Sheet, sheets: CardSheets, card: Card, box: Box) -> None:
    """Draw the way of the front handle from start to end, with the numbered moments."""
    left, bottom, right, top = box
    dance, bench, venue = sheets.dance, card.bench, sheets.venue
    line = line_of(dance.path, bench.start.s, max(bench.done.s, bench.start.s + 0.1))
    low, high = line.min(axis=0) - AROUND, line.max(axis=0) + AROUND
    unit = min(
        (right - left - 2 * INSIDE) / max(high[0] - low[0], 1.0),
        (top - bottom - 2 * INSIDE) / max(high[1] - low[1], 1.0),
    )
    middle, centre = 0.5 * (low + high), np.array([0.5 * (left + right), 0.5 * (bottom + top)])

    def on_card(points: Any) -> Floats:
        placed: Floats = (np.asarray(points) - middle) * unit + centre
        return placed

    frame = sheet.frame(box)
    for area in venue.areas if venue else ():
        look: dict[str, Any] = {"facecolor": "none"} if area is venue.square else {"facecolor": "#D9D9D9"}  # type: ignore[union-attr]
        rings = [on_card(ring) for ring in area.rings]
        sheet.area(rings, frame, edgecolor="#888888", linewidth=0.5, zorder=1, **look)
    track = on_card(line)
    # The arrow stands in the corner that is furthest from the track.
    corners = np.array([(x, y) for x in (left + 4.0, right - 4.0) for y in (top - 14.0, bottom + 1.0)])
    away = np.hypot(*np.moveaxis(corners[:, None] + np.array([0.0, 6.0]) - track, -1, 0)).min(axis=1)
    arrow = corners[int(away.argmax())]
    north_arrow(sheet, float(arrow[0]), float(arrow[1]), sheets.words.geographic)
    sheet.line(track, frame, color=BLUE, linewidth=1.2, zorder=4)
    _draw_arrows(sheet, track, frame)
    taken: list[Floats] = [arrow + np.array([0.0, up]) for up in (3.0, 9.0)]
    names = _names_of(sheet, venue, on_card, box)
    kept_free = np.concatenate([track, *(one.line for one in names if one.fits)])
    for number, cue in enumerate(card.cues, start=1):
        at = on_card((cue.x, cue.y))
        sheet.axes.plot(*at, marker="o", markersize=2.6, color=VERMILION, zorder=7)
        place = _free(at, taken, box, kept_free)
        taken.append(place)
        if place is not at:
            sheet.line([at, place], linewidth=0.4, color=VERMILION, zorder=6)
        _draw_number(sheet, number, (float(place[0]), float(place[1])))
    _write_names(sheet, names, track, taken, box)
    _draw_marks(sheet, sheets, (bench.start.s, bench.done.s), on_card, box)


def _draw_marks(
    sheet: Sheet, sheets: CardSheets, places: Sequence[float], on_card: Callable[[Any], Floats], box: Box
) -> None:
    """Draw a cross at the chalk mark nearest to each of these places along the path, with its name where room is."""
    chalk, path = sheets.words.chalk, sheets.dance.path
    low, high = path.drawn_between(min(chalk.first, path.begin), path.end)
    for mark in dict.fromkeys(chalk.nearest(s)[0] for s in places):
        if not low <= (s := chalk.first + mark) <= high:
            continue
        x, y = on_card(path.position(s)).tolist()
        for way in (CROSS, -CROSS):
            sheet.line([(x - CROSS, y - way), (x + CROSS, y + way)], linewidth=0.9, color="black", zorder=6)
        sheet.label(f"{mark_name(mark)} m", NAME_TYPE, [(x + dx, y + dy) for dx, dy in NEAR_CROSS], box)


def _names_of(sheet: Sheet, venue: Venue | None, on_card: Callable[[Any], Floats], box: Box) -> list[_AreaName]:
    """The names of the obstacles in the picture."""
    (left, bottom, right, top), names = box, list[_AreaName]()
    for area in venue.areas[1:] if venue else ():
        x, y, radius = widest_place(area.rings)
        (x, y), (edge, _) = on_card((x, y)).tolist(), on_card((x + radius, y)).tolist()
        if left < x < right and bottom < y < top:
            wide = 0.5 * sheet.width(area.name, NAME_TYPE) + 0.3
            names.append(_AreaName(area.name, x, y, wide, edge - x))
    return names


def _write_names(sheet: Sheet, names: Sequence[_AreaName], track: Floats, taken: Sequence[Floats], box: Box) -> None:
    """Write names in their obstacles, or beside small ones where neither the way nor a number is."""
    sheet.take(np.concatenate([track - 0.4, track + 0.4], axis=1))
    badges = np.array(taken)
    sheet.take(np.concatenate([badges - MOMENT, badges + MOMENT], axis=1))
    for one in names:
        away = one.radius + one.wide + 0.5
        beside = [(one.x + away, one.y), (one.x - away, one.y)]
        sheet.label(one.name, NAME_TYPE, [(one.x, one.y)] if one.fits else beside, box, color="#555555")


def _free(at: Floats, taken: Sequence[Floats], box: Box, kept_free: Floats) -> Floats:
    """A place in the box and near a point for a number that covers no other one, and none of the points to keep free if
    that can be; the point itself if there is none."""
    low, high = np.array(box[:2]) + MOMENT, np.array(box[2:]) - MOMENT
    on_way: Floats | None = None
    for away in AWAY:
        for angle in np.linspace(0.25 * np.pi, 2.25 * np.pi, 16, endpoint=False):
            place: Floats = at + away * np.array([np.cos(angle), np.sin(angle)])
            inside = bool((place >= low).all() and (place <= high).all())
            if inside and all(np.hypot(*(place - one)) > 2.0 * MOMENT + 0.3 for one in taken):
                if np.hypot(*(kept_free - place).T).min() > MOMENT + BESIDE:
                    return place
                on_way = place if on_way is None else on_way
    return at if on_way is None else on_way


def _draw_arrows(sheet: Sheet, track: Floats, frame: Any) -> None:
    """Draw arrows along a track, in the direction of the dance."""
    steps = np.hypot(*np.diff(track, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    for place in np.arange(12.0, along[-1], 25.0):
        k = int(np.searchsorted(along, place))
        ahead = (track[k] - track[k - 1]) / max(float(steps[k - 1]), 1e-9)
        side, tip = np.array([-ahead[1], ahead[0]]), track[k] + 1.4 * ahead
        sheet.shape(np.array([tip, tip - 2.4 * ahead + 0.9 * side, tip - 2.4 * ahead - 0.9 * side]), frame,
                    facecolor=BLUE, linewidth=0.0, zorder=5)  # fmt: skip
