"""The question minimum_pitch: the smallest pitch such that every larger one reaches the circle."""

from __future__ import annotations

from pydantic import Field

import core
from app.wire import evidence
from app.wire.answers import SENTENCES, TOTAL_STRAY
from app.wire.dances import BenchByBench, DragonFields
from app.wire.fields import PITCH_MAX, Answer, CrossCheck, Strays, UniformDragon, Whole
from app.wire.paths import Circle, WayToCircle
from app.wire.question import UNKNOWN_COST, Command, Question, Terms
from app.wire.readings import pitch_words
from core import Dragon, InvalidValue, LimitedBy
from core.design.minimum_pitch import DRAGONS_MAX
from core.language import say
from core.quantities import Quantity, format_number, quantities

# Shortest chord and largest circle of a search that takes 20 ms [m].
CHORD_ORDINARY, CIRCLE_ORDINARY = 0.5, 30.0


class PitchFields(Strays, Circle):
    """Smallest pitch such that every larger one reaches the circle."""

    dragons: Whole = Field(
        1,
        ge=1,
        le=DRAGONS_MAX,
        description="Number of equal dragons in the one spiral, which start at once, each turned against the next by a "
        "turn over this number: no benches of any two of them touch either",
    )
    cross_check: CrossCheck = "dragon"


class MinimumPitchQuery(PitchFields, UniformDragon):
    """Smallest pitch such that every larger one reaches the circle."""


class MinimumPitchRequest(PitchFields, DragonFields, strict=True):
    """Smallest pitch such that every larger one reaches the circle, for any dragon."""


class MinimumPitch(Answer, of=core.MinimumPitch, leave=()):
    """The smallest pitch such that every larger one lets the head reach the turning circle without two benches nearer
    than the margin (touching, if it is 0).

    cross_check: verdicts of the engines at a pitch 1e-6 m larger and smaller, with the head where the pair is in
        contact (with a stray shapely's alone, for the areas that benches may cover); of several dragons bench b of
        dragon k has the number k times the benches of one, plus b; null without a pair or if not requested
    """

    stray: float | None = TOTAL_STRAY
    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS
    cross_check: core.ContactCheck | None


def checked_pitch(result: core.MinimumPitch, request: WayToCircle, dragon: Dragon) -> core.MinimumPitch:
    """The minimum pitch, if other questions accept it. raises: InvalidValue naming what makes it too large"""
    if result.pitch <= PITCH_MAX:
        return result
    why = "the minimum pitch is {pitch}, and pitches are at most {most} here"
    values = quantities("m", 9, pitch=result.pitch) | quantities("m", most=PITCH_MAX)
    if result.limited_by is LimitedBy.START and result.benches is None:
        values |= quantities("turns", got=request.start_turns, least=request.turning_diameter / 2 / PITCH_MAX)
        raise InvalidValue("start_turns", f"must be at least {{least}}, or the turning circle smaller: {why}", **values)
    if result.dragons is not None:
        rule = f"must be fewer, or the turning circle larger: {why}"
        raise InvalidValue("dragons", rule, got=getattr(request, "dragons", None), **values)
    if result.benches is None or result.benches[1] - result.benches[0] > 2:
        got = Quantity(request.turning_diameter, "m")
        raise InvalidValue("turning_diameter", f"must be larger: {why}", got=got, **values)
    # The benches are hardly apart even on a straight line.
    if isinstance(request, Circle) and request.margin:
        raise InvalidValue("margin", f"must be smaller: {why}", got=Quantity(request.margin, "m"), **values)
    bench, one_by_one = result.benches[0], isinstance(getattr(request, "dragon", None), BenchByBench)
    field = f"dragon.overhangs.{bench}" if one_by_one else "dragon.overhang"
    narrower = f"must be smaller, or the benches narrower: {why}"
    raise InvalidValue(field, narrower, got=Quantity(float(dragon.overhangs[bench]), "m"), **values)


def minimum_pitch(request: MinimumPitchQuery | MinimumPitchRequest, terms: Terms) -> MinimumPitch:
    """The smallest pitch such that at every larger one the head reaches the circle without a contact."""
    dragon = request.to_dragon(request.most_benches(terms.settings))
    stray, check = request.to_stray(), None
    least = core.minimum_pitch(dragon, **request.to_circle(), stray=stray, dragons=request.dragons, budget=terms.budget)
    result = checked_pitch(least, request, dragon)
    if request.cross_check != "none":
        whole = request.cross_check == "dragon"
        check = core.pitch_check(
            result,
            dragon,
            margin=request.margin,
            stray=stray,
            dragons=request.dragons,
            whole=whole,
            budget=terms.budget,
        )
    sentences = pitch_words(result, dragon, request.turning_diameter, request.margin, stray)
    words = evidence.pitch_words(result, request, dragon, check) if terms.words else None
    own = {"stray": request.total_stray, "sentences": sentences, "words": words, "cross_check": check}
    return MinimumPitch.from_result(result, **own)


def _cost(request: MinimumPitchQuery | MinimumPitchRequest) -> float:
    """Estimated time [s]: very short benches on a large circle take thousands of times as long as ordinary ones."""
    dragon = request if isinstance(request, MinimumPitchQuery) else request.dragon
    if request.has_stray or request.dragons > 1 or not isinstance(dragon, UniformDragon):
        return UNKNOWN_COST
    chord = min(dragon.head_length, dragon.body_length) - 2 * dragon.overhang
    if chord < CHORD_ORDINARY or request.turning_diameter > CIRCLE_ORDINARY:
        return UNKNOWN_COST
    return 0.02 + 1e-4 * dragon.benches


def _title(request: MinimumPitchQuery | MinimumPitchRequest) -> str:
    lengths = {"diameter": format_number(request.turning_diameter), "margin": format_number(request.margin)}
    if not request.margin:
        return say("Minimum pitch for a turning circle of {diameter} m", **lengths)
    return say(
        "Minimum pitch for a turning circle of {diameter} m and no bench within {margin} m of another", **lengths
    )


QUESTION = Question(
    minimum_pitch,
    MinimumPitch,
    flat=MinimumPitchQuery,
    body=MinimumPitchRequest,
    cost=_cost,
    command=Command("The smallest pitch such that every larger one lets the head reach the turning circle.", _title),
)
