"""The cues of a card in words, in English or Chinese."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.files.words import Say
from app.maps.marks import first_mark, mark_name
from app.plan.timing import TimeFormat
from core import Dance
from core.people.cards import Card, Cue, CueKind
from core.people.cues import Meeting, Side, Stand
from core.values import Point
from core.venue import Venue

# Points of the compass from north, clockwise.
COMPASS = (
    ("north", "北"), ("north-east", "东北"), ("east", "东"), ("south-east", "东南"), ("south", "南"),
    ("south-west", "西南"), ("west", "西"), ("north-west", "西北"),
)  # fmt: skip

# Directions on a plan, from the x axis counter-clockwise.
ON_PLAN = (
    ("to the right", "右方"), ("up and to the right", "右上方"), ("up", "上方"), ("up and to the left", "左上方"),
    ("to the left", "左方"), ("down and to the left", "左下方"), ("down", "下方"), ("down and to the right", "右下方"),
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
    return ", ".join(f"{part[0]}-{part[-1]}" if len(part) > 1 else str(part[0]) for part in parts)


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

    say: Say
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
        own = self.met_name(met)
        chinese = f"{met.bench} 号板凳{own and f'（{own}）'}"
        if met.dragon in (None, self.dragon):
            return self.say(f"Bench {self.name(met.bench)}", chinese)
        dragon, number = self.dragons[met.dragon][0], own or ("(head)" if met.bench == 0 else "")
        return self.say(f"Bench {f'{met.bench} {number}'.rstrip()} of {dragon}", f"{dragon}的 {chinese}")

    def name(self, bench: int) -> str:
        """Number and name of a bench.

        >>> from app.files.tables import Language
        >>> words = CardWords(Say(Language.ENGLISH), ("", "Li"), TimeFormat(), Chalk(0.0, 5.0, 0.75), False)
        >>> words.name(0), words.name(1), words.direction(0.0)
        ('0 (head)', '1 Li', ('to the right on the plan', '0°'))
        """
        own = self.names[bench] if self.names else ""
        return f"{bench} {own}" if own else self.say("0 (head)", "0（龙头）") if bench == 0 else str(bench)

    def neighbours(self, ahead: int | None, behind: int | None) -> str:
        """Who is before and behind a bench; None: nobody."""
        before, after = self._neighbour(ahead), self._neighbour(behind)
        return self.say(f"Before you: {before}.  Behind you: {after}.", f"前面：{before}    后面：{after}")

    def _neighbour(self, bench: int | None) -> str:
        if bench is None:
            return self.say("nobody", "无")
        own = self.names[bench] if self.names else ""
        chinese = f"{bench} 号" if bench else "龙头"
        return self.say(self.name(bench), f"{chinese}（{own}）" if own else chinese)

    def direction(self, angle: float) -> tuple[str, str]:
        """A direction [rad] and its degrees: a point of the compass, or how it is on the plan, from its x axis."""
        degrees = math.degrees(angle)
        if self.geographic:
            bearing = (90.0 - degrees) % 360.0
            number = f"{round(bearing) % 360:03d}°"
            return self.say(*COMPASS[round(bearing / 45.0) % len(COMPASS)]), self.say(number, f"方位 {number}")
        english, chinese = ON_PLAN[round(degrees / 45.0) % len(ON_PLAN)]
        return self.say(f"{english} on the plan", f"图上{chinese}"), f"{round(degrees) % 360}°"

    def walk(self, begin: Stand, angle: float) -> str:
        """How a bench begins to walk in a direction [rad]: towards a thing that has a name, if one is there."""
        (to, number), mark = self.direction(angle), self._ahead(begin, angle)
        if mark is None:
            return self.say(f"Walk {to} ({number}).", f"起步，朝{to}走（{number}）。")
        return self.say(f"Walk towards “{mark}”, {to} ({number}).", f"起步，朝{mark}方向走（{to}，{number}）。")

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
            return self.say(f"at chalk mark {mark} m", f"在 {mark} m 粉笔标记处")
        unit, where = "step" if abs(steps) == 1 else "steps", "past" if steps > 0 else "before"
        chinese = f"过 {mark} m 粉笔标记 {steps} 步" if steps > 0 else f"距 {mark} m 粉笔标记还差 {-steps} 步"
        return self.say(f"{abs(steps)} {unit} {where} chalk mark {mark} m", chinese)

    def sentence(self, card: Card, cue: Cue) -> str:
        """A cue in one sentence, without its time."""
        say, bench = self.say, card.bench
        match cue.kind:
            case CueKind.BEGIN:
                return self.walk(bench.begin, bench.direction)
            case CueKind.PAUSE:
                long, end = f"{cue.until - cue.since:.0f}", self.clock.words(cue.until)
                return say(f"Stand still until {end} ({long} s).", f"停下，至 {end}（{long} 秒）。")
            case CueKind.FASTEST:
                speed, head = bench.fastest.speed, bench.head_speed
                return say(
                    f"Fastest: {speed:.2f} m/s (the head begins with {head:.2f} m/s).",
                    f"最快：{speed:.2f} m/s（龙头起步时 {head:.2f} m/s）。",
                )
            case CueKind.DONE:
                return say(f"Stop, {self.at_mark(bench.done)}. Done.", f"停，{self.at_mark(bench.done)}。结束。")
        assert cue.nearest is not None
        return self._met(cue, cue.nearest)

    def _met(self, cue: Cue, nearest: Meeting) -> str:
        say, gap = self.say, self.say(f"{nearest.gap:.2f} m", f"距 {nearest.gap:.2f} m")
        if nearest.gap < 0.0:
            gap = say(f"overlapping by {-nearest.gap:.2f} m", f"重叠 {-nearest.gap:.2f} m")
        left = nearest.side is Side.LEFT
        side = say(f"straight on your {'left' if left else 'right'}", f"在正{'左' if left else '右'}方")
        how = say("It goes the other way", "反向") if nearest.oncoming else say("It goes your way", "同向")
        who = self._met_bench(nearest)
        if len(cue.meetings) == 1:
            return say(f"{who} {side}, {gap}. {how}.", f"{who}{side}，{gap}，与你{how}。")
        met = {one.bench for one in cue.meetings}
        others = say(runs(met), runs(met).replace(", ", "、"))
        since, until = self.clock.words(cue.since), self.clock.words(cue.until)
        if len(met) == 1:
            times = len(cue.meetings)
            span = (
                say(f"from {since} to {until}", f"{since} 至 {until}") if since != until else say(f"at {since}", since)
            )
            return say(
                f"{who} {side}, {gap} at the nearest of {times} times {span}. {how}.",
                f"{who}{side}，{span}，{times} 次，最近时{gap}，与你{how}。",
            )
        hows = "pass you the other way" if nearest.oncoming else "walk your way"
        return say(
            f"{who} {side}, {gap}. Benches {others} {hows} from {since} to {until}, none nearer when "
            "straight beside you.",
            f"{who}{side}，{gap}。{since} 至 {until}，{others} 号与你{how}经过，在正侧方时都不比它近。",
        )

    def left_out(self, card: Card) -> str:
        """What has no place on the card; empty if all has one."""
        say, pauses = self.say, sum(cue.kind is CueKind.PAUSE for cue in card.left_out)
        met = sum(len(cue.meetings) for cue in card.left_out)
        parts = []
        if met and card.least_left_out is not None:
            words = f"{card.least_left_out:.2f} m"
            plural = "meeting" if met == 1 else "meetings"
            parts.append(say(f"{met} {plural}, none nearer than {words} then", f"{met} 次相遇（当时均不近于 {words}）"))
        if pauses:
            parts.append(say(f"{pauses} shorter pause{'s' * (pauses > 1)}", f"{pauses} 次较短停顿"))
        return say("Not on this card: ", "本卡未列：") + say("; ", "；").join(parts) + say(".", "。") if parts else ""

    def distances(self, card: Card) -> str:
        """What the distances of meetings mean; empty on a card without any."""
        if not any(cue.nearest for cue in (*card.cues, *card.left_out)):
            return ""
        return self.say(
            "Distances are from edge to edge when the other bench is straight to your side; before and after it may be "
            "nearer.",
            "距离是对方在你正侧方时两凳边到边的距离，此前此后可能更近。",
        )
