"""How tight may the spiral be?"""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.questions.question import UNKNOWN_COST, Question
from app.settings import Settings
from app.wire.answers import Pair, PairCheck, Point
from app.wire.dances import BenchByBench, Circle, DragonFields, UniformDragon
from app.wire.models import PITCH_MAX, Answer, CrossCheck, measure
from core import Dragon, InvalidValue, LimitedBy
from core.errors import said

# A search with chords of at least this and circles of at most this takes 20 ms [m].
CHORD_ORDINARY, CIRCLE_ORDINARY = 0.5, 30.0


class PitchFields(Circle):
    """How tight may the spiral be?"""

    cross_check: CrossCheck = "dragon"


class MinimumPitchQuery(PitchFields, UniformDragon):
    """How tight may the spiral be?"""


class MinimumPitchRequest(PitchFields, DragonFields, strict=True):
    """How tight may the spiral be, for any dragon?"""


class MinimumPitch(Answer):
    """The smallest pitch such that every larger one lets the head reach the turning circle with no two benches nearer
    than the margin, or touching if it is 0."""

    pitch: float = measure("m")
    pitch_bracket: Point = measure(
        "m", "Infeasible, feasible; twice the same where smaller pitches would begin inside the circle"
    )
    limited_by: core.LimitedBy = Field(
        description="Just below: a graze on the way; contact on the circle; the start: contact there or, where benches "
        "is null, a start inside the circle (contact: nearer than the margin, or a touch if it is 0); or a "
        "fold: a bench cannot follow the head as far as the circle"
    )
    benches: Pair | None = Field(
        description="The pair that touches, or is nearer than the margin, just below; null at a fold or without one"
    )
    bench: int | None = Field(description="The bench that folds just below; null if none does")
    head_radius: float | None = measure("m", "Where the head is then")
    other_feasible_intervals: list[Point] = measure("m", "Feasible islands below")
    justified_by: str = Field(
        description="How larger pitches are known to be feasible. bound: proven for all; scan: below proven_from "
        "single ones are proven, at most scan_step apart: a narrower range of infeasible ones is not excluded there"
    )
    proven_from: float = measure("m", "From here on every pitch is proven feasible; pitch itself without a scan")
    proven_up_to: float | None = measure("m", "Up to here; null: every larger pitch, without end")
    scan_step: float | None = measure("m", "How far apart the pitches of a scan are at most; null: no scan")
    evaluations: int = Field(description="Ways to the circle, and strips of pitches at once, that were marched")
    cross_check: PairCheck | None = Field(
        description="Engines on the dance at a pitch 1e-6 m larger and smaller, the head where the pair is nearer than "
        "the margin, or touches; null without a pair, and when not asked for"
    )

    @classmethod
    def of(cls, found: core.MinimumPitch, dragon: Dragon, asked: PitchFields) -> Self:
        check = None
        if asked.cross_check != "none":
            check = core.pitch_check(found, dragon, margin=asked.margin, whole=asked.cross_check == "dragon")
        return cls.known(found, cross_check=check)


def allowed(found: core.MinimumPitch, asked: Circle, dragon: Dragon) -> core.MinimumPitch:
    """The minimum pitch if other questions take it. raises: InvalidValue naming what makes it so large"""
    if found.pitch <= PITCH_MAX:
        return found
    why = f"the minimum pitch is {found.pitch:.9g} m, and pitches are at most {said(PITCH_MAX)} m here"
    if found.limited_by is LimitedBy.START and found.benches is None:
        turns = said(asked.turning_diameter / 2 / PITCH_MAX)
        rule = f"must be at least {turns} turns, or the turning circle smaller: {why}"
        raise InvalidValue.of("start_turns", rule, asked.start_turns, "turns")
    if found.benches is None or found.benches[1] - found.benches[0] > 2:
        raise InvalidValue.of("turning_diameter", f"must be larger: {why}", asked.turning_diameter, "m")
    # Hardly apart even on a straight line.
    if asked.margin:
        raise InvalidValue.of("margin", f"must be smaller: {why}", asked.margin, "m")
    bench = found.benches[0]
    field = (
        f"dragon.overhangs.{bench}" if isinstance(getattr(asked, "dragon", None), BenchByBench) else "dragon.overhang"
    )
    narrower = f"must be smaller, or the benches narrower: {why}"
    raise InvalidValue.of(field, narrower, float(dragon.overhangs[bench]), "m")


def minimum_pitch(asked: MinimumPitchQuery | MinimumPitchRequest, settings: Settings) -> MinimumPitch:
    """The smallest pitch such that every larger one reaches the circle with no touch, or no two within a margin."""
    dragon = asked.to_dragon(asked.most_benches(settings))
    found = allowed(core.minimum_pitch(dragon, **asked.to_circle()), asked, dragon)
    return MinimumPitch.of(found, dragon, asked)


def _cost(asked: MinimumPitchQuery | MinimumPitchRequest) -> float:
    """Benches shorter than their way around the circle is long take thousands of times as long as ordinary ones."""
    dragon = asked if isinstance(asked, MinimumPitchQuery) else asked.dragon
    if not isinstance(dragon, UniformDragon):
        return UNKNOWN_COST
    chord = min(dragon.head_length, dragon.body_length) - 2 * dragon.overhang
    if chord < CHORD_ORDINARY or asked.turning_diameter > CIRCLE_ORDINARY:
        return UNKNOWN_COST
    return 0.02 + 1e-4 * dragon.benches


QUESTION = Question(minimum_pitch, MinimumPitch, flat=MinimumPitchQuery, body=MinimumPitchRequest, cost=_cost)
