"""The question crew: who carries which bench when, as JSON, as a table, and as a timeline on paper."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Self

import numpy as np
from pydantic import AfterValidator, Field

import core
from app.cards.crew import CrewWords, crew_csv
from app.cards.words import CardWords, Chalk
from app.files.tables import CSV_TYPE
from app.maps.marks import mark_name
from app.plan.timing import TimeFormat
from app.questions.check import FILE_OF_CHECK
from app.questions.maps import Marked
from app.questions.plan import PDF_TYPE, SHEETS
from app.wire.answers import SENTENCES
from app.wire.clocks import DAY, checked_clock
from app.wire.dances import clock_of, starting
from app.wire.fields import AS_WHOLE, Answer, Coordinate, Instant, OneLine, PaperSize, Wire, measure
from app.wire.labels import Part, TextTable, heads_of
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.question import JSON, Command, ListOption, Question, Terms
from core import Dance, InvalidValue
from core.errors import TooLarge
from core.language import Language, Listed, say
from core.motion.places import handle_places
from core.people import crew as facts
from core.people.crew import ON_BENCH_MAX, PEOPLE_MAX, PLACES_MAX, SHIFT_MAX, Relief, places_near
from core.quantities import Given, Parameter, Quantity
from core.questions import drawn
from core.values import Point

if TYPE_CHECKING:
    from app.plan.tables import PlanTable

# Estimated time of a bench, without and with a sheet of paper for its people [s], measured 2026-11-27.
SECONDS, SECONDS_ON_PAPER = 0.002, 0.03
# Labels of people who rest in a row of a table on paper.
RESTING_IN_ROW = 8
# Most points of changes.
POINTS_MAX = 20

People = Annotated[int, Field(ge=1, le=ON_BENCH_MAX), AS_WHOLE]


class PointBody(Wire, strict=True):
    """A point at which people change: each bench does where its front handle is nearest to it."""

    x: Coordinate = measure("m", "x of the point")
    y: Coordinate = measure("m", "y of the point")
    within: float = measure("m", "Largest distance of the path from the point where it passes it", 2.0, ge=0, le=100)

    @classmethod
    def of_text(cls, text: str) -> Self:
        """A point as X,Y. raises: InvalidValue"""
        entries = numbers_of("point", text, float)
        if len(entries) != 2:
            raise InvalidValue.in_words("point", "--point must be X,Y [m]", got=Given(text))
        return checked(cls, dict(zip("xy", entries, strict=True)))


class CrewFields(Wire):
    """The people of a dance."""

    head_people: People = measure("", "People on the head's bench", 8, label="on the head")
    bench_people: People = measure("", "People on every other bench", 2, label="on every other bench")
    spares: Annotated[int, Field(ge=0, le=PEOPLE_MAX), AS_WHOLE] = measure(
        "", "Further people, who carry nothing at the start and come in at changes", 0, label="spares"
    )
    shift: float | None = measure(
        "s", "Time after which people change, again and again; default: not by time", None,
        label="shift [s]", gt=0, le=SHIFT_MAX,
    )  # fmt: skip
    rest: float = measure(
        "s", "Least time from going out to coming in again", 0.0, label="least rest [s]", ge=0, le=SHIFT_MAX
    )
    at: Instant | None = measure(
        "s", "Time at which the answer says who is where; default: none", None, label="Who is where at [s], or 19:45"
    )
    at_clock: Annotated[str | None, AfterValidator(checked_clock)] = Field(
        None, description="The same as a time of day such as 19:45, for a dance with start_clock or begin_clock"
    )
    title: OneLine = Field("", max_length=80, description="Title of the dance on paper")
    paper: PaperSize = "A4"
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh", strict=False)


class CrewRequest(CrewFields, Marked, strict=True):
    """A dance, as for /check, and its people."""

    people: list[People] | None = Field(
        None,
        description="People on each bench, head first, in place of head_people and bench_people; null: as these say",
    )
    points: list[PointBody] = Field(
        [],
        max_length=POINTS_MAX,
        fail_fast=True,
        description="Points at which the people of a bench change, each time that it passes one of them",
    )

    def needed(self) -> list[int]:
        """People on each bench. raises: InvalidValue"""
        if self.people is None:
            return [self.head_people] + [self.bench_people] * (self.benches - 1)
        if len(self.people) != self.benches:
            rule = "must have an entry for each of the {benches} benches"
            raise InvalidValue("people", rule, got=len(self.people), benches=self.benches)
        return self.people


class CrewSpell(Answer):
    """A time in which a person carries a bench.

    bench: the bench; 0 is the head
    name: its name; empty without one
    begin_clock: time of day then, if start_clock or begin_clock is given
    end_clock: time of day then
    way: way of the bench's front handle along the path from begin to end [m]
    relieves: label of the person who goes out at the begin; null at the start
    x: x of the bench's front handle at the begin [m]
    y: y of the same [m]
    mark: the chalk mark nearest to it along the path, by its length from mark 0 [m]
    """

    bench: int
    name: str
    begin: float = measure("s")
    begin_clock: str | None
    end: float = measure("s")
    end_clock: str | None
    way: float
    relieves: str | None
    x: float
    y: float
    mark: float


class Carrier(Answer, of=facts.Carried):
    """One person, and all that they carry.

    person: number of the person, from 0 on; spares come last
    label: short name: 17.2 is the second of bench 17 at the start, S3 the third spare
    spells: in order of time
    """

    person: int
    label: str
    time: float
    way: float
    longest: float
    spells: list[CrewSpell]


class PlaceOfChange(Answer):
    """A place at which the path passes a point of changes.

    point: index of the point
    x: x of the place on the path [m]
    y: y of the same [m]
    distance: distance of the place from the point [m]
    mark: the nearest chalk mark along the path, by its length from mark 0 [m]
    """

    point: int
    x: float
    y: float
    distance: float
    mark: float


class BenchRoll(Answer):
    """A bench at one moment, and who carries it.

    bench: its number; 0 is the head
    name: its name; empty without one
    people: labels of those who carry it; at a change of those who come in
    x: x of its front handle [m]
    y: y of the same [m]
    mark: the nearest chalk mark along the path, by its length from mark 0 [m]
    """

    bench: int
    name: str
    people: list[str]
    x: float
    y: float
    mark: float


class Roll(Answer):
    """Who is where at one moment.

    clock: time of day then, if start_clock or begin_clock is given
    benches: all benches, head first
    resting: labels of those who carry nothing then
    """

    time: float = measure("s")
    clock: str | None
    benches: list[BenchRoll]
    resting: list[str]


class Crew(Answer, of=facts.Crew):
    """The people of a dance.

    changes: how many times somebody takes over from somebody
    longest: longest time that anybody carries without a break [s]
    places: where the path passes the points, in order of the points
    at: who is where at the time asked about; null: none was asked about
    carriers: all people
    """

    people: int
    spares: int
    start: float
    stop: float
    changes: int
    longest: float
    enough: int
    unrelieved: list[int]
    places: list[PlaceOfChange]
    at: Roll | None
    carriers: list[Carrier]
    sentences: list[str] = SENTENCES

    @classmethod
    def of(cls, crew: CrewWords, places: list[PlaceOfChange], roll: Roll | None) -> Self:
        result, own = crew.crew, dict[int, list[CrewSpell]]()
        for one, place in zip(result.spells, crew.places, strict=True):
            own.setdefault(one.person, []).append(_spell(one, place, crew))
        carriers = [
            Carrier.from_result(carried, person=person, label=crew.labels[person], spells=own.get(person, []))
            for person, carried in enumerate(result.carried)
        ]
        more = {"longest": crew.longest, "places": places, "at": roll, "carriers": carriers}
        return cls.from_result(result, changes=len(crew.changes), sentences=crew.sentences, **more)


def _name(bench: int, crew: CrewWords) -> str:
    return crew.words.names[bench] if crew.words.names else ""


def _spell(one: facts.Spell, place: Point, crew: CrewWords) -> CrewSpell:
    clock = crew.words.clock.of_day
    own = {
        "name": _name(one.bench, crew), "begin_clock": clock(one.begin), "end_clock": clock(one.end),
        "relieves": None if one.relieved is None else crew.labels[one.relieved],
        "x": place[0], "y": place[1], "mark": crew.words.chalk.nearest(one.s)[0],
    }  # fmt: skip
    return CrewSpell.from_result(one, **own)


def crew(request: CrewRequest, terms: Terms, form: str = JSON) -> Crew | bytes:
    """Who carries which bench when: shifts, spare carriers, minutes and metres of each, and who is where at a time."""
    dance, needed = _dance(request, terms), request.needed()
    request = starting(request, dance)
    start, stop = dance.span(request.start, request.stop)
    ends = handle_places(dance, [start, stop], budget=terms.budget)
    clock = TimeFormat(clock_of(request, dance), request.music)
    chalk = Chalk.of(dance, [ends[0, -1], ends[1, 0]], request.spacing, 0.75)
    words = CardWords(dance.dragon.names, clock, chalk, False)
    places = _places(request, dance, float(ends[0, -1]), float(ends[1, 0]), chalk)
    rules = Relief(request.spares, request.shift, [s for s, _ in places], request.rest)
    result = _planned(request, dance, needed, rules, terms)
    begun = dance.path.position(np.array([one.s for one in result.spells]))
    planned = CrewWords(result, words, tuple((x, y) for x, y in begun.tolist()))
    if form == CSV_TYPE:
        return crew_csv(planned)
    at = _moment(request, clock, start, stop)
    roll = None if at is None else _roll(at, planned, dance, terms)
    if form == JSON:
        return Crew.of(planned, [one for _, one in places], roll)
    return _paper(request, dance, planned, roll, terms)


def _dance(request: CrewRequest, terms: Terms) -> Dance:
    """The dance of a request. raises: TooLarge, InvalidValue"""
    if request.benches > PEOPLE_MAX:
        raise TooLarge.in_words(
            "dragon.benches", "benches must be at most {most} here", got=request.benches, most=PEOPLE_MAX
        )
    return request.to_dance(request.most_benches(terms.settings))


def _planned(request: CrewRequest, dance: Dance, needed: list[int], rules: Relief, terms: Terms) -> facts.Crew:
    """The crew. raises: errors in the names of the request"""
    try:
        return facts.crew(dance, needed, rules, start=request.start, stop=request.stop, budget=terms.budget)
    except core.BenchDragonError as error:
        if error.field.startswith("relief."):
            raise error.with_field(error.field.removeprefix("relief.")) from error
        raise


def _places(
    request: CrewRequest, dance: Dance, begin: float, end: float, chalk: Chalk
) -> list[tuple[float, PlaceOfChange]]:
    """Where the path passes the points: s [m] of each place, and the place. raises: InvalidValue"""
    places = []
    for k, point in enumerate(request.points):
        near = places_near(dance.path, (point.x, point.y), begin, end, point.within)
        if not near:
            away = dance.path.position(np.linspace(begin, end, 1 + max(1, int(end - begin)))) - (point.x, point.y)
            least = Quantity(float(np.hypot(*away.T).min()), "m", 4)
            rule = "must be within {within} of the path that the dragon walks"
            raise InvalidValue(f"points.{k}", rule, got=least, within=Quantity(point.within, "m"))
        for s in near:
            x, y = dance.path.position(s).tolist()
            distance = math.hypot(x - point.x, y - point.y)
            places.append((s, PlaceOfChange(point=k, x=x, y=y, distance=distance, mark=chalk.nearest(s)[0])))
    if len(places) > PLACES_MAX:
        rule = "must be passed at most {most} times in all"
        raise InvalidValue("points", rule, got=len(places), most=PLACES_MAX)
    return places


def _moment(request: CrewRequest, clock: TimeFormat, start: float, stop: float) -> float | None:
    """The time at which the answer says who is where [s]; None for none. raises: InvalidValue"""
    name, time = "at", request.at
    if request.at_clock is not None:
        name = "at_clock"
        if time is not None:
            raise InvalidValue(
                name, "must be left out beside {other}", got=Given(request.at_clock), other=Parameter("at")
            )
        if clock.start_clock is None:
            rule = "must stand beside {other}, the time of day at time 0"
            raise InvalidValue(name, rule, got=Given(request.at_clock), other=Parameter("start_clock"))
        # The first time from the start on at which it is as late.
        zero = _seconds(clock.start_clock)
        time = start + (_seconds(request.at_clock) - zero - start) % DAY
    if time is None or start <= time <= stop:
        return time
    got = Given(request.at_clock) if name == "at_clock" else Quantity(time, "s")
    first, last = (clock.clock(one) if name == "at_clock" else str(Quantity(one, "s", 9)) for one in (start, stop))
    raise InvalidValue(name, "must be during the dance, from {first} to {last}", got=got, first=first, last=last)


def _seconds(clock: str) -> float:
    """Seconds of the day at a time of day, perhaps with a fraction of a second."""
    hours, minutes, seconds = (float(part) for part in f"{clock}:00".split(":")[:3])
    return 3600.0 * hours + 60.0 * minutes + seconds


def _roll(time: float, crew: CrewWords, dance: Dance, terms: Terms) -> Roll:
    places = handle_places(dance, [time], budget=terms.budget)[0, :-1]
    benches = crew.crew.on_benches(time)
    points = dance.path.position(places).tolist()
    carrying = {person for people in benches for person in people}
    rows = [
        BenchRoll(
            bench=bench, name=_name(bench, crew), people=[crew.labels[person] for person in people],
            x=points[bench][0], y=points[bench][1], mark=crew.words.chalk.nearest(float(places[bench]))[0],
        )
        for bench, people in enumerate(benches)
    ]  # fmt: skip
    resting = [label for person, label in enumerate(crew.labels) if person not in carrying]
    return Roll(time=time, clock=crew.words.clock.of_day(time), benches=rows, resting=resting)


def _paper(request: CrewRequest, dance: Dance, crew: CrewWords, roll: Roll | None, terms: Terms) -> bytes:
    """The crew as PDF. raises: TooMuchWork"""
    from app.cards.timeline import CrewSheets, crew_pdf
    from app.files.typeset import face_for

    result, clock = crew.crew, crew.words.clock.words
    title = request.title or say("Bench dragon")
    summary, *lacks = crew.sentences
    facts = [summary, say("from {start} to {stop}", start=clock(result.start), stop=clock(result.stop)), *lacks]
    face = face_for([title])
    table = None if roll is None else _roll_table(roll, crew)
    sheets = CrewSheets(crew, title, facts, face, terms.budget, request.paper, table)
    return drawn(dance, "the timeline was not drawn", lambda: crew_pdf(sheets, terms.progress))


def _roll_table(roll: Roll, crew: CrewWords) -> PlanTable:
    from app.plan.tables import PlanTable

    when = crew.words.clock.words(roll.time)
    columns = [say("bench"), say("people"), "x [m]", "y [m]", say("near mark")]
    rows = [
        [str(one.bench), " ".join(one.people), f"{one.x:.2f}", f"{one.y:.2f}", mark_name(one.mark)]
        for one in roll.benches
    ]
    for first in range(0, len(roll.resting), RESTING_IN_ROW):
        some = roll.resting[first : first + RESTING_IN_ROW]
        rows.append(["" if first else say("rest"), " ".join(some), "", "", ""])
    return PlanTable(say("Who is where at {when}", when=when), columns, rows, frozenset({1}))


def _cost(request: CrewRequest, form: str = JSON) -> float:
    return request.benches * (SECONDS_ON_PAPER if form == PDF_TYPE else SECONDS)


def _parts(answer: Crew, request: CrewRequest) -> Iterator[Part]:
    """What lacks, then each person, and who is where."""
    title, *lacks = answer.sentences
    yield from lacks
    heads = [say("person"), say("benches"), *heads_of(Carrier, "time", "way", "longest")]
    table = TextTable(title, *heads)
    for one in answer.carriers:
        benches = str(Listed(dict.fromkeys(spell.bench for spell in one.spells))) or say("none")
        table.add(one.label, benches, *(f"{value:.1f}" for value in (one.time, one.way, one.longest)))
    yield table
    if roll := answer.at:
        time = roll.clock or f"{roll.time:g} s"
        heads = [say("bench"), say("people"), *heads_of(BenchRoll, "x", "y", "mark")]
        table = TextTable(say("Who is where at {time}", time=time), *heads)
        for place in roll.benches:
            name = f"{place.bench} {place.name}".rstrip()
            table.add(name, " ".join(place.people), f"{place.x:.2f}", f"{place.y:.2f}", f"{place.mark:g}")
        if roll.resting:
            table.add(say("rest"), " ".join(roll.resting), "", "", "")
        yield table


QUESTION = Question(
    crew,
    Crew,
    None,
    CrewRequest,
    (JSON, CSV_TYPE, PDF_TYPE),
    _cost,
    command=Command(
        "Who carries which bench when: shifts, spare carriers, minutes and metres of each, and who is where at a time.",
        lambda request: say("crew"),
        _parts,
        file=FILE_OF_CHECK,
        lists={
            "point": ListOption(
                "points", "A place X,Y [m] at which people change; may be given several times.", PointBody.of_text
            )
        },
        outputs={"output": SHEETS},
    ),
)
