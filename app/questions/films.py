"""A film of the dance, on any path and in any venue."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import Field

import core
from app.files.film_spec import ENDINGS, GIF_TYPE, LOOKS, MP4_TYPE, FilmSpec
from app.wire.dances import BenchNumber, PlacedDance, bench_of, clock_of
from app.wire.fields import AS_WHOLE, Instant, OneLine, Wire, check_limit, measure
from app.wire.options import PathOptions
from app.wire.performances import NumberOrName, PartBody, SeveralFields, dragons_of
from app.wire.question import Command, ListOption, Output, Question, Terms
from core import Dance, Dragon, EndReason, InvalidValue, Outcome, Performance, first_contact
from core.language import Language, say
from core.quantities import Given, Quantity, bound
from core.values import Pair

FORM = next(iter(ENDINGS))
# Longest time of the dance in a film without a stop, unless benches touch earlier, and time left before a fold [s].
LONGEST, BEFORE_FOLD = 1_000.0, 1e-3
# Most benches that stand out.
MARKED_MAX = 50
# Time to draw and encode a million pixels of a film, measured 2026-11-29 [s].
SECONDS_PER_MEGAPIXEL = {MP4_TYPE: 0.006, GIF_TYPE: 0.04}


class FilmFields(Wire):
    """Content and form of a film."""

    start: Instant | None = measure(
        "s", "First instant; default: 0, or the first time at which the whole dragon is on the path", None
    )
    stop: Instant | None = measure(
        "s", "Last instant; default: first contact, otherwise the end of the run, at most 1,000 s after the start", None
    )
    seconds: float = measure("s", "Length of the film", 20.0, ge=0.1, le=120)
    rate: Annotated[int, Field(ge=1, le=60), AS_WHOLE] | None = measure(
        "1/s", "Frames per second; default: 30, or 12 for a GIF", None
    )
    height: Annotated[int, Field(ge=90, le=2160, multiple_of=2), AS_WHOLE] | None = measure(
        "pixels", "Height of the picture, 16 : 9; default: 1080, or 360 for a GIF", None
    )
    language: Language = Field(Language.ENGLISH, description="Language of the words in the picture")
    title: OneLine = Field("", max_length=80, description="Words at the upper right")


class PartFields(Wire):
    """The dragon that a film is about."""

    part: NumberOrName | None = Field(
        None,
        description="Of several dances, the dragon whose benches are marked: its number in the order of the dances, "
        "from 0, or its name; default: each",
    )


class FilmOptions(PartFields, FilmFields, PathOptions):
    """The fields of a film as options."""


class FilmRequest(SeveralFields, PartFields, FilmFields, PlacedDance):
    """A film of any dragon on any path, in any venue; or of several dragons on one clock."""

    language: Language = Field(Language.ENGLISH, description="Language of the words in the picture", strict=False)
    marked: list[BenchNumber | str] | None = Field(
        None,
        min_length=1,
        max_length=MARKED_MAX,
        description="Benches that stand out, with their numbers and names: each by its name or its number",
    )


def films(request: FilmRequest, terms: Terms, form: str = FORM) -> bytes:
    """A film of the dance: every bench at every instant, as MP4 or GIF."""
    if request.dances is not None:
        return _of_several(request, terms, form)
    if request.part is not None:
        raise InvalidValue("part", "must be left out without dances", got=Given(request.part))
    from app.files import film

    dance = request.to_dance(terms.settings.drawn_benches_max)
    rate, height = _checked_size(request, terms, form)
    benches = _marked(request.marked, {0: dance.dragon})
    start, stop, touching = span_of(request, dance, terms)
    look: dict[str, Any] = {"touching": touching, "music": request.music, "marked": benches}
    spec = FilmSpec(start, stop, request.seconds, rate, height, clock_of(request, dance), **look)
    venue = request.to_place(dance.dragon).venue
    return film.film(dance, spec, form, venue=venue, title=request.title, budget=terms.budget, progress=terms.progress)


def _of_several(request: FilmRequest, terms: Terms, form: str) -> bytes:
    """A film of several dragons. Its drum is that of the first of them that has beats."""
    from app.files import film
    from app.files.looks import COLOURS

    rate, height = _checked_size(request, terms, form)
    performance, _ = request.to_placed(terms.settings)
    chosen = {k: performance.parts[k].dance.dragon for k in dragons_of(request.part, performance)}
    marked = _marked(request.marked, chosen)
    start, stop, touching = _span_together(request, performance, terms)
    dragons, benches = touching or (None, None)
    clock, colours = clock_of(request, performance), COLOURS[: len(performance.parts)]
    look: dict[str, Any] = {"touching": benches, "dragons": dragons, "colours": colours, "marked": marked}
    music = shared_music(request.dances or [])
    spec = FilmSpec(start, stop, request.seconds, rate, height, clock, **look, **music)
    more: dict[str, Any] = {"title": request.title, "budget": terms.budget, "progress": terms.progress}
    return film.film(performance, spec, form, venue=performance.venue, **more)


def _marked(words: Sequence[int | str] | None, dragons: dict[int, Dragon]) -> tuple[Pair, ...]:
    """Dragon and number of each bench that stands out. dragons: those chosen, by number. raises: InvalidValue"""
    named = [(f"marked.{k}", word) for k, word in enumerate(words or ())]
    return tuple(dict.fromkeys((k, bench_of(*one, dragon)) for k, dragon in dragons.items() for one in named))


def shared_music(dances: Sequence[PartBody]) -> dict[str, Any]:
    """The beats of the first dragon that has any, when they begin, and its name if another one has others, or none."""
    own = next(((k, one) for k, one in enumerate(dances) if one.beats), None)
    if own is None:
        return {}
    k, part = own
    is_common = all((one.beats, one.delay) == (part.beats, part.delay) for one in dances)
    name = "" if is_common else part.name or say("dragon {k}", k=k)
    return {"music": part.music, "music_begin": part.delay, "music_of": name}


def _span_together(
    request: FilmFields, performance: Performance, terms: Terms
) -> tuple[float, float, tuple[Pair, Pair] | None]:
    """First and last instant of the film [s], and the dragons and benches that touch at the last.

    Without a stop it is the first encounter, or the first contact of a dragon by itself, whichever is earlier.
    raises: InvalidValue; OutsideRun
    """
    if request.stop is not None:
        return *performance.span(request.start, request.stop), None
    start, end = performance.span(request.start)
    end -= BEFORE_FOLD if performance.end.dragon is not None else 0.0
    until = max(min(end, start + LONGEST), start + BEFORE_FOLD)
    met = core.first_encounter(performance, start=start, stop=until, budget=terms.budget)
    touches = []
    if met.outcome is Outcome.CONTACT and met.time is not None and met.dragons and met.benches:
        touches.append((met.time, (met.dragons, met.benches)))
    for k, part in enumerate(performance.parts):
        first, last = part.own_span(start, until)
        contact = first_contact(part.dance, start=first, stop=last, budget=terms.budget)
        if contact.outcome is Outcome.CONTACT and contact.time is not None and contact.benches:
            touches.append((contact.time + part.delay, ((k, k), contact.benches)))
    if not touches:
        return start, until, None
    stop, who = min(touches)
    return *performance.span(start, stop), who


def _checked_size(request: FilmFields, terms: Terms, form: str) -> tuple[int, int]:
    """Frames a second, and height [pixels]. raises: TooLarge for a film with too many pixels"""
    rate, height = rate_and_height(request, form)
    megapixels = round(megapixels_of(request.seconds, rate, height))
    most = terms.settings.film_megapixels_max
    check_limit("seconds", "millions of pixels must be at most {most} here", megapixels, most, "take fewer or smaller")
    return rate, height


def megapixels_of(seconds: float, rate: int, height: int) -> float:
    """Millions of pixels of all frames of a film."""
    return seconds * rate * height * height * 16 / 9 / 1e6


def rate_and_height(request: FilmFields, form: str) -> tuple[int, int]:
    """Frames a second, and height [pixels]."""
    rate, height = LOOKS[form]
    return request.rate or rate, request.height or height


def span_of(request: FilmFields, dance: Dance, terms: Terms) -> tuple[float, float, Pair | None]:
    """First and last instant of the film [s], and the benches that touch at the last.

    raises: InvalidValue; OutsideRun
    """
    if request.stop is not None:
        return *dance.span(request.start, request.stop), None
    start = dance.default_start if request.start is None else request.start
    end = dance.end
    until = min(end.time - (BEFORE_FOLD if end.reason is EndReason.FOLD else 0.0), start + LONGEST)
    if until <= start:
        values = {"got": Quantity(start, "s"), "end": bound(until, 9, "s"), **end.values}
        raise InvalidValue("start", f"must be before {{end}}, when {end.template}", **values)
    contact = first_contact(dance, start=start, stop=until, budget=terms.budget)
    if contact.outcome is Outcome.CONTACT and contact.time is not None:
        return *dance.span(start, contact.time), contact.benches
    return *dance.span(start, until), None


def _cost(request: FilmFields, form: str = FORM) -> float:
    return megapixels_of(request.seconds, *rate_and_height(request, form)) * SECONDS_PER_MEGAPIXEL[form]


MARKED = ListOption("marked", "Name or number of a bench that stands out; may be given several times.")
QUESTION = Question(
    films,
    None,
    body=FilmRequest,
    forms=tuple(ENDINGS),
    cost=_cost,
    at="/films",
    command=Command(
        "A film of the dance; with a FILE, of any dragon on any path and in any venue.",
        lambda request: say("film"),
        options=FilmOptions,
        lists={"bench": MARKED},
        outputs={
            "output": Output(
                "Write a .mp4 file (extra film), or a .gif.",
                {ending: form for form, ending in ENDINGS.items()},
                "dance.mp4",
                {".mp4": "film", ".gif": "figures"},
            )
        },
    ),
)
