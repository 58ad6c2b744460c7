"""A film of the dance, on any path and in any venue."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from app.files.film_spec import ENDINGS, GIF_TYPE, LOOKS, MP4_TYPE, FilmSpec
from app.files.tables import Language
from app.wire.dances import PlacedDance
from app.wire.question import AS_WHOLE, Instant, Question, Terms, Wire, check_limit, measure
from core import Dance, EndReason, InvalidValue, Outcome, first_contact
from core.errors import quantities

FORM = next(iter(ENDINGS))
# Longest time of the dance in a film without a stop, unless benches touch earlier, and time left before a fold [s].
LONGEST, BEFORE_FOLD = 1_000.0, 1e-3
# Time to draw and encode a million pixels of a film, measured 2026-11-22 [s].
SECONDS_PER_MEGAPIXEL = {MP4_TYPE: 0.012, GIF_TYPE: 0.04}


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
    title: str = Field("", max_length=80, description="Words at the upper right")


class FilmRequest(FilmFields, PlacedDance):
    """A film of any dragon on any path, in any venue."""

    language: Language = Field(Language.ENGLISH, description="Language of the words in the picture", strict=False)


def films(asked: FilmRequest, terms: Terms, form: str = FORM) -> bytes:
    """A film of the dance: every bench at every instant, as MP4 or GIF."""
    return filmed(asked, asked.to_dance(terms.settings.drawn_benches_max), terms, form)


def filmed(asked: FilmFields, dance: Dance, terms: Terms, form: str) -> bytes:
    """The film of a dance, in the venue and with the time of day of its request, if these are given."""
    from app.files import film

    placed = asked if isinstance(asked, FilmRequest) else None
    rate, height = look(asked, form)
    megapixels = round(asked.seconds * rate * height * height * 16 / 9 / 1e6)
    check_limit(
        "seconds", "millions of pixels", megapixels, terms.settings.film_megapixels_max, "take fewer or smaller"
    )
    start, stop, touching = stretch(asked, dance, terms)
    clock = placed.start_clock if placed else None
    spec = FilmSpec(start, stop, asked.seconds, rate, height, asked.language, clock, touching)
    venue = placed.to_place(dance.dragon).venue if placed else None
    return film.film(dance, spec, form, venue=venue, title=asked.title, budget=terms.budget, progress=terms.progress)


def look(asked: FilmFields, form: str) -> tuple[int, int]:
    """Frames a second, and height [pixels]."""
    rate, height = LOOKS[form]
    return asked.rate or rate, asked.height or height


def stretch(asked: FilmFields, dance: Dance, terms: Terms) -> tuple[float, float, tuple[int, int] | None]:
    """First and last instant of the film [s], and the benches that touch at the last.

    raises: InvalidValue; OutsideRun
    """
    if asked.stop is not None:
        return *dance.span(asked.start, asked.stop), None
    start = dance.default_start if asked.start is None else asked.start
    end = dance.end
    until = min(end.time - (BEFORE_FOLD if end.reason is EndReason.FOLD else 0.0), start + LONGEST)
    if until <= start:
        told = quantities("s", got=start, end=until) | end.told
        raise InvalidValue("start", f"must be before {{end}}, when {end.template}", **told)
    found = first_contact(dance, start=start, stop=until, budget=terms.budget)
    if found.outcome is Outcome.CONTACT and found.time is not None:
        return *dance.span(start, found.time), found.benches
    return *dance.span(start, until), None


def _cost(asked: FilmFields, form: str = FORM) -> float:
    rate, height = look(asked, form)
    return asked.seconds * rate * height * height * 16 / 9 / 1e6 * SECONDS_PER_MEGAPIXEL[form]


QUESTION = Question(films, None, body=FilmRequest, forms=tuple(ENDINGS), cost=_cost, at="/films")
