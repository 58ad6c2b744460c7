"""The question tolerance_curve: tolerance to strays, against the pitch."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

import core
from app.questions.minimum_pitch import checked_pitch
from app.questions.tolerance import STRAYS_IGNORED
from app.wire.answers import Columns
from app.wire.dances import DragonFields
from app.wire.fields import Answer, Pitch, UniformDragon, Whole, Wire, measure
from app.wire.labels import Part, TextTable, label, value_text
from app.wire.paths import WayToCircle
from app.wire.question import Command, Question, Terms
from core import Dragon, InvalidValue, Limit, TooMuchWork
from core.language import say
from core.quantities import format_number, quantities
from core.values import Floats

# Default highest pitch, as a multiple of the lowest one [1].
WIDEST = 2.0
# Default lowest pitch relative to the minimum pitch, less 1 [1]: at the minimum itself the dance may begin on the
# circle, which leaves no way to judge.
ABOVE_MINIMUM = 1e-6


class CurveFields(WayToCircle):
    """Pitches of spirals that lead to a circle."""

    from_pitch: Pitch | None = measure("m", "Lowest pitch; default: a millionth above the minimum pitch", None)
    to_pitch: Pitch | None = measure("m", "Highest pitch; default: twice the lowest one", None)
    samples: Whole = Field(20, ge=2, le=401, description="Number of pitches, evenly spaced")

    def pitches(self, dragon: Dragon, terms: Terms) -> Floats:
        """raises: InvalidValue for a highest pitch that is not above the lowest one"""
        low, high = self.from_pitch, self.to_pitch
        if low is None:
            radius = self.turning_diameter / 2
            least = core.minimum_pitch(dragon, turning_radius=radius, start_turns=self.start_turns, budget=terms.budget)
            low = checked_pitch(least, self, dragon).pitch * (1.0 + ABOVE_MINIMUM)
        if high is not None and high <= low:
            values = quantities("m", got=high, low=low)
            raise InvalidValue("to_pitch", "must be larger than the lowest pitch ({low})", **values)
        return np.linspace(low, WIDEST * low if high is None else high, self.samples)


class ToleranceCurveQuery(CurveFields, UniformDragon):
    """Tolerance to strays, against the pitch."""


class ToleranceCurveRequest(CurveFields, DragonFields, strict=True):
    """Tolerance to strays, against the pitch, of any dragon."""


class ToleranceCurve(Answer, of=core.ToleranceCurve):
    """Columns with one entry for each pitch, from the start of the dance until the head is on the circle.

    touching: shown to touch; null where no such pose was found [m]
    limited_by: effect of a larger stray. benches: two benches touch; chord: no contact up to half of the shortest chord
    """

    pitch: list[float]
    stray: list[float]
    touching: list[float | None]
    limited_by: list[Limit]


def tolerance_curve(request: ToleranceCurveQuery | ToleranceCurveRequest, terms: Terms) -> Columns:
    """Tolerance to strays on the way to a turning circle, against the pitch of the spiral."""
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    try:
        curve = core.tolerance_curve(
            dragon,
            request.pitches(dragon, terms),
            turning_radius=request.turning_diameter / 2,
            start_turns=request.start_turns,
            progress=terms.progress,
            budget=terms.budget,
        )
    except TooMuchWork as error:
        raise error.with_field("samples") if error.field == "pitches" else error from error
    ends = {"touching": [one.stray_bracket[1] for one in curve.tolerances]}
    limits = {"limited_by": [one.limited_by for one in curve.tolerances]}
    return Columns({"pitch": curve.pitch, "stray": curve.stray} | ends | limits)


def _parts(answer: Columns, request: Wire) -> Iterator[Part]:
    """One row for each pitch."""
    heads = label("pitch", "m"), label("stray", "m"), label("touching", "m"), label("limited_by")
    table = TextTable(say("Tolerance to strays"), *heads)
    for pitch, stray, touching, limit in zip(*answer.columns.values(), strict=True):
        shown = say("unknown") if touching is None else format_number(touching)
        table.add(format_number(pitch), format_number(stray), shown, value_text(limit))
    yield table


QUESTION = Question(
    tolerance_curve,
    ToleranceCurve,
    flat=ToleranceCurveQuery,
    body=ToleranceCurveRequest,
    command=Command(
        "Tolerance against the pitch: largest proven stray, and stray that is shown to touch.",
        lambda request: say("Tolerance to strays"),
        _parts,
        instead=STRAYS_IGNORED,
    ),
)
