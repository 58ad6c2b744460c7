"""The question cues: what the carriers of each bench have to know, as JSON, as a table, and as cards on paper."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Annotated, Self

from pydantic import Field

import core
from app.cards.tables import cards_csv
from app.cards.words import CardWords, Chalk
from app.files.tables import CSV_TYPE, Language
from app.files.words import Say
from app.plan.timing import TimeFormat
from app.questions.check import verdict_of
from app.questions.maps import Marked
from app.questions.plan import FIRST_CHINESE, PDF_TYPE, verdict_words
from app.wire.clocks import time_of_day
from app.wire.dances import clock_of
from app.wire.degrees import Place
from app.wire.question import AS_WHOLE, JSON, Answer, OneLine, Question, Terms, measure
from core import Dance, InvalidValue
from core.errors import Given, Parameter, TooLarge
from core.motion.places import handle_places
from core.people import cards as rule
from core.people import cues as facts
from core.people.cards import CUES_MOST, Card, card_of
from core.people.cues import FOLLOWED_MAX, REACH, REACH_MAX, bench_cues

# Estimated time of the cues of a bench and of its card on paper [s], measured 2026-11-27.
SECONDS_PER_BENCH, SECONDS_PER_CARD = 0.02, 0.05

BenchNumber = Annotated[int, Field(ge=0), AS_WHOLE]


class CuesRequest(Marked, strict=True):
    """A dance, as for /check, and the benches that get cards."""

    first_bench: BenchNumber | None = Field(
        None, description=f"First bench with a card, 0 for the head; at most {FOLLOWED_MAX} get one; null: the head"
    )
    last_bench: BenchNumber | None = Field(None, description="Last bench with a card; null: the tail")
    cards: list[BenchNumber | str] | None = Field(
        None,
        min_length=1,
        max_length=FOLLOWED_MAX,
        description="Benches with cards, each by its name or its number, in place of first_bench and last_bench",
    )
    reach: float = measure(
        "m", "Largest gap of a meeting: a bench that comes abreast further away is no cue", REACH, ge=0, le=REACH_MAX
    )
    step_length: float = measure(
        "m", "Length of a step, in which distances from chalk marks are counted", 0.75, ge=0.2, le=2
    )
    title: OneLine = Field("", max_length=80, description="Title of the dance on every card")
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh", strict=False)

    def benches_of(self, dragon: core.Dragon) -> Sequence[int]:
        """The benches that get cards. raises: InvalidValue, TooLarge"""
        count = dragon.benches
        if self.cards is not None:
            for name in ("first_bench", "last_bench"):
                if getattr(self, name) is not None:
                    rule, other = "must be left out beside {other}", Parameter("cards")
                    raise InvalidValue(name, rule, got=getattr(self, name), other=other)
            return [_bench_of(f"cards.{k}", one, dragon) for k, one in enumerate(self.cards)]
        first = 0 if self.first_bench is None else self.first_bench
        last = count - 1 if self.last_bench is None else self.last_bench
        for name, bench in (("first_bench", first), ("last_bench", last)):
            if bench >= count:
                raise InvalidValue(name, "must be at most {most}, the tail", got=bench, most=count - 1)
        if last < first:
            raise InvalidValue("last_bench", "must not be before first_bench ({first})", got=last, first=first)
        if last - first >= FOLLOWED_MAX:
            rule = "cards must be at most {most}: choose the benches with first_bench and last_bench"
            raise TooLarge.in_words("last_bench", rule, got=last - first + 1, most=FOLLOWED_MAX)
        return range(first, last + 1)


def _bench_of(field: str, word: int | str, dragon: core.Dragon) -> int:
    """The bench with that name, or else that number. raises: InvalidValue"""
    if isinstance(word, str):
        if word and word in dragon.names:
            return dragon.names.index(word)
        if not re.fullmatch(r"\d{1,9}", word, re.ASCII):
            raise InvalidValue(field, "must be the name or the number of a bench", got=Given(word))
    if int(word) >= dragon.benches:
        raise InvalidValue(field, "must be at most {most}, the tail", got=int(word), most=dragon.benches - 1)
    return int(word)


class Neighbour(Answer):
    """Another bench."""

    bench: int = Field(description="Its number; 0 is the head")
    name: str = Field(description="Its name; empty without one")


class Stand(Answer):
    """A bench at one moment."""

    time: float = measure("s")
    clock: str | None = Field(description="Time of day then, if start_clock or begin_clock is given")
    x: float = measure("m", "x of its front handle")
    y: float = measure("m", "y of its front handle")
    heading: float = measure("rad", "Direction from its rear to its front handle")
    mark: float = measure("m", "The nearest chalk mark along the path, by its length from mark 0")
    past_mark: float = measure("m", "Way along the path from that mark to the front handle; below zero: before it")
    steps: int = Field(description="The same in whole steps")


class Meeting(Answer):
    """Another bench comes abreast: its middle is straight to one side of the own middle, with no bench between."""

    time: float = measure("s", "When the other middle is abreast, to within 1e-9 m along the own bench")
    clock: str | None = Field(description="Time of day then, if start_clock or begin_clock is given")
    bench: int = Field(description="The other bench; 0 is the head")
    name: str = Field(description="Its name; empty without one")
    side: facts.Side = Field(description="Side on which it is, seen in the direction of the front handle")
    gap: float = measure("m", "Gap of the two benches then, edge to edge; below zero: minus the depth of the overlap")
    oncoming: bool = Field(description="True if it comes towards the own bench; false if it walks the same way")
    x: float = measure("m", "x of the own middle then")
    y: float = measure("m", "y of the own middle then")


class Fastest(Answer):
    """The moment at which a bench is fastest."""

    time: float = measure("s")
    speed: float = measure(
        "m/s", "Higher speed of its two handles: reached then, and not exceeded every 0.25 m of head way"
    )
    speed_ratio: float = Field(description="The same over the speed with which the head begins to walk")
    handle: int = Field(description="The handle: the number of the bench, or one more for its rear one")
    x: float = measure("m", "x of that handle then")
    y: float = measure("m", "y of that handle then")


class Cue(Answer):
    """One cue of a card."""

    kind: rule.CueKind = Field(description="begin, pause, fastest, meeting or done")
    time: float = measure("s", "Moment of the cue: of several meetings, that of the nearest")
    clock: str | None = Field(description="Time of day then, if start_clock or begin_clock is given")
    count: str | None = Field(
        description="Nearest beat of the music then, such as 17.3 for the third of bar 17; null: none"
    )
    since: float = measure(
        "s", "Beginning of a pause, or moment of the first of several meetings; else the same as time"
    )
    until: float = measure("s", "End of a pause, or moment of the last of several meetings; else the same as time")
    x: float = measure("m", "x of the bench: of the front handle, in a meeting of the middle, or of the fastest handle")
    y: float = measure("m", "y of the same point")
    nearest: Meeting | None = Field(description="The meeting, or the nearest of several; null in another kind of cue")
    others: list[int] = Field(description="All benches met in this cue, in order of time; none in another kind of cue")
    words: str = Field(description="The cue in one sentence, in the language of the request")


class CueCard(Answer):
    """What the carriers of one bench have to know."""

    bench: int = Field(description="Number of the bench; 0 is the head")
    name: str = Field(description="Its name; empty without one")
    ahead: Neighbour | None = Field(description="The bench before it; null for the head")
    behind: Neighbour | None = Field(description="The bench behind it; null for the tail")
    start: Stand = Field(description="Where it stands when the dance starts")
    begin: Stand = Field(description="When it begins to walk")
    direction: float = measure("rad", "Direction in which its front handle begins to walk, from the x axis")
    cues: list[Cue] = Field(description=f"At most {CUES_MOST} cues in order of time, as on the card")
    left_out: int = Field(description="Cues that have no place on the card")
    least_left_out: float | None = measure(
        "m", "Least gap of all meetings left out, so nobody passes nearer without being on the card; null: none is"
    )
    meetings: list[Meeting] = Field(description="All meetings within the reach, in order of time")
    fastest: Fastest = Field(description="When it is fastest")
    done: Stand = Field(description="When and where it stops for good")


class Cues(Answer):
    """The cue cards of a dance."""

    cards: list[CueCard] = Field(description="A card for each bench that was asked for, in order")

    @classmethod
    def of(cls, cards: list[Card], words: CardWords) -> Self:
        return cls(cards=[_card(card, words) for card in cards])


def _clock(time: float, words: CardWords) -> str | None:
    start = words.clock.start_clock
    return None if start is None else time_of_day(time, start)


def _neighbour(bench: int | None, words: CardWords) -> Neighbour | None:
    return None if bench is None else Neighbour(bench=bench, name=words.names[bench] if words.names else "")


def _stand(at: facts.Stand, words: CardWords) -> Stand:
    mark, past = words.chalk.nearest(at.s)
    own = {"clock": _clock(at.time, words), "mark": mark, "past_mark": past, "steps": words.chalk.steps(past)}
    return Stand.from_result(at, **own)


def _meeting(one: facts.Meeting, words: CardWords) -> Meeting:
    name = words.names[one.bench] if words.names else ""
    return Meeting.from_result(one, name=name, clock=_clock(one.time, words))


def _card(card: Card, words: CardWords) -> CueCard:
    bench = card.bench
    cues = [
        Cue.from_result(
            cue, clock=_clock(cue.time, words), count=words.clock.count(cue.time) or None,
            nearest=cue.nearest and _meeting(cue.nearest, words),
            others=[one.bench for one in cue.meetings], words=words.sentence(card, cue),
        )
        for cue in card.cues
    ]  # fmt: skip
    ratio = bench.fastest.speed / bench.head_speed
    return CueCard(
        bench=bench.bench,
        name=words.names[bench.bench] if words.names else "",
        ahead=_neighbour(bench.ahead, words),
        behind=_neighbour(bench.behind, words),
        start=_stand(bench.start, words),
        begin=_stand(bench.begin, words),
        direction=bench.direction,
        cues=cues,
        left_out=len(card.left_out),
        least_left_out=card.least_left_out,
        meetings=[_meeting(one, words) for one in bench.meetings],
        fastest=Fastest.from_result(bench.fastest, speed_ratio=ratio),
        done=_stand(bench.done, words),
    )


def cues(request: CuesRequest, terms: Terms, form: str = JSON) -> Cues | bytes:
    """A card for each bench: where it stands, when it walks, whom it meets and how near, where it is fastest."""
    dance = request.to_dance(request.most_benches(terms.settings))
    benches = request.benches_of(dance.dragon)
    _refuse_equal_names(dance.dragon)
    place = request.to_place(dance.dragon)
    own_cues = bench_cues(
        dance, benches, reach=request.reach, start=request.start, stop=request.stop, budget=terms.budget
    )
    cards, words = [card_of(one) for one in own_cues], _words(request, dance, place, terms)
    if form == JSON:
        return Cues.of(cards, words)
    return cards_csv(cards, words) if form == CSV_TYPE else _paper(request, dance, place, (cards, words), terms)


def _words(request: CuesRequest, dance: Dance, place: Place, terms: Terms) -> CardWords:
    start, _ = dance.span(request.start, request.stop)
    tail = float(handle_places(dance, [start], budget=terms.budget)[0, -1])
    chalk = Chalk.of(dance, tail, request.spacing, request.step_length)
    clock = TimeFormat(clock_of(request, dance), request.music)
    geographic = request.origin_at(place) is not None
    return CardWords(Say(request.language), dance.dragon.names, clock, chalk, geographic)


def _refuse_equal_names(dragon: core.Dragon) -> None:
    """raises: InvalidValue for two benches with one name, because a card names other benches by it"""
    first = dict[str, int]()
    for k, name in enumerate(dragon.names):
        if name and first.setdefault(name, k) != k:
            other = Parameter(f"dragon.names.{first[name]}")
            raise InvalidValue(f"dragon.names.{k}", "must differ from {other}", got=Given(name), other=other)


def _paper(
    request: CuesRequest, dance: Dance, place: Place, content: tuple[list[Card], CardWords], terms: Terms
) -> bytes:
    """The cards as PDF."""
    from app.cards.cards import CardSheets, cards_pdf
    from app.files.fonts import families

    cards, words = content
    say, start = words.say, dance.span(request.start, request.stop)[0]
    if dance.dragon.benches <= terms.settings.checked_benches_max:
        verdict = verdict_words(verdict_of(request, dance, place.venue, start, terms), words.clock.words, say)
    else:
        verdict = say("Not checked: the dragon is too long", "未检查：板凳过多")
    title = request.title or say("Bench dragon", "板凳龙")
    areas = place.venue.areas if place.venue else ()
    texts = "".join([title, *dance.dragon.names, *(area.name for area in areas)])
    # Chinese names may stand on English cards.
    family = families(Language.CHINESE if max(texts) >= FIRST_CHINESE else request.language)
    sheets = CardSheets(dance, place.venue, cards, words, title, verdict, family, terms.budget)
    return cards_pdf(sheets, terms.progress)


def _cost(request: CuesRequest, form: str = JSON) -> float:
    last = request.benches - 1 if request.last_bench is None else request.last_bench
    count = max(1, min(FOLLOWED_MAX, last - (request.first_bench or 0) + 1))
    count = len(request.cards or range(count))
    return count * (SECONDS_PER_BENCH + (SECONDS_PER_CARD if form == PDF_TYPE else 0.0))


QUESTION = Question(cues, Cues, None, CuesRequest, (JSON, CSV_TYPE, PDF_TYPE), _cost)
