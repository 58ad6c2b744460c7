"""The question cues: what the carriers of each bench have to know, as JSON, as a table, and as cards on paper."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Literal

from pydantic import Field

import core
from app.cards.answer import Cues, PerformanceCues
from app.cards.tables import cards_csv
from app.cards.words import CardWords, Chalk, landmarks_of
from app.files.tables import CSV_TYPE
from app.plan.timing import TimeFormat
from app.questions.check import FILE_OF_CHECK, verdict_of
from app.questions.plan import GATES, PDF_TYPE, SHEETS, GatedDance, verdict_words
from app.wire.dances import BenchNumber, bench_of, clock_of, starting
from app.wire.degrees import Place
from app.wire.fields import Address, measure
from app.wire.performances import NumberOrName, SeveralFields, dragons_of
from app.wire.question import JSON, Command, ListOption, Question, Terms
from core import Dance, FailureKind, InvalidValue, Performance
from core.errors import TooLarge
from core.language import phrase, say
from core.motion.places import handle_places
from core.people.cards import Card, card_of
from core.people.cues import FOLLOWED_MAX, REACH, REACH_MAX, bench_cues
from core.quantities import Given, Parameter
from core.questions import drawn
from core.values import Interval, Point

# Longest address whose code fits on a card [characters].
ADDRESS_MOST = 600
# Estimated time of the cues of a bench and of its card on paper [s], measured 2026-11-29.
SECONDS_PER_BENCH, SECONDS_PER_CARD = 0.02, 0.01

NOT_DRAWN = phrase("the cards were not drawn")


class DanceCues(GatedDance, strict=True):
    """A dance, as for /check, and the benches that get cards."""

    first_bench: BenchNumber | None = Field(
        None, description=f"First bench with a card, 0 for the head; at most {FOLLOWED_MAX} get one; default: the head"
    )
    last_bench: BenchNumber | None = Field(None, description="Last bench with a card; default: the tail")
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

    map_up: Literal["north", "way"] = Field(
        "north",
        description="What is up on the pictures: north, or the y axis of a plan; or the way on which the bench begins",
    )
    address: Address = Field(
        "",
        max_length=ADDRESS_MOST,
        description="Address of the page with this dance: each card has a code that opens the card of its bench on a "
        "phone",
    )
    labels: bool = Field(
        False, description="True: the PDF has labels to cut with the code of each bench, in place of its card"
    )

    def benches_of(self, dragon: core.Dragon) -> Sequence[int]:
        """The benches that get cards. raises: InvalidValue, TooLarge"""
        count = dragon.benches
        if self.cards is not None:
            for name in ("first_bench", "last_bench"):
                if getattr(self, name) is not None:
                    rule, other = "must be left out beside {other}", Parameter("cards")
                    raise InvalidValue(name, rule, got=getattr(self, name), other=other)
            return [bench_of(f"cards.{k}", one, dragon) for k, one in enumerate(self.cards)]
        first = 0 if self.first_bench is None else self.first_bench
        last = count - 1 if self.last_bench is None else self.last_bench
        for name, bench in (("first_bench", first), ("last_bench", last)):
            if bench >= count:
                raise InvalidValue(name, "must be at most {most}, the tail", got=bench, most=count - 1)
        if last < first:
            raise InvalidValue("last_bench", "must not be before first_bench ({first})", got=last, first=first)
        _refuse_many(last - first + 1)
        return range(first, last + 1)


class CuesRequest(SeveralFields, DanceCues, strict=True):
    """A dance, or several on one clock, as for /check, and the benches that get cards."""

    part: NumberOrName | None = Field(
        None,
        description="Of several dances, the dragon whose benches get cards: its number in the order of the dances, "
        "from 0, or its name; default: each",
    )


def cues(request: CuesRequest, terms: Terms, form: str = JSON) -> Cues | PerformanceCues | bytes:
    """A card for each bench: where it stands, when it walks, whom it meets and how near, where it is fastest."""
    if request.dances is not None:
        return _of_several(request, terms, form)
    if request.part is not None:
        raise InvalidValue("part", "must be left out without dances", got=Given(request.part))
    dance = request.to_dance(request.most_benches(terms.settings))
    request, benches = starting(request, dance), request.benches_of(dance.dragon)
    _refuse_equal_names(dance.dragon)
    if request.labels and form == PDF_TYPE:
        return _labels(request, dance, [("", benches, dance.dragon, None)], terms)
    place = request.to_place(dance.dragon)
    own_cues = bench_cues(
        dance, benches, reach=request.reach, start=request.start, stop=request.stop, budget=terms.budget
    )
    cards, words = [card_of(one) for one in own_cues], _words(request, dance, place, terms)
    if form == JSON:
        return Cues.of(cards, words)
    if form == CSV_TYPE:
        return cards_csv([(cards, words)])
    verdict = _verdict(request, dance, place, words, terms)
    return _cards(dance, request, place, [((dance, ""), (cards, words))], verdict, terms)


def _of_several(request: CuesRequest, terms: Terms, form: str) -> PerformanceCues | bytes:
    """The cards of several dragons."""
    performance, place = request.to_placed(terms.settings)
    parts = request.dances or []
    chosen = {k: request.benches_of(performance.parts[k].dance.dragon) for k in dragons_of(request.part, performance)}
    _refuse_many(sum(map(len, chosen.values())))
    names = list(map(performance.name_of, range(len(performance.parts))))
    if request.labels and form == PDF_TYPE:
        decks_of = [(names[k], benches, performance.parts[k].dance.dragon, k) for k, benches in chosen.items()]
        return _labels(request, performance, decks_of, terms)
    dragons = [(name, part.dance.dragon.names) for name, part in zip(names, performance.parts, strict=True)]
    request = starting(request, performance)
    start_clock = clock_of(request, performance)
    start, stop = performance.span(request.start, request.stop)
    geographic, decks = request.origin_at(place) is not None, list[tuple[list[Card], CardWords]]()
    for k, benches in chosen.items():
        dance = performance.parts[k].dance
        _refuse_equal_names(dance.dragon, f"dances.{k}.")
        span: dict[str, Any] = {"start": request.start, "stop": request.stop, "budget": terms.budget}
        own = core.bench_cues(performance, benches, dragon=k, reach=request.reach, **span)
        chalk = _chalk(request, dance, performance.parts[k].own_span(start, stop), terms)
        clock = TimeFormat(start_clock, parts[k].music, music_begin=parts[k].delay)
        words = CardWords(dance.dragon.names, clock, chalk, geographic, k, dragons, _landmarks(request, place))
        decks.append(([card_of(one) for one in own], words))
    if form == JSON:
        return PerformanceCues.together(decks)
    if form == CSV_TYPE:
        return cards_csv(decks)
    limits = request.to_limits()
    report = core.quick_check(performance, start=start, stop=request.stop, budget=terms.budget, **limits)
    in_words = TimeFormat(start_clock).words
    verdict = _failed(request, report, in_words) if report.failures else _passed(request, place), not report.failures
    dances = [(performance.parts[k].dance, names[k]) for k in chosen]
    return _cards(performance, request, place, list(zip(dances, decks, strict=True)), verdict, terms)


def _refuse_many(count: int) -> None:
    """raises: TooLarge for more cards than one question may have"""
    if count > FOLLOWED_MAX:
        rule = "cards must be at most {most}: choose the benches with first_bench and last_bench"
        raise TooLarge.in_words("last_bench", rule, got=count, most=FOLLOWED_MAX)


def _chalk(request: CuesRequest, dance: Dance, span: Interval, terms: Terms) -> Chalk:
    """The chalk marks of a dance from start to stop [s]."""
    places = handle_places(dance, span, budget=terms.budget)
    return Chalk.of(dance, [places[0, -1], places[1, 0]], request.spacing, request.step_length)


def _words(request: CuesRequest, dance: Dance, place: Place, terms: Terms) -> CardWords:
    chalk = _chalk(request, dance, dance.span(request.start, request.stop), terms)
    clock = TimeFormat(clock_of(request, dance), request.music)
    geographic = request.origin_at(place) is not None
    return CardWords(dance.dragon.names, clock, chalk, geographic, landmarks=_landmarks(request, place))


def _landmarks(request: CuesRequest, place: Place) -> list[tuple[str, Point]]:
    """Name and place of what a person can walk towards."""
    return landmarks_of(place.venue, [(one.name, (one.x, one.y)) for one in request.gates])


def _refuse_equal_names(dragon: core.Dragon, before: str = "") -> None:
    """raises: InvalidValue for two benches with one name, because a card names other benches by it

    before: what stands before the field of the dragon
    """
    first = dict[str, int]()
    for k, name in enumerate(dragon.names):
        if name and first.setdefault(name, k) != k:
            other = Parameter(f"{before}dragon.names.{first[name]}")
            raise InvalidValue(f"{before}dragon.names.{k}", "must differ from {other}", got=Given(name), other=other)


def _verdict(request: CuesRequest, dance: Dance, place: Place, words: CardWords, terms: Terms) -> tuple[str, bool]:
    """The verdict on a single dance in a few words, and whether nothing in it fails."""
    if dance.dragon.benches > terms.settings.checked_benches_max:
        return say("Not checked: the dragon is too long"), True
    start = dance.span(request.start, request.stop)[0]
    report = verdict_of(request, dance, place.venue, start, terms)
    if report.failures:
        return _failed(request, report, words.clock.words), False
    return _passed(request, place), True


def _failed(request: CuesRequest, report: core.Report | core.PerformanceReport, words: Callable[[float], str]) -> str:
    """What the check of a dance that fails found, and whether its cards end there."""
    verdict = verdict_words(report, words)
    contacts = [words(failure.time) for failure in report.failures if failure.kind is FailureKind.CONTACT]
    if request.stop is None or words(request.stop) not in contacts:
        return say("{words}.", words=verdict)
    return say("{verdict}; the cues end where benches touch.", verdict=verdict)


def _passed(request: CuesRequest, place: Place) -> str:
    """What the check of a dance that passes found."""
    margin = request.margin
    kept = say(" ({margin:g} m kept clear)", margin=margin) if margin else ""
    if place.venue is None:
        return say("The whole dance was checked: nobody touches another bench{kept}.", kept=kept)
    return say(
        "The whole dance was checked: nobody touches another bench, an obstacle or the edge of the square{kept}.",
        kept=kept,
    )


def _cards(
    dance: Dance | Performance,
    request: CuesRequest,
    place: Place,
    decks: Sequence[tuple[tuple[Dance, str], tuple[list[Card], CardWords]]],
    verdict: tuple[str, bool],
    terms: Terms,
) -> bytes:
    """The cards on paper.

    decks: for each dragon its dance, its name, which is empty for the only one, its cards, and their words
    verdict: in words, and whether nothing fails
    """
    from app.cards.cards import CardSheets, cards_pdf
    from app.files.typeset import face_for

    title = request.heading
    areas = place.venue.areas if place.venue else ()
    names = [one for (own, name), _ in decks for one in (name, *own.dragon.names)]
    # The cards of one dragon name those of others.
    names += [one for _, (_, words) in decks[:1] for name, own in words.dragons for one in (name, *own)]
    face = face_for([title, *names, *(area.name for area in areas), *(gate.name for gate in request.gates)])
    sheets = [
        CardSheets(
            own, name, place.venue, cards, words, title, verdict, face, terms.budget, request.address, request.map_up
        )
        for (own, name), (cards, words) in decks
    ]
    return drawn(dance, NOT_DRAWN, lambda: cards_pdf(sheets, request.paper, terms.progress))


def _labels(
    request: CuesRequest,
    dance: Dance | Performance,
    decks: Sequence[tuple[str, Sequence[int], core.Dragon, int | None]],
    terms: Terms,
) -> bytes:
    """The labels as PDF. decks: name, benches, dragon and number of each dragon; raises: InvalidValue, TooMuchWork"""
    from app.cards.labels import LabelDeck, labels_pdf
    from app.files.typeset import face_for

    if not request.address:
        raise InvalidValue("address", "must be given for labels, whose codes lead to it")
    title = request.heading
    face = face_for([title, *(one for name, _, dragon, _ in decks for one in (name, *dragon.names))])
    labels = [
        LabelDeck(say("{name}: {text}", name=title, text=name) if name else title, benches, dragon.names, number)
        for name, benches, dragon, number in decks
    ]
    pages = title, request.address, labels, request.paper, face, terms.budget
    return drawn(dance, NOT_DRAWN, lambda: labels_pdf(*pages))


def _cost(request: CuesRequest, form: str = JSON) -> float:
    last = request.benches - 1 if request.last_bench is None else request.last_bench
    count = max(1, min(FOLLOWED_MAX, last - (request.first_bench or 0) + 1))
    count = len(request.cards or range(count))
    return count * (SECONDS_PER_BENCH + (SECONDS_PER_CARD if form == PDF_TYPE else 0.0))


QUESTION = Question(
    cues,
    Cues,
    None,
    CuesRequest,
    (JSON, CSV_TYPE, PDF_TYPE),
    _cost,
    several=PerformanceCues,
    command=Command(
        "A card for each bench: where to stand, when to walk, whom it meets and how near, where it is fastest.",
        lambda request: say("cues"),
        file=FILE_OF_CHECK,
        lists={"bench": ListOption("cards", "Name or number of a bench with a card; may be given several times.")}
        | GATES,
        outputs={"output": replace(SHEETS, default="cues.pdf")},
    ),
)
