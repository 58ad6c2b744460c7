"""Descriptions of the fields of an answer hold with and without a margin."""

from __future__ import annotations

import re

import app.service.main  # noqa: F401  so that every answer is known
from app.questions.collision_time import Certificate
from app.wire.question import Answer

TOUCHING = re.compile(r"\b(touch|overlap|meet)", re.IGNORECASE)
# Fields that speak of a touch alone, of both by `nearest`, or of no contact. Cue cards list who comes near, within a
# reach and not a margin.
APART_FROM_MARGINS = """
Turn.tangent_point ShortestTurn.tangent_point TurnTime.tangent_point QuickestTurn.tangent_point
Overlap.separation Nearest.distance LeastClearance.distance DragonsClearance.distance PerformanceEnvelope.distance
Shown.depth ShownTogether.depth PerformanceTolerance.certificate Encounter.cross_check
ContactProbability.probability ContactProbability.contacts ContactProbability.benches ContactProbability.tolerance
ContactProbability.strayed
Tolerance.stray Tolerance.stray_bracket Tolerance.limited_by Tolerance.time Tolerance.exhibit
PerformanceTolerance.stray PerformanceTolerance.stray_bracket PerformanceTolerance.limited_by PerformanceTolerance.time
PerformanceTolerance.exhibit ToleranceCurve.stray ToleranceCurve.touching ToleranceCurve.limited_by
CollisionTime.margin CollisionTime.corner CollisionTime.edge Encounter.margin Encounter.corner Encounter.edge
Meeting.gap DragonMeeting.gap
CueCard.meetings CueCard.least_left_out DragonCueCard.meetings DragonCueCard.least_left_out
Cue.kind Cue.time Cue.since Cue.until Cue.x Cue.nearest
DragonCue.kind DragonCue.time DragonCue.since DragonCue.until DragonCue.x DragonCue.nearest
"""


def answers(model: type[Answer]) -> list[type[Answer]]:
    """All kinds of an answer."""
    return [inner for kind in model.__subclasses__() for inner in (kind, *answers(kind))]


FIELDS = [
    (model.__name__, name, field.description or "")
    for model in answers(Answer)
    for name, field in model.model_fields.items()
]


def speaks_of_what_counts(model: str, name: str, words: str) -> bool:
    """True if a field speaks of the margin where it speaks of a touch, or has nothing to do with margins."""
    if f"{model}.{name}" in APART_FROM_MARGINS.split():
        return TOUCHING.search(words) is not None
    return not TOUCHING.search(words) or re.search(r"margin|nearer", words) is not None


def test_a_field_that_speaks_of_a_touch_speaks_of_the_margin_too() -> None:
    assert len(FIELDS) > 100
    assert [field for field in FIELDS if not speaks_of_what_counts(*field)] == []


def test_when_nothing_is_proven_clear_is_said() -> None:
    words = Certificate.model_fields["clear_until"].description or ""
    assert "null if no time is proven clear" in words
