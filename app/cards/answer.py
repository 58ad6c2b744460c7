"""The answer of the question cues: the cards of one dragon, or of several, with the words of each cue."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Self

from pydantic import Field

from app.cards.words import CardWords
from app.wire.fields import Answer, measure
from core.people import cards as rule
from core.people import cues as facts
from core.people.cards import CUES_MOST, Card
from core.people.fastest import FastestMoment


class Neighbour(Answer):
    """Another bench.

    bench: its number; 0 is the head
    name: its name; empty without one
    """

    bench: int
    name: str


class Stand(Answer, of=facts.Stand):
    """A bench at one moment.

    clock: time of day then, if start_clock or begin_clock is given
    mark: the nearest chalk mark along the path, by its length from mark 0 [m]
    past_mark: way along the path from that mark to the front handle; below zero: before it [m]
    steps: the same in whole steps
    """

    time: float = measure("s")
    clock: str | None
    x: float
    y: float
    heading: float
    mark: float
    past_mark: float
    steps: int


class Meeting(Answer, of=facts.Meeting):
    """Another bench comes abreast, or nearest without that, with no bench between.
    Abreast: its middle is straight to one side of the own middle.

    clock: time of day then, if start_clock or begin_clock is given
    name: its name; empty without one
    """

    time: float
    clock: str | None
    bench: int
    name: str
    side: facts.Side
    gap: float
    ahead: float
    oncoming: bool
    x: float
    y: float


class Fastest(Answer, of=FastestMoment):
    """The moment at which a bench is fastest.

    speed_ratio: the same over the speed with which the head begins to walk
    """

    time: float = measure("s")
    speed: float
    speed_ratio: float
    handle: int
    x: float
    y: float


class Cue(Answer, of=rule.Cue):
    """One cue of a card.

    clock: time of day then, if start_clock or begin_clock is given
    count: nearest beat of the music then, such as 17.3 for the third of bar 17; null: none
    angle: angle of a turn, to the left above zero; null in another kind of cue [rad]
    nearest: the meeting, or the nearest of several; null in another kind of cue
    others: all benches met in this cue, in order of time; none in another kind of cue
    words: the cue in one sentence, in the language of the request
    """

    kind: rule.CueKind = Field(description="begin, turn, pause, fastest, meeting or done")
    time: float
    clock: str | None
    count: str | None
    since: float
    until: float
    x: float
    y: float
    angle: float | None
    nearest: Meeting | None
    others: list[int]
    words: str


class CueCard(Answer, of=facts.BenchCues):
    """What the carriers of one bench have to know.

    name: its name; empty without one
    begin: when it begins to walk
    left_out: cues that have no place on the card
    least_left_out: least gap of all meetings left out, each at its moment; null: none is [m]
    place: where its carriers stand at the start, in one sentence
    beside: who is before and behind it, in words
    """

    bench: int
    name: str
    ahead: Neighbour | None
    behind: Neighbour | None
    start: Stand
    begin: Stand
    direction: float
    cues: list[Cue] = Field(description=f"At most {CUES_MOST} cues in order of time, as on the card")
    left_out: int
    least_left_out: float | None
    meetings: list[Meeting]
    fastest: Fastest
    done: Stand
    place: str
    beside: str


class Cues(Answer):
    """The cue cards of a dance.

    cards: a card for each bench that was asked for, in order
    """

    cards: list[CueCard]

    @classmethod
    def of(cls, cards: list[Card], words: CardWords) -> Self:
        return cls(cards=[_card(card, words) for card in cards])


class DragonMeeting(Meeting):
    """A bench of one of several dragons comes abreast.

    dragon: the dragon of the other bench, in the order of the dances
    dragon_name: its name, or its number in words
    """

    dragon: int
    dragon_name: str


class DragonCue(Cue):
    """One cue of a card of one of several dragons.

    nearest: the meeting, or the nearest of several, all with benches of one dragon; null in another kind
    """

    nearest: DragonMeeting | None


class DragonCueCard(CueCard):
    """What the carriers of one bench of one of several dragons have to know; times are those of the performance.

    dragon: the dragon, in the order of the dances
    dragon_name: its name, or its number in words
    meetings: all meetings within the reach, with benches of any dragon, in order of time
    """

    dragon: int
    dragon_name: str
    cues: list[DragonCue] = Field(  # type: ignore[assignment]
        description=f"At most {CUES_MOST} cues in order of time, as on the card"
    )
    meetings: list[DragonMeeting]  # type: ignore[assignment]


class PerformanceCues(Answer):
    """The cue cards of several dragons.

    cards: a card for each bench that was asked for, dragon by dragon
    """

    cards: list[DragonCueCard]

    @classmethod
    def together(cls, decks: Iterable[tuple[list[Card], CardWords]]) -> Self:
        return cls(cards=[_dragon_card(card, words) for cards, words in decks for card in cards])


def _neighbour(bench: int | None, words: CardWords) -> Neighbour | None:
    return None if bench is None else Neighbour(bench=bench, name=words.names[bench] if words.names else "")


def _stand(at: facts.Stand, words: CardWords) -> Stand:
    mark, past = words.chalk.nearest(at.s)
    own = {"clock": words.clock.of_day(at.time), "mark": mark, "past_mark": past, "steps": words.chalk.steps(past)}
    return Stand.from_result(at, **own)


def _meeting(one: facts.Meeting, words: CardWords) -> Meeting:
    own = {"name": words.met_name(one), "clock": words.clock.of_day(one.time)}
    if one.dragon is None:
        return Meeting.from_result(one, **own)
    return DragonMeeting.from_result(one, dragon_name=words.dragons[one.dragon][0], **own)


def _dragon_card(card: Card, words: CardWords) -> DragonCueCard:
    assert words.dragon is not None
    values = _values(card, words, DragonCue)
    return DragonCueCard(**values, dragon=words.dragon, dragon_name=words.dragons[words.dragon][0])


def _card(card: Card, words: CardWords) -> CueCard:
    return CueCard(**_values(card, words, Cue))


def _values(card: Card, words: CardWords, kind: type[Cue]) -> dict[str, Any]:
    """The fields of a card. kind: of its cues"""
    bench = card.bench
    cues = [
        kind.from_result(
            cue, clock=words.clock.of_day(cue.time), count=words.clock.count(cue.time) or None,
            angle=cue.turn and cue.turn.angle, nearest=cue.nearest and _meeting(cue.nearest, words),
            others=[one.bench for one in cue.meetings], words=words.sentence(card, cue),
        )
        for cue in card.cues
    ]  # fmt: skip
    ratio = bench.fastest.speed / bench.head_speed
    return {
        "bench": bench.bench,
        "name": words.names[bench.bench] if words.names else "",
        "ahead": _neighbour(bench.ahead, words),
        "behind": _neighbour(bench.behind, words),
        "start": _stand(bench.start, words),
        "begin": _stand(bench.begin, words),
        "direction": bench.direction,
        "cues": cues,
        "left_out": len(card.left_out),
        "least_left_out": card.least_left_out,
        "meetings": [_meeting(one, words) for one in bench.meetings],
        "fastest": Fastest.from_result(bench.fastest, speed_ratio=ratio),
        "done": _stand(bench.done, words),
        "place": words.standing(bench.start),
        "beside": words.neighbours(bench.ahead, bench.behind),
    }
