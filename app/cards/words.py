"""The cues of a card in words, in English or Chinese."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.maps.marks import first_mark, mark_name
from app.plan.timing import TimeFormat
from core import Dance
from core.language import Listed, counted, phrase, say, sense
from core.people.cards import Card, Cue, CueKind
from core.people.cues import Meeting, Side, Stand
from core.values import Point
from core.venue import Venue

# Points of the compass from north, clockwise.
COMPASS = (
    phrase("north"), phrase("north-east"), phrase("east"), phrase("south-east"), phrase("south"),
    phrase("south-west"), phrase("west"), phrase("north-west"),
)  # fmt: skip

# Directions on a plan, from the x axis counter-clockwise.
ON_PLAN = (
    phrase("to the right on the plan"), phrase("up and to the right on the plan"), phrase("up on the plan"),
    phrase("up and to the left on the plan"), phrase("to the left on the plan"),
    phrase("down and to the left on the plan"), phrase("down on the plan"), phrase("down and to the right on the plan"),
)  # fmt: skip
# Largest angle between a direction and a landmark in it [rad]; how near, how far and how wide the landmark may be [m].
AHEAD, NEAR, FAR, WIDE = math.radians(20.0), 3.0, 80.0, 15.0
# Names that nobody has given.
NAMELESS = re.compile(r"(?:obstacle|障碍物) \d+")


def landmarks_of(venue: Venue | None) -> list[tuple[str, Point]]:
    """Name and middle of the obstacles with a name that are small enough to walk towards."""
    marks = list[tuple[str, Point]]()
    for area in venue.obstacles if venue else ():
        xs, ys = zip(*area.rings[0], strict=True)
        if max(max(xs) - min(xs), max(ys) - min(ys)) <= WIDE and not NAMELESS.fullmatch(area.name):
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


@dataclass(frozen=True, slots=True)
class Chalk:
    """Chalk marks along the path: s of mark 0 [m], their spacing [m], and the length of a step [m]."""

    first: float
    spacing: float
    step: float

    @classmethod
    def of(cls, dance: Dance, tail: float, spacing: float, step: float) -> Chalk:
        """The marks of a dance whose tail starts at a place [m], as on its plan."""
        return cls(first_mark(dance, tail, spacing), spacing, step)

    def nearest(self, s: float) -> tuple[float, float]:
        """The mark nearest to a place on the path, by its length from mark 0 [m], and how far the place is past it [m];
        before it: < 0."""
        mark = self.spacing * math.floor((s - self.first) / self.spacing + 0.5)
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

        >>> words = CardWords(("", "Li"), TimeFormat(), Chalk(0.0, 5.0, 0.75), False)
        >>> words.neighbours(0, 1), words.direction(0.0)
        ('Before you: 0 (head).  Behind you: 1 Li.', ('to the right on the plan', '0°'))
        """
        before, after = (
            say("nobody") if bench is None else self._bench(bench, self.names[bench] if self.names else "")
            for bench in (ahead, behind)
        )
        return say("Before you: {before}.  Behind you: {after}.", before=before, after=after)

    def direction(self, angle: float) -> tuple[str, str]:
        """A direction [rad] and its degrees: a point of the compass, or how it is on the plan, from its x axis."""
        degrees = math.degrees(angle)
        if self.geographic:
            bearing = (90.0 - degrees) % 360.0
            number = sense("bearing", "{degrees:03d}°", degrees=round(bearing) % 360)
            return say(COMPASS[round(bearing / 45.0) % len(COMPASS)]), number
        return say(ON_PLAN[round(degrees / 45.0) % len(ON_PLAN)]), f"{round(degrees) % 360}°"

    def walk(self, begin: Stand, angle: float) -> str:
        """How a bench begins to walk in a direction [rad]: towards a thing that has a name, if one is there."""
        (to, number), mark = self.direction(angle), self._ahead(begin, angle)
        if mark is None:
            return say("Walk {to} ({number}).", to=to, number=number)
        return say("Walk towards “{mark}”, {to} ({number}).", mark=mark, to=to, number=number)

    def _ahead(self, begin: Stand, angle: float) -> str | None:
        """Name of the landmark that is nearest to a direction from a place [rad]; None if none is near it."""
        best, least = None, AHEAD
        for name, (x, y) in self.landmarks:
            dx, dy = x - begin.x, y - begin.y
            beside = abs(math.remainder(math.atan2(dy, dx) - angle, math.tau))
            if NEAR < math.hypot(dx, dy) < FAR and beside < least:
                best, least = name, beside
        return best

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
        side = say("straight on your left") if nearest.side is Side.LEFT else say("straight on your right")
        how = say("It goes the other way") if nearest.oncoming else say("It goes your way")
        values = {"who": self._met_bench(nearest), "side": side, "gap": gap, "how": how}
        if len(cue.meetings) == 1:
            return say("{who} {side}, {gap}. {how}.", **values)
        met = {meeting.bench for meeting in cue.meetings}
        since, until = self.clock.words(cue.since), self.clock.words(cue.until)
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
            "{who} {side}, {gap}. Benches {met} {passing} {span}, none nearer when straight beside you.",
            met=runs(met),
            passing=passing,
            span=span,
            **values,
        )

    def left_out(self, card: Card) -> str:
        """What has no place on the card; empty if all has one."""
        pauses = sum(cue.kind is CueKind.PAUSE for cue in card.left_out)
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
        return say("Not on this card: {parts}.", parts=say("; ").join(parts)) if parts else ""

    def distances(self, card: Card) -> str:
        """What the distances of meetings mean; empty on a card without any."""
        if not any(cue.nearest for cue in (*card.cues, *card.left_out)):
            return ""
        return say(
            "Distances are from edge to edge when the other bench is straight to your side; before "
            "and after it may be nearer.",
        )
