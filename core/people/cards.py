"""The cues of a card: at most CUES_MOST of all that happens to a bench, by one rule.

1. The beginning and the end are always on the card.
2. Then come the pauses, the longest first: every one that has a place.
3. Then the turns, those by the largest angle first: all of the head, which leads, and TURNS of another bench.
4. Then the fastest moment, if the bench is more than FASTER above the speed with which the head begins to walk.
5. Then the meetings, the nearest first. Meetings on one side, with benches of one dragon that go one way, of which each
   is at most TOGETHER after the one before, are one cue, whose moment and gap are those of the nearest of them.
6. Then the other turns.
What has no place any more is left out. Of equal ones the earlier comes first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from core.checks import checked_type
from core.display import Readable
from core.people.cues import BenchCues, Meeting, Side, Turning

# Most cues of a card, the beginning and the end among them.
CUES_MOST = 8
# Share of the speed at the beginning by which a bench must be faster for a cue [1].
FASTER = 0.01
# Turns of a bench behind the head that stand before its meetings.
TURNS = 3
# Longest time from one meeting to the next of the same cue [s].
TOGETHER = 10.0


class CueKind(StrEnum):
    """Kinds of cues, in the order in which they have a place on a card.

    >>> [kind.value for kind in CueKind]
    ['begin', 'done', 'pause', 'turn', 'fastest', 'meeting']
    """

    BEGIN = "begin"
    DONE = "done"
    PAUSE = "pause"
    TURN = "turn"
    FASTEST = "fastest"
    MEETING = "meeting"


@dataclass(frozen=True, slots=True, repr=False)
class Cue(Readable):
    """One cue: what happens, when, and where the bench is then.

    kind: begin, turn, pause, fastest, meeting or done
    time: moment of the cue: of several meetings, that of the nearest [s]
    x: x of the bench: of the front handle, in a meeting of the middle, or of the fastest handle [m]
    y: y of the same point [m]
    since: beginning of a pause or a turn, or moment of the first of several meetings; else the same as time [s]
    until: end of a pause or a turn, or moment of the last of several meetings; else the same as time [s]
    nearest: the meeting, or of several the one with the least gap; None in another kind of cue
    meetings: those of this cue in order of time; none in another kind of cue
    turn: the turn; None in another kind of cue

    >>> from core import Dance, Dragon, Spiral, bench_cues
    >>> cue = card_of(bench_cues(Dance(Dragon(60), Spiral()), [5], stop=60.0)[0]).cues[0]
    >>> cue.kind.value, cue.time
    ('begin', 0.0)
    """

    kind: CueKind
    time: float
    x: float
    y: float
    since: float
    until: float
    nearest: Meeting | None = None
    meetings: tuple[Meeting, ...] = ()
    turn: Turning | None = None


@dataclass(frozen=True, slots=True, repr=False)
class Card(Readable):
    """The cues of a bench that have a place on its card, and those left out.

    bench: all that its carriers have to know
    cues: cues on the card, in order of time
    left_out: cues that have no place on the card, in order of time

    >>> from core import Dance, Dragon, Spiral, bench_cues
    >>> card = card_of(bench_cues(Dance(Dragon(60), Spiral()), [5], stop=60.0)[0])
    >>> [cue.kind.value for cue in card.cues]
    ['begin', 'turn', 'meeting', 'meeting', 'done']
    """

    bench: BenchCues
    cues: tuple[Cue, ...]
    left_out: tuple[Cue, ...]

    @property
    def least_left_out(self) -> float | None:
        """Least gap of all meetings left out, each at its moment [m], None if none is."""
        return min((cue.nearest.gap for cue in self.left_out if cue.nearest), default=None)


def card_of(bench: BenchCues) -> Card:
    """The card of a bench, by the rule above. raises: InvalidValue for anything but the cues of a bench

    >>> from core import Dance, Dragon, Spiral, bench_cues
    >>> card_of(bench_cues(Dance(Dragon(60), Spiral()), [5], stop=60.0)[0]).cues[0].kind
    <CueKind.BEGIN: 'begin'>
    """
    checked_type("bench", bench, BenchCues)
    begin, done, fastest = bench.begin, bench.done, bench.fastest
    always = [
        Cue(CueKind.BEGIN, begin.time, begin.x, begin.y, begin.time, begin.time),
        Cue(CueKind.DONE, done.time, done.x, done.y, done.time, done.time),
    ]
    pauses = [Cue(CueKind.PAUSE, one.begin, one.x, one.y, one.begin, one.end) for one in bench.pauses]
    pauses.sort(key=lambda cue: cue.since - cue.until)
    peak = Cue(CueKind.FASTEST, fastest.time, fastest.x, fastest.y, fastest.time, fastest.time)
    peaks = [peak] if fastest.speed > (1.0 + FASTER) * bench.head_speed else []
    turns = [Cue(CueKind.TURN, one.begin, *one.way[0], one.begin, one.end, turn=one) for one in bench.turns]
    turns.sort(key=lambda cue: -abs(cue.turn.angle) if cue.turn else 0.0)
    first = len(turns) if bench.ahead is None else TURNS
    met = sorted(_together(bench.meetings), key=lambda cue: cue.nearest.gap if cue.nearest else 0.0)
    ranked = [*always, *pauses, *turns[:first], *peaks, *met, *turns[first:]]
    kept, rest = ranked[:CUES_MOST], ranked[CUES_MOST:]
    return Card(bench, *(tuple(sorted(cues, key=_order)) for cues in (kept, rest)))


def _order(cue: Cue) -> tuple[float, bool]:
    """Order on a card: of time, the end last."""
    return cue.time, cue.kind is CueKind.DONE


def _kind_of(one: Meeting) -> tuple[Side, bool, int | None]:
    """What meetings of one cue have in common."""
    return one.side, one.oncoming, one.dragon


def _together(meetings: Sequence[Meeting]) -> list[Cue]:
    """The cues of meetings, in order of time."""
    groups: list[list[Meeting]] = []
    for one in meetings:
        same = (group for group in groups if _kind_of(group[-1]) == _kind_of(one))
        group = next((group for group in same if one.time - group[-1].time <= TOGETHER), None)
        if group is None:
            groups.append([one])
        else:
            group.append(one)
    cues = []
    for group in groups:
        nearest = min(group, key=lambda one: one.gap)
        ends = group[0].time, group[-1].time
        cues.append(Cue(CueKind.MEETING, nearest.time, nearest.x, nearest.y, *ends, nearest, tuple(group)))
    return sorted(cues, key=lambda cue: cue.time)
