"""Descriptions of the fields of an answer hold with and without a margin."""

from __future__ import annotations

import re

import app.service.main  # noqa: F401  so that every answer is known
from app.questions.collision_time import Certificate
from app.wire.question import Answer

TOUCHING = re.compile(r"\b(touch|overlap|meet)", re.IGNORECASE)
# Fields that speak of a touch alone, of both by `nearest`, or of no contact.
APART_FROM_MARGINS = {
    ("Turn", "tangent_point"), ("ShortestTurn", "tangent_point"), ("TurnTime", "tangent_point"),
    ("QuickestTurn", "tangent_point"), ("Overlap", "separation"), ("Nearest", "distance"),
    ("LeastClearance", "distance"), ("Shown", "depth"), ("DragonsClearance", "distance"), ("ShownTogether", "depth"),
    ("PerformanceEnvelope", "distance"), ("PerformanceTolerance", "certificate"),
    *(("ContactProbability", name) for name in ("probability", "contacts", "benches", "tolerance", "strayed")),
    *(
        (model, name)
        for model in ("Tolerance", "PerformanceTolerance")
        for name in ("stray", "stray_bracket", "limited_by", "time", "exhibit")
    ),
    *(("ToleranceCurve", name) for name in ("stray", "touching", "limited_by")),
    *((model, name) for model in ("CollisionTime", "Encounter") for name in ("margin", "corner", "edge")),
    ("Encounter", "cross_check"),
    # Cue cards list who comes near, within a reach and not a margin.
    *((model, "gap") for model in ("Meeting", "DragonMeeting")),
    *((model, name) for model in ("CueCard", "DragonCueCard") for name in ("meetings", "least_left_out")),
    *(
        (model, name)
        for model in ("Cue", "DragonCue")
        for name in ("kind", "time", "since", "until", "x", "nearest")
    ),
}  # fmt: skip


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
    if (model, name) in APART_FROM_MARGINS:
        return TOUCHING.search(words) is not None
    return not TOUCHING.search(words) or re.search(r"margin|nearer", words) is not None


def test_a_field_that_speaks_of_a_touch_speaks_of_the_margin_too() -> None:
    assert len(FIELDS) > 100
    assert [field for field in FIELDS if not speaks_of_what_counts(*field)] == []


def test_when_nothing_is_proven_clear_is_said() -> None:
    words = Certificate.model_fields["clear_until"].description or ""
    assert "null if no time is proven clear" in words
