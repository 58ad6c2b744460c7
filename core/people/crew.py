"""Crew: who carries which bench when, with spare carriers who take over.

People are numbered from 0: first those who carry bench 0 at the start, then those of bench 1, ..., then the spares.
Changes are at moments, for some benches each: for all when a shift ends, for one when its front handle passes a place.
At a moment, as many carriers of these benches go out as there are spares who have rested long enough. Those go out who
have carried longest without a break; of equal ones those of the bench further ahead. Those come in who have rested
longest. So nobody who goes out comes in again at the same moment, and a spare never waits while another one who has
rested less comes in.

How each number is known: the way of a carrier is that of the front handle of the bench along the path, from taking
over to handing over, exact as the places of handle_places(). Shifts end at their moments exactly; the moment at which a
bench passes a place is that of Passing, within a centimetre of the place.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from core.checks import checked_count, checked_number, checked_type
from core.dance import Dance
from core.display import Readable
from core.errors import InvalidValue, TooLarge
from core.kernels import Budget
from core.language import phrase
from core.motion.places import Passing, handle_places
from core.passages import S_MAX
from core.paths.path import Path
from core.quantities import Quantity
from core.questions import question_about
from core.sampling import bisect, dips
from core.values import Floats

# Nobody comes in for less than this before the end [s]: a moment that rounding alone keeps from it is the end.
SPELL_LEAST = 1e-3
# Most people of one crew, on one bench, spells of all together, and places of changes.
PEOPLE_MAX, ON_BENCH_MAX, SPELLS_MAX, PLACES_MAX = 20_000, 50, 100_000, 200
PEOPLE_RULE = phrase("people must be at most {most}, spares among them")
CHANGES_RULE = phrase("changes of people must be at most {most}")
FEWER_CHANGES = phrase("take longer shifts, fewer places or a shorter dance")
# Longest shift and rest [s].
SHIFT_MAX = 1e6
# Distance of the samples of a path around a point, and width to which its nearest place is narrowed [m]; most samples.
SAMPLE, NARROW, SAMPLES_MAX = 0.25, 1e-9, 1_000_000
# Places of handles that are held at once.
CELLS = 1_000_000


@dataclass(frozen=True, slots=True, repr=False)
class Spell(Readable):
    """A time in which one person carries one bench.

    person: number of the person
    bench: number of the bench; 0 is the head
    begin: its begin [s]
    end: its end [s]
    s: arc length of the bench's front handle along the path at the begin [m]
    until_s: arc length of it at the end [m]
    relieved: the person who went out; None at the start

    >>> from core import Dragon, Spiral
    >>> spell = crew(Dance(Dragon(3), Spiral()), [8, 2, 2], Relief(spares=4, shift=60.0), stop=120.0).spells[0]
    >>> spell.person, spell.bench, spell.begin, spell.end
    (0, 0, 0.0, 60.0)
    """

    person: int
    bench: int
    begin: float
    end: float
    s: float
    until_s: float
    relieved: int | None

    @property
    def way(self) -> float:
        """The way carried [m]."""
        return self.until_s - self.s


@dataclass(frozen=True, slots=True, repr=False)
class Carried(Readable):
    """What one person carries in all.

    time: time carried in all [s]
    way: way carried in all [m]
    longest: longest time carried without a break [s]

    >>> from core import Dragon, Spiral
    >>> crew(Dance(Dragon(3), Spiral()), [8, 2, 2], Relief(spares=4, shift=60.0), stop=120.0).carried[8]
    <Carried: time 120 s, way 119.995215 m, longest 120 s>
    """

    time: float
    way: float
    longest: float


@dataclass(frozen=True, slots=True, repr=False)
class Crew(Readable):
    """The spells of all people, in order of their begin, then of benches.

    people: number of people, spares among them
    spares: those among them who carry nothing at the start
    start: begin of the first spells [s]
    stop: end of the last spells [s]
    needed: people on each bench
    spells: the spells
    enough: least number of spares with which everybody goes out at every change of their bench; 0: no changes
    unrelieved: benches that have changes, and of which nobody ever goes out

    >>> from core import Dragon, Spiral
    >>> crew(Dance(Dragon(3), Spiral()), [8, 2, 2], Relief(spares=4, shift=60.0), stop=120.0).enough
    12
    """

    people: int
    spares: int
    start: float
    stop: float
    needed: tuple[int, ...]
    spells: tuple[Spell, ...]
    enough: int = 0
    unrelieved: tuple[int, ...] = ()

    @property
    def is_kept(self) -> bool:
        """True if everybody goes out at every change of their bench."""
        return self.spares >= self.enough

    def on_benches(self, time: float) -> list[list[int]]:
        """The people on each bench at a time [s]; at a change those who come in. Nobody outside the dance."""
        benches: list[list[int]] = [[] for _ in self.needed]
        for one in self.spells:
            if one.begin <= time < one.end or time == one.end == self.stop:
                benches[one.bench].append(one.person)
        return benches

    def of(self, person: int) -> list[Spell]:
        """The spells of one person, in order of time."""
        return [one for one in self.spells if one.person == person]

    @property
    def carried(self) -> list[Carried]:
        """What each person carries."""
        sums = np.zeros((self.people, 3))
        for one in self.spells:
            row = sums[one.person]
            row += one.end - one.begin, one.way, 0.0
            row[2] = max(row[2], one.end - one.begin)
        return [Carried(*row) for row in sums.tolist()]


@dataclass(frozen=True, slots=True)
class Relief(Readable):
    """The rules by which people change.

    spares: number of people beside those who carry at the start
    shift: time after which all benches change, again and again; None: never [s]
    places: arc lengths along the path; a bench changes when its front handle passes one of them [m]
    rest: least time from going out to coming in again [s]

    >>> from core import Dragon, Spiral
    >>> relief = Relief(spares=4, shift=60.0)
    >>> crew(Dance(Dragon(3), Spiral()), [8, 2, 2], relief, stop=120.0).people
    16
    """

    spares: int = 0
    shift: float | None = None
    places: Sequence[float] = ()
    rest: float = 0.0


@question_about("dance", Dance, "the crew was not planned")
def crew(
    dance: Dance,
    needed: Sequence[int],
    relief: Relief = Relief(),
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> Crew:
    """Who carries which bench when.

    needed: people on each bench; relief: how they change; start, stop: of the dance [s], see Dance.span()
    raises: InvalidValue; OutsideRun; TooLarge; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> result = crew(Dance(Dragon(3), Spiral()), [8, 2, 2], Relief(spares=4, shift=60.0), stop=120.0)
    >>> result.people, len(result.spells), result.on_benches(90.0)[1], round(result.carried[8].way, 3)
    (16, 16, [8, 9], 119.995)
    """
    begin, until = dance.span(start, stop)
    benches, budget = _checked_needed(dance, needed), budget or Budget()
    relief = _checked_relief(relief, len(benches), until - begin)
    changes = dict[float, frozenset[int]]()
    if relief.shift is not None:
        everyone = frozenset(range(dance.dragon.benches))
        moments = (begin + relief.shift * k for k in range(1, int((until - begin) / relief.shift) + 1))
        changes = {moment: everyone for moment in moments if moment < until - SPELL_LEAST}
    if relief.places:
        passing = Passing(dance, begin, until, budget=budget)
        for s in relief.places:
            for bench in range(dance.dragon.benches):
                if (time := passing.when(bench, s)) is not None and begin + SPELL_LEAST < time < until - SPELL_LEAST:
                    changes[time] = changes.get(time, frozenset()) | {bench}
    turns = _Turns(benches, relief.spares, begin, relief.rest)
    for time in sorted(changes):
        budget.afford(float(len(changes[time])))
        turns.change(time, changes[time])
    turns.finish(until)
    counts, people = tuple(map(int, needed)), len(benches) + relief.spares
    relieved = {bench for _, bench, _, _, out in turns.spells if out is not None}
    unrelieved = frozenset[int]().union(*changes.values()) - relieved
    spells, enough = _with_places(dance, turns.spells, budget), _enough(changes, counts, relief.rest)
    return Crew(people, relief.spares, begin, until, counts, spells, enough, tuple(sorted(unrelieved)))


def _enough(changes: Mapping[float, frozenset[int]], needed: Sequence[int], rest: float) -> int:
    """Least number of spares with which everybody goes out at every change of their bench.

    Let n(t) be the number of people on the benches that change at t. Where all of them go out, those who went out at
    t' with t - t' < rest, or at t itself, rest at t, and n(t) spares who do not must come in. So the spares must be at
    least the sum of n(t') over all t' <= t with t - t' < rest, with n(t) in it, for every t. The largest of these sums
    is enough too: then at least n(t) have rested long enough at every t.

    changes: the benches that change at each moment [s]; needed: people on each bench; rest: [s]
    """
    total, most, resting = sum(needed), 0, 0
    recent = deque[tuple[float, int]]()
    for time, benches in sorted(changes.items()):
        count = total if len(benches) == len(needed) else sum(needed[bench] for bench in benches)
        while recent and time - recent[0][0] >= rest:
            resting -= recent.popleft()[1]
        recent.append((time, count))
        resting += count
        most = max(most, resting)
    return most


@dataclass
class _Turns:
    """State: who carries at each place, since when [s], and who waits, in the order in which they went out.

    benches: the bench of each place of a carrier; waiting: (time since which a spare rests [s], person)
    spells: (person, bench, begin, end, relieved person)
    """

    benches: list[int]
    spares: int
    begin: float
    rest: float
    spells: list[tuple[int, int, float, float, int | None]] = field(default_factory=list)

    def __post_init__(self) -> None:
        count = len(self.benches)
        self.holders, self.since = list(range(count)), [self.begin] * count
        self.relieved: list[int | None] = [None] * count
        self.waiting = deque((self.begin - self.rest, count + k) for k in range(self.spares))
        self.of_bench: dict[int, list[int]] = {}
        for k, bench in enumerate(self.benches):
            self.of_bench.setdefault(bench, []).append(k)

    def change(self, time: float, changing: frozenset[int]) -> None:
        """Let those of some benches go out who have carried longest. time: [s]"""
        leaving = sorted((k for bench in changing for k in self.of_bench[bench]), key=lambda k: (self.since[k], k))
        for k in leaving:
            if not self.waiting or time - self.waiting[0][0] < self.rest or self.waiting[0][0] == time:
                return
            _, person = self.waiting.popleft()
            out = self._end(k, time)
            self.waiting.append((time, out))
            self.holders[k], self.since[k], self.relieved[k] = person, time, out

    def finish(self, until: float) -> None:
        for k in range(len(self.benches)):
            self._end(k, until)

    def _end(self, k: int, time: float) -> int:
        """End the spell at a place; returns its person. raises: TooLarge"""
        if len(self.spells) == SPELLS_MAX:
            raise TooLarge.in_words("relief.shift", CHANGES_RULE, reason=FEWER_CHANGES, most=SPELLS_MAX)
        self.spells.append((self.holders[k], self.benches[k], self.since[k], time, self.relieved[k]))
        return self.holders[k]


def places_near(path: Path, point: Sequence[float], begin: float, end: float, within: float) -> list[float]:
    """Places along a path at which it passes a point [m]: the nearest one of each time that it comes near.

    point: x, y [m]; begin, end: of the stretch looked at, s [m]; within: largest distance of a place from the point [m]
    It misses no pass that is apart from others by more than SAMPLE along the path.

    >>> from core import Line, Route
    >>> [round(s, 6) for s in places_near(Route([Line((0.0, 0.0), (40.0, 0.0))]), (10.0, 1.0), 0.0, 40.0, 2.0)]
    [10.0]
    """
    count = min(SAMPLES_MAX, int((end - begin) / SAMPLE) + 3)
    s, at = np.linspace(begin, end, count), np.asarray(point, dtype=np.float64)

    def away(place: Floats | float) -> Floats:
        gap: Floats = np.hypot(*np.moveaxis(path.position(place) - at, -1, 0))
        return gap

    def goes_away(place: float) -> bool:
        return bool((path.position(place) - at) @ path.tangent(place) >= 0.0)

    samples, places = away(s), list[float]()
    step = (end - begin) / (count - 1)
    for k in sorted(dips(samples, count).tolist()):
        if samples[k] <= within + step:
            low, high = float(s[k - 1]), float(s[k + 1])
            nearest = 0.5 * sum(bisect(goes_away, low, high, width=NARROW))
            if float(away(nearest)) <= within and (not places or nearest > places[-1] + NARROW):
                places.append(nearest)
    return places


def _checked_needed(dance: Dance, needed: Sequence[int]) -> list[int]:
    """The bench of each carrier at the start. raises: InvalidValue"""
    checked_type("needed", needed, (list, tuple))
    if len(needed) != dance.dragon.benches:
        rule = "must have a number of people for each of the {benches} benches"
        raise InvalidValue("needed", rule, got=len(needed), benches=dance.dragon.benches)
    for k, count in enumerate(needed):
        checked_count(f"needed.{k}", count, 1, ON_BENCH_MAX)
    total = int(sum(needed))
    if total > PEOPLE_MAX:
        raise TooLarge.in_words("needed", PEOPLE_RULE, got=total, most=PEOPLE_MAX)
    return [bench for bench, count in enumerate(needed) for _ in range(int(count))]


def _checked_relief(relief: Relief, carriers: int, duration: float) -> Relief:
    """The rules, checked. carriers: people at the start; duration: of the dance [s]. raises: InvalidValue, TooLarge"""
    checked_type("relief", relief, Relief)
    spares = checked_count("relief.spares", relief.spares, 0, PEOPLE_MAX)
    if carriers + spares > PEOPLE_MAX:
        raise TooLarge.in_words("relief.spares", PEOPLE_RULE, got=carriers + spares, most=PEOPLE_MAX)
    if len(relief.places) > PLACES_MAX:
        raise InvalidValue("relief.places", "must be at most {most}", got=len(relief.places), most=PLACES_MAX)
    places = [checked_number(f"relief.places.{k}", s, "m", -S_MAX, S_MAX) for k, s in enumerate(relief.places)]
    shift = relief.shift
    if shift is not None:
        shift = checked_number("relief.shift", shift, "s", 0.0, SHIFT_MAX, open_low=True)
        if shift >= duration:
            rule, most = "must be shorter than the dance, which takes {most}", Quantity(duration, "s", 9)
            raise InvalidValue("relief.shift", rule, got=Quantity(shift, "s"), most=most)
        if duration / shift > SPELLS_MAX:
            raise TooLarge.in_words("relief.shift", CHANGES_RULE, reason=FEWER_CHANGES, most=SPELLS_MAX)
    if not spares and (places or shift is not None):
        raise InvalidValue("relief.spares", "must be at least 1 where people change: nobody could come in", got=0)
    rest = checked_number("relief.rest", relief.rest, "s", 0.0, SHIFT_MAX)
    return Relief(spares, shift, tuple(places), rest)


def _with_places(
    dance: Dance, turns: Sequence[tuple[int, int, float, float, int | None]], budget: Budget
) -> tuple[Spell, ...]:
    """Spells with the places of the bench's front handle."""
    ends = sorted({(time, bench) for _, bench, *two, _ in turns for time in two})
    times, s = sorted({time for time, _ in ends}), dict[tuple[float, int], float]()
    at_once = max(1, CELLS // (dance.dragon.benches + 1))
    for first in range(0, len(times), at_once):
        some = times[first : first + at_once]
        rows = dict(zip(some, handle_places(dance, some, budget=budget), strict=True))
        s |= {end: float(rows[end[0]][end[1]]) for end in ends if end[0] in rows}
    spells = [
        Spell(person, bench, begin, end, s[begin, bench], s[end, bench], relieved)
        for person, bench, begin, end, relieved in turns
    ]
    return tuple(sorted(spells, key=lambda one: (one.begin, one.bench, one.person)))
