"""The cues of a card in words, in English or Chinese."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

from app.maps.marks import first_mark, mark_name, marks_before
from app.plan.timing import TimeFormat
from core import Dance
from core.language import Language, Listed, counted, phrase, say, sense, speaking
from core.people.cards import Card, Cue, CueKind
from core.people.cues import Meeting, Side, Stand, Turning
from core.values import Point
from core.venue import Venue

# Points of the compass from north, clockwise.
COMPASS = (
    phrase("north"), phrase("north-east"), phrase("east"), phrase("south-east"), phrase("south"),
    phrase("south-west"), phrase("west"), phrase("north-west"),
)  # fmt: skip

# How far the way of a turn goes around a landmark at least [rad], and how near the landmark is to it [m].
AROUND, BESIDE = math.radians(80.0), 12.0
# A bench walks straight ahead up to this angle to it [rad].
STRAIGHT = math.radians(30.0)
# Angles from which on a turn is called so [rad]: below the first one it is a bend, and above the last one a circle.
TURN, BACK, CIRCLE = (math.radians(degrees) for degrees in (70.0, 130.0, 300.0))
# Largest angle between a direction and a landmark in it [rad]; how near, how far and how wide the landmark may be [m].
AHEAD, NEAR, FAR, WIDE = math.radians(20.0), 3.0, 80.0, 15.0


@cache
def _nameless() -> re.Pattern[str]:
    """Names that nobody has given, in any language."""
    names = list[str]()
    for language in Language:
        with speaking(language):
            names.append(say("obstacle {k}", k=r"\d+"))
    return re.compile("|".join(names))


def landmarks_of(venue: Venue | None, gates: Iterable[tuple[str, Point]]) -> list[tuple[str, Point]]:
    """Name and place of the gates, and of the obstacles with a name that are small enough to walk towards."""
    marks = [*gates]
    for area in venue.obstacles if venue else ():
        xs, ys = zip(*area.rings[0], strict=True)
        if max(max(xs) - min(xs), max(ys) - min(ys)) <= WIDE and not _nameless().fullmatch(area.name):
            marks.append((area.name, (0.5 * (min(xs) + max(xs)), 0.5 * (min(ys) + max(ys)))))
    return marks


def runs(numbers: Iterable[int]) -> str:
    """Numbers in short, in rising order.

    >>> runs([9, 3, 4, 5, 7])
    '3-5, 7, 9'
    """
    parts: list[list[int]] = []
    for one in sorted(numbers):
        if parts and one == parts[-1][-1] + 1:
            parts[-1].append(one)
        else:
            parts.append([one])
    return str(Listed(f"{part[0]}-{part[-1]}" if len(part) > 1 else part[0] for part in parts))


def side_words(met: Meeting) -> str:
    """Where another bench is that is met."""
    words = {
        Side.LEFT: (say("behind on your left"), say("straight on your left"), say("ahead on your left")),
        Side.RIGHT: (say("behind on your right"), say("straight on your right"), say("ahead on your right")),
    }[met.side]
    return words[1 + (met.ahead > 0.0) - (met.ahead < 0.0)]


@dataclass(frozen=True, slots=True)
class Chalk:
    """Chalk marks along the path: s of mark 0 [m], the last mark by its length from there [m], their spacing [m], and
    the length of a step [m]."""

    first: float
    last: float
    spacing: float
    step: float

    @classmethod
    def of(cls, dance: Dance, ends: Sequence[float], spacing: float, step: float) -> Chalk:
        """The marks of a dance, as on its plan. ends: s of the tail at its start and of the head at its stop [m]"""
        first = first_mark(dance, ends[0], spacing)
        return cls(first, spacing * marks_before(ends[1] - first, spacing), spacing, step)

    def nearest(self, s: float) -> tuple[float, float]:
        """The mark nearest to a place on the path, by its length from mark 0 [m], and how far the place is past it [m];
        before it: < 0."""
        mark = min(self.spacing * math.floor((s - self.first) / self.spacing + 0.5), self.last)
        return mark, s - self.first - mark

    def steps(self, past: float) -> int:
        """Whole steps of a length [m]; < 0 for a length before a mark."""
        return round(past / self.step)


@dataclass(frozen=True, slots=True)
class CardWords:
    """What the words of a card follow from.

    names: of all benches, empty for one without; clock: format of times; geographic: True if y points north
    dragon: number of the dragon in a performance, and dragons: the name of each, with the names of its benches; None
        and empty for a single dance
    landmarks: name and middle of the things in the square that a person can walk towards
    """

    names: tuple[str, ...]
    clock: TimeFormat
    chalk: Chalk
    geographic: bool
    dragon: int | None = None
    dragons: Sequence[tuple[str, tuple[str, ...]]] = ()
    landmarks: Sequence[tuple[str, Point]] = ()

    def met_name(self, met: Meeting) -> str:
        """Name of the bench that is met; empty without one."""
        names = self.names if met.dragon is None else self.dragons[met.dragon][1]
        return names[met.bench] if names else ""

    def _met_bench(self, met: Meeting) -> str:
        """The bench that is met, in words; of another dragon, with the name of that."""
        bench = say("Bench {bench}", bench=self._bench(met.bench, self.met_name(met)))
        if met.dragon in (None, self.dragon):
            return bench
        return say("{bench} of {dragon}", bench=bench, dragon=self.dragons[met.dragon][0])

    def _bench(self, number: int, name: str) -> str:
        if name:
            head = say("{number} {name} (head)", number=number, name=name)
            return say("{number} {name}", number=number, name=name) if number else head
        return sense("bench", "{number}", number=number) if number else say("0 (head)")

    def neighbours(self, ahead: int | None, behind: int | None) -> str:
        """Who is before and behind a bench; None: nobody.

        >>> words = CardWords(("", "Li"), TimeFormat(), Chalk(0.0, 100.0, 5.0, 0.75), False)
        >>> words.neighbours(0, 1)
        'Before you: 0 (head).  Behind you: 1 Li.'
        """
        before, after = (
            say("nobody") if bench is None else self._bench(bench, self.names[bench] if self.names else "")
            for bench in (ahead, behind)
        )
        return say("Before you: {before}.  Behind you: {after}.", before=before, after=after)

    def compass(self, angle: float) -> str:
        """A direction [rad] as a point of the compass; empty where north is not known."""
        bearing = (90.0 - math.degrees(angle)) % 360.0
        return say(COMPASS[round(bearing / 45.0) % len(COMPASS)]) if self.geographic else ""

    def walk(self, begin: Stand, angle: float) -> str:
        """How a bench begins to walk in a direction [rad]: towards a thing that has a name, if one is there."""
        to, mark = self.compass(angle), self._ahead((begin.x, begin.y), angle)
        if mark is not None:
            words = say("Walk towards “{mark}”", mark=mark)
        else:
            beside = math.remainder(angle - begin.heading, math.tau)
            left, ahead = say("Walk ahead to the left"), say("Walk straight ahead")
            words = ahead if abs(beside) < STRAIGHT else left if beside > 0.0 else say("Walk ahead to the right")
        return say("{words}, {to}.", words=words, to=to) if to else say("{words}.", words=words)

    def turn(self, turn: Turning) -> str:
        """A turn: around a thing that has a name, or towards one, or to a point of the compass; and where it begins.

        >>> words = CardWords((), TimeFormat(), Chalk(0.0, 100.0, 5.0, 0.75), False, landmarks=[("well", (0.0, 2.0))])
        >>> words.turn(Turning(0.0, 3.0, 19.0, 3.1, 3.1, ((0.0, 0.0), (2.0, 2.0), (0.0, 4.0))))
        'Near mark 20 m: turn back to the left around “well”.'
        """
        words, around = self._turned(turn.angle), self._around(turn)
        if around is not None:
            words = say("{turn} around “{mark}”", turn=words, mark=around)
        elif (mark := self._ahead(turn.way[-1], turn.heading)) is not None:
            words = say("{turn}, towards “{mark}”", turn=words, mark=mark)
        elif to := self.compass(turn.heading):
            words = say("{turn}, then {to}", turn=words, to=to)
        return say("Near mark {place} m: {turn}.", place=mark_name(self.chalk.nearest(turn.s)[0]), turn=words)

    def _turned(self, angle: float) -> str:
        """A turn by an angle [rad], to the left > 0."""
        left, size = angle > 0.0, abs(angle)
        if size < TURN:
            return say("bear left") if left else say("bear right")
        if size < BACK:
            return say("turn left") if left else say("turn right")
        if size < CIRCLE:
            return say("turn back to the left") if left else say("turn back to the right")
        side = say("to the left") if left else say("to the right")
        return counted(round(size / math.tau), "circle {side}, {count} time", "circle {side}, {count} times", side=side)

    def _around(self, turn: Turning) -> str | None:
        """Name of the nearest landmark that a turn goes around; None if it goes around none."""
        best, least = None, BESIDE
        for name, (x, y) in self.landmarks:
            seen = [math.atan2(b - y, a - x) for a, b in turn.way]
            swept = sum(math.remainder(after - before, math.tau) for before, after in pairwise(seen))
            away = max(math.hypot(a - x, b - y) for a, b in turn.way)
            if away < least and swept * math.copysign(1.0, turn.angle) >= min(AROUND, abs(turn.angle)):
                best, least = name, away
        return best

    def _ahead(self, place: Point, angle: float) -> str | None:
        """Name of the landmark that is nearest to a direction from a place [rad]; None if none is near it."""
        best, least = None, AHEAD
        for name, (x, y) in self.landmarks:
            dx, dy = x - place[0], y - place[1]
            beside = abs(math.remainder(math.atan2(dy, dx) - angle, math.tau))
            if NEAR < math.hypot(dx, dy) < FAR and beside < least:
                best, least = name, beside
        return best

    def standing(self, stand: Stand) -> str:
        """Where carriers stand."""
        template = phrase("You stand {place} (x {x} m, y {y} m).")
        return say(template, place=self.at_mark(stand), x=f"{stand.x + 0.0:.1f}", y=f"{stand.y + 0.0:.1f}")

    def at_mark(self, stand: Stand) -> str:
        """A place as whole steps from the nearest chalk mark."""
        place, past = self.chalk.nearest(stand.s)
        mark = mark_name(place)
        steps = self.chalk.steps(past)
        if steps == 0:
            return say("at chalk mark {mark} m", mark=mark)
        if steps > 0:
            return counted(
                steps, "{count} step past chalk mark {mark} m", "{count} steps past chalk mark {mark} m", mark=mark
            )
        return counted(
            -steps, "{count} step before chalk mark {mark} m", "{count} steps before chalk mark {mark} m", mark=mark
        )

    def sentence(self, card: Card, cue: Cue) -> str:
        """A cue in one sentence, without its time."""
        bench = card.bench
        match cue.kind:
            case CueKind.BEGIN:
                return self.walk(bench.begin, bench.direction)
            case CueKind.PAUSE:
                long, end = f"{cue.until - cue.since:.0f}", self.clock.words(cue.until)
                return say("Stand still until {end} ({long} s).", end=end, long=long)
            case CueKind.TURN:
                assert cue.turn is not None
                return self.turn(cue.turn)
            case CueKind.FASTEST:
                speed, head = bench.fastest.speed, bench.head_speed
                return say(
                    "Fastest: {speed:.2f} m/s (the head begins with {head:.2f} m/s).",
                    speed=speed,
                    head=head,
                )
            case CueKind.DONE:
                return say("Stop, {place}. Done.", place=self.at_mark(bench.done))
        assert cue.nearest is not None
        return self._met(cue, cue.nearest)

    def _met(self, cue: Cue, nearest: Meeting) -> str:
        gap = sense("apart", "{gap:.2f} m", gap=nearest.gap)
        if nearest.gap < 0.0:
            gap = say("overlapping by {depth:.2f} m", depth=-nearest.gap)
        how = say("It goes the other way") if nearest.oncoming else say("It goes your way")
        values = {"who": self._met_bench(nearest), "side": side_words(nearest), "gap": gap, "how": how}
        met = {meeting.bench for meeting in cue.meetings}
        since, until = self.clock.words(cue.since), self.clock.words(cue.until)
        if len(cue.meetings) == 1 or (len(met) == 1 and since == until):
            return say("{who} {side}, {gap}. {how}.", **values)
        span = say("from {since} to {until}", since=since, until=until)
        if since == until:
            span = say("at {time}", time=since)
        if len(met) == 1:
            return say(
                "{who} {side}, {gap} at the nearest of {times} times {span}. {how}.",
                times=len(cue.meetings),
                span=span,
                **values,
            )
        passing = say("pass you the other way") if nearest.oncoming else say("walk your way")
        return say(
            "{who} {side}, {gap}. Benches {met} {passing} {span}, none nearer then.",
            met=runs(met),
            passing=passing,
            span=span,
            **values,
        )

    def left_out(self, card: Card) -> str:
        """What has no place on the card; empty if all has one."""
        pauses, turns = (sum(cue.kind is kind for cue in card.left_out) for kind in (CueKind.PAUSE, CueKind.TURN))
        met = sum(len(cue.meetings) for cue in card.left_out)
        parts = []
        if met and card.least_left_out is not None:
            parts.append(
                counted(
                    met,
                    "{count} meeting, none nearer than {gap:.2f} m then",
                    "{count} meetings, none nearer than {gap:.2f} m then",
                    gap=card.least_left_out,
                )
            )
        if pauses:
            parts.append(counted(pauses, "{count} shorter pause", "{count} shorter pauses"))
        if turns:
            parts.append(counted(turns, "{count} lesser turn", "{count} lesser turns"))
        return say("Not on this card: {parts}.", parts=say("; ").join(parts)) if parts else ""

    def distances(self, card: Card) -> str:
        """What the distances of meetings mean; empty on a card without any."""
        if not any(cue.nearest for cue in (*card.cues, *card.left_out)):
            return ""
        return say(
            "Distances are from edge to edge at the time named; just before and after it a bench beside you may be "
            "nearer."
        )
